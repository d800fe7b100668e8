//! Studies shared out among workers: web workers in the browser, threads on the desktop, behind one interface.
//!
//! The `scheduler` decides; `native` and `web` carry its tasks to workers and their answers back, and do so as soon as
//! an answer comes, not only when the interface draws. A worker's half is the `pool_worker`.

mod core;
#[cfg(not(target_arch = "wasm32"))]
#[path = "native.rs"]
mod platform;
#[cfg(target_arch = "wasm32")]
#[path = "web.rs"]
mod platform;
mod pool_worker;
mod scheduler;
mod study;
#[cfg(test)]
mod tests;

pub use pool_worker::PoolWorker;

use self::platform::SharedCore;
use crate::compute::protocol::{StudyJob, StudyNews, Topic};

/// Workers that answer studies, seen from the interface.
pub struct Pool {
    shared: SharedCore,
}

impl Pool {
    /// A pool without workers; they start once there is work, or by [`Self::prepare`]. `wake` is called whenever there is
    /// news to poll for, on the desktop from any thread.
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self { shared: SharedCore::new(wake) }
    }

    /// Has a worker started before there is work, once nothing is held: in the browser loading one takes a while.
    pub fn prepare(&mut self) {
        self.shared.with(|core| core.scheduler.prepare());
    }

    /// Begins a study in the place of its topic's present one, which ends.
    pub fn want(&mut self, job: StudyJob) {
        self.shared.with(|core| {
            core.scheduler.want(job);
            core.go_on();
        });
    }

    /// Ends a topic's study; nothing more comes of it.
    pub fn cancel(&mut self, topic: Topic) {
        self.shared.with(|core| core.scheduler.cancel(topic));
    }

    /// While held, no new place is begun: a drag has priority. What a worker has been given it finishes, some 20 ms.
    pub fn hold(&mut self, held: bool) {
        self.shared.with(|core| {
            core.scheduler.hold(held);
            core.go_on();
        });
    }

    /// The news since the last call, in order.
    pub fn poll(&mut self) -> Vec<StudyNews> {
        self.shared.with(|core| {
            core.go_on();
            core.scheduler.take_news()
        })
    }

    /// How many places of a topic's study are answered, and of how many; `None` where none is at work.
    pub fn progress(&self, topic: Topic) -> Option<(usize, usize)> {
        self.shared.with(|core| core.scheduler.progress(topic))
    }

    /// How many workers there are at most: what the hardware offers, from 1 to 8. In the browser one core is left to
    /// the page, which draws.
    pub fn size(&self) -> usize {
        self.shared.with(|core| core.scheduler.size())
    }
}
