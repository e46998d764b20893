//! Surfaces of rotor and inner race: what they are made of, how hot they became, what was worn off.

use crate::bearing::severity::{STEEL_CHANGES, wide_line};
use crate::drop::context::Context;
use crate::drop::context::touched;
use crate::drop::layers::rotor_layer;
use crate::drop::warning_table::DropWarning;
use model::surface_heat::SurfaceHeat;
use model::system::machine::record::BearingRecord;
use outcome::Warning;
use outcome::list::results;
use outcome::list::{not_given, origins};
use physics::heat_exchange::line_half_width;
use physics::severity::wear_volume;
use scenario::AuxiliaryBearing;
use scenario::drop::Contact;
use std::f64::consts::PI;

/// Time in the patch, s, from which on one place of the rotor is heated on its own.
const STAYS: f64 = 5e-3;

results! {
    /// How hot the surfaces of a bearing became, and what was worn off.
    pub(crate) fn name(given: &AuxiliaryBearing, run: &BearingRecord) {
        "contact_temperature_rise": number "K", PATCH, "largest rise of the contact patch", unless no_width(given) => rubbed(run, |heat| heat.contact.value);
        "contact_temperature_index": number "1", INDEX, "this rise over that which changes steel" in worst "contact of rotor and race too hot", unless no_width(given) => {
            rubbed(run, |heat| heat.contact.value / STEEL_CHANGES)
        };
        "contact_temperature_time": number "s", PATCH, "instant of this rise", unless no_width(given) => rubbed(run, |heat| heat.contact.time);
        "contact_temperature_rises": list "K", PATCH, "largest rise of the patch in each contact" when no_width(given).is_none() => {
            run.contacts.iter().map(|contact| contact.peak_rise).collect::<Vec<_>>()
        };
        "rotor_surface_rise": number "K", SURFACE, "largest rise of the rotor's surface", unless no_width(given) => rubbed(run, |heat| heat.surfaces[0].value);
        "friction_heat_into_rotor": number "J", SHARE, "friction heat into the rotor", unless no_width(given) => rubbed(run, |heat| heat.taken()[0]);
        "race_surface_rise": number "K", SURFACE, "largest rise of the race's surface", unless no_width(given) => rubbed(run, |heat| heat.surfaces[1].value);
        "friction_heat_into_race": number "J", SHARE, "friction heat into the race", unless no_width(given) => rubbed(run, |heat| heat.taken()[1]);
        "peak_pressure_times_speed": number "W/m^2", PRESSURE_SPEED, "largest nominal pressure times sliding speed", unless no_width(given) => {
            rubbed(run, |heat| heat.pressure_speed.value)
        };
        "sliding_distance": number "m", DISTANCE, "distance slid by rotor and race", unless no_width(given) => rubbed(run, |heat| heat.distance);
        "wear_depth": number "m", WEAR, "mean depth worn off" in added_up "wear depth", unless {
            not_given("contact.surface.wear_coefficient", given.contact.wear_coefficient).or(no_width(given))
        } => worn(&given.contact, run);
    }
}

pub(super) fn no_width(given: &AuxiliaryBearing) -> Option<String> {
    let faces = given.contact.faces.any();
    let shared = || "faces share the friction heat of the landing surface".to_string();
    not_given("contact.width", given.contact.width).or_else(|| faces.then(shared))
}

/// What exists of surfaces that touched.
fn rubbed(record: &BearingRecord, value: fn(&SurfaceHeat) -> f64) -> Result<f64, String> {
    let heat = record
        .heat
        .as_deref()
        .filter(|_| !record.contacts.is_empty());
    touched(heat.map(value))
}

/// Mean depth worn off by ∫N|u| dt, N m: m.
pub(super) fn wear_depth(contact: &Contact, rubbed: f64) -> f64 {
    let [coefficient, width] =
        [contact.wear_coefficient, contact.width].map(|of| of.unwrap_or(f64::NAN));
    wear_volume(coefficient, 1.0, rubbed) / (PI * contact.bore_diameter * width)
}

/// Mean depth worn off, m.
fn worn(contact: &Contact, record: &BearingRecord) -> Result<f64, String> {
    let rubbed = rubbed(record, |heat| heat.rubbed)?;
    match contact.friction_coefficient > 0.0 {
        // ∫N|u| dt: the distance slid under 1 N
        true => Ok(wear_depth(contact, rubbed)),
        false => Err("without friction the ledger does not tell the sliding".to_string()),
    }
}

/// Surfaces that became so hot, or were heated at one place so long, that their numbers do not hold.
pub(crate) fn judged(context: &Context, k: usize) -> Vec<(f64, Warning)> {
    let record = context.record(k);
    let Some(heat) = record.heat.as_deref() else {
        return Vec::new();
    };
    let constants = &context.setup.machine.constants.bearings[k];
    let contact = &constants.contact;
    let wide =
        (constants.surfaces.as_ref().zip(record.peak_contact_force())).and_then(|(own, peak)| {
            let (bore, clearance) = (contact.bore_radius, contact.radial_clearance);
            let half = line_half_width(peak.value, bore, clearance, own.length, own.modulus);
            Some((half / bore, wide_line(half, bore, clearance)?))
        });
    let mut list: Vec<_> = wide.into_iter().collect();
    let rise = heat.contact.value;
    if rise > STEEL_CHANGES {
        let time = heat.contact.time;
        list.push((rise, DropWarning::HotContact { rise, time }.into()));
    }
    if heat.longest_stay > STAYS {
        let stay = heat.longest_stay;
        list.push((stay, DropWarning::HotSpot { stay }.into()));
    }
    let layer = rotor_layer(&context.setup.given(k).contact);
    let first = context.record(k).contacts.first();
    let since = first.map_or(0.0, |first| heat.surfaces[0].time - first.start);
    if context.record(k).warmth.is_none() && since > layer.through() {
        let through = layer.through();
        list.push((since, DropWarning::LayerIsWarm { since, through }.into()));
    }
    list
}

const FILE: &str =
    "crates/model/src/surface_heat.rs; heat flow: crates/thermal/src/rubbing_contact.rs";
origins! {
    PATCH: law "rise of both surfaces in the patch of a Hertz line contact, mean over the patch at its hottest edge: surface layers and flash, \
          friction heat divided so that both sides are equally hot",
        source FILE,
        valid "30 % by the width of the patch; a factor 2 where tilt or wear has changed its shape; asperities are hotter; chaotic after \
            several contacts, within a factor of 2 (--repeat)";
    INDEX: law "contact_temperature_rise over 500 K",
        source "tempering and transformation of bearing steel, rounded down",
        valid "1: the surface of steel changes; other materials and coatings have limits of their own";
    SURFACE: law "largest rise of the surface, averaged over its track: the arc of that body between the smallest and the largest angle of contact",
        source FILE,
        valid "with heat.network, or until the rotor's layer is warm throughout (AB2331); chaotic after several contacts, within a factor of 2 (--repeat)";
    SHARE: law "friction heat that went into this body; both add to rotor_race_friction_energy",
        source FILE,
        valid "as contact_temperature_rise";
    PRESSURE_SPEED: law "largest N |u|/(2 R L), nominal pressure times sliding speed",
        source "crates/model/src/surface_heat.rs",
        valid "at steps; a measure of makers of landing sleeves, not a pressure of the contact";
    DISTANCE: law "∫|u| dt while rotor and race touch",
        source "crates/model/src/surface_heat.rs",
        valid "of the drop ball by ball; a coast-down after it has coast_down.sliding_distance";
    WEAR: law "k ∫N |u| dt over the landing surface of the race, k = contact.surface.wear_coefficient",
        source "Archard, by the friction heat over the coefficient of its instant; crates/physics/src/severity.rs",
        valid "volume worn off both bodies together, spread evenly; k is uncertain by decades; of the drop ball by ball; a coast-down after it has coast_down.wear_depth";
}
