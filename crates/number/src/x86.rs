//! Numbers on the vector units of x86-64.
//!
//! These types are private: code outside meets them only as type parameters of a [`Task`](crate::Task), which
//! [`Level::run_one`](crate::Level::run_one) and its like start after they have seen that the machine has the instructions. That makes the
//! intrinsics below sound. Their methods are inlined into functions compiled for the unit ([`Real::vectorized`]).

use crate::elementary::{
    Bits, LOW_EXPONENT, LOW_EXPONENT_BITS, ONE_BITS, ROOT_OFFSET, ROOT_SLOPE, ROUNDING,
    elementary_functions,
};
use crate::operators::{mask_operators, operators};
use crate::real::Vectorized;
use crate::scalar::group_of_one;
use crate::single::Parts;
use crate::{Mask, Real};
use std::arch::x86_64::*;

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

/// The instructions of each unit, under one name. What is compiled for a unit stands in its module: a compiler works on modules side by side.
pub(crate) mod avx2 {
    pub(super) use std::arch::x86_64::{
        _mm256_add_epi64 as add_bits, _mm256_add_pd as add, _mm256_and_pd as and,
        _mm256_and_si256 as and_bits, _mm256_andnot_pd as andnot, _mm256_castpd_si256 as to_bits,
        _mm256_castsi256_pd as from_bits, _mm256_div_pd as div, _mm256_max_pd as max,
        _mm256_min_pd as min, _mm256_mul_pd as mul, _mm256_or_si256 as or_bits,
        _mm256_set1_epi64x as set_bits, _mm256_set1_pd as set, _mm256_slli_epi64 as left,
        _mm256_sqrt_pd as sqrt, _mm256_srli_epi64 as right, _mm256_sub_pd as sub,
        _mm256_xor_pd as xor,
    };

    /// Runs a task compiled for the unit.
    #[inline(never)]
    #[target_feature(enable = "avx2")]
    pub(crate) fn run<T: crate::real::Vectorized>(task: T) -> T::Output {
        task.run()
    }
}
pub(crate) mod avx512 {
    pub(super) use std::arch::x86_64::{
        _mm512_add_epi64 as add_bits, _mm512_add_pd as add, _mm512_and_pd as and,
        _mm512_and_si512 as and_bits, _mm512_andnot_pd as andnot, _mm512_castpd_si512 as to_bits,
        _mm512_castsi512_pd as from_bits, _mm512_div_pd as div, _mm512_max_pd as max,
        _mm512_min_pd as min, _mm512_mul_pd as mul, _mm512_or_si512 as or_bits,
        _mm512_set1_epi64 as set_bits, _mm512_set1_pd as set, _mm512_slli_epi64 as left,
        _mm512_sqrt_pd as sqrt, _mm512_srli_epi64 as right, _mm512_sub_pd as sub,
        _mm512_xor_pd as xor,
    };

    /// Runs a task compiled for the unit.
    #[inline(never)]
    #[target_feature(enable = "avx2,avx512f,avx512dq,avx512vl")]
    pub(crate) fn run<T: crate::real::Vectorized>(task: T) -> T::Output {
        task.run()
    }
}

/// Numbers of one width: what both units have alike, and in braces what they do not.
// SAFETY of every block below: the types are reachable only on machines with the instructions, see the module.
macro_rules! vector {
    ($Type:ident($Vector:ty) by $unit:ident, lanes $lanes:literal, mask $Mask:ident, { $($own:tt)* }, { $($bits:tt)* }) => {
        operators!(
            [] $Type, |x, y|
            $Type(unsafe { $unit::add(x.0, y.0) }),
            $Type(unsafe { $unit::sub(x.0, y.0) }),
            $Type(unsafe { $unit::mul(x.0, y.0) }),
            $Type(unsafe { $unit::div(x.0, y.0) }),
            // -0 - x, not a flip of the sign bit: the compiler knows it and folds it into sums
            $Type::splat(-0.0) - x
        );
        impl Real for $Type {
            type Mask = $Mask;
            const LANES: usize = $lanes;
            group_of_one!();
            #[inline(always)]
            fn splat(value: f64) -> Self {
                // SAFETY: see the module.
                $Type(unsafe { $unit::set(value) })
            }
            #[inline(always)]
            fn from_lanes(lane: impl FnMut(usize) -> f64) -> Self {
                let array: [f64; $lanes] = std::array::from_fn(lane);
                // SAFETY: an array of as many f64 has the size and the bits of the vector.
                $Type(unsafe { std::mem::transmute::<[f64; $lanes], $Vector>(array) })
            }
            #[inline(always)]
            fn lane(self, index: usize) -> f64 {
                // SAFETY: as in `from_lanes`.
                let array: [f64; $lanes] = unsafe { std::mem::transmute(self.0) };
                array[index]
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: see the module.
                $Type(unsafe { $unit::sqrt(self.0) })
            }
            #[inline(always)]
            fn abs(self) -> Self {
                // SAFETY: see the module.
                $Type(unsafe { $unit::andnot($unit::set(-0.0), self.0) })
            }
            // the instructions return their second operand where the two do not compare or are both zero, as promised
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // SAFETY: see the module.
                $Type(unsafe { $unit::max(self.0, other.0) })
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                // SAFETY: see the module.
                $Type(unsafe { $unit::min(self.0, other.0) })
            }
            #[inline(always)]
            fn round(self) -> Self {
                (self + Self::splat(ROUNDING)) - Self::splat(ROUNDING)
            }
            elementary_functions!();
            #[inline(always)]
            fn vectorized<T: Vectorized>(task: T) -> T::Output {
                // SAFETY: see the module.
                unsafe { $unit::run(task) }
            }
            $($own)*
        }
        impl Bits for $Type {
            #[inline(always)]
            fn exp2_shifted(self) -> Self {
                // SAFETY: see the module.
                $Type(unsafe {
                    let exponent = $unit::left::<52>($unit::to_bits(self.0));
                    $unit::from_bits($unit::add_bits(exponent, $unit::set_bits(ONE_BITS as i64)))
                })
            }
            #[inline(always)]
            fn mantissa_exponent(self) -> (Self, Self) {
                // SAFETY: see the module.
                let (mantissa, exponent) = unsafe {
                    let bits = $unit::to_bits(self.0);
                    let fraction = $unit::and_bits(bits, $unit::set_bits(0x000f_ffff_ffff_ffff));
                    let mantissa = $unit::or_bits(fraction, $unit::set_bits(ONE_BITS as i64));
                    let low = $unit::set_bits(LOW_EXPONENT_BITS as i64);
                    let exponent = $unit::or_bits($unit::right::<52>(bits), low);
                    ($Type($unit::from_bits(mantissa)), $Type($unit::from_bits(exponent)))
                };
                (mantissa, exponent - Self::splat(LOW_EXPONENT) - Self::splat(1023.0))
            }
            #[inline(always)]
            fn near_inverse_cube_root(self) -> Self {
                // SAFETY: see the module.
                let logarithm = $Type(unsafe {
                    let upper = $unit::right::<20>($unit::to_bits(self.0));
                    $unit::from_bits($unit::or_bits(upper, $unit::set_bits(LOW_EXPONENT_BITS as i64)))
                });
                let root = logarithm * Self::splat(ROOT_SLOPE) + Self::splat(ROOT_OFFSET);
                // SAFETY: see the module.
                $Type(unsafe { $unit::from_bits($unit::left::<20>($unit::to_bits(root.0))) })
            }
            #[inline(always)]
            fn negated_where_negative(self, other: Self) -> Self {
                // SAFETY: see the module.
                $Type(unsafe { $unit::xor(self.0, $unit::and(other.0, $unit::set(-0.0))) })
            }
            #[inline(always)]
            fn negated_by_bit_one(self, shifted: Self) -> Self {
                // SAFETY: see the module.
                let bit = $Type(unsafe { $unit::from_bits($unit::left::<62>($unit::to_bits(shifted.0))) });
                self.negated_where_negative(bit)
            }
            $($bits)*
        }
    };
}

vector!(Four(__m256d) by avx2, lanes 4, mask FourMask, {
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
}, {
    #[inline(always)]
    fn odd_shifted(self) -> FourMask {
        // SAFETY: see the module.
        FourMask(unsafe { avx2::from_bits(avx2::left::<63>(avx2::to_bits(self.0))) })
    }
});
vector!(Eight(__m512d) by avx512, lanes 8, mask EightMask, {
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
}, {
    #[inline(always)]
    fn odd_shifted(self) -> EightMask {
        // SAFETY: see the module.
        EightMask(unsafe { _mm512_test_epi64_mask(avx512::to_bits(self.0), avx512::set_bits(1)) })
    }
});

mask_operators!(
    [] FourMask, |x, y|
    FourMask(unsafe { _mm256_and_pd(x.0, y.0) }),
    FourMask(unsafe { _mm256_or_pd(x.0, y.0) }),
    FourMask(unsafe { _mm256_xor_pd(x.0, _mm256_set1_pd(-0.0)) })
);
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

mask_operators!([] EightMask, |x, y| EightMask(x.0 & y.0), EightMask(x.0 | y.0), EightMask(!x.0));
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
