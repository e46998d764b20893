//! The inputs of a study: which value differs, how, and on how many levels; bearings of the catalogue that fit an envelope.

use crate::scenario::bearing::source::{BearingRecord, BearingSource};
use crate::scenario::document::Raw;
use crate::scenario::key::quoted;
use crate::scenario::raw::Written;
use crate::scenario::study_section::{Page, Section};
use crate::scenario::{BuiltIn, Scenario, Vary};
use problem::{Code, Place, Problem};

/// Levels of an input of a factorial or a sweep, unless given.
const LEVELS: usize = 5;
const WORDS: [&str; 5] = ["lognormal", "normal", "uniform", "triangular", "choice"];
/// Bearings by their dimensions.
const CATALOGUE: &str = "catalogue";
/// What a catalogue says of a bearing in words.
const WORDS_OF_BEARINGS: [&str; 2] = ["type", "ball_material"];
/// Sizes that are equal to this share are one.
const SAME: f64 = 1e-6;

/// An input of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyInput {
    /// Its path and distribution.
    pub vary: Vary,
    /// The distribution as the file has it, in its units.
    pub written: String,
    /// Levels in a factorial, a sweep or a selection; 0 of what a selection draws.
    pub levels: usize,
    /// Whether the file gives them.
    levels_given: bool,
}

impl StudyInput {
    /// Whether the file gives its levels.
    pub(super) fn has_levels(&self) -> bool {
        self.levels_given
    }
}

/// `catalogue = { bore_diameter = "35 mm", outer_diameter = ["0 mm", "62 mm"] }` as the choice of all bearings that fit.
fn fit(section: &mut Section, path: &str) -> Result<(), Box<Problem>> {
    let Some(at) = section.list.iter().position(|(key, ..)| key == CATALOGUE) else {
        return Ok(());
    };
    let (_, raw, place) = section.list[at].clone();
    let needed = "bearing names with sizes of the catalogue are needed, e.g. catalogue = { bore_diameter = \"35 mm\", outer_diameter = [\"0 mm\", \"62 mm\"], type = \"deep groove\" }";
    let wrong = |section: &Section, found: String| {
        section.wrong(Code::WrongType, place, CATALOGUE, found, needed)
    };
    let (true, Raw::Table(sizes)) = (path.ends_with("bearing.name"), &raw) else {
        return Err(wrong(
            section,
            format!("{} of {}", raw.text(), quoted(path)),
        ));
    };
    let (mut bounds, mut words) = (Vec::new(), Vec::new());
    for (name, raw) in sizes {
        if let (true, Raw::Text(word)) = (WORDS_OF_BEARINGS.contains(&name.as_str()), raw) {
            words.push((name.clone(), word.clone()));
            continue;
        }
        let one = |raw: &Raw| match raw {
            Raw::Text(text) => units::parse_quantity(text).ok().map(|found| found.value_si),
            Raw::Integer(_, Some(value)) => Some(*value as f64),
            _ => None,
        };
        let range = match raw {
            Raw::List(list) if list.len() == 2 => one(&list[0]).zip(one(&list[1])),
            single => one(single).map(|value| (value, value)),
        };
        let Some((least, most)) = range else {
            return Err(wrong(section, format!("{name} = {}", raw.text())));
        };
        bounds.push((name.clone(), least * (1.0 - SAME), most * (1.0 + SAME)));
    }
    let fits = |record: &BearingRecord| {
        let says = words.iter().all(|(name, word)| {
            let known = record.words.iter().find(|(known, ..)| known == name);
            known.is_some_and(|(_, known, _)| known == word)
        });
        says && bounds.iter().all(|(name, least, most)| {
            let known = record.values.iter().find(|(known, ..)| known == name);
            known.is_some_and(|(_, value, _)| (*least..=*most).contains(value))
        })
    };
    let names = BuiltIn.names().into_iter();
    let names: Vec<Raw> = names
        .filter(|name| BuiltIn.find(name).is_some_and(|record| fits(&record)))
        .map(Raw::Text)
        .collect();
    if names.is_empty() {
        return Err(wrong(
            section,
            "sizes that no bearing of the built-in catalogue has".to_string(),
        ));
    }
    section.list[at] = ("choice".to_string(), Raw::List(names), place);
    Ok(())
}

pub(super) fn inputs_of(
    page: &Page,
    scenario: &Scenario,
    tables: Vec<Vec<Written>>,
    kind: &str,
) -> Result<Vec<StudyInput>, Box<Problem>> {
    let mut inputs: Vec<StudyInput> = Vec::new();
    for list in tables {
        let mut section = Section::new(page, "input");
        section.list = list;
        let mut keys = vec!["path", "levels", CATALOGUE];
        keys.extend(WORDS);
        section.known(&keys, &[])?;
        let begin = section
            .list
            .first()
            .map_or(Place::Whole, |(.., place)| *place);
        let (path, place) = section.text("path")?.ok_or_else(|| {
            let allowed = "path = \"contact.friction_coefficient\" is needed: the dotted path of a key of the scenario";
            section.wrong(Code::MissingKey, begin, "path", "nothing", allowed)
        })?;
        if inputs.iter().any(|known| known.vary.path == path) {
            return Err(section.wrong(
                Code::Conflict,
                place,
                "path",
                quoted(&path),
                "each input once is needed",
            ));
        }
        fit(&mut section, &path)?;
        let given: Vec<&Written> = section
            .list
            .iter()
            .filter(|(key, ..)| WORDS.contains(&key.as_str()))
            .collect();
        let [(word, value, at)] = given.as_slice() else {
            let found = format!("{} distributions of {}", given.len(), quoted(&path));
            let allowed = format!("one of {} is needed", WORDS.join(", "));
            return Err(section.wrong(Code::Conflict, place, "path", found, allowed));
        };
        let distribution = Raw::Table(vec![(word.clone(), value.clone())]);
        let vary = scenario
            .varied(&path, &distribution, *at)
            .map_err(|mut problem| {
                problem.file = page.file.to_string();
                problem.key = Some(format!("input.{word} of {path}"));
                if problem.code == Code::UnknownKey {
                    (problem.key, problem.place) = (Some("input.path".to_string()), place);
                }
                problem
            })?;
        let levelled = ["factorial", "sweep", "selection"].contains(&kind);
        let given = section.count("levels")?;
        let levels = match (&vary.distribution, given) {
            (_, Some((_, place))) if !levelled => {
                let allowed = "levels are those of a factorial, a sweep or a selection";
                return Err(section.wrong(
                    Code::UnusedKey,
                    place,
                    "levels",
                    "a key that has no effect",
                    allowed,
                ));
            }
            (crate::scenario::Distribution::Choice(_), Some((_, place))) => {
                let allowed = "a choice has its texts as levels";
                return Err(section.wrong(
                    Code::UnusedKey,
                    place,
                    "levels",
                    "a key that has no effect",
                    allowed,
                ));
            }
            (crate::scenario::Distribution::Choice(texts), None) => texts.len(),
            (_, Some((levels, place))) if !(2..=1000).contains(&levels) => {
                let allowed = "a whole number from 2 to 1000 is needed";
                return Err(section.wrong(
                    Code::OutOfRange,
                    place,
                    "levels",
                    levels.to_string(),
                    allowed,
                ));
            }
            // what has no levels in a selection is drawn for every candidate
            (_, None) if kind == "selection" => 0,
            (_, given) => given.map_or(LEVELS, |(levels, _)| levels),
        };
        inputs.push(StudyInput {
            vary,
            written: format!("{word} {}", value.shown()),
            levels,
            levels_given: given.is_some(),
        });
    }
    if kind == "selection" && inputs.iter().all(|input| input.levels == 0) {
        let allowed = "a choice, or levels = 3 of a range, is needed of one input at least: these are the candidates";
        return Err(page.problem(
            Code::MissingKey,
            Place::Whole,
            "input",
            "nothing to choose",
            allowed,
        ));
    }
    if inputs.is_empty() {
        let allowed = "a table [[input]] with path and distribution is needed for each value that differs from run to run";
        return Err(page.problem(Code::MissingKey, Place::Whole, "input", "nothing", allowed));
    }
    Ok(inputs)
}
