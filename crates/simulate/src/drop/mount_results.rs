//! What the parts of a mount did in a run.

use crate::drop::context::Context;
use crate::drop::warning_table::DropWarning;
use model::system::machine::bearing_record::MountPeaks;
use outcome::Warning;
use outcome::list::origins;
use outcome::list::results;
use scenario::drop::mount::MountParts;

pub(super) const SOURCE: &str = "crates/model/src/mount/; book/src/theory/drop.md, mounts";

origins! {
    PART_FORCE: law "largest size of the force between outer race and housing in this part alone, at the steps and, near the record, on dense output",
        source SOURCE,
        valid "as the part: crates/model/src/mount/";
    HOUSING: law "largest |h| and |dh/dt| of the housing, at the steps and, near the record, on dense output",
        source SOURCE,
        valid "a housing that carries one bearing, from its place under the weight at rest";
}

results! {
    /// What the parts that are given did.
    pub(super) fn name(given: &MountParts, run: &MountPeaks) {
        "peak_mount_ring_force": number "N", PART_FORCE, "largest force of the friction ring" when given.ring_stiffness.is_some() => run.ring.value;
        "peak_mount_film_force": number "N", PART_FORCE, "largest force of the squeeze film" when given.film_length.is_some() => run.film.value;
        "peak_mount_stop_force": number "N", PART_FORCE, "largest force of the hard stop" when given.stop_gap.is_some() => run.stop.value;
        "max_housing_displacement": number "m", HOUSING, "largest displacement of the housing" when given.housing_mass.is_some() => {
            run.housing_displacement.value
        };
        "max_housing_speed": number "m/s", HOUSING, "largest speed of the housing" when given.housing_mass.is_some() => run.housing_speed.value;
    }
}

/// A hard stop that is hit, and its largest force, N.
pub(super) fn stopped(context: &Context, k: usize) -> Option<(f64, Warning)> {
    let peaks = context.record(k).mount_parts.as_ref()?;
    let warning = DropWarning::HardStop {
        time: peaks.first_stop?,
        gap: context.setup.given(k).mount.parts.stop_gap?,
        force: peaks.stop.value,
        peak_time: peaks.stop.time,
    };
    Some((peaks.stop.value, warning.into()))
}
