//! All estimators on ten seconds of six channels from one converter at 42 000 conversions a second, and on nonsense.

use crate::synthetic::rig::{Random, SpinUp};
use measure::cage_speed::{Line, QuickChange, from_pulses, from_vibration};
use measure::converter::{Converter, faults};
use measure::order::orders;
use measure::shaft::Shaft;
use measure::spectrum::{AngularSettings, order_spectrogram, spectrogram, spectrum};
use measure::torque_sensor::{Clipped, Inversion, Sensor, identify_free_response, invert};
use statistics::uncertain::Uncertain;
use std::f64::consts::TAU;
use std::time::Instant;

/// Time that this thread has computed, s: as the system counts it, or by the clock where it does not.
fn spent(start: Instant) -> f64 {
    let counted = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let first = counted
        .as_ref()
        .and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    first.map_or(start.elapsed().as_secs_f64(), |ns| 1e-9 * ns)
}

/// Time of one step, printed; the sum is what counts.
fn timed<T>(name: &str, sum: &mut f64, step: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let before = spent(start);
    let result = step();
    let spent = spent(start) - before;
    println!("{name}: {:.0} ms", 1e3 * spent);
    *sum += spent;
    result
}

/// A spin-up, 9.5 s of turning: faults, spectra, orders, torque, cage speed. Vibration of 7000 values a second is also put
/// through at the full 42 000, as if it were alone.
#[test]
fn ten_seconds_are_quick() {
    let converter = Converter {
        lowest: -100.0,
        highest: 100.0,
        bits: 14,
    };
    let interval = 6.0 / 42_000.0;
    let mut random = Random::new(1);
    let spin = SpinUp::to_150(0.5, 0.025, 11_500.0);
    let count = (10.0 / interval) as usize;
    let mut deflection = 0.0;
    let reading: Vec<f64> = (0..count)
        .map(|k| {
            let t = k as f64 * interval;
            deflection += interval * 188.0 * (spin.torque(t) - deflection);
            deflection + 4.0 * spin.angle(t).cos() * spin.speed(t) / 150.0 + random.normal()
        })
        .collect();
    let vibration = |rate: f64, random: &mut Random| -> Vec<f64> {
        (0..(10.0 * rate) as usize)
            .map(|k| {
                let angle = spin.angle(k as f64 / rate);
                (4.08 * angle).cos()
                    + 0.5 * angle.cos()
                    + 0.3 * (2.0 * angle).cos()
                    + random.normal()
            })
            .collect()
    };
    let slow = vibration(7000.0, &mut random);
    let fast = vibration(42_000.0, &mut random);
    let times = (0..10_000).map(|k| k as f64 * 0.001 + 0.0005);
    let angle: Vec<f64> = times.clone().map(|t| spin.angle(t - 0.0005)).collect();
    let speed: Vec<f64> = times.map(|t| spin.speed(t - 0.0005)).collect();
    let shaft = Shaft {
        first: 0.0,
        interval: 0.001,
        angle: &angle,
        speed: &speed,
        speed_deviation: &[],
    };
    let mut sum = 0.0;
    timed("faults of 6 channels", &mut sum, || {
        for _ in 0..6 {
            assert!(faults(&slow, Some(&converter)).is_empty());
        }
    });
    timed("spectrum of 42 000 a second", &mut sum, || {
        spectrum(&fast, 1.0 / 42_000.0, 8192).expect("a spectrum")
    });
    timed("spectrogram of 42 000 a second", &mut sum, || {
        spectrogram(&fast, 1.0 / 42_000.0, 4096).expect("a spectrogram")
    });
    let settings = AngularSettings {
        highest_order: 50.0,
        turns: 16,
        slowest: 20.0,
    };
    timed("order spectrogram of 42 000 a second", &mut sum, || {
        order_spectrogram(&fast, 0.0, 1.0 / 42_000.0, &shaft, &settings)
            .expect("an order spectrogram")
    });
    let last = slow.len() - 8;
    let followed = timed("3 orders of 42 000 a second", &mut sum, || {
        let end = fast.len() - 45;
        orders(
            &fast[..end],
            0.0,
            1.0 / 42_000.0,
            &shaft,
            &[1.0, 2.0, 3.0],
            2.0,
        )
        .expect("orders")
    });
    assert!((followed.orders[0].amplitude()[150] - 0.5).abs() < 0.05);
    let torque = timed("torque", &mut sum, || {
        invert(&Inversion {
            sensor: Sensor {
                frequency: Uncertain::new(30.0, 0.1),
                damping_ratio: Uncertain::new(0.2, 0.005),
            },
            first: 0.0,
            interval,
            reading: &reading[..last],
            clipped: &[],
            shaft: Some(shaft),
            engagement: Some(Uncertain::new(0.5, 2e-4)),
            lock: None,
            zero: Uncertain::new(0.0, 10.0),
            scale_deviation: 0.005,
            disturbance_power: None,
        })
        .expect("a torque")
    });
    assert_eq!(torque.time.len(), torque.torque.len());
    let line = Line {
        ratio: 0.41,
        order: 10.0,
        lowest_slip: -0.02,
        highest_slip: 0.1,
        engagement: Some(0.5),
    };
    let late: Vec<f64> = fast[42_000..].to_vec();
    let cage = timed("cage speed from 42 000 a second", &mut sum, || {
        from_vibration(1.0, 1.0 / 42_000.0, &late, &shaft, &line).expect("a cage speed")
    });
    assert!((cage.slip[cage.slip.len() / 2] - 0.0049).abs() < 0.002);
    println!("all: {sum:.2} s");
    // 1.5 s are promised of a release build; tests are built to be compiled quickly, and a loaded machine has cold caches.
    assert!(sum < 3.0, "{sum} s");
}

/// Lists that no measurement gives.
fn nonsense(random: &mut Random) -> Vec<f64> {
    let count = [0, 1, 2, 7, 40, 300][(random.uniform() * 6.0) as usize];
    let kind = (random.uniform() * 6.0) as usize;
    (0..count)
        .map(|k| match kind {
            0 => random.normal(),
            1 => [f64::NAN, f64::INFINITY, -1e308, 1e308, 0.0, 1e-308]
                [(random.uniform() * 6.0) as usize],
            2 => 3.0,
            3 => k as f64,
            4 => 1e300 * random.normal(),
            _ => {
                (k as f64 * 0.7).sin()
                    + if random.uniform() < 0.1 {
                        f64::NAN
                    } else {
                        0.0
                    }
            }
        })
        .collect()
}

fn number(random: &mut Random) -> f64 {
    [
        0.0,
        1.0,
        -1.0,
        1e-3,
        0.02,
        1e300,
        1e-300,
        f64::NAN,
        f64::INFINITY,
        30.0,
    ][(random.uniform() * 10.0) as usize]
}

/// Nothing that is typed or read may stop the program: every call returns.
#[test]
fn nonsense_is_survived() {
    let mut random = Random::new(9);
    let mut answers = 0;
    for _ in 0..3000 {
        let r = &mut random;
        let (a, b, c, d) = (nonsense(r), nonsense(r), nonsense(r), nonsense(r));
        let (x, y, z) = (number(r), number(r), number(r));
        let length = [0, 1, 8, 16, 33, usize::MAX][(r.uniform() * 6.0) as usize];
        answers += usize::from(spectrum(&a, x, length).is_ok());
        answers += usize::from(spectrogram(&a, x, length).is_ok());
        let even: Vec<f64> = (0..300).map(|k| k as f64 * 1.5).collect();
        let (angle, speed) = if r.uniform() < 0.5 {
            (b.as_slice(), c.as_slice())
        } else {
            (even.as_slice(), &even[..])
        };
        let shaft = Shaft {
            first: number(r),
            interval: number(r),
            angle,
            speed,
            speed_deviation: &d[..0],
        };
        let settings = AngularSettings {
            highest_order: number(r),
            turns: length.min(3),
            slowest: z,
        };
        answers += usize::from(order_spectrogram(&a, x, y, &shaft, &settings).is_ok());
        answers += usize::from(orders(&a, x, y, &shaft, &[1.0, number(r)], z).is_ok());
        let converter = Converter {
            lowest: y,
            highest: z,
            bits: length as u32,
        };
        answers += faults(&a, (x > 0.0).then_some(&converter)).len();
        answers += usize::from(
            from_pulses(
                &a,
                &shaft,
                length,
                x,
                Some(QuickChange {
                    engagement: y,
                    lock: Some(x),
                }),
            )
            .is_ok(),
        );
        let line = Line {
            ratio: x,
            order: number(r),
            lowest_slip: -0.02,
            highest_slip: y,
            engagement: Some(z),
        };
        answers += usize::from(from_vibration(x, y, &a, &shaft, &line).is_ok());
        answers += usize::from(identify_free_response(&a, x, Some(length)).is_ok());
        answers += usize::from(identify_free_response(&a, x, None).is_ok());
        let input = Inversion {
            sensor: Sensor {
                frequency: Uncertain::new(z, 0.0),
                damping_ratio: Uncertain::new(0.2, 0.01),
            },
            first: 0.0,
            interval: x,
            reading: &a,
            clipped: &[Clipped {
                first: (length as f64 * r.uniform()) as usize,
                count: (20.0 * r.uniform()) as usize,
                limit: number(r),
                above: r.uniform() < 0.5,
            }],
            shaft: (r.uniform() < 0.5).then_some(shaft),
            engagement: Some(Uncertain::new(y, 0.0)),
            lock: None,
            zero: Uncertain::new(0.0, 1.0),
            scale_deviation: 0.0,
            disturbance_power: Some(number(r)),
        };
        answers += usize::from(invert(&input).is_ok());
    }
    // The nonsense must not be so wild that everything is refused at the door.
    println!("{answers} answers");
    assert!(answers > 3000, "{answers}");
}

/// A sine that is too weak to see is not found: the note says so, or the band contains nothing.
#[test]
fn an_order_that_is_not_there_has_no_amplitude() {
    let mut random = Random::new(2);
    let noise = random.coloured(20_000, 0.5, 0.9);
    let angle: Vec<f64> = (0..501).map(|k| 100.0 * 0.02 * f64::from(k)).collect();
    let speed = vec![100.0; 501];
    let shaft = Shaft {
        first: 0.0,
        interval: 0.02,
        angle: &angle,
        speed: &speed,
        speed_deviation: &[],
    };
    let found = orders(&noise, 0.0, 5e-4, &shaft, &[1.0], 1.0).expect("orders");
    let order = &found.orders[0];
    let far = (0..order.cosine.len())
        .filter(|&n| order.cosine[n].abs() > 3.0 * order.deviation[n])
        .count();
    assert!(
        far * 20 < order.cosine.len(),
        "{far} of {}",
        order.cosine.len()
    );
    assert!(TAU * found.time[found.time.len() - 1] > 0.0);
}
