//! The largest growth rate against speed, with the critical speed and today's.

use eframe::egui::Ui;
use egui_plot::{Corner, HLine, HoverPosition, Legend, Line, LineStyle, Plot, PlotPoints, VLine};

use super::{STALE, explain, plot_height};
use crate::app::facts::Facts;
use crate::app::gestures;
use crate::app::{digits, series, theme};

/// Draws the plot.
pub fn ui(ui: &mut Ui, Facts { document, answers, pinned, certainty, .. }: Facts<'_>) {
    let curve = answers.curve().filter(|(points, _)| !points.is_empty());
    let (Some(answer), Some((curve, current))) = (answers.last_critical(), curve) else {
        ui.weak("No growth rates at this pose.");
        return;
    };
    let visuals = ui.visuals().clone();
    ui.weak(if current {
        "Above the line at zero a vibration grows. Its first crossing is the critical speed."
    } else {
        STALE
    });
    explain(
        ui,
        "At every speed there is one vibration that dies away most slowly, or grows fastest. This is its growth rate: \
         below zero everything dies away, above zero something grows.",
    );
    let shade = |colour| if current { colour } else { visuals.weak_text_color() };
    let shown = Plot::new("growth")
        .x_axis_label("Speed (m/s)")
        .y_axis_label("Largest Re λ (1/s)")
        .height(plot_height(ui, 1))
        .include_y(0.0)
        .allow_scroll(false)
        .legend(Legend::default().position(Corner::LeftTop))
        .label_formatter(|hover| {
            let (HoverPosition::NearDataPoint { position: point, .. } | HoverPosition::Elsewhere { position: point }) =
                hover;
            Some(format!("{:.3} m/s\n{} 1/s", point.x, digits::certain(point.y, None)))
        })
        .show(ui, |plot| {
            plot.hline(HLine::new("", 0.0).color(visuals.weak_text_color()).allow_hover(false));
            if let Some(pinned) = pinned {
                let colour = theme::pinned(&visuals);
                let curve = PlotPoints::from(near_zero(pinned.curve().unwrap_or_default()));
                let line = Line::new("Pinned", curve).style(LineStyle::dashed_dense());
                plot.line(line.color(colour).width(2.0));
                if let Some(critical) = pinned.critical() {
                    let speed = digits::certain(critical.speed, pinned.certainty().speed());
                    let line = VLine::new(format!("Pinned {speed} m/s"), critical.speed);
                    plot.vline(line.style(LineStyle::dashed_dense()).color(colour).width(1.5));
                }
            }
            for piece in series::growth(&near_zero(curve)) {
                let points: Vec<[f64; 2]> = piece.points.iter().map(|(speed, rate)| [*speed, rate.re]).collect();
                let line = Line::new(if piece.unstable { "Grows" } else { "Dies out" }, PlotPoints::from(points));
                plot.line(if piece.unstable {
                    line.color(shade(theme::warning(&visuals))).width(3.0)
                } else {
                    line.color(shade(theme::calm(&visuals))).width(2.0)
                });
            }
            if let Some(critical) = &answer.critical {
                let speed = digits::certain(critical.speed, certainty.speed());
                let line = VLine::new(format!("Critical {speed} m/s"), critical.speed);
                plot.vline(line.color(theme::warning(&visuals)).width(2.0));
            }
            let speed = document.scenario.motion.speed;
            let today = VLine::new(format!("Today {speed:.2} m/s"), speed).style(LineStyle::dashed_loose());
            plot.vline(today.color(theme::accent(&visuals)).width(2.0));
        });
    gestures::scrolls_or_turns(&shown.response);
}

/// The curve without its steep end: where growth far exceeds the decay at low speeds it would flatten the crossing.
fn near_zero(curve: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let lowest = curve.iter().map(|point| point[1]).fold(0.0, f64::min);
    let end = curve.iter().rposition(|point| point[1] <= -2.0 * lowest);
    curve.iter().take(end.map_or(curve.len(), |end| end + 2)).copied().collect()
}
