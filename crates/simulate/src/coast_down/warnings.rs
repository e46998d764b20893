//! What the user should know before trusting a coast-down, the most severe first.

use crate::assumptions;
use crate::bearing::severity::wide_line;
use crate::bearing::warning_table::{BearingWarning, HeatWarning};
use crate::coast_down::build::{ICE_POINT, Part};
use crate::coast_down::rows::{End, Row};
use crate::coast_down::run::{CoastDownRun, NodeOf};
use model::system::sampling::Peak;
use outcome::Warning;
use physics::friction::Friction;
use physics::friction_range::{OperatingPoint, farthest};
use physics::viscosity::Viscosity;
use scenario::{LubricantWarning, drawn_on};
use thermal::bearing_network::{LUBRICANT, NODES};
use thermal::oil_range::{self, BeyondData};
use thermal::passage::Passage;

problem::warnings! {
    /// Of a coast-down.
    pub enum CoastDownWarning {
        Overspeed { limit: "rad/s", how_long: words } "AB2314" Invalid, coast_down
            ("The speed stays above the limiting speed of the bearing, {limit:.0} rad/s, for {how_long}: friction and heat are extrapolated there.");
        TurnsOn { time: "s", speed: "rad/s" } "AB2315" Uncertain, coast_down
            ("After {} the rotor still turns with {speed:.1} rad/s: every result is one of this time, not of the standstill.", words(time));
        OnlyRolling "AB2316" Uncertain
            ("The rotor rolls without whirl from the start: a whirl, lost contact, or the passing of a resonance makes more heat in seconds than rolling in minutes, and only a drop shows it. Conductances that were not given are right within a factor of two, and the rises of temperature with them.");
        NoWindage { pressure: "Pa" } "AB2335" Uncertain, coast_down
            ("Gas of {:.3} bar cools the bearings and does not brake the rotor: rotor.windage is 0. The coast-down comes out too long by what the gas brakes, and turns, heat and life of the bearings with it. Give rotor.windage, or heat.atmosphere = \"vacuum\" where there is none.", 1e-5 * pressure);
    }
}

/// Of a coast-down by itself.
pub(super) fn of(ran: &CoastDownRun) -> Vec<Warning> {
    let mut list = of_course(ran);
    for (k, part) in ran.parts() {
        list.extend(
            law_range(ran, k)
                .into_iter()
                .map(|found| found.of_part(&part.name)),
        );
    }
    list.push(CoastDownWarning::OnlyRolling.into());
    list
}

/// Of its course, whatever went before.
pub(crate) fn of_course(ran: &CoastDownRun) -> Vec<Warning> {
    let away = runs_away(ran);
    let open = away.is_none();
    let mut list: Vec<Warning> = away.into_iter().collect();
    list.extend(limits(ran));
    for (k, part) in ran.parts() {
        let closed = open.then(|| stays_closed(ran, k)).flatten();
        let others = [
            dents(ran, k),
            viscosity(ran, k),
            too_fast(ran, k),
            loose(ran, k),
            wide(part),
        ];
        let found = closed.into_iter().chain(others.into_iter().flatten());
        list.extend(found.map(|found| found.of_part(&part.name)));
    }
    list.extend(gas(ran));
    list.extend(turns_on(ran));
    list
}

/// A time for people.
fn words(time: f64) -> String {
    match time {
        t if t >= 7200.0 => format!("{:.2} h", t / 3600.0),
        t if t >= 120.0 => format!("{:.1} min", t / 60.0),
        t => format!("{t:.1} s"),
    }
}

/// What a disturbance may grow by, over it, before a bearing calms down, without a word.
const SLIGHT: f64 = 0.01;

fn runs_away(ran: &CoastDownRun) -> Option<Warning> {
    let grows = |row: &&Row| row.growth > 0.0 && row.clearance() < 0.0;
    let growing = || ran.free.rows.iter().filter(grows);
    let row = growing().next()?;
    let most = growing().max_by(|a, b| a.growth.total_cmp(&b.growth))?;
    let closed = |k: &usize| row.bearings[*k].clearance;
    let first = (0..row.bearings.len()).min_by(|a, b| closed(a).total_cmp(&closed(b)))?;
    let temperatures = row.temperatures.chunks(NODES.len()).nth(first)?;
    let changes = ran.built.parts[first].zone.changes_at(temperatures);
    let last = ran.free.rows.iter().rposition(|row| grows(&row));
    // what left the model has not calmed down
    let calm = last.and_then(|last| ran.free.rows.get(last + 1));
    let calm = calm.filter(|_| !ran.free.end.leaves());
    let calm = calm.map(|row| row.time);
    let slight = calm.is_some_and(|calm| most.growth * (calm - row.time) < SLIGHT);
    let name = &ran.built.parts[first].name;
    let at = |row: &Row| Peak {
        value: row.growth,
        time: row.time,
    };
    (!slight).then(|| away([at(row), at(most)], calm, changes).of_part(name))
}

/// A bearing that runs away, until a time, s, if it does no longer: its growth rate (1/s) as that begins and the largest, and what inner ring,
/// balls and outer ring have added to its clearance until it begins, m.
pub(crate) fn away([first, largest]: [Peak; 2], calm: Option<f64>, changes: [f64; 3]) -> Warning {
    let time = first.time;
    let when = match calm {
        None => format!("The bearing runs away: from {} on", words(time)),
        Some(calm) => format!(
            "The bearing runs away from {} to {}:",
            words(time),
            words(calm)
        ),
    };
    let by = match changes.iter().sum::<f64>() < -CLOSES_ON {
        true => "by their own heat",
        false => "as mounted",
    };
    let [inner, balls, outer] = changes;
    let warning = HeatWarning::RunsAway {
        time,
        when,
        by: by.to_string(),
        each: words(1.0 / first.value),
        rate: first.value,
        each_largest: words(1.0 / largest.value),
        at_largest: words(largest.time),
        largest_rate: largest.value,
        inner,
        balls,
        outer,
    };
    warning.into()
}

/// Which of both rings becomes loose first, with the time.
pub(crate) fn first_loose(times: [Option<f64>; 2]) -> Option<(f64, &'static str)> {
    let seats = [
        "the inner ring on its shaft",
        "the outer ring in its housing",
    ];
    (times.into_iter().zip(seats))
        .filter_map(|(time, seat)| Some((time?, seat)))
        .min_by(|a, b| a.0.total_cmp(&b.0))
}

/// A ring that is loose from a time on, s, which is `when` in words.
pub(crate) fn loose_ring(time: f64, when: String, seat: &str) -> Warning {
    let seat = seat.to_string();
    HeatWarning::LooseRing { time, when, seat }.into()
}

/// A ring that loses its fit on the way.
fn loose(ran: &CoastDownRun, k: usize) -> Option<Warning> {
    let part = &ran.built.parts[k];
    let at = |row: &Row| {
        let temperatures = &row.temperatures[k * NODES.len()..][..NODES.len()];
        let by_heat = part.network.loose(row.bearings[k].speed, temperatures);
        let by_size = part.zone.loose(temperatures);
        [0, 1].map(|seat| by_heat[seat] || by_size[seat])
    };
    let rows = &ran.free.rows;
    let before = at(&rows[0]);
    let times = [0, 1].map(|seat| {
        let later = rows.iter().find(|row| !before[seat] && at(row)[seat]);
        later.map(|row| row.time)
    });
    let (time, seat) = first_loose(times)?;
    Some(loose_ring(time, words(time), seat))
}

/// What holding the limits takes: the largest power, W, and all of it, J; of one bearing or of all.
pub(crate) fn to_take(of: &str, most: f64, all: f64) -> String {
    let energy = match all < 1e3 {
        true => format!("{all:.1} J"),
        false => format!("{:.2} kJ", 1e-3 * all),
    };
    format!(" To hold the limits {most:.1} W at most, {energy} in all, must be taken from {of}.")
}

fn limits(ran: &CoastDownRun) -> Option<Warning> {
    let nodes = ran
        .parts()
        .flat_map(|(k, part)| part.nodes(k))
        .filter_map(|node| {
            let limit = ran.limits[node.place()]?;
            let at = ran.first(|row| row.temperatures[node.place()] - limit)?;
            Some((at, node, limit))
        });
    let mut passed: Vec<_> = nodes.collect();
    passed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let &(at, node, limit) = passed.first()?;
    let words_of = |node: NodeOf| {
        let name = node.name().replace('_', " ");
        match ran.built.parts[node.bearing].name.as_str() {
            "" => name,
            part => format!("{name} of {part}"),
        }
    };
    let others: Vec<String> = passed[1..]
        .iter()
        .map(|(at, node, _)| format!("{} at {}", words_of(*node), words(*at)))
        .collect();
    let others = match others.is_empty() {
        true => String::new(),
        false => format!(" (then {})", others.join(", ")),
    };
    let peaks = passed
        .iter()
        .map(|(_, other, _)| (ran.peak(*other).0, *other));
    let (most, hottest) = peaks.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let hottest = match passed.len() {
        1 => String::new(),
        _ => format!(" ({})", words_of(hottest)),
    };
    let taken = ran.held.as_ref().map(|held| {
        let rows = held.rows.iter();
        let most = rows
            .map(|row| row.taken.iter().sum::<f64>())
            .fold(0.0, f64::max);
        to_take("all bearings", most, held.taken.iter().sum())
    });
    let warning = HeatWarning::TooHotInCoastDown {
        node: words_of(node),
        limit: limit + ICE_POINT,
        time: at,
        when: words(at),
        others,
        peak: most + ICE_POINT,
        hottest,
        taken: taken.unwrap_or_default(),
    };
    Some(warning.into())
}

/// Change of a clearance that was closed from the start which is worth a word, m.
const CLOSES_ON: f64 = 0.5e-6;

fn stays_closed(ran: &CoastDownRun, k: usize) -> Option<Warning> {
    let at = ran.first(|row| -row.bearings[k].clearance)?;
    let first = &ran.free.rows[0];
    let least = ran.rows(k).map(|row| row.clearance);
    let least = least.fold(f64::INFINITY, f64::min);
    let before = first.bearings[k].clearance;
    let closed = before < 0.0;
    if closed && least > before - CLOSES_ON {
        return None;
    }
    // what intervals see of impacts has other causes
    let loads = ran.built.parts[k].zone.loads(least);
    let most = loads.into_iter().fold(0.0, f64::max);
    let when = match closed {
        true => format!(
            "goes on to close, from {:.1} µm to {:.1} µm",
            1e6 * before,
            1e6 * least
        ),
        false if at == first.time => "closes from the start".to_string(),
        false => format!("closes after {}, to {:.1} µm", words(at), 1e6 * least),
    };
    let warning = HeatWarning::ClosesInCoastDown {
        time: at,
        clearance: least,
        when,
        load: most,
    };
    Some(warning.into())
}

/// Balls that dent the races on the way.
fn dents(ran: &CoastDownRun, k: usize) -> Option<Warning> {
    let part = &ran.built.parts[k];
    let hardest = ran
        .rows(k)
        .max_by(|a, b| a.largest_pressure.total_cmp(&b.largest_pressure))?;
    let (pressure, load) = (hardest.largest_pressure, hardest.largest_ball_load());
    let limit = part.pressure_limit;
    let warning = BearingWarning::PressureInCoastDown {
        load,
        pressure,
        limit,
    };
    (pressure > limit).then(|| warning.into())
}

fn viscosity(ran: &CoastDownRun, bearing: usize) -> Option<Warning> {
    let lubricant = NodeOf {
        bearing,
        node: LUBRICANT,
    };
    let oil = &ran.built.parts[bearing].viscosity;
    let mut found = ran.built.start.beyond_data[bearing];
    for row in &ran.free.rows {
        let temperature = row.temperatures[lubricant.place()];
        oil_range::look(&mut found, oil, temperature, row.time);
    }
    Some(beyond_data(oil, &found?))
}

/// A lubricant hotter or colder than its viscosity is known near.
pub(crate) fn beyond_data(oil: &Viscosity, found: &BeyondData) -> Warning {
    let since = match found.since > 0.0 {
        true => format!("from {} on", words(found.since)),
        false => "from the start on".to_string(),
    };
    let at = match found.at > found.since {
        true => format!(", after {}", words(found.at)),
        false => String::new(),
    };
    let temperature = found.farthest + ICE_POINT;
    let warning = LubricantWarning::DrawnSince {
        time: found.since,
        since,
        how: drawn_on(oil, temperature),
        temperature,
        at,
    };
    warning.into()
}

fn too_fast(ran: &CoastDownRun, k: usize) -> Option<Warning> {
    let limit =
        (ran.built.parts[k].warm.limiting_speed).filter(|limit| ran.free.rows[0].speed > *limit)?;
    let rows = ran.free.rows.iter();
    let until = rows
        .map(|row| (row.time, row.speed))
        .find(|(_, speed)| *speed < limit);
    let how_long = until.map_or_else(|| "the whole run".to_string(), |(time, _)| words(time));
    Some(CoastDownWarning::Overspeed { limit, how_long }.into())
}

/// The friction law outside its range, at the temperatures and loads of the run.
fn law_range(ran: &CoastDownRun, k: usize) -> Vec<Warning> {
    let losses = &ran.built.parts[k].losses;
    let departures = ran.free.rows.iter().flat_map(|row| {
        let speed = row.bearings[k].speed;
        let temperatures = &row.temperatures[k * NODES.len()..][..NODES.len()];
        let law = Friction::Palmgren(losses.law_at(temperatures));
        law.departures(&OperatingPoint {
            speed,
            radial_load: losses.radial_load(speed, temperatures),
            axial_load: 0.0,
        })
    });
    assumptions::law_range("", &farthest(departures))
}

/// Pressure from which on gas brakes a rotor, Pa: a thousandth of the atmosphere.
const BRAKES: f64 = 100.0;

/// Gas that takes heat from a bearing and brakes nothing.
fn gas(ran: &CoastDownRun) -> Option<Warning> {
    let rotor = &ran.built.rotor;
    let (_, part) = ran
        .parts()
        .find(|(_, part)| part.warm.heat.pressure() > BRAKES)?;
    let pressure = part.warm.heat.pressure();
    (rotor.drag == 0.0 && rotor.drag_square == 0.0)
        .then(|| CoastDownWarning::NoWindage { pressure }.into())
}

/// A rotor in an air clearance that the law of its line does not reach.
fn wide(part: &Part) -> Option<Warning> {
    let Passage::Line(line) = &part.network.landing else {
        return None;
    };
    wide_line(line.half_width(part.zone.load), line.bore, line.clearance)
}

fn turns_on(ran: &CoastDownRun) -> Option<Warning> {
    let (time, speed) = (ran.free.state.time, ran.free.state.speed);
    matches!(ran.free.end, End::Late | End::Reached)
        .then(|| CoastDownWarning::TurnsOn { time, speed }.into())
}
