//! One heavy cable on its mesh: its shape from the force at the platform and its length, and the equations that these
//! have to satisfy. For plain and dual numbers, so that one set of formulas serves Newton's method and all derivatives.

use num_dual::DualNum;

use super::parameters::Parameters;
use crate::mechanics::Material;
use crate::robot::{Robot, TensionLaw, Vec2};

/// What a cable's shape depends on besides (t₀, L).
#[derive(Clone, Copy, Debug)]
pub(super) struct CableModel<D> {
    pub material: Material<D>,
    pub elements: usize,
    /// Weight per unstretched length, N/m.
    pub weight: D,
    /// The winch point, in m.
    pub anchor: Vec2,
}

impl<D: DualNum<Primitive = f64> + Copy> CableModel<D> {
    /// Cable `i` of the robot.
    pub fn of(robot: &Robot, i: usize) -> Self {
        let Material { axial_stiffness, strain } = Material::of(robot, i);
        Self {
            material: Material { axial_stiffness: axial_stiffness.into(), strain },
            elements: robot.elements,
            weight: robot.weight_per_length(i).into(),
            anchor: robot.cables[i].anchor,
        }
    }

    /// The same with other `parameters`.
    pub fn with(robot: &Robot, parameters: &Parameters<D>, i: usize) -> Self {
        let cable = &parameters.cables[i];
        Self {
            material: Material { axial_stiffness: cable.axial_stiffness, strain: robot.material_of(i).strain },
            elements: robot.elements,
            weight: cable.mass_per_length * parameters.gravity,
            anchor: robot.cables[i].anchor,
        }
    }

    /// The same cable with its weight scaled.
    pub fn with_weight(self, part: f64) -> Self {
        Self { weight: self.weight * part, ..self }
    }

    /// Walks from the platform to the winch: calls `visit` with each element's force and outer node; gives the end.
    pub fn walk(&self, start: [D; 2], t0: [D; 2], length: D, mut visit: impl FnMut([D; 2], [D; 2])) -> [D; 2] {
        let l = length / self.elements as f64;
        let weight = l * self.weight;
        let (mut r, mut t) = (start, t0);
        for _ in 0..self.elements {
            let force = (t[0] * t[0] + t[1] * t[1]).sqrt();
            let reach = l * self.material.stretch(force) / force;
            r = [r[0] + reach * t[0], r[1] + reach * t[1]];
            visit(t, r);
            t[1] += weight;
        }
        r
    }

    /// By how much the cable's end misses its anchor, in m. The walk starts at zero, so that a platform near the anchor
    /// and far from the origin costs no digits.
    fn miss(&self, position: [D; 2], t0: [D; 2], length: D) -> [D; 2] {
        let end = self.walk([D::from(0.0); 2], t0, length, |_, _| {});
        [end[0] + (position[0] - self.anchor.x), end[1] + (position[1] - self.anchor.y)]
    }

    /// The force of the cable on the platform, t₀ − (0, μ g l/2).
    pub fn platform_force(&self, t0: [D; 2], length: D) -> [D; 2] {
        [t0[0], t0[1] - length * (self.weight * (0.5 / self.elements as f64))]
    }

    /// Residual of a prescribed cable with the unknowns (t₀, L): its end's distance from the anchor (m), and the
    /// excess of its tension at the platform (N).
    pub fn prescribed_residual(&self, position: [D; 2], tension: D, z: [D; 3]) -> [D; 3] {
        let [tx, ty, length] = z;
        let [dx, dy] = self.miss(position, [tx, ty], length);
        let [fx, fy] = self.platform_force([tx, ty], length);
        [dx, dy, (fx * fx + fy * fy).sqrt() - tension]
    }

    /// Residual of the `cables` at equilibrium with the unknowns (t₀, L) of each, N in all: the distances of the ends from
    /// their anchors (m), and the excess of their force on the platform over `load` (N).
    pub fn equilibrium_residual<const N: usize>(cables: &[Self], position: [D; 2], load: [D; 2], z: [D; N]) -> [D; N] {
        let mut residual = [D::from(0.0); N];
        let balance = 2 * cables.len();
        residual[balance] = -load[0];
        residual[balance + 1] = -load[1];
        for (i, cable) in cables.iter().enumerate() {
            let (t0, length) = ([z[3 * i], z[3 * i + 1]], z[3 * i + 2]);
            let miss = cable.miss(position, t0, length);
            let force = cable.platform_force(t0, length);
            for j in 0..2 {
                residual[2 * i + j] = miss[j];
                residual[balance + j] += force[j];
            }
        }
        residual
    }
}

/// The tension of a prescribed cable at `position`, in newtons.
pub(super) fn prescribed_tension<D: DualNum<Primitive = f64> + Copy>(law: TensionLaw, position: [D; 2]) -> D {
    match law {
        TensionLaw::Equilibrium => D::from(0.0),
        TensionLaw::Constant(tension) => D::from(tension),
        TensionLaw::Hypot { horizontal, vertical } => {
            let part = |c: [f64; 3]| position[0] * c[1] + position[1] * c[2] + c[0];
            let (h, v) = (part(horizontal), part(vertical));
            (h * h + v * v).sqrt()
        }
    }
}
