//! The numbers of a robot that can be changed one at a time, plain or dual.

use num_dual::{Dual64, DualNum};

use crate::robot::Robot;

/// A parameter of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum Knob {
    /// E.
    YoungsModulus,
    /// A.
    Area,
    /// μ.
    MassPerLength,
    /// m.
    PlatformMass,
    /// A factor on the prescribed tension of this cable, 0-based: all coefficients of its law alike.
    Tension(usize),
    /// α.
    Alpha,
    /// β.
    Beta,
    /// g.
    Gravity,
}

impl Knob {
    /// All of `robot`, damping included even where it is zero.
    pub fn all(robot: &Robot) -> Vec<Self> {
        let before = [Self::YoungsModulus, Self::Area, Self::MassPerLength, Self::PlatformMass];
        let after = [Self::Alpha, Self::Beta, Self::Gravity];
        before.into_iter().chain(robot.prescribed().map(Self::Tension)).chain(after).collect()
    }
}

/// What the statics and the element matrices of a robot depend on.
#[derive(Clone, Debug)]
pub(super) struct Parameters<D> {
    /// EA in N.
    pub axial_stiffness: D,
    /// μ in kg/m.
    pub mass_per_length: D,
    /// m in kg.
    pub platform_mass: D,
    /// g in m/s².
    pub gravity: D,
    /// The factor on the prescribed tension of each cable.
    pub tension: Vec<D>,
}

impl<D: Copy> Parameters<D> {
    /// The same in other numbers.
    pub fn map<T>(&self, to: impl Fn(D) -> T) -> Parameters<T> {
        Parameters {
            axial_stiffness: to(self.axial_stiffness),
            mass_per_length: to(self.mass_per_length),
            platform_mass: to(self.platform_mass),
            gravity: to(self.gravity),
            tension: self.tension.iter().map(|&factor| to(factor)).collect(),
        }
    }
}

impl<D: DualNum<Primitive = f64> + Copy> Parameters<D> {
    /// Those of `robot`.
    pub fn of(robot: &Robot) -> Self {
        Self {
            axial_stiffness: robot.axial_stiffness().into(),
            mass_per_length: robot.mass_per_length.into(),
            platform_mass: robot.platform_mass.into(),
            gravity: robot.gravity.into(),
            tension: vec![1.0.into(); robot.cables.len()],
        }
    }
}

impl Parameters<Dual64> {
    /// Those of `robot` with their derivatives with respect to ln p, p the parameter `knob`: dp = p d(ln p).
    pub fn along(robot: &Robot, knob: Knob) -> Self {
        let mut parameters = Self::of(robot);
        let turned = match knob {
            Knob::YoungsModulus | Knob::Area => Some(&mut parameters.axial_stiffness),
            Knob::MassPerLength => Some(&mut parameters.mass_per_length),
            Knob::PlatformMass => Some(&mut parameters.platform_mass),
            Knob::Gravity => Some(&mut parameters.gravity),
            Knob::Tension(cable) => parameters.tension.get_mut(cable),
            Knob::Alpha | Knob::Beta => None,
        };
        if let Some(parameter) = turned {
            parameter.eps = parameter.re;
        }
        parameters
    }
}
