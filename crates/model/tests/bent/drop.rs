//! The drop of a 52-element rotor onto two bearings.
//!
//! Source: `shared/cases/reference/machine_drop_flexible.json`, an ensemble of 16 of an independent implementation in 50
//! coordinates at a tolerance of 1e-8. The second bearing's mount has Maxwell branches there, which are not modelled here: what
//! leans on that mount is compared within what it may change.

use crate::files::{list, machine, number, pairs, read, shaft, unbalance};
use crate::machines::bent::Shaft;
use crate::machines::{by, settings};
use model::system::machine::RotorMachine;
use model::system::machine::record::Record;
use model::system::machine::simulate::Steps;
use serde_json::Value;
use solve::Stop;

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
    let position = shaft.coordinates(&pairs(&file["start"], "q"));
    let velocity = shaft.coordinates(&pairs(&file["start"], "qd"));
    let start = machine.start_with(&position, &velocity);
    Some((machine, start, file))
}

#[test]
fn first_impacts_are_those_of_the_reference() {
    let Some((machine, start, file)) = flexible(6e4) else {
        return;
    };
    assert_eq!(list(&file, "bearings").len(), 2);
    println!("{} coordinates", machine.layout().rotor.coordinates);
    const END: f64 = 0.05;
    for (steps, tolerance) in [(Steps::Explicit, 1e-5), (Steps::Implicit, 1e-3)] {
        let mut record = Record::new(&machine, END, END / 10.0, false);
        let ending = by(
            steps,
            &machine,
            &start,
            &settings(END, tolerance),
            &mut record,
        );
        assert_eq!(ending.stop, Stop::Finished);
        let balance = machine.balance(&start, &ending.state);
        let residual = balance.energy_residual() / balance.heat();
        println!(
            "{steps:?} {tolerance}: {:?}, residual {residual:e}",
            ending.work
        );
        assert!(residual.abs() < 1e-4, "{residual}");
        for (k, bearing) in record.bearings.iter().enumerate() {
            let reference = |name: &str| {
                let key = format!("b{}_{name}", k + 1);
                (number(&file["mean"], &key), number(&file["sd"], &key))
            };
            let ours = [
                ("t_on_1", bearing.contacts[0].start, 1e-3),
                ("peak_1", bearing.contacts[0].peak_force, 1e-2),
                ("t_on_2", bearing.contacts[1].start, 1e-2),
                ("peak_2", bearing.contacts[1].peak_force, 1e-2),
            ];
            for (name, value, floor) in ours {
                let (mean, spread) = reference(name);
                let apart = (value - mean).abs();
                println!("b{} {name}: {value} {mean}, {:.1e}", k + 1, apart / mean);
                // a contact that splits is no criterion, says the file
                let splits = spread > 0.01 * mean;
                assert!(
                    splits || apart <= 5.0 * spread + floor * mean,
                    "b{} {name}: {value} {mean}",
                    k + 1
                );
            }
            if let Some(half) = bearing.inner_race_time_to_50_percent() {
                println!(
                    "b{} half speed: {half} {:?}",
                    k + 1,
                    reference("t_inner_50%")
                );
            }
        }
    }
}
