//! What the user should know before trusting the numbers.

use super::drop::Context;
use super::ensemble::Finished;
use super::outcome::Warning;
use crate::catalogue;
use crate::scenario::{BallMaterial, Fidelity, Moment, Scenario};
use model::system::drop::layout::PENETRATION_SPEED;
use physics::hertz::maximum_pressure;

/// Contacts after which pocket and bounce chaos shows in the later ones.
const CHAOTIC_CONTACTS: usize = 10;
/// Share of the first bending frequency from which on a rotor bends noticeably.
const BENDING_SHARE: f64 = 0.7;
/// Relative energy residual above which the run's tolerance is too loose.
const LARGEST_RESIDUAL: f64 = 1e-6;
/// Hunt-Crossley damping a·ḋ above which the law leaves its valid range.
const LARGEST_DAMPING: f64 = 0.5;

/// All warnings of a run, the gravest first.
pub(super) fn of(scenario: &Scenario, context: &Context, members: &[Finished]) -> Vec<Warning> {
    let drop = context.drop;
    let bearing = &drop.bearing;
    let record = &context.finished.record;
    let mut list = Vec::new();
    let mut warn = |code: &'static str, text: String| list.push(Warning { code, text });

    let turns = record.whirl_turns * context.machine.constants.speed.signum();
    if turns <= -1.0 {
        warn(
            "AB1014",
            format!(
                "Backward whirl: the rotor runs {:.0} turns round the bore against its spin. Contact forces of this kind \
                 destroy bearings and shafts.",
                -turns
            ),
        );
    }
    let rated = bearing
        .name
        .as_deref()
        .and_then(catalogue::find)
        .and_then(|entry| Some((entry.name.clone(), entry.number("limiting_speed")?)));
    if let Some((name, limit)) = rated
        && drop.rotor.speed.abs() > limit
    {
        warn(
            "AB1015",
            format!(
                "The rotor's speed is {:.1} times the limiting speed of a {name} in its catalogue ({:.0} rpm), which \
                 holds for continuous running.",
                drop.rotor.speed.abs() / limit,
                limit * 30.0 / std::f64::consts::PI
            ),
        );
    }
    if let Some(bending) = drop.rotor.first_bending_frequency
        && BENDING_SHARE * bending < drop.rotor.speed.abs()
    {
        let side = if bending < drop.rotor.speed.abs() {
            "lies below"
        } else {
            "is near"
        };
        warn(
            "AB1001",
            format!(
                "The first free-free bending mode ({bending:.0} rad/s) {side} the release speed ({:.0} rad/s): \
                 this rigid rotor is indicative only.",
                drop.rotor.speed.abs()
            ),
        );
    }
    let factors = (
        context.built.inner_pressure_factor,
        context.built.outer_pressure_factor,
    );
    let pressure = members.iter().fold(0.0, |largest: f64, member| {
        largest
            .max(maximum_pressure(
                factors.0,
                member.record.largest_inner_load.value,
            ))
            .max(maximum_pressure(
                factors.1,
                member.record.largest_outer_load.value,
            ))
    });
    match bearing.hertz_pressure_limit {
        Some(limit) if pressure > limit => warn(
            "AB1002",
            format!(
                "The peak Hertz pressure of {:.0} MPa exceeds the limit of {:.0} MPa: permanent dents must be \
                 expected, and the elastic contact law is outside its range.",
                pressure * 1e-6,
                limit * 1e-6
            ),
        ),
        None => warn(
            "AB1003",
            "No limit of the Hertz pressure is given; for silicon nitride balls it is yours to set \
             (bearing.hertz_pressure_limit)."
                .to_string(),
        ),
        Some(_) => {}
    }
    let closing = record
        .rows()
        .filter(|row| row.probe[0] > 0.0)
        .map(|row| row.probe[PENETRATION_SPEED].abs())
        .fold(0.0, f64::max);
    if drop.contact.damping * closing > LARGEST_DAMPING {
        warn(
            "AB1004",
            format!(
                "The damping of rotor and race reaches a·ḋ = {:.2}: the Hunt-Crossley law is meant for values well \
                 below 1.",
                drop.contact.damping * closing
            ),
        );
    }
    if let (Moment::Palmgren { .. }, Some(rating)) = (bearing.moment, bearing.static_load_rating)
        && let Some(peak) = record.peak_contact_force()
        && peak.value > rating
    {
        warn(
            "AB1005",
            format!(
                "The contact force of {:.0} N exceeds the static load rating of {rating:.0} N: Palmgren's moment is \
                 outside its range.",
                peak.value
            ),
        );
    }
    let residual = super::quantities::name(context)
        .into_iter()
        .find(|quantity| quantity.name == "energy_residual");
    if let Some(super::outcome::Value::Number(residual)) = residual.map(|quantity| quantity.value)
        && residual.abs() > LARGEST_RESIDUAL
        && context.finished.ending.stop == solve::Stop::Finished
    {
        warn(
            "AB1006",
            format!(
                "The energy ledger misses {residual:.1e} of what was turned over: a smaller run.tolerance closes it."
            ),
        );
    }
    if drop.rotor.planes > 1 {
        warn(
            "AB1007",
            format!(
                "{} identical planes are computed as one by symmetry: mass, polar inertia and torques of the rotor are \
                 shared equally, forces and heats are those of one plane. Conical motion is not described.",
                drop.rotor.planes
            ),
        );
    }
    match bearing.fidelity {
        Fidelity::Planar => warn(
            "AB1008",
            "The planar bearing has no steady friction moment yet: spin-up by the rotor is described; long coasting \
             is too free, and a swing of the rotor in the bore after spin-up decays too slowly."
                .to_string(),
        ),
        Fidelity::Rolling => warn(
            "AB1009",
            "The rolling bearing assumes that no ball skids: where the planar fidelity shows slip, its spin-up times \
             and losses are not true."
                .to_string(),
        ),
    }
    if bearing.fidelity == Fidelity::Rolling && bearing.moment == Moment::None {
        warn(
            "AB1016",
            "The rolling bearing runs without a friction moment (bearing.moment.law is none)."
                .to_string(),
        );
    }
    if bearing.drag.orbit != 0.0 || bearing.drag.spin != 0.0 || bearing.drag.cage != 0.0 {
        let text = match bearing.fidelity {
            Fidelity::Planar => {
                "Balls or cage are dragged to the ground (bearing.drag): that reproduces reference cases, it is no \
                 friction moment of a real bearing."
            }
            Fidelity::Rolling => "bearing.drag belongs to the planar fidelity and is ignored here.",
        };
        warn("AB1010", text.to_string());
    }
    if record.contacts.len() > CHAOTIC_CONTACTS && context.members == 1 {
        warn(
            "AB1011",
            format!(
                "{} contacts: the first impacts, spin-up times and energies are reproducible, the late ones are \
                 chaotic. Repeat the run (--repeat 16) to see the spread.",
                record.contacts.len()
            ),
        );
    }
    if bearing.ball_material == BallMaterial::SiliconNitride {
        warn(
            "AB1012",
            "Silicon nitride balls on steel races: contact stiffness and ball mass follow the material; traction and \
             damping are those given."
                .to_string(),
        );
    }
    let assumed: Vec<&str> = scenario
        .resolved
        .values
        .iter()
        .filter(|value| value.provenance.mark() == "assumed")
        .filter(|value| {
            // what only skidding balls have
            let planar = ["bearing.cage.", "bearing.traction.", "bearing.drag."];
            bearing.fidelity == Fidelity::Planar
                || !planar.iter().any(|p| value.path.starts_with(p))
        })
        .map(|value| value.path)
        .collect();
    if !assumed.is_empty() {
        warn(
            "AB1013",
            format!(
                "Assumed, not measured ({}): {}.",
                assumed.len(),
                assumed.join(", ")
            ),
        );
    }
    list
}
