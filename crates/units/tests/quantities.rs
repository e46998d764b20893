//! Reading, converting and printing, against factors from elsewhere.

use proptest::prelude::*;
use units::{Dimension, ParseError, Quantity, Rational, Unit, display, parse_quantity};

fn si(text: &str) -> f64 {
    match parse_quantity(text) {
        Ok(quantity) => quantity.value_si,
        Err(error) => panic!("{text}: {error}"),
    }
}

fn message(text: &str) -> String {
    parse_quantity(text).unwrap_err().to_string()
}

fn dimension(text: &str) -> Dimension {
    parse_quantity(text).unwrap().dimension
}

#[test]
fn decimal_units_are_exact() {
    assert_eq!(si("25 mm"), 0.025);
    assert_eq!(si("0.25 mm"), 0.00025);
    assert_eq!(si("0.1 mm"), 0.0001);
    assert_eq!(si("2.5 us"), 2.5e-6);
    assert_eq!(si("2.5 µs"), 2.5e-6);
    assert_eq!(si("2.5 μs"), 2.5e-6);
    assert_eq!(si("4200 MPa"), 4.2e9);
    assert_eq!(si("20 mPa s"), 0.02);
    assert_eq!(si("20 mPa·s"), 0.02);
    assert_eq!(si("206 GPa"), 2.06e11);
    assert_eq!(si("40 g mm"), 4e-5);
    assert_eq!(si("100 mm^2/s"), 1e-4);
    assert_eq!(si("100 cSt"), 1e-4);
    assert_eq!(si("15 %"), 0.15);
    assert_eq!(si("1e-3 mm"), 1e-6);
    assert_eq!(si("25mm"), 0.025);
    assert_eq!(si("  25   mm  "), 0.025);
    assert_eq!(si("+.5 m"), 0.5);
    assert_eq!(si("5. m"), 5.0);
    assert_eq!(si("1e-9 N m s"), 1e-9);
    assert_eq!(si("450 N mm"), 0.45);
    assert_eq!(si("0.15 kg/dm^3"), 150.0);
}

#[test]
fn powers_and_products_have_the_dimension_they_say() {
    let n = Rational::new(10, 9).unwrap();
    assert_eq!(
        parse_quantity("5e8 N/m^(10/9)").unwrap(),
        Quantity {
            value_si: 5e8,
            dimension: Dimension::force_per_length_power(n).unwrap()
        }
    );
    assert_eq!(dimension("2.5e10 N/m^1.5").si_unit(), "N/m^(3/2)");
    assert_eq!(dimension("1 kg m^2"), Dimension::INERTIA);
    assert_eq!(dimension("1 kg·m²"), Dimension::INERTIA);
    assert_eq!(dimension("1 kg*m^2"), Dimension::INERTIA);
    assert_eq!(dimension("1 N m s^2"), Dimension::INERTIA);
    assert_eq!(dimension("1 m s⁻²"), Dimension::ACCELERATION);
    assert_eq!(dimension("0.5 s/m"), Dimension::INVERSE_SPEED);
    assert_eq!(dimension("1 N s/m"), Dimension::DAMPING);
    assert_eq!(dimension("1 kg/s"), Dimension::DAMPING);
    assert_eq!(dimension("1 N m"), dimension("1 J"));
    assert_eq!(dimension("1 N m s"), Dimension::ROTATIONAL_DRAG);
    assert_eq!(dimension("1 W/(m K)").si_unit(), "W/(m K)");
    // without a name of its own
    assert_eq!(dimension("1 W/(m^2 K)").si_unit(), "kg/(s^3 K)");
    assert_eq!(dimension("1 1/s"), Dimension::FREQUENCY);
}

#[test]
fn angle_is_a_dimension_of_its_own() {
    assert_eq!(dimension("12000 rpm"), Dimension::ANGULAR_SPEED);
    assert_eq!(dimension("1 rad/s"), Dimension::ANGULAR_SPEED);
    assert_eq!(dimension("1 rev/min"), Dimension::ANGULAR_SPEED);
    assert_ne!(dimension("1 Hz"), Dimension::ANGULAR_SPEED);
    assert_ne!(dimension("1 rad"), Dimension::NONE);
    assert_eq!(dimension("1 Hz").name(), Some("frequency"));
}

/// Published factors; each is within half a unit of its last printed digit.
#[test]
fn factors_of_other_units_are_those_of_the_tables() {
    let table = [
        // NIST SP 811 (2008), appendix B.8.
        ("1 in", 2.54e-2, 1e-15),
        ("1 ft", 3.048e-1, 1e-15),
        ("1 lbm", 4.535_923_7e-1, 1e-15),
        ("1 lbf", 4.448_222, 2e-7),
        ("1 psi", 6.894_757e3, 1e-7),
        ("1 lbf/in", 1.751_268e2, 3e-7),
        ("1 lbm ft^2", 4.214_011e-2, 2e-7),
        ("1 rpm", 1.047_198e-1, 5e-7),
        ("1 gn", 9.806_65, 1e-15),
        ("1 deg", 1.745_329e-2, 3e-7),
        ("1 cP", 1e-3, 0.0),
        // 1 N/mm^1.5 = 10^4.5 N/m^1.5.
        ("1 N/mm^1.5", 31_622.776_601_683_79, 1e-15),
    ];
    for (text, expected, tolerance) in table {
        let relative = (si(text) / expected - 1.0).abs();
        assert!(relative <= tolerance, "{text}: {} {relative:e}", si(text));
    }
    // 12 000 rpm = 400 π rad/s; one rounding of π and one of the product.
    assert_eq!(si("12000 rpm"), 400.0 * std::f64::consts::PI);
    assert_eq!(si("-90 deg"), -std::f64::consts::FRAC_PI_2);
    assert_eq!(si("−90 deg"), si("-90 deg"));
    assert_eq!(si("1 rev"), 2.0 * std::f64::consts::PI);
    assert_eq!(si("1 min"), 60.0);
}

#[test]
fn celsius_is_absolute_and_stands_alone() {
    assert_eq!(si("20 degC"), 293.15);
    assert_eq!(si("-273.15 °C"), 0.0);
    assert_eq!(si("20 K"), 20.0);
    assert_eq!(display(293.15, "degC").unwrap(), "20 degC");
    assert_eq!(
        message("1 W/degC"),
        "degC inside the unit \"W/degC\"; in a product a temperature is in K"
    );
    assert_eq!(
        message("1 degC^2"),
        "degC inside the unit \"degC^2\"; in a product a temperature is in K"
    );
    assert_eq!(
        message("1 m degC"),
        "degC inside the unit \"m degC\"; in a product a temperature is in K"
    );
}

#[test]
fn each_mistake_has_its_message() {
    assert_eq!(message(""), "an empty text");
    assert_eq!(message("mm"), "no number at the start of \"mm\"");
    assert_eq!(
        message("about 3 mm"),
        "no number at the start of \"about 3 mm\""
    );
    assert_eq!(message("8"), "the number 8 without a unit");
    assert_eq!(message("-8.5e3 "), "the number -8.5e3 without a unit");
    assert_eq!(
        message("3 Mpa"),
        "the unknown unit \"Mpa\"; did you mean \"MPa\"?"
    );
    assert_eq!(
        message("3 mPa"),
        "the unknown unit \"mPa\"; did you mean \"MPa\"?"
    );
    assert_eq!(
        message("3 Rpm"),
        "the unknown unit \"Rpm\"; did you mean \"RPM\"?"
    );
    assert_eq!(message("3 furlongs"), "the unknown unit \"furlongs\"");
    assert_eq!(
        message("0,25 mm"),
        "a comma in \"0,25 mm\"; decimals are written with a point and thousands without a mark"
    );
    assert_eq!(
        message("nan mm"),
        "\"nan mm\", which is not a finite number"
    );
    assert_eq!(
        message("-inf m"),
        "\"-inf m\", which is not a finite number"
    );
    assert_eq!(
        message("1e400 m"),
        "\"1e400 m\", which is too large or too small to compute with"
    );
    assert_eq!(
        message("1e-400 m"),
        "\"1e-400 m\", which is too large or too small to compute with"
    );
    assert_eq!(
        message("25 mm # long"),
        "\"# long\" after the quantity, which is not understood"
    );
    assert_eq!(
        message("25 26 mm"),
        "\"26 mm\" after the quantity, which is not understood"
    );
    assert_eq!(
        message("1 W/m K"),
        "the unit \"W/m K\", which can be read in two ways; put what follows the one \"/\" in brackets, as in W/(m K)"
    );
    assert_eq!(
        message("1 m/s/s"),
        "the unit \"m/s/s\", which can be read in two ways; put what follows the one \"/\" in brackets, as in W/(m K)"
    );
    assert_eq!(
        message("1 kg m2"),
        "a power that cannot be read in \"kg m2\"; powers are written m^2, m^1.5 or m^(10/9)"
    );
    assert!(matches!(
        parse_quantity("1 m^(1/0)"),
        Err(ParseError::BadExponent { .. })
    ));
    assert!(matches!(
        parse_quantity("1 m^999999999999"),
        Err(ParseError::BadExponent { .. })
    ));
    assert!(matches!(
        parse_quantity("1 (m"),
        Err(ParseError::TrailingText { .. })
    ));
    assert!(matches!(
        parse_quantity("1 m)"),
        Err(ParseError::TrailingText { .. })
    ));
    assert!(parse_quantity(&format!("1 {}m", "(".repeat(100_000))).is_err());
}

#[test]
fn printing_uses_few_digits() {
    assert_eq!(display(0.00025, "mm").unwrap(), "0.25 mm");
    assert_eq!(display(si("12000 rpm"), "rpm").unwrap(), "12000 rpm");
    assert_eq!(
        display(-std::f64::consts::FRAC_PI_2, "deg").unwrap(),
        "-90 deg"
    );
    assert_eq!(display(4.2e9, "MPa").unwrap(), "4200 MPa");
    assert_eq!(display(0.0, "m").unwrap(), "0 m");
    assert_eq!(display(1e-10, "m").unwrap(), "1e-10 m");
    assert_eq!(display(2.5e10, "N/m^1.5").unwrap(), "2.5e10 N/m^1.5");
    assert_eq!(display(f64::NAN, "m").unwrap(), "NaN m");
    assert_eq!(
        parse_quantity("5e8 N/m^(10/9)").unwrap().to_string(),
        "5e8 N/m^(10/9)"
    );
    assert!(display(1.0, "furlong").is_err());
}

proptest! {
    #[test]
    fn si_text_reads_back_bit_for_bit(bits: u64, exponents in prop::array::uniform6(-4_i64..=4), divisor in 1_i64..=9) {
        let value = f64::from_bits(bits);
        prop_assume!(value.is_finite());
        let part = |i: usize| Rational::new(exponents[i], divisor).unwrap();
        let quantity = Quantity {
            value_si: value,
            dimension: Dimension::from_exponents([part(0), part(1), part(2), part(3), part(4), part(5)]),
        };
        let back = parse_quantity(&quantity.to_string());
        prop_assert_eq!(back.clone().map(|b| b.value_si.to_bits()), Ok(bits), "{}", quantity);
        prop_assert_eq!(back.map(|b| b.dimension), Ok(quantity.dimension));
    }

    #[test]
    fn decimal_units_read_back_bit_for_bit(value in -1e30_f64..1e30, unit in prop::sample::select(vec!["mm", "um", "MPa", "g mm", "mm^2/s", "kN/mm", "%"])) {
        let text = display(value, unit).unwrap();
        prop_assert_eq!(parse_quantity(&text).unwrap().value_si.to_bits(), value.to_bits(), "{}", text);
    }

    /// One rounding each of product, quotient and printed digits: three units in the last place at most.
    #[test]
    fn other_units_read_back_within_rounding(value in -1e9_f64..1e9, unit in prop::sample::select(vec!["rpm", "deg", "in", "ft", "psi", "lbf/in", "min"])) {
        let text = display(value, unit).unwrap();
        let back = parse_quantity(&text).unwrap().value_si;
        prop_assert!((back - value).abs() <= 3.0 * f64::EPSILON * value.abs(), "{} {} {}", text, back, value);
    }

    /// What a person writes in another unit is printed again as it was written.
    #[test]
    fn short_numbers_print_as_written(count in 1_u32..100_000, unit in prop::sample::select(vec!["rpm", "deg", "in", "psi", "mm", "degC"])) {
        let text = format!("{count} {unit}");
        prop_assert_eq!(display(si(&text), unit).unwrap(), text);
    }

    #[test]
    fn no_text_panics(text in "\\PC{0,24}") {
        let _ = parse_quantity(&text);
        let _ = Unit::parse(&text);
    }

    #[test]
    fn no_unit_like_text_panics(text in "[-+.0-9eE]{0,6} ?[mNs/()^*. 0-9%°²⁻]{0,12}") {
        let _ = parse_quantity(&text);
    }
}

/// 1 in = 25.4 mm, 1 lbf = 4.4482216152605 N; a turn is 2π rad.
#[test]
fn units_of_workshops_are_read() {
    let turn = 2.0 * std::f64::consts::PI;
    for (text, value) in [
        ("1 inch", 0.0254),
        ("1 mil", 25.4e-6),
        ("60 r/min", turn),
        ("60 U/min", turn),
        ("60 RPM", turn),
        ("1 rps", turn),
        ("1 r/s", turn),
        ("100 Ncm", 1.0),
        ("1 kNm", 1000.0),
        ("1 in-lb", 0.112_984_829_027_616_7),
        ("1 lbf-in", 0.112_984_829_027_616_7),
        ("1 lbf in", 0.112_984_829_027_616_7),
        ("16 oz-in", 0.112_984_829_027_616_7),
        ("1 ozf in", 0.007_061_551_814_226_044),
        ("1 ft-lb", 1.355_817_948_331_400_4),
    ] {
        let read = si(text);
        assert!(
            (read / value - 1.0).abs() < 4.0 * f64::EPSILON,
            "{text}: {read} {value}"
        );
    }
    assert!(parse_quantity("1 in-kg").is_err());
}
