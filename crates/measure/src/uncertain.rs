//! A number with its standard deviation.

/// A value with its standard deviation, both in the same unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uncertain {
    /// Best estimate.
    pub value: f64,
    /// Standard deviation of the estimate; not negative.
    pub deviation: f64,
}

impl Uncertain {
    /// A value with its standard deviation.
    pub fn new(value: f64, deviation: f64) -> Self {
        Self { value, deviation }
    }

    /// A value that is taken as exact.
    pub fn exact(value: f64) -> Self {
        Self {
            value,
            deviation: 0.0,
        }
    }

    /// Product with an independent uncertain number, to first order.
    pub fn times(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            deviation: (self.deviation * other.value).hypot(self.value * other.deviation),
        }
    }

    /// Difference from an independent uncertain number.
    pub fn minus(self, other: Self) -> Self {
        Self {
            value: self.value - other.value,
            deviation: self.deviation.hypot(other.deviation),
        }
    }

    /// Whether both parts are finite and the deviation is not negative.
    pub fn is_sound(self) -> bool {
        self.value.is_finite() && self.deviation.is_finite() && self.deviation >= 0.0
    }
}
