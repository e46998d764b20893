//! What events of a machine may not be together.

use crate::drop::case::Cases;
use crate::drop::event::{Event, Happening, Happens, LOST_AT, MagnetEvent, When};
use crate::drop::kinds::SpinKind;
use crate::key::quoted;
use crate::rotor::FlexibleRotor;
use crate::rotor::keys::EVENT;
use crate::rotor::levitation::Magnets;
use crate::rotor::tables::Part;
use crate::run::Until;
use crate::values::Values;
use problem::words::Words;
use problem::{Code, Result};
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// Most unbalances that come: as many as a machine of the model has.
pub const MOST_UNBALANCES: usize = 16;
/// Most different speeds that events wait for.
pub const MOST_SPEEDS: usize = 4;
/// Most nodes at which loads come.
pub const MOST_LOADED: usize = 4;

/// Keys of what happens besides its name and when, those that are needed first.
pub(super) fn keys_of(what: Happening) -> (&'static [&'static str], &'static [&'static str]) {
    const AXIS: &[&str] = &["magnet", "axis"];
    match what {
        Happening::PowerLost => (&[], &["decay_time"]),
        Happening::MagnetLost => (&["magnet"], &["decay_time"]),
        Happening::AxisLost => (AXIS, &["decay_time"]),
        Happening::SensorStuck | Happening::SensorDead | Happening::ControllerFrozen => (&[], AXIS),
        Happening::SensorOffset => (&["offset"], AXIS),
        Happening::SensorNoise => (&["deviation"], &["magnet", "axis", "period", "seed"]),
        Happening::AmplifierLimit => (&[], &["magnet", "axis", "largest_current", "slew_rate"]),
        Happening::Relevitate => (&["bias_time"], &["reference_time", "within", "hold"]),
        Happening::AxialMagnetLost => (&[], &[]),
        Happening::Brake | Happening::Drive => (&["torque"], &[]),
        Happening::Load => (&["node"], &["force_x", "force_y"]),
        Happening::Unbalance => (&["plane", "amount"], &["phase"]),
    }
}

/// The loss of an axial magnet that there is.
pub(super) fn axial_magnet_lost(
    part: &Part,
    magnets: Option<&Magnets>,
    values: &Values,
) -> Result<Happens> {
    let axial = "levitation.axial_stiffness";
    let found = match magnets {
        None => "the loss of an axial magnet beside supports, which let go at the start",
        Some(_) if values.number(axial).is_none() => "the loss of an axial magnet without it",
        Some(_) => return Ok(Happens::AxialMagnetLost),
    };
    let allowed =
        "[[levitation.magnet]], and levitation.axial_stiffness of the axial one, are needed";
    part.refuse(Code::LevitationParts, "do", found, allowed)
}

/// Refuses events that contradict each other or what keys say, and those that no run of the file has.
pub(super) fn check(parts: &[&Part], events: &[Event], values: &Values) -> Result<()> {
    let speed = values.number("rotor.speed").unwrap_or_default().abs();
    let drives = |own: &Event| matches!(own.what, Happens::Drive(torque) if torque > 0.0);
    let keys = ["rotor.drive_torque", "rotor.torque_over_speed"];
    let driven = events.iter().any(drives) || keys.iter().any(|path| values.is_own(path));
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
        if part.word("do") == Some("power lost") && values.is_own(LOST_AT) {
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
        let nodes = events[..=k].iter().filter_map(|own| match own.what {
            Happens::Load { node, .. } => Some(node),
            _ => None,
        });
        if nodes.collect::<BTreeSet<_>>().len() > MOST_LOADED {
            let found = "a fifth node at which loads come";
            return part.refuse(Code::OutOfRange, "node", found, "at most four are possible");
        }
        if let When::Speed {
            speed: own, rising, ..
        } = event.when
        {
            let there = if rising { speed >= own } else { speed <= own };
            let key = ["below_speed", "above_speed"][usize::from(rising)];
            if there && !driven && part.known.contains_key(key) {
                let side = ["below", "above"][usize::from(rising)];
                let found = format!("a rotor that is {side} it from the start on");
                let allowed = "a speed that the rotor comes to during the run is needed, a drive that brings it beyond, or at = \"0 s\"";
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

/// Refuses what a coast-down until the standstill cannot follow: its quasi-steady part begins after the last known event, of a rotor without
/// power and drive, and lands on speeds at which a brake, an unbalance or a load comes.
pub(super) fn until_standstill(
    parts: &[&Part],
    events: &[Event],
    axes: usize,
    values: &Values,
) -> Result<()> {
    if values.chosen("run.until") != Some(Until::Standstill) {
        return Ok(());
    }
    let end = values.number("run.duration").unwrap_or_default();
    let known = |event: &&Event| matches!(event.when, When::At(_));
    let mut known: Vec<&Event> = events.iter().filter(known).collect();
    known.sort_by(|a, b| a.when.partial_cmp(&b.when).unwrap_or(Ordering::Equal));
    let (mut lost, mut off) = (BTreeSet::<&usize>::new(), None);
    for event in known {
        match &event.what {
            Happens::Magnets(axes, MagnetEvent::Lost(_)) => lost.extend(axes),
            Happens::Magnets(_, MagnetEvent::Relevitated(_)) => lost.clear(),
            Happens::Drive(torque) => off = (*torque == 0.0).then_some(event.when),
            _ => {}
        }
    }
    let any_again = events.iter().any(Event::relevitates);
    for (part, event) in parts.iter().zip(events) {
        let of_magnets = event.what.axes().is_some();
        let (key, found) = match (&event.what, event.when) {
            (_, When::Speed { .. }) if of_magnets => ("do", "an event of magnets by a speed"),
            (_, When::Speed { delay, .. }) if delay > 0.0 => ("delay", "a delay after a speed"),
            (Happens::Drive(torque), when)
                if *torque > 0.0 && off.is_none_or(|off| when >= off) =>
            {
                ("torque", "a drive that stays on")
            }
            (_, When::At(time)) if time > end => ("", "an instant after run.duration"),
            _ if of_magnets && lost.len() < axes && (event.relevitates() || !any_again) => {
                ("do", "magnets that keep power")
            }
            _ => continue,
        };
        let found = format!("{found} beside run.until = \"standstill\"");
        let allowed = "run.until = \"duration\" is needed for it: after run.duration quasi-steady steps follow, without power and drive; they land on speeds of brakes, drives that end, loads and unbalances";
        return part.refuse(Code::Conflict, key, found, allowed);
    }
    Ok(())
}

impl Event {
    /// Whether the rotor is levitated again by it.
    pub fn relevitates(&self) -> bool {
        matches!(self.what, Happens::Magnets(_, MagnetEvent::Relevitated(_)))
    }
}

/// Refuses cases of which none is of magnets where no key says when these lose their power: by its default all would begin with a fall.
pub(super) fn check_loss(
    cases: &Cases,
    parts: &[Part],
    rotor: &FlexibleRotor,
    values: &Values,
) -> Result<()> {
    let events = parts.iter().filter(|own| own.kind.word == EVENT);
    let mut happenings = events.filter_map(|part| part.word("do").and_then(Happening::of_word));
    let is_held = rotor.levitation.is_some();
    if cases.names.is_empty() || !is_held || values.is_own(LOST_AT) {
        return Ok(());
    }
    match happenings.any(Happening::is_of_magnets) {
        true => Ok(()),
        false => {
            let found = "cases without an event of magnets, which would all begin with the loss of their power";
            let needed = "the instant of that loss is needed: 0 s where each case begins with the fall, later than run.duration where the magnets hold the rotor to the end";
            values.refuse(Code::MissingKey, LOST_AT, found, needed)
        }
    }
}

/// Refuses a re-levitation of a rotor that was not lost before, and an event with the name of that of a key.
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
            Happens::Magnets(axes, MagnetEvent::Lost(_)) => Some(axes),
            _ => None,
        });
        lost.flatten().collect::<BTreeSet<_>>().len() == axes
    };
    for (part, event) in parts.iter().zip(events) {
        let of_key = |own: &&Event| own.by_key && own.name == event.name;
        if let Some(own) = events.iter().find(of_key) {
            let found = format!("{}, as that of {LOST_AT} is called", quoted(&own.name));
            return part.refuse(Code::Conflict, "name", found, "another name is needed");
        }
        if event.relevitates() && !lost_before(event) {
            let found = "a re-levitation before the loss of all power";
            let allowed = "an event with do = \"power lost\" before it, or levitation.power_lost_at, is needed";
            return part.refuse(Code::Conflict, "do", found, allowed);
        }
    }
    Ok(())
}
