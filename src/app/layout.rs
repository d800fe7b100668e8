//! Where everything is on the screen: side by side on a wide one, one below the other on a narrow one.

use std::ops::RangeInclusive;

use eframe::egui::{CentralPanel, Frame, Panel, Pos2, Rect, Ui, Vec2, containers::panel::PanelState};

use super::command::Command;
use super::facts::Facts;
use super::menu::{self, Possible};
use super::state::Page;
use super::{Tautline, canvas, gestures, panels, theme};

/// The least widths of the panels on the left and on the right, in points.
const LEAST: [f32; 2] = [340.0, 280.0];
/// So much is left to the canvas between them, as long as they can do with less.
const CANVAS: f32 = 320.0;

/// More lines at the foot of the window would cover the rest of it.
const MOST_NOTICES: usize = 3;

impl Tautline {
    pub(super) fn notice_bar(&mut self, ui: &mut Ui) {
        let lines = self.notices.lines();
        if lines.is_empty() {
            return;
        }
        Panel::bottom("notice").show(ui, |ui| {
            let older = lines.len().saturating_sub(MOST_NOTICES);
            if older > 0 {
                ui.weak(format!("{older} older ones come up when these are dismissed."));
            }
            for (index, line) in lines.iter().enumerate().skip(older) {
                ui.horizontal_wrapped(|ui| {
                    if line.fault.is_some() {
                        ui.colored_label(theme::warning(ui.visuals()), "▲");
                    }
                    ui.label(&line.text);
                    if ui.small_button("Dismiss").clicked() {
                        self.commands.push(Command::DismissNotice(index));
                    }
                });
            }
        });
    }

    pub(super) fn wide(&mut self, ui: &mut Ui) {
        let room = ui.available_width() - CANVAS;
        let shown = widths(self.state.panels, room);
        let left = shown[0]..=shown[0].max(room - shown[1]);
        let left = side(ui, Panel::left("controls"), "controls", LEAST[0], left, |ui| self.controls(ui));
        let right = shown[1]..=shown[1].max(room - left);
        let right = side(ui, Panel::right("answer"), "answer", LEAST[1], right, |ui| {
            ui.add_space(6.0);
            self.answer(ui);
            ui.separator();
            self.plots(ui);
        });
        let set = [left, right];
        for ((kept, set), shown) in self.state.panels.iter_mut().zip(set).zip(shown) {
            // Only a person changes a width. Where a small window has made it smaller, it comes back with the room.
            if (set - shown).abs() > 0.5 {
                *kept = set;
            }
        }
        CentralPanel::no_frame().show(ui, |ui| self.canvas(ui));
    }

    pub(super) fn narrow(&mut self, ui: &mut Ui) {
        let height = ui.available_height();
        Panel::top("canvas").exact_size(0.4 * height).resizable(false).frame(Frame::NONE).show(ui, |ui| {
            self.canvas(ui);
        });
        CentralPanel::default().show(ui, |ui| {
            gestures::scroll(ui, |ui| {
                self.answer(ui);
                ui.separator();
                ui.horizontal(|ui| {
                    ui.selectable_value(&mut self.state.page, Page::Controls, "Controls");
                    ui.selectable_value(&mut self.state.page, Page::Plots, "Plots");
                });
                match self.state.page {
                    Page::Controls => {
                        self.controls(ui);
                    }
                    Page::Plots => self.plots(ui),
                }
            });
        });
    }

    /// What panels read.
    pub(super) fn facts(&self) -> Facts<'_> {
        self.present.facts(self.state.settings, self.session.mode)
    }

    fn answer(&mut self, ui: &mut Ui) {
        let top = ui.cursor().min;
        panels::answer::ui(ui, self.facts());
        self.screen.regions.answer = Rect::from_min_max(top, ui.min_rect().max).intersect(ui.clip_rect());
    }

    fn controls(&mut self, ui: &mut Ui) {
        let facts = self.present.facts(self.state.settings, self.session.mode);
        panels::controls::ui(&mut self.session, ui, facts, &mut self.commands);
        self.screen.regions.controls = ui.min_rect().intersect(ui.clip_rect());
    }

    fn plots(&mut self, ui: &mut Ui) {
        self.screen.plots_open = true;
        let facts = self.present.facts(self.state.settings, self.session.mode);
        let place = panels::plots::ui(&mut self.state, &mut self.session, ui, facts, &mut self.commands);
        self.screen.regions.plot = place.intersect(ui.clip_rect());
    }

    fn canvas(&mut self, ui: &mut Ui) {
        let facts = self.present.facts(self.state.settings, self.session.mode);
        let Self { screen, state, session, commands, .. } = self;
        screen.regions.canvas = canvas::ui(&mut screen.canvas, state, session, ui, facts, commands);
    }

    pub(super) fn menu(&mut self, ui: &mut Ui) {
        let possible = Possible {
            undo: self.history.can_undo(&self.present.document),
            redo: self.history.can_redo(&self.present.document),
            reset: self.present.document.scenario != self.present.document.original,
            unpin: self.present.pinned.is_some(),
        };
        menu::ui(&mut self.state, &mut self.session, ui, possible, &mut self.commands);
    }
}

/// A panel at a side, as wide as `width` begins, whatever is in it. Gives how wide it is to be from now on: its edge can
/// be dragged from the least to the end of `width`.
fn side(
    ui: &mut Ui,
    panel: Panel,
    name: &str,
    least: f32,
    width: RangeInclusive<f32>,
    content: impl FnOnce(&mut Ui),
) -> f32 {
    // egui keeps the width of a panel's content; the width that a person has set is kept here.
    let outer_rect = Rect::from_min_size(Pos2::ZERO, Vec2::new(*width.start(), ui.available_height()));
    let id = ui.scope_id().with(name);
    ui.data_mut(|data| data.insert_persisted(id, PanelState { outer_rect }));
    let panel = panel.size_range(least..=*width.end()).show(ui, |ui| gestures::scroll(ui, content));
    panel.response.rect.width()
}

/// How wide the panels are where they have so much room together, in points.
fn widths(set: [f32; 2], room: f32) -> [f32; 2] {
    let more = [0, 1].map(|i| if set[i].is_finite() { (set[i] - LEAST[i]).max(0.0) } else { 0.0 });
    let left = (room - LEAST[0] - LEAST[1]).max(0.0);
    let part = (left / (more[0] + more[1]).max(1.0)).min(1.0);
    [0, 1].map(|i| LEAST[i] + part * more[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_are_as_wide_as_set_where_there_is_room() {
        let near = |a: [f32; 2], b: [f32; 2]| (a[0] - b[0]).abs() < 0.01 && (a[1] - b[1]).abs() < 0.01;
        assert!(near(widths([380.0, 340.0], 960.0), [380.0, 340.0]));
        assert!(near(widths([900.0, 340.0], 1600.0), [900.0, 340.0]));
        for set in [[900.0, 900.0], [2000.0, 280.0], [f32::INFINITY, 400.0], [f32::NAN, -1.0]] {
            let [left, right] = widths(set, 960.0);
            assert!(left >= LEAST[0] && right >= LEAST[1] && left + right <= 960.01, "{left} {right}");
        }
        // Where there is no room they take the least that they can do with.
        assert!(near(widths([380.0, 340.0], 480.0), LEAST));
    }
}
