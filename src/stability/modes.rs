//! Mode shapes and where their kinetic energy is, by inverse iteration along the cables.
//!
//! Q(λ) = λ² M + λ (v C + αM + βK) + K + v² D is block tridiagonal along each cable, and the cables meet only in the
//! platform's block. Eliminating from the winches to the platform and substituting back costs O(n) per solve.
//! docs/theory.md section 11.

use nalgebra::{Complex, Matrix2, Vector2};

use crate::mechanics::{Chain, Element, Hub, Vibration};
use crate::stability::{TIE_OF_SHARES, first_largest};

type C64 = Complex<f64>;
/// Two complex displacements, x and y.
pub type Displacement = Vector2<C64>;

/// Relative distance from λ at which Q is factored: near enough to single the mode out, far enough from Q being
/// singular to rounding.
const SHIFT: f64 = 1e-11;
/// Solves per mode; the second removes what the start vector left of other modes.
const ITERATIONS: usize = 3;
/// An inverse has fourth powers in it: those of larger numbers, and of smaller ones than the reciprocal, leave the range
/// of floating point.
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
    /// The cable with the largest share of the kinetic energy, 0-based; the first of those that have it but for rounding.
    pub fn responsible_cable(&self) -> usize {
        first_largest(self.cable_share.iter().copied(), TIE_OF_SHARES).unwrap_or(0)
    }
}

/// The mode of the eigenvalue nearest to `eigenvalue` (1/s) at `speed` (m/s).
///
/// Of several equal eigenvalues it gives one of their shapes: along `polarisation` where the problem is isotropic. Where
/// the shape leaves the range of floating point, all displacements and shares are zero.
pub fn mode(vibration: &Vibration, speed: f64, eigenvalue: C64, polarisation: Polarisation) -> Mode {
    let size = eigenvalue.norm().max(frequency_scale(vibration));
    let shift = Complex::new(SHIFT, 0.7 * SHIFT) * size;
    let factors = Factors::new(vibration, speed, eigenvalue + shift);
    let mut shape = start(vibration, polarisation);
    for _ in 0..ITERATIONS {
        shape = factors.solve(&shape);
        shape.normalise();
    }
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
        displacement: shape.per_cable(),
    }
}

/// The cable with the largest share of the mode's kinetic energy, 0-based. Of those that have it but for rounding, as in a
/// symmetric pose, the first one that is reeled in counts, or the first.
pub(super) fn responsible_cable(vibration: &Vibration, mode: &Mode) -> usize {
    let first = mode.responsible_cable();
    // On the diagonal of an element's C is w₀ − w₁ times μ/3 in all: how fast it gets shorter.
    let reeled_in = |chain: &Chain| chain.elements()[0].transfer.trace() > 0.0;
    let least = mode.cable_share.get(first).map_or(0.0, |share| share - TIE_OF_SHARES);
    let tie = |&i: &usize| mode.cable_share[i] >= least && vibration.chains.get(i).is_some_and(reeled_in);
    (0..mode.cable_share.len()).find(tie).unwrap_or(first)
}

/// A frequency of the problem, so that a zero eigenvalue has something to be small against.
pub(super) fn frequency_scale(vibration: &Vibration) -> f64 {
    let element = &vibration.chains[0].elements()[0];
    1e-3 * (element.elastic.amax() / element.mass.amax()).sqrt()
}

/// Displacements of the hub and of the chains' inner nodes.
#[derive(Clone, Debug)]
struct Shape {
    hub: Displacement,
    hub_moves: bool,
    inner: Vec<Vec<Displacement>>,
}

/// A start vector with some of every mode: neither smooth nor symmetric.
fn start(vibration: &Vibration, polarisation: Polarisation) -> Shape {
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
    let hub_moves = matches!(vibration.hub, Hub::Platform(_));
    let hub = if hub_moves { displacement() } else { Displacement::zeros() };
    let inner = vibration.chains.iter().map(|c| (0..c.inner_nodes()).map(|_| displacement()).collect()).collect();
    Shape { hub, hub_moves, inner }
}

/// An element's part of Q(λ): the block between its nodes i and j.
fn block(vibration: &Vibration, element: &Element, speed: f64, lambda: C64, i: usize, j: usize) -> Matrix2<C64> {
    let sign = if i == j { 1.0 } else { -1.0 };
    let damping = vibration.damping;
    let scalar = lambda * lambda * element.mass[(i, j)]
        + lambda * (speed * element.transfer[(i, j)] + damping.alpha * element.mass[(i, j)])
        + speed * speed * element.flow[(i, j)];
    let elastic = (lambda * damping.beta + 1.0) * sign;
    element.elastic.map(|a| elastic * a) + Matrix2::identity() * scalar
}

/// Q(λ) eliminated from the winches to the hub.
struct Factors<'a> {
    vibration: &'a Vibration,
    speed: f64,
    lambda: C64,
    hub: Matrix2<C64>,
    /// Inverse pivots of the inner nodes of each chain.
    pivots: Vec<Vec<Matrix2<C64>>>,
}

impl<'a> Factors<'a> {
    fn new(vibration: &'a Vibration, speed: f64, lambda: C64) -> Self {
        let block = |element: &Element, i, j| block(vibration, element, speed, lambda, i, j);
        let mut hub = match vibration.hub {
            Hub::Platform(mass) => Matrix2::identity() * ((lambda * lambda + lambda * vibration.damping.alpha) * mass),
            Hub::Fixed => Matrix2::identity(),
        };
        let mut pivots = Vec::with_capacity(vibration.chains.len());
        for elements in vibration.chains.iter().map(Chain::elements) {
            // Pivot of inner node k: its own block less what the eliminated outer node adds.
            let mut chain_pivots = vec![Matrix2::zeros(); elements.len() - 1];
            let mut outer = Matrix2::zeros();
            for k in (1..elements.len()).rev() {
                let own = block(&elements[k - 1], 1, 1) + block(&elements[k], 0, 0) - outer;
                let inverse = invert(own);
                chain_pivots[k - 1] = inverse;
                outer = block(&elements[k - 1], 0, 1) * inverse * block(&elements[k - 1], 1, 0);
            }
            if matches!(vibration.hub, Hub::Platform(_)) {
                hub += block(&elements[0], 0, 0) - outer;
            }
            pivots.push(chain_pivots);
        }
        Self { vibration, speed, lambda, hub: invert(hub), pivots }
    }

    /// x with Q x = `right`.
    fn solve(&self, right: &Shape) -> Shape {
        let block = |element: &Element, i, j| block(self.vibration, element, self.speed, self.lambda, i, j);
        let mut x = right.clone();
        for ((chain, pivots), x_chain) in self.vibration.chains.iter().zip(&self.pivots).zip(&mut x.inner) {
            for k in (1..chain.elements().len()).rev() {
                let reduced = block(&chain.elements()[k - 1], 0, 1) * pivots[k - 1] * x_chain[k - 1];
                match k {
                    1 => x.hub -= reduced,
                    _ => x_chain[k - 2] -= reduced,
                }
            }
        }
        x.hub = if x.hub_moves { self.hub * x.hub } else { Displacement::zeros() };
        for ((chain, pivots), x_chain) in self.vibration.chains.iter().zip(&self.pivots).zip(&mut x.inner) {
            let mut inner = x.hub;
            for k in 1..chain.elements().len() {
                let reduced = x_chain[k - 1] - block(&chain.elements()[k - 1], 1, 0) * inner;
                inner = pivots[k - 1] * reduced;
                x_chain[k - 1] = inner;
            }
        }
        x
    }
}

/// The inverse, of a matrix nudged off singularity where it is singular to rounding.
fn invert(matrix: Matrix2<C64>) -> Matrix2<C64> {
    let size = matrix.iter().fold(0.0_f64, |size, part| size.max(part.re.abs()).max(part.im.abs()));
    if size > LARGE || (size > 0.0 && size < 1.0 / LARGE) {
        // Part by part: a complex quotient has the square of the size in it.
        return invert(matrix.map(|entry| entry / size)).map(|entry| entry / size);
    }
    matrix.try_inverse().unwrap_or_else(|| {
        let nudge = matrix.map(C64::norm).amax().max(f64::MIN_POSITIVE) * f64::EPSILON;
        (matrix + Matrix2::identity() * C64::from(nudge)).try_inverse().unwrap_or_else(Matrix2::identity)
    })
}

impl Shape {
    fn values(&self) -> impl Iterator<Item = &C64> {
        self.hub.iter().chain(self.inner.iter().flatten().flat_map(|d| d.iter()))
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
        self.hub *= factor;
        self.inner.iter_mut().flatten().for_each(|d| *d *= factor);
    }

    /// Zero everywhere, also where it was not finite.
    fn clear(&mut self) {
        self.hub = Displacement::zeros();
        self.inner.iter_mut().flatten().for_each(|d| *d = Displacement::zeros());
    }

    /// Displacements of all n + 1 nodes of each cable.
    fn per_cable(&self) -> Vec<Vec<Displacement>> {
        let ends = |inner: &Vec<Displacement>| {
            std::iter::once(self.hub).chain(inner.iter().copied()).chain([Displacement::zeros()]).collect()
        };
        self.inner.iter().map(ends).collect()
    }

    /// q* M q of the platform and of each cable.
    fn energies(&self, vibration: &Vibration) -> (f64, Vec<f64>) {
        let platform = match vibration.hub {
            Hub::Platform(mass) => mass * self.hub.norm_squared(),
            Hub::Fixed => 0.0,
        };
        let cable = |(chain, nodes): (&Chain, Vec<Displacement>)| {
            let element = |(k, element): (usize, &Element)| {
                let (a, b) = (nodes[k], nodes[k + 1]);
                element.mass[(0, 0)] * a.norm_squared()
                    + element.mass[(1, 1)] * b.norm_squared()
                    + 2.0 * element.mass[(0, 1)] * a.dotc(&b).re
            };
            chain.elements().iter().enumerate().map(element).sum()
        };
        (platform, vibration.chains.iter().zip(self.per_cable()).map(cable).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Motion, paper};
    use crate::study::Local;

    #[test]
    fn inverses_are_found_over_the_whole_range_of_floating_point() {
        let number = C64::new;
        let matrix = Matrix2::new(number(2.0, 1.0), number(0.5, -3.0), number(-1.0, 0.0), number(4.0, 2.0));
        let inverse = matrix.try_inverse().unwrap();
        for size in [1e-300, 1e-160, 1e-80, 1.0, 1e80, 1e160, 1e300] {
            let found = invert(matrix * C64::from(size)) * C64::from(size);
            assert!((found - inverse).norm() < 1e-14 * inverse.norm(), "{size:e}: {found} instead of {inverse}");
        }
    }

    /// What a singular matrix leaves of a vector is its null vector, the larger the nearer to singular.
    #[test]
    fn of_a_singular_matrix_the_null_vector_is_left() {
        let number = |x: f64| C64::new(x, 0.0);
        for size in [1e-40, 1.0, 1e40] {
            let left = invert(Matrix2::repeat(number(size))) * Displacement::new(number(size), number(0.0));
            assert!(left.norm() > 1e12, "{left}");
            assert!((left / left.x - Displacement::new(number(1.0), number(-1.0))).norm() < 1e-12, "{left}");
        }
    }

    #[test]
    fn a_shape_out_of_range_is_zero() {
        let robot = paper().unwrap();
        let local = Local::new(&robot, &Motion::new([2.0, 0.0], [1.0, 0.0], 5.0).unwrap()).unwrap();
        let mode = mode(&local.vibration, 5.0, C64::new(0.0, 1e200), Polarisation::default());
        assert!(mode.displacement.iter().flatten().all(|d| *d == Displacement::zeros()), "{mode:?}");
        assert_eq!((mode.platform_share, mode.cable_share), (0.0, vec![0.0; 4]));
    }

    #[test]
    fn the_largest_component_becomes_one() {
        for size in [1e-300, 1e-90, 1e-3, 1.0, 1e3, 1e90, 1e300].map(|size| C64::from_polar(size, 0.7)) {
            let d = |x: f64, y: f64| Displacement::new(size * x, size * y);
            let mut shape =
                Shape { hub: d(0.1, 0.2), hub_moves: true, inner: vec![vec![d(0.3, -1.0)], vec![d(0.0, 0.5)]] };
            shape.normalise();
            let expected = [0.1, 0.2, 0.3, -1.0, 0.0, 0.5].map(|part| C64::from(-part));
            let found: Vec<C64> = shape.values().copied().collect();
            assert_eq!(found.len(), expected.len());
            let error = found.iter().zip(expected).map(|(found, part)| (found - part).norm()).fold(0.0, f64::max);
            assert!(error < 1e-14, "{size:e}: {shape:?}");
        }
    }
}
