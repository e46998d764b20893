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

use super::layout::{CLUTCH_CAPACITY, DRIVE_HEAT, DRIVE_MOMENT};
use super::mode::Clutch;
use crate::bearing::BearingConstants;
use crate::system::machine::layout::Layout;
use crate::system::machine::{Mode, RotorMachine};

/// Speed by which the flywheel is ahead of the shaft, rad/s.
fn slip_speed(layout: &Layout, state: &[f64]) -> f64 {
    state[layout.rotor.spin()] - state[layout.bearings[0].inner.spin()]
}

impl RotorMachine {
    /// What is left before the clutch changes: of the slip, rad/s, or of the capacity, N m.
    pub(in crate::system) fn reserve(
        &self,
        mode: &Mode<f64>,
        (state, probe): (&[f64], &[f64]),
    ) -> f64 {
        match mode.clutch.state {
            Clutch::Open => f64::INFINITY,
            Clutch::Slipping { direction } => slip_speed(self.layout(), state) * direction,
            Clutch::Locked => probe[CLUTCH_CAPACITY] - probe[DRIVE_MOMENT].abs(),
        }
    }
    /// What becomes of the clutch where nothing is left.
    pub(in crate::system) fn change_clutch(
        &self,
        time: f64,
        mode: &mut Mode<f64>,
        state: &mut [f64],
    ) {
        match mode.clutch.state {
            Clutch::Open => {}
            Clutch::Slipping { .. } => {
                self.even_out(state);
                mode.clutch.state = self.engaged(mode, time, state);
            }
            Clutch::Locked => {
                let torque = self.inspect_in(mode, time, state).1[DRIVE_MOMENT];
                mode.clutch.state = Clutch::Slipping {
                    direction: torque.signum(),
                };
            }
        }
    }
    /// What an engaged clutch does in a state at an instant.
    pub(in crate::system) fn engaged(&self, mode: &Mode<f64>, time: f64, state: &[f64]) -> Clutch {
        let slip = slip_speed(self.layout(), state);
        if slip != 0.0 {
            return Clutch::Slipping {
                direction: slip.signum(),
            };
        }
        let mut locked = *mode;
        locked.clutch.state = Clutch::Locked;
        let torque = self.inspect_in(&locked, time, state).1[DRIVE_MOMENT];
        if torque.abs() <= mode.clutch.capacity.at(time) {
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
        let layout = self.layout();
        let (race, driver) = (layout.bearings[0].inner.spin(), layout.rotor.spin());
        let slip = slip_speed(layout, state);
        let flywheel = self.constants.rotor.polar_inertia;
        let part = &self.constants.bearings[0];
        // balls that roll turn with the shaft; others keep their own motion
        let rolling = match &part.bearing {
            BearingConstants::Rolling(bearing) => bearing.set.inner_inertia(),
            BearingConstants::Planar(_) | BearingConstants::Spatial(_) => 0.0,
        };
        let shaft = part.inner_race.inertia + rolling;
        let shared = (flywheel * state[driver] + shaft * state[race]) / (flywheel + shaft);
        state[driver] = shared;
        state[race] = shared;
        let reduced = flywheel * shaft / (flywheel + shaft);
        state[layout.heat(DRIVE_HEAT)] += 0.5 * reduced * slip * slip;
    }
}
