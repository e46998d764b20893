//! What the user should know before trusting the run-out of a drop.

use crate::bearing::severity::STEEL_CHANGES;
use crate::coast_down::build::Part;
use crate::coast_down::ran::Ran;
use crate::coast_down::warnings;
use crate::drop::context::Context;
use crate::drop::returns::Return;
use crate::drop::went::Went;
use outcome::{Warning, warning};

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
    let end = context.finished.ending.time;
    let lands = |k: usize| !context.record(k).contacts.is_empty();
    let text = match went.bounced.late.filter(|late| *late > LATE * end) {
        _ if !(0..context.setup.parts().count()).all(lands) => format!(
            "run.duration ends after {end:.4} s, before the rotor has landed on every bearing: its impacts are in none of these results. Give run.duration more."
        ),
        Some(late) => format!(
            "run.duration ends after {end:.4} s, while inner races still come to their speed: up to {late:.2} s more at the speed of that instant. Heat, sliding and life \
             of these are in none of these results. Give run.duration that much more."
        ),
        None => return None,
    };
    Some(warning("AB2324", text))
}

/// A rotor that whirls against its spin in windows, or with it.
fn whirls(went: &Went) -> Vec<Warning> {
    let when = |[since, until]: [f64; 2]| match until > since {
        true => format!("from {since:.1} s to {until:.1} s"),
        false => format!("at {since:.1} s"),
    };
    let back = went.whirled(0).map(|times| {
        let text = format!(
            "Backward whirl while the rotor runs out: {} it runs round the bore against its spin in the windows that follow it. \
             Contact forces of this kind destroy bearings and shafts.",
            when(times)
        );
        warning("AB1014", text)
    });
    let with = went.whirled(1).map(|times| {
        let text = format!(
            "Forward whirl while the rotor runs out: {} unbalance throws it round the bore with its spin in the windows that follow it. One place of it \
             stays in the contact: a hot spot, which bends the shaft and adds to its unbalance. This run bends nothing.",
            when(times)
        );
        warning("AB2302", text)
    });
    back.into_iter().chain(with).collect()
}

/// Relative standard error of a window's power above which it is reported.
const SCATTERS: f64 = 0.1;

/// Windows whose means are not sure.
fn scatters(went: &Went) -> Option<Warning> {
    let each = went.scatter();
    let worst = each.iter().copied().fold(0.0, f64::max);
    (worst > SCATTERS).then(|| {
        warning(
            "AB2319",
            format!(
                "While the rotor does not roll, the mean power of a window is known within {:.0} % (standard error of {} windows, the worst): the \
                 run-out is as uncertain there.",
                100.0 * worst,
                each.len()
            ),
        )
    })
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
    let on = on(name);
    let part = &found.built.parts[bearing];
    let most = found.rows(bearing).map(|row| row.largest_pressure);
    let most = most.fold(0.0, f64::max);
    let share = (most / part.pressure_limit).powi(3);
    (force > before).then(|| {
        warning(
            "AB2323",
            format!(
                "While it runs out, at {time:.1} s and {speed:.0} rad/s, the rotor presses{on} with {force:.3e} N, and with {before:.3e} N at most in the \
                 first {:.3} s. A ball takes {:.0} % of the load that dents a race there; pressures, sliding, cage forces and wear of this run are those of \
                 the first alone.",
                context.finished.ending.time,
                100.0 * share
            ),
        )
    })
}

/// A patch of rotor and race that gets too hot in windows.
fn gets_hot(went: &Went, bearing: usize, name: &str) -> Option<Warning> {
    let [rise, time] = went.hottest(bearing)?;
    let text = format!(
        "While it runs out, after {time:.1} s, the patch where rotor and race rub{} is {rise:.0} K warmer than at the start, or more: steel softens and transforms \
         there, the surfaces may smear or seize, and the friction coefficient of this run no longer holds.",
        on(name)
    );
    (rise > STEEL_CHANGES).then(|| warning("AB2301", text))
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
    Some(warning(
        "AB2318",
        format!(
            "{when} the rotor slides on its races in the windows that follow it{slowest}: friction makes {}. \
             It is in run_out.load_dependent_heat{shared}. sliding_distance \
             and wear are those of the first {:.3} s alone.",
            rubs.join(", "),
            context.finished.ending.time
        ),
    ))
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
    let text = format!(
        "Rolling does not last: unbalance lifts the rotor again, from {:.1} s and {:.0} rad/s on, the last time until {:.1} s and {:.0} rad/s, and it presses with up to {:.3e} N. \
         Windows ball by ball follow it there, each as long as it likes at its speed: a rotor that passes quickly is lifted less.",
        lifted[0].from[0],
        lifted[0].from[1],
        ends[0],
        ends[1],
        presses(worst)
    );
    Some(warning("AB2317", text))
}
