//! What the map's colours and patterns mean.

use eframe::egui::{
    Align2, FontId, Mesh, Painter, Pos2, Rect, Role, Sense, Stroke, StrokeKind, Ui, Vec2, Visuals, WidgetInfo,
};

use super::lines::decimals;
use super::paint::{colour, corners, dots, hatching, level_lines, name_of, sign};
use super::picture::{CLASSES, Cell, NO_EQUILIBRIUM, NOT_COMPUTED, Picture};
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::state::MapQuantity;
use crate::app::theme;

/// The colour bar's size, in points.
const BAR: Vec2 = Vec2::new(200.0, 8.0);
/// Room for half a number, or a mark, at each end of the bar, in points.
const END: f32 = 12.0;
/// Room for one entry, in points.
const ENTRY: f32 = 14.0;
/// A scale has one tick more than this.
const INTERVALS: u8 = 4;

/// What a quantity's values are multiplied with to be shown, and the unit that they are shown in.
pub fn unit(quantity: MapQuantity, facts: Facts<'_>) -> (f64, &'static str) {
    match quantity {
        MapQuantity::Speed | MapQuantity::Waves => (1.0, "m/s"),
        MapQuantity::Frequency => facts.settings.hertz(),
        MapQuantity::Growth => (1.0, "1/s"),
        MapQuantity::Kind | MapQuantity::Cable => (1.0, ""),
    }
}

/// What the colours show.
pub fn caption(quantity: MapQuantity, facts: Facts<'_>) -> String {
    let (_, unit) = unit(quantity, facts);
    match quantity {
        MapQuantity::Speed => format!("Critical speed, {unit}"),
        MapQuantity::Frequency => format!("Frequency at the critical speed, {unit}"),
        MapQuantity::Kind => "Instability".into(),
        MapQuantity::Cable => "Responsible cable".into(),
        MapQuantity::Growth => format!("Growth rate at {:.2} m/s, {unit}", facts.document.scenario.motion.speed),
        MapQuantity::Waves => format!("Wave limit, {unit}"),
    }
}

/// The narrowest range around these values whose ends and quarters are round once multiplied by `unit`. Where `symmetric`,
/// its middle is zero.
pub fn round_range([low, high]: [f64; 2], unit: f64, symmetric: bool) -> [f64; 2] {
    const DIGITS: [f64; 6] = [1.0, 2.0, 2.5, 4.0, 5.0, 8.0];
    let intervals = f64::from(INTERVALS);
    let (low, high) = (low * unit, high * unit);
    // Where all values are equal, some room around them.
    let size = if high == 0.0 { 1.0 } else { 0.2 * high.abs() };
    let (low, high) = if high - low < 1e-9 * size { (low - 0.5 * size, high + 0.5 * size) } else { (low, high) };
    let decade = 10.0_f64.powf(((high - low) / intervals).log10().floor());
    let steps = [decade, 10.0 * decade].into_iter().flat_map(|decade| DIGITS.map(|digit| digit * decade));
    let covering = steps.filter_map(|step| {
        let first = if symmetric { -0.5 * intervals * step } else { (low / step + 1e-9).floor() * step };
        let last = first + intervals * step;
        (first <= low + 1e-9 * step && high <= last + 1e-9 * step).then_some([first / unit, last / unit])
    });
    covering.into_iter().next().unwrap_or([low / unit, high / unit])
}

/// Whether its values are numbers, which have a bar of colours.
fn has_bar(quantity: MapQuantity) -> bool {
    !matches!(quantity, MapQuantity::Kind | MapQuantity::Cable)
}

/// Shows the caption of `quantity` and the bar of a picture's colours. The bar has its room before there is a picture, so
/// that nothing below it moves when one comes.
pub fn ui(ui: &mut Ui, quantity: MapQuantity, picture: Option<&Picture>, current: bool, facts: Facts<'_>) {
    let tokens = theme::tokens(ui.visuals());
    let quantity = picture.map_or(quantity, |picture| picture.quantity);
    let title = caption(quantity, facts);
    let title = if current || picture.is_none() { title } else { format!("{title}, earlier state") };
    let text = eframe::egui::RichText::new(&title).size(theme::CAPTION);
    ui.label(text.color(if current { tokens.text } else { tokens.weak }));
    if !has_bar(quantity) {
        return;
    }
    let room = Vec2::new((BAR.x + 2.0 * END).min(ui.available_width()), BAR.y + 3.0 + theme::CAPTION + 2.0);
    let (rect, response) = ui.allocate_exact_size(room, Sense::hover());
    let Some((picture, range)) = picture.and_then(|picture| Some((picture, picture.range?))) else { return };
    let (unit, name) = unit(quantity, facts);
    let labels = ticks(range.map(|end| end * unit));
    let ends = [labels.first(), labels.last()].map(|label| label.map_or("", |(_, label)| label));
    let spoken = format!("Colours from {} to {} {name}", ends[0], ends[1]);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &spoken));
    let bar = Rect::from_min_size(rect.min + Vec2::new(END, 0.0), Vec2::new(rect.width() - 2.0 * END, BAR.y));
    scale(ui.painter(), ui.visuals(), bar, picture, &labels);
    if picture.beyond() != [false; 2] {
        response.explained("Some values lie beyond an end of the colours. They have the colour of that end.");
    }
}

/// The colour bar with its ticks.
fn scale(painter: &Painter, visuals: &Visuals, bar: Rect, picture: &Picture, labels: &[(f32, String)]) {
    let Some([low, high]) = picture.range else { return };
    let tokens = theme::tokens(visuals);
    let shade = |part: f32| colour(picture, Cell::Value(low + (high - low) * f64::from(part)), visuals);
    let mut strip = Mesh::default();
    let steps = 48_u8;
    for i in 0..=steps {
        let part = f32::from(i) / f32::from(steps);
        let x = bar.min.x + bar.width() * part;
        strip.colored_vertex(Pos2::new(x, bar.min.y), shade(part));
        strip.colored_vertex(Pos2::new(x, bar.max.y), shade(part));
        if i > 0 {
            let last = 2 * u32::from(i);
            strip.add_triangle(last - 2, last - 1, last);
            strip.add_triangle(last - 1, last, last + 1);
        }
    }
    painter.add(strip);
    let [below, above] = picture.beyond();
    for (beyond, at, align, mark, part) in [
        (below, bar.left_center(), Align2::RIGHT_CENTER, "◀", 0.0),
        (above, bar.right_center(), Align2::LEFT_CENTER, "▶", 1.0),
    ] {
        if beyond {
            painter.text(at, align, mark, FontId::proportional(theme::CAPTION), shade(part));
        }
    }
    for (part, label) in labels {
        let x = bar.min.x + bar.width() * part;
        painter.vline(x, bar.max.y..=bar.max.y + 3.0, Stroke::new(1.0, tokens.numbers));
        let at = Pos2::new(x, bar.max.y + 3.0);
        painter.text(at, Align2::CENTER_TOP, label, FontId::proportional(theme::CAPTION), tokens.numbers);
    }
}

/// Equally spaced ticks: where they are, as a part of the range, and what they say.
fn ticks([low, high]: [f64; 2]) -> Vec<(f32, String)> {
    let step = (high - low) / f64::from(INTERVALS);
    let decimals = decimals(step).max(decimals(low)).min(4);
    (0..=INTERVALS)
        .map(|i| {
            // No minus before zero.
            let value = low + f64::from(i) * step;
            let value = if value.abs() < 1e-9 * step { 0.0 } else { value };
            (f32::from(i) / f32::from(INTERVALS), format!("{value:.decimals$}"))
        })
        .collect()
}

/// What classes, patterns and signs mean, as far as there are any.
pub fn entries(ui: &mut Ui, picture: &Picture) {
    ui.horizontal_wrapped(|ui| {
        for class in (0..CLASSES).filter(|&class| picture.has(Cell::Class(class))) {
            let letter = name_of(picture.quantity, class);
            let name = match (picture.quantity, class) {
                (MapQuantity::Kind, 0) => "flutter".into(),
                (MapQuantity::Kind, _) => "divergence".into(),
                (_, cable) => format!("cable {}", cable + 1),
            };
            entry(ui, &name, |painter, visuals, square| {
                painter.rect_filled(square, 0.0, colour(picture, Cell::Class(class), visuals));
                sign(painter, visuals, square.center(), &letter);
            });
        }
        if let Some([low, high]) = picture.range.filter(|_| picture.quantity == MapQuantity::Growth) {
            entry(ui, "dies out", |painter, visuals, square| {
                painter.rect_filled(square, 0.0, colour(picture, Cell::Value(low), visuals));
            });
            entry(ui, "grows", |painter, visuals, square| {
                painter.rect_filled(square, 0.0, colour(picture, Cell::Value(high), visuals));
                sign(painter, visuals, square.center(), "▲");
            });
        }
        if picture.has(Cell::Infeasible) {
            entry(ui, NO_EQUILIBRIUM, |painter, visuals, square| {
                hatching(painter, visuals, square.min, &[corners(square)]);
            });
        }
        if picture.has(Cell::Failed) {
            entry(ui, NOT_COMPUTED, |painter, visuals, square| {
                dots(painter, visuals, square.min + Vec2::splat(3.0), square);
                sign(painter, visuals, square.center(), "?");
            });
        }
        if let Some(speed) = picture.none_up_to.filter(|_| picture.has(Cell::NoneUpTo)) {
            entry(ui, &format!("none up to {speed:.0} m/s"), |painter, visuals, square| {
                painter.rect_filled(square, 0.0, colour(picture, Cell::NoneUpTo, visuals));
                level_lines(painter, visuals, square.min, square);
            });
        }
    });
}

/// A square of a colour or pattern with what it means.
fn entry(ui: &mut Ui, name: &str, swatch: impl Fn(&Painter, &Visuals, Rect)) {
    let tokens = theme::tokens(ui.visuals());
    let galley = ui.painter().layout_no_wrap(name.into(), FontId::proportional(theme::CAPTION), tokens.weak);
    let size = Vec2::new(ENTRY + 4.0 + galley.size().x, ENTRY.max(galley.size().y));
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, name));
    let square = Rect::from_min_size(rect.left_center() - Vec2::new(0.0, 0.5 * ENTRY), Vec2::splat(ENTRY));
    swatch(ui.painter(), ui.visuals(), square);
    ui.painter().rect_stroke(square, 0.0, Stroke::new(1.0, tokens.frame), StrokeKind::Inside);
    let at = Pos2::new(square.max.x + 4.0, rect.center().y - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, tokens.weak);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_round_and_hold_what_they_are_of() {
        let near = |range: [f64; 2], expected: [f64; 2]| {
            (0..2).all(|end| (range[end] - expected[end]).abs() < 1e-9 * expected[1].abs())
        };
        for (found, symmetric, expected) in [
            ([0.04, 15.0], false, [0.0, 16.0]),
            ([0.0, 16.0], false, [0.0, 16.0]),
            ([9.2, 10.7], false, [9.2, 10.8]),
            ([-0.4, 0.4], true, [-0.4, 0.4]),
            ([-0.5, 0.5], true, [-0.5, 0.5]),
            ([130.0, 480.0], false, [100.0, 500.0]),
        ] {
            let range = round_range(found, 1.0, symmetric);
            assert!(near(range, expected), "{found:?}: {range:?}");
        }
        // In rad/s the ends are round, and the range is told in Hz.
        let turn = std::f64::consts::TAU;
        let range = round_range([0.04 / turn, 15.0 / turn], turn, false);
        assert!(near(range, [0.0, 16.0 / turn]), "{range:?}");
        for equal in [7.0, -3.0, 0.0] {
            let [low, high] = round_range([equal; 2], 1.0, false);
            assert!(low < equal && equal < high && high - low <= 1.0 + equal.abs(), "{equal}: {low} {high}");
        }
    }

    #[test]
    fn a_scale_has_five_ticks_with_the_digits_that_they_need() {
        let labels = |range| ticks(range).into_iter().map(|(_, label)| label).collect::<Vec<_>>();
        assert_eq!(labels([0.0, 16.0]), ["0", "4", "8", "12", "16"]);
        assert_eq!(labels([-0.4, 0.4]), ["-0.4", "-0.2", "0.0", "0.2", "0.4"]);
        assert_eq!(labels([9.0, 11.0]), ["9.0", "9.5", "10.0", "10.5", "11.0"]);
    }
}
