//! What is known before a run: the warnings that `auxbear check` prints beside the values of the file.

use crate::known::{above_the_rating, of_bearing, of_drop, of_values};
use crate::{Machine, Model};
use outcome::Warning;
use scenario::CoastingBearing;
use simulate::rig::warnings::preload_of_rig;
use simulate::spin_up::warnings::preload_of_spin_up;

impl Machine<'_> {
    /// What the user should know before the run.
    pub fn warnings(&self) -> Vec<Warning> {
        of_values(self.scenario).chain(self.of_system()).collect()
    }

    fn of_system(&self) -> Vec<Warning> {
        match &self.system {
            Model::Drop(built, _) => of_drop(&built.drop),
            Model::SpinUp(spin_up, _) => {
                let load = spin_up.radial_load.largest_until(spin_up.run.duration);
                let mut list = of_bearing("", &spin_up.bearing, load, spin_up.target_speed());
                list.extend(preload_of_spin_up(&spin_up.bearing, load));
                list
            }
            Model::Torque(asked) => {
                let load = asked.torque.loads.iter().copied().fold(0.0, f64::max);
                above_the_rating(asked.torque.static_load_rating, load)
                    .into_iter()
                    .collect()
            }
            Model::Rig(rig, _) => {
                let mut list = of_bearing("", &rig.bearing, rig.load.radial_load, rig.speed);
                list.extend(preload_of_rig(rig));
                list
            }
            Model::CoastDown(run, _) => {
                let of = |own: &CoastingBearing| {
                    let found =
                        above_the_rating(own.warm.static_load_rating, own.warm.radial_load)?;
                    Some(found.of_part(&own.name))
                };
                run.bearings.iter().filter_map(of).collect()
            }
            Model::Signals(_) | Model::Identify(_) | Model::Rotor(_) => Vec::new(),
        }
    }
}
