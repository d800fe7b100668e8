//! Choices side by side, of which one is made.

use eframe::egui::{Align2, Rect, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo};

use crate::app::meaning::Explain as _;
use crate::app::theme;

/// A choice with what it is called and what it means.
pub(super) type Choice<T> = (T, &'static str, &'static str);

/// Draws the choices in rows of two. Gives whether another one was made.
pub(super) fn segments<T: Copy + PartialEq>(ui: &mut Ui, value: &mut T, all: &[Choice<T>], touch: bool) -> bool {
    let tokens = theme::tokens(ui.visuals());
    let font = TextStyle::Button.resolve(ui.style());
    let height = if touch { 44.0 } else { 28.0 };
    let before = *value;
    for row in all.chunks(2) {
        let (rect, ground) = ui.allocate_exact_size(Vec2::new(ui.available_width(), height), Sense::hover());
        let shown = rect.shrink2(Vec2::new(0.0, if touch { 4.0 } else { 0.0 }));
        ui.painter().rect_filled(shown, 6.0, tokens.field);
        let width = rect.width() / row.len() as f32;
        for (i, (choice, name, meaning)) in row.iter().enumerate() {
            let left = rect.min.x + width * i as f32;
            let part = Rect::from_x_y_ranges(left..=left + width, rect.y_range());
            let response = ui.interact(part, ground.id.with(name), Sense::click());
            let chosen = before == *choice;
            response.widget_info(|| WidgetInfo::selected(Role::RadioButton, true, chosen, *name));
            let inside = part.intersect(shown).shrink(2.0);
            if chosen {
                let rim = Stroke::new(1.0, tokens.line);
                ui.painter().rect(inside, 5.0, tokens.card, rim, StrokeKind::Inside);
            }
            if response.has_focus() {
                ui.painter().rect_stroke(inside, 5.0, Stroke::new(2.0, tokens.accent), StrokeKind::Inside);
            }
            let colour = if chosen || response.hovered() { tokens.text } else { tokens.weak };
            ui.painter().text(part.center(), Align2::CENTER_CENTER, name, font.clone(), colour);
            if response.clicked() {
                *value = *choice;
            }
            response.explained(*meaning);
        }
    }
    *value != before
}
