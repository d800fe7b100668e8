//! What the curve and the map have in common.

use eframe::egui::{Pos2, Response, Sense, Stroke, Ui, Vec2};

use super::super::chart::{Chart, Dash};
use super::numbers::Number;

/// So high the plot is at least, in points.
const LEAST: f32 = 150.0;

/// Room for a chart, in all there is.
pub fn room(ui: &mut Ui) -> Response {
    let size = ui.available_size_before_wrap();
    ui.allocate_exact_size(Vec2::new(size.x, size.y.max(LEAST)), Sense::click()).1
}

/// The line at the present value, with its word.
pub fn now(chart: &mut Chart, number: &Number) {
    let at = number.shown(number.value);
    let accent = chart.tokens.accent;
    if chart.rect.x_range().expand(0.5).contains(chart.x.pos(at)) {
        chart.upright(at, Stroke::new(1.5, accent), Dash::Dashed);
        let x = chart.x.pos(at);
        let spots = [chart.rect.top() + 12.0, chart.rect.bottom() - 12.0].map(|y| Pos2::new(x, y));
        chart.label(format!("now {}", number.text(number.value)), accent, &spots);
    }
}
