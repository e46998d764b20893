//! How explanations are compared. What is no setting is assumed; the tests state how often it leads to the right answer.

use super::explanation::Explanation;

/// What is asked of the comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Seed of all random numbers: the same seed gives the same verdict.
    pub seed: u64,
    /// Probability from which an explanation wins.
    pub decision: f64,
    /// Time by which the reading settles after a stop, s: before, no mean at rest counts.
    pub settling_time: f64,
    /// Prior weight of each explanation in the order of [`Explanation::ALL`]; only ratios matter. 0 rules one out.
    pub odds: [f64; 7],
}

/// Least probability of an acceptable fit.
pub const LEAST_FIT: f64 = 1e-3;
/// Least effect on the torque that makes an explanation differ from rolling, over M.
pub(super) const LEAST_EFFECT: f64 = 0.05;
/// Least cage slip that makes slip an explanation.
pub const LEAST_SLIP: f64 = 0.02;
/// Amplitudes of the models' own error over M, equally probable.
pub(super) const DISCREPANCY: [f64; 5] = [0.005, 0.01, 0.02, 0.04, 0.08];
/// Relative deviation of the level of M between coast-down and tests, beside its band.
pub(super) const LEVEL_DEVIATION: f64 = 0.01;
/// Relative deviation of the inertia J_O (masses, cage).
pub(super) const INERTIA_DEVIATION: f64 = 0.1;
/// Deviation of the time by which the torque lags or is smoothed beyond what is stated, s.
pub(super) const LAG_DEVIATION: f64 = 0.01;
/// Least excess settling time that makes a slow sensor an explanation, s.
pub(super) const LEAST_SETTLING: f64 = 0.03;
/// Points of the prior that are looked at first.
pub(super) const PRIOR_POINTS: u32 = 256;
/// Of these, how many are refined.
pub(super) const STARTS: usize = 3;

impl Default for Settings {
    fn default() -> Self {
        Self {
            seed: 1,
            decision: 0.95,
            settling_time: 0.1,
            odds: [1.0; 7],
        }
    }
}

impl Settings {
    /// Prior probability of an explanation.
    pub(super) fn probability(&self, explanation: Explanation) -> f64 {
        self.odds[explanation as usize] / self.odds.iter().sum::<f64>()
    }

    /// Name of a value that has no meaning.
    pub(super) fn fault(&self) -> Option<&'static str> {
        if !(self.decision > 0.5 && self.decision < 1.0) {
            return Some("decision");
        }
        let fine = self.settling_time >= 0.0 && self.settling_time.is_finite();
        (!fine).then_some("settling_time")
    }
}
