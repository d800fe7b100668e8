//! The characteristic function on the imaginary axis, for many frequencies at few speeds.
//!
//! The search for crossings wants det Q(iω, v) along lines of constant v. There an inner node's own entry of Q in the
//! scalar problem is a quadratic in λ with real coefficients. Elimination needs the product of the node's two couplings
//! alone, which is a quartic. Both are prepared once per line. (Near λ = −1/β, where entries nearly vanish, expanded products
//! would lose digits; on the axis |1 + βλ| ≥ 1.) The planar problem has no such short form and is evaluated as anywhere.

use nalgebra::Complex;

use super::characteristic::{Characteristic, LogDeterminant};
use super::polynomial::{Quadratic, Quartic};

/// How many lines are kept: the two edges of a strip, one between them, and one elsewhere.
const KEPT: usize = 4;

/// An inner node at one speed.
#[derive(Clone, Copy, Debug)]
struct Node {
    own: Quadratic,
    coupling: Quartic,
}

/// All inner nodes at one speed.
#[derive(Debug)]
struct Line {
    speed: f64,
    /// When it was last used, in evaluations.
    used: u64,
    nodes: Vec<Node>,
}

/// A [`Characteristic`] on the imaginary axis, with the last lines prepared; no value allocates.
#[derive(Debug)]
pub(super) struct Axis {
    function: Characteristic,
    lines: [Line; KEPT],
    evaluations: u64,
}

impl Axis {
    pub(super) fn new(function: Characteristic) -> Self {
        let nodes = function.scalar_nodes();
        let line = || Line { speed: f64::NAN, used: 0, nodes: Vec::with_capacity(nodes) };
        Self { function, lines: std::array::from_fn(|_| line()), evaluations: 0 }
    }

    /// ln det Q(λ, v) with its derivatives, for λ = iω in 1/s and v in m/s; also elsewhere, though not faster.
    pub(super) fn at(&mut self, lambda: Complex<f64>, speed: f64) -> LogDeterminant {
        if lambda.re != 0.0 || self.lines[0].nodes.capacity() == 0 {
            return self.function.at(lambda, speed);
        }
        self.evaluations += 1;
        let omega = lambda.im;
        let place = self.lines.iter().position(|line| line.speed.to_bits() == speed.to_bits());
        let place = place.unwrap_or_else(|| self.prepare(speed));
        let line = &mut self.lines[place];
        line.used = self.evaluations;
        let square = omega * omega;
        let mut nodes = line.nodes.iter();
        let entries = || nodes.next().map(|node| [node.own.at(omega, square), node.coupling.at(omega, square)]);
        self.function.scalar_at(lambda, speed, entries)
    }

    /// Prepares a line in the place of the one that was not used for longest.
    fn prepare(&mut self, speed: f64) -> usize {
        let place =
            (1..KEPT).fold(0, |oldest, i| if self.lines[i].used < self.lines[oldest].used { i } else { oldest });
        let line = &mut self.lines[place];
        line.speed = speed;
        line.nodes.clear();
        let node = |[own, inward, outward]: [Quadratic; 3]| Node { own, coupling: inward.times(&outward) };
        line.nodes.extend(self.function.scalar_entries(speed).map(node));
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Linearisation, RobotSpec, paper_spec};
    use crate::stability::problems;

    /// The prepared lines give what the elimination gives anywhere in the plane.
    #[test]
    fn the_axis_is_part_of_the_plane() {
        for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
            let spec = RobotSpec { linearisation, ..paper_spec() };
            let function = Characteristic::new(&problems::of_robot(spec, [2.0, 0.5], [1.0, 0.4]));
            let mut axis = Axis::new(function.clone());
            for speed in [0.0, 3.0, 11.0, 3.0, 5.0, 6.0, 7.0, 3.0, 11.0] {
                for omega in [0.0, 0.7, 5.3, 30.0, 400.0] {
                    let (got, expected) =
                        (axis.at(Complex::new(0.0, omega), speed), function.at(Complex::new(0.0, omega), speed));
                    // Neighbouring pivots may be small, so a few digits more than rounding are lost.
                    for (got, expected) in [
                        (got.log, expected.log),
                        (got.by_lambda, expected.by_lambda),
                        (got.by_speed, expected.by_speed),
                    ] {
                        let error = (got - expected).norm();
                        assert!(
                            error <= 1e-10 * expected.norm().max(1.0),
                            "{linearisation:?} {omega} {speed}: {error}"
                        );
                    }
                }
            }
        }
    }
}
