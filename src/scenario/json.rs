//! The scenario file: a robot, a pose and a motion as JSON. The durable format: what can be read today stays readable.
//!
//! There are two versions. `tautline/scenario/2` has all that `tautline/scenario/1` has, in a cable the field `cable` with
//! what that cable is made of, and the field `path`. The version follows from what is used: a scenario without a field of the second
//! version is written in the first, so that older programs read it too.
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

use serde::{Serialize, Serializer};

use crate::robot::{
    self, CABLES, CableMaterial, Damping, ELEMENTS, Faults, Linearisation, OwnMaterial, Robot, RobotSpec, Strain,
    TensionLaw, Vec2,
};
use crate::scenario::layout;
use crate::scenario::path::Path;
use crate::scenario::reader::{Document, Object, Value};

/// The name and the first version of the format.
pub const SCHEMA: &str = "tautline/scenario/1";
/// The second version, in which cables may have a material of their own, and the platform a path.
pub const SCHEMA_2: &str = "tautline/scenario/2";
/// Gravitational acceleration where a file gives none, in m/s².
pub const DEFAULT_GRAVITY: f64 = 9.81;

/// A robot, where its platform is and how it moves, as a file holds it. SI units throughout.
///
/// Fields can be set to anything; [`Scenario::to_robot`] tells whether the whole is physical.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// A title for people.
    pub name: Option<String>,
    /// Gravitational acceleration g, downward, in m/s².
    pub gravity: f64,
    /// What the cables are made of, unless one has something of its own.
    pub cable: Material,
    /// The platform.
    pub platform: Platform,
    /// The cables, in the order of their numbers.
    pub cables: Vec<Cable>,
    /// Elements per cable, n.
    pub elements_per_cable: usize,
    /// Damping αM + βK.
    pub damping: Damping,
    /// Secant or tangent stiffness.
    pub linearisation: Linearisation,
    /// Where the platform is and how it moves.
    pub motion: Motion,
    /// Where it flies from there.
    pub path: Option<Path>,
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

impl From<CableMaterial> for Material {
    fn from(material: CableMaterial) -> Self {
        let CableMaterial { youngs_modulus, area, mass_per_length, strain } = material;
        Self { youngs_modulus, area, mass_per_length, strain }
    }
}

impl From<Material> for CableMaterial {
    fn from(material: Material) -> Self {
        let Material { youngs_modulus, area, mass_per_length, strain } = material;
        Self { youngs_modulus, area, mass_per_length, strain }
    }
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
    /// What it has of its own in the place of the scenario's [`Material`]. In a file an object without fields means the same
    /// as none.
    #[serde(with = "OwnMaterialForm", skip_serializing_if = "OwnMaterial::is_empty")]
    pub cable: OwnMaterial,
}

impl Cable {
    /// A cable to the winch at `anchor` (m), made of what all cables share.
    pub fn new(anchor: [f64; 2], tension: TensionLaw) -> Self {
        Self { anchor, tension, cable: OwnMaterial::default() }
    }
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
        let cable =
            |cable: &robot::Cable| Cable { anchor: cable.anchor.into(), tension: cable.tension, cable: cable.own };
        Self {
            name: None,
            gravity: robot.gravity,
            cable: robot.material.into(),
            platform: Platform { mass: robot.platform_mass },
            cables: robot.cables.iter().map(cable).collect(),
            elements_per_cable: robot.elements,
            damping: robot.damping,
            linearisation: robot.linearisation,
            motion: motion.into(),
            path: None,
        }
    }

    /// The robot and its motion.
    ///
    /// # Errors
    /// All that is not physical, see [`Robot::new`] and [`robot::Motion::new`], and all that is wrong with the path.
    pub fn to_robot(&self) -> Result<(Robot, robot::Motion), Faults> {
        let cable =
            |cable: &Cable| robot::Cable { anchor: cable.anchor.into(), tension: cable.tension, own: cable.cable };
        let robot = Robot::new(RobotSpec {
            gravity: self.gravity,
            material: self.cable.into(),
            platform_mass: self.platform.mass,
            cables: self.cables.iter().map(cable).collect(),
            elements: self.elements_per_cable,
            damping: self.damping,
            linearisation: self.linearisation,
        });
        let Motion { position, direction, speed } = self.motion;
        let both = match (robot, robot::Motion::new(position, direction, speed)) {
            (Ok(robot), Ok(motion)) => Ok((robot, motion)),
            (Err(of_robot), Err(of_motion)) => Err(of_robot.and(of_motion)),
            (Err(faults), _) | (_, Err(faults)) => Err(faults),
        };
        let of_path = self.path.as_ref().map_or_else(Vec::new, |path| path.faults(position));
        match (both, Faults::check(of_path)) {
            (both, Ok(())) => both,
            (Ok(_), Err(of_path)) => Err(of_path),
            (Err(faults), Err(of_path)) => Err(faults.and(of_path)),
        }
    }

    /// The trajectory of its path; `None` where it has none.
    pub fn trajectory(&self) -> Option<robot::Trajectory> {
        self.path.as_ref()?.trajectory(self.motion.position)
    }

    /// The version of the format in which it is written: [`SCHEMA_2`] where a cable has something of its own or there is a
    /// path, else [`SCHEMA`].
    pub fn schema(&self) -> &'static str {
        let first = self.path.is_none() && self.cables.iter().all(|cable| cable.cable.is_empty());
        if first { SCHEMA } else { SCHEMA_2 }
    }

    /// What a cable (0-based) is made of: its own values, and for the rest those that all cables share.
    pub fn material_of(&self, cable: usize) -> Material {
        let own = self.cables.get(cable).map(|cable| cable.cable).unwrap_or_default();
        own.over(self.cable.into()).into()
    }

    /// Reads a scenario file of either version.
    ///
    /// `schema` and `name` may be missing; so may `gravity` ([`DEFAULT_GRAVITY`]), `strain` (Green) and `linearisation`
    /// (secant), of a cable `cable` with any of its fields, and `path`, of which only `points` is required. All other fields are required, and there are no others. A file
    /// without `schema` may have the fields of either version; one that says it is of the first must have none of the second.
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

/// The fields of a material.
const MATERIAL: [&str; 4] = ["youngs_modulus", "area", "mass_per_length", "strain"];

/// The version that a file says it is of.
#[derive(Clone, Copy, PartialEq)]
enum Version {
    First,
    Second,
}

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
        "path",
    ]);
    let versions = [(SCHEMA, Version::First), (SCHEMA_2, Version::Second)];
    let version = (file.optional("schema"))
        .and_then(|schema| schema.choice(&versions, &format!("{SCHEMA:?} or {SCHEMA_2:?}")))
        .unwrap_or(Version::Second);
    let cable = file.field("cable").object(&MATERIAL);
    let platform = file.field("platform").object(&["mass"]);
    let damping = file.field("damping").object(&["alpha", "beta"]);
    let motion = file.field("motion").object(&["position", "direction", "speed"]);
    let linearisations = [("secant", Linearisation::Secant), ("tangent", Linearisation::Tangent)];
    let speed = motion.field("speed").number();
    Scenario {
        name: file.optional("name").map(|name| name.text()),
        gravity: file.optional("gravity").map_or(DEFAULT_GRAVITY, |gravity| gravity.number()),
        cable: Material {
            youngs_modulus: cable.field("youngs_modulus").number(),
            area: cable.field("area").number(),
            mass_per_length: cable.field("mass_per_length").number(),
            strain: read_strain(&cable).unwrap_or(Strain::Green),
        },
        platform: Platform { mass: platform.field("mass").number() },
        cables: {
            let allowed = format!("a list of {} to {} cables", CABLES.start(), CABLES.end());
            file.field("cables").list(&allowed).iter().map(|cable| read_cable(cable, version)).collect()
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
            speed,
        },
        path: file
            .optional("path")
            .filter(|path| !refused(path, version, "a file without path"))
            .map(|path| Path::read(&path, speed)),
    }
}

/// Notes a fault where a file that says it is of the first version has a field of the second.
fn refused(value: &Value, version: Version, allowed: &str) -> bool {
    let refused = version == Version::First;
    if refused {
        let allowed = format!("{allowed} in {SCHEMA:?}; say {SCHEMA_2:?}, or leave it out");
        value.refuse(&format!("a field of {SCHEMA_2}"), &allowed);
    }
    refused
}

/// The strain measure of a material, where it is given.
fn read_strain(material: &Object) -> Option<Strain> {
    let strains = [("green", Strain::Green), ("engineering", Strain::Engineering)];
    material.optional("strain")?.choice(&strains, r#""green" or "engineering""#)
}

/// What a cable has of its own; nothing where the field is missing.
fn read_own(cable: &Object, version: Version) -> OwnMaterial {
    let Some(own) = cable.optional("cable") else { return OwnMaterial::default() };
    if refused(&own, version, "the fields anchor, tension") {
        return OwnMaterial::default();
    }
    let own = own.object(&MATERIAL);
    let number = |name| own.optional(name).map(|number| number.number());
    OwnMaterial {
        youngs_modulus: number("youngs_modulus"),
        area: number("area"),
        mass_per_length: number("mass_per_length"),
        strain: read_strain(&own),
    }
}

fn read_cable(cable: &Value, version: Version) -> Cable {
    let cable = cable.object(&["anchor", "tension", "cable"]);
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
        cable: read_own(&cable, version),
    }
}

impl Serialize for Scenario {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        ScenarioForm::serialize(self, serializer)
    }
}

/// The fields of a file in their order. The version is none of the scenario's own: it follows from the others.
#[derive(Serialize)]
#[serde(remote = "Scenario")]
struct ScenarioForm {
    #[serde(getter = "Scenario::schema")]
    schema: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    gravity: f64,
    cable: Material,
    platform: Platform,
    cables: Vec<Cable>,
    elements_per_cable: usize,
    #[serde(with = "DampingForm")]
    damping: Damping,
    #[serde(with = "LinearisationForm")]
    linearisation: Linearisation,
    motion: Motion,
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<Path>,
}

// The robot's own types know no JSON; these say how they are written.

#[derive(Serialize)]
#[serde(remote = "OwnMaterial")]
struct OwnMaterialForm {
    #[serde(skip_serializing_if = "Option::is_none")]
    youngs_modulus: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    area: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mass_per_length: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "own_strain")]
    strain: Option<Strain>,
}

#[expect(clippy::ref_option, clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference to the field")]
fn own_strain<S: Serializer>(strain: &Option<Strain>, serializer: S) -> Result<S::Ok, S::Error> {
    match strain {
        Some(strain) => StrainForm::serialize(strain, serializer),
        None => serializer.serialize_none(),
    }
}

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
