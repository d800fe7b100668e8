//! The critical speed on several meshes, and what infinitely many elements would give.

use eframe::egui::Ui;
use egui_plot::{HLine, HoverPosition, Line, LineStyle, Plot, PlotPoints, Points, VLine};

use super::{explain, few_lines, plot_height, study};
use crate::app::Facts;
use crate::app::command::Command;
use crate::app::gestures;
use crate::app::series::Meshes;
use crate::app::studies::Shown;
use crate::app::theme;
use crate::compute::protocol::Topic;
use crate::study::convergence::{Convergence, Doubt, Extrapolation};

/// Draws the plot.
pub fn ui(ui: &mut Ui, Facts { document, studies, pinned, .. }: Facts<'_>, commands: &mut Vec<Command>) {
    let Some(Shown { known, current }) = study(ui, Topic::Convergence, studies, commands) else { return };
    let today = document.scenario.elements_per_cable;
    let Some(meshes) = Meshes::new(known, today) else { return };
    explain(
        ui,
        "A cable of n elements is a chain of straight pieces. With more of them the critical speed comes nearer to \
         that of a smooth cable; the error falls as 1/n². The level line is what Richardson's extrapolation says for \
         n without end.",
    );
    let speeds = meshes.speeds();
    let limit = match meshes.limit {
        _ if !known.is_complete() => None,
        Convergence::Limit(limit) => {
            ui.label(error(today, limit));
            Some(limit.limit)
        }
        Convergence::Unknown(doubt) => {
            ui.label(reason(doubt));
            None
        }
    };
    if speeds.is_empty() {
        ui.weak(if known.is_complete() { "No critical speed on any mesh." } else { "No answer yet." });
        return;
    }
    let visuals = ui.visuals().clone();
    let colour = if current { theme::calm(&visuals) } else { visuals.weak_text_color() };
    let shown = Plot::new("mesh")
        .height(plot_height(ui, 1))
        .x_axis_label("Elements per cable")
        .y_axis_label("Critical speed (m/s)")
        .include_x(0.0)
        .x_grid_spacer(few_lines)
        .y_grid_spacer(few_lines)
        .allow_scroll(false)
        .label_formatter(|hover| {
            let (HoverPosition::NearDataPoint { position: point, .. } | HoverPosition::Elsewhere { position: point }) =
                hover;
            Some(format!("{:.0} elements\n{:.4} m/s", point.x, point.y))
        })
        .show(ui, |plot| {
            if let Some(limit) = limit {
                let line = HLine::new("Limit", limit).style(LineStyle::dashed_dense());
                plot.hline(line.color(visuals.text_color()).width(1.5));
            }
            if let Some(before) = pinned.and_then(|pinned| Meshes::new(pinned.study(Topic::Convergence)?, today)) {
                let line = Line::new("Pinned", PlotPoints::from(before.speeds())).style(LineStyle::dashed_dense());
                plot.line(line.color(theme::pinned(&visuals)).width(1.5));
            }
            plot.line(Line::new("", PlotPoints::from(speeds.clone())).color(colour).width(1.5).allow_hover(false));
            plot.points(Points::new("", speeds).radius(4.0).color(colour));
            let line = VLine::new("Today's mesh", today as f64).style(LineStyle::dashed_loose());
            plot.vline(line.color(theme::accent(&visuals)).width(2.0));
        });
    gestures::scrolls_or_turns(&shown.response);
}

/// How wrong today's mesh is, in a sentence.
fn error(today: usize, Extrapolation { limit, error, order, estimated }: Extrapolation) -> String {
    let found = if estimated { format!(" (found order {order:.2})") } else { String::new() };
    let limit_text = format!("{limit:.4} m/s in the limit{found}");
    match error {
        Some(error) => {
            let percent = 100.0 * error / limit;
            let way = if percent < 0.0 { "low" } else { "high" };
            let size = percent.abs();
            if size < 0.05 {
                return format!("With {today} elements the critical speed is right within 0.05 %: {limit_text}.");
            }
            format!("With {today} elements the critical speed is {size:.1} % too {way}: {limit_text}.")
        }
        None => format!("The critical speed is {limit_text}; with {today} elements there is none."),
    }
}

/// Why there is no limit, in a sentence.
fn reason(doubt: Doubt) -> &'static str {
    match doubt {
        Doubt::NoneCritical => "The finest mesh has no critical speed, so there is no limit to tell.",
        Doubt::TooFew => "Only the finest mesh has a critical speed, so its error cannot be told.",
        Doubt::Changes => "Another mode comes first on the finest mesh, so its error cannot be told.",
        Doubt::Unsettled => "The critical speed does not settle: even the finest mesh is too coarse to tell the error.",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_told_in_percent_with_their_sign() {
        let of = |error| error_of(11.0, error);
        assert_eq!(of(Some(0.253)), "With 10 elements the critical speed is 2.3 % too high: 11.0000 m/s in the limit.");
        assert_eq!(of(Some(-0.11)), "With 10 elements the critical speed is 1.0 % too low: 11.0000 m/s in the limit.");
        assert!(of(Some(1e-5)).contains("right within 0.05 %"));
        assert!(of(None).ends_with("with 10 elements there is none."));
    }

    fn error_of(limit: f64, error: Option<f64>) -> String {
        super::error(10, Extrapolation { limit, order: 2.0, estimated: false, error })
    }
}
