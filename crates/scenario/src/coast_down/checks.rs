//! Checks of a coast-down.

use crate::bearing::fits::SHAFT_BORE;
use crate::checks::{Check, Context};
use crate::coast_down::{CoastDown, CoastingBearing};
use crate::values::Values;
use problem::Code;

const LOAD: &str = "coast_down.radial_load";

impl Context<'_> {
    pub(crate) fn coast_down(&self, run: &CoastDown, all: &[Values]) -> Check {
        if run.end.stop_speed >= run.speed.abs() {
            let path = "coast_down.stop_speed";
            let needed = format!(
                "less than rotor.speed = {} is needed",
                self.text("rotor.speed")
            );
            return self.refuse_value(Code::OutOfRange, path, needed);
        }
        self.planes()?;
        let own = |values: &&Values| !values.is_derived(LOAD);
        if let Some(other) = all.iter().find(|values| !own(values))
            && all.iter().any(|values| own(&values))
        {
            let needed = "a load for each bearing is needed where one has its own";
            return other.refuse(Code::MissingKey, LOAD, "no value", needed);
        }
        for (bearing, values) in run.bearings.iter().zip(all) {
            let own = Context { values, ..*self };
            own.coasting(bearing)?;
        }
        Ok(())
    }

    fn coasting(&self, of: &CoastingBearing) -> Check {
        let bearing = &of.warm;
        self.geometry(
            bearing.ball_count,
            bearing.ball_diameter,
            bearing.pitch_diameter,
        )?;
        self.static_rating()?;
        self.moment(&bearing.moment, &bearing.rated())?;
        self.brakes(bearing)?;
        let (track, bore) = (
            bearing.pitch_diameter - bearing.ball_diameter,
            bearing.heat.bore_diameter,
        );
        let air = bearing.heat.radial_air_clearance.unwrap_or(0.0);
        let needed =
            "less than the track of the inner race is needed: pitch_diameter - ball_diameter";
        self.nested("heat.bore_diameter", bore < track, needed)?;
        let needed = "less than heat.bore_diameter is needed";
        self.nested(SHAFT_BORE, of.shaft_bore_diameter < bore, needed)?;
        let needed = "less than half of heat.bore_diameter is needed";
        self.nested("heat.radial_air_clearance", air < 0.5 * bore, needed)?;
        self.warm(bearing)
    }
}
