//! What a bearing dissipates while it is spun up, true and as the moment on its outer race tells it.
//!
//! ```text
//!   what the bearing dissipates, from the moment on the outer race            Ω0 final speed, start at rest
//!   printed (21)    (1+2s) ∫ t_O Ω dt + ½ J_O Ω0²                             J_O = (1+2s)(3/20 N m_b + ¼ m_c) R²
//!   corrected              ∫ t_O Ω dt + ½ J_O Ω0²                             balls that roll all the way
//!   exact                  ∫ (t_O + t_g) Ω dt + ∫ Ω dL - Δ(KE + U)            any skidding, races concentric and fixed
//!   path term              ∫ Ω dL, from ½ L0 Ω0 (rolling) to L0 Ω0 (balls spun up after the race)
//! ```
//! The laws stand in [`spin_up_energy`](physics::spin_up_energy).
//! L: angular momentum of balls and cage, L0 when they roll at Ω0. dL/dt is taken from the rates of the states, not from
//! the moments, so the exact form is a check and not an identity. Where a race moves, the work `other`
//! carries its part.

use physics::rolling::RollingSet;
use physics::spin_up_energy::{SpinUpEnergy, spin_up_loss};

/// What flowed in a spin-up from rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpinUpFlows {
    /// Masses and radii of balls and cage.
    pub set: RollingSet<f64>,
    /// Final speed Ω0 of the inner race, rad/s.
    pub final_speed: f64,
    /// Sum of the heats in the bearing, J.
    pub dissipated: f64,
    /// ∫t_O Ω dt, J.
    pub outer_work: f64,
    /// ∫Ω dL, J.
    pub path: f64,
    /// What drags to the ground and races that move or grow add, J; 0 on the concentric rig.
    pub other: f64,
    /// Rise of the energy of balls, cage and contacts, J.
    pub stored: f64,
}

/// What the bearing dissipated in a spin-up from rest, J: true, and as the outer race tells it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OuterRaceEnergy {
    /// Sum of the heats in the bearing.
    pub dissipated: f64,
    /// The source paper's (21) as printed.
    pub printed: f64,
    /// Its correction: balls that roll all the way.
    pub corrected: f64,
    /// The exact form.
    pub exact: f64,
    /// The path term ∫Ω dL as it was.
    pub path: f64,
    /// The path term of balls that roll all the way, ½ L0 Ω0.
    pub least_path: f64,
    /// The path term of balls spun up after the race, L0 Ω0.
    pub largest_path: f64,
}

impl OuterRaceEnergy {
    /// Told by what flowed.
    pub fn of(flows: &SpinUpFlows) -> Self {
        let by_outer_race = SpinUpEnergy {
            set: flows.set,
            final_speed: flows.final_speed,
            outer_moment_work: flows.outer_work,
        };
        let (least_path, largest_path) = by_outer_race.path_term_bounds();
        OuterRaceEnergy {
            dissipated: flows.dissipated,
            printed: by_outer_race.printed_loss(),
            corrected: by_outer_race.rolling_loss(),
            exact: spin_up_loss(flows.outer_work, flows.other, flows.path, flows.stored),
            path: flows.path,
            least_path,
            largest_path,
        }
    }
}
