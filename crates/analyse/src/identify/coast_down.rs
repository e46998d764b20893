//! Slow tests of which no torque was measured: M from the inertia and the slope of the speed.

use crate::identify::notes::{IdentifyWarning, noted};
use crate::identify::read::Test;
use crate::signals;
use identify::Measurement;
use identify::coasting::{Coasting, Windage, coasting};
use outcome::Warning;
use physics::rolling::RollingSet;
use problem::note;
use std::sync::atomic::AtomicBool;

/// A coast-down of which no torque was measured, and the windage that was taken out of it.
pub(super) fn coasted(
    test: &Test,
    set: &RollingSet<f64>,
    interrupt: &AtomicBool,
    lines: &mut Vec<Warning>,
) -> Result<(Measurement, Option<Windage>), String> {
    let found = signals::find(&test.asked, interrupt);
    lines.extend(noted(test, &found));
    let shaft =
        (found.shaft.as_ref()).ok_or_else(|| format!("no speed: {}", found.why("speed")))?;
    let wish = (test.signals.steady.as_ref())
        .ok_or("signals.steady.from, to and inertia are needed without a torque")?;
    let windage = match wish.windage {
        Some(_) => Some(signals::windage(wish, &test.asked, interrupt)?),
        None => None,
    };
    let (clock, speed, inertia) = signals::steady::coasted(wish, shaft)?;
    let measurement = coasting(&Coasting {
        name: &test.name,
        load: test.load.unwrap_or(0.0),
        clock,
        speed: &speed,
        inertia,
        windage: windage.as_ref(),
        set,
    })?;
    let besides = match windage {
        Some(_) => ", less the windage",
        None => "; air and other bearings on the shaft are in it (signals.steady.windage_*)",
    };
    let note = note!(
        "no torque was measured: M is the inertia times the deceleration{}",
        besides
    );
    lines.push(Warning::from(IdentifyWarning::Remark { note }).of_part(&test.name));
    Ok((measurement, windage))
}

/// The windage that leaves most open at the largest speed it knows.
pub(super) fn largest(windages: Vec<(Windage, f64)>) -> Option<(Windage, f64)> {
    let open = |windage: &Windage| {
        let speeds = (1..200).map(|k| 10.0 * f64::from(k));
        let known = speeds.filter_map(|speed| windage.covariance(speed, speed));
        known.fold(0.0, f64::max)
    };
    windages
        .into_iter()
        .max_by(|a, b| open(&a.0).total_cmp(&open(&b.0)))
}
