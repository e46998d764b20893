//! A point of the posterior of an explanation.

/// A point of the posterior.
#[derive(Clone, Debug)]
pub(crate) struct Draw {
    pub coordinates: Vec<f64>,
    /// ln of its share of the posterior (unnormalised).
    pub log_weight: f64,
    /// ln likelihood and χ² at each amplitude.
    pub levels: Vec<(f64, f64)>,
}
