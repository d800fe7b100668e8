//! Puts a scene on the screen.

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, Visuals};

use super::arrow::Arrow;
use super::layout::Layout;
use super::{Scene, View};
use crate::app::round::round_step;
use crate::app::theme;

/// The width of the colour bar of the tensions, in points.
const BAR: f32 = 130.0;
/// Longer lines than this, in points, are not dashed.
const LONGEST_DASHED: f32 = 1e4;

/// Draws what is under everything.
pub fn background(painter: &Painter, visuals: &Visuals, view: &View) {
    painter.rect_filled(view.rect, 0.0, visuals.extreme_bg_color);
}

/// Draws everything but the background and the handles. Over a map, whose colours mean something else, cables do not
/// show their tension.
pub fn scene(painter: &Painter, visuals: &Visuals, layout: &Layout, scene: &Scene, over_map: bool) {
    let view = &layout.view;
    grid(painter, visuals, view, scene);
    for (cable, &winch) in scene.cables.iter().zip(&layout.winches) {
        if cable.nodes.is_empty() {
            // No shape: the straight line, dashed, so that it reads as missing.
            let line = [layout.platform, winch];
            let stroke = Stroke::new(1.5, visuals.weak_text_color());
            // Far outside the canvas the dashes would be without number.
            if (line[1] - line[0]).length() < LONGEST_DASHED {
                painter.extend(Shape::dashed_line(&line, stroke, 6.0, 6.0));
            } else if line[0].is_finite() {
                painter.line_segment(line, stroke);
            }
        }
        if cable.marked {
            let colour = theme::warning(visuals).gamma_multiply(0.30);
            polyline(painter, view, &cable.nodes, Stroke::new(11.0, colour));
        }
        if over_map {
            polyline(painter, view, &cable.vibrating, Stroke::new(4.0, visuals.extreme_bg_color.gamma_multiply(0.6)));
        }
        polyline(painter, view, &cable.vibrating, Stroke::new(1.6, theme::accent(visuals)));
    }
    // Over the vibration, so that the tension stays to be seen where a mode moves little.
    for cable in &scene.cables {
        if over_map {
            polyline(painter, view, &cable.nodes, Stroke::new(6.0, visuals.extreme_bg_color.gamma_multiply(0.85)));
            polyline(painter, view, &cable.nodes, Stroke::new(2.5, visuals.strong_text_color()));
            continue;
        }
        for (ends, &force) in cable.nodes.windows(2).zip(&cable.forces) {
            let colour = theme::sequential(part(force, scene.tensions), visuals);
            let ends = [view.pos_in_ui(ends[0]), view.pos_in_ui(ends[1])];
            painter.line_segment(ends, Stroke::new(3.0, colour));
        }
    }
    for (i, &at) in layout.winches.iter().enumerate() {
        winch(painter, visuals, scene, i, at);
    }
    velocity(painter, visuals, layout);
    painter.circle(layout.platform, 11.0, theme::accent(visuals), Stroke::new(2.0, visuals.extreme_bg_color));
}

fn polyline(painter: &Painter, view: &View, nodes: &[[f64; 2]], stroke: Stroke) {
    if nodes.len() > 1 {
        painter.add(Shape::line(nodes.iter().map(|&node| view.pos_in_ui(node)).collect(), stroke));
    }
}

/// Where a force lies in the range of all.
fn part(force: f64, tensions: Option<[f64; 2]>) -> f64 {
    match tensions {
        Some([low, high]) if high - low > 1e-9 * high => (force - low) / (high - low),
        _ => 0.5,
    }
}

/// The workspace's frame, its grid lines and their metres.
fn grid(painter: &Painter, visuals: &Visuals, view: &View, scene: &Scene) {
    let frame = view.rect_in_ui(scene.frame);
    let faint = Stroke::new(0.5, visuals.weak_text_color().gamma_multiply(0.35));
    let step = round_step(80.0 / view.scale);
    let text = visuals.weak_text_color();
    let font = FontId::proportional(11.0);
    for (i, vertical) in [(0, true), (1, false)] {
        let (low, high) = (scene.frame.low[i], scene.frame.high[i]);
        #[expect(clippy::cast_possible_truncation)] // A few dozen lines: the step follows the range and the zoom.
        let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
        for line in (first..=last).take(200) {
            let at = line as f64 * step;
            let label = trimmed(at);
            if vertical {
                let x = view.pos_in_ui([at, 0.0]).x;
                painter.vline(x, frame.y_range(), faint);
                painter.text(Pos2::new(x, frame.max.y + 20.0), Align2::CENTER_TOP, label, font.clone(), text);
            } else {
                let y = view.pos_in_ui([0.0, at]).y;
                painter.hline(frame.x_range(), y, faint);
                painter.text(Pos2::new(frame.min.x - 18.0, y), Align2::RIGHT_CENTER, label, font.clone(), text);
            }
        }
    }
    painter.text(frame.max + Vec2::new(22.0, 20.0), Align2::LEFT_TOP, "m", font, text);
    let stroke = Stroke::new(1.0, visuals.weak_text_color().gamma_multiply(0.7));
    painter.rect_stroke(frame, 0.0, stroke, StrokeKind::Middle);
}

/// A coordinate without useless zeros.
fn trimmed(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// A winch with its cable's number: a filled square where the tension is prescribed, an open one at equilibrium.
fn winch(painter: &Painter, visuals: &Visuals, scene: &Scene, i: usize, at: Pos2) {
    let square = Rect::from_center_size(at, Vec2::splat(12.0));
    let colour = visuals.text_color();
    let fill = if scene.cables[i].prescribed { colour } else { visuals.extreme_bg_color };
    painter.rect(square, 2.0, fill, Stroke::new(2.0, colour), StrokeKind::Middle);
    let [x, y] = scene.cables[i].anchor;
    let middle = scene.frame.middle();
    let side = |value: f64, middle: f64| if value < middle { -1.0 } else { 1.0 };
    let away = Vec2::new(side(x, middle.x), -side(y, middle.y));
    let number = at + away * Vec2::new(16.0, 14.0);
    painter.text(number, Align2::CENTER_CENTER, (i + 1).to_string(), FontId::proportional(14.0), colour);
}

fn velocity(painter: &Painter, visuals: &Visuals, layout: &Layout) {
    let Layout { platform, ahead: direction, tip, .. } = *layout;
    let start = platform + direction * 14.0;
    let colour = theme::accent(visuals);
    let across = direction.rot90();
    let rim = Stroke::new(1.5, visuals.extreme_bg_color);
    painter.line_segment([start, tip - direction * 8.0], Stroke::new(6.0, rim.color));
    painter.line_segment([start, tip - direction * 8.0], Stroke::new(3.0, colour));
    let head = vec![tip, tip - direction * 12.0 + across * 6.0, tip - direction * 12.0 - across * 6.0];
    painter.add(Shape::convex_polygon(head, colour, rim));
}

/// What the arrow's length means: in the canvas's upper left corner, or beside the legend that is there.
pub fn arrow_legend(painter: &Painter, visuals: &Visuals, rect: Rect, arrow: Arrow, legend: bool) {
    let at = rect.min + Vec2::new(if legend { 12.0 + BAR + 14.0 } else { 12.0 }, 32.0);
    painter.text(at, Align2::LEFT_TOP, arrow.legend(), FontId::proportional(12.0), visuals.text_color());
}

/// A dashed arrow in the direction with the lowest critical speed, with that speed in m/s.
pub fn worst(painter: &Painter, visuals: &Visuals, layout: &Layout, direction: [f64; 2], speed: &str) {
    let colour = theme::warning(visuals);
    let platform = layout.platform;
    let ahead = View::direction_in_ui(direction);
    let across = ahead.rot90();
    let tip = platform + ahead * 74.0;
    painter.extend(Shape::dashed_line(
        &[platform + ahead * 14.0, tip - ahead * 8.0],
        Stroke::new(2.5, colour),
        5.0,
        4.0,
    ));
    let head = vec![tip, tip - ahead * 12.0 + across * 6.0, tip - ahead * 12.0 - across * 6.0];
    painter.add(Shape::convex_polygon(head, visuals.extreme_bg_color, Stroke::new(2.0, colour)));
    let text = format!("worst: {speed} m/s");
    let galley = painter.layout_no_wrap(text, FontId::proportional(12.0), colour);
    let middle = tip + ahead * (8.0 + 0.5 * (galley.size() * ahead.abs()).length());
    let room = Rect::from_center_size(middle, galley.size());
    painter.rect_filled(room.expand(2.0), 2.0, visuals.extreme_bg_color.gamma_multiply(0.8));
    painter.galley(room.min, galley, colour);
}

/// The colour bar of the tensions, in the canvas's upper left corner.
pub fn legend(painter: &Painter, visuals: &Visuals, rect: Rect, scene: &Scene) {
    let Some([low, high]) = scene.tensions else { return };
    let bar = Rect::from_min_size(rect.min + Vec2::new(12.0, 26.0), Vec2::new(BAR, 8.0));
    let font = FontId::proportional(12.0);
    let text = visuals.text_color();
    painter.text(bar.min - Vec2::new(0.0, 3.0), Align2::LEFT_BOTTOM, "Cable tension", font.clone(), text);
    let steps = 32_u8;
    let step = bar.width() / f32::from(steps);
    for i in 0..steps {
        let colour: Color32 = theme::sequential(f64::from(i) / f64::from(steps - 1), visuals);
        let min = bar.min + Vec2::new(f32::from(i) * step, 0.0);
        painter.rect_filled(Rect::from_min_size(min, Vec2::new(step + 0.5, bar.height())), 0.0, colour);
    }
    painter.text(bar.left_bottom() + Vec2::new(0.0, 2.0), Align2::LEFT_TOP, newtons(low), font.clone(), text);
    painter.text(bar.right_bottom() + Vec2::new(0.0, 2.0), Align2::RIGHT_TOP, newtons(high), font, text);
}

fn newtons(force: f64) -> String {
    if force < 1e4 { format!("{force:.1} N") } else { format!("{:.1} kN", 1e-3 * force) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_have_no_useless_zeros() {
        assert_eq!([trimmed(2.5), trimmed(-0.0), trimmed(10.0)], ["2.5", "0", "10"]);
    }
}
