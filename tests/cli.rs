//! The command line as a shell sees it: what it prints where, and the exit codes.
#![cfg(all(feature = "cli", not(target_arch = "wasm32")))]

mod common;

use std::io::{Read, Write as _};
use std::process::{Command, Stdio};

use common::shell::{File, refuse, succeed};
use serde_json::Value;
use tautline::cli;
use tautline::robot::Strain;
use tautline::scenario::{Report, Scenario, link, presets};

fn analyze(input: &str, more: &[&str]) -> Value {
    let arguments = [&["analyze", "-", "--json"], more].concat();
    serde_json::from_str(&succeed(&arguments, input)).unwrap()
}

fn paper() -> Scenario {
    presets::find("paper").unwrap().scenario()
}

fn at(x: f64) -> String {
    let mut scenario = paper();
    scenario.motion.position[0] = x;
    scenario.to_json()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

#[test]
fn json_has_the_whole_analysis() {
    let report = analyze(&at(0.0), &[]);
    assert_eq!(report["schema"], "tautline/analysis/1");
    assert_eq!((&report["feasible"], &report["reason"]), (&Value::Bool(true), &Value::Null));
    assert_eq!((number(&report["speed"]), number(&report["searched_up_to"])), (5.0, 40.0));
    assert_eq!(report["eigenvalues"].as_array().unwrap().len(), 148);
    let growth = report["eigenvalues"].as_array().unwrap().iter().map(|l| number(&l[0])).fold(f64::MIN, f64::max);
    assert_eq!(report["max_growth_rate"], growth);
    assert_eq!(report["stable"], Value::Bool(growth < 0.0));
    // docs/theory.md section 10.
    let critical = &report["critical"];
    assert!((number(&critical["speed"]) - 11.2990).abs() < 1e-3, "{critical}");
    assert!((number(&critical["frequency_hz"]) - 0.27155).abs() < 1e-4, "{critical}");
    assert_eq!((&critical["kind"], &critical["cable"]), (&"flutter".into(), &4.into()));
    let cables = report["cables"].as_array().unwrap();
    assert_eq!(cables.len(), 4);
    for (cable, scenario) in cables.iter().zip(paper().cables) {
        for field in
            ["unstretched_length", "tension_at_platform", "tension_at_winch", "length_rate", "length_curvature"]
        {
            assert!(number(&cable[field]).is_finite());
        }
        let nodes = cable["nodes"].as_array().unwrap();
        assert_eq!(nodes.len(), 11);
        let end = [number(&nodes[10][0]), number(&nodes[10][1])];
        assert!((end[0] - scenario.anchor[0]).hypot(end[1] - scenario.anchor[1]) < 1e-9, "{end:?}");
    }
}

#[test]
fn json_is_the_report_of_the_library() {
    let (robot, motion) = paper().to_robot().unwrap();
    let report = Report::analyze(&robot, &motion, 12.0);
    assert_eq!(succeed(&["analyze", "-", "--json", "--max-speed", "12"], &at(0.0)), report_line(&report));
}

fn report_line(report: &Report) -> String {
    serde_json::to_string(report).unwrap() + "\n"
}

#[test]
fn the_critical_speed_is_searched_as_far_as_told() {
    let report = analyze(&at(0.0), &["--max-speed", "11"]);
    assert_eq!((&report["critical"], number(&report["searched_up_to"])), (&Value::Null, 11.0));
    let text = succeed(&["analyze", "-", "--max-speed", "11"], &at(0.0));
    assert!(text.contains("Critical speed: none found up to 11 m/s"), "{text}");
    let report = analyze(&at(0.0), &["--max-speed=11.4"]);
    assert!((number(&report["critical"]["speed"]) - 11.2990).abs() < 1e-3, "{report}");
}

#[test]
fn text_tells_people_what_matters() {
    let file = File::new("text.json", at(0.0).as_bytes());
    let text = succeed(&["analyze", file.path()], "");
    for part in [
        "Paper robot\n4 cables: EA = 6250 N,",
        "Platform at (0, 0) m, moving along (1, 0) at 5 m/s",
        "    1  equilibrium       10.908 m     166.6 N     185.7 N     +0.8911  paid out\n",
        "    4  law               11.329 m     67.27 N     47.84 N     -0.9193  reeled in\n",
        "At 5 m/s: stable, largest growth rate -0.182 1/s\n",
        "Least stable mode: 0.9787 Hz, damping ratio 0.0296\n",
        "Critical speed: 11.299 m/s, flutter at 0.2716 Hz, in cable 4, which is reeled in\n",
        "Margin: 6.299 m/s above the 5 m/s of the scenario, which uses 44 % of it\n",
        "freezes time",
    ] {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
    assert!(!text.contains("alone"), "{text}");
    let mut own = paper();
    own.cables[1].cable.area = Some(1e-5);
    own.cables[3].cable.mass_per_length = Some(0.2);
    own.cables[3].cable.strain = Some(Strain::Engineering);
    let text = succeed(&["analyze", "-"], &own.to_json());
    for line in ["\nCable 2 alone: EA = 1250 N\n", "\nCable 4 alone: 0.2 kg/m, engineering strain\n"] {
        assert!(text.contains(line), "{line:?} is not in\n{text}");
    }
    let mut fast = paper();
    fast.motion.speed = 12.0;
    let text = succeed(&["analyze", "-"], &fast.to_json());
    assert!(text.contains("Margin: none, the 12 m/s of the scenario exceeds it by 0.701 m/s"), "{text}");
}

#[test]
fn an_infeasible_pose_is_an_answer() {
    let report = analyze(&at(8.0), &["--max-speed", "20"]);
    assert_eq!(report["feasible"], false);
    let reason = report["reason"].as_str().unwrap();
    assert!(reason.contains("cable 1") && reason.ends_with('.'), "{reason}");
    for field in ["critical", "max_growth_rate", "stable"] {
        assert_eq!(report[field], Value::Null, "{field}");
    }
    for field in ["cables", "eigenvalues"] {
        assert_eq!(report[field], Value::Array(Vec::new()), "{field}");
    }
    assert_eq!((number(&report["speed"]), number(&report["searched_up_to"])), (5.0, 20.0));
    let text = succeed(&["analyze", "-"], &at(8.0));
    assert!(text.contains("Not feasible.") && text.contains(reason), "{text}");
}

#[test]
fn bad_scenarios_are_refused_with_a_line_per_fault() {
    let bad = at(0.0).replace("\"mass\": 2.0", "\"mass\": -2.0").replace("\"speed\": 5.0", "\"speed\": -1");
    let file = File::new("bad.json", bad.as_bytes());
    for more in [&["--json"][..], &[]] {
        let lines = refuse(&[&["analyze", file.path()], more].concat(), "");
        let [mass, speed] = &lines[..] else { panic!("{lines:?}") };
        assert_eq!(
            *mass,
            format!("{}: platform.mass: -2.0 is not allowed; allowed: a finite number greater than 0", file.path())
        );
        assert!(speed.contains("motion.speed: -1 is not allowed"), "{speed}");
    }
    // The application is not opened with them either.
    assert_eq!(refuse(&[file.path()], "").len(), 2);
    let lines = refuse(&["analyze", "-"], "{ \"gravity\": 9.81,\n  oops }");
    assert!(lines[0].starts_with("standard input: scenario: ") && lines[0].contains("line 2 column 3"), "{lines:?}");
    assert_eq!(lines.len(), 1);
    let lines = refuse(&["analyze", "/no/such/file.json"], "");
    assert!(lines.len() == 1 && lines[0].starts_with("/no/such/file.json: cannot be read: "), "{lines:?}");
}

/// A text in the encodings in which programs, those of Windows above all, write files.
fn encodings(text: &str) -> [(&'static str, Vec<u8>); 4] {
    let utf16 =
        |bytes: fn(u16) -> [u8; 2]| "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(bytes).collect();
    [
        ("UTF-8", text.into()),
        ("UTF-8 with a mark", format!("\u{feff}{text}").into()),
        ("UTF-16 LE", utf16(u16::to_le_bytes)),
        ("UTF-16 BE", utf16(u16::to_be_bytes)),
    ]
}

#[test]
fn files_of_other_systems_are_read_at_every_way_in() {
    let scenario = Scenario { name: Some("Größe 1, 大, 🤖".into()), ..paper() };
    let json = scenario.to_json().replace('\n', "\r\n");
    let verbs: [&[&str]; 4] = [
        &["link"],
        &["analyze"],
        &["map", "--nx", "2", "--ny", "1", "--max-speed", "1"],
        &["sweep", "--set", "gravity=9:10:2", "--max-speed", "1"],
    ];
    let expected = verbs.map(|verb| succeed(&[verb, &["-"]].concat(), &json));
    assert!(expected[1].contains("Größe 1, 大, 🤖"), "{}", expected[1]);
    for (encoding, bytes) in encodings(&json) {
        let file = File::new(&format!("{encoding}.json"), &bytes);
        for (verb, expected) in verbs.iter().zip(&expected) {
            assert_eq!(succeed(&[verb, &[file.path()][..]].concat(), ""), *expected, "{encoding}");
            assert_eq!(succeed(&[verb, &["-"][..]].concat(), &bytes), *expected, "{encoding}");
        }
        // The application is opened with it.
        let mut input = &bytes[..];
        for path in [file.path(), "-"] {
            let streams = cli::Streams { input: &mut input, output: &mut Vec::new(), errors: &mut Vec::new() };
            let cli::Start::App { scenario: Some(opened) } = cli::run_with(["tautline", path].map(Into::into), streams)
            else {
                panic!("{encoding}: not opened from {path}")
            };
            assert_eq!(*opened, scenario, "{encoding}");
        }
    }
}

#[test]
fn other_encodings_are_refused_with_a_hint() {
    let json = at(0.0);
    let wide = |bytes: fn(u32) -> [u8; 4]| json.chars().flat_map(|c| bytes(c.into())).collect::<Vec<u8>>();
    let marked = |bytes: fn(u32) -> [u8; 4]| [&bytes(0xfeff)[..], &wide(bytes)].concat();
    let [_, _, (_, little), (_, big)] = encodings(&json);
    let unmarked = "is UTF-16 without a byte order mark; save it as UTF-8";
    let cases: [(&[u8], &str); 10] = [
        (b"{\n  \"name\": \"M\xfcller\" }", "is not UTF-8: the byte 0xFC at position 15, in line 2; save it as UTF-8"),
        (&little[2..], unmarked),
        (&big[2..], unmarked),
        (&little[..little.len() - 1], "ends in the middle of a character"),
        (b"\xff\xfe{\0\x00\xd8}\0", "has a character that is not whole"),
        (&wide(u32::to_le_bytes), "is UTF-32; save it as UTF-8"),
        (&wide(u32::to_be_bytes), "is UTF-32; save it as UTF-8"),
        (&marked(u32::to_le_bytes), "is UTF-32; save it as UTF-8"),
        (&marked(u32::to_be_bytes), "is UTF-32; save it as UTF-8"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "is not a text"),
    ];
    for (bytes, hint) in cases {
        let file = File::new("encoding.json", bytes);
        let names = [(file.path(), file.path(), &b""[..]), ("-", "standard input", bytes)];
        for (path, name, input) in names {
            for arguments in [&["analyze", path][..], &[path]] {
                let lines = refuse(arguments, input);
                let [line] = &lines[..] else { panic!("{lines:?}") };
                assert!(line.starts_with(&format!("{name}: ")) && line.contains(hint), "{line}; expected: {hint}");
            }
        }
    }
}

#[test]
fn a_file_that_is_too_large_is_refused_before_it_is_read() {
    let file = File::new("large.json", b"");
    // Larger than the memory. Most file systems give it no room on the disk; the one of Windows does, so there it is smaller.
    let size = if cfg!(windows) { 1 << 30 } else { 1 << 40 };
    std::fs::OpenOptions::new().write(true).open(file.path()).unwrap().set_len(size).unwrap();
    for arguments in [&["analyze", file.path()][..], &["link", file.path()], &[file.path()]] {
        assert_eq!(refuse(arguments, ""), [format!("{}: is larger than 1 MB, which no scenario is", file.path())]);
    }
}

/// A source of nearly endless blanks.
struct Blanks(u64);

impl Read for Blanks {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        self.0 += buffer.len() as u64;
        buffer.fill(b' ');
        Ok(if self.0 < 100_000_000 { buffer.len() } else { 0 })
    }
}

#[test]
fn standard_input_without_end_is_refused_after_what_a_scenario_may_have() {
    let (mut input, mut errors) = (Blanks(0), Vec::new());
    let streams = cli::Streams { input: &mut input, output: &mut Vec::new(), errors: &mut errors };
    let start = cli::run_with(["tautline", "analyze", "-"].map(Into::into), streams);
    assert!(matches!(start, cli::Start::Done(_)));
    assert_eq!(String::from_utf8(errors).unwrap(), "standard input: is larger than 1 MB, which no scenario is\n");
    assert!(input.0 < 2_000_000, "{} bytes were read", input.0);
}

#[test]
fn bad_arguments_are_refused_on_one_line() {
    let file = File::new("arguments.json", at(0.0).as_bytes());
    for speed in ["0", "-1", "nan", "inf", "-inf", "1e999", "1e9", "10001", "fast", ""] {
        let lines = refuse(&["analyze", file.path(), "--max-speed", speed], "");
        assert!(
            lines.len() == 1 && lines[0].contains("greater than 0, at most 10000") && lines[0].contains(speed),
            "{lines:?}"
        );
    }
    for arguments in [
        &["analyze"][..],
        &["analyze", file.path(), "--max-speed"],
        &["analyze", file.path(), "--xml"],
        &["analyze", file.path(), "second.json"],
        &["--frob"],
        &[file.path(), "second.json"],
        &["example", "paper", "second"],
        &["analyse"],
    ] {
        let lines = refuse(arguments, "");
        assert!(lines.len() == 1, "{arguments:?}: {lines:?}");
    }
}

#[test]
fn every_example_is_listed_and_can_be_analyzed() {
    let list = succeed(&["example"], "");
    for preset in presets::PRESETS {
        assert!(list.contains(&format!("{}: {}\n", preset.name, preset.title)), "{list}");
        let example = succeed(&["example", preset.name], "");
        assert_eq!(Scenario::from_json(&example).unwrap(), preset.scenario());
        let report = analyze(&example, &[]);
        assert_eq!(report["feasible"], true, "{}", preset.name);
    }
    let lines = refuse(&["example", "papers"], "");
    assert!(lines.len() == 1 && lines[0].contains("\"papers\"") && lines[0].contains("paper-tangent"), "{lines:?}");
}

#[test]
fn a_scenario_becomes_a_link() {
    let file = File::new("link.json", at(1.5).as_bytes());
    let link = succeed(&["link", file.path()], "");
    assert_eq!(link, succeed(&["link", "-"], &at(1.5)));
    let text = link.strip_prefix("#s=").and_then(|rest| rest.strip_suffix('\n')).unwrap();
    assert_eq!(link::decode(text).unwrap(), Scenario::from_json(&at(1.5)).unwrap());
    let lines = refuse(&["link", "-"], &at(0.0).replace("\"mass\": 2.0", "\"mass\": 0"));
    assert!(lines.len() == 1 && lines[0].starts_with("standard input: platform.mass: 0 is not allowed"), "{lines:?}");
}

#[test]
fn help_and_version_are_results() {
    for arguments in [&["--help"][..], &["help"], &["analyze", "--help"], &["help", "example"], &["--version"]] {
        assert!(succeed(arguments, "").len() > 10);
    }
    let help = succeed(&["--help"], "");
    for part in ["analyze", "example", "[FILE]", "Exit codes"] {
        assert!(help.contains(part), "{help}");
    }
}

/// `tautline … | head -c 0`: no panic, no complaint.
#[test]
fn a_closed_pipe_is_no_fault() {
    let mut process = Command::new(env!("CARGO_BIN_EXE_tautline"))
        .args(["analyze", "-", "--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(process.stdout.take());
    process.stdin.take().unwrap().write_all(at(0.0).as_bytes()).unwrap();
    let output = process.wait_with_output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8(output.stderr).unwrap().as_str()), (Some(0), ""));
}

#[test]
fn both_methods_find_the_same_critical_speed() {
    let by = |method: &str| {
        let report = analyze(&at(2.0), &["--method", method]);
        report["critical"]["speed"].as_f64().unwrap()
    };
    let (structured, dense) = (by("structured"), by("dense"));
    assert!((structured - dense).abs() < 1e-6, "{structured} {dense}");
}
