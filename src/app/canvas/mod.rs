//! The robot, drawn and dragged: model (what there is), layout (where it is on the screen), paint,
//! handles, and the map under it.

mod arrow;
mod handles;
mod layout;
pub mod map;
mod model;
mod paint;
mod view;

use eframe::egui::{self, Rect, Sense, Ui};

use arrow::Arrow;
use layout::Layout;
pub use map::named;
pub use model::{Scene, frame, phase_advance};
pub use view::View;

use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::state::{Plot, Session, UiState};
use crate::app::{digits, series};
use crate::compute::protocol::Topic;
use crate::robot::BoundingBox;

/// What the canvas keeps from frame to frame.
#[derive(Default)]
pub struct Runtime {
    /// Pictures made of studies.
    layer: map::Layer,
    /// What was the frame when the pointer was pressed, else what it is.
    frame: Option<BoundingBox>,
    /// The arrow of the last frame.
    arrow: Option<Arrow>,
    /// Whether its tip was held then.
    holds_tip: bool,
}

/// Draws the canvas in all the room there is, and turns drags, clicks and keys into commands. Gives where it is.
pub fn ui(
    runtime: &mut Runtime,
    state: &mut UiState,
    session: &mut Session,
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
    let frame = runtime.frame.filter(|_| pressed).unwrap_or(scene.frame);
    runtime.frame = Some(frame);
    let held = runtime.arrow.filter(|_| pressed && runtime.holds_tip);
    let before = runtime.arrow.map(|arrow| arrow.step);
    let layout = Layout::new(rect, frame, session.camera, &scene, held, before);
    let view = &layout.view;
    runtime.arrow = Some(layout.arrow);
    let mut painter = ui.painter_at(rect);
    painter.set_clip_rect(rect.intersect(ui.clip_rect()));
    paint::background(&painter, ui.visuals(), view);
    runtime.layer.update(ui, studies, state.map);
    runtime.layer.paint(&painter, ui, view);
    paint::scene(&painter, ui.visuals(), &layout, &scene, state.map.on);
    // The marker belongs to the diagram beside it, and to one pose.
    let polar = studies.shown(Topic::Polar).filter(|shown| shown.current && state.plot == Plot::Directions);
    if let Some((direction, speed)) = polar.and_then(|shown| series::worst_direction(shown.known)) {
        paint::worst(&painter, ui.visuals(), &layout, direction, &digits::like(speed, facts.share()));
    }
    if state.map.on {
        map::point(ui, &painter, &background, view, facts, commands);
    }
    runtime.holds_tip = handles::ui(ui, &painter, &layout, &scene, document, commands);
    if session.unlocked {
        handles::winches(ui, &painter, &layout, &scene, document, commands);
    }
    handles::camera(&mut session.camera, ui, &background, view, !state.map.on);
    if state.map.on {
        runtime.layer.legend(&painter, ui, rect, facts);
    } else {
        paint::legend(&painter, ui.visuals(), rect, &scene);
    }
    let legend = !state.map.on && scene.tensions.is_some();
    paint::arrow_legend(&painter, ui.visuals(), rect, layout.arrow, legend);
    map::controls(&mut state.map, &mut session.camera, ui, rect, studies, commands);
    rect
}
