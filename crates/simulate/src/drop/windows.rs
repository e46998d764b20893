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

use crate::coast_down::build::{Built, Start};
use crate::coast_down::rows::End;
use crate::drop::context::Context;
use crate::drop::glide::{Foreseen, LIES, calm, excess, larger, under_weight};
use crate::drop::slow_time::{Until, step};
use crate::drop::window::{Last, Seen, Way, Window};
use std::sync::atomic::{AtomicBool, Ordering};

/// Speed of a window over that before.
const RATIO: f64 = 0.95;
/// What windows find goes on as it was where the way to one was foreseen within [`AGREES`] by that before: then they lie twice as far apart, at
/// most so many times [`RATIO`].
const FARTHEST: i32 = 4;
/// Share of the energy at the start of the run-out below which no window looks again, unless a body warms or unbalance may lift the rotor.
const SLOW: f64 = 0.01;

/// Windows one after the other in which the rotor loses no more than by rolling, within so much of that.
const AGREEING: usize = 2;
const AGREES: f64 = 0.02;
/// Turns about a race within a window from which on the rotor whirls there: it does not lie under its weight, whatever it loses.
const WHIRLING: f64 = 1.0;
/// The same with its spin, over the turns of the rotor, from which on one place of it stays on the race.
const FORWARD: f64 = 0.5;

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
    /// First and last instant at which it whirled against its spin, and at which it whirled with its spin, s.
    pub whirled: [Option<[f64; 2]>; 2],
    /// Least speed of an inner race over that at which it rolls, and when, s.
    pub slowest: Option<[f64; 2]>,
}

impl Bounced {
    /// Energy that friction of rotor and races took, J.
    pub fn friction(&self) -> f64 {
        self.rubbed.iter().map(|[heat, _]| heat).sum()
    }
    fn saw(&mut self, start: &Start, window: &Window) {
        let with_spin = FORWARD * window.turns;
        for (whirled, found) in self.whirled.iter_mut().zip([
            window.whirl.iter().any(|turns| *turns <= -WHIRLING),
            window.whirl.iter().any(|turns| *turns >= with_spin),
        ]) {
            if found {
                let since = whirled.map_or(start.time, |[since, _]| since);
                *whirled = Some([since, start.time]);
            }
        }
        for bearing in &window.followed.bearings {
            if self.slowest.is_none_or(|[least, _]| bearing.spin < least) {
                self.slowest = Some([bearing.spin, start.time]);
            }
        }
        self.glanced(start, &window.seen);
        self.pressed(start, &window.settled);
    }
    pub fn glanced(&mut self, start: &Start, seen: &Seen) {
        self.hottest.resize(seen.rises.len(), [0.0; 2]);
        for (hottest, rise) in self.hottest.iter_mut().zip(&seen.rises) {
            if *rise > hottest[0] {
                *hottest = [*rise, start.time];
            }
        }
        self.pressed(start, &seen.peaks);
    }
    fn pressed(&mut self, start: &Start, peaks: &[f64]) {
        self.peaks.resize(peaks.len(), [0.0; 3]);
        for (largest, peak) in self.peaks.iter_mut().zip(peaks) {
            if *peak > largest[0] {
                *largest = [*peak, start.time, start.speed];
            }
        }
    }
}

/// Follows the rotor from its last motion until it loses what laws say, or until there is a reason to end; `built` starts there afterwards. One that
/// `rolls` already needs no second window to say so.
pub(super) fn follow(
    context: &Context,
    (built, last): (&mut Built, &mut Last),
    rolls: bool,
    interrupt: &AtomicBool,
) -> Bounced {
    let mut way = Way::from(context, last, interrupt);
    let mut bounced = Bounced::default();
    let mut before: Option<(Start, Window)> = None;
    let mut agreeing = 0;
    let mut apart = 1;
    let calm = calm(context);
    let end = loop {
        if interrupt.load(Ordering::Relaxed) {
            break Some(End::Interrupted);
        }
        if built.start.speed <= built.end.stop_speed {
            break Some(End::Stands);
        }
        let window = way.window(built);
        if bounced.late.is_none() {
            bounced.late = Some(way.waited);
        }
        let window = match window {
            Ok(window) => window,
            Err(_) if interrupt.load(Ordering::Relaxed) => break Some(End::Interrupted),
            Err(why) => break Some(End::Lost(why)),
        };
        if rolls && bounced.scatter.is_empty() && rolling(built, &window) {
            return Bounced {
                steps: way.steps,
                ..Bounced::default()
            };
        }
        if window.seen.powers.iter().sum::<f64>() <= 0.0 {
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
        agreeing = match rolling(built, &window) {
            true => agreeing + 1,
            false => 0,
        };
        if agreeing == AGREEING {
            break None;
        }
        let start = built.start.clone();
        // the last of its way is short, and a window there long
        let slow = start.speed < calm
            && built.inertia * start.speed * start.speed < 2.0 * SLOW * built.energy;
        let ratio = if slow { 0.0 } else { RATIO.powi(apart) };
        match step(built, &window, &Until::Ratio(ratio), interrupt) {
            Ok((_, None)) => {}
            Ok((_, end)) => break end,
            Err(why) => break Some(End::Lost(why)),
        }
        // what the motion finds on its way there may ask for a window before
        let mut from = built.clone();
        from.start = start.clone();
        let other = match slow {
            true => None,
            false => way.down(
                &from,
                (&built.start, built.start.speed),
                &Foreseen::by(&from, &window),
                |start, seen| bounced.glanced(start, seen),
            ),
        };
        if let Some((speed, _)) = other {
            from.start = start.clone();
            match step(
                &mut from,
                &window,
                &Until::Ratio(speed / start.speed),
                interrupt,
            ) {
                Ok((_, None)) => *built = from,
                Ok((_, end)) => break end,
                Err(why) => break Some(End::Lost(why)),
            }
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

/// Whether the bearings take what the laws of a rotor that rolls say, and it lies under its weight.
fn rolling(built: &Built, window: &Window) -> bool {
    let whirls = window.whirl.iter().any(|turns| turns.abs() >= WHIRLING);
    let lifted = larger(&window.seen.peaks, &under_weight(built, LIES)).is_some();
    !whirls && !lifted && excess(built, &window.seen.powers).abs() < AGREES
}
