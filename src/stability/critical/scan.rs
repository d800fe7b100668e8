//! The scan: the growth rate at speeds a step apart, up to the first one at which something grows.

use crate::mechanics::Vibration;
use crate::stability::critical::outcome::{Critical, Instability, Outcome};
use crate::stability::critical::progress::{Progress, Sample};
use crate::stability::steps::step;
use crate::stability::{Eigenproblem, NotConverged, Spectra, Spectrum};

/// The paper's step of the speed, in m/s.
pub const SCAN_STEP: f64 = 0.1;
/// Eigenvalues are known to this part of the largest frequency: real and imaginary parts below it are rounding.
const ROUNDING_OF_EIGENVALUES: f64 = 1e-10;
/// So far from a crossing, in m/s, the growth rate must be larger than its rounding.
pub(super) const CERTAIN: f64 = 1e-3;
/// Without damping every real part is zero at rest. Growth that begins there is looked for at this speed in m/s instead.
const JUST_ABOVE_REST: f64 = 1e-3 * SCAN_STEP;

/// How the critical speed is searched for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// By structure, at a cost that grows with the number of elements; where that leaves doubt, by a
    /// scan like the dense one, with the eigenvalues of [`Spectra`].
    #[default]
    Structured,
    /// By all eigenvalues at speeds [`SCAN_STEP`] apart, then bisection.
    Dense,
}

/// What gives the scan its eigenvalues.
#[derive(Debug)]
pub(super) enum ScanSolver {
    Structured(Box<Spectra>),
    Dense(Box<Eigenproblem>),
}

impl ScanSolver {
    pub(super) fn new(method: Method, vibration: &Vibration) -> Result<Self, NotConverged> {
        Ok(match method {
            Method::Structured => Self::Structured(Box::new(Spectra::new(vibration)?)),
            Method::Dense => Self::Dense(Box::new(Eigenproblem::new(vibration)?)),
        })
    }

    async fn spectrum(&mut self, vibration: &Vibration, speed: f64) -> Result<Spectrum, NotConverged> {
        match self {
            Self::Structured(spectra) => spectra.spectrum_in_steps(vibration, speed).await,
            Self::Dense(problem) => problem.spectrum(speed),
        }
    }

    /// About the largest undamped frequency, in rad/s.
    fn scale(&self) -> f64 {
        match self {
            Self::Structured(spectra) => spectra.scale(),
            Self::Dense(problem) => problem.scale(),
        }
    }
}

/// Which growth rates count as growth.
#[derive(Clone, Copy, Debug)]
pub(super) enum Growth {
    /// With damping: all above zero.
    Damped,
    /// Without damping all real parts are zero up to the first crossing. Growth is what exceeds their `rounding` (1/s).
    Undamped { rounding: f64 },
}

impl Growth {
    pub(super) fn is_in(self, spectrum: &Spectrum) -> bool {
        match self {
            Self::Damped => spectrum.growth_rate() > 0.0,
            Self::Undamped { rounding } => spectrum.growth_rate() > rounding,
        }
    }
}

/// A scan of one problem.
pub(super) struct Scan<'a> {
    vibration: &'a Vibration,
    solver: ScanSolver,
    pub growth: Growth,
    limit: f64,
}

impl<'a> Scan<'a> {
    /// A scan up to `limit` (m/s).
    pub(super) fn new(vibration: &'a Vibration, solver: ScanSolver, limit: f64) -> Self {
        let growth = if is_undamped(vibration) {
            Growth::Undamped { rounding: ROUNDING_OF_EIGENVALUES * solver.scale() }
        } else {
            Growth::Damped
        };
        Self { vibration, solver, growth, limit }
    }

    pub(super) async fn spectrum(&mut self, speed: f64) -> Result<Spectrum, NotConverged> {
        self.solver.spectrum(self.vibration, speed).await
    }

    /// Raises the speed from rest.
    pub(super) async fn run(mut self, progress: &Progress) -> Result<Outcome, NotConverged> {
        // At rest nothing grows: without damping the real parts are zero but for rounding.
        let growth_rate = self.spectrum(0.0).await?.growth_rate();
        progress.add(Sample { speed: 0.0, growth_rate });
        let (mut stable, mut steps) = (0.0, 0_u64);
        while stable < self.limit {
            step().await;
            steps += 1;
            let speed = (steps as f64 * SCAN_STEP).min(self.limit);
            let here = self.spectrum(speed).await?;
            progress.add(Sample { speed, growth_rate: here.growth_rate() });
            if let Some(unstable) = self.unstable_from(speed, &here).await? {
                return self.crossing_between(stable, unstable).await;
            }
            stable = speed;
        }
        Ok(Outcome::NoneUpTo(self.limit))
    }

    /// The speed (m/s) at which something grows for certain: `speed` with the spectrum `here`, or one just beyond it; `None`
    /// where nothing grows.
    async fn unstable_from(&mut self, speed: f64, here: &Spectrum) -> Result<Option<f64>, NotConverged> {
        // Growth that rounding hides decides nothing. It is hidden at a crossing, which may be just here, and no longer
        // beyond it.
        if matches!(self.growth, Growth::Damped) && is_hidden(here) {
            let speed = speed + CERTAIN;
            let beyond = self.spectrum(speed).await?;
            if is_hidden(&beyond) {
                return Err(NotConverged);
            }
            return Ok(self.growth.is_in(&beyond).then_some(speed));
        }
        Ok(self.growth.is_in(here).then_some(speed))
    }

    /// The crossing between two neighbouring speeds of the scan.
    async fn crossing_between(&mut self, stable: f64, unstable: f64) -> Result<Outcome, NotConverged> {
        let mut from = stable;
        if stable == 0.0 && matches!(self.growth, Growth::Undamped { .. }) {
            // Nearly everything that grows at the first step has grown from rest on.
            if self.growth.is_in(&self.spectrum(JUST_ABOVE_REST).await?) {
                return self.found(0.0, JUST_ABOVE_REST).await;
            }
            from = JUST_ABOVE_REST;
        }
        let crossing = self.refine(from, unstable).await?;
        if crossing > self.limit {
            return Ok(Outcome::NoneUpTo(self.limit));
        }
        self.confirm(crossing).await?;
        let speed = if self.grows_from_rest(crossing).await? { 0.0 } else { crossing };
        self.found(speed, crossing).await
    }

    /// The critical `speed` (m/s) with the eigenvalue that has the largest real part where the speed is `seen_at` (m/s).
    async fn found(&mut self, speed: f64, seen_at: f64) -> Result<Outcome, NotConverged> {
        let eigenvalue = self.spectrum(seen_at).await?.rightmost();
        let oscillates = eigenvalue.im > ROUNDING_OF_EIGENVALUES * self.solver.scale();
        let kind = if oscillates { Instability::Flutter } else { Instability::Divergence };
        Ok(Outcome::Found(Critical::at(self.vibration, speed, seen_at, eigenvalue, kind)))
    }
}

/// Whether the growth rate may be rounding.
pub(super) fn is_hidden(spectrum: &Spectrum) -> bool {
    spectrum.growth_rate().abs() <= spectrum.rounding(spectrum.rightmost())
}

/// Whether there is no damping at all.
pub(super) fn is_undamped(vibration: &Vibration) -> bool {
    vibration.damping.alpha == 0.0 && vibration.damping.beta == 0.0
}
