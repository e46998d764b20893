//! A coast-down by multirate integration: short ball-by-ball intervals, and quasi-steady steps over the minutes or hours between them.
//!
//! The motion of a rotor in its bearings settles in tenths of a second, its speed Ω and its temperatures T change in seconds to hours. So they obey
//!
//! ```text
//!   I Ω̇ = −M(Ω, T),   C Ṫ = Q(Ω, T) − G (T − T_ambient)
//! ```
//! with moments and heats that are means over the motion. Where the rotor rolls laws know them: M0, M1. Whatever it does, a ball-by-ball interval
//! measures them, and what differs from the laws changes slowly with the speed. So the method is projective integration with means from
//! the motion (heterogeneous multiscale method):
//!
//! ```text
//!   1 interval      batches of the real motion at Ω_k, T_k (interval.rs): power over that of the laws, its error, its growth (batch.rs);
//!                   speed, time and temperatures go on by it
//!   2 step back     the quasi-steady step that led here again, with both of its ends known, along straight lines in the speed (macro_step.rs);
//!                     e = max(|Δt_again − Δt|/(t + t_r), |T_again − T|/50 K),   t_r = I Ω/M
//!                   where e > ε a leap of more than 4 % of speed is taken back and repeated with 0.5 to 0.9 of its length
//!   3 leap          the next step, in the logarithm of the speed
//!                     h = min(0.9 √(ε/e) h_before, what a natural frequency allows, the speed of an event),   and in time
//!                     Δt ≤ t_r/2,   σ Δt ≤ ε (t + t_r),   λ Δt ≤ ln 2,   |ṡ| Δt ≤ 4 %
//!                   The motion comes down with it in jumps of 4 % of speed at most, and ends the leap where it presses harder than before.
//!   4 or not        where Δt is less than the interval took, the motion itself goes on: 1 again, with more batches.
//! ```
//! ε is `coast_down.tolerance`: error of a step in time over the coast-down and in temperature over 50 K, as that of the quasi-steady
//! integration by laws; s the speed of an inner race over that of rolling, σ the relative error of the mean power, λ the growth rate beyond chance of the contact force, or of the motion beside that of the unbalance. All tests of a motion that
//! does not roll, of races that still spin up and of brakes too quick to leap are these: what is not stationary has a large σ or λ.
//!
//! Near a natural frequency (of rotor and mount as rigid body; the pendulum √(g/c0) in the air clearance and its double, where unbalance excites it at
//! half the speed) a leap is no longer than half a jump, or the damping ratio where that is more, and jumps are half of that ratio at most; where unbalance
//! makes a motion grow, it is followed for as long as a factor e takes, λ = e Ω²/(4 g) √(g/c0). The last leap goes to the standstill by laws, what was
//! found beside them fades: where unbalance lifts nothing (e Ω² < g/100), the rotor rolls, and half of what friction transmits suffices.
//!
//! No law knows the losses of a bearing in space: its whole moment is what intervals measure, compared by itself over the speed. The last leap holds it, from a
//! twentieth of the first speed on. An upright rotor is no pendulum; g in these times has its part along the shaft.
//!
//! Sources: C. W. Gear, I. G. Kevrekidis, Projective methods for stiff differential equations, SIAM J. Sci. Comput. 24 (2003) 1091; W. E, B. Engquist,
//! The heterogeneous multiscale methods, Commun. Math. Sci. 1 (2003) 87. Derived: control of steps; book/src/theory/heat.md.
//!
//! Assumes: what a motion does at a speed depends on speed and temperatures, and on the branch it is on. Not modelled: motions that grow more slowly
//! than their scatter shows in an interval; whether a chaotic motion is thrown onto another branch (forward whirl) is one sample.

mod batch;
mod interval;
mod leap;
mod macro_step;
pub(super) mod results;
mod series;
pub(super) mod warnings;

use crate::coast_down::build::{CoastDownModel, Part};
use crate::coast_down::rows::{End, Row};
use crate::coast_down::run::run;
use crate::drop::context::Context;
use crate::following::friction;
use batch::{Batch, Interval, Observation};
use interval::{BATCHES, Failure, Motion, SETTLING};
use leap::{Limits, Mode};
use macro_step::{Ahead, fading, step};
use results::parts;
pub(super) use series::IntervalSeries;
use series::Place;
use std::sync::atomic::{AtomicBool, Ordering};
use thermal::bearing_network::NODES;
use thermal::coast_down::TEMPERATURE_SCALE;

/// Most batches that one estimate takes, in intervals: what was longer ago belongs to another speed.
const LONGEST_ESTIMATE: usize = 4;

/// A leap that is not closed yet.
struct Leap<'a> {
    /// The coast-down and the motion before it, and what was known then.
    before: CoastDownModel,
    motion: Motion<'a>,
    from: Observation,
    batches: Vec<Batch>,
    /// ln of both speeds over each other.
    length: f64,
    settling: usize,
    /// Whether it went as far as it was to.
    whole: bool,
}

/// A coast-down under way.
struct Multirate<'a> {
    context: &'a Context<'a>,
    interrupt: &'a AtomicBool,
    motion: Motion<'a>,
    modes: Vec<Mode>,
    /// Batches since the last leap, and how many of them are left out because they settled.
    batches: Vec<Batch>,
    settling: usize,
    /// ln of the speeds of the next leap by its error.
    length: f64,
    /// Speed at which the coast-down began, rad/s.
    first: f64,
    series: IntervalSeries,
}

/// Why a coast-down is no longer followed.
enum Leave {
    End(End),
    /// From here on it goes by laws.
    Rolls,
}

/// How a leap was closed.
enum Closed {
    Accepted,
    TakenBack,
    Ends(End),
}

/// Follows a coast-down from the end of a drop; `built` starts where it goes on by laws afterwards, or where it ends.
pub(super) fn follow(
    context: &Context,
    built: &mut CoastDownModel,
    interrupt: &AtomicBool,
    progress: &dyn Fn(f64),
) -> IntervalSeries {
    let motion = Motion::after_drop(context, interrupt);
    let mut this = Multirate {
        context,
        interrupt,
        modes: leap::modes(context, &motion),
        motion,
        batches: Vec::new(),
        settling: 0,
        length: leap::JUMP,
        first: built.start.speed,
        series: IntervalSeries::default(),
    };
    let first = this.first;
    let mut open = None;
    let leave = loop {
        progress(1.0 - built.start.speed / first);
        match this.cycle(built, &mut open) {
            Ok(None) => {}
            Ok(Some(leave)) => break leave,
            Err(_) if interrupt.load(Ordering::Relaxed) => break Leave::End(End::Interrupted),
            Err(why) => break Leave::End(End::Lost(why)),
        }
    };
    if let Leave::End(end) = leave {
        built.start.ended = (end != End::Stands).then_some(end);
    }
    this.series.ends(built);
    this.series.steps = this.motion.taken;
    this.series
}

impl<'a> Multirate<'a> {
    /// One interval, and the leap behind it.
    fn cycle(
        &mut self,
        built: &mut CoastDownModel,
        open: &mut Option<Leap<'a>>,
    ) -> Result<Option<Leave>, Failure> {
        if self.interrupt.load(Ordering::Relaxed) {
            return Ok(Some(Leave::End(End::Interrupted)));
        }
        let stands = built.start.speed <= built.end.stop_speed;
        // a leap to the end of the time is closed as any other
        if stands || built.start.time >= built.end.longest && open.is_none() {
            if let Some(leap) = open.take() {
                self.end_leap(built, leap)?;
            }
            let end = if stands { End::Stands } else { End::Late };
            return Ok(Some(Leave::End(end)));
        }
        // a leap that ended where the motion presses harder forgets nothing of it
        let goes_on = open.as_ref().is_some_and(|leap| !leap.whole);
        let settling = match self.batches.is_empty() && !goes_on {
            true => self.settling,
            false => 0,
        };
        let interval = self.motion.interval(built, settling)?;
        let span: f64 = interval.batches.iter().map(|batch| batch.span).sum();
        self.batches.extend(interval.batches.iter().cloned());
        if let Some(first) = interval.changed {
            return self.change(built, &interval, first, open);
        }
        let count = self.batches.len();
        let newest = |left_out: usize| {
            let some = (count - left_out).min(LONGEST_ESTIMATE * BATCHES);
            &self.batches[count - some..]
        };
        let settled: Vec<&Batch> = newest(self.settling).iter().collect();
        let now = Observation::of(built, &settled, &interval.balls).growing(newest(self.settling));
        if Limits::of(built, &now).moment <= 0.0 {
            return Ok(Some(Leave::End(End::Lost("nothing brakes the rotor"))));
        }
        if let Some(leap) = open.take() {
            match self.close(built, leap, &now)? {
                Closed::TakenBack => return Ok(None),
                Closed::Ends(end) => return Ok(Some(Leave::End(end))),
                Closed::Accepted => {}
            }
        }
        self.series.saw(built, &now, &interval, settling);
        let mut mean = now.clone();
        if self.batches.len() > BATCHES {
            let own: Vec<&Batch> = interval.batches.iter().collect();
            mean = Observation::of(built, &own, &interval.balls);
        }
        if let Some(end) = self.follow(built, &mean)? {
            return Ok(Some(Leave::End(end)));
        }
        if self.rolls_to_the_end(built, &now)? {
            return Ok(Some(Leave::Rolls));
        }
        self.leap(built, &now, span, open)
    }

    /// Speed, time and temperatures go on by an interval; why the coast-down ends in it.
    fn follow(
        &mut self,
        built: &mut CoastDownModel,
        mean: &Observation,
    ) -> Result<Option<End>, Failure> {
        let reached = self.motion.speed();
        if reached >= built.start.speed {
            return Ok(None);
        }
        let ahead = Ahead::Followed(mean);
        let taken = step(built, mean, ahead, reached, self.interrupt)?;
        Ok(self.series.took(taken))
    }

    /// Ends an interval from one of whose batches on an unbalance or a load has come: what was known before says nothing of what follows.
    fn change(
        &mut self,
        built: &mut CoastDownModel,
        interval: &Interval,
        first: usize,
        open: &mut Option<Leap<'a>>,
    ) -> Result<Option<Leave>, Failure> {
        if let Some(leap) = open.take() {
            self.end_leap(built, leap)?;
        }
        let own: Vec<&Batch> = interval.batches.iter().collect();
        let mean = Observation::of(built, &own, &interval.balls);
        self.series.saw(built, &mean, interval, 0);
        let ended = self.follow(built, &mean)?;
        let parts = parts(self.context.setup, &self.motion.loads());
        built.parts = parts.map_err(|_| "no bearing carries these loads")?;
        self.modes = leap::modes(self.context, &self.motion);
        self.batches = interval.batches[first..].to_vec();
        self.settling = SETTLING;
        Ok(ended.map(Leave::End))
    }

    /// The next leap, where it is longer than the interval.
    fn leap(
        &mut self,
        built: &mut CoastDownModel,
        now: &Observation,
        span: f64,
        open: &mut Option<Leap<'a>>,
    ) -> Result<Option<Leave>, Failure> {
        let limits = Limits::of(built, now);
        let pace = leap::pace(&self.modes, built.start.speed);
        // a leap ends where a brake comes
        let ahead = built.start.speed / built.brake_below(built.start.speed);
        let changes = built.start.speed / self.motion.changes_below();
        let length = limits.length(self.length.min(pace.leap)).min(ahead.ln());
        let length = length.min(leap::towards(changes.ln()));
        let followed: f64 = self.batches.iter().map(|batch| batch.span).sum();
        let dwell = pace.dwell.min(LONGEST_ESTIMATE as f64 * span);
        // neither the interval nor the jumps of the motion are to take longer than the leap
        let jumps = (length / pace.jump).ceil().max(1.0);
        let longest = span.max(jumps * self.motion.span(built.start.speed));
        if limits.time(length) <= longest || followed < dwell {
            return Ok(None);
        }
        let after = built.start.time - self.context.finished.ending.time;
        self.series.leaps(limits.error, after);
        let (before, motion) = (built.clone(), self.motion.clone());
        let from = built.start.speed;
        let to = from * (-length).exp();
        let taken = step(built, now, Ahead::Unknown, to, self.interrupt)?;
        if taken.end.is_some_and(|end| end != End::Late) {
            *built = before;
            let last = step(built, now, Ahead::Followed(now), to, self.interrupt)?;
            return Ok(self.series.took(last).map(Leave::End));
        }
        let wanted = (from / built.start.speed).ln();
        let jumps = (wanted / pace.jump).ceil().max(1.0) as usize;
        let swept = self.motion.sweep(
            &before,
            (jumps, built.start.speed),
            &leap::hardest(&before, now),
        )?;
        self.series.swept(built, &swept);
        let reached = self.motion.speed();
        let whole = swept.batches.len() == jumps;
        if !whole {
            *built = before.clone();
            step(built, now, Ahead::Unknown, reached, self.interrupt)?;
        }
        *open = Some(Leap {
            length: (from / built.start.speed).ln(),
            before,
            motion,
            from: now.clone(),
            batches: std::mem::take(&mut self.batches),
            settling: self.settling,
            whole,
        });
        self.settling = SETTLING;
        Ok(None)
    }

    /// Ends a leap that no interval closes, with what was known before it.
    fn end_leap(&mut self, built: &mut CoastDownModel, leap: Leap<'a>) -> Result<(), Failure> {
        let mut again = leap.before;
        let known = Ahead::Followed(&leap.from);
        let taken = step(
            &mut again,
            &leap.from,
            known,
            built.start.speed,
            self.interrupt,
        )?;
        self.series.took(taken);
        *built = again;
        Ok(())
    }

    /// Closes a leap: its step again, with both ends known.
    fn close(
        &mut self,
        built: &mut CoastDownModel,
        leap: Leap<'a>,
        now: &Observation,
    ) -> Result<Closed, Failure> {
        let predicted = &built.start;
        let mut again = leap.before.clone();
        let ahead = Ahead::Followed(now);
        let taken = step(
            &mut again,
            &leap.from,
            ahead,
            predicted.speed,
            self.interrupt,
        )?;
        let nodes = again.start.temperatures.iter().zip(&predicted.temperatures);
        let warmer = nodes.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let whole = Limits::of(&leap.before, &leap.from).whole_time();
        let later = (again.start.time - predicted.time).abs() / whole;
        let error = later.max(warmer / TEMPERATURE_SCALE);
        if !error.is_finite() {
            return Err("a quasi-steady step has no finite error");
        }
        let tolerance = built.end.tolerance;
        let factor = (0.9 * (tolerance / error).sqrt()).clamp(0.5, 2.0);
        if error > tolerance && leap.length > leap::JUMP {
            let steps = self.motion.taken;
            (*built, self.motion) = (leap.before, leap.motion);
            self.motion.taken = steps;
            (self.batches, self.settling) = (leap.batches, leap.settling);
            self.length = factor.min(0.9) * leap.length;
            return Ok(Closed::TakenBack);
        }
        let largest = self
            .series
            .step_error
            .map_or(error, |before| before.max(error));
        self.series.step_error = Some(largest);
        if leap.whole {
            // a leap that something else kept short says nothing against a longer one
            let short = leap.length < 0.9 * self.length;
            self.length = match short && factor > 1.0 {
                true => self.length,
                false => factor * leap.length,
            };
        }
        *built = again;
        Ok(match self.series.took(taken) {
            Some(end) => Closed::Ends(end),
            None => Closed::Accepted,
        })
    }

    /// Whether laws describe the rest: the rotor rolls, unbalance lifts nothing, and friction transmits twice what the bearings brake with. Where no law
    /// knows a bearing, its moment is held from a low speed on.
    fn rolls_to_the_end(
        &mut self,
        built: &mut CoastDownModel,
        now: &Observation,
    ) -> Result<bool, Failure> {
        let mut calm = built.start.speed < leap::calm(&self.motion);
        calm &= built.by_laws() || built.start.speed <= leap::HELD * self.first;
        if !calm || self.motion.changes_below() > 0.0 || !leap::rolls(built, now) {
            return Ok(false);
        }
        let mut rest = built.clone();
        rest.motion = Some(fading(built, now));
        let course = run(&rest, self.interrupt).map_err(|_| "no network")?;
        let rows = course.free.rows.iter().skip(built.start.rows.len());
        let slips = |row: &Row| {
            let mut parts = built.parts.iter().enumerate();
            parts.any(|(k, part)| {
                // an upright rotor leans on no guide
                if !part.by_laws || part.warm.radial_load == 0.0 {
                    return false;
                }
                let moment = row.bearings[k].moment / part.losses.count;
                moment > leap::TRANSMITS * self.transmitted(k, part, row)
            })
        };
        if rows.into_iter().any(slips) {
            return Ok(false);
        }
        built.motion = rest.motion.take();
        if !built.by_laws() {
            self.series.held = Some(Place::of(built));
        }
        Ok(true)
    }

    /// Moment that friction of rotor and race transmits, N m.
    fn transmitted(&self, k: usize, part: &Part, row: &Row) -> f64 {
        let contact = &self.context.setup.machine.constants.bearings[k].contact;
        let temperatures = &row.temperatures[k * NODES.len()..][..NODES.len()];
        friction(self.context.setup.given(k), temperatures, None)
            * part.warm.radial_load
            * (contact.bore_radius - contact.radial_clearance)
    }
}
