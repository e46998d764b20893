//! What events of a machine may not be together.

use crate::drop::event::{Event, Happens, LOST_AT, When};
use crate::drop::kinds::SpinKind;
use crate::key::quoted;
use crate::rotor::levitation::Magnets;
use crate::rotor::tables::Part;
use crate::run::Until;
use crate::values::Values;
use problem::{Code, Result};
use std::collections::BTreeSet;

/// Most unbalances that come.
const MOST_UNBALANCES: usize = 16;

/// Most different speeds that events wait for.
const MOST_SPEEDS: usize = 4;

/// Refuses events that contradict each other or what keys say, and those that no run of the file has.
pub(super) fn check(parts: &[&Part], events: &[Event], values: &Values) -> Result<()> {
    let Some(first) = parts.first() else {
        return Ok(());
    };
    if values.chosen("run.until") == Some(Until::Standstill) {
        let found = "an event beside run.until = \"standstill\"";
        let allowed = "run.until = \"duration\" is needed: the coast-down knows no events";
        return first.refuse(Code::Conflict, "", found, allowed);
    }
    let speed = values.number("rotor.speed").unwrap_or_default().abs();
    let mut speeds = Vec::new();
    for (k, (part, event)) in parts.iter().zip(events).enumerate() {
        let brakes = matches!(event.what, Happens::Brake(_));
        let turns = brakes || matches!(event.what, Happens::Drive(_));
        if turns && values.chosen("rotor.spin") == Some(SpinKind::Held) {
            let found = "a brake or a drive beside rotor.spin = \"held\"";
            let allowed = "a rotor whose spin is not held is needed";
            return part.refuse(Code::Conflict, "do", found, allowed);
        }
        if brakes && values.is_own("rotor.brake_torque") {
            let place = values.place("rotor.brake_torque").line();
            let found = format!("a brake beside rotor.brake_torque{}", line(place));
            return part.refuse(Code::Conflict, "do", found, "one of the two is needed");
        }
        if let (Happens::Lost { .. }, Some("power lost")) = (&event.what, part.word("do"))
            && values.is_own(LOST_AT)
        {
            let place = values.place(LOST_AT).line();
            let found = format!("a loss of all power beside {LOST_AT}{}", line(place));
            return part.refuse(Code::Conflict, "do", found, "one of the two is needed");
        }
        if let Some(other) = events[..k]
            .iter()
            .find(|other| same_instant(other.when, event.when) && other.what.conflicts(&event.what))
        {
            let found = format!(
                "what contradicts the event {} at the same instant",
                quoted(&other.name)
            );
            let allowed = "another instant, or one of the two, is needed";
            return part.refuse(Code::Conflict, "do", found, allowed);
        }
        let unbalances = |list: &[Event]| {
            let own = |event: &&Event| matches!(event.what, Happens::Unbalance { .. });
            list.iter().filter(own).count()
        };
        if unbalances(&events[..=k]) > MOST_UNBALANCES {
            let found = "a seventeenth unbalance that comes";
            return part.refuse(
                Code::OutOfRange,
                "do",
                found,
                "at most sixteen are possible",
            );
        }
        if let When::Speed {
            speed: own, rising, ..
        } = event.when
        {
            let there = if rising { speed >= own } else { speed <= own };
            let key = ["below_speed", "above_speed"][usize::from(rising)];
            if there && part.known.contains_key(key) {
                let side = ["below", "above"][usize::from(rising)];
                let found = format!("a rotor that is {side} it from the start on");
                let allowed =
                    "a speed that the rotor comes to during the run is needed, or at = \"0 s\"";
                return part.refuse(Code::OutOfRange, key, found, allowed);
            }
            if !speeds.contains(&(own, rising)) {
                speeds.push((own, rising));
            }
            if speeds.len() > MOST_SPEEDS {
                let found = "a fifth speed that events wait for";
                return part.refuse(Code::OutOfRange, key, found, "at most four are possible");
            }
        }
    }
    Ok(())
}

/// Whether two events come at one instant but for rounding.
fn same_instant(a: When, b: When) -> bool {
    match (a, b) {
        (When::At(a), When::At(b)) => (a - b).abs() <= 1e-12 * a.abs().max(b.abs()),
        (a, b) => a == b,
    }
}

fn line(line: Option<usize>) -> String {
    line.map_or(String::new(), |line| format!(" in line {line}"))
}

/// Refuses a re-levitation of a rotor that was not lost before, or whose hold is longer than the run.
pub(super) fn relevitated(
    parts: &[&Part],
    events: &[Event],
    magnets: Option<&Magnets>,
) -> Result<()> {
    let axes = magnets.map_or(0, |own| 2 * own.magnets.len());
    // by one event or by several
    let lost_before = |event: &Event| {
        let before = events
            .iter()
            .filter(|other| match (other.when, event.when) {
                (When::At(lost), When::At(again)) => lost < again,
                _ => true,
            });
        let lost = before.filter_map(|other| match &other.what {
            Happens::Lost { axes, .. } => Some(axes),
            _ => None,
        });
        lost.flatten().collect::<BTreeSet<_>>().len() == axes
    };
    for (part, event) in parts.iter().zip(events) {
        let again = matches!(event.what, Happens::Relevitate(_));
        if again && !lost_before(event) {
            let found = "a re-levitation before the loss of all power";
            let allowed = "an event with do = \"power lost\" before it, or levitation.power_lost_at, is needed";
            return part.refuse(Code::Conflict, "do", found, allowed);
        }
    }
    Ok(())
}
