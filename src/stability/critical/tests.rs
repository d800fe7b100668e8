use super::refine::REFINED_TO;
use super::*;
use crate::robot::{Cable, CableMaterial, Damping, Linearisation, RobotSpec, TensionLaw, paper_spec};
use crate::stability::steps::finish_watched;
use crate::stability::{Eigenproblem, problems};

/// Also by the scan, which undamped robots are left to.
#[test]
fn a_search_up_to_no_speed_ends_at_once() {
    for damping in [paper_spec().damping, Damping { alpha: 0.0, beta: 0.0 }] {
        let vibration = problems::of_robot(RobotSpec { damping, ..paper_spec() }, [0.0, 0.0], [1.0, 0.0]);
        for limit in [0.0, -1.0, f64::NAN] {
            for method in [Method::Structured, Method::Dense] {
                let outcome = CriticalSearch::by(method, limit).run(&vibration);
                assert_eq!(outcome, Ok(Outcome::NoneUpTo(0.0)), "{method:?} up to {limit}");
            }
        }
    }
}

/// The scan looks every 0.1 m/s; it says how far it has come and why it was asked.
#[test]
fn a_search_tells_how_far_it_has_come_and_why_it_scans() {
    let problem = |damping| problems::of_robot(RobotSpec { damping, ..paper_spec() }, [0.0, 0.0], [1.0, 0.0]);
    let damped = problem(paper_spec().damping);
    // How far each step has come; the last one ends the search.
    let watch = |search: &CriticalSearch, vibration: &Vibration| {
        let mut reached = vec![search.searched_up_to()];
        let outcome = finish_watched(search.run_in_steps(vibration), || reached.push(search.searched_up_to()));
        reached.push(search.searched_up_to());
        (outcome.unwrap(), reached)
    };
    let scan = CriticalSearch::by(Method::Dense, 0.25);
    assert_eq!((scan.searched_up_to(), scan.doubt()), (0.0, None));
    let (outcome, reached) = watch(&scan, &damped);
    assert_eq!((outcome, scan.doubt()), (Outcome::NoneUpTo(0.25), None));
    assert_eq!(reached.len(), 5, "{reached:?}");
    for (reached, expected) in reached.iter().zip([0.0, 0.0, 0.1, 0.2, 0.25]) {
        assert!((reached - expected).abs() < 1e-12, "{reached} instead of {expected}");
    }
    let growth: Vec<f64> = scan.samples().iter().map(|sample| sample.growth_rate).collect();
    assert!(growth.len() == 4 && growth.iter().all(|&rate| rate < 0.0), "{growth:?}");
    // The search by structure goes on in strips and samples nothing.
    let by_structure = CriticalSearch::new(40.0);
    let (Outcome::Found(critical), mut reached) = watch(&by_structure, &damped) else { panic!("no critical speed") };
    assert_eq!((by_structure.samples(), by_structure.doubt()), (Vec::new(), None));
    assert!(reached.is_sorted() && reached.iter().all(|&v| v < critical.speed), "{reached:?}");
    reached.dedup();
    assert!(reached.len() > 4, "{reached:?}");
    let left_to_the_scan = CriticalSearch::new(0.2);
    let (_, reached) = watch(&left_to_the_scan, &problem(Damping { alpha: 0.0, beta: 0.0 }));
    assert_eq!((left_to_the_scan.doubt(), reached.last()), (Some(Doubt::Undamped), Some(&0.2)));
}

/// A cable across the motion of light and very taut cables: waves are so fast that it is stable far beyond what is
/// searched. Strips grow with the speed, so that they are few; a speed that is no limit is none.
#[test]
fn a_search_far_beyond_all_that_moves_ends_soon() {
    let cable = |x, y, tension| Cable::new([x, y], tension);
    let spec = RobotSpec {
        material: CableMaterial { youngs_modulus: 1e13, area: 1e-4, mass_per_length: 1e-4, ..paper_spec().material },
        platform_mass: 1e6,
        cables: vec![
            cable(-5.0, 5.0, TensionLaw::Equilibrium),
            cable(5.5, 4.5, TensionLaw::Equilibrium),
            cable(0.6, 7.0, TensionLaw::Constant(2.5e6)),
        ],
        damping: Damping { alpha: 1e-3, beta: 0.0 },
        ..paper_spec()
    };
    let vibration = problems::of_robot(spec, [0.2, -0.5], [0.1, -1.0]);
    for limit in [1e4, 1e9, f64::INFINITY] {
        let search = CriticalSearch::new(limit);
        let (mut strips, mut last) = (0, 0.0);
        let outcome = finish_watched(search.run_in_steps(&vibration), || {
            let reached = search.searched_up_to();
            strips += u32::from(reached > last);
            last = reached;
            assert!(strips < 1000, "{strips} strips, at {reached} m/s");
        });
        assert_eq!((outcome, search.doubt()), (Ok(Outcome::NoneUpTo(LARGEST_LIMIT)), None));
        assert!(strips > 50, "{strips} strips: not a long search");
    }
    for (speed, legal) in [(1e-3, true), (LARGEST_LIMIT, true), (1.0001 * LARGEST_LIMIT, false), (0.0, false)] {
        assert_eq!(is_limit(speed), legal, "{speed}");
    }
    assert!(!is_limit(f64::NAN) && !is_limit(f64::INFINITY) && ALLOWED_LIMIT.contains(&LARGEST_LIMIT.to_string()));
}

/// Where rounding hides on which side of the crossing the limit is, the crossing's place decides.
#[test]
fn a_crossing_beyond_the_limit_is_not_found() {
    let vibration = problems::of_robot(RobotSpec { elements: 2, ..paper_spec() }, [0.0, 0.0], [1.0, 0.0]);
    let Ok(Outcome::Found(Critical { speed, .. })) = structured(&vibration, 30.0) else { panic!("no critical speed") };
    for aside in [2.0, 20.0].map(|part| part * REFINED_TO) {
        let up_to = |limit| CriticalSearch::by(Method::Dense, limit).run(&vibration).unwrap();
        assert_eq!(up_to(speed - aside), Outcome::NoneUpTo(speed - aside));
        assert!(matches!(up_to(speed + aside), Outcome::Found(_)), "{aside}");
    }
}

/// With any damping there is no scan, nor without where the modes at rest grow or decay; both methods tell the same.
///
/// The paper's robot is its own mirror image at x = 0, and its cables change places when it turns round: backwards
/// eigenvalues are the negative ones, so that moving along x without damping they stay on the axis until two meet.
#[test]
fn only_symmetric_robots_without_any_damping_are_left_to_the_scan() {
    for (alpha, beta, x, scan) in [
        (0.0, 0.0, 0.0, true),
        (0.0, 0.0, 0.5, false),
        (0.1, 0.0, 0.0, false),
        (0.0, 0.002, 0.0, false),
        (0.1, 0.002, 0.0, false),
    ] {
        let vibration =
            problems::of_robot(RobotSpec { damping: Damping { alpha, beta }, ..paper_spec() }, [x, 0.0], [1.0, 0.0]);
        let structured = structured(&vibration, 15.0);
        assert_eq!(structured == Err(Doubt::Undamped), scan, "{structured:?}");
        let dense = CriticalSearch::by(Method::Dense, 15.0).run(&vibration).unwrap();
        if let (Ok(structured), Outcome::Found(b)) = (structured, dense) {
            let Outcome::Found(a) = structured else { panic!("{structured:?}") };
            assert!((a.speed - b.speed).abs() < 1e-6, "{a:?} {b:?}");
            assert_eq!((a.kind, b.kind), (Instability::Flutter, Instability::Flutter));
            assert!(a.speed == 0.0 || a.cable == b.cable, "{a:?} {b:?}");
        }
    }
}

/// What the modes at rest say is what all eigenvalues do a little above rest.
#[test]
fn without_damping_growth_from_rest_on_decides() {
    let damping = Damping { alpha: 0.0, beta: 0.0 };
    for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
        for (at, towards) in [([2.0, 0.5], [1.0, 0.0]), ([-3.0, 1.0], [0.3, 1.0]), ([0.0, 0.0], [0.0, 1.0])] {
            let vibration =
                problems::of_robot(RobotSpec { damping, linearisation, elements: 5, ..paper_spec() }, at, towards);
            let Ok(Outcome::Found(critical)) = structured(&vibration, 15.0) else { panic!("no growth") };
            assert_eq!((critical.speed, critical.eigenvalue.re), (0.0, 0.0));
            // The fastest growth, and in the mode that is named.
            let speed = 1e-3;
            let spectrum = Eigenproblem::new(&vibration).unwrap().spectrum(speed).unwrap();
            let named = spectrum.eigenvalues().min_by(|a, b| {
                let distance = |l: &Complex<f64>| (l - critical.eigenvalue).norm();
                distance(a).total_cmp(&distance(b))
            });
            let (growth, named) = (spectrum.growth_rate(), named.unwrap().re);
            assert!(growth > 0.0 && named > 0.9 * growth, "{growth:e}, {named:e} of the mode named");
        }
    }
}
