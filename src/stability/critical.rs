//! The critical speed: the smallest speed at which an eigenvalue's real part becomes positive.
//!
//! The growth rate against speed is not monotone, so the *first* crossing is wanted: the speed is raised in steps to
//! the first unstable one, as in the paper, and the crossing before it is then refined. A crossing and its return
//! within one step are not seen; docs/theory.md section 8 says so.

use std::f64::consts::TAU;

use nalgebra::Complex;

use crate::mechanics::Vibration;
use crate::stability::{Eigenproblem, NotConverged, Polarisation, mode};

/// The paper's step of the speed, in m/s.
pub const SCAN_STEP: f64 = 0.1;
/// The crossing is refined to this many m/s.
const REFINED_TO: f64 = 1e-9;
/// Growth rates below this part of the largest frequency are rounding.
const ROUNDING: f64 = 1e-10;
/// Without damping, the fraction of a step at which the growing mode is looked at in place of v = 0.
const NEAR_ZERO: f64 = 1e-3;

/// How stability is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An oscillation grows.
    Flutter,
    /// A displacement grows without oscillating.
    Divergence,
}

/// The first crossing.
#[derive(Clone, Debug, PartialEq)]
pub struct Critical {
    /// The critical speed in m/s.
    pub speed: f64,
    /// The eigenvalue that crosses, with Im λ ≥ 0, in 1/s.
    pub eigenvalue: Complex<f64>,
    /// Flutter, or divergence where Im λ = 0.
    pub kind: Kind,
    /// The cable with the largest share of the mode's kinetic energy, 0-based.
    pub cable: usize,
}

impl Critical {
    /// |Im λ|/2π of the crossing eigenvalue in Hz; 0 for divergence.
    pub fn frequency_hz(&self) -> f64 {
        match self.kind {
            Kind::Flutter => self.eigenvalue.im.abs() / TAU,
            Kind::Divergence => 0.0,
        }
    }
}

/// One speed that the search looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// In m/s.
    pub speed: f64,
    /// The largest Re λ there, in 1/s.
    pub growth_rate: f64,
}

/// How a search ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// A crossing was found.
    Found(Critical),
    /// Every speed up to the limit (m/s) is stable.
    NoneUpTo(f64),
}

/// A search for the critical speed of one problem in slices, so that it can be watched and abandoned.
#[derive(Debug)]
pub struct CriticalSearch {
    limit: f64,
    steps: u64,
    samples: Vec<Sample>,
}

impl CriticalSearch {
    /// A search from rest to `limit` (m/s).
    pub fn new(limit: f64) -> Self {
        Self { limit, steps: 0, samples: Vec::new() }
    }

    /// The speeds looked at so far, in rising order.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// The speed up to which the search has come, in m/s.
    pub fn searched_up_to(&self) -> f64 {
        self.samples.last().map_or(0.0, |sample| sample.speed)
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// [`NotConverged`] where an eigenvalue problem could not be solved.
    pub fn run(mut self, vibration: &Vibration, problem: &Eigenproblem) -> Result<Outcome, NotConverged> {
        loop {
            if let Some(outcome) = self.advance(vibration, problem)? {
                return Ok(outcome);
            }
        }
    }

    /// Looks at the next speed of the same `vibration`, whose `problem` is given with it; `None` while the search
    /// goes on.
    ///
    /// # Errors
    /// [`NotConverged`] where an eigenvalue problem could not be solved.
    pub fn advance(&mut self, vibration: &Vibration, problem: &Eigenproblem) -> Result<Option<Outcome>, NotConverged> {
        let speed = (self.steps as f64 * SCAN_STEP).min(self.limit);
        let growth_rate = problem.spectrum(speed)?.growth_rate();
        self.steps += 1;
        self.samples.push(Sample { speed, growth_rate });
        // At rest nothing grows: without damping the real parts are zero but for rounding.
        if speed == 0.0 {
            return Ok(None);
        }
        let threshold = threshold(problem);
        if growth_rate > threshold {
            let before = self.samples[self.samples.len() - 2].speed;
            // Without damping, what grows at the first step has grown from rest on.
            let from_rest = threshold > 0.0 && before == 0.0;
            let critical = if from_rest { 0.0 } else { refine(problem, before, speed)? };
            return describe(vibration, problem, critical).map(|c| Some(Outcome::Found(c)));
        }
        Ok((speed >= self.limit).then_some(Outcome::NoneUpTo(self.limit)))
    }
}

/// What a growth rate must exceed to count as positive: zero; without damping, rounding.
fn threshold(problem: &Eigenproblem) -> f64 {
    let undamped = problem.damping().alpha == 0.0 && problem.damping().beta == 0.0;
    if undamped { ROUNDING * problem.scale() } else { 0.0 }
}

/// The crossing between a stable and an unstable speed, by bisection.
fn refine(problem: &Eigenproblem, mut stable: f64, mut unstable: f64) -> Result<f64, NotConverged> {
    let threshold = threshold(problem);
    // Far from zero two neighbouring numbers may be further apart than that.
    while unstable - stable > REFINED_TO.max(4.0 * f64::EPSILON * unstable) {
        let middle = 0.5 * (stable + unstable);
        if problem.spectrum(middle)?.growth_rate() > threshold {
            unstable = middle;
        } else {
            stable = middle;
        }
    }
    Ok(0.5 * (stable + unstable))
}

/// The mode that crosses at the critical speed `speed`.
fn describe(vibration: &Vibration, problem: &Eigenproblem, speed: f64) -> Result<Critical, NotConverged> {
    // Undamped, every real part is zero at rest: the mode that grows is seen just above.
    let seen_at = if speed == 0.0 { NEAR_ZERO * SCAN_STEP } else { speed };
    let eigenvalue = problem.spectrum(seen_at)?.rightmost();
    let mode = mode(vibration, seen_at, eigenvalue, Polarisation::default());
    let kind = if eigenvalue.im > ROUNDING * problem.scale() { Kind::Flutter } else { Kind::Divergence };
    Ok(Critical { speed, eigenvalue, kind, cable: mode.responsible_cable() })
}
