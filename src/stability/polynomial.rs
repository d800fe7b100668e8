//! Polynomials in λ with real coefficients, and their values on the imaginary axis with both derivatives.
//!
//! There even powers of λ are real and odd ones imaginary.

use super::jet::{Jet, Number, Pair};

/// A quadratic in λ and its derivative in v; coefficients from the constant on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quadratic {
    pub(super) value: [Pair; 3],
    pub(super) by_speed: [Pair; 2],
}

/// A quartic in λ and its derivative in v.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quartic {
    value: [Pair; 5],
    by_speed: [Pair; 4],
}

impl Quadratic {
    /// The value at λ = iω, given ω and ω².
    #[inline]
    pub(super) fn at(&self, omega: f64, square: f64) -> Jet<Pair> {
        let ([a, b, c], [d, e]) = (self.value, self.by_speed);
        Jet {
            value: Number { re: a - c * square, im: b * omega },
            by_lambda: Number { re: b, im: c * (2.0 * omega) },
            by_speed: Number { re: d, im: e * omega },
        }
    }

    /// The product of two.
    pub(super) fn times(&self, other: &Self) -> Quartic {
        let mut product = Quartic { value: [Pair::default(); 5], by_speed: [Pair::default(); 4] };
        let mut add = |to: usize, term: Pair| product.by_speed[to] = product.by_speed[to] + term;
        for (i, slope) in self.by_speed.into_iter().enumerate() {
            other.value.into_iter().enumerate().for_each(|(j, value)| add(i + j, slope * value));
        }
        for (i, slope) in other.by_speed.into_iter().enumerate() {
            self.value.into_iter().enumerate().for_each(|(j, value)| add(i + j, slope * value));
        }
        for (i, a) in self.value.into_iter().enumerate() {
            for (j, b) in other.value.into_iter().enumerate() {
                product.value[i + j] = product.value[i + j] + a * b;
            }
        }
        product
    }
}

impl Quartic {
    /// The value at λ = iω, given ω and ω².
    #[inline]
    pub(super) fn at(&self, omega: f64, square: f64) -> Jet<Pair> {
        let ([a, b, c, d, e], [f, g, h, k]) = (self.value, self.by_speed);
        let e_square = e * square;
        let d_square = d * square;
        Jet {
            value: Number { re: a - (c - e_square) * square, im: (b - d_square) * omega },
            by_lambda: Number { re: b - d_square * 3.0, im: (c - e_square * 2.0) * (2.0 * omega) },
            by_speed: Number { re: f - h * square, im: (g - k * square) * omega },
        }
    }
}
