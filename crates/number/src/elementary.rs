//! Elementary functions, written once for `f64` and lanes.
//!
//! Polynomials and bit operations only: no call leaves the lane loop, no integer conversion
//! instruction is needed, so everything vectorises from SSE2 upwards.
//! Coefficients of sine and cosine are the minimax coefficients of fdlibm (Sun Microsystems, 1993); all others
//! interpolate at the Chebyshev nodes of the reduced range and miss it by less than 5e-17 of the result.

use crate::Real;

/// The functions of this page as methods of a number.
macro_rules! elementary_functions {
    () => {
        #[inline(always)]
        fn exp(self) -> Self {
            $crate::elementary::exp(self)
        }
        #[inline(always)]
        fn ln(self) -> Self {
            $crate::elementary::ln(self)
        }
        #[inline(always)]
        fn tanh(self) -> Self {
            $crate::elementary::tanh(self)
        }
        #[inline(always)]
        fn tanh_pair(self, other: Self) -> (Self, Self) {
            $crate::elementary::tanh_pair(self, other)
        }
        #[inline(always)]
        fn sin_cos(self) -> (Self, Self) {
            $crate::elementary::sin_cos(self)
        }
        #[inline(always)]
        fn two_thirds(self) -> Self {
            $crate::elementary::two_thirds(self)
        }
        #[inline(always)]
        fn asin_small(self) -> Self {
            $crate::elementary::asin_small(self)
        }
    };
}
pub(crate) use elementary_functions;

/// What the polynomials need beyond [`Real`]: the bits of the number.
///
/// A *shifted* integer n is n + [`ROUNDING`]: its low bits are n, in two's complement.
pub trait Bits: Real {
    /// 2^n for a shifted integer n, |n| < 1023.
    fn exp2_shifted(self) -> Self;
    /// (mantissa in [1, 2), exponent) of a normal positive number.
    fn mantissa_exponent(self) -> (Self, Self);
    /// True where a shifted integer is odd.
    fn odd_shifted(self) -> Self::Mask;
    /// x^(-⅓) of a normal positive number, within 4 %.
    fn near_inverse_cube_root(self) -> Self;
    /// `self`, with its sign changed where another number has the sign bit.
    fn negated_where_negative(self, other: Self) -> Self;
    /// `self`, with its sign changed where bit 1 of a shifted integer is set.
    fn negated_by_bit_one(self, shifted: Self) -> Self;
}

/// Adding and subtracting 1.5·2^52 rounds to the nearest integer and leaves it in the low bits.
pub const ROUNDING: f64 = 6_755_399_441_055_744.0;

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
/// Its bits.
pub(crate) const LOW_EXPONENT_BITS: u64 = 0x4330_0000_0000_0000;
/// The bits of 1.0: exponent 0, mantissa 1.
pub(crate) const ONE_BITS: u64 = 1023 << 52;
/// The sign.
pub(crate) const SIGN_BIT: u64 = 1 << 63;

/// The upper 44 bits of a positive number count exponent and mantissa, nearly its logarithm in 2^-32: a third of it, turned
/// over, is that of the root. `LOW_EXPONENT` makes them a number and back.
pub(crate) const ROOT_SLOPE: f64 = -1.0 / 3.0;
/// What makes 2^52 + n, times the slope, 2^52 + 0x553ef0ff289 - n/3: the offset with the least error (from memory).
pub(crate) const ROOT_OFFSET: f64 = 0x0553_ef0f_f289_u64 as f64 + LOW_EXPONENT * (4.0 / 3.0);

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

/// eˣ.
#[inline(always)]
pub fn exp<R: Bits>(x: R) -> R {
    // x = n ln 2 + r, |r| ≤ ln 2 / 2; (eʳ - 1 - r)/r²
    const A: [f64; 10] = [
        0.500_000_000_000_000_1,
        0.166_666_666_666_666_69,
        0.041_666_666_666_624_136,
        0.008_333_333_333_330_063,
        0.001_388_888_891_720_967,
        0.000_198_412_698_630_505_06,
        2.480_152_130_224_108_2e-5,
        2.755_726_846_483_162_7e-6,
        2.762_008_545_501_841_4e-7,
        2.510_038_319_586_702e-8,
    ];
    let x = x.max(R::splat(-700.0)).min(R::splat(700.0));
    let shifted = x * R::splat(std::f64::consts::LOG2_E) + R::splat(ROUNDING);
    let n = shifted - R::splat(ROUNDING);
    let r = x - n * R::splat(LN2_HIGH) - n * R::splat(LN2_LOW);
    let scale = shifted.exp2_shifted();
    scale * (r + r * r * polynomial(r, &A)) + scale
}

/// Numerator and denominator of tanh x for x ≥ 0, clamped at 20; their relative error stays small where x is small.
#[inline(always)]
fn tanh_ratio<R: Bits>(x: R) -> (R, R) {
    // 2x = (n + f) ln 2, |f| ≤ ½; tanh(½ f ln 2) = u/q with u = f P(f²), q = Q(f²), so that e²ˣ = 2ⁿ (q + u)/(q - u)
    const P: [f64; 2] = [65_550.990_150_493_19, 874.743_276_832_168];
    const Q: [f64; 3] = [
        189_140.176_830_955_6,
        10_096.722_909_361_128,
        43.300_541_422_653_15,
    ];
    const LARGEST: f64 = 20.0 * 2.0 * std::f64::consts::LOG2_E;
    let binary = x * R::splat(2.0 * std::f64::consts::LOG2_E);
    let binary = binary.min(R::splat(LARGEST));
    let shifted = binary + R::splat(ROUNDING);
    let f = binary - (shifted - R::splat(ROUNDING));
    let scale = shifted.exp2_shifted();
    let z = f * f;
    let u = f * ((z + R::splat(P[1])) * z + R::splat(P[0]));
    let q = (R::splat(Q[2]) * z + R::splat(Q[1])) * z + R::splat(Q[0]);
    let both = (scale * R::splat(0.5) - R::splat(0.5)) * (q + u);
    (both + u, both + q)
}

/// tanh x = (e²ˣ - 1)/(e²ˣ + 1), computed from |x| so that it is odd to the last bit.
#[inline(always)]
pub fn tanh<R: Bits>(x: R) -> R {
    let (above, below) = tanh_ratio(x.abs());
    (above / below).negated_where_negative(x)
}

/// The hyperbolic tangents of two numbers for one division.
#[inline(always)]
pub fn tanh_pair<R: Bits>(x: R, y: R) -> (R, R) {
    let (above_x, below_x) = tanh_ratio(x.abs());
    let (above_y, below_y) = tanh_ratio(y.abs());
    let inverse = (below_x * below_y).recip();
    (
        (above_x * below_y * inverse).negated_where_negative(x),
        (above_y * below_x * inverse).negated_where_negative(y),
    )
}

/// Sine and cosine.
#[inline(always)]
pub fn sin_cos<R: Bits>(x: R) -> (R, R) {
    let shifted = x * R::splat(std::f64::consts::FRAC_2_PI) + R::splat(ROUNDING);
    let n = shifted - R::splat(ROUNDING);
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
    let odd = shifted.odd_shifted();
    (
        R::select(odd, cosine, sine).negated_by_bit_one(shifted),
        R::select(odd, sine, cosine).negated_by_bit_one(shifted + R::one()),
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
    const A: [f64; 7] = [
        0.666_666_666_666_667,
        0.399_999_999_998_992_4,
        0.285_714_286_260_958_9,
        0.222_222_111_151_441_6,
        0.181_828_905_566_952_06,
        0.153_316_740_301_678_6,
        0.146_170_375_487_916_5,
    ];
    let l = t + t + t * z * polynomial(z, &A);
    e * R::splat(LN2_HIGH) + (e * R::splat(LN2_LOW) + l)
}

/// x^⅔ of a normal positive number, without a division.
#[inline(always)]
pub fn two_thirds<R: Bits>(x: R) -> R {
    // y = x^(-⅓) (1 - e)^(1/3), e = 1 - x y³: so much of the series of (1 - e)^(-1/3) that e = 0.1 leaves 1e-6, and that nothing
    let y = x.near_inverse_cube_root();
    let e = R::one() - x * y * (y * y);
    let series = ((R::splat(35.0 / 243.0) * e + R::splat(14.0 / 81.0)) * e + R::splat(2.0 / 9.0))
        * e
        + R::splat(1.0 / 3.0);
    let y = y + y * (e * series);
    let e = R::one() - x * y * (y * y);
    let y = y + y * (e * (R::splat(2.0 / 9.0) * e + R::splat(1.0 / 3.0)));
    x * y
}

/// Arc sine for |x| ≤ 0.125.
#[inline(always)]
pub fn asin_small<R: Real>(x: R) -> R {
    const A: [f64; 6] = [
        0.166_666_666_666_666_57,
        0.075_000_000_000_475_33,
        0.044_642_856_788_276_65,
        0.030_382_041_082_465_04,
        0.022_360_274_967_086_82,
        0.018_023_552_753_717_71,
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
    fn tanh_is_within_five_ulp_even_where_it_is_tiny() {
        for reach in [25.0, 1.0, 1e-3, 1e-9] {
            assert!(largest(-reach, reach, |x| ulp(tanh(x), x.tanh())) <= 5.0);
        }
        assert_eq!(tanh(0.0), 0.0);
        assert_eq!(tanh(1e9), 1.0);
        assert!(points(-30.0, 30.0).all(|x| tanh(-x) == -tanh(x)));
        assert!(points(-30.0, 30.0).all(|x| tanh_pair(-x, x).0 == -tanh_pair(x, x).1));
    }
    #[test]
    fn a_pair_of_tanh_is_within_six_ulp() {
        for other in [-30.0, -0.7, 1e-9, 12.0] {
            let error = |x: f64| {
                let (first, second) = tanh_pair(x, other);
                ulp(first, x.tanh()).max(ulp(second, other.tanh()))
            };
            for reach in [25.0, 1.0, 1e-3] {
                assert!(largest(-reach, reach, error) <= 6.0);
            }
        }
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
    fn two_thirds_is_within_two_ulp() {
        for (low, high) in [(1e-300, 1e300), (1e-9, 10.0), (1.0, 8.0), (2e3, 1e9)] {
            assert!(largest(low, high, |x| ulp(two_thirds(x), x.cbrt() * x.cbrt())) <= 3.0);
        }
        // exact cubes: nothing is lost in the reference
        for root in 1..2000 {
            let root = f64::from(root);
            assert!(ulp(two_thirds(root.powi(3)), root * root) <= 2.0);
        }
    }
    #[test]
    fn asin_small_is_within_two_ulp() {
        assert!(largest(-0.125, 0.125, |x| ulp(asin_small(x), x.asin())) <= 2.0);
    }
}
