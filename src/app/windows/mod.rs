//! Windows over the page.

mod settings;
mod shortcuts;
mod theory;
mod validation;

use eframe::egui::{Align2, Context, Ui, Window};

use crate::app::state::UiState;

/// What windows keep from frame to frame.
#[derive(Default)]
pub struct Runtime {
    theory: theory::Pictures,
    validation: validation::Run,
}

/// Draws those that are open.
pub fn ui(context: &Context, state: &mut UiState, runtime: &mut Runtime) {
    let mut open = state.windows;
    window(context, "Settings", &mut open.settings, |ui| settings::ui(ui, &mut state.settings));
    window(context, "Keyboard shortcuts", &mut open.shortcuts, shortcuts::ui);
    page(context, "Theory", theory::WIDEST, &mut open.theory, |ui| theory::ui(ui, &mut runtime.theory));
    page(context, "Validation", 700.0, &mut open.validation, |ui| validation::ui(ui, &mut runtime.validation));
    if !open.validation {
        // Whoever opens it again wants to see it done again.
        runtime.validation = validation::Run::default();
    }
    state.windows = open;
}

/// A window in the middle that scrolls where the screen is small.
fn window(context: &Context, title: &str, open: &mut bool, content: impl FnOnce(&mut Ui)) {
    in_the_middle(context, title, open).show(context, content);
}

/// The same for much to read: as high as the screen, and so many points wide where there is room.
fn page(context: &Context, title: &str, width: f32, open: &mut bool, content: impl FnOnce(&mut Ui)) {
    let height = context.content_rect().height();
    in_the_middle(context, title, open).default_size([width, height]).show(context, content);
}

fn in_the_middle<'open>(context: &Context, title: &str, open: &'open mut bool) -> Window<'open> {
    let room = context.content_rect();
    Window::new(title)
        .open(open)
        .collapsible(false)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .max_width((room.width() - 24.0).min(720.0))
        .max_height(room.height() - 90.0)
        .vscroll(true)
}
