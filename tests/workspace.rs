//! Statics all over the workspace: every pose has a shape or a reason, both are right, and shapes change continuously.

mod common;

use common::random::{config, robot};
use common::statics::{check_continuous, check_verdict, pose};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use tautline::Robot;
use tautline::mechanics::{self, Infeasible, StaticsError};
use tautline::robot::{Vec2, paper};

/// Checks a grid of poses from corner to corner; every `thorough`-th of the infeasible ones is checked thoroughly. Gives how
/// many poses have a shape.
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
