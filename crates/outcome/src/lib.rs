//! What a simulation hands over: quantities, history, contacts, warnings. Plain data, SI.

#![forbid(unsafe_code)]

pub mod columns;
pub mod forbidden;
pub mod host;
pub mod joined;
pub mod limits;
pub mod list;
pub mod options;
pub mod table;
mod whirl;
mod withheld;

pub use host::start_pool;
pub use options::Options;
use problem::Problem;
pub use problem::warning::{Amount, Scope, Severity, Warning};
use scenario::Limit;
use serde::{Deserialize, Serialize};
use table::Table;

const NOT_FINITE: &str = "what was computed is not a finite number";

/// Everything known after a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Outcome {
    /// Name of the system, e.g. `drop`.
    pub system: &'static str,
    /// Title of the scenario, or a plain one.
    pub title: String,
    /// Named results, in the order of the report.
    pub quantities: Vec<Quantity>,
    /// Time histories: columns of equal length, `time` first.
    pub history: Vec<Column>,
    /// Contacts of rotor and inner race, in order.
    pub contacts: Vec<Contact>,
    /// What the user should know before trusting the numbers.
    pub warnings: Vec<Warning>,
    /// How the run ended.
    pub stop: Stop,
    /// What it took.
    pub work: Work,
    /// Named results of each member, when repeated; member 0 is the unperturbed run.
    pub members: Table,
    /// What each of these members drew: paths with their values, as a file has them; empty where none varies the machine.
    pub drawn: Vec<Vec<(String, String)>>,
    /// Numbers that only the pictures need, of each bearing: one at least.
    pub pictures: Vec<Picture>,
    /// Files that the run leaves beside its results.
    #[serde(skip)]
    pub files: Vec<Attachment>,
    /// Limits of the scenario with their verdicts.
    pub limits: Vec<Judged>,
}

impl Outcome {
    /// What comes of a machine that could not be built.
    pub fn not_built(problem: &Problem) -> Self {
        Outcome {
            stop: Stop::new("not built", 0.0, problem.to_string()),
            ..Outcome::default()
        }
    }

    /// The result of a name, such as `drive_end.peak_contact_force`.
    pub fn quantity(&self, name: &str) -> Option<&Quantity> {
        let name = scenario::present_name(name);
        self.quantities.iter().find(|known| known.name == name)
    }

    /// The value of a result that is a number and has one.
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.quantity(name)?.value {
            Value::Number(value) => Some(value),
            _ => None,
        }
    }

    /// The column of a name, such as `bearing.inner_race.speed`.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.history.iter().find(|known| known.name == name)
    }
}

/// A file that a run leaves beside its results.
#[derive(Clone, Debug, PartialEq)]
pub struct Attachment {
    /// Name in the run directory.
    pub name: String,
    /// What stands in it.
    pub content: Attached,
}

/// What stands in a file.
#[derive(Clone, Debug, PartialEq)]
pub enum Attached {
    /// A text.
    Text(String),
    /// Any content.
    Bytes(Vec<u8>),
    /// Channels of a measurement with their values; the name of the file gives the format.
    Recording(Vec<(recording::Channel, Vec<f64>)>),
}

/// A named result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Quantity {
    /// Name, e.g. `first_impact_force`.
    pub name: String,
    /// Its value.
    pub value: Value,
    /// SI unit; empty for text and counts.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub meaning: &'static str,
    /// Whether it is among those that are looked at first.
    pub headline: bool,
    /// The law or definition it comes from.
    pub law: &'static str,
    /// Source of that law.
    pub source: &'static str,
    /// Where it is valid.
    pub valid: &'static str,
    /// True where the members of a repeated run show that tiny changes of the start change it much; not known of a single run.
    pub chaotic: bool,
    /// Spread over the members, when repeated.
    pub spread: Option<Spread>,
    /// True of an instant that the run waits for: where it has no value it is later than the end of the run.
    pub awaited: bool,
    /// True of what is zero in a run that ended as planned without a contact, where it has no value.
    pub of_contacts: bool,
    /// Figures and tables of the fronts that show it, each with its words there.
    pub shown: Vec<(&'static str, String)>,
}

impl Quantity {
    /// The words that a figure has for it; none of a figure that does not show it.
    pub fn words_in(&self, figure: &str) -> Option<&str> {
        let mut shown = self.shown.iter();
        let found = shown.find(|(known, _)| *known == figure);
        found.map(|(_, words)| words.as_str())
    }
}

/// The instant from which instants of a run count, s: that of its release where it has one, else its start; none where nothing was released.
pub fn counted_from(results: &[Quantity]) -> Option<f64> {
    let release = results.iter().find(|own| own.name == "release_time");
    release.map_or(Some(0.0), |own| match own.value {
        Value::Number(time) => Some(time),
        _ => None,
    })
}

/// A result in one of its kinds.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A list of numbers.
    List(Vec<f64>),
    /// A word.
    Text(String),
    /// It does not exist in this run, and why.
    None {
        /// The reason.
        why: String,
    },
}

impl Value {
    /// Why there is no value to tell; none where there is one. A list may lack single numbers, which are not numbers there; an
    /// infinite number is a fault.
    pub fn why_absent(&self) -> Option<&str> {
        let is_told = match self {
            Value::Number(number) => number.is_finite(),
            Value::List(list) => {
                let has_one = list.is_empty() || list.iter().any(|number| number.is_finite());
                has_one && !list.iter().any(|number| number.is_infinite())
            }
            Value::Text(_) => true,
            Value::None { why } => return Some(why),
        };
        (!is_told).then_some(NOT_FINITE)
    }
}

/// Mean and spread over members in which the quantity exists.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Number of members in which it exists.
    pub members: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the sample.
    pub standard_deviation: f64,
    /// Smallest.
    pub smallest: f64,
    /// Largest.
    pub largest: f64,
    /// Quantiles at 5, 50 and 95 %, between the sorted members on straight lines.
    pub quantiles: [f64; 3],
}

impl Spread {
    /// Deviation over the largest size of a member; 0 where all are 0.
    pub fn relative_deviation(&self) -> f64 {
        let size = self.largest.abs().max(self.smallest.abs());
        match size > 0.0 {
            true => self.standard_deviation / size,
            false => 0.0,
        }
    }

    /// Of the values of members; none of fewer than two.
    pub fn of(mut values: Vec<f64>) -> Option<Self> {
        if values.len() < 2 {
            return None;
        }
        values.sort_by(f64::total_cmp);
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let square = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        let quantile = |share: f64| {
            let place = share * (count - 1.0);
            let below = place as usize;
            let above = (below + 1).min(values.len() - 1);
            values[below] + (place - below as f64) * (values[above] - values[below])
        };
        Some(Spread {
            members: values.len(),
            mean,
            standard_deviation: (square / (count - 1.0)).sqrt(),
            smallest: quantile(0.0),
            largest: quantile(1.0),
            quantiles: [0.05, 0.5, 0.95].map(quantile),
        })
    }
}

/// One column of a history.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Column {
    /// Channel name, e.g. `bearing.inner_race.speed`.
    pub name: String,
    /// SI unit, `1` for a ratio.
    pub unit: &'static str,
    /// What it is, in words.
    pub meaning: String,
    /// True where the data of a run decide whether it is there.
    pub optional: bool,
    /// The values; none before a run.
    pub values: Vec<f64>,
}

/// One contact of rotor and inner race.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Contact {
    /// Name of the auxiliary bearing; empty where it is the only one.
    #[serde(rename = "auxiliary_bearing", skip_serializing_if = "String::is_empty")]
    pub bearing: String,
    /// Begin, s.
    #[serde(rename = "start_s")]
    pub start: f64,
    /// End, s; none where it lasts to the end of the run.
    #[serde(rename = "end_s")]
    pub end: Option<f64>,
    /// Largest normal force, N.
    #[serde(rename = "peak_force_N")]
    pub peak_force: f64,
    /// Its instant, s.
    #[serde(rename = "peak_time_s")]
    pub peak_time: f64,
}

/// A limit with its verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judged {
    /// The limit.
    #[serde(serialize_with = "words")]
    pub limit: Limit,
    /// SI unit of bound and value.
    pub unit: &'static str,
    /// The value that decides: of the run, or that which the share of the members holds; none where it is not known.
    pub value: Option<f64>,
    /// Members asked for; 1 of a run that is not repeated.
    pub members: usize,
    /// Members that hold the bound.
    pub hold: usize,
    /// What follows.
    pub verdict: Verdict,
    /// Why.
    pub why: String,
}

impl Judged {
    /// How far the value that decides stays from the bound, as a share of the bound. Negative beyond it; none where it has no value or the
    /// bound is 0.
    pub fn margin(&self) -> Option<f64> {
        let apart = match self.limit.side {
            scenario::Side::Most => self.limit.bound - self.value?,
            scenario::Side::Least => self.value? - self.limit.bound,
        };
        let margin = apart / self.limit.bound.abs();
        margin.is_finite().then_some(margin)
    }
}

/// A limit in words: `peak_contact_force most 5 kN`.
fn words<S: serde::Serializer>(limit: &Limit, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!(
        "{} {} {}",
        limit.quantity,
        limit.side.word(),
        limit.text.trim_matches('"')
    ))
}

/// Whether a limit is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// It is.
    Pass,
    /// It is not.
    Fail,
    /// What is known does not say.
    Undecided,
}

impl Verdict {
    /// In one word.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Fail => "fail",
            Verdict::Undecided => "undecided",
        }
    }
}

/// How a run ended.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Stop {
    /// `finished`, `still turning`, `interrupted`, `diverged`, `step limit`, `left the model`, `not answered` or `not written`.
    pub reason: &'static str,
    /// Time of the last state, s.
    #[serde(rename = "time_s")]
    pub time: f64,
    /// One sentence.
    pub text: String,
}

impl Stop {
    /// How a run ended, when, and that in a sentence.
    pub fn new(reason: &'static str, time: f64, text: impl Into<String>) -> Stop {
        let text = text.into();
        Stop { reason, time, text }
    }

    /// True where the whole run was computed: to its end or for as long as a coast-down may last.
    pub fn complete(&self) -> bool {
        ["finished", "still turning"].contains(&self.reason)
    }

    /// True where the user ended it.
    pub fn interrupted(&self) -> bool {
        self.reason == "interrupted"
    }
}

/// Work of a run, all members together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Work {
    /// Machines simulated.
    pub members: usize,
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Evaluations of the right-hand side.
    pub rate_calls: u64,
    /// Wall-clock time, s.
    #[serde(rename = "wall_s")]
    pub seconds: f64,
    /// Method of the time integration; none where nothing moves.
    #[serde(skip_deserializing)]
    pub method: Option<&'static str>,
}

/// Numbers of a bearing that only the pictures need.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Picture {
    /// Name of the bearing; empty where it is the only one.
    #[serde(rename = "name", skip_serializing_if = "String::is_empty")]
    pub bearing: String,
    /// Radius of the clearance circle, m; none where no rotor moves in the bore.
    #[serde(rename = "clearance_radius_m")]
    pub clearance: Option<f64>,
    /// Limit of the Hertz pressure, Pa.
    #[serde(rename = "hertz_pressure_limit_Pa")]
    pub pressure_limit: Option<f64>,
    /// Cage speed per inner race speed when the balls roll.
    pub rolling_cage_ratio: f64,
    /// Number of balls.
    #[serde(rename = "ball_count")]
    pub balls: usize,
}

impl Picture {
    /// That of a bearing in whose bore no rotor moves.
    pub fn without_rotor(rolling_cage_ratio: f64, balls: usize) -> Picture {
        Picture {
            bearing: String::new(),
            clearance: None,
            pressure_limit: None,
            rolling_cage_ratio,
            balls,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_has_the_quantiles_of_its_members() {
        let spread = Spread::of((0..=20).rev().map(f64::from).collect()).unwrap();
        assert_eq!((spread.members, spread.mean), (21, 10.0));
        assert_eq!((spread.smallest, spread.largest), (0.0, 20.0));
        assert_eq!(spread.quantiles, [1.0, 10.0, 19.0]);
        // of 0 to 20: Σ(i - 10)² = 770, over 20
        assert!((spread.standard_deviation - 38.5_f64.sqrt()).abs() < 1e-12);
        let two = Spread::of(vec![3.0, 1.0]).unwrap();
        assert!((two.quantiles[0] - 1.1).abs() < 1e-12 && two.quantiles[1] == 2.0);
        assert_eq!(Spread::of(vec![1.0]), None);
    }
}
