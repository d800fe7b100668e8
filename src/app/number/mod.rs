//! The control of a number: shown rounded, edited with all its digits, typed as numbers, calculations and units.
//!
//! What nobody has typed is never stored: leaving the text as it is leaves the number as it is, to the last bit. What
//! cannot be read or is not allowed is told beside the control and changes nothing.

mod expression;
mod text;
mod unit;

use eframe::egui::accesskit::{Action, ActionData, Invalid, Live};
use eframe::egui::emath::smart_aim::best_in_range_f64;
use eframe::egui::text::CCursorRange;
use eframe::egui::{
    Align, Button, Context, CursorIcon, EventFilter, Id, Key, Label, Layout, Modifiers, Popup, PopupCloseBehavior,
    PopupKind, RectAlign, Response, RichText, Sense, Slider, SliderClamping, TextEdit, TextWrapMode, Ui, Vec2,
    WidgetInfo, WidgetText,
};

use crate::app::gestures;
use crate::app::meaning::Explain as _;
use crate::app::theme;

pub use text::rounded;
pub use unit::Unit;

/// Digits shown while nobody edits; fewer where they have no room.
const DIGITS: usize = 5;
/// The widest message, in points.
const MESSAGE: f32 = 300.0;

/// A number's control.
#[derive(Clone, Copy, Debug)]
pub struct Control<'a> {
    /// What messages call the number.
    pub name: &'a str,
    /// The unit that it is shown in, and typed in where none is given.
    pub unit: Unit,
    /// By how much it changes per point that it is dragged, and per press of an arrow key, in `unit`.
    pub step: f64,
    /// The control's size in points; no number changes it.
    pub size: Vec2,
}

/// What a control says in one frame.
#[derive(Debug)]
pub struct NumberResponse {
    /// The control.
    pub response: Response,
    /// The number that was typed or dragged, as it is stored.
    pub value: Option<f64>,
    /// The text that it comes from, where the control would keep the focus if it is refused.
    typed: Option<Typing>,
}

impl NumberResponse {
    /// Tells beside the control why its number is refused. Who has pressed Enter can go on with the text.
    pub fn refuse(self, ui: &Ui, reason: String) {
        refuse(ui.ctx(), self.response.id, self.typed.as_ref(), reason);
    }
}

/// A text under way.
#[derive(Clone, Debug, PartialEq)]
struct Typing {
    id: Id,
    text: String,
    /// The text at first, which stands for the number as it is.
    first: String,
    /// The number as it is.
    value: u64,
    /// The last text that was refused.
    refused: Option<String>,
}

/// A message beside a control.
#[derive(Clone, Debug)]
struct Refusal {
    id: Id,
    reason: String,
}

/// One text at a time is under way, since one control has the focus.
fn typing_id() -> Id {
    Id::unique("text of a number under way")
}

/// One message at a time is on show: the last.
fn refusal_id() -> Id {
    Id::unique("message beside a number")
}

/// The message on show.
#[cfg(target_arch = "wasm32")]
pub fn message(context: &Context) -> Option<String> {
    context.data(|data| data.get_temp::<Refusal>(refusal_id())).map(|refusal| refusal.reason)
}

/// Takes the message off the screen, since what it was about has changed.
pub fn forget_message(context: &Context) {
    context.data_mut(|data| data.remove::<Refusal>(refusal_id()));
}

fn forget_message_of(context: &Context, id: Id) {
    if context.data(|data| data.get_temp::<Refusal>(refusal_id())).is_some_and(|refusal| refusal.id == id) {
        forget_message(context);
    }
}

fn refuse(context: &Context, id: Id, typed: Option<&Typing>, reason: String) {
    context.data_mut(|data| {
        data.insert_temp(refusal_id(), Refusal { id, reason });
        if let Some(typing) = typed {
            let refused = Some(typing.text.clone());
            data.insert_temp(typing_id(), Typing { refused, ..typing.clone() });
        }
    });
    if typed.is_some() {
        context.memory_mut(|memory| memory.request_focus(id));
    }
    context.request_repaint();
}

impl Control<'_> {
    /// Draws the control of the stored number `value`.
    pub fn show(&self, ui: &mut Ui, value: f64) -> NumberResponse {
        let layout = Layout::centered_and_justified(ui.layout().main_dir());
        let answer = ui.allocate_ui_with_layout(self.size, layout, |ui| {
            ui.set_min_size(self.size);
            self.inside(ui, value)
        });
        let answer = answer.inner;
        gestures::scrolls_or_turns(&answer.response);
        if let Some(refusal) = ui.data(|data| data.get_temp::<Refusal>(refusal_id()))
            && refusal.id == answer.response.id
        {
            tell(ui, &answer.response, &refusal.reason);
        }
        answer
    }

    fn inside(&self, ui: &mut Ui, value: f64) -> NumberResponse {
        // The same for the text and for the button in its place.
        let id = ui.next_auto_id();
        let layer = ui.layer_id();
        let has_focus = ui.is_enabled()
            && ui.memory_mut(|memory| {
                memory.interested_in_focus(id, layer);
                memory.has_focus(id)
            });
        let typing = ui.data(|data| data.get_temp::<Typing>(typing_id())).filter(|typing| typing.id == id);
        let mut answer = if has_focus {
            self.text(ui, id, value, typing)
        } else {
            // The focus may have gone elsewhere between two frames.
            let left = typing.and_then(|typing| self.end(ui, &typing, value, false));
            let mut answer = self.button(ui, id, value);
            answer.value = answer.value.or(left);
            answer
        };
        if let Some(value) = self.assistive(ui, id, value) {
            answer.value = Some(value);
        }
        self.describe(ui, &answer.response, value, has_focus);
        answer
    }

    /// The number as it is shown: with as many digits as there is room for.
    fn short(&self, ui: &Ui, value: f64) -> String {
        let shown = self.unit.shown(value);
        let room = self.size.x - 2.0 * ui.spacing().button_padding.x;
        let written = |digits| self.unit.with_name(&text::rounded(shown, digits));
        let fits = |text: &String| {
            let text = WidgetText::from(text.as_str());
            let style = ui.style().drag_value_text_style.clone();
            text.into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, style).size().x <= room
        };
        (3..=DIGITS).rev().map(written).find(fits).unwrap_or_else(|| written(2))
    }

    /// Lets the text be edited.
    fn text(&self, ui: &mut Ui, id: Id, value: f64, typing: Option<Typing>) -> NumberResponse {
        let begun = typing.filter(|typing| typing.value == value.to_bits());
        let is_new = begun.is_none();
        let mut typing = begun.unwrap_or_else(|| {
            let first = self.unit.full(value);
            Typing { id, text: first.clone(), first, value: value.to_bits(), refused: None }
        });
        if is_new {
            forget_message_of(ui.ctx(), id);
        }
        let escaped = ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        let steps = ui.input_mut(|input| {
            input.count_and_consume_key(Modifiers::NONE, Key::ArrowUp) as f64
                - input.count_and_consume_key(Modifiers::NONE, Key::ArrowDown) as f64
        });
        let before = typing.text.clone();
        // One letter more than is read, so that a text cut short is not taken for a number.
        let edit = TextEdit::singleline(&mut typing.text)
            .id(id)
            .clip_text(true)
            .char_limit(expression::LONGEST + 1)
            .align(ui.layout().align2())
            .desired_width(self.size.x)
            .font(ui.style().drag_value_text_style.clone())
            .event_filter(EventFilter { horizontal_arrows: true, vertical_arrows: true, tab: false, escape: true });
        if is_new {
            // Ahead of the letters that have come meanwhile, which take the place of what is marked.
            let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
            state.cursor.set_char_range(Some(CCursorRange::select_all_str(&before)));
            state.store(ui.ctx(), id);
        }
        gestures::types_a_number(ui);
        let response = ui.add(edit);
        if typing.text != before {
            typing.refused = None;
            forget_message_of(ui.ctx(), id);
        }
        let mut answer = NumberResponse { response, value: None, typed: None };
        if escaped {
            ui.memory_mut(|memory| memory.surrender_focus(id));
            ui.data_mut(|data| data.remove::<Typing>(typing_id()));
            forget_message_of(ui.ctx(), id);
        } else if answer.response.lost_focus() {
            let entered = ui.input(|input| input.key_pressed(Key::Enter));
            answer.typed = entered.then(|| typing.clone());
            answer.value = self.end(ui, &typing, value, entered);
        } else {
            ui.data_mut(|data| data.insert_temp(typing_id(), typing.clone()));
            if steps != 0.0 {
                // From what is typed, if something is.
                let from = if typing.text.trim() == typing.first {
                    Ok(value)
                } else {
                    expression::read(&typing.text, self.name, self.unit)
                };
                match from {
                    Ok(from) => answer.value = Some(self.stepped(from, steps)),
                    Err(reason) => refuse(ui.ctx(), id, Some(&typing), reason),
                }
            }
        }
        answer
    }

    /// The text is done: the number that it means, if it is another text than at first.
    fn end(&self, ui: &Ui, typing: &Typing, value: f64, entered: bool) -> Option<f64> {
        ui.data_mut(|data| data.remove::<Typing>(typing_id()));
        let is_told = !entered && typing.refused.as_ref() == Some(&typing.text);
        // Another number by now, as by undo: the text is about one that is gone.
        if is_told || typing.value != value.to_bits() || typing.text.trim() == typing.first {
            forget_message_of(ui.ctx(), typing.id);
            return None;
        }
        match expression::read(&typing.text, self.name, self.unit) {
            Ok(value) => Some(value),
            Err(reason) => {
                refuse(ui.ctx(), typing.id, entered.then_some(typing), reason);
                None
            }
        }
    }

    /// Shows the number; a click edits it, dragging changes it.
    fn button(&self, ui: &mut Ui, id: Id, value: f64) -> NumberResponse {
        let short = self.short(ui, value);
        let style = ui.style().drag_value_text_style.clone();
        let button = Button::new(RichText::new(&short).text_style(style))
            .wrap_mode(TextWrapMode::Truncate)
            .sense(Sense::click_and_drag())
            .min_size(self.size);
        let mut response = ui.add(button).on_hover_cursor(CursorIcon::ResizeHorizontal);
        let full = self.unit.with_name(&self.unit.full(value));
        if full != short {
            response = response.explained(full);
        }
        if response.clicked() {
            ui.memory_mut(|memory| memory.request_focus(id));
        }
        let value = self.dragged(ui, &response, value);
        NumberResponse { response, value, typed: None }
    }

    /// The number where it is dragged to, to the right or up.
    fn dragged(&self, ui: &Ui, response: &Response, value: f64) -> Option<f64> {
        if ui.input(|input| input.pointer.any_pressed() || input.pointer.any_released()) {
            ui.data_mut(|data| data.remove::<f64>(response.id));
        }
        if !response.dragged() {
            return None;
        }
        ui.set_cursor_icon(CursorIcon::ResizeHorizontal);
        let moved = response.drag_delta();
        let points = f64::from(moved.x - moved.y);
        if points == 0.0 {
            return None;
        }
        let step = if ui.input(|input| input.modifiers.shift_only()) { 0.1 * self.step } else { self.step };
        // Kept with all its digits, or slow movement would be rounded away.
        let exact = ui.data(|data| data.get_temp::<f64>(response.id)).unwrap_or(self.unit.shown(value));
        let exact = exact + points * step;
        ui.data_mut(|data| data.insert_temp(response.id, exact));
        Some(self.unit.to_stored(best_in_range_f64(exact - step, exact + step)))
    }

    /// Steps of an arrow key further, to a number with few digits.
    pub fn stepped(&self, value: f64, steps: f64) -> f64 {
        let there = self.unit.shown(value) + steps * self.step;
        self.unit.to_stored(best_in_range_f64(there - 0.1 * self.step, there + 0.1 * self.step))
    }

    /// What screen readers and other tools ask for.
    fn assistive(&self, ui: &Ui, id: Id, value: f64) -> Option<f64> {
        let (steps, typed) = ui.input(|input| {
            let count = |action| input.num_accesskit_action_requests(id, action) as f64;
            let typed =
                input.accesskit_action_requests(id, Action::SetValue).last().and_then(|request| match &request.data {
                    Some(ActionData::NumericValue(value)) => Some(Ok(*value)),
                    Some(ActionData::Value(text)) => Some(Err(text.to_string())),
                    _ => None,
                });
            (count(Action::Increment) - count(Action::Decrement), typed)
        });
        match typed {
            Some(Ok(number)) => Some(self.unit.to_stored(number)),
            Some(Err(text)) => match expression::read(&text, self.name, self.unit) {
                Ok(value) => Some(value),
                Err(reason) => {
                    refuse(ui.ctx(), id, None, reason);
                    None
                }
            },
            None if steps != 0.0 => Some(self.stepped(value, steps)),
            None => None,
        }
    }

    fn describe(&self, ui: &Ui, response: &Response, value: f64, edited: bool) {
        let shown = self.unit.shown(value);
        response.widget_info(|| WidgetInfo::drag_value(ui.is_enabled(), shown));
        let refused = ui.data(|data| data.get_temp::<Refusal>(refusal_id())).filter(|it| it.id == response.id);
        // Measured before, since nothing else may be asked for while the node is written.
        let short = self.short(ui, value);
        ui.ctx().accesskit_node_builder(response.id, |node| {
            node.clear_label();
            node.set_numeric_value_step(self.step);
            for action in [Action::SetValue, Action::Increment, Action::Decrement] {
                node.add_action(action);
            }
            if !edited {
                node.set_value(short);
            }
            if let Some(refusal) = &refused {
                node.set_invalid(Invalid::True);
                node.set_description(refusal.reason.clone());
            }
        });
    }
}

/// A slider, whose equal steps are equal ratios, with its number and its name, which says what it means. The number, `value` as it is stored, must
/// be within `range`, given in the control's unit.
pub fn slider(ui: &mut Ui, control: &Control<'_>, meaning: &str, value: &mut f64, range: [f64; 2]) {
    let [low, high] = range;
    let before = control.unit.shown(*value);
    let mut shown = before;
    let slider = Slider::new(&mut shown, low..=high).logarithmic(true).show_value(false);
    let slider = ui.add(slider.clamping(SliderClamping::Never));
    gestures::scrolls_or_turns(&slider);
    let mut answer = control.show(ui, *value);
    let name = ui.label(control.name).explained(meaning);
    slider.labelled_by(name.id);
    answer.response = answer.response.labelled_by(name.id);
    if shown.total_cmp(&before).is_ne() {
        *value = control.unit.to_stored(shown);
    }
    if let Some(typed) = answer.value {
        // A hand that drags stops at the end; what is typed is not changed.
        let shown = control.unit.shown(typed);
        if answer.response.dragged() {
            *value = control.unit.to_stored(shown.clamp(low, high));
        } else if (low..=high).contains(&shown) {
            *value = typed;
        } else {
            let [low, high] = range.map(|end| control.unit.with_name(&brief(end)));
            answer.refuse(ui, format!("{} must be from {low} to {high}", control.name));
        }
    }
}

/// Shows a message under a control, over what is there, so that nothing moves.
fn tell(ui: &Ui, control: &Response, reason: &str) {
    if !ui.is_rect_visible(control.rect) {
        return;
    }
    let room = (control.rect.right() - ui.clip_rect().left() - 16.0).clamp(120.0, MESSAGE);
    Popup::new(control.id.with("message"), ui.ctx().clone(), control.rect, control.layer_id)
        .kind(PopupKind::Tooltip)
        .close_behavior(PopupCloseBehavior::IgnoreClicks)
        .align(RectAlign::BOTTOM_END)
        .anchor_widget(control.id)
        .interactable(false)
        .gap(3.0)
        .width(room)
        .show(|ui| {
            ui.set_max_width(room);
            ui.with_layout(Layout::left_to_right(Align::Min), |ui| {
                let text = RichText::new(format!("▲ {reason}")).color(theme::warning(ui.visuals()));
                let label = ui.add(Label::new(text).wrap());
                ui.ctx().accesskit_node_builder(label.id, |node| node.set_live(Live::Assertive));
            });
        });
}

/// A number with five digits, for sentences.
pub fn brief(value: f64) -> String {
    text::rounded(value, DIGITS)
}
