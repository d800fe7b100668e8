//! The designs that are kept, what is done with them, and what differs between them.

use eframe::egui::{Color32, Grid, RichText, ScrollArea, Ui, Vec2};

use crate::app::command::Command;
use crate::app::comparison::{Comparison, Row};
use crate::app::designs::{Action, Design, Letter};
use crate::app::facts::Facts;
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::name;
use crate::app::panels::answer;
use crate::app::theme;

/// Draws the list and the table.
pub fn ui(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    ui.label(
        "Keep up to four designs beside the one that you work on. Answers and plots show them with their letter, and the \
         table lists what differs.",
    );
    ui.add_space(6.0);
    ui.horizontal_wrapped(|ui| {
        badge(ui, "Now", theme::accent(ui.visuals()));
        ui.label(name::shown(facts.document.scenario.name.as_deref()));
        let button = IconButton::new(Icon::Pin, "Keep as the next letter").text("Keep").framed().show(ui);
        if button.explained("Keeps the present design under the next free letter").clicked() {
            commands.push(Command::Design(Action::Keep));
        }
    });
    for (letter, design) in facts.designs.all() {
        ui.separator();
        ui.push_id(letter.name(), |ui| kept(ui, letter, design, facts, commands));
    }
    ui.separator();
    if facts.designs.shown().next().is_some() {
        table(ui, &Comparison::of(facts), commands);
    } else {
        ui.weak("Nothing to compare with: keep a design, then change the robot.");
    }
}

/// A design that is kept: what it is called, what is known of it, and what can be done with it.
fn kept(ui: &mut Ui, letter: Letter, design: &Design, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let mut act = |action| commands.push(Command::Design(action));
    let (short, colour) = (letter.name(), letter.colour(ui.visuals()));
    ui.horizontal(|ui| {
        badge(ui, short, colour);
        let width = (ui.available_width() - 8.0).min(300.0);
        let now = design.document.scenario.name.as_deref();
        if let Some(name) = name::field(ui, &format!("Name of design {short}"), now, width) {
            act(Action::Rename(letter, name));
        }
    });
    ui.colored_label(colour, answer::against(letter, design, facts));
    ui.horizontal_wrapped(|ui| {
        let mut shown = design.shown;
        let switch = ui.checkbox(&mut shown, format!("Show {short}"));
        if switch.explained("Shows this design in answers, plots and the table").changed() {
            act(Action::Show(letter, shown));
        }
        let button = |ui: &mut Ui, text: String, meaning: &str| ui.button(text).explained(meaning).clicked();
        let meaning = "This design and the present one change places. One step of undo brings the present one back.";
        if button(ui, format!("Work on {short}"), meaning) {
            act(Action::WorkOn(letter));
        }
        for (icon, other) in [(Icon::ChevronUp, letter.before()), (Icon::ChevronDown, letter.after())] {
            let Some(other) = other.filter(|other| facts.designs.get(*other).is_some()) else { continue };
            let name = format!("Exchange {short} and {}", other.name());
            if IconButton::new(icon, &name).framed().show(ui).explained(name.as_str()).clicked() {
                act(Action::Exchange(letter, other));
            }
        }
        if button(ui, format!("Remove {short}"), "Lets this design go. It does not come back with undo.") {
            act(Action::Remove(letter));
        }
    });
}

/// A letter on a ground of its colour.
fn badge(ui: &mut Ui, text: &str, colour: Color32) {
    let tokens = theme::tokens(ui.visuals());
    ui.label(RichText::new(format!(" {text} ")).strong().color(tokens.panel).background_color(colour));
}

/// The table, which scrolls sideways where it is wide.
fn table(ui: &mut Ui, comparison: &Comparison, commands: &mut Vec<Command>) {
    ScrollArea::horizontal().show(ui, |ui| {
        Grid::new("designs").striped(true).spacing(Vec2::new(14.0, 6.0)).show(ui, |ui| {
            ui.label("");
            for column in &comparison.columns {
                ui.strong(*column);
            }
            ui.end_row();
            comparison.answers.iter().for_each(|row| show(ui, row));
            comparison.differences.iter().for_each(|row| show(ui, row));
        });
    });
    if comparison.differences.is_empty() {
        ui.weak("The designs do not differ.");
    }
    let button = ui.button("Copy table").explained("Puts the table on the clipboard, for a spreadsheet");
    if button.clicked() {
        commands.push(Command::CopyDesigns);
    }
}

fn show(ui: &mut Ui, row: &Row) {
    ui.label(&row.name);
    for cell in &row.cells {
        ui.label(cell);
    }
    ui.end_row();
}
