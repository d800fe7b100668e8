//! How far a search has come, for those who watch it while it goes on.

use std::sync::Mutex;
use std::sync::MutexGuard;
use std::sync::PoisonError;

use crate::stability::Doubt;

/// One speed that the scan looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// In m/s.
    pub speed: f64,
    /// The largest Re λ there, in 1/s.
    pub growth_rate: f64,
}

/// What a search writes down on its way; it can be read at any time.
#[derive(Debug, Default)]
pub(super) struct Progress(Mutex<State>);

#[derive(Debug, Default)]
struct State {
    /// In m/s.
    searched_up_to: f64,
    samples: Vec<Sample>,
    doubt: Option<Doubt>,
}

impl Progress {
    /// Every write is whole, so the state is sound also where a thread has panicked that held it.
    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A search begins.
    pub(super) fn begin(&self) {
        *self.state() = State::default();
    }

    /// The search by structure has come to a speed (m/s).
    pub(super) fn reach(&self, speed: f64) {
        self.state().searched_up_to = speed;
    }

    /// The search by structure is in doubt: a scan begins at rest.
    pub(super) fn leave_to_scan(&self, doubt: Doubt) {
        *self.state() = State { doubt: Some(doubt), ..State::default() };
    }

    /// The scan has looked at its next speed.
    pub(super) fn add(&self, sample: Sample) {
        let mut state = self.state();
        state.searched_up_to = sample.speed;
        state.samples.push(sample);
    }

    pub(super) fn searched_up_to(&self) -> f64 {
        self.state().searched_up_to
    }

    pub(super) fn samples(&self) -> Vec<Sample> {
        self.state().samples.clone()
    }

    pub(super) fn doubt(&self) -> Option<Doubt> {
        self.state().doubt
    }
}
