//! A run-out as it was computed, and what its rows say.

use crate::scenario::CoastDown;
use crate::simulate::coast_down::build::Built;
use crate::simulate::coast_down::course::{Course, Row};

/// A run-out, and the same with its nodes held at their limits where one is passed.
pub(super) struct Ran<'a> {
    pub run: &'a CoastDown,
    pub built: &'a Built,
    pub free: Course,
    pub held: Option<Course>,
    pub limits: [Option<f64>; 7],
}

impl Ran<'_> {
    /// The hottest a node gets: temperature in °C and time.
    pub fn peak(&self, node: usize) -> (f64, f64) {
        let rows = self.free.rows.iter();
        rows.fold((f64::NEG_INFINITY, 0.0), |(most, at), row| {
            match row.temperatures[node] > most {
                true => (row.temperatures[node], row.time),
                false => (most, at),
            }
        })
    }

    /// First time at which a quantity of the rows passes zero upwards, s.
    pub fn first(&self, of: impl Fn(&Row) -> f64) -> Option<f64> {
        let rows = &self.free.rows;
        if of(&rows[0]) > 0.0 {
            return Some(0.0);
        }
        let at = rows.iter().position(|row| of(row) > 0.0)?;
        let (before, after) = (&rows[at - 1], &rows[at]);
        let share = -of(before) / (of(after) - of(before));
        Some(before.time + share * (after.time - before.time))
    }

    /// Whether a node is there: a full complement has no cage.
    pub fn is_there(&self, node: usize) -> bool {
        node != thermal::bearing_network::CAGE || self.run.cage_mass > 0.0
    }
}
