//! The interface's own state: what is edited, how it is looked at, and what panels ask for.

use crate::compute::protocol::{ModeChoice, Topic, Which};
use crate::scenario::Scenario;

/// What the user edits. Everything else on the screen follows from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Always physical: an edit that is not is refused.
    pub scenario: Scenario,
}

/// A wish of a panel, carried out between two frames.
#[derive(Clone, Debug)]
pub enum Command {
    /// Put this scenario in the place of the present one, where it is physical.
    Edit(Box<Scenario>),
    /// Start from this scenario: values reset to what they are in it.
    Load(Box<Scenario>),
    /// Show another mode's shape.
    ChooseMode(ModeChoice),
    /// Stop a study; what is known of it stays.
    StopStudy(Topic),
    /// Go on with a study that was stopped.
    ResumeStudy(Topic),
    /// Take the notice off the screen.
    DismissNotice,
}

/// The plots, one at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Plot {
    /// Eigenvalues in the complex plane.
    #[default]
    Eigenvalues,
    /// Growth rate against speed.
    Growth,
    /// The table of modes.
    Modes,
    /// Critical speed and frequency along the motion.
    Line,
    /// Critical speed against direction.
    Directions,
    /// All eigenvalues against speed.
    Campbell,
    /// Critical speed against the mesh.
    Mesh,
}

/// What the map under the robot shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MapQuantity {
    /// The critical speed.
    #[default]
    Speed,
    /// The frequency at the critical speed.
    Frequency,
    /// Flutter or divergence.
    Kind,
    /// The responsible cable.
    Cable,
    /// The largest growth rate at today's speed.
    Growth,
}

/// The map under the robot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MapView {
    /// Whether it is switched on.
    pub on: bool,
    /// What it shows.
    pub quantity: MapQuantity,
    /// In the worst of 16 directions, rather than the motion's.
    pub worst: bool,
}

/// What a narrow screen shows below the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Page {
    /// Controls.
    #[default]
    Controls,
    /// Plots.
    Plots,
}

/// How the document is looked at.
#[derive(Clone, Debug)]
pub struct UiState {
    /// The plot that is open.
    pub plot: Plot,
    /// What a narrow screen shows.
    pub page: Page,
    /// The mode whose shape is drawn.
    pub mode: ModeChoice,
    /// The mode shape's movement.
    pub playback: Playback,
    /// The canvas's zoom and pan.
    pub camera: Camera,
    /// The map under the robot.
    pub map: MapView,
    /// Up to which frequency the Campbell diagram is drawn, in Hz.
    pub campbell_hz: f64,
}

impl Default for UiState {
    fn default() -> Self {
        Self {
            plot: Plot::default(),
            page: Page::default(),
            mode: ModeChoice { which: Which::Critical, along_x: false },
            playback: Playback::default(),
            camera: Camera::default(),
            map: MapView::default(),
            campbell_hz: 5.0,
        }
    }
}

/// How the mode shape moves.
#[derive(Clone, Debug)]
pub struct Playback {
    /// Whether time runs.
    pub playing: bool,
    /// The largest displacement on the screen, as a part of the robot's width.
    pub amplitude: f64,
    /// Seconds of the robot per second of the screen.
    pub slow_motion: f64,
    /// The oscillation's phase in radians.
    pub phase: f64,
}

impl Default for Playback {
    fn default() -> Self {
        Self { playing: true, amplitude: 0.03, slow_motion: 1.0, phase: 0.0 }
    }
}

/// The canvas's zoom and pan: identity shows the whole robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Magnification, 1 where the whole robot fits.
    pub zoom: f64,
    /// The world point in the middle of the canvas less the robot's middle, in m.
    pub offset: [f64; 2],
}

impl Default for Camera {
    fn default() -> Self {
        Self { zoom: 1.0, offset: [0.0, 0.0] }
    }
}
