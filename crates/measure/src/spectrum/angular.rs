//! Spectra over orders: the signal at equal angles of the shaft.

use super::transformed;
use crate::kernel::Kernel;
use crate::shaft::Shaft;
use problem::{note, note::Note};
use std::f64::consts::TAU;

/// How a signal is brought to equal angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngularSettings {
    /// Highest order that must be right.
    pub highest_order: f64,
    /// Turns in a segment: orders are separated down to about two over this.
    pub turns: usize,
    /// Speed below which the signal is left out, rad/s; positive.
    pub slowest: f64,
}

/// Spectra over order and turns.
#[derive(Clone, Debug)]
pub struct OrderSpectrogram {
    /// Time of the middle of each segment, s.
    pub time: Vec<f64>,
    /// Orders, cycles a turn.
    pub order: Vec<f64>,
    /// Amplitude that a sine at this order has in each segment, unit of the signal, peak.
    pub amplitude: Vec<Vec<f64>>,
    /// What is not trustworthy.
    pub notes: Vec<Note>,
}

/// Spectra over order of a signal with values at equal `interval` from the time `first` on, s.
///
/// Values at equal angles come from a band-limited kernel that also removes what would alias. The longest stretch is used in which
/// the shaft turns one way at `slowest` or faster. The error says what is missing.
pub fn order_spectrogram(
    signal: &[f64],
    first: f64,
    interval: f64,
    shaft: &Shaft,
    settings: &AngularSettings,
) -> Result<OrderSpectrogram, String> {
    shaft.check()?;
    if !(interval > 0.0 && interval.is_finite() && first.is_finite()) {
        return Err("the interval of the signal must be positive and finite".into());
    }
    let order_is_sound = settings.highest_order > 0.0 && settings.highest_order <= 1e4;
    if !(settings.slowest > 0.0 && order_is_sound && (1..=100_000).contains(&settings.turns)) {
        return Err(
            "slowest speed, highest order (up to 10 000) and turns must be positive".into(),
        );
    }
    let per_turn = ((2.56 * settings.highest_order).ceil() as usize).max(8);
    let length = per_turn * settings.turns;
    let end = first + signal.len().saturating_sub(1) as f64 * interval;
    let (from, to) = stretch(shaft, settings.slowest, first, end).ok_or_else(|| {
        format!(
            "the shaft never turns at {} rad/s or faster within the signal",
            settings.slowest
        )
    })?;
    let mut notes = Vec::new();
    let wanted = (shaft.angle_at(to) - shaft.angle_at(from)).abs() / TAU * per_turn as f64;
    if wanted > 8.0 * signal.len() as f64 {
        return Err(format!(
            "order {} needs {wanted:.0} values where the signal has {}",
            settings.highest_order,
            signal.len()
        ));
    }
    let times = equal_angles(shaft, from, to, per_turn);
    if times.len() < length {
        return Err(format!(
            "the shaft turns {:.1} times while it is fast enough; a segment has {} turns",
            times.len() as f64 / per_turn as f64,
            settings.turns
        ));
    }
    // Kernels for the spacings that occur, in steps of 6 %.
    let mut kernels: Vec<(i32, Kernel)> = Vec::new();
    let mut values = Vec::with_capacity(times.len());
    let mut slow = 0;
    for (k, &time) in times.iter().enumerate() {
        let spacing = if k > 0 {
            time - times[k - 1]
        } else {
            times[1] - time
        } / interval;
        let step = if spacing > 1.0 {
            (spacing.ln() / 0.06).ceil() as i32
        } else {
            0
        };
        if spacing < 0.8 * per_turn as f64 / (2.0 * settings.highest_order) / 1.28 {
            slow += 1;
        }
        let index = match kernels.iter().position(|(s, _)| *s == step) {
            Some(index) => index,
            None => {
                kernels.push((step, Kernel::new((0.06 * f64::from(step)).exp())));
                kernels.len() - 1
            }
        };
        values.push(
            kernels[index]
                .1
                .at(signal, (time - first) / interval)
                .unwrap_or(f64::NAN),
        );
    }
    let highest = settings.highest_order * shaft.fastest() / TAU;
    if highest * interval > 0.4 && slow > 0 {
        notes.push(note!(
            "order {} reaches {:.0} Hz, more than the signal holds ({:.0} Hz)",
            settings.highest_order,
            highest,
            0.4 / interval
        ));
    }
    let (mut time, mut amplitude) = (Vec::new(), Vec::new());
    let mut lost = 0;
    let mut raw = Vec::new();
    let transform = transformed(&values, length, |start, one| {
        let (a, b) = (times[start], times[start + length - 1]);
        time.push(0.5 * (a + b));
        raw.push(one);
    });
    let bandwidth = transform.squares / (transform.sum * transform.sum);
    for one in raw {
        amplitude.push(match one {
            Some(one) => one.iter().map(|d| (2.0 * d * bandwidth).sqrt()).collect(),
            None => {
                lost += 1;
                vec![f64::NAN; length / 2 + 1]
            }
        });
    }
    if lost > 0 {
        notes.push(note!(
            "{} of {} segments have missing values",
            lost,
            time.len()
        ));
    }
    let order: Vec<f64> = (0..=length / 2)
        .map(|k| k as f64 / settings.turns as f64)
        .collect();
    let kept = order
        .iter()
        .filter(|o| **o <= settings.highest_order)
        .count();
    for one in &mut amplitude {
        one.truncate(kept);
    }
    Ok(OrderSpectrogram {
        time,
        order: order[..kept].to_vec(),
        amplitude,
        notes,
    })
}

/// Longest stretch of time in which the shaft turns one way and fast enough.
fn stretch(shaft: &Shaft, slowest: f64, first: f64, last: f64) -> Option<(f64, f64)> {
    let mut best: Option<(f64, f64)> = None;
    let mut begin: Option<(usize, bool)> = None;
    for k in 0..=shaft.speed.len() {
        let way = shaft
            .speed
            .get(k)
            .filter(|s| s.abs() >= slowest)
            .map(|s| *s > 0.0);
        if let Some((start, forward)) = begin
            && way != Some(forward)
        {
            let time = |index: usize| shaft.first + index as f64 * shaft.interval;
            let (from, to) = (time(start).max(first), time(k - 1).min(last));
            if to > from && best.is_none_or(|(a, b)| to - from > b - a) {
                best = Some((from, to));
            }
            begin = None;
        }
        if begin.is_none() {
            begin = way.map(|forward| (k, forward));
        }
    }
    best
}

/// Times at which the shaft has turned by equal parts.
fn equal_angles(shaft: &Shaft, from: f64, to: f64, per_turn: usize) -> Vec<f64> {
    let start = shaft.angle_at(from);
    let way = if shaft.angle_at(to) >= start {
        1.0
    } else {
        -1.0
    };
    let part = TAU / per_turn as f64;
    let most = (((shaft.angle_at(to) - start).abs() / part) as usize).min(400_000_000);
    let mut times = Vec::with_capacity(most + 1);
    let mut time = from;
    for n in 0..=most {
        let target = n as f64 * part;
        let mut guess = time
            + if n > 0 {
                part / shaft.speed_at(time).abs().max(1e-12)
            } else {
                0.0
            };
        for _ in 0..3 {
            let miss = target - way * (shaft.angle_at(guess) - start);
            guess += miss / shaft.speed_at(guess).abs().max(1e-12);
            guess = guess.clamp(from, to);
        }
        time = guess.max(time);
        times.push(time);
    }
    times
}
