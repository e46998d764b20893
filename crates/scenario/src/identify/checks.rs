//! Checks of what measured tests are to tell.

use crate::checks::{Check, Context};
use crate::identify::{Identify, RotorFriction};
use crate::table;
use problem::Code;

const ROTOR: &str = "identify.rotor_friction";
const ROTOR_FILE: &str = "identify.rotor_friction.file";

impl Context<'_> {
    pub(crate) fn identify(&self, identify: &Identify) -> Check {
        self.geometry(
            identify.ball_count,
            identify.ball_diameter,
            identify.pitch_diameter,
        )?;
        if let Some(twice) =
            (identify.tests.iter()).find(|test| identify.coast_downs.contains(test))
        {
            return self.refuse(
                Code::Conflict,
                "identify.tests",
                format!("{}, which is a coast-down too", twice.display()),
                "a test is either slow, and gives the steady moment, or has acceleration",
            );
        }
        match &identify.rotor_friction {
            Some(rotor) => {
                for key in ["rotor_speed", "radial_load", "bore_diameter", "inertia"] {
                    let path = table::keys().find(|k| k.section() == ROTOR && k.name() == key);
                    if let Some(path) = path {
                        self.needed(path.path, ROTOR_FILE)?;
                    }
                }
                self.rotor_contact(rotor)
            }
            None => {
                let given = table::keys()
                    .find(|key| key.section() == ROTOR && self.values.is_given(key.path));
                match given {
                    None => Ok(()),
                    Some(key) => self.refuse(
                        Code::UnusedKey,
                        key.path,
                        "a key that has no effect".to_string(),
                        format!("{ROTOR_FILE} is needed with it"),
                    ),
                }
            }
        }
    }

    /// When the rotor lies on the race.
    fn rotor_contact(&self, rotor: &RotorFriction) -> Check {
        let to = "identify.rotor_friction.to";
        if let (Some(from), Some(until)) = (rotor.from, rotor.to)
            && until <= from
        {
            let needed = "a time behind identify.rotor_friction.from is needed";
            return self.refuse_value(Code::Impossible, to, needed);
        }
        Ok(())
    }
}
