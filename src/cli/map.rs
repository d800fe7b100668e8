//! `tautline map`: critical speed and frequency over the workspace.

use std::fmt::{self, Write as _};
use std::io::Read;
use std::path::PathBuf;

use crate::cli::output::{CommandResult, Output};
use crate::cli::rows::{COLUMNS, Form, Options, Row, Rows};
use crate::cli::streams::read_scenario;
use crate::cli::text::{CAVEAT, critical_sentence, digits};
use crate::robot::Vec2;
use crate::scenario::options::MOST_POINTS;
use crate::stability::{TIE_OF_SPEEDS, first_largest, first_lowest};
use crate::study::{Answer, Directions, Grid, Mapped, Status, Study, Verdict, evenly};

/// Points in a row or column.
const POINTS: std::ops::RangeInclusive<i64> = 1..=MOST_POINTS as i64;
/// Wider maps show a digit per point.
const WIDEST_TABLE: usize = 20;

/// Critical speed and frequency at the points of a grid over the workspace.
///
/// The workspace is the rectangle around all anchors, its border included.
#[derive(Debug, clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Args {
    /// The scenario file (JSON); - reads standard input.
    file: PathBuf,
    /// Points in a row.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(POINTS), allow_hyphen_values = true)]
    nx: u32,
    /// Rows.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(POINTS), allow_hyphen_values = true)]
    ny: u32,
    /// Direction of the motion: +x, -x, +y, -y, a vector DX,DY, or worst, the lowest critical speed of 16 directions.
    /// The scenario's unless told otherwise.
    #[arg(long, value_name = "DIRECTION", value_parser = direction, allow_hyphen_values = true)]
    direction: Option<Directions>,
    #[command(flatten)]
    options: Options,
}

const AFTER_HELP: &str = "\
CSV columns: x,y,feasible,critical_speed,frequency_hz,kind,cable,wave_limit,status
SI units, cables counted from 1, empty where there is none. status: found, none (up to --max-speed), infeasible, or
failed (could not be computed).";

fn direction(text: &str) -> Result<Directions, String> {
    if let Some((_, directions)) = Directions::WORDS.iter().find(|(word, _)| *word == text) {
        return Ok(*directions);
    }
    let vector =
        text.split_once(',').and_then(|(x, y)| Some(Vec2::new(x.trim().parse().ok()?, y.trim().parse().ok()?)));
    let vector = vector.filter(|vector| vector.iter().all(|c| c.is_finite()) && *vector != Vec2::zeros());
    let allowed = "allowed: worst, +x, -x, +y, -y or two numbers DX,DY that are not both zero";
    vector.map(Directions::One).ok_or_else(|| allowed.into())
}

pub(super) fn run(args: &Args, input: &mut dyn Read) -> CommandResult {
    let scenario = read_scenario(&args.file, input)?;
    let (robot, motion) = scenario.to_robot().map_err(|faults| vec![faults.to_string()])?;
    let grid = Grid::of(&robot, args.nx as usize, args.ny as usize);
    let directions = args.direction.unwrap_or(Directions::One(motion.direction()));
    let limit = args.options.max_speed;
    let study = Study::Map { grid, directions, mapped: Mapped::Critical { limit } };
    let row = move |index| {
        let (verdict, wave_limit) = match study.answer(&robot, index) {
            Answer::Critical { verdict, wave_limit, .. } => (verdict, wave_limit),
            // Not what this study asks for.
            _ => (Verdict::Unknown, None),
        };
        Row { swept: Vec::new(), position: grid.position(index), verdict, wave_limit }
    };
    let form = if args.options.csv {
        Form::Csv { header: COLUMNS.into() }
    } else {
        let name = scenario.name.unwrap_or_else(|| "Robot without a name".into());
        Form::Text(Box::new(move |rows| picture(&name, &grid, directions, limit, rows)))
    };
    Ok(Output::Rows(Rows { count: grid.len(), row: Box::new(row), form, threads: args.options.threads() }))
}

/// The map as text.
fn picture(name: &str, grid: &Grid, directions: Directions, limit: f64, rows: &[Row]) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write_picture(&mut text, name, grid, directions, limit, rows);
    text
}

fn write_picture(
    text: &mut String,
    name: &str,
    grid: &Grid,
    directions: Directions,
    limit: f64,
    rows: &[Row],
) -> fmt::Result {
    let along = match directions {
        Directions::One(d) => format!("moving along ({}, {})", digits(d.x, 4), digits(d.y, 4)),
        Directions::Worst(count) => format!("in the worst of {count} directions"),
    };
    writeln!(text, "{}: critical speed in m/s, {along}\n", name.replace(char::is_control, " "))?;
    let critical: Vec<(f64, &Row)> =
        rows.iter().filter_map(|row| row.critical().map(|critical| (critical.speed, row))).collect();
    let speeds = critical.iter().map(|(speed, _)| *speed);
    // Of poses that mirror each other the first one is named.
    let lowest = first_lowest(speeds.clone()).map(|index| critical[index]);
    let highest =
        first_largest(speeds.clone(), TIE_OF_SPEEDS * speeds.fold(1.0, f64::max)).map(|index| critical[index]);
    let range = lowest.as_ref().zip(highest.as_ref()).map(|(low, high)| (low.0, high.0));
    let wide = grid.nx > WIDEST_TABLE;
    let cell = |row: &Row| match (&row.verdict, range) {
        (Verdict::Infeasible, _) => "·".into(),
        (Verdict::Unknown | Verdict::NotConverged, _) => "?".into(),
        (Verdict::Critical(critical), Some((low, high))) if wide => tenth(critical.speed, low, high).to_string(),
        (Verdict::Critical(critical), _) => format!("{:.2}", critical.speed),
        (Verdict::NoneUpTo(_), _) => "+".into(),
    };
    let width = if wide { 1 } else { 6 };
    for row in (0..grid.ny).rev() {
        let y = evenly(grid.low.y, grid.high.y, row, grid.ny);
        write!(text, "{:>8} ", format!("{y:.2}"))?;
        for row in &rows[row * grid.nx..(row + 1) * grid.nx] {
            write!(text, "{:>width$}", cell(row))?;
        }
        writeln!(text)?;
    }
    let x = |column| format!("{:.2}", evenly(grid.low.x, grid.high.x, column, grid.nx));
    if wide {
        let last = x(grid.nx - 1);
        let space = grid.nx.saturating_sub(last.len());
        writeln!(text, "{:>8} {:<space$}{last}  (x in m; y in m on the left)", "", x(0))?;
    } else {
        write!(text, "{:>8} ", "y, x (m)")?;
        for column in 0..grid.nx {
            write!(text, "{:>width$}", x(column))?;
        }
        writeln!(text)?;
    }
    writeln!(text)?;
    if let (true, Some((low, high))) = (wide, range) {
        writeln!(text, "0 to 9: tenths of the range from {} to {} m/s", digits(low, 4), digits(high, 4))?;
    }
    let number = |which: fn(&Verdict) -> bool| rows.iter().filter(|row| which(&row.verdict)).count();
    let feasible = number(|verdict| verdict.feasible() == Some(true));
    writeln!(text, "{feasible} of {} poses are feasible; · marks the others", rows.len())?;
    let failed = number(|verdict| verdict.status() == Status::Failed);
    if failed > 0 {
        writeln!(text, "{failed} could not be computed, marked ?")?;
    }
    for (what, extreme) in [("Lowest", lowest), ("Highest", highest)] {
        if let Some((row, critical)) = extreme.and_then(|(_, row)| Some((row, row.critical()?))) {
            let (x, y) = (digits(row.position.x, 4), digits(row.position.y, 4));
            writeln!(text, "{what}: {} at ({x}, {y}) m", critical_sentence(&critical))?;
        }
    }
    let none = number(|verdict| matches!(verdict, Verdict::NoneUpTo(_)));
    if none > 0 {
        writeln!(text, "None found up to {} m/s in {none} poses, marked +", digits(limit, 6))?;
    }
    writeln!(text, "\n{CAVEAT}")
}

/// In which tenth of a range a speed is, 0 to 9.
fn tenth(speed: f64, low: f64, high: f64) -> u8 {
    let passed = (1..10_u8).filter(|&tenths| speed > low + (high - low) * f64::from(tenths) / 10.0);
    u8::try_from(passed.count()).unwrap_or(9)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_words_or_vectors() {
        assert_eq!(direction("worst"), Ok(Directions::Worst(16)));
        assert_eq!(direction("-y"), Ok(Directions::One(Vec2::new(0.0, -1.0))));
        assert_eq!(direction("-3, 4e0"), Ok(Directions::One(Vec2::new(-3.0, 4.0))));
        for text in ["", "x", "0,0", "1", "1,2,3", "nan,1", "inf,1", "left"] {
            assert!(direction(text).is_err(), "{text}");
        }
    }

    #[test]
    fn tenths_span_the_range() {
        assert_eq!([1.0, 1.05, 1.11, 1.95, 2.0].map(|v| tenth(v, 1.0, 2.0)), [0, 0, 1, 9, 9]);
        assert_eq!(tenth(3.0, 3.0, 3.0), 0);
    }
}
