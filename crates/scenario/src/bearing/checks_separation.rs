//! Checks of what keeps the balls apart, and of contacts at an angle.

use crate::bearing::Bearing;
use crate::bearing::kind::Fidelity;
use crate::bearing::separation::{Cage, Guidance, Separation};
use crate::checks::{Check, Context};
use catalogue::geometry::millimetres;
use physics::angular_contact::preload_interference;
use problem::Code;
use std::f64::consts::PI;

/// Fewest balls in a row without a cage: two would touch each other twice.
const FEWEST_NEIGHBOURS: usize = 3;

/// Widest radial clearance of a land, as a share of the ball diameter.
const WIDEST_LAND: f64 = 0.2;
/// Widest contact angle: 60 degrees.
const WIDEST_ANGLE: f64 = std::f64::consts::FRAC_PI_3;
/// Most radial interference of an axial preload, as a share of the ball diameter: beyond, no elastic law holds.
const MOST_INTERFERENCE: f64 = 0.005;

impl Context<'_> {
    /// Pockets that end before the next ball, and a cage that something holds.
    fn pockets(&self, bearing: &Bearing, cage: &Cage) -> Check {
        let most = 0.5 * bearing.gap_between_balls();
        if bearing.ball_count >= FEWEST_NEIGHBOURS && cage.pocket_gap > most {
            let path = "bearing.cage.pocket_gap";
            return self.refuse_value(
                Code::BearingGeometry,
                path,
                format!(
                    "at most {} is possible: half of what the balls leave between each other",
                    millimetres(most.max(0.0))
                ),
            );
        }
        if !cage.pocket_contact && cage.guidance != Guidance::Centred {
            return self.refuse(
                Code::Conflict,
                "bearing.cage.pocket_contact",
                "false",
                "true is needed for a cage that is free to move: nothing else would turn it",
            );
        }
        Ok(())
    }

    /// Lands between the tracks, and rows of balls that fit and do not fall apart.
    pub fn separation(&self, bearing: &Bearing) -> Check {
        let refuse =
            |code: Code, path: &str, allowed: String| self.refuse_value(code, path, allowed);
        let (pitch, ball) = (bearing.pitch_diameter, bearing.ball_diameter);
        match &bearing.separation {
            Separation::FullComplement(_) => {
                let count = "bearing.ball_count";
                if bearing.ball_count < FEWEST_NEIGHBOURS {
                    let allowed =
                        format!("at least {FEWEST_NEIGHBOURS} balls are needed without a cage");
                    return refuse(Code::Impossible, count, allowed);
                }
                if bearing.gap_between_balls() < 0.0 {
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
                self.pockets(bearing, cage)?;
                let (land, within) = match cage.guidance {
                    Guidance::Centred | Guidance::Balls => return Ok(()),
                    Guidance::InnerLand(land) => {
                        (land, land.diameter < pitch && land.diameter > pitch - ball)
                    }
                    Guidance::OuterLand(land) => {
                        (land, land.diameter > pitch && land.diameter < pitch + ball)
                    }
                };
                if !within {
                    let (low, high) = match cage.guidance {
                        Guidance::InnerLand(_) => (pitch - ball, pitch),
                        _ => (pitch, pitch + ball),
                    };
                    let allowed = format!(
                        "a land between the track and the circle of the ball centres is needed: {} to {}",
                        millimetres(low),
                        millimetres(high)
                    );
                    return refuse(Code::BearingGeometry, "bearing.cage.land_diameter", allowed);
                }
                if land.radial_clearance > WIDEST_LAND * ball {
                    let allowed = format!(
                        "at most {}, a fifth of a ball, is possible: clearances of lands are tenths of a millimetre, and radial",
                        millimetres(WIDEST_LAND * ball)
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

    /// An angle that is none, and a preload that presses past any elastic law or beside a clearance.
    pub fn contact_angle(&self, bearing: &Bearing) -> Check {
        const PRELOAD: &str = "bearing.axial_preload";
        const ANGLE: &str = "bearing.contact_angle";
        if bearing.contact_angle > WIDEST_ANGLE {
            return self.refuse_value(
                Code::OutOfRange,
                ANGLE,
                "an angle from 0 to 60 deg is needed",
            );
        }
        if bearing.axial_preload == 0.0 {
            return Ok(());
        }
        let refuse =
            |code, found: String, allowed: &str| self.refuse(code, PRELOAD, found, allowed);
        if bearing.contact_angle == 0.0 {
            let allowed = "bearing.contact_angle above 0 is needed with it: balls without an angle carry no axial load here";
            return refuse(Code::Conflict, self.text(PRELOAD), allowed);
        }
        if bearing.operating_diametral_clearance != 0.0 {
            let found = format!(
                "{} beside a clearance of {}",
                self.text(PRELOAD),
                millimetres(bearing.operating_diametral_clearance)
            );
            let allowed = "one of both is needed: an axial preload takes all play away, and says what the fits have left";
            return refuse(Code::Conflict, found, allowed);
        }
        let soft = |k: Option<f64>| k.map_or(0.0, |k| k.powf(-2.0 / 3.0));
        let series = (soft(bearing.inner_contact_stiffness)
            + soft(bearing.outer_contact_stiffness))
        .powf(-1.5);
        let interference = preload_interference(
            bearing.axial_preload,
            bearing.ball_count,
            series,
            bearing.contact_angle,
        );
        if interference > MOST_INTERFERENCE * bearing.ball_diameter {
            let found = format!(
                "{}, which presses the balls by {} each",
                self.text(PRELOAD),
                millimetres(interference)
            );
            return refuse(
                Code::OutOfRange,
                found,
                "less preload, or a larger contact angle, is needed: at most half a per cent of the ball diameter",
            );
        }
        Ok(())
    }
}
