//! The table of modes; a click on a row chooses the mode whose shape moves on the canvas.

use eframe::egui::{Label, RichText, Sense, Ui};
use egui_extras::{Column, TableBuilder};

use super::{STALE, explain, near, plot_height, with_modes};
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::pinned::Pinned;
use crate::app::theme;
use crate::compute::protocol::ModeRow;
use crate::stability::{TIE_OF_SHARES, first_largest};

/// Draws the table.
pub fn ui(ui: &mut Ui, Facts { answers, settings, pinned, mode: choice, .. }: Facts<'_>, commands: &mut Vec<Command>) {
    let Some(pose) = with_modes(ui, answers) else { return };
    ui.weak(if answers.pose_is_current() {
        "Modes at today's speed. ζ < 0 grows. The cable is the one with most of the kinetic energy."
    } else {
        STALE
    });
    explain(
        ui,
        "Every row is a way in which the robot vibrates at today's speed: how often it swings, how fast it grows \
         or dies away (1/s), its damping ratio ζ, and the cable that moves most. Click one to see it move.",
    );
    let (hertz, unit) = settings.hertz();
    let chosen = answers.shape().filter(|shape| !shape.is_critical).map(|shape| shape.eigenvalue);
    let before = pinned.and_then(Pinned::pose).map(|pose| pose.modes.as_slice());
    if before.is_some() {
        ui.colored_label(
            theme::pinned(ui.visuals()),
            "In brackets: the difference to the pinned design's nearest mode.",
        );
    }
    let height = plot_height(ui, 1);
    TableBuilder::new(ui)
        .id_salt("modes")
        .striped(true)
        .sense(Sense::click())
        .max_scroll_height(height - 24.0)
        .min_scrolled_height(120.0)
        .column(Column::auto().at_least(28.0))
        .columns(Column::auto().at_least(64.0), 3)
        .column(Column::remainder())
        .header(18.0, |mut header| {
            let titles = [
                ("#", "The modes by frequency. 3×2 is the third one, which is there twice, as along x and along y."),
                (unit, "The frequency of the vibration, Im λ; 0 where it does not oscillate."),
                ("1/s", "The growth rate Re λ: above zero (▲) the vibration grows, below it dies away."),
                ("ζ", "The damping ratio −Re λ/|λ|. Below zero the vibration grows."),
                ("Cable", "The cable with most of the vibration's kinetic energy, and its part of it."),
            ];
            for (title, meaning) in titles {
                header.col(|ui| {
                    ui.strong(title).explained(meaning);
                });
            }
        })
        .body(|body| {
            body.rows(18.0, pose.modes.len(), |mut row| {
                let i = row.index();
                let mode = &pose.modes[i];
                row.set_selected(chosen == Some(mode.eigenvalue));
                let name = if mode.multiplicity > 1 {
                    format!("{}×{}", i + 1, mode.multiplicity)
                } else {
                    (i + 1).to_string()
                };
                let [growth, _] = mode.eigenvalue;
                let shares = &mode.cable_share;
                let share = first_largest(shares.iter().copied(), TIE_OF_SHARES).map(|cable| (cable, shares[cable]));
                let cable = match share {
                    Some((_, share)) if share < mode.platform_share => {
                        format!("platform {:.0} %", 100.0 * mode.platform_share)
                    }
                    Some((cable, share)) => format!("{} ({:.0} %)", cable + 1, 100.0 * share),
                    None => String::new(),
                };
                let sign = if growth > 0.0 { "▲ " } else { "" };
                let from = before.and_then(|modes| nearest(modes, mode.eigenvalue));
                let difference = |now: f64, then: Option<f64>| {
                    then.map_or_else(String::new, |then| format!(" ({})", digits::with_sign(now - then, None)))
                };
                let frequency = mode.frequency_hz * hertz;
                let frequency_then = from.map(|mode| mode.frequency_hz * hertz);
                let growth_then = from.map(|mode| mode.eigenvalue[0]);
                let cells = [
                    name,
                    digits::certain(frequency, None) + &difference(frequency, frequency_then),
                    sign.to_owned() + &digits::certain(growth, None) + &difference(growth, growth_then),
                    digits::certain(mode.damping_ratio, None),
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
                    row.col(|ui| show(ui, cell, exact, i == 2 && growth > 0.0));
                }
                if row.response().clicked() {
                    commands.push(Command::ChooseMode(near(choice, mode.eigenvalue)));
                }
            });
        });
}

/// A cell of the table, with the exact number for those who rest on it.
fn show(ui: &mut Ui, cell: String, exact: String, grows: bool) {
    let colour = if grows { theme::warning(ui.visuals()) } else { ui.visuals().text_color() };
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
