//! Ropes by diameter and construction: Young's modulus, cross-section, mass and breaking force.
//!
//! For a rope of diameter d:
//!
//! - A = C d², the area that carries load: of all wires, or of all fibres
//! - μ = W d²
//! - E, of the rope and not of its wires, such that EA is the rope's stiffness once it has settled
//! - F = S A, the force at which a new rope breaks
//!
//! C, W, E and S are typical values; docs/ropes.md has their sources and ranges. The maker's data sheet comes first.

use std::f64::consts::FRAC_PI_4;

use crate::scenario::json::Material;

/// How a rope is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Construction {
    /// Six strands of 19 steel wires round a fibre core (6×19M-FC).
    Steel6x19,
    /// Six strands of 36 steel wires round a fibre core (6×36WS-FC).
    Steel6x36,
    /// Twelve braided strands of Dyneema SK78.
    Dyneema,
    /// Twelve braided strands of aramid.
    Aramid,
    /// Three laid strands of polyester.
    Polyester,
    /// Three laid strands of nylon.
    Nylon,
    /// A solid cord of natural rubber.
    Rubber,
}

/// What a construction has at every diameter.
struct Figures {
    /// C = A/d².
    area: f64,
    /// W = μ/d² in kg/m³.
    mass: f64,
    /// E in Pa.
    modulus: f64,
    /// S = F/A in Pa.
    strength: f64,
}

impl Construction {
    /// All of them, steel first.
    pub const ALL: [Self; 7] =
        [Self::Steel6x19, Self::Steel6x36, Self::Dyneema, Self::Aramid, Self::Polyester, Self::Nylon, Self::Rubber];

    /// What people call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Steel6x19 => "steel 6×19",
            Self::Steel6x36 => "steel 6×36",
            Self::Dyneema => "Dyneema SK78",
            Self::Aramid => "aramid",
            Self::Polyester => "polyester",
            Self::Nylon => "nylon",
            Self::Rubber => "rubber",
        }
    }

    fn figures(self) -> Figures {
        // The fibres' densities in kg/m³ turn the mass of a rope into the area of its fibres: C = W/ρ.
        let fibres = |density: f64, mass: f64, modulus: f64, strength: f64| Figures {
            area: mass / density,
            mass,
            modulus,
            strength,
        };
        // Of steel ropes, EN 12385-4 has F = K d² R with the grade R of the wires: S = K R/C.
        let steel = |area: f64, mass: f64, breaking: f64, modulus: f64| Figures {
            area,
            mass,
            modulus,
            strength: breaking * 1770e6 / area,
        };
        match self {
            Self::Steel6x19 => steel(0.357, 3460.0, 0.307, 74.5e9),
            Self::Steel6x36 => steel(0.393, 3670.0, 0.330, 68.3e9),
            Self::Dyneema => fibres(975.0, 600.0, 45e9, 1.4e9),
            Self::Aramid => fibres(1440.0, 800.0, 40e9, 1.3e9),
            Self::Polyester => fibres(1380.0, 800.0, 2e9, 0.27e9),
            Self::Nylon => fibres(1140.0, 600.0, 1e9, 0.30e9),
            Self::Rubber => Figures { area: FRAC_PI_4, mass: 950.0 * FRAC_PI_4, modulus: 2e6, strength: 20e6 },
        }
    }
}

/// A rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rope {
    /// How it is made.
    pub construction: Construction,
    /// Its diameter d in m.
    pub diameter: f64,
}

/// Up to this part of themselves, numbers count as a rope's own: more than rounding, less than anybody types.
const SAME: f64 = 1e-12;

impl Rope {
    /// E in Pa.
    pub fn youngs_modulus(self) -> f64 {
        self.construction.figures().modulus
    }

    /// A = C d² in m².
    pub fn area(self) -> f64 {
        self.construction.figures().area * self.diameter * self.diameter
    }

    /// μ = W d² in kg/m.
    pub fn mass_per_length(self) -> f64 {
        self.construction.figures().mass * self.diameter * self.diameter
    }

    /// F = S A in N, the force at which a new rope breaks.
    pub fn breaking_force(self) -> f64 {
        self.construction.figures().strength * self.area()
    }

    /// The rope that has exactly these E, A and μ, where one has.
    pub fn of(material: &Material) -> Option<Self> {
        let near = |a: f64, b: f64| (a - b).abs() <= SAME * b.abs();
        Construction::ALL.into_iter().find_map(|construction| {
            let diameter = (material.mass_per_length / construction.figures().mass).sqrt();
            // To a millionth of a millimetre, which is what people mean by a diameter; finer ones stay as they are.
            let rounded = (diameter * 1e9).round() / 1e9;
            let diameter = if near(diameter, rounded) { rounded } else { diameter };
            let rope = Self { construction, diameter };
            let is_it = near(material.youngs_modulus, rope.youngs_modulus())
                && near(material.area, rope.area())
                && near(material.mass_per_length, rope.mass_per_length());
            is_it.then_some(rope)
        })
    }

    /// The rope of a construction whose cross-section is nearest to `area` (m²), to a tenth of a millimetre.
    pub fn like(construction: Construction, area: f64) -> Self {
        let diameter = (area / construction.figures().area).sqrt();
        Self { construction, diameter: (diameter * 1e4).round().max(1.0) / 1e4 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::Strain;

    fn rope(construction: Construction, millimetres: f64) -> Rope {
        Rope { construction, diameter: (millimetres * 1e6).round() / 1e9 }
    }

    fn material(rope: Rope) -> Material {
        Material {
            youngs_modulus: rope.youngs_modulus(),
            area: rope.area(),
            mass_per_length: rope.mass_per_length(),
            strain: Strain::Green,
        }
    }

    /// (construction, mm, kg/m, kN, by how much they may differ): tables of standards and makers, see docs/ropes.md.
    #[test]
    fn masses_and_breaking_forces_are_those_of_tables() {
        let tables = [
            (Construction::Steel6x19, 6.0, 0.125, 19.6, 0.01),
            (Construction::Steel6x19, 10.0, 0.346, 54.3, 0.01),
            // An older table of the same rope, with another factor for the breaking force.
            (Construction::Steel6x19, 6.0, 0.125, 18.7, 0.05),
            (Construction::Steel6x36, 10.0, 0.367, 58.4, 0.01),
            (Construction::Dyneema, 6.35, 0.0238, 34.2, 0.03),
            (Construction::Polyester, 12.0, 0.115, 22.6, 0.02),
            (Construction::Polyester, 24.0, 0.452, 88.0, 0.03),
            (Construction::Nylon, 12.7, 0.0967, 25.6, 0.01),
            (Construction::Nylon, 19.05, 0.2158, 56.9, 0.02),
        ];
        for (construction, millimetres, mass, force, part) in tables {
            let rope = rope(construction, millimetres);
            let off = [rope.mass_per_length() / mass - 1.0, rope.breaking_force() / (1e3 * force) - 1.0];
            assert!(off.iter().all(|off| off.abs() < part), "{construction:?} {millimetres}: {off:?}");
        }
    }

    /// Steel of 7850 kg/m³ and a core that is lighter: the wires' share of the mass.
    #[test]
    fn areas_and_masses_agree() {
        for construction in Construction::ALL {
            let Figures { area, mass, strength, modulus } = construction.figures();
            assert!(area <= FRAC_PI_4, "{construction:?}: no more than the circle is full");
            let density = mass / area;
            let wanted = match construction {
                Construction::Steel6x19 | Construction::Steel6x36 => 8500.0..=10_000.0,
                _ => 900.0..=1500.0,
            };
            assert!(wanted.contains(&density), "{construction:?}: {density} kg/m³");
            // Nothing stretches less than a hundredth before it breaks.
            assert!(strength / modulus > 0.01, "{construction:?}");
        }
    }

    #[test]
    fn a_rope_is_known_by_its_numbers_and_by_no_others() {
        for construction in Construction::ALL {
            for millimetres in [0.1, 0.3, 1.0, 6.0, 6.35, 11.8, 20.0, 123.4] {
                let rope = rope(construction, millimetres);
                let mut material = material(rope);
                assert_eq!(Rope::of(&material), Some(rope));
                // Four digits of a typed value are another value.
                for turn in [
                    |m: &mut Material| m.youngs_modulus *= 1.0001,
                    |m: &mut Material| m.area *= 1.0001,
                    |m: &mut Material| m.mass_per_length *= 1.0001,
                ] {
                    let before = material;
                    turn(&mut material);
                    assert_eq!(Rope::of(&material), None, "{rope:?}");
                    material = before;
                }
            }
        }
        let paper = Material { youngs_modulus: 125e6, area: 5e-5, mass_per_length: 0.4, strain: Strain::Green };
        assert_eq!(Rope::of(&paper), None);
        assert_eq!(Rope::like(Construction::Rubber, 5e-5), rope(Construction::Rubber, 8.0));
    }
}
