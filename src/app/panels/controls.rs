//! Sliders with typed values for everything that can be turned.

use eframe::egui::{CollapsingHeader, ComboBox, Grid, Label, RichText, Ui};

use super::robot;
use super::rows::{Sheet, rows};
use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::fields;
use crate::app::meaning::Explain as _;
use crate::app::number;
use crate::app::state::{Document, Session};
use crate::robot::{Linearisation, Strain, TensionLaw};
use crate::scenario::{Parameter, Scenario, presets};

/// Draws the controls; a change becomes one command.
pub fn ui(
    session: &mut Session,
    ui: &mut Ui,
    Facts { document, settings, .. }: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    let edited = document.scenario.clone();
    let mut sheet = Sheet { edited, original: &document.original, revealed: session.revealed, settings };
    examples(ui, document, commands);
    group(ui, "Motion", &mut sheet, &fields::MOTION);
    group(ui, "Cables and platform", &mut sheet, &fields::BODY);
    group(ui, "Damping and mesh", &mut sheet, &fields::MODEL);
    choices(ui, &mut sheet.edited);
    tensions(ui, &mut sheet);
    robot::ui(&mut session.unlocked, ui, &mut sheet);
    session.revealed = sheet.revealed;
    if sheet.edited != document.scenario {
        commands.push(Command::Edit(Box::new(sheet.edited)));
    }
}

fn examples(ui: &mut Ui, document: &Document, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        let label = ui.label("Robot");
        let name = document.scenario.name.as_deref().unwrap_or("Unnamed robot");
        let room = ui.available_width();
        let list = ComboBox::from_id_salt("examples").selected_text(name).truncate().width(room.min(210.0));
        let list = list.show_ui(ui, |ui| {
            for preset in presets::PRESETS {
                let chosen = document.scenario.name.as_deref() == Some(preset.title);
                if ui.selectable_label(chosen, preset.title).explained(preset.description).clicked() {
                    commands.push(Command::Load(Box::new(preset.scenario())));
                }
            }
        });
        list.response.labelled_by(label.id);
    });
    let chosen = presets::PRESETS.iter().find(|preset| document.scenario.name.as_deref() == Some(preset.title));
    if let Some(preset) = chosen {
        ui.add(Label::new(RichText::new(preset.description).weak().size(12.0)).wrap());
    }
}

fn group(ui: &mut Ui, title: &str, sheet: &mut Sheet<'_>, list: &[Parameter]) {
    ui.add_space(6.0);
    ui.label(RichText::new(title).strong());
    rows(ui, sheet, list);
}

fn choices(ui: &mut Ui, edited: &mut Scenario) {
    ui.add_space(4.0);
    Grid::new("choices").num_columns(2).show(ui, |ui| {
        ui.label("Stiffness").explained("The elastic stiffness that a small vibration meets.");
        ui.horizontal(|ui| {
            ui.radio_value(&mut edited.linearisation, Linearisation::Secant, "Secant")
                .explained("(N/λ) I: the paper's simplification, its Eq. 15");
            ui.radio_value(&mut edited.linearisation, Linearisation::Tangent, "Tangent")
                .explained("(N/λ)(I − e⊗e) + N'(λ) e⊗e: the full derivative, its Eq. 14");
        });
        ui.end_row();
        ui.label("Strain").explained("The strain measure of the axial law N(λ).");
        ui.horizontal(|ui| {
            ui.radio_value(&mut edited.cable.strain, Strain::Green, "Green")
                .explained("N = ½ EA (λ³ − λ), from the energy ½ EA ε² with ε = ½ (λ² − 1)");
            ui.radio_value(&mut edited.cable.strain, Strain::Engineering, "Engineering").explained("N = EA (λ − 1)");
        });
        ui.end_row();
    });
}

/// The prescribed cables: a constant, or the six coefficients of a law.
fn tensions(ui: &mut Ui, sheet: &mut Sheet<'_>) {
    ui.add_space(6.0);
    ui.label(RichText::new("Tension of the stiffening cables").strong());
    for cable in 0..sheet.edited.cables.len() {
        let law = sheet.edited.cables[cable].tension;
        let kind = match law {
            TensionLaw::Equilibrium => continue,
            TensionLaw::Constant(tension) => format!("{} N", number::brief(tension)),
            TensionLaw::Hypot { .. } => "by law".into(),
        };
        let open = matches!(sheet.revealed, Some(Parameter::Tension(of) | Parameter::Horizontal(of, _)) if of == cable)
            .then_some(true);
        let header =
            CollapsingHeader::new(format!("Cable {}: {kind}", cable + 1)).id_salt(("tension", cable)).open(open);
        header.show(ui, |ui| {
            ui.horizontal(|ui| {
                let tension = law.at(sheet.edited.motion.position);
                let constant = matches!(law, TensionLaw::Constant(_));
                if ui.radio(constant, "Constant").clicked() && !constant {
                    sheet.edited.cables[cable].tension = TensionLaw::Constant(tension);
                }
                if ui.radio(!constant, "Law").explained(fields::LAW).clicked() && constant {
                    let vertical = [0.0, 0.0, 0.0];
                    sheet.edited.cables[cable].tension =
                        TensionLaw::Hypot { horizontal: [tension, 0.0, 0.0], vertical };
                }
                ui.weak(format!("{tension:.1} N here"));
            });
            match sheet.edited.cables[cable].tension {
                TensionLaw::Constant(_) => rows(ui, sheet, &[Parameter::Tension(cable)]),
                _ => rows(ui, sheet, &fields::law(cable)),
            }
        });
    }
}
