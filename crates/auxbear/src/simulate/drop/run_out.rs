//! What follows a drop until the rotor stands: a run-out in slow time, from where it rolls in its bearings.
//!
//! The spin that the run-out starts with is all the kinetic energy there is at the change, over the square of the speed: nothing is
//! lost or made by it.

use crate::result::list::{List, Origin};
use crate::result::outcome::{Quantity, Stop, Value, Warning, warning};
use crate::scenario::RunOut;
use crate::simulate::bearing::races::count_run_out;
use crate::simulate::coast_down::build::{Built, Part, Start, part};
use crate::simulate::coast_down::ran::{Ran, ran};
use crate::simulate::coast_down::{self, history, quantities as of_run_out, warnings};
use crate::simulate::drop::context::Context;
use crate::simulate::drop::quantities;
use crate::simulate::drop::returns::{self, Return, Returned, lifts};
use crate::simulate::drop::windows::{self, Bounced, Stretch};
use crate::simulate::ending;
use model::system::layout::of_part;
use model::system::machine::record::ROLLS;
use model::system::sampling::Peak;
use nalgebra::{DMatrix, DVector};
use physics::load_zone::displacement;
use std::sync::atomic::AtomicBool;
use thermal::held::Held;
use thermal::warm_machine::RotorDrag;

/// Before the names of the results of a run-out.
const RUN_OUT: &str = "run_out";
/// Before those of its course.
const OVER_TIME: &str = "over_time";

/// What follows a drop.
pub(crate) struct After {
    /// Named results.
    pub quantities: Vec<Quantity>,
    /// What the user should know of it.
    pub warnings: Vec<Warning>,
    /// How all of it ended.
    pub stop: Stop,
    /// Steps in slow time.
    pub steps: u64,
}

/// Follows a drop until the rotor stands; none where that is not asked.
pub(crate) fn after(context: &Context, interrupt: &AtomicBool) -> Option<After> {
    let end = context.drop.run_out.as_ref()?;
    let ending = &context.finished.ending;
    let stop = ending::stop(ending);
    let rolls = ending.stop == solve::Stop::Halted(ROLLS);
    let goes_on = rolls || ending.stop == solve::Stop::Finished;
    let mut built = match built(context, end, goes_on) {
        Ok(built) => built,
        Err(why) => return Some(After::none(Vec::new(), broken(stop, why))),
    };
    let bounced = match goes_on && !rolls {
        true => windows::follow(context, &mut built, Stretch::UNTIL_ROLLING, interrupt),
        false => Bounced::default(),
    };
    // what a run-out finds has its names, also where there is none
    let at_once = AtomicBool::new(true);
    let first = Change::at(&built, &bounced);
    let frequencies = frequencies(context, &built);
    let found = match goes_on {
        true => returns::follow(context, &mut built, &frequencies, interrupt),
        false => Ok(Returned::default()),
    };
    let found = found.and_then(|returned| {
        let interrupt = if goes_on { interrupt } else { &at_once };
        Ok((ran(&built, interrupt)?, returned))
    });
    let (found, returned) = match found {
        Ok(found) => found,
        Err(problem) => return Some(After::none(Vec::new(), broken(stop, problem.found))),
    };
    let went = Went {
        bounced,
        first,
        frequencies,
        returned,
    };
    let quantities = named(context, &found, &went);
    if !goes_on {
        let why = "the drop before it did not end as planned";
        return Some(After::none(without_values(quantities, why), stop));
    }
    let mut list = warnings::of_course(&found);
    let first = scatters(&went).into_iter().chain(lifted(&went.returned));
    let sliding = slid(context, &found, &went)
        .into_iter()
        .chain(slides(context, &found));
    let harder = context.parts().enumerate();
    let harder = harder.filter_map(|(k, name)| hits_harder(context, &found, &went, k, name));
    list.splice(0..0, first.chain(harder).chain(sliding));
    let ended = coast_down::stop(&found.free);
    Some(After {
        quantities,
        warnings: list,
        stop: Stop {
            text: format!("{} {}", way(context, &went), ended.text),
            ..ended
        },
        steps: found.free.state.steps as u64 + went.steps(),
    })
}

/// The first change from motion to laws.
struct Change {
    time: f64,
    speed: f64,
    /// Whether there was one.
    never: bool,
    /// Kinetic energy after it less that before, J.
    energy: f64,
}

impl Change {
    fn at(built: &Built, bounced: &Bounced) -> Self {
        let start = &built.start;
        let after = 0.5 * built.inertia * start.speed * start.speed;
        let sides = f64::from(built.sides);
        Change {
            time: start.time,
            speed: start.speed,
            never: start.ended.is_some(),
            energy: (bounced.kinetic).map_or(0.0, |before| after - sides * before),
        }
    }
}

/// How the run went between its fidelities.
struct Went {
    bounced: Bounced,
    first: Change,
    /// Natural frequencies of the rotor that rolls, below the speed of the first change, the highest first, rad/s.
    frequencies: Vec<f64>,
    returned: Returned,
}

impl Went {
    /// Windows of all stretches.
    fn windows(&self) -> impl Iterator<Item = &Bounced> {
        let again = self.returned.list.iter().map(|again| &again.windows);
        std::iter::once(&self.bounced).chain(again)
    }
    fn steps(&self) -> u64 {
        self.windows().map(|windows| windows.steps).sum::<u64>() + self.returned.looked
    }
    /// The largest contact force of a bearing in all windows, N, and when, s, and at which speed, rad/s.
    fn peak(&self, bearing: usize) -> Option<[f64; 3]> {
        let each = self
            .windows()
            .filter_map(|windows| windows.peaks.get(bearing));
        each.copied().reduce(|a, b| if b[0] > a[0] { b } else { a })
    }
    /// Relative standard errors of the powers of all windows.
    fn scatter(&self) -> Vec<f64> {
        let each = self.windows().flat_map(|windows| &windows.scatter);
        each.copied().collect()
    }
}

/// How the run went from ball by ball into slow time and back, in words.
fn way(context: &Context, went: &Went) -> String {
    let first = &went.first;
    let at_once = (went.returned.list.first()).is_some_and(|again| again.from[0] <= first.time);
    let rolled = match at_once {
        true => String::new(),
        false => format!(
            "From {:.4} s on the rotor rolled, losing what laws say, and ran out by them, from {:.1} rad/s.",
            first.time, first.speed
        ),
    };
    let mut list = match (went.bounced.scatter.len(), first.never) {
        (0, false) => vec![rolled],
        (count, never) => {
            let last = match never {
                false => rolled,
                true => "It never rolled.".to_string(),
            };
            vec![format!(
                "After {:.4} s the rotor did not roll: {count} windows ball by ball followed, in slow time between them. {last}",
                context.finished.ending.time
            )]
        }
    };
    list.extend(went.returned.list.iter().map(Return::words));
    list.retain(|sentence| !sentence.is_empty());
    list.join(" ")
}

/// Relative standard error of a window's power above which it is told.
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

/// Every result of a drop with those of what came after.
pub(crate) fn quantities(context: &Context, after: Option<&After>) -> Vec<Quantity> {
    let mut list = quantities::name(context);
    if let Some(after) = after {
        for name in context.parts() {
            count_run_out(&mut list, name, &after.quantities);
        }
        list.extend(after.quantities.iter().cloned());
    }
    list
}

impl After {
    /// Whether it warns of this.
    pub(crate) fn says(&self, code: &str) -> bool {
        self.warnings.iter().any(|warning| warning.code == code)
    }
    fn none(quantities: Vec<Quantity>, stop: Stop) -> After {
        After {
            quantities,
            warnings: Vec::new(),
            stop,
            steps: 0,
        }
    }
}

fn broken(stop: Stop, why: String) -> Stop {
    Stop {
        reason: "left the model",
        text: format!("{} The run-out could not be computed: {why}.", stop.text),
        ..stop
    }
}

fn without_values(mut quantities: Vec<Quantity>, why: &str) -> Vec<Quantity> {
    for quantity in &mut quantities {
        quantity.value = match quantity.value {
            Value::List(_) => Value::List(Vec::new()),
            _ => Value::None {
                why: why.to_string(),
            },
        };
    }
    quantities
}

/// The machine of the run-out, from the state in which the drop ended.
fn built(context: &Context, end: &RunOut, goes_on: bool) -> Result<Built, String> {
    let (drop, machine) = (context.drop, context.machine);
    let ending = &context.finished.ending;
    let rotor = &machine.constants.rotor;
    let sides = drop.rotor.planes;
    let whole = f64::from(sides);
    let mut parts: Vec<Part> = Vec::new();
    let mut temperatures: Vec<f64> = Vec::new();
    let (mut held, mut at_limits) = (Vec::new(), Vec::new());
    let mut beyond_data = Vec::new();
    for (k, name) in context.parts().enumerate() {
        let given = context.given(k).warm.as_deref();
        let (Some(warm), Some(warmth)) = (given, &context.record(k).warmth) else {
            return Err("the temperatures of a bearing are not followed".to_string());
        };
        let mut one = part(warm, name.to_string(), sides).map_err(|problem| problem.found)?;
        let constants = &machine.constants.bearings[k];
        let contact = &constants.contact;
        if let Some(warm) = &constants.warm {
            one.network.clone_from(&warm.network);
        }
        one.load_direction = drop.gravity.direction;
        one.losses.ratio = 1.0 - contact.radial_clearance / contact.bore_radius;
        parts.push(one);
        temperatures.extend(&warmth.temperatures);
        beyond_data.push(warmth.beyond_data);
        match &warmth.held {
            Some(own) => {
                held.push(own.held.clone());
                at_limits.extend(&own.temperatures);
            }
            None => {
                held.push(Held::at(warm.limits().into_iter().collect()));
                at_limits.extend(&warmth.temperatures);
            }
        }
    }
    let spin = ending.state[machine.layout().rotor.spin()].abs();
    let content = machine.content(&ending.state);
    let kinetic = content.translation + content.spin;
    let (speed, inertia) = match goes_on && spin > 0.0 {
        true => (spin, whole * 2.0 * kinetic / (spin * spin)),
        false => (drop.rotor.speed.abs(), drop.rotor.polar_inertia),
    };
    let bearings = parts.len();
    Ok(Built {
        parts,
        sides,
        inertia,
        energy: 0.5 * inertia * speed * speed,
        warm_from: temperatures.clone(),
        rotor: RotorDrag {
            torque: whole * rotor.brake_torque,
            drag: whole * rotor.drag,
            drag_square: whole * rotor.drag_square,
        },
        brake_start: match drop.rotor.spin {
            crate::scenario::Spin::Braked { start, .. } => start,
            _ => 0.0,
        },
        end: *end,
        start: Start::at(ending.time, speed, temperatures, bearings)
            .holding(Held::together(&held), at_limits)
            .beyond(beyond_data),
    })
}

/// The results under their names: those of the run-out, and its course over time.
fn named(context: &Context, found: &Ran, went: &Went) -> Vec<Quantity> {
    let mut list = List(Vec::new());
    let first = &went.first;
    list.number("start_time", "s", Ok(first.time), &CHANGE);
    list.number("start_speed", "rad/s", Ok(first.speed), &CHANGE);
    let scatter = went.scatter();
    list.number("windows", "", Ok(scatter.len() as f64), &WINDOWS);
    let worst = scatter.iter().copied().fold(0.0, f64::max);
    list.number("window_scatter", "1", Ok(worst), &WINDOWS);
    list.number("change_of_model", "J", Ok(first.energy), &CHANGE);
    for (k, (_, part)) in found.parts().enumerate() {
        let peak = went.peak(k).ok_or("no windows ball by ball".to_string());
        let name = of_part(&part.name, "peak_contact_force");
        list.number(&name, "N", peak.map(|[force, ..]| force), &PEAK);
        if let (Some(bearing), Some(pressure)) =
            (&context.given(k).bearing, pressure(context, found, k))
        {
            list.indentation_index(&part.name, pressure, bearing);
        }
    }
    of_run_out::name(found, &mut list);
    let returned = &went.returned;
    let frequencies = went.frequencies.iter().rev().copied().collect();
    let of_returns = |of: fn(&Return) -> f64| returned.list.iter().map(of).collect();
    for (name, unit, values, origin) in [
        ("natural_frequencies", "rad/s", frequencies, &FREQUENCIES),
        (
            "passed_frequencies",
            "rad/s",
            returned.passed.clone(),
            &RESONANCES,
        ),
        (
            "resonance_excess",
            "1",
            returned.excess.clone(),
            &RESONANCES,
        ),
        (
            "return_times",
            "s",
            of_returns(|again| again.from[0]),
            &RETURNS,
        ),
        (
            "return_speeds",
            "rad/s",
            of_returns(|again| again.from[1]),
            &RETURNS,
        ),
        (
            "return_end_times",
            "s",
            of_returns(|again| again.to[0]),
            &RETURNS,
        ),
        (
            "return_changes_of_model",
            "J",
            of_returns(|again| again.change),
            &RETURNS,
        ),
    ] {
        list.push(name, unit, Value::List(values), origin);
    }
    let parts: Vec<&str> = (found.parts())
        .map(|(_, part)| part.name.as_str())
        .filter(|name| !name.is_empty())
        .collect();
    // those of a bearing keep its name before everything else
    let split = |name: &str| -> (String, String) {
        let own = parts
            .iter()
            .find_map(|part| Some((part, name.strip_prefix(*part)?.strip_prefix('.')?)));
        match own {
            Some((part, rest)) => (part.to_string(), rest.to_string()),
            None => (String::new(), name.to_string()),
        }
    };
    for column in history(found) {
        let (part, rest) = split(&column.name);
        let name = of_part(&part, &format!("{OVER_TIME}.{rest}"));
        list.push(&name, column.unit, Value::List(column.values), &COURSE);
    }
    let rename = |quantity: Quantity| {
        let (part, rest) = split(&quantity.name);
        Quantity {
            name: of_part(&part, &format!("{RUN_OUT}.{rest}")),
            ..quantity
        }
    };
    list.0.into_iter().map(rename).collect()
}

/// Largest pressure of balls and races in windows, Pa; none without windows.
fn pressure(context: &Context, found: &Ran, bearing: usize) -> Option<f64> {
    let seen = found.rows(bearing).filter_map(|row| row.balls.as_ref());
    let [inner, outer] = (seen.map(|balls| balls.largest))
        .reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])])?
        .map(|value| Peak { value, time: 0.0 });
    let factors = context.built.bearings[bearing].pressure_factors;
    Some(factors.pressures([inner, outer], Peak::NONE).races)
}

/// Natural frequencies of the rotor on bearings in which it rolls, below the speed that the run-out starts with, the highest first, rad/s:
/// balls under the weight and landing surface in series, then the moving mass on its mount, without gyroscopic moments.
fn frequencies(context: &Context, built: &Built) -> Vec<f64> {
    let constants = &context.machine.constants;
    let own = &constants.rotor.coordinates;
    let n = own.len();
    let count = n + constants.bearings.len();
    let mut stiffness = DMatrix::zeros(count, count);
    let mut masses: Vec<f64> = own.iter().map(|coordinate| coordinate.mass).collect();
    for (k, coordinate) in own.iter().enumerate() {
        stiffness[(k, k)] = coordinate.mass * coordinate.frequency * coordinate.frequency;
    }
    for (b, (bearing, part)) in constants.bearings.iter().zip(&built.parts).enumerate() {
        let zone = &part.zone;
        let clearance = zone.clearance.at_reference;
        let at = |load: f64| displacement(load, zone.stiffness, clearance, &zone.angles, 1.0);
        let load = zone.load;
        let balls = 0.1 * load / (at(1.05 * load) - at(0.95 * load));
        let contact = &bearing.contact;
        let landing = contact.exponent
            * contact.stiffness.powf(1.0 / contact.exponent)
            * load.powf(1.0 - 1.0 / contact.exponent);
        let mut row = DVector::zeros(count);
        row.rows_mut(0, n).copy_from_slice(&bearing.node);
        row[n + b] = -1.0;
        stiffness += &row * row.transpose() / (1.0 / balls + 1.0 / landing);
        stiffness[(n + b, n + b)] += bearing.mount.stiffness;
        masses.push(bearing.outer_moving_mass());
    }
    for (k, a) in masses.iter().enumerate() {
        for (l, b) in masses.iter().enumerate() {
            stiffness[(k, l)] /= (a * b).sqrt();
        }
    }
    let squares = stiffness.symmetric_eigen().eigenvalues;
    let mut list: Vec<f64> = squares
        .iter()
        .map(|square| square.max(0.0).sqrt())
        .collect();
    list.retain(|frequency| *frequency > 0.0 && *frequency < built.start.speed);
    list.sort_by(|a, b| b.total_cmp(a));
    list
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
    let on = match name {
        "" => String::new(),
        name => format!(" on {name}"),
    };
    let limit = context
        .given(bearing)
        .bearing
        .as_ref()?
        .hertz_pressure_limit;
    let share = (pressure(context, found, bearing)? / limit).powi(3);
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

/// Share of the energy lost in windows from which on friction of rotor and race is sliding, not the creep of one that rolls.
const SLIDES: f64 = 0.01;

/// How long and how far the rotor slid on its races while windows followed it.
fn slid(context: &Context, found: &Ran, went: &Went) -> Option<Warning> {
    let first = [context.finished.ending.time, went.first.time];
    let again = went.returned.list.iter();
    let stretches = std::iter::once((first, &went.bounced))
        .chain(again.map(|again| ([again.from[0], again.to[0]], &again.windows)));
    let slides: Vec<_> = stretches
        .filter(|(_, windows)| windows.friction > SLIDES * windows.lost)
        .collect();
    let (begin, end) = (slides.first()?.0[0], slides.last()?.0[1]);
    let friction: f64 = slides.iter().map(|(_, windows)| windows.friction).sum();
    let carried = |(k, part): (usize, &Part)| {
        context.machine.constants.bearings[k].contact.friction * part.warm.radial_load
    };
    let force = f64::from(found.built.sides) * found.parts().map(carried).sum::<f64>();
    Some(warning(
        "AB2318",
        format!(
            "Between {begin:.1} s and {end:.1} s the rotor slides on its races in the windows that follow it: friction makes {friction:.3e} J, over about {:.3e} m of way. \
             It is in run_out.load_dependent_heat and warms both bodies; sliding_distance, wear and the temperatures of the rubbing surfaces are those of the \
             first {:.3} s alone.",
            friction / force,
            context.finished.ending.time
        ),
    ))
}

/// Bearings that brake harder than friction of rotor and race may carry, where no windows follow that: the rotor slides in them.
fn slides(context: &Context, found: &Ran) -> Vec<Warning> {
    let of_bearing = |(k, part): (usize, &Part)| {
        let most = returns::asked(context, found, k, part)?;
        let name = match part.name.as_str() {
            "" => "The bearing".to_string(),
            name => name.to_string(),
        };
        Some(warning(
            "AB2318",
            format!(
                "{name} brakes with up to {:.3} N mm in the run-out by laws, and friction of rotor and race carries {:.3} N mm: they may slide on \
                 each other there, which heats the surfaces and which this run-out does not see.",
                1e3 * most,
                1e3 * returns::carried(context, k, part)
            ),
        ))
    };
    found.parts().filter_map(of_bearing).collect()
}

/// Natural frequencies at which the rotor does not roll.
fn lifted(returned: &Returned) -> Option<Warning> {
    let found = returned.passed.iter().zip(&returned.excess);
    let lifted = found.filter(|(_, excess)| lifts(**excess));
    let list: Vec<String> = lifted
        .map(|(frequency, excess)| match excess.is_nan() {
            true => format!("{frequency:.0} rad/s, where no window ended"),
            false => format!("{frequency:.0} rad/s, {:.0} % more", 100.0 * excess),
        })
        .collect();
    (!list.is_empty()).then(|| {
        warning(
            "AB2317",
            format!(
                "The run-out passes natural frequencies of the rotor on its rolling bearings at which unbalance lifts it from rolling ({} loss than the laws \
                 say): windows ball by ball follow it there, each as long as it likes at its speed. A rotor that passes quickly is lifted less.",
                list.join("; ")
            ),
        )
    })
}

const CHANGE: Origin = Origin {
    law: "the rotor has pressed on every inner race, rotor and race, and cage, within 1 % of rolling, for 20 turns of every cage; kinetic \
          energy, temperatures and speed go on as they are",
    source: "crates/model/src/system/machine/bearing_record.rs; book/src/theory/heat.md",
    valid: "what the change loses or makes is run_out.change_of_model, kinetic energy after it less that before: nothing, but for what bounced in the last window",
};
const WINDOWS: Origin = Origin {
    law: "while the rotor does not roll: mean heats over 80 turns at held speed, 5 % slower from window to window; the largest standard error \
          of a window's power over it",
    source: "crates/auxbear/src/simulate/drop/windows.rs; book/src/theory/heat.md",
    valid: "what happens at a speed has forgotten how it came there",
};
const PEAK: Origin = Origin {
    law: "the largest contact force of the windows' batches, each 10 turns or 0.2 s",
    source: "crates/auxbear/src/simulate/drop/windows.rs",
    valid: "a sample: windows are 5 % of speed apart, and a rotor that passes quickly is lifted less; what comes by laws has the load at rest",
};
const FREQUENCIES: Origin = Origin {
    law: "eigenvalues of M⁻¹(K + Σ k φφᵀ), k of mount, balls under the weight and landing surface in series",
    source: "crates/auxbear/src/simulate/drop/run_out.rs",
    valid: "below run_out.start_speed; small motions, no gyroscopic moments, mount without further parts",
};
const RESONANCES: Origin = Origin {
    law: "natural frequencies passed by laws; losses of windows ball by ball at 1.03, 1 and 0.97 of each over those of the laws, less 1, the largest",
    source: "crates/auxbear/src/simulate/drop/windows.rs; book/src/theory/heat.md",
    valid: "the speed held there as long as it likes: a rotor that passes quickly is lifted less",
};
const RETURNS: Origin = Origin {
    law: "back from laws to windows ball by ball within 5 % of a natural frequency whose windows lose a tenth more, or where 1.2 of the moment of a \
          bearing is more than friction of rotor and race carries; until that is behind and two windows agree with the laws",
    source: "crates/auxbear/src/simulate/drop/returns.rs; book/src/theory/heat.md",
    valid: "as run_out.windows; changes: ½IΩ² of the laws that go on less kinetic energy of the motion, which bounces",
};
const COURSE: Origin = Origin {
    law: "the run-out over run_out.over_time.time",
    source: "crates/thermal/src/coast_down.rs",
    valid: "as run_out.stop_time",
};
