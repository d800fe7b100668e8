//! Files: opened by a dialog, dropped on the window or the page, pasted, and saved.

mod outbox;
#[cfg(not(target_arch = "wasm32"))]
#[path = "native.rs"]
mod system;
#[cfg(target_arch = "wasm32")]
#[path = "web.rs"]
mod system;

use std::sync::mpsc::{Receiver, Sender, channel};

use eframe::egui::{Align2, Context, Event, FontId, Id, LayerId, Order};

pub use outbox::Clip;

use crate::app::command::Command;
use crate::scenario::{Scenario, file, link, table};
use outbox::Outbox;

/// What comes of files that are being read.
#[derive(Debug)]
pub struct Files {
    sender: Sender<Command>,
    receiver: Receiver<Command>,
}

impl Files {
    /// Nothing is read yet.
    pub fn new(context: &Context) -> Self {
        let (sender, receiver) = channel();
        let files = Self { sender, receiver };
        system::prepare(&files.outbox(context));
        files
    }

    fn outbox(&self, context: &Context) -> Outbox {
        Outbox { sender: self.sender.clone(), context: context.clone() }
    }

    /// Lets the user choose a scenario file.
    pub fn open(&self, context: &Context) {
        system::open(self.outbox(context));
    }

    /// Saves `bytes` where the user says; a browser's downloads go under `name`.
    pub fn save(&self, context: &Context, name: &str, bytes: Vec<u8>) {
        system::save(self.outbox(context), name, bytes);
    }

    /// Puts a text on the clipboard, and tells it once it is there. Where a browser does not let the page do that, the
    /// text is shown to be copied by hand.
    pub fn copy(&self, context: &Context, clip: Clip) {
        system::copy(self.outbox(context), clip);
    }

    /// Reads the clipboard, as if its keys had been pressed. Where a browser does not let the page do that, it is told to
    /// press them.
    pub fn paste(&self, context: &Context) {
        system::paste(&self.outbox(context));
    }

    /// What has been read since the last call, and what was dropped or pasted.
    pub fn poll(&self, context: &Context) -> Vec<Command> {
        let dropped = context.input(|input| input.raw.dropped_files.clone());
        if !dropped.is_empty() {
            system::read(self.outbox(context), dropped);
        }
        let pasted = |event: &Event| match event {
            Event::Paste(text) => Some(Command::Read(text.clone())),
            _ => None,
        };
        let mut commands: Vec<Command> = context.input(|input| input.events.iter().filter_map(pasted).collect());
        if context.text_edit_focused() {
            commands.clear();
        }
        commands.extend(self.receiver.try_iter());
        commands
    }
}

/// The scenario that a file's or the clipboard's text holds, or a link.
pub fn scenario(text: &str) -> Result<Scenario, String> {
    file::check_size(text.len() as u64).map_err(|error| format!("The text {error}."))?;
    let text = file::without_mark(text);
    match text.split_once(link::MARK) {
        // A scenario's own name may have such letters in it, but JSON begins with a brace.
        Some((_, fragment)) if !text.trim_start().starts_with('{') => {
            link::decode(fragment).map_err(|error| error.to_string())
        }
        _ => Scenario::from_json(text).map_err(|faults| faults.to_string()),
    }
}

/// Whether a file's or the clipboard's text is a table of cables, and neither a scenario nor a link.
pub fn is_table(text: &str) -> bool {
    let is_scenario = || file::without_mark(text).trim_start().starts_with('{') || text.contains(link::MARK);
    file::check_size(text.len() as u64).is_ok() && !is_scenario() && table::is_table(text)
}

/// Says over the whole window that what is being dragged over it can be dropped.
pub fn announce_drop(context: &Context) {
    if context.input(|input| input.raw.hovered_files.is_empty()) {
        return;
    }
    let painter = context.layer_painter(LayerId::new(Order::Foreground, Id::unique("drop")));
    let rect = context.content_rect();
    let visuals = context.global_style().visuals.clone();
    painter.rect_filled(rect, 0.0, visuals.extreme_bg_color.gamma_multiply(0.8));
    let font = FontId::proportional(24.0);
    painter.text(rect.center(), Align2::CENTER_CENTER, "Drop a scenario file to open it", font, visuals.text_color());
}
