//! Hints at numbers that may not be meant. Each leads to its number.

use eframe::egui::{Button, RichText, Ui, Vec2};

use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::theme;
use crate::scenario::plausible::{Hint, hints};

/// What is unusual about the document, as far as it is known.
pub(super) fn of(facts: Facts<'_>) -> Vec<Hint> {
    hints(&facts.document.scenario, facts.answers.pose().map(|pose| &pose.report))
}

/// How many hints there are, in words.
pub(super) fn summary(hints: &[Hint]) -> String {
    match hints.len() {
        0 => "nothing unusual".into(),
        1 => "1 hint".into(),
        count => format!("{count} hints"),
    }
}

/// The hints in a list.
pub(super) fn ui(ui: &mut Ui, touch: bool, hints: &[Hint], commands: &mut Vec<Command>) {
    let tokens = theme::tokens(ui.visuals());
    if hints.is_empty() {
        ui.label(RichText::new("Nothing unusual is found in these numbers.").color(tokens.weak));
    }
    for hint in hints {
        let what = RichText::new(&hint.what).color(tokens.accent_text);
        let height = if touch { 44.0 } else { 0.0 };
        let button = ui.add(Button::new(what).wrap().frame(false).min_size(Vec2::new(0.0, height)));
        if button.explained("Leads to the number that this is about").clicked() {
            commands.push(Command::Reveal(hint.parameter));
        }
        ui.label(RichText::new(hint.why).size(theme::CAPTION).color(tokens.weak));
        ui.add_space(4.0);
    }
}
