//! Names of robots: how they are shown, and the field in which they are typed.

use eframe::egui::{Role, TextEdit, Ui, WidgetInfo};

/// Longer names are not kept.
const LONGEST: usize = 200;

/// What a robot is called on the screen.
pub fn shown(name: Option<&str>) -> &str {
    name.filter(|name| !name.trim().is_empty()).unwrap_or("Unnamed robot")
}

/// A field called `label`, this wide in points. Gives the name once the field is left, where it is another one, which
/// may be empty.
pub fn field(ui: &mut Ui, label: &str, now: Option<&str>, width: f32) -> Option<String> {
    let id = ui.make_persistent_id(label);
    let now = now.unwrap_or_default();
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| now.to_owned());
    let field = ui.add(TextEdit::singleline(&mut text).hint_text("Name").char_limit(LONGEST).desired_width(width));
    field.widget_info(|| WidgetInfo {
        label: Some(label.into()),
        current_text_value: Some(text.clone()),
        ..WidgetInfo::new(Role::TextInput)
    });
    if field.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text.clone()));
    }
    if !field.lost_focus() {
        return None;
    }
    ui.data_mut(|data| data.remove::<String>(id));
    (text != now).then(|| text.trim().to_owned())
}
