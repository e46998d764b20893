//! From the table of keys and the given values to one value for every key.

use crate::bearing::kind::TYPE;
use crate::bearing::source::{BearingRecord, BearingSource};
use crate::document::{Document, Input};
use crate::key::{Condition, Key, Kind, Otherwise, Presence, conditions, quoted};
use crate::resolved::{Resolved, ResolvedValue};
use crate::several::{self, AUXILIARY_BEARING};
use crate::system::SystemName;
use crate::table;
use crate::values::{COMPARED_LAWS, Known, LAW, LUBRICATION, Value, Values};
use problem::provenance::Provenance;
use problem::read::POWER_TOLERANCE;
use problem::{Code, Place, Problem, Result};
use std::cell::RefCell;
use std::collections::{BTreeMap, HashSet};
use std::sync::{Arc, LazyLock};
use units::{Rational, parse_quantity};

/// A file as it was read, for reading it again with other values at a few keys.
#[derive(Clone, Debug)]
pub struct Before {
    /// What it gave.
    document: Document,
    /// What it gave, or left to catalogue and defaults.
    filled: BTreeMap<&'static str, Known>,
    record: Option<BearingRecord>,
    without_effect: Vec<&'static str>,
    hidden: Arc<[bool]>,
    /// What all that came to.
    known: BTreeMap<&'static str, Known>,
}

impl Before {
    /// A file with its values.
    pub fn read(document: Document, bearings: &dyn BearingSource) -> Result<Self> {
        let mut values = Values::filled(&document, bearings, None)?;
        let (filled, without_effect) = (values.known.clone(), values.without_effect.clone());
        values.derive(None)?;
        Ok(Before {
            document,
            filled,
            hidden: values.hidden_keys().into(),
            record: values.record,
            without_effect,
            known: values.known,
        })
    }

    /// The values of a document that differs in numbers alone on whose keys no other one depends; none of another one, nor of one
    /// whose numbers are refused: the whole reading says what is wrong with it first.
    fn with(&self, document: &Document) -> Option<Values> {
        let before = &self.document;
        let mut there = before.values.keys();
        if before.system != document.system || !there.all(|path| document.values.contains_key(path))
        {
            return None;
        }
        let mut values = Values {
            known: self.filled.clone(),
            record: self.record.clone(),
            without_effect: self.without_effect.clone(),
            hidden: Some(self.hidden.clone()),
            ..Values::none(document)
        };
        for (path, given) in &document.values {
            if before.values.get(path) == Some(given) {
                continue;
            }
            let key = table::keys_of(document.system).find(|key| key.path == *path)?;
            let known = values.reader(key).read(key, given).ok()?;
            if !stands_alone(key) || values.unmet(key).is_some() || known.filled_in {
                return None;
            }
            values.known.insert(key.path, known);
        }
        Some(values)
    }

    /// The value of a key that is given, or left to its default, as it was, and that follows from nothing else.
    fn same(&self, key: &Key, document: &Document) -> Option<&Known> {
        let given = document.values.get(key.path);
        let known = self.known.get(key.path)?;
        let alone = match known.provenance {
            Provenance::Given | Provenance::GivenWithSource(_) | Provenance::Assumed(_) => {
                given.is_some() && !known.filled_in
            }
            Provenance::Default(_) | Provenance::DefaultAssumed(_) => {
                given.is_none()
                    && matches!(table::presence(key, document.system), Presence::Default(_))
            }
            Provenance::Catalogue { .. } | Provenance::Derived(_) => false,
        };
        let own = alone && !matches!(key.kind, Kind::ContactStiffness { .. });
        (own && given == self.document.values.get(key.path)).then_some(known)
    }

    /// A value that was computed from others, where these are as they were.
    pub(crate) fn derived(
        &self,
        path: &str,
        inputs: &[&str],
        now: &BTreeMap<&'static str, Known>,
    ) -> Option<&Known> {
        let value = |all: &BTreeMap<&'static str, Known>, path: &str| {
            all.get(path).map(|known| known.value.clone())
        };
        let known = self.known.get(path)?;
        let computed = matches!(known.provenance, Provenance::Derived(_));
        let same = |path: &&str| value(&self.known, path) == value(now, path);
        (computed && inputs.iter().all(same)).then_some(known)
    }
}

impl Values {
    /// A value for every key; `before` is the file with other values at a few keys.
    pub fn resolve(
        document: &Document,
        bearings: &dyn BearingSource,
        before: Option<&Before>,
    ) -> Result<Values> {
        let mut values = match before.and_then(|before| before.with(document)) {
            Some(values) => values,
            None => Values::filled(document, bearings, before)?,
        };
        values.derive(before)?;
        Ok(values)
    }

    /// No value yet.
    fn none(document: &Document) -> Values {
        Values {
            file: document.file.clone(),
            system: document.system,
            bearing: document.bearing.clone(),
            rows: document.rows,
            known: BTreeMap::new(),
            record: None,
            lacking: RefCell::default(),
            without_effect: Vec::new(),
            hidden: None,
        }
    }

    /// Reads every given value and fills the rest from catalogue and defaults.
    fn filled(
        document: &Document,
        bearings: &dyn BearingSource,
        before: Option<&Before>,
    ) -> Result<Values> {
        let same = |key| before?.same(key, document).cloned();
        let mut values = Values::none(document);
        let own = values.own_catalogue(document)?;
        let bearings = own
            .as_ref()
            .map_or(bearings, |own| own as &dyn BearingSource);
        let record = values.find_bearing(document, bearings)?;
        for key in table::keys_of_analysis(document.system) {
            if let Some(given) = document.values.get(key.path) {
                let known = values.reader(key).read(key, given)?;
                values.known.insert(key.path, known);
            }
        }
        let mut missing: Vec<Problem> = Vec::new();
        // whether the other keys of a bearing have a meaning depends on its type
        let (first, rest): (Vec<&Key>, Vec<&Key>) =
            table::keys_of(document.system).partition(|key| key.path == TYPE);
        for key in first.into_iter().chain(rest) {
            let given = document.values.get(key.path);
            if let Some(unmet) = values.unmet(key) {
                match given {
                    Some(given) if values.of_compared_law(&unmet) => {
                        let known = values.reader(key).read(key, given)?;
                        values.known.insert(key.path, known);
                    }
                    // a file says how its bearing is lubricated, whatever is computed of it
                    Some(given) if key.path == LUBRICATION => {
                        let known = values.reader(key).read(key, given)?;
                        values.known.insert(key.path, known);
                        values.without_effect.push(LUBRICATION);
                    }
                    // a choice that is missing is no choice against the key
                    Some(_)
                        if missing.iter().any(|lack| {
                            lack.key
                                .as_ref()
                                .is_some_and(|key| key.ends_with(unmet.path))
                        }) => {}
                    Some(given) => {
                        return Err(values.unused(key, given, &unmet, document));
                    }
                    None => {}
                }
                continue;
            }
            let known = match given {
                Some(given) => {
                    values.refuse_conflict(key, given, document)?;
                    Some(match same(key) {
                        Some(known) => known,
                        None => {
                            let known = values.reader(key).read(key, given)?;
                            let known = values.lasting_path(key, known);
                            values.as_filled_in(key, known, record.as_ref(), document)
                        }
                    })
                }
                None => match values.catalogued(key, record.as_ref())? {
                    Some(known) => Some(known),
                    None if values.is_replaced(key, document) => None,
                    None => match same(key).map_or_else(
                        || values.without(key, record.as_ref()),
                        |known| Ok(Some(known)),
                    ) {
                        Err(problem) if problem.code == Code::MissingKey => {
                            missing.push(*problem);
                            None
                        }
                        other => other?,
                    },
                },
            };
            if let Some(known) = known {
                values.known.insert(key.path, known);
            }
        }
        values.record = record;
        if !missing.is_empty() {
            return Err(values.all_missing(missing));
        }
        Ok(values)
    }

    /// The first missing key, with the names of all others: one round is enough to give them.
    fn all_missing(&self, mut missing: Vec<Problem>) -> Box<Problem> {
        let mut others: Vec<String> = (missing.iter().skip(1))
            .filter_map(|problem| problem.key.clone())
            .collect();
        others.extend(self.missing_factors().map(|path| self.shown(path)));
        if self.lacks_bearings(&missing) {
            return self.without_bearings(&missing);
        }
        let mut first = Box::new(missing.swap_remove(0));
        if !others.is_empty() {
            let others = format!("Missing as well: {}", others.join(", "));
            first.hint = Some(match first.hint {
                Some(hint) => format!("{hint}. {others}"),
                None => others,
            });
        }
        first
    }

    /// Whether a machine names no auxiliary bearing, in a table or by the node of the only one.
    fn lacks_bearings(&self, missing: &[Problem]) -> bool {
        let node = |problem: &Problem| problem.key.as_deref() == Some("contact.node");
        self.system.bends() && missing.iter().any(node)
    }

    /// What a machine without auxiliary bearings needs first, with all keys that are missing.
    fn without_bearings(&self, missing: &[Problem]) -> Box<Problem> {
        let keys: Vec<&str> = (missing.iter())
            .filter_map(|problem| problem.key.as_deref())
            .collect();
        let allowed = "a table [[auxiliary_bearing]] for each is needed, with its name and, in [auxiliary_bearing.contact], its node; what all \
                       have in common stands in [contact], [mount] and [bearing]";
        let found = "a machine without an auxiliary bearing";
        self.problem(
            Code::MissingKey,
            AUXILIARY_BEARING,
            Place::Whole,
            found,
            allowed,
        )
        .with_hint(Some(format!("Missing as well: {}", keys.join(", "))))
    }

    /// The condition that keeps a key from having a meaning, followed to its root.
    pub fn unmet(&self, key: &Key) -> Option<Condition> {
        conditions(key).find_map(|condition| {
            if let Some(parent) = table::key(condition.path) {
                if !table::systems(parent).contains(&self.system) {
                    // there is no choice to be made in this system
                    return None;
                }
                if let Some(root) = self.unmet(parent) {
                    return Some(root);
                }
            }
            (!self.holds(condition)).then_some(*condition)
        })
    }

    fn holds(&self, condition: &Condition) -> bool {
        let Some(known) = self.known.get(condition.path) else {
            return false;
        };
        condition.values.iter().any(|wanted| match &known.value {
            Value::Word(word) => word == wanted,
            Value::Text(text) => text == wanted,
            Value::Switch(value) => value.to_string() == *wanted,
            Value::Number(value) => Rational::parse(wanted)
                .is_some_and(|wanted| (wanted.value() - value).abs() <= POWER_TOLERANCE),
            Value::Count(count) => count.to_string() == *wanted,
            Value::Rows(_)
            | Value::Numbers(_)
            | Value::Words(_)
            | Value::Texts(_)
            | Value::Matrix(..)
            | Value::Filters(_)
            | Value::Raw(_) => false,
        })
    }

    /// Whether a law that is compared has the key that the law of the bearing has not.
    fn of_compared_law(&self, unmet: &Condition) -> bool {
        unmet.path == LAW
            && self
                .words(COMPARED_LAWS)
                .iter()
                .any(|law| unmet.values.contains(law))
    }

    fn unused(
        &self,
        key: &Key,
        given: &Input,
        unmet: &Condition,
        document: &Document,
    ) -> Box<Problem> {
        let here = self.known.get(unmet.path).map_or(String::new(), |known| {
            format!("; here it is {}", quoted(&known.text))
        });
        let reason = if unmet.reason.is_empty() {
            String::new()
        } else {
            format!(" ({})", unmet.reason)
        };
        self.problem(
            Code::UnusedKey,
            key.path,
            given.place,
            "a key that has no effect",
            format!("it is used only with {}{reason}{here}", unmet.text()),
        )
        .with_hint(self.remedy(given, unmet, document))
    }

    /// Which lines have no effect by the same choice, and what would give them one.
    fn remedy(&self, given: &Input, unmet: &Condition, document: &Document) -> Option<String> {
        given.place.line()?;
        let lines: Vec<String> = table::keys_of(self.system)
            .filter(|key| {
                let other = self.unmet(key);
                other.is_some_and(|other| other.path == unmet.path && !self.of_compared_law(&other))
            })
            .filter_map(|key| {
                let line = document.values.get(key.path)?.place.line()?;
                Some(format!("{line} ({})", key.name()))
            })
            .collect();
        let back = match self.place(unmet.path) {
            Place::Set => format!("leave --set {} away", unmet.path),
            Place::Line { line, .. } => format!("change {} in line {line}", unmet.path),
            Place::Whole => format!("give {}", unmet.path),
        };
        let word = if lines.len() == 1 { "line" } else { "lines" };
        Some(format!("Remove {word} {}, or {back}", lines.join(", ")))
    }

    fn refuse_conflict(&self, key: &Key, given: &Input, document: &Document) -> Result<()> {
        let Some(other) = key.excludes else {
            return Ok(());
        };
        let Some(second) = document.values.get(other) else {
            return Ok(());
        };
        let (path, place, first) = if order(second.place) > order(given.place) {
            (other, second.place, key.path)
        } else {
            (key.path, given.place, other)
        };
        Err(self.problem(
            Code::Conflict,
            path,
            place,
            format!("this and {first}, which give the same thing"),
            "one of the two is needed",
        ))
    }

    /// Whether another key is given that gives the same thing.
    fn is_replaced(&self, key: &Key, document: &Document) -> bool {
        table::keys_that_exclude().iter().any(|other| {
            other.excludes == Some(key.path) && document.values.contains_key(other.path)
        })
    }

    fn without(&self, key: &Key, record: Option<&BearingRecord>) -> Result<Option<Known>> {
        match table::presence(key, self.system) {
            Presence::Optional(_) | Presence::Derived(_) => Ok(None),
            Presence::Default(fallback) => self.reader(key).fall_back(key, &fallback).map(Some),
            Presence::DefaultWhen(condition, fallback, _) if self.holds(&condition) => {
                self.reader(key).fall_back(key, &fallback).map(Some)
            }
            Presence::DefaultWhen(_, _, Otherwise::Fallback(fallback)) => {
                self.reader(key).fall_back(key, &fallback).map(Some)
            }
            Presence::DefaultWhen(condition, _, Otherwise::Required) => Err(self
                .missing(key)
                .with_hint(format!("It has a default only with {}", condition.text()))),
            Presence::Required => Err(self.missing(key)),
            Presence::FromBearing => {
                let hint = match record {
                    Some(record) => {
                        format!("The catalogue does not know it of \"{}\"", record.name)
                    }
                    None => "bearing.name takes it from the catalogue".to_string(),
                };
                Err(self.missing(key).with_hint(hint))
            }
        }
    }

    /// A value of a resolved file keeps the origin of a default or of the catalogue as long as it is that value.
    fn as_filled_in(
        &self,
        key: &Key,
        known: Known,
        record: Option<&BearingRecord>,
        document: &Document,
    ) -> Known {
        if !known.filled_in {
            return known;
        }
        let catalogued = self.catalogued(key, record).ok().flatten();
        let filled = catalogued.or_else(|| match self.is_replaced(key, document) {
            true => None,
            false => self.without(key, record).ok().flatten(),
        });
        match filled {
            Some(filled) if filled.value == known.value => Known {
                provenance: filled.provenance,
                ..known
            },
            _ => known,
        }
    }

    fn missing(&self, key: &Key) -> Box<Problem> {
        self.problem(
            Code::MissingKey,
            key.path,
            Place::Whole,
            "no value",
            key.needed(),
        )
    }

    /// The list of all values for people and for the resolved file: those of the whole file, and behind them those of each of
    /// several auxiliary bearings.
    pub fn resolved(all: &[Values]) -> Resolved {
        let whole = |path: &str| match &all[0].bearing {
            None => path != several::PLANES || all[0].is_given(path),
            Some(_) => !several::of_each_bearing(path),
        };
        let mut values = all[0].listed(whole);
        if all[0].bearing.is_some() {
            values.extend(
                all.iter()
                    .flat_map(|one| one.listed(several::of_each_bearing)),
            );
        }
        Resolved::new(values)
    }

    fn listed(&self, wanted: impl Fn(&str) -> bool) -> Vec<ResolvedValue> {
        let mut list = Vec::new();
        // of what a run does not read only what is given
        let beside = table::keys_of_analysis(self.system);
        let beside = beside.filter(|key| self.known.contains_key(key.path));
        let hidden: Arc<[bool]> = match &self.hidden {
            Some(hidden) => hidden.clone(),
            None => self.hidden_keys().into(),
        };
        let keys = table::keys_of(self.system).zip(hidden.iter());
        let keys = keys.filter_map(|(key, hidden)| (!hidden).then_some(key));
        for key in keys.chain(beside).filter(|key| wanted(key.path)) {
            let known = self.known.get(key.path);
            let absent = match table::presence(key, self.system) {
                Presence::Derived(how) => Some(Provenance::Derived(how.to_string())),
                Presence::Optional(meaning) => {
                    Some(Provenance::Default(format!("not given: {meaning}")))
                }
                _ => None,
            };
            let Some(provenance) = known.map(|known| known.provenance.clone()).or(absent) else {
                continue;
            };
            list.push(ResolvedValue {
                path: key.path,
                bearing: self
                    .bearing
                    .clone()
                    .filter(|_| several::of_each_bearing(key.path)),
                text: known.map(|known| known.text.clone()),
                value_si: known.and_then(|known| known.value.number()),
                unit: self.si_unit(key),
                provenance,
                place: known.map_or(Place::Whole, |known| known.place),
            });
        }
        list
    }

    /// Of each key of the system whether it has neither a value nor a meaning here.
    fn hidden_keys(&self) -> Vec<bool> {
        let hidden = |key: &Key| !self.known.contains_key(key.path) && self.unmet(key).is_some();
        table::keys_of(self.system).map(hidden).collect()
    }

    fn si_unit(&self, key: &Key) -> String {
        match key.kind {
            Kind::ContactStiffness { .. } => self
                .text(key.path)
                .and_then(|text| parse_quantity(&text).ok())
                .map_or(String::new(), |quantity| quantity.dimension.si_unit()),
            _ => key.unit().to_string(),
        }
    }
}

/// Whether a key has a number, and no other key's meaning, default or value depends on it before values are derived.
fn stands_alone(key: &Key) -> bool {
    static OTHERS: LazyLock<HashSet<&str>> = LazyLock::new(|| {
        let mut paths = HashSet::new();
        for key in table::keys() {
            paths.extend(conditions(key).map(|condition| condition.path));
            for system in SystemName::ALL {
                if let Presence::DefaultWhen(condition, ..) = table::presence(key, *system) {
                    paths.insert(condition.path);
                }
            }
            if let Kind::ContactStiffness { exponent } = key.kind {
                paths.insert(exponent);
            }
            paths.extend(key.excludes.into_iter().flat_map(|other| [key.path, other]));
        }
        paths
    });
    matches!(key.kind, Kind::Quantity(_) | Kind::Coefficient) && !OTHERS.contains(key.path)
}

/// Later places count more: lines in their order, then overrides.
fn order(place: Place) -> usize {
    match place {
        Place::Whole => 0,
        Place::Line { line, .. } => line,
        Place::Set => usize::MAX,
    }
}
