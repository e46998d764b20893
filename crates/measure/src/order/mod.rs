//! Orders of a shaft in a signal: amplitude and phase over time at any speed, and the signal without them.
//!
//! ```text
//! signal = mean + Σ (a_k cos kθ + b_k sin kθ) + rest        a_k, b_k, mean: straight lines between nodes
//! minimal: Σ rest² + λ Σ (second differences of a_k, b_k, mean)²
//! ```
//!
//! All orders are found together, so close and crossing orders and low speeds do no harm beyond a wider band.
//! Source: Vold and Leuridan, SAE 931288 (1993), and the second generation by Vold, Mains and Blough, SAE 972007 (1997) (from
//! memory); here on nodes instead of on every value.
//!
//! Not modelled: amplitudes that change faster than the bandwidth, which stay in the rest.

mod banded;

use crate::shaft::Shaft;
use banded::Banded;
use problem::{note, note::Note};
use std::f64::consts::{PI, TAU};

/// Nodes per period of the bandwidth.
const NODES: f64 = 10.0;

/// One order over time. All lists have the length of [`Orders::time`].
#[derive(Clone, Debug)]
pub struct Order {
    /// Cycles a turn.
    pub order: f64,
    /// Part along cos kθ, unit of the signal.
    pub cosine: Vec<f64>,
    /// Part along sin kθ.
    pub sine: Vec<f64>,
    /// Standard deviation of each part, by noise near the order.
    pub deviation: Vec<f64>,
}

impl Order {
    /// Amplitudes, unit of the signal, peak.
    pub fn amplitude(&self) -> Vec<f64> {
        self.cosine
            .iter()
            .zip(&self.sine)
            .map(|(a, b)| a.hypot(*b))
            .collect()
    }
}

/// Orders in a signal and what is left without them.
#[derive(Clone, Debug)]
pub struct Orders {
    /// Times of the nodes, s.
    pub time: Vec<f64>,
    /// The orders, as they were asked for.
    pub orders: Vec<Order>,
    /// The signal without its orders but with its mean, at its own times; NaN where shaft or signal are missing.
    pub rest: Vec<f64>,
    /// What is not trustworthy.
    pub notes: Vec<Note>,
}

/// Follows orders in a signal with values at equal `interval` from the time `first` on, s.
///
/// `orders` in cycles a turn, up to 8 of them; `bandwidth` in Hz: an amplitude that swings at this frequency is followed to 71 %.
/// The error says what is wrong.
pub fn orders(
    signal: &[f64],
    first: f64,
    interval: f64,
    shaft: &Shaft,
    orders: &[f64],
    bandwidth: f64,
) -> Result<Orders, String> {
    shaft.check()?;
    if !(interval > 0.0 && interval.is_finite() && first.is_finite()) {
        return Err("the interval of the signal must be positive and finite".into());
    }
    if orders.is_empty() || orders.len() > 8 || orders.iter().any(|o| !(*o > 0.0 && *o < 1e6)) {
        return Err("1 to 8 positive orders can be followed".into());
    }
    let mut sorted = orders.to_vec();
    sorted.sort_by(f64::total_cmp);
    if sorted.windows(2).any(|w| w[1] - w[0] < 1e-6) {
        return Err("an order is asked for twice".into());
    }
    if !(bandwidth > 0.0 && bandwidth * interval < 0.02) {
        return Err(format!(
            "a bandwidth of {bandwidth} Hz is not between 0 and 0.02 of the rate of the signal"
        ));
    }
    let from = ((shaft.first - first) / interval).ceil().max(0.0) as usize;
    let to = (((shaft.last() - first) / interval).floor() + 1.0).max(0.0) as usize;
    let to = to.min(signal.len());
    if from >= to || ((to - from) as f64) * interval * bandwidth < 1.0 {
        return Err("signal and shaft have less than one period of the bandwidth in common".into());
    }
    let width = ((1.0 / (NODES * bandwidth * interval)).round() as usize).max(2);
    let count = (to - from).div_ceil(width) + 1;
    let size = 2 * orders.len() + 1;
    if count.saturating_mul(size) > 400_000 {
        return Err(
            "the bandwidth is too wide for so long a signal: more than 400 000 amplitudes".into(),
        );
    }
    let waves = Waves {
        first,
        interval,
        shaft,
        orders,
    };
    let mut system = Banded::new(count * size, 3 * size);
    let mut right = vec![0.0; count * size];
    let mut row = vec![0.0; size];
    for (k, &value) in signal.iter().enumerate().take(to).skip(from) {
        if !value.is_finite() {
            continue;
        }
        waves.at(k, &mut row);
        let (node, part) = (
            (k - from) / width,
            ((k - from) % width) as f64 / width as f64,
        );
        system.gather(node * size, &row, part);
        for (i, w) in row.iter().enumerate() {
            right[node * size + i] += (1.0 - part) * w * value;
            right[(node + 1) * size + i] += part * w * value;
        }
    }
    // Half of the values' weight falls on each of cosine and sine; the filter 1/(1 + λ/g (2 sin πfT)⁴) is 1/√2 at the bandwidth.
    let weight = 0.5 * width as f64 * (2.0_f64.sqrt() - 1.0) / (2.0 * (PI / NODES).sin()).powi(4);
    for node in 0..count.saturating_sub(2) {
        for i in 0..size {
            let factor = if i == 0 { 2.0 * weight } else { weight };
            for (a, p) in [1.0, -2.0, 1.0].into_iter().enumerate() {
                for (b, q) in [1.0, -2.0, 1.0].into_iter().enumerate().take(a + 1) {
                    system.add((node + a) * size + i, (node + b) * size + i, factor * p * q);
                }
            }
        }
    }
    // What no value determines (a gap longer than a node's reach) must not stop the rest.
    for i in 0..count * size {
        system.add(i, i, 1e-9 * width as f64);
    }
    let factor = system
        .factored()
        .ok_or("the orders cannot be separated in this signal")?;
    let found = factor.solved(&right);
    let variances = factor.inverse_diagonal();
    let mut rest = vec![f64::NAN; signal.len()];
    // Sums of the rest without its mean, turned back by each order, between two nodes; and the number of values.
    let mut sums = vec![0.0; (count - 1) * size];
    for (k, slot) in rest.iter_mut().enumerate().take(to).skip(from) {
        let value = signal[k];
        if !value.is_finite() {
            continue;
        }
        waves.at(k, &mut row);
        let (node, part) = (
            (k - from) / width,
            ((k - from) % width) as f64 / width as f64,
        );
        let (here, next) = (
            &found[node * size..(node + 1) * size],
            &found[(node + 1) * size..(node + 2) * size],
        );
        let mut left = value;
        for i in 1..size {
            left -= row[i] * (here[i] + part * (next[i] - here[i]));
        }
        *slot = left;
        let moving = left - here[0] - part * (next[0] - here[0]);
        let sum = &mut sums[node * size..(node + 1) * size];
        sum[0] += 1.0;
        for i in 1..size {
            sum[i] += row[i] * moving;
        }
    }
    let time: Vec<f64> = (0..count)
        .map(|n| first + (from + n * width) as f64 * interval)
        .collect();
    let mut notes = Vec::new();
    let mut tracks = Vec::with_capacity(orders.len());
    for (index, &order) in orders.iter().enumerate() {
        let noise = near(&sums, size, index);
        let pick = |i: usize| {
            (0..count)
                .map(|n| found[n * size + i])
                .collect::<Vec<f64>>()
        };
        let (c, s) = (2 * index + 1, 2 * index + 2);
        let deviation = (0..count)
            .map(|n| {
                (noise[n.min(noise.len() - 1)]
                    * 0.5
                    * (variances[n * size + c] + variances[n * size + s]))
                    .max(0.0)
                    .sqrt()
            })
            .collect();
        tracks.push(Order {
            order,
            cosine: pick(c),
            sine: pick(s),
            deviation,
        });
        let slow = time
            .iter()
            .filter(|&&t| order * shaft.speed_at(t.min(shaft.last())).abs() < TAU * 2.0 * bandwidth)
            .count();
        if slow > 0 {
            notes.push(note!(
                "order {} is below twice the bandwidth during {:.0} % of the time: it cannot be separated from the mean there",
                order, 100.0 * slow as f64 / count as f64
            ));
        }
    }
    Ok(Orders {
        time,
        orders: tracks,
        rest,
        notes,
    })
}

/// Cosines and sines of the orders.
struct Waves<'a> {
    first: f64,
    interval: f64,
    shaft: &'a Shaft<'a>,
    orders: &'a [f64],
}

impl Waves<'_> {
    fn at(&self, k: usize, row: &mut [f64]) {
        let angle = self.shaft.angle_at(self.first + k as f64 * self.interval);
        row[0] = 1.0;
        let (sine, cosine) = angle.sin_cos();
        let (mut last, mut c, mut s) = (0.0, 1.0, 0.0);
        for (pair, &order) in row[1..].chunks_exact_mut(2).zip(self.orders) {
            if order == last + 1.0 {
                (c, s) = (c * cosine - s * sine, s * cosine + c * sine);
            } else {
                (s, c) = (order * angle).sin_cos();
            }
            last = order;
            pair.copy_from_slice(&[c, s]);
        }
    }
}

/// Variance that a value of the rest would need as white noise to have the power that is seen near an order, between nodes.
fn near(sums: &[f64], size: usize, index: usize) -> Vec<f64> {
    // Sums over n values of cosine times white noise have variance n/2 each.
    let powers: Vec<f64> = sums
        .chunks_exact(size)
        .map(|part| (part[2 * index + 1].powi(2) + part[2 * index + 2].powi(2)) / part[0])
        .collect();
    let reach = 15;
    (0..powers.len())
        .map(|k| {
            let part = &powers[k.saturating_sub(reach)..(k + reach + 1).min(powers.len())];
            let seen = part.iter().filter(|p| p.is_finite());
            seen.clone().sum::<f64>() / seen.count().max(1) as f64
        })
        .collect()
}
