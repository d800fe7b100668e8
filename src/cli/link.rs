//! `tautline link`: a scenario as a link.

use std::io::Read;
use std::path::PathBuf;

use crate::cli::output::{CommandResult, Output};
use crate::cli::streams::read_scenario;
use crate::scenario::link;

/// Print what to append to the page's address to open it with a scenario: #s=…
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The scenario file (JSON); - reads standard input.
    file: PathBuf,
}

pub(super) fn run(args: &Args, input: &mut dyn Read) -> CommandResult {
    let scenario = read_scenario(&args.file, input)?;
    Ok(Output::Text(format!("{}{}\n", link::MARK, link::encode(&scenario))))
}
