//! What happened to a machine, and when; whether it was levitated again.

use crate::drop::context::{Context, Setup};
use crate::drop::magnets::value_of;
use crate::drop::warning_table::ShaftWarning;
use crate::drop::{Drop, Shaft};
use crate::rotor::LevitationModel;
use levitation::ClosedLoop;
use levitation::response::Loaded;
use outcome::Warning;
use outcome::list::{List, origins, results};
use scenario::{Event, Happens, Relevitation, When};
use std::collections::BTreeSet;

/// The events of a machine besides a loss of power that its keys give.
fn events(given: &Shaft) -> impl Iterator<Item = &Event> {
    given.events.iter().filter(|event| !event.by_key)
}

/// How and when a rotor is levitated again, each time.
fn relevitations(drop: &Drop) -> impl DoubleEndedIterator<Item = (Relevitation, When)> + '_ {
    let again = |event: &Event| match event.what {
        Happens::Relevitate(own) => Some((own, event.when)),
        _ => None,
    };
    let shaft = drop.shaft.iter();
    shaft.flat_map(|own| &own.events).filter_map(again)
}

/// Share of the clearance within which a rotor that is levitated again must stay.
pub(super) fn within(drop: &Drop) -> Option<f64> {
    relevitations(drop).map(|(own, _)| own.within).next_back()
}

/// The last instant at which something known before the run happens, s.
pub(super) fn last(drop: &Drop) -> f64 {
    let known = |event: &Event| match event.when {
        When::At(time) => Some(time),
        When::Speed { .. } => None,
    };
    let events = drop.shaft.iter().flat_map(|own| &own.events);
    events.filter_map(known).fold(0.0, f64::max)
}

/// How quickly the rotor leaves the middle after each event that cuts loops: a cut axis keeps k_s, a lost one has neither k_i nor k_s.
pub(super) fn growths(
    events: &[Event],
    model: &LevitationModel,
    loaded: &Loaded,
) -> Result<Vec<(String, f64)>, levitation::Refused> {
    let mut all = Vec::new();
    for event in events {
        let cut = match &event.what {
            Happens::Lost { axes, .. } => (axes, 0.0),
            Happens::SensorStuck(axes) | Happens::SensorDead(axes) => (axes, 1.0),
            Happens::ControllerFrozen(axes) => (axes, 1.0),
            _ => continue,
        };
        // without any magnet it falls
        if cut.0.len() == loaded.rest.slopes.len() && cut.1 == 0.0 {
            continue;
        }
        let mut slopes = loaded.rest.slopes.clone();
        for axis in cut.0 {
            slopes[*axis] = (0.0, cut.1 * slopes[*axis].1);
        }
        let plant = loaded.closed.plant().clone();
        let poles = ClosedLoop::about(plant, &model.levitation, slopes)?.poles()?;
        let largest = poles.iter().map(|pole| pole.value.re);
        all.push((
            event.name.clone(),
            largest.fold(f64::NEG_INFINITY, f64::max),
        ));
    }
    Ok(all)
}

/// When an event happened, s; none where the rotor did not come to its speed.
fn time_of(when: When, context: &Context) -> Option<f64> {
    match when {
        When::At(time) => Some(time),
        When::Speed {
            speed,
            rising,
            delay,
        } => {
            let mut speeds = context.setup.machine.constants.at_speeds.iter();
            let at = speeds.position(|own| own.speed == speed && own.rising == rising)?;
            let reached = context.reached[at];
            reached.is_finite().then_some(reached + delay)
        }
    }
}

/// A rotor after it was levitated again.
struct Again {
    /// When, s.
    time: f64,
    /// When it was last outside the share of a clearance, s.
    outside: Option<f64>,
    /// End of its last contact, s.
    contact: Option<f64>,
    /// Whether it was held.
    held: bool,
}

impl Again {
    fn of(context: &Context) -> Option<Self> {
        let record = &context.finished.record;
        let end = context.finished.ending.time;
        // the last of those that happened to a rotor without power
        let happened = relevitations(context.setup.drop()).filter_map(|(own, when)| {
            let time = time_of(when, context).filter(|time| *time <= end)?;
            record
                .lost
                .is_some_and(|(lost, _)| lost < time)
                .then_some((own, time))
        });
        let (own, time) = happened.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let after = |last: Option<f64>| last.filter(|last| *last >= time);
        let all = record.within.iter().flat_map(|(_, outside)| outside);
        let outside = all.filter_map(|last| after(*last)).reduce(f64::max);
        let contacts = record.bearings.iter().filter_map(|own| own.contacts.last());
        let contact = contacts
            .filter_map(|own| after(Some(own.end.unwrap_or(end))))
            .reduce(f64::max);
        let held = time < end - own.hold
            && [outside, contact]
                .iter()
                .flatten()
                .all(|last| *last < end - own.hold);
        Some(Again {
            time,
            outside,
            contact,
            held,
        })
    }
}

/// Names what happened.
pub(super) fn name(list: &mut List, setup: Setup, run: Option<&Context>) {
    let Some(given) = setup.drop().shaft.as_deref() else {
        return;
    };
    for event in events(given) {
        let time = run.map(|run| {
            let time = time_of(event.when, run);
            time.filter(|time| *time <= run.end)
        });
        let growths = setup.built.shaft.iter().flat_map(|own| &own.growth);
        let growth = growths
            .into_iter()
            .find(|own| own.0 == event.name)
            .map(|own| own.1);
        let happened_at = time.map(|time| (time, growth));
        let cuts = growth.is_some();
        list.named(&[&event.name], |list| {
            happened(list, &cuts, happened_at.as_ref())
        });
    }
    if relevitations(setup.drop()).next().is_some() {
        again(list, &(), run.map(Again::of).as_ref());
    }
}

const NEVER: &str = "it did not happen in this run";

results! {
    /// Of an event.
    fn happened(cuts: &bool, run: &(Option<f64>, Option<f64>)) {
        "event.*.time": number "s", EVENT, "instant at which it happened" in instants "*" => run.0.ok_or_else(|| NEVER.to_string());
        "event.*.growth": number "1/s", GROWTH, "rate at which the rotor leaves the middle after it" when *cuts => run.1.unwrap_or(f64::NAN);
    }
    /// Of a rotor that is levitated again.
    fn again(setup: &(), run: &Option<Again>) {
        "relevitation": text "", HELD, "whether the rotor was held again" in relevitation "state" => {
            let word = |own: &Again| ["not held", "held"][usize::from(own.held)].to_string();
            run.as_ref().map(word).ok_or_else(|| NEVER.to_string())
        };
        "relevitation_held": number "" headline, HELD, "1 where the rotor was held again, else 0" => {
            run.as_ref().map(|own| f64::from(u8::from(own.held))).ok_or_else(|| NEVER.to_string())
        };
        "relevitation_duration": number "s", OUTSIDE, "from the re-levitation until the rotor stayed in the middle of its bearings" in relevitation "in the middle after" => {
            run.as_ref().filter(|own| own.held).and_then(|own| Some(own.outside? - own.time)).ok_or_else(|| "it was not held, or never outside after it".to_string())
        };
        "relevitation_last_contact": number "s", CONTACT, "end of the last contact after the re-levitation" in relevitation "last contact at" => {
            run.as_ref().and_then(|own| own.contact).ok_or_else(|| "no contact after it".to_string())
        };
    }
}

/// Events that never happened, and magnets that keep their power because others than its loss are given.
pub(super) fn never(context: &Context) -> Vec<Warning> {
    let Some(given) = context.setup.drop().shaft.as_deref() else {
        return Vec::new();
    };
    let end = context.end;
    let mut list = Vec::new();
    for event in events(given) {
        let time = time_of(event.when, context);
        let again = matches!(event.what, Happens::Relevitate(_));
        let lost = context.finished.record.lost;
        let why = match (time, event.when) {
            (Some(time), _)
                if time <= end && again && lost.is_none_or(|(lost, _)| lost >= time) =>
            {
                "the magnets have not lost their power before it".to_string()
            }
            (Some(time), _) if time <= end => continue,
            (None, When::Speed { speed, .. }) => {
                format!("the rotor does not come to {speed:.1} rad/s")
            }
            (Some(time), _) => format!("it would at {time:.4} s, and the run ends at {end:.4} s"),
            (None, When::At(_)) => continue,
        };
        let name = event.name.clone();
        list.push(ShaftWarning::EventNever { name, why }.into());
    }
    let lost = (given.events.iter()).filter_map(|event| match &event.what {
        Happens::Lost { axes, .. } => Some(axes),
        _ => None,
    });
    let lost = lost.flatten().collect::<BTreeSet<_>>().len();
    let all = context.setup.machine.axes().count();
    if context.setup.controlled().is_some() && lost < all {
        list.push(ShaftWarning::NoLossOfPower.into());
    }
    list
}

/// A rotor that was not held when it was levitated again, graded by how long.
pub(super) fn not_held(context: &Context) -> Option<(f64, Warning)> {
    let own = Again::of(context).filter(|own| !own.held)?;
    let end = context.finished.ending.time;
    let last = [own.outside, own.contact]
        .into_iter()
        .flatten()
        .fold(own.time, f64::max);
    let given = context.setup.controlled()?;
    let limits = context.finished.record.currents.iter().enumerate();
    let limited = limits.filter_map(|(axis, peak)| {
        let since = peak.limited_since;
        Some((axis, since.first?, since.duration))
    });
    let first = limited.min_by(|a, b| a.1.total_cmp(&b.1));
    let first = match first {
        Some((axis, since, long)) => format!(
            "{} was at its largest current first, at {since:.4} s, for {:.1} ms in all",
            value_of(given, axis, "current"),
            1e3 * long
        ),
        None => "no coil was at its largest current".to_string(),
    };
    let warning = ShaftWarning::NotHeldAgain {
        time: own.time,
        last,
        end,
        first,
    };
    Some((last - own.time, warning.into()))
}

origins! {
    EVENT: law "[[event]]: its instant, or that at which the spin reached its speed, by a state event of the integration",
        source "crates/model/src/system/machine/mod.rs, crates/solve/src/state_event.rs",
        valid "infinite where the rotor does not come to its speed";
    GROWTH: law "largest real part of the eigenvalues of the machine after this event alone, about the steady state at the start: of a cut axis k_s stays, of a lost one neither k_i nor k_s",
        source "crates/levitation/src/closed_loop.rs with the slopes that the event leaves",
        valid "small displacements in the middle, speed of the start; zero, up to round-off, where the rotor falls freely";
    HELD: law "1 where after the re-levitation the last contact and the last displacement beyond event.within of the clearance, in every bearing, are earlier than the end of the run less event.hold",
        source "crates/simulate/src/drop/events.rs; the criterion of the user, event.within and event.hold",
        valid "limits of coils as given; without largest_current and slew_rate any controller lifts the rotor";
    OUTSIDE: law "instant at which the rotor's centre was last beyond event.within of the clearance from the middle of a bearing, at the ends of steps, less that of the re-levitation",
        source "crates/model/src/system/machine/record.rs",
        valid "as the run";
    CONTACT: law "end of the last contact in any bearing",
        source "crates/model/src/contact.rs",
        valid "as the run";
}
