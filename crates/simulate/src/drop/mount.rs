//! From the parts of a mount as values to constants of the model.

use model::mount::{FrictionRing, HardStop, Housing, MaxwellBranch, MountParts, SqueezeFilm};
use scenario::drop::mount::MountParts as Given;

/// Exponent of a friction ring where none is given: smaller ones creep under small vibration about a load.
const RING_EXPONENT: f64 = 8.0;
/// Damping of a hard stop where none is given, s/m.
const STOP_DAMPING: f64 = 0.5;

/// What a mount has besides spring and damper.
pub(super) fn parts(given: &Given) -> MountParts {
    let branches = given.branch_stiffness.iter().zip(&given.branch_time);
    MountParts {
        branches: branches
            .map(|(stiffness, time)| MaxwellBranch {
                stiffness: *stiffness,
                rate: 1.0 / time,
            })
            .collect(),
        ring: given
            .ring_stiffness
            .zip(given.ring_travel)
            .map(|(stiffness, travel)| FrictionRing {
                stiffness,
                travel,
                exponent: given.ring_exponent.unwrap_or(RING_EXPONENT),
            }),
        film: film(given),
        stop: given
            .stop_gap
            .zip(given.stop_stiffness)
            .map(|(gap, stiffness)| HardStop {
                stiffness,
                gap,
                damping: given.stop_damping.unwrap_or(STOP_DAMPING),
            }),
        housing: given
            .housing_mass
            .zip(given.housing_stiffness)
            .map(|(mass, stiffness)| Housing {
                mass,
                stiffness,
                damping: given.housing_damping.unwrap_or(0.0),
            }),
        ..MountParts::NONE
    }
}

fn film(given: &Given) -> Option<SqueezeFilm<f64>> {
    let length = given.film_length?;
    Some(SqueezeFilm {
        factor: given.film_viscosity? * given.film_radius? * length * length * length,
        clearance: given.film_clearance?,
        cavitates: !given.film_flooded,
    })
}
