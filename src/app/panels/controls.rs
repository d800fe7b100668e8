//! Sliders with typed values for everything that can be turned.

use eframe::egui::{
    Align, Button, CollapsingHeader, ComboBox, Grid, Label, Layout, RichText, Sense, Slider, SliderClamping, Ui, Vec2,
};

use super::robot;
use crate::app::Facts;
use crate::app::canvas;
use crate::app::command::Command;
use crate::app::fields::{self, Field, Number};
use crate::app::gestures;
use crate::app::meaning::Explain as _;
use crate::app::number::{self, Control};
use crate::app::state::{Document, Settings, UiState};
use crate::robot::{Linearisation, Strain, TensionLaw};
use crate::scenario::{Scenario, presets};

/// Room for a control's name, in points.
const LABEL: Vec2 = Vec2::new(130.0, 18.0);
/// Room for a number with its unit, in points.
pub(super) const NUMBER: Vec2 = Vec2::new(92.0, 18.0);

/// The scenario on its way through the controls.
pub(super) struct Sheet<'a> {
    /// With what has been changed so far.
    pub(super) edited: Scenario,
    /// What values reset to.
    pub(super) original: &'a Scenario,
    /// The control to bring into view, until it has been drawn.
    pub(super) wanted: Option<Number>,
    /// Units.
    pub(super) settings: Settings,
}

/// Draws the controls; a change becomes one command.
pub fn ui(state: &mut UiState, ui: &mut Ui, Facts { document, settings, .. }: Facts<'_>, commands: &mut Vec<Command>) {
    let edited = document.scenario.clone();
    let mut sheet = Sheet { edited, original: &document.original, wanted: state.wanted, settings };
    examples(ui, document, commands);
    let [x, y] = fields::position(canvas::frame(&document.scenario));
    group(ui, "Motion", &mut sheet, &[fields::SPEED, fields::DIRECTION, x, y]);
    let body = fields::BODY.map(|field| field.in_units_of(settings));
    group(ui, "Cables and platform", &mut sheet, &body);
    group(ui, "Damping and mesh", &mut sheet, &fields::MODEL);
    choices(ui, &mut sheet.edited);
    tensions(ui, &mut sheet);
    robot::ui(ui, &mut state.unlocked, &mut sheet);
    state.wanted = sheet.wanted;
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

fn group(ui: &mut Ui, title: &str, sheet: &mut Sheet<'_>, list: &[Field]) {
    ui.add_space(6.0);
    ui.label(RichText::new(title).strong());
    rows(ui, sheet, list);
}

/// A row for each number.
pub(super) fn rows(ui: &mut Ui, sheet: &mut Sheet<'_>, list: &[Field]) {
    for field in list {
        ui.push_id(field.number_id(), |ui| row(ui, sheet, field));
    }
}

impl Field {
    fn number_id(&self) -> String {
        format!("{:?}", self.number)
    }
}

/// Name, slider, typed value, reset.
fn row(ui: &mut Ui, sheet: &mut Sheet<'_>, field: &Field) {
    let value = field.number.get(&sheet.edited);
    let unit = field.unit();
    let [low, high] = field.range;
    ui.horizontal(|ui| {
        let title = format!("{} {}", field.name, if field.symbol == field.name { "" } else { field.symbol });
        let name = Label::new(title.trim_end()).truncate().sense(Sense::hover());
        let column = ui.allocate_ui_with_layout(LABEL, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_size(LABEL);
            ui.add(name).explained(field.meaning)
        });
        let name = column.inner;
        ui.spacing_mut().slider_width = (ui.available_width() - NUMBER.x - 38.0).clamp(40.0, 260.0);
        let before = unit.shown(value);
        let mut shown = before;
        // A number beyond the range stays as it is.
        let mut slider = Slider::new(&mut shown, low..=high)
            .show_value(false)
            .logarithmic(field.logarithmic)
            .clamping(SliderClamping::Never);
        if field.logarithmic {
            slider = slider.smallest_positive(if low > 0.0 { low } else { 1e-4 * high });
        }
        if field.integer {
            slider = slider.step_by(1.0);
        }
        let slider = ui.add(slider).labelled_by(name.id);
        gestures::scrolls_or_turns(&slider);
        if sheet.wanted == Some(field.number) {
            sheet.wanted = None;
            slider.request_focus();
            slider.scroll_to_me(Some(Align::Center));
        }
        let step = match (field.integer, field.logarithmic) {
            (true, _) => 1.0,
            (false, true) if before == 0.0 => 1e-6 * high,
            (false, true) => 0.01 * before.abs(),
            (false, false) => 0.002 * (high - low),
        };
        let mut answer = Control { name: field.symbol, unit, step, size: NUMBER }.show(ui, value);
        answer.response = answer.response.labelled_by(name.id);
        if !same(shown, before) {
            answer.value = Some(unit.to_stored(shown));
        }
        let reset = field.number.is_in(sheet.original) && !same(value, field.number.get(sheet.original));
        let first = number::brief(unit.shown(field.number.get(sheet.original)));
        let button = ui.add_enabled(reset, Button::new("↺").small().frame(false));
        if button.explained(format!("Back to {}", unit.with_name(&first))).clicked() {
            field.number.copy(sheet.original, &mut sheet.edited);
        }
        if let Some(value) = answer.value {
            // A hand that drags too far stops at zero, where there is nothing beyond.
            let value = if low == 0.0 && answer.response.dragged() { value.max(0.0) } else { value };
            match fields::edited(&sheet.edited, field, value, sheet.settings) {
                Ok(edited) => sheet.edited = edited,
                Err(reason) => answer.refuse(ui, reason),
            }
        }
    });
}

/// Equal, or both no numbers: a NaN must not come back every frame.
fn same(a: f64, b: f64) -> bool {
    a.total_cmp(&b).is_eq()
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
        let open = matches!(sheet.wanted, Some(Number::Tension(of) | Number::Horizontal(of, _)) if of == cable)
            .then_some(true);
        let header =
            CollapsingHeader::new(format!("Cable {}: {kind}", cable + 1)).id_salt(("tension", cable)).open(open);
        header.show(ui, |ui| {
            ui.horizontal(|ui| {
                let tension = tension_here(&sheet.edited, cable);
                let constant = matches!(law, TensionLaw::Constant(_));
                if ui.radio(constant, "Constant").clicked() && !constant {
                    sheet.edited.cables[cable].tension = TensionLaw::Constant(tension);
                }
                if ui.radio(!constant, "Law").explained(fields::law(0)[0].meaning).clicked() && constant {
                    let vertical = [0.0, 0.0, 0.0];
                    sheet.edited.cables[cable].tension =
                        TensionLaw::Hypot { horizontal: [tension, 0.0, 0.0], vertical };
                }
                ui.weak(format!("{tension:.1} N here"));
            });
            match sheet.edited.cables[cable].tension {
                TensionLaw::Constant(_) => rows(ui, sheet, &[fields::tension(cable)]),
                _ => rows(ui, sheet, &fields::law(cable)),
            }
        });
    }
}

/// What a cable's tension law gives at the platform's position, in N.
pub(super) fn tension_here(scenario: &Scenario, cable: usize) -> f64 {
    let [x, y] = scenario.motion.position;
    match scenario.cables[cable].tension {
        TensionLaw::Equilibrium => 0.0,
        TensionLaw::Constant(tension) => tension,
        TensionLaw::Hypot { horizontal: [h0, hx, hy], vertical: [v0, vx, vy] } => {
            (h0 + hx * x + hy * y).hypot(v0 + vx * x + vy * y)
        }
    }
}
