//! Tables of what is known along a path: stations, gains, flights.

use super::table::{Table, VERDICT, cell, verdict};
use crate::app::facts::Facts;
use crate::app::series::{self, Gains, Stations, Way};
use crate::app::studies::StudyResults;
use crate::study::Answer;

/// The limits along the path, station by station, with the speed flown there.
pub fn stations(known: &StudyResults, facts: Facts<'_>) -> Option<Table> {
    let stations = Stations::new(known)?;
    let first = stations.all.first()?;
    let trajectory = facts.document.scenario.trajectory()?;
    let way = Way::new(&trajectory);
    let mut table = Table::new(&[&["s", "x", "y", "speed"], &VERDICT[..]].concat());
    for i in 1..=first.rates.len() {
        table.header.extend([format!("length_rate_{i}"), format!("length_curvature_{i}")]);
    }
    for station in &stations.all {
        let place = [station.s, station.position.x, station.position.y, way.speed_at(station.s)];
        let limits = verdict(&station.verdict, station.wave_limit.map(|limit| limit.speed));
        let rates = station.rates.iter().flatten().map(ToString::to_string);
        table.rows.push(place.iter().map(ToString::to_string).chain(limits).chain(rates).collect());
    }
    Some(table)
}

/// What the move does to vibrations, by its peak speed.
pub fn gains(known: &StudyResults) -> Option<Table> {
    let gains = Gains::new(known)?;
    let mut table = Table::new(&["peak_speed", "gain", "frozen_growth", "wave_ratio"]);
    let row = |point: &crate::app::series::GainPoint| {
        vec![point.speed.to_string(), cell(point.gain), cell(point.frozen), cell(point.ratio)]
    };
    table.rows = gains.points.iter().map(row).collect();
    (!table.rows.is_empty()).then_some(table)
}

/// The fastest move, row by row, with the columns that the command line has.
pub fn fastest(facts: Facts<'_>) -> Option<Table> {
    let (Ok(fastest), true) = series::fastest(facts)? else { return None };
    let mut table = Table::new(&["t", "s", "x", "y", "v", "a"]);
    let rows = &fastest.found.rows;
    table.header.extend(of_cables(rows.first()?.cables.len()));
    for row in rows {
        let motion = [row.time, row.s, row.position.x, row.position.y, row.v, row.a];
        let cables = row.cables.iter().flat_map(|cable| {
            [cable.length, cable.rate, cable.acceleration, cable.tension_at_platform, cable.tension_at_winch]
        });
        table.rows.push(motion.into_iter().chain(cables).map(|number| number.to_string()).collect());
    }
    Some(table)
}

/// The columns of all cables.
fn of_cables(count: usize) -> impl Iterator<Item = String> {
    let names = ["length", "rate", "acceleration", "tension", "winch_tension"];
    (1..=count).flat_map(move |i| names.map(|name| format!("{name}_{i}")))
}

/// A flight, sample by sample, with the columns that the command line has.
pub fn flight(known: &StudyResults) -> Option<Table> {
    let Some(Answer::Flight(flight)) = known.places.first()?.as_ref() else { return None };
    let flight = &flight.as_ref().as_ref().ok()?.flight;
    let mut table = Table::new(&["t", "s", "x", "y", "v", "a", "dx", "dy"]);
    table.header.extend(of_cables(flight.samples.first()?.cables.len()));
    for sample in &flight.samples {
        let [x, y]: [f64; 2] = sample.position.into();
        let [dx, dy]: [f64; 2] = sample.deviation.into();
        let motion = [sample.time, sample.s, x, y, sample.v, sample.a, dx, dy];
        let cables = sample
            .cables
            .iter()
            .flat_map(|cable| [cable.length, cable.rate, cable.acceleration, cable.tension, cable.winch_tension]);
        table.rows.push(motion.into_iter().chain(cables).map(|number| number.to_string()).collect());
    }
    Some(table)
}
