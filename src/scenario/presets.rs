//! Built-in scenarios. To add one, add an entry to [`PRESETS`]; the tests then analyse it too.

use crate::robot::{self, Cable, CableMaterial, Damping, Linearisation, RobotSpec, Strain, TensionLaw};
use crate::scenario::json::{Motion, Scenario};

/// A built-in scenario.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// By which it is asked for.
    pub name: &'static str,
    /// For people.
    pub title: &'static str,
    /// One sentence on what it shows, one on what to try.
    pub description: &'static str,
    robot: fn() -> RobotSpec,
    motion: Motion,
}

/// All built-in scenarios, the one to start with first.
pub static PRESETS: &[Preset] = &[
    Preset {
        name: "paper",
        title: "Paper robot",
        description: "The robot of Aminpur and Farhadi's paper in the middle of its workspace, on its way to the right. \
                      Move the platform toward the right border: the critical speed falls and the frequency rises.",
        robot: robot::paper_spec,
        motion: RIGHT,
    },
    Preset {
        name: "paper-tangent",
        title: "Paper robot, tangent stiffness",
        description: "The same robot with the full tangent stiffness in place of the paper's simplified secant one. \
                      Change the linearisation back and forth to see what the simplification does.",
        robot: || RobotSpec { linearisation: Linearisation::Tangent, ..robot::paper_spec() },
        motion: RIGHT,
    },
    Preset {
        name: "slack",
        title: "Slack rubber ropes",
        description: "The lower two of four soft ropes sag by a sixth of their span and can only just hold up their own \
                      weight. Move the platform one metre up, and the critical speed falls below its 2 m/s; move it \
                      two metres to a side, and there is no equilibrium.",
        robot: slack,
        motion: Motion { speed: 2.0, ..RIGHT },
    },
    Preset {
        name: "building",
        title: "Facade robot, steel ropes",
        description: "A facade of 40 m by 20 m, steel ropes of 10 mm and tensions of kilonewtons. Double the tension of \
                      both lower ropes, and the critical speed rises by a ninth; double the mass damping instead, and \
                      it rises by four fifths.",
        robot: building,
        motion: Motion { position: [0.0, 10.0], speed: 1.5, ..RIGHT },
    },
    Preset {
        name: "lab",
        title: "Desktop robot, thin cords",
        description: "A robot for a table, one metre wide, whose cords of 1 mm flutter at 94 Hz. Raise both lower \
                      tensions from 10 N to 20 N: the frequency rises by the square root of two, as a guitar string's \
                      does, and the critical speed by half.",
        robot: lab,
        motion: Motion { position: [0.0, 0.4], speed: 1.0, ..RIGHT },
    },
    Preset {
        name: "five-cables",
        title: "Five cables",
        description: "Winches at the corners of a pentagon, the upper two cables at equilibrium. Turn the direction all \
                      the way round: each of the five cables is responsible in turn, always one that is reeled in.",
        robot: five_cables,
        motion: Motion { speed: 2.0, ..RIGHT },
    },
];

/// From the middle to the right at 5 m/s.
const RIGHT: Motion = Motion { position: [0.0, 0.0], direction: [1.0, 0.0], speed: 5.0 };

impl Preset {
    /// The scenario, named by the title.
    pub fn scenario(&self) -> Scenario {
        Scenario { name: Some(self.title.into()), ..Scenario::new(&(self.robot)(), self.motion) }
    }
}

/// The built-in scenario called `name`.
pub fn find(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

fn free(x: f64, y: f64) -> Cable {
    Cable::new([x, y], TensionLaw::Equilibrium)
}

fn constant(x: f64, y: f64, tension: f64) -> Cable {
    Cable::new([x, y], TensionLaw::Constant(tension))
}

// In these four the tangent stiffness, which simplifies nothing. Fibres and steel ropes damp their first vibration by
// 0.5 to 1 % of critical, rubber by several per cent: α and β are chosen for that.

// Rubber shock cord of 20 mm: about 0.27 kg/m, and 5 MPa while it is stretched little. A lower rope weighs 23 N and is
// held with 24 N.
fn slack() -> RobotSpec {
    RobotSpec {
        gravity: 9.81,
        material: CableMaterial { youngs_modulus: 5e6, area: 3.1e-4, mass_per_length: 0.27, strain: Strain::Green },
        platform_mass: 2.0,
        cables: vec![free(-7.0, 4.5), free(7.0, 4.5), constant(-7.0, -4.5, 24.0), constant(7.0, -4.5, 24.0)],
        elements: 10,
        damping: Damping { alpha: 0.5, beta: 0.005 },
        linearisation: Linearisation::Tangent,
    }
}

// Wire rope 6×36 with a steel core of 10 mm: by the tables of EN 12385-4 about 0.41 kg/m, 46 mm² of metal and 63 kN
// breaking force (here used to a tenth). Stranded, the metal has 90 to 110 GPa instead of its 200.
fn building() -> RobotSpec {
    RobotSpec {
        gravity: 9.81,
        material: CableMaterial { youngs_modulus: 1e11, area: 4.6e-5, mass_per_length: 0.409, strain: Strain::Green },
        platform_mass: 300.0,
        cables: vec![free(-20.0, 20.0), free(20.0, 20.0), constant(-20.0, 0.0, 3000.0), constant(20.0, 0.0, 3000.0)],
        elements: 10,
        damping: Damping { alpha: 0.2, beta: 1e-4 },
        linearisation: Linearisation::Tangent,
    }
}

// Braided polyethylene cord (Dyneema) of 1 mm: 0.7 g/m, so 0.7 mm² of fibre at 970 kg/m³. Braided, the fibre has about
// 30 GPa instead of its 110. Tensions and mass as usual for robots on a table.
fn lab() -> RobotSpec {
    RobotSpec {
        gravity: 9.81,
        material: CableMaterial { youngs_modulus: 3e10, area: 7e-7, mass_per_length: 7e-4, strain: Strain::Green },
        platform_mass: 0.3,
        cables: vec![free(-0.5, 0.8), free(0.5, 0.8), constant(-0.5, 0.0, 10.0), constant(0.5, 0.0, 10.0)],
        elements: 10,
        damping: Damping { alpha: 3.0, beta: 1e-5 },
        linearisation: Linearisation::Tangent,
    }
}

// The wire rope of `building` in 4 mm, on a pentagon within a circle of 8 m.
fn five_cables() -> RobotSpec {
    RobotSpec {
        gravity: 9.81,
        material: CableMaterial { youngs_modulus: 1e11, area: 7.4e-6, mass_per_length: 0.065, strain: Strain::Green },
        platform_mass: 25.0,
        cables: vec![
            free(-4.7, 6.5),
            free(4.7, 6.5),
            constant(-7.6, -2.5, 200.0),
            constant(7.6, -2.5, 200.0),
            constant(0.0, -8.0, 100.0),
        ],
        elements: 10,
        damping: Damping { alpha: 0.4, beta: 1e-4 },
        linearisation: Linearisation::Tangent,
    }
}
