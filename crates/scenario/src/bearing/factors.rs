//! What a file still needs for Palmgren's factors: the series in the name of its bearing, and all keys at once where that is not enough.

use crate::bearing::derive::{ANGLE, CONTACT_ANGLE, F0, F1_EXPONENT, F1_FACTOR, SERIES};
use crate::bearing::kind::BearingType;
use crate::bearing::moment::MomentLaw;
use crate::key::Key;
use crate::table;
use crate::values::{LAW, LUBRICATION, Values};
use physics::palmgren_factors::FACTORS;
use problem::{Code, Place, Problem};

impl Values {
    /// The series in the name of the bearing, as the tables call it, and how it was found.
    pub(super) fn series_by_name(&self) -> Option<(String, &'static str)> {
        let record = self.record.as_ref().map(|record| record.name.clone());
        let name = record.or_else(|| self.text("bearing.name"))?;
        match self.bearing_type() {
            BearingType::DeepGroove => Some((
                series_of(&name)?,
                "the name of a deep groove bearing without its bore code",
            )),
            // of the spindle bearings only these have a row: those of 15 deg and the lighter series have none
            BearingType::AngularContact => {
                (name.starts_with("SNFA E 2") && name.ends_with("25deg")).then(|| {
                    (
                        "02".to_string(),
                        "the dimension series of the spindle bearings SNFA E 2",
                    )
                })
            }
            BearingType::AngularContactDoubleRow | BearingType::FourPointContact => None,
        }
    }

    /// Keys of Palmgren's factors that have no value and that no table fills, while others are missing.
    pub fn missing_factors(&self) -> impl Iterator<Item = &'static str> {
        let palmgren = [MomentLaw::Palmgren, MomentLaw::PalmgrenPrinted].map(Some);
        let wanted = palmgren.contains(&self.chosen(LAW))
            && [F0, F1_FACTOR, F1_EXPONENT]
                .iter()
                .any(|path| self.lacks(path));
        let series = wanted && self.lacks(SERIES) && self.series_by_name().is_none();
        let lubrication = wanted && self.lacks(LUBRICATION);
        [(lubrication, LUBRICATION), (series, SERIES)]
            .into_iter()
            .filter_map(|(lacks, path)| lacks.then_some(path))
    }

    /// What factors by the tables need, all of it; else what is to be given by hand.
    pub(super) fn no_factor(&self, path: &str) -> Box<Problem> {
        let needed = table::key(path).map_or(String::new(), Key::needed);
        let kind = self.bearing_type().factor_type();
        let angle = self.number(ANGLE).or_else(|| self.number(CONTACT_ANGLE));
        let degrees = angle.map(f64::to_degrees);
        let holds = |angles: Option<[f64; 2]>| match (angles, degrees) {
            (Some([least, largest]), Some(angle)) => (least..=largest).contains(&angle),
            _ => true,
        };
        let series: Vec<&str> = (FACTORS.iter())
            .filter(|row| row.kind == kind && holds(row.angles_deg))
            .map(|row| row.series)
            .collect();
        let by_hand = "f0, f1_factor and f1_exponent are needed, all three";
        let hint = match (self.lacks(LUBRICATION), self.lacks(SERIES)) {
            (_, true) if series.is_empty() => format!(
                "No table has factors of a {kind} of {:.0} deg: {by_hand}",
                degrees.unwrap_or_default()
            ),
            (true, false) => format!("With {LUBRICATION} it is taken from the tables"),
            (lubrication, _) => format!(
                "With {SERIES}, one of {}{}, it is taken from the tables; else {by_hand}",
                series.join(", "),
                if lubrication {
                    format!(", and {LUBRICATION}")
                } else {
                    String::new()
                }
            ),
        };
        self.problem(Code::MissingKey, path, Place::Whole, "no value", needed)
            .with_hint(hint)
    }
}

/// The series in the name of a deep groove bearing: its digits without the bore code.
fn series_of(name: &str) -> Option<String> {
    let digits: String = name.chars().take_while(char::is_ascii_digit).collect();
    let series = match digits.len() {
        3 | 4 => &digits[..2],
        5 => &digits[..3],
        _ => return None,
    };
    Some(series.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_holds_its_series() {
        for (name, series) in [
            ("6005", Some("60")),
            ("6005 hybrid", Some("60")),
            ("607", Some("60")),
            ("61807", Some("618")),
            ("16005", Some("160")),
            ("SNFA EX 25", None),
            ("", None),
        ] {
            assert_eq!(series_of(name).as_deref(), series, "{name}");
        }
    }
}
