//! The named results of dry whirl, and what they warn of.

use super::{BearingWhirl, MountMap, WhirlBearing, WhirlModel};
use crate::rotor::warnings::RotorWarning;
use outcome::Warning;
use outcome::list::{List, origins, results};
use rotor::{SmallestFriction, WhirlPoint, WhirlRange};
use simulate::drawing::GIVEN;
use units::number_text;

/// Names the results of each bearing; without a second argument those of any such analysis.
pub(crate) fn name(list: &mut List, model: &WhirlModel, found: Option<&[BearingWhirl]>) {
    for (k, bearing) in model.bearings.iter().enumerate() {
        list.named(&[&bearing.name], |list| {
            bearing_whirl(list, bearing, found.map(|all| &all[k]));
        });
    }
}

results! {
    fn bearing_whirl(bearing: &WhirlBearing, run: &BearingWhirl) {
        "whirl.*.friction_coefficient": number "", GIVEN, "friction coefficient of rotor and race" in whirl "μ of the file" => bearing.constants.contact.friction;
        "whirl.*.needed_friction": number "" headline, NEEDED, "smallest friction coefficient with which dry backward whirl goes on" in whirl "smallest needed μ" => run.smallest().map(|own| own.point.friction);
        "whirl.*.needed_friction_frequency": number "rad/s", NEEDED, "frequency of the whirl that needs it" in whirl "at" => run.smallest().map(|own| own.point.frequency);
        "whirl.*.needed_friction_place": text "", NEEDED, "where on the curve that is" in whirl "where" => run.place(bearing);
        "whirl.*.settling_frequency": number "rad/s" headline, SETTLES, "frequency at which whirl in full slip settles" in whirl "whirl settles at" => run.settles().map(|own| own.frequency);
        "whirl.*.settling_force": number "N" headline, SETTLES, "contact force of that whirl" in whirl "contact force there" => run.settles().map(|own| own.force);
        "whirl.*.needed_damping": number "N s/m" headline, MAP, "smallest damping of the mount, at its stiffness, with which no whirl up to frequency_to goes on; of the range nearest to that of the file" in whirl "mount.damping needed" => run.cure(bearing, 0);
        "whirl.*.largest_damping": number "N s/m", MAP, "largest damping of that range: more of it locks the mount" in whirl "at most" => run.cure(bearing, 1);
        "whirl.*.frequency_from": number "rad/s", RANGE, "lowest frequency looked at" => bearing.range[0];
        "whirl.*.frequency_to": number "rad/s", RANGE, "highest frequency looked at" => bearing.range[1];
        "whirl.*.band_starts": list "rad/s", NEEDED, "lower ends of the ranges in which the file's friction exceeds the needed one" in whirl_bands "from" => run.over_ranges(|own| own.from);
        "whirl.*.band_ends": list "rad/s", NEEDED, "upper ends of these ranges" in whirl_bands "to" => run.over_ranges(|own| own.to);
        "whirl.*.band_forces": list "N", SETTLES, "contact force where whirl settles in each of them; no number where the range ends otherwise" in whirl_bands "force" => run.over_ranges(|own| own.settles.map_or(f64::NAN, |own| own.force));
        "whirl.*.frequencies": list "rad/s", NEEDED, "frequencies of the curves" in whirl_curves "frequency" => run.curve.iter().map(|own| own.frequency).collect::<Vec<_>>();
        "whirl.*.needed_frictions": list "", NEEDED, "needed friction at each of them; no number where there is no whirl" in whirl_curves "friction" => run.curve.iter().map(|own| own.friction).collect::<Vec<_>>();
        "whirl.*.forces": list "N", FORCE, "contact force at each of them" in whirl_curves "force" => run.curve.iter().map(|own| own.force).collect::<Vec<_>>();
        "whirl.*.mount_stiffness": number "N/m", GIVEN, "stiffness of the mount" in whirl_mount "stiffness" => bearing.constants.mount.stiffness;
        "whirl.*.mount_damping": number "N s/m", GIVEN, "damping of the mount" in whirl_mount "damping" => bearing.constants.mount.damping;
        "whirl.*.map_stiffnesses": list "N/m", MAP, "stiffnesses of the mount in the map" in whirl_map "stiffness" when !bearing.is_held() => run.mapped(|map| &map.stiffnesses);
        "whirl.*.map_dampings": list "N s/m", MAP, "dampings of the mount in the map" in whirl_map "damping" when !bearing.is_held() => run.mapped(|map| &map.dampings);
        "whirl.*.map_needed_frictions": list "", MAP, "smallest needed friction of each, stiffness after stiffness of a damping" in whirl_map "friction" when !bearing.is_held() => run.mapped(|map| &map.friction);
    }
}

const VALID: &str = "circular whirl in full slip against a race at rest, linear and equal in all directions; rings, films and stops of the mount left out, balls rigid";
origins! {
    NEEDED: law "μ_e = Im α/|Re α|, α of rotor and race for motion e^{-jωt}; minimum and ends refined",
        source "crates/physics/src/dry_whirl.rs; book/src/theory/whirl.md",
        valid VALID;
    FORCE: law "N (|Re α| + μ_e Im α) = c0 + (N/k)^(1/n)",
        source "crates/physics/src/dry_whirl.rs",
        valid VALID;
    SETTLES: law "needed friction rising through that of the file: slower whirl is driven, faster whirl braked",
        source "crates/physics/src/dry_whirl.rs; book/src/theory/whirl.md",
        valid VALID;
    RANGE: law "from √(g/c0) of a rotor that nothing else carries, to analysis.whirl_to or where the surfaces roll",
        source "crates/physics/src/dry_whirl.rs",
        valid "clearance large against the penetration";
    MAP: law "the smallest needed friction with mount.stiffness and mount.damping changed, Maxwell branches as they are",
        source "crates/analyse/src/rotor/whirl/mod.rs",
        valid VALID;
}

impl BearingWhirl {
    fn smallest(&self) -> Result<SmallestFriction, String> {
        let none = || "no friction keeps whirl going at any of the frequencies".to_string();
        self.smallest.ok_or_else(none)
    }

    /// The slowest whirl that settles: an accelerating one meets it first.
    fn settles(&self) -> Result<WhirlPoint, String> {
        let mut all = self.ranges.iter().filter_map(|own| own.settles);
        let none = || match self.ranges.is_empty() {
            true => "the friction of the file drives no whirl".to_string(),
            false => "the friction of the file exceeds the needed one up to the end of the band"
                .to_string(),
        };
        all.next().ok_or_else(none)
    }

    fn place(&self, bearing: &WhirlBearing) -> String {
        let Some(SmallestFriction { point, at_end }) = self.smallest else {
            return "nowhere".to_string();
        };
        let [low, high] = bearing
            .range
            .map(|end| (point.frequency / end - 1.0).abs() < 1e-6);
        let text = match (at_end, low, high, bearing.ended_by) {
            (false, ..) => "minimum of the curve",
            (_, true, _, [true, _]) => {
                "lower end: slower whirl cannot lift the rotor against its weight"
            }
            (_, true, ..) => "lower end of the frequencies",
            (_, _, true, [_, true]) => "upper end: the surfaces roll on each other",
            (_, _, true, _) => "upper end of the frequencies: faster whirl may need less",
            _ => "end of a band",
        };
        text.to_string()
    }

    /// Whether faster whirl may need less friction than any looked at: the inertia of a race that moves carries it beyond its resonance; on one
    /// that is held the curve still falls at its end.
    fn may_fall_beyond(&self, held: bool) -> bool {
        let falls = match self.curve.as_slice() {
            [.., before, last] => last.friction < before.friction,
            _ => true,
        };
        !held || falls
    }

    fn over_ranges(&self, value: fn(&WhirlRange) -> f64) -> Vec<f64> {
        self.ranges.iter().map(value).collect()
    }

    fn mapped(&self, value: fn(&MountMap) -> &Vec<f64>) -> Vec<f64> {
        self.map.as_ref().map(value).cloned().unwrap_or_default()
    }

    /// An end of the damping with which whirl does not go on: 0 the lower, 1 the upper.
    fn cure(&self, bearing: &WhirlBearing, end: usize) -> Result<f64, String> {
        let Some(map) = &self.map else {
            let why = match bearing.is_held() {
                true => "the inner race is held: no mount acts",
                false => "there is no whirl at any of the frequencies",
            };
            return Err(why.to_string());
        };
        let none = || {
            let [low, high] = [map.dampings.first(), map.dampings.last()];
            let [low, high] = [low, high].map(|own| own.copied().unwrap_or_default());
            format!("no damping from {low:.3e} to {high:.3e} N s/m does at this stiffness")
        };
        let found = map.cure.ok_or_else(none)?;
        let value = [found.from, found.to][end];
        match (found.open[end], end) {
            (false, _) => Ok(value),
            (true, 0) => Err(format!(
                "the least damping looked at, {value:.3e} N s/m, suffices"
            )),
            (true, _) => Err(format!(
                "the largest damping looked at, {value:.3e} N s/m, is not too much"
            )),
        }
    }
}

/// What the user should know of dry whirl.
pub(crate) fn warned(model: &WhirlModel, found: &[BearingWhirl]) -> Vec<Warning> {
    let mut out = Vec::new();
    for (bearing, own) in model.bearings.iter().zip(found) {
        let friction = bearing.constants.contact.friction;
        let mut add = |warning: RotorWarning| {
            out.push(Warning::from(warning).of_part(&bearing.name));
        };
        let smallest = own.smallest.filter(|least| least.point.friction < friction);
        if let Some(SmallestFriction { point, .. }) = smallest {
            let settles = own.settles();
            add(RotorWarning::DryWhirl {
                friction,
                needed: point.friction,
                frequency: point.frequency,
                force: settles.as_ref().map_or(point.force, |own| own.force),
                settling: match &settles {
                    Ok(own) => format!(
                        "Full slip settles at {:.1} rad/s with a contact force of {} N",
                        own.frequency,
                        number_text(own.force.round())
                    ),
                    Err(_) => format!(
                        "Whirl accelerates to the end of the frequencies looked at; where least friction is needed the contact force is {} N",
                        number_text(point.force.round())
                    ),
                },
                cure: cure(own, bearing),
            });
        }
        if !bearing.ended_by[1] && own.may_fall_beyond(bearing.is_held()) {
            let to = bearing.range[1];
            add(RotorWarning::WhirlRange { to });
        }
        let left_out = bearing.constants.mount_parts.not_linear();
        if !left_out.is_empty() {
            let parts = left_out.join(", ");
            add(RotorWarning::NotInWhirl { parts });
        }
    }
    if !model.unequal.is_empty() {
        let supports = model.unequal.join(", ");
        out.push(RotorWarning::WhirlAveraged { supports }.into());
    }
    if !model.bearings.is_empty() {
        out.push(RotorWarning::WhirlLimits.into());
    }
    out
}

/// What the mount needs.
fn cure(own: &BearingWhirl, bearing: &WhirlBearing) -> String {
    let Some(map) = &own.map else {
        return "Its race is held: only less friction keeps it from whirling".to_string();
    };
    match (map.cure, &map.nearest) {
        (Some(range), _) => {
            let to = bearing.range[1];
            let (least, most, has) = (range.from, range.to, bearing.constants.mount.damping);
            format!(
                "At its stiffness {least:.3e} to {most:.3e} N s/m prevent whirl up to {to:.0} rad/s; the mount has {has:.3e} N s/m"
            )
        }
        (None, Some(mount)) => format!(
            "No damping alone prevents it; a mount of {:.2e} N/m with {:.2e} N s/m does",
            mount.stiffness, mount.damping
        ),
        (None, None) => "No mount within the map prevents it".to_string(),
    }
}
