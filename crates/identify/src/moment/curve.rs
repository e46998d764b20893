//! A steady moment over speed with its band.

use measure::interpolation::place;
use measure::uncertain::Uncertain;

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
mod tests {
    use super::*;

    fn curve() -> SteadyMoment {
        SteadyMoment {
            load: 50.0,
            speed: vec![10.0, 20.0, 40.0],
            moment: vec![1.0, 2.0, 3.0],
            covariance: vec![
                vec![0.04, 0.02, 0.01],
                vec![0.02, 0.04, 0.02],
                vec![0.01, 0.02, 0.09],
            ],
            scale_deviation: 0.1,
        }
    }

    #[test]
    fn odd_in_speed_and_nothing_outside() {
        let curve = curve();
        assert!(curve.sound().is_ok());
        let ahead = curve.at(30.0).unwrap();
        let back = curve.at(-30.0).unwrap();
        assert_eq!((ahead.value, back.value), (2.5, -2.5));
        assert_eq!(ahead.deviation, back.deviation);
        // mean of two: (0.04 + 2·0.02 + 0.09)/4 = 0.0425, and a tenth of 2.5
        assert!((ahead.deviation - 0.0425_f64.sqrt().hypot(0.25)).abs() < 1e-15);
        assert_eq!(curve.covariance_between(10.0, -40.0), Some(-0.01));
        assert_eq!(curve.covariance_between(-10.0, -40.0), Some(0.01));
        // a moment that noise makes negative stays so, and turns with the speed
        let negative = SteadyMoment {
            moment: vec![-1.0, 2.0, 3.0],
            ..curve.clone()
        };
        assert_eq!(negative.at(10.0).unwrap().value, -1.0);
        assert_eq!(negative.at(-10.0).unwrap().value, 1.0);
        // just above: the end, its slope of 0.05 in the deviation
        let above = curve.without_scale(40.4).unwrap();
        assert_eq!(above.value, 3.0);
        assert!((above.deviation - 0.3_f64.hypot(0.05 * 0.4)).abs() < 1e-12);
        for outside in [9.99, 40.41, -41.0, 0.0, f64::NAN] {
            assert_eq!(curve.at(outside), None);
        }
    }
    #[test]
    fn a_broken_curve_is_refused() {
        for broken in [
            SteadyMoment {
                moment: vec![1.0],
                ..curve()
            },
            SteadyMoment {
                speed: vec![1.0, 1.0, 2.0],
                ..curve()
            },
            SteadyMoment {
                speed: vec![-1.0, 1.0, 2.0],
                ..curve()
            },
            SteadyMoment {
                moment: vec![1.0, f64::NAN, 0.0],
                ..curve()
            },
            SteadyMoment {
                scale_deviation: f64::NAN,
                ..curve()
            },
        ] {
            assert!(broken.sound().is_err());
        }
    }
}
