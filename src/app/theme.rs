//! Colours: one accent, a colour-blind-safe sequential map for values, and colours for classes.

use std::sync::Arc;

use eframe::egui::{
    Color32, Context, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Stroke, Style, TextStyle, Theme,
    ThemePreference, Ui, Visuals, style::HandleShape,
};

use crate::app::settings::ThemeChoice;

/// The interface's own fonts: parts of Noto Sans and, for symbols such as ▲, ▶ and ↺, of Hack (src/app/fonts).
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

/// Gives the sliders that follow the accent's colour, up to where they are.
pub fn accent_sliders(ui: &mut Ui) {
    let tokens = tokens(ui.visuals());
    let visuals = ui.visuals_mut();
    visuals.selection.bg_fill = tokens.accent;
    for widget in [&mut visuals.widgets.inactive, &mut visuals.widgets.hovered, &mut visuals.widgets.active] {
        widget.bg_fill = tokens.track;
        widget.fg_stroke = Stroke::new(1.0, tokens.numbers);
    }
}

/// The interface's colours. Each word's contrast on its ground is at least 4.5 : 1 (`contrast` below is tested).
#[derive(Clone, Copy, Debug)]
pub struct Tokens {
    /// Under the robot.
    pub canvas: Color32,
    /// Under controls and plots.
    pub panel: Color32,
    /// Under cards, windows and tooltips.
    pub card: Color32,
    /// Fields with values, buttons.
    pub field: Color32,
    /// Tracks of sliders.
    pub track: Color32,
    /// Separators, grids.
    pub line: Color32,
    /// The workspace's frame.
    pub frame: Color32,
    /// Words.
    pub text: Color32,
    /// Captions.
    pub weak: Color32,
    /// Numbers of axes.
    pub numbers: Color32,
    /// Old data and traces; never words.
    pub mute: Color32,
    /// What is now: the speed, the platform, the line through the pose.
    pub accent: Color32,
    /// Under what is chosen.
    pub accent_fill: Color32,
    /// On `accent_fill`.
    pub accent_text: Color32,
    /// On `accent` itself.
    pub on_accent: Color32,
    /// What is stable.
    pub stable: Color32,
    /// What is critical or unstable; always with a word or a shape as well.
    pub critical: Color32,
    /// Under what is critical.
    pub critical_fill: Color32,
    /// The wave limit.
    pub waves: Color32,
}

const fn rgb(hex: u32) -> Color32 {
    let [_, r, g, b] = hex.to_be_bytes();
    Color32::from_rgb(r, g, b)
}

const LIGHT: Tokens = Tokens {
    canvas: rgb(0x00FF_FFFF),
    panel: rgb(0x00F6_F7F8),
    card: rgb(0x00FF_FFFF),
    field: rgb(0x00E9_ECEF),
    track: rgb(0x00D5_DADE),
    line: rgb(0x00D9_DDE1),
    frame: rgb(0x00B4_BBC1),
    text: rgb(0x001B_1F23),
    weak: rgb(0x0059_626A),
    numbers: rgb(0x005F_686F),
    mute: rgb(0x0086_8F97),
    accent: rgb(0x0015_65C0),
    accent_fill: rgb(0x00DD_EAF8),
    accent_text: rgb(0x000D_4C9A),
    on_accent: rgb(0x00FF_FFFF),
    stable: rgb(0x0000_695C),
    critical: rgb(0x00B2_3C00),
    critical_fill: rgb(0x00FB_E6DB),
    waves: rgb(0x004A_4F8C),
};

const DARK: Tokens = Tokens {
    canvas: rgb(0x0010_1214),
    panel: rgb(0x0018_1B1E),
    card: rgb(0x001D_2124),
    field: rgb(0x002A_2F34),
    track: rgb(0x003D_444A),
    line: rgb(0x002E_3338),
    frame: rgb(0x004C_545B),
    text: rgb(0x00E7_EAEC),
    weak: rgb(0x00A6_AEB5),
    numbers: rgb(0x009D_A6AD),
    mute: rgb(0x006F_7880),
    accent: rgb(0x006D_B1FF),
    accent_fill: rgb(0x0016_324F),
    accent_text: rgb(0x00B5_D8FF),
    on_accent: rgb(0x0010_1214),
    stable: rgb(0x005C_CBAF),
    critical: rgb(0x00FF_9B61),
    critical_fill: rgb(0x003F_2416),
    waves: rgb(0x00B4_B8F0),
};

/// The colours of the theme that is on.
pub fn tokens(visuals: &Visuals) -> &'static Tokens {
    if visuals.dark_mode { &DARK } else { &LIGHT }
}

/// Text sizes in points: captions and numbers of axes, all else, the robot's name, the answer's figure.
pub const CAPTION: f32 = 12.0;
/// See [`CAPTION`].
pub const BODY: f32 = 13.0;
/// See [`CAPTION`].
pub const TITLE: f32 = 15.0;
/// See [`CAPTION`].
pub const FIGURE: f32 = 32.0;

/// Gives both themes their colours and measures. Where the pointer is `coarse`, a finger, things are larger.
pub fn install_style(context: &Context, coarse: bool) {
    for (theme, tokens) in [(Theme::Light, &LIGHT), (Theme::Dark, &DARK)] {
        context.style_mut_of(theme, |style| apply(style, tokens, coarse));
    }
}

fn apply(style: &mut Style, tokens: &Tokens, coarse: bool) {
    let body = if coarse { BODY + 1.0 } else { BODY };
    style.text_styles = [
        (TextStyle::Small, FontId::proportional(CAPTION)),
        (TextStyle::Body, FontId::proportional(body)),
        (TextStyle::Button, FontId::proportional(body)),
        (TextStyle::Heading, FontId::proportional(TITLE)),
        (TextStyle::Monospace, FontId::monospace(body)),
    ]
    .into();
    let spacing = &mut style.spacing;
    spacing.item_spacing = [8.0, 4.0].into();
    spacing.button_padding = [8.0, 4.0].into();
    spacing.interact_size = if coarse { [44.0, 44.0] } else { [28.0, 24.0] }.into();
    spacing.slider_rail_height = 4.0;
    spacing.icon_width = if coarse { 20.0 } else { 16.0 };
    let visuals = &mut style.visuals;
    visuals.panel_fill = tokens.panel;
    visuals.window_fill = tokens.card;
    visuals.extreme_bg_color = tokens.canvas;
    visuals.faint_bg_color = tokens.field;
    visuals.code_bg_color = tokens.field;
    visuals.text_edit_bg_color = Some(tokens.canvas);
    visuals.weak_text_color = Some(tokens.weak);
    visuals.hyperlink_color = tokens.accent_text;
    visuals.warn_fg_color = tokens.critical;
    visuals.error_fg_color = tokens.critical;
    visuals.selection.bg_fill = tokens.accent_fill;
    visuals.selection.stroke = Stroke::new(1.0, tokens.accent_text);
    visuals.window_stroke = Stroke::new(1.0, tokens.line);
    visuals.window_corner_radius = CornerRadius::same(8);
    visuals.menu_corner_radius = CornerRadius::same(8);
    visuals.slider_trailing_fill = true;
    visuals.handle_shape = HandleShape::Circle;
    let widgets = &mut visuals.widgets;
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, tokens.line);
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, tokens.text);
    widgets.noninteractive.bg_fill = tokens.panel;
    for (widget, fill, text) in [
        (&mut widgets.inactive, tokens.field, tokens.text),
        (&mut widgets.hovered, tokens.track, tokens.text),
        (&mut widgets.active, tokens.accent_fill, tokens.accent_text),
        (&mut widgets.open, tokens.field, tokens.text),
    ] {
        widget.weak_bg_fill = fill;
        widget.bg_fill = fill;
        widget.bg_stroke = Stroke::NONE;
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.expansion = 0.0;
        widget.corner_radius = CornerRadius::same(6);
    }
    // What has the keyboard's focus shows it.
    widgets.hovered.bg_stroke = Stroke::new(1.0, tokens.frame);
    widgets.active.bg_stroke = Stroke::new(2.0, tokens.accent);
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
    tokens(visuals).accent
}

/// What is unstable: always with a word or a shape as well.
pub fn warning(visuals: &Visuals) -> Color32 {
    tokens(visuals).critical
}

/// What belongs to the kept designs, from the first to the last. Each has a letter and a kind of line as well.
pub fn designs(visuals: &Visuals) -> &'static [Color32; 4] {
    const LIGHT: [Color32; 4] = [
        Color32::from_rgb(125, 55, 140),
        Color32::from_rgb(110, 90, 0),
        Color32::from_rgb(70, 85, 110),
        Color32::from_rgb(150, 35, 95),
    ];
    const DARK: [Color32; 4] = [
        Color32::from_rgb(215, 165, 225),
        Color32::from_rgb(225, 205, 120),
        Color32::from_rgb(170, 190, 215),
        Color32::from_rgb(250, 160, 200),
    ];
    if visuals.dark_mode { &DARK } else { &LIGHT }
}

/// What is stable.
pub fn calm(visuals: &Visuals) -> Color32 {
    tokens(visuals).stable
}

/// The colour of a cable's tension at `part` ∈ [0, 1] of its range. The end that the canvas would swallow is left out.
pub fn cable(part: f64, visuals: &Visuals) -> Color32 {
    viridis(part, if visuals.dark_mode { [0.30, 1.0] } else { [0.02, 0.78] })
}

/// The colour of a map's value at `part` ∈ [0, 1] of its range.
pub fn on_map(part: f64) -> Color32 {
    viridis(part, [0.06, 1.0])
}

/// The colour at `part` of the stretch of viridis between two of its places.
fn viridis(part: f64, [low, high]: [f64; 2]) -> Color32 {
    let part = if part.is_finite() { part.clamp(0.0, 1.0) } else { 0.0 };
    let position = low + (high - low) * part;
    let position = position * (VIRIDIS.len() - 1) as f64;
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
    let tokens = tokens(visuals);
    let field = tokens.field;
    let half = |colour: Color32| colour.lerp_to_gamma(field, 0.5);
    let colours = [tokens.accent, half(tokens.accent), field, half(tokens.critical), tokens.critical];
    let stops = colours.map(|colour| [colour.r(), colour.g(), colour.b()].map(f64::from));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The contrast of two colours as WCAG 2.2 defines it.
    fn contrast(a: Color32, b: Color32) -> f64 {
        let channel = |byte: u8| {
            let part = f64::from(byte) / 255.0;
            if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
        };
        let luminance = |c: Color32| 0.2126 * channel(c.r()) + 0.7152 * channel(c.g()) + 0.0722 * channel(c.b());
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn every_word_is_readable_on_every_ground() {
        assert!((contrast(Color32::WHITE, Color32::BLACK) - 21.0).abs() < 1e-9);
        for (tokens, visuals) in [(&LIGHT, Visuals::light()), (&DARK, Visuals::dark())] {
            let grounds = [tokens.canvas, tokens.panel, tokens.card];
            let words =
                [tokens.text, tokens.weak, tokens.numbers, tokens.accent, tokens.stable, tokens.critical, tokens.waves];
            for word in words {
                for ground in grounds {
                    assert!(contrast(word, ground) >= 4.5, "{word:?} on {ground:?}: {}", contrast(word, ground));
                }
            }
            for (word, ground) in [
                (tokens.text, tokens.field),
                (tokens.weak, tokens.field),
                (tokens.accent_text, tokens.accent_fill),
                (tokens.on_accent, tokens.accent),
                (tokens.text, tokens.critical_fill),
                (tokens.critical, tokens.critical_fill),
            ] {
                assert!(contrast(word, ground) >= 4.5, "{word:?} on {ground:?}: {}", contrast(word, ground));
            }
            for word in designs(&visuals) {
                for ground in grounds {
                    assert!(contrast(*word, ground) >= 4.5, "{word:?} on {ground:?}: {}", contrast(*word, ground));
                }
            }
            // Data that is old is no word, but must be seen.
            assert!(grounds.iter().all(|ground| contrast(tokens.mute, *ground) >= 3.0));
        }
    }
}
