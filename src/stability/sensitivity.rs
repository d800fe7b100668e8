//! How a crossing of the imaginary axis moves when the problem changes a little.
//!
//! Let λ be a simple eigenvalue at speed v, Q(λ, v) x = 0 and yᵀ Q(λ, v) = 0. Then dλ/dp = −(yᵀ `Q_p` x)/(yᵀ `Q_λ` x) for
//! whatever Q depends on, the speed included, and the crossing moves so that Re λ stays what it is:
//!
//! - dv/dp = −Re `λ_p`/Re `λ_v`
//! - dω/dp = Im (`λ_p` + `λ_v` dv/dp)
//!
//! yᵀ is y* of the usual left eigenvector, so that y is the mode of the transposed problem: M and K are symmetric, C and D
//! are transposed. With λ given, every yᵀ `Q_p` x is made of four numbers, yᵀ M x, yᵀ C x, yᵀ K x and yᵀ D x.
//! docs/theory.md section 12.

use std::f64::consts::TAU;

use nalgebra::{Complex, Matrix2};

use super::modes::{Displacement, frequency_scale};
use crate::mechanics::{Chain, Hub, Vibration};
use crate::robot::Damping;
use crate::stability::{Characteristic, Critical, Polarisation, mode};

type C64 = Complex<f64>;

/// Within this part of |λ| an eigenvalue must be alone to count as simple.
const ALONE: f64 = 1e-6;
/// Points of the circle on which the eigenvalues inside are counted, and how far from one the count may be.
const CIRCLE: u32 = 8;
const COUNT: f64 = 0.1;
/// A crossing at a smaller angle to the axis than this, Re `λ_v`/|`λ_v`|, is a touch.
const TRANSVERSAL: f64 = 1e-6;

/// Why a critical speed has no derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoSensitivity {
    /// The critical speed is 0, as without damping, and stays there: nothing to take parts of.
    #[error("the robot is unstable at any speed above zero, so there is no critical speed to change")]
    FromRest,
    /// Two or more eigenvalues cross together or nearly so.
    #[error("several modes cross together here, and which of them does first depends on the change")]
    NotSimple,
    /// The eigenvalue touches the axis where it crosses.
    #[error("the eigenvalue only touches the axis here, so the critical speed may jump")]
    NotTransversal,
    /// Numbers leave the range of floating point, or the pose is singular.
    #[error("the derivatives of this robot cannot be computed in floating point")]
    OutOfRange,
}

/// How far a crossing moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// dv, of the critical speed in m/s.
    pub speed: f64,
    /// dω, of the frequency in rad/s.
    pub omega: f64,
}

/// A simple, transversal crossing, ready to be asked how it moves.
#[derive(Clone, Debug)]
pub struct Crossing {
    lambda: C64,
    speed: f64,
    damping: Damping,
    right: Vec<Vec<Displacement>>,
    left: Vec<Vec<Displacement>>,
    forms: Forms,
    /// yᵀ `Q_λ` x.
    by_lambda: C64,
    /// `λ_v`.
    slope: C64,
}

/// yᵀ M x, yᵀ C x, yᵀ K x and yᵀ D x.
#[derive(Clone, Copy, Debug, Default)]
struct Forms {
    mass: C64,
    transfer: C64,
    elastic: C64,
    flow: C64,
}

impl Crossing {
    /// The crossing `critical` of `vibration`.
    ///
    /// # Errors
    /// [`NoSensitivity`] where v = 0, where λ is not simple (there is another eigenvalue within 1e-6 |λ|), or where
    /// Re `λ_v` is not positive, to 1e-6 of |`λ_v`|.
    pub fn new(vibration: &Vibration, critical: &Critical) -> Result<Self, NoSensitivity> {
        let Critical { speed, eigenvalue: lambda, .. } = *critical;
        if speed <= 0.0 {
            return Err(NoSensitivity::FromRest);
        }
        if !is_simple(vibration, lambda, speed) {
            return Err(NoSensitivity::NotSimple);
        }
        let shape = |vibration| mode(vibration, speed, lambda, Polarisation::default()).displacement;
        let (right, left) = (shape(vibration), shape(&transposed(vibration)));
        let forms = Forms::of(vibration, &left, &right);
        let Damping { alpha, beta } = vibration.damping;
        let by_lambda = forms.mass * (lambda * 2.0 + alpha) + forms.transfer * speed + forms.elastic * beta;
        let slope = -(forms.transfer * lambda + forms.flow * (2.0 * speed)) / by_lambda;
        if !(slope.re.is_finite() && slope.im.is_finite()) {
            return Err(NoSensitivity::OutOfRange);
        }
        if slope.re <= TRANSVERSAL * slope.norm() {
            return Err(NoSensitivity::NotTransversal);
        }
        Ok(Self { lambda, speed, damping: vibration.damping, right, left, forms, by_lambda, slope })
    }

    /// The shift per unit of a parameter, given the derivatives of the matrices with respect to it in the form of a
    /// problem, α and β unchanged: [`Vibration::derivative`].
    pub fn shift(&self, derivative: &Vibration) -> Shift {
        let forms = Forms::of(derivative, &self.left, &self.right);
        let (lambda, speed, Damping { alpha, beta }) = (self.lambda, self.speed, self.damping);
        self.shift_by(
            forms.mass * lambda * (lambda + alpha)
                + forms.transfer * lambda * speed
                + forms.elastic * (lambda * beta + 1.0)
                + forms.flow * (speed * speed),
        )
    }

    /// The shift for a small `change` of α and β.
    pub fn shift_by_damping(&self, change: Damping) -> Shift {
        self.shift_by(self.lambda * (self.forms.mass * change.alpha + self.forms.elastic * change.beta))
    }

    /// The shift per unit of what yᵀ `Q_p` x is given for.
    fn shift_by(&self, form: C64) -> Shift {
        let by_parameter = -form / self.by_lambda;
        let speed = -by_parameter.re / self.slope.re;
        Shift { speed, omega: (by_parameter + self.slope * speed).im }
    }
}

impl Forms {
    /// Of the matrices in `vibration` with two shapes.
    fn of(vibration: &Vibration, left: &[Vec<Displacement>], right: &[Vec<Displacement>]) -> Self {
        let mut forms = Self::default();
        if let (Hub::Platform(mass), [left, ..], [right, ..]) = (vibration.hub, left, right) {
            forms.mass = left[0].dot(&right[0]) * mass;
        }
        for (chain, (left, right)) in vibration.chains.iter().zip(left.iter().zip(right)) {
            for (element, (y, x)) in chain.elements().iter().zip(left.windows(2).zip(right.windows(2))) {
                let products = Matrix2::from_fn(|i, j| y[i].dot(&x[j]));
                let form = |block: &Matrix2<f64>| products.zip_map(block, |product, entry| product * entry).sum();
                forms.mass += form(&element.mass);
                forms.transfer += form(&element.transfer);
                forms.flow += form(&element.flow);
                forms.elastic += (y[0] - y[1]).dot(&(element.elastic.map(C64::from) * (x[0] - x[1])));
            }
        }
        forms
    }
}

/// The problem whose matrices are the transposed ones.
fn transposed(vibration: &Vibration) -> Vibration {
    let mut transposed = vibration.clone();
    for element in transposed.chains.iter_mut().flat_map(Chain::elements_mut) {
        element.transfer.transpose_mut();
        element.flow.transpose_mut();
    }
    transposed
}

/// Whether just one eigenvalue is nearer to λ than [`ALONE`] allows, of those of one direction where the problem is
/// isotropic: by the integral of d ln det Q/dλ = Σ 1/(λ − λⱼ) along a circle, as a sum over equally spaced points.
fn is_simple(vibration: &Vibration, lambda: C64, speed: f64) -> bool {
    let radius = ALONE * lambda.norm().max(frequency_scale(vibration));
    let function = Characteristic::new(vibration);
    let part = |k: u32| {
        let offset = C64::from_polar(radius, TAU * (f64::from(k) + 0.5) / f64::from(CIRCLE));
        function.at(lambda + offset, speed).by_lambda * offset
    };
    let count = (0..CIRCLE).map(part).sum::<C64>() / f64::from(CIRCLE);
    (count - 1.0).norm() < COUNT
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{Block, Element};
    use crate::stability::Kind;

    /// An element of one node that moves, the other being held: a = 3 times the mass, the rest as given.
    fn element(mass: f64, transfer: f64, elastic: f64) -> Element {
        Element {
            mass: Block::identity() * mass,
            transfer: Block::identity() * transfer,
            flow: Block::zeros(),
            elastic: Matrix2::identity() * elastic,
        }
    }

    /// Cables of two elements with fixed ends do not know of each other: single oscillators
    /// 2m q̈ + (2 v c + 2 α m) q̇ + 2k q = 0 with c < 0, which lose stability at v = −α m/c with ω² = k/m.
    fn oscillators(elastic: &[f64]) -> Vibration {
        let chain = |&k: &f64| Chain::new(vec![element(1.0, -0.1, k); 2]).unwrap();
        Vibration {
            chains: elastic.iter().map(chain).collect(),
            hub: Hub::Fixed,
            damping: Damping { alpha: 0.5, beta: 0.0 },
            isotropic: true,
        }
    }

    fn critical(omega: f64, speed: f64) -> Critical {
        Critical { speed, eigenvalue: C64::new(0.0, omega), kind: Kind::Flutter, cable: 0 }
    }

    #[test]
    fn an_oscillator_shifts_as_its_formula_says() {
        let crossing = Crossing::new(&oscillators(&[4.0, 9.0]), &critical(2.0, 5.0)).expect("a simple crossing");
        // dv/dα = −m/c, dω/dα = 0.
        let shift = crossing.shift_by_damping(Damping { alpha: 1.0, beta: 0.0 });
        assert!((shift.speed - 10.0).abs() < 1e-12 && shift.omega.abs() < 1e-12, "{shift:?}");
        // With m ∂/∂m: dv = v, dω = −ω/2.
        let mut derivative = oscillators(&[0.0, 0.0]);
        for element in derivative.chains.iter_mut().flat_map(Chain::elements_mut) {
            element.transfer = Block::zeros();
        }
        let shift = crossing.shift(&derivative);
        assert!((shift.speed - 5.0).abs() < 1e-12 && (shift.omega + 1.0).abs() < 1e-12, "{shift:?}");
    }

    #[test]
    fn what_has_no_derivative_is_told() {
        let reason = |elastic: &[f64], omega, speed| {
            Crossing::new(&oscillators(elastic), &critical(omega, speed)).map(|_| ()).expect_err("no derivative")
        };
        assert_eq!(reason(&[4.0, 4.0], 2.0, 5.0), NoSensitivity::NotSimple);
        assert_eq!(reason(&[4.0, 4.0 * (1.0 + 1e-8)], 2.0, 5.0), NoSensitivity::NotSimple);
        assert_eq!(reason(&[4.0, 9.0], 2.1, 5.0), NoSensitivity::NotSimple);
        // Three times as far away as counts.
        let beside = oscillators(&[4.0, 4.0 * (1.0 + 6.0 * ALONE)]);
        assert!(Crossing::new(&beside, &critical(2.0, 5.0)).is_ok(), "alone");
        assert_eq!(reason(&[4.0, 9.0], 2.0, 0.0), NoSensitivity::FromRest);
        // Nothing depends on the speed.
        let mut still = oscillators(&[4.0, 9.0]);
        still.damping.alpha = 0.0;
        for element in still.chains.iter_mut().flat_map(Chain::elements_mut) {
            element.transfer = Block::zeros();
        }
        assert_eq!(Crossing::new(&still, &critical(2.0, 5.0)).err(), Some(NoSensitivity::NotTransversal));
    }
}
