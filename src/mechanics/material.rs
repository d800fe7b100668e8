//! The axial law of a cable: axial force N against stretch λ.

use num_dual::DualNum;

use crate::robot::{Robot, Strain};

/// The axial law N(λ) of a cable, λ its stretched over its unstretched length.
///
/// - [`Strain::Green`], energy ½ EA ε² with ε = ½(λ² − 1): N = ½ EA (λ³ − λ)
/// - [`Strain::Engineering`], ε = λ − 1: N = EA (λ − 1)
///
/// For plain and dual numbers. Source: docs/theory.md section 4; Green's law is that of the paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material<D = f64> {
    /// EA in newtons, positive.
    pub(crate) axial_stiffness: D,
    pub(crate) strain: Strain,
}

impl Material {
    /// The material with the axial stiffness EA in newtons and that strain measure; `None` where EA is not positive and
    /// finite.
    pub const fn new(axial_stiffness: f64, strain: Strain) -> Option<Self> {
        if axial_stiffness > 0.0 && axial_stiffness.is_finite() { Some(Self { axial_stiffness, strain }) } else { None }
    }

    /// The axial law of a robot's cable (0-based).
    pub fn of(robot: &Robot, cable: usize) -> Self {
        let material = robot.material_of(cable);
        Self { axial_stiffness: material.axial_stiffness(), strain: material.strain }
    }
}

impl<D: DualNum<Primitive = f64> + Copy> Material<D> {
    /// N(λ) in newtons.
    pub fn force(&self, stretch: D) -> D {
        match self.strain {
            Strain::Green => self.axial_stiffness * 0.5 * stretch * (stretch - 1.0) * (stretch + 1.0),
            Strain::Engineering => self.axial_stiffness * (stretch - 1.0),
        }
    }

    /// N'(λ) in newtons.
    pub fn tangent(&self, stretch: D) -> D {
        match self.strain {
            Strain::Green => self.axial_stiffness * 0.5 * (stretch * stretch * 3.0 - 1.0),
            Strain::Engineering => self.axial_stiffness,
        }
    }

    /// N''(λ) in newtons.
    pub fn curvature(&self, stretch: D) -> D {
        match self.strain {
            Strain::Green => self.axial_stiffness * 3.0 * stretch,
            Strain::Engineering => D::from(0.0),
        }
    }

    /// The stretch λ ≥ 1 at the axial force N ≥ 0, the inverse of [`Self::force`].
    ///
    /// Exact to rounding, with all derivatives that `D` carries.
    pub fn stretch(&self, force: D) -> D {
        match self.strain {
            Strain::Engineering => force / self.axial_stiffness + 1.0,
            Strain::Green => {
                let y = force * (self.axial_stiffness.recip() * 2.0);
                let mut x = D::from(green_stretch(y.re()));
                // The real part is exact; each Newton step makes one more order of derivatives exact.
                for _ in 0..D::NDERIV {
                    x -= (x * x * x - x - y) / (x * x * 3.0 - 1.0);
                }
                x
            }
        }
    }
}

/// The root x ≥ 1 of x³ − x = y, y ≥ 0.
fn green_stretch(y: f64) -> f64 {
    // Right of the root on a convex function Newton's method falls monotonically, so it stops by itself.
    // The first of these is the smaller one up to y = √8, and roots take time.
    let mut x = 1.0 + if y < 2.5 { 0.5 * y } else { (0.5 * y).min(y.cbrt()) };
    loop {
        let next = x - (x * (x - 1.0) * (x + 1.0) - y) / (3.0 * x * x - 1.0);
        if next >= x || next.is_nan() {
            return x;
        }
        x = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::second_derivative;

    #[test]
    fn stretch_inverts_force_over_fourteen_decades() {
        for strain in [Strain::Green, Strain::Engineering] {
            let material = Material { axial_stiffness: 6250.0, strain };
            for exponent in -6..8 {
                let force = 10.0_f64.powi(exponent);
                let stretch = material.stretch(force);
                // N loses digits where λ − 1 does: the allowance is one rounding of λ times N'(λ).
                let allowed = 4.0 * f64::EPSILON * stretch * material.tangent(stretch);
                let error = (material.force(stretch) - force).abs();
                assert!(error <= allowed, "{strain:?} N = {force}: error {error} > {allowed}");
            }
        }
    }

    #[test]
    fn derivatives_of_stretch_are_those_of_the_inverse_function() {
        let material = Material { axial_stiffness: 6250.0, strain: Strain::Green };
        let dual = Material { axial_stiffness: material.axial_stiffness.into(), strain: material.strain };
        let (stretch, first, second): (f64, f64, f64) = second_derivative(|n| dual.stretch(n), 170.0);
        let tangent = material.tangent(stretch);
        let curvature = material.curvature(stretch);
        assert!((curvature / (3.0 * material.axial_stiffness * stretch) - 1.0).abs() < 1e-15);
        assert!((first * tangent - 1.0).abs() < 1e-13, "{first} × {tangent}");
        assert!((second * tangent.powi(3) / curvature + 1.0).abs() < 1e-12, "{second}");
    }
}
