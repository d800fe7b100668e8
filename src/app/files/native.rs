//! The system's own file dialogs. They are asked for on the window's thread, as some systems demand, and waited for on
//! another. Files are read and written there, too: a disk or a network may be slow.

use std::path::Path;
use std::thread;

use eframe::egui::{DroppedFileHandle, ViewportCommand};
use rfd::AsyncFileDialog;

use super::outbox::{Clip, Outbox};
use crate::app::command::Command;
use crate::scenario::file;

/// Nothing needs to be.
pub(super) fn prepare(_: &Outbox) {}

/// The system's clipboard takes what it is given.
#[expect(clippy::needless_pass_by_value)] // As in the browser, which answers after the call.
pub(super) fn copy(outbox: Outbox, clip: Clip) {
    let done = clip.done();
    outbox.context.copy_text(clip.text);
    outbox.command(Command::Done(Some(done)));
}

/// The window answers with the same event as after the keys.
pub(super) fn paste(outbox: &Outbox) {
    outbox.context.send_viewport_cmd(ViewportCommand::RequestPaste);
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

pub(super) fn open(outbox: Outbox) {
    let dialog = AsyncFileDialog::new().set_title("Open a scenario").add_filter("Scenario", &["json"]).pick_file();
    thread::spawn(move || {
        if let Some(chosen) = pollster::block_on(dialog) {
            outbox.read(&chosen.file_name(), file::open(chosen.path()));
        }
    });
}

pub(super) fn read(outbox: Outbox, files: Vec<DroppedFileHandle>) {
    // One after the other, so that the last of them is the one on show.
    thread::spawn(move || {
        for dropped in files {
            // Not by the handle itself, which does not tell a size before it reads.
            outbox.read(&name(dropped.path()), file::open(dropped.path()));
        }
    });
}

pub(super) fn save(outbox: Outbox, file: &str, bytes: Vec<u8>) {
    let dialog = AsyncFileDialog::new().set_file_name(file).save_file();
    let file = file.to_owned();
    thread::spawn(move || {
        let Some(chosen) = pollster::block_on(dialog) else { return };
        let written = std::fs::write(chosen.path(), bytes);
        let place = chosen.path().display().to_string();
        outbox.saved(&file, written.map(|()| Some(place)).map_err(|error| error.to_string()));
    });
}
