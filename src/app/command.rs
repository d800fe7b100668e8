//! What panels ask for, carried out between two frames.

use crate::app::designs::Action;
use crate::app::export::Content;
use crate::app::flying;
use crate::app::words::Word;
use crate::compute::protocol::{ModeChoice, Topic};
use crate::scenario::{Parameter, Scenario};

/// A request of a panel.
#[derive(Clone, Debug)]
pub enum Command {
    /// Put this scenario in the place of the present one, where it is physical.
    Edit(Box<Scenario>),
    /// Start from this scenario: values reset to what they are in it.
    Load(Box<Scenario>),
    /// Start from the scenario that a file, a link or the clipboard holds, or take over the cables in a table.
    Read(String),
    /// Back to the state before the last step.
    Undo,
    /// Forward again.
    Redo,
    /// All values back to what they were when the scenario was opened.
    Reset,
    /// Put a link to the scenario and to how it is looked at on the clipboard.
    Share,
    /// Put the lines on the clipboard that show the page as a frame in another one.
    Embed,
    /// Do something with the designs that are kept.
    Design(Action),
    /// Put the table of what differs between the designs on the clipboard.
    CopyDesigns,
    /// Give the robot a path from where the platform is.
    AddPath,
    /// Open the window about the fastest move along the path.
    ShowFastest,
    /// Choose a scenario file and start from it.
    Open,
    /// Write something down in a file.
    Save(Content),
    /// Put the table of modes on the clipboard.
    CopyModes,
    /// Put the table of cables on the clipboard.
    CopyCables,
    /// Take what is on the clipboard, as if its keys had been pressed.
    Paste,
    /// Show another mode's shape.
    ChooseMode(ModeChoice),
    /// Bring the control of this number into view.
    Reveal(Parameter),
    /// Show the critical speed against this number, in the place of the sensitivities.
    WhatIf(Parameter),
    /// Stop what moves on the canvas, and go on by this number of steps.
    Step(f64),
    /// Look at the flight in another way.
    Flight(flying::Action),
    /// Move the platform to the last pose that had an equilibrium.
    BackToFeasible,
    /// Open what a frame shows in a page of its own.
    OpenWhole,
    /// Go to the text version of the page with the robot on show.
    OpenText,
    /// Open the card of a word.
    ExplainWord(Word),
    /// Do this check against a known number.
    Check(usize),
    /// Stop a study; what is known of it stays.
    StopStudy(Topic),
    /// Go on with a study that was stopped.
    ResumeStudy(Topic),
    /// What took its time has succeeded: tell it, where there is something to tell.
    Done(Option<String>),
    /// Tell what went wrong.
    Complain(String),
    /// Take this notice off the screen.
    DismissNotice(usize),
}

impl Command {
    /// Whether it puts something on the clipboard or reads it.
    pub fn uses_clipboard(&self) -> bool {
        matches!(self, Self::Share | Self::Embed | Self::CopyModes | Self::CopyCables | Self::CopyDesigns | Self::Paste)
    }
}
