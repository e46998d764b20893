//! What is asked of the pulses of a shaft.

/// Where a quick change of speed is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transient {
    /// The steepest rise of speed of the record, if there is one.
    Auto,
    /// Within an interval, s.
    Within(f64, f64),
    /// Nowhere: the speed changes slowly throughout.
    None,
}

/// What is asked of the pulses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedSettings {
    /// Where a quick change of speed is looked for.
    pub transient: Transient,
    /// Largest uncertainty of the acceleration in the quick change, root mean square over it, as a part of the peak;
    /// pulses that cannot carry it are refused. None: take what there is.
    pub wanted: Option<f64>,
    /// Standard uncertainty of a delay that all pulses have in common (pickup, filter), s. Pulses cannot show it.
    pub latency: f64,
    /// Standard uncertainty (root mean square) of an acceleration ripple once per revolution while the wheel was calibrated,
    /// rad/s²: unbalance under gravity, a belt. It looks like an eccentric wheel. Without effect where no
    /// calibration is used.
    pub ripple: f64,
}

impl Default for SpeedSettings {
    /// One quick change at most, any uncertainty, no delay and no ripple.
    fn default() -> Self {
        SpeedSettings {
            transient: Transient::Auto,
            wanted: None,
            latency: 0.0,
            ripple: 0.0,
        }
    }
}
