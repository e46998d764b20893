//! What a test of one case will show: each signal over time, with the band in which 90 % of the draws lie.

use super::Study;
use super::table::Column;
use crate::Options;
use outcome::{Spread, host};
use scenario::CASE;
use std::sync::atomic::Ordering;

/// Rows of a predicted signal.
const ROWS: f64 = 400.0;
/// Draws that make a band, at most.
const MOST_DRAWS: usize = 64;
/// What a test can measure, by the ends of its columns.
const MEASURED: [&str; 7] = [
    "rotor.x",
    "rotor.y",
    "rotor.speed",
    "inner_race.speed",
    "cage.speed",
    "mount.force",
    "temperature",
];
/// Ends of the columns of a signal, in the order of a band.
pub const BAND: [&str; 3] = [".5_percent", ".median", ".95_percent"];

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
            rows: None,
        };
        let rows = (
            "run.output_interval".to_string(),
            format!("{} s", duration / ROWS),
        );
        let histories = host::in_pool(options.threads, || {
            host::each(&members, |_, member| {
                let mut values = self.drawn(*member).values;
                values.push(rows.clone());
                let scenario = self.file.scenario.with(&values).ok()?;
                let outcome = crate::build(&scenario).ok()?.run(&quiet);
                outcome.stop.complete().then_some(outcome.history)
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
        for signal in one {
            let named =
                |end: &&&str| signal.name == **end || signal.name.ends_with(&format!(".{end}"));
            let of_magnet = signal.name.starts_with("magnet.");
            if !of_magnet && MEASURED.iter().find(named).is_none() {
                continue;
            }
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
