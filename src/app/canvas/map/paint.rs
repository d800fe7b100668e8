//! Puts the map on the screen: its colours and what is told by patterns, letters and marks.

use std::collections::BTreeMap;

use eframe::egui::{
    Align2, Color32, ColorImage, FontId, Mesh, Painter, Pos2, Rect, Shape, Stroke, TextureHandle, TextureOptions, Ui,
    Vec2, Visuals,
};

use super::contours::Polyline;
use super::picture::{Cell, Picture};
use super::region::Region;
use crate::app::canvas::View;
use crate::app::state::MapQuantity;
use crate::app::theme;
use crate::robot::{BoundingBox, Vec2 as WorldVec2};
use crate::study::evenly;

/// Dots of the image from one of the map's points to the next.
const DOTS: usize = 6;
/// Points of the screen from one line of a hatching to the next.
const HATCHING: f32 = 8.0;
/// Parts of a line of a hatching that are nearer to each other than this, in points, are one.
const TOUCHING: f32 = 0.5;
/// The size of the marks of the lowest and the highest place, in points.
const MARK: f32 = 7.0;

/// The colours of the map as an image on the graphics card.
#[derive(Default)]
pub struct Texture(Option<TextureHandle>);

impl Texture {
    /// Makes the image of `picture`.
    pub fn make(&mut self, ui: &Ui, picture: &Picture) {
        let visuals = ui.visuals();
        let [width, height] = [picture.grid.nx, picture.grid.ny].map(|points| DOTS * points.saturating_sub(1).max(1));
        let (low, high) = (picture.grid.low, picture.grid.high);
        let mut dots = Vec::with_capacity(width * height);
        // From the lowest row up, as the map's points are; the view knows which way up that is on the screen.
        for row in 0..height {
            for column in 0..width {
                let middle = |low, high, at, count| evenly(low, high, 2 * at + 1, 2 * count + 1);
                let at = WorldVec2::new(middle(low.x, high.x, column, width), middle(low.y, high.y, row, height));
                dots.push(colour(picture, picture.at(at), visuals));
            }
        }
        let image = ColorImage::new([width, height], dots);
        match &mut self.0 {
            Some(texture) => texture.set(image, TextureOptions::LINEAR),
            None => self.0 = Some(ui.ctx().load_texture("map", image, TextureOptions::LINEAR)),
        }
    }

    /// Draws it; an old one is faint.
    pub fn paint(&self, painter: &Painter, view: &View, picture: &Picture, current: bool) {
        let Some(texture) = &self.0 else { return };
        let area = BoundingBox { low: picture.grid.low, high: picture.grid.high };
        let tint = if current { Color32::WHITE } else { Color32::WHITE.gamma_multiply(0.45) };
        painter.image(texture.id(), view.rect_in_ui(area), View::IMAGE, tint);
    }
}

/// The colour of a point.
pub fn colour(picture: &Picture, cell: Cell, visuals: &Visuals) -> Color32 {
    let colour = match cell {
        Cell::Value(value) if picture.quantity == MapQuantity::Growth => theme::diverging(picture.part(value), visuals),
        Cell::Value(value) => theme::on_map(picture.part(value)),
        Cell::Class(class) => theme::class(class),
        Cell::NoneUpTo => theme::calm(visuals).gamma_multiply(0.35),
        Cell::Unknown | Cell::Infeasible | Cell::Failed => return Color32::TRANSPARENT,
    };
    colour.gamma_multiply(0.85)
}

/// Draws what is told by patterns and letters: no equilibrium, nothing critical, classes. Where the feasible `region` is
/// known, its border is the picture's end.
pub fn patterns(painter: &Painter, visuals: &Visuals, view: &View, picture: &Picture, region: Option<&Region>) {
    let origin = view.pos_in_ui([0.0, 0.0]);
    if let Some(region) = region {
        let pieces = on_screen(region, view);
        mask(painter, visuals, &pieces);
        hatching(painter, visuals, origin, &pieces);
        border(painter, view, region, Stroke::new(1.5, theme::tokens(visuals).weak));
    } else {
        let areas = picture.areas(Cell::Infeasible).into_iter().map(|area| corners(view.rect_in_ui(area)));
        hatching(painter, visuals, origin, &areas.collect::<Vec<_>>());
    }
    for area in picture.areas(Cell::NoneUpTo) {
        level_lines(painter, visuals, origin, view.rect_in_ui(area));
    }
    for (at, cell) in picture.labels() {
        match cell {
            Cell::Class(class) => letter(painter, visuals, view, at, &name_of(picture.quantity, class)),
            _ => letter(painter, visuals, view, at, "▲"),
        }
    }
    // Dots, so that not even a large area looks like one without equilibrium, and a letter in each.
    for area in picture.areas(Cell::Failed) {
        dots(painter, visuals, origin, view.rect_in_ui(area));
        letter(painter, visuals, view, area.middle().into(), "?");
    }
}

/// Marks the lowest and the highest place.
pub fn extremes(painter: &Painter, visuals: &Visuals, view: &View, picture: &Picture) {
    let Some(places) = picture.extremes else { return };
    let tokens = theme::tokens(visuals);
    for ((index, _), up) in places.into_iter().zip([-1.0, 1.0]) {
        let at = view.pos_in_ui(picture.grid.position(index).into());
        let corner = |x: f32, y: f32| at + MARK * Vec2::new(x, -up * y);
        let triangle = vec![corner(0.0, 1.0), corner(1.0, -0.7), corner(-1.0, -0.7)];
        painter.add(Shape::convex_polygon(triangle, tokens.text, Stroke::new(2.0, tokens.canvas)));
    }
}

/// Draws the border of the feasible region.
pub fn border(painter: &Painter, view: &View, region: &Region, stroke: Stroke) {
    for line in &region.border {
        polyline(painter, view, line, stroke);
    }
}

/// Hatches what lies outside of the feasible region.
pub fn outside(painter: &Painter, visuals: &Visuals, view: &View, region: &Region) {
    hatching(painter, visuals, view.pos_in_ui([0.0, 0.0]), &on_screen(region, view));
}

/// Draws a line through the world.
pub fn polyline(painter: &Painter, view: &View, line: &Polyline, stroke: Stroke) {
    let points = line.points.iter().map(|&point| view.pos_in_ui(point)).collect();
    painter.add(if line.closed { Shape::closed_line(points, stroke) } else { Shape::line(points, stroke) });
}

/// How a class is labelled.
pub fn name_of(quantity: MapQuantity, class: usize) -> String {
    match (quantity, class) {
        (MapQuantity::Kind, 0) => "F".into(),
        (MapQuantity::Kind, _) => "D".into(),
        (_, cable) => (cable + 1).to_string(),
    }
}

fn letter(painter: &Painter, visuals: &Visuals, view: &View, at: [f64; 2], text: &str) {
    let at = view.pos_in_ui(at);
    if view.rect.contains(at) {
        sign(painter, visuals, at, text);
    }
}

/// A letter on a disc.
pub fn sign(painter: &Painter, visuals: &Visuals, at: Pos2, text: &str) {
    let tokens = theme::tokens(visuals);
    painter.circle_filled(at, 7.0, tokens.canvas.gamma_multiply(0.8));
    painter.text(at, Align2::CENTER_CENTER, text, FontId::proportional(11.0), tokens.text);
}

/// The colour of patterns.
fn pattern(visuals: &Visuals) -> Color32 {
    theme::tokens(visuals).mute.gamma_multiply(0.55)
}

/// What lies outside of a region, in pieces on the screen.
fn on_screen(region: &Region, view: &View) -> Vec<Vec<Pos2>> {
    region.outside.iter().map(|piece| piece.iter().map(|&corner| view.pos_in_ui(corner)).collect()).collect()
}

/// The corners of a rectangle, round it.
pub fn corners(area: Rect) -> Vec<Pos2> {
    vec![area.left_top(), area.right_top(), area.right_bottom(), area.left_bottom()]
}

/// Covers convex pieces with the colour of the canvas. They have no soft edges, so that no seam is seen between them.
fn mask(painter: &Painter, visuals: &Visuals, pieces: &[Vec<Pos2>]) {
    let colour = theme::tokens(visuals).canvas;
    let mut mesh = Mesh::default();
    for piece in pieces {
        let mut first = 0;
        for (i, &corner) in (0_u32..).zip(piece) {
            // The number of the corner just added; a mesh counts in u32 too.
            let index = u32::try_from(mesh.vertices.len()).unwrap_or_default();
            mesh.colored_vertex(corner, colour);
            match i {
                0 => first = index,
                1 => {}
                _ => mesh.add_triangle(first, index - 1, index),
            }
        }
    }
    painter.add(mesh);
}

/// Lines that rise to the right, in convex pieces. Those of neighbouring pieces join, since all are counted from `origin`.
pub fn hatching(painter: &Painter, visuals: &Visuals, origin: Pos2, pieces: &[Vec<Pos2>]) {
    let stroke = Stroke::new(1.0, pattern(visuals));
    for (sum, [left, right]) in hatches(painter.clip_rect(), origin, pieces) {
        painter.line_segment([Pos2::new(left, sum - left), Pos2::new(right, sum - right)], stroke);
    }
}

/// The lines of a hatching within `clip`: on each x + y is the first number, and x goes from the second to the third.
fn hatches(clip: Rect, origin: Pos2, pieces: &[Vec<Pos2>]) -> Vec<(f32, [f32; 2])> {
    let offset = origin.x + origin.y;
    // The number of a line, counted from the origin. Within the clip there are a few hundred of them.
    #[expect(clippy::cast_possible_truncation)]
    let number = |sum: f32| ((sum - offset) / HATCHING).ceil() as i32;
    let mut parts: BTreeMap<i32, Vec<[f32; 2]>> = BTreeMap::new();
    for piece in pieces {
        let sums = || piece.iter().map(|corner| corner.x + corner.y);
        let low = sums().fold(f32::MAX, f32::min).max(clip.min.x + clip.min.y);
        let high = sums().fold(f32::MIN, f32::max).min(clip.max.x + clip.max.y);
        for line in number(low)..number(high) {
            let sum = offset + line as f32 * HATCHING;
            let (mut left, mut right) = (f32::MAX, f32::MIN);
            for (from, to) in piece.iter().zip(piece.iter().skip(1).chain(&piece[..1])) {
                let (before, after) = (from.x + from.y - sum, to.x + to.y - sum);
                if (before > 0.0) != (after > 0.0) {
                    let x = from.x + (to.x - from.x) * before / (before - after);
                    (left, right) = (left.min(x), right.max(x));
                }
            }
            (left, right) = (left.max(clip.min.x).max(sum - clip.max.y), right.min(clip.max.x).min(sum - clip.min.y));
            if left < right {
                parts.entry(line).or_default().push([left, right]);
            }
        }
    }
    let mut lines = Vec::new();
    for (line, mut parts) in parts {
        let sum = offset + line as f32 * HATCHING;
        parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut parts = parts.into_iter();
        let Some(mut last) = parts.next() else { continue };
        for part in parts {
            if part[0] <= last[1] + TOUCHING {
                last[1] = last[1].max(part[1]);
            } else {
                lines.push((sum, last));
                last = part;
            }
        }
        lines.push((sum, last));
    }
    lines
}

/// Dots in a square grid that is counted from `origin`.
pub fn dots(painter: &Painter, visuals: &Visuals, origin: Pos2, area: Rect) {
    let area = area.intersect(painter.clip_rect());
    if !area.is_positive() {
        return;
    }
    let first = |low: f32, origin: f32| origin + ((low - origin) / HATCHING).ceil() * HATCHING;
    let mut y = first(area.min.y, origin.y);
    while y < area.max.y {
        let mut x = first(area.min.x, origin.x);
        while x < area.max.x {
            painter.circle_filled(Pos2::new(x, y), 1.3, pattern(visuals));
            x += HATCHING;
        }
        y += HATCHING;
    }
}

/// Level lines, counted from `origin`.
pub fn level_lines(painter: &Painter, visuals: &Visuals, origin: Pos2, area: Rect) {
    let area = area.intersect(painter.clip_rect());
    if !area.is_positive() {
        return;
    }
    let mut y = origin.y + ((area.min.y - origin.y) / HATCHING).ceil() * HATCHING;
    while y < area.max.y {
        painter.hline(area.x_range(), y, Stroke::new(1.0, pattern(visuals)));
        y += HATCHING;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hatching_goes_through_neighbouring_pieces_in_one_line_and_stays_within_the_clip() {
        let square = |x: f32| corners(Rect::from_min_size(Pos2::new(x, 0.0), Vec2::splat(10.0)));
        let everything = Rect::from_min_size(Pos2::new(-100.0, -100.0), Vec2::splat(300.0));
        let origin = Pos2::new(0.0, 0.0);
        let lines = hatches(everything, origin, &[square(0.0), square(10.0)]);
        // x + y = 8, 16, 24 cross the rectangle of 20 by 10, and so does 0 in a corner at most.
        let near = |a: f32, b: f32| (a - b).abs() < 1e-4;
        let expected = [(8.0, [0.0, 8.0]), (16.0, [6.0, 16.0]), (24.0, [14.0, 20.0])];
        assert_eq!(lines.len(), expected.len(), "{lines:?}");
        for ((sum, [left, right]), (sum_there, [from, to])) in lines.into_iter().zip(expected) {
            assert!(near(sum, sum_there) && near(left, from) && near(right, to), "{sum} {left} {right}");
        }
        let apart = hatches(everything, origin, &[square(0.0), square(20.0)]);
        assert!(apart.iter().filter(|(sum, _)| near(*sum, 24.0)).count() == 1 && apart.len() == 4, "{apart:?}");
        let clip = Rect::from_min_size(Pos2::new(2.0, 2.0), Vec2::splat(5.0));
        let clipped = hatches(clip, origin, &[square(0.0)]);
        assert!(clipped.iter().all(|(sum, [left, right])| {
            clip.expand(1e-4).contains(Pos2::new(*left, sum - left))
                && clip.expand(1e-4).contains(Pos2::new(*right, sum - right))
        }));
        assert_eq!(clipped.len(), 1, "{clipped:?}");
    }
}
