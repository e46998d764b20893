//! Surfaces of rotor and inner race: what they are made of, how hot they became, what was worn off.

use crate::result::list::{List, NOT_GIVEN, Origin};
use crate::result::outcome::{Value, Warning, warning};
use crate::simulate::bearing::severity::{STEEL_CHANGES, wide_line};
use crate::simulate::drop::context::Context;
use model::surface_heat::SurfaceHeat;
use physics::heat_exchange::line_half_width;
use physics::severity::wear_volume;
use std::f64::consts::PI;

/// Time in the patch, s, from which on one place of the rotor is heated on its own.
const STAYS: f64 = 5e-3;

/// Names the results of the surfaces of a bearing.
pub(crate) fn name(context: &Context, k: usize, list: &mut List) {
    let record = context.record(k);
    let contact = &context.given(k).contact;
    let heat = record.heat.as_deref();
    let of = |value: &dyn Fn(&SurfaceHeat) -> f64| {
        let no_width = || format!("contact.width{NOT_GIVEN}");
        let heat = heat.ok_or_else(no_width)?;
        match record.contacts.is_empty() {
            true => Err("rotor and inner race never touched in this run".to_string()),
            false => Ok(value(heat)),
        }
    };
    list.number(
        "contact_temperature_rise",
        "K",
        of(&|heat| heat.contact.value),
        &PATCH,
    );
    list.number(
        "contact_temperature_index",
        "1",
        of(&|heat| heat.contact.value / STEEL_CHANGES),
        &INDEX,
    );
    list.number(
        "contact_temperature_time",
        "s",
        of(&|heat| heat.contact.time),
        &PATCH,
    );
    let rises = record.contacts.iter().map(|contact| contact.peak_rise);
    if heat.is_some() {
        let rises = Value::List(rises.collect());
        list.push("contact_temperature_rises", "K", rises, &PATCH);
    }
    for (body, place) in [("rotor", 0), ("race", 1)] {
        let rise = of(&|heat| heat.surfaces[place].value);
        list.number(&format!("{body}_surface_rise"), "K", rise, &SURFACE);
        let taken = of(&|heat| heat.taken()[place]);
        list.number(&format!("friction_heat_into_{body}"), "J", taken, &SHARE);
    }
    let pressure_speed = of(&|heat| heat.pressure_speed.value);
    list.number(
        "peak_pressure_times_speed",
        "W/m^2",
        pressure_speed,
        &PRESSURE_SPEED,
    );
    list.number(
        "sliding_distance",
        "m",
        of(&|heat| heat.distance),
        &DISTANCE,
    );

    let coefficient = contact.wear_coefficient;
    let coefficient =
        coefficient.ok_or_else(|| format!("contact.surface.wear_coefficient{NOT_GIVEN}"));
    let depth = |diameter: f64| {
        let coefficient = coefficient.clone()?;
        let rubbed = of(&|heat| heat.rubbed)?;
        match contact.friction_coefficient > 0.0 {
            true => {
                let area = PI * diameter * contact.width.unwrap_or(f64::NAN);
                // ∫N|u| dt: the distance slid under 1 N
                Ok(wear_volume(coefficient, 1.0, rubbed) / area)
            }
            false => Err("without friction the ledger does not tell the sliding".to_string()),
        }
    };
    list.number("wear_depth", "m", depth(contact.bore_diameter), &WEAR);
}

/// Surfaces that became so hot, or were heated at one place so long, that their numbers do not hold.
pub(crate) fn judged(context: &Context, k: usize) -> Vec<(f64, Warning)> {
    let record = context.record(k);
    let Some(heat) = record.heat.as_deref() else {
        return Vec::new();
    };
    let constants = &context.machine.constants.bearings[k];
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
        let text = format!(
            "Where rotor and race rub, the patch warms by {rise:.0} K ({:.2} ms): steel softens and transforms there, the surfaces may \
             smear or seize, and the friction coefficient of this run no longer holds.",
            1e3 * heat.contact.time
        );
        list.push((rise, warning("AB2301", text)));
    }
    if heat.longest_stay > STAYS {
        let text = format!(
            "One place of the rotor stays in the contact for {:.0} ms: a hot spot, which bends the shaft and adds to its unbalance. \
             This run spreads its heat over the rotor's track and bends nothing.",
            1e3 * heat.longest_stay
        );
        list.push((heat.longest_stay, warning("AB2302", text)));
    }
    let layer = context.given(k).contact.rotor_layer();
    let first = context.record(k).contacts.first();
    let since = first.map_or(0.0, |first| heat.surfaces[0].time - first.start);
    if context.record(k).warmth.is_none() && since > layer.through() {
        let text = format!(
            "The rotor's surface is hottest {since:.1} s after the first contact, and without heat.network = \"on\" its layer gives no heat to the metal \
             behind it: from {:.1} s on its rise, contact_temperature_rise and the share of heat that the race takes are too high. A bushing has no \
             network: a deeper contact.surface.rotor_layer is right for longer.",
            layer.through()
        );
        list.push((since, warning("AB2331", text)));
    }
    list
}

const FILE: &str =
    "crates/model/src/surface_heat.rs; heat flow: crates/thermal/src/rubbing_contact.rs";
const PATCH: Origin = Origin {
    law: "rise of both surfaces in the patch of a Hertz line contact, mean over the patch at its hottest edge: surface layers and flash, \
          friction heat divided so that both sides are equally hot",
    source: FILE,
    valid: "30 % by the width of the patch; a factor 2 where tilt or wear has changed its shape; asperities are hotter; chaotic after \
            several contacts, within a factor of 2 (--repeat)",
};
const INDEX: Origin = Origin {
    law: "contact_temperature_rise over 500 K",
    source: "tempering and transformation of bearing steel, rounded down",
    valid: "1: the surface of steel changes; other materials and coatings have limits of their own",
};
const SURFACE: Origin = Origin {
    law: "largest rise of the surface, averaged over its track: the arc of that body between the smallest and the largest angle of contact",
    source: FILE,
    valid: "with heat.network, or until the rotor's layer is warm throughout (AB2331); chaotic after several contacts, within a factor of 2 (--repeat)",
};
const SHARE: Origin = Origin {
    law: "friction heat that went into this body; both add to rotor_race_friction_energy",
    source: FILE,
    valid: "as contact_temperature_rise",
};
const PRESSURE_SPEED: Origin = Origin {
    law: "largest N |u|/(2 R L), nominal pressure times sliding speed",
    source: "crates/model/src/surface_heat.rs",
    valid: "at steps; a measure of makers of landing sleeves, not a pressure of the contact",
};
const DISTANCE: Origin = Origin {
    law: "∫|u| dt while rotor and race touch",
    source: "crates/model/src/surface_heat.rs",
    valid: "of the drop ball by ball; windows of a run-out after it are reported by AB2318",
};
const WEAR: Origin = Origin {
    law: "k ∫N |u| dt over the landing surface of the race, k = contact.surface.wear_coefficient",
    source: "Archard, by the friction heat over the coefficient of its instant; crates/physics/src/severity.rs",
    valid: "volume worn off both bodies together, spread evenly; k is uncertain by decades; of the drop ball by ball, not of a run-out after it",
};
