//! The critical speed on several meshes, and what infinitely many elements would give.

use eframe::egui::Ui;
use egui_plot::{Axis, HLine, HoverPosition, Line, LineStyle, Plot, PlotPoints, Points, Span, VLine};

use super::{explain, few_lines, plot_height, study};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::gestures;
use crate::app::series::Meshes;
use crate::app::studies::Shown;
use crate::app::theme;
use crate::compute::protocol::Topic;
use crate::study::convergence::{Convergence, Extrapolation, NoLimit};

/// Draws the plot.
pub fn ui(ui: &mut Ui, Facts { document, studies, pinned, .. }: Facts<'_>, commands: &mut Vec<Command>) {
    let Some(Shown { known, current }) = study(ui, Topic::Convergence, studies, commands) else { return };
    let today = document.scenario.elements_per_cable;
    let Some(meshes) = Meshes::new(known, today) else { return };
    explain(
        ui,
        "A cable of n elements is a chain of straight pieces. With more of them the critical speed comes nearer to \
         that of a smooth cable. The error falls as 1/n² where a vibration grows, but only as 1/n for a divergence, \
         which the last element before the winch decides. The level line is what Richardson's extrapolation says for \
         n without end, from the order that the finest meshes show and the one that is known; the band around it is how \
         far that may be off.",
    );
    let stretches = meshes.stretches();
    let limit = match meshes.limit {
        _ if !known.is_complete() => None,
        Convergence::Limit(limit) => {
            ui.label(error(today, &limit));
            Some(limit)
        }
        Convergence::Unknown(doubt) => {
            ui.label(reason(doubt));
            None
        }
    };
    if stretches.is_empty() {
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
            Some(format!("{:.0} elements\n{} m/s", point.x, digits::certain(point.y, Some(0.0))))
        })
        .show(ui, |plot| {
            if let Some(Extrapolation { limit, uncertainty, .. }) = limit {
                let shade = visuals.weak_text_color().gamma_multiply(0.28);
                let band = Span::new("", limit - uncertainty..=limit + uncertainty).axis(Axis::Y);
                plot.span(band.fill(shade).border_width(0.0));
                let line = HLine::new("Limit", limit).style(LineStyle::dashed_dense());
                plot.hline(line.color(visuals.text_color()).width(1.5));
            }
            if let Some(before) = pinned.and_then(|pinned| Meshes::new(pinned.study(Topic::Convergence)?, today)) {
                for stretch in before.stretches() {
                    let line = Line::new("Pinned", PlotPoints::from(stretch)).style(LineStyle::dashed_dense());
                    plot.line(line.color(theme::pinned(&visuals)).width(1.5));
                }
            }
            for stretch in stretches {
                plot.line(Line::new("", PlotPoints::from(stretch.clone())).color(colour).width(1.5).allow_hover(false));
                plot.points(Points::new("", stretch).radius(4.0).color(colour));
            }
            let line = VLine::new("Today's mesh", today as f64).style(LineStyle::dashed_loose());
            plot.vline(line.color(theme::accent(&visuals)).width(2.0));
        });
    gestures::scrolls_or_turns(&shown.response);
}

/// How wrong today's mesh is, in a sentence.
fn error(today: usize, extrapolation: &Extrapolation) -> String {
    let &Extrapolation { limit, error, order, estimated, uncertainty, .. } = extrapolation;
    let order = if estimated {
        format!("order {order:.1} seen")
    } else {
        format!("order {order:.0}, too few meshes to see it")
    };
    let [value, margin] = [digits::certain(limit, Some(uncertainty)), digits::margin(limit, uncertainty)];
    let limit_text = format!("{value} ± {margin} m/s in the limit ({order})");
    let Some(error) = error else {
        return format!("The critical speed is {limit_text}; with {today} elements another mode comes first, or none.");
    };
    let percent = |part: f64| digits::certain(100.0 * part / limit, Some(100.0 * uncertainty / limit));
    if error.abs() <= uncertainty {
        let within = digits::at_most(100.0 * (error.abs() + uncertainty) / limit);
        return format!("With {today} elements the critical speed is right within {within} %: {limit_text}.");
    }
    let way = if error < 0.0 { "low" } else { "high" };
    format!("With {today} elements the critical speed is {} % too {way}: {limit_text}.", percent(error.abs()))
}

/// Why there is no limit, in a sentence.
fn reason(doubt: NoLimit) -> &'static str {
    match doubt {
        NoLimit::NoneCritical => "The finest mesh has no critical speed, so there is no limit to tell.",
        NoLimit::TooFew => "Only one mesh has a critical speed, so its error cannot be told.",
        NoLimit::Changes => "Not yet converging: the finest meshes do not agree on the mode that comes first.",
        NoLimit::Unsettled => {
            "Not yet converging: from mesh to mesh the critical speed changes in no order that is known."
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::convergence::Estimate;

    #[test]
    fn errors_are_told_in_percent_with_their_sign_and_no_more_digits_than_are_certain() {
        let of = |error| told(error, 0.011);
        assert_eq!(
            of(Some(0.253)),
            "With 10 elements the critical speed is 2.3 % too high: 11.00 ± 0.011 m/s in the limit (order 2.0 seen)."
        );
        assert!(of(Some(-0.11)).starts_with("With 10 elements the critical speed is 1.0 % too low: "));
        assert!(of(Some(1e-5)).contains("right within 0.2 %: 11.00 ± 0.011 m/s"), "{}", of(Some(1e-5)));
        assert!(of(None).ends_with("with 10 elements another mode comes first, or none."));
        // Nothing is right to more digits than that.
        assert!(told(Some(0.25), 0.3).contains("right within 5 %: 11.0 ± 0.30 m/s"), "{}", told(Some(0.25), 0.3));
    }

    #[test]
    fn where_meshes_disagree_no_number_is_told() {
        for doubt in [NoLimit::Changes, NoLimit::Unsettled] {
            let text = reason(doubt);
            assert!(text.starts_with("Not yet converging") && !text.contains(|c: char| c.is_ascii_digit()), "{text}");
        }
    }

    fn told(error: Option<f64>, uncertainty: f64) -> String {
        let frequency = Estimate { limit: 1.0, uncertainty: 0.1 };
        super::error(10, &Extrapolation { limit: 11.0, uncertainty, frequency, order: 2.0, estimated: true, error })
    }
}
