//! Checks of a spin-up.

use super::checks::{Check, Context};
use super::spin_up::{Drive, SpinUp};

impl Context<'_> {
    pub(super) fn spin_up(&self, spin_up: &SpinUp) -> Check {
        let bore = match spin_up.drive {
            Drive::SlidingRotor { bore_diameter, .. } => {
                Some(("drive.bore_diameter", bore_diameter))
            }
            Drive::Torque { .. } | Drive::Speed(_) => None,
        };
        self.bearing(&spin_up.bearing, bore)?;
        self.output(&spin_up.run, spin_up.bearing.ball_count)
    }
}
