//! Windows over the page.

mod settings;
mod shortcuts;

use eframe::egui::{Align2, Context, ScrollArea, Ui, Window};

use crate::app::state::UiState;

/// Draws those that are open.
pub fn ui(context: &Context, state: &mut UiState) {
    let mut open = state.windows;
    window(context, "Settings", &mut open.settings, |ui| settings::ui(ui, &mut state.settings));
    window(context, "Keyboard shortcuts", &mut open.shortcuts, shortcuts::ui);
    state.windows = open;
}

/// A window in the middle that scrolls where the screen is small.
fn window(context: &Context, title: &str, open: &mut bool, content: impl FnOnce(&mut Ui)) {
    let room = context.content_rect();
    Window::new(title).open(open).collapsible(false).anchor(Align2::CENTER_CENTER, [0.0, 0.0]).resizable(false).show(
        context,
        |ui| {
            ui.set_width((room.width() - 40.0).min(560.0));
            ScrollArea::vertical().max_height(room.height() - 110.0).show(ui, content);
        },
    );
}
