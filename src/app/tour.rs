//! The tour for first visitors: what there is, one thing at a time, without taking anything away from them.

use eframe::egui::{
    Align2, Area, Context, CornerRadius, Frame, Id, LayerId, Order, Rect, RichText, Stroke, StrokeKind,
};

use crate::app::regions::Regions;
use crate::app::state::{Page, Session, UiState};
use crate::app::theme;

/// What a step is about.
#[derive(Clone, Copy)]
enum Part {
    Canvas,
    Answer,
    Plots,
    Controls,
    All,
}

/// Title, text, and what they are about.
const STEPS: [(&str, &str, Part); 6] = [
    (
        "Grab the platform",
        "Drag the blue dot: everything you see follows. The cables hang as they truly do, coloured by their tension.",
        Part::Canvas,
    ),
    ("The arrow is the motion", "Drag its tip to choose direction and speed.", Part::Canvas),
    (
        "The answer",
        "Above the critical speed a vibration grows by itself. Here is that speed, how it is lost, and which cable is \
         to blame.",
        Part::Answer,
    ),
    ("Look closer", "Every plot says what it shows. Click an eigenvalue: its mode moves on the canvas.", Part::Plots),
    (
        "Turn the knobs",
        "Slide or type any value, or choose another robot. ↺ takes a value back, Undo takes all back.",
        Part::Controls,
    ),
    (
        "The whole workspace",
        "Map, in the canvas's corner, colours every pose by its critical speed. Share makes a link to what you see. The \
         tour is in Help, should you want it again.",
        Part::All,
    ),
];

/// The step on show as a text.
#[cfg(target_arch = "wasm32")]
pub fn text(session: &Session) -> Option<String> {
    let (title, text, _) = STEPS[session.tour?.min(STEPS.len() - 1)];
    Some(format!("{title}. {text}"))
}

/// Draws the step on show.
pub fn ui(state: &mut UiState, session: &mut Session, context: &Context, regions: &Regions) {
    let Some(step) = session.tour else { return };
    let (title, text, part) = STEPS[step.min(STEPS.len() - 1)];
    // On a narrow screen plots and controls share their place.
    match part {
        Part::Plots => state.page = Page::Plots,
        Part::Controls => state.page = Page::Controls,
        _ => {}
    }
    let place = match part {
        Part::Canvas => regions.canvas,
        Part::Answer => regions.answer,
        Part::Plots => regions.plot,
        Part::Controls => regions.controls,
        Part::All => context.content_rect(),
    };
    let visuals = context.global_style().visuals.clone();
    let painter = context.layer_painter(LayerId::new(Order::Foreground, Id::unique("tour mark")));
    let stroke = Stroke::new(2.0, theme::accent(&visuals));
    painter.rect_stroke(place.shrink(2.0), CornerRadius::same(4), stroke, StrokeKind::Inside);
    let bottom = bottom(context.content_rect(), regions.canvas);
    let width = (bottom.width() - 24.0).min(380.0);
    let area = Area::new(Id::unique("tour")).order(Order::Foreground).pivot(Align2::CENTER_BOTTOM);
    area.fixed_pos(bottom.center_bottom() - eframe::egui::Vec2::new(0.0, 12.0)).show(context, |ui| {
        Frame::popup(ui.style()).inner_margin(12).show(ui, |ui| {
            ui.set_width(width);
            ui.label(RichText::new(title).strong().size(16.0));
            ui.label(text);
            ui.horizontal(|ui| {
                let last = step + 1 == STEPS.len();
                if ui.button(if last { "Done" } else { "Next" }).clicked() {
                    session.tour = (!last).then_some(step + 1);
                }
                if step > 0 && ui.button("Back").clicked() {
                    session.tour = Some(step - 1);
                }
                if !last && ui.button("Skip the tour").clicked() {
                    session.tour = None;
                }
                ui.weak(format!("{} of {}", step + 1, STEPS.len()));
            });
        });
    });
    state.tour_taken |= session.tour.is_none();
}

/// Where the step is shown: low on a wide screen's canvas, at the foot of a narrow screen.
fn bottom(screen: Rect, canvas: Rect) -> Rect {
    if canvas.width() < 0.9 * screen.width() { canvas } else { screen }
}
