//! The numbers of a scenario that can be turned: name, unit, range, meaning, where they live.

use crate::app::number::{self, Unit};
use crate::app::state::{Settings, StressUnit};
use crate::robot::{Allowed, ELEMENTS, Fault, TensionLaw};
use crate::scenario::Scenario;

/// A number of the scenario with its control.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// What it is called.
    pub name: &'static str,
    /// Its letter in the equations.
    pub symbol: &'static str,
    /// The unit people use.
    pub unit: &'static str,
    /// The slider's range in displayed units; typed values may go beyond.
    pub range: [f64; 2],
    /// Whether equal steps of the slider are equal ratios.
    pub logarithmic: bool,
    /// Whether only whole numbers make sense.
    pub integer: bool,
    /// What it means.
    pub meaning: &'static str,
    /// Which number it is.
    pub number: Number,
}

impl Field {
    /// The same in the units chosen.
    pub fn in_units_of(mut self, settings: Settings) -> Self {
        if self.number == Number::YoungsModulus && settings.stress == StressUnit::Gigapascal {
            self.range = self.range.map(|end| end / 1e3);
            self.unit = "GPa";
        }
        self
    }

    /// The unit that it is shown in.
    pub fn unit(&self) -> Unit {
        Unit::of(self.unit)
    }

    /// What messages call it: its letter, with the cable that it belongs to.
    fn title(&self) -> String {
        match self.number {
            Number::Anchor(cable, _) => format!("{} of winch {}", self.symbol, cable + 1),
            Number::Tension(cable) | Number::Horizontal(cable, _) | Number::Vertical(cable, _) => {
                format!("{} of cable {}", self.symbol, cable + 1)
            }
            _ => self.symbol.into(),
        }
    }
}

/// A number of a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// E.
    YoungsModulus,
    /// A.
    Area,
    /// μ.
    MassPerLength,
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
    /// x.
    PositionX,
    /// y.
    PositionY,
    /// The angle of the motion from the x axis, in radians.
    Direction,
    /// The winch point of a cable (0-based), x or y.
    Anchor(usize, usize),
    /// The constant tension of a cable (0-based).
    Tension(usize),
    /// Coefficient 0, 1 or 2 of the horizontal part of a cable's tension law.
    Horizontal(usize, usize),
    /// Coefficient 0, 1 or 2 of the vertical part of a cable's tension law.
    Vertical(usize, usize),
}

impl Number {
    /// Its value in SI units; 0 for a coefficient that the cable's law does not have.
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

    /// Makes it the same as in another scenario, to the last bit.
    pub fn copy(self, from: &Scenario, to: &mut Scenario) {
        match self {
            Self::Elements => to.elements_per_cable = from.elements_per_cable,
            Self::Direction => to.motion.direction = from.motion.direction,
            _ => self.set(to, self.get(from)),
        }
    }

    /// Its path in a scenario file.
    fn path(self) -> String {
        match self {
            Self::YoungsModulus => "cable.youngs_modulus".into(),
            Self::Area => "cable.area".into(),
            Self::MassPerLength => "cable.mass_per_length".into(),
            Self::PlatformMass => "platform.mass".into(),
            Self::Gravity => "gravity".into(),
            Self::Alpha => "damping.alpha".into(),
            Self::Beta => "damping.beta".into(),
            Self::Elements => "elements_per_cable".into(),
            Self::Speed => "motion.speed".into(),
            Self::PositionX => "motion.position[0]".into(),
            Self::PositionY => "motion.position[1]".into(),
            Self::Direction => "motion.direction".into(),
            Self::Anchor(cable, i) => format!("cables[{cable}].anchor[{i}]"),
            Self::Tension(cable) => format!("cables[{cable}].tension.constant"),
            Self::Horizontal(cable, i) => format!("cables[{cable}].tension.horizontal[{i}]"),
            Self::Vertical(cable, i) => format!("cables[{cable}].tension.vertical[{i}]"),
        }
    }

    /// Whether the scenario has such a number.
    pub fn is_in(self, scenario: &Scenario) -> bool {
        matches!(self, Self::Elements | Self::Direction) || self.place(&mut scenario.clone()).is_some()
    }

    /// Sets it, in SI units.
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

    fn place(self, scenario: &mut Scenario) -> Option<&mut f64> {
        match self {
            Self::YoungsModulus => Some(&mut scenario.cable.youngs_modulus),
            Self::Area => Some(&mut scenario.cable.area),
            Self::MassPerLength => Some(&mut scenario.cable.mass_per_length),
            Self::PlatformMass => Some(&mut scenario.platform.mass),
            Self::Gravity => Some(&mut scenario.gravity),
            Self::Alpha => Some(&mut scenario.damping.alpha),
            Self::Beta => Some(&mut scenario.damping.beta),
            Self::Speed => Some(&mut scenario.motion.speed),
            Self::PositionX => Some(&mut scenario.motion.position[0]),
            Self::PositionY => Some(&mut scenario.motion.position[1]),
            Self::Anchor(cable, i) => scenario.cables.get_mut(cable)?.anchor.get_mut(i),
            Self::Elements | Self::Direction => None,
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

const fn field(name: &'static str, symbol: &'static str, unit: &'static str, number: Number) -> Field {
    Field { name, symbol, unit, range: [0.0, 1.0], logarithmic: false, integer: false, meaning: "", number }
}

/// The speed of the platform.
pub const SPEED: Field = Field {
    range: [0.0, 40.0],
    meaning: "The platform's speed v along its direction of motion. The eigenvalues on show are those at this speed; the \
              critical speed does not depend on it.",
    ..field("Speed", "v", "m/s", Number::Speed)
};

/// The angle of the motion.
pub const DIRECTION: Field = Field {
    range: [-180.0, 180.0],
    meaning: "The direction of the motion: 0° to the right, 90° upward. Drag the arrow's tip on the canvas for the same.",
    ..field("Direction", "θ", "°", Number::Direction)
};

/// Where the platform is, within `frame`: [left, bottom, right, top] in m.
pub fn position([left, bottom, right, top]: [f64; 4]) -> [Field; 2] {
    let meaning = "The platform's position: x to the right, y up. Drag the platform on the canvas for the same.";
    let field = |name, symbol, number, range| Field { range, meaning, ..field(name, symbol, "m", number) };
    [field("Position", "x", Number::PositionX, [left, right]), field("Position", "y", Number::PositionY, [bottom, top])]
}

/// Cables and platform.
pub const BODY: [Field; 5] = [
    Field {
        range: [1.0, 300_000.0],
        logarithmic: true,
        meaning: "Young's modulus of the cables. With A it makes the axial stiffness EA of N(λ).",
        ..field("Young's modulus", "E", "MPa", Number::YoungsModulus)
    },
    Field {
        range: [0.001, 10.0],
        logarithmic: true,
        meaning: "Cross-section of the cables.",
        ..field("Cross-section", "A", "cm²", Number::Area)
    },
    Field {
        range: [0.001, 10.0],
        logarithmic: true,
        meaning: "Mass of the cables per unstretched length. The wave speed of a cable is √(T/μ).",
        ..field("Cable mass", "μ", "kg/m", Number::MassPerLength)
    },
    Field {
        range: [0.01, 1000.0],
        logarithmic: true,
        meaning: "Mass of the platform, a point mass.",
        ..field("Platform mass", "m", "kg", Number::PlatformMass)
    },
    Field {
        range: [0.0, 20.0],
        meaning: "Gravitational acceleration. At 0 the cables are straight.",
        ..field("Gravity", "g", "m/s²", Number::Gravity)
    },
];

/// Damping and mesh.
pub const MODEL: [Field; 3] = [
    Field {
        range: [0.0, 5.0],
        meaning: "Damping in proportion to mass: the α of αM + βK. It works against reeling-in, which feeds \
                  every frequency alike.",
        ..field("Mass damping", "α", "1/s", Number::Alpha)
    },
    Field {
        range: [0.0, 0.1],
        logarithmic: true,
        meaning: "Damping in proportion to elastic stiffness: the β of αM + βK. It calms high frequencies most.",
        ..field("Stiffness damping", "β", "s", Number::Beta)
    },
    Field {
        range: [2.0, 40.0],
        integer: true,
        meaning: "Finite elements per cable. The error falls as 1/n² where a vibration grows, as 1/n for a divergence; the \
                  work grows faster than n. Mesh, among the plots, tells how large it is.",
        ..field("Elements per cable", "n", "", Number::Elements)
    },
];

/// Where a cable's winch is, about `frame`: [left, bottom, right, top] in m.
pub fn anchor(cable: usize, [left, bottom, right, top]: [f64; 4]) -> [Field; 2] {
    let meaning = "Where the winch is: x to the right, y up. Once unlocked it can be dragged on the canvas.";
    let field = |name, i, low: f64, high: f64| {
        let more = 0.2 * (high - low);
        Field { range: [low - more, high + more], meaning, ..field(name, name, "m", Number::Anchor(cable, i)) }
    };
    [field("x", 0, left, right), field("y", 1, bottom, top)]
}

/// The constant tension of a cable.
pub fn tension(cable: usize) -> Field {
    Field {
        range: [1.0, 10_000.0],
        logarithmic: true,
        meaning: "The tension that the winch holds at the platform's end of this cable.",
        ..field("Tension", "T", "N", Number::Tension(cable))
    }
}

/// The six coefficients of a cable's tension law.
pub fn law(cable: usize) -> [Field; 6] {
    let meaning = "A coefficient of the tension at the platform, T = hypot(h0 + hx x + hy y, v0 + vx x + vy y).";
    let constant = |name, number| Field { range: [-500.0, 500.0], meaning, ..field(name, name, "N", number) };
    let slope = |name, number| Field { range: [-50.0, 50.0], meaning, ..field(name, name, "N/m", number) };
    [
        constant("h0", Number::Horizontal(cable, 0)),
        slope("hx", Number::Horizontal(cable, 1)),
        slope("hy", Number::Horizontal(cable, 2)),
        constant("v0", Number::Vertical(cable, 0)),
        slope("vx", Number::Vertical(cable, 1)),
        slope("vy", Number::Vertical(cable, 2)),
    ]
}

/// The fields of all numbers of a scenario.
fn all(scenario: &Scenario) -> impl Iterator<Item = Field> {
    let cables = (0..scenario.cables.len()).flat_map(|cable| {
        let law = law(cable).into_iter().chain([tension(cable)]);
        law.chain(anchor(cable, [0.0; 4]))
    });
    let fixed = [SPEED, DIRECTION].into_iter().chain(position([0.0; 4])).chain(BODY).chain(MODEL);
    fixed.chain(cables).filter(|field| field.number.is_in(scenario))
}

/// Puts another value, as it is stored, in the place of a number.
///
/// # Errors
/// Why it is not allowed, in the words of the field that it is about: mostly this one.
pub fn edited(scenario: &Scenario, field: &Field, value: f64, settings: Settings) -> Result<Scenario, String> {
    let mut edited = scenario.clone();
    if field.integer && value.fract() != 0.0 {
        let fault = Fault::new(field.number.path(), value, Allowed::Whole(ELEMENTS));
        return Err(in_words(&fault, scenario, settings));
    }
    field.number.set(&mut edited, value);
    check(&edited, settings).map(|()| edited)
}

/// Whether a scenario is physical.
///
/// # Errors
/// What is wrong first, in words.
pub fn check(scenario: &Scenario, settings: Settings) -> Result<(), String> {
    let Err(faults) = scenario.to_robot() else { return Ok(()) };
    Err(faults.list().first().map(|fault| in_words(fault, scenario, settings)).unwrap_or_default())
}

/// What is wrong, in the words and the unit of the field that it belongs to.
fn in_words(fault: &Fault, scenario: &Scenario, settings: Settings) -> String {
    let is_of = |path: &str, field: &Field| {
        // A direction is one number to people, and two in a file.
        path.strip_prefix(&field.number.path()).is_some_and(|rest| rest.is_empty() || rest.starts_with('['))
    };
    let of = |path: &str| all(scenario).find(|field| is_of(path, field)).map(|field| field.in_units_of(settings));
    if let Allowed::OtherThanAnchor(other) = fault.allowed {
        let cables = 0..scenario.cables.len();
        let cable = cables.into_iter().find(|cable| fault.path == format!("cables[{cable}].anchor"));
        return match cable {
            Some(cable) => format!("Winch {} must not be where winch {} is", cable + 1, other + 1),
            None => fault.to_string(),
        };
    }
    let Some(field) = of(&fault.path) else { return fault.to_string() };
    let (title, unit) = (field.title(), field.unit());
    let zero = unit.with_name("0");
    let found = fault.value.parse().map(|value| unit.with_name(&number::brief(unit.shown(value))));
    let found = found.map(|found| format!(", not {found}")).unwrap_or_default();
    match &fault.allowed {
        Allowed::Positive => format!("{title} must be more than {zero}{found}"),
        Allowed::NotNegative { instead: "" } => format!("{title} must be {zero} or more{found}"),
        Allowed::NotNegative { instead } => format!("{title} must be {zero} or more{found}: {instead}"),
        Allowed::Finite => format!("{title} must be a finite number"),
        Allowed::Whole(range) => {
            format!("{title} must be a whole number from {} to {}{found}", range.start(), range.end())
        }
        Allowed::ProductsWith(paths) => {
            let others: Vec<&str> = paths.iter().filter_map(|path| of(path)).map(|field| field.symbol).collect();
            format!("The product of {title} and {} is too large or too small a number", others.join(" or "))
        }
        Allowed::OtherThanAnchor(_) => fault.to_string(),
        Allowed::Words(words) => format!("{title} must be {words}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::presets;

    #[test]
    fn every_field_has_its_unit_and_every_fault_finds_its_field() {
        for scenario in presets::PRESETS.iter().map(presets::Preset::scenario) {
            for field in all(&scenario) {
                let kind = field.unit().dimension.kind();
                assert_eq!(kind == "a plain number", field.unit.is_empty(), "{}: {kind}", field.name);
                // The same number, and no other one, is found by the path of its fault.
                let mut wrong = scenario.clone();
                field.number.set(&mut wrong, f64::NAN);
                let faults = wrong.to_robot().map_or_else(crate::robot::Faults::into_list, |_| Vec::new());
                assert!(
                    faults.iter().any(|fault| fault.path.starts_with(&field.number.path())),
                    "{field:?}: {faults:?}"
                );
                let text = check(&wrong, Settings::default()).expect_err("no number");
                assert!(text.starts_with(field.symbol), "{field:?}: {text}");
            }
        }
    }

    #[test]
    fn what_is_not_allowed_is_said_in_the_words_and_the_unit_of_the_field() {
        let scenario = presets::PRESETS[0].scenario();
        let mut settings = Settings::default();
        let refused = |field: &Field, value: f64, settings: Settings| {
            edited(&scenario, field, value, settings).expect_err("refused")
        };
        assert_eq!(refused(&BODY[0], -5e6, settings), "E must be more than 0 MPa, not -5 MPa");
        let beyond = "The product of E and A is too large or too small a number";
        assert_eq!(
            (refused(&BODY[0], 1e-320, settings), refused(&BODY[0], 1e-310, settings)),
            (beyond.into(), beyond.into())
        );
        settings.stress = StressUnit::Gigapascal;
        assert_eq!(refused(&BODY[0], 0.0, settings), "E must be more than 0 GPa, not 0 GPa");
        assert_eq!(refused(&BODY[1], 0.0, settings), "A must be more than 0 cm², not 0 cm²");
        assert_eq!(
            refused(&SPEED, -1.0, settings),
            "v must be 0 m/s or more, not -1 m/s: turn the direction round to go back"
        );
        assert_eq!(refused(&MODEL[2], 2.5, settings), "n must be a whole number from 2 to 200, not 2.5");
        assert_eq!(refused(&MODEL[2], 1e9, settings), "n must be a whole number from 2 to 200, not 1e9");
    }
}
