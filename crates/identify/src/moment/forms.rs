//! The forms of a steady moment that are set against each other, as sums of given shapes.

use super::settings::Form;
use crate::regression::spline::{self, SPLINES};
use nalgebra::DMatrix;
use physics::palmgren::viscous_moment;
use physics::rolling::RollingSet;

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
        viscosity: Option<f64>,
        set: &RollingSet<f64>,
        range: (f64, f64),
        speeds: &[f64],
    ) -> Vec<Self> {
        let pitch_diameter = 2.0 * set.inner_track_radius * (1.0 + set.ball_ratio);
        let mut all = Vec::new();
        let viscosities = match viscosity {
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
        all.push((Form::Skf, Shapes::Powers));
        all.push((Form::Spline, Shapes::Spline { range }));
        all.into_iter()
            .map(|(form, shapes)| Self::new(form, shapes, viscosity.is_some(), speeds))
            .collect()
    }

    fn new(form: Form, shapes: Shapes, viscosity_is_known: bool, speeds: &[f64]) -> Self {
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
            Shapes::Palmgren { viscosity, .. } if !viscosity_is_known => vec![
                (
                    "f0 ν^(2/3)",
                    "(mm²/s)^(2/3)",
                    (1e6 * viscosity).powf(2.0 / 3.0),
                ),
                ("M1", "N m", 1.0),
            ],
            Shapes::Palmgren { .. } => vec![("f0", "1", 1.0), ("M1", "N m", 1.0)],
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

    /// The shapes at speeds, a row for each.
    pub(super) fn rows(&self, speeds: &[f64]) -> DMatrix<f64> {
        let rows = speeds.iter().flat_map(|&speed| self.shapes.row(speed));
        let mut rows = DMatrix::from_row_iterator(speeds.len(), self.scales.len(), rows);
        for (mut column, scale) in rows.column_iter_mut().zip(&self.scales) {
            column /= *scale;
        }
        rows
    }

    /// Prior precisions of the coefficients, each as likely as the others.
    pub(super) fn precisions(&self, level: f64) -> Vec<DMatrix<f64>> {
        let size = self.scales.len();
        match self.shapes {
            Shapes::Spline { .. } => spline::precisions(level, 2, &SMOOTHNESS),
            _ => vec![DMatrix::from_diagonal_element(size, size, level.powi(-2))],
        }
    }
}

impl Shapes {
    fn row(&self, speed: f64) -> Vec<f64> {
        match self {
            Shapes::Palmgren {
                viscosity,
                pitch_diameter,
            } => vec![viscous_moment(1.0, *viscosity, speed, *pitch_diameter), 1.0],
            Shapes::Powers => {
                let part = speed / 100.0;
                vec![part.powf(0.6), 1.0, part * part]
            }
            Shapes::Spline { range } => spline::row(speed, *range, 0),
        }
    }
}
