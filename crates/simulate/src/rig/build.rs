//! From a test on a rig to the constants of the model.

use crate::bearing;
use crate::bearing::steady::SteadyPoint;
use crate::rig::run::RigModel;
use model::auxiliary_bearing::RaceConstants;
use model::bearing_heat::WarmBearing;
use model::system::machine::RotorMachine;
use model::system::rig::{
    Action, Arm, ClutchDrive, Disturbance, Drag, Drive, Engagement, Flywheel, HeatNode, Housing,
    Motor, Program, RigConstants, engagement_ramp,
};
use model::table::Table;
use number::Vec2;
use problem::{Code, Problem};
use scenario::{Engagement as EngagementChoice, Rig, RigProgram, problem_at};
use std::f64::consts::PI;
use thermal::bearing_network::OUTER_RACE;

/// Speed at which the drag of the shaft's bearings reaches 76 % of its constant part, rad/s: small against any test.
const FADING: f64 = 0.5;

/// Builds the machine of a test. The weight of the balls is left out: it is a thousandth of any load.
pub fn rig(rig: &Rig) -> Result<RigModel, Box<Problem>> {
    let contacts = bearing::contacts::ball_contacts(&rig.bearing)?;
    let bearing = bearing::build::bearing(&rig.bearing, &contacts, Vec2::zero())?;
    let centre_held = rig.load.hanging_mass.is_none();
    // the ring that is free to move is the outer one here; to the balls it is the same turned round
    let race = RaceConstants {
        mass: rig.load.hanging_mass.unwrap_or(1.0),
        inertia: rig.bearing.inner_race_inertia,
        centre_held,
        torque: 0.0,
    };
    let at = SteadyPoint {
        speed: rig.speed,
        load: rig.load.radial_load,
        direction: Vec2::new(0.0, -1.0),
        gravity: Vec2::zero(),
    };
    let steady = bearing::steady::steady(&bearing, &rig.bearing, &race, at)?;
    let warm = bearing::networks::built(rig.warm.as_deref(), &rig.bearing)?;
    // where a network follows the temperatures nothing reads the one node
    let outer_race = |warm: &WarmBearing| [warm.network.capacities[OUTER_RACE], 0.0];
    let node = &rig.temperature;
    let given = node.heat_capacity.zip(node.conductance).map(Into::into);
    let [capacity, conductance] =
        (given.or(warm.as_deref().map(outer_race))).unwrap_or([f64::NAN; 2]);
    let arm = &rig.arm;
    let clutch = |rate: f64| ClutchDrive {
        flywheel: Flywheel {
            inertia: rig.flywheel.inertia,
            belt_drag: drag(0.0, rig.flywheel.viscous_drag),
        },
        motor: Motor {
            gain: rig.motor.gain,
            torque_limit: rig.motor.torque_limit,
        },
        support_drag: drag(rig.shaft.drag_torque, rig.shaft.viscous_drag),
        program: program(rig, rate),
    };
    let housing = Housing {
        mass: rig.load.hanging_mass.unwrap_or(0.0),
        centre_held,
        arm: Arm {
            natural_frequency: 2.0 * PI * arm.natural_frequency,
            damping_ratio: arm.damping_ratio,
            disturbance: Disturbance {
                amplitude: arm.synchronous_amplitude,
                reference_speed: rig.speed,
                exponent: arm.synchronous_power,
                phase: 0.0,
            },
        },
        heat: HeatNode {
            capacity,
            conductance,
            thermocouple_lag: rig.temperature.lag,
        },
    };
    let mut constants = RigConstants {
        race: RaceConstants {
            inertia: rig.shaft.inertia + rig.bearing.inner_race_inertia,
            centre_held: true,
            ..race
        },
        bearing,
        drive: Drive::Clutch(Box::new(clutch(1.0))),
        load: Table::constant(rig.load.radial_load),
        load_direction: at.direction,
        gravity: at.gravity,
        housing: Some(housing),
        warm,
        target_speed: rig.speed,
    };
    let torque_rate = torque_rate(rig, &constants)?;
    if let Some(rate) = torque_rate {
        constants.drive = Drive::Clutch(Box::new(clutch(rate)));
    }
    let machine = RotorMachine::on_rig(constants).map_err(refused)?;
    Ok(RigModel {
        machine,
        torque_rate,
        pressure_factors: contacts.pressure_factors(),
        steady,
    })
}

fn drag(constant: f64, viscous: f64) -> Drag {
    Drag {
        constant,
        viscous,
        reference_speed: FADING,
    }
}

fn refused(why: impl std::fmt::Display) -> Box<Problem> {
    let allowed = "a rig that can be built is needed";
    problem_at(Code::Impossible, "rig", why.to_string(), allowed)
}

/// Rate of the clutch's torque, N m/s, where it engages in the test.
fn torque_rate(rig: &Rig, constants: &RigConstants) -> Result<Option<f64>, Box<Problem>> {
    let engagement = match rig.program {
        RigProgram::SpinUp { engagement, .. } | RigProgram::RepeatAfterRest { engagement, .. } => {
            engagement
        }
        RigProgram::CoastDown { .. } | RigProgram::RampAndHold { .. } => return Ok(None),
    };
    match engagement {
        EngagementChoice::Rate(rate) => Ok(Some(rate)),
        EngagementChoice::PeakAcceleration(wanted) => engagement_ramp(constants, wanted, rig.speed)
            .map(Some)
            .map_err(|why| {
                problem_at(
                    Code::Impossible,
                    "rig.peak_acceleration",
                    format!("{wanted} rad/s^2, which the clutch does not give"),
                    format!("a peak acceleration that it can give is needed: {why}"),
                )
            }),
    }
}

/// What is done to the rig, the clutch engaging at a rate, N m/s.
fn program(rig: &Rig, rate: f64) -> Program {
    let engagement = Engagement {
        rate,
        largest: rig.clutch_torque,
    };
    let with = |mut program: Program, actions: &[(Option<f64>, Action)]| {
        let timed = actions
            .iter()
            .filter_map(|(time, action)| Some(((*time)?, *action)));
        program.actions.extend(timed);
        program
    };
    match rig.program {
        RigProgram::SpinUp {
            engage_at,
            release_at,
            motor_stays_on,
            ..
        } => with(
            Program::spin_up(rig.speed, engage_at, engagement, motor_stays_on),
            &[(release_at, Action::Disengage)],
        ),
        RigProgram::CoastDown { with_flywheel } => {
            Program::coast_down(rig.speed, with_flywheel.then_some(rig.clutch_torque))
        }
        RigProgram::RampAndHold {
            acceleration,
            release_at,
        } => with(
            Program::ramp_and_hold(rig.speed, acceleration, rig.clutch_torque),
            &[(release_at, Action::Disengage)],
        ),
        RigProgram::RepeatAfterRest {
            engage_at,
            release_at,
            engage_again_at,
            motor_stays_on,
            ..
        } => with(
            Program::spin_up(rig.speed, engage_at, engagement, motor_stays_on),
            &[
                (Some(release_at), Action::Disengage),
                (Some(engage_again_at), Action::Engage(engagement)),
            ],
        ),
    }
}
