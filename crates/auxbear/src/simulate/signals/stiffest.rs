//! What the pulses of a record without a quick change cannot tell better than: the deviations of the stiffest fit.
//!
//! ```text
//! φ(t) = Σₖ cₖ xᵏ, k = 0 … 3, by least squares through all pulses;  x = (t - t̄)/h;  weights 1/(Ω u)²
//! ```
//! The smoothing spline of a speed that changes evenly becomes this cubic; its own covariance is then a difference of numbers
//! that are nearly alike and may be lost in rounding. A spline that is less stiff tells less, so that the larger deviation
//! of the two is the true one.
//!
//! **Does not model**: errors of the marks, and noise of the instants that is correlated.

use measure::pulse::Pulses;
use measure::speed::Speed;

/// Coefficients of the cubic.
const SIZE: usize = 4;

/// Covariance of the coefficients of a cubic.
pub(super) struct Stiffest {
    middle: f64,
    /// Half the length, s.
    half: f64,
    /// rad².
    covariance: [[f64; SIZE]; SIZE],
}

impl Stiffest {
    /// None where pulses are too few for a cubic.
    pub fn of(pulses: &Pulses, speed: &Speed) -> Option<Stiffest> {
        let (from, to) = (*pulses.times.first()?, *pulses.times.last()?);
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let mut square = [[0.0; SIZE]; SIZE];
        for (time, uncertainty) in pulses.times.iter().zip(&pulses.uncertainties) {
            let spread = speed.at(*time).speed * uncertainty * speed.timing_factor;
            let powers = powers((time - middle) / half);
            let weight = 1.0 / (spread * spread);
            if !weight.is_finite() {
                continue;
            }
            for (i, line) in square.iter_mut().enumerate() {
                for (j, value) in line.iter_mut().enumerate() {
                    *value += weight * powers[i] * powers[j];
                }
            }
        }
        Some(Stiffest {
            middle,
            half,
            covariance: inverse(square)?,
        })
    }

    /// Standard deviation of the derivative of the angle of an order, 1 or 2, at a time of the record.
    fn deviation(&self, order: i32, time: f64) -> f64 {
        let x = ((time - self.middle) / self.half).clamp(-1.0, 1.0);
        let row = match order {
            1 => [0.0, 1.0, 2.0 * x, 3.0 * x * x],
            _ => [0.0, 0.0, 2.0, 6.0 * x],
        };
        let lines = row.iter().zip(&self.covariance);
        let variance: f64 = lines
            .map(|(a, line)| a * line.iter().zip(&row).map(|(c, b)| c * b).sum::<f64>())
            .sum();
        variance.max(0.0).sqrt() / self.half.powi(order)
    }

    /// Standard deviation of the speed, rad/s.
    pub fn speed(&self, time: f64) -> f64 {
        self.deviation(1, time)
    }

    /// Standard deviation of the acceleration, rad/s².
    pub fn acceleration(&self, time: f64) -> f64 {
        self.deviation(2, time)
    }
}

fn powers(x: f64) -> [f64; SIZE] {
    [1.0, x, x * x, x * x * x]
}

/// Inverse of a symmetric positive matrix, by elimination; none if it is not positive.
fn inverse(mut a: [[f64; SIZE]; SIZE]) -> Option<[[f64; SIZE]; SIZE]> {
    let largest = a[0][0];
    for p in 0..SIZE {
        let pivot = a[p][p];
        if pivot.is_nan() || pivot <= 1e-12 * largest {
            return None;
        }
        a[p][p] = 1.0;
        a[p].iter_mut().for_each(|value| *value /= pivot);
        let row = a[p];
        for (_, line) in a.iter_mut().enumerate().filter(|(i, _)| *i != p) {
            let factor = line[p];
            line[p] = 0.0;
            line.iter_mut()
                .zip(&row)
                .for_each(|(x, r)| *x -= factor * r);
        }
    }
    Some(a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inverse_is_one() {
        let a = [
            [4.0, 1.0, 0.5, 0.0],
            [1.0, 3.0, 0.2, 0.1],
            [0.5, 0.2, 2.0, 0.3],
            [0.0, 0.1, 0.3, 1.0],
        ];
        let b = inverse(a).unwrap();
        for (i, line) in a.iter().enumerate() {
            for j in 0..SIZE {
                let product: f64 = line.iter().zip(&b).map(|(x, row)| x * row[j]).sum();
                assert!((product - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
        }
        assert!(inverse([[1.0; SIZE]; SIZE]).is_none());
    }
}
