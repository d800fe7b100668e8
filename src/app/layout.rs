//! Where everything is on the screen: side by side on a wide one, one below the other on a narrow one.

use eframe::egui::{CentralPanel, Frame, Panel, Rect, ScrollArea, Ui};

use super::command::Command;
use super::menu::{self, Possible};
use super::state::Page;
use super::{Facts, Tautline, canvas, panels, theme};

impl Tautline {
    pub(super) fn notice_bar(&mut self, ui: &mut Ui) {
        let Some(notice) = &self.notice else { return };
        Panel::bottom("notice").show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                if notice.fault {
                    ui.colored_label(theme::warning(ui.visuals()), "▲");
                }
                ui.label(&notice.text);
                if ui.small_button("Dismiss").clicked() {
                    self.commands.push(Command::DismissNotice);
                }
            });
        });
    }

    pub(super) fn wide(&mut self, ui: &mut Ui) {
        let [left, right] = self.state.widths;
        let controls = Panel::left("controls").default_size(left).min_size(340.0).show(ui, |ui| {
            ScrollArea::vertical().show(ui, |ui| {
                self.controls(ui);
            });
        });
        let answer = Panel::right("answer").default_size(right).min_size(280.0).show(ui, |ui| {
            ui.add_space(6.0);
            self.answer(ui);
            ui.separator();
            self.plots(ui);
        });
        self.state.widths = [controls, answer].map(|panel| panel.response.rect.width());
        CentralPanel::no_frame().show(ui, |ui| self.canvas(ui));
    }

    pub(super) fn narrow(&mut self, ui: &mut Ui) {
        let height = ui.available_height();
        Panel::top("canvas").exact_size(0.4 * height).resizable(false).frame(Frame::NONE).show(ui, |ui| {
            self.canvas(ui);
        });
        CentralPanel::default().show(ui, |ui| {
            ScrollArea::vertical().show(ui, |ui| {
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
        self.present.facts(self.state.settings)
    }

    fn answer(&mut self, ui: &mut Ui) {
        let top = ui.cursor().min;
        panels::answer::ui(ui, self.facts());
        self.places.answer = Rect::from_min_max(top, ui.min_rect().max);
    }

    fn controls(&mut self, ui: &mut Ui) {
        let facts = self.present.facts(self.state.settings);
        panels::controls::ui(&mut self.state, ui, facts, &mut self.commands);
        self.places.controls = ui.min_rect().intersect(ui.clip_rect());
    }

    fn plots(&mut self, ui: &mut Ui) {
        self.plots_open = true;
        let facts = self.present.facts(self.state.settings);
        self.places.plot = panels::plots::ui(&mut self.state, ui, facts, &mut self.commands);
    }

    fn canvas(&mut self, ui: &mut Ui) {
        let facts = self.present.facts(self.state.settings);
        self.places.canvas = canvas::ui(&mut self.layer, &mut self.state, ui, facts, &mut self.commands);
    }

    pub(super) fn menu(&mut self, ui: &mut Ui) {
        let possible = Possible {
            undo: self.history.can_undo(&self.present.document),
            redo: self.history.can_redo(&self.present.document),
            reset: self.present.document.scenario != self.present.document.original,
            unpin: self.present.pinned.is_some() || self.pinning,
        };
        menu::ui(ui, &mut self.state, possible, &mut self.commands);
    }
}
