//! The static equivalent load of ball bearings under combined load: P0 = X0 F_r + Y0 F_a, never less than F_r.

use crate::palmgren_factors::FactorType;
use number::Real;

/// Y0 of single row angular contact bearings over the contact angle in degrees, with X0 = 0.5. Pairs, double row and
/// four-point bearings have twice of it and X0 = 1.
const ANGULAR_CONTACT: [(f64, f64); 7] = [
    (15.0, 0.46),
    (20.0, 0.42),
    (25.0, 0.38),
    (30.0, 0.33),
    (35.0, 0.29),
    (40.0, 0.26),
    (45.0, 0.22),
];
/// X0 and Y0 of single row deep groove bearings.
const DEEP_GROOVE: (f64, f64) = (0.6, 0.5);

/// Factors X0 and Y0 of the static equivalent load.
///
/// Formula: P0 = X0 F_r + Y0 F_a; between the rows of the table Y0 is interpolated in the angle.
///
/// - `kind`: the bearing type.
/// - `contact_angle`: rad; a deep groove bearing needs none.
///
/// Source: ISO 76 (from memory); a maker prints the rows of 15°, 25° and 40°, single and paired, double row bearings with
/// 0.66 (those of 30°) and four-point bearings with 0.58 (those of 35°): LYC, Equivalent static load of angular contact ball bearings.
///
/// Valid: deep groove at 5° to 45° under axial load, angular contact and four-point contact at 15° to 45°.
pub fn static_load_factors(
    kind: FactorType,
    contact_angle: Option<f64>,
) -> Result<(f64, f64), String> {
    // without the rounding of radians, so that 15 degrees are in the table
    let degrees = contact_angle.map(|angle| (angle.to_degrees() * 1e9).round() * 1e-9);
    let rows = match (kind, degrees) {
        (FactorType::DeepGroove, Some(degrees)) if !(5.0..=45.0).contains(&degrees) => {
            return Err(format!(
                "a deep groove bearing has no contact angle of {degrees} degrees: 5 to 45 are possible"
            ));
        }
        (FactorType::DeepGroove, _) => return Ok(DEEP_GROOVE),
        (FactorType::AngularContact, _) => 1.0,
        (FactorType::AngularContactDoubleRow | FactorType::FourPointContact, _) => 2.0,
    };
    let degrees = degrees
        .ok_or_else(|| format!("no contact angle under axial load is given for a {kind}"))?;
    let mut windows = ANGULAR_CONTACT.windows(2);
    let (low, high) = windows
        .find_map(|row| match row {
            [low, high] if (low.0..=high.0).contains(&degrees) => Some((*low, *high)),
            _ => None,
        })
        .ok_or_else(|| {
            format!("ISO 76 has factors for contact angles of 15 to 45 degrees, not for {degrees}")
        })?;
    let share = (degrees - low.0) / (high.0 - low.0);
    Ok((0.5 * rows, rows * (low.1 + (high.1 - low.1) * share)))
}

/// Static equivalent load of a ball bearing, N.
///
/// Formula: P0 = max(F_r, X0 F_r + Y0 F_a)
///
/// - `factors`: X0 and Y0.
/// - `radial_load`: F_r, N, not negative.
/// - `axial_load`: F_a, N, not negative.
///
/// Source: ISO 76 (from memory)
///
/// Valid: where the factors are.
#[inline(always)]
pub fn equivalent_static_load<R: Real>(factors: [R; 2], radial_load: R, axial_load: R) -> R {
    let [radial, axial] = factors;
    radial_load.max(radial * radial_load + axial * axial_load)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(kind: FactorType, degrees: f64) -> Result<(f64, f64), String> {
        static_load_factors(kind, Some(degrees.to_radians()))
    }

    #[test]
    fn printed_angles_give_their_row_and_others_lie_between() {
        for (degrees, printed) in [(15.0, 0.46), (25.0, 0.38), (40.0, 0.26)] {
            let (radial, axial) = at(FactorType::AngularContact, degrees).unwrap();
            assert!(radial == 0.5 && (axial - printed).abs() < 1e-12);
        }
        let between = at(FactorType::AngularContact, 18.0).unwrap();
        assert!((between.1 - 0.436).abs() < 1e-9);
    }

    #[test]
    fn two_rows_have_the_factors_that_a_maker_prints() {
        for (kind, degrees, printed) in [
            (FactorType::AngularContactDoubleRow, 15.0, 0.92),
            (FactorType::AngularContactDoubleRow, 25.0, 0.76),
            (FactorType::AngularContactDoubleRow, 30.0, 0.66),
            (FactorType::AngularContactDoubleRow, 40.0, 0.52),
            (FactorType::FourPointContact, 35.0, 0.58),
        ] {
            let (radial, axial) = at(kind, degrees).unwrap();
            assert!(radial == 1.0 && (axial - printed).abs() < 1e-12, "{axial}");
        }
        let deep_groove = static_load_factors(FactorType::DeepGroove, None).unwrap();
        assert_eq!(deep_groove, at(FactorType::DeepGroove, 16.7).unwrap());
    }

    #[test]
    fn what_has_no_row_is_refused() {
        for (kind, degrees) in [
            (FactorType::AngularContact, 14.0),
            (FactorType::AngularContact, 46.0),
            (FactorType::DeepGroove, 0.0),
            (FactorType::FourPointContact, 10.0),
        ] {
            assert!(at(kind, degrees).is_err());
        }
        assert!(static_load_factors(FactorType::AngularContactDoubleRow, None).is_err());
    }
}
