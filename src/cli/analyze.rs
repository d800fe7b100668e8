//! `tautline analyze`: statics, spectrum and critical speed of one scenario.

use std::io::{self, IsTerminal as _, Write as _};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::cli::{Answer, read_scenario, text};
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
    #[arg(long, value_name = "V", default_value_t = DEFAULT_MAX_SPEED, value_parser = speed, allow_hyphen_values = true)]
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

fn speed(text: &str) -> Result<f64, String> {
    let speed = text.parse().ok().filter(|&speed: &f64| speed.is_finite() && speed > 0.0);
    speed.ok_or_else(|| "allowed: a finite number greater than 0".into())
}

pub(super) fn run(args: &Args) -> Answer {
    let scenario = read_scenario(&args.file)?;
    let (robot, motion) = scenario.to_robot().map_err(|faults| vec![faults.to_string()])?;
    let mut progress = Progress::new(args.max_speed);
    let report =
        Report::analyze_watched(&robot, &motion, args.max_speed, args.method.into(), |speed| progress.show(speed));
    progress.clear();
    if args.json {
        let json = serde_json::to_string(&report).map_err(|error| vec![error.to_string()])?;
        return Ok(json + "\n");
    }
    Ok(text::report(&scenario, &motion, &report))
}

/// A line on standard error that says how far the search is, where that is a terminal and takes long.
struct Progress {
    limit: f64,
    next: Option<Instant>,
    shown: bool,
}

impl Progress {
    const PATIENCE: Duration = Duration::from_secs(1);
    const REFRESH: Duration = Duration::from_millis(100);

    fn new(limit: f64) -> Self {
        let next = io::stderr().is_terminal().then(|| Instant::now() + Self::PATIENCE);
        Self { limit, next, shown: false }
    }

    fn show(&mut self, speed: f64) {
        let now = Instant::now();
        if self.next.is_some_and(|next| now >= next) {
            let _ = write!(io::stderr(), "\rstable up to {speed:.1} of {} m/s \u{1b}[K", self.limit);
            self.next = Some(now + Self::REFRESH);
            self.shown = true;
        }
    }

    fn clear(&self) {
        if self.shown {
            let _ = write!(io::stderr(), "\r\u{1b}[K");
        }
    }
}
