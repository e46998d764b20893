//! Load ratings C and C0 that the standards give one row of balls of known number and size.

use crate::hertz::{BallRace, PointContact, Race};
use crate::kinematics::BallSet;
use crate::materials::{BEARING_STEEL, contact_modulus};

/// Grooves that ISO 281 and ISO 76 rate: radius over ball diameter, inner and outer race, at most.
pub const RATED_GROOVES: [f64; 2] = [0.52, 0.53];
/// Largest pressure of a ball at C0, Pa.
const STATIC_PRESSURE: f64 = 4.2e9;
/// Load of the most loaded ball over the mean load Q/Z of a radially loaded row.
const LOAD_SHARE: f64 = 5.0;
/// b_m of deep groove and angular contact bearings.
const MATERIAL: f64 = 1.3;
/// Ball diameter from which C grows with D^1.4 rather than D^1.8, mm, and the factor that joins both there.
const LARGE_BALL: f64 = 25.4;
const LARGE_BALL_FACTOR: f64 = 3.647;

/// Basic dynamic load rating of one row of balls, N.
///
/// Formula: C = b_m f_c cos^0.7 α Z^⅔ D^1.8, above 25.4 mm 3.647 D^1.4 for D^1.8; D in mm, b_m = 1.3, γ = D cos α/d_m,
/// f_c = 38.2 {1 + [1.04 ((1 − γ)/(1 + γ))^1.72]^(10/3)}^−0.3 · γ^0.3 (1 − γ)^1.39/(1 + γ)^⅓ · (2f/(2f − 1))^0.41, f = 0.52
///
/// - `set`: balls, pitch circle and nominal contact angle of the row.
///
/// Source: ISO 281 (from memory); 38.2 gives its table of f_c to 0.1 %.
/// Valid: one row, grooves of at most [`RATED_GROOVES`], 0.05 ≤ γ ≤ 0.36.
pub fn dynamic_rating(set: &BallSet) -> f64 {
    let cosine = set.contact_angle.cos();
    let gamma = set.ball_diameter * cosine / set.pitch_diameter;
    let d = 1e3 * set.ball_diameter;
    let size = match d <= LARGE_BALL {
        true => d.powf(1.8),
        false => LARGE_BALL_FACTOR * d.powf(1.4),
    };
    let count = (set.ball_count as f64).powf(2.0 / 3.0);
    MATERIAL * geometry_factor(gamma) * cosine.powf(0.7) * count * size
}

fn geometry_factor(gamma: f64) -> f64 {
    let f = RATED_GROOVES[0];
    let races = 1.04 * ((1.0 - gamma) / (1.0 + gamma)).powf(1.72);
    38.2 * (1.0 + races.powf(10.0 / 3.0)).powf(-0.3) * gamma.powf(0.3) * (1.0 - gamma).powf(1.39)
        / (1.0 + gamma).cbrt()
        * (2.0 * f / (2.0 * f - 1.0)).powf(0.41)
}

/// Basic static load rating of one row of steel balls, N; 0 of grooves that make no point contact.
///
/// Formula: C0 = Z Q cos α/5, Q the load under which the more stressed of both races reaches 4200 MPa (Hertz)
///
/// - `set`: balls, pitch circle and nominal contact angle of the row.
/// - `grooves`: radius over ball diameter, inner and outer race.
///
/// Source: ISO 76 (from memory), whose f0 it gives to 2 % with [`RATED_GROOVES`].
/// Valid: one row, 0° ≤ α ≤ 45°.
pub fn static_rating(set: &BallSet, grooves: [f64; 2]) -> f64 {
    let load = |race: Race, groove_curvature: f64| {
        let contact = BallRace {
            ball_diameter: set.ball_diameter,
            pitch_diameter: set.pitch_diameter,
            groove_curvature,
            contact_angle: set.contact_angle,
            race,
        };
        let modulus = contact_modulus(BEARING_STEEL, BEARING_STEEL);
        let contact = PointContact::new(contact.curvature(), modulus);
        contact.map_or(0.0, |own| own.load_at_pressure(STATIC_PRESSURE))
    };
    let load = load(Race::Inner, grooves[0]).min(load(Race::Outer, grooves[1]));
    set.ball_count as f64 * load * set.contact_angle.cos() / LOAD_SHARE
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of the standards' tables, from memory: γ, f_c without b_m, f0. That they give the ratings makers print of
    /// a hundred bearings is checked beside the catalogue.
    const TABLE: [(f64, f64, f64); 11] = [
        (0.05, 46.7, 15.7),
        (0.07, 51.1, 16.1),
        (0.09, 54.3, 16.5),
        (0.1, 55.5, 16.4),
        (0.12, 57.5, 15.9),
        (0.14, 58.8, 15.4),
        (0.16, 59.6, 14.9),
        (0.2, 59.9, 14.0),
        (0.24, 59.0, 13.0),
        (0.3, 56.0, 11.6),
        (0.36, 51.7, 10.3),
    ];

    fn set(gamma: f64, contact_angle: f64) -> BallSet {
        BallSet {
            ball_count: 12,
            ball_diameter: 8e-3,
            pitch_diameter: 8e-3 * contact_angle.cos() / gamma,
            contact_angle,
        }
    }

    #[test]
    fn both_ratings_are_those_of_the_tables() {
        for (gamma, fc, f0) in TABLE {
            for degrees in [0.0_f64, 25.0, 40.0] {
                let set = set(gamma, degrees.to_radians());
                let cosine = set.contact_angle.cos();
                let c = 1.3 * fc * cosine.powf(0.7) * 12_f64.powf(2.0 / 3.0) * 8_f64.powf(1.8);
                // f_c has three printed digits
                let ours = dynamic_rating(&set);
                assert!((ours / c - 1.0).abs() < 2e-3, "γ {gamma}: C {ours} {c}");
                // f0 is printed to three digits of older elastic constants and of f_e = 0.53 throughout
                let c0 = f0 * 12.0 * 64.0 * cosine;
                let ours = static_rating(&set, RATED_GROOVES);
                assert!((ours / c0 - 1.0).abs() < 2e-2, "γ {gamma}: C0 {ours} {c0}");
            }
        }
    }

    #[test]
    fn a_closer_groove_bears_more_and_both_forms_of_c_meet_at_an_inch() {
        let own = set(0.15, 0.0);
        assert!(static_rating(&own, [0.515, 0.52]) > static_rating(&own, RATED_GROOVES));
        assert_eq!(static_rating(&own, [0.4, 0.53]), 0.0);
        let at = |ball_diameter: f64| BallSet {
            ball_diameter,
            pitch_diameter: ball_diameter / 0.15,
            ..own
        };
        let jump = dynamic_rating(&at(25.401e-3)) / dynamic_rating(&at(25.4e-3));
        // the standard's 3.647 is 25.4^0.4 to four digits
        assert!((jump - 1.0).abs() < 3e-4, "{jump}");
    }
}
