//! The scenario file: what is read, what is refused and how, and that nothing is lost in writing.
#![cfg(feature = "scenario")]
#![allow(clippy::float_cmp, reason = "numbers have to survive to the last bit")]

use std::fs;

use proptest::prelude::*;
use tautline::robot::{self, Fault, Linearisation, Motion, OwnMaterial, Strain, TensionLaw};
use tautline::scenario::json::{Material, SCHEMA, SCHEMA_2};
use tautline::scenario::{Corners, Parameter, Path, ProfileKind, Scenario, presets};

/// A scenario with every kind of field, as the format's description has it.
const SAMPLE: &str = r#"{ "schema": "tautline/scenario/1",
  "name": "Paper robot",
  "gravity": 9.81,
  "cable": { "youngs_modulus": 125e6, "area": 5e-5, "mass_per_length": 0.4, "strain": "green" },
  "platform": { "mass": 2.0 },
  "cables": [
    { "anchor": [-10, 5],  "tension": "equilibrium" },
    { "anchor": [10, 5],   "tension": "equilibrium" },
    { "anchor": [-10, -5], "tension": { "horizontal": [50, 5, 0],  "vertical": [45, 0, 0] } },
    { "anchor": [10, -5],  "tension": { "constant": 67.3 } } ],
  "elements_per_cable": 10,
  "damping": { "alpha": 0.5, "beta": 0.005 },
  "linearisation": "secant",
  "motion": { "position": [0, 0], "direction": [1, 0], "speed": 5.0 } }"#;

/// [`SAMPLE`] with `old` replaced by `new`.
fn with(old: &str, new: &str) -> String {
    assert_eq!(SAMPLE.matches(old).count(), 1, "{old} is not in the sample just once");
    SAMPLE.replace(old, new)
}

fn accepted(text: &str) -> Scenario {
    Scenario::from_json(text).unwrap_or_else(|faults| panic!("{faults}\nin {text}"))
}

fn faults(text: &str) -> Vec<Fault> {
    let faults = Scenario::from_json(text)
        .map_or_else(tautline::robot::Faults::into_list, |scenario| panic!("accepted {scenario:?}"));
    assert!(!faults.is_empty());
    for fault in &faults {
        assert_eq!(fault.to_string().lines().count(), 1, "{fault}");
        for part in [&fault.path, &fault.value, &fault.allowed.to_string()] {
            assert!(!part.is_empty() && fault.to_string().contains(part), "{fault}");
        }
    }
    faults
}

/// Reads `text`, where just one fault must be found: at `path`, with `value`, and `allowed` among what is allowed.
fn assert_fault(text: &str, path: &str, value: &str, allowed: &str) {
    match &faults(text)[..] {
        [fault] => {
            assert_eq!((fault.path.as_str(), fault.value.as_str()), (path, value), "{fault}");
            assert!(fault.allowed.to_string().contains(allowed), "{fault}");
        }
        several => panic!("{several:#?}"),
    }
}

#[test]
fn the_sample_is_read() {
    let scenario = accepted(SAMPLE);
    let expected = presets::find("paper").unwrap().scenario();
    let mut cables = expected.cables.clone();
    cables[3].tension = TensionLaw::Constant(67.3);
    assert_eq!(scenario, Scenario { cables, ..expected });
}

#[test]
fn missing_optional_fields_have_defaults() {
    let mut text = SAMPLE.to_owned();
    for field in [
        r#""schema": "tautline/scenario/1","#,
        r#""name": "Paper robot","#,
        r#""gravity": 9.81,"#,
        r#", "strain": "green""#,
        r#""linearisation": "secant","#,
    ] {
        text = text.replace(field, "");
    }
    let scenario = accepted(&text);
    assert_eq!(scenario, Scenario { name: None, ..accepted(SAMPLE) });
    assert!(!scenario.to_json().contains("\"name\""), "{}", scenario.to_json());
}

#[test]
fn every_form_is_read() {
    assert_eq!(accepted(&with("\"green\"", "\"engineering\"")).cable.strain, Strain::Engineering);
    assert_eq!(accepted(&with("\"secant\"", "\"tangent\"")).linearisation, Linearisation::Tangent);
    for ten in ["10.0", "1e1", "10"] {
        let text = with(r#""elements_per_cable": 10"#, &format!(r#""elements_per_cable": {ten}"#));
        assert_eq!(accepted(&text).elements_per_cable, 10);
    }
    assert_eq!(accepted(&format!("\u{feff}{SAMPLE}\n")), accepted(SAMPLE));
    let direction = accepted(&with("[1, 0]", "[3e200, -4e200]"));
    assert_eq!(direction.motion.direction, [3e200, -4e200]);
    assert_eq!(direction.to_robot().unwrap().1.direction(), robot::Vec2::new(0.6, -0.8));
}

#[test]
fn structural_faults_name_path_value_and_what_is_allowed() {
    for (old, new, path, value, allowed) in [
        ("tautline/scenario/1", "tautline/scenario/3", "schema", r#""tautline/scenario/3""#, SCHEMA),
        ("tautline/scenario/1", "tautline/scenario/3", "schema", r#""tautline/scenario/3""#, SCHEMA_2),
        (r#""name": "Paper robot""#, r#""name": 7"#, "name", "7", "a text"),
        (r#""name": "Paper robot""#, r#""name": null"#, "name", "null", "a text"),
        ("9.81", r#""9.81""#, "gravity", r#""9.81""#, "a finite number"),
        ("9.81", "null", "gravity", "null", "a finite number"),
        ("9.81", "1e999", "gravity", "1e999", "a finite number"),
        ("9.81", "-1e999", "gravity", "-1e999", "a finite number"),
        ("9.81", "NaN", "gravity", "\"NaN\"", "a finite number"),
        ("9.81", "-Infinity", "gravity", "\"-Infinity\"", "a finite number"),
        ("125e6", "true", "cable.youngs_modulus", "true", "a finite number"),
        (r#""area": 5e-5, "#, "", "cable.area", "missing", "a finite number"),
        ("\"green\"", "\"Green\"", "cable.strain", "\"Green\"", r#""green" or "engineering""#),
        ("\"green\"", "1", "cable.strain", "1", r#""green" or "engineering""#),
        ("\"secant\"", "\"linear\"", "linearisation", "\"linear\"", r#""secant" or "tangent""#),
        (r#"{ "mass": 2.0 }"#, "2.0", "platform", "2.0", "an object with the fields mass"),
        (r#"{ "mass": 2.0 }"#, "{}", "platform.mass", "missing", "a finite number"),
        (r#""mass": 2.0"#, r#""mass": 2.0, "colour": "red""#, "platform.colour", r#"an unknown field ("red")"#, "mass"),
        (r#""mass": 2.0"#, r#""mass": 2.0, "a b\n": []"#, r#"platform["a b\n"]"#, "an unknown field ([])", "mass"),
        (r#""mass": 2.0"#, r#""mass": 2.0, "mass": 3"#, "platform.mass", "a second field of the same name (3)", "once"),
        (r#""platform": { "mass": 2.0 },"#, "", "platform", "missing", "mass"),
        ("[-10, 5]", "[-10]", "cables[0].anchor", "[-10]", "a list of 2 numbers"),
        ("[-10, 5]", "[-10, 5, 0]", "cables[0].anchor", "[-10, 5, 0]", "a list of 2 numbers"),
        ("[-10, 5]", "[-10,\n \"5\"]", "cables[0].anchor[1]", "\"5\"", "a finite number"),
        ("[-10, 5]", "{\"x\": 1}", "cables[0].anchor", "{\"x\": 1}", "a list of 2 numbers"),
        ("[50, 5, 0]", "[50, 5]", "cables[2].tension.horizontal", "[50, 5]", "a list of 3 numbers"),
        (r#",  "vertical": [45, 0, 0]"#, "", "cables[2].tension.vertical", "missing", "a list of 3 numbers"),
        (r#""horizontal": [50, 5, 0],"#, "", "cables[2].tension.horizontal", "missing", "a list of 3 numbers"),
        ("67.3 }", "67.3, \"unit\": 1 }", "cables[3].tension.unit", "an unknown field (1)", "constant"),
        ("67.3", "[67.3]", "cables[3].tension.constant", "[67.3]", "a finite number"),
        (r#"{ "constant": 67.3 }"#, "{}", "cables[3].tension", "{}", r#""equilibrium", {"constant": T} or"#),
        (r#"{ "constant": 67.3 }"#, "67.3", "cables[3].tension", "67.3", r#""equilibrium", {"constant": T} or"#),
        (
            r#"{ "constant": 67.3 }"#,
            "\"taut\"",
            "cables[3].tension",
            "\"taut\"",
            r#""equilibrium", {"constant": T} or"#,
        ),
        (
            r#""constant": 67.3"#,
            r#""constant": 67.3, "vertical": [1, 2, 3]"#,
            "cables[3].tension",
            r#"{ "constant": 67.3, "vertical": [1, 2, 3] }"#,
            "\"equilibrium\"",
        ),
        (r#",  "tension": { "constant": 67.3 }"#, "", "cables[3].tension", "missing", "\"equilibrium\""),
        (r#""beta": 0.005"#, r#""beta": {}"#, "damping.beta", "{}", "a finite number"),
        (r#", "speed": 5.0"#, "", "motion.speed", "missing", "a finite number"),
        (r#""direction": [1, 0]"#, r#""direction": "+x""#, "motion.direction", "\"+x\"", "a list of 2 numbers"),
    ] {
        let text = with(old, new);
        assert_fault(&text, path, value, allowed);
    }
    for elements in ["10.5", "-3", "\"10\"", "1e300", "[10]"] {
        let text = with(r#""elements_per_cable": 10"#, &format!(r#""elements_per_cable": {elements}"#));
        assert_fault(&text, "elements_per_cable", elements, "a whole number from 2 to 200");
    }
    let cables = SAMPLE.find("[\n").unwrap()..SAMPLE.find("],\n  \"elements").unwrap() + 1;
    let without_cables = |new: &str| format!("{}{new}{}", &SAMPLE[..cables.start], &SAMPLE[cables.end..]);
    assert_fault(&without_cables("4"), "cables", "4", "a list of 3 to 8 cables");
    assert_eq!(faults(&without_cables("[1, 2]")).len(), 2);
}

#[test]
fn physical_faults_name_path_value_and_what_is_allowed() {
    let law = r#"{ "horizontal": [50, 5, 0],  "vertical": [45, 0, 0] }"#;
    for (old, new, path, value, allowed) in [
        ("9.81", "-9.810", "gravity", "-9.810", "a finite number, 0 or more"),
        ("125e6", "0", "cable.youngs_modulus", "0", "a finite number greater than 0"),
        ("5e-5", "-1e-5", "cable.area", "-1e-5", "a finite number greater than 0"),
        ("5e-5", "1e-999", "cable.area", "1e-999", "a finite number greater than 0"),
        ("5e-5", "1e305", "cable.youngs_modulus", "125e6", "within the range"),
        (
            "9.81",
            "1e309e",
            "scenario",
            "text that is not JSON (expected `,` or `}` at line 3 column 19)",
            "one JSON object",
        ),
        ("0.4", "0.0", "cable.mass_per_length", "0.0", "a finite number greater than 0"),
        ("2.0", "-2", "platform.mass", "-2", "a finite number greater than 0"),
        ("0.5", "-0.5", "damping.alpha", "-0.5", "a finite number, 0 or more"),
        ("0.005", "-5E-3", "damping.beta", "-5E-3", "a finite number, 0 or more"),
        ("5.0", "-5", "motion.speed", "-5", "a finite number, 0 or more"),
        ("[1, 0]", "[0, 0.0]", "motion.direction", "[0, 0.0]", "not zero"),
        ("67.3", "-67.3", "cables[3].tension.constant", "-67.3", "a finite number greater than 0"),
        ("[10, 5]", "[ -10, 5.0 ]", "cables[1].anchor", "[ -10, 5.0 ]", "differs from cables[0].anchor"),
        (law, "\"equilibrium\"", "cables", "3 cables with tension \"equilibrium\"", "exactly two"),
        (r#""elements_per_cable": 10"#, r#""elements_per_cable": 1"#, "elements_per_cable", "1", "from 2 to 200"),
        (r#""elements_per_cable": 10"#, r#""elements_per_cable": 201"#, "elements_per_cable", "201", "from 2 to 200"),
    ] {
        assert_fault(&with(old, new), path, value, allowed);
    }
    let first_two = SAMPLE.find("[\n").unwrap() + 1..SAMPLE.find("{ \"anchor\": [-10, -5]").unwrap();
    let two = format!("{}{}", &SAMPLE[..first_two.start], &SAMPLE[first_two.end..]);
    let found = faults(&two);
    assert_eq!((found[0].path.as_str(), found[0].value.as_str()), ("cables", "a list of 2"));
    let many = with("[\n", &format!("[\n{}", r#"{ "anchor": [1, 2], "tension": { "constant": 5 } },"#.repeat(20_000)));
    assert!(
        faults(&many).iter().any(|fault| fault.value == "a list of 20004" && fault.allowed == "3 to 8 cables".into())
    );
}

#[test]
fn all_structural_faults_are_told_then_all_physical_ones() {
    let structural = with("9.81", "-1").replace("0.4", "\"0.4\"").replace("\"secant\"", "3").replace("[1, 0]", "[0]");
    let paths: Vec<String> = faults(&structural).into_iter().map(|fault| fault.path).collect();
    assert_eq!(paths, ["cable.mass_per_length", "linearisation", "motion.direction"]);
    let physical = with("9.81", "-1").replace("0.4", "-0.4").replace("5.0", "-5").replace("67.3", "0");
    let paths: Vec<String> = faults(&physical).into_iter().map(|fault| fault.path).collect();
    assert_eq!(paths, ["gravity", "cable.mass_per_length", "cables[3].tension.constant", "motion.speed"]);
}

#[test]
fn texts_that_are_not_scenarios_are_refused() {
    assert_fault("[]", "scenario", "[]", "an object with the fields schema, name");
    assert_fault("", "scenario", "text that is not JSON (EOF while parsing a value at line 1 column 0)", "object");
    assert_fault("{} {}", "scenario", "text that is not JSON (trailing characters at line 1 column 4)", "object");
    let comma = with("\"mass\": 2.0 },", "\"mass\": 2.0 }");
    assert_fault(&comma, "scenario", "text that is not JSON (expected `,` or `}` at line 6 column 3)", "object");
    // Words for numbers that are not finite are no JSON, even where any text may stand.
    let nan = with("\"Paper robot\"", "NaN");
    assert_fault(&nan, "scenario", "text that is not JSON (expected value at line 2 column 11)", "object");
    assert_eq!(accepted(&with("Paper robot", r#"NaN \\\" Infinity"#)).name.unwrap(), r#"NaN \" Infinity"#);
    // Six fields are required.
    let missing: Vec<String> = faults("{}").into_iter().map(|fault| fault.path).collect();
    assert_eq!(missing.len(), 6, "{missing:?}");
    assert!(!faults(&"[".repeat(100_000)).is_empty());
    assert!(!faults(&format!("{}{}", "[".repeat(100_000), "]".repeat(100_000))).is_empty());
    let long = with("9.81", &format!("\"{}\"", "é".repeat(1000)));
    assert!(faults(&long)[0].value.chars().count() < 100);
}

#[test]
fn the_file_is_laid_out_for_people() {
    let expected = r#"{
  "schema": "tautline/scenario/1",
  "name": "Paper robot",
  "gravity": 9.81,
  "cable": { "youngs_modulus": 125000000.0, "area": 0.00005, "mass_per_length": 0.4, "strain": "green" },
  "platform": { "mass": 2.0 },
  "cables": [
    { "anchor": [-10.0, 5.0], "tension": "equilibrium" },
    { "anchor": [10.0, 5.0], "tension": "equilibrium" },
    { "anchor": [-10.0, -5.0], "tension": { "horizontal": [50.0, 5.0, 0.0], "vertical": [45.0, 0.0, 0.0] } },
    { "anchor": [10.0, -5.0], "tension": { "constant": 67.3 } }
  ],
  "elements_per_cable": 10,
  "damping": { "alpha": 0.5, "beta": 0.005 },
  "linearisation": "secant",
  "motion": { "position": [0.0, 0.0], "direction": [1.0, 0.0], "speed": 5.0 }
}"#;
    assert_eq!(accepted(SAMPLE).to_json(), expected);
}

/// The sample, whose third cable has `cable`, in a file of this schema (with the comma behind it) or of none.
fn with_own(schema: &str, cable: &str) -> String {
    let third = r#""vertical": [45, 0, 0] } }"#;
    with(r#""schema": "tautline/scenario/1","#, schema)
        .replace(third, &format!(r#""vertical": [45, 0, 0] }}, "cable": {cable} }}"#))
}

const SECOND: &str = r#""schema": "tautline/scenario/2","#;

#[test]
fn a_cable_may_have_a_material_of_its_own() {
    let own = r#"{ "strain": "engineering", "area": 1e-5, "mass_per_length": 0.08, "youngs_modulus": 2e11 }"#;
    for schema in [SECOND, ""] {
        let scenario = accepted(&with_own(schema, own));
        let expected = OwnMaterial {
            youngs_modulus: Some(2e11),
            area: Some(1e-5),
            mass_per_length: Some(0.08),
            strain: Some(Strain::Engineering),
        };
        assert_eq!(scenario.cables[2].cable, expected);
        assert_eq!(scenario.schema(), SCHEMA_2);
        let (robot, _) = scenario.to_robot().unwrap();
        assert_eq!([0, 1, 3].map(|i| robot.material_of(i)), [robot.material; 3]);
        assert!((robot.axial_stiffness(2) - 2e6).abs() < 1e-9 && (robot.weight_per_length(2) - 0.7848).abs() < 1e-12);
        assert_eq!(scenario.material_of(2), Material::from(robot.material_of(2)));
        assert_eq!(accepted(&scenario.to_json()), scenario);
        let text = scenario.to_json();
        assert!(text.starts_with("{\n  \"schema\": \"tautline/scenario/2\",\n"), "{text}");
        let line = r#""vertical": [45.0, 0.0, 0.0] }, "cable": { "youngs_modulus": 200000000000.0, "area": 0.00001, "mass_per_length": 0.08, "strain": "engineering" } },"#;
        assert!(text.contains(line), "{text}");
    }
    // What is not given is that of all cables.
    let scenario = accepted(&with_own(SECOND, r#"{ "area": 1e-4 }"#));
    assert_eq!(scenario.material_of(2), Material { area: 1e-4, ..scenario.cable });
}

/// The version is a consequence: without an own material a file is of the first.
#[test]
fn an_empty_own_material_is_none() {
    for text in
        [with_own(SECOND, "{}"), with_own("", "{}"), with(r#""tautline/scenario/1""#, r#""tautline/scenario/2""#)]
    {
        assert_eq!(accepted(&text), accepted(SAMPLE));
        assert_eq!(accepted(&text).to_json(), accepted(SAMPLE).to_json());
    }
}

#[test]
fn a_file_of_the_first_schema_has_no_own_material() {
    let first = r#""schema": "tautline/scenario/1","#;
    for cable in ["{}", r#"{ "area": 1e-5 }"#, "3"] {
        let text = with_own(first, cable);
        let told = faults(&text);
        assert_eq!(told.len(), 1, "{told:?}");
        assert_eq!(
            told[0].to_string(),
            format!(
                "cables[2].cable: a field of tautline/scenario/2 ({cable}) is not allowed; allowed: the fields anchor, \
                 tension in \"tautline/scenario/1\"; say \"tautline/scenario/2\", or leave it out"
            )
        );
    }
}

#[test]
fn faults_of_an_own_material_name_its_path() {
    let positive = "a finite number greater than 0";
    for (cable, path, value, allowed) in [
        ("null", "cables[2].cable", "null", "an object with the fields youngs_modulus, area, mass_per_length, strain"),
        ("[]", "cables[2].cable", "[]", "an object with the fields youngs_modulus, area, mass_per_length, strain"),
        (r#"{ "area": null }"#, "cables[2].cable.area", "null", "a finite number"),
        (r#"{ "area": "1e-5" }"#, "cables[2].cable.area", r#""1e-5""#, "a finite number"),
        (r#"{ "strain": "Green" }"#, "cables[2].cable.strain", r#""Green""#, r#""green" or "engineering""#),
        (r#"{ "diameter": 1 }"#, "cables[2].cable.diameter", "an unknown field (1)", "the fields youngs_modulus"),
        (r#"{ "youngs_modulus": 0 }"#, "cables[2].cable.youngs_modulus", "0", positive),
        (r#"{ "area": -1e-5 }"#, "cables[2].cable.area", "-1e-5", positive),
        (r#"{ "mass_per_length": 0.00 }"#, "cables[2].cable.mass_per_length", "0.00", positive),
        // EA, of an own value and a common one, and of two own ones; μ g.
        (r#"{ "youngs_modulus": 1e-305 }"#, "cables[2].cable.youngs_modulus", "1e-305", "product with cable.area is"),
        (r#"{ "area": 1e305 }"#, "cables[2].cable.area", "1e305", "product with cable.youngs_modulus is"),
        (
            r#"{ "youngs_modulus": 1e200, "area": 1e200 }"#,
            "cables[2].cable.youngs_modulus",
            "1e200",
            "product with cables[2].cable.area is within the range",
        ),
        (r#"{ "mass_per_length": 1e308 }"#, "cables[2].cable.mass_per_length", "1e308", "product with gravity is"),
    ] {
        assert_fault(&with_own(SECOND, cable), path, value, allowed);
        assert_eq!(faults(&with_own(SECOND, cable)).len(), 1, "{cable}");
    }
}

/// An own value is a number like others once a cable has it, and given or taken away by itself.
#[test]
fn own_values_are_parameters_where_they_are() {
    let scenario = accepted(SAMPLE);
    let own = Parameter::Area.own(2).unwrap();
    assert_eq!(
        (own, own.common(), own.path().as_str()),
        (Parameter::OwnArea(2), Some(Parameter::Area), "cables[2].cable.area")
    );
    assert_eq!((Parameter::Speed.own(2), Parameter::Area.common()), (None, None));
    assert!(!own.is_in(&scenario) && !Parameter::all(&scenario).contains(&own));
    let mut changed = scenario.clone();
    own.set(&mut changed, 1e-5);
    assert_eq!(changed, scenario, "there is none to be set");
    own.give(&mut changed, 1e-5);
    assert!(own.is_in(&changed) && Parameter::all(&changed).contains(&own));
    assert_eq!((own.get(&changed).to_bits(), changed.cables[2].cable.area), (1e-5_f64.to_bits(), Some(1e-5)));
    own.set(&mut changed, 2e-5);
    assert_eq!(changed.cables[2].cable.area, Some(2e-5));
    let mut other = scenario.clone();
    own.copy(&changed, &mut other);
    assert_eq!(other, changed);
    own.copy(&scenario, &mut other);
    assert_eq!(other, scenario, "what is not there is not there in the copy");
    own.take_away(&mut changed);
    assert_eq!(changed, scenario);
    Parameter::OwnArea(9).give(&mut changed, 1.0);
    Parameter::Area.take_away(&mut changed);
    assert_eq!(changed, scenario);
    Parameter::Area.give(&mut changed, 3e-5);
    assert_eq!(changed.cable.area.to_bits(), 3e-5_f64.to_bits());
    // In the order of the file, before the next cable.
    for parameter in [Parameter::OwnYoungsModulus(0), own, Parameter::OwnMassPerLength(3)] {
        parameter.give(&mut changed, 0.5);
    }
    let paths: Vec<String> = Parameter::all(&changed).into_iter().map(Parameter::path).collect();
    let at = |path: &str| paths.iter().position(|other| other == path).unwrap();
    assert!(at("cables[0].anchor[1]") < at("cables[0].cable.youngs_modulus"));
    assert!(at("cables[0].cable.youngs_modulus") < at("cables[1].anchor[0]"));
    assert!(at("cables[2].tension.vertical[2]") < at("cables[2].cable.area"));
    assert!(at("cables[3].cable.mass_per_length") < at("elements_per_cable"));
}

/// The sample with `path`, in a file of this schema (with the comma behind it) or of none.
fn with_path(schema: &str, path: &str) -> String {
    with(r#""schema": "tautline/scenario/1","#, schema)
        .replace(r#""speed": 5.0 } }"#, &format!(r#""speed": 5.0 }}, "path": {path} }}"#))
}

/// A path with every field, none of which has its default.
const PATH: &str = r#"{ "points": [[6, 0.5], [1, 2]], "corners": "smooth", "profile": "scurve", "speed": 2.5, "acceleration": 3, "jerk": 8, "hold": 1.5 }"#;

#[test]
fn a_path_is_read_and_laid_out_for_people() {
    let expected = Path {
        points: vec![[6.0, 0.5], [1.0, 2.0]],
        corners: Corners::Smooth,
        profile: ProfileKind::Scurve,
        speed: 2.5,
        acceleration: 3.0,
        jerk: 8.0,
        hold: 1.5,
    };
    for schema in [SECOND, ""] {
        let scenario = accepted(&with_path(schema, PATH));
        assert_eq!(scenario.path, Some(expected.clone()));
        assert_eq!(scenario, Scenario { path: scenario.path.clone(), ..accepted(SAMPLE) });
        let text = scenario.to_json();
        assert!(text.starts_with("{\n  \"schema\": \"tautline/scenario/2\",\n"), "{text}");
        let line = r#"  "path": { "points": [[6.0, 0.5], [1.0, 2.0]], "corners": "smooth", "profile": "scurve", "speed": 2.5, "acceleration": 3.0, "jerk": 8.0, "hold": 1.5 }"#;
        assert!(text.ends_with(&format!("\n{line}\n}}")), "{text}");
        assert_eq!(accepted(&text), scenario);
        // Back to no path, and to the first version.
        assert_eq!(Scenario { path: None, ..scenario }.to_json(), accepted(SAMPLE).to_json());
    }
    // The rest has its default; the speed is that of the motion.
    for (word, profile) in [
        ("quintic", ProfileKind::Quintic),
        ("trapezoid", ProfileKind::Trapezoid),
        ("scurve", ProfileKind::Scurve),
        ("constant", ProfileKind::Constant),
    ] {
        let path = format!(r#"{{ "points": [[6, 0]], "profile": "{word}" }}"#);
        let path = accepted(&with_path(SECOND, &path)).path;
        assert_eq!(path, Some(Path { profile, ..Path::new(vec![[6.0, 0.0]], 5.0) }));
    }
}

#[test]
fn faults_of_a_path_name_its_path() {
    let fields = "an object with the fields points, corners, profile, speed, acceleration, jerk, hold";
    for (path, place, value, allowed) in [
        ("null", "path", "null", fields),
        ("[[6, 0]]", "path", "[[6, 0]]", fields),
        ("{}", "path.points", "missing", "a list of 1 to 100 points [x, y]"),
        (r#"{ "points": [[6, 0], 1] }"#, "path.points[1]", "1", "a list of 2 numbers"),
        (r#"{ "points": [[6, 0], [1, "0"]] }"#, "path.points[1][1]", r#""0""#, "a finite number"),
        (r#"{ "points": [[6, 1e999]] }"#, "path.points[0][1]", "1e999", "a finite number"),
        (r#"{ "points": [[6, 0]], "corners": "round" }"#, "path.corners", r#""round""#, r#""stop" or "smooth""#),
        (r#"{ "points": [[6, 0]], "profile": "sine" }"#, "path.profile", r#""sine""#, r#""quintic", "trapezoid""#),
        (r#"{ "points": [[6, 0]], "velocity": 3 }"#, "path.velocity", "an unknown field (3)", "the fields points"),
        (r#"{ "points": [[6, 0]], "acceleration": 0.0 }"#, "path.acceleration", "0.0", "greater than 0"),
        (r#"{ "points": [[6, 0]], "jerk": -1 }"#, "path.jerk", "-1", "greater than 0"),
        (r#"{ "points": [[6, 0]], "hold": null }"#, "path.hold", "null", "a finite number"),
        (r#"{ "points": [[6, 0]], "hold": -0.5 }"#, "path.hold", "-0.5", "0 or more"),
        (r#"{ "points": [[6, 0]], "profile": "constant", "hold": 2 }"#, "path.hold", "2", "does not come to rest"),
    ] {
        assert_fault(&with_path(SECOND, path), place, value, allowed);
    }
    // A motion at rest gives a path no speed.
    let resting = with_path(SECOND, r#"{ "points": [[6, 0]] }"#).replace(r#""speed": 5.0"#, r#""speed": 0"#);
    assert_fault(&resting, "path.speed", "0.0", "greater than 0");
    // The robot's faults are told with the path's.
    let both = with_path(SECOND, r#"{ "points": [[6, 0]], "jerk": 0 }"#).replace("2.0", "-2.0");
    let told: Vec<String> = faults(&both).into_iter().map(|fault| fault.path).collect();
    assert_eq!(told, ["platform.mass", "path.jerk"]);
    let first = faults(&with_path(r#""schema": "tautline/scenario/1","#, PATH));
    assert!(
        first.len() == 1 && first[0].path == "path" && first[0].to_string().contains("say \"tautline/scenario/2\"")
    );
    // As many points as are allowed, and one more.
    let zigzag = |count: usize| (0..count).map(|i| format!("[{}, {}]", i + 1, i % 2)).collect::<Vec<_>>().join(", ");
    let of = |count: usize| format!(r#"{{ "points": [{}] }}"#, zigzag(count));
    assert_eq!(accepted(&with_path(SECOND, &of(100))).trajectory().map(|all| all.corners().len()), Some(99));
    assert_fault(&with_path(SECOND, &of(101)), "path.points", "a list of 101", "1 to 100 points");
}

#[test]
fn a_robot_makes_the_scenario_that_makes_the_robot() {
    let robot = robot::paper().unwrap();
    let motion = Motion::new([0.1, -0.3], [1.0, -7.0], 2.5).unwrap();
    let scenario = Scenario::new(&robot, &motion);
    assert_eq!((scenario.schema(), &scenario.name), (SCHEMA, &None));
    assert_eq!(scenario.to_robot().unwrap(), (robot, motion));
}

#[test]
fn every_preset_is_physical_and_described() {
    for preset in presets::PRESETS {
        let scenario = preset.scenario();
        assert_eq!(accepted(&scenario.to_json()), scenario);
        assert_eq!(scenario.name.as_deref(), Some(preset.title));
        assert!(std::ptr::eq(presets::find(preset.name).unwrap(), preset), "{} is there twice", preset.name);
        assert_eq!(preset.description.matches(['.', '!', '?']).count(), 2, "{}", preset.description);
    }
    assert_eq!(presets::PRESETS[0].scenario().to_robot().unwrap().0, robot::paper().unwrap());
    assert!(presets::find("paper robot").is_none());
}

/// Scenarios, feasible and not, from an independent code.
#[test]
fn the_reference_scenarios_are_read_unchanged() {
    let mut read = 0;
    for entry in fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "json") {
            continue;
        }
        let case: serde_json::Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        let Some(given) = case.get("scenario") else { continue };
        let scenario = accepted(&given.to_string());
        assert_eq!(accepted(&scenario.to_json()), scenario);
        let written: serde_json::Value = serde_json::from_str(&scenario.to_json()).unwrap();
        assert_contains(&written, given);
        read += 1;
    }
    assert!(read >= 24, "{read} scenarios");
}

/// All that `given` says is in `written`, numbers by value.
fn assert_contains(written: &serde_json::Value, given: &serde_json::Value) {
    use serde_json::Value::{Array, Number, Object};
    match (written, given) {
        (Object(written), Object(given)) => given.iter().for_each(|(key, value)| assert_contains(&written[key], value)),
        (Array(written), Array(given)) => {
            assert_eq!(written.len(), given.len());
            written.iter().zip(given).for_each(|(written, given)| assert_contains(written, given));
        }
        (Number(written), Number(given)) => assert_eq!(written.as_f64(), given.as_f64()),
        _ => assert_eq!(written, given),
    }
}

fn any_finite() -> impl Strategy<Value = f64> {
    use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO
}

/// Positive numbers whose products stay within the range of floating point.
fn any_magnitude() -> impl Strategy<Value = f64> {
    (1.0..10.0, -100..100).prop_map(|(digits, exponent)| digits * 10.0_f64.powi(exponent))
}

/// All kinds of JSON values, also such as scenarios have.
fn any_json() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        any_finite().prop_map(|number| format!("{number:?}")),
        (-3_i64..300).prop_map(|number| number.to_string()),
        Just("1e999".to_owned()),
        Just("NaN".to_owned()),
        Just("null".to_owned()),
        Just("true".to_owned()),
        Just("\"equilibrium\"".to_owned()),
        Just("\"\\ud800\"".to_owned()),
        ".{0,8}".prop_map(|text| format!("{text:?}")),
        ".{0,8}",
    ];
    leaf.prop_recursive(2, 12, 4, |inner| {
        let field = ("constant|horizontal|anchor|tension|mass|[a-z ]{0,3}", inner.clone());
        prop_oneof![
            prop::collection::vec(inner, 0..4).prop_map(|items| format!("[{}]", items.join(", "))),
            prop::collection::vec(field.prop_map(|(name, value)| format!("{name:?}: {value}")), 0..4)
                .prop_map(|fields| format!("{{ {} }}", fields.join(", "))),
        ]
    })
}

/// A sample's values: where each begins and ends.
fn values(sample: &str) -> Vec<std::ops::Range<usize>> {
    let mut values = Vec::new();
    for (start, _) in sample.char_indices() {
        let mut stream = serde_json::Deserializer::from_str(&sample[start..]).into_iter::<serde_json::Value>();
        if stream.next().is_some_and(|value| value.is_ok()) {
            values.push(start..start + stream.byte_offset());
        }
    }
    values
}

fn assert_survives(text: &str) -> Result<(), TestCaseError> {
    match Scenario::from_json(text) {
        Ok(scenario) => {
            prop_assert!(scenario.to_robot().is_ok());
            let again = Scenario::from_json(&scenario.to_json());
            prop_assert_eq!(again.as_ref(), Ok(&scenario));
            // Zeros of both signs are equal, their texts are not.
            prop_assert_eq!(again.unwrap().to_json(), scenario.to_json());
        }
        Err(faults) => {
            prop_assert!(!faults.list().is_empty());
            for fault in faults.list() {
                prop_assert_eq!(fault.to_string().lines().count(), 1, "{}", fault);
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn replaced_values_are_told_or_survive(which in any::<prop::sample::Index>(), new in any_json()) {
        for sample in [SAMPLE, &with_path(SECOND, PATH)] {
            let values = values(sample);
            let range = which.get(&values).clone();
            assert_survives(&format!("{}{new}{}", &sample[..range.start], &sample[range.end..]))?;
        }
    }

    #[test]
    fn damaged_texts_are_told_or_survive(at in 0..SAMPLE.len(), length in 0_usize..20, new in ".{0,3}") {
        let end = (at + length).min(SAMPLE.len());
        assert_survives(&format!("{}{new}{}", &SAMPLE[..at], &SAMPLE[end..]))?;
    }

    #[test]
    fn any_text_is_told(text in ".*") {
        prop_assert!(Scenario::from_json(&text).is_err());
    }

    #[test]
    fn every_number_is_written_and_read_to_the_last_bit(
        magnitudes in prop::array::uniform8(any_magnitude()),
        numbers in prop::collection::vec(any_finite(), 10),
        path in (prop::array::uniform4(-1e3_f64..1e3), 1e-2_f64..1e3, 1e-3_f64..1e3, 0.0_f64..1e3, any::<bool>()),
    ) {
        let mut scenario = accepted(SAMPLE);
        let mut next = numbers.into_iter();
        let mut any = || next.next().unwrap();
        let [gravity, modulus, mass_per_length, mass, alpha, beta, speed, constant] = magnitudes;
        (scenario.gravity, scenario.cable.youngs_modulus, scenario.platform.mass) = (gravity, modulus, mass);
        (scenario.cable.mass_per_length, scenario.motion.speed) = (mass_per_length, speed);
        (scenario.damping.alpha, scenario.damping.beta) = (alpha, beta);
        scenario.motion.position = [any(), any()];
        scenario.motion.direction = [any(), any()];
        scenario.cables[2].anchor = [any(), any()];
        scenario.cables[2].tension = TensionLaw::Hypot { horizontal: [any(), any(), any()], vertical: [any(), 1.0, 2.0] };
        scenario.cables[3].tension = TensionLaw::Constant(constant);
        scenario.cables[1].cable.area = Some(modulus);
        scenario.cables[3].cable = OwnMaterial {
            youngs_modulus: Some(mass),
            mass_per_length: Some(constant),
            strain: Some(Strain::Engineering),
            ..OwnMaterial::default()
        };
        prop_assume!(scenario.to_robot().is_ok());
        assert_survives(&scenario.to_json())?;
        let ([ax, ay, bx, by], speed, acceleration, hold, smooth) = path;
        let path = Path {
            corners: if smooth { Corners::Smooth } else { Corners::Stop },
            profile: ProfileKind::Trapezoid,
            acceleration,
            jerk: 1.0 / speed,
            hold,
            ..Path::new(vec![[ax, ay], [bx, by]], speed)
        };
        let mut moving = Scenario { path: Some(path), ..scenario.clone() };
        moving.motion.position = [0.0, -0.0];
        prop_assert_eq!(moving.to_robot().is_ok(), moving.trajectory().is_some());
        if moving.to_robot().is_ok() {
            prop_assert_eq!(Scenario::from_json(&moving.to_json()), Ok(moving));
        }
        // The robot's own form keeps them as well; a direction once normalised stays as it is.
        let (robot, motion) = scenario.to_robot().unwrap();
        let direction = motion.direction();
        prop_assert!((direction.norm() - 1.0).abs() < 1e-15, "{direction}");
        let again = Scenario::new(&robot, &motion);
        prop_assert_eq!(again.to_robot().unwrap(), (robot, motion));
    }
}
