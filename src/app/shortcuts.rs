//! The keys that do what the menus do, and the list of all keys.

use eframe::egui::{Context, Key, KeyboardShortcut, Modifiers};

/// Undo.
pub const UNDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Z);
/// Redo.
pub const REDO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
/// Redo, as on Windows.
pub const REDO_TOO: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Y);
/// Open a file.
pub const OPEN: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::O);
/// Save the scenario.
pub const SAVE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::S);

/// All keys with what they do, for the window that lists them.
pub fn all(context: &Context) -> Vec<(String, &'static str)> {
    let keys = |keys: &[KeyboardShortcut]| {
        let names: Vec<String> = keys.iter().map(|keys| context.format_shortcut(keys)).collect();
        names.join(" or ")
    };
    let mut all = vec![
        (keys(&[UNDO]), "Undo the last step; a drag is one step"),
        (keys(&[REDO, REDO_TOO]), "Redo"),
        (keys(&[OPEN]), "Open a scenario file"),
        (keys(&[SAVE]), "Save the scenario"),
    ];
    let others = [
        ("Tab, Shift+Tab", "From control to control, also the platform, the arrow and the winches"),
        ("Arrow keys", "Platform, winch or point of the path: move; arrow: ← → turn, ↑ ↓ speed. With Shift finely"),
        ("Delete", "Remove the point of the path that has the focus"),
        ("+ and −, 0", "Zoom in and out, and show the whole robot"),
        ("Space", "Play or pause the mode shape"),
        (". and ,", "One step of the mode shape forward or back"),
        ("M", "Map on or off"),
        ("F", "Presentation on or off"),
        ("F6, Shift+F6", "From region to region"),
        ("?", "This list"),
        ("Esc", "Take back what is typed; close a list, a menu, a window, the tour, one at a time"),
    ];
    all.extend(others.map(|(keys, meaning)| (keys.to_owned(), meaning)));
    all
}
