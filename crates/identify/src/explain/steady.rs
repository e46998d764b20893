//! The steady friction moment continued beyond what was measured: an explanation predicts whole tests, from rest to rest.

use crate::SteadyMoment;
use statistics::interpolation::place;

/// The steady curve straight between its speeds, held above them, fading to 0 at rest below.
///
/// A [`SteadyMoment`] itself says nothing outside its speeds, and the estimators leave such times out. An explanation predicts whole
/// tests, from rest to rest, and needs a value everywhere; what it is not known by is in the discrepancy of the comparison. The
/// deviation of the scale is left out: the tests share it with the curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Continued<'a>(pub &'a SteadyMoment);

/// Equal intervals of the table that stands for the curve.
const INTERVALS: usize = 512;

/// The curve as a table that is quick to read, 0 at rest.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    /// Intervals per rad/s.
    density: f64,
    moment: Vec<f64>,
    fading: Vec<f64>,
    /// M at the highest speed of the tests, N m.
    pub reference: f64,
    /// That speed, rad/s.
    pub top_speed: f64,
    /// Lowest speed of the slow tests, rad/s: below, the moment is carried on.
    pub lowest: f64,
}

impl Continued<'_> {
    /// M at a speed, N m: linear between the given speeds, held constant beyond them.
    fn at(&self, speed: f64) -> f64 {
        let (low, share) = self.place(speed);
        let high = (low + 1).min(self.0.speed.len() - 1);
        self.0.moment[low] * (1.0 - share) + self.0.moment[high] * share
    }

    /// Index of the knot below a speed and the share of the next one.
    fn place(&self, speed: f64) -> (usize, f64) {
        let knots = &self.0.speed;
        let inside = speed.max(knots[0]).min(knots[knots.len() - 1]);
        place(knots, inside).map_or((0, 0.0), |(next, share)| (next - 1, share))
    }

    /// Covariance of M at two speeds, (N m)²; it fades below the lowest knot as M does.
    pub(crate) fn covariance_between(&self, one: f64, other: f64) -> f64 {
        let size = self.0.speed.len();
        let corners = |speed: f64| {
            let (low, share) = self.place(speed);
            let fade = fading(speed);
            [
                (low, (1.0 - share) * fade),
                ((low + 1).min(size - 1), share * fade),
            ]
        };
        let mut sum = 0.0;
        for (i, a) in corners(one) {
            for (j, b) in corners(other) {
                sum += a * b * self.0.covariance[i][j];
            }
        }
        sum
    }

    pub(crate) fn table(&self, top_speed: f64) -> Table {
        let interval = top_speed * 1.02 / INTERVALS as f64;
        let moment = (0..=INTERVALS)
            .map(|i| {
                let speed = i as f64 * interval;
                self.at(speed) * fading(speed)
            })
            .collect();
        Table {
            density: 1.0 / interval,
            moment,
            fading: (0..=INTERVALS)
                .map(|i| fading(i as f64 * interval))
                .collect(),
            reference: self.at(top_speed),
            top_speed,
            lowest: self.0.speed[0],
        }
    }
}

/// Fading of a moment at rest: 0 at rest, 1 above some rad/s.
pub(crate) fn fading(speed: f64) -> f64 {
    (speed / 0.5).tanh()
}

impl Table {
    /// M, its slope, and the fading at rest, all without sign.
    pub fn with_fading(&self, speed: f64) -> (f64, f64, f64) {
        let place = (speed.abs() * self.density).min(INTERVALS as f64 - 1e-9);
        let low = place as usize;
        let share = place - low as f64;
        let step = self.moment[low + 1] - self.moment[low];
        (
            self.moment[low] + step * share,
            step * self.density,
            self.fading[low] + (self.fading[low + 1] - self.fading[low]) * share,
        )
    }

    /// M, N m, and its slope, N m s, at a speed; odd.
    pub fn at(&self, speed: f64) -> (f64, f64) {
        let (moment, slope, _) = self.with_fading(speed);
        (moment.copysign(speed), slope)
    }
}

/// A curve that is known exactly, under 50 N.
#[cfg(test)]
pub(crate) fn known(speed: Vec<f64>, moment: Vec<f64>) -> SteadyMoment {
    SteadyMoment {
        load: 50.0,
        covariance: vec![vec![0.0; speed.len()]; speed.len()],
        speed,
        moment,
        scale_deviation: 0.0,
    }
}

#[cfg(test)]
#[path = "../../tests/unit/explain_steady.rs"]
mod tests;
