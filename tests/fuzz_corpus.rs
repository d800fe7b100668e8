//! Bad input: input from outside is refused with a reason or survives. These tests replay the inputs that fuzzing has found
//! (`fuzz/`), and mutate accepted ones. `tests/scenario.rs` and `tests/link.rs` mutate single scenarios and links in depth.
#![cfg(all(feature = "cli", feature = "compute", not(target_arch = "wasm32")))]

#[path = "../fuzz/invariants.rs"]
mod invariants;

use std::fs;
use std::path::{Path, PathBuf};

use invariants::{TARGETS, Target, seeds};
use proptest::prelude::*;

/// The inputs of a target in `fuzz/corpus` (each reaches code that the others do not) or `fuzz/regressions` (each once
/// was a fault; its name says which).
fn inputs(folder: &str, target: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz").join(folder).join(target);
    let entries = fs::read_dir(folder).into_iter().flatten();
    entries.map(|entry| entry.unwrap().path()).collect()
}

/// Hands the file's bytes to its target; a panic then says which file it was.
fn replay(target: Target, path: &Path) -> bool {
    let bytes = fs::read(path).unwrap();
    std::panic::catch_unwind(|| target(&bytes)).unwrap_or_else(|_| panic!("{} broke an invariant", path.display()))
}

#[test]
fn the_corpus_is_told_or_survives() {
    for (name, target) in TARGETS {
        let files = inputs("corpus", name);
        let accepted = files.iter().filter(|path| replay(target, path)).count();
        // If everything were refused at once, little would be tested.
        assert!(accepted >= 5 && accepted < files.len(), "{name}: {accepted} of {} accepted", files.len());
    }
}

#[test]
fn what_was_a_fault_stays_mended() {
    for (name, target) in TARGETS {
        for path in inputs("regressions", name) {
            replay(target, &path);
        }
    }
}

#[test]
fn inputs_that_mutations_begin_with_are_accepted() {
    for (target, name, bytes) in seeds() {
        let (_, run) = TARGETS.iter().find(|(other, _)| *other == target).unwrap();
        assert!(run(&bytes), "{target}: {name}");
    }
}

/// Fuzzing tries short texts only.
#[test]
fn long_scenario_files_are_told_soon() {
    let fields = |count: usize, name: &str| format!("\"{name}\": 1, ").repeat(count);
    for text in [
        "[".repeat(1_000_000),
        format!("{}{}", "[".repeat(100_000), "]".repeat(100_000)),
        format!("{{\"platform\": {{{}{}\"mass\": 1}}}}", fields(50_000, "colour"), fields(50_000, "mass")),
        format!("{{\"cables\": [{}7]}}", "{\"anchor\": [1, 2], \"tension\": \"equilibrium\"}, ".repeat(20_000)),
        format!("{{\"gravity\": 0.{}}}", "1".repeat(1_000_000)),
        format!("{{\"name\": \"{}\"}}", "\\u00e9".repeat(200_000)),
        format!("{{\"name\": NaN, {}\"a\": \"{}\"}}", fields(20_000, ""), "\\\"".repeat(200_000)),
    ] {
        let (_, scenario) = TARGETS[0];
        assert!(!scenario(text.as_bytes()), "{text:.60}");
    }
}

/// Some changes of single bytes, and of numbers that are longer than a byte.
fn mutate(bytes: &mut Vec<u8>, changes: &[(prop::sample::Index, u8, Change)]) {
    for (at, byte, change) in changes {
        let at = at.index(bytes.len().max(1));
        match change {
            _ if bytes.is_empty() => bytes.push(*byte),
            Change::Replace => bytes[at] = *byte,
            Change::Flip => bytes[at] ^= 1 << (byte % 8),
            Change::Insert => bytes.insert(at, *byte),
            Change::Remove => drop(bytes.remove(at)),
            Change::Double => drop(bytes.splice(at..at, [7].into_iter().chain(f64::from(*byte).exp().to_le_bytes()))),
        }
    }
}

#[derive(Clone, Copy, Debug)]
enum Change {
    Replace,
    Flip,
    Insert,
    Remove,
    /// Eight bytes that are a number of any size, with the mark that they have in a link.
    Double,
}

fn changes() -> impl Strategy<Value = Vec<(prop::sample::Index, u8, Change)>> {
    let change =
        prop::sample::select(vec![Change::Replace, Change::Flip, Change::Insert, Change::Remove, Change::Double]);
    prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), change), 1..4)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_inputs_are_told_or_survive(which in any::<prop::sample::Index>(), changes in changes()) {
        let seeds = seeds();
        let (target, _, mut bytes) = which.get(&seeds).clone();
        mutate(&mut bytes, &changes);
        for (_, run) in TARGETS.iter().filter(|(name, _)| *name == target) {
            run(&bytes);
        }
    }
}
