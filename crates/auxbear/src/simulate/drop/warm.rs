//! Temperatures of the auxiliary bearings: named results, columns, and what is too hot.

use crate::result::list::{List, Origin, relative};
use crate::result::outcome::{Warning, warning};
use crate::scenario::Warm;
use crate::simulate::bearing::columns::Table;
use crate::simulate::coast_down::build::ICE_POINT;
use crate::simulate::drop::context::Context;
use model::bearing_heat::{WarmBearing, Warmth};
use thermal::bearing_network::{CAGE, NODES};

/// A bearing whose temperatures were followed.
struct Followed<'a> {
    given: &'a Warm,
    part: &'a WarmBearing,
    warmth: &'a Warmth,
}

impl<'a> Followed<'a> {
    fn of(context: &Context<'a>, k: usize) -> Option<Self> {
        Some(Followed {
            given: context.given(k).warm.as_deref()?,
            part: context.machine.constants.bearings[k].warm.as_deref()?,
            warmth: context.record(k).warmth.as_deref()?,
        })
    }

    /// The nodes that are there: a full complement has no cage.
    fn nodes(&self) -> impl Iterator<Item = (usize, &'static str)> {
        let with_cage = self.given.cage_mass > 0.0;
        (NODES.into_iter().enumerate()).filter(move |(node, _)| *node != CAGE || with_cage)
    }
}

/// Names the results of a bearing.
pub(crate) fn name(context: &Context, k: usize, list: &mut List) {
    let Some(followed) = Followed::of(context, k) else {
        return;
    };
    let warmth = followed.warmth;
    for (node, name) in followed.nodes() {
        let (peak, _) = warmth.peaks[node];
        let name = format!("peak_{name}_temperature");
        list.number(&name, "K", Ok(peak + ICE_POINT), &PEAK);
    }
    let stored = followed.part.stored(&warmth.temperatures);
    list.number("heat_made", "J", Ok(warmth.made), &HEAT);
    list.number("stored_heat", "J", Ok(stored), &HEAT);
    list.number("heat_to_surroundings", "J", Ok(warmth.given), &HEAT);
    let left = warmth.made - stored - warmth.given;
    list.number(
        "relative_heat_residual",
        "1",
        relative(left.abs(), warmth.made),
        &RESIDUAL,
    );
}

/// Temperatures over time.
pub(crate) fn columns<'a>(context: &Context<'a>, k: usize, table: &mut Table<'a>) {
    let Some(followed) = Followed::of(context, k) else {
        return;
    };
    let (part, warmth) = (followed.part, followed.warmth);
    for (node, name) in followed.nodes() {
        let words = name.replace('_', " ");
        table.add(
            &format!("{name}.temperature"),
            "K",
            &format!("temperature of the {words}, of one temperature throughout"),
            move |row| warmth.at(part, node, row.time) + ICE_POINT,
        );
    }
}

/// What became hotter than it may.
pub(crate) fn judged(context: &Context, k: usize) -> Vec<(f64, Warning)> {
    let Some(followed) = Followed::of(context, k) else {
        return Vec::new();
    };
    let heat = &followed.given.heat;
    let limit = |name: &str| match name {
        "inner_race" | "balls" | "outer_race" => Some(heat.race_limit - ICE_POINT),
        "cage" => Some(heat.cage_limit - ICE_POINT),
        "lubricant" => Some(heat.lubricant_limit - ICE_POINT),
        _ => None,
    };
    let hottest = followed.nodes().filter_map(|(node, name)| {
        let (peak, time) = followed.warmth.peaks[node];
        let above = peak - limit(name)?;
        (above > 0.0).then_some((above, name, peak, time))
    });
    let hottest = hottest.max_by(|a, b| a.0.total_cmp(&b.0));
    let told = |(above, name, peak, time): (f64, &str, f64, f64)| {
        let text = format!(
            "Too hot: {} at {peak:.0} °C after {time:.2} s, {above:.0} K above its limit, and warmer still where the heat comes in. \
             Hardness, size, cage and lubricant may change there; this run does not follow that.",
            name.replace('_', " ")
        );
        (above, warning("AB2310", text))
    };
    hottest.map(told).into_iter().collect()
}

const PEAK: Origin = Origin {
    law: "C Ṫ = P + Σ G (T_other − T), P the heats of the ledger over the nodes",
    source: "crates/model/src/bearing_heat.rs, crates/thermal/src/bearing_network.rs; heat-and-life, sections 2 and 3",
    valid: "bodies of one temperature: from about 0.1 s on; in whirl and first contact the surfaces are hotter. Conductances within a \
            factor of two. Nothing of the motion follows the temperature",
};
const HEAT: Origin = Origin {
    law: "heats of the ledger that reach the bearing, rotor and housing; C ΔT of all nodes; ∫G (T − T_ambient) dt",
    source: "crates/model/src/bearing_heat.rs",
    valid: "of one of equal bearings",
};
const RESIDUAL: Origin = Origin {
    law: "|heat made − stored − given away| over the heat made",
    source: "energy balance",
    valid: "rounding",
};
