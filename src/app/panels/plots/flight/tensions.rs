//! The tensions of all cables at the platform in a flight, against time.

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
use crate::app::series::tensions;

/// What the plot shows, in plain words.
pub fn meaning(facts: Facts<'_>) -> String {
    let flight = time::flown(facts).ok().filter(|flown| flown.current).map(|Flown { flight, .. }| flight);
    let finding = flight.map_or_else(String::new, |flight| {
        let spans: Vec<String> = tensions(flight)
            .iter()
            .enumerate()
            .map(|(i, line)| {
                let values = || line.iter().map(|point| point[1]);
                let [low, high] = [values().fold(f64::INFINITY, f64::min), values().fold(0.0, f64::max)];
                format!("cable {} from {} to {} N", i + 1, digits::certain(low, None), digits::certain(high, None))
            })
            .collect();
        format!(" In this flight: {}.", spans.join(", "))
    });
    signed(&format!(
        "How hard every cable pulls at the platform during the flight. Swings come on top of the slow change that the path \
         asks for. A cable whose element would have to push is slack: the model lets it push, and from there on the flight \
         is doubtful. That happens by hard starts and stops, long before any vibration grows by itself.{finding}"
    ))
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
    let lines = tensions(flown.flight);
    let values = lines.iter().flatten().map(|point| point[1]).chain(std::iter::once(0.0));
    let mut fit = flown.bounds(values);
    fit[1][0] = fit[1][0].min(0.0);
    let mut chart = time::chart(ui, place, response.rect, flown, fit, "tension at the platform, N");
    let tokens = chart.tokens;
    let slack = flown.flight.slack.map(|slack| slack.cable);
    let colours = |cable: usize| match (flown.current, slack == Some(cable)) {
        (false, _) => (tokens.mute, tokens.weak),
        (true, true) => (tokens.critical, tokens.critical),
        (true, false) => (tokens.text, tokens.text),
    };
    for (cable, line) in lines.iter().enumerate() {
        chart.curve(line, Stroke::new(1.75, colours(cable).0), Dash::Pattern(cable));
    }
    for (cable, line) in lines.iter().enumerate() {
        label_curve(&mut chart, &(cable + 1).to_string(), colours(cable).1, std::slice::from_ref(line));
    }
    time::events(&mut chart, flown, now);
    chart.finish();
    range::turn(ui, &response, place.id(), [chart.x, chart.y], fit, place.turning([true, true]));
    let pointer = response.hover_pos().filter(|_| !response.dragged());
    flown.reading(&chart, pointer, |sample| {
        let each: Vec<String> = sample
            .cables
            .iter()
            .enumerate()
            .map(|(i, cable)| format!("{}: {} N", i + 1, signed(&digits::certain(cable.tension, None))))
            .collect();
        (sample.cables.iter().map(|cable| cable.tension).fold(0.0, f64::max), each)
    });
    response.widget_info(|| {
        let text = format!("Tensions: the tension of each cable against the time of the flight. {}", flown.told());
        WidgetInfo::labeled(Role::Image, true, signed(&text))
    });
}
