//! The programs in examples/ print what their first comment says they print.
#![cfg(feature = "scenario")]

use std::error::Error;

#[expect(dead_code, reason = "`main` is for `cargo run --example`")]
#[path = "../examples/analyse.rs"]
mod analyse;
#[expect(dead_code, reason = "`main` is for `cargo run --example`")]
#[path = "../examples/map_csv.rs"]
mod map_csv;
#[expect(dead_code, reason = "`main` is for `cargo run --example`")]
#[path = "../examples/own_study.rs"]
mod own_study;

/// The lines between "```text" and "```" in the comment at the top of a source file.
fn shown(source: &str) -> String {
    let comment =
        source.lines().map_while(|line| line.strip_prefix("//!")).map(|line| line.strip_prefix(' ').unwrap_or(line));
    let lines: Vec<&str> =
        comment.skip_while(|line| *line != "```text").skip(1).take_while(|line| *line != "```").collect();
    assert!(!lines.is_empty(), "no output in the comment");
    lines.join("\n")
}

/// Compares what `write` writes with the comment in `source`.
fn check(source: &str, write: impl FnOnce(&mut Vec<u8>) -> Result<(), Box<dyn Error>>) {
    let mut out = Vec::new();
    write(&mut out).expect("the example runs");
    assert_eq!(String::from_utf8(out).expect("text").trim_end(), shown(source));
}

#[test]
fn analyse_prints_what_its_comment_shows() {
    check(include_str!("../examples/analyse.rs"), analyse::write);
}

#[test]
fn map_csv_prints_what_its_comment_shows() {
    check(include_str!("../examples/map_csv.rs"), |out| map_csv::write(&map_csv::built_in()?, out));
}

#[test]
fn own_study_prints_what_its_comment_shows() {
    check(include_str!("../examples/own_study.rs"), own_study::write);
}
