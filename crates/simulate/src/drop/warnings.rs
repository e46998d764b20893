//! What the user should know before trusting the numbers of a drop.

use crate::assumptions::speed_rating;
use crate::bearing::severity::{HOT_RACE, STEEL_CHANGES, inner_race_rise};
use crate::bearing::warm;
use crate::bearing::warning_table::{CLOSES, RUNS_AWAY, SpatialWarning};
use crate::bearing::warnings as shared;
use crate::drop::context::Context;
use crate::drop::multirate::results::After;
use crate::drop::quantities::residuals;
use crate::drop::warning_table::{BENDING_SHARE, DropWarning};
use crate::drop::{axial, base, events, magnets, method, mount_results, shaft_results, surfaces};
use crate::stepping::StepRequest;
use model::auxiliary_bearing::probe::{PENETRATION, PENETRATION_SPEED};
use model::system::sampling::Peak;
use outcome::Warning;
use problem::warning::Evaluation;
use scenario::{AuxiliaryBearing, DRAWN_ON, Event, Feedback, Fidelity, Moment, Scenario};

/// Share of the largest load of a ball that one may carry for an instant beyond the bottom of its groove.
const OF_OPEN_SIDE: f64 = 0.05;
/// Share of the time since the first contact, or the last event, after which a force that still grows may rise further.
const LATE: f64 = 0.5;
/// Contacts after which pocket and bounce chaos shows in the later ones.
const CHAOTIC_CONTACTS: usize = 10;
/// Hunt-Crossley damping a·ḋ above which the law leaves its valid range.
const LARGEST_DAMPING: f64 = 0.5;

/// What decides the steps of a drop.
fn asked<'a>(context: &Context<'a>) -> StepRequest<'a> {
    method::asked(context.setup.built, context.setup.machine.tangents())
}

/// A warning of one member, and how grave it is there.
type Graded = (f64, Warning);

/// Warnings that say how grave they are.
fn graded(list: impl IntoIterator<Item = Graded>) -> Vec<Warning> {
    let told = |(grade, mut warning): Graded| {
        // what has no size is the gravest, and a number all the same: files know no other
        warning.grade = if grade.is_finite() {
            grade
        } else {
            f64::MAX.copysign(grade)
        };
        warning
    };
    list.into_iter().map(told).collect()
}

/// All warnings of a drop, the most severe first, with those of the coast-down `after` it, which one member says for all.
pub(crate) fn of(scenario: &Scenario, context: &Context, after: Option<&After>) -> Vec<Warning> {
    let drop = context.setup.drop();
    let names: Vec<&str> = context.setup.parts().collect();
    let each = |of: &dyn Fn(usize) -> Vec<Warning>| -> Vec<Warning> {
        let parts = names.iter().enumerate();
        let named = parts.flat_map(|(k, name)| of(k).into_iter().map(|own| own.of_part(name)));
        named.collect()
    };
    let mut list = each(&|k| graded(whirl(context, k)));
    for node in 0..shaft_results::clearances(context) {
        list.extend(graded(shaft_results::reached(context, node)));
    }
    list.extend(graded(shaft_results::strikes(context)));
    list.extend(each(&|k| graded(magnets::touched(context, k))));
    list.extend(graded(events::not_held(context)));
    list.extend(events::never(context));
    list.extend(events::cut_off(context));
    list.extend(base::cut_off(
        &context.setup.machine.constants,
        context.finished.ending.time,
    ));
    list.extend(graded(magnets::limited(context)));
    list.extend(graded(magnets::voltage_limited(context)));
    list.extend(each(&|k| {
        let mut list = graded(hot(context, k));
        list.extend(graded(mount_results::stopped(context, k)));
        list.extend(graded(surfaces::judged(context, k)));
        list.extend(graded(context.bearing(k).hot_skid()));
        list.extend(graded(context.followed(k).iter().flat_map(warm::judged)));
        list
    }));
    let says = |kind| after.is_some_and(|after| after.says(kind));
    // the coast-down says it of all, from where the drop left the data on, and of a bearing that closes on
    let (drawn_on, closes) = (says(DRAWN_ON), says(CLOSES) || says(RUNS_AWAY));
    list.retain(|own| !(drawn_on && own.is(DRAWN_ON) || closes && own.is(CLOSES)));
    list.extend(after.iter().flat_map(|after| &after.warnings).map(|own| {
        let mut own = own.clone();
        own.evaluation = Evaluation::Unperturbed;
        own
    }));
    list.extend(each(&|k| graded(beyond_speeds(context, k))));
    list.extend(graded(bending(context)));
    list.extend(graded(shaft_results::resonance(context)));
    list.extend(one_motion(context));
    list.extend(each(&|k| graded(preload(context, k))));
    list.extend(each(&|k| graded(in_space(context, k))));
    list.extend(graded(no_thrust(context)));
    list.extend(each(&|k| graded(too_short(context, k))));
    list.extend(each(&|k| {
        let mut list = graded(loads(context, k));
        list.extend(damping(context, k));
        list
    }));
    let most = asked(context).largest_residual(shared::LARGEST_RESIDUAL);
    let beyond = |residual: f64| Some((residual.abs(), shared::residual_beyond(most, residual)?));
    list.extend(graded(residuals(context).0.ok().and_then(beyond)));
    list.extend(each(&|k| Vec::from_iter(shaft_results::thick(context, k))));
    list.extend(shaft_results::few_modes(context));
    list.extend(shaft_results::stiff(context));
    let shafts = context.setup.built.shaft.iter();
    list.extend(shafts.flat_map(|own| own.warnings.clone()));
    let shaft = drop.shaft.as_ref();
    list.extend(shaft.and_then(|own| shaft_results::against_spin(&own.model, drop.rotor.speed)));
    let known = context.setup.machine.tangents();
    let stepping = method::stepping(context.setup.built, known);
    list.extend(asked(context).warnings(stepping.steps));
    list.extend(held_along(context));
    if drop.rotor.planes > 1 {
        let planes = f64::from(drop.rotor.planes);
        list.push(DropWarning::Planes { planes }.into());
    }
    list.extend(each(&|k| {
        let run = context.bearing(k);
        let given = context.setup.given(k).bearing.as_ref();
        let mut list = given.map_or(Vec::new(), |bearing| shared::films(&run, bearing));
        list.extend(shared::film_rise(&run));
        list.extend(given.map_or(Vec::new(), |bearing| {
            shared::law_range(bearing, run.fastest(), context.setup.drop().weight(k))
        }));
        list.extend(graded(skids(context, k)));
        list.extend(of_bearing(scenario, context, k));
        list
    }));
    list.extend(each(&|k| {
        let count = context.record(k).contacts.len();
        let contacts = count as f64;
        let late = (count > CHAOTIC_CONTACTS && !context.repeated)
            .then(|| DropWarning::ManyContacts { contacts }.into());
        let kind = (context.setup.given(k).bearing.iter()).flat_map(shared::kind);
        late.into_iter().chain(kind).collect()
    }));
    if drop.rotor.first_bending_frequency.is_none() && drop.shaft.is_none() {
        let speed = drop.rotor.speed.abs();
        list.push(DropWarning::BendingUnknown { speed }.into());
    }
    list.extend(shared::assumed(
        scenario,
        None,
        context.setup.given(0).bearing.as_ref(),
    ));
    list.extend(each(&|k| {
        let given = context.setup.given(k);
        let own = Some(given.name.as_str()).filter(|name| !name.is_empty());
        let assumed =
            own.and_then(|name| shared::assumed(scenario, Some(name), given.bearing.as_ref()));
        assumed.into_iter().collect()
    }));
    list
}

/// A rotor that runs round the bore against its spin.
fn whirl(context: &Context, k: usize) -> Option<Graded> {
    let speed = context.setup.machine.constants.speed;
    let [_, back] = context.record(k).whirl_turns.about(speed);
    (back >= 1.0).then(|| (back, DropWarning::BackwardWhirl { turns: back }.into()))
}

/// Speeds beyond those of the bearing and of its fit.
fn beyond_speeds(context: &Context, k: usize) -> Vec<Graded> {
    let Some(bearing) = &context.setup.given(k).bearing else {
        return Vec::new();
    };
    let speed = context.release_speed();
    let lift_off = shared::lift_off(bearing, speed);
    let warnings = speed_rating(bearing, speed).into_iter().chain(lift_off);
    warnings.map(|warning| (speed.abs(), warning)).collect()
}

/// A load beyond what the axial preload holds.
fn preload(context: &Context, k: usize) -> Option<Graded> {
    let drop = context.setup.drop();
    let weight = drop.weight(k);
    let peak = context.record(k).peak_contact_force();
    let peak = peak.map(|peak| (peak.value, peak.time));
    let bearing = context.setup.given(k).bearing.as_ref()?;
    let warning = shared::preload_left(bearing, ("weight", weight), peak)?;
    Some((peak.map_or(weight, |(force, _)| force.max(weight)), warning))
}

/// What a bearing in space is driven to, and what is not followed of it.
fn in_space(context: &Context, k: usize) -> Vec<Graded> {
    let Some(own) = &context.record(k).spatial else {
        return Vec::new();
    };
    let mut list = Vec::new();
    if let Some(over) = own.run_over {
        let warning = SpatialWarning::RunOver {
            ball: over.ball as f64 + 1.0,
            race: ["inner", "outer"][over.race].to_string(),
            time: over.time,
            angle: over.angle,
            load: over.load,
        };
        list.push((over.load, warning.into()));
    }
    let most = context.record(k).largest_inner_load.value;
    if let Some(open) = own.open_side.filter(|open| open.load > OF_OPEN_SIDE * most) {
        let warning = SpatialWarning::OpenSide {
            row: open.row as f64 + 1.0,
            time: open.time,
            load: open.load,
            angle: open.angle,
        };
        list.push((open.load, warning.into()));
    }
    for (row, time) in own.unloaded.iter().enumerate() {
        let Some(time) = *time else { continue };
        let row = row as f64 + 1.0;
        list.push((-time, SpatialWarning::RowUnloaded { row, time }.into()));
    }
    let part = &context.setup.machine.constants.bearings[k];
    if let Some(spring) = part.spatial().and_then(|own| own.spring) {
        let [free, solid] = own.spring_ends;
        let (preload, stiffness) = (spring.preload, spring.stiffness);
        let (travel, force) = (spring.travel, own.spring_forces[0].value);
        let warn = |time: f64, warning: SpatialWarning| (-time, warning.into());
        list.extend(free.map(|time| {
            warn(
                time,
                SpatialWarning::SpringFree {
                    time,
                    preload,
                    stiffness,
                },
            )
        }));
        list.extend(solid.map(|time| {
            warn(
                time,
                SpatialWarning::SpringSolid {
                    time,
                    travel,
                    force,
                },
            )
        }));
    }
    let Peak { value: rise, time } = own.face_heat.rise;
    if rise > STEEL_CHANGES {
        list.push((rise, SpatialWarning::HotFace { rise, time }.into()));
    }
    let angle = own
        .largest_angles
        .iter()
        .fold(0.0, |m: f64, own| m.max(own.value));
    if part.spatial().is_some_and(|own| own.groove_ends.is_none()) {
        list.push((angle, SpatialWarning::ShoulderUnknown { angle }.into()));
    }
    let given = context.setup.given(k);
    let resists = (given.bearing.as_ref()).is_some_and(|own| own.moment != Moment::None);
    if context.setup.drop().coast_down.is_some() && !resists {
        list.push((0.0, SpatialWarning::NoFriction.into()));
    }
    let left = left_out(given);
    list.extend(left.map(|left| (0.0, SpatialWarning::LeavesOut { left }.into())));
    list
}

/// What a scenario leaves out of a bearing in space; none where it leaves nothing out.
fn left_out(part: &AuxiliaryBearing) -> Option<String> {
    let heats = (part.warm.as_ref()).is_some_and(|warm| warm.heat.feedback == Feedback::Full);
    let bearing = part.bearing.as_ref();
    let grows = bearing.is_some_and(|own| own.inner_track_growth() != 0.0);
    let words = [
        (
            !part.contact.faces.any(),
            "the temperature of the bore, whose friction heat faces share",
        ),
        (
            part.mount.tilt.is_some(),
            "tilt of the outer rings (mount.tilt_stiffness)",
        ),
        (
            heats,
            "expansion of rings and balls as they heat (heat.network = \"on\", heat.feedback)",
        ),
        (
            grows,
            "expansion of the inner ring with its speed (bearing.inner_race_growth)",
        ),
    ];
    let left: Vec<_> = words
        .into_iter()
        .filter(|(followed, _)| !followed)
        .map(|(_, words)| words)
        .collect();
    (!left.is_empty()).then(|| left.join("; "))
}

/// An axial magnet that holds the rotor for the whole run.
fn held_along(context: &Context) -> Option<Warning> {
    let machine = context.setup.machine;
    let moves = machine.layout().rotor.axial;
    (moves && axial::holds_throughout(context.setup.drop()))
        .then(|| DropWarning::AxialMagnetHolds.into())
}

/// A rotor that moves along its axis where nothing stops it.
fn no_thrust(context: &Context) -> Option<Graded> {
    let machine = context.setup.machine;
    let rotor = machine.layout().rotor;
    if !rotor.axial {
        return None;
    }
    let parts = (machine.constants.bearings.iter()).filter_map(|part| part.spatial());
    let landings: Vec<_> = parts.map(|own| &own.landing).collect();
    let faces: Vec<_> = landings.iter().flat_map(|own| &own.faces).collect();
    let place = context.finished.ending.state[rotor.place()];
    let (moved, stopped) = (
        place.abs(),
        faces.iter().any(|face| face.side * place < 0.0),
    );
    // no rebound from the other face carries the rotor farther than it fell, nor friction in the bore than the clearance
    let gaps = faces
        .iter()
        .map(|face| face.side * (face.shoulder - face.place));
    let clearances = landings.iter().map(|own| own.contact.radial_clearance);
    let held = gaps.chain(clearances).fold(0.0, f64::max);
    let key = match place > 0.0 {
        true => "contact.gap_to_end",
        false => "contact.gap_to_start",
    };
    let warning = match !stopped && moved > held {
        true => SpatialWarning::Leaves {
            moved,
            key: key.to_string(),
        },
        false if faces.is_empty() => SpatialWarning::NoThrust { moved },
        false => return None,
    };
    Some((moved, warning.into()))
}

/// A run that ends before the rotor comes to a bearing or its bore, while the force on it grows, or while it slips on its race.
fn too_short(context: &Context, k: usize) -> Option<Graded> {
    let drop = context.setup.drop();
    let record = context.record(k);
    let held = match context.setup.controlled() {
        Some(given) => {
            context.finished.record.lost.is_none() || given.events.iter().any(Event::relevitates)
        }
        // what levitates the rotor of a drop ends with the release, at the start
        None => false,
    };
    if drop.coast_down.is_some() || held {
        return None;
    }
    let bore = record.contacts.first().map(|first| {
        let largest = record.peak_contact_force().map_or(0.0, |peak| peak.value);
        (first.start, record.growth.last, largest)
    });
    let face = record.spatial.as_deref().and_then(|own| {
        let first = own.first_axial_contact?;
        Some((first, own.growth.last, own.axial_force.value))
    });
    let end = context.finished.ending.time;
    let event = events::last_before(context, end);
    let late = |first: f64, last: f64| {
        let from = first.max(event);
        last > from + LATE * (end - from)
    };
    // on a face alone the rotor moves across until it comes to the bore, or turns at rest
    let place = match (bore, face) {
        (None, None) => Some("this bearing"),
        (None, Some((first, ..))) => (record.reach.last)
            .is_none_or(|last| late(first, last))
            .then_some("the bore of this bearing"),
        (Some(_), _) => None,
    };
    if let Some(place) = place {
        let place = place.to_string();
        return Some((0.0, DropWarning::NotLanded { place }.into()));
    }
    let grows = |(first, last, force): (f64, Option<f64>, f64)| {
        // bounces last about as long as the fall
        let soon = end - first < first - context.counted_from();
        let time = last.filter(|last| soon || late(first, *last))?;
        Some((force, DropWarning::StillRising { force, time }.into()))
    };
    let mut both = bore.into_iter().chain(face);
    both.find_map(grows).or_else(|| {
        // a bushing never turns, and says so
        context.setup.given(k).bearing.as_ref()?;
        let share = context.slips_at_end(k)?;
        Some((1.0 - share, DropWarning::StillSlips { share }.into()))
    })
}

/// Balls that traction cannot turn.
fn skids(context: &Context, k: usize) -> Option<Graded> {
    let steady = context.setup.built.bearings[k].steady.as_ref();
    let warning = shared::skids(steady)?;
    Some((steady.map_or(0.0, |steady| -steady.capacity), warning))
}

/// A rotor that bends where it is taken as rigid.
fn bending(context: &Context) -> Option<Graded> {
    let rotor = &context.setup.drop().rotor;
    let bending = rotor.first_bending_frequency?;
    let speed = rotor.speed.abs();
    let side = if bending < speed {
        "lies below"
    } else {
        "is near"
    };
    let warning = DropWarning::Bends {
        bending,
        side: side.to_string(),
        speed,
    };
    (BENDING_SHARE * bending < speed).then(|| (speed / bending, warning.into()))
}

/// Several bearings under a rotor that does not tilt.
fn one_motion(context: &Context) -> Option<Warning> {
    let count = context.setup.drop().auxiliary_bearings.len();
    let bearings = count as f64;
    (count > 1 && context.setup.drop().shaft.is_none())
        .then(|| DropWarning::OneMotion { bearings }.into())
}

/// Pressures and forces beyond what bearing and laws stand.
fn loads(context: &Context, k: usize) -> Vec<Graded> {
    let Some(bearing) = &context.setup.given(k).bearing else {
        return Vec::new();
    };
    let record = context.record(k);
    let pressures = context.bearing(k).pressures();
    let mut list = shared::pressure(bearing, &pressures);
    if let (Moment::Palmgren { .. }, Some(rating)) = (&bearing.moment, bearing.static_load_rating)
        && let Some(peak) = record.peak_contact_force()
        && peak.value > rating
    {
        let force = peak.value;
        let warning = DropWarning::AboveLoadRating { force, rating };
        list.push((force / rating, warning.into()));
    }
    list
}

/// An inner race that gets hot.
fn hot(context: &Context, k: usize) -> Option<Graded> {
    if context.setup.given(k).warm.is_some() {
        // its temperatures say more
        return None;
    }
    let rise = inner_race_rise(
        &context.bearing(k),
        context.setup.given(k).bearing.as_ref()?,
    )
    .ok();
    let rise = rise.filter(|rise| *rise > HOT_RACE)?;
    Some((rise, DropWarning::HotRace { rise }.into()))
}

/// A contact law outside its range.
fn damping(context: &Context, k: usize) -> Vec<Warning> {
    let at = context.setup.machine.layout().bearings[k];
    let closing = (context.finished.record.rows())
        .filter(|row| row.probe[at.probe(PENETRATION)] > 0.0)
        .map(|row| row.probe[at.probe(PENETRATION_SPEED)].abs())
        .fold(0.0, f64::max);
    let damping = context.setup.given(k).contact.damping * closing;
    let warning = (damping > LARGEST_DAMPING).then_some(DropWarning::ContactDamping { damping });
    warning.into_iter().map(Warning::from).collect()
}

/// What a ring that does not turn does to a rotor, and what is not followed of it.
fn bushing(context: &Context, k: usize) -> Warning {
    let friction = context.setup.given(k).contact.friction_coefficient;
    DropWarning::Bushing { friction }.into()
}

/// What the laws of a bearing leave open.
fn of_bearing(scenario: &Scenario, context: &Context, k: usize) -> Vec<Warning> {
    let given = context.setup.given(k);
    let Some(bearing) = &given.bearing else {
        let touches = !context.record(k).contacts.is_empty();
        return touches.then(|| bushing(context, k)).into_iter().collect();
    };
    let mut list: Vec<Warning> = shared::cage_inertia(bearing).into_iter().collect();
    list.extend(shared::rolling(bearing));
    list.extend(shared::no_moment(bearing));
    list.extend(shared::moment(scenario, &given.name, bearing));
    if bearing.drag.orbit != 0.0 || bearing.drag.spin != 0.0 || bearing.drag.cage != 0.0 {
        let warning = match bearing.fidelity {
            Fidelity::Planar | Fidelity::Spatial => DropWarning::Dragged,
            Fidelity::Rolling => DropWarning::DragIgnored,
        };
        list.push(warning.into());
    }
    list
}
