//! Every named result of a run-out with its law, source and valid range.

use crate::result::list::{List, NOT_GIVEN, Origin, relative};
use crate::simulate::bearing::races as shared;
use crate::simulate::bearing::warm::Warmed;
use crate::simulate::coast_down::build::{ICE_POINT, Part, turns};
use crate::simulate::coast_down::ran::Ran;
use crate::simulate::coast_down::rows::{BallsSeen, End, Row, RowOfBearing};
use model::system::layout::of_part;
use physics::life::{RatedBearing, add_points, passages_per_turn, repetitions};
use std::f64::consts::TAU;
use thermal::bearing_network::{INNER_RACE, LUBRICANT, NODES, OUTER_RACE, PASSES};
use thermal::losses::Losses;
use thermal::warm_machine::{OF_BEARING, by_kind};

/// Places of the outer ring that its life is summed over.
const PLACES: usize = 180;

/// Names the results.
pub(crate) fn name(ran: &Ran, list: &mut List) {
    motion(ran, list);
    heats(ran, list);
    for (k, _) in ran.parts() {
        temperatures(ran, k, list);
    }
    held(ran, list);
    for (k, part) in ran.parts() {
        clearance(ran, k, list);
        let growth = ran.free.rows.iter().map(|row| row.growth);
        if k == 0 {
            let most = growth.fold(f64::NEG_INFINITY, f64::max);
            list.peak_growth(Ok(most));
        }
        life(ran, k, part, list);
    }
}

fn motion(ran: &Ran, list: &mut List) {
    let free = &ran.free;
    let stands = match free.end {
        End::Stands => Ok(free.state.time),
        _ => Err("the rotor did not come to stand in this run".to_string()),
    };
    list.awaited("stop_time", stands, &STOP);
    let all = pairs(&free.rows).map(|(_, _, turned)| turned).sum();
    list.number("turns", "", Ok(all), &TURNS);
    let first = &free.rows[0].moments;
    list.number("start_moment", "N m", Ok(first.iter().sum()), &MOMENT);
    let power = first.iter().sum::<f64>() * free.rows[0].speed;
    list.number("start_power", "W", Ok(power), &MOMENT);
}

/// Turns of the rotor that each row stands for: half of those to its neighbours.
fn turned(rows: &[Row]) -> Vec<f64> {
    let mut list = vec![0.0; rows.len()];
    for (k, (_, _, turned)) in pairs(rows).enumerate() {
        list[k] += 0.5 * turned;
        list[k + 1] += 0.5 * turned;
    }
    list
}

/// Neighbouring rows with the turns of the rotor between them.
fn pairs(rows: &[Row]) -> impl Iterator<Item = (&Row, &Row, f64)> {
    rows.windows(2).map(|pair| {
        let speed = 0.5 * (pair[0].speed + pair[1].speed);
        (
            &pair[0],
            &pair[1],
            turns(speed, pair[1].time - pair[0].time),
        )
    })
}

fn heats(ran: &Ran, list: &mut List) {
    let free = &ran.free;
    let heats = &free.state.heats;
    let sides = f64::from(ran.built.sides);
    list.number("rotor_energy", "J", Ok(ran.built.energy), &ENERGY);
    // with what no law of a rolling bearing knows
    let [speed_dependent, load_dependent, of_rotor] = by_kind(heats);
    for (name, heat) in [
        ("speed_dependent_heat", speed_dependent),
        ("load_dependent_heat", load_dependent),
        ("windage_heat", of_rotor),
    ] {
        list.number(name, "J", Ok(heat), &HEAT);
    }
    list.number("stored_heat", "J", Ok(free.stored), &HEAT);
    for (k, part) in ran.parts() {
        for node in ran.nodes(k) {
            let before = ran.built.warm_from[node.place()];
            let rise = free.state.temperatures[node.place()] - before;
            let kept = sides * part.network.capacities[node.node] * rise;
            let at = &free.state.at_nodes;
            let [made, given] = [at.made[node.place()], at.given[node.place()]];
            list.node_heats(&part.name, node.node, [made, kept, given]);
        }
        let mut passes = [[f64::INFINITY, 0.0]; PASSES.len()];
        for row in &free.rows {
            let temperatures = &row.temperatures[k * NODES.len()..][..NODES.len()];
            let now =
                (part.network).passes(row.bearings[k].landing, row.bearings[k].speed, temperatures);
            for ([least, most], now) in passes.iter_mut().zip(now) {
                (*least, *most) = (least.min(now), most.max(now));
            }
        }
        list.conductances(&part.name, passes);
        // windows have other losses, whose heat is known by nodes alone
        if ran.built.start.heats.iter().any(|heat| *heat != 0.0) {
            continue;
        }
        let losses = ran.built.losses(0.0);
        for (loss, name) in ["speed_dependent", "load_dependent"]
            .into_iter()
            .enumerate()
        {
            let loss = OF_BEARING * k + loss;
            let share = |node| losses.share(loss, k * NODES.len() + node);
            let flow: Vec<f64> = (0..NODES.len())
                .map(|node| heats[loss] * share(node))
                .collect();
            list.heat_by_node(&part.name, name, &flow);
        }
    }
    list.number("heat_to_surroundings", "J", Ok(free.state.given), &HEAT);
    let made = speed_dependent + load_dependent;
    let left = made - free.stored - free.state.given;
    list.number(
        "relative_heat_residual",
        "1",
        relative(left.abs(), made),
        &RESIDUAL,
    );
}

fn temperatures(ran: &Ran, k: usize, list: &mut List) {
    let part = &ran.built.parts[k].name;
    for node in ran.nodes(k) {
        let of = |words: &str| of_part(part, &words.replace('#', node.name()));
        let (peak, at) = ran.peak(node);
        list.number(&of("peak_#_temperature"), "K", Ok(peak + ICE_POINT), &PEAK);
        list.number(&of("peak_#_time"), "s", Ok(at), &PEAK);
        let Some(limit) = ran.limits[node.place()] else {
            continue;
        };
        let passed = ran.first(|row| row.temperatures[node.place()] - limit);
        let held = (ran.held.as_ref()).filter(|held| held.taken[node.place()] > 0.0);
        let taken = held.map(|held| {
            let rows = held.rows.iter();
            let most = rows.map(|row| row.taken[node.place()]).fold(0.0, f64::max);
            [most, held.taken[node.place()]]
        });
        let warmed = Warmed {
            start: ran.built.parts[k].warm.heat.start_temperature - ICE_POINT,
            peak,
            limit,
        };
        list.limit(part, node.name(), &warmed, passed, taken);
    }
}

/// The run-out whose nodes are held, which has times of its own.
fn held(ran: &Ran, list: &mut List) {
    let rows = || ran.held.iter().flat_map(|held| &held.rows);
    let each = ran.parts().flat_map(|(k, _)| ran.nodes(k));
    let needy = each.filter(|node| (ran.held.iter()).any(|held| held.taken[node.place()] > 0.0));
    list.held_times(rows().map(|row| row.time).collect());
    for node in needy {
        let powers = rows().map(|row| row.taken[node.place()]).collect();
        let part = &ran.built.parts[node.bearing].name;
        list.powers_to_take(part, node.name(), powers);
    }
}

fn clearance(ran: &Ran, k: usize, list: &mut List) {
    let of = |words: &str| of_part(&ran.built.parts[k].name, words);
    let least = ran.rows(k).map(|row| row.clearance);
    let least = least.fold(f64::INFINITY, f64::min);
    list.number(&of("smallest_clearance"), "m", Ok(least), &CLEARANCE);
    let closes = ran.first(|row| -row.bearings[k].clearance);
    let open = || "the bearing stays open".to_string();
    list.awaited(&of("closing_time"), closes.ok_or_else(open), &CLEARANCE);
    let most = |of: fn(&RowOfBearing) -> f64| ran.rows(k).map(of).fold(0.0, f64::max);
    let load = most(RowOfBearing::largest_ball_load);
    list.number(&of("peak_ball_load"), "N", Ok(load), &BALLS);
    let part = &ran.built.parts[k];
    let pressure = most(|row| row.largest_pressure);
    list.indentation_index(&part.name, pressure, part.pressure_limit);
}

fn life(ran: &Ran, k: usize, part: &Part, list: &mut List) {
    let of = |words: &str| of_part(&part.name, words);
    let ratios = ran
        .free
        .rows
        .iter()
        .map(|row| viscosity_ratio(k, part, row));
    let least = least_of_turns(ratios.zip(turned(&ran.free.rows)).collect());
    list.number(&of("smallest_viscosity_ratio"), "1", Ok(least), &KAPPA);
    let points = (part.warm.dynamic_load_rating)
        .ok_or_else(|| format!("bearing.dynamic_load_rating{NOT_GIVEN}"))
        .map(|rating| used(ran, k, part, rating, &|_, _| 1.0));
    let whole =
        |points: &Result<_, String>| points.as_ref().map(shared::used_by).map_err(String::clone);
    let share = whole(&points);
    list.number(&of("life_share"), "1", share.clone(), &LIFE);
    let lubricated = (part.warm.dynamic_load_rating)
        .zip(part.warm.static_load_rating)
        .ok_or_else(|| format!("bearing.dynamic_load_rating or static_load_rating{NOT_GIVEN}"))
        .map(|(rating, still)| {
            used(ran, k, part, rating, &|row, load| {
                life_factor(k, part, still, row, load)
            })
        });
    list.number(
        &of("life_share_with_lubricant"),
        "1",
        whole(&lubricated),
        &LUBRICATED,
    );
    let lasting = whole(&lubricated).or(share);
    list.life_by_point(&part.name, lubricated.or(points));
    for (name, survival) in [
        ("runs_until_one_percent_fail", 0.99),
        ("runs_until_ten_percent_fail", 0.9),
        ("runs_until_half_fail", 0.5),
    ] {
        let count = match ran.free.end.leaves() {
            true => Err(shared::NOT_WHOLE.to_string()),
            false => lasting.clone().map(|share| repetitions(share, survival)),
        };
        list.number(&of(name), "1", count, &RUNS);
    }
}

/// Share of the turns that a smallest value leaves out: the last ones before the standstill, which no lubricant film carries.
const LAST_TURNS: f64 = 0.01;

/// The value that all but the [`LAST_TURNS`] exceed, of values and the turns that each stands for.
fn least_of_turns(mut values: Vec<(f64, f64)>) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut left = LAST_TURNS * values.iter().map(|(_, turns)| turns).sum::<f64>();
    let exceeded = values.iter().find(|(_, turns)| {
        left -= turns;
        left <= 0.0
    });
    exceeded.map_or(f64::NAN, |(value, _)| *value)
}

/// Life factor of lubricant and cleanliness at a row, a_ISO, with the rating of a hot ring in it, under a load, N.
fn life_factor(k: usize, part: &Part, static_rating: f64, row: &Row, load: f64) -> f64 {
    let warm = &part.warm;
    let races = [INNER_RACE, OUTER_RACE].map(|node| row.temperatures[k * NODES.len() + node]);
    let kappa = viscosity_ratio(k, part, row);
    let hot = races[0].max(races[1]);
    shared::life_factor(warm, static_rating, load, kappa, hot)
}

/// κ at a row.
fn viscosity_ratio(k: usize, part: &Part, row: &Row) -> f64 {
    let kelvin = row.temperatures[k * NODES.len() + LUBRICANT] + ICE_POINT;
    let viscosity = part.viscosity.held(kelvin);
    shared::viscosity_ratio(&part.warm, viscosity, row.bearings[k].speed)
}

/// Share of the rating life that the run-out uses at the points of both rings of one bearing, with a life factor at each row and the radial
/// load that presses the balls as hard, W ΣQ/ΣQ_0, N.
fn used(
    ran: &Ran,
    k: usize,
    part: &Part,
    rating: f64,
    factor: &dyn Fn(&Row, f64) -> f64,
) -> [Vec<f64>; 2] {
    let warm = &part.warm;
    let gamma = warm.ball_diameter / warm.pitch_diameter;
    let bearing = RatedBearing {
        rating,
        ball_count: warm.ball_count as f64,
        gamma,
        grooves: [warm.inner_groove_curvature, warm.outer_groove_curvature],
        contact_angle: 0.0,
    };
    let passages = passages_per_turn(warm.ball_count as f64, gamma);
    let mean = |list: &[f64]| list.iter().sum::<f64>() / list.len() as f64;
    let open = part.zone.clearance.at_reference.max(0.0);
    let unpreloaded = mean(&part.zone.all_round(open, PLACES));
    // sums of cubes that pass each place, by laws from the load line on, by windows as they have seen them
    let mut by_laws = [vec![0.0; PLACES], vec![0.0; PLACES]];
    let mut seen = [vec![0.0; PLACES], vec![0.0; PLACES]];
    for (row, turned) in (ran.free.rows.iter()).zip(turned(&ran.free.rows)) {
        // balls pass with the race, which may slide under the rotor or stand
        let own = &row.bearings[k];
        let turned = turned * own.speed / row.speed;
        let zone = part.zone.all_round(own.clearance, PLACES);
        let pressing = warm.radial_load * mean(&zone) / unpreloaded;
        let cubes = [0.0, part.network.centrifugal(own.speed)]
            .map(|more| -> Vec<f64> { zone.iter().map(|load| (load + more).powi(3)).collect() });
        // a window is as closed as its bearing was then, and the laws know no impacts: the larger of both counts
        let times = |balls: &BallsSeen| mean(&balls.cubes[1]) / (passages[1] * mean(&cubes[1]));
        let seen_by_window = own.balls.as_ref().map(|balls| (balls, times(balls)));
        match seen_by_window.filter(|(_, times)| *times > 1.0) {
            Some((balls, times)) => {
                let turned = turned / factor(row, times.cbrt() * pressing);
                for (sum, cubes) in seen.iter_mut().zip(&balls.cubes) {
                    add_points(sum, cubes, turned);
                }
            }
            None => {
                let turned = turned / factor(row, pressing);
                for (sum, cubes) in by_laws.iter_mut().zip(&cubes) {
                    add_points(sum, cubes, turned);
                }
            }
        }
    }
    let [on_inner, mut by_laws] = by_laws;
    let mean = on_inner.iter().sum::<f64>() / PLACES as f64;
    // from the load line to the frame's x axis
    let rotated = part.load_direction / TAU * PLACES as f64;
    by_laws.rotate_right(rotated.round().rem_euclid(PLACES as f64) as usize % PLACES);
    let [mut inner, mut outer] = seen;
    inner.iter_mut().for_each(|sum| *sum += mean * passages[0]);
    for (sum, cubes) in outer.iter_mut().zip(by_laws) {
        *sum += cubes * passages[1];
    }
    bearing.by_point([&inner, &outer])
}

const STOP: Origin = Origin {
    law: "I Ω̇ = −n (M0(ν(T), Ω) + M1(ΣQ)) − c_w Ω², to coast_down.stop_speed",
    source: "crates/thermal/src/coast_down.rs; book/src/theory/heat.md",
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
    source: "crates/thermal/src/coast_down.rs, crates/thermal/src/network.rs; book/src/theory/heat.md",
    valid: "all bearings together; the heat of the gas leaves with it",
};
const RESIDUAL: Origin = Origin {
    law: "|heat made in the bearings − stored − given away| over the heat made",
    source: "energy balance",
    valid: "rounding",
};
const PEAK: Origin = Origin {
    law: "C Ṫ = P + Σ G (T_other − T)",
    source: "crates/thermal/src/bearing_network.rs; book/src/theory/heat.md",
    valid: "bodies of one temperature; conductances of contacts and seats within a factor of two",
};
const CLEARANCE: Origin = Origin {
    law: "P_d = P_d0 + α_o d_o ΔT_o − α_i d_i ΔT_i − 2 α_b D ΔT_b − 2u(Ω)",
    source: "crates/thermal/src/clearance.rs; book/src/theory/heat.md",
    valid: "rings free to grow, each of one temperature",
};
const BALLS: Origin = Origin {
    law: "Q = K (δ cos φ − P_d/2)^1.5 with Σ Q cos φ = load; on the outer race m_b (d_m/2) ω_c² more",
    source: "crates/physics/src/load_zone.rs",
    valid: "quasi-static, one ball on the load line",
};
const KAPPA: Origin = Origin {
    law: "κ = ν/ν₁, ν₁ = 45000 n^−0.83 d_m^−½ below 1000/min, 4500 n^−½ d_m^−½ above; exceeded in 99 % of the turns",
    source: "ISO 281:2007 (from memory)",
    valid: "the last turns before the standstill are left out: no film carries them; below 0.1 no life factor holds",
};
const LUBRICATED: Origin = Origin {
    law: "as life_share, each phase over a_ISO(κ, e_C C_u/P) and over the cube of the temperature factor of its hotter race; C_u = C0/22, P the radial load that presses the balls as hard as load and \
          preload do",
    source: "ISO 281:2007 (from memory), crates/physics/src/life.rs; book/src/theory/heat.md",
    valid: "below κ = 0.1 no factor holds, and 0.1 is taken; e_C = heat.contamination decides within a factor of ten",
};
const RUNS: Origin = Origin {
    law: "(ln(1/S)/ln(1/0.9))^(9/10)/D of one bearing that 1, 10, 50 % do not outlive; D is life_share_with_lubricant where it is known, else \
          life_share",
    source: "Weibull, slope 10/9; book/src/theory/heat.md",
    valid: "as life_share",
};
const LIFE: Origin = Origin {
    law: "Σ turns Q³ at each place of both rings, centrifugal load of the balls on the outer one included, over the rating loads of ISO/TS 16281, to the power 10/9; Weibull",
    source: "crates/physics/src/life.rs; book/src/theory/heat.md",
    valid: "rolling fatigue alone, without lubricant factor (0.1 to 50); an order, never a promise: single bearings scatter 50 to 1",
};
