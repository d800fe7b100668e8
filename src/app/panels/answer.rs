//! The answer first: the critical speed in large figures and what belongs to it.

use eframe::egui::{Label, RichText, Spinner, Ui};

use crate::app::answers::CriticalState;
use crate::app::certainty::Certainty;
use crate::app::facts::Facts;
use crate::app::meaning::Explain as _;
use crate::app::{digits, theme};
use crate::compute::protocol::SearchEnd;
use crate::scenario::Scenario;
use crate::stability::{Critical, Instability};

/// What the criterion means; also the tooltip of the figure.
const FROZEN_TIME: &str = "The critical speed of this method is where an eigenvalue of the robot, frozen at this moment \
    of its motion, gets a positive real part. A cable that is being reeled in looks unstable at any speed unless damping \
    hides it, so the figure tells where reeling-in overcomes damping, or where the flow of cable reaches its wave speed, \
    whichever comes first.";

/// Draws the answer.
pub fn ui(ui: &mut Ui, facts: Facts<'_>) {
    let visuals = ui.visuals().clone();
    ui.horizontal(|ui| {
        ui.label(RichText::new("Critical speed").strong());
        ui.weak("(frozen-time criterion: what is it?)").explained(FROZEN_TIME);
    });
    match facts.answers.critical() {
        CriticalState::Broken(reason) => {
            ui.colored_label(theme::warning(&visuals), RichText::new("▲ The analysis does not run").size(20.0));
            ui.label(reason);
        }
        CriticalState::Failed(failed) => {
            let infeasible = failed.report.feasible == Some(false);
            let title = if infeasible { "▲ No equilibrium" } else { "▲ Not computed" };
            ui.colored_label(theme::warning(&visuals), RichText::new(title).size(28.0));
            ui.label(failed.report.reason.as_deref().unwrap_or("This pose could not be analysed."));
            ui.weak("Drag the platform back, or change tensions or masses.");
        }
        CriticalState::Current(answer) => {
            figures(ui, facts, answer, true);
            difference(ui, facts, Some(answer));
            ui.weak("Up to date");
        }
        CriticalState::Recomputing { last, searched_up_to } => {
            if let Some(answer) = last {
                figures(ui, facts, answer, false);
            } else {
                ui.label(RichText::new("…").size(32.0));
            }
            ui.horizontal(|ui| {
                ui.add(Spinner::new().size(12.0));
                match searched_up_to {
                    Some(speed) => ui.weak(format!("Recomputing, stable up to {speed:.1} m/s so far")),
                    None => ui.weak("Recomputing"),
                }
            });
        }
    }
}

fn figures(ui: &mut Ui, facts: Facts<'_>, answer: &SearchEnd, current: bool) {
    let Facts { document, answers, settings, .. } = facts;
    let visuals = ui.visuals().clone();
    // An old figure is weak, and the line below says that it is being recomputed.
    let shade = |colour| if current { colour } else { visuals.weak_text_color() };
    if let Some(reason) = &answer.failure {
        ui.colored_label(shade(theme::warning(&visuals)), RichText::new("▲ Not known").size(32.0));
        ui.label(reason);
        return;
    }
    let Some(critical) = &answer.critical else {
        ui.colored_label(shade(theme::calm(&visuals)), RichText::new("None found").size(32.0));
        ui.label(format!("Stable up to {} m/s, the limit of the search.", answer.searched_up_to));
        return;
    };
    // What is certain belongs to the answer on show, not to an old one.
    let certainty = if current { facts.certainty } else { Certainty::Unknown };
    let elements = document.scenario.elements_per_cable;
    let figure = format!("{} m/s", digits::certain(critical.speed, certainty.speed()));
    let figure = RichText::new(figure).size(34.0).strong().color(shade(visuals.strong_text_color()));
    let exact = certainty.explained(critical, elements);
    // On the same line, so that nothing moves when it becomes known.
    ui.horizontal(|ui| {
        ui.add(Label::new(figure)).explained(format!("{exact}\n\n{FROZEN_TIME}"));
        if let Some(note) = certainty.note(critical) {
            ui.add(Label::new(RichText::new(note).weak()).truncate()).explained(&exact);
        }
    });
    if let Some(why) = at_rest(critical, &document.scenario) {
        ui.label(why);
    }
    let rate = answers.pose().and_then(|pose| pose.report.cables.get(critical.cable)).map(|c| c.length_rate);
    let moving = rate.map_or("", |rate| if rate < 0.0 { ", being reeled in" } else { ", being paid out" });
    let kind = match critical.kind {
        Instability::Flutter => {
            format!("Flutter at {}", settings.frequency_text(critical.frequency_hz(), certainty.frequency_hz()))
        }
        Instability::Divergence => "Divergence (no oscillation)".into(),
    };
    ui.colored_label(shade(visuals.text_color()), format!("{kind} · cable {}{moving}", critical.cable + 1));

    let speed = document.scenario.motion.speed;
    let margin = critical.speed - speed;
    let size = digits::three_at_most(margin.abs(), certainty.speed());
    let today = if certainty.speed().is_some_and(|off| off >= margin.abs()) && critical.speed > 0.0 {
        RichText::new(format!("▲ Today's {speed:.2} m/s: the mesh leaves open whether that is below or above it"))
            .color(shade(theme::warning(&visuals)))
    } else if margin > 0.0 {
        let percent = 100.0 * margin / critical.speed;
        RichText::new(format!("● Today's {speed:.2} m/s is {size} m/s ({percent:.0} %) below it"))
            .color(shade(theme::calm(&visuals)))
    } else {
        RichText::new(format!("▲ Today's {speed:.2} m/s is {size} m/s above it")).color(shade(theme::warning(&visuals)))
    };
    ui.label(today);
    let Some(pose) = answers.pose() else { return };
    if let Some(stable) = pose.report.stable {
        let (word, colour) =
            if stable { ("Stable", theme::calm(&visuals)) } else { ("Unstable", theme::warning(&visuals)) };
        let pose_shade = if answers.pose_is_current() { colour } else { visuals.weak_text_color() };
        let growth =
            pose.report.max_growth_rate.map(|growth| format!(": growth rate {} 1/s", digits::certain(growth, None)));
        ui.colored_label(pose_shade, format!("{word} at today's speed{}", growth.unwrap_or_default()));
    }
    if let Some(reason) = &pose.report.reason {
        ui.weak(reason);
    }
}

/// Why the critical speed is zero, where it is.
pub fn at_rest(critical: &Critical, scenario: &Scenario) -> Option<&'static str> {
    let undamped = scenario.damping.alpha == 0.0 && scenario.damping.beta == 0.0;
    (critical.speed == 0.0).then_some(if undamped {
        "Without damping every cable that is reeled in looks unstable at any speed, however low: the criterion freezes \
         time, and nothing stands against it. Give α or β a value."
    } else {
        "It is unstable at rest already."
    })
}

/// The pinned design's critical speed, and how far the present one is from it.
fn difference(ui: &mut Ui, facts: Facts<'_>, answer: Option<&SearchEnd>) {
    let Some(pinned) = facts.pinned else { return };
    let now = answer.and_then(|answer| answer.critical.as_ref());
    let not_known = |answer: Option<&SearchEnd>| answer.is_some_and(|answer| answer.failure.is_some());
    let text = |critical: &Critical, certainty: Certainty| digits::certain(critical.speed, certainty.speed());
    let text = match (pinned.critical(), now) {
        _ if !pinned.is_complete() => "Pinned, being computed".into(),
        (Some(before), None) if not_known(answer) => {
            format!("Pinned: {} m/s. Now not known", text(before, pinned.certainty()))
        }
        (None, _) if not_known(pinned.search()) => "Pinned: not known".into(),
        (Some(before), Some(now)) => {
            let (hertz, unit) = facts.settings.hertz();
            let frequency = (now.frequency_hz() - before.frequency_hz()) * hertz;
            let difference = now.speed - before.speed;
            // What the mesh does to both it does to their difference in proportion.
            let share = facts.share();
            let [speed, frequency] = [difference, frequency].map(|value| digits::change_like(value, share));
            let part = if before.speed > 0.0 {
                let percent = 100.0 * difference / before.speed;
                format!(" ({} %)", digits::change_like(percent, share))
            } else {
                String::new()
            };
            format!("Pinned: {} m/s. Now {speed} m/s{part}, {frequency} {unit}", text(before, pinned.certainty()))
        }
        (Some(before), None) => format!("Pinned: {} m/s. Now none", text(before, pinned.certainty())),
        (None, Some(_)) => "Pinned: no critical speed found".into(),
        (None, None) => "Pinned: none found either".into(),
    };
    ui.colored_label(theme::pinned(ui.visuals()), text);
}
