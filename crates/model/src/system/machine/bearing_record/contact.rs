//! A contact of rotor and race in a run.

/// One contact of rotor and inner race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Begin, s.
    pub start: f64,
    /// End, s; none while it lasts.
    pub end: Option<f64>,
    /// Largest normal force, N.
    pub peak_force: f64,
    /// Its instant, s.
    pub peak_time: f64,
    /// Largest temperature rise of the patch, K; 0 where surfaces are not followed.
    pub peak_rise: f64,
}
