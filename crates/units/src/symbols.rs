//! The known unit symbols.

use crate::dimension::Dimension;
use std::f64::consts::PI;

/// One unit symbol: one of it is `10^ten · numerator / denominator` SI units.
///
/// The power of ten is kept apart so that decimal units convert without rounding.
pub(crate) struct Symbol {
    pub(crate) text: &'static str,
    pub(crate) dimension: Dimension,
    pub(crate) ten: i32,
    pub(crate) numerator: f64,
    pub(crate) denominator: f64,
    /// Kelvin at the zero of the scale; zero but for absolute temperatures.
    pub(crate) offset: f64,
}

const fn decimal(text: &'static str, dimension: Dimension, ten: i32) -> Symbol {
    ratio(text, dimension, ten, 1.0, 1.0)
}

const fn ratio(
    text: &'static str,
    dimension: Dimension,
    ten: i32,
    numerator: f64,
    denominator: f64,
) -> Symbol {
    Symbol {
        text,
        dimension,
        ten,
        numerator,
        denominator,
        offset: 0.0,
    }
}

const fn celsius(text: &'static str) -> Symbol {
    Symbol {
        offset: 273.15,
        ..decimal(text, Dimension::TEMPERATURE, 0)
    }
}

/// 1 lbf · 1 in in 1e-17 N m: a torque, whose pound is one of force.
const INCH_POUND: f64 = 44_482_216_152_605.0 * 254.0;

/// Every symbol that is understood; one with a stroke or a dash stands alone. The US units follow the international yard and pound of 1959:
/// 1 in = 25.4 mm and 1 lbm = 0.45359237 kg exactly, 1 lbf = 1 lbm · 9.80665 m/s² (NIST SP 811, appendix B).
pub(crate) const SYMBOLS: &[Symbol] = &[
    decimal("%", Dimension::NONE, -2),
    decimal("m", Dimension::LENGTH, 0),
    decimal("km", Dimension::LENGTH, 3),
    decimal("dm", Dimension::LENGTH, -1),
    decimal("cm", Dimension::LENGTH, -2),
    decimal("mm", Dimension::LENGTH, -3),
    decimal("um", Dimension::LENGTH, -6),
    decimal("µm", Dimension::LENGTH, -6),
    decimal("μm", Dimension::LENGTH, -6),
    decimal("nm", Dimension::LENGTH, -9),
    ratio("in", Dimension::LENGTH, -4, 254.0, 1.0),
    ratio("inch", Dimension::LENGTH, -4, 254.0, 1.0),
    ratio("mil", Dimension::LENGTH, -7, 254.0, 1.0),
    ratio("ft", Dimension::LENGTH, -4, 3048.0, 1.0),
    decimal("t", Dimension::MASS, 3),
    decimal("kg", Dimension::MASS, 0),
    decimal("g", Dimension::MASS, -3),
    decimal("mg", Dimension::MASS, -6),
    ratio("gn", Dimension::ACCELERATION, -5, 980_665.0, 1.0),
    ratio("lbm", Dimension::MASS, -8, 45_359_237.0, 1.0),
    decimal("s", Dimension::TIME, 0),
    decimal("ms", Dimension::TIME, -3),
    decimal("us", Dimension::TIME, -6),
    decimal("µs", Dimension::TIME, -6),
    decimal("μs", Dimension::TIME, -6),
    decimal("ns", Dimension::TIME, -9),
    ratio("min", Dimension::TIME, 0, 60.0, 1.0),
    ratio("h", Dimension::TIME, 0, 3600.0, 1.0),
    decimal("K", Dimension::TEMPERATURE, 0),
    celsius("degC"),
    celsius("°C"),
    decimal("rad", Dimension::ANGLE, 0),
    decimal("mrad", Dimension::ANGLE, -3),
    ratio("deg", Dimension::ANGLE, 0, PI, 180.0),
    ratio("°", Dimension::ANGLE, 0, PI, 180.0),
    ratio("rev", Dimension::ANGLE, 0, 2.0 * PI, 1.0),
    ratio("rpm", Dimension::ANGULAR_SPEED, 0, PI, 30.0),
    ratio("RPM", Dimension::ANGULAR_SPEED, 0, PI, 30.0),
    ratio("r/min", Dimension::ANGULAR_SPEED, 0, PI, 30.0),
    ratio("U/min", Dimension::ANGULAR_SPEED, 0, PI, 30.0),
    ratio("krpm", Dimension::ANGULAR_SPEED, 3, PI, 30.0),
    ratio("rps", Dimension::ANGULAR_SPEED, 0, 2.0 * PI, 1.0),
    ratio("r/s", Dimension::ANGULAR_SPEED, 0, 2.0 * PI, 1.0),
    decimal("Hz", Dimension::FREQUENCY, 0),
    decimal("kHz", Dimension::FREQUENCY, 3),
    decimal("MHz", Dimension::FREQUENCY, 6),
    decimal("A", Dimension::CURRENT, 0),
    decimal("mA", Dimension::CURRENT, -3),
    decimal("V", Dimension::VOLTAGE, 0),
    decimal("mV", Dimension::VOLTAGE, -3),
    decimal("kV", Dimension::VOLTAGE, 3),
    decimal("ohm", Dimension::RESISTANCE, 0),
    decimal("Ω", Dimension::RESISTANCE, 0),
    decimal("H", Dimension::INDUCTANCE, 0),
    decimal("mH", Dimension::INDUCTANCE, -3),
    decimal("N", Dimension::FORCE, 0),
    decimal("mN", Dimension::FORCE, -3),
    decimal("uN", Dimension::FORCE, -6),
    decimal("µN", Dimension::FORCE, -6),
    decimal("μN", Dimension::FORCE, -6),
    decimal("kN", Dimension::FORCE, 3),
    decimal("MN", Dimension::FORCE, 6),
    ratio("lbf", Dimension::FORCE, -13, 44_482_216_152_605.0, 1.0),
    ratio("ozf", Dimension::FORCE, -13, 44_482_216_152_605.0, 16.0),
    decimal("Pa", Dimension::PRESSURE, 0),
    decimal("mPa", Dimension::PRESSURE, -3), // before a second alone
    decimal("kPa", Dimension::PRESSURE, 3),
    decimal("MPa", Dimension::PRESSURE, 6),
    decimal("GPa", Dimension::PRESSURE, 9),
    decimal("TPa", Dimension::PRESSURE, 12),
    decimal("bar", Dimension::PRESSURE, 5),
    decimal("mbar", Dimension::PRESSURE, 2),
    ratio(
        "psi",
        Dimension::PRESSURE,
        -5,
        44_482_216_152_605.0,
        64_516.0,
    ),
    ratio(
        "ksi",
        Dimension::PRESSURE,
        -2,
        44_482_216_152_605.0,
        64_516.0,
    ),
    decimal("J", Dimension::TORQUE, 0),
    decimal("mJ", Dimension::TORQUE, -3),
    decimal("uJ", Dimension::TORQUE, -6),
    decimal("µJ", Dimension::TORQUE, -6),
    decimal("μJ", Dimension::TORQUE, -6),
    decimal("kJ", Dimension::TORQUE, 3),
    decimal("MJ", Dimension::TORQUE, 6),
    decimal("Nm", Dimension::TORQUE, 0),
    decimal("mNm", Dimension::TORQUE, -3),
    decimal("Nmm", Dimension::TORQUE, -3),
    decimal("Ncm", Dimension::TORQUE, -2),
    decimal("kNm", Dimension::TORQUE, 3),
    ratio("in-lb", Dimension::TORQUE, -17, INCH_POUND, 1.0),
    ratio("in-lbf", Dimension::TORQUE, -17, INCH_POUND, 1.0),
    ratio("lb-in", Dimension::TORQUE, -17, INCH_POUND, 1.0),
    ratio("lbf-in", Dimension::TORQUE, -17, INCH_POUND, 1.0),
    ratio("in-oz", Dimension::TORQUE, -17, INCH_POUND, 16.0),
    ratio("oz-in", Dimension::TORQUE, -17, INCH_POUND, 16.0),
    ratio("ozf-in", Dimension::TORQUE, -17, INCH_POUND, 16.0),
    ratio("ft-lb", Dimension::TORQUE, -17, 12.0 * INCH_POUND, 1.0),
    ratio("lbf-ft", Dimension::TORQUE, -17, 12.0 * INCH_POUND, 1.0),
    decimal("W", Dimension::POWER, 0),
    decimal("mW", Dimension::POWER, -3),
    decimal("kW", Dimension::POWER, 3),
    decimal("MW", Dimension::POWER, 6),
    decimal("St", Dimension::KINEMATIC_VISCOSITY, -4),
    decimal("cSt", Dimension::KINEMATIC_VISCOSITY, -6),
    ratio("gn", Dimension::ACCELERATION, -5, 980_665.0, 1.0),
    decimal("P", Dimension::of([-1, 1, -1, 0, 0]), -1),
    decimal("cP", Dimension::of([-1, 1, -1, 0, 0]), -3),
];

/// The symbol with this text.
pub(crate) fn find(text: &str) -> Option<&'static Symbol> {
    SYMBOLS.iter().find(|symbol| symbol.text == text)
}
