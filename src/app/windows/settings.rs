//! The settings.

use eframe::egui::{ComboBox, Grid, Ui};

use crate::app::settings::{FrequencyUnit, MotionChoice, Settings, StressUnit, ThemeChoice};

/// Draws them; what is chosen counts at once.
pub fn ui(settings: &mut Settings, ui: &mut Ui) {
    Grid::new("settings").num_columns(2).spacing([16.0, 8.0]).show(ui, |ui| {
        let themes =
            [(ThemeChoice::System, "As the system"), (ThemeChoice::Light, "Light"), (ThemeChoice::Dark, "Dark")];
        choice(ui, "Theme", &mut settings.theme, &themes);
        let units = [(FrequencyUnit::Hertz, "Hz"), (FrequencyUnit::RadiansPerSecond, "rad/s")];
        choice(ui, "Frequencies in", &mut settings.frequency, &units);
        let units = [(StressUnit::Megapascal, "MPa"), (StressUnit::Gigapascal, "GPa")];
        choice(ui, "Young's modulus in", &mut settings.stress, &units);
        let choices = [
            (MotionChoice::System, "As the system"),
            (MotionChoice::Full, "Mode shapes move"),
            (MotionChoice::Reduced, "Nothing moves by itself"),
        ];
        choice(ui, "Movement", &mut settings.motion, &choices);
        let sizes = [80, 90, 100, 110, 125, 150, 175, 200].map(|percent| (percent, format!("{percent} %")));
        let sizes: Vec<(u16, &str)> = sizes.iter().map(|(percent, text)| (*percent, text.as_str())).collect();
        choice(ui, "Text size", &mut settings.text_percent, &sizes);
        let keys = [(true, "On"), (false, "Off")];
        choice(ui, "Keys without Ctrl", &mut settings.single_keys, &keys);
    });
    ui.add_space(6.0);
    ui.weak("The settings and the robot on show are kept on this device and are there again after a restart.");
}

fn choice<T: Copy + PartialEq>(ui: &mut Ui, name: &str, value: &mut T, all: &[(T, &str)]) {
    let label = ui.label(name);
    let title = all.iter().find(|(other, _)| other == value).map_or("", |(_, title)| title);
    let list = ComboBox::from_id_salt(name).width(180.0).selected_text(title).show_ui(ui, |ui| {
        for (other, title) in all {
            ui.selectable_value(value, *other, *title);
        }
    });
    list.response.labelled_by(label.id);
    ui.end_row();
}
