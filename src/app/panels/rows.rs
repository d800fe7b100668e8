//! The rows of controls: each number with its name, slider, typed value and reset.

use eframe::egui::{Align, Button, Label, Layout, Sense, Slider, SliderClamping, Ui, Vec2};

use crate::app::canvas;
use crate::app::fields::{self, Field};
use crate::app::gestures;
use crate::app::meaning::Explain as _;
use crate::app::number::{self, Control};
use crate::app::settings::Settings;
use crate::scenario::{Parameter, Scenario};

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
    pub(super) revealed: Option<Parameter>,
    /// Units.
    pub(super) settings: Settings,
}

/// A row for each number.
pub(super) fn rows(ui: &mut Ui, sheet: &mut Sheet<'_>, list: &[Parameter]) {
    for &parameter in list {
        let field = Field::of(parameter, canvas::frame(&sheet.edited)).in_units_of(sheet.settings);
        ui.push_id(format!("{parameter:?}"), |ui| row(ui, sheet, &field));
    }
}

/// Name, slider, typed value, reset.
fn row(ui: &mut Ui, sheet: &mut Sheet<'_>, field: &Field) {
    let value = field.parameter.get(&sheet.edited);
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
        if sheet.revealed == Some(field.parameter) {
            sheet.revealed = None;
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
        let reset = field.parameter.is_in(sheet.original) && !same(value, field.parameter.get(sheet.original));
        let first = number::brief(unit.shown(field.parameter.get(sheet.original)));
        let button = ui.add_enabled(reset, Button::new("↺").small().frame(false));
        if button.explained(format!("Back to {}", unit.with_name(&first))).clicked() {
            field.parameter.copy(sheet.original, &mut sheet.edited);
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
