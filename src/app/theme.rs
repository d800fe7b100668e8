//! Colours: one accent, a colour-blind-safe sequential map for values, and colours for classes.

use std::sync::Arc;

use eframe::egui::{Color32, Context, FontData, FontDefinitions, FontFamily, ThemePreference, Visuals};

use crate::app::settings::ThemeChoice;

/// The interface's own fonts: parts of Ubuntu Light and, for symbols such as ▲, ▶ and ↺, of Hack (src/app/fonts).
pub fn install_fonts(context: &Context) {
    let [text, symbols] =
        [("text", &include_bytes!("fonts/text.ttf")[..]), ("symbols", &include_bytes!("fonts/symbols.ttf")[..])]
            .map(|(name, bytes)| (name.to_owned(), Arc::new(FontData::from_static(bytes))));
    let mut fonts = FontDefinitions::empty();
    fonts.families.insert(FontFamily::Proportional, vec![text.0.clone(), symbols.0.clone()]);
    fonts.families.insert(FontFamily::Monospace, vec![symbols.0.clone(), text.0.clone()]);
    fonts.font_data.extend([text, symbols]);
    context.set_fonts(fonts);
}

/// Light or dark, as chosen.
pub fn choose(context: &Context, choice: ThemeChoice) {
    context.set_theme(match choice {
        ThemeChoice::System => ThemePreference::System,
        ThemeChoice::Light => ThemePreference::Light,
        ThemeChoice::Dark => ThemePreference::Dark,
    });
}

/// Nine stops of the viridis map (Smith and van der Walt, matplotlib, CC0), dark to light.
const VIRIDIS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

/// The accent: the platform, the velocity, what is selected.
pub fn accent(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_rgb(110, 175, 255) } else { Color32::from_rgb(20, 95, 190) }
}

/// What is unstable: always with a word or a shape as well.
pub fn warning(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_rgb(255, 150, 90) } else { Color32::from_rgb(185, 65, 0) }
}

/// What belongs to the pinned design.
pub fn pinned(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_rgb(215, 165, 225) } else { Color32::from_rgb(125, 55, 140) }
}

/// What is stable.
pub fn calm(visuals: &Visuals) -> Color32 {
    if visuals.dark_mode { Color32::from_rgb(120, 205, 165) } else { Color32::from_rgb(0, 110, 80) }
}

/// The colour of a value at `part` ∈ [0, 1] of its range. The end of the map that the background would swallow is
/// left out.
pub fn sequential(part: f64, visuals: &Visuals) -> Color32 {
    let part = if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 };
    let part = if visuals.dark_mode { 0.25 + 0.75 * part } else { 0.82 * part };
    let position = part * (VIRIDIS.len() - 1) as f64;
    // In 0..=7: the parts are clamped.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let below = (position as usize).min(VIRIDIS.len() - 2);
    let weight = position - below as f64;
    let mix = |i: usize| {
        let value = f64::from(VIRIDIS[below][i]) * (1.0 - weight) + f64::from(VIRIDIS[below + 1][i]) * weight;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let byte = value.round() as u8;
        byte
    };
    Color32::from_rgb(mix(0), mix(1), mix(2))
}

/// The colour of a value at `part` ∈ [0, 1] of a range whose middle is zero: blue below, orange above, and at zero what
/// lies between the two and near the ground. Blue and orange are told apart by people who are blind to red, to green, or to
/// blue; the lightness alone tells how far a value is from zero.
pub fn diverging(part: f64, visuals: &Visuals) -> Color32 {
    let stops: [[f64; 3]; 5] = if visuals.dark_mode {
        [[130.0, 190.0, 255.0], [60.0, 105.0, 165.0], [48.0, 48.0, 52.0], [165.0, 85.0, 30.0], [255.0, 165.0, 80.0]]
    } else {
        [[10.0, 70.0, 150.0], [105.0, 160.0, 215.0], [246.0, 246.0, 246.0], [240.0, 160.0, 90.0], [165.0, 60.0, 0.0]]
    };
    let part = if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.5 };
    let position = part * (stops.len() - 1) as f64;
    // In 0..=3: the part is clamped.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let below = (position as usize).min(stops.len() - 2);
    let weight = position - below as f64;
    let mix = |i: usize| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let byte = (stops[below][i] * (1.0 - weight) + stops[below + 1][i] * weight).round() as u8;
        byte
    };
    Color32::from_rgb(mix(0), mix(1), mix(2))
}

/// The colour of a class, the first eight without an order: those of Okabe and Ito ("Color Universal Design", 2008),
/// which colour-blind people tell apart.
pub fn class(class: usize) -> Color32 {
    const COLOURS: [[u8; 3]; 8] = [
        [86, 180, 233],
        [230, 159, 0],
        [0, 158, 115],
        [204, 121, 167],
        [240, 228, 66],
        [0, 114, 178],
        [213, 94, 0],
        [128, 128, 128],
    ];
    let [r, g, b] = COLOURS[class % COLOURS.len()];
    Color32::from_rgb(r, g, b)
}
