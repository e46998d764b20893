//! The least deviations of a record without a quick change: those of the stiffest fit.
//!
//! ```text
//! φ(t) = Σₖ cₖ xᵏ, k = 0 … 3, by least squares through all pulses;  x = (t - t̄)/h;  weights 1/(Ω u)²
//! ```
//! The smoothing spline of a speed that changes evenly becomes this cubic; its own covariance is then a difference of numbers
//! that are nearly alike and may be lost in rounding. A spline that is less stiff leaves more open, so that the larger deviation
//! of the two is the true one.
//!
//! **Does not model**: errors of the marks, and noise of the instants that is correlated.

use statistics::linear::inverse;

/// Coefficients of the cubic.
const SIZE: usize = 4;

/// Covariance of the coefficients of a cubic.
#[derive(Clone, Debug)]
pub(super) struct Stiffest {
    middle: f64,
    /// Half the length, s.
    half: f64,
    /// rad².
    covariance: [[f64; SIZE]; SIZE],
}

impl Stiffest {
    /// That of angles at some instants, s, with their deviations, rad. None where they are too few for a cubic.
    pub fn of_angles(times: &[f64], deviations: &[f64]) -> Option<Stiffest> {
        Stiffest::of(times, deviations, 0)
    }

    /// The same of speeds, rad/s. They say nothing of the angle.
    pub fn of_speeds(times: &[f64], deviations: &[f64]) -> Option<Stiffest> {
        Stiffest::of(times, deviations, 1)
    }

    /// From derivatives of the angle of an order, 0 or 1.
    fn of(times: &[f64], deviations: &[f64], order: i32) -> Option<Stiffest> {
        let (from, to) = (*times.first()?, *times.last()?);
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let mut square = [[0.0; SIZE]; SIZE];
        for (time, deviation) in times.iter().zip(deviations) {
            let weight = 1.0 / (deviation * half.powi(order)).powi(2);
            if !weight.is_finite() {
                continue;
            }
            let x = (time - middle) / half;
            let row = if order == 0 { powers(x) } else { rates(x) };
            for (i, line) in square.iter_mut().enumerate() {
                for (j, value) in line.iter_mut().enumerate() {
                    *value += weight * row[i] * row[j];
                }
            }
        }
        if order == 1 {
            // The angle takes part in no speed: any variance of it will do.
            square[0][0] = square[1][1];
        }
        Some(Stiffest {
            middle,
            half,
            covariance: inverse(square, 1e-12)?,
        })
    }

    /// Variance of the derivative of the angle of an order, 1 (speed, rad²/s²) or 2 (acceleration, rad²/s⁴), at a time of
    /// the record.
    pub fn variance(&self, order: i32, time: f64) -> f64 {
        let x = ((time - self.middle) / self.half).clamp(-1.0, 1.0);
        let row = match order {
            1 => rates(x),
            _ => [0.0, 0.0, 2.0, 6.0 * x],
        };
        let lines = row.iter().zip(&self.covariance);
        let variance: f64 = lines
            .map(|(a, line)| a * line.iter().zip(&row).map(|(c, b)| c * b).sum::<f64>())
            .sum();
        variance.max(0.0) / self.half.powi(2 * order)
    }
}

/// Derivatives of the powers.
fn rates(x: f64) -> [f64; SIZE] {
    [0.0, 1.0, 2.0 * x, 3.0 * x * x]
}

fn powers(x: f64) -> [f64; SIZE] {
    [1.0, x, x * x, x * x * x]
}
