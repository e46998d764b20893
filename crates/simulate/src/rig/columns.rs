//! The history of a test on a rig as columns: what happened, not what the logger saw.

use crate::bearing::columns::Table;
use crate::bearing::warm::{self, Heated};
use crate::rig::run::{RigModel, bearing};
use crate::rig::{Context, given};
use model::auxiliary_bearing::probe::{BEARING_LOAD, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD};
use model::bearing::BearingConstants;
use model::system::rig::layout::{
    ACCELERATION, ARM, BEARING_HEAT, BELT_DRAG, CAGE_ANGLE, CAGE_SLIP, CAGE_SPEED, CLUTCH_CAPACITY,
    CLUTCH_SLIP, DISTURBANCE, DRIVE_MOMENT, DRIVER_ACCELERATION, FLYWHEEL, HOUSING, INNER_LOAD_SUM,
    INNER_MOMENT, MOMENTUM_RATE, MOTOR_TORQUE, OUTER_MOMENT, SHAFT, STEADY_MOMENT, SUPPORT_DRAG,
    TEMPERATURE, THERMOCOUPLE,
};
use model::system::sampling::Row;
use outcome::Column;
use outcome::columns::columns;
use scenario::Rig;
use thermal::bearing_network::OUTER_RACE;

/// All columns; `time` first.
pub(crate) fn history(rig: &Rig, built: &RigModel, run: Option<&Context>) -> Vec<Column> {
    let machine = &built.machine;
    let layout = machine.layout();
    let of = run.map_or_else(|| bearing(built), |run| run.bearing());
    let mut table = Table::over(&of);
    columns! { table.columns, |row|
        "time": "s", "time since the start" => row.time;
        "bearing.inner_race.speed": "rad/s", "spin of the shaft with the inner race" => row.state[SHAFT.spin()];
        "flywheel.speed": "rad/s", "spin of the flywheel" => row.state[FLYWHEEL.spin()];
        "arm.reading": "N m", "torque that the swinging arm indicates, before its gauges" => row.state[ARM];
    }
    let heated = given(rig).heated(built);
    let followed = run.and_then(|run| run.followed());
    let warmth = followed.as_ref().map(|followed| followed.warmth);
    let bead = run
        .and_then(|run| run.bead.as_ref())
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
    let centre_moves = !machine.constants.bearings[0].is_concentric();
    columns! { table.columns, |row|
        "bearing.temperature_rise": "K", "temperature of the outer race above that at the start" => rise(row);
        "thermocouple.temperature_rise": "K", "what the thermocouple has of it" => reading(row);
        "housing.x": "m", "centre of the outer race, to the right" when centre_moves => row.state[HOUSING.centre()[0]];
        "housing.y": "m", "centre of the outer race, upwards" when centre_moves => row.state[HOUSING.centre()[1]];
    }
    columns! { table.columns, |row|
        "bearing.inner_race.resisting_moment": "N m", "moment t_I of the bearing that resists the shaft" => row.probe[INNER_MOMENT];
        "bearing.outer_race.moment": "N m", "moment t_O of the bearing on the outer race: what the arm is to measure" => row.probe[OUTER_MOMENT];
        "bearing.steady_moment": "N m", "friction moment M of the law at this speed and load, with the drag factor of the lubricant" => row.probe[STEADY_MOMENT];
        "bearing.cage.slip": "1", "cage slip, 1 less cage speed over its rolling speed; 0 at rest" => row.probe[CAGE_SLIP];
        "shaft.acceleration": "rad/s^2", "acceleration of the shaft" => row.probe[ACCELERATION];
        "flywheel.acceleration": "rad/s^2", "acceleration of the flywheel" => row.probe[DRIVER_ACCELERATION];
        "clutch.torque": "N m", "torque of the clutch on the shaft" => row.probe[DRIVE_MOMENT];
        "clutch.capacity": "N m", "torque that the clutch can carry" => row.probe[CLUTCH_CAPACITY];
        "clutch.slip_speed": "rad/s", "speed by which the flywheel is ahead of the shaft" => row.probe[CLUTCH_SLIP];
        "motor.torque": "N m", "torque of the motor on the flywheel" => row.probe[MOTOR_TORQUE];
        "flywheel.drag_moment": "N m", "drag of belt and flywheel bearings" => row.probe[BELT_DRAG];
        "shaft.drag_moment": "N m", "drag of the shaft's own bearings" => row.probe[SUPPORT_DRAG];
        "arm.disturbance": "N m", "what lateral vibration adds to the moment that the arm feels" => row.probe[DISTURBANCE];
        "bearing.cage.speed": "rad/s", "spin of the cage" => row.probe[CAGE_SPEED];
        "bearing.radial_load": "N", "size of the force of the balls on the outer race" => row.probe[BEARING_LOAD];
        "bearing.heat": "W", "heat made in the bearing" => row.probe[BEARING_HEAT];
        "bearing.angular_momentum_rate": "N m", "rate of the angular momentum of balls and cage" => row.probe[MOMENTUM_RATE];
        "bearing.inner_race.ball_load_sum": "N", "sum of the ball loads at the inner race" => row.probe[INNER_LOAD_SUM];
        "bearing.inner_race.largest_ball_load": "N", "largest ball load at the inner race" => row.probe[LARGEST_INNER_LOAD];
        "bearing.outer_race.largest_ball_load": "N", "largest ball load at the outer race" => row.probe[LARGEST_OUTER_LOAD];
    }
    let rolls = matches!(of.bearing, BearingConstants::Rolling(_));
    columns! { table.columns, |row| "bearing.cage.angle": "rad", "angle of the cage" when rolls => row.state[CAGE_ANGLE]; }
    table.bearing();
    table.flows(machine, |_| of.bearing);
    table.outer_race_works("shaft", "shaft", layout);
    table.energies(|row| run.map(|run| run.balance(row.time, row.content, row.state)));
    warm::columns(heated, warmth, &mut table);
    table.columns.list
}
