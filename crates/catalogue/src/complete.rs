//! What follows from the values that a bearing has. Each rule adds a value only where there is none.
//!
//! | value | rule | mark |
//! |---|---|---|
//! | `pitch_diameter` | half of bore and outer diameter | derived |
//! | `outer_groove_curvature` | as the inner groove | assumed |
//! | `inner_shoulder_diameter` | pitch diameter less 0.6 ball diameters | assumed |
//! | `dynamic_load_rating`, `static_load_rating` | of angular contact bearings: ISO 281 and ISO 76 ([`physics::rating`]) | as the balls |
//! | `cage_mass` | a share of the mass of as many steel balls: 0.25 of pressed steel, 0.15 of resin or polyamide | assumed |
//! | `mass` | of angular contact bearings: balls, cage and 0.89 of both [`Ring`]s | assumed |
//! | `inner_race_mass`, `inner_race_inertia` | [`Ring`] from bore to shoulder, 7850 kg/m³ | derived from a shoulder read, else assumed |
//!
//! Spindle bearings have counterbored shoulders, so both their rings together are lighter than the two [`Ring`]s. Where
//! the maker gives the mass of the bearing, the inner race has its share of what balls and cage leave.

use super::bearing::{Bearing, Datum, Mark, Value};
use super::ring::Ring;
use physics::kinematics::BallSet;
use physics::materials::{BEARING_STEEL, SILICON_NITRIDE, ball_mass};
use physics::rating::{RATED_GROOVES, dynamic_rating, static_rating};

/// Shoulder below the pitch circle over ball diameter. Of the 62 deep groove bearings with SKF's d1, the mean is 0.61
/// (0.47 to 0.78).
const SHOULDER_DEPTH: f64 = 0.6;
/// Cage of pressed steel over balls of steel. What SKF's masses of 46 bearings of the series 60, 62, 63 leave beside
/// rings and balls is 0.11 ± 0.12; chamfers, which no ring here has, hide about as much again.
const STEEL_CAGE: f64 = 0.25;
/// Cage of resin or polyamide over balls of steel: a somewhat thicker cage of a sixth of the density.
const LIGHT_CAGE: f64 = 0.15;
/// Rings of an angular contact bearing over two full [`Ring`]s: the mean of SNFA's 92 from 10 to 120 mm with 15 deg (0.77 to 1.19).
const COUNTERBORED: f64 = 0.89;
/// Groove of a ring whose groove is not known; it hardly matters for the mass.
const USUAL_GROOVE: f64 = 0.52;

/// Adds what follows.
pub(super) fn complete(bearing: &mut Bearing) {
    pitch(bearing);
    outer_groove(bearing);
    shoulder(bearing);
    ratings(bearing);
    cage(bearing);
    mass(bearing);
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
const KG: (f64, &str) = (1.0, "kg");
const KN: (f64, &str) = (1e3, "kN");
const ANGULAR: &str = "angular contact";

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

/// C and C0 of the balls alone: steel, as makers rate ceramic ones.
fn ratings(bearing: &mut Bearing) {
    let number = |key| bearing.number(key);
    let (Some(count), Some(ball_diameter), Some(pitch_diameter), Some(contact_angle)) = (
        number("ball_count"),
        number("ball_diameter"),
        number("pitch_diameter"),
        number("contact_angle").filter(|_| bearing.word("type") == Some(ANGULAR)),
    ) else {
        return;
    };
    let set = BallSet {
        ball_count: count as usize,
        ball_diameter,
        pitch_diameter,
        contact_angle,
    };
    let grooves = ["inner_groove_curvature", "outer_groove_curvature"].map(number);
    let assumed = ["ball_count", "ball_diameter"].iter().any(|key| {
        bearing
            .value(key)
            .is_some_and(|own| own.mark == Mark::Assumed)
    });
    let mark = match assumed {
        true => Mark::Assumed,
        false => Mark::Derived,
    };
    let [Some(inner), Some(outer)] = grooves else {
        return;
    };
    if inner <= RATED_GROOVES[0] && outer <= RATED_GROOVES[1] {
        let note = "ISO 281: b_m f_c cos^0.7 α Z^2/3 D^1.8 of the balls";
        let rating = dynamic_rating(&set);
        add(bearing, "dynamic_load_rating", rating, KN, mark, note);
    }
    let note =
        "ISO 76: Z Q cos α/5 of the balls, Q at 4200 MPa on the more stressed race (Hertz, steel)";
    let rating = static_rating(&set, [inner, outer]);
    add(bearing, "static_load_rating", rating, KN, mark, note);
}

fn cage(bearing: &mut Bearing) {
    if let (Some(count), Some(ball)) = (
        bearing.number("ball_count"),
        bearing.number("ball_diameter"),
    ) {
        let steel = bearing.word("type") != Some(ANGULAR)
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

/// The inner ring, full from bore to shoulder.
fn inner_ring(bearing: &Bearing) -> Option<Ring> {
    let number = |key| bearing.number(key);
    let ball = number("ball_diameter")?;
    let groove = number("inner_groove_curvature").unwrap_or(USUAL_GROOVE);
    Some(Ring {
        smooth_radius: 0.5 * number("bore_diameter")?,
        shoulder_radius: 0.5 * number("inner_shoulder_diameter")?,
        track_radius: 0.5 * (number("pitch_diameter")? - ball),
        groove_radius: groove * ball,
        width: number("width")?,
    })
}

/// Masses of both full rings of an angular contact bearing with balls and cage; `None` for other bearings.
fn full_rings_and_rest(bearing: &Bearing) -> Option<[f64; 2]> {
    let number = |key| bearing.number(key);
    if bearing.word("type") != Some(ANGULAR) {
        return None;
    }
    let inner = inner_ring(bearing)?;
    let (pitch, ball) = (number("pitch_diameter")?, number("ball_diameter")?);
    let outer = Ring {
        smooth_radius: 0.5 * number("outer_diameter")?,
        shoulder_radius: 0.5 * pitch + (0.5 * pitch - inner.shoulder_radius),
        track_radius: 0.5 * (pitch + ball),
        groove_radius: number("outer_groove_curvature").unwrap_or(USUAL_GROOVE) * ball,
        width: inner.width,
    };
    let rings = inner.volume_moments().0 + outer.volume_moments().0;
    let balls = number("ball_count")? * mass_of_ball(bearing, ball);
    Some([BEARING_STEEL.density * rings, balls + number("cage_mass")?])
}

fn mass(bearing: &mut Bearing) {
    if let Some([rings, rest]) = full_rings_and_rest(bearing) {
        let note = "balls, cage and 0.89 of full rings, as SNFA's spindle bearings have";
        let mass = COUNTERBORED * rings + rest;
        add(bearing, "mass", mass, KG, Mark::Assumed, note);
    }
}

fn race(bearing: &mut Bearing) {
    let Some(inner) = inner_ring(bearing) else {
        return;
    };
    let (volume, moment) = inner.volume_moments();
    let (mut mass, mut inertia) = (
        BEARING_STEEL.density * volume,
        BEARING_STEEL.density * moment,
    );
    let assumed = bearing
        .value("inner_shoulder_diameter")
        .is_some_and(|value| value.mark == Mark::Assumed);
    let (mark, note) = if let (true, Some(share)) = (assumed, counterbore(bearing)) {
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

/// What an angular contact bearing's mass leaves for its rings, over the mass of the full rings; `None` for other bearings.
fn counterbore(bearing: &Bearing) -> Option<f64> {
    let [full, rest] = full_rings_and_rest(bearing)?;
    let share = (bearing.number("mass")? - rest) / full;
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
