//! Every named result of a coast-down with its law, source and valid range.

use crate::bearing::races::{self as shared, BY_POINT, Life, no_rating, used_by};
use crate::bearing::severity::{INDENTATION_INDEX, indentation_index};
use crate::bearing::warm::{
    GROWTH, Limited, conductances, heat_by_node, held_times, limit, node_heats, powers_to_take,
};
use crate::coast_down::build::{ICE_POINT, Part, turns};
use crate::coast_down::course::Course;
use crate::coast_down::passages::limits;
use crate::coast_down::rows::{BallsSeen, End, Row, RowOfBearing};
use crate::coast_down::run::{CoastDownRun, NodeOf};
use outcome::list::results;
use outcome::list::{List, not_given, origins, relative};
use physics::life::{RatedBearing, add_points, passages_per_turn};
use std::f64::consts::TAU;
use thermal::bearing_network::{INNER_RACE, LUBRICANT, NODES, OUTER_RACE, PASSES};
use thermal::losses::Losses;
use thermal::warm_machine::{OF_BEARING, by_kind};

/// Places of the outer ring that its life is summed over.
const PLACES: usize = 180;

/// Names the results of a coast-down on these bearings; without a run those of any.
pub(crate) fn name(list: &mut List, parts: &[Part], run: Option<&CoastDownRun>) {
    motion(list, &(), run);
    for (k, part) in parts.iter().enumerate() {
        list.of_part(&part.name, |list| heats(list, part, k, run));
    }
    balance(list, &(), run);
    for (k, part) in parts.iter().enumerate() {
        list.of_part(&part.name, |list| temperatures(list, part, k, run));
    }
    let times = |held: &Course| held.each(|row| row.time);
    let held = run.map(|run| run.held.as_ref().map_or(Vec::new(), times));
    held_times(list, &(), held.as_ref());
    for (k, part) in parts.iter().enumerate() {
        let powers = run.map(|run| run.powers_to_take(part, k));
        list.of_part(&part.name, |list| list.each_found(powers, powers_to_take));
    }
    for (k, part) in parts.iter().enumerate() {
        list.of_part(&part.name, |list| clearance(list, &(k, part), run));
        if k == 0 {
            growth(list, &(), run);
        }
        let taken = run.and_then(|run| run.life(k, part));
        list.of_part(&part.name, |list| {
            viscosity(list, &(k, part), run);
            life(list, part, taken.as_ref());
        });
    }
}

fn heats(list: &mut List, part: &Part, k: usize, run: Option<&CoastDownRun>) {
    for node in part.nodes(k) {
        let heats = run.map(|run| run.heats(part, node));
        list.named(&[node.name()], |list| {
            node_heats(list, &node.node, heats.as_ref())
        });
    }
    conductances(list, run.map(|run| run.conductances(part, k)));
    list.each_found(run.map(|run| run.heats_by_node(k)), heat_by_node);
}

fn temperatures(list: &mut List, part: &Part, k: usize, run: Option<&CoastDownRun>) {
    for node in part.nodes(k) {
        let peak = run.map(|run| run.peak(node));
        list.named(&[node.name()], |list| {
            peaks(list, &(), peak.as_ref());
            if let Some(at) = limits(&part.warm)[node.node] {
                limit(
                    list,
                    &(),
                    run.map(|run| run.limited(part, node, at)).as_ref(),
                );
            }
        });
    }
}

results! {
    fn motion(setup: &(), run: &CoastDownRun) {
        "stop_time": instant "s" headline, STOP, "time until the rotor stands" in machine_tile "Stands after" => match run.free.end {
            End::Stands => Ok(run.free.state.time),
            End::Reached => Err("the run ends at coast_down.stop_speed, where the rotor still turns".to_string()),
            _ => Err("the rotor did not come to stand in this run".to_string()),
        };
        "turns": number "", TURNS, "turns of the rotor" => pairs(&run.free.rows).map(|(_, _, turned)| turned).sum::<f64>();
        "start_moment": number "N m", MOMENT, "moment of all bearings and the gas at the start" => run.start_moment();
        "start_power": number "W" headline, MOMENT, "power of this moment" => run.start_moment() * run.free.rows[0].speed;
        "rotor_energy": number "J" headline, ENERGY, "kinetic energy of the rotor at the start" in note "Stands after: energy to lose" => run.built.energy;
        "speed_dependent_heat": number "J", HEAT, "heat of the speed-dependent moments" => match run.built.by_laws() {
            true => Ok(by_kind(&run.free.state.heats)[0]),
            false => Err("intervals measure the moment of bearings in space as a whole: see coast_down.load_dependent_heat".to_string()),
        };
        "load_dependent_heat": number "J", HEAT, "heat of the load-dependent moments; of bearings in space that of their whole moment" => by_kind(&run.free.state.heats)[1];
        "windage_heat": number "J", HEAT, "heat of the gas and of what else brakes the rotor" => by_kind(&run.free.state.heats)[2];
        "stored_heat": number "J", HEAT, "heat stored in all bodies" in heat_balance "stored" => run.free.stored;
    }
    fn balance(setup: &(), run: &CoastDownRun) {
        "heat_to_surroundings": number "J", HEAT, "heat given to the surroundings" in heat_balance "to the surroundings" => run.free.state.given;
        "relative_heat_residual": number "1" headline, RESIDUAL, "residual of the heat balance over the heat made" in machine_tile "Heat residual" in bound "1e-9" => {
            let [speed_dependent, load_dependent, _] = by_kind(&run.free.state.heats);
            let made = speed_dependent + load_dependent;
            relative((made - run.free.stored - run.free.state.given).abs(), made)
        };
    }
    fn peaks(setup: &(), peak: &(f64, f64)) {
        "peak_*_temperature": number "K" headline, PEAK, "highest temperature of this body" => peak.0 + ICE_POINT;
        "peak_*_time": number "s", PEAK, "instant of this temperature" => peak.1;
    }
    fn clearance(of: &(usize, &Part), run: &CoastDownRun) {
        "smallest_clearance": number "m" headline, CLEARANCE, "smallest diametral clearance", unless at_angle(of.1) => run.rows(of.0).map(|row| row.clearance).fold(f64::INFINITY, f64::min);
        "closing_time": instant "s" headline, CLEARANCE, "first time without clearance" in instants "clearance closed", unless at_angle(of.1) => {
            let closes = run.first(|row| -row.bearings[of.0].clearance);
            closes.ok_or_else(|| "the bearing stays open".to_string())
        };
        "peak_ball_load": number "N", BALLS, "largest load of a ball" => run.most(of.0, RowOfBearing::largest_ball_load);
        "indentation_index": number "1", INDENTATION_INDEX, "largest ball load over the load that dents" in worst "dents by ball loads" in note "Peak Hertz pressure: index of dents until standstill" in bound "1" => {
            indentation_index(run.most(of.0, |row| row.largest_pressure), of.1.pressure_limit)
        };
    }
    fn growth(setup: &(), run: &CoastDownRun) {
        "peak_growth_rate": number "1/s" headline, GROWTH, "largest growth rate of a disturbance of the temperatures" => {
            run.free.rows.iter().map(|row| row.growth).fold(f64::NEG_INFINITY, f64::max)
        };
    }
    fn viscosity(of: &(usize, &Part), run: &CoastDownRun) {
        "smallest_viscosity_ratio": number "1", KAPPA, "viscosity ratio exceeded in 99 % of the turns" => {
            let ratios = run.free.rows.iter().map(|row| viscosity_ratio(of.0, of.1, row));
            least_of_turns(ratios.zip(turned(&run.free.rows)).collect())
        };
    }
    /// What a coast-down takes of the life of a bearing.
    fn life(part: &Part, run: &Life) {
        "life_share": number "1" headline, LIFE, "share of the rating life that this coast-down takes" in added_up "rolling fatigue, of L10" in life "Share of the life L10 that it uses" in tile "Life used by one coast-down", unless no_rating(part.rating()) => run.share;
        "life_share_with_lubricant": number "1", LUBRICATED, "the same with the life factor of the lubricant" in added_up "rolling fatigue, of L10" in life "Share with lubricant, cleanliness and temperature", unless no_ratings(part) => {
            run.with_lubricant.clone()
        };
        "inner_life_share_by_point": list "1", BY_POINT, "share of life at each point of the inner ring" when part.rating().is_some() => run.points[0].clone();
        "outer_life_share_by_point": list "1", BY_POINT, "share of life at each point of the outer ring" when part.rating().is_some() => run.points[1].clone();
        "runs_until_one_percent_fail": number "1", RUNS, "coast-downs until 1 % of bearings have failed" in life "Coast-downs until 1 % of bearings have failed", unless no_rating(part.rating()) => run.repeated(0.99);
        "runs_until_ten_percent_fail": number "1" headline, RUNS, "coast-downs until 10 % of bearings have failed" in life "Coast-downs until 10 % of bearings have failed", unless no_rating(part.rating()) => run.repeated(0.9);
        "runs_until_half_fail": number "1", RUNS, "coast-downs until half of the bearings have failed" in life "Coast-downs until half of bearings have failed", unless no_rating(part.rating()) => run.repeated(0.5);
    }
}

/// Why a bearing has no clearance.
fn at_angle(part: &Part) -> Option<String> {
    let words = "balls that touch their races at an angle have no radial clearance";
    (part.warm.contact_angle > 0.0).then(|| words.to_string())
}

impl Part {
    fn rating(&self) -> Option<f64> {
        self.warm.dynamic_load_rating
    }
    /// Dynamic and static load rating, N.
    fn ratings(&self) -> Option<(f64, f64)> {
        self.rating().zip(self.warm.static_load_rating)
    }
}

fn no_ratings(part: &Part) -> Option<String> {
    let keys = "bearing.dynamic_load_rating or static_load_rating";
    not_given(keys, part.ratings())
}

impl CoastDownRun<'_> {
    /// The largest of a value of the rows of a bearing.
    fn most(&self, k: usize, of: fn(&RowOfBearing) -> f64) -> f64 {
        self.rows(k).map(of).fold(0.0, f64::max)
    }
    /// What it takes of the life of a bearing.
    fn life(&self, k: usize, part: &Part) -> Option<Life> {
        let points = used(self, k, part, part.rating()?, &|_, _| 1.0);
        let factor = |still| move |row: &Row, load| life_factor(k, part, still, row, load);
        let lubricated = (part.ratings())
            .map(|(rating, still)| used(self, k, part, rating, &factor(still)))
            .ok_or_else(|| no_ratings(part).unwrap_or_default());
        Some(Life {
            share: used_by(&points),
            with_lubricant: lubricated.as_ref().map(used_by).map_err(String::clone),
            points: lubricated.unwrap_or(points),
            is_all: self.free.end == End::Stands,
        })
    }
    /// Moment of all bearings and of what else brakes the rotor at the start, N m.
    fn start_moment(&self) -> f64 {
        self.free.rows[0].moments.iter().sum()
    }
    /// Heats made in, kept in and given to the surroundings by a node, J.
    fn heats(&self, part: &Part, node: NodeOf) -> [f64; 3] {
        let state = &self.free.state;
        let rise = state.temperatures[node.place()] - self.built.warm_from[node.place()];
        let kept = part.losses.count * part.network.capacities[node.node] * rise;
        let [made, given] = [&state.at_nodes.made, &state.at_nodes.given];
        [made[node.place()], kept, given[node.place()]]
    }
    /// Least and largest conductance of each pass of a bearing, W/K.
    fn conductances(&self, part: &Part, k: usize) -> [[f64; 2]; PASSES.len()] {
        let mut passes = [[f64::INFINITY, 0.0]; PASSES.len()];
        for row in &self.free.rows {
            let temperatures = &row.temperatures[k * NODES.len()..][..NODES.len()];
            let own = &row.bearings[k];
            let now = part.network.passes(own.landing, own.speed, temperatures);
            for ([least, most], now) in passes.iter_mut().zip(now) {
                (*least, *most) = (least.min(now), most.max(now));
            }
        }
        passes
    }
    /// Heat of the losses of a bearing over its nodes, J; nothing after intervals, whose heat is known by nodes alone.
    fn heats_by_node(&self, k: usize) -> Vec<(&'static str, Vec<f64>)> {
        if self.built.start.heats.iter().any(|heat| *heat != 0.0) {
            return Vec::new();
        }
        let losses = self.built.losses(0.0, 0.0);
        let flow = |loss: usize| {
            let share = |node| losses.share(loss, k * NODES.len() + node);
            let heat = |node| self.free.state.heats[loss] * share(node);
            (0..NODES.len()).map(heat).collect()
        };
        let first = OF_BEARING * k;
        vec![
            ("speed_dependent", flow(first)),
            ("load_dependent", flow(first + 1)),
        ]
    }
    /// Of a node with a limit, °C.
    fn limited(&self, part: &Part, node: NodeOf, limit: f64) -> Limited {
        let held = (self.held.as_ref()).filter(|held| held.taken[node.place()] > 0.0);
        Limited {
            start: part.warm.heat.start_temperature - ICE_POINT,
            peak: self.peak(node).0,
            limit,
            passed: self.first(|row| row.temperatures[node.place()] - limit),
            taken: held.map(|held| {
                let most = held.powers(node).into_iter().fold(0.0, f64::max);
                [most, held.taken[node.place()]]
            }),
        }
    }
    /// Powers to take over time from the nodes of a bearing that must be held, W.
    fn powers_to_take(&self, part: &Part, k: usize) -> Vec<(&'static str, Vec<f64>)> {
        let each = |held: &Course| {
            let needy = part.nodes(k).filter(|node| held.taken[node.place()] > 0.0);
            needy.map(|node| (node.name(), held.powers(node))).collect()
        };
        self.held.as_ref().map_or(Vec::new(), each)
    }
}

impl Course {
    /// A number of each of its rows.
    fn each(&self, of: impl Fn(&Row) -> f64) -> Vec<f64> {
        self.rows.iter().map(of).collect()
    }
    /// Power that is taken from a node over time, W.
    fn powers(&self, node: NodeOf) -> Vec<f64> {
        self.each(|row| row.taken[node.place()])
    }
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

/// Radial load over the number of balls and the cubic mean of the loads that pass a point, of balls without clearance: their largest is 4.37/z
/// of it, and the cubic mean 0.5625 of that (Stribeck's distribution).
const STRIBECK: f64 = 1.0 / (4.37 * 0.5625);
/// A load that takes no life, N.
const LEAST_LOAD: f64 = 1e-3;

/// Share of the rating life that the coast-down uses at the points of both rings of one bearing, with a life factor at each row and the radial
/// load that presses the balls as hard, W ΣQ/ΣQ_0, N.
fn used(
    ran: &CoastDownRun,
    k: usize,
    part: &Part,
    rating: f64,
    factor: &dyn Fn(&Row, f64) -> f64,
) -> [Vec<f64>; 2] {
    let warm = &part.warm;
    let gamma = warm.ball_diameter * warm.contact_angle.cos() / warm.pitch_diameter;
    let bearing = RatedBearing {
        rating,
        ball_count: warm.ball_count as f64,
        gamma,
        grooves: [warm.inner_groove_curvature, warm.outer_groove_curvature],
        contact_angle: warm.contact_angle,
    };
    let passages = passages_per_turn(warm.ball_count as f64, gamma);
    let mean = |list: &[f64]| list.iter().sum::<f64>() / list.len() as f64;
    let open = part.zone.clearance.at_reference.max(0.0);
    let mut zone_of_row = part.zone.clone();
    let mut unpreloaded = mean(&zone_of_row.all_round(open, PLACES));
    // sums of cubes that pass each place, by laws from the load line on, by intervals as they have seen them
    let mut by_laws = [vec![0.0; PLACES], vec![0.0; PLACES]];
    let mut seen = [vec![0.0; PLACES], vec![0.0; PLACES]];
    for (row, turned) in (ran.free.rows.iter()).zip(turned(&ran.free.rows)) {
        // balls pass with the race, which may slide under the rotor or stand
        let own = &row.bearings[k];
        let turned = turned * own.speed / row.speed;
        if own.load != zone_of_row.load {
            zone_of_row.load = own.load;
            unpreloaded = mean(&zone_of_row.all_round(open, PLACES));
        }
        let zone = zone_of_row.all_round(own.clearance, PLACES);
        // no law knows the loads of balls that thrust alone presses: then as those of a radial load that presses them as hard
        let as_radial = |cube: f64| STRIBECK * warm.ball_count as f64 * cube.cbrt();
        let pressing = match unpreloaded > 0.0 {
            true => own.load * mean(&zone) / unpreloaded,
            false => 0.0,
        };
        let cubes = [0.0, part.network.centrifugal(own.speed)]
            .map(|more| -> Vec<f64> { zone.iter().map(|load| (load + more).powi(3)).collect() });
        // an interval is as closed as its bearing was then, and the laws know no impacts: the larger of both counts
        let times = |balls: &BallsSeen| mean(&balls.cubes[1]) / (passages[1] * mean(&cubes[1]));
        let seen_by_interval = own.balls.as_ref().map(|balls| (balls, times(balls)));
        match seen_by_interval.filter(|(_, times)| *times > 1.0) {
            Some((balls, times)) => {
                let load = match pressing > 0.0 {
                    true => times.cbrt() * pressing,
                    false => as_radial(mean(&balls.cubes[1]) / passages[1]),
                };
                let turned = turned / factor(row, load);
                for (sum, cubes) in seen.iter_mut().zip(&balls.cubes) {
                    add_points(sum, cubes, turned);
                }
            }
            None => {
                let load = match pressing > 0.0 {
                    true => pressing,
                    false => as_radial(mean(&cubes[1])),
                };
                let turned = turned / factor(row, load.max(LEAST_LOAD));
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

origins! {
    STOP: law "I Ω̇ = −n (M0(ν(T), Ω) + M1(ΣQ)) − c_w Ω², to coast_down.stop_speed",
        source "crates/thermal/src/coast_down.rs; book/src/theory/heat.md",
        valid "the rotor rolls on its bearings: no whirl, no lost contact, no resonance";
    TURNS: law "∫Ω dt/2π",
        source "definition",
        valid "as stop_time";
    MOMENT: law "M = n (M0 + M1) + c_w Ω² of all bearings at the start, cold; power M Ω",
        source "Palmgren, as in the theory of the steady moment",
        valid "as stop_time";
    ENERGY: law "½ I Ω²",
        source "definition",
        valid "always";
    HEAT: law "kinetic energy lost in each step over the losses by their powers; C ΔT of all nodes; ∫G (T − T_ambient) dt",
        source "crates/thermal/src/coast_down.rs, crates/thermal/src/network.rs; book/src/theory/heat.md",
        valid "all bearings together; the heat of the gas leaves with it";
    RESIDUAL: law "|heat made in the bearings − stored − given away| over the heat made",
        source "energy balance",
        valid "rounding";
    PEAK: law "C Ṫ = P + Σ G (T_other − T)",
        source "crates/thermal/src/bearing_network.rs; book/src/theory/heat.md",
        valid "bodies of one temperature; conductances of contacts and seats within a factor of two";
    CLEARANCE: law "P_d = P_d0 + α_o d_o ΔT_o − α_i d_i ΔT_i − 2 α_b D ΔT_b − 2u(Ω)",
        source "crates/thermal/src/clearance.rs; book/src/theory/heat.md",
        valid "rings free to grow, each of one temperature";
    BALLS: law "Q = K (δ cos φ − P_d/2)^1.5 with Σ Q cos φ = load; on the outer race m_b (d_m/2) ω_c² more",
        source "crates/physics/src/load_zone.rs",
        valid "quasi-static, one ball on the load line";
    KAPPA: law "κ = ν/ν₁, ν₁ = 45000 n^−0.83 d_m^−½ below 1000/min, 4500 n^−½ d_m^−½ above; exceeded in 99 % of the turns",
        source "ISO 281:2007 (from memory)",
        valid "the last turns before the standstill are left out: no film carries them; below 0.1 no life factor holds";
    LUBRICATED: law "as life_share, each phase over a_ISO(κ, e_C C_u/P) and over the cube of the temperature factor of its hotter race; C_u = C0/22, P the radial load that presses the balls as hard as load and \
          preload do",
        source "ISO 281:2007 (from memory), crates/physics/src/life.rs; book/src/theory/heat.md",
        valid "below κ = 0.1 no factor holds, and 0.1 is taken; e_C = heat.contamination decides within a factor of ten";
    RUNS: law "(ln(1/S)/ln(1/0.9))^(9/10)/D of one bearing that 1, 10, 50 % do not outlive; D is life_share_with_lubricant where it is known, else \
          life_share",
        source "Weibull, slope 10/9; book/src/theory/heat.md",
        valid "as life_share";
    LIFE: law "Σ turns Q³ at each place of both rings, centrifugal load of the balls on the outer one included, over the rating loads of ISO/TS 16281, to the power 10/9; Weibull",
        source "crates/physics/src/life.rs; book/src/theory/heat.md",
        valid "rolling fatigue alone, without lubricant factor (0.1 to 50); an order, never a promise: single bearings scatter 50 to 1";
}
