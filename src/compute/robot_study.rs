//! A wanted study of a robot: whether it can be done, its places in their order, how hard each is, and the answer at each.

use std::sync::Arc;
use std::sync::atomic::{AtomicU16, Ordering};

use nalgebra::Complex;

use crate::flight::{FlightOptions, LimitOptions};
use crate::robot::{Motion, Robot, Trajectory, Vec2};
use crate::scenario::Scenario;
use crate::stability::{ALLOWED_LIMIT, Steps, is_limit};
use crate::study::{Answer, Directions, Mapped, Reach, Study, Topic, Varied, WhatIf, flown_in_steps};

use super::protocol::StudyJob;
use super::variants::Variants;

/// A place that looks in one direction has weight 1 if all cables together have this number of elements.
const USUAL_ELEMENTS: f64 = 40.0;
/// Joining spectra to modes has weight 1 where the cubes of their numbers of eigenvalues add up to this.
const USUAL_CUBES: f64 = 1e6;
/// A row of so many points has weight 1 where only statics are asked for.
const USUAL_COLUMNS: f64 = 20.0;
/// A coarse map has every 4th point of every 4th row.
const COARSE: usize = 4;
/// How many critical speeds take as long as one stretch in which a value is looked for, about.
const SPEEDS_OF_A_STRETCH: f64 = 8.0;
/// How many critical speeds take as long as what a move does to vibrations, about.
const SPEEDS_OF_A_MOVE: f64 = 20.0;
/// How many critical speeds take as long as a flight, about.
const SPEEDS_OF_A_FLIGHT: f64 = 20.0;
/// The most samples of a flight.
const MOST_SAMPLES: usize = 10_000;
/// The most numbers that a study may vary.
const MOST_VARIED: usize = 2;
/// The most places of a study, and the most directions at one place. The page asks for far fewer, so a message with more is
/// none of the page's.
const MOST_PLACES: usize = 1 << 20;
const MOST_DIRECTIONS: usize = 360;

/// A study together with its robot, both checked.
#[derive(Debug)]
pub struct RobotStudy {
    robot: Robot,
    scenario: Scenario,
    /// The scenario's, where it has a path.
    trajectory: Option<Trajectory>,
    /// How much of it is flown, in percent.
    percent: AtomicU16,
    variants: Variants,
    study: Study,
}

impl RobotStudy {
    /// The study that `job` wants.
    ///
    /// # Errors
    /// A scenario that is not physical, or numbers that a study must not have, with the reason.
    pub fn new(job: &StudyJob) -> Result<Self, String> {
        check(&job.study)?;
        let scenario = Scenario::from_json(&job.scenario).map_err(|faults| faults.to_string())?;
        let (robot, _) = scenario.to_robot().map_err(|faults| faults.to_string())?;
        let trajectory = scenario.trajectory();
        if matches!(job.study.topic(), Topic::Path | Topic::Gains | Topic::Move | Topic::Allowed | Topic::Flight)
            && trajectory.is_none()
        {
            return Err("the scenario has no path".into());
        }
        let variants = Variants::new(scenario.clone(), job.study.varied())?;
        let percent = AtomicU16::new(0);
        Ok(Self { robot, scenario, trajectory, percent, variants, study: job.study.clone() })
    }

    /// All places, each once, in the order in which a picture becomes finer.
    pub fn order(&self) -> Vec<usize> {
        self.study.order()
    }

    /// How many places, the first ones in that order, make a first picture: the map at a quarter of its resolution; none
    /// of other studies.
    pub fn coarse(&self) -> usize {
        match &self.study {
            Study::Map { grid, .. } => grid.nx.div_ceil(COARSE) * grid.ny.div_ceil(COARSE),
            _ => 0,
        }
    }

    /// About how much work a place is. One direction at one pose of a robot like the paper's has weight 1.
    pub fn weight(&self, place: usize) -> f64 {
        let elements = match &self.study {
            // Joining two spectra takes a time that grows with the cube of their size.
            Study::Modes { spectra } => {
                let cubes = spectra.iter().map(|(_, eigenvalues)| (eigenvalues.len() as f64).powi(3));
                return (cubes.sum::<f64>() / USUAL_CUBES).max(1.0);
            }
            Study::Mesh { counts, .. } => counts.get(place).copied().unwrap_or_default(),
            // The number of elements may be what is varied.
            Study::WhatIf(what_if) => self.variants.at(&what_if.values(place)).map_or(0, |(robot, _)| robot.elements),
            _ => self.robot.elements,
        };
        let elements_of_all = (elements * self.robot.cables.len()) as f64 / USUAL_ELEMENTS;
        // Statics alone, but at the points of two rows; they take a time that grows with the number of elements.
        if let Study::Border { grid } = &self.study {
            return elements_of_all * grid.nx as f64 / USUAL_COLUMNS;
        }
        let searches = match &self.study {
            Study::Map { directions: Directions::Worst(count), .. } => *count as f64,
            Study::Reach(_) => SPEEDS_OF_A_STRETCH,
            Study::Gains { .. } | Study::Move | Study::Allowed(_) => SPEEDS_OF_A_MOVE,
            Study::Flight { .. } => SPEEDS_OF_A_FLIGHT,
            _ => 1.0,
        };
        searches * elements_of_all * elements_of_all
    }

    /// The answer at one place, step by step.
    pub fn answer(self: &Arc<Self>, place: usize) -> Steps<Answer> {
        let places = Arc::clone(self);
        Steps::new(async move {
            if let (Study::Flight { options }, Some(trajectory)) = (&places.study, &places.trajectory) {
                return Answer::Flight(Box::new(
                    flown_in_steps(&places.robot, trajectory, options, |part| places.flown(part)).await,
                ));
            }
            let variant = |values: &[f64]| places.variants.at(values);
            if let Some(answer) = places.study.varied_in_steps(&variant, place).await {
                return answer;
            }
            let moves = |speed| places.trajectory(speed);
            if let Some(answer) = places.study.moved_in_steps(&places.robot, &moves, place).await {
                return answer;
            }
            places.study.answer_in_steps(&places.robot, place).await
        })
    }

    /// The trajectory of the scenario's path, with another speed of its profile (m/s) where one is given.
    fn trajectory(&self, speed: Option<f64>) -> Option<Trajectory> {
        let mut scenario = self.scenario.clone();
        if let (Some(path), Some(speed)) = (&mut scenario.path, speed) {
            path.speed = speed;
        }
        scenario.trajectory()
    }

    fn flown(&self, part: f64) {
        // A part of one.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        self.percent.store((100.0 * part) as u16, Ordering::Relaxed);
    }

    /// How much of its one place is done, in percent; `None` of studies of many places, which are told by those.
    pub fn percent(&self) -> Option<u16> {
        matches!(self.study, Study::Flight { .. }).then(|| self.percent.load(Ordering::Relaxed))
    }

    /// The answer at a place where every attempt has failed.
    pub fn unknown(&self, place: usize) -> Answer {
        self.study.unknown(place)
    }
}

/// Whether a study can be done: a message may hold any numbers.
fn check(study: &Study) -> Result<(), String> {
    if study.len() > MOST_PLACES {
        return Err(format!("a study of {} places; allowed: at most {MOST_PLACES}", study.len()));
    }
    let motion = |position: Vec2, direction: Vec2, speed: f64| {
        Motion::new(position, direction, speed).map(drop).map_err(|faults| faults.to_string())
    };
    match study {
        Study::Line { line, limit } => {
            motion(line.from, line.direction, 0.0)?;
            motion(line.to, line.direction, 0.0)?;
            search_limit(*limit)?;
        }
        Study::Map { grid, directions, mapped } => {
            let direction = match directions {
                Directions::One(direction) => *direction,
                Directions::Worst(count) if *count > MOST_DIRECTIONS => {
                    return Err(format!("the worst of {count} directions; allowed: at most {MOST_DIRECTIONS}"));
                }
                Directions::Worst(_) => Vec2::x(),
            };
            let speed = match mapped {
                Mapped::Critical { limit } => search_limit(*limit).map(|_| 0.0)?,
                Mapped::Growth { speed } => *speed,
            };
            motion(grid.low, direction, speed)?;
            motion(grid.high, direction, speed)?;
        }
        Study::Directions { position, limit, .. } => {
            motion(*position, Vec2::x(), 0.0)?;
            search_limit(*limit)?;
        }
        Study::Campbell { position, direction, to: highest, .. }
        | Study::Mesh { position, direction, limit: highest, .. } => {
            motion(*position, *direction, 0.0)?;
            search_limit(*highest)?;
        }
        Study::Modes { spectra } => {
            let finite = |value: &Complex<f64>| value.re.is_finite() && value.im.is_finite();
            if !spectra.iter().all(|(speed, values)| speed.is_finite() && values.iter().all(finite)) {
                return Err("speeds and eigenvalues must be finite".into());
            }
        }
        Study::Border { grid } => {
            if grid.len() > MOST_PLACES {
                return Err(format!("a border at {} points; allowed: at most {MOST_PLACES}", grid.len()));
            }
            motion(grid.low, Vec2::x(), 0.0)?;
            motion(grid.high, Vec2::x(), 0.0)?;
        }
        Study::WhatIf(WhatIf { numbers, limit }) => {
            search_limit(*limit)?;
            if !(1..=MOST_VARIED).contains(&numbers.len()) {
                return Err(format!("{} numbers are varied; allowed: 1 or {MOST_VARIED}", numbers.len()));
            }
        }
        Study::Path { limit, .. } => {
            search_limit(*limit)?;
        }
        Study::Gains { speeds } => {
            for speed in speeds {
                search_limit(*speed)?;
            }
        }
        Study::Allowed(allowed) => {
            let LimitOptions { safety, slack, acceleration, winch_speed, winch_acceleration, .. } = allowed.options;
            for limit in [Some(safety), slack, acceleration, winch_speed, winch_acceleration].into_iter().flatten() {
                if !(limit > 0.0 && limit.is_finite()) {
                    return Err(format!("a limit is {limit}; allowed: more than 0, finite"));
                }
            }
        }
        Study::Move => {}
        Study::Flight { options } => flight_options(options)?,
        Study::Reach(Reach { target, limit, .. }) => {
            search_limit(*limit)?;
            search_limit(*target)?;
            if target > limit {
                return Err(format!("the wanted critical speed is {target}; allowed: at most {limit}, the limit"));
            }
        }
    }
    for Varied { path, values } in study.varied() {
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return Err(format!("{path}: a value is {value}; allowed: finite numbers"));
        }
    }
    Ok(())
}

/// Whether a flight can be asked for this.
fn flight_options(options: &FlightOptions) -> Result<(), String> {
    let FlightOptions { kick, hold, accuracy, samples, .. } = *options;
    if !(kick.iter().all(|part| part.is_finite()) && hold.is_finite() && hold >= 0.0) {
        return Err("kick and hold must be finite, the hold at least 0".into());
    }
    if !(accuracy.is_finite() && accuracy > 0.0) {
        return Err(format!("the accuracy is {accuracy}; allowed: finite numbers greater than 0"));
    }
    if samples > MOST_SAMPLES {
        return Err(format!("a flight with {samples} samples; allowed: at most {MOST_SAMPLES}"));
    }
    Ok(())
}

/// A speed up to which to search, or why it is none.
pub(super) fn search_limit(value: f64) -> Result<f64, String> {
    if is_limit(value) { Ok(value) } else { Err(format!("the highest speed is {value}; allowed: {ALLOWED_LIMIT}")) }
}
