//! The largest growth rate against speed, with the critical speed and the speed now.

use eframe::egui::{Align2, Pos2, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};

use super::axis::signed;
use super::chart::{Chart, Dash, Titles, inner};
use super::common::{self, PlotPlace};
use super::range::{self, VisibleRange};
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::series;

/// What the plot shows, in plain words.
pub const MEANING: &str = "At every speed there is one vibration that dies away most slowly, or grows fastest. This is its \
    growth rate: below zero everything dies away, above zero something grows. Where it crosses zero for the first time is \
    the critical speed.";

/// Draws the plot.
pub fn ui(place: PlotPlace, ui: &mut Ui, facts: Facts<'_>) {
    let Facts { document, answers, designs, .. } = facts;
    let Some((curve, current)) = answers.curve().filter(|(points, _)| !points.is_empty()) else {
        common::say(ui, "No growth rates at this pose.");
        return;
    };
    let response = ui.allocate_rect(ui.available_rect_before_wrap(), Sense::click_and_drag());
    let outer = response.rect;
    let titles = Titles { x: Some("speed, m/s"), x_unit: None, y: Some("largest growth rate, 1/s") };
    let rect = inner(ui, outer, titles);
    let seen = near_zero(curve);
    let fit = bounds(&seen);
    let now = document.scenario.motion.speed;
    let axes = Chart::axes(rect, VisibleRange::of(ui.ctx(), place.id()).bounds(fit, bounds(curve)));
    let mut chart = Chart::new(ui, outer, rect, axes);
    let tokens = chart.tokens;
    let shade = |colour| if current { colour } else { tokens.mute };
    let words = |colour| if current { colour } else { tokens.weak };
    chart.band([0.0, f64::MAX], false, if current { tokens.critical_fill } else { tokens.field });
    chart.grid(titles);
    let zero = chart.pos([0.0, 0.0]).y;
    chart.level(0.0, Stroke::new(1.5, shade(tokens.critical)), Dash::Solid);
    chart.label_at("grows", words(tokens.critical), Pos2::new(rect.left() + 4.0, zero - 4.0), Align2::LEFT_BOTTOM);
    chart.label_at("dies out", words(tokens.stable), Pos2::new(rect.left() + 4.0, zero + 4.0), Align2::LEFT_TOP);
    for (letter, design) in designs.shown() {
        let (colour, dash) = (letter.colour(ui.visuals()), Dash::Design(letter));
        chart.curve(&near_zero(design.curve()), Stroke::new(1.75, colour), dash);
        if let Some(critical) = design.critical() {
            let speed = digits::certain(critical.speed, design.certainty().speed());
            chart.upright(critical.speed, Stroke::new(1.5, colour), dash);
            let at = Pos2::new(chart.x.pos(critical.speed), rect.bottom() - 12.0);
            chart.label(format!("{} {speed}", letter.name()), colour, &[at, at - Vec2::new(0.0, 22.0)]);
        }
    }
    for piece in
        series::growth(&if VisibleRange::of(ui.ctx(), place.id()) == VisibleRange::Fit { seen } else { curve.to_vec() })
    {
        let points: Vec<[f64; 2]> = piece.points.iter().map(|(speed, rate)| [*speed, rate.re]).collect();
        let stroke = if piece.unstable {
            Stroke::new(3.0, shade(tokens.critical))
        } else {
            Stroke::new(2.25, shade(tokens.stable))
        };
        chart.curve(&points, stroke, Dash::Solid);
    }
    let critical = answers.last_critical().and_then(|answer| answer.critical.as_ref());
    let top = rect.top() + 12.0;
    if let Some(critical) = critical {
        chart.upright(critical.speed, Stroke::new(3.0, shade(tokens.critical)), Dash::Solid);
        let text = format!("critical {}", common::speed(facts, critical));
        let spot = Pos2::new(chart.x.pos(critical.speed), top);
        chart.label(text, words(tokens.critical), &[spot]);
    }
    chart.upright(now, Stroke::new(1.5, tokens.accent), Dash::Dashed);
    let spot = Pos2::new(chart.x.pos(now), top);
    chart.label(format!("now {now:.2}"), tokens.accent, &[spot, spot + Vec2::new(0.0, 22.0)]);
    chart.finish();
    range::turn(ui, &response, place.id(), axes, fit, place.turning([true, true]));

    let at = |speed: f64| {
        let nearest = curve.iter().min_by(|a, b| (a[0] - speed).abs().total_cmp(&(b[0] - speed).abs()));
        nearest.copied()
    };
    if let Some(pointer) = response.hover_pos().filter(|_| !response.dragged())
        && let Some([speed, rate]) = at(chart.x.value(pointer.x))
    {
        let place = chart.pos([speed, rate]);
        chart.mark(place, super::chart::Symbol::Ring, 5.0, tokens.text);
        chart.card(place, &[format!("{speed:.2} m/s"), how(rate)]);
    }
    response.widget_info(|| {
        let here = at(now)
            .map_or_else(String::new, |[_, rate]| format!("At {now:.2} m/s the slowest vibration {}. ", how(rate)));
        let critical = critical.map_or_else(
            || "It crosses zero nowhere on show.".to_owned(),
            |critical| format!("It crosses zero at {} m/s.", common::speed(facts, critical)),
        );
        WidgetInfo::labeled(
            Role::Image,
            true,
            format!("Growth: the largest growth rate against speed. {here}{critical}"),
        )
    });
}

/// A growth rate in words.
fn how(rate: f64) -> String {
    let size = signed(&digits::certain(rate, None));
    if rate > 0.0 { format!("grows, {size} 1/s") } else { format!("dies out, {size} 1/s") }
}

/// What a curve spans, with zero.
fn bounds(curve: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let span = |low: f64, high: f64| if high > low { [low, high] } else { [low, low + 1.0] };
    let speeds = || curve.iter().map(|point| point[0]);
    let rates = || curve.iter().map(|point| point[1]);
    let [low, high] = span(rates().fold(0.0, f64::min), rates().fold(0.0, f64::max));
    let room = 0.12 * (high - low);
    [span(0.0, speeds().fold(0.0, f64::max)), [low - room, high + room]]
}

/// The curve without its steep end: where growth far exceeds the decay at low speeds it would flatten the crossing.
fn near_zero(curve: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let lowest = curve.iter().map(|point| point[1]).fold(0.0, f64::min);
    let end = curve.iter().rposition(|point| point[1] <= -2.0 * lowest);
    curve.iter().take(end.map_or(curve.len(), |end| end + 2)).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_matters_is_the_crossing() {
        let curve = [[0.0, -0.5], [5.0, -0.2], [10.0, 0.4], [15.0, 30.0], [20.0, 90.0]];
        assert_eq!(near_zero(&curve), curve[..4]);
        let [speeds, rates] = bounds(&curve[..3]);
        assert_eq!(speeds.map(|speed| speed.to_string()), ["0", "10"]);
        assert!(rates[0] < -0.5 && rates[1] > 0.4);
        assert!(bounds(&[])[0][1] > 0.0);
        assert_eq!((how(-0.2), how(0.4)), ("dies out, −0.200 1/s".into(), "grows, 0.400 1/s".into()));
    }
}
