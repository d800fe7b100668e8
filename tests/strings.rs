//! Strings, for which exact solutions exist: travelling between fixed ends, and changing in length.
//!
//! The element matrices are the crate's. They are assembled, and compared with exact solutions, by other code.

mod common;

use std::f64::consts::{PI, TAU};

use common::close;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix2};
use num_dual::{DualNum, first_derivative};
use tautline::mechanics::{Chain, Element, Hub, Material, Stiffness, Vibration};
use tautline::robot::{Damping, Linearisation, Strain, Vec2};
use tautline::stability::{CriticalSearch, Eigenproblem, Instability, Method, Outcome};

const MATERIAL: Material = Material::new(6250.0, Strain::Green).expect("positive");
const MU: f64 = 0.4;
const TENSION: f64 = 40.0;
const LENGTH: f64 = 11.0;
const UNDAMPED: Damping = Damping { alpha: 0.0, beta: 0.0 };

/// Wave speed in unstretched metres per second: an unstretched length carries the mass μ and the stiffness N/λ.
fn wave_speed() -> f64 {
    (TENSION / MATERIAL.stretch(TENSION) / MU).sqrt()
}

/// An element of the unstretched length l (m) whose material does not move.
fn element(l: f64, linearisation: Linearisation) -> Element {
    Element::at_rest(MU, l, Stiffness::new(MATERIAL, linearisation, Vec2::new(TENSION, 0.0)))
}

/// A string whose material flows from one fixed end to the other.
fn travelling(n: usize, damping: Damping, linearisation: Linearisation) -> Vibration {
    let element = element(LENGTH / n as f64, linearisation).with_inflow([1.0, 1.0], [0.0, 0.0]);
    let chain = Chain::new(vec![element; n]).expect("elements");
    Vibration::of_cables(vec![chain], Hub::fixed(1), damping, linearisation == Linearisation::Secant).expect("a cable")
}

#[test]
fn frequencies_of_the_travelling_string_converge_quadratically() {
    let (c, modes) = (wave_speed(), 3);
    for v in [0.0, 0.4 * c, 0.8 * c] {
        let exact = |j: usize| (j as f64) * PI * (c * c - v * v) / (LENGTH * c);
        let errors = [20, 40, 80].map(|n| {
            let vibration = travelling(n, UNDAMPED, Linearisation::Secant);
            let spectrum = Eigenproblem::new(&vibration).and_then(|p| p.spectrum(v)).expect("a spectrum");
            let frequencies: Vec<f64> = spectrum.modes().map(|mode| TAU * mode.frequency_hz()).collect();
            assert_eq!(frequencies.len(), n - 1, "one mode per node that moves");
            (1..=modes).map(|j| frequencies[j - 1] / exact(j) - 1.0).collect::<Vec<_>>()
        });
        for j in 1..=modes {
            for (coarse, fine) in [(0, 1), (1, 2)] {
                let order = (errors[coarse][j - 1] / errors[fine][j - 1]).log2();
                // The next term of the error is of order 4: at n = 20 it is (π j/n)² ≈ 0.2 of the first, or less.
                close(order, 2.0, 0.1, format_args!("order of mode {j} at v = {v}, meshes {coarse} and {fine}"));
            }
        }
    }
}

/// K + v² D is (N/λ − μ v²)/l times the same matrix in every element: it loses its definiteness at v = c on any mesh.
/// C is skew with fixed ends, and damping complete: by the theorem of Kelvin, Tait and Chetaev the string is stable
/// exactly as long as K + v² D is positive definite.
#[test]
fn a_damped_travelling_string_is_stable_up_to_the_wave_speed() {
    let c = wave_speed();
    close(c, 10.0, 1.0, "the wave speed, for 1e-6 m/s to mean 1e-7 of it");
    let damped = [Damping { alpha: 0.5, beta: 0.005 }, Damping { alpha: 0.5, beta: 0.0 }];
    for (n, linearisation) in [4, 5, 10, 11, 40]
        .map(|n| (n, Linearisation::Secant))
        .into_iter()
        .chain([(4, Linearisation::Tangent), (11, Linearisation::Tangent)])
    {
        for damping in damped {
            let what = format!("{n} elements, {linearisation:?}, {damping:?}");
            let vibration = travelling(n, damping, linearisation);
            for method in [Method::Structured, Method::Dense] {
                let outcome = CriticalSearch::by(method, 2.0 * c).run(&vibration).expect("eigenvalues");
                let Outcome::Found(critical) = outcome else { panic!("{what}: {outcome:?}") };
                close(critical.speed, c, 1e-6, &what);
                assert_eq!(critical.kind, Instability::Divergence, "{what}");
            }
        }
    }
}

/// The matrices of a string of unstretched length L(t) between fixed ends, S = 0 and S = L(t).
struct Reeled {
    n: usize,
    initial: f64,
    rate: f64,
}

impl Reeled {
    fn length(&self, t: f64) -> f64 {
        self.initial + self.rate * t
    }

    /// The material coordinates S of the nodes that move: they slide along the material.
    fn nodes<D: DualNum<Primitive = f64> + Copy>(&self, t: D) -> Vec<D> {
        let length = t * self.rate + self.initial;
        (1..self.n).map(|k| length * (k as f64 / self.n as f64)).collect()
    }

    /// Assembles what `block` gives for element k, ends removed.
    fn assemble(&self, block: impl Fn(usize) -> Matrix2<f64>) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.n + 1, self.n + 1);
        for k in 0..self.n {
            let mut part = matrix.view_mut((k, k), (2, 2));
            part += block(k);
        }
        matrix.view((1, 1), (self.n - 1, self.n - 1)).into_owned()
    }

    /// q̈ = −M⁻¹ (C q̇ + K q).
    fn acceleration(
        &self,
        mass_shape: &Cholesky<f64, Dyn>,
        t: f64,
        q: &DVector<f64>,
        u: &DVector<f64>,
    ) -> DVector<f64> {
        let n = self.n as f64;
        let l = self.length(t) / n;
        let inflow = |k: usize| [-(k as f64) * self.rate / n, -((k + 1) as f64) * self.rate / n];
        let element = |k| element(l, Linearisation::Secant).with_inflow(inflow(k), [0.0, 0.0]);
        let string = Matrix2::new(1.0, -1.0, -1.0, 1.0) * element(0).elastic()[(0, 0)];
        let flow = self.assemble(|k| element(k).transfer());
        let stiffness = self.assemble(|k| element(k).flow_stiffness() + string);
        // M is μ l times a constant matrix.
        -mass_shape.solve(&(flow * u + stiffness * q)) / (MU * l)
    }

    /// Integrates from (q, q̇) = (q, u) at t = 0 to `end` by Runge and Kutta's method of order 4.
    fn integrate(&self, mut q: DVector<f64>, mut u: DVector<f64>, end: f64, steps: u32) -> DVector<f64> {
        let shape = Matrix2::new(2.0, 1.0, 1.0, 2.0) / 6.0;
        let mass_shape = self.assemble(|_| shape).cholesky().expect("a mass matrix");
        let a = |t: f64, q: &DVector<f64>, u: &DVector<f64>| self.acceleration(&mass_shape, t, q, u);
        let h = end / f64::from(steps);
        for step in 0..steps {
            let t = f64::from(step) * h;
            let (u1, a1) = (u.clone(), a(t, &q, &u));
            let u2 = &u + &a1 * (h / 2.0);
            let a2 = a(t + h / 2.0, &(&q + &u1 * (h / 2.0)), &u2);
            let u3 = &u + &a2 * (h / 2.0);
            let a3 = a(t + h / 2.0, &(&q + &u2 * (h / 2.0)), &u3);
            let u4 = &u + &a3 * h;
            let a4 = a(t + h, &(&q + &u3 * h), &u4);
            q += (u1 + u2 * 2.0 + u3 * 2.0 + u4) * (h / 6.0);
            u += (a1 + a2 * 2.0 + a3 * 2.0 + a4) * (h / 6.0);
        }
        q
    }
}

/// The exact displacement of a string with L = L₀ + v t (docs/theory.md section 10, j = 1).
fn exact<D: DualNum<Primitive = f64> + Copy>(c: f64, string: &Reeled, s: D, t: D) -> D {
    let (v, l) = (string.rate, string.initial);
    let f = |z: D| ((z * (v / (c * l)) + 1.0).ln() * (TAU / ((c + v) / (c - v)).ln())).sin();
    f(t * c + s) - f(t * c - s)
}

#[test]
fn a_string_reeled_in_follows_the_exact_solution() {
    let c = wave_speed();
    // Relative errors that an independent program found: largest deviation at the end, of the largest displacement.
    for (n, expected) in [(10, 0.0414), (20, 0.0103), (40, 0.00256)] {
        let string = Reeled { n, initial: LENGTH, rate: -0.3 * c };
        // Until half of it is reeled in.
        let end = 0.5 * LENGTH / (0.3 * c);
        let string = &string;
        let node = |k: usize| move |t| exact(c, string, string.nodes(t)[k], t);
        let (q, u): (Vec<f64>, Vec<f64>) = (0..n - 1).map(|k| first_derivative(node(k), 0.0)).unzip();
        // The fastest mode has ω = √12 c/l, in the end 250/s: with 2000 steps ω h stays below 0.25, and the modes that
        // matter are ten times slower. The error of the mesh is far larger.
        let actual = string.integrate(q.into(), u.into(), end, 2000);
        let expected_shape: DVector<f64> =
            string.nodes(end).into_iter().map(|s| exact(c, string, s, end)).collect::<Vec<_>>().into();
        let error = (actual - &expected_shape).amax() / expected_shape.amax();
        // The numbers are rounded to three digits.
        close(error, expected, 0.02 * expected, format_args!("relative error with {n} elements"));
    }
}
