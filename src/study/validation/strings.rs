//! Strings between fixed ends, for which exact solutions exist: at rest, travelling, and changing in length.

use std::f64::consts::{PI, TAU};

use nalgebra::{Const, DMatrix, DVector, Dyn, Matrix1, Matrix2, OMatrix, Vector1};

use super::comparison::{Comparison, NoComparison, limit};
use crate::mechanics::{Arrow, ArrowVector, Chain, Element, Hub, Material, Stiffness, Vibration};
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

/// An element of the unstretched length l (m) whose material does not move.
fn element(l: f64) -> Element {
    Element::at_rest(MU, l, Stiffness::new(MATERIAL, Linearisation::Secant, Vec2::new(TENSION, 0.0)))
}

/// A string of n elements with the flow `inflow(k)` = [w₀, w₁] through element k, in m/s.
fn string(n: usize, damping: Damping, inflow: impl Fn(usize) -> [f64; 2]) -> Result<Vibration, NoComparison> {
    let elements = (0..n).map(|k| element(LENGTH / n as f64).with_inflow(inflow(k), [0.0, 0.0]));
    let chain = Chain::new(elements.collect()).ok_or(NoComparison::Nothing("element"))?;
    Vibration::of_cables(vec![chain], Hub::fixed(1), damping, true).ok_or(NoComparison::Nothing("cable"))
}

/// The lowest frequency in Hz of a string that travels at v, for ever finer meshes: expected is (c² − v²)/(2 L c).
fn lowest_frequency(v: f64) -> Result<Comparison, NoComparison> {
    let c = wave_speed();
    let on_mesh = |n: usize| -> Result<f64, NoComparison> {
        // The speed 1 carries the flow v: the matrices are those of unit speed.
        let spectrum = Eigenproblem::new(&string(n, UNDAMPED, |_| [v, v])?)?.spectrum(1.0)?;
        spectrum.modes().next().map(|mode| mode.frequency_hz()).ok_or(NoComparison::Nothing("mode"))
    };
    let expected = (c * c - v * v) / (2.0 * LENGTH * c);
    // The shorter of the two waves turns by θ from node to node, and consistent masses make it faster by
    // θ²/24 + θ⁴/1920 (at rest: ω = (c/l) sqrt(6 (1 − cos θ)/(2 + cos θ))). The first term is extrapolated away, of the
    // second −1/4 is left. At 0.4 c it is a little less than at rest. The extra 5 % is for θ⁶.
    let theta = PI * (1.0 + v / c) / 20.0;
    let tolerance = expected * 1.05 * theta.powi(4) / 7680.0;
    Ok(Comparison { expected, got: limit(on_mesh(20)?, on_mesh(40)?), tolerance })
}

/// The lowest frequency of a string at rest.
pub fn at_rest() -> Result<Comparison, NoComparison> {
    lowest_frequency(0.0)
}

/// That of a string whose material travels from one fixed end to the other at 0.4 c.
pub fn travelling() -> Result<Comparison, NoComparison> {
    lowest_frequency(0.4 * wave_speed())
}

/// The critical speed of a damped travelling string: c on every mesh, since K + v² D = (N/λ − μ v²)/l times one matrix,
/// and damping is complete (Kelvin, Tait and Chetaev).
pub fn critical_speed() -> Result<Comparison, NoComparison> {
    let expected = wave_speed();
    let vibration = string(10, Damping { alpha: 0.5, beta: 0.005 }, |_| [1.0, 1.0])?;
    let stability::Outcome::Found(critical) = CriticalSearch::new(2.0 * expected).run(&vibration)? else {
        return Err(NoComparison::Nothing("critical speed"));
    };
    // There is no error of the mesh; the search refines a crossing to far less.
    Ok(Comparison { expected, got: critical.speed, tolerance: 1e-6 })
}

/// The frozen growth rate of a string that is reeled in at a hundredth of the wave speed: −L̇/(2L) to first order.
pub fn frozen_growth() -> Result<Comparison, NoComparison> {
    const N: usize = 10;
    let part = 0.01;
    let rate = -part * wave_speed();
    let inflow = |k: usize| [-(k as f64), -((k + 1) as f64)].map(|node| node * rate / N as f64);
    let vibration = string(N, UNDAMPED, inflow)?;
    let expected = -rate / (2.0 * LENGTH);
    let spectrum = Eigenproblem::new(&vibration)?.spectrum(1.0)?;
    let got = spectrum.modes().next().map(|mode| mode.eigenvalue.re).ok_or(NoComparison::Nothing("mode"))?;
    // On the mesh too the symmetric part of C is L̇/L times M. With L̈ = 0, reeling out in place of in turns every
    // eigenvalue's sign, so the real part is odd in L̇: what follows is smaller by (L̇/c)².
    Ok(Comparison { expected, got, tolerance: part * part * expected })
}

/// The displacement of a string after half of it was reeled in at 0.3 c, three tenths from its still end, against
/// u(S, t) = f(c t + S) − f(c t − S), f(z) = sin(2π ln(1 + z v/(c L₀))/ln((c + v)/(c − v))).
///
/// This integrates the matrices in time, with nothing frozen.
pub fn reeled_in() -> Comparison {
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
    Comparison { expected, got: limit(coarse, fine), tolerance: 2e-4 }
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
        let inflow = |k: usize| [-(k as f64) * l_rate, -((k + 1) as f64) * l_rate];
        let elements: Vec<Element> = (0..n).map(|k| element(l).with_inflow(inflow(k), [0.0, 0.0])).collect();
        let mut force = vec![Vector1::zeros(); n + 1];
        for (k, element) in elements.iter().enumerate() {
            let [_, spring] = element.springs();
            let stiffness = element.flow_stiffness() + Matrix2::new(1.0, -1.0, -1.0, 1.0) * spring;
            let part = element.transfer() * Vec2::new(u[k], u[k + 1]) + stiffness * Vec2::new(q[k], q[k + 1]);
            force[k].x -= part.x;
            force[k + 1].x -= part.y;
        }
        let mass = |element: &Element| {
            let mass = element.mass();
            [0, 1].map(|i| [0, 1].map(|j| Matrix1::new(mass[(i, j)])))
        };
        let held = OMatrix::<f64, Const<1>, Dyn>::zeros(0);
        let mass = Arrow::factor(DMatrix::zeros(0, 0), [(&elements[..], held)], mass);
        let right = ArrowVector { hub: DVector::zeros(0), chains: vec![force[1..n].to_vec()] };
        let inner = mass.solve(&right).chains.into_iter().flatten().map(|node| node.x);
        std::iter::once(0.0).chain(inner).chain([0.0]).collect()
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
