//! A steady moment over speed with its band.

use statistics::interpolation::place;
use statistics::uncertain::Uncertain;

/// Part of the largest speed by which a speed may lie above it and still count as measured: tests and slow tests start from a
/// drive's speed that is set to about a per cent. M is taken from the end of the curve, its slope's part is in the deviation.
const ABOVE: f64 = 0.01;

/// The steady moment M(Ω) at one load, between the smallest and the largest speed at which it was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyMoment {
    /// Radial load of the tests, N.
    pub load: f64,
    /// Speeds without sign, rad/s, rising; the first and the last bound what was measured.
    pub speed: Vec<f64>,
    /// Moment at these speeds, N m.
    pub moment: Vec<f64>,
    /// Covariance of the moments by noise, zero and form, by rows, (N m)².
    pub covariance: Vec<Vec<f64>>,
    /// Relative standard deviation that all moments share: of the torque sensor's scale.
    pub scale_deviation: f64,
}

impl SteadyMoment {
    /// Says what is wrong with a curve that was not made here; nothing if it can be used.
    pub fn sound(&self) -> Result<(), String> {
        let count = self.speed.len();
        let finite = |list: &[f64]| list.iter().all(|x| x.is_finite());
        if count < 2
            || self.moment.len() != count
            || self.covariance.len() != count
            || self
                .covariance
                .iter()
                .any(|row| row.len() != count || !finite(row))
            || !finite(&self.moment)
            || !finite(&self.speed)
        {
            return Err("the curve of the steady moment needs as many finite moments and covariances as speeds, two at least".into());
        }
        if self.speed[0] < 0.0 || self.speed.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Err("the speeds of the steady moment must rise from 0 or more".into());
        }
        if !(self.scale_deviation >= 0.0 && self.load >= 0.0 && self.load.is_finite()) {
            return Err(
                "load and scale deviation of the steady moment must not be negative".into(),
            );
        }
        Ok(())
    }

    /// Smallest and largest speed, rad/s, without sign.
    pub fn range(&self) -> (f64, f64) {
        (self.speed[0], self.speed[self.speed.len() - 1])
    }

    /// The speed without sign as the curve knows it; none outside the range and the hundredth above it.
    fn within(&self, speed: f64) -> Option<f64> {
        let (low, high) = self.range();
        let own = speed.abs();
        (own >= low && own <= (1.0 + ABOVE) * high).then(|| own.min(high))
    }

    /// Moment, N m, with the sign of the speed, and its standard deviation with that of the scale; none outside the range, of which
    /// a hundredth above the largest speed counts as a part.
    ///
    /// - `speed`: Ω, rad/s, either sign
    pub fn at(&self, speed: f64) -> Option<Uncertain> {
        let own = self.without_scale(speed)?;
        Some(Uncertain::new(
            own.value,
            own.deviation.hypot(self.scale_deviation * own.value),
        ))
    }

    /// As [`SteadyMoment::at`], without the deviation of the scale: for differences of torques of one sensor.
    ///
    /// - `speed`: Ω, rad/s, either sign
    pub fn without_scale(&self, speed: f64) -> Option<Uncertain> {
        let (next, weight) = place(&self.speed, self.within(speed)?)?;
        let value = (1.0 - weight) * self.moment[next - 1] + weight * self.moment[next];
        let variance = self.covariance_between(speed, speed)?;
        let above = (speed.abs() - self.range().1).max(0.0);
        Some(Uncertain::new(
            value * speed.signum(),
            variance.max(0.0).sqrt().hypot(self.slope(speed)? * above),
        ))
    }

    /// Covariance of the moments at two speeds, (N m)², without the scale, signs of the speeds included; none outside the range.
    ///
    /// - `first`, `second`: Ω, rad/s, either sign
    pub fn covariance_between(&self, first: f64, second: f64) -> Option<f64> {
        let (i, u) = place(&self.speed, self.within(first)?)?;
        let (j, v) = place(&self.speed, self.within(second)?)?;
        let c = &self.covariance;
        let sum = (1.0 - u) * ((1.0 - v) * c[i - 1][j - 1] + v * c[i - 1][j])
            + u * ((1.0 - v) * c[i][j - 1] + v * c[i][j]);
        Some(sum * first.signum() * second.signum())
    }

    /// Slope dM/d|Ω|, N m s; none outside the range.
    ///
    /// - `speed`: Ω, rad/s, either sign
    pub fn slope(&self, speed: f64) -> Option<f64> {
        let (next, _) = place(&self.speed, self.within(speed)?)?;
        Some(
            (self.moment[next] - self.moment[next - 1]) / (self.speed[next] - self.speed[next - 1]),
        )
    }
}

#[cfg(test)]
#[path = "../../tests/unit/moment_curve.rs"]
mod tests;
