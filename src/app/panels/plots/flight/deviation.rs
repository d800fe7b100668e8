//! How far the platform is off its path in a flight, against time.

use eframe::egui::{Role, Sense, Stroke, Ui, WidgetInfo};

use super::time::{self, Flown};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::panels::plots::axis::signed;
use crate::app::panels::plots::chart::Dash;
use crate::app::panels::plots::common::{self, PlotPlace};
use crate::app::panels::plots::line::label_curve;
use crate::app::panels::plots::range;
use crate::app::series::{envelope, kept_within, wobble};

/// What the plot shows, in plain words.
pub fn meaning(facts: Facts<'_>) -> String {
    let flight = time::flown(facts).ok().filter(|flown| flown.current).map(|Flown { flight, .. }| flight);
    let finding = flight.map_or_else(String::new, |flight| {
        let moving = digits::certain(1e3 * flight.max_deviation, None);
        let after = flight.residual.map_or_else(String::new, |residual| {
            format!(" After the stop it is off by {} mm at most.", digits::certain(1e3 * residual, None))
        });
        let slack = flight.slack.map_or_else(String::new, |slack| {
            format!(
                " Cable {} goes slack at {:.2} s. The model lets it push from there on, so nothing later can be relied on.",
                slack.cable + 1,
                slack.time
            )
        });
        format!(" This flight is off its path by {moving} mm at most.{after}{slack}")
    });
    format!(
        "The winches reel as if platform and cables moved without any swing. This is how far off the platform really is: \
         its inertia, and that of the cables, set it swinging. Along x with a whole line, along y with a dashed one; after \
         the stop it swings freely. After a kick, the dotted lines are what frozen time predicts: the first swing times \
         exp of the sum of max Re λ over time. Vibrations often stay far within these lines, since frozen time takes the energy that reeling \
         in feeds to a cable for growth.{finding}"
    )
}

/// Draws the plot.
pub fn ui(place: PlotPlace, now: Option<f64>, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    if super::trajectory(ui, facts, commands).is_none() {
        return;
    }
    let flown = match time::flown(facts) {
        Ok(flown) => flown,
        Err(reason) => return common::say(ui, &reason),
    };
    let response = ui.allocate_rect(ui.available_rect_before_wrap(), Sense::click_and_drag());
    let samples = &flown.flight.samples;
    let along = |axis: usize| -> Vec<[f64; 2]> {
        samples.iter().map(|sample| [sample.time, 1e3 * sample.deviation[axis]]).collect()
    };
    let [x, y] = [along(0), along(1)];
    let values = x.iter().chain(&y).map(|point| point[1]);
    let fit = flown.bounds(values);
    let mut chart = time::chart(ui, place, response.rect, flown, fit, "deviation, mm");
    let tokens = chart.tokens;
    let shade = |colour| if flown.current { colour } else { tokens.mute };
    let words = |colour| if flown.current { colour } else { tokens.weak };
    chart.level(0.0, Stroke::new(1.0, tokens.frame), Dash::Solid);
    for sign in [1.0, -1.0] {
        let frozen = envelope(facts, flown.flight, sign);
        chart.curve(&kept_within(&frozen, fit[1]), Stroke::new(1.5, shade(tokens.critical)), Dash::Dotted);
        if sign > 0.0 && frozen.len() > 1 {
            label_curve(&mut chart, "frozen", words(tokens.critical), &[kept_within(&frozen, fit[1])]);
        }
    }
    chart.curve(&y, Stroke::new(2.0, shade(tokens.stable)), Dash::Pattern(1));
    chart.curve(&x, Stroke::new(2.25, shade(tokens.accent)), Dash::Solid);
    label_curve(&mut chart, "along x", words(tokens.accent), std::slice::from_ref(&x));
    label_curve(&mut chart, "along y", words(tokens.stable), std::slice::from_ref(&y));
    time::events(&mut chart, flown, now);
    chart.finish();
    range::turn(ui, &response, place.id(), [chart.x, chart.y], fit, place.turning([true, true]));
    let pointer = response.hover_pos().filter(|_| !response.dragged());
    flown.reading(&chart, pointer, |sample| {
        let [x, y] = [0, 1].map(|axis| signed(&digits::certain(1e3 * sample.deviation[axis], None)));
        (1e3 * sample.deviation[0], vec![format!("{x} mm along x, {y} mm along y")])
    });
    response.widget_info(|| {
        let text = format!("Deviation: {} {}", wobble(flown.flight), flown.told());
        WidgetInfo::labeled(Role::Image, true, signed(&text))
    });
}
