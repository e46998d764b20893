//! Checks of a bearing that warms.

use crate::bearing::kind::BearingType;
use crate::bearing::moment::Moment;
use crate::checks::{Check, Context};
use crate::heat::{Atmosphere, Heat, Warm};
use physics::air::{LARGEST_REYNOLDS, reynolds};
use problem::Code;

impl Context<'_> {
    /// What its network needs.
    pub fn warm(&self, bearing: &Warm) -> Check {
        let heat = &bearing.heat;
        if heat.outer_diameter <= heat.bore_diameter {
            let path = "heat.outer_diameter";
            let needed = "more than heat.bore_diameter is needed";
            return self.refuse_value(Code::OutOfRange, path, needed);
        }
        if heat.surroundings.is_none() && !heat.is_open(heat.housing_emissivity) {
            let path = "heat.surroundings";
            let needed = "a conductance is needed in vacuum, where no rule of the trade holds: through the housing's flange; or heat.housing_emissivity, by which it radiates";
            let place = self.values.place("heat.atmosphere");
            let (values, needed) = (self.values, needed.to_string());
            let code = Code::MissingKey;
            return Err(values.problem(code, path, place, "no value", needed));
        }
        if heat.surroundings.is_some() && heat.housing_emissivity > 0.0 {
            let path = "heat.housing_emissivity";
            let needed = "0 is needed beside heat.surroundings, which is all that the housing gives; or leave that out";
            return self.refuse_value(Code::Conflict, path, needed);
        }
        let windage = self.values.number("rotor.windage").unwrap_or(0.0);
        if heat.atmosphere == Atmosphere::Vacuum && windage > 0.0 {
            let path = "rotor.windage";
            let needed =
                "0 is needed beside heat.atmosphere = \"vacuum\": no gas brakes the rotor there";
            return self.refuse_value(Code::Conflict, path, needed);
        }
        self.stirs(heat)?;
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
                return self.refuse_value(Code::OutOfRange, path, &needed);
            }
        }
        Ok(())
    }

    /// Refuses a rotor that stirs the gas faster than any law knows.
    fn stirs(&self, heat: &Heat) -> Check {
        let (Some(diameter), Some(pressure), None) = (
            heat.rotor_diameter.filter(|_| heat.rotor_area.is_some()),
            heat.gas_pressure,
            heat.rotor_surroundings,
        ) else {
            return Ok(());
        };
        let speeds = [
            "rotor.speed",
            "drive.rotor_speed",
            "drive.final_speed",
            "rig.speed",
        ];
        let speeds = speeds.iter().filter_map(|path| self.values.number(path));
        let speed = speeds.map(f64::abs).fold(0.0, f64::max);
        let found = match pressure > 0.0 {
            true => reynolds(diameter, speed, heat.ambient_temperature, pressure),
            false => 0.0,
        };
        if found <= LARGEST_REYNOLDS {
            return Ok(());
        }
        let needed = format!(
            "a conductance is needed: the rotor stirs gas of this pressure with a Reynolds number of {found:.1e}, and the law of a cylinder ends at {LARGEST_REYNOLDS:.1e}; 0 W/K leaves its heat to the bearings"
        );
        Err(self.values.problem(
            Code::MissingKey,
            "heat.rotor_surroundings",
            self.values.place("heat.gas_pressure"),
            "no value",
            needed,
        ))
    }

    /// What a coast-down needs to know besides: what brakes it, and how that follows warmth and clearance.
    pub fn brakes(&self, bearing: &Warm) -> Check {
        let known = match bearing.kind {
            BearingType::DeepGroove => true,
            // its angle is that of the motion before
            BearingType::AngularContact => self.values.system().falls(),
            _ => false,
        };
        if !known {
            let path = "bearing.type";
            let needed = "\"deep groove\" is needed, or after a drop \"angular contact\": a coast-down knows one row of balls";
            return self.refuse_value(Code::NotModelled, path, needed);
        }
        let angular = bearing.kind == BearingType::AngularContact;
        match bearing.moment {
            Moment::Palmgren {
                printed: false,
                axial_load,
                ..
            } if angular || axial_load == 0.0 => {}
            _ => {
                let path = "bearing.moment.law";
                let needed = "\"palmgren\" is needed, without an axial load where balls have no angle: warmth and clearance act on its two parts";
                return self.refuse_value(Code::Conflict, path, needed);
            }
        }
        if bearing.viscosity_points.len() != 2 {
            let path = "bearing.moment.viscosity";
            let needed = "bearing.moment.viscosity_points, two temperatures with their viscosities, are needed: the lubricant warms";
            return self.refuse_value(Code::Conflict, path, needed);
        }
        Ok(())
    }
}
