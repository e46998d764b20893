//! What follows a drop until the rotor stands: a run-out in slow time, from where it rolls in its bearings.
//!
//! The spin that the run-out starts with is all the kinetic energy there is at the change, over the square of the speed: nothing is
//! lost or made by it.

use crate::bearing::races::count_run_out;
use crate::bearing::severity::STEEL_CHANGES;
use crate::coast_down::build::{Built, Part, Start, part};
use crate::coast_down::passages::limits;
use crate::coast_down::ran::{Ran, ran};
use crate::coast_down::{self, history, quantities as of_run_out};
use crate::drop::context::{Context, Setup};
use crate::drop::returns::{self, Return, Returned};
use crate::drop::went::{Change, Went, way};
use crate::drop::window::Last;
use crate::drop::windows::{self, Bounced};
use crate::drop::{quantities, run_out_warnings};
use crate::ending;
use model::system::layout::of_part;
use model::system::machine::record::ROLLS;
use outcome::list::results;
use outcome::list::{List, not_given, origins};
use outcome::{Quantity, Stop, Value, Warning};
use problem::warning::Declared;
use scenario::RunOut;
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
    let end = context.setup.drop().run_out.as_ref()?;
    let ending = &context.finished.ending;
    let stop = ending::stop(ending);
    let rolls = ending.stop == solve::Stop::Halted(ROLLS);
    let goes_on = rolls || ending.stop == solve::Stop::Finished;
    let mut built = match built(context, end, goes_on) {
        Ok(built) => built,
        Err(why) => return Some(After::none(Vec::new(), broken(stop, why))),
    };
    let mut motion = Last::of(context);
    let bounced = match goes_on {
        true => windows::follow(context, (&mut built, &mut motion), rolls, interrupt),
        false => Bounced::default(),
    };
    // what a run-out finds has its names, also where there is none
    let at_once = AtomicBool::new(true);
    let first = Change::at(&built, &bounced);
    let found = match goes_on {
        true => returns::follow(context, (&mut built, &mut motion), interrupt),
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
        rolled: rolls,
        bounced,
        first,
        returned,
    };
    let quantities = named(context.setup, &built.parts, Some((&found, &went)));
    if !goes_on {
        let why = "the drop before it did not end as planned";
        return Some(After::none(without_values(quantities, why), stop));
    }
    let list = run_out_warnings::of(context, &found, &went);
    let ended = coast_down::stop(&found.free);
    Some(After {
        quantities,
        warnings: list,
        stop: Stop {
            text: format!("{} {}", way(context, &built.parts, &went), ended.text),
            ..ended
        },
        steps: found.free.state.steps as u64 + went.steps(),
    })
}

/// Every result of a drop with those of what came after.
pub(crate) fn quantities(context: &Context, after: Option<&After>) -> Vec<Quantity> {
    let mut list = quantities::name(context.setup, Some(context));
    if let Some(after) = after {
        for name in context.setup.parts() {
            count_run_out(&mut list, name, &after.quantities);
        }
        list.extend(after.quantities.iter().cloned());
    }
    list
}

impl After {
    /// Whether it warns of this.
    pub(crate) fn says(&self, kind: &Declared) -> bool {
        self.warnings.iter().any(|warning| warning.is(kind))
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

/// Why there is no run-out of a bearing.
const NOT_FOLLOWED: &str = "the temperatures of a bearing are not followed";

/// The bearings of the run-out.
fn parts(setup: Setup) -> Result<Vec<Part>, String> {
    let of_bearing = |(k, name): (usize, &str)| {
        let given = setup.given(k);
        let warm = given.warm.as_deref().ok_or(NOT_FOLLOWED)?;
        let sides = setup.drop().rotor.planes;
        let mut one = part(warm, name.to_string(), sides).map_err(|problem| problem.found)?;
        let constants = &setup.machine.constants.bearings[k];
        let contact = &constants.contact;
        if let Some(warm) = &constants.warm {
            one.network.clone_from(&warm.network);
        }
        one.load_direction = setup.drop().gravity.direction;
        one.losses.ratio = 1.0 - contact.radial_clearance / contact.bore_radius;
        if let Some(bearing) = &given.bearing {
            one.pressure_limit = bearing.hertz_pressure_limit;
        }
        Ok(one)
    };
    setup.parts().enumerate().map(of_bearing).collect()
}

/// The machine of the run-out, from the state in which the drop ended.
fn built(context: &Context, end: &RunOut, goes_on: bool) -> Result<Built, String> {
    let (drop, machine) = (context.setup.drop(), context.setup.machine);
    let ending = &context.finished.ending;
    let rotor = &machine.constants.rotor;
    let sides = drop.rotor.planes;
    let whole = f64::from(sides);
    let parts = parts(context.setup)?;
    let mut temperatures: Vec<f64> = Vec::new();
    let (mut held, mut at_limits) = (Vec::new(), Vec::new());
    let mut beyond_data = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        let warmth = (context.record(k).warmth.as_ref()).ok_or(NOT_FOLLOWED)?;
        temperatures.extend(&warmth.temperatures);
        beyond_data.push(warmth.beyond_data);
        match &warmth.held {
            Some(own) => {
                held.push(own.held.clone());
                at_limits.extend(&own.temperatures);
            }
            None => {
                held.push(Held::at(limits(&part.warm).into_iter().collect()));
                at_limits.extend(&warmth.temperatures);
            }
        }
    }
    let spin = ending.state[machine.layout().rotor.spin()].abs();
    let content = machine.content(&ending.state);
    let kinetic = content.translation + content.spin;
    let (speed, inertia) = match goes_on && spin > 0.0 {
        true => (spin, whole * 2.0 * kinetic / (spin * spin)),
        false => (drop.rotor.speed.abs(), drop.body.polar_inertia),
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
            scenario::Spin::Braked { start, .. } => start,
            _ => 0.0,
        },
        end: *end,
        start: Start::at(ending.time, speed, temperatures, bearings)
            .holding(Held::together(&held), at_limits)
            .beyond(beyond_data),
        motion: None,
    })
}

/// The results of the run-out of a drop, without values.
pub(crate) fn results(setup: Setup) -> Vec<Quantity> {
    let parts = parts(setup).unwrap_or_default();
    named(setup, &parts, None)
}

/// The results under their names: those of the run-out, and its course over time.
fn named(setup: Setup, parts: &[Part], run: Option<(&Ran, &Went)>) -> Vec<Quantity> {
    let mut list = List::default();
    let went = run.map(|(_, went)| went);
    change(&mut list, &(), went);
    for (k, part) in parts.iter().enumerate() {
        list.of_part(&part.name, |list| peaks(list, &k, went));
    }
    for (k, part) in parts.iter().enumerate() {
        list.of_part(&part.name, |list| {
            patch(list, &(k, setup.given(k).contact.width), went)
        });
    }
    of_run_out::name(&mut list, parts, run.map(|(found, _)| found));
    back(&mut list, &(), went);
    // those of a bearing keep its name before everything else
    let under = |name: &str, word: &str| {
        let named = parts.iter().filter(|part| !part.name.is_empty());
        let mut own = named.filter_map(|part| {
            let rest = name.strip_prefix(part.name.as_str())?.strip_prefix('.')?;
            Some(of_part(&part.name, &format!("{word}.{rest}")))
        });
        own.next().unwrap_or_else(|| format!("{word}.{name}"))
    };
    let rows = run.map_or(&[][..], |(found, _)| &found.free.rows);
    for column in history(parts, rows) {
        let name = under(&column.name, OVER_TIME);
        list.push(
            &name,
            column.unit,
            "course during the coast-down",
            Value::List(column.values),
            &COURSE,
        );
    }
    for quantity in &mut list.quantities {
        quantity.name = under(&quantity.name, RUN_OUT);
    }
    list.quantities
}

impl Went {
    /// What exists where the rotor came to roll.
    fn rolled(&self, value: f64) -> Result<f64, String> {
        match self.first.never {
            false => Ok(value),
            true => Err("the rotor never lost only what laws of rolling say".to_string()),
        }
    }
    /// A value of each return.
    fn returns(&self, of: fn(&Return) -> f64) -> Vec<f64> {
        self.returned.list.iter().map(of).collect()
    }
}

/// What exists where windows followed the motion.
fn windowed(value: Option<f64>) -> Result<f64, String> {
    value.ok_or_else(|| "no windows ball by ball".to_string())
}

results! {
    fn change(setup: &(), run: &Went) {
        "start_time": instant "s" headline, CHANGE, "instant from which on the rotor rolls" in note "Stands after: rolls from" => run.rolled(run.first.time);
        "start_speed": number "rad/s", CHANGE, "speed of the rotor at this instant" => run.rolled(run.first.speed);
        "windows": number "", WINDOWS, "number of windows ball by ball" => run.scatter().len() as f64;
        "window_scatter": number "1", WINDOWS, "largest standard error of a window's power over it" => run.scatter().into_iter().fold(0.0, f64::max);
        "change_of_model": number "J", CHANGE, "kinetic energy after the change less that before" => run.first.energy;
    }
    fn peaks(k: &usize, run: &Went) {
        "peak_contact_force": number "N", PEAK, "largest contact force in the windows" => windowed(run.peak(*k).map(|[force, ..]| force));
    }
    fn patch(of: &(usize, Option<f64>), run: &Went) {
        "contact_temperature_rise": number "K", PATCH, "largest rise of the contact patch in the windows", unless not_given("contact.width", of.1) => {
            windowed(run.hottest(of.0).map(|[rise, _]| rise))
        };
        "contact_temperature_index": number "1", PATCH_INDEX, "this rise over that which changes steel" in worst "contact of rotor and race too hot", unless not_given("contact.width", of.1) => {
            windowed(run.hottest(of.0).map(|[rise, _]| rise / STEEL_CHANGES))
        };
    }
    /// Where the run-out went back from laws to windows.
    fn back(setup: &(), run: &Went) {
        "return_times": list "s", RETURNS, "begins of the returns to windows" => run.returns(|again| again.from[0]);
        "return_speeds": list "rad/s", RETURNS, "speed of the rotor at these instants" => run.returns(|again| again.from[1]);
        "return_end_times": list "s", RETURNS, "ends of the returns" in note "Stands after: rolls again from" => run.returns(|again| again.to[0]);
        "return_changes_of_model": list "J", RETURNS, "kinetic energy after each return less that before" => run.returns(|again| again.change);
    }
}

origins! {
    CHANGE: law "windows ball by ball lose what laws of rolling say within 2 % and press with less than 1.5 of the load at rest: two, or one after the rotor has pressed on every inner race, rotor and race, and cage, \
          within 1 % of rolling, for 20 turns of every cage; kinetic energy, temperatures and speed go on as they are",
        source "crates/model/src/system/machine/bearing_record.rs; book/src/theory/heat.md",
        valid "what the change loses or makes is run_out.change_of_model, kinetic energy after it less that before: nothing, but for what bounced in the last window";
    WINDOWS: law "while the rotor does not roll: mean heats over 80 turns at held speed, 5 to 19 % slower from window to window; the largest standard error \
          of a window's power over it",
        source "crates/simulate/src/drop/windows.rs; book/src/theory/heat.md",
        valid "what happens at a speed has forgotten how it came there";
    PEAK: law "the largest contact force of the windows' batches, each 10 turns or 0.2 s",
        source "crates/simulate/src/drop/windows.rs",
        valid "a sample: windows are 5 to 19 % of speed apart, and a rotor that passes quickly is lifted less; what comes by laws has the load at rest";
    PATCH: law "the largest rise of the patch of rotor and race in a batch of a window, over surfaces as warm as the hotter body when it begins, above the start",
        source "crates/model/src/surface_heat.rs; crates/simulate/src/drop/window.rs",
        valid "as contact_temperature_rise, and a lower bound: the surfaces of a batch have 10 turns or 0.2 s to warm";
    PATCH_INDEX: law "run_out.contact_temperature_rise over 500 K",
        source "tempering and transformation of bearing steel, rounded down",
        valid "1: the surface of steel changes; other materials and coatings have limits of their own";
    RETURNS: law "back from laws to windows ball by ball where the motion, followed ball by ball each 1.5 % of speed on the way of the laws, loses 3 % more or less than they \
          say or presses with 1.9 of the load at rest; until two windows agree with the laws",
        source "crates/simulate/src/drop/returns.rs; crates/simulate/src/drop/glide.rs; book/src/theory/heat.md",
        valid "as run_out.windows; changes: ½IΩ² of the laws that go on less kinetic energy of the motion, which bounces";
    COURSE: law "the run-out over run_out.over_time.time",
        source "crates/thermal/src/coast_down.rs",
        valid "as run_out.stop_time";
}
