//! `tautline sweep`: the critical speed for every combination of some of the scenario's numbers.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::cli::output::{CommandResult, Output};
use crate::cli::rows::{COLUMNS, Form, Options, Row, Rows, exact};
use crate::cli::streams::read_scenario;
use crate::cli::text::digits;
use crate::robot::{Faults, Vec2};
use crate::scenario::{Parameter, Scenario};
use crate::study::{Verdict, evenly, verdict};

/// The most rows of a sweep.
const MOST_ROWS: usize = 10_000_000;
/// How the numbers of the scenario's path begin.
const OF_PATH: &str = "path.";

/// Critical speed and frequency for every combination of some of the scenario's numbers.
///
/// One row per combination, the last number fastest.
#[derive(Debug, clap::Args)]
#[command(after_help = AFTER_HELP)]
pub(super) struct Args {
    /// The scenario file (JSON); - reads standard input.
    file: Option<PathBuf>,
    /// Vary a number of the scenario file in COUNT equal steps from START to STOP, both included, such as
    /// platform.mass=1:4:7, motion.position[0]=-5:5:11 or cables[2].tension.constant=40:80:5; again for more of them.
    #[arg(long, value_name = "PATH=START:STOP:COUNT", required = true, num_args = 1..)]
    set: Vec<String>,
    /// Print the I-th of N parts of the rows.
    #[arg(long, value_name = "I/N", value_parser = shard, default_value = "1/1", allow_hyphen_values = true)]
    shard: Shard,
    #[command(flatten)]
    options: Options,
}

const AFTER_HELP: &str = "\
CSV columns: one per swept number, named by its path, then
x,y,feasible,critical_speed,frequency_hz,kind,cable,wave_limit,status (see `tautline map --help`)
SI units, cables counted from 1, empty where there is none.

Each shard prints the line with the names of the columns. To join them:
  awk 'FNR > 1 || NR == 1' part-*.csv > all.csv
docs/cluster.md shows how to spread shards over many machines.";

/// One of the equal parts of a sweep.
#[derive(Clone, Copy, Debug)]
struct Shard {
    /// 0-based.
    index: usize,
    of: usize,
}

impl Shard {
    /// Which of `count` rows are its own: parts follow each other and differ by at most one row.
    fn rows(self, count: usize) -> Range<usize> {
        // Both factors may be large; the quotient is at most `count`.
        let start = |index: usize| (count as u128 * index as u128 / self.of as u128).try_into().unwrap_or(count);
        start(self.index)..start(self.index + 1)
    }
}

fn shard(text: &str) -> Result<Shard, String> {
    let whole = |text: &str| text.parse::<usize>().ok();
    let parts = text.split_once('/').and_then(|(index, of)| Some((whole(index)?, whole(of)?)));
    let parts = parts.filter(|&(index, of)| (1..=of).contains(&index));
    parts
        .map(|(index, of)| Shard { index: index - 1, of })
        .ok_or_else(|| "allowed: I/N, two whole numbers with I from 1 to N".into())
}

/// One of the scenario's numbers and the values it takes.
#[derive(Clone, Debug, PartialEq)]
struct Axis {
    /// As given, such as `cables[3].tension.constant`.
    path: String,
    /// The same as a JSON pointer, such as `/cables/3/tension/constant`.
    pointer: String,
    start: f64,
    stop: f64,
    count: usize,
}

impl Axis {
    /// Reads PATH=START:STOP:COUNT.
    fn new(text: &str) -> Result<Self, String> {
        let fault = |what: &str| format!("tautline: --set {text}: {what}");
        let form = "is not of the form PATH=START:STOP:COUNT, such as platform.mass=1:4:7";
        let (path, range) = text.split_once('=').ok_or_else(|| fault(form))?;
        let [start, stop, count] = range.split(':').collect::<Vec<_>>()[..] else { return Err(fault(form)) };
        let number = |name: &str, text: &str| {
            let number = text.parse().ok().filter(|number: &f64| number.is_finite());
            number.ok_or_else(|| fault(&format!("{name} is {text:?}; allowed: a finite number")))
        };
        let (start, stop) = (number("START", start)?, number("STOP", stop)?);
        let allowed = format!("COUNT is {count:?}; allowed: a whole number from 1 to {MOST_ROWS}");
        let count =
            count.parse().ok().filter(|count| (1..=MOST_ROWS).contains(count)).ok_or_else(|| fault(&allowed))?;
        Ok(Self { path: path.into(), pointer: pointer(path), start, stop, count })
    }

    fn value(&self, index: usize) -> f64 {
        // A single value is the first, not the middle.
        if self.count == 1 { self.start } else { evenly(self.start, self.stop, index, self.count) }
    }
}

/// `cables[3].tension` as `/cables/3/tension`. What is not a path becomes a pointer to nothing.
fn pointer(path: &str) -> String {
    let mut pointer = String::from("/");
    for c in path.chars() {
        match c {
            '.' | '[' => pointer.push('/'),
            ']' => {}
            '~' => pointer += "~0",
            '/' => pointer += "~1",
            c => pointer.push(c),
        }
    }
    pointer
}

/// All combinations of the values of some of a scenario's numbers.
#[derive(Debug)]
struct Sweep {
    /// The scenario with all its fields.
    file: Value,
    axes: Vec<Axis>,
    count: usize,
}

impl Sweep {
    fn new(scenario: &Scenario, sets: &[String]) -> Result<Self, Vec<String>> {
        let mut file = serde_json::to_value(scenario).map_err(|error| vec![error.to_string()])?;
        let mut paths: Vec<String> = Parameter::all(scenario).into_iter().map(Parameter::path).collect();
        paths.sort();
        let (mut axes, mut faults) = (Vec::<Axis>::new(), Vec::new());
        for set in sets {
            match Axis::new(set) {
                Err(fault) => faults.push(fault),
                Ok(Axis { path, .. }) if !paths.contains(&path) => faults.push(match file.pointer(&pointer(&path)) {
                    Some(other) if !other.is_number() => {
                        format!("tautline: --set {path}: only a number can be swept, not {other}")
                    }
                    _ => {
                        format!("tautline: --set {path}: no such number; the scenario has {}", paths.join(", "))
                    }
                }),
                Ok(Axis { path, .. }) if axes.iter().any(|axis| axis.path == path) => {
                    faults.push(format!("tautline: --set {path}: is given twice; allowed: each path once"));
                }
                Ok(axis) => axes.push(axis),
            }
        }
        // No critical speed depends on the path. One that is not swept must not forbid a position, such as that of its end.
        if !axes.iter().any(|axis| axis.path.starts_with(OF_PATH))
            && let Some(fields) = file.as_object_mut()
        {
            fields.remove("path");
        }
        let count = axes.iter().try_fold(1_usize, |count, axis| count.checked_mul(axis.count));
        match count.filter(|count| *count <= MOST_ROWS) {
            Some(count) if faults.is_empty() => Ok(Self { file, axes, count }),
            None if faults.is_empty() => {
                Err(vec![format!("tautline: --set: too many combinations; allowed: at most {MOST_ROWS} rows")])
            }
            _ => Err(faults),
        }
    }

    /// The scenario with these values of these numbers, read like any scenario file.
    fn scenario<'a>(&self, values: impl Iterator<Item = (&'a Axis, f64)>) -> Result<Scenario, Faults> {
        let mut file = self.file.clone();
        for (axis, value) in values {
            if let Some(place) = file.pointer_mut(&axis.pointer) {
                *place = value.into();
            }
        }
        Scenario::from_json(&file.to_string())
    }

    /// Whether everything asked for is physical: of each field at fault the first fault.
    ///
    /// A shard of a large sweep must not take long to look at the rows of all others, yet refuse what they refuse: of
    /// these it looks at every value, and at combinations of those numbers that can be at fault together.
    fn check(&self, rows: Range<usize>) -> Result<(), Vec<String>> {
        let mut faults = BTreeMap::new();
        let mut check = |axes: &[&Axis], values: &[f64]| {
            let values = || axes.iter().copied().zip(values.iter().copied());
            for fault in self.scenario(values()).err().map(Faults::into_list).into_iter().flatten() {
                faults.entry(fault.path.clone()).or_insert_with(|| {
                    let own = values().any(|(axis, _)| axis.path == fault.path);
                    let place: Vec<String> =
                        values().map(|(axis, value)| format!("{} = {}", axis.path, exact(value))).collect();
                    let place = if own { String::new() } else { format!(", where {}", place.join(", ")) };
                    format!("tautline: --set: {fault}{place}")
                });
            }
        };
        let with_path = self.file.get("path").is_some();
        let coupled = |axis: &Axis| coupled(axis, with_path);
        let mut groups: Vec<Vec<&Axis>> = Vec::new();
        for axis in &self.axes {
            let together =
                groups.iter_mut().find(|group| coupled(group[0]).is_some_and(|_| coupled(group[0]) == coupled(axis)));
            match together {
                Some(group) => group.push(axis),
                None => groups.push(vec![axis]),
            }
        }
        for group in groups {
            for index in 0..group.iter().map(|axis| axis.count).product() {
                check(&group, &values(&group, index));
            }
        }
        let axes: Vec<&Axis> = self.axes.iter().collect();
        for index in rows {
            check(&axes, &values(&axes, index));
        }
        if faults.is_empty() { Ok(()) } else { Err(faults.into_values().collect()) }
    }

    fn row(&self, index: usize, limit: f64) -> Row {
        let axes: Vec<&Axis> = self.axes.iter().collect();
        let values = values(&axes, index);
        // Every row has been checked.
        let read = self.scenario(axes.into_iter().zip(values.iter().copied())).and_then(|scenario| scenario.to_robot());
        match read {
            Ok((robot, motion)) => {
                let (verdict, wave_limit) = verdict(&robot, &motion, limit);
                Row { swept: values, position: motion.position(), verdict, wave_limit }
            }
            Err(_) => Row { swept: values, position: Vec2::zeros(), verdict: Verdict::Unknown, wave_limit: None },
        }
    }
}

/// The values of the `index`-th combination, the last number fastest.
fn values(axes: &[&Axis], mut index: usize) -> Vec<f64> {
    let mut values = Vec::with_capacity(axes.len());
    for axis in axes.iter().rev() {
        values.push(axis.value(index % axis.count));
        index /= axis.count;
    }
    values.reverse();
    values
}

/// Which other numbers this one can be at fault together with: anchors that coincide, a direction of zero length,
/// products beyond the range of numbers; and `with_path`, points that coincide, a move that takes too long.
fn coupled(axis: &Axis, with_path: bool) -> Option<&'static str> {
    match axis.path.as_str() {
        path if path.contains(".anchor[") => Some("anchors"),
        path if path.contains("].cable.") => Some("products"),
        path if path.starts_with("motion.direction") => Some("direction"),
        path if path.starts_with(OF_PATH) || (with_path && path.starts_with("motion.position")) => Some("path"),
        "cable.youngs_modulus" | "cable.area" | "cable.mass_per_length" | "platform.mass" | "gravity" => {
            Some("products")
        }
        _ => None,
    }
}

/// The scenario file among what was given: `--set` takes all that follows it, a file's name too.
fn file<'a>(file: Option<&'a Path>, set: &'a [String]) -> Result<(&'a Path, Vec<String>), Vec<String>> {
    let (sets, files): (Vec<&String>, Vec<&String>) = set.iter().partition(|text| text.contains('='));
    match (file, &files[..]) {
        (Some(file), _) => Ok((file, set.to_vec())),
        (None, [file]) => Ok((Path::new(*file), sets.into_iter().cloned().collect())),
        (None, _) => Err(vec!["tautline: sweep: the scenario FILE is missing".into()]),
    }
}

pub(super) fn run(args: &Args, input: &mut dyn Read) -> CommandResult {
    let (file, sets) = file(args.file.as_deref(), &args.set)?;
    let scenario = read_scenario(file, input)?;
    let sweep = Sweep::new(&scenario, &sets)?;
    let (rows, limit) = (args.shard.rows(sweep.count), args.options.max_speed);
    sweep.check(rows.clone())?;
    let paths: Vec<String> = sweep.axes.iter().map(|axis| axis.path.clone()).collect();
    let form = if args.options.csv {
        Form::Csv { header: format!("{},{COLUMNS}", paths.join(",")) }
    } else {
        Form::Text(Box::new(move |rows| table(&paths, limit, rows)))
    };
    let count = rows.len();
    let row = move |index| sweep.row(rows.start + index, limit);
    Ok(Output::Rows(Rows { count, row: Box::new(row), form, threads: args.options.threads() }))
}

/// The rows in columns for people.
fn table(paths: &[String], limit: f64, rows: &[Row]) -> String {
    let widths: Vec<usize> = paths.iter().map(|path| path.len().max(10)).collect();
    let mut text = String::new();
    // Writing to a string does not fail.
    for (path, width) in paths.iter().zip(&widths) {
        let _ = write!(text, "{path:>width$}  ");
    }
    text += "critical speed\n";
    for row in rows {
        for (value, width) in row.swept.iter().zip(&widths) {
            let _ = write!(text, "{:>width$}  ", digits(*value, 6));
        }
        let _ = match (&row.verdict, row.critical()) {
            (_, Some(critical)) => {
                let frequency = format!("{} at {} Hz", critical.kind, digits(critical.frequency_hz, 4));
                writeln!(text, "{:>8} m/s, {frequency}, cable {}", digits(critical.speed, 5), critical.cable)
            }
            (Verdict::Infeasible, _) => writeln!(text, "not feasible"),
            (Verdict::NoneUpTo(_), _) => writeln!(text, "none found up to {} m/s", digits(limit, 6)),
            (Verdict::Unknown | Verdict::NotConverged | Verdict::Critical(_), _) => writeln!(text, "not known"),
        };
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_all_rows_once() {
        for (count, of) in [(10, 3), (2, 5), (0, 2), (7, 7), (10_000_000, 999)] {
            let mut next = 0;
            for index in 0..of {
                let rows = Shard { index, of }.rows(count);
                assert_eq!(rows.start, next);
                assert!(rows.len().abs_diff(count / of) <= 1);
                next = rows.end;
            }
            assert_eq!(next, count);
        }
        assert!(shard("2/3").is_ok_and(|shard| (shard.index, shard.of) == (1, 3)));
        for text in ["", "1", "0/3", "4/3", "0/0", "-1/3", "1/3/5", "a/b", "1.0/2"] {
            assert!(shard(text).is_err(), "{text}");
        }
    }

    #[test]
    fn axes_are_read_strictly() {
        let axis = Axis::new("cables[3].tension.constant=-1:2.5e1:4").expect("an axis");
        assert_eq!((axis.pointer.as_str(), axis.count), ("/cables/3/tension/constant", 4));
        assert_eq!((axis.value(0), axis.value(3)), (-1.0, 25.0));
        assert_eq!(Axis::new("gravity=3:9:1").map(|axis| axis.value(0)), Ok(3.0));
        for text in [
            "gravity",
            "gravity=1:2",
            "gravity=1:2:3:4",
            "gravity=a:2:3",
            "gravity=1:inf:3",
            "gravity=1:2:0",
            "gravity=1:2:1.5",
            "gravity=1:2:-1",
            "=",
            "gravity=::",
        ] {
            assert!(Axis::new(text).is_err(), "{text}");
        }
    }
}
