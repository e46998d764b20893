//! Do the stated bands hold the truth? Four hundred made-up spin-ups a case, with models that differ from the estimator's.

mod synthetic;

use measure::pulse::{EdgeSettings, Edges, Flank, Wheel, calibrate, edges, number};
use measure::speed::{Speed, SpeedSettings, smooth};
use synthetic::{pickup, spin_up, stamps};

const SEEDS: u64 = 400;

struct Case {
    name: &'static str,
    peak: f64,
    marks: usize,
    /// Samples per second of the pickup; none where a counter stamps the edges.
    rate: Option<f64>,
}

#[derive(Clone, Copy, Default)]
struct Score {
    speed_inside: f64,
    acceleration_inside: f64,
    peak_error: f64,
    rms_error: f64,
    thirds: [f64; 5],
    vthirds: [f64; 5],
}

fn estimate(case: &Case, truth: &synthetic::Truth, seed: u64) -> Speed {
    let found = match case.rate {
        Some(rate) => {
            let samples = pickup(truth, seed, case.marks, rate);
            edges(0.0, 1.0 / rate, &samples, &EdgeSettings { flank: if std::env::var("BOTH").is_ok() { Flank::Both } else { Flank::Rising }, ..Default::default() }).unwrap()
        }
        None => {
            Edges::stamped(stamps(truth, seed, case.marks), 1e-7 / 12f64.sqrt(), Some((0.0, truth.end()))).unwrap()
        }
    };
    let pulses = number(&found, &Wheel { marks: case.marks, missing: 0 }).unwrap();
    let pitch = calibrate(&pulses).ok();
    smooth(&pulses, pitch.as_ref(), &SpeedSettings { latency: if case.rate.is_some() { 1e-5 } else { 0.0 }, ripple: 2.0, ..Default::default() }).unwrap()
}

fn score(case: &Case, seed: u64) -> Score {
    let truth = spin_up(seed, 150.0, case.peak, 0.4);
    let speed = estimate(case, &truth, seed);
    let length = truth.lock - truth.engage;
    let points = 100;
    let mut score = Score::default();
    let (mut square, mut top, mut inner) = (0.0, 0.0f64, 0.0);
    let dump = std::env::var("DUMP").ok().and_then(|d| d.parse::<u64>().ok()) == Some(seed);
    for k in 0..points {
        let t = truth.engage + length * 1.25 * (k as f64 + 0.5) / points as f64;
        let m = speed.at(t);
        let (dv, da) = (m.speed - truth.speed(t), m.acceleration - truth.acceleration(t));
        let ok = (da.abs() < 2.0 * m.acceleration_uncertainty()) as u8 as f64;
        let vok = (dv.abs() < 2.0 * m.speed_uncertainty()) as u8 as f64;
        score.speed_inside += vok / points as f64;
        score.vthirds[k * 5 / points] += 5.0 * vok / points as f64;
        score.acceleration_inside += ok / points as f64;
        score.thirds[k * 5 / points] += 5.0 * ok / points as f64;
        if t < truth.lock {
            square += da * da;
            inner += 1.0;
        }
        top = top.max(m.acceleration);
        if dump {
            println!("DUMP {} {t} {} {} {} {} {} {}", case.name, truth.speed(t), m.speed, m.speed_uncertainty(), truth.acceleration(t), m.acceleration, m.acceleration_uncertainty());
        }
    }
    if dump {
        println!("seed {seed} engage {} lock {} {:?} {} {} {:?}", truth.engage, truth.lock, speed.change, speed.timing_factor, speed.angle_noise, speed.notes);
    }
    score.peak_error = (top / truth.top() - 1.0).abs();
    score.rms_error = (square / inner).sqrt() / truth.top();
    score
}

fn run(case: &Case) {
    let start = std::time::Instant::now();
    let seeds: u64 = std::env::var("SEEDS").ok().and_then(|d| d.parse().ok()).unwrap_or(SEEDS);
    let scores: Vec<Score> = std::thread::scope(|scope| {
        let halves: Vec<_> = (0..2)
            .map(|part| scope.spawn(move || (0..seeds).filter(|s| s % 2 == part).map(|s| score(case, s)).collect::<Vec<_>>()))
            .collect();
        halves.into_iter().flat_map(|h| h.join().unwrap()).collect()
    });
    let mean = |f: &dyn Fn(&Score) -> f64| scores.iter().map(f).sum::<f64>() / scores.len() as f64;
    let mid = |f: &dyn Fn(&Score) -> f64, q: f64| {
        let mut v: Vec<f64> = scores.iter().map(f).collect();
        v.sort_by(f64::total_cmp);
        v[((v.len() - 1) as f64 * q) as usize]
    };
    println!(
        "{}: inside speed {:.1} % {:?} acceleration {:.1} % (by fifth {:?}), peak error median {:.2} % (90 %: {:.2} %), rms error median {:.2} % (90 %: {:.2} %), {:.1} s",
        case.name,
        100.0 * mean(&|s| s.speed_inside),
        (0..5).map(|k| (100.0 * mean(&|s| s.vthirds[k])).round()).collect::<Vec<_>>(),
        100.0 * mean(&|s| s.acceleration_inside),
        (0..5).map(|k| (100.0 * mean(&|s| s.thirds[k])).round()).collect::<Vec<_>>(),
        100.0 * mid(&|s| s.peak_error, 0.5),
        100.0 * mid(&|s| s.peak_error, 0.9),
        100.0 * mid(&|s| s.rms_error, 0.5),
        100.0 * mid(&|s| s.rms_error, 0.9),
        start.elapsed().as_secs_f64()
    );
    if std::env::var("KIND").is_ok() {
    let half: Vec<u64> = (0..seeds).filter(|s| s % 2 == 0).chain((0..seeds).filter(|s| s % 2 == 1)).collect();
    for kind in 0..5 {
        let own: Vec<&Score> = scores.iter().zip(&half).filter(|(_, s)| **s % 5 == kind).map(|(s, _)| s).collect();
        let mean = |f: &dyn Fn(&Score) -> f64| (100.0 * own.iter().map(|s| f(s)).sum::<f64>() / own.len() as f64).round();
        println!("   kind {kind}: speed {:?} acc {:?} rms {}", (0..5).map(|k| mean(&|s| s.vthirds[k])).collect::<Vec<_>>(), (0..5).map(|k| mean(&|s| s.thirds[k])).collect::<Vec<_>>(), mean(&|s| s.rms_error));
    }
    }
}

#[test]
fn all() {
    for case in [
        Case { name: "25 ms, 60 marks", peak: 11_500.0, marks: 60, rate: Some(1e4) },
        Case { name: "25 ms, 360 stamps", peak: 11_500.0, marks: 360, rate: None },
        Case { name: "40 ms, 60 marks", peak: 7_200.0, marks: 60, rate: Some(1e4) },
        Case { name: "223 ms, 12 marks", peak: 1_300.0, marks: 12, rate: Some(1e4) },
        Case { name: "223 ms, 60 marks", peak: 1_300.0, marks: 60, rate: Some(1e4) },
    ] {
        run(&case);
    }
}
