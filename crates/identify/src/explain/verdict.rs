//! What the comparison answers.

use super::explanation::Explanation;
use super::hypothesis::Hypothesis;

/// What the data say.
#[derive(Clone, Debug, PartialEq)]
pub enum Conclusion {
    /// One explanation is probable enough and fits.
    Supported(Explanation),
    /// Several are left, the most probable first.
    Undecided(Vec<Explanation>),
    /// The most probable one does not fit: none of these.
    NoneOfThese,
}

/// A parameter after the data.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Name in words.
    pub name: &'static str,
    /// Unit; "1" without dimension.
    pub unit: &'static str,
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
}

/// How well an explanation fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Weighted sum of squares χ² of the best of the posterior, with that of its parameters against their priors.
    pub chi_squared: f64,
    /// Number of means it sums over.
    pub count: usize,
    /// Probability of a χ² at least as large, where the explanation is true with parameters drawn from its priors.
    pub probability: f64,
    /// Posterior mean of the models' own error over M.
    pub discrepancy: f64,
}

/// One explanation after the data.
#[derive(Clone, Debug, PartialEq)]
pub struct Assessment {
    /// Which.
    pub explanation: Explanation,
    /// Its prior probability.
    pub prior_probability: f64,
    /// Its posterior probability among them all.
    pub probability: f64,
    /// ln of its marginal likelihood; of densities of N m and rad/s, so only differences matter.
    pub log_evidence: f64,
    /// How well it fits; none where no parameters in its range fulfil its claim.
    pub fit: Option<Fit>,
    /// Form of the explanation that is most probable, e.g. which fault of the sensor.
    pub form: &'static str,
    /// Parameters of that form.
    pub parameters: Vec<Estimate>,
    /// Torque that the best of the posterior predicts, N m: one for each of [`Verdict::torque_means`]; empty without a fit.
    pub predicted_torque: Vec<f64>,
    /// Draws of the posterior for the ranking of tests.
    pub(crate) draws: Vec<FormDraw>,
}

/// A draw with the form it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FormDraw {
    pub form: Hypothesis,
    pub coordinates: Vec<f64>,
}

/// The answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// What the data say.
    pub conclusion: Conclusion,
    /// Each explanation, in the order of [`Explanation::ALL`].
    pub assessments: Vec<Assessment>,
    /// Number of means of torque and of cage speed that were compared.
    pub means: (usize, usize),
    /// How many independent data these are worth.
    pub effective_means: f64,
    /// The means of torque that were compared.
    pub torque_means: Vec<TorqueMean>,
}

/// A mean of the measured torque over some time, as the explanations are compared on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueMean {
    /// Place of its test among the tests.
    pub test: usize,
    /// Begin on the clock of that test, s.
    pub from: f64,
    /// End on the same clock, s.
    pub to: f64,
    /// N m.
    pub torque: f64,
}

impl Verdict {
    /// The assessment of an explanation.
    pub fn of(&self, explanation: Explanation) -> &Assessment {
        &self.assessments[explanation as usize]
    }

    /// All of them, the most probable first, also where the odds leave nothing to tell apart.
    pub fn ranked(&self) -> Vec<&Assessment> {
        let mut ranked: Vec<&Assessment> = self.assessments.iter().collect();
        let weight = |a: &Assessment| a.prior_probability.ln() + a.log_evidence;
        ranked.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
        ranked
    }

    /// The most probable explanation.
    pub fn best(&self) -> &Assessment {
        let mut best = &self.assessments[0];
        for assessment in &self.assessments {
            if assessment.probability > best.probability {
                best = assessment;
            }
        }
        best
    }
}
