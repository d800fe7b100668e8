//! Plots of a move along the path: the speed against its limits, the flight's deviation and tensions, and its gain.

pub mod deviation;
pub mod gain;
pub mod speeds;
pub mod tensions;
mod time;

use eframe::egui::{Label, RichText, Ui};

use super::axis::signed;
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::state::{Movement, Plot, UiState};
use crate::robot::Trajectory;

/// The time in the flight at which the robot is on show, in s, while a flight is on show.
pub fn now(state: &UiState, facts: Facts<'_>) -> Option<f64> {
    let flown = facts.flown().filter(|_| state.playback.movement == Movement::Fly)?;
    Some(facts.flying.time.min(flown.flight.lost.unwrap_or(flown.flight.end)))
}

/// The path of the document with its timing; where there is none, says so and offers one.
fn trajectory(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) -> Option<Trajectory> {
    let found = facts.document.scenario.trajectory();
    if found.is_none() {
        ui.add(Label::new(RichText::new("There is no path yet: this plot is about a move along one.").weak()).wrap());
        if ui.button("Add a path").clicked() {
            commands.push(Command::AddPath);
        }
    }
    found
}

/// What is to be said first of one of these plots, in few words.
pub fn caption(plot: Plot, facts: Facts<'_>) -> String {
    let Some(trajectory) = facts.document.scenario.trajectory() else { return "no path".into() };
    let [length, duration] = [trajectory.length(), trajectory.duration()].map(|value| digits::certain(value, None));
    match plot {
        Plot::Path => signed(&format!("{length} m in {duration} s")),
        Plot::Gain => "Click to set the peak speed.".into(),
        Plot::Deviation => "Platform off its path, mm".into(),
        _ => "Tension at the platform, N".into(),
    }
}
