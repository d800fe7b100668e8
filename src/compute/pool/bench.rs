//! A worker's half of the pool: what it knows of the studies, and its work.

use std::collections::BTreeMap;
use std::time::Duration;

use web_time::Instant;

use crate::compute::places::Places;
use crate::compute::protocol::{BatchAnswer, PlaceAnswer, Task, Topic};

/// A batch ends after this time, whatever is left of it.
const SLICE: Duration = Duration::from_millis(20);

/// Serves tasks, one after the other.
#[derive(Default)]
pub struct Bench {
    /// By topic the newest study with its generation; each is read from its scenario once.
    studies: BTreeMap<Topic, (u64, Places)>,
}

impl Bench {
    /// Does one task, each place answered by `answer`; a batch has an answer.
    pub fn serve(&mut self, task: &Task, answer: impl Fn(&Places, usize) -> PlaceAnswer) -> Option<BatchAnswer> {
        match task {
            Task::Study { generation, job } => {
                // The pool has read it before; what cannot be read leaves its batches without answers.
                if let Ok(places) = Places::new(job) {
                    self.studies.insert(job.study.topic(), (*generation, places));
                }
                None
            }
            Task::Batch(batch) => {
                let begun = Instant::now();
                let mut answers = Vec::with_capacity(batch.places.len());
                if let Some((generation, places)) = self.studies.get(&batch.topic)
                    && *generation == batch.generation
                {
                    for &place in &batch.places {
                        answers.push((place, answer(places, place)));
                        if begun.elapsed() > SLICE {
                            break;
                        }
                    }
                }
                Some(BatchAnswer { answers, seconds: begun.elapsed().as_secs_f64() })
            }
        }
    }
}
