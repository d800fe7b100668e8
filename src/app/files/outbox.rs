//! What files and the clipboard have to tell, on its way to the application.

use std::sync::mpsc::Sender;

use eframe::egui::Context;

use crate::app::command::Command;
use crate::scenario::file::FileError;

/// Something for the clipboard.
#[derive(Clone, Debug)]
pub struct Clip {
    /// What it is, as a sentence begins with it.
    pub what: &'static str,
    /// The text itself.
    pub text: String,
    /// What is added to "… is on the clipboard" once it is there.
    pub more: String,
}

impl Clip {
    /// What is told once it is there.
    pub fn done(&self) -> String {
        format!("{} is on the clipboard{}", self.what, self.more)
    }
}

/// Sends the application what has come of a file, from wherever that is found out.
#[derive(Clone)]
pub struct Outbox {
    /// Where commands go.
    pub sender: Sender<Command>,
    /// To wake the interface with.
    pub context: Context,
}

impl Outbox {
    /// Hands over what was read of the file called `name`.
    pub fn read(&self, name: &str, text: Result<String, FileError>) {
        self.command(match text {
            Ok(text) => Command::Read(text),
            Err(error) => Command::Complain(format!("{name} {error}.")),
        });
    }

    /// Tells where the file called `name` was saved, or that its download has begun where only the browser knows the place, or
    /// why it was not saved.
    pub fn saved(&self, name: &str, outcome: Result<Option<String>, String>) {
        match outcome {
            Ok(Some(place)) => self.command(Command::Done(Some(format!("Saved {place}.")))),
            Ok(None) => self.command(Command::Done(Some(format!("The download of {name} has begun.")))),
            Err(reason) => self.command(Command::Complain(format!("{name} could not be saved: {reason}"))),
        }
    }

    /// Sends a command and has it carried out.
    pub fn command(&self, command: Command) {
        // Nobody is left to hear of it once the application is gone.
        let _ = self.sender.send(command);
        self.context.request_repaint();
    }
}
