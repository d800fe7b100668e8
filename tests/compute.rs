//! The engine behind the interface: newest wins, answers carry their revision, long work stays interruptible.

#![cfg(feature = "compute")]

use std::time::{Duration, Instant};

use nalgebra::Complex;
use tautline::LocalProblem;
use tautline::compute::Engine;
use tautline::compute::protocol::{Extent, Job, ModeChoice, Reply, Request, Update, Which};
use tautline::robot::{Linearisation, TensionLaw};
use tautline::scenario::report::CriticalReport;
use tautline::scenario::{Report, Scenario, presets};
use tautline::stability::{Polarisation, mode};
use tautline::study::Knob;
use tautline::study::validation::{CHECKS, Comparison};

/// The parameters of the paper's robot.
const KNOBS: [Knob; 9] = [
    Knob::YoungsModulus,
    Knob::Area,
    Knob::MassPerLength,
    Knob::PlatformMass,
    Knob::Tension(2),
    Knob::Tension(3),
    Knob::Alpha,
    Knob::Beta,
    Knob::Gravity,
];
const CRITICAL: ModeChoice = ModeChoice { which: Which::Critical, along_x: false };

fn paper_at(x: f64) -> Scenario {
    let mut scenario = presets::PRESETS[0].scenario();
    scenario.motion.position = [x, 0.0];
    scenario
}

fn job(revision: u64, scenario: &Scenario, mode: ModeChoice) -> Request {
    Request::Analyze(Job { revision, scenario: scenario.to_json(), max_speed: 40.0, mode })
}

/// Works until nothing is left to do.
fn finish(engine: &mut Engine) -> Vec<Reply> {
    std::iter::from_fn(|| engine.work()).flatten().collect()
}

fn cold(scenario: &Scenario) -> Report {
    let (robot, motion) = scenario.to_robot().expect("physical");
    Report::analyze(&robot, &motion, 40.0)
}

#[test]
fn a_job_is_answered_with_pose_critical_speed_shape_curve_and_sensitivities() {
    let scenario = paper_at(2.0);
    let mut engine = Engine::default();
    engine.submit(job(7, &scenario, CRITICAL));
    let replies = finish(&mut engine);
    assert!(replies.iter().all(|reply| reply.revision == 7));
    let expected = cold(&scenario);
    assert!(matches!(replies.last(), Some(Reply { update: Update::Sensitivities(_), .. })), "the last of all");
    let mut seen = [false; 5];
    let mut curve = Vec::new();
    for Reply { update, .. } in replies {
        match update {
            Update::Pose(pose) => {
                assert_eq!(pose.report.eigenvalues, expected.eigenvalues);
                assert_eq!(pose.report.critical, None, "not known yet");
                let counted: usize = pose
                    .modes
                    .iter()
                    .map(|mode| mode.multiplicity * if mode.eigenvalue[1] > 0.0 { 2 } else { 1 })
                    .sum();
                assert_eq!(counted, 148);
                for mode in &pose.modes {
                    let total = mode.platform_share + mode.cable_share.iter().sum::<f64>();
                    assert!((total - 1.0).abs() < 1e-12, "shares add up to {total}");
                }
                seen[0] = true;
            }
            Update::Critical(answer) => {
                assert_eq!(answer.critical.as_ref().map(CriticalReport::from), expected.critical);
                seen[1] = true;
            }
            Update::Shape(shape) => {
                assert!(shape.is_critical && shape.eigenvalue[0].abs() < 1e-6, "{:?}", shape.eigenvalue);
                let largest = shape.displacement.iter().flatten().flat_map(|q| [q[0].hypot(q[1]), q[2].hypot(q[3])]);
                assert!((largest.fold(0.0, f64::max) - 1.0).abs() < 1e-12);
                seen[2] = true;
            }
            Update::Curve(points) => {
                curve = points;
                seen[3] = true;
            }
            Update::Sensitivities(found) => {
                let found = found.expect("a simple crossing");
                let knobs: Vec<_> = found.iter().map(|sensitivity| sensitivity.knob).collect();
                assert_eq!(knobs, KNOBS);
                // tests/sensitivity.rs checks the values themselves.
                assert!(found.iter().all(|s| s.speed.abs() < 10.0 && s.frequency.is_some_and(f64::is_finite)));
                seen[4] = true;
            }
            Update::Searching(speed) => assert!(speed <= 40.0),
            other => panic!("unexpected: {other:?}"),
        }
    }
    assert_eq!(seen, [true; 5]);
    // The curve is above zero from the critical speed on.
    let critical = expected.critical.as_ref().expect("a critical speed").speed;
    assert!(curve.windows(2).all(|ends| ends[0][0] < ends[1][0]), "speeds rise");
    let growing: Vec<bool> = curve.iter().map(|point| point[1] > 0.0).collect();
    assert_eq!(growing, curve.iter().map(|point| point[0] > critical).collect::<Vec<_>>());
    assert!(growing.contains(&true) && growing.contains(&false));
}

#[test]
fn the_newest_pose_is_served_first_and_only_the_newest_search_need_finish() {
    let mut engine = Engine::default();
    // Tangent stiffness with many elements: a search of seconds.
    let mut slow = paper_at(0.0);
    slow.linearisation = Linearisation::Tangent;
    slow.elements_per_cable = 16;
    engine.submit(job(1, &slow, CRITICAL));
    // Slices without a reply are work on it.
    let served = |engine: &mut Engine| -> Vec<Reply> {
        std::iter::from_fn(|| engine.work()).find(|replies| !replies.is_empty()).expect("work")
    };
    let first = served(&mut engine);
    assert!(matches!(first[0].update, Update::Pose(_)) && first[0].revision == 1);
    for _ in 0..3 {
        engine.work().expect("a search");
    }
    for revision in 2..=9 {
        engine.submit(job(revision, &paper_at(0.5 * f64::from(u8::try_from(revision).unwrap())), CRITICAL));
    }
    let next = served(&mut engine);
    assert!(matches!(next[0].update, Update::Pose(_)), "{next:?}");
    assert_eq!(next[0].revision, 9, "jobs between the running and the newest one are skipped");
    let rest = finish(&mut engine);
    assert!(rest.iter().all(|reply| [1, 9].contains(&reply.revision)));
    let Some(Update::Critical(answer)) = rest
        .iter()
        .filter(|reply| reply.revision == 9)
        .map(|reply| &reply.update)
        .find(|update| matches!(update, Update::Critical(_)))
    else {
        panic!("the newest job has no critical speed")
    };
    assert_eq!(answer.critical.as_ref().map(CriticalReport::from), cold(&paper_at(4.5)).critical);
}

#[test]
fn sensitivities_are_left_out_for_a_newer_pose_and_their_absence_is_explained() {
    let mut engine = Engine::default();
    engine.submit(job(1, &paper_at(1.0), CRITICAL));
    while !engine.work().expect("work").iter().any(|reply| matches!(reply.update, Update::Curve(_))) {}
    // Only the sensitivities of the first pose are still to come.
    let mut undamped = paper_at(2.0);
    (undamped.damping.alpha, undamped.damping.beta) = (0.0, 0.0);
    engine.submit(job(2, &undamped, CRITICAL));
    let replies = finish(&mut engine);
    assert!(replies.iter().all(|reply| reply.revision == 2));
    let Some(Update::Sensitivities(Err(reason))) = replies.last().map(|reply| &reply.update) else {
        panic!("{:?}", replies.last())
    };
    assert!(reason.contains("any speed above zero"), "{reason}");
    // Below the critical speed there is none.
    let Request::Analyze(low) = job(3, &paper_at(2.0), CRITICAL) else { panic!("a job") };
    engine.submit(Request::Analyze(Job { max_speed: 5.0, ..low }));
    let replies = finish(&mut engine);
    let Some(Reply { revision: 3, update: Update::Sensitivities(Err(reason)) }) = replies.last() else {
        panic!("{:?}", replies.last())
    };
    assert_eq!(reason, "There is no critical speed up to 5 m/s.");
}

#[test]
fn an_infeasible_pose_is_a_complete_answer_with_what_can_be_drawn() {
    let mut engine = Engine::default();
    engine.submit(job(3, &paper_at(8.0), CRITICAL));
    let replies = finish(&mut engine);
    let [Reply { revision: 3, update: Update::Failed(failed) }] = &replies[..] else { panic!("{replies:?}") };
    assert_eq!(failed.cable, Some(0));
    assert!(
        failed.report.feasible == Some(false) && failed.report.reason.as_deref().is_some_and(|r| r.contains("cable 1"))
    );
    let drawn: Vec<bool> = failed.shapes.iter().map(Option::is_some).collect();
    assert_eq!(drawn, [false, false, true, true], "the stiffening cables have a shape");
    // Its straight line and that of cable 2 have to balance 2 kg and what the drawn cables pull with at their first
    // element, less half of that element's weight. An element is stretched by 1 %, so that much is its weight in doubt.
    let gravity = 9.81;
    let mut load = [0.0, 2.0 * gravity];
    for shape in failed.shapes.iter().flatten() {
        let [dx, dy] = [0, 1].map(|i| shape.nodes[1][i] - shape.nodes[0][i]);
        let length = dx.hypot(dy);
        let pull = shape.axial_forces[0] / length;
        load = [load[0] - pull * dx, load[1] - (pull * dy - 0.5 * 0.4 * gravity * length)];
    }
    let line = |[x, y]: [f64; 2]| [x / x.hypot(y), y / x.hypot(y)];
    let (first, second) = (line([-18.0, 5.0]), line([2.0, 5.0]));
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let pull = cross(load, second) / cross(first, second);
    let push = failed.push.expect("a push");
    assert!(push > 0.0 && (push + pull).abs() < 0.01 * push + 0.1, "{push} N, by hand {} N", -pull);
}

#[test]
fn what_a_disturbance_becomes_is_the_mode_that_grows_most_at_the_present_speed() {
    let present = ModeChoice { which: Which::Present, along_x: false };
    let mut engine = Engine::default();
    for (revision, speed) in [(1, 5.0), (2, 12.0)] {
        let mut scenario = paper_at(0.0);
        scenario.motion.speed = speed;
        engine.submit(job(revision, &scenario, present));
        let replies = finish(&mut engine);
        let mut shapes = replies.iter().filter_map(|reply| match &reply.update {
            Update::Shape(shape) => Some(shape),
            _ => None,
        });
        let growth = cold(&scenario).max_growth_rate.expect("eigenvalues");
        assert_eq!(growth > 0.0, speed > 11.3, "stable up to 11.3 m/s");
        let shape = shapes.next_back().expect("a shape");
        assert!(!shape.is_critical && (shape.speed - speed).abs() < 1e-12);
        assert!((shape.eigenvalue[0] - growth).abs() < 1e-9 && shape.eigenvalue[1] >= 0.0, "{:?}", shape.eigenvalue);
    }
    // Chosen later, it comes without a new analysis.
    engine.submit(Request::Shape(CRITICAL));
    finish(&mut engine);
    engine.submit(Request::Shape(present));
    let replies = finish(&mut engine);
    let [Reply { revision: 2, update: Update::Shape(shape) }] = &replies[..] else { panic!("{replies:?}") };
    assert!(shape.eigenvalue[0] > 0.0 && (shape.speed - 12.0).abs() < 1e-12);
}

/// With 200 elements and tangent stiffness eigenvalues crowd beyond double precision (docs/theory.md section 11); the
/// rest of the answer does not need them. Between 80 elements and the limit the critical speed changes little.
#[test]
fn without_eigenvalues_the_pose_and_the_critical_speed_are_answered_all_the_same() {
    let mut scenario = Scenario { linearisation: Linearisation::Tangent, ..paper_at(0.0) };
    scenario.elements_per_cable = 200;
    let mut engine = Engine::default();
    engine.submit(job(3, &scenario, CRITICAL));
    let (mut pose, mut critical, mut shape, mut curve) = (None, None, None, None);
    for Reply { update, .. } in finish(&mut engine) {
        match update {
            Update::Pose(answer) => pose = Some(answer),
            Update::Critical(answer) => critical = answer.critical,
            Update::Shape(answer) => shape = Some(answer),
            Update::Curve(points) => curve = Some(points),
            _ => {}
        }
    }
    let pose = pose.expect("a pose");
    assert!(pose.report.eigenvalues.is_empty() && pose.extent == Extent::SlowestAlone, "{} modes", pose.modes.len());
    assert_eq!((pose.report.stable, pose.report.cables.len()), (Some(true), 4));
    assert_eq!(pose.report.reason.as_deref(), Some("The eigenvalues could not be computed."));
    let speed = critical.expect("a critical speed").speed;
    let coarser = cold(&Scenario { elements_per_cable: 80, ..scenario }).critical.expect("a critical speed").speed;
    assert!((speed - coarser).abs() < 2e-3 * coarser, "{speed}, with 80 elements {coarser}");
    assert!(shape.expect("the critical mode's shape").is_critical);
    assert_eq!(curve, Some(Vec::new()));
}

#[test]
fn a_broken_scenario_is_told_not_fatal() {
    let mut engine = Engine::default();
    let scenario = paper_at(0.0).to_json().replace("\"mass\": 2", "\"mass\": -2");
    engine.submit(Request::Analyze(Job { revision: 4, scenario, max_speed: 40.0, mode: CRITICAL }));
    let replies = finish(&mut engine);
    let [Reply { update: Update::Failed(failed), .. }] = &replies[..] else { panic!("{replies:?}") };
    assert!(failed.report.reason.as_deref().is_some_and(|reason| reason.contains("platform.mass")));
    engine.submit(job(5, &paper_at(0.0), CRITICAL));
    assert!(finish(&mut engine).iter().any(|reply| matches!(reply.update, Update::Critical(_))));
}

#[test]
fn a_mode_chosen_later_is_answered_without_a_new_analysis() {
    let mut engine = Engine::default();
    engine.submit(Request::Shape(CRITICAL));
    assert!(finish(&mut engine).is_empty(), "nothing analysed, nothing to show");
    engine.submit(job(1, &paper_at(1.0), CRITICAL));
    let replies = finish(&mut engine);
    let Some(Update::Pose(pose)) = replies.iter().map(|r| &r.update).find(|u| matches!(u, Update::Pose(_))) else {
        panic!("no pose")
    };
    let wanted = pose.modes[5].eigenvalue;
    for along_x in [false, true] {
        // A guess nearby is enough.
        let which = Which::Near([wanted[0] + 1e-4, wanted[1] + 1e-4]);
        engine.submit(Request::Shape(ModeChoice { which, along_x }));
        let replies = finish(&mut engine);
        let [Reply { revision: 1, update: Update::Shape(shape) }] = &replies[..] else { panic!("{replies:?}") };
        assert_eq!(shape.eigenvalue.map(f64::to_bits), wanted.map(f64::to_bits));
        assert!(!shape.is_critical);
        let still = |q: &[f64; 4]| if along_x { q[2].hypot(q[3]) } else { q[0].hypot(q[1]) };
        let other = shape.displacement.iter().flatten().map(still).fold(0.0, f64::max);
        assert!(other < 1e-12, "with secant stiffness x and y decouple: {other}");
    }
}

#[test]
fn messages_survive_their_way_as_bytes() {
    let request = job(1, &paper_at(1.0), ModeChoice { which: Which::Near([-0.25, 1e300]), along_x: true });
    let bytes = postcard::to_stdvec(&request).expect("bytes");
    assert_eq!(postcard::from_bytes::<Request>(&bytes).expect("a request"), request);
    let mut engine = Engine::default();
    engine.submit(request);
    for x in [1.0, 8.0] {
        engine.submit(job(2, &paper_at(x), CRITICAL));
        for reply in finish(&mut engine) {
            let bytes = postcard::to_stdvec(&reply).expect("bytes");
            assert_eq!(postcard::from_bytes::<Reply>(&bytes).expect("a reply"), reply);
        }
    }
}

#[test]
fn checks_of_known_numbers_are_done_when_all_else_is_done() {
    let mut engine = Engine::default();
    engine.submit(Request::Check(0));
    engine.submit(job(3, &paper_at(2.0), CRITICAL));
    let replies = finish(&mut engine);
    let Some(Reply { update: Update::Checked(answer), .. }) = replies.last() else { panic!("{replies:?}") };
    assert!(replies.iter().any(|reply| matches!(reply.update, Update::Sensitivities(_))));
    assert_eq!((answer.index, answer.count), (0, CHECKS.len()));
    assert_eq!((answer.name.as_str(), answer.unit.as_str()), (CHECKS[0].name, CHECKS[0].unit));
    assert!(answer.comparison.as_ref().is_ok_and(Comparison::passes), "{answer:?}");
    engine.submit(Request::Check(CHECKS.len()));
    assert_eq!(finish(&mut engine), [], "there is no such check");
}

/// The largest legal robot: 8 cables of 200 elements.
fn largest(linearisation: Linearisation) -> Scenario {
    let mut scenario = Scenario { linearisation, elements_per_cable: 200, ..paper_at(0.0) };
    for anchor in [[-9.0, -6.0], [9.0, -6.0], [-8.0, -7.0], [8.0, -7.0]] {
        let mut cable = scenario.cables[2];
        (cable.anchor, cable.tension) = (anchor, TensionLaw::Constant(70.0));
        scenario.cables.push(cable);
    }
    scenario
}

/// The time of ten mode shapes. Slices are measured in it, since machines differ and are busy.
fn unit(scenario: &Scenario) -> Duration {
    let (robot, motion) = scenario.to_robot().expect("physical");
    let local = LocalProblem::new(&robot, &motion).map_err(|failure| failure.reason).expect("a pose");
    let begun = Instant::now();
    for k in 0..10 {
        std::hint::black_box(mode(&local.vibration, 5.0, Complex::new(-0.1, f64::from(k)), Polarisation::X));
    }
    begun.elapsed()
}

/// All its modes take seconds or minutes, its search tenths of a second. Neither is done at a stretch. The slowest modes
/// come at once, and the answer says that they are only the slowest.
#[test]
fn the_largest_robot_shows_its_slowest_modes_at_once_and_gives_way_after_any_slice() {
    for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
        let scenario = largest(linearisation);
        let unit = unit(&scenario);
        let mut engine = Engine::default();
        let mut longest = Duration::ZERO;
        let mut work = |engine: &mut Engine| {
            let begun = Instant::now();
            let replies = engine.work().expect("work");
            longest = longest.max(begun.elapsed());
            replies
        };
        let mut revision = 0;
        // In the middle of the pose, of the search, and of all modes.
        for slices in [0, 30, 150] {
            revision += 2;
            engine.submit(job(revision, &scenario, CRITICAL));
            let mut first = Vec::new();
            while first.is_empty() {
                first = work(&mut engine);
            }
            let [Reply { update: Update::Pose(pose), .. }] = &first[..] else { panic!("{first:?}") };
            assert_eq!((pose.extent, pose.report.cables.len(), pose.modes.len()), (Extent::SlowestSoFar, 8, 24));
            assert!(pose.report.eigenvalues.is_empty() && pose.report.stable == Some(true), "{:?}", pose.report.stable);
            assert!(pose.modes.windows(2).all(|pair| pair[0].frequency_hz <= pair[1].frequency_hz));
            assert!(pose.modes.iter().all(|mode| (0.05..5.0).contains(&mode.frequency_hz)), "{:?}", pose.modes);
            for _ in 0..slices {
                work(&mut engine);
            }
            engine.submit(job(revision + 1, &paper_at(2.0), CRITICAL));
            let newer = (0..).take(40).find(|_| work(&mut engine).iter().any(|reply| reply.revision == revision + 1));
            assert!(newer.is_some(), "{linearisation:?}: 40 slices of what has been left, after {slices}");
            // The newer one is answered to its end.
            while !work(&mut engine).iter().any(|reply| matches!(reply.update, Update::Sensitivities(_))) {}
        }
        assert!(longest < 40 * unit, "{linearisation:?}: a slice of {longest:?}, ten shapes in {unit:?}");
    }
}

/// Without stiffness damping all modes of a mesh are near the axis and are counted one by one, which takes most of the
/// search's time. It is not done at a stretch.
#[test]
fn a_search_that_counts_gives_way_after_any_step() {
    let mut scenario = Scenario { elements_per_cable: 80, ..paper_at(0.0) };
    (scenario.damping.alpha, scenario.damping.beta) = (0.5, 0.0);
    let mut engine = Engine::default();
    engine.submit(job(1, &scenario, CRITICAL));
    let (mut whole, mut longest) = (Duration::ZERO, Duration::ZERO);
    let end = loop {
        let begun = Instant::now();
        let replies = engine.work().expect("work");
        let slice = begun.elapsed();
        (whole, longest) = (whole + slice, longest.max(slice));
        let mut updates = replies.into_iter().map(|reply| reply.update);
        if let Some(Update::Critical(end)) = updates.find(|update| matches!(update, Update::Critical(_))) {
            break end;
        }
    };
    assert!(end.critical.is_some_and(|critical| critical.speed < 15.0), "a critical speed");
    assert!(longest < whole / 8, "a slice of {longest:?}, {whole:?} in all");
}
