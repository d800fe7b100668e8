//! The numbers of a scenario that can be turned: name, unit, range, meaning, where they live.

use crate::app::number::{self, Unit};
use crate::app::settings::{Settings, StressUnit};
use crate::robot::{Allowed, ELEMENTS, Fault};
use crate::scenario::{Parameter, Scenario};

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
    /// The number.
    pub parameter: Parameter,
}

impl Field {
    /// The same in the units chosen.
    pub fn in_units_of(mut self, settings: Settings) -> Self {
        if self.parameter == Parameter::YoungsModulus && settings.stress == StressUnit::Gigapascal {
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
        match self.parameter {
            Parameter::Anchor(cable, _) => format!("{} of winch {}", self.symbol, cable + 1),
            Parameter::Tension(cable) | Parameter::Horizontal(cable, _) | Parameter::Vertical(cable, _) => {
                format!("{} of cable {}", self.symbol, cable + 1)
            }
            _ => self.symbol.into(),
        }
    }
}

const fn field(name: &'static str, symbol: &'static str, unit: &'static str, parameter: Parameter) -> Field {
    Field { name, symbol, unit, range: [0.0, 1.0], logarithmic: false, integer: false, meaning: "", parameter }
}

/// The speed of the platform.
pub const SPEED: Field = Field {
    range: [0.0, 40.0],
    meaning: "The platform's speed v along its direction of motion. The eigenvalues on show are those at this speed; the \
              critical speed does not depend on it.",
    ..field("Speed", "v", "m/s", Parameter::Speed)
};

/// The angle of the motion.
pub const DIRECTION: Field = Field {
    range: [-180.0, 180.0],
    meaning: "The direction of the motion: 0° to the right, 90° upward. Drag the arrow's tip on the canvas for the same.",
    ..field("Direction", "θ", "°", Parameter::Direction)
};

/// Where the platform is, within `frame`: [left, bottom, right, top] in m.
pub fn position([left, bottom, right, top]: [f64; 4]) -> [Field; 2] {
    let meaning = "The platform's position: x to the right, y up. Drag the platform on the canvas for the same.";
    let field = |name, symbol, parameter, range| Field { range, meaning, ..field(name, symbol, "m", parameter) };
    [
        field("Position", "x", Parameter::PositionX, [left, right]),
        field("Position", "y", Parameter::PositionY, [bottom, top]),
    ]
}

/// Cables and platform.
pub const BODY: [Field; 5] = [
    Field {
        range: [1.0, 300_000.0],
        logarithmic: true,
        meaning: "Young's modulus of the cables. With A it makes the axial stiffness EA of N(λ).",
        ..field("Young's modulus", "E", "MPa", Parameter::YoungsModulus)
    },
    Field {
        range: [0.001, 10.0],
        logarithmic: true,
        meaning: "Cross-section of the cables.",
        ..field("Cross-section", "A", "cm²", Parameter::Area)
    },
    Field {
        range: [0.001, 10.0],
        logarithmic: true,
        meaning: "Mass of the cables per unstretched length. The wave speed of a cable is √(T/μ).",
        ..field("Cable mass", "μ", "kg/m", Parameter::MassPerLength)
    },
    Field {
        range: [0.01, 1000.0],
        logarithmic: true,
        meaning: "Mass of the platform, a point mass.",
        ..field("Platform mass", "m", "kg", Parameter::PlatformMass)
    },
    Field {
        range: [0.0, 20.0],
        meaning: "Gravitational acceleration. At 0 the cables are straight.",
        ..field("Gravity", "g", "m/s²", Parameter::Gravity)
    },
];

/// Damping and mesh.
pub const MODEL: [Field; 3] = [
    Field {
        range: [0.0, 5.0],
        meaning: "Damping in proportion to mass: the α of αM + βK. It works against reeling-in, which feeds \
                  every frequency alike.",
        ..field("Mass damping", "α", "1/s", Parameter::Alpha)
    },
    Field {
        range: [0.0, 0.1],
        logarithmic: true,
        meaning: "Damping in proportion to elastic stiffness: the β of αM + βK. It calms high frequencies most.",
        ..field("Stiffness damping", "β", "s", Parameter::Beta)
    },
    Field {
        range: [2.0, 40.0],
        integer: true,
        meaning: "Finite elements per cable. The error falls as 1/n² where a vibration grows, as 1/n for a divergence; the \
                  work grows faster than n. Mesh, among the plots, tells how large it is.",
        ..field("Elements per cable", "n", "", Parameter::Elements)
    },
];

/// Where a cable's winch is, about `frame`: [left, bottom, right, top] in m.
pub fn anchor(cable: usize, [left, bottom, right, top]: [f64; 4]) -> [Field; 2] {
    let meaning = "Where the winch is: x to the right, y up. Once unlocked it can be dragged on the canvas.";
    let field = |name, i, low: f64, high: f64| {
        let more = 0.2 * (high - low);
        Field { range: [low - more, high + more], meaning, ..field(name, name, "m", Parameter::Anchor(cable, i)) }
    };
    [field("x", 0, left, right), field("y", 1, bottom, top)]
}

/// The constant tension of a cable.
pub fn tension(cable: usize) -> Field {
    Field {
        range: [1.0, 10_000.0],
        logarithmic: true,
        meaning: "The tension that the winch holds at the platform's end of this cable.",
        ..field("Tension", "T", "N", Parameter::Tension(cable))
    }
}

/// The six coefficients of a cable's tension law.
pub fn law(cable: usize) -> [Field; 6] {
    let meaning = "A coefficient of the tension at the platform, T = hypot(h0 + hx x + hy y, v0 + vx x + vy y).";
    let constant = |name, parameter| Field { range: [-500.0, 500.0], meaning, ..field(name, name, "N", parameter) };
    let slope = |name, parameter| Field { range: [-50.0, 50.0], meaning, ..field(name, name, "N/m", parameter) };
    [
        constant("h0", Parameter::Horizontal(cable, 0)),
        slope("hx", Parameter::Horizontal(cable, 1)),
        slope("hy", Parameter::Horizontal(cable, 2)),
        constant("v0", Parameter::Vertical(cable, 0)),
        slope("vx", Parameter::Vertical(cable, 1)),
        slope("vy", Parameter::Vertical(cable, 2)),
    ]
}

/// The fields of all numbers of a scenario.
fn all(scenario: &Scenario) -> impl Iterator<Item = Field> {
    let cables = (0..scenario.cables.len()).flat_map(|cable| {
        let law = law(cable).into_iter().chain([tension(cable)]);
        law.chain(anchor(cable, [0.0; 4]))
    });
    let fixed = [SPEED, DIRECTION].into_iter().chain(position([0.0; 4])).chain(BODY).chain(MODEL);
    fixed.chain(cables).filter(|field| field.parameter.is_in(scenario))
}

/// Puts another value, as it is stored, in the place of a number.
///
/// # Errors
/// Why it is not allowed, in the words of the field that it is about: mostly this one.
pub fn edited(scenario: &Scenario, field: &Field, value: f64, settings: Settings) -> Result<Scenario, String> {
    let mut edited = scenario.clone();
    if field.integer && value.fract() != 0.0 {
        let fault = Fault::new(field.parameter.path(), value, Allowed::Whole(ELEMENTS));
        return Err(in_words(&fault, scenario, settings));
    }
    field.parameter.set(&mut edited, value);
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
        path.strip_prefix(&field.parameter.path()).is_some_and(|rest| rest.is_empty() || rest.starts_with('['))
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
                field.parameter.set(&mut wrong, f64::NAN);
                let faults = wrong.to_robot().map_or_else(crate::robot::Faults::into_list, |_| Vec::new());
                assert!(
                    faults.iter().any(|fault| fault.path.starts_with(&field.parameter.path())),
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
