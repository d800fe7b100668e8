//! The controls: groups of numbers that fold, each with its values in its title while it is folded.

use eframe::egui::{
    Align, Align2, FontId, Layout, Response, RichText, Role, Sense, TextStyle, TextWrapMode, Ui, Vec2, WidgetInfo,
    WidgetText,
};

use super::rows::{EditedScenario, in_a_row, rows};
use super::{cables, path, plausible, ropes};
use crate::app::canvas;
use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::fields::{self, Field};
use crate::app::icons::{self, Icon};
use crate::app::meaning::Explain as _;
use crate::app::number;
use crate::app::state::{Sections, Session};
use crate::app::theme;
use crate::app::words::{self, Word};
use crate::robot::{Linearisation, Strain};
use crate::scenario::{Parameter, Scenario};

/// Which groups are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Groups {
    /// All of them.
    All,
    /// The motion alone, without a title, and the path.
    Motion,
    /// All but the motion and the path.
    Robot,
}

/// Draws the groups; a change becomes one command.
pub fn ui(
    sections: &mut Sections,
    session: &mut Session,
    ui: &mut Ui,
    (groups, touch): (Groups, bool),
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    let Facts { document, settings, .. } = facts;
    let edited = document.scenario.clone();
    let mut sheet =
        EditedScenario { edited, original: &document.original, revealed: session.revealed, settings, touch };
    reveal(sections, session.revealed);
    if groups == Groups::Motion {
        rows(ui, &mut sheet, &fields::MOTION);
    } else if groups == Groups::All {
        let summary = values(&sheet, &[Parameter::Speed]);
        group(&mut sections.motion, ui, "Motion", &summary, touch, |ui| rows(ui, &mut sheet, &fields::MOTION));
    }
    if groups != Groups::Robot {
        let had_one = sheet.edited.path.is_some();
        group(&mut sections.path, ui, "Path", &path::summary(&sheet.edited), touch, |ui| {
            path::ui(ui, &mut sheet, facts, commands);
        });
        sections.path |= sheet.edited.path.is_some() && !had_one;
    }
    if groups != Groups::Motion {
        let count = sheet.edited.cables.len().to_string();
        group(&mut sections.cables, ui, "Cables", &count, touch, |ui| {
            cables::ui(session, ui, &mut sheet, facts, commands);
        });
        let summary = ropes::name(&sheet.edited.cable).unwrap_or_else(|| values(&sheet, &fields::ROPE));
        group(&mut sections.rope, ui, "Rope", &summary, touch, |ui| {
            ropes::ui(ui, &mut sheet, None);
            rows(ui, &mut sheet, &fields::ROPE);
        });
        let summary = values(&sheet, &fields::PLATFORM);
        group(&mut sections.platform, ui, "Mass and gravity", &summary, touch, |ui| {
            rows(ui, &mut sheet, &fields::PLATFORM);
        });
        let summary = values(&sheet, &fields::DAMPING);
        group(&mut sections.damping, ui, "Damping", &summary, touch, |ui| rows(ui, &mut sheet, &fields::DAMPING));
        let summary = model(&sheet.edited);
        group(&mut sections.model, ui, "Model", &summary, touch, |ui| {
            choices(ui, &mut sheet.edited, commands);
            rows(ui, &mut sheet, &[Parameter::Elements]);
        });
        let hints = plausible::of(facts);
        group(&mut sections.plausible, ui, "Plausible?", &plausible::summary(&hints), touch, |ui| {
            plausible::ui(ui, touch, &hints, commands);
        });
    }
    session.revealed = sheet.revealed;
    if sheet.edited != document.scenario {
        commands.push(Command::Edit(Box::new(sheet.edited)));
    }
}

/// The speed alone, as a presentation has it.
pub fn speed(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    alone(ui, facts, commands, |ui, sheet| rows(ui, sheet, &[Parameter::Speed]));
}

/// The speed alone in one row, as a frame has it.
pub fn speed_in_a_row(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    alone(ui, facts, commands, |ui, sheet| in_a_row(ui, sheet, Parameter::Speed));
}

fn alone(
    ui: &mut Ui,
    Facts { document, settings, .. }: Facts<'_>,
    commands: &mut Vec<Command>,
    content: impl FnOnce(&mut Ui, &mut EditedScenario<'_>),
) {
    let edited = document.scenario.clone();
    let mut sheet = EditedScenario { edited, original: &document.original, revealed: None, settings, touch: false };
    content(ui, &mut sheet);
    if sheet.edited != document.scenario {
        commands.push(Command::Edit(Box::new(sheet.edited)));
    }
}

/// Opens the group of the number that is to come into view.
fn reveal(sections: &mut Sections, revealed: Option<Parameter>) {
    let Some(parameter) = revealed else { return };
    let of = |list: &[Parameter]| list.contains(&parameter);
    if of(&fields::MOTION) {
        sections.motion = true;
    } else if of(&fields::ROPE) {
        sections.rope = true;
    } else if of(&fields::PLATFORM) {
        sections.platform = true;
    } else if of(&fields::DAMPING) {
        sections.damping = true;
    } else if parameter.path().starts_with("path.") {
        sections.path = true;
    } else if parameter == Parameter::Elements {
        sections.model = true;
    } else {
        sections.cables = true;
    }
}

/// The values of a group in a few words.
fn values(sheet: &EditedScenario<'_>, list: &[Parameter]) -> String {
    let frame = canvas::frame(&sheet.edited);
    let value = |parameter: &Parameter| {
        let field = Field::of(*parameter, frame).in_units_of(sheet.settings);
        let (unit, value) = (field.unit(), parameter.get(&sheet.edited));
        let text = unit.with_name(&number::rounded(unit.shown(value), 3));
        match parameter {
            Parameter::Alpha | Parameter::Beta | Parameter::Gravity => format!("{} {text}", field.symbol),
            _ => text,
        }
    };
    list.iter().map(value).collect::<Vec<_>>().join(" · ")
}

fn model(scenario: &Scenario) -> String {
    let stiffness = match scenario.linearisation {
        Linearisation::Secant => "secant",
        Linearisation::Tangent => "tangent",
    };
    let strain = match scenario.cable.strain {
        Strain::Green => "Green",
        Strain::Engineering => "engineering",
    };
    format!("{stiffness} · {strain} · n {}", scenario.elements_per_cable)
}

/// A group with a title that opens and folds it.
fn group(open: &mut bool, ui: &mut Ui, title: &str, summary: &str, touch: bool, content: impl FnOnce(&mut Ui)) {
    let height = if touch { 48.0 } else { 36.0 };
    if heading(*open, ui, title, summary, height).clicked() {
        *open = !*open;
    }
    if *open {
        ui.push_id(title, content);
        ui.add_space(8.0);
    }
    let tokens = theme::tokens(ui.visuals());
    let y = ui.cursor().min.y;
    ui.painter().hline(ui.clip_rect().x_range(), y, (1.0, tokens.line));
}

fn heading(open: bool, ui: &mut Ui, title: &str, summary: &str, height: f32) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), height), Sense::click());
    response.widget_info(|| WidgetInfo {
        current_text_value: (!open).then(|| summary.to_owned()),
        ..WidgetInfo::selected(Role::Button, true, open, title)
    });
    let tokens = theme::tokens(ui.visuals());
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect.shrink2(Vec2::new(0.0, 4.0)), 6.0, tokens.field);
    }
    let icon = if open { Icon::ChevronDown } else { Icon::ChevronRight };
    icons::paint(ui.painter(), icon, rect.left_center() + Vec2::new(8.0, 0.0), tokens.weak);
    let font = TextStyle::Body.resolve(ui.style());
    let at = rect.left_center() + Vec2::new(22.0, 0.0);
    let name = ui.painter().text(at, Align2::LEFT_CENTER, title, font, tokens.text);
    if !open || matches!(title, "Cables" | "Path") {
        let font = FontId::proportional(theme::CAPTION);
        let text = RichText::new(summary).color(tokens.weak);
        let room = rect.max.x - name.max.x - 12.0;
        let galley = WidgetText::from(text).into_galley(ui, Some(TextWrapMode::Truncate), room, font);
        let place = Align2::RIGHT_CENTER.anchor_size(rect.right_center(), galley.size());
        ui.painter().galley(place.min, galley, tokens.weak);
    }
    response
}

/// Stiffness and strain, which are words and not numbers.
fn choices(ui: &mut Ui, edited: &mut Scenario, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        words::link(ui, Word::Stiffness, "Stiffness", commands);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.radio_value(&mut edited.linearisation, Linearisation::Tangent, "Tangent")
                .explained("(N/λ)(I − e⊗e) + N'(λ) e⊗e: the full derivative, the paper's Eq. 14");
            ui.radio_value(&mut edited.linearisation, Linearisation::Secant, "Secant")
                .explained("(N/λ) I: the paper's simplification, its Eq. 15");
        });
    });
    ui.horizontal(|ui| {
        words::link(ui, Word::Strain, "Strain", commands);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.radio_value(&mut edited.cable.strain, Strain::Engineering, "Engineering").explained("N = EA (λ − 1)");
            ui.radio_value(&mut edited.cable.strain, Strain::Green, "Green")
                .explained("N = ½ EA (λ³ − λ), from the energy ½ EA ε² with ε = ½ (λ² − 1)");
        });
    });
}
