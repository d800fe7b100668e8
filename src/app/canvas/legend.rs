//! What the colours of the cables mean, and the button that brings everything into view.

use eframe::egui::{Align2, FontId, Layout, Painter, Pos2, Rect, Stroke, Ui, UiBuilder, Vec2, Visuals};

use super::paint::{tension_colour, trimmed};
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::theme;

/// The bar of colours, in points.
const BAR: Vec2 = Vec2::new(180.0, 8.0);
/// On a phone it is this long.
const SHORT: f32 = 150.0;
/// How many numbers there are at the bar, about.
const NUMBERS: f64 = 5.0;
/// From this force on, in N, the bar's numbers are in kN.
const LARGE: f64 = 1e4;

/// The forces in N that are written at a bar from 0 to `strongest`.
fn numbers(strongest: f64) -> Vec<f64> {
    if !(strongest > 0.0 && strongest.is_finite()) {
        return Vec::new();
    }
    let decade = 10_f64.powf(strongest.log10().floor());
    let count = |step: f64| (strongest / step + 1e-9).floor() + 1.0;
    let steps = [0.1, 0.2, 0.25, 0.5, 1.0, 2.0, 2.5].map(|part| part * decade);
    let off = |step: &f64| (count(*step) - NUMBERS).abs();
    let step = steps.into_iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(decade);
    (0..20).map(|i| f64::from(i) * step).take_while(|force| *force <= strongest * (1.0 + 1e-9)).collect()
}

/// The bar of the tensions' colours at the right of `corner`, or at its left where that is the `left` one of the canvas.
pub fn tensions(
    painter: &Painter,
    visuals: &Visuals,
    font: &FontId,
    corner: Rect,
    left: bool,
    [strongest, largest]: [f64; 2],
) {
    if strongest <= 0.0 {
        return;
    }
    let tokens = theme::tokens(visuals);
    let (unit, one) = if strongest < LARGE { ("N", 1.0) } else { ("kN", 1e3) };
    let size = Vec2::new((if left { SHORT } else { BAR.x }).min(corner.width()), BAR.y);
    let start = if left { corner.left_top() } else { corner.right_top() - Vec2::new(size.x, 0.0) };
    let title = if largest > 1.001 * strongest {
        format!("Cable tension, {unit}, now up to {}", trimmed((largest / one).round()))
    } else {
        format!("Cable tension, {unit}")
    };
    painter.text(start + Vec2::new(0.0, 3.0), Align2::LEFT_TOP, title, font.clone(), tokens.weak);
    let bar = Rect::from_min_size(start + Vec2::new(0.0, font.size + 12.0), size);
    let steps = 60_u8;
    let step = bar.width() / f32::from(steps);
    for i in 0..steps {
        let colour = tension_colour(f64::from(i), f64::from(steps - 1), visuals);
        let min = bar.min + Vec2::new(f32::from(i) * step, 0.0);
        painter.rect_filled(Rect::from_min_size(min, Vec2::new(step + 0.5, bar.height())), 0.0, colour);
    }
    for force in numbers(strongest) {
        #[expect(clippy::cast_possible_truncation)] // A part of one.
        let x = bar.min.x + bar.width() * (force / strongest) as f32;
        painter
            .line_segment([Pos2::new(x, bar.max.y), Pos2::new(x, bar.max.y + 4.0)], Stroke::new(1.0, tokens.numbers));
        let galley = painter.layout_no_wrap(trimmed(force / one), font.clone(), tokens.numbers);
        let middle = x - 0.5 * galley.size().x;
        let at = middle.min(bar.max.x - galley.size().x).max(bar.min.x);
        painter.galley(Pos2::new(at, bar.max.y + 4.0), galley, tokens.numbers);
    }
}

/// The button that brings everything into view, in the corner of `room` that `layout` begins in. Gives whether it was pressed.
pub fn fit(ui: &mut Ui, room: Rect, layout: Layout, named: bool, height: f32) -> bool {
    let inside = UiBuilder::new().max_rect(room).layout(layout).id_salt("fit");
    let button = |ui: &mut Ui| {
        let button = IconButton::new(Icon::Fit, "Fit robot").text(if named { "Fit" } else { "" });
        let text = "Shows the whole robot, and fits the colours to the tensions that are there";
        button.framed().height(height).show(ui).explained(text).clicked()
    };
    ui.scope_builder(inside, button).inner
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_has_about_five_round_numbers() {
        assert_eq!(numbers(204.3), [0.0, 50.0, 100.0, 150.0, 200.0]);
        assert_eq!(numbers(1000.0), [0.0, 250.0, 500.0, 750.0, 1000.0]);
        for strongest in [0.03, 1.0, 7.7, 19.0, 65.0, 167.0, 320.0, 9_999.0, 5e6] {
            let numbers = numbers(strongest);
            assert!((4..=6).contains(&numbers.len()), "{strongest}: {numbers:?}");
            assert!(numbers.iter().all(|&force| force <= 1.000_001 * strongest));
        }
        assert!(numbers(0.0).is_empty() && numbers(f64::NAN).is_empty());
    }
}
