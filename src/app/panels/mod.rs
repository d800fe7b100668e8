//! The panels beside the canvas: the answer, the controls, the plots. One file each.

pub mod answer;
pub mod campbell;
pub mod controls;
pub mod directions;
pub mod eigenvalues;
pub mod growth;
pub mod knobs;
pub mod line;
pub mod mesh;
pub mod modes;
pub mod plots;
mod robot;
mod rows;

use eframe::egui::{CollapsingHeader, Ui};
use egui_plot::{GridInput, GridMark};

use crate::app::answers::Answers;
use crate::app::canvas;
use crate::app::command::Command;
use crate::app::meaning::Explain as _;
use crate::app::round::round_step;
use crate::app::studies::{Shown, Stage, Studies};
use crate::compute::protocol::{AnalysedPose, Extent, ModeChoice, Topic, Which};

/// Said over what belongs to an earlier state.
const STALE: &str = "Being recomputed: this belongs to an earlier state.";

/// The newest pose with its modes; where there are none, that and why.
fn with_modes<'a>(ui: &mut Ui, answers: &'a Answers) -> Option<&'a AnalysedPose> {
    let pose = answers.pose().filter(|pose| !pose.modes.is_empty());
    if pose.is_none() {
        ui.weak("No eigenvalues at this pose.");
    }
    match pose.map(|pose| pose.extent) {
        Some(Extent::SlowestSoFar) => {
            ui.weak("The slowest modes so far; the others are being computed.");
        }
        Some(Extent::SlowestAlone) => {
            ui.weak("The slowest modes alone: the others could not be computed.");
        }
        Some(Extent::All) | None => {}
    }
    pose
}

/// The mode choice that selects `eigenvalue`, keeping what else was chosen.
fn near(choice: ModeChoice, eigenvalue: [f64; 2]) -> ModeChoice {
    ModeChoice { which: Which::Near(eigenvalue), ..choice }
}

/// What a plot shows, in plain words, for those who ask.
fn explain(ui: &mut Ui, text: &str) {
    CollapsingHeader::new("What am I seeing?").show(ui, |ui| ui.label(text));
}

/// The height of each of so many plots, one above the other: all the room there is. With less than this, in points, a
/// plot tells nothing, and the panel scrolls.
fn plot_height(ui: &Ui, plots: u8) -> f32 {
    const LEAST: [f32; 2] = [180.0, 130.0];
    let between = ui.spacing().item_spacing.y * f32::from(plots - 1);
    let least = LEAST[usize::from(plots > 1)];
    ((ui.available_height() - between) / f32::from(plots)).floor().max(least)
}

/// Grid lines at round values, few enough that each has its label.
#[expect(clippy::needless_pass_by_value)] // As egui_plot calls it.
fn few_lines(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let step = round_step((high - low) / 4.0);
    // At most five or so: the step follows the range.
    #[expect(clippy::cast_possible_truncation)]
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last).take(12).map(|line| GridMark { value: line as f64 * step, step_size: step }).collect()
}

/// A study's progress, and what there is to see of it.
fn study<'a>(ui: &mut Ui, topic: Topic, studies: &'a Studies, commands: &mut Vec<Command>) -> Option<Shown<'a>> {
    let shown = studies.shown(topic).filter(|shown| shown.known.answered() > 0);
    // Always there, so that nothing jumps when a study begins and ends.
    ui.horizontal(|ui| {
        ui.set_min_height(ui.spacing().interact_size.y);
        match (studies.progress(topic).stage, shown) {
            (Stage::Finished, _) => {
                ui.weak("Up to date with the robot");
            }
            (_, Some(Shown { current: false, .. })) => {
                canvas::map::progress(ui, topic, studies, commands);
                ui.weak("Earlier state").explained(STALE);
            }
            _ => canvas::map::progress(ui, topic, studies, commands),
        }
    });
    shown
}
