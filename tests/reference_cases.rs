//! Whole robots against the reference files, which were not computed with this crate (tests/reference/README.md).
//!
//! The tolerances are those the README states and explains: they are set by the finite differences behind the
//! `case_*` files, not by this crate.

mod common;

use std::path::Path;

use common::{
    close, coordinates, eigenproblem, largest, list, name, number, read, reference_files, same_multiset, scenario,
};
use nalgebra::Complex;
use serde_json::Value;
use tautline::Robot;
use tautline::mechanics::{Statics, StaticsError};
use tautline::robot::{Damping, RobotSpec};
use tautline::stability::{Critical, CriticalSearch, Instability, Method, Outcome};
use tautline::study::LocalProblem;

/// Lengths and tensions, relative; nodes, of the longest cable.
const STATICS: f64 = 1e-8;
/// L', which has no unit.
const LENGTH_RATE: f64 = 1e-7;
/// L'' times the longest cable.
const LENGTH_CURVATURE: f64 = 1e-5;
/// Eigenvalues, of the largest modulus.
const EIGENVALUE: f64 = 1e-6;
/// Critical speed in m/s, and its frequency in Hz.
const CRITICAL: f64 = 1e-3;

/// The 24 cases, in two halves so that two threads can share them.
#[test]
fn four_cable_robots() {
    let files = reference_files("case_0");
    assert_eq!(files.len(), 10);
    for file in files {
        check_case(&file, &[Method::Structured]);
    }
}

#[test]
fn four_cable_robots_continued() {
    let files = [reference_files("case_1"), reference_files("case_2")].concat();
    assert_eq!(files.len(), 14);
    for file in files {
        check_case(&file, &[Method::Structured]);
    }
}

#[test]
fn what_the_four_cable_robots_do_not_cover() {
    let files = reference_files("extra_");
    assert_eq!(files.len(), 18);
    for file in files {
        check_case(&file, &[Method::Structured, Method::Dense]);
    }
}

/// Cables of different materials and strain laws. Two cases come from a program that shares nothing with `oracle.py`, which
/// made the others.
#[test]
fn robots_whose_cables_have_materials_of_their_own() {
    let files = reference_files("own_");
    assert_eq!(files.len(), 4);
    for file in files {
        check_case(&file, &[Method::Structured, Method::Dense]);
        let case = read(&file);
        let (robot, motion) = scenario(&case["scenario"]);
        assert!(robot.cables.iter().any(|cable| !cable.own.is_empty()), "{}", name(&file));
        let Some(lowest) = case["expected"]["undamped_omega_squared"].as_array() else { continue };
        let damping = Damping { alpha: 0.0, beta: 0.0 };
        let undamped = Robot::new(RobotSpec { damping, ..(*robot).clone() }).expect("a physical robot");
        let spectrum =
            LocalProblem::new(&undamped, &motion).expect("an equilibrium").spectrum(0.0).expect("eigenvalues");
        let mut squares: Vec<f64> = spectrum.eigenvalues().filter(|l| l.im > 0.0).map(|l| l.im * l.im).collect();
        squares.sort_by(f64::total_cmp);
        for (k, (square, expected)) in squares.into_iter().zip(lowest).enumerate() {
            let expected = number(expected);
            close(square, expected, EIGENVALUE * expected, format_args!("{}: square {k}", name(&file)));
        }
    }
}

#[test]
fn infeasible_poses_name_the_cable() {
    let files = reference_files("infeasible_");
    assert_eq!(files.len(), 4);
    for file in files {
        let case = read(&file);
        let (robot, motion) = scenario(&case["scenario"]);
        let failure = LocalProblem::new(&robot, &motion).expect_err(name(&file));
        let StaticsError::Infeasible(reason) = failure.reason else {
            panic!("{}: {}", name(&file), failure.reason);
        };
        let cable = failure.reason.cable().expect("a cable to blame") + 1;
        assert_eq!(case["expected"]["cable"], cable, "{}: {reason}", name(&file));
    }
}

/// Checks all of a case, the critical speed by each of `methods`.
fn check_case(file: &Path, methods: &[Method]) {
    let case = read(file);
    let (name, expected) = (name(file), &case["expected"]);
    let (robot, motion) = scenario(&case["scenario"]);
    let local = LocalProblem::new(&robot, &motion).unwrap_or_else(|failure| panic!("{name}: {failure}"));

    check_cables(name, &local, list(&expected["cables"]));

    let eigenvalues: Vec<Complex<f64>> = list(&expected["eigenvalues"])
        .iter()
        .map(|pair| coordinates::<2>(pair))
        .map(|[re, im]| Complex::new(re, im))
        .collect();
    let allowed = EIGENVALUE * largest(&eigenvalues);
    let growth = number(&expected["max_growth_rate"]);
    let spectra = [local.spectrum(motion.speed()), eigenproblem(&local).spectrum(motion.speed())];
    for (spectrum, by) in spectra.into_iter().zip(["by structure", "dense"]) {
        let spectrum = spectrum.expect(name);
        let actual: Vec<_> = spectrum.eigenvalues().collect();
        same_multiset(&actual, &eigenvalues, allowed, format_args!("{name}: eigenvalues, {by}"));
        close(spectrum.growth_rate(), growth, allowed, format_args!("{name}: largest growth rate, {by}"));
    }

    let limit = number(&expected["searched_up_to"]);
    for &method in methods {
        let outcome = CriticalSearch::by(method, limit).run(&local.vibration).expect(name);
        match (outcome, &expected["critical"]) {
            (Outcome::NoneUpTo(searched), Value::Null) => close(searched, limit, 0.0, "the end of the search"),
            (Outcome::Found(critical), expected) if expected.is_object() => check_critical(name, &critical, expected),
            (outcome, expected) => panic!("{name}: {outcome:?} by {method:?}, expected {expected}"),
        }
    }
}

fn check_cables(name: &str, local: &LocalProblem, expected: &[Value]) {
    let LocalProblem { statics: Statics { cables, .. }, rates, .. } = local;
    assert_eq!(cables.len(), expected.len(), "{name}: number of cables");
    let longest = expected.iter().map(|cable| number(&cable["unstretched_length"])).fold(0.0, f64::max);
    for (i, ((shape, rate), expected)) in cables.iter().zip(rates).zip(expected).enumerate() {
        let check = |key: &str, actual: f64, tolerance: f64, relative: bool| {
            let value = number(&expected[key]);
            let allowed = if relative { tolerance * value.abs() } else { tolerance };
            close(actual, value, allowed, format_args!("{name}: {key} of cable {}", i + 1));
        };
        check("unstretched_length", shape.length, STATICS, true);
        check("tension_at_platform", shape.tension_at_platform, STATICS, true);
        check("tension_at_winch", shape.tension_at_winch, STATICS, true);
        check("length_rate", rate.first, LENGTH_RATE, false);
        check("length_curvature", rate.second, LENGTH_CURVATURE / longest, false);
        let nodes = list(&expected["nodes"]);
        assert_eq!(shape.nodes.len(), nodes.len(), "{name}: nodes of cable {}", i + 1);
        for (k, (node, expected)) in shape.nodes.iter().zip(nodes).enumerate() {
            let expected = coordinates::<2>(expected);
            for j in 0..2 {
                let what = format_args!("{name}: coordinate {j} of node {k} of cable {}", i + 1);
                close(node[j], expected[j], STATICS * longest, what);
            }
        }
    }
}

fn check_critical(name: &str, critical: &Critical, expected: &Value) {
    close(critical.speed, number(&expected["speed"]), CRITICAL, format_args!("{name}: critical speed"));
    let frequency = number(&expected["frequency_hz"]);
    // The case files give a frequency of 0 for divergence, and no kind.
    let kind = expected["kind"].as_str().unwrap_or(if frequency == 0.0 { "divergence" } else { "flutter" });
    let actual = match critical.kind {
        Instability::Flutter => "flutter",
        Instability::Divergence => "divergence",
    };
    assert_eq!(actual, kind, "{name}: kind");
    // At a critical speed of 0 every mode crosses: frequency and cable are a convention there.
    if critical.speed > 0.0 {
        close(critical.frequency_hz(), frequency, CRITICAL, format_args!("{name}: critical frequency"));
        if let Some(cable) = expected["cable"].as_u64() {
            assert_eq!(critical.cable as u64 + 1, cable, "{name}: cable");
        }
    }
}
