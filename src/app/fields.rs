//! The numbers of a scenario that can be turned: name, unit, range, meaning, where they live.

use crate::app::state::{Settings, StressUnit};
use crate::robot::TensionLaw;
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
    /// SI units per displayed unit.
    pub factor: f64,
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
            self.factor *= 1e3;
            self.range = self.range.map(|end| end / 1e3);
            self.unit = "GPa";
        }
        self
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
    let (factor, range) = (1.0, [0.0, 1.0]);
    Field { name, symbol, unit, factor, range, logarithmic: false, integer: false, meaning: "", number }
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
    factor: std::f64::consts::PI / 180.0,
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
        factor: 1e6,
        range: [1.0, 300_000.0],
        logarithmic: true,
        meaning: "Young's modulus of the cables. With A it makes the axial stiffness EA of N(λ).",
        ..field("Young's modulus", "E", "MPa", Number::YoungsModulus)
    },
    Field {
        factor: 1e-4,
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
        meaning: "Finite elements per cable. The error falls as 1/n²; the work grows faster than n.",
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
