//! A lubricant written as a text: `grease: 100 mm^2/s at 40 degC, 11 mm^2/s at 100 degC`, `ISO VG 68`, `100 mm^2/s`.

use physics::viscosity::{ICE_POINT, Viscosity, iso_grade_viscosity};
use units::{Unit, parse_quantity};

problem::warnings! {
    /// Of lubricants.
    pub enum LubricantWarning {
        Drawn { key: words, how: words } "AB2313" [DRAWN_ON] Uncertain ("{key}: the viscosity of the lubricant is extrapolated: {how}.");
        DrawnOf { lubricant: text, how: words } "AB2313" Uncertain ("The viscosity of {lubricant} is extrapolated: {how}.");
        DrawnSince { time: "s", since: words, how: words, temperature: "K", at: words } "AB2313" Uncertain, coast_down
            ("The viscosity of the lubricant is extrapolated {since}: {how}{at}.");
    }
}

/// How far an oil is drawn on at a temperature beyond its data, K, in words.
pub fn drawn_on(oil: &Viscosity, temperature: f64) -> String {
    let (least, largest) = oil.sure();
    let [now, least, largest] = [temperature, least, largest].map(|kelvin| kelvin - ICE_POINT);
    let viscosity = 1e6 * oil.held(temperature);
    let digits = if viscosity < 100.0 { 2 } else { 0 };
    let held = match oil.at(temperature) {
        Ok(_) => "",
        Err(_) => ", its end, and held there",
    };
    format!(
        "{now:.0} °C is {:.0} K beyond the temperatures near its data ({least:.0} to {largest:.0} °C), and the line of ASTM D341 is drawn on to \
         {viscosity:.digits$} mm²/s{held}, where 1 % at the data has grown to {:.1} %",
        oil.beyond(temperature).ceil(),
        100.0 * oil.error_at(temperature)
    )
}

/// A lubricant to compare.
#[derive(Clone, Debug, PartialEq)]
pub struct Lubricant {
    /// Name, or the text itself where it has none.
    pub name: String,
    /// What is known of its viscosity.
    pub viscosity: LubricantViscosity,
}

/// What is known of the viscosity of a lubricant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LubricantViscosity {
    /// At the running temperature, m²/s.
    Running(f64),
    /// Over temperature.
    OverTemperature(Viscosity),
}

/// What a part of the text says.
enum Part {
    Running(f64),
    /// Temperature, K, and viscosity, m²/s.
    Point(f64, f64),
}

impl Lubricant {
    /// Reads the text, or says what is wrong with it.
    pub fn parse(text: &str) -> Result<Lubricant, String> {
        let (name, body) = match text.split_once(':') {
            Some((name, body)) => (name.trim(), body),
            None => (text.trim(), text),
        };
        let parts = body.split(',').map(|part| part_of(part.trim()));
        let parts = parts.collect::<Result<Vec<Part>, String>>()?;
        let viscosity = match parts.as_slice() {
            [Part::Running(viscosity)] => LubricantViscosity::Running(*viscosity),
            [Part::Point(temperature, viscosity)] => LubricantViscosity::OverTemperature(
                Viscosity::single((*temperature, *viscosity)).map_err(|error| error.to_string())?,
            ),
            [Part::Point(one, at_one), Part::Point(other, at_other)] => {
                LubricantViscosity::OverTemperature(
                    Viscosity::through((*one, *at_one), (*other, *at_other))
                        .map_err(|error| error.to_string())?,
                )
            }
            parts => {
                return Err(format!(
                    "{} parts that give no viscosity together",
                    parts.len()
                ));
            }
        };
        Ok(Lubricant {
            name: name.to_string(),
            viscosity,
        })
    }

    /// Viscosity at a temperature in K, or at a running temperature that is not told, m²/s; else why it is not known.
    pub fn at(&self, temperature: Option<f64>) -> Result<f64, String> {
        match (self.viscosity, temperature) {
            (LubricantViscosity::Running(viscosity), _) => Ok(viscosity),
            (LubricantViscosity::OverTemperature(viscosity), Some(temperature)) => {
                viscosity.at(temperature).map_err(|error| error.to_string())
            }
            (LubricantViscosity::OverTemperature(_), None) => {
                Err("bearing.moment.temperature is not given".to_string())
            }
        }
    }
}

fn part_of(text: &str) -> Result<Part, String> {
    if let Some(grade) = text.strip_prefix("ISO VG ") {
        let grade = grade
            .trim()
            .parse()
            .map_err(|_| format!("\"{text}\", which is no ISO grade"))?;
        let viscosity = iso_grade_viscosity(grade).map_err(|error| error.to_string())?;
        return Ok(Part::Point(ICE_POINT + 40.0, viscosity));
    }
    match text.split_once(" at ") {
        Some((viscosity, temperature)) => Ok(Part::Point(
            quantity(temperature, "K")?,
            quantity(viscosity, "m^2/s")?,
        )),
        None => Ok(Part::Running(quantity(text, "m^2/s")?)),
    }
}

/// A positive quantity in SI.
fn quantity(text: &str, unit: &str) -> Result<f64, String> {
    let quantity = parse_quantity(text.trim()).map_err(|error| error.to_string())?;
    let wanted = Unit::parse(unit).ok().map(|unit| unit.dimension());
    if wanted == Some(quantity.dimension) && quantity.value_si > 0.0 {
        Ok(quantity.value_si)
    } else {
        Err(format!(
            "\"{}\" where {unit} above 0 is needed",
            text.trim()
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str, celsius: f64) -> Result<f64, String> {
        Lubricant::parse(text)?.at(Some(ICE_POINT + celsius))
    }

    #[test]
    fn forms_of_a_lubricant() {
        // the points themselves come back to rounding
        let near = |found: Result<f64, String>, si: f64| (found.unwrap() / si - 1.0).abs() < 1e-9;
        assert!(near(at("100 mm^2/s", 300.0), 1e-4));
        assert!(near(at("ISO VG 68", 40.0), 68e-6));
        let oil = "ISO VG 68, 8.7 mm^2/s at 100 degC";
        assert!(near(at(oil, 40.0), 68e-6) && near(at(oil, 100.0), 8.7e-6));
        assert_eq!(Lubricant::parse(oil).unwrap().name, oil);
        let grease = "grease: 100 mm^2/s at 40 degC, 11 mm^2/s at 100 degC";
        assert!(near(at(grease, 100.0), 11e-6));
        assert_eq!(Lubricant::parse(grease).unwrap().name, "grease");
    }

    #[test]
    fn what_is_no_lubricant_is_told() {
        for (text, told) in [
            ("ISO VG 99", "99"),
            ("ISO VG thick", "no ISO grade"),
            ("100 mm", "m^2/s"),
            ("100", "unit"),
            ("100 mm^2/s, 11 mm^2/s at 100 degC", "2 parts"),
            ("11 mm^2/s at 40 degC, 100 mm^2/s at 100 degC", "fall"),
            ("", ""),
        ] {
            let why = Lubricant::parse(text).unwrap_err();
            assert!(why.contains(told), "{text}: {why}");
        }
        let untold = at("ISO VG 68", 60.0).unwrap_err();
        assert!(untold.contains("a second one"), "{untold}");
        let untold = Lubricant::parse("ISO VG 68").unwrap().at(None);
        assert!(untold.unwrap_err().contains("bearing.moment.temperature"));
    }
}
