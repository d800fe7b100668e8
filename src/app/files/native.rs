//! The system's own file dialogs. They are asked for on the window's thread, as some systems demand, and waited for on
//! another.

use std::path::Path;
use std::sync::Arc;
use std::thread;

use eframe::egui::DroppedFile;
use rfd::AsyncFileDialog;

use super::Hand;

fn name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

pub(super) fn open(hand: Hand) {
    let dialog = AsyncFileDialog::new().set_title("Open a scenario").add_filter("Scenario", &["json"]).pick_file();
    thread::spawn(move || {
        if let Some(file) = pollster::block_on(dialog) {
            hand.over(&file.file_name(), std::fs::read(file.path()).map_err(|error| error.to_string()));
        }
    });
}

#[expect(clippy::needless_pass_by_value)] // As in the browser, where reading goes on after the call.
pub(super) fn read(hand: Hand, file: Arc<dyn DroppedFile>) {
    hand.over(&name(file.path()), file.bytes());
}

pub(super) fn save(hand: Hand, file: &str, bytes: Vec<u8>) {
    let dialog = AsyncFileDialog::new().set_file_name(file).save_file();
    let file = file.to_owned();
    thread::spawn(move || {
        let Some(chosen) = pollster::block_on(dialog) else { return };
        let written = std::fs::write(chosen.path(), bytes);
        let place = chosen.path().display().to_string();
        hand.saved(&file, written.map(|()| Some(place)).map_err(|error| error.to_string()));
    });
}
