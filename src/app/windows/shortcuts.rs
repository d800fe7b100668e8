//! The keyboard shortcuts.

use eframe::egui::{Grid, RichText, Ui};

use crate::app::shortcuts;

/// Draws the list.
pub fn ui(ui: &mut Ui) {
    Grid::new("shortcuts").num_columns(2).striped(true).spacing([16.0, 6.0]).show(ui, |ui| {
        for (keys, meaning) in shortcuts::all(ui.ctx()) {
            ui.label(RichText::new(keys).strong());
            ui.add(eframe::egui::Label::new(meaning).wrap());
            ui.end_row();
        }
    });
}
