//! All eigenvalues at one speed by the Ehrlich–Aberth iteration on the characteristic function.
//!
//! With g = ∂ ln det Q/∂λ = Σ 1/(λ − λⱼ), each estimate z moves by −1/(g(z) − Σ 1/(z − zₖ)), the sum over all other
//! estimates: Newton's method on what remains once the others are divided out, so that no two estimates go to the same
//! eigenvalue. At rest the eigenvalues are those of λ² + (α + β ω̂²) λ + ω̂² = 0 with the undamped frequencies ω̂;
//! estimates of these are the start, or the eigenvalues at the speed before. docs/theory.md section 11.

use nalgebra::Complex;

use super::characteristic::Characteristic;
use super::undamped;
use crate::mechanics::Vibration;
use crate::stability::spectrum::Rounding;
use crate::stability::steps::{finish, step as step_ended};
use crate::stability::{Eigenproblem, ModeValue, NotConverged, Solver, Spectrum};

type C64 = Complex<f64>;

/// Sweeps over the estimates that have not converged before the iteration is given up. The last few take the longest.
const SWEEPS: usize = 150;
/// An estimate has converged when its step is this part of it. It has also converged when the step is
/// [`ROUNDING_OF_STEPS`] of the largest frequency, and not much smaller than the step before.
const CONVERGED: f64 = 1e-9;
/// Rounding may move eigenvalues by more than that: where thousands of overdamped modes crowd together, or stiff modes are
/// a million times faster than slow ones. After all sweeps a step of this part of its estimate is accepted if the sums over
/// all eigenvalues are right. That leaves the six digits that are promised.
const STAGNATED: f64 = 3e-7;
/// When all estimates have converged, the next step would be about this part of each. Steps get smaller even faster than by
/// Newton's method.
const ITERATED: f64 = 1e-12;
/// Steps below this part of the largest frequency are rounding.
const ROUNDING_OF_STEPS: f64 = 1e-15;
/// An estimate whose step cannot be computed is moved by this part of itself.
const ASIDE: f64 = 1e-8;
/// A step is at most this part of the estimate.
const LARGEST_STEP: f64 = 0.5;
/// Where pairs are not kept together, estimates are moved off the real axis and off each other, by this part of the distance
/// to the nearest other one.
const SPREAD: f64 = 0.1;
/// After this many failures the dense solver is asked at once.
const PATIENCE: usize = 3;
/// The dense solver is not asked about more degrees of freedom than this: it would take minutes.
const LARGEST_DENSE: usize = 700;
/// Sweeps over the slowest estimates where they are wanted first.
const SLOWEST_SWEEPS: usize = 40;
/// The iteration for the slowest ones goes on with this many estimates more than are wanted.
const BESIDE: usize = 8;
/// An eigenvalue is real if its imaginary part is below this part of it; two are the same if their difference is.
const REAL: f64 = 1e-7;
/// The sums over the eigenvalues must agree with what they are known to be to this part of their terms' sum.
const AGREEMENT: f64 = 1e-7;

/// A solver for the spectra of one problem at one speed after the other.
///
/// ```
/// use tautline::{LocalProblem, Motion, robot};
///
/// let motion = Motion::new([0.0, 0.0], [1.0, 0.0], 5.0)?;
/// let local = LocalProblem::new(&robot::paper()?, &motion).map_err(|failure| failure.reason)?;
/// let mut spectra = local.spectra.clone();
/// let growth = [5.0, 12.0].map(|speed| spectra.spectrum(&local.vibration, speed).map(|spectrum| spectrum.growth_rate()));
/// assert!(matches!(growth, [Ok(below), Ok(above)] if below < 0.0 && above > 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Spectra {
    function: Characteristic,
    /// Estimates of ω̂² of all undamped modes, in 1/s².
    squares: Vec<f64>,
    /// −Σ λⱼ at rest in 1/s, and what a unit of speed adds to it, in 1/m.
    damping: [f64; 2],
    alpha: f64,
    beta: f64,
    scale: f64,
    multiplicity: usize,
    /// The last spectrum.
    last: Option<Estimates>,
    /// The dense solver, once it had to help, and how often it had to.
    dense: Option<Eigenproblem>,
    failures: usize,
}

/// Estimates of all eigenvalues.
#[derive(Clone, Debug)]
struct Estimates {
    /// All of them; of a pair the one with positive imaginary part alone where `paired`.
    values: Vec<C64>,
    paired: bool,
}

impl Spectra {
    /// Prepares the solver.
    ///
    /// # Errors
    /// [`NotConverged`] where masses or stiffnesses leave the range of floating point.
    pub fn new(vibration: &Vibration) -> Result<Self, NotConverged> {
        let squares = undamped::squares(vibration);
        let (alpha, beta) = (vibration.damping.alpha, vibration.damping.beta);
        let [elastic, transfer] = undamped::traces(vibration);
        let damping = [alpha * squares.len() as f64 + beta * elastic, transfer];
        let scale = undamped::largest_frequency(vibration);
        let sound = |number: &f64| number.is_normal();
        if !(scale.is_normal() && squares.iter().all(sound) && damping.iter().all(|number| number.is_finite())) {
            return Err(NotConverged);
        }
        Ok(Self {
            function: Characteristic::new(vibration),
            damping,
            squares,
            alpha,
            beta,
            scale,
            multiplicity: if vibration.isotropic { 2 } else { 1 },
            last: None,
            dense: None,
            failures: 0,
        })
    }

    /// The frequency Ω in rad/s that no undamped mode exceeds: rounding errors of eigenvalues are small against it.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// All eigenvalues at `speed` (m/s) of the same `vibration`, by the dense solver where the iteration leaves doubt;
    /// [`Spectrum::solver`] tells which.
    ///
    /// # Errors
    /// [`NotConverged`] where neither solver has converged.
    pub fn spectrum(&mut self, vibration: &Vibration, speed: f64) -> Result<Spectrum, NotConverged> {
        finish(self.spectrum_in_steps(vibration, speed))
    }

    /// The same in [steps](super::steps) of about one evaluation of det Q; only the dense solver is one step.
    ///
    /// # Errors
    /// As [`Self::spectrum`].
    pub async fn spectrum_in_steps(&mut self, vibration: &Vibration, speed: f64) -> Result<Spectrum, NotConverged> {
        if self.failures < PATIENCE {
            if let Some(spectrum) = self.iterate_in_steps(speed).await {
                return Ok(spectrum);
            }
            self.failures += 1;
        }
        if self.dense.is_none() && self.squares.len() <= LARGEST_DENSE {
            self.dense = Some(Eigenproblem::new(vibration)?);
        }
        let dense = self.dense.as_ref().ok_or(NotConverged)?.spectrum(speed)?;
        // The dense solver knows slow modes to a part of the fastest one only. Begun from there the iteration may converge,
        // to all digits.
        let near = Estimates { values: dense.modes().map(|mode| mode.eigenvalue).collect(), paired: true };
        let apart = near.unpaired().await;
        if let Some(spectrum) = self.solve(apart, speed).await.and_then(|found| self.accept(found, speed)) {
            return Ok(spectrum);
        }
        // Newton's step tells how far the dense solver is off where it decides stability.
        let slope = self.function.at(dense.rightmost(), speed).by_lambda;
        Ok(dense.known_to(inverse(slope).norm()))
    }

    /// The same without the dense solver; `None` where the iteration does not converge to as many eigenvalues as
    /// there are.
    pub fn iterate(&mut self, speed: f64) -> Option<Spectrum> {
        finish(self.iterate_in_steps(speed))
    }

    async fn iterate_in_steps(&mut self, speed: f64) -> Option<Spectrum> {
        if let Some(near) = self.last.take()
            && let Some(found) = self.solve(near, speed).await
        {
            return self.accept(found, speed);
        }
        let at_rest = self.at_rest().await;
        let apart = at_rest.paired.then(|| at_rest.clone());
        let mut found = self.solve(at_rest, speed).await;
        if let (None, Some(at_rest)) = (&found, apart) {
            let apart = at_rest.unpaired().await;
            found = self.solve(apart, speed).await;
        }
        self.accept(found?, speed)
    }

    /// The slowest modes at `speed` (m/s), those with the smallest |λ|, about `count` of them, in rising order of frequency:
    /// by the same iteration for their estimates alone, in steps. Each is an eigenvalue to all its digits; that none of the
    /// slowest is missing only [`Self::spectrum`] knows.
    pub async fn slowest_in_steps(&self, speed: f64, count: usize) -> Vec<ModeValue> {
        let mut estimates = self.at_rest().await;
        let mut slowest: Vec<usize> = (0..estimates.values.len()).collect();
        slowest.sort_by(|&a, &b| estimates.values[a].norm_sqr().total_cmp(&estimates.values[b].norm_sqr()));
        // A few more, since they change places; of pairs that are not kept together both.
        let each = if estimates.paired { 1 } else { 2 };
        slowest.truncate(each * (count + BESIDE));
        let mut found: Vec<C64> = Vec::new();
        for _ in 0..SLOWEST_SWEEPS {
            let mut moving = Vec::new();
            for &j in &slowest {
                let z = estimates.values[j];
                if let Some([_, mut step]) = self.step(&estimates, j, z, speed) {
                    let (size, largest) = (step.norm(), LARGEST_STEP * z.norm());
                    if size > largest {
                        step *= largest / size;
                    }
                    estimates.values[j] = z - step;
                    if size <= CONVERGED * z.norm() {
                        found.push(estimates.values[j]);
                    } else {
                        moving.push(j);
                    }
                }
                step_ended().await;
            }
            slowest = moving;
        }
        found.sort_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
        for value in &mut found {
            if value.im.abs() <= REAL * value.norm() {
                value.im = 0.0;
            }
        }
        found.dedup_by(|a, b| (*a - *b).norm() <= REAL * a.norm());
        found.retain(|value| value.im >= 0.0);
        found.truncate(count);
        found.sort_by(|a, b| a.im.total_cmp(&b.im).then(a.re.total_cmp(&b.re)));
        found.into_iter().map(|eigenvalue| ModeValue { eigenvalue, multiplicity: self.multiplicity }).collect()
    }

    /// The spectrum of all eigenvalues and what is known of their rounding; the next one begins with it.
    fn accept(&mut self, (found, relative): (Estimates, f64), speed: f64) -> Option<Spectrum> {
        let (values, rounding) = (found.all(), Rounding { relative, absolute: 0.0 });
        self.last = Some(found);
        Spectrum::new(speed, Solver::Structured, rounding, values, self.multiplicity).ok()
    }

    /// About the eigenvalues at rest, in pairs where no mode is overdamped.
    async fn at_rest(&self) -> Estimates {
        let mut values = Vec::with_capacity(2 * self.squares.len());
        let mut paired = true;
        for square in &self.squares {
            let half = 0.5 * (self.alpha + self.beta * square);
            let discriminant = half * half - square;
            if discriminant < 0.0 {
                values.push(C64::new(-half, (-discriminant).sqrt()));
            } else {
                // Both without cancellation: their product is ω̂².
                let larger = half + discriminant.sqrt();
                values.extend([C64::new(-larger, 0.0), C64::new(-square / larger, 0.0)]);
                paired = false;
            }
        }
        let estimates = Estimates { values, paired: true };
        if paired { estimates } else { estimates.unpaired().await }
    }

    /// Iterates from `estimates` to the eigenvalues at `speed`, and to which part of itself each is then known.
    async fn solve(&self, mut estimates: Estimates, speed: f64) -> Option<(Estimates, f64)> {
        let count = estimates.values.len();
        let mut converged = vec![false; count];
        // Newton's steps without the other estimates: how far the next eigenvalue may be.
        let (mut newton, mut steps) = (vec![0.0; count], vec![f64::INFINITY; count]);
        let mut largest_step = 0.0;
        let (mut whole, mut last_step) = (true, f64::INFINITY);
        for _ in 0..SWEEPS {
            largest_step = 0.0_f64;
            for (j, done) in converged.iter_mut().enumerate().filter(|(_, done)| !**done) {
                let z = estimates.values[j];
                let [alone, mut step] = self.step(&estimates, j, z, speed).unwrap_or_else(|| {
                    // The elimination has met a singular pivot, perhaps right at an eigenvalue: from a little further on
                    // it goes to where it should from here.
                    let offset = z * ASIDE;
                    let [newton, step] = self.step(&estimates, j, z + offset, speed).unwrap_or([offset * 2.0; 2]);
                    [newton - offset, step - offset]
                });
                newton[j] = alone.norm();
                let size = z.norm();
                let before = std::mem::replace(&mut steps[j], step.norm());
                let rounding = step.norm() <= ROUNDING_OF_STEPS * self.scale && step.norm() > 0.5 * before;
                *done = rounding || step.norm() <= CONVERGED * size;
                largest_step = largest_step.max(step.norm() / size);
                let largest = LARGEST_STEP * size;
                if step.norm() > largest {
                    step *= largest / step.norm();
                }
                estimates.values[j] = z - step;
                step_ended().await;
            }
            let all = converged.iter().all(|&done| done);
            if all && whole {
                // Near each other estimates come to rest slowly: they go on for as long as it gains something.
                if largest_step > 0.1 * last_step {
                    break;
                }
                last_step = largest_step;
            }
            // Those that came to rest first have seen the others move since: all are looked at once more.
            if all {
                converged.fill(false);
            }
            whole = all;
        }
        // Where two estimates have come to one eigenvalue, they are nearer to each other than to it.
        if largest_step > STAGNATED {
            return None;
        }
        for (j, z) in estimates.values.iter().enumerate() {
            if newton[j] > (CONVERGED * z.norm()).max(0.5 * estimates.gap(j)) {
                return None;
            }
            step_ended().await;
        }
        let estimates = estimates.symmetric(largest_step.max(CONVERGED)).await?;
        let error = if largest_step > CONVERGED { largest_step } else { ITERATED };
        self.are_all(&estimates, speed).await.then_some((estimates, error))
    }

    /// The step of the j-th estimate from `z`: without regard to the others, and with it. `None` where it is not finite.
    fn step(&self, estimates: &Estimates, j: usize, z: C64, speed: f64) -> Option<[C64; 2]> {
        let slope = self.function.at(z, speed).by_lambda;
        let steps = [slope, slope - estimates.others(j, z)].map(inverse);
        steps.iter().all(|step| step.re.is_finite() && step.im.is_finite()).then_some(steps)
    }

    /// Whether the estimates are all eigenvalues: by their sum, which the largest ones make, and at a few places by the
    /// sum of 1/(λ − λⱼ).
    async fn are_all(&self, estimates: &Estimates, speed: f64) -> bool {
        let all = estimates.all();
        if all.len() != 2 * self.squares.len() {
            return false;
        }
        let (sum, size) = all.iter().fold((C64::new(0.0, 0.0), 0.0), |(s, n), l| (s + l, n + l.norm()));
        let known = -(self.damping[0] + self.damping[1] * speed);
        let mut agree = (sum - known).norm() <= AGREEMENT * size;
        let lowest = self.squares.iter().copied().fold(f64::INFINITY, f64::min).sqrt();
        let mut place = lowest;
        while place < self.scale {
            for lambda in [C64::new(place, 0.0), C64::new(0.5 * lowest, place)] {
                let terms = all.iter().map(|l| (lambda - l).inv());
                let (sum, size) = terms.fold((C64::new(0.0, 0.0), 0.0), |(s, n), term| (s + term, n + term.norm()));
                agree &= (sum - self.function.at(lambda, speed).by_lambda).norm() <= AGREEMENT * size;
            }
            place *= 2.0;
            step_ended().await;
        }
        agree
    }
}

impl Estimates {
    /// Σ 1/(z − zₖ) over all others than the j-th, its partner among them.
    fn others(&self, j: usize, z: C64) -> C64 {
        let mut sum = C64::new(0.0, 0.0);
        let mut add = |other: C64| sum += inverse(z - other);
        for (k, &other) in self.values.iter().enumerate() {
            if k != j {
                add(other);
            }
            if self.paired {
                add(other.conj());
            }
        }
        sum
    }

    /// The distance of an estimate from the nearest other one, its partner among them; from zero where two are the same.
    fn gap(&self, j: usize) -> f64 {
        let z = self.values[j];
        let others = self.values.iter().enumerate().filter(|&(k, _)| k != j).map(|(_, &other)| other);
        let partners = self.values.iter().filter(|_| self.paired).map(nalgebra::Complex::conj);
        let nearest = others.chain(partners).map(|other| (other - z).norm_sqr()).fold(f64::INFINITY, f64::min).sqrt();
        if nearest > 0.0 { nearest } else { z.norm() }
    }

    /// The same as exact pairs and real numbers; `None` where they are not that to about a part of `step`.
    async fn symmetric(mut self, step: f64) -> Option<Self> {
        if self.paired {
            return Some(self);
        }
        let mut open: Vec<usize> = (0..self.values.len()).collect();
        while let Some(j) = open.pop() {
            let value = self.values[j];
            let gap = |k: usize| (self.values[k].conj() - value).norm();
            let partner = (0..open.len()).min_by(|&a, &b| gap(open[a]).total_cmp(&gap(open[b])));
            let tolerance = 2.0 * step * value.norm();
            match partner {
                Some(k) if gap(open[k]) < gap(j) => {
                    let k = open.swap_remove(k);
                    if gap(k) > tolerance {
                        return None;
                    }
                    self.values[k] = value.conj();
                }
                _ if gap(j) <= tolerance => self.values[j].im = 0.0,
                _ => return None,
            }
            step_ended().await;
        }
        Some(self)
    }

    /// All eigenvalues.
    fn all(&self) -> Vec<C64> {
        if !self.paired {
            return self.values.clone();
        }
        self.values.iter().flat_map(|&value| [value, value.conj()]).collect()
    }

    /// The same, each by itself and a little off its place.
    async fn unpaired(&self) -> Self {
        let mut values = Vec::with_capacity(2 * self.values.len());
        for &value in &self.values {
            values.push(value);
            if value.im != 0.0 {
                values.push(value.conj());
            }
        }
        let values = Self { values, paired: false };
        let mut gaps = Vec::with_capacity(values.values.len());
        for j in 0..values.values.len() {
            gaps.push(values.gap(j));
            step_ended().await;
        }
        let mut values = values.values;
        for ((j, value), gap) in values.iter_mut().enumerate().zip(gaps) {
            // A Weyl sequence: neither symmetric nor periodic.
            let part = (j as f64 * 0.618_033_988_749_895).fract() - 0.5;
            *value += C64::new(part, 0.5 + part) * (SPREAD * gap);
        }
        Self { values, paired: false }
    }
}

/// 1/z without the care for overflow that the estimates do not need.
fn inverse(z: C64) -> C64 {
    z.conj() / z.norm_sqr()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::paper_spec;
    use crate::stability::problems;

    fn vibration() -> Vibration {
        problems::of_robot(paper_spec(), [2.0, 0.0], [1.0, 0.0])
    }

    fn spectra() -> Spectra {
        Spectra::new(&vibration()).unwrap()
    }

    fn estimates(values: &[[f64; 2]], paired: bool) -> Estimates {
        Estimates { values: values.iter().map(|&[re, im]| C64::new(re, im)).collect(), paired }
    }

    /// One that is there twice or a little off is seen, a slow one as well as a fast one; so is one that is missing.
    #[test]
    fn wrong_sets_of_eigenvalues_are_refused() {
        let mut spectra = spectra();
        let spectrum = spectra.iterate(5.0).unwrap();
        let relative = spectrum.rounding(C64::new(3.0, 4.0)) / 5.0;
        assert!((relative / ITERATED - 1.0).abs() < 1e-12, "{relative}");
        let found = spectra.last.take().unwrap();
        assert!(found.paired && finish(spectra.are_all(&found, 5.0)));
        assert!(!finish(spectra.are_all(&found, 5.01)), "at another speed");
        for j in 0..found.values.len() {
            let mut wrong = found.clone();
            wrong.values[j] *= 1.0 + 1e-4;
            assert!(!finish(spectra.are_all(&wrong, 5.0)), "{} is off", found.values[j]);
            let mut wrong = found.clone();
            wrong.values[j] = found.values[(j + 1) % found.values.len()];
            assert!(!finish(spectra.are_all(&wrong, 5.0)), "{} is missing", found.values[j]);
        }
        let mut wrong = found.clone();
        wrong.values.pop();
        assert!(!finish(spectra.are_all(&wrong, 5.0)), "one is missing");
    }

    /// After too many failures the dense solver answers, and the iteration goes on from there.
    #[test]
    fn the_dense_solver_steps_in() {
        let expected = spectra().iterate(5.0).unwrap();
        let mut spectra = Spectra { failures: PATIENCE, ..spectra() };
        let found = spectra.spectrum(&vibration(), 5.0).unwrap();
        assert!(spectra.dense.is_some());
        assert!((found.rightmost() - expected.rightmost()).norm() < 1e-12, "{found:?}");
    }

    /// At rest the estimates are λ² + (α + β ω̂²) λ + ω̂² = 0, overdamped or not.
    #[test]
    fn estimates_at_rest_are_the_roots_for_the_estimated_frequencies() {
        for beta in [0.002, 0.5] {
            let spectra = Spectra { beta, ..spectra() };
            let Estimates { values, paired } = finish(spectra.at_rest());
            assert_eq!(paired, beta < 0.1);
            let (sum, product) = (spectra.alpha, spectra.beta);
            let all = Estimates { values, paired }.all();
            assert_eq!(all.len(), 2 * spectra.squares.len());
            if paired {
                for (pair, square) in all.chunks(2).zip(&spectra.squares) {
                    let error = (pair[0] * pair[1]).re / square - 1.0;
                    let damping = (pair[0] + pair[1]).re + sum + product * square;
                    assert!(error.abs() < 1e-12 && damping.abs() < 1e-12 * (sum + product * square), "{pair:?}");
                }
            }
        }
        let heavy = Spectra { alpha: 0.0, beta: 2.0, squares: vec![100.0], ..spectra() };
        let heavy = finish(heavy.at_rest());
        // Each is moved a little off its place, by a part of the distance between them.
        let [a, b] = heavy.values[..] else { panic!("{heavy:?}") };
        let gap = 198.997_487_4;
        assert!((a + 199.498_743_7).norm() < 1.2 * SPREAD * gap, "{heavy:?}");
        assert!((b + 0.501_256_3).norm() < 1.2 * SPREAD * gap, "{heavy:?}");
    }

    #[test]
    fn others_are_summed_and_the_nearest_is_found() {
        let paired = estimates(&[[-1.0, 2.0], [-1.0, 5.0]], true);
        let z = C64::new(0.0, 1.0);
        let sum = |others: &[[f64; 2]]| others.iter().map(|&[re, im]| (z - C64::new(re, im)).inv()).sum::<C64>();
        let others = sum(&[[-1.0, -2.0], [-1.0, 5.0], [-1.0, -5.0]]);
        assert!((paired.others(0, z) - others).norm() < 1e-14);
        assert!((paired.gap(0) - 3.0).abs() < 1e-14 && (paired.gap(1) - 3.0).abs() < 1e-14);
        let apart = estimates(&[[-1.0, 2.0], [-1.0, -2.0], [3.0, 4.0]], false);
        assert!((apart.others(1, z) - sum(&[[-1.0, 2.0], [3.0, 4.0]])).norm() < 1e-14);
        assert!((apart.gap(0) - 4.0).abs() < 1e-14);
        let same = estimates(&[[3.0, 4.0], [3.0, 4.0]], false);
        assert!((same.gap(0) - 5.0).abs() < 1e-14, "from zero where two are the same");
    }

    #[test]
    fn nearly_pairs_become_pairs_and_nearly_real_numbers_real() {
        let nearly = |off: f64| estimates(&[[-1.0, 2.0 + off], [-30.0, off], [-1.0 + off, -2.0], [-8.0, 0.0]], false);
        let found = finish(nearly(1e-7).symmetric(1e-7)).unwrap().values;
        assert_eq!(found[0], found[2].conj());
        assert!(found[1].im == 0.0 && found[3].im == 0.0, "{found:?}");
        assert!((found[0] - C64::new(-1.0, 2.0)).norm() < 2e-7 && (found[1].re + 30.0).abs() < 2e-7);
        assert!(finish(nearly(1e-3).symmetric(1e-7)).is_none());
        // A real number is within twice the step of itself, however large the rest is.
        assert!(finish(estimates(&[[-30.0, 7e-6]], false).symmetric(1e-7)).is_none());
    }

    /// Off their places by a part of the distance to the nearest other one, each in another direction.
    #[test]
    fn estimates_apart_are_near_their_places() {
        let apart = finish(estimates(&[[-1.0, 2.0], [-30.0, 0.0], [-3.0, 9.0]], true).unpaired()).values;
        let places =
            [[-1.0, 2.0], [-1.0, -2.0], [-30.0, 0.0], [-3.0, 9.0], [-3.0, -9.0]].map(|[re, im]| C64::new(re, im));
        assert_eq!(apart.len(), places.len());
        let moved: Vec<C64> = apart.iter().zip(places).map(|(z, place)| z - place).collect();
        for (j, off) in moved.iter().enumerate() {
            let others = (0..5).filter(|&k| k != j).map(|k| (places[k] - places[j]).norm());
            let gap = others.fold(f64::INFINITY, f64::min);
            assert!((1e-4 * gap..1.2 * SPREAD * gap).contains(&off.norm()), "{off} of {gap}");
        }
    }

    /// They are the slowest of all, to the digits of both, for light and heavy damping.
    #[test]
    fn the_slowest_modes_are_those_of_the_whole_spectrum() {
        for beta in [0.002, 0.5] {
            let mut spectra = Spectra { beta, ..spectra() };
            let mut vibration = vibration();
            vibration.damping.beta = beta;
            spectra = Spectra { damping: Spectra::new(&vibration).unwrap().damping, ..spectra };
            spectra.function = Characteristic::new(&vibration);
            let mut all: Vec<C64> = spectra.spectrum(&vibration, 5.0).unwrap().modes().map(|m| m.eigenvalue).collect();
            all.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
            let slowest = finish(spectra.slowest_in_steps(5.0, 12));
            assert_eq!(slowest.len(), 12, "{slowest:?}");
            assert!(slowest.windows(2).all(|pair| pair[0].eigenvalue.im <= pair[1].eigenvalue.im), "{slowest:?}");
            for value in slowest {
                let off = |other: &C64| (other - value.eigenvalue).norm();
                let nearest = all[..12].iter().map(off).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-8 * value.eigenvalue.norm(), "β = {beta}: {value:?} is off by {nearest}");
            }
        }
    }

    /// The same work in the same order, however it is cut: equal to the last bit.
    #[test]
    fn a_spectrum_in_steps_is_the_spectrum() {
        let vibration = vibration();
        let expected = spectra().spectrum(&vibration, 5.0).unwrap();
        let mut spectra = spectra();
        let mut steps = crate::stability::Steps::new(async move { spectra.spectrum_in_steps(&vibration, 5.0).await });
        let mut count = 0;
        let found = loop {
            match steps.advance() {
                None => count += 1,
                Some(found) => break found.unwrap(),
            }
        };
        assert_eq!(found, expected);
        assert!(count >= 74 * 3, "{count} steps");
    }
}
