//! Checks of a test on a rig.

use crate::checks::{Check, Context};
use crate::rig::{RawFormat, Rig, RigPickupKind, RigProgram};
use problem::Code;

/// Most values of a raw file, in memory at the end of a run: 800 MB.
const MOST_VALUES: f64 = 1e8;

impl Context<'_> {
    pub(crate) fn rig(&self, rig: &Rig) -> Check {
        self.bearing(&rig.bearing, None, rig.load.hanging_mass.is_some())?;
        if let Some(warm) = &rig.warm {
            self.warm(warm)?;
        }
        match rig.program {
            RigProgram::SpinUp {
                engage_at,
                release_at,
                ..
            } => {
                self.in_order("rig.engage_at", engage_at, "run.duration", rig.run.duration)?;
                if let Some(release_at) = release_at {
                    self.in_order("rig.engage_at", engage_at, "rig.release_at", release_at)?;
                }
            }
            RigProgram::RepeatAfterRest {
                engage_at,
                release_at,
                engage_again_at,
                ..
            } => {
                let (first, second) = ("rig.first_release_at", "rig.engage_again_at");
                self.in_order("rig.engage_at", engage_at, first, release_at)?;
                self.in_order(first, release_at, second, engage_again_at)?;
                self.in_order(second, engage_again_at, "run.duration", rig.run.duration)?;
            }
            RigProgram::CoastDown { .. } | RigProgram::RampAndHold { .. } => {}
        }
        if matches!(rig.pickup.kind, RigPickupKind::Edges { .. })
            && rig.logger.format != RawFormat::Tdms
        {
            return self.refuse_value(
                Code::Conflict,
                "rig.logger.file",
                "\"tdms\" is needed with rig.pickup.kind = \"edges\": instants are no column beside samples",
            );
        }
        let values = rig.logger.total_rate * rig.run.duration;
        if values > MOST_VALUES {
            let path = self.blamed(&["rig.logger.total_rate", "run.duration"]);
            return self.refuse(
                Code::TooManyRows,
                path,
                format!("{}, which gives {values:.1e} values", self.text(path)),
                format!("at most {MOST_VALUES:.0e} values in a raw file are needed"),
            );
        }
        self.output(&rig.run, rig.bearing.ball_count)
    }

    /// Refuses a second instant that is not after the first.
    fn in_order(&self, first: &str, before: f64, second: &str, after: f64) -> Check {
        if before < after {
            return Ok(());
        }
        let path = self.blamed(&[second, first]);
        let needed = match path {
            p if p == first => format!("less than {second} = {} is needed", self.text(second)),
            _ => format!("more than {first} = {} is needed", self.text(first)),
        };
        self.refuse_value(Code::OutOfRange, path, needed)
    }
}
