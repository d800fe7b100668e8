//! Where an eigenvalue can cross the imaginary axis at all.
//!
//! Let λ = iω with vector x, x*Mx = 1, ω̂² = x*Kx. The cables' interpolation makes M, C and D integrals over linear
//! functions, so the Cauchy–Schwarz inequality holds for them exactly. With w the flow and ẇ its rate at v = 1:
//!
//! - the symmetric part of C is (L'ᵢ/Lᵢ) Mᵢ per cable: Re x*Cx ≥ −r, r = max(0, −L'ᵢ/Lᵢ);
//! - D = D₁ − D₂ with D₂ ≥ 0, |x*Cx|² ≤ 4 x*D₂x (but for that symmetric part), x*D₂x ≤ s² ω̂², s = max |w|/c, where
//!   c = sqrt(N/(λ μ)) is the speed of waves;
//! - |x*D₁x| ≤ a ω̂, a = max |ẇ|/c, and |Re x*D₁x| ≤ e = ½ max |L''ᵢ/Lᵢ|.
//!
//! The imaginary and real parts of x*Q(iω, v)x = 0 then give
//!
//! - (1) ω (α + β ω̂² − v r) ≤ v² a ω̂,
//! - (2) sqrt(ω̂² − v² e) − v s ω̂ ≤ ω ≤ v s ω̂ + sqrt(ω̂² + v² e).
//!
//! For an eigenvalue with Re λ ≥ 0 and |λ| ≥ R the real and imaginary parts of x*Q(λ, v)x/λ = 0 give
//!
//! - (3) α + β ω̂² − v r ≤ (max(0, v² s² − 1) ω̂² + v² e + v² a ω̂)/R,
//! - (4) |λ| ≤ 2 v s ω̂ + v r + 2 (ω̂² (1 + v² s²) + v² a ω̂)/|λ|.
//!
//! docs/theory.md section 11.

use std::f64::consts::PI;

use crate::mechanics::{Element, Vibration};
use crate::robot::Damping;
use crate::stability::bisect;

/// Flows at an end that two elements share are equal but for this part.
const ROUNDING_OF_FLOW: f64 = 1e-9;
/// Bounds need few digits, and err to the safe side: this many halvings give them.
const HALVINGS: usize = 40;
/// Bounds are moved by this factor to the safe side of their own rounding.
const MARGIN: f64 = 1e-6;

/// An element swings by itself at a certain frequency. Below this part of the square of the lowest one the mesh is as good as
/// a cable.
const SMOOTH: f64 = 0.25;

/// Eigenvalues count as sharp where their distance from the axis is below this part of the distance between them.
const SHARP: f64 = 0.5;

/// Bounds of what can cross, from the extremes over all elements. SI units.
#[derive(Clone, Debug)]
pub(super) struct Bounds {
    damping: Damping,
    /// r in 1/m.
    reeling: f64,
    /// s in s/m.
    slowness: f64,
    /// a in 1/m per m/s, that is s/m².
    acceleration: f64,
    /// e in 1/m².
    curvature: f64,
    /// The square of a frequency below every undamped one, in 1/s².
    lowest: f64,
    /// The square of a frequency above every undamped one.
    highest: f64,
    /// How many modes the mesh has, those of one direction where the problem is isotropic.
    modes: usize,
    /// Waves by the smaller stiffness of each element: across the cable.
    across: Waves,
    /// Waves by the larger one: along the cable. The same where the problem is isotropic.
    along: Waves,
    /// 12 k/m of every element and stiffness, in 1/s²: the square of the highest frequency of a mesh of such elements.
    /// Those of one direction where the problem is isotropic.
    cutoffs: Vec<f64>,
    /// The square of a frequency (1/s²) up to which the mesh does not matter.
    smooth: f64,
}

/// Waves that travel through the cables by one of the two stiffnesses of each element.
#[derive(Clone, Copy, Debug, Default)]
struct Waves {
    /// The largest |w|/c at v = 1, in s/m.
    slowness: f64,
    /// The square of a frequency (1/s²) above every undamped one of a mesh with these stiffnesses.
    highest: f64,
    /// The time that a wave takes along a cable, in s, for the cable in which it takes longest. Divided by π, it is the number
    /// of modes of that cable per rad/s.
    travel: f64,
    /// The sum of these times over all cables, in s.
    travels: f64,
}

impl Waves {
    /// Takes a cable in, from its elements with one stiffness (N/m) of each.
    fn add(&mut self, elements: impl Iterator<Item = (Flow, f64)>) {
        let mut travel = 0.0;
        for (element, stiffness) in elements {
            let through = element.through[0].abs().max(element.through[1].abs());
            self.slowness = self.slowness.max(through / (element.mass * stiffness).sqrt());
            self.highest = self.highest.max(12.0 * stiffness / element.mass);
            travel += (element.mass / stiffness).sqrt();
        }
        self.travel = self.travel.max(travel);
        self.travels += travel;
    }
}

/// One element's flow and stiffness in the units of the bounds.
#[derive(Clone, Copy)]
struct Flow {
    /// μ l in kg.
    mass: f64,
    /// μ w and μ ẇ at both ends.
    through: [f64; 2],
    rate: [f64; 2],
    /// The eigenvalues of A/l, the smaller one first.
    elastic: [f64; 2],
}

impl Flow {
    fn of(element: &Element) -> Self {
        let flow = |rates: [f64; 2]| rates.map(|rate| element.mass_per_length * rate);
        let [along, across] = element.springs();
        Self {
            mass: element.total_mass(),
            through: flow(element.inflow),
            rate: flow(element.inflow_rate),
            elastic: [along.min(across), along.max(across)],
        }
    }
}

impl Bounds {
    /// The bounds of `vibration`; `None` where the flow jumps between elements, or is not zero at the platform, so
    /// that they do not hold.
    pub(super) fn new(vibration: &Vibration) -> Option<Self> {
        let mut bounds = Self {
            damping: vibration.damping,
            reeling: 0.0,
            slowness: 0.0,
            acceleration: 0.0,
            curvature: 0.0,
            lowest: 0.0,
            highest: 0.0,
            modes: if vibration.isotropic { vibration.nodes() } else { 2 * vibration.nodes() },
            across: Waves::default(),
            along: Waves::default(),
            cutoffs: Vec::new(),
            smooth: f64::INFINITY,
        };
        let directions = if vibration.isotropic { 1 } else { 2 };
        let (mut compliance, mut hub_stiffness) = (0.0_f64, 0.0);
        for chain in &vibration.chains {
            // No material passes the platform.
            let mut before = vibration.hub.platform_mass().map(|_| [0.0, 0.0]);
            let (mut stretch, mut mass, mut softest) = (0.0, 0.0, f64::INFINITY);
            for element in chain.elements() {
                let one = Flow::of(element);
                let largest = |pair: [f64; 2]| pair[0].abs().max(pair[1].abs());
                if let Some([flow, rate]) = before {
                    let jump = (one.through[0] - flow).abs() > ROUNDING_OF_FLOW * largest(one.through)
                        || (one.rate[0] - rate).abs()
                            > ROUNDING_OF_FLOW * (largest(one.rate) + largest(one.through).powi(2) / one.mass);
                    if jump {
                        return None;
                    }
                }
                before = Some([one.through[1], one.rate[1]]);
                bounds.cutoffs.extend(one.elastic.iter().take(directions).map(|k| 12.0 * k / one.mass));
                bounds.smooth = bounds.smooth.min(SMOOTH * 12.0 * one.elastic[0] / one.mass);
                let impedance = (one.mass * one.elastic[0]).sqrt();
                bounds.reeling = bounds.reeling.max((one.through[1] - one.through[0]) / one.mass);
                bounds.slowness = bounds.slowness.max(largest(one.through) / impedance);
                bounds.acceleration = bounds.acceleration.max(largest(one.rate) / impedance);
                bounds.curvature = bounds.curvature.max(0.5 * (one.rate[1] - one.rate[0]).abs() / one.mass);
                bounds.highest = bounds.highest.max(12.0 * one.elastic[1] / one.mass);
                stretch += 1.0 / one.elastic[0];
                mass += one.mass;
                softest = softest.min(one.elastic[0]);
            }
            // ∫ μ u² ≤ (2/π)² (Σ mass)(Σ compliance) u*Ku for a cable held at the winch, of its softest stiffness.
            let n = chain.elements().len() as f64;
            compliance = compliance.max(4.0 / PI.powi(2) * mass * n / softest);
            hub_stiffness += 1.0 / stretch;
            let flows = || chain.elements().iter().map(Flow::of);
            bounds.across.add(flows().map(|flow| (flow, flow.elastic[0])));
            bounds.along.add(flows().map(|flow| (flow, flow.elastic[1])));
        }
        let hub = vibration.hub.platform_mass().map_or(0.0, |mass| mass / hub_stiffness);
        bounds.lowest = 1.0 / (compliance + hub);
        let numbers = [bounds.slowness, bounds.acceleration, bounds.highest, bounds.lowest, bounds.across.travels];
        numbers.iter().all(|number| number.is_finite()).then_some(bounds)
    }

    /// A speed (m/s) up to which nothing can cross, at most `limit`.
    pub(super) fn lowest_speed(&self, limit: f64) -> f64 {
        let safe = |v: f64| {
            let lower = (1.0 - v * v * self.curvature / self.lowest).max(0.0).sqrt() - v * self.slowness;
            let damping = self.damping.alpha + self.damping.beta * self.lowest - v * self.reeling;
            lower > 0.0 && damping * lower > v * v * self.acceleration
        };
        if safe(limit) {
            return limit;
        }
        let [low, _] = bisect([0.0, limit], HALVINGS, safe);
        low * (1.0 - MARGIN)
    }

    /// The highest frequency (rad/s) with which something can cross at speeds up to `v` that swings with at most
    /// `hat` (rad/s) at rest: (2), on the right.
    fn upper(&self, hat: f64, v: f64) -> f64 {
        v * self.slowness * hat + (hat * hat + v * v * self.curvature).sqrt()
    }

    /// A frequency (rad/s) above which nothing can cross at speeds up to `v`.
    pub(super) fn highest_frequency(&self, v: f64) -> f64 {
        let Damping { alpha, beta } = self.damping;
        let (mesh, fast) = (self.highest.sqrt(), v * self.slowness);
        let top = self.upper(mesh, v);
        // At frequencies from ω on, (1) has ω̂ between the roots of β ω̂² − (v² a/ω) ω̂ − (v r − α); the smaller one is of
        // use where damping prevails. (2) bounds frequencies by ω̂ from both sides: nothing crosses from where they
        // contradict each other. What holds at one ω holds at all higher ones.
        let closed = |omega: f64| {
            let Some([least, most]) = between(beta, v * v * self.acceleration / omega, v * self.reeling - alpha) else {
                return true;
            };
            let lower = || (least * least - v * v * self.curvature).max(0.0).sqrt() - fast * least;
            self.upper(most, v) < omega || (least > 0.0 && (least > mesh || (fast < 1.0 && lower() > omega)))
        };
        if !closed(top) {
            return top * (1.0 + MARGIN);
        }
        let [_, shut] = bisect([0.0, top], HALVINGS, |omega| !closed(omega));
        shut * (1.0 + MARGIN)
    }

    /// |λ| (1/s) beyond which nothing is unstable at speed `v`.
    pub(super) fn largest_unstable(&self, v: f64) -> f64 {
        let Damping { alpha, beta } = self.damping;
        let fast = ((v * self.slowness).powi(2) - 1.0).max(0.0);
        let top = self.highest.sqrt();
        // From |λ| = R on, (3) bounds ω̂, and (4) bounds |λ| by that.
        let closed = |radius: f64| {
            let b = v * v * self.acceleration / radius;
            let c = v * self.reeling - alpha + v * v * self.curvature / radius;
            let Some([least, most]) = between(beta - fast / radius, b, c) else { return true };
            let hat = top.min(most);
            let q = hat * hat * (1.0 + (v * self.slowness).powi(2)) + v * v * self.acceleration * hat;
            least > top || 2.0 * v * self.slowness * hat + v * self.reeling + 2.0 * q / radius < radius
        };
        let mut shut = self.lowest.sqrt();
        while shut.is_finite() && !closed(shut) {
            shut *= 2.0;
        }
        let [_, shut] = bisect([0.0, shut], HALVINGS, |radius| !closed(radius));
        shut * (1.0 + MARGIN)
    }

    /// How many modes the mesh has, those of one direction where the problem is isotropic.
    pub(super) fn modes(&self) -> usize {
        self.modes
    }

    /// How fast an undamped frequency of `omega` decays at rest, in 1/s: so far from the axis are eigenvalues there.
    pub(super) fn decay(&self, omega: f64) -> f64 {
        0.5 * (self.damping.alpha + self.damping.beta * omega * omega)
    }

    /// The waves that swing the mesh at about `omega` (rad/s) and a speed of `v`: beyond the highest frequency across the
    /// cables those along them alone.
    fn waves(&self, omega: f64, v: f64) -> &Waves {
        let above = omega * omega > self.across.highest && omega > self.upper(self.across.highest.sqrt(), v);
        if above { &self.along } else { &self.across }
    }

    /// Whether waves of the frequency `omega` (rad/s) are so short that the mesh matters.
    fn mesh_matters(&self, omega: f64) -> bool {
        omega * omega > self.smooth
    }

    /// Whether, up to the frequency `omega` (rad/s), waves for which the mesh matters may have eigenvalues far nearer to the
    /// axis than to each other: mass damping, which reeling cancels, alone keeps them off it.
    pub(super) fn is_sharp(&self, omega: f64) -> bool {
        self.mesh_matters(omega) && self.may_be_sharp()
    }

    /// Whether that is so for waves for which the mesh matters.
    pub(super) fn may_be_sharp(&self) -> bool {
        0.5 * self.damping.beta * self.smooth * self.across.travels / PI < SHARP
    }

    /// A step from the frequency `omega` (rad/s) upwards that is expected to hold this many frequencies of all cables: `low`
    /// where the mesh does not matter, and `high` where it does.
    pub(super) fn frequency_step(&self, omega: f64, [low, high]: [f64; 2]) -> f64 {
        let square = omega * omega;
        if !self.mesh_matters(omega) {
            return low * PI / self.across.travels;
        }
        // Elements with stiffness k and mass m have ω̂² = 6 (k/m) (1 − cos θ)/(2 + cos θ) with a phase of θ from node to node
        // (`undamped`). θ/π is an element's share in the number of frequencies up to ω̂; this is its slope. It is infinite
        // where θ is π, but there the step ends with all that are left of these elements, at most twice as many.
        let density = |cutoff: &f64| {
            let x = 12.0 * square / cutoff;
            let root = ((12.0 - x) * cutoff).max(0.0).sqrt();
            if root > 0.0 { 72.0 / ((6.0 + x) * root) } else { 0.0 }
        };
        high * PI / self.cutoffs.iter().map(density).sum::<f64>()
    }

    /// The step in v (m/s) in which a frequency of `omega` moves by the spacing of the frequencies of the cable in which
    /// a wave travels longest, near `speed`.
    pub(super) fn speed_step(&self, omega: f64, speed: f64) -> f64 {
        let waves = self.waves(omega, speed);
        // A string's frequencies fall as 1 − (s v)²; this has the steepest slope before they are zero.
        let slope = 2.0 * waves.slowness * (waves.slowness * speed).min(1.0) * omega;
        PI / waves.travel / slope
    }
}

/// Where a x² − b x − c ≤ 0 for x ≥ 0, b not negative: from the first to the second number; `None` where nowhere.
fn between(a: f64, b: f64, c: f64) -> Option<[f64; 2]> {
    let discriminant = b * b + 4.0 * a * c;
    if discriminant < 0.0 {
        // Without a real root the sign is that of a, as far out.
        return (a < 0.0).then_some([0.0, f64::INFINITY]);
    }
    let root = discriminant.sqrt();
    // Without cancellation.
    let least = if c < 0.0 { -2.0 * c / (b + root) } else { 0.0 };
    Some([least, if a > 0.0 { (b + root) / (2.0 * a) } else { f64::INFINITY }])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{Chain, Hub};
    use crate::robot::{Linearisation, RobotSpec, paper_spec};
    use crate::stability::problems::{self, MATERIAL, MU};
    use crate::stability::{CriticalSearch, Eigenproblem, Outcome};

    /// A straight cable of this unstretched length (m) and tension (N), L' and L'' given.
    fn straight(length: f64, tension: f64, rates: [f64; 2]) -> Chain {
        problems::straight(6, length, tension, rates, Linearisation::Tangent)
    }

    fn near(a: f64, b: f64, tolerance: f64, what: &str) {
        assert!((a - b).abs() <= tolerance * b.abs(), "{what}: {a}, not {b}");
    }

    /// The root of a function that rises from below zero at 0, by bisection.
    fn root(f: impl Fn(f64) -> f64) -> f64 {
        let mut high = 1.0;
        while f(high) < 0.0 {
            high *= 2.0;
        }
        bisect([0.0, high], 60, |x| f(x) < 0.0)[0]
    }

    /// Of straight cables, where waves travel at c = sqrt(N/(λ μ)) and nothing varies along the cable but its flow.
    #[test]
    fn straight_cables_have_known_bounds() {
        let (lengths, tensions, rates) = ([3.0, 11.0], [90.0, 40.0], [[-0.6, 0.2], [0.9, -0.3]]);
        let vibration = Vibration {
            chains: [0, 1].map(|i| straight(lengths[i], tensions[i], rates[i])).into(),
            hub: Hub::point(5.0, 2),
            damping: Damping { alpha: 0.3, beta: 0.002 },
            isotropic: false,
        };
        let bounds = Bounds::new(&vibration).unwrap();
        let across = tensions.map(|tension| tension / MATERIAL.stretch(tension));
        let c = across.map(|a| (a / MU).sqrt());
        let largest = |of: [f64; 2]| of[0].max(of[1]);
        let each = |f: &dyn Fn(usize) -> f64| [f(0), f(1)];
        let travel = each(&|i| lengths[i] / c[i]);
        near(bounds.reeling, 0.6 / 3.0, 1e-12, "r");
        near(bounds.slowness, largest(each(&|i| rates[i][0].abs() / c[i])), 1e-12, "s");
        near(bounds.acceleration, largest(each(&|i| rates[i][1].abs() / c[i])), 1e-12, "a");
        near(bounds.curvature, largest(each(&|i| 0.5 * rates[i][1].abs() / lengths[i])), 1e-12, "e");
        near(bounds.across.travel, largest(travel), 1e-12, "the longest time of a wave");
        near(bounds.frequency_step(1.0, [1.4, 0.7]), 1.4 * PI / (travel[0] + travel[1]), 1e-12, "a step in ω");
        // A string held at one end, and the platform on both cables.
        let held = largest(each(&|i| (2.0 * travel[i] / PI).powi(2)));
        let hung = 5.0 / (across[0] / lengths[0] + across[1] / lengths[1]);
        near(bounds.lowest, 1.0 / (held + hung), 1e-12, "the lowest frequency");
        // An element by itself: its ends swing against each other.
        let fastest = |i: usize| {
            let l = lengths[i] / 6.0;
            12.0 * MATERIAL.tangent(MATERIAL.stretch(tensions[i])) / (MU * l * l)
        };
        near(bounds.highest, largest(each(&fastest)), 1e-12, "the highest frequency");
        near(bounds.decay(7.0), 0.5 * (0.3 + 0.002 * 49.0), 1e-12, "decay");
        // The frequency ω (1 − (s v)²) of a string changes with v by 2 s² v ω, above the speed of waves as at it.
        for (speed, slope) in [(4.0, 2.0 * bounds.slowness.powi(2) * 4.0), (100.0, 2.0 * bounds.slowness)] {
            near(bounds.speed_step(7.0, speed) * slope * 7.0, PI / largest(travel), 1e-12, "a step in v");
        }
    }

    /// At rest everything decays that is damped both ways.
    #[test]
    fn nothing_is_unstable_at_rest() {
        let bounds = some_bounds(0.4, 0.02);
        assert!(bounds.largest_unstable(0.0) < 1e-6 * bounds.lowest.sqrt());
    }

    /// Where the flow jumps between elements the integrals by parts have further terms.
    #[test]
    fn there_are_no_bounds_where_the_flow_jumps() {
        let mut vibration = Vibration {
            chains: vec![straight(3.0, 90.0, [-0.6, 0.2])],
            hub: Hub::point(5.0, 1),
            damping: Damping { alpha: 0.3, beta: 0.002 },
            isotropic: false,
        };
        assert!(Bounds::new(&vibration).is_some());
        let whole = vibration.chains[0].clone();
        let flow = [[0.3, 0.4], [-0.1, -0.4 / 3.0]];
        for (w, rate, holds) in [
            (flow[0], flow[1], true),
            ([0.31, 0.4], flow[1], false),
            ([0.3, 0.41], flow[1], false),
            (flow[0], [-0.11, -0.4 / 3.0], false),
            (flow[0], [-0.1, -0.14], false),
        ] {
            vibration.chains[0] = whole.clone();
            let element = &mut vibration.chains[0].elements_mut()[3];
            *element = element.with_inflow(w, rate);
            assert_eq!(Bounds::new(&vibration).is_some(), holds, "{w:?} {rate:?}");
        }
        vibration.chains[0] = Chain::new(whole.elements()[1..].to_vec()).unwrap();
        assert!(Bounds::new(&vibration).is_none(), "flow at the platform");
        vibration.hub = Hub::fixed(1);
        assert!(Bounds::new(&vibration).is_some(), "flow at a fixed end");
    }

    fn some_bounds(alpha: f64, beta: f64) -> Bounds {
        let waves = Waves { slowness: 0.07, highest: 4e6, travel: 1.0, travels: 3.0 };
        Bounds {
            damping: Damping { alpha, beta },
            reeling: 0.11,
            slowness: 0.07,
            acceleration: 0.013,
            curvature: 0.02,
            lowest: 2.5,
            highest: 4e6,
            modes: 1000,
            across: waves,
            along: waves,
            cutoffs: vec![4e6; 1000],
            smooth: 1e6,
        }
    }

    /// At the lowest speed (1) and the left of (2) hold with equality for the lowest frequency.
    #[test]
    fn the_lowest_speed_is_where_its_inequalities_meet() {
        for (alpha, beta) in [(0.4, 0.0), (0.4, 0.02), (0.0, 0.3), (2.0, 0.1)] {
            let bounds = some_bounds(alpha, beta);
            let v = bounds.lowest_speed(100.0);
            let hat = bounds.lowest.sqrt();
            let omega = (hat * hat - v * v * bounds.curvature).sqrt() - v * bounds.slowness * hat;
            let damping = alpha + beta * hat * hat - v * bounds.reeling;
            near(omega * damping, v * v * bounds.acceleration * hat, 1e-4, "(1)");
            near(bounds.lowest_speed(0.9 * v), 0.9 * v, 0.0, "below");
        }
        // Nothing is reeled in and nothing accelerates: frequencies fall to zero at the speed of waves.
        let steady = Bounds { reeling: 0.0, acceleration: 0.0, curvature: 0.0, ..some_bounds(0.4, 0.0) };
        near(steady.lowest_speed(100.0), 1.0 / steady.slowness, 1e-5, "the speed of waves");
    }

    /// At the highest frequency (1) and the right of (2) hold with equality.
    #[test]
    fn the_highest_frequency_is_where_its_inequalities_meet() {
        for (alpha, beta, v) in [(0.4, 0.02, 9.0), (0.0, 0.3, 2.0), (0.4, 0.001, 20.0)] {
            let bounds = some_bounds(alpha, beta);
            let omega = bounds.highest_frequency(v);
            let upper = |hat: f64| v * bounds.slowness * hat + (hat * hat + v * v * bounds.curvature).sqrt();
            let hat = root(|hat| upper(hat) - omega);
            let damping = omega * (alpha + beta * hat * hat - v * bounds.reeling);
            near(damping, v * v * bounds.acceleration * hat, 1e-4, "(1)");
            let undamped = Bounds { damping: Damping { alpha, beta: 0.0 }, ..bounds.clone() };
            near(undamped.highest_frequency(v), upper(2e3), 2e-6, "of the mesh");
        }
    }

    /// Where mass damping outweighs the reeling, (1) and the left of (2) hold with equality at the highest frequency.
    #[test]
    fn mass_damping_lowers_the_highest_frequency() {
        for (alpha, beta, v) in [(5.0, 0.02, 9.0), (5.0, 0.0, 9.0), (3.0, 0.0, 13.5)] {
            let bounds = some_bounds(alpha, beta);
            let omega = bounds.highest_frequency(v);
            let lower = |hat: f64| (hat * hat - v * v * bounds.curvature).max(0.0).sqrt() - v * bounds.slowness * hat;
            let hat = root(|hat| lower(hat) - omega).min(2e3);
            let damping = omega * (alpha + beta * hat * hat - v * bounds.reeling);
            near(damping, v * v * bounds.acceleration * hat, 1e-4, "(1)");
            assert!(omega < 0.9 * bounds.upper(2e3, v), "{omega}");
        }
    }

    /// A quadratic's sign, from its values.
    #[test]
    fn a_quadratic_is_not_positive_between_its_roots() {
        for a in [-2.0, -1e-9, 0.0, 1e-9, 3.0] {
            for b in [0.0, 1e-6, 4.0] {
                for c in [-5.0, -1e-6, 0.0, 1e-6, 7.0] {
                    let found = between(a, b, c);
                    for x in [0.0, 1e-9, 0.3, 1.0, 1.5, 1e3, 1e7] {
                        let value = a * x * x - b * x - c;
                        let inside = found.is_some_and(|[least, most]| (least..=most).contains(&x));
                        let rounding = 1e-12 * (a.abs() * x * x + b * x + c.abs());
                        assert!(value.abs() <= rounding || inside == (value < 0.0), "{a} {b} {c} {x}: {found:?}");
                    }
                }
            }
        }
    }

    /// Of a uniform string on a mesh with fixed ends the steps up to its j-th frequency add up to j, to the last one.
    #[test]
    fn steps_in_frequency_count_the_frequencies_of_the_mesh() {
        let n = 6;
        let (length, tension) = (11.0, 40.0);
        let chain = straight(length, tension, [0.0, 0.0]);
        let damping = Damping { alpha: 0.0, beta: 0.0 };
        let isotropic = Vibration { chains: vec![chain], hub: Hub::fixed(1), damping, isotropic: true };
        let mut bounds = Bounds::new(&isotropic).unwrap();
        // The mesh matters everywhere, so that the exact density is taken.
        bounds.smooth = -1.0;
        let travel = length / (tension / MATERIAL.stretch(tension) / MU).sqrt();
        let frequency = |j: i32| {
            let cosine = (PI * f64::from(j) / f64::from(n)).cos();
            f64::from(n) / travel * (6.0 * (1.0 - cosine) / (2.0 + cosine)).sqrt()
        };
        let (mut omega, mut count) = (0.0, 0.0);
        for j in 1..n {
            while omega < frequency(j) {
                omega += bounds.frequency_step(omega, [1.0, 1e-4]);
                count += 1e-4;
            }
            near(count, f64::from(j), 2e-3, "frequencies");
        }
    }

    /// Stiffness damping keeps the modes of a fine mesh off the axis; where there is none of it reeling brings them near.
    #[test]
    fn eigenvalues_are_near_the_axis_without_stiffness_damping() {
        for (beta, omega, sharp) in [(0.0, 1.1e3, true), (0.0, 0.9e3, false), (1e-5, 1.1e3, false), (1e-7, 1.1e3, true)]
        {
            assert_eq!(some_bounds(5.0, beta).is_sharp(omega), sharp, "{beta} {omega}");
        }
    }

    /// At the radius (3) and (4) hold with equality, or (4) does for the mesh's highest frequency.
    #[test]
    fn the_radius_is_where_its_inequalities_meet() {
        for (alpha, beta, v, of_the_mesh) in [
            (0.4, 0.02, 9.0, false),
            (0.0, 0.3, 2.0, false),
            (0.4, 0.3, 20.0, false),
            (0.1, 0.0, 9.0, true),
            (0.1, 1e-7, 20.0, true),
        ] {
            let bounds = some_bounds(alpha, beta);
            let Bounds { reeling: r, slowness: s, acceleration: a, curvature: e, .. } = bounds;
            let radius = bounds.largest_unstable(v);
            let right = |hat: f64| {
                let square = hat * hat * (1.0 + v * v * s * s) + v * v * a * hat;
                2.0 * v * s * hat + v * r + 2.0 * square / radius
            };
            if of_the_mesh {
                near(right(2e3), radius, 1e-4, "(4)");
                continue;
            }
            let hat = root(|hat| right(hat) - radius);
            assert!(hat < 2e3, "{hat}");
            let fast = (v * v * s * s - 1.0).max(0.0) * hat * hat;
            near(alpha + beta * hat * hat - v * r, (fast + v * v * e + v * v * a * hat) / radius, 1e-3, "(3)");
        }
    }

    /// Undamped frequencies are between the bounds; nothing grows at the lowest speed; what grows above it oscillates
    /// below the highest frequency where it begins to.
    #[test]
    fn the_bounds_hold_for_the_papers_robot() {
        for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
            for (at, towards) in [([0.0, 0.0], [1.0, 0.0]), ([4.0, 1.0], [1.0, 1.0]), ([7.0, 0.0], [-1.0, 0.0])] {
                let spec = RobotSpec { elements: 6, linearisation, ..paper_spec() };
                let vibration = problems::of_robot(spec, at, towards);
                let bounds = Bounds::new(&vibration).unwrap();
                let dense = Eigenproblem::new(&vibration).unwrap();
                let squares = dense.undamped_squares();
                assert!(squares.iter().all(|&square| (bounds.lowest..=bounds.highest).contains(&square)));
                let lowest = bounds.lowest_speed(40.0);
                assert!(dense.spectrum(lowest).unwrap().growth_rate() < 0.0);
                if let Outcome::Found(critical) = CriticalSearch::new(40.0).run(&vibration).unwrap() {
                    assert!(critical.speed > lowest);
                    assert!(critical.eigenvalue.im < bounds.highest_frequency(critical.speed));
                }
            }
        }
    }

    /// The band of frequencies does not depend on the mesh.
    #[test]
    fn the_band_is_that_of_the_cable_not_of_the_mesh() {
        let bounds = |elements| {
            let spec = RobotSpec { elements, linearisation: Linearisation::Tangent, ..paper_spec() };
            Bounds::new(&problems::of_robot(spec, [0.0, 0.0], [1.0, 0.0])).unwrap()
        };
        let (coarse, fine) = (bounds(10), bounds(80));
        assert!((5.0..6.0).contains(&coarse.lowest_speed(40.0)), "{}", coarse.lowest_speed(40.0));
        assert!((5.0..6.0).contains(&fine.lowest_speed(40.0)), "{}", fine.lowest_speed(40.0));
        let (a, b) = (coarse.highest_frequency(11.0), fine.highest_frequency(11.0));
        assert!(a < 40.0 && (a - b).abs() < 0.1 * a, "{a} {b}");
    }
}
