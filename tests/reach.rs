//! The value that gives a wanted critical speed, on random robots, against a dense scan with plain bisection.

mod common;

use std::cell::Cell;

use common::random;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use tautline::Motion;
use tautline::robot::{Robot, TensionLaw};
use tautline::scenario::{Parameter, Scenario, presets};
use tautline::stability::steps::finish;
use tautline::study::reach::{At, REACHED, reach};
use tautline::study::{Answer, Reach, Reached, Study, Varied, Verdict, WhatIf, evenly, verdict};

const LIMIT: f64 = 40.0;
/// Robots that are tried.
const ROBOTS: u32 = 100;
/// The values that cut a range into stretches.
const STRETCHES: usize = 9;
/// The referee looks at so many values within each stretch.
const FINER: usize = 4;

/// A number of a robot, over a range.
struct Question {
    scenario: Scenario,
    number: Parameter,
    range: [f64; 2],
}

impl Question {
    /// The same from half to double of the present value, or from −1 to +1 of it around where it may be negative.
    fn new(scenario: Scenario, number: Parameter) -> Self {
        let value = number.get(&scenario);
        let positive = !matches!(
            number,
            Parameter::Position(_) | Parameter::Anchor(..) | Parameter::Horizontal(..) | Parameter::Vertical(..)
        );
        let range = match (positive, value == 0.0) {
            (true, true) => [0.0, 1.0],
            (true, false) => [0.5 * value, 2.0 * value],
            (false, _) => [value - 2.0, value + 2.0],
        };
        Self { scenario, number, range }
    }

    fn variant(&self, value: f64) -> Option<(Robot, Motion)> {
        let mut scenario = self.scenario.clone();
        self.number.set(&mut scenario, value);
        scenario.to_robot().ok()
    }

    /// The critical speed, infinite where there is none up to the limit.
    fn speed(&self, value: f64) -> Option<f64> {
        let (robot, motion) = self.variant(value)?;
        match verdict(&robot, &motion, LIMIT).0 {
            Verdict::Critical(critical) => Some(critical.speed),
            Verdict::NoneUpTo(_) => Some(f64::INFINITY),
            _ => None,
        }
    }

    fn values(&self, count: usize) -> Vec<f64> {
        (0..count).map(|i| evenly(self.range[0], self.range[1], i, count)).collect()
    }

    fn reach(&self, target: f64) -> Reached {
        let number = Varied { path: self.number.path(), values: self.values(STRETCHES) };
        let question = Reach { number, target, limit: LIMIT };
        reach(&question, &|values| self.variant(values[0]), self.number.get(&self.scenario))
    }

    /// The crossings that a dense scan with plain bisection finds, and what it has seen at each value.
    fn referee(&self, target: f64) -> (Vec<At>, Vec<Option<f64>>) {
        let scan: Vec<(f64, Option<f64>)> =
            self.values(FINER * (STRETCHES - 1) + 1).into_iter().map(|value| (value, self.speed(value))).collect();
        let mut found = Vec::new();
        for pair in scan.windows(2) {
            let [(mut a, Some(at_a)), (mut b, Some(at_b))] = pair[..] else { continue };
            if (at_a >= target) == (at_b >= target) {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (a + b);
                // What is not known counts as the other side.
                if self.speed(middle).is_some_and(|speed| (speed >= target) == (at_a >= target)) {
                    a = middle;
                } else {
                    b = middle;
                }
            }
            let ends = [a, b].into_iter().filter_map(|value| Some(At { value, speed: self.speed(value)? }));
            found.extend(ends.filter(|at| (at.speed - target).abs() <= REACHED * target).take(1));
        }
        (found, scan.into_iter().map(|(_, speed)| speed).collect())
    }
}

/// A random robot that is critical at its pose, one of its numbers, and what is wanted as a multiple of the critical speed.
fn questions() -> impl Strategy<Value = (Question, f64)> {
    let factor = prop_oneof![0.9..0.99, 1.01..1.1];
    (random::moving_robot(2..4), any::<prop::sample::Index>(), factor).prop_filter_map(
        "critical",
        |(drawn, which, factor)| {
            let (robot, motion) = drawn;
            let scenario = Scenario::new(&robot, &motion);
            let numbers: Vec<Parameter> = Parameter::all(&scenario)
                .into_iter()
                .filter(|number| {
                    !matches!(number, Parameter::Elements | Parameter::Speed | Parameter::DirectionComponent(_))
                })
                .collect();
            let number = *which.get(&numbers);
            let question = Question::new(scenario, number);
            let speed =
                question.speed(number.get(&question.scenario)).filter(|speed| *speed > 0.01 && *speed < 20.0)?;
            Some((question, factor * speed))
        },
    )
}

impl std::fmt::Debug for Question {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} from {:?} of {}", self.number.path(), self.range, self.scenario.to_json())
    }
}

/// What is said to be reached is, at no value farther away than the referee's; and where nothing is, the referee finds
/// nothing either, and no value of the list has a speed that is nearer.
#[test]
fn random_robots_against_a_dense_scan() {
    let (reached, not) = (Cell::new(0), Cell::new(0));
    let mut runner = TestRunner::new(random::config(ROBOTS));
    let outcome = runner.run(&questions(), |(question, target)| {
        let (crossings, speeds) = question.referee(target);
        let present = question.number.get(&question.scenario);
        let away = |value: f64| (value - present).abs();
        match question.reach(target) {
            Reached::Reached(At { value, speed }) => {
                reached.set(reached.get() + 1);
                prop_assert!((question.range[0]..=question.range[1]).contains(&value));
                let own = question.speed(value);
                prop_assert!(own.is_some_and(|own| (own - target).abs() <= REACHED * target), "{own:?} for {target}");
                prop_assert!((speed - target).abs() <= REACHED * target);
                let width = question.range[1] - question.range[0];
                for other in &crossings {
                    prop_assert!(away(value) <= away(other.value) + 1e-6 * width, "{value}, and nearer {other:?}");
                }
            }
            Reached::NotReached { below, above } => {
                not.set(not.get() + 1);
                prop_assert!(crossings.is_empty(), "{crossings:?} for {target}");
                prop_assert!(below.is_none_or(|at| at.speed < target) && above.is_none_or(|at| at.speed > target));
                for at in below.into_iter().chain(above) {
                    let own = question.speed(at.value);
                    prop_assert!(own.is_some_and(|own| (own - at.speed).abs() <= 1e-12 * own), "{own:?}: {at:?}");
                }
                let nearest = |at: Option<At>| at.map_or(f64::INFINITY, |at| (at.speed - target).abs());
                // Between the values of the list a jump may hide a speed that is nearer still.
                let listed = speeds.into_iter().step_by(FINER).flatten();
                for speed in listed.filter(|speed| speed.is_finite()) {
                    let ours = if speed >= target { nearest(above) } else { nearest(below) };
                    prop_assert!((speed - target).abs() >= ours - 1e-9 * target, "{speed} for {target}: {ours}");
                }
            }
        }
        Ok(())
    });
    outcome.expect("as the referee says");
    let (reached, not) = (reached.get(), not.get());
    println!("{reached} reached, {not} not");
    assert!(reached >= 20 && not >= 10, "{reached} reached, {not} not: both must be tried");
}

fn paper() -> Scenario {
    presets::PRESETS[0].scenario()
}

/// The critical speed asked for is that of a value, which is found again, or another one that is nearer to the present.
#[test]
fn the_value_that_a_critical_speed_comes_from_is_found_again() {
    for (number, factor) in [(Parameter::PlatformMass, 1.3), (Parameter::MassPerLength, 0.8), (Parameter::Alpha, 1.5)] {
        let question = Question::new(paper(), number);
        let wanted = factor * number.get(&question.scenario);
        let target = question.speed(wanted).expect("a critical speed");
        let Reached::Reached(at) = question.reach(target) else { panic!("{number:?}") };
        let away = |value: f64| (value - number.get(&question.scenario)).abs();
        assert!(away(at.value) <= away(wanted) + 1e-4 * wanted, "{number:?}: {} for {wanted}", at.value);
        assert!(question.speed(at.value).is_some_and(|speed| (speed - target).abs() <= REACHED * target), "{at:?}");
    }
}

#[test]
fn what_is_out_of_reach_says_how_far_it_gets() {
    let tension = |scenario: &Scenario| {
        let law = |cable: &tautline::scenario::json::Cable| cable.tension != TensionLaw::Equilibrium;
        scenario.cables.iter().position(law).expect("a prescribed tension")
    };
    let scenario = paper();
    let cable = tension(&scenario);
    let number = Parameter::all(&scenario)
        .into_iter()
        .find(|number| number.path().starts_with(&format!("cables[{cable}].tension")));
    let question = Question::new(scenario, number.expect("a number of its law"));
    let Reached::NotReached { below: Some(below), above: None } = question.reach(39.0) else {
        panic!("{:?}", question.reach(39.0))
    };
    assert!(below.speed < 39.0 && question.speed(below.value) == Some(below.speed));
    // Nothing is physical below zero.
    let nowhere = Question { range: [-3.0, -1.0], ..Question::new(paper(), Parameter::PlatformMass) };
    assert_eq!(nowhere.reach(8.0), Reached::NotReached { below: None, above: None });
}

/// The answers of "what if" are those of the scenarios with these values; values that are not physical are not known.
#[test]
fn what_if_is_the_analysis_with_other_values() {
    let scenario = paper();
    let varied = |number: Parameter, values: &[f64]| Varied { path: number.path(), values: values.to_vec() };
    let numbers = [Parameter::PlatformMass, Parameter::YoungsModulus];
    let what_if = WhatIf {
        numbers: vec![varied(numbers[0], &[-1.0, 2.0, 5.0]), varied(numbers[1], &[125e6, 250e6])],
        limit: LIMIT,
    };
    let with = |values: &[f64]| {
        let mut other = scenario.clone();
        for (number, value) in numbers.iter().zip(values) {
            number.set(&mut other, *value);
        }
        other.to_robot().ok()
    };
    let study = Study::WhatIf(what_if.clone());
    assert_eq!(study.len(), 6);
    let mut order = study.order();
    order.sort_unstable();
    assert_eq!(order, (0..6).collect::<Vec<_>>());
    for place in 0..study.len() {
        let Some(Answer::Critical { verdict: found, wave_limit, .. }) = finish(study.varied_in_steps(&with, place))
        else {
            panic!("no answer")
        };
        let expected = with(&what_if.values(place)).map(|(robot, motion)| verdict(&robot, &motion, LIMIT));
        assert_eq!((found, wave_limit), expected.unwrap_or((Verdict::Unknown, None)), "place {place}");
        // One robot alone tells nothing.
        let (robot, _) = scenario.to_robot().expect("physical");
        assert_eq!(study.answer(&robot, place), study.unknown(place));
    }
}
