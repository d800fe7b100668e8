//! The document with all that is known of it, as panels read it.

use crate::app::answers::Answers;
use crate::app::certainty::Certainty;
use crate::app::designs::Designs;
use crate::app::settings::Settings;
use crate::app::state::Document;
use crate::app::studies::{Joined, Studies};
use crate::compute::protocol::ModeChoice;

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
    /// The designs to compare with.
    pub designs: Designs,
}

impl Present {
    /// What panels read, in these units and with the mode that is chosen.
    pub fn facts(&self, settings: Settings, mode: ModeChoice) -> Facts<'_> {
        let Self { document, answers, studies, joined, designs } = self;
        let certainty = Certainty::known(&document.scenario, answers, studies);
        Facts { document, answers, studies, joined, designs, certainty, settings, mode }
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
