//! The static equivalent load of ball bearings under combined load: P0 = X0 F_r + Y0 F_a, never less than F_r.

use crate::palmgren_factors::FactorType;
use std::fmt;

/// Y0 of single row angular contact bearings over the contact angle in degrees, with X0 = 0.5.
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

/// Why there are no factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoStaticFactors {
    /// A contact angle that a deep groove bearing does not have, degrees.
    DeepGrooveAngle(f64),
    /// A contact angle outside the table of angular contact bearings, degrees.
    AngularContactAngle(f64),
    /// A bearing type without a row here.
    Type(FactorType),
}

impl fmt::Display for NoStaticFactors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoStaticFactors::DeepGrooveAngle(degrees) => write!(
                f,
                "a deep groove bearing has no contact angle of {degrees} degrees: 5 to 45 are possible"
            ),
            NoStaticFactors::AngularContactAngle(degrees) => write!(
                f,
                "ISO 76 has factors for contact angles of 15 to 45 degrees, not for {degrees}"
            ),
            NoStaticFactors::Type(_) => write!(
                f,
                "no static equivalent load is known here for this bearing type under axial load"
            ),
        }
    }
}

impl std::error::Error for NoStaticFactors {}

/// Factors X0 and Y0 of the static equivalent load.
///
/// Formula: P0 = X0 F_r + Y0 F_a; between the rows of the table Y0 is interpolated in the angle.
///
/// - `kind`: the bearing type.
/// - `contact_angle`: rad.
///
/// Source: ISO 76 (from memory); the rows of 15°, 25° and 40° also as a maker prints them (LYC, Equivalent static load of
/// angular contact ball bearings).
///
/// Valid: single row bearings; deep groove at 5° to 45° under axial load, angular contact at 15° to 45°.
pub fn static_load_factors(
    kind: FactorType,
    contact_angle: f64,
) -> Result<(f64, f64), NoStaticFactors> {
    // without the rounding of radians, so that 15 degrees are in the table
    let degrees = (contact_angle.to_degrees() * 1e9).round() * 1e-9;
    match kind {
        FactorType::DeepGroove if (5.0..=45.0).contains(&degrees) => Ok(DEEP_GROOVE),
        FactorType::DeepGroove => Err(NoStaticFactors::DeepGrooveAngle(degrees)),
        FactorType::AngularContact => {
            let mut rows = ANGULAR_CONTACT.windows(2);
            let (low, high) = rows
                .find_map(|row| match row {
                    [low, high] if (low.0..=high.0).contains(&degrees) => Some((*low, *high)),
                    _ => None,
                })
                .ok_or(NoStaticFactors::AngularContactAngle(degrees))?;
            let share = (degrees - low.0) / (high.0 - low.0);
            Ok((0.5, low.1 + (high.1 - low.1) * share))
        }
        FactorType::AngularContactDoubleRow | FactorType::FourPointContact => {
            Err(NoStaticFactors::Type(kind))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_angles_give_their_row_and_others_lie_between() {
        for (degrees, printed) in [(15.0_f64, 0.46), (25.0, 0.38), (40.0, 0.26)] {
            let (radial, axial) =
                static_load_factors(FactorType::AngularContact, degrees.to_radians()).unwrap();
            assert!(radial == 0.5 && (axial - printed).abs() < 1e-12);
        }
        let between = static_load_factors(FactorType::AngularContact, 18_f64.to_radians()).unwrap();
        assert!((between.1 - 0.436).abs() < 1e-9);
    }

    #[test]
    fn what_has_no_row_is_refused() {
        for (kind, degrees) in [
            (FactorType::AngularContact, 14.0_f64),
            (FactorType::AngularContact, 46.0),
            (FactorType::DeepGroove, 0.0),
            (FactorType::FourPointContact, 35.0),
        ] {
            assert!(static_load_factors(kind, degrees.to_radians()).is_err());
        }
    }
}
