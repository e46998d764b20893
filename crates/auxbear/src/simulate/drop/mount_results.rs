//! What the parts of a mount did in a run.

use crate::result::list::{List, Origin};
use crate::result::outcome::{Warning, warning};
use crate::scenario::Mount;
use crate::simulate::drop::context::Context;
use model::system::machine::record::BearingRecord;

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
