//! What the user should know before trusting the numbers of a drop.

use crate::assumptions::speed_rating;
use crate::bearing::severity::{HOT_RACE, inner_race_rise};
use crate::bearing::warm;
use crate::bearing::warnings as shared;
use crate::drop::context::Context;
use crate::drop::quantities::residuals;
use crate::drop::run_out::After;
use crate::drop::{magnets, method, mount_results, shaft_results, surfaces};
use crate::stepping::Asked;
use model::auxiliary_bearing::probe::{PENETRATION, PENETRATION_SPEED};
use outcome::Warning;
use outcome::warning;
use scenario::{DRAWN_ON, Fidelity, Moment, Scenario};

/// Contacts after which pocket and bounce chaos shows in the later ones.
const CHAOTIC_CONTACTS: usize = 10;
/// Share of the first bending frequency from which on a rotor bends noticeably.
const BENDING_SHARE: f64 = 0.7;
/// Hunt-Crossley damping a·ḋ above which the law leaves its valid range.
const LARGEST_DAMPING: f64 = 0.5;

/// What decides the steps of a drop.
fn asked<'a>(context: &Context<'a>) -> Asked<'a> {
    method::asked(context.setup.drop, context.setup.machine.tangents())
}

/// A warning of one member, and how grave it is there.
type Graded = (f64, Warning);

/// Judges every member: a warning of any of them once, as the one has it where it is most severe, with the number of those that have it.
fn judged(contexts: &[Context], of: impl Fn(&Context) -> Vec<Graded>) -> Vec<Warning> {
    let mut found: Vec<(usize, usize, Graded)> = Vec::new();
    for (k, context) in contexts.iter().enumerate() {
        for (grade, warning) in of(context) {
            let mut known = found.iter_mut();
            match known.find(|(.., (_, other))| other.code == warning.code) {
                Some((count, member, worst)) => {
                    *count += 1;
                    if grade > worst.0 {
                        (*member, *worst) = (k, (grade, warning));
                    }
                }
                None => found.push((1, k, (grade, warning))),
            }
        }
    }
    let told = |(count, member, (_, mut warning)): (usize, usize, Graded)| {
        if contexts.len() > 1 {
            warning.text.push_str(&format!(
                " In {count} of {} members; the numbers are those of member {member}.",
                contexts.len()
            ));
        }
        warning
    };
    found.into_iter().map(told).collect()
}

/// Warnings from rows, which of repeated runs the first member alone keeps.
fn of_rows(contexts: &[Context], mut list: Vec<Warning>) -> Vec<Warning> {
    for warning in list.iter_mut().filter(|_| contexts.len() > 1) {
        let text = " Judged in the unperturbed run alone: the other members keep no histories.";
        warning.text.push_str(text);
    }
    list
}

/// All warnings of a run, the most severe first; `contexts` are its members.
pub(crate) fn of(
    scenario: &Scenario,
    contexts: &[Context],
    after: &[Option<After>],
) -> Vec<Warning> {
    let context = &contexts[0];
    // what follows from the machine alone is the same in all members where none is varied
    let machines = match scenario.vary.is_empty() {
        true => &contexts[..1],
        false => contexts,
    };
    let drop = context.setup.drop;
    let names: Vec<&str> = context.setup.parts().collect();
    let each = |of: &dyn Fn(usize) -> Vec<Warning>| -> Vec<Warning> {
        let named = |(k, name): (usize, &&str)| {
            let mut list = of(k);
            if !name.is_empty() {
                for warning in &mut list {
                    warning.text = format!("{name}: {}", warning.text);
                }
            }
            list
        };
        names.iter().enumerate().flat_map(named).collect()
    };
    let mut list = each(&|k| judged(contexts, |member| whirl(member, k).into_iter().collect()));
    for node in 0..shaft_results::clearances(context) {
        list.extend(judged(contexts, |member| {
            shaft_results::reached(member, node).into_iter().collect()
        }));
    }
    list.extend(each(&|k| {
        judged(contexts, |member| {
            magnets::touched(member, k).into_iter().collect()
        })
    }));
    list.extend(judged(contexts, |member| {
        magnets::limited(member).into_iter().collect()
    }));
    list.extend(judged(contexts, |member| {
        magnets::voltage_limited(member).into_iter().collect()
    }));
    list.extend(each(&|k| {
        let mut list = judged(contexts, |member| hot(member, k).into_iter().collect());
        list.extend(judged(contexts, |member| {
            mount_results::stopped(member, k).into_iter().collect()
        }));
        list.extend(judged(contexts, |member| surfaces::judged(member, k)));
        list.extend(judged(contexts, |member| {
            member.bearing(k).hot_skid().into_iter().collect()
        }));
        list.extend(judged(contexts, |member| {
            (member.followed(k).as_ref()).map_or(Vec::new(), warm::judged)
        }));
        list
    }));
    if after[0].iter().any(|after| after.says(DRAWN_ON)) {
        // the run-out says it of all, from where the drop left the data on
        list.retain(|warning| warning.code != DRAWN_ON);
    }
    if after[0]
        .iter()
        .any(|after| after.says("AB2312") || after.says("AB2311"))
    {
        // a bearing that closes on
        list.retain(|warning| warning.code != "AB2312");
    }
    // of repeated runs those of the unperturbed run-out
    list.extend(of_rows(
        contexts,
        (after[0].iter())
            .flat_map(|after| after.warnings.clone())
            .collect(),
    ));
    list.extend(each(&|k| {
        judged(machines, |member| beyond_speeds(member, k))
    }));
    list.extend(judged(machines, |member| {
        bending(member).into_iter().collect()
    }));
    list.extend(judged(machines, |member| {
        shaft_results::resonance(member).into_iter().collect()
    }));
    list.extend(one_motion(context));
    list.extend(each(&|k| {
        judged(contexts, |member| preload(member, k).into_iter().collect())
    }));
    list.extend(each(&|k| {
        let mut list = judged(contexts, |member| loads(member, k));
        list.extend(of_rows(contexts, damping(context, k)));
        list
    }));
    let most = asked(context).largest_residual(shared::LARGEST_RESIDUAL);
    list.extend(judged(contexts, |member| {
        let residual = residuals(member).0.ok();
        let graded =
            |residual: f64| Some((residual.abs(), shared::residual_beyond(most, residual)?));
        residual.and_then(graded).into_iter().collect()
    }));
    list.extend(each(&|k| {
        shaft_results::thick(context, k).into_iter().collect()
    }));
    list.extend(shaft_results::few_modes(context));
    list.extend(shaft_results::stiff(context));
    let shafts = context.setup.built.shaft.iter();
    list.extend(shafts.flat_map(|own| own.warnings.clone()));
    let shaft = drop.shaft.as_ref();
    list.extend(shaft.and_then(|own| shaft_results::against_spin(&own.model, drop.rotor.speed)));
    let known = context.setup.machine.tangents();
    let stepping = method::stepping(drop, context.setup.built, known);
    list.extend(asked(context).warnings(stepping.steps));
    if drop.rotor.planes > 1 {
        list.push(warning(
            "AB1007",
            format!(
                "{} identical planes are computed as one by symmetry: mass, polar inertia and torques of the rotor are \
                 shared equally, forces and heats are those of one plane. Conical motion is not described.",
                drop.rotor.planes
            ),
        ));
    }
    list.extend(each(&|k| {
        let run = context.bearing(k);
        let given = context.setup.given(k).bearing.as_ref();
        let mut list = given.map_or(Vec::new(), |bearing| shared::films(&run, bearing));
        list.extend(shared::film_rise(&run));
        list.extend(given.map_or(Vec::new(), |bearing| {
            shared::law_range(bearing, run.fastest(), context.setup.drop.weight(k))
        }));
        let mut list = of_rows(contexts, list);
        list.extend(judged(machines, |member| {
            skids(member, k).into_iter().collect()
        }));
        list.extend(of_bearing(scenario, contexts, k));
        list
    }));
    list.extend(each(&|k| {
        let contacts = context.record(k).contacts.len();
        let late = (contacts > CHAOTIC_CONTACTS && context.members == 1).then(|| {
            warning(
                "AB1011",
                format!(
                    "{contacts} contacts: the first impacts, spin-up times and energies are reproducible, the late ones are \
                     chaotic. Repeat the run to see the spread: --repeat 16 samples the unbalance angle too, unless \
                     repeat.unbalance_angle = \"as given\"."
                ),
            )
        });
        let kind = (context.setup.given(k).bearing.iter()).flat_map(shared::kind);
        late.into_iter().chain(kind).collect()
    }));
    if drop.rotor.first_bending_frequency.is_none() && drop.shaft.is_none() {
        list.push(warning(
            "AB1126",
            format!(
                "Whether the rotor bends was not checked: rotor.first_bending_frequency is not given. A rotor whose first free-free \
                 bending mode lies below {:.0} rad/s is not rigid at this speed.",
                drop.rotor.speed.abs() / BENDING_SHARE
            ),
        ));
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
    let back = -context.record(k).whirl_turns * context.setup.machine.constants.speed.signum();
    (back >= 1.0).then(|| {
        let text = format!(
            "Backward whirl: the rotor runs {back:.0} turns round the bore against its spin. Contact forces of this kind destroy \
             bearings and shafts."
        );
        (back, warning("AB1014", text))
    })
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
    let drop = context.setup.drop;
    let weight = drop.weight(k);
    let peak = context.record(k).peak_contact_force();
    let peak = peak.map(|peak| (peak.value, peak.time));
    let bearing = context.setup.given(k).bearing.as_ref()?;
    let warning = shared::preload_left("", bearing, ("weight", weight), peak)?;
    Some((peak.map_or(weight, |(force, _)| force.max(weight)), warning))
}

/// Balls that traction cannot turn.
fn skids(context: &Context, k: usize) -> Option<Graded> {
    let steady = context.setup.built.bearings[k].steady.as_ref();
    let warning = shared::skids(steady)?;
    Some((steady.map_or(0.0, |steady| -steady.capacity), warning))
}

/// A rotor that bends where it is taken as rigid.
fn bending(context: &Context) -> Option<Graded> {
    let rotor = &context.setup.drop.rotor;
    let bending = rotor.first_bending_frequency?;
    let speed = rotor.speed.abs();
    let side = if bending < speed {
        "lies below"
    } else {
        "is near"
    };
    (BENDING_SHARE * bending < speed).then(|| {
        let text = format!(
            "The first free-free bending mode ({bending:.0} rad/s) {side} the release speed ({speed:.0} rad/s): \
             this rigid rotor is indicative only."
        );
        (speed / bending, warning("AB1001", text))
    })
}

/// Several bearings under a rotor that does not tilt.
fn one_motion(context: &Context) -> Option<Warning> {
    let count = context.setup.drop.auxiliary_bearings.len();
    (count > 1 && context.setup.drop.shaft.is_none()).then(|| {
        warning(
            "AB1090",
            format!(
                "The rotor does not tilt: all {count} auxiliary bearings see one motion, wherever they stand on the shaft. \
                 Forces of bearings that differ, or of a rotor whose mass is not midway, are indicative only."
            ),
        )
    })
}

/// Pressures and forces beyond what bearing and laws stand.
fn loads(context: &Context, k: usize) -> Vec<Graded> {
    let Some(bearing) = &context.setup.given(k).bearing else {
        return Vec::new();
    };
    let record = context.record(k);
    let pressures = context.bearing(k).pressures();
    let grade = |code| match code {
        "AB1070" => pressures.neighbours.unwrap_or(0.0),
        _ => pressures.races,
    };
    let warnings = shared::pressure(bearing, &pressures).into_iter();
    let mut list: Vec<Graded> = warnings
        .map(|warning| (grade(warning.code), warning))
        .collect();
    if let (Moment::Palmgren { .. }, Some(rating)) = (&bearing.moment, bearing.static_load_rating)
        && let Some(peak) = record.peak_contact_force()
        && peak.value > rating
    {
        let text = format!(
            "The contact force of {:.0} N exceeds the static load rating of {rating:.0} N: Palmgren's moment is \
             outside its range.",
            peak.value
        );
        list.push((peak.value / rating, warning("AB1005", text)));
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
    let text = format!(
        "Without cooling the inner race warms by {rise:.0} K: clearance, lubricant, friction and hardness change with that, and this run \
         does not follow them."
    );
    Some((rise, warning("AB2300", text)))
}

/// A contact law outside its range.
fn damping(context: &Context, k: usize) -> Vec<Warning> {
    let at = context.setup.machine.layout().bearings[k];
    let closing = (context.finished.record.rows())
        .filter(|row| row.probe[at.probe(PENETRATION)] > 0.0)
        .map(|row| row.probe[at.probe(PENETRATION_SPEED)].abs())
        .fold(0.0, f64::max);
    let reached = context.setup.given(k).contact.damping * closing;
    let text = format!(
        "The damping of rotor and race reaches a·ḋ = {reached:.2}: the Hunt-Crossley law is meant for values well below 1."
    );
    let list = (reached > LARGEST_DAMPING).then(|| warning("AB1004", text));
    list.into_iter().collect()
}

/// What a ring that does not turn does to a rotor, and what is not followed of it.
fn bushing(context: &Context, k: usize) -> Warning {
    let friction = context.setup.given(k).contact.friction_coefficient;
    warning(
        "AB2330",
        format!(
            "The rotor rubs on a bushing with a friction coefficient of {friction}: no race comes to speed and ends that, so friction \
             drives backward whirl for as long as the rotor turns. Whether a blow starts it depends on friction, damping and the release: \
             vary them (--repeat). What warming and wear do to friction and clearance is not followed."
        ),
    )
}

/// What the laws of a bearing leave open.
fn of_bearing(scenario: &Scenario, contexts: &[Context], k: usize) -> Vec<Warning> {
    let context = &contexts[0];
    let given = context.setup.given(k);
    let Some(bearing) = &given.bearing else {
        let mut touches = contexts.iter().map(|member| &member.record(k).contacts);
        let touches = touches.any(|contacts| !contacts.is_empty());
        return touches.then(|| bushing(context, k)).into_iter().collect();
    };
    let mut list: Vec<Warning> = shared::cage_inertia(bearing).into_iter().collect();
    list.extend(shared::rolling(bearing));
    list.extend(shared::no_moment(bearing));
    list.extend(shared::moment(scenario, &given.name, bearing));
    if bearing.drag.orbit != 0.0 || bearing.drag.spin != 0.0 || bearing.drag.cage != 0.0 {
        let text = match bearing.fidelity {
            Fidelity::Planar => {
                "Balls or cage are dragged to the ground (bearing.drag): that reproduces reference cases, it is no \
                 friction moment of a real bearing."
            }
            Fidelity::Rolling => "bearing.drag belongs to the planar fidelity and is ignored here.",
        };
        list.push(warning("AB1010", text.to_string()));
    }
    list
}
