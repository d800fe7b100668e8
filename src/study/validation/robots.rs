//! Whole robots: the paper's against an independent program, and what must hold exactly.

use super::comparison::{Comparison, NoComparison};
use crate::mechanics::{self, LengthRates, Statics};
use crate::robot::{
    Cable, CableMaterial, Damping, Linearisation, Motion, Robot, RobotSpec, Strain, TensionLaw, Vec2, paper_spec,
};
use crate::stability::{self, Critical};
use crate::study::LocalProblem;
use crate::study::convergence::{Convergence, Extrapolation, richardson};
use crate::study::verdict::verdict;

/// Searched for critical speeds up to here, in m/s.
const LIMIT: f64 = 40.0;
/// Lengths agree with the independent program to this part (tests/reference/README.md); the other tolerances are its as
/// well: it takes L′ and L″ from differences of sixth order, and its critical speeds follow from these.
const STATICS: f64 = 1e-8;
const RATE: f64 = 1e-7;
/// Of L″, times the longest cable.
const CURVATURE: f64 = 1e-5;
/// Of eigenvalues, in parts of the largest modulus.
const EIGENVALUE: f64 = 1e-6;
/// Of critical speeds in m/s and their frequencies in Hz.
const CRITICAL: f64 = 1e-3;

/// What an independent program found for the paper's robot at (x, 0), moving right.
pub struct Reference {
    x: f64,
    linearisation: Linearisation,
    /// In m/s.
    speed: f64,
    /// In Hz.
    frequency: f64,
}

/// `tests/reference/case_00.json`.
pub const ORIGIN: Reference =
    Reference { x: 0.0, linearisation: Linearisation::Secant, speed: 11.299_042_898_975, frequency: 0.271_550_266_717 };
/// `tests/reference/case_03.json`.
pub const OUTSIDE: Reference =
    Reference { x: 6.0, linearisation: Linearisation::Secant, speed: 10.012_522_067_502, frequency: 1.311_950_280_783 };
/// `tests/reference/case_06.json`.
pub const TANGENT: Reference = Reference {
    x: 0.0,
    linearisation: Linearisation::Tangent,
    speed: 10.906_965_823_565,
    frequency: 0.509_622_407_015,
};

/// The first or the second derivative of a length.
#[derive(Clone, Copy, Debug)]
pub enum Rate {
    /// L′.
    First,
    /// L″.
    Second,
}

impl Rate {
    fn of(self, rates: LengthRates) -> f64 {
        match self {
            Self::First => rates.first,
            Self::Second => rates.second,
        }
    }
}

fn statics(robot: &Robot, position: Vec2) -> Result<Statics, NoComparison> {
    Ok(mechanics::solve(robot, position).map_err(|failure| failure.reason)?)
}

/// The paper's robot, changed, at (x, 0), moving right.
fn paper_at(x: f64, change: impl FnOnce(&mut RobotSpec)) -> Result<LocalProblem, NoComparison> {
    let mut spec = paper_spec();
    change(&mut spec);
    let motion = Motion::new([x, 0.0], [1.0, 0.0], 0.0)?;
    Ok(LocalProblem::new(&Robot::new(spec)?, &motion).map_err(|failure| failure.reason)?)
}

fn critical(local: &LocalProblem) -> Result<Critical, NoComparison> {
    match local.critical_speed(LIMIT)? {
        stability::Outcome::Found(critical) => Ok(critical),
        stability::Outcome::NoneUpTo(_) => Err(NoComparison::Nothing("critical speed")),
    }
}

fn of(reference: &Reference) -> Result<Critical, NoComparison> {
    critical(&paper_at(reference.x, |spec| spec.linearisation = reference.linearisation)?)
}

/// The critical speed at one of the reference's poses.
pub fn critical_speed(reference: &Reference) -> Result<Comparison, NoComparison> {
    Ok(Comparison { expected: reference.speed, got: of(reference)?.speed, tolerance: CRITICAL })
}

/// The frequency of the mode that crosses there.
pub fn critical_frequency(reference: &Reference) -> Result<Comparison, NoComparison> {
    Ok(Comparison { expected: reference.frequency, got: of(reference)?.frequency_hz(), tolerance: CRITICAL })
}

/// The vertical sum of the cables' forces on the platform, at a pose without symmetry: Σ P = (0, m g).
pub fn balance() -> Result<Comparison, NoComparison> {
    let robot = Robot::new(paper_spec())?;
    let shapes = statics(&robot, Vec2::new(3.0, 1.0))?.cables;
    // Half of an element's weight acts at the platform: P = t₀ − (0, w l/2).
    let half_weight = |cable| 0.5 * robot.weight_per_length(cable) / robot.elements as f64;
    let got = shapes.iter().enumerate().map(|(i, shape)| shape.t0.y - half_weight(i) * shape.length).sum();
    // Newton's method ends at rounding, of the tensions' sum: some 1e-13 N, and the loss of a few digits on the way.
    let size: f64 = shapes.iter().map(|shape| shape.tension_at_platform).sum();
    Ok(Comparison { expected: robot.platform_mass * robot.gravity, got, tolerance: 1e-12 * size })
}

/// The paper's cable with the axial stiffness EA (N) and engineering strain.
fn of_stiffness(axial_stiffness: f64) -> CableMaterial {
    CableMaterial { youngs_modulus: axial_stiffness, area: 1.0, strain: Strain::Engineering, ..paper_spec().material }
}

/// L′ or L″ of a cable under constant tension without gravity: it is straight, L = |p − a|/λ, so with s = d · e, e the
/// direction from its anchor to the platform, L′ = s/λ and L″ = (1 − s²)/(|p − a| λ).
pub fn straight(rate: Rate) -> Result<Comparison, NoComparison> {
    let (tension, stiffness) = (50.0, 6250.0);
    let anchor = Vec2::new(-3.0, -5.0);
    let at_equilibrium = |x: f64| Cable::new([x, 5.0], TensionLaw::Equilibrium);
    let cables = vec![at_equilibrium(-10.0), at_equilibrium(10.0), Cable::new(anchor, TensionLaw::Constant(tension))];
    let robot = Robot::new(RobotSpec { gravity: 0.0, material: of_stiffness(stiffness), cables, ..paper_spec() })?;
    let (position, direction) = (Vec2::new(1.0, -1.0), Vec2::new(0.96, -0.28));
    let statics = statics(&robot, position)?;
    let rates =
        mechanics::length_rates(&robot, &statics, direction).ok_or(NoComparison::Nothing("rate of the length"))?;
    let got = rates.get(2).map(|&rates| rate.of(rates)).ok_or(NoComparison::Nothing("third cable"))?;
    let (chord, stretch) = (position - anchor, 1.0 + tension / stiffness);
    let s = direction.dot(&chord.normalize());
    let expected = match rate {
        Rate::First => s / stretch,
        Rate::Second => (1.0 - s * s) / (chord.norm() * stretch),
    };
    // Both are implicit derivatives, exact but for rounding in a system of three equations.
    Ok(Comparison { expected, got, tolerance: 1e-12 })
}

/// Of cable 1 at x = 6 m, where it sags deeply (`tests/reference/case_03.json`): the cable and its rates.
fn sagging_cable() -> Result<(f64, LengthRates), NoComparison> {
    let local = paper_at(6.0, |_| {})?;
    match (local.statics.cables.first(), local.rates.first()) {
        (Some(shape), Some(rates)) => Ok((shape.length, *rates)),
        _ => Err(NoComparison::Nothing("cable")),
    }
}

/// The length of that cable.
pub fn length() -> Result<Comparison, NoComparison> {
    let expected = 17.123_118_276_924;
    Ok(Comparison { expected, got: sagging_cable()?.0, tolerance: STATICS * expected })
}

/// L′ or L″ of that cable.
pub fn rate(rate: Rate) -> Result<Comparison, NoComparison> {
    let (length, rates) = sagging_cable()?;
    // It is the longest.
    let (expected, tolerance) = match rate {
        Rate::First => (1.578_799_734, RATE),
        Rate::Second => (0.861_458_603, CURVATURE / length),
    };
    Ok(Comparison { expected, got: rate.of(rates), tolerance })
}

/// The growth rate at rest without stiffness damping: every mode of λ² + α λ + ω² = 0 that oscillates has Re λ = −α/2.
pub fn at_rest() -> Result<Comparison, NoComparison> {
    let alpha = 0.5;
    let local = paper_at(0.0, |spec| spec.damping = Damping { alpha, beta: 0.0 })?;
    // Rounding of eigenvalues up to 150/s, and what their iteration leaves.
    Ok(Comparison { expected: -0.5 * alpha, got: local.spectrum(0.0)?.growth_rate(), tolerance: 1e-9 })
}

/// The growth rate at x = 7 m and 5 m/s, beyond the critical speed (`tests/reference/case_04.json`).
pub fn growth() -> Result<Comparison, NoComparison> {
    /// The largest modulus of all eigenvalues there, in 1/s.
    const LARGEST: f64 = 124.886;
    let got = paper_at(7.0, |_| {})?.spectrum(5.0)?.growth_rate();
    Ok(Comparison { expected: 5.774_317_094_565, got, tolerance: EIGENVALUE * LARGEST })
}

/// The critical speed at x = −2 m moving left, against that of the mirror image.
pub fn mirrored() -> Result<Comparison, NoComparison> {
    let expected = critical(&paper_at(2.0, |_| {})?)?.speed;
    let motion = Motion::new([-2.0, 0.0], [-1.0, 0.0], 0.0)?;
    let local = LocalProblem::new(&Robot::new(paper_spec())?, &motion).map_err(|failure| failure.reason)?;
    // Both searches refine a crossing to 1e-9 m/s or better; rounding moves it by no more.
    Ok(Comparison { expected, got: critical(&local)?.speed, tolerance: 1e-8 })
}

/// The x at y = 0 from which on cable 1 would have to push; tests/reference/oracle.py finds 7.4897135 m by bisection.
pub fn border() -> Result<Comparison, NoComparison> {
    let robot = Robot::new(paper_spec())?;
    let (mut taut, mut beyond) = (7.0, 8.0);
    if mechanics::solve(&robot, Vec2::new(beyond, 0.0)).is_ok() {
        return Err(NoComparison::Nothing("border"));
    }
    // To 1e-6 m; as much again is allowed.
    for _ in 0..20 {
        let middle = 0.5 * (taut + beyond);
        if mechanics::solve(&robot, Vec2::new(middle, 0.0)).is_ok() { taut = middle } else { beyond = middle }
    }
    Ok(Comparison { expected: 7.489_713_5, got: taut, tolerance: 2e-6 })
}

/// The limit of the critical speed at the origin for ever finer meshes, from 10, 20 and 40 elements. Those that
/// tests/reference/oracle.py finds with 20, 40 and 80 (11.074348, 11.014073, 10.998582 m/s) have the limit 10.993223.
pub fn fine_mesh() -> Result<Comparison, NoComparison> {
    let Extrapolation { limit, uncertainty, .. } = extrapolated(&paper_spec(), [10, 20, 40])?;
    // The study of meshes says itself how far the limit may be off: 0.005 m/s.
    Ok(Comparison { expected: 10.993_223, got: limit, tolerance: uncertainty })
}

/// The limit of the critical speed at the origin, moving right, on three meshes that show its order.
fn extrapolated(spec: &RobotSpec, meshes: [usize; 3]) -> Result<Extrapolation, NoComparison> {
    let motion = Motion::new([0.0, 0.0], [1.0, 0.0], 0.0)?;
    let mut verdicts = Vec::new();
    for elements in meshes {
        let robot = Robot::new(RobotSpec { elements, ..spec.clone() })?;
        verdicts.push((elements, verdict(&robot, &motion, LIMIT).0));
    }
    match richardson(&verdicts, meshes[0]) {
        Convergence::Limit(extrapolation) if extrapolation.estimated => Ok(extrapolation),
        _ => Err(NoComparison::Nothing("limit with an order that was found")),
    }
}

/// The critical speed of a platform that a straight cable of force N and stretch λ draws along the cable's own line.
///
/// Without weight L = |p − a|/λ, so L′ = −1/λ and L″ = 0, and the flow at the winch is v/λ. Waves travel at
/// sqrt(N/(λ μ)). The two are equal at v = sqrt(N λ/μ), where the cable's stiffness at the winch is zero; heavy mass
/// damping keeps everything else away until then. The two cables at equilibrium hold the platform from behind.
pub fn along_its_line() -> Result<Comparison, NoComparison> {
    let at_equilibrium = |y: f64| Cable::new([-6.0, y], TensionLaw::Equilibrium);
    let drawing = Cable::new([10.0, 0.0], TensionLaw::Constant(60.0));
    let stiffness = 6250.0;
    let spec = RobotSpec {
        gravity: 0.0,
        material: of_stiffness(stiffness),
        cables: vec![at_equilibrium(8.0), at_equilibrium(-8.0), drawing],
        damping: Damping { alpha: 50.0, beta: 0.0 },
        ..paper_spec()
    };
    let stretch = 1.0 + 60.0 / stiffness;
    let expected = (60.0 * stretch / spec.material.mass_per_length).sqrt();
    let Extrapolation { limit, uncertainty, .. } = extrapolated(&spec, [20, 40, 80])?;
    // The study of meshes says itself how far the limit may be off: 0.2 % here, where the mesh of 80 is off by 0.8 %.
    Ok(Comparison { expected, got: limit, tolerance: uncertainty })
}
