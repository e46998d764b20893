//! Numbers out of their bytes, in both orders.

/// The bits of a whole number of up to eight bytes, with the highest byte first if `big`.
pub(crate) fn bits(bytes: &[u8], big: bool) -> u64 {
    let next = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
    match big {
        true => bytes.iter().fold(0, next),
        false => bytes.iter().rev().fold(0, next),
    }
}

/// The whole number with a sign that bits of 1 to 8 bytes are.
pub(crate) fn signed(bits: u64, size: usize) -> i64 {
    let unused = 64 - 8 * size as u32;
    (bits << unused) as i64 >> unused
}

/// The floating-point number that bits of 2, 4 or 8 bytes are.
pub(crate) fn float(bits: u64, size: usize) -> f64 {
    match size {
        2 => half(bits as u16),
        4 => f64::from(f32::from_bits(bits as u32)),
        _ => f64::from_bits(bits),
    }
}

/// A number of half precision, IEEE 754 binary16.
pub(crate) fn half(bits: u16) -> f64 {
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
            assert_eq!(half(bits), value);
        }
        assert!(half(0x7e00).is_nan());
    }
}
