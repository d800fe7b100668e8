//! What goes to the engine and what comes back. Plain data, sent as bytes between the page and its worker.

use nalgebra::Complex;
use serde::{Deserialize, Serialize};

use crate::scenario::Report;
use crate::scenario::report::CriticalReport;
use crate::stability::Mode;

/// Names a state of the document; later states have larger numbers.
pub type Revision = u64;

/// A request to the engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Request {
    /// Analyse a scenario.
    Analyze(Job),
    /// Give the shape of another mode of the scenario analysed last.
    Shape(ModeChoice),
}

/// A scenario to analyse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Job {
    /// The document's state that this is.
    pub revision: Revision,
    /// The scenario as in its file.
    pub scenario: String,
    /// Up to which speed to search for the critical one, in m/s.
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
    /// The pose and its spectrum at the scenario's speed; the critical speed is still to come.
    Pose(Box<PoseAnswer>),
    /// The pose has no answer. The analysis is complete.
    Failed(Failed),
    /// The search for the critical speed goes on; it has come to this speed, in m/s.
    Searching(f64),
    /// The search has ended: the analysis is complete.
    Critical(CriticalAnswer),
    /// The growth rate against speed, to somewhat beyond the critical one: [speed in m/s, max Re λ in 1/s].
    Curve(Vec<[f64; 2]>),
    /// A mode's shape.
    Shape(Box<ModeShape>),
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
    /// The limit of the search in m/s.
    pub searched_up_to: f64,
    /// From the request to this reply, in ms.
    pub elapsed_ms: f64,
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
