//! What to change: by how much the critical speed changes with each number of the robot.

use eframe::egui::{
    Align, Align2, Color32, Layout, Rect, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo,
};

use super::axis::signed;
use super::common;
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::theme;
use crate::robot::TensionLaw;
use crate::scenario::{Parameter, Scenario};
use crate::study::{Knob, Sensitivity};

/// What the plot shows, in plain words.
pub const MEANING: &str = "How much the critical speed at this pose changes when one value grows by one percent and all others \
    stay: to the right it rises, to the left it falls. The numbers are derivatives at the present design, exact for small \
    changes; a large change may bring another mode to the front. A tension's bar is for all of its law at once.";

/// Room for names and for values, in sizes of the text.
const NAME: f32 = 9.4;
const VALUE: f32 = 4.4;

/// Draws the bars; a click goes to the control.
pub fn ui(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Facts { document, answers, designs, .. } = facts;
    let uncertainty = uncertainty(facts.share());
    let Some((found, current)) = answers.sensitivities() else {
        common::say(ui, "Not computed yet.");
        return;
    };
    common::say(ui, "Percent of critical speed per percent of each value.");
    let mut found = match found {
        Ok(found) => found.clone(),
        Err(reason) => {
            ui.label(reason);
            return;
        }
    };
    found.sort_by(|a, b| b.speed.abs().total_cmp(&a.speed.abs()));
    let largest = found.first().map_or(1.0, |first| first.speed.abs()).max(1e-12);
    // There is room for the marks of one of them.
    let before = designs.shown().find_map(|(letter, design)| Some((letter, design.sensitivities()?)));
    if let Some((letter, _)) = before {
        let text = format!("The upright marks are those of design {}.", letter.name());
        ui.colored_label(letter.colour(ui.visuals()), text);
    }
    ui.spacing_mut().item_spacing.y = 0.0;
    for one in &found {
        let then = before.and_then(|(letter, all)| {
            let then = all.iter().find(|other| other.knob == one.knob)?.speed;
            Some((letter.colour(ui.visuals()), then))
        });
        let number = control(one.knob, &document.scenario);
        let height = ui.spacing().interact_size.y.max(26.0);
        ui.allocate_ui_with_layout(
            Vec2::new(ui.available_width(), height),
            Layout::right_to_left(Align::Center),
            |ui| {
                let name = format!("What if {}", name(one.knob));
                let button = IconButton::new(Icon::None, &name).text("what if").height(height).show(ui);
                if button.explained("The critical speed against this number").clicked() {
                    commands.push(Command::WhatIf(number));
                }
                if bar(ui, one, [largest, uncertainty], then, current) {
                    commands.push(Command::Reveal(number));
                }
            },
        );
    }
}

/// One bar; whether it was clicked.
fn bar(
    ui: &mut Ui,
    one: &Sensitivity,
    [largest, uncertainty]: [f64; 2],
    then: Option<(Color32, f64)>,
    current: bool,
) -> bool {
    let height = ui.spacing().interact_size.y.max(26.0);
    let (rect, response) = ui.allocate_exact_size(Vec2::new(ui.available_width(), height), Sense::click());
    let name = name(one.knob);
    let value = at_least_the_place(one.speed, uncertainty);
    let text = format!("{name}: {value} % per percent");
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &text));
    let tokens = theme::tokens(ui.visuals());
    let painter = ui.painter_at(rect);
    if response.hovered() {
        painter.rect_filled(rect, 4.0, tokens.field);
    }
    if response.has_focus() {
        painter.rect_stroke(rect, 4.0, Stroke::new(2.0, tokens.accent), StrokeKind::Inside);
    }
    // The side of the middle says the same as the colour.
    let colour = match (current, one.speed > 0.0) {
        (false, _) => tokens.mute,
        (true, true) => tokens.stable,
        (true, false) => tokens.critical,
    };
    let words = if current { tokens.text } else { tokens.weak };
    let font = TextStyle::Body.resolve(ui.style());
    let size = font.size;
    painter.text(rect.left_center() + Vec2::new(4.0, 0.0), Align2::LEFT_CENTER, &name, font.clone(), words);
    painter.text(rect.right_center() - Vec2::new(4.0, 0.0), Align2::RIGHT_CENTER, value, font, words);
    let room = Rect::from_min_max(rect.min + Vec2::new(NAME * size, 0.0), rect.max - Vec2::new(VALUE * size, 0.0));
    let middle = room.center().x;
    #[expect(clippy::cast_possible_truncation)] // A part of one.
    let end = |speed: f64| middle + 0.5 * room.width() * (speed / largest).clamp(-1.0, 1.0) as f32;
    let y = room.y_range();
    let drawn =
        Rect::from_x_y_ranges(middle.min(end(one.speed))..=middle.max(end(one.speed)), y.min + 6.0..=y.max - 6.0);
    painter.rect_filled(drawn, 2.0, colour);
    painter.vline(middle, y, Stroke::new(1.0, tokens.frame));
    if let Some((colour, then)) = then {
        painter.vline(end(then), y, Stroke::new(2.0, colour));
    }
    let frequency = one.frequency.map_or_else(String::new, |change| format!("\nFrequency {change:+} % per percent"));
    let waves = one.wave_limit.map_or_else(String::new, |change| format!("\nWave limit {change:+} % per percent"));
    response.explained(format!("Critical speed {:+} % per percent{frequency}{waves}", one.speed)).clicked()
}

/// How far a derivative may be off: the mesh that changes ln v by so much changes derivatives of ln v by about as much.
/// Where nothing is known of it two decimals are shown, and never more than three.
fn uncertainty(share: Option<f64>) -> f64 {
    share.map_or(0.04, |share| share.max(0.004))
}

/// A derivative with its sign; one that is below what is certain is 0.
fn at_least_the_place(value: f64, uncertainty: f64) -> String {
    if value.abs() < 0.1 * uncertainty { "0".into() } else { signed(&digits::with_sign(value, Some(uncertainty))) }
}

fn name(knob: Knob) -> String {
    match knob {
        Knob::YoungsModulus => "E, Young's mod.".into(),
        Knob::Area => "A, area".into(),
        Knob::MassPerLength => "μ, cable mass".into(),
        Knob::OwnYoungsModulus(cable) => format!("E of cable {}", cable + 1),
        Knob::OwnArea(cable) => format!("A of cable {}", cable + 1),
        Knob::OwnMassPerLength(cable) => format!("μ of cable {}", cable + 1),
        Knob::PlatformMass => "m, platform".into(),
        Knob::Tension(cable) => format!("T, cable {}", cable + 1),
        Knob::Alpha => "α, damping".into(),
        Knob::Beta => "β, damping".into(),
        Knob::Gravity => "g, gravity".into(),
    }
}

/// The control that turns a knob: of a tension law its first coefficient.
pub(super) fn control(knob: Knob, scenario: &Scenario) -> Parameter {
    match knob {
        Knob::YoungsModulus => Parameter::YoungsModulus,
        Knob::Area => Parameter::Area,
        Knob::MassPerLength => Parameter::MassPerLength,
        Knob::OwnYoungsModulus(cable) => Parameter::OwnYoungsModulus(cable),
        Knob::OwnArea(cable) => Parameter::OwnArea(cable),
        Knob::OwnMassPerLength(cable) => Parameter::OwnMassPerLength(cable),
        Knob::PlatformMass => Parameter::PlatformMass,
        Knob::Alpha => Parameter::Alpha,
        Knob::Beta => Parameter::Beta,
        Knob::Gravity => Parameter::Gravity,
        Knob::Tension(cable) => match scenario.cables.get(cable).map(|cable| cable.tension) {
            Some(TensionLaw::Hypot { .. }) => Parameter::Horizontal(cable, 0),
            _ => Parameter::Tension(cable),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::fields;
    use crate::scenario::presets;

    /// Every bar leads to a control that is there.
    #[test]
    fn every_knob_has_its_control() {
        let knobs = [
            Knob::YoungsModulus,
            Knob::Area,
            Knob::MassPerLength,
            Knob::PlatformMass,
            Knob::Tension(2),
            Knob::Tension(3),
            Knob::Alpha,
            Knob::Beta,
            Knob::Gravity,
        ];
        for preset in presets::PRESETS {
            let scenario = preset.scenario();
            for knob in knobs {
                let number = control(knob, &scenario);
                assert!(number.is_in(&scenario), "{}: {number:?}", preset.name);
                let shown = match number {
                    Parameter::Tension(_) => true,
                    Parameter::Horizontal(cable, _) => fields::law(cable)[0] == number,
                    _ => {
                        let groups = [&fields::ROPE[..], &fields::PLATFORM, &fields::DAMPING, &[Parameter::Elements]];
                        groups.concat().contains(&number)
                    }
                };
                assert!(shown, "{}: {number:?}", preset.name);
            }
        }
    }
}
