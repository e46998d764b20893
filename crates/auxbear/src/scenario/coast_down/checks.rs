//! Checks of a run-out.

use crate::problem::Code;
use crate::scenario::bearing::kind::BearingType;
use crate::scenario::bearing::moment::Moment;
use crate::scenario::checks::{Check, Context};
use crate::scenario::coast_down::CoastDown;

impl Context<'_> {
    pub(crate) fn coast_down(&self, run: &CoastDown) -> Check {
        self.geometry(run.ball_count, run.ball_diameter, run.pitch_diameter)?;
        self.static_rating()?;
        self.moment(&run.moment, &run.rated())?;
        let refuse = |code, path: &str, found: String, needed: &str| {
            Err(Box::new(self.problem(
                code,
                path,
                found,
                needed.to_string(),
            )))
        };
        let heat = &run.heat;
        if run.kind != BearingType::DeepGroove {
            let path = "bearing.type";
            let needed = "\"deep groove\" is needed: a run-out knows radial contacts alone, not an angle and its axial preload";
            return refuse(Code::NotModelled, path, self.text(path), needed);
        }
        if !matches!(
            run.moment,
            Moment::Palmgren {
                printed: false,
                axial_load: 0.0,
                ..
            }
        ) {
            let path = "bearing.moment.law";
            let found = self.text(path);
            let needed = "\"palmgren\" without an axial load is needed: warmth and clearance act on its two parts";
            return refuse(Code::Conflict, path, found, needed);
        }
        if run.viscosity_points.len() != 2 {
            let path = "bearing.moment.viscosity";
            let needed = "bearing.moment.viscosity_points, two temperatures with their viscosities, are needed: the lubricant warms";
            return refuse(Code::Conflict, path, self.text(path), needed);
        }
        if run.stop_speed >= run.speed.abs() {
            let path = "coast_down.stop_speed";
            let needed = format!(
                "less than rotor.speed = {} is needed",
                self.text("rotor.speed")
            );
            return refuse(Code::OutOfRange, path, self.text(path), &needed);
        }
        if heat.outer_diameter <= heat.bore_diameter {
            let path = "heat.outer_diameter";
            let needed = "more than heat.bore_diameter is needed";
            return refuse(Code::OutOfRange, path, self.text(path), needed);
        }
        if heat.surroundings.is_none() {
            let path = "heat.surroundings";
            let needed = "a conductance is needed in vacuum, where no rule of the trade holds: through the housing's flange, or by radiation (about 6 W/(m² K) of its surface between black walls at room temperature)";
            return refuse(Code::MissingKey, path, "no value".to_string(), needed);
        }
        for (path, limit) in [
            ("heat.race_limit", heat.race_limit),
            ("heat.cage_limit", heat.cage_limit),
            ("heat.lubricant_limit", heat.lubricant_limit),
        ] {
            if limit <= heat.start_temperature {
                let start = self.text("heat.start_temperature");
                let needed = format!(
                    "more than heat.start_temperature = {start} is needed: it is passed before anything turns"
                );
                return refuse(Code::OutOfRange, path, self.text(path), &needed);
            }
        }
        Ok(())
    }
}
