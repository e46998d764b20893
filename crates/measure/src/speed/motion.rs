//! The motion of a shaft at an instant, and a quick change of its speed.

/// The motion at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Instant, s.
    pub time: f64,
    /// Angle from the first mark that passed, rad.
    pub angle: f64,
    /// Speed, rad/s.
    pub speed: f64,
    /// Acceleration, rad/s².
    pub acceleration: f64,
    /// Covariance of angle, speed and acceleration, in the units of their products.
    pub covariance: [[f64; 3]; 3],
}

impl Motion {
    /// Standard uncertainty of the speed, rad/s.
    pub fn speed_uncertainty(&self) -> f64 {
        self.covariance[1][1].max(0.0).sqrt()
    }

    /// Standard uncertainty of the acceleration, rad/s².
    pub fn acceleration_uncertainty(&self) -> f64 {
        self.covariance[2][2].max(0.0).sqrt()
    }
}

/// A quick change of speed that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Instant of the engagement and its standard uncertainty, s.
    pub engagement: (f64, f64),
    /// Instant at which the change ends and its standard uncertainty, s; none where the record ends before it.
    pub end: Option<(f64, f64)>,
    /// Whether the shaft rested before.
    pub from_rest: bool,
    /// Pulses between engagement and end.
    pub pulses: usize,
}
