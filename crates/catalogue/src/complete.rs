//! What follows from the values that a bearing has. Each rule adds a value only where there is none.
//!
//! | value | rule | mark |
//! |---|---|---|
//! | `pitch_diameter` | half of bore and outer diameter | derived |
//! | `outer_groove_curvature` | as the inner groove | assumed |
//! | `inner_shoulder_diameter` | pitch diameter less 0.6 ball diameters | assumed |
//! | `cage_mass` | a share of the mass of as many steel balls: 0.25 of pressed steel, 0.15 of resin or polyamide | assumed |
//! | `inner_race_mass`, `inner_race_inertia` | [`Ring`] from bore to shoulder, 7850 kg/m³ | derived from a shoulder read, else assumed |
//!
//! Spindle bearings have counterbored shoulders, so both their rings together are lighter than the two [`Ring`]s. Where
//! the maker gives the mass of the bearing, the inner race has its share of what balls and cage leave.

use super::bearing::{Bearing, Datum, Mark, Value};
use super::ring::Ring;
use physics::materials::{BEARING_STEEL, SILICON_NITRIDE, ball_mass};

/// Shoulder below the pitch circle over ball diameter. Of the 62 deep groove bearings with SKF's d1, the mean is 0.61
/// (0.47 to 0.78).
const SHOULDER_DEPTH: f64 = 0.6;
/// Cage of pressed steel over balls of steel. What SKF's masses of 46 bearings of the series 60, 62, 63 leave beside
/// rings and balls is 0.11 ± 0.12; chamfers, which no ring here has, hide about as much again.
const STEEL_CAGE: f64 = 0.25;
/// Cage of resin or polyamide over balls of steel: a somewhat thicker cage of a sixth of the density.
const LIGHT_CAGE: f64 = 0.15;
/// Groove of a ring whose groove is not known; it hardly matters for the mass.
const USUAL_GROOVE: f64 = 0.52;

/// Adds what follows.
pub(super) fn complete(bearing: &mut Bearing) {
    pitch(bearing);
    outer_groove(bearing);
    shoulder(bearing);
    cage(bearing);
    race(bearing);
}

fn add(bearing: &mut Bearing, key: &str, value: f64, unit: (f64, &str), mark: Mark, note: &str) {
    if bearing.value(key).is_some() || !value.is_finite() || value <= 0.0 {
        return;
    }
    // The text is the value, with no more digits than it deserves.
    let scaled = value / unit.0;
    let digits = if mark == Mark::Assumed { 2 } else { 4 };
    let shown: f64 = format!("{scaled:.digits$e}").parse().unwrap_or(scaled);
    let number = units::number_text(shown);
    let text = format!("{number} {}", unit.1).trim_end().to_string();
    bearing.values.push(Value {
        key: key.to_string(),
        datum: Datum::Number {
            si: shown * unit.0,
            text,
        },
        mark,
        note: note.to_string(),
    });
}

const MM: (f64, &str) = (1e-3, "mm");
const G: (f64, &str) = (1e-3, "g");

fn pitch(bearing: &mut Bearing) {
    if let (Some(bore), Some(outside)) = (
        bearing.number("bore_diameter"),
        bearing.number("outer_diameter"),
    ) {
        let note = "half of bore and outer diameter";
        let pitch = 0.5 * (bore + outside);
        add(bearing, "pitch_diameter", pitch, MM, Mark::Derived, note);
    }
}

fn outer_groove(bearing: &mut Bearing) {
    let key = "outer_groove_curvature";
    if let (Some(inner), None) = (bearing.value("inner_groove_curvature"), bearing.value(key)) {
        let outer = Value {
            key: key.to_string(),
            datum: inner.datum.clone(),
            mark: Mark::Assumed,
            note: "as the inner groove".to_string(),
        };
        bearing.values.push(outer);
    }
}

fn shoulder(bearing: &mut Bearing) {
    if let (Some(pitch), Some(ball)) = (
        bearing.number("pitch_diameter"),
        bearing.number("ball_diameter"),
    ) {
        let note = "pitch diameter less 0.6 ball diameters; 0.61 is the mean of SKF's deep groove bearings";
        let shoulder = pitch - SHOULDER_DEPTH * ball;
        let key = "inner_shoulder_diameter";
        add(bearing, key, shoulder, MM, Mark::Assumed, note);
    }
}

fn cage(bearing: &mut Bearing) {
    if let (Some(count), Some(ball)) = (
        bearing.number("ball_count"),
        bearing.number("ball_diameter"),
    ) {
        let steel = bearing.word("type") != Some("angular contact")
            && bearing.word("ball_material") != Some("silicon nitride");
        let (share, note) = if steel {
            (
                STEEL_CAGE,
                "a quarter of the mass of the balls: pressed steel",
            )
        } else {
            (
                LIGHT_CAGE,
                "0.15 of the mass of as many steel balls: resin or polyamide",
            )
        };
        let mass = share * count * ball_mass(ball, BEARING_STEEL.density);
        add(bearing, "cage_mass", mass, G, Mark::Assumed, note);
    }
}

fn race(bearing: &mut Bearing) {
    let number = |key| bearing.number(key);
    let (Some(bore), Some(pitch), Some(ball), Some(shoulder), Some(width)) = (
        number("bore_diameter"),
        number("pitch_diameter"),
        number("ball_diameter"),
        number("inner_shoulder_diameter"),
        number("width"),
    ) else {
        return;
    };
    let groove = number("inner_groove_curvature").unwrap_or(USUAL_GROOVE);
    let inner = Ring {
        smooth_radius: 0.5 * bore,
        shoulder_radius: 0.5 * shoulder,
        track_radius: 0.5 * (pitch - ball),
        groove_radius: groove * ball,
        width,
    };
    let (volume, moment) = inner.volume_moments();
    let (mut mass, mut inertia) = (
        BEARING_STEEL.density * volume,
        BEARING_STEEL.density * moment,
    );
    let assumed = bearing
        .value("inner_shoulder_diameter")
        .is_some_and(|value| value.mark == Mark::Assumed);
    let (mark, note) = if let (true, Some(share)) = (assumed, counterbore(bearing, &inner, mass)) {
        mass *= share;
        inertia *= share;
        (
            Mark::Assumed,
            "its share of what balls and cage leave of the bearing's mass; no sleeve",
        )
    } else if assumed {
        (
            Mark::Assumed,
            "cylinder from bore to the assumed shoulder less groove, 7850 kg/m³; no sleeve",
        )
    } else {
        (
            Mark::Derived,
            "cylinder from bore to shoulder less groove, 7850 kg/m³; no sleeve",
        )
    };
    add(bearing, "inner_race_mass", mass, G, mark, note);
    let unit = (1.0, "kg m^2");
    add(bearing, "inner_race_inertia", inertia, unit, mark, note);
}

/// What a spindle bearing's mass leaves for its rings, over the mass of the full rings; `None` for other bearings.
fn counterbore(bearing: &Bearing, inner: &Ring, inner_mass: f64) -> Option<f64> {
    if bearing.word("type") != Some("angular contact") {
        return None;
    }
    let pitch = bearing.number("pitch_diameter")?;
    let ball = bearing.number("ball_diameter")?;
    let groove = bearing
        .number("outer_groove_curvature")
        .unwrap_or(USUAL_GROOVE);
    let outer = Ring {
        smooth_radius: 0.5 * bearing.number("outer_diameter")?,
        shoulder_radius: 0.5 * pitch + (0.5 * pitch - inner.shoulder_radius),
        track_radius: 0.5 * (pitch + ball),
        groove_radius: groove * ball,
        width: inner.width,
    };
    let full = inner_mass + BEARING_STEEL.density * outer.volume_moments().0;
    let balls = bearing.number("ball_count")? * mass_of_ball(bearing, ball);
    let rings = bearing.number("mass")? - balls - bearing.number("cage_mass")?;
    let share = rings / full;
    (0.5..1.0).contains(&share).then_some(share)
}

/// Mass of one ball of the bearing's material; steel where none is named.
pub(super) fn mass_of_ball(bearing: &Bearing, diameter: f64) -> f64 {
    let density = match bearing.word("ball_material") {
        Some("silicon nitride") => SILICON_NITRIDE.density,
        _ => BEARING_STEEL.density,
    };
    bearing
        .number("ball_mass")
        .unwrap_or_else(|| ball_mass(diameter, density))
}
