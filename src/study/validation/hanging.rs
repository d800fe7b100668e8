//! Single cables between fixed ends against the elastic catenary and the frequencies known for them.

use std::f64::consts::PI;

use super::comparison::{Comparison, NoComparison, limit};
use crate::mechanics::{self, CableShape, Hub, LengthRates, Vibration};
use crate::robot::{Cable, CableMaterial, Damping, Linearisation, Robot, RobotSpec, Strain, TensionLaw, Vec2};
use crate::stability::{Eigenproblem, bisect};

/// A cable of the table in docs/theory.md section 10: span 10 m, rise 5 m, EA = 6250 N, 3.924 N/m, engineering strain.
pub struct Case {
    /// L in m.
    length: f64,
    /// The horizontal force H in N.
    horizontal: f64,
    /// The vertical forces at the lower and at the upper end in N.
    vertical: [f64; 2],
    /// The first frequency in Hz, on infinitely many elements.
    frequency: f64,
}

/// Hardly sags.
pub const NEARLY_STRAIGHT: Case =
    Case { length: 11.0, horizontal: 112.985_627_17, vertical: [35.444_312_62, 78.608_312_62], frequency: 0.940_69 };
/// Sags so that its two first frequencies come near each other.
pub const SAGGING: Case =
    Case { length: 11.18, horizontal: 65.247_029_11, vertical: [11.631_760_11, 55.502_080_11], frequency: 1.021_30 };
/// Hangs below its lower end.
pub const DEEP: Case =
    Case { length: 11.5, horizontal: 37.865_605_10, vertical: [-2.000_570_95, 43.125_429_05], frequency: 0.851_48 };

/// The closed form's numbers are given to eight digits: H to 5e-9 N of 40 N or more, which moves a length by no more.
const DIGITS: f64 = 2e-8;

/// One cable from the platform to an anchor.
struct Hanging {
    axial_stiffness: f64,
    mass_per_length: f64,
    gravity: f64,
    span: Vec2,
}

/// The cable of the table, held by its lower end.
const TABLE: Hanging =
    Hanging { axial_stiffness: 6250.0, mass_per_length: 0.4, gravity: 9.81, span: Vec2::new(10.0, 5.0) };

impl Hanging {
    /// Its shape on a mesh with `tension` (N) at its lower end, and its vibrations with both ends fixed.
    ///
    /// The program knows whole robots only: two short cables on the other side hold the platform.
    fn with_tension(&self, elements: usize, tension: f64) -> Result<(CableShape, Vibration), NoComparison> {
        let back = -self.span.normalize();
        let aside = Vec2::new(-back.y, back.x);
        let holding = |anchor: Vec2| Cable::new(anchor, TensionLaw::Equilibrium);
        let own = Cable::new(self.span, TensionLaw::Constant(tension));
        let robot = Robot::new(RobotSpec {
            gravity: self.gravity,
            material: CableMaterial {
                youngs_modulus: self.axial_stiffness,
                area: 1.0,
                mass_per_length: self.mass_per_length,
                strain: Strain::Engineering,
            },
            platform_mass: 1e-3,
            cables: vec![holding(back + aside), holding(back - aside), own],
            elements,
            damping: Damping { alpha: 0.0, beta: 0.0 },
            linearisation: Linearisation::Tangent,
        })?;
        let statics = mechanics::solve(&robot, Vec2::zeros()).map_err(|failure| failure.reason)?;
        let at_rest = [LengthRates { first: 0.0, second: 0.0 }; 3];
        let vibration = Vibration::new(&robot, &statics, &at_rest).ok_or(NoComparison::Nothing("problem"))?;
        let own = vibration.chains().iter().skip(2).cloned().collect();
        let alone =
            Vibration::of_cables(own, Hub::fixed(1), robot.damping, false).ok_or(NoComparison::Nothing("cable"))?;
        let shape = statics.cables.into_iter().nth(2).ok_or(NoComparison::Nothing("third cable"))?;
        Ok((shape, alone))
    }

    /// The first frequency in Hz on 20 and 40 elements, with `tension` at the lower end.
    fn first_frequencies(&self, tension: f64) -> Result<[f64; 2], NoComparison> {
        let on_mesh = |n: usize| -> Result<f64, NoComparison> {
            let (_, vibration) = self.with_tension(n, tension)?;
            let spectrum = Eigenproblem::new(&vibration)?.spectrum(0.0)?;
            spectrum.modes().next().map(|mode| mode.frequency_hz()).ok_or(NoComparison::Nothing("mode"))
        };
        Ok([on_mesh(20)?, on_mesh(40)?])
    }
}

impl Case {
    fn tension(&self, end: usize) -> f64 {
        self.horizontal.hypot(self.vertical[end])
    }

    /// The cable with the closed form's tension at its lower end, on 20 and 40 elements.
    fn shapes(&self) -> Result<[CableShape; 2], NoComparison> {
        Ok([TABLE.with_tension(20, self.tension(0))?.0, TABLE.with_tension(40, self.tension(0))?.0])
    }
}

/// The length of a cable with the closed form's tension at its lower end, for ever finer meshes.
pub fn length(case: &Case) -> Result<Comparison, NoComparison> {
    let [coarse, fine] = case.shapes()?.map(|shape| shape.length);
    // Extrapolated, the mesh's error is of order n⁻⁴ of a slight sag, and below the digits of the closed form.
    Ok(Comparison { expected: case.length, got: limit(coarse, fine), tolerance: DIGITS * case.length })
}

/// The tension at the upper end of the same.
pub fn upper_tension(case: &Case) -> Result<Comparison, NoComparison> {
    let [coarse, fine] = case.shapes()?.map(|shape| shape.tension_at_winch);
    let expected = case.tension(1);
    Ok(Comparison { expected, got: limit(coarse, fine), tolerance: DIGITS * expected })
}

/// The order at which the length's error falls with the number of elements: 2.
pub fn order() -> Result<Comparison, NoComparison> {
    let [coarse, fine] = SAGGING.shapes()?.map(|shape| shape.length - SAGGING.length);
    // With the error a/n² + b/n⁴ and b of the size of a, the order is off by (1/20² − 1/40²)/ln 2 = 0.0027 or so.
    Ok(Comparison { expected: 2.0, got: (coarse / fine).log2(), tolerance: 0.005 })
}

/// The first frequency of a cable with fixed ends, for ever finer meshes, with tangent stiffness.
pub fn first_frequency(case: &Case) -> Result<Comparison, NoComparison> {
    let [coarse, fine] = TABLE.first_frequencies(case.tension(0))?;
    // Five decimals are given, so half of 1e-5 Hz; the other half is for the n⁻⁴ that extrapolation leaves, which for a
    // string is (π/20)⁴/7680 = 8e-8 of the frequency, and 20 times that where sag couples the first with higher modes.
    Ok(Comparison { expected: case.frequency, got: limit(coarse, fine), tolerance: 1e-5 })
}

/// The first frequency of a shallow horizontal cable with the cable parameter λ² = 10, as Ω/π.
pub fn shallow() -> Result<Comparison, NoComparison> {
    const LAMBDA_SQUARED: f64 = 10.0;
    let (span, weight, slope): (f64, f64, f64) = (10.0, 4.0, 8e-3);
    // w span/H = 8 × sag/span; λ² = (w span/H)² EA/H for a shallow cable.
    let horizontal = weight * span / slope;
    let cable = Hanging {
        axial_stiffness: LAMBDA_SQUARED * horizontal / (slope * slope),
        mass_per_length: 0.4,
        gravity: weight / 0.4,
        span: Vec2::new(span, 0.0),
    };
    let tension = horizontal.hypot(0.5 * weight * span);
    let [coarse, fine] = cable.first_frequencies(tension)?;
    // Ω = ω span/sqrt(H/μ).
    let expected = first_root(LAMBDA_SQUARED)?;
    let got = 2.0 * limit(coarse, fine) * span / (horizontal / cable.mass_per_length).sqrt();
    // Shallow theory drops squares of the slope and, beside 1, the strain H/EA = slope²/λ².
    Ok(Comparison { expected, got, tolerance: slope * slope * expected })
}

/// Ω/π = 2z/π with z the root of tan z = z − (4/λ²) z³ between π/2 and 3π/2.
fn first_root(lambda_squared: f64) -> Result<f64, NoComparison> {
    // Times cos z there is no pole; it falls from sin(π/2) = 1 to where the polynomial wins.
    let f = |z: f64| z.sin() - (z - 4.0 / lambda_squared * z * z * z) * z.cos();
    let around = [0.5 * PI, 1.5 * PI];
    if f(around[0]) * f(around[1]) >= 0.0 {
        return Err(NoComparison::Nothing("sign change"));
    }
    let [low, high] = bisect(around, 60, |z| f(z) * f(around[0]) > 0.0);
    Ok((low + high) / PI)
}
