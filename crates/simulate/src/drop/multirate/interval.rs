//! A ball-by-ball interval of a coast-down: the machine at its present speed and temperatures, in the motion that it has.
//!
//! ```text
//!   conditioned     oil, clearance, air clearance, friction and brake as they are at this instant
//!   batch           the odd number of whole turns nearest to half a period of the pendulum motion √(g/c0) in the air clearance; g with its part
//!                     along the shaft, so that a vertical rotor has the time to fall through its clearance, or to slide over a face
//!   interval        BATCHES of them
//! ```
//! Nothing holds the spin: an interval is a piece of the real motion. Surface layers of rotor and race carry on from interval to interval. A motion that
//! repeats with every turn comes back to its place after a batch, one of half the speed or of the pendulum is on the other side then: the distance
//! between both places shows how a motion beside the unbalance's grows or decays, from any size.
//! Steps are those of screening accuracy, whose means lie within 1e-4 of those of design accuracy.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::coast_down::build::{CoastDownModel, ICE_POINT, Part};
use crate::coast_down::rows::BallsSeen;
use crate::drop::context::Context;
use crate::drop::multirate::batch::{Batch, Bearing, Interval};
use crate::drop::unbalances::loaded;
use crate::drop::{method, torque};
use crate::ending::settings_at;
use crate::following::{Following, Now, Warmed};
use model::auxiliary_bearing::HEATS;
use model::bearing_heat::{Warmth, steady_moment};
use model::schedule::Schedule;
use model::surface_heat::SurfaceHeat;
use model::system::machine::record::{BearingRecord, Record};
use model::system::machine::simulate::{Runs, Steps, simulate};
use model::system::machine::{AtSpeed, MOST_LOADED, MachineConstants, RotorMachine};
use model::system::sampling::Peak;
use number::Vec2;
use physics::life::of_rows;
use scenario::Accuracy;
use solve::{Machine, Observer, Settings};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use thermal::bearing_network::{INNER_RACE, LUBRICANT, Landing, NODES, ROTOR};

/// Batches of an interval. After a leap two of them settle; two halves of three tell a trend from scatter, and eight in a row growth.
pub(super) const BATCHES: usize = 8;
pub(super) const SETTLING: usize = 2;

/// Why an interval could not be followed.
pub(super) type Failure = &'static str;

/// The motion of a machine that coasts down, ball by ball.
#[derive(Clone)]
pub(super) struct Motion<'a> {
    context: &'a Context<'a>,
    interrupt: &'a AtomicBool,
    following: Option<Arc<Following>>,
    machine: Arc<RotorMachine>,
    settings: Settings,
    steps: Steps,
    state: Vec<f64>,
    surfaces: Vec<Option<Box<SurfaceHeat>>>,
    time: f64,
    /// Steps taken.
    pub taken: u64,
    /// Whether an unbalance or a load has come since this was asked.
    changed: bool,
    /// Which unbalances that come on the way the state has.
    unbalances: u16,
}

impl<'a> Motion<'a> {
    /// That in which the drop ended.
    pub fn after_drop(context: &'a Context<'a>, interrupt: &'a AtomicBool) -> Self {
        let ending = &context.finished.ending;
        let records = &context.finished.record.bearings;
        let mut coarse = context.setup.built.clone();
        coarse.drop.given.run.accuracy = Accuracy::Screening;
        let at_end = context.finished.at_end();
        let mut constants = MachineConstants {
            rotor: at_end.constants.rotor.clone(),
            ..context.setup.machine.constants.clone()
        };
        let spin = ending.state[context.setup.machine.layout().rotor.spin()].abs();
        (constants.schedule, constants.at_speeds) =
            torque::ahead(&constants, &context.reached, spin);
        happen(&mut constants, ending.time, spin);
        let stepping = method::stepping(&coarse, context.setup.machine.tangents());
        let machine = at_end.renewed(constants);
        Motion {
            context,
            interrupt,
            following: Following::of(context.setup.drop()).map(Arc::new),
            changed: machine.start_mode().loads != [Vec2::zero(); MOST_LOADED],
            unbalances: machine.start_mode().unbalances,
            machine: Arc::new(machine),
            settings: settings_at(&coarse.drop.run, stepping.tolerance),
            steps: stepping.steps,
            state: ending.state.clone(),
            surfaces: records.iter().map(|record| record.heat.clone()).collect(),
            time: ending.time,
            taken: 0,
        }
    }

    /// Constants of the machine that goes on.
    pub fn constants(&self) -> &MachineConstants {
        &self.machine.constants
    }

    /// Whether an unbalance or a load has come since this was asked last.
    pub fn changed(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }

    /// Loads that have come, N, at their nodes of the model.
    pub fn loads(&self) -> Vec<(usize, Vec2<f64>)> {
        let nodes = self
            .context
            .setup
            .drop()
            .shaft
            .iter()
            .flat_map(|own| loaded(own));
        nodes.zip(self.machine.start_mode().loads).collect()
    }

    /// The next speed at which an unbalance or a load comes, rad/s; 0 where none does.
    pub fn changes_below(&self) -> f64 {
        let waits = self.constants().at_speeds.iter();
        let waits = waits.filter(|own| own.then.iter().any(|(_, event)| torque::changes(event)));
        waits.map(|own| own.speed).fold(0.0, f64::max)
    }

    /// Goes on with these constants, in which events have come until now and down to a speed, rad/s.
    fn go_on(&mut self, mut constants: MachineConstants, speed: f64) {
        happen(&mut constants, self.time, speed);
        let before = self.machine.start_mode();
        let machine = self.machine.renewed(constants);
        let now = machine.start_mode();
        self.changed |= now.loads != before.loads;
        self.machine = Arc::new(match now.unbalances == before.unbalances {
            true => machine,
            false => {
                // one that came within a batch has moved the state already
                machine.unbalance([self.unbalances, now.unbalances], &mut self.state);
                self.changed = true;
                machine.unbalanced(now.unbalances)
            }
        });
        self.unbalances = now.unbalances;
    }

    /// Size of the rotor's spin, rad/s.
    pub fn speed(&self) -> f64 {
        self.state[self.machine.layout().rotor.spin()].abs()
    }

    /// Time of a batch at a speed, rad/s: s.
    pub fn span(&self, speed: f64) -> f64 {
        let half_a_period = PI / self.pendulum();
        let turns = speed * half_a_period / TAU;
        TAU / speed * (2.0 * (0.5 * (turns - 1.0)).round().max(0.0) + 1.0)
    }

    /// Frequency of the rotor that swings like a pendulum in the widest air clearance, rad/s; of a vertical one that of a fall as far.
    pub fn pendulum(&self) -> f64 {
        let bearings = self.context.setup.machine.constants.bearings.iter();
        let widest = bearings.map(|own| own.contact.radial_clearance);
        (self.gravity() / widest.fold(0.0, f64::max)).sqrt()
    }

    /// Acceleration of gravity across and along the shaft, m/s².
    pub fn gravity(&self) -> f64 {
        let gravity = &self.context.setup.drop().gravity;
        gravity.acceleration.hypot(gravity.axial)
    }

    /// One interval at the speed and the temperatures that the coast-down has reached; of what so many batches settle, no largest value is kept.
    pub fn interval(
        &mut self,
        built: &CoastDownModel,
        settling: usize,
    ) -> Result<Interval, Failure> {
        let mut record = self.condition(built)?;
        self.turn_at(built.start.speed);
        let span = self.span(built.start.speed);
        let (mut batches, mut changed) = (Vec::new(), None);
        for batch in 0..BATCHES {
            // a clearance that has moved at once strikes
            if batch == settling {
                forget(&mut record);
            }
            batches.push(self.batch(built, &mut record, span)?);
            if self.changed() {
                changed = Some(batch);
            }
        }
        Ok(Interval {
            changed,
            ..self.ended(batches, record)
        })
    }

    /// Comes down to a speed as it is, in so many equal jumps of its logarithm of a batch each: what was found there. Ends early where a force passes
    /// these limits, N.
    pub fn sweep(
        &mut self,
        built: &CoastDownModel,
        (jumps, to): (usize, f64),
        limits: &[f64],
    ) -> Result<Interval, Failure> {
        let from = self.speed();
        let mut record = self.record(built);
        let ratio = (to / from).powf(1.0 / jumps as f64);
        let mut batches = Vec::new();
        for jump in 1..=jumps {
            let speed = from * ratio.powi(jump as i32);
            self.turn_at(speed);
            let batch = self.batch(built, &mut record, self.span(speed))?;
            let mut forces = batch.bearings.iter().zip(limits);
            let harder = forces.any(|(bearing, limit)| bearing.peak_force > *limit);
            batches.push(batch);
            if harder {
                break;
            }
        }
        Ok(self.ended(batches, record))
    }

    /// The machine at the speed and the temperatures of a coast-down, and a record of what follows.
    fn condition(&mut self, built: &CoastDownModel) -> Result<Record, Failure> {
        let start = &built.start;
        let mut constants = match self.warm(built)? {
            Some(machine) => machine.constants.clone(),
            None => self.machine.constants.clone(),
        };
        constants.speed = start.speed * constants.speed.signum();
        let own = &self.machine.constants;
        constants.rotor = own.rotor.clone();
        (constants.schedule, constants.at_speeds) = (own.schedule.clone(), own.at_speeds.clone());
        let leap = start.time - self.time;
        for heat in self.surfaces.iter_mut().flatten() {
            heat.leap(leap);
        }
        self.time = start.time;
        self.go_on(constants, start.speed);
        Ok(self.record(built))
    }

    /// A record of what follows, with surfaces as hot as they are.
    fn record(&mut self, built: &CoastDownModel) -> Record {
        let machine = &self.machine;
        let mut record = Record::new(machine, f64::INFINITY, f64::INFINITY, false);
        let layout = machine.layout();
        for (k, own) in record.bearings.iter_mut().enumerate() {
            let mut surfaces = self.surfaces[k].take();
            if let Some(heat) = &mut surfaces {
                heat.contact = Peak::NONE;
            }
            own.warmth = (machine.constants.bearings[k].warm.as_ref()).map(|warm| {
                let at = layout.bearings[k];
                let heats = std::array::from_fn(|kind| self.state[layout.heat(at.heat + kind)]);
                let nodes = &built.start.temperatures[k * NODES.len()..][..NODES.len()];
                let now = (self.time, heats);
                Box::new(Warmth::carried_on(warm, nodes, now, surfaces.as_deref()))
            });
            own.heat = surfaces;
        }
        record
    }

    /// The machine with oil, clearances and friction as warm as the coast-down has made them; none where nothing of it follows.
    fn warm(&self, built: &CoastDownModel) -> Result<Option<Box<RotorMachine>>, Failure> {
        let machine = self.context.setup.machine;
        let Some(following) = &self.following else {
            return Ok(None);
        };
        let start = &built.start;
        let now = |k: usize| {
            let nodes = &start.temperatures[k * NODES.len()..][..NODES.len()];
            let part = &built.parts[k];
            let hotter = nodes[ROTOR].max(nodes[INNER_RACE]) + ICE_POINT;
            let bodies = hotter - part.warm.heat.start_temperature;
            Some(Now {
                nodes,
                spin: part.losses.ratio * start.speed,
                contact: self.surfaces[k].as_ref().map_or(bodies, |heat| heat.rise),
                friction: machine.constants.bearings[k].contact.friction,
            })
        };
        let mut warmed = Warmed::default();
        let warm = following.renewed(&mut warmed, machine, (start.time, &self.state), &now);
        match warmed.broken() {
            Some(_) => Err("no machine can be built at these temperatures"),
            None => Ok(warm),
        }
    }

    /// All that turns changes its speed by one factor: a rotor that jumped in its races would slip there.
    fn turn_at(&mut self, speed: f64) {
        let factor = speed / self.speed();
        let layout = self.machine.layout();
        self.state[layout.rotor.spin()] *= factor;
        for (at, part) in layout.bearings.iter().zip(&self.machine.constants.bearings) {
            self.state[at.inner.spin()] *= factor;
            (part.bearing).change_speeds(&mut self.state[at.own()], factor);
        }
    }

    /// The motion goes on for a time, s.
    fn batch(
        &mut self,
        built: &CoastDownModel,
        record: &mut Record,
        span: f64,
    ) -> Result<Batch, Failure> {
        let marks: Vec<Mark> = record.bearings.iter().map(Mark::of).collect();
        for own in &mut record.bearings {
            own.contacts.clear();
            if let Some(spatial) = &mut own.spatial {
                spatial.axial_force = Peak::NONE;
            }
        }
        let own = &self.machine.constants;
        let known = own.schedule.instants().first();
        let speed = self.speed();
        if known.is_some_and(|time| *time <= self.time)
            || own.at_speeds.iter().any(|own| has_come(own, speed))
        {
            self.go_on(own.clone(), speed);
        }
        record.unbalances = self.unbalances;
        let before = self.state.clone();
        let machine = self.machine.clone();
        let runs = Runs {
            machines: &[&*machine],
            starts: std::slice::from_ref(&before),
            settings: Settings {
                start: self.time,
                end: self.time + span,
                // a step that time itself still tells apart
                first_step: (self.settings.first_step).max(1e3 * f64::EPSILON * self.time),
                ..self.settings
            },
            steps: self.steps,
            interrupt: self.interrupt,
        };
        let mut endings = simulate(runs, &mut [&mut *record as &mut dyn Observer<RotorMachine>]);
        let Some(ending) = endings.pop() else {
            unreachable!("each machine has an ending")
        };
        self.taken += ending.work.accepted;
        match ending.stop {
            solve::Stop::Finished => {}
            solve::Stop::Interrupted => return Err("it was interrupted"),
            solve::Stop::Halted(why) => return Err(why),
            _ => return Err("a ball-by-ball interval did not end as planned"),
        }
        self.state = ending.state;
        self.time = ending.time;
        self.unbalances = record.unbalances;
        let spin = machine.layout().rotor.spin();
        let speed = 0.5 * (before[spin] + self.state[spin]).abs();
        let piece = Piece {
            built,
            motion: self,
            before: &before,
            span,
            speed,
        };
        let bearings = (record.bearings.iter().zip(&marks).enumerate())
            .map(|(k, (record, mark))| piece.bearing(k, record, mark))
            .collect();
        Ok(Batch {
            span,
            speed,
            bearings,
            rotor: piece.rotor(),
        })
    }

    /// What batches and their record have found together.
    fn ended(&mut self, batches: Vec<Batch>, mut record: Record) -> Interval {
        self.surfaces = (record.bearings.iter_mut())
            .map(|own| own.heat.take())
            .collect();
        Interval {
            batches,
            changed: None,
            balls: (record.bearings.iter())
                .map(|record| balls(record).map(Arc::new))
                .collect(),
            displacements: (record.bearings.iter())
                .map(|own| {
                    [&own.rotor_displacement, &own.mount_displacement].map(|peak| peak.value)
                })
                .collect(),
        }
    }
}

/// Whether a rotor that slows down has come to a speed.
fn has_come(own: &AtSpeed, speed: f64) -> bool {
    speed <= own.speed * (1.0 + 1e-9)
}

/// Events until a time, s, and a speed, rad/s, hold from the start.
fn happen(constants: &mut MachineConstants, until: f64, speed: f64) {
    let before = constants
        .schedule
        .all()
        .map(|(time, event)| match time > until {
            true => (time, event),
            false => (0.0, event),
        });
    let come = constants
        .at_speeds
        .iter()
        .filter(|own| has_come(own, speed));
    let come = come.flat_map(|own| own.then.iter().map(|(_, event)| (0.0, *event)));
    constants.schedule = Schedule::of(before.chain(come));
    constants.at_speeds.retain(|own| !has_come(own, speed));
}

/// Leaves out what a record found largest so far.
fn forget(record: &mut Record) {
    for own in &mut record.bearings {
        for peak in [
            &mut own.largest_inner_load,
            &mut own.largest_outer_load,
            &mut own.rotor_displacement,
            &mut own.mount_displacement,
        ] {
            *peak = Peak::NONE;
        }
        if let Some(heat) = &mut own.heat {
            heat.contact = Peak::NONE;
        }
    }
}

/// What a record counted when a batch began.
struct Mark {
    impulse: f64,
    whirl_turns: f64,
    distance: f64,
    rubbed: f64,
    slid: [f64; 3],
}

impl Mark {
    fn of(record: &BearingRecord) -> Self {
        let heat = record.heat.as_deref();
        let slid = heat.map_or_else(Default::default, |heat| heat.slid);
        Mark {
            impulse: record.impulse,
            whirl_turns: record.whirl_turns.net,
            distance: heat.map_or(0.0, |heat| heat.distance),
            rubbed: heat.map_or(0.0, |heat| heat.rubbed),
            slid: [slid.impulse, slid.conducted, slid.uneven],
        }
    }
}

/// A batch of the motion, from a state to where it is now.
struct Piece<'a> {
    built: &'a CoastDownModel,
    motion: &'a Motion<'a>,
    before: &'a [f64],
    span: f64,
    speed: f64,
}

impl Piece<'_> {
    /// Mean power of a heat of the ledger, W.
    fn power(&self, heat: usize) -> f64 {
        let channel = self.motion.machine.layout().heat(heat);
        (self.motion.state[channel] - self.before[channel]) / self.span
    }

    /// What the rotor itself loses, W.
    fn rotor(&self) -> f64 {
        let own = self.motion.machine.layout().of_rotor;
        let losses = [own.damping, own.damping_rotating, own.seal_damping];
        losses
            .into_iter()
            .flatten()
            .map(|heat| self.power(heat))
            .sum()
    }

    /// Distance of the places of the rotor's centre in a race at both ends, with those of its velocities over the frequency of the pendulum, m.
    fn returns(&self, k: usize) -> f64 {
        let machine = &self.motion.machine;
        let place = |state: &[f64]| {
            let centre = machine.node(k, state);
            let race = machine.layout().bearings[k].motion(state).inner;
            (
                centre.position - race.position,
                centre.velocity - race.velocity,
            )
        };
        let (before, now) = (place(self.before), place(&self.motion.state));
        let apart = (now.1 - before.1) * (1.0 / self.motion.pendulum());
        ((now.0 - before.0).length_squared() + apart.length_squared()).sqrt()
    }

    fn bearing(&self, k: usize, record: &BearingRecord, mark: &Mark) -> Bearing {
        let (motion, built) = (self.motion, self.built);
        let at = motion.machine.layout().bearings[k];
        let part: &Part = &built.parts[k];
        let own = &motion.machine.constants.bearings[k];
        let heats: [f64; HEATS] = std::array::from_fn(|kind| self.power(at.heat + kind));
        let spin = 0.5 * (self.before[at.inner.spin()] + motion.state[at.inner.spin()]);
        let drag_factor = own
            .bearing
            .drag_factor(&|state| motion.state[at.own().start + state]);
        let now = Mark::of(record);
        let [slid, conducted, uneven] =
            [0, 1, 2].map(|kind: usize| (now.slid[kind] - mark.slid[kind]) / self.span);
        let temperatures = &built.start.temperatures[k * NODES.len()..][..NODES.len()];
        let nodes = own.warm.as_ref().map_or([0.0; NODES.len()], |warm| {
            warm.over_nodes(&heats, spin, (temperatures[LUBRICANT], drag_factor), uneven)
        });
        let steady = steady_moment(&heats);
        let force = (now.impulse - mark.impulse) / self.span;
        let sign = motion.state[motion.machine.layout().rotor.spin()].signum();
        let laws = part.losses.on_rotor(self.speed, temperatures);
        // a patch between bodies whose conductance is given is followed at their mean: it may be as warm as the hotter one
        let apart = match part.network.landing.is_given() {
            true => 0.5 * (temperatures[ROTOR] - temperatures[INNER_RACE]).abs(),
            false => 0.0,
        };
        Bearing {
            planes: own.planes,
            steady,
            other: heats.iter().sum::<f64>() - steady,
            laws: laws.map(|moment| moment * self.speed / own.planes),
            nodes,
            friction: self.power(at.rotor_race_friction()),
            sliding: (now.distance - mark.distance) / self.span,
            rubbing: (now.rubbed - mark.rubbed) / self.span,
            returns: self.returns(k),
            whirl: sign * (now.whirl_turns - mark.whirl_turns),
            peak_force: record.peak_contact_force().map_or(0.0, |peak| peak.value),
            peak_thrust: (record.spatial.as_ref()).map_or(0.0, |own| own.axial_force.value),
            peak_rise: (record.heat.as_ref()).map_or(0.0, |heat| heat.contact.value + apart),
            drag_factor,
            spin: spin.abs() / (part.losses.ratio * self.speed),
            landing: Landing {
                force,
                slides: match force > 0.0 {
                    true => (slid / force).clamp(0.0, 1.0),
                    false => 0.0,
                },
                conductance: match part.network.landing.is_given() {
                    true => 0.0,
                    false => conducted,
                },
            },
        }
    }
}

/// What an interval has seen of the balls of a bearing; none of a bushing, or where it did not turn.
fn balls(record: &BearingRecord) -> Option<BallsSeen> {
    let (races, turns) = (record.races.as_ref()?, record.turns);
    let loads = [record.largest_inner_load, record.largest_outer_load];
    let each_turn = |sums: &[f64]| sums.iter().map(|sum| sum / turns).collect();
    let rows = races.by_row().map(|sums| sums.map(each_turn));
    let (inner, outer): (Vec<Vec<f64>>, Vec<_>) = rows.map(|[inner, outer]| (inner, outer)).unzip();
    (turns > 0.0).then(|| BallsSeen {
        largest: loads.map(|peak| peak.value),
        cubes: [of_rows(&inner), of_rows(&outer)],
    })
}
