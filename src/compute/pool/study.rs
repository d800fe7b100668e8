//! A study at work: which places wait, how much work they are, which have lost a worker.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use crate::compute::protocol::{StudyJob, Topic};
use crate::compute::robot_study::RobotStudy;
use crate::study::Answer;

/// A batch takes about this time, in s. Holding and cancelling act after one or two batches.
const BATCH: f64 = 0.010;
/// The most places in a batch.
const MOST_PLACES: usize = 64;
/// A map's first picture comes before all else until it has taken this time of each worker, in s.
const COARSE_TIME: f64 = 0.3;
/// The least silence after which a worker is lost, in s. It is longer where places are slow, and doubles each time that the
/// same place has lost a worker.
const PATIENCE: f64 = 4.0;
/// Once places have been answered: this multiple of the slowest place's time.
const SLOWEST: f64 = 50.0;
/// As long as no place has been answered: in proportion to the weight of the places, but at most this, in s.
const MOST_PATIENCE: f64 = 60.0;
/// A place that has lost this number of workers is not tried again.
const MOST_LOSSES: i32 = 3;

/// A study at work. Inside, places go by their rank in the study's order.
pub struct RunningStudy {
    /// Names it.
    pub generation: u64,
    /// What was wanted.
    pub job: StudyJob,
    /// When it was served last.
    pub turn: u64,
    /// How many places are answered.
    pub answered: usize,
    places: RobotStudy,
    order: Vec<usize>,
    waiting: BTreeSet<usize>,
    /// Workers lost by a place.
    losses: BTreeMap<usize, i32>,
    /// The time that its places have taken, in s.
    spent: f64,
    /// The longest time that a place has taken per weight, in s; 0 as long as no place is answered.
    slowest: f64,
}

/// A batch on its way.
pub struct SentBatch {
    /// Of which study.
    pub topic: Topic,
    /// Of which study.
    pub generation: u64,
    /// Which places, by rank.
    ranks: Vec<usize>,
    /// How long it will take, in s.
    pub estimate: f64,
    /// How long it may take.
    pub patience: Duration,
}

impl RunningStudy {
    /// The study that `job` wants, no place answered.
    ///
    /// # Errors
    /// See [`RobotStudy::new`].
    pub fn new(job: StudyJob, generation: u64) -> Result<Self, String> {
        let places = RobotStudy::new(&job)?;
        let order = places.order();
        Ok(Self {
            generation,
            job,
            turn: 0,
            answered: 0,
            waiting: (0..order.len()).collect(),
            order,
            places,
            losses: BTreeMap::new(),
            spent: 0.0,
            slowest: 0.0,
        })
    }

    /// How many places there are.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// How many places no worker is at.
    pub fn waiting(&self) -> usize {
        self.waiting.len()
    }

    /// The study's rank among the running ones, 0 first: a map's first picture, then other studies, then the map's details and
    /// the border of the feasible region, which nobody waits for.
    /// `None` where no place waits.
    pub fn level(&self, workers: usize) -> Option<u8> {
        let coarse = *self.waiting.first()? < self.places.coarse();
        Some(match self.job.study.topic() {
            Topic::Map if coarse && self.spent < COARSE_TIME * workers as f64 => 0,
            Topic::Map if !coarse => 2,
            Topic::Border => 2,
            _ => 1,
        })
    }

    /// The next places, where one of weight 1 takes about `rate` s.
    pub fn take(&mut self, rate: f64) -> SentBatch {
        let mut ranks = Vec::new();
        let (mut estimate, mut heaviest, mut losses) = (0.0, 0.0_f64, 0);
        while let Some(&rank) = self.waiting.first() {
            let lost = self.losses.get(&rank).copied().unwrap_or_default();
            let weight = self.places.weight(self.order[rank]);
            // What has lost a worker goes alone, so that it takes no other place with it.
            let full = estimate + rate * weight > BATCH || ranks.len() == MOST_PLACES || lost > 0 || losses > 0;
            if full && !ranks.is_empty() {
                break;
            }
            self.waiting.remove(&rank);
            ranks.push(rank);
            estimate += rate * weight;
            (heaviest, losses) = (heaviest.max(weight), losses.max(lost));
        }
        let by_nature = (PATIENCE * heaviest).clamp(PATIENCE, MOST_PATIENCE);
        let patience =
            if self.slowest > 0.0 { (SLOWEST * self.slowest * heaviest).clamp(PATIENCE, by_nature) } else { by_nature };
        SentBatch {
            topic: self.job.study.topic(),
            generation: self.generation,
            ranks,
            estimate,
            patience: Duration::from_secs_f64(patience * f64::from(losses).exp2()),
        }
    }

    /// The numbers of the batch's places.
    pub fn places(&self, batch: &SentBatch) -> Vec<usize> {
        batch.ranks.iter().map(|&rank| self.order[rank]).collect()
    }

    /// Takes in the answers to a batch, which took so many seconds; gives what a place of weight 1 took, in s. What is
    /// not answered waits again. `None` where these are no answers to the batch; then nothing has changed.
    pub fn answer(&mut self, batch: &SentBatch, answers: &[(usize, Answer)], seconds: f64) -> Option<f64> {
        let (done, left) = batch.ranks.split_at_checked(answers.len())?;
        let fits = answers.iter().zip(done).all(|((place, _), &rank)| self.order[rank] == *place);
        if answers.is_empty() || !fits {
            return None;
        }
        self.waiting.extend(left);
        self.answered += done.len();
        self.spent += seconds;
        let weights = || done.iter().map(|&rank| self.places.weight(self.order[rank]));
        // The whole batch may have been the work of one place.
        self.slowest = self.slowest.max(seconds / weights().fold(0.0, f64::max));
        Some(seconds / weights().sum::<f64>())
    }

    /// Takes back a batch whose worker is lost, whether the worker had `begun` it or not. Gives answers in the place of
    /// those that have lost too many workers.
    pub fn give_back(&mut self, batch: SentBatch, begun: bool) -> Vec<(usize, Answer)> {
        let mut given_up = Vec::new();
        for rank in batch.ranks {
            let losses = self.losses.entry(rank).or_default();
            *losses += i32::from(begun);
            if *losses < MOST_LOSSES {
                self.waiting.insert(rank);
            } else {
                let place = self.order[rank];
                given_up.push((place, self.places.unknown(place)));
            }
        }
        self.answered += given_up.len();
        given_up
    }
}
