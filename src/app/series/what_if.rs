//! The critical speed against one number: answers by value as points, stretches and sentences.

use super::segments::segments;
use super::{runs, sample, sample_of_speed};
use crate::app::studies::StudyResults;
use crate::stability::Critical;
use crate::study::{Answer, Study, Verdict};

/// Critical speeds against one number.
#[derive(Clone, Debug)]
pub struct Against {
    /// Values in SI units and what is known there, in rising order.
    pub points: Vec<(f64, Verdict)>,
    /// The first and the last value of all, known or not.
    pub range: [f64; 2],
}

impl Against {
    /// Those of `known`, where it varies one number.
    pub fn new(known: &StudyResults) -> Option<Self> {
        let Study::WhatIf(what_if) = &known.request.study else { return None };
        let [number] = &what_if.numbers[..] else { return None };
        let range = [*number.values.first()?, *number.values.last()?];
        let point = |(value, answer): (&f64, &Option<Answer>)| match answer {
            Some(Answer::Critical { verdict, .. }) => Some((*value, verdict.clone())),
            _ => None,
        };
        Some(Self { points: number.values.iter().zip(&known.places).filter_map(point).collect(), range })
    }

    /// The critical speed as points (value, m/s), whatever mode comes first, as stretches on which it does not jump.
    pub fn speeds(&self) -> Vec<Vec<[f64; 2]>> {
        let samples: Vec<_> = self.points.iter().map(|(at, verdict)| sample_of_speed(*at, Some(verdict))).collect();
        let point = |i: usize| samples[i].map(|sample| [sample.at, sample.values[0]]);
        segments(&samples).into_iter().map(|segment| segment.filter_map(point).collect()).collect()
    }

    /// The same without gaps where it jumps; it ends where nothing is critical.
    pub fn critical(&self) -> Vec<Vec<[f64; 2]>> {
        runs(self.points.iter().map(|(at, verdict)| Some([*at, verdict.critical()?.speed])))
    }

    /// Stretches of one mode, as points (value, `quantity`).
    pub fn stretches(&self, quantity: impl Fn(&Critical) -> f64) -> Vec<Vec<[f64; 2]>> {
        let samples: Vec<_> = self.points.iter().map(|(at, verdict)| sample(*at, Some(verdict))).collect();
        let point = |i: usize| {
            let (at, verdict) = &self.points[i];
            verdict.critical().map(|critical| [*at, quantity(critical)])
        };
        segments(&samples).into_iter().map(|segment| segment.filter_map(point).collect()).collect()
    }

    /// Stretches of values without an equilibrium, and of values that are not allowed or could not be computed, from
    /// half-way to the neighbour on either side.
    pub fn gaps(&self) -> Vec<[f64; 2]> {
        let is_gap =
            |verdict: &Verdict| matches!(verdict, Verdict::Infeasible | Verdict::Unknown | Verdict::NotConverged);
        let mut gaps: Vec<[f64; 2]> = Vec::new();
        let mut before = false;
        for (i, (at, verdict)) in self.points.iter().enumerate() {
            let gap = is_gap(verdict);
            if gap {
                let left = if i == 0 { self.range[0] } else { 0.5 * (self.points[i - 1].0 + at) };
                let right = self.points.get(i + 1).map_or(self.range[1], |next| 0.5 * (at + next.0));
                match gaps.last_mut().filter(|_| before) {
                    Some(last) => last[1] = right,
                    None => gaps.push([left, right]),
                }
            }
            before = gap;
        }
        gaps
    }

    /// The place with the value nearest to this one.
    pub fn nearest(&self, value: f64) -> Option<usize> {
        let distances = self.points.iter().map(|(at, _)| (at - value).abs()).enumerate();
        distances.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
    }

    /// The values with the lowest and with the highest critical speed, with these speeds in m/s.
    pub fn extremes(&self) -> Option<[[f64; 2]; 2]> {
        let all = || self.points.iter().filter_map(|(at, verdict)| Some([*at, verdict.critical()?.speed]));
        let lowest = all().reduce(|a, b| if b[1] < a[1] { b } else { a })?;
        let highest = all().reduce(|a, b| if b[1] > a[1] { b } else { a })?;
        Some([lowest, highest])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::studies::StudyRequest;
    use crate::scenario::presets;
    use crate::stability::Instability;
    use crate::study::{Varied, WhatIf};
    use nalgebra::Complex;

    fn against(verdicts: &[Option<Verdict>]) -> Against {
        let values = (0_u8..).map(f64::from).take(verdicts.len()).collect();
        let number = Varied { path: "platform.mass".into(), values };
        let study = Study::WhatIf(WhatIf { numbers: vec![number], limit: 40.0 });
        let request = StudyRequest { scenario: presets::PRESETS[0].scenario(), study };
        let answer = |verdict: &Option<Verdict>| {
            verdict.clone().map(|verdict| Answer::Critical {
                direction: crate::robot::Vec2::x(),
                verdict,
                wave_limit: None,
            })
        };
        let places = verdicts.iter().map(answer).collect();
        Against::new(&StudyResults { request, places, version: (1, 1) }).expect("one number")
    }

    #[expect(clippy::unnecessary_wraps)] // It stands in lists of verdicts that may be missing.
    fn critical(speed: f64) -> Option<Verdict> {
        let eigenvalue = Complex::new(0.0, 2.0);
        Some(Verdict::Critical(Critical { speed, eigenvalue, kind: Instability::Flutter, cable: 0 }))
    }

    #[test]
    fn curves_end_at_gaps_and_gaps_reach_half_way() {
        let all = against(&[
            Some(Verdict::Unknown),
            Some(Verdict::Infeasible),
            critical(5.0),
            critical(6.0),
            Some(Verdict::NoneUpTo(40.0)),
            critical(7.0),
            None,
            Some(Verdict::Infeasible),
        ]);
        assert_eq!(all.critical(), [vec![[2.0, 5.0], [3.0, 6.0]], vec![[5.0, 7.0]]]);
        assert_eq!(all.speeds(), all.critical());
        assert_eq!(all.gaps(), [[0.0, 1.5], [6.0, 7.0]]);
        assert_eq!(all.extremes(), Some([[2.0, 5.0], [5.0, 7.0]]));
        assert_eq!((all.nearest(5.9), all.nearest(2.4)), (Some(5), Some(2)));
        assert_eq!(against(&[Some(Verdict::Infeasible)]).extremes(), None);
    }
}
