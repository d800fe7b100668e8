//! The spectrum by a dense eigenvalue solver: the companion matrix of the quadratic problem, nalgebra's Schur form.

use nalgebra::{Complex, DMatrix, Schur};

use crate::mechanics::Vibration;
use crate::robot::Damping;
use crate::stability::spectrum::Rounding;
use crate::stability::{NotConverged, Solver, Spectrum};

/// Iterations per eigenvalue after which the Schur form counts as not converging; it needs two or three.
const ITERATIONS_PER_EIGENVALUE: usize = 60;
/// The Schur form's backward error is this many times n ε ‖A‖. What can be proved grows with n as well; traces of squares show
/// at most 2.
const BACKWARD: f64 = 4.0;

/// The eigenvalue problem (λ² M + λ (v C + αM + βK) + K + v² D) q = 0 of a [`Vibration`], prepared for many speeds.
///
/// With the Cholesky factor M = L Lᵀ, x = Lᵀ q and λ = Ω s, Ω² the largest entry of L⁻¹ K L⁻ᵀ, the eigenvalues s are
/// those of [[0, I], [−K̃/Ω², −C̃/Ω]]: the blocks have entries of order one, the last of order βΩ where that is larger.
/// An isotropic problem is solved for one of its two equal directions, and each eigenvalue counted twice.
#[derive(Clone, Debug)]
pub struct Eigenproblem {
    transfer: DMatrix<f64>,
    flow: DMatrix<f64>,
    elastic: DMatrix<f64>,
    damping: Damping,
    scale: f64,
    multiplicity: usize,
}

impl Eigenproblem {
    /// Assembles and reduces the problem.
    ///
    /// # Errors
    /// [`NotConverged`] where masses or stiffnesses leave the range of floating point.
    pub fn new(vibration: &Vibration) -> Result<Self, NotConverged> {
        let directions = if vibration.isotropic { 1 } else { 2 };
        let size = directions * vibration.nodes();
        let zero = || DMatrix::<f64>::zeros(size, size);
        let (mut mass, mut transfer, mut flow, mut elastic) = (zero(), zero(), zero(), zero());

        // Of one direction the hub is a point.
        let hub = &vibration.hub;
        let dof = if vibration.isotropic { hub.dof().min(1) } else { hub.dof() };
        mass.view_mut((0, 0), (dof, dof)).copy_from(&hub.mass().view((0, 0), (dof, dof)));
        elastic.view_mut((0, 0), (dof, dof)).copy_from(&hub.stiffness().view((0, 0), (dof, dof)));
        let mut next = dof;
        for (chain, joint) in vibration.chains.iter().zip(hub.joints()) {
            let winch = chain.elements().len();
            // The unknowns that make up the displacement of node k in a direction, each with its factor.
            let unknowns = |k: usize, direction: usize| -> Vec<(usize, f64)> {
                match k {
                    0 => (0..dof).map(|q| (q, joint[(direction, q)])).filter(|&(_, factor)| factor != 0.0).collect(),
                    _ if k == winch => Vec::new(),
                    _ => vec![(next + directions * (k - 1) + direction, 1.0)],
                }
            };
            for (k, element) in chain.elements().iter().enumerate() {
                let of = element.matrices();
                for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let sign = if i == j { 1.0 } else { -1.0 };
                    for a in 0..directions {
                        for b in 0..directions {
                            for &(row, left) in &unknowns(k + i, a) {
                                for &(column, right) in &unknowns(k + j, b) {
                                    let (at, factor) = ((row, column), left * right);
                                    if a == b {
                                        mass[at] += factor * of.mass[(i, j)];
                                        transfer[at] += factor * of.transfer[(i, j)];
                                        flow[at] += factor * of.flow[(i, j)];
                                    }
                                    elastic[at] += factor * sign * of.elastic[(a, b)];
                                }
                            }
                        }
                    }
                }
            }
            next += directions * chain.inner_nodes();
        }

        let lower = mass.cholesky().ok_or(NotConverged)?.unpack();
        let reduce = |matrix: DMatrix<f64>| -> Result<DMatrix<f64>, NotConverged> {
            let left = lower.solve_lower_triangular(&matrix).ok_or(NotConverged)?;
            let both = lower.solve_lower_triangular(&left.transpose()).ok_or(NotConverged)?;
            Ok(both.transpose())
        };
        let elastic = reduce(elastic)?;
        let scale = elastic.amax().sqrt();
        if !(scale.is_normal() && scale.is_finite()) {
            return Err(NotConverged);
        }
        Ok(Self {
            transfer: reduce(transfer)? / scale,
            flow: reduce(flow)? / (scale * scale),
            elastic: elastic / (scale * scale),
            damping: vibration.damping,
            scale,
            multiplicity: if vibration.isotropic { 2 } else { 1 },
        })
    }

    /// The frequency Ω in rad/s by which eigenvalues are scaled: about the largest of the undamped problem. Their
    /// rounding errors are a small multiple of machine precision times Ω.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// ω̂² of all undamped modes at rest, in 1/s²: the eigenvalues of K against M.
    #[cfg(test)]
    pub(super) fn undamped_squares(&self) -> Vec<f64> {
        let squares = self.elastic.symmetric_eigenvalues();
        squares.iter().map(|square| square * self.scale * self.scale).collect()
    }

    /// All eigenvalues at `speed` (m/s), in 1/s.
    ///
    /// # Errors
    /// [`NotConverged`].
    pub fn spectrum(&self, speed: f64) -> Result<Spectrum, NotConverged> {
        let n = self.elastic.nrows();
        let stiffness = &self.elastic + &self.flow * (speed * speed);
        let mut damping = &self.transfer * speed + &self.elastic * (self.damping.beta * self.scale);
        for i in 0..n {
            damping[(i, i)] += self.damping.alpha / self.scale;
        }
        let mut companion = DMatrix::zeros(2 * n, 2 * n);
        companion.view_mut((0, n), (n, n)).fill_with_identity();
        companion.view_mut((n, 0), (n, n)).copy_from(&-stiffness);
        companion.view_mut((n, n), (n, n)).copy_from(&-damping);
        if !companion.iter().all(|entry| entry.is_finite()) {
            return Err(NotConverged);
        }
        let eigenvalues = eigenvalues(&companion).ok_or(NotConverged)?;
        let eigenvalues = eigenvalues.iter().map(|s| s * self.scale).collect();
        // They are those of a matrix so near to it (Golub and Van Loan, Matrix Computations, section 7.5).
        let absolute = BACKWARD * (2 * n) as f64 * f64::EPSILON * companion.norm() * self.scale;
        Spectrum::new(speed, Solver::Dense, Rounding { relative: 0.0, absolute }, eigenvalues, self.multiplicity)
    }
}

/// The eigenvalues of a matrix; `None` where the iteration stalls, as it may for βΩ beyond about 1e4.
fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let size = matrix.nrows();
    // The iteration may stall on the diagonal's zeros, since it measures what it neglects against the diagonal. With
    // the diagonal moved to one it measures against the norm, as backward stability asks for.
    // Heavy stiffness damping makes the norm larger than one.
    [0.0, 1.0, matrix.amax()].into_iter().find_map(|shift| {
        let shifted = matrix + DMatrix::from_diagonal_element(size, size, shift);
        let schur = Schur::try_new(shifted, f64::EPSILON, ITERATIONS_PER_EIGENVALUE * size)?;
        Some(schur.complex_eigenvalues().iter().map(|s| s - shift).collect())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::Chain;
    use crate::robot::paper_spec;
    use crate::stability::{Spectra, problems};

    /// What rounding may do covers what it does to the eigenvalues, which the iteration by structure knows better, and not
    /// much more. In a unit of time half as long it is half of that.
    #[test]
    fn rounding_is_that_of_the_matrix() {
        let vibration = problems::of_robot(paper_spec(), [2.0, 0.5], [1.0, 0.0]);
        let of = |vibration: &Vibration, speed| Eigenproblem::new(vibration).unwrap().spectrum(speed).unwrap();
        let (found, exact) = (of(&vibration, 5.0), Spectra::new(&vibration).unwrap().iterate(5.0).unwrap());
        let off = |value: Complex<f64>| {
            let nearest = found.eigenvalues().map(|other| (other - value).norm());
            nearest.fold(f64::INFINITY, f64::min)
        };
        let (off, claimed) = (exact.eigenvalues().map(off).fold(0.0, f64::max), found.rounding(Complex::from(0.0)));
        assert!(off < claimed && claimed < 100.0 * off, "{off:e} off, {claimed:e} claimed");
        let mut faster = vibration.clone();
        faster.damping = Damping { alpha: 2.0 * faster.damping.alpha, beta: 0.5 * faster.damping.beta };
        faster.chains.iter_mut().flat_map(Chain::elements_mut).for_each(|element| {
            element.stiffness.along *= 4.0;
            element.stiffness.across *= 4.0;
        });
        let half = 0.5 * of(&faster, 10.0).rounding(Complex::from(0.0));
        assert!((half - claimed).abs() < 1e-12 * claimed, "{half:e} {claimed:e}");
    }
}
