//! The core for JavaScript, without interface and engine: what is inside the npm package `tautline` (`web/npm`).
//!
//! Scenarios, options and results cross the border as JSON text, read and written as for the command line;
//! `web/npm/index.js` makes objects of it. What is wrong with the input becomes a JavaScript `Error`.

use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::robot::{Motion, Robot, Trajectory};
use crate::scenario::flight_report::FlightReport;
use crate::scenario::limits_report::LimitsReport;
use crate::scenario::options::{self, MapOptions, max_speed};
use crate::scenario::report::{CriticalReport, KindReport, StatusReport, WaveLimitReport};
use crate::scenario::{Report, Scenario};
use crate::stability::steps::Steps;
use crate::study::{Answer, Directions, Grid, Mapped, Study, Verdict};

type Text = Result<String, JsError>;

/// The whole analysis: `tautline/analysis/1`.
///
/// # Errors
/// All that is wrong with the scenario or the options.
#[wasm_bindgen]
pub fn analyze(scenario: &str, options: &str) -> Text {
    let (robot, motion) = read(scenario)?;
    Ok(serde_json::to_string(&Report::analyze(&robot, &motion, max_speed(options)?))?)
}

/// The critical speed alone, or why there is none.
///
/// # Errors
/// All that is wrong with the scenario or the options.
#[wasm_bindgen(js_name = criticalSpeed)]
pub fn critical_speed(scenario: &str, options: &str) -> Text {
    let (robot, motion) = read(scenario)?;
    let report = Report::critical_speed(&robot, &motion, max_speed(options)?);
    let Report { feasible, reason, critical, searched_up_to, wave_limit, status, .. } = report;
    let critical = critical.into();
    Ok(serde_json::to_string(&CriticalSpeed { feasible, reason, critical, searched_up_to, wave_limit, status })?)
}

/// A long computation whose result is JSON text, step by step, so that the page can do something else between.
#[wasm_bindgen]
pub struct Computation(Steps<Text>);

#[wasm_bindgen]
impl Computation {
    /// The flight along the scenario's path: `tautline/flight/1`. Nothing is computed yet.
    ///
    /// # Errors
    /// All that is wrong with the scenario or the options.
    pub fn fly(scenario: &str, options: &str) -> Result<Self, JsError> {
        let (robot, trajectory, hold) = move_of(scenario)?;
        let options = options::flight(options, hold)?;
        Ok(Self(Steps::new(async move {
            Ok(serde_json::to_string(&FlightReport::in_steps(&robot, &trajectory, &options).await)?)
        })))
    }

    /// The fastest move along the scenario's path: `tautline/limits/1`. Nothing is computed yet.
    ///
    /// # Errors
    /// All that is wrong with the scenario or the options.
    pub fn limits(scenario: &str, options: &str) -> Result<Self, JsError> {
        let (robot, trajectory, _) = move_of(scenario)?;
        let options = options::limits(options)?;
        Ok(Self(Steps::new(async move {
            Ok(serde_json::to_string(&LimitsReport::in_steps(&robot, &trajectory, &options).await)?)
        })))
    }

    /// Does the next step; the text after the last one.
    ///
    /// # Errors
    /// None in practice: every result can be written.
    pub fn advance(&mut self) -> Result<Option<String>, JsError> {
        self.0.advance().transpose()
    }
}

/// The robot of a scenario, its trajectory, and how long a flight goes on after it, in s.
fn move_of(scenario: &str) -> Result<(Robot, Trajectory, f64), JsError> {
    let scenario = Scenario::from_json(scenario)?;
    let (robot, _) = scenario.to_robot()?;
    let hold = scenario.path.as_ref().map_or(0.0, |path| path.hold);
    let trajectory = scenario.trajectory();
    let trajectory = trajectory.ok_or_else(|| JsError::new("path: missing; allowed: a path to fly along"))?;
    Ok((robot, trajectory, hold))
}

/// A map over the workspace, to be computed row by row of its table, so that the page can do something else between.
#[wasm_bindgen]
pub struct MapStudy {
    robot: Robot,
    grid: Grid,
    study: Study,
}

#[wasm_bindgen]
impl MapStudy {
    /// Checks the input; nothing is computed yet.
    ///
    /// # Errors
    /// All that is wrong with the scenario or the options.
    #[wasm_bindgen(constructor)]
    pub fn new(scenario: &str, options: &str) -> Result<Self, JsError> {
        let (robot, motion) = read(scenario)?;
        let MapOptions { nx, ny, directions, limit } = MapOptions::from_json(options)?;
        let grid = Grid::of(&robot, nx, ny);
        let directions = directions.unwrap_or(Directions::One(motion.direction()));
        let study = Study::Map { grid, directions, mapped: Mapped::Critical { limit } };
        Ok(Self { robot, grid, study })
    }

    /// How many rows the table has.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.grid.len()
    }

    /// Computes one row of the table, as the command line's CSV has it.
    ///
    /// # Errors
    /// None in practice: every row can be written.
    pub fn row(&self, index: usize) -> Text {
        let (verdict, wave_limit) = match self.study.answer(&self.robot, index) {
            Answer::Critical { verdict, wave_limit, .. } => (verdict, wave_limit),
            // Not what this study asks for.
            _ => (Verdict::Unknown, None),
        };
        let at = self.grid.position(index);
        let found = Found::from(verdict.critical().map(CriticalReport::from));
        let Found { speed, frequency_hz, kind, cable } = found;
        Ok(serde_json::to_string(&Row {
            x: at.x,
            y: at.y,
            feasible: verdict.feasible(),
            critical_speed: speed,
            frequency_hz,
            kind,
            cable,
            wave_limit,
            status: verdict.status().into(),
        })?)
    }
}

fn read(scenario: &str) -> Result<(Robot, Motion), JsError> {
    Ok(Scenario::from_json(scenario)?.to_robot()?)
}

#[derive(Serialize)]
struct CriticalSpeed {
    feasible: Option<bool>,
    reason: Option<String>,
    #[serde(flatten)]
    critical: Found,
    searched_up_to: f64,
    wave_limit: Option<WaveLimitReport>,
    status: Option<StatusReport>,
}

#[derive(Serialize)]
struct Row {
    x: f64,
    y: f64,
    feasible: Option<bool>,
    critical_speed: Option<f64>,
    frequency_hz: Option<f64>,
    kind: Option<KindReport>,
    cable: Option<usize>,
    wave_limit: Option<f64>,
    status: StatusReport,
}

/// A critical speed, or null for each of its fields.
#[derive(Default, Serialize)]
struct Found {
    speed: Option<f64>,
    frequency_hz: Option<f64>,
    kind: Option<KindReport>,
    cable: Option<usize>,
}

impl From<Option<CriticalReport>> for Found {
    fn from(critical: Option<CriticalReport>) -> Self {
        critical.map_or_else(Self::default, |CriticalReport { speed, frequency_hz, kind, cable }| Self {
            speed: Some(speed),
            frequency_hz: Some(frequency_hz),
            kind: Some(kind),
            cable: Some(cable),
        })
    }
}
