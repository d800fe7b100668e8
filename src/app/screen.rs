//! What the interface keeps from one frame to draw the next one with.

use crate::app::canvas;
use crate::app::regions::Regions;
use crate::app::settings::Settings;
use crate::app::state::Plot;
use crate::app::windows;

/// The screen as it was drawn last.
#[derive(Default)]
pub struct Screen {
    /// Where things were drawn, for the tour and for pictures of them.
    pub regions: Regions,
    /// The plots that were drawn: their studies are asked for.
    pub plots: Vec<Plot>,
    /// Whether the pointer is coarse, a finger: things are then larger.
    pub coarse: bool,
    /// What the canvas keeps.
    pub canvas: canvas::Runtime,
    /// What the windows keep.
    pub windows: windows::Runtime,
    /// The settings that have been carried out; at first those of the system.
    pub applied: Settings,
    /// The magnification of all texts that has been carried out.
    pub zoom: f32,
}
