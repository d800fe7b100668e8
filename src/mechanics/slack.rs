//! The slack acceleration: how hard the platform may speed up or brake before a cable goes slack.
//!
//! All lengths follow the quasi-static motion r(s). At v = 0 the acceleration s̈ leaves the inertia M r' s̈ of nodes and
//! platform, and that of the material that is reeled, (∂`K_dyn`/∂s̈) r s̈. Both bend the robot by δ s̈ with
//! K δ = −(M r' + (∂`K_dyn`/∂s̈) r). docs/theory.md section 16.

use nalgebra::{DMatrix, DVector, Vector2};

use super::motion::node_rates;
use super::{Arrow, ArrowVector, Element, Joint, Material, Statics, Stiffness, length_rates};
use crate::robot::{Linearisation, Robot, Vec2};

/// Limits that differ by less than this part are equal but for rounding.
const TOGETHER: f64 = 1e-9;
/// Forces that change less than this part of the largest change are held by symmetry, and change by rounding only.
const ROUNDING: f64 = 1e-12;

/// The acceleration at which the first element of a cable carries no force any more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlackLimit {
    /// |s̈| in m/s².
    pub value: f64,
    /// The cable that goes slack, 0-based.
    pub cable: usize,
}

/// What an acceleration along the motion does to a pose, from statics alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlackAcceleration {
    /// For s̈ > 0; `None` where no element's force becomes less.
    pub accelerating: Option<SlackLimit>,
    /// For s̈ < 0; its value is positive.
    pub braking: Option<SlackLimit>,
    /// |δ| of the platform, in m per m/s².
    pub deviation_per_acceleration: f64,
}

/// The least |s̈| of each sign at which an element's force is 0, for a motion along the unit vector `direction` that begins
/// at rest in the pose of `statics`.
///
/// Forces are taken as linear in s̈: dN = N'(λ) e·(δₖ₊₁ − δₖ)/l. K is the tangent stiffness whatever the robot's
/// linearisation, the lengths are held and the winch nodes fixed. Flown, slack comes earlier. O(n). `None` where the pose
/// is singular.
pub fn slack_acceleration(robot: &Robot, statics: &Statics, direction: Vec2) -> Option<SlackAcceleration> {
    let cables = elements(robot, statics, direction)?;
    let delta = deviation(robot, statics, &cables, direction)?;
    let platform = Vec2::new(delta.hub[0], delta.hub[1]);

    let mut changes: Vec<Vec<[f64; 2]>> = Vec::new();
    for ((elements, shape), nodes) in cables.iter().zip(&statics.cables).zip(&delta.chains) {
        let from = std::iter::once(platform).chain(nodes.iter().copied());
        let to = nodes.iter().copied().chain([Vec2::zeros()]);
        let change = |((element, force), (from, to)): ((&Element, &Vec2), (Vec2, Vec2))| {
            let stretching = element.stiffness.direction.dot(&(to - from)) / element.length;
            [force.norm(), element.stiffness.along * stretching]
        };
        changes.push(elements.iter().zip(&shape.forces).zip(from.zip(to)).map(change).collect());
    }
    let largest = changes.iter().flatten().fold(0.0_f64, |largest, [_, change]| largest.max(change.abs()));
    let limit = |sign: f64| {
        let of_cable = |(cable, changes): (usize, &Vec<[f64; 2]>)| {
            let losing = changes.iter().filter(|[_, change]| sign * change < -ROUNDING * largest);
            let value = losing.map(|[force, change]| force / change.abs()).min_by(f64::total_cmp)?;
            Some(SlackLimit { value, cable })
        };
        let limits: Vec<SlackLimit> = changes.iter().enumerate().filter_map(of_cable).collect();
        let least = limits.iter().map(|limit| limit.value).min_by(f64::total_cmp)?;
        limits.into_iter().find(|limit| limit.value <= least * (1.0 + TOGETHER))
    };
    let deviation_per_acceleration = platform.norm();
    deviation_per_acceleration.is_finite().then(|| SlackAcceleration {
        accelerating: limit(1.0),
        braking: limit(-1.0),
        deviation_per_acceleration,
    })
}

/// The elements of every cable with their tangent stiffness, and with the inflow at unit speed.
fn elements(robot: &Robot, statics: &Statics, direction: Vec2) -> Option<Vec<Vec<Element>>> {
    let rates = length_rates(robot, statics, direction)?;
    let n = robot.elements as f64;
    let mut cables = Vec::new();
    for (i, (shape, rate)) in statics.cables.iter().zip(rates).enumerate() {
        let (material, mu) = (Material::of(robot, i), robot.material_of(i).mass_per_length);
        let element = |(k, force): (usize, &Vec2)| {
            let stiffness = Stiffness::new(material, Linearisation::Tangent, *force);
            let inflow = [k, k + 1].map(|k| -(k as f64) * rate.first / n);
            Element::at_rest(mu, shape.length / n, stiffness).with_inflow(inflow, [0.0; 2])
        };
        cables.push(shape.forces.iter().enumerate().map(element).collect());
    }
    Some(cables)
}

/// δ of platform and inner nodes per unit s̈.
fn deviation(
    robot: &Robot,
    statics: &Statics,
    cables: &[Vec<Element>],
    direction: Vec2,
) -> Option<ArrowVector<f64, 2>> {
    let rates = node_rates(robot, statics, direction, Vec2::zeros())?;
    let mut hub = direction * robot.platform_mass;
    let mut chains = Vec::new();
    for ((elements, shape), rates) in cables.iter().zip(&statics.cables).zip(&rates) {
        let mut forces = vec![Vector2::zeros(); elements.len() + 1];
        for (k, element) in elements.iter().enumerate() {
            // With ẇ = s̈ w(v = 1), K_dyn grows by μ [[−a, a], [−b, b]] per s̈: half of C.
            let (mass, flow) = (element.mass(), element.transfer() / 2.0);
            for (row, force) in forces[k..=k + 1].iter_mut().enumerate() {
                for column in 0..2 {
                    *force +=
                        rates[k + column][0] * mass[(row, column)] + shape.nodes[k + column] * flow[(row, column)];
                }
            }
        }
        hub += forces[0];
        chains.push(forces[1..elements.len()].iter().map(|force| -force).collect());
    }
    let joint = || Joint::identity(2);
    let blocks = |element: &Element| {
        let spring = element.elastic();
        [[spring, -spring], [-spring, spring]]
    };
    let stiffness = cables.iter().map(|elements| (elements.as_slice(), joint()));
    let arrow = Arrow::factor(DMatrix::zeros(2, 2), stiffness, blocks);
    let delta = arrow.solve(&ArrowVector { hub: -DVector::from_column_slice(hub.as_slice()), chains });
    let finite = delta.hub.iter().chain(delta.chains.iter().flatten().flat_map(|node| node.iter()));
    finite.copied().all(f64::is_finite).then_some(delta)
}
