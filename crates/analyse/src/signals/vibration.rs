//! Orders and spectrograms of a vibration.

use crate::signals::read::Series;
use crate::signals::shaft;
use crate::signals::spectrum::{FEWEST_COLUMNS, LONGEST};
use measure::order::{Orders, orders};
use measure::spectrum::{AngularSettings, order_spectrogram, spectrogram};
use problem::{note, note::Note};
use recording::unit::unit_in_si;
use scenario::VibrationSignal;

/// Columns of a picture, at most.
const COLUMNS: usize = 90;
/// Rows of a picture, at most.
const ROWS: usize = 96;
/// Level that is shown as none, dB below the largest.
const FLOOR: f64 = -80.0;
/// Speed below which a spectrum over order is not taken, as a part of the largest.
const SLOW: f64 = 0.05;

/// Levels over two axes.
pub(crate) struct Picture {
    /// Time of each column, s.
    pub time: Vec<f64>,
    /// Frequency, Hz, or order of each row.
    pub upright: Vec<f64>,
    /// Levels column after column, whole dB below the largest.
    pub levels: Vec<f64>,
}

/// What a vibration shows.
pub(crate) struct Estimate {
    pub orders: Option<Orders>,
    pub over_time: Result<Picture, String>,
    pub over_order: Result<Picture, String>,
    pub notes: Vec<Note>,
}

impl Estimate {
    pub fn of(
        series: &Series,
        wish: &VibrationSignal,
        shaft: &shaft::Estimate,
    ) -> Result<Estimate, String> {
        let (unit, factor) = unit_in_si(&series.unit);
        let values: Vec<f64> = series.values.iter().map(|v| v * factor).collect();
        let (first, interval) = (series.first, series.interval);
        let turning = shaft.shaft();
        let mut notes = Vec::new();
        if unit == "1" {
            notes.push(note!(
                "the unit \"{}\" of the file is none of a length, speed or acceleration: amplitudes are in it",
                &series.unit
            ));
        }
        let found = match wish.orders.as_slice() {
            [] => None,
            wanted => Some(orders(
                &values,
                first,
                interval,
                &turning,
                wanted,
                wish.bandwidth,
            )?),
        };
        notes.extend(found.iter().flat_map(|found| found.notes.iter().cloned()));
        let highest = wish.highest_frequency.unwrap_or(f64::INFINITY);
        // Long enough to fill the columns, or the rows below the highest frequency where there are times enough for that.
        let columns = (values.len() / COLUMNS).next_power_of_two().clamp(64, 4096);
        let rows = (ROWS as f64 / (highest * interval)) as usize;
        let rows = rows.min(values.len() / FEWEST_COLUMNS).min(LONGEST);
        let length = columns.max(rows.next_power_of_two());
        let length = length.min(values.len().max(8));
        let over_time = spectrogram(&values, interval, length).map(|found| {
            let amplitudes = found.density.iter();
            let amplitudes = amplitudes.map(|d| d.iter().map(|v| v.sqrt()).collect());
            let time = found.time.iter().map(|t| first + t).collect();
            let lines = found.frequency.partition_point(|f| *f <= highest);
            let seen = amplitudes.map(|d: Vec<f64>| d[..lines.min(d.len())].to_vec());
            picture(time, &found.frequency[..lines], seen.collect())
        });
        let settings = AngularSettings {
            highest_order: wish.highest_order,
            turns: wish.turns,
            slowest: (SLOW * turning.fastest()).max(1e-3),
        };
        let over_order =
            order_spectrogram(&values, first, interval, &turning, &settings).map(|found| {
                notes.extend(found.notes.iter().cloned());
                picture(found.time, &found.order, found.amplitude)
            });
        Ok(Estimate {
            orders: found,
            over_time,
            over_order,
            notes,
        })
    }
}

/// The largest amplitudes in so many columns and rows as can be seen, in whole dB.
fn picture(time: Vec<f64>, upright: &[f64], amplitudes: Vec<Vec<f64>>) -> Picture {
    // A segment with missing values has no spectrum: it is left out.
    let seen = time.into_iter().zip(amplitudes);
    let (time, amplitudes): (Vec<f64>, Vec<Vec<f64>>) = seen
        .filter(|(_, column)| column.iter().any(|v| v.is_finite()))
        .unzip();
    let wide = time.len().div_ceil(COLUMNS).max(1);
    let high = upright.len().div_ceil(ROWS).max(1);
    let middle = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let largest = amplitudes.iter().flatten().copied().fold(0.0, f64::max);
    let mut levels = Vec::new();
    for columns in amplitudes.chunks(wide) {
        for row in (0..upright.len()).step_by(high) {
            let cells = columns.iter().flat_map(|column| {
                let end = (row + high).min(column.len());
                column.get(row..end).unwrap_or(&[]).iter().copied()
            });
            let most = cells.fold(0.0, f64::max);
            let level = 20.0 * (most / largest).log10();
            levels.push(if level >= FLOOR {
                level.round() + 0.0
            } else {
                FLOOR
            });
        }
    }
    Picture {
        time: time.chunks(wide).map(middle).collect(),
        upright: upright.chunks(high).map(middle).collect(),
        levels,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_keeps_its_lines_when_it_is_made_small() {
        let time: Vec<f64> = (0..1000).map(f64::from).collect();
        let upright: Vec<f64> = (0..500).map(f64::from).collect();
        let mut amplitudes = vec![vec![1e-9; 500]; 1000];
        amplitudes.iter_mut().for_each(|column| column[250] = 2.0);
        amplitudes[999][100] = 0.2;
        let made = picture(time, &upright, amplitudes);
        assert!(made.time.len() <= COLUMNS && made.upright.len() <= ROWS);
        assert_eq!(made.levels.len(), made.time.len() * made.upright.len());
        let rows = made.upright.len();
        let line = made.upright.iter().position(|u| *u + 3.0 > 250.0).unwrap();
        assert!((0..made.time.len()).all(|column| made.levels[column * rows + line] == 0.0));
        assert_eq!(
            made.levels.iter().filter(|level| **level == -20.0).count(),
            1
        );
        assert!(made.levels.iter().all(|level| *level >= FLOOR));
    }
}
