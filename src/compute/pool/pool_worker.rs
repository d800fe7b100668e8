//! A worker's half of the pool: what it knows of the studies, and its work.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use web_time::Instant;

use crate::compute::protocol::{AnsweredBatch, Batch, PartDone, Task, Topic};
use crate::compute::robot_study::RobotStudy;
use crate::stability::Steps;
use crate::study::Answer;

/// A slice of work ends after this time, so that the worker soon looks at its inbox.
const SLICE: Duration = Duration::from_millis(8);
/// A batch ends after this time, whatever is left of it.
const LONGEST: Duration = Duration::from_millis(20);

/// How a place is answered.
type AnswerAt = dyn Fn(&Arc<RobotStudy>, usize) -> Steps<Answer> + Send + Sync;

/// Serves tasks, one after the other and in slices. Feed it with [`PoolWorker::submit`], then call [`PoolWorker::work`]
/// until it returns `None`.
pub struct PoolWorker {
    answer: Arc<AnswerAt>,
    /// The newest study of each topic, with its generation. Its scenario is read once.
    studies: BTreeMap<Topic, (u64, Arc<RobotStudy>)>,
    batches: VecDeque<RunningBatch>,
    /// What has been told last of a place under way.
    told: Option<PartDone>,
}

/// A batch with its answers so far.
struct RunningBatch {
    batch: Batch,
    place: Option<Steps<Answer>>,
    answers: Vec<(usize, Answer)>,
    spent: Duration,
}

impl Default for PoolWorker {
    fn default() -> Self {
        Self::by(Arc::new(RobotStudy::answer))
    }
}

impl PoolWorker {
    /// One that answers each place by `answer`.
    pub(super) fn by(answer: Arc<AnswerAt>) -> Self {
        Self { answer, studies: BTreeMap::new(), batches: VecDeque::new(), told: None }
    }

    /// Takes a task.
    pub fn submit(&mut self, task: Task) {
        match task {
            Task::Study { generation, job } => {
                self.studies.remove(&job.study.topic());
                // The pool has checked it before. Batches of a study that is refused here end without answers.
                if let Ok(places) = RobotStudy::new(&job) {
                    self.studies.insert(job.study.topic(), (generation, Arc::new(places)));
                }
            }
            Task::Forget(topic) => {
                self.studies.remove(&topic);
            }
            Task::Batch(batch) => {
                self.batches.push_back(RunningBatch { batch, place: None, answers: Vec::new(), spent: Duration::ZERO });
            }
        }
    }

    /// Does a slice of work; gives the answer of a batch that ends with it. `None` when there is nothing left to do.
    ///
    /// A batch of a study that has been forgotten, or replaced, ends at once with what it has.
    pub fn work(&mut self) -> Option<Option<AnsweredBatch>> {
        let at_work = self.batches.front_mut()?;
        let begun = Instant::now();
        let known = self.studies.get(&at_work.batch.topic);
        let study = known.filter(|(generation, _)| *generation == at_work.batch.generation);
        let ended = study.is_none_or(|(_, places)| at_work.go_on(places, &*self.answer, begun));
        at_work.spent += begun.elapsed();
        if !ended {
            return Some(None);
        }
        let RunningBatch { answers, spent, .. } = self.batches.pop_front()?;
        Some(Some(AnsweredBatch { answers, seconds: spent.as_secs_f64() }))
    }
}

impl PoolWorker {
    /// How much is done of the place under way, where that is to be told and has changed since it was.
    pub fn part(&mut self) -> Option<PartDone> {
        let Batch { topic, generation, .. } = self.batches.front()?.batch;
        let (_, study) = self.studies.get(&topic).filter(|(known, _)| *known == generation)?;
        let part = PartDone { topic, generation, percent: study.percent()? };
        let is_new = self.told != Some(part);
        self.told = Some(part);
        is_new.then_some(part)
    }
}

impl RunningBatch {
    /// Goes on for the slice that has `begun`; whether the batch ends with it.
    fn go_on(&mut self, places: &Arc<RobotStudy>, answer: &AnswerAt, begun: Instant) -> bool {
        while let Some(&place) = self.batch.places.get(self.answers.len()) {
            let steps = self.place.get_or_insert_with(|| answer(places, place));
            loop {
                if let Some(found) = steps.advance() {
                    self.place = None;
                    self.answers.push((place, found));
                    break;
                }
                if begun.elapsed() >= SLICE {
                    return false;
                }
            }
            if self.spent + begun.elapsed() > LONGEST {
                break;
            }
            if begun.elapsed() >= SLICE {
                return self.answers.len() == self.batch.places.len();
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::protocol::StudyJob;
    use crate::scenario::presets;
    use crate::stability::steps::step;
    use crate::study::{Line, Study};

    /// A place that never ends, in steps of a millisecond.
    fn endless() -> PoolWorker {
        let forever = || async {
            loop {
                std::thread::sleep(Duration::from_millis(1));
                step().await;
            }
        };
        PoolWorker::by(Arc::new(move |_, _| Steps::new(forever())))
    }

    fn told(generation: u64, points: usize) -> [Task; 2] {
        let scenario = presets::PRESETS[0].scenario();
        let (robot, motion) = scenario.to_robot().expect("physical");
        let study = Study::Line { line: Line::through(&robot, &motion, points), limit: 40.0 };
        let job = StudyJob { revision: 1, scenario: scenario.to_json(), study };
        let places = (0..points).collect();
        [Task::Study { generation, job }, Task::Batch(Batch { topic: Topic::Line, generation, places })]
    }

    /// However long a place takes, the worker hears of it after a slice that its study is no longer wanted.
    #[test]
    fn a_place_is_given_up_when_its_study_is_forgotten_or_replaced() {
        for replaced in [false, true] {
            let mut pool_worker = endless();
            for task in told(1, 3) {
                pool_worker.submit(task);
            }
            for _ in 0..5 {
                let begun = Instant::now();
                assert_eq!(pool_worker.work(), Some(None));
                assert!(begun.elapsed() < 20 * SLICE, "{:?}", begun.elapsed());
            }
            if replaced {
                for task in told(2, 2) {
                    pool_worker.submit(task);
                }
            } else {
                pool_worker.submit(Task::Forget(Topic::Line));
            }
            let Some(Some(AnsweredBatch { answers, .. })) = pool_worker.work() else { panic!("no answer") };
            assert!(answers.is_empty());
            assert_eq!(pool_worker.work(), replaced.then_some(None), "what is left is the newer study");
        }
    }
}
