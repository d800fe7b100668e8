//! The small-vibration problem as full matrices, put together from docs/theory.md sections 3, 4 and 7 without the
//! crate's elements, chains and eigenvalue solver.

use nalgebra::{Complex, DMatrix, DVector, Matrix2};
use tautline::Robot;
use tautline::mechanics::{LengthRates, Statics};
use tautline::robot::{Damping, Linearisation};

use super::hung::{Hung, mass_per_length};

/// M q̈ + C q̇ + K q = 0 with the unknowns: platform, then the inner nodes of cable 1 from the platform, of cable 2 …
pub struct Dense {
    /// M.
    pub mass: DMatrix<f64>,
    /// The flow matrix C, αM and βK, all in one.
    pub damping: DMatrix<f64>,
    /// The elastic stiffness alone.
    pub elastic: DMatrix<f64>,
    /// `K_el` and `K_dyn`.
    pub stiffness: DMatrix<f64>,
}

/// What the problem at every speed is made of: C grows with the speed, `K_dyn` with its square.
pub struct Parts {
    /// M.
    pub mass: DMatrix<f64>,
    /// C at 1 m/s.
    pub flow: DMatrix<f64>,
    /// `K_el`.
    pub elastic: DMatrix<f64>,
    /// `K_dyn` at 1 m/s.
    pub dynamic: DMatrix<f64>,
    /// α and β.
    pub damping: Damping,
}

impl Parts {
    /// The parts at a static shape.
    pub fn new(robot: &Robot, statics: &Statics, rates: &[LengthRates]) -> Self {
        let n = robot.elements;
        let size = 2 * (1 + robot.cables.len() * (n - 1));
        let zeros = || DMatrix::<f64>::zeros(size, size);
        let (mut mass, mut flow, mut elastic, mut dynamic) = (zeros(), zeros(), zeros(), zeros());
        mass[(0, 0)] = robot.platform_mass;
        mass[(1, 1)] = robot.platform_mass;
        for (i, (shape, rate)) in statics.cables.iter().zip(rates).enumerate() {
            let (law, mu) = (Hung::of(robot, i), mass_per_length(robot, i));
            let l = shape.length / n as f64;
            let (l_rate, l_acceleration) = (rate.first / n as f64, rate.second / n as f64);
            // The first unknown of node k; none for the winch.
            let unknown = |k: usize| match k {
                0 => Some(0),
                _ if k == n => None,
                _ => Some(2 * (1 + i * (n - 1) + k - 1)),
            };
            for k in 0..n {
                let (start, end) = (k as f64, (k + 1) as f64);
                let inflow = |factor: f64| {
                    let (w0, w1) = (-start * factor, -end * factor);
                    let (a, b) = (w0 / 3.0 + w1 / 6.0, w0 / 6.0 + w1 / 3.0);
                    Matrix2::new(-a, a, -b, b) * mu
                };
                let centrifugal = mu / l * (l_rate * l_rate) * (start * start + start * end + end * end) / 3.0;
                let difference = Matrix2::new(1.0, -1.0, -1.0, 1.0);
                let element_mass = Matrix2::new(2.0, 1.0, 1.0, 2.0) * (mu * l / 6.0);
                let element_flow = inflow(l_rate) * 2.0;
                let element_dynamic = inflow(l_acceleration) - difference * centrifugal;

                let force = shape.forces[k].norm();
                let along = shape.nodes[k + 1] - shape.nodes[k];
                let stretch = along.norm() / l;
                let e = along.normalize();
                let projection = e * e.transpose();
                let block = match robot.linearisation {
                    Linearisation::Secant => Matrix2::identity() * (force / stretch),
                    Linearisation::Tangent => {
                        (Matrix2::identity() - projection) * (force / stretch) + projection * law.law(stretch).1
                    }
                } / l;

                for (row, at_row) in [k, k + 1].into_iter().enumerate() {
                    for (column, at_column) in [k, k + 1].into_iter().enumerate() {
                        let (Some(r), Some(c)) = (unknown(at_row), unknown(at_column)) else { continue };
                        for a in 0..2 {
                            mass[(r + a, c + a)] += element_mass[(row, column)];
                            flow[(r + a, c + a)] += element_flow[(row, column)];
                            dynamic[(r + a, c + a)] += element_dynamic[(row, column)];
                            for b in 0..2 {
                                elastic[(r + a, c + b)] += difference[(row, column)] * block[(a, b)];
                            }
                        }
                    }
                }
            }
        }
        Self { mass, flow, elastic, dynamic, damping: robot.damping }
    }

    /// The problem at `speed`.
    pub fn at(&self, speed: f64) -> Dense {
        Dense {
            mass: self.mass.clone(),
            damping: &self.flow * speed + &self.mass * self.damping.alpha + &self.elastic * self.damping.beta,
            elastic: self.elastic.clone(),
            stiffness: &self.elastic + &self.dynamic * (speed * speed),
        }
    }

    /// The problem of x alone, where y has the same and neither feels the other.
    pub fn one_direction(&self) -> Option<Self> {
        let half = self.mass.nrows() / 2;
        let part = |matrix: &DMatrix<f64>| {
            let block = |a: usize, b: usize| DMatrix::from_fn(half, half, |i, j| matrix[(2 * i + a, 2 * j + b)]);
            let apart = block(0, 1).amax() == 0.0 && block(1, 0).amax() == 0.0;
            (apart && block(0, 0) == block(1, 1)).then(|| block(0, 0))
        };
        Some(Self {
            mass: part(&self.mass)?,
            flow: part(&self.flow)?,
            elastic: part(&self.elastic)?,
            dynamic: part(&self.dynamic)?,
            damping: self.damping,
        })
    }
}

impl Dense {
    /// The problem at a static shape, at `speed`.
    pub fn new(robot: &Robot, statics: &Statics, rates: &[LengthRates], speed: f64) -> Self {
        Parts::new(robot, statics, rates).at(speed)
    }

    /// The sum of all eigenvalues and the sum of their squares, from traces.
    pub fn moments(&self) -> (f64, f64) {
        let mass = self.mass.clone().cholesky().expect("a positive mass matrix");
        let (damping, stiffness) = (mass.solve(&self.damping), mass.solve(&self.stiffness));
        (-damping.trace(), (&damping * &damping).trace() - 2.0 * stiffness.trace())
    }

    /// Squares of the frequencies of M q̈ + `K_el` q = 0.
    pub fn squared_frequencies(&self) -> Vec<f64> {
        let lower = self.mass.clone().cholesky().expect("a positive mass matrix").unpack();
        let half = lower.solve_lower_triangular(&self.elastic).expect("an invertible factor");
        let reduced = lower.solve_lower_triangular(&half.transpose()).expect("an invertible factor");
        ((&reduced + reduced.transpose()) * 0.5).symmetric_eigenvalues().iter().copied().collect()
    }

    /// Of Q(λ) = λ² M + λ C + K in the largest component: |Q q|, |dQ/dλ q|, and the size of Q times that of q.
    pub fn residual(&self, lambda: Complex<f64>, q: &DVector<Complex<f64>>) -> (f64, f64, f64) {
        let apply = |matrix: &DMatrix<f64>| {
            let (re, im) = (matrix * q.map(|c| c.re), matrix * q.map(|c| c.im));
            re.zip_map(&im, Complex::new)
        };
        let (mass, damping, stiffness) = (apply(&self.mass), apply(&self.damping), apply(&self.stiffness));
        let norm = |v: DVector<Complex<f64>>| v.iter().map(|c| c.norm()).fold(0.0, f64::max);
        let size = lambda.norm_sqr() * self.mass.amax() + lambda.norm() * self.damping.amax() + self.stiffness.amax();
        (
            norm(&mass * (lambda * lambda) + &damping * lambda + stiffness),
            norm(mass * (lambda * 2.0) + damping),
            size * norm(q.clone()),
        )
    }
}
