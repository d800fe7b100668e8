//! A flight as programs read it: `tautline/flight/1`, and as a table.

use std::fmt::Write as _;

use serde::Serialize;

use crate::flight::{self, Flight, FlightError, FlightOptions, Gain, Sample, Slack};
use crate::robot::{Robot, Trajectory};
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::stability::steps::step;
use crate::study::{LeastSpeed, PathSummary, WaveRatio};

/// The name and version of the format.
pub const SCHEMA: &str = "tautline/flight/1";

/// A flight with the growth along its path. SI units, cables counted from 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FlightReport {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// Whether there is a taut equilibrium all along the path.
    pub feasible: bool,
    /// Why there is none, or why the flight ends early, as a sentence.
    pub reason: Option<String>,
    /// How long the move takes, in s.
    pub duration: f64,
    /// Until when it was to be flown, in s.
    pub end: f64,
    /// In m.
    pub max_deviation: Option<f64>,
    /// In m; of a flight that goes on after the move.
    pub residual: Option<f64>,
    /// The first moment at which an element has to push.
    pub slack: Option<SlackReport>,
    /// How many times larger a vibration can be after the move.
    pub gain: Option<GainReport>,
    /// exp ∫ max Re λ dt.
    pub frozen_growth: Option<f64>,
    /// The largest v over the wave limit.
    pub wave_ratio: Option<WaveRatioReport>,
    /// The least frozen critical speed along the path.
    pub least_critical_speed: Option<LeastReport>,
    /// The least wave limit along the path.
    pub least_wave_limit: Option<LeastReport>,
    /// Equally spaced in time.
    pub samples: Vec<SampleReport>,
    /// The same for the table.
    #[serde(skip)]
    table: Vec<Sample>,
}

/// An element that has to push.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SlackReport {
    /// In s.
    pub time: f64,
    /// 1-based.
    pub cable: usize,
    /// The least force of the whole flight, in N.
    pub force: f64,
}

impl From<Slack> for SlackReport {
    fn from(Slack { time, cable, force }: Slack) -> Self {
        Self { time, cable: cable + 1, force }
    }
}

/// Amplitude ratios.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GainReport {
    /// By the root of the action.
    pub action: f64,
    /// By the root of the energy.
    pub energy: f64,
    /// By the displacement.
    pub displacement: f64,
}

impl From<Gain> for GainReport {
    fn from(Gain { action, energy, displacement }: Gain) -> Self {
        Self { action, energy, displacement }
    }
}

/// How near a move comes to the wave limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WaveRatioReport {
    /// ρ: below 1 nothing grows without bound.
    pub value: f64,
    /// Arc length in m.
    pub s: f64,
    /// 1-based.
    pub cable: usize,
    /// Whether that cable is reeled in.
    pub reeled_in: bool,
}

impl From<WaveRatio> for WaveRatioReport {
    fn from(WaveRatio { value, s, cable, reeled_in }: WaveRatio) -> Self {
        Self { value, s, cable: cable + 1, reeled_in }
    }
}

/// The least of a speed along a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LeastReport {
    /// In m/s.
    pub speed: f64,
    /// Arc length in m.
    pub s: f64,
}

impl From<LeastSpeed> for LeastReport {
    fn from(LeastSpeed { speed, s }: LeastSpeed) -> Self {
        Self { speed, s }
    }
}

/// The flight at one time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SampleReport {
    /// In s.
    pub t: f64,
    /// Arc length in m.
    pub s: f64,
    /// In m/s.
    pub v: f64,
    /// In m/s².
    pub a: f64,
    /// In m.
    pub deviation: [f64; 2],
    /// In m/s.
    pub deviation_velocity: [f64; 2],
    /// Of each cable, in N.
    pub tension_at_platform: Vec<f64>,
    /// Of the last element of each cable, in N.
    pub element_force_at_winch: Vec<f64>,
    /// Of each cable, in m.
    pub unstretched_length: Vec<f64>,
    /// In N.
    pub smallest_element_force: f64,
}

impl From<&Sample> for SampleReport {
    fn from(sample: &Sample) -> Self {
        let each = |of: fn(&flight::CableSample) -> f64| sample.cables.iter().map(of).collect();
        Self {
            t: sample.time,
            s: sample.s,
            v: sample.v,
            a: sample.a,
            deviation: sample.deviation.into(),
            deviation_velocity: sample.deviation_velocity.into(),
            tension_at_platform: each(|cable| cable.tension),
            element_force_at_winch: each(|cable| cable.winch_element_force),
            unstretched_length: each(|cable| cable.length),
            smallest_element_force: sample.smallest_element_force,
        }
    }
}

impl FlightReport {
    /// Flies `robot` along `trajectory` and computes the growth along it, in [steps](crate::steps).
    pub async fn in_steps(robot: &Robot, trajectory: &Trajectory, options: &FlightOptions) -> Self {
        let hold = if trajectory.is_rest_to_rest() { options.hold } else { 0.0 };
        let mut report = Self {
            schema: SCHEMA,
            feasible: true,
            reason: None,
            duration: trajectory.duration(),
            end: trajectory.duration() + hold,
            max_deviation: None,
            residual: None,
            slack: None,
            gain: None,
            frozen_growth: None,
            wave_ratio: None,
            least_critical_speed: None,
            least_wave_limit: None,
            samples: Vec::new(),
            table: Vec::new(),
        };
        match flight::fly_in_steps(robot, trajectory, options).await {
            Ok(flight) => report.take(flight),
            Err(error) => {
                report.fail(&error);
                return report;
            }
        }
        step().await;
        match PathSummary::in_steps(robot, trajectory, DEFAULT_MAX_SPEED).await {
            Ok(summary) => {
                report.frozen_growth = summary.frozen_growth;
                report.wave_ratio = summary.wave_ratio.map(WaveRatioReport::from);
                report.least_critical_speed = summary.least_critical_speed.map(LeastReport::from);
                report.least_wave_limit = summary.least_wave_limit.map(LeastReport::from);
            }
            Err(error) => report.fail(&error),
        }
        match flight::gain_in_steps(robot, trajectory, None).await {
            Ok(gain) => report.gain = gain.map(GainReport::from),
            Err(error) => report.fail(&error),
        }
        report
    }

    fn take(&mut self, flight: Flight) {
        self.max_deviation = Some(flight.max_deviation);
        self.residual = flight.residual;
        self.slack = flight.slack.map(SlackReport::from);
        self.samples = flight.samples.iter().map(SampleReport::from).collect();
        if let Some(time) = flight.lost {
            self.reason = Some(format!("the flight could not be computed any further at {time:.4} s"));
        }
        self.table = flight.samples;
    }

    /// A path without an equilibrium is not feasible; what cannot be computed otherwise leaves the rest as it is.
    fn fail(&mut self, error: &FlightError) {
        self.feasible &= !matches!(error, FlightError::Statics { reason, .. } if reason.feasible() == Some(false));
        self.reason.get_or_insert_with(|| error.to_string());
    }

    /// The samples as CSV: `t,s,x,y,v,a,dx,dy`, then of each cable its length, rate, acceleration, tension at the platform and
    /// at the winch.
    pub fn csv(&self, cables: usize) -> String {
        let mut text = csv_header("t,s,x,y,v,a,dx,dy", cables);
        for sample in &self.table {
            let Sample { time, s, v, a, .. } = sample;
            let [x, y]: [f64; 2] = sample.position.into();
            let [dx, dy]: [f64; 2] = sample.deviation.into();
            // Writing to a string does not fail.
            let _ = write!(text, "{time},{s},{x},{y},{v},{a},{dx},{dy}");
            for cable in &sample.cables {
                let flight::CableSample { length, rate, acceleration, tension, winch_tension, .. } = cable;
                let _ = write!(text, ",{length},{rate},{acceleration},{tension},{winch_tension}");
            }
            text.push('\n');
        }
        text
    }
}

/// The first columns, and those of each cable behind them.
pub(crate) fn csv_header(first: &str, cables: usize) -> String {
    let of_cable = |i: usize| format!(",length_{i},rate_{i},acceleration_{i},tension_{i},winch_tension_{i}");
    let cables: String = (1..=cables).map(of_cable).collect();
    format!("{first}{cables}\n")
}
