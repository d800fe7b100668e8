//! The robot at one pose, ready to be asked for its spectrum, modes and critical speed.

use crate::mechanics::{self, Failure, LengthRates, SlackAcceleration, Statics, StaticsError, Vibration, WaveLimit};
use crate::robot::{Motion, PathPoint, Robot, Vec2};
use crate::stability::steps::finish;
use crate::stability::{CriticalSearch, NotConverged, Outcome, Spectra, Spectrum};

/// Statics, motion and the small-vibration problem at one pose.
///
/// ```
/// use tautline::stability::Outcome;
/// use tautline::{LocalProblem, Motion, robot};
///
/// let motion = Motion::new([6.0, 0.0], [1.0, 0.0], 5.0)?;
/// let local = LocalProblem::new(&robot::paper()?, &motion).map_err(|failure| failure.reason)?;
/// assert!(local.spectrum(motion.speed())?.is_stable());
/// let outcome = local.critical_speed(40.0)?;
/// assert!(matches!(outcome, Outcome::Found(critical) if (critical.speed - 10.0125).abs() < 1e-4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct LocalProblem {
    /// Every cable's static shape.
    pub statics: Statics,
    /// L' and L'' of every cable.
    pub rates: Vec<LengthRates>,
    /// The speed at which a winch reels as fast as waves run, where a cable moves.
    pub wave_limit: Option<WaveLimit>,
    /// How hard the platform may speed up or brake from rest before a cable goes slack, by statics.
    pub slack_acceleration: Option<SlackAcceleration>,
    /// The problem of small vibrations, for every speed.
    pub vibration: Vibration,
    /// The same, prepared for its eigenvalues.
    pub spectra: Spectra,
}

impl LocalProblem {
    /// Computes all that does not depend on the speed.
    ///
    /// # Errors
    /// An infeasible pose with its reason, or `NotConverged`; with the shapes that exist all the same.
    pub fn new(robot: &Robot, motion: &Motion) -> Result<Self, Failure> {
        Self::along(robot, mechanics::solve(robot, motion.position())?, motion.direction())
    }

    /// The same for statics that are known already, and a motion along the unit vector `direction`: they are the same
    /// for every direction.
    ///
    /// # Errors
    /// A pose where the motion or the vibrations cannot be computed, with the shapes.
    pub fn along(robot: &Robot, statics: Statics, direction: Vec2) -> Result<Self, Failure> {
        Self::on_curve(robot, statics, direction, Vec2::zeros())
    }

    /// The same at a point of a path, with L'' that has the path's curvature in it.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn at(robot: &Robot, point: &PathPoint) -> Result<Self, Failure> {
        Self::on_curve(robot, mechanics::solve(robot, point.position)?, point.tangent, point.curvature)
    }

    fn on_curve(robot: &Robot, statics: Statics, tangent: Vec2, curvature: Vec2) -> Result<Self, Failure> {
        let failed = |statics: Statics| Failure {
            reason: StaticsError::OutOfRange,
            cables: statics.cables.into_iter().map(Some).collect(),
        };
        let Some(rates) = mechanics::length_rates_on(robot, &statics, tangent, curvature) else {
            return Err(failed(statics));
        };
        let Some(vibration) = Vibration::new(robot, &statics, &rates) else {
            return Err(failed(statics));
        };
        match Spectra::new(&vibration) {
            Ok(spectra) => {
                let wave_limit = mechanics::wave_limit(robot, &statics, &rates);
                let slack_acceleration = mechanics::slack_acceleration(robot, &statics, tangent);
                Ok(Self { statics, rates, wave_limit, slack_acceleration, vibration, spectra })
            }
            Err(_) => Err(failed(statics)),
        }
    }

    /// All eigenvalues at `speed` (m/s), by structure; by the dense solver where that leaves doubt.
    ///
    /// # Errors
    /// [`NotConverged`] where the eigenvalue problem could not be solved.
    pub fn spectrum(&self, speed: f64) -> Result<Spectrum, NotConverged> {
        finish(self.spectrum_in_steps(speed))
    }

    /// The same in [steps](crate::stability::steps).
    ///
    /// # Errors
    /// As [`Self::spectrum`].
    pub async fn spectrum_in_steps(&self, speed: f64) -> Result<Spectrum, NotConverged> {
        self.spectra.clone().spectrum_in_steps(&self.vibration, speed).await
    }

    /// The critical speed, searched up to `limit` (m/s).
    ///
    /// # Errors
    /// [`NotConverged`] where an eigenvalue problem could not be solved.
    pub fn critical_speed(&self, limit: f64) -> Result<Outcome, NotConverged> {
        finish(self.critical_speed_in_steps(limit))
    }

    /// The same in [steps](crate::stability::steps).
    ///
    /// # Errors
    /// As [`Self::critical_speed`].
    pub async fn critical_speed_in_steps(&self, limit: f64) -> Result<Outcome, NotConverged> {
        CriticalSearch::new(limit).run_in_steps(&self.vibration).await
    }
}
