//! The history of a test on a rig as columns: what happened, not what the logger saw.

use crate::bearing::columns::Table;
use crate::bearing::warm::{self, Followed};
use crate::rig::context::Context;
use model::bearing::BearingConstants;
use model::system::rig::layout::{
    ARM, BEARING, FLYWHEEL, HOUSING, PROBES, SHAFT, TEMPERATURE, THERMOCOUPLE,
};
use outcome::Column;
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
pub(crate) fn history(context: &Context) -> Vec<Column> {
    let machine = &context.built.machine;
    let layout = machine.layout();
    let run = context.bearing();
    let mut table = Table::over(&run);
    table.add("time", "s", "time since the start", |row| row.time);
    for (name, unit, meaning, channel) in [
        (
            "bearing.inner_race.speed",
            "rad/s",
            "spin of the shaft with the inner race",
            SHAFT + 1,
        ),
        (
            "flywheel.speed",
            "rad/s",
            "spin of the flywheel",
            FLYWHEEL + 1,
        ),
        (
            "arm.reading",
            "N m",
            "torque that the swinging arm indicates, before its gauges",
            ARM,
        ),
    ] {
        table.channel(name, unit, meaning, channel);
    }
    let (rise, of_bearing) = (
        "bearing.temperature_rise",
        "temperature of the outer race above that at the start",
    );
    let (reading, of_bead) = (
        "thermocouple.temperature_rise",
        "what the thermocouple has of it",
    );
    match (context.warming, context.bead) {
        (Some(warming), Some(bead)) => {
            let Followed { heated, warmth, .. } = warming.followed();
            let part = heated.part;
            table.add(rise, "K", of_bearing, move |row| {
                warmth.at(part, OUTER_RACE, row.time) - part.start
            });
            let start = bead.at(0.0);
            table.add(reading, "K", of_bead, move |row| bead.at(row.time) - start);
        }
        _ => {
            table.channel(rise, "K", of_bearing, TEMPERATURE);
            table.channel(reading, "K", of_bead, THERMOCOUPLE);
        }
    }
    if !machine.constants.housing.centre_held {
        for (k, (name, meaning)) in [
            ("housing.x", "centre of the outer race, to the right"),
            ("housing.y", "centre of the outer race, upwards"),
        ]
        .into_iter()
        .enumerate()
        {
            table.channel(name, "m", meaning, HOUSING + k);
        }
    }
    for (probe, ((name, unit), meaning)) in PROBES.iter().zip(MEANINGS).enumerate() {
        if !meaning.is_empty() {
            table.probe(name, unit, meaning, probe);
        }
    }
    if let BearingConstants::Rolling(_) = machine.constants.bearing {
        table.channel("bearing.cage.angle", "rad", "angle of the cage", BEARING);
    }
    table.bearing();
    table.flows(layout, |_| run.bearing);
    table.outer_race_works("shaft", "shaft", layout);
    table.energies(|row| context.balance(row.time, row.content, row.state));
    if let Some(warming) = context.warming {
        warm::columns(&warming.followed(), &mut table);
    }
    table.columns
}
