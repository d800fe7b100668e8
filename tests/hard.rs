//! Robots at the ends of what is legal. Each has a right answer or a named reason. None gives a panic, a NaN, a hang or a
//! wrong number.
//!
//! `PROPTEST_CASES=20000 cargo test --release --test hard -- --nocapture` draws that many robots per family, and
//! `PROPTEST_RNG_SEED` draws others. The test prints how many robots of each family ended in which way.

mod common;

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use common::hung::Hung;
use common::judge::{Drawn, Verdict, judge_critical_speed, judge_crossing_closely, judge_spectrum};
use common::pair;
use common::random::{config, extreme_robot, moving_robot};
use common::statics::{Pose, check_continuous, check_statics, check_verdict, load, pose, straight_tensions};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use tautline::mechanics::{self, Infeasible, StaticsError};
use tautline::robot::{Damping, RobotSpec, TensionLaw, Vec2, paper};
use tautline::scenario::presets;
use tautline::stability::{CriticalSearch, Outcome};
use tautline::{LocalProblem, Motion, Robot};

/// The critical speed is searched up to this speed, in m/s.
const LIMIT: f64 = 15.0;
/// A case that takes longer than this, in s, counts as a hang, on the slowest machine as well.
const PATIENCE: f64 = 60.0;

/// What became of the robots of a family, and how often.
#[derive(Default)]
struct Tally {
    name: &'static str,
    counts: BTreeMap<String, usize>,
    failures: Vec<String>,
    slowest: f64,
    cases: usize,
}

impl Tally {
    fn count(&mut self, what: impl Into<String>) {
        *self.counts.entry(what.into()).or_default() += 1;
    }

    fn of(&self, what: &str) -> usize {
        self.counts.get(what).copied().unwrap_or(0)
    }

    /// At least this part of the robots has statics.
    #[track_caller]
    fn check(&self, least: f64) {
        let share = self.of("statics") as f64 / self.cases as f64;
        println!(
            "{}: {} robots, the slowest {:.2} s, {:.1} % have statics",
            self.name,
            self.cases,
            self.slowest,
            100.0 * share
        );
        for (what, count) in &self.counts {
            println!("  {count:7} {what}");
        }
        let shown: Vec<&str> = self.failures.iter().take(5).map(String::as_str).collect();
        let shown = shown.join("\n\n");
        assert!(self.failures.is_empty(), "{} of {} wrong:\n{shown}", self.failures.len(), self.cases);
        assert!(share >= least, "only {share} of {} have statics", self.name);
        assert!(self.slowest < PATIENCE, "{} s", self.slowest);
    }
}

/// Draws `cases` robots, or as many as the environment asks for, and judges each; a panic is a failure with the robot.
fn family(
    name: &'static str,
    cases: u32,
    robots: impl Strategy<Value = (Robot, Motion)>,
    judge: impl Fn(&Robot, &Motion, &mut Tally),
) -> Tally {
    let config = config(cases);
    let cases = config.cases;
    let mut runner = TestRunner::new(config);
    let mut tally = Tally { name, ..Tally::default() };
    for _ in 0..cases {
        let (robot, motion) = robots.new_tree(&mut runner).expect("a robot").current();
        let begin = Instant::now();
        let result = catch_unwind(AssertUnwindSafe(|| judge(&robot, &motion, &mut tally)));
        tally.slowest = tally.slowest.max(begin.elapsed().as_secs_f64());
        tally.cases += 1;
        if let Err(panic) = result {
            let text = panic.downcast_ref::<String>().cloned();
            let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned())).unwrap_or_default();
            tally.failures.push(format!("{text}\n{motion:?}\n{robot:?}"));
        }
    }
    tally
}

/// The name of a reason.
fn name(reason: &StaticsError) -> &'static str {
    match reason {
        StaticsError::NotConverged { .. } => "no statics: not converged",
        StaticsError::OutOfRange => "no vibration: out of range",
        StaticsError::Infeasible(reason) => match reason {
            Infeasible::AtAnchor { .. } => "infeasible: at an anchor",
            Infeasible::NoTension { .. } => "infeasible: no tension",
            Infeasible::TooSlack { .. } => "infeasible: too slack",
            Infeasible::WouldPush { .. } => "infeasible: would push",
            Infeasible::OneLine { .. } => "infeasible: one line",
            Infeasible::GoesSlack { .. } => "infeasible: goes slack",
        },
    }
}

/// A reason has words and no NaN.
fn check_reason(reason: &StaticsError) {
    let sentence = reason.to_string();
    assert!(sentence.len() > 20 && !sentence.contains("NaN") && !sentence.contains("inf "), "{sentence}");
}

/// Checks that statics are right or refused with a right reason. If they are right, gives the vibration.
fn judge_statics(robot: &Robot, motion: &Motion, tally: &mut Tally) -> Option<LocalProblem> {
    let found = mechanics::solve(robot, motion.position());
    match found {
        Err(failure) => {
            tally.count(name(&failure.reason));
            check_reason(&failure.reason);
            if matches!(failure.reason, StaticsError::Infeasible(_)) {
                check_verdict(robot, motion.position(), &Err(failure), false);
            }
            None
        }
        Ok(statics) => {
            tally.count("statics");
            check_statics(robot, &statics);
            match LocalProblem::along(robot, statics, motion.direction()) {
                Ok(local) => {
                    assert!(local.rates.iter().all(|rate| rate.first.is_finite() && rate.second.is_finite()));
                    Some(local)
                }
                Err(failure) => {
                    assert_eq!(failure.reason, StaticsError::OutOfRange);
                    tally.count(name(&failure.reason));
                    check_reason(&failure.reason);
                    None
                }
            }
        }
    }
}

/// All of it: statics, eigenvalues at the motion's speed, the critical speed.
fn judge(robot: &Robot, motion: &Motion, tally: &mut Tally) {
    let Some(local) = judge_statics(robot, motion, tally) else { return };
    let drawn = Drawn::new(robot.clone(), local);
    match drawn.local.spectrum(motion.speed()) {
        Err(error) => {
            tally.count("spectrum: not converged");
            assert!(!error.to_string().is_empty());
        }
        Ok(spectrum) => match judge_spectrum(&drawn, motion.speed(), &spectrum) {
            Verdict::Right => tally.count(format!("spectrum: {:?}", spectrum.solver())),
            Verdict::NotJudged(_) => tally.count(format!("spectrum: {:?}, not judged", spectrum.solver())),
            Verdict::Wrong(why) => panic!("spectrum by {:?}: {why}", spectrum.solver()),
        },
    }
    let search = CriticalSearch::new(LIMIT);
    let outcome = search.run(&drawn.local.vibration);
    let way = search.doubt().map_or("by structure".to_owned(), |doubt| format!("by scan, {doubt:?}"));
    match outcome {
        Err(error) => {
            tally.count(format!("critical speed: not converged ({way})"));
            assert!(!error.to_string().is_empty());
        }
        Ok(outcome) => {
            let what = match &outcome {
                Outcome::Found(critical) => {
                    assert!(critical.speed.is_finite() && critical.eigenvalue.norm().is_finite(), "{critical:?}");
                    "found"
                }
                Outcome::NoneUpTo(_) => "none",
            };
            let closely = match &outcome {
                Outcome::Found(critical) => judge_crossing_closely(&drawn, critical),
                Outcome::NoneUpTo(_) => Verdict::Right,
            };
            let judged = match (judge_critical_speed(&drawn, LIMIT, false), closely) {
                (Verdict::Wrong(why), _) | (_, Verdict::Wrong(why)) => panic!("critical speed {way}: {why}"),
                (Verdict::Right, Verdict::Right) => "",
                (Verdict::NotJudged(_), Verdict::Right) => ", crossing judged alone",
                (Verdict::Right, Verdict::NotJudged(_)) => ", by the referee alone",
                (Verdict::NotJudged(_), Verdict::NotJudged(_)) => ", not judged",
            };
            tally.count(format!("critical speed: {what} {way}{judged}"));
        }
    }
}

/// The same robots with something changed.
fn changed(
    robots: impl Strategy<Value = (Robot, Motion)>,
    change: impl Fn(&mut RobotSpec, Motion) -> Motion,
) -> impl Strategy<Value = (Robot, Motion)> {
    robots.prop_map(move |(robot, motion)| {
        let mut spec = (*robot).clone();
        let motion = change(&mut spec, motion);
        (Robot::new(spec).expect("a robot"), motion)
    })
}

#[test]
fn extreme_statics_are_right_or_refused() {
    let judge = |robot: &Robot, motion: &Motion, tally: &mut Tally| {
        judge_statics(robot, motion, tally);
    };
    family("extreme statics", 3000, extreme_robot(2..25), judge).check(0.05);
}

#[test]
fn extreme_vibrations_are_right_or_refused() {
    family("extreme vibrations", 150, extreme_robot(2..6), judge).check(0.05);
}

/// The number of a cable, as good as random: it depends on the motion's speed alone.
fn any_cable(spec: &RobotSpec, motion: &Motion) -> usize {
    (0..spec.cables.len()).max_by_key(|&i| (motion.speed() * (i + 1) as f64).fract().to_bits()).unwrap_or(0)
}

fn at(position: Vec2, motion: &Motion) -> Motion {
    Motion::new(position, motion.direction(), motion.speed()).expect("a motion")
}

#[test]
fn without_gravity() {
    let robots = changed(extreme_robot(2..6), |spec, motion| {
        spec.gravity = 0.0;
        motion
    });
    family("no gravity", 70, robots, judge).check(0.1);
}

#[test]
fn without_damping() {
    let robots = |keep: [f64; 2]| {
        changed(extreme_robot(2..6), move |spec, motion| {
            let Damping { alpha, beta } = spec.damping;
            spec.damping = Damping { alpha: alpha * keep[0], beta: beta * keep[1] };
            motion
        })
    };
    family("no damping", 60, robots([0.0, 0.0]), judge).check(0.1);
    family("no mass damping", 60, robots([0.0, 1.0]), judge).check(0.1);
    family("no stiffness damping", 60, robots([1.0, 0.0]), judge).check(0.1);
}

/// One anchor exactly above or below the platform.
#[test]
fn with_a_vertical_cable() {
    let robots = changed(extreme_robot(2..6), |spec, motion| {
        let i = any_cable(spec, &motion);
        spec.cables[i].anchor.x = motion.position().x;
        motion
    });
    family("vertical cable", 100, robots, judge).check(0.1);
}

/// A number with few digits. Sums and differences of such numbers are exact.
fn rounded(v: Vec2) -> Vec2 {
    v.map(|x| (x * 1024.0).round() / 1024.0)
}

/// The platform exactly in the middle between two anchors. This matters only if they are the equilibrium pair's, which
/// cannot hold it there.
#[test]
fn on_the_line_between_two_anchors() {
    let robots = changed(extreme_robot(2..6), |spec, motion| {
        let (i, position) = (any_cable(spec, &motion), rounded(motion.position()));
        let j = (i + 1) % spec.cables.len();
        spec.cables[i].anchor = rounded(spec.cables[i].anchor);
        spec.cables[j].anchor = 2.0 * position - spec.cables[i].anchor;
        at(position, &motion)
    });
    let judge = |robot: &Robot, motion: &Motion, tally: &mut Tally| {
        let [a, b] = pair(robot).map(|i| robot.cables[i].anchor - motion.position());
        if a + b == Vec2::zeros() {
            let failure = mechanics::solve(robot, motion.position()).expect_err("a pair on one line");
            let prescribed = robot.prescribed().all(|i| failure.cables[i].is_some());
            assert!(!prescribed || matches!(failure.reason, StaticsError::Infeasible(Infeasible::OneLine { .. })));
        }
        self::judge(robot, motion, tally);
    };
    let tally = family("on a line", 100, robots, judge);
    tally.check(0.1);
    assert!(tally.of("infeasible: one line") > 0);
}

/// The platform beside the line between the equilibrium cables' anchors, as near as the rounding of its position. There the
/// side of the line is not known, so no tension is either.
#[test]
fn beside_the_line_of_the_equilibrium_cables() {
    let robots =
        (extreme_robot(2..6), -17.0..-2.0, 0.1..0.9).prop_map(|((robot, motion), exponent, part): (_, f64, f64)| {
            let [a, b] = pair(&robot).map(|i| robot.cables[i].anchor);
            let across = Vec2::new(a.y - b.y, b.x - a.x).normalize() * 10.0_f64.powf(exponent);
            let side = if motion.speed() < 4.0 { across } else { -across };
            let motion = at(a + (b - a) * part + side, &motion);
            (robot, motion)
        });
    let judge = |robot: &Robot, motion: &Motion, tally: &mut Tally| {
        let [a, b] = pair(robot).map(|i| (robot.cables[i].anchor - motion.position()).normalize());
        // Half a rounding of each chord's coordinates, of its length and of both products.
        let side_known = a.perp(&b).abs() > 4.0 * f64::EPSILON;
        let before = tally.of("statics");
        judge_statics(robot, motion, tally);
        assert!(side_known || tally.of("statics") == before, "statics on an unknown side of the line");
    };
    let tally = family("beside the line", 1500, robots, judge);
    tally.check(0.02);
    assert!(tally.of("infeasible: one line") > 0);
}

/// The platform from 1 mm to nothing away from an anchor.
#[test]
fn near_an_anchor() {
    let robots = |exponents: std::ops::Range<f64>| {
        (extreme_robot(2..6), exponents).prop_map(|((robot, motion), exponent)| {
            let anchor = robot.cables[any_cable(&robot, &motion)].anchor;
            let motion = at(anchor + motion.direction() * 10.0_f64.powf(exponent), &motion);
            let towards = Vec2::new(motion.direction().y, 0.5);
            (robot, Motion::new(motion.position(), towards, motion.speed()).expect("a motion"))
        })
    };
    family("within 1 mm of an anchor", 100, robots(-5.0..-3.0), judge).check(0.05);
    let statics = |robot: &Robot, motion: &Motion, tally: &mut Tally| {
        judge_statics(robot, motion, tally);
    };
    family("within 1 µm of an anchor", 1000, robots(-8.9..-6.0), statics).check(0.02);
    let refused = |robot: &Robot, motion: &Motion, tally: &mut Tally| {
        assert!(judge_statics(robot, motion, tally).is_none(), "statics at an anchor");
        let failure = mechanics::solve(robot, motion.position()).expect_err("at an anchor");
        let others = robot.prescribed().all(|i| failure.cables[i].is_some());
        assert!(!others || matches!(failure.reason, StaticsError::Infeasible(Infeasible::AtAnchor { .. })));
    };
    let tally = family("at an anchor", 500, robots(-300.0..-9.5), refused);
    tally.check(0.0);
    assert!(tally.of("infeasible: at an anchor") > 0);
}

/// A prescribed tension slightly above and below the least one that carries the cable. The cable's energy gives that one.
#[test]
fn near_the_slack_limit() {
    let robots = (extreme_robot(2..9), -6.0..-0.5).prop_map(|((robot, motion), exponent): (_, f64)| {
        let above = 10.0_f64.powf(exponent);
        let mut spec = (*robot).clone();
        spec.gravity = spec.gravity.max(0.01);
        (
            Robot::new(spec).expect("a robot"),
            Motion::new(motion.position(), motion.direction(), above).expect("a motion"),
        )
    });
    let judge = |robot: &Robot, motion: &Motion, tally: &mut Tally| {
        let i = robot.prescribed().next().expect("a prescribed cable");
        let chord = robot.cables[i].anchor - motion.position();
        // In units in which a cable as long as the chord weighs 100.
        let unit = 100.0 / (robot.weight_per_length(i) * chord.norm());
        let Some((length, least)) = Hung::of(robot, i).in_units(unit).least_tension(chord) else {
            return tally.count("limit not known");
        };
        let with_tension = |tension: f64| {
            let mut spec = (**robot).clone();
            spec.cables[i].tension = TensionLaw::Constant(tension / unit);
            let robot = Robot::new(spec).expect("a robot");
            let found = mechanics::solve(&robot, motion.position());
            if let Ok(statics) = &found {
                check_statics(&robot, statics);
            }
            found.map_or_else(|failure| failure.cables[i].clone(), |statics| Some(statics.cables[i].clone()))
        };
        let shape = with_tension(least * (1.0 + motion.speed()));
        let found = shape.expect("a shape with somewhat more than the least tension").length;
        assert!(found < length, "{found} m is slack: the tension is least at {length} m");
        assert!(with_tension(least * (1.0 - 1e-6)).is_none(), "a shape with less than the least tension");
        tally.count("statics");
    };
    family("slack limit", 150, robots, judge).check(0.3);
}

/// The largest distance between the places of a node in two poses.
fn moved(a: &Pose, b: &Pose) -> f64 {
    let nodes = |pose: &Pose| pose.statics.cables.iter().flat_map(|shape| shape.nodes.clone()).collect::<Vec<_>>();
    nodes(a).iter().zip(&nodes(b)).map(|(a, b)| (b - a).norm()).fold(0.0, f64::max)
}

/// Fails if nodes jump between two poses. If nodes move continuously, they move little in each part of the step. A jump
/// keeps its size in one of the two halves. A square root, as at the end of a taut branch, falls to 1/64 in 12 halvings.
fn check_no_jump(robot: &Robot, mut a: Pose, mut b: Pose) {
    let first = moved(&a, &b);
    for _ in 0..12 {
        let step = b.position - a.position;
        if moved(&a, &b) <= 3.0 * step.norm() {
            return;
        }
        // If there is no shape in the middle, the poses belong to different parts of the workspace.
        let Some(middle) = pose(robot, a.position + 0.5 * step, step.normalize()) else { return };
        if moved(&a, &middle) > moved(&middle, &b) { b = middle } else { a = middle }
    }
    let last = moved(&a, &b);
    assert!(last < 0.1 * first, "nodes jump by {last} m of {first} m between {:?} and {:?}", a.position, b.position);
}

/// Fails unless feasibility ends between the feasible pose at `inside` and the one at `outside` for a reason that shows
/// inside already: a tension or a sine that falls to zero, a law that does, an anchor, an element that carries nothing any
/// more, or a length that changes as the square root of the distance from the border, as where a taut shape meets a slack
/// one.
fn check_border(robot: &Robot, mut inside: Vec2, mut outside: Vec2) -> &'static str {
    while (outside - inside).norm() > 1e-9 {
        let middle = 0.5 * (inside + outside);
        if mechanics::solve(robot, middle).is_ok() {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    let reason = mechanics::solve(robot, outside).expect_err("outside").reason;
    let inwards = (inside - outside).normalize();
    let near = |distance: f64| pose(robot, inside + inwards * distance, inwards);
    let StaticsError::Infeasible(infeasible) = reason else { panic!("{reason} at {outside:?}") };
    match infeasible {
        Infeasible::WouldPush { .. } => {
            let statics = mechanics::solve(robot, inside).expect("inside");
            let load = load(robot, |i| &statics.cables[i]);
            let tensions = straight_tensions(robot, inside, load);
            let weaker = tensions[0].min(tensions[1]) / tensions[0].max(tensions[1]);
            let [a, b] = pair(robot).map(|i| (robot.cables[i].anchor - inside).normalize());
            // It falls to zero over metres, faster only where a prescribed cable is about to go slack; or both rise beyond all
            // bounds towards the line of the anchors, behind which they push.
            assert!(weaker < 1e-3 || a.perp(&b).abs() < 1e-6, "{tensions:?} at {inside:?}, but outside {reason}");
        }
        Infeasible::TooSlack { cable, .. } | Infeasible::GoesSlack { cable } => {
            let statics = mechanics::solve(robot, inside).expect("inside");
            let forces = statics.cables[cable].forces.iter().map(Vec2::norm);
            let (least, largest) = forces.fold((f64::INFINITY, 0.0_f64), |(a, b), force| (a.min(force), b.max(force)));
            if least < 1e-6 * largest {
                return name(&reason);
            }
            if let (Some(a), Some(b)) = (near(1e-6), near(1e-4)) {
                let [a, b] = [a, b].map(|pose| pose.rates[cable].first.abs());
                assert!(a > 3.0 * b || a > 1e3, "{reason} at {outside:?}, but L' is {a} and {b} inside");
            }
        }
        Infeasible::OneLine { .. } | Infeasible::AtAnchor { .. } | Infeasible::NoTension { .. } => {
            check_verdict(robot, outside, &mechanics::solve(robot, outside), false);
        }
    }
    name(&reason)
}

/// Follows a drag from a motion's position along its direction in steps of 2 cm.
fn follow(robot: &Robot, motion: &Motion, steps: u32, tally: &mut Tally) {
    let step = motion.direction() * 0.02;
    let mut before: Option<Pose> = None;
    let mut ever = false;
    for k in 0..steps {
        let position = motion.position() + step * f64::from(k);
        let here = match mechanics::solve(robot, position) {
            Err(failure) => {
                assert!(matches!(failure.reason, StaticsError::Infeasible(_)), "{failure}");
                None
            }
            Ok(_) => pose(robot, position, motion.direction()),
        };
        ever |= here.is_some();
        match (before.take(), &here) {
            (Some(a), Some(b)) => {
                check_continuous(robot, &a, b, 12);
                check_no_jump(robot, a, pose(robot, position, motion.direction()).expect("as before"));
            }
            (Some(a), None) => {
                let reason = check_border(robot, a.position, position);
                tally.count(format!("border, {reason}"));
            }
            (None, Some(b)) if k > 0 => {
                let reason = check_border(robot, b.position, position - step);
                tally.count(format!("border, {reason}"));
            }
            _ => {}
        }
        before = here;
    }
    tally.count(if ever { "statics" } else { "no statics on the way" });
}

#[test]
fn shapes_do_not_jump_on_a_drag() {
    let follow = |robot: &Robot, motion: &Motion, tally: &mut Tally| follow(robot, motion, 120, tally);
    family("drags of random robots", 60, moving_robot(2..16), follow).check(0.2);
    family("drags of extreme robots", 60, extreme_robot(2..16), follow).check(0.1);
    let given = |name: &'static str, cases: u32, robot: Robot, from: [Vec2; 2]| {
        let drags = (0.0..1.0, 0.0..1.0, 0.0..std::f64::consts::TAU).prop_map(move |(x, y, angle): (f64, f64, f64)| {
            let position = from[0] + (from[1] - from[0]).component_mul(&Vec2::new(x, y));
            (robot.clone(), Motion::new(position, Vec2::new(angle.cos(), angle.sin()), 1.0).expect("a motion"))
        });
        family(name, cases, drags, follow)
    };
    let border = [Vec2::new(7.0, -0.3), Vec2::new(7.6, 0.3)];
    given("drags of the paper's robot near its border", 30, paper().expect("the paper's robot"), border).check(0.5);
    let slack = presets::find("slack").expect("a preset").scenario().to_robot().expect("a robot").0;
    given("drags of slack ropes", 30, slack, [Vec2::new(-6.0, -2.0), Vec2::new(6.0, 2.0)]).check(0.3);
}
