//! Unbalances that come during a run, as where a blade is lost, and drives that change.

use crate::drop::Shaft;
use crate::drop::magnets_in_time::{InTime, happens};
use model::rotor::Unbalance;
use model::system::machine::Event;
use scenario::Happens;

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
    for event in &shaft.events {
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
