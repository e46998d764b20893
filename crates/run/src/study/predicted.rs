//! What a test of one case will show: each signal over time, with the band in which 90 % of the draws lie.

use super::Study;
use super::table::Column;
use crate::Options;
use outcome::{Spread, host};
use scenario::CASE;
use std::f64::consts::TAU;
use std::sync::atomic::Ordering;

/// Rows of a predicted signal at least and at most.
const ROWS: [f64; 2] = [400.0, 4000.0];
/// Bandwidth that a test is planned with, in speeds of the rotor.
pub const BANDWIDTH: f64 = 10.0;
/// Draws that make a band, at most.
const MOST_DRAWS: usize = 64;
/// What a test can measure, by the ends of its columns.
const MEASURED: [&str; 9] = [
    "rotor.x",
    "rotor.y",
    "rotor.z",
    "contact.axial_force",
    "rotor.speed",
    "inner_race.speed",
    "cage.speed",
    "mount.force",
    "temperature",
];
/// Ends of the columns of a signal, in the order of a band.
pub const BAND: [&str; 3] = [".5_percent", ".median", ".95_percent"];

fn is_measured(name: &str) -> bool {
    let is_end = |end: &&str| {
        (name.strip_suffix(end)).is_some_and(|own| own.is_empty() || own.ends_with('.'))
    };
    name.starts_with("magnet.") || MEASURED.iter().any(is_end)
}

impl Study {
    /// The first member of the case that is to be tested, at the levels that are the values of the scenario, else at the last ones.
    pub fn tested(&self) -> usize {
        let wanted = self
            .file
            .document
            .test_case
            .clone()
            .or_else(|| self.case_of(0));
        let firsts = (0..self.members()).step_by(self.draws());
        let of_case: Vec<usize> = firsts
            .filter(|member| self.case_of(*member) == wanted)
            .collect();
        let scenario = &self.file.scenario.resolved;
        let levels = || {
            self.file
                .inputs
                .iter()
                .filter(|input| input.levels > 0 && input.vary.path != CASE)
        };
        let as_given = |member: &&usize| {
            let drawn = self.drawn(**member).values;
            levels().all(|input| {
                let level = drawn.iter().find(|(path, _)| *path == input.vary.path);
                let given = scenario
                    .get(&input.vary.path)
                    .and_then(|value| value.text.as_ref());
                level.map(|(_, text)| text) == given
            })
        };
        let given = of_case.iter().find(as_given);
        given.or(of_case.last()).copied().unwrap_or(0)
    }

    /// Time, then three columns a signal, over the draws of the tested case; nothing where this was interrupted or no draw ends as planned.
    pub fn predicted(&self, options: &Options) -> Option<Vec<Column>> {
        let first = self.tested();
        let draws = self.draws().min(MOST_DRAWS);
        let duration = self.file.scenario.drop()?.run.duration;
        let members: Vec<usize> = (first..first + draws).collect();
        let quiet = Options {
            threads: Some(1),
            interrupt: options.interrupt,
            progress: &|_| {},
            controllers: options.controllers,
            rows: None,
        };
        // two rows in each period of the bandwidth
        let tested = self.file.scenario.with(&self.drawn(first).values).ok()?;
        let bandwidth = BANDWIDTH * tested.drop()?.rotor.speed.abs() / TAU;
        let rows = (2.0 * bandwidth * duration).ceil().clamp(ROWS[0], ROWS[1]);
        let rows = (
            "run.output_interval".to_string(),
            format!("{} s", duration / rows),
        );
        let histories = host::in_pool(options.threads, || {
            host::each(&members, |_, member| {
                let mut values = self.drawn(*member).values;
                values.push(rows.clone());
                let scenario = self.file.scenario.with(&values).ok()?;
                let outcome = crate::build(&scenario).ok()?.run(&quiet);
                let mut history = outcome.history;
                history.retain(|own| own.name == "time" || is_measured(&own.name));
                outcome.stop.complete().then_some(history)
            })
        });
        let histories: Vec<Vec<outcome::Column>> = histories.into_iter().flatten().collect();
        let one = histories
            .first()
            .filter(|_| !options.interrupt.load(Ordering::Relaxed))?;
        let time = one.first()?;
        let column = |name: String, unit: &str, meaning: String, values: Vec<f64>| Column {
            name,
            unit: unit.to_string(),
            meaning,
            values,
        };
        let mut found = vec![column(
            time.name.clone(),
            time.unit,
            time.meaning.clone(),
            time.values.clone(),
        )];
        for signal in &one[1..] {
            let same = histories
                .iter()
                .map(|history| history.iter().find(|own| own.name == signal.name));
            let same: Vec<&outcome::Column> = same.flatten().collect();
            let bands = (0..time.values.len()).map(|row| {
                let values = same.iter().filter_map(|own| own.values.get(row).copied());
                let values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
                Spread::of(values).map_or([f64::NAN; 3], |spread| spread.quantiles)
            });
            let bands: Vec<[f64; 3]> = bands.collect();
            found.extend(BAND.iter().enumerate().map(|(k, end)| {
                let values = bands.iter().map(|band| band[k]).collect();
                column(
                    format!("{}{end}", signal.name),
                    signal.unit,
                    signal.meaning.clone(),
                    values,
                )
            }));
        }
        Some(found)
    }
}
