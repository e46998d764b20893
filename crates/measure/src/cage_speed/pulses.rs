//! Cage speed from the times at which balls pass a sensor.

use super::phase::Deviations;
use super::{CageSpeed, QuickChange};
use crate::quantile::median;
use crate::shaft::Shaft;
use problem::{note, note::Note};
use std::f64::consts::TAU;

/// Time after an engagement in which no passing is taken to be missing, s.
const LAG: f64 = 0.15;

/// Speed of a cage from the times at which its balls pass a sensor at rest.
///
/// `passings` in s, in order; `balls` the number of balls; `ratio` the speed of a rolling cage over that of the shaft, 1;
/// `change` a quick change of the shaft's speed, after whose begin slip may change fast. Missing and double passings are reported (missing ones not
/// within 0.15 s after the engagement, where the cage may lag); errors of the ball
/// spacing that repeat with the cage are taken out where the record is long enough. The list holds one value a passing, and for
/// half a second after an engagement values every 2 ms between them: the cage rises there while hardly a ball passes.
pub fn from_pulses(
    passings: &[f64],
    shaft: &Shaft,
    balls: usize,
    ratio: f64,
    change: Option<QuickChange>,
) -> Result<CageSpeed, String> {
    shaft.check()?;
    let engagement = change.map(|change| change.engagement);
    if balls == 0 || balls > 10_000 {
        return Err(format!("{balls} balls are not a bearing"));
    }
    if !(ratio > 0.0 && ratio.is_finite()) {
        return Err("the ratio of cage and shaft speed must be positive and finite".into());
    }
    if passings.iter().any(|t| !t.is_finite()) || passings.windows(2).any(|w| w[1] < w[0]) {
        return Err("the times of passings must be finite and in order".into());
    }
    let mut notes = Vec::new();
    let inside: Vec<f64> = passings
        .iter()
        .copied()
        .filter(|&t| shaft.covers(t))
        .collect();
    if inside.len() < passings.len() {
        notes.push(note!(
            "{} passings lie outside the record of the shaft and were left out",
            passings.len() - inside.len()
        ));
    }
    if inside.len() < 8 {
        return Err(format!(
            "{} passings of balls are usable; at least 8 are needed",
            inside.len()
        ));
    }
    let pitch = TAU / balls as f64;
    let rolled: Vec<f64> = inside.iter().map(|&t| ratio * shaft.angle_at(t)).collect();
    let (time, index, expected) = counted(&inside, &rolled, pitch, engagement, &mut notes);
    let cage: Vec<f64> = index.iter().map(|&n| n as f64 * pitch).collect();
    let mut deviation: Vec<f64> = cage.iter().zip(&expected).map(|(c, r)| c - r).collect();
    let weight = vec![1.0; time.len()];
    let turns = (index[index.len() - 1] - index[0]) as f64 / balls as f64;
    if turns >= 6.0 {
        let spread = spacing(&mut deviation, &index, balls);
        if spread > 0.1 * pitch {
            notes.push(note!(
                "the balls' spacing differs by {:.1} % of a pitch rms",
                100.0 * spread / pitch
            ));
        }
    } else {
        notes.push(note!(
            "{:.1} turns of the cage are too few to take out errors of the ball spacing",
            turns
        ));
    }
    let data = Deviations {
        time: &time,
        deviation: &deviation,
        weight: &weight,
        removed: &[],
        engagement,
        lock: change.and_then(|change| change.lock),
        from_rest: false,
    };
    data.smoothed(shaft, ratio, notes)
}

/// Times, counts of balls and angles of a rolling cage, without doubles and with gaps counted.
fn counted(
    time: &[f64],
    rolled: &[f64],
    pitch: f64,
    engagement: Option<f64>,
    notes: &mut Vec<Note>,
) -> (Vec<f64>, Vec<i64>, Vec<f64>) {
    // Pitches that a rolling cage would have gone between passings; 1/(1 - slip) where none is missing.
    let advance: Vec<f64> = rolled
        .windows(2)
        .map(|w| ((w[1] - w[0]) / pitch).abs())
        .collect();
    let (mut times, mut index, mut expected) = (vec![time[0]], vec![0_i64], vec![rolled[0]]);
    let (mut missing, mut doubles) = (0, 0);
    let mut since = 0.0;
    for (k, &step) in advance.iter().enumerate() {
        since += step;
        let near = &advance[k.saturating_sub(5)..(k + 6).min(advance.len())];
        let usual = median(near.iter().copied()).max(1e-9);
        let passed = (since / usual).round().min(1e6) as i64;
        // After an engagement the cage may lag by several pitches: every passing is taken as the next.
        let lagging = engagement.is_some_and(|e| time[k + 1] > e && time[k + 1] < e + LAG);
        let passed = if lagging { passed.min(1) } else { passed };
        if passed == 0 {
            doubles += 1;
            continue;
        }
        missing += passed - 1;
        times.push(time[k + 1]);
        index.push(index[index.len() - 1] + passed);
        expected.push(rolled[k + 1]);
        since = 0.0;
    }
    if missing > 0 {
        notes.push(note!("{} passings are missing", missing));
    }
    if doubles > 0 {
        notes.push(note!("{} passings came double and were left out", doubles));
    }
    (times, index, expected)
}

/// Takes out what repeats with every turn of the cage; returns its rms, rad.
fn spacing(deviation: &mut [f64], index: &[i64], balls: usize) -> f64 {
    let mut offset = vec![0.0; balls];
    let mut count = vec![0.0; balls];
    // Against the mean over a turn around each passing.
    let mut sum = vec![0.0];
    for &d in deviation.iter() {
        sum.push(sum[sum.len() - 1] + d);
    }
    let half = balls / 2;
    for k in half..deviation.len().saturating_sub(balls - half) {
        let (from, to) = (k - half, k - half + balls);
        if index[to] - index[from] != balls as i64 {
            continue;
        }
        // An even number of balls makes the window lopsided by half a pitch: the mean of both windows is centred.
        let mean = if balls % 2 == 1 || from == 0 {
            (sum[to] - sum[from]) / balls as f64
        } else {
            0.5 * (sum[to] - sum[from] + sum[to + 1] - sum[from + 1]) / balls as f64
        };
        let ball = index[k].rem_euclid(balls as i64) as usize;
        offset[ball] += deviation[k] - mean;
        count[ball] += 1.0;
    }
    if count.iter().any(|&c| c < 3.0) {
        return 0.0;
    }
    for (o, c) in offset.iter_mut().zip(&count) {
        *o /= c;
    }
    let mean = offset.iter().sum::<f64>() / balls as f64;
    for (d, &n) in deviation.iter_mut().zip(index) {
        *d -= offset[n.rem_euclid(balls as i64) as usize] - mean;
    }
    (offset.iter().map(|o| (o - mean).powi(2)).sum::<f64>() / balls as f64).sqrt()
}
