//! The tour for first visitors: four tasks that finish themselves, without taking anything away from anybody.

mod place;
mod progress;

use std::time::Duration;

use eframe::egui::{
    Area, Color32, Context, CornerRadius, Frame, Id, LayerId, Order, Rect, RichText, Role, Sense, Stroke, StrokeKind,
    TextStyle, Ui, Vec2, WidgetInfo,
};

use crate::app::answers::CriticalState;
use crate::app::facts::Facts;
use crate::app::regions::Regions;
use crate::app::state::{Movement, Plot, Session, SheetTab, UiState};
use crate::app::theme;
use crate::compute::protocol::Which;
use progress::{Seen, Task, TaskStage};

pub use progress::Tour;

/// So wide is the box at most, in points.
const WIDEST: f32 = 340.0;
/// Between its edge and its content.
const MARGIN: i8 = 12;

/// What a task says: its title, what is to be done, and the praise that it ends with.
fn words(task: Task) -> (&'static str, &'static str, &'static str) {
    match task {
        Task::Drag => (
            "Drag the platform",
            "Drag the blue dot outward until the robot says that there is no equilibrium. All that you see follows it. \
             (Tab goes to the platform, and arrow keys move it.)",
            "Back again. Inside that border the cables can hold it.",
        ),
        Task::Speed => (
            "Pull the arrow",
            "The arrow is the motion: its length is the speed. Pull its tip past the tick that says critical.",
            "Faster than critical: let go at this speed, a small disturbance grows.",
        ),
        Task::Eigenvalue => (
            "Click an eigenvalue",
            "Each point is a way in which the robot vibrates: left of the line it dies out, right of it it grows. Click \
             one. (A row of Modes does the same.)",
            "The robot now moves in that way.",
        ),
        Task::Map => (
            "Open the map",
            "How fast may it move elsewhere? Press Map, in the bar at the top, or the key M.",
            "The whole workspace, coloured by critical speed. This was the tour; More has it, should you want it again.",
        ),
    }
}

/// What the first task says while the platform is outside.
const OUTSIDE: &str =
    "No equilibrium: cables can only pull, and here that does not hold the platform. Now drag it back.";

/// What a tour says now: what is to be done, or the praise.
fn say(tour: &Tour) -> &'static str {
    let (_, asked, praise) = words(tour.task());
    match tour.stage() {
        TaskStage::New | TaskStage::Asked => asked,
        TaskStage::Halfway => OUTSIDE,
        TaskStage::Done { .. } | TaskStage::Already => praise,
    }
}

/// The task on show as a text.
#[cfg(target_arch = "wasm32")]
pub fn text(session: &Session) -> Option<String> {
    let tour = session.tour.as_ref()?;
    let (title, ..) = words(tour.task());
    Some(format!("Tour, {} of {}: {title}. {}", tour.number(), Tour::TASKS.len(), say(tour)))
}

/// Sees whether the task on show is done, and draws it.
pub fn ui(state: &mut UiState, session: &mut Session, context: &Context, regions: &Regions, facts: Facts<'_>) {
    let Some(mut tour) = session.tour.take() else { return };
    if tour.stage() == TaskStage::New {
        bring_into_view(tour.task(), state, session, regions);
    }
    let time = context.input(|input| input.time);
    let mut goes_on = tour.look(seen(state, session, context, facts), time);
    if let Some(wait) = tour.next_in(time) {
        context.request_repaint_after(Duration::from_secs_f64(wait + 0.02));
    }
    let about = about(tour.task(), regions);
    goes_on &= show(&mut tour, context, about);
    session.tour = goes_on.then_some(tour);
    state.tour_taken |= session.tour.is_none();
}

/// What of the robot and of the screen the tasks ask for.
fn seen(state: &UiState, session: &Session, context: &Context, facts: Facts<'_>) -> Seen {
    let answers = facts.answers;
    let rests = match answers.critical() {
        CriticalState::Failed(failed) => failed.report.feasible,
        _ => answers.pose_is_current().then_some(true),
    };
    let above = match answers.critical() {
        CriticalState::Current(answer) => {
            let speed = facts.document.scenario.motion.speed;
            answer.critical.as_ref().is_some_and(|critical| speed > critical.speed)
        }
        _ => false,
    };
    let chosen = matches!(session.mode.which, Which::Near(_));
    let held = context.input(|input| input.pointer.any_down());
    Seen { rests, above, chosen, map: state.map.on, held }
}

/// Opens what a task needs, once: whoever goes elsewhere then is left alone.
fn bring_into_view(task: Task, state: &mut UiState, session: &mut Session, regions: &Regions) {
    session.large = None;
    match task {
        Task::Drag | Task::Map => {}
        Task::Speed => state.playback.movement = Movement::LetGo,
        Task::Eigenvalue => {
            state.sheet = SheetTab::Plots;
            state.plot = Plot::Eigenvalues;
            state.panels.right = true;
            session.present = false;
            // Where all plots are in the dock they have their place under the robot.
            if regions.plot.is_finite() && regions.plot.top() >= regions.canvas.bottom() - 1.0 {
                state.panels.dock = true;
                state.dock = Plot::Eigenvalues;
            }
        }
    }
}

/// What a task is about; this stays free.
fn about(task: Task, regions: &Regions) -> Rect {
    match task {
        Task::Eigenvalue => regions.plot,
        // The answer tells whether there is an equilibrium; where it is a line below the robot, it stays free as well.
        Task::Drag | Task::Speed | Task::Map if regions.answer.is_finite() => regions.canvas.union(regions.answer),
        Task::Drag | Task::Speed | Task::Map => regions.canvas,
    }
}

/// Draws the box of the task and a frame around what it is about. Gives whether the tour goes on.
fn show(tour: &mut Tour, context: &Context, about: Rect) -> bool {
    let visuals = context.global_style().visuals.clone();
    if about.is_positive() && about.is_finite() {
        let painter = context.layer_painter(LayerId::new(Order::Foreground, Id::unique("tour mark")));
        let stroke = Stroke::new(2.0, theme::accent(&visuals));
        painter.rect_stroke(about.shrink(2.0), CornerRadius::same(4), stroke, StrokeKind::Inside);
    }
    let id = Id::unique("tour");
    let screen = context.content_rect();
    let width = (screen.width() - 16.0).min(WIDEST);
    // As large as it was, or about as large as it will be.
    let size = context.memory(|memory| memory.area_rect(id)).map_or(Vec2::new(width, 140.0), |rect| rect.size());
    let area = Area::new(id).order(Order::Foreground).fixed_pos(place::beside(screen, about, size));
    let area = area.role(Role::Dialog).accessible_name("Tour").default_width(width);
    area.show(context, |ui| {
        let frame = Frame::window(ui.style()).inner_margin(MARGIN);
        frame.show(ui, |ui| {
            ui.set_width(width - 2.0 * f32::from(MARGIN));
            content(tour, ui)
        })
    })
    .inner
    .inner
}

/// What is done has a tick before it.
fn tick(ui: &mut Ui, colour: Color32) {
    let size = ui.text_style_height(&TextStyle::Body);
    let (place, response) = ui.allocate_exact_size(Vec2::splat(size), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Task done"));
    let at = |x: f32, y: f32| place.min + size * Vec2::new(x, y);
    ui.painter().line(vec![at(0.15, 0.55), at(0.4, 0.8), at(0.85, 0.25)], Stroke::new(2.0, colour));
}

/// The task with its buttons. Gives whether the tour goes on.
fn content(tour: &mut Tour, ui: &mut Ui) -> bool {
    let (title, ..) = words(tour.task());
    let tokens = theme::tokens(ui.visuals());
    ui.horizontal(|ui| {
        ui.heading(title);
        ui.weak(format!("{} of {}", tour.number(), Tour::TASKS.len()));
    });
    if tour.is_done() {
        ui.horizontal_wrapped(|ui| {
            tick(ui, tokens.stable);
            ui.label(RichText::new(say(tour)).color(tokens.stable));
        });
    } else {
        ui.label(say(tour));
    }
    ui.add_space(4.0);
    ui.horizontal_wrapped(|ui| {
        let done = tour.is_done();
        let last = tour.is_last();
        let mut goes_on = true;
        let next = match (done, last) {
            (true, true) => Some("Done"),
            (true, false) => Some("Next"),
            (false, false) => Some("Skip"),
            (false, true) => None,
        };
        if next.is_some_and(|next| ui.button(next).clicked()) {
            goes_on = tour.go_on();
        }
        if !tour.is_first() && ui.button("Back").clicked() {
            tour.back();
        }
        if !(done && last) && ui.button("Skip the tour").clicked() {
            goes_on = false;
        }
        goes_on
    })
    .inner
}
