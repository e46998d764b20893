//! Units as measurement files write them.

use units::Unit;

/// The size in SI of a unit as files write it, where it has the dimension of that SI unit.
pub fn si_factor(text: &str, si: &str) -> Option<f64> {
    unit_of(text, si).map(|unit| unit.to_si(1.0))
}

/// A unit as files write it, where it has the dimension of that SI unit.
pub fn unit_of(text: &str, si: &str) -> Option<Unit> {
    const SPELLINGS: &[(&str, &str)] = &[
        ("sec", "s"),
        ("m/s2", "m/s^2"),
        ("m/s²", "m/s^2"),
        ("m/sec2", "m/s^2"),
        ("°C", "degC"),
        ("deg C", "degC"),
        ("C", "degC"),
    ];
    let plain = text.trim().replace(['·', '*', '.'], " ");
    let plain = SPELLINGS
        .iter()
        .find(|row| row.0 == plain)
        .map_or(plain.as_str(), |row| row.1);
    let (unit, wanted) = (Unit::parse(plain).ok()?, Unit::parse(si).ok()?);
    (unit.dimension() == wanted.dimension()).then_some(unit)
}

/// The size in rad/s of a unit of turning as files write it: of a speed, or of turns in a time.
pub fn speed_factor(text: &str) -> Option<f64> {
    const PER_MINUTE: &[&str] = &[
        "rpm", "1/min", "U/min", "r/min", "rev/min", "min-1", "min^-1", "min⁻¹", "upm",
    ];
    let plain = text.trim();
    if PER_MINUTE
        .iter()
        .any(|known| plain.eq_ignore_ascii_case(known))
    {
        return Some(std::f64::consts::PI / 30.0);
    }
    let turns = || si_factor(plain, "1/s").map(|turns| std::f64::consts::TAU * turns);
    si_factor(plain, "rad/s").or_else(turns)
}

/// The unit of SI in which a vibration is given, and the factor to it; "1" where the file's unit is none of a vibration.
pub fn unit_in_si(text: &str) -> (&'static str, f64) {
    ["m/s^2", "m/s", "m"]
        .into_iter()
        .find_map(|unit| Some((unit, si_factor(text, unit)?)))
        .unwrap_or(("1", 1.0))
}

/// The name of the quantity, where a unit is of one in which nothing is seen to pass: a temperature, a time, a speed of rotation.
/// What it does not know, such as V, may be any sensor's.
pub fn no_signal(text: &str) -> Option<&'static str> {
    [
        ("K", "temperature"),
        ("s", "time"),
        ("1/s", "frequency"),
        ("rad/s", "speed of rotation"),
        ("rad/s^2", "angular acceleration"),
        ("N m", "torque"),
        ("kg", "mass"),
        ("W", "power"),
    ]
    .into_iter()
    .find_map(|(unit, quantity)| unit_of(text, unit).map(|_| quantity))
}

#[cfg(test)]
mod tests {
    use super::{no_signal, si_factor, speed_factor};

    #[test]
    fn units_of_files_are_understood_as_labs_write_them() {
        for text in ["N m", "Nm", "N·m", "N*m"] {
            assert_eq!(si_factor(text, "N m"), Some(1.0), "{text}");
        }
        assert_eq!(si_factor("Nmm", "N m"), Some(1e-3));
        assert_eq!(si_factor("m/s2", "m/s^2"), Some(1.0));
        assert_eq!(si_factor("N", "N m"), None);
        assert_eq!(si_factor("", "N m"), None);
        assert_eq!(si_factor("ms", "s"), Some(1e-3));
    }

    #[test]
    fn speeds_are_read_in_the_units_of_drives() {
        let rpm = std::f64::consts::PI / 30.0;
        for text in ["rpm", "RPM", "1/min", "U/min", "min-1", " r/min "] {
            assert_eq!(speed_factor(text), Some(rpm), "{text}");
        }
        assert_eq!(speed_factor("rad/s"), Some(1.0));
        assert_eq!(speed_factor("Hz"), Some(60.0 * rpm));
        assert_eq!(speed_factor("V"), None);
        assert_eq!(speed_factor(""), None);
    }

    #[test]
    fn signals_of_sensors_are_told_from_other_quantities() {
        for text in ["", "V", "mV", "1", "m/s^2", "um", "N", "Pa", "counts"] {
            assert_eq!(no_signal(text), None, "{text}");
        }
        assert_eq!(no_signal("K"), Some("temperature"));
        assert_eq!(no_signal("°C"), Some("temperature"));
        assert_eq!(no_signal("rpm"), Some("speed of rotation"));
        assert_eq!(no_signal("Nm"), Some("torque"));
    }
}
