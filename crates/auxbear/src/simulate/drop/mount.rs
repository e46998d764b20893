//! The parts of a mount: from values to constants of the model, and what they did in a run.

use crate::result::list::{List, Origin};
use crate::result::outcome::{Warning, warning};
use crate::scenario::Mount;
use crate::scenario::drop::mount::MountParts as Given;
use crate::simulate::drop::context::Context;
use model::mount::{FrictionRing, HardStop, Housing, MaxwellBranch, MountParts, SqueezeFilm};
use model::system::machine::record::BearingRecord;

/// Exponent of a friction ring where none is given: smaller ones creep under small vibration about a load.
const RING_EXPONENT: f64 = 8.0;
/// Damping of a hard stop where none is given, s/m.
const STOP_DAMPING: f64 = 0.5;

/// What a mount has besides spring and damper.
pub(super) fn parts(given: &Given) -> MountParts {
    let branches = given.branch_stiffness.iter().zip(&given.branch_time);
    MountParts {
        branches: branches
            .map(|(stiffness, time)| MaxwellBranch {
                stiffness: *stiffness,
                rate: 1.0 / time,
            })
            .collect(),
        ring: given
            .ring_stiffness
            .zip(given.ring_travel)
            .map(|(stiffness, travel)| FrictionRing {
                stiffness,
                travel,
                exponent: given.ring_exponent.unwrap_or(RING_EXPONENT),
            }),
        film: film(given),
        stop: given
            .stop_gap
            .zip(given.stop_stiffness)
            .map(|(gap, stiffness)| HardStop {
                stiffness,
                gap,
                damping: given.stop_damping.unwrap_or(STOP_DAMPING),
            }),
        housing: given
            .housing_mass
            .zip(given.housing_stiffness)
            .map(|(mass, stiffness)| Housing {
                mass,
                stiffness,
                damping: given.housing_damping.unwrap_or(0.0),
            }),
        ..MountParts::NONE
    }
}

fn film(given: &Given) -> Option<SqueezeFilm<f64>> {
    let length = given.film_length?;
    Some(SqueezeFilm {
        factor: given.film_viscosity? * given.film_radius? * length * length * length,
        clearance: given.film_clearance?,
        cavitates: !given.film_flooded,
    })
}

pub(super) const SOURCE: &str = "crates/model/src/mount/; book/src/theory/drop.md, mounts";

const PART_FORCE: Origin = Origin {
    law: "largest size of the force between outer race and housing in this part alone, at the steps and, near the record, on dense output",
    source: SOURCE,
    valid: "as the part: crates/model/src/mount/",
};
const HOUSING: Origin = Origin {
    law: "largest |h| and |dh/dt| of the housing, at the steps and, near the record, on dense output",
    source: SOURCE,
    valid: "a housing that carries one bearing, from its place under the weight at rest",
};

/// Names what the parts that are given did.
pub(super) fn name(record: &BearingRecord, given: &Mount, list: &mut List) {
    let (Some(peaks), given) = (&record.mount_parts, &given.parts) else {
        return;
    };
    let stop = given.stop_gap.is_some();
    let housing = given.housing_mass.is_some();
    for (there, name, unit, peak, origin) in [
        (
            given.ring_stiffness.is_some(),
            "peak_mount_ring_force",
            "N",
            peaks.ring,
            &PART_FORCE,
        ),
        (
            given.film_length.is_some(),
            "peak_mount_film_force",
            "N",
            peaks.film,
            &PART_FORCE,
        ),
        (stop, "peak_mount_stop_force", "N", peaks.stop, &PART_FORCE),
        (
            housing,
            "max_housing_displacement",
            "m",
            peaks.housing_displacement,
            &HOUSING,
        ),
        (
            housing,
            "max_housing_speed",
            "m/s",
            peaks.housing_speed,
            &HOUSING,
        ),
    ] {
        if there {
            list.number(name, unit, Ok(peak.value), origin);
        }
    }
}

/// A hard stop that is hit, and its largest force, N.
pub(super) fn stopped(context: &Context, k: usize) -> Option<(f64, Warning)> {
    let peaks = context.record(k).mount_parts.as_ref()?;
    let first = peaks.first_stop?;
    let gap = context.given(k).mount.parts.stop_gap?;
    let text = format!(
        "The mount hits its hard stop: the outer race closes the gap of {:.0} µm at {:.2} ms, and the stop carries up to {:.0} N at {:.2} ms. The \
         resilient part protects nothing then; a larger gap, a stiffer mount or more damping keeps them apart.",
        1e6 * gap,
        1e3 * first,
        peaks.stop.value,
        1e3 * peaks.stop.time
    );
    Some((peaks.stop.value, warning("AB1097", text)))
}
