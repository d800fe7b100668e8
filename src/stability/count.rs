//! How many eigenvalues are unstable at a speed, by the argument principle.
//!
//! The number of zeros of D(λ) = det Q(λ, v) in the right half-plane is the number of turns of D along the imaginary
//! axis and a half-circle beyond which [`Bounds`] says there are none. D is real on the real axis, so that a quarter is
//! enough: N = (change of arg D on the arc from R to iR − its change on the axis from 0 to iR)/π, an integer.
//! docs/theory.md section 11.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Complex;

use super::axis::Axis;
use super::bounds::Bounds;
use super::characteristic::Characteristic;
use crate::mechanics::Vibration;

type C64 = Complex<f64>;

/// How much d ln D times the step's length may change along a step: 0.6 of what a zero does half a length from its middle.
const LARGEST_CHANGE: f64 = 1.2;
/// How far the change of ln D may be from the trapezoidal rule: again 0.6 of what such a zero does, π/2 − 1.
const LARGEST_ERROR: f64 = 0.34;
/// First steps along the arc; those along the axis are so long that this many frequencies are expected in one.
const FIRST_STEPS: u32 = 8;
const LARGEST_STEP: f64 = 1.4;
/// Evaluations after which the count is given up.
const LARGEST_EFFORT: usize = 20_000;
/// Halvings of a step: an eigenvalue is then on the axis but for rounding.
const HALVINGS: u32 = 40;
/// The turns add up to an integer but for rounding.
const ROUNDING: f64 = 1e-3;

/// How many eigenvalues have a positive real part at `speed` (m/s), multiplicity included; `None` where it cannot be
/// told: one of them is on the axis, the effort would be too great, or the bounds do not hold.
pub fn unstable_eigenvalues(vibration: &Vibration, speed: f64) -> Option<usize> {
    let bounds = Bounds::new(vibration)?;
    let function = Characteristic::new(vibration);
    let distinct = count(&mut Axis::new(&function), &bounds, speed)?;
    Some(if vibration.isotropic { 2 * distinct } else { distinct })
}

/// The same of one direction where the problem is isotropic.
pub(super) fn count(axis: &mut Axis, bounds: &Bounds, speed: f64) -> Option<usize> {
    let radius = bounds.largest_unstable(speed);
    let mut path = Path { axis, speed, evaluations: 0 };
    let steps = (radius * bounds.frequency_density() / LARGEST_STEP).ceil().max(1.0);
    if steps.is_nan() || steps > LARGEST_EFFORT as f64 {
        return None;
    }
    let mut axis = 0.0;
    let mut before = path.at(C64::new(0.0, 0.0));
    let mut step = 0.0;
    while step < steps {
        step += 1.0;
        let next = path.at(C64::new(0.0, radius * step / steps));
        axis += path.turn(before, next, HALVINGS)?;
        before = next;
    }
    let mut arc = 0.0;
    for step in (0..FIRST_STEPS).rev() {
        let next = path.at(C64::from_polar(radius, FRAC_PI_2 * f64::from(step) / f64::from(FIRST_STEPS)));
        arc -= path.turn(before, next, HALVINGS)?;
        before = next;
    }
    let turns = (arc - axis) / PI;
    let whole = turns.round();
    // Zero or more, and far below 2^32: each has been met on the way.
    let sound = (turns - whole).abs() < ROUNDING && (0.0..LARGEST_EFFORT as f64).contains(&whole);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number, as just seen")]
    sound.then_some(whole as usize)
}

/// ln D and its derivative at a point of the path.
#[derive(Clone, Copy)]
struct Point {
    lambda: C64,
    log: C64,
    slope: C64,
}

struct Path<'a, 'f> {
    axis: &'a mut Axis<'f>,
    speed: f64,
    evaluations: usize,
}

impl Path<'_, '_> {
    fn at(&mut self, lambda: C64) -> Point {
        self.evaluations += 1;
        let value = self.axis.at(lambda, self.speed);
        Point { lambda, log: value.log, slope: value.by_lambda }
    }

    /// The change of arg D along the chord between two points.
    fn turn(&mut self, from: Point, to: Point, halvings: u32) -> Option<f64> {
        let along = to.lambda - from.lambda;
        let (before, after) = (from.slope * along, to.slope * along);
        let difference = to.log - from.log;
        if change(difference, before, after) <= 1.0 {
            let expected = 0.5 * (before.im + after.im);
            return Some(difference.im - ((difference.im - expected) / TAU).round() * TAU);
        }
        if halvings == 0 || self.evaluations > LARGEST_EFFORT {
            return None;
        }
        let middle = self.at((from.lambda + to.lambda) * 0.5);
        Some(self.turn(from, middle, halvings - 1)? + self.turn(middle, to, halvings - 1)?)
    }
}

/// How far a step is from being free of zeros, from the change of ln D along it (up to turns) and its derivatives at
/// both ends times the length: at most one where it is free, infinite where an end meets a singular pivot.
pub(super) fn change(difference: C64, before: C64, after: C64) -> f64 {
    let error = difference - (before + after) * 0.5;
    let turns = (error.im / TAU).round();
    let error = C64::new(error.re, error.im - turns * TAU).norm_sqr().sqrt() / LARGEST_ERROR;
    let change = (after - before).norm_sqr().sqrt() / LARGEST_CHANGE;
    if error.is_finite() && change.is_finite() { error.max(change) } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Linearisation, Motion, Robot, RobotSpec, paper_spec};
    use crate::stability::Eigenproblem;
    use crate::study::Local;

    /// A zero half a length from a step's middle is off the trapezoidal rule by π/2 − 1 and changes the derivative by 2.
    #[test]
    fn a_zero_beside_a_step_is_seen() {
        let zero = C64::new(0.0, 0.5);
        let [from, to] = [-0.5, 0.5].map(|x| C64::from(x) - zero);
        let difference = to.ln() - from.ln();
        for turns in [-2.0, 0.0, 3.0] {
            let seen = change(difference + C64::new(0.0, turns * TAU), from.inv(), to.inv());
            assert!((seen - (FRAC_PI_2 - 1.0) / LARGEST_ERROR).abs() < 1e-12, "{seen}");
        }
        let along = C64::new(0.0, 1.0);
        let changed = change((along + 1.0) * 1.5, along, along * 2.0 + 3.0);
        assert!((changed - 10.0_f64.sqrt() / LARGEST_CHANGE).abs() < 1e-12, "{changed}");
        assert!(change(difference, from.inv(), C64::new(f64::NAN, 0.0)).is_infinite());
        assert!(change(C64::new(f64::NAN, 0.0), along, along).is_infinite());
    }

    /// At every speed as many as the dense solver finds, and none beyond the bound.
    #[test]
    fn counts_what_the_dense_solver_finds() {
        for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
            for (at, towards) in [([0.0, 0.0], [1.0, 0.0]), ([4.0, 1.0], [1.0, 1.0]), ([7.0, 0.0], [-1.0, 0.0])] {
                let robot = Robot::new(RobotSpec { elements: 6, linearisation, ..paper_spec() }).unwrap();
                let local = Local::new(&robot, &Motion::new(at, towards, 5.0).unwrap()).unwrap();
                let dense = Eigenproblem::new(&local.vibration).unwrap();
                let bounds = Bounds::new(&local.vibration).unwrap();
                let mut most = 0;
                for speed in [1.0, 5.0, 10.9, 12.0, 15.0, 21.0, 30.0] {
                    let spectrum = dense.spectrum(speed).unwrap();
                    let unstable: Vec<C64> = spectrum.eigenvalues().filter(|l| l.re > 0.0).collect();
                    assert_eq!(unstable_eigenvalues(&local.vibration, speed), Some(unstable.len()), "at {speed} m/s");
                    assert!(unstable.iter().all(|l| l.norm() < bounds.largest_unstable(speed)), "at {speed} m/s");
                    most = most.max(unstable.len());
                }
                assert!(most >= 4, "{most}");
            }
        }
    }
}
