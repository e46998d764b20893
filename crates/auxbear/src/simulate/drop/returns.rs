//! Back from slow time to motion, where a run-out by laws comes to what no law of a rolling rotor knows.
//!
//! ```text
//!   resonance   0.95 f < Ω < 1.05 f of a natural frequency at which windows lose a tenth more than laws say
//!   traction    1.2 M > μ W r of a bearing: what its friction carries of the rotor's braking
//! ```
//! The run-out is computed by laws to the first of these; from there on windows ball by ball follow (`windows.rs`) until the stretch is behind
//! and two of them agree with the laws, and then laws again. Speed, temperatures, heats and time go on as they are at both changes.
//!
//! Where a window does not end the run ends: laws do not know what happens there.
//!
//! Not modelled: that a rotor which passes a resonance in less than its motion needs to build up is lifted less than in a window, which
//! holds its speed.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::problem::Problem;
use crate::simulate::coast_down::build::{Built, Part};
use crate::simulate::coast_down::ran::{Ran, ran};
use crate::simulate::coast_down::rows::{End, Row};
use crate::simulate::drop::context::Context;
use crate::simulate::drop::feedback::friction;
use crate::simulate::drop::window::Last;
use crate::simulate::drop::windows::{self, Bounced, NEAR, Near, Stretch};
use std::sync::atomic::AtomicBool;
use thermal::bearing_network::NODES;

/// Share of what friction carries that a bearing may ask of it.
const MARGIN: f64 = 1.2;
/// Most returns of a run-out.
const MOST: usize = 12;

/// Why a run-out goes back to motion.
#[derive(Clone, Debug)]
pub(super) enum Why {
    /// It comes near a natural frequency, rad/s, at which the rotor does not roll.
    Resonance(f64),
    /// This bearing brakes nearly as hard as its friction carries.
    Traction(String),
}

/// One return.
#[derive(Clone, Debug)]
pub(super) struct Return {
    pub why: Why,
    /// s and rad/s at its begin and at its end.
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub windows: Bounced,
    /// Kinetic energy of the run-out that goes on less that of the motion, J.
    pub change: f64,
}

/// What a run-out by laws passes, and where it went back.
#[derive(Default)]
pub(super) struct Returned {
    /// Natural frequencies passed, rad/s, and what windows find there.
    pub passed: Vec<f64>,
    pub near: Vec<Near>,
    pub list: Vec<Return>,
    /// Steps of the windows that looked.
    pub looked: u64,
}

/// Follows a run-out back into motion wherever it must; `built` starts behind the last return afterwards.
pub(super) fn follow(
    context: &Context,
    (built, motion): (&mut Built, &mut Last),
    frequencies: &[f64],
    interrupt: &AtomicBool,
) -> Result<Returned, Box<Problem>> {
    let found = ran(built, interrupt)?;
    let last = found.free.rows.last().map_or(0.0, |row| row.speed);
    let mut passed: Vec<f64> = (frequencies.iter().copied())
        .filter(|frequency| *frequency > last)
        .collect();
    let (near, looked) = windows::looked_at(context, (&found, motion), &passed, interrupt);
    passed.truncate(near.len());
    let mut returned = Returned {
        passed,
        near,
        list: Vec::new(),
        looked,
    };
    while returned.list.len() < MOST && built.start.ended.is_none() {
        let found = ran(built, interrupt)?;
        let Some((from, stretch, why)) = next(context, &found, &returned) else {
            break;
        };
        let mut until = built.clone();
        until.end.stop_speed = from;
        let found = ran(&until, interrupt)?;
        if found.free.end != End::Stands {
            break;
        }
        built.start = found.start();
        let start = [built.start.time, built.start.speed];
        let bounced = windows::follow(context, (built, motion), stretch, frequencies, interrupt);
        let speed = built.start.speed;
        let after = 0.5 * built.inertia * speed * speed;
        let sides = f64::from(built.sides);
        returned.list.push(Return {
            why,
            from: start,
            to: [built.start.time, speed],
            change: (bounced.kinetic).map_or(0.0, |motion| after - sides * motion),
            windows: bounced,
        });
    }
    Ok(returned)
}

/// Where a run-out by laws must go back to motion next: from this speed on, how, and why.
fn next(context: &Context, found: &Ran, returned: &Returned) -> Option<(f64, Stretch, Why)> {
    let start = found.built.start.speed;
    let lifting = (returned.passed.iter().zip(&returned.near))
        .filter(|(frequency, near)| near.lifts() && NEAR[1] * **frequency < start)
        .map(|(frequency, near)| {
            let stretch = Stretch {
                until: NEAR[1] * frequency,
                fine: NEAR[0] * frequency,
                rolls: false,
            };
            let why = Why::Resonance(*frequency);
            ((near.from * frequency).min(start), stretch, why)
        });
    lifting
        .chain(sliding(context, found))
        .max_by(|a, b| a.0.total_cmp(&b.0))
}

/// Where friction hardly carries what a bearing brakes.
fn sliding(context: &Context, found: &Ran) -> Option<(f64, Stretch, Why)> {
    let by_laws = found.built.start.rows.len();
    let rows = found.free.rows.get(by_laws..)?;
    let asks = |row: &Row| {
        found
            .parts()
            .find(|(k, part)| slides(context, found, *k, part, row))
    };
    let at = rows.iter().position(|row| asks(row).is_some())?;
    let (_, part) = asks(&rows[at])?;
    let behind = rows[at..].iter().find(|row| asks(row).is_none());
    let stretch = Stretch {
        until: behind.or(rows.last())?.speed,
        fine: 0.0,
        rolls: false,
    };
    let why = Why::Traction(part.name.clone());
    (stretch.until < rows[at].speed).then_some((rows[at].speed, stretch, why))
}

/// Whether a bearing brakes nearly as hard as friction of rotor and race carries.
fn slides(context: &Context, found: &Ran, k: usize, part: &Part, row: &Row) -> bool {
    let asked = MARGIN * row.bearings[k].moment / f64::from(found.built.sides);
    asked > carried(context, k, part, row)
}

/// Moment that friction of rotor and race carries, N m.
fn carried(context: &Context, k: usize, part: &Part, row: &Row) -> f64 {
    let contact = &context.machine.constants.bearings[k].contact;
    let temperatures = &row.temperatures[k * NODES.len()..][..NODES.len()];
    friction(context.given(k), temperatures)
        * part.warm.radial_load
        * (contact.bore_radius - contact.radial_clearance)
}

/// Moment of a bearing by laws where friction carries the least of it, and what it carries there, N m, if it may not carry it; none where windows
/// followed it.
pub(super) fn asked(context: &Context, found: &Ran, k: usize, part: &Part) -> Option<[f64; 2]> {
    // the last row of a run that ended between windows is theirs
    let by_laws = found.built.motion.is_none();
    let rows = by_laws.then(|| found.free.rows.get(found.built.start.rows.len()..))??;
    let lost = rows
        .iter()
        .filter(|row| slides(context, found, k, part, row));
    let sides = f64::from(found.built.sides);
    let both = lost.map(|row| {
        let asked = row.bearings[k].moment / sides;
        [asked, carried(context, k, part, row)]
    });
    both.max_by(|a, b| (a[0] / a[1]).total_cmp(&(b[0] / b[1])))
}

impl Return {
    /// In words.
    pub fn words(&self) -> String {
        let why = match &self.why {
            Why::Resonance(frequency) => format!(
                "near the natural frequency of {frequency:.0} rad/s, where it does not roll"
            ),
            Why::Traction(name) if name.is_empty() => {
                "where friction of rotor and race hardly carries what the bearing brakes"
                    .to_string()
            }
            Why::Traction(name) => {
                format!("where friction of rotor and race hardly carries what {name} brakes")
            }
        };
        let [time, speed] = self.from;
        let [until, slower] = self.to;
        format!(
            "From {time:.4} s and {speed:.1} rad/s to {until:.4} s and {slower:.1} rad/s it was followed in {} windows ball by ball again, {why}.",
            self.windows.scatter.len()
        )
    }
}
