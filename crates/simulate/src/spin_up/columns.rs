//! The history of a spin-up as columns.

use crate::bearing::columns::Table;
use crate::bearing::warm::{self, Heated};
use crate::spin_up::build::Built;
use crate::spin_up::context::{Context, bearing};
use model::system::spin_up::layout::{INNER, LARGEST_POCKET_FORCE, PROBES, ROTOR};
use outcome::Column;
use outcome::columns::columns;
use scenario::{Drive, SpinUp};

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
pub(crate) fn history(spin_up: &SpinUp, built: &Built, run: Option<&Context>) -> Vec<Column> {
    let layout = built.machine.layout();
    let of = run.map_or_else(|| bearing(built), Context::bearing);
    let mut table = Table::over(&of);
    let slides = matches!(spin_up.drive, Drive::SlidingRotor { .. });
    columns! { table.columns, |row|
        "time": "s", "time since the start" => row.time;
        "rotor.speed": "rad/s", "spin of the rotor" when slides => row.state[ROTOR.spin()];
    }
    table.inner_race(INNER);
    for (probe, ((name, unit), meaning)) in PROBES.into_iter().zip(MEANINGS).enumerate() {
        // what holds the cage follows with the balls
        let there = probe < LARGEST_POCKET_FORCE && (slides || !name.starts_with("rotor."));
        columns! { table.columns, |row| "{name}": unit, "{meaning}" when there => row.probe[probe]; }
    }
    table.bearing();
    table.flows(layout, |_| of.bearing);
    table.outer_race_works("inner race", "race", layout);
    table.energies(|row| run.map(|run| run.balance(row.time, row.content, row.state)));
    let (warm, given) = (spin_up.warm.as_deref(), &spin_up.bearing);
    let heated = Heated::of(warm, given, built.warm.as_deref());
    let warming = run.and_then(|run| run.warming);
    let warmth = warming.map(|warming| warming.followed().warmth);
    warm::columns(heated, warmth, &mut table);
    table.columns.list
}
