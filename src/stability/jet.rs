//! Numbers and 2 × 2 blocks that carry their derivatives in λ and in v, for the elimination along the cables.
//!
//! All of it is generic over what stands for a real number: `f64`, or a [`Pair`] of them, one for each of two cables
//! that go through the same operations. The compiler turns pairs into the processor's own.

use std::ops::{Add, Mul, Neg, Sub};

use nalgebra::Complex;

/// What stands for a real number.
pub(super) trait Real:
    Copy
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Neg<Output = Self>
{
}

impl Real for f64 {}

/// Two real numbers, element by element.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pair(pub(super) [f64; 2]);

impl Real for Pair {}

impl Add for Pair {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        Self([self.0[0] + b.0[0], self.0[1] + b.0[1]])
    }
}

impl Sub for Pair {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        Self([self.0[0] - b.0[0], self.0[1] - b.0[1]])
    }
}

impl Mul for Pair {
    type Output = Self;
    #[inline]
    fn mul(self, b: Self) -> Self {
        Self([self.0[0] * b.0[0], self.0[1] * b.0[1]])
    }
}

impl Mul<f64> for Pair {
    type Output = Self;
    #[inline]
    fn mul(self, b: f64) -> Self {
        Self([self.0[0] * b, self.0[1] * b])
    }
}

impl Neg for Pair {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self([-self.0[0], -self.0[1]])
    }
}

/// A complex number.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Number<R> {
    pub(super) re: R,
    pub(super) im: R,
}

impl<R: Real> Number<R> {
    /// |z|².
    #[inline]
    pub(super) fn norm_sqr(self) -> R {
        self.re * self.re + self.im * self.im
    }
}

impl From<Complex<f64>> for Number<f64> {
    fn from(z: Complex<f64>) -> Self {
        Self { re: z.re, im: z.im }
    }
}

impl Number<Pair> {
    /// One of the two.
    pub(super) fn lane(self, lane: usize) -> Complex<f64> {
        Complex::new(self.re.0[lane], self.im.0[lane])
    }
}

impl<R: Real> Add for Number<R> {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        Self { re: self.re + b.re, im: self.im + b.im }
    }
}

impl<R: Real> Sub for Number<R> {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        Self { re: self.re - b.re, im: self.im - b.im }
    }
}

impl<R: Real> Neg for Number<R> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl<R: Real> Mul for Number<R> {
    type Output = Self;
    #[inline]
    fn mul(self, b: Self) -> Self {
        Self { re: self.re * b.re - self.im * b.im, im: self.re * b.im + self.im * b.re }
    }
}

impl<R: Real> Mul<R> for Number<R> {
    type Output = Self;
    #[inline]
    fn mul(self, b: R) -> Self {
        Self { re: self.re * b, im: self.im * b }
    }
}

/// A value with its derivatives in λ and in v.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Jet<R> {
    pub(super) value: Number<R>,
    pub(super) by_lambda: Number<R>,
    pub(super) by_speed: Number<R>,
}

impl Jet<Pair> {
    /// One of the two.
    pub(super) fn lane(self, lane: usize) -> Jet<f64> {
        let of = |number: Number<Pair>| number.lane(lane).into();
        Jet { value: of(self.value), by_lambda: of(self.by_lambda), by_speed: of(self.by_speed) }
    }
}

impl<R: Real> Add for Jet<R> {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        Self {
            value: self.value + b.value,
            by_lambda: self.by_lambda + b.by_lambda,
            by_speed: self.by_speed + b.by_speed,
        }
    }
}

impl<R: Real> Sub for Jet<R> {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        Self {
            value: self.value - b.value,
            by_lambda: self.by_lambda - b.by_lambda,
            by_speed: self.by_speed - b.by_speed,
        }
    }
}

impl<R: Real> Neg for Jet<R> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, by_lambda: -self.by_lambda, by_speed: -self.by_speed }
    }
}

impl<R: Real> Mul for Jet<R> {
    type Output = Self;
    #[inline]
    fn mul(self, b: Self) -> Self {
        Self {
            value: self.value * b.value,
            by_lambda: self.value * b.by_lambda + self.by_lambda * b.value,
            by_speed: self.value * b.by_speed + self.by_speed * b.value,
        }
    }
}

impl<R: Real> Mul<R> for Jet<R> {
    type Output = Self;
    #[inline]
    fn mul(self, b: R) -> Self {
        Self { value: self.value * b, by_lambda: self.by_lambda * b, by_speed: self.by_speed * b }
    }
}

/// [[t + x, y + w], [y − w, t − x]]. A turn of the axes leaves t and w as they are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Planar<R> {
    pub(super) t: Jet<R>,
    pub(super) w: Jet<R>,
    pub(super) x: Jet<R>,
    pub(super) y: Jet<R>,
}

impl Planar<Pair> {
    /// One of the two.
    pub(super) fn lane(self, lane: usize) -> Planar<f64> {
        Planar { t: self.t.lane(lane), w: self.w.lane(lane), x: self.x.lane(lane), y: self.y.lane(lane) }
    }
}

impl<R: Real> Sub for Planar<R> {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        Self { t: self.t - b.t, w: self.w - b.w, x: self.x - b.x, y: self.y - b.y }
    }
}

impl<R: Real> Planar<R> {
    #[inline]
    pub(super) fn determinant(&self) -> Jet<R> {
        (self.t + self.x) * (self.t - self.x) - (self.y + self.w) * (self.y - self.w)
    }

    /// The same in axes turned by θ, given cos 2θ and sin 2θ.
    #[inline]
    pub(super) fn turned(self, cosine: R, sine: R) -> Self {
        Self { x: self.x * cosine + self.y * sine, y: self.y * cosine - self.x * sine, ..self }
    }

    /// diag(`left`) adj(self) diag(`right`).
    #[inline]
    pub(super) fn adjugate_between(&self, left: [Jet<R>; 2], right: [Jet<R>; 2]) -> Self {
        let half = |jet: Jet<R>| {
            let half = |number: Number<R>| Number { re: number.re * 0.5, im: number.im * 0.5 };
            Jet { value: half(jet.value), by_lambda: half(jet.by_lambda), by_speed: half(jet.by_speed) }
        };
        let xx = left[0] * right[0] * (self.t - self.x);
        let yy = left[1] * right[1] * (self.t + self.x);
        let xy = -(left[0] * right[1] * (self.y + self.w));
        let yx = -(left[1] * right[0] * (self.y - self.w));
        Self { t: half(xx + yy), x: half(xx - yy), y: half(xy + yx), w: half(xy - yx) }
    }
}
