//! Back from slow time to motion, where a rotor that runs out by laws rolls no longer.
//!
//! The run-out is computed by laws to its end, and the motion comes down along it (`glide.rs`) as far as anything may disturb it:
//!
//! ```text
//!   e Ω² > g/100             unbalance
//!   2 M > μ W r             of a bearing: what its friction carries of the rotor's braking
//! ```
//! Where it rolls no longer windows ball by ball follow (`windows.rs`) until two of them agree with the laws, and then laws again. Speed, temperatures,
//! heats and time go on as they are at both changes. Where a window does not end the run ends: laws do not know what happens there.
//!
//! Not modelled: that a rotor which passes a resonance in less than its motion needs to build up is lifted less than in a window, which
//! holds its speed.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::coast_down::build::{Built, Part};
use crate::coast_down::ran::{Ran, ran};
use crate::coast_down::rows::{End, Row};
use crate::drop::context::Context;
use crate::drop::feedback::friction;
use crate::drop::glide::{Foreseen, Other, calm};
use crate::drop::window::{Last, Way};
use crate::drop::windows::{self, Bounced};
use problem::Problem;
use std::sync::atomic::AtomicBool;
use thermal::bearing_network::NODES;

/// Share of what friction carries from which on what a bearing brakes is looked at.
const BRAKES: f64 = 0.5;

/// One return.
#[derive(Clone, Debug)]
pub(super) struct Return {
    pub why: Other,
    /// s and rad/s at its begin and at its end.
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub windows: Bounced,
    /// Kinetic energy of the run-out that goes on less that of the motion, J.
    pub change: f64,
}

/// Where a run-out by laws went back, and what was seen on its way.
#[derive(Default)]
pub(super) struct Returned {
    pub list: Vec<Return>,
    pub glanced: Bounced,
}

/// Follows a run-out back into motion wherever it must; `built` starts behind the last return afterwards.
pub(super) fn follow(
    context: &Context,
    (built, motion): (&mut Built, &mut Last),
    interrupt: &AtomicBool,
) -> Result<Returned, Box<Problem>> {
    let mut returned = Returned::default();
    while built.start.ended.is_none() {
        let by_laws = ran(built, interrupt)?;
        let way_of_laws = (&by_laws.start(), quiet(context, &by_laws));
        let mut way = Way::from(context, motion, interrupt);
        let glanced = &mut returned.glanced;
        let found = way.down(
            built,
            way_of_laws,
            &Foreseen::rolling(built),
            |start, seen| {
                glanced.glanced(start, seen);
            },
        );
        glanced.steps += way.steps;
        let Some((speed, why)) = found else {
            break;
        };
        let mut until = built.clone();
        until.end.stop_speed = speed;
        let found = ran(&until, interrupt)?;
        if found.free.end != End::Stands {
            break;
        }
        built.start = found.start();
        let start = [built.start.time, built.start.speed];
        let bounced = windows::follow(context, (built, motion), false, interrupt);
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

/// The speed below which nothing disturbs a rotor that runs out by laws, rad/s.
fn quiet(context: &Context, found: &Ran) -> f64 {
    let brakes = |row: &&Row| {
        let of_bearing = |(k, part): (usize, &Part)| {
            let asked = row.bearings[k].moment / f64::from(found.built.sides);
            asked > BRAKES * carried(context, k, part, row)
        };
        found.parts().any(of_bearing)
    };
    let rows = &found.free.rows[found.built.start.rows.len()..];
    let slow = rows.last().map_or(0.0, |row| row.speed);
    let brakes = (rows.iter().rev().find(brakes)).map_or(f64::INFINITY, |row| row.speed);
    calm(context).min(brakes).max(slow)
}

/// Moment that friction of rotor and race carries, N m.
fn carried(context: &Context, k: usize, part: &Part, row: &Row) -> f64 {
    let contact = &context.setup.machine.constants.bearings[k].contact;
    let temperatures = &row.temperatures[k * NODES.len()..][..NODES.len()];
    friction(context.setup.given(k), temperatures)
        * part.warm.radial_load
        * (contact.bore_radius - contact.radial_clearance)
}

impl Return {
    /// Whether the rotor was lifted; otherwise friction no longer carried it, or it could not be followed.
    pub fn lifts(&self) -> bool {
        match self.why {
            Other::Force { .. } => true,
            Other::Power(ratio) => ratio > 1.0,
            Other::Broken => false,
        }
    }
    /// In words.
    pub fn words(&self, parts: &[Part]) -> String {
        let why = match self.why {
            Other::Power(ratio) => {
                let more = if ratio > 1.0 { "more" } else { "less" };
                let by = 100.0 * (ratio - 1.0).abs();
                format!("because it lost {by:.1} % {more} than laws say")
            }
            Other::Force { bearing, force } => {
                let part = &parts[bearing];
                let on = match part.name.as_str() {
                    "" => String::new(),
                    name => format!(" on {name}"),
                };
                let rest = part.warm.radial_load;
                format!("because it pressed{on} with {force:.0} N, {rest:.0} N at rest")
            }
            Other::Broken => "because its motion could not be followed".to_string(),
        };
        let [time, speed] = self.from;
        let [until, slower] = self.to;
        format!(
            "From {time:.4} s and {speed:.1} rad/s to {until:.4} s and {slower:.1} rad/s it was followed in {} windows ball by ball again, {why}.",
            self.windows.scatter.len()
        )
    }
}
