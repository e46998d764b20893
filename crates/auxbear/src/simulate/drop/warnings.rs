//! What the user should know before trusting the numbers of a drop.

use crate::result::assumptions::speed_rating;
use crate::result::outcome::Warning;
use crate::result::outcome::warning;
use crate::scenario::{Accuracy, Fidelity, Method, Moment, Scenario};
use crate::simulate::bearing::pressure::Pressures;
use crate::simulate::bearing::warnings as shared;
use crate::simulate::drop::context::Context;
use crate::simulate::drop::ensemble::Finished;
use crate::simulate::drop::quantities::name;
use crate::simulate::drop::shaft_results;
use crate::simulate::ending::DESIGN;
use model::auxiliary_bearing::probe::{PENETRATION, PENETRATION_SPEED};
use model::system::machine::tangents::Known;

/// Contacts after which pocket and bounce chaos shows in the later ones.
const CHAOTIC_CONTACTS: usize = 10;
/// Share of the first bending frequency from which on a rotor bends noticeably.
const BENDING_SHARE: f64 = 0.7;
/// Hunt-Crossley damping a·ḋ above which the law leaves its valid range.
const LARGEST_DAMPING: f64 = 0.5;

/// What the energy ledger may miss at screening accuracy.
const SCREENING_RESIDUAL: f64 = 2e-4;

/// Steps that are not those that were asked for, or coarser ones than the accuracy means.
fn accuracy(context: &Context) -> Vec<Warning> {
    let run = &context.drop.run;
    let mut list = Vec::new();
    if let (Accuracy::Design, Some(tolerance)) = (run.accuracy, run.tolerance)
        && tolerance > DESIGN
    {
        list.push(warning(
            "AB1123",
            format!(
                "run.tolerance = {tolerance:e} is larger than the {DESIGN:e} of design accuracy: the energy ledger may miss more than a \
                 millionth, and first impacts more than their spread."
            ),
        ));
    }
    let known = context.machine.tangents();
    let what = match known {
        Known::All => return list,
        Known::Races => {
            "what keeps the balls apart (a free cage, its land, neighbours) has no tangents"
        }
        Known::Nothing => "balls that roll have nothing stiff",
    };
    let text = match (run.method, run.accuracy) {
        (Method::Implicit, _) if known == Known::Nothing => {
            format!(
                "run.method = \"implicit\" was asked for, but {what}: explicit steps were taken."
            )
        }
        (Method::Implicit, _) => format!(
            "run.method = \"implicit\": {what}, so these steps are as short as explicit ones and cost several times more."
        ),
        (Method::Auto, Accuracy::Screening) => format!(
            "run.accuracy = \"screening\" took explicit steps, because {what}: they are hardly quicker than those of design."
        ),
        _ => return list,
    };
    list.push(warning("AB1124", text));
    list
}

/// All warnings of a run, the gravest first.
pub(crate) fn of(scenario: &Scenario, context: &Context, members: &[Finished]) -> Vec<Warning> {
    let drop = context.drop;
    let names: Vec<&str> = context.parts().collect();
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
    let mut list = each(&|k| whirl(context, members, k));
    list.extend(shaft_results::warnings(context, members));
    list.extend(each(&|k| {
        let bearing = &context.given(k).bearing;
        let rating = speed_rating(bearing, drop.rotor.speed);
        let lift_off = shared::lift_off(bearing, drop.rotor.speed);
        rating.into_iter().chain(lift_off).collect()
    }));
    list.extend(bending(context));
    list.extend(one_motion(context));
    list.extend(names.iter().enumerate().filter_map(|(k, name)| {
        let weight = drop.rotor.mass * drop.gravity.acceleration * drop.share(k);
        let peaks =
            (members.iter()).filter_map(|member| member.record.bearings[k].peak_contact_force());
        let peak = peaks
            .map(|peak| (peak.value, peak.time))
            .reduce(|a, b| if b.0 > a.0 { b } else { a });
        shared::preload_left(name, &context.given(k).bearing, ("weight", weight), peak)
    }));
    list.extend(each(&|k| loads(context, members, k)));
    list.extend(match drop.run.accuracy {
        Accuracy::Design => shared::residual(&name(context)),
        Accuracy::Screening => shared::residual_beyond(SCREENING_RESIDUAL, &name(context)),
    });
    list.extend(accuracy(context));
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
    list.extend(each(&|k| of_bearing(scenario, context, k)));
    list.extend(each(&|k| {
        let contacts = context.record(k).contacts.len();
        let late = (contacts > CHAOTIC_CONTACTS && context.members == 1).then(|| {
            warning(
                "AB1011",
                format!(
                    "{contacts} contacts: the first impacts, spin-up times and energies are reproducible, the late ones are \
                     chaotic. Repeat the run (--repeat 16) to see the spread."
                ),
            )
        });
        let kind = shared::kind(&context.given(k).bearing);
        late.into_iter().chain(kind).collect()
    }));
    list.extend(shared::assumed(scenario, None, &context.given(0).bearing));
    list.extend(each(&|k| {
        let given = context.given(k);
        let own = Some(given.name.as_str()).filter(|name| !name.is_empty());
        let assumed = own.and_then(|name| shared::assumed(scenario, Some(name), &given.bearing));
        assumed.into_iter().collect()
    }));
    list
}

/// A rotor that runs round the bore against its spin, in any member.
fn whirl(context: &Context, members: &[Finished], k: usize) -> Vec<Warning> {
    let sense = context.machine.constants.speed.signum();
    let turns = |member: &Finished| member.record.bearings[k].whirl_turns * sense;
    let whirling = members.iter().enumerate().map(|(at, m)| (at, turns(m)));
    let whirling: Vec<(usize, f64)> = whirling.filter(|(_, turns)| *turns <= -1.0).collect();
    let Some((worst, most)) = (whirling.iter().copied()).min_by(|a, b| a.1.total_cmp(&b.1)) else {
        return Vec::new();
    };
    let who = match members.len() {
        1 => "the rotor runs".to_string(),
        count => format!(
            "in {} of {count} members, and in member {worst} the rotor runs",
            whirling.len()
        ),
    };
    vec![warning(
        "AB1014",
        format!(
            "Backward whirl: {who} {:.0} turns round the bore against its spin. Contact forces of this kind \
             destroy bearings and shafts.",
            -most
        ),
    )]
}

/// A rotor that bends where it is taken as rigid.
fn bending(context: &Context) -> Option<Warning> {
    let rotor = &context.drop.rotor;
    let bending = rotor.first_bending_frequency?;
    let speed = rotor.speed.abs();
    let side = if bending < speed {
        "lies below"
    } else {
        "is near"
    };
    (BENDING_SHARE * bending < speed).then(|| {
        warning(
            "AB1001",
            format!(
                "The first free-free bending mode ({bending:.0} rad/s) {side} the release speed ({speed:.0} rad/s): \
                 this rigid rotor is indicative only."
            ),
        )
    })
}

/// Several bearings under a rotor that does not tilt.
fn one_motion(context: &Context) -> Option<Warning> {
    let count = context.drop.auxiliary_bearings.len();
    (count > 1 && context.drop.shaft.is_none()).then(|| {
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
fn loads(context: &Context, members: &[Finished], k: usize) -> Vec<Warning> {
    let given = context.given(k);
    let bearing = &given.bearing;
    let record = context.record(k);
    let at = context.machine.layout().bearings[k];
    let mut list = Vec::new();
    let factors = context.built.bearings[k].pressure_factors;
    let pressures = (members.iter())
        .map(|member| {
            let record = &member.record.bearings[k];
            let races = [record.largest_inner_load, record.largest_outer_load];
            factors.pressures(races, record.largest_pocket_force)
        })
        .reduce(Pressures::or);
    if let Some(pressures) = pressures {
        list.extend(shared::pressure(bearing, &pressures));
    }
    let closing = (context.finished.record.rows())
        .filter(|row| row.probe[at.probe(PENETRATION)] > 0.0)
        .map(|row| row.probe[at.probe(PENETRATION_SPEED)].abs())
        .fold(0.0, f64::max);
    if given.contact.damping * closing > LARGEST_DAMPING {
        list.push(warning(
            "AB1004",
            format!(
                "The damping of rotor and race reaches a·ḋ = {:.2}: the Hunt-Crossley law is meant for values well \
                 below 1.",
                given.contact.damping * closing
            ),
        ));
    }
    if let (Moment::Palmgren { .. }, Some(rating)) = (&bearing.moment, bearing.static_load_rating)
        && let Some(peak) = record.peak_contact_force()
        && peak.value > rating
    {
        list.push(warning(
            "AB1005",
            format!(
                "The contact force of {:.0} N exceeds the static load rating of {rating:.0} N: Palmgren's moment is \
                 outside its range.",
                peak.value
            ),
        ));
    }
    list
}

/// What the laws of a bearing leave open.
fn of_bearing(scenario: &Scenario, context: &Context, k: usize) -> Vec<Warning> {
    let given = context.given(k);
    let bearing = &given.bearing;
    let run = context.bearing(k);
    let mut list = shared::films(&run, bearing);
    list.extend(shared::film_rise(&run));
    list.extend(shared::skids(context.built.bearings[k].steady.as_ref()));
    list.extend(shared::cage_inertia(bearing));
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
