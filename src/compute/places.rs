//! The places of a wanted study: which, in which order, how hard, and the answer at each.

use crate::robot::{Robot, Vec2};
use crate::scenario::Scenario;
use crate::scenario::report::CriticalReport;
use crate::study::{Answer, Asked, Directions, Grid, Line, Study, Verdict, compass};

use super::protocol::{AskedChoice, DirectionsChoice, PlaceAnswer, StudyChoice, StudyJob, VerdictAnswer};

/// Elements of all cables of a place of weight 1, in one direction.
const USUAL_ELEMENTS: f64 = 40.0;
/// In a coarse map every so-many-th point of every so-many-th row is answered.
const COARSE: usize = 4;

/// A study with the robot it is of.
#[derive(Debug)]
pub struct Places {
    robot: Robot,
    study: Study,
}

impl Places {
    /// The study that `job` wants.
    ///
    /// # Errors
    /// A scenario that is not physical or a speed that is not greater than 0, with the reason.
    pub fn new(job: &StudyJob) -> Result<Self, String> {
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
        };
        Ok(Self { robot, study })
    }

    /// All of them, each once, in the order in which a picture becomes finer.
    pub fn order(&self) -> Vec<usize> {
        self.study.order()
    }

    /// Of that order, how many make a first picture: the map at a quarter of its resolution; none of other studies.
    pub fn coarse(&self) -> usize {
        match &self.study {
            Study::Map { grid, .. } => grid.nx.div_ceil(COARSE) * grid.ny.div_ceil(COARSE),
            _ => 0,
        }
    }

    /// About how much work a place is; 1 is a direction at a pose of a robot such as the paper's.
    pub fn weight(&self, place: usize) -> f64 {
        let elements = match &self.study {
            Study::Elements { counts, .. } => counts.get(place).copied().unwrap_or_default(),
            _ => self.robot.elements,
        };
        let directions = match &self.study {
            Study::Map { directions: Directions::Worst(count), .. } => *count as f64,
            _ => 1.0,
        };
        let size = (elements * self.robot.cables.len()) as f64 / USUAL_ELEMENTS;
        directions * size * size
    }

    /// The answer at one place.
    pub fn answer(&self, place: usize) -> PlaceAnswer {
        (&self.study.answer(&self.robot, place)).into()
    }

    /// The answer where the attempt at one fails.
    pub fn unknown(&self, place: usize) -> PlaceAnswer {
        let direction = match &self.study {
            Study::Line { line, .. } => line.direction,
            Study::Polar { count, .. } => compass(place, *count),
            Study::Map { asked: Asked::Growth { .. }, .. } => return PlaceAnswer::Growth(None),
            Study::Map { directions: Directions::One(direction), .. } | Study::Elements { direction, .. } => *direction,
            Study::Map { directions: Directions::Worst(_), .. } => Vec2::x(),
            Study::Speeds { .. } => return PlaceAnswer::Spectrum(None),
        };
        PlaceAnswer::Critical { direction: direction.into(), verdict: VerdictAnswer::NotConverged }
    }
}

/// A speed up to which to search, or why it is none.
pub(super) fn search_limit(value: f64) -> Result<f64, String> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(format!("the highest speed must be finite and greater than 0, not {value}"))
}

impl From<&Answer> for PlaceAnswer {
    fn from(answer: &Answer) -> Self {
        match answer {
            Answer::Critical { direction, verdict } => {
                Self::Critical { direction: (*direction).into(), verdict: verdict.into() }
            }
            Answer::Growth(rate) => Self::Growth(*rate),
            Answer::Spectrum(spectrum) => Self::Spectrum(
                spectrum.as_ref().map(|values| values.iter().map(|value| [value.re, value.im]).collect()),
            ),
        }
    }
}

impl From<&Verdict> for VerdictAnswer {
    fn from(verdict: &Verdict) -> Self {
        match verdict {
            Verdict::Infeasible => Self::Infeasible,
            Verdict::NotConverged => Self::NotConverged,
            Verdict::NoneUpTo(limit) => Self::NoneUpTo(*limit),
            Verdict::Critical(critical) => Self::Critical(CriticalReport::from(critical)),
        }
    }
}
