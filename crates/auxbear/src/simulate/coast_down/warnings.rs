//! What the user should know before trusting a run-out, the gravest first.

use crate::result::outcome::{Warning, warning};
use crate::simulate::coast_down::build::ICE_POINT;
use crate::simulate::coast_down::course::End;
use crate::simulate::coast_down::ran::Ran;
use thermal::bearing_network::{LUBRICANT, NODES};

pub(super) fn of(ran: &Ran) -> Vec<Warning> {
    [
        runs_away(ran),
        limits(ran),
        stays_closed(ran).filter(|_| runs_away(ran).is_none()),
        viscosity(ran).filter(|_| runs_away(ran).is_none()),
        too_fast(ran),
        turns_on(ran),
        Some(only_rolling()),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A time for people.
fn words(time: f64) -> String {
    match time {
        t if t >= 7200.0 => format!("{:.2} h", t / 3600.0),
        t if t >= 120.0 => format!("{:.1} min", t / 60.0),
        t => format!("{t:.1} s"),
    }
}

fn runs_away(ran: &Ran) -> Option<Warning> {
    let rows = ran.free.rows.iter();
    let row = rows
        .clone()
        .find(|row| row.growth > 0.0 && row.clearance < 0.0)?;
    let most = rows.map(|row| row.growth).fold(0.0, f64::max);
    Some(warning(
        "AB2311",
        format!(
            "The bearing runs away: from {} on its balls are preloaded by their own warmth and every kelvin makes more heat than it \
             takes away; a disturbance grows {:.1} times each {}. More clearance, better cooling of the inner race, or hybrid balls \
             keep it open.",
            words(row.time),
            std::f64::consts::E,
            words(1.0 / most)
        ),
    ))
}

fn limits(ran: &Ran) -> Option<Warning> {
    let nodes = NODES.iter().enumerate().filter_map(|(node, name)| {
        let limit = ran.limits[node]?;
        let at = ran.first(|row| row.temperatures[node] - limit)?;
        Some((at, node, name, limit))
    });
    let mut passed: Vec<_> = nodes.collect();
    passed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let &(at, node, name, limit) = passed.first()?;
    let others: Vec<String> = passed[1..]
        .iter()
        .map(|(at, _, name, _)| format!("{} at {}", name.replace('_', " "), words(*at)))
        .collect();
    let others = match others.is_empty() {
        true => String::new(),
        false => format!(" (then {})", others.join(", ")),
    };
    let taken = ran.held.as_ref().map(|held| {
        let rows = held.rows.iter();
        let most = rows
            .map(|row| row.taken.iter().sum::<f64>())
            .fold(0.0, f64::max);
        let all: f64 = held.taken.iter().sum();
        format!(
            " To hold the limits {most:.0} W at most, {:.2} kJ in all, must be taken away.",
            1e-3 * all
        )
    });
    Some(warning(
        "AB2310",
        format!(
            "Too hot: {} above {limit:.0} °C after {}{others}, up to {:.0} °C. Hardness, size, cage and lubricant may change there; \
             this run does not follow that.{}",
            name.replace('_', " "),
            words(at),
            ran.peak(node).0,
            taken.unwrap_or_default()
        ),
    ))
}

fn stays_closed(ran: &Ran) -> Option<Warning> {
    let at = ran.first(|row| -row.clearance)?;
    if ran.free.rows[0].clearance < 0.0 {
        return None;
    }
    let rows = ran.free.rows.iter();
    let most = rows.map(|row| row.ball_loads[0]).fold(0.0, f64::max);
    Some(warning(
        "AB2312",
        format!(
            "The clearance closes {}: rings that warm unequally load the balls with up to {most:.0} N. The difference of the \
             rings' temperatures is known within a factor of two; so is the clearance that is needed.",
            match at {
                0.0 => "from the start".to_string(),
                at => format!("after {}", words(at)),
            }
        ),
    ))
}

fn viscosity(ran: &Ran) -> Option<Warning> {
    let (least, largest) = ran.built.viscosity.range();
    let (hottest, at) = ran.peak(LUBRICANT);
    let start = ran.free.rows[0].temperatures[LUBRICANT] + ICE_POINT;
    let hot = hottest + ICE_POINT > largest;
    if !hot && start >= least {
        return None;
    }
    let (temperature, when) = match hot {
        true => (hottest, format!("after {}", words(at))),
        false => (start - ICE_POINT, "at the start".to_string()),
    };
    Some(warning(
        "AB2313",
        format!(
            "The lubricant is at {temperature:.0} °C {when}, beyond the two temperatures that its viscosity is known near ({:.0} to {:.0} °C): the \
             line of ASTM D341 is drawn on, down to 2 mm²/s.",
            least - ICE_POINT,
            largest - ICE_POINT
        ),
    ))
}

fn too_fast(ran: &Ran) -> Option<Warning> {
    let limit = ran
        .run
        .limiting_speed
        .filter(|limit| ran.run.speed.abs() > *limit)?;
    let rows = ran.free.rows.iter();
    let until = rows
        .map(|row| (row.time, row.speed))
        .find(|(_, speed)| *speed < limit);
    Some(warning(
        "AB2314",
        format!(
            "The speed stays above the limiting speed of the bearing, {limit:.0} rad/s, for {}: friction and heat are extrapolated there.",
            until.map_or_else(|| "the whole run".to_string(), |(time, _)| words(time))
        ),
    ))
}

fn turns_on(ran: &Ran) -> Option<Warning> {
    (ran.free.end == End::Late).then(|| {
        warning(
            "AB2315",
            format!(
                "After {} the rotor still turns with {:.1} rad/s: every result is one of this time, not of the standstill.",
                words(ran.free.state.time),
                ran.free.state.speed
            ),
        )
    })
}

fn only_rolling() -> Warning {
    warning(
        "AB2316",
        "The rotor rolls without whirl from the start: a whirl, lost contact, or the passing of a resonance makes more heat in seconds than \
         rolling in minutes, and only a drop shows it. Conductances that were not given are right within a factor of two, and the rises of \
         temperature with them."
            .to_string(),
    )
}
