//! Numbers of half precision, which some formats store.

/// A number of half precision, IEEE 754 binary16.
pub(crate) fn number(bits: u16) -> f64 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 0x1f), f64::from(bits & 0x3ff));
    let value = match exponent {
        0 => fraction * 2f64.powi(-24),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1024.0 + fraction) * 2f64.powi(exponent - 25),
    };
    if bits >> 15 == 1 { -value } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_precision_by_its_standard() {
        // Examples of IEEE 754 binary16: one, smallest subnormal, largest, minus two, infinity.
        let cases = [
            (0x3c00, 1.0),
            (0x0001, 5.960_464_477_539_063e-8),
            (0x7bff, 65504.0),
            (0xc000, -2.0),
            (0x7c00, f64::INFINITY),
        ];
        for (bits, value) in cases {
            assert_eq!(number(bits), value);
        }
        assert!(number(0x7e00).is_nan());
    }
}
