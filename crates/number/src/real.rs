//! The number trait.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};

/// Outcome of a comparison, one truth value per lane.
pub trait Mask:
    Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// Number of truth values.
    const LANES: usize;
    /// True where any lane is true.
    fn any(self) -> bool;
    /// The truth value of one lane.
    fn lane(self, index: usize) -> bool;
    /// A mask from one truth value per lane.
    fn from_lanes(lane: impl FnMut(usize) -> bool) -> Self;
}

/// Work that a number runs on its vector unit.
pub trait Vectorized {
    /// What the work returns.
    type Output;
    /// Does the work; `#[inline(always)]`.
    fn run(self) -> Self::Output;
}

/// A real number in one of its shapes: one machine, several side by side, or one with derivatives ([`Dual`](crate::Dual)).
///
/// Code over `Real` must not branch on values: it compares to a [`Mask`] and [selects](Real::select).
/// Both sides of a selection are computed, so arguments of `sqrt` and `ln` are clamped *before* the call.
pub trait Real:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// Outcome of a comparison.
    type Mask: Mask;
    /// Number of machines side by side.
    const LANES: usize;
    /// Several equal parts of a machine (the balls of a bearing) side by side: so a single machine uses the vector
    /// unit too; several machines fill it with one part each. Part `i` of machine `m` is lane `i · LANES + m`.
    type Group: Real;
    /// Number of parts in a group.
    const GROUP: usize;

    /// The same constant in every lane; its derivative is zero.
    fn splat(value: f64) -> Self;
    /// One value per lane; derivatives are zero.
    fn from_lanes(lane: impl FnMut(usize) -> f64) -> Self;
    /// The value of one lane, without its derivative.
    fn lane(self, index: usize) -> f64;

    /// The same value for every part of a group.
    #[must_use]
    fn grouped(self) -> Self::Group;
    /// The parts `from..from + GROUP` of a list; the last part repeated where the list ends.
    fn load_group(parts: &[Self], from: usize) -> Self::Group;
    /// Writes a group over the parts `from..from + GROUP` of a list, as far as the list goes.
    fn store_group(group: Self::Group, parts: &mut [Self], from: usize);
    /// Adds the first `count` parts of a group to four running sums, one after the other: part `i` to sum
    /// `(from + i) mod 4`. The order does not depend on the width of a group, so the sums do not either.
    fn add_group(group: Self::Group, sums: &mut [Self; 4], from: usize, count: usize);

    /// √x, for x ≥ 0. Its derivative at 0 is taken as zero: what is clamped to 0 does not move.
    fn sqrt(self) -> Self;
    /// |x|.
    fn abs(self) -> Self;
    /// The nearest integer, ties to even, for |x| < 2^51; its derivative is zero.
    fn round(self) -> Self;
    /// eˣ, the argument clamped to ±700.
    fn exp(self) -> Self;
    /// Natural logarithm, for normal x > 0.
    fn ln(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Hyperbolic tangents of two numbers for one division.
    fn tanh_pair(self, other: Self) -> (Self, Self);
    /// Sine and cosine of an angle in rad.
    fn sin_cos(self) -> (Self, Self);
    /// x^⅔, for normal x > 0: less than half of the work of a power.
    fn two_thirds(self) -> Self;
    /// Arc sine for |x| ≤ 0.125; meaningless beyond.
    fn asin_small(self) -> Self;

    /// Runs a task compiled for this number's vector unit, once in the program wherever it is called from. What the
    /// task calls must be `#[inline(always)]` down to the last law: only inlined code is compiled for the unit.
    #[inline(never)]
    fn vectorized<T: Vectorized>(task: T) -> T::Output {
        task.run()
    }

    /// self > other.
    fn greater(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// Zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// One.
    #[inline(always)]
    fn one() -> Self {
        Self::splat(1.0)
    }
    /// self < other.
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        other.greater(self)
    }
    /// The larger of two; `other` when they do not compare.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(self.greater(other), self, other)
    }
    /// The smaller of two; `other` when they do not compare.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(other.greater(self), self, other)
    }
    /// tanh x with the same bits, where it is ±1 as a rule: nothing is computed where all lanes are beyond ±20.
    #[inline(always)]
    fn tanh_far_out(self) -> Self {
        let near = !self.abs().greater(Self::splat(20.0));
        if near.any() {
            return self.tanh();
        }
        self.sign_or_plus()
    }
    /// self², cheaper to read than a product of long names.
    #[inline(always)]
    fn square(self) -> Self {
        self * self
    }
    /// 1/x.
    #[inline(always)]
    fn recip(self) -> Self {
        Self::one() / self
    }
    /// x^y for x > 0: e^(y ln x).
    #[inline(always)]
    fn powf(self, exponent: Self) -> Self {
        (self.ln() * exponent).exp()
    }
    /// The sign with `sign(0) = +1`.
    #[inline(always)]
    fn sign_or_plus(self) -> Self {
        Self::select(Self::zero().greater(self), -Self::one(), Self::one())
    }
}
