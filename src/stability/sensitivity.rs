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
use num_dual::{Dual64, DualNum};

use super::modes::{Displacement, frequency_scale, left_shape};
use crate::mechanics::{Element, Matrices, Vibration};
use crate::robot::Damping;
use crate::stability::{Characteristic, Critical, Polarisation, mode};

type C64 = Complex<f64>;

/// Within this part of |λ| an eigenvalue must be alone to count as simple.
const ALONE: f64 = 1e-6;
/// The eigenvalues inside a circle are counted by its values at this many points.
const CIRCLE: u32 = 8;
/// The count of a single eigenvalue differs from 1 by less than this.
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
        let right = mode(vibration, speed, lambda, Polarisation::default()).displacement;
        let left = left_shape(vibration, speed, lambda, Polarisation::default());
        let forms = Forms::of(vibration, &left, &right, |mass| mass, Element::matrices);
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

    /// The shift per unit of a parameter, given the problem in dual numbers along it: [`Vibration::along`]. α and β are
    /// unchanged.
    pub fn shift(&self, along: &Vibration<Dual64>) -> Shift {
        let forms = Forms::of(along, &self.left, &self.right, |mass| mass.eps, Element::derivatives);
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

    /// The shift per unit of a parameter p, given `form` = yᵀ `Q_p` x.
    fn shift_by(&self, form: C64) -> Shift {
        let by_parameter = -form / self.by_lambda;
        let speed = -by_parameter.re / self.slope.re;
        Shift { speed, omega: (by_parameter + self.slope * speed).im }
    }
}

impl Forms {
    /// Of `vibration` with two shapes; `platform` and `element` tell which matrices are meant.
    fn of<D: DualNum<Primitive = f64> + Copy>(
        vibration: &Vibration<D>,
        left: &[Vec<Displacement>],
        right: &[Vec<Displacement>],
        platform: impl Fn(D) -> f64,
        matrices: impl Fn(&Element<D>) -> Matrices,
    ) -> Self {
        let mut forms = Self::default();
        if let (Some(mass), [left, ..], [right, ..]) = (vibration.hub.platform_mass(), left, right) {
            forms.mass = left[0].dot(&right[0]) * platform(mass);
        }
        for (chain, (left, right)) in vibration.chains.iter().zip(left.iter().zip(right)) {
            for (element, (y, x)) in chain.elements().iter().zip(left.windows(2).zip(right.windows(2))) {
                let Matrices { mass, transfer, flow, elastic } = matrices(element);
                let products = Matrix2::from_fn(|i, j| y[i].dot(&x[j]));
                let form = |block: &Matrix2<f64>| products.zip_map(block, |product, entry| product * entry).sum();
                forms.mass += form(&mass);
                forms.transfer += form(&transfer);
                forms.flow += form(&flow);
                forms.elastic += (y[0] - y[1]).dot(&(elastic.map(C64::from) * (x[0] - x[1])));
            }
        }
        forms
    }
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
    use crate::mechanics::{Chain, Hub, Stiffness};
    use crate::robot::Vec2;
    use crate::stability::Instability;

    /// An element of two that hold one node between fixed ends. Together they give it the mass 2m, C = 2c and the stiffness
    /// 2k; D is zero, since the rate of the inflow makes up for its square.
    fn element<D: DualNum<Primitive = f64> + Copy>(m: D, c: D, k: D) -> Element<D> {
        let (l, still) = (D::from(0.5), D::from(0.0));
        let mu = m / l * 3.0;
        // On both diagonals together C has μ (w₁ − w₀)/3, and D has μ (ẇ₁ − ẇ₀)/6 − 2 μ w₁²/(3 l), for w₀ = 0.
        let inflow = c / mu * 6.0;
        let rate = inflow * inflow / l * 4.0;
        let direction = Vec2::new(1.0, 0.0).map(D::from);
        let stiffness = Stiffness { direction, along: k * l, across: k * l };
        Element::at_rest(mu, l, stiffness).with_inflow([still, inflow], [still, rate])
    }

    /// Such nodes do not know of each other. They are single oscillators 2m q̈ + (2 v c + 2 α m) q̇ + 2k q = 0, which lose
    /// stability at v = −α m/c with ω² = k/m, given m, c < 0 and several k.
    fn oscillators<D: DualNum<Primitive = f64> + Copy>(m: D, c: D, elastic: &[D]) -> Vibration<D> {
        let chain = |&k: &D| Chain::new(vec![element(m, c, k); 2]).unwrap();
        Vibration {
            chains: elastic.iter().map(chain).collect(),
            hub: Hub::fixed(elastic.len()),
            damping: Damping { alpha: 0.5, beta: 0.0 },
            isotropic: true,
        }
    }

    fn plain(elastic: &[f64]) -> Vibration {
        oscillators(1.0, -0.1, elastic)
    }

    fn critical(omega: f64, speed: f64) -> Critical {
        Critical { speed, eigenvalue: C64::new(0.0, omega), kind: Instability::Flutter, cable: 0 }
    }

    #[test]
    fn an_oscillator_shifts_as_its_formula_says() {
        let crossing = Crossing::new(&plain(&[4.0, 9.0]), &critical(2.0, 5.0)).expect("a simple crossing");
        // dv/dα = −m/c, dω/dα = 0.
        let shift = crossing.shift_by_damping(Damping { alpha: 1.0, beta: 0.0 });
        assert!((shift.speed - 10.0).abs() < 1e-12 && shift.omega.abs() < 1e-12, "{shift:?}");
        // With m ∂/∂m: dv = v, dω = −ω/2.
        let along = oscillators(Dual64::new(1.0, 1.0), Dual64::from(-0.1), &[4.0, 9.0].map(Dual64::from));
        let shift = crossing.shift(&along);
        assert!((shift.speed - 5.0).abs() < 1e-12 && (shift.omega + 1.0).abs() < 1e-12, "{shift:?}");
    }

    #[test]
    fn what_has_no_derivative_is_told() {
        let reason = |elastic: &[f64], omega, speed| {
            Crossing::new(&plain(elastic), &critical(omega, speed)).map(|_| ()).expect_err("no derivative")
        };
        assert_eq!(reason(&[4.0, 4.0], 2.0, 5.0), NoSensitivity::NotSimple);
        assert_eq!(reason(&[4.0, 4.0 * (1.0 + 1e-8)], 2.0, 5.0), NoSensitivity::NotSimple);
        assert_eq!(reason(&[4.0, 9.0], 2.1, 5.0), NoSensitivity::NotSimple);
        // Three times as far away as counts.
        let beside = plain(&[4.0, 4.0 * (1.0 + 6.0 * ALONE)]);
        assert!(Crossing::new(&beside, &critical(2.0, 5.0)).is_ok(), "alone");
        assert_eq!(reason(&[4.0, 9.0], 2.0, 0.0), NoSensitivity::FromRest);
        // Nothing depends on the speed.
        let mut still = plain(&[4.0, 9.0]);
        still.damping.alpha = 0.0;
        for element in still.chains.iter_mut().flat_map(Chain::elements_mut) {
            *element = element.with_inflow([0.0; 2], [0.0; 2]);
        }
        assert_eq!(Crossing::new(&still, &critical(2.0, 5.0)).err(), Some(NoSensitivity::NotTransversal));
    }
}
