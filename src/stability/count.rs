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
use crate::stability::Spectra;
use crate::stability::steps::{finish, step};

type C64 = Complex<f64>;

/// How much d ln D times the step's length may change along a step. A zero half a length beside the step's middle changes it
/// by 2; this is 0.6 of that.
const LARGEST_CHANGE: f64 = 1.2;
/// How far the change of ln D may be from the trapezoidal rule. Such a zero makes it π/2 − 1; again this is 0.6 of that.
const LARGEST_ERROR: f64 = 0.34;
/// The arc is begun with this many steps.
const FIRST_STEPS: u32 = 8;
/// A step along the axis is expected to hold this many frequencies.
const LARGEST_STEP: f64 = 1.4;
/// A step is divided at this part of it, to see whether its parts agree. It is no simple fraction, so that evenly spaced
/// eigenvalues cannot look alike from both ends of both parts.
const INSIDE: f64 = 0.43;
/// The count is given up after this many evaluations per mode. A mode near the axis takes some ten, and one that is on it but
/// for rounding takes 160.
const EFFORT_EACH: usize = 60;
/// The count is not given up before this many evaluations.
const LEAST_EFFORT: usize = 20_000;
/// A step is divided at most this often. What is left of it then has an eigenvalue on the axis but for rounding.
const HALVINGS: u32 = 50;
/// The turns add up to an integer but for this.
const ROUNDING_OF_TURNS: f64 = 1e-3;

/// How many eigenvalues have a positive real part at `speed` (m/s), multiplicity included; `None` where it cannot be
/// told: one of them is on the axis, the effort would be too great, or the bounds do not hold.
///
/// By the argument principle, and where the mesh's fastest modes may be unstable by all eigenvalues.
pub fn unstable_eigenvalues(vibration: &Vibration, speed: f64) -> Option<usize> {
    let bounds = Bounds::new(vibration)?;
    let axis = Axis::new(Characteristic::new(vibration));
    let count = finish(Counter::new(bounds, axis).count(vibration, speed))?;
    let distinct = count.certain.then_some(count.unstable)?;
    Some(if vibration.isotropic { 2 * distinct } else { distinct })
}

/// What a count has found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Count {
    /// How many eigenvalues are unstable.
    pub unstable: usize,
    /// About the frequency (rad/s) of the eigenvalue nearest to the axis, or of the rightmost one.
    pub nearest: f64,
    /// Whether rounding has no part in it: no eigenvalue is on the axis but for that.
    pub certain: bool,
}

/// Counts the unstable eigenvalues of one problem, those of one direction where it is isotropic.
#[derive(Debug)]
pub(super) struct Counter {
    pub bounds: Bounds,
    pub axis: Axis,
    /// All eigenvalues, once they are needed.
    spectra: Option<Spectra>,
}

impl Counter {
    pub(super) fn new(bounds: Bounds, axis: Axis) -> Self {
        Self { bounds, axis, spectra: None }
    }

    /// The count at a speed (m/s) of the same `vibration`, in [steps](super::steps) of one or two evaluations of det Q;
    /// `None` where it cannot be told.
    pub(super) async fn count(&mut self, vibration: &Vibration, speed: f64) -> Option<Count> {
        let radius = self.bounds.largest_unstable(speed);
        if !self.bounds.is_sharp(radius) {
            return by_argument(&mut self.axis, &self.bounds, speed, radius).await;
        }
        // All modes of the mesh may be near the axis, at distances far below those between them: that many turns of D are
        // not followed safely. But the number of eigenvalues is finite, and they can all be had.
        let spectra = match &mut self.spectra {
            Some(spectra) => spectra,
            none => none.insert(Spectra::new(vibration).ok()?),
        };
        let spectrum = spectra.spectrum_in_steps(vibration, speed).await.ok()?;
        let all = || spectrum.modes().map(|mode| mode.eigenvalue);
        let unstable = all().filter(|l| l.re > 0.0).map(|l| if l.im > 0.0 { 2 } else { 1 }).sum();
        let certain = all().all(|l| l.re.abs() > spectrum.rounding(l));
        Some(Count { unstable, nearest: spectrum.rightmost().im, certain })
    }
}

/// The count by the argument principle, nothing beyond `radius` (1/s) being unstable.
async fn by_argument(axis: &mut Axis, bounds: &Bounds, speed: f64, radius: f64) -> Option<Count> {
    let effort = LEAST_EFFORT.max(EFFORT_EACH * bounds.modes());
    let careful = bounds.may_be_sharp();
    let mut path = Path { axis, speed, careful, evaluations: 0, effort, nearest: [f64::INFINITY, 0.0] };
    let (mut before, mut omega, mut along_axis) = (path.at(C64::new(0.0, 0.0)), 0.0, 0.0);
    while omega < radius {
        omega = radius.min(omega + bounds.frequency_step(omega, [LARGEST_STEP; 2]));
        if path.evaluations > path.effort {
            return None;
        }
        let next = path.at(C64::new(0.0, omega));
        along_axis += path.turn(before, next, HALVINGS).await?;
        before = next;
        step().await;
    }
    let nearest = path.nearest[1];
    let mut arc = 0.0;
    for k in (0..FIRST_STEPS).rev() {
        let next = path.at(C64::from_polar(radius, FRAC_PI_2 * f64::from(k) / f64::from(FIRST_STEPS)));
        arc -= path.turn(before, next, HALVINGS).await?;
        before = next;
        step().await;
    }
    let turns = (arc - along_axis) / PI;
    let whole = turns.round();
    // Zero or more, and far below 2^32: each has been met on the way.
    let sound = (turns - whole).abs() < ROUNDING_OF_TURNS && (0.0..path.effort as f64).contains(&whole);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number, as just seen")]
    sound.then_some(Count { unstable: whole as usize, nearest, certain: true })
}

/// ln D and its derivative at a point of the path.
#[derive(Clone, Copy)]
struct Point {
    lambda: C64,
    log: C64,
    slope: C64,
}

struct Path<'a> {
    axis: &'a mut Axis,
    speed: f64,
    /// Whether eigenvalues may be so near the axis that a step has to agree with its parts.
    careful: bool,
    evaluations: usize,
    /// Evaluations after which the count is given up.
    effort: usize,
    /// The shortest Newton step (1/s) so far, and from which Im λ: so far away is an eigenvalue, about.
    nearest: [f64; 2],
}

impl Path<'_> {
    fn at(&mut self, lambda: C64) -> Point {
        self.evaluations += 1;
        let value = self.axis.at(lambda, self.speed);
        let distance = 1.0 / value.by_lambda.norm_sqr().sqrt();
        if distance < self.nearest[0] {
            self.nearest = [distance, lambda.im];
        }
        Point { lambda, log: value.log, slope: value.by_lambda }
    }

    /// The change of arg D along the chord between two points, where that is called for once both parts of it agree with the
    /// whole.
    async fn turn(&mut self, from: Point, to: Point, halvings: u32) -> Option<f64> {
        let free = simple_turn(from, to);
        if free.is_some() && !self.careful {
            return free;
        }
        if halvings == 0 || self.evaluations > self.effort {
            return None;
        }
        let middle = self.at(from.lambda + (to.lambda - from.lambda) * INSIDE);
        if let (Some(_), Some(before), Some(after)) = (free, simple_turn(from, middle), simple_turn(middle, to)) {
            return Some(before + after);
        }
        step().await;
        let before = Box::pin(self.turn(from, middle, halvings - 1)).await?;
        Some(before + Box::pin(self.turn(middle, to, halvings - 1)).await?)
    }
}

/// The change of arg D along a chord that passes for free of zeros.
fn simple_turn(from: Point, to: Point) -> Option<f64> {
    let along = to.lambda - from.lambda;
    let (before, after) = (from.slope * along, to.slope * along);
    let difference = to.log - from.log;
    let expected = 0.5 * (before.im + after.im);
    let turns = ((difference.im - expected) / TAU).round();
    (change(difference, before, after) <= 1.0).then_some(difference.im - turns * TAU)
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
    use crate::robot::{Linearisation, RobotSpec, paper_spec};
    use crate::stability::{Eigenproblem, problems};

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
                let spec = RobotSpec { elements: 6, linearisation, ..paper_spec() };
                let vibration = problems::of_robot(spec, at, towards);
                let dense = Eigenproblem::new(&vibration).unwrap();
                let bounds = Bounds::new(&vibration).unwrap();
                let mut most = 0;
                for speed in [1.0, 5.0, 10.9, 12.0, 15.0, 21.0, 30.0] {
                    let spectrum = dense.spectrum(speed).unwrap();
                    let unstable: Vec<C64> = spectrum.eigenvalues().filter(|l| l.re > 0.0).collect();
                    assert_eq!(unstable_eigenvalues(&vibration, speed), Some(unstable.len()), "at {speed} m/s");
                    assert!(unstable.iter().all(|l| l.norm() < bounds.largest_unstable(speed)), "at {speed} m/s");
                    most = most.max(unstable.len());
                }
                assert!(most >= 4, "{most}");
            }
        }
    }
}
