//! Forward derivatives.

use crate::operators::operators;
use crate::scalar::group_of_one;
#[cfg(target_arch = "x86_64")]
use crate::{Level, x86};
use crate::{Real, Vectorized};

/// A number with `K` partial derivatives, over `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const K: usize> {
    /// The value.
    pub value: f64,
    /// Its partial derivatives.
    pub partial: [f64; K],
}

impl<const K: usize> Dual<K> {
    /// The variable of partial `index`.
    #[inline(always)]
    pub fn variable(value: f64, index: usize) -> Self {
        let mut partial = [0.0; K];
        partial[index] = 1.0;
        Dual { value, partial }
    }
    /// Chain rule: a function's value and slope at `self`.
    #[inline(always)]
    fn chain(self, value: f64, slope: f64) -> Self {
        let mut partial = self.partial;
        let mut i = 0;
        while i < K {
            partial[i] *= slope;
            i += 1;
        }
        Dual { value, partial }
    }
    /// A value with partials a·self' + b·other'.
    #[inline(always)]
    fn blend(self, other: Self, value: f64, a: f64, b: f64) -> Self {
        let mut partial = self.partial;
        let mut i = 0;
        while i < K {
            partial[i] = a * self.partial[i] + b * other.partial[i];
            i += 1;
        }
        Dual { value, partial }
    }
}

operators!(
    [const K: usize] Dual<K>, |x, y|
    x.blend(y, x.value + y.value, 1.0, 1.0),
    x.blend(y, x.value - y.value, 1.0, -1.0),
    x.blend(y, x.value * y.value, y.value, x.value),
    {
        let value = x.value / y.value;
        x.blend(y, value, 1.0 / y.value, -value / y.value)
    },
    x.chain(-x.value, -1.0)
);

impl<const K: usize> Real for Dual<K> {
    type Mask = bool;
    const LANES: usize = 1;
    group_of_one!();
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Dual {
            value,
            partial: [0.0; K],
        }
    }
    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> f64) -> Self {
        Self::splat(lane(0))
    }
    #[inline(always)]
    fn lane(self, _index: usize) -> f64 {
        self.value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, if root > 0.0 { 0.5 / root } else { 0.0 })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    #[inline(always)]
    fn round(self) -> Self {
        Self::splat(Real::round(self.value))
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let e = Real::exp(self.value);
        self.chain(e, e)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.chain(Real::ln(self.value), 1.0 / self.value)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        let t = Real::tanh(self.value);
        self.chain(t, 1.0 - t * t)
    }
    #[inline(always)]
    fn tanh_pair(self, other: Self) -> (Self, Self) {
        let (t, u) = Real::tanh_pair(self.value, other.value);
        (self.chain(t, 1.0 - t * t), other.chain(u, 1.0 - u * u))
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = Real::sin_cos(self.value);
        (self.chain(s, c), self.chain(c, -s))
    }
    #[inline(always)]
    fn two_thirds(self) -> Self {
        let power = Real::two_thirds(self.value);
        self.chain(power, 2.0 / 3.0 * power / self.value)
    }
    #[inline(always)]
    fn asin_small(self) -> Self {
        self.chain(
            Real::asin_small(self.value),
            1.0 / (1.0 - self.value * self.value).sqrt(),
        )
    }
    /// The partials fill the vector unit, whatever the machine has; the bits are the same.
    fn vectorized<T: Vectorized>(task: T) -> T::Output {
        #[cfg(target_arch = "x86_64")]
        match Level::detect() {
            // SAFETY: the level was seen on this machine.
            Level::Avx512 => return unsafe { x86::avx512::run(task) },
            // SAFETY: the same.
            Level::Avx2 => return unsafe { x86::avx2::run(task) },
            Level::Baseline => {}
        }
        task.run()
    }
    #[inline(always)]
    fn greater(self, other: Self) -> bool {
        self.value > other.value
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mixed<R: Real>(x: R, y: R) -> R {
        let (s, c) = (x * y).sin_cos();
        let root = (x * x + y * y).sqrt();
        s * root / (c + R::splat(3.0)) + (x - y).tanh().exp() - root.ln() * x.abs()
            + (y.powf(x) + y.two_thirds()) * (s * R::splat(0.1)).asin_small()
    }

    #[test]
    fn derivatives_match_central_differences() {
        let h = 1e-5;
        for (x, y) in [(0.4, 1.3), (-1.7, 0.6), (2.2, 2.9)] {
            let exact = mixed(Dual::<2>::variable(x, 0), Dual::variable(y, 1));
            let dx = (mixed(x + h, y) - mixed(x - h, y)) / (2.0 * h);
            let dy = (mixed(x, y + h) - mixed(x, y - h)) / (2.0 * h);
            // truncation h² and rounding 1e-16/h are both near 1e-10
            assert!((exact.partial[0] - dx).abs() < 1e-8 * (1.0 + dx.abs()));
            assert!((exact.partial[1] - dy).abs() < 1e-8 * (1.0 + dy.abs()));
            assert!((exact.value - mixed(x, y)).abs() < 1e-15 * (1.0 + exact.value.abs()));
        }
    }
    #[test]
    fn a_root_that_is_zero_stays_without_slope() {
        let open = Dual::<1>::variable(-1e-6, 0).max(Dual::splat(0.0));
        assert_eq!(open.sqrt(), Dual::splat(0.0));
    }
    #[test]
    fn rounding_and_constants_have_no_slope() {
        assert_eq!(Dual::<1>::variable(2.3, 0).round().partial, [0.0]);
        assert_eq!(Dual::<1>::splat(2.3).partial, [0.0]);
    }
}
