//! What all plots share: where each stands, how old it is, and what a click on a mode chooses.

use eframe::egui::{Id, Label, RichText, Ui};

use super::axis::signed;
use super::range::Turning;
use crate::app::answers::Answers;
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::state::Plot;
use crate::app::studies::{Shown, Studies, StudyStage};
use crate::compute::protocol::{AnalysedPose, Extent, ModeChoice, Topic, Which};
use crate::stability::Critical;

/// Said of what belongs to an earlier state.
pub const STALE: &str = "Being recomputed: this belongs to an earlier state.";

/// Where a plot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Slot {
    /// On the right of the robot.
    Right,
    /// The second one on the right, below the first.
    Second,
    /// Under the robot, on its horizontal axis.
    Dock,
    /// In the sheet of a phone or of a tablet held upright.
    Sheet,
    /// Under the robot where there is no column of plots: all of them are here.
    Under,
    /// Under the robot in a presentation: the study along the line alone, without tabs.
    Present,
    /// In the place of the robot.
    Large,
    /// Alone in a picture: nothing to press, and the axes say what they show.
    Picture,
}

impl Slot {
    /// Whether it is right under the robot, so that a study along the line has the robot's horizontal axis.
    pub fn is_under_the_robot(self) -> bool {
        matches!(self, Self::Dock | Self::Under | Self::Present)
    }

    /// Whether it is narrow, so that groups of plots are a list.
    pub fn is_sheet(self) -> bool {
        matches!(self, Self::Sheet | Self::Under)
    }
}

/// A plot and where it is.
#[derive(Clone, Copy, Debug)]
pub struct PlotPlace {
    /// Where it is.
    pub slot: Slot,
    /// Which one it is.
    pub plot: Plot,
    /// Whether the wheel zooms it; else it scrolls what the plot is in.
    pub wheel: bool,
}

impl PlotPlace {
    /// Its name among all places.
    pub fn id(self) -> Id {
        Id::unique(("plot", self.slot, self.plot.name()))
    }

    /// How it may be turned, with these axes.
    pub fn turning(self, axes: [bool; 2]) -> Turning {
        Turning { wheel: self.wheel, axes }
    }
}

/// The study that a plot shows.
pub fn topic(plot: Plot) -> Option<Topic> {
    match plot {
        Plot::Line => Some(Topic::Line),
        Plot::Directions => Some(Topic::Directions),
        Plot::Campbell => Some(Topic::Campbell),
        Plot::Mesh => Some(Topic::Mesh),
        Plot::WhatIf => Some(Topic::WhatIf),
        Plot::Path => Some(Topic::Path),
        Plot::Gain => Some(Topic::Gains),
        Plot::Deviation | Plot::Tensions => Some(Topic::Flight),
        Plot::Eigenvalues | Plot::Modes | Plot::Growth | Plot::Sensitivities => None,
    }
}

/// The newest pose with modes; it stays where a newer pose has no equilibrium.
pub fn with_modes(answers: &Answers) -> Option<&AnalysedPose> {
    answers.last_pose().map(|(pose, _)| pose).filter(|pose| !pose.modes.is_empty())
}

/// What has to be said of the modes that are there, or of their absence.
pub fn note_on_modes(answers: &Answers) -> Option<&'static str> {
    match with_modes(answers).map(|pose| pose.extent) {
        None => Some("No eigenvalues at this pose."),
        Some(Extent::SlowestSoFar) => Some("The slowest modes so far; the others are being computed."),
        Some(Extent::SlowestAlone) => Some("The slowest modes alone: the others could not be computed."),
        Some(Extent::All) => None,
    }
}

/// What is said beside eigenvalues and modes where the present pose cannot rest.
pub const KEPT: &str = "Kept from the last pose that can rest.";

/// Where the last pose was that can rest, where the present one cannot: all that is about a pose is from there, and grey.
pub fn kept_from(answers: &Answers) -> Option<String> {
    let (pose, _) = answers.last_pose().filter(|_| answers.pose_failed())?;
    let [x, y] = *pose.report.cables.first()?.nodes.first()?;
    Some(signed(&format!("({x:.2}, {y:.2})")))
}

/// The mode choice that selects `eigenvalue`, keeping what else was chosen.
pub fn near(choice: ModeChoice, eigenvalue: [f64; 2]) -> ModeChoice {
    ModeChoice { which: Which::Near(eigenvalue), ..choice }
}

/// A number as it is read in passing: two digits or so, with a proper minus.
pub fn brief(value: f64) -> String {
    signed(&digits::certain(value, Some(0.04 * value.abs())))
}

/// A speed with its certain digits, or with three where it belongs to something that is not on show.
pub fn speed(facts: Facts<'_>, critical: &Critical) -> String {
    let shown = facts.answers.last_critical().and_then(|answer| answer.critical.as_ref());
    let known = shown.filter(|shown| *shown == critical).and(facts.certainty.speed());
    digits::three_at_most(critical.speed, known)
}

/// The study's answers, once there are any. Where the present pose cannot rest, what is of one pose is an earlier one's.
pub fn study(topic: Topic, facts: Facts<'_>) -> Option<Shown<'_>> {
    let shown = facts.studies.shown(topic).filter(|shown| shown.known.answered() > 0)?;
    let of_this_pose = matches!(topic, Topic::Line | Topic::WhatIf | Topic::Path | Topic::Gains | Topic::Flight)
        || !facts.answers.pose_failed();
    Some(Shown { current: shown.current && of_this_pose, ..shown })
}

/// Words in the place of a plot.
pub fn say(ui: &mut Ui, text: &str) {
    // A number and its sign stay together.
    ui.add(Label::new(RichText::new(text.replace(" %", "\u{a0}%")).weak()).wrap());
}

/// How far a plot's study has come, with what stops it or goes on; whether there was anything to tell.
pub fn progress(ui: &mut Ui, plot: Plot, studies: &Studies, commands: &mut Vec<Command>) -> bool {
    topic(plot).is_some_and(|topic| progress_of(ui, topic, studies, commands))
}

/// How far a study has come, with what stops it or goes on; whether there was anything to tell.
pub fn progress_of(ui: &mut Ui, topic: Topic, studies: &Studies, commands: &mut Vec<Command>) -> bool {
    let progress = studies.progress(topic);
    let resumed = |ui: &mut Ui, name: &str, commands: &mut Vec<Command>| {
        if ui.button(name).clicked() {
            commands.push(Command::ResumeStudy(topic));
        }
    };
    match progress.stage {
        StudyStage::Working => {
            if ui.button("Cancel").explained("Stops this study; what is known of it stays").clicked() {
                commands.push(Command::StopStudy(topic));
            }
            let text = format!("{} of {}", progress.done, progress.total);
            ui.add(Label::new(RichText::new(text).weak()).truncate()).explained("Points computed so far");
        }
        StudyStage::Stopped => {
            resumed(ui, "Resume", commands);
            ui.weak("Stopped");
        }
        StudyStage::Failed => {
            resumed(ui, "Try again", commands);
            let reason = studies.broken().unwrap_or("This could not be computed.");
            ui.add(Label::new(RichText::new(reason).weak()).truncate());
        }
        StudyStage::Finished | StudyStage::Idle => {
            if studies.shown(topic).is_none_or(|shown| shown.current) {
                return false;
            }
            ui.weak("Earlier state").explained(STALE);
        }
    }
    true
}
