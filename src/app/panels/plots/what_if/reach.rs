//! The wanted critical speed, and the value that gives it.

use eframe::egui::{Ui, Vec2};

use super::super::common;
use super::numbers::{Number, name};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::number::{Control, Unit};
use crate::app::what_if::WhatIfView;
use crate::compute::protocol::Topic;
use crate::scenario::report::DEFAULT_MAX_SPEED;
use crate::study::reach::together;
use crate::study::{Answer, Reached, Study};

/// The first wanted speed is higher than the present one by this factor, and round.
const MORE: f64 = 1.1;

/// Asks for the wanted speed, and says which value gives it.
pub fn ui(view: &mut WhatIfView, number: &Number, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    if view.target == 0.0 {
        let critical = facts.answers.last_critical().and_then(|answer| answer.critical.as_ref());
        let Some(critical) = critical.filter(|critical| critical.speed > 0.0) else { return };
        let wanted = format!("{:.1e}", MORE * critical.speed).parse().unwrap_or(critical.speed);
        view.target = f64::min(wanted, DEFAULT_MAX_SPEED);
    }
    ui.horizontal_wrapped(|ui| {
        let label = ui.label("Critical speed");
        let label =
            label.explained("Looks for the value, nearest to the present one, at which the critical speed is this one");
        let size = Vec2::new(72.0, ui.spacing().interact_size.y.max(24.0));
        let control = Control { name: "Wanted critical speed", unit: Unit::of("m/s"), step: 0.02, size };
        let mut answer = control.show(ui, view.target);
        answer.response = answer.response.labelled_by(label.id);
        if let Some(value) = answer.value {
            if value > 0.0 && value <= DEFAULT_MAX_SPEED {
                (view.target, view.reaches) = (value, true);
            } else {
                answer.refuse(
                    ui,
                    format!("The wanted critical speed must be more than 0 m/s, at most {DEFAULT_MAX_SPEED} m/s"),
                );
            }
        }
        if !view.reaches {
            let text = format!("Looks for it in the range of {}", name(&number.field));
            if ui.button("Find").explained(text).clicked() {
                view.reaches = true;
            }
        } else if !common::progress_of(ui, Topic::Reach, facts.studies, commands)
            && let Some(reached) = answered(view, number, facts)
        {
            tell(ui, &reached, view.target, number, facts, commands);
        }
    });
}

/// What the study has found, where it is complete and about this.
fn answered(view: &WhatIfView, number: &Number, facts: Facts<'_>) -> Option<Reached> {
    let shown = facts.studies.shown(Topic::Reach).filter(|shown| shown.current && shown.known.is_complete())?;
    let Study::Reach(reach) = &shown.known.request.study else { return None };
    let asked = reach.number.path == number.field.parameter.path() && reach.target.total_cmp(&view.target).is_eq();
    let stretches = shown.known.places.iter().filter_map(|answer| match answer {
        Some(Answer::Reach(stretch)) => Some(stretch),
        _ => None,
    });
    asked.then(|| together(stretches, number.value))
}

/// Says what was found, with a button that takes it.
fn tell(ui: &mut Ui, reached: &Reached, target: f64, number: &Number, facts: Facts<'_>, commands: &mut Vec<Command>) {
    match *reached {
        Reached::Reached(at) => {
            ui.label(format!("{} gives {:.3} m/s", number.text(at.value), at.speed));
            // One that has been taken is there.
            if at.value.total_cmp(&number.value).is_ne()
                && ui.button("Take it").explained(format!("Sets {}", name(&number.field))).clicked()
            {
                let mut scenario = facts.document.scenario.clone();
                number.field.parameter.set(&mut scenario, at.value);
                commands.push(Command::Edit(Box::new(scenario)));
            }
        }
        Reached::NotReached { below, above } => {
            let [from, to] = number.range.ends.map(|end| number.text(end));
            let nearest = below.into_iter().chain(above).min_by(|a, b| {
                let away = |speed: f64| (speed - target).abs();
                away(a.speed).total_cmp(&away(b.speed))
            });
            let best = nearest.map_or_else(
                || "no value there has a critical speed".into(),
                |at| {
                    let speed = digits::certain(at.speed, Some(5e-4 * at.speed));
                    format!("the nearest is {speed} m/s at {}", number.text(at.value))
                },
            );
            // Both sides are there: the speed leaps over the wanted one, or is not known in between.
            let leaps = if below.is_some() && above.is_some() { " It jumps across." } else { "" };
            let target = digits::certain(target, Some(5e-4 * target));
            ui.label(format!("No value between {from} and {to} reaches {target} m/s; {best}.{leaps}"));
        }
    }
}
