//! The eigenvalues at one speed, in an order, with the questions one asks of them.

use std::f64::consts::TAU;

use nalgebra::Complex;

use crate::stability::NotConverged;

/// Real parts below this part of the largest |λ| are zero to rounding.
const ROUNDING_OF_REAL_PARTS: f64 = 1e-13;

/// How far a solver's rounding may have moved an eigenvalue: by the `relative` part of it, and by `absolute` (1/s) times its
/// condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rounding {
    pub relative: f64,
    pub absolute: f64,
}

/// What gave the eigenvalues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// The iteration by structure.
    Structured,
    /// The dense solver, for it was asked for or the iteration had left doubt.
    Dense,
}

/// All eigenvalues of the problem at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    speed: f64,
    solver: Solver,
    rounding: Rounding,
    distinct: Vec<Complex<f64>>,
    multiplicity: usize,
}

/// One vibration mode's eigenvalue: of a complex pair the one with positive imaginary part, or a real one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeValue {
    /// λ in 1/s.
    pub eigenvalue: Complex<f64>,
    /// How many modes share it by the problem's structure: 2 where x and y decouple, else 1.
    pub multiplicity: usize,
}

impl ModeValue {
    /// |Im λ|/2π in Hz.
    pub fn frequency_hz(&self) -> f64 {
        self.eigenvalue.im.abs() / TAU
    }

    /// ζ = −Re λ/|λ|, in −1..=1: negative where the mode grows, 1 where it is overdamped; 0 for λ = 0.
    pub fn damping_ratio(&self) -> f64 {
        let size = self.eigenvalue.norm();
        if size == 0.0 { 0.0 } else { -self.eigenvalue.re / size }
    }
}

impl Spectrum {
    /// Orders `eigenvalues` by frequency, then by real part; each stands for `multiplicity` equal ones.
    pub(super) fn new(
        speed: f64,
        solver: Solver,
        rounding: Rounding,
        mut eigenvalues: Vec<Complex<f64>>,
        multiplicity: usize,
    ) -> Result<Self, NotConverged> {
        if eigenvalues.is_empty() || !eigenvalues.iter().all(|l| l.re.is_finite() && l.im.is_finite()) {
            return Err(NotConverged);
        }
        eigenvalues.sort_by(|a, b| {
            (a.im.abs().total_cmp(&b.im.abs())).then(a.re.total_cmp(&b.re)).then(a.im.total_cmp(&b.im))
        });
        Ok(Self { speed, solver, rounding, distinct: eigenvalues, multiplicity })
    }

    /// The same spectrum, whose eigenvalues are known to `absolute` (1/s) at best.
    pub(super) fn known_to(mut self, absolute: f64) -> Self {
        self.rounding.absolute = self.rounding.absolute.max(absolute);
        self
    }

    /// The speed in m/s.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// What gave the eigenvalues: [`Solver::Dense`] of [`super::Spectra`] tells that its iteration was in doubt.
    pub fn solver(&self) -> Solver {
        self.solver
    }

    /// Every eigenvalue, multiplicity included, in rising order of |Im λ|.
    pub fn eigenvalues(&self) -> impl Iterator<Item = Complex<f64>> {
        self.distinct.iter().flat_map(|&l| std::iter::repeat_n(l, self.multiplicity))
    }

    /// The modes in rising order of frequency: complex pairs once, real eigenvalues each.
    pub fn modes(&self) -> impl Iterator<Item = ModeValue> {
        let upper = self.distinct.iter().filter(|l| l.im >= 0.0);
        upper.map(|&eigenvalue| ModeValue { eigenvalue, multiplicity: self.multiplicity })
    }

    /// The eigenvalue with the largest real part, the one with Im λ ≥ 0 of its pair.
    pub fn rightmost(&self) -> Complex<f64> {
        let rightmost = self.distinct.iter().max_by(|a, b| a.re.total_cmp(&b.re));
        rightmost.map_or(Complex::new(0.0, 0.0), |l| Complex::new(l.re, l.im.abs()))
    }

    /// The largest growth rate max Re λ, in 1/s.
    pub fn growth_rate(&self) -> f64 {
        self.rightmost().re
    }

    /// How far rounding may have moved `eigenvalue`, in 1/s: by a part of itself where the iteration by structure has found
    /// it; by a number that belongs to the largest one, times the eigenvalue's condition, by the dense solver.
    pub fn rounding(&self, eigenvalue: Complex<f64>) -> f64 {
        self.rounding.relative * eigenvalue.norm() + self.rounding.absolute
    }

    /// Whether every Re λ < 0, by more than the rounding of a robot without damping.
    pub fn is_stable(&self) -> bool {
        self.growth_rate() < -ROUNDING_OF_REAL_PARTS * self.largest()
    }

    /// The largest |λ|, in 1/s.
    fn largest(&self) -> f64 {
        self.distinct.iter().map(|l| l.norm()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spectrum(growth: f64) -> Spectrum {
        let values =
            [[growth, 2.0], [growth, -2.0], [-3.0, 400.0], [-3.0, -400.0]].map(|[re, im]| Complex::new(re, im));
        let rounding = Rounding { relative: 1e-12, absolute: 1e-5 };
        Spectrum::new(1.5, Solver::Dense, rounding, values.into(), 1).unwrap()
    }

    #[test]
    fn a_modes_damping_ratio_and_frequency_are_those_of_an_oscillator() {
        for (re, im, ratio) in [(-3.0, 4.0, 0.6), (3.0, -4.0, -0.6), (-2.0, 0.0, 1.0), (0.0, 0.0, 0.0)] {
            let mode = ModeValue { eigenvalue: Complex::new(re, im), multiplicity: 1 };
            assert!((mode.damping_ratio() - ratio).abs() < 1e-15, "{mode:?}");
            assert!((mode.frequency_hz() * TAU - im.abs()).abs() < 1e-15, "{mode:?}");
        }
    }

    /// Of a robot without damping real parts are rounding of the largest frequency.
    #[test]
    fn what_is_rounding_is_not_stable() {
        let rounding = 400.0 * ROUNDING_OF_REAL_PARTS;
        for (growth, stable) in [(-1.0, true), (-1.1 * rounding, true), (-0.9 * rounding, false), (rounding, false)] {
            assert_eq!(spectrum(growth).is_stable(), stable, "{growth}");
            assert_eq!((spectrum(growth).growth_rate(), spectrum(growth).speed()), (growth, 1.5));
        }
    }

    #[test]
    fn rounding_is_a_part_of_the_eigenvalue_and_a_number() {
        let spectrum = spectrum(-1.0);
        for (absolute, expected) in [(0.0, 3e-5), (1e-6, 3e-5), (2e-4, 2.2e-4)] {
            let rounding = spectrum.clone().known_to(absolute).rounding(Complex::new(-2e7, 0.0));
            assert!((rounding - expected).abs() < 1e-12, "{rounding}");
        }
    }
}
