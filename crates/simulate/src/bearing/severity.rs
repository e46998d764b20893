//! How hard a run was on its bearing: safety of the ball loads, indentation, blows, warmth of the inner race.

use crate::bearing::run::BearingRun;
use crate::bearing::warning_table::BearingWarning;
use model::system::sampling::Peak;
use outcome::Warning;
use outcome::list::origins;
use outcome::list::results;
use physics::heat_exchange::line_holds;
use physics::materials::BEARING_STEEL_SPECIFIC_HEAT;
use physics::severity::{ball_load_safety, permanent_indentation};
use scenario::{BallMaterial, Bearing};

/// Indentation over the ball's diameter between which its law holds.
const RANGE: [f64; 2] = [1e-5, 1e-3];

/// Rise of an inner race from which on what does not follow its warmth misleads: from 20 °C to the 120 °C of common rings, K.
pub(crate) const HOT_RACE: f64 = 100.0;

/// Rise of a surface, K, from which on steel under it is no longer what it was.
pub(crate) const STEEL_CHANGES: f64 = 500.0;

/// Heats of which half goes to the inner race.
const AT_THE_INNER_RACE: [&str; 4] = [
    "rotor_race_friction",
    "rotor_race_damping",
    "inner_contact_damping",
    "inner_ball_slip",
];

/// Rise of the inner race, K, of which half of the heats at its surfaces is enough, or why there is none.
pub(crate) fn inner_race_rise(run: &BearingRun, bearing: &Bearing) -> Result<f64, String> {
    let heat: f64 = AT_THE_INNER_RACE.iter().map(|kind| run.heat(kind)).sum();
    let [mass, _] = bearing.inner_race();
    let capacity = mass * BEARING_STEEL_SPECIFIC_HEAT;
    let on_shaft = || "bearing.inner_race_mass is 0: the race sits on a shaft".to_string();
    (capacity > 0.0)
        .then(|| 0.5 * heat / capacity)
        .ok_or_else(on_shaft)
}

/// A contact of rotor and race whose half-width under its largest force, m, is beyond the law of a line in a bore of a radius and with a radial
/// clearance, m.
pub(crate) fn wide_line(half_width: f64, bore: f64, clearance: f64) -> Option<Warning> {
    let warning = BearingWarning::WideLine {
        half_width,
        bore,
        clearance,
    };
    (!line_holds(half_width, bore, clearance)).then(|| warning.into())
}

results! {
    /// Safety of the largest ball load, and what it leaves behind.
    pub(super) fn of_ball_load(given: &Bearing, run: &BearingRun) {
        "ball_load_safety": number "1", SAFETY, "load that dents over the largest ball load" => safety(run.pressures().races, given.hertz_pressure_limit);
        "indentation_index": number "1", INDENTATION_INDEX, "largest ball load over the load that dents" in worst "dents by ball loads" => {
            indentation_index(run.pressures().races, given.hertz_pressure_limit)
        };
        "largest_indentation": number "m", INDENTATION, "depth of the largest permanent indentation" => indentation(run.peaks(), given);
    }
}

/// Load that dents over that of the most loaded ball, by its pressure and the limit of that, Pa.
fn safety(pressure: f64, limit: f64) -> Result<f64, String> {
    match pressure > 0.0 {
        true => Ok(ball_load_safety(limit, pressure)),
        false => Err("no ball was loaded".to_string()),
    }
}

/// Its inverse, which is 0 without a load.
pub(crate) fn indentation_index(pressure: f64, limit: f64) -> f64 {
    safety(pressure, limit).map_or(0.0, |safety| 1.0 / safety)
}

/// Blows beyond a load at rest: the largest force of each contact, and that load, N.
pub(crate) fn blows(peaks: impl Iterator<Item = f64>, load: f64) -> Result<f64, String> {
    match load > 0.0 {
        true => Ok(peaks.map(|peak| (peak / load - 1.0).max(0.0)).sum()),
        false => Err("no weight lies on this bearing".to_string()),
    }
}

/// The deeper one of both races, m, or why there is no law for it.
fn indentation([inner, outer, ..]: [Peak; 4], bearing: &Bearing) -> Result<f64, String> {
    if bearing.ball_material == BallMaterial::SiliconNitride {
        return Err("its law is for steel balls; ceramic ones indent the ring alone".to_string());
    }
    let diameter = bearing.ball_diameter;
    let gamma = diameter * bearing.contact_angle.cos() / bearing.pitch_diameter;
    let of = |load: Peak, groove, inner| {
        permanent_indentation(load.value, diameter, groove, gamma, inner)
    };
    let ratio = of(inner, bearing.inner_groove_curvature, true).max(of(
        outer,
        bearing.outer_groove_curvature,
        false,
    ));
    match ratio {
        ratio if ratio < RANGE[0] => Err(format!(
            "{ratio:.1e} of a ball's diameter, below the 1e-5 from which the law holds: hardly any"
        )),
        ratio if ratio > RANGE[1] => Err(format!(
            "{ratio:.1e} of a ball's diameter, above the 1e-3 up to which the law holds: deep"
        )),
        ratio => Ok(ratio * diameter),
    }
}

origins! {
    SAFETY: law "(p_limit/p)³ = Q_limit/Q of the most loaded ball, p_limit = bearing.hertz_pressure_limit",
        source "H. Hertz 1881; crates/physics/src/severity.rs",
        valid "elastic contact; below 1 balls and races are dented. Hybrid bearings: the limit of steel unless another is given";
    INDENTATION: law "5.25e-19 Pa⁻² (Q/D²)² (1 − 1/(2f))/(1 ∓ γ) D of the largest ball load, the deeper race; ball and race together",
        source "Palmgren (from memory: check before quoting); crates/physics/src/severity.rs",
        valid "1e-5 to 1e-3 of D, 58 HRC and more, slow loading: impacts leave less; dents are not added up";
    pub(crate) INDENTATION_INDEX: law "1/ball_load_safety: load of the most loaded ball over the load that dents",
        source "definition; H. Hertz 1881",
        valid "1 is the limit; impacts dent less than loads at rest";
    pub(crate) HEAT_INDEX: law "inner_race_rise_without_cooling over 100 K",
        source "rings keep their size up to 120 °C (NTN, NSK, Timken)",
        valid "1 is the limit of common rings that start at 20 °C";
    pub(crate) BLOWS: law "Σ max(0, N/W − 1) over all contacts, N the largest force of each, W the share of the weight on this bearing",
        source "definition; 0 for a rotor that lies still",
        valid "compares drops of one machine; it is no limit by itself";
    pub(crate) RISE: law "half of the heats at bore and inner groove over 460 J/(kg K) times bearing.inner_race_mass",
        source "crates/simulate/src/bearing/severity.rs; steel 450 to 480 J/(kg K)",
        valid "mean of a race that is not cooled, steel, runs longer than 0.1 s; surfaces are hotter. A rotor that slides fast takes more than \
            half. The steady moment, clearance and viscosity do not follow it";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotor_that_lies_still_gives_no_blows() {
        assert_eq!(blows([80.0, 100.0].into_iter(), 100.0), Ok(0.0));
        assert_eq!(blows([150.0, 300.0].into_iter(), 100.0), Ok(2.5));
    }
}
