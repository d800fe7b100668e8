//! The transport while a flight is what moves: play, the moment on show, tempo, how large deviations are drawn, the kick.

use eframe::egui::{ComboBox, Label, Pos2, Response, RichText, Slider, Spinner, Stroke, Ui};

use super::play::{choose, play};
use crate::app::canvas;
use crate::app::command::Command;
use crate::app::facts::{Facts, FlightKnown};
use crate::app::flying::{Action, Flying};
use crate::app::gestures;
use crate::app::icons::{Icon, IconButton};
use crate::app::meaning::Explain as _;
use crate::app::state::{Movement, Playback};
use crate::app::theme;
use crate::compute::protocol::{ModeChoice, Topic};
use crate::study::Flown;

/// Narrower transports than these, in points, leave out the steps and the lists.
const WITH_KICK: f32 = 420.0;
const WITH_LISTS: f32 = 560.0;

/// The movements with their names.
const MOVEMENTS: [(Movement, &str); 3] =
    [(Movement::LetGo, "Let go"), (Movement::Mode, "Mode"), (Movement::Fly, "Fly")];

/// What is in the transport, which is `width` wide, from left to right.
pub(super) fn ui(
    playback: &mut Playback,
    mode: ModeChoice,
    ui: &mut Ui,
    (width, height): (f32, f32),
    facts: Facts<'_>,
    commands: &mut Vec<Command>,
) {
    let known = facts.flight();
    ui.add_enabled_ui(matches!(known, FlightKnown::Flown(_)), |ui| play(playback, ui, height));
    what_moves(playback, mode, ui, commands);
    match known {
        FlightKnown::Flown(flown) => moment(playback, ui, (width, height), flown, *facts.flying, commands),
        FlightKnown::Waits => waits(ui, facts, commands),
        FlightKnown::Stopped => {
            let button = IconButton::new(Icon::None, "Resume the flight").text("Resume").framed();
            if button.show(ui).clicked() {
                commands.push(Command::ResumeStudy(Topic::Flight));
            }
            ui.weak("Stopped");
        }
        FlightKnown::Failed(reason) => {
            let text = format!("There is no flight: {reason}.");
            ui.add(Label::new(RichText::new(&text).color(theme::warning(ui.visuals()))).truncate()).explained(text);
        }
        FlightKnown::NoPath => {}
    }
}

/// The one button of a phone and of a frame: flies, or stops.
pub fn fly(playback: &mut Playback, ui: &mut Ui, height: f32) {
    let flies = playback.playing && playback.movement == Movement::Fly;
    let icon = if flies { Icon::Pause } else { Icon::Play };
    let button = IconButton::new(icon, "Fly").text("Fly").height(height).framed().show(ui);
    if button.explained("Flies the path, with everything that swings").clicked() {
        (playback.movement, playback.playing) = (Movement::Fly, !flies);
    }
}

fn what_moves(playback: &mut Playback, mode: ModeChoice, ui: &mut Ui, commands: &mut Vec<Command>) {
    let name = MOVEMENTS.iter().find(|(movement, _)| *movement == playback.movement).map_or("", |(_, name)| name);
    let list = ComboBox::from_id_salt("what moves").width(64.0).selected_text(name).show_ui(ui, |ui| {
        for (movement, name) in MOVEMENTS {
            if ui.selectable_label(playback.movement == movement, name).clicked() {
                choose(playback, mode, movement, commands);
            }
        }
    });
    canvas::named(&list.response, "What moves", name);
}

/// A flight under way, with what ends it.
fn waits(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    ui.add(Spinner::new().size(14.0));
    let percent = facts.studies.progress(Topic::Flight).percent;
    ui.label(format!("The flight is being computed: {percent} %"));
    let button = IconButton::new(Icon::None, "Cancel the flight").text("Cancel").framed();
    if facts.studies.progress(Topic::Flight).total > 0
        && button.show(ui).explained("Stops the computation of the flight").clicked()
    {
        commands.push(Command::StopStudy(Topic::Flight));
    }
}

/// The moment on show and how the flight is looked at.
fn moment(
    playback: &mut Playback,
    ui: &mut Ui,
    (width, height): (f32, f32),
    flown: &Flown,
    flying: Flying,
    commands: &mut Vec<Command>,
) {
    let end = flown.flight.lost.unwrap_or(flown.flight.end);
    let time = flying.time.min(end);
    let text = format!("{time:.2} / {end:.2} s");
    ui.add(Label::new(text)).explained("The moment of the flight, and how long it lasts with the time after its end");
    let right = eframe::egui::Layout::right_to_left(eframe::egui::Align::Center);
    ui.with_layout(right, |ui| {
        if width > WITH_KICK {
            let button = IconButton::new(Icon::ArrowUp, "Kick").text("Kick").height(height).framed();
            let button = button.selected(flying.kicked).show(ui);
            if button.explained("The flight begins with an impulse of 1 N s on the platform, straight up").clicked() {
                commands.push(Command::Flight(Action::Kick(!flying.kicked)));
            }
        }
        if width > WITH_LISTS {
            let factors = Flying::FACTORS.map(|factor| (factor, format!("Deviation × {factor}")));
            if let Some(factor) = list(ui, "Deviation drawn", flying.factor, &factors, 110.0) {
                commands.push(Command::Flight(Action::Factor(factor)));
            }
            let tempos = Flying::TEMPOS.map(|(tempo, name)| (tempo, name.to_owned()));
            if let Some(tempo) = list(ui, "Tempo of the flight", flying.tempo, &tempos, 44.0) {
                commands.push(Command::Flight(Action::Tempo(tempo)));
            }
        }
        let mut sought = time;
        let slider = scrubber(ui, &mut sought, flown, end);
        if slider.changed() {
            playback.playing = false;
            commands.push(Command::Flight(Action::Seek(sought)));
        }
    });
}

/// A list of choices; gives the one that has been chosen.
fn list<T: Copy + PartialEq>(ui: &mut Ui, name: &str, now: T, all: &[(T, String)], width: f32) -> Option<T> {
    let shown = all.iter().find(|(other, _)| *other == now).map_or("", |(_, text)| text);
    let mut chosen = None;
    let list = ComboBox::from_id_salt(name).width(width).selected_text(shown).show_ui(ui, |ui| {
        for (other, text) in all {
            if ui.selectable_label(*other == now, text).clicked() {
                chosen = Some(*other);
            }
        }
    });
    canvas::named(&list.response, name, shown);
    chosen
}

/// The time as a slider, with ticks for the first slack and for the stop.
fn scrubber(ui: &mut Ui, time: &mut f64, flown: &Flown, end: f64) -> Response {
    theme::accent_sliders(ui);
    ui.spacing_mut().slider_width = (ui.available_width() - 12.0).max(40.0);
    let slider = ui.add(Slider::new(time, 0.0..=end).show_value(false));
    gestures::scrolls_or_turns(&slider);
    ui.ctx().accesskit_node_builder(slider.id, |node| node.set_label("Time of the flight"));
    let tokens = theme::tokens(ui.visuals());
    // The middle of egui's handle goes from one end to the other, less its radius.
    let ends = slider.rect.x_range().shrink(slider.rect.height() / 2.5);
    let tick = |at: f64, stroke: Stroke| {
        #[expect(clippy::cast_possible_truncation)] // A part of one.
        let part = (at / end).clamp(0.0, 1.0) as f32;
        let x = ends.min + part * ends.span();
        let y = slider.rect.center().y;
        ui.painter().line_segment([Pos2::new(x, y - 8.0), Pos2::new(x, y + 8.0)], stroke);
    };
    if flown.flight.duration < end {
        tick(flown.flight.duration, Stroke::new(2.0, tokens.weak));
    }
    if let Some(slack) = flown.flight.slack {
        tick(slack.time, Stroke::new(3.0, tokens.critical));
    }
    slider
}
