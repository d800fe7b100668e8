//! What the elements tell of the modes without solving for them: estimates of the undamped frequencies, and the sum of
//! all eigenvalues.

use std::f64::consts::PI;

use nalgebra::{Const, DMatrix, Dyn, Matrix1, Matrix2, OMatrix};
use num_dual::Dual64;

use crate::mechanics::{Arrow, Chain, Element, Vibration};

/// Cables that are equal have estimates that differ by parts of this, so that each leads to an eigenvalue of its own.
const APART: f64 = 0.02;

/// An estimate of ω̂² (1/s²) for every mode of (K, M), those of one direction where the problem is isotropic: of each
/// cable as a uniform string with fixed ends, along and across, and of the platform on springs.
///
/// With θ = jπ/n such a string of n elements has ω̂² = 6 (k/m) (1 − cos θ)/(2 + cos θ), k/m the square of n over the
/// sum of sqrt(m/k) over the elements: waves travel as long as in the cable.
pub(super) fn squares(vibration: &Vibration) -> Vec<f64> {
    let directions = if vibration.isotropic { 1 } else { 2 };
    let mut squares = Vec::with_capacity(directions * vibration.nodes());
    let (mut stiffness, mut mass) = (Matrix2::zeros(), 0.0);
    // A Weyl sequence: no two of its values are near each other.
    let mut golden = 0.0_f64;
    for chain in &vibration.chains {
        let n = chain.elements().len() as f64;
        for direction in 0..directions {
            golden = (golden + 0.618_033_988_749_895).fract();
            let travel: f64 = chain.elements().iter().map(|e| (e.total_mass() / springs(e)[direction]).sqrt()).sum();
            let uniform = (n / travel).powi(2) * (1.0 + APART * (golden - 0.5));
            squares.extend((1..chain.elements().len()).map(|j| {
                let cosine = (PI * j as f64 / n).cos();
                6.0 * uniform * (1.0 - cosine) / (2.0 + cosine)
            }));
        }
        stiffness += chain.stiffness_in_series();
        mass += chain.elements().iter().map(Element::total_mass).sum::<f64>() / 3.0;
    }
    if let Some(platform) = vibration.hub.platform_mass() {
        let springs = stiffness.symmetric_eigenvalues() / (platform + mass);
        squares.extend(springs.iter().take(directions));
    }
    squares
}

/// A frequency (rad/s) that no undamped mode exceeds: that of the stiffest element by itself.
pub(super) fn largest_frequency(vibration: &Vibration) -> f64 {
    let elements = vibration.chains.iter().flat_map(Chain::elements);
    elements.map(|e| 12.0 * springs(e)[1] / e.total_mass()).fold(0.0, f64::max).sqrt()
}

/// The traces of M⁻¹ K (1/s²) and of M⁻¹ C (1/m), of one direction where the problem is isotropic.
///
/// tr M⁻¹ X = d ln det (M + ε X)/dε at ε = 0. M couples no directions, so that K enters by the trace of its blocks.
pub(super) fn traces(vibration: &Vibration) -> [f64; 2] {
    let directions = if vibration.isotropic { 1.0 } else { 2.0 };
    let elastic = |e: &Element| {
        let [along, across] = e.springs();
        let k = if vibration.isotropic { across } else { along + across };
        Matrix2::new(k, -k, -k, k)
    };
    [trace(vibration, elastic), trace(vibration, |e| e.transfer() * directions)]
}

/// The trace of M⁻¹ X for one direction, X given per element.
fn trace(vibration: &Vibration, of: impl Fn(&Element) -> Matrix2<f64>) -> f64 {
    let platform: Vec<Dual64> = vibration.hub.platform_mass().into_iter().map(Dual64::from).collect();
    let joint = OMatrix::<Dual64, Const<1>, Dyn>::identity(platform.len());
    let chains = vibration.chains.iter().map(|chain| (chain.elements(), joint.clone()));
    let blocks = |e: &Element| {
        let (mass, x) = (e.mass(), of(e));
        [0, 1].map(|i| [0, 1].map(|j| Matrix1::new(Dual64::new(mass[(i, j)], x[(i, j)]))))
    };
    Arrow::factor(DMatrix::from_diagonal(&platform.into()), chains, blocks).log_det().eps
}

/// The element's stiffnesses along and across in N/m, the smaller one first.
fn springs(element: &Element) -> [f64; 2] {
    let [along, across] = element.springs();
    [along.min(across), along.max(across)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::Hub;
    use crate::robot::{Damping, Linearisation, RobotSpec, paper_spec};
    use crate::stability::{Eigenproblem, problems};

    /// Straight cables of (unstretched length, tension).
    fn straight(cables: &[[f64; 2]], hub: Hub, linearisation: Linearisation) -> Vibration {
        let chain = |&[length, tension]: &[f64; 2]| problems::straight(7, length, tension, [0.0; 2], linearisation);
        Vibration {
            chains: cables.iter().map(chain).collect(),
            hub,
            damping: Damping { alpha: 0.0, beta: 0.0 },
            isotropic: linearisation == Linearisation::Secant,
        }
    }

    /// Of uniform cables with fixed ends the estimates are right but for what keeps equal ones apart, and differ.
    #[test]
    fn estimates_for_uniform_cables_are_right() {
        for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
            let vibration = straight(&[[3.0, 90.0], [11.0, 40.0], [11.0, 40.0]], Hub::fixed(3), linearisation);
            let sorted = |mut squares: Vec<f64>| {
                squares.sort_by(f64::total_cmp);
                squares
            };
            let exact = sorted(Eigenproblem::new(&vibration).unwrap().undamped_squares());
            let estimates = sorted(squares(&vibration));
            assert_eq!(exact.len(), estimates.len());
            for (estimate, exact) in estimates.iter().zip(&exact) {
                assert!((estimate / exact - 1.0).abs() < 0.51 * APART, "{estimate} {exact}");
            }
            assert!(estimates.windows(2).all(|pair| pair[1] > pair[0] * (1.0 + 1e-4)), "{estimates:?}");
        }
    }

    /// A heavy platform on light cables is a mass on springs in series along each cable, to a third of their mass.
    #[test]
    fn the_estimate_for_the_platform_is_right() {
        for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
            let vibration = straight(&[[3.0, 90.0], [11.0, 40.0]], Hub::point(1e4, 2), linearisation);
            let exact = Eigenproblem::new(&vibration).unwrap().undamped_squares();
            let lowest = exact.iter().copied().fold(f64::INFINITY, f64::min);
            let estimates = squares(&vibration);
            let estimate = estimates.iter().copied().fold(f64::INFINITY, f64::min);
            assert!((estimate / lowest - 1.0).abs() < 1e-5, "{estimate} {lowest}");
            let light = straight(&[[3.0, 90.0], [11.0, 40.0]], Hub::point(0.0, 2), linearisation);
            let ratio = *estimates.last().unwrap() / squares(&light).last().unwrap();
            let third = 0.4 * 14.0 / 3.0;
            assert!((ratio / (third / (1e4 + third)) - 1.0).abs() < 1e-12, "{ratio}");
        }
    }

    /// The sums of the dense solver's eigenvalues, and its largest frequency.
    #[test]
    fn traces_are_the_sums_of_the_eigenvalues() {
        for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
            let spec = RobotSpec { elements: 7, linearisation, ..paper_spec() };
            let (vibration, damping) = (problems::of_robot(spec.clone(), [2.0, 0.5], [1.0, 0.4]), spec.damping);
            let dense = Eigenproblem::new(&vibration).unwrap();
            let squares = dense.undamped_squares();
            let [elastic, transfer] = traces(&vibration);
            let sum: f64 = squares.iter().sum();
            assert!((elastic - sum).abs() < 1e-10 * sum, "{elastic} {sum}");
            let each = if vibration.isotropic { 2.0 } else { 1.0 };
            let speed = 3.0;
            let damping = damping.alpha * squares.len() as f64 + damping.beta * sum + speed * transfer;
            let total: f64 = dense.spectrum(speed).unwrap().eigenvalues().map(|l| l.re).sum();
            assert!((total / each + damping).abs() < 1e-9 * damping, "{total} {damping}");
            let largest = squares.iter().copied().fold(0.0, f64::max).sqrt();
            assert!((largest..2.0 * largest).contains(&largest_frequency(&vibration)));
            assert_eq!(super::squares(&vibration).len(), squares.len());
            // The largest entry of a matrix is at most its largest eigenvalue, and at least that over its size.
            assert!((largest / (squares.len() as f64).sqrt()..=largest).contains(&dense.scale()), "{}", dense.scale());
        }
    }
}
