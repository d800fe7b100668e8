//! What can be saved: the scenario, the analysis, and the numbers of plots as tables.

mod moves;
mod table;

use std::f64::consts::TAU;

use eframe::egui::Id;
use serde_json::Value;

use crate::app::comparison::Comparison;
use crate::app::facts::Facts;
use crate::app::picture::Format;
use crate::app::series::{self, degrees};
use crate::app::state::Plot;
use crate::app::studies::StudyResults;
use crate::compute::protocol::{Extent, Topic};
use crate::scenario::report::parameter;
use crate::study::{Answer, Study, evenly};

pub use table::Table;
use table::{VERDICT, cell, status, verdict};

/// Something to save.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Content {
    /// The scenario file.
    Scenario,
    /// The analysis, as `analyze --json` prints it.
    Analysis,
    /// The numbers of a plot.
    Plot(Plot),
    /// The numbers of the map.
    Map,
    /// The fastest move along the path, as the command line writes it.
    Fastest,
    /// A picture of a plot: the part of it that the chart of this name shows.
    PlotPicture(Plot, Id, Format),
    /// A picture of the canvas.
    CanvasPicture(Format),
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
        Plot::Directions => study(Topic::Directions).and_then(places),
        Plot::Campbell => study(Topic::Campbell).and_then(places),
        Plot::Mesh => study(Topic::Mesh).and_then(places),
        Plot::Sensitivities => sensitivities(facts),
        Plot::WhatIf => study(Topic::WhatIf).and_then(places),
        Plot::Path => study(Topic::Path).and_then(|known| moves::stations(known, facts)),
        Plot::Gain => study(Topic::Gains).and_then(moves::gains),
        Plot::Deviation | Plot::Tensions => study(Topic::Flight).and_then(moves::flight),
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
        Plot::Sensitivities => "-sensitivities.csv",
        Plot::WhatIf => "-what-if.csv",
        Plot::Path => "-path.csv",
        Plot::Gain => "-gain.csv",
        Plot::Deviation | Plot::Tensions => "-flight.csv",
    }
}

/// The numbers of the map, where there are any.
pub fn map(facts: Facts<'_>) -> Option<Table> {
    facts.studies.shown(Topic::Map).and_then(|shown| places(shown.known))
}

/// The fastest move along the path, where there is one.
pub fn fastest(facts: Facts<'_>) -> Option<Table> {
    moves::fastest(facts)
}

/// What differs between the designs, in the units of the screen.
pub fn designs(facts: Facts<'_>) -> Table {
    let Comparison { columns, answers, differences } = Comparison::of(facts);
    let mut table = Table::new(&[""]);
    table.header.extend(columns.into_iter().map(ToOwned::to_owned));
    let rows = answers.into_iter().chain(differences);
    table.rows = rows.map(|row| std::iter::once(row.name).chain(row.cells).collect()).collect();
    table
}

/// The table of modes.
fn modes(facts: Facts<'_>) -> Option<Table> {
    let pose = facts.answers.pose().filter(|pose| pose.extent != Extent::SlowestSoFar)?;
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
fn sensitivities(facts: Facts<'_>) -> Option<Table> {
    let (found, _) = facts.answers.sensitivities()?;
    let mut table = Table::new(&[
        "parameter",
        "critical_speed_percent_per_percent",
        "frequency_percent_per_percent",
        "wave_limit_percent_per_percent",
    ]);
    let rows = found.as_ref().ok()?.iter();
    table.rows = rows
        .map(|one| vec![parameter(one.knob), one.speed.to_string(), cell(one.frequency), cell(one.wave_limit)])
        .collect();
    Some(table)
}

/// What is known of a study, place by place.
fn places(known: &StudyResults) -> Option<Table> {
    let answered = || known.places.iter().enumerate().filter_map(|(i, answer)| Some((i, answer.as_ref()?)));
    let at: Box<dyn Fn(usize) -> Vec<String> + '_>;
    let paths: Vec<&str>;
    let header: &[&str] = match &known.request.study {
        Study::Line { line, .. } => {
            at = Box::new(move |i| line.position(i).iter().map(ToString::to_string).collect());
            &["x", "y"]
        }
        Study::Map { grid, .. } => {
            at = Box::new(move |i| grid.position(i).iter().map(ToString::to_string).collect());
            &["x", "y"]
        }
        Study::Directions { .. } => {
            let directions: Vec<f64> = series::directions(known).iter().map(|(d, _)| degrees(*d)).collect();
            at = Box::new(move |i| directions.get(i).map(ToString::to_string).into_iter().collect());
            &["direction_degrees"]
        }
        Study::Campbell { to, count, .. } => {
            let (to, count) = (*to, *count);
            at = Box::new(move |i| vec![evenly(0.0, to, i, count).to_string()]);
            &["speed"]
        }
        Study::Mesh { counts, .. } => {
            at = Box::new(move |i| counts.get(i).map(ToString::to_string).into_iter().collect());
            &["elements_per_cable"]
        }
        Study::WhatIf(what_if) => {
            at = Box::new(|i| what_if.values(i).iter().map(ToString::to_string).collect());
            paths = what_if.numbers.iter().map(|number| number.path.as_str()).collect();
            &paths
        }
        _ => return None,
    };
    let values: &[&str] = match answered().next()?.1 {
        Answer::Critical { .. } => &VERDICT,
        Answer::Growth(_) => &["growth_rate", "status"],
        Answer::Spectrum(_) => &["growth_rate", "frequency_hz", "status"],
        _ => return None,
    };
    let mut table = Table::new(&[header, values].concat());
    for (i, answer) in answered() {
        let row = |values: &[String]| [at(i).as_slice(), values].concat();
        match answer {
            Answer::Critical { verdict: of, wave_limit, .. } => table.rows.push(row(&verdict(of, *wave_limit))),
            Answer::Growth(rate) => table.rows.push(row(&[cell(rate.ok()), status(rate)])),
            Answer::Spectrum(eigenvalues) => {
                let found = eigenvalues.iter().flatten();
                let found =
                    found.map(|value| row(&[value.re.to_string(), (value.im / TAU).to_string(), status(eigenvalues)]));
                table.rows.extend(found);
                // Where there is none, that is a row too.
                if eigenvalues.is_err() {
                    table.rows.push(row(&[String::new(), String::new(), status(eigenvalues)]));
                }
            }
            _ => {}
        }
    }
    Some(table)
}

/// The analysis as JSON, where it is complete and belongs to the document as it is.
pub fn analysis(facts: Facts<'_>) -> Option<String> {
    let (report, _, current) = facts.answers.last_complete()?;
    let value: Value = serde_json::to_value(report).ok()?;
    current.then(|| serde_json::to_string_pretty(&value).ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::studies::StudyRequest;
    use crate::robot::Vec2;
    use crate::scenario::presets;
    use crate::stability::{Critical, Instability};
    use crate::study::{Directions, Grid, Mapped, NoEigenvalues, Varied, Verdict, WhatIf};
    use nalgebra::Complex;

    fn table(study: Study, answers: Vec<Answer>) -> String {
        let request = StudyRequest::new(&presets::PRESETS[0].scenario(), study);
        let known = StudyResults { places: answers.into_iter().map(Some).collect(), request, version: (1, 1) };
        places(&known).expect("a table").csv()
    }

    fn lines(csv: &str) -> Vec<&str> {
        csv.lines().map(|line| line.trim_end_matches('\r')).collect()
    }

    /// As on the command line: none up to the limit, no equilibrium, and what could not be computed are told apart.
    #[test]
    fn tables_say_whether_something_was_found_and_why_not() {
        let (position, direction) = (Vec2::zeros(), Vec2::x());
        let eigenvalue = Complex::new(0.0, 1.25 * TAU);
        let critical = Critical { speed: 9.5, eigenvalue, kind: Instability::Flutter, cable: 3 };
        let answer = |verdict, wave_limit| Answer::Critical { direction, verdict, wave_limit };
        let counts = vec![4, 6, 8, 10, 12];
        let csv = table(
            Study::Mesh { position, direction, counts, limit: 40.0 },
            vec![
                answer(Verdict::Critical(critical), Some(11.5)),
                answer(Verdict::NoneUpTo(40.0), Some(50.5)),
                answer(Verdict::NotConverged, Some(12.5)),
                answer(Verdict::Infeasible, None),
                answer(Verdict::Unknown, None),
            ],
        );
        assert_eq!(
            lines(&csv),
            [
                "elements_per_cable,feasible,critical_speed,frequency_hz,kind,cable,wave_limit,status",
                "4,true,9.5,1.25,flutter,4,11.5,found",
                "6,true,,,,,50.5,none",
                "8,true,,,,,12.5,failed",
                "10,false,,,,,,infeasible",
                "12,,,,,,,failed",
            ]
        );
        let grid = Grid { low: Vec2::zeros(), high: Vec2::new(2.0, 1.0), nx: 3, ny: 1 };
        let mapped = Mapped::Growth { speed: 5.0 };
        let growth = Study::Map { grid, directions: Directions::One(direction), mapped };
        let missing = [Err(NoEigenvalues::Infeasible), Err(NoEigenvalues::Failed)];
        let rates = [Ok(-0.25)].into_iter().chain(missing).map(Answer::Growth).collect();
        let csv = table(growth, rates);
        assert_eq!(lines(&csv)[0], "x,y,growth_rate,status");
        let ends: Vec<&str> = lines(&csv)[1..].iter().filter_map(|line| line.splitn(3, ',').nth(2)).collect();
        assert_eq!(ends, ["-0.25,found", ",infeasible", ",failed"]);
        let spectra =
            vec![Answer::Spectrum(Ok(vec![Complex::new(-1.0, TAU)])), Answer::Spectrum(Err(NoEigenvalues::Failed))];
        let number = |path: &str, values: &[f64]| Varied { path: path.into(), values: values.to_vec() };
        let numbers = vec![number("gravity", &[0.0, 9.81]), number("cables[2].tension.constant", &[50.0])];
        let verdicts = [Verdict::NoneUpTo(40.0), Verdict::Infeasible];
        let answers = verdicts.map(|verdict| answer(verdict, None)).to_vec();
        let csv = table(Study::WhatIf(WhatIf { numbers, limit: 40.0 }), answers);
        let header =
            "gravity,cables[2].tension.constant,feasible,critical_speed,frequency_hz,kind,cable,wave_limit,status";
        assert_eq!(lines(&csv), [header, "0,50,true,,,,,,none", "9.81,50,false,,,,,,infeasible"]);
        let csv = table(Study::Campbell { position, direction, to: 2.0, count: 2 }, spectra);
        assert_eq!(lines(&csv), ["speed,growth_rate,frequency_hz,status", "0,-1,1,found", "2,,,failed"]);
    }
}
