//! What results must hold: `[[limit]]`.
//!
//! ```toml
//! [[limit]]
//! quantity = "drive_end.peak_contact_force"   # a name of summary.json
//! most = "5 kN"                               # or least
//! share = 0.95                                # of the members of a repeated run; 1 unless given
//! ```
//! An override is `--set limit.drive_end.peak_contact_force.most="4 kN"`: it changes the limit of that result, or adds one.
//! Whether a run has such a result is known when its machine is built: `result/limits.rs`.

use crate::scenario::document::{Document, Raw};
use crate::scenario::key::quoted;
use crate::scenario::locate::UNNAMED;
use crate::scenario::read::unreadable;
use crate::scenario::several::LIMIT;
use crate::scenario::system::SystemName;
use problem::{Code, Place, Problem, did_you_mean};
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
    /// Dimension of the bound.
    pub(crate) dimension: Dimension,
    /// The bound as a file has it.
    pub(crate) text: String,
    /// Where the result is named.
    pub(crate) place: Place,
    /// Where the bound stands.
    pub(crate) bound_place: Place,
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

const KEYS: [&str; 4] = ["quantity", "most", "least", "share"];
const NEEDED: &str = "tables [[limit]] with quantity = \"…\" and most or least are needed";
const BOUND: &str = "a quantity with the unit of the result is needed, e.g. most = \"5 kN\"; a bare number where it has none";

impl Limit {
    /// The limit as a file has it.
    pub(crate) fn toml(&self) -> String {
        let share = match self.share {
            1.0 => String::new(),
            share => format!("share = {}\n", units::number_text(share)),
        };
        format!(
            "[[{LIMIT}]]\nquantity = {}\n{} = {}\n{share}",
            quoted(&self.quantity),
            self.side.word(),
            self.text
        )
    }

    /// A problem with the name of the result.
    pub(crate) fn problem(&self, code: Code, found: String, allowed: String) -> Problem {
        let problem = Problem::new(code, UNNAMED, found, allowed);
        problem.at(self.place).on_key(format!("{LIMIT}.quantity"))
    }

    /// A problem with the bound.
    pub(crate) fn bound_problem(&self, code: Code, found: String, allowed: String) -> Problem {
        let problem = Problem::new(code, UNNAMED, found, allowed);
        let key = format!("{LIMIT}.{}", self.side.word());
        problem.at(self.bound_place).on_key(key)
    }
}

/// The limits of a file; those of overrides change or follow them.
pub(crate) fn of(document: &Document) -> Result<Vec<Limit>, Box<Problem>> {
    let mut limits: Vec<Limit> = Vec::new();
    for keys in &document.limits {
        let given = Given::of(document, keys)?;
        let own = |limit: &&mut Limit| limit.quantity == given.quantity.0;
        let changes = given.place == Place::Set;
        match &given.bound {
            None if changes && given.share.is_some() => {
                let mut changed = false;
                for limit in limits.iter_mut().filter(own) {
                    limit.share = given.share.unwrap_or(limit.share);
                    changed = true;
                }
                if !changed {
                    return Err(given.lacks_a_bound(document));
                }
            }
            None => return Err(given.lacks_a_bound(document)),
            Some(bound) => {
                let same = |limit: &&mut Limit| own(limit) && limit.side == bound.side;
                let known = limits.iter_mut().find(same).filter(|_| changes);
                match known {
                    Some(limit) => {
                        limit.bound = bound.value;
                        limit.dimension = bound.dimension;
                        limit.text.clone_from(&bound.text);
                        limit.bound_place = bound.place;
                    }
                    None => limits.push(Limit {
                        quantity: given.quantity.0.clone(),
                        side: bound.side,
                        bound: bound.value,
                        share: given.share.unwrap_or(1.0),
                        dimension: bound.dimension,
                        text: bound.text.clone(),
                        place: given.quantity.1,
                        bound_place: bound.place,
                    }),
                }
            }
        }
    }
    Ok(limits)
}

/// One table, read.
struct Given {
    /// Where its first key stands.
    place: Place,
    quantity: (String, Place),
    bound: Option<Bound>,
    share: Option<f64>,
}

struct Bound {
    side: Side,
    value: f64,
    dimension: Dimension,
    text: String,
    place: Place,
}

impl Given {
    fn of(document: &Document, keys: &[(String, Raw, Place)]) -> Result<Given, Box<Problem>> {
        let place = keys.first().map_or(Place::Whole, |(.., place)| *place);
        let problem = |code, key: &str, place, found: String, allowed: &str| {
            let key = match key {
                "" => LIMIT.to_string(),
                key => format!("{LIMIT}.{key}"),
            };
            Problem::new(code, &document.file, found, allowed)
                .at(place)
                .on_key(key)
        };
        let (mut quantity, mut bound, mut share) = (None, None::<Bound>, None);
        for (key, raw, place) in keys {
            let wrong = |code, found, allowed| Box::new(problem(code, key, *place, found, allowed));
            match (key.as_str(), raw) {
                ("", raw) => return Err(wrong(Code::WrongType, raw.text(), NEEDED)),
                ("quantity", Raw::Text(name)) if !name.trim().is_empty() => {
                    quantity = Some((name.trim().to_string(), *place));
                }
                ("quantity", raw) => {
                    let allowed = "the name of a result is needed, e.g. \"peak_contact_force\"";
                    return Err(wrong(Code::WrongType, raw.text(), allowed));
                }
                ("most" | "least", raw) => {
                    if bound.is_some() {
                        let found = "both most and least in one limit".to_string();
                        let allowed = "one of them is needed; a second [[limit]] takes the other";
                        return Err(wrong(Code::Conflict, found, allowed));
                    }
                    let side = match key.as_str() {
                        "most" => Side::Most,
                        _ => Side::Least,
                    };
                    let (value, dimension, text) = amount(raw).map_err(|(code, found, hint)| {
                        Box::new(problem(code, key, *place, found, BOUND).with_hint(hint))
                    })?;
                    bound = Some(Bound {
                        side,
                        value,
                        dimension,
                        text,
                        place: *place,
                    });
                }
                ("share", raw) => {
                    if !document.system.falls() {
                        let found = "a key that has no effect".to_string();
                        let allowed = "it is used only with system = \"drop\" or \"machine\", whose runs are repeated";
                        return Err(wrong(Code::UnusedKey, found, allowed));
                    }
                    let allowed = "a share above 0 and not above 1 is needed, e.g. 0.95";
                    let (value, ..) = amount(raw)
                        .ok()
                        .filter(|(_, dimension, _)| *dimension == Dimension::NONE)
                        .ok_or_else(|| wrong(Code::WrongType, raw.text(), allowed))?;
                    if !(value > 0.0 && value <= 1.0) {
                        return Err(wrong(Code::OutOfRange, raw.text(), allowed));
                    }
                    share = Some(value);
                }
                (unknown, _) => {
                    let hint = match unknown {
                        "max" | "maximum" | "at_most" => Some("Did you mean \"most\"?".to_string()),
                        "min" | "minimum" | "at_least" => {
                            Some("Did you mean \"least\"?".to_string())
                        }
                        other => did_you_mean(other, KEYS),
                    };
                    let allowed = format!("[[{LIMIT}]] takes {}", KEYS.join(", "));
                    let found = "an unknown key".to_string();
                    let told = problem(Code::UnknownKey, key, *place, found, &allowed);
                    return Err(Box::new(told.with_hint(hint)));
                }
            }
        }
        let nameless = || {
            let found = "a limit without a quantity".to_string();
            Box::new(problem(Code::MissingKey, "", place, found, NEEDED))
        };
        Ok(Given {
            place,
            quantity: quantity.ok_or_else(nameless)?,
            bound,
            share,
        })
    }

    fn lacks_a_bound(&self, document: &Document) -> Box<Problem> {
        let found = format!("a limit of {} without most or least", self.quantity.0);
        let problem = Problem::new(Code::MissingKey, &document.file, found, NEEDED);
        Box::new(problem.at(self.place).on_key(LIMIT))
    }
}

/// Why a value is none: code, what was found, a hint.
type Refused = (Code, String, Option<String>);

/// A quantity or a bare number: in SI, its dimension, and as a file has it; else code, what was found and a hint.
fn amount(raw: &Raw) -> Result<(f64, Dimension, String), Refused> {
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

/// A limit of a system's own results, for its starting file: result, bound.
pub(crate) fn example(system: SystemName) -> (&'static str, &'static str) {
    match system {
        SystemName::Drop | SystemName::Machine => ("peak_contact_force", "most = \"5 kN\""),
        SystemName::SpinUp | SystemName::Rig => ("peak_outer_race_moment", "most = \"0.5 N m\""),
        SystemName::CoastDown => ("peak_inner_race_temperature", "most = \"120 degC\""),
        SystemName::Torque => ("friction_moment", "most = \"50 N mm\""),
        SystemName::Signals => ("peak_speed", "most = \"3000 rpm\""),
        SystemName::Rotor => ("first_critical_speed", "least = \"9000 rpm\""),
        SystemName::Identify => ("explanation_fit_probability", "least = 0.05"),
    }
}
