//! Where things were drawn on the screen.

use eframe::egui::Rect;

/// Where things were drawn in the last frame, in points. A thing that was not drawn keeps its last place.
#[derive(Clone, Copy, Debug)]
pub struct Regions {
    /// The canvas.
    pub canvas: Rect,
    /// The controls.
    pub controls: Rect,
    /// The critical speed with what belongs to it.
    pub answer: Rect,
    /// The open plot.
    pub plot: Rect,
}

impl Default for Regions {
    fn default() -> Self {
        Self { canvas: Rect::NOTHING, controls: Rect::NOTHING, answer: Rect::NOTHING, plot: Rect::NOTHING }
    }
}
