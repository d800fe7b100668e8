//! Built-in scenarios. To add one, add an entry to [`PRESETS`]; the tests then analyse it too.

use crate::robot::{self, Linearisation, RobotSpec};
use crate::scenario::v1::{Motion, Scenario};

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
