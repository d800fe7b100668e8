//! Spectra, modes and critical speeds of robots drawn at random.
//!
//! The referee is `common::dense`: full matrices put together from the theory without the crate's elements. Their
//! traces give the sum of all eigenvalues and of their squares, so none can be missing, doubled or invented.

mod common;

use common::dense::Dense;
use common::random::{config, mirrored, moving_robot, statics};
use common::{close, eigenproblem, largest, same_multiset};
use nalgebra::{Complex, DVector, Vector2};
use proptest::prelude::*;
use tautline::mechanics::CableShape;
use tautline::robot::Damping;
use tautline::stability::{CriticalSearch, Method, Mode, Outcome, Polarisation, Sample, Spectrum, mode};
use tautline::{LocalProblem, Motion, Robot};

type C64 = Complex<f64>;

/// The pose's local problem, where there is one.
fn local(robot: &Robot, motion: &Motion) -> Option<LocalProblem> {
    statics(robot, motion.position()).map(|_| LocalProblem::new(robot, motion).expect("what depends on statics"))
}

/// A mode's displacements in the order of [`Dense`].
fn unknowns(mode: &Mode) -> DVector<C64> {
    let platform = mode.displacement[0][0];
    for cable in &mode.displacement {
        assert_eq!(cable[0], platform, "the platform as every cable sees it");
        close(cable[cable.len() - 1].norm(), 0.0, 0.0, "a winch");
    }
    let inner = mode.displacement.iter().flat_map(|cable| &cable[1..cable.len() - 1]);
    let all: Vec<C64> = [&platform].into_iter().chain(inner).flat_map(|d| d.iter().copied()).collect();
    all.into()
}

/// Both roots of λ² + (α + β ω²) λ + ω² = 0, without cancellation where they are real.
fn damped(squared_frequency: f64, damping: Damping) -> [C64; 2] {
    let half = 0.5 * (damping.alpha + damping.beta * squared_frequency);
    let under_root = C64::from(half * half - squared_frequency).sqrt();
    let larger = -(under_root + half);
    [larger, squared_frequency / larger]
}

/// The shares of the kinetic energy are those of the platform and of each cable, whose elements' speeds are linear: by
/// Simpson's rule, which is exact for their squares.
fn check_shares(robot: &Robot, local: &LocalProblem, mode: &Mode) {
    let platform = robot.platform_mass * mode.displacement[0][0].norm_squared();
    let cable = |(i, (nodes, shape)): (usize, (&Vec<Vector2<C64>>, &CableShape))| {
        let mass = robot.material_of(i).mass_per_length * shape.length / robot.elements as f64;
        let element = |pair: &[Vector2<C64>]| {
            let middle = (pair[0] + pair[1]) * C64::from(0.5);
            mass / 6.0 * (pair[0].norm_squared() + 4.0 * middle.norm_squared() + pair[1].norm_squared())
        };
        nodes.windows(2).map(element).sum::<f64>()
    };
    let cables: Vec<f64> = mode.displacement.iter().zip(&local.statics.cables).enumerate().map(cable).collect();
    let total = platform + cables.iter().sum::<f64>();
    close(mode.platform_share, platform / total, 1e-12, "the platform's share of the kinetic energy");
    for (i, (share, energy)) in mode.cable_share.iter().zip(&cables).enumerate() {
        close(*share, energy / total, 1e-12, format_args!("the share of cable {i}"));
    }
}

/// The spectrum is complete, and every eigenvalue has a mode.
fn check_spectrum(robot: &Robot, motion: &Motion, local: &LocalProblem, dense: &Dense, spectrum: &Spectrum) {
    let eigenvalues: Vec<C64> = spectrum.eigenvalues().collect();
    let top = largest(&eigenvalues);

    let nodes = 1 + robot.cables.len() * (robot.elements - 1);
    assert_eq!(eigenvalues.len(), 4 * nodes, "four eigenvalues per node that moves");
    let conjugates: Vec<C64> = eigenvalues.iter().map(Complex::conj).collect();
    same_multiset(&eigenvalues, &conjugates, 1e-14 * top, "eigenvalues against their conjugates");
    let growth = eigenvalues.iter().map(|l| l.re).fold(f64::NEG_INFINITY, f64::max);
    close(spectrum.growth_rate(), growth, 0.0, "the largest growth rate");

    let (sum, sum_of_squares) = dense.moments();
    let squares: Vec<C64> = eigenvalues.iter().map(|l| l * l).collect();
    for (what, values, expected) in [("eigenvalues", &eigenvalues, sum), ("squares", &squares, sum_of_squares)] {
        let (total, size): (C64, f64) = (values.iter().sum(), values.iter().map(|l| l.norm()).sum());
        // A backward stable solver changes the traces by rounding only.
        close((total - expected).norm(), 0.0, 1e-12 * size, format_args!("sum of the {what}"));
    }

    for value in spectrum.modes() {
        for polarisation in [Polarisation::X, Polarisation::Y] {
            let mode = mode(&local.vibration, motion.speed(), value.eigenvalue, polarisation);
            let (residual, slope, size) = dense.residual(value.eigenvalue, &unknowns(&mode));
            // An eigenvalue is known to the rounding of the fastest one. A shape is known to the rounding of the stiffest
            // spring, times the digits that elimination without pivoting loses if the flow makes modes steep.
            let allowed = 1e-12 * top * slope + 1e-9 * size;
            close(residual, 0.0, allowed, format_args!("residual of the mode at {}", value.eigenvalue));
            check_shares(robot, local, &mode);
        }
    }
}

proptest! {
    #![proptest_config(config(80))]

    #[test]
    fn spectra_are_those_of_the_full_matrices((robot, motion) in moving_robot(2..10)) {
        let found = local(&robot, &motion);
        prop_assume!(found.is_some());
        let local = found.unwrap();
        let dense = Dense::new(&robot, &local.statics, &local.rates, motion.speed());
        for spectrum in [local.spectrum(motion.speed()), eigenproblem(&local).spectrum(motion.speed())] {
            check_spectrum(&robot, &motion, &local, &dense, &spectrum.expect("a spectrum"));
        }
    }

    /// At rest the damping is a polynomial of the undamped problem, whose modes stay.
    #[test]
    fn at_rest_eigenvalues_follow_from_the_undamped_ones((robot, motion) in moving_robot(2..10)) {
        let found = local(&robot, &motion);
        prop_assume!(found.is_some());
        let local = found.unwrap();
        let squared = Dense::new(&robot, &local.statics, &local.rates, 0.0).squared_frequencies();
        let expected: Vec<C64> = squared.iter().flat_map(|&w| damped(w, robot.damping)).collect();
        let actual: Vec<C64> = eigenproblem(&local).spectrum(0.0).expect("a spectrum").eigenvalues().collect();
        // Two nearly equal roots of one quadratic are known to the root of rounding only.
        let allowed = 1e-11 * largest(&expected);
        same_multiset(&actual, &expected, allowed, "eigenvalues at rest");
        prop_assert!(actual.iter().all(|l| l.re < 0.0), "at rest all damped motion dies out");
    }
}

/// The search for the critical speed up to `limit` with the growth rates on its way.
fn search(local: &LocalProblem, limit: f64) -> (Outcome, Vec<Sample>) {
    let search = CriticalSearch::by(Method::Dense, limit);
    let outcome = search.run(&local.vibration).expect("eigenvalues");
    (outcome, search.samples())
}

proptest! {
    #![proptest_config(config(20))]

    /// Few elements, so that it is quick.
    #[test]
    fn the_dense_scan_ends_at_the_first_crossing((robot, motion) in moving_robot(2..5)) {
        let limit = 6.0;
        let found = local(&robot, &motion);
        prop_assume!(found.is_some());
        let local = found.unwrap();
        let (outcome, samples) = search(&local, limit);
        let Outcome::Found(critical) = outcome else {
            return Err(TestCaseError::reject("stable up to the limit"));
        };
        let unstable = samples.iter().position(|sample| sample.growth_rate > 0.0);
        prop_assert_eq!(unstable, Some(samples.len() - 1), "the scan ends at the first unstable speed");
        let [before, after] = [samples.len() - 2, samples.len() - 1].map(|k| samples[k].speed);
        prop_assert!(before < critical.speed && critical.speed < after, "{before} {critical:?} {after}");

        let spectrum = |speed: f64| eigenproblem(&local).spectrum(speed).expect("a spectrum");
        let around = [critical.speed - 1e-6, critical.speed + 1e-6].map(|speed| spectrum(speed).growth_rate());
        prop_assert!(around[0] < 0.0 && around[1] > 0.0, "{around:?} around {critical:?}");
        let eigenvalues: Vec<C64> = spectrum(critical.speed).eigenvalues().collect();
        let slope = (around[1] - around[0]) / 2e-6;
        // The search ends at 1e-9 m/s; the growth rate is known to rounding of the fastest eigenvalue.
        let rounding = 1e-13 * largest(&eigenvalues);
        close(critical.eigenvalue.re, 0.0, slope * 1e-9 + rounding, "growth rate at the critical speed");

        let (mirror, mirror_motion) = mirrored(&robot, &motion);
        let reflection = LocalProblem::new(&mirror, &mirror_motion).expect("statics in the mirror");
        let Outcome::Found(other) = search(&reflection, limit).0 else {
            panic!("stable in the mirror, {critical:?} before it");
        };
        close(other.speed, critical.speed, 2e-9 + rounding / slope, "critical speed in the mirror");
        assert_eq!(other.kind, critical.kind, "kind in the mirror");
    }
}

proptest! {
    #![proptest_config(config(80))]

    /// The search that is used, judged by all eigenvalues: on both sides of its answer and on the way there.
    #[test]
    fn the_critical_speed_is_the_first_crossing((robot, motion) in moving_robot(2..9)) {
        let limit = 15.0;
        let found = local(&robot, &motion);
        prop_assume!(found.is_some());
        let local = found.unwrap();
        let growth = |speed: f64| eigenproblem(&local).spectrum(speed).expect("a spectrum").growth_rate();
        let outcome = local.critical_speed(limit).expect("eigenvalues");
        let end = match &outcome {
            Outcome::Found(critical) => {
                let around = [critical.speed - 1e-6, critical.speed + 1e-6].map(growth);
                prop_assert!(around[0] < 0.0 && around[1] > 0.0, "{around:?} around {critical:?}");
                critical.speed
            }
            Outcome::NoneUpTo(end) => *end,
        };
        // None of these is a multiple of another, nor of the step of a scan.
        for part in [0.061, 0.137, 0.239, 0.347, 0.463, 0.571, 0.673, 0.787, 0.887, 0.971] {
            let rate = growth(part * end);
            prop_assert!(rate < 0.0, "{rate:e} at {} before {outcome:?}", part * end);
        }
        let (mirror, mirror_motion) = mirrored(&robot, &motion);
        let reflection = LocalProblem::new(&mirror, &mirror_motion).expect("statics in the mirror");
        match (outcome, reflection.critical_speed(limit).expect("eigenvalues")) {
            (Outcome::Found(critical), Outcome::Found(other)) => {
                close(other.speed, critical.speed, 1e-6, "critical speed in the mirror");
                assert_eq!(other.kind, critical.kind, "kind in the mirror");
            }
            (outcome, other) => prop_assert_eq!(outcome, other, "in the mirror"),
        }
    }
}
