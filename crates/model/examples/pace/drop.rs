//! The drop of a 52-element rotor onto two bearings of `shared/cases/reference/machine_drop_flexible.json`.

use crate::files::{coordinates, machine, number, pairs, read, shaft, unbalance};
use crate::machines::bent::Shaft;
use model::system::machine::RotorMachine;
use serde_json::Value;

/// Nodes of bearings, magnets, sensors and unbalances.
pub const KEPT: [usize; 8] = [5, 6, 10, 12, 28, 43, 45, 50];

/// The machine of the reference in coordinates up to a cut (rad/s), and its start.
pub fn flexible(cut: f64) -> Option<(RotorMachine, Vec<f64>, Value)> {
    let file = read("reference", "machine_drop_flexible")?;
    let of_rotor = read("rotor", "ross_amb_rotor_freefree")?;
    let mut rotor = shaft(&of_rotor["model"]);
    for element in &mut rotor.elements {
        element.damping_of_stiffness += number(&file, "beta_added");
    }
    rotor.unbalance = unbalance(&file);
    let shaft = Shaft::reduced(rotor, cut, &KEPT);
    let machine = RotorMachine::new(machine(&file, &shaft, number(&file, "Om")));
    let position = coordinates(&shaft, &pairs(&file["start"], "q"));
    let velocity = coordinates(&shaft, &pairs(&file["start"], "qd"));
    let start = machine.start_with(&position, &velocity);
    Some((machine, start, file))
}
