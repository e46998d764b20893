//! The history of a drop as columns.

use crate::bearing::columns::Table;
use crate::bearing::run::BearingRun;
use crate::bearing::warm;
use crate::drop::context::Context;
use crate::drop::{magnets, shaft_results};
use model::auxiliary_bearing::probe::{
    BEARING_LOAD, FRICTION_FORCE, MOUNT_FORCE, NORMAL_FORCE, PENETRATION, SLIP_SPEED,
};
use model::system::energy::Balance;
use model::system::layout::of_part;
use model::system::sampling::Row;
use outcome::Column;

/// All columns; `time` first.
pub(crate) fn history(context: &Context) -> Vec<Column> {
    let machine = context.setup.machine;
    let runs: Vec<_> = (context.setup.parts().enumerate())
        .map(|(k, _)| context.bearing(k))
        .collect();
    let mut columns = of_rotor(context, &runs[0]);
    for (k, (part, run)) in context.setup.parts().zip(&runs).enumerate() {
        columns.extend(
            of_bearing(context, k, run)
                .into_iter()
                .map(|column| Column {
                    name: of_part(part, &column.name),
                    ..column
                }),
        );
    }
    columns.extend(shaft_results::columns(context, &runs[0]));
    columns.extend(magnets::columns(context, &runs[0]));
    let start = context.at_start();
    let mut table = Table::over(&runs[0]);
    table.flows(machine.layout(), |part| {
        let k = context.setup.parts().position(|name| name == part);
        runs[k.unwrap_or(0)].bearing
    });
    table.energies(|row| Balance {
        start,
        end: context.booked(row.time, row.content, row.state),
    });
    columns.extend(table.columns);
    columns
}

/// Columns of the rotor; any bearing has the rows.
fn of_rotor(context: &Context, run: &BearingRun) -> Vec<Column> {
    let mut table = Table::over(run);
    let since = match context.setup.controlled() {
        Some(_) => "time from the start of the run; the release is at release_time",
        None => "time after the release, which is the start of the run",
    };
    table.add("time", "s", since, |row| row.time);
    if context.setup.built.shaft.is_none() {
        node(&mut table, context, 0);
    }
    table.channel(
        "rotor.speed",
        "rad/s",
        "spin of the rotor",
        context.setup.machine.layout().rotor.spin(),
    );
    table.columns
}

/// The rotor at a bearing.
fn node<'a>(table: &mut Table<'a>, context: &Context<'a>, k: usize) {
    let machine = context.setup.machine;
    let centre = move |row: &Row| machine.node(k, row.state).position;
    for (name, meaning, part) in [
        (
            "rotor.x",
            "rotor centre at the bearing plane, from the line of levitation to the right",
            0,
        ),
        (
            "rotor.y",
            "rotor centre at the bearing plane, from the line of levitation upwards",
            1,
        ),
    ] {
        table.add(name, "m", meaning, move |row| {
            let at = centre(row);
            if part == 0 { at.x } else { at.y }
        });
    }
}

/// Columns of one auxiliary bearing.
fn of_bearing(context: &Context, k: usize, run: &BearingRun) -> Vec<Column> {
    let at = context.setup.machine.layout().bearings[k];
    let mut table = Table::over(run);
    if context.setup.built.shaft.is_some() {
        node(&mut table, context, k);
    }
    table.inner_race(at.inner);
    table.channel(
        "bearing.outer_race.x",
        "m",
        "outer race centre, from the line of levitation to the right",
        at.outer,
    );
    table.channel(
        "bearing.outer_race.y",
        "m",
        "outer race centre, from the line of levitation upwards",
        at.outer + 1,
    );
    if context.setup.given(k).bearing.is_some() {
        table.add(
            "bearing.cage.speed",
            "rad/s",
            "spin of the cage; without one the mean orbit speed of the balls",
            |row| context.setup.machine.cage_speed(k, row.state),
        );
    }
    table.probe(
        "bearing.contact.force",
        "N",
        "normal force of rotor and inner race",
        at.probe(NORMAL_FORCE),
    );
    table.probe(
        "bearing.contact.friction_force",
        "N",
        "friction force on the rotor, positive along t (counter-clockwise about the race)",
        at.probe(FRICTION_FORCE),
    );
    table.probe(
        "bearing.contact.penetration",
        "m",
        "penetration of rotor and inner race; negative is the remaining gap",
        at.probe(PENETRATION),
    );
    table.probe(
        "bearing.contact.slip_speed",
        "m/s",
        "sliding speed of the surfaces, inner race less rotor",
        at.probe(SLIP_SPEED),
    );
    table.probe(
        "bearing.load",
        "N",
        "size of the sum of all ball forces on the outer race",
        at.probe(BEARING_LOAD),
    );
    table.probe(
        "bearing.mount.force",
        "N",
        "size of the force of the outer race on its mount, spring and damper together",
        at.probe(MOUNT_FORCE),
    );
    table.bearing();
    if let Some(followed) = context.followed(k) {
        warm::columns(&followed, &mut table);
    }
    // the model counts places from where the bearing stands
    let datum = context.setup.machine.constants.bearings[k].datum;
    for column in &mut table.columns {
        let by = match column.name.rsplit('.').next() {
            Some("x") => datum.x,
            Some("y") => datum.y,
            _ => continue,
        };
        column.values.iter_mut().for_each(|value| *value += by);
    }
    table.columns
}
