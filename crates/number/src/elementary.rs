//! Elementary functions, written once for `f64` and lanes.
//!
//! Polynomials and bit operations only: no call leaves the lane loop, no integer conversion
//! instruction is needed, so everything vectorises from SSE2 upwards.
//! Coefficients are Taylor coefficients where the reduced range is small enough, else the
//! minimax coefficients of W. J. Cody and W. Waite's method as used in fdlibm (Sun Microsystems, 1993).

use crate::Real;

/// What the polynomials need beyond [`Real`]: the bits of the number.
pub trait Bits: Real {
    /// 2^n for an integer-valued n, |n| < 1023.
    fn exp2_integer(self) -> Self;
    /// (mantissa in [1, 2), exponent) of a normal positive number.
    fn mantissa_exponent(self) -> (Self, Self);
    /// Bit `n` of an integer-valued number, |self| < 2^51, two's complement.
    fn integer_bit(self, n: u32) -> Self::Mask;
}

/// Adding and subtracting 1.5·2^52 rounds to the nearest integer and leaves it in the low bits.
pub(crate) const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// ln 2 in two parts; the high part has 33 significant bits, so n·LN2_HIGH is exact for |n| < 2^20.
const LN2_HIGH: f64 = 6.931_471_803_691_238_16e-1;
const LN2_LOW: f64 = 1.908_214_929_270_587_70e-10;
/// π/2 in three parts of 33 bits each.
const HALF_PI: [f64; 3] = [
    1.570_796_326_734_125_61,
    6.077_100_506_303_965_98e-11,
    2.022_266_248_795_950_63e-21,
];

/// 2^52: a number with this exponent has its integer in its low bits.
pub(crate) const LOW_EXPONENT: f64 = 4_503_599_627_370_496.0;
/// The bits of 1.0: exponent 0, mantissa 1.
pub(crate) const ONE_BITS: u64 = 1023 << 52;

/// `ROUNDING` arithmetic for one `f64`.
#[inline(always)]
pub(crate) fn round_f64(x: f64) -> f64 {
    (x + ROUNDING) - ROUNDING
}
#[inline(always)]
pub(crate) fn exp2_integer_f64(x: f64) -> f64 {
    f64::from_bits(((x + ROUNDING).to_bits() << 52).wrapping_add(ONE_BITS))
}
#[inline(always)]
pub(crate) fn mantissa_exponent_f64(x: f64) -> (f64, f64) {
    let bits = x.to_bits();
    let mantissa = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) | ONE_BITS);
    // 2^52 + biased exponent, as a number, without an integer conversion.
    let exponent = f64::from_bits((bits >> 52) | 0x4330_0000_0000_0000) - LOW_EXPONENT - 1023.0;
    (mantissa, exponent)
}
#[inline(always)]
pub(crate) fn integer_bit_f64(x: f64, n: u32) -> u64 {
    ((x + ROUNDING).to_bits() >> n) & 1
}

/// Polynomial a\[0\] + a\[1\] x + … by splitting into even and odd powers: half the latency of Horner's form.
#[inline(always)]
fn polynomial<R: Real, const N: usize>(x: R, a: &[f64; N]) -> R {
    let z = x * x;
    let (mut even, mut odd) = if N % 2 == 1 {
        (R::splat(a[N - 1]), R::splat(a[N - 2]))
    } else {
        (R::splat(a[N - 2]), R::splat(a[N - 1]))
    };
    let mut i = (N - 1) / 2;
    if N % 2 == 1 {
        // N odd: `odd` starts one below the top even power.
        while i > 0 {
            i -= 1;
            even = even * z + R::splat(a[2 * i]);
            if i > 0 {
                odd = odd * z + R::splat(a[2 * i - 1]);
            }
        }
    } else {
        while i > 0 {
            i -= 1;
            even = even * z + R::splat(a[2 * i]);
            odd = odd * z + R::splat(a[2 * i + 1]);
        }
    }
    even + x * odd
}

/// (eʳ - 1, 2ⁿ) with x = n ln 2 + r, |r| ≤ ln 2 / 2.
#[inline(always)]
fn expm1_reduced<R: Bits>(x: R) -> (R, R) {
    let n = (x * R::splat(std::f64::consts::LOG2_E)).round();
    let r = x - n * R::splat(LN2_HIGH) - n * R::splat(LN2_LOW);
    const A: [f64; 12] = [
        0.5,
        1.0 / 6.0,
        1.0 / 24.0,
        1.0 / 120.0,
        1.0 / 720.0,
        1.0 / 5_040.0,
        1.0 / 40_320.0,
        1.0 / 362_880.0,
        1.0 / 3_628_800.0,
        1.0 / 39_916_800.0,
        1.0 / 479_001_600.0,
        1.0 / 6_227_020_800.0,
    ];
    (r + r * r * polynomial(r, &A), n.exp2_integer())
}

/// eˣ.
#[inline(always)]
pub fn exp<R: Bits>(x: R) -> R {
    let x = x.max(R::splat(-700.0)).min(R::splat(700.0));
    let (p, scale) = expm1_reduced(x);
    scale * p + scale
}

/// tanh x = (e²ˣ - 1)/(e²ˣ + 1), computed through e²ˣ - 1 so that small arguments keep their relative accuracy.
#[inline(always)]
pub fn tanh<R: Bits>(x: R) -> R {
    let doubled = (x + x).max(R::splat(-40.0)).min(R::splat(40.0));
    let (p, scale) = expm1_reduced(doubled);
    let expm1 = scale * p + (scale - R::one());
    expm1 / (expm1 + R::splat(2.0))
}

/// Sine and cosine.
#[inline(always)]
pub fn sin_cos<R: Bits>(x: R) -> (R, R) {
    let n = (x * R::splat(std::f64::consts::FRAC_2_PI)).round();
    let r = x - n * R::splat(HALF_PI[0]) - n * R::splat(HALF_PI[1]) - n * R::splat(HALF_PI[2]);
    let z = r * r;
    const S: [f64; 6] = [
        -1.666_666_666_666_663_24e-1,
        8.333_333_333_322_489_46e-3,
        -1.984_126_982_985_794_93e-4,
        2.755_731_370_707_006_77e-6,
        -2.505_076_025_340_686_34e-8,
        1.589_690_995_211_550_10e-10,
    ];
    const C: [f64; 6] = [
        4.166_666_666_666_660_19e-2,
        -1.388_888_888_887_410_96e-3,
        2.480_158_728_947_672_94e-5,
        -2.755_731_435_139_066_33e-7,
        2.087_572_321_298_174_83e-9,
        -1.135_964_755_778_819_48e-11,
    ];
    let sine = r + r * z * polynomial(z, &S);
    let cosine = R::one() - z * R::splat(0.5) + z * z * polynomial(z, &C);
    let odd = n.integer_bit(0);
    let (s, c) = (R::select(odd, cosine, sine), R::select(odd, sine, cosine));
    (
        R::select(n.integer_bit(1), -s, s),
        R::select((n + R::one()).integer_bit(1), -c, c),
    )
}

/// Natural logarithm of a normal positive number.
#[inline(always)]
pub fn ln<R: Bits>(x: R) -> R {
    let (mantissa, exponent) = x.mantissa_exponent();
    let big = mantissa.greater(R::splat(std::f64::consts::SQRT_2));
    let m = R::select(big, mantissa * R::splat(0.5), mantissa);
    let e = R::select(big, exponent + R::one(), exponent);
    // ln m = 2 artanh t with t = (m-1)/(m+1), |t| ≤ 0.1716.
    let t = (m - R::one()) / (m + R::one());
    let z = t * t;
    const A: [f64; 10] = [
        2.0 / 3.0,
        2.0 / 5.0,
        2.0 / 7.0,
        2.0 / 9.0,
        2.0 / 11.0,
        2.0 / 13.0,
        2.0 / 15.0,
        2.0 / 17.0,
        2.0 / 19.0,
        2.0 / 21.0,
    ];
    let l = t + t + t * z * polynomial(z, &A);
    e * R::splat(LN2_HIGH) + (e * R::splat(LN2_LOW) + l)
}

/// Arc sine for |x| ≤ 0.125.
#[inline(always)]
pub fn asin_small<R: Real>(x: R) -> R {
    // (2k)!/(4^k k!² (2k+1)), k = 1…8
    const A: [f64; 8] = [
        1.0 / 6.0,
        3.0 / 40.0,
        15.0 / 336.0,
        105.0 / 3_456.0,
        945.0 / 42_240.0,
        10_395.0 / 599_040.0,
        135_135.0 / 9_676_800.0,
        2_027_025.0 / 175_472_640.0,
    ];
    let z = x * x;
    x + x * z * polynomial(z, &A)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance in units of the last place of `reference`.
    fn ulp(value: f64, reference: f64) -> f64 {
        let unit = f64::from_bits(reference.abs().to_bits() + 1) - reference.abs();
        (value - reference).abs() / unit
    }
    /// Deterministic points spread over [low, high].
    fn points(low: f64, high: f64) -> impl Iterator<Item = f64> {
        let n = 200_003;
        (0..n).map(move |i| low + (high - low) * ((i as f64 * 0.618_033_988_749_894_9) % 1.0))
    }
    fn largest(low: f64, high: f64, error: impl Fn(f64) -> f64) -> f64 {
        points(low, high).map(error).fold(0.0, f64::max)
    }

    #[test]
    fn exp_is_within_two_ulp() {
        assert!(largest(-700.0, 700.0, |x| ulp(exp(x), x.exp())) <= 2.0);
        assert!(largest(-1.0, 1.0, |x| ulp(exp(x), x.exp())) <= 2.0);
        assert_eq!(exp(0.0), 1.0);
        assert!(exp(1e4).is_finite() && exp(-1e4) > 0.0);
    }
    #[test]
    fn ln_is_within_two_ulp_and_four_near_one() {
        assert!(largest(1e-300, 1e300, |x| ulp(ln(x), x.ln())) <= 2.0);
        assert!(largest(2.0, 100.0, |x| ulp(ln(x), x.ln())) <= 2.0);
        assert!(largest(0.5, 2.0, |x| ulp(ln(x), x.ln())) <= 4.0);
        assert_eq!(ln(1.0), 0.0);
    }
    #[test]
    fn powf_error_grows_with_the_logarithm() {
        for y in [-3.0, 0.5, 2.0 / 3.0, 10.0 / 9.0, 1.5] {
            let bound = |x: f64| 2.3e-16 * (2.0 + (y * x.ln()).abs());
            assert!(
                largest(1e-9, 1e3, |x| (Real::powf(x, y) / f64::powf(x, y) - 1.0)
                    .abs()
                    / bound(x))
                    <= 1.0
            );
        }
    }
    #[test]
    fn tanh_is_within_four_ulp_even_where_it_is_tiny() {
        assert!(largest(-25.0, 25.0, |x| ulp(tanh(x), x.tanh())) <= 4.0);
        assert!(largest(-1e-3, 1e-3, |x| ulp(tanh(x), x.tanh())) <= 4.0);
        assert_eq!(tanh(0.0), 0.0);
        assert_eq!(tanh(1e9), 1.0);
        assert!(
            points(-30.0, 30.0).all(|x| tanh(-x) == -tanh(x) || ulp(tanh(-x), -tanh(x)) <= 4.0)
        );
    }
    #[test]
    fn sine_and_cosine_hold_over_many_turns() {
        for reach in [1.0, 100.0, 1e5] {
            let error = |x: f64| {
                let (s, c) = sin_cos(x);
                (s - x.sin()).abs().max((c - x.cos()).abs())
            };
            assert!(largest(-reach, reach, error) <= 2.3e-16);
        }
    }
    #[test]
    fn asin_small_is_within_two_ulp() {
        assert!(largest(-0.125, 0.125, |x| ulp(asin_small(x), x.asin())) <= 2.0);
    }
}
