//! What can be saved: the scenario, the analysis, and the numbers of plots as tables.

use std::f64::consts::TAU;

use serde_json::Value;

use crate::app::Facts;
use crate::app::series::{self, degrees};
use crate::app::state::Plot;
use crate::app::studies::Known;
use crate::compute::protocol::{PlaceAnswer, StudyChoice, Topic, VerdictAnswer};
use crate::scenario::report::KindReport;
use crate::study::evenly;

/// Something to save.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// The scenario file.
    Scenario,
    /// The analysis, as `analyze --json` prints it.
    Analysis,
    /// The numbers of a plot.
    Plot(Plot),
    /// The numbers of the map.
    Map,
    /// A picture of the plot on show.
    PlotPicture,
    /// A picture of the canvas.
    CanvasPicture,
}

/// A table of numbers and words without commas, tabs and quotes.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn new(header: &[&str]) -> Self {
        Self { header: header.iter().map(ToString::to_string).collect(), rows: Vec::new() }
    }

    /// With commas, as RFC 4180 has it.
    pub fn csv(&self) -> String {
        self.joined(",", "\r\n")
    }

    /// With tabs, as spreadsheets take it from the clipboard.
    pub fn tsv(&self) -> String {
        self.joined("\t", "\n")
    }

    fn joined(&self, separator: &str, end: &str) -> String {
        std::iter::once(&self.header).chain(&self.rows).map(|row| row.join(separator) + end).collect()
    }
}

/// The columns of what is known of a pose and direction, as on the command line.
const VERDICT: [&str; 5] = ["feasible", "critical_speed", "frequency_hz", "kind", "cable"];

fn verdict(verdict: &VerdictAnswer) -> [String; 5] {
    let none = String::new;
    match verdict {
        VerdictAnswer::Critical(critical) => {
            let kind = match critical.kind {
                KindReport::Flutter => "flutter",
                KindReport::Divergence => "divergence",
            };
            let numbers = [critical.speed, critical.frequency_hz].map(|number| number.to_string());
            let [speed, frequency] = numbers;
            ["true".into(), speed, frequency, kind.into(), critical.cable.to_string()]
        }
        VerdictAnswer::Infeasible => ["false".into(), none(), none(), none(), none()],
        VerdictAnswer::NotConverged | VerdictAnswer::NoneUpTo(_) => ["true".into(), none(), none(), none(), none()],
    }
}

/// The numbers of a plot, where there are any.
pub fn plot(plot: Plot, facts: Facts<'_>) -> Option<Table> {
    let study = |topic| facts.studies.shown(topic).map(|shown| shown.known);
    match plot {
        Plot::Eigenvalues | Plot::Modes => modes(facts),
        Plot::Growth => {
            let (points, _) = facts.answers.curve()?;
            let mut table = Table::new(&["speed", "growth_rate"]);
            table.rows = points.iter().map(|point| point.map(|number| number.to_string()).to_vec()).collect();
            Some(table)
        }
        Plot::Line => study(Topic::Line).and_then(places),
        Plot::Directions => study(Topic::Polar).and_then(places),
        Plot::Campbell => study(Topic::Campbell).and_then(places),
        Plot::Mesh => study(Topic::Convergence).and_then(places),
        Plot::Knobs => knobs(facts),
    }
}

/// What the file of a plot's numbers is called, after the robot's name.
pub fn suffix(plot: Plot) -> &'static str {
    match plot {
        Plot::Eigenvalues | Plot::Modes => "-modes.csv",
        Plot::Growth => "-growth.csv",
        Plot::Line => "-line.csv",
        Plot::Directions => "-directions.csv",
        Plot::Campbell => "-campbell.csv",
        Plot::Mesh => "-mesh.csv",
        Plot::Knobs => "-knobs.csv",
    }
}

/// The numbers of the map, where there are any.
pub fn map(facts: Facts<'_>) -> Option<Table> {
    facts.studies.shown(Topic::Map).and_then(|shown| places(shown.known))
}

/// The table of modes.
fn modes(facts: Facts<'_>) -> Option<Table> {
    let pose = facts.answers.pose()?;
    let header = ["real", "imaginary", "multiplicity", "frequency_hz", "damping_ratio", "platform_share"];
    let mut table = Table::new(&header);
    table.header.extend((1..=pose.report.cables.len()).map(|cable| format!("cable_{cable}_share")));
    table.rows = pose
        .modes
        .iter()
        .map(|mode| {
            let [re, im] = mode.eigenvalue;
            let numbers = [mode.frequency_hz, mode.damping_ratio, mode.platform_share];
            let shares = numbers.iter().chain(&mode.cable_share).map(ToString::to_string);
            [re.to_string(), im.to_string(), mode.multiplicity.to_string()].into_iter().chain(shares).collect()
        })
        .collect();
    Some(table)
}

/// Relative derivatives of the critical speed and of its frequency.
fn knobs(facts: Facts<'_>) -> Option<Table> {
    let (found, _) = facts.answers.sensitivities()?;
    let mut table = Table::new(&["parameter", "critical_speed_percent_per_percent", "frequency_percent_per_percent"]);
    let text = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
    let rows = found.as_ref().ok()?.iter();
    table.rows = rows.map(|one| vec![one.knob.to_string(), one.speed.to_string(), text(one.frequency)]).collect();
    Some(table)
}

/// What is known of a study, place by place.
fn places(known: &Known) -> Option<Table> {
    let answered = || known.places.iter().enumerate().filter_map(|(i, answer)| Some((i, answer.as_ref()?)));
    let at: Box<dyn Fn(usize) -> Vec<String>>;
    let header: &[&str] = match &known.wish.study {
        StudyChoice::Line { .. } => {
            let line = known.wish.line()?;
            at = Box::new(move |i| line.position(i).iter().map(ToString::to_string).collect());
            &["x", "y"]
        }
        StudyChoice::Map { .. } => {
            let grid = known.wish.grid()?;
            at = Box::new(move |i| grid.position(i).iter().map(ToString::to_string).collect());
            &["x", "y"]
        }
        StudyChoice::Polar { .. } => {
            let directions: Vec<f64> = series::directions(known).iter().map(|(d, _)| degrees(*d)).collect();
            at = Box::new(move |i| directions.get(i).map(ToString::to_string).into_iter().collect());
            &["direction_degrees"]
        }
        StudyChoice::Campbell { to, count } => {
            let (to, count) = (*to, *count);
            at = Box::new(move |i| vec![evenly(0.0, to, i, count).to_string()]);
            &["speed"]
        }
        StudyChoice::Convergence { counts, .. } => {
            let counts = counts.clone();
            at = Box::new(move |i| counts.get(i).map(ToString::to_string).into_iter().collect());
            &["elements_per_cable"]
        }
    };
    let values: &[&str] = match answered().next()?.1 {
        PlaceAnswer::Critical { .. } => &VERDICT,
        PlaceAnswer::Growth(_) => &["growth_rate"],
        PlaceAnswer::Spectrum(_) => &["growth_rate", "frequency_hz"],
    };
    let mut table = Table::new(&[header, values].concat());
    for (i, answer) in answered() {
        let row = |values: &[String]| [at(i).as_slice(), values].concat();
        match answer {
            PlaceAnswer::Critical { verdict: of, .. } => table.rows.push(row(&verdict(of))),
            PlaceAnswer::Growth(rate) => {
                table.rows.push(row(&[rate.map_or_else(String::new, |rate| rate.to_string())]));
            }
            PlaceAnswer::Spectrum(eigenvalues) => {
                let rows = eigenvalues.iter().flatten();
                table.rows.extend(rows.map(|[re, im]| row(&[re.to_string(), (im / TAU).to_string()])));
            }
        }
    }
    Some(table)
}

/// The analysis as JSON, where it is complete and belongs to the document as it is.
pub fn analysis(facts: Facts<'_>) -> Option<String> {
    let (report, _, current) = facts.answers.complete()?;
    let value: Value = serde_json::to_value(report).ok()?;
    current.then(|| serde_json::to_string_pretty(&value).ok()).flatten()
}
