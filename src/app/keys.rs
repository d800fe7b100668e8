//! What keys do, wherever the focus is.

use eframe::egui::{Context, Key, Modifiers, Popup};

use crate::app::command::Command;
use crate::app::export::Content;
use crate::app::shortcuts::{OPEN, REDO, REDO_TOO, SAVE, UNDO};
use crate::app::state::{Camera, Session, UiState};
use crate::app::{windows, words};

/// Carries out the keys pressed in this frame.
pub fn carry_out(state: &mut UiState, session: &mut Session, context: &Context, commands: &mut Vec<Command>) {
    // A text field has its own undo and its own letters.
    if context.text_edit_focused() {
        return;
    }
    context.input_mut(|input| {
        // The longer ones first: Ctrl+Z is a part of Ctrl+Shift+Z.
        if input.consume_shortcut(&REDO) || input.consume_shortcut(&REDO_TOO) {
            commands.push(Command::Redo);
        }
        if input.consume_shortcut(&UNDO) {
            commands.push(Command::Undo);
        }
        if input.consume_shortcut(&OPEN) {
            commands.push(Command::Open);
        }
        if input.consume_shortcut(&SAVE) {
            commands.push(Command::Save(Content::Scenario));
        }
    });
    escape(state, session, context);
    if !state.settings.single_keys {
        return;
    }
    // A focused button takes the space bar, and letters are for whoever has the focus.
    let focused = context.memory(|memory| memory.focused().is_some());
    context.input_mut(|input| {
        let mut pressed = |key| input.consume_key(Modifiers::NONE, key);
        if pressed(Key::M) {
            state.map.on = !state.map.on;
        }
        if pressed(Key::F) {
            session.present = !session.present;
        }
        if !focused && pressed(Key::Space) {
            state.playback.playing = !state.playback.playing;
        }
        for (key, step) in [(Key::Period, 1.0), (Key::Comma, -1.0)] {
            if pressed(key) {
                commands.push(Command::Step(step));
            }
        }
        for (key, factor) in [(Key::Plus, 1.25), (Key::Minus, 0.8)] {
            if pressed(key) {
                session.camera.magnify(factor);
            }
        }
        if pressed(Key::Num0) {
            session.camera = Camera::default();
        }
        if input.events.iter().any(|event| matches!(event, eframe::egui::Event::Text(text) if text == "?")) {
            session.windows.shortcuts = true;
        }
    });
}

/// Esc closes the innermost thing that is open, one for each press: a list, a menu or an explanation; else the foremost
/// window; else the tour, the plot that is large, the presentation. What is typed comes before all of them, and is taken back by its field.
fn escape(state: &mut UiState, session: &mut Session, context: &Context) {
    if words::is_open(context) {
        if context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            session.word = None;
        }
        return;
    }
    // These hear of the key from egui.
    if Popup::is_any_open(context) || !context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
        return;
    }
    if windows::close_foremost(&mut session.windows, context) {
        return;
    }
    if session.tour.take().is_some() {
        state.tour_taken = true;
    } else if session.large.take().is_none() {
        session.present = false;
    }
}
