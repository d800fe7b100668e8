//! The answer while there is a path: what the move does, as a card and as a line.

use eframe::egui::{
    Align, Align2, Color32, FontId, Label, Layout, Pos2, Rect, Response, RichText, Sense, Shape, Stroke, StrokeKind,
    Ui, UiBuilder, Vec2,
};

use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::{Facts, FlightKnown};
use crate::app::flying::{Instant, slack_text};
use crate::app::meaning::Explain as _;
use crate::app::series;
use crate::app::theme;
use crate::app::words::{self, Word};
use crate::scenario::{Path, ProfileKind};

/// The card's width and height in points.
pub const CARD: Vec2 = Vec2::new(336.0, 168.0);
/// Where the columns of the rows are, in points from the left: figures end there.
const FIGURES: f32 = 210.0;
/// What is not known yet.
const WAITS: &str = "…";

/// What the studies of the path say of the move; what they do not say yet is missing.
#[derive(Clone, Copy, Debug, Default)]
struct Effect {
    /// The largest of the speed over the wave limit.
    ratio: Option<f64>,
    /// How many times larger any vibration can be after the move.
    gain: Option<f64>,
    /// The frozen critical speed at the present place in m/s, and its cable, 0-based.
    frozen: Option<(f64, usize)>,
    /// The wave limit at the present place in m/s, and its cable, 0-based.
    waves: Option<(f64, usize)>,
}

/// What is known of the move at arc length `s` (m).
fn effect(facts: Facts<'_>, s: f64) -> Effect {
    let of_move = series::effect(facts).filter(|(_, current)| *current).map(|(effect, _)| effect);
    let station = series::station(facts, s);
    Effect {
        ratio: of_move.and_then(|effect| effect.wave_ratio).map(|ratio| ratio.value),
        gain: of_move.and_then(|effect| effect.gain).map(|gain| gain.action),
        frozen: station.and_then(|station| station.verdict.critical()).map(|found| (found.speed, found.cable)),
        waves: station.and_then(|station| station.wave_limit).map(|limit| (limit.speed, limit.cable)),
    }
}

/// The present moment: time, arc length and speed along the path.
fn now(facts: Facts<'_>) -> Option<[f64; 3]> {
    let flown = facts.flown()?;
    let time = facts.flying.time.min(flown.flight.lost.unwrap_or(flown.flight.end));
    let instant = Instant::new(flown, time, 1.0)?;
    Some([time, instant.s, instant.speed])
}

/// Draws the card with its upper left corner at `corner`. Gives where it is.
pub fn card(ui: &mut Ui, corner: Pos2, path: &Path, facts: Facts<'_>, commands: &mut Vec<Command>) -> Rect {
    let tokens = theme::tokens(ui.visuals());
    let rect = Rect::from_min_size(corner, CARD);
    // The card keeps the pointer from what is under it.
    ui.interact(rect, ui.scope_id().with("answer card"), Sense::click());
    ui.painter().rect(rect, 8.0, tokens.card, Stroke::new(1.0, tokens.line), StrokeKind::Inside);
    let inner = rect.shrink2(Vec2::new(15.0, 10.0));
    ui.scope_builder(UiBuilder::new().max_rect(inner).layout(Layout::top_down(Align::Min)), |ui| {
        ui.spacing_mut().item_spacing = Vec2::new(4.0, 1.0);
        ui.spacing_mut().interact_size.y = 16.0;
        ui.set_clip_rect(rect.intersect(ui.clip_rect()));
        content(ui, path, facts, commands);
    });
    rect
}

/// The column of a presentation.
pub fn column(ui: &mut Ui, path: &Path, facts: Facts<'_>, commands: &mut Vec<Command>) {
    content(ui, path, facts, commands);
}

fn content(ui: &mut Ui, path: &Path, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let tokens = theme::tokens(ui.visuals());
    let now = now(facts);
    let effect = effect(facts, now.map_or(0.0, |[_, s, _]| s));
    heading(ui, path, effect);
    ui.horizontal(|ui| {
        let figure = format!("ρ {}", figure(effect.ratio));
        let meaning = "ρ is the largest of the platform's speed over the wave limit along the move. Below 1 no vibration \
                       grows without bound.";
        ui.add(Label::new(RichText::new(figure).font(FontId::proportional(theme::FIGURE)))).explained(meaning);
        ui.vertical(|ui| {
            ui.add_space(4.0);
            ui.horizontal(|ui| {
                ui.label("of the");
                words::link(ui, Word::WaveLimit, "wave limit", commands);
                ui.label("at most;");
            });
            ui.horizontal(|ui| {
                ui.label(format!("vibration ends at × {}", gain_text(effect.gain)));
                words::link(ui, Word::Gain, "gain", commands);
            });
        });
    });
    let at = |place: Option<(f64, usize)>| {
        place.map_or((WAITS.to_owned(), String::new()), |(speed, cable)| {
            (format!("{} m/s", digits::certain(speed, None)), format!("here, cable {}", cable + 1))
        })
    };
    row(ui, Some(Word::FrozenTime), "Frozen critical speed", at(effect.frozen), tokens.critical, commands);
    row(ui, Some(Word::WaveLimit), "Wave limit", at(effect.waves), tokens.waves, commands);
    let moment = now.map_or((WAITS.to_owned(), String::new()), |[time, _, speed]| {
        (format!("{speed:.2} m/s"), format!("t = {time:.2} s"))
    });
    row(ui, None, "Now", moment, tokens.accent, commands);
    last(ui, facts, commands);
}

/// Which move it is, and on which side of the wave limit.
fn heading(ui: &mut Ui, path: &Path, effect: Effect) {
    let tokens = theme::tokens(ui.visuals());
    ui.horizontal(|ui| {
        let text = format!("This move, {}", name(path));
        ui.label(RichText::new(text).size(theme::CAPTION).color(tokens.weak));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let Some(ratio) = effect.ratio else { return };
            let (word, colour) = if ratio < 1.0 {
                ("below the wave limit", tokens.stable)
            } else {
                ("above the wave limit", tokens.critical)
            };
            let word = ui.label(RichText::new(word).size(theme::CAPTION).color(colour));
            let at = word.rect.left_center() - Vec2::new(11.0, 0.0);
            if ratio < 1.0 {
                ui.painter().circle_filled(at, 5.0, colour);
            } else {
                triangle(ui, at, colour);
            }
        });
    });
}

/// A profile with its speed in words.
fn name(path: &Path) -> String {
    let speed = path.speed;
    match path.profile {
        ProfileKind::Quintic => format!("quintic to {speed:.2} m/s"),
        ProfileKind::Trapezoid => format!("trapezoid to {speed:.2} m/s"),
        ProfileKind::Scurve => format!("S-curve to {speed:.2} m/s"),
        ProfileKind::Constant => format!("constant at {speed:.2} m/s"),
    }
}

fn figure(value: Option<f64>) -> String {
    value.map_or(WAITS.to_owned(), |value| format!("{value:.2}"))
}

fn gain_text(value: Option<f64>) -> String {
    value.map_or(WAITS.to_owned(), |value| digits::certain(value, Some(0.005)))
}

/// One line of figures; its name opens the card of a word.
fn row(
    ui: &mut Ui,
    word: Option<Word>,
    name: &str,
    (value, place): (String, String),
    colour: Color32,
    commands: &mut Vec<Command>,
) {
    let tokens = theme::tokens(ui.visuals());
    let weak = tokens.weak;
    ui.horizontal(|ui| {
        let rect = ui.max_rect();
        ui.set_min_height(20.0);
        if let Some(word) = word {
            // The mark has the colour of its curve; the name has that of words that open a card.
            let (mark, _) = ui.allocate_exact_size(Vec2::new(8.0, 16.0), Sense::hover());
            ui.painter().circle_filled(mark.center(), 3.5, colour);
            words::link(ui, word, name, commands);
        } else {
            let (mark, _) = ui.allocate_exact_size(Vec2::new(8.0, 16.0), Sense::hover());
            ui.painter().circle_filled(mark.center(), 3.5, colour);
            ui.label(name);
        }
        let middle = ui.min_rect().center().y;
        let font = FontId::proportional(theme::BODY);
        ui.painter().text(Pos2::new(rect.min.x + FIGURES, middle), Align2::RIGHT_CENTER, &value, font, tokens.text);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label(RichText::new(place).size(theme::CAPTION).color(weak));
        });
    });
}

/// What else there is to know of the flight: slack before all.
fn last(ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    let tokens = theme::tokens(ui.visuals());
    ui.horizontal(|ui| match facts.flight() {
        FlightKnown::Flown(flown) => {
            if let Some(slack) = flown.flight.slack {
                let (mark, _) = ui.allocate_exact_size(Vec2::new(13.0, 16.0), Sense::hover());
                triangle(ui, mark.center(), tokens.critical);
                let least = digits::certain(slack.force, None);
                let meaning = format!("An element would have to push: {least} N at least over the whole flight.");
                ui.label(RichText::new(format!("Cable {}", slack.cable + 1)).color(tokens.critical));
                words::link(ui, Word::Slack, "slack", commands);
                let text = format!("at {:.2} s: doubtful from there.", slack.time);
                ui.add(Label::new(RichText::new(text).color(tokens.critical)).truncate()).explained(meaning);
            } else if let Some(lost) = flown.flight.lost {
                let text = format!("The flight could not be computed beyond {lost:.2} s.");
                ui.label(RichText::new(text).color(tokens.critical));
            } else {
                let off = digits::certain(1e3 * flown.flight.max_deviation, None);
                ui.label(format!("Off its path by {off} mm at most; no cable goes slack."));
            }
        }
        FlightKnown::Failed(reason) => {
            let text = format!("There is no flight: {reason}.");
            ui.add(Label::new(RichText::new(&text).color(tokens.critical)).truncate()).explained(text);
        }
        FlightKnown::Stopped => _ = ui.label("The flight was not computed to its end."),
        FlightKnown::Waits | FlightKnown::NoPath => _ = ui.weak("The flight is being computed."),
    });
}

fn triangle(ui: &Ui, at: Pos2, colour: Color32) {
    let corners = [[-5.5, 4.5], [0.0, -5.0], [5.5, 4.5]].map(|[x, y]| at + Vec2::new(x, y)).to_vec();
    ui.painter().add(Shape::convex_polygon(corners, colour, Stroke::NONE));
}

/// The answer in one line.
pub fn line(ui: &mut Ui, path: &Path, facts: Facts<'_>) -> Response {
    let tokens = theme::tokens(ui.visuals());
    let ratio = effect(facts, 0.0).ratio;
    ui.label(RichText::new(format!("ρ {}", figure(ratio))).size(19.0));
    let (text, colour) = match facts.flight() {
        FlightKnown::Flown(flown) => match slack_text(flown) {
            Some(text) => (text, tokens.critical),
            None => (format!("· {}", name(path)), tokens.text),
        },
        FlightKnown::Failed(reason) => (format!("There is no flight: {reason}."), tokens.critical),
        _ => (format!("· {}", name(path)), tokens.weak),
    };
    ui.add(Label::new(RichText::new(&text).color(colour)).truncate()).explained(text)
}
