//! Quasi-static motion: how fast the unstretched lengths change as the platform moves along a line.
//!
//! p(σ) = p₀ + σ d. The statics F(z, σ) = 0 define z(σ), so J z' = −∂F/∂σ, and J z'' = −(the second derivative of
//! F along z₀ + z' σ). Both right sides come from one evaluation of F in second-order dual numbers each, the tension
//! law and the coupling of the cables through the platform included. docs/theory.md section 6. The same in dual numbers
//! of dual numbers gives what a parameter of the robot changes in z, z' and z'' (section 12).

use nalgebra::{Const, SVector, ToTypenum};
use num_dual::{Dual2, DualNum, DualSVec64, DualStruct, jacobian};

use super::cable::{CableModel, prescribed_tension};
use super::parameters::Parameters;
use super::statics::POINT;
use crate::mechanics::{CableShape, Statics};
use crate::robot::{Robot, Vec2};

/// The unstretched length's first and second derivative along the motion: L̇ = v L', L̈ = v² L'' at speed v.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthRates<D = f64> {
    /// L' = dL/dσ, dimensionless: positive where cable is paid out.
    pub first: D,
    /// L'' = d²L/dσ², in 1/m.
    pub second: D,
}

/// L' and L'' of every cable for a motion along the unit vector `direction` through the pose of `statics`.
///
/// Exact (implicit differentiation), not finite differences. `None` where the pose is singular.
pub fn length_rates(robot: &Robot, statics: &Statics, direction: Vec2) -> Option<Vec<LengthRates>> {
    length_rates_on(robot, statics, direction, Vec2::zeros())
}

/// The same for a motion on a curve p with the derivatives `first` = p' and `second` = p''.
///
/// With the unit tangent and the curvature vector of a path these are L' and L'' in its arc length; with velocity and
/// acceleration L̇ and L̈.
pub fn length_rates_on(robot: &Robot, statics: &Statics, first: Vec2, second: Vec2) -> Option<Vec<LengthRates>> {
    let paths = paths::<f64>(robot, &Parameters::of(robot), statics, first, second)?;
    let rates: Vec<_> = paths.iter().map(|[_, _, l]| LengthRates { first: l.v1, second: l.v2 }).collect();
    rates.iter().all(|r| r.first.is_finite() && r.second.is_finite()).then_some(rates)
}

/// How every node moves quasi-statically: its first and second derivative, for p' = `first` and p'' = `second` as in
/// [`length_rates_on`]; of the n + 1 nodes of each cable, from the platform to the winch. `None` where the pose is singular.
pub fn node_rates(robot: &Robot, statics: &Statics, first: Vec2, second: Vec2) -> Option<Vec<Vec<[Vec2; 2]>>> {
    let paths = paths::<f64>(robot, &Parameters::of(robot), statics, first, second)?;
    let start = [0, 1].map(|j| Dual2::new(statics.position[j], first[j], second[j]));
    let of_cable = |(i, [tx, ty, length]): (usize, &[Dual2<f64>; 3])| {
        let rates = |r: [Dual2<f64>; 2]| [Vec2::new(r[0].v1, r[1].v1), Vec2::new(r[0].v2, r[1].v2)];
        let mut nodes = vec![rates(start)];
        CableModel::of(robot, i).walk(start, [*tx, *ty], *length, |_, r| nodes.push(rates(r)));
        nodes
    };
    Some(paths.iter().enumerate().map(of_cable).collect())
}

/// (t₀, L) of every cable to second order along the motion with p' = `first` and p'' = `second`, and to the order of `D` in
/// the `parameters`. The real parts of the parameters are those of `robot`. `None` where the pose is singular.
pub(super) fn paths<D: DualNum<Primitive = f64> + Copy>(
    robot: &Robot,
    parameters: &Parameters<D>,
    statics: &Statics,
    first: Vec2,
    second: Vec2,
) -> Option<Vec<[Dual2<D>; 3]>> {
    let fixed = statics.position;
    let parameters = parameters.map(Dual2::from_re);
    let position = [0, 1].map(|j| Dual2::new(fixed[j].into(), first[j].into(), second[j].into()));
    let mut paths = vec![[Dual2::from(0.0); 3]; robot.cables.len()];
    let mut load = [Dual2::from(0.0), parameters.platform_mass * parameters.gravity];

    for i in robot.prescribed() {
        let (cable, law) = (CableModel::with(robot, &parameters, i), robot.cables[i].tension);
        let shape = statics.cables.get(i)?;
        let path = follow(
            SVector::from([shape.t0.x, shape.t0.y, shape.length]),
            |z| {
                let fixed = [fixed.x.into(), fixed.y.into()];
                let tension = prescribed_tension(law, fixed);
                SVector::from(CableModel::of(robot, i).prescribed_residual(fixed, tension, z.into()))
            },
            |z| {
                let tension = prescribed_tension(law, position) * parameters.cables[i].tension;
                SVector::from(cable.prescribed_residual(position, tension, z.into()))
            },
        )?;
        paths[i] = path.into();
        let force = cable.platform_force([path[0], path[1]], path[2]);
        load = [load[0] - force[0], load[1] - force[1]];
    }

    let cables = robot.equilibrium();
    let shapes: Vec<&CableShape> = cables.iter().filter_map(|&i| statics.cables.get(i)).collect();
    let unknowns: Vec<f64> = shapes.iter().flat_map(|shape| [shape.t0.x, shape.t0.y, shape.length]).collect();
    let of_unknowns: Vec<_> = cables.iter().map(|&i| CableModel::of(robot, i)).collect();
    let of_all: Vec<_> = cables.iter().map(|&i| CableModel::with(robot, &parameters, i)).collect();
    let path: [_; POINT] = follow(
        SVector::from(<[f64; POINT]>::try_from(unknowns).ok()?),
        |z| {
            let (fixed, load) = ([fixed.x.into(), fixed.y.into()], load.map(|force| force.re().into()));
            SVector::from(CableModel::equilibrium_residual::<POINT>(&of_unknowns, fixed, load, z.into()))
        },
        |z| SVector::from(CableModel::equilibrium_residual::<POINT>(&of_all, position, load, z.into())),
    )?
    .into();
    for (&i, path) in cables.iter().zip(path.chunks_exact(3)) {
        paths[i].copy_from_slice(path);
    }
    Some(paths)
}

/// The solution of F(z) = 0 in the dual numbers `T`, from its real parts `z`, given F over the unknowns alone and F with
/// all that varies. Each Newton step with the real Jacobian makes one more order of the derivatives exact.
fn follow<T: DualNum<Primitive = f64> + Copy, const N: usize>(
    z: SVector<f64, N>,
    over_unknowns: impl Fn(SVector<DualSVec64<N>, N>) -> SVector<DualSVec64<N>, N>,
    residual: impl Fn(SVector<T, N>) -> SVector<T, N>,
) -> Option<SVector<T, N>>
where
    Const<N>: ToTypenum + nalgebra::DimMin<Const<N>, Output = Const<N>>,
{
    let inverse = jacobian(over_unknowns, &z).1.lu().try_inverse()?;
    let mut path = z.map(T::from);
    for _ in 0..T::NDERIV {
        let excess = residual(path);
        path = SVector::from_fn(|i, _| (0..N).fold(path[i], |sum, j| sum - excess[j] * inverse[(i, j)]));
    }
    Some(path)
}
