//! Powers of a base that may be zero.

use number::Real;

/// base^exponent for base ≥ 0 and exponent > 0, exactly 0 for a base of 0 (or below), with derivative 0 there.
#[inline(always)]
pub(crate) fn power_from_zero<R: Real>(base: R, exponent: R) -> R {
    let tiny = R::splat(1e-100);
    let power = base.max(tiny).powf(exponent);
    R::select(base.greater(tiny), power, R::zero())
}
