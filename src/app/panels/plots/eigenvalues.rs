//! Eigenvalues in the complex plane; a click chooses the mode whose shape moves on the canvas.

use std::f64::consts::TAU;

use eframe::egui::{Align2, Pos2, Rect, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};

use super::axis::signed;
use super::chart::{self, Chart, Dash, Symbol, Titles};
use super::common::{self, PlotPlace, Slot, brief, near, with_modes};
use super::modes::{self, moved};
use super::range::{self, VisibleRange};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::series;
use crate::app::settings::Settings;
use crate::compute::protocol::{AnalysedPose, ModeRow, Topic};
use crate::stability::Critical;

/// What the plot shows, in plain words.
pub const MEANING: &str = "Every point is a way in which the robot vibrates at the present speed: how fast it grows (to \
    the right) or dies away (to the left), and how often it swings. One point right of the line is enough for \
    instability. The grey traces are the way that the points have come from rest, and go on to the critical speed; \
    there the first of them crosses the line.";

/// A click chooses a point that is at most this far away, in points.
const REACH: f32 = 24.0;
/// So high the plot is at least before the table of modes gets room below it, in points.
const PLOT: f32 = 300.0;
/// The table's width beside the plot.
const TABLE: f32 = 190.0;
/// This many of the lowest modes matter.
const LOWEST: usize = 6;
/// The rows of the table below the plot, at most: these modes and what the columns are.
const ROWS: f32 = 7.0;

/// Draws the plot, and the short table of modes where it has room.
pub fn ui(place: PlotPlace, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    if let Some(note) = common::note_on_modes(facts.answers) {
        common::say(ui, note);
    }
    let Some(pose) = with_modes(facts.answers) else { return };
    let room = ui.available_rect_before_wrap();
    let table = match place.slot {
        Slot::Right | Slot::Second | Slot::Large => {
            if room.width() > 1.15 * room.height() && room.width() > PLOT + TABLE {
                Some(Rect::from_min_max(Pos2::new(room.right() - TABLE, room.top()), room.max))
            } else {
                let free = room.height() - PLOT.max(0.55 * room.height());
                (free > 3.0 * modes::row(ui)).then(|| {
                    let rows = (free / modes::row(ui)).floor().min(ROWS);
                    Rect::from_min_max(Pos2::new(room.left(), room.bottom() - rows * modes::row(ui)), room.max)
                })
            }
        }
        Slot::Dock | Slot::Sheet | Slot::Under | Slot::Present | Slot::Picture => None,
    };
    let mut outer = room;
    match table {
        Some(table) if table.top() > room.top() => outer.max.y = table.top() - 4.0,
        Some(table) => outer.max.x = table.left() - 8.0,
        None => {}
    }
    let response = ui.allocate_rect(outer, Sense::click_and_drag());
    plot(place, ui, &response, facts, pose, commands);
    if let Some(table) = table {
        modes::short(ui, table, facts, pose, commands);
    }
}

/// A mode as a point: growth rate in 1/s and frequency in the unit chosen.
fn point([re, im]: [f64; 2], hertz: f64) -> [f64; 2] {
    [re, im.abs() / TAU * hertz]
}

fn plot(
    place: PlotPlace,
    ui: &Ui,
    response: &Response,
    facts: Facts<'_>,
    pose: &AnalysedPose,
    commands: &mut Vec<Command>,
) {
    let Facts { answers, settings, designs, mode: choice, .. } = facts;
    let grey = answers.pose_failed();
    let (hertz, unit) = settings.hertz();
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, told(&pose.modes, settings, grey)));
    let eigenvalues: Vec<[f64; 2]> = pose.modes.iter().map(|mode| mode.eigenvalue).collect();
    let critical = answers.last_critical().and_then(|answer| answer.critical.as_ref());
    let in_unit = |[x, y]: [[f64; 2]; 2]| [x, y.map(|hz| hz * hertz)];
    let fit = in_unit(fit(&eigenvalues, critical.map(Critical::frequency_hz)));
    let all = in_unit(all(&eigenvalues));

    // The caption stands below.
    let trace = common::study(Topic::Campbell, facts);
    let speed = critical.map(|critical| common::speed(facts, critical));
    let caption = if grey {
        Some(common::KEPT.to_owned())
    } else {
        speed.as_ref().filter(|_| trace.is_some()).map(|speed| format!("Grey: the way from rest to {speed} m/s."))
    };
    let outer = response.rect.with_max_y(response.rect.bottom() - 1.5 * chart::font(ui).size);
    let title = format!("frequency, {unit}");
    let titles = Titles { x: Some("growth rate Re λ, 1/s"), x_unit: None, y: Some(&title) };
    let inner = chart::inner(ui, outer, titles);
    let axes = Chart::axes(inner, VisibleRange::of(ui.ctx(), place.id()).bounds(fit, all));
    let mut chart = Chart::new(ui, outer, inner, axes);
    let tokens = chart.tokens;
    let shade = |colour| if grey { tokens.mute } else { colour };

    chart.band([0.0, f64::MAX], true, if grey { tokens.field } else { tokens.critical_fill });
    chart.grid(titles);
    let zero = chart.pos([0.0, 0.0]).x;
    chart.upright(0.0, Stroke::new(1.5, shade(tokens.critical)), Dash::Solid);
    let words = |colour| if grey { tokens.weak } else { colour };
    chart.label_at("grows", words(tokens.critical), Pos2::new(zero + 2.0, inner.top() + 2.0), Align2::LEFT_TOP);
    chart.label_at("dies out", words(tokens.stable), Pos2::new(zero - 2.0, inner.top() + 2.0), Align2::RIGHT_TOP);

    if let Some(shown) = trace {
        // While a pose is dragged they are a moment old.
        let colour = if shown.current { tokens.mute } else { tokens.mute.gamma_multiply(0.5) };
        let end = critical.map_or(f64::INFINITY, |critical| critical.speed);
        for (speed, value) in series::spectra(shown.known) {
            let at = chart.pos(point([value.re, value.im], hertz));
            if speed <= end && inner.contains(at) {
                chart.painter.circle_filled(at, 1.1, colour);
            }
        }
    }
    for (letter, design) in designs.shown() {
        let colour = letter.colour(ui.visuals());
        let modes = design.pose().map(|pose| pose.modes.as_slice()).unwrap_or_default();
        for mode in modes {
            chart.mark(chart.pos(point(mode.eigenvalue, hertz)), Symbol::Diamond, 4.0, colour);
        }
        // The fastest growing mode says whose they are.
        if let Some(last) = modes.iter().max_by(|a, b| a.eigenvalue[0].total_cmp(&b.eigenvalue[0])) {
            let at = chart.pos(point(last.eigenvalue, hertz));
            if inner.contains(at) {
                chart.label(letter.name(), colour, &[at]);
            }
        }
    }
    let places: Vec<Pos2> = eigenvalues.iter().map(|&value| at_edge(&chart, point(value, hertz))).collect();
    for (&at, [growth, _]) in places.iter().zip(&eigenvalues) {
        let (mark, radius, colour) =
            if *growth > 0.0 { (Symbol::Triangle, 6.0, tokens.critical) } else { (Symbol::Dot, 4.5, tokens.stable) };
        if inner.expand(radius).contains(at) {
            chart.keep_free(at, radius);
        }
        chart.mark(at, mark, radius, shade(colour));
    }
    let ring = answers.shape().map(|shape| shape.eigenvalue).filter(|_| !grey);
    if let Some(ring) = ring {
        chart.mark(at_edge(&chart, point(ring, hertz)), Symbol::Ring, 9.0, tokens.accent);
    }
    if let (Some(critical), Some(speed)) = (critical.filter(|_| !grey), speed) {
        let at = chart.pos([0.0, critical.frequency_hz() * hertz]);
        chart.mark(at, Symbol::Ring, 6.0, tokens.critical);
        if inner.expand(2.0).contains(at) {
            let left = at - Vec2::new(10.0, 0.0);
            chart.label(format!("{speed} m/s"), tokens.critical, &[left]);
        }
    }
    chart.finish();
    if let Some(caption) = caption {
        let at = Pos2::new(inner.left().min(response.rect.left() + 40.0), response.rect.bottom());
        let painter = ui.painter_at(response.rect);
        painter.text(at, Align2::LEFT_BOTTOM, caption, chart::font(ui), tokens.weak);
    }
    range::turn(ui, response, place.id(), axes, fit, place.turning([true, true]));

    let nearest = |pointer: Pos2| {
        let distances = places.iter().map(|at| at.distance(pointer)).enumerate();
        distances.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, distance)| *distance < REACH).map(|(i, _)| i)
    };
    let hovered = response.hover_pos().filter(|_| !response.dragged()).and_then(nearest);
    // A finger does not hover: there the chosen one says what it is.
    let chosen = || eigenvalues.iter().position(|value| Some(*value) == ring);
    let named = hovered.or_else(|| chosen().filter(|_| place.slot.is_sheet()));
    if let Some(i) = named.filter(|&i| inner.expand(8.0).contains(places[i])) {
        chart.mark(places[i], Symbol::Ring, 7.0, tokens.text);
        chart.card(places[i], &lines(&pose.modes[i], settings));
    }
    if let Some(clicked) = response.interact_pointer_pos().filter(|_| response.clicked() && !grey)
        && let Some(i) = nearest(clicked)
    {
        commands.push(Command::ChooseMode(near(choice, eigenvalues[i])));
    }
}

/// Where a mode is drawn: one that grows is never out of sight to the right.
fn at_edge(chart: &Chart, point: [f64; 2]) -> Pos2 {
    let at = chart.pos(point);
    if point[0] > 0.0 { Pos2::new(at.x.min(chart.rect.right() - 8.0), at.y) } else { at }
}

/// A mode's name in two lines.
fn lines(mode: &ModeRow, settings: Settings) -> [String; 2] {
    let (hertz, unit) = settings.hertz();
    let [growth, _] = mode.eigenvalue;
    let how = if growth > 0.0 {
        format!("grows {} 1/s", brief(growth))
    } else if mode.frequency_hz > 0.0 {
        format!("damping {} %", brief(100.0 * mode.damping_ratio))
    } else {
        format!("dies out {} 1/s", brief(growth))
    };
    let what = if mode.frequency_hz > 0.0 {
        format!("{} {unit}", brief(mode.frequency_hz * hertz))
    } else {
        "no oscillation".into()
    };
    [format!("{what}, {how}"), format!("moves {}", moved(mode))]
}

/// The plot in a sentence, for those who do not see it.
fn told(modes: &[ModeRow], settings: Settings, kept: bool) -> String {
    let (hertz, unit) = settings.hertz();
    let highest = modes.iter().map(|mode| mode.frequency_hz).fold(0.0, f64::max);
    let growing = modes.iter().filter(|mode| mode.eigenvalue[0] > 0.0).count();
    let how = match growing {
        0 => "all die out".to_owned(),
        1 => "one grows".to_owned(),
        more => format!("{more} grow"),
    };
    let least = modes.iter().max_by(|a, b| a.eigenvalue[0].total_cmp(&b.eigenvalue[0]));
    let least = least.map_or_else(String::new, |mode| {
        let frequency = brief(mode.frequency_hz * hertz);
        let growth = signed(&digits::certain(mode.eigenvalue[0], Some(0.04 * mode.eigenvalue[0].abs())));
        let name = if growing > 0 { "the one that grows fastest is" } else { "the least damped is" };
        format!("; {name} at {frequency} {unit}, growth {growth} 1/s, and moves {}", moved(mode))
    });
    let kept = if kept { " These belong to the last pose that can rest." } else { "" };
    format!("Eigenvalues: {} modes up to {} {unit}, {how}{least}.{kept}", modes.len(), brief(highest * hertz))
}

/// What matters, in 1/s and Hz: from rest to three times the critical frequency and to the lowest modes, near the axis,
/// with every mode that grows.
fn fit(eigenvalues: &[[f64; 2]], critical_hz: Option<f64>) -> [[f64; 2]; 2] {
    let hz = |[_, im]: [f64; 2]| im.abs() / TAU;
    let mut frequencies: Vec<f64> = eigenvalues.iter().map(|&value| hz(value)).collect();
    frequencies.sort_by(f64::total_cmp);
    let lowest = frequencies.get(LOWEST - 1).or(frequencies.last()).copied().unwrap_or(0.0);
    let growing = eigenvalues.iter().filter(|value| value[0] > 0.0).map(|&value| hz(value)).fold(0.0, f64::max);
    let top = [3.0 * critical_hz.unwrap_or(0.0), 1.12 * lowest, 1.12 * growing].into_iter().fold(0.0, f64::max);
    let top = if top > 0.0 { top } else { 1.0 };
    // What is overdamped lies far to the left.
    let near_axis = |[re, im]: [f64; 2]| re > 0.0 || re.abs() < 0.5 * re.hypot(im);
    let seen = || eigenvalues.iter().filter(|&&value| hz(value) <= top && near_axis(value)).map(|value| value[0]);
    let low = seen().fold(0.0, f64::min);
    let high = seen().fold(0.0, f64::max);
    let span = if high > low { high - low } else { 1.0 };
    [[low - 0.08 * span, high + 0.3 * span], [0.0, top]]
}

/// All there is, in 1/s and Hz.
fn all(eigenvalues: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let growth = || eigenvalues.iter().map(|value| value[0]);
    let (low, high) = (growth().fold(0.0, f64::min), growth().fold(0.0, f64::max));
    let span = if high > low { high - low } else { 1.0 };
    let top = eigenvalues.iter().map(|value| value[1].abs() / TAU).fold(0.0, f64::max);
    [[low - 0.05 * span, high + 0.08 * span], [0.0, if top > 0.0 { 1.05 * top } else { 1.0 }]]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mode(growth: f64, frequency_hz: f64, cable_share: Vec<f64>, platform_share: f64) -> ModeRow {
        let eigenvalue = [growth, frequency_hz * TAU];
        let damping_ratio = -growth / growth.hypot(eigenvalue[1]);
        ModeRow { eigenvalue, multiplicity: 1, frequency_hz, damping_ratio, cable_share, platform_share }
    }

    #[test]
    fn what_matters_is_near_the_axis_and_no_mode_that_grows_is_left_out() {
        let at = |growth: f64, hz: f64| [growth, TAU * hz];
        let mut modes = vec![at(-0.26, 0.31), at(-0.26, 0.49), at(-0.27, 0.58), at(-0.34, 0.94), at(-0.5, 0.97)];
        modes.extend([at(-0.18, 0.98), at(-40.0, 0.0), at(-3.0, 8.0), at(-9.0, 20.0)]);
        let [[left, right], [bottom, top]] = fit(&modes, Some(0.27));
        assert!((-0.6..-0.5).contains(&left) && (0.1..0.2).contains(&right), "{left} {right}");
        assert!(bottom == 0.0 && (0.98..1.2).contains(&top), "{top}");
        let [_, [_, top]] = fit(&modes, Some(1.0));
        assert!((top - 3.0).abs() < 1e-12);
        modes.push(at(2.0, 12.0));
        let [[_, right], [_, top]] = fit(&modes, Some(0.27));
        assert!(right > 2.0 && top > 12.0);
        let [[left, _], [_, top]] = all(&modes);
        assert!(left < -40.0 && top > 20.0);
        let [low, high] = fit(&[], None)[1];
        assert!(low.abs() < 1e-12 && (high - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_mode_is_named_by_what_a_person_sees() {
        let stable = mode(-0.26, 0.315, vec![0.02, 0.03, 0.4, 0.5], 0.05);
        assert_eq!(lines(&stable, Settings::default())[1], "moves cables 3, 4");
        assert!(lines(&stable, Settings::default())[0].ends_with(" Hz, damping 13 %"));
        let unstable = mode(0.08, 0.22, vec![0.0, 0.1, 0.1, 0.8], 0.0);
        assert_eq!(lines(&unstable, Settings::default()), ["0.22 Hz, grows 0.080 1/s", "moves cable 4"]);
        let overdamped = mode(-3.0, 0.0, vec![0.1, 0.1], 0.8);
        assert_eq!(
            lines(&overdamped, Settings::default()),
            ["no oscillation, dies out −3.0 1/s", "moves the platform"]
        );
    }

    #[test]
    fn the_sentence_names_the_least_damped() {
        let modes = [mode(-0.5, 0.3, vec![1.0], 0.0), mode(-0.18, 0.98, vec![0.9, 0.1], 0.0)];
        let text = told(&modes, Settings::default(), false);
        assert_eq!(
            text,
            "Eigenvalues: 2 modes up to 0.98 Hz, all die out; the least damped is at 0.98 Hz, growth −0.18 1/s, and \
             moves cable 1."
        );
        let modes = [mode(0.5, 0.3, vec![1.0], 0.0), modes[1].clone()];
        assert!(
            told(&modes, Settings::default(), false).contains("one grows; the one that grows fastest is at 0.30 Hz")
        );
    }
}
