//! The variable-length cable element: a length l of cable between two nodes that slide along the material.
//!
//! w(ξ) = w₀ + (w₁ − w₀) ξ is the rate, in unstretched metres per second, at which material moves along the
//! element's coordinate ξ ∈ [0, 1], times l. In a cable of n elements paid out uniformly, w₀ = −k l̇ and
//! w₁ = −(k+1) l̇ for element k. Equal constant w₀ = w₁ is the travelling string. Every matrix here acts on x and y
//! alike (⊗ I₂) but the elastic one. All are for plain and dual numbers.
//!
//! Source: docs/theory.md section 4, after Du, Cui, Bao and Qiu (2015).

use nalgebra::{Matrix2, Vector2};
use num_dual::DualNum;

use crate::mechanics::Material;
use crate::robot::Linearisation;

/// A 2 × 2 matrix over the element's two nodes, rows first.
pub type Block = Matrix2<f64>;

/// M = μ l [[1/3, 1/6], [1/6, 1/3]], in kg, for μ in kg/m and l in m.
pub fn mass<D: DualNum<Primitive = f64> + Copy>(mu: D, l: D) -> Matrix2<D> {
    let [third, sixth] = [3.0, 6.0].map(|part| mu * l / part);
    Matrix2::new(third, sixth, sixth, third)
}

/// The "energy transfer" matrix C = 2 μ [[−a, a], [−b, b]], in kg/s, with a = w₀/3 + w₁/6 and b = w₀/6 + w₁/3.
pub fn transfer<D: DualNum<Primitive = f64> + Copy>(mu: D, w: [D; 2]) -> Matrix2<D> {
    convection(mu * 2.0, w)
}

/// `K_dyn` = μ [[−a', a'], [−b', b']] − (μ/l) (w₀² + w₀ w₁ + w₁²)/3 [[1, −1], [−1, 1]], in N/m, with a' and b' made of
/// the rates ẇ₀ and ẇ₁ as a and b of [`transfer`] are made of w₀ and w₁.
pub fn flow_stiffness<D: DualNum<Primitive = f64> + Copy>(mu: D, l: D, w: [D; 2], w_rate: [D; 2]) -> Matrix2<D> {
    let square = mu / l * (w[0] * w[0] + w[0] * w[1] + w[1] * w[1]) / 3.0;
    convection(mu, w_rate) - Matrix2::new(square, -square, -square, square)
}

fn convection<D: DualNum<Primitive = f64> + Copy>(mu: D, w: [D; 2]) -> Matrix2<D> {
    let a = mu * (w[0] / 3.0 + w[1] / 6.0);
    let b = mu * (w[0] / 6.0 + w[1] / 3.0);
    Matrix2::new(-a, a, -b, b)
}

/// A/l of the elastic stiffness [[A, −A], [−A, A]]/l, in N/m, over x and y, for an element of unstretched length l
/// that carries the force t (N, not zero).
///
/// Tangent: A = (N/λ)(I − e eᵀ) + N'(λ) e eᵀ with e = t/N. Secant: A = (N/λ) I. Paper's Eqs. 14 and 15.
pub fn elastic<D: DualNum<Primitive = f64> + Copy>(
    material: Material<D>,
    linearisation: Linearisation,
    l: D,
    t: Vector2<D>,
) -> Matrix2<D> {
    let force = (t.x * t.x + t.y * t.y).sqrt();
    let stretch = material.stretch(force);
    let across = force / stretch;
    let secant = Matrix2::from_diagonal_element(across);
    let a = match linearisation {
        Linearisation::Secant => secant,
        Linearisation::Tangent => {
            let e = t / force;
            secant + e * e.transpose() * (material.tangent(stretch) - across)
        }
    };
    a / l
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Strain, Vec2};
    use proptest::prelude::*;

    proptest! {
        /// `K_dyn` · 1 = 0: a translation of the whole element meets no force.
        #[test]
        fn flow_stiffness_annihilates_translation(mu in 0.01..10.0, l in 0.01..10.0, w0 in -20.0..20.0, w1 in -20.0..20.0,
                                                  dw0 in -20.0..20.0, dw1 in -20.0..20.0) {
            let k = flow_stiffness(mu, l, [w0, w1], [dw0, dw1]);
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
                let parts = [
                    mass(mu, l) * at(curvature),
                    transfer(mu, w(rate)) * at(rate),
                    flow_stiffness(mu, l, w(rate), w(curvature)) * at(l),
                ];
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
            let k = elastic(material, Linearisation::Tangent, l, t);
            let h = 1e-5 * l;
            for step in [Vec2::x(), Vec2::y()] {
                let slope = (force(span + step * h) - force(span - step * h)) / (2.0 * h);
                // Central differences: h² of the curvature plus rounding over h.
                prop_assert!((slope - k * step).amax() < 1e-7 * k.amax(), "{slope} {}", k * step);
            }
        }
    }
}
