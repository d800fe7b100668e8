//! Small-vibration problems for the tests of this room, made from the rooms below it.

use crate::mechanics::{self, Chain, Element, Material, Stiffness, Vibration};
use crate::robot::{Linearisation, Robot, RobotSpec, Strain, Vec2};

/// What the straight cables are made of.
pub const MATERIAL: Material = Material { axial_stiffness: 6250.0, strain: Strain::Green };
/// Their μ in kg/m.
pub const MU: f64 = 0.4;

/// The problem of a robot whose platform is at `position` (m) and moves along `direction`, of any length.
pub fn of_robot(spec: RobotSpec, position: [f64; 2], direction: [f64; 2]) -> Vibration {
    let robot = Robot::new(spec).unwrap();
    let statics = mechanics::solve(&robot, position.into()).unwrap();
    let rates = mechanics::length_rates(&robot, &statics, Vec2::from(direction).normalize()).unwrap();
    Vibration::new(&robot, &statics, &rates).unwrap()
}

/// A straight cable of `n` elements with this unstretched length (m) and tension (N) in a slanted direction, that is paid
/// out with L' and L''.
pub fn straight(n: usize, length: f64, tension: f64, rates: [f64; 2], linearisation: Linearisation) -> Chain {
    let stiffness = Stiffness::new(MATERIAL, linearisation, Vec2::new(0.6, 0.8) * tension);
    let element = |k: usize| {
        let inflow = |rate: f64| [-(k as f64) * rate / n as f64, -((k + 1) as f64) * rate / n as f64];
        Element::at_rest(MU, length / n as f64, stiffness).with_inflow(inflow(rates[0]), inflow(rates[1]))
    };
    Chain::new((0..n).map(element).collect()).unwrap()
}
