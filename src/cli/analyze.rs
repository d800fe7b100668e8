//! `tautline analyze`: statics, spectrum and critical speed of one scenario.

use std::io::Read;
use std::path::PathBuf;

use crate::cli::output::{CommandResult, Output};
use crate::cli::progress::Progress;
use crate::cli::streams::{max_speed, read_scenario};
use crate::cli::text;
use crate::scenario::Report;
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::stability::Method;

/// Analyze a scenario: static shape, stability at its speed, critical speed.
///
/// The critical speed is the smallest speed, along the scenario's direction of motion, at which a vibration of the
/// cables begins to grow.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The scenario file (JSON); - reads standard input.
    file: PathBuf,
    /// Print one JSON object for programs instead of text for people.
    #[arg(long)]
    json: bool,
    /// Search for the critical speed up to this speed, in m/s.
    #[arg(long, value_name = "V", default_value_t = DEFAULT_MAX_SPEED, value_parser = max_speed,
          allow_hyphen_values = true)]
    max_speed: f64,
    /// How to search for it.
    #[arg(long, value_enum, default_value_t = MethodArg::Structured)]
    method: MethodArg,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum MethodArg {
    /// Along the cables, in milliseconds; by the dense scan where that leaves doubt.
    Structured,
    /// By all eigenvalues at speeds 0.1 m/s apart.
    Dense,
}

impl From<MethodArg> for Method {
    fn from(method: MethodArg) -> Self {
        match method {
            MethodArg::Structured => Self::Structured,
            MethodArg::Dense => Self::Dense,
        }
    }
}

pub(super) fn run(args: &Args, input: &mut dyn Read) -> CommandResult {
    let scenario = read_scenario(&args.file, input)?;
    let (robot, motion) = scenario.to_robot().map_err(|faults| vec![faults.to_string()])?;
    let limit = args.max_speed;
    let mut progress = Progress::new();
    let report = Report::analyze_watched(&robot, &motion, limit, args.method.into(), |speed| {
        progress.show(|| format!("stable up to {speed:.1} of {limit} m/s "));
    });
    progress.clear();
    if args.json {
        let json = serde_json::to_string(&report).map_err(|error| vec![error.to_string()])?;
        return Ok(Output::Text(json + "\n"));
    }
    Ok(Output::Text(text::report(&scenario, &motion, &report)))
}
