//! What results must hold: `[[limit]]`.
//!
//! ```toml
//! [[limit]]
//! quantity = "drive_end.peak_contact_force"   # a result; "*.peak_contact_force" is that of every bearing
//! most = "5 kN"                               # or least
//! share = 0.95                                # of the members of a repeated run; 1 unless given
//! source = "three quarters of the bolts"      # where the bound comes from, for the document of a qualification
//!
//! [[limit]]
//! severity = "destroys"                       # no warning that severe or worse; warning = "AB2030": none of that code
//! ```
//! An override is `--set limit.drive_end.peak_contact_force.most="4 kN"`: it changes the limit of that result, or adds one.
//! Whether a run has such a result is known when its machine is built: `crates/outcome/src/limits.rs`.

use crate::document::Document;
use crate::drop::case::Cases;
use crate::locate::UNNAMED;
use crate::renamed::present_name;
use crate::several::LIMIT;
use problem::key::{Key, Kind, quoted};
use problem::raw::{Raw, Written};
use problem::read::unreadable;
use problem::table::Table;
use problem::warning::Severity;
use problem::{Code, Place, Problem, Result, did_you_mean, question};
use units::{Dimension, parse_quantity};

/// What a result must hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Name of the result.
    pub quantity: String,
    /// The side on which it must stay.
    pub side: Side,
    /// The bound, SI.
    pub bound: f64,
    /// Share of the members of a repeated run that must hold it; 1: all of them.
    pub share: f64,
    /// The case in which it must hold; in each without.
    pub case: Option<String>,
    /// Where the bound comes from, in words.
    pub source: Option<String>,
    /// Warnings that must not come: the result is then their number in a member, 0 or 1.
    pub forbids: Option<Forbidden>,
    /// Dimension of the bound.
    pub dimension: Dimension,
    /// The bound as a file has it.
    pub text: String,
    /// Where the result is named.
    pub place: Place,
    /// Where the bound stands.
    pub bound_place: Place,
}

/// Warnings that must not come.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Forbidden {
    /// Those of a code.
    Code(String),
    /// Those of a severity or worse.
    Severity(Severity),
}

impl Forbidden {
    /// Key and value in a file.
    pub fn written(&self) -> (&'static str, &str) {
        match self {
            Forbidden::Code(code) => (WARNING, code),
            Forbidden::Severity(severity) => (SEVERITY, severity.word()),
        }
    }

    /// Whether a warning of this code and severity is one of them.
    pub fn meets(&self, code: &str, severity: Severity) -> bool {
        match self {
            Forbidden::Code(own) => own == code,
            Forbidden::Severity(least) => severity <= *least,
        }
    }
}

/// The side of a bound on which a result must stay; the bound itself holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Not above it.
    Most,
    /// Not below it.
    Least,
}

impl Side {
    /// The word in a file.
    pub fn word(self) -> &'static str {
        match self {
            Side::Most => "most",
            Side::Least => "least",
        }
    }

    /// Whether a value stays on this side of a bound.
    pub fn holds(self, value: f64, bound: f64) -> bool {
        match self {
            Side::Most => value <= bound,
            Side::Least => value >= bound,
        }
    }
}

const WARNING: &str = "warning";
const SEVERITY: &str = "severity";
const NEEDED: &str = "tables [[limit]] with quantity = \"…\" and most or least, or with warning or severity, are needed";
const BOUND: &str = "a quantity with the unit of the result is needed, e.g. most = \"5 kN\"; a bare number where it has none";
const SHARE: &str = "a share above 0 and not above 1 is needed, e.g. 0.95";
#[rustfmt::skip]
const KEYS: &[Key] = &[
    Key::new("limit.quantity", Kind::Text, "peak_contact_force", "Name of the result.").optional("a warning or a severity is limited"),
    Key::new("limit.most", Kind::Any(BOUND), "5 kN", "Most that it may be.").optional("it is bounded below"),
    Key::new("limit.least", Kind::Any(BOUND), "1 mm", "Least that it may be.").optional("it is bounded above"),
    Key::new("limit.warning", Kind::Text, "AB2030", "Code of a warning that must not come.").optional("a result is limited"),
    Key::new("limit.severity", Kind::Text, "destroys", "Severity of which, or worse, no warning must come: destroys, invalid, uncertain or note.").optional("a result is limited"),
    Key::new("limit.case", Kind::Text, "axis lost", "Name of the case in which it must hold, as run.case has it.").optional("in every case"),
    Key::new("limit.source", Kind::Text, "drawing 4711", "Where the bound comes from: a standard, a drawing, a contract.").optional("the document of a qualification says that it has none"),
    Key::new("limit.share", Kind::Any(SHARE), "0.95", "Share of the members of a repeated run that must hold it.").optional("all of them"),
];
/// Words that people write for those of a limit.
const SYNONYMS: [(&[&str], &str); 2] = [
    (&["max", "maximum", "at_most"], "most"),
    (&["min", "minimum", "at_least"], "least"),
];

impl Limit {
    /// The same of another result.
    pub fn of(&self, quantity: &str) -> Limit {
        Limit {
            quantity: quantity.to_string(),
            ..self.clone()
        }
    }

    /// The limit as a file has it.
    pub fn toml(&self) -> String {
        let mut share = match self.share {
            1.0 => String::new(),
            share => format!("share = {}\n", units::number_text(share)),
        };
        if let Some(case) = &self.case {
            share.push_str(&format!("case = {}\n", quoted(case)));
        }
        if let Some(source) = &self.source {
            share.push_str(&format!("source = {}\n", quoted(source)));
        }
        if let Some((key, value)) = self.forbids.as_ref().map(Forbidden::written) {
            return format!("[[{LIMIT}]]\n{key} = {}\n{share}", quoted(value));
        }
        format!(
            "[[{LIMIT}]]\nquantity = {}\n{} = {}\n{share}",
            quoted(&self.quantity),
            self.side.word(),
            self.text
        )
    }

    /// A problem with the name of the result.
    pub fn problem(&self, code: Code, found: String, allowed: String) -> Box<Problem> {
        let problem = Problem::new(code, UNNAMED, found, allowed);
        let key = (self.forbids.as_ref()).map_or("quantity", |forbids| forbids.written().0);
        problem.at(self.place).on_key(format!("{LIMIT}.{key}"))
    }

    /// A problem with the bound.
    pub fn bound_problem(&self, code: Code, found: String, allowed: String) -> Box<Problem> {
        let problem = Problem::new(code, UNNAMED, found, allowed);
        let key = format!("{LIMIT}.{}", self.side.word());
        problem.at(self.bound_place).on_key(key)
    }
}

/// The limits of a file; those of overrides change or follow them.
pub fn of(document: &Document, cases: &Cases) -> Result<Vec<Limit>> {
    let mut limits: Vec<Limit> = Vec::new();
    for written in &document.limits {
        let table = read(document, written)?;
        let share = share_of(document, &table)?;
        let case = case_of(&table, cases)?;
        if let Some(limit) = forbidding(&table, share)? {
            limits.retain(|known| table.place != Place::Set || known.quantity != limit.quantity);
            limits.push(limit);
            continue;
        }
        let quantity = &present_name(table.text("quantity").unwrap_or_default().trim());
        let changes = table.place == Place::Set;
        let own = |limit: &&mut Limit| {
            changes && limit.quantity == *quantity && (case.is_none() || limit.case == case)
        };
        let side = [Side::Most, Side::Least]
            .into_iter()
            .find(|side| table.raw(side.word()).is_some());
        let Some(side) = side else {
            let mut known = limits.iter_mut().filter(own).peekable();
            if share.is_none() || known.peek().is_none() {
                let found = format!("a limit of {quantity} without most or least");
                return table.refuse(Code::MissingKey, "", found, NEEDED);
            }
            known.for_each(|limit| limit.share = share.unwrap_or(limit.share));
            continue;
        };
        if side == Side::Most && table.raw("least").is_some() {
            let found = "both most and least in one limit";
            let allowed = "one of them is needed; a second [[limit]] takes the other";
            return table.refuse(Code::Conflict, "least", found, allowed);
        }
        let (bound, dimension, text) = bound_of(&table, side.word())?;
        let bound_place = table.place_of(side.word());
        match limits
            .iter_mut()
            .find(|limit| own(limit) && limit.side == side)
        {
            Some(limit) => {
                (limit.bound, limit.dimension, limit.text) = (bound, dimension, text);
                limit.bound_place = bound_place;
            }
            None => limits.push(Limit {
                quantity: quantity.to_string(),
                side,
                bound,
                share: share.unwrap_or(1.0),
                case: case.clone(),
                source: table.text("source").map(str::to_string),
                forbids: None,
                dimension,
                text,
                place: table.place_of("quantity"),
                bound_place,
            }),
        }
    }
    Ok(limits)
}

/// A limit of warnings: at most 0 of them in a member. None where a result is limited.
fn forbidding(table: &Table, share: Option<f64>) -> Result<Option<Limit>> {
    let refused =
        |code, key: &str, found: String, needed: &str| table.refuse(code, key, found, needed);
    let given = |key: &&str| table.text(key).is_some() || table.raw(key).is_some();
    let all = ["quantity", WARNING, SEVERITY];
    let mut keys = all.into_iter().filter(given);
    let (first, second) = (keys.next(), keys.next());
    if let (Some(first), Some(second)) = (first, second) {
        let found = format!("{first} and {second} in one limit");
        return refused(Code::Conflict, second, found, NEEDED);
    }
    let key = match first {
        None => {
            let found = "no value".to_string();
            return refused(Code::MissingKey, "quantity", found, NEEDED);
        }
        Some("quantity") => return Ok(None),
        Some(key) => key,
    };
    if let Some(bound) = ["most", "least"].into_iter().find(given) {
        let found = format!("{bound} beside {key}");
        let needed = "no bound is needed: the limit holds when no such warning comes";
        return refused(Code::Conflict, bound, found, needed);
    }
    let word = table.text(key).unwrap_or_default().trim();
    let forbids = match (key, Severity::of_word(&word.to_lowercase())) {
        (WARNING, _) => Forbidden::Code(word.to_uppercase()),
        (_, Some(severity)) => Forbidden::Severity(severity),
        (_, None) => {
            let words = Severity::ALL.map(Severity::word);
            let needed = format!("one of {} is needed", words.join(", "));
            let hint = did_you_mean(word, words);
            let problem = table.problem(Code::UnknownWord, key, quoted(word), needed);
            return Err(problem.with_hint(hint));
        }
    };
    let (key, word) = forbids.written();
    Ok(Some(Limit {
        quantity: format!("{key}.{word}"),
        side: Side::Most,
        bound: 0.0,
        share: share.unwrap_or(1.0),
        case: table.text("case").map(str::to_string),
        source: table.text("source").map(str::to_string),
        dimension: Dimension::NONE,
        text: "0".to_string(),
        place: table.place_of(key),
        bound_place: table.place_of(key),
        forbids: Some(forbids),
    }))
}

fn read(document: &Document, written: &[Written]) -> Result<Table> {
    let table = Table::read(
        &document.file,
        (LIMIT.to_string(), "[[limit]]"),
        KEYS,
        written,
        &[],
    );
    table.map_err(|mut problem| {
        let last = problem
            .key
            .as_deref()
            .and_then(|key| key.rsplit('.').next());
        let meant = SYNONYMS
            .iter()
            .find(|(words, _)| last.is_some_and(|last| words.contains(&last)));
        if let Some((_, right)) = meant {
            problem.hint = question(&[right]);
        }
        problem
    })
}

/// The case in which it must hold.
fn case_of(table: &Table, cases: &Cases) -> Result<Option<String>> {
    let Some(case) = table.text("case") else {
        return Ok(None);
    };
    if cases.names.iter().any(|name| name == case) {
        return Ok(Some(case.to_string()));
    }
    let allowed = match cases.names.as_slice() {
        [] => "no case is needed: [[event]] and [base] name none".to_string(),
        names => format!("one of the cases {} is needed", names.join(", ")),
    };
    let problem = table.problem(Code::UnknownWord, "case", quoted(case), allowed);
    let names = cases.names.iter().map(String::as_str);
    Err(problem.with_hint(did_you_mean(case, names)))
}

/// The share of the members, of systems whose runs are repeated.
fn share_of(document: &Document, table: &Table) -> Result<Option<f64>> {
    let Some(raw) = table.raw("share") else {
        return Ok(None);
    };
    let wrong = |code, found: String, allowed| table.refuse(code, "share", found, allowed);
    if !document.system.falls() {
        let found = "a key that has no effect".to_string();
        let allowed =
            "it is used only with system = \"drop\" or \"machine\", whose runs are repeated";
        return wrong(Code::UnusedKey, found, allowed);
    }
    match amount(raw) {
        Ok((value, Dimension::NONE, _)) if value > 0.0 && value <= 1.0 => Ok(Some(value)),
        Ok((_, Dimension::NONE, _)) => wrong(Code::OutOfRange, raw.text(), SHARE),
        _ => wrong(Code::WrongType, raw.text(), SHARE),
    }
}

/// A bound in SI, its dimension, and as a file has it.
fn bound_of(table: &Table, side: &str) -> Result<(f64, Dimension, String)> {
    let raw = table.raw(side).unwrap_or(&Raw::Other("nothing"));
    amount(raw)
        .map_err(|(code, found, hint)| table.problem(code, side, found, BOUND).with_hint(hint))
}

/// Why a value is none: code, what was found, a hint.
pub(crate) type Refused = (Code, String, Option<String>);

/// A quantity or a bare number: in SI, its dimension, and as a file has it; else code, what was found and a hint.
pub(crate) fn amount(raw: &Raw) -> Result<(f64, Dimension, String), Refused> {
    let (value, dimension, text) = match raw {
        Raw::Text(text) => {
            let text = text.trim();
            let quantity = parse_quantity(text).map_err(|error| unreadable(&error, text, None))?;
            (quantity.value_si, quantity.dimension, quoted(text))
        }
        Raw::Float(value) => (*value, Dimension::NONE, units::number_text(*value)),
        Raw::Integer(text, Some(value)) => (*value as f64, Dimension::NONE, text.clone()),
        other => return Err((Code::WrongType, other.text(), None)),
    };
    match value.is_finite() {
        true => Ok((value, dimension, text)),
        false => Err((Code::OutOfRange, raw.text(), None)),
    }
}
