//! The fastest move along the path that the machine's limits allow, and what can be done with it.

use eframe::egui::{Grid, Label, RichText, Ui, Vec2};

use crate::app::command::Command;
use crate::app::digits;
use crate::app::export::Content;
use crate::app::facts::Facts;
use crate::app::limits::{Below, LimitsAsked};
use crate::app::meaning::Explain as _;
use crate::app::number::{Control, Unit};
use crate::app::panels::plots::progress_of;
use crate::app::series::fastest;
use crate::compute::protocol::Topic;
use crate::flight::FastestMove;
use crate::scenario::{Path, ProfileKind};
use crate::study::Fastest;

/// Rows of the table on the screen; the file has all of them.
const ROWS: usize = 9;

/// Draws what is asked and what comes of it.
pub fn ui(asked: &mut LimitsAsked, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let Some(path) = &facts.document.scenario.path else {
        ui.label("There is no path yet: this is about a move along one.");
        if ui.button("Add a path").clicked() {
            commands.push(Command::AddPath);
        }
        return;
    };
    ui.add(
        Label::new(
            "The shortest time from rest to rest on this path within these limits. A limit that is switched off does not act.",
        )
        .wrap(),
    );
    ui.add_space(6.0);
    limits(asked, ui);
    ui.separator();
    if progress_of(ui, Topic::Path, facts.studies, commands) || progress_of(ui, Topic::Allowed, facts.studies, commands)
    {
        return;
    }
    match fastest(facts) {
        None => {
            ui.weak("It is being computed.");
        }
        Some((Err(reason), _)) => {
            ui.add(Label::new(format!("There is no such move: {reason}.").replace('-', "−")).wrap());
        }
        Some((Ok(found), current)) => result(found, current, path, ui, facts, commands),
    }
}

/// The limits as numbers to type.
fn limits(asked: &mut LimitsAsked, ui: &mut Ui) {
    Grid::new("limits").num_columns(2).spacing(Vec2::new(14.0, 6.0)).show(ui, |ui| {
        ui.label("Keep below").explained("The local limit that the speed keeps below at every place of the path");
        ui.horizontal_wrapped(|ui| {
            let mut percent = 100.0 * asked.safety;
            number(ui, "Safety", Unit::of("%"), &mut percent, 1.0);
            asked.safety = (percent / 100.0).clamp(0.01, 10.0);
            ui.label("of");
            for (below, name) in Below::ALL {
                ui.radio_value(&mut asked.below, below, name);
            }
        });
        ui.end_row();
        let rows = [
            ("Platform acceleration", "m/s²", &mut asked.acceleration, 3.0, "Speeding up and braking along the path"),
            ("Winch speed", "m/s", &mut asked.winch_speed, 4.0, "How fast a winch can take cable in or let it out"),
            ("Winch acceleration", "m/s²", &mut asked.winch_acceleration, 4.0, "How fast a winch can change its speed"),
        ];
        for (name, unit, limit, usual, meaning) in rows {
            let mut on = limit.is_some();
            ui.checkbox(&mut on, name).explained(meaning);
            if on {
                let mut value = limit.unwrap_or(usual);
                number(ui, name, Unit::of(unit), &mut value, 0.05);
                *limit = Some(value);
            } else {
                *limit = None;
                ui.weak("no limit");
            }
            ui.end_row();
        }
        let mut on = asked.slack.is_some();
        ui.checkbox(&mut on, "Slack").explained(
            "Keeps below this part of the acceleration at which a cable goes slack by statics. In a flight that comes at up to \
             30 % less peak speed, which is half of the acceleration",
        );
        if on {
            let mut percent = 100.0 * asked.slack.unwrap_or(0.5);
            number(ui, "Part of the slack acceleration", Unit::of("%"), &mut percent, 1.0);
            asked.slack = Some(percent / 100.0);
        } else {
            asked.slack = None;
            ui.weak("no limit");
        }
        ui.end_row();
    });
}

/// A number that is more than 0.
fn number(ui: &mut Ui, name: &str, unit: Unit, value: &mut f64, step: f64) {
    let size = Vec2::new(84.0, ui.spacing().interact_size.y.max(24.0));
    let answer = Control { name, unit, step, size }.show(ui, *value);
    match answer.value {
        Some(typed) if typed > 0.0 && typed.is_finite() => *value = typed,
        Some(_) => answer.refuse(ui, "This limit must be more than 0".into()),
        None => {}
    }
}

fn result(fastest: &Fastest, current: bool, path: &Path, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let text = format!(
        "{} s, up to {} m/s",
        digits::certain(fastest.found.duration(), None),
        digits::certain(fastest.found.peak(), None)
    );
    let text = RichText::new(text).heading();
    ui.label(if current { text } else { text.weak() });
    if !current {
        ui.weak("Being recomputed: this belongs to an earlier state.");
    }
    table(&fastest.found, ui);
    ui.horizontal_wrapped(|ui| {
        let save =
            ui.button("Save as CSV").explained("Time, place, speed, and what every winch does, for a controller");
        if save.clicked() {
            commands.push(Command::Save(Content::Fastest));
        }
    });
    ui.add_space(4.0);
    ui.add(
        Label::new(
            "Its acceleration jumps from one limit to another, which sets the robot swinging: smooth it before flying. A cable \
             can go slack within these limits. Below the wave limit nothing grows without bound; the frozen critical speed \
             is stricter in most places, for a reason that has no part in a move.",
        )
        .wrap(),
    );
    ui.separator();
    scaled(fastest, current, path, ui, facts, commands);
}

/// Some of the rows.
fn table(found: &FastestMove, ui: &mut Ui) {
    Grid::new("fastest").striped(true).spacing(Vec2::new(18.0, 4.0)).show(ui, |ui| {
        for name in ["t, s", "s, m", "v, m/s", "a, m/s²", "fastest winch, m/s"] {
            ui.weak(name);
        }
        ui.end_row();
        let last = found.rows.len().saturating_sub(1);
        for i in 0..ROWS {
            let Some(row) = found.rows.get(last * i / (ROWS - 1)) else { continue };
            let winch = row.cables.iter().map(|cable| cable.rate.abs()).fold(0.0, f64::max);
            for value in [row.time, row.s, row.v, row.a, winch] {
                ui.label(format!("{:.2}", value + 0.0).replace("-0.00", "0.00").replace('-', "−"));
            }
            ui.end_row();
        }
    });
}

/// The document's own profile, as fast as these limits allow.
fn scaled(fastest: &Fastest, current: bool, path: &Path, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    if path.profile == ProfileKind::Constant || !fastest.scale.is_finite() {
        ui.weak("A profile of constant speed does not rest at its ends: no such move keeps to these limits.");
        return;
    }
    let scale = round_down(fastest.scale);
    let (peak, word) = (path.speed * scale, if scale < 1.0 { "too fast for" } else { "within" });
    ui.add(
        Label::new(format!(
            "The present profile, {} m/s, is {word} these limits. It keeps to them up to {} m/s: {} s.",
            digits::certain(path.speed, None),
            digits::certain(peak, None),
            facts
                .document
                .scenario
                .trajectory()
                .map_or_else(String::new, |trajectory| { digits::certain(trajectory.duration() / scale, None) })
        ))
        .wrap(),
    );
    let text = "Sets peak speed, acceleration and jerk of the present profile to what these limits allow. Undo brings them back";
    if ui.add_enabled(current, eframe::egui::Button::new("Use it")).explained(text).clicked() {
        let mut scenario = facts.document.scenario.clone();
        if let Some(path) = &mut scenario.path {
            path.speed *= scale;
            path.acceleration *= scale * scale;
            path.jerk *= scale * scale * scale;
        }
        commands.push(Command::Edit(Box::new(scenario)));
    }
}

/// Three digits, and no more than the value.
fn round_down(value: f64) -> f64 {
    let unit = 10.0_f64.powf(value.log10().floor() - 3.0);
    (value / unit + 1e-9).floor() * unit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_is_rounded_down_to_four_digits() {
        for (value, rounded) in [(0.936_41, 0.9364), (1.2, 1.2), (12.345_9, 12.34)] {
            assert!((round_down(value) - rounded).abs() < 1e-9, "{value}");
        }
    }
}
