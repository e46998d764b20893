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
        2 => half::f16::from_bits(bits as u16).to_f64(),
        4 => f64::from(f32::from_bits(bits as u32)),
        _ => f64::from_bits(bits),
    }
}
