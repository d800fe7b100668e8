//! The critical speed in every direction, as a polar diagram.

use std::f64::consts::TAU;

use eframe::egui::{Align2, Color32, RichText, Ui, Visuals};
use egui_plot::{HoverPosition, Line, LineStyle, MarkerShape, Plot, PlotPoint, PlotPoints, PlotUi, Points, Text};

use super::{explain, plot_height, study};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::gestures;
use crate::app::meaning::Explain as _;
use crate::app::series::{self, degrees};
use crate::app::studies::{Known, Shown};
use crate::app::theme;
use crate::compute::protocol::Topic;
use crate::study::Verdict;

/// Draws the diagram and what follows from it.
pub fn ui(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Facts { document, studies, pinned, .. } = facts;
    let share = facts.share();
    let Some(Shown { known, current }) = study(ui, Topic::Polar, studies, commands) else { return };
    explain(
        ui,
        "From the middle outward: the critical speed of a motion through this pose in that direction, right is to the \
         right and up is up. Where the line comes near the middle, the platform must move slowly. The curve breaks \
         where another mode comes first and where there is no critical speed. The worst direction is also on the canvas, as a dashed arrow.",
    );
    let Some((worst, speed)) = series::worst_direction(known) else {
        let none = known.places.iter().flatten().next().is_some();
        ui.weak(if none { "No critical speed in any direction at this pose." } else { "No answer yet." });
        return;
    };
    let all = if known.is_complete() { "" } else { " so far" };
    ui.label(format!("Worst direction{all}: {:.0}°, critical at {} m/s", degrees(worst), digits::like(speed, share)));
    let button = ui.button("Move in the worst direction");
    if button.explained("Sets the direction of the motion").clicked() {
        let mut scenario = document.scenario.clone();
        scenario.motion.direction = worst;
        commands.push(Command::Edit(Box::new(scenario)));
    }
    let size = plot_height(ui, 1).min(ui.available_width());
    let plot = Plot::new("directions")
        .height(size)
        .data_aspect(1.0)
        .show_axes(false)
        .show_grid(false)
        .show_x(false)
        .show_y(false)
        .allow_scroll(false)
        .set_margin_fraction(eframe::egui::Vec2::splat(0.12))
        .label_formatter(move |hover| {
            let (HoverPosition::NearDataPoint { position: point, .. } | HoverPosition::Elsewhere { position: point }) =
                hover;
            let angle = degrees([point.x, point.y]);
            Some(format!("{angle:.0}°\n{} m/s", digits::like(point.x.hypot(point.y), share)))
        });
    let visuals = ui.visuals().clone();
    let today = document.scenario.motion.direction;
    let before = pinned.and_then(|pinned| pinned.study(Topic::Polar));
    let shown = plot.show(ui, |plot| {
        if let Some(before) = before {
            around(plot, before, theme::pinned(&visuals), LineStyle::dashed_dense());
        }
        draw(plot, &visuals, known, current, today, (worst, speed));
    });
    gestures::scrolls_or_turns(&shown.response);
}

fn draw(
    plot: &mut PlotUi<'_>,
    visuals: &Visuals,
    known: &Known,
    current: bool,
    today: [f64; 2],
    (worst, speed): ([f64; 2], f64),
) {
    let verdicts = series::directions(known).into_iter().filter_map(|(_, verdict)| verdict);
    let speeds = verdicts.filter_map(Verdict::critical).map(|critical| critical.speed);
    let largest = speeds.fold(1e-3, f64::max);
    rings(plot, visuals, largest);
    let colour = if current { theme::calm(visuals) } else { visuals.weak_text_color() };
    around(plot, known, colour, LineStyle::Solid);

    let accent = theme::accent(visuals);
    let length = today[0].hypot(today[1]);
    let today = [today[0] / length, today[1] / length];
    let spoke = PlotPoints::from(vec![[0.0, 0.0], at(today, 1.12 * largest)]);
    let spoke = Line::new("", spoke).color(accent).width(2.0).style(LineStyle::dashed_loose());
    plot.line(spoke.allow_hover(false));
    label(plot, at(today, 1.2 * largest), RichText::new("today").size(12.0).color(accent));
    let warning = theme::warning(visuals);
    plot.points(Points::new("", vec![at(worst, speed)]).shape(MarkerShape::Down).radius(8.0).color(warning));
}

fn at([x, y]: [f64; 2], radius: f64) -> [f64; 2] {
    [radius * x, radius * y]
}

/// Once around, stretch by stretch; a direction that stands alone is a point.
fn around(plot: &mut PlotUi<'_>, known: &Known, colour: Color32, style: LineStyle) {
    for stretch in series::around(known) {
        if let [alone] = stretch[..] {
            plot.points(Points::new("", vec![alone]).radius(2.0).color(colour));
        } else {
            plot.line(Line::new("", PlotPoints::from(stretch)).color(colour).width(2.0).style(style));
        }
    }
}

/// Circles of equal speed and spokes every 30°.
fn rings(plot: &mut PlotUi<'_>, visuals: &Visuals, largest: f64) {
    let faint = visuals.weak_text_color().gamma_multiply(0.4);
    let ring =
        |points: Vec<[f64; 2]>| Line::new("", PlotPoints::from(points)).color(faint).width(1.0).allow_hover(false);
    for spoke in 0..12 {
        let (sine, cosine) = (TAU * f64::from(spoke) / 12.0).sin_cos();
        plot.line(ring(vec![[0.0, 0.0], [1.1 * largest * cosine, 1.1 * largest * sine]]));
    }
    let step = crate::app::round::round_step(largest / 4.0);
    for i in 1..=5_u8 {
        let radius = f64::from(i) * step;
        if radius > 1.1 * largest {
            break;
        }
        let point = |k: u8| {
            let (sine, cosine) = (TAU * f64::from(k) / 90.0).sin_cos();
            [radius * cosine, radius * sine]
        };
        plot.line(ring((0..=90).map(point).collect()));
        // Between two spokes, where directions of interest are rare.
        let (sine, cosine) = (TAU * 7.0 / 24.0).sin_cos();
        let text = RichText::new(format!("{radius} m/s")).size(11.0).color(visuals.weak_text_color());
        label(plot, [radius * cosine, radius * sine], text);
    }
}

fn label(plot: &mut PlotUi<'_>, at: [f64; 2], text: RichText) {
    plot.text(Text::new("", PlotPoint::new(at[0], at[1]), text).anchor(Align2::CENTER_CENTER).allow_hover(false));
}
