//! The line under a picture that says which robot it is of.

use crate::app::answers::CriticalState;
use crate::app::digits;
use crate::app::facts::Facts;
use crate::app::fields::Field;
use crate::app::number;
use crate::robot::{BoundingBox, Linearisation};
use crate::scenario::Parameter;
use crate::stability::Instability;

/// What stands before and after each number of the robot.
const NUMBERS: [(Parameter, &str); 8] = [
    (Parameter::YoungsModulus, ", "),
    (Parameter::Area, ", "),
    (Parameter::MassPerLength, ", "),
    (Parameter::PlatformMass, "; "),
    (Parameter::Position(0), ", "),
    (Parameter::Position(1), ", "),
    (Parameter::Direction, ", "),
    (Parameter::Speed, "; "),
];

/// The robot's name with its numbers, as they are shown in the controls, its critical speed, its model and the program.
pub fn caption(facts: Facts<'_>) -> String {
    let scenario = &facts.document.scenario;
    let mut text = name(facts);
    text.push_str(": ");
    // Sliders alone follow the frame.
    let frame = BoundingBox { low: [0.0; 2].into(), high: [0.0; 2].into() };
    for (parameter, end) in NUMBERS {
        let field = Field::of(parameter, frame).in_units_of(facts.settings);
        // With a proper minus.
        let value = number::brief(field.unit().shown(parameter.get(scenario))).replace('-', "−");
        text.push_str(&[field.symbol, " = ", &field.unit().with_name(&value), end].concat());
    }
    let model = match scenario.linearisation {
        Linearisation::Secant => "secant",
        Linearisation::Tangent => "tangent",
    };
    text.push_str(&critical(facts));
    let elements = scenario.elements_per_cable.to_string();
    text.push_str(&["; ", model, " stiffness, n = ", &elements, " elements per cable"].concat());
    text.push_str(concat!(". Tautline ", env!("CARGO_PKG_VERSION")));
    text
}

/// What the robot is called.
pub fn name(facts: Facts<'_>) -> String {
    let name = facts.document.scenario.name.as_deref().map(str::trim).filter(|name| !name.is_empty());
    name.unwrap_or("Unnamed robot").into()
}

/// What is known of the critical speed of the robot as it is now.
fn critical(facts: Facts<'_>) -> String {
    let CriticalState::Current(answer) = facts.answers.critical() else {
        let failed = facts.answers.pose_failed();
        return if failed { "no equilibrium at this pose".into() } else { "critical speed not computed yet".into() };
    };
    match &answer.critical {
        Some(critical) => {
            let speed = digits::certain(critical.speed, facts.certainty.speed());
            let kind = match critical.kind {
                Instability::Flutter => {
                    let hertz = facts.certainty.frequency_hz();
                    format!("flutter at {}", facts.settings.frequency_text(critical.frequency_hz(), hertz))
                }
                Instability::Divergence => "divergence".into(),
            };
            format!("critical speed {speed} m/s ({kind})")
        }
        None if answer.failure.is_some() => "critical speed not known".into(),
        None => format!("no critical speed up to {} m/s", number::brief(answer.searched_up_to)),
    }
}
