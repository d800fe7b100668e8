//! What goes to the engine and to the pool, and what comes back. Plain data, sent as bytes between the page and its
//! workers.

use nalgebra::Complex;
use serde::{Deserialize, Serialize};

use crate::scenario::Report;
use crate::scenario::report::{CriticalReport, SensitivityReport, StatusReport};
use crate::stability::Mode;
use crate::study::NoAnswer;

/// Names a state of the document; later states have larger numbers.
pub type Revision = u64;

/// A request to the engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Request {
    /// Analyse a scenario.
    Analyze(Job),
    /// Give the shape of another mode of the scenario analysed last.
    Shape(ModeChoice),
    /// Do this one of the checks against known numbers.
    Check(usize),
}

/// A scenario to analyse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Job {
    /// The document's state that this is.
    pub revision: Revision,
    /// The scenario as in its file.
    pub scenario: String,
    /// Up to which speed to search for the critical one, in m/s; finite and greater than 0.
    pub max_speed: f64,
    /// The mode whose shape is wanted.
    pub mode: ModeChoice,
}

/// Which mode's shape is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeChoice {
    /// Which eigenvalue.
    pub which: Which,
    /// Along x rather than y, where the two directions decouple.
    pub along_x: bool,
}

/// Which eigenvalue.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Which {
    /// The one that crosses at the critical speed, at that speed; the least stable one where there is none.
    Critical,
    /// At the scenario's speed, the one nearest to [Re λ, Im λ].
    Near([f64; 2]),
}

/// A reply of the engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reply {
    /// The document's state that it answers.
    pub revision: Revision,
    /// What became known.
    pub update: Update,
}

/// What became known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Update {
    /// The pose and its spectrum at the scenario's speed; the critical speed is still to come. Of a large robot it comes twice:
    /// with the slowest modes at once, and with all of them after the critical speed.
    Pose(Box<PoseAnswer>),
    /// The pose has no answer. The analysis is complete.
    Failed(Box<Failed>),
    /// The search for the critical speed goes on; it has come to this speed, in m/s.
    Searching(f64),
    /// The search has ended: the analysis is complete.
    Critical(CriticalAnswer),
    /// The growth rate against speed, to somewhat beyond the critical one: [speed in m/s, max Re λ in 1/s].
    Curve(Vec<[f64; 2]>),
    /// What each parameter does to the critical speed; or as a sentence why that cannot be told. The last of a pose.
    Sensitivities(Result<Vec<SensitivityReport>, String>),
    /// A mode's shape.
    Shape(Box<ModeShape>),
    /// A check against a known number; it belongs to no state of the document.
    Checked(Box<CheckAnswer>),
    /// The worker does not work, with the reason.
    Broken(String),
}

/// The pose and its spectrum.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PoseAnswer {
    /// The analysis without its critical speed.
    pub report: Report,
    /// Axial forces of the elements of each cable from the platform to the winch, in N.
    pub axial_forces: Vec<Vec<f64>>,
    /// The modes in rising order of frequency.
    pub modes: Vec<ModeRow>,
    /// Which of them.
    pub extent: Extent,
}

/// Which modes of a pose are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Extent {
    /// All, or none, where they could not be computed.
    All,
    /// The slowest so far; the others follow, in another answer for the pose.
    SlowestSoFar,
    /// The slowest alone: the others could not be computed.
    SlowestAlone,
}

/// A pose without an answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Failed {
    /// The complete analysis, with the reason as a sentence.
    pub report: Report,
    /// The cable to blame, 0-based.
    pub cable: Option<usize>,
    /// One entry per cable: its shape, where it has one. Empty where there is none at all.
    pub shapes: Vec<Option<DrawnShape>>,
}

/// A cable's static shape as far as a picture needs it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DrawnShape {
    /// From the platform to the winch, in m.
    pub nodes: Vec<[f64; 2]>,
    /// Of the elements, in N.
    pub axial_forces: Vec<f64>,
}

/// The end of the search for the critical speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CriticalAnswer {
    /// The first crossing, if there is one.
    pub critical: Option<CriticalReport>,
    /// Where the search has failed, so that the critical speed is not known: why, as a sentence.
    pub failure: Option<String>,
    /// The limit of the search in m/s; where it has failed, the speed that it had come to.
    pub searched_up_to: f64,
    /// From the request to this reply, in ms.
    pub elapsed_ms: f64,
}

impl CriticalAnswer {
    /// The analysis of which `report` is all but this answer.
    pub fn completed(&self, mut report: Report) -> Report {
        match &self.failure {
            Some(reason) => report.set_failed(reason.clone(), self.searched_up_to),
            None => report.set_critical(self.critical.clone(), self.searched_up_to),
        }
        report
    }
}

/// A [check](crate::study::validation::Check) and what it has come to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckAnswer {
    /// Which one, from 0.
    pub index: usize,
    /// How many there are.
    pub count: usize,
    /// What is computed.
    pub name: String,
    /// Where the expected value is from.
    pub source: String,
    /// The unit of the values; empty for plain numbers.
    pub unit: String,
    /// The expected value, the one computed and the tolerance; or why there is none, as a sentence.
    pub outcome: Result<[f64; 3], String>,
}

/// One row of the table of modes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeRow {
    /// [Re λ, Im λ] in 1/s, Im λ ≥ 0.
    pub eigenvalue: [f64; 2],
    /// Equal modes that this row stands for.
    pub multiplicity: usize,
    /// In Hz.
    pub frequency_hz: f64,
    /// ζ.
    pub damping_ratio: f64,
    /// Share of the kinetic energy of each cable.
    pub cable_share: Vec<f64>,
    /// The platform's share.
    pub platform_share: f64,
}

/// A mode's shape to draw.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeShape {
    /// [Re λ, Im λ] in 1/s.
    pub eigenvalue: [f64; 2],
    /// The speed it belongs to, in m/s.
    pub speed: f64,
    /// Whether it is the mode that crosses at the critical speed.
    pub is_critical: bool,
    /// [Re x, Im x, Re y, Im y] of each cable's nodes from the platform to the winch; the largest component is 1.
    pub displacement: Vec<Vec<[f64; 4]>>,
    /// Share of the kinetic energy of each cable.
    pub cable_share: Vec<f64>,
}

impl ModeShape {
    /// The shape of `mode` at `speed`.
    pub fn new(mode: &Mode, speed: f64, is_critical: bool) -> Self {
        let node = |q: &nalgebra::Vector2<Complex<f64>>| [q.x.re, q.x.im, q.y.re, q.y.im];
        Self {
            eigenvalue: [mode.eigenvalue.re, mode.eigenvalue.im],
            speed,
            is_critical,
            displacement: mode.displacement.iter().map(|cable| cable.iter().map(node).collect()).collect(),
            cable_share: mode.cable_share.clone(),
        }
    }
}

/// What a study is about: of each topic at most one study is at work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Topic {
    /// Critical speeds along the motion.
    Line,
    /// A map over the workspace.
    Map,
    /// Critical speeds in every direction.
    Polar,
    /// All eigenvalues against speed.
    Campbell,
    /// Critical speeds on several meshes.
    Convergence,
    /// Eigenvalues joined to modes.
    Modes,
}

/// A study that is wanted of a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyJob {
    /// The document's state that this is.
    pub revision: Revision,
    /// The scenario as in its file.
    pub scenario: String,
    /// What is wanted of it.
    pub study: StudyChoice,
}

/// A study; pose, direction and speed are the scenario's. Speeds in m/s; up to a `max_speed`, finite and greater than
/// 0, critical speeds are searched for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum StudyChoice {
    /// Critical speeds along the motion, from border to border of the workspace.
    Line {
        /// How many places.
        points: usize,
        /// See [`StudyChoice`].
        max_speed: f64,
    },
    /// A map over the workspace.
    Map {
        /// Points in a row.
        nx: usize,
        /// Rows.
        ny: usize,
        /// In which directions.
        directions: DirectionsChoice,
        /// What it shows.
        asked: AskedChoice,
    },
    /// Critical speeds in every direction.
    Polar {
        /// How many directions.
        count: usize,
        /// See [`StudyChoice`].
        max_speed: f64,
    },
    /// All eigenvalues from rest to a speed.
    Campbell {
        /// The highest speed.
        to: f64,
        /// How many speeds.
        count: usize,
    },
    /// Critical speeds on several meshes.
    Convergence {
        /// Elements per cable of each.
        counts: Vec<usize>,
        /// See [`StudyChoice`].
        max_speed: f64,
    },
    /// Eigenvalues of successive speeds joined to modes, [`campbell::track`](crate::study::campbell::track): one place.
    Modes {
        /// Speeds in rising order, and [Re λ, Im λ] in 1/s.
        spectra: Vec<(f64, Vec<[f64; 2]>)>,
    },
}

impl StudyChoice {
    /// What it is about.
    pub fn topic(&self) -> Topic {
        match self {
            Self::Line { .. } => Topic::Line,
            Self::Map { .. } => Topic::Map,
            Self::Polar { .. } => Topic::Polar,
            Self::Campbell { .. } => Topic::Campbell,
            Self::Convergence { .. } => Topic::Convergence,
            Self::Modes { .. } => Topic::Modes,
        }
    }
}

/// In which directions a map looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum DirectionsChoice {
    /// In the scenario's.
    Motion,
    /// In the worst of 16.
    Worst,
}

/// What a map shows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum AskedChoice {
    /// The critical speed.
    Critical {
        /// See [`StudyChoice`].
        max_speed: f64,
    },
    /// The largest growth rate at the scenario's speed.
    Growth,
}

/// What is known at one place of a study; places are numbered as in [`Study`](crate::study::Study).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum PlaceAnswer {
    /// The critical speed.
    Critical {
        /// The unit vector of the motion; of several directions the worst one.
        direction: [f64; 2],
        /// What is known.
        verdict: VerdictAnswer,
        /// The wave limit in m/s, of several directions the lowest; `None` where there is none.
        wave_limit: Option<f64>,
    },
    /// max Re λ in 1/s, or why it is not known.
    Growth(Result<f64, Missing>),
    /// [Re λ, Im λ] in 1/s, Im λ ≥ 0, in rising order of frequency; or why they are not known.
    Spectrum(Result<Vec<[f64; 2]>, Missing>),
    /// Modes, or why they are not known.
    Modes(Result<Vec<ModePoints>, Missing>),
}

/// One mode: the speeds in m/s at which it exists, and [Re λ, Im λ] in 1/s.
pub type ModePoints = Vec<(f64, [f64; 2])>;

/// Why a pose has no eigenvalues.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Missing {
    /// It has no taut equilibrium.
    Infeasible,
    /// Its statics or its eigenvalues could not be computed.
    Failed,
}

impl Missing {
    /// As tables tell it.
    pub fn status(self) -> StatusReport {
        match self {
            Self::Infeasible => StatusReport::Infeasible,
            Self::Failed => StatusReport::Failed,
        }
    }
}

impl From<NoAnswer> for Missing {
    fn from(reason: NoAnswer) -> Self {
        match reason {
            NoAnswer::Infeasible => Self::Infeasible,
            NoAnswer::Failed => Self::Failed,
        }
    }
}

/// The critical speed, or why there is none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum VerdictAnswer {
    /// The pose has no taut equilibrium.
    Infeasible,
    /// The statics could not be computed, or the attempt was lost: nothing is known.
    Unknown,
    /// The pose has a taut equilibrium, but the search for its critical speed has failed: not known.
    NotConverged,
    /// Every speed up to this one (m/s) is stable.
    NoneUpTo(f64),
    /// The first crossing.
    Critical(CriticalReport),
}

impl VerdictAnswer {
    /// Whether the pose has a taut equilibrium; `None` where that is not known.
    pub fn feasible(&self) -> Option<bool> {
        match self {
            Self::Infeasible => Some(false),
            Self::Unknown => None,
            Self::NotConverged | Self::NoneUpTo(_) | Self::Critical(_) => Some(true),
        }
    }

    /// How the search ended, as tables tell it.
    pub fn status(&self) -> StatusReport {
        match self {
            Self::Infeasible => StatusReport::Infeasible,
            Self::Unknown | Self::NotConverged => StatusReport::Failed,
            Self::NoneUpTo(_) => StatusReport::None,
            Self::Critical(_) => StatusReport::Found,
        }
    }
}

/// News of a study.
#[derive(Clone, Debug, PartialEq)]
pub enum StudyNews {
    /// Answers at some places.
    Places {
        /// Which study.
        topic: Topic,
        /// The document's state that it is of.
        revision: Revision,
        /// Places and what is known there; no place comes twice.
        answers: Vec<(usize, PlaceAnswer)>,
    },
    /// All places are answered.
    Finished {
        /// Which study.
        topic: Topic,
        /// The document's state that it is of.
        revision: Revision,
    },
    /// The study cannot be begun.
    Refused {
        /// Which study.
        topic: Topic,
        /// The document's state that it is of.
        revision: Revision,
        /// Why not.
        reason: String,
    },
    /// No worker could be started, with the reason; every study has ended.
    Broken(String),
}

/// A message to a worker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Incoming {
    /// To the engine.
    Request(Request),
    /// To one of the pool's workers.
    Task(Task),
    /// Asks for a sign of life.
    AreYouThere,
}

/// A message from a worker.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outgoing {
    /// From the engine.
    Reply(Reply),
    /// From one of the pool's workers.
    Batch(BatchAnswer),
    /// The sign of life.
    Alive,
}

/// What one of the pool's workers is told.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Task {
    /// A study, in the place of the one of this topic; its places follow in batches.
    Study {
        /// Names the study.
        generation: u64,
        /// The study.
        job: StudyJob,
    },
    /// Places to answer.
    Batch(Batch),
    /// The study of this topic is not wanted any more: its batches end at once.
    Forget(Topic),
}

/// Places to answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Batch {
    /// Which study, as told before.
    pub topic: Topic,
    /// Names the study.
    pub generation: u64,
    /// Which places.
    pub places: Vec<usize>,
}

/// The answers to a batch; a worker answers its batches in the order in which they come.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BatchAnswer {
    /// The first so many of the batch's places: a worker stops when it has taken its time.
    pub answers: Vec<(usize, PlaceAnswer)>,
    /// How long it took, in s.
    pub seconds: f64,
}
