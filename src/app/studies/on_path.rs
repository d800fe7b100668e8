//! The studies of the path, with the scenario that they depend on.

use crate::app::limits::{Below, LimitsAsked};
use crate::app::state::Plot;
use crate::app::studies::{Studies, StudyRequest};
use crate::compute::protocol::Topic;
use crate::flight::LimitOptions;
use crate::scenario::Scenario;
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::study::{Allowed, Answer, Study};

/// Stations of a path.
const STATIONS: usize = 161;
/// Peak speeds of the gains.
const SPEEDS: u8 = 16;
/// How far beyond the wave limit the gains are looked at.
const BEYOND: f64 = 1.25;

/// The studies of a path, its flight apart, that are wanted with these plots on show, and with the fastest move where `limits` are asked for it.
/// The wave limit of a move decides how far its gains are looked at, and frozen critical speeds are limits: `studies` may
/// know them.
pub fn on_path(
    scenario: &Scenario,
    plots: &[Plot],
    limits: Option<&LimitsAsked>,
    studies: &Studies,
) -> Vec<StudyRequest> {
    let Some(path) = scenario.path.as_ref().filter(|_| scenario.to_robot().is_ok()) else { return Vec::new() };
    // The canvas colours the path by them, and the answer tells what the move does.
    let mut requests = vec![
        StudyRequest::new(scenario, Study::Path { count: STATIONS, limit: DEFAULT_MAX_SPEED }),
        StudyRequest::new(scenario, Study::Move),
    ];
    if plots.contains(&Plot::Gain)
        && let Some(ratio) = wave_ratio(studies)
    {
        let speeds = peak_speeds(path.speed / ratio);
        requests.push(StudyRequest::new(scenario, Study::Gains { speeds }));
    }
    requests.extend(limits.and_then(|asked| allowed(scenario, asked, studies)));
    requests
}

/// The fastest move, once all is known that it depends on.
fn allowed(scenario: &Scenario, asked: &LimitsAsked, studies: &Studies) -> Option<StudyRequest> {
    let LimitsAsked { safety, below, acceleration, winch_speed, winch_acceleration, slack } = *asked;
    let (waves, frozen) = (below != Below::Frozen, below != Below::Waves);
    let options = LimitOptions { safety, frozen, waves, slack, acceleration, winch_speed, winch_acceleration };
    let frozen = if frozen { critical_speeds(studies)? } else { Vec::new() };
    let allowed = Allowed { options, frozen };
    Some(StudyRequest::new(scenario, Study::Allowed(allowed)))
}

/// The frozen critical speeds along the present path, once all of them are known.
fn critical_speeds(studies: &Studies) -> Option<Vec<(f64, Option<f64>)>> {
    let shown = studies.shown(Topic::Path).filter(|shown| shown.current && shown.known.is_complete())?;
    let speed = |answer: &Option<Answer>| match answer {
        Some(Answer::Station(Some(station))) => {
            Some((station.s, station.verdict.critical().map(|critical| critical.speed)))
        }
        _ => None,
    };
    Some(shown.known.places.iter().filter_map(speed).collect())
}

/// How near the move comes to the wave limit, where that is known of the present one.
fn wave_ratio(studies: &Studies) -> Option<f64> {
    let shown = studies.shown(Topic::Move).filter(|shown| shown.current)?;
    match shown.known.places.first()? {
        Some(Answer::Move(Ok(effect))) => effect.wave_ratio.map(|ratio| ratio.value).filter(|ratio| *ratio > 0.0),
        _ => None,
    }
}

/// Peak speeds up to beyond the one at which the wave limit is reached (m/s), the same for limits that differ little.
fn peak_speeds(limit: f64) -> Vec<f64> {
    let unit = 10.0_f64.powf((BEYOND * limit).log10().floor() - 1.0);
    // So round that they do not change with every digit of the limit.
    let highest = 5.0 * unit * (BEYOND * limit / (5.0 * unit)).ceil();
    (1..=SPEEDS).map(|i| highest * f64::from(i) / f64::from(SPEEDS)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peak_speeds_go_beyond_the_wave_limit_and_are_round() {
        for (limit, highest) in [(11.87, 15.0), (11.9, 15.0), (3.3, 4.5), (0.72, 0.9), (120.0, 150.0)] {
            let speeds = peak_speeds(limit);
            assert_eq!(speeds.len(), 16);
            let last = speeds.last().copied().unwrap_or_default();
            assert!((last / highest - 1.0).abs() < 1e-12 && last > limit, "{limit}: {last}");
            assert!(speeds.is_sorted() && speeds[0] > 0.0);
        }
    }
}
