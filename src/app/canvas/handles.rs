//! What can be grabbed on the canvas: the platform, the arrow's tip, the background. All of it by keyboard, too.

use eframe::egui::{
    CursorIcon, EventFilter, InputState, Key, Painter, Pos2, Rect, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo,
};

use super::layout::Layout;
use super::paint::trimmed;
use super::{Scene, View};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::meaning::Explain as _;
use crate::app::round::roundest;
use crate::app::state::{Camera, Document};
use crate::app::theme;

/// Size of what can be grabbed, in points; a finger needs this much.
const GRAB: f32 = 40.0;
/// A key press moves by this part of the robot's width; with Shift by a tenth of it.
const KEY_STEP: f64 = 1.0 / 200.0;
/// Speeds change by this much per key press, in m/s; with Shift by a tenth of it.
const SPEED_STEP: f64 = 0.5;
/// Directions turn by this much per key press, in radians; with Shift by a tenth of it.
const TURN_STEP: f64 = 0.1;

/// What the pointer holds.
#[derive(Clone, Copy, Debug, Default)]
pub struct Held {
    /// The platform.
    pub platform: bool,
    /// The arrow's tip.
    pub tip: bool,
}

/// A speed in m/s, in words.
pub fn speed(metres_per_second: f64) -> String {
    format!("{} m/s", digits::certain(metres_per_second, Some(0.005)))
}

/// The platform and the arrow's tip. Gives what is held.
pub fn ui(
    ui: &mut Ui,
    painter: &Painter,
    layout: &Layout,
    scene: &Scene,
    document: &Document,
    commands: &mut Vec<Command>,
) -> Held {
    let Layout { view, arrow, .. } = layout;
    let at = place(document.scenario.motion.position);
    let platform = handle(ui, painter, "Platform", at, layout.platform, CursorIcon::Grab);
    let mut scenario = document.scenario.clone();
    let motion = &mut scenario.motion;
    if let Some(grabbed) = drag(ui, &platform, layout.platform) {
        let first = at_first(ui, &platform, motion.position);
        motion.position = moved(first, view.pos_in_world(grabbed), view);
    }
    if let Some(([x, y], fine)) = keys(ui, &platform) {
        let step = KEY_STEP * scene.frame.size().x * fine;
        motion.position = [motion.position[0] + x * step, motion.position[1] + y * step];
    }
    let [x, y] = motion.position;
    let platform_held = platform.is_pointer_button_down_on();
    if !platform.dragged() {
        let text = format!("Platform at ({x:.3}, {y:.3}) m. Drag it; arrow keys move it, with Shift finely.");
        platform.explained(text);
    }

    let tip = handle(ui, painter, "Velocity", velocity(motion.speed, motion.direction), layout.tip, CursorIcon::Grab);
    if let Some(grabbed) = drag(ui, &tip, layout.tip) {
        let first = at_first(ui, &tip, (motion.speed, motion.direction));
        let from_platform = grabbed - layout.platform;
        let [speed, point] = arrow.speed(from_platform.length(), view.scale);
        motion.speed = meant(first.0, speed, point).max(0.0);
        if from_platform.length() > 1.0 {
            let [x, y] = view.vec_in_world(from_platform);
            let [along, across] = [[x, y], [-y, x]].map(|[a, b]| (a * first.1[0] + b * first.1[1]) * view.scale);
            let length = first.1[0].hypot(first.1[1]);
            let is_first = along > 0.0 && across.abs() < 0.5 * length;
            motion.direction = if is_first { first.1 } else { [x / x.hypot(y), y / x.hypot(y)] };
        }
    }
    if let Some(([turn, faster], fine)) = keys(ui, &tip) {
        motion.speed = (motion.speed + faster * SPEED_STEP * fine).max(0.0);
        let (sine, cosine) = (-turn * TURN_STEP * fine).sin_cos();
        let [x, y] = motion.direction;
        motion.direction = [cosine * x - sine * y, sine * x + cosine * y];
    }
    let held = Held { platform: platform_held, tip: tip.is_pointer_button_down_on() };
    if !tip.dragged() {
        let speed = motion.speed;
        let step = arrow.step;
        tip.explained(format!(
            "Velocity {speed:.2} m/s; 1 m of the arrow is {step} m/s. Drag it for direction and speed; keys: ← → turn, \
             ↑ ↓ speed, with Shift finely."
        ));
    }
    if scenario.motion != document.scenario.motion {
        commands.push(Command::Edit(Box::new(scenario)));
    }
    held
}

/// The winches, once they are unlocked.
pub fn winches(
    ui: &mut Ui,
    painter: &Painter,
    layout: &Layout,
    scene: &Scene,
    document: &Document,
    commands: &mut Vec<Command>,
) {
    let mut scenario = document.scenario.clone();
    for (i, (cable, &centre)) in scenario.cables.iter_mut().zip(&layout.winches).enumerate() {
        let name = format!("Winch {}", i + 1);
        let winch = handle(ui, painter, &name, place(cable.anchor), centre, CursorIcon::Grab);
        if let Some(grabbed) = drag(ui, &winch, centre) {
            cable.anchor = moved(at_first(ui, &winch, cable.anchor), layout.view.pos_in_world(grabbed), &layout.view);
        }
        if let Some(([x, y], fine)) = keys(ui, &winch) {
            let step = KEY_STEP * scene.frame.size().x * fine;
            cable.anchor = [cable.anchor[0] + x * step, cable.anchor[1] + y * step];
        }
        if !winch.dragged() {
            let [x, y] = cable.anchor;
            winch.explained(format!("Winch {} at ({x:.3}, {y:.3}) m. Drag it; arrow keys move it.", i + 1));
        }
    }
    if scenario.cables != document.scenario.cables {
        commands.push(Command::Edit(Box::new(scenario)));
    }
}

/// A place in m, in words.
pub(super) fn place(place: [f64; 2]) -> String {
    // Without a sign where it rounds to 0.
    let [x, y] = place.map(|coordinate| (100.0 * coordinate).round() / 100.0 + 0.0);
    format!("({x:.2}, {y:.2}) m")
}

/// A velocity in words: its speed and its direction, 0° to the right and 90° upward.
fn velocity(metres_per_second: f64, [x, y]: [f64; 2]) -> String {
    // Without a sign where it rounds to 0.
    let degrees = (10.0 * y.atan2(x).to_degrees()).round() / 10.0 + 0.0;
    format!("{} at {}°", speed(metres_per_second), trimmed(degrees))
}

/// A thing to grab at `centre`, with a ring when it has the keyboard's focus. `value` says where it is, in words.
pub(super) fn handle(
    ui: &Ui,
    painter: &Painter,
    name: &str,
    value: String,
    centre: Pos2,
    cursor: CursorIcon,
) -> Response {
    handle_of_size(ui, painter, [name, name], value, (centre, GRAB), cursor)
}

/// The same of another size than usual. One that is called otherwise than before, but has the same first name, goes on being
/// dragged.
pub(super) fn handle_of_size(
    ui: &Ui,
    painter: &Painter,
    [id, name]: [&str; 2],
    value: String,
    (centre, size): (Pos2, f32),
    cursor: CursorIcon,
) -> Response {
    let rect = Rect::from_center_size(centre, Vec2::splat(size));
    let response = ui.interact(rect, ui.scope_id().with(id), Sense::click_and_drag()).on_hover_cursor(cursor);
    let info = WidgetInfo { current_text_value: Some(value), ..WidgetInfo::labeled(Role::Button, true, name) };
    response.widget_info(|| info.clone());
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    if response.has_focus() || response.hovered() {
        painter.circle_stroke(centre, 0.5 * size, Stroke::new(1.5, theme::accent(ui.visuals())));
    }
    response
}

/// Where a dragged handle's centre is to go: it keeps the distance to the pointer that it had when it was grabbed.
pub(super) fn drag(ui: &Ui, response: &Response, centre: Pos2) -> Option<Pos2> {
    let offset = response.id.with("offset");
    let pointer = response.interact_pointer_pos()?;
    if response.drag_started() {
        let pressed = ui.input(|input| input.pointer.press_origin()).unwrap_or(pointer);
        ui.data_mut(|data| data.insert_temp(offset, centre - pressed));
    }
    if !response.dragged() {
        return None;
    }
    let kept: Vec2 = ui.data(|data| data.get_temp(offset)).unwrap_or_default();
    Some(pointer + kept)
}

/// What a handle moves, as it was when the drag began.
pub(super) fn at_first<T: Copy + Send + Sync + 'static>(ui: &Ui, response: &Response, now: T) -> T {
    let id = response.id.with("first");
    if response.drag_started() {
        ui.data_mut(|data| data.insert_temp(id, now));
    }
    ui.data(|data| data.get_temp(id)).unwrap_or(now)
}

/// Where a hand moves a point of the world to; a coordinate that it does not move stays as it is.
pub(super) fn moved(first: [f64; 2], to: [f64; 2], view: &View) -> [f64; 2] {
    [0, 1].map(|i| meant(first[i], to[i], 1.0 / view.scale))
}

/// The number that a hand means that moves `first` to `to`, where a point of the screen is so much.
fn meant(first: f64, to: f64, point: f64) -> f64 {
    if (to - first).abs() < 0.5 * point { first } else { roundest(to, point) }
}

/// Arrow keys pressed while `response` has the focus: right minus left, up minus down, and 0.1 with Shift.
pub(super) fn keys(ui: &Ui, response: &Response) -> Option<([f64; 2], f64)> {
    if !response.has_focus() {
        return None;
    }
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    ui.input(|input| {
        // Held keys repeat; each repetition is a press. The count is small.
        #[expect(clippy::cast_precision_loss)]
        let pressed = |key: Key| input.num_presses(key) as f64;
        let x = pressed(Key::ArrowRight) - pressed(Key::ArrowLeft);
        let y = pressed(Key::ArrowUp) - pressed(Key::ArrowDown);
        let fine = if input.modifiers.shift { 0.1 } else { 1.0 };
        (x != 0.0 || y != 0.0).then_some(([x, y], fine))
    })
}

/// Zoom with the wheel or two fingers, pan by dragging the background; where clicks mean nothing else, double-click to
/// see the whole robot. Where the wheel does not zoom by itself, because it scrolls the page around, it does so with Ctrl.
pub fn camera(
    camera: &mut Camera,
    ui: &Ui,
    background: &Response,
    view: &View,
    clicks_are_free: bool,
    wheel_zooms: bool,
) {
    if background.double_clicked() && clicks_are_free {
        *camera = Camera::default();
        return;
    }
    let touch = ui.input(InputState::multi_touch).filter(|touch| view.rect.contains(touch.center_pos));
    let moved = match touch {
        Some(touch) => touch.translation_delta,
        None if background.dragged() => {
            // A drag is recognised some points after it began; those count as well.
            let begun = background.total_drag_delta().filter(|_| background.drag_started());
            begun.unwrap_or_else(|| background.drag_delta())
        }
        None => Vec2::ZERO,
    };
    if moved != Vec2::ZERO {
        let [x, y] = view.vec_in_world(moved);
        camera.offset = [camera.offset[0] - x, camera.offset[1] - y];
    }
    let pointer = ui.input(|input| input.pointer.hover_pos().or(input.pointer.interact_pos()));
    let pointer = pointer.filter(|_| background.contains_pointer());
    let Some(pointer) = touch.map(|touch| touch.center_pos).or(pointer) else { return };
    let factor = ui.input(|input| {
        // With Ctrl the wheel comes as a zoom, not as scrolling.
        let wheel = if wheel_zooms { (f64::from(input.smooth_scroll_delta().y) / 300.0).exp() } else { 1.0 };
        f64::from(input.zoom_delta()) * wheel
    });
    if (factor - 1.0).abs() < 1e-9 {
        return;
    }
    let zoom = (camera.zoom * factor).clamp(0.2, 200.0);
    // The point under the pointer stays there.
    let keep = 1.0 - camera.zoom / zoom;
    let [x, y] = view.vec_in_world(pointer - view.middle);
    camera.offset = [camera.offset[0] + x * keep, camera.offset[1] + y * keep];
    camera.zoom = zoom;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_told_in_metres() {
        assert_eq!(place([-0.001, 4.946]), "(0.00, 4.95) m");
        assert_eq!(place([8.0, -3.0]), "(8.00, -3.00) m");
    }

    #[test]
    fn a_velocity_is_told_with_its_direction() {
        assert_eq!(velocity(5.0, [1.0, 0.0]), "5.00 m/s at 0°");
        assert_eq!(velocity(12.0, [0.0, -2.0]), "12.00 m/s at −90°");
        assert_eq!(velocity(0.4, [1.0, -1e-9]), "0.40 m/s at 0°");
        assert_eq!(velocity(0.0, [1.0, 1.0]), "0 m/s at 45°");
    }
}
