//! More of a measurement through its front: converter, vibration, steady curves, a window for the quick change.

use crate::outcomes::number;
use auxbear::outcome::{Outcome, Value};
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

const RATE: f64 = 2000.0;
const SECONDS: f64 = 12.0;
const MARKS: f64 = 12.0;
const INERTIA: f64 = 2e-4;

/// Torque at a speed, N m: what slows the shaft, and what the sensor reads.
fn torque(speed: f64) -> f64 {
    0.8e-3 + 1e-5 * speed
}

/// A coast-down from 120 rad/s under that torque; and a vibration of 0.5 m/s² of order 2, 0.2 of order 4.1.
struct Coast {
    folder: PathBuf,
}

impl Coast {
    fn new(name: &str, limit: f64) -> Coast {
        let folder = std::env::temp_dir().join(format!("auxbear_{name}_{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let mut text = String::from("time,tacho,torque,vibration\ns,V,N mm,m/s^2\n");
        let mut state = 7u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        // The sum of twelve is normal enough, with variance 1.
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let (mut angle, mut speed) = (0.0, 120.0);
        for k in 0..(SECONDS * RATE) as usize {
            let wave = (MARKS * angle + 2.0_f64).sin();
            let tacho = 2.5 + 2.4 * (3.0 * wave).tanh() + 0.02 * normal();
            let reading = (1e3 * torque(speed) + 0.3 * normal()).min(limit);
            let vibration = 0.5 * (2.0 * angle).cos() + 0.2 * (4.1 * angle).sin() + 0.05 * normal();
            let time = k as f64 / RATE;
            writeln!(text, "{time},{tacho:.4},{reading:.4},{vibration:.4}").unwrap();
            let slope = -torque(speed) / INERTIA;
            angle += speed / RATE + 0.5 * slope / (RATE * RATE);
            speed += slope / RATE;
        }
        fs::write(folder.join("coast.csv"), text).unwrap();
        Coast { folder }
    }

    fn asked(&self, more: &str) -> Result<Outcome, String> {
        let text = format!(
            "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"coast.csv\"\n\
             [signals.speed]\nchannel = \"tacho\"\nmarks_per_revolution = 12\n{more}"
        );
        let file = self.folder.join("a.toml");
        fs::write(&file, text).unwrap();
        let scenario =
            Scenario::read(Path::new(&file), &[], &BuiltIn).map_err(|p| p.to_string())?;
        run(&scenario, &Options::unwatched(&AtomicBool::new(false))).map_err(|p| p.to_string())
    }
}

impl Drop for Coast {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.folder).ok();
    }
}

fn value<'a>(outcome: &'a Outcome, name: &str) -> &'a Value {
    let quantity = outcome.quantity(name);
    &quantity.unwrap_or_else(|| panic!("no {name}")).value
}

fn list<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    match value(outcome, name) {
        Value::List(values) => values,
        other => panic!("{name}: {other:?}"),
    }
}

const TORQUE: &str = "[signals.torque]\nchannel = \"torque\"\nzero_deviation = \"0.1 N mm\"\n";

#[test]
fn torque_over_speed_by_both_ways() {
    let coast = Coast::new("steady", f64::INFINITY);
    let more = format!(
        "{TORQUE}[signals.steady]\nfrom = \"0.5 s\"\nto = \"11.5 s\"\ninertia = \"0.0002 kg m^2\"\ninertia_deviation = 0.01\n"
    );
    let outcome = coast.asked(&more).unwrap();
    let speeds = list(&outcome, "steady_speeds");
    assert_eq!(speeds.len(), 40);
    for name in ["direct", "inertial"] {
        let torques = list(&outcome, &format!("steady_{name}_torques"));
        let deviations = list(&outcome, &format!("steady_{name}_deviations"));
        let within = (0..40).filter(|&k| {
            let away = torques[k] - torque(speeds[k]);
            // Curves of 12 s: a tenth of the torque is the most that a band of this noise allows.
            assert!(away.abs() < 0.1 * torque(speeds[k]), "{name} {k}: {away}");
            away.abs() < 2.0 * deviations[k] + 1e-6
        });
        // Neighbouring speeds share their errors: most of them, not 95 %.
        assert!(within.count() >= 30, "{name}");
    }
    let (less, spread) = (
        number(&outcome, "steady_direct_less_inertial"),
        number(&outcome, "steady_direct_less_inertial_deviation"),
    );
    assert!(less.abs() < 3.0 * spread, "{less} {spread}");
    assert!(number(&outcome, "steady_direct_less_inertial_chance") > 1e-3);
    assert!(
        matches!(value(&outcome, "steady_up_torques"), Value::None { why } if why.contains("up_from"))
    );
    // A pendulum: period of the same inertia, from the law T = 2π √((I + m a²)/(m g a)).
    let period = TAU * ((INERTIA + 0.4 * 0.06 * 0.06) / (0.4 * 9.80665 * 0.06_f64)).sqrt();
    let pendulum = format!(
        "[signals.steady]\nfrom = \"0.5 s\"\nto = \"11.5 s\"\ninertia_from = \"pendulum\"\ntest_mass = \"0.4 kg\"\ntest_arm = \"60 mm\"\ntest_period = \"{period} s\"\ntest_period_deviation = \"1 ms\"\n"
    );
    let outcome = coast.asked(&pendulum).unwrap();
    assert!((number(&outcome, "steady_inertia") / INERTIA - 1.0).abs() < 1e-6);
    assert!(number(&outcome, "steady_inertia_deviation") > 0.0);
}

#[test]
fn orders_and_spectrograms() {
    let coast = Coast::new("vibration", f64::INFINITY);
    let more = "[signals.vibration]\nchannel = \"vibration\"\norders = [\"2\", \"4.1\"]\n";
    let outcome = coast.asked(more).unwrap();
    let amplitudes = list(&outcome, "vibration_order_amplitudes");
    // Noise of 0.05 within 2 Hz of 1000 Hz: 0.002 in each part.
    assert!((amplitudes[0] - 0.5).abs() < 0.01, "{amplitudes:?}");
    assert!((amplitudes[1] - 0.2).abs() < 0.01, "{amplitudes:?}");
    let names: Vec<&str> = outcome.history.iter().map(|c| c.name.as_str()).collect();
    for name in [
        "vibration.order_2_amplitude",
        "vibration.order_4_1_deviation",
    ] {
        assert!(names.contains(&name), "{names:?}");
    }
    let orders = list(&outcome, "vibration_order_spectrogram_orders");
    let levels = list(&outcome, "vibration_order_spectrogram_levels");
    let times = list(&outcome, "vibration_order_spectrogram_times");
    assert_eq!(levels.len(), orders.len() * times.len());
    // In every column the strongest order is 2.
    for column in levels.chunks(orders.len()) {
        let top = (0..orders.len())
            .max_by(|a, b| column[*a].total_cmp(&column[*b]))
            .unwrap();
        assert!((orders[top] - 2.0).abs() < 0.2, "{}", orders[top]);
    }
    let bytes: usize = levels.iter().map(|level| format!("{level},").len()).sum();
    assert!(bytes < 60_000, "{bytes}");
}

#[test]
fn a_spectrogram_ends_at_the_highest_frequency() {
    let coast = Coast::new("highest_frequency", f64::INFINITY);
    let asked = |more: &str| {
        coast.asked(&format!(
            "[signals.vibration]\nchannel = \"vibration\"\n{more}"
        ))
    };
    let whole = asked("").unwrap();
    let frequencies = list(&whole, "vibration_spectrogram_frequencies");
    // Half of 2000 values a second, less half of one of 64 rows.
    assert!(*frequencies.last().unwrap() > 980.0, "{frequencies:?}");
    let low = asked("highest_frequency = \"100 Hz\"\n").unwrap();
    let frequencies = list(&low, "vibration_spectrogram_frequencies");
    let times = list(&low, "vibration_spectrogram_times");
    let levels = list(&low, "vibration_spectrogram_levels");
    assert!(*frequencies.last().unwrap() <= 100.0 && frequencies.len() >= 32);
    assert!(times.len() >= 32, "{}", times.len());
    assert_eq!(levels.len(), frequencies.len() * times.len());
    // Order 2 of some 120 rad/s is the strongest line at first: 38 Hz.
    let top = (0..frequencies.len())
        .max_by(|a, b| levels[*a].total_cmp(&levels[*b]))
        .unwrap();
    assert!(
        (frequencies[top] - 38.0).abs() < 2.5,
        "{}",
        frequencies[top]
    );
    for (value, needed) in [
        (
            "1.5 kHz",
            "to 1000 Hz is needed: 4 lines as fine as the record has them, and half of the sampling rate of channel \"vibration\"",
        ),
        // 12 s in 32 columns: lines 2.7 Hz apart, four of them
        ("0.01 Hz", "from 10.667 to 1000 Hz is needed"),
        ("0 Hz", "above 0"),
        ("-5 Hz", "above 0"),
        ("100", "e.g. \"500 Hz\""),
        ("100 rpm/s", "e.g. \"500 Hz\""),
    ] {
        let shown = asked(&format!("highest_frequency = \"{value}\"\n")).unwrap_err();
        assert!(
            shown.contains("signals.vibration.highest_frequency") && shown.contains(needed),
            "{shown}"
        );
    }
}

#[test]
fn a_speed_that_falls_evenly_has_a_deviation() {
    // 60 marks at 150 rad/s, slowed by 5 rad/s²; the covariance of the smoothing spline is lost in rounding here.
    let folder = std::env::temp_dir().join(format!("auxbear_even_{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let mut text = String::from("mark,tacho [s]\n");
    for mark in 0..2000 {
        let angle = f64::from(mark) * TAU / 60.0;
        let time = (150.0 - (150.0_f64.powi(2) - 10.0 * angle).sqrt()) / 5.0;
        writeln!(text, "{mark},{time:.9}").unwrap();
    }
    fs::write(folder.join("even.csv"), text).unwrap();
    let file = folder.join("even.toml");
    let asked = "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"even.csv\"\n\
                 [signals.speed]\nchannel = \"tacho\"\nkind = \"edges\"\nstamp_deviation = \"0.1 us\"\nmarks_per_revolution = 60\n";
    fs::write(&file, asked).unwrap();
    let never = AtomicBool::new(false);
    let scenario = Scenario::read(&file, &[], &BuiltIn).unwrap();
    let outcome = run(&scenario, &Options::unwatched(&never)).unwrap();
    let (peak, spread) = (
        number(&outcome, "peak_acceleration"),
        number(&outcome, "peak_acceleration_deviation"),
    );
    // A cubic through 2000 instants of 2e-6 rad each over 1.4 s: 4e-6 rad/s² at its ends.
    assert!((1e-6..1e-4).contains(&spread), "{spread}");
    assert!((peak + 5.0).abs() < 3.0 * spread, "{peak} {spread}");
    assert!(number(&outcome, "peak_speed_deviation") > 0.0);
}

#[test]
fn a_converter_flags_its_limits() {
    // The torque starts at 2.0 N mm with 0.3 N mm of noise: a limit of 2.2 clips it at first.
    let coast = Coast::new("converter", 2.2);
    let more = format!(
        "{TORQUE}[signals.converter]\nchannels = [\"torque\"]\nhighest = 2.2\nlowest = -2.2\nbits = 12\n"
    );
    let outcome = coast.asked(&more).unwrap();
    let clipped = number(&outcome, "converter_clipped_values");
    assert_eq!(clipped, number(&outcome, "torque_clipped_values"));
    assert!(
        clipped > 100.0 && clipped < 0.5 * SECONDS * RATE,
        "{clipped}"
    );
    let shown = outcome.warnings.iter().any(|warning| {
        warning.code == "AB1041"
            && warning.text.contains("clipped")
            && warning.text.contains("the first at 0.")
    });
    assert!(shown, "{:?}", outcome.warnings);
}

/// What is left of a clipped torque is lower than the torque: no mean is taken of it.
#[test]
fn a_clipped_torque_has_no_steady_curve() {
    let coast = Coast::new("clipped", 2.2);
    let more = format!(
        "{TORQUE}[signals.converter]\nchannels = [\"torque\"]\nhighest = 2.2\nlowest = -2.2\nbits = 12\n\
         [signals.steady]\nfrom = \"0.5 s\"\nto = \"11.5 s\"\ninertia = \"0.0002 kg m^2\"\n"
    );
    let outcome = coast.asked(&more).unwrap();
    match value(&outcome, "steady_direct_torques") {
        Value::None { why } => assert!(why.contains("clipped at 2.2000 N mm"), "{why}"),
        other => panic!("{other:?}"),
    }
    assert_eq!(list(&outcome, "steady_inertial_torques").len(), 40);
}

#[test]
fn what_contradicts_itself_is_refused() {
    let coast = Coast::new("refused", f64::INFINITY);
    let cases = [
        (
            "[signals.converter]\nbits = 12\n",
            "signals.converter.channels is needed with it",
        ),
        (
            "[signals.converter]\nchannels = [\"torque\"]\nhighest = 10\n",
            "signals.converter.bits",
        ),
        (
            "[signals.converter]\nchannels = [\"torqe\"]\nhighest = 10\nbits = 12\n",
            "Did you mean \"torque\"?",
        ),
        (
            "[signals.converter]\nchannels = [\"torque\"]\nhighest = -1\nbits = 12\n",
            "more than signals.converter.lowest is needed",
        ),
        (
            "[signals.vibration]\norders = [\"1\"]\n",
            "signals.vibration.channel is needed with it",
        ),
        (
            "[signals.vibration]\nchannel = \"vibration\"\norders = [\"1\", \"two\"]\n",
            "\"two\" as entry 2",
        ),
        ("[signals.steady]\nfrom = \"3 s\"\n", "signals.steady.to"),
        (
            "[signals.steady]\nfrom = \"3 s\"\nto = \"2 s\"\n",
            "more than signals.steady.from",
        ),
        (
            "[signals.steady]\ninertia = \"1 kg m^2\"\n",
            "signals.steady.from is needed with it",
        ),
        (
            "[signals.steady]\nfrom = \"1 s\"\nto = \"2 s\"\ninertia_from = \"pendulum\"\n",
            "signals.steady.test_mass",
        ),
    ];
    for (more, words) in cases {
        let shown = coast.asked(more).map(|_| ()).unwrap_err();
        assert!(shown.contains(words), "{more}: {shown}");
    }
}

/// Zero and scale of the sensor are in the band of what it reads over the speed; where the zero is not stated that is said.
#[test]
fn a_steady_curve_carries_zero_and_scale_of_the_sensor() {
    let coast = Coast::new("steady_zero", f64::INFINITY);
    let slow = "[signals.steady]\nfrom = \"0.5 s\"\nto = \"11.5 s\"\ninertia = \"0.0002 kg m^2\"\n";
    let deviations = |zero: &str, scale: f64| {
        let sensor =
            format!("[signals.torque]\nchannel = \"torque\"\n{zero}scale_deviation = {scale}\n");
        let outcome = coast.asked(&format!("{sensor}{slow}")).unwrap();
        let shown = outcome.warnings.iter();
        let shown = shown.filter(|w| {
            w.code == "AB1043"
                && w.text
                    .contains("signals.torque.zero_deviation is not given")
        });
        (
            list(&outcome, "steady_direct_deviations").to_vec(),
            list(&outcome, "steady_direct_torques").to_vec(),
            shown.filter(|w| w.text.starts_with("Steady curve")).count(),
            value(&outcome, "steady_direct_less_inertial").clone(),
        )
    };
    let (bare, torques, shown, difference) = deviations("", 0.0);
    assert_eq!(shown, 1);
    assert!(matches!(difference, Value::None { why } if why.contains("zero of the reading")));
    let (zeroed, _, shown, difference) = deviations("zero_deviation = \"0.1 N mm\"\n", 0.0);
    assert_eq!(shown, 0);
    assert!(matches!(difference, Value::Number(_)));
    let (scaled, ..) = deviations("zero_deviation = \"0.1 N mm\"\n", 0.05);
    for k in 0..bare.len() {
        // 0.1 N mm of zero and 5 % of the torque stand beside the noise of the mean
        assert!((zeroed[k] - bare[k].hypot(0.1e-3)).abs() < 1e-3 * zeroed[k]);
        assert!((scaled[k] - zeroed[k].hypot(0.05 * torques[k])).abs() < 1e-3 * scaled[k]);
    }
}

/// A converter takes its channels in turn; a counter stamps when its event comes, and a column of times takes no turn.
#[test]
fn only_channels_of_the_converter_are_delayed() {
    let folder = tempfile::tempdir().unwrap();
    // a column of times, a channel before the torque, the torque
    let mut text = String::from("time,other,torque\ns,V,N mm\n");
    for k in 0..400 {
        let time = f64::from(k) * 1e-3;
        let torque = if k < 200 { 0 } else { 5 } + k % 3;
        writeln!(text, "{time:.3},0,{torque}").unwrap();
    }
    fs::write(folder.path().join("run.csv"), text).unwrap();
    let asked = |delay: &str| {
        let text = format!(
            "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n[signals]\nfile = \"run.csv\"\nchannel_delay = \"{delay}\"\n\
             [signals.torque]\nchannel = \"torque\"\n"
        );
        let file = folder.path().join("a.toml");
        fs::write(&file, text).unwrap();
        let scenario = Scenario::read(&file, &[], &BuiltIn).unwrap();
        let outcome = run(&scenario, &Options::unwatched(&AtomicBool::new(false))).unwrap();
        let time = outcome.history.iter().find(|column| column.name == "time");
        time.expect("there is one").values[0]
    };
    assert_eq!(asked("0 s"), 0.0);
    // one channel before it takes a turn; the column of times does not
    let delayed = asked("0.2 ms");
    assert!((delayed - 0.2e-3).abs() < 1e-12, "{delayed}");
}
