//! The gain of a move at several peak speeds, as points and sentences.

use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::series::runs;
use crate::app::studies::StudyResults;
use crate::compute::protocol::Topic;
use crate::study::{Answer, Fastest, MoveEffect, Study};

/// What is known at one peak speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GainPoint {
    /// In m/s.
    pub speed: f64,
    /// The largest amplitude ratio by the action.
    pub gain: Option<f64>,
    /// exp ∫ max Re λ dt.
    pub frozen: Option<f64>,
    /// The largest of speed over wave limit.
    pub ratio: Option<f64>,
}

/// The same at several.
#[derive(Clone, Debug, PartialEq)]
pub struct Gains {
    /// In rising order of speed; what is not known yet is left out.
    pub points: Vec<GainPoint>,
    highest: f64,
}

impl Gains {
    /// Those of `known`, where it is about gains.
    pub fn new(known: &StudyResults) -> Option<Self> {
        let Study::Gains { speeds } = &known.request.study else { return None };
        let point = |(speed, answer): (&f64, &Option<Answer>)| match answer {
            Some(Answer::Move(Ok(effect))) => Some(GainPoint {
                speed: *speed,
                gain: effect.gain.map(|gain| gain.action),
                frozen: effect.frozen_growth,
                ratio: effect.wave_ratio.map(|ratio| ratio.value),
            }),
            _ => None,
        };
        let points = speeds.iter().zip(&known.places).filter_map(point).collect();
        Some(Self { points, highest: speeds.iter().copied().fold(0.0, f64::max) })
    }

    /// The highest peak speed that is asked for, in m/s.
    pub fn highest(&self) -> f64 {
        self.highest
    }

    /// The gain as points (m/s, ratio).
    pub fn real(&self) -> Vec<Vec<[f64; 2]>> {
        runs(self.points.iter().map(|point| point.gain.map(|gain| [point.speed, gain])))
    }

    /// The frozen growth as points (m/s, ratio).
    pub fn frozen(&self) -> Vec<Vec<[f64; 2]>> {
        runs(self.points.iter().map(|point| point.frozen.map(|frozen| [point.speed, frozen])))
    }

    /// The point whose speed is nearest to this one (m/s).
    pub fn nearest(&self, speed: f64) -> Option<GainPoint> {
        self.points.iter().copied().min_by(|a, b| (a.speed - speed).abs().total_cmp(&(b.speed - speed).abs()))
    }

    /// The peak speed at which the move reaches the wave limit somewhere, in m/s.
    pub fn at_the_wave_limit(&self) -> Option<f64> {
        self.crossing(|point| point.ratio)
    }

    /// What these speeds say, in a sentence or two.
    pub fn finding(&self) -> Option<String> {
        let limit = self.at_the_wave_limit()?;
        let speed = |value| digits::certain(value, None);
        let below = self.points.iter().filter(|point| point.speed <= limit).filter_map(|point| point.gain);
        let largest = below.fold(f64::NEG_INFINITY, f64::max);
        let most = if !largest.is_finite() {
            String::new()
        } else if largest <= 1.0 {
            "; up to there every vibration ends smaller than it began".into()
        } else {
            let times = digits::certain(largest, None);
            format!("; up to there vibrations end at most {times} times as large as they began")
        };
        let frozen = self.crossing(|point| point.frozen).filter(|crossing| *crossing < limit);
        let frozen = frozen.map_or_else(String::new, |crossing| {
            format!(" Frozen time predicts growth from {} m/s on.", speed(crossing))
        });
        Some(format!("The move reaches the wave limit at a peak of {} m/s{most}.{frozen}", speed(limit)))
    }

    /// Where a value passes 1 for the first time, by a line between two speeds.
    fn crossing(&self, value: impl Fn(&GainPoint) -> Option<f64>) -> Option<f64> {
        self.points.windows(2).find_map(|pair| {
            let [a, b] = [value(&pair[0])?, value(&pair[1])?];
            let part = (1.0 - a) / (b - a);
            (a < 1.0 && b >= 1.0).then_some(pair[0].speed + part * (pair[1].speed - pair[0].speed))
        })
    }
}

/// What the move of the document does, and whether nothing has changed since.
pub fn effect(facts: Facts<'_>) -> Option<(&MoveEffect, bool)> {
    let shown = facts.studies.shown(Topic::Move)?;
    match shown.known.places.first()? {
        Some(Answer::Move(Ok(effect))) => Some((effect, shown.current)),
        _ => None,
    }
}

/// The document's move against the wave limit, and its gain, in a sentence or two.
pub fn of_the_move(facts: Facts<'_>) -> Option<String> {
    let (effect, true) = effect(facts)? else { return None };
    let ratio = effect.wave_ratio?;
    let at = digits::certain(ratio.s, None);
    let side =
        if ratio.value < 1.0 { "so nothing grows without bound" } else { "so there vibrations may grow without bound" };
    let gain = effect.gain.map_or_else(String::new, |gain| {
        format!(" Vibrations end at × {} at most.", digits::certain(gain.action, None))
    });
    Some(format!(
        "This move is at {:.0} % of the wave limit at most, {at} m along the path (cable {}): {side}.{gain}",
        100.0 * ratio.value,
        ratio.cable + 1
    ))
}

/// The fastest move that limits allow, or why there is none, and whether nothing has changed since.
pub fn fastest(facts: Facts<'_>) -> Option<(Result<&Fastest, &str>, bool)> {
    let shown = facts.studies.shown(Topic::Allowed)?;
    match shown.known.places.first()? {
        Some(Answer::Fastest(found)) => Some(((**found).as_ref().map_err(String::as_str), shown.current)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gains(points: &[[f64; 4]]) -> Gains {
        let point = |&[speed, gain, frozen, ratio]: &[f64; 4]| GainPoint {
            speed,
            gain: Some(gain),
            frozen: Some(frozen),
            ratio: Some(ratio),
        };
        Gains { points: points.iter().map(point).collect(), highest: 14.0 }
    }

    /// The figures of docs/theory.md for the paper's robot, rest to rest, damped and by the secant.
    #[test]
    fn what_the_speeds_say_is_told() {
        let paper = gains(&[
            [5.0, 0.354, 0.39, 0.42],
            [11.0, 0.712, 0.9, 0.93],
            [12.0, 0.8, 1.1, 1.01],
            [13.0, 0.931, 2.0, 1.1],
        ]);
        assert_eq!(
            paper.finding().as_deref(),
            Some(
                "The move reaches the wave limit at a peak of 11.9 m/s; up to there every vibration ends smaller than it \
                 began. Frozen time predicts growth from 11.5 m/s on."
            )
        );
        let undamped = gains(&[[2.0, 1.001, 1.66, 0.2], [11.0, 1.215, 1.86, 0.93], [12.0, 1.37, 2.0, 1.01]]);
        assert!(undamped.finding().is_some_and(|text| text.ends_with("at most 1.22 times as large as they began.")));
        // What is not known is not told.
        assert_eq!(gains(&[[2.0, 0.5, 0.5, 0.2]]).finding(), None);
        assert_eq!(paper.nearest(10.0).map(|point| point.speed), Some(11.0));
    }
}
