//! What the integration tests share: reading reference files, and comparisons that print both sides.
#![allow(dead_code, reason = "every test file takes only what it needs")]

pub mod dense;
pub mod hung;
pub mod judge;
pub mod random;
pub mod referee;
pub mod shell;
pub mod statics;

use std::fmt::Display;
use std::path::{Path, PathBuf};

use nalgebra::Complex;
use serde_json::Value;
use tautline::scenario::Scenario;
use tautline::stability::Eigenproblem;
use tautline::{LocalProblem, Motion, Robot};

/// Fails unless |actual − expected| ≤ tolerance; NaN and infinity fail on either side.
#[track_caller]
pub fn close(actual: f64, expected: f64, tolerance: f64, what: impl Display) {
    assert!(tolerance.is_finite(), "{what}: the tolerance is {tolerance}");
    let error = (actual - expected).abs();
    assert!(error <= tolerance, "{what}: {actual:e}, expected {expected:e}: off by {error:e}, allowed {tolerance:e}");
}

/// The two cables that hold a platform which is a point.
pub fn pair(robot: &Robot) -> [usize; 2] {
    robot.equilibrium().try_into().expect("two cables")
}

/// The crate's dense solver for the same problem.
pub fn eigenproblem(local: &LocalProblem) -> Eigenproblem {
    Eigenproblem::new(&local.vibration).expect("a problem")
}

/// The largest modulus.
pub fn largest(values: &[Complex<f64>]) -> f64 {
    values.iter().map(|l| l.norm()).fold(0.0, f64::max)
}

/// Fails unless the two lists are equal up to order: a pairing exists whose partners differ by at most `tolerance`.
#[track_caller]
pub fn same_multiset(actual: &[Complex<f64>], expected: &[Complex<f64>], tolerance: f64, what: impl Display) {
    assert!(tolerance.is_finite(), "{what}: the tolerance is {tolerance}");
    assert_eq!(actual.len(), expected.len(), "{what}: the numbers of values differ");
    if let Some(j) = unmatched(actual, expected, &vec![tolerance; expected.len()]) {
        let value = expected[j];
        let nearest = actual.iter().map(|a| (a - value).norm()).fold(f64::INFINITY, f64::min);
        panic!("{what}: nothing left for the expected {value} (nearest {nearest:e}, allowed {tolerance:e})");
    }
}

/// The first expected value for which no pairing leaves a partner within what is `allowed` for it.
///
/// Pairing each value with its nearest neighbour would not do: in a cluster the nearest may be wanted by another.
pub fn unmatched(actual: &[Complex<f64>], expected: &[Complex<f64>], allowed: &[f64]) -> Option<usize> {
    let near = |i: usize, j: usize| (actual[i] - expected[j]).norm() <= allowed[j];
    let mut partner = vec![None; actual.len()];
    (0..expected.len()).find(|&j| !place(j, &near, &mut partner, &mut vec![false; actual.len()]))
}

/// Gives the expected value `j` a partner, moving others to theirs where needed (Kuhn's algorithm).
fn place(j: usize, near: &impl Fn(usize, usize) -> bool, partner: &mut [Option<usize>], tried: &mut [bool]) -> bool {
    for i in 0..partner.len() {
        if near(i, j) && !tried[i] {
            tried[i] = true;
            if partner[i].is_none_or(|other| place(other, near, partner, tried)) {
                partner[i] = Some(j);
                return true;
            }
        }
    }
    false
}

/// The files in tests/reference whose names begin with `prefix`, in order.
pub fn reference_files(prefix: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference");
    let entries = std::fs::read_dir(folder).expect("the folder of reference files");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("a folder entry").path()).collect();
    files.retain(|file| name(file).starts_with(prefix) && file.extension().is_some_and(|end| end == "json"));
    files.sort();
    files
}

/// A file's name.
pub fn name(file: &Path) -> &str {
    file.file_name().and_then(|name| name.to_str()).expect("a file name in UTF-8")
}

/// Reads a JSON file.
pub fn read(file: &Path) -> Value {
    let text = std::fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// A number.
#[track_caller]
pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

/// A list of numbers.
#[track_caller]
pub fn numbers(value: &Value) -> Vec<f64> {
    list(value).iter().map(number).collect()
}

/// A list.
#[track_caller]
pub fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap_or_else(|| panic!("{value} is not a list"))
}

/// A list of `N` numbers.
#[track_caller]
pub fn coordinates<const N: usize>(value: &Value) -> [f64; N] {
    numbers(value).try_into().unwrap_or_else(|_| panic!("{value} is not a list of {N} numbers"))
}

/// The robot and its motion in a scenario of the format `tautline/scenario/1`.
pub fn scenario(value: &Value) -> (Robot, Motion) {
    let scenario = Scenario::from_json(&value.to_string()).expect("a scenario");
    scenario.to_robot().expect("a physical scenario")
}
