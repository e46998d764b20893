//! Dimensions: exponents of length, mass, time, temperature, angle and electric current.

use crate::rational::Rational;
use std::fmt;

/// Exponents of length, mass, time, temperature, angle and electric current.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dimension {
    exponents: [Rational; 6],
}

/// SI symbols of the base dimensions, in the order of the exponents.
const BASE: [&str; 6] = ["m", "kg", "s", "K", "rad", "A"];

/// Dimensions with a name and a preferred SI unit; exponents of length, mass, time, temperature, angle.
const NAMED: [([i64; 5], &str, &str); 37] = [
    ([0, 0, 0, 0, 0], "dimensionless number", "1"),
    ([1, 0, 0, 0, 0], "length", "m"),
    ([0, 1, 0, 0, 0], "mass", "kg"),
    ([0, 0, 1, 0, 0], "time", "s"),
    ([0, 0, 0, 1, 0], "temperature", "K"),
    ([0, 0, 0, 0, 1], "angle", "rad"),
    ([0, 0, -1, 0, 1], "angular speed", "rad/s"),
    ([0, 0, -2, 0, 1], "angular acceleration", "rad/s^2"),
    ([0, 0, -1, 0, 0], "frequency", "1/s"),
    ([1, 0, -1, 0, 0], "speed", "m/s"),
    ([1, 0, -2, 0, 0], "acceleration", "m/s^2"),
    ([-1, 0, 1, 0, 0], "inverse speed", "s/m"),
    ([-1, 0, 0, 0, 0], "curvature", "1/m"),
    ([2, 0, 0, 0, 0], "area", "m^2"),
    ([3, 0, 0, 0, 0], "volume", "m^3"),
    ([-3, 1, 0, 0, 0], "density", "kg/m^3"),
    ([1, 1, 0, 0, 0], "unbalance", "kg m"),
    ([2, 1, 0, 0, 0], "moment of inertia", "kg m^2"),
    ([1, 1, -2, 0, 0], "force", "N"),
    ([-1, 1, -2, 0, 0], "pressure", "Pa"),
    ([2, 1, -2, 0, 0], "torque or energy", "N m"),
    ([2, 1, -3, 0, 0], "power", "W"),
    ([0, 1, -2, 0, 0], "stiffness", "N/m"),
    ([0, 1, -1, 0, 0], "damping", "N s/m"),
    ([2, 1, -1, 0, 0], "rotational drag", "N m s"),
    ([2, 1, -2, 0, -1], "rotational stiffness", "N m/rad"),
    ([2, 1, -1, 0, -1], "rotational damping", "N m s/rad"),
    ([2, 0, -1, 0, 0], "kinematic viscosity", "m^2/s"),
    ([-1, 1, -1, 0, 0], "dynamic viscosity", "Pa s"),
    ([1, 1, -3, -1, 0], "thermal conductivity", "W/(m K)"),
    ([2, 1, -3, -1, 0], "thermal conductance", "W/K"),
    ([2, 1, -2, -1, 0], "heat capacity", "J/K"),
    ([2, 0, -2, -1, 0], "specific heat", "J/(kg K)"),
    ([1, -1, 2, 0, 0], "wear coefficient", "m^2/N"),
    ([0, 0, 0, -1, 0], "temperature coefficient", "1/K"),
    ([0, 0, 2, 0, 0], "time squared", "s^2"),
    ([0, 0, -2, 0, 0], "inverse time squared", "1/s^2"),
];

/// The same of electric quantities; the last exponent is of electric current.
const ELECTRIC: [([i64; 6], &str, &str); 7] = [
    ([0, 0, 0, 0, 0, 1], "electric current", "A"),
    ([2, 1, -3, 0, 0, -1], "voltage", "V"),
    ([2, 1, -3, 0, 0, -2], "resistance", "ohm"),
    ([2, 1, -2, 0, 0, -2], "inductance", "H"),
    ([1, 1, -2, 0, 0, -1], "force over current", "N/A"),
    ([-1, 0, 0, 0, 0, 1], "current over displacement", "A/m"),
    ([-1, 0, 1, 0, 0, 1], "current over velocity", "A s/m"),
];

impl Dimension {
    /// A bare number.
    pub const NONE: Dimension = Dimension::of([0, 0, 0, 0, 0]);
    /// Length, m.
    pub const LENGTH: Dimension = Dimension::of([1, 0, 0, 0, 0]);
    /// Mass, kg.
    pub const MASS: Dimension = Dimension::of([0, 1, 0, 0, 0]);
    /// Time, s.
    pub const TIME: Dimension = Dimension::of([0, 0, 1, 0, 0]);
    /// Temperature, K.
    pub const TEMPERATURE: Dimension = Dimension::of([0, 0, 0, 1, 0]);
    /// Angle, rad.
    pub const ANGLE: Dimension = Dimension::of([0, 0, 0, 0, 1]);
    /// Angular speed, rad/s.
    pub const ANGULAR_SPEED: Dimension = Dimension::of([0, 0, -1, 0, 1]);
    /// Frequency, 1/s: cycles or events per time, no angle.
    pub const FREQUENCY: Dimension = Dimension::of([0, 0, -1, 0, 0]);
    /// Speed, m/s.
    pub const SPEED: Dimension = Dimension::of([1, 0, -1, 0, 0]);
    /// Acceleration, m/s^2.
    pub const ACCELERATION: Dimension = Dimension::of([1, 0, -2, 0, 0]);
    /// Inverse speed, s/m: damping of a Hunt-Crossley contact.
    pub const INVERSE_SPEED: Dimension = Dimension::of([-1, 0, 1, 0, 0]);
    /// Moment of inertia, kg m^2.
    pub const INERTIA: Dimension = Dimension::of([2, 1, 0, 0, 0]);
    /// Force, N.
    pub const FORCE: Dimension = Dimension::of([1, 1, -2, 0, 0]);
    /// Pressure or stress, Pa.
    pub const PRESSURE: Dimension = Dimension::of([-1, 1, -2, 0, 0]);
    /// Torque, N m, and energy, J: the same dimension.
    pub const TORQUE: Dimension = Dimension::of([2, 1, -2, 0, 0]);
    /// Power, W.
    pub const POWER: Dimension = Dimension::of([2, 1, -3, 0, 0]);
    /// Stiffness, N/m.
    pub const STIFFNESS: Dimension = Dimension::of([0, 1, -2, 0, 0]);
    /// Damping, N s/m.
    pub const DAMPING: Dimension = Dimension::of([0, 1, -1, 0, 0]);
    /// Torque per angular speed counted without angle, N m s.
    pub const ROTATIONAL_DRAG: Dimension = Dimension::of([2, 1, -1, 0, 0]);
    /// Kinematic viscosity, m^2/s.
    pub const KINEMATIC_VISCOSITY: Dimension = Dimension::of([2, 0, -1, 0, 0]);

    /// Electric current, A.
    pub const CURRENT: Dimension = Dimension::electric([0, 0, 0, 0, 0, 1]);
    /// Voltage, V.
    pub const VOLTAGE: Dimension = Dimension::electric([2, 1, -3, 0, 0, -1]);
    /// Electric resistance, Ω.
    pub const RESISTANCE: Dimension = Dimension::electric([2, 1, -3, 0, 0, -2]);
    /// Inductance, H.
    pub const INDUCTANCE: Dimension = Dimension::electric([2, 1, -2, 0, 0, -2]);

    /// From whole exponents of length, mass, time, temperature, angle.
    pub(crate) const fn of(exponents: [i64; 5]) -> Dimension {
        let [length, mass, time, temperature, angle] = exponents;
        Dimension::electric([length, mass, time, temperature, angle, 0])
    }

    /// The same with electric current.
    const fn electric(exponents: [i64; 6]) -> Dimension {
        Dimension {
            exponents: [
                Rational::integer(exponents[0]),
                Rational::integer(exponents[1]),
                Rational::integer(exponents[2]),
                Rational::integer(exponents[3]),
                Rational::integer(exponents[4]),
                Rational::integer(exponents[5]),
            ],
        }
    }

    /// From exponents of length, mass, time, temperature, angle, electric current.
    pub const fn from_exponents(exponents: [Rational; 6]) -> Dimension {
        Dimension { exponents }
    }

    /// The dimension of a contact stiffness in F = k dⁿ: force per length to the power n. `None` beyond 64 bits.
    pub fn force_per_length_power(n: Rational) -> Option<Dimension> {
        let mut dimension = Dimension::FORCE;
        dimension.exponents[0] = Rational::ONE.plus(n.negated())?;
        Some(dimension)
    }

    /// The n of a dimension that is force per length to the power n.
    pub fn length_power_under_force(self) -> Option<Rational> {
        let n = Rational::ONE.plus(self.exponents[0].negated())?;
        (Dimension::force_per_length_power(n)? == self).then_some(n)
    }

    /// The dimension of a product; `None` when an exponent goes beyond 64 bits.
    pub fn times(self, other: Dimension) -> Option<Dimension> {
        let mut exponents = self.exponents;
        for (sum, part) in exponents.iter_mut().zip(other.exponents) {
            *sum = sum.plus(part)?;
        }
        Some(Dimension { exponents })
    }

    /// The dimension of a power; `None` when an exponent goes beyond 64 bits.
    pub fn power(self, exponent: Rational) -> Option<Dimension> {
        let mut exponents = self.exponents;
        for part in &mut exponents {
            *part = part.times(exponent)?;
        }
        Some(Dimension { exponents })
    }

    /// The word an engineer uses, for the common dimensions: "length", "angular speed", "contact stiffness".
    pub fn name(self) -> Option<&'static str> {
        match self.named() {
            Some((name, _)) => Some(name),
            None => self.length_power_under_force().map(|_| "contact stiffness"),
        }
    }

    /// Name and preferred unit.
    fn named(self) -> Option<(&'static str, &'static str)> {
        let mechanical = NAMED.iter().map(|known| (Dimension::of(known.0), known));
        let mechanical = mechanical.map(|(own, known)| (own, (known.1, known.2)));
        let electric = ELECTRIC
            .iter()
            .map(|known| (Dimension::electric(known.0), known));
        let electric = electric.map(|(own, known)| (own, (known.1, known.2)));
        let mut all = mechanical.chain(electric);
        all.find(|(own, _)| *own == self).map(|(_, known)| known)
    }

    /// The SI unit as text, for example `rad/s` or `N/m^(10/9)`; reading it back gives this dimension and the factor 1.
    pub fn si_unit(self) -> String {
        if let Some((_, unit)) = self.named() {
            return unit.to_string();
        }
        if let Some(n) = self.length_power_under_force()
            && n.numerator() > 0
        {
            return format!("N/{}", with_power("m", n));
        }
        let part = |sign: i64| -> Vec<String> {
            BASE.iter()
                .zip(self.exponents)
                .filter(|(_, exponent)| exponent.numerator().signum() == sign)
                .map(|(symbol, exponent)| {
                    let size = if sign < 0 {
                        exponent.negated()
                    } else {
                        exponent
                    };
                    with_power(symbol, size)
                })
                .collect()
        };
        let above = part(1);
        let below = part(-1);
        let above_text = if above.is_empty() {
            "1".to_string()
        } else {
            above.join(" ")
        };
        match below.len() {
            0 => above_text,
            1 => format!("{above_text}/{}", below[0]),
            _ => format!("{above_text}/({})", below.join(" ")),
        }
    }
}

fn with_power(symbol: &str, exponent: Rational) -> String {
    if exponent == Rational::ONE {
        symbol.to_string()
    } else if exponent.denominator() == 1 {
        format!("{symbol}^{exponent}")
    } else {
        format!("{symbol}^({exponent})")
    }
}

impl fmt::Display for Dimension {
    /// The name and the SI unit: `length (m)`; the SI unit alone where there is no name.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.name() {
            Some(name) if *self == Dimension::NONE => write!(f, "{name}"),
            Some(name) => write!(f, "{name} ({})", self.si_unit()),
            None => write!(f, "{}", self.si_unit()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Unit;

    #[test]
    fn named_dimensions_are_distinct_and_their_units_read_back_with_factor_one() {
        for (i, (exponents, name, text)) in NAMED.iter().enumerate() {
            let unit = Unit::parse(text).unwrap();
            assert_eq!(unit.dimension(), Dimension::of(*exponents), "{name}");
            assert_eq!(unit.to_si(1.0), 1.0, "{name}");
            for other in &NAMED[i + 1..] {
                assert_ne!(other.0, *exponents);
                assert_ne!(other.1, *name);
            }
        }
    }

    #[test]
    fn electric_units_read_back_with_factor_one_and_multiply_to_mechanical_ones() {
        for (exponents, name, text) in ELECTRIC {
            let unit = Unit::parse(text).unwrap();
            assert_eq!(unit.dimension(), Dimension::electric(exponents), "{name}");
            assert_eq!(
                (unit.to_si(1.0), unit.dimension().name()),
                (1.0, Some(name))
            );
        }
        let power = Dimension::VOLTAGE.times(Dimension::CURRENT);
        assert_eq!(power, Some(Dimension::POWER));
        assert_eq!(
            Unit::parse("V s/m").unwrap().dimension(),
            Unit::parse("N/A").unwrap().dimension()
        );
    }

    #[test]
    fn contact_stiffness_has_a_power() {
        let n = Rational::new(10, 9).unwrap();
        let dimension = Dimension::force_per_length_power(n).unwrap();
        assert_eq!(dimension.si_unit(), "N/m^(10/9)");
        assert_eq!(dimension.name(), Some("contact stiffness"));
        assert_eq!(dimension.length_power_under_force(), Some(n));
        assert_eq!(
            Dimension::STIFFNESS.length_power_under_force(),
            Some(Rational::ONE)
        );
        assert_eq!(Dimension::MASS.length_power_under_force(), None);
    }
}
