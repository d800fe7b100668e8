//! What the interface keeps from one frame to draw the next one with.

use crate::app::canvas;
use crate::app::regions::Regions;
use crate::app::settings::Settings;
use crate::app::windows;

/// The screen as it was drawn last.
#[derive(Default)]
pub struct Screen {
    /// Where things were drawn, for the tour and for pictures of them.
    pub regions: Regions,
    /// Whether the plots were drawn; a narrow screen may not show them.
    pub plots_open: bool,
    /// What the canvas keeps.
    pub canvas: canvas::Runtime,
    /// What the windows keep.
    pub windows: windows::Runtime,
    /// The settings that have been carried out; at first those of the system.
    pub applied: Settings,
}
