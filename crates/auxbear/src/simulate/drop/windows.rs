//! A rotor that does not roll yet while it slows down: windows ball by ball at speeds that fall, and slow time between them.
//!
//! ```text
//!   window at Ω_j    spin held, oil and clearance as warm as they are; settle, then mean heats over whole turns
//!   between          a run-out by laws with what both windows find beside them (slow_time.rs), farther where it went as foreseen
//! ```
//! It ends where the rotor loses no more than by rolling in two windows, or in one if the drop ended with a rotor that rolls: the run-out by laws goes on
//! from there. Unbalance of a few micrometres lifts a fast rotor from rolling again and again (e Ω² near g), and above its natural frequency it moves
//! the mount by e, so that this is how many drops go on.
//!
//! The spread of the means is that of batches; what scatters more than a tenth is reported.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::simulate::coast_down::build::{Built, Start};
use crate::simulate::coast_down::ran::Ran;
use crate::simulate::coast_down::rows::End;
use crate::simulate::drop::context::Context;
use crate::simulate::drop::slow_time::{Until, step};
use crate::simulate::drop::window::{Last, Way, Window};
use std::sync::atomic::{AtomicBool, Ordering};
use thermal::bearing_network::NODES;

/// Speed of a window over that before, and where a resonance lifts the rotor.
const RATIO: f64 = 0.95;
const FINE: f64 = 0.985;
/// What windows find goes on as it was where the way to one was foreseen within [`AGREES`] by that before: then they lie twice as far apart, at
/// most so many times [`RATIO`], and at no natural frequency.
const FARTHEST: i32 = 4;
/// Speeds around a natural frequency that no such step leads into or over, over it.
pub(super) const NEAR: [f64; 2] = [1.05, 0.95];
/// Share of the energy at the start of the run-out below which no window looks again unless a body warms.
const SLOW: f64 = 0.01;

/// Excess of a window at a natural frequency above which the rotor is not one that rolls.
const EXCESS: f64 = 0.1;

/// Windows one after the other in which the rotor loses no more than by rolling, within so much of that.
const AGREEING: usize = 2;
const AGREES: f64 = 0.02;
/// Turns about a race within a window from which on the rotor whirls there: it does not lie under its weight, whatever it loses.
const WHIRLING: f64 = 1.0;

/// What windows follow.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// Speed above which they go on whatever they find, rad/s.
    pub until: f64,
    /// Speed from which on down to that they lie [`FINE`] apart, rad/s.
    pub fine: f64,
    /// Whether the rotor rolls already, so that the first of them may say that laws know all it loses.
    pub rolls: bool,
}

impl Stretch {
    /// Until the rotor loses what laws say.
    pub const fn until_rolling(rolls: bool) -> Stretch {
        Stretch {
            until: f64::INFINITY,
            fine: 0.0,
            rolls,
        }
    }
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
    /// Energy lost between them, J, what of it the friction of rotor and race of each bearing took, J, and over which way, m.
    pub lost: f64,
    pub rubbed: Vec<[f64; 2]>,
    /// How long the first waited for races to come to their speed, s.
    pub late: Option<f64>,
    /// Largest contact force of each bearing, N, and the time and the speed of its window, s and rad/s.
    pub peaks: Vec<[f64; 3]>,
    /// Largest rise of the patch of rotor and race of each bearing above the start, K, and when, s.
    pub hottest: Vec<[f64; 2]>,
    /// First and last instant at which it whirled against its spin, s.
    pub whirled: Option<[f64; 2]>,
    /// Least speed of an inner race over that at which it rolls, and when, s.
    pub slowest: Option<[f64; 2]>,
}

impl Bounced {
    /// Energy that friction of rotor and races took, J.
    pub fn friction(&self) -> f64 {
        self.rubbed.iter().map(|[heat, _]| heat).sum()
    }
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
        self.hottest.resize(window.rises.len(), [0.0; 2]);
        for (hottest, rise) in self.hottest.iter_mut().zip(&window.rises) {
            if *rise > hottest[0] {
                *hottest = [*rise, start.time];
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

/// Follows the rotor from its last motion through a stretch and until it loses what laws say, or until there is a reason to end; `built` starts there afterwards.
pub(super) fn follow(
    context: &Context,
    (built, last): (&mut Built, &mut Last),
    stretch: Stretch,
    frequencies: &[f64],
    interrupt: &AtomicBool,
) -> Bounced {
    let mut way = Way::from(context, last, interrupt);
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
        let window = way.window(built);
        if bounced.late.is_none() {
            bounced.late = Some(way.waited);
        }
        let window = match window {
            Ok(window) => window,
            Err(_) if interrupt.load(Ordering::Relaxed) => break Some(End::Interrupted),
            Err(why) => break Some(End::Lost(why)),
        };
        if stretch.rolls && bounced.scatter.is_empty() && rolling(built, &window) {
            return Bounced {
                steps: way.steps,
                ..Bounced::default()
            };
        }
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
                    bounced.lost += taken.energy;
                    bounced.rubbed.resize(taken.rubbed.len(), [0.0; 2]);
                    for (sum, own) in bounced.rubbed.iter_mut().zip(taken.rubbed) {
                        *sum = [sum[0] + own[0], sum[1] + own[1]];
                    }
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
        // the last of its way is short, and a window there long
        let slow = built.inertia * start.speed * start.speed < 2.0 * SLOW * built.energy;
        let ratio = match leaves {
            false if start.speed <= stretch.fine => FINE,
            true if slow => 0.0,
            _ => far(start.speed, apart, frequencies),
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
    // where it ends on the way, nothing changes its model
    let changes = built.start.ended.is_none() && !bounced.scatter.is_empty();
    bounced.kinetic = changes.then(|| way.last.kinetic());
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

/// Speeds around a natural frequency at which the rotor is looked at, over it, and those on the way there where these say that it does not roll.
const AROUND: [f64; 3] = [1.03, 1.0, 0.97];
const ABOVE: [f64; 7] = [2.0, 1.75, 1.5, 1.35, 1.2, 1.1, 1.05];

/// What windows find near a natural frequency.
#[derive(Clone, Copy)]
pub(super) struct Near {
    /// What the bearings take beside what the laws of a rotor that rolls say, less 1, the largest around it. Not a number where a window did not end.
    pub excess: f64,
    /// Speed over it from which on they take more by [`AGREES`] on the way there, where it lifts the rotor.
    pub from: f64,
}

impl Near {
    /// Whether the rotor does not roll there, or no window ends.
    pub fn lifts(&self) -> bool {
        self.excess.is_nan() || self.excess > EXCESS
    }
}

/// What windows find near natural frequencies that a run-out by laws has passed.
pub(super) fn looked_at(
    context: &Context,
    (found, last): (&Ran, &Last),
    frequencies: &[f64],
    interrupt: &AtomicBool,
) -> (Vec<Near>, u64) {
    let mut steps = 0;
    // none where it was interrupted, 0 where the run-out has not been
    let mut excess_at = |last: &mut Last, speed: f64| -> Option<f64> {
        let Some(row) = found.free.rows.iter().find(|row| row.speed <= speed) else {
            return Some(0.0);
        };
        let mut built = found.built.clone();
        built.start = Start::at(row.time, speed, row.temperatures.clone(), built.parts.len());
        let mut way = Way::from(context, last, interrupt);
        let window = way.window(&built);
        steps += way.steps;
        match window {
            Ok(window) => Some(excess(&built, &window)),
            Err(_) if interrupt.load(Ordering::Relaxed) => None,
            Err(_) => Some(f64::NAN),
        }
    };
    let mut near = |frequency: &f64| -> Option<Near> {
        let mut near = Near {
            excess: 0.0,
            from: NEAR[0],
        };
        let mut motion = last.clone();
        for ratio in AROUND {
            let excess = excess_at(&mut motion, ratio * frequency)?;
            if excess.is_nan() || excess > near.excess {
                near.excess = excess;
            }
            if excess.is_nan() {
                break;
            }
        }
        if near.lifts() {
            // as the rotor comes there: from above, rolling
            let mut motion = last.clone();
            near.from = ABOVE[0];
            for ratio in ABOVE {
                if excess_at(&mut motion, ratio * frequency)?.abs() > AGREES {
                    break;
                }
                near.from = ratio;
            }
        }
        Some(near)
    };
    let list = frequencies.iter().map_while(&mut near).collect();
    (list, steps)
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
