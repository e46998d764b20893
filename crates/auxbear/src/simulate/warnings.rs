//! What the user should know before trusting the numbers of a drop.

use super::bearing_run::Pressures;
use super::drop::Context;
use super::ensemble::Finished;
use super::outcome::Warning;
use super::warnings_shared::{self as shared, warning};
use crate::scenario::{Fidelity, Moment, Scenario};
use model::system::drop::layout::PENETRATION_SPEED;

/// Contacts after which pocket and bounce chaos shows in the later ones.
const CHAOTIC_CONTACTS: usize = 10;
/// Share of the first bending frequency from which on a rotor bends noticeably.
const BENDING_SHARE: f64 = 0.7;
/// Hunt-Crossley damping a·ḋ above which the law leaves its valid range.
const LARGEST_DAMPING: f64 = 0.5;

/// All warnings of a run, the gravest first.
pub(super) fn of(scenario: &Scenario, context: &Context, members: &[Finished]) -> Vec<Warning> {
    let drop = context.drop;
    let bearing = &drop.bearing;
    let record = &context.finished.record;
    let mut list = Vec::new();

    let turns = record.whirl_turns * context.machine.constants.speed.signum();
    if turns <= -1.0 {
        list.push(warning(
            "AB1014",
            format!(
                "Backward whirl: the rotor runs {:.0} turns round the bore against its spin. Contact forces of this kind \
                 destroy bearings and shafts.",
                -turns
            ),
        ));
    }
    list.extend(shared::speed_rating(bearing, drop.rotor.speed));
    list.extend(shared::lift_off(bearing, drop.rotor.speed));
    if let Some(bending) = drop.rotor.first_bending_frequency
        && BENDING_SHARE * bending < drop.rotor.speed.abs()
    {
        let side = if bending < drop.rotor.speed.abs() {
            "lies below"
        } else {
            "is near"
        };
        list.push(warning(
            "AB1001",
            format!(
                "The first free-free bending mode ({bending:.0} rad/s) {side} the release speed ({:.0} rad/s): \
                 this rigid rotor is indicative only.",
                drop.rotor.speed.abs()
            ),
        ));
    }
    let pressures = (members.iter())
        .map(|member| {
            let record = &member.record;
            let races = [record.largest_inner_load, record.largest_outer_load];
            (context.built.pressure_factors).pressures(races, record.largest_pocket_force)
        })
        .reduce(Pressures::or);
    if let Some(pressures) = pressures {
        list.extend(shared::pressure(bearing, &pressures));
    }
    let closing = record
        .rows()
        .filter(|row| row.probe[0] > 0.0)
        .map(|row| row.probe[PENETRATION_SPEED].abs())
        .fold(0.0, f64::max);
    if drop.contact.damping * closing > LARGEST_DAMPING {
        list.push(warning(
            "AB1004",
            format!(
                "The damping of rotor and race reaches a·ḋ = {:.2}: the Hunt-Crossley law is meant for values well \
                 below 1.",
                drop.contact.damping * closing
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
    if context.finished.ending.stop == solve::Stop::Finished {
        list.extend(shared::residual(&super::quantities::name(context)));
    }
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
    let run = context.bearing();
    list.extend(shared::films(&run, bearing));
    list.extend(shared::film_rise(&run));
    list.extend(shared::skids(context.built.steady.as_ref()));
    list.extend(shared::cage_inertia(bearing));
    list.extend(shared::rolling(bearing));
    list.extend(shared::no_moment(bearing));
    list.extend(shared::moment(scenario, bearing));
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
    if record.contacts.len() > CHAOTIC_CONTACTS && context.members == 1 {
        list.push(warning(
            "AB1011",
            format!(
                "{} contacts: the first impacts, spin-up times and energies are reproducible, the late ones are \
                 chaotic. Repeat the run (--repeat 16) to see the spread.",
                record.contacts.len()
            ),
        ));
    }
    list.extend(shared::kind(bearing));
    list.extend(shared::assumed(scenario, bearing));
    list
}
