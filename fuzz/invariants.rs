//! What must hold for any bytes from outside: no panic and no hang. If the bytes are accepted, every number in the answer
//! is finite and nothing is lost. Each fuzz target has a function of the same name; `tests/fuzz_corpus.rs` calls them too.
//! A function gives whether the bytes were accepted.

use std::ffi::OsString;
use std::fmt::Debug;
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use base64::{Engine as _, prelude::BASE64_URL_SAFE_NO_PAD};
use tautline::cli::{self, Start, Streams};
use tautline::compute::protocol::{
    Batch, Incoming, Job, ModeChoice, Outgoing, Reply, Request, StudyJob, Task, Update, Which,
};
use tautline::compute::{Engine, PoolWorker};
use tautline::robot::{Faults, Linearisation, OwnMaterial, Side, Strain};
use tautline::scenario::link::{self, LinkError};
use tautline::scenario::report::StatusReport;
use tautline::scenario::{Corners, Path as ScenarioPath, ProfileKind, Report, Scenario, presets};
use tautline::study::{Directions, Grid, Line, Mapped, Reach, Study, Varied, WhatIf};

/// A target: tries bytes and gives whether they were accepted.
pub type Target = fn(&[u8]) -> bool;

/// Every target with its name.
pub const TARGETS: [(&str, Target); 6] = [
    ("scenario", scenario),
    ("link", link),
    ("protocol", protocol),
    ("analysis", analysis),
    ("worker", worker),
    ("arguments", arguments),
];

/// A call that keeps a processor busy for longer than this hangs. Replayed as a test it may run on a slow machine, or in a
/// build that counts lines.
const HANG: Duration = Duration::from_secs(if cfg!(test) { 10 } else { 1 });
/// The most elements, of all cables together, of a robot that is computed: larger ones take long and tell no more.
const MOST_ELEMENTS: usize = 24;
/// Critical speeds are searched up to this speed in m/s: robots without damping are scanned in steps of 0.1 m/s.
const MOST_SPEED: f64 = 2.0;
/// The most places of a study, and rows of a table.
const MOST_PLACES: usize = 4;
/// The most slices of an analysis.
const MOST_SLICES: usize = 12;

/// A study, the places that are asked for, a mode, and up to which speed to search.
type Wanted = (Study, Vec<usize>, ModeChoice, f64);

/// A scenario file.
pub fn scenario(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    match in_time(|| Scenario::from_json(&text)) {
        Ok(scenario) => survives(&scenario),
        Err(faults) => told(&faults),
    }
}

/// A link; and the fields of one, to which the checksum is added that they need.
pub fn link(bytes: &[u8]) -> bool {
    let read = |text: &str| match in_time(|| link::decode(text)) {
        Ok(scenario) => survives(&scenario),
        Err(LinkError::NotPhysical(faults)) => told(&faults),
        Err(LinkError::Damaged) => false,
        Err(LinkError::Newer) => {
            assert!(text.contains(|c| ('4'..='9').contains(&c)), "{text}");
            false
        }
    };
    let sealed = VERSIONS.map(|version| read(&sealed(version, bytes))).contains(&true);
    std::str::from_utf8(bytes).is_ok_and(read) || sealed
}

/// A message between page and worker: what can be read is written again as it was.
pub fn protocol(bytes: &[u8]) -> bool {
    let incoming = in_time(|| postcard::from_bytes::<Incoming>(bytes)).map(|message| sent(&message));
    let outgoing = in_time(|| postcard::from_bytes::<Outgoing>(bytes)).map(|message| {
        let again = postcard::from_bytes(&postcard::to_stdvec(&message).unwrap()).unwrap();
        same(&message, &again);
    });
    incoming.is_ok() || outgoing.is_ok()
}

/// The analysis of a small robot, given as the fields of a link.
pub fn analysis(bytes: &[u8]) -> bool {
    let Some(scenario) = small(bytes) else { return false };
    let (robot, motion) = scenario.to_robot().unwrap();
    let report = in_time(|| Report::analyze(&robot, &motion, MOST_SPEED));
    finite(&report);
    assert!(serde_json::from_str::<Report>(&serde_json::to_string(&report).unwrap()).is_ok(), "{report:?}");
    if report.cables.is_empty() {
        assert!(report.reason.is_some() && report.critical.is_none() && report.eigenvalues.is_empty(), "{report:?}");
        assert_eq!(report.status == Some(StatusReport::Infeasible), report.feasible == Some(false), "{report:?}");
        return true;
    }
    assert_eq!((report.feasible, report.stable_at_rest), (Some(true), Some(true)), "{report:?}");
    assert_eq!(report.status == Some(StatusReport::Found), report.critical.is_some(), "{report:?}");
    assert!(report.wave_limit.as_ref().is_none_or(|limit| limit.speed > 0.0), "{report:?}");
    assert_eq!(report.cables.len(), robot.cables.len());
    for cable in &report.cables {
        assert_eq!(cable.nodes.len(), robot.elements + 1);
        assert!(cable.unstretched_length > 0.0, "{cable:?}");
    }
    let growth = report.eigenvalues.iter().map(|value| value[0]).reduce(f64::max);
    assert_eq!(report.max_growth_rate, growth);
    if let Some(growth) = growth {
        assert_eq!(report.eigenvalues.len(), 4 * (robot.cables.len() * (robot.elements - 1) + 1));
        // Without damping, zero but for rounding is not stable.
        let largest = report.eigenvalues.iter().map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max);
        assert_eq!(report.stable, Some(growth < -1e-13 * largest), "{growth} of {largest}");
    }
    if let Some(critical) = &report.critical {
        assert!((0.0..=MOST_SPEED).contains(&critical.speed) && critical.frequency_hz >= 0.0, "{critical:?}");
        assert!((1..=robot.cables.len()).contains(&critical.cable), "{critical:?}");
    }
    true
}

/// Messages to a worker about a small robot, served as the worker does: [`Wanted`], then the fields of a link.
pub fn worker(bytes: &[u8]) -> bool {
    let Ok(((mut study, mut places, mode, mut max_speed), fields)) = postcard::take_from_bytes::<Wanted>(bytes) else {
        return false;
    };
    let Some(scenario) = small(fields) else { return false };
    let scenario = scenario.to_json();
    bound(&mut study);
    bound_speed(&mut max_speed);
    places.truncate(MOST_PLACES);

    let mut engine = Engine::default();
    let job = Job { revision: 1, scenario: scenario.clone(), max_speed, mode };
    for request in [Request::Analyze(job), Request::Shape(mode)] {
        if let Incoming::Request(request) = sent(&Incoming::Request(request)) {
            engine.submit(request);
        }
        for _ in 0..MOST_SLICES {
            let Some(replies) = in_time_once(|| engine.work()) else { break };
            for Reply { revision, update } in replies {
                assert_eq!(revision, 1);
                assert!(!matches!(update, Update::Broken(_)), "{update:?}");
                finite(&update);
            }
        }
    }

    let mut pool_worker = PoolWorker::default();
    let topic = study.topic();
    let study = Task::Study { generation: 1, job: StudyJob { revision: 1, scenario, study } };
    let batch = Task::Batch(Batch { topic, generation: 1, places: places.clone() });
    for task in [study, batch] {
        let Incoming::Task(task) = sent(&Incoming::Task(task)) else { continue };
        pool_worker.submit(task);
        while let Some(answered) = in_time_once(|| pool_worker.work()) {
            let Some(batch) = answered else { continue };
            assert!(batch.answers.iter().zip(&places).all(|((answered, _), place)| answered == place), "{batch:?}");
            finite(&batch);
        }
    }
    true
}

/// The command line: arguments, one a line, and after an empty line the standard input.
pub fn arguments(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    let (arguments, input) = text.split_once("\n\n").unwrap_or((&text, ""));
    let mut arguments: Vec<&str> = arguments.lines().collect();
    let scenario = Scenario::from_json(input);
    if !are_cheap(&arguments) || scenario.as_ref().is_ok_and(|scenario| !is_small(scenario)) {
        return false;
    }
    let has_limit = arguments.iter().any(|argument| argument.starts_with("--max-speed"));
    if matches!(arguments.first(), Some(&("analyze" | "map" | "sweep"))) && !has_limit {
        arguments.push("--max-speed=2");
    }
    let (mut output, mut errors) = (Vec::new(), Vec::new());
    let start = in_time_once(|| {
        let streams = Streams { input: &mut input.as_bytes(), output: &mut output, errors: &mut errors };
        cli::run_with(["tautline"].iter().chain(&arguments).map(OsString::from), streams)
    });
    let [output, errors] = [output, errors].map(|bytes| String::from_utf8(bytes).unwrap());
    match start {
        Start::App { scenario } => scenario.is_none_or(|scenario| survives(&scenario)),
        Start::Done(code) if code == ExitCode::SUCCESS => {
            assert!(!output.is_empty(), "{arguments:?} give nothing");
            // The robot's name is in the first line.
            assert!(output.lines().skip(1).all(is_finite), "{output}");
            if arguments[0] == "analyze" && output.starts_with(r#"{"schema""#) {
                assert!(serde_json::from_str::<Report>(&output).is_ok(), "{output}");
            }
            if let Some(link) = output.strip_prefix(link::MARK) {
                assert_eq!(link::decode(link).ok(), scenario.ok());
            }
            true
        }
        Start::Done(code) => {
            assert_eq!(code, ExitCode::from(2), "{errors}");
            assert_eq!(output, "");
            assert!(errors.lines().count() > 0 && errors.lines().all(|line| !line.trim().is_empty()), "{errors}");
            false
        }
    }
}

/// Inputs that are accepted, for mutations to begin with: the target's name, a name and the bytes.
pub fn seeds() -> Vec<(&'static str, String, Vec<u8>)> {
    let mut seeds = Vec::new();
    let limit = MOST_SPEED;
    for (i, preset) in presets::PRESETS.iter().enumerate() {
        let mut scenario = preset.scenario();
        let mut add =
            |target, what: &str, bytes: Vec<u8>| seeds.push((target, format!("{}{what}", preset.name), bytes));
        add("scenario", "", scenario.to_json().into_bytes());
        add("link", "", link::encode(&scenario).into_bytes());
        add("link", "-fields", fields(&scenario));
        // What is written by other means than usual.
        let mut odd = scenario.clone();
        odd.name = None;
        (odd.cable.strain, odd.linearisation) = (Strain::Engineering, Linearisation::Tangent);
        odd.cables[0].cable.area = Some(1e-4);
        odd.cables[2].cable = OwnMaterial {
            youngs_modulus: Some(2e11),
            area: Some(1.0 / 3e5),
            mass_per_length: Some(0.07),
            strain: Some(Strain::Green),
        };
        (odd.motion.position, odd.motion.direction) = ([-0.0, f64::MIN_POSITIVE], [1e200, -1.0 / 3.0]);
        add("scenario", "-odd", odd.to_json().into_bytes());
        add("link", "-odd", fields(&odd));
        // A path, with every form of a corner and a profile once among the robots.
        let kinds = [ProfileKind::Quintic, ProfileKind::Trapezoid, ProfileKind::Scurve, ProfileKind::Constant];
        let [x, y] = scenario.motion.position;
        let path = ScenarioPath {
            corners: if i % 2 == 0 { Corners::Smooth } else { Corners::Stop },
            profile: kinds[i % kinds.len()],
            acceleration: 1.0 / 3.0,
            ..ScenarioPath::new(vec![[x + 1.0, y], [x + 1.5, y - 0.75]], 2.5)
        };
        let moving = Scenario { path: Some(path), ..scenario.clone() };
        add("scenario", "-path", moving.to_json().into_bytes());
        add("link", "-path", fields(&moving));
        // Computed as well: of another material, but as small as the others.
        odd.elements_per_cable = 3;
        odd.motion = scenario.motion;
        add("analysis", "-own", fields(&odd));
        // Small, and of every robot another study.
        scenario.elements_per_cable = 3;
        let (robot, motion) = scenario.to_robot().unwrap();
        let (position, direction) = (motion.position(), motion.direction());
        let (grid, mapped) = (Grid::of(&robot, 2, 2), Mapped::Critical { limit });
        let growth = Mapped::Growth { speed: motion.speed() };
        let varied = |path: &str, values: &[f64]| Varied { path: path.into(), values: values.to_vec() };
        let studies = [
            Study::Line { line: Line::through(&robot, &motion, 3), limit },
            Study::Map { grid, directions: Directions::Worst(Directions::WORST_OF), mapped },
            Study::Map { grid, directions: Directions::One(direction), mapped: growth },
            Study::Directions { position, count: 3, limit },
            Study::Campbell { position, direction, to: 9.0, count: 3 },
            Study::Mesh { position, direction, counts: vec![2, 3], limit },
            Study::Border { grid },
            Study::WhatIf(WhatIf { numbers: vec![varied("gravity", &[0.0, 9.81])], limit }),
            Study::Reach(Reach { number: varied("platform.mass", &[1.0, 3.0]), target: 8.0, limit }),
        ];
        let study = studies[i % studies.len()].clone();
        let along_x = i % 2 == 0;
        let which = if along_x { Which::Critical } else { Which::Near([0.0, 1.0]) };
        let wanted: Wanted = (study.clone(), vec![0, 1], ModeChoice { which, along_x }, limit);
        add("analysis", "", fields(&scenario));
        add("worker", "", [postcard::to_stdvec(&wanted).unwrap(), fields(&scenario)].concat());
        let job = StudyJob { revision: 1, scenario: scenario.to_json(), study };
        let task = Incoming::Task(Task::Study { generation: 1, job });
        add("protocol", "", postcard::to_stdvec(&task).unwrap());
        let verb = [
            "analyze\n-\n--json",
            "map\n-\n--nx=2\n--ny=1\n--direction=worst",
            "sweep\n-\n--set\nplatform.mass=1:2:2\n--csv",
            "link\n-",
            "analyze\n-\n--method=dense",
            "-",
        ];
        add("arguments", "", format!("{}\n\n{}", verb[i % verb.len()], scenario.to_json()).into_bytes());
    }
    seeds
}

/// A scenario that was accepted is physical, and neither file nor link loses a bit of it.
fn survives(scenario: &Scenario) -> bool {
    let (robot, motion) = scenario.to_robot().unwrap();
    finite(&(&robot, motion));
    for cable in 0..robot.cables.len() {
        finite(&(robot.axial_stiffness(cable), robot.weight_per_length(cable)));
    }
    assert!((motion.direction().norm() - 1.0).abs() < 1e-15, "{motion:?}");
    assert_eq!(scenario.trajectory().is_some(), scenario.path.is_some());
    if let Some(trajectory) = scenario.trajectory() {
        for part in [0.0, 0.3, 1.0] {
            let moment = trajectory.at(part * trajectory.duration(), Side::Right);
            finite(&(&moment, moment.velocity(), moment.acceleration()));
        }
    }
    let json = scenario.to_json();
    for again in [Scenario::from_json(&json).unwrap(), link::decode(&link::encode(scenario)).unwrap()] {
        assert_eq!(&again, scenario);
        // Zeros of both signs are equal, their texts are not.
        assert_eq!(again.to_json(), json);
    }
    true
}

/// One line per fault.
fn told(faults: &Faults) -> bool {
    assert!(!faults.list().is_empty());
    for fault in faults.list() {
        assert_eq!(fault.to_string().lines().count(), 1, "{fault:?}");
    }
    false
}

/// The message as it comes out at the other end.
fn sent(message: &Incoming) -> Incoming {
    let received = postcard::from_bytes(&postcard::to_stdvec(message).unwrap()).unwrap();
    same(message, &received);
    received
}

/// Compared as texts, since NaN is not equal to itself.
fn same<T: Debug>(a: &T, b: &T) {
    assert_eq!(format!("{a:?}"), format!("{b:?}"));
}

/// Every number in `value` is finite. Texts may quote numbers that are not.
fn finite(value: &impl Debug) {
    let text = format!("{value:?}");
    assert!(text.split('"').step_by(2).all(is_finite), "{text}");
}

/// Whether no word of `text` is a number that is not finite.
fn is_finite(text: &str) -> bool {
    text.split(|c: char| !c.is_alphanumeric()).all(|word| !["NaN", "inf", "infinity"].contains(&word))
}

/// The marks of a link's versions; in the second cables may have a material of their own, in the third there is a path.
const VERSIONS: [&str; 3] = ["1", "2", "3"];

/// A link of this version with these fields.
fn sealed(version: &str, fields: &[u8]) -> String {
    let sum = crc32fast::hash(&[version.as_bytes(), fields].concat());
    format!("{version}{}", BASE64_URL_SAFE_NO_PAD.encode([fields, &sum.to_le_bytes()].concat()))
}

/// The fields of a scenario's link.
fn fields(scenario: &Scenario) -> Vec<u8> {
    let mut bytes = BASE64_URL_SAFE_NO_PAD.decode(&link::encode(scenario)[1..]).unwrap();
    bytes.truncate(bytes.len() - 4);
    bytes
}

/// The scenario with these fields of a link of any version, if it is one and computed quickly.
fn small(fields: &[u8]) -> Option<Scenario> {
    let read = |version: &&str| link::decode(&sealed(version, fields)).ok();
    VERSIONS.iter().find_map(read).filter(is_small)
}

fn is_small(scenario: &Scenario) -> bool {
    scenario.cables.len() * scenario.elements_per_cable <= MOST_ELEMENTS
}

/// Makes a study small. Numbers that are not allowed stay.
fn bound(study: &mut Study) {
    match study {
        Study::Line { limit, .. } | Study::Directions { limit, .. } | Study::WhatIf(WhatIf { limit, .. }) => {
            bound_speed(limit);
        }
        Study::Map { mapped, directions, .. } => {
            if let Mapped::Critical { limit } = mapped {
                bound_speed(limit);
            }
            // More than are allowed stay so.
            if let Directions::Worst(count) = directions
                && *count <= MOST_ELEMENTS * MOST_ELEMENTS
            {
                *count = (*count).min(Directions::WORST_OF);
            }
        }
        Study::Mesh { counts, limit, .. } => {
            for count in counts {
                *count = (*count).min(MOST_ELEMENTS / 4);
            }
            bound_speed(limit);
        }
        Study::Modes { spectra } => {
            spectra.truncate(MOST_PLACES);
            for (_, values) in spectra {
                values.truncate(MOST_ELEMENTS);
            }
        }
        Study::Border { grid } => grid.nx = grid.nx.min(MOST_ELEMENTS),
        // A search as far as a wanted speed that is far away takes long.
        Study::Reach(Reach { number, target, limit }) => {
            number.values.truncate(MOST_PLACES);
            bound_speed(target);
            bound_speed(limit);
        }
        Study::Path { limit, .. } => bound_speed(limit),
        Study::Gains { speeds } => speeds.truncate(MOST_PLACES),
        Study::Flight { options } => {
            options.samples = options.samples.min(MOST_PLACES);
            if options.accuracy > 0.0 {
                options.accuracy = options.accuracy.max(1e-3);
            }
        }
        Study::Allowed(allowed) => allowed.frozen.truncate(MOST_PLACES),
        Study::Campbell { .. } | Study::Move => {}
    }
}

fn bound_speed(max_speed: &mut f64) {
    if *max_speed > MOST_SPEED && max_speed.is_finite() {
        *max_speed = MOST_SPEED;
    }
}

/// Whether these arguments ask for little, and of no file.
fn are_cheap(arguments: &[&str]) -> bool {
    let mut rows = 1.0;
    for argument in arguments {
        let mut numbers = argument.split(['=', ':']).filter_map(|part| part.parse::<f64>().ok());
        if argument.contains("elements") && numbers.clone().any(|count| count > 4.0) {
            return false;
        }
        rows *= numbers.next_back().unwrap_or(1.0).max(1.0);
    }
    // A text that is no number counts as none.
    rows <= MOST_PLACES as f64 && !arguments.iter().any(|argument| Path::new(argument).exists())
}

/// The result of `act`, which must not hang.
fn in_time<T>(act: impl Fn() -> T) -> T {
    let begun = Instant::now();
    let result = act();
    // Another program may have had the processor.
    if begun.elapsed() > HANG { in_time_once(act) } else { result }
}

/// The same for what can be done only once.
fn in_time_once<T>(act: impl FnOnce() -> T) -> T {
    let (begun, busy) = (Instant::now(), busy());
    let result = act();
    let took = busy.zip(self::busy()).map_or(begun.elapsed(), |(before, after)| after.saturating_sub(before));
    assert!(took < HANG, "hangs: {took:?}");
    result
}

/// How long this thread has had a processor, if the system tells.
fn busy() -> Option<Duration> {
    let statistics = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(Duration::from_nanos(statistics.split_whitespace().next()?.parse().ok()?))
}
