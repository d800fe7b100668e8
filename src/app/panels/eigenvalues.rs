//! Eigenvalues in the complex plane; a click chooses the mode whose shape moves on the canvas.

use std::f64::consts::TAU;

use eframe::egui::Ui;
use egui_plot::{HoverPosition, MarkerShape, Plot, PlotPoints, Points, VLine};

use super::{STALE, explain, near, plot_height, with_modes};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::gestures;
use crate::app::pinned::Pinned;
use crate::app::theme;

/// A click chooses a point that is at most this far away, in points.
const REACH: f32 = 24.0;

/// Draws the plot.
pub fn ui(ui: &mut Ui, Facts { answers, settings, pinned, mode: choice, .. }: Facts<'_>, commands: &mut Vec<Command>) {
    let Some(pose) = with_modes(ui, answers) else { return };
    ui.weak(if answers.pose_is_current() {
        "Right of the line a vibration grows. Click a point: its mode moves on the canvas."
    } else {
        STALE
    });
    explain(
        ui,
        "Every point is a way in which the robot vibrates at today's speed: how fast it grows (to the right) or dies \
         away (to the left), and how often it swings. One point right of the line is enough for instability.",
    );
    let visuals = ui.visuals().clone();
    let (hertz, unit) = settings.hertz();
    let point = move |[re, im]: [f64; 2]| [re, im.abs() / TAU * hertz];
    let modes = pose.modes.iter().map(|mode| point(mode.eigenvalue));
    let (unstable, stable): (Vec<_>, Vec<_>) = modes.partition(|[growth, _]| *growth > 0.0);
    let chosen = answers.shape().map(|shape| point(shape.eigenvalue));
    let plot = Plot::new("eigenvalues")
        .x_axis_label("Re λ, growth rate (1/s)")
        .y_axis_label(if unit == "Hz" { "Im λ/2π (Hz)" } else { "Im λ (rad/s)" })
        .height(plot_height(ui, 1))
        .include_x(0.2)
        .allow_scroll(false)
        .label_formatter(move |hover| {
            let (HoverPosition::NearDataPoint { position: point, .. } | HoverPosition::Elsewhere { position: point }) =
                hover;
            Some(format!("{} 1/s\n{} {unit}", digits::certain(point.x, None), digits::certain(point.y, None)))
        });
    let shown = plot.show(ui, |plot| {
        plot.vline(VLine::new("Limit of stability", 0.0).color(visuals.weak_text_color()));
        let points = |name, points: Vec<[f64; 2]>, shape, colour, radius| {
            Points::new(name, PlotPoints::from(points)).shape(shape).color(colour).radius(radius)
        };
        plot.points(points("Stable", stable, MarkerShape::Circle, theme::calm(&visuals), 3.0));
        plot.points(points("Unstable", unstable, MarkerShape::Up, theme::warning(&visuals), 6.0));
        if let Some(pose) = pinned.and_then(Pinned::pose) {
            let before = pose.modes.iter().map(|mode| point(mode.eigenvalue)).collect();
            let before = points("Pinned", before, MarkerShape::Diamond, theme::pinned(&visuals), 4.0);
            plot.points(before.filled(false));
        }
        if let Some(chosen) = chosen {
            let ring = points("Mode on show", vec![chosen], MarkerShape::Circle, theme::accent(&visuals), 7.0);
            plot.points(ring.filled(false));
        }
    });
    gestures::scrolls_or_turns(&shown.response);
    if let Some(clicked) = shown.response.interact_pointer_pos().filter(|_| shown.response.clicked()) {
        let distance = |mode: &[f64; 2]| shown.transform.position_from_point(&point(*mode).into()).distance(clicked);
        let eigenvalues = pose.modes.iter().map(|mode| mode.eigenvalue);
        let nearest = eigenvalues.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(eigenvalue) = nearest.filter(|mode| distance(mode) < REACH) {
            commands.push(Command::ChooseMode(near(choice, eigenvalue)));
        }
    }
}
