//! The rows of controls: each number with its name, typed value and reset, its slider beneath.

use eframe::egui::{Align, ComboBox, Label, Layout, Response, Sense, Slider, SliderClamping, Ui, Vec2};

use crate::app::canvas;
use crate::app::fields::{self, Field};
use crate::app::gestures;
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::number::{self, Control};
use crate::app::settings::Settings;
use crate::app::theme;
use crate::scenario::{Parameter, Scenario};

/// Room for a number with its unit, in points.
pub(super) const NUMBER: Vec2 = Vec2::new(84.0, 24.0);
/// The same for fingers.
pub(super) const NUMBER_FOR_FINGERS: Vec2 = Vec2::new(96.0, 44.0);

/// The scenario on its way through the controls.
pub(super) struct EditedScenario<'a> {
    /// With what has been changed so far.
    pub(super) edited: Scenario,
    /// What values reset to.
    pub(super) original: &'a Scenario,
    /// The control to bring into view, until it has been drawn.
    pub(super) revealed: Option<Parameter>,
    /// Units.
    pub(super) settings: Settings,
    /// Whether everything is sized for fingers.
    pub(super) touch: bool,
}

/// A row for each number.
pub(super) fn rows(ui: &mut Ui, sheet: &mut EditedScenario<'_>, list: &[Parameter]) {
    if sheet.touch {
        ui.spacing_mut().item_spacing.y = 0.0;
    }
    for &parameter in list {
        let field = Field::of(parameter, canvas::frame(&sheet.edited)).in_units_of(sheet.settings);
        ui.push_id(format!("{parameter:?}"), |ui| row(ui, sheet, &field));
    }
}

/// Name, reset and typed value on one line, the slider beneath over the full width. For fingers there are − and + as well.
fn row(ui: &mut Ui, sheet: &mut EditedScenario<'_>, field: &Field) {
    let value = fields::value(field.parameter, &sheet.edited);
    let unit = field.unit();
    let [low, high] = field.range;
    let before = unit.shown(value);
    let step = match (field.integer, field.logarithmic) {
        (true, _) => 1.0,
        (false, true) if before == 0.0 => 1e-6 * high,
        (false, true) => 0.01 * before.abs(),
        (false, false) => 0.002 * (high - low),
    };
    let size = if sheet.touch { NUMBER_FOR_FINGERS } else { NUMBER };
    let control = Control { name: field.symbol, unit, step, size };
    let title = match field.parameter.common() {
        Some(_) => field.title(),
        None => format!("{} {}", field.name, if field.symbol == field.name { "" } else { field.symbol }),
    };
    let title = title.trim_end();
    let line = ui.allocate_ui_with_layout(
        Vec2::new(ui.available_width(), size.y),
        Layout::right_to_left(Align::Center),
        |ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let mut answer = if sheet.touch { stepped(ui, &control, title, value) } else { control.show(ui, value) };
            reset(ui, sheet, field, title);
            let rest = Layout::left_to_right(Align::Center);
            let name = ui.with_layout(rest, |ui| ui.add(Label::new(title).truncate().sense(Sense::hover())));
            let name = name.inner.explained(field.meaning);
            answer.response = answer.response.labelled_by(name.id);
            (answer, name.id)
        },
    );
    let (mut answer, name) = line.inner;
    ui.spacing_mut().slider_width = ui.available_width();
    ui.spacing_mut().interact_size.y = if sheet.touch { 28.0 } else { 16.0 };
    let slid = slider(ui, sheet, field, value, name);
    answer.value = slid.or(answer.value);
    take(ui, sheet, field, answer);
}

/// Name, slider and typed value in one row.
pub(super) fn in_a_row(ui: &mut Ui, sheet: &mut EditedScenario<'_>, parameter: Parameter) {
    let field = Field::of(parameter, canvas::frame(&sheet.edited)).in_units_of(sheet.settings);
    let value = parameter.get(&sheet.edited);
    let [low, high] = field.range;
    let control = Control { name: field.symbol, unit: field.unit(), step: 0.002 * (high - low), size: NUMBER };
    let name = ui.label(format!("{} {}", field.name, field.symbol)).explained(field.meaning);
    ui.spacing_mut().slider_width = (ui.available_width() - NUMBER.x - 16.0).max(40.0);
    let slid = slider(ui, sheet, &field, value, name.id);
    let mut answer = control.show(ui, value);
    answer.response = answer.response.labelled_by(name.id);
    answer.value = slid.or(answer.value);
    take(ui, sheet, &field, answer);
}

/// The slider of a number. Gives the number, as it is stored, where it was moved.
fn slider(
    ui: &mut Ui,
    sheet: &mut EditedScenario<'_>,
    field: &Field,
    value: f64,
    name: eframe::egui::Id,
) -> Option<f64> {
    let unit = field.unit();
    let [low, high] = field.range;
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
    let slider = ui
        .scope(|ui| {
            theme::accent_sliders(ui);
            ui.add(slider)
        })
        .inner
        .labelled_by(name);
    gestures::scrolls_or_turns(&slider);
    if sheet.revealed == Some(field.parameter) {
        sheet.revealed = None;
        slider.request_focus();
        slider.scroll_to_me(Some(Align::Center));
    }
    (!same(shown, before)).then(|| unit.to_stored(shown))
}

/// Puts the number that was typed, dragged or slid in its place, where it is allowed.
pub(super) fn take(ui: &Ui, sheet: &mut EditedScenario<'_>, field: &Field, answer: number::NumberResponse) {
    if let Some(value) = answer.value {
        // A hand that drags too far stops at zero, where there is nothing beyond.
        let value = if field.range[0] == 0.0 && answer.response.dragged() { value.max(0.0) } else { value };
        match fields::edited(&sheet.edited, field, value, sheet.settings) {
            Ok(edited) => sheet.edited = edited,
            Err(reason) => answer.refuse(ui, reason),
        }
    }
}

/// The number between a minus and a plus, from right to left.
fn stepped(ui: &mut Ui, control: &Control<'_>, title: &str, value: f64) -> number::NumberResponse {
    let more = IconButton::new(Icon::Plus, &format!("More {title}")).height(44.0).show(ui).clicked();
    let mut answer = control.show(ui, value);
    let less = IconButton::new(Icon::Minus, &format!("Less {title}")).height(44.0).show(ui).clicked();
    if more != less {
        // Five times what an arrow key does: a finger does not repeat.
        answer.value = Some(control.stepped(value, if more { 5.0 } else { -5.0 }));
    }
    answer
}

/// Takes a number back to what it was when the robot was opened, where it differs. A cable's own one gives way to that of all
/// cables.
fn reset(ui: &mut Ui, sheet: &mut EditedScenario<'_>, field: &Field, title: &str) {
    if let Some(common) = field.parameter.common() {
        if !field.parameter.is_in(&sheet.edited) {
            ui.weak("as all").explained("This cable has the value of all cables. Another value here is its own.");
            return;
        }
        let unit = field.unit();
        let value = unit.with_name(&number::brief(unit.shown(common.get(&sheet.edited))));
        if reset_button(ui, sheet.touch, title).explained(format!("As all cables: {value}")).clicked() {
            field.parameter.take_away(&mut sheet.edited);
        }
        return;
    }
    let original = field.parameter.get(sheet.original);
    if !field.parameter.is_in(sheet.original) || same(field.parameter.get(&sheet.edited), original) {
        return;
    }
    let button = reset_button(ui, sheet.touch, title);
    let unit = field.unit();
    let first = unit.with_name(&number::brief(unit.shown(original)));
    if button.explained(format!("Back to {first}")).clicked() {
        field.parameter.copy(sheet.original, &mut sheet.edited);
    }
}

fn reset_button(ui: &mut Ui, touch: bool, title: &str) -> Response {
    let height = if touch { 44.0 } else { 24.0 };
    IconButton::new(Icon::Reset, &format!("Reset {title}")).height(height).show(ui)
}

/// A list to choose from, named for those who do not see it.
pub(super) fn list<T: Copy + PartialEq>(
    ui: &mut Ui,
    name: &str,
    value: &mut T,
    all: &[(T, String)],
    width: f32,
) -> bool {
    let shown = all.iter().find(|(other, _)| other == value).map_or("", |(_, text)| text);
    let mut changed = false;
    let list = ComboBox::from_id_salt(name).width(width).selected_text(shown).show_ui(ui, |ui| {
        for (other, text) in all {
            changed |= ui.selectable_value(value, *other, text).changed();
        }
    });
    canvas::named(&list.response, name, shown);
    changed
}

/// Equal, or both no numbers: a NaN must not come back every frame.
fn same(a: f64, b: f64) -> bool {
    a.total_cmp(&b).is_eq()
}
