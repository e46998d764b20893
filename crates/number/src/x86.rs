//! Numbers on the vector units of x86-64.
//!
//! These types are private: code outside meets them only as type parameters of a [`Task`](crate::Task), which
//! [`Level::run_one`](crate::Level::run_one) and its like start after they have seen that the machine has the instructions. That makes the
//! intrinsics below sound. Their methods are inlined into functions compiled for the unit ([`Real::vectorized`]).

use crate::elementary::{
    Bits, LOW_EXPONENT, LOW_EXPONENT_BITS, ONE_BITS, ROOT_OFFSET, ROOT_SLOPE, ROUNDING, SIGN_BIT,
    elementary_functions,
};
use crate::real::Vectorized;
use crate::scalar::group_of_one;
use crate::single::Parts;
use crate::{Mask, Real};
use std::arch::x86_64::*;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};

/// Four machines side by side, or four parts of one: AVX2.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct Four(__m256d);
/// Truth of four lanes: the sign bits.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct FourMask(__m256d);
/// Eight machines side by side: AVX-512.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct Eight(__m512d);
/// Truth of eight lanes.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct EightMask(__mmask8);
// SAFETY of every block below: the types are reachable only on machines with the instructions, see the module.
macro_rules! binary {
    ($Type:ident, $Trait:ident, $method:ident, $Assign:ident, $assign:ident, $intrinsic:ident) => {
        impl $Trait for $Type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: see the module.
                $Type(unsafe { $intrinsic(self.0, other.0) })
            }
        }
        impl $Assign for $Type {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                *self = $Trait::$method(*self, other);
            }
        }
    };
}
macro_rules! operators {
    ($Type:ident, $add:ident, $sub:ident, $mul:ident, $div:ident) => {
        binary!($Type, Add, add, AddAssign, add_assign, $add);
        binary!($Type, Sub, sub, SubAssign, sub_assign, $sub);
        binary!($Type, Mul, mul, MulAssign, mul_assign, $mul);
        impl Div for $Type {
            type Output = Self;
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                // SAFETY: see the module.
                $Type(unsafe { $div(self.0, other.0) })
            }
        }
        impl Neg for $Type {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // -0 - x, not a flip of the sign bit: the compiler knows it and folds it into sums
                $Type::splat(-0.0) - self
            }
        }
    };
}
operators!(
    Four,
    _mm256_add_pd,
    _mm256_sub_pd,
    _mm256_mul_pd,
    _mm256_div_pd
);
operators!(
    Eight,
    _mm512_add_pd,
    _mm512_sub_pd,
    _mm512_mul_pd,
    _mm512_div_pd
);

/// The methods of `Real` that are the same for both widths.
macro_rules! shared_methods {
    ($Type:ident, $Vector:ty, $Array:ty, $set:ident, $sqrt:ident, $andnot:ident, $max:ident, $min:ident, $level:ident) => {
        #[inline(always)]
        fn splat(value: f64) -> Self {
            // SAFETY: see the module.
            $Type(unsafe { $set(value) })
        }
        #[inline(always)]
        fn from_lanes(lane: impl FnMut(usize) -> f64) -> Self {
            let array: $Array = std::array::from_fn(lane);
            // SAFETY: an array of as many f64 has the size and the bits of the vector.
            $Type(unsafe { std::mem::transmute::<$Array, $Vector>(array) })
        }
        #[inline(always)]
        fn lane(self, index: usize) -> f64 {
            // SAFETY: as in `from_lanes`.
            let array: $Array = unsafe { std::mem::transmute(self.0) };
            array[index]
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            // SAFETY: see the module.
            $Type(unsafe { $sqrt(self.0) })
        }
        #[inline(always)]
        fn abs(self) -> Self {
            // SAFETY: see the module.
            $Type(unsafe { $andnot($set(-0.0), self.0) })
        }
        // the instructions return their second operand where the two do not compare or are both zero, as promised
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            // SAFETY: see the module.
            $Type(unsafe { $max(self.0, other.0) })
        }
        #[inline(always)]
        fn min(self, other: Self) -> Self {
            // SAFETY: see the module.
            $Type(unsafe { $min(self.0, other.0) })
        }
        #[inline(always)]
        fn round(self) -> Self {
            (self + Self::splat(ROUNDING)) - Self::splat(ROUNDING)
        }
        elementary_functions!();
        #[inline(always)]
        fn vectorized<T: Vectorized>(task: T) -> T::Output {
            // SAFETY: see the module.
            unsafe { $level(task) }
        }
    };
}

impl Real for Four {
    type Mask = FourMask;
    const LANES: usize = 4;
    group_of_one!();
    shared_methods!(
        Four,
        __m256d,
        [f64; 4],
        _mm256_set1_pd,
        _mm256_sqrt_pd,
        _mm256_andnot_pd,
        _mm256_max_pd,
        _mm256_min_pd,
        for_avx2
    );
    #[inline(always)]
    fn greater(self, other: Self) -> FourMask {
        // SAFETY: see the module.
        FourMask(unsafe { _mm256_cmp_pd::<_CMP_GT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn select(mask: FourMask, yes: Self, no: Self) -> Self {
        // SAFETY: see the module.
        Four(unsafe { _mm256_blendv_pd(no.0, yes.0, mask.0) })
    }
}

impl Bits for Four {
    #[inline(always)]
    fn exp2_shifted(self) -> Self {
        // SAFETY: see the module.
        Four(unsafe {
            let exponent = _mm256_slli_epi64::<52>(_mm256_castpd_si256(self.0));
            let one = _mm256_set1_epi64x(ONE_BITS as i64);
            _mm256_castsi256_pd(_mm256_add_epi64(exponent, one))
        })
    }
    #[inline(always)]
    fn mantissa_exponent(self) -> (Self, Self) {
        // SAFETY: see the module.
        unsafe {
            let bits = _mm256_castpd_si256(self.0);
            let fraction = _mm256_and_si256(bits, _mm256_set1_epi64x(0x000f_ffff_ffff_ffff));
            let mantissa = _mm256_or_si256(fraction, _mm256_set1_epi64x(ONE_BITS as i64));
            let exponent = _mm256_or_si256(
                _mm256_srli_epi64::<52>(bits),
                _mm256_set1_epi64x(0x4330_0000_0000_0000),
            );
            (
                Four(_mm256_castsi256_pd(mantissa)),
                Four(_mm256_castsi256_pd(exponent))
                    - Self::splat(LOW_EXPONENT)
                    - Self::splat(1023.0),
            )
        }
    }
    #[inline(always)]
    fn near_inverse_cube_root(self) -> Self {
        // SAFETY: see the module.
        unsafe {
            let upper = _mm256_srli_epi64::<20>(_mm256_castpd_si256(self.0));
            let logarithm = _mm256_or_si256(upper, _mm256_set1_epi64x(LOW_EXPONENT_BITS as i64));
            let root = Four(_mm256_castsi256_pd(logarithm)) * Self::splat(ROOT_SLOPE)
                + Self::splat(ROOT_OFFSET);
            Four(_mm256_castsi256_pd(_mm256_slli_epi64::<20>(
                _mm256_castpd_si256(root.0),
            )))
        }
    }
    #[inline(always)]
    fn odd_shifted(self) -> FourMask {
        // SAFETY: see the module.
        FourMask(unsafe {
            _mm256_castsi256_pd(_mm256_slli_epi64::<63>(_mm256_castpd_si256(self.0)))
        })
    }
    #[inline(always)]
    fn negated_where_negative(self, other: Self) -> Self {
        // SAFETY: see the module.
        Four(unsafe {
            let sign = _mm256_and_pd(other.0, _mm256_set1_pd(-0.0));
            _mm256_xor_pd(self.0, sign)
        })
    }
    #[inline(always)]
    fn negated_by_bit_one(self, shifted: Self) -> Self {
        // SAFETY: see the module.
        Four(unsafe {
            let bit = _mm256_slli_epi64::<62>(_mm256_castpd_si256(shifted.0));
            let sign = _mm256_and_si256(bit, _mm256_set1_epi64x(SIGN_BIT as i64));
            _mm256_xor_pd(self.0, _mm256_castsi256_pd(sign))
        })
    }
}

impl BitAnd for FourMask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        // SAFETY: see the module.
        FourMask(unsafe { _mm256_and_pd(self.0, other.0) })
    }
}
impl BitOr for FourMask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        // SAFETY: see the module.
        FourMask(unsafe { _mm256_or_pd(self.0, other.0) })
    }
}
impl Not for FourMask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        // SAFETY: see the module.
        FourMask(unsafe { _mm256_xor_pd(self.0, _mm256_set1_pd(-0.0)) })
    }
}
impl Mask for FourMask {
    const LANES: usize = 4;
    #[inline(always)]
    fn any(self) -> bool {
        // SAFETY: see the module.
        unsafe { _mm256_movemask_pd(self.0) != 0 }
    }
    #[inline(always)]
    fn lane(self, index: usize) -> bool {
        Four(self.0).lane(index).is_sign_negative()
    }
    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> bool) -> Self {
        FourMask(Four::from_lanes(|i| if lane(i) { -1.0 } else { 1.0 }).0)
    }
}

impl Real for Eight {
    type Mask = EightMask;
    const LANES: usize = 8;
    group_of_one!();
    shared_methods!(
        Eight,
        __m512d,
        [f64; 8],
        _mm512_set1_pd,
        _mm512_sqrt_pd,
        _mm512_andnot_pd,
        _mm512_max_pd,
        _mm512_min_pd,
        for_avx512
    );
    #[inline(always)]
    fn greater(self, other: Self) -> EightMask {
        // SAFETY: see the module.
        EightMask(unsafe { _mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn select(mask: EightMask, yes: Self, no: Self) -> Self {
        // SAFETY: see the module.
        Eight(unsafe { _mm512_mask_blend_pd(mask.0, no.0, yes.0) })
    }
}

impl Bits for Eight {
    #[inline(always)]
    fn exp2_shifted(self) -> Self {
        // SAFETY: see the module.
        Eight(unsafe {
            let exponent = _mm512_slli_epi64::<52>(_mm512_castpd_si512(self.0));
            let one = _mm512_set1_epi64(ONE_BITS as i64);
            _mm512_castsi512_pd(_mm512_add_epi64(exponent, one))
        })
    }
    #[inline(always)]
    fn mantissa_exponent(self) -> (Self, Self) {
        // SAFETY: see the module.
        unsafe {
            let bits = _mm512_castpd_si512(self.0);
            let fraction = _mm512_and_si512(bits, _mm512_set1_epi64(0x000f_ffff_ffff_ffff));
            let mantissa = _mm512_or_si512(fraction, _mm512_set1_epi64(ONE_BITS as i64));
            let exponent = _mm512_or_si512(
                _mm512_srli_epi64::<52>(bits),
                _mm512_set1_epi64(0x4330_0000_0000_0000),
            );
            (
                Eight(_mm512_castsi512_pd(mantissa)),
                Eight(_mm512_castsi512_pd(exponent))
                    - Self::splat(LOW_EXPONENT)
                    - Self::splat(1023.0),
            )
        }
    }
    #[inline(always)]
    fn near_inverse_cube_root(self) -> Self {
        // SAFETY: see the module.
        unsafe {
            let upper = _mm512_srli_epi64::<20>(_mm512_castpd_si512(self.0));
            let logarithm = _mm512_or_si512(upper, _mm512_set1_epi64(LOW_EXPONENT_BITS as i64));
            let root = Eight(_mm512_castsi512_pd(logarithm)) * Self::splat(ROOT_SLOPE)
                + Self::splat(ROOT_OFFSET);
            Eight(_mm512_castsi512_pd(_mm512_slli_epi64::<20>(
                _mm512_castpd_si512(root.0),
            )))
        }
    }
    #[inline(always)]
    fn odd_shifted(self) -> EightMask {
        // SAFETY: see the module.
        EightMask(unsafe {
            _mm512_test_epi64_mask(_mm512_castpd_si512(self.0), _mm512_set1_epi64(1))
        })
    }
    #[inline(always)]
    fn negated_where_negative(self, other: Self) -> Self {
        // SAFETY: see the module.
        Eight(unsafe {
            let sign = _mm512_and_pd(other.0, _mm512_set1_pd(-0.0));
            _mm512_xor_pd(self.0, sign)
        })
    }
    #[inline(always)]
    fn negated_by_bit_one(self, shifted: Self) -> Self {
        // SAFETY: see the module.
        Eight(unsafe {
            let bit = _mm512_slli_epi64::<62>(_mm512_castpd_si512(shifted.0));
            let sign = _mm512_and_si512(bit, _mm512_set1_epi64(SIGN_BIT as i64));
            _mm512_xor_pd(self.0, _mm512_castsi512_pd(sign))
        })
    }
}

impl BitAnd for EightMask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        EightMask(self.0 & other.0)
    }
}
impl BitOr for EightMask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        EightMask(self.0 | other.0)
    }
}
impl Not for EightMask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        EightMask(!self.0)
    }
}
impl Mask for EightMask {
    const LANES: usize = 8;
    #[inline(always)]
    fn any(self) -> bool {
        self.0 != 0
    }
    #[inline(always)]
    fn lane(self, index: usize) -> bool {
        self.0 >> index & 1 == 1
    }
    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> bool) -> Self {
        EightMask((0..8).fold(0, |mask, i| mask | u8::from(lane(i)) << i))
    }
}

impl Parts for Four {
    #[inline(always)]
    fn load(parts: &[f64], from: usize) -> Self {
        match parts.get(from..from + 4) {
            // SAFETY: see the module; the slice has four elements.
            Some(full) => Four(unsafe { _mm256_loadu_pd(full.as_ptr()) }),
            None => Four::from_lanes(|i| parts[(parts.len() - 1).min(from + i)]),
        }
    }
    #[inline(always)]
    fn store(self, parts: &mut [f64], from: usize) {
        match parts.get_mut(from..from + 4) {
            // SAFETY: see the module; the slice has four elements.
            Some(full) => unsafe { _mm256_storeu_pd(full.as_mut_ptr(), self.0) },
            None => {
                for (i, part) in parts.iter_mut().skip(from).enumerate() {
                    *part = self.lane(i);
                }
            }
        }
    }
    #[inline(always)]
    fn add_to(self, sums: &mut [f64; 4], count: usize) {
        let valid = FourMask::from_lanes(|i| i < count);
        let added = Four::load(sums, 0) + Four::select(valid, self, Four::zero());
        added.store(sums, 0);
    }
}

impl Parts for Eight {
    #[inline(always)]
    fn load(parts: &[f64], from: usize) -> Self {
        let last = Eight::splat(parts[parts.len() - 1]);
        // SAFETY: see the module; the mask keeps the load inside the slice.
        Eight(unsafe {
            let pointer = parts.as_ptr().wrapping_add(from);
            _mm512_mask_loadu_pd(
                last.0,
                first_lanes(parts.len().saturating_sub(from)),
                pointer,
            )
        })
    }
    #[inline(always)]
    fn store(self, parts: &mut [f64], from: usize) {
        // SAFETY: see the module; the mask keeps the store inside the slice.
        unsafe {
            let pointer = parts.as_mut_ptr().wrapping_add(from);
            _mm512_mask_storeu_pd(
                pointer,
                first_lanes(parts.len().saturating_sub(from)),
                self.0,
            );
        }
    }
    #[inline(always)]
    fn add_to(self, sums: &mut [f64; 4], count: usize) {
        let mask = first_lanes(count);
        // SAFETY: see the module; `sums` has the size of the vector.
        unsafe {
            let old = _mm256_loadu_pd(sums.as_ptr());
            let half = _mm256_mask_add_pd(old, mask, old, _mm512_castpd512_pd256(self.0));
            let high = _mm512_extractf64x4_pd::<1>(self.0);
            let full = _mm256_mask_add_pd(half, mask >> 4, half, high);
            _mm256_storeu_pd(sums.as_mut_ptr(), full);
        }
    }
}

/// The mask of the first `count` of eight lanes.
#[inline(always)]
fn first_lanes(count: usize) -> __mmask8 {
    ((1_u32 << count.min(8)) - 1) as u8
}

#[inline(never)]
#[target_feature(enable = "avx2")]
pub(crate) fn for_avx2<T: Vectorized>(task: T) -> T::Output {
    task.run()
}

#[inline(never)]
#[target_feature(enable = "avx2,avx512f,avx512dq,avx512vl")]
pub(crate) fn for_avx512<T: Vectorized>(task: T) -> T::Output {
    task.run()
}
