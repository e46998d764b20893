//! Every named result of a test on a rig with its law, source and valid range: what happened, not what was measured of it.

use crate::result::list::{List, Origin, relative};
use crate::result::outcome::{Quantity, Value};
use crate::result::static_safety::{AT_THE_LOAD, StaticLoad, static_safety};
use crate::scenario::{Fidelity, RigProgram};
use crate::simulate::bearing::warm::{self, Followed};
use crate::simulate::bearing::warming::Warming;
use crate::simulate::rig::context::Context;
use model::system::rig::RigMachine;
use model::system::rig::layout::{
    CAGE_SLIP, CAGE_SPEED, CLUTCH_HEAT, FLYWHEEL, INNER_MOMENT, OUTER_MOMENT, SHAFT, STEADY_MOMENT,
};
use thermal::bearing_network::OUTER_RACE;

const EQUATIONS: &str = "equations of motion, crates/model/src/system/rig/rate.rs";
const LEDGER: &str = "energy ledger, crates/model/src/system/rig/ledger.rs";

/// Names the results.
pub(crate) fn name(context: &Context) -> Vec<Quantity> {
    let mut list = List::default();
    engagement(&mut list, context);
    moments(&mut list, context);
    loads(&mut list, context);
    energies(&mut list, context);
    list.ended_at(context.ending.time)
}

fn engagement(list: &mut List, context: &Context) {
    let (record, state) = (context.record, &context.ending.state);
    let engages = match context.rig.program {
        RigProgram::SpinUp { engage_at, .. } | RigProgram::RepeatAfterRest { engage_at, .. } => {
            Ok(engage_at)
        }
        RigProgram::CoastDown { .. } | RigProgram::RampAndHold { .. } => {
            Err("the clutch does not engage in this test".to_string())
        }
    };
    list.number("engagement_time", "s", engages.clone(), &ENGAGEMENT);
    list.number(
        "clutch_torque_rate",
        "N m/s",
        (context.built.torque_rate)
            .ok_or_else(|| "the clutch does not engage in this test".to_string()),
        &RATE,
    );
    let locked = engages.and_then(|_| {
        record
            .locked_at()
            .ok_or_else(|| "the clutch still slips at the end".to_string())
    });
    list.number("clutch_lock_time", "s", locked, &ENGAGEMENT);
    let against = 0.0 - record.deceleration.value;
    list.number(
        "peak_acceleration",
        "rad/s^2",
        Ok(match context.rig.program {
            RigProgram::CoastDown { .. } => against,
            _ => record.acceleration.value,
        }),
        &PEAK_ACCELERATION,
    );
    list.number(
        "peak_deceleration",
        "rad/s^2",
        Ok(against),
        &PEAK_DECELERATION,
    );
    let never = |share: f64| format!("{share} % of rig.speed was not reached");
    list.rises(
        "shaft",
        [
            record.shaft_time_to_50_percent(),
            record.shaft_time_to_95_percent(),
            record.cage_time_to_95_percent(),
        ],
        [never(50.0), never(95.0), never(95.0)],
        &RISE,
    );
    for (name, speed) in [
        ("shaft_final_speed", state[SHAFT + 1]),
        ("flywheel_final_speed", state[FLYWHEEL + 1]),
        ("cage_final_speed", probes(context)[CAGE_SPEED]),
    ] {
        list.number(name, "rad/s", Ok(speed), &SPEED);
    }
    for (name, peak) in [
        ("peak_clutch_torque", record.clutch_torque),
        ("peak_inner_race_moment", record.inner_moment),
        ("peak_outer_race_moment", record.outer_moment),
    ] {
        list.number(name, "N m", Ok(peak.value), &PEAK_MOMENT);
    }
}

fn moments(list: &mut List, context: &Context) {
    let record = context.record;
    let probe = probes(context);
    for (name, index) in [
        ("inner_race_moment_at_end", INNER_MOMENT),
        ("outer_race_moment_at_end", OUTER_MOMENT),
        ("law_moment_at_end", STEADY_MOMENT),
    ] {
        list.number(name, "N m", Ok(probe[index]), &AT_END);
    }
    let turns = context.ending.state[SHAFT + 1].abs() > 0.05 * context.rig.speed;
    list.number(
        "cage_slip_at_end",
        "1",
        match (context.rig.bearing.fidelity, turns) {
            (Fidelity::Rolling, _) => {
                Err("the rolling fidelity takes the balls to roll".to_string())
            }
            (Fidelity::Planar, false) => Err("the shaft hardly turns at the end".to_string()),
            (Fidelity::Planar, true) => {
                Ok((record.last_cage_slip()).unwrap_or_else(|| probe[CAGE_SLIP]))
            }
        },
        &SLIP,
    );
    let of_network = |warming: &Warming<RigMachine>| {
        let Followed { part, warmth, .. } = warming.followed();
        warmth.peaks[OUTER_RACE].0 - part.start
    };
    list.number(
        "peak_temperature_rise",
        "K",
        Ok(context.warming.map_or(record.temperature.value, of_network)),
        &TEMPERATURE,
    );
    if let Some(warming) = context.warming {
        warm::name(&warming.followed(), list);
        warm::work_of_rings(warming.renewals.work_until(f64::INFINITY), list);
    }
}

fn loads(list: &mut List, context: &Context) {
    let (run, record) = (context.bearing(), context.record);
    let loads = [record.largest_inner_load, record.largest_outer_load];
    list.ball_loads(loads, &context.pressures(), &context.rig.bearing);
    list.races(&run);
    list.lubricant(&run, &context.ending.state);
    let bearing = &context.rig.bearing;
    let load = StaticLoad {
        radial: context.rig.load.radial_load,
        axial: bearing.axial_preload,
        contact_angle: Some(bearing.contact_angle),
    };
    let safety = static_safety(&bearing.rated(), &load);
    list.number("static_safety", "1", safety, &AT_THE_LOAD);
}

fn energies(list: &mut List, context: &Context) {
    let machine = &context.built.machine;
    let (start, end) = (context.start, &context.ending.state);
    let layout = machine.layout();
    let at_end = context.machine_at_end();
    let balance = context.balance(f64::INFINITY, at_end.content(end), end);
    list.number("dissipated_energy", "J", Ok(balance.heat()), &ENERGY);
    list.number(
        "clutch_heat",
        "J",
        Ok(end[layout.heat(CLUTCH_HEAT)]),
        &ENERGY,
    );
    let of_bearing = (0..CLUTCH_HEAT).map(|index| end[layout.heat(index)]).sum();
    list.number("bearing_dissipated_energy", "J", Ok(of_bearing), &ENERGY);
    list.number(
        "energy_residual",
        "1",
        relative(
            balance.energy_residual(),
            balance.heat().max(balance.work_size()),
        ),
        &RESIDUAL,
    );
    list.number(
        "angular_momentum_residual",
        "N m s",
        Ok(machine.bearing_momentum_residual(start, end)),
        &MOMENTUM,
    );
    list.push(
        "clipped_channels",
        "",
        match context.clipped.as_slice() {
            [] => Value::Text("none".to_string()),
            clipped => Value::Text(
                clipped
                    .iter()
                    .map(|(name, count)| format!("{name}: {count} values"))
                    .collect::<Vec<_>>()
                    .join(", "),
            ),
        },
        &CLIPPED,
    );
}

/// The probes at the end.
fn probes(context: &Context) -> Vec<f64> {
    let machine = context.machine_at_end();
    (machine.inspect(&context.mode, context.ending.time, &context.ending.state)).1
}

const ENGAGEMENT: Origin = Origin {
    law: "engaged as the program says; locked where flywheel and shaft first turn at the same speed",
    source: "crates/model/src/system/rig/clutch.rs",
    valid: "the instant of locking is found on the dense output of the step",
};
const RATE: Origin = Origin {
    law: "rise of the torque that the clutch can carry: as given, or found for the wanted peak acceleration",
    source: "crates/model/src/system/rig/ramp.rs",
    valid: "found with balls that roll; balls that skid take a little less of the shaft",
};
const PEAK_ACCELERATION: Origin = Origin {
    law: "largest acceleration of the shaft in the direction of its turning while the test brings it up; of a coast-down, that of its slowing; as peak_acceleration of measured signals",
    source: EQUATIONS,
    valid: "at the ends of the steps, which include the locking",
};
const PEAK_DECELERATION: Origin = Origin {
    law: "largest acceleration of the shaft against its turning, below 0: the release, the running out",
    source: EQUATIONS,
    valid: "at the ends of the steps, which include the release",
};
const RISE: Origin = Origin {
    law: "first instant at which the speed reaches the level of rig.speed",
    source: EQUATIONS,
    valid: "time counts from the start of the test",
};
const SPEED: Origin = Origin {
    law: "angular momentum of each body about its axis",
    source: EQUATIONS,
    valid: "stiff shaft and clutch",
};
const PEAK_MOMENT: Origin = Origin {
    law: "largest size of the moment at the ends of the steps",
    source: EQUATIONS,
    valid: "what happened; the arm swings and the logger adds noise",
};
const AT_END: Origin = Origin {
    law: "t_I on the shaft, t_O on the outer race, and M(Ω, W) of the law, at the last instant",
    source: EQUATIONS,
    valid: "a single instant",
};
const SLIP: Origin = Origin {
    law: "S = 1 - 2(1+s)ω_c/Ω, mean over the last cage turn",
    source: "Harris 2001, section 8: kinematics of a rolling ball, crates/physics/src/kinematics.rs",
    valid: "as it happened; what a sensor measures has its own band",
};
const TEMPERATURE: Origin = Origin {
    law: "of the outer race: C Ṫ = heats of the bearing - G T of one node, or of the network where heat.network = \"on\"",
    source: EQUATIONS,
    valid: "one node: the moment does not depend on it unless bearing.lubricant_state says so; network: heat.feedback",
};
const ENERGY: Origin = Origin {
    law: "time integral of every loss: force or couple times the relative speed",
    source: LEDGER,
    valid: "from the start of the test to its end",
};
const RESIDUAL: Origin = Origin {
    law: "what the ledger misses at the end, over max(heat, works)",
    source: LEDGER,
    valid: "a measure of the integration error; it falls with run.tolerance",
};
const MOMENTUM: Origin = Origin {
    law: "∫(t_I - t_O - t_g + moments of weights and of forces off the centre) dt - ΔL of balls and cage",
    source: LEDGER,
    valid: "zero but for errors: t_I - t_O = dL/dt on the concentric rig",
};
const CLIPPED: Origin = Origin {
    law: "values beyond the range of the converter",
    source: "crates/auxbear/src/simulate/rig/chain.rs",
    valid: "the raw file holds the end of the range there",
};
