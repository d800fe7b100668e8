//! Frequencies and growth rates of all modes against speed: the Campbell diagram.

use std::f64::consts::TAU;

use eframe::egui::emath::smart_aim::best_in_range_f64;
use eframe::egui::{Id, Ui, Vec2, Visuals};
use egui_plot::{HoverPosition, Line, LineStyle, MarkerShape, Plot, PlotPoints, PlotUi, Points, VLine};
use nalgebra::Complex;

use super::{explain, few_lines, plot_height, study};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::gestures;
use crate::app::number::{self, Control, Unit};
use crate::app::series::{self, Piece};
use crate::app::studies::Shown;
use crate::app::theme;
use crate::compute::protocol::Topic;

/// Room for the values of both vertical axes, in points, so that the plots are one above the other.
const AXIS: f32 = 46.0;

/// Draws the two plots; a click sets the speed.
pub fn ui(
    highest: &mut f64,
    ui: &mut Ui,
    Facts { document, answers, studies, joined, settings, pinned, .. }: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    let Some(Shown { known, current }) = study(ui, Topic::Campbell, studies, commands) else { return };
    explain(
        ui,
        "Every line is a mode of the robot at this pose. Above: how its frequency changes as the platform moves \
         faster; below: how fast it grows (above zero) or dies away (below). Thin lines are stable, thick ones with \
         ▲ grow. The first mode to become thick is the one that sets the critical speed. Click to set the speed.",
    );
    ui.horizontal(|ui| {
        ui.spacing_mut().slider_width = 90.0;
        let unit = Unit::of_hertz(settings.hertz().1);
        let step = 0.01 * unit.shown(*highest);
        let control = Control { name: "Highest frequency", unit, step, size: Vec2::new(80.0, 18.0) };
        let meaning = "Modes with higher frequencies are not drawn.";
        number::slider(ui, &control, meaning, highest, [0.5, 100.0].map(|end| unit.shown(end)));
    });
    let pieces = joined.pieces();
    if pieces.is_empty() {
        let ended = known.is_complete() && !joined.is_working();
        ui.weak(if ended { "No eigenvalues at this pose." } else { "No answer yet." });
        return;
    }
    let height = plot_height(ui, 2);
    let visuals = ui.visuals().clone();
    let critical = answers.last_critical().and_then(|answer| answer.critical.as_ref()).map(|critical| critical.speed);
    let today = document.scenario.motion.speed;
    let group = Id::unique("campbell");
    let mut clicked = None;
    let (hertz, name) = settings.hertz();
    let frequency = format!("Frequency ({name})");
    for (title, unit, growth) in [(frequency.as_str(), name, false), ("Growth rate (1/s)", "1/s", true)] {
        let [low, high] = if growth { growth_range(pieces) } else { [0.0, *highest * hertz] };
        // Another range is another plot, or the last one's would stay.
        let plot = Plot::new((title, highest.to_bits(), known.version.0))
            .height(height)
            .link_axis(group, [true, false])
            .link_cursor(group, [true, false])
            .default_y_bounds(low, high)
            .include_x(0.0)
            .y_axis_min_width(AXIS)
            .y_axis_label(title)
            .x_axis_label(if growth { "Speed (m/s)" } else { "" })
            .x_grid_spacer(few_lines)
            .y_grid_spacer(few_lines)
            .allow_scroll(false)
            .label_formatter(move |hover| {
                let (HoverPosition::NearDataPoint { position: point, .. }
                | HoverPosition::Elsewhere { position: point }) = hover;
                Some(format!("{:.3} m/s\n{} {unit}", point.x, digits::certain(point.y, None)))
            });
        let shown = plot.show(ui, |plot| {
            draw(plot, &visuals, pieces, (!growth).then_some(hertz), current);
            if let Some(critical) = critical {
                plot.vline(VLine::new("Critical speed", critical).color(theme::warning(&visuals)).width(1.5));
            }
            if let Some(pinned) = pinned {
                let colour = theme::pinned(&visuals);
                let value = |of: Complex<f64>| if growth { of.re } else { of.im / TAU * hertz };
                let points: Vec<[f64; 2]> = pinned
                    .study(Topic::Campbell)
                    .map(series::spectra)
                    .unwrap_or_default()
                    .into_iter()
                    .map(|(speed, eigenvalue)| [speed, value(eigenvalue)])
                    .filter(|point| (low..=high).contains(&point[1]))
                    .collect();
                plot.points(Points::new("Pinned", points).radius(1.2).color(colour).allow_hover(false));
                if let Some(critical) = pinned.critical() {
                    let line = VLine::new("Pinned critical speed", critical.speed).style(LineStyle::dashed_dense());
                    plot.vline(line.color(colour).width(1.5));
                }
            }
            let line = VLine::new("Today's speed", today).style(LineStyle::dashed_loose());
            plot.vline(line.color(theme::accent(&visuals)).width(2.0));
        });
        gestures::scrolls_or_turns(&shown.response);
        if let Some(at) = shown.response.interact_pointer_pos().filter(|_| shown.response.clicked()) {
            let speed = |pos| shown.transform.value_from_position(pos).x.max(0.0);
            let point = eframe::egui::Vec2::new(0.5, 0.0);
            clicked = Some(best_in_range_f64(speed(at - point), speed(at + point)));
        }
    }
    if let Some(speed) = clicked {
        let mut scenario = document.scenario.clone();
        scenario.motion.speed = speed;
        commands.push(Command::Edit(Box::new(scenario)));
    }
}

/// Draws frequencies, one hertz being so much, or growth rates.
fn draw(plot: &mut PlotUi<'_>, visuals: &Visuals, pieces: &[Piece], hertz: Option<f64>, current: bool) {
    let (calm, warning) = if current {
        (theme::calm(visuals), theme::warning(visuals))
    } else {
        (visuals.weak_text_color(), visuals.weak_text_color())
    };
    for piece in pieces {
        let value = |&(speed, eigenvalue): &(f64, nalgebra::Complex<f64>)| {
            [speed, hertz.map_or(eigenvalue.re, |hertz| eigenvalue.im / TAU * hertz)]
        };
        let points: Vec<[f64; 2]> = piece.points.iter().map(value).collect();
        if piece.unstable {
            // Few enough to be seen one by one.
            let marks: Vec<[f64; 2]> = points.iter().skip(1).step_by(4).copied().collect();
            plot.points(Points::new("", marks).shape(MarkerShape::Up).radius(4.0).color(warning).allow_hover(false));
            plot.line(Line::new("", PlotPoints::from(points)).color(warning).width(3.0));
        } else {
            plot.line(Line::new("", PlotPoints::from(points)).color(calm).width(1.2));
        }
    }
    if hertz.is_none() {
        plot.hline(egui_plot::HLine::new("", 0.0).color(visuals.weak_text_color()).allow_hover(false));
    }
}

/// The growth rates worth seeing: from those of oscillations at rest to as far above zero, or less where nothing grows
/// as fast. Overdamped modes lie far below.
fn growth_range(pieces: &[Piece]) -> [f64; 2] {
    let all = || pieces.iter().flat_map(|piece| &piece.points);
    let at_rest = all().filter(|(speed, value)| *speed == 0.0 && value.im > 0.0).map(|(_, value)| value.re);
    let lowest = at_rest.fold(0.0, f64::min).min(-1e-3);
    let highest = all().map(|(_, value)| value.re).fold(0.0, f64::max);
    [1.2 * lowest, (1.1 * highest).clamp(-0.2 * lowest, -1.2 * lowest)]
}
