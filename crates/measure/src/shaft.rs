//! The turning shaft as other estimators need it: angle, speed and their band at equal intervals.

/// Angle and speed of a shaft at equal intervals, as found from pulses or an encoder.
#[derive(Clone, Copy, Debug)]
pub struct Shaft<'a> {
    /// Time of the first value, s.
    pub first: f64,
    /// Interval, s; positive.
    pub interval: f64,
    /// Angle, rad; continuous, not wrapped.
    pub angle: &'a [f64],
    /// Speed, rad/s; as long as `angle`.
    pub speed: &'a [f64],
    /// Standard deviation of the speed, rad/s; as long as `speed`, or empty for a speed taken as exact.
    pub speed_deviation: &'a [f64],
}

impl Shaft<'_> {
    /// Says what is wrong with the lists, if anything is.
    pub fn check(&self) -> Result<(), String> {
        let count = self.angle.len();
        if !(self.interval > 0.0 && self.interval.is_finite() && self.first.is_finite()) {
            return Err("the interval of the shaft angle must be positive and finite".into());
        }
        if count < 2 || self.speed.len() != count {
            return Err(format!(
                "the shaft has {count} angles and {} speeds; at least 2 of each are needed, at the same times",
                self.speed.len()
            ));
        }
        if !self.speed_deviation.is_empty() && self.speed_deviation.len() != count {
            return Err(format!(
                "the shaft has {count} speeds and {} deviations",
                self.speed_deviation.len()
            ));
        }
        let all = self
            .angle
            .iter()
            .chain(self.speed)
            .chain(self.speed_deviation);
        if all.clone().any(|v| !v.is_finite()) {
            return Err("angle, speed and deviation of the shaft must be finite".into());
        }
        Ok(())
    }

    /// Time of the last value, s.
    pub fn last(&self) -> f64 {
        self.first + self.angle.len().saturating_sub(1) as f64 * self.interval
    }

    /// Whether a time lies within the record.
    pub fn covers(&self, time: f64) -> bool {
        time >= self.first && time <= self.last()
    }

    fn place(&self, time: f64) -> (usize, f64) {
        let place = ((time - self.first) / self.interval)
            .clamp(0.0, self.angle.len().saturating_sub(1) as f64);
        let index = (place as usize).min(self.angle.len().saturating_sub(2));
        (index, place - index as f64)
    }

    /// Angle at a time within the record, rad: the cubic through angle and speed at both ends of the interval.
    pub fn angle_at(&self, time: f64) -> f64 {
        let (k, u) = self.place(time);
        let v = 1.0 - u;
        let bend = u * v * self.interval * (self.speed[k] * v - self.speed[k + 1] * u);
        self.angle[k] * v * v * (1.0 + 2.0 * u) + self.angle[k + 1] * u * u * (3.0 - 2.0 * u) + bend
    }

    /// Speed at a time within the record, rad/s, linear between values.
    pub fn speed_at(&self, time: f64) -> f64 {
        let (k, u) = self.place(time);
        self.speed[k] + u * (self.speed[k + 1] - self.speed[k])
    }

    /// Standard deviation of the speed at a time, rad/s.
    pub fn speed_deviation_at(&self, time: f64) -> f64 {
        let (k, _) = self.place(time);
        self.speed_deviation.get(k).copied().unwrap_or(0.0)
    }

    /// Highest speed without its sign, rad/s.
    pub fn fastest(&self) -> f64 {
        self.speed.iter().fold(0.0, |top, v| top.max(v.abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_values_the_angle_is_that_of_constant_acceleration() {
        let times: Vec<f64> = (0..5).map(|k| 1.0 + 0.5 * f64::from(k)).collect();
        let angle: Vec<f64> = times.iter().map(|t| 3.0 * t + 2.0 * t * t).collect();
        let speed: Vec<f64> = times.iter().map(|t| 3.0 + 4.0 * t).collect();
        let shaft = Shaft {
            first: 1.0,
            interval: 0.5,
            angle: &angle,
            speed: &speed,
            speed_deviation: &[],
        };
        assert!(shaft.check().is_ok());
        for t in [1.0, 1.2, 2.49, 3.0] {
            assert!((shaft.angle_at(t) - (3.0 * t + 2.0 * t * t)).abs() < 1e-12);
            assert!((shaft.speed_at(t) - (3.0 + 4.0 * t)).abs() < 1e-12);
        }
    }

    #[test]
    fn lists_of_other_lengths_are_refused() {
        let shaft = Shaft {
            first: 0.0,
            interval: 1.0,
            angle: &[0.0, 1.0],
            speed: &[1.0],
            speed_deviation: &[],
        };
        assert!(shaft.check().is_err());
    }
}
