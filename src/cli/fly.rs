//! `tautline fly`: the non-linear flight along a path, and the growth along it.

use std::fmt::{self, Write as _};
use std::io::Read;

use crate::cli::course::{Course, CourseArgs, ProfileArgs, pair, positive};
use crate::cli::output::{CommandResult, Output};
use crate::cli::progress::Progress;
use crate::cli::text::digits;
use crate::flight::FlightOptions;
use crate::robot::Vec2;
use crate::scenario::flight_report::FlightReport;
use crate::scenario::options::MOST_SAMPLES;
use crate::stability::steps::finish_watched;

/// How many samples there may be.
const SAMPLES: std::ops::RangeInclusive<i64> = 2..=MOST_SAMPLES as i64;

/// Fly a path: how far the platform strays, when a cable goes slack, and what becomes of vibrations.
///
/// Integrates the non-linear equations from the quasi-static state at the beginning of the path. All lengths are those of
/// the quasi-static motion.
#[derive(Debug, clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Args {
    #[command(flatten)]
    course: CourseArgs,
    #[command(flatten)]
    profile: ProfileArgs,
    /// An impulse on the platform at the beginning, in N s.
    #[arg(long, value_name = "PX,PY", value_parser = pair, allow_hyphen_values = true)]
    kick: Option<[f64; 2]>,
    /// How many samples, equally spaced from the beginning to the end.
    #[arg(long, value_name = "N", default_value_t = 21, value_parser = clap::value_parser!(u32).range(SAMPLES),
          allow_hyphen_values = true)]
    samples: u32,
    /// The platform's error that the steps are chosen for, in m.
    #[arg(long, value_name = "M", default_value_t = 1e-6, value_parser = positive, allow_hyphen_values = true)]
    accuracy: f64,
    /// Print the samples as CSV.
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Print one JSON object for programs instead of text for people.
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
Fly the paper's robot from (-6, 0) to (6, 0) m at a peak speed of 5 m/s, and look for 2 s at what is left:
  tautline example paper | sed 's/\"position\": \\[0.0, 0.0\\]/\"position\": [-6, 0]/' |
    tautline fly - --to 6,0 --speed 5 --hold 2

CSV columns: t,s,x,y,v,a,dx,dy, then of each cable i length_i,rate_i,acceleration_i,tension_i,winch_tension_i. x and y are
the path's, dx and dy what the platform is off it. SI units.";

pub(super) fn run(args: &Args, input: &mut dyn Read) -> CommandResult {
    let Course { scenario, robot, trajectory, hold } = args.course.read(Some(&args.profile), input)?;
    let options = FlightOptions {
        kick: args.kick.map_or(Vec2::zeros(), Vec2::from),
        hold,
        accuracy: args.accuracy,
        samples: args.samples as usize,
        nodes: false,
    };
    let mut progress = Progress::new();
    let mut steps = 0_u64;
    let report = finish_watched(FlightReport::in_steps(&robot, &trajectory, &options), || {
        steps += 1;
        progress.show(|| format!("{steps} steps "));
    });
    progress.clear();
    if args.json {
        let json = serde_json::to_string(&report).map_err(|error| vec![error.to_string()])?;
        return Ok(Output::Text(json + "\n"));
    }
    if args.csv {
        return Ok(Output::Text(report.csv(robot.cables.len())));
    }
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(&mut text, scenario.name.as_deref(), trajectory.length(), &report);
    Ok(Output::Text(text))
}

/// The flight for people.
fn write(text: &mut String, name: Option<&str>, length: f64, report: &FlightReport) -> fmt::Result {
    let name = name.unwrap_or("Robot without a name").replace(char::is_control, " ");
    writeln!(text, "{name}: a move of {} m in {} s\n", digits(length, 4), digits(report.duration, 4))?;
    if let Some(reason) = &report.reason {
        writeln!(text, "{}{reason}\n", if report.feasible { "" } else { "Not feasible: " })?;
    }
    let millimetres = |metres: f64| digits(1e3 * metres, 4);
    if let Some(deviation) = report.max_deviation {
        writeln!(text, "Largest deviation of the platform: {} mm", millimetres(deviation))?;
    }
    if let Some(residual) = report.residual {
        writeln!(text, "After the stop: {} mm at most", millimetres(residual))?;
    }
    if let Some(slack) = report.slack {
        let (time, force) = (digits(slack.time, 4), digits(slack.force, 3));
        let cable = slack.cable;
        writeln!(text, "Cable {cable} goes slack at {time} s; what follows is doubtful (least force {force} N)")?;
    } else if report.max_deviation.is_some() {
        writeln!(text, "No cable goes slack")?;
    }
    if let Some(ratio) = report.wave_ratio {
        let verdict = if ratio.value < 1.0 { "nothing grows without bound" } else { "waves do not get back" };
        let way = if ratio.reeled_in { "reeled in" } else { "paid out" };
        let (value, s, cable) = (digits(ratio.value, 3), digits(ratio.s, 3), ratio.cable);
        writeln!(text, "Wave ratio: {value} of the wave limit at {s} m, cable {cable} {way}: {verdict}")?;
    }
    if let Some(gain) = report.gain {
        let action = digits(gain.action, 3);
        writeln!(text, "A vibration is at most {action} times as large after the move (by its action)")?;
    }
    if let Some(growth) = report.frozen_growth {
        writeln!(text, "The frozen eigenvalues would say {} times", digits(growth, 3))?;
    }
    for (what, least) in [("critical speed", report.least_critical_speed), ("wave limit", report.least_wave_limit)] {
        if let Some(least) = least {
            writeln!(text, "Least {what} on the path: {} m/s at {} m", digits(least.speed, 4), digits(least.s, 3))?;
        }
    }
    Ok(())
}
