//! Memory: a value of the characteristic function takes none, and the largest robots take little.

use nalgebra::Complex;
use tautline::robot::{Cable, Linearisation, RobotSpec, TensionLaw, paper_spec};
use tautline::stability::{Characteristic, Outcome, unstable_eigenvalues};
use tautline::{LocalProblem, Motion, Robot};

#[global_allocator]
static ALLOCATOR: dhat::Alloc = dhat::Alloc;

/// The paper's robot with `cables` cables and tangent stiffness. Cables beyond its own four have constant tensions.
fn robot(elements: usize, cables: usize) -> Robot {
    let mut spec = RobotSpec { elements, linearisation: Linearisation::Tangent, ..paper_spec() };
    for (k, tension) in (spec.cables.len()..cables).zip([60.0, 65.0, 70.0, 75.0]) {
        let side = if k % 2 == 0 { -1.0 } else { 1.0 };
        spec.cables.push(Cable::new([side * k as f64, -6.0], TensionLaw::Constant(tension)));
    }
    Robot::new(spec).expect("a robot")
}

/// One test, since the counters are those of the whole process.
#[test]
fn the_search_takes_no_memory_per_value_and_little_in_all() {
    let _counters = dhat::Profiler::builder().testing().build();
    let motion = Motion::new([0.0, 0.0], [1.0, 0.0], 5.0).expect("a motion");

    let local = LocalProblem::new(&robot(10, 4), &motion).expect("a feasible pose");
    let function = Characteristic::new(&local.vibration);
    // The test harness has threads that allocate as well. Memory that a value needs would be allocated every time.
    let least = (0..20).map(|_| {
        let before = dhat::HeapStats::get().total_blocks;
        let values = (0..1000).map(|k| function.at(Complex::new(0.0, 0.02 * f64::from(k)), 8.0).by_lambda.norm());
        let sum: f64 = values.sum();
        assert!(sum.is_finite() && sum > 0.0, "{sum}");
        dhat::HeapStats::get().total_blocks - before
    });
    assert_eq!(least.min(), Some(0), "blocks for 1000 values");

    let local = LocalProblem::new(&robot(200, 8), &motion).expect("a feasible pose");
    let outcome = local.critical_speed(40.0).expect("a critical speed");
    let Outcome::Found(critical) = outcome else { panic!("{outcome:?}") };
    assert_eq!(unstable_eigenvalues(&local.vibration, critical.speed * 0.999), Some(0), "{critical:?}");
    let peak = dhat::HeapStats::get().max_bytes;
    assert!(peak < 50_000_000, "{peak} bytes");
    println!("at most {:.1} MB for 200 elements and 8 cables", peak as f64 / 1e6);
}
