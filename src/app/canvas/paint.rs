//! Puts a scene on the screen: the workspace with its metres, cables, winches and the platform.

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, Visuals};

use super::labels::{Pen, along};
use super::layout::Layout;
use super::model::CableLine;
use super::{Scene, View};
use crate::app::round::round_step;
use crate::app::theme::{self, Tokens};
use crate::robot::TensionLaw;
use crate::stability::Instability;

/// Longer lines than this, in points, are not dashed: far outside the canvas the dashes would be without number.
const LONGEST_DASHED: f32 = 1e4;
/// The width of a cable, in points.
const CABLE: f32 = 3.0;
/// The width and the strength of what marks the responsible cable.
const HALO: (f32, f32) = (9.0, 0.26);

/// How the scene is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Over a map, whose colours mean something else, cables do not show their tension.
    pub over_map: bool,
    /// The force at the end of the colours of tension, in N.
    pub strongest: f64,
    /// Without what can be read elsewhere.
    pub compact: bool,
}

/// Draws what is under everything.
pub fn background(painter: &Painter, visuals: &Visuals, view: &View) {
    painter.rect_filled(view.rect, 0.0, theme::tokens(visuals).canvas);
}

/// Draws the cables and the winches.
pub fn scene(pen: &mut Pen<'_>, visuals: &Visuals, layout: &Layout, scene: &Scene, look: Look) {
    let (view, painter, tokens) = (&layout.view, pen.painter, pen.tokens);
    for (cable, &winch) in scene.cables.iter().zip(&layout.winches) {
        if cable.nodes.is_empty() && !cable.marked {
            // No shape: the straight line, dashed, so that it reads as missing.
            dashed(painter, [layout.platform, winch], Stroke::new(1.5, tokens.mute), [6.0, 6.0]);
        }
        if cable.marked && !look.over_map {
            polyline(painter, view, &cable.nodes, Stroke::new(HALO.0, tokens.critical.gamma_multiply(HALO.1)));
        }
        if look.over_map {
            polyline(painter, view, &cable.vibrating, Stroke::new(4.0, tokens.canvas.gamma_multiply(0.6)));
        }
        polyline(painter, view, &cable.vibrating, Stroke::new(1.25, tokens.accent));
    }
    // Over the vibration, so that the tension stays to be seen where a mode moves little.
    for cable in &scene.cables {
        draw_cable(painter, visuals, view, cable, scene.unstable, look);
    }
    for (i, &at) in layout.winches.iter().enumerate() {
        winch(pen, scene, i, at);
    }
}

fn draw_cable(painter: &Painter, visuals: &Visuals, view: &View, cable: &CableLine, unstable: bool, look: Look) {
    let tokens = theme::tokens(visuals);
    if look.over_map {
        polyline(painter, view, &cable.nodes, Stroke::new(5.5, tokens.canvas.gamma_multiply(0.85)));
    }
    if unstable && cable.marked {
        let points: Vec<Pos2> = cable.nodes.iter().map(|&node| view.pos_in_ui(node)).collect();
        if points.windows(2).map(|ends| (ends[1] - ends[0]).length()).sum::<f32>() < LONGEST_DASHED {
            painter.extend(Shape::dashed_line(&points, Stroke::new(CABLE, tokens.critical), 9.0, 5.0));
        } else {
            painter.add(Shape::line(points, Stroke::new(CABLE, tokens.critical)));
        }
    } else if look.over_map {
        let colour = if cable.marked { tokens.critical } else { tokens.text };
        polyline(painter, view, &cable.nodes, Stroke::new(2.5, colour));
    } else {
        for (ends, &force) in cable.nodes.windows(2).zip(&cable.forces) {
            let colour = tension_colour(force, look.strongest, visuals);
            let ends = [view.pos_in_ui(ends[0]), view.pos_in_ui(ends[1])];
            painter.line_segment(ends, Stroke::new(CABLE, colour));
        }
    }
}

/// The colour of a force where the colours go from 0 to `strongest`, both in N.
pub fn tension_colour(force: f64, strongest: f64, visuals: &Visuals) -> Color32 {
    theme::cable(if strongest > 0.0 { force / strongest } else { 0.0 }, visuals)
}

/// A cable that the pointer is on.
pub fn hovered(painter: &Painter, view: &View, cable: &CableLine, tokens: &Tokens) {
    polyline(painter, view, &cable.nodes, Stroke::new(HALO.0, tokens.accent.gamma_multiply(HALO.1)));
}

/// What becomes of the responsible cable, in words beside it.
pub fn responsible(pen: &mut Pen<'_>, layout: &Layout, scene: &Scene, look: Look) {
    let Some(first) = scene.critical.filter(|_| scene.unstable || !look.compact) else { return };
    let Some(cable) = scene.cables.get(first.cable) else { return };
    let does = match first.kind {
        Instability::Flutter => "flutters",
        Instability::Divergence => "bows out",
    };
    let when = if scene.unstable { "" } else { " first" };
    let points: Vec<Pos2> = cable.nodes.iter().map(|&node| layout.view.pos_in_ui(node)).collect();
    let places = |size| along(&points, &[0.55, 0.45, 0.65, 0.35, 0.75], 8.0, size);
    pen.write(format!("cable {} {does}{when}", first.cable + 1), pen.tokens.critical, places);
}

fn polyline(painter: &Painter, view: &View, nodes: &[[f64; 2]], stroke: Stroke) {
    if nodes.len() > 1 {
        painter.add(Shape::line(nodes.iter().map(|&node| view.pos_in_ui(node)).collect(), stroke));
    }
}

/// A dashed line of dashes and gaps of these lengths.
pub fn dashed(painter: &Painter, line: [Pos2; 2], stroke: Stroke, [dash, gap]: [f32; 2]) {
    if (line[1] - line[0]).length() < LONGEST_DASHED {
        painter.extend(Shape::dashed_line(&line, stroke, dash, gap));
    } else if line[0].is_finite() && line[1].is_finite() {
        painter.line_segment(line, stroke);
    }
}

/// The workspace's frame, its grid lines and their metres.
pub fn grid(pen: &Pen<'_>, view: &View, scene: &Scene) {
    let (painter, tokens) = (pen.painter, pen.tokens);
    let frame = view.rect_in_ui(scene.frame);
    let faint = Stroke::new(1.0, tokens.line);
    // Numbers stay on the canvas when the frame leaves it.
    let below = (frame.max.y + 7.0).min(view.rect.max.y - 18.0);
    let left = (frame.min.x - 8.0).max(view.rect.min.x + 34.0);
    for (i, vertical, apart) in [(0, true, 100.0), (1, false, 50.0)] {
        let step = round_step(apart / view.scale);
        let (low, high) = (scene.frame.low[i], scene.frame.high[i]);
        #[expect(clippy::cast_possible_truncation)] // A few dozen lines: the step follows the range and the zoom.
        let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
        for line in (first..=last).take(200) {
            let at = line as f64 * step;
            let label = trimmed(at);
            if vertical {
                let x = view.pos_in_ui([at, 0.0]).x;
                painter.vline(x, frame.y_range(), faint);
                let label = if line == last { format!("{label} m") } else { label };
                painter.text(Pos2::new(x, below), Align2::CENTER_TOP, label, pen.font.clone(), tokens.numbers);
            } else {
                let y = view.pos_in_ui([0.0, at]).y;
                painter.hline(frame.x_range(), y, faint);
                // The winches' numbers are in the corners.
                if y - frame.min.y > 10.0 && frame.max.y - y > 10.0 {
                    painter.text(Pos2::new(left, y), Align2::RIGHT_CENTER, label, pen.font.clone(), tokens.numbers);
                }
            }
        }
    }
    painter.rect_stroke(frame, 0.0, Stroke::new(1.0, tokens.frame), StrokeKind::Middle);
}

/// A coordinate without useless zeros.
pub fn trimmed(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "−") }
}

/// A winch with its cable's number: a filled square where the tension is prescribed, an open one at equilibrium.
fn winch(pen: &mut Pen<'_>, scene: &Scene, i: usize, at: Pos2) {
    let (painter, tokens) = (pen.painter, pen.tokens);
    let cable = &scene.cables[i];
    let square = Rect::from_center_size(at, Vec2::splat(12.0));
    let fill = if cable.law == TensionLaw::Equilibrium { tokens.canvas } else { tokens.text };
    painter.rect(square, 2.0, fill, Stroke::new(2.0, tokens.text), StrokeKind::Middle);
    let outward = if cable.anchor[0] < scene.frame.middle().x { -1.0 } else { 1.0 };
    let number = at + Vec2::new(15.0 * outward, -13.0);
    let colour = if cable.marked { tokens.critical } else { tokens.text };
    let font = FontId::new(pen.font.size + 1.0, pen.font.family.clone());
    painter.text(number, Align2::CENTER_CENTER, (i + 1).to_string(), font, colour);
    pen.places.keep_free(square);
    pen.places.keep_free(Rect::from_center_size(number, Vec2::splat(14.0)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_have_no_useless_zeros() {
        assert_eq!([trimmed(2.5), trimmed(-0.0), trimmed(10.0), trimmed(-4.0)], ["2.5", "0", "10", "−4"]);
    }
}
