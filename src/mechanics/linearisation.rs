//! Small vibrations about the static shape of a robot that moves at speed v:
//! M q̈ + (v C + αM + βK) q̇ + (K + v² D) q = 0.
//!
//! C is the energy-transfer matrix and D the flow stiffness (`K_dyn`), both for unit speed: inflow rates grow with v,
//! their rates with v². K is the elastic part alone. Winch nodes do not move. The matrices are never formed here:
//! the problem is kept as chains of elements that meet in the platform. docs/theory.md section 7.

use nalgebra::{Matrix2, Vector2};
use num_dual::{Dual2, Dual64, DualNum};

use super::cable::CableModel;
use super::motion::paths;
use super::parameters::{CableParameters, Knob, Parameters};
use crate::mechanics::{CableShape, Element, Hub, Joint, LengthRates, Material, Statics, Stiffness};
use crate::robot::{Damping, Linearisation, Robot, Vec2};

impl<D: DualNum<Primitive = f64> + Copy> Element<D> {
    /// The elements of cable `i` of unstretched length L from the platform to the winch, given the force of each.
    fn of_cable<'a>(
        robot: &'a Robot,
        parameters: &Parameters<D>,
        i: usize,
        length: D,
        rates: LengthRates<D>,
        forces: impl IntoIterator<Item = Vector2<D>> + 'a,
    ) -> impl Iterator<Item = Self> + 'a {
        let CableParameters { axial_stiffness, mass_per_length: mu, .. } = parameters.cables[i];
        let material = Material { axial_stiffness, strain: robot.material_of(i).strain };
        let n = robot.elements as f64;
        let l = length / n;
        forces.into_iter().enumerate().map(move |(k, t)| {
            // Inflow of element k and its rate at v = 1: w = −k l̇, −(k+1) l̇ with l̇ = L'/n, l̈ = L''/n.
            let inflow = |derivative: D| [derivative * -(k as f64) / n, derivative * -((k + 1) as f64) / n];
            let stiffness = Stiffness::new(material, robot.linearisation, t);
            Self::at_rest(mu, l, stiffness).with_inflow(inflow(rates.first), inflow(rates.second))
        })
    }
}

/// The elements of one cable, from the platform to the winch: at least two.
///
/// ```compile_fail
/// // There is no chain without elements.
/// let chain = tautline::mechanics::Chain { elements: Vec::new() };
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Chain<D = f64> {
    elements: Vec<Element<D>>,
}

impl<D> Chain<D> {
    /// The cable of these elements; `None` where there are fewer than two, so that no node moves.
    pub fn new(elements: Vec<Element<D>>) -> Option<Self> {
        (elements.len() >= 2).then_some(Self { elements })
    }

    /// The elements from the platform to the winch.
    pub fn elements(&self) -> &[Element<D>] {
        &self.elements
    }

    /// The same to be changed, though not in number.
    pub fn elements_mut(&mut self) -> &mut [Element<D>] {
        &mut self.elements
    }

    /// Number of nodes that move, besides the one at the hub.
    pub fn inner_nodes(&self) -> usize {
        self.elements.len() - 1
    }
}

impl Chain {
    /// The stiffness (N/m, over x and y) with which the chain holds its first node at rest: that of its elements in series.
    pub fn stiffness_in_series(&self) -> Matrix2<f64> {
        let compliance = self.elements.iter().filter_map(|element| element.elastic().try_inverse());
        compliance.sum::<Matrix2<f64>>().try_inverse().unwrap_or_else(Matrix2::zeros)
    }
}

/// The small-vibration problem at a pose, for every speed: one chain per cable, at least one.
///
/// In dual numbers it carries what a parameter changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Vibration<D = f64> {
    pub(crate) chains: Vec<Chain<D>>,
    pub(crate) hub: Hub<D>,
    pub(crate) damping: Damping,
    pub(crate) isotropic: bool,
}

impl<D> Vibration<D> {
    /// One chain per cable.
    pub fn chains(&self) -> &[Chain<D>] {
        &self.chains
    }

    /// Where the chains meet.
    pub fn hub(&self) -> &Hub<D> {
        &self.hub
    }

    /// α and β.
    pub fn damping(&self) -> Damping {
        self.damping
    }

    /// Whether every block is a multiple of I₂, so that x and y decouple into two equal problems (secant stiffness).
    pub fn is_isotropic(&self) -> bool {
        self.isotropic
    }

    fn of_robot(robot: &Robot, chains: Vec<Chain<D>>, hub: Hub<D>) -> Self {
        Self { chains, hub, damping: robot.damping, isotropic: robot.linearisation == Linearisation::Secant }
    }
}

impl Vibration {
    /// The problem of cables that meet in `hub`, with damping; `isotropic` tells whether every block is a multiple of I₂,
    /// so that x and y decouple into two equal problems (secant stiffness).
    ///
    /// `None` where there is no cable, or not a joint for each, where a platform's mass is not positive, or `isotropic` is
    /// not true.
    pub fn of_cables(chains: Vec<Chain>, hub: Hub, damping: Damping, isotropic: bool) -> Option<Self> {
        let heavy = hub.platform_mass().is_none_or(|mass| mass > 0.0);
        let alike = |element: &Element| element.stiffness.along.to_bits() == element.stiffness.across.to_bits();
        let sound = !isotropic || chains.iter().flat_map(Chain::elements).all(alike);
        let joined = !chains.is_empty() && hub.joints().len() == chains.len();
        (heavy && sound && joined).then_some(Self { chains, hub, damping, isotropic })
    }

    /// The problem of `robot` at rest in `statics`, for motion with the length rates `rates`; `None` where these are not
    /// of all its cables and elements.
    pub fn new(robot: &Robot, statics: &Statics, rates: &[LengthRates]) -> Option<Self> {
        let cables = robot.cables.len();
        let whole = statics.cables.iter().all(|shape| shape.forces.len() == robot.elements);
        if !whole || statics.cables.len() != cables || rates.len() != cables {
            return None;
        }
        let parameters = Parameters::of(robot);
        let chain = |(i, (shape, &rates)): (usize, (&CableShape, &LengthRates))| {
            let forces = shape.forces.iter().copied();
            Chain { elements: Element::of_cable(robot, &parameters, i, shape.length, rates, forces).collect() }
        };
        let chains = statics.cables.iter().zip(rates).enumerate().map(chain).collect();
        Some(Self::of_robot(robot, chains, Hub::point(robot.platform_mass, cables)))
    }

    /// Whether K is positive definite, so that the robot is stable at v = 0.
    ///
    /// A chain of positive springs is. What it leaves at the hub is its stiffness in series, so that the hub's own stiffness
    /// with all of these has to be positive definite as well. That of a point is zero, and adds no doubt.
    pub fn is_stable_at_rest(&self) -> bool {
        let positive = |element: &Element| element.springs().into_iter().all(|spring| spring > 0.0);
        let own = self.hub.stiffness();
        let in_series = |(chain, joint): (&Chain, &Joint)| joint.transpose() * (chain.stiffness_in_series() * joint);
        let held =
            || self.chains.iter().zip(self.hub.joints()).map(in_series).fold(own.clone(), |sum, part| sum + part);
        self.chains.iter().flat_map(Chain::elements).all(positive)
            && (own.iter().all(|&entry| entry == 0.0) || held().cholesky().is_some())
    }

    /// Number of nodes that move.
    pub fn nodes(&self) -> usize {
        let hub = usize::from(self.hub.dof() > 0);
        hub + self.chains.iter().map(Chain::inner_nodes).sum::<usize>()
    }
}

impl Vibration<Dual64> {
    /// The problem with its derivatives with respect to ln p, p the parameter `knob`; for `robot` at rest in `statics` and
    /// motion along the unit vector `direction`. α and β are those of the robot.
    ///
    /// Exact, by dual numbers: the change of the static shapes, of L' and of L'' is in them. `None` where the pose is
    /// singular. docs/theory.md section 12.
    pub fn along(robot: &Robot, statics: &Statics, direction: Vec2, knob: Knob) -> Option<Self> {
        let parameters = Parameters::along(robot, knob);
        let chain = |(i, [tx, ty, length]): (usize, [Dual2<Dual64>; 3])| {
            let cable = CableModel::with(robot, &parameters, i);
            let mut forces = Vec::with_capacity(robot.elements);
            cable.walk([0.0.into(); 2], [tx.re, ty.re], length.re, |t, _| forces.push(t.into()));
            let rates = LengthRates { first: length.v1, second: length.v2 };
            Chain { elements: Element::of_cable(robot, &parameters, i, length.re, rates, forces).collect() }
        };
        let chains =
            paths(robot, &parameters, statics, direction, Vec2::zeros())?.into_iter().enumerate().map(chain).collect();
        Some(Self::of_robot(robot, chains, Hub::point(parameters.platform_mass, robot.cables.len())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{self, length_rates};
    use crate::robot::{RobotSpec, Strain, paper, paper_spec};

    /// Springs that push are not stable, nor is a hub whose own stiffness takes away more than the cables give.
    #[test]
    fn at_rest_the_cables_hold_what_the_hub_loses() {
        let robot = paper().expect("a robot");
        let statics = mechanics::solve(&robot, Vec2::new(1.0, 0.5)).expect("statics");
        let rates = length_rates(&robot, &statics, Vec2::x()).expect("rates");
        let vibration = Vibration::new(&robot, &statics, &rates).expect("a problem");
        assert!(vibration.is_stable_at_rest());
        let mut pushing = vibration.clone();
        pushing.chains[1].elements_mut()[3].stiffness.across *= -1.0;
        assert!(!pushing.is_stable_at_rest());
        let held: Matrix2<f64> = vibration.chains.iter().map(Chain::stiffness_in_series).sum();
        // Of four springs (N/λ)/l each, by the secant in all directions alike.
        let springs: f64 = vibration
            .chains
            .iter()
            .map(|chain| 1.0 / chain.elements().iter().map(|element| 1.0 / element.springs()[1]).sum::<f64>())
            .sum();
        assert!((held - Matrix2::identity() * springs).amax() < 1e-12 * springs, "{held} {springs}");
        for (part, stable) in [(0.99, true), (1.01, false), (-1.0, true)] {
            let mut lossy = vibration.clone();
            lossy.hub.stiffness = nalgebra::DMatrix::from_diagonal_element(2, 2, -part * springs);
            assert_eq!(lossy.is_stable_at_rest(), stable, "{part}");
        }
    }

    /// What has no meaning cannot be built, and what does not belong together has no problem.
    #[test]
    fn illegal_values_cannot_be_built() {
        let robot = paper().expect("a robot");
        let statics = mechanics::solve(&robot, Vec2::new(1.0, 0.5)).expect("statics");
        let rates = length_rates(&robot, &statics, Vec2::x()).expect("rates");
        let vibration = Vibration::new(&robot, &statics, &rates).expect("a problem");
        let chain = &vibration.chains()[0];
        for (elements, legal) in [(0, false), (1, false), (2, true), (10, true)] {
            assert_eq!(Chain::new(chain.elements()[..elements].to_vec()).is_some(), legal, "{elements} elements");
        }
        let of = |chains: usize, hub, isotropic| {
            Vibration::of_cables(vibration.chains()[..chains].to_vec(), hub, robot.damping, isotropic).is_some()
        };
        assert!(of(1, Hub::fixed(1), true) && of(4, Hub::point(2.0, 4), true));
        assert!(!of(0, Hub::fixed(0), true) && !of(4, Hub::point(2.0, 3), true), "a joint per cable, at least one");
        assert!(!of(4, Hub::point(0.0, 4), true) && !of(4, Hub::point(f64::NAN, 4), true));
        let tangent = Robot::new(RobotSpec { linearisation: Linearisation::Tangent, ..paper_spec() }).expect("a robot");
        let planar = Vibration::new(&tangent, &statics, &rates).expect("a problem");
        let of_planar =
            |isotropic| Vibration::of_cables(planar.chains.clone(), planar.hub.clone(), planar.damping, isotropic);
        assert_eq!(of_planar(false).as_ref(), Some(&planar));
        assert!(of_planar(true).is_none(), "not isotropic");
        // Of another mesh, of fewer cables, and of another robot.
        let finer = Robot::new(RobotSpec { elements: 12, ..paper_spec() }).expect("a robot");
        assert!(
            Vibration::new(&finer, &statics, &rates).is_none()
                && Vibration::new(&robot, &statics, &rates[1..]).is_none()
        );
        let fewer = Statics { cables: statics.cables[..3].to_vec(), ..statics.clone() };
        assert!(Vibration::new(&robot, &fewer, &rates).is_none() && length_rates(&robot, &fewer, Vec2::x()).is_none());
        for (stiffness, legal) in
            [(6250.0, true), (0.0, false), (-1.0, false), (f64::NAN, false), (f64::INFINITY, false)]
        {
            assert_eq!(Material::new(stiffness, Strain::Green).is_some(), legal, "{stiffness}");
        }
    }
}
