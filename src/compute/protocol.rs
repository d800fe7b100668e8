//! What goes to the engine and to the pool, and what comes back. Plain data, sent as bytes between the page and its
//! workers.

use nalgebra::Complex;
use serde::{Deserialize, Serialize};

use crate::scenario::Report;
use crate::stability::{Critical, Mode};
pub use crate::study::Topic;
use crate::study::validation::Comparison;
use crate::study::{Answer, Sensitivity, Study};

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
    /// At the scenario's speed, the one with the largest growth rate: what a small disturbance becomes.
    Present,
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
    /// The pose and its spectrum at the scenario's speed; the critical speed is still to come. For a large robot this update
    /// comes twice: with the slowest modes at once, and with all modes after the critical speed.
    Pose(Box<AnalysedPose>),
    /// The pose has no answer. The analysis is complete.
    Failed(Box<FailedPose>),
    /// The search for the critical speed goes on; it has come to this speed, in m/s.
    Searching(f64),
    /// The search has ended: the analysis is complete.
    Critical(SearchEnd),
    /// The growth rate against speed, to somewhat beyond the critical one: [speed in m/s, max Re λ in 1/s].
    Curve(Vec<[f64; 2]>),
    /// What each parameter does to the critical speed; or as a sentence why that cannot be told. The last of a pose.
    Sensitivities(Result<Vec<Sensitivity>, String>),
    /// A mode's shape.
    Shape(Box<ModeShape>),
    /// A check against a known number; it belongs to no state of the document.
    Checked(Box<CheckResult>),
    /// The worker does not work, with the reason.
    Broken(String),
}

/// The pose and its spectrum.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnalysedPose {
    /// The analysis without its critical speed.
    pub report: Report,
    /// Axial forces of the elements of each cable from the platform to the winch, in N.
    pub axial_forces: Vec<Vec<f64>>,
    /// The modes in rising order of frequency.
    pub modes: Vec<ModeRow>,
    /// Whether these are all.
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
pub struct FailedPose {
    /// The complete analysis, with the reason as a sentence.
    pub report: Report,
    /// The cable to blame, 0-based.
    pub cable: Option<usize>,
    /// Where that cable would have to push: with how much, in N, greater than 0. It is what the platform's balance asks of
    /// the cable's straight line, with the weights and the sag of all prescribed cables.
    pub push: Option<f64>,
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
pub struct SearchEnd {
    /// The first crossing, if there is one.
    pub critical: Option<Critical>,
    /// Where the search has failed, so that the critical speed is not known: why, as a sentence.
    pub failure: Option<String>,
    /// The limit of the search in m/s; where it has failed, the speed that it had come to.
    pub searched_up_to: f64,
    /// From the request to this reply, in ms.
    pub elapsed_ms: f64,
}

impl SearchEnd {
    /// The whole analysis: `report` with the critical speed, which it lacks.
    pub fn completed(&self, mut report: Report) -> Report {
        match &self.failure {
            Some(reason) => report.set_failed(reason.clone(), self.searched_up_to),
            None => report.set_critical(self.critical.as_ref(), self.searched_up_to),
        }
        report
    }
}

/// A [check](crate::study::validation::Check) and what it has come to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckResult {
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
    /// What it has come to; or why there is nothing to compare, as a sentence.
    pub comparison: Result<Comparison, String>,
}

/// One row of the table of modes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeRow {
    /// [Re λ, Im λ] in 1/s, Im λ ≥ 0.
    pub eigenvalue: [f64; 2],
    /// How many equal modes this row stands for.
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

/// A study that is wanted of a robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyJob {
    /// The document's state that this is.
    pub revision: Revision,
    /// The scenario with the robot, as in its file; its motion does not matter.
    pub scenario: String,
    /// What is wanted of the robot.
    pub study: Study,
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
        answers: Vec<(usize, Answer)>,
    },
    /// A study of one place has come so far with it.
    Part {
        /// Which study.
        topic: Topic,
        /// The document's state that it is of.
        revision: Revision,
        /// In percent.
        percent: u16,
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
    Batch(AnsweredBatch),
    /// From one of the pool's workers, about the place that it is at.
    Part(PartDone),
    /// The sign of life.
    Alive,
}

/// How much of the only place of a study is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PartDone {
    /// Which study, as told before.
    pub topic: Topic,
    /// Names the study.
    pub generation: u64,
    /// In percent.
    pub percent: u16,
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
pub struct AnsweredBatch {
    /// Places, from the batch's first on, with what was found there. A worker that has taken its time leaves the last ones
    /// out.
    pub answers: Vec<(usize, Answer)>,
    /// How long it took, in s.
    pub seconds: f64,
}
