//! Statics all over the workspace: every pose has a shape or a reason, both are right, and shapes change continuously.

mod common;

use common::close;
use common::hung::{self, Hung};
use common::random::{config, robot};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use tautline::Robot;
use tautline::mechanics::{self, CableShape, Failure, Infeasible, LengthRates, Statics, StaticsError, length_rates};
use tautline::robot::{TensionLaw, Vec2, paper};

/// The force with which the equilibrium cables have to pull together.
fn load<'a>(robot: &Robot, prescribed: impl Iterator<Item = &'a CableShape>) -> Vec2 {
    let law = Hung::of(robot);
    let own_weight = Vec2::new(0.0, robot.platform_mass * robot.gravity);
    prescribed.fold(own_weight, |load, shape| load - law.platform_force(shape))
}

/// The tensions of the equilibrium cables if they were straight, by Cramer's rule.
fn straight_tensions(robot: &Robot, platform: Vec2, load: Vec2) -> [f64; 2] {
    let [a, b] = robot.pair().map(|i| (robot.cables[i].anchor - platform).normalize());
    let determinant = a.x * b.y - a.y * b.x;
    [(load.x * b.y - load.y * b.x) / determinant, (a.x * load.y - a.y * load.x) / determinant]
}

/// Checks a pose's verdict by the rule of docs/theory.md section 5; listing all shapes is slow, so only if `thorough`.
fn check_verdict(robot: &Robot, platform: Vec2, found: &Result<Statics, Failure>, thorough: bool) {
    let law = Hung::of(robot);
    let chord = |i: usize| robot.cables[i].anchor - platform;
    let failure = match found {
        Ok(statics) => {
            let load = load(robot, robot.prescribed().map(|i| &statics.cables[i]));
            let tensions = straight_tensions(robot, platform, load);
            assert!(tensions[0] > 0.0 && tensions[1] > 0.0, "{platform:?} has a shape, with {tensions:?}");
            return;
        }
        Err(failure) => failure,
    };
    let StaticsError::Infeasible(reason) = failure.reason else {
        panic!("{failure} at {platform:?} of {robot:?}");
    };
    let load =
        || load(robot, robot.prescribed().map(|i| failure.cables[i].as_ref().expect("a prescribed cable's shape")));
    match reason {
        Infeasible::AtAnchor { cable } => close(chord(cable).norm(), 0.0, 1e-9, "distance from the anchor"),
        Infeasible::NoTension { tension, .. } => assert!(tension <= 0.0, "{tension} N at {platform:?}"),
        Infeasible::TooSlack { cable, tension } => {
            assert!(robot.cables[cable].tension != TensionLaw::Equilibrium);
            let curve = if thorough { law.curve(chord(cable)) } else { Vec::new() };
            let least = curve.iter().map(|(_, force)| force.norm()).fold(f64::INFINITY, f64::min);
            assert!(least > tension, "{tension} N at {platform:?}: a cable can have {least} N");
        }
        Infeasible::WouldPush { cable, tension } => {
            let tensions = straight_tensions(robot, platform, load());
            let weakest = usize::from(tensions[1] < tensions[0]);
            assert_eq!(cable, robot.pair()[weakest], "{tensions:?} at {platform:?}");
            assert!(tension <= 0.0, "{tensions:?} at {platform:?}");
            let size = tensions[0].abs() + tensions[1].abs();
            close(tension, tensions[weakest], 1e-9 * size, "the tension of the cable that would push");
        }
        Infeasible::OneLine { .. } => {
            let [a, b] = robot.pair().map(|i| chord(i).normalize());
            close(a.perp(&b), 0.0, 1e-6, "sine of the angle between the two cables");
        }
        Infeasible::GoesSlack { cable } => {
            assert!(robot.pair().contains(&cable));
            let tensions = straight_tensions(robot, platform, load());
            assert!(tensions[0] > 0.0 && tensions[1] > 0.0, "{tensions:?} at {platform:?}");
            if thorough {
                let curves = robot.pair().map(|i| law.curve(chord(i)));
                let shapes = hung::crossings(&curves, load());
                assert!(shapes.is_empty(), "{reason} at {platform:?}, but there is {shapes:?}");
            }
        }
    }
}

/// A pose that has a shape, with the length rates along `direction`.
struct Pose {
    position: Vec2,
    statics: Statics,
    rates: Vec<LengthRates>,
}

fn pose(robot: &Robot, position: Vec2, direction: Vec2) -> Option<Pose> {
    let statics = mechanics::solve(robot, position).ok()?;
    let rates = length_rates(robot, &statics, direction).expect("length rates");
    Some(Pose { position, statics, rates })
}

/// Fails if lengths jump between two poses: L(b) − L(a) is the trapezium of L' but for h³/12 of L''', taken here to be
/// less than 1/3 of L''/h. Where it is not, the middle is looked at; a jump does not vanish by that, however often.
fn check_continuous(robot: &Robot, a: &Pose, b: &Pose, halvings: u32) {
    let step = b.position - a.position;
    let h = step.norm();
    let smooth = (0..robot.cables.len()).all(|i| {
        let change = b.statics.cables[i].length - a.statics.cables[i].length;
        let expected = 0.5 * h * (a.rates[i].first + b.rates[i].first);
        let bound = 0.25 * h * h * a.rates[i].second.abs().max(b.rates[i].second.abs()).max(1e-3);
        (change - expected).abs() <= bound
    });
    if !smooth {
        assert!(halvings > 0, "lengths jump between {:?} and {:?} of {robot:?}", a.position, b.position);
        // Without a shape in the middle the two poses belong to different parts of the workspace.
        if let Some(middle) = pose(robot, a.position + 0.5 * step, step / h) {
            check_continuous(robot, a, &middle, halvings - 1);
            check_continuous(robot, &middle, b, halvings - 1);
        }
    }
}

/// Checks a grid of poses from corner to corner, every `thorough`-th of the infeasible ones thoroughly; how many poses
/// have a shape.
fn check_grid(robot: &Robot, corners: [Vec2; 2], columns: u32, rows: u32, thorough: u32) -> u32 {
    let size = corners[1] - corners[0];
    let at = |i: u32, j: u32| {
        let part = Vec2::new(f64::from(i) / f64::from(columns - 1), f64::from(j) / f64::from(rows - 1));
        corners[0] + size.component_mul(&part)
    };
    let (mut feasible, mut infeasible) = (0, 0);
    for j in 0..rows {
        for i in 0..columns {
            let position = at(i, j);
            let found = mechanics::solve(robot, position);
            check_verdict(robot, position, &found, infeasible % thorough == 0);
            if found.is_err() {
                infeasible += 1;
                continue;
            }
            feasible += 1;
            for (next, direction) in [((i + 1, j), Vec2::x()), ((i, j + 1), Vec2::y())] {
                if next.0 < columns && next.1 < rows {
                    let ends = [position, at(next.0, next.1)].map(|position| pose(robot, position, direction));
                    if let [Some(a), Some(b)] = ends {
                        check_continuous(robot, &a, &b, 12);
                    }
                }
            }
        }
    }
    feasible
}

#[test]
fn every_pose_of_the_papers_robot_has_a_shape_or_a_right_reason() {
    let robot = paper().expect("the paper's robot");
    let feasible = check_grid(&robot, [Vec2::new(-10.0, -5.0), Vec2::new(10.0, 5.0)], 81, 41, 1);
    assert!(feasible > 1000, "only {feasible} poses have a shape");
}

/// docs/theory.md section 5: at y = 0 an upper cable would have to push beyond |x| = 7.4897.
#[test]
fn the_papers_robot_ends_where_the_theory_says() {
    let robot = paper().expect("the paper's robot");
    for millimetres in -9990..=9990 {
        let x = f64::from(millimetres) / 1000.0;
        let found = mechanics::solve(&robot, Vec2::new(x, 0.0));
        if x.abs() < 7.4897 - 1e-3 {
            assert!(found.is_ok(), "x = {x}: {}", found.unwrap_err());
        } else if x.abs() > 7.4897 + 1e-3 {
            let reason = found.expect_err("no shape").reason;
            let cable = usize::from(x < 0.0);
            let right =
                matches!(reason, StaticsError::Infeasible(Infeasible::WouldPush { cable: c, .. }) if c == cable);
            assert!(right, "x = {x}: {reason}");
        }
    }
}

#[test]
fn every_pose_of_random_robots_has_a_shape_or_a_right_reason() {
    let mut runner = TestRunner::new(config(1));
    let mut feasible = 0;
    for _ in 0..20 {
        let robot = robot(2..25).new_tree(&mut runner).expect("a robot").current();
        feasible += check_grid(&robot, [Vec2::new(-12.0, -7.0), Vec2::new(12.0, 7.0)], 61, 31, 101);
    }
    assert!(feasible > 1000, "only {feasible} poses have a shape");
}
