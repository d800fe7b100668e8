//! The numbers of a robot that can be changed one at a time, plain or dual.

use num_dual::{Dual64, DualNum};

use crate::robot::{OwnMaterial, Robot};

/// A parameter of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub enum Knob {
    /// E of the cables that have none of their own.
    YoungsModulus,
    /// A of the cables that have none of their own.
    Area,
    /// μ of the cables that have none of their own.
    MassPerLength,
    /// The own E of this cable, 0-based.
    OwnYoungsModulus(usize),
    /// The own A of this cable, 0-based.
    OwnArea(usize),
    /// The own μ of this cable, 0-based.
    OwnMassPerLength(usize),
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
    /// All of `robot`, damping included even where it is zero. Of E, A and μ first the common one, if a cable uses it, then
    /// those that cables have of their own.
    pub fn all(robot: &Robot) -> Vec<Self> {
        let mut all = Vec::new();
        let mut material = |common: Self, of_cable: fn(usize) -> Self, own: fn(&OwnMaterial) -> Option<f64>| {
            let cables = || robot.cables.iter().map(|cable| own(&cable.own).is_some()).enumerate();
            all.extend(cables().any(|(_, own)| !own).then_some(common));
            all.extend(cables().filter(|(_, own)| *own).map(|(cable, _)| of_cable(cable)));
        };
        material(Self::YoungsModulus, Self::OwnYoungsModulus, |own| own.youngs_modulus);
        material(Self::Area, Self::OwnArea, |own| own.area);
        material(Self::MassPerLength, Self::OwnMassPerLength, |own| own.mass_per_length);
        all.push(Self::PlatformMass);
        all.extend(robot.prescribed().map(Self::Tension));
        all.extend([Self::Alpha, Self::Beta, Self::Gravity]);
        all
    }
}

/// What the statics and the element matrices of a robot depend on.
#[derive(Clone, Debug)]
pub(super) struct Parameters<D> {
    /// m in kg.
    pub platform_mass: D,
    /// g in m/s².
    pub gravity: D,
    /// What each cable depends on.
    pub cables: Vec<CableParameters<D>>,
}

/// What one cable depends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct CableParameters<D> {
    /// EA in N.
    pub axial_stiffness: D,
    /// μ in kg/m.
    pub mass_per_length: D,
    /// The factor on its prescribed tension.
    pub tension: D,
}

impl<D: Copy> Parameters<D> {
    /// The same in other numbers.
    pub fn map<T>(&self, to: impl Fn(D) -> T) -> Parameters<T> {
        let cable = |cable: &CableParameters<D>| CableParameters {
            axial_stiffness: to(cable.axial_stiffness),
            mass_per_length: to(cable.mass_per_length),
            tension: to(cable.tension),
        };
        Parameters {
            platform_mass: to(self.platform_mass),
            gravity: to(self.gravity),
            cables: self.cables.iter().map(cable).collect(),
        }
    }
}

impl<D: DualNum<Primitive = f64> + Copy> Parameters<D> {
    /// Those of `robot`.
    pub fn of(robot: &Robot) -> Self {
        let cable = |cable| {
            let material = robot.material_of(cable);
            CableParameters {
                axial_stiffness: material.axial_stiffness().into(),
                mass_per_length: material.mass_per_length.into(),
                tension: 1.0.into(),
            }
        };
        Self {
            platform_mass: robot.platform_mass.into(),
            gravity: robot.gravity.into(),
            cables: (0..robot.cables.len()).map(cable).collect(),
        }
    }
}

impl Parameters<Dual64> {
    /// Those of `robot` with their derivatives with respect to ln p, p the parameter `knob`: dp = p d(ln p).
    pub fn along(robot: &Robot, knob: Knob) -> Self {
        let mut parameters = Self::of(robot);
        let turn = |parameter: &mut Dual64| parameter.eps = parameter.re;
        match knob {
            Knob::PlatformMass => turn(&mut parameters.platform_mass),
            Knob::Gravity => turn(&mut parameters.gravity),
            _ => {}
        }
        for (i, (parameters, OwnMaterial { youngs_modulus, area, mass_per_length, .. })) in
            parameters.cables.iter_mut().zip(robot.cables.iter().map(|cable| cable.own)).enumerate()
        {
            let CableParameters { axial_stiffness, mass_per_length: mass, tension } = parameters;
            let turned = match knob {
                Knob::YoungsModulus => youngs_modulus.is_none().then_some(axial_stiffness),
                Knob::Area => area.is_none().then_some(axial_stiffness),
                Knob::MassPerLength => mass_per_length.is_none().then_some(mass),
                Knob::OwnYoungsModulus(cable) => (cable == i && youngs_modulus.is_some()).then_some(axial_stiffness),
                Knob::OwnArea(cable) => (cable == i && area.is_some()).then_some(axial_stiffness),
                Knob::OwnMassPerLength(cable) => (cable == i && mass_per_length.is_some()).then_some(mass),
                Knob::Tension(cable) => (cable == i).then_some(tension),
                Knob::PlatformMass | Knob::Alpha | Knob::Beta | Knob::Gravity => None,
            };
            if let Some(parameter) = turned {
                turn(parameter);
            }
        }
        parameters
    }
}
