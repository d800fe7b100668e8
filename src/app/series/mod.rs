//! What the plots of studies show, without colours: answers by place turned into points and sentences.

mod findings;
mod flight;
mod gains;
mod path;
mod segments;
mod what_if;

use std::f64::consts::TAU;

use nalgebra::Complex;

use crate::app::studies::StudyResults;
use crate::stability::{Critical, first_lowest};
use crate::study::campbell::Track;
use crate::study::convergence::{self, Convergence};
use crate::study::{Answer, Study, Verdict, compass, evenly};
pub use flight::{envelope, kept_within, nearest_sample, tensions, wobble};
pub use gains::{GainPoint, Gains, effect, fastest, of_the_move};
pub use path::{Stations, Way, margins, station};
pub use what_if::Against;

use segments::{Sample, segments};

/// How a line's places are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Abscissa {
    /// The motion is horizontal: x.
    X,
    /// It is vertical: y.
    Y,
    /// The way along the line from where it enters the workspace.
    Along,
    /// The way along a path from its beginning.
    Path,
}

impl Abscissa {
    /// What an axis of it is called, with its unit.
    pub fn title(self) -> &'static str {
        match self {
            Self::X => "x, m",
            Self::Y => "y, m",
            Self::Along => "way along the line, m",
            Self::Path => "way along the path, m",
        }
    }

    /// A place in words.
    pub fn place(self, at: f64, decimals: usize) -> String {
        match self {
            Self::X => format!("x = {at:.decimals$} m"),
            Self::Y => format!("y = {at:.decimals$} m"),
            Self::Along | Self::Path => format!("{at:.decimals$} m"),
        }
    }
}

/// Critical speeds along a line.
#[derive(Clone, Debug)]
pub struct Along {
    /// How places are measured.
    pub abscissa: Abscissa,
    /// Place in m and what is known there, from left to right.
    pub points: Vec<(f64, Verdict)>,
    /// The wave limit at each of these places, in m/s.
    pub wave_limits: Vec<Option<f64>>,
    /// The whole line, in m.
    pub range: [f64; 2],
    from: [f64; 2],
    direction: [f64; 2],
}

impl Along {
    /// Those of `known`, where it is a line.
    pub fn new(known: &StudyResults) -> Option<Self> {
        let Study::Line { line, .. } = &known.request.study else { return None };
        let direction: [f64; 2] = line.direction.into();
        let abscissa = match direction {
            [_, 0.0] => Abscissa::X,
            [0.0, _] => Abscissa::Y,
            _ => Abscissa::Along,
        };
        let (points, wave_limits) = (Vec::new(), Vec::new());
        let mut along = Self { abscissa, points, wave_limits, range: [0.0, 0.0], from: line.from.into(), direction };
        let ends = [line.from, line.to].map(|end| along.place(end.into()));
        along.range = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let mut answers: Vec<(f64, &Verdict, Option<f64>)> = Vec::new();
        for (index, answer) in known.places.iter().enumerate() {
            if let Some(Answer::Critical { verdict, wave_limit, .. }) = answer {
                answers.push((along.place(line.position(index).into()), verdict, *wave_limit));
            }
        }
        answers.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (at, verdict, wave_limit) in answers {
            along.points.push((at, verdict.clone()));
            along.wave_limits.push(wave_limit);
        }
        Some(along)
    }

    /// Where a pose is on the line, in m.
    pub fn place(&self, position: [f64; 2]) -> f64 {
        match self.abscissa {
            Abscissa::X => position[0],
            Abscissa::Y => position[1],
            Abscissa::Along | Abscissa::Path => {
                (position[0] - self.from[0]) * self.direction[0] + (position[1] - self.from[1]) * self.direction[1]
            }
        }
    }

    /// The pose at a place of the line, for a platform that is on it at `position`.
    pub fn moved(&self, [x, y]: [f64; 2], at: f64) -> [f64; 2] {
        match self.abscissa {
            Abscissa::X => [at, y],
            Abscissa::Y => [x, at],
            Abscissa::Along | Abscissa::Path => {
                let way = at - self.place([x, y]);
                [x + way * self.direction[0], y + way * self.direction[1]]
            }
        }
    }

    /// The place that is nearest to one on the line, by its number.
    pub fn nearest(&self, at: f64) -> Option<usize> {
        let distances = self.points.iter().map(|(place, _)| (place - at).abs()).enumerate();
        distances.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
    }

    /// The critical speed as points (m, m/s), whatever mode comes first, as stretches on which it does not jump: where
    /// another mode comes first it goes on, with a corner.
    pub fn speeds(&self) -> Vec<Vec<[f64; 2]>> {
        let samples: Vec<Option<Sample>> =
            self.points.iter().map(|(at, verdict)| sample_of_speed(*at, Some(verdict))).collect();
        let point = |i: usize| samples[i].map(|sample| [sample.at, sample.values[0]]);
        segments(&samples).into_iter().map(|segment| segment.filter_map(point).collect()).collect()
    }

    /// The same without gaps where it jumps; it ends where nothing is critical.
    pub fn critical(&self) -> Vec<Vec<[f64; 2]>> {
        runs(self.points.iter().map(|(at, verdict)| Some([*at, verdict.critical()?.speed])))
    }

    /// The wave limit as points (m, m/s); it ends where there is none.
    pub fn waves(&self) -> Vec<Vec<[f64; 2]>> {
        let places = self.points.iter().zip(&self.wave_limits);
        runs(places.map(|((at, _), limit)| limit.map(|limit| [*at, limit])))
    }

    /// What is known at each place: critical speed in m/s and frequency in Hz; `None` where nothing is critical.
    fn samples(&self) -> Vec<Option<Sample>> {
        self.points.iter().map(|(at, verdict)| sample(*at, Some(verdict))).collect()
    }

    /// Stretches of one mode, as points (m, `value`): where another mode comes first, and where nothing is critical, one
    /// ends.
    pub fn stretches(&self, value: impl Fn(&Critical) -> f64) -> Vec<Vec<[f64; 2]>> {
        let point = |i: usize| {
            let (at, verdict) = &self.points[i];
            verdict.critical().map(|critical| [*at, value(critical)])
        };
        segments(&self.samples()).into_iter().map(|segment| segment.filter_map(point).collect()).collect()
    }

    /// Stretches without an equilibrium, from half-way to the neighbour on either side.
    pub fn infeasible(&self) -> Vec<[f64; 2]> {
        let mut stretches: Vec<[f64; 2]> = Vec::new();
        let [low, high] = self.range;
        for (i, (at, verdict)) in self.points.iter().enumerate() {
            if *verdict != Verdict::Infeasible {
                continue;
            }
            let left = if i == 0 { low } else { 0.5 * (self.points[i - 1].0 + at) };
            let right = self.points.get(i + 1).map_or(high, |next| 0.5 * (at + next.0));
            match stretches.last_mut().filter(|last| left - last[1] <= 1e-9 * (high - low)) {
                Some(last) => last[1] = right,
                None => stretches.push([left, right]),
            }
        }
        stretches
    }
}

/// Neighbours that are all there, run by run.
fn runs(points: impl Iterator<Item = Option<[f64; 2]>>) -> Vec<Vec<[f64; 2]>> {
    let mut runs = vec![Vec::new()];
    for point in points {
        match (point, runs.last_mut()) {
            (Some(point), Some(run)) => run.push(point),
            _ => runs.push(Vec::new()),
        }
    }
    runs.retain(|run| !run.is_empty());
    runs
}

/// What a place of a curve of critical speeds shows, where there is one.
fn sample(at: f64, verdict: Option<&Verdict>) -> Option<Sample> {
    let critical = verdict?.critical()?;
    let (values, mode) = ([critical.speed, critical.frequency_hz()], Some((critical.kind, critical.cable)));
    Some(Sample { at, values, mode })
}

/// The same of the speed alone, whatever mode it belongs to.
fn sample_of_speed(at: f64, verdict: Option<&Verdict>) -> Option<Sample> {
    Some(Sample { at, values: [verdict?.critical()?.speed, 0.0], mode: None })
}

/// The directions of a polar diagram: the unit vector and what is known, counterclockwise.
pub fn directions<'a>(known: &'a StudyResults) -> Vec<([f64; 2], Option<&'a Verdict>)> {
    let Study::Directions { count, .. } = known.request.study else { return Vec::new() };
    let place = |(i, answer): (usize, &'a Option<Answer>)| match answer {
        Some(Answer::Critical { verdict, .. }) => (compass(i, count).into(), Some(verdict)),
        _ => (compass(i, count).into(), None),
    };
    known.places.iter().enumerate().map(place).collect()
}

/// The stretches of a polar diagram on which the critical speed does not jump, as points (critical speed times direction,
/// in m/s). Once around and back to the first direction; what is not known yet is no gap.
pub fn around(known: &StudyResults) -> Vec<Vec<[f64; 2]>> {
    let all = directions(known);
    let known: Vec<([f64; 2], &Verdict)> =
        all.iter().chain(all.first()).filter_map(|(direction, verdict)| Some((*direction, (*verdict)?))).collect();
    let mut turned = 0.0;
    let mut samples = Vec::with_capacity(known.len());
    for (i, (direction, verdict)) in known.iter().enumerate() {
        if i > 0 {
            let before = known[i - 1].0;
            // Counterclockwise by less than a whole turn.
            turned += (degrees(*direction) - degrees(before)).rem_euclid(360.0);
        }
        samples.push(sample_of_speed(turned, Some(verdict)));
    }
    let point = |i: usize| {
        let ([x, y], verdict) = known[i];
        verdict.critical().map(|critical| [critical.speed * x, critical.speed * y])
    };
    segments(&samples).into_iter().map(|segment| segment.filter_map(point).collect()).collect()
}

/// The wave limit in every direction as points (limit times direction, in m/s), once around and back to the first
/// direction; it ends where there is none.
pub fn waves_around(known: &StudyResults) -> Vec<Vec<[f64; 2]>> {
    let Study::Directions { count, .. } = known.request.study else { return Vec::new() };
    let all = known.places.iter().enumerate().chain(known.places.first().map(|first| (0, first)));
    // What is not known yet is no gap.
    let answered = all.filter_map(|(i, answer)| Some((i, answer.as_ref()?)));
    runs(answered.map(|(i, answer)| match answer {
        Answer::Critical { wave_limit: Some(limit), .. } => {
            let [x, y]: [f64; 2] = compass(i, count).into();
            Some([limit * x, limit * y])
        }
        _ => None,
    }))
}

/// The direction with the lowest critical speed, and that speed in m/s.
pub fn worst_direction(known: &StudyResults) -> Option<([f64; 2], f64)> {
    let speed = |(direction, verdict): ([f64; 2], Option<&Verdict>)| Some((direction, verdict?.critical()?.speed));
    let critical: Vec<([f64; 2], f64)> = directions(known).into_iter().filter_map(speed).collect();
    first_lowest(critical.iter().map(|(_, speed)| *speed)).map(|index| critical[index])
}

/// The angle of a direction in degrees, from −180 to 180.
pub fn degrees([x, y]: [f64; 2]) -> f64 {
    y.atan2(x).to_degrees()
}

/// The eigenvalues of a Campbell diagram one by one: speed in m/s and eigenvalue in 1/s.
pub fn spectra(known: &StudyResults) -> Vec<(f64, Complex<f64>)> {
    let Study::Campbell { to, count, .. } = known.request.study else { return Vec::new() };
    let mut all = Vec::new();
    for (i, answer) in known.places.iter().enumerate() {
        if let Some(Answer::Spectrum(Ok(values))) = answer {
            all.extend(values.iter().map(|&value| (evenly(0.0, to, i, count), value)));
        }
    }
    all
}

/// The spectra of a Campbell diagram up to `highest` Hz, to be joined to modes: speeds in m/s and eigenvalues in 1/s. Speeds
/// that are not answered yet are left out.
pub fn spectra_up_to(known: &StudyResults, highest: f64) -> Vec<(f64, Vec<Complex<f64>>)> {
    let Study::Campbell { to, count, .. } = known.request.study else { return Vec::new() };
    // Somewhat more than is drawn, so that modes do not end below the edge; all of them would take long to join.
    let drawn = |value: &&Complex<f64>| value.im <= 1.5 * highest * TAU;
    let spectrum = |(i, answer): (usize, &Option<Answer>)| match answer {
        Some(Answer::Spectrum(Ok(values))) => {
            Some((evenly(0.0, to, i, count), values.iter().filter(drawn).copied().collect()))
        }
        _ => None,
    };
    known.places.iter().enumerate().filter_map(spectrum).collect()
}

/// A part of a mode's line on which it is stable throughout, or unstable throughout.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Whether it grows.
    pub unstable: bool,
    /// Speed in m/s and eigenvalue in 1/s.
    pub points: Vec<(f64, Complex<f64>)>,
}

/// The pieces of a mode's line; where stability changes, they share the point at which the growth rate passes zero. Where
/// the line jumps, because speeds are too far apart to tell modes apart, one piece ends.
pub fn pieces(track: &Track) -> Vec<Piece> {
    let sample = |&(at, value): &(f64, Complex<f64>)| Some(Sample { at, values: [value.re, value.im], mode: None });
    let samples: Vec<Option<Sample>> = track.points.iter().map(sample).collect();
    segments(&samples).into_iter().flat_map(|segment| by_stability(&track.points[segment])).collect()
}

/// The growth rates of a curve against speed, in pieces below and above zero. The largest of all growth rates is continuous
/// in the speed, whichever mode has it: nothing jumps.
pub fn growth(curve: &[[f64; 2]]) -> Vec<Piece> {
    let points: Vec<(f64, Complex<f64>)> =
        curve.iter().map(|&[speed, rate]| (speed, Complex::new(rate, 0.0))).collect();
    by_stability(&points)
}

fn by_stability(points: &[(f64, Complex<f64>)]) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    for &(speed, eigenvalue) in points {
        let unstable = eigenvalue.re > 0.0;
        let mut points = vec![(speed, eigenvalue)];
        if let Some(last) = pieces.last_mut() {
            if last.unstable == unstable {
                last.points.append(&mut points);
                continue;
            }
            if let Some(&(before, from)) = last.points.last() {
                let part = (from.re / (from.re - eigenvalue.re)).clamp(0.0, 1.0);
                let crossing = (before + part * (speed - before), from + (eigenvalue - from) * part);
                last.points.push(crossing);
                points.insert(0, crossing);
            }
        }
        pieces.push(Piece { unstable, points });
    }
    pieces
}

/// The critical speed on several meshes.
#[derive(Clone, Debug)]
pub struct Meshes {
    /// Elements per cable and what is known, from the coarsest on.
    pub points: Vec<(usize, Verdict)>,
    /// What they say about ever finer meshes.
    pub limit: Convergence,
}

impl Meshes {
    /// Those of `known`, where it is about meshes, with `today` elements per cable.
    pub fn new(known: &StudyResults, today: usize) -> Option<Self> {
        Self::with(known, today, None)
    }

    /// The same where the critical speed on today's mesh is known from elsewhere.
    pub fn with(known: &StudyResults, today: usize, at_today: Option<&Critical>) -> Option<Self> {
        let Study::Mesh { counts, .. } = &known.request.study else { return None };
        let verdict = |(n, answer): (&usize, &Option<Answer>)| match answer {
            Some(Answer::Critical { verdict, .. }) => Some((*n, verdict.clone())),
            _ => None,
        };
        let mut points: Vec<(usize, Verdict)> = counts.iter().zip(&known.places).filter_map(verdict).collect();
        if let Some(critical) = at_today.filter(|_| !counts.contains(&today)) {
            points.push((today, Verdict::Critical(critical.clone())));
            points.sort_by_key(|(n, _)| *n);
        }
        Some(Self { limit: convergence::richardson(&points, today), points })
    }

    /// Stretches of meshes that show one mode, as points (elements per cable, critical speed in m/s).
    pub fn stretches(&self) -> Vec<Vec<[f64; 2]>> {
        // Over 1/n the critical speed is nearly straight, or bent one way: no step is unlike the others by itself.
        let at = |(n, verdict): &(usize, Verdict)| sample(-1.0 / *n as f64, Some(verdict));
        let samples: Vec<Option<Sample>> = self.points.iter().map(at).collect();
        let point = |i: usize| {
            let (n, verdict) = &self.points[i];
            verdict.critical().map(|critical| [*n as f64, critical.speed])
        };
        segments(&samples).into_iter().map(|segment| segment.filter_map(point).collect()).collect()
    }
}

#[cfg(test)]
mod tests {
    // Places and answers compared are copied, not computed.
    #![expect(clippy::float_cmp)]

    use super::*;
    use crate::app::studies::StudyRequest;
    use crate::robot::Vec2;
    use crate::scenario::{Scenario, presets};
    use crate::stability::Instability;
    use crate::study::Line;

    fn critical(speed: f64, frequency_hz: f64) -> Answer {
        let eigenvalue = Complex::new(0.0, frequency_hz * TAU);
        let critical = Critical { speed, eigenvalue, kind: Instability::Flutter, cable: 3 };
        Answer::Critical { direction: Vec2::x(), verdict: Verdict::Critical(critical), wave_limit: None }
    }

    fn nothing() -> Answer {
        Answer::Critical { direction: Vec2::x(), verdict: Verdict::Infeasible, wave_limit: None }
    }

    fn paper() -> Scenario {
        presets::PRESETS[0].scenario()
    }

    fn line(direction: [f64; 2]) -> Study {
        let mut scenario = paper();
        scenario.motion.direction = direction;
        let (robot, motion) = scenario.to_robot().expect("physical");
        Study::Line { line: Line::through(&robot, &motion, 21), limit: 40.0 }
    }

    fn known(study: Study, answer: impl Fn(usize) -> Option<Answer>) -> StudyResults {
        let request = StudyRequest::new(&paper(), study);
        StudyResults { places: (0..request.study.len()).map(answer).collect(), request, version: (1, 0) }
    }

    #[test]
    fn a_line_is_told_with_its_gaps_and_its_findings() {
        let answer = |i: usize| {
            let far = (i as f64 - 10.0).abs();
            Some(if far > 7.0 { nothing() } else { critical(11.0 - 0.1 * far * far, 0.3 + 0.1 * far) })
        };
        let along = Along::new(&known(line([1.0, 0.0]), answer)).expect("a line");
        assert_eq!((along.abscissa, along.range, along.place([3.0, 0.0])), (Abscissa::X, [-10.0, 10.0], 3.0));
        assert_eq!(along.infeasible(), [[-10.0, -7.5], [7.5, 10.0]]);
        let stretches = along.stretches(|c| c.speed);
        assert_eq!((stretches.len(), stretches[0].len(), stretches[0][0][0]), (1, 15, -7.0));
        let text = along.findings().expect("findings");
        assert!(
            text.starts_with("From x = 0.0 m to x = -7.0 m and from x = 0.0 m to x = 7.0 m the critical speed "),
            "{text}"
        );
        assert!(text.contains("falls and the frequency rises, as the paper found"), "{text}");

        // The other way round the places run from right to left; flat lines say nothing.
        let back = Along::new(&known(line([-1.0, 0.0]), |i| (i > 2).then(|| critical(9.0, 1.0))));
        let back = back.expect("a line");
        assert_eq!((back.points.len(), back.points[17].0, back.findings()), (18, 7.0, None));
        // Across, the way begins where the line enters.
        let across = Along::new(&known(line([1.0, 1.0]), |_| Some(nothing()))).expect("a line");
        assert_eq!(across.abscissa, Abscissa::Along);
        assert!((across.place([0.0, 0.0]) - 50.0_f64.sqrt()).abs() < 1e-9);
        assert_eq!(across.infeasible(), [across.range]);
    }

    #[test]
    fn the_wave_limit_and_the_way_belong_to_their_places() {
        let with_waves = |i: usize| {
            let Answer::Critical { direction, verdict, .. } = critical(9.0, 1.0) else { panic!("a critical speed") };
            Some(Answer::Critical { direction, verdict, wave_limit: (i != 3).then_some(i as f64) })
        };
        // From right to left: the first answer is the rightmost place.
        let along = Along::new(&known(line([-1.0, 0.0]), with_waves)).expect("a line");
        assert_eq!(along.wave_limits[20], Some(0.0));
        let waves = along.waves();
        assert_eq!((waves.len(), waves[0].len(), waves[1].len()), (2, 17, 3));
        assert_eq!(waves[1][0], [8.0, 2.0]);
        assert_eq!((along.critical().len(), along.speeds().len()), (1, 1));
        // Another cable bends the curve of the speed; only a jump breaks it.
        let other = |i: usize, jump: f64| {
            let far = i as f64 - 10.0;
            let Answer::Critical { direction, mut verdict, .. } = critical(9.0 + 0.1 * far.abs(), 1.0) else {
                panic!()
            };
            if let (Verdict::Critical(critical), true) = (&mut verdict, i > 10) {
                (critical.cable, critical.speed) = (2, critical.speed + jump);
            }
            Some(Answer::Critical { direction, verdict, wave_limit: None })
        };
        let bent = Along::new(&known(line([1.0, 0.0]), |i| other(i, 0.0))).expect("a line");
        assert_eq!((bent.speeds().len(), bent.stretches(|c| c.speed).len()), (1, 2));
        let broken = Along::new(&known(line([1.0, 0.0]), |i| other(i, 4.0))).expect("a line");
        assert_eq!((broken.speeds().len(), broken.critical().len()), (2, 1));
        assert_eq!((along.nearest(-8.7), along.moved([3.0, 0.5], -2.0)), (Some(1), [-2.0, 0.5]));
        let across = Along::new(&known(line([1.0, 1.0]), |_| Some(nothing()))).expect("a line");
        let [x, y] = across.moved([0.0, 0.0], across.place([2.0, 2.0]));
        assert!((x - 2.0).abs() < 1e-9 && (y - 2.0).abs() < 1e-9);
        assert!(across.critical().is_empty() && across.waves().is_empty());
    }

    #[test]
    fn the_worst_direction_is_the_lowest() {
        let study = Study::Directions { position: Vec2::zeros(), count: 8, limit: 40.0 };
        let known = known(study, |i| match i {
            0 => None,
            1 => Some(nothing()),
            _ => Some(critical(20.0 - i as f64, 1.0)),
        });
        let (direction, speed) = worst_direction(&known).expect("a direction");
        assert_eq!(speed, 13.0);
        assert!((degrees(direction) + 45.0).abs() < 1e-12);
        assert_eq!(directions(&known).iter().filter(|(_, verdict)| verdict.is_some()).count(), 7);
    }

    #[test]
    fn modes_are_cut_where_they_become_unstable() {
        let study = Study::Campbell { position: Vec2::zeros(), direction: Vec2::x(), to: 4.0, count: 5 };
        let answer = |i: usize| {
            let re = i as f64 - 1.5;
            (i != 2).then(|| Answer::Spectrum(Ok(vec![Complex::new(re, 10.0), Complex::new(-1.0, 1e4)])))
        };
        let tracks = crate::study::campbell::track(&spectra_up_to(&known(study, answer), 5.0));
        assert_eq!(tracks.len(), 1, "what is far above the highest frequency is left out");
        let at = |speed: f64| (speed, Complex::new(speed - 1.5, 10.0));
        let [stable, unstable] = &pieces(&tracks[0])[..] else { panic!("two pieces") };
        assert_eq!((stable.unstable, &stable.points[..]), (false, &[at(0.0), at(1.0), at(1.5)][..]));
        assert_eq!((unstable.unstable, &unstable.points[..]), (true, &[at(1.5), at(3.0), at(4.0)][..]));
    }

    #[test]
    fn meshes_lead_to_their_limit() {
        let counts = vec![4, 10, 20, 40, 80];
        let (position, direction) = (Vec2::zeros(), Vec2::x());
        let study = Study::Mesh { position, direction, counts: counts.clone(), limit: 40.0 };
        let answer = |i: usize| Some(critical(10.0 + 20.0 / (counts[i] * counts[i]) as f64, 1.0));
        let meshes = Meshes::new(&known(study, answer), 10).expect("meshes");
        assert_eq!(meshes.stretches().iter().map(Vec::len).collect::<Vec<_>>(), [5]);
        let Convergence::Limit(limit) = meshes.limit else { panic!("{meshes:?}") };
        assert!((limit.limit - 10.0).abs() < 1e-6 && (limit.error.unwrap_or(0.0) - 0.2).abs() < 1e-6, "{limit:?}");
    }
}
