//! Flights on the command line: `tautline fly` against reference flights, its options, its tables and its faults.
#![cfg(all(feature = "cli", not(target_arch = "wasm32")))]

mod common;

use common::close;
use common::shell::{refuse, succeed};
use serde_json::{Value, json};
use tautline::scenario::{Path, ProfileKind, Scenario, presets};

/// A reference flight: its file and the scenario with its path.
fn reference(name: &str) -> (Value, Scenario) {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/flights");
    let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).expect("a reference flight");
    let file: Value = serde_json::from_str(&text).expect("JSON");
    let mut scenario = Scenario::from_json(&file["scenario"].to_string()).expect("a scenario");
    let [start, direction] = ["start", "direction"].map(|name| pair(&file["path"][name]));
    let distance = number(&file["path"]["distance"]);
    let profile = &file["profile"];
    scenario.motion.position = start;
    let end = [0, 1].map(|i| start[i] + distance * direction[i]);
    let mut flown = Path::new(vec![end], number(&profile["v"]));
    flown.profile = match profile["kind"].as_str().expect("a profile") {
        "quintic" => ProfileKind::Quintic,
        "trapezoid" => ProfileKind::Trapezoid,
        "scurve" => ProfileKind::Scurve,
        _ => ProfileKind::Constant,
    };
    flown.acceleration = profile["a"].as_f64().unwrap_or(flown.acceleration);
    flown.jerk = profile["jerk"].as_f64().unwrap_or(flown.jerk);
    flown.hold = number(&file["hold"]);
    scenario.path = Some(flown);
    (file, scenario)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

fn pair(value: &Value) -> [f64; 2] {
    [number(&value[0]), number(&value[1])]
}

fn fly(scenario: &Scenario, more: &[&str]) -> Value {
    let arguments = [&["fly", "-", "--json"], more].concat();
    serde_json::from_str(&succeed(&arguments, &scenario.to_json())).expect("JSON")
}

/// Every field of every sample, the residual and the gain, as two independent integrators have them.
#[test]
fn json_is_the_reference_flight() {
    for name in ["01_paper_quintic_5", "02_paper_constant_5_kick", "12_case22_quintic_5"] {
        let (file, scenario) = reference(name);
        let kick = file["kick"].as_array().map(|kick| format!("{},{}", kick[0], kick[1]));
        let options: Vec<&str> = kick.iter().flat_map(|kick| ["--kick", kick]).collect();
        let found = fly(&scenario, &options);
        assert_eq!(
            (&found["schema"], &found["feasible"], &found["reason"]),
            (&json!("tautline/flight/1"), &json!(true), &Value::Null)
        );
        close(number(&found["duration"]), number(&file["summary"]["duration_of_move"]), 1e-12, name);
        let samples = file["samples"].as_array().expect("samples");
        assert_eq!(found["samples"].as_array().map(Vec::len), Some(samples.len()), "{name}");
        for (sample, expected) in found["samples"].as_array().into_iter().flatten().zip(samples) {
            for (field, expected) in expected.as_object().expect("an object") {
                let tolerance = match field.as_str() {
                    "t" | "s" | "v" | "a" | "unstretched_length" => 1e-8,
                    "deviation" => 1e-6,
                    // The fastest waves that matter run at some ten rad/s.
                    "deviation_velocity" => 1e-4,
                    "tension_at_platform" | "element_force_at_winch" | "smallest_element_force" => 1e-2,
                    _ => continue,
                };
                let what = format!("{name} at {}: {field}", sample["t"]);
                match expected {
                    Value::Array(list) => {
                        for (i, expected) in list.iter().enumerate() {
                            close(number(&sample[field][i]), number(expected), tolerance, &what);
                        }
                    }
                    expected => close(number(&sample[field]), number(expected), tolerance, &what),
                }
            }
        }
        match file["summary"]["residual_max_m"].as_f64() {
            Some(residual) => close(number(&found["residual"]), residual, 1e-6, name),
            None => assert_eq!(found["residual"], Value::Null, "{name}"),
        }
        let linearisation = file["scenario"]["linearisation"].as_str().expect("a linearisation");
        for (field, name) in [("action", "gain_A"), ("energy", "gain_E"), ("displacement", "gain_D")] {
            let expected = number(&file["ltv"][linearisation][name]);
            close(number(&found["gain"][field]), expected, 1e-4 * expected, name);
        }
    }
}

/// The summary of the path, by docs/theory.md: least critical speed 4.88 m/s at the start, wave limit 9.16 m/s at the ends.
#[test]
fn options_take_the_place_of_the_path_of_the_file() {
    let mut scenario = presets::find("paper").expect("a robot").scenario();
    scenario.motion.position = [-6.0, 0.0];
    let options = ["--to", "6,0", "--profile", "constant", "--speed", "5", "--samples", "5", "--accuracy", "1e-4"];
    let found = fly(&scenario, &options);
    close(number(&found["least_critical_speed"]["speed"]), 4.88, 5e-3, "critical");
    close(number(&found["least_wave_limit"]["speed"]), 9.16, 5e-3, "waves");
    close(number(&found["wave_ratio"]["value"]), 5.0 / number(&found["least_wave_limit"]["speed"]), 1e-9, "ratio");
    close(number(&found["frozen_growth"]), 0.66, 5e-3, "growth");
    assert_eq!(found["samples"].as_array().map(Vec::len), Some(5));
    let of_file = Path { profile: ProfileKind::Constant, ..Path::new(vec![[6.0, 0.0]], 5.0) };
    let with_path = Scenario { path: Some(of_file), ..scenario.clone() };
    assert_eq!(fly(&with_path, &["--samples", "5", "--accuracy", "1e-4"]), found);
    // Negative numbers are no options.
    let back = fly(&with_path, &["--to", "-7,-0.5", "--kick", "-1,-2", "--samples", "2", "--accuracy", "1e-4"]);
    close(number(&back["samples"][1]["s"]), 1.25_f64.sqrt(), 1e-9, "s");
}

#[test]
fn the_table_has_its_columns() {
    let (_, scenario) = reference("12_case22_quintic_5");
    let table = succeed(&["fly", "-", "--csv", "--samples", "3"], &scenario.to_json());
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let cables = scenario.cables.len();
    assert_eq!(rows[0][..8], ["t", "s", "x", "y", "v", "a", "dx", "dy"]);
    assert_eq!(rows[0][8..13], ["length_1", "rate_1", "acceleration_1", "tension_1", "winch_tension_1"]);
    assert_eq!((rows.len(), rows[0].len()), (4, 8 + 5 * cables));
    assert!(
        rows[1..].iter().all(|row| row.len() == 8 + 5 * cables && row.iter().all(|cell| cell.parse::<f64>().is_ok()))
    );
    let text = succeed(&["fly", "-"], &scenario.to_json());
    for part in
        ["Largest deviation of the platform:", "After the stop: 27.39 mm at most", "Wave ratio:", "Least wave limit"]
    {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn a_table_of_times_is_flown() {
    let (_, scenario) = reference("12_case22_quintic_5");
    let file = common::shell::File::new("flight.csv", b"t,x,y\n0,-3.549,1.141\n0.8,-2,1.3\n1.6,-0.549,1.141\n");
    let found = fly(&scenario, &["--trajectory", file.path(), "--samples", "3"]);
    close(number(&found["duration"]), 1.6, 1e-12, "duration");
    assert!(number(&found["max_deviation"]) > 0.0);
}

/// Where there is no equilibrium on the way, that is the answer.
#[test]
fn an_infeasible_path_is_an_answer() {
    let scenario = presets::find("paper").expect("a robot").scenario();
    let found = fly(&scenario, &["--to", "9.5,0"]);
    assert_eq!((&found["feasible"], found["samples"].as_array().map(Vec::len)), (&json!(false), Some(0)));
    let reason = found["reason"].as_str().expect("a reason");
    assert!(reason.contains("of the path") && reason.contains("would have to push"), "{reason}");
}

#[test]
fn faults_are_told_in_a_line_each() {
    let plain = presets::find("paper").expect("a robot").scenario().to_json();
    for (options, part) in [
        (&[][..], "standard input: the scenario has no path; give one with --to X,Y or --trajectory FILE.csv"),
        (&["--to", "6"], "--to <X,Y>"),
        (&["--to", "6,0", "--speed", "0"], "--speed <V>"),
        (&["--to", "6,0", "--accuracy", "-1"], "--accuracy <M>"),
        (&["--to", "6,0", "--samples", "1"], "--samples <N>"),
        (&["--to", "6,0", "--profile", "cubic"], "--profile <PROFILE>"),
        (&["--to", "0,0"], "path.points[0]: [0.0, 0.0] is not allowed; allowed: another point than motion.position"),
        (&["--to", "6,0", "--profile", "constant", "--hold", "1"], "path.hold"),
        (&["--to", "6,0", "--trajectory", "x.csv"], "cannot be used with"),
        (&["--trajectory", "nowhere.csv"], "nowhere.csv: "),
    ] {
        let told = refuse(&[&["fly", "-"], options].concat(), &plain).join("\n");
        assert!(told.contains(part), "{options:?}: {told}");
    }
}
