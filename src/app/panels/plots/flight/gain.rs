//! The gain of the move against its peak speed, with what frozen time predicts beside it.

use eframe::egui::{Pos2, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};

use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::panels::plots::axis::{Axis, signed};
use crate::app::panels::plots::chart::{Chart, Dash, Symbol, Titles, inner};
use crate::app::panels::plots::common::{self, PlotPlace};
use crate::app::panels::plots::line::label_curve;
use crate::app::panels::plots::range::{self, VisibleRange};
use crate::app::round::roundest;
use crate::app::series::Gains;
use crate::compute::protocol::Topic;

/// Gains beyond these tell nothing: far above the wave limit they depend on the mesh.
const DRAWN: [f64; 2] = [0.02, 20.0];

/// What the plot shows, in plain words.
pub fn meaning(facts: Facts<'_>) -> String {
    let gains = gains(facts).filter(|(_, current)| *current).map(|(gains, _)| gains);
    let finding = gains.and_then(|gains| gains.finding()).map_or_else(String::new, |finding| format!(" {finding}"));
    signed(&format!(
        "The same path with the same profile, passed at several peak speeds. The whole line is the gain: how many times \
         larger any small vibration can be after the move than before it. The dashed line is what frozen time says, \
         exp of the sum of max Re λ over time. The two can be far apart: for the paper's robot without damping, frozen time calls every speed \
         unstable, yet at a peak of 2 m/s nothing ends more than 0.1 % larger. The gain is a number and no verdict. Right of \
         the dotted line a winch reels faster than waves run: growth has no bound there, and figures depend on the \
         mesh.{finding} Click to set the peak speed."
    ))
}

/// What is known, and whether it is of the document as it is.
fn gains(facts: Facts<'_>) -> Option<(Gains, bool)> {
    let shown = facts.studies.shown(Topic::Gains).filter(|shown| shown.known.answered() > 0)?;
    Some((Gains::new(shown.known)?, shown.current))
}

/// Draws the plot.
pub fn ui(place: PlotPlace, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    if super::trajectory(ui, facts, commands).is_none() {
        return;
    }
    let Some((gains, current)) = gains(facts) else {
        return common::say(ui, "The gains of this move are being computed.");
    };
    let Some(path) = &facts.document.scenario.path else { return };
    let (real, frozen) = (gains.real(), gains.frozen());
    if real.is_empty() && frozen.is_empty() {
        return common::say(ui, "This move has no gain: at one of its ends the robot does not resist every push.");
    }
    let response = ui.allocate_rect(ui.available_rect_before_wrap(), Sense::click_and_drag());
    let outer = response.rect;
    let titles = Titles { x: Some("peak speed, m/s"), x_unit: None, y: Some("vibration after / before") };
    let rect = inner(ui, outer, titles);
    let fit = bounds(&gains);
    let [x, y] = VisibleRange::of(ui.ctx(), place.id()).bounds(fit, fit);
    let y = Axis { range: y, ends: [rect.bottom(), rect.top()], logarithmic: true };
    let x = Axis::linear(x, [rect.left(), rect.right()]);
    let mut chart = Chart::new(ui, outer, rect, [x, y]);
    let tokens = chart.tokens;
    let shade = |colour| if current { colour } else { tokens.mute };
    let words = |colour| if current { colour } else { tokens.weak };
    let limit = gains.at_the_wave_limit();
    if let Some(limit) = limit {
        chart.band([limit, f64::MAX], true, tokens.field);
    }
    chart.grid(titles);
    chart.level(1.0, Stroke::new(1.5, shade(tokens.frame)), Dash::Solid);
    let left = rect.left() + 4.0;
    let one = chart.y.pos(1.0);
    if rect.y_range().contains(one) {
        let at = Pos2::new(left, one);
        chart.label_at("larger", tokens.weak, at - Vec2::new(0.0, 3.0), eframe::egui::Align2::LEFT_BOTTOM);
        chart.label_at("smaller", tokens.weak, at + Vec2::new(0.0, 3.0), eframe::egui::Align2::LEFT_TOP);
    }
    for run in &frozen {
        chart.curve(run, Stroke::new(1.75, shade(tokens.critical)), Dash::Pattern(1));
    }
    for run in &real {
        chart.curve(run, Stroke::new(2.25, shade(tokens.stable)), Dash::Solid);
        for &point in run {
            chart.mark(chart.pos(point), Symbol::Dot, 2.5, shade(tokens.stable));
        }
    }
    if let Some(limit) = limit {
        chart.upright(limit, Stroke::new(1.75, shade(tokens.waves)), Dash::Dotted);
        let at = chart.x.pos(limit);
        let spots = [0.85, 0.6, 0.2].map(|part| Pos2::new(at, rect.top() + part * rect.height()));
        chart.label("wave limit", words(tokens.waves), &spots);
    }
    let now = path.speed;
    chart.upright(now, Stroke::new(1.5, tokens.accent), Dash::Dashed);
    let spot = Pos2::new(chart.x.pos(now), rect.top() + 12.0);
    chart.label(format!("peak {now:.2}"), tokens.accent, &[spot, spot + Vec2::new(0.0, 22.0)]);
    label_curve(&mut chart, "gain", words(tokens.stable), &real);
    label_curve(&mut chart, "frozen", words(tokens.critical), &frozen);
    chart.finish();
    range::turn(ui, &response, place.id(), [x, y], fit, place.turning([true, false]));

    let nearest = |pointer: Pos2| gains.nearest(x.value(pointer.x));
    if let Some(pointer) = response.hover_pos().filter(|_| !response.dragged())
        && let Some(point) = nearest(pointer)
    {
        let value = point.gain.or(point.frozen).unwrap_or(1.0);
        let at = chart.pos([point.speed, value]);
        chart.mark(at, Symbol::Ring, 5.0, tokens.text);
        chart.card(at, &lines(&point));
    }
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.clicked()) {
        let mut scenario = facts.document.scenario.clone();
        if let Some(path) = &mut scenario.path {
            path.speed = roundest(x.value(pointer.x).clamp(fit[0][0], fit[0][1]), x.per_point());
        }
        commands.push(Command::Edit(Box::new(scenario)));
    }
    response.widget_info(|| {
        let here = gains.nearest(now).map_or_else(String::new, |point| lines(&point).join(", "));
        let finding = gains.finding().unwrap_or_default();
        let text = format!("Gain of the move against its peak speed. Near the present one: {here}. {finding}");
        WidgetInfo::labeled(Role::Image, true, signed(&text))
    });
}

/// What is known at one peak speed, line by line.
fn lines(point: &crate::app::series::GainPoint) -> Vec<String> {
    let times = |value: f64| format!("× {}", digits::certain(value, None));
    let mut lines = vec![format!("peak {} m/s", digits::certain(point.speed, None))];
    lines.push(point.gain.map_or_else(|| "gain not known".into(), |gain| format!("gain {}", times(gain))));
    lines.extend(point.frozen.map(|frozen| format!("frozen time says {}", times(frozen))));
    lines.extend(point.ratio.map(|ratio| format!("{:.0} % of the wave limit", 100.0 * ratio)));
    lines
}

/// What the plot spans: all speeds, and the gains that tell something.
fn bounds(gains: &Gains) -> [[f64; 2]; 2] {
    let values = || {
        let all = gains.points.iter().flat_map(|point| [point.gain, point.frozen]).flatten();
        all.filter(|value| *value > 0.0).map(|value| value.clamp(DRAWN[0], DRAWN[1]))
    };
    let [low, high] = [values().fold(1.0, f64::min), values().fold(1.0, f64::max)];
    [[0.0, gains.highest()], [0.7 * low, 1.6 * high]]
}
