//! The scheduler with its workers and the clock.

use web_time::Instant;

use super::scheduler::{Action, Scheduler, WorkerId};
use crate::compute::protocol::{AnsweredBatch, PartDone, Task};

/// What is heard of a worker.
pub enum Event {
    /// It can take tasks.
    Ready,
    /// It has answered a batch.
    Answered(AnsweredBatch),
    /// It has come so far with a place.
    Part(PartDone),
    /// It is no more, with the reason.
    Lost(String),
}

/// The workers that the pool has started: threads or web workers.
pub trait Crew {
    /// Starts a worker.
    ///
    /// # Errors
    /// Why there can be none.
    fn start(&mut self, worker: WorkerId) -> Result<(), String>;

    /// Sends a task.
    ///
    /// # Errors
    /// Why it cannot be sent.
    fn tell(&mut self, worker: WorkerId, task: Task) -> Result<(), String>;

    /// Ends a worker after its slice.
    fn stop(&mut self, worker: WorkerId);
}

/// The scheduler with the workers that do what it says.
pub struct Core<C> {
    /// What is to be done.
    pub scheduler: Scheduler,
    crew: C,
    begun: Instant,
}

impl<C: Crew> Core<C> {
    /// With no worker yet.
    pub fn new(scheduler: Scheduler, crew: C) -> Self {
        Self { scheduler, crew, begun: Instant::now() }
    }

    /// Takes in what is heard of a worker and goes on; says whether there is news to fetch.
    pub fn hear(&mut self, worker: WorkerId, event: Event) -> bool {
        match event {
            Event::Ready => self.scheduler.ready(worker),
            Event::Answered(batch) => self.scheduler.answered(worker, batch),
            Event::Part(part) => self.scheduler.part(worker, part),
            Event::Lost(reason) => self.scheduler.lost(worker, reason),
        }
        self.go_on()
    }

    /// Does whatever is to be done now; says whether there is news to fetch.
    pub fn go_on(&mut self) -> bool {
        loop {
            let actions = self.scheduler.plan(self.begun.elapsed());
            if actions.is_empty() {
                return self.scheduler.has_news();
            }
            for action in actions {
                let (worker, done) = match action {
                    Action::Start(worker) => (worker, self.crew.start(worker)),
                    Action::Tell(worker, task) => (worker, self.crew.tell(worker, task)),
                    Action::Stop(worker) => {
                        self.crew.stop(worker);
                        continue;
                    }
                };
                if let Err(reason) = done {
                    self.scheduler.lost(worker, reason);
                }
            }
        }
    }
}
