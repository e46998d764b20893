//! Every named result of a drop with its law, source and valid range.

use crate::catalogue::geometry::digits;
use crate::result::list::{List, NOT_GIVEN, Origin, relative};
use crate::result::outcome::{Quantity, Value};
use crate::result::static_safety::{StaticLoad, static_safety};
use crate::scenario::axial_share;
use crate::simulate::bearing::quantities::{End, LargestForces};
use crate::simulate::bearing::warm;
use crate::simulate::drop::context::Context;
use crate::simulate::drop::{magnets, mount_results, shaft_results, surfaces};
use model::system::energy::Content;
use model::system::layout::of_part;
use std::f64::consts::PI;

const EQUATIONS: &str =
    "equations of motion, crates/model/src/system/machine/rate.rs and crates/model/src/bearing/";
const CONTACT: &str = "Hunt and Crossley 1975, crates/model/src/contact.rs";
const EVENT: &str = "root on dense output of the time integration, crates/solve/src/watch.rs";
const LEDGER: &str = "energy ledger, crates/model/src/system/machine/ledger.rs";

/// Names the results of one member: those of each auxiliary bearing under its name, then those of the machine.
pub(crate) fn name(context: &Context) -> Vec<Quantity> {
    let ending = &context.finished.ending;
    let state = &ending.state;
    let mut list = List::default();
    for (k, part) in context.parts().enumerate() {
        let mut own = List::default();
        of_bearing(context, k, part, &mut own);
        list.quantities
            .extend(own.quantities.into_iter().map(|quantity| Quantity {
                name: of_part(part, &quantity.name),
                ..quantity
            }));
    }
    shaft_results::name(context, &mut list);
    let release = context.release_time().ok_or_else(magnets::kept);
    list.number("release_time", "s", release, &RELEASE);
    let axial = axial_share(context.drop.gravity.acceleration);
    list.number("axial_gravity_share", "1", Ok(axial), &AXIAL_SHARE);
    magnets::name(context, &mut list);
    let spin = context.machine.layout().rotor.spin();
    list.number("rotor_final_speed", "rad/s", Ok(state[spin]), &SPEED);
    let heat = context.machine.flows(state).heat;
    list.number("dissipated_energy", "J", Ok(heat), &ENERGY);
    let planes = context.drop.rotor.planes as f64;
    list.number(
        "dissipated_energy_of_all_bearings",
        "J",
        Ok(planes * heat),
        &ALL_BEARINGS,
    );
    if let Some(renewals) = context.renewals() {
        warm::work_of_rings(renewals.work_until(f64::INFINITY), &mut list);
    }
    let balance = context.balance();
    let ((stored, flowed), (now, by_now)) = (balance.start, balance.end);
    let kinetic = |content: Content| content.translation + content.spin;
    for (name, energy) in [
        ("work_of_sources", by_now.work - flowed.work),
        ("kinetic_energy_change", kinetic(now) - kinetic(stored)),
        ("potential_energy_change", now.potential - stored.potential),
        ("energy_balance_residual", balance.energy_residual()),
    ] {
        list.number(name, "J", Ok(energy), &BALANCE);
    }
    let (energy, momentum) = residuals(context);
    list.number("energy_residual", "1", energy, &RESIDUAL);
    list.number("angular_momentum_residual", "1", momentum, &RESIDUAL);
    list.ended_at(ending.time)
}

/// Names the results of one auxiliary bearing.
fn of_bearing(context: &Context, k: usize, part: &str, list: &mut List) {
    let record = context.record(k);
    let ending = &context.finished.ending;
    let machine = context.machine;
    let state = &ending.state;
    let no_contact = || "rotor and inner race never touched in this run".to_string();
    let release = context.counted_from();
    let after = |time: f64| time - release;

    // contacts
    let first = record.contacts.first();
    list.awaited(
        "time_to_first_contact",
        first.map(|c| after(c.start)).ok_or_else(no_contact),
        &FIRST_CONTACT,
    );
    list.number(
        "first_impact_force",
        "N",
        first.map(|c| c.peak_force).ok_or_else(no_contact),
        &CONTACT_FORCE,
    );
    list.number(
        "peak_contact_force",
        "N",
        record
            .peak_contact_force()
            .map(|p| p.value)
            .ok_or_else(no_contact),
        &CONTACT_FORCE,
    );
    list.number(
        "contact_count",
        "",
        Ok(record.contacts.len() as f64),
        &CONTACT_COUNT,
    );
    let starts = record.contacts.iter().map(|c| after(c.start)).collect();
    list.push(
        "contact_start_times",
        "s",
        Value::List(starts),
        &CONTACT_STARTS,
    );

    // speeds
    let never = |what: &str| match context.release_time() {
        Some(_) => {
            let time = digits(1e3 * after(ending.time));
            format!("{what} was not reached in {time} ms after the release")
        }
        None => magnets::kept(),
    };
    let rolling = context.given(k).bearing.as_ref();
    if rolling.is_some() {
        list.rises(
            "inner_race",
            [
                record.inner_race_time_to_50_percent(),
                record.inner_race_time_to_95_percent(),
                record.cage_time_to_95_percent(),
            ]
            .map(|time| time.map(after)),
            [
                never("half of the rotor's release speed"),
                never("95 % of the rotor's release speed"),
                never("95 % of the rolling cage speed of the rotor's release speed"),
            ],
            &RISE,
        );
        let race_speed = state[machine.layout().bearings[k].inner + 5];
        for (name, speed) in [
            ("inner_race_final_speed", race_speed),
            ("cage_final_speed", machine.cage_speed(k, state)),
        ] {
            list.number(name, "rad/s", Ok(speed), &SPEED);
        }
    }

    let end = End {
        part,
        layout: machine.layout(),
        state,
    };
    let forces = LargestForces {
        loads: [record.largest_inner_load, record.largest_outer_load],
        cage: [record.largest_pocket_force, record.largest_land_force],
    };
    let run = context.bearing(k);
    let load = record.largest_bearing_load.value;
    if let Some(given) = rolling {
        list.balls(&run, &forces, given, &end);
        list.number("peak_bearing_load", "N", Ok(load), &LOAD);
        let safety = static_safety(
            &given.rated(),
            &StaticLoad {
                radial: load,
                axial: given.axial_preload,
                contact_angle: Some(given.contact_angle),
            },
        );
        list.number("static_safety", "1", safety, &SAFETY);
        let turns = record.turns;
        let mean = (record.cubed_load_turns / turns).cbrt();
        let still = || "the inner race did not turn".to_string();
        let followed = context.followed(k);
        let speed = 2.0 * PI * turns / context.finished.ending.time;
        let phase = (followed.as_ref()).filter(|_| turns > 0.0);
        let phase = phase.map(|followed| (followed, mean, speed));
        let mean = (turns > 0.0).then_some(mean).ok_or_else(still);
        list.number("inner_race_turns", "", Ok(turns), &TURNS);
        list.number("cubic_mean_load", "N", mean, &MEAN_LOAD);
        list.life_share(given, record.races.as_ref(), phase);
    }
    let force = record.largest_mount_force.value;
    list.number("peak_mount_force", "N", Ok(force), &MOUNT_FORCE);

    mount_results::name(record, &context.given(k).mount, list);

    // displacements and whirl
    list.number(
        "max_rotor_race_displacement",
        "m",
        Ok(record.rotor_race_displacement.value),
        &DISPLACEMENT,
    );
    list.number(
        "max_rotor_displacement",
        "m",
        if record.contacts.is_empty() {
            Err(no_contact())
        } else {
            Ok(record.rotor_displacement.value)
        },
        &ROTOR_DISPLACEMENT,
    );
    list.number(
        "max_mount_displacement",
        "m",
        Ok(record.mount_displacement.value),
        &MOUNT_DISPLACEMENT,
    );
    let turns = record.whirl_turns;
    let forward = turns * machine.constants.speed.signum() > 0.0;
    let direction = if turns.abs() < 1.0 {
        "none"
    } else if forward {
        "forward"
    } else {
        "backward"
    };
    list.push(
        "whirl_direction",
        "",
        Value::Text(direction.to_string()),
        &WHIRL,
    );
    list.number("whirl_turns", "", Ok(turns), &WHIRL);
    let (travel, clearance) = (
        &record.travel,
        context.given(k).contact.radial_air_clearance,
    );
    let still = || "the rotor did not turn once".to_string();
    let of = |way: f64, turned: f64| {
        let index = way / (clearance * turned);
        (travel.turned >= 2.0 * PI)
            .then_some(index)
            .ok_or_else(still)
    };
    list.number("travel_index", "1", of(travel.longest, 2.0 * PI), &TRAVEL);
    list.number(
        "speed_index",
        "1",
        of(travel.way, travel.turned),
        &SPEED_INDEX,
    );
    list.losses(&run, &end, &ENERGY);
    let weight = context.drop.weight(k);
    list.blows(record.contacts.iter().map(|c| c.peak_force), weight);
    if let Some(given) = rolling {
        list.warming(&end, given);
    }
    let contact = &context.given(k).contact;
    let work = end.heat("rotor_race_friction");
    list.number(
        "rotor_race_friction_energy_per_area",
        "J/m^2",
        contact
            .width
            .map(|width| work / (PI * contact.bore_diameter * width))
            .ok_or_else(|| format!("contact.width{NOT_GIVEN}")),
        &PER_AREA,
    );
    surfaces::name(context, k, list);
    if let Some(followed) = context.followed(k) {
        warm::name(&followed, list);
    }
}

/// What is turned over must exceed this share of the kinetic energy at the start to be compared with.
const ROUNDING: f64 = 1e-12;

/// Largest residuals of the run, relative: (energy, angular momentum).
pub(crate) fn residuals(context: &Context) -> (Result<f64, String>, Result<f64, String>) {
    let machine = context.machine;
    let record = &context.finished.record;
    let start = &context.finished.start;
    let balance = context.balance();
    let scale = (balance.heat())
        .max(balance.end.1.work_size)
        .max(record.largest_translation);
    // rounding of the spins is not compared with nothing
    let stored = machine.content(start);
    let scale = if scale > ROUNDING * (stored.translation + stored.spin) {
        scale
    } else {
        0.0
    };
    let constants = &machine.constants;
    let inertia: f64 = (constants.bearings.iter())
        .map(|part| part.inner_race.inertia)
        .sum();
    let at = machine.layout().rotor.spin();
    let ended = context.finished.ending.state[at];
    // a rotor that runs up has its speed at the end
    let spin = constants.speed.abs().max(ended.abs());
    // bearings that are not touched settle: what they turn over is no measure of a machine
    let parts = 0..constants.bearings.len();
    let scale = match parts.clone().all(|k| context.record(k).contacts.is_empty()) {
        true => scale.max(0.5 * inertia * spin * spin),
        false => scale,
    };
    let momentum_scale = (inertia * spin).max(balance.angular_impulse().abs());
    (
        relative(balance.energy_residual(), scale),
        relative(balance.angular_momentum_residual(), momentum_scale),
    )
}

const TURNS: Origin = Origin {
    law: "∫|ω_i| dt/2π",
    source: "definition",
    valid: "from the start of the run to the end of what is computed ball by ball",
};
const MEAN_LOAD: Origin = Origin {
    law: "(∫W³ dn/n)^(1/3), W the load on the bearing, n the turns of the inner race",
    source: "ISO 281; crates/model/src/system/machine/bearing_record.rs",
    valid: "as inner_race_turns; balls that preload each other are not counted in W",
};
const TRAVEL: Origin = Origin {
    law: "longest way of the rotor's centre against the inner race in one turn of the rotor, over 2π c0",
    source: "definition; crates/model/src/system/machine/travel.rs",
    valid: "0 of a rotor that lies still, 1 of a whirl around the whole gap once a turn; 64 points a turn, over the whole run",
};
const SPEED_INDEX: Origin = Origin {
    law: "mean speed of the rotor's centre against the inner race over c0 times the mean spin",
    source: "definition; crates/model/src/system/machine/travel.rs",
    valid: "as travel_index",
};
const RELEASE: Origin = Origin {
    law: "first instant, from the start of the run, at which a magnet, an axis or all power is lost",
    source: "levitation.power_lost_at; 0 where the run begins with the release",
    valid: "column time and instants in messages count from the start of the run; results of contacts, spin-up and whirl from here",
};
const AXIAL_SHARE: Origin = Origin {
    law: "sqrt(1 - (g/g0)^2), g = gravity.acceleration across the shaft, g0 = 9.80665 m/s^2",
    source: "geometry; 0 from 9.76 m/s^2 on, the weakest gravity on Earth",
    valid: "shafts that stand; motion along the shaft is not in the run",
};
const FIRST_CONTACT: Origin = Origin {
    law: "gap d = |C - c_i| - c0 closes, after the release; gravity and the levitated orbit's speed then",
    source: EVENT,
    valid: "negative of a rotor that touches before the release; from the start of the run where nothing is released",
};
const CONTACT_STARTS: Origin = Origin {
    law: "begins of contact after the release, d = 0 rising",
    source: EVENT,
    valid: "as time_to_first_contact; late contacts may be chaotic: repeat the run",
};
const CONTACT_FORCE: Origin = Origin {
    law: "N = max(0, k dⁿ(1 + a ḋ)), largest of each contact",
    source: CONTACT,
    valid: "stiffness, exponent and damping of the landing surfaces as given; late impacts may be chaotic: repeat the run",
};
const CONTACT_COUNT: Origin = Origin {
    law: "begins of contact, d = 0 rising; one that lasts to the end is included",
    source: EVENT,
    valid: "late contacts may be chaotic: repeat the run",
};
const RISE: Origin = Origin {
    law: "first instant after the release at which the speed reaches the level; levels refer to the rotor's speed at release",
    source: EQUATIONS,
    valid: "constant friction coefficient between rotor and race; friction of the bearing only as its fidelity has it",
};
const SPEED: Origin = Origin {
    law: "angular momentum of each body about its axis",
    source: EQUATIONS,
    valid: "coasting is as true as the friction of the bearing: bearing.moment, ball by ball also slip and oil in the inlets",
};
const DISPLACEMENT: Origin = Origin {
    law: "largest |C - c_i|, where its rate changes sign",
    source: EVENT,
    valid: "below a tenth of the bearing's size",
};
const MOUNT_DISPLACEMENT: Origin = Origin {
    law: "largest |c_o|, at the steps and, near the record, on dense output between them",
    source: EQUATIONS,
    valid: "below a tenth of the bearing's size",
};
const ROTOR_DISPLACEMENT: Origin = Origin {
    law: "largest distance of the rotor centre from the line of levitation, while in contact, at the steps",
    source: EVENT,
    valid: "compare it with seals and other air gaps at this plane",
};
const WHIRL: Origin = Origin {
    law: "net turns of the rotor about the inner race while outside half its clearance; below one turn: none",
    source: "definition",
    valid: "a rotor that bends may whirl backward where a rigid one does not: system = \"machine\"",
};
const ENERGY: Origin = Origin {
    law: "time integral of friction force times sliding speed, and of every other loss",
    source: LEDGER,
    valid: "heat of what is simulated: of identical planes that of one; nothing is cooled or warmed by it",
};
const BALANCE: Origin = Origin {
    law: "work_of_sources = kinetic_energy_change + potential_energy_change + dissipated_energy + energy_balance_residual",
    source: LEDGER,
    valid: "rotor and all bearings that are computed, over the whole run; sources below zero take energy out; of identical planes that of one",
};
const ALL_BEARINGS: Origin = Origin {
    law: "dissipated_energy times rotor.planes: of bearings computed one by one it is their sum already",
    source: LEDGER,
    valid: "heat of bearings, mounts and landing surfaces; nothing is cooled or warmed by it",
};
const LOAD: Origin = Origin {
    law: "largest size of the sum of all ball forces on the outer race, at the steps and near the largest ball load between them",
    source: EQUATIONS,
    valid: "radial plane; a preload that all balls share evenly cancels in the sum",
};
const SAFETY: Origin = Origin {
    law: "s0 = C0/P0, P0 = max(F_r, X0 F_r + Y0 F_a) with F_r = peak_bearing_load and F_a = bearing.axial_preload",
    source: "ISO 76 (from memory), crates/physics/src/static_load.rs",
    valid: "assumes that a short peak dents as a load at rest, and the usual share of the most loaded ball: peak_hertz_pressure says what that ball carries",
};
const MOUNT_FORCE: Origin = Origin {
    law: "largest |F| of spring, damper and all other parts, at the steps and near the largest ball load between them; the weight of the bearing is in it",
    source: mount_results::SOURCE,
    valid: "force of the outer race on its housing",
};
const PER_AREA: Origin = Origin {
    law: "rotor_race_friction_energy/(π D b), bore D, contact.width b",
    source: LEDGER,
    valid: "mean over the bore, of both surfaces together: without whirl one place of it takes most",
};
const RESIDUAL: Origin = Origin {
    law: "what the ledger misses at the end, over max(heat, works, largest kinetic energy of the rotor's centre); \
          momentum over that of the inner races at the speed of the rotor, at the release or the end, or over the impulse from outside where that is more; of bearings that are never touched energy \
          over that of their inner races at this speed",
    source: LEDGER,
    valid: "a measure of the integration error; it falls with run.tolerance",
};
