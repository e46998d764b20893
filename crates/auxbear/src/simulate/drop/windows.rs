//! A rotor that does not roll yet while it slows down: windows ball by ball at speeds that fall, and slow time between them.
//!
//! ```text
//!   window at Ω_j    spin held, oil and clearance as warm as they are; settle, then mean heats over whole turns
//!   between          a run-out by laws with what both windows find beside them (slow_time.rs), farther where it went as foreseen
//! ```
//! It ends where the rotor rolls, or loses no more than by rolling in two windows: the run-out by laws goes on from there. Unbalance of a few micrometres lifts a fast rotor from
//! rolling again and again (e Ω² near g), so that this is how most drops go on.
//!
//! The spread of the means is that of batches; what scatters more than a tenth is reported.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::scenario::Drop;
use crate::simulate::bearing::feedback::Follows;
use crate::simulate::coast_down::build::{Built, Start};
use crate::simulate::coast_down::ran::Ran;
use crate::simulate::coast_down::rows::{BallsSeen, End};
use crate::simulate::drop::build;
use crate::simulate::drop::context::Context;
use crate::simulate::drop::ensemble::{self, Finished, Member, Plan};
use crate::simulate::drop::method;
use crate::simulate::drop::slow_time::{Until, Window, beside_laws, step};
use crate::simulate::ending::settings_at;
use model::auxiliary_bearing::HEATS;
use model::bearing_heat::OfNodes;
use model::system::machine::RotorMachine;
use model::system::machine::record::{BearingRecord, ROLLS};
use solve::Settings;
use std::f64::consts::TAU;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use thermal::bearing_network::{LUBRICANT, NODES};

/// Speed of a window over that before.
pub(super) const RATIO: f64 = 0.95;
/// What windows find goes on as it was where the way to one was foreseen within [`AGREES`] by that before: then they lie twice as far apart, at
/// most so many times [`RATIO`], and at no natural frequency.
const FARTHEST: i32 = 4;
/// Speeds around a natural frequency that no such step leads into or over, over it.
const NEAR: [f64; 2] = [1.05, 0.95];
/// Turns of the rotor in which a window settles, more than the turns of the cage after which it counts as rolling, and in each of its
/// batches; and the longest that either takes, s.
const SETTLING: (f64, f64) = (60.0, 1.0);
const BATCH: (f64, f64) = (10.0, 0.2);
/// Batches of a window: neighbours correlate, so that fewer say little of the scatter.
const BATCHES: usize = 8;

/// Windows one after the other in which the rotor loses no more than by rolling, within so much of that.
const AGREEING: usize = 2;
const AGREES: f64 = 0.02;
/// Turns about a race within a window from which on the rotor whirls there: it does not lie under its weight, whatever it loses.
const WHIRLING: f64 = 1.0;

/// What one batch of a window finds.
struct Batch {
    powers: Vec<f64>,
    nodes: Vec<f64>,
    friction: f64,
    peaks: Vec<f64>,
    balls: Vec<Option<BallsSeen>>,
    drag_factors: Vec<f64>,
    /// Of the inner races, rad/s.
    spins: Vec<f64>,
    rotor: f64,
    /// Turns of the rotor about each inner race, with its spin.
    whirl: Vec<f64>,
}

/// What windows follow.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// Speed above which they go on whatever they find, rad/s.
    pub until: f64,
    /// Speed of each over that before, there.
    pub ratio: f64,
}

impl Stretch {
    /// A rotor that does not roll yet, until it does.
    pub const UNTIL_ROLLING: Stretch = Stretch {
        until: f64::INFINITY,
        ratio: RATIO,
    };
}

/// How the windows went.
#[derive(Clone, Debug, Default)]
pub(super) struct Bounced {
    /// Relative standard error of the power of each window.
    pub scatter: Vec<f64>,
    /// Steps of all of them.
    pub steps: u64,
    /// Kinetic energy of one side at the end of the last, J.
    pub kinetic: Option<f64>,
    /// Energy lost between them, and what of it friction of rotor and races took, J.
    pub lost: f64,
    pub friction: f64,
    /// Largest contact force of each bearing, N, and the time and the speed of its window, s and rad/s.
    pub peaks: Vec<[f64; 3]>,
    /// First and last instant at which it whirled against its spin, s.
    pub whirled: Option<[f64; 2]>,
    /// Least speed of an inner race over that at which it rolls, and when, s.
    pub slowest: Option<[f64; 2]>,
}

impl Bounced {
    fn saw(&mut self, start: &Start, window: &Window) {
        if window.whirl.iter().any(|turns| *turns <= -WHIRLING) {
            let since = self.whirled.map_or(start.time, |[since, _]| since);
            self.whirled = Some([since, start.time]);
        }
        for bearing in &window.followed.bearings {
            if self.slowest.is_none_or(|[least, _]| bearing.spin < least) {
                self.slowest = Some([bearing.spin, start.time]);
            }
        }
        self.peaks.resize(window.peaks.len(), [0.0; 3]);
        for (largest, peak) in self.peaks.iter_mut().zip(&window.peaks) {
            if *peak > largest[0] {
                *largest = [*peak, start.time, start.speed];
            }
        }
    }
}

/// What one more part of a window says.
enum Piece {
    Rolls,
    Whole,
    Lost(&'static str),
}

/// A rotor on its way down.
struct Way<'a> {
    context: &'a Context<'a>,
    interrupt: &'a AtomicBool,
    machine: Arc<RotorMachine>,
    state: Vec<f64>,
    time: f64,
    steps: u64,
}

/// Follows the rotor through a stretch and until it rolls, or until there is a reason to end; `built` starts there afterwards.
pub(super) fn follow(
    context: &Context,
    built: &mut Built,
    stretch: Stretch,
    frequencies: &[f64],
    interrupt: &AtomicBool,
) -> Bounced {
    let mut way = Way::from_end_of(context, interrupt);
    let mut bounced = Bounced::default();
    let mut before: Option<(Start, Window)> = None;
    let mut agreeing = 0;
    let mut apart = 1;
    let end = loop {
        if interrupt.load(Ordering::Relaxed) {
            break Some(End::Interrupted);
        }
        if built.start.speed <= built.end.stop_speed {
            break Some(End::Stands);
        }
        let leaves = built.start.speed <= stretch.until;
        let window = match way.window(built, leaves) {
            Ok(Some(window)) => window,
            Ok(None) => break None,
            Err(_) if interrupt.load(Ordering::Relaxed) => break Some(End::Interrupted),
            Err(why) => break Some(End::Lost(why)),
        };
        if window.powers.iter().sum::<f64>() <= 0.0 {
            break Some(End::Lost("nothing brakes the rotor"));
        }
        bounced.scatter.push(window.scatter);
        bounced.saw(&built.start, &window);
        if let Some((start, last)) = before {
            // the step that led here, with what is known at both of its ends
            let (begin, foreseen) = (start.time, built.start.time);
            built.start = start;
            match step(built, &last, &Until::Window(&window), interrupt) {
                Ok((taken, end)) => {
                    bounced.lost += taken[0];
                    bounced.friction += taken[1];
                    if end.is_some() {
                        break end;
                    }
                }
                Err(why) => break Some(End::Lost(why)),
            }
            let (took, wrong) = (built.start.time - begin, built.start.time - foreseen);
            apart = match wrong.abs() < AGREES * took {
                true => FARTHEST.min(2 * apart),
                false => 1,
            };
        }
        agreeing = match leaves && rolling(built, &window) {
            true => agreeing + 1,
            false => 0,
        };
        if agreeing == AGREEING {
            break None;
        }
        let start = built.start.clone();
        let ratio = match leaves {
            true => far(start.speed, apart, frequencies),
            false => stretch.ratio,
        };
        match step(built, &window, &Until::Ratio(ratio), interrupt) {
            Ok((_, None)) => {}
            Ok((_, end)) => break end,
            Err(why) => break Some(End::Lost(why)),
        }
        before = Some((start, window));
    };
    if end.is_none() {
        built.motion = None;
    }
    built.start.ended = end;
    let content = way.machine.content(&way.state);
    // where it ends on the way, nothing changes its model
    let changes = built.start.ended.is_none() && !bounced.scatter.is_empty();
    bounced.kinetic = changes.then_some(content.translation + content.spin);
    bounced.steps = way.steps;
    bounced
}

/// Speed of the next window over that of this one.
fn far(speed: f64, apart: i32, frequencies: &[f64]) -> f64 {
    let longest = RATIO.powi(apart);
    let inside = (frequencies.iter())
        .any(|frequency| speed > NEAR[1] * frequency && longest * speed < NEAR[0] * frequency);
    if inside { RATIO } else { longest }
}

/// Speeds around a natural frequency at which the rotor is looked at, over it.
const AROUND: [f64; 3] = [1.03, 1.0, 0.97];

/// What the bearings take beside what the laws of a rotor that rolls say, less 1, around natural frequencies that a run-out by laws has
/// passed: the largest of a few windows at each. Not a number where a window did not end.
pub(super) fn looked_at(
    context: &Context,
    found: &Ran,
    frequencies: &[f64],
    interrupt: &AtomicBool,
) -> (Vec<f64>, u64) {
    let mut way = Way::from_end_of(context, interrupt);
    // none where it was interrupted
    let mut at = |frequency: f64| -> Option<f64> {
        let mut worst = 0.0f64;
        for ratio in AROUND {
            let speed = ratio * frequency;
            let Some(row) = found.free.rows.iter().find(|row| row.speed <= speed) else {
                continue;
            };
            let mut built = found.built.clone();
            built.start = Start::at(row.time, speed, row.temperatures.clone(), built.parts.len());
            match way.window(&built, true) {
                Ok(Some(window)) => worst = worst.max(excess(&built, &window)),
                Ok(None) => {}
                Err(_) if interrupt.load(Ordering::Relaxed) => return None,
                Err(_) => return Some(f64::NAN),
            }
        }
        Some(worst)
    };
    let list = (frequencies.iter())
        .map_while(|frequency| at(*frequency))
        .collect();
    (list, way.steps)
}

/// Whether the bearings take what the laws of a rotor that rolls say, and it does not whirl.
fn rolling(built: &Built, window: &Window) -> bool {
    let whirls = window.whirl.iter().any(|turns| turns.abs() >= WHIRLING);
    !whirls && excess(built, window).abs() < AGREES
}

/// What the bearings take beside what these laws say, less 1.
fn excess(built: &Built, window: &Window) -> f64 {
    let start = &built.start;
    let (_, bearings) = window.powers.split_last().unwrap_or((&0.0, &[]));
    let found = f64::from(built.sides) * bearings.iter().sum::<f64>();
    let parts = built
        .parts
        .iter()
        .zip(start.temperatures.chunks(NODES.len()));
    let law: f64 = parts
        .flat_map(|(part, temperatures)| part.losses.on_rotor(start.speed, temperatures))
        .sum();
    found / (law * start.speed) - 1.0
}

impl<'a> Way<'a> {
    /// From where the drop ended.
    fn from_end_of(context: &'a Context<'a>, interrupt: &'a AtomicBool) -> Self {
        Way {
            context,
            interrupt,
            machine: Arc::new(context.machine.clone()),
            state: context.finished.ending.state.clone(),
            time: context.finished.ending.time,
            steps: 0,
        }
    }

    /// Means at the speed and the temperatures that the run-out has come to; none where the rotor rolls and that ends it.
    fn window(
        &mut self,
        built: &Built,
        until_rolling: bool,
    ) -> Result<Option<Window>, &'static str> {
        let speed = built.start.speed;
        let drop = conditioned(self.context.drop, built);
        let made =
            build::drop(&drop).map_err(|_| "no machine could be built at these temperatures")?;
        let mut constants = made.constants.clone();
        constants.rotor.spin_held = true;
        for bearing in &mut constants.bearings {
            (bearing.warm, bearing.surfaces) = (None, None);
        }
        let stepping = method::stepping(
            &drop,
            &made,
            RotorMachine::new(constants.clone()).tangents(),
        );
        self.machine = Arc::new(RotorMachine::new(constants));
        let layout = self.machine.layout().clone();
        let spin = layout.rotor.spin();
        // a rotor that jumps in its races would slip there, and may be thrown out of its motion
        let factor = speed / self.state[spin].abs();
        self.state[spin] *= factor;
        for (at, part) in layout.bearings.iter().zip(&self.machine.constants.bearings) {
            self.state[at.inner + 5] *= factor;
            (part.bearing).change_speeds(&mut self.state[at.own()], factor);
        }
        let turn = TAU / speed;
        let settings = settings_at(&drop.run, stepping.tolerance);
        let plan = |settings: Settings| Plan {
            settings,
            steps: stepping.steps,
            interval: f64::INFINITY,
            until_rolling,
            threads: Some(1),
            interrupt: self.interrupt,
            progress: &|_| {},
        };
        let mut pieces = Vec::new();
        let plans: Vec<Plan> = (0..=BATCHES)
            .map(|batch| {
                let (turns, longest) = if batch == 0 { SETTLING } else { BATCH };
                plan(Settings {
                    end: (turns * turn).min(longest),
                    ..settings
                })
            })
            .collect();
        let (machine, mut state, mut time) = (self.machine.clone(), self.state.clone(), self.time);
        let mut steps = 0;
        let mut rolls = false;
        for (batch, mut plan) in plans.into_iter().enumerate() {
            plan.settings.start = time;
            plan.settings.end += time;
            state[layout.ledger()..].fill(0.0);
            let finished = piece(&machine, &state, &plan);
            steps += finished.ending.work.accepted;
            state.clone_from(&finished.ending.state);
            match outcome(&finished) {
                Piece::Rolls => {
                    rolls = true;
                    break;
                }
                Piece::Lost(why) => return Err(why),
                Piece::Whole => {}
            }
            if batch > 0 {
                let span = finished.ending.time - time;
                pieces.push(Batch {
                    peaks: peaks(&finished),
                    whirl: (finished.record.bearings.iter())
                        .map(|record| record.whirl_turns * self.state[spin].signum())
                        .collect(),
                    balls: finished.record.bearings.iter().map(balls).collect(),
                    ..self.heats(built, &state, span)
                });
            }
            time = finished.ending.time;
        }
        self.state = state;
        self.time = time;
        self.steps += steps;
        if rolls {
            return Ok(None);
        }
        Ok(Some(mean(built, &pieces)))
    }

    /// Powers of the losses and of the nodes over a span, from the ledger that began with it, W.
    fn heats(&self, built: &Built, state: &[f64], span: f64) -> Batch {
        let layout = self.machine.layout();
        let (mut powers, mut nodes, mut friction) = (Vec::new(), Vec::new(), 0.0);
        let (mut drag_factors, mut spins) = (Vec::new(), Vec::new());
        for (k, at) in layout.bearings.iter().enumerate() {
            let heats: [f64; HEATS] =
                std::array::from_fn(|kind| state[layout.heat(at.heat + kind)] / span);
            let steady = model::bearing_heat::steady_moment(&heats);
            powers.extend([steady, heats.iter().sum::<f64>() - steady]);
            friction += state[layout.heat(at.rotor_race_friction())] / span;
            let part = &self.context.machine.constants.bearings[k];
            let drag_factor = (part.bearing).drag_factor(&|own| state[at.own().start + own]);
            drag_factors.push(drag_factor);
            spins.push(state[at.inner + 5].abs());
            let of_nodes: OfNodes = match &part.warm {
                Some(warm) => {
                    let lubricant = built.start.temperatures[k * NODES.len() + LUBRICANT];
                    warm.over_nodes(&heats, state[at.inner + 5], lubricant, drag_factor)
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
            balls: Vec::new(),
            whirl: Vec::new(),
            drag_factors,
            spins,
            rotor: others,
        }
    }
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

/// The batches of a window together.
fn all_balls(batches: &[Batch], bearing: usize) -> Option<BallsSeen> {
    let mut each = batches.iter().map(|batch| batch.balls[bearing].as_ref());
    let mut all = each.next()??.clone();
    for other in each {
        let other = other?;
        for side in 0..2 {
            all.largest[side] = all.largest[side].max(other.largest[side]);
            for (sum, cube) in all.cubes[side].iter_mut().zip(&other.cubes[side]) {
                *sum += cube;
            }
        }
    }
    let count = batches.len() as f64;
    let mean = |ring: Vec<f64>| ring.into_iter().map(|sum| sum / count).collect();
    Some(BallsSeen {
        cubes: all.cubes.map(mean),
        ..all
    })
}

fn piece(machine: &Arc<RotorMachine>, state: &[f64], plan: &Plan) -> Finished {
    let member = Member {
        machine: machine.clone(),
        following: None,
        start: state.to_vec(),
        keep_rows: false,
        kind: 0,
    };
    ensemble::one(&member, plan)
}

fn outcome(finished: &Finished) -> Piece {
    match finished.ending.stop {
        solve::Stop::Finished => Piece::Whole,
        solve::Stop::Halted(ROLLS) => Piece::Rolls,
        solve::Stop::Interrupted => Piece::Lost("it was interrupted"),
        solve::Stop::Halted(why) => Piece::Lost(why),
        _ => Piece::Lost("a window ball by ball did not end as planned"),
    }
}

/// Means of batches, and the standard error of their sum over it.
fn mean(built: &Built, batches: &[Batch]) -> Window {
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
    let of_bearings = [drag_factors.as_slice(), spins.as_slice()];
    let (followed, beside) = beside_laws(built, &powers, &nodes, of_bearings, rotor);
    let whirl = of(batches.iter().map(|batch| &batch.whirl).collect());
    Window {
        followed,
        beside,
        whirl: whirl.iter().map(|turns| count * turns).collect(),
        friction: batches.iter().map(|batch| batch.friction).sum::<f64>() / count,
        scatter: deviation / (count.sqrt() * whole),
        peaks: (0..batches[0].peaks.len())
            .map(|k| {
                batches
                    .iter()
                    .map(|batch| batch.peaks[k])
                    .fold(0.0, f64::max)
            })
            .collect(),
        balls: (0..batches[0].balls.len())
            .map(|k| all_balls(batches, k).map(Arc::new))
            .collect(),
        powers,
    }
}

/// The drop with oil and clearance as warm as the run-out has made them.
fn conditioned(drop: &Drop, built: &Built) -> Drop {
    let mut warm = drop.clone();
    warm.rotor.speed = built.start.speed * drop.rotor.speed.signum();
    let temperatures = built.start.temperatures.chunks(NODES.len());
    for (part, temperatures) in warm.auxiliary_bearings.iter_mut().zip(temperatures) {
        let (Some(heat), Some(bearing)) = (&part.warm, &mut part.bearing) else {
            continue;
        };
        if let Some(follows) = Follows::of(heat, bearing) {
            follows.condition(bearing, temperatures);
        }
    }
    warm
}
