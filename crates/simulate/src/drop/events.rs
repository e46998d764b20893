//! What happened to a machine, and when; whether it was levitated again.

use crate::drop::context::BOUNCE;
use crate::drop::context::{Context, Setup};
use crate::drop::magnets::value_of;
use crate::drop::warning_table::ShaftWarning;
use crate::drop::{Drop, Shaft};
use crate::rotor::LevitationModel;
use levitation::ClosedLoop;
use levitation::response::Loaded;
use model::system::machine::record::Levitated;
use outcome::Warning;
use outcome::list::{List, origins, results};
use scenario::{Event, Happens, MagnetEvent, Relevitation, When};
use std::collections::BTreeSet;
use std::f64::consts::PI;

/// The events of a machine besides a loss of power that its keys give.
fn events(given: &Shaft) -> impl Iterator<Item = &Event> {
    given.events.iter().filter(|event| !event.by_key)
}

/// The events that levitate a rotor again.
fn relevitations(drop: &Drop) -> impl Iterator<Item = (&Event, Relevitation)> + '_ {
    let shaft = drop.shaft.iter();
    shaft
        .flat_map(|own| &own.events)
        .filter_map(|event| match event.what {
            Happens::Magnets(_, MagnetEvent::Relevitated(own)) => Some((event, own)),
            _ => None,
        })
}

/// Shares of the clearance within which a rotor that is levitated again must stay, each time.
pub(super) fn within(drop: &Drop) -> Vec<f64> {
    relevitations(drop).map(|(_, own)| own.within).collect()
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
        let Happens::Magnets(axes, what) = &event.what else {
            continue;
        };
        let left = match what {
            MagnetEvent::Lost(_) => 0.0,
            MagnetEvent::SensorStuck | MagnetEvent::SensorDead | MagnetEvent::ControllerFrozen => {
                1.0
            }
            _ => continue,
        };
        // without any magnet it falls
        if axes.len() == loaded.rest.slopes.len() && left == 0.0 {
            continue;
        }
        let mut slopes = loaded.rest.slopes.clone();
        for axis in axes {
            slopes[*axis] = (0.0, left * slopes[*axis].1);
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
pub(super) fn time_of(when: When, context: &Context) -> Option<f64> {
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

/// A rotor after an event that levitates it again.
#[derive(Clone, Copy)]
struct Again<'a> {
    /// When, s.
    time: f64,
    /// When it was last outside the share of a clearance, s.
    outside: Option<f64>,
    /// End of its last contact, s.
    contact: Option<f64>,
    /// Whether it was held.
    held: bool,
    /// How long before the end it must have been, s.
    hold: f64,
    /// End of the run, or the next loss of all power, s.
    end: f64,
    /// From that event, or an earlier one, on.
    seen: &'a Levitated,
}

impl<'a> Again<'a> {
    /// After each that happened to a rotor without power, with the place of the event among them.
    fn all(context: &'a Context) -> impl Iterator<Item = (usize, Self)> + 'a {
        let record = &context.finished.record;
        let of_event = move |(place, (event, own)): (usize, (&Event, Relevitation))| {
            let time = time_of(event.when, context)?;
            // the magnets may have had their power again before
            let seen = record.again.iter().rfind(|own| own.since <= time)?;
            let end = seen.until.unwrap_or(context.finished.ending.time);
            if time > end {
                return None;
            }
            let outside = seen.outside[place].filter(|last| *last >= time);
            let contacts = record.bearings.iter().flat_map(|own| &own.contacts);
            let ends = contacts
                .filter(|own| own.start <= end)
                .map(|own| own.end.unwrap_or(end).min(end));
            let ends = ends.chain(seen.on_face);
            let contact = ends.filter(|last| *last >= time).reduce(f64::max);
            let last = [outside, contact]
                .into_iter()
                .flatten()
                .fold(time, f64::max);
            let again = Again {
                time,
                outside,
                contact,
                held: last < end - own.hold,
                hold: own.hold,
                end,
                seen,
            };
            Some((place, again))
        };
        relevitations(context.setup.drop())
            .enumerate()
            .filter_map(of_event)
    }

    /// After the last of them.
    fn last(context: &'a Context) -> Option<Self> {
        let all = Self::all(context).map(|(_, own)| own);
        all.max_by(|a, b| a.time.total_cmp(&b.time))
    }

    /// From the re-levitation until it stayed in the middle, s.
    fn duration(&self) -> Option<f64> {
        self.outside
            .filter(|_| self.held)
            .map(|last| last - self.time)
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
    let mut any = false;
    for (place, (event, _)) in relevitations(setup.drop()).enumerate() {
        any = true;
        let own = run.map(|run| Again::all(run).find(|own| own.0 == place).map(|own| own.1));
        list.named(&[&event.name], |list| each(list, &(), own.as_ref()));
    }
    if any {
        again(list, &(), run.map(Again::last).as_ref());
    }
}

const NEVER: &str = "it did not happen in this run";

results! {
    /// Of an event.
    fn happened(cuts: &bool, run: &(Option<f64>, Option<f64>)) {
        "event.*.time": number "s", EVENT, "instant at which it happened" in instants "*" => run.0.ok_or_else(|| NEVER.to_string());
        "event.*.growth": number "1/s", GROWTH, "rate at which the rotor leaves the middle after it" when *cuts => run.1.unwrap_or(f64::NAN);
    }
    /// Of a rotor that an event levitates again.
    fn each(setup: &(), run: &Option<Again<'_>>) {
        "event.*.held": number "", HELD, "1 where the rotor was held after it, else 0" => held(run.as_ref());
        "event.*.held_after": number "s", OUTSIDE, "from this re-levitation until the rotor stayed in the middle of its bearings" => in_the_middle(run.as_ref());
        "event.*.last_contact": number "s", CONTACT, "end of the last contact after this re-levitation" => last_contact(run.as_ref());
        "event.*.largest_current": number "A", CURRENT, "largest current of a coil after this re-levitation" => {
            run.as_ref().map(|own| own.seen.coil.value).ok_or_else(|| NEVER.to_string())
        };
    }
    /// Of the last of them.
    fn again(setup: &(), run: &Option<Again<'_>>) {
        "relevitation": text "", HELD, "whether the rotor was held again" in relevitation "state" => {
            let word = |own: &Again| ["not held", "held"][usize::from(own.held)].to_string();
            run.as_ref().map(word).ok_or_else(|| NEVER.to_string())
        };
        "relevitation_held": number "" headline, HELD, "1 where the rotor was held again, else 0" => held(run.as_ref());
        "relevitation_duration": number "s", OUTSIDE, "from the re-levitation until the rotor stayed in the middle of its bearings" in relevitation "in the middle after" => in_the_middle(run.as_ref());
        "relevitation_last_contact": number "s", CONTACT, "end of the last contact after the re-levitation" in relevitation "last contact at" => last_contact(run.as_ref());
    }
}

fn held(run: Option<&Again>) -> Result<f64, String> {
    let own = run.map(|own| f64::from(u8::from(own.held)));
    own.ok_or_else(|| NEVER.to_string())
}

fn in_the_middle(run: Option<&Again>) -> Result<f64, String> {
    let own = run.and_then(Again::duration);
    own.ok_or_else(|| "it was not held, or never outside after it".to_string())
}

fn last_contact(run: Option<&Again>) -> Result<f64, String> {
    let own = run.and_then(|own| own.contact);
    own.ok_or_else(|| "no contact after it".to_string())
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
        let again = event.relevitates();
        let lost = context.finished.record.lost;
        let why = match (time, event.when) {
            (Some(time), _)
                if time <= end && again && lost.is_none_or(|(lost, _)| lost >= time) =>
            {
                "the magnets have not lost their power before it".to_string()
            }
            (Some(time), _) if time <= end => continue,
            (
                None,
                When::Speed {
                    speed,
                    rising,
                    delay,
                },
            ) => {
                let way = if rising { "rise" } else { "fall" };
                let rpm = speed * 30.0 / PI;
                let then = match delay > 0.0 {
                    true => format!(", {delay} s after which it would happen"),
                    false => String::new(),
                };
                format!(
                    "the speed of the rotor does not {way} to {rpm:.1} rpm ({speed:.1} rad/s){then}"
                )
            }
            (Some(time), _) => format!("it would at {time:.4} s, and the run ends at {end:.4} s"),
            (None, When::At(_)) => continue,
        };
        let name = event.name.clone();
        list.push(ShaftWarning::EventNever { name, why }.into());
    }
    let lost = (given.events.iter()).filter_map(|event| match &event.what {
        Happens::Magnets(axes, MagnetEvent::Lost(_)) => Some(axes),
        _ => None,
    });
    let lost = lost.flatten().collect::<BTreeSet<_>>().len();
    let all = context.setup.machine.axes().count();
    if context.setup.controlled().is_some() && lost < all {
        list.push(ShaftWarning::NoLossOfPower.into());
    }
    list
}

/// When the last event or shock before an instant came, s; the start without one.
pub(super) fn last_before(context: &Context, before: f64) -> f64 {
    let given = context.setup.drop().shaft.as_deref();
    let times = given.into_iter().flat_map(events);
    let times = times.filter_map(|event| time_of(event.when, context));
    let bases = context.setup.machine.constants.base.iter();
    let shocks = bases.flat_map(|base| &base.shocks).map(|own| own.start);
    let past = times.chain(shocks).filter(|time| *time <= before);
    past.fold(0.0, f64::max)
}

/// What happens so shortly before the end that the contacts which follow would come after it.
pub(super) fn cut_off(context: &Context) -> Vec<Warning> {
    let Some(given) = context.setup.drop().shaft.as_deref() else {
        return Vec::new();
    };
    let end = context.end;
    let each = events(given).filter(|event| !event.relevitates());
    let times = each.filter_map(|event| Some((event.name.as_str(), time_of(event.when, context)?)));
    let bases = context.setup.machine.constants.base.iter();
    let shocks = bases.flat_map(|base| &base.shocks);
    let shocks = shocks.map(|own| ("the shock", own.start + own.duration));
    let soon = times
        .chain(shocks)
        .filter(|(_, time)| (*time..time + BOUNCE).contains(&end));
    let cut = |(name, time): (&str, f64)| {
        let what = format!(
            "what {name} does to the rotor, {:.0} ms at least,",
            1e3 * BOUNCE
        );
        let until = time + BOUNCE;
        ShaftWarning::CutOff { what, until, end }.into()
    };
    soon.map(cut).collect()
}

/// A rotor that was not held when it was levitated again, each time, graded by how long.
pub(super) fn not_held(context: &Context) -> Vec<(f64, Warning)> {
    let Some(given) = context.setup.controlled() else {
        return Vec::new();
    };
    let all = Again::all(context).filter(|(_, own)| !own.held);
    all.map(|(_, own)| {
        let last = [own.outside, own.contact].into_iter().flatten();
        let last = last.fold(own.time, f64::max);
        let limited = own.seen.limited.iter().enumerate();
        let limited = limited.filter_map(|(axis, own)| Some((axis, own.first?, own.duration)));
        let first = match limited.min_by(|a, b| a.1.total_cmp(&b.1)) {
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
            ends: ["the end of the run", "the next loss of power"]
                [usize::from(own.seen.until.is_some())]
            .to_string(),
            end: own.end,
            hold: own.hold,
            first,
        };
        (last - own.time, warning.into())
    })
    .collect()
}

origins! {
    EVENT: law "[[event]]: its instant, or that at which the spin reached its speed, by a state event of the integration",
        source "crates/model/src/system/machine/mod.rs, crates/solve/src/state_event.rs",
        valid "infinite where the rotor does not come to its speed";
    GROWTH: law "largest real part of the eigenvalues of the machine after this event alone, about the steady state at the start: of a cut axis k_s stays, of a lost one neither k_i nor k_s",
        source "crates/levitation/src/closed_loop.rs with the slopes that the event leaves",
        valid "small displacements in the middle, speed of the start; zero, up to round-off, where the rotor falls freely";
    HELD: law "1 where after the re-levitation the last contact and the last displacement beyond event.within of the clearance of a bearing, or of the gap to a face, are earlier than the end of the run, or the next loss of all power, less event.hold",
        source "crates/simulate/src/drop/events.rs; the criterion of the user, event.within and event.hold",
        valid "limits of coils as given; without largest_current and slew_rate any controller lifts the rotor";
    OUTSIDE: law "instant at which the rotor's centre was last beyond event.within of the clearance from the middle of a bearing, or of the gap to a face, at the ends of steps, less that of the re-levitation",
        source "crates/model/src/system/machine/record.rs",
        valid "as the run";
    CURRENT: law "largest current of one of the coils, of a linear magnet largest control current, at the ends of steps, until the end of the run or the next loss of all power",
        source "crates/model/src/system/machine/record.rs",
        valid "as the run";
    CONTACT: law "end of the last contact with the bore or a face of any bearing, until the end of the run or the next loss of all power",
        source "crates/model/src/contact.rs",
        valid "as the run";
}
