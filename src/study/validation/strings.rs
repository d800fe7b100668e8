//! Strings between fixed ends, for which exact solutions exist: at rest, travelling, and changing in length.

use std::f64::consts::{PI, TAU};

use super::{Failed, Outcome, limit};
use crate::mechanics::{self, Block, Chain, Element, Hub, Material, Vibration};
use crate::robot::{Damping, Linearisation, Strain, Vec2};
use crate::stability::{self, CriticalSearch, Eigenproblem};

const MATERIAL: Material = Material { axial_stiffness: 6250.0, strain: Strain::Green };
/// In kg/m.
const MU: f64 = 0.4;
/// In N.
const TENSION: f64 = 40.0;
/// In m, not stretched.
const LENGTH: f64 = 11.0;
const UNDAMPED: Damping = Damping { alpha: 0.0, beta: 0.0 };

/// c = sqrt((N/λ)/μ), in unstretched metres per second: an unstretched length carries the mass μ and the stiffness N/λ.
fn wave_speed() -> f64 {
    (TENSION / MATERIAL.stretch(TENSION) / MU).sqrt()
}

/// A string of n elements with the flow `inflow(k)` = [w₀, w₁] through element k, in m/s.
fn string(n: usize, damping: Damping, inflow: impl Fn(usize) -> [f64; 2]) -> Result<Vibration, Failed> {
    let l = LENGTH / n as f64;
    let elements = (0..n).map(|k| Element {
        mass: mechanics::mass(MU, l),
        transfer: mechanics::transfer(MU, inflow(k)),
        flow: mechanics::flow_stiffness(MU, l, inflow(k), [0.0, 0.0]),
        elastic: mechanics::elastic(MATERIAL, Linearisation::Secant, l, Vec2::new(TENSION, 0.0)),
    });
    let chain = Chain::new(elements.collect()).ok_or(Failed::Nothing("element"))?;
    Vibration::of_cables(vec![chain], Hub::Fixed, damping, true).ok_or(Failed::Nothing("cable"))
}

/// The lowest frequency in Hz of a string that travels at v, for ever finer meshes: expected is (c² − v²)/(2 L c).
fn lowest_frequency(v: f64) -> Result<Outcome, Failed> {
    let c = wave_speed();
    let on_mesh = |n: usize| -> Result<f64, Failed> {
        // The speed 1 carries the flow v: the matrices are those of unit speed.
        let spectrum = Eigenproblem::new(&string(n, UNDAMPED, |_| [v, v])?)?.spectrum(1.0)?;
        spectrum.modes().next().map(|mode| mode.frequency_hz()).ok_or(Failed::Nothing("mode"))
    };
    let expected = (c * c - v * v) / (2.0 * LENGTH * c);
    // The shorter of the two waves turns by θ from node to node, and consistent masses make it faster by
    // θ²/24 + θ⁴/1920 (at rest: ω = (c/l) sqrt(6 (1 − cos θ)/(2 + cos θ))). The first term is extrapolated away, of the
    // second −1/4 is left. At 0.4 c it is a little less than at rest. The extra 5 % is for θ⁶.
    let theta = PI * (1.0 + v / c) / 20.0;
    let tolerance = expected * 1.05 * theta.powi(4) / 7680.0;
    Ok(Outcome { expected, got: limit(on_mesh(20)?, on_mesh(40)?), tolerance })
}

/// The lowest frequency of a string at rest.
pub fn at_rest() -> Result<Outcome, Failed> {
    lowest_frequency(0.0)
}

/// That of a string whose material travels from one fixed end to the other at 0.4 c.
pub fn travelling() -> Result<Outcome, Failed> {
    lowest_frequency(0.4 * wave_speed())
}

/// The critical speed of a damped travelling string: c on every mesh, since K + v² D = (N/λ − μ v²)/l times one matrix,
/// and damping is complete (Kelvin, Tait and Chetaev).
pub fn critical_speed() -> Result<Outcome, Failed> {
    let expected = wave_speed();
    let vibration = string(10, Damping { alpha: 0.5, beta: 0.005 }, |_| [1.0, 1.0])?;
    let stability::Outcome::Found(critical) = CriticalSearch::new(2.0 * expected).run(&vibration)? else {
        return Err(Failed::Nothing("critical speed"));
    };
    // There is no error of the mesh; the search refines a crossing to far less.
    Ok(Outcome { expected, got: critical.speed, tolerance: 1e-6 })
}

/// The frozen growth rate of a string that is reeled in at a hundredth of the wave speed: −L̇/(2L) to first order.
pub fn frozen_growth() -> Result<Outcome, Failed> {
    const N: usize = 10;
    let part = 0.01;
    let rate = -part * wave_speed();
    let inflow = |k: usize| [-(k as f64), -((k + 1) as f64)].map(|node| node * rate / N as f64);
    let vibration = string(N, UNDAMPED, inflow)?;
    let expected = -rate / (2.0 * LENGTH);
    let spectrum = Eigenproblem::new(&vibration)?.spectrum(1.0)?;
    let got = spectrum.modes().next().map(|mode| mode.eigenvalue.re).ok_or(Failed::Nothing("mode"))?;
    // On the mesh too the symmetric part of C is L̇/L times M. With L̈ = 0, reeling out in place of in turns every
    // eigenvalue's sign, so the real part is odd in L̇: what follows is smaller by (L̇/c)².
    Ok(Outcome { expected, got, tolerance: part * part * expected })
}

/// The displacement of a string after half of it was reeled in at 0.3 c, three tenths from its still end, against
/// u(S, t) = f(c t + S) − f(c t − S), f(z) = sin(2π ln(1 + z v/(c L₀))/ln((c + v)/(c − v))).
///
/// This integrates the matrices in time, with nothing frozen.
pub fn reeled_in() -> Outcome {
    let c = wave_speed();
    let rate = -0.3 * c;
    let end = 0.5 * LENGTH / -rate;
    let f = |z: f64| ((1.0 + z * rate / (c * LENGTH)).ln() * TAU / ((c + rate) / (c - rate)).ln()).sin();
    // f′, by which the displacement's velocity at the start follows.
    let slope = |z: f64| {
        let scale = TAU / ((c + rate) / (c - rate)).ln();
        ((1.0 + z * rate / (c * LENGTH)).ln() * scale).cos() * scale * rate / (c * LENGTH + z * rate)
    };
    let on_mesh = |n: usize| {
        let mut reeled = Reeled::new(n, rate);
        for k in 1..n {
            let part = k as f64 / n as f64;
            let s = LENGTH * part;
            reeled.q[k] = f(s) - f(-s);
            // The node slides along the material: S = L(t) k/n.
            let slide = rate * part;
            reeled.u[k] = (c + slide) * slope(s) - (c - slide) * slope(-s);
        }
        reeled.integrate(end);
        reeled.q[3 * n / 10]
    };
    let s = 0.3 * (LENGTH + rate * end);
    let expected = f(c * end + s) - f(c * end - s);
    let [coarse, fine] = [20, 40].map(on_mesh);
    // 20 elements are off by 0.0103 of the largest displacement, 2 m (docs/theory.md section 10). Extrapolation takes the
    // first term of that away; the next one is of the size of its square, 2e-4 m.
    Outcome { expected, got: limit(coarse, fine), tolerance: 2e-4 }
}

/// A string of n elements with L(t) = L₀ + rate t and fixed ends: its nodes' displacements in m and their rates.
struct Reeled {
    rate: f64,
    time: f64,
    q: Vec<f64>,
    u: Vec<f64>,
}

impl Reeled {
    fn new(n: usize, rate: f64) -> Self {
        Self { rate, time: 0.0, q: vec![0.0; n + 1], u: vec![0.0; n + 1] }
    }

    /// q̈ = −M⁻¹ (C q̇ + K q), the ends at rest.
    fn acceleration(&self, time: f64, q: &[f64], u: &[f64]) -> Vec<f64> {
        let n = q.len() - 1;
        let (l, l_rate) = ((LENGTH + self.rate * time) / n as f64, self.rate / n as f64);
        let spring = mechanics::elastic(MATERIAL, Linearisation::Secant, l, Vec2::new(TENSION, 0.0))[(0, 0)];
        let mut force = vec![0.0; n + 1];
        for k in 0..n {
            let w = [-(k as f64) * l_rate, -((k + 1) as f64) * l_rate];
            let stiffness = mechanics::flow_stiffness(MU, l, w, [0.0, 0.0]) + Block::new(1.0, -1.0, -1.0, 1.0) * spring;
            let part = mechanics::transfer(MU, w) * Vec2::new(u[k], u[k + 1]) + stiffness * Vec2::new(q[k], q[k + 1]);
            force[k] -= part.x;
            force[k + 1] -= part.y;
        }
        // M is tridiagonal, with the same row everywhere: eliminated from the one end, solved from the other.
        let mass = mechanics::mass(MU, l);
        let (diagonal, beside) = (mass.m11 + mass.m22, mass.m12);
        let mut pivots = vec![diagonal; n];
        for k in 2..n {
            let factor = beside / pivots[k - 1];
            pivots[k] -= factor * beside;
            force[k] -= factor * force[k - 1];
        }
        (force[0], force[n]) = (0.0, 0.0);
        for k in (1..n).rev() {
            force[k] = (force[k] - beside * force[k + 1]) / pivots[k];
        }
        force
    }

    /// Integrates to `end` by Runge and Kutta's method of order 4.
    fn integrate(&mut self, end: f64) {
        // The fastest mode of 40 elements has ω = √12 c/l, in the end 250/s: at 800 steps ω h is 0.6, and stable. The
        // shape that is looked at is 30 times slower, and the steps' error, (ω h)⁴/120, far below that of the mesh.
        const STEPS: usize = 800;
        let h = (end - self.time) / STEPS as f64;
        let ahead = |values: &[f64], rates: &[f64], step: f64| -> Vec<f64> {
            values.iter().zip(rates).map(|(value, rate)| value + rate * step).collect()
        };
        for step in 0..STEPS {
            let t = self.time + step as f64 * h;
            let (q, u) = (&self.q, &self.u);
            let a1 = self.acceleration(t, q, u);
            let u2 = ahead(u, &a1, 0.5 * h);
            let a2 = self.acceleration(t + 0.5 * h, &ahead(q, u, 0.5 * h), &u2);
            let u3 = ahead(u, &a2, 0.5 * h);
            let a3 = self.acceleration(t + 0.5 * h, &ahead(q, &u2, 0.5 * h), &u3);
            let u4 = ahead(u, &a3, h);
            let a4 = self.acceleration(t + h, &ahead(q, &u3, h), &u4);
            for k in 0..self.q.len() {
                self.q[k] += (self.u[k] + 2.0 * u2[k] + 2.0 * u3[k] + u4[k]) * (h / 6.0);
                self.u[k] += (a1[k] + 2.0 * a2[k] + 2.0 * a3[k] + a4[k]) * (h / 6.0);
            }
        }
        self.time = end;
    }
}
