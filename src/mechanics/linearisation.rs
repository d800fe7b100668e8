//! Small vibrations about the static shape of a robot that moves at speed v:
//! M q̈ + (v C + αM + βK) q̇ + (K + v² D) q = 0.
//!
//! C is the energy-transfer matrix and D the flow stiffness (`K_dyn`), both for unit speed: inflow rates grow with v,
//! their rates with v². K is the elastic part alone. Winch nodes do not move. The matrices are never formed here:
//! the problem is kept as chains of elements that meet in the platform. docs/theory.md section 7.

use nalgebra::Matrix2;

use super::element::{self, Block};
use crate::mechanics::{LengthRates, Material, Statics};
use crate::robot::{Damping, Linearisation, Robot};

/// One element's parts of M, C, D (over its two nodes) and K (A/l, over x and y).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// M, in kg.
    pub mass: Block,
    /// C at v = 1 m/s, in kg/m.
    pub transfer: Block,
    /// D: `K_dyn` at v = 1 m/s, in kg/m².
    pub flow: Block,
    /// A/l of K = [[A, −A], [−A, A]]/l, in N/m.
    pub elastic: Matrix2<f64>,
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
        let material = Material::of(robot);
        let mu = robot.mass_per_length;
        let n = robot.elements as f64;
        let chain = |(shape, rate): (&crate::mechanics::CableShape, &LengthRates)| {
            let l = shape.length / n;
            let elements = shape.forces.iter().enumerate().map(|(k, &t)| {
                // Inflow of element k and its rate at v = 1: w = −k l̇, −(k+1) l̇ with l̇ = L'/n, l̈ = L''/n.
                let inflow = |derivative: f64| [-(k as f64) * derivative / n, -((k + 1) as f64) * derivative / n];
                Element {
                    mass: element::mass(mu, l),
                    transfer: element::transfer(mu, inflow(rate.first)),
                    flow: element::flow_stiffness(mu, l, inflow(rate.first), inflow(rate.second)),
                    elastic: element::elastic(material, robot.linearisation, l, t),
                }
            });
            Chain { elements: elements.collect() }
        };
        Self {
            chains: statics.cables.iter().zip(rates).map(chain).collect(),
            hub: Hub::Platform(robot.platform_mass),
            damping: robot.damping,
            isotropic: robot.linearisation == Linearisation::Secant,
        }
    }

    /// Number of nodes that move.
    pub fn nodes(&self) -> usize {
        let hub = usize::from(matches!(self.hub, Hub::Platform(_)));
        hub + self.chains.iter().map(Chain::inner_nodes).sum::<usize>()
    }

    /// Number of eigenvalues, multiplicity included: two per degree of freedom.
    pub fn eigenvalues(&self) -> usize {
        4 * self.nodes()
    }
}
