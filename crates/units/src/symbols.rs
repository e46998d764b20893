//! The known unit symbols.

use crate::ICE_POINT;
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

/// A symbol by its power of ten and, where it is not decimal, numerator, denominator and offset.
const fn symbol(text: &'static str, dimension: Dimension, ten: i32, rest: &[f64]) -> Symbol {
    let (numerator, denominator, offset) = match *rest {
        [numerator, denominator] => (numerator, denominator, 0.0),
        [numerator, denominator, offset] => (numerator, denominator, offset),
        _ => (1.0, 1.0, 0.0),
    };
    Symbol {
        text,
        dimension,
        ten,
        numerator,
        denominator,
        offset,
    }
}

macro_rules! symbols {
    ($($dimension:expr => $($text:literal ($ten:expr $(, $rest:expr)*)),+;)+) => {
        &[$($(symbol($text, $dimension, $ten, &[$($rest),*])),+),+]
    };
}

/// 1 lbf · 1 in in 1e-17 N m: a torque, whose pound is one of force.
const INCH_POUND: f64 = 44_482_216_152_605.0 * 254.0;

/// Every symbol that is understood; one with a stroke or a dash stands alone. The US units follow the international yard and pound of 1959:
/// 1 in = 25.4 mm and 1 lbm = 0.45359237 kg exactly, 1 lbf = 1 lbm · 9.80665 m/s² (NIST SP 811, appendix B).
pub(crate) const SYMBOLS: &[Symbol] = symbols! {
    Dimension::NONE => "%" (-2);
    Dimension::LENGTH => "m" (0), "km" (3), "dm" (-1), "cm" (-2), "mm" (-3), "um" (-6), "µm" (-6),
        "μm" (-6), "nm" (-9), "in" (-4, 254.0, 1.0), "inch" (-4, 254.0, 1.0),
        "mil" (-7, 254.0, 1.0), "ft" (-4, 3048.0, 1.0);
    Dimension::MASS => "t" (3), "kg" (0), "g" (-3), "mg" (-6);
    Dimension::ACCELERATION => "gn" (-5, 980_665.0, 1.0);
    Dimension::MASS => "lbm" (-8, 45_359_237.0, 1.0);
    Dimension::TIME => "s" (0), "ms" (-3), "us" (-6), "µs" (-6), "μs" (-6), "ns" (-9),
        "min" (0, 60.0, 1.0), "h" (0, 3600.0, 1.0);
    Dimension::TEMPERATURE => "K" (0), "degC" (0, 1.0, 1.0, ICE_POINT), "°C" (0, 1.0, 1.0, ICE_POINT);
    Dimension::ANGLE => "rad" (0), "mrad" (-3), "deg" (0, PI, 180.0), "°" (0, PI, 180.0),
        "rev" (0, 2.0 * PI, 1.0);
    Dimension::ANGULAR_SPEED => "rpm" (0, PI, 30.0), "RPM" (0, PI, 30.0), "r/min" (0, PI, 30.0),
        "U/min" (0, PI, 30.0), "krpm" (3, PI, 30.0), "rps" (0, 2.0 * PI, 1.0),
        "r/s" (0, 2.0 * PI, 1.0);
    Dimension::FREQUENCY => "Hz" (0), "kHz" (3), "MHz" (6);
    Dimension::CURRENT => "A" (0), "mA" (-3);
    Dimension::VOLTAGE => "V" (0), "mV" (-3), "kV" (3);
    Dimension::RESISTANCE => "ohm" (0), "Ω" (0);
    Dimension::INDUCTANCE => "H" (0), "mH" (-3);
    Dimension::FORCE => "N" (0), "mN" (-3), "uN" (-6), "µN" (-6), "μN" (-6), "kN" (3), "MN" (6),
        "lbf" (-13, 44_482_216_152_605.0, 1.0), "ozf" (-13, 44_482_216_152_605.0, 16.0);
    Dimension::PRESSURE => "Pa" (0), "mPa" (-3), "kPa" (3), "MPa" (6), "GPa" (9), "TPa" (12),
        "bar" (5), "mbar" (2), "psi" (-5, 44_482_216_152_605.0, 64_516.0),
        "ksi" (-2, 44_482_216_152_605.0, 64_516.0);
    Dimension::TORQUE => "J" (0), "mJ" (-3), "uJ" (-6), "µJ" (-6), "μJ" (-6), "kJ" (3), "MJ" (6),
        "Nm" (0), "mNm" (-3), "Nmm" (-3), "Ncm" (-2), "kNm" (3), "in-lb" (-17, INCH_POUND, 1.0),
        "in-lbf" (-17, INCH_POUND, 1.0), "lb-in" (-17, INCH_POUND, 1.0),
        "lbf-in" (-17, INCH_POUND, 1.0), "in-oz" (-17, INCH_POUND, 16.0),
        "oz-in" (-17, INCH_POUND, 16.0), "ozf-in" (-17, INCH_POUND, 16.0),
        "ft-lb" (-17, 12.0 * INCH_POUND, 1.0), "lbf-ft" (-17, 12.0 * INCH_POUND, 1.0);
    Dimension::POWER => "W" (0), "mW" (-3), "kW" (3), "MW" (6);
    Dimension::KINEMATIC_VISCOSITY => "St" (-4), "cSt" (-6);
    Dimension::of([-1, 1, -1, 0, 0]) => "P" (-1), "cP" (-3);
};

/// The symbol with this text.
pub(crate) fn find(text: &str) -> Option<&'static Symbol> {
    SYMBOLS.iter().find(|symbol| symbol.text == text)
}
