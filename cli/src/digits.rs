//! Numbers for people.

use auxbear::units::{ICE_POINT, number_text};

/// Units for people: SI unit, then units from large to small with their value in SI.
const UNITS: &[(&str, &[(&str, f64)])] = &[
    ("s", &[("s", 1.0), ("ms", 1e-3), ("µs", 1e-6), ("ns", 1e-9)]),
    ("m", &[("m", 1.0), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9)]),
    ("N", &[("kN", 1e3), ("N", 1.0), ("mN", 1e-3), ("µN", 1e-6)]),
    (
        "Pa",
        &[("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3), ("Pa", 1.0)],
    ),
    ("N m", &[("N m", 1.0), ("N mm", 1e-3)]),
    ("J", &[("kJ", 1e3), ("J", 1.0), ("mJ", 1e-3), ("µJ", 1e-6)]),
];

/// A number to four digits.
pub fn four_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    // A count is a whole number and keeps all its digits.
    if value == value.trunc() && value.abs() < 1e9 {
        return format!("{value}");
    }
    number_text(rounded)
}

/// Size in SI below which nothing that is printed here differs from zero.
const ROUNDED_AWAY: f64 = 1e-15;

/// A value with four digits in the unit that keeps it between 1 and 1000, where there is one.
pub fn readable(si: f64, unit: &str) -> String {
    // of a quantity with a unit so little is what rounding left
    let si = match unit {
        "" | "1" => si,
        _ if si.abs() < ROUNDED_AWAY => 0.0,
        _ => si,
    };
    let units = UNITS.iter().find(|(known, _)| *known == unit);
    let units = units.map_or(&[][..], |(_, units)| units);
    let fitting = units.iter().find(|(_, size)| si.abs() >= *size);
    let (unit, size) = match fitting.or(units.last()) {
        Some((unit, size)) if si != 0.0 => (*unit, *size),
        _ => (unit, 1.0),
    };
    let number = four_digits(si / size);
    match unit {
        "" | "1" => number,
        unit => format!("{number} {unit}"),
    }
}

/// A value of a result of this name: a temperature, which no rise of one is, in °C.
pub fn of_result(name: &str, si: f64, unit: &str) -> String {
    match name.ends_with("_temperature") {
        true => format!("{:.1} °C", si - ICE_POINT),
        false => readable(si, unit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_printed_in_the_unit_that_fits() {
        for (si, unit, text) in [
            (7.139_21e-3, "s", "7.139 ms"),
            (675.498, "N", "675.5 N"),
            (13_450.0, "N", "13.45 kN"),
            (3.2e9, "Pa", "3.2 GPa"),
            (-2.5e-4, "m", "-250 µm"),
            (0.0, "m", "0 m"),
            (7.767e-26, "rad/s", "0 rad/s"),
            (2e-14, "1", "2e-14"),
            (12.0, "", "12"),
            (123_456.0, "", "123456"),
            (3.21e-8, "1", "3.21e-8"),
            (1256.64, "rad/s", "1257 rad/s"),
        ] {
            assert_eq!(readable(si, unit), text);
        }
    }
}
