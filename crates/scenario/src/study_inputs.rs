//! The inputs of a study: which value differs, how, and on how many levels; bearings of the catalogue that fit an envelope.

use crate::bearing::source::{BearingRecord, BearingSource};
use crate::study_file::has_candidates;
use crate::{BuiltIn, Distribution, Scenario, Vary};
use problem::key::{Key, Kind, Range, quoted};
use problem::raw::{Raw, Written};
use problem::table::Table;
use problem::{Code, Problem, Result};

/// Levels of an input of a factorial or a sweep, unless given.
const LEVELS: usize = 5;
/// Inputs of an estimate, at most.
const MOST_ESTIMATED: usize = 5;
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

const DISTRIBUTION: Kind = Kind::Any("a distribution in the words of [vary] is needed");
const SIZES: &str = "bearing names with sizes of the catalogue are needed, e.g. catalogue = { bore_diameter = \"35 mm\", outer_diameter = [\"0 mm\", \"62 mm\"], type = \"deep groove\" }";
#[rustfmt::skip]
const KEYS: &[Key] = &[
    Key::new("input.path", Kind::Text, "contact.friction_coefficient", "Dotted path of a key of the scenario."),
    Key::new("input.levels", Kind::Count, "5", "Levels in a factorial, a sweep or a selection.").within(Range::FromTo(2.0, 1000.0)).optional("5; a choice has its texts, a selection draws what has no levels"),
    Key::new("input.catalogue", Kind::Any(SIZES), SIZES, "All bearings of these sizes.").optional("no choice of bearings"),
    Key::new("input.lognormal", DISTRIBUTION, "0.2", "Deviation of the logarithm.").optional("not so"),
    Key::new("input.normal", DISTRIBUTION, "0.1", "Standard deviation.").optional("not so"),
    Key::new("input.uniform", DISTRIBUTION, "[0.1, 0.3]", "Range.").optional("not so"),
    Key::new("input.triangular", DISTRIBUTION, "[0.1, 0.2, 0.3]", "Least, most probable and largest value.").optional("not so"),
    Key::new("input.choice", DISTRIBUTION, "[\"6005\", \"6006\"]", "One of these.").optional("not so"),
];

/// `catalogue = { bore_diameter = "35 mm", outer_diameter = ["0 mm", "62 mm"] }` as the choice of all bearings that fit.
fn fitting(table: &Table, raw: &Raw) -> Result<Raw> {
    let path = table.text("path").unwrap_or_default();
    let wrong = |found: String| table.problem(Code::WrongType, CATALOGUE, found, SIZES);
    let (true, Raw::Table(sizes)) = (path.ends_with("bearing.name"), raw) else {
        return Err(wrong(format!("{} of {}", raw.text(), quoted(path))));
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
            return Err(wrong(format!("{name} = {}", raw.text())));
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
    match names.is_empty() {
        true => Err(wrong(
            "sizes that no bearing of the built-in catalogue has".to_string(),
        )),
        false => Ok(Raw::List(names)),
    }
}

pub(super) fn inputs_of(
    file: &str,
    scenario: &Scenario,
    tables: &[Vec<Written>],
    kind: &str,
) -> Result<Vec<StudyInput>> {
    let mut inputs: Vec<StudyInput> = Vec::new();
    for written in tables {
        let table: Table =
            Table::read(file, ("input".to_string(), "[[input]]"), KEYS, written, &[])?;
        let wrong =
            |code, key: &str, found: String, allowed: &str| table.refuse(code, key, found, allowed);
        let path = table.text("path").unwrap_or_default();
        if inputs.iter().any(|known| known.vary.path == path) {
            return wrong(
                Code::Conflict,
                "path",
                quoted(path),
                "each input once is needed",
            );
        }
        let fitting = table
            .raw(CATALOGUE)
            .map(|raw| fitting(&table, raw))
            .transpose()?;
        let of_catalogue = fitting.as_ref().map(|names| ("choice", CATALOGUE, names));
        let of_words = WORDS
            .iter()
            .filter_map(|word| Some((*word, *word, table.raw(word)?)));
        let given: Vec<(&str, &str, &Raw)> = of_words.chain(of_catalogue).collect();
        let [(word, key, value)] = given.as_slice() else {
            let found = format!("{} distributions of {}", given.len(), quoted(path));
            return wrong(
                Code::Conflict,
                "path",
                found,
                &format!("one of {} is needed", WORDS.join(", ")),
            );
        };
        let distribution = Raw::Table(vec![(word.to_string(), (*value).clone())]);
        let vary = scenario
            .varied(path, &distribution, table.place_of(key))
            .map_err(|mut problem| {
                problem.file = file.to_string();
                problem.key = Some(format!("input.{word} of {path}"));
                if problem.code == Code::UnknownKey {
                    problem.key = Some("input.path".to_string());
                    problem.place = table.place_of("path");
                }
                problem
            })?;
        let given = table.count("levels");
        let choice = match &vary.distribution {
            Distribution::Choice(texts) => Some(texts.len()),
            _ => None,
        };
        let unused = match (
            ["factorial", "sweep"].contains(&kind) || has_candidates(kind),
            choice,
        ) {
            (false, _) => Some("levels are those of a factorial, a sweep or a selection"),
            (true, Some(_)) => Some("a choice has its texts as levels"),
            (true, None) => None,
        };
        if let (Some(allowed), Some(_)) = (unused, given) {
            return wrong(
                Code::UnusedKey,
                "levels",
                "a key that has no effect".to_string(),
                allowed,
            );
        }
        // what has no levels in a selection is drawn for every candidate
        let drawn = if has_candidates(kind) { 0 } else { LEVELS };
        inputs.push(StudyInput {
            levels: choice.or(given).unwrap_or(drawn),
            vary,
            written: format!("{word} {}", value.shown()),
            levels_given: given.is_some(),
        });
    }
    let missing =
        |found, allowed| Err(Problem::new(Code::MissingKey, file, found, allowed).on_key("input"));
    if has_candidates(kind) && inputs.iter().all(|input| input.levels == 0) {
        return missing(
            "nothing to choose",
            "a choice, or levels = 3 of a range, is needed of one input at least: these are the candidates",
        );
    }
    if inputs.is_empty() {
        return missing(
            "nothing",
            "a table [[input]] with path and distribution is needed for each value that differs from run to run",
        );
    }
    Ok(inputs)
}

/// Refuses an estimate without measured channels, or of inputs without bounds.
pub(super) fn estimable(file: &str, scenario: &Scenario, inputs: &[StudyInput]) -> Result<()> {
    let refuse = |key: &str, found: String, allowed: &str| {
        Err(Problem::new(Code::StudyDesign, file, found, allowed).on_key(key))
    };
    if scenario.measured.iter().all(|own| own.drop > 1) {
        let found = "a scenario without measured channels of drop 1".to_string();
        let allowed = "tables [[measured]] of it are needed: an estimate compares with them";
        return refuse("scenario", found, allowed);
    }
    let bounded =
        |input: &&StudyInput| !matches!(input.vary.distribution, Distribution::Uniform(..));
    if let Some(input) = inputs.iter().find(bounded) {
        let found = format!("{} of {}", input.written, input.vary.path);
        let allowed = "bounds are needed of each input of an estimate, e.g. uniform = [0.1, 0.3]";
        return refuse("input", found, allowed);
    }
    if inputs.len() > MOST_ESTIMATED {
        let found = format!("{} inputs", inputs.len());
        let allowed = format!("at most {MOST_ESTIMATED} are estimated at once");
        return refuse("input", found, &allowed);
    }
    Ok(())
}
