//! The wave limit: the platform's speed at which the winch reels as fast as waves run along the cable.
//!
//! Seen from the mesh, material flows through element k (from 0 at the platform) with the inflow w = −(k + 1) L̇/n at its
//! outer end, where it is fastest. Transverse waves run against the material with c = √(N/(λ μ)), μ per unstretched
//! length and the law N(λ) those of the cable. Where |w| reaches c, no wave gets back to the platform any more.

use num_dual::Dual64;

use crate::mechanics::{CableShape, Element, LengthRates, Material, Statics, Vibration};
use crate::robot::{Robot, Vec2};

/// Limits that differ by less than this part are equal but for rounding.
const TOGETHER: f64 = 1e-9;

/// The wave limit of a pose along a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "compute", derive(serde::Serialize, serde::Deserialize))]
pub struct WaveLimit {
    /// The platform's speed in m/s.
    pub speed: f64,
    /// The cable that reaches it first, 0-based.
    pub cable: usize,
    /// Whether that cable is reeled in, L' < 0.
    pub reeled_in: bool,
}

/// The least speed over all elements of all cables at which the inflow is as fast as waves: c/|w|, c = √(N/(λ μ)) with
/// the element's force N and stretch λ, |w| = |L'| (k + 1)/n at unit speed, k from 0 at the platform.
///
/// `None` where no cable moves. Of cables that reach it together, as in a symmetric pose, one that is reeled in counts: along
/// it waves are what grows. O(n), from the statics and their `rates` along the motion alone.
pub fn wave_limit(robot: &Robot, statics: &Statics, rates: &[LengthRates]) -> Option<WaveLimit> {
    let elements = robot.elements as f64;
    let of_cable = |(cable, (shape, rate)): (usize, (&CableShape, &LengthRates))| {
        let (material, mass_per_length) = (Material::of(robot, cable), robot.material_of(cable).mass_per_length);
        let of_element = |(k, force): (usize, &Vec2)| {
            let force = force.norm();
            let wave = (force / (material.stretch(force) * mass_per_length)).sqrt();
            wave / (rate.first.abs() * (k + 1) as f64 / elements)
        };
        let speed = shape.forces.iter().enumerate().map(of_element).fold(f64::INFINITY, f64::min);
        // A cable at rest never gets there.
        speed.is_finite().then_some(WaveLimit { speed, cable, reeled_in: rate.first < 0.0 })
    };
    let limits: Vec<WaveLimit> = statics.cables.iter().zip(rates).enumerate().filter_map(of_cable).collect();
    let least = limits.iter().copied().min_by(|a, b| a.speed.total_cmp(&b.speed))?;
    let together = || limits.iter().filter(|limit| limit.speed <= least.speed * (1.0 + TOGETHER));
    let first = together().find(|limit| limit.reeled_in).or_else(|| together().next());
    Some(WaveLimit { speed: least.speed, ..*first.unwrap_or(&least) })
}

/// d ln v/d ln p of the wave limit v with respect to the parameter along which the dual numbers of `along` are
/// ([`Vibration::along`]); of the element that `limit` belongs to, exact.
///
/// Where elements of several cables reach it together, v has a kink, and this is the derivative of the limit's cable. `None`
/// where `limit` is not of this problem, or the derivative is not finite.
pub fn wave_limit_shift(along: &Vibration<Dual64>, limit: &WaveLimit) -> Option<f64> {
    let chain = along.chains().get(limit.cable)?;
    let square = |element: &Element<Dual64>| {
        // N/λ is the stiffness across the element.
        let inflow = element.inflow[1];
        element.stiffness.across / (element.mass_per_length * inflow * inflow)
    };
    let least = chain.elements().iter().map(square).min_by(|a, b| a.re.total_cmp(&b.re))?;
    Some(0.5 * least.eps / least.re).filter(|shift| shift.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{paper, paper_spec};

    /// A straight cable of the paper's robot with the axial force `tension`, without the weight's effect on its shape.
    fn straight(tension: f64) -> CableShape {
        let elements = paper_spec().elements;
        CableShape {
            t0: Vec2::new(tension, 0.0),
            length: 10.0,
            nodes: (0..=elements).map(|k| Vec2::new(k as f64, 0.0)).collect(),
            forces: vec![Vec2::new(tension, 0.0); elements],
            tension_at_platform: tension,
            tension_at_winch: tension,
        }
    }

    /// All elements carry the same force, so the last one, through which all of L̇ flows, decides: √(N/(λ μ))/|L'|. With
    /// Green's strain a stretch of 1.25 takes N = ½ EA (λ³ − λ) of EA = 6250 N.
    #[test]
    fn a_straight_cable_without_sag_has_the_limit_of_its_winch() {
        let robot = paper().expect("the paper's robot");
        let stretch = 1.25_f64;
        let tension = 0.5 * 6250.0 * (stretch.powi(3) - stretch);
        let wave = (tension / (stretch * 0.4)).sqrt();
        let statics = Statics { position: Vec2::zeros(), cables: vec![straight(tension), straight(4.0 * tension)] };
        let rate = |first| LengthRates { first, second: 0.0 };
        for (rates, speed, cable, reeled_in) in
            [([0.8, 0.1], wave / 0.8, 0, false), ([-0.8, 0.1], wave / 0.8, 0, true), ([-0.5, 0.0], wave / 0.5, 0, true)]
        {
            let found = wave_limit(&robot, &statics, &rates.map(rate)).expect("a limit");
            assert!((found.speed / speed - 1.0).abs() < 1e-12, "{found:?}, not {speed}");
            assert_eq!((found.cable, found.reeled_in), (cable, reeled_in));
        }
        // The tighter cable has the faster waves, so it has to move faster.
        let found = wave_limit(&robot, &statics, &[0.0, -0.2].map(rate)).expect("a limit");
        assert_eq!((found.cable, found.reeled_in), (1, true));
        assert_eq!(wave_limit(&robot, &statics, &[0.0, 0.0].map(rate)), None, "no cable moves");
        let alike = Statics { cables: vec![straight(tension); 3], ..statics };
        for (rates, cable) in [([0.8, -0.8, -0.1], 1), ([-0.1, 0.8, -0.8 + 1e-14], 2), ([0.1, 0.8, -0.7], 1)] {
            let found = wave_limit(&robot, &alike, &rates.map(rate)).expect("a limit");
            assert_eq!((found.cable, found.speed.to_bits()), (cable, (wave / 0.8).to_bits()), "{found:?}");
        }
    }
}
