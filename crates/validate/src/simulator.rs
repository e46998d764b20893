//! What validation asks of the simulation.

use super::machine::ReferenceMachine;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A drop as the reference file describes it.
#[derive(Clone, Debug, Deserialize, PartialEq)]
pub struct DropReference {
    /// The machine; its levitation vanishes at the release.
    pub params: ReferenceMachine,
    /// Rotor speed at the release, rad/s.
    #[serde(rename = "Om")]
    pub rotor_speed: f64,
    /// Duration, s.
    #[serde(rename = "T")]
    pub duration: f64,
    /// State at the release, then the energy accounts; layout as in the derivative points.
    pub y0: Vec<f64>,
    /// Means over the ensemble.
    pub mean: BTreeMap<String, Option<f64>>,
    /// Standard deviations over the ensemble.
    pub sd: BTreeMap<String, Option<f64>>,
    /// Means of the first contact start times, s.
    pub t_on_mean: Vec<f64>,
    /// Their standard deviations, s.
    pub t_on_sd: Vec<f64>,
}

/// One state of a machine with everything that the reference computed for it.
#[derive(Clone, Debug, Deserialize, PartialEq)]
pub struct DerivativePoint {
    /// The machine.
    pub params: ReferenceMachine,
    /// The state, then the energy accounts.
    pub y: Vec<f64>,
    /// Reference rates of both.
    pub dy: Vec<f64>,
    /// Reference values per ball, columns as in the file's `per_ball_cols`.
    pub per_ball: Vec<Vec<f64>>,
    /// Reference global values, columns as in the file's `global_cols`.
    #[serde(default)]
    pub globals: Vec<f64>,
    /// Reference kinetic energy, J.
    pub kinetic: f64,
    /// Reference potential energy, J.
    pub potential: f64,
}

/// Free fall of a rotor from rest, centred, without unbalance and without friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeFall {
    /// Radial air clearance, m.
    pub clearance: f64,
    /// Gravity, m/s².
    pub gravity: f64,
}

/// One bounce of a rotor on a held race with a linear contact without damping and friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticBounce {
    /// Rotor mass, kg.
    pub mass: f64,
    /// Contact stiffness, N/m.
    pub stiffness: f64,
    /// Radial air clearance, m.
    pub clearance: f64,
    /// Gravity, m/s².
    pub gravity: f64,
}

/// The right-hand side at one state, in the layout of the reference files.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivativeAnswer {
    /// Rates of the state, then the powers of the 12 energy accounts.
    pub rates: Vec<f64>,
    /// Per ball: Q_i, Q_o, T_i, T_o (paper sign), pocket force, side, F_j, δ_i, δ_o, u_i, u_o, pen, arm_i, arm_o.
    pub per_ball: Vec<Vec<f64>>,
    /// Global columns, in the order of the file's `global_cols`.
    pub globals: Vec<f64>,
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// Potential energy, J.
    pub potential: f64,
}

/// A drop, in the words of the reference files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DropAnswer {
    /// Values by the keys of the files; what did not happen is `None`.
    pub values: BTreeMap<&'static str, Option<f64>>,
    /// `t_on`, s: starts of contact in their order; more than the reference lists may follow.
    pub contact_start_times: Vec<f64>,
}

/// The simulation as validation sees it; of itself it runs nothing. `Err` says why a case cannot be run: its rows become "not run".
pub trait Simulator {
    /// Whether cases are run that take long.
    fn long(&self) -> bool {
        false
    }
    /// Whether machines may be run here.
    fn machines(&self) -> Result<(), String> {
        Err(LAWS_ONLY.into())
    }
    /// Time to first contact, s.
    fn free_fall(&self, _case: &FreeFall) -> Result<f64, String> {
        Err(LAWS_ONLY.into())
    }
    /// Largest contact force, N.
    fn elastic_bounce(&self, _case: &ElasticBounce) -> Result<f64, String> {
        Err(LAWS_ONLY.into())
    }
    /// The right-hand side at the state `point.y` of the machine `point.params`.
    fn derivative(&self, _point: &DerivativePoint) -> Result<DerivativeAnswer, String> {
        Err(LAWS_ONLY.into())
    }
    /// The drop from the state `reference.y0` over `reference.duration`, at a relative tolerance of 3e-7 or less.
    fn drop(&self, _reference: &DropReference) -> Result<DropAnswer, String> {
        Err(LAWS_ONLY.into())
    }
}

/// A simulator that runs nothing: only laws are validated.
#[derive(Clone, Copy, Debug, Default)]
pub struct LawsOnly;

const LAWS_ONLY: &str = "needs a simulation";

impl Simulator for LawsOnly {
    /// What it does not run takes no time.
    fn long(&self) -> bool {
        true
    }
}
