//! Every named result of a run-out with its law, source and valid range.

use crate::result::list::{List, NOT_GIVEN, Origin, relative};
use crate::result::outcome::Value;
use crate::simulate::coast_down::build::{ICE_POINT, energy, turns};
use crate::simulate::coast_down::course::End;
use crate::simulate::coast_down::ran::Ran;
use physics::life::{
    RatedBearing, bearing_damage, passages_per_turn, reference_viscosity, repetitions, ring_damage,
};
use thermal::bearing_network::NODES;

/// Places of the outer ring that its life is summed over.
const PLACES: usize = 180;

/// Names the results.
pub(super) fn name(ran: &Ran, list: &mut List) {
    motion(ran, list);
    heats(ran, list);
    temperatures(ran, list);
    held(ran, list);
    clearance(ran, list);
    life(ran, list);
}

fn motion(ran: &Ran, list: &mut List) {
    let free = &ran.free;
    let stands = match free.end {
        End::Stands => Ok(free.state.time),
        _ => Err("the rotor did not come to stand in this run".to_string()),
    };
    list.awaited("stop_time", stands, &STOP);
    list.number("turns", "", Ok(all_turns(ran)), &TURNS);
    let first = &free.rows[0].moments;
    list.number("start_moment", "N m", Ok(first.iter().sum()), &MOMENT);
    let power = first.iter().sum::<f64>() * free.rows[0].speed;
    list.number("start_power", "W", Ok(power), &MOMENT);
}

/// Turns of the rotor.
fn all_turns(ran: &Ran) -> f64 {
    let pairs = ran.free.rows.windows(2);
    let each = pairs.map(|pair| {
        turns(
            0.5 * (pair[0].speed + pair[1].speed),
            pair[1].time - pair[0].time,
        )
    });
    each.sum()
}

fn heats(ran: &Ran, list: &mut List) {
    let free = &ran.free;
    let heats = &free.state.heats;
    list.number("rotor_energy", "J", Ok(energy(ran.run)), &ENERGY);
    for (at, name) in [
        "speed_dependent_heat",
        "load_dependent_heat",
        "windage_heat",
    ]
    .into_iter()
    .enumerate()
    {
        list.number(name, "J", Ok(heats[at]), &HEAT);
    }
    list.number("stored_heat", "J", Ok(free.stored), &HEAT);
    let start = ran.run.heat.start_temperature - ICE_POINT;
    for (node, name) in NODES.iter().enumerate() {
        if ran.is_there(node) {
            let capacity = f64::from(ran.run.planes) * ran.built.network.capacities[node];
            let kept = capacity * (free.state.temperatures[node] - start);
            list.number(&format!("stored_heat_in_{name}"), "J", Ok(kept), &HEAT);
        }
    }
    list.number("heat_to_surroundings", "J", Ok(free.state.given), &HEAT);
    let made = heats[0] + heats[1];
    let left = made - free.stored - free.state.given;
    list.number(
        "relative_heat_residual",
        "1",
        relative(left.abs(), made),
        &RESIDUAL,
    );
}

fn temperatures(ran: &Ran, list: &mut List) {
    for (node, name) in NODES.iter().enumerate() {
        if !ran.is_there(node) {
            continue;
        }
        let (peak, at) = ran.peak(node);
        list.number(
            &format!("peak_{name}_temperature"),
            "K",
            Ok(peak + ICE_POINT),
            &PEAK,
        );
        list.number(&format!("peak_{name}_time"), "s", Ok(at), &PEAK);
        let Some(limit) = ran.limits[node] else {
            continue;
        };
        let passed = ran.first(|row| row.temperatures[node] - limit);
        let never = || format!("it stays {:.1} K below its limit", limit - peak);
        list.awaited(
            &format!("{name}_limit_time"),
            passed.ok_or_else(never),
            &LIMIT,
        );
        let held = ran.held.as_ref().filter(|held| held.taken[node] > 0.0);
        let most = held.map(|held| {
            let rows = held.rows.iter();
            rows.map(|row| row.taken[node]).fold(0.0, f64::max)
        });
        list.number(
            &format!("{name}_heat_to_take"),
            "W",
            most.ok_or_else(never),
            &TAKE,
        );
        let energy = held.map(|held| held.taken[node]);
        list.number(
            &format!("{name}_energy_to_take"),
            "J",
            energy.ok_or_else(never),
            &TAKE,
        );
    }
}

/// The run-out whose nodes are held, which has times of its own.
fn held(ran: &Ran, list: &mut List) {
    let rows = || ran.held.iter().flat_map(|held| &held.rows);
    let times = rows().map(|row| row.time).collect();
    list.push("held_times", "s", Value::List(times), &TAKE);
    let Some(held) = &ran.held else { return };
    for (node, name) in NODES.iter().enumerate() {
        if held.taken[node] > 0.0 {
            let powers = rows().map(|row| row.taken[node]).collect();
            list.push(
                &format!("{name}_powers_to_take"),
                "W",
                Value::List(powers),
                &TAKE,
            );
        }
    }
}

fn clearance(ran: &Ran, list: &mut List) {
    let rows = &ran.free.rows;
    let least = rows
        .iter()
        .map(|row| row.clearance)
        .fold(f64::INFINITY, f64::min);
    list.number("smallest_clearance", "m", Ok(least), &CLEARANCE);
    let closes = ran.first(|row| -row.clearance);
    let open = || "the bearing stays open".to_string();
    list.awaited("closing_time", closes.ok_or_else(open), &CLEARANCE);
    let most = rows.iter().map(|row| row.ball_loads[0]).fold(0.0, f64::max);
    list.number("peak_ball_load", "N", Ok(most), &BALLS);
    let growth = rows
        .iter()
        .map(|row| row.growth)
        .fold(f64::NEG_INFINITY, f64::max);
    list.number("peak_growth_rate", "1/s", Ok(growth), &GROWTH);
}

fn life(ran: &Ran, list: &mut List) {
    let run = ran.run;
    let rows = &ran.free.rows;
    let viscosity = |row: &crate::simulate::coast_down::course::Row| {
        let kelvin = row.temperatures[thermal::bearing_network::LUBRICANT] + ICE_POINT;
        let rpm = row.speed * 60.0 / std::f64::consts::TAU;
        1e6 * ran.built.losses.oil.viscosity(kelvin)
            / reference_viscosity(rpm, 1e3 * run.pitch_diameter)
    };
    let least = rows.iter().map(viscosity).fold(f64::INFINITY, f64::min);
    list.number("smallest_viscosity_ratio", "1", Ok(least), &KAPPA);
    let share = (run.dynamic_load_rating)
        .ok_or_else(|| format!("bearing.dynamic_load_rating{NOT_GIVEN}"))
        .map(|rating| used(ran, rating));
    list.number("life_share", "1", share.clone(), &LIFE);
    for (name, survival) in [
        ("runs_until_one_percent_fail", 0.99),
        ("runs_until_ten_percent_fail", 0.9),
        ("runs_until_half_fail", 0.5),
    ] {
        let count = share.clone().map(|share| repetitions(share, survival));
        list.number(name, "1", count, &LIFE);
    }
}

/// Share of the rating life of one bearing that the run-out uses.
fn used(ran: &Ran, rating: f64) -> f64 {
    let run = ran.run;
    let gamma = run.ball_diameter / run.pitch_diameter;
    let bearing = RatedBearing {
        rating,
        ball_count: run.ball_count as f64,
        gamma,
        grooves: [run.inner_groove_curvature, run.outer_groove_curvature],
        contact_angle: 0.0,
    };
    let passages = passages_per_turn(run.ball_count as f64, gamma);
    let loads = bearing.ball_rating_loads();
    // Σ turns of the mean cube, and of the cube at each place of the outer ring
    let mut inner = 0.0;
    let mut outer = vec![0.0; PLACES];
    for pair in ran.free.rows.windows(2) {
        let turned = turns(
            0.5 * (pair[0].speed + pair[1].speed),
            pair[1].time - pair[0].time,
        );
        inner += turned * 0.5 * (pair[0].cubes + pair[1].cubes);
        let zone = ran
            .built
            .zone
            .loads(0.5 * (pair[0].clearance + pair[1].clearance));
        for (sum, load) in outer.iter_mut().zip(zone) {
            *sum += turned * load.powi(3);
        }
    }
    let of_inner = ring_damage(&[inner * passages[0]], passages[0], loads[0]);
    let outer: Vec<f64> = outer.iter().map(|sum| sum * passages[1]).collect();
    bearing_damage(of_inner, ring_damage(&outer, passages[1], loads[1]))
}

const STOP: Origin = Origin {
    law: "I Ω̇ = −n (M0(ν(T), Ω) + M1(ΣQ)) − c_w Ω², to coast_down.stop_speed",
    source: "crates/thermal/src/coast_down.rs; heat-and-life, section 6",
    valid: "the rotor rolls on its bearings: no whirl, no lost contact, no resonance",
};
const TURNS: Origin = Origin {
    law: "∫Ω dt/2π",
    source: "definition",
    valid: "as stop_time",
};
const MOMENT: Origin = Origin {
    law: "M = n (M0 + M1) + c_w Ω² of all bearings at the start, cold; power M Ω",
    source: "Palmgren, as in the theory of the steady moment",
    valid: "as stop_time",
};
const ENERGY: Origin = Origin {
    law: "½ I Ω²",
    source: "definition",
    valid: "always",
};
const HEAT: Origin = Origin {
    law: "kinetic energy lost in each step over the losses by their powers; C ΔT of all nodes; ∫G (T − T_ambient) dt",
    source: "crates/thermal/src/coast_down.rs, crates/thermal/src/network.rs; heat-and-life, sections 2 and 6",
    valid: "all bearings together; the heat of the gas leaves with it",
};
const RESIDUAL: Origin = Origin {
    law: "|heat made in the bearings − stored − given away| over the heat made",
    source: "energy balance",
    valid: "rounding",
};
const PEAK: Origin = Origin {
    law: "C Ṫ = P + Σ G (T_other − T)",
    source: "crates/thermal/src/bearing_network.rs; heat-and-life, section 2",
    valid: "bodies of one temperature; conductances of contacts and seats within a factor of two",
};
const LIMIT: Origin = Origin {
    law: "first time at which the node is above heat.race_limit, heat.cage_limit or heat.lubricant_limit",
    source: "makers' catalogues",
    valid: "as the temperatures",
};
const TAKE: Origin = Origin {
    law: "a second run-out in which every node stays at its limit once it is there: largest power taken from it, and the sum",
    source: "heat-and-life, section 5",
    valid: "all bearings together; cooling that acts on the node itself",
};
const CLEARANCE: Origin = Origin {
    law: "P_d = P_d0 + α_o d_o ΔT_o − α_i d_i ΔT_i − 2 α_b D ΔT_b",
    source: "crates/thermal/src/clearance.rs; heat-and-life, section 5",
    valid: "rings free to grow, each of one temperature",
};
const BALLS: Origin = Origin {
    law: "Q = K (δ cos φ − P_d/2)^1.5 with Σ Q cos φ = load",
    source: "crates/physics/src/load_zone.rs",
    valid: "quasi-static, one ball on the load line",
};
const GROWTH: Origin = Origin {
    law: "largest real part of the eigenvalues of C⁻¹(∂P/∂T − G); above 0 a disturbance grows, 1/it is the time",
    source: "crates/thermal/src/steady_speed.rs; heat-and-life, section 5",
    valid: "the speed of that instant held",
};
const KAPPA: Origin = Origin {
    law: "κ = ν/ν₁, ν₁ = 45000 n^−0.83 d_m^−½ below 1000/min, 4500 n^−½ d_m^−½ above",
    source: "ISO 281:2007 (from memory)",
    valid: "below 0.1 no life factor holds",
};
const LIFE: Origin = Origin {
    law: "Σ turns Q³ at each place of both rings over the rating loads of ISO/TS 16281, to the power 10/9; Weibull",
    source: "crates/physics/src/life.rs; heat-and-life, section 8",
    valid: "rolling fatigue alone, without lubricant factor (0.1 to 50); an order, never a promise: single bearings scatter 50 to 1",
};
