//! Checks of how the rings sit.

use crate::bearing::Bearing;
use crate::bearing::fits::{
    BORE, GROWTH, Growth, HOUSING, HOUSING_FIT, OPERATING, OUTSIDE, SHAFT_BORE, SHAFT_FIT,
    UNMOUNTED,
};
use crate::checks::{Check, Context};
use problem::Code;

impl Context<'_> {
    /// Seats that hold each other, and fits that change what they are given for.
    pub fn fits(&self, bearing: &Bearing) -> Check {
        let (pitch, ball) = (bearing.pitch_diameter, bearing.ball_diameter);
        let shaft = bearing.fits.on_shaft(pitch - ball);
        if bearing.inner_race_growth != Growth::None && shaft.is_none() {
            return self.refuse(
                Code::MissingKey,
                BORE,
                "no value",
                format!(
                    "{GROWTH} = \"{}\" needs it: a ring from its bore to its track grows",
                    self.text(GROWTH)
                ),
            );
        }
        if let Some(fit) = shaft {
            self.nested(
                BORE,
                fit.joint_radius < fit.outside_radius,
                "less than the track of the inner race is needed: pitch_diameter - ball_diameter",
            )?;
            self.nested(
                SHAFT_BORE,
                fit.bore_radius < fit.joint_radius,
                "less than bearing.fits.bore_diameter is needed",
            )?;
        }
        if let Some(fit) = bearing.fits.in_housing(pitch + ball) {
            self.nested(
                OUTSIDE,
                fit.bore_radius < fit.joint_radius,
                "more than the track of the outer race is needed: pitch_diameter + ball_diameter",
            )?;
            self.nested(
                HOUSING,
                fit.joint_radius < fit.outside_radius,
                "more than bearing.fits.outer_diameter is needed",
            )?;
        }
        if bearing.inner_race_growth == Growth::FreeRing && bearing.fits.shaft_interference > 0.0 {
            return self.refuse(
                Code::Conflict,
                GROWTH,
                format!(
                    "\"free ring\" beside {SHAFT_FIT} = {}",
                    self.text(SHAFT_FIT)
                ),
                "\"with shaft\" is needed while a fit presses the ring",
            );
        }
        self.fits_have_an_effect(bearing)
    }

    pub(crate) fn nested(&self, path: &str, holds: bool, allowed: &str) -> Check {
        if holds {
            return Ok(());
        }
        let allowed = allowed.to_string();
        self.refuse_value(Code::BearingGeometry, path, allowed)
    }

    fn fits_have_an_effect(&self, bearing: &Bearing) -> Check {
        if bearing.unmounted_diametral_clearance.is_some() {
            return Ok(());
        }
        let holds_the_shaft = bearing.inner_race_growth == Growth::WithShaft;
        let idle = [
            (
                SHAFT_FIT,
                bearing.fits.shaft_interference != 0.0 && !holds_the_shaft,
            ),
            (HOUSING_FIT, bearing.fits.housing_interference != 0.0),
        ];
        let Some((path, _)) = idle.into_iter().find(|(_, idle)| *idle) else {
            return Ok(());
        };
        self.refuse(
            Code::UnusedKey,
            path,
            format!("{}, which has no effect", self.text(path)),
            format!("{UNMOUNTED} is needed with it: {OPERATING} is what fits have left already"),
        )
    }
}
