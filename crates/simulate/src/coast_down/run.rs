//! A coast-down as it was computed, and what its rows say.

use crate::coast_down::build::{CoastDownModel, OnLimits, Part, Start};
use crate::coast_down::course::{self, Course};
use crate::coast_down::passages::limits;
use crate::coast_down::rows::{Row, RowOfBearing};
use problem::Problem;
use std::sync::atomic::AtomicBool;
use thermal::bearing_network::NODES;
use thermal::held::Held;

/// A coast-down, and the same with its nodes held at their limits where one is passed.
pub(crate) struct CoastDownRun<'a> {
    pub built: &'a CoastDownModel,
    pub free: Course,
    pub held: Option<Course>,
    /// Of the nodes of all bearings, °C.
    pub limits: Vec<Option<f64>>,
}

/// Computes a coast-down.
pub(crate) fn run<'a>(
    built: &'a CoastDownModel,
    interrupt: &AtomicBool,
) -> Result<CoastDownRun<'a>, Box<Problem>> {
    let each = built.parts.iter().flat_map(|part| limits(&part.warm));
    let limits: Vec<_> = each.collect();
    let free = course::follow(built, None, interrupt)?;
    let passes = |row: &Row| {
        let mut nodes = row.temperatures.iter().zip(&limits);
        nodes.any(|(now, limit)| limit.is_some_and(|limit| *now > limit))
    };
    let held = match free.rows.iter().any(passes) {
        // between two intervals nothing is known of what comes after the end of this one
        true if built.motion.is_some() && free.end.leaves() => {
            let mut until = built.clone();
            let delay = built.start.on_limits.as_ref().map_or(0.0, |way| way.delay);
            until.end.longest = free.state.time + delay;
            Some(course::follow(&until, Some(&limits), interrupt)?)
        }
        true => Some(course::follow(built, Some(&limits), interrupt)?),
        false => None,
    };
    Ok(CoastDownRun {
        built,
        free,
        held,
        limits,
    })
}

/// A node of a bearing, with its place among those of all.
#[derive(Clone, Copy)]
pub(crate) struct NodeOf {
    pub bearing: usize,
    pub node: usize,
}

impl NodeOf {
    /// Its place among the nodes of all bearings.
    pub fn place(self) -> usize {
        self.bearing * NODES.len() + self.node
    }
    /// Its name: `inner_race`.
    pub fn name(self) -> &'static str {
        NODES[self.node]
    }
}

impl Part {
    /// The nodes of this bearing, by its place, that are there: a full complement has no cage.
    pub fn nodes(&self, bearing: usize) -> impl Iterator<Item = NodeOf> {
        let there = (0..NODES.len()).filter(|node| self.network.has(*node));
        there.map(move |node| NodeOf { bearing, node })
    }
}

impl CoastDownRun<'_> {
    /// Where another coast-down goes on, at the end of this one: the last row is that of its first.
    pub fn start(&self) -> Start {
        let before = |course: &Course| {
            course
                .rows
                .split_last()
                .map_or(Vec::new(), |all| all.1.to_vec())
        };
        let state = &self.free.state;
        let bearings = self.built.parts.len();
        let mut start = Start::at(
            state.time,
            state.speed,
            state.temperatures.clone(),
            bearings,
        );
        start.heats.clone_from(&state.heats);
        start.given = state.given;
        start.at_nodes = state.at_nodes.clone();
        start.beyond_data.clone_from(&self.built.start.beyond_data);
        start.rows = before(&self.free);
        start.on_limits = Some(match &self.held {
            Some(course) => OnLimits {
                held: course.held.clone(),
                temperatures: course.state.temperatures.clone(),
                taken: course.taken.clone(),
                powers: course.powers.clone(),
                rows: before(course),
                delay: course.state.time - state.time,
            },
            None => {
                let held = Held::at(self.limits.clone());
                OnLimits::from(held, state.temperatures.clone(), start.rows.clone())
            }
        });
        start
    }

    /// The bearings with their places.
    pub fn parts(&self) -> impl Iterator<Item = (usize, &Part)> {
        self.built.parts.iter().enumerate()
    }

    /// The hottest a node gets: temperature in °C and time.
    pub fn peak(&self, node: NodeOf) -> (f64, f64) {
        let rows = self.free.rows.iter();
        rows.fold((f64::NEG_INFINITY, 0.0), |(most, at), row| {
            match row.temperatures[node.place()] > most {
                true => (row.temperatures[node.place()], row.time),
                false => (most, at),
            }
        })
    }

    /// Rows of a bearing.
    pub fn rows(&self, bearing: usize) -> impl Iterator<Item = &RowOfBearing> {
        let rows = self.free.rows.iter();
        rows.map(move |row| &row.bearings[bearing])
    }

    /// Temperatures of the nodes of a bearing on the way, °C.
    pub fn temperatures(&self, bearing: usize) -> impl Iterator<Item = &[f64]> {
        let rows = self.free.rows.iter();
        rows.map(move |row| &row.temperatures[bearing * NODES.len()..][..NODES.len()])
    }

    /// First time at which a quantity of the rows passes zero upwards, s.
    pub fn first(&self, of: impl Fn(&Row) -> f64) -> Option<f64> {
        let rows = &self.free.rows;
        if of(&rows[0]) > 0.0 {
            return Some(rows[0].time);
        }
        let at = rows.iter().position(|row| of(row) > 0.0)?;
        let (before, after) = (&rows[at - 1], &rows[at]);
        let share = -of(before) / (of(after) - of(before));
        Some(before.time + share * (after.time - before.time))
    }
}
