//! What a critical speed and a spectrum cost, by structure and by the dense solver: `cargo bench`.
#![allow(missing_docs, reason = "benchmarks are named after what they measure")]

use std::hint::black_box;

use divan::Bencher;
use tautline::robot::{Linearisation, RobotSpec, paper_spec};
use tautline::stability::{CriticalSearch, Eigenproblem, Method};
use tautline::{Local, Motion, Robot};

const LIMIT: f64 = 40.0;
/// The speed of the spectra, in m/s.
const SPEED: f64 = 5.0;

fn main() {
    divan::main();
}

fn paper(linearisation: Linearisation, elements: usize) -> Robot {
    Robot::new(RobotSpec { elements, linearisation, ..paper_spec() }).expect("a physical robot")
}

fn local(robot: &Robot, x: f64) -> Local {
    let motion = Motion::new([x, 0.0], [1.0, 0.0], SPEED).expect("a motion");
    Local::new(robot, &motion).expect("a feasible pose")
}

fn search(bencher: Bencher, method: Method, linearisation: Linearisation, elements: usize) {
    let local = local(&paper(linearisation, elements), 0.0);
    bencher.bench(|| CriticalSearch::by(method, LIMIT).run(&local.vibration));
}

mod critical_speed {
    use super::{Bencher, Linearisation, Method, search};

    #[divan::bench(args = [10, 20, 40, 80])]
    fn structured_tangent(bencher: Bencher, elements: usize) {
        search(bencher, Method::Structured, Linearisation::Tangent, elements);
    }

    #[divan::bench(args = [10, 20, 40, 80])]
    fn structured_secant(bencher: Bencher, elements: usize) {
        search(bencher, Method::Structured, Linearisation::Secant, elements);
    }

    /// Longer meshes take minutes.
    #[divan::bench(args = [10], sample_count = 3)]
    fn dense_tangent(bencher: Bencher, elements: usize) {
        search(bencher, Method::Dense, Linearisation::Tangent, elements);
    }

    #[divan::bench(args = [10, 20], sample_count = 3)]
    fn dense_secant(bencher: Bencher, elements: usize) {
        search(bencher, Method::Dense, Linearisation::Secant, elements);
    }
}

mod spectrum {
    use super::{Bencher, Eigenproblem, Linearisation, SPEED, black_box, local, paper};

    #[divan::bench(args = [10, 20, 40], sample_count = 10)]
    fn structured_tangent(bencher: Bencher, elements: usize) {
        let local = local(&paper(Linearisation::Tangent, elements), 0.0);
        bencher.bench(|| local.spectrum(black_box(SPEED)));
    }

    #[divan::bench(args = [10, 20, 40], sample_count = 5)]
    fn dense_tangent(bencher: Bencher, elements: usize) {
        let local = local(&paper(Linearisation::Tangent, elements), 0.0);
        let problem = Eigenproblem::new(&local.vibration).expect("a problem");
        bencher.bench(|| problem.spectrum(black_box(SPEED)));
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
