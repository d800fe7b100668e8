//! The path on the canvas: its line with marks of equal times, its points, and what can be done to them.

use eframe::egui::{CursorIcon, Key, Modifiers, Painter, Pos2, Rect, Response, Stroke, Ui, Vec2};

use super::handles::{at_first, drag, handle, handle_of_size, keys, moved, place};
use super::labels::{Pen, beside};
use super::layout::Layout;
use super::{View, model};
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::paths;
use crate::app::round::{round_step, roundest};
use crate::app::theme::{self, Tokens};
use crate::compute::protocol::Topic;
use crate::robot::{Side, Trajectory};
use crate::scenario::Scenario;

/// The width of the line, in points.
const LINE: f32 = 6.0;
/// How far the marks of equal times reach to each side of it, in points.
const MARK: f32 = 6.0;
/// About how many of these there are.
const MARKS: f64 = 8.0;
/// The radius of the end, and of the points between, in points.
const DISCS: [f32; 2] = [8.0, 6.0];
/// A pointer that is nearer than this to the line is on it, in points.
const NEAR: f32 = 10.0;
/// The handle that draws a new path out of the platform is so far below it, and so large, in points.
const NEW: (f32, f32) = (42.0, 36.0);
/// A key press moves by this part of the robot's width; with Shift by a tenth of it.
const KEY_STEP: f64 = 1.0 / 200.0;
/// What the handle of the end goes by, also before there is a path.
const END: &str = "Path end";

/// The path where it is on the screen.
pub struct PathOnCanvas {
    trajectory: Trajectory,
    /// Arc length in m and place on the screen.
    line: Vec<(f64, Pos2)>,
    start: Pos2,
    /// The points that it leads to.
    points: Vec<Pos2>,
}

impl PathOnCanvas {
    /// That of `scenario`, where it has one.
    pub fn new(scenario: &Scenario, view: &View) -> Option<Self> {
        let trajectory = scenario.trajectory()?;
        let on_screen = |(s, place): (f64, [f64; 2])| (s, view.pos_in_ui(place));
        let line = paths::line(scenario, &trajectory).into_iter().map(on_screen).collect();
        let points = scenario.path.iter().flat_map(|path| &path.points).map(|point| view.pos_in_ui(*point)).collect();
        Some(Self { line, start: view.pos_in_ui(scenario.motion.position), points, trajectory })
    }

    /// Draws line, marks and points, and says where it starts and stops.
    ///
    /// The line has the colours of `margins`, arc length (m) and speed over wave limit in rising order, as far as these are
    /// known; beyond 1 that of what is critical.
    pub fn paint(&self, pen: &mut Pen<'_>, compact: bool, margins: &[(f64, f64)]) {
        let (painter, tokens) = (pen.painter, pen.tokens);
        let line: Vec<Pos2> = self.line.iter().map(|point| point.1).collect();
        painter.line(line.clone(), Stroke::new(LINE, tokens.track));
        let mut from: Option<Pos2> = None;
        for (i, &(s, ratio)) in margins.iter().enumerate() {
            let Some(to) = self.at(s) else { continue };
            // A piece shorter than the line is wide would show its edges.
            if let Some(from) = from
                && from.distance(to) < LINE
                && i + 1 < margins.len()
            {
                continue;
            }
            if let Some(from) = from.replace(to) {
                let colour = if ratio > 1.0 { tokens.critical } else { theme::on_map(ratio) };
                painter.line_segment([from, to], Stroke::new(LINE, colour));
            }
        }
        for [from, to] in self.marks() {
            painter.line_segment([from, to], Stroke::new(1.25, tokens.text));
        }
        self.discs(painter, tokens);
        pen.places.add_line(&line);
        let Some(&end) = self.points.last() else { return };
        pen.places.keep_free(Rect::from_center_size(end, Vec2::splat(2.0 * DISCS[0])));
        let words = if self.trajectory.is_rest_to_rest() { "stop" } else { "end" };
        let sides = |at: Pos2, ahead: Vec2| {
            let across = ahead.rot90();
            let down = if across.y > 0.0 { across } else { -across };
            move |size| [ahead, down, -down].map(|side| beside(at, side, 12.0, size)).to_vec()
        };
        let [first, last] = self.tangents();
        pen.write(words.into(), tokens.weak, sides(end, last));
        if !compact {
            pen.write("start".into(), tokens.weak, sides(self.start, -first));
        }
    }

    fn discs(&self, painter: &Painter, tokens: &Tokens) {
        let rim = Stroke::new(2.0, tokens.accent);
        painter.circle(self.start, DISCS[0], tokens.canvas, rim);
        for (i, &at) in self.points.iter().enumerate() {
            let radius = if i + 1 == self.points.len() { DISCS[0] } else { DISCS[1] };
            painter.circle(at, radius, tokens.canvas, rim);
        }
    }

    /// The unit vectors on the screen at the start and at the end.
    fn tangents(&self) -> [Vec2; 2] {
        let length = self.trajectory.length();
        [(0.0, Side::Right), (length, Side::Left)]
            .map(|(s, side)| View::direction_in_ui(self.trajectory.point(s, side).tangent.into()))
    }

    /// Where the line is at arc length `s` (m).
    fn at(&self, s: f64) -> Option<Pos2> {
        let after = self.line.partition_point(|point| point.0 < s).clamp(1, self.line.len().max(2) - 1);
        let (&(from, a), &(to, b)) = (self.line.get(after - 1)?, self.line.get(after)?);
        #[expect(clippy::cast_possible_truncation)] // A part of one.
        let part = if to > from { ((s - from) / (to - from)).clamp(0.0, 1.0) as f32 } else { 0.0 };
        Some(a + (b - a) * part)
    }

    /// Marks across the line, at equal times.
    fn marks(&self) -> Vec<[Pos2; 2]> {
        let duration = self.trajectory.duration();
        let step = round_step(duration / MARKS);
        let times = (1..20_u8).map(|i| f64::from(i) * step).take_while(|time| *time < duration * (1.0 - 1e-9));
        let mark = |time| {
            let moment = self.trajectory.at(time, Side::Right);
            let across = View::direction_in_ui(moment.point.tangent.into()).rot90() * MARK;
            self.at(moment.s).map(|at| [at - across, at + across])
        };
        times.filter_map(mark).collect()
    }

    /// The place on the line that is nearest to a point of the screen, where that is on the line.
    fn nearest(&self, pointer: Pos2) -> Option<Pos2> {
        let on_piece = |ends: &[(f64, Pos2)]| {
            let (from, way) = (ends[0].1, ends[1].1 - ends[0].1);
            let part = ((pointer - from).dot(way) / way.length_sq().max(1e-12)).clamp(0.0, 1.0);
            from + way * part
        };
        let away = |place: &Pos2| (*place - pointer).length();
        let nearest = self.line.windows(2).map(on_piece).min_by(|a, b| away(a).total_cmp(&away(b)))?;
        (away(&nearest) < NEAR).then_some(nearest)
    }

    /// Whether the pointer is on the line.
    pub fn is_under_pointer(&self, background: &Response) -> bool {
        let pointer = background.hover_pos().or(background.interact_pointer_pos());
        pointer.is_some_and(|pointer| self.nearest(pointer).is_some())
    }
}

/// What can be done to the path by hand: its points are dragged, moved by arrow keys and deleted, a double click on the line
/// adds one, and where there is none its end is drawn out of the platform. Gives the scenario with what was done.
pub fn handles(
    ui: &Ui,
    painter: &Painter,
    layout: &Layout,
    path: Option<&PathOnCanvas>,
    background: &Response,
    facts: Facts<'_>,
) -> Option<Scenario> {
    let scenario = &facts.document.scenario;
    let Some(path) = path else { return begin(ui, painter, layout, facts) };
    let view = &layout.view;
    if background.double_clicked()
        && let Some(on_line) = background.interact_pointer_pos().and_then(|pointer| path.nearest(pointer))
    {
        let point = view.pos_in_world(on_line).map(|coordinate| roundest(coordinate, 1.0 / view.scale));
        return Some(paths::with_point(scenario, point));
    }
    let mut edited = scenario.clone();
    let count = path.points.len();
    for (i, &centre) in path.points.iter().enumerate() {
        let Some(point) = edited.path.as_mut().and_then(|path| path.points.get_mut(i)) else { continue };
        let name = if i + 1 == count { END.to_owned() } else { format!("Path point {}", i + 1) };
        let response = handle(ui, painter, &name, place(*point), centre, CursorIcon::Grab);
        if let Some(grabbed) = drag(ui, &response, centre) {
            *point = moved(at_first(ui, &response, *point), view.pos_in_world(grabbed), view);
        }
        if let Some(([x, y], fine)) = keys(ui, &response) {
            let step = KEY_STEP * model::frame(scenario).size().x * fine;
            *point = [point[0] + x * step, point[1] + y * step];
        }
        let [x, y] = *point;
        if response.has_focus() && delete(ui) {
            return Some(paths::without_point(scenario, i));
        }
        if !response.dragged() {
            let text = format!("{name} at ({x:.3}, {y:.3}) m. Drag it; arrow keys move it, Delete removes it.");
            response.explained(text);
        }
    }
    // Where a hand passes the point before, the last good path stays.
    (edited.path != scenario.path && edited.trajectory().is_some()).then_some(edited)
}

/// The handle that draws the end of a new path out of the platform.
fn begin(ui: &Ui, painter: &Painter, layout: &Layout, facts: Facts<'_>) -> Option<Scenario> {
    let scenario = &facts.document.scenario;
    let (away, size) = NEW;
    let centre = layout.platform - layout.up() * away;
    let tokens = theme::tokens(ui.visuals());
    let value = "drag it out".to_owned();
    let response = handle_of_size(ui, painter, [END, "New path"], value, (centre, size), CursorIcon::Grab);
    let colour = if response.hovered() || response.has_focus() { tokens.accent } else { tokens.mute };
    painter.line_segment([layout.platform - layout.up() * 12.0, centre + layout.up() * 6.0], Stroke::new(1.25, colour));
    painter.circle(centre, 6.0, tokens.canvas, Stroke::new(1.5, colour));
    for arm in [Vec2::X, Vec2::Y] {
        painter.line_segment([centre - arm * 3.0, centre + arm * 3.0], Stroke::new(1.25, colour));
    }
    if response.clicked() {
        let border = facts.studies.shown(Topic::Border).map(|shown| shown.known);
        return paths::begun(scenario, paths::usual_end(scenario, model::frame(scenario), border));
    }
    let edited = drag(ui, &response, centre).and_then(|grabbed| {
        let first = at_first(ui, &response, layout.view.pos_in_world(centre));
        paths::begun(scenario, moved(first, layout.view.pos_in_world(grabbed), &layout.view))
    });
    if !response.dragged() {
        response.explained("Drag the end of a path out of the platform, or click for one across the robot.");
    }
    edited
}

/// Whether what has the focus is to go.
fn delete(ui: &Ui) -> bool {
    ui.input_mut(|input| [Key::Delete, Key::Backspace].into_iter().any(|key| input.consume_key(Modifiers::NONE, key)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::state::Camera;
    use crate::scenario::{Path, presets};
    use eframe::egui::epaint::MarginF32;

    fn path(points: Vec<[f64; 2]>) -> (PathOnCanvas, View) {
        let mut scenario = presets::PRESETS[0].scenario();
        scenario.path = Some(Path::new(points, 5.0));
        let canvas = Rect::from_min_size(Pos2::ZERO, Vec2::new(600.0, 400.0));
        let view = View::new(canvas, MarginF32::ZERO, model::frame(&scenario), Camera::default());
        (PathOnCanvas::new(&scenario, &view).expect("a path"), view)
    }

    #[test]
    fn marks_are_closer_where_it_is_slower() {
        let (path, view) = path(vec![[6.0, 0.0]]);
        // 6 m at a peak of 5 m/s take 2.25 s: one each 0.5 s.
        let marks = path.marks();
        assert_eq!(marks.len(), 4);
        let at: Vec<f32> = marks.iter().map(|[from, to]| 0.5 * (from.x + to.x)).collect();
        assert!(at[1] - at[0] > at[0] - path.start.x && at[2] - at[1] > at[3] - at[2], "{at:?}");
        // By hand: τ = 0.5/2.25, s = 6 (10 τ³ − 15 τ⁴ + 6 τ⁵).
        let t: f64 = 0.5 / 2.25;
        let s = 6.0 * (10.0 * t.powi(3) - 15.0 * t.powi(4) + 6.0 * t.powi(5));
        assert!((at[0] - view.pos_in_ui([s, 0.0]).x).abs() < 1e-2, "{at:?}");
    }

    #[test]
    fn the_nearest_place_of_the_line_is_on_it() {
        let (path, view) = path(vec![[6.0, 0.0], [6.0, 3.0]]);
        let on = view.pos_in_ui([4.0, 0.0]);
        let found = path.nearest(on + Vec2::new(0.0, 7.0)).expect("on the line");
        assert!((found - on).length() < 1e-3, "{found:?}");
        assert_eq!(path.nearest(on + Vec2::new(0.0, 20.0)), None);
        let corner = view.pos_in_ui([6.0, 0.0]);
        assert!(path.at(6.0).is_some_and(|at| (at - corner).length() < 1e-3));
        assert!(path.at(7.5).is_some_and(|at| (at - view.pos_in_ui([6.0, 1.5])).length() < 1e-3));
    }
}
