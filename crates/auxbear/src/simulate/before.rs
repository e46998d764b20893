//! What is known before a run: the warnings that `auxbear check` prints beside the values of the file.

use super::outcome::Warning;
use super::warnings_shared::speed_rating;
use super::{Built, Machine};

impl Machine<'_> {
    /// What the user should know before the run.
    pub fn warnings(&self) -> Vec<Warning> {
        let (rating, load) = match &self.system {
            Built::Drop(drop, _) => (
                drop.bearing.static_load_rating,
                drop.rotor.mass * drop.gravity.acceleration / f64::from(drop.rotor.planes),
            ),
            Built::SpinUp(spin_up, _) => (
                spin_up.bearing.static_load_rating,
                spin_up.radial_load.largest_until(spin_up.run.duration),
            ),
            Built::Torque(asked) => (
                asked.torque.static_load_rating,
                asked.torque.loads.iter().copied().fold(0.0, f64::max),
            ),
            Built::Rig(rig, _) => (rig.bearing.static_load_rating, rig.load.radial_load),
            Built::Signals(_) | Built::Identify(_) => (None, 0.0),
        };
        let above = rating.filter(|rating| load > *rating);
        let warning = above.map(|rating| Warning {
            code: "AB1029",
            text: format!(
                "The static radial load of {load:.0} N is {:.1} times the static load rating of {rating:.0} N: permanent \
                 dents must be expected, and the laws of contact and friction are outside their range.",
                load / rating
            ),
        });
        let rated = match &self.system {
            Built::Drop(drop, _) => speed_rating(&drop.bearing, drop.rotor.speed),
            Built::SpinUp(spin_up, _) => speed_rating(&spin_up.bearing, spin_up.target_speed()),
            Built::Rig(rig, _) => speed_rating(&rig.bearing, rig.speed),
            Built::Torque(_) | Built::Signals(_) | Built::Identify(_) => None,
        };
        warning.into_iter().chain(rated).collect()
    }
}
