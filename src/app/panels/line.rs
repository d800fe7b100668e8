//! Critical speed and frequency along the motion: the paper's Fig. 3.

use eframe::egui::{Id, Ui};
use egui_plot::{HoverPosition, Line, LineStyle, Plot, PlotPoints, PlotUi, Points, Span, VLine};

use super::{explain, few_lines, plot_height, study};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::gestures;
use crate::app::series::Along;
use crate::app::theme;
use crate::compute::protocol::Topic;
use crate::stability::Critical;

/// Room for the values of both vertical axes, in points, so that the plots are one above the other.
const AXIS: f32 = 46.0;

/// What one of the two plots shows.
type Value<'a> = &'a dyn Fn(&Critical) -> f64;

/// Draws the two plots.
pub fn ui(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Facts { document, studies, settings, pinned, .. } = facts;
    let share = facts.share();
    let shown = study(ui, Topic::Line, studies, commands);
    let Some((along, current)) = shown.and_then(|shown| Some((Along::new(shown.known)?, shown.current))) else {
        return;
    };
    let findings = along.findings().filter(|_| current);
    let mut text = "The platform passes every point of the straight line on which it moves. Above: the speed at which \
                    a vibration would begin to grow there. Below: that vibration's frequency; 0 Hz is divergence. \
                    The curves break where another mode comes first."
        .to_owned();
    if let Some(findings) = &findings {
        text = format!("{text} {findings}");
    }
    explain(ui, &text);
    if let Some(findings) = findings {
        ui.label(findings);
    }
    if along.points.iter().all(|(_, verdict)| verdict.critical().is_none()) {
        ui.weak("No critical speed anywhere on this line.");
    }
    if !along.infeasible().is_empty() {
        ui.weak("Shaded: no equilibrium.");
    }
    let height = plot_height(ui, 2);
    let today = along.place(document.scenario.motion.position);
    let (hertz, name) = settings.hertz();
    let frequency = format!("Frequency ({name})");
    let plots: [(&str, &str, Value<'_>, bool); 2] = [
        ("Critical speed (m/s)", "m/s", &|critical| critical.speed, false),
        (&frequency, name, &|critical| critical.frequency_hz() * hertz, true),
    ];
    let before = pinned.and_then(|pinned| Along::new(pinned.study(Topic::Line)?));
    let group = Id::unique("along the line");
    for (title, unit, value, lowest) in plots {
        let abscissa = along.abscissa;
        let plot = Plot::new(title)
            .height(height)
            .link_axis(group, [true, false])
            .link_cursor(group, [true, false])
            .include_x(along.range[0])
            .include_x(along.range[1])
            .include_y(0.0)
            .y_axis_min_width(AXIS)
            .y_axis_label(title)
            .x_axis_label(if lowest { abscissa.label() } else { "" })
            .x_grid_spacer(few_lines)
            .y_grid_spacer(few_lines)
            .allow_scroll(false)
            .label_formatter(move |hover| {
                let (HoverPosition::NearDataPoint { position: point, .. }
                | HoverPosition::Elsewhere { position: point }) = hover;
                let place = abscissa.label();
                let (name, length) = place.split_once(" (").unwrap_or((place, "m)"));
                let length = length.trim_end_matches(')');
                Some(format!("{name} {:.3} {length}\n{} {unit}", point.x, digits::like(point.y, share)))
            });
        let shown = plot.show(ui, |plot| {
            if let Some(before) = &before {
                let colour = theme::pinned(&plot.ctx().global_style().visuals);
                for stretch in before.stretches(value) {
                    let line = Line::new("Pinned", PlotPoints::from(stretch)).style(LineStyle::dashed_dense());
                    plot.line(line.color(colour).width(1.5));
                }
            }
            draw(plot, &along, value, today, current);
        });
        gestures::scrolls_or_turns(&shown.response);
    }
}

fn draw(plot: &mut PlotUi<'_>, along: &Along, value: Value<'_>, today: f64, current: bool) {
    let visuals = plot.ctx().global_style().visuals.clone();
    for [from, to] in along.infeasible() {
        let shade = visuals.weak_text_color().gamma_multiply(0.28);
        plot.span(Span::new("", from..=to).fill(shade).border_width(0.0));
    }
    let colour = if current { theme::calm(&visuals) } else { visuals.weak_text_color() };
    for stretch in along.stretches(value) {
        if let [alone] = stretch[..] {
            plot.points(Points::new("", vec![alone]).radius(2.0).color(colour));
        } else {
            plot.line(Line::new("", PlotPoints::from(stretch)).color(colour).width(2.0));
        }
    }
    let line = VLine::new("Today's pose", today).style(LineStyle::dashed_loose());
    plot.vline(line.color(theme::accent(&visuals)).width(2.0));
}
