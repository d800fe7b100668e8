//! What a critical speed and a spectrum cost, by structure and by dense eigenvalue solvers: `cargo bench`.
//!
//! `*_faer` are scans by the dense eigenvalue solver of faer, on one thread. They use only the structure that their names
//! tell. `cargo bench --bench ratios` prints the ratios.
#![allow(missing_docs, reason = "benchmarks are named after what they measure")]

#[path = "../tests/common/mod.rs"]
mod common;

use std::hint::black_box;

use common::referee::Referee;
use divan::Bencher;
use tautline::robot::{Linearisation, RobotSpec, paper_spec};
use tautline::stability::{CriticalSearch, Method, SCAN_STEP};
use tautline::{LocalProblem, Motion, Robot};

const LIMIT: f64 = 40.0;
/// The speed of the spectra, in m/s.
const SPEED: f64 = 5.0;

fn main() {
    divan::main();
}

fn paper(linearisation: Linearisation, elements: usize) -> Robot {
    Robot::new(RobotSpec { elements, linearisation, ..paper_spec() }).expect("a physical robot")
}

fn local(robot: &Robot, x: f64) -> LocalProblem {
    let motion = Motion::new([x, 0.0], [1.0, 0.0], SPEED).expect("a motion");
    LocalProblem::new(robot, &motion).expect("a feasible pose")
}

/// The paper's robot at the origin.
fn at_origin(linearisation: Linearisation, elements: usize) -> (Robot, LocalProblem) {
    let robot = paper(linearisation, elements);
    let local = local(&robot, 0.0);
    (robot, local)
}

/// Its referee: of all unknowns, or of one direction if both are the same problem.
fn referee(linearisation: Linearisation, elements: usize, whole: bool) -> Referee {
    let (robot, local) = at_origin(linearisation, elements);
    let new = if whole { Referee::without_structure } else { Referee::new };
    new(&robot, &local.statics, &local.rates)
}

mod critical_speed {
    use super::{Bencher, CriticalSearch, LIMIT, Linearisation, Method, SCAN_STEP, at_origin, referee};

    fn structured(bencher: Bencher, linearisation: Linearisation, elements: usize) {
        let (_, local) = at_origin(linearisation, elements);
        bencher.bench(|| local.critical_speed(LIMIT));
    }

    /// The crate's own scan.
    fn dense(bencher: Bencher, linearisation: Linearisation, elements: usize) {
        let (_, local) = at_origin(linearisation, elements);
        bencher.bench(|| CriticalSearch::by(Method::Dense, LIMIT).run(&local.vibration));
    }

    fn faer(bencher: Bencher, linearisation: Linearisation, elements: usize, whole: bool) {
        let referee = referee(linearisation, elements, whole);
        bencher.bench(|| referee.scan(SCAN_STEP, LIMIT));
    }

    #[divan::bench(args = [10, 20, 40, 80])]
    fn structured_tangent(bencher: Bencher, elements: usize) {
        structured(bencher, Linearisation::Tangent, elements);
    }

    #[divan::bench(args = [10, 20, 40, 80])]
    fn structured_secant(bencher: Bencher, elements: usize) {
        structured(bencher, Linearisation::Secant, elements);
    }

    /// Longer meshes take minutes.
    #[divan::bench(args = [10], sample_count = 3)]
    fn dense_tangent(bencher: Bencher, elements: usize) {
        dense(bencher, Linearisation::Tangent, elements);
    }

    #[divan::bench(args = [10, 20], sample_count = 3)]
    fn dense_secant(bencher: Bencher, elements: usize) {
        dense(bencher, Linearisation::Secant, elements);
    }

    #[divan::bench(args = [10], sample_count = 5)]
    fn dense_tangent_faer(bencher: Bencher, elements: usize) {
        faer(bencher, Linearisation::Tangent, elements, true);
    }

    /// One whole scan, which takes a quarter of a minute.
    #[divan::bench(args = [40], sample_count = 1, sample_size = 1)]
    fn dense_tangent_faer_long(bencher: Bencher, elements: usize) {
        faer(bencher, Linearisation::Tangent, elements, true);
    }

    #[divan::bench(args = [10], sample_count = 5)]
    fn dense_secant_one_direction_faer(bencher: Bencher, elements: usize) {
        faer(bencher, Linearisation::Secant, elements, false);
    }

    /// As one would write it without knowing that x and y decouple.
    #[divan::bench(args = [10], sample_count = 5)]
    fn dense_secant_both_directions_faer(bencher: Bencher, elements: usize) {
        faer(bencher, Linearisation::Secant, elements, true);
    }
}

mod spectrum {
    use super::{Bencher, Linearisation, SPEED, at_origin, black_box, referee};

    #[divan::bench(args = [10, 20, 40], sample_count = 10)]
    fn structured_tangent(bencher: Bencher, elements: usize) {
        let (_, local) = at_origin(Linearisation::Tangent, elements);
        bencher.bench(|| local.spectrum(black_box(SPEED)));
    }

    #[divan::bench(args = [10, 20, 40], sample_count = 5)]
    fn dense_tangent_faer(bencher: Bencher, elements: usize) {
        let referee = referee(Linearisation::Tangent, elements, true);
        bencher.bench(|| referee.eigenvalues(black_box(SPEED)));
    }
}

/// One frame of a drag without the interface: statics, spectrum and critical speed of a pose.
#[divan::bench(args = [Linearisation::Secant, Linearisation::Tangent])]
fn drag_frame(bencher: Bencher, linearisation: Linearisation) {
    let robot = paper(linearisation, 10);
    bencher.bench(|| {
        let local = local(&robot, black_box(1.0));
        let spectrum = local.spectrum(SPEED);
        (spectrum, local.critical_speed(LIMIT))
    });
}
