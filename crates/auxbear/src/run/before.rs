//! What is known before a run: the warnings that `auxbear check` prints beside the values of the file.

use crate::result::assumptions::speed_rating;
use crate::result::outcome::{Warning, warning};
use crate::run::{Built, Machine};
use crate::scenario::{AuxiliaryBearing, Bearing, Drop};
use crate::simulate::bearing::warnings::preload_left;
use crate::simulate::rig::warnings::preload_of_rig;
use crate::simulate::spin_up::warnings::preload_of_spin_up;

/// Product of eccentricity and speed of drive shafts of cars, G 16, m/s.
const LARGEST_GRADE: f64 = 16e-3;

impl Machine<'_> {
    /// What the user should know before the run.
    pub fn warnings(&self) -> Vec<Warning> {
        let notes = self.scenario.notes.iter();
        let of_values = notes.map(|note| warning(note.code, note.text.clone()));
        of_values.chain(self.of_system()).collect()
    }

    fn of_system(&self) -> Vec<Warning> {
        match &self.system {
            Built::Drop(drop, ..) => {
                let parts = drop.auxiliary_bearings.iter().enumerate();
                let of_part = |(k, part): (usize, &AuxiliaryBearing)| {
                    let Some(bearing) = &part.bearing else {
                        return Vec::new();
                    };
                    let load = drop.weight(k);
                    let mut list = of_bearing(&part.name, bearing, load, drop.rotor.speed);
                    list.extend(preload_left(&part.name, bearing, ("weight", load), None));
                    list
                };
                unbalance_grade(drop)
                    .into_iter()
                    .chain(parts.flat_map(of_part))
                    .collect()
            }
            Built::SpinUp(spin_up, _) => {
                let load = spin_up.radial_load.largest_until(spin_up.run.duration);
                let mut list = of_bearing("", &spin_up.bearing, load, spin_up.target_speed());
                list.extend(preload_of_spin_up(&spin_up.bearing, load));
                list
            }
            Built::Torque(asked) => {
                let load = asked.torque.loads.iter().copied().fold(0.0, f64::max);
                above_the_rating(asked.torque.static_load_rating, load)
                    .into_iter()
                    .collect()
            }
            Built::Rig(rig, _) => {
                let mut list = of_bearing("", &rig.bearing, rig.load.radial_load, rig.speed);
                list.extend(preload_of_rig(rig));
                list
            }
            Built::CoastDown(run, _) => {
                let load =
                    above_the_rating(run.bearing.static_load_rating, run.bearing.radial_load);
                load.into_iter().collect()
            }
            Built::Signals(_) | Built::Identify(_) | Built::Rotor(_) => Vec::new(),
        }
    }
}

/// An unbalance that no rotor on magnets is left with.
fn unbalance_grade(drop: &Drop) -> Option<Warning> {
    let eccentricity = match &drop.shaft {
        Some(shaft) => {
            let planes = shaft.model.rotor.unbalance.iter();
            planes.map(|plane| plane.amount.abs()).sum::<f64>() / drop.rotor.mass
        }
        None => drop.rotor.unbalance_eccentricity.abs(),
    };
    let grade = eccentricity * drop.rotor.speed.abs();
    (grade > LARGEST_GRADE).then(|| {
        warning(
            "AB1094",
            format!(
                "The unbalance is implausible: {:.3e} m of eccentricity (all planes in one direction) at {:.0} rad/s are a balance quality \
                 grade G {:.0} (ISO 21940-11, mm/s); turbomachines have G 1 to G 6.3. A lost blade would be one.",
                eccentricity,
                drop.rotor.speed.abs(),
                grade * 1e3
            ),
        )
    })
}

/// Load and speed beyond what a bearing stands.
fn of_bearing(name: &str, bearing: &Bearing, load: f64, speed: f64) -> Vec<Warning> {
    let load = above_the_rating(bearing.static_load_rating, load);
    let mut list: Vec<Warning> = load
        .into_iter()
        .chain(speed_rating(bearing, speed))
        .collect();
    if !name.is_empty() {
        for warning in &mut list {
            warning.text = format!("{name}: {}", warning.text);
        }
    }
    list
}

fn above_the_rating(rating: Option<f64>, load: f64) -> Option<Warning> {
    let rating = rating.filter(|rating| load > *rating)?;
    Some(warning(
        "AB1029",
        format!(
            "The static radial load of {load:.0} N is {:.1} times the static load rating of {rating:.0} N: permanent \
             dents must be expected, and the laws of contact and friction are outside their range.",
            load / rating
        ),
    ))
}
