//! Who does what: a machine without threads and clock, which is told what has happened and says what to do.

use std::collections::{BTreeMap, VecDeque};
use std::time::Duration;

use super::study::{RunningStudy, SentBatch};
use crate::compute::protocol::{AnsweredBatch, Batch, PartDone, StudyJob, StudyNews, Task, Topic};
use crate::study::Answer;

/// More workers than this gain little and cost memory.
pub const MOST_WORKERS: usize = 8;

/// Names a worker; none comes twice.
pub type WorkerId = u64;

/// While a worker does a batch of less work than this, in s, its next one is sent ahead.
const AHEAD: f64 = 0.020;
/// The time of a place of weight 1, in s, as long as none is known.
const FIRST_GUESS: f64 = 0.004;
/// A worker that has not started by then is lost.
const START_PATIENCE: Duration = Duration::from_secs(20);
/// After this number of workers that did not start, no more are tried until a study is wanted again.
const MOST_FAILURES: u32 = 3;
/// Of the time between two calls no more than this counts: a page may sleep, and its workers with it.
const LONGEST_STEP: Duration = Duration::from_secs(1);

/// What is to be done.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Start a worker.
    Start(WorkerId),
    /// Send it a task.
    Tell(WorkerId, Task),
    /// End it.
    Stop(WorkerId),
}

/// Shares places out among workers.
pub struct Scheduler {
    size: usize,
    /// Whether workers may vanish without a word.
    silent_losses: bool,
    held: bool,
    /// Whether a worker is to be there before there is work.
    prepared: bool,
    studies: BTreeMap<Topic, RunningStudy>,
    /// The time that a place of weight 1 took of late, in s.
    rates: BTreeMap<Topic, f64>,
    workers: BTreeMap<WorkerId, Worker>,
    /// Workers to be ended.
    dismissed: Vec<WorkerId>,
    /// Topics whose study has ended, with workers that are at it.
    forgotten: Vec<(WorkerId, Topic)>,
    news: Vec<StudyNews>,
    /// Counts studies, workers and turns.
    generation: u64,
    last_worker: WorkerId,
    turn: u64,
    /// Workers that did not start since a study was wanted, and why the last one did not.
    failures: u32,
    failure: String,
    /// The caller's clock at the last call, and the time that counts.
    seen: Duration,
    now: Duration,
}

struct Worker {
    ready: bool,
    /// When it began what it does.
    since: Duration,
    /// Of which studies it has been told.
    told: BTreeMap<Topic, u64>,
    /// What it has been given, answered in this order.
    batches: VecDeque<SentBatch>,
}

impl Scheduler {
    /// For at most `size` workers; with `silent_losses` one that does not answer for long counts as lost.
    pub fn new(size: usize, silent_losses: bool) -> Self {
        Self {
            size: size.max(1),
            silent_losses,
            held: false,
            prepared: false,
            studies: BTreeMap::new(),
            rates: BTreeMap::new(),
            workers: BTreeMap::new(),
            dismissed: Vec::new(),
            forgotten: Vec::new(),
            news: Vec::new(),
            generation: 0,
            last_worker: 0,
            turn: 0,
            failures: 0,
            failure: String::new(),
            seen: Duration::ZERO,
            now: Duration::ZERO,
        }
    }

    /// How many workers there are at most.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Begins a study in the place of its topic's.
    pub fn want(&mut self, job: StudyJob) {
        let (topic, revision) = (job.study.topic(), job.revision);
        self.cancel(topic);
        self.failures = 0;
        self.generation += 1;
        match RunningStudy::new(job, self.generation) {
            Ok(study) => {
                self.studies.insert(topic, study);
                self.finish(topic);
            }
            Err(reason) => self.news.push(StudyNews::Refused { topic, revision, reason }),
        }
    }

    /// Ends a topic's study; nothing more comes of it, not even news that has not been fetched.
    pub fn cancel(&mut self, topic: Topic) {
        if let Some(study) = self.studies.remove(&topic) {
            // A place may take long. The workers that are at one are told, so that they are free for what is wanted now.
            let is_at_it = |worker: &Worker| {
                worker.batches.iter().any(|batch| (batch.topic, batch.generation) == (topic, study.generation))
            };
            let at_it = self.workers.iter_mut().filter(|(_, worker)| is_at_it(worker));
            self.forgotten.extend(at_it.map(|(id, worker)| {
                worker.told.remove(&topic);
                (*id, topic)
            }));
        }
        self.news.retain(|news| match news {
            StudyNews::Places { topic: of, .. }
            | StudyNews::Part { topic: of, .. }
            | StudyNews::Finished { topic: of, .. }
            | StudyNews::Refused { topic: of, .. } => *of != topic,
            StudyNews::Broken(_) => true,
        });
    }

    /// While held, no places are handed out and no workers started.
    pub fn hold(&mut self, held: bool) {
        self.held = held;
    }

    /// Starts a worker before there is a study, as soon as nothing is held.
    pub fn prepare(&mut self) {
        self.prepared = true;
    }

    /// Places answered, of all places.
    pub fn progress(&self, topic: Topic) -> Option<(usize, usize)> {
        self.studies.get(&topic).map(|study| (study.answered, study.len()))
    }

    /// Whether a study is at work.
    #[cfg(target_arch = "wasm32")]
    pub fn at_work(&self) -> bool {
        !self.studies.is_empty()
    }

    /// Whether there is news.
    pub fn has_news(&self) -> bool {
        !self.news.is_empty()
    }

    /// The news since the last call.
    pub fn take_news(&mut self) -> Vec<StudyNews> {
        std::mem::take(&mut self.news)
    }

    /// A worker can take tasks.
    pub fn ready(&mut self, id: WorkerId) {
        if let Some(worker) = self.workers.get_mut(&id) {
            worker.ready = true;
        }
    }

    /// A worker has answered the first of its batches.
    pub fn answered(&mut self, id: WorkerId, AnsweredBatch { answers, seconds }: AnsweredBatch) {
        // One that was taken for lost may answer all the same: too late.
        let Some(worker) = self.workers.get_mut(&id) else { return };
        worker.since = self.now;
        let Some(batch) = worker.batches.front() else { return };
        let topic = batch.topic;
        // An older study's answers count for nothing.
        if let Some(study) = self.studies.get_mut(&topic).filter(|study| study.generation == batch.generation) {
            let Some(rate) = study.answer(batch, &answers, seconds) else {
                self.lost(id, "a worker answered something else than it was asked".into());
                return;
            };
            let known = self.rates.entry(topic).or_insert(rate);
            *known = 0.5 * (*known + rate);
            self.tell(topic, answers);
        }
        if let Some(worker) = self.workers.get_mut(&id) {
            worker.batches.pop_front();
        }
    }

    /// A worker has come so far with the place that it is at. That is a sign of life as well.
    pub fn part(&mut self, id: WorkerId, PartDone { topic, generation, percent }: PartDone) {
        let Some(worker) = self.workers.get_mut(&id) else { return };
        worker.since = self.now;
        if let Some(study) = self.studies.get(&topic).filter(|study| study.generation == generation) {
            // Only the newest is worth telling.
            self.news.retain(|news| !matches!(news, StudyNews::Part { topic: of, .. } if *of == topic));
            self.news.push(StudyNews::Part { topic, revision: study.job.revision, percent });
        }
    }

    /// A worker is no more: what it has not answered is done again.
    pub fn lost(&mut self, id: WorkerId, reason: String) {
        let Some(worker) = self.workers.remove(&id) else { return };
        self.dismissed.push(id);
        if !worker.ready {
            self.failures += 1;
            self.failure = reason;
        }
        for (i, batch) in worker.batches.into_iter().enumerate() {
            let topic = batch.topic;
            let study = self.studies.get_mut(&topic).filter(|study| study.generation == batch.generation);
            // The others were waiting in its inbox.
            let given_up = study.map(|study| study.give_back(batch, i == 0)).unwrap_or_default();
            if !given_up.is_empty() {
                self.tell(topic, given_up);
            }
        }
    }

    /// What is to be done at the time `clock`, which never goes back.
    pub fn plan(&mut self, clock: Duration) -> Vec<Action> {
        self.now += clock.saturating_sub(self.seen).min(LONGEST_STEP);
        self.seen = self.seen.max(clock);
        if self.silent_losses {
            self.find_lost();
        }
        let mut actions: Vec<Action> = self.dismissed.drain(..).map(Action::Stop).collect();
        let forgotten = std::mem::take(&mut self.forgotten).into_iter();
        let alive = forgotten.filter(|(id, _)| self.workers.contains_key(id));
        actions.extend(alive.map(|(id, topic)| Action::Tell(id, Task::Forget(topic))));
        if !self.held {
            self.hand_out(&mut actions);
            self.start_workers(&mut actions);
        }
        if self.workers.is_empty() && self.failures >= MOST_FAILURES && !self.studies.is_empty() {
            self.studies.clear();
            self.news.push(StudyNews::Broken(self.failure.clone()));
        }
        actions
    }

    /// News of a study's answers, and of its end if they were the last.
    fn tell(&mut self, topic: Topic, answers: Vec<(usize, Answer)>) {
        if let Some(study) = self.studies.get(&topic) {
            self.news.push(StudyNews::Places { topic, revision: study.job.revision, answers });
            self.finish(topic);
        }
    }

    fn finish(&mut self, topic: Topic) {
        if let Some(study) = self.studies.get(&topic)
            && study.answered == study.len()
        {
            self.news.push(StudyNews::Finished { topic, revision: study.job.revision });
            self.studies.remove(&topic);
        }
    }

    /// Ends those that have been silent for too long.
    fn find_lost(&mut self) {
        let too_long = |worker: &Worker| {
            let patience = match worker.batches.front() {
                Some(batch) => batch.patience,
                None if worker.ready => return false,
                None => START_PATIENCE,
            };
            self.now.saturating_sub(worker.since) > patience
        };
        let lost: Vec<WorkerId> =
            self.workers.iter().filter(|(_, worker)| too_long(worker)).map(|(id, _)| *id).collect();
        for id in lost {
            self.lost(id, "a worker does not answer".into());
        }
    }

    /// Gives each worker a batch, then those that will soon have done theirs another one.
    fn hand_out(&mut self, actions: &mut Vec<Action>) {
        for depth in 0..2 {
            let takes = |worker: &Worker| {
                let soon = worker.batches.front().is_none_or(|batch| batch.estimate <= AHEAD);
                worker.ready && worker.batches.len() == depth && soon
            };
            let takers: Vec<WorkerId> =
                self.workers.iter().filter(|(_, worker)| takes(worker)).map(|(id, _)| *id).collect();
            for id in takers {
                let Some((topic, study)) = next(&mut self.studies, self.size) else { return };
                let Some(worker) = self.workers.get_mut(&id) else { continue };
                self.turn += 1;
                study.turn = self.turn;
                let generation = study.generation;
                if worker.told.insert(topic, generation) != Some(generation) {
                    actions.push(Action::Tell(id, Task::Study { generation, job: study.job.clone() }));
                }
                let batch = study.take(self.rates.get(&topic).copied().unwrap_or(FIRST_GUESS));
                let places = study.places(&batch);
                actions.push(Action::Tell(id, Task::Batch(Batch { topic, generation, places })));
                if worker.batches.is_empty() {
                    worker.since = self.now;
                }
                worker.batches.push_back(batch);
            }
        }
    }

    /// Starts as many workers as there is work for, and the one that has to be there before.
    fn start_workers(&mut self, actions: &mut Vec<Action>) {
        let first = usize::from(self.prepared && self.workers.is_empty());
        let waiting = self.studies.values().map(RunningStudy::waiting).sum::<usize>().max(first);
        let mut starting = self.workers.values().filter(|worker| !worker.ready).count();
        while self.workers.len() < self.size && starting < waiting && self.failures < MOST_FAILURES {
            self.last_worker += 1;
            let worker = Worker { ready: false, since: self.now, told: BTreeMap::new(), batches: VecDeque::new() };
            self.workers.insert(self.last_worker, worker);
            actions.push(Action::Start(self.last_worker));
            starting += 1;
        }
    }
}

/// The study whose turn it is.
fn next(studies: &mut BTreeMap<Topic, RunningStudy>, workers: usize) -> Option<(Topic, &mut RunningStudy)> {
    let waiting =
        studies.iter_mut().filter_map(|(topic, study)| Some((study.level(workers)?, study.turn, *topic, study)));
    let (.., topic, study) = waiting.min_by_key(|(level, turn, topic, _)| (*level, *turn, *topic))?;
    Some((topic, study))
}
