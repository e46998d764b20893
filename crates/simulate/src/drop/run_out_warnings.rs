//! What the user should know before trusting the run-out of a drop.

use crate::bearing::severity::STEEL_CHANGES;
use crate::coast_down::build::Part;
use crate::coast_down::ran::Ran;
use crate::coast_down::warnings;
use crate::drop::context::Context;
use crate::drop::returns::Return;
use crate::drop::warning_table::DropWarning;
use crate::drop::went::Went;
use outcome::Warning;

/// What windows and returns say, the most severe first.
pub(super) fn of(context: &Context, found: &Ran, went: &Went) -> Vec<Warning> {
    let parts = context.setup.parts().enumerate();
    let harder = parts.filter_map(|(k, name)| hits_harder(context, found, went, k, name));
    let early = ends_early(context, went);
    let whirl = early.into_iter().chain(whirls(went)).chain(scatters(went));
    let first = whirl.chain(leaves_rolling(went));
    let parts = context.setup.parts().enumerate();
    let hot = parts.filter_map(|(k, name)| gets_hot(went, k, name));
    first
        .chain(harder)
        .chain(hot)
        .chain(slid(context, found, went))
        .chain(warnings::of_course(found))
        .collect()
}

/// Share of the drop's time above which the rest of its spin-up is worth a word.
const LATE: f64 = 0.3;

/// A drop that ends before its impacts or its spin-up.
fn ends_early(context: &Context, went: &Went) -> Option<Warning> {
    let time = context.finished.ending.time;
    let lands = |k: usize| !context.record(k).contacts.is_empty();
    match went.bounced.late.filter(|late| *late > LATE * time) {
        _ if !(0..context.setup.parts().count()).all(lands) => {
            Some(DropWarning::EndsBeforeLanding { time }.into())
        }
        Some(late) => Some(DropWarning::EndsBeforeSpinUp { time, late }.into()),
        None => None,
    }
}

/// A rotor that whirls against its spin in windows, or with it.
fn whirls(went: &Went) -> Vec<Warning> {
    let when = |[since, until]: [f64; 2]| match until > since {
        true => format!("from {since:.1} s to {until:.1} s"),
        false => format!("at {since:.1} s"),
    };
    let back = went.whirled(0).map(|times| {
        let (time, when) = (times[0], when(times));
        DropWarning::BackwardWhirlInRunOut { time, when }
    });
    let with = went.whirled(1).map(|times| {
        let (time, when) = (times[0], when(times));
        DropWarning::ForwardWhirlInRunOut { time, when }
    });
    back.into_iter().chain(with).map(Warning::from).collect()
}

/// Relative standard error of a window's power above which it is reported.
const SCATTERS: f64 = 0.1;

/// Windows whose means are not sure.
fn scatters(went: &Went) -> Option<Warning> {
    let each = went.scatter();
    let worst = each.iter().copied().fold(0.0, f64::max);
    let windows = each.len() as f64;
    let deviation = worst;
    (worst > SCATTERS).then(|| DropWarning::WindowsScatter { deviation, windows }.into())
}

/// A bearing that the rotor hits harder in windows than in the drop.
fn hits_harder(
    context: &Context,
    found: &Ran,
    went: &Went,
    bearing: usize,
    name: &str,
) -> Option<Warning> {
    let [force, time, speed] = went.peak(bearing)?;
    let before = context.record(bearing).peak_contact_force()?.value;
    let part = &found.built.parts[bearing];
    let most = found.rows(bearing).map(|row| row.largest_pressure);
    let most = most.fold(0.0, f64::max);
    let warning = DropWarning::HardestInRunOut {
        part: name.to_string(),
        on: on(name),
        time,
        speed,
        force,
        before,
        end: context.finished.ending.time,
        load_share: (most / part.pressure_limit).powi(3),
    };
    (force > before).then(|| warning.into())
}

/// A patch of rotor and race that gets too hot in windows.
fn gets_hot(went: &Went, bearing: usize, name: &str) -> Option<Warning> {
    let [rise, time] = went.hottest(bearing)?;
    let warning = DropWarning::HotContactInRunOut {
        part: name.to_string(),
        on: on(name),
        time,
        rise,
    };
    (rise > STEEL_CHANGES).then(|| warning.into())
}

/// Share of the energy lost in windows from which on friction of rotor and race is sliding, not the creep of one that rolls.
const SLIDES: f64 = 0.01;
/// Shares of the speed of rolling below which a race lags, and stands.
const LAGS: f64 = 0.9;
const STANDS: f64 = 0.01;

/// How long and how far the rotor slid on its races while windows followed it.
fn slid(context: &Context, found: &Ran, went: &Went) -> Option<Warning> {
    let first = [context.finished.ending.time, went.first.time];
    let again = went.returned.list.iter();
    let stretches = std::iter::once((first, &went.bounced))
        .chain(again.map(|again| ([again.from[0], again.to[0]], &again.windows)));
    let slides: Vec<_> = stretches
        .filter(|(_, windows)| windows.friction() > SLIDES * windows.lost)
        .collect();
    let (begin, end) = (slides.first()?.0[0], slides.last()?.0[1]);
    let whole: f64 = slides.iter().map(|([from, to], _)| to - from).sum();
    let when = match end - begin > 1.01 * whole {
        true => format!("For {whole:.1} s between {begin:.1} s and {end:.1} s"),
        false => format!("Between {begin:.1} s and {end:.1} s"),
    };
    let of_bearing = |(k, part): (usize, &Part)| {
        let each = slides
            .iter()
            .filter_map(|(_, windows)| windows.rubbed.get(k));
        let [heat, way] = each.fold([0.0; 2], |sum, own| [sum[0] + own[0], sum[1] + own[1]]);
        let on = on(&part.name);
        (heat > 0.0).then(|| format!("{heat:.3e} J over {way:.3e} m of way{on}"))
    };
    let rubs: Vec<String> = found.parts().filter_map(of_bearing).collect();
    let slowest = slides.iter().filter_map(|(_, windows)| windows.slowest);
    let slowest = slowest.min_by(|a, b| a[0].total_cmp(&b[0]));
    let slowest = match slowest {
        Some([share, time]) if share < STANDS => format!(", at {time:.1} s on one that stands"),
        Some([share, time]) if share < LAGS => format!(
            ", at {time:.1} s on one that turns with {:.0} % of the speed of rolling",
            100.0 * share
        ),
        _ => String::new(),
    };
    // without contact.width nothing says how it is shared
    let shared = match context.record(0).heat.is_some() {
        true => "",
        false => {
            " and warms both bodies by halves: a race that stands is computed too warm, the rotor too cool"
        }
    };
    let warning = DropWarning::SlidesInRunOut {
        time: begin,
        duration: whole,
        when,
        slowest,
        rubs: rubs.join(", "),
        shared: shared.to_string(),
        end: context.finished.ending.time,
    };
    Some(warning.into())
}

/// A bearing in words, where it has a name.
fn on(name: &str) -> String {
    match name {
        "" => String::new(),
        name => format!(" on {name}"),
    }
}

/// Where the rotor does not go on rolling.
fn leaves_rolling(went: &Went) -> Option<Warning> {
    let presses = |again: &Return| {
        let peaks = again.windows.peaks.iter();
        peaks.map(|[force, ..]| *force).fold(0.0, f64::max)
    };
    let lifted: Vec<_> = went
        .returned
        .list
        .iter()
        .filter(|again| again.lifts())
        .collect();
    let worst = lifted
        .iter()
        .copied()
        .max_by(|a, b| presses(a).total_cmp(&presses(b)))?;
    let ends = lifted.last()?.to;
    let [time, speed] = lifted[0].from;
    let [last_time, last_speed] = ends;
    let warning = DropWarning::RollingDoesNotLast {
        time,
        speed,
        last_time,
        last_speed,
        force: presses(worst),
    };
    Some(warning.into())
}
