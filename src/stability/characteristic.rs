//! The characteristic function det Q(λ, v) with its derivatives, by one elimination pass along the cables.
//!
//! Q(λ, v) = λ² M + λ (v C + αM + βK) + K + v² D is block tridiagonal along each cable, and the cables meet only in the
//! platform's block. Eliminating from the winches to the platform leaves the determinant as the product of the pivots'
//! determinants, in O(n) and without a matrix. The derivatives in λ and in v go along with every operation.
//! docs/theory.md section 11.
//!
//! An isotropic problem is that of one direction twice; its characteristic function here is that of one direction, so
//! that simple eigenvalues stay simple.

use nalgebra::{Complex, Matrix2};

use super::jet::{Jet, Planar};
use crate::mechanics::{Element, Hub, Vibration};

type C64 = Complex<f64>;

/// So many cables are eliminated side by side: each step waits for the one before it in its own cable only.
const SIDE_BY_SIDE: usize = 4;

/// ln det Q and its derivatives at one (λ, v).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogDeterminant {
    /// ln |det Q| + i arg det Q, the argument in (−π, π]. SI units: only differences mean anything.
    pub log: C64,
    /// ∂ ln det Q/∂λ, in s: 1/(λ − λⱼ) summed over all eigenvalues.
    pub by_lambda: C64,
    /// ∂ ln det Q/∂v, in s/m.
    pub by_speed: C64,
}

/// The characteristic function of a [`Vibration`], prepared for many evaluations; none of them allocates.
#[derive(Clone, Debug)]
pub struct Characteristic {
    alpha: f64,
    beta: f64,
    /// The platform's mass in kg; `None` where the hub does not move.
    platform: Option<f64>,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    Scalar { nodes: Vec<Node>, hub: Sum },
    Planar { nodes: Vec<PlanarNode>, hub: PlanarSum },
}

/// Coefficients of one entry of Q over M, C and D.
#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    mass: f64,
    transfer: f64,
    flow: f64,
}

/// An entry with its part of K.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    entry: Entry,
    elastic: f64,
}

/// An inner node of the scalar problem: its own entry and its coupling to the node on the platform's side.
#[derive(Clone, Copy, Debug)]
struct Node {
    own: Sum,
    inward: Sum,
    outward: Sum,
    place: Place,
}

/// Where an inner node is.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Which of the cables that are eliminated side by side.
    slot: usize,
    /// Whether the node on the platform's side is the hub.
    last: bool,
}

/// A block s I₂ + k with k symmetric, k = [[t + x, y], [y, t − x]].
#[derive(Clone, Copy, Debug, Default)]
struct PlanarSum {
    entry: Entry,
    elastic: [f64; 3],
}

/// An inner node of the planar problem. The coupling is diagonal in the basis of its element, turned by θ.
#[derive(Clone, Copy, Debug)]
struct PlanarNode {
    own: PlanarSum,
    inward: Entry,
    outward: Entry,
    /// The two eigenvalues of the coupling element's A/l.
    elastic: [f64; 2],
    /// cos 2θ and sin 2θ.
    turn: [f64; 2],
    place: Place,
}

impl Characteristic {
    /// Prepares the coefficients.
    pub fn new(vibration: &Vibration) -> Self {
        let platform = match vibration.hub {
            Hub::Platform(mass) => Some(mass),
            Hub::Fixed => None,
        };
        let mut scalar = Vec::with_capacity(vibration.nodes());
        let mut planar = Vec::with_capacity(vibration.nodes());
        for group in vibration.chains.chunks(SIDE_BY_SIDE) {
            let longest = group.iter().map(|chain| chain.elements.len()).max().unwrap_or(0);
            for k in (1..longest).rev() {
                for (slot, chain) in group.iter().enumerate().filter(|(_, chain)| k < chain.elements.len()) {
                    let (coupling, outer) = (&chain.elements[k - 1], &chain.elements[k]);
                    let place = Place { slot, last: k == 1 };
                    if vibration.isotropic {
                        scalar.push(Node::new(coupling, outer, place));
                    } else {
                        planar.push(PlanarNode::new(coupling, outer, place));
                    }
                }
            }
        }
        let hub = vibration.chains.iter().map(|chain| PlanarSum::of(&chain.elements[0], 0));
        let hub = hub.fold(PlanarSum::default(), PlanarSum::plus);
        let kind = if vibration.isotropic {
            Kind::Scalar { nodes: scalar, hub: Sum { entry: hub.entry, elastic: hub.elastic[0] } }
        } else {
            Kind::Planar { nodes: planar, hub }
        };
        Self { alpha: vibration.damping.alpha, beta: vibration.damping.beta, platform, kind }
    }

    /// ln det Q(λ, v) with its derivatives, for λ in 1/s and v in m/s. Not finite where an elimination step meets a
    /// singular pivot.
    pub fn at(&self, lambda: C64, speed: f64) -> LogDeterminant {
        let point = Point::new(self.alpha, self.beta, lambda, speed);
        let mut product = Product::default();
        match &self.kind {
            Kind::Scalar { nodes, hub } => {
                let mut platform = point.sum(hub);
                let mut outer = [Jet::default(); SIDE_BY_SIDE];
                for node in nodes {
                    let outer = &mut outer[node.place.slot];
                    let pivot = point.sum(&node.own) - *outer;
                    let inverse = product.take(pivot);
                    *outer = point.sum(&node.inward) * point.sum(&node.outward) * inverse;
                    if node.place.last {
                        platform = platform - std::mem::take(outer);
                    }
                }
                if let Some(mass) = self.platform {
                    product.take(platform + point.mass * mass);
                }
            }
            Kind::Planar { nodes, hub } => {
                let mut platform = point.planar(hub);
                let mut outer = [Planar::default(); SIDE_BY_SIDE];
                for node in nodes {
                    let outer = &mut outer[node.place.slot];
                    let pivot = (point.planar(&node.own) - *outer).turned(node.turn[0], node.turn[1]);
                    let inverse = product.take(pivot.determinant());
                    let entries = [point.entry(&node.inward), point.entry(&node.outward)];
                    let [elastic_1, elastic_2] = node.elastic.map(|k| point.elastic * k);
                    let inward = [(entries[0] - elastic_1) * inverse, (entries[0] - elastic_2) * inverse];
                    let outward = [entries[1] - elastic_1, entries[1] - elastic_2];
                    *outer = pivot.adjugate_between(inward, outward).turned(node.turn[0], -node.turn[1]);
                    if node.place.last {
                        platform = platform - std::mem::take(outer);
                    }
                }
                if let Some(mass) = self.platform {
                    platform.t = platform.t + point.mass * mass;
                    product.take(platform.determinant());
                }
            }
        }
        product.finish()
    }
}

/// k = [[t + x, y], [y, t − x]].
fn parts(k: &Matrix2<f64>) -> [f64; 3] {
    [0.5 * (k[(0, 0)] + k[(1, 1)]), 0.5 * (k[(0, 0)] - k[(1, 1)]), 0.5 * (k[(0, 1)] + k[(1, 0)])]
}

impl Entry {
    fn of(element: &Element, i: usize, j: usize) -> Self {
        Self { mass: element.mass[(i, j)], transfer: element.transfer[(i, j)], flow: element.flow[(i, j)] }
    }
}

impl Node {
    /// The node between its element on the platform's side and the one on the winch's side.
    fn new(coupling: &Element, outer: &Element, place: Place) -> Self {
        let own = PlanarSum::of(coupling, 1).plus(PlanarSum::of(outer, 0));
        let elastic = -coupling.elastic[(0, 0)];
        let [inward, outward] = [(0, 1), (1, 0)].map(|(i, j)| Sum { entry: Entry::of(coupling, i, j), elastic });
        Self { own: Sum { entry: own.entry, elastic: own.elastic[0] }, inward, outward, place }
    }
}

impl PlanarNode {
    /// The same with both directions.
    fn new(coupling: &Element, outer: &Element, place: Place) -> Self {
        let own = PlanarSum::of(coupling, 1).plus(PlanarSum::of(outer, 0));
        let [t, x, y] = parts(&coupling.elastic);
        let radius = x.hypot(y);
        let turn = if radius > 0.0 { [x / radius, y / radius] } else { [1.0, 0.0] };
        let [inward, outward] = [(0, 1), (1, 0)].map(|(i, j)| Entry::of(coupling, i, j));
        Self { own, inward, outward, elastic: [t + radius, t - radius], turn, place }
    }
}

impl PlanarSum {
    fn of(element: &Element, i: usize) -> Self {
        Self { entry: Entry::of(element, i, i), elastic: parts(&element.elastic) }
    }

    fn plus(self, other: Self) -> Self {
        let (a, b) = (self.entry, other.entry);
        let entry = Entry { mass: a.mass + b.mass, transfer: a.transfer + b.transfer, flow: a.flow + b.flow };
        let [t, x, y] = self.elastic;
        Self { entry, elastic: [t + other.elastic[0], x + other.elastic[1], y + other.elastic[2]] }
    }
}

/// What multiplies M, C, D and K in Q at one (λ, v).
struct Point {
    /// λ² + αλ.
    mass: Jet,
    /// λ v.
    transfer: Jet,
    /// v², and its derivative in v.
    flow: [f64; 2],
    /// 1 + βλ.
    elastic: Jet,
}

impl Point {
    fn new(alpha: f64, beta: f64, lambda: C64, speed: f64) -> Self {
        let zero = C64::new(0.0, 0.0);
        let mass = Jet { value: lambda * (lambda + alpha), by_lambda: lambda * 2.0 + alpha, by_speed: zero };
        let transfer = Jet { value: lambda * speed, by_lambda: speed.into(), by_speed: lambda };
        let elastic = Jet { value: lambda * beta + 1.0, by_lambda: beta.into(), by_speed: zero };
        Self { mass, transfer, flow: [speed * speed, 2.0 * speed], elastic }
    }

    fn entry(&self, of: &Entry) -> Jet {
        let (mass, transfer) = (&self.mass, &self.transfer);
        Jet {
            value: mass.value * of.mass + transfer.value * of.transfer + self.flow[0] * of.flow,
            by_lambda: mass.by_lambda * of.mass + transfer.by_lambda * of.transfer,
            by_speed: transfer.by_speed * of.transfer + self.flow[1] * of.flow,
        }
    }

    fn elastic(&self, k: f64) -> Jet {
        // 1 + βλ does not depend on v.
        let elastic = &self.elastic;
        Jet { value: elastic.value * k, by_lambda: elastic.by_lambda * k, by_speed: C64::new(0.0, 0.0) }
    }

    fn sum(&self, of: &Sum) -> Jet {
        self.entry(&of.entry) + self.elastic(of.elastic)
    }

    fn planar(&self, of: &PlanarSum) -> Planar {
        let [t, x, y] = of.elastic.map(|k| self.elastic(k));
        Planar { t: self.entry(&of.entry) + t, w: Jet::default(), x, y }
    }
}

/// The product of the pivots' determinants: mantissa, logarithm of what was taken out of it, and derivatives.
struct Product {
    mantissa: C64,
    log: f64,
    by_lambda: C64,
    by_speed: C64,
}

impl Default for Product {
    fn default() -> Self {
        let zero = C64::new(0.0, 0.0);
        Self { mantissa: 1.0.into(), log: 0.0, by_lambda: zero, by_speed: zero }
    }
}

impl Product {
    /// A mantissa outside 1e-60..1e60 is normalised, so that one more factor cannot leave the range.
    const LARGE: f64 = 1e120;

    /// Multiplies by `factor`, and gives 1/`factor`.
    #[inline]
    fn take(&mut self, factor: Jet) -> Jet {
        self.mantissa *= factor.value;
        let size = self.mantissa.norm_sqr();
        if !(size < Self::LARGE && size > 1.0 / Self::LARGE) {
            let norm = size.sqrt();
            self.mantissa /= norm;
            self.log += norm.ln();
        }
        let value = factor.value.inv();
        let (by_lambda, by_speed) = (factor.by_lambda * value, factor.by_speed * value);
        self.by_lambda += by_lambda;
        self.by_speed += by_speed;
        Jet { value, by_lambda: -by_lambda * value, by_speed: -by_speed * value }
    }

    fn finish(self) -> LogDeterminant {
        let log = C64::new(self.mantissa.norm().ln() + self.log, self.mantissa.arg());
        LogDeterminant { log, by_lambda: self.by_lambda, by_speed: self.by_speed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Linearisation, Motion, Robot, paper_spec};
    use crate::stability::Eigenproblem;
    use crate::study::Local;

    fn local(linearisation: Linearisation, elements: usize) -> Local {
        let robot = Robot::new(crate::robot::RobotSpec { elements, linearisation, ..paper_spec() }).unwrap();
        Local::new(&robot, &Motion::new([2.0, 0.5], [1.0, 0.4], 5.0).unwrap()).unwrap()
    }

    /// The logarithmic derivative in λ is the sum of 1/(λ − λⱼ) over the dense solver's eigenvalues.
    #[test]
    fn the_derivative_is_the_sum_over_the_eigenvalues() {
        for (linearisation, elements) in
            [(Linearisation::Tangent, 10), (Linearisation::Secant, 10), (Linearisation::Tangent, 2)]
        {
            let local = local(linearisation, elements);
            let function = Characteristic::new(&local.vibration);
            for speed in [0.0, 4.0, 13.0] {
                let spectrum = Eigenproblem::new(&local.vibration).unwrap().spectrum(speed).unwrap();
                let each = if local.vibration.isotropic { 2 } else { 1 };
                for lambda in [C64::new(0.3, 1.0), C64::new(-0.2, 7.0), C64::new(2.0, 0.0), C64::new(0.0, 20.0)] {
                    let expected: C64 = spectrum.eigenvalues().step_by(each).map(|l| (lambda - l).inv()).sum();
                    let value = function.at(lambda, speed);
                    let error = (value.by_lambda - expected).norm();
                    assert!(error < 1e-7 * expected.norm().max(1.0), "{linearisation:?} {speed} {lambda}: {error}");
                }
            }
        }
    }

    /// Both derivatives are those of the value, by central differences.
    #[test]
    fn derivatives_are_those_of_the_value() {
        for linearisation in [Linearisation::Tangent, Linearisation::Secant] {
            let function = Characteristic::new(&local(linearisation, 7).vibration);
            let (lambda, speed, h) = (C64::new(0.1, 3.0), 6.0, 1e-5);
            let value = function.at(lambda, speed);
            let slope = |a: LogDeterminant, b: LogDeterminant| {
                let difference = b.log - a.log;
                let turns = (difference.im / std::f64::consts::TAU).round();
                (difference - C64::new(0.0, turns * std::f64::consts::TAU)) / (2.0 * h)
            };
            let by_lambda = slope(function.at(lambda - h, speed), function.at(lambda + h, speed));
            let by_speed = slope(function.at(lambda, speed - h), function.at(lambda, speed + h));
            assert!((by_lambda - value.by_lambda).norm() < 1e-6 * value.by_lambda.norm(), "{linearisation:?}");
            assert!((by_speed - value.by_speed).norm() < 1e-6 * value.by_speed.norm(), "{linearisation:?}");
        }
    }

    /// The product stays in range where the determinant itself does not.
    #[test]
    fn the_range_of_floating_point_is_no_limit() {
        let function = Characteristic::new(&local(Linearisation::Tangent, 200).vibration);
        let value = function.at(C64::new(1e3, 1e4), 3.0);
        assert!(value.log.re > 800.0 && value.log.re.is_finite(), "{value:?}");
    }
}
