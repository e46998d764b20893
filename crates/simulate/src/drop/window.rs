//! One window ball by ball: the rotor at a speed that is held, oil, clearance and friction as warm as the run-out has made them.
//!
//! ```text
//!   settle     60 turns, and on while the races still come to their speed
//!   batches    8 of 10 turns: mean powers, their scatter, the largest forces, the loads of the balls
//! ```
//!
//! Source: derived; book/src/theory/heat.md.

use crate::bearing::feedback::Follows;
use crate::coast_down::build::{Built, ICE_POINT, Part};
use crate::coast_down::rows::BallsSeen;
use crate::drop::Drop;
use crate::drop::build;
use crate::drop::context::Context;
use crate::drop::ensemble::{self, Finished, Member, Plan};
use crate::drop::feedback::{AirClearance, friction};
use crate::drop::method;
use crate::ending::settings_at;
use model::auxiliary_bearing::{AuxiliaryBearingConstants, HEATS};
use model::bearing_heat::OfNodes;
use model::surface_heat::Slid;
use model::system::machine::RotorMachine;
use model::system::machine::record::BearingRecord;
use std::f64::consts::TAU;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use thermal::bearing_network::{INNER_RACE, LUBRICANT, Landing, NODES, ROTOR};
use thermal::warm_machine::{Followed, InMotion};

/// Turns of the rotor in which a window settles, and in each of its batches; and the longest that either takes, s.
pub(super) const SETTLING: (f64, f64) = (60.0, 1.0);
pub(super) const BATCH: (f64, f64) = (10.0, 0.2);
/// Batches of a window: neighbours correlate, so that fewer say little of the scatter.
pub(super) const BATCHES: usize = 8;

/// Change of the speed of an inner race over the rotor's while a window settles, beyond what it had been there, from which on it settles on; and
/// how long at most, s.
const SPINS_UP: f64 = 0.01;
const LONGEST_WAIT: f64 = 60.0;
/// The same of a race that only sways, as under a rotor that swings: it has not come to another speed.
const SWAYS: f64 = 0.05;

/// What a window found at its speed.
pub(super) struct Window {
    /// What its powers say beside the laws.
    pub followed: Followed,
    /// Heat of what brakes beside the laws, over the nodes of all bearings, W.
    pub beside: Vec<f64>,
    /// Of the friction of rotor and race of each bearing in it, W, and what of a force it takes there, N.
    pub friction: Vec<f64>,
    pub rubbing: Vec<f64>,
    /// Turns of the rotor about each inner race, with its spin, and about itself.
    pub whirl: Vec<f64>,
    pub turns: f64,
    /// What it saw.
    pub seen: Seen,
    /// Largest contact force of each bearing while it settled, N.
    pub settled: Vec<f64>,
    /// Of the balls of each bearing.
    pub balls: Vec<Option<Arc<BallsSeen>>>,
    /// Standard error of the whole power over it.
    pub scatter: f64,
}

/// What a batch or a window sees at its speed.
#[derive(Default)]
pub(super) struct Seen {
    /// Mean power of the losses: of each bearing its steady moment and its other losses, then of the rotor, W.
    pub powers: Vec<f64>,
    /// Largest contact force of each bearing, N.
    pub peaks: Vec<f64>,
    /// Largest rise of the patch of rotor and race above the start of the drop, K; of surfaces that are as warm as the hotter body when a batch begins.
    pub rises: Vec<f64>,
    /// Way of the rotor's centre in each of its races over its turns, m.
    pub ways: Vec<f64>,
}

/// Least and largest speed of each inner race while a window settles, rad/s.
struct Spins(Vec<[f64; 2]>);

impl Spins {
    /// Whether one of them moves beyond these by more than a speed.
    fn move_on(&mut self, races: &[f64], by: f64) -> bool {
        let mut moves = false;
        for ([least, most], spin) in self.0.iter_mut().zip(races) {
            moves |= *spin < *least - by || *spin > *most + by;
            (*least, *most) = (spin.min(*least), spin.max(*most));
        }
        moves
    }
}

/// What one batch of a window finds.
struct Batch {
    powers: Vec<f64>,
    nodes: Vec<f64>,
    friction: Vec<f64>,
    peaks: Vec<f64>,
    rises: Vec<f64>,
    balls: Vec<Option<BallsSeen>>,
    drag_factors: Vec<f64>,
    /// Of the inner races, rad/s.
    spins: Vec<f64>,
    /// The rotor in them: mean force, N, share under which it slides, and conductance of the patch, W/K.
    landings: Vec<f64>,
    rotor: f64,
    /// Turns of the rotor about each inner race, with its spin.
    whirl: Vec<f64>,
    /// Way of its centre there over its turns, m.
    ways: Vec<f64>,
}

/// The last motion that was followed ball by ball.
#[derive(Clone)]
pub(super) struct Last {
    machine: Arc<RotorMachine>,
    state: Vec<f64>,
    time: f64,
}

impl Last {
    /// Kinetic energy of a side, J.
    pub fn kinetic(&self) -> f64 {
        let content = self.machine.content(&self.state);
        content.translation + content.spin
    }

    /// That in which the drop ended.
    pub fn of(context: &Context) -> Self {
        let ending = &context.finished.ending;
        Last {
            machine: Arc::new(context.setup.machine.clone()),
            state: ending.state.clone(),
            time: ending.time,
        }
    }
}

/// A rotor on its way down.
pub(super) struct Way<'a> {
    context: &'a Context<'a>,
    pub interrupt: &'a AtomicBool,
    /// Where it is.
    pub last: &'a mut Last,
    /// Steps taken.
    pub steps: u64,
    /// How long the last window waited for races to come to their speed, s.
    pub waited: f64,
    /// Largest load of a ball of each bearing at both races since the last window, N.
    largest: Vec<[f64; 2]>,
}

impl<'a> Way<'a> {
    /// From the last motion.
    pub fn from(context: &'a Context<'a>, last: &'a mut Last, interrupt: &'a AtomicBool) -> Self {
        Way {
            context,
            interrupt,
            last,
            steps: 0,
            waited: 0.0,
            largest: Vec::new(),
        }
    }

    /// Means at the speed and the temperatures that the run-out has come to.
    pub fn window(&mut self, built: &Built) -> Result<Window, &'static str> {
        let mut plan = self.condition(built)?;
        let speed = built.start.speed;
        let before = self.races();
        let mut spins = Spins(before.iter().map(|spin| [*spin; 2]).collect());
        self.waited = 0.0;
        let mut settled = Vec::new();
        loop {
            settled.push(self.batch(built, &mut plan, SETTLING)?);
            let span = plan.settings.end - plan.settings.start;
            if !spins.move_on(&self.races(), SPINS_UP * speed) || self.waited >= LONGEST_WAIT {
                break;
            }
            self.waited += span;
        }
        let mut moved = self.races().into_iter().zip(&before);
        if moved.all(|(now, before)| (now - before).abs() < SWAYS * speed) {
            self.waited = 0.0;
        }
        let pieces: Result<Vec<Batch>, _> = (0..BATCHES)
            .map(|_| self.batch(built, &mut plan, BATCH))
            .collect();
        let constants = &self.last.machine.constants.bearings;
        let largest = std::mem::take(&mut self.largest);
        Ok(mean(built, constants, (&settled, &largest), &pieces?))
    }

    /// The machine at the speed and the temperatures that the run-out has come to, in the motion it had, and how it is computed.
    fn condition(&mut self, built: &Built) -> Result<Plan<'a>, &'static str> {
        let speed = built.start.speed;
        let made = build::built(conditioned(self.context.setup.drop(), built))
            .map_err(|_| "no machine could be built at these temperatures")?;
        let mut constants = made.constants.clone();
        constants.rotor.spin_held = true;
        for bearing in &mut constants.bearings {
            bearing.warm = None;
        }
        let machine = Arc::new(RotorMachine::new(constants));
        let stepping = method::stepping(&made, machine.tangents());
        let layout = machine.layout();
        let state = &mut self.last.state;
        let spin = layout.rotor.spin();
        // a rotor that jumps in its races would slip there, and may be thrown out of its motion
        let factor = speed / state[spin].abs();
        state[spin] *= factor;
        for (at, part) in layout.bearings.iter().zip(&machine.constants.bearings) {
            state[at.inner.spin()] *= factor;
            (part.bearing).change_speeds(&mut state[at.own()], factor);
        }
        self.last.machine = machine;
        Ok(Plan {
            settings: settings_at(&made.drop.run, stepping.tolerance),
            steps: stepping.steps,
            interval: f64::INFINITY,
            until_rolling: false,
            interrupt: self.interrupt,
            progress: &|_| {},
        })
    }

    /// Speeds of the inner races, rad/s.
    fn races(&self) -> Vec<f64> {
        let each = self.last.machine.layout().bearings.iter();
        each.map(|at| self.last.state[at.inner.spin()].abs())
            .collect()
    }

    /// The motion goes on for so many turns, or so many seconds if these are less; how long that is, s, and what was seen.
    fn piece(
        &mut self,
        plan: &mut Plan,
        speed: f64,
        (turns, longest): (f64, f64),
    ) -> Result<(f64, Finished), &'static str> {
        let time = self.last.time;
        plan.settings.start = time;
        plan.settings.end = time + (turns * TAU / speed).min(longest);
        let machine = &self.last.machine;
        self.last.state[machine.layout().ledger()..].fill(0.0);
        let member = Member {
            machine: machine.clone(),
            following: None,
            start: self.last.state.clone(),
            keep_rows: false,
        };
        let finished = ensemble::one(&member, plan);
        self.steps += finished.ending.work.accepted;
        whole(&finished)?;
        self.last.state.clone_from(&finished.ending.state);
        self.last.time = finished.ending.time;
        Ok((self.last.time - time, finished))
    }

    /// What one batch finds.
    fn batch(
        &mut self,
        built: &Built,
        plan: &mut Plan,
        turns: (f64, f64),
    ) -> Result<Batch, &'static str> {
        let (span, finished) = self.piece(plan, built.start.speed, turns)?;
        let state = &self.last.state;
        let spin = self.last.machine.layout().rotor.spin();
        let bearings = &finished.record.bearings;
        let balls: Vec<_> = bearings.iter().map(balls).collect();
        self.largest.resize(balls.len(), [0.0; 2]);
        for (most, seen) in self.largest.iter_mut().zip(&balls) {
            let loads = seen.as_ref().map_or([0.0; 2], |seen| seen.largest);
            *most = [0, 1].map(|side: usize| most[side].max(loads[side]));
        }
        Ok(Batch {
            peaks: peaks(&finished),
            rises: (bearings.iter())
                .map(|record| record.heat.as_ref().map_or(0.0, |heat| heat.contact.value))
                .collect(),
            whirl: (bearings.iter())
                .map(|record| record.whirl_turns * state[spin].signum())
                .collect(),
            balls,
            landings: (bearings.iter())
                .zip(&built.parts)
                .flat_map(|(record, part)| landing(record, part, span))
                .collect(),
            ways: (bearings.iter())
                .map(|record| TAU * record.travel.way / record.travel.turned)
                .collect(),
            ..self.heats(built, state, span, bearings)
        })
    }

    /// What so many turns at the speed and the temperatures of a run-out see, or so many seconds if these are less.
    pub fn glance(&mut self, built: &Built, turns: (f64, f64)) -> Result<Seen, &'static str> {
        let mut plan = self.condition(built)?;
        let batch = self.batch(built, &mut plan, turns)?;
        Ok(Seen {
            rises: rises(built, &batch.rises),
            peaks: batch.peaks,
            powers: batch.powers,
            ways: batch.ways,
        })
    }

    /// Powers of the losses and of the nodes over a span, from the ledger that began with it, W.
    fn heats(&self, built: &Built, state: &[f64], span: f64, records: &[BearingRecord]) -> Batch {
        let layout = self.last.machine.layout();
        let (mut powers, mut nodes, mut friction) = (Vec::new(), Vec::new(), Vec::new());
        let (mut drag_factors, mut spins) = (Vec::new(), Vec::new());
        for (k, at) in layout.bearings.iter().enumerate() {
            let heats: [f64; HEATS] =
                std::array::from_fn(|kind| state[layout.heat(at.heat + kind)] / span);
            let steady = model::bearing_heat::steady_moment(&heats);
            powers.extend([steady, heats.iter().sum::<f64>() - steady]);
            friction.push(state[layout.heat(at.rotor_race_friction())] / span);
            let part = &self.context.setup.machine.constants.bearings[k];
            let drag_factor = (part.bearing).drag_factor(&|own| state[at.own().start + own]);
            drag_factors.push(drag_factor);
            spins.push(state[at.inner.spin()].abs());
            let of_nodes: OfNodes = match &part.warm {
                Some(warm) => {
                    let lubricant = built.start.temperatures[k * NODES.len() + LUBRICANT];
                    let oil = (lubricant, drag_factor);
                    let slid = records[k]
                        .heat
                        .as_ref()
                        .map_or(0.0, |heat| heat.slid.uneven);
                    warm.over_nodes(&heats, state[at.inner.spin()], oil, slid / span)
                }
                None => [0.0; NODES.len()],
            };
            nodes.extend(of_nodes);
        }
        let own = layout.of_rotor;
        let others = [own.damping, own.damping_rotating, own.seal_damping];
        let others: f64 = (others.into_iter().flatten())
            .map(|heat| state[layout.heat(heat)] / span)
            .sum();
        let speed = built.start.speed;
        let mut rotor = built.rotor;
        if built.start.time < built.brake_start {
            rotor.torque = 0.0;
        }
        powers.push(others + speed * rotor.moment(speed) / f64::from(built.sides));
        Batch {
            powers,
            nodes,
            friction,
            peaks: Vec::new(),
            rises: Vec::new(),
            balls: Vec::new(),
            landings: Vec::new(),
            whirl: Vec::new(),
            ways: Vec::new(),
            drag_factors,
            spins,
            rotor: others,
        }
    }
}

/// What the mean powers of a window say beside the laws at its speed and temperatures, and what heats the nodes besides, W: of powers as
/// in [`Window`], the heats over all nodes, the factors of the lubricants on M0, the speeds of the inner races, rad/s, the rotor in them as in [`Batch`], and what brakes the rotor besides its drag, W.
fn beside_laws(
    built: &Built,
    powers: &[f64],
    nodes: &[f64],
    [drag_factors, spins, landings]: [&[f64]; 3],
    rotor: f64,
) -> (Followed, Vec<f64>) {
    let start = &built.start;
    let sides = f64::from(built.sides);
    let mut beside = nodes.to_vec();
    let mut bearings = Vec::new();
    for (k, part) in built.parts.iter().enumerate() {
        let of_nodes = k * NODES.len()..(k + 1) * NODES.len();
        let laws = part
            .losses
            .on_rotor(start.speed, &start.temperatures[of_nodes.clone()]);
        let laws = laws.map(|moment| moment * start.speed / sides);
        let [steady, other] = [powers[2 * k], powers[2 * k + 1]];
        // balls that bounce lag a little behind rolling: that is not M1's, which a preload makes grow
        let second = steady.min(laws[1]);
        let first = (steady - second).min(drag_factors[k] * laws[0]);
        for (loss, taken) in [first, second].into_iter().enumerate() {
            for (own, heat) in beside[of_nodes.clone()].iter_mut().enumerate() {
                *heat -= taken * part.losses.shares[loss][own];
            }
        }
        beside[of_nodes]
            .iter_mut()
            .for_each(|heat| *heat = heat.max(0.0));
        let factor = |taken: f64, law: f64| if law > 0.0 { taken / law } else { 0.0 };
        bearings.push(InMotion {
            factors: [factor(first, laws[0]), factor(second, laws[1])],
            beside: sides * (steady - first - second + other) / start.speed,
            spin: spins[k] / (part.losses.ratio * start.speed),
            landing: Landing {
                force: landings[3 * k],
                slides: landings[3 * k + 1],
                conductance: landings[3 * k + 2],
            },
        });
    }
    let followed = Followed {
        speed: start.speed,
        bearings,
        rotor: sides * rotor / start.speed,
    };
    (followed, beside)
}

/// The rotor in a bearing over a span, s: mean force, N, share under which it slides, conductance of the patch, W/K.
fn landing(record: &BearingRecord, part: &Part, span: f64) -> [f64; 3] {
    let slid = (record.heat.as_ref()).map_or(Slid::default(), |heat| heat.slid);
    let slides = match record.impulse > 0.0 {
        true => (slid.impulse / record.impulse).min(1.0),
        false => 0.0,
    };
    let conducted = match part.network.landing.is_given() {
        true => 0.0,
        false => slid.conducted / span,
    };
    [record.impulse / span, slides, conducted]
}

/// Largest contact force of each bearing, N.
fn peaks(finished: &Finished) -> Vec<f64> {
    let bearings = finished.record.bearings.iter();
    let peak = bearings.map(|record| record.peak_contact_force());
    peak.map(|peak| peak.map_or(0.0, |peak| peak.value))
        .collect()
}

/// What a batch has seen of the balls of a bearing; none of a bushing, or where it did not turn.
fn balls(record: &BearingRecord) -> Option<BallsSeen> {
    let (races, turns) = (record.races.as_ref()?, record.turns);
    let loads = [record.largest_inner_load, record.largest_outer_load];
    (turns > 0.0).then(|| BallsSeen {
        largest: loads.map(|peak| peak.value),
        cubes: (races.races.each_ref())
            .map(|race| race.sums.iter().map(|sum| sum / turns).collect()),
    })
}

/// The batches of a window together, with the largest loads on the way to it.
fn all_balls(batches: &[Batch], bearing: usize, largest: [f64; 2]) -> Option<BallsSeen> {
    let mut each = batches.iter().map(|batch| batch.balls[bearing].as_ref());
    let mut all = each.next()??.clone();
    for other in each {
        let other = other?;
        for side in 0..2 {
            for (sum, cube) in all.cubes[side].iter_mut().zip(&other.cubes[side]) {
                *sum += cube;
            }
        }
    }
    let count = batches.len() as f64;
    let mean = |ring: Vec<f64>| ring.into_iter().map(|sum| sum / count).collect();
    Some(BallsSeen {
        cubes: all.cubes.map(mean),
        largest,
    })
}

/// Why a part of a window did not end as planned.
fn whole(finished: &Finished) -> Result<(), &'static str> {
    match finished.ending.stop {
        solve::Stop::Finished => Ok(()),
        solve::Stop::Interrupted => Err("it was interrupted"),
        solve::Stop::Halted(why) => Err(why),
        _ => Err("a window ball by ball did not end as planned"),
    }
}

/// Means of batches, and the standard error of their sum over it.
fn mean(
    built: &Built,
    constants: &[AuxiliaryBearingConstants],
    (settled, largest_loads): (&[Batch], &[[f64; 2]]),
    batches: &[Batch],
) -> Window {
    let count = batches.len() as f64;
    let of = |each: Vec<&Vec<f64>>| -> Vec<f64> {
        let length = each.first().map_or(0, |one| one.len());
        let mean = |k: usize| each.iter().map(|one| one[k]).sum::<f64>() / count;
        (0..length).map(mean).collect()
    };
    let powers = of(batches.iter().map(|batch| &batch.powers).collect());
    let whole: f64 = powers.iter().sum();
    let squares = batches.iter().map(|batch| {
        let apart = batch.powers.iter().sum::<f64>() - whole;
        apart * apart
    });
    let deviation = (squares.sum::<f64>() / (count - 1.0)).sqrt();
    let nodes = of(batches.iter().map(|batch| &batch.nodes).collect());
    let drag_factors = of(batches.iter().map(|batch| &batch.drag_factors).collect());
    let rotor = batches.iter().map(|batch| batch.rotor).sum::<f64>() / count;
    let spins = of(batches.iter().map(|batch| &batch.spins).collect());
    let landings = of(batches.iter().map(|batch| &batch.landings).collect());
    let of_bearings = [&drag_factors, &spins, &landings].map(Vec::as_slice);
    let (followed, beside) = beside_laws(built, &powers, &nodes, of_bearings, rotor);
    let whirl = of(batches.iter().map(|batch| &batch.whirl).collect());
    let largest = |of: fn(&Batch) -> &Vec<f64>| -> Vec<f64> {
        let of_bearing = |k: usize| batches.iter().map(|batch| of(batch)[k]).fold(0.0, f64::max);
        (0..of(&batches[0]).len()).map(of_bearing).collect()
    };
    Window {
        followed,
        beside,
        whirl: whirl.iter().map(|turns| count * turns).collect(),
        turns: count * BATCH.0.min(BATCH.1 * built.start.speed / TAU),
        friction: of(batches.iter().map(|batch| &batch.friction).collect()),
        rubbing: (built.parts.iter().zip(constants))
            .map(|(part, bearing)| bearing.contact.friction * part.warm.radial_load)
            .collect(),
        scatter: deviation / (count.sqrt() * whole),
        balls: (0..batches[0].balls.len())
            .map(|k| all_balls(batches, k, largest_loads[k]).map(Arc::new))
            .collect(),
        seen: Seen {
            peaks: largest(|batch| &batch.peaks),
            rises: rises(built, &largest(|batch| &batch.rises)),
            ways: largest(|batch| &batch.ways),
            powers,
        },
        settled: (0..constants.len())
            .map(|k| {
                settled
                    .iter()
                    .map(|batch| batch.peaks[k])
                    .fold(0.0, f64::max)
            })
            .collect(),
    }
}

/// Rises of patches above the start of the drop, K, from those above the hotter body.
fn rises(built: &Built, above: &[f64]) -> Vec<f64> {
    let nodes = built.start.temperatures.chunks(NODES.len());
    let each = above.iter().zip(nodes).zip(&built.parts);
    each.map(|((rise, nodes), part)| {
        let start = part.warm.heat.start_temperature - ICE_POINT;
        rise + nodes[ROTOR].max(nodes[INNER_RACE]) - start
    })
    .collect()
}

/// The drop with oil, clearance and friction as warm as the run-out has made them.
fn conditioned(drop: &Drop, built: &Built) -> Drop {
    let mut warm = drop.clone();
    warm.given.rotor.speed = built.start.speed * drop.rotor.speed.signum();
    let temperatures = built.start.temperatures.chunks(NODES.len());
    let bearings = warm.given.auxiliary_bearings.iter_mut().zip(&built.parts);
    for ((part, rolling), temperatures) in bearings.zip(temperatures) {
        part.contact.friction_coefficient = friction(part, temperatures);
        if let Some(air) = AirClearance::of(part) {
            part.contact.radial_air_clearance += air.gained(temperatures);
        }
        let (Some(heat), Some(bearing)) = (&part.warm, &mut part.bearing) else {
            continue;
        };
        if let Some(follows) = Follows::of(heat, bearing) {
            let race = rolling.losses.ratio * built.start.speed;
            follows.condition(bearing, temperatures, race);
        }
    }
    warm
}
