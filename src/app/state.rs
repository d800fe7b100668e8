//! The interface's own state: what is edited and how it is looked at.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::app::settings::Settings;
use crate::compute::protocol::{ModeChoice, Which};
use crate::scenario::{Parameter, Scenario};

/// What the user edits, with undo. Everything else on the screen follows from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Always physical: an edit that is not is refused.
    pub scenario: Scenario,
    /// What values reset to: the scenario as it was opened.
    pub original: Scenario,
}

impl Document {
    /// A scenario as it has just been opened.
    pub fn opened(scenario: Scenario) -> Self {
        Self { original: scenario.clone(), scenario }
    }
}

/// The plots, one at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
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
    /// Sensitivities of the critical speed.
    Knobs,
}

/// What the map under the robot shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MapView {
    /// Whether it is switched on.
    pub on: bool,
    /// What it shows.
    pub quantity: MapQuantity,
    /// In the worst of 16 directions, rather than the motion's.
    pub worst: bool,
}

/// What a narrow screen shows below the canvas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Page {
    /// Controls.
    #[default]
    Controls,
    /// Plots.
    Plots,
}

/// How the document is looked at, as far as that survives a restart.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default)]
pub struct UiState {
    /// The plot that is open.
    pub plot: Plot,
    /// What a narrow screen shows.
    pub page: Page,
    /// The mode shape's movement.
    pub playback: Playback,
    /// The widths of the panels on the left and on the right, in points, as they were set.
    pub panels: [f32; 2],
    /// Whether the tour has been taken or skipped.
    pub tour_taken: bool,
    /// The map under the robot.
    pub map: MapView,
    /// Up to which frequency the Campbell diagram is drawn, in Hz.
    pub campbell_hz: f64,
    /// What people choose once.
    pub settings: Settings,
}

/// How the document is looked at for the moment: a restart begins anew.
#[derive(Clone, Debug)]
pub struct Session {
    /// The mode whose shape is drawn.
    pub mode: ModeChoice,
    /// Whether the mode's frequency sounds as a tone; pages may not sound unasked.
    pub sound: bool,
    /// The tour's step on show, from 0.
    pub tour: Option<usize>,
    /// The control to bring into view.
    pub revealed: Option<Parameter>,
    /// Whether winches can be dragged.
    pub unlocked: bool,
    /// The canvas's zoom and pan.
    pub camera: Camera,
    /// Windows over the page.
    pub windows: Windows,
}

impl Default for Session {
    fn default() -> Self {
        Self {
            mode: ModeChoice { which: Which::Critical, along_x: false },
            sound: false,
            tour: None,
            revealed: None,
            unlocked: false,
            camera: Camera::default(),
            windows: Windows::default(),
        }
    }
}

/// Which windows are open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools)] // One switch each; they know nothing of each other.
pub struct Windows {
    /// The settings.
    pub settings: bool,
    /// The keyboard shortcuts.
    pub shortcuts: bool,
    /// The theory.
    pub theory: bool,
    /// The checks of theory, computed anew.
    pub validation: bool,
}

impl Default for UiState {
    fn default() -> Self {
        Self {
            plot: Plot::default(),
            page: Page::default(),
            playback: Playback::default(),
            panels: [380.0, 340.0],
            tour_taken: false,
            map: MapView::default(),
            campbell_hz: 5.0,
            settings: Settings::default(),
        }
    }
}

/// How the mode shape moves.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(default)]
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

impl Playback {
    /// Phases in one oscillation when it is looked at step by step.
    const STEPS: f64 = 24.0;

    /// Stops, and goes on by this number of steps.
    pub fn step(&mut self, steps: f64) {
        self.playing = false;
        self.phase = (self.phase + steps * TAU / Self::STEPS).rem_euclid(TAU);
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

impl Camera {
    /// Zooms by a factor about the middle.
    pub fn magnify(&mut self, factor: f64) {
        self.zoom = (self.zoom * factor).clamp(0.2, 200.0);
    }
}
