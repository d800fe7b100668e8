//! The messages of the text version: answers are those of the library, and faults are told with their fields.

use serde_json::{Value, json};
use tautline::scenario::messages::answer;
use tautline::scenario::presets::{self, PRESETS};
use tautline::scenario::{Report, Scenario, link};

/// The answer to a request with a number of its own.
fn ask(mut request: Value) -> Value {
    request["id"] = json!(17);
    let mut answer: Value = serde_json::from_str(&answer(&request.to_string())).expect("JSON");
    assert_eq!(answer["id"].take(), json!(17.0));
    answer
}

fn file(scenario: &Scenario) -> Value {
    serde_json::from_str(&scenario.to_json()).expect("JSON")
}

fn paths(answer: &Value) -> Vec<&str> {
    let faults = answer["faults"].as_array().unwrap_or_else(|| panic!("no faults in {answer}"));
    faults.iter().map(|fault| fault["path"].as_str().expect("a path")).collect()
}

/// The parts of a JSON text; its numbers to the last bit, which `serde_json` does not read them to.
fn parts(json: &str) -> Vec<(&str, Option<u64>)> {
    let marks = [',', ':', '[', ']', '{', '}'];
    let part = |part| match str::parse::<f64>(part) {
        Ok(number) => ("", Some(number.to_bits())),
        Err(_) => (part, None),
    };
    json.split_inclusive(marks)
        .flat_map(|piece| piece.split(marks).map(part).chain([(&piece[piece.len() - 1..], None)]))
        .collect()
}

#[test]
fn an_analysis_is_the_library_s_to_the_last_bit() {
    for preset in PRESETS {
        let scenario = preset.scenario();
        let (robot, motion) = scenario.to_robot().expect("physical");
        let got = answer(&format!(r#"{{"id": 3, "analyze": {}}}"#, scenario.to_json()));
        let report = serde_json::to_string(&Report::analyze(&robot, &motion, 40.0)).expect("JSON");
        assert_eq!(parts(&got), parts(&format!(r#"{{"id":3,"ok":{report}}}"#)), "{}", preset.name);
    }
}

#[test]
fn the_paper_s_robot_has_its_critical_speed_and_the_search_ends_where_it_is_told() {
    let scenario = file(&PRESETS[0].scenario());
    let found = &ask(json!({ "analyze": scenario }))["ok"];
    // Independent figures: docs/theory.md, reference numbers.
    assert!((found["critical"]["speed"].as_f64().expect("a speed") - 11.299).abs() < 1e-3, "{}", found["critical"]);
    assert_eq!((found["critical"]["kind"].as_str(), found["stable"].as_bool()), (Some("flutter"), Some(true)));
    let none = &ask(json!({ "analyze": scenario, "max_speed": 8 }))["ok"];
    assert_eq!(
        (&none["critical"], &none["status"], &none["searched_up_to"]),
        (&Value::Null, &json!("none"), &json!(8.0))
    );
}

#[test]
fn a_pose_without_equilibrium_is_an_answer_with_its_reason() {
    let mut scenario = file(&PRESETS[0].scenario());
    scenario["motion"]["position"] = json!([9.9, 0]);
    let report = &ask(json!({ "analyze": scenario }))["ok"];
    assert_eq!(report["feasible"], json!(false));
    let reason = report["reason"].as_str().expect("a reason");
    assert!(reason.starts_with("No static equilibrium here: cable 1 would have to push"), "{reason}");
}

#[test]
fn a_robot_goes_to_a_link_and_back_without_loss() {
    for preset in PRESETS {
        let scenario = preset.scenario();
        let text = ask(json!({ "encode": file(&scenario) }))["ok"].take();
        assert_eq!(text.as_str(), Some(link::encode(&scenario).as_str()));
        let back = ask(json!({ "decode": text }))["ok"].take();
        assert_eq!(Scenario::from_json(&back.to_string()).as_ref(), Ok(&scenario));
    }
}

#[test]
fn numbers_of_every_size_are_written_as_they_are() {
    let mut scenario = PRESETS[0].scenario();
    for number in [5e-324, 1.25e-7, 0.1, 1.0 / 3.0, 1e15, 1.7e308] {
        scenario.motion.position = [number, -number];
        let back = ask(json!({ "decode": link::encode(&scenario) }))["ok"].take();
        let got: Vec<f64> = serde_json::from_value(back["motion"]["position"].clone()).expect("numbers");
        assert_eq!(got, [number, -number]);
    }
}

#[test]
fn all_faults_are_told_with_field_value_and_what_is_allowed() {
    let mut scenario = file(&PRESETS[0].scenario());
    scenario["platform"]["mass"] = json!(-2);
    scenario["cables"][2]["tension"] = json!({ "constant": 0 });
    let told = ask(json!({ "analyze": scenario, "max_speed": 0 }));
    assert_eq!(paths(&told), ["platform.mass", "cables[2].tension.constant", "max_speed"]);
    assert_eq!(
        told["faults"][0],
        json!({ "path": "platform.mass", "value": "-2", "allowed": "a finite number greater than 0",
                "message": "platform.mass: -2 is not allowed; allowed: a finite number greater than 0" })
    );
    // What a field holds that is no number at all.
    scenario["motion"]["speed"] = json!("fast");
    assert_eq!(paths(&ask(json!({ "encode": scenario }))), ["motion.speed"]);
    scenario = file(&PRESETS[0].scenario());
    scenario["cables"][1]["tension"] = json!({ "constant": 5 });
    assert_eq!(paths(&ask(json!({ "encode": scenario }))), ["cables"]);
}

#[test]
fn damaged_links_and_bad_requests_are_told_as_such() {
    let damaged = ask(json!({ "decode": "1abc" }));
    assert!(damaged["error"].as_str().is_some_and(|told| told.contains("damaged")), "{damaged}");
    assert!(ask(json!({ "decode": "9abc" }))["error"].as_str().is_some_and(|told| told.contains("newer")));
    assert_eq!(paths(&ask(json!({ "decode": 5 }))), ["decode"]);
    assert_eq!(paths(&ask(json!({ "analyse": {} }))), ["analyse"]);
    assert!(ask(json!({}))["error"].is_string());
    assert!(ask(json!({ "example": "\"paper" }))["error"].is_string());
    for request in ["", "[]", "ready", "{\"id\": \"x\"}", "{\"id\": 1e999}"] {
        let told: Value = serde_json::from_str(&answer(request)).expect("JSON");
        assert_eq!(told["id"], json!(0.0), "{request}");
        assert!(told["faults"].is_array(), "{request}: {told}");
    }
}

#[test]
fn whatever_is_sent_is_answered_in_json() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/fuzz/corpus/scenario");
    let mut sent = 0;
    for file in std::fs::read_dir(folder).expect("the corpus") {
        let text = String::from_utf8_lossy(&std::fs::read(file.expect("a file").path()).expect("a file")).into_owned();
        for request in
            [format!(r#"{{"id": 1, "encode": {text}}}"#), json!({ "id": 1, "decode": text }).to_string(), text]
        {
            let answered: Value = serde_json::from_str(&answer(&request)).expect("JSON");
            assert_eq!(answered.as_object().map(serde_json::Map::len), Some(2), "{request}: {answered}");
            sent += 1;
        }
    }
    assert!(sent > 100, "{sent} requests");
}

#[test]
fn the_built_in_robots_are_listed_and_given() {
    let list = ask(json!({ "examples": true }))["ok"].take();
    let names: Vec<&str> = list.as_array().expect("a list").iter().filter_map(|one| one["name"].as_str()).collect();
    assert_eq!(names, PRESETS.iter().map(|preset| preset.name).collect::<Vec<_>>());
    assert!(list[0]["title"].is_string() && list[0]["description"].is_string());
    for name in names {
        let given = ask(json!({ "example": name }))["ok"].take();
        let expected = presets::find(name).expect("built in").scenario();
        assert_eq!(Scenario::from_json(&given.to_string()), Ok(expected));
    }
}
