//! The fit of a decaying swing about a level.

use problem::{note, note::Note};
use statistics::linear::solved;
use statistics::simplex;
use std::f64::consts::TAU;

/// Values after the force has ended.
pub(super) struct Data<'a> {
    pub(super) values: &'a [f64],
    /// s.
    pub(super) interval: f64,
}

/// The linear part of a fit: level, cosine, sine.
pub(super) struct Fit {
    pub(super) linear: [f64; 3],
    pub(super) squares: f64,
}

/// Damping from the variable of the search, which runs over all numbers.
pub(super) fn damping_of(variable: f64) -> f64 {
    (1.0 / (1.0 + (-variable).exp())).clamp(1e-6, 0.999)
}

impl Data<'_> {
    /// Calls `each` with decay·cos, decay·sin and the value at every time that has one.
    fn walk(&self, frequency: f64, damping: f64, mut each: impl FnMut(usize, f64, f64, f64)) {
        let omega = TAU * frequency;
        let decay = (-damping * omega * self.interval).exp();
        let (sine, cosine) = (omega * (1.0 - damping * damping).sqrt() * self.interval).sin_cos();
        let (mut c, mut s) = (1.0_f64, 0.0_f64);
        for (k, &value) in self.values.iter().enumerate() {
            if value.is_finite() {
                each(k, c, s, value);
            }
            (c, s) = (
                decay * (c * cosine - s * sine),
                decay * (s * cosine + c * sine),
            );
            if c.abs() + s.abs() < 1e-100 {
                (c, s) = (0.0, 0.0);
            }
        }
    }

    pub(super) fn fit(&self, frequency: f64, damping: f64) -> Option<Fit> {
        let mut a = [[0.0; 3]; 3];
        let mut b = [0.0; 3];
        let mut power = 0.0;
        self.walk(frequency, damping, |_, c, s, value| {
            a[0][0] += 1.0;
            a[0][1] += c;
            a[0][2] += s;
            a[1][1] += c * c;
            a[1][2] += c * s;
            a[2][2] += s * s;
            b[0] += value;
            b[1] += c * value;
            b[2] += s * value;
            power += value * value;
        });
        a[1][0] = a[0][1];
        a[2][0] = a[0][2];
        a[2][1] = a[1][2];
        let linear = solved(&a, &b)?;
        let squares = power - (0..3).map(|i| linear[i] * b[i]).sum::<f64>();
        Some(Fit {
            linear,
            squares: squares.max(0.0),
        })
    }

    /// Logarithm of frequency and variable of damping of the best fit, and the noise seen in second differences.
    pub(super) fn search(&self) -> Result<([f64; 2], f64), String> {
        let block = self.values.len().div_ceil(2048);
        let coarse: Vec<f64> = self
            .values
            .chunks(block)
            .map(|part| part.iter().sum::<f64>() / part.len() as f64)
            .collect();
        let thin = Data {
            values: &coarse,
            interval: self.interval * block as f64,
        };
        let (low, high) = (
            0.7 / (self.values.len() as f64 * self.interval),
            0.4 / thin.interval,
        );
        let mut best: Option<(f64, [f64; 2])> = None;
        let mut frequency = low;
        while frequency < high {
            for damping in [0.003, 0.01, 0.03, 0.1, 0.2, 0.4, 0.65, 0.85_f64] {
                let fit = thin
                    .fit(frequency, damping)
                    .filter(|f| f.squares.is_finite());
                if let Some(fit) = fit
                    && best.is_none_or(|(squares, _)| fit.squares < squares)
                {
                    best = Some((
                        fit.squares,
                        [frequency.ln(), (damping / (1.0 - damping)).ln()],
                    ));
                }
            }
            frequency *= 1.04;
        }
        let (_, start) = best.ok_or("no frequency fits the free response")?;
        Ok((self.refined(start), self.noise()))
    }

    /// The best fit near another one.
    pub(super) fn refined(&self, start: [f64; 2]) -> [f64; 2] {
        simplex::lowest(start, [0.02, 0.3], 1e-12, 300, |p| {
            self.fit(p[0].exp(), damping_of(p[1]))
                .map_or(f64::INFINITY, |f| (f.squares.max(1e-300)).ln())
        })
        .0
    }

    /// What a swing leaves of the values; NaN where there is none.
    pub(super) fn residual(&self, point: &[f64; 2], fit: &Fit) -> Vec<f64> {
        let mut left = vec![f64::NAN; self.values.len()];
        let [level, cosine, sine] = fit.linear;
        self.walk(point[0].exp(), damping_of(point[1]), |k, c, s, value| {
            left[k] = value - level - cosine * c - sine * s;
        });
        left
    }

    fn noise(&self) -> f64 {
        // Third differences let a slow swing pass by less than second ones.
        crate::quantile::noise(self.values, [-1.0, 3.0, -3.0, 1.0])
    }

    /// Variances of ln f, of the damping's variable and of the level, residuals correlated up to 15 values apart.
    pub(super) fn covariance(&self, point: &[f64; 2], fit: &Fit) -> Option<[f64; 3]> {
        let [level, cosine, sine] = fit.linear;
        let curve = |p: [f64; 2]| {
            let mut values = Vec::with_capacity(self.values.len());
            self.walk(p[0].exp(), damping_of(p[1]), |_, c, s, _| {
                values.push((c, s))
            });
            values
        };
        let base = curve(*point);
        let seen: Vec<f64> = self
            .values
            .iter()
            .copied()
            .filter(|v| v.is_finite())
            .collect();
        let residual: Vec<f64> = base
            .iter()
            .zip(&seen)
            .map(|(&(c, s), v)| v - level - cosine * c - sine * s)
            .collect();
        let h = 1e-5;
        let moved = [0, 1].map(|axis| {
            let mut up = *point;
            let mut down = *point;
            up[axis] += h;
            down[axis] -= h;
            let (up, down) = (curve(up), curve(down));
            up.iter()
                .zip(&down)
                .map(|(u, d)| (cosine * (u.0 - d.0) + sine * (u.1 - d.1)) / (2.0 * h))
                .collect::<Vec<f64>>()
        });
        let rows: Vec<[f64; 5]> = (0..base.len())
            .map(|k| [moved[0][k], moved[1][k], 1.0, base[k].0, base[k].1])
            .collect();
        let lags = 15.min(rows.len() / 8);
        let count = rows.len() as f64;
        let covary = |lag: usize| {
            residual
                .iter()
                .zip(residual.iter().skip(lag))
                .map(|(a, b)| a * b)
                .sum::<f64>()
                / (count - 5.0).max(1.0)
        };
        let mut normal = [[0.0; 5]; 5];
        let mut meat = [[0.0; 5]; 5];
        for lag in 0..=lags {
            let weight = covary(lag) * (1.0 - lag as f64 / (lags + 1) as f64);
            for (a, b) in rows.iter().zip(rows.iter().skip(lag)) {
                for i in 0..5 {
                    for j in 0..5 {
                        let pair = a[i] * b[j];
                        if lag == 0 {
                            normal[i][j] += pair;
                            meat[i][j] += weight * pair;
                        } else {
                            meat[i][j] += weight * (pair + a[j] * b[i]);
                        }
                    }
                }
            }
        }
        let mut variances = [0.0; 3];
        for (index, variance) in variances.iter_mut().enumerate() {
            let mut unit = [0.0; 5];
            unit[index] = 1.0;
            let row = solved(&normal, &unit)?;
            let sum: f64 = (0..5)
                .map(|i| (0..5).map(|j| row[i] * meat[i][j] * row[j]).sum::<f64>())
                .sum();
            let white = row[index] * covary(0);
            // Negative correlation is not credited.
            *variance = sum.max(white);
            if !variance.is_finite() || *variance < 0.0 {
                return None;
            }
        }
        Some(variances)
    }

    /// Whether the large swings have another frequency than the small ones.
    pub(super) fn drift(&self, frequency: f64, damping: f64) -> Option<Note> {
        let split = (1.0 / (TAU * frequency * damping * self.interval)) as usize;
        let period = 1.0 / (frequency * self.interval);
        if split < 32 || self.values.len() < split + 32 || (split as f64) < 1.5 * period {
            return None;
        }
        let end = (3 * split).min(self.values.len());
        let start = [frequency.ln(), (damping / (1.0 - damping)).ln()];
        let mut found = [(0.0, 0.0); 2];
        for (part, values) in found
            .iter_mut()
            .zip([&self.values[..split], &self.values[split..end]])
        {
            let data = Data {
                values,
                interval: self.interval,
            };
            let (point, _) = simplex::lowest(start, [0.01, 0.1], 1e-10, 200, |p| {
                data.fit(p[0].exp(), damping_of(p[1]))
                    .map_or(f64::INFINITY, |f| (f.squares.max(1e-300)).ln())
            });
            let fit = data.fit(point[0].exp(), damping_of(point[1]))?;
            *part = (point[0], data.covariance(&point, &fit)?[0]);
        }
        let difference = found[0].0 - found[1].0;
        let deviation = (found[0].1 + found[1].1).sqrt();
        (difference.abs() > 4.0 * deviation).then(|| {
            note!(
                "large swings have a frequency {:.2} % {} than small ones: the sensor is not linear",
                100.0 * difference.abs(), if difference > 0.0 { "higher" } else { "lower" }
            )
        })
    }
}
