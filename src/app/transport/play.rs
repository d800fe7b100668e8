//! What every transport has: the button that plays, and the choice of what moves.

use eframe::egui::Ui;

use crate::app::command::Command;
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::state::{Movement, Playback};
use crate::compute::protocol::{ModeChoice, Which};

pub(super) fn play(playback: &mut Playback, ui: &mut Ui, height: f32) {
    let (icon, name) = if playback.playing { (Icon::Pause, "Pause") } else { (Icon::Play, "Play") };
    if IconButton::new(icon, name).height(height).primary().show(ui).explained("Space does the same").clicked() {
        playback.playing = !playback.playing;
    }
}

/// Has this move from now on.
pub(super) fn choose(playback: &mut Playback, mode: ModeChoice, movement: Movement, commands: &mut Vec<Command>) {
    (playback.movement, playback.since) = (movement, 0.0);
    let which = match (movement, mode.which) {
        (Movement::Mode, _) => Which::Critical,
        (_, Which::Critical) => Which::Present,
        (_, which) => which,
    };
    if which != mode.which {
        commands.push(Command::ChooseMode(ModeChoice { which, ..mode }));
    }
}
