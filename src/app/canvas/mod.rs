//! The robot, drawn and dragged: model (what there is), view (where it is on the screen), paint, handles, and the map
//! under it.

mod handles;
pub mod map;
mod model;
mod paint;
mod view;

use eframe::egui::{self, Rect, Sense, Ui};

pub use map::named;
pub use model::{Scene, frame, phase_advance};
pub use paint::grid_step;
pub use view::View;

use crate::app::command::Command;
use crate::app::state::{Plot, UiState};
use crate::app::{Facts, series};
use crate::compute::protocol::Topic;

/// Draws the canvas in all the room there is, and turns drags, clicks and keys into commands. Gives where it is.
pub fn ui(
    layer: &mut map::Layer,
    state: &mut UiState,
    ui: &mut Ui,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) -> Rect {
    let Facts { document, answers, studies, .. } = facts;
    let (rect, background) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    background.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Robot canvas"));
    let scene = Scene::new(&document.scenario, answers, &state.playback);
    // The frame follows the winches, but not while one is dragged: the ground would move under the pointer.
    let pressed = ui.input(|input| input.pointer.any_down());
    let held = if pressed { state.held_frame.or(Some(scene.frame)) } else { None };
    state.held_frame = held;
    let view = View::new(rect, held.unwrap_or(scene.frame), state.camera);
    let mut painter = ui.painter_at(rect);
    painter.set_clip_rect(rect.intersect(ui.clip_rect()));
    paint::background(&painter, ui.visuals(), &view);
    layer.update(ui, studies, state.map);
    layer.paint(&painter, ui, &view);
    paint::scene(&painter, ui.visuals(), &view, &scene, state.map.on);
    // The marker belongs to the diagram beside it, and to one pose.
    let polar = studies.shown(Topic::Polar).filter(|shown| shown.current && state.plot == Plot::Directions);
    if let Some((direction, speed)) = polar.and_then(|shown| series::worst_direction(shown.known)) {
        paint::worst(&painter, ui.visuals(), &view, &scene, direction, speed);
    }
    if state.map.on {
        map::point(ui, &painter, &background, &view, facts, commands);
    }
    handles::ui(ui, &painter, &view, &scene, document, commands);
    if state.unlocked {
        handles::winches(ui, &painter, &view, &scene, document, commands);
    }
    handles::camera(ui, &background, &view, &mut state.camera, !state.map.on);
    if state.map.on {
        layer.legend(&painter, ui, rect, facts);
    } else {
        paint::legend(&painter, ui.visuals(), rect, &scene);
    }
    map::controls(ui, rect, state, studies, commands);
    rect
}
