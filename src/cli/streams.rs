//! Standard input, output and error, and the exit codes.

use std::io::{self, Read, Write};
use std::path::Path;
use std::process::ExitCode;

use crate::scenario::{Scenario, file};
use crate::stability::{ALLOWED_LIMIT, is_limit};

/// The exit code for bad input.
pub(super) const BAD_INPUT: u8 = 2;
/// The exit code where results could not be written.
pub(super) const NOT_WRITTEN: u8 = 1;

/// A line on standard error; where that is closed there is nobody to tell.
pub(super) fn complain(errors: &mut dyn Write, line: &str) {
    let _ = writeln!(errors, "{line}");
}

/// Writes to standard output, and to `errors` why that is not possible.
///
/// # Errors
/// The exit code to end with, where nothing more can be written. Standard output closed by its reader is no fault: it
/// has seen enough.
pub(super) fn write_out(output: &mut dyn Write, errors: &mut dyn Write, text: &str) -> Result<(), ExitCode> {
    output.write_all(text.as_bytes()).and_then(|()| output.flush()).map_err(|error| {
        if error.kind() == io::ErrorKind::BrokenPipe {
            return ExitCode::SUCCESS;
        }
        complain(errors, &format!("standard output: {error}"));
        ExitCode::from(NOT_WRITTEN)
    })
}

/// A speed up to which to search, in m/s.
pub(super) fn max_speed(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|&speed| is_limit(speed)).ok_or_else(|| format!("allowed: {ALLOWED_LIMIT}"))
}

fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// What messages call a file.
pub(super) fn file_name(path: &Path) -> String {
    if is_standard_input(path) { "standard input".into() } else { path.display().to_string() }
}

/// The scenario in a file, or in the standard `input` where `path` is `-`; faults with the file's name in front.
pub(super) fn read_scenario(path: &Path, input: &mut dyn Read) -> Result<Scenario, Vec<String>> {
    let (standard_input, name) = (is_standard_input(path), file_name(path));
    let fault = |what: &dyn std::fmt::Display| format!("{name}: {what}");
    let text = if standard_input { file::read(input) } else { file::open(path) };
    let text = text.map_err(|error| vec![fault(&error)])?;
    Scenario::from_json(&text).map_err(|faults| faults.list().iter().map(|one| fault(one)).collect())
}
