//! What a bearing dissipates while it is spun up, true and as estimated from the moment on its outer race.
//!
//! ```text
//!   what the bearing dissipates, from the moment on the outer race            Ω0 final speed, start at rest
//!   printed (21)    (1+2s) ∫ t_O Ω dt + ½ J_O Ω0²                             J_O = (1+2s)(3/20 N m_b + ¼ m_c) R²
//!   corrected              ∫ t_O Ω dt + ½ J_O Ω0²                             balls that roll all the way
//!   exact                  ∫ (t_O + t_g) Ω dt + ∫ Ω dL - Δ(KE + U)            any skidding, races concentric and fixed
//!   path term              ∫ Ω dL: ½ L0 Ω0 (rolling), L0 Ω0 (balls spun up after the race), a little more (spin first, orbit last)
//! ```
//! The laws stand in [`spin_up_energy`](physics::spin_up_energy).
//! L: angular momentum of balls and cage, L0 when they roll at Ω0. dL/dt is taken from the rates of the states, not from
//! the moments, so the exact form is a check and not an identity. Where a race moves, the work `other`
//! carries its part.

use super::machine::RotorMachine;
use crate::bearing;
use physics::spin_up_energy::{SpinUpEnergy, spin_up_loss};

/// Works by the moments on the races that a spin-up keeps, in the order of their channels.
///
/// | name | integral over time |
/// |---|---|
/// | `inner_moment` | t_I Ω |
/// | `outer_moment` | t_O Ω: what a torque arm and a speed pick-up give |
/// | `momentum` | Ω dL/dt, L of balls and cage |
/// | `other` | what drags to the ground, weights and races that move or grow add; 0 on the concentric rig |
pub const WORKS: [&str; 4] = ["inner_moment", "outer_moment", "momentum", "other"];

/// What the bearing dissipated in a spin-up from rest, J: true, and as estimated from the outer race.
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
    /// The path term of balls that roll all the way, ½ L0 Ω0: the least.
    pub least_path: f64,
    /// The path term of balls spun up after the race, L0 Ω0.
    pub path_behind_the_race: f64,
    /// The largest path term: balls that spin with the race while the cage is at rest.
    pub largest_path: f64,
}

impl RotorMachine {
    /// From the ledgers of two states (start, end) of a rig, whose race has its final speed Ω0 at the end.
    ///
    /// The printed and the corrected form and the bounds of the path term take the balls to have been at rest at the
    /// start and to roll at the end.
    pub fn outer_race_energy(&self, start: &[f64], end: &[f64]) -> OuterRaceEnergy {
        let layout = self.layout();
        let flow = |channel: usize| end[channel] - start[channel];
        let stored = |state: &[f64]| self.bearing_content(0, state).sum();
        let [outer_work, path, other] = [1, 2, 3].map(|work| flow(layout.work(work)));
        let by_outer_race = SpinUpEnergy {
            set: self.constants.bearings[0].bearing.set(),
            final_speed: end[layout.bearings[0].inner.spin()],
            outer_moment_work: outer_work,
        };
        let (least_path, largest_path) = by_outer_race.path_term_bounds();
        let heats = 0..bearing::HEATS.len();
        OuterRaceEnergy {
            dissipated: heats.map(|kind| flow(layout.heat(kind))).sum(),
            printed: by_outer_race.printed_loss(),
            corrected: by_outer_race.rolling_loss(),
            exact: spin_up_loss(outer_work, other, path, stored(end) - stored(start)),
            path,
            least_path,
            path_behind_the_race: by_outer_race.path_term_behind_the_race(),
            largest_path,
        }
    }
}
