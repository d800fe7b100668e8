//! `cargo bench --bench ratios` prints tables: how many times slower a dense scan is than the structured search, how the
//! search's cost grows with the mesh, and what a frame of a drag costs.
//!
//! The two sides of a comparison take turns, so that a machine's other work and its clock slow both. Medians are compared.
#![allow(missing_docs, reason = "a program")]

#[path = "../tests/common/mod.rs"]
mod common;

use std::hint::black_box;
use std::time::Instant;

use common::referee::Referee;
use tautline::robot::{Linearisation, RobotSpec, paper_spec};
use tautline::stability::{Outcome, Polarisation, SCAN_STEP, mode};
use tautline::{LocalProblem, Motion, Robot};

const LIMIT: f64 = 40.0;
/// The speed of the spectra, in m/s.
const SPEED: f64 = 5.0;
/// Both ways must come to the same critical speed, in m/s.
const AGREEMENT: f64 = 1e-6;

fn paper(linearisation: Linearisation, elements: usize) -> Robot {
    Robot::new(RobotSpec { elements, linearisation, ..paper_spec() }).expect("a physical robot")
}

fn local(robot: &Robot, x: f64) -> LocalProblem {
    let motion = Motion::new([x, 0.0], [1.0, 0.0], SPEED).expect("a motion");
    LocalProblem::new(robot, &motion).expect("a feasible pose")
}

/// The time of one call, in s.
fn time<T>(task: impl FnOnce() -> T) -> f64 {
    let begun = Instant::now();
    black_box(task());
    begun.elapsed().as_secs_f64()
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Milliseconds with three digits.
fn ms(seconds: f64) -> String {
    let value = 1e3 * seconds;
    let digits = if value < 10.0 { 2 } else { usize::from(value < 100.0) };
    format!("{value:.digits$}")
}

/// A scan by all eigenvalues against the structured search. The search is repeated before each scan, which takes longer.
fn compare(what: &str, linearisation: Linearisation, elements: usize, whole: bool, rounds: usize) {
    let robot = paper(linearisation, elements);
    let local = local(&robot, 0.0);
    let new = if whole { Referee::without_structure } else { Referee::new };
    let referee = new(&robot, &local.statics, &local.rates);
    let Ok(Outcome::Found(critical)) = local.critical_speed(LIMIT) else { panic!("no critical speed") };
    let (mut by_structure, mut by_scan) = (Vec::new(), Vec::new());
    for _ in 0..rounds {
        by_structure.extend((0..10).map(|_| time(|| local.critical_speed(black_box(LIMIT)))));
        by_scan.push(time(|| {
            let speed = referee.scan(black_box(SCAN_STEP), LIMIT).expect("a critical speed");
            assert!((speed - critical.speed).abs() < AGREEMENT, "{speed} by the scan, {critical:?}");
        }));
    }
    let (fast, slow) = (median(by_structure), median(by_scan));
    let size = referee.size();
    println!("| {what} | {elements} | {size} × {size} | {} | {} | {:.0} |", ms(fast), ms(slow), slow / fast);
}

/// The exponent p of cost ∝ n^p by least squares in logarithms.
fn exponent(meshes: &[usize], times: &[f64]) -> f64 {
    let points = meshes.iter().zip(times).map(|(&n, t)| ((n as f64).ln(), t.ln()));
    let count = meshes.len() as f64;
    let (x, y) = points.clone().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / count, b + y / count));
    let (above, below) = points.fold((0.0, 0.0), |(a, b), (u, v)| (a + (u - x) * (v - y), b + (u - x) * (u - x)));
    above / below
}

fn growth(linearisation: Linearisation) {
    let meshes = [10, 20, 40, 80];
    let locals = meshes.map(|n| local(&paper(linearisation, n), 0.0));
    let mut times = [const { Vec::new() }; 4];
    for _ in 0..21 {
        for (local, times) in locals.iter().zip(&mut times) {
            times.push(time(|| local.critical_speed(black_box(LIMIT))));
        }
    }
    let medians = times.map(median);
    let [a, b, c, d] = medians.map(ms);
    println!("| {linearisation:?} | {a} | {b} | {c} | {d} | {:.2} |", exponent(&meshes, &medians));
}

/// A frame of a drag: all that a new pose needs.
fn frame(linearisation: Linearisation) {
    let robot = paper(linearisation, 10);
    let mut times = [const { Vec::new() }; 5];
    for k in 0..201_u32 {
        // Along the path, so that no two frames are the same.
        let x = f64::from(k) * 0.01 - 1.0;
        let [pose, spectrum, critical, shape, all] = &mut times;
        let begun = Instant::now();
        let local = local(&robot, x);
        let after_pose = begun.elapsed().as_secs_f64();
        let found = local.spectrum(SPEED).expect("a spectrum");
        let after_spectrum = begun.elapsed().as_secs_f64();
        let Ok(Outcome::Found(crossing)) = local.critical_speed(LIMIT) else { panic!("no critical speed") };
        let after_critical = begun.elapsed().as_secs_f64();
        black_box(mode(&local.vibration, crossing.speed, crossing.eigenvalue, Polarisation::default()));
        let end = begun.elapsed().as_secs_f64();
        black_box(found);
        pose.push(after_pose);
        spectrum.push(after_spectrum - after_pose);
        critical.push(after_critical - after_spectrum);
        shape.push(end - after_critical);
        all.push(end);
    }
    let [pose, spectrum, critical, shape, all] = times.map(median).map(ms);
    println!("| {linearisation:?} | {pose} | {spectrum} | {critical} | {shape} | {all} |");
}

fn main() {
    println!(
        "Critical speed of the paper's robot, x = 0, in ms: the structured search, and a scan in steps of 0.1 m/s"
    );
    println!("with faer's eigenvalues of the companion matrix (one thread), then bisection.\n");
    println!("| stiffness | elements per cable | companion | structure | scan | scan/structure |");
    println!("|---|---:|---:|---:|---:|---:|");
    compare("tangent", Linearisation::Tangent, 10, true, 7);
    compare("secant, one direction", Linearisation::Secant, 10, false, 7);
    compare("secant, x and y", Linearisation::Secant, 10, true, 7);
    compare("tangent", Linearisation::Tangent, 40, true, 3);
    println!("\nThe structured search in ms against elements per cable n, and p of time ∝ n^p.\n");
    println!("| stiffness | n = 10 | 20 | 40 | 80 | p |");
    println!("|---|---:|---:|---:|---:|---:|");
    growth(Linearisation::Tangent);
    growth(Linearisation::Secant);
    println!("\nA frame of a drag in ms, n = 10.\n");
    println!("| stiffness | statics and motion | all eigenvalues | critical speed | one mode | together |");
    println!("|---|---:|---:|---:|---:|---:|");
    frame(Linearisation::Tangent);
    frame(Linearisation::Secant);
}
