//! The critical speed against any number of the robot, or against two as a map, and the value at which it is the wanted one.

mod curve;
mod drawing;
mod map;
mod numbers;
mod reach;

use eframe::egui::Ui;

use super::common::{self, PlotPlace, Slot};
use super::range::VisibleRange;
use super::sensitivities;
use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::what_if::{Range, WhatIfView};
use crate::compute::protocol::Topic;
use crate::scenario::Parameter;
use crate::study::Study;
use numbers::Number;

/// What the plot shows, in plain words.
pub const MEANING: &str = "One number of the robot takes other values, and all others stay: above, the critical speed at this \
    pose and in this direction; below, the frequency with which stability is lost. The upper curve breaks where it jumps. \
    Hatched values have no equilibrium, or are not allowed. The dashed line is the present value; a click sets another one. \
    The ends of the range can be typed, or dragged at the handles; Fit puts the range around the present value again. \
    Against a second number the plot is a map, whose cross is the present pair. Find looks for the value, nearest to the \
    present one, at which the critical speed is the wanted one; a jump across it does not count.";

/// Draws the plot with what it is asked.
pub fn ui(place: PlotPlace, view: &mut WhatIfView, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    prepare(place, view, ui, facts);
    let scenario = &facts.document.scenario;
    let controls = place.slot != Slot::Picture;
    if controls {
        numbers::choose(view, ui, facts);
    }
    // Whatever has just been chosen has a range from the next frame on.
    let numbers: Option<Vec<Number>> = view
        .numbers(scenario)
        .into_iter()
        .map(|number| Some(Number::new(number, view.range(number)?, facts)))
        .collect();
    let Some(numbers) = numbers else { return ui.ctx().request_repaint() };
    let Some(first) = numbers.first() else { return };
    if controls && numbers.len() == 1 && !first.field.integer {
        reach::ui(view, first, ui, facts, commands);
    }
    // A study of other numbers is no answer to this question.
    let paths: Vec<String> = numbers.iter().map(|number| number.field.parameter.path()).collect();
    let shown = common::study(Topic::WhatIf, facts).filter(|shown| match &shown.known.request.study {
        Study::WhatIf(what_if) => what_if.numbers.iter().map(|number| &number.path).eq(&paths),
        _ => false,
    });
    let Some(shown) = shown else {
        common::say(ui, "No answer yet.");
        return;
    };
    match &numbers[..] {
        [number] => curve::ui(place, view, number, shown, ui, facts, commands),
        [first, second] => map::ui([first, second], shown, ui, facts, commands),
        _ => {}
    }
}

/// Sees to it that there is a number with a range, and takes ranges back where Fit was pressed.
fn prepare(place: PlotPlace, view: &mut WhatIfView, ui: &Ui, facts: Facts<'_>) {
    let scenario = &facts.document.scenario;
    let all = numbers::all(scenario);
    if view.number.is_none_or(|number| !all.contains(&number)) {
        view.choose(most_sensitive(facts).filter(|number| all.contains(number)).unwrap_or(Parameter::YoungsModulus));
    }
    view.against = view.against.filter(|number| all.contains(number) && view.number != Some(*number));
    let fit_pressed = ui.data(|data| data.get_temp::<VisibleRange>(place.id())) == Some(VisibleRange::Fit);
    let mut own = false;
    for number in view.numbers(scenario) {
        if fit_pressed {
            view.forget(number);
        }
        let range = view.range(number).unwrap_or_else(|| {
            let ends = numbers::usual_range(number, facts);
            Range { ends, own: false }
        });
        view.set_range(number, range);
        let now = number.get(scenario);
        own |= range.own || !(range.ends[0]..=range.ends[1]).contains(&now);
    }
    // The header shows Fit as chosen where nothing is remembered here.
    ui.data_mut(|data| {
        if own {
            data.insert_temp(place.id(), VisibleRange::All);
        } else {
            data.remove::<VisibleRange>(place.id());
        }
    });
}

/// The number with the largest sensitivity of the critical speed, where that is known.
fn most_sensitive(facts: Facts<'_>) -> Option<Parameter> {
    let (found, _) = facts.answers.sensitivities()?;
    let largest = found.as_ref().ok()?.iter().max_by(|a, b| a.speed.abs().total_cmp(&b.speed.abs()))?;
    Some(sensitivities::control(largest.knob, &facts.document.scenario))
}
