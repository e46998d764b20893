//! Plain `f64` and `W` of them side by side.

use crate::elementary::{
    self, Bits, exp2_integer_f64, integer_bit_f64, mantissa_exponent_f64, round_f64,
};
use crate::{Mask, Real};
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn lane(self, _index: usize) -> bool {
        self
    }
    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> bool) -> bool {
        lane(0)
    }
}

impl Real for f64 {
    type Mask = bool;
    const LANES: usize = 1;
    type Group = Lanes<4>;
    const GROUP: usize = 4;
    #[inline(always)]
    fn grouped(self) -> Lanes<4> {
        Lanes([self; 4])
    }
    #[inline(always)]
    fn load_group(parts: &[f64], from: usize) -> Lanes<4> {
        if let Some(full) = parts.get(from..from + 4) {
            Lanes([full[0], full[1], full[2], full[3]])
        } else {
            let last = parts.len() - 1;
            Lanes(each_lane_of_four(|i| parts[last.min(from + i)]))
        }
    }
    #[inline(always)]
    fn store_group(group: Lanes<4>, parts: &mut [f64], from: usize) {
        if let Some(full) = parts.get_mut(from..from + 4) {
            full.copy_from_slice(&group.0);
        } else {
            for (part, value) in parts[from..].iter_mut().zip(group.0) {
                *part = value;
            }
        }
    }
    #[inline(always)]
    fn splat(value: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> f64) -> f64 {
        lane(0)
    }
    #[inline(always)]
    fn lane(self, _index: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }
    #[inline(always)]
    fn round(self) -> f64 {
        round_f64(self)
    }
    #[inline(always)]
    fn exp(self) -> f64 {
        elementary::exp(self)
    }
    #[inline(always)]
    fn ln(self) -> f64 {
        elementary::ln(self)
    }
    #[inline(always)]
    fn tanh(self) -> f64 {
        elementary::tanh(self)
    }
    #[inline(always)]
    fn sin_cos(self) -> (f64, f64) {
        elementary::sin_cos(self)
    }
    #[inline(always)]
    fn asin_small(self) -> f64 {
        elementary::asin_small(self)
    }
    #[inline(always)]
    fn greater(self, other: f64) -> bool {
        self > other
    }
    #[inline(always)]
    fn select(mask: bool, yes: f64, no: f64) -> f64 {
        if mask { yes } else { no }
    }
}

impl Bits for f64 {
    #[inline(always)]
    fn exp2_integer(self) -> f64 {
        exp2_integer_f64(self)
    }
    #[inline(always)]
    fn mantissa_exponent(self) -> (f64, f64) {
        mantissa_exponent_f64(self)
    }
    #[inline(always)]
    fn integer_bit(self, n: u32) -> bool {
        integer_bit_f64(self, n) == 1
    }
}

/// `W` numbers side by side, one machine each. Loops over the lanes become vector instructions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Lanes<const W: usize>(pub [f64; W]);

/// One truth value per lane, all bits set or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct LaneMask<const W: usize>([u64; W]);

macro_rules! each_lane {
    ($i:ident: $init:expr => $value:expr) => {{
        let mut out = $init;
        let mut $i = 0;
        while $i < W {
            out[$i] = $value;
            $i += 1;
        }
        out
    }};
}

macro_rules! lane_operator {
    ($Trait:ident, $method:ident, $Assign:ident, $assign:ident, $op:tt) => {
        impl<const W: usize> $Trait for Lanes<W> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Lanes(each_lane!(i: self.0 => self.0[i] $op other.0[i]))
            }
        }
        impl<const W: usize> $Assign for Lanes<W> {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                *self = *self $op other;
            }
        }
    };
}
lane_operator!(Add, add, AddAssign, add_assign, +);
lane_operator!(Sub, sub, SubAssign, sub_assign, -);
lane_operator!(Mul, mul, MulAssign, mul_assign, *);

impl<const W: usize> Div for Lanes<W> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Lanes(each_lane!(i: self.0 => self.0[i] / other.0[i]))
    }
}
impl<const W: usize> Neg for Lanes<W> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lanes(each_lane!(i: self.0 => -self.0[i]))
    }
}
impl<const W: usize> BitAnd for LaneMask<W> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        LaneMask(each_lane!(i: self.0 => self.0[i] & other.0[i]))
    }
}
impl<const W: usize> BitOr for LaneMask<W> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        LaneMask(each_lane!(i: self.0 => self.0[i] | other.0[i]))
    }
}
impl<const W: usize> Not for LaneMask<W> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        LaneMask(each_lane!(i: self.0 => !self.0[i]))
    }
}

impl<const W: usize> Mask for LaneMask<W> {
    #[inline(always)]
    fn any(self) -> bool {
        let mut bits = 0;
        let mut i = 0;
        while i < W {
            bits |= self.0[i];
            i += 1;
        }
        bits != 0
    }
    #[inline(always)]
    fn lane(self, index: usize) -> bool {
        self.0[index] != 0
    }
    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> bool) -> Self {
        LaneMask(each_lane!(i: [0; W] => u64::from(lane(i)).wrapping_neg()))
    }
}

impl<const W: usize> Real for Lanes<W> {
    type Mask = LaneMask<W>;
    const LANES: usize = W;
    type Group = Self;
    const GROUP: usize = 1;
    #[inline(always)]
    fn grouped(self) -> Self {
        self
    }
    #[inline(always)]
    fn load_group(parts: &[Self], from: usize) -> Self {
        parts[from]
    }
    #[inline(always)]
    fn store_group(group: Self, parts: &mut [Self], from: usize) {
        parts[from] = group;
    }
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Lanes([value; W])
    }
    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> f64) -> Self {
        Lanes(each_lane!(i: [0.0; W] => lane(i)))
    }
    #[inline(always)]
    fn lane(self, index: usize) -> f64 {
        self.0[index]
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes(each_lane!(i: self.0 => self.0[i].sqrt()))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Lanes(each_lane!(i: self.0 => self.0[i].abs()))
    }
    #[inline(always)]
    fn round(self) -> Self {
        Lanes(each_lane!(i: self.0 => round_f64(self.0[i])))
    }
    #[inline(always)]
    fn exp(self) -> Self {
        elementary::exp(self)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        elementary::ln(self)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        elementary::tanh(self)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }
    #[inline(always)]
    fn asin_small(self) -> Self {
        elementary::asin_small(self)
    }
    #[inline(always)]
    fn greater(self, other: Self) -> LaneMask<W> {
        LaneMask(each_lane!(i: [0; W] => u64::from(self.0[i] > other.0[i]).wrapping_neg()))
    }
    #[inline(always)]
    fn select(mask: LaneMask<W>, yes: Self, no: Self) -> Self {
        Lanes(each_lane!(i: self_or(&no) =>
            f64::from_bits((yes.0[i].to_bits() & mask.0[i]) | (no.0[i].to_bits() & !mask.0[i]))))
    }
}

#[inline(always)]
fn each_lane_of_four(lane: impl Fn(usize) -> f64) -> [f64; 4] {
    [lane(0), lane(1), lane(2), lane(3)]
}

/// Starting value of a lane loop that overwrites every lane.
#[inline(always)]
fn self_or<const W: usize>(lanes: &Lanes<W>) -> [f64; W] {
    lanes.0
}

impl<const W: usize> Bits for Lanes<W> {
    #[inline(always)]
    fn exp2_integer(self) -> Self {
        Lanes(each_lane!(i: self.0 => exp2_integer_f64(self.0[i])))
    }
    #[inline(always)]
    fn mantissa_exponent(self) -> (Self, Self) {
        (
            Lanes(each_lane!(i: self.0 => mantissa_exponent_f64(self.0[i]).0)),
            Lanes(each_lane!(i: self.0 => mantissa_exponent_f64(self.0[i]).1)),
        )
    }
    #[inline(always)]
    fn integer_bit(self, n: u32) -> LaneMask<W> {
        LaneMask(each_lane!(i: [0; W] => integer_bit_f64(self.0[i], n).wrapping_neg()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation on four lanes, folded into one number per lane.
    fn everything<R: Real>(x: R, y: R) -> [R; 12] {
        let (s, c) = (x * R::splat(7.0)).sin_cos();
        [
            x + y,
            x - y,
            x * y,
            x / y,
            -x,
            x.abs().sqrt(),
            x.exp(),
            y.ln(),
            x.tanh(),
            s + c,
            y.powf(R::splat(1.37)),
            R::select(
                x.greater(R::zero()),
                x.max(y),
                (x * R::splat(0.1)).asin_small(),
            ),
        ]
    }

    #[test]
    fn a_lane_equals_its_scalar_bitwise() {
        let xs = [0.3, -0.7, 1.1, -1.2];
        let ys = [2.0, 0.4, 13.0, 1e-6];
        let wide = everything(Lanes(xs), Lanes(ys));
        for lane in 0..4 {
            let narrow = everything(xs[lane], ys[lane]);
            for (w, n) in wide.iter().zip(narrow) {
                assert_eq!(w.0[lane].to_bits(), n.to_bits());
            }
        }
    }
    #[test]
    fn masks_select_lane_by_lane() {
        let x = Lanes([1.0, -1.0]);
        let positive = x.greater(Lanes::zero());
        assert!(positive.lane(0) && !positive.lane(1));
        assert!(positive.any() && (!positive).any() && !(positive & !positive).any());
        assert!((positive | !positive).lane(1));
        assert_eq!(
            Lanes::select(positive, Lanes::one(), Lanes::zero()).0,
            [1.0, 0.0]
        );
    }
    #[test]
    fn a_group_holds_the_parts_and_repeats_the_last() {
        let parts = [1.0, 2.0, 3.0, 4.0, 5.0];
        assert_eq!(f64::load_group(&parts, 0).0, [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(f64::load_group(&parts, 4).0, [5.0; 4]);
        let mut out = [0.0; 5];
        f64::store_group(Lanes([1.0, 2.0, 3.0, 4.0]), &mut out, 0);
        f64::store_group(Lanes([9.0; 4]), &mut out, 4);
        assert_eq!(out, [1.0, 2.0, 3.0, 4.0, 9.0]);
    }
    #[test]
    fn rounding_is_to_even() {
        for (x, nearest) in [
            (0.5, 0.0),
            (1.5, 2.0),
            (-2.5, -2.0),
            (2.499, 2.0),
            (-7.51, -8.0),
        ] {
            assert_eq!(Real::round(x), nearest);
        }
    }
    #[test]
    fn not_a_number_is_never_the_larger() {
        assert_eq!(Real::max(f64::NAN, 1.0), 1.0);
        assert_eq!(Real::min(f64::NAN, 1.0), 1.0);
    }
}
