//! The orders of the whirl: what the orbit at a bearing holds of each multiple of the spin, forward and backward, in windows of time.
//!
//! ```text
//!   A(n) = |Σ w z e^(−jnφ)| / Σ w        z = x + jy less its mean, φ = ∫Ω dt, w a Hann window over eight turns
//! ```
//! n > 0 turns as the rotor spins, 1 is unbalance, n < 0 runs backward. The phase is that of the rotor itself, so that lines stay
//! lines while it slows down.

use model::system::layout::of_part;
use outcome::list::results;
use outcome::list::{List, origins};
use outcome::{Column, Quantity};
use std::f64::consts::{PI, TAU};

/// Turns of a window, and windows at most.
const TURNS: f64 = 8.0;
const MOST_WINDOWS: usize = 60;
/// Largest order, and the distance of two.
const LARGEST: f64 = 3.0;
const STEP: f64 = 0.05;
/// Orders nearer to rest are where the orbit lies.
const LEAST: f64 = 0.1;
/// Rows of a window at least.
const LEAST_ROWS: usize = 32;

/// Orders over time at one bearing.
struct Spectrum {
    orders: Vec<f64>,
    times: Vec<f64>,
    /// Of each window, of each order, m.
    amplitudes: Vec<f64>,
}

/// Names the orders at every bearing from the columns of a run, with the instant of its release, s.
pub(crate) fn named<'a>(
    parts: impl Iterator<Item = &'a str>,
    run: Option<(&[Column], f64)>,
) -> Vec<Quantity> {
    let mut list = List::default();
    for part in parts {
        let found = run.map(|(history, release)| Orders {
            spectrum: spectrum(history, part),
            release,
        });
        list.of_part(part, |list| orders(list, &(), found.as_ref()));
    }
    list.quantities
}

/// Orders at a bearing; none of a run that is too short.
struct Orders {
    spectrum: Option<Spectrum>,
    release: f64,
}

impl Orders {
    fn list(&self, of: impl Fn(&Spectrum) -> Vec<f64>) -> Vec<f64> {
        self.spectrum.as_ref().map_or(Vec::new(), of)
    }
    /// Of the largest forward order and the largest backward one: lists, since members of repeated runs and studies keep no rows.
    fn largest(&self, of: fn((f64, f64)) -> f64) -> Vec<f64> {
        let both = |found: &Spectrum| {
            [1.0, -1.0]
                .iter()
                .filter_map(|sign| found.largest(*sign))
                .map(of)
                .collect()
        };
        self.list(both)
    }
}

results! {
    fn orders(setup: &(), run: &Orders) {
        "whirl_orders": list "1", ORDERS, "orders of the whirl" in whirl_map "order" => run.list(|found| found.orders.clone());
        "whirl_order_times": list "s", ORDERS, "middle of each window after the release" in whirl_map "time" => {
            run.list(|found| found.times.iter().map(|time| time - run.release).collect())
        };
        "whirl_order_amplitudes": list "m", ORDERS, "amplitude of each order in each window" in whirl_map "amplitude" => run.list(|found| found.amplitudes.clone());
        "largest_whirl_orders": list "1", LAST, "largest forward and backward order at the end" => run.largest(|(order, _)| order);
        "largest_whirl_amplitudes": list "m", LAST, "amplitudes of these orders" => run.largest(|(_, size)| size);
    }
}

impl Spectrum {
    /// The order of this sign with the largest amplitude in the last window.
    fn largest(&self, sign: f64) -> Option<(f64, f64)> {
        let last = self.amplitudes.len().checked_sub(self.orders.len())?;
        let sizes = self.orders.iter().zip(&self.amplitudes[last..]);
        let own = sizes.filter(|(order, _)| **order * sign > 0.0);
        let most = own.max_by(|a, b| a.1.total_cmp(b.1))?;
        Some((*most.0, *most.1))
    }
}

fn spectrum(history: &[Column], part: &str) -> Option<Spectrum> {
    let column = |name: &str| {
        let found = history.iter().find(|column| column.name == name);
        found.map(|column| column.values.as_slice())
    };
    let of = |axis: &str| {
        column(&of_part(part, &format!("rotor.{axis}")))
            .or_else(|| column(&format!("rotor.{axis}")))
    };
    let (time, speed) = (column("time")?, column("rotor.speed")?);
    let (x, y) = (of("x")?, of("y")?);
    let rows = time.len();
    let fastest = speed.first()?.abs();
    if rows < LEAST_ROWS || fastest == 0.0 {
        return None;
    }
    let step = (time[rows - 1] - time[0]) / (rows - 1) as f64;
    let width = ((TAU * TURNS / fastest) / step).round() as usize;
    if width < LEAST_ROWS || width > rows {
        return None;
    }
    // the rotor's own angle, by trapezoids
    let mut angle = vec![0.0; rows];
    for k in 1..rows {
        angle[k] = angle[k - 1] + 0.5 * (speed[k] + speed[k - 1]) * (time[k] - time[k - 1]);
    }
    // below the rate of the rows with room to spare
    let highest = LARGEST.min(0.8 * PI / (step * fastest));
    let steps = (highest / STEP) as i32;
    let all: Vec<f64> = (-steps..=steps).map(|k| f64::from(k) * STEP).collect();
    let is_kept = |order: &&f64| order.abs() >= LEAST;
    let orders: Vec<f64> = all.iter().filter(is_kept).copied().collect();
    let windows = (2 * (rows - width) / width + 1).clamp(1, MOST_WINDOWS);
    let hop = if windows > 1 {
        (rows - width) as f64 / (windows - 1) as f64
    } else {
        0.0
    };
    let hann: Vec<f64> = (0..width)
        .map(|k| 0.5 - 0.5 * (TAU * (k as f64 + 0.5) / width as f64).cos())
        .collect();
    let whole: f64 = hann.iter().sum();
    let (mut times, mut amplitudes) = (Vec::new(), Vec::new());
    for window in 0..windows {
        let from = (window as f64 * hop) as usize;
        let mean = |values: &[f64]| {
            let weighed = values[from..from + width].iter().zip(&hann);
            weighed.map(|(value, weight)| value * weight).sum::<f64>() / whole
        };
        let (mean_x, mean_y) = (mean(x), mean(y));
        times.push(time[from + width / 2]);
        // from order to order a row turns by one step of its angle
        let mut sums = vec![(0.0, 0.0); all.len()];
        for (k, weight) in (from..from + width).zip(&hann) {
            let (px, py) = (weight * (x[k] - mean_x), weight * (y[k] - mean_y));
            let turned = |order: f64| (order * angle[k]).sin_cos();
            let (sine, cosine) = turned(all[0]);
            let (mut re, mut im) = (px * cosine + py * sine, py * cosine - px * sine);
            let (sine, cosine) = turned(STEP);
            for sum in &mut sums {
                sum.0 += re;
                sum.1 += im;
                (re, im) = (re * cosine + im * sine, im * cosine - re * sine);
            }
        }
        let kept = all.iter().zip(&sums).filter(|(order, _)| is_kept(order));
        amplitudes.extend(kept.map(|(_, (re, im)): (_, &(f64, f64))| re.hypot(*im) / whole));
    }
    Some(Spectrum {
        orders,
        times,
        amplitudes,
    })
}

origins! {
    ORDERS: law "|Σ w z e^(−jnφ)|/Σ w of the orbit at the bearing in windows of eight turns (Hann), n from −3 to 3; amplitudes window by window, its middle in time after the release",
        source "definition; crates/simulate/src/drop/orders.rs",
        valid "from the rows of the history: what is quicker than half their rate folds down";
    LAST: law "the largest amplitude of the last window and its order: forward, then backward, whose orders are negative",
        source "crates/simulate/src/drop/orders.rs",
        valid "as whirl_orders; orders are told apart from 0.25 on";
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rotor that slows down, with unbalance, a backward whirl at 0.55 of its speed, and an offset.
    fn columns() -> Vec<Column> {
        let column = |name: &str, values: Vec<f64>| Column {
            name: name.to_string(),
            unit: "",
            meaning: String::new(),
            optional: false,
            values,
        };
        let time: Vec<f64> = (0..4000).map(|k| 1e-4 * f64::from(k)).collect();
        let angle = |t: f64| 1200.0 * t - 300.0 * t * t;
        let at = |f: &dyn Fn(f64) -> f64| time.iter().map(|t| f(*t)).collect::<Vec<_>>();
        vec![
            column("time", time.clone()),
            column("rotor.speed", at(&|t| 1200.0 - 600.0 * t)),
            column(
                "a.rotor.x",
                at(&|t| 1e-4 + 5e-5 * angle(t).cos() + 2e-5 * (0.55 * angle(t)).cos()),
            ),
            column(
                "a.rotor.y",
                at(&|t| -2e-4 + 5e-5 * angle(t).sin() - 2e-5 * (0.55 * angle(t)).sin()),
            ),
        ]
    }

    #[test]
    fn lines_stay_lines_while_the_rotor_slows_down_and_backward_is_negative() {
        let history = columns();
        let found = spectrum(&history, "a").unwrap();
        let (order, size) = found.largest(1.0).unwrap();
        assert!(
            (order - 1.0).abs() < 1e-9 && (size / 5e-5 - 1.0).abs() < 1e-3,
            "{order} {size}"
        );
        let (order, size) = found.largest(-1.0).unwrap();
        assert!(
            (order + 0.55).abs() < 1e-9 && (size / 2e-5 - 1.0).abs() < 1e-2,
            "{order} {size}"
        );
        assert_eq!(
            found.amplitudes.len(),
            found.orders.len() * found.times.len()
        );
        let named = named(["a"].into_iter(), Some((&history, 0.0)));
        assert!(named.iter().any(|q| q.name == "a.largest_whirl_orders"));
        // too short for eight turns
        let short: Vec<Column> = (history.into_iter())
            .map(|c| Column {
                values: c.values[..100].to_vec(),
                ..c
            })
            .collect();
        assert!(spectrum(&short, "a").is_none());
    }
}
