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
//!
//! For an eigenvalue with Re λ ≥ 0 and |λ| ≥ R the real and imaginary parts of x*Q(λ, v)x/λ = 0 give
//!
//! - (3) α + β ω̂² − v r ≤ (max(0, v² s² − 1) ω̂² + v² e + v² a ω̂)/R,
//! - (4) |λ| ≤ 2 v s ω̂ + v r + 2 (ω̂² (1 + v² s²) + v² a ω̂)/|λ|.
//!
//! docs/theory.md section 11.

use std::f64::consts::PI;

use crate::mechanics::{Element, Hub, Vibration};
use crate::robot::Damping;

/// Relative size of rounding in the flow at the elements' ends.
const ROUNDING: f64 = 1e-9;
/// Bisections of the bounds; they need few digits, and err to the safe side.
const BISECTIONS: usize = 40;
/// Bounds are moved by this factor to the safe side of their own rounding.
const MARGIN: f64 = 1e-6;

/// Bounds of what can cross, from the extremes over all elements. SI units.
#[derive(Clone, Copy, Debug)]
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
    /// The longest time of a wave along a cable, in s: the modes of the cable per rad/s, times π. And that of all cables
    /// together.
    travel: f64,
    travels: f64,
}

/// One element's flow and stiffness in the units of the bounds.
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
        let mass = 3.0 * element.mass[(0, 0)];
        // C = 2 μ [[−a, a], [−b, b]] with a = w₀/3 + w₁/6, b = w₀/6 + w₁/3.
        let ends = |a: f64, b: f64| [4.0 * a - 2.0 * b, 4.0 * b - 2.0 * a];
        let flow = ends(0.5 * element.transfer[(0, 1)], -0.5 * element.transfer[(1, 0)]);
        let square = (flow[0] * flow[0] + flow[0] * flow[1] + flow[1] * flow[1]) / (3.0 * mass);
        let rate = ends(element.flow[(0, 1)] - square, square - element.flow[(1, 0)]);
        let k = &element.elastic;
        let (mean, radius) =
            (0.5 * (k[(0, 0)] + k[(1, 1)]), (0.5 * (k[(0, 0)] - k[(1, 1)])).hypot(0.5 * (k[(0, 1)] + k[(1, 0)])));
        Self { mass, through: flow, rate, elastic: [mean - radius, mean + radius] }
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
            travel: 0.0,
            travels: 0.0,
        };
        let (mut compliance, mut hub_stiffness) = (0.0_f64, 0.0);
        for chain in &vibration.chains {
            let mut before = match vibration.hub {
                Hub::Platform(_) => Some([0.0, 0.0]),
                Hub::Fixed => None,
            };
            let (mut stretch, mut mass, mut softest) = (0.0, 0.0, f64::INFINITY);
            let mut travel = 0.0;
            for element in &chain.elements {
                let one = Flow::of(element);
                let largest = |pair: [f64; 2]| pair[0].abs().max(pair[1].abs());
                if let Some([flow, rate]) = before {
                    let jump = (one.through[0] - flow).abs() > ROUNDING * largest(one.through)
                        || (one.rate[0] - rate).abs()
                            > ROUNDING * (largest(one.rate) + largest(one.through).powi(2) / one.mass);
                    if jump {
                        return None;
                    }
                }
                before = Some([one.through[1], one.rate[1]]);
                let impedance = (one.mass * one.elastic[0]).sqrt();
                bounds.reeling = bounds.reeling.max((one.through[1] - one.through[0]) / one.mass);
                bounds.slowness = bounds.slowness.max(largest(one.through) / impedance);
                bounds.acceleration = bounds.acceleration.max(largest(one.rate) / impedance);
                bounds.curvature = bounds.curvature.max(0.5 * (one.rate[1] - one.rate[0]).abs() / one.mass);
                bounds.highest = bounds.highest.max(12.0 * one.elastic[1] / one.mass);
                travel += (one.mass / one.elastic[0]).sqrt();
                stretch += 1.0 / one.elastic[0];
                mass += one.mass;
                softest = softest.min(one.elastic[0]);
            }
            // ∫ μ u² ≤ (2/π)² (Σ mass)(Σ compliance) u*Ku for a cable held at the winch, of its softest stiffness.
            let n = chain.elements.len() as f64;
            compliance = compliance.max(4.0 / PI.powi(2) * mass * n / softest);
            hub_stiffness += 1.0 / stretch;
            bounds.travel = bounds.travel.max(travel);
            bounds.travels += travel;
        }
        let hub = match vibration.hub {
            Hub::Platform(mass) => mass / hub_stiffness,
            Hub::Fixed => 0.0,
        };
        bounds.lowest = 1.0 / (compliance + hub);
        let numbers = [bounds.slowness, bounds.acceleration, bounds.highest, bounds.lowest, bounds.travels];
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
        let (mut low, mut high) = (0.0, limit);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            *(if safe(middle) { &mut low } else { &mut high }) = middle;
        }
        low * (1.0 - MARGIN)
    }

    /// A frequency (rad/s) above which nothing can cross at speeds up to `v`.
    pub(super) fn highest_frequency(&self, v: f64) -> f64 {
        let Damping { alpha, beta } = self.damping;
        // (2), on the right.
        let upper = |hat: f64| v * self.slowness * hat + (hat * hat + v * v * self.curvature).sqrt();
        let top = upper(self.highest.sqrt());
        // At frequencies from ω on, (1) bounds ω̂ by the larger root of β ω̂² − (v² a/ω) ω̂ − (v r − α), and (2) bounds
        // frequencies by that: nothing crosses from where this falls below ω on.
        let closed = |omega: f64| {
            let (b, c) = (v * v * self.acceleration / omega, v * self.reeling - alpha);
            let discriminant = b * b + 4.0 * beta * c;
            discriminant < 0.0 || upper((b + discriminant.sqrt()) / (2.0 * beta)) < omega
        };
        if beta == 0.0 || !closed(top) {
            return top * (1.0 + MARGIN);
        }
        let (mut open, mut shut) = (0.0, top);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (open + shut);
            *(if closed(middle) { &mut shut } else { &mut open }) = middle;
        }
        shut * (1.0 + MARGIN)
    }

    /// |λ| (1/s) beyond which nothing is unstable at speed `v`.
    pub(super) fn largest_unstable(&self, v: f64) -> f64 {
        let Damping { alpha, beta } = self.damping;
        let fast = ((v * self.slowness).powi(2) - 1.0).max(0.0);
        // From |λ| = R on, (3) bounds ω̂, and (4) bounds |λ| by that.
        let closed = |radius: f64| {
            let a = beta - fast / radius;
            let b = v * v * self.acceleration / radius;
            let c = v * self.reeling - alpha + v * v * self.curvature / radius;
            let discriminant = b * b + 4.0 * a * c;
            let top = self.highest.sqrt();
            let hat = match (a > 0.0, discriminant < 0.0) {
                (true, true) => return true,
                (true, false) => top.min((b + discriminant.sqrt()) / (2.0 * a)),
                (false, _) => top,
            };
            let q = hat * hat * (1.0 + (v * self.slowness).powi(2)) + v * v * self.acceleration * hat;
            2.0 * v * self.slowness * hat + v * self.reeling + 2.0 * q / radius < radius
        };
        let mut shut = self.lowest.sqrt();
        while shut.is_finite() && !closed(shut) {
            shut *= 2.0;
        }
        let mut open = 0.0;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (open + shut);
            *(if closed(middle) { &mut shut } else { &mut open }) = middle;
        }
        shut * (1.0 + MARGIN)
    }

    /// How fast an undamped frequency of `omega` decays at rest, in 1/s: so far from the axis are eigenvalues there.
    pub(super) fn decay(&self, omega: f64) -> f64 {
        0.5 * (self.damping.alpha + self.damping.beta * omega * omega)
    }

    /// The number of all cables' frequencies per rad/s.
    pub(super) fn frequency_density(&self) -> f64 {
        self.travels / PI
    }

    /// The step in v (m/s) in which a frequency of `omega` moves by the spacing of the frequencies of the cable in which
    /// a wave travels longest, near `speed`.
    pub(super) fn speed_step(&self, omega: f64, speed: f64) -> f64 {
        // A string's frequencies fall as 1 − (s v)²; this has the steepest slope before they are zero.
        let slope = 2.0 * self.slowness * (self.slowness * speed).min(1.0) * omega;
        PI / self.travel / slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::{Linearisation, Motion, Robot, RobotSpec, paper_spec};
    use crate::stability::Eigenproblem;
    use crate::study::Local;

    fn local(linearisation: Linearisation, elements: usize, at: [f64; 2], towards: [f64; 2]) -> Local {
        let robot = Robot::new(RobotSpec { elements, linearisation, ..paper_spec() }).unwrap();
        Local::new(&robot, &Motion::new(at, towards, 5.0).unwrap()).unwrap()
    }

    /// Undamped frequencies are between the bounds; nothing grows at the lowest speed; what grows above it oscillates
    /// below the highest frequency where it begins to.
    #[test]
    fn the_bounds_hold_for_the_papers_robot() {
        for linearisation in [Linearisation::Secant, Linearisation::Tangent] {
            for (at, towards) in [([0.0, 0.0], [1.0, 0.0]), ([4.0, 1.0], [1.0, 1.0]), ([7.0, 0.0], [-1.0, 0.0])] {
                let local = local(linearisation, 6, at, towards);
                let bounds = Bounds::new(&local.vibration).unwrap();
                let dense = Eigenproblem::new(&local.vibration).unwrap();
                let squares = dense.undamped_squares();
                assert!(squares.iter().all(|&square| (bounds.lowest..=bounds.highest).contains(&square)));
                let lowest = bounds.lowest_speed(40.0);
                assert!(dense.spectrum(lowest).unwrap().growth_rate() < 0.0);
                if let crate::stability::Outcome::Found(critical) = local.critical_speed(40.0).unwrap() {
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
            let local = local(Linearisation::Tangent, elements, [0.0, 0.0], [1.0, 0.0]);
            Bounds::new(&local.vibration).unwrap()
        };
        let (coarse, fine) = (bounds(10), bounds(80));
        assert!((5.0..6.0).contains(&coarse.lowest_speed(40.0)), "{}", coarse.lowest_speed(40.0));
        assert!((5.0..6.0).contains(&fine.lowest_speed(40.0)), "{}", fine.lowest_speed(40.0));
        let (a, b) = (coarse.highest_frequency(11.0), fine.highest_frequency(11.0));
        assert!(a < 40.0 && (a - b).abs() < 0.1 * a, "{a} {b}");
    }
}
