//! The fastest profile: known times, limits that are kept, and that nothing faster keeps them.

use tautline::flight::{self, FastestMove, LimitOptions, LimitsError, Place};
use tautline::mechanics::{LengthRates, SlackAcceleration, SlackLimit};
use tautline::robot::{self, Profile, Trajectory, Vec2};
use tautline::stability::Outcome;
use tautline::{LocalProblem, Motion};

const NONE: LimitOptions = LimitOptions {
    safety: 0.8,
    frozen: false,
    waves: false,
    slack: None,
    acceleration: None,
    winch_speed: None,
    winch_acceleration: None,
};

/// Numbers in 0..1 that follow no pattern.
fn numbers() -> impl FnMut() -> f64 {
    let mut seed = 0_u32;
    move || {
        seed += 1;
        (f64::from(seed) * 0.618_033_988_749_895).fract()
    }
}

/// Places of a path of the length `distance`, with a cable whose rates and a local limit whose speed vary.
fn invented(distance: f64, intervals: u32, mut number: impl FnMut() -> f64) -> Vec<Place> {
    let [phase, turns, size] = [number() * 6.0, 1.0 + 3.0 * number(), 0.2 + number()];
    let place = |i: u32| {
        let s = distance * f64::from(i) / f64::from(intervals);
        let wave = (phase + turns * s / distance * 6.0).sin();
        let slack = |value| Some(SlackLimit { value, cable: 0 });
        Place {
            s,
            position: Vec2::new(s, 0.0),
            lengths: vec![1.0],
            tensions: vec![[1.0, 1.0]],
            rates: vec![LengthRates { first: wave, second: 0.1 * size * (phase + s).cos() }],
            wave_limit: Some(4.0 + 2.0 * wave),
            critical_speed: None,
            slack: Some(SlackAcceleration {
                accelerating: slack(3.0 + wave),
                braking: slack(2.5 - wave),
                deviation_per_acceleration: 0.0,
            }),
        }
    };
    (0..=intervals).map(place).collect()
}

/// How far the limits are exceeded by b = ṡ² at the places: the largest quotient of what is used and what is allowed.
fn used(places: &[Place], options: &LimitOptions, b: &[f64]) -> f64 {
    let mut most = 0.0_f64;
    for (i, place) in places.iter().enumerate() {
        let v = b[i].sqrt();
        if options.waves {
            most = most.max(v / (options.safety * place.wave_limit.expect("a limit")));
        }
        let rates = place.rates[0];
        most = most.max(options.winch_speed.map_or(0.0, |rate| (rates.first * v).abs() / rate));
        let Some(next) = places.get(i + 1) else { continue };
        let u = (b[i + 1] - b[i]) / (2.0 * (next.s - place.s));
        most = most.max(options.acceleration.map_or(0.0, |a| u.abs() / a));
        let winch = (rates.first * u + rates.second * b[i]).abs();
        most = most.max(options.winch_acceleration.map_or(0.0, |a| winch / a));
        if let Some(share) = options.slack {
            let slack = place.slack.expect("slack");
            let limit = if u > 0.0 { slack.accelerating } else { slack.braking };
            most = most.max(u.abs() / (share * limit.expect("a limit").value));
        }
    }
    most
}

fn squares(found: &FastestMove) -> Vec<f64> {
    found.rows.iter().map(|row| row.v * row.v).collect()
}

#[test]
fn where_the_acceleration_alone_acts_the_time_is_exact() {
    let options = LimitOptions { acceleration: Some(3.0), ..NONE };
    for (distance, intervals) in [(12.0, 400), (0.5, 402), (700.0, 1000)] {
        let found = flight::limits(&[invented(distance, intervals, numbers())], &options).expect("a move");
        let (time, peak) = (2.0 * f64::sqrt(distance / 3.0), f64::sqrt(distance * 3.0));
        assert!((found.duration() / time - 1.0).abs() < 1e-12, "{} {time}", found.duration());
        assert!((found.peak() / peak - 1.0).abs() < 1e-12, "{} {peak}", found.peak());
    }
}

/// Limits are kept at all places to rounding, up to the next one to the order of the grid; and where any run of places is
/// passed a little faster, one is not kept. A run that begins anywhere and is faster there is all that a faster move can be.
#[test]
fn limits_are_kept_and_nothing_faster_keeps_them() {
    let mut number = numbers();
    for case in 0..24 {
        let places = invented(4.0 + 10.0 * number(), 60, &mut number);
        let maybe = |value: f64, index: i32| (case % 5 != index).then_some(value);
        let options = LimitOptions {
            waves: case % 2 == 0,
            acceleration: maybe(3.0, 1),
            winch_speed: maybe(2.5, 2),
            winch_acceleration: maybe(1.5, 3),
            slack: Some(0.9),
            ..NONE
        };
        let b = squares(&flight::limits(std::slice::from_ref(&places), &options).expect("a move"));
        let most = used(&places, &options, &b);
        assert!(most <= 1.0 + 1e-9, "case {case}: {most}");
        for from in 1..60 {
            for to in from..60 {
                let mut faster = b.clone();
                faster[from..=to].iter_mut().for_each(|b| *b *= 1.0 + 1e-5);
                let most = used(&places, &options, &faster);
                assert!(most > 1.0 + 1e-8, "case {case}: {from}..={to} could be faster, {most}");
            }
        }
    }
}

/// Times and peak speeds that an independent program has found for the published robot from x = −6 m to 6 m.
#[test]
fn times_are_those_of_an_independent_program() {
    let robot = robot::paper().expect("a robot");
    let profile = Profile::Constant { speed: 1.0 };
    let path = Trajectory::straight(Vec2::new(-6.0, 0.0), &[Vec2::new(6.0, 0.0)], profile).expect("a path");
    let legs = flight::legs(&path, flight::INTERVALS);
    let place = |(s, point): &(f64, robot::PathPoint)| {
        let mut place = Place::at(&robot, *s, point).expect("a place");
        let motion = Motion::new(point.position, point.tangent, 0.0).expect("a motion");
        let local = LocalProblem::new(&robot, &motion).map_err(|failure| failure.reason).expect("a pose");
        if let Outcome::Found(critical) = local.critical_speed(40.0).expect("a search") {
            place.critical_speed = Some(critical.speed);
        }
        place
    };
    let legs: Vec<Vec<Place>> = legs.iter().map(|leg| leg.iter().map(place).collect()).collect();
    let frozen = LimitOptions { frozen: true, acceleration: Some(6.0), ..NONE };
    for (options, time, peak) in [
        (LimitOptions { acceleration: Some(3.0), ..frozen }, 4.000, 6.00),
        (frozen, 2.842, 8.21),
        (LimitOptions { frozen: false, waves: true, ..frozen }, 2.828, 8.49),
        (LimitOptions { winch_speed: Some(4.0), winch_acceleration: Some(4.0), ..frozen }, 4.138, 4.35),
    ] {
        let found = flight::limits(&legs, &options).expect("a move");
        assert!((found.duration() - time).abs() <= 0.0005, "{options:?}: {} s, not {time}", found.duration());
        assert!((found.peak() - peak).abs() <= 0.005, "{options:?}: {} m/s, not {peak}", found.peak());
    }
}

#[test]
fn what_has_no_fastest_move_is_refused_with_the_place() {
    let options = LimitOptions { frozen: true, acceleration: Some(1.0), ..NONE };
    let mut places = invented(6.0, 40, numbers());
    assert_eq!(flight::limits(&[places.clone()], &NONE), Err(LimitsError::Unlimited));
    assert_eq!(flight::limits(&[], &options), Err(LimitsError::NoPath));
    assert_eq!(flight::limits(&[places[..1].to_vec()], &options), Err(LimitsError::NoPath));
    // One leg after the other: at rest between them.
    let first = flight::limits(&[places.clone()], &options).expect("a move");
    let mut second = places.clone();
    for place in &mut second {
        place.s += 6.0;
    }
    let both = flight::limits(&[places.clone(), second], &options).expect("a move");
    assert!((both.duration() - 2.0 * first.duration()).abs() < 1e-12 && both.rows.len() == 81);
    assert!(both.rows[40].v.abs() < 1e-12 && (both.rows[40].s - 6.0).abs() < 1e-12);
    places[7].critical_speed = Some(0.0);
    let (s, position) = (places[7].s, places[7].position);
    assert_eq!(flight::limits(&[places], &options), Err(LimitsError::NoSpeed { s, position }));
}
