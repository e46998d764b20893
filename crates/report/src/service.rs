//! A service: so many drops of this kind, so many of that, and what they do to the bearings together.
//!
//! ```text
//!   fatigue    D = ‖Σ n_k (d_drop + d_coast-down)‖           d the share of L10 at each point of both rings, ‖ ‖ the mean of
//!                                                        powers 10/9 to the power 9/10
//!   survival   0.9^(D^(10/9)) of each bearing, of which all have to survive
//!   wear       Σ n_k depth_k
//!   the rest   does not add up: the worst of all drops
//! ```
//! A point of a ring is the same in all drops: an outer ring that does not creep, and an inner one that begins each drop at one angle, the worst
//! that it can do. D of n equal drops is n D; of drops that load other points it is less than the sum of theirs.
//! Of a repeated run the mean of its members counts, with the spread that so many drops of it leave; of what does not add up the worst
//! member. Every drop begins as its run
//! did: lubricant and temperatures have recovered.
//!
//! Source: derived; book/src/theory/heat.md.

use super::directory::read;
use model::system::layout::of_part;
use outcome::limits::of_no_machine;
use physics::life::{add_points, bearing_damage, mean_damage, repetitions, survival};
use problem::{Code, Problem, Result};
use scenario::several::{PLANES, path_of};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Drops of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Occasion {
    /// How many of them.
    pub count: u64,
    /// Directory of a run of one.
    pub directory: PathBuf,
}

/// What a service does to one bearing in one way.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Name of the bearing; empty where it is the only one.
    pub bearing: String,
    /// What, in words.
    pub what: String,
    /// Whether drops add up; else the worst of them counts.
    pub adds: bool,
    /// Of the whole service, or why it is not known.
    pub value: Result<f64, String>,
    /// Half of the width within which 90 % of such services lie, by the spread between drops.
    pub band: Option<f64>,
    /// Unit; "1" of shares, of which 1 is the limit.
    pub unit: String,
    /// What each kind of drop would do alone, in the order of the occasions.
    pub parts: Vec<f64>,
}

/// What a service does.
#[derive(Clone, Debug, PartialEq)]
pub struct Service {
    /// Ways in which bearings are used up.
    pub modes: Vec<Mode>,
    /// Share of machines none of whose bearings has failed by rolling fatigue; none where its share is not known.
    pub survival: Option<f64>,
    /// Such services after which 1, 10 and 50 % of machines have lost a bearing by fatigue.
    pub services: Option<[f64; 3]>,
}

const FATIGUE: &str = "rolling fatigue, of L10";
/// Figures of the results that use a bearing up: of those that add up, and those of which the worst counts.
const FIGURES: [(&str, bool); 2] = [("added_up", true), ("worst", false)];
/// What begins the names of the results of a coast-down.
const COAST_DOWN: &str = "coast_down.";

/// 90 % of a normal distribution lie within so many deviations.
const BAND: f64 = 1.645;

/// What is read of a run.
struct Run<'a> {
    count: f64,
    directory: &'a Path,
    text: String,
    summary: Value,
}

/// Mean, largest value, standard deviation and number of members of a quantity; one member of a single run.
struct OfMembers {
    mean: f64,
    largest: f64,
    deviation: f64,
    members: f64,
}

/// Adds up the drops of a service.
pub fn service(occasions: &[Occasion]) -> Result<Service> {
    let mut runs = Vec::new();
    for occasion in occasions {
        let run = read(&occasion.directory)?;
        runs.push(Run {
            count: occasion.count as f64,
            directory: &occasion.directory,
            // it was read as a summary already
            summary: serde_json::from_str(&run.summary_json).unwrap_or_default(),
            text: run.summary_json,
        });
    }
    let bearings = runs.first().map(Run::bearings).unwrap_or_default();
    for run in &runs {
        if !run.text.contains("\"shown\":") {
            let found = "a run of an older version whose scenario cannot be read any more";
            let needed =
                "the run made again is needed: its summary does not say what uses a bearing up";
            let (code, path) = (Code::Conflict, run.directory);
            return Err(Problem::at_path(code, path, found, needed));
        }
        if run.bearings().is_empty() {
            let system = run.summary["system"].as_str().unwrap_or("unknown");
            let found = format!("a run of system {system}");
            let needed = "a drop or a machine is needed: a service is so many drops";
            let (code, path) = (Code::Conflict, run.directory);
            return Err(Problem::at_path(code, path, found, needed));
        }
        if run.summary["complete"] == false {
            let (code, path) = (Code::Conflict, run.directory);
            let needed = "a drop that ended as planned is needed";
            let found = "a run that is not complete";
            return Err(Problem::at_path(code, path, found, needed));
        }
        let warnings = run.summary["warnings"].as_array();
        let warned =
            |code: &str| warnings.is_some_and(|own| own.iter().any(|one| one["code"] == code));
        if let Some(why) = of_no_machine(warned) {
            let (code, path) = (Code::Conflict, run.directory);
            let found = format!("a run that qualifies no machine: {why}");
            let needed =
                "a drop of a machine that holds is needed, to its end or to the standstill";
            return Err(Problem::at_path(code, path, found, needed));
        }
        if run.bearings() != bearings {
            let found = format!("a run with the bearings {}", listed(&run.bearings()));
            let needed = format!(
                "a drop of the same machine is needed, with the bearings {}",
                listed(&bearings)
            );
            let (code, path) = (Code::Conflict, run.directory);
            return Err(Problem::at_path(code, path, found, needed));
        }
    }
    let modes: Vec<Mode> = (bearings.iter())
        .flat_map(|bearing| {
            let mut kinds: Vec<Kind> = Vec::new();
            for kind in runs.iter().flat_map(|run| run.kinds(bearing)) {
                if !kinds.contains(&kind) {
                    kinds.push(kind);
                }
            }
            kinds.sort_by_key(|(what, adds, _)| (what != FATIGUE, !adds));
            kinds
                .into_iter()
                .map(|kind| mode(&runs, bearing, kind))
                .collect::<Vec<_>>()
        })
        .collect();
    let rows = |mode: &Mode| runs.first().map_or(1, |run| run.planes(&mode.bearing));
    let damages: Option<Vec<(usize, f64)>> = (modes.iter())
        .filter(|mode| mode.what == FATIGUE)
        .map(|mode| Some((rows(mode), *mode.value.as_ref().ok()?)))
        .collect();
    // bearings in series, as the rings of one
    let all = damages.map(|list| {
        let each = (list.iter()).flat_map(|(rows, damage)| std::iter::repeat_n(*damage, *rows));
        each.fold(0.0, bearing_damage)
    });
    Ok(Service {
        survival: all.map(survival),
        services: all.map(|damage| [0.99, 0.9, 0.5].map(|share| repetitions(damage, share))),
        modes,
    })
}

fn listed(names: &[String]) -> String {
    match names {
        [only] if only.is_empty() => "of one name less bearing".to_string(),
        names => names.join(", "),
    }
}

/// A way in which bearings are used up: its words, whether drops add up, and its unit.
type Kind = (String, bool, String);

fn mode(runs: &[Run], bearing: &str, (what, adds, unit): Kind) -> Mode {
    let mut parts = Vec::new();
    let mut why = None;
    let mut variance = 0.0;
    for run in runs {
        let (mut part, mut known) = (0.0, 0);
        for start in ["", COAST_DOWN] {
            match run.last(bearing, start, &what) {
                Ok(Some(found)) => {
                    part = match adds {
                        true => part + found.mean,
                        false => found.largest.max(part),
                    };
                    known += 1;
                    let square = found.deviation * found.deviation;
                    variance +=
                        run.count * square + (run.count * run.count) * square / found.members;
                }
                // a drop that does not go on until the rotor stands has no coast-down
                Ok(None) => {}
                Err(reason) => why = Some(reason),
            }
        }
        if known == 0 && why.is_none() {
            why = Some(format!("{} has no such result", run.directory.display()));
        }
        parts.push(if adds { run.count * part } else { part });
    }
    let total = match (adds, what == FATIGUE) {
        (true, true) => together(runs, bearing).unwrap_or_else(|lacks| {
            why.get_or_insert(lacks);
            f64::NAN
        }),
        (true, false) => parts.iter().sum(),
        (false, _) => parts.iter().copied().fold(0.0, f64::max),
    };
    if why.is_none() && !(total.is_finite() && parts.iter().all(|part| part.is_finite())) {
        why = Some("a sum that is not finite".to_string());
    }
    Mode {
        bearing: bearing.to_string(),
        what,
        adds,
        value: why.map_or(Ok(total), Err),
        band: (adds && variance > 0.0).then(|| BAND * variance.sqrt()),
        unit,
        parts,
    }
}

/// Places of a ring that the points of all runs divide.
const PLACES: usize = 360;

/// Share of L10 of all drops, added up at the points of both rings.
fn together(runs: &[Run], bearing: &str) -> Result<f64, String> {
    let mut rings = [vec![0.0; PLACES], vec![0.0; PLACES]];
    for run in runs {
        let mut known = false;
        for part in ["", COAST_DOWN] {
            for (side, ring) in ["inner", "outer"].into_iter().zip(&mut rings) {
                let name = format!("{part}{side}_life_share_by_point");
                if let Some(why) = run.lacks(bearing, &name) {
                    let directory = run.directory.display();
                    return Err(format!("{directory}: {name}: {why}"));
                }
                let points = run.list(bearing, &name);
                known |= !points.is_empty();
                add_points(ring, &points, run.count);
            }
        }
        if !known {
            let directory = run.directory.display();
            return Err(format!("{directory} has no life by points of its rings"));
        }
    }
    let [inner, outer] = rings.map(|ring| mean_damage(&ring));
    Ok(bearing_damage(inner, outer))
}

impl Run<'_> {
    /// A list of numbers; empty where there is none.
    fn list(&self, bearing: &str, name: &str) -> Vec<f64> {
        let found = self.summary["quantities"][of_part(bearing, name)]["value"].as_array();
        let numbers = found.into_iter().flatten().filter_map(Value::as_f64);
        numbers.collect()
    }
    /// Why a result of it has no value; none where it has one, or no such result.
    fn lacks(&self, bearing: &str, name: &str) -> Option<&str> {
        self.summary["quantities"][of_part(bearing, name)]["why"].as_str()
    }
    /// Names of its bearings; an only one has none, and a run without bearings that can be used up has no bearing.
    fn bearings(&self) -> Vec<String> {
        let several = self.summary["auxiliary_bearings"].as_array();
        let names = several
            .into_iter()
            .flatten()
            .filter_map(|one| one["name"].as_str());
        let names: Vec<String> = names.map(str::to_string).collect();
        match names.is_empty() && !self.kinds("").is_empty() {
            true => vec![String::new()],
            false => names,
        }
    }
    /// Results of a bearing that figures of use show, in the order of their table: name without that of the bearing, kind, result.
    fn used_up(&self, bearing: &str) -> Vec<(&str, Kind, &Value)> {
        let all = self.summary["quantities"].as_object();
        let own = all.into_iter().flatten().filter_map(|(name, result)| {
            let name = match bearing {
                "" => name.as_str(),
                _ => name.strip_prefix(bearing)?.strip_prefix('.')?,
            };
            let (words, adds) = FIGURES
                .iter()
                .find_map(|(figure, adds)| Some((result["shown"][figure].as_str()?, *adds)))?;
            let unit = result["unit"].as_str().unwrap_or_default().to_string();
            Some((name, (words.to_string(), adds, unit), result))
        });
        let mut own: Vec<_> = own.collect();
        // a map of JSON is sorted by name
        own.sort_by_key(|(name, ..)| self.text.find(&format!("\"{}\":", of_part(bearing, name))));
        own
    }
    fn kinds(&self, bearing: &str) -> Vec<Kind> {
        let mut kinds: Vec<Kind> = Vec::new();
        for (name, kind, _) in self.used_up(bearing) {
            if !name.starts_with(COAST_DOWN) && !kinds.contains(&kind) {
                kinds.push(kind);
            }
        }
        kinds
    }
    /// Equal rows of a bearing, of which one was computed.
    fn planes(&self, bearing: &str) -> usize {
        let paths = ["rotor.planes", PLANES, &path_of(Some(bearing), PLANES)];
        let inputs = self.summary["inputs"].as_array().into_iter().flatten();
        let own = inputs.filter(|input| paths.iter().any(|path| input["path"] == *path));
        own.filter_map(|input| input["value"].as_str()?.parse::<usize>().ok())
            .product()
    }
    /// The last result of a kind that has a value, which knows most, of the drop or of its coast-down; the reason where none has one.
    fn last(&self, bearing: &str, start: &str, what: &str) -> Result<Option<OfMembers>, String> {
        let mut why = None;
        let all = self.used_up(bearing).into_iter().rev();
        for (name, _, found) in all.filter(|(name, kind, _)| {
            kind.0 == what && name.starts_with(COAST_DOWN) != start.is_empty()
        }) {
            let spread = &found["spread"];
            let alone = found["value"].as_f64();
            if let Some(mean) = spread["mean"].as_f64().or(alone) {
                return Ok(Some(OfMembers {
                    mean,
                    largest: spread["max"].as_f64().unwrap_or(mean),
                    deviation: spread["sd"].as_f64().unwrap_or(0.0),
                    members: spread["members"].as_f64().unwrap_or(1.0),
                }));
            }
            let said = found["why"].as_str().unwrap_or("no value");
            why.get_or_insert(format!(
                "{} of {}: {said}",
                of_part(bearing, name),
                self.directory.display()
            ));
        }
        why.map_or(Ok(None), Err)
    }
}
