//! A number with its standard deviation.

use std::fmt;

/// A value with its standard deviation, both in the same unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// Best estimate.
    pub value: f64,
    /// Standard deviation of the estimate; not negative.
    pub deviation: f64,
}

impl Uncertain {
    /// A value with its standard deviation.
    pub fn new(value: f64, deviation: f64) -> Self {
        Self { value, deviation }
    }

    /// A value that is taken as exact.
    pub fn exact(value: f64) -> Self {
        Self {
            value,
            deviation: 0.0,
        }
    }

    /// Difference from an independent uncertain number.
    pub fn minus(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            deviation: self.deviation.hypot(other.deviation),
        }
    }

    /// Whether both parts are finite and the deviation is not negative.
    pub fn is_sound(self) -> bool {
        self.value.is_finite() && self.deviation.is_finite() && self.deviation >= 0.0
    }
}

/// Sizes between 10 to these powers are written without a power of ten.
const PLAIN: std::ops::Range<i32> = -3..6;
/// Digits behind which numbers are float noise.
const MOST_DIGITS: i32 = 12;

impl fmt::Display for Uncertain {
    /// Both to the second digit of the deviation: `0.964 ± 0.012`; very large and very small ones as `(2.31 ± 0.12)e-5`.
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let size = self.value.abs().max(self.deviation);
        if size == 0.0 || !self.is_sound() {
            return write!(out, "{} ± {}", self.value, self.deviation);
        }
        let power = |size: f64| size.log10().floor() as i32;
        let shift = if PLAIN.contains(&power(size)) {
            0
        } else {
            power(size)
        };
        let last = match self.deviation {
            0.0 => power(size) - 3,
            deviation => power(deviation) - 1,
        };
        let decimals = (shift - last).clamp(0, MOST_DIGITS) as usize;
        let scale = 10_f64.powi(shift);
        let deviation = self.deviation / scale;
        let value = format!("{:.decimals$}", self.value / scale);
        // what is rounded to nothing has no sign
        let value = match value.trim_start_matches(['-', '0', '.']) {
            "" => value.trim_start_matches('-'),
            _ => &value,
        };
        match shift {
            0 => write!(out, "{value} ± {deviation:.decimals$}"),
            _ => write!(out, "({value} ± {deviation:.decimals$})e{shift}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_are_written_to_the_second_digit_of_the_deviation() {
        for (value, deviation, text) in [
            (0.9643, 0.0122, "0.964 ± 0.012"),
            (8.964, 7.9, "9.0 ± 7.9"),
            (-12_345.6, 234.0, "-12346 ± 234"),
            (2.313e-5, 1.24e-6, "(2.31 ± 0.12)e-5"),
            (-3e-9, 4e-8, "(-0.3 ± 4.0)e-8"),
            (-3e-10, 4e-8, "(0.0 ± 4.0)e-8"),
            (-0.02, 40.0, "0 ± 40"),
            (3.2e7, 1e5, "(3.200 ± 0.010)e7"),
            (0.15, 0.0, "0.1500 ± 0.0000"),
            (0.0, 0.0, "0 ± 0"),
            (1.0, 1e-30, "1.000000000000 ± 0.000000000000"),
        ] {
            assert_eq!(Uncertain::new(value, deviation).to_string(), text);
        }
        assert_eq!(Uncertain::new(f64::NAN, 1.0).to_string(), "NaN ± 1");
    }
}
