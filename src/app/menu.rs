//! The bar at the top, and the keys that do the same.

use eframe::egui::{
    Button, Context, Key, KeyboardShortcut, MenuBar, Modifiers, Panel, Popup, PopupCloseBehavior, Ui,
    containers::menu::MenuConfig,
};

use crate::app::command::Command;
use crate::app::export::Content;
use crate::app::meaning::Explain as _;
use crate::app::shortcuts::{OPEN, REDO, REDO_TOO, SAVE, UNDO};
use crate::app::state::{Camera, Plot, Session, UiState};
use crate::app::windows;

/// What can be done, as far as it depends on more than the interface's state.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools)] // One for each entry that may be grey.
pub struct Possible {
    /// There is a step to undo.
    pub undo: bool,
    /// There is a step to redo.
    pub redo: bool,
    /// A value differs from what it was when the scenario was opened.
    pub reset: bool,
    /// A design is pinned.
    pub unpin: bool,
}

/// Draws the bar.
pub fn ui(state: &mut UiState, session: &mut Session, ui: &mut Ui, possible: Possible, commands: &mut Vec<Command>) {
    Panel::top("menu").show(ui, |ui| {
        let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClick);
        MenuBar::new().config(config).ui(ui, |ui| {
            ui.menu_button("File", |ui| file(ui, state.plot, commands));
            ui.menu_button("Edit", |ui| edit(ui, possible, commands));
            ui.menu_button("View", |ui| view(state, session, ui));
            ui.menu_button("Help", |ui| help(session, ui));
            ui.separator();
            if ui.button("Share").explained("Puts a link to this robot on the clipboard").clicked() {
                commands.push(Command::Share);
            }
            let (name, text) = if possible.unpin {
                ("Unpin", "Lets the pinned design go")
            } else {
                ("Pin", "Keeps this design: all answers and plots then show the difference to it")
            };
            if ui.button(name).explained(text).clicked() {
                commands.push(Command::Pin(!possible.unpin));
            }
            for (name, can, command) in [("Undo", possible.undo, Command::Undo), ("Redo", possible.redo, Command::Redo)]
            {
                if ui.add_enabled(can, Button::new(name)).clicked() {
                    commands.push(command);
                }
            }
        });
    });
}

/// An entry with the keys that do the same.
fn entry(ui: &mut Ui, name: &str, keys: Option<KeyboardShortcut>, enabled: bool) -> bool {
    let keys = keys.map_or_else(String::new, |keys| ui.ctx().format_shortcut(&keys));
    ui.add_enabled(enabled, Button::new(name).shortcut_text(keys)).clicked()
}

fn file(ui: &mut Ui, plot: Plot, commands: &mut Vec<Command>) {
    if entry(ui, "Open …", Some(OPEN), true) {
        commands.push(Command::Open);
    }
    if entry(ui, "Save scenario", Some(SAVE), true) {
        commands.push(Command::Save(Content::Scenario));
    }
    ui.separator();
    let contents = [
        ("Save analysis as JSON", Content::Analysis),
        ("Save modes as CSV", Content::Plot(Plot::Modes)),
        ("Save this plot as CSV", Content::Plot(plot)),
        ("Save this plot as PNG", Content::PlotPicture),
        ("Save the map as CSV", Content::Map),
        ("Save the canvas as PNG", Content::CanvasPicture),
    ];
    for (name, content) in contents {
        if entry(ui, name, None, true) {
            commands.push(Command::Save(content));
        }
    }
}

fn edit(ui: &mut Ui, possible: Possible, commands: &mut Vec<Command>) {
    if entry(ui, "Undo", Some(UNDO), possible.undo) {
        commands.push(Command::Undo);
    }
    if entry(ui, "Redo", Some(REDO), possible.redo) {
        commands.push(Command::Redo);
    }
    ui.separator();
    if entry(ui, "Reset all values", None, possible.reset) {
        commands.push(Command::Reset);
    }
    if entry(ui, "Copy the table of modes", None, true) {
        commands.push(Command::CopyModes);
    }
}

fn view(state: &mut UiState, session: &mut Session, ui: &mut Ui) {
    ui.toggle_value(&mut state.map.on, "Map");
    ui.toggle_value(&mut state.playback.playing, "Mode shape moves");
    if ui.button("Show the whole robot").clicked() {
        session.camera = Camera::default();
    }
    ui.separator();
    if ui.button("Settings").clicked() {
        session.windows.settings = true;
    }
}

fn help(session: &mut Session, ui: &mut Ui) {
    if entry(ui, "Tour", None, true) {
        session.tour = Some(0);
    }
    if entry(ui, "Keyboard shortcuts", None, true) {
        session.windows.shortcuts = true;
    }
    if entry(ui, "Theory", None, true) {
        session.windows.theory = true;
    }
    if entry(ui, "Validation", None, true) {
        session.windows.validation = true;
    }
}

/// Carries out the keys pressed in this frame.
pub fn keys(state: &mut UiState, session: &mut Session, context: &Context, commands: &mut Vec<Command>) {
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
    // A focused button takes the space bar, and letters are for whoever has the focus.
    let focused = context.memory(|memory| memory.focused().is_some());
    context.input_mut(|input| {
        let mut pressed = |key| input.consume_key(Modifiers::NONE, key);
        if pressed(Key::M) {
            state.map.on = !state.map.on;
        }
        if !focused && pressed(Key::Space) {
            state.playback.playing = !state.playback.playing;
        }
        for (key, step) in [(Key::Period, 1.0), (Key::Comma, -1.0)] {
            if pressed(key) {
                state.playback.step(step);
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
/// window; else the tour. What is typed comes before all of them, and is taken back by its field.
fn escape(state: &mut UiState, session: &mut Session, context: &Context) {
    // These hear of the key from egui.
    if Popup::is_any_open(context) || !context.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
        return;
    }
    if !windows::close_foremost(&mut session.windows, context) {
        state.tour_taken |= session.tour.take().is_some();
    }
}
