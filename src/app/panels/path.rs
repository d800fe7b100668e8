//! The group of the path: where it leads, how its speed changes, and what the move comes to.

use eframe::egui::{Align, Label, Layout, Sense, Ui, Vec2};

use super::rows::{EditedScenario, rows, take};
use super::segments::{Choice, segments};
use crate::app::canvas;
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::fields::{self, Field};
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::number::Control;
use crate::app::paths;
use crate::app::words::{self, Word};
use crate::compute::protocol::Topic;
use crate::scenario::{Corners, MOST_PATH_POINTS, Parameter, ProfileKind, Scenario};

/// Room for a coordinate, in points.
const COORDINATE: Vec2 = Vec2::new(72.0, 24.0);
/// The same for fingers.
const COORDINATE_FOR_FINGERS: Vec2 = Vec2::new(84.0, 44.0);

const PROFILES: [Choice<ProfileKind>; 4] = [
    (
        ProfileKind::Quintic,
        "quintic",
        "From rest to rest as a polynomial of degree five: speed and acceleration are continuous",
    ),
    (ProfileKind::Trapezoid, "trapezoid", "From rest to rest: constant acceleration, constant speed, constant braking"),
    (ProfileKind::Scurve, "S-curve", "From rest to rest as a trapezoid whose acceleration changes with a limited jerk"),
    (ProfileKind::Constant, "constant", "At one speed from beginning to end, without rest at either"),
];
const CORNERS: [Choice<Corners>; 2] = [
    (Corners::Stop, "stop at points", "Straight from point to point, at rest in each of them"),
    (Corners::Smooth, "smooth", "Along a smooth curve through all points, without a rest between"),
];

/// What the title of the group says: how long the path is.
pub(super) fn summary(scenario: &Scenario) -> String {
    scenario.trajectory().map_or("none".into(), |path| format!("{} m", digits::certain(path.length(), None)))
}

/// Draws the group.
pub(super) fn ui(ui: &mut Ui, sheet: &mut EditedScenario<'_>, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let height = if sheet.touch { 44.0 } else { 28.0 };
    if sheet.edited.path.is_none() {
        let button = IconButton::new(Icon::Plus, "Add a path").text("Add a path").framed().height(height).show(ui);
        let meaning = "A path leads the platform from where it is to other points. Its end and its points can be \
                       dragged on the canvas.";
        if button.explained(meaning).clicked() {
            let border = facts.studies.shown(Topic::Border).map(|shown| shown.known);
            let end = paths::usual_end(&sheet.edited, canvas::frame(&sheet.edited), border);
            sheet.edited = paths::begun(&sheet.edited, end).unwrap_or_else(|| sheet.edited.clone());
        }
        return;
    }
    points(ui, sheet);
    profile(ui, sheet, commands);
    if let Some(trajectory) = sheet.edited.trajectory() {
        let figures = paths::figures(&trajectory);
        let asked = sheet.edited.path.as_ref().map_or(0.0, |path| path.speed);
        figure(ui, "Time of the move", figures.duration, "s", "From the start to the end of the path");
        if figures.speed < 0.995 * asked {
            figure(ui, "Speed reached", figures.speed, "m/s", "The path is too short for the peak speed");
        }
        let meaning = "The largest acceleration of the platform, along the path and in its bends";
        figure(ui, "Peak acceleration", figures.acceleration, "m/s²", meaning);
    }
    ui.add_space(4.0);
    ui.horizontal_wrapped(|ui| {
        let count = sheet.edited.path.as_ref().map_or(0, |path| path.points.len());
        let more = ui.add_enabled_ui(count < MOST_PATH_POINTS, |ui| {
            IconButton::new(Icon::Plus, "Add a point").text("point").framed().height(height).show(ui)
        });
        let meaning = "One more point, in the middle of the longest leg. A double click on the path adds one there.";
        if more.inner.explained(meaning).clicked() {
            sheet.edited = paths::with_another(&sheet.edited);
        }
        let fastest =
            IconButton::new(Icon::None, "Fastest allowed").text("Fastest allowed").framed().height(height).show(ui);
        let meaning = "The shortest time on this path within the limits of the robot, its winches and its waves";
        if fastest.explained(meaning).clicked() {
            commands.push(Command::ShowFastest);
        }
        let remove = IconButton::new(Icon::Close, "Remove the path").text("Remove the path").framed().height(height);
        if remove.show(ui).clicked() {
            sheet.edited.path = None;
        }
    });
}

/// A row for the start and for each point.
fn points(ui: &mut Ui, sheet: &mut EditedScenario<'_>) {
    let count = sheet.edited.path.as_ref().map_or(0, |path| path.points.len());
    point(ui, sheet, "From", [0, 1].map(Parameter::Position), count > 1, None);
    let mut removed = None;
    for i in 0..count {
        let name = paths::name(i, count);
        let numbers = [0, 1].map(|axis| Parameter::PathPoint(i, axis));
        if point(ui, sheet, &name, numbers, count > 1, (count > 1).then_some(i)) {
            removed = Some(i);
        }
    }
    if let Some(i) = removed {
        sheet.edited = paths::without_point(&sheet.edited, i);
    }
}

/// Name and coordinates in one row, with room for the button that removes it where there are such. Gives whether that was
/// pressed.
fn point(
    ui: &mut Ui,
    sheet: &mut EditedScenario<'_>,
    name: &str,
    numbers: [Parameter; 2],
    with_buttons: bool,
    removable: Option<usize>,
) -> bool {
    let frame = canvas::frame(&sheet.edited);
    let size = if sheet.touch { COORDINATE_FOR_FINGERS } else { COORDINATE };
    let row = Vec2::new(ui.available_width(), size.y);
    let mut pressed = false;
    ui.push_id(format!("{:?}", numbers[0]), |ui| {
        ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            if removable.is_some() {
                let label = format!("Remove {}", name.to_lowercase());
                pressed = IconButton::new(Icon::Minus, &label).height(size.y).show(ui).clicked();
            } else if with_buttons {
                ui.add_space(size.y.max(28.0));
            }
            for parameter in numbers.into_iter().rev() {
                let field = Field::of(parameter, frame).in_units_of(sheet.settings);
                let [low, high] = field.range;
                let control = Control { name: field.symbol, unit: field.unit(), step: 0.002 * (high - low), size };
                let answer = control.show(ui, fields::value(parameter, &sheet.edited));
                let label = format!("{name} {}", field.symbol);
                ui.ctx().accesskit_node_builder(answer.response.id, |node| node.set_label(label));
                if sheet.revealed == Some(parameter) {
                    sheet.revealed = None;
                    answer.response.request_focus();
                    answer.response.scroll_to_me(Some(Align::Center));
                }
                take(ui, sheet, &field, answer);
            }
            let rest = Layout::left_to_right(Align::Center);
            let label = ui.with_layout(rest, |ui| ui.add(Label::new(name).truncate().sense(Sense::hover())));
            label.inner.explained(if matches!(numbers[0], Parameter::Position(_)) {
                "The path begins where the platform is: x to the right, y up"
            } else {
                "Where the path leads: x to the right, y up. Drag it on the canvas for the same."
            });
        });
    });
    pressed
}

/// How the speed changes on the path.
fn profile(ui: &mut Ui, sheet: &mut EditedScenario<'_>, commands: &mut Vec<Command>) {
    let touch = sheet.touch;
    let Some(path) = sheet.edited.path.as_mut() else { return };
    if path.points.len() > 1 {
        segments(ui, &mut path.corners, &CORNERS, touch);
    }
    words::link(ui, Word::MotionProfile, "Motion profile", commands);
    if segments(ui, &mut path.profile, &PROFILES, touch) && path.profile == ProfileKind::Constant {
        // It does not come to rest, so nothing can be waited for.
        path.hold = 0.0;
    }
    let list = numbers(path.profile);
    rows(ui, sheet, list);
}

/// The numbers that a profile has.
fn numbers(profile: ProfileKind) -> &'static [Parameter] {
    match profile {
        ProfileKind::Quintic => &[Parameter::PathSpeed, Parameter::PathHold],
        ProfileKind::Trapezoid => &[Parameter::PathSpeed, Parameter::PathAcceleration, Parameter::PathHold],
        ProfileKind::Scurve => {
            &[Parameter::PathSpeed, Parameter::PathAcceleration, Parameter::PathJerk, Parameter::PathHold]
        }
        ProfileKind::Constant => &[Parameter::PathSpeed],
    }
}

/// A figure that follows.
fn figure(ui: &mut Ui, name: &str, value: f64, unit: &str, meaning: &str) {
    let row = Vec2::new(ui.available_width(), 24.0);
    ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
        ui.label(format!("{} {unit}", digits::certain(value, None)));
        let rest = Layout::left_to_right(Align::Center);
        let label = ui.with_layout(rest, |ui| ui.add(Label::new(name).truncate().sense(Sense::hover())));
        label.inner.explained(meaning);
    });
}
