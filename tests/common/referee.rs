//! All eigenvalues of one robot's small vibrations by a dense eigenvalue solver that is not the crate's, from matrices
//! that are not the crate's ([`super::dense`]), with bounds of their rounding errors.

use std::panic::{AssertUnwindSafe, catch_unwind};

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, evd_real, evd_scratch};
use faer::linalg::solvers::Solve;
use faer::{Col, Mat, MatMut, MatRef, Par};
use nalgebra::{Complex, DMatrix, DVector};
use tautline::Robot;
use tautline::mechanics::{LengthRates, Statics};
use tautline::robot::Linearisation;

use super::dense::Parts;

type C64 = Complex<f64>;

/// The problem (λ² M + λ (v C + αM + βK) + K + v² D) q = 0, prepared for many speeds.
///
/// With M = L Lᵀ, x = Lᵀ q and λ = Ω s, the eigenvalues s are those of the companion matrix of two blocks
/// A = [[0, I], [−L⁻¹ (K + v² D) L⁻ᵀ/Ω², −L⁻¹ (v C + αM + βK) L⁻ᵀ/Ω]].
pub struct Referee {
    /// Ω in rad/s: its square is the largest entry of L⁻¹ K L⁻ᵀ.
    pub scale: f64,
    /// How often each eigenvalue counts: twice where x and y are two equal problems of which one is solved.
    pub multiplicity: usize,
    /// L.
    lower: DMatrix<f64>,
    /// A at rest, and what the speed and its square add.
    at_rest: DMatrix<f64>,
    by_speed: DMatrix<f64>,
    by_square: DMatrix<f64>,
}

/// An eigenvalue with what is known about it.
#[derive(Clone, Debug)]
pub struct Known {
    /// λ in 1/s.
    pub lambda: C64,
    /// How far rounding may have moved it, in 1/s.
    pub error: f64,
    /// dλ/dv in 1/m.
    pub slope: C64,
    /// The mode's displacements.
    pub shape: DVector<C64>,
}

impl Referee {
    /// The problem at a static shape; where x and y are two equal problems, that of one.
    pub fn new(robot: &Robot, statics: &Statics, rates: &[LengthRates]) -> Self {
        let parts = Parts::new(robot, statics, rates);
        match robot.linearisation {
            Linearisation::Secant => Self::of(&parts.one_direction().expect("two equal problems"), 2),
            Linearisation::Tangent => Self::of(&parts, 1),
        }
    }

    /// The whole problem of x and y, also where it is twice the same one.
    pub fn without_structure(robot: &Robot, statics: &Statics, rates: &[LengthRates]) -> Self {
        Self::of(&Parts::new(robot, statics, rates), 1)
    }

    fn of(parts: &Parts, multiplicity: usize) -> Self {
        let size = parts.mass.nrows();
        let lower = parts.mass.clone().cholesky().expect("a positive mass matrix").unpack();
        let reduce = |matrix: &DMatrix<f64>| {
            let half = lower.solve_lower_triangular(matrix).expect("an invertible factor");
            lower.solve_lower_triangular(&half.transpose()).expect("an invertible factor").transpose()
        };
        let (elastic, flow, dynamic) = (reduce(&parts.elastic), reduce(&parts.flow), reduce(&parts.dynamic));
        let scale = elastic.amax().sqrt();
        let at_rest = &elastic * parts.damping.beta + DMatrix::identity(size, size) * parts.damping.alpha;
        let companion = |upper: f64, left: &DMatrix<f64>, right: &DMatrix<f64>| {
            let mut matrix = DMatrix::zeros(2 * size, 2 * size);
            matrix.view_mut((0, size), (size, size)).fill_diagonal(upper);
            matrix.view_mut((size, 0), (size, size)).copy_from(&(left / (-scale * scale)));
            matrix.view_mut((size, size), (size, size)).copy_from(&(right / -scale));
            matrix
        };
        let zero = DMatrix::zeros(size, size);
        Self {
            scale,
            multiplicity,
            at_rest: companion(1.0, &elastic, &at_rest),
            by_speed: companion(0.0, &zero, &flow),
            by_square: companion(0.0, &dynamic, &zero),
            lower,
        }
    }

    /// The number of eigenvalues that are computed.
    pub fn size(&self) -> usize {
        self.at_rest.nrows()
    }

    /// A at `speed`.
    fn companion(&self, speed: f64) -> DMatrix<f64> {
        &self.at_rest + &self.by_speed * speed + &self.by_square * (speed * speed)
    }

    /// The eigenvalues at `speed`, in 1/s, once each; `None` where the solver has not converged.
    pub fn eigenvalues(&self, speed: f64) -> Option<Vec<C64>> {
        let matrix = self.companion(speed);
        let values = eigenvalues(&matrix, None)?;
        // The solver does not tell when it has given up. But then the sums of eigenvalues and of squares are wrong.
        let (sum, squares): (C64, C64) = (values.iter().sum(), values.iter().map(|s| s * s).sum());
        let error = backward_error(&matrix);
        let of_square = matrix.transpose().dot(&matrix);
        let complete = (sum - matrix.trace()).norm() <= error * (matrix.nrows() as f64).sqrt()
            && (squares - of_square).norm() <= 2.0 * error * matrix.norm();
        complete.then(|| values.iter().map(|s| s * self.scale).collect())
    }

    /// The largest growth rate at `speed`, in 1/s.
    pub fn growth_rate(&self, speed: f64) -> Option<f64> {
        self.eigenvalues(speed).map(|values| values.iter().map(|l| l.re).fold(f64::NEG_INFINITY, f64::max))
    }

    /// The first speed (m/s) at which a mode grows, found without the structure: by all eigenvalues at speeds `step` apart,
    /// then by bisection to 1e-9 m/s.
    pub fn scan(&self, step: f64, limit: f64) -> Option<f64> {
        let grows = |speed: f64| self.growth_rate(speed).expect("eigenvalues") > 0.0;
        let mut speed = 0.0;
        while speed < limit {
            let before = speed;
            speed += step;
            if grows(speed) {
                let (mut stable, mut unstable) = (before, speed);
                while unstable - stable > 1e-9 {
                    let middle = 0.5 * (stable + unstable);
                    if grows(middle) {
                        unstable = middle;
                    } else {
                        stable = middle;
                    }
                }
                return Some(unstable);
            }
        }
        None
    }

    /// The eigenvalues at `speed` with their errors, slopes and shapes; `None` where the solver has not converged.
    pub fn known(&self, speed: f64) -> Option<Vec<Known>> {
        self.eigenvalues(speed)?;
        let matrix = self.companion(speed);
        let n = matrix.nrows();
        let (mut left, mut right) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
        let values = eigenvalues(&matrix, Some([&mut left, &mut right]))?;
        let backward = backward_error(&matrix);
        let slope = &self.by_speed + &self.by_square * (2.0 * speed);
        let vector = |of: &DMatrix<f64>, j: usize, im: f64| {
            // Of a pair, real and imaginary part stand side by side.
            let (at, sign) = if im < 0.0 { (j - 1, -1.0) } else { (j, 1.0) };
            let zero_or = |i: usize| if im == 0.0 { 0.0 } else { sign * of[(i, at + 1)] };
            DVector::from_fn(n, |i, _| C64::new(of[(i, at)], zero_or(i)))
        };
        let apply =
            |m: &DMatrix<f64>, v: &DVector<C64>| (m * v.map(|c| c.re)).zip_map(&(m * v.map(|c| c.im)), C64::new);
        let upper = self.lower.transpose();
        let one = |(j, &s): (usize, &C64)| {
            let (l, r) = (vector(&left, j, s.im), vector(&right, j, s.im));
            let product = l.dotc(&r);
            let condition = l.norm() * r.norm() / product.norm();
            let x = r.rows(0, n / 2).into_owned();
            let half = |part: fn(&C64) -> f64| {
                upper.solve_upper_triangular(&x.map(|c| part(&c))).expect("an invertible factor")
            };
            Known {
                lambda: s * self.scale,
                error: backward * condition * self.scale,
                slope: l.dotc(&apply(&slope, &r)) / product * self.scale,
                shape: half(|c| c.re).zip_map(&half(|c| c.im), C64::new),
            }
        };
        Some(values.iter().enumerate().map(one).collect())
    }

    /// How far Q(λ) = λ² M + λ (v C + αM + βK) + K + v² D is from a singular matrix, in the coordinates x and as part of
    /// its terms: an upper bound of `σ_min`(Q)/(|λ|² ‖M‖ + |λ| ‖v C + αM + βK‖ + ‖K + v² D‖), from a vector that Q makes
    /// small; and how much of that a relative change of λ makes.
    pub fn distance_from_singular(&self, speed: f64, lambda: C64) -> (f64, f64) {
        let (matrix, n, s) = (self.companion(speed), self.size() / 2, lambda / self.scale);
        let (stiffness, damping) = (matrix.view((n, 0), (n, n)), matrix.view((n, n), (n, n)));
        let of = |square: C64, linear: C64, constant: f64| {
            let unit = |i: usize, j: usize| if i == j { square } else { C64::from(0.0) };
            Mat::from_fn(n, n, |i, j| unit(i, j) - linear * damping[(i, j)] - constant * stiffness[(i, j)])
        };
        let (q, slope) = (of(s * s, s, 1.0), of(s * s * 2.0, s, 0.0));
        let size = s.norm_sqr() * (n as f64).sqrt() + s.norm() * damping.norm() + stiffness.norm();
        let factors = q.partial_piv_lu();
        let unit = |x: Mat<C64>| &x * faer::Scale(C64::from(1.0 / x.norm_l2()));
        // Inverse iteration with Q* Q, from a vector without symmetry.
        let mut x = Mat::from_fn(n, 1, |i, _| C64::new(1.0, 0.5 + (i as f64 * 0.618_033_988_749_895).fract()));
        for _ in 0..2 {
            x = unit(factors.solve(&unit(factors.solve_adjoint(&x))));
        }
        ((&q * &x).norm_l2() / size, (&slope * &x).norm_l2() / size)
    }
}

/// All speeds in m/s at which `K_el` + `K_dyn` is singular, in rising order: with an eigenvalue κ < 0 of `K_el`⁻¹ D, the
/// speed is (−1/κ)^½. `None` where the solver has not converged.
pub fn divergences(parts: &Parts) -> Option<Vec<f64>> {
    let flexible = parts.elastic.clone().cholesky()?.solve(&parts.dynamic);
    let values = eigenvalues(&flexible, None)?;
    let real = values.iter().filter(|value| value.im == 0.0 && value.re < 0.0);
    let mut speeds: Vec<f64> = real.map(|value| (-1.0 / value.re).sqrt()).collect();
    speeds.sort_by(f64::total_cmp);
    Some(speeds)
}

/// How far from `matrix`, in the Frobenius norm, the one is whose eigenvalues a backward stable solver gives: c n ε ‖A‖.
/// The c that can be proved grows with n as well; traces of squares show at most 2.
fn backward_error(matrix: &DMatrix<f64>) -> f64 {
    4.0 * matrix.nrows() as f64 * f64::EPSILON * matrix.norm()
}

/// The eigenvalues of a matrix by faer, on one thread; left and right eigenvectors where there is room for them.
fn eigenvalues(matrix: &DMatrix<f64>, vectors: Option<[&mut DMatrix<f64>; 2]>) -> Option<Vec<C64>> {
    let n = matrix.nrows();
    let (mut re, mut im) = (Col::<f64>::zeros(n), Col::<f64>::zeros(n));
    let wanted = if vectors.is_some() { ComputeEigenvectors::Yes } else { ComputeEigenvectors::No };
    let mut buffer = MemBuffer::new(evd_scratch::<f64>(n, wanted, wanted, Par::Seq, faer::prelude::default()));
    let [left, right] = match vectors {
        Some(pair) => pair.map(|m| Some(MatMut::from_column_major_slice_mut(m.as_mut_slice(), n, n))),
        None => [None, None],
    };
    let solve = || {
        evd_real(
            MatRef::from_column_major_slice(matrix.as_slice(), n, n),
            re.as_diagonal_mut(),
            im.as_diagonal_mut(),
            left,
            right,
            Par::Seq,
            MemStack::new(&mut buffer),
            faer::prelude::default(),
        )
    };
    // For some matrices the solver's index runs out of bounds, and it panics.
    catch_unwind(AssertUnwindSafe(solve)).ok()?.expect("finite entries");
    Some(re.iter().zip(im.iter()).map(|(&re, &im)| C64::new(re, im)).collect())
}
