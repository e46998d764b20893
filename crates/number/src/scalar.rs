//! Plain `f64`, and what its wrappers share with it.

use crate::elementary::*;
use crate::{Mask, Real};

impl Mask for bool {
    const LANES: usize = 1;
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

/// A group of one part: the number itself.
macro_rules! group_of_one {
    () => {
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
        fn add_group(group: Self, sums: &mut [Self; 4], from: usize, _count: usize) {
            sums[from % 4] += group;
        }
    };
}
pub(crate) use group_of_one;

/// Implements `Real` and `Bits` for `f64` or a wrapper of it, `$get` and `$make` being the way in and out.
macro_rules! scalar_real {
    (impl $([$V:ident: $Bound:ident])? for $Type:ty, |$x:ident| $get:expr, $make:expr, { $($group:tt)* }) => {
        impl $(<$V: $Bound>)? Real for $Type {
            type Mask = bool;
            const LANES: usize = 1;
            $($group)*
            #[inline(always)]
            fn splat(value: f64) -> Self {
                $make(value)
            }
            #[inline(always)]
            fn from_lanes(mut lane: impl FnMut(usize) -> f64) -> Self {
                $make(lane(0))
            }
            #[inline(always)]
            fn lane(self, _index: usize) -> f64 {
                let $x = self;
                $get
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                let $x = self;
                $make(f64::sqrt($get))
            }
            #[inline(always)]
            fn abs(self) -> Self {
                let $x = self;
                $make(f64::abs($get))
            }
            #[inline(always)]
            fn round(self) -> Self {
                let $x = self;
                $make(($get + ROUNDING) - ROUNDING)
            }
            $crate::elementary::elementary_functions!();
            #[inline(always)]
            fn greater(self, other: Self) -> bool {
                self.lane(0) > other.lane(0)
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
        }

        impl $(<$V: $Bound>)? Bits for $Type {
            #[inline(always)]
            fn exp2_shifted(self) -> Self {
                $make(f64::from_bits((self.lane(0).to_bits() << 52).wrapping_add(ONE_BITS)))
            }
            #[inline(always)]
            fn mantissa_exponent(self) -> (Self, Self) {
                let bits = self.lane(0).to_bits();
                let mantissa = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) | ONE_BITS);
                // 2^52 + biased exponent, as a number, without an integer conversion
                let exponent = f64::from_bits((bits >> 52) | LOW_EXPONENT_BITS) - LOW_EXPONENT - 1023.0;
                ($make(mantissa), $make(exponent))
            }
            #[inline(always)]
            fn near_inverse_cube_root(self) -> Self {
                let logarithm = f64::from_bits((self.lane(0).to_bits() >> 20) | LOW_EXPONENT_BITS);
                $make(f64::from_bits((logarithm * ROOT_SLOPE + ROOT_OFFSET).to_bits() << 20))
            }
            #[inline(always)]
            fn odd_shifted(self) -> bool {
                self.lane(0).to_bits() & 1 == 1
            }
            #[inline(always)]
            fn negated_where_negative(self, other: Self) -> Self {
                $make(f64::from_bits(self.lane(0).to_bits() ^ (other.lane(0).to_bits() & SIGN_BIT)))
            }
            #[inline(always)]
            fn negated_by_bit_one(self, shifted: Self) -> Self {
                $make(f64::from_bits(self.lane(0).to_bits() ^ ((shifted.lane(0).to_bits() << 62) & SIGN_BIT)))
            }
        }
    };
}
pub(crate) use scalar_real;

scalar_real!(impl for f64, |x| x, std::convert::identity, {
    group_of_one!();
});

#[cfg(test)]
mod tests {
    use super::*;

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
