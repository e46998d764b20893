//! What the user should know before trusting the coast-down of a drop.

use crate::bearing::severity::STEEL_CHANGES;
use crate::bearing::warning_table::HeatWarning;
use crate::coast_down::build::Part;
use crate::coast_down::rows::Row;
use crate::coast_down::run::CoastDownRun;
use crate::coast_down::warnings;
use crate::drop::context::Context;
use crate::drop::multirate::IntervalSeries;
use crate::drop::multirate::macro_step::Rubbed;
use crate::drop::warning_table::DropWarning;
use outcome::Warning;

/// Relative standard error of a mean power above which it is reported.
const SCATTERS: f64 = 0.1;
/// Share of the energy lost from which on friction of rotor and race is sliding, not the creep of one that rolls.
const SLIDES: f64 = 0.01;
/// Shares of the speed of rolling below which a race lags, and stands.
const LAGS: f64 = 0.9;
const STANDS: f64 = 0.01;

/// What intervals say, the most severe first.
pub(super) fn of(context: &Context, found: &CoastDownRun, series: &IntervalSeries) -> Vec<Warning> {
    let parts = || context.setup.parts().enumerate();
    let mut list: Vec<Warning> = ends_early(context, series).into_iter().collect();
    list.extend(whirls(series));
    list.extend(scatters(series));
    list.extend(holds(found, series));
    list.extend(leaves_rolling(series));
    list.extend(parts().filter_map(|(k, name)| hits_harder(context, found, series, k, name)));
    list.extend(parts().filter_map(|(k, name)| gets_hot(series, k, name)));
    list.extend(parts().filter_map(|(k, name)| Some(presses(context, found, k)?.of_part(name))));
    list.extend(slid(context, found, series));
    list.extend(warnings::of_course(found));
    list
}

/// A drop that ends before its impacts or its spin-up.
fn ends_early(context: &Context, series: &IntervalSeries) -> Option<Warning> {
    let time = context.finished.ending.time;
    let lands = |k: usize| !context.record(k).contacts.is_empty();
    if !(0..context.setup.parts().count()).all(lands) {
        return Some(DropWarning::EndsBeforeLanding { time }.into());
    }
    let (share, place) = series.stretches.first().filter(|own| own.first)?.slowest;
    let late = series.settled?;
    let at_once = place.time - time < late;
    (at_once && share < LAGS).then(|| DropWarning::EndsBeforeSpinUp { time, late }.into())
}

/// A rotor that whirls against its spin, or with it.
fn whirls(series: &IntervalSeries) -> Vec<Warning> {
    let when = |[since, until]: [f64; 2]| match until > since {
        true => format!("from {since:.1} s to {until:.1} s"),
        false => format!("at {since:.1} s"),
    };
    let [backward, forward] = series.whirled;
    let back = backward.map(|times| {
        let (time, when) = (times[0], when(times));
        DropWarning::BackwardWhirlInCoastDown { time, when }
    });
    let with = forward.map(|times| {
        let (time, when) = (times[0], when(times));
        DropWarning::ForwardWhirlInCoastDown { time, when }
    });
    back.into_iter().chain(with).map(Warning::from).collect()
}

/// Intervals whose means are not sure.
fn scatters(series: &IntervalSeries) -> Option<Warning> {
    let (deviation, windows) = (series.error, series.intervals as f64);
    let warning = DropWarning::WindowsScatter { deviation, windows };
    (deviation > SCATTERS).then(|| warning.into())
}

/// Preload over a smaller one from which on it is reported.
const PRELOAD_CHANGES: f64 = 1.2;
/// Steps of the logarithm of the speed in which a moment that goes on falling is integrated.
const STEPS: i32 = 256;

/// A moment that is held to the standstill: for how long, and for how much longer the rotor would turn if it fell further as it did on the last third of its
/// speed until there, M = M₁ (Ω/Ω₁)^p, beside what else brakes.
fn holds(found: &CoastDownRun, series: &IntervalSeries) -> Option<Warning> {
    let place = series.held?;
    let of_row = |row: &Row| (row.speed, row.moments[0] + row.moments[1]);
    let mut rows = found.free.rows.iter().rev();
    let (_, moment) = of_row(rows.find(|row| row.speed >= place.speed)?);
    let (faster, before) = of_row(rows.find(|row| row.speed >= 1.5 * place.speed)?);
    let power = (before / moment).ln() / (faster / place.speed).ln();
    let held = found.free.state.time - place.time;
    let slower = (found.built.end.stop_speed / place.speed).powf(1.0 / f64::from(STEPS));
    let turns = (0..STEPS).map(|step| {
        let speed = place.speed * slower.powi(step);
        let middle = speed * slower.sqrt();
        let beside = found.built.losses(place.time, middle).rotor;
        let falls = moment * (middle / place.speed).powf(power);
        found.built.inertia * speed * (1.0 - slower) / (falls + beside.moment(middle))
    });
    let warning = DropWarning::MomentIsHeld {
        time: place.time,
        speed: place.speed,
        moment,
        held,
        power,
        longer: turns.sum::<f64>() - held,
    };
    power.is_finite().then(|| warning.into())
}

/// A preload that unequal temperatures change by more than a fifth.
fn presses(context: &Context, found: &CoastDownRun, bearing: usize) -> Option<Warning> {
    let heated = context.setup.heated(bearing)?;
    let [least, most] = heated.preloads(found.temperatures(bearing))?;
    let mounted = heated.bearing.axial_preload;
    let warning = HeatWarning::PreloadChangesInCoastDown {
        mounted,
        least,
        most,
    };
    (most.max(mounted) > PRELOAD_CHANGES * least.min(mounted)).then(|| warning.into())
}

/// A bearing that the rotor hits harder than in the drop.
fn hits_harder(
    context: &Context,
    found: &CoastDownRun,
    series: &IntervalSeries,
    bearing: usize,
    name: &str,
) -> Option<Warning> {
    let seen = series.bearings.get(bearing)?.force;
    let before = context.record(bearing).peak_contact_force()?.value;
    let part = &found.built.parts[bearing];
    let most = found.rows(bearing).map(|row| row.largest_pressure);
    let most = most.fold(0.0, f64::max);
    let warning = DropWarning::HardestInCoastDown {
        part: name.to_string(),
        on: on(name),
        time: seen.at.time,
        speed: seen.at.speed,
        force: seen.value,
        before,
        end: context.finished.ending.time,
        load_share: (most / part.pressure_limit).powi(3),
    };
    (seen.value > before).then(|| warning.into())
}

/// A patch of rotor and race that gets too hot.
fn gets_hot(series: &IntervalSeries, bearing: usize, name: &str) -> Option<Warning> {
    let seen = series.bearings.get(bearing)?.rise;
    let warning = DropWarning::HotContactInCoastDown {
        part: name.to_string(),
        on: on(name),
        time: seen.at.time,
        rise: seen.value,
    };
    (seen.value > STEEL_CHANGES).then(|| warning.into())
}

/// How long and how far the rotor slid on its races.
fn slid(context: &Context, found: &CoastDownRun, series: &IntervalSeries) -> Option<Warning> {
    let slides = |heats: f64, energy: f64| heats > SLIDES * energy;
    let stretches: Vec<_> = (series.stretches.iter())
        .filter(|own| {
            let heats = own.rubbed.iter().map(|rubbed| rubbed.heat);
            slides(heats.sum(), own.energy)
        })
        .collect();
    let (begin, end) = (stretches.first()?.from.time, stretches.last()?.to.time);
    let whole: f64 = stretches
        .iter()
        .map(|own| own.to.time - own.from.time)
        .sum();
    let when = match end - begin > 1.01 * whole {
        true => format!("For {whole:.1} s between {begin:.1} s and {end:.1} s"),
        false => format!("Between {begin:.1} s and {end:.1} s"),
    };
    let of_bearing = |(k, part): (usize, &Part)| {
        let mut sum = Rubbed::default();
        for own in stretches.iter().filter_map(|own| own.rubbed.get(k)) {
            sum.add(own);
        }
        let on = on(&part.name);
        let Rubbed { heat, distance, .. } = sum;
        (heat > 0.0).then(|| match distance > 0.0 {
            true => format!("{heat:.3e} J over {distance:.3e} m{on}"),
            false => format!("{heat:.3e} J{on}"),
        })
    };
    let rubs: Vec<String> = found.parts().filter_map(of_bearing).collect();
    let slowest = stretches.iter().map(|own| own.slowest);
    let slowest = slowest.min_by(|a, b| a.0.total_cmp(&b.0));
    let slowest = match slowest {
        Some((share, at)) if share < STANDS => {
            format!(", at {:.1} s on one that stands", at.time)
        }
        Some((share, at)) if share < LAGS => format!(
            ", at {:.1} s on one that turns with {:.0} % of the speed of rolling",
            at.time,
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
    let warning = DropWarning::SlidesInCoastDown {
        time: begin,
        duration: whole,
        when,
        slowest,
        rubs: rubs.join(", "),
        shared: shared.to_string(),
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
fn leaves_rolling(series: &IntervalSeries) -> Option<Warning> {
    let again = series.stretches.iter().filter(|own| !own.first);
    let lifted: Vec<_> = again.filter(|own| own.lifts()).collect();
    let (first, last) = (lifted.first()?, lifted.last()?);
    let warning = DropWarning::RollingDoesNotLast {
        time: first.from.time,
        speed: first.from.speed,
        last_time: last.to.time,
        last_speed: last.to.speed,
        force: lifted.iter().map(|own| own.force).fold(0.0, f64::max),
    };
    Some(warning.into())
}
