//! Lubricants: viscosity over temperature and pressure, and what a sheared film needs besides.
//!
//! ```text
//!   η(p, T) = K exp[C/(D + T)] exp[p/(A + B p)],   A = a₁ + a₂ T,  B = b₁ + b₂ T      ("modulus equation")
//!   α(p, T) = 1/(A + B p)            τ_L = Λ p          τ_E = 2 Λ/α
//! ```
//! Barus's law, η e^(αp), is right at the inlet and far too stiff in the contact: at 1 GPa and α = 22 /GPa it is e²²
//! where fits to falling-body viscometers give e¹⁵. Roelands's law is softer and has one parameter for it; the modulus equation
//! has two, fitted to measurements of each oil, costs a division instead of a power, and has its temperature in it. So it is
//! the law here, and an oil without such measurements has no traction.
//!
//! What the published data of an oil do not contain is `None`, and [`Lubricant::at`] says which number the user must give.
//!
//! Not modelled: limiting stress over temperature, compressibility, additives, ageing; the thickener of a grease.

use crate::viscosity::ICE_POINT;
use number::{Real, constants};
use std::fmt;

/// Pressure up to which an oil must stay a liquid of the law, Pa; beyond, laws of the time loop stay at it.
pub const HIGHEST_PRESSURE: f64 = 5e9;

constants! {
    /// Viscosity over pressure and absolute temperature.
    pub struct ModulusEquation {
        /// K, Pa s.
        base: R,
        /// C, K.
        temperature_constant: R,
        /// D, K; usually negative.
        temperature_offset: R,
        /// a₁, Pa.
        modulus: R,
        /// a₂, Pa/K.
        modulus_slope: R,
        /// b₁.
        stiffening: R,
        /// b₂, 1/K.
        stiffening_slope: R,
    }
}

impl<R: Real> ModulusEquation<R> {
    /// A + B p, Pa: the reciprocal of the pressure-viscosity coefficient.
    #[inline(always)]
    fn denominator(&self, pressure: R, temperature: R) -> R {
        self.modulus
            + self.modulus_slope * temperature
            + (self.stiffening + self.stiffening_slope * temperature) * pressure
    }

    /// Dynamic viscosity, Pa s.
    ///
    /// Formula: η = K exp[C/(D + T)] exp[p/(A + B p)], A = a₁ + a₂ T, B = b₁ + b₂ T
    ///
    /// - `pressure`: p, Pa
    /// - `temperature`: T, K
    ///
    /// Source: H. Peeken, H. Dicke, G. Welsch 1992 and P. W. Gold et al. 2001, printed by P. Wingertszahn et al., Lubricants 11
    /// (2023) 369, equations 7 and 8, and by A. Arana et al., Proc. IMechE J 233 (2019) 303, equation 30.
    /// Valid: temperatures and pressures of the fit; A + B p > 0.
    #[inline(always)]
    pub fn viscosity(&self, pressure: R, temperature: R) -> R {
        let thermal = self.temperature_constant / (self.temperature_offset + temperature);
        let piezo = pressure / self.denominator(pressure, temperature);
        self.base * (thermal + piezo).exp()
    }

    /// Pressure-viscosity coefficient against ambient pressure, 1/Pa.
    ///
    /// Formula: α = ln[η(p)/η(0)]/p = 1/(A + B p)
    ///
    /// - `pressure`: p, Pa
    /// - `temperature`: T, K
    ///
    /// Source: A. Arana et al., Proc. IMechE J 233 (2019) 303, equation 33.
    /// Valid: as [`ModulusEquation::viscosity`].
    #[inline(always)]
    pub fn pressure_coefficient(&self, pressure: R, temperature: R) -> R {
        self.denominator(pressure, temperature).recip()
    }
}

/// A lubricant with what a sheared film needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lubricant {
    /// What it is.
    pub name: &'static str,
    /// Viscosity over pressure and temperature.
    pub viscosity: ModulusEquation<f64>,
    /// Density at 15 °C (15.6 °C where the source says so), kg/m³.
    pub density: f64,
    /// Λ: limiting shear stress over pressure.
    pub limiting_coefficient: f64,
    /// Thermal conductivity, W/(m K), where published with the oil.
    pub conductivity: Option<f64>,
    /// Least and largest temperature, K.
    pub temperatures: (f64, f64),
}

/// 25 °C, where the high-pressure measurements of these oils begin, and 100 °C, where their viscosities are last printed.
const MEASURED: (f64, f64) = (ICE_POINT + 25.0, ICE_POINT + 100.0);

/// Reference oil FVA 3: paraffinic mineral oil, ISO VG 100, no additives.
///
/// Source: P. Wingertszahn et al., Lubricants 11 (2023) 369, table A1 (temperatures in °C there); Λ is that of the equivalent
/// oil M100 of A. Arana et al. 2019.
pub const FVA_3: Lubricant = Lubricant {
    name: "FVA 3, mineral oil ISO VG 100",
    viscosity: ModulusEquation {
        base: 0.062e-3,
        temperature_constant: 1021.7,
        temperature_offset: 101.5517 - ICE_POINT,
        modulus: 327.7918e5 - 2.9862e5 * ICE_POINT,
        modulus_slope: 2.9862e5,
        stiffening: 4.419e-3 - 3.0115e-4 * ICE_POINT,
        stiffening_slope: 3.0115e-4,
    },
    density: 887.6,
    limiting_coefficient: 0.047,
    conductivity: Some(0.134),
    temperatures: MEASURED,
};

/// Naphthenic mineral oil, ISO VG 100, no additives: high traction.
///
/// Source: A. Arana et al., Proc. IMechE J 233 (2019) 303, tables 2 and 3 (unit of C read as 10³ K, which its viscosities ask
/// for); its rounded Vogel constants give the table's own viscosities within 20 %.
pub const NAPHTHENIC_100: Lubricant = Lubricant {
    name: "N100, naphthenic mineral oil ISO VG 100",
    viscosity: ModulusEquation {
        base: 161.60e-6,
        temperature_constant: 650.0,
        temperature_offset: -206.0,
        modulus: -7.23e7,
        modulus_slope: 3.48e5,
        stiffening: 5.00e-3,
        stiffening_slope: -1.83e-5,
    },
    density: 900.0,
    limiting_coefficient: 0.053,
    conductivity: None,
    temperatures: MEASURED,
};

/// Polyalphaolefin, ISO VG 100, no additives: low traction.
///
/// Source: A. Arana et al., Proc. IMechE J 233 (2019) 303, tables 2 and 3 (as for [`NAPHTHENIC_100`], within 8 %).
pub const POLYALPHAOLEFIN_100: Lubricant = Lubricant {
    name: "PAO100, polyalphaolefin ISO VG 100",
    viscosity: ModulusEquation {
        base: 12.26e-6,
        temperature_constant: 1740.0,
        temperature_offset: -116.0,
        modulus: -5.73e7,
        modulus_slope: 3.90e5,
        stiffening: -39.50e-3,
        stiffening_slope: 23.54e-5,
    },
    density: 840.0,
    limiting_coefficient: 0.035,
    conductivity: None,
    temperatures: MEASURED,
};

/// Every lubricant with data for traction.
pub const LUBRICANTS: [Lubricant; 3] = [FVA_3, NAPHTHENIC_100, POLYALPHAOLEFIN_100];

/// Why a lubricant has no state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LubricantError {
    /// A temperature outside its data.
    Temperature {
        /// Temperature asked for, K.
        temperature: f64,
        /// Least and largest temperature of the data, K.
        range: (f64, f64),
    },
    /// A property that its source does not print and the user must give.
    Missing(&'static str),
    /// A number that must be finite and positive.
    NotPositive(&'static str),
    /// A viscosity that does not grow with pressure and fall with temperature up to [`HIGHEST_PRESSURE`].
    NoLiquid,
}

impl fmt::Display for LubricantError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            LubricantError::Temperature { temperature, range } => write!(
                out,
                "{:.1} °C: the data of this lubricant serve from {:.1} to {:.1} °C",
                temperature - ICE_POINT,
                range.0 - ICE_POINT,
                range.1 - ICE_POINT
            ),
            LubricantError::Missing(property) => write!(
                out,
                "the {property} was not published with this lubricant: give it"
            ),
            LubricantError::NotPositive(property) => {
                write!(out, "the {property} must be finite and positive")
            }
            LubricantError::NoLiquid => write!(
                out,
                "the viscosity must grow with pressure and fall with temperature up to 5 GPa"
            ),
        }
    }
}

impl std::error::Error for LubricantError {}

/// A lubricant at the temperature at which it enters the contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LubricantState {
    /// The lubricant's viscosity.
    pub equation: ModulusEquation<f64>,
    /// Temperature, K.
    pub temperature: f64,
    /// η at ambient pressure, Pa s.
    pub viscosity: f64,
    /// -∂ ln η/∂T at ambient pressure, 1/K.
    pub sensitivity: f64,
    /// α of film formation, 1/Pa.
    pub film_coefficient: f64,
    /// Λ.
    pub limiting_coefficient: f64,
    /// k, W/(m K).
    pub conductivity: f64,
}

impl Lubricant {
    /// The lubricant at a temperature, or why it is not known there.
    ///
    /// Formula: η and α as [`ModulusEquation`] has them, -∂ ln η/∂T = C/(D + T)², film coefficient 1/∫ η(0)/η(p) dp
    ///
    /// - `temperature`: of the oil in the inlets, K
    /// - `conductivity`: W/(m K), the user's own, needed where the oil's is not published
    ///
    /// Source: that of the lubricant; film coefficient: A. Arana et al. 2019, equation 23.
    /// Valid: temperatures of the data; outside an error.
    pub fn at(
        &self,
        temperature: f64,
        conductivity: Option<f64>,
    ) -> Result<LubricantState, LubricantError> {
        let (least, largest) = self.temperatures;
        if !(least..=largest).contains(&temperature) {
            return Err(LubricantError::Temperature {
                temperature,
                range: self.temperatures,
            });
        }
        let conductivity = conductivity
            .or(self.conductivity)
            .ok_or(LubricantError::Missing("thermal conductivity"))?;
        for (value, property) in [
            (conductivity, "thermal conductivity"),
            (
                self.limiting_coefficient,
                "limiting shear stress coefficient",
            ),
            (self.viscosity.base, "base viscosity"),
            (self.viscosity.temperature_constant, "temperature constant"),
            (
                self.viscosity.temperature_offset + temperature,
                "temperature above the offset",
            ),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(LubricantError::NotPositive(property));
            }
        }
        let equation = self.viscosity;
        let liquid = [0.0, HIGHEST_PRESSURE].iter().all(|&pressure| {
            equation.denominator(pressure, temperature) > 0.0
                && equation.modulus_slope + equation.stiffening_slope * pressure > 0.0
        });
        if !liquid {
            return Err(LubricantError::NoLiquid);
        }
        let above = equation.temperature_offset + temperature;
        Ok(LubricantState {
            equation,
            temperature,
            viscosity: equation.viscosity(0.0, temperature),
            sensitivity: equation.temperature_constant / (above * above),
            film_coefficient: film_coefficient(&equation, temperature),
            limiting_coefficient: self.limiting_coefficient,
            conductivity,
        })
    }
}

/// Reciprocal asymptotic isoviscous pressure coefficient, 1/Pa.
///
/// Formula: α* = 1/∫ η(0)/η(p) dp, p from 0 to 1.5 GPa
///
/// - `equation`: the viscosity
/// - `temperature`: T, K
///
/// Source: A. Arana et al., Proc. IMechE J 233 (2019) 303, equation 23.
/// Valid: as the viscosity; what lies above 1.5 GPa adds less than 1e-4 for oils.
pub fn film_coefficient(equation: &ModulusEquation<f64>, temperature: f64) -> f64 {
    const STEPS: u32 = 3000;
    let step = 1.5e9 / f64::from(STEPS);
    let fluidity = |i: u32| {
        let pressure = step * f64::from(i);
        (-pressure * equation.pressure_coefficient(pressure, temperature)).exp()
    };
    // Simpson's rule; the weights 1, 4, 2, …, 4, 1
    let sum: f64 = (0..=STEPS)
        .map(|i| match i {
            0 | STEPS => fluidity(i),
            i if i % 2 == 1 => 4.0 * fluidity(i),
            _ => 2.0 * fluidity(i),
        })
        .sum();
    3.0 / (step * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn celsius(temperature: f64) -> f64 {
        ICE_POINT + temperature
    }

    #[test]
    fn viscosities_are_the_printed_ones() {
        // kinematic viscosities in mm²/s at 40 and 100 °C: table 2 of Arana et al., FVA 3 against
        // its equivalent M100 (another batch and another fit: 13 %);
        // densities at temperature with -0.65 kg/(m³ K) of mineral oils. Rounded Vogel constants: see each oil.
        for (oil, cold, hot, tolerance) in [
            (FVA_3, 96.0, 10.6, 0.13),
            (NAPHTHENIC_100, 97.9, 8.61, 0.2),
            (POLYALPHAOLEFIN_100, 94.1, 14.0, 0.08),
        ] {
            for (temperature, nu) in [(40.0, cold), (100.0, hot)] {
                let density = oil.density - 0.65 * (temperature - 15.0);
                let printed = nu * 1e-6 * density;
                let ours = oil.viscosity.viscosity(0.0, celsius(temperature));
                assert!(
                    (ours / printed - 1.0).abs() < tolerance,
                    "{} {temperature}: {ours} {printed}",
                    oil.name
                );
            }
        }
    }
    #[test]
    fn by_hand_from_the_printed_constants() {
        // FVA 3 at 50 °C as its table states it, °C and bar: 0.062 e^(1021.7/151.5517) = 52.466 mPa s;
        // at 1 GPa: a = 327.7918 + 2.9862·50, b = 4.419e-3 + 3.0115e-4·50, exponent 1e4/(a + b·1e4)
        let at_ambient = 0.062e-3 * (1021.7_f64 / 151.5517).exp();
        let exponent = 1e4 / (327.7918 + 149.31 + (4.419e-3 + 0.015_057_5) * 1e4);
        let ours = FVA_3.viscosity.viscosity(0.0, celsius(50.0));
        assert!((ours / at_ambient - 1.0).abs() < 1e-12);
        let ours = FVA_3.viscosity.viscosity(1e9, celsius(50.0));
        assert!((ours / (at_ambient * exponent.exp()) - 1.0).abs() < 1e-11);
        assert!((52.4e-3..52.6e-3).contains(&at_ambient), "{at_ambient}");
    }
    #[test]
    fn pressure_stiffens_less_than_barus_and_heat_thins_more() {
        let oil = FVA_3.at(celsius(60.0), None).unwrap();
        let at = |pressure, temperature| oil.equation.viscosity(pressure, temperature);
        let alpha = oil.equation.pressure_coefficient(0.0, oil.temperature);
        // mineral oils: 15 to 25 /GPa at 60 °C
        assert!((15e-9..25e-9).contains(&alpha));
        assert!(at(1e9, oil.temperature) < 0.01 * oil.viscosity * (alpha * 1e9).exp());
        let thinning =
            |pressure| (at(pressure, oil.temperature) / at(pressure, oil.temperature + 1.0)).ln();
        assert!((thinning(0.0) / oil.sensitivity - 1.0).abs() < 0.01);
        assert!(thinning(1e9) > 2.0 * thinning(0.0));
        // softening with pressure makes the mean coefficient of film formation smaller, by a few per cent
        assert!(oil.film_coefficient < alpha && oil.film_coefficient > 0.9 * alpha);
    }
    #[test]
    fn the_film_coefficient_of_barus_is_his_own() {
        let barus = ModulusEquation {
            base: 1e-4,
            temperature_constant: 1000.0,
            temperature_offset: -180.0,
            modulus: 0.5e8,
            modulus_slope: 0.0,
            stiffening: 0.0,
            stiffening_slope: 0.0,
        };
        // Simpson on e^(-p/A) with 3000 steps: (step/A)⁴/180 = 6e-11; the tail e^-30
        assert!((film_coefficient(&barus, 300.0) * 0.5e8 - 1.0).abs() < 1e-10);
    }
    #[test]
    fn what_is_not_known_is_refused() {
        let message = FVA_3.at(celsius(120.0), None).unwrap_err().to_string();
        assert!(message.contains("120.0 °C") && message.contains("25.0 to 100.0 °C"));
        let message = POLYALPHAOLEFIN_100
            .at(celsius(60.0), None)
            .unwrap_err()
            .to_string();
        assert!(message.contains("thermal conductivity was not published"));
        assert!(POLYALPHAOLEFIN_100.at(celsius(60.0), Some(0.14)).is_ok());
        assert!(FVA_3.at(celsius(60.0), Some(-1.0)).is_err());
        assert!(FVA_3.at(f64::NAN, None).is_err());
        let mut solid = FVA_3;
        solid.viscosity.modulus_slope = -1e5;
        assert_eq!(solid.at(celsius(60.0), None), Err(LubricantError::NoLiquid));
        for oil in LUBRICANTS {
            for temperature in [25.0, 60.0, 100.0] {
                assert!(
                    oil.at(celsius(temperature), Some(0.13)).is_ok(),
                    "{}",
                    oil.name
                );
            }
        }
    }
}
