//! What things mean, for those who ask: by resting on them, by a click or a tap, or by a long one where a click does
//! something already.

use eframe::egui::{Popup, PopupCloseBehavior, Response, Sense, Ui, WidgetText};

/// So wide is a meaning at most, in points.
const WIDEST: f32 = 340.0;

/// Meanings of what is on the screen.
pub trait Explain: Sized {
    /// Says what it means.
    fn explained(self, text: impl Into<WidgetText>) -> Self;
    /// Says more of what lies on something that takes the clicks, such as a table's row: to those who rest on it.
    fn explained_at_rest(self, text: impl Into<WidgetText>) -> Self;
    /// Says why it is grey, where it is.
    fn grey_because(self, ui: &Ui, text: impl Into<WidgetText>) -> Self;
}

impl Explain for Response {
    fn explained(self, text: impl Into<WidgetText>) -> Self {
        let text = text.into();
        // What can be reached by Tab does something. Labels sense clicks only to select their text.
        let acts = self.sense.is_focusable();
        let response = if acts || self.sense.senses_click() { self } else { self.interact(Sense::CLICK) };
        let asked = response.long_touched() || (!acts && response.clicked());
        show(&response, asked, text.clone());
        response.on_hover_text(text)
    }

    fn explained_at_rest(self, text: impl Into<WidgetText>) -> Self {
        self.on_hover_text(text)
    }

    fn grey_because(self, ui: &Ui, text: impl Into<WidgetText>) -> Self {
        let text = text.into();
        if !self.enabled() {
            // What is grey hears of no clicks.
            let over = ui.interact(self.interact_rect, self.id.with("grey"), Sense::CLICK);
            show(&over, over.clicked(), text.clone());
        }
        self.on_disabled_hover_text(text)
    }
}

/// Opens or closes a meaning when it is asked for, and shows it where it is open. Esc and every click close it.
fn show(response: &Response, asked: bool, text: WidgetText) {
    let id = response.id.with("meaning");
    if asked {
        Popup::toggle_id(&response.ctx, id);
    }
    let popup = Popup::from_response(response).id(id).open_memory(None);
    popup.close_behavior(PopupCloseBehavior::CloseOnClick).width(WIDEST).show(|ui| ui.label(text));
}
