//! Ropes: a construction and a diameter in the place of E, A and μ.

use eframe::egui::{Align, Label, Layout, Sense, Ui, Vec2};

use super::rows::{EditedScenario, NUMBER, NUMBER_FOR_FINGERS, list};
use crate::app::fields;
use crate::app::meaning::Explain as _;
use crate::app::number::{self, Control, NumberResponse, Unit};
use crate::scenario::json::Material;
use crate::scenario::ropes::{Construction, Rope};

/// What the list means.
const CONSTRUCTION: &str = "A construction and a diameter set E, A and μ to values that are typical of such ropes \
                            (docs/ropes.md). The maker's data sheet comes first: type its values in the rows below.";
/// What the diameter means.
const DIAMETER: &str =
    "The rope's diameter, as it is sold. Less than its circle carries load: A is the area of wires or fibres.";

/// A rope in words, where the material is that of one.
pub(super) fn name(material: &Material) -> Option<String> {
    let rope = Rope::of(material)?;
    let unit = Unit::of("mm");
    let diameter = unit.with_name(&number::rounded(unit.shown(rope.diameter), 4));
    Some(format!("{}, {diameter}", rope.construction.name()))
}

/// The rope of all cables, or of one cable alone.
pub(super) fn ui(ui: &mut Ui, sheet: &mut EditedScenario<'_>, cable: Option<usize>) {
    let material = cable.map_or(sheet.edited.cable, |cable| sheet.edited.material_of(cable));
    let of = cable.map_or_else(String::new, |cable| format!(" of cable {}", cable + 1));
    let now = Rope::of(&material);
    let mut construction = now.map(|rope| rope.construction);
    let mut all: Vec<_> = Construction::ALL.map(|each| (Some(each), each.name().to_owned())).into();
    if now.is_none() {
        all.insert(0, (None, "own values".to_owned()));
    }
    let chosen = line(ui, sheet.touch, "Construction", CONSTRUCTION, |ui| {
        list(ui, &format!("Construction{of}"), &mut construction, &all, 118.0)
    });
    if let Some(construction) = construction.filter(|_| chosen.0) {
        let like = Rope::like(construction, material.area);
        let rope = now.map_or(like, |now| Rope { construction, diameter: now.diameter });
        // A typical rope of a diameter that is on the screen already is physical.
        let _ = set(sheet, cable, rope);
    }
    let name = format!("Diameter d{of}");
    let (answer, label) = line(ui, sheet.touch, &name, DIAMETER, |ui| diameter(ui, sheet.touch, now));
    let (Some(mut answer), Some(now)) = (answer, now) else { return };
    answer.response = answer.response.labelled_by(label);
    let Some(diameter) = answer.value else { return };
    // A hand that drags too far stops where it was.
    if answer.response.dragged() && diameter <= 0.0 {
        return;
    }
    let refused = if diameter > 0.0 {
        set(sheet, cable, Rope { diameter, ..now }).err()
    } else {
        Some(format!("d{of} must be more than 0 mm"))
    };
    if let Some(reason) = refused {
        answer.refuse(ui, reason);
    }
}

/// A name at the left and what belongs to it at the right. Gives that, and the name's id.
fn line<R>(
    ui: &mut Ui,
    touch: bool,
    name: &str,
    meaning: &str,
    content: impl FnOnce(&mut Ui) -> R,
) -> (R, eframe::egui::Id) {
    let height = if touch { NUMBER_FOR_FINGERS.y } else { NUMBER.y };
    let size = Vec2::new(ui.available_width(), height);
    let line = ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        if touch {
            ui.spacing_mut().interact_size.y = height;
        }
        let content = content(ui);
        let rest = Layout::left_to_right(Align::Center);
        let label = ui.with_layout(rest, |ui| ui.add(Label::new(name).truncate().sense(Sense::hover())));
        (content, label.inner.explained(meaning).id)
    });
    line.inner
}

/// The diameter of a rope; a dash where there is none.
fn diameter(ui: &mut Ui, touch: bool, rope: Option<Rope>) -> Option<NumberResponse> {
    let Some(rope) = rope else {
        ui.weak("–").explained("Own values have no diameter: choose a construction first.");
        return None;
    };
    let size = if touch { NUMBER_FOR_FINGERS } else { NUMBER };
    let unit = Unit::of("mm");
    let control = Control { name: "d", unit, step: 0.01 * unit.shown(rope.diameter), size };
    Some(control.show(ui, rope.diameter))
}

/// Puts the values of a rope in the place of the present ones.
fn set(sheet: &mut EditedScenario<'_>, cable: Option<usize>, rope: Rope) -> Result<(), String> {
    let mut edited = sheet.edited.clone();
    let values = [rope.youngs_modulus(), rope.area(), rope.mass_per_length()];
    for (common, value) in fields::ROPE.into_iter().zip(values) {
        let parameter = cable.and_then(|cable| common.own(cable)).unwrap_or(common);
        parameter.give(&mut edited, value);
    }
    fields::check(&edited, sheet.settings)?;
    sheet.edited = edited;
    Ok(())
}
