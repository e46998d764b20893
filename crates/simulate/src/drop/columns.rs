//! The history of a drop as columns.

use crate::bearing::columns::Table;
use crate::bearing::run::BearingRun;
use crate::bearing::warm;
use crate::drop::context::{Context, Setup};
use crate::drop::{magnets, shaft_results};
use model::auxiliary_bearing::probe::{
    BEARING_LOAD, FRICTION_FORCE, MOUNT_FORCE, NORMAL_FORCE, PENETRATION, SLIP_SPEED,
};
use model::system::layout::of_part;
use outcome::Column;
use outcome::columns::columns;

/// All columns; `time` first.
pub(crate) fn history(setup: Setup, run: Option<&Context>) -> Vec<Column> {
    let machine = setup.machine;
    let bearing = |k| run.map_or_else(|| setup.bearing(k), |run| run.bearing(k));
    let runs: Vec<_> = (0..setup.parts().count()).map(bearing).collect();
    let mut columns = of_rotor(setup, &runs[0]);
    for (k, (part, of)) in setup.parts().zip(&runs).enumerate() {
        let own = of_bearing(setup, k, of, run).into_iter();
        columns.extend(own.map(|column| Column {
            name: of_part(part, &column.name),
            ..column
        }));
    }
    columns.extend(shaft_results::columns(setup, &runs[0]));
    columns.extend(magnets::columns(setup, &runs[0]));
    let mut table = Table::over(&runs[0]);
    table.flows(machine, |part| {
        let k = setup.parts().position(|name| name == part);
        runs[k.unwrap_or(0)].bearing
    });
    table.energies(|row| run.map(|run| run.finished.balance(row.time, row.content, row.state)));
    // of equal planes of the whole rotor those of one
    let planes = f64::from(setup.drop().rotor.planes);
    let values = |column: &mut Column| column.values.iter_mut().for_each(|value| *value /= planes);
    table.columns.list.iter_mut().for_each(values);
    columns.extend(table.columns.list);
    columns
}

/// Columns of the rotor; any bearing has the rows.
fn of_rotor(setup: Setup, run: &BearingRun) -> Vec<Column> {
    let mut table = Table::over(run);
    let since = match setup.controlled() {
        Some(_) => "time from the start of the run; the release is at release_time",
        None => "time after the release, which is the start of the run",
    };
    columns! { table.columns, |row| "time": "s", "{since}" => row.time; }
    if setup.built.shaft.is_none() {
        node(&mut table, setup, 0);
    }
    let spin = setup.machine.layout().rotor.spin();
    columns! { table.columns, |row| "rotor.speed": "rad/s", "spin of the rotor" => row.state[spin]; }
    let rotor = setup.machine.layout().rotor;
    if rotor.axial {
        columns! { table.columns, |row|
            "rotor.z": "m", "rotor along its axis from the start, towards the end of the shaft" => row.state[rotor.place()];
            "rotor.z_speed": "m/s", "its speed" => row.state[rotor.place() + 1];
        }
    }
    if let Some(base) = &setup.machine.constants.base {
        columns! { table.columns, |row|
            "base.acceleration_x": "m/s^2", "acceleration of the base along x; displacements are relative to the base" => base.acceleration(row.time).x;
            "base.acceleration_y": "m/s^2", "acceleration of the base along y" => base.acceleration(row.time).y;
        }
    }
    table.columns.list
}

/// The rotor at a bearing.
fn node(table: &mut Table, setup: Setup, k: usize) {
    let centre = |state| setup.machine.node(k, state).position;
    columns! { table.columns, |row|
        "rotor.x": "m", "rotor centre at the bearing plane, from the line of levitation to the right" => centre(row.state).x;
        "rotor.y": "m", "rotor centre at the bearing plane, from the line of levitation upwards" => centre(row.state).y;
    }
}

/// Columns of one auxiliary bearing.
fn of_bearing(setup: Setup, k: usize, of: &BearingRun, run: Option<&Context>) -> Vec<Column> {
    let machine = setup.machine;
    let at = &machine.layout().bearings[k];
    let mut table = Table::over(of);
    if setup.built.shaft.is_some() {
        node(&mut table, setup, k);
    }
    table.inner_race(at.inner);
    columns! { table.columns, |row|
        "bearing.outer_race.x": "m", "outer race centre, from the line of levitation to the right" => row.state[at.outer.centre()[0]];
        "bearing.outer_race.y": "m", "outer race centre, from the line of levitation upwards" => row.state[at.outer.centre()[1]];
        "bearing.cage.speed": "rad/s", "spin of the cage; without one the mean orbit speed of the balls"
            when setup.given(k).bearing.is_some() => machine.cage_speed(k, row.state);
        "bearing.contact.force": "N", "normal force of rotor and inner race" => row.probe[at.probe(NORMAL_FORCE)];
        "bearing.contact.friction_force": "N", "friction force on the rotor, positive along t (counter-clockwise about the race)"
            => row.probe[at.probe(FRICTION_FORCE)];
        "bearing.contact.penetration": "m", "penetration of rotor and inner race; negative is the remaining gap"
            => row.probe[at.probe(PENETRATION)];
        "bearing.contact.slip_speed": "m/s", "sliding speed of the surfaces, inner race less rotor" => row.probe[at.probe(SLIP_SPEED)];
        "bearing.load": "N", "size of the sum of all ball forces on the outer race" => row.probe[at.probe(BEARING_LOAD)];
        "bearing.mount.force": "N", "size of the force of the outer race on its mount, spring and damper together"
            => row.probe[at.probe(MOUNT_FORCE)];
    }
    table.bearing();
    let followed = run.and_then(|run| run.followed(k));
    warm::columns(setup.heated(k), followed.map(|of| of.warmth), &mut table);
    // the model counts places from where the bearing stands
    let datum = machine.constants.bearings[k].datum;
    for column in &mut table.columns.list {
        let by = match column.name.rsplit('.').next() {
            Some("x") => datum.x,
            Some("y") => datum.y,
            _ => continue,
        };
        column.values.iter_mut().for_each(|value| *value += by);
    }
    table.columns.list
}
