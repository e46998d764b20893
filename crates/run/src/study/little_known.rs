//! What each verdict of a qualification owes to the inputs that are known least.
//!
//! The member that comes nearest to a limit, or is the farthest beyond it, runs again with one of these inputs at its low and then at its high
//! value, all others as it drew them. Of what is drawn, low and high are those that 5 % of the draws fall below and exceed; of what is merely
//! assumed, half and double. Known least is what has the largest ratio of the two; what is drawn comes first.

use super::Study;
use super::table::Table;
use crate::Options;
use outcome::{host, limits};
use problem::Place;
use problem::provenance::Provenance;
use problem::raw::Raw;
use scenario::{Limit, Side, UNBALANCE_ANGLE, Vary};
use statistics::design::Coordinate;
use statistics::normal;
use std::f64::consts::LN_2;

/// Inputs that are tried.
const TRIED: usize = 5;
/// Shares of the draws below the low and the high value.
const ENDS: [f64; 2] = [0.05, 0.95];

/// An input that is little known.
#[derive(Clone, Debug)]
pub struct LittleKnown {
    /// Its path.
    pub path: String,
    /// Its value in the scenario.
    pub given: String,
    /// Its low and its high value, SI.
    pub ends: [f64; 2],
    /// SI unit; empty of bare numbers.
    pub unit: String,
    /// How it is drawn, or why it is assumed.
    pub origin: String,
    /// Whether the draws of the study vary it.
    pub drawn: bool,
    /// Paths with their low and high values.
    values: [Vec<(String, String)>; 2],
}

/// What a limit owes to them.
#[derive(Clone, Debug, PartialEq)]
pub struct Owed {
    /// Place of the limit in the study.
    pub limit: usize,
    /// The member that decides it.
    pub member: usize,
    /// Its value as it drew, then with each input at its low and high value; none where that run failed.
    pub value: Option<f64>,
    /// A pair an input.
    pub ends: Vec<[Option<f64>; 2]>,
    /// Whether those runs end while the rotor slips on a race or bushing: their values may still grow.
    pub slips: Vec<[bool; 2]>,
}

impl LittleKnown {
    fn of(vary: &Vary, given: Option<String>, origin: String, drawn: bool) -> LittleKnown {
        let at = ENDS.map(|share| vary.at(Coordinate::Share(share)));
        let [low, high] = [&at[0], &at[1]].map(|(_, number)| number.unwrap_or(0.0));
        let values = at.map(|(values, _)| values);
        LittleKnown {
            path: vary.path.clone(),
            given: given.or_else(|| vary.given_text()).unwrap_or_default(),
            ends: [low, high],
            unit: vary.unit(),
            origin,
            drawn,
            values,
        }
    }
}

impl LittleKnown {
    /// Half and double of a value of a part of the rotor.
    fn of_part(path: String, given: &str, origin: String) -> Option<LittleKnown> {
        let quantity = units::parse_quantity(given).ok()?;
        let ends = [0.5, 2.0].map(|factor| factor * quantity.value_si);
        let text = |value_si| {
            units::Quantity {
                value_si,
                ..quantity
            }
            .to_string()
        };
        Some(LittleKnown {
            values: ends.map(|end| vec![(path.clone(), text(end))]),
            path,
            given: given.to_string(),
            ends,
            unit: quantity.dimension.si_unit(),
            origin,
            drawn: false,
        })
    }
}

impl Study {
    /// What is merely assumed and not drawn: its path, value and reason; what the user marked comes first.
    pub fn assumed(&self) -> Vec<(String, String, String)> {
        let resolved = &self.file.scenario.resolved;
        let mut found: Vec<(String, String, String)> = Vec::new();
        let drawn: Vec<String> = (self.file.inputs.iter())
            .flat_map(|input| input.vary.at(Coordinate::Share(0.5)).0)
            .map(|(path, _)| path)
            .collect();
        for by_user in [true, false] {
            for value in &resolved.values {
                let own = matches!(value.provenance, Provenance::Assumed(_));
                let new = found.iter().all(|(path, ..)| path != value.path);
                if value.provenance.mark() == "assumed"
                    && own == by_user
                    && new
                    && !drawn.contains(&value.shown())
                {
                    let text = value.text.clone().unwrap_or_default();
                    found.push((value.path.to_string(), text, value.provenance.note()));
                }
            }
            if by_user {
                let parts = resolved.assumed_of_parts();
                let parts = parts.filter(|(path, ..)| !drawn.iter().any(|own| own == path));
                found.extend(parts.map(|(path, known)| {
                    (
                        path.to_string(),
                        known.text.clone(),
                        known.provenance.note(),
                    )
                }));
            }
        }
        found
    }

    /// The inputs that are known least, those that are drawn first.
    pub fn little_known(&self) -> Vec<LittleKnown> {
        let scenario = &self.file.scenario;
        let inputs = self.file.inputs.iter();
        let inputs = inputs.filter(|input| input.levels == 0 && input.vary.path != UNBALANCE_ANGLE);
        let mut drawn: Vec<LittleKnown> = inputs
            .map(|input| LittleKnown::of(&input.vary, None, input.written.clone(), true))
            .collect();
        // the high over the low value; infinite of what may be zero
        let ratio = |own: &LittleKnown| match own.ends {
            [low, high] if low > 0.0 => high / low,
            _ => f64::INFINITY,
        };
        drawn.sort_by(|a, b| ratio(b).total_cmp(&ratio(a)));
        let deviation = Raw::Table(vec![(
            "lognormal".to_string(),
            Raw::Float(LN_2 / normal::quantile(ENDS[1])),
        )]);
        let scaled = |(path, given, reason): (String, String, String)| {
            // half of a temperature or of an exponent says nothing
            let value = scenario.resolved.get(&path);
            let has_unit = value.is_none_or(|value| !["", "K"].contains(&value.unit.as_str()));
            if !has_unit && !path.ends_with("coefficient") {
                return None;
            }
            let Some(_) = value else {
                return LittleKnown::of_part(path, &given, reason);
            };
            let vary = scenario.varied(&path, &deviation, Place::Whole).ok()?;
            let given = (!given.is_empty()).then_some(given);
            Some(LittleKnown::of(&vary, given, reason, false))
        };
        let possible = |own: &LittleKnown| {
            // of a zero there is no half
            let apart = own.ends[0] != own.ends[1];
            apart
                && own
                    .values
                    .iter()
                    .all(|values| scenario.with(values).is_ok())
        };
        let assumed = self.assumed().into_iter().filter_map(scaled);
        let all = drawn.into_iter().chain(assumed);
        all.filter(possible).take(TRIED).collect()
    }

    /// The member that comes nearest to a limit or is the farthest beyond it, with its value.
    pub fn worst(&self, table: &Table, limit: &Limit) -> Option<(usize, f64)> {
        let size = |value: f64| match limit.side {
            Side::Most => value,
            Side::Least => -value,
        };
        let values = self.limited(table, limit).into_iter().zip(&table.members);
        let own = values
            .filter(|(_, member)| limit.case.is_none() || limit.case == self.case_of(**member));
        let known = own.filter_map(|(value, member)| Some((*member, value?)));
        known.max_by(|a, b| size(a.1).total_cmp(&size(b.1)).then(b.0.cmp(&a.0)))
    }

    /// The members that decide the limits, each once.
    pub fn deciding(&self, table: &Table) -> Vec<usize> {
        let limits = self.file.limits.iter();
        let mut members: Vec<usize> = limits
            .filter_map(|limit| Some(self.worst(table, limit)?.0))
            .collect();
        members.sort_unstable();
        members.dedup();
        members
    }

    /// Runs some of the members that decide with one input changed: row (at × inputs + input) × 2 + end of the deciding member at that place.
    pub fn with_ends(
        &self,
        deciding: &[usize],
        known: &[LittleKnown],
        rows: &[usize],
        options: &Options,
    ) -> Table {
        let drawn = |row: &usize| {
            let (at, input, end) = (row / 2 / known.len(), row / 2 % known.len(), row % 2);
            let mut drawn = self.drawn(deciding[at]);
            for (path, value) in known[input].values[end].iter().cloned() {
                drawn.set(path, value);
            }
            drawn
        };
        let drawn: Vec<super::Drawn> = rows.iter().map(drawn).collect();
        let variations = self.file.scenario.variations();
        let scenarios = host::each(&drawn, |_, drawn| variations.with(&drawn.values));
        let numbered = rows
            .iter()
            .copied()
            .zip(drawn.into_iter().map(|drawn| drawn.numbers));
        let table = super::table_of(&scenarios, numbered, self.input_columns(), options);
        self.in_order(table)
    }

    /// What each limit owes to these inputs, of what was run of them.
    pub fn owed(&self, table: &Table, known: &[LittleKnown], ends: &Table) -> Vec<Owed> {
        let deciding = self.deciding(table);
        let slipping: Vec<_> = (self.known.iter())
            .filter(|own| limits::is_of(&own.name, limits::SLIPS))
            .map(|own| ends.values(&own.name))
            .collect();
        let slips_in = |row: usize| {
            let at = ends.members.binary_search(&row).ok();
            at.is_some_and(|at| slipping.iter().any(|slips| slips[at] > Some(0.0)))
        };
        let of = |(at, limit): (usize, &Limit)| {
            let (member, value) = self.worst(table, limit)?;
            let place = deciding.binary_search(&member).ok()?;
            let values = self.limited(ends, limit);
            let value_of = |row: usize| {
                ends.members
                    .binary_search(&row)
                    .ok()
                    .and_then(|at| values[at])
            };
            let first = |input: usize| (place * known.len() + input) * 2;
            let pair = |input: usize| [0, 1].map(|end| value_of(first(input) + end));
            let slips = |input: usize| [0, 1].map(|end| slips_in(first(input) + end));
            Some(Owed {
                limit: at,
                member,
                value: Some(value),
                ends: (0..known.len()).map(pair).collect(),
                slips: (0..known.len()).map(slips).collect(),
            })
        };
        self.file.limits.iter().enumerate().filter_map(of).collect()
    }
}
