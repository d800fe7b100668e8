//! Mode shapes and where their kinetic energy is, by inverse iteration along the cables.
//!
//! Q(λ) = λ² M + λ (v C + αM + βK) + K + v² D is block tridiagonal along each cable, and the cables meet only in the
//! platform's block. [`Arrow`] eliminates it from the winches to the platform, at a cost of O(n) per solve.
//! docs/theory.md section 11.

use nalgebra::{Complex, DVector, Matrix2, Vector2};

use crate::mechanics::{Arrow, ArrowVector, Chain, Element, Joint, Matrices, Vibration};
use crate::robot::Damping;
use crate::stability::{TIE_OF_SHARES, first_largest};

type C64 = Complex<f64>;
/// Two complex displacements, x and y.
pub type Displacement = Vector2<C64>;

/// Relative distance from λ at which Q is factored: near enough to single the mode out, far enough from Q being
/// singular to rounding.
const SHIFT: f64 = 1e-11;
/// Solves per mode; the second removes what the start vector left of other modes.
const ITERATIONS: usize = 3;
/// The inverse of a larger number, or of a smaller one than the reciprocal, may leave the range of floating point.
const LARGE: f64 = 1e75;

/// Which of the two equal directions of an isotropic problem to look at; elsewhere only a start for the iteration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Polarisation {
    /// Along x.
    X,
    /// Along y.
    #[default]
    Y,
}

/// A mode shape q(t) = Re(a q e^{λt}).
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// λ in 1/s.
    pub eigenvalue: C64,
    /// Complex displacements of the n + 1 nodes of each cable, from the platform to the winch (which is at rest). The
    /// largest component of all is 1.
    pub displacement: Vec<Vec<Displacement>>,
    /// Each cable's share of the kinetic energy q* M q.
    pub cable_share: Vec<f64>,
    /// The platform's share; all shares add up to 1.
    pub platform_share: f64,
}

impl Mode {
    /// The cable with the largest share of the kinetic energy, 0-based. Where shares are equal but for rounding, the first
    /// of these cables counts.
    pub fn responsible_cable(&self) -> usize {
        first_largest(self.cable_share.iter().copied(), TIE_OF_SHARES).unwrap_or(0)
    }
}

/// The mode of the eigenvalue nearest to `eigenvalue` (1/s) at `speed` (m/s).
///
/// Of several equal eigenvalues it gives one of their shapes: along `polarisation` where the problem is isotropic. Where
/// the shape leaves the range of floating point, all displacements and shares are zero.
pub fn mode(vibration: &Vibration, speed: f64, eigenvalue: C64, polarisation: Polarisation) -> Mode {
    let mut shape = Shape::nearest(vibration, speed, eigenvalue, polarisation, Arrow::solve);
    let (platform, cables) = shape.energies(vibration);
    let total = platform + cables.iter().sum::<f64>();
    let known = total.is_normal();
    if !known {
        shape.clear();
    }
    let share = |energy: f64| if known { energy / total } else { 0.0 };
    Mode {
        eigenvalue,
        platform_share: share(platform),
        cable_share: cables.into_iter().map(share).collect(),
        displacement: shape.per_cable(vibration),
    }
}

/// The left eigenvector y, with yᵀ Q(λ) = 0, of the eigenvalue nearest to `eigenvalue` (1/s) at `speed` (m/s): of the n + 1
/// nodes of each cable, as [`Mode::displacement`]. It belongs to the shape that [`mode`] gives along `polarisation`.
pub(super) fn left_shape(
    vibration: &Vibration,
    speed: f64,
    eigenvalue: C64,
    polarisation: Polarisation,
) -> Vec<Vec<Displacement>> {
    Shape::nearest(vibration, speed, eigenvalue, polarisation, Arrow::solve_transposed).per_cable(vibration)
}

/// The cable with the largest share of the mode's kinetic energy, 0-based. In a symmetric pose shares are equal but for
/// rounding. There the first of these cables that is reeled in counts, or else the first.
pub(super) fn responsible_cable(vibration: &Vibration, mode: &Mode) -> usize {
    let first = mode.responsible_cable();
    let reeled_in = |chain: &Chain| {
        let [platform, winch] = chain.elements()[0].inflow;
        winch > platform
    };
    let least = mode.cable_share.get(first).map_or(0.0, |share| share - TIE_OF_SHARES);
    let tie = |&i: &usize| mode.cable_share[i] >= least && vibration.chains.get(i).is_some_and(reeled_in);
    (0..mode.cable_share.len()).find(tie).unwrap_or(first)
}

/// A frequency of the problem, so that a zero eigenvalue has something to be small against.
pub(super) fn frequency_scale(vibration: &Vibration) -> f64 {
    let element = &vibration.chains[0].elements()[0];
    1e-3 * (element.elastic().amax() / element.mass().amax()).sqrt()
}

/// Displacements of the hub and of the chains' inner nodes.
#[derive(Clone, Debug)]
struct Shape(ArrowVector<C64, 2>);

/// Q(λ) at `speed` (m/s), eliminated.
fn factor(vibration: &Vibration, speed: f64, lambda: C64) -> Arrow<C64, 2> {
    let Damping { alpha, beta } = vibration.damping;
    let hub =
        vibration.hub.mass().map(|m| (lambda * lambda + lambda * alpha) * m) + vibration.hub.stiffness().map(C64::from);
    let joints = vibration.hub.joints().iter().map(|joint| joint.map(C64::from));
    let damped = lambda * beta + 1.0;
    Arrow::factor(hub, vibration.chains.iter().map(Chain::elements).zip(joints), |element| {
        let Matrices { mass, transfer, flow, elastic } = element.matrices();
        let elastic = elastic.map(|entry| damped * entry);
        [0, 1].map(|i| {
            [0, 1].map(|j| {
                let scalar = lambda * lambda * mass[(i, j)]
                    + lambda * (speed * transfer[(i, j)] + alpha * mass[(i, j)])
                    + speed * speed * flow[(i, j)];
                let scalar = Matrix2::from_diagonal_element(scalar);
                if i == j { elastic + scalar } else { scalar - elastic }
            })
        })
    })
}

impl Shape {
    /// The shape of the eigenvalue nearest to `eigenvalue`, by inverse iteration with the eliminated Q and `solve`.
    fn nearest(
        vibration: &Vibration,
        speed: f64,
        eigenvalue: C64,
        polarisation: Polarisation,
        solve: impl Fn(&Arrow<C64, 2>, &ArrowVector<C64, 2>) -> ArrowVector<C64, 2>,
    ) -> Self {
        let size = eigenvalue.norm().max(frequency_scale(vibration));
        let shift = Complex::new(SHIFT, 0.7 * SHIFT) * size;
        let factors = factor(vibration, speed, eigenvalue + shift);
        let mut shape = Self::start(vibration, polarisation);
        for _ in 0..ITERATIONS {
            shape = Self(solve(&factors, &shape.0));
            shape.normalise();
        }
        shape
    }

    /// A start vector with some of every mode: neither smooth nor symmetric.
    fn start(vibration: &Vibration, polarisation: Polarisation) -> Self {
        let mut seed = 0_u32;
        let mut next = || {
            // A Weyl sequence of the golden ratio; its values in 0.5..1.5 never repeat a pattern.
            seed += 1;
            0.5 + (f64::from(seed) * 0.618_033_988_749_895).fract()
        };
        let isotropic = vibration.isotropic;
        let mut displacement = || {
            let (a, b) = (next(), next());
            let (x, y) = match (isotropic, polarisation) {
                (true, Polarisation::X) => (a, 0.0),
                (true, Polarisation::Y) => (0.0, b),
                (false, Polarisation::X) => (a, -b),
                (false, Polarisation::Y) => (a, b),
            };
            Displacement::new(x.into(), y.into())
        };
        let dof = vibration.hub.dof();
        let hub: Vec<C64> = (0..dof.div_ceil(2)).flat_map(|_| <[C64; 2]>::from(displacement())).take(dof).collect();
        let chains = vibration.chains.iter().map(|c| (0..c.inner_nodes()).map(|_| displacement()).collect()).collect();
        Self(ArrowVector { hub: DVector::from_vec(hub), chains })
    }

    fn values(&self) -> impl Iterator<Item = &C64> {
        self.0.hub.iter().chain(self.0.chains.iter().flatten().flat_map(|d| d.iter()))
    }

    /// Makes the largest component 1.
    fn normalise(&mut self) {
        let largest = |shape: &Self| shape.values().copied().max_by(|a, b| a.norm().total_cmp(&b.norm()));
        // The inverse has the square in it.
        let size = largest(self).map_or(1.0, C64::norm);
        if !(1.0 / LARGE..=LARGE).contains(&size) {
            self.scale(C64::from(1.0 / size));
        }
        self.scale(largest(self).map_or(C64::from(1.0), |largest| largest.inv()));
    }

    fn scale(&mut self, factor: C64) {
        self.0.hub *= factor;
        self.0.chains.iter_mut().flatten().for_each(|d| *d *= factor);
    }

    /// Zero everywhere, also where it was not finite.
    fn clear(&mut self) {
        self.0.hub.fill(C64::from(0.0));
        self.0.chains.iter_mut().flatten().for_each(|d| *d = Displacement::zeros());
    }

    /// Displacements of all n + 1 nodes of each cable.
    fn per_cable(&self, vibration: &Vibration) -> Vec<Vec<Displacement>> {
        let nodes = |(inner, joint): (&Vec<Displacement>, &Joint)| {
            let first = joint.map(C64::from) * &self.0.hub;
            std::iter::once(first).chain(inner.iter().copied()).chain([Displacement::zeros()]).collect()
        };
        self.0.chains.iter().zip(vibration.hub.joints()).map(nodes).collect()
    }

    /// q* M q of the platform and of each cable.
    fn energies(&self, vibration: &Vibration) -> (f64, Vec<f64>) {
        let hub = &self.0.hub;
        let platform = hub.dotc(&(vibration.hub.mass().map(C64::from) * hub)).re;
        let cable = |(chain, nodes): (&Chain, Vec<Displacement>)| {
            let element = |(k, element): (usize, &Element)| {
                let (a, b, mass) = (nodes[k], nodes[k + 1], element.mass());
                mass[(0, 0)] * a.norm_squared() + mass[(1, 1)] * b.norm_squared() + 2.0 * mass[(0, 1)] * a.dotc(&b).re
            };
            chain.elements().iter().enumerate().map(element).sum()
        };
        (platform, vibration.chains.iter().zip(self.per_cable(vibration)).map(cable).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::paper_spec;
    use crate::stability::problems;

    #[test]
    fn a_shape_out_of_range_is_zero() {
        let vibration = problems::of_robot(paper_spec(), [2.0, 0.0], [1.0, 0.0]);
        let mode = mode(&vibration, 5.0, C64::new(0.0, 1e200), Polarisation::default());
        assert!(mode.displacement.iter().flatten().all(|d| *d == Displacement::zeros()), "{mode:?}");
        assert_eq!((mode.platform_share, mode.cable_share), (0.0, vec![0.0; 4]));
    }

    #[test]
    fn the_largest_component_becomes_one() {
        for size in [1e-300, 1e-90, 1e-3, 1.0, 1e3, 1e90, 1e300].map(|size| C64::from_polar(size, 0.7)) {
            let d = |x: f64, y: f64| Displacement::new(size * x, size * y);
            let hub = DVector::from_vec(<[C64; 2]>::from(d(0.1, 0.2)).to_vec());
            let mut shape = Shape(ArrowVector { hub, chains: vec![vec![d(0.3, -1.0)], vec![d(0.0, 0.5)]] });
            shape.normalise();
            let expected = [0.1, 0.2, 0.3, -1.0, 0.0, 0.5].map(|part| C64::from(-part));
            let found: Vec<C64> = shape.values().copied().collect();
            assert_eq!(found.len(), expected.len());
            let error = found.iter().zip(expected).map(|(found, part)| (found - part).norm()).fold(0.0, f64::max);
            assert!(error < 1e-14, "{size:e}: {shape:?}");
        }
    }
}
