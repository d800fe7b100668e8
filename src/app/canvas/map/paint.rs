//! Puts the map and its legend on the screen.

use eframe::egui::{
    Align2, Color32, ColorImage, FontId, Mesh, Painter, Pos2, Rect, Stroke, StrokeKind, TextureHandle, TextureOptions,
    Ui, Vec2, Visuals,
};

use super::picture::{CLASSES, Cell, NO_EQUILIBRIUM, NOT_COMPUTED, Picture};
use crate::app::canvas::View;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::round::round_step;
use crate::app::state::MapQuantity;
use crate::app::theme;
use crate::robot::{BoundingBox, Vec2 as WorldVec2};
use crate::study::evenly;

/// Dots of the image from one of the map's points to the next.
const DOTS: usize = 6;
/// Points of the screen from one line of a hatching to the next.
const HATCHING: f32 = 8.0;
/// Room for one entry of the legend, in points.
const ENTRY: f32 = 16.0;

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
fn colour(picture: &Picture, cell: Cell, visuals: &Visuals) -> Color32 {
    let colour = match cell {
        Cell::Value(value) if picture.quantity == MapQuantity::Growth => theme::diverging(picture.part(value), visuals),
        Cell::Value(value) => theme::sequential(picture.part(value), visuals),
        Cell::Class(class) => theme::class(class),
        Cell::NoneUpTo => theme::calm(visuals).gamma_multiply(0.35),
        Cell::Unknown | Cell::Infeasible | Cell::Failed => return Color32::TRANSPARENT,
    };
    colour.gamma_multiply(0.85)
}

/// Draws what is told by patterns and letters: no equilibrium, nothing critical, classes.
pub fn patterns(painter: &Painter, visuals: &Visuals, view: &View, picture: &Picture) {
    let origin = view.pos_in_ui([0.0, 0.0]);
    for area in picture.areas(Cell::Infeasible) {
        hatching(painter, visuals, origin, view.rect_in_ui(area));
    }
    for area in picture.areas(Cell::NoneUpTo) {
        level_lines(painter, visuals, origin, view.rect_in_ui(area));
    }
    for line in picture.zero_line() {
        painter.line_segment(line.map(|end| view.pos_in_ui(end)), limit(visuals));
    }
    let text = |at: [f64; 2], text: &str| {
        let at = view.pos_in_ui(at);
        if view.rect.contains(at) {
            painter.circle_filled(at, 7.5, visuals.extreme_bg_color.gamma_multiply(0.75));
            let font = FontId::proportional(11.0);
            painter.text(at, Align2::CENTER_CENTER, text, font, visuals.strong_text_color());
        }
    };
    for (at, cell) in picture.labels() {
        match cell {
            Cell::Class(class) => text(at, &letter(picture.quantity, class)),
            _ => text(at, "▲"),
        }
    }
    // Dots, so that not even a large area looks like one without equilibrium, and a letter in each.
    for area in picture.areas(Cell::Failed) {
        dots(painter, visuals, origin, view.rect_in_ui(area));
        text(area.middle().into(), "?");
    }
}

/// The line between what grows and what dies out.
fn limit(visuals: &Visuals) -> Stroke {
    Stroke::new(2.0, visuals.strong_text_color())
}

/// How a class is labelled.
fn letter(quantity: MapQuantity, class: usize) -> String {
    match (quantity, class) {
        (MapQuantity::Kind, 0) => "F".into(),
        (MapQuantity::Kind, _) => "D".into(),
        (_, cable) => (cable + 1).to_string(),
    }
}

fn faint(visuals: &Visuals) -> Stroke {
    Stroke::new(1.0, visuals.weak_text_color().gamma_multiply(0.6))
}

/// Lines that rise to the right. Those of neighbouring areas join, since all are counted from `origin`.
fn hatching(painter: &Painter, visuals: &Visuals, origin: Pos2, area: Rect) {
    let area = area.intersect(painter.clip_rect());
    if !area.is_positive() {
        return;
    }
    let stroke = faint(visuals);
    let offset = origin.x + origin.y;
    let first = ((area.min.x + area.min.y - offset) / HATCHING).ceil();
    let mut sum = offset + first * HATCHING;
    while sum < area.max.x + area.max.y {
        let (left, right) = (area.min.x.max(sum - area.max.y), area.max.x.min(sum - area.min.y));
        painter.line_segment([Pos2::new(left, sum - left), Pos2::new(right, sum - right)], stroke);
        sum += HATCHING;
    }
}

/// Dots in a square grid that is counted from `origin`.
fn dots(painter: &Painter, visuals: &Visuals, origin: Pos2, area: Rect) {
    let area = area.intersect(painter.clip_rect());
    if !area.is_positive() {
        return;
    }
    let colour = faint(visuals).color;
    let first = |low: f32, origin: f32| origin + ((low - origin) / HATCHING).ceil() * HATCHING;
    let mut y = first(area.min.y, origin.y);
    while y < area.max.y {
        let mut x = first(area.min.x, origin.x);
        while x < area.max.x {
            painter.circle_filled(Pos2::new(x, y), 1.3, colour);
            x += HATCHING;
        }
        y += HATCHING;
    }
}

fn level_lines(painter: &Painter, visuals: &Visuals, origin: Pos2, area: Rect) {
    let area = area.intersect(painter.clip_rect());
    if !area.is_positive() {
        return;
    }
    let mut y = origin.y + ((area.min.y - origin.y) / HATCHING).ceil() * HATCHING;
    while y < area.max.y {
        painter.hline(area.x_range(), y, faint(visuals));
        y += HATCHING;
    }
}

/// Draws what colours and patterns mean.
pub fn legend(
    painter: &Painter,
    visuals: &Visuals,
    rect: Rect,
    picture: &Picture,
    current: bool,
    Facts { document, settings, .. }: Facts<'_>,
) {
    let (hertz, unit) = settings.hertz();
    let font = FontId::proportional(12.0);
    let text = if current { visuals.text_color() } else { visuals.weak_text_color() };
    let title = match picture.quantity {
        MapQuantity::Speed => "Critical speed (m/s)".into(),
        MapQuantity::Frequency => format!("Frequency at the critical speed ({unit})"),
        MapQuantity::Kind => "Instability of instability".into(),
        MapQuantity::Cable => "Responsible cable".into(),
        MapQuantity::Growth => format!("Growth rate at {:.2} m/s (1/s)", document.scenario.motion.speed),
    };
    let title = if current { title } else { format!("{title}, earlier state") };
    let corner = rect.left_bottom() + Vec2::new(12.0, -46.0);
    painter.text(corner, Align2::LEFT_TOP, title, font.clone(), text);
    let below = corner + Vec2::new(0.0, 17.0);
    let mut right = below.x;
    if let Some([low, high]) = picture.range {
        let bar = Rect::from_min_size(below, Vec2::new(140.0, 8.0));
        let unit = if picture.quantity == MapQuantity::Frequency { hertz } else { 1.0 };
        scale(painter, visuals, bar, picture, [low, high], unit);
        right = bar.max.x + 22.0;
    }
    // One row of entries; what does not fit goes on above the title.
    let mut at = Pos2::new(right, below.y - 3.0);
    let mut entry = |swatch: &dyn Fn(Rect), name: &str| {
        let width = ENTRY + 6.0 + painter.layout_no_wrap(name.into(), font.clone(), text).size().x;
        if at.x + width > rect.max.x - 8.0 {
            at = Pos2::new(corner.x, at.y - 2.0 * ENTRY);
        }
        let square = Rect::from_min_size(at, Vec2::splat(ENTRY - 2.0));
        swatch(square);
        painter.rect_stroke(square, 0.0, Stroke::new(1.0, text), StrokeKind::Inside);
        painter.text(at + Vec2::new(ENTRY + 3.0, 7.0), Align2::LEFT_CENTER, name, font.clone(), text);
        at.x += width + 10.0;
    };
    for class in 0..CLASSES {
        if picture.has(Cell::Class(class)) {
            let letter = letter(picture.quantity, class);
            let name = match (picture.quantity, class) {
                (MapQuantity::Kind, 0) => "Flutter",
                (MapQuantity::Kind, _) => "Divergence",
                _ => "",
            };
            let swatch = |square: Rect| {
                painter.rect_filled(square, 0.0, colour(picture, Cell::Class(class), visuals));
                painter.circle_filled(square.center(), 6.0, visuals.extreme_bg_color.gamma_multiply(0.75));
                let small = FontId::proportional(11.0);
                let strong = visuals.strong_text_color();
                painter.text(square.center(), Align2::CENTER_CENTER, &letter, small, strong);
            };
            entry(&swatch, name);
        }
    }
    if let Some([low, high]) = picture.range.filter(|_| picture.quantity == MapQuantity::Growth) {
        entry(&|square| _ = painter.rect_filled(square, 0.0, colour(picture, Cell::Value(low), visuals)), "dies out");
        let swatch = |square: Rect| {
            painter.line_segment([square.left_center(), square.right_center()], limit(visuals));
        };
        entry(&swatch, "limit, 0");
        let swatch = |square: Rect| {
            painter.rect_filled(square, 0.0, colour(picture, Cell::Value(high), visuals));
            painter.circle_filled(square.center(), 6.0, visuals.extreme_bg_color.gamma_multiply(0.75));
            let strong = visuals.strong_text_color();
            painter.text(square.center(), Align2::CENTER_CENTER, "▲", FontId::proportional(11.0), strong);
        };
        entry(&swatch, "grows");
    }
    if picture.has(Cell::Infeasible) {
        entry(&|square| hatching(painter, visuals, square.min, square), NO_EQUILIBRIUM);
    }
    if picture.has(Cell::Failed) {
        let swatch = |square: Rect| {
            let strong = visuals.strong_text_color();
            dots(painter, visuals, square.min + Vec2::splat(3.0), square);
            painter.text(square.center(), Align2::CENTER_CENTER, "?", FontId::proportional(11.0), strong);
        };
        entry(&swatch, NOT_COMPUTED);
    }
    if let Some(speed) = picture.none_up_to.filter(|_| picture.has(Cell::NoneUpTo)) {
        let swatch = |square: Rect| {
            painter.rect_filled(square, 0.0, colour(picture, Cell::NoneUpTo, visuals));
            level_lines(painter, visuals, square.min, square);
        };
        entry(&swatch, &format!("none up to {speed:.0} m/s"));
    }
}

/// The colour bar with its ticks. Its numbers are the picture's values times `unit`.
fn scale(painter: &Painter, visuals: &Visuals, bar: Rect, picture: &Picture, [low, high]: [f64; 2], unit: f64) {
    let text = visuals.text_color();
    let mut strip = Mesh::default();
    let steps = 48_u8;
    for i in 0..=steps {
        let part = f32::from(i) / f32::from(steps);
        let value = low + (high - low) * f64::from(part);
        let x = bar.min.x + bar.width() * part;
        let colour = colour(picture, Cell::Value(value), visuals);
        strip.colored_vertex(Pos2::new(x, bar.min.y), colour);
        strip.colored_vertex(Pos2::new(x, bar.max.y), colour);
        if i > 0 {
            let last = 2 * u32::from(i);
            strip.add_triangle(last - 2, last - 1, last);
            strip.add_triangle(last - 1, last, last + 1);
        }
    }
    painter.add(strip);
    if picture.beyond {
        let end = colour(picture, Cell::Value(high), visuals);
        painter.text(bar.right_center(), Align2::LEFT_CENTER, "▶", FontId::proportional(12.0), end);
    }
    let font = FontId::proportional(11.0);
    for (value, label) in ticks(low * unit, high * unit) {
        #[expect(clippy::cast_possible_truncation)] // A part of one.
        let x = bar.min.x + bar.width() * picture.part(value / unit) as f32;
        painter.vline(x, bar.max.y..=bar.max.y + 3.0, Stroke::new(1.0, text));
        painter.text(Pos2::new(x, bar.max.y + 3.0), Align2::CENTER_TOP, label, font.clone(), text);
    }
}

/// Round values from `low` to `high`, about four, with their labels; the one value where all are equal.
fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    if high - low <= 1e-9 * high.abs() {
        return vec![(low, digits::certain(low, None))];
    }
    let step = round_step((high - low) / 4.0);
    // At most five, and small.
    #[expect(clippy::cast_possible_truncation)]
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let digits = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
    (first..=last)
        .take(6)
        .map(|i| {
            // No minus before zero.
            let value = i as f64 * step + 0.0;
            (value, format!("{value:.digits$}"))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        let labels = |low, high| ticks(low, high).into_iter().map(|(_, label)| label).collect::<Vec<_>>();
        assert_eq!(labels(0.3, 11.3), ["5", "10"]);
        assert_eq!(labels(-0.013, 0.02), ["-0.01", "0.00", "0.01", "0.02"]);
        assert_eq!(labels(2.5, 2.5), ["2.50"]);
    }
}
