//! Drops in a row: each begins with the clearance that the wear of those before left, and with their grease.
//!
//! Dents are not carried on: no law of this program lets one change the next drop. What each drop dents stands among its results.

use super::table::Table;
use super::{Drawn, Study};
use crate::Options;
use outcome::host;
use scenario::UNBALANCE_ANGLE;
use scenario::several::path_of;
use statistics::random::uniform;
use std::f64::consts::TAU;

/// Numbers of the drops of a row begin anew after so many.
const ROOM: usize = 10_000;
/// Apart from the numbers of the design.
const ANGLES: u64 = 0xa076_1d64_78bd_642f;
const CLEARANCE: &str = "contact.radial_air_clearance";
const WEAR: &str = "wear_depth";
/// Results of the grease with the keys that take them.
const GREASE: [(&str, &str); 2] = [
    (
        "lubricant_build_up_at_end",
        "bearing.lubricant_state.initial_build_up",
    ),
    (
        "lubricant_breakdown_at_end",
        "bearing.lubricant_state.initial_breakdown",
    ),
];

/// Drops in a row of one case at one level.
#[derive(Clone, Debug, PartialEq)]
pub struct InARow {
    /// The member that the first of them is.
    pub member: usize,
    /// Paths with the values of its case and levels.
    pub values: Vec<(String, String)>,
    /// How many there are.
    pub drops: usize,
}

impl Study {
    /// Rows of drops of the cases that ask for them, each from the member nearest to a limit.
    pub fn in_a_row(&self, table: &Table) -> Vec<InARow> {
        let of = |one: super::selection::Candidate| {
            let name = self.case_of(one.member)?;
            let drops = self.file.document.case(&name)?.drops;
            (drops > 1).then(|| InARow {
                member: one.nearest().map_or(one.member, |(.., member)| member),
                values: one.values,
                drops,
            })
        };
        self.ranking(table).into_iter().filter_map(of).collect()
    }

    /// The place of a drop of a row in the table of all.
    pub fn drop_of_row(row: usize, drop: usize) -> usize {
        row * ROOM + drop
    }

    /// Runs the drops that are missing, of all rows side by side; `keep` is given the table after each. Where this was interrupted it ends
    /// with those that had ended.
    ///
    /// # Errors
    /// What `keep` says.
    pub fn run_in_a_row<E>(
        &self,
        rows: &[InARow],
        mut table: Table,
        options: &Options,
        keep: &mut dyn FnMut(&Table) -> Result<(), E>,
    ) -> Result<Table, E> {
        let variations = self.file.scenario.variations();
        let longest = rows.iter().map(|row| row.drops).max().unwrap_or(0);
        for drop in 0..longest {
            let open = rows.iter().enumerate().filter(|(_, row)| drop < row.drops);
            let lacks =
                |(k, _): &(usize, &InARow)| !table.members.contains(&Study::drop_of_row(*k, drop));
            let open: Vec<(usize, Drawn)> = open
                .filter(lacks)
                .map(|(k, row)| (k, self.drop_values(row, k, drop, &table)))
                .collect();
            let scenarios = host::each(&open, |_, (_, drawn)| variations.with(&drawn.values));
            let count = open.len();
            let numbered = open
                .into_iter()
                .map(|(k, drawn)| (Study::drop_of_row(k, drop), drawn.numbers));
            let fresh = super::table_of(&scenarios, numbered, self.input_columns(), options);
            let whole = fresh.members.len() == count;
            if count > 0 {
                table.append(fresh);
                table = self.in_order(table.sorted());
                keep(&table)?;
            }
            if !whole {
                break;
            }
        }
        Ok(table)
    }

    /// What a drop of a row has: as its member drew, with another angle of the unbalance but for the first, and what those before left.
    fn drop_values(&self, row: &InARow, k: usize, drop: usize, table: &Table) -> Drawn {
        let mut drawn = self.drawn(row.member);
        if drop == 0 {
            return drawn;
        }
        let angle = TAU * uniform(self.file.seed ^ ANGLES, k as u64, drop as u64);
        drawn.set(UNBALANCE_ANGLE.to_string(), format!("{angle} rad"));
        let place = self
            .file
            .inputs
            .iter()
            .position(|input| input.vary.path == UNBALANCE_ANGLE);
        if let Some(place) = place {
            drawn.numbers[place] = angle;
        }
        let Ok(first) = self.file.scenario.with(&drawn.values) else {
            return drawn;
        };
        let at = |name: &str, drop: usize| -> Option<f64> {
            let place = table
                .members
                .binary_search(&Study::drop_of_row(k, drop))
                .ok()?;
            table.values(name)[place]
        };
        let bearings = self
            .known
            .iter()
            .filter_map(|known| known.name.strip_suffix(WEAR));
        for before in bearings.map(str::to_string).collect::<Vec<_>>() {
            let name = before.trim_end_matches('.');
            let bearing = (!name.is_empty()).then_some(name);
            let key = |path: &str| path_of(bearing, path);
            let worn: f64 = (0..drop)
                .filter_map(|drop| at(&format!("{before}{WEAR}"), drop))
                .sum();
            let clearance = first.resolved.of_bearing(name, CLEARANCE);
            if let (true, Some(clearance)) = (worn > 0.0, clearance.and_then(|own| own.value_si)) {
                drawn.set(key(CLEARANCE), format!("{} m", clearance + worn));
            }
            let left = GREASE
                .map(|(result, path)| Some((path, at(&format!("{before}{result}"), drop - 1)?)));
            if let [Some(one), Some(other)] = left {
                drawn.set(key("bearing.lubricant_state.start"), "given".to_string());
                for (path, value) in [one, other] {
                    drawn.set(key(path), value.to_string());
                }
            }
        }
        drawn
    }
}
