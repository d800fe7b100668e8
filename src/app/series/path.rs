//! What is known along a path, as points of a plot: the speed flown and the limits it meets.

use crate::app::facts::Facts;
use crate::app::series::{Abscissa, runs, sample_of_speed};
use crate::app::studies::StudyResults;
use crate::compute::protocol::Topic;
use crate::mechanics::WaveLimit;
use crate::robot::{Side, Trajectory};
use crate::study::{Answer, Station, Study};

use super::segments::{Sample, segments};

/// Places at which the speed flown is drawn, besides those where it has a corner.
const FLOWN: usize = 240;
/// A path is straight along an axis where it is off by no more than this part of its length.
const STRAIGHT: f64 = 1e-9;

/// A path with its timing, measured along an axis of the plane where it runs straight along one, else by arc length.
#[derive(Clone, Debug)]
pub struct Way<'a> {
    /// How places are measured.
    pub abscissa: Abscissa,
    trajectory: &'a Trajectory,
    start: f64,
    /// 1 where the abscissa rises along the path, −1 where it falls.
    sign: f64,
}

impl<'a> Way<'a> {
    /// That of `trajectory`.
    pub fn new(trajectory: &'a Trajectory) -> Self {
        let along = Self { abscissa: Abscissa::Path, trajectory, start: 0.0, sign: 1.0 };
        let length = trajectory.length();
        let points = (0..=32_u8).map(|i| trajectory.point(length * f64::from(i) / 32.0, Side::Left).position);
        let points: Vec<_> = points.collect();
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return along };
        for (axis, abscissa) in [Abscissa::X, Abscissa::Y].into_iter().enumerate() {
            let way = last[axis] - first[axis];
            // There and back is longer than from end to end.
            let straight = (way.abs() - length).abs() <= STRAIGHT * length
                && points.iter().all(|point| (point[1 - axis] - first[1 - axis]).abs() <= STRAIGHT * length);
            if straight {
                return Self { abscissa, start: first[axis], sign: way.signum(), ..along };
            }
        }
        along
    }

    /// Where arc length `s` (m) is on the abscissa, in m.
    pub fn at(&self, s: f64) -> f64 {
        self.start + self.sign * s
    }

    /// The arc length (m) at a place of the abscissa, kept within the path.
    pub fn s(&self, at: f64) -> f64 {
        (self.sign * (at - self.start)).clamp(0.0, self.trajectory.length())
    }

    /// The whole path on the abscissa, from left to right, in m.
    pub fn range(&self) -> [f64; 2] {
        let ends = [self.at(0.0), self.at(self.trajectory.length())];
        [ends[0].min(ends[1]), ends[0].max(ends[1])]
    }

    /// The speed flown, as points (m, m/s) in the order of time.
    pub fn flown(&self) -> Vec<[f64; 2]> {
        let duration = self.trajectory.duration();
        let mut times: Vec<f64> = (0..=FLOWN).map(|i| duration * i as f64 / FLOWN as f64).collect();
        times.extend(self.trajectory.breaks());
        times.sort_by(f64::total_cmp);
        let point = |time| {
            let moment = self.trajectory.at(time, Side::Left);
            [self.at(moment.s), moment.v]
        };
        // The move begins as it goes on: one at a constant speed is fast from the first moment on.
        let begin = self.trajectory.at(0.0, Side::Right);
        std::iter::once([self.at(begin.s), begin.v]).chain(times.into_iter().skip(1).map(point)).collect()
    }

    /// The highest speed flown, in m/s.
    pub fn peak(&self) -> f64 {
        self.flown().iter().map(|point| point[1]).fold(0.0, f64::max)
    }

    /// When the platform is first at arc length `s`, in s.
    pub fn time_at(&self, s: f64) -> f64 {
        // It never goes back on its path.
        let (mut before, mut after) = (0.0, self.trajectory.duration());
        for _ in 0..60 {
            let middle = 0.5 * (before + after);
            if self.trajectory.at(middle, Side::Left).s < s { before = middle } else { after = middle }
        }
        after
    }

    /// The speed flown at arc length `s` (m), in m/s.
    pub fn speed_at(&self, s: f64) -> f64 {
        self.trajectory.at(self.time_at(s), Side::Left).v
    }
}

/// The stations of a path that are known, from its beginning to its end.
#[derive(Clone, Debug)]
pub struct Stations<'a> {
    /// In rising order of arc length.
    pub all: Vec<&'a Station>,
}

impl<'a> Stations<'a> {
    /// Those of `known`, where it is about a path.
    pub fn new(known: &'a StudyResults) -> Option<Self> {
        let Study::Path { .. } = known.request.study else { return None };
        let station = |answer: &'a Option<Answer>| match answer {
            Some(Answer::Station(station)) => station.as_deref(),
            _ => None,
        };
        Some(Self { all: known.places.iter().filter_map(station).collect() })
    }

    /// The frozen critical speed as points (m of the abscissa, m/s); it breaks where it jumps, and where there is none.
    pub fn frozen(&self, way: &Way<'_>) -> Vec<Vec<[f64; 2]>> {
        let samples: Vec<Option<Sample>> =
            self.all.iter().map(|station| sample_of_speed(way.at(station.s), Some(&station.verdict))).collect();
        let point = |i: usize| samples[i].map(|sample| [sample.at, sample.values[0]]);
        segments(&samples).into_iter().map(|segment| segment.filter_map(point).collect()).collect()
    }

    /// The wave limit as points (m of the abscissa, m/s).
    pub fn waves(&self, way: &Way<'_>) -> Vec<Vec<[f64; 2]>> {
        runs(self.all.iter().map(|station| station.wave_limit.map(|limit| [way.at(station.s), limit.speed])))
    }

    /// The platform's speed at which the first winch reels at `rate` (m/s), as points (m of the abscissa, m/s).
    pub fn winches(&self, way: &Way<'_>, rate: f64) -> Vec<Vec<[f64; 2]>> {
        runs(self.all.iter().map(|station| {
            let fastest = station.rates.iter().map(|rates| rates[0].abs()).fold(0.0, f64::max);
            (fastest > 0.0).then(|| [way.at(station.s), rate / fastest])
        }))
    }

    /// Stretches of the abscissa without an equilibrium, from half-way to the neighbour on either side.
    pub fn infeasible(&self, way: &Way<'_>) -> Vec<[f64; 2]> {
        let place = |i: usize| way.at(self.all[i].s);
        let mut stretches = Vec::new();
        for (i, station) in self.all.iter().enumerate() {
            if station.verdict.feasible() == Some(false) {
                let before = place(i.saturating_sub(1));
                let after = place((i + 1).min(self.all.len() - 1));
                let ends = [0.5 * (before + place(i)), 0.5 * (after + place(i))];
                stretches.push([ends[0].min(ends[1]), ends[0].max(ends[1])]);
            }
        }
        stretches
    }

    /// The station that is nearest to arc length `s` (m).
    pub fn nearest(&self, s: f64) -> Option<&'a Station> {
        self.all.iter().copied().min_by(|a, b| (a.s - s).abs().total_cmp(&(b.s - s).abs()))
    }

    /// The least frozen critical speed in m/s and where it is.
    pub fn least_frozen(&self) -> Option<(f64, &'a Station)> {
        let speeds = self.all.iter().filter_map(|station| Some((station.verdict.critical()?.speed, *station)));
        speeds.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The least wave limit and where it is.
    pub fn least_waves(&self) -> Option<(WaveLimit, &'a Station)> {
        let limits = self.all.iter().filter_map(|station| Some((station.wave_limit?, *station)));
        limits.min_by(|a, b| a.0.speed.total_cmp(&b.0.speed))
    }
}

/// What local analysis finds at the station of the present path that is nearest to arc length `s` (m).
pub fn station(facts: Facts<'_>, s: f64) -> Option<&Station> {
    let shown = facts.studies.shown(Topic::Path).filter(|shown| shown.current)?;
    let stations = shown.known.places.iter().filter_map(|answer| match answer {
        Some(Answer::Station(Some(station))) => Some(&**station),
        _ => None,
    });
    stations.min_by(|a, b| (a.s - s).abs().total_cmp(&(b.s - s).abs()))
}

/// The speed of the present move over the wave limit, as arc length (m) and ratio, at the stations that are known.
pub fn margins(facts: Facts<'_>) -> Vec<(f64, f64)> {
    let shown = facts.studies.shown(Topic::Path).filter(|shown| shown.current);
    let (Some(shown), Some(trajectory)) = (shown, facts.document.scenario.trajectory()) else { return Vec::new() };
    let Some(stations) = Stations::new(shown.known) else { return Vec::new() };
    // At times rather than at the stations: the speed at a place would have to be searched for, in every frame.
    let duration = trajectory.duration();
    let ratio = |i: usize| {
        let moment = trajectory.at(duration * i as f64 / FLOWN as f64, if i == 0 { Side::Right } else { Side::Left });
        Some((moment.s, moment.v / stations.nearest(moment.s)?.wave_limit?.speed))
    };
    (0..=FLOWN).filter_map(ratio).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Profile, Vec2};

    fn trajectory(points: &[[f64; 2]]) -> Trajectory {
        let points: Vec<Vec2> = points.iter().map(|point| Vec2::from(*point)).collect();
        Trajectory::straight(points[0], &points[1..], Profile::Quintic { speed: 5.0 }).expect("a path")
    }

    #[test]
    fn a_path_along_an_axis_is_measured_by_it_and_any_other_by_its_length() {
        type Case = (&'static [[f64; 2]], Abscissa, [f64; 2]);
        let cases: [Case; 5] = [
            (&[[-6.0, 1.0], [6.0, 1.0]], Abscissa::X, [-6.0, 6.0]),
            (&[[6.0, 1.0], [2.0, 1.0], [-6.0, 1.0]], Abscissa::X, [-6.0, 6.0]),
            (&[[2.0, 3.0], [2.0, -1.0]], Abscissa::Y, [-1.0, 3.0]),
            (&[[0.0, 0.0], [3.0, 4.0]], Abscissa::Path, [0.0, 5.0]),
            // There and back passes every place twice.
            (&[[0.0, 0.0], [3.0, 0.0], [1.0, 0.0]], Abscissa::Path, [0.0, 5.0]),
        ];
        for (points, abscissa, range) in cases {
            let trajectory = trajectory(points);
            let way = Way::new(&trajectory);
            assert_eq!(way.abscissa, abscissa, "{points:?}");
            assert!(way.range().iter().zip(range).all(|(a, b)| (a - b).abs() < 1e-12), "{points:?}");
            assert!((way.s(way.at(1.25)) - 1.25).abs() < 1e-12, "{points:?}");
        }
    }

    #[test]
    fn the_speed_flown_is_that_of_the_profile() {
        let trajectory = trajectory(&[[6.0, 0.0], [-6.0, 0.0]]);
        let way = Way::new(&trajectory);
        // Half-way, after half of the 4.5 s, is the peak.
        assert!((way.time_at(6.0) - 2.25).abs() < 1e-9 && (way.speed_at(6.0) - 5.0).abs() < 1e-9);
        assert!((way.peak() - 5.0).abs() < 1e-9);
        let flown = way.flown();
        assert!(flown.iter().zip(flown.iter().skip(1)).all(|(a, b)| a[0] >= b[0]), "it moves to the left");
        let ends = [flown[0], flown[flown.len() - 1]];
        assert!(ends.iter().all(|end| end[1].abs() < 1e-9) && (ends[0][0] - 6.0).abs() < 1e-12, "{ends:?}");
    }
}
