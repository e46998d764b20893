//! Many runs of one scenario: which values each member takes, what it gives, and what all of them say.
//!
//! | page | subject |
//! |---|---|
//! | here | a study ready to run; its members |
//! | [`table`] | drawn inputs beside results, a row a member |
//! | [`selection`] | candidates judged by their limits and ranked |
//! | [`confirm`] | members near a limit, once more at design accuracy |
//! | [`answer`] | spread, limits and sensitivity from that table |
//! | [`little_known`] | what verdicts of a qualification owe to the inputs that are known least |
//! | [`failure_modes`] | ways in which bearings fail, with the results that show them |
//! | [`in_a_row`] | drops in a row, with the wear of those before |
//! | [`estimate`] | inputs that measured curves determine |
//! | [`predicted`] | signals of a test with their bands |
//! | [`parts`] | members that stand in a file together, and how many are computed at a time |
//! | [`kept`] | what is kept of the members of a repetition, and where |
//! | `repeat` | a run that is repeated: perturbed starts, machines that differ |

pub mod answer;
pub mod confirm;
pub mod estimate;
pub mod failure_modes;
pub mod in_a_row;
pub mod kept;
pub mod little_known;
pub mod parts;
pub mod predicted;
pub(crate) mod repeat;
pub mod selection;
pub mod table;

use outcome::{Options, host, limits};
use outcome::{Quantity, Value};
use problem::{Place, Problem, Result};
use scenario::{CASE, Distribution, Scenario, StudyFile};
use statistics::design::Coordinate;
use std::sync::atomic::AtomicBool;
use table::{Column, Table};

/// Runs a scenario with each of these lists of changes, paths with their values as an override has them: a row each, results
/// alone. Values that are refused are the reason of a failed row; a change that no value could cure, such as an unknown key, is a
/// problem of all. None where this was interrupted.
pub fn evaluate(
    scenario: &Scenario,
    changes: &[Vec<(String, String)>],
    options: &Options,
) -> Result<Option<Table>> {
    let variations = scenario.variations();
    let scenarios = host::each(changes, |_, changes| variations.with(changes));
    let mut refused = scenarios.iter().filter_map(|read| read.as_ref().err());
    if let Some(problem) = refused.find(|problem| problem.code.is_of_form()) {
        return Err(problem.clone());
    }
    let numbered = (0..changes.len()).map(|k| (k, Vec::new()));
    let table = table_of(&scenarios, numbered, Vec::new(), options);
    Ok((table.members.len() == changes.len()).then_some(table))
}

/// Runs scenarios; each with its number and its inputs becomes a row, but those that were interrupted.
fn table_of(
    scenarios: &[Result<Scenario>],
    numbered: impl Iterator<Item = (usize, Vec<f64>)>,
    inputs: Vec<Column>,
    options: &Options,
) -> Table {
    let mut table = Table::of(inputs);
    for ((member, inputs), outcome) in numbered.zip(crate::each(scenarios, options)) {
        if !outcome.stop.interrupted() {
            table.push(member, inputs, &outcome);
        }
    }
    table
}

/// A study that is ready to run.
pub struct Study {
    /// What it asks.
    pub file: StudyFile,
    /// The results of a run, with unit and law, without values.
    pub known: Vec<Quantity>,
}

/// What a member drew.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Paths with their values, as an override has them.
    pub values: Vec<(String, String)>,
    /// Each input as a number: in SI, or the place of a text in its list; not a number where it is as given and no number.
    pub numbers: Vec<f64>,
}

impl Drawn {
    /// Gives a path another value.
    fn set(&mut self, path: String, value: String) {
        self.values.retain(|(own, _)| *own != path);
        self.values.push((path, value));
    }
}

impl Study {
    /// Checks that the scenario can be run and has the results that are asked for.
    ///
    /// # Errors
    /// What is wrong with scenario, limits or results.
    pub fn new(mut file: StudyFile) -> Result<Study> {
        let machine = crate::build(&file.scenario)?;
        let mut known = machine.results();
        // and what only happens in other cases
        known.extend(crate::of_other_cases(&file.scenario, &machine)?);
        // numbers that only a run names are named by one with the values as given
        let number = |value: &Value| matches!(value, Value::Number(_) | Value::None { .. });
        if known
            .iter()
            .any(|known| known.name.contains('*') && number(&known.value))
        {
            let never = AtomicBool::new(false);
            known = machine.run(&Options::unwatched(&never)).quantities;
        }
        drop(machine);
        let own = file.limits.len() - file.scenario.limits.len();
        let declared = crate::warnings::of(&file.scenario);
        limits::check(&file.limits[..own], &known, &declared).map_err(|mut problem| {
            problem.file.clone_from(&file.file);
            problem
        })?;
        file.limits = limits::named(&file.limits, &known);
        file.scenario.limits = limits::named(&file.scenario.limits, &known);
        for (name, _) in &mut file.results {
            *name = scenario::present_name(name);
        }
        if let Some((name, ..)) = &mut file.rank {
            *name = scenario::present_name(name);
        }
        let each = |(name, place): &(String, Place)| -> Vec<(String, Place)> {
            let among = known.iter().filter(|known| limits::fits(name, known));
            let own: Vec<_> = among.map(|known| (known.name.clone(), *place)).collect();
            if own.is_empty() {
                vec![(name.clone(), *place)]
            } else {
                own
            }
        };
        file.results = file.results.iter().flat_map(each).collect();
        let rank = file
            .rank
            .iter()
            .map(|(name, _, place)| ("question.rank", name, place));
        let shown = file.results.iter();
        let shown = shown.map(|(name, place)| ("question.results", name, place));
        for (key, name, place) in shown.chain(rank) {
            let number = |known: &&Quantity| {
                known.name == *name && matches!(known.value, Value::Number(_) | Value::None { .. })
            };
            if !known.iter().any(|quantity| number(&quantity)) {
                use problem::Code;
                let names: Vec<&str> = known.iter().map(|known| known.name.as_str()).collect();
                let problem = Problem::new(
                    Code::UnknownQuantity,
                    &file.file,
                    format!("\"{name}\", which is no number among the results of this scenario"),
                    "the name of a result is needed; auxbear results FILE lists them",
                );
                let problem = problem.at(*place).on_key(key);
                return Err(problem.with_hint(limits::meant(name, &names)));
            }
        }
        Ok(Study { file, known })
    }

    /// Number of members.
    pub fn members(&self) -> usize {
        self.file.design.members().unwrap_or(0)
    }

    /// Draws of each case of a qualification; 1 of other designs.
    pub fn draws(&self) -> usize {
        match self.file.design {
            statistics::design::Design::Selection(_, draws) => draws,
            _ => 1,
        }
    }

    /// What member k draws.
    pub fn drawn(&self, k: usize) -> Drawn {
        let file = &self.file;
        let mut coordinates = file.design.member(file.seed, k);
        if let Some(correlation) = &file.correlation {
            let share = |coordinate: &Coordinate| match coordinate {
                Coordinate::Share(u) => *u,
                _ => 0.5,
            };
            let independent: Vec<f64> = coordinates.iter().map(share).collect();
            let mixed = correlation.apply(&independent);
            coordinates = mixed.into_iter().map(Coordinate::Share).collect();
        }
        let mut drawn = Drawn {
            values: Vec::new(),
            numbers: Vec::new(),
        };
        for (input, coordinate) in file.inputs.iter().zip(coordinates) {
            let (values, number) = input.vary.at(coordinate);
            drawn.values.extend(values);
            drawn.numbers.push(number.unwrap_or(f64::NAN));
        }
        drawn
    }

    /// The case that happens in member k; none of what has no cases.
    pub fn case_of(&self, k: usize) -> Option<String> {
        let mut drawn = self.drawn(k).values.into_iter();
        let drawn = drawn.find(|(path, _)| path == CASE).map(|(_, case)| case);
        let cases = self.file.scenario.system.cases();
        drawn.or(cases.chosen().map(str::to_string))
    }

    /// The scenario of member k.
    ///
    /// # Errors
    /// What a file with these values would be refused for.
    pub fn scenario(&self, k: usize) -> Result<Scenario> {
        self.file.scenario.with(&self.drawn(k).values)
    }

    /// Runs some members, with results in the order of a run; where this was interrupted those that had ended.
    pub fn run(&self, members: &[usize], options: &Options) -> Table {
        self.run_with(members, &[], options)
    }

    /// Runs some members with values that all of them have besides.
    fn run_with(&self, members: &[usize], all: &[(String, String)], options: &Options) -> Table {
        let drawn: Vec<Drawn> = members.iter().map(|k| self.drawn(*k)).collect();
        let variations = self.file.scenario.variations();
        let scenarios = host::each(&drawn, |_, drawn| {
            let values = drawn.values.iter().chain(all).cloned();
            variations.with(&values.collect::<Vec<_>>())
        });
        let inputs = drawn.into_iter().map(|drawn| drawn.numbers);
        let numbered = members.iter().copied().zip(inputs);
        let table = table_of(&scenarios, numbered, self.input_columns(), options);
        host::discard(scenarios);
        self.in_order(table)
    }

    /// A table with its results in the order of a run.
    pub fn in_order(&self, table: Table) -> Table {
        let names = self.known.iter().map(|known| known.name.as_str());
        table.ordered(&names.collect::<Vec<_>>())
    }

    /// Columns of the inputs, without values.
    pub fn input_columns(&self) -> Vec<Column> {
        let column = |input: &scenario::StudyInput| {
            let meaning = match &input.vary.distribution {
                Distribution::Choice(texts) => {
                    let words: Vec<String> = (texts.iter().enumerate())
                        .map(|(k, text)| format!("{k}: {text}"))
                        .collect();
                    words.join(", ")
                }
                _ => "drawn".to_string(),
            };
            // the number of a choice is its place
            let of_choice = matches!(input.vary.distribution, Distribution::Choice(_));
            Column {
                name: format!("input.{}", input.vary.path),
                unit: if of_choice {
                    String::new()
                } else {
                    input.vary.unit()
                },
                meaning,
                values: Vec::new(),
            }
        };
        self.file.inputs.iter().map(column).collect()
    }
}
