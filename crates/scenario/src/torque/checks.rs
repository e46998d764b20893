//! Checks of where the torque is computed.

use crate::checks::{Check, Context};
use crate::torque::Torque;
use problem::Code;

impl Context<'_> {
    pub(crate) fn torque(&self, torque: &Torque) -> Check {
        let (ball, pitch) = (torque.ball_diameter, torque.pitch_diameter);
        self.geometry(torque.ball_count, ball, pitch)?;
        self.static_rating()?;
        self.moment(&torque.moment, &torque.rated())?;
        self.acceleration_loss(&torque.acceleration_loss)?;
        self.torque_points(torque)
    }

    fn torque_points(&self, torque: &Torque) -> Check {
        if torque.speed_to <= torque.speed_from {
            let path = "torque.speed_to";
            return self.refuse_value(
                Code::OutOfRange,
                path,
                format!(
                    "more than torque.speed_from = {} is needed",
                    self.text("torque.speed_from")
                ),
            );
        }
        let unused = |path: &str, needed: &str| {
            let found = format!("{}, which has no effect", self.text(path));
            self.refuse(Code::UnusedKey, path, found, needed)
        };
        if !torque.lubricants.is_empty() && torque.moment.viscosity().is_none() {
            return unused(
                "torque.lubricants",
                "a law with a viscosity is needed: bearing.moment.law = \"palmgren\" or \"palmgren printed\" or \"skf\"",
            );
        }
        if !torque.temperatures.is_empty() && torque.lubricants.is_empty() {
            return unused(
                "torque.temperatures",
                "torque.lubricants or bearing.moment.viscosity_points are needed with it; a given viscosity holds as it is",
            );
        }
        Ok(())
    }
}
