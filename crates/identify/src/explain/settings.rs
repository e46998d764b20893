//! How explanations are compared.

/// How the comparison is made. The defaults are assumed; the tests state how often they lead to the right answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Seed of all random numbers: the same seed gives the same verdict.
    pub seed: u64,
    /// Probability from which an explanation wins.
    pub decision: f64,
    /// Least probability of an acceptable fit.
    pub least_fit: f64,
    /// Least effect on the torque that makes an explanation differ from rolling, over M.
    pub least_effect: f64,
    /// Least cage slip that makes slip an explanation.
    pub least_slip: f64,
    /// Amplitudes of the models' own error over M, equally probable.
    pub discrepancy: Vec<f64>,
    /// Relative deviation of the level of M between coast-down and tests, beside its band.
    pub level_deviation: f64,
    /// Relative deviation of the inertia J_O (masses, cage).
    pub inertia_deviation: f64,
    /// Deviation of the time by which the torque lags or is smoothed beyond what is stated, s.
    pub lag_deviation: f64,
    /// Time by which the reading settles after a stop, s: before, no mean at rest counts.
    pub settling_time: f64,
    /// Least excess settling time that makes a slow sensor an explanation, s.
    pub least_settling: f64,
    /// Points of the prior that are looked at first.
    pub prior_points: u32,
    /// Of these, how many are refined.
    pub starts: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            seed: 1,
            decision: 0.95,
            least_fit: 1e-3,
            least_effect: 0.05,
            least_slip: 0.02,
            discrepancy: vec![0.005, 0.01, 0.02, 0.04, 0.08],
            level_deviation: 0.01,
            inertia_deviation: 0.1,
            lag_deviation: 0.01,
            settling_time: 0.1,
            least_settling: 0.03,
            prior_points: 256,
            starts: 3,
        }
    }
}

impl Settings {
    /// Name of a value that has no meaning.
    pub(super) fn fault(&self) -> Option<&'static str> {
        let share = |x: f64| x > 0.0 && x < 1.0;
        let deviation = |x: f64| (0.0..1.0).contains(&x);
        [
            ("decision", self.decision > 0.5 && self.decision < 1.0),
            ("least_fit", share(self.least_fit)),
            ("least_effect", share(self.least_effect)),
            ("least_slip", share(self.least_slip)),
            (
                "discrepancy",
                !self.discrepancy.is_empty() && self.discrepancy.iter().all(|a| share(*a)),
            ),
            ("level_deviation", deviation(self.level_deviation)),
            ("inertia_deviation", deviation(self.inertia_deviation)),
            ("lag_deviation", deviation(self.lag_deviation)),
            ("least_settling", deviation(self.least_settling)),
            (
                "settling_time",
                self.settling_time >= 0.0 && self.settling_time.is_finite(),
            ),
            ("prior_points", (16..=100_000).contains(&self.prior_points)),
            ("starts", (1..=100).contains(&self.starts)),
        ]
        .into_iter()
        .find_map(|(name, fine)| (!fine).then_some(name))
    }
}
