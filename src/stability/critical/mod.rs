//! The critical speed: the smallest speed at which an eigenvalue's real part becomes positive.
//!
//! The growth rate against speed is not monotone, so the *first* crossing is wanted. The structured search finds it
//! without a scan. For a robot without damping it first asks whether the modes at rest grow with the speed. Where the
//! structured search is in doubt, a scan decides: it raises the speed in steps to the first unstable one, as in the paper
//! (`scan`), then refines the crossing before it (`refine`) and checks that it is one (`confirm`). A crossing and its
//! return within one step are not seen; docs/theory.md section 8 says so.

mod confirm;
mod outcome;
mod progress;
mod refine;
mod scan;
#[cfg(test)]
mod tests;

use nalgebra::Complex;

use crate::mechanics::Vibration;
use crate::stability::crossing::{FirstCrossing, Search};
use crate::stability::rest::{AtRest, growth_at_rest};
use crate::stability::steps::finish;
use crate::stability::{Doubt, NotConverged};
use progress::Progress;
use scan::{Scan, ScanSolver, is_undamped};

pub use outcome::{Critical, Instability, Outcome};
pub use progress::Sample;
pub use scan::{Method, SCAN_STEP};

/// The highest speed in m/s up to which a critical speed is searched for. A robot one of whose cables moves at the speed of
/// its waves is no longer stable, give or take a few times that, and in no cable waves are faster than some 2000 m/s.
pub const LARGEST_LIMIT: f64 = 10_000.0;
/// What the limit of a search may be.
pub const ALLOWED_LIMIT: &str = "a number of m/s greater than 0, at most 10000, as no wave in a cable is faster";
/// Without damping, the search begins at this speed in m/s where all modes decay from rest on.
const ABOVE_REST: f64 = 1e-3;

/// Whether a critical speed can be searched for up to `speed` (m/s): [`ALLOWED_LIMIT`].
pub fn is_limit(speed: f64) -> bool {
    speed > 0.0 && speed <= LARGEST_LIMIT
}

/// A search for the critical speed of one problem. Others can watch it while it goes on.
///
/// ```
/// use tautline::stability::{CriticalSearch, Outcome, steps};
/// use tautline::{LocalProblem, Motion, robot};
///
/// let motion = Motion::new([0.0, 0.0], [1.0, 0.0], 5.0)?;
/// let local = LocalProblem::new(&robot::paper()?, &motion).map_err(|failure| failure.reason)?;
/// let search = CriticalSearch::new(11.0);
/// let mut reached = Vec::new();
/// let outcome = steps::finish_watched(search.run_in_steps(&local.vibration), || reached.push(search.searched_up_to()))?;
/// assert_eq!(outcome, Outcome::NoneUpTo(11.0));
/// assert!(reached.is_sorted());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct CriticalSearch {
    limit: f64,
    method: Method,
    progress: Progress,
}

impl CriticalSearch {
    /// A search from rest to `limit` (m/s), [`LARGEST_LIMIT`] at most; there is nothing to search where it is not greater
    /// than 0.
    pub fn new(limit: f64) -> Self {
        Self::by(Method::default(), limit)
    }

    /// The same by `method`.
    pub fn by(method: Method, limit: f64) -> Self {
        let limit = if limit > 0.0 { limit.min(LARGEST_LIMIT) } else { 0.0 };
        Self { limit, method, progress: Progress::default() }
    }

    /// The speeds the scan has looked at so far, in rising order; none where the structured search has answered.
    pub fn samples(&self) -> Vec<Sample> {
        self.progress.samples()
    }

    /// Why the structured search has left the answer to the scan; `None` where it has answered, or was not asked.
    pub fn doubt(&self) -> Option<Doubt> {
        self.progress.doubt()
    }

    /// The speed up to which the search has come, in m/s.
    pub fn searched_up_to(&self) -> f64 {
        self.progress.searched_up_to()
    }

    /// Searches the critical speed of `vibration`.
    ///
    /// # Errors
    /// [`NotConverged`] where an eigenvalue problem could not be solved.
    pub fn run(&self, vibration: &Vibration) -> Result<Outcome, NotConverged> {
        finish(self.run_in_steps(vibration))
    }

    /// The same in [steps](super::steps). A step is at most what is done in one cell of a strip of speeds, or one mode's
    /// part in an iteration for eigenvalues; only the dense solver takes one step for all eigenvalues at a speed.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub async fn run_in_steps(&self, vibration: &Vibration) -> Result<Outcome, NotConverged> {
        self.progress.begin();
        if self.method == Method::Structured {
            match self.by_structure(vibration).await {
                Ok(outcome) => return Ok(outcome),
                Err(doubt) => self.progress.leave_to_scan(doubt),
            }
        }
        let solver = ScanSolver::new(self.method, vibration)?;
        Scan::new(vibration, solver, self.limit).run(&self.progress).await
    }

    /// The search by structure.
    async fn by_structure(&self, vibration: &Vibration) -> Result<Outcome, Doubt> {
        let limit = self.limit;
        if limit == 0.0 {
            return Ok(Outcome::NoneUpTo(limit));
        }
        let mut strips = if is_undamped(vibration) {
            match growth_at_rest(vibration).await.map_err(|NotConverged| Doubt::Undamped)? {
                AtRest::Grows(critical) => return Ok(Outcome::Found(critical)),
                AtRest::Neutral => return Err(Doubt::Undamped),
                AtRest::Decays => {
                    let mut strips = FirstCrossing::new(vibration, ABOVE_REST, limit)?;
                    if !strips.begins_stable(vibration).await {
                        return Err(Doubt::Undamped);
                    }
                    strips
                }
            }
        } else {
            FirstCrossing::new(vibration, 0.0, limit)?
        };
        loop {
            self.progress.reach(strips.searched_up_to());
            match strips.search_next_strip(vibration).await? {
                None => {}
                Some(Search::NoneUpTo) => return Ok(Outcome::NoneUpTo(limit)),
                Some(Search::Crossing { omega, speed }) => {
                    let eigenvalue = Complex::new(0.0, omega);
                    let kind = if omega > 0.0 { Instability::Flutter } else { Instability::Divergence };
                    return Ok(Outcome::Found(Critical::at(vibration, speed, speed, eigenvalue, kind)));
                }
            }
        }
    }
}

/// The first crossing by structure, up to `limit` (m/s), without a scan.
///
/// # Errors
/// [`Doubt`] where a scan must decide.
pub fn structured(vibration: &Vibration, limit: f64) -> Result<Outcome, Doubt> {
    finish(CriticalSearch::new(limit).by_structure(vibration))
}
