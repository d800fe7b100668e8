//! The numbers of a scenario: what each is called in files and faults, how it is read and set.

use crate::robot::TensionLaw;
use crate::scenario::Scenario;

/// A number of a scenario that can be changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// E of the cables that have none of their own.
    YoungsModulus,
    /// A of the cables that have none of their own.
    Area,
    /// μ of the cables that have none of their own.
    MassPerLength,
    /// The own E of a cable (0-based).
    OwnYoungsModulus(usize),
    /// The own A of a cable (0-based).
    OwnArea(usize),
    /// The own μ of a cable (0-based).
    OwnMassPerLength(usize),
    /// m.
    PlatformMass,
    /// g.
    Gravity,
    /// α.
    Alpha,
    /// β.
    Beta,
    /// n.
    Elements,
    /// v.
    Speed,
    /// The platform's position, x or y.
    Position(usize),
    /// A component of the motion's direction, along x or y.
    DirectionComponent(usize),
    /// The angle of the motion from the x axis, in radians: what people turn in the place of two components.
    Direction,
    /// The winch point of a cable (0-based), x or y.
    Anchor(usize, usize),
    /// The constant tension of a cable (0-based).
    Tension(usize),
    /// Coefficient 0, 1 or 2 of the horizontal part of a cable's tension law.
    Horizontal(usize, usize),
    /// Coefficient 0, 1 or 2 of the vertical part of a cable's tension law.
    Vertical(usize, usize),
    /// The peak speed of the path.
    PathSpeed,
    /// The acceleration of the path's profile.
    PathAcceleration,
    /// The jerk of the path's profile.
    PathJerk,
    /// How long a flight goes on after the path.
    PathHold,
    /// A point of the path (0-based), x or y.
    PathPoint(usize, usize),
}

impl Parameter {
    /// All numbers that a scenario file has, in the order of the file. Faults, sweeps and controls name them by their
    /// [`path`](Self::path).
    pub fn all(scenario: &Scenario) -> Vec<Self> {
        let of_cable = |cable| {
            let law = [Self::Tension(cable)].into_iter();
            let law = law.chain((0..3).map(move |i| Self::Horizontal(cable, i)));
            let law = law.chain((0..3).map(move |i| Self::Vertical(cable, i)));
            let own = [Self::OwnYoungsModulus(cable), Self::OwnArea(cable), Self::OwnMassPerLength(cable)];
            [Self::Anchor(cable, 0), Self::Anchor(cable, 1)].into_iter().chain(law).chain(own)
        };
        let before = [Self::Gravity, Self::YoungsModulus, Self::Area, Self::MassPerLength, Self::PlatformMass];
        let model = [Self::Elements, Self::Alpha, Self::Beta];
        let motion = [0, 1].map(Self::Position).into_iter().chain([0, 1].map(Self::DirectionComponent));
        let all = before.into_iter().chain((0..scenario.cables.len()).flat_map(of_cable));
        let points = scenario.path.as_ref().map_or(0, |path| path.points.len());
        let points = (0..points).flat_map(|point| [0, 1].map(|i| Self::PathPoint(point, i)));
        let profile = [Self::PathSpeed, Self::PathAcceleration, Self::PathJerk, Self::PathHold];
        let all = all.chain(model).chain(motion).chain([Self::Speed]).chain(points).chain(profile);
        all.filter(|parameter| parameter.is_in(scenario)).collect()
    }

    /// Whether it is a number of the path, on which no critical speed depends.
    pub fn is_of_path(self) -> bool {
        matches!(self, Self::PathSpeed | Self::PathAcceleration | Self::PathJerk | Self::PathHold | Self::PathPoint(..))
    }

    /// That number of one cable (0-based) alone, for those that cables can have of their own.
    pub fn own(self, cable: usize) -> Option<Self> {
        Some(match self {
            Self::YoungsModulus => Self::OwnYoungsModulus(cable),
            Self::Area => Self::OwnArea(cable),
            Self::MassPerLength => Self::OwnMassPerLength(cable),
            _ => return None,
        })
    }

    /// The number that all cables share which an own one takes the place of.
    pub fn common(self) -> Option<Self> {
        Some(match self {
            Self::OwnYoungsModulus(_) => Self::YoungsModulus,
            Self::OwnArea(_) => Self::Area,
            Self::OwnMassPerLength(_) => Self::MassPerLength,
            _ => return None,
        })
    }

    /// Gives a cable a number of its own, in SI units. All other numbers are there or not, and are [set](Self::set).
    pub fn give(self, scenario: &mut Scenario, value: f64) {
        match self.own_place(scenario) {
            Some(place) => *place = Some(value),
            None => self.set(scenario, value),
        }
    }

    /// Takes away what a cable has of its own, so that the common number counts again; nothing happens to other numbers.
    pub fn take_away(self, scenario: &mut Scenario) {
        if let Some(place) = self.own_place(scenario) {
            *place = None;
        }
    }

    /// Its value in SI units; 0 for a coefficient that the cable's law does not have, and for a number that the cable does
    /// not have of its own.
    pub fn get(self, scenario: &Scenario) -> f64 {
        // One way to reach each number, for reading and writing alike.
        let mut copy = scenario.clone();
        match self {
            Self::Elements => return scenario.elements_per_cable as f64,
            Self::Direction => {
                let [x, y] = scenario.motion.direction;
                return y.atan2(x);
            }
            _ => {}
        }
        self.place(&mut copy).map_or(0.0, |place| *place)
    }

    /// Makes it the same as in another scenario, to the last bit. What a cable does not have of its own there, it has not
    /// here.
    pub fn copy(self, from: &Scenario, to: &mut Scenario) {
        match self {
            Self::Elements => to.elements_per_cable = from.elements_per_cable,
            Self::Direction => to.motion.direction = from.motion.direction,
            Self::OwnYoungsModulus(_) | Self::OwnArea(_) | Self::OwnMassPerLength(_) => {
                let value = self.own_place(&mut from.clone()).and_then(|place| *place);
                if let Some(place) = self.own_place(to) {
                    *place = value;
                }
            }
            _ => self.set(to, self.get(from)),
        }
    }

    /// Its path in a scenario file; a direction is one number to people, and two in a file.
    pub fn path(self) -> String {
        match self {
            Self::YoungsModulus => "cable.youngs_modulus".into(),
            Self::Area => "cable.area".into(),
            Self::MassPerLength => "cable.mass_per_length".into(),
            Self::OwnYoungsModulus(cable) => format!("cables[{cable}].cable.youngs_modulus"),
            Self::OwnArea(cable) => format!("cables[{cable}].cable.area"),
            Self::OwnMassPerLength(cable) => format!("cables[{cable}].cable.mass_per_length"),
            Self::PlatformMass => "platform.mass".into(),
            Self::Gravity => "gravity".into(),
            Self::Alpha => "damping.alpha".into(),
            Self::Beta => "damping.beta".into(),
            Self::Elements => "elements_per_cable".into(),
            Self::Speed => "motion.speed".into(),
            Self::Position(i) => format!("motion.position[{i}]"),
            Self::DirectionComponent(i) => format!("motion.direction[{i}]"),
            Self::Direction => "motion.direction".into(),
            Self::Anchor(cable, i) => format!("cables[{cable}].anchor[{i}]"),
            Self::Tension(cable) => format!("cables[{cable}].tension.constant"),
            Self::Horizontal(cable, i) => format!("cables[{cable}].tension.horizontal[{i}]"),
            Self::Vertical(cable, i) => format!("cables[{cable}].tension.vertical[{i}]"),
            Self::PathSpeed => "path.speed".into(),
            Self::PathAcceleration => "path.acceleration".into(),
            Self::PathJerk => "path.jerk".into(),
            Self::PathHold => "path.hold".into(),
            Self::PathPoint(point, i) => format!("path.points[{point}][{i}]"),
        }
    }

    /// Whether the scenario has such a number.
    pub fn is_in(self, scenario: &Scenario) -> bool {
        matches!(self, Self::Elements | Self::Direction) || self.place(&mut scenario.clone()).is_some()
    }

    /// Sets it, in SI units, if it is in the scenario.
    pub fn set(self, scenario: &mut Scenario, value: f64) {
        if self == Self::Elements {
            // Saturates; the robot's validation says what is allowed.
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let elements = value.round() as usize;
            scenario.elements_per_cable = elements;
        } else if self == Self::Direction {
            // A right angle is meant exactly.
            let exact = |part: f64| if part.abs() < 1e-15 { 0.0 } else { part };
            scenario.motion.direction = [exact(value.cos()), exact(value.sin())];
        } else if let Some(place) = self.place(scenario) {
            *place = value;
        }
    }

    /// Where the number of a cable's own is or would be.
    fn own_place(self, scenario: &mut Scenario) -> Option<&mut Option<f64>> {
        let (Self::OwnYoungsModulus(cable) | Self::OwnArea(cable) | Self::OwnMassPerLength(cable)) = self else {
            return None;
        };
        let own = &mut scenario.cables.get_mut(cable)?.cable;
        Some(match self {
            Self::OwnYoungsModulus(_) => &mut own.youngs_modulus,
            Self::OwnArea(_) => &mut own.area,
            _ => &mut own.mass_per_length,
        })
    }

    fn place(self, scenario: &mut Scenario) -> Option<&mut f64> {
        match self {
            Self::OwnYoungsModulus(_) | Self::OwnArea(_) | Self::OwnMassPerLength(_) => {
                self.own_place(scenario)?.as_mut()
            }
            Self::YoungsModulus => Some(&mut scenario.cable.youngs_modulus),
            Self::Area => Some(&mut scenario.cable.area),
            Self::MassPerLength => Some(&mut scenario.cable.mass_per_length),
            Self::PlatformMass => Some(&mut scenario.platform.mass),
            Self::Gravity => Some(&mut scenario.gravity),
            Self::Alpha => Some(&mut scenario.damping.alpha),
            Self::Beta => Some(&mut scenario.damping.beta),
            Self::Speed => Some(&mut scenario.motion.speed),
            Self::Position(i) => scenario.motion.position.get_mut(i),
            Self::DirectionComponent(i) => scenario.motion.direction.get_mut(i),
            Self::Anchor(cable, i) => scenario.cables.get_mut(cable)?.anchor.get_mut(i),
            Self::Elements | Self::Direction => None,
            Self::PathSpeed => Some(&mut scenario.path.as_mut()?.speed),
            Self::PathAcceleration => Some(&mut scenario.path.as_mut()?.acceleration),
            Self::PathJerk => Some(&mut scenario.path.as_mut()?.jerk),
            Self::PathHold => Some(&mut scenario.path.as_mut()?.hold),
            Self::PathPoint(point, i) => scenario.path.as_mut()?.points.get_mut(point)?.get_mut(i),
            Self::Tension(cable) | Self::Horizontal(cable, _) | Self::Vertical(cable, _) => {
                match (self, &mut scenario.cables.get_mut(cable)?.tension) {
                    (Self::Tension(_), TensionLaw::Constant(tension)) => Some(tension),
                    (Self::Horizontal(_, i), TensionLaw::Hypot { horizontal, .. }) => horizontal.get_mut(i),
                    (Self::Vertical(_, i), TensionLaw::Hypot { vertical, .. }) => vertical.get_mut(i),
                    _ => None,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;
    use crate::scenario::{Path, presets};

    /// The numbers of a file with their paths.
    fn numbers(value: &Value, path: &str, found: &mut Vec<(String, f64)>) {
        match value {
            Value::Number(number) => found.push((path.into(), number.as_f64().expect("a number"))),
            Value::Array(items) => {
                items.iter().enumerate().for_each(|(i, item)| numbers(item, &format!("{path}[{i}]"), found));
            }
            Value::Object(fields) => {
                let dot = if path.is_empty() { "" } else { "." };
                fields.iter().for_each(|(name, field)| numbers(field, &format!("{path}{dot}{name}"), found));
            }
            Value::Null | Value::Bool(_) | Value::String(_) => {}
        }
    }

    #[test]
    fn every_number_of_a_file_is_a_parameter_with_its_path_and_its_value() {
        for preset in presets::PRESETS {
            let mut scenario = preset.scenario();
            scenario.cables[0].cable.youngs_modulus = Some(2e11);
            scenario.cables[1].cable.area = Some(2e-5);
            scenario.cables[2].cable.mass_per_length = Some(0.7);
            scenario.path = Some(Path::new(vec![[1.0, 0.5], [2.0, 0.5]], 3.0));
            let mut in_file = Vec::new();
            numbers(&serde_json::to_value(&scenario).expect("JSON"), "", &mut in_file);
            let value = |parameter: &Parameter| (parameter.path(), parameter.get(&scenario));
            let mut listed: Vec<(String, f64)> = Parameter::all(&scenario).iter().map(value).collect();
            for list in [&mut in_file, &mut listed] {
                list.sort_by(|a, b| a.0.cmp(&b.0));
            }
            assert_eq!(listed, in_file, "{}", preset.name);
        }
    }

    #[test]
    fn what_is_set_is_what_is_read() {
        let mut scenario = presets::PRESETS[0].scenario();
        for parameter in [Parameter::OwnYoungsModulus(1), Parameter::OwnArea(1), Parameter::OwnMassPerLength(2)] {
            parameter.give(&mut scenario, 0.25);
        }
        for parameter in Parameter::all(&scenario).into_iter().chain([Parameter::Direction]) {
            let mut changed = scenario.clone();
            let value = if parameter == Parameter::Elements { 7.0 } else { 0.625 };
            parameter.set(&mut changed, value);
            assert!((parameter.get(&changed) - value).abs() < 1e-15, "{parameter:?}");
            parameter.copy(&scenario, &mut changed);
            assert_eq!(changed, scenario, "{parameter:?}");
        }
    }
}
