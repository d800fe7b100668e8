//! What plots against the time of a flight have in common: the flight on show, the stop, slack, and now.

use eframe::egui::{Pos2, Rect, Stroke, Ui, Vec2};

use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::panels::plots::axis::signed;
use crate::app::panels::plots::chart::{Chart, Dash, Titles, inner};
use crate::app::panels::plots::common::PlotPlace;
use crate::app::panels::plots::range::VisibleRange;
use crate::app::series::nearest_sample;
use crate::compute::protocol::Topic;
use crate::flight::{Flight, Sample};
use crate::study::Answer;

/// A flight, and whether it is the document's as it is.
#[derive(Clone, Copy)]
pub struct Flown<'a> {
    /// The flight.
    pub flight: &'a Flight,
    /// Whether nothing has changed since.
    pub current: bool,
}

/// The flight on show, or why there is none.
pub fn flown(facts: Facts<'_>) -> Result<Flown<'_>, String> {
    let shown = facts.studies.shown(Topic::Flight).filter(|shown| shown.known.answered() > 0);
    match shown.and_then(|shown| Some((shown.known.places.first()?.as_ref()?, shown.current))) {
        Some((Answer::Flight(flight), current)) => match &**flight {
            Ok(flown) => Ok(Flown { flight: &flown.flight, current }),
            Err(reason) => Err(signed(&format!("There is no flight: {reason}."))),
        },
        _ => Err("The flight is being computed.".into()),
    }
}

impl Flown<'_> {
    /// What a plot of it spans: the time, and the values from low to high with some room.
    pub fn bounds(self, values: impl Iterator<Item = f64>) -> [[f64; 2]; 2] {
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let [low, high] = if low < high { [low, high] } else { [-1.0, 1.0] };
        let room = 0.1 * (high - low);
        [[0.0, self.flight.end.max(f64::MIN_POSITIVE)], [low - room, high + room]]
    }

    /// The time and what is to be read there: `lines` of the sample that is nearest to the pointer.
    pub fn reading(self, chart: &Chart, pointer: Option<Pos2>, at: impl Fn(&Sample) -> (f64, Vec<String>)) {
        let Some(pointer) = pointer.filter(|pointer| chart.rect.expand(4.0).contains(*pointer)) else { return };
        let Some(sample) = nearest_sample(self.flight, chart.x.value(pointer.x)) else { return };
        let (value, mut lines) = at(sample);
        lines.insert(0, format!("{:.2} s, {} m on the path", sample.time, digits::certain(sample.s, None)));
        let place = chart.pos([sample.time, value]);
        let line = [Pos2::new(place.x, chart.rect.top()), Pos2::new(place.x, chart.rect.bottom())];
        chart.painter.line_segment(line, Stroke::new(1.0, chart.tokens.mute));
        chart.card(place, &lines);
    }

    /// Slack and the stop in a sentence.
    pub fn told(self) -> String {
        let Flight { slack, duration, lost, .. } = self.flight;
        let slack = slack.map_or_else(
            || "No cable goes slack.".to_owned(),
            |slack| format!("Cable {} goes slack at {:.2} s: doubtful from there.", slack.cable + 1, slack.time),
        );
        let lost = lost.map_or_else(String::new, |time| format!(" The computation could not go on after {time:.2} s."));
        format!("The move takes {duration:.2} s. {slack}{lost}")
    }
}

/// A chart over the time of a flight on a grid, with what is after the stop on another ground.
pub fn chart(ui: &Ui, place: PlotPlace, outer: Rect, flown: Flown<'_>, fit: [[f64; 2]; 2], y: &str) -> Chart {
    let titles = Titles { x: Some("time, s"), x_unit: None, y: Some(y) };
    let rect = inner(ui, outer, titles);
    let axes = Chart::axes(rect, VisibleRange::of(ui.ctx(), place.id()).bounds(fit, fit));
    let chart = Chart::new(ui, outer, rect, axes);
    let Flight { duration, end, .. } = *flown.flight;
    if end > duration {
        chart.band([duration, end], true, chart.tokens.field);
    }
    chart.grid(titles);
    chart
}

/// Marks what happens in a flight: when the first cable is slack, when the platform stops, and the time now.
pub fn events(chart: &mut Chart, flown: Flown<'_>, now: Option<f64>) {
    let tokens = chart.tokens;
    let shade = |colour| if flown.current { colour } else { tokens.mute };
    let words = |colour| if flown.current { colour } else { tokens.weak };
    let Flight { duration, end, slack, lost, .. } = *flown.flight;
    let top = chart.rect.top() + 10.0;
    if end > duration {
        let middle = 0.5 * (chart.x.pos(duration) + chart.x.pos(end));
        chart.label("after stop", tokens.weak, &[Pos2::new(middle, top - 14.0), Pos2::new(middle, top)]);
    }
    if let Some(slack) = slack {
        chart.upright(slack.time, Stroke::new(1.75, shade(tokens.critical)), Dash::Solid);
        let x = chart.x.pos(slack.time);
        let spots = [0.93, 0.5, 0.1].map(|part| Pos2::new(x, chart.rect.top() + part * chart.rect.height()));
        chart.label(format!("cable {} slack", slack.cable + 1), words(tokens.critical), &spots);
    }
    if let Some(time) = lost {
        chart.upright(time, Stroke::new(1.75, shade(tokens.critical)), Dash::Dotted);
        let spot = Pos2::new(chart.x.pos(time), chart.rect.center().y);
        chart.label("computed up to here", words(tokens.critical), &[spot, spot - Vec2::new(40.0, 0.0)]);
    }
    if let Some(now) = now.filter(|now| *now <= end) {
        chart.upright(now, Stroke::new(1.5, tokens.accent), Dash::Dashed);
    }
}
