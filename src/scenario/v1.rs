//! The scenario file, `tautline/scenario/1`: a robot, a pose and a motion as JSON. The durable format: what can be
//! read today stays readable.
//!
//! ```
//! use tautline::scenario::{Scenario, presets};
//!
//! let scenario = presets::PRESETS[0].scenario();
//! let (robot, motion) = scenario.to_robot()?;
//! assert_eq!((robot.cables.len(), motion.speed()), (4, 5.0));
//! assert_eq!(Scenario::from_json(&scenario.to_json())?, scenario);
//! # Ok::<(), tautline::robot::Faults>(())
//! ```

use serde::Serialize;

use crate::robot::{
    self, CABLES, Damping, ELEMENTS, Faults, Linearisation, Robot, RobotSpec, Strain, TensionLaw, Vec2,
};
use crate::scenario::layout;
use crate::scenario::reader::{Document, Value};

/// The name and version of the format.
pub const SCHEMA: &str = "tautline/scenario/1";
/// Gravitational acceleration where a file gives none, in m/s².
pub const DEFAULT_GRAVITY: f64 = 9.81;

/// A robot, where its platform is and how it moves, as a file holds it. SI units throughout.
///
/// Fields can be set to anything; [`Scenario::to_robot`] tells whether the whole is physical.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scenario {
    /// [`SCHEMA`].
    pub schema: Schema,
    /// A title for people.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Gravitational acceleration g, downward, in m/s².
    pub gravity: f64,
    /// What the cables are made of.
    pub cable: Material,
    /// The platform.
    pub platform: Platform,
    /// The cables, in the order of their numbers.
    pub cables: Vec<Cable>,
    /// Elements per cable, n.
    pub elements_per_cable: usize,
    /// Damping αM + βK.
    #[serde(with = "DampingForm")]
    pub damping: Damping,
    /// Secant or tangent stiffness.
    #[serde(with = "LinearisationForm")]
    pub linearisation: Linearisation,
    /// Where the platform is and how it moves.
    pub motion: Motion,
}

/// The version of the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Schema {
    /// [`SCHEMA`].
    #[serde(rename = "tautline/scenario/1")]
    V1,
}

/// What the cables are made of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Material {
    /// Young's modulus E in Pa.
    pub youngs_modulus: f64,
    /// Cross-section A in m².
    pub area: f64,
    /// Mass μ per unstretched length in kg/m.
    pub mass_per_length: f64,
    /// The strain measure.
    #[serde(with = "StrainForm")]
    pub strain: Strain,
}

/// The platform.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Platform {
    /// Its mass m in kg.
    pub mass: f64,
}

/// One cable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cable {
    /// The winch point [x, y] in m.
    pub anchor: [f64; 2],
    /// What sets its tension.
    #[serde(with = "TensionForm")]
    pub tension: TensionLaw,
}

/// Where the platform is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Motion {
    /// The pose [x, y] in m.
    pub position: [f64; 2],
    /// The direction of the motion, of any length but zero.
    pub direction: [f64; 2],
    /// The speed in m/s.
    pub speed: f64,
}

impl Scenario {
    /// The scenario of a robot and its motion, without a name.
    pub fn new(robot: &RobotSpec, motion: impl Into<Motion>) -> Self {
        let cable = |cable: &robot::Cable| Cable { anchor: cable.anchor.into(), tension: cable.tension };
        Self {
            schema: Schema::V1,
            name: None,
            gravity: robot.gravity,
            cable: Material {
                youngs_modulus: robot.youngs_modulus,
                area: robot.area,
                mass_per_length: robot.mass_per_length,
                strain: robot.strain,
            },
            platform: Platform { mass: robot.platform_mass },
            cables: robot.cables.iter().map(cable).collect(),
            elements_per_cable: robot.elements,
            damping: robot.damping,
            linearisation: robot.linearisation,
            motion: motion.into(),
        }
    }

    /// The robot and its motion.
    ///
    /// # Errors
    /// All that is not physical, see [`Robot::new`] and [`robot::Motion::new`].
    pub fn to_robot(&self) -> Result<(Robot, robot::Motion), Faults> {
        let cable = |cable: &Cable| robot::Cable { anchor: cable.anchor.into(), tension: cable.tension };
        let robot = Robot::new(RobotSpec {
            gravity: self.gravity,
            youngs_modulus: self.cable.youngs_modulus,
            area: self.cable.area,
            mass_per_length: self.cable.mass_per_length,
            strain: self.cable.strain,
            platform_mass: self.platform.mass,
            cables: self.cables.iter().map(cable).collect(),
            elements: self.elements_per_cable,
            damping: self.damping,
            linearisation: self.linearisation,
        });
        let Motion { position, direction, speed } = self.motion;
        match (robot, robot::Motion::new(position, direction, speed)) {
            (Ok(robot), Ok(motion)) => Ok((robot, motion)),
            (Err(of_robot), Err(of_motion)) => Err(of_robot.and(of_motion)),
            (Err(faults), _) | (_, Err(faults)) => Err(faults),
        }
    }

    /// Reads a scenario file.
    ///
    /// `schema` and `name` may be missing; so may `gravity` ([`DEFAULT_GRAVITY`]), `strain` (Green) and `linearisation`
    /// (secant). All other fields are required, and there are no others.
    ///
    /// # Errors
    /// Where the text is not a scenario's JSON, all that is wrong with it; else all that is not physical.
    pub fn from_json(text: &str) -> Result<Self, Faults> {
        let document = Document::new("scenario", text)?;
        let scenario = read(&document.root());
        document.check()?;
        scenario.to_robot().map_err(|faults| document.quoted(faults))?;
        Ok(scenario)
    }

    /// The scenario file; [`Self::from_json`] gives back the same scenario to the last bit.
    ///
    /// JSON has no numbers that are not finite: these become `null`, which is not read again.
    pub fn to_json(&self) -> String {
        layout::pretty(self)
    }
}

impl From<&robot::Motion> for Motion {
    fn from(motion: &robot::Motion) -> Self {
        let pair = |v: Vec2| [v.x, v.y];
        Self { position: pair(motion.position()), direction: pair(motion.direction()), speed: motion.speed() }
    }
}

const TENSION: &str =
    r#""equilibrium", {"constant": T} or {"horizontal": [h0, hx, hy], "vertical": [v0, vx, vy]} with numbers"#;

fn read(file: &Value) -> Scenario {
    let file = file.object(&[
        "schema",
        "name",
        "gravity",
        "cable",
        "platform",
        "cables",
        "elements_per_cable",
        "damping",
        "linearisation",
        "motion",
    ]);
    if let Some(schema) = file.optional("schema") {
        schema.choice(&[(SCHEMA, ())], &format!("{SCHEMA:?}"));
    }
    let cable = file.field("cable").object(&["youngs_modulus", "area", "mass_per_length", "strain"]);
    let platform = file.field("platform").object(&["mass"]);
    let damping = file.field("damping").object(&["alpha", "beta"]);
    let motion = file.field("motion").object(&["position", "direction", "speed"]);
    let strains = [("green", Strain::Green), ("engineering", Strain::Engineering)];
    let linearisations = [("secant", Linearisation::Secant), ("tangent", Linearisation::Tangent)];
    Scenario {
        schema: Schema::V1,
        name: file.optional("name").map(|name| name.text()),
        gravity: file.optional("gravity").map_or(DEFAULT_GRAVITY, |gravity| gravity.number()),
        cable: Material {
            youngs_modulus: cable.field("youngs_modulus").number(),
            area: cable.field("area").number(),
            mass_per_length: cable.field("mass_per_length").number(),
            strain: (cable.optional("strain"))
                .and_then(|strain| strain.choice(&strains, r#""green" or "engineering""#))
                .unwrap_or(Strain::Green),
        },
        platform: Platform { mass: platform.field("mass").number() },
        cables: {
            let allowed = format!("a list of {} to {} cables", CABLES.start(), CABLES.end());
            file.field("cables").list(&allowed).iter().map(read_cable).collect()
        },
        elements_per_cable: {
            let allowed = robot::Allowed::Whole(ELEMENTS).to_string();
            file.field("elements_per_cable").whole(&allowed)
        },
        damping: Damping { alpha: damping.field("alpha").number(), beta: damping.field("beta").number() },
        linearisation: (file.optional("linearisation"))
            .and_then(|linearisation| linearisation.choice(&linearisations, r#""secant" or "tangent""#))
            .unwrap_or(Linearisation::Secant),
        motion: Motion {
            position: motion.field("position").vector(),
            direction: motion.field("direction").vector(),
            speed: motion.field("speed").number(),
        },
    }
}

fn read_cable(cable: &Value) -> Cable {
    let cable = cable.object(&["anchor", "tension"]);
    let tension = cable.field("tension");
    let names = tension.names();
    let has = |name: &str| names.iter().any(|n| n == name);
    Cable {
        anchor: cable.field("anchor").vector(),
        tension: match (has("constant"), has("horizontal") || has("vertical")) {
            (true, false) => TensionLaw::Constant(tension.object(&["constant"]).field("constant").number()),
            (false, true) => {
                let law = tension.object(&["horizontal", "vertical"]);
                TensionLaw::Hypot {
                    horizontal: law.field("horizontal").vector(),
                    vertical: law.field("vertical").vector(),
                }
            }
            _ => {
                let words = [("equilibrium", TensionLaw::Equilibrium)];
                tension.choice(&words, TENSION).unwrap_or(TensionLaw::Equilibrium)
            }
        },
    }
}

// The robot's own types know no JSON; these say how they are written.

#[derive(Serialize)]
#[serde(remote = "Damping")]
struct DampingForm {
    alpha: f64,
    beta: f64,
}

#[derive(Serialize)]
#[serde(remote = "Linearisation", rename_all = "lowercase")]
enum LinearisationForm {
    Secant,
    Tangent,
}

#[derive(Serialize)]
#[serde(remote = "Strain", rename_all = "lowercase")]
enum StrainForm {
    Green,
    Engineering,
}

#[derive(Serialize)]
#[serde(remote = "TensionLaw", rename_all = "lowercase")]
enum TensionForm {
    Equilibrium,
    Constant(f64),
    #[serde(untagged)]
    Hypot {
        horizontal: [f64; 3],
        vertical: [f64; 3],
    },
}
