//! How warm an auxiliary bearing becomes in a run: an observer. What follows the temperatures is not its matter.
//!
//! ```text
//!   heats of the ledger ──shares──► nodes of the bearing's network ──► surroundings
//! ```
//! Every heat that the ledger books for the bearing goes to nodes by shares that add to one, so that what the nodes store and the
//! surroundings take is the heat made, to rounding. Friction of rotor and race is shared as the surfaces that rub have shared it,
//! where they are followed; what flows from the warmer to the cooler through the patch in which they slide is part of that, and the network's own
//! contact conducts under the rest of the force.
//!
//! | loss | to |
//! |---|---|
//! | sliding and damping of ball and race | both sides by their effusivity √(kρc); half each of one material |
//! | pockets, cage on its land | both sides by their effusivity |
//! | orbit drag, inlets, the viscous part of the steady moment | lubricant |
//! | where contact films warm: sliding and steady moment, inlets, less what the films keep | as the rest of the steady moment |
//! | the rest of the steady moment, which depends on load | half at each race, both sides by their effusivity |
//! | rotor on race | as the surfaces share it, where they are followed; else half each |
//! | mount damping | mount, where it is a node, else housing |
//!
//! The network takes the heat in spans of 10 ms, long beside a contact and short beside its own times; conductances are those
//! of the mean force of the rotor on the race in each span, at the clearance there is.
//!
//! From the span on in which a node passes its limit, a second set of temperatures takes the same heats through the same
//! conductances with the nodes held at their limits: what must be taken from them for that.
//!
//! Source: derived; book/src/theory/heat.md. Range: a body is one temperature only after about 0.1 s; before that the surfaces
//! tell more.

mod growth;

use crate::bearing;
use crate::bearing::lubricant_state::FILM_KINDS;
use crate::heats::{HEATS, OWN_HEATS};
use crate::surface_heat::SurfaceHeat;
use physics::heat_conduction::{STEEL_HEAT, ThermalMaterial};
use physics::palmgren::Palmgren;
use physics::viscosity::ICE_POINT;
use physics::viscosity::Viscosity;
use thermal::bearing_network::{
    BALLS, BearingNetwork, CAGE, INNER_RACE, LUBRICANT, Landing, NODES, OUTER_RACE, Operation,
    PASSES, ROTOR, relaxing, together,
};
use thermal::held::Held;
use thermal::load_zone::LoadZone;
use thermal::oil_range::{self, BeyondData};
use thermal::steady_speed::SteadySpeed;
use thermal::warm_bearing::{BearingLoad, WarmBearings};

pub use growth::Growth;

/// A number per node.
pub type OfNodes = [f64; NODES.len()];

/// Span of heat that the network takes at once, s.
const SPAN: f64 = 10e-3;

/// Constants of a bearing that warms.
#[derive(Clone, Debug, PartialEq)]
pub struct WarmBearing {
    /// Its network.
    pub network: BearingNetwork,
    /// Temperature of all nodes at the start, °C.
    pub start: f64,
    /// Its balls under the weight.
    pub zone: LoadZone,
    /// Its lubricant; none where no oil is given, which then has the viscosity of [`Self::viscosity`].
    pub oil: Option<Viscosity>,
    /// Viscosity of the lubricant at the start, m²/s.
    pub viscosity: f64,
    /// The law that divides the steady moment, and says how it follows the temperatures; all of it heats the lubricant where there is none.
    pub losses: Option<WarmBearings>,
    /// Shares of each heat of the ledger over the nodes.
    pub shares: [OfNodes; HEATS],
    /// Limits of the nodes that have one, °C.
    pub limits: [Option<f64>; NODES.len()],
}

/// What has become of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Warmth {
    /// Of the nodes, °C.
    pub temperatures: Vec<f64>,
    /// The hottest that each node was, °C, and when, s.
    pub peaks: [(f64, f64); NODES.len()],
    /// When each node passed its limit, s.
    pub passed: [Option<f64>; NODES.len()],
    /// How a disturbance of them grows, once the balls are preloaded.
    pub growth: Growth,
    /// The same bearing with its nodes held at their limits, once one has got there.
    pub held: Option<Box<HeldWarmth>>,
    /// Heat made until now, J.
    pub made: f64,
    /// Of it what the contact films keep, which no node has received, J.
    pub in_films: f64,
    /// Heat given to the surroundings until now, J.
    pub given: f64,
    /// The heat made, by kinds of the ledger and nodes, J.
    pub flows: [OfNodes; HEATS],
    /// The heat given to the surroundings, by the nodes that give it, J.
    pub given_from: OfNodes,
    /// Least and largest conductance of each of the network's passes, W/K.
    pub passes: [[f64; 2]; PASSES.len()],
    /// When a ring became loose on the rotor and in its housing, s.
    pub loose: [Option<f64>; 2],
    /// Whether the lubricant was hotter or colder than its viscosity is known near.
    pub beyond_data: Option<BeyondData>,
    /// Time and temperatures at the end of each span, where they are kept.
    pub course: Vec<(f64, OfNodes)>,
    keep: bool,
    /// Until when they are known, s.
    until: f64,
    heats: [f64; HEATS],
    /// Spin of the inner race then, rad/s.
    spin: Option<f64>,
    taken: [f64; 2],
    slid: f64,
    impulse: f64,
}

/// What must be taken from the nodes of a bearing to hold them at their limits.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldWarmth {
    /// Which nodes are at their limits now.
    pub held: Held,
    /// °C.
    pub temperatures: Vec<f64>,
    /// Taken from each node until now, J.
    pub taken: OfNodes,
    /// The most that was taken from each in a span, W.
    pub most: OfNodes,
    /// The same of all together, W.
    pub most_of_all: f64,
    /// End of each span and the powers taken in it, W, where they are kept.
    pub course: Vec<(f64, OfNodes)>,
}

impl HeldWarmth {
    /// Ends a span, in which so much heat reached the nodes that were held, J.
    fn end(&mut self, part: &WarmBearing, reached: &[f64], (time, span): (f64, f64), keep: bool) {
        let capacities = &part.network.capacities;
        let taken = self.held.end(capacities, &mut self.temperatures, reached);
        add(&mut self.taken, &taken);
        self.most_of_all = self.most_of_all.max(taken.iter().sum::<f64>() / span);
        let mut powers = [0.0; NODES.len()];
        for ((power, most), taken) in powers.iter_mut().zip(&mut self.most).zip(taken) {
            *power = taken / span;
            *most = most.max(*power);
        }
        if keep {
            self.course.push((time, powers));
        }
    }
}

/// What a run shows at an instant.
pub struct HeatInstant {
    /// s.
    pub time: f64,
    /// Heats of the ledger so far, J.
    pub heats: [f64; HEATS],
    /// Spin of the inner race, rad/s.
    pub spin: f64,
    /// D of the lubricant, by which M0 differs from its law.
    pub drag_factor: f64,
    /// Friction heat that rotor and race have taken so far, and ∫N dt of the force under which they slid, N s, where that is followed, J.
    pub taken: Option<([f64; 2], f64)>,
    /// ∫N dt of the force of the rotor on the race so far, N s; none where it is the weight.
    pub impulse: Option<f64>,
    /// Heat that warm contact films keep, J; none where there are no such films.
    pub films: Option<f64>,
}

/// Shares of every heat of the ledger: of balls and a cage of these materials, which is guided by the land of a node; a node takes what the
/// mount makes.
///
/// Source: derived; book/src/theory/heat.md.
/// Valid: races, rotor and sleeve of steel.
pub fn shares(
    ball: ThermalMaterial,
    cage: ThermalMaterial,
    land: usize,
    mount: usize,
) -> [OfNodes; HEATS] {
    let between = |(one, first): (usize, ThermalMaterial),
                   (other, second): (usize, ThermalMaterial)| {
        let [a, b] = [first, second].map(|material| material.effusivity());
        let share = a / (a + b);
        of(&[(one, share), (other, 1.0 - share)])
    };
    let steel = |node: usize| (node, STEEL_HEAT);
    let mut list = [[0.0; NODES.len()]; HEATS];
    for (row, kind) in list.iter_mut().zip(kinds()) {
        *row = match kind {
            "inner_contact_damping" | "inner_ball_slip" => {
                between((BALLS, ball), steel(INNER_RACE))
            }
            "outer_contact_damping" | "outer_ball_slip" => {
                between((BALLS, ball), steel(OUTER_RACE))
            }
            "pocket_damping" | "pocket_friction" => between((BALLS, ball), (CAGE, cage)),
            "cage_land_damping" | "cage_land_friction" => between((CAGE, cage), steel(land)),
            "ball_ball_damping" | "ball_ball_friction" => of(&[(BALLS, 1.0)]),
            "mount_damping" => of(&[(mount, 1.0)]),
            "rotor_race_damping" | "rotor_race_friction" => of(&[(ROTOR, 0.5), (INNER_RACE, 0.5)]),
            // drag, inlet_rolling, steady_moment as far as it is viscous
            _ => of(&[(LUBRICANT, 1.0)]),
        };
    }
    list
}

/// Shares of the heat of sliding at both races, half at each, over the nodes: in each contact by the effusivity of ball and steel race.
///
/// Source: derived; book/src/theory/heat.md.
pub fn sliding(ball: ThermalMaterial) -> OfNodes {
    let [race, ball] = [STEEL_HEAT, ball].map(|material| material.effusivity());
    let to_race = race / (race + ball);
    of(&[
        (INNER_RACE, 0.5 * to_race),
        (BALLS, 1.0 - to_race),
        (OUTER_RACE, 0.5 * to_race),
    ])
}

/// Lets the heats of a span that shear the films reach balls and races, but for what the films keep of them, J: each kind keeps as much as its part
/// of all such heat until then. Of the span and of the run so far, J; the balls are of a metal.
fn through_films(
    flows: &mut [OfNodes; HEATS],
    [span, so_far]: [&[f64; HEATS]; 2],
    kept: f64,
    ball: ThermalMaterial,
) {
    let shears: Vec<bool> = kinds().map(|kind| FILM_KINDS.contains(&kind)).collect();
    let sheared = |k: &usize| shears[*k];
    let all: f64 = (0..HEATS).filter(sheared).map(|k| so_far[k]).sum();
    for k in (0..HEATS).filter(sheared) {
        let own = if all > 0.0 { so_far[k] / all } else { 0.0 };
        flows[k] = sliding(ball).map(|share| share * (span[k] - own * kept));
    }
}

/// What reaches each node, of all kinds.
fn sums(flows: &[OfNodes; HEATS]) -> OfNodes {
    let mut nodes = [0.0; NODES.len()];
    for flow in flows {
        add(&mut nodes, flow);
    }
    nodes
}

fn add(nodes: &mut OfNodes, more: &[f64]) {
    for (node, more) in nodes.iter_mut().zip(more) {
        *node += more;
    }
}

/// The kinds of heat in the order of the ledger: their names as in results.
pub fn kinds() -> impl Iterator<Item = &'static str> {
    bearing::HEATS.into_iter().chain(OWN_HEATS)
}

fn of(parts: &[(usize, f64)]) -> OfNodes {
    let mut row = [0.0; NODES.len()];
    for (node, share) in parts {
        row[*node] += share;
    }
    row
}

/// The heat of the steady moment among those of an auxiliary bearing.
pub fn steady_moment(heats: &[f64; HEATS]) -> f64 {
    heats[place("steady_moment")]
}

/// Place of a heat among those of an auxiliary bearing.
fn place(kind: &str) -> usize {
    kinds().position(|known| known == kind).unwrap_or(HEATS)
}

impl WarmBearing {
    /// Power of M0 at a spin of the inner race (rad/s) and a temperature of the lubricant (°C), W; none without its law.
    ///
    /// It does not depend on the load, so that what the steady moment makes beyond it is that of M1 under whatever loads there were.
    fn viscous(&self, spin: f64, temperature: f64, drag_factor: f64) -> Option<f64> {
        let losses = self.losses.as_ref()?;
        let moment = Palmgren {
            viscosity: losses.oil.held(temperature + ICE_POINT),
            ..losses.moment
        };
        let spin = spin.abs();
        Some(drag_factor * moment.parts(spin, 0.0).speed_dependent * spin)
    }

    /// Load of each ball under a force, N, at the clearance that these temperatures (°C) leave, where it follows them, and a speed of the
    /// inner race, rad/s: N.
    fn loads_at(&self, force: f64, temperatures: &[f64], speed: f64) -> Vec<f64> {
        let start = [self.start; NODES.len()];
        let load = self.losses.as_ref().map(|losses| &losses.load);
        let temperatures = match load {
            Some(BearingLoad::Zone { .. }) => temperatures,
            _ => &start,
        };
        (self.zone).loads_under(force, self.zone.clearance_at(temperatures, speed))
    }

    /// What its conductances follow at a spin of the inner race (rad/s), the rotor on it, temperatures of the nodes (°C) and loads of the balls (N).
    fn operation<'a>(
        &self,
        (speed, landing): (f64, Landing),
        nodes: &'a [f64],
        loads: &'a [f64],
    ) -> Operation<'a> {
        Operation {
            speed,
            landing,
            loads,
            viscosity: self.viscosity_at(nodes[LUBRICANT]),
            temperatures: nodes,
        }
    }

    /// Viscosity of the lubricant at a temperature in °C, m²/s.
    pub fn viscosity_at(&self, temperature: f64) -> f64 {
        (self.oil.as_ref()).map_or(self.viscosity, |oil| oil.held(temperature + ICE_POINT))
    }

    /// Takes note of a temperature of its lubricant, °C, at a time, s.
    fn look(&self, found: &mut Option<BeyondData>, temperature: f64, time: f64) {
        if let Some(oil) = &self.oil {
            oil_range::look(found, oil, temperature, time);
        }
    }

    /// Mean heats, W, over the nodes, at a spin of the inner race (rad/s) and a temperature of the lubricant (°C); of the friction of rotor and
    /// race the rotor takes so much more than the race.
    pub fn over_nodes(
        &self,
        heats: &[f64; HEATS],
        spin: f64,
        (lubricant, drag_factor): (f64, f64),
        uneven: f64,
    ) -> OfNodes {
        let viscous = self.viscous(spin, lubricant, drag_factor);
        sums(&self.flows(heats, viscous, uneven))
    }

    /// Heats of a span, each over the nodes, J; so much of the steady moment's is viscous, J: all of it where there is no law.
    /// Of the friction of rotor and race the rotor takes so much more than the race, J.
    fn flows(&self, heats: &[f64; HEATS], viscous: Option<f64>, uneven: f64) -> [OfNodes; HEATS] {
        let (steady, friction) = (place("steady_moment"), place("rotor_race_friction"));
        let viscous = match viscous {
            Some(viscous) if viscous < heats[steady] => viscous / heats[steady],
            _ => 1.0,
        };
        let mut flows = [[0.0; NODES.len()]; HEATS];
        for (k, heat) in heats.iter().enumerate() {
            let mut shares = self.shares[k];
            if k == steady {
                shares = sliding(self.network.ball).map(|share| share * (1.0 - viscous));
                shares[LUBRICANT] = viscous;
            }
            flows[k] = shares.map(|share| share * heat);
            if k == friction {
                flows[k][ROTOR] += 0.5 * uneven;
                flows[k][INNER_RACE] -= 0.5 * uneven;
            }
        }
        flows
    }

    /// Heat that each node holds above the start, J.
    pub fn stored(&self, temperatures: &[f64]) -> OfNodes {
        let capacities = self.network.capacities;
        std::array::from_fn(|node| capacities[node] * (temperatures[node] - self.start))
    }
}

impl Warmth {
    /// The same with no course but what is known last, from which on it is kept.
    pub(crate) fn going_on(&self) -> Self {
        let mut row = [0.0; NODES.len()];
        row.copy_from_slice(&self.temperatures);
        Warmth {
            course: vec![(self.until, row)],
            keep: true,
            ..self.clone()
        }
    }
    /// At the start of a run; `keep` says whether its course is kept.
    pub fn new(part: &WarmBearing, keep: bool) -> Self {
        let mut beyond_data = None;
        part.look(&mut beyond_data, part.start, 0.0);
        Warmth {
            temperatures: vec![part.start; NODES.len()],
            peaks: [(part.start, 0.0); NODES.len()],
            passed: [None; NODES.len()],
            growth: Growth::default(),
            held: None,
            made: 0.0,
            in_films: 0.0,
            given: 0.0,
            flows: [[0.0; NODES.len()]; HEATS],
            given_from: [0.0; NODES.len()],
            passes: part
                .network
                .passes(
                    Landing::rolls(part.zone.load),
                    0.0,
                    &[part.start; NODES.len()],
                )
                .map(|one| [one; 2]),
            loose: [None; 2],
            beyond_data,
            course: Vec::new(),
            keep,
            until: 0.0,
            heats: [0.0; HEATS],
            spin: None,
            taken: [0.0; 2],
            slid: 0.0,
            impulse: 0.0,
        }
    }

    /// Of a run that carries on with temperatures of the nodes, °C, from a time, s, and heats of the ledger until then, J; its surfaces are as hot as they were.
    pub fn carried_on(
        part: &WarmBearing,
        temperatures: &[f64],
        (time, heats): (f64, [f64; HEATS]),
        surfaces: Option<&SurfaceHeat>,
    ) -> Self {
        Warmth {
            temperatures: temperatures.to_vec(),
            until: time,
            heats,
            taken: surfaces.map_or([0.0; 2], SurfaceHeat::taken),
            slid: surfaces.map_or(0.0, |heat| heat.slid.impulse),
            ..Warmth::new(part, false)
        }
    }

    /// Speed of the inner race when its temperatures became known, rad/s.
    pub fn spin(&self) -> f64 {
        self.spin.unwrap_or(0.0)
    }

    /// Until when its temperatures are known, s.
    pub fn known_until(&self) -> f64 {
        self.until
    }

    /// Whether a span is over.
    pub fn is_due(&self, time: f64) -> bool {
        time >= self.until + SPAN
    }

    /// Lets the network take the heat since the last span.
    pub fn take(&mut self, part: &WarmBearing, seen: &HeatInstant) {
        let span = seen.time - self.until;
        if span <= 0.0 {
            return;
        }
        let mut heats = seen.heats;
        for (heat, before) in heats.iter_mut().zip(self.heats) {
            *heat -= before;
        }
        let (taken, slid) = seen.taken.unwrap_or((self.taken, self.slid));
        let uneven = (taken[0] - self.taken[0]) - (taken[1] - self.taken[1]);
        let lubricant = self.temperatures[LUBRICANT];
        let power = |spin| part.viscous(spin, lubricant, seen.drag_factor);
        let mean = |(first, last)| 0.5 * (first + last);
        let viscous = power(self.spin.unwrap_or(seen.spin))
            .zip(power(seen.spin))
            .map(mean);
        let mut flows = part.flows(&heats, viscous.map(|power| power * span), uneven);
        if let Some(films) = seen.films {
            let kept = films - self.in_films;
            through_films(&mut flows, [&heats, &seen.heats], kept, part.network.ball);
        }
        let nodes = sums(&flows);
        let mean = |impulse: f64| (impulse - self.impulse) / span;
        let force = seen.impulse.map_or(part.zone.load, mean);
        let pushed = seen.impulse.map_or(0.0, |impulse| impulse - self.impulse);
        let landing = Landing {
            force,
            slides: match pushed > 0.0 {
                true => ((slid - self.slid) / pushed).clamp(0.0, 1.0),
                false => 0.0,
            },
            conductance: 0.0,
        };
        let loads = part.loads_at(force, &self.temperatures, seen.spin);
        let operation = part.operation((seen.spin, landing), &self.temperatures, &loads);
        // a state that is none ends the run elsewhere
        let Ok(network) = part.network.at(operation) else {
            return;
        };
        let passes = part.network.passes(landing, seen.spin, &self.temperatures);
        for ([least, most], now) in self.passes.iter_mut().zip(passes) {
            (*least, *most) = (least.min(now), most.max(now));
        }
        let loose = part.network.loose(seen.spin, &self.temperatures);
        for (when, loose) in self.loose.iter_mut().zip(loose) {
            *when = when.or(loose.then_some(self.until));
        }
        let powers: Vec<f64> = nodes.iter().map(|heat| heat / span).collect();
        let (at, keep) = ((seen.time, span), self.keep);
        if let Some(other) = &mut self.held {
            let Ok(network) = together(&[(&part.network, operation)], other.held.marks()) else {
                return;
            };
            let away = network.advance(&mut other.temperatures, &powers, span);
            other.end(part, &network.by_node(&away), at, keep);
        }
        let before = self.temperatures.clone();
        let given = network.advance(&mut self.temperatures, &powers, span);
        self.given += given.iter().sum::<f64>();
        self.made += heats.iter().sum::<f64>();
        self.in_films = seen.films.unwrap_or(0.0);
        for (so_far, flow) in self.flows.iter_mut().zip(&flows) {
            add(so_far, flow);
        }
        add(&mut self.given_from, &network.by_node(&given));
        for (node, limit) in part.limits.iter().enumerate() {
            let (was, now) = (before[node], self.temperatures[node]);
            let passes = limit.filter(|limit| self.passed[node].is_none() && now > *limit);
            self.passed[node] = self.passed[node]
                .or_else(|| Some(self.until + span * (passes? - was) / (now - was)));
        }
        if self.held.is_none() && self.passed.iter().any(Option::is_some) {
            let mut other = Box::new(HeldWarmth {
                held: Held::at(part.limits.to_vec()),
                temperatures: self.temperatures.clone(),
                taken: [0.0; NODES.len()],
                most: [0.0; NODES.len()],
                most_of_all: 0.0,
                course: Vec::new(),
            });
            other.end(part, &[0.0; NODES.len()], at, keep);
            self.held = Some(other);
        }
        self.until = seen.time;
        self.heats = seen.heats;
        self.spin = Some(seen.spin);
        (self.taken, self.slid) = (taken, slid);
        self.impulse = seen.impulse.unwrap_or(self.impulse);
        let mut row = [0.0; NODES.len()];
        for (node, (now, peak)) in self.temperatures.iter().zip(&mut self.peaks).enumerate() {
            row[node] = *now;
            if *now > peak.0 {
                *peak = (*now, seen.time);
            }
        }
        part.look(&mut self.beyond_data, row[LUBRICANT], seen.time);
        if self.keep {
            self.course.push((seen.time, row));
        }
        let grows = || {
            let losses = part.losses.clone()?;
            let (open, _) = losses.closing(seen.spin, &row)?;
            if open >= 0.0 {
                return None;
            }
            let loads = part.loads_at(force, &row, seen.spin);
            let operation = part.operation((seen.spin, landing), &row, &loads);
            let machine = SteadySpeed {
                network: part.network.at(operation).ok()?,
                losses,
                speed: seen.spin.abs(),
                tolerance: 1.0,
            };
            let passes = |moved: &[f64]| {
                let loads = part.loads_at(force, moved, seen.spin);
                let operation = part.operation((seen.spin, landing), moved, &loads);
                relaxing(&[(&part.network, operation)], &row)
            };
            Some(machine.growth_of(&row, &passes))
        };
        self.growth.look(grows, (seen.time, row), self.keep);
    }

    /// Temperature of a node at an instant, °C: between the ends of spans along a straight line.
    pub fn at(&self, part: &WarmBearing, node: usize, time: f64) -> f64 {
        let next = self.course.partition_point(|(end, _)| *end < time);
        let (from, before) = match next.checked_sub(1) {
            Some(last) => (self.course[last].0, self.course[last].1[node]),
            None => (0.0, part.start),
        };
        match self.course.get(next) {
            Some((to, row)) if *to > from => {
                before + (row[node] - before) * (time - from) / (to - from)
            }
            _ => before,
        }
    }
}

#[cfg(test)]
mod tests;
