//! What is known of a torque measurement.

use super::Sensor;
use crate::shaft::Shaft;
use statistics::uncertain::Uncertain;

/// What is known of a torque measurement.
#[derive(Clone, Copy, Debug)]
pub struct Inversion<'a> {
    /// The sensor.
    pub sensor: Sensor,
    /// Time of the first value, s.
    pub first: f64,
    /// Interval between values, s.
    pub interval: f64,
    /// Reading in any unit of torque; NaN where there is none.
    pub reading: &'a [f64],
    /// Readings at the limit of their converter; they are not used as they are.
    pub clipped: &'a [Clipped],
    /// The shaft over all the time of the reading; none where there is no synchronous disturbance to remove.
    pub shaft: Option<Shaft<'a>>,
    /// Time at which the clutch engages, with its standard deviation, s; before it the shaft rests. None: it turns throughout. An
    /// engagement that may lie before the record, within two deviations, is not used: no rest gives a zero then.
    pub engagement: Option<Uncertain>,
    /// Time at which the clutch locks, with its standard deviation, s, where it is known and not before the engagement: what
    /// the acceleration makes of the torque ends there at once. None: the torque calms down from the engagement on.
    pub lock: Option<Uncertain>,
    /// Zero of the reading, known to this standard deviation, in the unit of the reading; it is estimated where the shaft rests.
    pub zero: Uncertain,
    /// Relative deviation of the sensor's calibration, linearity included, 1.
    pub scale_deviation: f64,
    /// Power of the speed with which the disturbance grows: 2 for unbalance, 0 for a run-out, which is there at rest too; none to
    /// let the data choose.
    pub disturbance_power: Option<f64>,
}

/// Readings that stand at the limit of what their converter can show: the true ones are there or beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clipped {
    /// Index of the first of them.
    pub first: usize,
    /// Their number.
    pub count: usize,
    /// The limit, in the unit of the reading.
    pub limit: f64,
    /// Whether it is the upper limit.
    pub above: bool,
}

impl Inversion<'_> {
    /// Whether the shaft surely rests at the start of the record: its engagement lies two deviations behind it.
    pub fn rests_at_first(&self) -> bool {
        self.engagement
            .is_some_and(|engagement| engagement.value - 2.0 * engagement.deviation > self.first)
    }
}
