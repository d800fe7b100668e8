//! Small vibrations about the static shape of a robot that moves at speed v:
//! M q̈ + (v C + αM + βK) q̇ + (K + v² D) q = 0.
//!
//! C is the energy-transfer matrix and D the flow stiffness (`K_dyn`), both for unit speed: inflow rates grow with v,
//! their rates with v². K is the elastic part alone. Winch nodes do not move. The matrices are never formed here:
//! the problem is kept as chains of elements that meet in the platform. docs/theory.md section 7.

use nalgebra::{Matrix2, Vector2};
use num_dual::{Dual2, Dual64, DualNum};

use super::cable::CableModel;
use super::element;
use super::motion::paths;
use super::parameters::{Knob, Parameters};
use crate::mechanics::{LengthRates, Material, Statics};
use crate::robot::{Damping, Linearisation, Robot, Vec2};

/// One element's parts of M, C, D (over its two nodes) and K (A/l, over x and y).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element<D = f64> {
    /// M, in kg.
    pub mass: Matrix2<D>,
    /// C at v = 1 m/s, in kg/m.
    pub transfer: Matrix2<D>,
    /// D: `K_dyn` at v = 1 m/s, in kg/m².
    pub flow: Matrix2<D>,
    /// A/l of K = [[A, −A], [−A, A]]/l, in N/m.
    pub elastic: Matrix2<D>,
}

impl<D: DualNum<Primitive = f64> + Copy> Element<D> {
    /// The elements of one cable of unstretched length L from the platform to the winch, given the force of each.
    fn of_cable<'a>(
        robot: &'a Robot,
        parameters: &'a Parameters<D>,
        length: D,
        rates: LengthRates<D>,
        forces: impl IntoIterator<Item = Vector2<D>> + 'a,
    ) -> impl Iterator<Item = Self> + 'a {
        let material = Material { axial_stiffness: parameters.axial_stiffness, strain: robot.strain };
        let (mu, n) = (parameters.mass_per_length, robot.elements as f64);
        let l = length / n;
        forces.into_iter().enumerate().map(move |(k, t)| {
            // Inflow of element k and its rate at v = 1: w = −k l̇, −(k+1) l̇ with l̇ = L'/n, l̈ = L''/n.
            let inflow = |derivative: D| [derivative * -(k as f64) / n, derivative * -((k + 1) as f64) / n];
            Self {
                mass: element::mass(mu, l),
                transfer: element::transfer(mu, inflow(rates.first)),
                flow: element::flow_stiffness(mu, l, inflow(rates.first), inflow(rates.second)),
                elastic: element::elastic(material, robot.linearisation, l, t),
            }
        })
    }
}

impl Element<Dual64> {
    fn derivative(&self) -> Element {
        let [mass, transfer, flow, elastic] =
            [self.mass, self.transfer, self.flow, self.elastic].map(|matrix| matrix.map(|entry| entry.eps));
        Element { mass, transfer, flow, elastic }
    }
}

/// The elements of one cable, from the platform to the winch.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// At least two elements.
    pub elements: Vec<Element>,
}

impl Chain {
    /// Number of nodes that move, besides the one at the hub.
    pub fn inner_nodes(&self) -> usize {
        self.elements.len() - 1
    }
}

/// What node 0 of all chains is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hub {
    /// The platform, a point mass in kg that moves.
    Platform(f64),
    /// A point that does not move: single cables with fixed ends, as textbooks have them.
    Fixed,
}

/// The small-vibration problem at a pose, for every speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Vibration {
    /// One chain per cable.
    pub chains: Vec<Chain>,
    /// Where the chains meet.
    pub hub: Hub,
    /// α and β.
    pub damping: Damping,
    /// Whether every block is a multiple of I₂, so that x and y decouple into two equal problems (secant stiffness).
    pub isotropic: bool,
}

impl Vibration {
    /// The problem of `robot` at rest in `statics`, for motion with the length rates `rates`.
    pub fn new(robot: &Robot, statics: &Statics, rates: &[LengthRates]) -> Self {
        let parameters = Parameters::of(robot);
        let chain = |(shape, &rates): (&crate::mechanics::CableShape, &LengthRates)| {
            let forces = shape.forces.iter().copied();
            Chain { elements: Element::of_cable(robot, &parameters, shape.length, rates, forces).collect() }
        };
        Self::of_chains(robot, statics.cables.iter().zip(rates).map(chain).collect(), robot.platform_mass)
    }

    /// The derivatives of M, C, K and D with respect to ln p, p the parameter `knob`, in the form of a problem; for
    /// `robot` at rest in `statics` and motion along the unit vector `direction`. α and β are those of the robot.
    ///
    /// Exact, by dual numbers: the change of the static shapes, of L' and of L'' is in them. `None` where the pose is
    /// singular. docs/theory.md section 12.
    pub fn derivative(robot: &Robot, statics: &Statics, direction: Vec2, knob: Knob) -> Option<Self> {
        let parameters = Parameters::along(robot, knob);
        let cable = CableModel::with(robot, &parameters);
        let chain = |[tx, ty, length]: [Dual2<Dual64>; 3]| {
            let mut forces = Vec::with_capacity(robot.elements);
            cable.walk([0.0.into(); 2], [tx.re, ty.re], length.re, |t, _| forces.push(t.into()));
            let rates = LengthRates { first: length.v1, second: length.v2 };
            let elements = Element::of_cable(robot, &parameters, length.re, rates, forces);
            Chain { elements: elements.map(|element| element.derivative()).collect() }
        };
        let chains = paths(robot, &parameters, statics, direction)?.into_iter().map(chain).collect();
        Some(Self::of_chains(robot, chains, parameters.platform_mass.eps))
    }

    fn of_chains(robot: &Robot, chains: Vec<Chain>, platform_mass: f64) -> Self {
        Self {
            chains,
            hub: Hub::Platform(platform_mass),
            damping: robot.damping,
            isotropic: robot.linearisation == Linearisation::Secant,
        }
    }

    /// Whether K is positive definite, so that the robot is stable at v = 0: by elimination along the cables, whose pivots
    /// are then all positive definite.
    pub fn is_stable_at_rest(&self) -> bool {
        let positive = |block: &Matrix2<f64>| block.trace() > 0.0 && block.determinant() > 0.0;
        let mut hub = Matrix2::zeros();
        for Chain { elements } in &self.chains {
            let mut outer = Matrix2::zeros();
            for pair in elements.windows(2).rev() {
                let pivot = pair[0].elastic + pair[1].elastic - outer;
                let Some(inverse) = pivot.try_inverse().filter(|_| positive(&pivot)) else { return false };
                outer = pair[0].elastic * inverse * pair[0].elastic;
            }
            hub += elements[0].elastic - outer;
        }
        matches!(self.hub, Hub::Fixed) || positive(&hub)
    }

    /// Number of nodes that move.
    pub fn nodes(&self) -> usize {
        let hub = usize::from(matches!(self.hub, Hub::Platform(_)));
        hub + self.chains.iter().map(Chain::inner_nodes).sum::<usize>()
    }
}
