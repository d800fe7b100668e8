//! Flights against flights that were not computed with this crate (tests/reference/flights), and what must hold of any.

mod common;

use std::path::{Path, PathBuf};

use common::{close, coordinates, name, number, numbers, read, scenario};
use serde_json::Value;
use tautline::flight::{Flight, FlightError, FlightOptions, fly};
use tautline::mechanics::{self, StaticsError};
use tautline::robot::{CableMaterial, Damping, Profile, RobotSpec, Trajectory, Vec2, paper, paper_spec};
use tautline::{Robot, robot::Strain};

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/flights");
    let entries = std::fs::read_dir(folder).expect("the folder").map(|entry| entry.expect("an entry").path());
    let mut files: Vec<PathBuf> = entries.filter(|path| path.extension().is_some_and(|end| end == "json")).collect();
    files.sort();
    assert_eq!(files.len(), 14);
    files
}

/// The robot and the trajectory of a reference flight, and what is asked for.
fn flight_of(case: &Value) -> (Robot, Trajectory, FlightOptions) {
    let (robot, _) = scenario(&case["scenario"]);
    let profile = &case["profile"];
    let value = |name: &str| number(&profile[name]);
    let speed = value("v");
    let profile = match profile["kind"].as_str().expect("a kind") {
        "quintic" => Profile::Quintic { speed },
        "trapezoid" => Profile::Trapezoid { speed, acceleration: value("a") },
        "scurve" => Profile::SCurve { speed, acceleration: value("a"), jerk: value("jerk") },
        "constant" => Profile::Constant { speed },
        other => panic!("{other}"),
    };
    let path = &case["path"];
    let start = Vec2::from(coordinates::<2>(&path["start"]));
    let to = start + Vec2::from(coordinates::<2>(&path["direction"])) * number(&path["distance"]);
    let trajectory = Trajectory::straight(start, &[to], profile).expect("a path");
    let kick = if case["kick"].is_null() { Vec2::zeros() } else { Vec2::from(coordinates::<2>(&case["kick"])) };
    let options = FlightOptions { kick, hold: number(&case["hold"]), ..FlightOptions::default() };
    (robot, trajectory, options)
}

/// The largest distance between the platforms of a flight and of a reference, in m.
fn platform_error(flight: &Flight, case: &Value) -> f64 {
    let expected = case["samples"].as_array().expect("samples");
    assert_eq!(flight.samples.len(), expected.len());
    let deviations = expected.iter().map(|sample| Vec2::from(coordinates::<2>(&sample["deviation"])));
    flight.samples.iter().zip(deviations).map(|(sample, other)| (sample.deviation - other).norm()).fold(0.0, f64::max)
}

/// Two integrators agree to 3e-8 m and 2e-4 N there, without damping (06) to 3e-7 m and 0.02 N; so the tolerances are those of
/// our accuracy of 1e-6 m. Axial waves have up to 400 rad/s.
#[test]
fn flights_are_those_of_independent_integrators() {
    for file in files() {
        let (case, name) = (read(&file), name(&file));
        let (robot, trajectory, options) = flight_of(&case);
        let flight = fly(&robot, &trajectory, &options).expect("a flight");
        let (metres, newtons) = if name.starts_with("06") { (5e-6, 0.1) } else { (1e-6, 1e-2) };
        close(flight.duration, number(&case["summary"]["duration_of_move"]), 1e-12, name);
        close(flight.end, number(&case["summary"]["end"]), 1e-12, name);
        assert_eq!((flight.lost, flight.slack), (None, None), "{name}");
        let expected = case["samples"].as_array().expect("samples");
        assert_eq!(flight.samples.len(), expected.len(), "{name}");
        for (sample, expected) in flight.samples.iter().zip(expected) {
            let at = format!("{name}, {} s", sample.time);
            let value = |field: &str| number(&expected[field]);
            for (field, found) in [("t", sample.time), ("s", sample.s), ("v", sample.v), ("a", sample.a)] {
                close(found, value(field), 1e-9, format_args!("{at}: {field}"));
            }
            for (field, found, tolerance) in
                // Velocities by the frequency of the fastest waves.
                [
                    ("deviation", sample.deviation, metres),
                    ("deviation_velocity", sample.deviation_velocity, 400.0 * metres),
                ]
            {
                let [x, y] = coordinates::<2>(&expected[field]);
                close(found.x, x, tolerance, format_args!("{at}: {field} x"));
                close(found.y, y, tolerance, format_args!("{at}: {field} y"));
            }
            close(sample.smallest_element_force, value("smallest_element_force"), newtons, format_args!("{at}: least"));
            for (i, cable) in sample.cables.iter().enumerate() {
                for (field, found, tolerance) in [
                    ("unstretched_length", cable.length, 1e-9),
                    ("tension_at_platform", cable.tension, newtons),
                    ("element_force_at_winch", cable.winch_element_force, newtons),
                ] {
                    let expected = numbers(&expected[field])[i];
                    close(found, expected, tolerance, format_args!("{at}: {field} of cable {}", i + 1));
                }
            }
        }
        match flight.residual {
            None => assert!(case["summary"]["residual_max_m"].is_null(), "{name}"),
            // The file has 7 digits.
            Some(residual) => close(residual, number(&case["summary"]["residual_max_m"]), metres, name),
        }
    }
}

/// The steps are chosen so that the platform's error is below what is asked for.
#[test]
fn the_error_is_below_the_accuracy() {
    for file in files() {
        let case = read(&file);
        let (robot, trajectory, options) = flight_of(&case);
        for accuracy in [1e-4, 1e-5, 1e-6] {
            let flight = fly(&robot, &trajectory, &FlightOptions { accuracy, ..options }).expect("a flight");
            let error = platform_error(&flight, &case);
            // Without damping the reference itself is known to 3e-7 m.
            assert!(error < accuracy.max(1.5e-6), "{}: {error:e} m, {accuracy:e} wanted", name(&file));
            assert!(error > 1e-3 * accuracy, "{}: {error:e} m took too many steps for {accuracy:e}", name(&file));
        }
    }
}

/// The residual vibration is largest when the reference says, found here from samples every 5 ms and a parabola through three.
#[test]
fn the_residual_vibration_is_largest_when_it_should() {
    for file in files() {
        let case = read(&file);
        let (robot, trajectory, options) = flight_of(&case);
        let Some(expected) = case["summary"]["residual_max_at_s"].as_f64() else { continue };
        let end = trajectory.duration() + options.hold;
        let samples = samples_every(5e-3, end);
        let flight = fly(&robot, &trajectory, &FlightOptions { samples, accuracy: 1e-5, ..options }).expect("a flight");
        let moved = flight.samples.iter().filter(|sample| sample.time >= flight.duration - 1e-9);
        let after: Vec<(f64, f64)> = moved.map(|sample| (sample.time, sample.deviation.norm())).collect();
        let k = (0..after.len()).max_by(|&a, &b| after[a].1.total_cmp(&after[b].1)).expect("samples");
        let mut time = after[k].0;
        if k > 0 && k + 1 < after.len() {
            let [a, b, c] = [after[k - 1].1, after[k].1, after[k + 1].1];
            time += 0.5 * (after[k + 1].0 - after[k].0) * (a - c) / (a - 2.0 * b + c);
        }
        // The reference has a grid of half a millisecond; a parabola over 10 ms leaves as much. In cases that swing longest at
        // the end of the move it is the first sample after it.
        let tolerance = if expected - flight.duration < 1e-9 { 5e-3 } else { 2e-3 };
        close(time, expected, tolerance, name(&file));
    }
}

/// How many samples are about so many seconds apart.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
fn samples_every(seconds: f64, end: f64) -> usize {
    (end / seconds).round() as usize + 1
}

fn quintic(speed: f64) -> Trajectory {
    Trajectory::straight(Vec2::new(-6.0, 0.0), &[Vec2::new(6.0, 0.0)], Profile::Quintic { speed }).expect("a path")
}

fn held() -> FlightOptions {
    FlightOptions { hold: 2.0, accuracy: 1e-5, ..FlightOptions::default() }
}

/// What an independent program found for the paper's robot, to its digits: the largest deviation during and after the move.
#[test]
fn the_faster_the_paper_robot_moves_the_farther_it_deviates() {
    let robot = paper().expect("a robot");
    for (speed, moving, after) in [(2.0, 8.4e-3, Some(0.4e-3)), (5.0, 0.102, Some(0.045)), (7.0, 0.234, None)] {
        let flight = fly(&robot, &quintic(speed), &held()).expect("a flight");
        let digits = if speed < 3.0 { 5e-5 } else { 5e-4 };
        close(flight.max_deviation, moving, digits, format_args!("{speed} m/s, moving"));
        if let Some(after) = after {
            close(flight.residual.expect("a hold"), after, digits, format_args!("{speed} m/s, held"));
        }
        assert_eq!(flight.slack.is_some(), speed > 6.0, "{speed} m/s: {:?}", flight.slack);
        if let Some(slack) = flight.slack {
            close(slack.force, -0.8, 0.05, "the least force at 7 m/s");
        }
    }
    let sudden = Profile::Trapezoid { speed: 5.0, acceleration: 8.3 };
    let path = Trajectory::straight(Vec2::new(-6.0, 0.0), &[Vec2::new(6.0, 0.0)], sudden).expect("a path");
    let flight = fly(&robot, &path, &held()).expect("a flight");
    // The acceleration is known to two digits.
    close(flight.max_deviation, 0.240, 2e-3, "the trapezoid");
    // It looked at the forces less often.
    close(flight.slack.expect("slack").force, -35.0, 2.0, "the least force of the trapezoid");
}

/// No element pushes before slack begins; then one of that cable does.
#[test]
fn slack_begins_at_the_moment_that_is_told() {
    let robot = paper().expect("a robot");
    let flight = fly(&robot, &quintic(7.0), &held()).expect("a flight");
    let slack = flight.slack.expect("slack");
    // A flight with samples every millisecond.
    let samples = samples_every(1e-3, flight.end);
    let fine = fly(&robot, &quintic(7.0), &FlightOptions { samples, ..held() }).expect("a flight");
    let first = fine.samples.iter().find(|sample| sample.smallest_element_force < 0.0).expect("one that pushes");
    assert!(first.time >= slack.time - 1e-5 && first.time < slack.time + 1.1e-3, "{} {slack:?}", first.time);
    let least = fine.samples.iter().map(|sample| sample.smallest_element_force).fold(f64::INFINITY, f64::min);
    close(slack.force, least, 5e-3, "the least force");
    let weakest =
        first.cables.iter().map(|cable| cable.winch_element_force).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    assert_eq!(weakest.map(|(cable, _)| cable), Some(slack.cable));
}

/// An independent program found differences of 0.55 and 0.14 mm at 4 m/s, from 10 to 20 and from 20 to 40 elements.
#[test]
fn the_order_in_the_mesh_is_two() {
    let flown = [10, 20, 40, 80].map(|elements| {
        let robot = Robot::new(RobotSpec { elements, ..paper_spec() }).expect("a robot");
        let options = FlightOptions { accuracy: 1e-5, ..held() };
        let flight = fly(&robot, &quintic(4.0), &options).expect("a flight");
        flight.samples.iter().map(|sample| sample.deviation).collect::<Vec<Vec2>>()
    });
    let difference = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    let differences: Vec<f64> = flown.windows(2).map(|pair| difference(&pair[0], &pair[1])).collect();
    for (pair, expected) in differences.windows(2).zip([5.5e-4, 1.4e-4]) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.9..2.1).contains(&order), "order {order}: {differences:?}");
        // It looked at other times.
        close(pair[0], expected, 0.06 * expected, "the difference between meshes");
    }
}

/// At rest, and while it is held there, nothing moves.
#[test]
fn what_rests_stays_at_rest() {
    let robot = paper().expect("a robot");
    let slow = Trajectory::straight(Vec2::new(1.0, 1.0), &[Vec2::new(1.0, 1.001)], Profile::Quintic { speed: 1e-6 });
    let flight = fly(&robot, &slow.expect("a path"), &FlightOptions { hold: 5.0, ..held() }).expect("a flight");
    assert!(flight.max_deviation < 1e-9, "{flight:?}");
}

/// A kick changes the velocities by M⁻¹ J: less than J/m, since the cables' ends are carried along.
#[test]
fn a_kick_moves_platform_and_cables_at_once() {
    let robot = paper().expect("a robot");
    let kick = Vec2::new(0.2, 0.4);
    let flight = fly(&robot, &quintic(1.0), &FlightOptions { kick, ..held() }).expect("a flight");
    let start = &flight.samples[0];
    assert_eq!(start.deviation, Vec2::zeros());
    // A long chain of elements with consistent masses m_e answers with m_e/√12 at its end: of four cables with 10 elements each.
    let statics = mechanics::solve(&robot, Vec2::new(-6.0, 0.0)).expect("statics");
    let carried: f64 = statics.cables.iter().map(|cable| 0.4 * cable.length / 10.0 / 12.0_f64.sqrt()).sum();
    let expected = kick / (2.0 + carried);
    // The chains are 10 elements long: (2 − √3)^20 is rounding.
    assert!((start.deviation_velocity - expected).norm() < 1e-9, "{:?} {expected:?}", start.deviation_velocity);
}

/// Where the path leaves the feasible region there is no flight, and the place is the border.
#[test]
fn a_path_out_of_the_feasible_region_is_refused_at_its_border() {
    let robot = paper().expect("a robot");
    let from = Vec2::new(0.0, 0.0);
    let up = Trajectory::straight(from, &[Vec2::new(0.0, 20.0)], Profile::Quintic { speed: 3.0 }).expect("a path");
    let fault = fly(&robot, &up, &FlightOptions::default()).expect_err("no equilibrium up there");
    let FlightError::Statics { s, position, reason } = fault else { panic!("{fault:?}") };
    assert!(matches!(reason, StaticsError::Infeasible(_)), "{reason:?}");
    close(position.y, s, 1e-12, "the place");
    for (y, feasible) in [(s - 1e-4, true), (s + 1e-4, false)] {
        assert_eq!(mechanics::solve(&robot, Vec2::new(0.0, y)).is_ok(), feasible, "{y}");
    }
}

/// Robots at the ends of what is legal: every flight ends, with finite numbers or with a reason.
#[test]
fn extreme_robots_have_a_flight_or_a_reason() {
    let material = |youngs_modulus: f64, mass_per_length: f64, strain| CableMaterial {
        youngs_modulus,
        mass_per_length,
        strain,
        ..paper_spec().material
    };
    let damping = |alpha, beta| Damping { alpha, beta };
    let spec = |change: &dyn Fn(&mut RobotSpec)| {
        let mut spec = paper_spec();
        change(&mut spec);
        spec
    };
    let specs: Vec<(&str, RobotSpec)> = vec![
        ("stiff", spec(&|spec| spec.material = material(1.25e14, 0.4, Strain::Green))),
        ("stiff and light", spec(&|spec| spec.material = material(1.25e12, 1e-9, Strain::Engineering))),
        ("heavy", spec(&|spec| spec.material = material(1.25e8, 1.2, Strain::Engineering))),
        ("soft", spec(&|spec| spec.material = material(1e5, 0.4, Strain::Green))),
        ("two elements", spec(&|spec| spec.elements = 2)),
        ("a hundred elements", spec(&|spec| spec.elements = 100)),
        ("no gravity", spec(&|spec| spec.gravity = 0.0)),
        ("no damping", spec(&|spec| spec.damping = damping(0.0, 0.0))),
        ("much damping", spec(&|spec| spec.damping = damping(1e6, 1e3))),
        ("a light platform", spec(&|spec| spec.platform_mass = 1e-6)),
        ("a heavy platform", spec(&|spec| spec.platform_mass = 1e6)),
        ("huge numbers", spec(&|spec| spec.material = material(1e300, 1e290, Strain::Green))),
    ];
    for (what, spec) in specs {
        let robot = Robot::new(spec).expect("a legal robot");
        for speed in [0.5, 30.0] {
            let path = Trajectory::straight(Vec2::new(-1.0, 0.0), &[Vec2::new(1.0, 0.5)], Profile::Quintic { speed });
            let options = FlightOptions { accuracy: 1e-4, hold: 0.2, nodes: true, ..FlightOptions::default() };
            let Ok(flight) = fly(&robot, &path.expect("a path"), &options) else { continue };
            let numbers = flight.samples.iter().flat_map(|sample| {
                let cables = sample.cables.iter().flat_map(|cable| {
                    let nodes = cable.nodes.iter().flatten().map(|&x| f64::from(x));
                    [cable.tension, cable.winch_tension, cable.winch_element_force].into_iter().chain(nodes)
                });
                [sample.deviation.norm(), sample.deviation_velocity.norm(), sample.smallest_element_force]
                    .into_iter()
                    .chain(cables)
            });
            let all: Vec<f64> = numbers.chain([flight.max_deviation]).chain(flight.residual).collect();
            assert!(all.iter().all(|number| number.is_finite()), "{what}, {speed} m/s: {flight:?}");
            assert!(!flight.samples.is_empty() && (flight.lost.is_some() || flight.samples.len() == 21), "{what}");
        }
    }
}
