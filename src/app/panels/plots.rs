//! The tabs of plots and the mode shape's playback.

use std::f64::consts::TAU;

use eframe::egui::{Rect, Response, Slider, SliderClamping, Ui, Vec2};

use super::{campbell, directions, eigenvalues, growth, knobs, line, mesh, modes};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::gestures;
use crate::app::meaning::Explain as _;
use crate::app::number::{self, Control, Unit};
use crate::app::settings::Settings;
use crate::app::state::{Playback, Plot, Session, UiState};
use crate::app::tone;
use crate::compute::protocol::{ModeChoice, ModeShape, Which};
use crate::robot::Linearisation;

/// All plots with their names.
const TABS: [(Plot, &str); 8] = [
    (Plot::Eigenvalues, "Eigenvalues"),
    (Plot::Growth, "Growth rate"),
    (Plot::Modes, "Modes"),
    (Plot::Line, "Along the line"),
    (Plot::Directions, "Directions"),
    (Plot::Campbell, "Campbell"),
    (Plot::Mesh, "Mesh"),
    (Plot::Knobs, "Knobs"),
];

/// Draws the tabs, the open plot and the playback. Gives where the plot is.
pub fn ui(
    state: &mut UiState,
    session: &mut Session,
    ui: &mut Ui,
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) -> Rect {
    playback(&mut state.playback, &mut session.sound, ui, facts, commands);
    ui.separator();
    ui.horizontal_wrapped(|ui| {
        for (plot, name) in TABS {
            ui.selectable_value(&mut state.plot, plot, name);
        }
    });
    let top = ui.cursor().min;
    match state.plot {
        Plot::Eigenvalues => eigenvalues::ui(ui, facts, commands),
        Plot::Growth => growth::ui(ui, facts),
        Plot::Modes => modes::ui(ui, facts, commands),
        Plot::Line => line::ui(ui, facts, commands),
        Plot::Directions => directions::ui(ui, facts, commands),
        Plot::Campbell => campbell::ui(&mut state.campbell_hz, ui, facts, commands),
        Plot::Mesh => mesh::ui(ui, facts, commands),
        Plot::Knobs => knobs::ui(ui, facts, commands),
    }
    Rect::from_min_max(top, ui.min_rect().max)
}

/// A slider with its name behind it.
fn slider(ui: &mut Ui, slider: Slider<'_>, name: &str, meaning: &str) -> Response {
    let slider = ui.add(slider);
    gestures::scrolls_or_turns(&slider);
    let name = ui.label(name).explained(meaning);
    slider.labelled_by(name.id)
}

/// Which mode is on show, in words.
fn on_show(shape: &ModeShape, which: Which, settings: Settings) -> String {
    let [growth, omega] = shape.eigenvalue;
    let frequency = omega.abs() / std::f64::consts::TAU;
    // Of a mode that does not oscillate there is no frequency to tell.
    let how = if frequency > 0.0 {
        settings.frequency_text(frequency, None)
    } else {
        format!("no oscillation, growth rate {} 1/s", digits::certain(growth, None))
    };
    let speed = digits::certain(shape.speed, None);
    match (shape.is_critical, which) {
        (true, _) if frequency > 0.0 => format!("Mode that becomes unstable: {how} at {speed} m/s"),
        (true, _) => format!("Mode that becomes unstable: no oscillation, at {speed} m/s"),
        (false, Which::Critical) => format!("No mode becomes unstable. The least stable one at {speed} m/s: {how}"),
        (false, Which::Near(_)) => format!("Chosen mode: {how} at {speed} m/s"),
    }
}

fn playback(
    playback: &mut Playback,
    sound: &mut bool,
    ui: &mut Ui,
    Facts { document, answers, settings, mode: choice, .. }: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    ui.label(
        answers.shape().map_or_else(|| "No mode shape".to_owned(), |shape| on_show(shape, choice.which, settings)),
    );
    ui.horizontal_wrapped(|ui| {
        let label = if playback.playing { "‖ Pause" } else { "▶ Play" };
        if ui.button(label).clicked() {
            playback.playing = !playback.playing;
        }
        for (label, text, step) in [("←", "One step back", -1.0), ("→", "One step forward", 1.0)] {
            let button = ui.button(label).explained(text);
            button.widget_info(|| eframe::egui::WidgetInfo::labeled(eframe::egui::Role::Button, true, text));
            if button.clicked() {
                playback.step(step);
            }
        }
        let critical = choice.which == Which::Critical;
        let response = ui.selectable_label(critical, "Critical mode");
        if response.explained("Show the mode that crosses at the critical speed").clicked() && !critical {
            commands.push(Command::ChooseMode(ModeChoice { which: Which::Critical, ..choice }));
        }
        if document.scenario.linearisation == Linearisation::Secant {
            let text = "With secant stiffness x and y vibrate alike and independently; this shows one of the two.";
            for (along_x, name) in [(true, "x"), (false, "y")] {
                let response = ui.selectable_label(choice.along_x == along_x, name).explained(text);
                if response.clicked() && choice.along_x != along_x {
                    commands.push(Command::ChooseMode(ModeChoice { along_x, ..choice }));
                }
            }
        }
    });
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().slider_width = 70.0;
        let amplitude = Slider::new(&mut playback.amplitude, 0.0..=0.1).show_value(false);
        let amplitude = amplitude.clamping(SliderClamping::Never);
        slider(ui, amplitude, "Amplitude", "The largest displacement, as a part of the robot's width");
        let mut degrees = playback.phase.to_degrees();
        let phase = Slider::new(&mut degrees, 0.0..=360.0).show_value(false);
        if slider(ui, phase, "Phase", "Where in its oscillation the mode is").changed() {
            playback.playing = false;
            playback.phase = degrees.to_radians();
        }
    });
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().slider_width = 70.0;
        let tempo = playback.slow_motion;
        let control = Control { name: "Tempo", unit: Unit::of(""), step: 0.01 * tempo, size: Vec2::new(64.0, 18.0) };
        let meaning = "Seconds of the robot per second of the screen";
        number::slider(ui, &control, meaning, &mut playback.slow_motion, [0.02, 2.0]);
        if cfg!(target_arch = "wasm32") {
            let frequency = answers.shape().map(|shape| shape.eigenvalue[1].abs() / TAU);
            ui.toggle_value(sound, "Sound").explained(tone::text(frequency, settings));
        }
    });
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
        let swings = shape([0.0, std::f64::consts::TAU], true);
        assert_eq!(told(swings, Which::Critical), "Mode that becomes unstable: 1.00 Hz at 5.00 m/s");
        assert_eq!(
            told(shape([0.0, 0.0], true), Which::Critical),
            "Mode that becomes unstable: no oscillation, at 5.00 m/s"
        );
    }
}
