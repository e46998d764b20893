//! Exact fractions, for the exponents of units.

use std::fmt;

/// A fraction in lowest terms with a positive denominator, for example 10/9.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rational {
    numerator: i64,
    denominator: i64,
}

impl Rational {
    /// Zero.
    pub const ZERO: Rational = Rational::integer(0);
    /// One.
    pub const ONE: Rational = Rational::integer(1);

    /// A whole number.
    pub const fn integer(value: i64) -> Rational {
        Rational {
            numerator: value,
            denominator: 1,
        }
    }

    /// The fraction `numerator / denominator` in lowest terms; `None` for a zero denominator or numbers beyond 64 bits.
    pub fn new(numerator: i64, denominator: i64) -> Option<Rational> {
        Rational::reduce(i128::from(numerator), i128::from(denominator))
    }

    fn reduce(numerator: i128, denominator: i128) -> Option<Rational> {
        if denominator == 0 {
            return None;
        }
        let (mut a, mut b) = (numerator.abs(), denominator.abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        let divisor = a.max(1) * denominator.signum();
        Some(Rational {
            numerator: i64::try_from(numerator / divisor).ok()?,
            denominator: i64::try_from(denominator / divisor).ok()?,
        })
    }

    /// Reads `"3"`, `"-1.5"` or `"10/9"`; at most 15 digits after the point.
    pub fn parse(text: &str) -> Option<Rational> {
        let text = text.trim();
        if let Some((numerator, denominator)) = text.split_once('/') {
            return Rational::new(
                numerator.trim().parse().ok()?,
                denominator.trim().parse().ok()?,
            );
        }
        let (whole, decimals) = text.split_once('.').unwrap_or((text, ""));
        let digits = decimals.trim_end_matches('0');
        let has_digit = text.bytes().any(|byte| byte.is_ascii_digit());
        let clean = decimals.bytes().all(|byte| byte.is_ascii_digit());
        if !has_digit || !clean || digits.len() > 15 {
            return None;
        }
        let all: i128 = format!("{whole}{digits}").parse().ok()?;
        Rational::reduce(all, 10_i128.pow(u32::try_from(digits.len()).ok()?))
    }

    /// The numerator in lowest terms; it carries the sign.
    pub const fn numerator(self) -> i64 {
        self.numerator
    }

    /// The denominator in lowest terms, positive.
    pub const fn denominator(self) -> i64 {
        self.denominator
    }

    /// The nearest `f64`.
    pub fn value(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }

    /// The sum; `None` beyond 64 bits.
    pub fn plus(self, other: Rational) -> Option<Rational> {
        let (a, b) = (i128::from(self.numerator), i128::from(self.denominator));
        let (c, d) = (i128::from(other.numerator), i128::from(other.denominator));
        Rational::reduce(a * d + c * b, b * d)
    }

    /// The product; `None` beyond 64 bits.
    pub fn times(self, other: Rational) -> Option<Rational> {
        Rational::reduce(
            i128::from(self.numerator) * i128::from(other.numerator),
            i128::from(self.denominator) * i128::from(other.denominator),
        )
    }

    /// The negative.
    pub const fn negated(self) -> Rational {
        Rational {
            numerator: -self.numerator,
            denominator: self.denominator,
        }
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.denominator == 1 {
            write!(f, "{}", self.numerator)
        } else {
            write!(f, "{}/{}", self.numerator, self.denominator)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_whole_decimal_and_fraction() {
        assert_eq!(Rational::parse("3"), Rational::new(3, 1));
        assert_eq!(Rational::parse("-1.50"), Rational::new(-3, 2));
        assert_eq!(Rational::parse("-0.5"), Rational::new(-1, 2));
        assert_eq!(Rational::parse("10/9"), Rational::new(10, 9));
        assert_eq!(Rational::parse("20 / -18"), Rational::new(-10, 9));
    }

    #[test]
    fn refuses_what_is_no_fraction() {
        for text in ["", ".", "-", "a", "1/0", "1.2.3", "1/2/3", "1.-5", "1e3"] {
            assert_eq!(Rational::parse(text), None, "{text:?}");
        }
    }

    #[test]
    fn sums_and_products_are_in_lowest_terms() {
        let third = Rational::new(1, 3).unwrap();
        let sixth = Rational::new(1, 6).unwrap();
        assert_eq!(third.plus(sixth), Rational::new(1, 2));
        assert_eq!(third.times(sixth), Rational::new(1, 18));
        assert_eq!(third.plus(third.negated()), Some(Rational::ZERO));
        assert_eq!(Rational::new(4, -2).unwrap().to_string(), "-2");
    }

    #[test]
    fn too_large_is_none_not_a_panic() {
        let huge = Rational::integer(i64::MAX);
        assert_eq!(huge.times(huge), None);
        assert_eq!(huge.plus(huge), None);
    }
}
