//! What slow tests say of the steady moment.

use super::curve::SteadyMoment;
use super::settings::Form;
use crate::steady_curve::Difference;
use problem::{note, note::Note};
use statistics::uncertain::Uncertain;

/// A number of a form.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name: of the law's quantity, or "zero of" a test.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Value and deviation.
    pub value: Uncertain,
}

/// What the data say of one form.
#[derive(Clone, Debug, PartialEq)]
pub struct FormFit {
    /// The form.
    pub form: Form,
    /// Its probability among the forms.
    pub probability: f64,
    /// Logarithm of the marginal likelihood of the data, (N m)^-n.
    pub log_evidence: f64,
    /// Its parameters, those of a law first, then the zeros; a spline has only zeros.
    pub parameters: Vec<Parameter>,
    /// Their correlations, by rows.
    pub correlation: Vec<Vec<f64>>,
    /// The curve of this form.
    pub curve: SteadyMoment,
    /// Correlation of the errors of neighbouring means.
    pub noise_correlation: f64,
}

/// The steady moment of slow tests.
#[derive(Clone, Debug)]
pub struct Moment {
    /// The forms, the most probable first.
    pub forms: Vec<FormFit>,
    /// Mean over the forms, its band with their disagreement.
    pub curve: SteadyMoment,
    /// Number of means that were fitted.
    pub data: usize,
    /// How many independent data they are worth.
    pub effective_data: f64,
    /// Moment speeding up minus moment slowing down, where the tests have both.
    pub up_against_down: Option<Difference>,
    /// The two slow tests of one direction that differ most, where they differ by more than their bands.
    pub unequal: Option<Unequal>,
    /// What is not trustworthy.
    pub notes: Vec<Note>,
}

impl Moment {
    /// The most probable form.
    pub fn best(&self) -> &FormFit {
        &self.forms[0]
    }
}

/// Two slow tests of one direction whose moments differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Unequal {
    /// Their names.
    pub tests: (String, String),
    /// Moment of the first minus that of the second, the mean over the speeds that both have, N m.
    pub difference: Uncertain,
    /// Moment of the first over that of the second, from the means over those speeds, 1.
    pub ratio: f64,
}

/// Part from which on their mean is the moment of no state of the bearing.
const FOREIGN: f64 = 0.05;

impl Unequal {
    /// Whether no explanation may be sought with their mean.
    pub fn forbids_comparison(&self) -> bool {
        (self.ratio - 1.0).abs() > FOREIGN
    }

    /// What is found, with the names of the tests.
    pub fn finding(&self) -> Note {
        note!(
            "the slow tests {} and {} differ by {:.2} ± {:.2} N mm, a ratio of {:.3}: M is a mean over different bearings, loads, temperatures or states of the lubricant; give those of one state",
            &self.tests.0,
            &self.tests.1,
            1e3 * self.difference.value,
            1e3 * self.difference.deviation,
            self.ratio
        )
    }
}
