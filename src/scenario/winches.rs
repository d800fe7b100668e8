//! A robot from nothing but its winch points: something to start from, which can stand where it is put.

use crate::mechanics;
use crate::robot::{BoundingBox, Faults, TensionLaw, Vec2, paper_spec};
use crate::scenario::Scenario;
use crate::scenario::json::{Cable, Motion};

/// Why winch points give no robot.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoRobot {
    /// The winches themselves cannot be: too few or too many, or two at one point.
    #[error(transparent)]
    Faults(#[from] Faults),
    /// At none of the poses that were tried do the cables hold the platform.
    #[error("no pose was found at which these cables hold the platform; spread the winches, or put two of them higher")]
    NoPose,
}

/// Poses are tried at this many points along each side of the box about the winches.
const TRIED: usize = 9;
/// The prescribed tensions that are tried, in parts of the weight of a cable that spans the box.
const TENSIONS: [f64; 3] = [2.0, 0.5, 8.0];
/// How much a metre between the cables at equilibrium counts for, in metres of their height.
const WIDE: f64 = 0.1;

/// A robot of the paper's material and platform with its winches at `points` (m), in their order.
///
/// Two high winches far apart are at equilibrium, every other cable has a constant tension, and the platform stands as near
/// to the middle as there is an equilibrium. It moves to the right, through a quarter of the width in a second.
///
/// # Errors
/// [`NoRobot`].
pub fn from_winches(points: &[[f64; 2]]) -> Result<Scenario, NoRobot> {
    let winches = BoundingBox::of(points.iter().copied().map(Vec2::from));
    let frame = winches.unwrap_or(BoundingBox { low: Vec2::zeros(), high: Vec2::zeros() }).with_area();
    let held = highest(points);
    let cable = |tension: f64| {
        move |(i, &anchor): (usize, &[f64; 2])| {
            let law = if held.contains(&i) { TensionLaw::Equilibrium } else { TensionLaw::Constant(tension) };
            Cable::new(anchor, law)
        }
    };
    // At least 1 N, so that fewer winches than make a box are told to be too few, and nothing else.
    let weight = (paper_spec().material.mass_per_length * paper_spec().gravity * frame.size().norm()).max(1.0);
    let motion = Motion { position: [0.0, 0.0], direction: [1.0, 0.0], speed: 0.25 * frame.size().x };
    for tension in TENSIONS.map(|part| rounded(part * weight)) {
        let cables = points.iter().enumerate().map(cable(tension)).collect();
        let mut scenario = Scenario { cables, ..Scenario::new(&paper_spec(), motion) };
        let (robot, _) = scenario.to_robot()?;
        if let Some(position) = poses(frame).into_iter().find(|&at| mechanics::solve(&robot, at).is_ok()) {
            scenario.motion.position = position.into();
            return Ok(scenario);
        }
    }
    Err(NoRobot::NoPose)
}

/// The two winches that are high and far apart, in rising order.
fn highest(points: &[[f64; 2]]) -> [usize; 2] {
    let score = |i: usize, j: usize| points[i][1] + points[j][1] + WIDE * (points[i][0] - points[j][0]).abs();
    let pairs = (0..points.len()).flat_map(|j| (0..j).map(move |i| [i, j]));
    // Of equal pairs the first.
    let best = |a: [usize; 2], b: [usize; 2]| if score(b[0], b[1]) > score(a[0], a[1]) { b } else { a };
    pairs.reduce(best).unwrap_or([0, 1])
}

/// Where the platform may stand, the middle first. Where all winches are at one height it hangs below them.
fn poses(frame: BoundingBox) -> Vec<Vec2> {
    let below = (0.5 * frame.size().x - frame.size().y).max(0.0);
    let low = frame.low - Vec2::new(0.0, below);
    let (size, middle) = (frame.high - low, (frame.high + low) / 2.0);
    let part = |k: usize| (k + 1) as f64 / (TRIED + 1) as f64;
    let place = |k: usize| low + size.component_mul(&Vec2::new(part(k % TRIED), part(k / TRIED)));
    let mut poses: Vec<Vec2> = (0..TRIED * TRIED).map(place).collect();
    poses.sort_by(|a, b| (a - middle).norm().total_cmp(&(b - middle).norm()));
    poses
}

/// To two digits: nobody is to wonder where the others come from.
fn rounded(value: f64) -> f64 {
    let unit = 10.0_f64.powf(value.log10().floor() - 1.0);
    (value / unit).round() * unit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::LocalProblem;

    /// Rectangles, a triangle, a pentagon, a line below the ceiling, small and large ones, one far from the origin: each
    /// stands, and can be analysed.
    #[test]
    fn winches_become_a_robot_that_stands() {
        let robots: [&[[f64; 2]]; 8] = [
            &[[-10.0, 5.0], [10.0, 5.0], [-10.0, -5.0], [10.0, -5.0]],
            &[[-1.0, 1.0], [1.0, 1.0], [0.0, -1.0]],
            &[[0.0, -4.0], [5.0, 0.0], [3.0, 5.0], [-3.0, 5.0], [-5.0, 0.0]],
            &[[-4.0, 3.0], [0.0, 3.0], [4.0, 3.0]],
            &[[-0.5, 0.8], [0.5, 0.8], [-0.5, 0.0], [0.5, 0.0]],
            &[[-100.0, 60.0], [100.0, 60.0], [-100.0, 0.0], [100.0, 0.0]],
            &[[990.0, 5.0], [1010.0, 5.0], [990.0, -5.0], [1010.0, -5.0]],
            &[[-2.0, 0.0], [2.0, 0.0], [2.0, 2.0], [-2.0, 2.0], [0.0, 3.0], [0.0, -2.0], [4.0, 1.0], [-4.0, 1.0]],
        ];
        for points in robots {
            let scenario = from_winches(points).unwrap_or_else(|reason| panic!("{points:?}: {reason}"));
            let anchors: Vec<[f64; 2]> = scenario.cables.iter().map(|cable| cable.anchor).collect();
            assert_eq!(anchors, points);
            let (robot, motion) = scenario.to_robot().expect("physical");
            assert!(LocalProblem::new(&robot, &motion).is_ok(), "{points:?}");
        }
    }

    #[test]
    fn the_upper_corners_hold_and_the_platform_stands_in_the_middle() {
        let scenario = from_winches(&[[-10.0, -5.0], [10.0, -5.0], [10.0, 5.0], [-10.0, 5.0]]).expect("a robot");
        let held: Vec<usize> = (0..4).filter(|&i| scenario.cables[i].tension == TensionLaw::Equilibrium).collect();
        assert_eq!((held, scenario.motion.position), (vec![2, 3], [0.0, 0.0]));
        assert!((scenario.motion.speed - 5.0).abs() < 1e-12);
    }

    #[test]
    fn what_cannot_be_is_told() {
        for (points, part) in [
            (&[][..], "a list of 0"),
            (&[[0.0, 1.0], [1.0, 1.0]], "a list of 2"),
            (&[[0.0, 1.0], [1.0, 1.0], [0.0, 1.0]], "cables[2].anchor"),
            // Two winches above each other: no direction in which to hold.
            (&[[0.0, 0.0], [0.0, 1.0], [0.0, 2.0]], "no pose was found"),
        ] {
            let reason = from_winches(points).expect_err("no robot").to_string();
            assert!(reason.contains(part), "{points:?}: {reason}");
        }
    }
}
