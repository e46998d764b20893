//! Checks of what keeps the balls apart, and of contacts at an angle.

use super::bearing::{Bearing, Fidelity};
use super::checks::{Check, Context};
use super::separation::{Guidance, Separation};
use crate::catalogue::geometry::millimetres;
use crate::problem::Code;
use std::f64::consts::PI;

/// Fewest balls in a row without a cage: two would touch each other twice.
const FEWEST_NEIGHBOURS: usize = 3;

impl Context<'_> {
    /// Lands between the tracks, and rows of balls that fit and do not fall apart.
    pub(super) fn separation(&self, bearing: &Bearing) -> Check {
        let refuse = |code: Code, path: &str, allowed: String| {
            Err(Box::new(self.problem(code, path, self.text(path), allowed)))
        };
        let (pitch, ball) = (bearing.pitch_diameter, bearing.ball_diameter);
        match &bearing.separation {
            Separation::FullComplement(_) => {
                let chord = pitch * (PI / bearing.ball_count as f64).sin();
                let count = "bearing.ball_count";
                if bearing.ball_count < FEWEST_NEIGHBOURS {
                    let allowed =
                        format!("at least {FEWEST_NEIGHBOURS} balls are needed without a cage");
                    return refuse(Code::Impossible, count, allowed);
                }
                if chord < ball {
                    let most = (PI / (ball / pitch).asin()).floor();
                    let allowed = format!(
                        "at most {most} balls of {} fit on a pitch circle of {}",
                        millimetres(ball),
                        millimetres(pitch)
                    );
                    return refuse(Code::BearingGeometry, count, allowed);
                }
                if bearing.drag.cage != 0.0 {
                    let path = "bearing.drag.cage";
                    return refuse(Code::Conflict, path, "no drag of a cage is possible where bearing.separation = \"full complement\"".to_string());
                }
                Ok(())
            }
            Separation::Cage(cage) => {
                let path = "bearing.cage.guidance";
                if bearing.fidelity == Fidelity::Rolling && cage.guidance != Guidance::Centred {
                    let allowed = "\"centred\" is needed where bearing.fidelity = \"rolling\", whose cage has no place of its own".to_string();
                    return refuse(Code::Conflict, path, allowed);
                }
                let (land, within) = match cage.guidance {
                    Guidance::Centred | Guidance::Balls => return Ok(()),
                    Guidance::InnerLand(land) => {
                        (land, land.diameter < pitch && land.diameter > 0.0)
                    }
                    Guidance::OuterLand(land) => (land, land.diameter > pitch),
                };
                if !within {
                    let side = if land.diameter > pitch {
                        "less"
                    } else {
                        "more"
                    };
                    let allowed = format!(
                        "{side} than the pitch diameter, {}, is needed for this guidance",
                        millimetres(pitch)
                    );
                    return refuse(Code::BearingGeometry, "bearing.cage.land_diameter", allowed);
                }
                if land.radial_clearance > 0.5 * ball {
                    let allowed = format!(
                        "at most half a ball diameter, {}, is possible: clearances of lands are tenths of a millimetre, and radial",
                        millimetres(0.5 * ball)
                    );
                    return refuse(
                        Code::ClearanceTooLarge,
                        "bearing.cage.land_radial_clearance",
                        allowed,
                    );
                }
                Ok(())
            }
        }
    }

    /// An angle without a preload, or a preload without an angle.
    pub(super) fn contact_angle(&self, bearing: &Bearing) -> Check {
        let path = "bearing.axial_preload";
        if bearing.axial_preload > 0.0 && bearing.contact_angle == 0.0 {
            return Err(Box::new(self.problem(
                Code::Conflict,
                path,
                self.text(path),
                "bearing.contact_angle above 0 is needed with it: balls without an angle carry no axial load here".to_string(),
            )));
        }
        Ok(())
    }
}
