//! The robot, drawn and dragged: model (what there is), layout (where it is on the screen), what paints and says it,
//! handles, and the map under it.

mod arrow;
mod cables;
mod flight;
mod handles;
mod labels;
mod layout;
mod legend;
pub mod map;
mod model;
mod paint;
mod path;
mod range;
mod release;
mod trouble;
mod velocity;
mod view;

use eframe::egui::{self, Align, Painter, Rect, Sense, Stroke, TextStyle, Ui, Vec2};

pub use eframe::egui::epaint::MarginF32 as Insets;

use arrow::Arrow;
use handles::Held;
use labels::{LabelRoom, Pen};
use layout::{Before, Layout};
pub use map::named;
pub use model::{Scene, advance, frame, step};
use paint::Look;
use range::KeptRange;
pub use view::View;

use crate::app::answers::CriticalState;
use crate::app::command::Command;
use crate::app::facts::Facts;
use crate::app::state::{Camera, Plot, Session, UiState};
use crate::app::{digits, series, theme};
use crate::compute::protocol::{Revision, Topic};
use crate::robot::BoundingBox;
use crate::scenario::Scenario;

/// A critical speed that has been recomputed for longer than this, in s, is shown as an old one. Before that it would only
/// flicker.
const PATIENCE: f64 = 0.3;
/// A canvas that is narrower than this, in points, has few words.
const NARROW: f32 = 480.0;
/// A corner that is at least this wide, in points, has room for the button that fits the view beside the map's legend.
const WIDE: f32 = 280.0;
/// Below its top the legend takes so much, in points.
const LEGEND: f32 = 60.0;
/// The map's legend takes so much of a picture, in points.
const MAP_KEY: f32 = 100.0;
/// Room on the left of a picture's legend, in points.
const PICTURE_MARGIN: f32 = 16.0;
/// Room around the button that fits the view, in points.
const ROOM: f32 = 8.0;

/// How much of the canvas is free.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools)] // They know nothing of each other.
pub struct Space {
    /// How far something else reaches into the canvas from its sides, in points: the workspace keeps clear of that.
    pub insets: Insets,
    /// Where the legend and the button that fits the view go.
    pub corner: Rect,
    /// On a phone: small letters, and nothing that can be read elsewhere.
    pub compact: bool,
    /// Whether there is a legend.
    pub legend: bool,
    /// Whether the line through the pose goes down to the plot under the canvas.
    pub pose_line: bool,
    /// For a picture: nothing to press.
    pub picture: bool,
}

/// What the canvas keeps from frame to frame.
#[derive(Default)]
pub struct Runtime {
    /// The map from world to screen of the last frame: what is under the canvas shares its x axis.
    pub view: Option<View>,
    /// Pictures made of studies.
    layer: map::Layer,
    /// What was the frame when the pointer was pressed, else what it is.
    frame: Option<BoundingBox>,
    /// The arrow of the last frame.
    arrow: Option<Arrow>,
    /// What was held then.
    held: Held,
    /// The range of the tensions' colours.
    range: KeptRange<Scenario>,
    /// Which state the critical speed on show belongs to, where that is an earlier one, and since when it has been, in s.
    old: Option<(Option<Revision>, f64)>,
}

impl Runtime {
    /// What a picture begins with, so that its colours mean what those on the screen mean.
    pub fn for_picture(&self) -> Self {
        Self { layer: self.layer.for_picture(), range: self.range.clone(), old: self.old, ..Self::default() }
    }
}

/// Draws the canvas in all the room there is, and turns drags, clicks and keys into commands. Gives where it is.
pub fn ui(
    runtime: &mut Runtime,
    state: &mut UiState,
    session: &mut Session,
    ui: &mut Ui,
    facts: Facts<'_>,
    space: Space,
    commands: &mut Vec<Command>,
) -> Rect {
    let Facts { document, answers, studies, .. } = facts;
    let (rect, background) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    background.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Robot canvas"));
    let mut scene = Scene::new(&document.scenario, answers, &state.playback);
    let flight = flight::Shown::new(&state.playback, facts);
    if let Some(flight) = &flight {
        scene.fly(&flight.instant);
    }
    let layout = lay_out(runtime, ui, rect, space, session.camera, &scene);
    let view = &layout.view;
    let mut painter = ui.painter_at(rect);
    painter.set_clip_rect(rect.intersect(ui.clip_rect()));
    paint::background(&painter, ui.visuals(), view);
    runtime.layer.update(ui, facts, state.map);
    let lines = cables::lines(&layout, &scene);
    let farthest = layout.mark(scene.farthest_mark).map_or(layout.tip, |mark| mark.at);
    let arrow = if flight.is_some() { Vec::new() } else { vec![layout.platform, farthest] };
    let taken = map::Taken { lines: lines.iter().cloned().chain([arrow]).collect(), areas: vec![space.corner] };
    runtime.layer.paint(&painter, ui, view, &taken);
    let mut pen = pen(ui, &painter, rect, space);
    let with_border = runtime.held.platform || scene.trouble.is_some();
    if with_border {
        runtime.layer.border(&painter, ui.visuals(), view);
    }
    let with_border = with_border && studies.shown(Topic::Border).is_some();
    if space.pose_line {
        let ends = [layout.platform, egui::Pos2::new(layout.platform.x, rect.max.y)];
        paint::dashed(&painter, ends, Stroke::new(1.5, pen.tokens.accent), [5.0, 4.0]);
    }
    for line in &lines {
        pen.places.add_line(line);
    }
    // Over a map the pointer asks for the map's values.
    let pointed = if state.map.on { None } else { cables::under_pointer(&background, &lines) };
    if let Some(cable) = pointed.and_then(|cable| scene.cables.get(cable)) {
        paint::hovered(&painter, view, cable, pen.tokens);
    }
    let largest = scene.largest_force();
    let forces = largest.map(|largest| [0.0, largest]);
    // Until another robot's forces are known, those on show belong to the robot before.
    let range = if answers.pose_is_current() || runtime.range.kept().is_none() {
        runtime.range.update(&document.original, forces, answers.pose_is_current())
    } else {
        runtime.range.kept()
    };
    let strongest = range.map_or(0.0, |[_, strongest]| strongest);
    let look = Look { over_map: state.map.on, strongest, compact: space.compact && rect.width() < NARROW };
    paint::grid(&pen, view, &scene);
    let path = path::PathOnCanvas::new(&document.scenario, view);
    if let Some(path) = &path {
        path.paint(&mut pen, look.compact, &series::margins(facts));
    }
    if let Some(flight) = &flight {
        flight::under(&mut pen, view, flight, facts.flying.time);
    }
    paint::scene(&mut pen, ui.visuals(), &layout, &scene, look);
    if let Some(flight) = &flight {
        let under = if space.legend { space.corner.min.y + flight::UNDER_LEGEND } else { rect.min.y + 8.0 };
        flight::over(&mut pen, ui, view, rect, under, flight);
    } else {
        velocity::ui(&mut pen, &layout, &scene, said(runtime, ui, &scene, look, facts));
        trouble::ui(&mut pen, &layout, &scene);
    }
    paint::responsible(&mut pen, &layout, &scene, look);
    // The marker belongs to the diagram beside it, and to one pose.
    let polar = studies.shown(Topic::Directions).filter(|shown| shown.current && state.plot == Plot::Directions);
    let polar = polar.filter(|_| flight.is_none());
    if let Some((direction, speed)) = polar.and_then(|shown| series::worst_direction(shown.known)) {
        velocity::worst(&mut pen, &layout, direction, &digits::like(speed, facts.share()));
    }
    if with_border {
        trouble::border_words(&mut pen, &layout, &scene);
    }
    if session.labels {
        cables::labels(&mut pen, &lines, &scene);
    }
    cables::ui(ui, &lines, &scene, rect, pointed);
    if state.map.on {
        map::point(ui, &painter, &background, view, facts, commands);
    }
    let on_path = flight.is_none() && path.as_ref().is_some_and(|path| path.is_under_pointer(&background));
    // Nothing is dragged in a flight.
    if !space.picture && flight.is_none() {
        let before = document.scenario.path.is_some();
        let edited = path::handles(ui, &painter, &layout, path.as_ref(), &background, facts);
        if let Some(edited) = edited {
            state.sections.path |= edited.path.is_some() && !before;
            commands.push(Command::Edit(Box::new(edited)));
        }
    }
    runtime.held =
        if flight.is_some() { Held::default() } else { handles::ui(ui, &painter, &layout, &scene, document, commands) };
    if session.unlocked && flight.is_none() {
        handles::winches(ui, &painter, &layout, &scene, document, commands);
    }
    let wheel_zooms = !session.embedded;
    handles::camera(&mut session.camera, ui, &background, view, !state.map.on && !on_path, wheel_zooms);
    key(runtime, state, ui, (rect, space), [strongest, largest.unwrap_or(0.0)], facts, commands);
    if !space.picture {
        fit(runtime, &mut session.camera, ui, rect, space, state.map.on);
    }
    rect
}

/// What the colours mean, and with a map what it shows.
fn key(
    runtime: &mut Runtime,
    state: &mut UiState,
    ui: &mut Ui,
    (rect, space): (Rect, Space),
    forces: [f64; 2],
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    if state.map.on && space.picture {
        map::key(&runtime.layer, state.map, ui, space.corner, facts);
    } else if state.map.on {
        map::controls(&mut runtime.layer, &mut state.map, ui, space.corner, facts, commands);
    } else if space.legend {
        let at_left = space.corner.center().x < rect.center().x;
        let painter = ui.painter_at(rect);
        let font = TextStyle::Small.resolve(ui.style());
        legend::tensions(&painter, ui.visuals(), &font, space.corner, at_left, forces);
    }
}

/// Draws what is on the canvas for a picture, in all the room there is, with the colours' ranges that are on the screen.
pub fn picture(runtime: &mut Runtime, state: &UiState, session: &Session, ui: &mut Ui, facts: Facts<'_>) {
    let room = ui.available_rect_before_wrap();
    let top = if state.map.on { MAP_KEY } else { LEGEND };
    let corner = Rect::from_min_max(
        room.min + Vec2::new(PICTURE_MARGIN, 0.0),
        egui::Pos2::new(room.center().x, room.min.y + top),
    );
    let space = Space {
        insets: Insets { top, ..Insets::default() },
        corner,
        compact: false,
        legend: true,
        pose_line: false,
        picture: true,
    };
    let (mut state, mut session) = (state.clone(), session.clone());
    session.unlocked = false;
    self::ui(runtime, &mut state, &mut session, ui, facts, space, &mut Vec::new());
}

/// Puts the scene on the screen. Nothing of that depends on whether the pose has an equilibrium, or it would jump.
fn lay_out(runtime: &mut Runtime, ui: &Ui, rect: Rect, space: Space, camera: Camera, scene: &Scene) -> Layout {
    // The frame follows the winches, but not while one is dragged: the ground would move under the pointer.
    let pressed = ui.input(|input| input.pointer.any_down());
    let frame = runtime.frame.filter(|_| pressed).unwrap_or(scene.frame);
    runtime.frame = Some(frame);
    let view = View::new(rect, space.insets, frame, camera);
    let before = Before { arrow: runtime.arrow, pressed, held: runtime.held.tip };
    let layout = Layout::new(view, rect - space.insets, scene, before);
    (runtime.arrow, runtime.view) = (Some(layout.arrow), Some(view));
    layout
}

fn pen<'a>(ui: &Ui, painter: &'a Painter, rect: Rect, space: Space) -> Pen<'a> {
    let mut font = TextStyle::Small.resolve(ui.style());
    if space.compact {
        font.size -= 1.0;
    }
    let mut places = LabelRoom::new(rect.shrink(4.0));
    if space.legend {
        places.keep_free(space.corner);
    }
    Pen { painter, tokens: theme::tokens(ui.visuals()), font, places }
}

/// The speeds on the arrow's line in words, with the digits that are certain.
fn said(runtime: &mut Runtime, ui: &Ui, scene: &Scene, look: Look, facts: Facts<'_>) -> velocity::Said {
    let now = ui.input(|input| input.time);
    let recomputing = matches!(facts.answers.critical(), CriticalState::Recomputing { .. });
    // In a drag one follows the other: none of them is old.
    let of = facts.answers.critical_revision();
    runtime.old = recomputing.then(|| runtime.old.filter(|(before, _)| *before == of).unwrap_or((of, now)));
    let is_old = runtime.old.is_some_and(|(_, since)| now - since > PATIENCE);
    if recomputing && !is_old {
        ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(PATIENCE));
    }
    let critical = scene.critical.map_or(String::new(), |first| {
        let speed = digits::certain(first.speed, facts.certainty.speed());
        if is_old { format!("critical was {speed}") } else { format!("critical {speed}") }
    });
    let waves = scene.waves.filter(|_| !look.compact);
    let waves = waves.map_or(String::new(), |speed| format!("waves {}", digits::like(speed, facts.share())));
    velocity::Said { speed: handles::speed(scene.speed), critical, is_old, waves }
}

/// The button that brings everything into view: always where there is room for it, else where something is out of view.
fn fit(runtime: &mut Runtime, camera: &mut Camera, ui: &mut Ui, rect: Rect, space: Space, over_map: bool) {
    let pressed = if space.compact || !space.legend {
        let height = if space.compact { 44.0 } else { 32.0 };
        let room = Rect::from_min_max(rect.min, rect.max - Vec2::splat(ROOM));
        let at_foot = egui::Layout::right_to_left(Align::Max);
        *camera != Camera::default() && legend::fit(ui, room, at_foot, false, height)
    } else {
        // Beside the map's legend, where there is room for both, else under the map's controls; under the other legend.
        let down = if over_map && space.corner.width() >= WIDE {
            0.0
        } else if over_map {
            space.corner.height()
        } else {
            LEGEND
        };
        let under = space.corner.translate(Vec2::new(0.0, down));
        legend::fit(ui, under, egui::Layout::right_to_left(Align::Min), true, 28.0)
    };
    if pressed {
        *camera = Camera::default();
        runtime.range.fit();
    }
}
