//! The velocity's arrow with the speeds marked on its line: the critical one and the wave limit.

use eframe::egui::{Color32, Pos2, Rect, Shape, Stroke, Vec2};

use super::labels::{Pen, beside};
use super::layout::{Layout, SpeedMark};
use super::paint::dashed;
use super::{Scene, View};

/// How far a mark reaches to each side of the line, in points.
const REACH: f32 = 11.0;

/// What is said of the speeds on the line.
#[derive(Clone, Debug, Default)]
pub struct Said {
    /// The present speed.
    pub speed: String,
    /// The critical speed.
    pub critical: String,
    /// Whether that is an earlier one, which has been recomputed for a while.
    pub is_old: bool,
    /// The wave limit; nothing where there is no room for it.
    pub waves: String,
}

/// Draws the arrow with its marks.
pub fn ui(pen: &mut Pen<'_>, layout: &Layout, scene: &Scene, said: Said) {
    let critical = scene.critical.and_then(|first| layout.mark(first.speed));
    let waves = scene.waves.and_then(|speed| layout.mark(speed));
    let tokens = pen.tokens;
    let critical_colour = if said.is_old { tokens.mute } else { tokens.critical };
    if let Some(farthest) =
        critical.into_iter().chain(waves).max_by(|a, b| away(layout, *a).total_cmp(&away(layout, *b)))
        && away(layout, farthest) > (layout.tip - layout.platform).length() + 1.0
    {
        let colour = if critical.is_some() { critical_colour } else { tokens.waves };
        dashed(pen.painter, [layout.tip, farthest.at], Stroke::new(1.5, colour), [3.0, 3.0]);
        pen.places.add_line(&[layout.tip, farthest.at]);
    }
    if let Some(mark) = waves {
        tick(pen, layout, mark, Stroke::new(1.75, tokens.waves), true, -1.0);
    }
    if let Some(mark) = critical {
        tick(pen, layout, mark, Stroke::new(3.0, critical_colour), false, 1.0);
    }
    arrow(pen, layout, scene.unstable);
    platform(pen, layout, scene.unstable);
    let up = layout.up();
    let sides = move |at: Pos2, gap: f32, first: f32| {
        move |size: Vec2| -> Vec<Rect> {
            // One beside the line, else one more row away.
            let rows = [0.0, size.y + 4.0].into_iter().flat_map(|row| [(first, row), (-first, row)]);
            rows.map(|(side, row)| beside(at, up * side, gap + row, size)).collect()
        }
    };
    if let Some(mark) = critical {
        let colour = if said.is_old { tokens.weak } else { tokens.critical };
        pen.write(said.critical, colour, sides(mark.at, REACH + 2.0, 1.0));
    }
    let colour = if scene.unstable { tokens.critical } else { tokens.accent };
    pen.write(said.speed, colour, sides(layout.tip, 9.0, -1.0));
    if let Some(mark) = waves.filter(|_| !said.waves.is_empty()) {
        pen.write(said.waves, tokens.waves, sides(mark.at, REACH + 2.0, -1.0));
    }
}

fn away(layout: &Layout, mark: SpeedMark) -> f32 {
    (mark.at - layout.platform).length()
}

/// A mark across the line; beyond the canvas a small triangle that points there, on one side of the line.
fn tick(pen: &Pen<'_>, layout: &Layout, mark: SpeedMark, stroke: Stroke, dotted: bool, side: f32) {
    let (ahead, up) = (layout.ahead, layout.up());
    if mark.beyond {
        let middle = mark.at + up * (7.0 * side);
        let corners = vec![middle + ahead * 5.0, middle - ahead * 4.0 + up * 5.0, middle - ahead * 4.0 - up * 5.0];
        let rim = Stroke::new(1.5, stroke.color);
        pen.painter.add(Shape::convex_polygon(corners, pen.tokens.canvas, rim));
        return;
    }
    let ends = [mark.at - up * REACH, mark.at + up * REACH];
    if dotted {
        dashed(pen.painter, ends, stroke, [2.0, 2.0]);
    } else {
        pen.painter.line_segment(ends, stroke);
    }
}

fn arrow(pen: &mut Pen<'_>, layout: &Layout, unstable: bool) {
    let (ahead, tip, tokens) = (layout.ahead, layout.tip, pen.tokens);
    let colour = if unstable { tokens.critical } else { tokens.accent };
    let line = [layout.platform + ahead * 13.0, tip - ahead * 8.0];
    pen.painter.line_segment(line, Stroke::new(6.0, tokens.canvas));
    if unstable {
        dashed(pen.painter, line, Stroke::new(3.0, colour), [7.0, 4.0]);
    } else {
        pen.painter.line_segment(line, Stroke::new(3.0, colour));
    }
    pen.painter.add(Shape::convex_polygon(head(tip, ahead), colour, Stroke::new(1.5, tokens.canvas)));
    pen.places.add_line(&line);
}

/// An arrow's head with its tip there.
pub fn head(tip: Pos2, ahead: Vec2) -> Vec<Pos2> {
    let across = ahead.rot90();
    vec![tip, tip - ahead * 12.0 + across * 6.0, tip - ahead * 12.0 - across * 6.0]
}

/// A circle; a diamond where it is unstable.
fn platform(pen: &mut Pen<'_>, layout: &Layout, unstable: bool) {
    let (at, tokens) = (layout.platform, pen.tokens);
    let rim = Stroke::new(2.0, tokens.canvas);
    if unstable {
        let corners = [Vec2::UP, Vec2::RIGHT, Vec2::DOWN, Vec2::LEFT].map(|side| at + side * 14.0);
        pen.painter.add(Shape::convex_polygon(corners.to_vec(), tokens.critical, rim));
    } else {
        pen.painter.circle(at, 10.0, tokens.accent, rim);
    }
    pen.places.keep_free(Rect::from_center_size(at, Vec2::splat(24.0)));
}

/// A dashed arrow in the direction with the lowest critical speed, with that speed in m/s.
pub fn worst(pen: &mut Pen<'_>, layout: &Layout, direction: [f64; 2], speed: &str) {
    let colour: Color32 = pen.tokens.critical;
    let ahead = View::direction_in_ui(direction);
    let tip = layout.platform + ahead * 74.0;
    dashed(pen.painter, [layout.platform + ahead * 14.0, tip - ahead * 8.0], Stroke::new(2.5, colour), [5.0, 4.0]);
    pen.painter.add(Shape::convex_polygon(head(tip, ahead), pen.tokens.canvas, Stroke::new(2.0, colour)));
    let across = ahead.rot90();
    let places = |size| [ahead, across, -across].map(|side| beside(tip, side, 6.0, size)).to_vec();
    pen.write(format!("worst: {speed} m/s"), colour, places);
}
