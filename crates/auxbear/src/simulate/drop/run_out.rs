//! What follows a drop until the rotor stands: a run-out in slow time, from where it rolls in its bearings.
//!
//! The spin that the run-out starts with is all the kinetic energy there is at the change, over the square of the speed: nothing is
//! lost or made by it.

use crate::result::list::{List, Origin};
use crate::result::outcome::{Quantity, Stop, Value, Warning, warning};
use crate::scenario::RunOut;
use crate::simulate::coast_down::build::{Built, Part, Start, part};
use crate::simulate::coast_down::ran::{Ran, ran};
use crate::simulate::coast_down::{self, history, quantities, warnings};
use crate::simulate::drop::context::Context;
use crate::simulate::drop::windows::{self, Bounced};
use crate::simulate::ending;
use model::system::layout::of_part;
use model::system::machine::record::ROLLS;
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
        true => windows::follow(context, &mut built, interrupt),
        false => Bounced::default(),
    };
    // what a run-out finds has its names, also where there is none
    let at_once = AtomicBool::new(true);
    let found = ran(&built, if goes_on { interrupt } else { &at_once });
    let found = match found {
        Ok(found) => found,
        Err(problem) => return Some(After::none(Vec::new(), broken(stop, problem.found))),
    };
    let passed = passed(context, &found);
    let (excess, looked) = match goes_on {
        true => windows::looked_at(context, &found, &passed, interrupt),
        false => Default::default(),
    };
    let resonances = Resonances { passed, excess };
    let quantities = named(context, &found, &bounced, &resonances);
    if !goes_on {
        let why = "the drop before it did not end as planned";
        return Some(After::none(without_values(quantities, why), stop));
    }
    let mut list = warnings::of_course(&found);
    let first = scatters(&bounced).into_iter().chain(resonances.warning());
    list.splice(0..0, first.chain(slides(context, &found)));
    let ended = coast_down::stop(&found.free);
    Some(After {
        quantities,
        warnings: list,
        stop: Stop {
            text: format!("{} {}", way(context, &found, &bounced), ended.text),
            ..ended
        },
        steps: found.free.state.steps as u64 + bounced.steps + looked,
    })
}

/// How the run went from ball by ball into slow time, in words.
fn way(context: &Context, found: &Ran, bounced: &Bounced) -> String {
    let start = &found.built.start;
    let rolled = format!(
        "From {:.4} s on the rotor rolled, losing no more than that, and ran out by laws, from {:.1} rad/s.",
        start.time, start.speed
    );
    match (bounced.scatter.len(), &start.ended) {
        (0, None) => rolled,
        (count, ended) => {
            let last = match ended {
                None => rolled,
                Some(_) => "It never rolled.".to_string(),
            };
            format!(
                "After {:.4} s the rotor did not roll: {count} windows ball by ball followed, in slow time between them. {last}",
                context.finished.ending.time
            )
        }
    }
}

/// Relative standard error of a window's power above which it is told.
const SCATTERS: f64 = 0.1;

/// Windows whose means are not sure.
fn scatters(bounced: &Bounced) -> Option<Warning> {
    let worst = bounced.scatter.iter().copied().fold(0.0, f64::max);
    (worst > SCATTERS).then(|| {
        warning(
            "AB2319",
            format!(
                "While the rotor does not roll, the mean power of a window is known within {:.0} % (standard error of {} windows, the worst): the \
                 run-out is as uncertain there.",
                100.0 * worst,
                bounced.scatter.len()
            ),
        )
    })
}

impl After {
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
            .holding(Held::together(&held), at_limits),
    })
}

/// The results under their names: those of the run-out, and its course over time.
fn named(
    context: &Context,
    found: &Ran,
    bounced: &Bounced,
    resonances: &Resonances,
) -> Vec<Quantity> {
    let mut list = List(Vec::new());
    let start = &found.built.start;
    list.number("start_time", "s", Ok(start.time), &CHANGE);
    list.number("start_speed", "rad/s", Ok(start.speed), &CHANGE);
    list.number("windows", "", Ok(bounced.scatter.len() as f64), &WINDOWS);
    let scatter = bounced.scatter.iter().copied().fold(0.0, f64::max);
    list.number("window_scatter", "1", Ok(scatter), &WINDOWS);
    let after = 0.5 * found.built.inertia * start.speed * start.speed;
    let sides = f64::from(found.built.sides);
    let change = (bounced.kinetic).map_or(0.0, |before| after - sides * before);
    list.number("change_of_model", "J", Ok(change), &CHANGE);
    quantities::name(found, &mut list);
    list.push(
        "natural_frequencies",
        "rad/s",
        Value::List(frequencies(context, found)),
        &FREQUENCIES,
    );
    for (name, unit, list_of) in [
        ("passed_frequencies", "rad/s", &resonances.passed),
        ("resonance_excess", "1", &resonances.excess),
    ] {
        list.push(name, unit, Value::List(list_of.clone()), &RESONANCES);
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

/// Natural frequencies of the rotor on bearings in which it rolls, below the speed that the run-out starts with, rad/s: mount, balls
/// under the weight and landing surface in series, without gyroscopic moments.
fn frequencies(context: &Context, found: &Ran) -> Vec<f64> {
    let constants = &context.machine.constants;
    let own = &constants.rotor.coordinates;
    let n = own.len();
    let mut stiffness = DMatrix::from_diagonal(&DVector::from_fn(n, |k, _| {
        own[k].mass * own[k].frequency * own[k].frequency
    }));
    for (bearing, part) in constants.bearings.iter().zip(&found.built.parts) {
        let zone = &part.zone;
        let clearance = zone.clearance.at_reference;
        let at = |load: f64| displacement(load, zone.stiffness, clearance, &zone.angles, 1.0);
        let load = zone.load;
        let balls = 0.1 * load / (at(1.05 * load) - at(0.95 * load));
        let contact = &bearing.contact;
        let landing = contact.exponent
            * contact.stiffness.powf(1.0 / contact.exponent)
            * load.powf(1.0 - 1.0 / contact.exponent);
        let softness = 1.0 / bearing.mount.stiffness + 1.0 / balls + 1.0 / landing;
        let row = DVector::from_column_slice(&bearing.node);
        stiffness += &row * row.transpose() / softness;
    }
    for (k, a) in own.iter().enumerate() {
        for (l, b) in own.iter().enumerate() {
            stiffness[(k, l)] /= (a.mass * b.mass).sqrt();
        }
    }
    let squares = stiffness.symmetric_eigen().eigenvalues;
    let mut list: Vec<f64> = squares
        .iter()
        .map(|square| square.max(0.0).sqrt())
        .collect();
    list.retain(|frequency| *frequency > 0.0 && *frequency < found.built.start.speed);
    list.sort_by(f64::total_cmp);
    list
}

/// Share of what friction carries that a bearing may ask of it.
const MARGIN: f64 = 1.2;

/// Bearings that brake harder than friction of rotor and race may carry: the rotor slides in them.
fn slides(context: &Context, found: &Ran) -> Vec<Warning> {
    let of_bearing = |(k, part): (usize, &Part)| {
        let most =
            found.rows(k).map(|row| row.moment).fold(0.0, f64::max) / f64::from(found.built.sides);
        let contact = &context.machine.constants.bearings[k].contact;
        let carried = contact.friction
            * part.warm.radial_load
            * (contact.bore_radius - contact.radial_clearance);
        let name = match part.name.as_str() {
            "" => "The bearing".to_string(),
            name => name.to_string(),
        };
        (MARGIN * most > carried).then(|| {
            warning(
                "AB2318",
                format!(
                    "{name} brakes with up to {:.3} N mm in the run-out, and friction of rotor and race carries {:.3} N mm: they may slide on \
                     each other there, which heats the surfaces and which this run-out does not see.",
                    1e3 * most,
                    1e3 * carried
                ),
            )
        })
    };
    found.parts().filter_map(of_bearing).collect()
}

/// Natural frequencies that the rotor passes by laws, the highest first, rad/s.
fn passed(context: &Context, found: &Ran) -> Vec<f64> {
    let last = found.free.rows.last().map_or(0.0, |row| row.speed);
    let mut list = frequencies(context, found);
    list.retain(|frequency| *frequency > last);
    list.reverse();
    list
}

/// Natural frequencies passed by laws, and how much more the bearings take there than the laws say.
struct Resonances {
    passed: Vec<f64>,
    excess: Vec<f64>,
}

/// Excess above which the rotor is not one that rolls.
const EXCESS: f64 = 0.1;

impl Resonances {
    /// Where it does not roll.
    fn warning(&self) -> Option<Warning> {
        let found = self.passed.iter().zip(&self.excess);
        let lifted = found.filter(|(_, excess)| excess.is_nan() || **excess > EXCESS);
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
                    "The run-out by laws passes natural frequencies of the rotor on its rolling bearings at which unbalance lifts it from rolling, by \
                     windows ball by ball around them ({} loss than the laws say): forces, heat and time are underrated there.",
                    list.join("; ")
                ),
            )
        })
    }
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
const COURSE: Origin = Origin {
    law: "the run-out over run_out.over_time.time",
    source: "crates/thermal/src/coast_down.rs",
    valid: "as run_out.stop_time",
};
