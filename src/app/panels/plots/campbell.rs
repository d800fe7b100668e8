//! Frequencies and growth rates of all modes against speed: the speed diagram, which engineers call Campbell's.

use std::f64::consts::TAU;

use eframe::egui::{Pos2, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};
use nalgebra::Complex;

use super::axis::signed;
use super::chart::{Chart, Dash, Symbol, Titles, inner};
use super::common::{self, PlotPlace, Slot};
use super::range::{self, VisibleRange};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::number::{self, Control, Unit};
use crate::app::round::roundest;
use crate::app::series::{self, Piece};
use crate::app::studies::Shown;
use crate::compute::protocol::Topic;

/// What the plot shows, in plain words.
pub const MEANING: &str = "Every line is a mode of the robot at this pose. Above: how its frequency changes as the platform \
    moves faster; below: how fast it grows (above zero) or dies away (below). Thin lines are stable, thick ones with ▲ grow. \
    The first mode to become thick is the one that sets the critical speed. Click to set the speed. Engineers call this \
    Campbell's diagram.";

/// Two plots one above the other are at least so high together, in points.
const LEAST: f32 = 240.0;

/// Draws the two plots; a click sets the speed.
pub fn ui(place: PlotPlace, highest: &mut f64, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Facts { joined, settings, .. } = facts;
    let Some(Shown { known, current }) = common::study(Topic::Campbell, facts) else {
        common::say(ui, "No answer yet.");
        return;
    };
    let ids = [place.id(), place.id().with("growth")];
    let (drawn, width) = (*highest, ui.available_width());
    let slider = |ui: &mut Ui, highest: &mut f64| {
        // Beside the number and its name.
        ui.spacing_mut().slider_width = (width - 220.0).clamp(36.0, 120.0);
        let unit = Unit::of_hertz(settings.hertz().1);
        let step = 0.01 * unit.shown(*highest);
        let size = Vec2::new(70.0, ui.spacing().interact_size.y);
        let control = Control { name: "Highest frequency", unit, step, size };
        let meaning = "Modes with higher frequencies are not drawn.";
        number::slider(ui, &control, meaning, highest, [0.5, 100.0].map(|end| unit.shown(end)));
    };
    if place.slot != Slot::Picture {
        ui.horizontal(|ui| slider(ui, highest));
    }
    // Whoever turns the range wants to see it.
    if drawn.to_bits() != highest.to_bits() {
        for id in ids {
            VisibleRange::Fit.show(ui.ctx(), id);
        }
    }
    let pieces = joined.pieces();
    if pieces.is_empty() {
        let ended = known.is_complete() && !joined.is_working();
        common::say(ui, if ended { "No eigenvalues at this pose." } else { "No answer yet." });
        return;
    }
    let (hertz, unit) = settings.hertz();
    let room = ui.available_rect_before_wrap();
    // As wide as before the slider, whatever that takes.
    let room = Rect::from_min_size(room.min, Vec2::new(width, room.height().max(LEAST)));
    let half = room.top() + 0.5 * room.height();
    let frequency = format!("frequency, {unit}");
    let speeds = [0.0, pieces.iter().flat_map(|piece| &piece.points).map(|(speed, _)| *speed).fold(1.0, f64::max)];
    let plots = [
        Diagram {
            rect: room.with_max_y(half),
            titles: Titles { x: None, x_unit: Some("m/s"), y: Some(&frequency) },
            fit: [speeds, [0.0, *highest * hertz]],
            hertz: Some(hertz),
            unit,
        },
        Diagram {
            rect: room.with_min_y(half),
            titles: Titles { x: Some("speed, m/s"), x_unit: None, y: Some("growth rate, 1/s") },
            fit: [speeds, growth_range(pieces)],
            hertz: None,
            unit: "1/s",
        },
    ];
    // Both have one horizontal axis, whichever was turned.
    let before = ids.map(|id| VisibleRange::of(ui.ctx(), id));
    if before[0] == VisibleRange::Fit && before[1] != VisibleRange::Fit {
        VisibleRange::Fit.show(ui.ctx(), ids[1]);
    }
    for (i, diagram) in plots.iter().enumerate() {
        let range = VisibleRange::of(ui.ctx(), ids[i]);
        diagram.ui(place, ids[i], ui, facts, current, commands);
        let after = VisibleRange::of(ui.ctx(), ids[i]);
        if after == range {
            continue;
        }
        let (other, fit) = (1 - i, plots[1 - i].fit);
        let [x, _] = after.bounds(diagram.fit, diagram.fit);
        let [_, y] = VisibleRange::of(ui.ctx(), ids[other]).bounds(fit, fit);
        let linked = if after == VisibleRange::Fit { VisibleRange::Fit } else { VisibleRange::Own([x, y]) };
        linked.show(ui.ctx(), ids[other]);
    }
}

/// One of the two plots.
struct Diagram<'a> {
    rect: Rect,
    titles: Titles<'a>,
    fit: [[f64; 2]; 2],
    /// What one hertz is, where it shows frequencies; else it shows growth rates.
    hertz: Option<f64>,
    unit: &'a str,
}

impl Diagram<'_> {
    fn value(&self, eigenvalue: Complex<f64>) -> f64 {
        self.hertz.map_or(eigenvalue.re, |hertz| eigenvalue.im / TAU * hertz)
    }

    fn ui(
        &self,
        place: PlotPlace,
        id: eframe::egui::Id,
        ui: &mut Ui,
        facts: Facts<'_>,
        current: bool,
        commands: &mut Vec<Command>,
    ) {
        let Facts { document, answers, joined, designs, .. } = facts;
        let (pieces, growth) = (joined.pieces(), self.hertz.is_none());
        let response = ui.allocate_rect(self.rect, Sense::click_and_drag());
        let rect = inner(ui, self.rect, self.titles);
        let axes = Chart::axes(rect, VisibleRange::of(ui.ctx(), id).bounds(self.fit, self.fit));
        let mut chart = Chart::new(ui, self.rect, rect, axes);
        let tokens = chart.tokens;
        let shade = |colour| if current { colour } else { tokens.mute };
        let words = |colour| if current { colour } else { tokens.weak };
        if growth {
            chart.band([0.0, f64::MAX], false, if current { tokens.critical_fill } else { tokens.field });
        }
        chart.grid(self.titles);
        if growth {
            chart.level(0.0, Stroke::new(1.5, shade(tokens.critical)), Dash::Solid);
        }
        for piece in pieces {
            let points: Vec<[f64; 2]> =
                piece.points.iter().map(|&(speed, eigenvalue)| [speed, self.value(eigenvalue)]).collect();
            if piece.unstable {
                chart.curve(&points, Stroke::new(3.0, shade(tokens.critical)), Dash::Solid);
                // Few enough to be seen one by one.
                for &point in points.iter().skip(1).step_by(4) {
                    chart.mark(chart.pos(point), Symbol::Triangle, 4.0, shade(tokens.critical));
                }
            } else {
                chart.curve(&points, Stroke::new(1.2, shade(tokens.stable)), Dash::Solid);
            }
        }
        for (letter, design) in designs.shown() {
            let colour = letter.colour(ui.visuals());
            for (speed, eigenvalue) in design.study(Topic::Campbell).map(series::spectra).unwrap_or_default() {
                let at = chart.pos([speed, self.value(eigenvalue)]);
                if rect.contains(at) {
                    chart.painter.circle_filled(at, 1.2, colour);
                }
            }
            if let Some(critical) = design.critical() {
                chart.upright(critical.speed, Stroke::new(1.5, colour), Dash::Design(letter));
                let spot = Pos2::new(chart.x.pos(critical.speed), rect.bottom() - 12.0);
                chart.label(letter.name(), colour, &[spot, spot - Vec2::new(0.0, 18.0)]);
            }
        }
        let critical = answers.last_critical().and_then(|answer| answer.critical.as_ref());
        let top = rect.top() + 12.0;
        if let Some(critical) = critical {
            chart.upright(critical.speed, Stroke::new(2.0, shade(tokens.critical)), Dash::Solid);
            let spot = Pos2::new(chart.x.pos(critical.speed), top);
            chart.label(format!("critical {}", common::speed(facts, critical)), words(tokens.critical), &[spot]);
        }
        let now = document.scenario.motion.speed;
        chart.upright(now, Stroke::new(1.5, tokens.accent), Dash::Dashed);
        let spot = Pos2::new(chart.x.pos(now), top);
        chart.label(format!("now {now:.2}"), tokens.accent, &[spot, spot + Vec2::new(0.0, 22.0)]);
        chart.finish();
        range::turn(ui, &response, id, axes, self.fit, place.turning([true, true]));

        if let Some(pointer) = response.hover_pos().filter(|_| !response.dragged()) {
            let nearest = pieces
                .iter()
                .flat_map(|piece| &piece.points)
                .map(|&(speed, eigenvalue)| (chart.pos([speed, self.value(eigenvalue)]), speed, eigenvalue))
                .min_by(|a, b| a.0.distance(pointer).total_cmp(&b.0.distance(pointer)))
                .filter(|(at, ..)| at.distance(pointer) < 30.0);
            if let Some((at, speed, eigenvalue)) = nearest {
                let value = signed(&digits::certain(self.value(eigenvalue), None));
                let how = if eigenvalue.re > 0.0 { "grows" } else { "dies out" };
                chart.mark(at, Symbol::Ring, 5.0, tokens.text);
                chart.card(at, &[format!("{value} {}", self.unit), format!("at {speed:.2} m/s, {how}")]);
            }
        }
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, self.told(facts)));
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.clicked()) {
            let mut scenario = document.scenario.clone();
            scenario.motion.speed = roundest(chart.x.value(pointer.x).max(0.0), chart.x.per_point()).max(0.0);
            commands.push(Command::Edit(Box::new(scenario)));
        }
    }

    /// The plot in a sentence, for those who do not see it.
    fn told(&self, Facts { joined, document, answers, .. }: Facts<'_>) -> String {
        let what = if self.hertz.is_some() { "frequencies" } else { "growth rates" };
        let first = joined.pieces().iter().filter(|piece| piece.unstable).filter_map(|piece| piece.points.first());
        let first = first.min_by(|a, b| a.0.total_cmp(&b.0));
        let grows = first.map_or_else(
            || "none grows".to_owned(),
            |(speed, _)| format!("the first begins to grow at {} m/s", digits::certain(*speed, None)),
        );
        let now = document.scenario.motion.speed;
        let kept = if answers.pose_failed() { " They belong to an earlier pose." } else { "" };
        format!("Speed diagram: {what} of all modes against speed, {grows}; now {now:.2} m/s.{kept}")
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
