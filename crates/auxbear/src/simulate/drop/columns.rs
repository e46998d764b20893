//! The history of a drop as columns.

use crate::result::outcome::Column;
use crate::simulate::bearing::columns::Table;
use crate::simulate::drop::Context;
use model::system::drop::layout::{
    FRICTION_FORCE, INNER, NORMAL_FORCE, OUTER, PENETRATION, ROTOR, SLIP_SPEED,
};
use model::system::sampling::Row;

/// All columns; `time` first.
pub(crate) fn history(context: &Context) -> Vec<Column> {
    let machine = context.machine;
    let layout = machine.layout();
    let run = context.bearing();
    let mut table = Table::over(&run);

    table.add("time", "s", "time since release", |row| row.time);
    let centre = |row: &Row| machine.rotor_centre(row.state);
    table.add(
        "rotor.x",
        "m",
        "rotor centre at the bearing plane, to the right",
        |row| centre(row).x,
    );
    table.add(
        "rotor.y",
        "m",
        "rotor centre at the bearing plane, upwards",
        |row| centre(row).y,
    );
    table.channel("rotor.speed", "rad/s", "spin of the rotor", ROTOR + 5);
    table.inner_race(INNER);
    table.channel(
        "bearing.outer_race.x",
        "m",
        "outer race centre, to the right",
        OUTER,
    );
    table.channel(
        "bearing.outer_race.y",
        "m",
        "outer race centre, upwards",
        OUTER + 1,
    );
    table.add(
        "bearing.cage.speed",
        "rad/s",
        "spin of the cage; without one the mean orbit speed of the balls",
        |row| machine.cage_speed(row.state),
    );
    table.probe(
        "bearing.contact.force",
        "N",
        "normal force of rotor and inner race",
        NORMAL_FORCE,
    );
    table.probe(
        "bearing.contact.friction_force",
        "N",
        "friction force on the rotor, positive along t (counter-clockwise about the race)",
        FRICTION_FORCE,
    );
    table.probe(
        "bearing.contact.penetration",
        "m",
        "penetration of rotor and inner race; negative is the remaining gap",
        PENETRATION,
    );
    table.probe(
        "bearing.contact.slip_speed",
        "m/s",
        "sliding speed of the surfaces, inner race less rotor",
        SLIP_SPEED,
    );
    table.bearing();
    table.flows("release", layout);
    let start = &context.finished.start;
    table.energies(|state| machine.balance(start, state));
    table.columns
}
