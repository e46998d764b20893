//! Down to another speed in the motion that a rotor has: is it still the one that slow time goes by?
//!
//! ```text
//!   each 1.5 % of speed    a batch ball by ball, spin held; oil, clearance and friction as warm as slow time makes them there
//!   it is not              P/P_laws other than foreseen, or a contact force farther above the load at rest than a rotor under its weight has
//! ```
//! This finds whatever lifts a rotor or lets it slide on its way down, by its motion alone: unbalance at a natural frequency of mounts and bearings or in
//! the swing √(g/c0) of the air clearance, and friction that does not carry what a bearing brakes.
//!
//! A motion that grows is given the time that it needs at its speed; how it grows from nothing in longer than a few tenths of a second is not found.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::coast_down::build::{Built, Start};
use crate::coast_down::rows::Row;
use crate::drop::context::Context;
use crate::drop::window::{BATCH, BATCHES, SETTLING, Seen, Way, Window};
use std::sync::atomic::Ordering;
use thermal::bearing_network::NODES;

/// A rotor that jumps in its speed by a percent swings in its bore: steps of the speed, so many of them seen together, and how long each of them is, in turns or
/// in seconds if these are less.
const STEP: f64 = 0.997;
const STEPS: u32 = 5;
const TURNS: (f64, f64) = (2.0, 0.04);

/// Largest force and way of a turn over those before from which on a motion grows, where the rotor lies and where it bounces, which is chaotic; and how often
/// it is looked at again at its speed. A swing in the bore is far in its way when it shows in its force.
const GROWS: [f64; 2] = [1.005, 1.05];
const BOUNCES: [f64; 2] = [f64::INFINITY, 1.2];
const STAYS: u32 = 20;

/// What a motion is foreseen to be.
pub(super) struct Foreseen {
    /// Power of the bearings over that of the laws.
    power: f64,
    /// Within so much of it.
    within: f64,
    /// Most a contact force is, of each bearing, N.
    forces: Vec<f64>,
    /// Whether the rotor lies under its weight.
    lies: bool,
}

impl Foreseen {
    /// A rotor that rolls.
    pub fn rolling(built: &Built) -> Self {
        Foreseen {
            power: 1.0,
            within: LOSES,
            forces: under_weight(built, LIFTS),
            lies: true,
        }
    }
    /// A motion that goes on as a window found it.
    pub fn by(built: &Built, window: &Window) -> Self {
        let of_batch = window.scatter * (BATCHES as f64).sqrt();
        let peaks = window.seen.peaks.iter();
        Foreseen {
            power: 1.0 + excess(built, &window.seen.powers),
            within: GOES_ON.max(SPREAD * of_batch),
            forces: peaks.map(|force| HARDER * force).collect(),
            lies: false,
        }
    }
    /// How what was seen is other than that.
    fn other(&self, looked: &Looked) -> Option<Other> {
        if (looked.power / self.power - 1.0).abs() > self.within {
            return Some(Other::Power(looked.power));
        }
        let (bearing, force) = larger(&looked.seen.peaks, &self.forces)?;
        Some(Other::Force { bearing, force })
    }
}

/// What was seen in several pieces.
#[derive(Default)]
struct Looked {
    /// Mean power of the bearings over that of the laws, and of how many pieces.
    power: f64,
    count: f64,
    /// The largest of all.
    seen: Seen,
}

impl Looked {
    fn and(&mut self, built: &Built, seen: Seen) {
        let power = 1.0 + excess(built, &seen.powers);
        self.count += 1.0;
        self.power += (power - self.power) / self.count;
        if self.count == 1.0 {
            self.seen = seen;
            return;
        }
        let raise = |most: &mut [f64], own: &[f64]| {
            for (most, own) in most.iter_mut().zip(own) {
                *most = most.max(*own);
            }
        };
        raise(&mut self.seen.peaks, &seen.peaks);
        raise(&mut self.seen.rises, &seen.rises);
        raise(&mut self.seen.ways, &seen.ways);
    }
}

/// Share by which a rotor that rolls may lose more or less than laws say.
const LOSES: f64 = 0.03;
/// Change of a power over that foreseen that asks for a window of its own, and over the standard error of a batch; and that of a force.
const GOES_ON: f64 = 0.1;
const SPREAD: f64 = 4.0;
const HARDER: f64 = 1.5;

/// Share of the load at rest by which a contact force may be above it where a rotor lies under its weight, on its way and in a window that hands over to
/// laws: at 1 a sinusoidal one leaves its race. At 0.9 and at 0.5 it takes 2.2 and 1.4 times the life of the load at rest, at most.
const LIFTS: f64 = 0.9;
pub(super) const LIES: f64 = 0.5;

/// Most a contact force of each bearing is where a rotor lies under its weight, N: its load at rest and a share of it, or of [`LIGHT`] of the largest of these,
/// since one that carries hardly any never rests.
pub(super) fn under_weight(built: &Built, share: f64) -> Vec<f64> {
    let loads = || built.parts.iter().map(|part| part.warm.radial_load);
    let least = LIGHT * loads().fold(0.0, f64::max);
    loads().map(|load| load + share * load.max(least)).collect()
}
const LIGHT: f64 = 0.1;

/// A contact force that is larger than these: its bearing, and it, N.
pub(super) fn larger(peaks: &[f64], forces: &[f64]) -> Option<(usize, f64)> {
    let mut each = peaks.iter().copied().enumerate();
    each.find(|(bearing, force)| *force > forces[*bearing])
}

/// How a motion is other than foreseen.
#[derive(Clone, Debug)]
pub(super) enum Other {
    /// The bearings take so many times what laws say.
    Power(f64),
    /// This contact force of a bearing, N.
    Force { bearing: usize, force: f64 },
    /// It could not be followed.
    Broken,
}

impl Way<'_> {
    /// Comes down from the start of a run-out to a speed, along what slow time says of its way to an end beyond it; where its motion is other than foreseen it ends there: at
    /// which speed, rad/s, and how. None where it comes down, or is interrupted.
    pub fn down(
        &mut self,
        built: &Built,
        (end, to): (&Start, f64),
        foreseen: &Foreseen,
        mut saw: impl FnMut(&Start, &Seen),
    ) -> Option<(f64, Other)> {
        let mut there = built.clone();
        let mut before: Option<Seen> = None;
        let mut stays = 0;
        loop {
            let ratio = if stays > 0 { 1.0 } else { STEP };
            let mut looked = Looked::default();
            for _ in 0..STEPS {
                let speed = ratio * there.start.speed;
                if speed < to {
                    return None;
                }
                there.start = between(&built.start, end, speed);
                match self.glance(&there, TURNS) {
                    Ok(seen) => looked.and(&there, seen),
                    Err(_) if self.interrupt.load(Ordering::Relaxed) => return None,
                    Err(_) => return Some((speed, Other::Broken)),
                }
            }
            if foreseen.other(&looked).is_some() {
                // what a step in speed and temperatures has stirred up dies away; a rotor that bounces may be thrown, once
                let begun = std::mem::take(&mut looked);
                for turns in [SETTLING, BATCH] {
                    looked = Looked::default();
                    match self.glance(&there, turns) {
                        Ok(seen) => looked.and(&there, seen),
                        Err(_) if self.interrupt.load(Ordering::Relaxed) => return None,
                        Err(_) => return Some((there.start.speed, Other::Broken)),
                    }
                    if !foreseen.lies {
                        saw(&there.start, &looked.seen);
                    }
                }
                if !foreseen.lies || foreseen.other(&looked).is_some() {
                    saw(&there.start, &begun.seen);
                }
            }
            if let Some(other) = foreseen.other(&looked) {
                return Some((there.start.speed, other));
            }
            saw(&there.start, &looked.seen);
            // a motion that grows is given the time that it needs
            let grows = before.is_some_and(|before| looked.seen.grows(&before, foreseen.lies));
            stays = if grows && stays < STAYS { stays + 1 } else { 0 };
            before = Some(looked.seen);
        }
    }
}

impl Seen {
    /// Whether the largest force grows, or the way of a turn in any bearing.
    fn grows(&self, before: &Seen, lies: bool) -> bool {
        let [force, way] = if lies { GROWS } else { BOUNCES };
        let most = |seen: &Seen| seen.peaks.iter().copied().fold(0.0, f64::max);
        let mut ways = self.ways.iter().zip(&before.ways);
        most(self) > force * most(before) || ways.any(|(now, before)| *now > way * before)
    }
}

/// On the way from a start to an end at a speed, along the rows of the end and straight between them.
fn between(start: &Start, end: &Start, speed: f64) -> Start {
    let own = &end.rows[start.rows.len()..];
    let next = own.partition_point(|row| row.speed > speed);
    let row = |row: &Row| (row.time, row.speed, row.temperatures.clone());
    let state = |start: &Start| (start.time, start.speed, start.temperatures.clone());
    let before = own[..next].last().map_or(state(start), row);
    let after = own.get(next).map_or(state(end), row);
    let share = (before.1 - speed) / (before.1 - after.1);
    let at = |a: f64, b: f64| a + share * (b - a);
    let nodes = before.2.iter().zip(&after.2);
    let nodes = nodes.map(|(a, b)| at(*a, *b)).collect();
    Start::at(at(before.0, after.0), speed, nodes, start.beyond_data.len())
}

/// Acceleration of unbalance over that of gravity below which it lifts no rotor.
const SHAKES: f64 = 0.01;

/// Speed below which unbalance lifts no rotor, rad/s.
pub(super) fn calm(context: &Context) -> f64 {
    let constants = &context.setup.machine.constants;
    let bearings = constants.bearings.iter();
    let most = bearings.map(|bearing| constants.rotor.most_eccentric(&bearing.node));
    (SHAKES * context.setup.drop().gravity.acceleration / most.fold(0.0, f64::max)).sqrt()
}

/// What the bearings take beside what the laws of a rotor that rolls say, less 1; of the powers of a window or a batch.
pub(super) fn excess(built: &Built, powers: &[f64]) -> f64 {
    let start = &built.start;
    let (_, bearings) = powers.split_last().unwrap_or((&0.0, &[]));
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
