//! One test, as its signals tell it.

/// Speed, acceleration and torque of one test on a common grid of times. All values are SI.
///
/// The deviations are standard deviations of one value; torques close in time share most of their error.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Name for messages.
    pub name: String,
    /// Radial load on the bearing, N.
    pub load: f64,
    /// Times, s; rising.
    pub time: Vec<f64>,
    /// Speed Ω of the inner race, rad/s.
    pub speed: Vec<f64>,
    /// Its standard deviation, rad/s.
    pub speed_deviation: Vec<f64>,
    /// Acceleration Ω̇ of the inner race, rad/s².
    pub acceleration: Vec<f64>,
    /// Its standard deviation, rad/s².
    pub acceleration_deviation: Vec<f64>,
    /// Torque t_O that the bearing exerts on its outer race, N m.
    pub torque: Vec<f64>,
    /// Its standard deviation with noise, zero and scale, N m.
    pub torque_deviation: Vec<f64>,
    /// Standard deviation of the zero of the torque alone, N m: an error that all torques of the test share.
    pub zero_deviation: f64,
    /// Relative standard deviation of the scale of the torque alone: shared by all tests of one sensor.
    pub scale_deviation: f64,
    /// Time after which two errors of the torque count as independent, zero and scale apart, s.
    pub correlation_time: f64,
    /// When the clutch engaged, s; none where nothing changed quickly.
    pub engagement: Option<f64>,
    /// Speed of the cage, where it was measured.
    pub cage: Option<CageTrace>,
    /// Temperature of the outer race over `time`, K above the start; where it was measured.
    pub temperature: Option<Vec<f64>>,
}

/// Speed of the cage over times of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct CageTrace {
    /// Times, s; rising.
    pub time: Vec<f64>,
    /// Speed ω_c, rad/s.
    pub speed: Vec<f64>,
    /// Its standard deviation, rad/s.
    pub deviation: Vec<f64>,
}
