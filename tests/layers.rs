//! The layers of the crate: each room uses only those before it, and the numerics stay plain.
//!
//! The sources are read as text, as rustfmt writes them; what the reader could not follow is a failure too.

use std::path::{Path, PathBuf};

/// Each room with those it may use.
const ROOMS: [(&str, &[&str]); 9] = [
    ("robot", &[]),
    ("mechanics", &["robot"]),
    ("stability", &["robot", "mechanics"]),
    ("study", &["robot", "mechanics", "stability"]),
    ("scenario", &["robot", "mechanics", "stability", "study"]),
    ("js", &["robot", "mechanics", "stability", "study", "scenario"]),
    ("compute", &["robot", "mechanics", "stability", "study", "scenario"]),
    ("app", &["robot", "mechanics", "stability", "study", "scenario", "compute"]),
    ("cli", &["robot", "mechanics", "stability", "study", "scenario", "compute"]),
];

/// The rooms that are plain numerics: no interface, clock, files, threads or serialisation, and no way to panic.
const NUMERICS: [&str; 4] = ["robot", "mechanics", "stability", "study"];

const FOREIGN: [&str; 16] = [
    "serde",
    "postcard",
    "egui",
    "eframe",
    "clap",
    "web_sys",
    "js_sys",
    "wasm_bindgen",
    "web_time",
    "std::time",
    "std::fs",
    "std::io",
    "std::env",
    "std::process",
    "std::thread",
    "std::{", // one path per line, so that the words above are found
];

/// The one way in which the numerics may have serde: core types go between page and worker as they are. Nothing that is read
/// from a message may get around the checks of a constructor, so `robot`, whose types are physical once they exist, has none.
const DERIVED: &str = r#"#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]"#;

const PANICS: [&str; 6] = [".unwrap()", ".expect(", "panic!", "todo!", "unimplemented!", "unreachable!"];

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The files of a room: `src/room.rs` and everything under `src/room/`.
fn files(room: &str) -> Vec<PathBuf> {
    let mut files = vec![source().join(format!("{room}.rs"))];
    files.retain(|file| file.exists());
    let mut folders = vec![source().join(room)];
    folders.retain(|folder| folder.exists());
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("a folder entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    // A module that is only tests: `#[cfg(test)] mod tests;`.
    files.retain(|file| file.file_stem().is_none_or(|stem| stem != "tests"));
    files
}

/// The lines of code with their numbers: no comments, and no items under `#[cfg(test)]`.
fn code(text: &str) -> Vec<(usize, &str)> {
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line));
    let mut code = Vec::new();
    while let Some((number, line)) = lines.next() {
        if line.trim() == "#[cfg(test)]" {
            // rustfmt ends an item with a brace as deep as its start.
            let indent = &line[..line.len() - line.trim_start().len()];
            for (_, line) in lines.by_ref() {
                let at_its_depth = line.strip_prefix(indent).is_some_and(|rest| !rest.starts_with(' '));
                if at_its_depth && (line.ends_with(';') || line.trim() == "}") {
                    break;
                }
            }
            continue;
        }
        let line = line.split("//").next().unwrap_or_default();
        if !line.trim().is_empty() {
            code.push((number, line));
        }
    }
    code
}

/// What follows each `crate::` or `tautline::` in a line, up to the next sign that is not part of a name.
fn used(line: &str) -> Vec<&str> {
    let name_end = |rest: &str| rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
    let starts = ["crate::", "tautline::"].map(|start| line.match_indices(start).map(move |(at, _)| at + start.len()));
    starts.into_iter().flatten().map(|at| &line[at..at + name_end(&line[at..])]).collect()
}

/// Whether `super::super::…` climbs to the crate's root, from where every room can be reached.
fn out_of_the_room(file: &Path, line: &str) -> bool {
    let below_source = file.strip_prefix(source()).expect("a file under src").iter().count() - 1;
    let depth = if file.ends_with("mod.rs") { below_source } else { below_source + 1 };
    line.contains(&"super::".repeat(depth))
}

/// Calls `check` with every line of code of a room and where it stands.
fn for_each_line(room: &str, mut check: impl FnMut(&Path, &str, String)) {
    for file in files(room) {
        let text = std::fs::read_to_string(&file).expect("a source file");
        for (number, line) in code(&text) {
            check(&file, line, format!("{}:{number}", file.display()));
        }
    }
}

#[test]
fn rooms_use_only_those_before_them() {
    let mut faults = Vec::new();
    for (room, allowed) in ROOMS {
        for_each_line(room, |file, line, place| {
            for name in used(line) {
                if name != room && !allowed.contains(&name) {
                    let what = if ROOMS.iter().any(|(other, _)| *other == name) {
                        format!("`{room}` must not use `{name}`")
                    } else {
                        "name one room per path, not the crate's root".to_owned()
                    };
                    faults.push(format!("{place}: {what}: {}", line.trim()));
                }
            }
            if out_of_the_room(file, line) {
                faults.push(format!("{place}: `super` leaves `{room}`, write crate:: : {}", line.trim()));
            }
        });
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// What the interface may name of the numerics: plain data, where things are, and sums over a handful of values. All else
/// would compute on the thread that draws; it belongs to the engine or to the pool.
const NAMED_BY_THE_APP: [&str; 23] = [
    "robot",
    "stability::Critical",
    "stability::Kind",
    "stability::TIE_OF_SHARES",
    "stability::first_largest",
    "stability::first_lowest",
    "study::Answer",
    "study::Asked",
    "study::Grid",
    "study::Knob",
    "study::Line",
    "study::NoAnswer",
    "study::Sensitivity",
    "study::Status",
    "study::Study",
    "study::Verdict",
    "study::campbell::Track",
    "study::compass",
    "study::convergence",
    "study::evenly",
    "study::validation::Outcome",
    "study::workspace",
    "study::Directions",
];

/// The full names in a `use` of the numerics, or in a path, with `{…}` written out; a module that is imported to be used
/// by its own name counts with everything below it.
fn names(line: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (at, _) in line.match_indices("crate::") {
        let path = &line[at + "crate::".len()..];
        let end = path.find(|c: char| !c.is_alphanumeric() && !"_:".contains(c)).unwrap_or(path.len());
        let head = path[..end].trim_end_matches(':');
        match path[end..].strip_prefix('{') {
            Some(list) => {
                let list = list.split('}').next().unwrap_or_default();
                for name in list.split(',').map(str::trim).filter(|name| !name.is_empty()) {
                    names.push(if name == "self" { head.into() } else { format!("{head}::{name}") });
                }
            }
            None => names.push(head.into()),
        }
    }
    names
}

#[test]
fn the_app_does_not_compute() {
    let mut faults = Vec::new();
    for file in files("app") {
        let text = std::fs::read_to_string(&file).expect("a source file");
        // Lists go on over several lines.
        let text: Vec<&str> = code(&text).into_iter().map(|(_, line)| line.trim()).collect();
        for name in names(&text.join(" ")) {
            let of_numerics = NUMERICS.iter().any(|room| name == *room || name.starts_with(&format!("{room}::")));
            let below = |allowed: &str| name == allowed || name.starts_with(&format!("{allowed}::"));
            if of_numerics && !NAMED_BY_THE_APP.into_iter().any(below) {
                faults.push(format!("{}: `{name}` is a computation, or a whole module with such", file.display()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    let told = names("use crate::study::campbell::{self, Track}; crate::mechanics::solve(robot)");
    assert_eq!(told, ["study::campbell", "study::campbell::Track", "mechanics::solve"]);
}

#[test]
fn numerics_are_plain_and_do_not_panic() {
    let mut faults = Vec::new();
    for room in NUMERICS {
        assert!(!files(room).is_empty(), "there is no `{room}`");
        for_each_line(room, |_, line, place| {
            if line.trim() == DERIVED && room != "robot" {
                return;
            }
            for word in FOREIGN.into_iter().chain(PANICS).filter(|word| line.contains(word)) {
                faults.push(format!("{place}: `{room}` must not have `{word}`: {}", line.trim()));
            }
        });
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_reader_sees_what_it_must_and_skips_what_it_should() {
    let text = "use crate::robot::Robot; // as in crate::app\n\n#[cfg(test)]\nmod tests {\n    fn f() {\n        x.unwrap();\n    }\n}\n\
                fn g() {\n    crate::study::h(crate::cli::K);\n}\n#[cfg(test)]\nmod more;\nfn k() {}\n";
    let code = code(text);
    let numbers: Vec<usize> = code.iter().map(|(number, _)| *number).collect();
    assert_eq!(numbers, [1, 9, 10, 11, 14]);
    let names: Vec<&str> = code.iter().flat_map(|(_, line)| used(line)).collect();
    assert_eq!(names, ["robot", "study", "cli"]);
    let room = source().join("study");
    assert!(out_of_the_room(&room.join("mod.rs"), "use super::app;"));
    assert!(!out_of_the_room(&room.join("local.rs"), "use super::Local;"));
    assert!(out_of_the_room(&room.join("local.rs"), "use super::super::app;"));
}
