//! `tautline map` and `tautline sweep` as a shell sees them: rows that are analyses, shards, bad input, Ctrl-C.
#![cfg(all(feature = "cli", not(target_arch = "wasm32")))]

mod common;

use std::io::{BufRead as _, BufReader, Read as _};
use std::process::{Command, Stdio};

use common::shell::{Done, File, refuse, succeed, tautline};
use serde_json::{Value, json};
use tautline::robot::{OwnMaterial, TensionLaw};
use tautline::scenario::{Path, Scenario, presets};

const COLUMNS: &str = "x,y,feasible,critical_speed,frequency_hz,kind,cable,wave_limit,status";

fn paper() -> Scenario {
    presets::find("paper").expect("a preset").scenario()
}

/// A small robot: four elements, so that its rows are quick to compute.
fn small() -> Scenario {
    Scenario { elements_per_cable: 4, ..paper() }
}

/// A table's header and its rows, each a list of its fields.
fn table(csv: &str) -> (String, Vec<Vec<String>>) {
    assert!(csv.ends_with('\n'), "{csv:?}");
    let mut lines = csv.lines();
    let header = lines.next().expect("a header").to_owned();
    let rows: Vec<Vec<String>> = lines.map(|line| line.split(',').map(str::to_owned).collect()).collect();
    let columns = header.split(',').count();
    assert!(rows.iter().all(|row| row.len() == columns), "{csv}");
    (header, rows)
}

fn map(scenario: &Scenario, more: &[&str]) -> (String, Vec<Vec<String>>) {
    table(&succeed(&[&["map", "-", "--csv"], more].concat(), &scenario.to_json()))
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("{text:?} is not a number"))
}

/// Fails unless a row's last columns are what `analyze --json` prints for `scenario`.
fn check_row(row: &[String], scenario: &Scenario) {
    let json = succeed(&["analyze", "-", "--json"], &scenario.to_json());
    let report: Value = serde_json::from_str(&json).expect("a report");
    let [x, y, feasible, speed, frequency, kind, cable, wave_limit, status] = row else { panic!("{row:?}") };
    assert_eq!([number(x), number(y)].as_slice(), scenario.motion.position, "{row:?}");
    assert_eq!(feasible.as_str(), report["feasible"].as_bool().map_or(String::new(), |b| b.to_string()), "{row:?}");
    assert_eq!(json!(status), report["status"], "{row:?}");
    match report["wave_limit"]["speed"].as_f64() {
        Some(speed) => assert!((number(wave_limit) / speed - 1.0).abs() < 1e-15, "{row:?}"),
        None => assert_eq!(wave_limit, "", "{row:?}"),
    }
    let critical = &report["critical"];
    if critical.is_null() {
        assert_eq!([speed, frequency, kind, cable], ["", "", "", ""], "{row:?}");
        return;
    }
    // To the last bit: what is printed reads back as the same number. (A `Value` may be off by the last bit.)
    let printed = |name: &str| {
        let (_, critical) = json.split_once("\"critical\":").expect("a critical speed");
        let (_, value) = critical.split_once(&format!("\"{name}\":")).expect("a field");
        number(value.split([',', '}']).next().unwrap_or_default()).to_bits()
    };
    assert_eq!(number(speed).to_bits(), printed("speed"), "{row:?}");
    assert_eq!(number(frequency).to_bits(), printed("frequency_hz"), "{row:?}");
    assert_eq!((&json!(kind), cable), (&critical["kind"], &critical["cable"].to_string()), "{row:?}");
}

#[test]
fn rows_of_a_map_are_the_analyses_of_their_poses() {
    for (more, direction) in
        [(&[][..], [1.0, 0.0]), (&["--direction", "-y"], [0.0, -1.0]), (&["--direction=-0.5,2"], [-0.5, 2.0])]
    {
        let (header, rows) = map(&paper(), &[&["--nx", "5", "--ny", "3"], more].concat());
        assert_eq!((header.as_str(), rows.len()), (COLUMNS, 15));
        // Along the rows, from the lowest one up.
        let positions: Vec<[f64; 2]> = rows.iter().map(|row| [number(&row[0]), number(&row[1])]).collect();
        let expected = |i: u32| [f64::from(i % 5) * 5.0 - 10.0, f64::from(i / 5) * 5.0 - 5.0];
        assert_eq!(positions, (0..15).map(expected).collect::<Vec<_>>());
        for (row, position) in rows.iter().zip(positions) {
            let mut scenario = paper();
            scenario.motion.position = position;
            scenario.motion.direction = direction;
            check_row(row, &scenario);
        }
        assert!(rows.iter().any(|row| row[2] == "false") && rows.iter().any(|row| row[5] == "flutter"));
    }
}

#[test]
fn one_point_is_in_the_middle_and_the_limit_is_kept() {
    let (_, rows) = map(&paper(), &["--nx", "1", "--ny", "1"]);
    check_row(&rows[0], &paper());
    let (_, rows) = map(&paper(), &["--nx", "1", "--ny", "1", "--max-speed", "11"]);
    assert_eq!(rows[0][..7], ["0", "0", "true", "", "", "", ""]);
    assert_eq!(rows[0][8], "none");
}

/// `feasible` is the answer of the statics, and empty if they could not be computed. The columns after it are about the
/// search.
#[test]
fn rows_say_whether_a_critical_speed_was_found_and_why_not() {
    let row = |scenario: &Scenario, more: &[&str]| {
        let arguments = [&["map", "-", "--csv", "--nx", "1", "--ny", "1"], more].concat();
        let Done { code, out, err } = tautline(&arguments, &scenario.to_json());
        let row = table(&out).1.pop().expect("a row");
        let told = "tautline: in 1 of 1 rows the critical speed could not be computed\n";
        assert_eq!((code, err.as_str()), (Some(0), if row[8] == "failed" { told } else { "" }), "{row:?}");
        assert_eq!([&row[3], &row[4], &row[5], &row[6]].map(String::is_empty), [row[8] != "found"; 4], "{row:?}");
        (row[2].clone(), row[7].is_empty(), row[8].clone())
    };
    let told = |feasible: &str, no_wave_limit, status: &str| (feasible.to_owned(), no_wave_limit, status.to_owned());
    assert_eq!(row(&paper(), &[]), told("true", false, "found"));
    assert_eq!(row(&paper(), &["--max-speed", "11"]), told("true", false, "none"));
    // A cable that cannot hold its own weight.
    let mut slack = paper();
    slack.cables[3].tension = TensionLaw::Constant(1.0);
    assert_eq!(row(&slack, &[]), told("false", true, "infeasible"));
    assert_eq!(row(&slack, &["--direction", "worst"]), told("false", true, "infeasible"));
    assert_eq!(row(&beyond_numbers(), &[]), told("", true, "failed"));
    assert_eq!(row(&beyond_numbers(), &["--direction", "worst"]), told("", true, "failed"));
    let text = tautline(&["map", "-", "--nx", "1", "--ny", "1"], &beyond_numbers().to_json()).out;
    assert!(text.contains("0 of 1 poses are feasible") && text.contains("1 could not be computed, marked ?"), "{text}");
}

/// A legal robot whose statics cannot be computed, since its size is at the end of the range of numbers.
fn beyond_numbers() -> Scenario {
    let mut scenario = Scenario { gravity: 0.0, ..small() };
    for cable in &mut scenario.cables {
        cable.anchor = cable.anchor.map(|coordinate| coordinate * 1e152);
        if cable.tension != TensionLaw::Equilibrium {
            cable.tension = TensionLaw::Constant(1e-3);
        }
    }
    scenario
}

#[test]
fn the_worst_direction_is_at_least_as_bad_as_any() {
    let at = |direction: &str| map(&small(), &["--nx", "7", "--ny", "3", "--direction", direction]).1;
    let worst = at("worst");
    let mut strictly = 0;
    for direction in ["+x", "-x", "+y", "-y"] {
        for (worst, one) in worst.iter().zip(at(direction)) {
            assert_eq!(worst[..3], one[..3]);
            if !one[3].is_empty() {
                assert!(number(&worst[3]) <= number(&one[3]) + 1e-8, "{worst:?} {one:?}");
                strictly += u32::from(number(&worst[3]) < number(&one[3]) - 1e-3);
            }
        }
    }
    assert!(strictly > 0);
}

#[test]
fn maps_are_drawn_for_people() {
    let text = succeed(&["map", "-", "--nx", "5", "--ny", "3", "--direction", "+x"], &paper().to_json());
    for part in [
        "Paper robot: critical speed in m/s, moving along (1, 0)\n",
        "\n    0.00      ·  8.14 11.30 10.88     ·\n",
        "\ny, x (m) -10.00 -5.00  0.00  5.00 10.00\n",
        " of 15 poses are feasible; · marks the others\n",
        "Lowest: ",
        "freezes time",
    ] {
        assert!(text.contains(part), "{part:?} is not in\n{text}");
    }
    // The uppermost row of the picture is that of the largest y.
    let first = |y: &str| text.find(&format!("\n{y:>8} ")).unwrap_or_else(|| panic!("no row {y} in\n{text}"));
    assert!(first("5.00") < first("0.00") && first("0.00") < first("-5.00"));

    let wide = succeed(&["map", "-", "--nx", "41", "--ny", "3", "--direction", "worst"], &small().to_json());
    assert!(wide.contains("in the worst of 16 directions") && wide.contains("0 to 9: tenths of the range"), "{wide}");
    assert!(wide.lines().all(|line| line.chars().count() < 120), "{wide}");
}

#[test]
fn rows_of_a_sweep_are_the_analyses_of_their_scenarios() {
    let sets = [
        "--set",
        "platform.mass=1:3:3",
        "--set",
        "cables[3].tension.horizontal[1]=-5:-4:2",
        "--set",
        "motion.position[0]=0:8:2",
    ];
    let csv = succeed(&[&["sweep", "-", "--csv"][..], &sets].concat(), &paper().to_json());
    let (header, rows) = table(&csv);
    let paths = "platform.mass,cables[3].tension.horizontal[1],motion.position[0]";
    assert_eq!((header, rows.len()), (format!("{paths},{COLUMNS}"), 12));
    let mut combinations = Vec::new();
    for mass in [1.0, 2.0, 3.0] {
        for slope in [-5.0, -4.0] {
            for x in [0.0, 8.0] {
                combinations.push([mass, slope, x]);
            }
        }
    }
    for (row, combination) in rows.iter().zip(combinations) {
        assert_eq!([0, 1, 2].map(|i| number(&row[i])).as_slice(), combination);
        let [mass, slope, x] = combination;
        let mut file: Value = serde_json::from_str(&paper().to_json()).expect("JSON");
        file["platform"]["mass"] = json!(mass);
        file["cables"][3]["tension"]["horizontal"][1] = json!(slope);
        file["motion"]["position"][0] = json!(x);
        check_row(&row[3..], &Scenario::from_json(&file.to_string()).expect("a scenario"));
    }
    // Several ranges may follow one --set, and the file may come last.
    let file = File::new("sweep.json", paper().to_json().as_bytes());
    let again = ["sweep", "--csv", "--set", sets[1], sets[3], "--set", sets[5], file.path()];
    assert_eq!(succeed(&again, ""), csv);
}

#[test]
fn numbers_that_the_file_leaves_out_can_be_swept() {
    let mut file: Value = serde_json::from_str(&small().to_json()).expect("JSON");
    let fields = file.as_object_mut().expect("an object");
    fields.remove("gravity");
    fields.remove("schema");
    let sweep = |set: &str| table(&succeed(&["sweep", "-", "--csv", "--set", set], &file.to_string())).1;
    let rows = sweep("gravity=0:9.81:2");
    for (row, gravity) in rows.iter().zip([0.0, 9.81]) {
        check_row(&row[1..], &Scenario { gravity, ..small() });
    }
    // Whole numbers stay whole; a single value is the first; both ends may be the same; very small numbers too.
    let first = |set: &str| sweep(set).into_iter().map(|row| row[0].clone()).collect::<Vec<_>>();
    assert_eq!(first("elements_per_cable=4:8:3"), ["4", "6", "8"]);
    assert_eq!(first("damping.beta=0.003:9:1"), ["0.003"]);
    assert_eq!(first("damping.alpha=0.1:0.1:2"), ["0.1", "0.1"]);
    assert_eq!(first("damping.beta=1e-7:3e-7:3"), ["1e-7", "2e-7", "3e-7"]);
}

#[test]
fn what_a_cable_has_of_its_own_can_be_swept_where_it_has_it() {
    let mut scenario = small();
    scenario.cables[1].cable.area = Some(6e-5);
    let set = "cables[1].cable.area=2e-5:6e-5:3";
    let (header, rows) = table(&succeed(&["sweep", "-", "--csv", "--set", set], &scenario.to_json()));
    assert!(header.starts_with("cables[1].cable.area,x,y,"), "{header}");
    for (row, area) in rows.iter().zip([2e-5, 4e-5, 6e-5]) {
        scenario.cables[1].cable.area = Some(area);
        check_row(&row[1..], &scenario);
    }
    let lines = refuse(&["sweep", "-", "--csv", "--set", set], &small().to_json());
    assert!(lines.len() == 1 && lines[0].contains("no such number"), "{lines:?}");
    // An own E and the common A are at fault together only, and not in the first part's row.
    let sets = ["--set", "cable.area=1e-5:1e200:2", "--set", "cables[1].cable.youngs_modulus=1e8:1e200:2"];
    scenario.cables[1].cable = OwnMaterial { youngs_modulus: Some(1e8), ..OwnMaterial::default() };
    let lines = refuse(&[&["sweep", "-", "--csv", "--shard=1/4"][..], &sets].concat(), &scenario.to_json());
    assert!(
        lines.len() == 1 && lines[0].contains("cables[1].cable.youngs_modulus: 1e+200 is not allowed"),
        "{lines:?}"
    );
}

/// A path changes no critical speed. It must not forbid a position either, such as that of its own end.
#[test]
fn a_path_in_the_file_is_swept_by_its_numbers_and_disturbs_no_other() {
    let mut moving = small();
    let [x, y] = moving.motion.position;
    moving.path = Some(Path::new(vec![[x + 1.0, y]], 2.0));
    let set = format!("motion.position[0]={x}:{}:2", x + 1.0);
    let sweep = |scenario: &Scenario, set: &str| {
        table(&succeed(&["sweep", "-", "--csv", "--max-speed", "4", "--set", set], &scenario.to_json())).1
    };
    let rows = sweep(&moving, &set);
    assert_eq!(rows.len(), 2);
    assert_eq!(rows, sweep(&Scenario { path: None, ..moving.clone() }, &set));
    // Its own numbers are numbers as others are: there with the path, not there without.
    let of_path = sweep(&moving, "path.points[0][1]=0.5:1:2");
    assert_eq!(of_path.iter().map(|row| row[0].as_str()).collect::<Vec<_>>(), ["0.5", "1"]);
    assert_eq!(of_path[0][1..], of_path[1][1..]);
    assert_eq!(of_path[0][1..], rows[0][1..]);
    let told = |scenario: &Scenario, sets: &[&str]| {
        let sets = sets.iter().flat_map(|set| ["--set", set]);
        let all: Vec<&str> = ["sweep", "-", "--csv", "--shard", "1/4"].into_iter().chain(sets).collect();
        refuse(&all, &scenario.to_json())
    };
    let without = Scenario { path: None, ..moving.clone() };
    assert!(told(&without, &["path.speed=1:2:2"])[0].contains("path.speed: no such number"));
    assert!(told(&moving, &["path.hold=1:-1:2"])[0].contains("path.hold: -1"));
    assert!(told(&moving, &["path.profile=1:2:2"])[0].contains("only a number can be swept, not \"quintic\""));
    // The end meets the beginning in the last row alone, which is not the first part's.
    let end = format!("path.points[0][0]={}:{}:2", x + 2.0, x + 1.0);
    let lines = told(&moving, &[&set, &end]);
    assert!(lines.len() == 1 && lines[0].contains("another point than motion.position"), "{lines:?}");
}

#[test]
fn sweeps_are_tables_for_people() {
    let sets = ["--set", "platform.mass=1:3:2", "--set", "motion.position[0]=0:8:2"];
    let text = succeed(&[&["sweep", "-"][..], &sets].concat(), &paper().to_json());
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 5);
    assert!(lines[0].contains("platform.mass") && lines[0].contains("motion.position[0]"), "{text}");
    assert!(lines[1].contains(" m/s, flutter at ") && lines[2].ends_with("not feasible"), "{text}");
}

#[test]
fn shards_are_the_parts_of_the_whole() {
    let sets = ["--set", "platform.mass=1:3:5", "--set", "motion.position[0]=-8:8:3"];
    let run = |shard: &[&str]| {
        let csv = succeed(&[&["sweep", "-", "--csv"][..], &sets, shard].concat(), &small().to_json());
        table(&csv)
    };
    let (header, whole) = run(&[]);
    assert_eq!(whole.len(), 15);
    for of in [1, 2, 4, 15, 20] {
        let parts: Vec<_> = (1..=of).map(|i| run(&["--shard", &format!("{i}/{of}")])).collect();
        assert!(parts.iter().all(|part| part.0 == header && part.1.len() <= 15_usize.div_ceil(of)));
        let joined: Vec<_> = parts.into_iter().flat_map(|part| part.1).collect();
        assert_eq!(joined, whole, "{of} shards");
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let run =
        |threads: &[&str]| map(&small(), &[&["--nx", "9", "--ny", "5", "--direction", "worst"], threads].concat());
    let all = run(&[]);
    assert_eq!((run(&["--threads", "1"]), run(&["--threads", "7"])), (all.clone(), all));
}

#[test]
fn bad_maps_are_refused() {
    let file = File::new("map.json", small().to_json().as_bytes());
    let good = ["map", file.path(), "--nx", "3", "--ny", "3"];
    assert_eq!(tautline(&good, "").code, Some(0));
    for (more, part) in [
        (&["--direction", "up"][..], "+x"),
        (&["--direction", "0,0"], "not both zero"),
        (&["--direction", "nan,1"], "not both zero"),
        (&["--direction", "1,2,3"], "not both zero"),
        (&["--max-speed", "0"], "greater than 0"),
        (&["--threads", "0"], "0 is not in"),
        (&["--xml"], "--xml"),
    ] {
        let lines = refuse(&[&good, more].concat(), "");
        assert!(lines.len() == 1 && lines[0].contains(part), "{lines:?}");
    }
    for count in ["0", "-1", "1.5", "2001", "99999999999999999999", "many", ""] {
        for [nx, ny] in [[count, "3"], ["3", count]] {
            let lines = refuse(&["map", file.path(), "--nx", nx, "--ny", ny], "");
            assert!(lines.len() == 1 && lines[0].contains(&format!("'{count}'")), "{lines:?}");
        }
    }
    assert!(refuse(&["map", file.path(), "--nx", "3"], "")[0].contains("--ny"));
    let bad = small().to_json().replace("\"mass\": 2.0", "\"mass\": -2.0").replace("\"speed\": 5.0", "\"speed\": -1");
    let lines = refuse(&["map", "-", "--nx", "3", "--ny", "3", "--csv"], &bad);
    assert!(lines.len() == 2 && lines[0].contains("standard input: platform.mass: -2.0"), "{lines:?}");
}

#[test]
fn bad_sweeps_are_refused_before_any_row() {
    let file = File::new("bad-sweep.json", small().to_json().as_bytes());
    let sweep = |sets: &[&str]| {
        let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", set]).collect();
        refuse(&[&["sweep", file.path(), "--csv"][..], &sets].concat(), "")
    };
    for (set, part) in [
        ("platform.mass", "PATH=START:STOP:COUNT"),
        ("platform.mass=1:2", "PATH=START:STOP:COUNT"),
        ("platform.mass=1:2:3:4", "PATH=START:STOP:COUNT"),
        ("platform.mass=one:2:3", "START is \"one\"; allowed: a finite number"),
        ("platform.mass=1:inf:3", "STOP is \"inf\"; allowed: a finite number"),
        ("platform.mass=1:2:0", "COUNT is \"0\"; allowed: a whole number from 1"),
        ("platform.mass=1:2:2.5", "COUNT is \"2.5\"; allowed: a whole number from 1"),
        ("platform.mas=1:2:3", "platform.mas: no such number; the scenario has "),
        ("cables[4].anchor[0]=1:2:3", "no such number"),
        ("cables[03].anchor[0]=1:2:3", "no such number"),
        ("cables.3.anchor.0=1:2:3", "no such number"),
        ("=1:2:3", "no such number"),
        ("cable.strain=1:2:3", "only a number can be swept, not \"green\""),
        ("cables[0].tension=1:2:3", "only a number can be swept, not \"equilibrium\""),
        ("motion.position=1:2:3", "only a number can be swept, not [0.0,0.0]"),
        // The last value is at fault.
        ("platform.mass=1:0:3", "platform.mass: 0.0 is not allowed; allowed: a finite number greater than 0"),
        ("elements_per_cable=4:5:3", "elements_per_cable: 4.5 is not allowed; allowed: a whole number from 2 to 200"),
        ("elements_per_cable=100:300:3", "elements_per_cable: 300.0 is not allowed"),
        ("cables[0].anchor[0]=0:10:3", "cables[1].anchor: [10.0,5.0] is not allowed; allowed: a point that differs"),
        ("motion.direction[0]=-1:1:3", "motion.direction: [0.0,0.0] is not allowed"),
    ] {
        let lines = sweep(&[set]);
        assert!(lines.len() == 1 && lines[0].starts_with("tautline: --set") && lines[0].contains(part), "{lines:?}");
    }
    // One line per fault; the same fault many times is told once.
    let lines = sweep(&["platform.mass=-9:1:11", "damping.beta=-1:1:20", "gravity=1:2:3"]);
    assert!(
        lines.len() == 2 && lines[0].contains("damping.beta: -1.0") && lines[1].contains("mass: -9.0"),
        "{lines:?}"
    );
    assert_eq!(sweep(&["platform.mas=1:2:3", "gravity=1", "gravity=1:2:2", "gravity=1:3:2"]).len(), 3);
    assert!(sweep(&["gravity=1:2:2", "gravity=3:4:2"])[0].contains("given twice"));
    let many = "damping.alpha=0:1:10000";
    assert!(sweep(&[many, &many.replace("alpha", "beta")])[0].contains("at most 10000000 rows"));
    // Two numbers may be at fault only together. Every shard then tells the fault with both.
    let together = ["--set", "cables[0].anchor[0]=-10:10:2", "--set", "cables[0].anchor[1]=4:5:2"];
    for shard in ["1/4", "4/4"] {
        let lines = refuse(&[&["sweep", file.path(), "--csv", "--shard", shard][..], &together].concat(), "");
        assert!(lines.len() == 1 && lines[0].ends_with(", where cables[0].anchor[0] = 10, cables[0].anchor[1] = 5"));
    }

    let good = ["sweep", file.path(), "--csv", "--set", "gravity=9:10:2"];
    assert_eq!(tautline(&good, "").code, Some(0));
    for shard in ["0/3", "4/3", "1", "1/0", "a/b", "1.0/2", "-1/2", ""] {
        let lines = refuse(&[&good[..], &["--shard", shard]].concat(), "");
        assert!(lines.len() == 1 && lines[0].contains("I from 1 to N"), "{lines:?}");
    }
    for arguments in [
        &["sweep", file.path()][..],
        &["sweep", "--set", "gravity=1:2:2"],
        &["sweep", "/no/such/file.json", "--set", "gravity=1:2:2"],
    ] {
        assert_eq!(refuse(arguments, "").len(), 1, "{arguments:?}");
    }
}

/// Starts a map that takes long.
fn long_map(file: &File) -> std::process::Child {
    Command::new(env!("CARGO_BIN_EXE_tautline"))
        .args(["map", file.path(), "--nx", "2000", "--ny", "2000", "--csv"])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program")
}

#[cfg(unix)]
#[test]
fn after_ctrl_c_there_are_whole_rows_only() {
    let file = File::new("interrupted.json", paper().to_json().as_bytes());
    let mut process = long_map(&file);
    let mut out = BufReader::new(process.stdout.take().expect("standard output"));
    // Rows come while others are still being computed.
    let mut csv = String::new();
    for _ in 0..50 {
        out.read_line(&mut csv).expect("a row");
    }
    let kill = Command::new("sh").arg("-c").arg(format!("kill -INT {}", process.id())).status();
    assert!(kill.expect("a shell").success());
    out.read_to_string(&mut csv).expect("the rest");
    let ended = process.wait_with_output().expect("the end");
    let err = String::from_utf8(ended.stderr).expect("text");
    let (header, rows) = table(&csv);
    assert_eq!((ended.status.code(), header.as_str()), (Some(130), COLUMNS), "{err}");
    assert!((49..4_000_000).contains(&rows.len()), "{}", rows.len());
    assert_eq!(err, format!("tautline: interrupted after {} of 4000000 rows\n", rows.len()));
    // They are the map's first rows.
    for (i, row) in rows.iter().enumerate().take(2000) {
        assert!((number(&row[0]) - (20.0 * i as f64 / 1999.0 - 10.0)).abs() < 1e-12 && row[1] == "-5", "{row:?}");
    }
}

/// `tautline map … | head -2`: no panic, no complaint, and no work for nobody.
#[test]
fn a_closed_pipe_ends_a_map() {
    let file = File::new("closed.json", paper().to_json().as_bytes());
    let mut process = long_map(&file);
    let mut out = BufReader::new(process.stdout.take().expect("standard output"));
    let mut header = String::new();
    out.read_line(&mut header).expect("a header");
    assert_eq!(header.trim_end(), COLUMNS);
    drop(out);
    let ended = process.wait_with_output().expect("the end");
    assert_eq!((ended.status.code(), String::from_utf8(ended.stderr).expect("text").as_str()), (Some(0), ""));
}

/// docs/cluster.md: the shards of a sweep, shared out by GNU parallel and joined by awk, are the sweep.
#[cfg(unix)]
#[test]
fn gnu_parallel_shares_out_a_sweep() {
    let version = Command::new("parallel").arg("--version").output();
    let there = version.is_ok_and(|version| String::from_utf8_lossy(&version.stdout).contains("GNU parallel"));
    if !there {
        let demanded = std::env::var_os("TAUTLINE_TEST_PARALLEL").is_some();
        assert!(!demanded, "GNU parallel is missing: install the package `parallel`");
        eprintln!("SKIPPED: a sweep shared out by GNU parallel, because there is none (package `parallel`)");
        return;
    }
    let folder = std::env::temp_dir().join(format!("tautline-{}-parallel", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let sets = "--set platform.mass=1:3:7 'motion.position[0]=-8:8:5'";
    std::fs::write(folder.join("robot.json"), small().to_json()).expect("a file");
    let script = format!(
        "set -e\n\
         seq -w 1 12 | parallel -j 2 '\"$TAUTLINE\" sweep robot.json {} --csv --threads 1 --shard {{}}/12 > part-{{}}.csv'\n\
         awk 'FNR > 1 || NR == 1' part-*.csv",
        sets.replace('\'', "'\\''"),
    );
    let joined = Command::new("sh")
        .args(["-c", &script])
        .current_dir(&folder)
        .env("TAUTLINE", env!("CARGO_BIN_EXE_tautline"))
        .env("HOME", &folder)
        .stdin(Stdio::null())
        .output()
        .expect("a shell");
    let parts = (1..=12).filter(|i| folder.join(format!("part-{i:02}.csv")).exists()).count();
    let _ = std::fs::remove_dir_all(&folder);
    assert!(joined.status.success(), "{}", String::from_utf8_lossy(&joined.stderr));
    assert_eq!(parts, 12);
    let sets = ["--set", "platform.mass=1:3:7", "--set", "motion.position[0]=-8:8:5"];
    let whole = succeed(&[&["sweep", "-", "--csv"][..], &sets].concat(), &small().to_json());
    assert_eq!(String::from_utf8_lossy(&joined.stdout), whole);
    assert_eq!(whole.lines().count(), 36);
}

#[test]
fn help_names_the_columns() {
    for verb in ["map", "sweep"] {
        let Done { out, .. } = tautline(&[verb, "--help"], "");
        assert!(out.contains(COLUMNS), "{out}");
    }
    assert!(succeed(&["--help"], "").contains("sweep"));
}
