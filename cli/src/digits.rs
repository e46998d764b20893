//! Numbers for people.

use auxbear::units::number_text;

/// A number to four digits.
pub fn four_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    // A count is a whole number and keeps all its digits.
    if value == value.trunc() && value.abs() < 1e9 {
        return format!("{value}");
    }
    number_text(rounded)
}
