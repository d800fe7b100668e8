//! What hands do before egui hears of it: nothing of a drag or of what is typed is lost when frames are slow, a finger
//! that moves up or down scrolls, whatever it began on, and keys go from region to region and out of the app.

mod focus;
mod queue;
#[cfg(target_arch = "wasm32")]
mod web;

use eframe::egui::{Context, IdSalt, LayerId, Plugin, Pos2, RawInput, Rect, Response, ScrollArea, Ui};
use focus::Focus;
use queue::Queue;

/// Registers what is in here with egui.
pub fn install(context: &Context) {
    context.add_plugin(Gestures::default());
    #[cfg(target_arch = "wasm32")]
    {
        context.add_plugin(Focus::new(Some(web::leave)));
        web::listen();
    }
    #[cfg(not(target_arch = "wasm32"))]
    context.add_plugin(Focus::new(None));
}

#[derive(Default)]
struct Gestures {
    queue: Queue,
    /// Where a finger may turn something or scroll, as far as it was drawn in this pass.
    turning: Vec<(LayerId, Rect)>,
    /// Whether a number is typed in this pass.
    number: bool,
}

impl Plugin for Gestures {
    fn debug_name(&self) -> &'static str {
        "Gestures"
    }

    fn input_hook(&mut self, context: &Context, input: &mut RawInput) {
        let turning = std::mem::take(&mut self.turning);
        #[cfg(target_arch = "wasm32")]
        let by_finger = web::is_finger();
        // Elsewhere a touch comes with its press.
        #[cfg(not(target_arch = "wasm32"))]
        let by_finger = false;
        self.queue.extend(std::mem::take(&mut input.events), by_finger);
        let turns = |at: Pos2| {
            let layer = context.layer_id_at(at);
            turning.iter().any(|(of, rect)| Some(*of) == layer && rect.contains(at))
        };
        input.events = self.queue.next(turns, context.dragged_id().is_some());
    }

    fn on_end_pass(&mut self, ui: &mut Ui) {
        if self.queue.is_waiting() {
            ui.ctx().request_repaint();
        }
        let number = std::mem::take(&mut self.number);
        #[cfg(target_arch = "wasm32")]
        web::keyboard_for(number);
        #[cfg(not(target_arch = "wasm32"))]
        let _ = number; // Only browsers have keyboards on the screen.
    }
}

/// Says that a number is typed, so that a phone shows the keyboard for numbers.
pub fn types_a_number(ui: &Ui) {
    ui.ctx().with_plugin(|gestures: &mut Gestures| gestures.number = true);
}

/// A finger on this may turn it or scroll what it is in: up and down it scrolls, sideways it turns, a tap is a tap. A
/// mouse is not concerned. To be called for everything that takes drags within something that scrolls.
pub fn scrolls_or_turns(response: &Response) {
    // A finger need not hit exactly; egui helps it by this much.
    let reach = response.ctx.global_style().interaction.interact_radius;
    let rect = response.interact_rect.expand(reach);
    response.ctx.with_plugin(|gestures: &mut Gestures| gestures.turning.push((response.layer_id, rect)));
}

/// Content that scrolls where there is not enough room for it, and takes all the room there is, no more and no less,
/// so that no content changes the size of what it is in.
pub fn scroll<R>(ui: &mut Ui, content: impl FnOnce(&mut Ui) -> R) -> R {
    const SALT: &str = "scroll";
    let room = ui.available_rect_before_wrap().intersect(ui.clip_rect());
    let swipe = ui.ctx().with_plugin(|gestures: &mut Gestures| gestures.queue.swipe()).flatten();
    if let Some(from) = swipe
        && room.contains(from)
        && ui.ctx().layer_id_at(from) == Some(ui.layer_id())
    {
        // egui's name for what is dragged when a finger drags the content.
        ui.ctx().set_dragged_id(ui.make_persistent_id(IdSalt::new(SALT)).with("area"));
    }
    let shown = ScrollArea::both().id_salt(SALT).auto_shrink(false).show(ui, content);
    // Words take drags as well, to be marked.
    let place = (ui.layer_id(), shown.inner_rect);
    ui.ctx().with_plugin(|gestures: &mut Gestures| gestures.turning.push(place));
    shown.inner
}
