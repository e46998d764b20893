//! The forms of a steady moment that are set against each other, as sums of given shapes.

use super::{Form, MomentSettings};
use crate::dense::{Matrix, zeros};
use physics::palmgren::viscous_moment;
use physics::rolling::RollingSet;
use physics::skf::SkfMoment;

/// Number of B-splines.
const SPLINES: usize = 16;

/// Standard deviations of second differences of the coefficients of a spline, as parts of the level, that are tried.
const SMOOTHNESS: [f64; 6] = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3];

/// Viscosities that are tried where none is given, mm²/s: of greases' oils from hot to cold.
const VISCOSITIES: [f64; 12] = [
    5.0, 8.0, 12.0, 18.0, 27.0, 40.0, 60.0, 90.0, 135.0, 200.0, 300.0, 450.0,
];

/// A coefficient that has a meaning.
#[derive(Clone, Debug)]
pub(super) struct Meaning {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    /// Parameter over coefficient.
    pub(super) factor: f64,
}

/// Shapes over speed.
#[derive(Clone, Copy, Debug)]
enum Shapes {
    Palmgren { viscosity: f64, pitch_diameter: f64 },
    Skf { law: SkfMoment<f64>, load: f64 },
    Powers,
    Spline { range: (f64, f64) },
}

/// A form with its numbers.
pub(super) struct Member {
    pub(super) form: Form,
    shapes: Shapes,
    /// Each shape is divided by its root mean square over the data, so that one prior suits all.
    scales: Vec<f64>,
    pub(super) meanings: Vec<Meaning>,
}

impl Member {
    /// All forms that can be tried.
    pub(super) fn all(
        settings: &MomentSettings,
        set: &RollingSet<f64>,
        load: f64,
        range: (f64, f64),
        speeds: &[f64],
    ) -> Vec<Self> {
        let pitch_diameter = 2.0 * set.inner_track_radius * (1.0 + set.ball_ratio);
        let mut all = Vec::new();
        let viscosities = match settings.viscosity {
            Some(viscosity) => vec![viscosity],
            None => VISCOSITIES.iter().map(|nu_mm2_s| 1e-6 * nu_mm2_s).collect(),
        };
        for viscosity in viscosities {
            all.push((
                Form::Palmgren,
                Shapes::Palmgren {
                    viscosity,
                    pitch_diameter,
                },
            ));
        }
        all.push((
            Form::Skf,
            match settings.skf {
                Some(law) => Shapes::Skf { law, load },
                None => Shapes::Powers,
            },
        ));
        all.push((Form::Spline, Shapes::Spline { range }));
        all.into_iter()
            .map(|(form, shapes)| Self::new(form, shapes, settings, speeds))
            .collect()
    }

    fn new(form: Form, shapes: Shapes, settings: &MomentSettings, speeds: &[f64]) -> Self {
        let mut squares = vec![0.0; shapes.row(speeds[0]).len()];
        for &speed in speeds {
            for (square, value) in squares.iter_mut().zip(shapes.row(speed)) {
                *square += value * value / speeds.len() as f64;
            }
        }
        let scales: Vec<f64> = match shapes {
            Shapes::Spline { .. } => vec![1.0; SPLINES],
            _ => squares
                .iter()
                .map(|s| if *s > 0.0 { s.sqrt() } else { 1.0 })
                .collect(),
        };
        let named: Vec<(&'static str, &'static str, f64)> = match shapes {
            Shapes::Palmgren { viscosity, .. } if settings.viscosity.is_none() => vec![
                (
                    "f0 ν^(2/3)",
                    "(mm²/s)^(2/3)",
                    (1e6 * viscosity).powf(2.0 / 3.0),
                ),
                ("M1", "N m", 1.0),
            ],
            Shapes::Palmgren { .. } => vec![("f0", "1", 1.0), ("M1", "N m", 1.0)],
            Shapes::Skf { .. } => vec![
                ("rolling", "of the law's", 1.0),
                ("sliding", "of the law's", 1.0),
                ("drag", "of the law's", 1.0),
            ],
            Shapes::Powers => vec![
                ("rolling at 100 rad/s", "N m", 1.0),
                ("sliding", "N m", 1.0),
                ("drag at 100 rad/s", "N m", 1.0),
            ],
            Shapes::Spline { .. } => Vec::new(),
        };
        let meanings = named
            .into_iter()
            .zip(&scales)
            .map(|((name, unit, factor), scale)| Meaning {
                name,
                unit,
                factor: factor / scale,
            })
            .collect();
        Self {
            form,
            shapes,
            scales,
            meanings,
        }
    }

    /// Viscosity of Palmgren's floor, m²/s.
    pub(super) fn viscosity(&self) -> Option<f64> {
        match self.shapes {
            Shapes::Palmgren { viscosity, .. } => Some(viscosity),
            _ => None,
        }
    }

    /// The shapes at a speed.
    pub(super) fn row(&self, speed: f64) -> Vec<f64> {
        self.shapes
            .row(speed)
            .into_iter()
            .zip(&self.scales)
            .map(|(value, scale)| value / scale)
            .collect()
    }

    /// Prior precisions of the coefficients, each as likely as the others.
    pub(super) fn precisions(&self, level: f64) -> Vec<Matrix> {
        let size = self.scales.len();
        if !matches!(self.shapes, Shapes::Spline { .. }) {
            let mut precision = zeros(size, size);
            for (i, row) in precision.iter_mut().enumerate() {
                row[i] = level.powi(-2);
            }
            return vec![precision];
        }
        // Level and slope of the coefficients as wide as the level; their second differences as smooth as is tried.
        let count = SPLINES as f64;
        let middle = 0.5 * (count - 1.0);
        let spread = (0..SPLINES)
            .map(|i| (i as f64 - middle).powi(2))
            .sum::<f64>();
        SMOOTHNESS
            .iter()
            .map(|part| {
                let mut precision = zeros(size, size);
                for (i, row) in precision.iter_mut().enumerate() {
                    for (j, value) in row.iter_mut().enumerate() {
                        let slopes = (i as f64 - middle) * (j as f64 - middle) / spread;
                        *value = (1.0 / count + slopes) / (count * level * level);
                    }
                }
                let weight = (part * level).powi(-2);
                for first in 0..size - 2 {
                    let difference = [1.0, -2.0, 1.0];
                    for (i, a) in difference.iter().enumerate() {
                        for (j, b) in difference.iter().enumerate() {
                            precision[first + i][first + j] += weight * a * b;
                        }
                    }
                }
                precision
            })
            .collect()
    }
}

impl Shapes {
    fn row(&self, speed: f64) -> Vec<f64> {
        match self {
            Shapes::Palmgren {
                viscosity,
                pitch_diameter,
            } => vec![viscous_moment(1.0, *viscosity, speed, *pitch_diameter), 1.0],
            Shapes::Skf { law, load } => {
                let inside = law.intermediates(speed, *load, 0.0);
                let mut row = vec![
                    1e-3 * inside.inlet_shear_factor
                        * inside.starvation_factor
                        * inside.rolling_moment,
                    1e-3 * inside.sliding_moment,
                ];
                if law.drag > 0.0 {
                    row.push(1e-3 * inside.drag_moment);
                }
                row
            }
            Shapes::Powers => {
                let part = speed / 100.0;
                vec![part.powf(0.6), 1.0, part * part]
            }
            Shapes::Spline { range } => spline(speed, *range),
        }
    }
}

/// Cubic B-splines on equal knots.
fn spline(speed: f64, range: (f64, f64)) -> Vec<f64> {
    let pieces = SPLINES - 3;
    let place = (speed - range.0) / (range.1 - range.0) * pieces as f64;
    let place = place.clamp(0.0, pieces as f64);
    let first = (place as usize).min(pieces - 1);
    let u = place - first as f64;
    let v = 1.0 - u;
    let mut row = vec![0.0; SPLINES];
    row[first] = v * v * v / 6.0;
    row[first + 1] = (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0;
    row[first + 2] = (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0;
    row[first + 3] = u * u * u / 6.0;
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splines_sum_to_one_and_follow_a_straight_line() {
        for speed in [10.0, 17.3, 60.0, 99.9, 110.0] {
            let row = spline(speed, (10.0, 110.0));
            assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-14);
            // Coefficients on the line of the knots' averages give the line: width 100/13 a piece, first average one before.
            let width = 100.0 / 13.0;
            let line: f64 = row
                .iter()
                .enumerate()
                .map(|(i, w)| w * (10.0 + width * (i as f64 - 1.0)))
                .sum();
            assert!((line - speed).abs() < 1e-12);
        }
    }
}
