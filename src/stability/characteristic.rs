//! The characteristic function det Q(λ, v) with its derivatives, by one elimination pass along the cables.
//!
//! Q(λ, v) = λ² M + λ (v C + αM + βK) + K + v² D is block tridiagonal along each cable, and the cables meet only in the
//! platform's block. Eliminating from the winches to the platform leaves the determinant as the product of the pivots'
//! determinants, in O(n) and without a matrix. The derivatives in λ and in v go along with every operation.
//! docs/theory.md section 11.
//!
//! This is the elimination of [`crate::mechanics::Arrow`] once more, for the sake of speed: the search evaluates it a
//! thousand times. Here two cables go through it side by side, a coupling is diagonal in the basis of its element, and
//! nothing is kept for solutions. ARCHITECTURE.md has the figures.
//!
//! An isotropic problem is that of one direction twice; its characteristic function here is that of one direction, so
//! that simple eigenvalues stay simple.

use nalgebra::{Complex, Matrix2};

use super::jet::{Jet, Number, Pair, Planar, Real};
use super::polynomial::Quadratic;
use crate::mechanics::{Chain, Element, Vibration};

type C64 = Complex<f64>;

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
    Scalar { sides: Vec<SideBySide<Node>>, hub: Sum<f64> },
    Planar { sides: Vec<SideBySide<PlanarNode>>, hub: PlanarSum<f64> },
}

/// Two cables of the same length that are eliminated side by side; the second may be there for symmetry only.
#[derive(Clone, Debug)]
struct SideBySide<N> {
    /// From the winches to the platform.
    nodes: Vec<N>,
    /// How many of the two count.
    cables: usize,
}

/// Coefficients of one entry of Q over M, C and D.
#[derive(Clone, Copy, Debug, Default)]
struct Entry<R> {
    mass: R,
    transfer: R,
    flow: R,
}

/// An entry with its part of K.
#[derive(Clone, Copy, Debug, Default)]
struct Sum<R> {
    entry: Entry<R>,
    elastic: R,
}

/// An inner node of the scalar problem: its own entry and its coupling to the node on the platform's side.
#[derive(Clone, Copy, Debug)]
struct Node {
    own: Sum<Pair>,
    inward: Sum<Pair>,
    outward: Sum<Pair>,
}

/// A block s I₂ + k with k symmetric, k = [[t + x, y], [y, t − x]].
#[derive(Clone, Copy, Debug, Default)]
struct PlanarSum<R> {
    entry: Entry<R>,
    elastic: [R; 3],
}

/// An inner node of the planar problem. The coupling is diagonal in the basis of its element, turned by θ.
#[derive(Clone, Copy, Debug)]
struct PlanarNode {
    own: PlanarSum<Pair>,
    inward: Entry<Pair>,
    outward: Entry<Pair>,
    /// The two eigenvalues of the coupling element's A/l.
    elastic: [Pair; 2],
    /// cos 2θ and sin 2θ.
    turn: [Pair; 2],
}

impl Characteristic {
    /// Prepares the coefficients.
    pub fn new(vibration: &Vibration) -> Self {
        let platform = vibration.hub.platform_mass();
        let hub = vibration.chains.iter().map(|chain| PlanarSum::<f64>::of(&Prepared::new(&chain.elements()[0]), 0));
        let hub = hub.fold(PlanarSum::default(), PlanarSum::plus);
        let kind = if vibration.isotropic {
            Kind::Scalar {
                sides: side_by_side(vibration, Node::new),
                hub: Sum { entry: hub.entry, elastic: hub.elastic[0] },
            }
        } else {
            Kind::Planar { sides: side_by_side(vibration, PlanarNode::new), hub }
        };
        Self { alpha: vibration.damping.alpha, beta: vibration.damping.beta, platform, kind }
    }

    /// ln det Q(λ, v) with its derivatives, for λ in 1/s and v in m/s. Not finite where an elimination step meets a
    /// singular pivot.
    pub fn at(&self, lambda: C64, speed: f64) -> LogDeterminant {
        let point = Point::new(self.alpha, self.beta, lambda, speed);
        let mut total = Total::default();
        match &self.kind {
            Kind::Scalar { sides, .. } => {
                let mut nodes = sides.iter().flat_map(|side| &side.nodes);
                let entries = |node: &Node| [point.sum(&node.own), point.sum(&node.inward) * point.sum(&node.outward)];
                return self.scalar_at(lambda, speed, || nodes.next().map(entries));
            }
            Kind::Planar { sides, hub } => {
                let mut platform = point.planar(hub);
                for SideBySide { nodes, cables } in sides {
                    let mut product = Product::default();
                    let mut outer = Planar::default();
                    for node in nodes {
                        let pivot = (point.planar(&node.own) - outer).turned(node.turn[0], node.turn[1]);
                        let inverse = product.take(pivot.determinant());
                        let entries = [point.entry(&node.inward), point.entry(&node.outward)];
                        let [elastic_1, elastic_2] = node.elastic.map(|k| point.elastic(k));
                        let inward = [(entries[0] - elastic_1) * inverse, (entries[0] - elastic_2) * inverse];
                        let outward = [entries[1] - elastic_1, entries[1] - elastic_2];
                        outer = pivot.adjugate_between(inward, outward).turned(node.turn[0], -node.turn[1]);
                    }
                    for lane in 0..*cables {
                        platform = platform - outer.lane(lane);
                        total.multiply(&product.lane(lane));
                    }
                }
                if let Some(mass) = self.platform {
                    platform.t = platform.t + point.mass * mass;
                    total.take(platform.determinant());
                }
            }
        }
        total.finish()
    }

    /// How many nodes the scalar problem has, two cables' nodes counted as one; 0 for the planar problem.
    pub(super) fn scalar_nodes(&self) -> usize {
        match &self.kind {
            Kind::Scalar { sides, .. } => sides.iter().map(|side| side.nodes.len()).sum(),
            Kind::Planar { .. } => 0,
        }
    }

    /// Of each node of the scalar problem at a speed: its own entry, and its couplings to and from the node on the platform's
    /// side. The planar problem has none.
    pub(super) fn scalar_entries(&self, speed: f64) -> impl Iterator<Item = [Quadratic; 3]> {
        let sides = match &self.kind {
            Kind::Scalar { sides, .. } => sides.as_slice(),
            Kind::Planar { .. } => &[],
        };
        let quadratic = move |&Sum { entry: Entry { mass, transfer, flow }, elastic }: &Sum<Pair>| Quadratic {
            value: [elastic + flow * (speed * speed), mass * self.alpha + transfer * speed + elastic * self.beta, mass],
            by_speed: [flow * (2.0 * speed), transfer],
        };
        let all = sides.iter().flat_map(|side| &side.nodes);
        all.map(move |node| [&node.own, &node.inward, &node.outward].map(quadratic))
    }

    /// The scalar problem's value. `next` gives each node's own entry and the product of its couplings, in their order.
    #[inline]
    pub(super) fn scalar_at(
        &self,
        lambda: C64,
        speed: f64,
        mut next: impl FnMut() -> Option<[Jet<Pair>; 2]>,
    ) -> LogDeterminant {
        let point = Point::new(self.alpha, self.beta, lambda, speed);
        let mut total = Total::default();
        let Kind::Scalar { sides, hub } = &self.kind else { return total.finish() };
        let mut platform = point.sum(hub);
        for SideBySide { nodes, cables } in sides {
            let mut product = Product::default();
            let mut outer = Jet::default();
            for [own, coupling] in (0..nodes.len()).map_while(|_| next()) {
                outer = coupling * product.take(own - outer);
            }
            for lane in 0..*cables {
                platform = platform - outer.lane(lane);
                total.multiply(&product.lane(lane));
            }
        }
        if let Some(mass) = self.platform {
            total.take(platform + point.mass * mass);
        }
        total.finish()
    }
}

/// The cables in twos of the same length, as nodes made from two elements each: the one on the platform's side and the
/// one on the winch's side.
fn side_by_side<N>(vibration: &Vibration, node: impl Fn([&Prepared; 2], [&Prepared; 2]) -> N) -> Vec<SideBySide<N>> {
    let prepared = |chain: &Chain| chain.elements().iter().map(Prepared::new).collect();
    let chains: Vec<Vec<Prepared>> = vibration.chains.iter().map(prepared).collect();
    let mut chains = chains.as_slice();
    let mut sides = Vec::new();
    while let [first, rest @ ..] = chains {
        let second = rest.first().filter(|second| second.len() == first.len());
        let cables = if second.is_some() { 2 } else { 1 };
        let both = [first, second.unwrap_or(first)];
        let at = |k: usize| both.map(|chain| &chain[k]);
        let nodes = (1..first.len()).rev().map(|k| node(at(k - 1), at(k))).collect();
        sides.push(SideBySide { nodes, cables });
        chains = &chains[cables..];
    }
    sides
}

/// What the elimination needs of an element.
struct Prepared {
    mass: Matrix2<f64>,
    transfer: Matrix2<f64>,
    flow: Matrix2<f64>,
    /// The stiffnesses along the element and across it, in N/m.
    springs: [f64; 2],
    /// cos 2θ and sin 2θ of the element's angle θ.
    turn: [f64; 2],
}

impl Prepared {
    fn new(element: &Element) -> Self {
        let e = element.stiffness.direction;
        Self {
            mass: element.mass(),
            transfer: element.transfer(),
            flow: element.flow_stiffness(),
            springs: element.springs(),
            turn: [e.x * e.x - e.y * e.y, 2.0 * e.x * e.y],
        }
    }

    /// A/l = [[t + x, y], [y, t − x]].
    fn elastic(&self) -> [f64; 3] {
        let [along, across] = self.springs;
        let radius = 0.5 * (along - across);
        [0.5 * (along + across), radius * self.turn[0], radius * self.turn[1]]
    }
}

/// One quantity of two elements.
fn pair(elements: [&Prepared; 2], of: impl Fn(&Prepared) -> f64) -> Pair {
    Pair(elements.map(of))
}

impl Entry<Pair> {
    fn of(elements: [&Prepared; 2], i: usize, j: usize) -> Self {
        Self {
            mass: pair(elements, |e| e.mass[(i, j)]),
            transfer: pair(elements, |e| e.transfer[(i, j)]),
            flow: pair(elements, |e| e.flow[(i, j)]),
        }
    }
}

impl Node {
    fn new(coupling: [&Prepared; 2], outer: [&Prepared; 2]) -> Self {
        let own = PlanarSum::<Pair>::of_both(coupling, 1).plus(PlanarSum::<Pair>::of_both(outer, 0));
        let elastic = pair(coupling, |e| -e.springs[1]);
        let [inward, outward] = [(0, 1), (1, 0)].map(|(i, j)| Sum { entry: Entry::of(coupling, i, j), elastic });
        Self { own: Sum { entry: own.entry, elastic: own.elastic[0] }, inward, outward }
    }
}

impl PlanarNode {
    fn new(coupling: [&Prepared; 2], outer: [&Prepared; 2]) -> Self {
        let own = PlanarSum::<Pair>::of_both(coupling, 1).plus(PlanarSum::<Pair>::of_both(outer, 0));
        let [inward, outward] = [(0, 1), (1, 0)].map(|(i, j)| Entry::of(coupling, i, j));
        Self {
            own,
            inward,
            outward,
            elastic: [0, 1].map(|i| pair(coupling, |e| e.springs[i])),
            turn: [0, 1].map(|i| pair(coupling, |e| e.turn[i])),
        }
    }
}

impl PlanarSum<f64> {
    fn of(element: &Prepared, i: usize) -> Self {
        let entry =
            Entry { mass: element.mass[(i, i)], transfer: element.transfer[(i, i)], flow: element.flow[(i, i)] };
        Self { entry, elastic: element.elastic() }
    }
}

impl PlanarSum<Pair> {
    fn of_both(elements: [&Prepared; 2], i: usize) -> Self {
        let elastic = [0, 1, 2].map(|part| pair(elements, |e| e.elastic()[part]));
        Self { entry: Entry::of(elements, i, i), elastic }
    }
}

impl<R: Real> PlanarSum<R> {
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
    mass: Jet<f64>,
    /// λ v; its derivatives are v and λ.
    transfer: C64,
    lambda: C64,
    speed: f64,
    /// 1 + βλ; it does not depend on v.
    elastic: C64,
    beta: f64,
}

impl Point {
    fn new(alpha: f64, beta: f64, lambda: C64, speed: f64) -> Self {
        let (value, slope) = (lambda * (lambda + alpha), lambda * 2.0 + alpha);
        let mass = Jet { value: value.into(), by_lambda: slope.into(), by_speed: Number::default() };
        Self { mass, transfer: lambda * speed, lambda, speed, elastic: lambda * beta + 1.0, beta }
    }

    #[inline]
    fn entry<R: Real>(&self, of: &Entry<R>) -> Jet<R> {
        let Jet { value: mass, by_lambda: slope, .. } = self.mass;
        let &Entry { mass: m, transfer: c, flow: d } = of;
        Jet {
            value: Number {
                re: m * mass.re + c * self.transfer.re + d * (self.speed * self.speed),
                im: m * mass.im + c * self.transfer.im,
            },
            by_lambda: Number { re: m * slope.re + c * self.speed, im: m * slope.im },
            by_speed: Number { re: c * self.lambda.re + d * (2.0 * self.speed), im: c * self.lambda.im },
        }
    }

    #[inline]
    fn elastic<R: Real>(&self, k: R) -> Jet<R> {
        Jet {
            value: Number { re: k * self.elastic.re, im: k * self.elastic.im },
            by_lambda: Number { re: k * self.beta, im: R::default() },
            by_speed: Number::default(),
        }
    }

    #[inline]
    fn sum<R: Real>(&self, of: &Sum<R>) -> Jet<R> {
        self.entry(&of.entry) + self.elastic(of.elastic)
    }

    #[inline]
    fn planar<R: Real>(&self, of: &PlanarSum<R>) -> Planar<R> {
        let [t, x, y] = of.elastic.map(|k| self.elastic(k));
        Planar { t: self.entry(&of.entry) + t, w: Jet::default(), x, y }
    }
}

/// The product of the pivots' determinants of two cables. It is kept as a mantissa, the logarithm of the factors that were
/// taken out of the mantissa, and the logarithmic derivatives.
struct Product {
    mantissa: Number<Pair>,
    log: [f64; 2],
    by_lambda: Number<Pair>,
    by_speed: Number<Pair>,
}

impl Default for Product {
    fn default() -> Self {
        let zero = Number::default();
        let mantissa = Number { re: Pair([1.0; 2]), im: Pair::default() };
        Self { mantissa, log: [0.0; 2], by_lambda: zero, by_speed: zero }
    }
}

impl Product {
    /// A mantissa outside 1e-60..1e60 is normalised, so that one more factor cannot leave the range.
    const LARGE: f64 = 1e120;

    /// Multiplies by `factor`, and gives 1/`factor`.
    #[inline]
    fn take(&mut self, factor: Jet<Pair>) -> Jet<Pair> {
        self.mantissa = self.mantissa * factor.value;
        let Pair(sizes) = self.mantissa.norm_sqr();
        if !sizes.iter().all(|&size| size < Self::LARGE && size > 1.0 / Self::LARGE) {
            self.normalise(sizes);
        }
        let Pair(sizes) = factor.value.norm_sqr();
        let reciprocal = Pair(sizes.map(f64::recip));
        let value = Number { re: factor.value.re * reciprocal, im: -(factor.value.im * reciprocal) };
        let (by_lambda, by_speed) = (factor.by_lambda * value, factor.by_speed * value);
        self.by_lambda = self.by_lambda + by_lambda;
        self.by_speed = self.by_speed + by_speed;
        Jet { value, by_lambda: -by_lambda * value, by_speed: -by_speed * value }
    }

    /// Takes the mantissas' sizes, given squared, out of them.
    #[cold]
    fn normalise(&mut self, sizes: [f64; 2]) {
        let norms = sizes.map(f64::sqrt);
        self.mantissa = self.mantissa * Pair(norms.map(f64::recip));
        for (log, norm) in self.log.iter_mut().zip(norms) {
            *log += norm.ln();
        }
    }

    /// The part of one of the two cables.
    fn lane(&self, lane: usize) -> Total {
        Total {
            mantissa: self.mantissa.lane(lane),
            log: self.log[lane],
            by_lambda: self.by_lambda.lane(lane),
            by_speed: self.by_speed.lane(lane),
        }
    }
}

/// The same for one cable, and for all of them and the platform together.
struct Total {
    mantissa: C64,
    log: f64,
    by_lambda: C64,
    by_speed: C64,
}

impl Default for Total {
    fn default() -> Self {
        let zero = C64::new(0.0, 0.0);
        Self { mantissa: 1.0.into(), log: 0.0, by_lambda: zero, by_speed: zero }
    }
}

impl Total {
    fn multiply(&mut self, factor: &Self) {
        self.mantissa *= factor.mantissa;
        let size = self.mantissa.norm_sqr();
        if !(size < Product::LARGE && size > 1.0 / Product::LARGE) {
            let norm = size.sqrt();
            self.mantissa /= norm;
            self.log += norm.ln();
        }
        self.log += factor.log;
        self.by_lambda += factor.by_lambda;
        self.by_speed += factor.by_speed;
    }

    fn take(&mut self, factor: Jet<f64>) {
        let [mantissa, by_lambda, by_speed] =
            [factor.value, factor.by_lambda, factor.by_speed].map(|number| C64::new(number.re, number.im));
        let (by_lambda, by_speed) = (by_lambda / mantissa, by_speed / mantissa);
        self.multiply(&Self { mantissa, log: 0.0, by_lambda, by_speed });
    }

    fn finish(self) -> LogDeterminant {
        let log = C64::new(0.5 * self.mantissa.norm_sqr().ln() + self.log, self.mantissa.arg());
        LogDeterminant { log, by_lambda: self.by_lambda, by_speed: self.by_speed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Linearisation, RobotSpec, paper_spec};
    use crate::stability::{Eigenproblem, problems};

    fn problem(linearisation: Linearisation, elements: usize) -> Vibration {
        problems::of_robot(RobotSpec { elements, linearisation, ..paper_spec() }, [2.0, 0.5], [1.0, 0.4])
    }

    /// The logarithmic derivative in λ is the sum of 1/(λ − λⱼ) over the dense solver's eigenvalues.
    #[test]
    fn the_derivative_is_the_sum_over_the_eigenvalues() {
        for (linearisation, elements) in
            [(Linearisation::Tangent, 10), (Linearisation::Secant, 10), (Linearisation::Tangent, 2)]
        {
            let vibration = problem(linearisation, elements);
            let function = Characteristic::new(&vibration);
            for speed in [0.0, 4.0, 13.0] {
                let spectrum = Eigenproblem::new(&vibration).unwrap().spectrum(speed).unwrap();
                let each = if vibration.isotropic { 2 } else { 1 };
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
            let function = Characteristic::new(&problem(linearisation, 7));
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
        let function = Characteristic::new(&problem(Linearisation::Tangent, 200));
        let value = function.at(C64::new(1e3, 1e4), 3.0);
        assert!(value.log.re > 800.0 && value.log.re.is_finite(), "{value:?}");
    }
}
