//! `tautline limits`: the fastest profile along a path under local limits and the machine's.

use std::fmt::Write as _;
use std::io::Read;

use crate::cli::course::{Course, CourseArgs, positive};
use crate::cli::output::{CommandResult, Output};
use crate::cli::progress::Progress;
use crate::cli::text::digits;
use crate::flight::LimitOptions;
use crate::scenario::limits_report::LimitsReport;
use crate::scenario::options::SAFETY;
use crate::stability::steps::finish_watched;

/// The fastest move along a path from rest to rest, as a table that a controller can read.
///
/// The speed keeps below a part of the local limits, the frozen critical speed and the wave limit. Limits that are not given
/// do not act.
#[derive(Debug, clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Args {
    #[command(flatten)]
    course: CourseArgs,
    /// The part of the local limits that the speed keeps below.
    #[arg(long, value_name = "K", default_value_t = SAFETY, value_parser = positive, allow_hyphen_values = true)]
    safety: f64,
    /// The largest acceleration of the platform along its path, in m/s².
    #[arg(long, value_name = "A", value_parser = positive, allow_hyphen_values = true)]
    acceleration: Option<f64>,
    /// The largest speed of a winch, in m/s of cable.
    #[arg(long, value_name = "V", value_parser = positive, allow_hyphen_values = true)]
    winch_speed: Option<f64>,
    /// The largest acceleration of a winch, in m/s² of cable.
    #[arg(long, value_name = "A", value_parser = positive, allow_hyphen_values = true)]
    winch_acceleration: Option<f64>,
    /// The part of the slack acceleration that the acceleration keeps below.
    #[arg(long, value_name = "K", value_parser = positive, allow_hyphen_values = true)]
    slack: Option<f64>,
    /// Which local limits act.
    #[arg(long, value_enum, default_value_t = By::Both)]
    by: By,
    /// Print the table as CSV.
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Print one JSON object for programs instead of text for people.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, clap::ValueEnum)]
enum By {
    /// The frozen critical speed.
    Frozen,
    /// The wave limit.
    Wave,
    /// The lower of the two.
    Both,
}

const AFTER_HELP: &str = "\
CSV columns: t,s,x,y,v,a, then of each cable i length_i,rate_i,acceleration_i,tension_i,winch_tension_i, the tensions as at
rest. SI units. The acceleration jumps from row to row and excites vibrations: smooth the profile before flying it.";

pub(super) fn run(args: &Args, input: &mut dyn Read) -> CommandResult {
    let Course { scenario, robot, trajectory, .. } = args.course.read(None, input)?;
    let options = LimitOptions {
        safety: args.safety,
        frozen: args.by != By::Wave,
        waves: args.by != By::Frozen,
        slack: args.slack,
        acceleration: args.acceleration,
        winch_speed: args.winch_speed,
        winch_acceleration: args.winch_acceleration,
    };
    let mut progress = Progress::new();
    let mut places = 0_u64;
    let report = finish_watched(LimitsReport::in_steps(&robot, &trajectory, &options), || {
        places += 1;
        progress.show(|| format!("{places} steps "));
    });
    progress.clear();
    if args.json {
        let json = serde_json::to_string(&report).map_err(|error| vec![error.to_string()])?;
        return Ok(Output::Text(json + "\n"));
    }
    if args.csv {
        return Ok(Output::Text(report.csv(robot.cables.len())));
    }
    let name = scenario.name.as_deref().unwrap_or("Robot without a name").replace(char::is_control, " ");
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = writeln!(text, "{name}: the fastest move along {} m\n", digits(trajectory.length(), 4));
    if let (Some(duration), Some(peak)) = (report.duration, report.peak_speed) {
        let _ = writeln!(text, "Time: {} s", digits(duration, 4));
        let _ = writeln!(text, "Peak speed: {} m/s", digits(peak, 4));
        let _ =
            writeln!(text, "\n--csv prints the table. The acceleration jumps: smooth the profile before flying it.");
    }
    if let Some(reason) = &report.reason {
        let _ = writeln!(text, "{}{reason}", if report.feasible { "No such move: " } else { "Not feasible: " });
    }
    Ok(Output::Text(text))
}
