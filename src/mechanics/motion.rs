//! Quasi-static motion: how fast the unstretched lengths change as the platform moves along a line.
//!
//! p(σ) = p₀ + σ d. The statics F(z, σ) = 0 define z(σ), so J z' = −∂F/∂σ, and J z'' = −(the second derivative of
//! F along z₀ + z' σ). Both right sides come from one evaluation of F in second-order dual numbers each, the tension
//! law and the coupling of the cables through the platform included. docs/theory.md section 6.

use nalgebra::{Const, SVector, ToTypenum};
use num_dual::{Dual2_64, DualSVec64, jacobian};

use super::statics::{CableModel, prescribed_tension};
use crate::mechanics::Statics;
use crate::robot::{Robot, Vec2};

/// The unstretched length's first and second derivative along the motion: L̇ = v L', L̈ = v² L'' at speed v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthRates {
    /// L' = dL/dσ, dimensionless: positive where cable is paid out.
    pub first: f64,
    /// L'' = d²L/dσ², in 1/m.
    pub second: f64,
}

/// L' and L'' of every cable for a motion along the unit vector `direction` through the pose of `statics`.
///
/// Exact (implicit differentiation), not finite differences. `None` where the pose is singular.
pub fn length_rates(robot: &Robot, statics: &Statics, direction: Vec2) -> Option<Vec<LengthRates>> {
    let cable = CableModel::of(robot);
    let along = |j: usize| Dual2_64::new(statics.position[j], direction[j], 0.0);
    let position = [along(0), along(1)];
    let mut rates = vec![LengthRates { first: 0.0, second: 0.0 }; robot.cables.len()];
    let mut load = [Dual2_64::from(0.0), Dual2_64::from(robot.platform_mass * robot.gravity)];

    for i in robot.prescribed() {
        let (anchor, law) = (robot.cables[i].anchor, robot.cables[i].tension);
        let shape = &statics.cables[i];
        let z = follow(
            SVector::from([shape.t0.x, shape.t0.y, shape.length]),
            |z| {
                let fixed = position.map(|p| DualSVec64::from(p.re));
                let tension = prescribed_tension(law, fixed);
                SVector::from(cable.prescribed_residual(fixed, anchor, tension, z.into()))
            },
            |z| {
                let tension = prescribed_tension(law, position);
                SVector::from(cable.prescribed_residual(position, anchor, tension, z.into()))
            },
        )?;
        rates[i] = LengthRates { first: z[2].v1, second: z[2].v2 };
        let force = cable.platform_force([z[0], z[1]], z[2]);
        load = [load[0] - force[0], load[1] - force[1]];
    }

    let pair = robot.pair();
    let anchors = pair.map(|i| robot.cables[i].anchor);
    let [a, b] = pair.map(|i| &statics.cables[i]);
    let z = follow(
        SVector::from([a.t0.x, a.t0.y, a.length, b.t0.x, b.t0.y, b.length]),
        |z| {
            let fixed = |v: [Dual2_64; 2]| v.map(|c| DualSVec64::from(c.re));
            SVector::from(cable.pair_residual(fixed(position), anchors, fixed(load), z.into()))
        },
        |z| SVector::from(cable.pair_residual(position, anchors, load, z.into())),
    )?;
    for (i, k) in pair.into_iter().zip([2, 5]) {
        rates[i] = LengthRates { first: z[k].v1, second: z[k].v2 };
    }
    rates.iter().all(|r| r.first.is_finite() && r.second.is_finite()).then_some(rates)
}

/// z(σ) to second order around the solution `z`, given F over z at σ = 0 and F over z(σ).
fn follow<const N: usize>(
    z: SVector<f64, N>,
    over_unknowns: impl Fn(SVector<DualSVec64<N>, N>) -> SVector<DualSVec64<N>, N>,
    along_motion: impl Fn(SVector<Dual2_64, N>) -> SVector<Dual2_64, N>,
) -> Option<SVector<Dual2_64, N>>
where
    Const<N>: ToTypenum + nalgebra::DimMin<Const<N>, Output = Const<N>>,
{
    let lu = jacobian(over_unknowns, &z).1.lu();
    let mut path = z.map(Dual2_64::from_re);
    let first = lu.solve(&along_motion(path).map(|f| -f.v1))?;
    path.zip_apply(&first, |p, d| p.v1 = d);
    let second = lu.solve(&along_motion(path).map(|f| -f.v2))?;
    path.zip_apply(&second, |p, d| p.v2 = d);
    Some(path)
}
