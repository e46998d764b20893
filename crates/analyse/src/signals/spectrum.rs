//! The spectrum of a torque reading, as far as it holds something.
//!
//! A reading is sampled far above what its sensor follows: over all frequencies the lines that matter would stand in the first
//! hundredths. The spectrum ends behind the last line above the floor, and behind the sensor's frequency and the shaft's orders,
//! and its lines are as fine as that leaves room for.

use measure::spectrum::{Spectrum, spectrum};

/// Values in a segment where nothing is known of the spectrum, at most.
const COARSE: usize = 2048;
/// Lines that a picture has use for.
const LINES: f64 = 512.0;
/// A line is one where it stands above the floor, the median of all, by this factor: the mean of seven segments of noise is below
/// it in all of 1e5 lines.
const ABOVE_FLOOR: f64 = 4.0;
/// Room behind the last line.
const ROOM: f64 = 1.5;
/// Segments without overlap that a record is cut into, at least.
const SEGMENTS: usize = 4;

/// Columns that are left where lines are made finer, at least.
pub(crate) const FEWEST_COLUMNS: usize = 32;

/// Values in a segment, at most.
pub(crate) const LONGEST: usize = 1 << 16;

/// Distance of two lines of the spectrogram over time at best, Hz.
pub(crate) fn resolved_over_time(count: usize, interval: f64) -> f64 {
    1.0 / ((count / FEWEST_COLUMNS).clamp(8, LONGEST) as f64 * interval)
}

/// Distance of two lines at best, Hz.
pub(crate) fn resolved(count: usize, interval: f64) -> f64 {
    1.0 / ((count / SEGMENTS).max(8) as f64 * interval)
}

/// The spectrum of a reading up to `highest`, Hz; where that is none, as far as it holds something and at least to `least`.
pub(crate) fn of(
    reading: &[f64],
    interval: f64,
    highest: Option<f64>,
    least: f64,
) -> Result<Spectrum, String> {
    let cut = |length| spectrum(reading, interval, length);
    let longest = (reading.len() / SEGMENTS).max(8);
    let coarse = longest.min(COARSE);
    let whole = cut(coarse)?;
    let end = highest.unwrap_or_else(|| (ROOM * last_line(&whole)).max(least));
    let wanted = (LINES / (end * interval)).min(longest as f64) as usize;
    // Longer segments are more often cut by gaps: then shorter ones.
    let finer = std::iter::successors(Some(wanted), |length| Some(length / 2));
    let mut found = finer
        .take_while(|length| *length > coarse)
        .find_map(|length| cut(length).ok())
        .unwrap_or(whole);
    let lines = found.frequency.partition_point(|f| *f <= end).max(2);
    for list in [
        &mut found.frequency,
        &mut found.density,
        &mut found.amplitude,
    ] {
        list.truncate(lines);
    }
    Ok(found)
}

/// The highest frequency whose line stands above the floor, Hz.
fn last_line(spectrum: &Spectrum) -> f64 {
    let mut sizes = spectrum.amplitude.clone();
    sizes.sort_by(f64::total_cmp);
    let floor = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let last = (spectrum.amplitude.iter()).rposition(|size| *size > ABOVE_FLOOR * floor);
    last.map_or(0.0, |last| spectrum.frequency[last])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// 20 s at 10 kHz: a line of 2 at 30 Hz, one of 0.3 at 47 Hz, and noise.
    fn reading() -> Vec<f64> {
        let mut state = 3u64;
        let mut uniform = || {
            state = (state.wrapping_mul(6364136223846793005)).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let values = (0..200_000).map(|k| {
            let time = f64::from(k) * 1e-4;
            2.0 * (TAU * 30.0 * time).sin() + 0.3 * (TAU * 47.0 * time).sin() + uniform() - 0.5
        });
        values.collect()
    }

    #[test]
    fn a_spectrum_ends_behind_its_last_line_and_is_fine() {
        let found = of(&reading(), 1e-4, None, 40.0).unwrap();
        let end = *found.frequency.last().unwrap();
        // the coarse lines are 4.9 Hz apart, and a Hann line is two of them wide
        assert!((70.0..100.0).contains(&end), "{end}");
        assert!(found.frequency.len() > 300, "{}", found.frequency.len());
        let at = |wanted: f64| {
            let near = (found.frequency.iter().zip(&found.amplitude))
                .filter(|(f, _)| (*f - wanted).abs() < 1.0);
            near.map(|(_, a)| *a).fold(0.0, f64::max)
        };
        // between two lines of a Hann window a sine loses up to 15 %
        assert!(at(30.0) > 1.7 && at(30.0) < 2.05, "{}", at(30.0));
        assert!(at(47.0) > 0.25 && at(47.0) < 0.32, "{}", at(47.0));
    }

    #[test]
    fn a_highest_frequency_is_kept_and_gaps_make_segments_shorter() {
        let mut values = reading();
        let found = of(&values, 1e-4, Some(400.0), 40.0).unwrap();
        let end = *found.frequency.last().unwrap();
        assert!(end <= 400.0 && end > 390.0, "{end}");
        values
            .iter_mut()
            .step_by(10_000)
            .for_each(|v| *v = f64::NAN);
        let found = of(&values, 1e-4, None, 40.0).unwrap();
        assert!(found.frequency.len() > 30 && found.amplitude.iter().all(|a| a.is_finite()));
    }
}
