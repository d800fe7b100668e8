//! Windows over the page.

mod designs;
mod fastest;
mod new_robot;
mod settings;
mod shortcuts;
mod theory;
mod validation;

use eframe::egui::{Align2, Context, Id, LayerId, Order, ScrollArea, Ui, Window};

use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::state::{UiState, Windows};

/// What windows keep from frame to frame.
#[derive(Default)]
pub struct Runtime {
    theory: theory::Pictures,
    /// The checks of known numbers.
    pub validation: validation::Run,
    /// The winches of a new robot.
    new_robot: new_robot::Winches,
}

#[cfg(target_arch = "wasm32")]
impl Runtime {
    /// What a screen reader is told of the windows that are open.
    pub fn text(&self, open: Windows) -> Option<String> {
        (open.validation && self.validation.is_done()).then(|| self.validation.summary())
    }
}

/// Draws those that are open.
pub fn ui(
    runtime: &mut Runtime,
    open: &mut Windows,
    state: &mut UiState,
    context: &Context,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    window(context, "Settings", 560.0, &mut open.settings, |ui| settings::ui(&mut state.settings, ui));
    window(context, "Keyboard shortcuts", 560.0, &mut open.shortcuts, shortcuts::ui);
    window(context, "Theory", theory::WIDEST, &mut open.theory, |ui| theory::ui(&mut runtime.theory, ui));
    window(context, "Validation", 700.0, &mut open.validation, |ui| {
        validation::ui(&mut runtime.validation, ui, commands);
    });
    window(context, "Designs", 620.0, &mut open.designs, |ui| designs::ui(ui, facts, commands));
    window(context, "Fastest allowed", 560.0, &mut open.fastest, |ui| {
        fastest::ui(&mut state.limits, ui, facts, commands);
    });
    let mut made = false;
    window(context, "New robot", 640.0, &mut open.new_robot, |ui| {
        made = new_robot::ui(&mut runtime.new_robot, ui, commands);
    });
    open.new_robot &= !made;
    if !open.validation {
        // Whoever opens it again wants to see it done again.
        runtime.validation = validation::Run::default();
    }
}

/// Closes the window that is in front of all others, if one is open.
pub fn close_foremost(open: &mut Windows, context: &Context) -> bool {
    let layers: Vec<LayerId> = context.memory(|memory| memory.layer_ids().collect());
    let Windows { settings, shortcuts, theory, validation, designs, fastest, new_robot } = open;
    let all = [
        ("Settings", settings),
        ("Keyboard shortcuts", shortcuts),
        ("Theory", theory),
        ("Validation", validation),
        ("Designs", designs),
        ("Fastest allowed", fastest),
        ("New robot", new_robot),
    ];
    let place = |title| layers.iter().position(|layer| *layer == LayerId::new(Order::Middle, id(title)));
    let foremost = all.into_iter().filter(|(_, open)| **open).max_by_key(|(title, _)| place(*title));
    foremost.map(|(_, open)| *open = false).is_some()
}

/// egui's name of a window.
fn id(title: &str) -> Id {
    Id::unique(("window", title))
}

/// A window in the middle, with this width in points where there is room. It scrolls where the screen is small.
fn window(context: &Context, title: &str, width: f32, open: &mut bool, content: impl FnOnce(&mut Ui)) {
    let room = context.content_rect();
    Window::new(title)
        .id(id(title))
        .open(open)
        .collapsible(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .resizable(false)
        .show(context, |ui| {
            ui.set_width((room.width() - 40.0).min(width));
            let height = room.height() - 110.0;
            ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, content);
        });
}
