//! The main results as text: what a screen reader is told of a canvas.

use std::fmt::Write as _;

use crate::app::answers::CriticalState;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::panels::answer;
use crate::stability::Instability;

/// The critical speed in a sentence, once it is known; `None` while it is being computed.
pub fn summary(facts: Facts<'_>) -> Option<String> {
    Some(match facts.answers.critical() {
        CriticalState::Recomputing { .. } => return None,
        CriticalState::Broken(reason) => format!("The analysis does not run: {reason}"),
        CriticalState::Failed(failed) => failed.report.reason.clone().unwrap_or_default(),
        CriticalState::Current(answer) => match &answer.critical {
            None if answer.failure.is_some() => {
                format!("Critical speed not known. {}", answer.failure.as_deref().unwrap_or_default())
            }
            None => format!("No critical speed up to {} metres per second.", answer.searched_up_to),
            Some(critical) => {
                let kind = match critical.kind {
                    Instability::Flutter => {
                        let frequency = digits::certain(critical.frequency_hz(), facts.certainty.frequency_hz());
                        format!("flutter at {frequency} hertz")
                    }
                    Instability::Divergence => "divergence".into(),
                };
                let speed = digits::certain(critical.speed, facts.certainty.speed());
                let why = answer::at_rest(critical, &facts.document.scenario).map(|why| format!(" {why}"));
                let why = why.unwrap_or_default();
                format!("Critical speed {speed} metres per second, {kind}, cable {}.{why}", critical.cable + 1)
            }
        },
    })
}

/// The robot, its pose and what follows from it, in lines.
pub fn details(facts: Facts<'_>) -> Vec<String> {
    let scenario = &facts.document.scenario;
    let [x, y] = scenario.motion.position;
    let [dx, dy] = scenario.motion.direction;
    let name = scenario.name.as_deref().unwrap_or("Unnamed robot");
    let mut lines = vec![
        format!("{name} with {} cables.", scenario.cables.len()),
        format!(
            "Platform at x {x:.3} metres, y {y:.3} metres, moving at {:.3} metres per second in the direction {:.1} degrees.",
            scenario.motion.speed,
            dy.atan2(dx).to_degrees()
        ),
    ];
    let Some(pose) = facts.answers.pose().filter(|_| facts.answers.pose_is_current()) else { return lines };
    if let Some(stable) = pose.report.stable {
        let mut line = format!("{} at this speed", if stable { "Stable" } else { "Unstable" });
        if let Some(growth) = pose.report.max_growth_rate {
            // Writing to a string does not fail.
            let _ = write!(line, ", largest growth rate {} per second", digits::certain(growth, None));
        }
        lines.push(line + ".");
    }
    for (i, cable) in pose.report.cables.iter().enumerate() {
        lines.push(format!(
            "Cable {}: {:.1} newtons at the platform, {:.1} newtons at the winch, {:.3} metres long, {}.",
            i + 1,
            cable.tension_at_platform,
            cable.tension_at_winch,
            cable.unstretched_length,
            if cable.length_rate < 0.0 { "being reeled in" } else { "being paid out" }
        ));
    }
    if let CriticalState::Current(answer) = facts.answers.critical()
        && let Some(critical) = &answer.critical
        && let Some(note) = facts.certainty.note(critical)
    {
        lines.push(format!("Of the critical speed: {note}."));
    }
    if let CriticalState::Current(_) = facts.answers.critical() {
        for (letter, design) in facts.designs.shown() {
            if let Some(difference) = design.difference(facts.answers) {
                let difference = digits::change_like(difference, facts.share());
                lines.push(format!("Against design {}: {difference} metres per second.", letter.name()));
            }
        }
    }
    lines
}
