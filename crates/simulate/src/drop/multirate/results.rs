//! The results of a drop that goes on until the rotor stands.
//!
//! The spin that the coast-down starts with is all the kinetic energy there is at the change, over the square of the speed: nothing is
//! lost or made by it.

use crate::bearing::races::count_coast_down;
use crate::bearing::severity::STEEL_CHANGES;
use crate::bearing::warm::Heated;
use crate::coast_down::build::{CoastDownModel, Part, Start, part};
use crate::coast_down::measured::measured;
use crate::coast_down::passages::limits;
use crate::coast_down::rows::Row;
use crate::coast_down::run::{CoastDownRun, run};
use crate::coast_down::{self, history, quantities as of_coast_down};
use crate::drop::context::{Context, Setup};
use crate::drop::multirate::series::{Place, SeenBearing, Stretch};
use crate::drop::multirate::{self, IntervalSeries, warnings};
use crate::drop::quantities;
use crate::drop::surfaces::{no_width, wear_depth};
use crate::drop::torque;
use crate::ending;
use model::system::layout::of_part;
use model::system::machine::MOST_SPEEDS;
use model::system::machine::record::ROLLS;
use number::Vec2;
use outcome::list::results;
use outcome::list::{List, not_given, origins};
use outcome::{Quantity, Stop, Value, Warning};
use physics::viscosity::Viscosity;
use problem::warning::Declared;
use scenario::{AuxiliaryBearing, CoastDownEnd, Warm};
use std::sync::atomic::AtomicBool;
use thermal::held::Held;
use thermal::warm_machine::RotorDrag;

/// Before the names of the results of a coast-down.
const COAST_DOWN: &str = "coast_down";
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
    /// Quasi-steady steps.
    pub steps: u64,
    /// When the rotor came to each of the speeds at which something happens, and when all of it ended, s.
    pub reached: ([f64; MOST_SPEEDS], f64),
}

/// Follows a drop until the rotor stands; none where that is not asked.
pub(crate) fn after(
    context: &Context,
    interrupt: &AtomicBool,
    progress: &dyn Fn(f64),
) -> Option<After> {
    let end = context.setup.drop().coast_down.as_ref()?;
    let ending = &context.finished.ending;
    let stop = ending::stop(ending);
    let rolls = ending.stop == solve::Stop::Halted(ROLLS);
    let goes_on = rolls || ending.stop == solve::Stop::Finished;
    let mut built = match built(context, end, goes_on) {
        Ok(built) => built,
        Err(why) => return Some(After::none(context, Vec::new(), broken(stop, why))),
    };
    let series = match goes_on {
        true => multirate::follow(context, &mut built, interrupt, progress),
        false => IntervalSeries::default(),
    };
    // what a coast-down finds has its names, also where there is none
    let at_once = AtomicBool::new(!goes_on);
    let found = match run(&built, if goes_on { interrupt } else { &at_once }) {
        Ok(found) => found,
        Err(problem) => {
            return Some(After::none(
                context,
                Vec::new(),
                broken(stop, problem.found),
            ));
        }
    };
    let went = Followed {
        series: &series,
        context,
    };
    let quantities = named(context.setup, &built.parts, Some((&found, &went)));
    if !goes_on {
        let why = "the drop before it did not end as planned";
        return Some(After::none(context, without_values(quantities, why), stop));
    }
    let list = warnings::of(context, &found, &series);
    let ended = coast_down::stop(&found.free);
    Some(After {
        quantities,
        warnings: list,
        stop: Stop {
            text: format!("{} {}", words(context, &built, &series), ended.text),
            ..ended
        },
        steps: found.free.state.steps as u64 + series.steps,
        reached: reached(context, &found.free.rows),
    })
}

/// When the rotor came to each speed at which something happens, in the drop or after it, and the end of the coast-down.
fn reached(context: &Context, rows: &[Row]) -> ([f64; MOST_SPEEDS], f64) {
    let mut all = context.reached;
    for (own, at) in (context.setup.machine.constants.at_speeds.iter()).zip(&mut all) {
        let passes = |pair: &&[Row]| pair[0].speed > own.speed && pair[1].speed <= own.speed;
        let waits = !at.is_finite() && !own.rising;
        if let Some([before, after]) = rows.windows(2).find(passes).filter(|_| waits) {
            let share = (before.speed - own.speed) / (before.speed - after.speed);
            *at = before.time + share * (after.time - before.time);
        }
    }
    (all, rows.last().map_or(context.end, |row| row.time))
}

/// How it was followed, in words.
fn words(context: &Context, built: &CoastDownModel, series: &IntervalSeries) -> String {
    let first = format!(
        "After {:.4} s of the drop {} ball-by-ball intervals followed, with quasi-steady steps between them.",
        context.finished.ending.time, series.intervals
    );
    let rolls = match series.rolled {
        Some(place) => format!(
            "The rotor rolled from {:.4} s and {:.1} rad/s on.",
            place.time, place.speed
        ),
        None => "It never rolled.".to_string(),
    };
    let again = series.stretches.iter().filter(|stretch| !stretch.first);
    let mut list = vec![first, rolls];
    list.extend(again.map(|stretch| stretch.words(built)));
    list.join(" ")
}

/// Every result of a drop with those of what came after.
pub(crate) fn quantities(context: &Context, after: Option<&After>) -> Vec<Quantity> {
    let mut list = quantities::name(context.setup, Some(context));
    if let Some(after) = after {
        for name in context.setup.parts() {
            count_coast_down(&mut list, name, &after.quantities);
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
    fn none(context: &Context, quantities: Vec<Quantity>, stop: Stop) -> After {
        After {
            quantities,
            warnings: Vec::new(),
            stop,
            steps: 0,
            reached: (context.reached, context.end),
        }
    }
}

fn broken(stop: Stop, why: String) -> Stop {
    Stop {
        reason: "left the model",
        text: format!("{} The coast-down could not be computed: {why}.", stop.text),
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

/// Why there is no coast-down of a bearing.
const NOT_FOLLOWED: &str = "the temperatures of a bearing are not followed";

/// The bearings of the coast-down under these forces at nodes of the rotor, N.
pub(super) fn parts(setup: Setup, forces: &[(usize, Vec2<f64>)]) -> Result<Vec<Part>, String> {
    let loads = setup.drop().loads(forces);
    let of_bearing = |(k, name): (usize, &str)| {
        let given = setup.given(k);
        let (load, direction) = loads[k];
        let warm = Warm {
            radial_load: load,
            ..given.warm.as_deref().ok_or(NOT_FOLLOWED)?.clone()
        };
        let constants = &setup.machine.constants.bearings[k];
        let (planes, own) = (constants.planes, constants.warm.as_deref());
        let one = match own.filter(|_| constants.spatial().is_some()) {
            Some(own) => {
                let oil = own.oil.unwrap_or(Viscosity::constant(own.viscosity));
                measured(&warm, name.to_string(), planes, oil)
            }
            None => part(&warm, name.to_string(), planes),
        };
        let mut one = one.map_err(|why| why.found)?;
        let contact = &constants.contact;
        if let Some(own) = own {
            one.network.clone_from(&own.network);
        }
        one.load_direction = direction;
        one.losses.ratio = 1.0 - contact.radial_clearance / contact.bore_radius;
        if let Some(bearing) = &given.bearing {
            one.pressure_limit = bearing.hertz_pressure_limit;
        }
        Ok(one)
    };
    setup.parts().enumerate().map(of_bearing).collect()
}

/// The machine of the coast-down, from the state in which the drop ended.
fn built(context: &Context, end: &CoastDownEnd, goes_on: bool) -> Result<CoastDownModel, String> {
    let (drop, machine) = (context.setup.drop(), context.setup.machine);
    let ending = &context.finished.ending;
    let rotor = &machine.constants.rotor;
    let parts = parts(context.setup, &[])?;
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
    let content = context.finished.at_end().content(&ending.state);
    let kinetic = content.translation + content.spin;
    let (speed, inertia) = match goes_on && spin > 0.0 {
        true => (spin, 2.0 * kinetic / (spin * spin)),
        false => (drop.rotor.speed.abs(), drop.body.polar_inertia),
    };
    let bearings = parts.len();
    Ok(CoastDownModel {
        parts,
        inertia,
        thrust: drop.body.mass * drop.gravity.axial.abs(),
        energy: 0.5 * inertia * speed * speed,
        warm_from: temperatures.clone(),
        rotor: RotorDrag {
            torque: 0.0,
            drag: rotor.drag,
            drag_square: rotor.drag_square,
        },
        brakes: torque::coming(&machine.constants, &context.reached, speed),
        load: rotor.torque.clone(),
        end: *end,
        start: Start::at(ending.time, speed, temperatures, bearings)
            .holding(Held::together(&held), at_limits)
            .beyond(beyond_data),
        motion: None,
    })
}

/// The results of the coast-down of a drop, without values.
pub(crate) fn results(setup: Setup) -> Vec<Quantity> {
    let parts = parts(setup, &[]).unwrap_or_default();
    named(setup, &parts, None)
}

/// The results under their names: those of the coast-down, and its course over time.
fn named(setup: Setup, parts: &[Part], run: Option<(&CoastDownRun, &Followed)>) -> Vec<Quantity> {
    let mut list = List::default();
    let went = run.map(|(_, went)| went);
    change(&mut list, &(), went);
    for (k, part) in parts.iter().enumerate() {
        list.of_part(&part.name, |list| peaks(list, &k, went));
    }
    for (k, part) in parts.iter().enumerate() {
        list.of_part(&part.name, |list| patch(list, &(k, setup.given(k)), went));
    }
    for (k, part) in parts.iter().enumerate() {
        if let Some(heated) = setup.heated(k).filter(Heated::presses) {
            let found = run.and_then(|(found, _)| heated.preloads(found.temperatures(k)));
            list.of_part(&part.name, |list| preloads(list, &(), found.as_ref()));
        }
    }
    of_coast_down::name(&mut list, parts, run.map(|(found, _)| found));
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
        quantity.name = under(&quantity.name, COAST_DOWN);
    }
    list.quantities
}

/// A coast-down that was followed.
struct Followed<'a> {
    series: &'a IntervalSeries,
    context: &'a Context<'a>,
}

impl Followed<'_> {
    /// What exists where the rotor came to roll.
    fn rolled(&self, of: fn(&Place) -> f64) -> Result<f64, String> {
        let never = || "the rotor never rolled".to_string();
        self.series.rolled.as_ref().map(of).ok_or_else(never)
    }
    /// A value of each stretch after the first.
    fn again(&self, of: fn(&Stretch) -> f64) -> Vec<f64> {
        let again = self.series.stretches.iter();
        again.filter(|stretch| !stretch.first).map(of).collect()
    }
    /// What intervals have seen of a bearing.
    fn seen(&self, k: usize, of: impl Fn(&SeenBearing) -> f64) -> Result<f64, String> {
        let none = || "no ball-by-ball interval".to_string();
        self.series.bearings.get(k).map(of).ok_or_else(none)
    }
    /// Mean depth worn off, m.
    fn wear(&self, k: usize) -> Result<f64, String> {
        let contact = &self.context.setup.given(k).contact;
        if contact.friction_coefficient == 0.0 {
            return Err("without friction the ledger does not tell the sliding".to_string());
        }
        self.seen(k, |seen| wear_depth(contact, seen.rubbed.work))
    }
}

results! {
    fn change(setup: &(), run: &Followed) {
        "start_time": instant "s" headline, CHANGE, "instant from which on the rotor rolls" in note "Stands after: rolls from" => run.rolled(|place| place.time);
        "start_speed": number "rad/s", CHANGE, "speed of the rotor at this instant" => run.rolled(|place| place.speed);
        "windows": number "", INTERVALS, "number of ball-by-ball intervals" => run.series.intervals as f64;
        "window_scatter": number "1", INTERVALS, "largest standard error of a mean power over it" => run.series.error;
        "step_error": number "1", STEPS, "largest error of a quasi-steady step between two intervals" => run.series.step_error.ok_or_else(|| "no step led from one interval to another".to_string());
    }
    fn peaks(k: &usize, run: &Followed) {
        "peak_contact_force": number "N", PEAK, "largest contact force in the intervals" => run.seen(*k, |seen| seen.force.value);
        "largest_rotor_displacement": number "m", PEAK, "largest displacement of the rotor in the intervals" => run.seen(*k, |seen| seen.rotor_displacement);
        "largest_mount_displacement": number "m", PEAK, "largest displacement of the mount in the intervals" => run.seen(*k, |seen| seen.mount_displacement);
    }
    fn patch(of: &(usize, &AuxiliaryBearing), run: &Followed) {
        "contact_temperature_rise": number "K", PATCH, "largest rise of the contact patch in the intervals", unless no_width(of.1) => run.seen(of.0, |seen| seen.rise.value);
        "contact_temperature_index": number "1", PATCH_INDEX, "this rise over that which changes steel" in worst "contact of rotor and race too hot", unless no_width(of.1) => {
            run.seen(of.0, |seen| seen.rise.value / STEEL_CHANGES)
        };
        "peak_axial_force": number "N", PEAK, "largest force on the faces in the intervals" when of.1.contact.faces.any() => run.seen(of.0, |seen| seen.thrust.value);
        "sliding_distance": number "m", SLIDING, "distance slid by rotor and race", unless no_width(of.1) => run.seen(of.0, |seen| seen.rubbed.distance);
        "wear_depth": number "m", WEAR, "mean depth worn off" in added_up "wear depth", unless {
            not_given("contact.surface.wear_coefficient", of.1.contact.wear_coefficient).or(no_width(of.1))
        } => run.wear(of.0);
    }
    fn preloads(setup: &(), run: &[f64; 2]) {
        "smallest_preload": number "N", PRELOAD, "smallest preload at rest that the temperatures leave" => run[0];
        "largest_preload": number "N", PRELOAD, "largest preload at rest that the temperatures give" => run[1];
    }
    /// Where the rotor rolled no longer.
    fn back(setup: &(), run: &Followed) {
        "return_times": list "s", RETURNS, "begins of the stretches in which it rolls no longer" => run.again(|stretch| stretch.from.time);
        "return_speeds": list "rad/s", RETURNS, "speed of the rotor at these instants" => run.again(|stretch| stretch.from.speed);
        "return_end_times": list "s", RETURNS, "ends of these stretches" in note "Stands after: rolls again from" => run.again(|stretch| stretch.to.time);
    }
}

origins! {
    CHANGE: law "an interval in which the bearings take what laws of rolling say within 3 % and the contact force is below 1.5 of the load at rest; with bearings in \
          space friction of rotor and races makes less than 3 % of the losses, and weight along the shaft counts in the load",
        source "crates/simulate/src/drop/multirate/leap.rs; book/src/theory/heat.md",
        valid "within the leap before it: no more than 22 % of speed";
    INTERVALS: law "batches of a turn, or of half a period of √(g/c0) where that is slower; standard error from the batches, their correlation and their drift, \
          the largest by which a leap was taken",
        source "crates/simulate/src/drop/multirate/batch.rs; book/src/theory/heat.md",
        valid "what a motion does at a speed depends on speed, temperatures and the branch it is on";
    STEPS: law "max(|Δt_again − Δt|/(t + t_r), |T_again − T|/50 K) of a step with both of its ends known against the one that predicted it; above \
          coast_down.tolerance only of steps of at most 4 % of speed, which are taken whatever their error",
        source "crates/simulate/src/drop/multirate/mod.rs; book/src/theory/heat.md",
        valid "the corrected step is taken: its own error is smaller";
    PEAK: law "the largest of all intervals and of the way to them",
        source "crates/simulate/src/drop/multirate/interval.rs",
        valid "a sample: intervals are up to 22 % of speed apart, the way to them has one batch each 4 %";
    PATCH: law "the largest rise of the patch of rotor and race above the start in the intervals, with surface layers that carry on from one to the next",
        source "crates/model/src/surface_heat.rs; crates/simulate/src/drop/multirate/interval.rs",
        valid "as contact_temperature_rise; a sample";
    PATCH_INDEX: law "coast_down.contact_temperature_rise over 500 K",
        source "tempering and transformation of bearing steel, rounded down",
        valid "1: the surface of steel changes; other materials and coatings have limits of their own";
    SLIDING: law "∫|u| dt, the mean sliding speeds of the intervals along straight lines between them",
        source "crates/simulate/src/drop/multirate/macro_step.rs",
        valid "until the last interval: a rotor that rolls to its standstill slides no more";
    WEAR: law "k ∫N |u| dt over the landing surface of the race, k = contact.surface.wear_coefficient, as of the sliding distance",
        source "crates/simulate/src/drop/multirate/macro_step.rs",
        valid "as wear_depth of the drop";
    PRELOAD: law "as smallest_preload of the drop, over the course of the coast-down",
        source "crates/model/src/spatial/ball.rs; book/src/theory/spatial.md",
        valid "as smallest_preload";
    RETURNS: law "intervals, after one in which it rolled, that lose 3 % more or less than laws say or press with 1.5 of the load at rest; of bearings in space as \
          coast_down.start_time",
        source "crates/simulate/src/drop/multirate/series.rs; book/src/theory/heat.md",
        valid "as coast_down.windows";
    COURSE: law "the coast-down over coast_down.over_time.time",
        source "crates/thermal/src/coast_down.rs",
        valid "as coast_down.stop_time";
}
