//! The built-in scenarios: sound where they start, and what their descriptions promise is seen.
#![cfg(feature = "scenario")]

mod common;

use common::close;
use tautline::robot::TensionLaw;
use tautline::scenario::report::{CriticalReport, DEFAULT_MAX_SPEED};
use tautline::scenario::{Report, Scenario, presets};

fn preset(name: &str) -> Scenario {
    presets::find(name).expect("a preset").scenario()
}

fn report(scenario: &Scenario) -> Report {
    let (robot, motion) = scenario.to_robot().expect("a physical scenario");
    Report::analyze(&robot, &motion, DEFAULT_MAX_SPEED)
}

fn critical(scenario: &Scenario) -> CriticalReport {
    report(scenario).critical.expect("a critical speed")
}

fn at(scenario: &Scenario, position: [f64; 2]) -> Scenario {
    let mut scenario = scenario.clone();
    scenario.motion.position = position;
    scenario
}

/// With `tension` in both lower cables.
fn with_lower(scenario: &Scenario, tension: f64) -> Scenario {
    let mut scenario = scenario.clone();
    for cable in &mut scenario.cables[2..4] {
        assert!(matches!(cable.tension, TensionLaw::Constant(_)));
        cable.tension = TensionLaw::Constant(tension);
    }
    scenario
}

#[test]
fn the_names_are_known() {
    let names: Vec<&str> = presets::PRESETS.iter().map(|preset| preset.name).collect();
    assert_eq!(names, ["paper", "paper-tangent", "slack", "building", "lab", "five-cables"]);
}

#[test]
fn each_starts_stable_below_a_critical_speed() {
    for preset in presets::PRESETS {
        let scenario = preset.scenario();
        let report = report(&scenario);
        assert_eq!((report.feasible, report.stable), (Some(true), Some(true)), "{}", preset.name);
        let critical = report.critical.as_ref().expect("a critical speed");
        assert!(critical.speed > scenario.motion.speed, "{}: {critical:?}", preset.name);
    }
}

/// The platform can be moved by a fifth of the workspace each way; only the slack robot is close to its limits.
#[test]
fn there_is_room_around_the_start() {
    for preset in presets::PRESETS {
        let scenario = preset.scenario();
        let span = |axis: usize| {
            let coordinates = scenario.cables.iter().map(|cable| cable.anchor[axis]);
            coordinates.clone().fold(f64::MIN, f64::max) - coordinates.fold(f64::MAX, f64::min)
        };
        let [x, y] = scenario.motion.position;
        let steps = || (-4_i32..=4).map(|step| 0.05 * f64::from(step));
        let places = steps().flat_map(|i| steps().map(move |j| (i, j)));
        let infeasible = places.filter(|(i, j)| {
            let (robot, motion) = at(&scenario, [x + i * span(0), y + j * span(1)]).to_robot().expect("physical");
            tautline::LocalProblem::new(&robot, &motion).is_err()
        });
        assert_eq!(infeasible.count() > 0, preset.name == "slack", "{}", preset.name);
    }
}

#[test]
fn slack_ropes_sag_and_have_little_room() {
    let slack = preset("slack");
    for cable in &report(&slack).cables[2..4] {
        let [a, b] = [cable.nodes[0], cable.nodes[10]];
        let chord = [b[0] - a[0], b[1] - a[1]];
        let length = chord[0].hypot(chord[1]);
        let off = |node: &[f64; 2]| ((node[0] - a[0]) * chord[1] - (node[1] - a[1]) * chord[0]).abs() / length;
        let sag = cable.nodes.iter().map(off).fold(0.0, f64::max) / length;
        close(sag, 1.0 / 6.0, 0.005, "sag");
        // "Can only just hold up their own weight".
        let weight = cable.unstretched_length * slack.cable.mass_per_length * slack.gravity;
        assert!(weight < cable.tension_at_platform && cable.tension_at_platform < 1.05 * weight, "{weight}");
    }
    let up = critical(&at(&slack, [0.0, 1.0]));
    assert!(up.speed < slack.motion.speed, "{up:?}");
    for side in [-2.0, 2.0] {
        let reason = report(&at(&slack, [side, 0.0])).reason.expect("a reason");
        assert!(reason.contains("cannot hold its own weight"), "{reason}");
    }
}

#[test]
fn damping_decides_on_the_building_and_tension_hardly() {
    let building = preset("building");
    let before = critical(&building).speed;
    let tighter = critical(&with_lower(&building, 6000.0)).speed;
    close(tighter / before, 1.0 + 1.0 / 9.0, 0.01, "twice the tension");
    let mut damped = building;
    damped.damping.alpha *= 2.0;
    close(critical(&damped).speed / before, 1.8, 0.01, "twice the mass damping");
}

#[test]
fn cords_on_the_desk_are_tuned_like_strings() {
    let lab = preset("lab");
    let (before, after) = (critical(&lab), critical(&with_lower(&lab, 20.0)));
    close(before.frequency_hz, 94.0, 0.5, "frequency");
    close(after.frequency_hz / before.frequency_hz, 2.0_f64.sqrt(), 0.005, "twice the tension");
    close(after.speed / before.speed, 1.5, 0.05, "twice the tension");
}

#[test]
fn each_of_five_cables_is_responsible_in_turn() {
    let mut five = preset("five-cables");
    let mut turn = Vec::new();
    for degrees in (0..360).step_by(10) {
        let angle = f64::from(degrees).to_radians();
        five.motion.direction = [angle.cos(), angle.sin()];
        let report = report(&five);
        let cable = report.critical.as_ref().expect("a critical speed").cable;
        let rate = report.cables[cable - 1].length_rate;
        assert!(rate < -0.5, "cable {cable} at {degrees}°: {rate}");
        turn.push(cable);
    }
    turn.dedup();
    assert_eq!(turn, [4, 2, 1, 3, 5, 4]);
}
