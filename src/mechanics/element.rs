//! The variable-length cable element: a length l of cable between two nodes that slide along the material.
//!
//! w(ξ) = w₀ + (w₁ − w₀) ξ is the rate, in unstretched metres per second, at which material moves along the
//! element's coordinate ξ ∈ [0, 1], times l. In a cable of n elements paid out uniformly, w₀ = −k l̇ and
//! w₁ = −(k+1) l̇ for element k. Equal constant w₀ = w₁ is the travelling string. Every matrix here acts on x and y
//! alike (⊗ I₂) but the elastic one. All are for plain and dual numbers.
//!
//! An element keeps the causes. Its matrices follow from them.
//!
//! Source: docs/theory.md section 4, after Du, Cui, Bao and Qiu (2015).

use nalgebra::{Matrix2, Vector2};
use num_dual::{Dual64, DualNum};

use crate::mechanics::Material;
use crate::robot::Linearisation;

/// How an element resists a displacement of one of its ends: A = across I₂ + (along − across) e eᵀ, in newtons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness<D = f64> {
    /// The element's direction e, a unit vector.
    pub direction: Vector2<D>,
    /// A's eigenvalue along e, in N: N'(λ) by the tangent, N/λ by the secant.
    pub along: D,
    /// A's eigenvalue across e, in N: N/λ.
    pub across: D,
}

impl<D: DualNum<Primitive = f64> + Copy> Stiffness<D> {
    /// That of an element of `material` which carries the `force` (N, not zero). Paper's Eqs. 14 and 15.
    pub fn new(material: Material<D>, linearisation: Linearisation, force: Vector2<D>) -> Self {
        let tension = (force.x * force.x + force.y * force.y).sqrt();
        let stretch = material.stretch(tension);
        let across = tension / stretch;
        let along = match linearisation {
            Linearisation::Secant => across,
            Linearisation::Tangent => material.tangent(stretch),
        };
        Self { direction: force / tension, along, across }
    }

    /// A in newtons, over x and y.
    pub fn matrix(&self) -> Matrix2<D> {
        let e = self.direction;
        Matrix2::from_diagonal_element(self.across) + e * e.transpose() * (self.along - self.across)
    }
}

/// A cable element at a speed of the platform of v = 1 m/s.
///
/// Its inflow grows with the speed v, and the rate of its inflow with v². Where the platform also accelerates at a, the
/// rate is v² `inflow_rate` + a `inflow`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element<D = f64> {
    /// μ in kg/m.
    pub mass_per_length: D,
    /// l in m, unstretched.
    pub length: D,
    /// w₀ and w₁ at v = 1 m/s, in m/s: the first derivative of the cable's length along the motion is in them.
    pub inflow: [D; 2],
    /// ẇ₀ and ẇ₁ at v = 1 m/s and without acceleration, in m/s²: the second derivative of the length.
    pub inflow_rate: [D; 2],
    /// Of the element per unit strain: divide by l for that between its ends.
    pub stiffness: Stiffness<D>,
}

impl<D: DualNum<Primitive = f64> + Copy> Element<D> {
    /// An element of a cable whose material does not move, for μ in kg/m and l in m.
    pub fn at_rest(mass_per_length: D, length: D, stiffness: Stiffness<D>) -> Self {
        let still = [D::from(0.0); 2];
        Self { mass_per_length, length, inflow: still, inflow_rate: still, stiffness }
    }

    /// The same element with material that moves, `inflow` in m/s and its rate in m/s².
    #[must_use]
    pub fn with_inflow(self, inflow: [D; 2], inflow_rate: [D; 2]) -> Self {
        Self { inflow, inflow_rate, ..self }
    }

    /// μ l in kg.
    pub fn total_mass(&self) -> D {
        self.mass_per_length * self.length
    }

    /// M = μ l [[1/3, 1/6], [1/6, 1/3]] over the two nodes, in kg.
    pub fn mass(&self) -> Matrix2<D> {
        let [third, sixth] = [3.0, 6.0].map(|part| self.total_mass() / part);
        Matrix2::new(third, sixth, sixth, third)
    }

    /// The "energy transfer" matrix C = 2 μ [[−a, a], [−b, b]] over the two nodes, with a = w₀/3 + w₁/6 and
    /// b = w₀/6 + w₁/3, in kg/s.
    pub fn transfer(&self) -> Matrix2<D> {
        convection(self.mass_per_length * 2.0, self.inflow)
    }

    /// `K_dyn` = μ [[−a', a'], [−b', b']] − (μ/l) (w₀² + w₀ w₁ + w₁²)/3 [[1, −1], [−1, 1]] over the two nodes, in N/m;
    /// a' and b' are made of the rates ẇ₀ and ẇ₁ as a and b of [`Self::transfer`] are made of w₀ and w₁.
    pub fn flow_stiffness(&self) -> Matrix2<D> {
        let [w0, w1] = self.inflow;
        let square = self.mass_per_length / self.length * (w0 * w0 + w0 * w1 + w1 * w1) / 3.0;
        convection(self.mass_per_length, self.inflow_rate) - Matrix2::new(square, -square, -square, square)
    }

    /// A/l of the elastic stiffness K = [[A, −A], [−A, A]]/l, in N/m, over x and y.
    pub fn elastic(&self) -> Matrix2<D> {
        self.stiffness.matrix() / self.length
    }

    /// The eigenvalues of [`Self::elastic`] in N/m, along the element and across it.
    pub fn springs(&self) -> [D; 2] {
        [self.stiffness.along / self.length, self.stiffness.across / self.length]
    }
}

/// The matrices of an element, or their derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrices {
    /// M over the two nodes, in kg.
    pub mass: Matrix2<f64>,
    /// C at v = 1 m/s over the two nodes.
    pub transfer: Matrix2<f64>,
    /// `K_dyn` at v = 1 m/s over the two nodes.
    pub flow: Matrix2<f64>,
    /// A/l over x and y, in N/m.
    pub elastic: Matrix2<f64>,
}

impl Element {
    /// All matrices of the element.
    pub fn matrices(&self) -> Matrices {
        self.each_matrix(|entry| entry)
    }
}

impl Element<Dual64> {
    /// What the parameter, along which the dual numbers are, changes in the matrices.
    pub fn derivatives(&self) -> Matrices {
        self.each_matrix(|entry| entry.eps)
    }
}

impl<D: DualNum<Primitive = f64> + Copy> Element<D> {
    fn each_matrix(&self, part: impl Fn(D) -> f64) -> Matrices {
        Matrices {
            mass: self.mass().map(&part),
            transfer: self.transfer().map(&part),
            flow: self.flow_stiffness().map(&part),
            elastic: self.elastic().map(&part),
        }
    }
}

fn convection<D: DualNum<Primitive = f64> + Copy>(mu: D, w: [D; 2]) -> Matrix2<D> {
    let a = mu * (w[0] / 3.0 + w[1] / 6.0);
    let b = mu * (w[0] / 6.0 + w[1] / 3.0);
    Matrix2::new(-a, a, -b, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Strain, Vec2};
    use proptest::prelude::*;

    /// An element whose elastic stiffness does not matter.
    fn element(mu: f64, l: f64) -> Element {
        Element::at_rest(mu, l, Stiffness { direction: Vec2::x(), along: 1.0, across: 1.0 })
    }

    proptest! {
        /// `K_dyn` · 1 = 0: a translation of the whole element meets no force.
        #[test]
        fn flow_stiffness_annihilates_translation(mu in 0.01..10.0, l in 0.01..10.0, w0 in -20.0..20.0, w1 in -20.0..20.0,
                                                  dw0 in -20.0..20.0, dw1 in -20.0..20.0) {
            let k = element(mu, l).with_inflow([w0, w1], [dw0, dw1]).flow_stiffness();
            let force = k * Vector2::new(1.0, 1.0);
            prop_assert!(force.amax() <= 1e-15 * k.amax(), "{force}");
        }

        /// Material at rest (`q_k` = S, its rates k l̇ and k l̈) gives no force on any row but the winch's.
        #[test]
        fn material_at_rest_feels_nothing(mu in 0.01..10.0, l in 0.01..10.0, rate in -20.0..20.0, curvature in -20.0..20.0, n in 2_usize..12) {
            let mut force = vec![0.0; n + 1];
            let mut size = 0.0_f64;
            for k in 0..n {
                let at = |value: f64| Vector2::new(k as f64 * value, (k + 1) as f64 * value);
                let w = |value: f64| [-(k as f64) * value, -((k + 1) as f64) * value];
                let element = element(mu, l).with_inflow(w(rate), w(curvature));
                let parts =
                    [element.mass() * at(curvature), element.transfer() * at(rate), element.flow_stiffness() * at(l)];
                for part in parts {
                    size = size.max(part.amax());
                    force[k] += part.x;
                    force[k + 1] += part.y;
                }
            }
            for (k, f) in force[..n].iter().enumerate() {
                prop_assert!(f.abs() <= 1e-14 * size, "row {k}: {f} of {size}");
            }
        }

        /// The tangent stiffness is the derivative of the element's force with respect to its end.
        #[test]
        fn tangent_is_the_derivative_of_the_force(tx in -300.0..300.0, ty in 20.0..300.0, l in 0.1..3.0, green in any::<bool>()) {
            let strain = if green { Strain::Green } else { Strain::Engineering };
            let material = Material { axial_stiffness: 6250.0, strain };
            let t = Vec2::new(tx, ty);
            let span = t.normalize() * (material.stretch(t.norm()) * l);
            let force = |d: Vec2| d.normalize() * material.force(d.norm() / l);
            let k = Element::at_rest(0.4, l, Stiffness::new(material, Linearisation::Tangent, t)).elastic();
            let h = 1e-5 * l;
            for step in [Vec2::x(), Vec2::y()] {
                let slope = (force(span + step * h) - force(span - step * h)) / (2.0 * h);
                // Central differences: h² of the curvature plus rounding over h.
                prop_assert!((slope - k * step).amax() < 1e-7 * k.amax(), "{slope} {}", k * step);
            }
        }

        /// The eigenvalues of A/l are those that are kept, along the element and across it.
        #[test]
        fn springs_are_the_eigenvalues_of_the_elastic_stiffness(angle in 0.0..7.0, along in 1.0..1e4, across in 1.0..1e3, l in 0.1..3.0) {
            let direction = Vec2::new(f64::cos(angle), f64::sin(angle));
            let element = Element::at_rest(0.4, l, Stiffness { direction, along, across });
            let [along, across] = element.springs();
            let normal = Vec2::new(-direction.y, direction.x);
            let k = element.elastic();
            let off = (k * direction - direction * along).amax().max((k * normal - normal * across).amax());
            prop_assert!(off <= 1e-14 * along.max(across), "{k} {along} {across}");
        }
    }
}
