//! The history of a spin-up as columns.

use crate::bearing::columns::Table;
use crate::bearing::warm;
use crate::rig::run::{RigModel, bearing};
use crate::spin_up::{Context, given};
use model::auxiliary_bearing::probe::{
    FRICTION_FORCE, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, NORMAL_FORCE, SLIP_SPEED,
};
use model::system::rig::layout::{
    ACCELERATION, CAGE_SLIP, CAGE_SPEED, DRIVE_MOMENT, INNER, INNER_FORCE, INNER_LOAD_SUM,
    INNER_MOMENT, OUTER_MOMENT, ROTOR, STEADY_MOMENT,
};
use outcome::Column;
use outcome::columns::columns;
use scenario::{Drive, SpinUp};

/// All columns; `time` first.
pub(crate) fn history(spin_up: &SpinUp, built: &RigModel, run: Option<&Context>) -> Vec<Column> {
    let layout = built.machine.layout();
    let of = run.map_or_else(|| bearing(built), |run| run.bearing());
    let mut table = Table::over(&of);
    let slides = matches!(spin_up.drive, Drive::SlidingRotor { .. });
    columns! { table.columns, |row|
        "time": "s", "time since the start" => row.time;
        "rotor.speed": "rad/s", "spin of the rotor" when slides => row.state[ROTOR.spin()];
    }
    table.inner_race(INNER);
    // what holds the cage follows with the balls
    columns! { table.columns, |row|
        "bearing.inner_race.resisting_moment": "N m", "moment t_I of the bearing that resists the inner race" => row.probe[INNER_MOMENT];
        "bearing.outer_race.moment": "N m", "moment t_O of the bearing on the outer race, which a torque arm feels" => row.probe[OUTER_MOMENT];
        "bearing.steady_moment": "N m", "friction moment M of the law at this speed and load, with the drag factor of the lubricant" => row.probe[STEADY_MOMENT];
        "drive.moment": "N m", "moment of the drive on the inner race" => row.probe[DRIVE_MOMENT];
        "bearing.inner_race.acceleration": "rad/s^2", "acceleration of the inner race" => row.probe[ACCELERATION];
        "drive.radial_load": "N", "radial load applied to the inner race" => row.probe[NORMAL_FORCE];
        "bearing.radial_load": "N", "size of the force of the balls on the inner race" => row.probe[INNER_FORCE];
        "bearing.cage.speed": "rad/s", "spin of the cage" => row.probe[CAGE_SPEED];
        "bearing.cage.slip": "1", "cage slip, 1 less cage speed over its rolling speed; 0 at rest" => row.probe[CAGE_SLIP];
        "rotor.slip_speed": "m/s", "slip of the rotor in the bore, rotor less race" when slides => 0.0 - row.probe[SLIP_SPEED];
        "rotor.friction_force": "N", "friction force of the rotor on the race, forward positive" when slides => 0.0 - row.probe[FRICTION_FORCE];
        "bearing.inner_race.ball_load_sum": "N", "sum of the ball loads at the inner race" => row.probe[INNER_LOAD_SUM];
        "bearing.inner_race.largest_ball_load": "N", "largest ball load at the inner race" => row.probe[LARGEST_INNER_LOAD];
        "bearing.outer_race.largest_ball_load": "N", "largest ball load at the outer race" => row.probe[LARGEST_OUTER_LOAD];
    }
    table.bearing();
    table.flows(&built.machine, |_| of.bearing);
    table.outer_race_works("inner race", "race", layout);
    table.energies(|row| run.map(|run| run.balance(row.time, row.content, row.state)));
    let followed = run.and_then(|run| run.followed());
    let warmth = followed.as_ref().map(|followed| followed.warmth);
    warm::columns(given(spin_up).heated(built), warmth, &mut table);
    table.columns.list
}
