//! Which numbers are varied: the lists to choose them from, and their ranges.

use eframe::egui::{ComboBox, RichText, Ui, Vec2};

use super::super::axis::{Axis, signed};
use crate::app::canvas;
use crate::app::facts::Facts;
use crate::app::fields::{self, Field};
use crate::app::meaning::Explain as _;
use crate::app::number::{self, Control};
use crate::app::settings::Settings;
use crate::app::what_if::{Range, WhatIfView};
use crate::robot::ELEMENTS;
use crate::scenario::{Parameter, Scenario};

/// Room for an end of a range, in points.
const END: f32 = 76.0;
/// Room for a number's name, in points.
const NAME: f32 = 150.0;

/// A number that is varied.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// What it is called, and its unit.
    pub field: Field,
    /// The range.
    pub range: Range,
    /// The present value in SI units.
    pub value: f64,
}

impl Number {
    /// A number of the document.
    pub fn new(parameter: Parameter, range: Range, facts: Facts<'_>) -> Self {
        let scenario = &facts.document.scenario;
        Self { field: field(parameter, scenario, facts.settings), range, value: parameter.get(scenario) }
    }

    /// A value as it is shown.
    pub fn shown(&self, value: f64) -> f64 {
        self.field.unit().shown(value)
    }

    /// A value in words.
    pub fn text(&self, value: f64) -> String {
        let unit = self.field.unit();
        signed(&unit.with_name(&number::rounded(unit.shown(value), 4)))
    }

    /// What stands beside its axis.
    pub fn title(&self) -> String {
        let name = name(&self.field);
        if self.field.unit.is_empty() { name } else { format!("{name}, {}", self.field.unit) }
    }

    /// The axis between two points of the screen.
    pub fn axis(&self, screen: [f32; 2]) -> Axis {
        let range = self.range.ends.map(|end| self.shown(end));
        Axis { range, ends: screen, logarithmic: self.range.is_logarithmic() }
    }

    /// The value that a hand means at a point of the screen.
    pub fn meant(&self, axis: &Axis, pos: f32) -> f64 {
        let point = (axis.value(pos + 0.5) - axis.value(pos - 0.5)).abs();
        let shown = crate::app::round::roundest(axis.value(pos), point);
        let value = self.field.unit().to_stored(shown);
        if self.field.integer { value.round() } else { value }
    }

    /// Why a value is not allowed, where it is not.
    pub fn refused(&self, value: f64, facts: Facts<'_>) -> Option<String> {
        fields::edited(&facts.document.scenario, &self.field, value, facts.settings).err()
    }
}

fn field(parameter: Parameter, scenario: &Scenario, settings: Settings) -> Field {
    Field::of(parameter, canvas::frame(scenario)).in_units_of(settings)
}

/// A number's name, with the cable that it belongs to.
pub fn name(field: &Field) -> String {
    let title = field.title();
    if field.name == field.symbol { title } else { format!("{} {title}", field.name) }
}

/// All numbers that a critical speed may depend on, in the order of the file.
pub fn all(scenario: &Scenario) -> Vec<Parameter> {
    let all = Parameter::all(scenario).into_iter().chain([Parameter::Direction]);
    let without = |number: &Parameter| matches!(number, Parameter::Speed | Parameter::DirectionComponent(_));
    all.filter(|number| !without(number) && !number.is_of_path()).collect()
}

/// The group of a number, by its path: new numbers find theirs as well.
fn group(parameter: Parameter) -> String {
    let path = parameter.path();
    let begins = |with: &str| path.starts_with(with);
    if let Some(cable) = path.strip_prefix("cables[").and_then(|rest| rest.split(']').next()?.parse::<usize>().ok()) {
        return format!("Cable {}", cable + 1);
    }
    let name = if begins("cable.") {
        "Rope"
    } else if begins("platform") || begins("gravity") {
        "Mass and gravity"
    } else if begins("damping") {
        "Damping"
    } else if begins("motion") {
        "Motion"
    } else {
        "Model"
    };
    name.into()
}

/// The range of a number that nobody has chosen one for: half to double of what is positive, some way to both sides of
/// what may be negative, all of it for the motion.
pub fn usual_range(parameter: Parameter, facts: Facts<'_>) -> [f64; 2] {
    let scenario = &facts.document.scenario;
    usual(&field(parameter, scenario, facts.settings), parameter.get(scenario))
}

fn usual(field: &Field, value: f64) -> [f64; 2] {
    let all = field.range.map(|end| field.unit().to_stored(end));
    let part = all[1] - all[0];
    if field.integer {
        let [least, most] = [*ELEMENTS.start() as f64, *ELEMENTS.end() as f64];
        return [(0.5 * value).round().max(least), (2.0 * value).round().clamp(least + 1.0, most)];
    }
    match field.parameter {
        _ if all[0] >= 0.0 && value > 0.0 => [0.5 * value, 2.0 * value],
        _ if all[0] >= 0.0 => all,
        Parameter::Position(_) | Parameter::Direction => [all[0].min(value), all[1].max(value)],
        Parameter::Anchor(..) => [value - 0.25 * part, value + 0.25 * part],
        _ => {
            let way = if value == 0.0 { 0.1 * part } else { value.abs() };
            [value - way, value + way]
        }
    }
}

/// The lists of numbers, each with its range.
pub fn choose(view: &mut WhatIfView, ui: &mut Ui, facts: Facts<'_>) {
    let scenario = &facts.document.scenario;
    let all = all(scenario);
    ui.spacing_mut().item_spacing.x = 4.0;
    ui.horizontal_wrapped(|ui| {
        let mut number = view.number;
        list(ui, "Number to vary", &mut number, &all, None, facts);
        if let Some(number) = number {
            if view.number != Some(number) {
                view.choose(number);
            }
            ends(view, number, ui, facts);
        }
    });
    ui.horizontal_wrapped(|ui| {
        ui.label("against").explained("A second number makes a map of the critical speed over both");
        let mut against = view.against;
        let others: Vec<Parameter> = all.iter().copied().filter(|other| view.number != Some(*other)).collect();
        list(ui, "Second number to vary", &mut against, &others, Some("none"), facts);
        view.against = against;
        if let Some(number) = against {
            ends(view, number, ui, facts);
        }
    });
}

/// A list of numbers in groups.
fn list(
    ui: &mut Ui,
    title: &str,
    chosen: &mut Option<Parameter>,
    all: &[Parameter],
    none: Option<&str>,
    facts: Facts<'_>,
) {
    let scenario = &facts.document.scenario;
    let named = |number: Parameter| name(&field(number, scenario, facts.settings));
    let shown = chosen.map_or_else(|| none.unwrap_or_default().to_owned(), named);
    let list = ComboBox::from_id_salt(title).width(NAME).truncate().selected_text(&shown).show_ui(ui, |ui| {
        if let Some(none) = none {
            ui.selectable_value(chosen, None, none);
        }
        let mut last = String::new();
        for &number in all {
            let group = group(number);
            if group != last {
                ui.label(RichText::new(&group).weak().small());
                last = group;
            }
            ui.selectable_value(chosen, Some(number), named(number));
        }
    });
    canvas::named(&list.response, title, &shown);
}

/// The ends of a number's range, as numbers to type.
fn ends(view: &mut WhatIfView, parameter: Parameter, ui: &mut Ui, facts: Facts<'_>) {
    let Some(range) = view.range(parameter) else { return };
    let field = field(parameter, &facts.document.scenario, facts.settings);
    let unit = field.unit();
    let size = Vec2::new(END, ui.spacing().interact_size.y.max(24.0));
    let step = 0.005 * range.ends.map(|end| unit.shown(end)).into_iter().map(f64::abs).fold(0.0, f64::max);
    for (i, word) in ["from", "to"].into_iter().enumerate() {
        let label = ui.weak(word);
        let name = format!("{}, {word}", name(&field));
        let control = Control { name: &name, unit, step: step.max(1e-9), size };
        let mut answer = control.show(ui, range.ends[i]);
        answer.response = answer.response.labelled_by(label.id);
        let Some(value) = answer.value else { continue };
        let value = if field.integer { value.round() } else { value };
        let mut ends = range.ends;
        ends[i] = value;
        if ends[0] < ends[1] && ends.iter().all(|end| end.is_finite()) {
            view.set_range(parameter, Range { ends, own: true });
        } else {
            let other = unit.with_name(&number::brief(unit.shown(range.ends[1 - i])));
            let way = if i == 0 { "less" } else { "more" };
            answer.refuse(ui, format!("This end of the range must be {way} than {other}"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Path, presets};

    #[test]
    fn every_number_has_a_group_a_name_of_its_own_and_a_range_around_it() {
        for mut scenario in presets::PRESETS.iter().map(presets::Preset::scenario) {
            let without = all(&scenario);
            scenario.path = Some(Path::new(vec![[0.1, 0.2]], 1.0));
            assert_eq!(all(&scenario), without, "no critical speed depends on the path");
            let mut names = Vec::new();
            for number in all(&scenario) {
                let field = field(number, &scenario, Settings::default());
                names.push(name(&field));
                let value = number.get(&scenario);
                let [low, high] = usual(&field, value);
                assert!(low < high && low <= value && value <= high, "{field:?}: {value} in [{low}, {high}]");
                assert!(group(number) != "Model" || number == Parameter::Elements, "{number:?}");
            }
            let count = names.len();
            names.sort();
            names.dedup();
            assert_eq!(names.len(), count, "{names:?}");
        }
        let of = |number| name(&field(number, &presets::PRESETS[0].scenario(), Settings::default()));
        assert_eq!(of(Parameter::YoungsModulus), "Young's modulus E");
        assert_eq!(of(Parameter::Tension(2)), "Tension T of cable 3");
        assert_eq!(of(Parameter::Anchor(2, 0)), "x of winch 3");
    }
}
