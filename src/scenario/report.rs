//! The analysis as programs read it: `tautline/analysis/1`, on the command line and in the page.

use nalgebra::Complex;
use serde::{Deserialize, Serialize};

use crate::mechanics::{CableShape, Failure, LengthRates, SlackAcceleration, SlackLimit, StaticsError, WaveLimit};
use crate::robot::{Motion, Robot};
use crate::scenario::Parameter;
use crate::stability::steps::finish_watched;
use crate::stability::{
    Critical, CriticalSearch, Eigenproblem, Instability, Method, NotConverged, Spectrum, unstable_eigenvalues,
};
use crate::study::{Knob, LocalProblem, Status};

/// The name and version of the format.
pub const SCHEMA: &str = "tautline/analysis/1";
/// Up to this speed (m/s) the critical speed is searched for, unless told otherwise.
pub const DEFAULT_MAX_SPEED: f64 = 40.0;

/// One analysis. SI units; arrays that could not be computed are empty.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// [`SCHEMA`].
    pub schema: String,
    /// Whether the pose has a taut equilibrium, which is the statics' answer; `None` where they could not be computed.
    pub feasible: Option<bool>,
    /// Why not, or why the answer is not complete, as a sentence.
    pub reason: Option<String>,
    /// One entry per cable.
    pub cables: Vec<CableReport>,
    /// The scenario's speed in m/s.
    pub speed: f64,
    /// All eigenvalues [Re λ, Im λ] at that speed, multiplicity included, in 1/s.
    pub eigenvalues: Vec<[f64; 2]>,
    /// The largest Re λ, in 1/s.
    pub max_growth_rate: Option<f64>,
    /// Whether every Re λ < 0.
    pub stable: Option<bool>,
    /// Whether the robot is stable at v = 0.
    pub stable_at_rest: Option<bool>,
    /// How the search for the critical speed ended; `None` while it goes on.
    pub status: Option<StatusReport>,
    /// The first crossing, where one was found.
    pub critical: Option<CriticalReport>,
    /// The speed in m/s up to which it was searched.
    pub searched_up_to: f64,
    /// The speed at which a winch reels as fast as waves run along its cable, where a cable moves.
    pub wave_limit: Option<WaveLimitReport>,
    /// The acceleration from rest at which a cable goes slack, by statics; in flight it goes slack earlier.
    pub slack_acceleration: Option<SlackAccelerationReport>,
}

/// How the search for a critical speed ended, as tables and analyses tell it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StatusReport {
    /// There is one.
    Found,
    /// There is none up to the limit of the search.
    None,
    /// There is no taut equilibrium to begin with.
    Infeasible,
    /// It could not be computed.
    Failed,
}

impl From<Status> for StatusReport {
    fn from(status: Status) -> Self {
        match status {
            Status::Found => Self::Found,
            Status::None => Self::None,
            Status::Infeasible => Self::Infeasible,
            Status::Failed => Self::Failed,
        }
    }
}

impl std::fmt::Display for StatusReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Found => "found",
            Self::None => "none",
            Self::Infeasible => "infeasible",
            Self::Failed => "failed",
        })
    }
}

/// The speed at which a winch reels as fast as waves run along its cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaveLimitReport {
    /// Of the platform, in m/s.
    pub speed: f64,
    /// The cable that reaches it first, 1-based.
    pub cable: usize,
    /// Whether that cable is reeled in.
    pub reeled_in: bool,
}

impl From<WaveLimit> for WaveLimitReport {
    fn from(WaveLimit { speed, cable, reeled_in }: WaveLimit) -> Self {
        Self { speed, cable: cable + 1, reeled_in }
    }
}

/// How hard the platform may speed up or brake from rest before a cable goes slack, by statics.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SlackAccelerationReport {
    /// Along the motion; `None` where no cable goes slack.
    pub accelerating: Option<SlackLimitReport>,
    /// Against it, as a positive number.
    pub braking: Option<SlackLimitReport>,
    /// The platform's deviation in m per m/s².
    pub deviation_per_acceleration: f64,
}

/// The acceleration at which a cable goes slack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SlackLimitReport {
    /// In m/s².
    pub value: f64,
    /// The cable, 1-based.
    pub cable: usize,
}

impl From<SlackLimit> for SlackLimitReport {
    fn from(SlackLimit { value, cable }: SlackLimit) -> Self {
        Self { value, cable: cable + 1 }
    }
}

impl From<SlackAcceleration> for SlackAccelerationReport {
    fn from(slack: SlackAcceleration) -> Self {
        Self {
            accelerating: slack.accelerating.map(SlackLimitReport::from),
            braking: slack.braking.map(SlackLimitReport::from),
            deviation_per_acceleration: slack.deviation_per_acceleration,
        }
    }
}

/// One cable at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CableReport {
    /// L in m.
    pub unstretched_length: f64,
    /// In N.
    pub tension_at_platform: f64,
    /// In N.
    pub tension_at_winch: f64,
    /// dL/dσ.
    pub length_rate: f64,
    /// d²L/dσ² in 1/m.
    pub length_curvature: f64,
    /// From the platform to the winch, in m.
    pub nodes: Vec<[f64; 2]>,
}

/// The critical speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CriticalReport {
    /// In m/s.
    pub speed: f64,
    /// |Im λ|/2π of the crossing eigenvalue, in Hz.
    pub frequency_hz: f64,
    /// How stability is lost.
    pub kind: KindReport,
    /// The responsible cable, 1-based.
    pub cable: usize,
}

/// How stability is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum KindReport {
    /// An oscillation grows.
    Flutter,
    /// A displacement grows without oscillating.
    Divergence,
}

impl From<Instability> for KindReport {
    fn from(kind: Instability) -> Self {
        match kind {
            Instability::Flutter => Self::Flutter,
            Instability::Divergence => Self::Divergence,
        }
    }
}

impl std::fmt::Display for KindReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Flutter => "flutter",
            Self::Divergence => "divergence",
        })
    }
}

/// A parameter's name in tables. What a cable has of its own has the name of its field in a scenario file.
pub fn parameter(knob: Knob) -> String {
    match knob {
        Knob::YoungsModulus => "youngs_modulus".into(),
        Knob::Area => "area".into(),
        Knob::MassPerLength => "mass_per_length".into(),
        Knob::OwnYoungsModulus(cable) => Parameter::OwnYoungsModulus(cable).path(),
        Knob::OwnArea(cable) => Parameter::OwnArea(cable).path(),
        Knob::OwnMassPerLength(cable) => Parameter::OwnMassPerLength(cable).path(),
        Knob::PlatformMass => "platform_mass".into(),
        Knob::Tension(cable) => format!("tension_{}", cable + 1),
        Knob::Alpha => "alpha".into(),
        Knob::Beta => "beta".into(),
        Knob::Gravity => "gravity".into(),
    }
}

impl CableReport {
    fn new(shape: &CableShape, rates: LengthRates) -> Self {
        Self {
            unstretched_length: shape.length,
            tension_at_platform: shape.tension_at_platform,
            tension_at_winch: shape.tension_at_winch,
            length_rate: rates.first,
            length_curvature: rates.second,
            nodes: shape.nodes.iter().map(|node| [node.x, node.y]).collect(),
        }
    }
}

impl From<&Critical> for CriticalReport {
    fn from(critical: &Critical) -> Self {
        Self {
            speed: critical.speed,
            frequency_hz: critical.frequency_hz(),
            kind: critical.kind.into(),
            cable: critical.cable + 1,
        }
    }
}

impl Report {
    /// The report of a pose moving at `speed` (m/s) whose critical speed is not known yet: [`Self::set_critical`]
    /// completes it. Where the eigenvalues could not be computed all else stays, and stability is told by their count.
    pub fn of_pose(local: &LocalProblem, speed: f64, spectrum: Option<&Spectrum>) -> Self {
        let Some(spectrum) = spectrum else {
            let reason = Some(sentence(&NotConverged.to_string()));
            return Self { reason, ..Self::without_eigenvalues(local, speed) };
        };
        Self {
            eigenvalues: spectrum.eigenvalues().map(|Complex { re, im }| [re, im]).collect(),
            max_growth_rate: Some(spectrum.growth_rate()),
            stable: Some(spectrum.is_stable()),
            ..Self::at_rest(local, speed)
        }
    }

    /// The report of a pose whose eigenvalues are still being computed: whether it is stable is told by their count.
    pub fn without_eigenvalues(local: &LocalProblem, speed: f64) -> Self {
        let stable = unstable_eigenvalues(&local.vibration, speed).map(|count| count == 0);
        Self { stable, ..Self::at_rest(local, speed) }
    }

    /// The report of a pose whose eigenvalues at `speed` (m/s) are not known.
    fn at_rest(local: &LocalProblem, speed: f64) -> Self {
        let cables = local.statics.cables.iter().zip(&local.rates);
        Self {
            feasible: Some(true),
            reason: None,
            cables: cables.map(|(shape, &rates)| CableReport::new(shape, rates)).collect(),
            stable_at_rest: Some(local.vibration.is_stable_at_rest()),
            wave_limit: local.wave_limit.map(WaveLimitReport::from),
            slack_acceleration: local.slack_acceleration.map(SlackAccelerationReport::from),
            ..Self::unknown("", speed)
        }
    }

    /// The report where nothing is known of the pose, not even whether it is feasible.
    pub fn unknown(reason: &str, speed: f64) -> Self {
        Self {
            schema: SCHEMA.into(),
            feasible: None,
            reason: Some(reason.into()),
            cables: Vec::new(),
            speed,
            eigenvalues: Vec::new(),
            max_growth_rate: None,
            stable: None,
            stable_at_rest: None,
            status: None,
            critical: None,
            searched_up_to: 0.0,
            wave_limit: None,
            slack_acceleration: None,
        }
    }

    /// The report of a pose without statics, or without vibrations that can be computed, and a search that was to go up to
    /// `limit` (m/s).
    pub fn without_pose(failure: &Failure, speed: f64, limit: f64) -> Self {
        let feasible = failure.reason.feasible();
        Self {
            feasible,
            status: Some(if feasible == Some(false) { StatusReport::Infeasible } else { StatusReport::Failed }),
            searched_up_to: limit,
            ..Self::unknown(&failure_sentence(failure), speed)
        }
    }

    /// Enters the end of the search for the critical speed up to `limit`: what was found, if anything was.
    pub fn set_critical(&mut self, critical: Option<&Critical>, limit: f64) {
        self.searched_up_to = limit;
        self.status = Some(if critical.is_some() { StatusReport::Found } else { StatusReport::None });
        self.critical = critical.map(CriticalReport::from);
    }

    /// Enters that the search has failed for a `reason`, a sentence, after it had come to a speed (m/s): the critical speed
    /// is not known, all else stays.
    pub fn set_failed(&mut self, reason: String, searched_up_to: f64) {
        self.searched_up_to = searched_up_to;
        (self.status, self.critical) = (Some(StatusReport::Failed), None);
        self.reason = Some(reason);
    }

    /// The whole analysis in one go, the critical speed searched up to `limit` (m/s).
    pub fn analyze(robot: &Robot, motion: &Motion, limit: f64) -> Self {
        Self::analyze_watched(robot, motion, limit, Method::default(), |_| {})
    }

    /// The same by `method`, calling `watch` with the speed (m/s) up to which the search has come, again and again.
    pub fn analyze_watched(robot: &Robot, motion: &Motion, limit: f64, method: Method, watch: impl FnMut(f64)) -> Self {
        let speed = motion.speed();
        let local = match LocalProblem::new(robot, motion) {
            Ok(local) => local,
            Err(failure) => return Self::without_pose(&failure, speed, limit),
        };
        let spectrum = match method {
            Method::Structured => local.spectrum(speed),
            Method::Dense => Eigenproblem::new(&local.vibration).and_then(|problem| problem.spectrum(speed)),
        };
        let mut report = Self::of_pose(&local, speed, spectrum.as_ref().ok());
        report.search(&local, limit, method, watch);
        report
    }

    /// The statics and the critical speed, searched up to `limit` (m/s), without what belongs to the motion's own speed:
    /// for those who ask again and again.
    pub fn critical_speed(robot: &Robot, motion: &Motion, limit: f64) -> Self {
        let local = match LocalProblem::new(robot, motion) {
            Ok(local) => local,
            Err(failure) => return Self::without_pose(&failure, motion.speed(), limit),
        };
        let mut report = Self::at_rest(&local, motion.speed());
        report.search(&local, limit, Method::default(), |_| {});
        report
    }

    fn search(&mut self, local: &LocalProblem, limit: f64, method: Method, mut watch: impl FnMut(f64)) {
        let search = CriticalSearch::by(method, limit);
        match finish_watched(search.run_in_steps(&local.vibration), || watch(search.searched_up_to())) {
            Ok(outcome) => self.set_critical(outcome.critical(), limit),
            Err(error) => self.set_failed(sentence(&error.to_string()), search.searched_up_to()),
        }
    }
}

/// Why a pose has no answer, as a sentence.
pub fn failure_sentence(failure: &Failure) -> String {
    match failure.reason {
        StaticsError::Infeasible(reason) => sentence(&format!("no static equilibrium here: {reason}")),
        StaticsError::NotConverged { .. } | StaticsError::OutOfRange => sentence(&failure.reason.to_string()),
    }
}

/// With a capital letter and a full stop.
pub fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first: String = letters.next().map(|c| c.to_uppercase().collect()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}
