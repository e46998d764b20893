//! Checks of a run-out.

use crate::problem::Code;
use crate::scenario::checks::{Check, Context};
use crate::scenario::coast_down::CoastDown;

impl Context<'_> {
    pub(crate) fn coast_down(&self, run: &CoastDown) -> Check {
        let bearing = &run.bearing;
        self.geometry(
            bearing.ball_count,
            bearing.ball_diameter,
            bearing.pitch_diameter,
        )?;
        self.static_rating()?;
        self.moment(&bearing.moment, &bearing.rated())?;
        self.brakes(bearing)?;
        if run.end.stop_speed >= run.speed.abs() {
            let path = "coast_down.stop_speed";
            let needed = format!(
                "less than rotor.speed = {} is needed",
                self.text("rotor.speed")
            );
            return Err(Box::new(self.problem(
                Code::OutOfRange,
                path,
                self.text(path),
                needed,
            )));
        }
        self.warm(bearing)
    }
}
