//! The places of a wanted study: which, in which order, how hard, and the answer at each.

use std::sync::Arc;

use nalgebra::Complex;

use crate::robot::{Robot, Vec2};
use crate::scenario::Scenario;
use crate::scenario::report::CriticalReport;
use crate::stability::{ALLOWED_LIMIT, Steps, is_limit};
use crate::study::{Answer, Asked, Directions, Grid, Line, Study, Verdict, campbell, compass};

use super::protocol::{AskedChoice, DirectionsChoice, Missing, PlaceAnswer, StudyChoice, StudyJob, VerdictAnswer};

/// Elements of all cables of a place of weight 1, in one direction.
const USUAL_ELEMENTS: f64 = 40.0;
/// The cubes of all numbers of eigenvalues that are joined as fast as a place of weight 1, at the worst.
const USUAL_CUBES: f64 = 1e6;
/// In a coarse map every so-many-th point of every so-many-th row is answered.
const COARSE: usize = 4;

/// A study with the robot it is of.
#[derive(Debug)]
pub struct Places {
    work: Work,
}

#[derive(Debug)]
enum Work {
    /// The places of a study of a robot.
    Study { robot: Robot, study: Study },
    /// Spectra at successive speeds to be joined to modes: one place.
    Join(Vec<(f64, Vec<Complex<f64>>)>),
}

impl Places {
    /// The study that `job` wants.
    ///
    /// # Errors
    /// A scenario that is not physical or a speed that is not greater than 0, with the reason.
    pub fn new(job: &StudyJob) -> Result<Self, String> {
        if let StudyChoice::Modes { spectra } = &job.study {
            let values = |values: &Vec<[f64; 2]>| values.iter().map(|&[re, im]| Complex::new(re, im)).collect();
            let spectra: Vec<(f64, Vec<Complex<f64>>)> =
                spectra.iter().map(|(speed, eigenvalues)| (*speed, values(eigenvalues))).collect();
            let finite = |value: &Complex<f64>| value.re.is_finite() && value.im.is_finite();
            if !spectra.iter().all(|(speed, values)| speed.is_finite() && values.iter().all(finite)) {
                return Err("speeds and eigenvalues must be finite".into());
            }
            return Ok(Self { work: Work::Join(spectra) });
        }
        let scenario = Scenario::from_json(&job.scenario).map_err(|faults| faults.to_string())?;
        let (robot, motion) = scenario.to_robot().map_err(|faults| faults.to_string())?;
        let (position, direction) = (motion.position(), motion.direction());
        let study = match &job.study {
            StudyChoice::Line { points, max_speed } => {
                Study::Line { line: Line::through(&robot, &motion, *points), limit: search_limit(*max_speed)? }
            }
            StudyChoice::Map { nx, ny, directions, asked } => Study::Map {
                grid: Grid::of(&robot, *nx, *ny),
                directions: match directions {
                    DirectionsChoice::Motion => Directions::One(direction),
                    DirectionsChoice::Worst => Directions::Worst(Directions::WORST_OF),
                },
                asked: match asked {
                    AskedChoice::Critical { max_speed } => Asked::Critical { limit: search_limit(*max_speed)? },
                    AskedChoice::Growth => Asked::Growth { speed: motion.speed() },
                },
            },
            StudyChoice::Polar { count, max_speed } => {
                Study::Polar { position, count: *count, limit: search_limit(*max_speed)? }
            }
            StudyChoice::Campbell { to, count } => {
                Study::Speeds { position, direction, to: search_limit(*to)?, count: *count }
            }
            StudyChoice::Convergence { counts, max_speed } => {
                Study::Elements { position, direction, counts: counts.clone(), limit: search_limit(*max_speed)? }
            }
            StudyChoice::Modes { .. } => return Err("modes are not those of one robot".into()),
        };
        Ok(Self { work: Work::Study { robot, study } })
    }

    /// All of them, each once, in the order in which a picture becomes finer.
    pub fn order(&self) -> Vec<usize> {
        match &self.work {
            Work::Study { study, .. } => study.order(),
            Work::Join(_) => vec![0],
        }
    }

    /// Of that order, how many make a first picture: the map at a quarter of its resolution; none of other studies.
    pub fn coarse(&self) -> usize {
        match &self.work {
            Work::Study { study: Study::Map { grid, .. }, .. } => grid.nx.div_ceil(COARSE) * grid.ny.div_ceil(COARSE),
            _ => 0,
        }
    }

    /// About how much work a place is; 1 is a direction at a pose of a robot such as the paper's.
    pub fn weight(&self, place: usize) -> f64 {
        let (robot, study) = match &self.work {
            Work::Study { robot, study } => (robot, study),
            // An assignment takes up to the cube of their number, at each speed.
            Work::Join(spectra) => {
                let cubes = spectra.iter().map(|(_, values)| (values.len() as f64).powi(3));
                return (cubes.sum::<f64>() / USUAL_CUBES).max(1.0);
            }
        };
        let elements = match study {
            Study::Elements { counts, .. } => counts.get(place).copied().unwrap_or_default(),
            _ => robot.elements,
        };
        let directions = match study {
            Study::Map { directions: Directions::Worst(count), .. } => *count as f64,
            _ => 1.0,
        };
        let size = (elements * robot.cables.len()) as f64 / USUAL_ELEMENTS;
        directions * size * size
    }

    /// The answer at one place, step by step.
    pub fn answer(self: &Arc<Self>, place: usize) -> Steps<PlaceAnswer> {
        let places = Arc::clone(self);
        Steps::new(async move { places.answer_in_steps(place).await })
    }

    async fn answer_in_steps(&self, place: usize) -> PlaceAnswer {
        match &self.work {
            Work::Study { robot, study } => (&study.answer_in_steps(robot, place).await).into(),
            Work::Join(spectra) => {
                let point = |&(speed, value): &(f64, Complex<f64>)| (speed, [value.re, value.im]);
                let tracks = campbell::track_in_steps(spectra).await;
                PlaceAnswer::Modes(Ok(tracks.iter().map(|track| track.points.iter().map(point).collect()).collect()))
            }
        }
    }

    /// The answer where the attempt at one fails.
    pub fn unknown(&self, place: usize) -> PlaceAnswer {
        let study = match &self.work {
            Work::Study { study, .. } => study,
            Work::Join(_) => return PlaceAnswer::Modes(Err(Missing::Failed)),
        };
        let direction = match study {
            Study::Line { line, .. } => line.direction,
            Study::Polar { count, .. } => compass(place, *count),
            Study::Map { asked: Asked::Growth { .. }, .. } => return PlaceAnswer::Growth(Err(Missing::Failed)),
            Study::Map { directions: Directions::One(direction), .. } | Study::Elements { direction, .. } => *direction,
            Study::Map { directions: Directions::Worst(_), .. } => Vec2::x(),
            Study::Speeds { .. } => return PlaceAnswer::Spectrum(Err(Missing::Failed)),
        };
        (&Answer::unknown(direction)).into()
    }
}

/// A speed up to which to search, or why it is none.
pub(super) fn search_limit(value: f64) -> Result<f64, String> {
    if is_limit(value) { Ok(value) } else { Err(format!("the highest speed is {value}; allowed: {ALLOWED_LIMIT}")) }
}

impl From<&Answer> for PlaceAnswer {
    fn from(answer: &Answer) -> Self {
        match answer {
            Answer::Critical { direction, verdict, wave_limit } => {
                Self::Critical { direction: (*direction).into(), verdict: verdict.into(), wave_limit: *wave_limit }
            }
            Answer::Growth(rate) => Self::Growth(rate.map_err(Missing::from)),
            Answer::Spectrum(spectrum) => {
                let pairs = |values: &Vec<_>| values.iter().map(|value: &Complex<f64>| [value.re, value.im]).collect();
                Self::Spectrum(spectrum.as_ref().map(pairs).map_err(|&reason| reason.into()))
            }
        }
    }
}

impl From<&Verdict> for VerdictAnswer {
    fn from(verdict: &Verdict) -> Self {
        match verdict {
            Verdict::Infeasible => Self::Infeasible,
            Verdict::Unknown => Self::Unknown,
            Verdict::NotConverged => Self::NotConverged,
            Verdict::NoneUpTo(limit) => Self::NoneUpTo(*limit),
            Verdict::Critical(critical) => Self::Critical(CriticalReport::from(critical)),
        }
    }
}
