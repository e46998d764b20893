//! Kinematic viscosity of an oil over temperature.
//!
//! ```text
//!   lg lg Z = A - B lg T                                             ν mm²/s, T K; a straight line in these axes
//!   Z = ν + 0.7 + max(0, C(ν) - C(2)),  C = exp(-1.47 - 1.84 ν - 0.51 ν²)
//! ```
//! Two measured points fix the line; a single point fixes no slope and holds for its temperature alone.
//!
//! C is the standard's term for thin oils, without the 7.5e-4 mm²/s it has at 2 mm²/s: above that nothing is left of it, and ν is
//! continuous. What this leaves out is less than 0.6 % of ν at 0.21 mm²/s, below what the law itself leaves open there.
//!
//! How far from its data a line is sure: half the span of the two points to either side, at most 30 K. There, errors of
//! 1 % at the points have grown to less than 5 % (a test holds this). Farther out the line is drawn on, and [`Viscosity::error_at`]
//! says what those errors have grown to; near the pour point, and where an oil cracks, oils leave the line whatever the points are.
//! It ends at 0.21 and at 2e7 mm²/s, between which the standard states it, and at 350 °C, where no oil stays one. A single point is used within 1 K, where the viscosity of
//! an oil changes by 4 to 6 %.
//!
//! Not modelled: pressure, shear thinning, pour point and cracking, the thickener of a grease (ν is that of its base oil).

use number::Real;

pub use units::ICE_POINT;

/// Least and largest viscosity of the line, mm²/s.
const RANGE: (f64, f64) = (0.21, 2e7);
/// Above it oils crack within minutes, K. Source: refining of mineral oils, from 350 °C on (from memory).
const CRACKS: f64 = ICE_POINT + 350.0;
/// Below it the term for thin oils counts, mm²/s.
const THIN: f64 = 2.0;

/// How far beyond its points a line is sure: share of their span, and at most so many K.
const REACH: (f64, f64) = (0.5, 30.0);

/// How far from a single point it is used, K.
const SINGLE_REACH: f64 = 1.0;

/// The term for thin oils, mm²/s.
fn thin(viscosity: f64) -> f64 {
    (-1.47 - 1.84 * viscosity - 0.51 * viscosity * viscosity).exp()
}

/// Z - 0.7 of a viscosity, both mm²/s.
fn shifted(viscosity: f64) -> f64 {
    match viscosity < THIN {
        true => viscosity + thin(viscosity) - thin(THIN),
        false => viscosity,
    }
}

/// The viscosity of a Z - 0.7, both mm²/s: Newton's method from above, on a convex function.
fn of_shifted(shifted: f64) -> f64 {
    if shifted >= THIN {
        return shifted;
    }
    let mut viscosity = shifted + thin(THIN);
    for _ in 0..8 {
        let term = thin(viscosity);
        let slope = 1.0 - (1.84 + 1.02 * viscosity) * term;
        viscosity -= (viscosity + term - thin(THIN) - shifted) / slope;
    }
    viscosity
}

/// lg lg Z of a viscosity, mm²/s.
fn ordinate(viscosity: f64) -> f64 {
    (shifted(viscosity) + 0.7).log10().log10()
}

/// The viscosity of one oil over the temperatures it is known for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viscosity {
    /// lg lg Z = a - b lg T.
    a: f64,
    b: f64,
    /// What was measured: K and m²/s, the colder first.
    points: [(f64, f64); 2],
    /// Between which temperatures it is sure, K.
    sure: (f64, f64),
    /// Between which temperatures there is one, K.
    ends: (f64, f64),
}

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
pub fn iso_grade_viscosity(grade: u32) -> Result<f64, String> {
    ISO_GRADES
        .iter()
        .find(|row| row.0 == grade)
        .map(|row| row.1 * 1e-6)
        .ok_or_else(|| {
            let grades = ISO_GRADES.map(|(grade, _)| grade.to_string()).join(", ");
            format!("ISO VG {grade}: the grades are {grades}")
        })
}

impl Viscosity {
    /// The viscosity through two measured points (temperature in K, viscosity in m²/s), in any order.
    ///
    /// Formula: lg lg(ν + 0.7) = A - B lg T [mm²/s, K] through both
    ///
    /// - `one`, `other`: such as the values at 40 and 100 °C of a data sheet
    ///
    /// Source: ASTM D341, Ubbelohde and Walther (from memory).
    /// Valid: points at least 10 K apart; sure half their span, at most 30 K, beyond them.
    pub fn through(one: (f64, f64), other: (f64, f64)) -> Result<Self, String> {
        let (cold, warm) = if one.0 <= other.0 {
            (one, other)
        } else {
            (other, one)
        };
        let (y_cold, y_warm) = (of_point(cold)?, of_point(warm)?);
        let span = warm.0 - cold.0;
        if span < 10.0 {
            return Err(format!(
                "two viscosities {span:.1} K apart: at least 10 K are needed to determine their slope"
            ));
        }
        if warm.1 >= cold.1 {
            return Err("the viscosity of an oil falls with temperature".to_string());
        }
        let b = (y_cold - y_warm) / (warm.0 / cold.0).log10();
        let a = y_cold + b * cold.0.log10();
        let reach = (REACH.0 * span).min(REACH.1);
        let reaches = |viscosity: f64| 10f64.powf((a - ordinate(viscosity)) / b);
        Ok(Viscosity {
            a,
            b,
            points: [cold, warm],
            sure: (cold.0 - reach, warm.0 + reach),
            // a point at an end of the law is inside, whatever rounding says
            ends: (
                reaches(RANGE.1).min(cold.0),
                reaches(RANGE.0).min(CRACKS).max(warm.0),
            ),
        })
    }

    /// The viscosity of an ISO grade with a second measured point.
    ///
    /// - `grade`: ISO VG number
    /// - `second`: temperature in K and viscosity in m²/s of a second point
    ///
    /// Source: [`iso_grade_viscosity`], [`Viscosity::through`].
    /// Valid: as both; the grade leaves 10 % open.
    pub fn of_grade(grade: u32, second: (f64, f64)) -> Result<Self, String> {
        Viscosity::through((ICE_POINT + 40.0, iso_grade_viscosity(grade)?), second)
    }

    /// The viscosity known at one temperature alone.
    ///
    /// - `point`: temperature in K and viscosity in m²/s
    ///
    /// Source: the point.
    /// Valid: within 1 K of it: oils change by 4 to 6 % per K at 40 °C.
    pub fn single(point: (f64, f64)) -> Result<Self, String> {
        let near = (point.0 - SINGLE_REACH, point.0 + SINGLE_REACH);
        Ok(Viscosity {
            a: of_point(point)?,
            b: 0.0,
            points: [point; 2],
            sure: near,
            ends: near,
        })
    }

    /// A viscosity that does not follow the temperature, m²/s.
    ///
    /// Source: none.
    /// Valid: always.
    pub fn constant(viscosity: f64) -> Self {
        Viscosity {
            a: ordinate(viscosity * 1e6),
            b: 0.0,
            points: [(ICE_POINT, viscosity); 2],
            sure: (0.0, f64::INFINITY),
            ends: (0.0, f64::INFINITY),
        }
    }

    /// Kinematic viscosity at a temperature, m²/s, or why it is not known.
    ///
    /// Formula: lg lg Z = A - B lg T, Z of the module's page
    ///
    /// - `temperature`: T, K
    ///
    /// Source: ASTM D341, Ubbelohde and Walther (from memory).
    /// Valid: [`Viscosity::ends`], outside an error; beyond [`Viscosity::sure`] drawn on.
    pub fn at(&self, temperature: f64) -> Result<f64, String> {
        let (least, largest) = self.ends;
        let celsius = |kelvin: f64| kelvin - ICE_POINT;
        match (least..=largest).contains(&temperature) {
            true => Ok(self.held(temperature)),
            false if self.b == 0.0 => Err(format!(
                "{:.1} °C, and the one viscosity given, at {:.1} °C, says nothing of its slope: a second one at another temperature is needed",
                celsius(temperature),
                celsius(self.points[0].0)
            )),
            false => Err(format!(
                "{:.1} °C, where this oil has no viscosity: its line of ASTM D341 goes from {:.1} °C, 2e7 mm²/s, to {:.1} °C, 0.21 mm²/s or \
                 where oils crack",
                celsius(temperature),
                celsius(least),
                celsius(largest)
            )),
        }
    }

    /// The same in a time loop, m²/s, at a temperature in K; beyond [`Viscosity::ends`], which it looks at by itself, that at the end.
    ///
    /// Source: as [`Viscosity::at`].
    /// Valid: as [`Viscosity::at`].
    #[inline]
    pub fn held(&self, temperature: f64) -> f64 {
        let ten = std::f64::consts::LN_10;
        let temperature = temperature.clamp(self.ends.0, self.ends.1);
        let inner = Real::exp(self.a * ten - self.b * Real::ln(temperature));
        of_shifted(Real::exp(inner * ten) - 0.7) * 1e-6
    }

    /// Least and largest temperature near enough to the points, K.
    /// Source: the points.
    /// Valid: always.
    pub fn sure(&self) -> (f64, f64) {
        self.sure
    }

    /// Least and largest temperature of the law, K.
    ///
    /// Source: ASTM D341: 0.21 to 2e7 mm²/s (from memory); no oil above 350 °C.
    /// Valid: always.
    pub fn ends(&self) -> (f64, f64) {
        self.ends
    }

    /// How far a temperature is outside of [`Viscosity::sure`], K; 0 inside.
    ///
    /// - `temperature`: T, K
    ///
    /// Source: the points.
    /// Valid: always.
    pub fn beyond(&self, temperature: f64) -> f64 {
        let (least, largest) = self.sure;
        (least - temperature).max(temperature - largest).max(0.0)
    }

    /// What errors of 1 % at the points have grown to at a temperature, as a share of the viscosity: the worst of both signs at each.
    ///
    /// - `temperature`: T, K
    ///
    /// Source: derived.
    /// Valid: two points, which leave 1 % open each.
    pub fn error_at(&self, temperature: f64) -> f64 {
        let [cold, warm] = self.points;
        let right = self.held(temperature);
        let signs = [(1.01, 0.99), (0.99, 1.01), (1.01, 1.01), (0.99, 0.99)];
        let errors = signs.into_iter().filter_map(|(of_cold, of_warm)| {
            let wrong = Viscosity::through((cold.0, of_cold * cold.1), (warm.0, of_warm * warm.1));
            Some((wrong.ok()?.held(temperature) / right - 1.0).abs())
        });
        errors.fold(0.0, f64::max)
    }
}

/// lg lg Z of a point.
fn of_point((temperature, viscosity): (f64, f64)) -> Result<f64, String> {
    let (least, most) = RANGE;
    let possible =
        temperature.is_finite() && temperature > 0.0 && (least..=most).contains(&(viscosity * 1e6));
    if possible {
        Ok(ordinate(viscosity * 1e6))
    } else {
        Err(format!(
            "{} mm²/s at {:.2} °C: a viscosity from 0.21 to 2e7 mm²/s at a temperature above 0 K is needed",
            viscosity * 1e6,
            temperature - ICE_POINT
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let (least, largest) = oil.sure();
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
            let (least, largest) = right.sure();
            assert_eq!((least, largest), (celsius(10.0), celsius(130.0)));
            for (cold, warm) in [(1.01, 0.99), (0.99, 1.01), (1.01, 1.01)] {
                let wrong = data_sheet(at_40 * cold, at_100 * warm);
                for temperature in [least, celsius(120.0)] {
                    let (wrong, exact) = (
                        wrong.at(temperature).unwrap(),
                        right.at(temperature).unwrap(),
                    );
                    let error = (wrong / exact - 1.0).abs();
                    assert!(error < 0.05, "{at_40} {temperature}: {error}");
                    assert!(error <= right.error_at(temperature));
                }
            }
        }
    }
    #[test]
    fn beyond_its_data_the_line_goes_on_to_where_the_standard_ends() {
        let oil = data_sheet(32.0, 5.4);
        assert_eq!(oil.beyond(celsius(130.0)), 0.0);
        assert!((oil.beyond(celsius(-10.0)) - 20.0).abs() < 1e-9);
        assert!((oil.beyond(celsius(140.0)) - 10.0).abs() < 1e-9);
        // above 2 mm²/s it is the plain line, written here once more
        let y = |nu: f64| (nu + 0.7f64).log10().log10();
        let b = (y(32.0) - y(5.4)) / (celsius(100.0) / celsius(40.0)).log10();
        let plain = |t: f64| {
            let exponent = y(32.0) - b * (celsius(t) / celsius(40.0)).log10();
            10f64.powf(10f64.powf(exponent)) - 0.7
        };
        for t in [-30.0, 9.0, 60.0, 131.0, 160.0] {
            let ours = oil.at(celsius(t)).unwrap() / MM2_S;
            assert!(
                ours > 2.0 && (ours / plain(t) - 1.0).abs() < 1e-11,
                "{t}: {ours}"
            );
        }
        // below, the 0.7 alone would leave 0.3 mm²/s however hot; the ends are those of the standard
        let (coldest, hottest) = oil.ends();
        assert!((oil.at(coldest).unwrap() / 20.0 - 1.0).abs() < 1e-9);
        assert!((hottest - celsius(350.0)).abs() < 1e-9);
        let thin_oil = data_sheet(0.6, 0.3);
        assert!((thin_oil.at(thin_oil.ends().1).unwrap() / 0.21e-6 - 1.0).abs() < 1e-9);
        for temperature in [coldest - 0.1, hottest + 0.1, f64::NAN] {
            let refused = oil.at(temperature);
            assert!(
                refused
                    .unwrap_err()
                    .contains("where this oil has no viscosity")
            );
        }
        assert!((oil.held(hottest + 100.0) / oil.held(hottest) - 1.0).abs() < 1e-12);
        let message = oil.at(hottest + 1.0).unwrap_err().to_string();
        assert!(
            message.contains("351.0 °C") && message.contains("to 350.0 °C"),
            "{message}"
        );
        let single = Viscosity::single((celsius(40.0), 68.0 * MM2_S)).unwrap();
        assert!((single.at(celsius(40.9)).unwrap() / (68.0 * MM2_S) - 1.0).abs() < 1e-12);
        let message = single.at(celsius(41.5)).unwrap_err().to_string();
        assert!(
            message.contains("41.5 °C") && message.contains("a second one"),
            "{message}"
        );
    }
    #[test]
    fn thin_oils_follow_the_standards_full_form() {
        // Z = ν + 0.7 + exp(-1.47 - 1.84 ν - 0.51 ν²) as the standard has it, less its value at 2 mm²/s
        for nu in [0.21, 0.3, 0.5, 1.0, 1.5, 1.999] {
            let term = |nu: f64| (-1.47 - 1.84 * nu - 0.51 * nu * nu).exp();
            assert!(
                (of_shifted(nu + term(nu) - term(2.0)) / nu - 1.0).abs() < 1e-13,
                "{nu}"
            );
        }
        assert!((thin(THIN) - 7.5e-4).abs() < 0.1e-4);
        // continuous where the term begins, with less than a thousandth in its slope
        let [below, at, above] = [-1e-6, 0.0, 1e-6].map(|d| of_shifted(THIN + d));
        assert_eq!((at, above), (2.0, 2.0 + 1e-6));
        assert!(((at - below) / 1e-6 - 1.0).abs() < 4e-3);
        // without its value at 2 mm²/s subtracted ν would be less by less than 0.6 % at 0.21 mm²/s, the most
        let whole = |nu: f64| of_shifted(nu + thin(nu)) / nu - 1.0;
        assert!(
            whole(0.21) < 6e-3 && whole(0.21) > whole(1.0),
            "{}",
            whole(0.21)
        );
        // water from 0 to 100 °C is no oil, and its ends are still met by their own line
        let thin = Viscosity::through((celsius(20.0), 1.0 * MM2_S), (celsius(90.0), 0.33 * MM2_S));
        let thin = thin.unwrap();
        assert!((thin.at(celsius(20.0)).unwrap() / MM2_S - 1.0).abs() < 1e-12);
        assert!((thin.at(celsius(90.0)).unwrap() / (0.33 * MM2_S) - 1.0).abs() < 1e-12);
    }
    #[test]
    fn one_percent_at_the_points_grows_with_the_distance() {
        let oil = data_sheet(32.0, 5.4);
        let at = |t: f64| oil.error_at(celsius(t));
        assert!((at(40.0) - 0.01).abs() < 1e-9 && (at(100.0) - 0.01).abs() < 1e-9);
        assert!(at(70.0) < 0.02);
        // measured: 2.8 % at 10 °C, 1.8 % at 130 °C, 9 % at -30 °C
        let (near, far) = (at(10.0), at(-30.0));
        assert!((0.02..0.05).contains(&near), "{near}");
        assert!(far > 2.0 * near && far < 0.15, "{far}");
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
                point(100.0, 0.125),
                "0.125 mm²/s at 100.00 °C",
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
    fn an_oil_changes_by_four_to_six_percent_per_kelvin() {
        // what a single point claims of its kelvin
        let oil = data_sheet(100.0, 11.1);
        let per_kelvin = (oil.held(celsius(40.0)) / oil.held(celsius(41.0))).ln();
        assert!((0.04..0.06).contains(&per_kelvin), "{per_kelvin}");
    }
}
