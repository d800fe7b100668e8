//! The equations of a flight: M r̈ + C ṙ + `K_dyn` r + `f_el`(r; L) = weights − D (ṙ − `ṙ_qs`), D = αM + β`K_el`(`r_qs`).
//!
//! The unknowns are the platform and the inner nodes of all cables; winch nodes do not move. L, L̇ and L̈ are those of the
//! quasi-static motion, and so are `r_qs` and `ṙ_qs`. `f_el` follows each cable's own law, below its unstretched length
//! too. docs/theory.md section 14.

use nalgebra::{DVector, Matrix2};

use super::quasi_static::QuasiStatic;
use crate::mechanics::{Arrow, ArrowVector, Blocks, CableMotion, Element, Hub, Joint, Material, Matrices, Stiffness};
use crate::robot::{self, Damping, Linearisation, Robot, Vec2};

/// A vector over the platform and the inner nodes of all cables.
pub(super) type Nodes = ArrowVector<f64, 2>;

/// x + factor y.
pub(super) fn plus(x: &Nodes, factor: f64, y: &Nodes) -> Nodes {
    let mut sum = x.clone();
    add(&mut sum, factor, y);
    sum
}

/// Adds factor y to x.
pub(super) fn add(x: &mut Nodes, factor: f64, y: &Nodes) {
    x.hub.axpy(factor, &y.hub, 1.0);
    for (x, y) in x.chains.iter_mut().flatten().zip(y.chains.iter().flatten()) {
        *x += y * factor;
    }
}

/// The largest component, NaN where there is one.
pub(super) fn largest(x: &Nodes) -> f64 {
    let all = x.hub.iter().chain(x.chains.iter().flatten().flat_map(|node| node.iter()));
    all.fold(0.0, |largest: f64, &value| if value.abs() <= largest { largest } else { value.abs() })
}

/// The platform's part.
pub(super) fn platform(x: &Nodes) -> Vec2 {
    Vec2::new(x.hub[0], x.hub[1])
}

/// How the nodes are and move.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// r in m.
    pub positions: Nodes,
    /// ṙ in m/s.
    pub velocities: Nodes,
}

/// What does not change during a flight.
#[derive(Debug)]
pub(super) struct Equations {
    /// g in m/s².
    pub gravity: f64,
    /// α and β.
    pub damping: Damping,
    /// The cables.
    pub cables: Vec<Cable>,
    /// n.
    pub elements: usize,
    /// The platform.
    pub hub: Hub,
}

/// What does not change of a cable.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cable {
    /// The winch point in m.
    pub anchor: Vec2,
    /// N(λ).
    pub material: Material,
    /// μ in kg/m.
    pub mass_per_length: f64,
}

/// The matrices of a cable's elements at one time.
struct Link {
    /// M, C and `K_dyn` over the two nodes, and A/l of D.
    matrices: Matrices,
    /// l in m.
    length: f64,
    /// Half of the element's weight, μ g l/2, in N.
    half_weight: f64,
}

/// The equations at one time.
pub(super) struct Instant<'a> {
    equations: &'a Equations,
    links: Vec<Vec<Link>>,
    /// `ṙ_qs`.
    quasi_static: Nodes,
}

/// The two nodes of an element.
fn ends(first: Vec2, chain: &[Vec2], last: Vec2, k: usize) -> [Vec2; 2] {
    let inner = if k == 0 { first } else { chain.get(k - 1).copied().unwrap_or(last) };
    [inner, chain.get(k).copied().unwrap_or(last)]
}

impl Equations {
    /// Those of a robot.
    pub fn new(robot: &Robot) -> Self {
        let cable = |(i, cable): (usize, &robot::Cable)| Cable {
            anchor: cable.anchor,
            material: Material::of(robot, i),
            mass_per_length: robot.material_of(i).mass_per_length,
        };
        Self {
            gravity: robot.gravity,
            damping: robot.damping,
            cables: robot.cables.iter().enumerate().map(cable).collect(),
            elements: robot.elements,
            hub: Hub::point(robot.platform_mass, robot.cables.len()),
        }
    }

    fn joints(&self) -> &[Joint] {
        self.hub.joints()
    }

    /// A vector over the nodes, given what each cable has at its n + 1 nodes; the platform's is that of the first cable.
    fn nodes<'b>(&self, cables: &'b [CableMotion], of: impl Fn(&'b CableMotion) -> &'b [Vec2]) -> Nodes {
        let hub = cables.first().and_then(|cable| of(cable).first().copied()).unwrap_or_default();
        let inner = |cable| of(cable).get(1..self.elements).unwrap_or_default().to_vec();
        Nodes { hub: DVector::from_column_slice(hub.as_slice()), chains: cables.iter().map(inner).collect() }
    }

    /// The quasi-static state.
    pub fn start(&self, at: &QuasiStatic) -> State {
        State {
            positions: self.nodes(&at.cables, |cable| &cable.nodes),
            velocities: self.nodes(&at.cables, |cable| &cable.velocities),
        }
    }

    /// The equations at the time of `at`.
    pub fn at(&self, at: &QuasiStatic) -> Instant<'_> {
        let beta = self.damping.beta;
        let links = |(i, cable): (usize, &CableMotion)| {
            let n = self.elements as f64;
            let Cable { material, mass_per_length, .. } = self.cables[i];
            let [length, rate, acceleration] = cable.length.map(|value| value / n);
            let half_weight = 0.5 * mass_per_length * length * self.gravity;
            let link = |(k, &force): (usize, &Vec2)| {
                let stiffness = Stiffness::new(material, Linearisation::Tangent, force);
                let inflow = |rate: f64| [-(k as f64) * rate, -((k + 1) as f64) * rate];
                let element = Element::at_rest(mass_per_length, length, stiffness);
                let mut matrices = element.with_inflow(inflow(rate), inflow(acceleration)).matrices();
                matrices.elastic *= beta;
                Link { matrices, length, half_weight }
            };
            cable.forces.iter().enumerate().map(link).collect()
        };
        Instant {
            equations: self,
            links: at.cables.iter().enumerate().map(links).collect(),
            quasi_static: self.nodes(&at.cables, |cable| &cable.velocities),
        }
    }

    /// The vector from the inner to the outer node of each element of cable `i`.
    pub fn spans(&self, i: usize, positions: &Nodes) -> impl Iterator<Item = Vec2> {
        let hub = platform(positions);
        let (chain, anchor) = (&positions.chains[i], self.cables[i].anchor);
        (0..self.elements).map(move |k| {
            let [inner, outer] = ends(hub, chain, anchor, k);
            outer - inner
        })
    }

    /// The size of a displacement in m: the platform's that would have as much energy at the same frequency. The mass of an
    /// element counts at its outer node.
    pub fn size(&self, displacement: &Nodes, lengths: impl Fn(usize) -> f64) -> f64 {
        let n = self.elements as f64;
        let platform_mass = self.hub.platform_mass().unwrap_or(1.0);
        let cables = displacement.chains.iter().enumerate().map(|(i, chain)| {
            let mass = self.cables[i].mass_per_length * lengths(i) / n;
            mass * chain.iter().map(Vec2::norm_squared).sum::<f64>()
        });
        let platform = platform_mass * platform(displacement).norm_squared();
        ((platform + cables.sum::<f64>()) / platform_mass).sqrt()
    }

    /// N of an element of cable `i` in N, for the vector between its nodes and its unstretched length l.
    pub fn force(&self, i: usize, span: Vec2, length: f64) -> f64 {
        self.cables[i].material.force(span.norm() / length)
    }
}

impl Instant<'_> {
    /// What is left of the equations, M r̈ + C ṙ + `K_dyn` r + `f_el` − weights + D (ṙ − `ṙ_qs`), in N.
    pub fn residual(&self, state: &State, accelerations: &Nodes) -> Nodes {
        let Equations { gravity, damping, cables, hub, .. } = self.equations;
        let alpha = damping.alpha;
        let State { positions, velocities } = state;
        let deviating = plus(velocities, -1.0, &self.quasi_static);
        // αM (ṙ − ṙ_qs) joins M r̈.
        let inertial = plus(accelerations, alpha, &deviating);
        let mut residual = inertial.clone();
        residual.hub = hub.mass() * &inertial.hub;
        if let Some(mass) = hub.platform_mass() {
            residual.hub[1] += mass * gravity;
        }
        for (i, links) in self.links.iter().enumerate() {
            let first = |nodes: &Nodes| Vec2::from(&hub.joints()[i] * &nodes.hub);
            let [r0, v0, u0, a0] = [positions, velocities, &deviating, &inertial].map(first);
            let still = Vec2::zeros();
            let mut carried = still;
            let mut joint = still;
            for (k, link) in links.iter().enumerate() {
                let span = |nodes: &Nodes, first, last| {
                    let [inner, outer] = ends(first, &nodes.chains[i], last, k);
                    outer - inner
                };
                let d = span(positions, r0, cables[i].anchor);
                let rate = span(velocities, v0, still);
                let damped = link.matrices.elastic * span(&deviating, u0, still);
                let [inner, outer] = ends(a0, &inertial.chains[i], still, k);
                let size = d.norm();
                let pull = d * (cables[i].material.force(size / link.length) / size) + damped;
                let Matrices { mass, transfer, flow, .. } = link.matrices;
                let row = |j: usize| {
                    let mut force = inner * mass[(j, 0)] + outer * mass[(j, 1)];
                    force += rate * transfer[(j, 1)] + d * flow[(j, 1)];
                    force.y += link.half_weight;
                    force
                };
                // An element pulls its inner node outwards.
                let at_inner = carried + row(0) - pull;
                carried = row(1) + pull;
                match k.checked_sub(1).and_then(|node| residual.chains[i].get_mut(node)) {
                    Some(node) => *node = at_inner,
                    None => joint = at_inner,
                }
            }
            residual.hub += hub.joints()[i].tr_mul(&joint);
        }
        residual
    }

    /// The derivative of the residual in the accelerations where positions are g² and velocities g times these, and more:
    /// M + g (C + D) + g² (K + `K_dyn`), eliminated. K is the tangent at `positions`.
    pub fn matrix(&self, positions: &Nodes, g: f64) -> Arrow<f64, 2> {
        let Equations { damping, cables, hub, .. } = self.equations;
        let inertial = 1.0 + g * damping.alpha;
        let blocks: Vec<Vec<Blocks<f64, 2>>> = self
            .links
            .iter()
            .enumerate()
            .map(|(i, links)| {
                let of_link = |(link, d): (&Link, Vec2)| {
                    let size = d.norm();
                    let stretch = size / link.length;
                    let stiffness = Stiffness {
                        direction: d / size,
                        along: cables[i].material.tangent(stretch),
                        across: cables[i].material.force(stretch) / stretch,
                    };
                    let spring = stiffness.matrix() * (g * g / link.length) + link.matrices.elastic * g;
                    let Matrices { mass, transfer, flow, .. } = link.matrices;
                    let block = |a: usize, b: usize| {
                        let own = mass[(a, b)] * inertial + g * (transfer[(a, b)] + g * flow[(a, b)]);
                        let sign = if a == b { 1.0 } else { -1.0 };
                        Matrix2::from_diagonal_element(own) + spring * sign
                    };
                    [[block(0, 0), block(0, 1)], [block(1, 0), block(1, 1)]]
                };
                links.iter().zip(self.equations.spans(i, positions)).map(of_link).collect()
            })
            .collect();
        let chains = blocks.iter().map(Vec::as_slice).zip(self.equations.joints().iter().cloned());
        Arrow::factor(hub.mass() * inertial, chains, |blocks| *blocks)
    }

    /// The change of the velocities by an `impulse` on the platform in N s: M⁻¹ J.
    pub fn kicked(&self, positions: &Nodes, impulse: Vec2) -> Nodes {
        let mut right = plus(positions, -1.0, positions);
        right.hub.copy_from(&impulse);
        // Without time nothing but M is left.
        self.matrix(positions, 0.0).solve(&right)
    }
}
