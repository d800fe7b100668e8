//! The robot and its motion, validated: if a [`Robot`] exists, it is physical.

mod bounding_box;
mod path;
mod profile;
mod spline;
mod trajectory;

use std::fmt;

use nalgebra::Vector2;

pub use bounding_box::BoundingBox;
pub use path::{PathPoint, Side};
pub use profile::Profile;
pub use trajectory::{Moment, Trajectory};

/// A point or a vector in the robot's plane, in metres or newtons: x to the right, y up.
pub type Vec2 = Vector2<f64>;

/// How many cables a robot may have.
pub const CABLES: std::ops::RangeInclusive<usize> = 3..=8;
/// How many elements a cable may be divided into.
pub const ELEMENTS: std::ops::RangeInclusive<usize> = 2..=200;
/// Two anchors nearer than this, in metres, are the same point.
const COINCIDENT: f64 = 1e-9;

/// The strain measure of the axial law, see [`crate::mechanics::Material`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strain {
    /// Green's strain ε = ½(λ² − 1) with energy ½ EA ε²: the paper's choice.
    Green,
    /// Engineering strain ε = λ − 1.
    Engineering,
}

/// Which stiffness a small displacement from the static shape meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Linearisation {
    /// The secant stiffness (N/λ) I: the paper's simplification (its Eq. 15).
    Secant,
    /// The full tangent stiffness (its Eq. 14).
    Tangent,
}

/// What sets a cable's tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TensionLaw {
    /// The tension follows from the platform's equilibrium. Exactly two cables of a robot are of this kind.
    Equilibrium,
    /// The tension at the platform is this constant, in newtons.
    Constant(f64),
    /// The tension at the platform is `hypot(h₀ + hₓ x + h_y y, v₀ + vₓ x + v_y y)`, in newtons, at the
    /// platform's position (x, y).
    Hypot {
        /// h₀ in N, hₓ and `h_y` in N/m.
        horizontal: [f64; 3],
        /// v₀ in N, vₓ and `v_y` in N/m.
        vertical: [f64; 3],
    },
}

impl TensionLaw {
    /// The tension at the platform's position (x, y) in m, in newtons; 0 for a cable at equilibrium, whose tension no law
    /// sets.
    pub fn at(self, [x, y]: [f64; 2]) -> f64 {
        match self {
            Self::Equilibrium => 0.0,
            Self::Constant(tension) => tension,
            Self::Hypot { horizontal: [h0, hx, hy], vertical: [v0, vx, vy] } => {
                (h0 + hx * x + hy * y).hypot(v0 + vx * x + vy * y)
            }
        }
    }
}

/// What a cable is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CableMaterial {
    /// Young's modulus E, in Pa.
    pub youngs_modulus: f64,
    /// Cross-section A, in m².
    pub area: f64,
    /// Mass μ per unstretched length, in kg/m.
    pub mass_per_length: f64,
    /// The strain measure.
    pub strain: Strain,
}

impl CableMaterial {
    /// Its numbers, each with its field's name in a scenario file.
    fn numbers(&self) -> [(&'static str, f64); 3] {
        let Self { youngs_modulus, area, mass_per_length, .. } = *self;
        [("youngs_modulus", youngs_modulus), ("area", area), ("mass_per_length", mass_per_length)]
    }

    /// EA in newtons.
    pub fn axial_stiffness(&self) -> f64 {
        self.youngs_modulus * self.area
    }
}

/// What one cable has of its own in the place of the material that all cables share; what is `None` is shared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OwnMaterial {
    /// Young's modulus E, in Pa.
    pub youngs_modulus: Option<f64>,
    /// Cross-section A, in m².
    pub area: Option<f64>,
    /// Mass μ per unstretched length, in kg/m.
    pub mass_per_length: Option<f64>,
    /// The strain measure.
    pub strain: Option<Strain>,
}

impl OwnMaterial {
    /// The numbers that it has, each with its field's name in a scenario file.
    fn numbers(&self) -> impl Iterator<Item = (&'static str, f64)> + use<> {
        let Self { youngs_modulus, area, mass_per_length, .. } = *self;
        let all = [("youngs_modulus", youngs_modulus), ("area", area), ("mass_per_length", mass_per_length)];
        all.into_iter().filter_map(|(name, value)| Some((name, value?)))
    }

    /// Whether all of it is shared.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// What the cable is made of where the others share `common`.
    pub fn over(&self, common: CableMaterial) -> CableMaterial {
        CableMaterial {
            youngs_modulus: self.youngs_modulus.unwrap_or(common.youngs_modulus),
            area: self.area.unwrap_or(common.area),
            mass_per_length: self.mass_per_length.unwrap_or(common.mass_per_length),
            strain: self.strain.unwrap_or(common.strain),
        }
    }
}

/// One cable: from the platform to a fixed winch point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cable {
    /// The winch point, in metres.
    pub anchor: Vec2,
    /// What sets its tension.
    pub tension: TensionLaw,
    /// What it has of its own in the place of the robot's cable material.
    pub own: OwnMaterial,
}

impl Cable {
    /// A cable to the winch at `anchor` (m), made of what all cables share.
    pub fn new(anchor: impl Into<Vec2>, tension: TensionLaw) -> Self {
        Self { anchor: anchor.into(), tension, own: OwnMaterial::default() }
    }
}

/// Damping in proportion to mass (α, 1/s) and to elastic stiffness (β, s): αM + βK.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damping {
    /// α in 1/s.
    pub alpha: f64,
    /// β in s.
    pub beta: f64,
}

/// What a robot is made of, not yet validated. SI units throughout.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotSpec {
    /// Gravitational acceleration g, downward, in m/s².
    pub gravity: f64,
    /// What the cables are made of, unless one has something of its own: [`Cable::own`].
    pub material: CableMaterial,
    /// Mass m of the platform, in kg.
    pub platform_mass: f64,
    /// The cables, in the order of their numbers.
    pub cables: Vec<Cable>,
    /// Elements per cable, n.
    pub elements: usize,
    /// Damping.
    pub damping: Damping,
    /// Secant or tangent stiffness.
    pub linearisation: Linearisation,
}

/// A validated robot; derefs to its [`RobotSpec`] for reading.
///
/// ```
/// use tautline::robot::{Robot, RobotSpec, paper_spec};
///
/// let heavier = Robot::new(RobotSpec { platform_mass: 3.0, ..paper_spec() })?;
/// assert_eq!((heavier.cables.len(), heavier.equilibrium()), (4, &[0, 1][..]));
///
/// // All faults are told at once, each with its field, the value found and what is allowed.
/// let refused = Robot::new(RobotSpec { platform_mass: 0.0, gravity: -9.81, ..paper_spec() });
/// let faults = refused.map_err(|faults| faults.to_string());
/// assert_eq!(faults.unwrap_err().lines().last(), Some("platform.mass: 0.0 is not allowed; allowed: a finite number greater than 0"));
/// # Ok::<(), tautline::robot::Faults>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    spec: RobotSpec,
    equilibrium: Vec<usize>,
}

/// One thing wrong with an input: where, what was found, what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The field's path in a scenario file, such as `cables[2].anchor`.
    pub path: String,
    /// The value found, as text; [`Fault::MISSING`] where there is none.
    pub value: String,
    /// What is allowed.
    pub allowed: Allowed,
}

/// What may stand in a field. Written out, it speaks of a scenario file's fields; programs that have other words for
/// them find here what they need.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Allowed {
    /// A finite number.
    Finite,
    /// A finite number greater than 0.
    Positive,
    /// A finite number, 0 or more.
    NotNegative {
        /// What to do instead of a negative one; empty where there is nothing.
        instead: &'static str,
    },
    /// A whole number of this range.
    Whole(std::ops::RangeInclusive<usize>),
    /// A number whose products with those at these paths are within the range of floating-point numbers.
    ProductsWith(Vec<String>),
    /// Another point than the anchor of this cable (0-based).
    OtherThanAnchor(usize),
    /// Something else, in words.
    Words(String),
}

impl fmt::Display for Allowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite => f.write_str("a finite number"),
            Self::Positive => f.write_str("a finite number greater than 0"),
            Self::NotNegative { instead: "" } => f.write_str("a finite number, 0 or more"),
            Self::NotNegative { instead } => write!(f, "a finite number, 0 or more ({instead})"),
            Self::Whole(range) => write!(f, "a whole number from {} to {}", range.start(), range.end()),
            Self::ProductsWith(paths) => {
                let (products, are) = if paths.len() == 1 { ("product", "is") } else { ("products", "are") };
                let paths = paths.join(" and ");
                write!(f, "a value whose {products} with {paths} {are} within the range of floating-point numbers")
            }
            Self::OtherThanAnchor(cable) => write!(f, "a point that differs from cables[{cable}].anchor"),
            Self::Words(words) => f.write_str(words),
        }
    }
}

impl From<&str> for Allowed {
    fn from(words: &str) -> Self {
        Self::Words(words.into())
    }
}

impl From<String> for Allowed {
    fn from(words: String) -> Self {
        Self::Words(words)
    }
}

impl Fault {
    /// Stands for the value of a required field that is not there.
    pub const MISSING: &'static str = "missing";

    /// A fault at `path`, where `value` was found and `allowed` says what may stand there.
    pub fn new(path: impl Into<String>, value: impl fmt::Display, allowed: impl Into<Allowed>) -> Self {
        Self { path: path.into(), value: value.to_string(), allowed: allowed.into() }
    }

    /// The same for a number; very large and very small ones get an exponent instead of hundreds of digits.
    pub fn number(path: impl Into<String>, value: f64, allowed: Allowed) -> Self {
        Self::new(path, format_args!("{value:?}"), allowed)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, value, allowed } = self;
        let verdict = if value == Self::MISSING { "" } else { " is not allowed" };
        write!(f, "{path}: {value}{verdict}; allowed: {allowed}")
    }
}

/// Everything wrong with an input; never empty.
///
/// ```compile_fail
/// // There is no refusal without a reason.
/// let faults = tautline::robot::Faults(Vec::new());
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
pub struct Faults(Vec<Fault>);

impl Faults {
    /// Nothing where there are none.
    ///
    /// # Errors
    /// The `faults`.
    pub fn check(faults: Vec<Fault>) -> Result<(), Self> {
        if faults.is_empty() { Ok(()) } else { Err(Self(faults)) }
    }

    /// All of them, at least one.
    pub fn list(&self) -> &[Fault] {
        &self.0
    }

    /// The same to be changed, though not in number.
    pub fn list_mut(&mut self) -> &mut [Fault] {
        &mut self.0
    }

    /// These and, after them, `others`.
    #[must_use]
    pub fn and(mut self, others: Self) -> Self {
        self.0.extend(others.0);
        self
    }

    /// All of them, at least one.
    pub fn into_list(self) -> Vec<Fault> {
        self.0
    }
}

impl From<Fault> for Faults {
    fn from(fault: Fault) -> Self {
        Self(vec![fault])
    }
}

impl Robot {
    /// Validates `spec`.
    ///
    /// # Errors
    /// All faults at once: E, A, μ, m not positive, own values of a cable included (or EA or a mass beyond the range of
    /// numbers), negative
    /// gravity or damping, a number that is not finite, fewer than 3 or more than 8 cables, not exactly two
    /// at equilibrium, a constant tension that is not positive, coincident anchors, elements outside 2..=200.
    pub fn new(spec: RobotSpec) -> Result<Self, Faults> {
        let mut faults = Vec::new();
        let mut check = |path: &str, value: f64, ok: bool, allowed: Allowed| {
            if !(ok && value.is_finite()) {
                faults.push(Fault::number(path, value, allowed));
            }
        };
        let not_negative = || Allowed::NotNegative { instead: "" };
        let positive = || Allowed::Positive;
        check("gravity", spec.gravity, spec.gravity >= 0.0, not_negative());
        for (name, value) in spec.material.numbers() {
            check(&format!("cable.{name}"), value, value > 0.0, positive());
        }
        check("platform.mass", spec.platform_mass, spec.platform_mass > 0.0, positive());
        check("damping.alpha", spec.damping.alpha, spec.damping.alpha >= 0.0, not_negative());
        check("damping.beta", spec.damping.beta, spec.damping.beta >= 0.0, not_negative());
        for (i, cable) in spec.cables.iter().enumerate() {
            for (j, &coordinate) in cable.anchor.iter().enumerate() {
                check(&format!("cables[{i}].anchor[{j}]"), coordinate, true, Allowed::Finite);
            }
            match cable.tension {
                TensionLaw::Equilibrium => {}
                TensionLaw::Constant(tension) => {
                    check(&format!("cables[{i}].tension.constant"), tension, tension > 0.0, positive());
                }
                TensionLaw::Hypot { horizontal, vertical } => {
                    for (name, coefficients) in [("horizontal", horizontal), ("vertical", vertical)] {
                        for (j, coefficient) in coefficients.into_iter().enumerate() {
                            let path = format!("cables[{i}].tension.{name}[{j}]");
                            check(&path, coefficient, true, Allowed::Finite);
                        }
                    }
                }
            }
            for (name, value) in cable.own.numbers() {
                check(&format!("cables[{i}].cable.{name}"), value, value > 0.0, positive());
            }
        }
        if faults.is_empty() {
            check_products(&spec, &mut faults);
        }
        if !ELEMENTS.contains(&spec.elements) {
            faults.push(Fault::new("elements_per_cable", spec.elements, Allowed::Whole(ELEMENTS)));
        }
        let equilibrium = check_cables(&spec.cables, &mut faults);
        if faults.is_empty() { Ok(Self { spec, equilibrium }) } else { Err(Faults(faults)) }
    }

    /// The cables at equilibrium, which hold the platform: as many as it has degrees of freedom, two for a point. 0-based,
    /// in rising order.
    pub fn equilibrium(&self) -> &[usize] {
        &self.equilibrium
    }

    /// The prescribed (stiffening) cables, 0-based.
    pub fn prescribed(&self) -> impl Iterator<Item = usize> {
        (0..self.spec.cables.len()).filter(|i| !self.equilibrium.contains(i))
    }

    /// What a cable (0-based) is made of: its own values, and for the rest those that all cables share. There is no other
    /// place to ask.
    pub fn material_of(&self, cable: usize) -> CableMaterial {
        let common = self.spec.material;
        self.spec.cables.get(cable).map_or(common, |cable| cable.own.over(common))
    }

    /// EA of a cable (0-based), in newtons.
    pub fn axial_stiffness(&self, cable: usize) -> f64 {
        self.material_of(cable).axial_stiffness()
    }

    /// The weight of a cable (0-based) per unstretched length, μ g, in N/m.
    pub fn weight_per_length(&self, cable: usize) -> f64 {
        self.material_of(cable).mass_per_length * self.spec.gravity
    }
}

impl std::ops::Deref for Robot {
    type Target = RobotSpec;

    fn deref(&self) -> &RobotSpec {
        &self.spec
    }
}

/// Products of legal numbers that leave the range of floating point. Of a product that has an own value in it, that one is
/// at fault.
fn check_products(spec: &RobotSpec, faults: &mut Vec<Fault>) {
    let products = |paths: &[&str]| Allowed::ProductsWith(paths.iter().map(ToString::to_string).collect());
    let common = spec.material;
    if !common.axial_stiffness().is_normal() {
        faults.push(Fault::number("cable.youngs_modulus", common.youngs_modulus, products(&["cable.area"])));
    }
    if !(common.mass_per_length * spec.gravity).is_finite() || !(spec.platform_mass * spec.gravity).is_finite() {
        let allowed = products(&["cable.mass_per_length", "platform.mass"]);
        faults.push(Fault::number("gravity", spec.gravity, allowed));
    }
    for (i, OwnMaterial { youngs_modulus, area, mass_per_length, .. }) in
        spec.cables.iter().map(|cable| cable.own).enumerate()
    {
        let own = |name| format!("cables[{i}].cable.{name}");
        let stiffness = youngs_modulus.unwrap_or(common.youngs_modulus) * area.unwrap_or(common.area);
        if !stiffness.is_normal() {
            match (youngs_modulus, area) {
                (Some(modulus), Some(_)) => {
                    let allowed = products(&[&own("area")]);
                    faults.push(Fault::number(own("youngs_modulus"), modulus, allowed));
                }
                (Some(modulus), None) => {
                    faults.push(Fault::number(own("youngs_modulus"), modulus, products(&["cable.area"])));
                }
                (None, Some(area)) => {
                    faults.push(Fault::number(own("area"), area, products(&["cable.youngs_modulus"])));
                }
                // Said of the material that all cables share.
                (None, None) => {}
            }
        }
        if let Some(mass) = mass_per_length.filter(|mass| !(mass * spec.gravity).is_finite()) {
            faults.push(Fault::number(own("mass_per_length"), mass, products(&["gravity"])));
        }
    }
}

/// The degrees of freedom of a platform that is a point.
const DOF: usize = 2;

/// Checks number, kinds and anchors of the cables; gives those at equilibrium.
fn check_cables(cables: &[Cable], faults: &mut Vec<Fault>) -> Vec<usize> {
    if !CABLES.contains(&cables.len()) {
        let allowed = format!("{} to {} cables", CABLES.start(), CABLES.end());
        faults.push(Fault::new("cables", format!("a list of {}", cables.len()), allowed));
    }
    // If the list is far too long, only its first cables are compared, each with all before it.
    for (j, b) in cables.iter().enumerate().take(*CABLES.end()) {
        for (i, a) in cables[..j].iter().enumerate() {
            if (a.anchor - b.anchor).norm() < COINCIDENT {
                let value = format!("[{:?}, {:?}]", b.anchor.x, b.anchor.y);
                faults.push(Fault::new(format!("cables[{j}].anchor"), value, Allowed::OtherThanAnchor(i)));
            }
        }
    }
    let at_equilibrium: Vec<usize> =
        (0..cables.len()).filter(|&i| cables[i].tension == TensionLaw::Equilibrium).collect();
    if at_equilibrium.len() != DOF {
        let value = format!("{} cables with tension \"equilibrium\"", at_equilibrium.len());
        faults.push(Fault::new("cables", value, "exactly two with tension \"equilibrium\""));
    }
    at_equilibrium
}

/// Where the platform is and how it moves: at constant velocity, quasi-statically.
///
/// ```
/// use tautline::Motion;
///
/// // At (2, −1) m, along (3, 4), with 5 m/s. The direction is normalised.
/// let motion = Motion::new([2.0, -1.0], [3.0, 4.0], 5.0)?;
/// assert!((motion.direction().x - 0.6).abs() < 1e-15 && (motion.direction().y - 0.8).abs() < 1e-15);
/// assert!(Motion::new([2.0, -1.0], [0.0, 0.0], 5.0).is_err(), "no direction");
/// # Ok::<(), tautline::robot::Faults>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    position: Vec2,
    direction: Vec2,
    speed: f64,
}

impl Motion {
    /// A motion through `position` (m) along `direction` (any length but zero; it is normalised) at `speed`
    /// (m/s, not negative).
    ///
    /// # Errors
    /// Numbers that are not finite, a zero direction, a negative speed.
    pub fn new(position: impl Into<Vec2>, direction: impl Into<Vec2>, speed: f64) -> Result<Self, Faults> {
        let (position, direction) = (position.into(), direction.into());
        let mut faults = Vec::new();
        for (name, vector) in [("position", position), ("direction", direction)] {
            for (j, coordinate) in vector.iter().enumerate().filter(|(_, c)| !c.is_finite()) {
                faults.push(Fault::number(format!("motion.{name}[{j}]"), *coordinate, Allowed::Finite));
            }
        }
        if !(speed.is_finite() && speed >= 0.0) {
            let allowed = Allowed::NotNegative { instead: "turn the direction round to go back" };
            faults.push(Fault::number("motion.speed", speed, allowed));
        }
        // A unit vector stays as it is, so that a motion that is written and read again is the same to the last bit.
        // Others are scaled by their largest component first: the square of 1e-200 is zero, and of 1e200 infinite.
        let is_unit = (direction.norm_squared() - 1.0).abs() <= 4.0 * f64::EPSILON;
        let unit = if is_unit { direction } else { (direction / direction.amax()).normalize() };
        if direction.amax() == 0.0 {
            let value = format!("[{:?}, {:?}]", direction.x, direction.y);
            faults.push(Fault::new("motion.direction", value, "a vector that is not zero"));
        }
        Faults::check(faults)?;
        Ok(Self { position, direction: unit, speed })
    }

    /// The platform's position, in metres.
    pub fn position(&self) -> Vec2 {
        self.position
    }

    /// The unit vector of the motion.
    pub fn direction(&self) -> Vec2 {
        self.direction
    }

    /// The speed, in m/s.
    pub fn speed(&self) -> f64 {
        self.speed
    }
}

/// The robot of the paper's section 3, with α = 0.5 1/s and β = 0.005 s, for which the paper gives no values.
///
/// # Errors
/// None: the robot is physical, as the tests show.
pub fn paper() -> Result<Robot, Faults> {
    Robot::new(paper_spec())
}

/// What [`paper`] is made of.
pub fn paper_spec() -> RobotSpec {
    let stiffening = |slope| TensionLaw::Hypot { horizontal: [50.0, slope, 0.0], vertical: [45.0, 0.0, 0.0] };
    let cable = |x, y, tension| Cable::new([x, y], tension);
    RobotSpec {
        gravity: 9.81,
        material: CableMaterial { youngs_modulus: 125e6, area: 5e-5, mass_per_length: 0.4, strain: Strain::Green },
        platform_mass: 2.0,
        cables: vec![
            cable(-10.0, 5.0, TensionLaw::Equilibrium),
            cable(10.0, 5.0, TensionLaw::Equilibrium),
            cable(-10.0, -5.0, stiffening(5.0)),
            cable(10.0, -5.0, stiffening(-5.0)),
        ],
        elements: 10,
        damping: Damping { alpha: 0.5, beta: 0.005 },
        linearisation: Linearisation::Secant,
    }
}
