//! Crossings and extrema of known curves beneath noise: the stated uncertainty is that of the errors.

use statistics::local_fit::{Samples, Side};
use statistics::noise::Noise;
use statistics::random::Random;
use statistics::uncertain::Uncertain;

const SEEDS: u64 = 200;

/// Noise of one deviation, of which neighbours share a part; values in steps.
fn noise(random: &mut Random, count: usize, shared: f64) -> Vec<f64> {
    let mut last = random.normal();
    let next = |_| {
        last = shared * last + (1.0 - shared * shared).sqrt() * random.normal();
        last
    };
    (0..count).map(next).collect()
}

/// Errors over uncertainties of one estimate for many seeds: mean and root mean square.
fn standardised(truth: f64, of: impl Fn(u64) -> Uncertain) -> [f64; 2] {
    let errors: Vec<f64> = (1..=SEEDS)
        .map(|seed| {
            let own = of(seed);
            (own.value - truth) / own.deviation
        })
        .collect();
    let mean = |of: fn(f64) -> f64| errors.iter().map(|own| of(*own)).sum::<f64>() / SEEDS as f64;
    [mean(|own| own), mean(|own| own * own).sqrt()]
}

#[test]
fn errors_of_crossings_and_extrema_are_as_large_as_stated() {
    // interval, deviation, part that neighbours share, step of the values in deviations
    for (interval, deviation, shared, step) in [
        (0.01, 0.01, 0.0, 0.0),
        (0.05, 0.01, 0.0, 0.0),
        (0.002, 0.05, 0.0, 0.0),
        (0.01, 0.01, 0.8, 0.0),
        (0.01, 0.01, 0.0, 1.5),
    ] {
        let sampled = |seed: u64, curve: fn(f64) -> f64, of: &dyn Fn(Samples) -> Uncertain| {
            let mut random = Random::new(seed);
            let start = interval * random.uniform();
            let count = (4.0 / interval) as usize;
            let times: Vec<f64> = (0..count).map(|k| start + interval * k as f64).collect();
            // as many values before the curve show the noise
            let all = noise(&mut random, 2 * count, shared);
            let rounded = |value: f64| match step * deviation {
                0.0 => value,
                step => (value / step).round() * step,
            };
            let values = |part: &[f64], curve: fn(f64) -> f64| -> Vec<f64> {
                let both = times.iter().zip(part);
                let offset = 0.7 * deviation;
                both.map(|(time, own)| rounded(offset + curve(*time) + deviation * own) - offset)
                    .collect()
            };
            let before = values(&all[..count], |_| 0.0);
            let mean = before.iter().sum::<f64>() / count as f64;
            let rest: Vec<f64> = before.iter().map(|own| own - mean).collect();
            let own = Noise::of(&rest, 1).unwrap();
            let values = values(&all[count..], curve);
            of(Samples {
                times: &times,
                values: &values,
                noise: &own,
            })
        };
        let decay = |time: f64| 1.0 - (-time).exp();
        let crossing = |samples: Samples| samples.crossing(0.75, 0, Side::Around).unwrap().time;
        let corner = |samples: Samples| samples.crossing(0.75, 0, Side::Before).unwrap().time;
        let swing = |time: f64| (-0.3 * time).exp() * (2.0 * time).sin();
        let extremum = |samples: Samples| {
            let row = (0..samples.times.len())
                .max_by(|a, b| samples.values[*a].total_cmp(&samples.values[*b]));
            samples.extremum(row.unwrap(), 1.0, 0)
        };
        // a ramp that ends at 0.8: one after the other of both sides holds at 0.75 alone
        let ramp = |time: f64| (0.5 * time).min(0.8);
        let peak = 0.5 * (2.0_f64 / 0.3).atan();
        for (name, [mean, rms]) in [
            (
                "crossing",
                standardised(4_f64.ln(), |seed| sampled(seed, decay, &crossing)),
            ),
            (
                "before a corner",
                standardised(1.5, |seed| sampled(seed, ramp, &corner)),
            ),
            (
                "instant",
                standardised(peak, |seed| sampled(seed, swing, &|own| extremum(own).time)),
            ),
            (
                "height",
                standardised(swing(peak), |seed| {
                    sampled(seed, swing, &|own| extremum(own).value)
                }),
            ),
        ] {
            let case = format!(
                "{name}, interval {interval}, deviation {deviation}, shared {shared}, step {step}: {mean:.2}, {rms:.2}"
            );
            println!("{case}");
            assert!(mean.abs() < 0.3 && (0.7..1.3).contains(&rms), "{case}");
        }
    }
}

/// Without noise a fit is the curve: a parabola's vertex is its own, a straight line's crossing too.
#[test]
fn without_noise_fits_are_exact() {
    let times: Vec<f64> = (0..20).map(f64::from).collect();
    let (quiet, line) = (Noise::default(), times.clone());
    let bowl: Vec<f64> = times
        .iter()
        .map(|time| (time - 8.3).powi(2) - 2.0)
        .collect();
    let samples = |values| Samples {
        times: &times,
        values,
        noise: &quiet,
    };
    let vertex = samples(&bowl).extremum(8, -1.0, 0);
    assert!((vertex.time.value - 8.3).abs() < 1e-9 && (vertex.value.value + 2.0).abs() < 1e-9);
    let crossing = samples(&line).crossing(7.25, 0, Side::Before).unwrap();
    assert_eq!((crossing.row, crossing.time.value), (8, 7.25));
    assert!(samples(&line).crossing(19.5, 0, Side::Around).is_none());
    // a plateau has no vertex: its middle stands for it
    let flat = samples(&[2.0; 20]).extremum(3, 1.0, 0);
    assert_eq!((flat.time.value, flat.value.value), (9.0, 2.0));
    // a jump lies anywhere between its rows
    let jump: Vec<f64> = times
        .iter()
        .map(|time| f64::from(u8::from(*time > 4.5)))
        .collect();
    let found = samples(&jump).jump(0.1, 1.0, 0).unwrap();
    assert_eq!((found.row, found.time.value), (5, 4.5));
    assert!((found.time.deviation - 1.0 / 12_f64.sqrt()).abs() < 1e-12);
}

/// Neighbours that share a part p have ρ(k) = p^k: the mean of many repeats itself (1 + p)/(1 - p) times.
#[test]
fn a_mean_of_shared_noise_is_as_uncertain_as_its_repetition_says() {
    let values = noise(&mut Random::new(5), 40_000, 0.6);
    let own = Noise::of(&values, 0).unwrap();
    assert!((own.deviation - 1.0).abs() < 0.05 && (own.repetition() - 4.0).abs() < 0.4);
    let mean = own.weighted(&[1e-2; 100], &[1.0; 100]);
    assert!((mean.value - 1.0).abs() < 1e-12);
    let mean = mean.deviation.powi(2);
    assert!((mean / (own.repetition() * own.deviation.powi(2) / 100.0) - 1.0).abs() < 0.1);
    assert_eq!(Noise::of(&[0.0; 10], 1), None);
}
