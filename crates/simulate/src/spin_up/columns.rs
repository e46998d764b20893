//! The history of a spin-up as columns.

use crate::bearing::columns::Table;
use crate::bearing::warm;
use crate::spin_up::context::Context;
use model::system::spin_up::layout::{INNER, LARGEST_POCKET_FORCE, PROBES, ROTOR};
use outcome::Column;
use scenario::Drive;

/// What the probes of the model are, in their order.
const MEANINGS: [&str; PROBES.len()] = [
    "moment t_I of the bearing that resists the inner race",
    "moment t_O of the bearing on the outer race, which a torque arm feels",
    "friction moment M of the law at this speed and load, with the drag factor of the lubricant",
    "moment of the drive on the inner race",
    "acceleration of the inner race",
    "radial load applied to the inner race",
    "size of the force of the balls on the inner race",
    "spin of the cage",
    "cage slip, 1 less cage speed over its rolling speed; 0 at rest",
    "slip of the rotor in the bore, rotor less race",
    "friction force of the rotor on the race, forward positive",
    "sum of the ball loads at the inner race",
    "largest ball load at the inner race",
    "largest ball load at the outer race",
    "largest force of a cage pocket, or between neighbouring balls without a cage",
    "normal force of cage and land",
    "",
    "",
];

/// All columns; `time` first.
pub(crate) fn history(context: &Context) -> Vec<Column> {
    let machine = context.machine();
    let layout = machine.layout();
    let run = context.bearing();
    let mut table = Table::over(&run);

    table.add("time", "s", "time since the start", |row| row.time);
    let slides = matches!(context.spin_up.drive, Drive::SlidingRotor { .. });
    if slides {
        table.channel("rotor.speed", "rad/s", "spin of the rotor", ROTOR + 1);
    }
    table.inner_race(INNER);
    for (probe, ((name, unit), meaning)) in PROBES.iter().zip(MEANINGS).enumerate() {
        // what holds the cage follows with the balls
        if probe < LARGEST_POCKET_FORCE && (slides || !name.starts_with("rotor.")) {
            table.probe(name, unit, meaning, probe);
        }
    }
    table.bearing();
    table.flows(layout, |_| run.bearing);
    table.outer_race_works("inner race", "race", layout);
    table.energies(|row| context.balance(row.time, row.content, row.state));
    if let Some(followed) = context.warming.map(|warming| warming.followed()) {
        warm::columns(&followed, &mut table);
    }
    table.columns
}
