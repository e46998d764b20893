//! Unbalances and loads that come during a run, as where a blade is lost, and drives that change.

use crate::drop::Shaft;
use crate::drop::magnets_in_time::{InTime, happens};
use model::rotor::{RotorConstants, Unbalance};
use model::system::machine::{self, Event};
use number::Vec2;
use problem::{Code, Result};
use scenario::{Happens, problem_at};

const _: () = assert!(
    scenario::MOST_SPEEDS == machine::MOST_SPEEDS
        && scenario::MOST_LOADED == machine::MOST_LOADED
        && scenario::MOST_UNBALANCES == machine::MOST_UNBALANCES
);

/// Nodes at which loads come.
pub(super) fn loaded(shaft: &Shaft) -> Vec<usize> {
    let mut nodes = Vec::new();
    for event in &shaft.events {
        if let Happens::Load { node, .. } = event.what
            && !nodes.contains(&shaft.model.named[node])
        {
            nodes.push(shaft.model.named[node]);
        }
    }
    nodes
}

/// The unbalances that come, with their events; `row` gives the row of a node.
pub(super) fn built(
    shaft: &Shaft,
    row: &dyn Fn(usize) -> Vec<f64>,
    in_time: &mut InTime,
) -> Vec<Unbalance> {
    let mut list = Vec::new();
    let InTime {
        known, at_speeds, ..
    } = in_time;
    let loaded = loaded(shaft);
    for event in &shaft.events {
        if let Happens::Load { node, force } = event.what {
            let at = |own: &usize| *own == shaft.model.named[node];
            let place = loaded.iter().position(at).unwrap_or_default();
            let load = Event::Load(place, Vec2::new(force[0], force[1]));
            happens(event.when, load, known, at_speeds);
        }
        if let Happens::Drive(torque) = event.what {
            let more = torque - shaft.drive_torque;
            happens(event.when, Event::Drive(more), known, at_speeds);
        }
        if let Happens::Unbalance {
            plane,
            amount,
            phase,
        } = event.what
        {
            happens(event.when, Event::Unbalance(list.len()), known, at_speeds);
            list.push(Unbalance {
                node: row(shaft.model.rotor.unbalance[plane].node),
                product: amount,
                phase,
            });
        }
    }
    list
}

/// Refuses unbalances that would leave the rotor no moment of inertia about its mass centre, whatever their directions.
pub(super) fn check(rotor: &RotorConstants, unbalances: &[Unbalance]) -> Result<()> {
    let about_centre = rotor.coordinates.iter().enumerate().map(|(k, own)| {
        let added = unbalances
            .iter()
            .map(|plane| plane.product * plane.node[k].abs());
        let largest = own.unbalance.length_squared().sqrt() + added.sum::<f64>() / own.mass;
        own.mass * (largest * largest - own.unbalance.length_squared())
    });
    if rotor.polar_inertia > about_centre.sum::<f64>() {
        return Ok(());
    }
    let found =
        "unbalances that come and leave the rotor no moment of inertia about its mass centre";
    Err(problem_at(
        Code::Impossible,
        "event.amount",
        found,
        "smaller amounts are needed",
    ))
}
