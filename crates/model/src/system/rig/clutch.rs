//! The clutch: open, slipping or locked, and what follows what.
//!
//! ```text
//!   T_c(t) = min(rate (t - t_e), largest)        capacity while engaged
//!
//!   open       T = 0
//!   slipping   T = ± T_c along ω_f - Ω           heat T (ω_f - Ω) ≥ 0
//!   locked     ω_f = Ω, T whatever keeps it so    |T| ≤ T_c
//!
//!   slipping → locked     where ω_f - Ω reaches zero, and T_c suffices for what locking takes
//!   slipping → slipping   the other way round, where it does not
//!   locked   → slipping   where |T| exceeds T_c
//! ```
//! Friction is not regularised: they are state events, at which a step ends and the state goes on; a locking by its slip, that
//! the next step leaves no rest of it behind.
//! What is left of ω_f - Ω at a locking (rounding) is evened out at constant angular momentum, and its energy is heat.
//!
//! Assumes: one coefficient of friction at rest and in motion. Does not model: warming and fading of the lining.

use super::layout::{CLUTCH_CAPACITY, CLUTCH_HEAT, CLUTCH_TORQUE, FLYWHEEL, SHAFT};
use super::machine::RigMachine;
use super::mode::{Clutch, Mode};

/// Speed by which the flywheel is ahead of the shaft, rad/s.
pub fn slip_speed(state: &[f64]) -> f64 {
    state[FLYWHEEL.spin()] - state[SHAFT.spin()]
}

/// What is left before the clutch changes: of the slip, rad/s, or of the capacity, N m.
pub(super) fn reserve(mode: &Mode, (state, probe): (&[f64], &[f64])) -> f64 {
    match mode.clutch {
        Clutch::Open => f64::INFINITY,
        Clutch::Slipping { direction } => slip_speed(state) * direction,
        Clutch::Locked => probe[CLUTCH_CAPACITY] - probe[CLUTCH_TORQUE].abs(),
    }
}

impl RigMachine {
    /// What becomes of the clutch where nothing is left.
    pub(super) fn change_clutch(&self, time: f64, mode: &mut Mode, state: &mut [f64]) {
        match mode.clutch {
            Clutch::Open => {}
            Clutch::Slipping { .. } => {
                self.even_out(state);
                mode.clutch = self.engaged(mode, time, state);
            }
            Clutch::Locked => {
                let torque = self.inspect(mode, time, state).1[CLUTCH_TORQUE];
                mode.clutch = Clutch::Slipping {
                    direction: torque.signum(),
                };
            }
        }
    }
    /// What an engaged clutch does in a state at an instant.
    pub(super) fn engaged(&self, mode: &Mode, time: f64, state: &[f64]) -> Clutch {
        let slip = slip_speed(state);
        if slip != 0.0 {
            return Clutch::Slipping {
                direction: slip.signum(),
            };
        }
        let mut locked = *mode;
        locked.clutch = Clutch::Locked;
        let torque = self.inspect(&locked, time, state).1[CLUTCH_TORQUE];
        if torque.abs() <= mode.capacity.at(time) {
            Clutch::Locked
        } else {
            Clutch::Slipping {
                direction: torque.signum(),
            }
        }
    }
    /// Gives flywheel and shaft one speed; their angular momentum stays, the energy of what they differed by is heat of
    /// the clutch.
    fn even_out(&self, state: &mut [f64]) {
        let slip = slip_speed(state);
        let flywheel = self.constants.flywheel.inertia;
        // balls that roll turn with the shaft; others keep their own motion
        let shaft = self.constants.shaft.inertia + self.rolling_inertia();
        let shared =
            (flywheel * state[FLYWHEEL.spin()] + shaft * state[SHAFT.spin()]) / (flywheel + shaft);
        state[FLYWHEEL.spin()] = shared;
        state[SHAFT.spin()] = shared;
        let reduced = flywheel * shaft / (flywheel + shaft);
        state[self.layout.heat(CLUTCH_HEAT)] += 0.5 * reduced * slip * slip;
    }
}
