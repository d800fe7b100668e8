//! What the numbers at hand mean, in plain sentences, and where to read on.

use std::f64::consts::LN_2;

use eframe::egui::{RichText, Ui};

use super::links;
use super::word::Word;
use crate::app::answers::CriticalState;
use crate::app::command::Command;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::panels::answer;
use crate::app::series;
use crate::app::state::Session;
use crate::app::theme;
use crate::app::tour::Tour;
use crate::compute::protocol::{FailedPose, SearchEnd};
use crate::stability::{Critical, Instability};

/// Draws the paragraph, all words that have a card, and what else there is to read.
pub fn explain(session: &mut Session, ui: &mut Ui, facts: Facts<'_>, commands: &mut Vec<Command>) {
    ui.label(paragraph(facts));
    ui.add_space(8.0);
    title(ui, "Words");
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 16.0;
        for word in Word::ALL {
            if links::in_list(ui, word, word.title()).clicked() {
                commands.push(Command::ExplainWord(word));
            }
        }
    });
    ui.add_space(8.0);
    title(ui, "Read on");
    ui.horizontal_wrapped(|ui| {
        if ui.button("Tour").clicked() {
            session.tour = Some(Tour::default());
        }
        let windows = &mut session.windows;
        for (name, open) in [
            ("Theory", &mut windows.theory),
            ("Validation", &mut windows.validation),
            ("Keyboard shortcuts", &mut windows.shortcuts),
        ] {
            if ui.button(name).clicked() {
                *open = true;
            }
        }
    });
}

fn title(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).color(theme::tokens(ui.visuals()).weak));
}

/// What the numbers at hand mean.
fn paragraph(facts: Facts<'_>) -> String {
    match facts.answers.critical() {
        CriticalState::Broken(reason) => format!("The analysis does not run: {reason}"),
        CriticalState::Failed(failed) => without_pose(failed),
        CriticalState::Recomputing { searched_up_to: Some(speed), .. } => {
            format!(
                "The critical speed is being computed: moved this way, the robot is stable up to {speed:.1} m/s so far."
            )
        }
        CriticalState::Recomputing { searched_up_to: None, .. } => "The critical speed is being computed.".into(),
        CriticalState::Current(answer) => of_search(facts, answer),
    }
}

fn without_pose(failed: &FailedPose) -> String {
    let reason = failed.report.reason.as_deref().unwrap_or("This pose could not be analysed.");
    if failed.report.feasible == Some(false) {
        format!(
            "{reason} Without an equilibrium the robot cannot rest, so there is no vibration about it and no critical \
             speed. Move the platform back, or change tensions or masses."
        )
    } else {
        format!("This pose has no answer. {reason}")
    }
}

fn of_search(facts: Facts<'_>, answer: &SearchEnd) -> String {
    let speed = facts.document.scenario.motion.speed;
    let now = at_present(facts).map_or_else(String::new, |what| format!(": {what}"));
    let mut sentences = match (&answer.critical, &answer.failure) {
        (_, Some(reason)) => vec![format!("The critical speed is not known here. {reason}")],
        (None, None) => vec![
            format!(
                "Moved this way, no vibration of this robot grows by itself up to {} m/s, the limit of the search.",
                answer.searched_up_to
            ),
            format!("You move at {speed:.2} m/s{now}."),
        ],
        (Some(critical), None) => {
            let side = side(facts, critical).map_or_else(String::new, |side| format!(", {side}"));
            vec![crossing(facts, critical), format!("You move at {speed:.2} m/s{side}{now}.")]
        }
    };
    sentences.extend(waves(facts));
    sentences.extend(series::of_the_move(facts));
    if answer.critical.is_some() {
        sentences.push("The critical speed is found with time frozen; it is not a safety margin.".into());
    }
    sentences.join(" ")
}

/// What begins at the critical speed.
fn crossing(facts: Facts<'_>, critical: &Critical) -> String {
    if let Some(why) = answer::at_rest(critical, &facts.document.scenario) {
        return format!("The critical speed is 0 m/s. {why}");
    }
    let speed = digits::certain(critical.speed, facts.certainty.speed());
    let cable = critical.cable + 1;
    match critical.kind {
        Instability::Flutter => {
            let frequency = facts.settings.frequency_text(critical.frequency_hz(), facts.certainty.frequency_hz());
            format!(
                "Moved this way, this robot vibrates by itself above {speed} m/s: a vibration of {frequency}, mostly of cable \
                 {cable}, then grows from swing to swing (flutter)."
            )
        }
        Instability::Divergence => format!(
            "Moved this way, this robot loses its shape above {speed} m/s: cable {cable} then bows out further and further \
             without swinging back (divergence)."
        ),
    }
}

/// On which side of the critical speed the present one is.
fn side(facts: Facts<'_>, critical: &Critical) -> Option<String> {
    if critical.speed <= 0.0 {
        return None;
    }
    let margin = critical.speed - facts.document.scenario.motion.speed;
    if facts.certainty.speed().is_some_and(|off| off >= margin.abs()) {
        return Some("and the mesh leaves open whether that is below or above it".into());
    }
    let percent = 100.0 * margin.abs() / critical.speed;
    Some(format!("{percent:.0} % {}", if margin > 0.0 { "below" } else { "above" }))
}

/// What becomes of a small disturbance at the present speed, where that is known.
fn at_present(facts: Facts<'_>) -> Option<String> {
    let pose = facts.answers.pose().filter(|_| facts.answers.pose_is_current())?;
    let growth = pose.report.max_growth_rate?;
    if growth == 0.0 {
        return Some("a small disturbance neither grows nor dies out".into());
    }
    let time = digits::certain(LN_2 / growth.abs(), None);
    Some(format!("a small disturbance {} every {time} s", if growth > 0.0 { "doubles" } else { "halves" }))
}

/// The wave limit, where there is one.
fn waves(facts: Facts<'_>) -> Option<String> {
    let pose = facts.answers.pose().filter(|_| facts.answers.pose_is_current())?;
    let limit = pose.report.wave_limit.as_ref()?;
    let reels = if limit.reeled_in { "reeled in" } else { "paid out" };
    let speed = digits::certain(limit.speed, None);
    Some(format!("At {speed} m/s cable {} is {reels} as fast as waves run along it (wave limit).", limit.cable))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::answers::Answers;
    use crate::app::designs::Designs;
    use crate::app::facts::Present;
    use crate::app::flying::Flying;
    use crate::app::settings::Settings;
    use crate::app::state::Document;
    use crate::app::studies::{Joined, Studies};
    use crate::compute::protocol::{AnalysedPose, Extent, Reply, Update};
    use crate::robot::{Motion, Robot};
    use crate::scenario::{Report, Scenario, presets};
    use nalgebra::Complex;
    use std::f64::consts::TAU;

    const FOUND_UP_TO: f64 = 40.0;

    fn told(scenario: &Scenario, answers: Answers) -> String {
        let document = Document::opened(scenario.clone());
        let (studies, joined) = (Studies::default(), Joined::default());
        let present =
            Present { document, answers, studies, joined, designs: Designs::default(), flying: Flying::default() };
        paragraph(present.facts(Settings::default(), Session::default().mode))
    }

    fn analysed(scenario: &Scenario) -> Answers {
        let (robot, motion): (Robot, Motion) = scenario.to_robot().expect("physical");
        let report = Report::analyze(&robot, &motion, FOUND_UP_TO);
        let pose = AnalysedPose { report, axial_forces: Vec::new(), modes: Vec::new(), extent: Extent::All };
        let mut answers = Answers::default();
        answers.expect(1);
        answers.take(Reply { revision: 1, update: Update::Pose(Box::new(pose)) });
        answers
    }

    fn searched(mut answers: Answers, critical: Option<Critical>, failure: Option<&str>) -> Answers {
        let failure = failure.map(Into::into);
        let end = SearchEnd { critical, failure, searched_up_to: FOUND_UP_TO, elapsed_ms: 1.0 };
        answers.take(Reply { revision: 1, update: Update::Critical(end) });
        answers
    }

    /// The figures of docs/theory.md, section 10.
    fn flutter() -> Critical {
        Critical { speed: 11.299, eigenvalue: Complex::new(0.0, 0.27155 * TAU), kind: Instability::Flutter, cable: 3 }
    }

    #[test]
    fn the_paragraph_says_what_the_numbers_mean() {
        let mut scenario = presets::PRESETS[0].scenario();
        let text = told(&scenario, searched(analysed(&scenario), Some(flutter()), None));
        for part in [
            "above 11.3 m/s: a vibration of 0.272 Hz, mostly of cable 4, then grows",
            "You move at 5.00 m/s, 56 % below: a small disturbance halves every 3.8",
            "At 11.9 m/s cable 4 is reeled in as fast as waves run along it",
            "not a safety margin",
        ] {
            assert!(text.contains(part), "{part:?} is not in {text:?}");
        }
        scenario.motion.speed = 12.0;
        let text = told(&scenario, searched(analysed(&scenario), Some(flutter()), None));
        assert!(text.contains("You move at 12.00 m/s, 6 % above: a small disturbance doubles every 8.9"), "{text}");
        let divergence = Critical { kind: Instability::Divergence, eigenvalue: Complex::default(), ..flutter() };
        let text = told(&scenario, searched(analysed(&scenario), Some(divergence), None));
        assert!(text.contains("cable 4 then bows out") && !text.contains("Hz"), "{text}");
        let text = told(&scenario, searched(analysed(&scenario), None, None));
        assert!(text.contains("no vibration of this robot grows by itself up to 40 m/s"), "{text}");
        let text = told(&scenario, searched(analysed(&scenario), None, Some("The search has failed.")));
        assert!(text.starts_with("The critical speed is not known here. The search has failed."), "{text}");
    }

    #[test]
    fn what_is_not_known_is_not_told() {
        let scenario = presets::PRESETS[0].scenario();
        let text = told(&scenario, analysed(&scenario));
        assert_eq!(text, "The critical speed is being computed.");
        let mut answers = analysed(&scenario);
        answers.take(Reply { revision: 1, update: Update::Searching(7.13) });
        assert!(told(&scenario, answers).ends_with("stable up to 7.1 m/s so far."));
        // Of an earlier state nothing is told either.
        let mut answers = searched(analysed(&scenario), Some(flutter()), None);
        answers.expect(2);
        assert_eq!(told(&scenario, answers), "The critical speed is being computed.");
        let mut outside = scenario;
        outside.motion.position = [8.0, 0.0];
        let (robot, motion) = outside.to_robot().expect("physical");
        let report = Report::analyze(&robot, &motion, FOUND_UP_TO);
        let failed = FailedPose { report, cable: Some(0), shapes: Vec::new(), push: None };
        let mut answers = Answers::default();
        answers.expect(1);
        answers.take(Reply { revision: 1, update: Update::Failed(Box::new(failed)) });
        let text = told(&outside, answers);
        assert!(text.starts_with("No static equilibrium here: cable 1 would have to push"), "{text}");
        assert!(text.contains("no critical speed"), "{text}");
    }
}
