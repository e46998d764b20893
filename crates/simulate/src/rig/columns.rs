//! The history of a test on a rig as columns: what happened, not what the logger saw.

use crate::bearing::columns::Table;
use crate::bearing::warm::{self, Heated};
use crate::rig::build::Built;
use crate::rig::context::{Context, bearing};
use model::bearing::BearingConstants;
use model::system::rig::layout::{
    ARM, BEARING, FLYWHEEL, HOUSING, PROBES, SHAFT, TEMPERATURE, THERMOCOUPLE,
};
use model::system::sampling::Row;
use outcome::Column;
use outcome::columns::columns;
use scenario::Rig;
use thermal::bearing_network::OUTER_RACE;

/// What the probes of the model are, in their order; empty where another column has it.
const MEANINGS: [&str; PROBES.len()] = [
    "moment t_I of the bearing that resists the shaft",
    "moment t_O of the bearing on the outer race: what the arm is to measure",
    "friction moment M of the law at this speed and load, with the drag factor of the lubricant",
    "cage slip, 1 less cage speed over its rolling speed; 0 at rest",
    "acceleration of the shaft",
    "acceleration of the flywheel",
    "torque of the clutch on the shaft",
    "torque that the clutch can carry",
    "speed by which the flywheel is ahead of the shaft",
    "torque of the motor on the flywheel",
    "drag of belt and flywheel bearings",
    "drag of the shaft's own bearings",
    "what lateral vibration adds to the moment that the arm feels",
    "spin of the cage",
    "size of the force of the balls on the outer race",
    "heat made in the bearing",
    "rate of the angular momentum of balls and cage",
    "sum of the ball loads at the inner race",
    "largest ball load at the inner race",
    "largest ball load at the outer race",
    "",
    "",
    "",
    "",
];

/// All columns; `time` first.
pub(crate) fn history(rig: &Rig, built: &Built, run: Option<&Context>) -> Vec<Column> {
    let machine = &built.machine;
    let layout = machine.layout();
    let of = run.map_or_else(|| bearing(built), Context::bearing);
    let mut table = Table::over(&of);
    columns! { table.columns, |row|
        "time": "s", "time since the start" => row.time;
        "bearing.inner_race.speed": "rad/s", "spin of the shaft with the inner race" => row.state[SHAFT.spin()];
        "flywheel.speed": "rad/s", "spin of the flywheel" => row.state[FLYWHEEL.spin()];
        "arm.reading": "N m", "torque that the swinging arm indicates, before its gauges" => row.state[ARM];
    }
    let heated = Heated::of(rig.warm.as_deref(), &rig.bearing, built.warm.as_deref());
    let warming = run.and_then(|run| run.warming);
    let warmth = warming.map(|warming| warming.followed().warmth);
    let bead = run
        .and_then(|run| run.bead)
        .map(|bead| (bead, bead.at(0.0)));
    // a network has the temperatures, or two states of the model
    let rise = |row: &Row| match (heated, warmth) {
        (Some(Heated { part, .. }), Some(warmth)) => {
            warmth.at(part, OUTER_RACE, row.time) - part.start
        }
        _ => row.state[TEMPERATURE],
    };
    let reading = |row: &Row| match bead {
        Some((bead, start)) => bead.at(row.time) - start,
        None => row.state[THERMOCOUPLE],
    };
    let centre_moves = !machine.constants.housing.centre_held;
    columns! { table.columns, |row|
        "bearing.temperature_rise": "K", "temperature of the outer race above that at the start" => rise(row);
        "thermocouple.temperature_rise": "K", "what the thermocouple has of it" => reading(row);
        "housing.x": "m", "centre of the outer race, to the right" when centre_moves => row.state[HOUSING.centre()[0]];
        "housing.y": "m", "centre of the outer race, upwards" when centre_moves => row.state[HOUSING.centre()[1]];
    }
    for (probe, ((name, unit), meaning)) in PROBES.into_iter().zip(MEANINGS).enumerate() {
        columns! { table.columns, |row| "{name}": unit, "{meaning}" when !meaning.is_empty() => row.probe[probe]; }
    }
    let rolls = matches!(of.bearing, BearingConstants::Rolling(_));
    columns! { table.columns, |row| "bearing.cage.angle": "rad", "angle of the cage" when rolls => row.state[BEARING]; }
    table.bearing();
    table.flows(layout, |_| of.bearing);
    table.outer_race_works("shaft", "shaft", layout);
    table.energies(|row| run.map(|run| run.balance(row.time, row.content, row.state)));
    warm::columns(heated, warmth, &mut table);
    table.columns.list
}
