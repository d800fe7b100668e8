//! The bar under the robot: what moves on the canvas, how large and how fast.

mod flight;
mod play;

use std::f64::consts::TAU;

use eframe::egui::{
    Align, Color32, Layout, Rect, Response, Role, Sense, Slider, SliderClamping, Stroke, StrokeKind, TextStyle, Ui,
    UiBuilder, Vec2, WidgetInfo,
};

use crate::app::answers::Answers;
use crate::app::arrangement::Form;
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::gestures;
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::settings::Settings;
use crate::app::state::{Movement, Playback, Session};
use crate::app::theme;
use crate::app::tone;
use crate::compute::protocol::{ModeChoice, ModeShape, Which};
use crate::robot::Linearisation;

pub use flight::fly;
use play::{choose, play};

/// Draws the transport in `rect`.
pub fn ui(
    playback: &mut Playback,
    session: &mut Session,
    ui: &mut Ui,
    (rect, form): (Rect, Form),
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    let tokens = theme::tokens(ui.visuals());
    ui.painter().rect_filled(rect, 0.0, tokens.panel);
    ui.painter().hline(rect.x_range(), rect.min.y + 0.5, (1.0, tokens.line));
    let height = if form.is_touch() { 44.0 } else { 32.0 };
    let inner = rect.shrink2(Vec2::new(12.0, 0.0));
    let layout = UiBuilder::new().max_rect(inner).layout(Layout::left_to_right(Align::Center));
    ui.scope_builder(layout, |ui| {
        ui.set_clip_rect(rect.intersect(ui.clip_rect()));
        if playback.movement == Movement::Fly && facts.document.scenario.path.is_some() {
            flight::ui(playback, session.mode, ui, (rect.width(), height), facts, commands);
            return;
        }
        ui.add_enabled_ui(facts.answers.shape().is_some(), |ui| {
            play(playback, ui, height);
            if !playback.playing && rect.width() > 500.0 {
                steps(ui, height, commands);
            }
            movements(playback, session.mode, ui, height, facts, commands);
        });
        if rect.width() > 430.0
            && let Some(shape) = facts.answers.shape()
        {
            ui.weak(how(shape, facts.settings)).explained(on_show(shape, session.mode.which, facts.settings));
        }
        if rect.width() > 800.0 && facts.document.scenario.linearisation == Linearisation::Secant {
            axes(session.mode, ui, height, commands);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if cfg!(target_arch = "wasm32") && rect.width() > 560.0 {
                let frequency = facts.answers.shape().map(|shape| shape.eigenvalue[1].abs() / TAU);
                let button = IconButton::new(Icon::Sound, "Sound").height(height).selected(session.sound).show(ui);
                if button.explained(tone::text(frequency, facts.settings)).clicked() {
                    session.sound = !session.sound;
                }
            }
            ui.spacing_mut().slider_width = 72.0;
            theme::accent_sliders(ui);
            if rect.width() > 500.0 {
                tempo(playback, ui);
            }
            if rect.width() > 700.0 {
                size(playback, ui);
            }
        });
    });
}

/// The one button of a phone and of a frame: lets the robot go, or stops.
pub fn let_go(playback: &mut Playback, mode: ModeChoice, ui: &mut Ui, height: f32, commands: &mut Vec<Command>) {
    let goes = playback.playing && playback.movement != Movement::Mode;
    let icon = if goes { Icon::Pause } else { Icon::Play };
    let button = IconButton::new(icon, "Let go").text("Let go").height(height).framed().show(ui);
    if button.explained("What a small disturbance becomes at this speed").clicked() {
        if goes {
            playback.playing = false;
        } else {
            choose(playback, mode, Movement::LetGo, commands);
            playback.playing = true;
        }
    }
}

/// One step forward or back, while nothing moves.
fn steps(ui: &mut Ui, height: f32, commands: &mut Vec<Command>) {
    for (label, text, step) in [("◀", "One step back", -1.0), ("▶", "One step forward", 1.0)] {
        let button = ui.add(eframe::egui::Button::new(label).min_size(Vec2::new(28.0, height - 4.0))).explained(text);
        button.widget_info(|| WidgetInfo::labeled(Role::Button, true, text));
        if button.clicked() {
            commands.push(Command::Step(step));
        }
    }
}

/// What can move: the present disturbance, or one mode for ever.
fn movements(
    playback: &mut Playback,
    mode: ModeChoice,
    ui: &mut Ui,
    height: f32,
    Facts { document, answers, .. }: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    let speed = |speed: f64| digits::certain(speed, None);
    let let_go = format!("Let go at {:.2} m/s", document.scenario.motion.speed);
    let steady = match (mode.which, critical(answers)) {
        (Which::Near(_), _) if playback.movement == Movement::Mode => {
            format!("Mode at {} m/s", speed(document.scenario.motion.speed))
        }
        (_, Some(critical)) => format!("Mode at {} m/s", speed(critical)),
        (_, None) => "Mode shape".into(),
    };
    let choices = [
        (Movement::LetGo, let_go, "What a small disturbance becomes at this speed: it dies out, or grows by itself"),
        (Movement::Mode, steady, "The vibration that begins at the critical speed, as if it neither grew nor died out"),
    ];
    ui.spacing_mut().item_spacing.x = 0.0;
    for (movement, name, meaning) in choices {
        // Without a path nothing flies: it is let go.
        let chosen = playback.movement == movement || (playback.movement, movement) == (Movement::Fly, Movement::LetGo);
        if segment(ui, chosen, &name, height).explained(meaning).clicked() {
            choose(playback, mode, movement, commands);
        }
    }
    if document.scenario.path.is_some()
        && segment(ui, false, "Fly", height).explained("Flies the path, with everything that swings").clicked()
    {
        choose(playback, mode, Movement::Fly, commands);
    }
    ui.spacing_mut().item_spacing.x = 8.0;
    ui.add_space(8.0);
}

/// The critical speed that is known, in m/s.
fn critical(answers: &Answers) -> Option<f64> {
    answers.last_critical()?.critical.as_ref().map(|critical| critical.speed)
}

/// One of several choices side by side.
pub fn segment(ui: &mut Ui, chosen: bool, name: &str, height: f32) -> Response {
    let tokens = theme::tokens(ui.visuals());
    let font = TextStyle::Button.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(name.into(), font, Color32::PLACEHOLDER);
    let (rect, response) = ui.allocate_exact_size(Vec2::new(galley.size().x + 18.0, height), Sense::click());
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::selected(Role::RadioButton, enabled, chosen, name));
    let shown = rect.shrink2(Vec2::new(0.0, 0.5 * (height - 28.0).clamp(0.0, 8.0)));
    ui.painter().rect_filled(shown, 0.0, tokens.field);
    if chosen {
        let inside = shown.shrink(2.0);
        ui.painter().rect(inside, 5.0, tokens.card, Stroke::new(1.0, tokens.line), StrokeKind::Inside);
    }
    if response.has_focus() {
        ui.painter().rect_stroke(shown, 5.0, Stroke::new(2.0, tokens.accent), StrokeKind::Inside);
    }
    let fade = if enabled { 1.0 } else { 0.4 };
    let colour = if chosen { tokens.text } else { tokens.weak };
    let at = rect.center() - 0.5 * galley.size();
    ui.painter().galley(at, galley, colour.gamma_multiply(fade));
    response
}

/// With secant stiffness x and y vibrate alike; which of the two is shown can be chosen.
fn axes(mode: ModeChoice, ui: &mut Ui, height: f32, commands: &mut Vec<Command>) {
    let text = "With secant stiffness x and y vibrate alike and independently; this shows one of the two.";
    ui.spacing_mut().item_spacing.x = 0.0;
    for (along_x, name) in [(true, "x"), (false, "y")] {
        if segment(ui, mode.along_x == along_x, name, height).explained(text).clicked() && mode.along_x != along_x {
            commands.push(Command::ChooseMode(ModeChoice { along_x, ..mode }));
        }
    }
    ui.spacing_mut().item_spacing.x = 8.0;
}

fn size(playback: &mut Playback, ui: &mut Ui) {
    let slider = Slider::new(&mut playback.amplitude, 0.0..=0.1).show_value(false).clamping(SliderClamping::Never);
    named_slider(ui, slider, "Size", "The largest displacement, as a part of the robot's width");
}

fn tempo(playback: &mut Playback, ui: &mut Ui) {
    let meaning = format!(
        "{} s of the robot per second of the screen, as far as that can be seen",
        digits::certain(playback.slow_motion, None)
    );
    let slider = Slider::new(&mut playback.slow_motion, 0.02..=2.0).logarithmic(true).show_value(false);
    named_slider(ui, slider.clamping(SliderClamping::Never), "Tempo", &meaning);
}

/// A slider behind its name, from right to left.
fn named_slider(ui: &mut Ui, slider: Slider<'_>, name: &str, meaning: &str) {
    let slider = ui.add(slider);
    gestures::scrolls_or_turns(&slider);
    let name = ui.label(name).explained(meaning);
    slider.labelled_by(name.id);
    ui.add_space(8.0);
}

/// How the mode on show swings, in a few words.
fn how(shape: &ModeShape, settings: Settings) -> String {
    let [growth, omega] = shape.eigenvalue;
    if omega == 0.0 {
        format!("no oscillation, {} 1/s", digits::certain(growth, None))
    } else {
        settings.frequency_text(omega.abs() / TAU, None)
    }
}

/// Which mode is on show, in a sentence.
fn on_show(shape: &ModeShape, which: Which, settings: Settings) -> String {
    let [growth, omega] = shape.eigenvalue;
    // Of a mode that does not oscillate there is no frequency to tell.
    let how = if omega == 0.0 {
        format!("no oscillation, growth rate {} 1/s", digits::certain(growth, None))
    } else {
        settings.frequency_text(omega.abs() / TAU, None)
    };
    let speed = digits::certain(shape.speed, None);
    match (shape.is_critical, which) {
        (true, _) if omega != 0.0 => format!("Mode that becomes unstable: {how} at {speed} m/s"),
        (true, _) => format!("Mode that becomes unstable: no oscillation, at {speed} m/s"),
        (false, Which::Critical) => format!("No mode becomes unstable. The least stable one at {speed} m/s: {how}"),
        (false, Which::Present) => format!("Least stable mode at {speed} m/s: {how}"),
        (false, Which::Near(_)) => format!("Chosen mode: {how} at {speed} m/s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mode_that_does_not_oscillate_or_is_not_critical_is_not_told_as_one_that_is() {
        let shape = |eigenvalue, is_critical| ModeShape {
            eigenvalue,
            speed: 5.0,
            is_critical,
            displacement: Vec::new(),
            cable_share: Vec::new(),
        };
        let told = |shape: ModeShape, which| on_show(&shape, which, Settings::default());
        let none = told(shape([-0.25, 0.0], false), Which::Critical);
        assert_eq!(
            none,
            "No mode becomes unstable. The least stable one at 5.00 m/s: no oscillation, growth rate -0.250 1/s"
        );
        assert!(!none.contains("Hz") && !none.contains("Chosen"), "{none}");
        assert!(told(shape([-0.25, 0.0], false), Which::Near([0.0, 0.0])).starts_with("Chosen mode: no oscillation"));
        assert!(told(shape([-0.25, TAU], false), Which::Present).starts_with("Least stable mode at 5.00 m/s: 1.00 Hz"));
        let swings = shape([0.0, TAU], true);
        assert_eq!(told(swings, Which::Critical), "Mode that becomes unstable: 1.00 Hz at 5.00 m/s");
        assert_eq!(
            told(shape([0.0, 0.0], true), Which::Critical),
            "Mode that becomes unstable: no oscillation, at 5.00 m/s"
        );
    }
}
