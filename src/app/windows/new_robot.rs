//! A new robot: its winches are put where somebody clicks, and numbers are given to the rest.

use std::ops::RangeInclusive;

use eframe::egui::{
    Align2, Color32, CursorIcon, Pos2, Rect, RichText, Role, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, Ui,
    Vec2, WidgetInfo,
};

use crate::app::command::Command;
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::number::{Control, Unit};
use crate::app::theme::{self, Tokens};
use crate::robot::CABLES;
use crate::scenario::{Scenario, from_winches};

/// The widest and the narrowest area, in m.
const WIDTHS: RangeInclusive<f64> = 0.1..=1000.0;
/// Winches are put on a grid with so many steps in the width.
const STEPS: f64 = 40.0;
/// A click this near to a winch, in points, takes hold of it.
const NEAR: f32 = 14.0;
/// The height of the list of winches in points; a longer one scrolls.
const LIST: f32 = 132.0;

/// The winches of a robot that is being made.
#[derive(Clone, Debug)]
pub struct Winches {
    /// In m, by their numbers.
    points: Vec<[f64; 2]>,
    /// The width of the area in m; its height is half of that.
    width: f64,
    /// The one that is being dragged.
    held: Option<usize>,
    /// Why there is no robot yet.
    trouble: Option<String>,
}

impl Default for Winches {
    /// An area as large as the paper's workspace, and nothing in it.
    fn default() -> Self {
        Self { points: Vec::new(), width: 20.0, held: None, trouble: None }
    }
}

impl Winches {
    /// On the grid and in the area.
    fn snapped(&self, point: [f64; 2]) -> [f64; 2] {
        let step = self.width / STEPS;
        let most = [self.width / 2.0, self.width / 4.0];
        [0, 1].map(|i| {
            let snapped = ((point[i] / step).round() * step).clamp(-most[i], most[i]);
            // No minus before zero.
            snapped + 0.0
        })
    }

    /// Puts one more, where there is room for it and none there yet.
    fn put(&mut self, point: [f64; 2]) {
        if self.points.len() < *CABLES.end() && !self.points.contains(&point) {
            self.points.push(point);
        }
        self.trouble = None;
    }

    /// A place for one more that nobody has chosen: a corner, or else the next free step of the upper edge.
    fn free(&self) -> [f64; 2] {
        let [x, y] = [self.width / 2.0, self.width / 4.0];
        let corners = [[-x, y], [x, y], [-x, -y], [x, -y]];
        let along = (1..).map(|step| self.snapped([-x + f64::from(step) * self.width / STEPS, y]));
        corners.into_iter().chain(along).find(|point| !self.points.contains(point)).unwrap_or([0.0, 0.0])
    }

    /// The robot, or why there is none.
    fn robot(&self) -> Result<Scenario, String> {
        let scenario = from_winches(&self.points).map_err(|reason| reason.to_string())?;
        Ok(Scenario { name: Some("My robot".into()), ..scenario })
    }
}

/// Draws the area, the list of winches and the button that makes the robot. Gives whether it was made.
pub fn ui(winches: &mut Winches, ui: &mut Ui, commands: &mut Vec<Command>) -> bool {
    ui.label(
        "Click where the winches are, 3 to 8 of them. Two that are high and far apart hold the platform; the others get a \
         constant tension. Ropes, masses and tensions are then set at the left.",
    );
    ui.add_space(6.0);
    width(winches, ui);
    area(winches, ui);
    list(winches, ui);
    ui.add_space(6.0);
    let mut made = false;
    ui.horizontal_wrapped(|ui| {
        let enough = winches.points.len() >= *CABLES.start();
        let button = ui.add_enabled(enough, eframe::egui::Button::new("Make the robot"));
        if button.explained("Opens it. One step of undo brings the present robot back.").clicked() {
            match winches.robot() {
                Ok(scenario) => {
                    commands.push(Command::Load(Box::new(scenario)));
                    *winches = Winches::default();
                    made = true;
                }
                Err(reason) => winches.trouble = Some(reason),
            }
        }
        let missing = CABLES.start().saturating_sub(winches.points.len());
        match &winches.trouble {
            Some(reason) => ui.colored_label(theme::tokens(ui.visuals()).critical, reason),
            None if missing > 0 => ui.weak(format!("{missing} more to go")),
            None => ui.weak(format!("{} cables", winches.points.len())),
        };
    });
    made
}

/// The width of the area. What is there already stays where it is, unless that is outside.
fn width(winches: &mut Winches, ui: &mut Ui) {
    ui.horizontal(|ui| {
        let name = ui.label("Width of the area");
        let control =
            Control { name: "Width of the area", unit: Unit::of("m"), step: 0.1, size: Vec2::new(84.0, 24.0) };
        let mut answer = control.show(ui, winches.width);
        answer.response = answer.response.labelled_by(name.id);
        match answer.value {
            Some(value) if WIDTHS.contains(&value) => {
                winches.width = value;
                let [x, y] = [value / 2.0, value / 4.0];
                winches.points.retain(|point| point[0].abs() <= x && point[1].abs() <= y);
            }
            Some(_) => answer.refuse(ui, format!("{} to {} m", WIDTHS.start(), WIDTHS.end())),
            None => {}
        }
    });
}

/// The area with its grid and winches.
fn area(winches: &mut Winches, ui: &mut Ui) {
    let tokens = theme::tokens(ui.visuals());
    let room = ui.available_width();
    let (outer, response) = ui.allocate_exact_size(Vec2::new(room, 0.5 * room + 12.0), Sense::click_and_drag());
    let count = winches.points.len();
    response.widget_info(|| WidgetInfo {
        label: Some("Area for winches".into()),
        current_text_value: Some(format!("{count} winches")),
        ..WidgetInfo::new(Role::Canvas)
    });
    let response = response.on_hover_cursor(CursorIcon::Crosshair);
    let rect = outer.shrink(16.0);
    let scale = f64::from(rect.width()) / winches.width;
    let height = scale * winches.width / 2.0;
    #[expect(clippy::cast_possible_truncation)] // Points on the screen.
    let rect = Rect::from_center_size(rect.center(), Vec2::new(rect.width(), height as f32));
    grid(ui, rect, tokens, winches.width);
    #[expect(clippy::cast_possible_truncation)] // Points on the screen.
    let in_ui = |[x, y]: [f64; 2]| rect.center() + Vec2::new((x * scale) as f32, (-y * scale) as f32);
    let in_world = |at: Pos2| {
        let away = at - rect.center();
        [f64::from(away.x) / scale, f64::from(-away.y) / scale]
    };
    let near = |at: Pos2| winches.points.iter().position(|&point| in_ui(point).distance(at) < NEAR);
    if let Some(at) = response.interact_pointer_pos() {
        let at_winch = near(at);
        let target = winches.snapped(in_world(at));
        if response.drag_started() {
            winches.held = at_winch;
        }
        if response.clicked() && at_winch.is_none() {
            winches.put(target);
        }
        if let Some(held) = winches.held.filter(|_| response.dragged())
            && !winches.points.contains(&target)
        {
            winches.points[held] = target;
            winches.trouble = None;
        }
    }
    if !response.dragged() {
        winches.held = None;
    }
    let font = TextStyle::Body.resolve(ui.style());
    for (i, &point) in winches.points.iter().enumerate() {
        let at = in_ui(point);
        let square = Rect::from_center_size(at, Vec2::splat(12.0));
        ui.painter().rect(square, 2.0, tokens.card, Stroke::new(2.0, tokens.text), StrokeKind::Middle);
        // Beside it, towards the middle.
        let side = if at.x < rect.center().x { 1.0 } else { -1.0 };
        let align = if side > 0.0 { Align2::LEFT_CENTER } else { Align2::RIGHT_CENTER };
        ui.painter().text(at + Vec2::new(12.0 * side, 0.0), align, i + 1, font.clone(), tokens.text);
    }
}

/// Lines at every quarter of the height, with metres along the lower and the left edge.
fn grid(ui: &Ui, rect: Rect, tokens: &Tokens, width: f64) {
    let painter = ui.painter();
    painter.rect(rect, 2.0, Color32::TRANSPARENT, Stroke::new(1.0, tokens.frame), StrokeKind::Middle);
    let font = TextStyle::Small.resolve(ui.style());
    for k in 0..=8_u8 {
        let part = f32::from(k) / 8.0;
        let x = rect.left() + part * rect.width();
        painter.vline(x, rect.y_range(), Stroke::new(1.0, tokens.line));
        let metres = (f64::from(part) - 0.5) * width;
        if k % 2 == 0 {
            let unit = if k == 8 { " m" } else { "" };
            let text = format!("{}{unit}", crate::app::number::brief(metres)).replace('-', "−");
            let align = if k == 8 { Align2::RIGHT_TOP } else { Align2::CENTER_TOP };
            painter.text(Pos2::new(x, rect.bottom() + 1.0), align, text, font.clone(), tokens.numbers);
        }
    }
    for k in 0..=4_u8 {
        let y = rect.top() + f32::from(k) / 4.0 * rect.height();
        painter.hline(rect.x_range(), y, Stroke::new(1.0, tokens.line));
    }
}

/// Every winch in numbers, to be typed; one more without a pointer. It has its room from the start: the area must not move
/// under the hand that clicks.
fn list(winches: &mut Winches, ui: &mut Ui) {
    let room = winches.points.len() < *CABLES.end();
    if ui.add_enabled(room, eframe::egui::Button::new("+ winch")).explained("One more, at a free corner").clicked() {
        winches.put(winches.free());
    }
    ui.add_space(4.0);
    let rows = Vec2::new(ui.available_width(), LIST);
    ui.allocate_ui(rows, |ui| {
        ui.set_min_size(rows);
        ScrollArea::vertical().id_salt("winches").max_height(LIST).show(ui, |ui| each(winches, ui));
    });
}

/// A row for each winch.
fn each(winches: &mut Winches, ui: &mut Ui) {
    let mut removed = None;
    for (i, point) in winches.points.iter_mut().enumerate() {
        ui.push_id(i, |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new(format!("{}", i + 1)).strong());
                for (axis, name) in ["x", "y"].into_iter().enumerate() {
                    let label = format!("Winch {} {name}", i + 1);
                    let control = Control { name: &label, unit: Unit::of("m"), step: 0.1, size: Vec2::new(84.0, 24.0) };
                    ui.label(name);
                    let answer = control.show(ui, point[axis]);
                    answer.response.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, &label));
                    if let Some(value) = answer.value {
                        point[axis] = value;
                        winches.trouble = None;
                    }
                }
                let name = format!("Remove winch {}", i + 1);
                if IconButton::new(Icon::Close, &name).show(ui).explained(name.as_str()).clicked() {
                    removed = Some(i);
                }
            });
        });
    }
    if let Some(i) = removed {
        winches.points.remove(i);
        winches.trouble = None;
    }
}
