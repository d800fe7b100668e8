//! Numbers and 2 × 2 blocks that carry their derivatives in λ and in v, for the elimination along the cables.

use std::ops::{Add, Mul, Neg, Sub};

use nalgebra::Complex;

type C64 = Complex<f64>;

/// A value with its derivatives in λ and in v.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Jet {
    pub(super) value: C64,
    pub(super) by_lambda: C64,
    pub(super) by_speed: C64,
}

impl Add for Jet {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self {
            value: self.value + b.value,
            by_lambda: self.by_lambda + b.by_lambda,
            by_speed: self.by_speed + b.by_speed,
        }
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self {
            value: self.value - b.value,
            by_lambda: self.by_lambda - b.by_lambda,
            by_speed: self.by_speed - b.by_speed,
        }
    }
}

impl Neg for Jet {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, by_lambda: -self.by_lambda, by_speed: -self.by_speed }
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self {
            value: self.value * b.value,
            by_lambda: self.value * b.by_lambda + self.by_lambda * b.value,
            by_speed: self.value * b.by_speed + self.by_speed * b.value,
        }
    }
}

impl Mul<f64> for Jet {
    type Output = Self;
    fn mul(self, b: f64) -> Self {
        Self { value: self.value * b, by_lambda: self.by_lambda * b, by_speed: self.by_speed * b }
    }
}

/// [[t + x, y + w], [y − w, t − x]]. A turn of the axes leaves t and w as they are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Planar {
    pub(super) t: Jet,
    pub(super) w: Jet,
    pub(super) x: Jet,
    pub(super) y: Jet,
}

impl Sub for Planar {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self { t: self.t - b.t, w: self.w - b.w, x: self.x - b.x, y: self.y - b.y }
    }
}

impl Planar {
    #[inline]
    pub(super) fn determinant(&self) -> Jet {
        (self.t + self.x) * (self.t - self.x) - (self.y + self.w) * (self.y - self.w)
    }

    /// The same in axes turned by θ, given cos 2θ and sin 2θ.
    pub(super) fn turned(self, cosine: f64, sine: f64) -> Self {
        Self { x: self.x * cosine + self.y * sine, y: self.y * cosine - self.x * sine, ..self }
    }

    /// diag(`left`) adj(self) diag(`right`).
    pub(super) fn adjugate_between(&self, left: [Jet; 2], right: [Jet; 2]) -> Self {
        let xx = left[0] * right[0] * (self.t - self.x);
        let yy = left[1] * right[1] * (self.t + self.x);
        let xy = -(left[0] * right[1] * (self.y + self.w));
        let yx = -(left[1] * right[0] * (self.y - self.w));
        Self { t: (xx + yy) * 0.5, x: (xx - yy) * 0.5, y: (xy + yx) * 0.5, w: (xy - yx) * 0.5 }
    }
}
