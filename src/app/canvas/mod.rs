//! The robot, drawn and dragged: model (what there is), view (where it is on the screen), paint, and handles.

mod handles;
mod model;
mod paint;
mod view;

use eframe::egui::{self, Sense, Ui};

pub use model::{Scene, frame, phase_advance};
pub use view::View;

use crate::app::answers::Answers;
use crate::app::state::{Command, Document, UiState};

/// Draws the canvas in all the room there is, and turns drags and keys into commands.
pub fn ui(state: &mut UiState, ui: &mut Ui, document: &Document, answers: &Answers, commands: &mut Vec<Command>) {
    let (rect, background) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    background.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Robot canvas"));
    let scene = Scene::new(&document.scenario, answers, &state.playback);
    let view = View::new(rect, scene.frame, state.camera);
    let mut painter = ui.painter_at(rect);
    painter.set_clip_rect(rect.intersect(ui.clip_rect()));
    paint::scene(&painter, ui.visuals(), &view, &scene);
    handles::ui(ui, &painter, &view, &scene, document, commands);
    handles::camera(ui, &background, &view, &mut state.camera);
    paint::legend(&painter, ui.visuals(), rect, &scene);
}
