//! Every named result of a spin-up with its law, source and valid range.

use crate::catalogue::geometry::digits;
use crate::result::list::{List, Origin, relative};
use crate::result::outcome::{Quantity, Value};
use crate::result::static_safety::{AT_THE_LOAD, StaticLoad, static_safety};
use crate::scenario::{Drive, Fidelity};
use crate::simulate::bearing::quantities::{End, LargestForces};
use crate::simulate::bearing::warm;
use crate::simulate::spin_up::context::Context;
use model::system::spin_up::layout::{
    CAGE_SLIP, CAGE_SPEED, INNER, INNER_MOMENT, OUTER_MOMENT, ROTOR, STEADY_MOMENT,
};
use model::system::spin_up::record::LateMeans;

const EQUATIONS: &str =
    "equations of motion, crates/model/src/system/spin_up/rate.rs and crates/model/src/bearing/";
const LEDGER: &str = "energy ledger, crates/model/src/system/spin_up/ledger.rs";

/// Cage slip from which balls are said to skid.
const SKIDDING: f64 = 0.02;
/// Share of the final speed that a race may lose on its way and still count as gaining speed only.
const LOST_SPEED: f64 = 0.01;
/// Share of the full speed below which a slip means nothing.
const LEAST_SPEED: f64 = 0.05;

/// Names the results.
pub(crate) fn name(context: &Context) -> Vec<Quantity> {
    let mut list = List::default();
    times(&mut list, context);
    moments(&mut list, context);
    slip(&mut list, context);
    loads(&mut list, context);
    energies(&mut list, context);
    list.ended_at(context.ending.time)
}

fn times(list: &mut List, context: &Context) {
    let (record, state) = (context.record, &context.ending.state);
    let target = context.spin_up.target_speed();
    let never = |what: &str, speed: f64| {
        let instant = digits(1e3 * context.ending.time);
        format!("{what} ({speed:.1} rad/s) was not reached in {instant} ms")
    };
    let rolling = target * context.machine().constants.bearing.rolling_cage_ratio();
    list.rises(
        "inner_race",
        [
            record.inner_race_time_to_50_percent(),
            record.inner_race_time_to_95_percent(),
            record.cage_time_to_95_percent(),
        ],
        [
            never("half of the full speed", 0.5 * target),
            never("95 % of the full speed", 0.95 * target),
            never("95 % of the rolling cage speed", 0.95 * rolling),
        ],
        &RISE,
    );
    let rotor_speed = match context.spin_up.drive {
        Drive::SlidingRotor { .. } => Ok(state[ROTOR + 1]),
        Drive::Torque { .. } | Drive::Speed(_) => Err("no rotor slides here".to_string()),
    };
    for (name, speed) in [
        ("inner_race_final_speed", Ok(state[INNER + 5])),
        ("cage_final_speed", Ok(probes(context)[CAGE_SPEED])),
        ("rotor_final_speed", rotor_speed),
    ] {
        list.number(name, "rad/s", speed, &SPEED);
    }
}

fn moments(list: &mut List, context: &Context) {
    let record = context.record;
    let probe = probes(context);
    for (name, value) in [
        ("peak_inner_race_moment", record.inner_moment.value),
        ("peak_outer_race_moment", record.outer_moment.value),
        ("peak_drive_moment", record.drive_moment.value),
    ] {
        list.number(name, "N m", Ok(value), &PEAK_MOMENT);
    }
    for (name, index, origin) in [
        ("inner_race_moment_at_end", INNER_MOMENT, &INNER_RACE),
        ("outer_race_moment_at_end", OUTER_MOMENT, &OUTER_RACE),
    ] {
        list.number(name, "N m", Ok(probe[index]), origin);
    }
    let no_law = || "bearing.moment.law is none".to_string();
    let steady = context.built.steady.as_ref();
    list.number(
        "law_moment_at_end",
        "N m",
        steady.map(|_| probe[STEADY_MOMENT]).ok_or_else(no_law),
        &LAW,
    );
    let means = late_means(context);
    list.number(
        "inner_race_mean_moment",
        "N m",
        means.clone().map(|means| means.inner_moment),
        &MEAN_MOMENT,
    );
    list.number(
        "outer_race_mean_moment",
        "N m",
        means.clone().map(|means| means.outer_moment),
        &MEAN_MOMENT,
    );
    list.number(
        "law_mean_moment",
        "N m",
        steady
            .ok_or_else(no_law)
            .and_then(|_| means.map(|means| means.steady_moment)),
        &LAW,
    );
    list.number(
        "traction_capacity",
        "1",
        steady.map(|steady| steady.capacity).ok_or_else(no_law),
        &CAPACITY,
    );
}

/// Means over the last turns of the cage at the final speed, or why there are none.
fn late_means(context: &Context) -> Result<LateMeans, String> {
    if context.ending.stop != solve::Stop::Finished {
        return Err("the run ended early".to_string());
    }
    let speed = context.ending.state[INNER + 5];
    context.record.late_means(speed).ok_or_else(|| {
        let ratio = context.machine().constants.bearing.rolling_cage_ratio();
        let turn = 2.0 * std::f64::consts::PI / (ratio * context.spin_up.target_speed()).abs();
        format!(
            "the race was at its final speed for less than a turn of the cage ({:.4} ms at full speed)",
            1e3 * turn
        )
    })
}

/// Cage slip at the end: of the last turn of the cage, or of the last instant where there was none.
fn late_slip(context: &Context) -> f64 {
    (context.record.last_cage_slip()).unwrap_or_else(|| probes(context)[CAGE_SLIP])
}

fn slip(list: &mut List, context: &Context) {
    let rolling = || "the rolling fidelity takes the balls to roll".to_string();
    let planar = context.spin_up.bearing.fidelity == Fidelity::Planar;
    let full = context.spin_up.target_speed().abs();
    let fast = |speed: f64| speed.abs() > LEAST_SPEED * full;
    // slip is relative to a speed: a race at rest has none
    let turns = fast(context.ending.state[INNER + 5]);
    let end = probes(context)[CAGE_SLIP];
    list.number(
        "cage_slip_at_end",
        "1",
        match (planar, turns) {
            (true, true) => Ok(end),
            (true, false) => Err("the inner race hardly turns at the end".to_string()),
            (false, _) => Err(rolling()),
        },
        &SLIP,
    );
    list.number(
        "cage_mean_slip",
        "1",
        match (planar, turns) {
            (true, true) => late_means(context).map(|means| means.cage_slip),
            (true, false) => Err("the inner race hardly turns at the end".to_string()),
            (false, _) => Err(rolling()),
        },
        &SLIP,
    );
    let largest = context
        .record
        .rows()
        .filter(|row| fast(row.state[INNER + 5]))
        // a cage that runs ahead of rolling skids as well
        .map(|row| row.probe[CAGE_SLIP].abs())
        .fold(0.0, f64::max);
    let word = if turns && late_slip(context).abs() > SKIDDING {
        "still at the end"
    } else if largest > SKIDDING {
        "while the race speeds up"
    } else {
        "no"
    };
    list.push(
        "balls_skid",
        "",
        if planar {
            Value::Text(word.to_string())
        } else {
            Value::None { why: rolling() }
        },
        &SKID,
    );
}

fn end<'a>(context: &'a Context<'a>) -> End<'a> {
    End {
        part: "",
        layout: context.machine().layout(),
        state: &context.ending.state,
    }
}

fn loads(list: &mut List, context: &Context) {
    let record = context.record;
    let forces = LargestForces {
        loads: [record.largest_inner_load, record.largest_outer_load],
        cage: [record.largest_pocket_force, record.largest_land_force],
    };
    let bearing = &context.spin_up.bearing;
    list.balls(&context.bearing(), &forces, bearing, &end(context));
    let duration = context.spin_up.run.duration;
    let load = StaticLoad {
        radial: context.spin_up.radial_load.largest_until(duration),
        axial: bearing.axial_preload,
        contact_angle: Some(bearing.contact_angle),
    };
    let safety = static_safety(&bearing.rated(), &load);
    list.number("static_safety", "1", safety, &AT_THE_LOAD);
}

fn energies(list: &mut List, context: &Context) {
    let machine = context.machine();
    let (start, state) = (context.start, &context.ending.state);
    let balance = context.whole_balance();
    let heat = balance.heat();
    if let Some(followed) = context.warming.map(|warming| warming.followed()) {
        warm::name(&followed, list);
    }
    if let Some(warming) = context.warming {
        warm::work_of_rings(warming.renewals.work_until(f64::INFINITY), list);
    }
    list.losses(&context.bearing(), &end(context), &ENERGY);
    list.number("dissipated_energy", "J", Ok(heat), &ENERGY);
    let forms = machine.outer_race_energy(start, state);
    for (name, value, origin) in [
        ("bearing_dissipated_energy", forms.dissipated, &ENERGY),
        ("outer_race_energy_printed", forms.printed, &PRINTED),
        ("outer_race_energy_corrected", forms.corrected, &CORRECTED),
        ("outer_race_energy_exact", forms.exact, &EXACT),
        ("path_term", forms.path, &PATH),
    ] {
        list.number(name, "J", Ok(value), origin);
    }
    let premise = rolling_start_to_end(context);
    for (name, value) in [
        ("path_term_if_rolling", forms.least_path),
        ("path_term_if_spun_up_after", forms.path_behind_the_race),
        ("path_term_largest", forms.largest_path),
    ] {
        list.number(name, "J", premise.clone().map(|()| value), &PATH);
    }
    let set = machine.constants.bearing.set();
    let inertia = machine.constants.race.inertia + set.inner_inertia();
    let full = inertia * machine.constants.target_speed.abs();
    list.number(
        "energy_residual",
        "1",
        relative(balance.energy_residual(), heat.max(balance.work_size())),
        &RESIDUAL,
    );
    list.number(
        "angular_momentum_residual",
        "1",
        relative(balance.angular_momentum_residual(), full),
        &RESIDUAL,
    );
}

/// What (21) and the bounds of the path term take for granted: from rest the race only gains speed, and the balls roll
/// at the end. The reason where it does not hold.
pub(crate) fn rolling_start_to_end(context: &Context) -> Result<(), String> {
    let end = context.ending.state[INNER + 5];
    let mut fastest = 0.0_f64;
    for row in context.record.rows() {
        let speed = row.state[INNER + 5] * end.signum();
        if speed < fastest - LOST_SPEED * end.abs() {
            return Err("the inner race loses speed on the way".to_string());
        }
        fastest = fastest.max(speed);
    }
    let slip = late_slip(context);
    if slip.abs() > SKIDDING {
        return Err(format!(
            "the balls do not roll at the end: cage slip {:.1} %",
            1e2 * slip
        ));
    }
    Ok(())
}

/// The probes at the end.
fn probes(context: &Context) -> Vec<f64> {
    let machine = context.machine();
    machine
        .inspect(context.ending.time, &context.ending.state)
        .1
}

const RISE: Origin = Origin {
    law: "first instant at which the speed reaches the level; full speed is that of the rotor, the final one of the drive, or drive.reference_speed",
    source: EQUATIONS,
    valid: "constant friction coefficient between rotor and race",
};
const SPEED: Origin = Origin {
    law: "angular momentum of each body about its axis",
    source: EQUATIONS,
    valid: "the outer race stands",
};
const PEAK_MOMENT: Origin = Origin {
    law: "largest size of the moment at the ends of the steps",
    source: EQUATIONS,
    valid: "moments on the inner race t_I, on the outer race t_O, of the drive; a step of speed needs an impulse besides",
};
const INNER_RACE: Origin = Origin {
    law: "t_I = Σ(R T_I + m_i), what the inner race feels against its rotation",
    source: EQUATIONS,
    valid: "a single instant; balls passing the load make it ripple",
};
const OUTER_RACE: Origin = Origin {
    law: "t_O: everything the outer race receives; t_I - t_O = dL/dt of balls and cage on a concentric rig",
    source: EQUATIONS,
    valid: "a single instant; the reaction that a torque arm measures",
};
const LAW: Origin = Origin {
    law: "M(Ω, W) of bearing.moment.law, unscaled",
    source: "crates/physics/src/friction.rs and the law's own page",
    valid: "the law's own range; leaving it is a warning of the run",
};
const MEAN_MOMENT: Origin = Origin {
    law: "mean of t_I or t_O over cage turns: the later half of those at the end in which the speed stayed within 1 %",
    source: EQUATIONS,
    valid: "free of the ripple of passing balls; a steady moment once t_I and t_O agree",
};
const CAPACITY: Origin = Origin {
    law: "μ_max R ΣQ_i / M at full speed under the last load",
    source: "crates/model/src/system/spin_up/capacity.rs",
    valid: "above 1.2 the balls roll in a steady run and t_I = t_O = M within 2 %; below they must skid",
};
const SLIP: Origin = Origin {
    law: "S = 1 - 2(1+s)ω_c/Ω, at the last instant, or as the mean over the later half of the cage turns at the final speed",
    source: "Harris 2001, section 8: kinematics of a rolling ball, crates/physics/src/kinematics.rs",
    valid: "pockets let the cage lead and lag a little from instant to instant",
};
const SKID: Origin = Origin {
    law: "cage slip above 2 % in the mean of the last cage turn, or at any row above 5 % of the full speed",
    source: "definition",
    valid: "rows of the history",
};
const ENERGY: Origin = Origin {
    law: "time integral of friction force times sliding speed, and of every other loss",
    source: LEDGER,
    valid: "nothing is cooled or warmed by it",
};
const PRINTED: Origin = Origin {
    law: "D = (1+2s)∫t_O Ω dt + ½(1+2s)(3/20 N m_b + ¼ m_c)R²Ω0²",
    source: "the source paper, (21) as printed",
    valid: "nowhere: its integral must not bear the factor 1+2s; shown for comparison",
};
const CORRECTED: Origin = Origin {
    law: "D = ∫t_O Ω dt + ½(1+2s)(3/20 N m_b + ¼ m_c)R²Ω0²",
    source: "the source paper, (21), corrected; crates/model/src/system/spin_up/ledger.rs",
    valid: "from rest, balls that roll all the way; wrong by up to half of L0 Ω0 where they skid",
};
const EXACT: Origin = Origin {
    law: "D = ∫(t_O + t_g)Ω dt + ∫Ω dL - Δ(KE + U)",
    source: "balance of energy and angular momentum of balls and cage, crates/model/src/system/spin_up/ledger.rs",
    valid: "any skidding; needs the speed of the cage, or the path term as an uncertainty",
};
const PATH: Origin = Origin {
    law: "∫Ω dL of balls and cage: ½ L0 Ω0 where they roll all the way, L0 Ω0 where they are spun up after the race, \
          ½ (1+s)(N m_b + m_c) R² Ω0² where they spin with the race and orbit last",
    source: "crates/physics/src/spin_up_energy.rs",
    valid: "the bounds: from rest, a race that only gains speed and leads its balls, balls that roll at the end",
};
const RESIDUAL: Origin = Origin {
    law: "what the ledger misses at the end, over max(heat, works); momentum over that of race, balls and cage at full speed",
    source: LEDGER,
    valid: "a measure of the integration error; it falls with run.tolerance",
};
