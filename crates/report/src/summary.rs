//! `summary.json`: what a run found, in the words of the interface.
//!
//! No number in it is infinite or not-a-number: such a quantity is `null` with the reason.

use outcome::table::Table;
use outcome::{
    Amount, Contact, Judged, Outcome, Picture, Quantity, Spread, Stop, Value, Warning, Work,
};
use problem::value::Known;
use scenario::{Provenance, ResolvedValue, Scenario};
use serde::{Serialize, Serializer};
use std::io::{BufWriter, Write};

pub(crate) const FORMAT: &str = "auxbear.summary/2";

/// Members that the page carries: a thousandth of what a repetition can have weighs as much as the rest of the page.
pub(super) const OF_PAGE: usize = 500;

/// Writes the summary of a run as JSON; `stop` says how it ended. Of very many members none stands in memory as text.
pub(super) fn write(
    writer: impl Write,
    scenario: &Scenario,
    outcome: &Outcome,
    stop: &Stop,
) -> Result<(), serde_json::Error> {
    let mut writer = BufWriter::new(writer);
    serde_json::to_writer_pretty(&mut writer, &told(scenario, outcome, stop, usize::MAX))?;
    writer.write_all(b"\n").map_err(serde_json::Error::io)?;
    writer.flush().map_err(serde_json::Error::io)
}

/// The summary as text, of very many members with the first and how many there are: as the page carries it. Of few members it is the
/// text of the file, so that a page drawn again is the same page.
pub(super) fn of_page(scenario: &Scenario, outcome: &Outcome) -> Result<String, serde_json::Error> {
    let told = told(scenario, outcome, &outcome.stop, OF_PAGE);
    Ok(serde_json::to_string_pretty(&told)? + "\n")
}

fn told<'a>(
    scenario: &'a Scenario,
    outcome: &'a Outcome,
    stop: &'a Stop,
    most: usize,
) -> Summary<'a> {
    let quantities = outcome
        .quantities
        .iter()
        .map(|quantity| (quantity.name.as_str(), result(quantity)));
    let members = outcome.members.len();
    Summary {
        format: FORMAT,
        system: outcome.system,
        title: &outcome.title,
        version: env!("CARGO_PKG_VERSION"),
        complete: stop.complete(),
        stop,
        quantities: Named(quantities.collect()),
        limits: outcome.limits.iter().map(limit).collect(),
        warnings: outcome.warnings.iter().map(warning).collect(),
        contacts: &outcome.contacts,
        inputs: (scenario.resolved.values.iter().map(input))
            .chain(scenario.resolved.of_all_parts().map(of_part))
            .collect(),
        members: First(&outcome.members, members.min(most)),
        members_total: (members > most).then_some(members),
        drawn: (outcome.drawn.iter().take(most))
            .map(|draws| {
                let draws = draws.iter();
                Named(
                    draws
                        .map(|(path, value)| (path.as_str(), value.as_str()))
                        .collect(),
                )
            })
            .collect(),
        first: &outcome.pictures[0],
        auxiliary_bearings: match outcome.pictures.as_slice() {
            [_] => &[],
            several => several,
        },
        work: &outcome.work,
    }
}

/// Name and value in the order given: a JSON object.
pub(super) struct Named<'a, T>(Vec<(&'a str, T)>);

impl<T> Named<'_, T> {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T: Serialize> Serialize for Named<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

#[derive(Serialize)]
struct Summary<'a> {
    format: &'static str,
    system: &'static str,
    title: &'a str,
    version: &'static str,
    complete: bool,
    stop: &'a Stop,
    quantities: Named<'a, Entry<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    limits: Vec<Held<'a>>,
    warnings: Vec<Message<'a>>,
    contacts: &'a [Contact],
    inputs: Vec<Input<'a>>,
    #[serde(skip_serializing_if = "First::is_empty")]
    members: First<'a>,
    /// Number of members, where only the first are here.
    #[serde(skip_serializing_if = "Option::is_none")]
    members_total: Option<usize>,
    /// What each of these members drew.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    drawn: Vec<Named<'a, &'a str>>,
    /// Of the first bearing.
    #[serde(flatten)]
    first: &'a Picture,
    /// Of each bearing, where there are several.
    #[serde(skip_serializing_if = "<[Picture]>::is_empty")]
    auxiliary_bearings: &'a [Picture],
    work: &'a Work,
}

/// The first so many members as objects, of which one exists at a time.
struct First<'a>(&'a Table, usize);

impl First<'_> {
    fn is_empty(&self) -> bool {
        self.1 == 0
    }
}

impl Serialize for First<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((0..self.1).map(|k| Named(self.0.row(k).collect())))
    }
}

#[derive(Serialize)]
struct Entry<'a> {
    value: Json<'a>,
    unit: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'a str>,
    law: &'static str,
    source: &'static str,
    valid: &'static str,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    chaotic: bool,
    #[serde(skip_serializing_if = "Named::is_empty")]
    shown: Named<'a, &'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    spread: Option<Range>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Json<'a> {
    Number(f64),
    List(&'a [f64]),
    Text(&'a str),
    Null,
}

#[derive(Serialize)]
struct Range {
    members: usize,
    mean: Option<f64>,
    sd: Option<f64>,
    min: Option<f64>,
    max: Option<f64>,
    q05: Option<f64>,
    median: Option<f64>,
    q95: Option<f64>,
}

/// A limit and its verdict.
#[derive(Serialize)]
struct Held<'a> {
    quantity: &'a str,
    side: &'static str,
    bound: f64,
    value: Option<f64>,
    unit: &'static str,
    share: f64,
    members: usize,
    hold: usize,
    verdict: &'static str,
    why: &'a str,
}

#[derive(Serialize)]
struct Message<'a> {
    code: &'static str,
    severity: &'static str,
    part: &'a str,
    time_s: Option<f64>,
    values: Named<'a, Measured<'a>>,
    text: String,
}

/// A value of a warning.
#[derive(Serialize)]
struct Measured<'a> {
    value: Json<'a>,
    unit: &'static str,
}

#[derive(Serialize)]
struct Input<'a> {
    path: String,
    value: &'a str,
    mark: &'static str,
    note: String,
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// The figures that show a result, each with its words there.
pub(super) fn shown(quantity: &Quantity) -> Named<'_, &str> {
    let headline = quantity.headline.then_some(("headline", quantity.meaning));
    let others = (quantity.shown.iter()).map(|(figure, words)| (*figure, words.as_str()));
    Named(headline.into_iter().chain(others).collect())
}

fn result(quantity: &Quantity) -> Entry<'_> {
    let why = quantity.value.why_absent();
    let value = match &quantity.value {
        _ if why.is_some() => Json::Null,
        Value::Number(number) => Json::Number(*number),
        Value::List(list) => Json::List(list),
        Value::Text(text) => Json::Text(text),
        Value::None { .. } => Json::Null,
    };
    Entry {
        value,
        unit: quantity.unit,
        why,
        law: quantity.law,
        source: quantity.source,
        valid: quantity.valid,
        chaotic: quantity.chaotic,
        shown: shown(quantity),
        spread: quantity.spread.as_ref().map(range),
    }
}

fn range(spread: &Spread) -> Range {
    Range {
        members: spread.members,
        mean: finite(spread.mean),
        sd: finite(spread.standard_deviation),
        min: finite(spread.smallest),
        max: finite(spread.largest),
        q05: finite(spread.quantiles[0]),
        median: finite(spread.quantiles[1]),
        q95: finite(spread.quantiles[2]),
    }
}

fn limit(judged: &Judged) -> Held<'_> {
    Held {
        quantity: &judged.limit.quantity,
        side: judged.limit.side.word(),
        bound: judged.limit.bound,
        value: judged.value.and_then(finite),
        unit: judged.unit,
        share: judged.limit.share,
        members: judged.members,
        hold: judged.hold,
        verdict: judged.verdict.word(),
        why: &judged.why,
    }
}

fn warning(warning: &Warning) -> Message<'_> {
    let measured = |amount| match amount {
        &Amount::Number(value) => Json::Number(value),
        Amount::Text(text) => Json::Text(text),
    };
    let values = warning.values.iter().map(|(name, amount, unit)| {
        let value = measured(amount);
        (*name, Measured { value, unit })
    });
    Message {
        code: warning.code,
        severity: warning.severity.word(),
        part: &warning.part,
        time_s: warning.time,
        values: Named(values.collect()),
        text: warning.to_string(),
    }
}

fn input(value: &ResolvedValue) -> Input<'_> {
    let text = match (&value.text, &value.provenance) {
        (Some(text), _) => text,
        (None, Provenance::Derived(_)) => "from other values",
        (None, _) => "not given",
    };
    Input {
        path: value.shown(),
        value: text,
        mark: value.provenance.mark(),
        note: value.provenance.note(),
    }
}

/// A value of a part of a flexible rotor, magnets and events among them.
fn of_part<'a>((path, known): (&str, &'a Known)) -> Input<'a> {
    Input {
        path: path.to_string(),
        value: &known.text,
        mark: known.provenance.mark(),
        note: known.provenance.note(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn printed(value: Value) -> serde_json::Value {
        let quantity = Quantity {
            name: "force".to_string(),
            value,
            unit: "N",
            meaning: "",
            headline: false,
            law: "",
            source: "",
            valid: "",
            chaotic: false,
            awaited: false,
            of_contacts: false,
            shown: Vec::new(),
            spread: Some(Spread {
                members: 2,
                mean: f64::NAN,
                standard_deviation: f64::INFINITY,
                smallest: 1.0,
                largest: 2.0,
                quantiles: [1.0, 1.5, 2.0],
            }),
        };
        serde_json::to_value(result(&quantity)).unwrap()
    }

    #[test]
    fn what_is_not_finite_is_null_with_the_reason() {
        for value in [
            Value::Number(f64::NAN),
            Value::Number(f64::NEG_INFINITY),
            Value::List(vec![1.0, f64::INFINITY]),
            Value::List(vec![f64::NAN]),
        ] {
            let printed = printed(value);
            assert!(printed["value"].is_null());
            assert_eq!(printed["why"], "what was computed is not a finite number");
            assert!(printed["spread"]["mean"].is_null() && printed["spread"]["min"] == 1.0);
        }
        let absent = printed(Value::None {
            why: "no contact".to_string(),
        });
        assert!(absent["value"].is_null() && absent["why"] == "no contact");
        let gaps = printed(Value::List(vec![1.0, f64::NAN]));
        assert!(gaps["value"][0] == 1.0 && gaps["value"][1].is_null());
        let list = printed(Value::List(vec![1.0, 2.5]));
        assert_eq!(list["value"], serde_json::json!([1.0, 2.5]));
        assert!(list.get("why").is_none());
    }

    #[test]
    fn named_values_keep_their_order() {
        let named = Named(vec![("b", 1), ("a", 2)]);
        assert_eq!(serde_json::to_string(&named).unwrap(), "{\"b\":1,\"a\":2}");
    }
}
