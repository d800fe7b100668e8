//! The wave limit against numbers of an independent program, and against the shapes and rates of the reference cases.

#![cfg(feature = "scenario")]

mod common;

use common::{coordinates, list, number, read, scenario};
use std::path::Path;

use serde_json::Value;
use tautline::robot::{RobotSpec, paper_spec};
use tautline::{LocalProblem, Motion, Robot};

fn reference(name: &str) -> Value {
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/reference/{name}.json")))
}

fn wave_limit(robot: &Robot, motion: &Motion) -> (f64, usize, bool) {
    let local = LocalProblem::new(robot, motion).map_err(|failure| failure.reason).expect("a pose");
    let limit = local.wave_limit.expect("a limit");
    (limit.speed, limit.cable, limit.reeled_in)
}

#[test]
fn wave_limits_are_those_of_an_independent_program() {
    let known = reference("wave_limits");
    let check = |found: f64, entry: &Value| {
        let digits = i32::try_from(entry["digits"].as_i64().expect("digits")).expect("few");
        let allowed = 0.5 * 10.0_f64.powi(-digits);
        assert!((found - number(&entry["speed"])).abs() <= allowed, "{found}, not {entry}");
    };
    for entry in list(&known["paper"]) {
        let elements = usize::try_from(entry["elements"].as_u64().expect("elements")).expect("few");
        let robot = Robot::new(RobotSpec { elements, ..paper_spec() }).expect("a robot");
        let motion = Motion::new([number(&entry["x"]), 0.0], [1.0, 0.0], 5.0).expect("a motion");
        check(wave_limit(&robot, &motion).0, entry);
    }
    for entry in list(&known["cases"]) {
        let case = reference(entry["case"].as_str().expect("a name"));
        let (robot, motion) = scenario(&case["scenario"]);
        check(wave_limit(&robot, &motion).0, entry);
    }
}

/// From the nodes, lengths and rates of the reference cases: λ is the distance of two nodes over the element's unstretched
/// length, N = N(λ). Nodes that are known to 1e-8 of the longest cable (tests/reference/README.md) leave a part of 2e-8
/// times that over an element's length of λ uncertain, and λ N'(λ)/N as much of N, a half of which is c's.
#[test]
fn wave_limits_follow_from_the_shapes_of_the_reference_cases() {
    // Of cables that reach it together, as in a symmetric pose, either counts but for one that is reeled in.
    let own = ["own_00_point_three_cables", "own_01_point_five_cables", "own_02_mixed_laws_tangent"];
    for name in (0..24).map(|case| format!("case_{case:02}")).chain(own.map(String::from)) {
        let case = reference(&name);
        let (robot, motion) = scenario(&case["scenario"]);
        let cables = list(&case["expected"]["cables"]);
        let longest = cables.iter().map(|cable| number(&cable["unstretched_length"])).fold(0.0, f64::max);
        let (mut least, mut allowed) = (f64::INFINITY, 0.0);
        let mut limits = vec![f64::INFINITY; cables.len()];
        for (i, cable) in cables.iter().enumerate() {
            let nodes: Vec<[f64; 2]> = list(&cable["nodes"]).iter().map(coordinates::<2>).collect();
            let (material, mu) = (tautline::mechanics::Material::of(&robot, i), robot.material_of(i).mass_per_length);
            let elements = (nodes.len() - 1) as f64;
            let (l, rate) = (number(&cable["unstretched_length"]) / elements, number(&cable["length_rate"]));
            for (k, ends) in nodes.windows(2).enumerate() {
                let stretch = (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1]) / l;
                let force = material.force(stretch);
                let wave = (force / (stretch * mu)).sqrt();
                let speed = wave / (rate.abs() * (k + 1) as f64 / elements);
                limits[i] = limits[i].min(speed);
                if speed < least {
                    least = speed;
                    allowed = speed * 1e-8 * longest / l * (stretch * material.tangent(stretch) / force);
                }
            }
        }
        let found = wave_limit(&robot, &motion);
        assert!((found.0 - least).abs() <= allowed, "{name}: {found:?}, not {least} ± {allowed:e}");
        assert!(allowed < 1e-2 * least, "{name}: {allowed} says nothing about {least}");
        let first: Vec<usize> = (0..limits.len()).filter(|&i| limits[i] <= least + 2.0 * allowed).collect();
        let is_reeled_in = |i: usize| number(&cables[i]["length_rate"]) < 0.0;
        assert!(first.contains(&found.1) && found.2 == is_reeled_in(found.1), "{name}: {found:?} of {first:?}");
        assert!(found.2 || !first.iter().any(|&i| is_reeled_in(i)), "{name}: {found:?} of {first:?}");
    }
}
