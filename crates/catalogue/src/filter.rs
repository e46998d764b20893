//! Which bearings a list shows.

use super::bearing::Bearing;
use super::draft::{Read, Reader};
use super::key;
use problem::key::Kind;
use problem::raw::Raw;
use problem::read::Reader as ValueReader;
use problem::{Code, Place, Problem, Result, did_you_mean};
use std::collections::BTreeMap;

/// How far a bore may be from the one asked for and still be it: inches converted to a tenth of a micrometre.
const SAME_LENGTH: f64 = 1e-7;

/// What a list is asked for, as typed.
#[derive(Clone, Copy, Debug, Default)]
pub struct FilterTexts<'a> {
    /// Bore: `"25 mm"`, or a range `"20 mm..30 mm"`, of which one end may be left out.
    pub bore: Option<&'a str>,
    /// Least limiting speed: `"20000 rpm"`.
    pub speed: Option<&'a str>,
    /// Type of bearing: `"deep groove"`.
    pub kind: Option<&'a str>,
    /// Material of the balls: `"silicon nitride"`.
    pub material: Option<&'a str>,
}

/// Which bearings are wanted; the default wants all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Filter {
    bore: Option<(f64, f64)>,
    speed: Option<f64>,
    kind: Option<String>,
    material: Option<String>,
}

impl Filter {
    /// Reads what was typed; `place` stands for the file in messages, and keys appear as `--bore`.
    pub fn read(texts: &FilterTexts<'_>, place: &str) -> Result<Filter> {
        let reader = Reader {
            text: "",
            file: place,
            built_in: false,
            sources: BTreeMap::new(),
        };
        let bore = texts.bore.map(|text| range(&reader, text)).transpose();
        let speed = texts
            .speed
            .map(|text| quantity(&reader, "limiting_speed", text, "--speed"))
            .transpose();
        let word = |key, text: Option<&str>, option| {
            let word = text.map(|text| one_of(&reader, key, text, option));
            word.transpose()
        };
        let whole = |mut problem: Box<Problem>| {
            problem.place = Place::Whole;
            problem
        };
        Ok(Filter {
            bore: bore.map_err(whole)?,
            speed: speed.map_err(whole)?,
            kind: word("type", texts.kind, "--type").map_err(whole)?,
            material: word("ball_material", texts.material, "--material").map_err(whole)?,
        })
    }

    /// Whether a bearing is wanted. One that does not say is not wanted.
    pub fn wants(&self, bearing: &Bearing) -> bool {
        let bore = self.bore.is_none_or(|(least, most)| {
            let bore = bearing.number("bore_diameter");
            bore.is_some_and(|bore| bore >= least - SAME_LENGTH && bore <= most + SAME_LENGTH)
        });
        let speed = self.speed.is_none_or(|least| {
            let speed = bearing.number("limiting_speed");
            // what the conversion from rpm may cost
            speed.is_some_and(|speed| speed >= least * (1.0 - 1e-12))
        });
        let word = |wanted: &Option<String>, key| {
            let wanted = wanted.as_deref();
            wanted.is_none_or(|wanted| bearing.word(key) == Some(wanted))
        };
        bore && speed && word(&self.kind, "type") && word(&self.material, "ball_material")
    }
}

fn range(reader: &Reader<'_>, text: &str) -> Read<(f64, f64)> {
    let one = |text: &str| quantity(reader, "bore_diameter", text, "--bore");
    let Some((from, to)) = text.split_once("..") else {
        let bore = one(text)?;
        return Ok((bore, bore));
    };
    let end = |text: &str, open| match text.trim() {
        "" => Ok(open),
        text => one(text),
    };
    let (from, to) = (end(from, 0.0)?, end(to, f64::INFINITY)?);
    if from <= to {
        return Ok((from, to));
    }
    Err(reader.problem(
        Code::OutOfRange,
        0,
        "--bore",
        format!("\"{text}\""),
        "a range from the smaller to the larger bore is needed, e.g. \"20 mm..30 mm\"",
    ))
}

fn quantity(reader: &Reader<'_>, name: &str, text: &str, option: &str) -> Read<f64> {
    let Some(key) = key::find(name) else {
        return Ok(0.0);
    };
    let raw = Raw::Text(text.trim().to_string());
    let read = ValueReader::of(reader.file, option).read_raw(key, &raw, Place::Whole);
    let (value, _) = read.map_err(|mut problem| {
        // What may be meant by a bare number is the unit of makers' tables.
        if problem.code == Code::BareNumber {
            let unit = if key.unit() == "m" { "mm" } else { "rpm" };
            problem.hint = Some(format!("Did you mean \"{} {unit}\"?", text.trim()));
        }
        problem
    })?;
    Ok(value.number().unwrap_or_default())
}

fn one_of(reader: &Reader<'_>, name: &str, text: &str, option: &str) -> Read<String> {
    let key = key::find(name);
    let Some((key, Kind::Word(words))) = key.map(|key| (key, key.kind)) else {
        return Ok(text.to_string());
    };
    if let Some(word) = words
        .iter()
        .find(|word| word.eq_ignore_ascii_case(text.trim()))
    {
        return Ok((*word).to_string());
    }
    let found = format!("\"{text}\"");
    let mut problem = reader.problem(Code::UnknownWord, 0, option, found, key.needed());
    problem.hint = did_you_mean(text, words.iter().copied());
    Err(problem)
}
