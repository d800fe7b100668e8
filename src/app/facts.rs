//! The document with all that is known of it, as panels read it.

use crate::app::answers::Answers;
use crate::app::certainty::Certainty;
use crate::app::designs::Designs;
use crate::app::flying::Flying;
use crate::app::settings::Settings;
use crate::app::state::Document;
use crate::app::studies::{Joined, Studies, StudyStage};
use crate::compute::protocol::{ModeChoice, Topic};
use crate::study::{Answer, Flown};

/// The document and all that is known of it.
pub struct Present {
    /// What is edited.
    pub document: Document,
    /// What is known of its pose.
    pub answers: Answers,
    /// What is known of more than the pose.
    pub studies: Studies,
    /// The modes of the Campbell diagram.
    pub joined: Joined,
    /// How the flight along its path is looked at.
    pub flying: Flying,
    /// The designs to compare with.
    pub designs: Designs,
}

impl Present {
    /// What panels read, in these units and with the mode that is chosen.
    pub fn facts(&self, settings: Settings, mode: ModeChoice) -> Facts<'_> {
        let Self { document, answers, studies, joined, designs, flying } = self;
        let certainty = Certainty::known(&document.scenario, answers, studies);
        Facts { document, answers, studies, joined, flying, designs, certainty, settings, mode }
    }
}

/// What panels read.
#[derive(Clone, Copy, Debug)]
pub struct Facts<'a> {
    /// What is edited.
    pub document: &'a Document,
    /// What is known of the pose.
    pub answers: &'a Answers,
    /// What is known of more than the pose.
    pub studies: &'a Studies,
    /// The modes of the Campbell diagram.
    pub joined: &'a Joined,
    /// How the flight along its path is looked at.
    pub flying: &'a Flying,
    /// The designs to compare with.
    pub designs: &'a Designs,
    /// How far the critical speed on show can be trusted.
    pub certainty: Certainty,
    /// Units.
    pub settings: Settings,
    /// The mode whose shape is wanted.
    pub mode: ModeChoice,
}

impl Facts<'_> {
    /// How far off other critical speeds than the one on show are to be expected, as a part of them.
    pub fn share(&self) -> Option<f64> {
        self.certainty.share(self.answers.last_critical()?.critical.as_ref()?)
    }
}

/// What is known of the flight along the document's path.
#[derive(Clone, Copy, Debug)]
pub enum FlightKnown<'a> {
    /// There is no path.
    NoPath,
    /// It is being computed, or will be.
    Waits,
    /// A person has stopped its computation.
    Stopped,
    /// There is none, with the reason.
    Failed(&'a str),
    /// The flight of the document as it is.
    Flown(&'a Flown),
}

impl<'a> Facts<'a> {
    /// What is known of the flight. One of an earlier state of the document is not known.
    pub fn flight(&self) -> FlightKnown<'a> {
        let Some(wanted) = self.flying.wanted(&self.document.scenario) else { return FlightKnown::NoPath };
        let shown = self.studies.shown(Topic::Flight).filter(|shown| shown.known.request == wanted);
        match shown.and_then(|shown| shown.known.places.first()) {
            Some(Some(Answer::Flight(found))) => match &**found {
                Ok(flown) => FlightKnown::Flown(flown),
                Err(reason) => FlightKnown::Failed(reason),
            },
            _ => match self.studies.progress(Topic::Flight).stage {
                StudyStage::Stopped => FlightKnown::Stopped,
                StudyStage::Failed => FlightKnown::Failed("it could not be computed"),
                _ => FlightKnown::Waits,
            },
        }
    }

    /// The flight, where it is known.
    pub fn flown(&self) -> Option<&'a Flown> {
        match self.flight() {
            FlightKnown::Flown(flown) => Some(flown),
            _ => None,
        }
    }
}
