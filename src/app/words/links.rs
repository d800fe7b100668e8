//! Words in running text that open their card.

use eframe::egui::{
    CursorIcon, Label, Rect, Response, Role, Sense, Shape, Stroke, TextStyle, Ui, Vec2, WidgetInfo, epaint,
};

use super::word::Word;
use crate::app::command::Command;
use crate::app::theme;

/// A text that opens the card of a word. Resting on it shows the first sentence of what the word means.
pub fn link(ui: &mut Ui, word: Word, text: &str, commands: &mut Vec<Command>) -> Response {
    let (position, galley, response) = Label::new(text).sense(Sense::click()).selectable(false).layout_in_ui(ui);
    let rows: Vec<Rect> =
        galley.rows.iter().map(|row| row.rect_without_leading_space().translate(position.to_vec2())).collect();
    let colour = theme::tokens(ui.visuals()).accent_text;
    ui.painter().add(epaint::TextShape::new(position, galley, colour));
    let response = finished(ui, word, text, response, &rows);
    if response.clicked() {
        commands.push(Command::ExplainWord(word));
    }
    response
}

/// The same alone on its ground, as high as other controls: in lists, where a finger has to find it.
pub(super) fn in_list(ui: &mut Ui, word: Word, text: &str) -> Response {
    let colour = theme::tokens(ui.visuals()).accent_text;
    let font = TextStyle::Body.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(text.into(), font, colour);
    let size = Vec2::new(galley.size().x, galley.size().y.max(ui.spacing().interact_size.y));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let place = Rect::from_center_size(rect.center(), galley.size());
    ui.painter().galley(place.min, galley, colour);
    finished(ui, word, text, response, &[place])
}

/// What both have: a dotted line below, which is a whole one while the pointer or the keyboard is there, a name, and what
/// is told at rest.
fn finished(ui: &Ui, word: Word, text: &str, response: Response, rows: &[Rect]) -> Response {
    response.widget_info(|| WidgetInfo::labeled(Role::Link, ui.is_enabled(), text));
    let colour = theme::tokens(ui.visuals()).accent_text;
    for row in rows {
        let line = [row.left_bottom(), row.right_bottom()];
        if response.has_focus() {
            ui.painter().line_segment(line, Stroke::new(2.5, colour));
        } else if response.hovered() {
            ui.painter().line_segment(line, Stroke::new(1.0, colour));
        } else {
            ui.painter().extend(Shape::dotted_line(&line, colour, 3.0, 0.7));
        }
    }
    response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(word.first_sentence())
}
