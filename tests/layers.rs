//! The layers of the crate: each room uses only those before it, and the numerics stay plain.
//!
//! The sources are read as text, as rustfmt writes them; what the reader could not follow is a failure too.

use std::path::{Path, PathBuf};

/// Each room with those it may use.
const ROOMS: [(&str, &[&str]); 11] = [
    ("steps", &[]),
    ("robot", &[]),
    ("mechanics", &["robot"]),
    ("stability", &["steps", "robot", "mechanics"]),
    ("flight", &["steps", "robot", "mechanics"]),
    ("study", &["robot", "mechanics", "stability", "flight"]),
    ("scenario", &["robot", "mechanics", "stability", "flight", "study"]),
    ("js", &["robot", "mechanics", "stability", "flight", "study", "scenario"]),
    ("compute", &["robot", "mechanics", "stability", "flight", "study", "scenario"]),
    ("app", &["robot", "mechanics", "stability", "flight", "study", "scenario", "compute"]),
    ("cli", &["robot", "mechanics", "stability", "flight", "study", "scenario", "compute"]),
];

/// The rooms that are plain numerics: no interface, clock, files, threads or serialisation, and no way to panic.
const NUMERICS: [&str; 6] = ["steps", "robot", "mechanics", "stability", "flight", "study"];

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

/// The files of a room: `src/room.rs` and everything under `src/room/`, without modules that are only tests.
fn files(room: &str) -> Vec<PathBuf> {
    let mut files = all_files(room);
    let is_test = |file: &PathBuf| {
        let declared = |text: String| text.contains(&format!("#[cfg(test)]\nmod {};", stem(file)));
        let parents = [file.with_file_name("mod.rs"), file.parent().expect("a folder").with_extension("rs")];
        parents.iter().filter_map(|parent| std::fs::read_to_string(parent).ok()).any(declared)
    };
    files.retain(|file| !is_test(file));
    files
}

fn stem(file: &Path) -> &str {
    file.file_stem().and_then(|stem| stem.to_str()).expect("a name")
}

/// The files of a room, tests included.
fn all_files(room: &str) -> Vec<PathBuf> {
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

/// The lines of code and of tests with their numbers: no comments.
fn code_and_tests(text: &str) -> Vec<(usize, &str)> {
    let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.split("//").next().unwrap_or_default()));
    lines.filter(|(_, line)| !line.trim().is_empty()).collect()
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

/// Calls `check` with every line of code in `files` and where it stands. `lines` picks them from the text of a file.
fn for_each_line(
    files: Vec<PathBuf>,
    lines: impl Fn(&str) -> Vec<(usize, &str)>,
    mut check: impl FnMut(&Path, &str, String),
) {
    for file in files {
        let text = std::fs::read_to_string(&file).expect("a source file");
        for (number, line) in lines(&text) {
            check(&file, line, format!("{}:{number}", file.display()));
        }
    }
}

#[test]
fn rooms_use_only_those_before_them() {
    let mut faults = Vec::new();
    for (room, allowed) in ROOMS {
        // Tests keep to the layers too.
        for_each_line(all_files(room), code_and_tests, |file, line, place| {
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
const NAMED_BY_THE_APP: [&str; 43] = [
    "flight::FastestMove",
    "flight::LimitOptions",
    "mechanics::WaveLimit",
    "study::Allowed",
    "study::Fastest",
    "study::MoveEffect",
    "study::Station",
    "flight::FlightOptions",
    "flight::Sample",
    "flight::CableSample",
    "flight::Flight",
    "flight::Slack",
    "study::Flown",
    "study::PathShape",
    "robot",
    "stability::Critical",
    "stability::Instability",
    "stability::TIE_OF_SHARES",
    "stability::first_largest",
    "stability::first_lowest",
    "study::Answer",
    "study::Mapped",
    "study::Grid",
    "study::Knob",
    "study::Line",
    "study::NoEigenvalues",
    "study::Reach",
    "study::Reached",
    "study::reach::together",
    "study::Sensitivity",
    "study::Status",
    "study::Strip",
    "study::Study",
    "study::Varied",
    "study::Verdict",
    "study::WhatIf",
    "study::campbell::Track",
    "study::compass",
    "study::convergence",
    "study::evenly",
    "study::validation::Comparison",
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
        for_each_line(files(room), code, |_, line, place| {
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
    assert_eq!(code_and_tests(text).len(), 13);
    let names: Vec<&str> = code.iter().flat_map(|(_, line)| used(line)).collect();
    assert_eq!(names, ["robot", "study", "cli"]);
    let room = source().join("study");
    assert!(out_of_the_room(&room.join("mod.rs"), "use super::app;"));
    assert!(!out_of_the_room(&room.join("local.rs"), "use super::LocalProblem;"));
    assert!(out_of_the_room(&room.join("local.rs"), "use super::super::app;"));
}

/// A file's name below `src`, and its place in the tree of modules; alternatives such as native.rs and web.rs have the
/// same place.
struct Module {
    file: String,
    path: Vec<String>,
    code: Vec<String>,
    /// Names that its `use` lines bring in, each with the full path that it stands for.
    imports: Vec<(String, Vec<String>)>,
}

fn texts(words: &[&str]) -> Vec<String> {
    words.iter().map(ToString::to_string).collect()
}

/// All modules of the library.
fn modules() -> Vec<Module> {
    let mut modules = Vec::new();
    for file in ROOMS.into_iter().flat_map(|(room, _)| files(room)) {
        let text = std::fs::read_to_string(&file).expect("a source file");
        let below = file.strip_prefix(source()).expect("a file under src");
        let mut path: Vec<String> =
            below.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
        path.pop_if(|last| last == "mod");
        let code = code(&text).into_iter().map(|(_, line)| line.to_owned()).collect();
        modules.push(Module { file: below.display().to_string(), path, code, imports: Vec::new() });
    }
    // `#[path = "native.rs"] mod platform;` gives a file another place.
    let mut moved: Vec<[Vec<String>; 2]> = Vec::new();
    for module in &modules {
        for pair in module.code.windows(2) {
            let file = pair[0].trim().strip_prefix("#[path = \"").and_then(|rest| rest.strip_suffix(".rs\"]"));
            let name = pair[1].trim().strip_suffix(';').and_then(|rest| rest.strip_prefix("mod "));
            if let (Some(file), Some(name)) = (file, name) {
                moved.push([file, name].map(|last| [module.path.clone(), texts(&[last])].concat()));
            }
        }
    }
    for module in &mut modules {
        if let Some([_, to]) = moved.iter().find(|[from, _]| *from == module.path) {
            module.path.clone_from(to);
        }
    }
    let places: Vec<Vec<String>> = modules.iter().map(|module| module.path.clone()).collect();
    for module in &mut modules {
        let imported = statements(&module.code).iter().flat_map(|statement| imported(statement)).collect::<Vec<_>>();
        let full = |(name, path): (String, Vec<String>)| Some((name, full(&path, &module.path, &places, &[])?));
        module.imports = imported.into_iter().filter_map(full).collect();
    }
    modules
}

/// The tree of a line that begins with `use`, after visibility.
fn use_tree(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let line = ["pub(super) ", "pub(crate) ", "pub "].iter().find_map(|seen| line.strip_prefix(seen)).unwrap_or(line);
    line.strip_prefix("use ")
}

/// The `use` statements of a file, each as one text from behind `use` to the semicolon.
fn statements(code: &[String]) -> Vec<String> {
    let mut statements: Vec<String> = Vec::new();
    let mut open = false;
    for line in code {
        match use_tree(line) {
            Some(tree) => statements.push(tree.to_owned()),
            None if open => statements.last_mut().expect("one that is open").push_str(line.trim()),
            None => continue,
        }
        open = !line.contains(';');
    }
    for statement in &mut statements {
        *statement = statement.replace([';', ' ', '\n'], "");
    }
    statements
}

/// The names that a `use` tree brings in, each with its path.
fn imported(tree: &str) -> Vec<(String, Vec<String>)> {
    let Some((before, list)) = tree.split_once('{') else {
        let path = texts(&tree.split("::").collect::<Vec<_>>());
        return path.last().map(|last| (last.clone(), path.clone())).into_iter().collect();
    };
    let list = list.strip_suffix('}').expect("a list that is closed");
    let (mut depth, mut items) = (0, vec![String::new()]);
    for c in list.chars() {
        match c {
            ',' if depth == 0 => {
                items.push(String::new());
                continue;
            }
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        items.last_mut().expect("an item").push(c);
    }
    items.retain(|item| !item.is_empty());
    let item = |item: &String| {
        imported(&if item == "self" { before.trim_end_matches("::").into() } else { format!("{before}{item}") })
    };
    items.iter().flat_map(item).collect()
}

/// A path from the crate's root, as it is meant in the module `from`; `None` where it leads to another crate.
fn full(
    path: &[String],
    from: &[String],
    places: &[Vec<String>],
    imports: &[(String, Vec<String>)],
) -> Option<Vec<String>> {
    let first = path.first()?;
    if let Some((_, start)) = imports.iter().find(|(name, _)| name == first) {
        return Some([start.as_slice(), &path[1..]].concat());
    }
    let ups = path.iter().take_while(|part| *part == "super").count();
    match first.as_str() {
        "crate" => Some(path[1..].to_vec()),
        "self" => Some([from, &path[1..]].concat()),
        "super" => Some([&from[..from.len() - ups], &path[ups..]].concat()),
        _ => {
            let child = [from, &path[..1]].concat();
            places.contains(&child).then(|| [from, path].concat())
        }
    }
}

/// The files that have the item at `path`: where it is imported again, those that it comes from.
fn homes(path: &[String], modules: &[Module], found: &mut Vec<usize>) {
    let within = |module: &Module| path.len() > module.path.len() && path.starts_with(&module.path);
    let Some(depth) = modules.iter().filter(|module| within(module)).map(|module| module.path.len()).max() else {
        return;
    };
    if modules.iter().any(|module| module.path == path) {
        return; // A module by itself: what is used of it has paths of its own.
    }
    for (i, module) in modules.iter().enumerate().filter(|(_, module)| within(module) && module.path.len() == depth) {
        let again = module.imports.iter().find(|(name, from)| *name == path[depth] && from.as_slice() != path);
        match again {
            Some((_, from)) => homes(&[from.as_slice(), &path[depth + 1..]].concat(), modules, found),
            None => found.push(i),
        }
    }
}

/// For each module the others that it uses. To pass a name on with `pub use` is not to use it.
fn uses(modules: &[Module]) -> Vec<Vec<usize>> {
    let places: Vec<Vec<String>> = modules.iter().map(|module| module.path.clone()).collect();
    let part = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let mut all = Vec::new();
    for (i, module) in modules.iter().enumerate() {
        let own = module.code.iter().filter(|line| use_tree(line).is_none());
        let paths = own.flat_map(|line| line.split(|c| !part(c))).filter(|word| word.contains("::"));
        let written = paths.filter_map(|word| {
            full(&texts(&word.split("::").collect::<Vec<_>>()), &module.path, &places, &module.imports)
        });
        let private =
            module.code.iter().filter(|line| !line.trim_start().starts_with("pub")).cloned().collect::<Vec<_>>();
        let private = statements(&private).iter().flat_map(|statement| imported(statement)).collect::<Vec<_>>();
        let private = private.into_iter().filter_map(|(_, path)| full(&path, &module.path, &places, &[]));
        let mut used = Vec::new();
        for path in written.chain(private) {
            homes(&path, modules, &mut used);
        }
        used.retain(|other| *other != i);
        used.sort_unstable();
        used.dedup();
        all.push(used);
    }
    all
}

#[test]
fn no_files_use_each_other() {
    let modules = modules();
    let uses = uses(&modules);
    let reached = |from: usize| {
        let (mut seen, mut next) = (Vec::new(), vec![from]);
        while let Some(at) = next.pop() {
            let new: Vec<usize> = uses[at].iter().copied().filter(|other| !seen.contains(other)).collect();
            seen.extend(&new);
            next.extend(&new);
        }
        seen
    };
    let reached: Vec<Vec<usize>> = (0..modules.len()).map(reached).collect();
    let mut faults = Vec::new();
    for (i, module) in modules.iter().enumerate() {
        for &j in uses[i].iter().filter(|j| reached[**j].contains(&i)) {
            let other = &modules[j].file;
            faults.push(format!("{} uses {other}, which leads back to it", module.file));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_reader_follows_paths_and_lists() {
    let code = texts(&["pub use crate::a::{", "    self, b::{C, D},", "};", "fn f() {}"]);
    let names = statements(&code).iter().flat_map(|statement| imported(statement)).collect::<Vec<_>>();
    let path = |words: &[&str]| texts(words);
    let expected =
        [("a", path(&["crate", "a"])), ("C", path(&["crate", "a", "b", "C"])), ("D", path(&["crate", "a", "b", "D"]))];
    assert_eq!(names, expected.map(|(name, path)| (name.to_owned(), path)));
    let places = [path(&["a"]), path(&["a", "b"])];
    let full = |words: &[&str], from: &[&str]| full(&path(words), &path(from), &places, &[]);
    assert_eq!(full(&["super", "X"], &["a", "b"]), Some(path(&["a", "X"])));
    assert_eq!(full(&["b", "X"], &["a"]), Some(path(&["a", "b", "X"])));
    assert_eq!(full(&["egui", "X"], &["a"]), None);
    let modules = modules();
    let index = |file: &str| modules.iter().position(|module| module.file == file).expect("a file");
    let uses = uses(&modules);
    let uses = |from: &str, to: &str| uses[index(from)].contains(&index(to));
    assert!(
        uses("app/panels/plots/mesh.rs", "app/panels/plots/common.rs")
            && uses("compute/pool/scheduler.rs", "compute/protocol.rs")
    );
    assert!(uses("app/canvas/mod.rs", "app/canvas/paint.rs") && !uses("app/canvas/paint.rs", "app/canvas/mod.rs"));
    assert!(
        uses("compute/pool/mod.rs", "compute/pool/native.rs") && uses("compute/pool/mod.rs", "compute/pool/web.rs")
    );
}
