//! The table of modes; a click on a row chooses the mode whose shape moves on the canvas.

use eframe::egui::{
    Align2, Color32, Label, Rect, RichText, Role, Sense, Stroke, StrokeKind, TextStyle, Ui, UiBuilder, WidgetInfo,
};
use egui_extras::{Column, TableBuilder};

use super::axis::signed;
use super::common::{self, near, with_modes};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::theme;
use crate::compute::protocol::{AnalysedPose, ModeRow};
use crate::stability::{TIE_OF_SHARES, first_largest};

/// What the plot shows, in plain words.
pub const MEANING: &str = "Every row is a way in which the robot vibrates at the present speed: how often it swings, how \
    fast it grows or dies away (1/s; above zero it grows), how much it is damped, and what moves most. Click one to see it \
    move.";

/// Draws the table.
pub fn ui(ui: &mut Ui, Facts { answers, settings, designs, mode: choice, .. }: Facts<'_>, commands: &mut Vec<Command>) {
    if let Some(note) = common::note_on_modes(answers) {
        common::say(ui, note);
    }
    let Some(pose) = with_modes(answers) else { return };
    let grey = answers.pose_failed();
    if grey {
        common::say(ui, common::KEPT);
    }
    let (hertz, unit) = settings.hertz();
    let chosen = answers.shape().filter(|shape| !shape.is_critical).map(|shape| shape.eigenvalue);
    // There is room for the difference to one of them.
    let compared = designs.shown().find_map(|(letter, design)| Some((letter, design.pose()?.modes.as_slice())));
    let before = compared.map(|(_, modes)| modes);
    if let Some((letter, _)) = compared {
        let text = format!("In brackets: the difference to the nearest mode of design {}.", letter.name());
        ui.colored_label(letter.colour(ui.visuals()), text);
    }
    let height = ui.available_height();
    let row_height = row(ui);
    // Where there is little room, columns say less.
    let narrow = ui.available_width() < 330.0;
    ui.spacing_mut().item_spacing.x = if narrow { 4.0 } else { 12.0 };
    let least = if narrow { 40.0 } else { 64.0 };
    TableBuilder::new(ui)
        .id_salt("modes")
        .sense(Sense::click())
        .max_scroll_height((height - row_height).max(60.0))
        .min_scrolled_height(60.0)
        .column(Column::auto().at_least(28.0))
        .columns(Column::auto().at_least(least), 3)
        .column(Column::remainder())
        .header(row_height, |mut header| {
            let titles = [
                ("#", "The modes by frequency. 3×2 is the third one, which is there twice, as along x and along y."),
                (unit, "The frequency of the vibration, Im λ; 0 where it does not oscillate."),
                (
                    if narrow { "grows" } else { "grows, 1/s" },
                    "The growth rate Re λ: above zero (▲) the vibration grows, below it dies away.",
                ),
                (
                    if narrow { "damp." } else { "damping" },
                    "The damping ratio ζ = −Re λ/|λ|. Below zero the vibration grows.",
                ),
                (
                    if narrow { "cable" } else { "moves mostly" },
                    "What has most of the vibration's kinetic energy, and its part of it.",
                ),
            ];
            for (title, meaning) in titles {
                header.col(|ui| {
                    ui.weak(title).explained(meaning);
                });
            }
        })
        .body(|body| {
            body.rows(row_height, pose.modes.len(), |mut row| {
                let i = row.index();
                let mode = &pose.modes[i];
                row.set_selected(chosen == Some(mode.eigenvalue));
                let name = if mode.multiplicity > 1 {
                    format!("{}×{}", i + 1, mode.multiplicity)
                } else {
                    (i + 1).to_string()
                };
                let [growth, _] = mode.eigenvalue;
                let cable = with_share(mode, narrow);
                let sign = if growth > 0.0 { "▲ " } else { "" };
                let from = before.and_then(|modes| nearest(modes, mode.eigenvalue));
                let difference = |now: f64, then: Option<f64>| {
                    then.map_or_else(String::new, |then| signed(&format!(" ({})", digits::with_sign(now - then, None))))
                };
                let frequency = mode.frequency_hz * hertz;
                let frequency_then = from.map(|mode| mode.frequency_hz * hertz);
                let growth_then = from.map(|mode| mode.eigenvalue[0]);
                let cells = [
                    name,
                    digits::certain(frequency, None) + &difference(frequency, frequency_then),
                    sign.to_owned() + &signed(&digits::certain(growth, None)) + &difference(growth, growth_then),
                    damping(mode),
                    cable,
                ];
                let exact = [
                    String::new(),
                    format!("{frequency} {unit}"),
                    format!("{growth} 1/s"),
                    mode.damping_ratio.to_string(),
                    String::new(),
                ];
                for (i, (cell, exact)) in cells.into_iter().zip(exact).enumerate() {
                    // Growth has its colour, and its sign beside it.
                    row.col(|ui| show(ui, cell, exact, i == 2 && growth > 0.0, grey));
                }
                if row.response().clicked() && !grey {
                    commands.push(Command::ChooseMode(near(choice, mode.eigenvalue)));
                }
            });
        });
}

/// A cell of the table, with the exact number for those who rest on it.
fn show(ui: &mut Ui, cell: String, exact: String, grows: bool, grey: bool) {
    let tokens = theme::tokens(ui.visuals());
    let colour = match (grey, grows) {
        (true, _) => tokens.weak,
        (false, true) => tokens.critical,
        (false, false) => tokens.text,
    };
    // A selectable label would keep the click from the row.
    let response = ui.add(Label::new(RichText::new(cell).color(colour)).selectable(false));
    if !exact.is_empty() {
        response.explained_at_rest(exact);
    }
}

/// The mode with the nearest eigenvalue.
fn nearest(modes: &[ModeRow], [re, im]: [f64; 2]) -> Option<&ModeRow> {
    let distance = |mode: &ModeRow| (mode.eigenvalue[0] - re).hypot(mode.eigenvalue[1] - im);
    modes.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// The height of a row, in points.
pub fn row(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y.max(26.0)
}

/// The few modes that matter, with what moves; as many as have room in `rect`.
pub fn short(ui: &mut Ui, rect: Rect, facts: Facts<'_>, pose: &AnalysedPose, commands: &mut Vec<Command>) {
    let Facts { answers, settings, mode: choice, .. } = facts;
    let tokens = theme::tokens(ui.visuals());
    let grey = answers.pose_failed();
    let (hertz, unit) = settings.hertz();
    let chosen = answers.shape().filter(|shape| !shape.is_critical && !grey).map(|shape| shape.eigenvalue);
    let (text, small) = (TextStyle::Body.resolve(ui.style()), TextStyle::Small.resolve(ui.style()));
    let height = row(ui);
    let wide = rect.width() > 230.0;
    // The right ends of all columns but the first, which is on the left.
    let columns: &[(&str, f32)] = if wide {
        &[("damping", 0.38), ("grows, 1/s", 0.66), ("moves mostly", 1.0)]
    } else {
        &[("damping", 0.5), ("moves mostly", 1.0)]
    };
    let painter = ui.painter_at(rect);
    let cell = |row: Rect, i: usize, words: &str, font: &eframe::egui::FontId, colour: Color32| {
        let row = row.shrink2([4.0, 0.0].into());
        let (at, align) = match i.checked_sub(1).and_then(|i| columns.get(i)) {
            None => (row.left_center(), Align2::LEFT_CENTER),
            Some((_, part)) => {
                (eframe::egui::pos2(row.left() + part * row.width(), row.center().y), Align2::RIGHT_CENTER)
            }
        };
        painter.text(at, align, words, font.clone(), colour);
    };
    let mut line = Rect::from_min_size(rect.min, [rect.width(), height].into());
    for (i, title) in std::iter::once(unit).chain(columns.iter().map(|(title, _)| *title)).enumerate() {
        cell(line, i, title, &small, tokens.weak);
    }
    for mode in in_order(&pose.modes) {
        line = line.translate([0.0, height].into());
        if line.bottom() > rect.bottom() + 0.5 {
            break;
        }
        let [growth, _] = mode.eigenvalue;
        let frequency = signed(&digits::certain(mode.frequency_hz * hertz, None));
        let growth_text = signed(&digits::certain(growth, None));
        let name = format!("{frequency} {unit}, growth {growth_text} 1/s, moves {}", moved(mode));
        let sense = if grey { Sense::hover() } else { Sense::click() };
        let row = ui.scope_builder(UiBuilder::new().max_rect(line), |ui| ui.allocate_rect(line, sense)).inner;
        let selected = chosen == Some(mode.eigenvalue);
        row.widget_info(|| WidgetInfo::selected(Role::Button, !grey, selected, &name));
        if selected {
            painter.rect_filled(line, 4.0, tokens.accent_fill);
        } else if row.hovered() {
            painter.rect_filled(line, 4.0, tokens.field);
        }
        if row.has_focus() {
            painter.rect_stroke(line, 4.0, Stroke::new(2.0, tokens.accent), StrokeKind::Inside);
        }
        let colour = match (grey, growth > 0.0) {
            (true, _) => tokens.weak,
            (false, true) => tokens.critical,
            (false, false) => tokens.text,
        };
        let first = if growth > 0.0 { format!("{frequency} ▲") } else { frequency };
        let mut words = vec![first, damping(mode)];
        if wide {
            words.push(growth_text);
        }
        words.push(moves_mostly(mode));
        for (i, words) in words.iter().enumerate() {
            cell(line, i, words, &text, colour);
        }
        if row.clicked() {
            commands.push(Command::ChooseMode(near(choice, mode.eigenvalue)));
        }
    }
}

/// Those that grow first, else by frequency.
fn in_order(modes: &[ModeRow]) -> Vec<&ModeRow> {
    let mut modes: Vec<&ModeRow> = modes.iter().collect();
    modes.sort_by_key(|mode| mode.eigenvalue[0] <= 0.0);
    modes
}

/// A damping ratio in percent; nothing of a mode that does not oscillate.
fn damping(mode: &ModeRow) -> String {
    if mode.frequency_hz > 0.0 {
        format!("{} %", signed(&format!("{:.1}", 100.0 * mode.damping_ratio + 0.0)))
    } else {
        "–".into()
    }
}

/// The cables that a mode moves: those with at least half of the largest share of the kinetic energy, from 0. `None` where
/// the platform has more than any of them.
fn cables(mode: &ModeRow) -> Option<Vec<usize>> {
    let shares = &mode.cable_share;
    let largest = shares[first_largest(shares.iter().copied(), TIE_OF_SHARES)?];
    if mode.platform_share > largest {
        return None;
    }
    Some((0..shares.len()).filter(|&cable| shares[cable] >= 0.5 * largest - TIE_OF_SHARES).collect())
}

/// What a mode moves, as a table says it.
fn moves_mostly(mode: &ModeRow) -> String {
    match cables(mode) {
        None => "platform".into(),
        Some(cables) if cables.len() > 2 && cables.len() == mode.cable_share.len() => "all".into(),
        Some(cables) => format!("cable {}", numbers(&cables)),
    }
}

/// What a mode moves, in a sentence.
pub fn moved(mode: &ModeRow) -> String {
    match cables(mode) {
        None => "the platform".into(),
        Some(cables) if cables.len() > 2 && cables.len() == mode.cable_share.len() => "all cables".into(),
        Some(cables) if cables.len() == 1 => format!("cable {}", numbers(&cables)),
        Some(cables) => format!("cables {}", numbers(&cables)),
    }
}

fn numbers(cables: &[usize]) -> String {
    let numbers: Vec<String> = cables.iter().map(|cable| (cable + 1).to_string()).collect();
    numbers.join(", ")
}

/// What has most of a mode's kinetic energy, and its part of it.
fn with_share(mode: &ModeRow, narrow: bool) -> String {
    let word = if narrow { "" } else { "cable " };
    let shares = &mode.cable_share;
    match first_largest(shares.iter().copied(), TIE_OF_SHARES).map(|cable| (cable, shares[cable])) {
        Some((_, share)) if share < mode.platform_share => format!("platform {:.0} %", 100.0 * mode.platform_share),
        Some((cable, share)) => format!("{word}{} ({:.0} %)", cable + 1, 100.0 * share),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mode(growth: f64, cable_share: Vec<f64>, platform_share: f64) -> ModeRow {
        let eigenvalue = [growth, 2.0];
        ModeRow { eigenvalue, multiplicity: 1, frequency_hz: 0.3, damping_ratio: 0.13, cable_share, platform_share }
    }

    #[test]
    fn what_moves_has_at_least_half_of_the_largest_share() {
        let told = |shares: &[f64], platform| {
            let mode = mode(-0.1, shares.to_vec(), platform);
            (moves_mostly(&mode), moved(&mode))
        };
        let both = |short: &str, long: &str| (short.to_owned(), long.to_owned());
        assert_eq!(told(&[0.01, 0.02, 0.5, 0.3], 0.1), both("cable 3, 4", "cables 3, 4"));
        assert_eq!(told(&[0.01, 0.02, 0.2, 0.7], 0.1), both("cable 4", "cable 4"));
        assert_eq!(told(&[0.2, 0.2, 0.2, 0.2], 0.1), both("all", "all cables"));
        assert_eq!(told(&[0.1, 0.1, 0.1, 0.2], 0.5), both("platform", "the platform"));
    }

    #[test]
    fn what_grows_comes_first() {
        let modes = [mode(-1.0, vec![1.0], 0.0), mode(0.5, vec![1.0], 0.0), mode(-2.0, vec![1.0], 0.0)];
        let growth: Vec<f64> = in_order(&modes).iter().map(|mode| mode.eigenvalue[0]).collect();
        assert_eq!(growth.iter().map(ToString::to_string).collect::<Vec<_>>(), ["0.5", "-1", "-2"]);
        assert_eq!(damping(&modes[0]), "13.0 %");
    }
}
