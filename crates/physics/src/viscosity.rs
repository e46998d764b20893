//! Kinematic viscosity of an oil over temperature.
//!
//! ```text
//!   lg lg(ν + 0.7) = A - B lg T          ν mm²/s, T K; a straight line in these axes
//! ```
//! Two measured points fix the line; a single point fixes no slope and holds for its temperature alone.
//!
//! How far from its data a line is used: half the span of the two points to either side, at most 30 K. There, errors of
//! 1 % at the points have grown to less than 5 % (a test holds this); farther out, and near the pour point, oils leave
//! the line. Below 2 mm²/s the 0.7 of the line is no longer enough, above 2e7 mm²/s nothing was measured: both are
//! refused. A single point is used within 1 K, where the viscosity of an oil changes by 4 to 6 %.
//!
//! Not modelled: pressure, shear thinning, the thickener of a grease (ν is that of its base oil).

use number::Real;
use std::fmt;

/// 0 °C, K.
pub const ICE_POINT: f64 = 273.15;

/// Least and largest viscosity of the line, m²/s.
const RANGE: (f64, f64) = (2e-6, 20.0);

/// How far beyond its points a line is used: share of their span, and at most so many K.
const REACH: (f64, f64) = (0.5, 30.0);

/// How far from a single point it is used, K.
const SINGLE_REACH: f64 = 1.0;

number::constants! {
    /// The line of one oil: lg lg(ν + 0.7) = a - b lg T.
    pub struct WaltherLine {
        /// A.
        a: R,
        /// B.
        b: R,
    }
}

impl<R: Real> WaltherLine<R> {
    /// Kinematic viscosity, m²/s.
    ///
    /// Formula: ν = 10^(10^(A - B lg T)) - 0.7 [mm²/s, K]
    ///
    /// - `temperature`: T, K
    ///
    /// Source: ASTM D341, Ubbelohde and Walther (from memory).
    /// Valid: 2 to 2e7 mm²/s, near the points of the line: [`Viscosity::at`] refuses what lies outside.
    #[inline(always)]
    pub fn viscosity(&self, temperature: R) -> R {
        let ten = R::splat(std::f64::consts::LN_10);
        let inner = (self.a * ten - self.b * temperature.ln()).exp();
        ((inner * ten).exp() - R::splat(0.7)) * R::splat(1e-6)
    }
}

/// The viscosity of one oil over the temperatures it is known for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viscosity {
    line: WaltherLine<f64>,
    least: f64,
    largest: f64,
}

/// Why a viscosity is not known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ViscosityError {
    /// A point that is not finite, below 0 K, or outside 2 to 2e7 mm²/s.
    Point {
        /// Temperature, K.
        temperature: f64,
        /// Viscosity, m²/s.
        viscosity: f64,
    },
    /// Two points less than 10 K apart.
    TooClose {
        /// Their distance, K.
        distance: f64,
    },
    /// Viscosity that does not fall with temperature.
    Rising,
    /// A number that is no grade of ISO 3448.
    NoGrade {
        /// The number.
        grade: u32,
    },
    /// A temperature too far from the points.
    OutsideData {
        /// Temperature asked for, K.
        temperature: f64,
        /// Least temperature, K.
        least: f64,
        /// Largest temperature, K.
        largest: f64,
    },
    /// A viscosity outside 2 to 2e7 mm²/s at a temperature near the points.
    OutsideLaw {
        /// Temperature asked for, K.
        temperature: f64,
        /// Viscosity of the line there, m²/s.
        viscosity: f64,
    },
}

impl fmt::Display for ViscosityError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let celsius = |kelvin: f64| kelvin - ICE_POINT;
        match *self {
            ViscosityError::Point {
                temperature,
                viscosity,
            } => write!(
                out,
                "{} mm²/s at {:.2} °C: a viscosity from 2 to 2e7 mm²/s at a temperature above 0 K is needed",
                viscosity * 1e6,
                celsius(temperature)
            ),
            ViscosityError::TooClose { distance } => write!(
                out,
                "two viscosities {distance:.1} K apart: at least 10 K are needed to determine their slope"
            ),
            ViscosityError::Rising => {
                write!(out, "the viscosity of an oil falls with temperature")
            }
            ViscosityError::NoGrade { grade } => write!(
                out,
                "ISO VG {grade}: the grades are {}",
                ISO_GRADES.map(|(grade, _)| grade.to_string()).join(", ")
            ),
            ViscosityError::OutsideData {
                temperature,
                least,
                largest,
            } => write!(
                out,
                "{:.1} °C is outside the viscosity data, which serve from {:.1} to {:.1} °C",
                celsius(temperature),
                celsius(least),
                celsius(largest)
            ),
            ViscosityError::OutsideLaw {
                temperature,
                viscosity,
            } => write!(
                out,
                "{:.3} mm²/s at {:.1} °C: the viscosity law holds from 2 to 2e7 mm²/s",
                viscosity * 1e6,
                celsius(temperature)
            ),
        }
    }
}

impl std::error::Error for ViscosityError {}

/// Grades of ISO 3448 and their viscosity at 40 °C, mm²/s; an oil of the grade lies within 10 %.
///
/// Source: ISO 3448 as tabled in an oil maker's data (idoc.tips, "Viscosity") up to 1500; grades from 22 also in the Timken
/// Engineering Manual, fig. 146; 2200 and 3200 from memory.
pub const ISO_GRADES: [(u32, f64); 20] = [
    (2, 2.2),
    (3, 3.2),
    (5, 4.6),
    (7, 6.8),
    (10, 10.0),
    (15, 15.0),
    (22, 22.0),
    (32, 32.0),
    (46, 46.0),
    (68, 68.0),
    (100, 100.0),
    (150, 150.0),
    (220, 220.0),
    (320, 320.0),
    (460, 460.0),
    (680, 680.0),
    (1000, 1000.0),
    (1500, 1500.0),
    (2200, 2200.0),
    (3200, 3200.0),
];

/// Viscosity of an ISO grade at 40 °C, m²/s.
///
/// Formula: the middle of the grade
///
/// - `grade`: number of the grade, such as 32
///
/// Source: ISO 3448, as [`ISO_GRADES`].
/// Valid: an oil of the grade may deviate by 10 %.
pub fn iso_grade_viscosity(grade: u32) -> Result<f64, ViscosityError> {
    ISO_GRADES
        .iter()
        .find(|row| row.0 == grade)
        .map(|row| row.1 * 1e-6)
        .ok_or(ViscosityError::NoGrade { grade })
}

impl Viscosity {
    /// The viscosity through two measured points (temperature in K, viscosity in m²/s), in any order.
    ///
    /// Formula: lg lg(ν + 0.7) = A - B lg T [mm²/s, K] through both
    ///
    /// - `one`, `other`: such as the values at 40 and 100 °C of a data sheet
    ///
    /// Source: ASTM D341, Ubbelohde and Walther (from memory).
    /// Valid: points at least 10 K apart; serves half their span, at most 30 K, beyond them.
    pub fn through(one: (f64, f64), other: (f64, f64)) -> Result<Self, ViscosityError> {
        let (cold, warm) = if one.0 <= other.0 {
            (one, other)
        } else {
            (other, one)
        };
        let (y_cold, y_warm) = (ordinate(cold)?, ordinate(warm)?);
        let span = warm.0 - cold.0;
        if span < 10.0 {
            return Err(ViscosityError::TooClose { distance: span });
        }
        if warm.1 >= cold.1 {
            return Err(ViscosityError::Rising);
        }
        let b = (y_cold - y_warm) / (warm.0 / cold.0).log10();
        let reach = (REACH.0 * span).min(REACH.1);
        Ok(Viscosity {
            line: WaltherLine {
                a: y_cold + b * cold.0.log10(),
                b,
            },
            least: cold.0 - reach,
            largest: warm.0 + reach,
        })
    }

    /// The viscosity of an ISO grade with a second measured point.
    ///
    /// - `grade`: ISO VG number
    /// - `second`: temperature in K and viscosity in m²/s of a second point
    ///
    /// Source: [`iso_grade_viscosity`], [`Viscosity::through`].
    /// Valid: as both; the grade leaves 10 % open.
    pub fn of_grade(grade: u32, second: (f64, f64)) -> Result<Self, ViscosityError> {
        Viscosity::through((ICE_POINT + 40.0, iso_grade_viscosity(grade)?), second)
    }

    /// The viscosity known at one temperature alone.
    ///
    /// - `point`: temperature in K and viscosity in m²/s
    ///
    /// Source: the point.
    /// Valid: within 1 K of it: oils change by 4 to 6 % per K at 40 °C.
    pub fn single(point: (f64, f64)) -> Result<Self, ViscosityError> {
        Ok(Viscosity {
            line: WaltherLine {
                a: ordinate(point)?,
                b: 0.0,
            },
            least: point.0 - SINGLE_REACH,
            largest: point.0 + SINGLE_REACH,
        })
    }

    /// Kinematic viscosity at a temperature, m²/s, or why it is not known.
    ///
    /// Formula: [`WaltherLine::viscosity`]
    ///
    /// - `temperature`: T, K
    ///
    /// Source: ASTM D341, Ubbelohde and Walther (from memory).
    /// Valid: [`Viscosity::range`] and 2 to 2e7 mm²/s; outside an error.
    pub fn at(&self, temperature: f64) -> Result<f64, ViscosityError> {
        if !(self.least..=self.largest).contains(&temperature) {
            return Err(ViscosityError::OutsideData {
                temperature,
                least: self.least,
                largest: self.largest,
            });
        }
        let viscosity = self.line.viscosity(temperature);
        // the points themselves are inside; a rounding may put them a hair outside
        let inside = (RANGE.0 * (1.0 - 1e-12))..=(RANGE.1 * (1.0 + 1e-12));
        if inside.contains(&viscosity) {
            Ok(viscosity)
        } else {
            Err(ViscosityError::OutsideLaw {
                temperature,
                viscosity,
            })
        }
    }

    /// Least and largest temperature the data serve, K.
    ///
    /// Source: the points.
    /// Valid: always.
    pub fn range(&self) -> (f64, f64) {
        (self.least, self.largest)
    }

    /// The line, for use in a time loop; it knows no range.
    ///
    /// Source: the points.
    /// Valid: [`Viscosity::range`].
    pub fn line(&self) -> WaltherLine<f64> {
        self.line
    }
}

/// lg lg(ν + 0.7) of a point.
fn ordinate((temperature, viscosity): (f64, f64)) -> Result<f64, ViscosityError> {
    let possible =
        temperature.is_finite() && temperature > 0.0 && (RANGE.0..=RANGE.1).contains(&viscosity);
    if possible {
        Ok((viscosity * 1e6 + 0.7).log10().log10())
    } else {
        Err(ViscosityError::Point {
            temperature,
            viscosity,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use number::{Dual, Gather};

    const MM2_S: f64 = 1e-6;

    fn celsius(temperature: f64) -> f64 {
        ICE_POINT + temperature
    }
    fn data_sheet(at_40: f64, at_100: f64) -> Viscosity {
        Viscosity::through(
            (celsius(40.0), at_40 * MM2_S),
            (celsius(100.0), at_100 * MM2_S),
        )
        .unwrap()
    }

    #[test]
    fn published_evaluations_of_astm_d341() {
        // olezol.com, viscosity temperature extrapolation: 404 and 28 mm²/s make 132.126 at 60 °C (six digits);
        // 68 at 40 °C and 14.85 at 80 °C make 8.8 at 100 °C (two digits)
        let gear_oil = data_sheet(404.0, 28.0);
        let ours = gear_oil.at(celsius(60.0)).unwrap() / MM2_S;
        assert!((ours / 132.126 - 1.0).abs() < 1e-4, "{ours}");
        let second = (celsius(80.0), 14.85 * MM2_S);
        let beyond = Viscosity::of_grade(68, second).unwrap();
        let ours = beyond.at(celsius(100.0)).unwrap() / MM2_S;
        assert!((ours / 8.8 - 1.0).abs() < 6e-3, "{ours}");
    }
    #[test]
    fn an_oil_of_grade_32_has_about_12_mm2_s_at_70_degrees() {
        // Reference conditions of ISO 15312, printed in Schaeffler HR 1 (2006): ISO VG 32, 12 mm²/s at 70 °C.
        // The second point 5.4 mm²/s is that of a mineral oil with viscosity index 100 (from memory).
        let oil = Viscosity::of_grade(32, (celsius(100.0), 5.4 * MM2_S)).unwrap();
        let ours = oil.at(celsius(70.0)).unwrap() / MM2_S;
        // a grade is 10 % wide
        assert!((ours / 12.0 - 1.0).abs() < 0.1, "{ours}");
    }
    #[test]
    fn goes_through_its_points_and_falls_between() {
        let oil = data_sheet(68.0, 8.7);
        assert!((oil.at(celsius(40.0)).unwrap() / (68.0 * MM2_S) - 1.0).abs() < 1e-12);
        assert!((oil.at(celsius(100.0)).unwrap() / (8.7 * MM2_S) - 1.0).abs() < 1e-12);
        // by a script of another language, from the formula: 20.1232203579315 mm²/s at 70 °C
        assert!((oil.at(celsius(70.0)).unwrap() / (20.123_220_357_9 * MM2_S) - 1.0).abs() < 1e-10);
        let (least, largest) = oil.range();
        let steps = (0..=200).map(|k| least + (largest - least) * f64::from(k) / 200.0);
        let values: Vec<_> = steps.map(|t| oil.at(t.min(largest)).unwrap()).collect();
        assert!(values.windows(2).all(|pair| pair[1] < pair[0]));
        assert_eq!(
            data_sheet(68.0, 8.7),
            Viscosity::through((celsius(100.0), 8.7 * MM2_S), (celsius(40.0), 68.0 * MM2_S))
                .unwrap()
        );
    }
    #[test]
    fn one_percent_at_the_points_stays_below_five_where_the_line_serves() {
        for (at_40, at_100) in [(15.0, 3.3), (32.0, 5.4), (100.0, 11.1), (460.0, 30.5)] {
            let right = data_sheet(at_40, at_100);
            let (least, largest) = right.range();
            assert_eq!((least, largest), (celsius(10.0), celsius(130.0)));
            for (cold, warm) in [(1.01, 0.99), (0.99, 1.01), (1.01, 1.01)] {
                let wrong = data_sheet(at_40 * cold, at_100 * warm);
                for temperature in [least, celsius(120.0)] {
                    let (Ok(wrong), Ok(right)) = (wrong.at(temperature), right.at(temperature))
                    else {
                        continue; // below 2 mm²/s
                    };
                    assert!((wrong / right - 1.0).abs() < 0.05, "{at_40} {temperature}");
                }
            }
        }
    }
    #[test]
    fn outside_its_data_it_refuses() {
        let oil = data_sheet(32.0, 5.4);
        for temperature in [celsius(9.9), celsius(130.1), f64::NAN] {
            assert!(matches!(
                oil.at(temperature),
                Err(ViscosityError::OutsideData { .. })
            ));
        }
        let message = oil.at(celsius(-40.0)).unwrap_err().to_string();
        assert!(message.contains("-40.0 °C") && message.contains("10.0 to 130.0 °C"));
        let thin = data_sheet(10.0, 2.6);
        assert!(matches!(
            thin.at(celsius(129.0)),
            Err(ViscosityError::OutsideLaw { .. })
        ));
        let single = Viscosity::single((celsius(40.0), 68.0 * MM2_S)).unwrap();
        assert!((single.at(celsius(40.9)).unwrap() / (68.0 * MM2_S) - 1.0).abs() < 1e-12);
        assert!(single.at(celsius(41.5)).is_err());
    }
    #[test]
    fn points_that_make_no_oil_are_refused() {
        let point = |t: f64, nu: f64| (celsius(t), nu * MM2_S);
        for (one, other, why) in [
            (point(40.0, 32.0), point(45.0, 28.0), "5.0 K apart"),
            (
                point(40.0, 32.0),
                point(100.0, 33.0),
                "falls with temperature",
            ),
            (
                point(40.0, 32.0),
                point(100.0, 1.5),
                "1.5 mm²/s at 100.00 °C",
            ),
            (point(40.0, f64::NAN), point(100.0, 5.0), "NaN mm²/s"),
            (point(-300.0, 32.0), point(100.0, 5.0), "above 0 K"),
        ] {
            let message = Viscosity::through(one, other).unwrap_err().to_string();
            assert!(message.contains(why), "{message}");
        }
        let grade = iso_grade_viscosity(33).unwrap_err().to_string();
        assert!(grade.contains("ISO VG 33") && grade.contains("22, 32, 46"));
    }
    #[test]
    fn the_printed_limits_of_the_grades_are_ten_percent_about_the_middle() {
        let grades = [
            2, 3, 5, 7, 10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500,
        ];
        #[rustfmt::skip]
        let least = [1.98, 2.88, 4.14, 6.12, 9.00, 13.5, 19.8, 28.8, 41.4, 61.2, 90.0, 135.0, 198.0, 288.0, 414.0, 612.0, 900.0, 1350.0];
        #[rustfmt::skip]
        let largest = [2.42, 3.52, 5.06, 7.48, 11.0, 16.5, 24.2, 35.2, 50.6, 74.8, 110.0, 165.0, 242.0, 352.0, 506.0, 748.0, 1100.0, 1650.0];
        for (k, grade) in grades.into_iter().enumerate() {
            let middle = iso_grade_viscosity(grade).unwrap() / MM2_S;
            assert!((0.9 * middle / least[k] - 1.0).abs() < 1e-12, "{grade}");
            assert!((1.1 * middle / largest[k] - 1.0).abs() < 1e-12, "{grade}");
        }
    }
    #[test]
    fn the_line_of_the_loop_agrees_and_has_its_slope() {
        let oil = data_sheet(100.0, 11.1);
        let line: WaltherLine<Dual<1>> = Gather::gather(&|_| &oil.line);
        let temperature = celsius(55.0);
        let dual = line.viscosity(Dual::variable(temperature, 0));
        assert_eq!(dual.value, oil.at(temperature).unwrap());
        let h = 1e-3;
        let difference =
            (oil.at(temperature + h).unwrap() - oil.at(temperature - h).unwrap()) / (2.0 * h);
        // truncation h²/T², rounding 1e-13
        assert!((dual.partial[0] / difference - 1.0).abs() < 1e-8);
        // 4 to 6 % per K near 40 °C is what a single point claims
        let per_kelvin = (oil.at(celsius(40.0)).unwrap() / oil.at(celsius(41.0)).unwrap()).ln();
        assert!((0.04..0.06).contains(&per_kelvin), "{per_kelvin}");
    }
}
