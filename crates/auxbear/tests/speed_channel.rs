//! A speed in rpm instead of marks, and coast-downs without a torque sensor, through the front.

use crate::outcomes::number;
use auxbear::outcome::{Outcome, Value};
use auxbear::run::{Options, run};
use auxbear::scenario::{BuiltIn, Scenario};
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Inertia of what coasts, kg m².
const INERTIA: f64 = 4e-4;
/// Values a second.
const RATE: f64 = 500.0;

/// Friction moment of the bearing, N m.
fn moment(speed: f64) -> f64 {
    6e-3 + 2e-5 * speed
}

/// What brakes the shaft without it, N m.
fn windage(speed: f64) -> f64 {
    0.5e-3 + 2e-7 * speed * speed
}

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let folder = std::env::temp_dir().join(format!("auxbear_{name}_{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        Folder(folder)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).unwrap();
    }

    /// A coast-down from 150 rad/s as time, rpm to a half, and the bearing's torque in N mm.
    fn coasts(&self, name: &str, seconds: f64, brake: impl Fn(f64) -> f64) {
        self.coasts_at(RATE, 0.0, name, seconds, brake);
    }

    /// The same at another rate, with a zero of the torque, N mm, that shows where the shaft stands.
    fn coasts_at(
        &self,
        rate: f64,
        zero: f64,
        name: &str,
        seconds: f64,
        brake: impl Fn(f64) -> f64,
    ) {
        let mut text = String::from("time [s],speed [rpm],torque [N mm]\n");
        let mut state = 11u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let mut speed = 150.0;
        for k in 0..(seconds * rate) as usize {
            let rpm = speed * 30.0 / std::f64::consts::PI + 1.0 * normal();
            let shown = (2.0 * rpm).round() / 2.0;
            let felt = if speed > 0.0 { moment(speed) } else { 0.0 };
            let torque = zero + 1e3 * felt + 0.2 * normal();
            writeln!(text, "{:.4},{shown},{torque:.3}", k as f64 / rate).unwrap();
            let half = speed - 0.5 * brake(speed) / INERTIA / rate;
            speed = f64::max(speed - brake(half) / INERTIA / rate, 0.0);
        }
        self.write(name, &text);
    }

    fn outcome(&self, name: &str) -> Result<Outcome, String> {
        let scenario =
            Scenario::read(&self.0.join(name), &[], &BuiltIn).map_err(|p| p.to_string())?;
        run(&scenario, &Options::unwatched(&AtomicBool::new(false))).map_err(|p| p.to_string())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).ok();
    }
}

const HEAD: &str = "format = \"auxbear.scenario/1\"\nsystem = \"signals\"\n";

fn signals(file: &str, more: &str) -> String {
    format!(
        "{HEAD}[signals]\nfile = \"{file}\"\nradial_load = \"60 N\"\n[signals.speed]\nchannel = \"speed\"\nkind = \"speed\"\nbandwidth = \"200 Hz\"\n{more}"
    )
}

fn steady(to: f64, more: &str) -> String {
    format!(
        "[signals.steady]\nfrom = \"0.2 s\"\nto = \"{to} s\"\ninertia = \"4e-4 kg m^2\"\ninertia_deviation = 0.01\n{more}"
    )
}

const IDENTIFY: &str = "format = \"auxbear.scenario/1\"\nsystem = \"identify\"\n[bearing]\nname = \"6005\"\n[identify]\ncoast_down = [\"coast.toml\"]\n";

fn list<'a>(outcome: &'a Outcome, name: &str) -> &'a [f64] {
    let quantity = outcome.quantity(name);
    match &quantity.unwrap_or_else(|| panic!("{name}")).value {
        Value::List(values) => values,
        other => panic!("{name}: {other:?}"),
    }
}

/// Shares of the points of a curve within two and within four deviations of the truth.
fn inside(curve: [&[f64]; 3], truth: impl Fn(f64) -> f64) -> (f64, f64) {
    let [speeds, values, deviations] = curve;
    let (mut two, mut four, mut count) = (0.0, 0.0, 0.0);
    for ((speed, value), deviation) in speeds.iter().zip(values).zip(deviations) {
        if value.is_finite() {
            let off = (value - truth(*speed)).abs() / deviation;
            two += f64::from(u8::from(off < 2.0));
            four += f64::from(u8::from(off < 4.0));
            count += 1.0;
        }
    }
    assert!(count > 10.0);
    (two / count, four / count)
}

#[test]
fn a_coast_down_of_a_few_seconds_gives_its_curve_from_a_speed_in_rpm() {
    let folder = Folder::new("speed_channel_signals");
    let brake = |speed| moment(speed) + windage(speed);
    folder.coasts("coast.csv", 6.3, brake);
    folder.coasts("bare.csv", 45.0, windage);
    let law = "windage_constant = \"0.5 N mm\"\nwindage_quadratic = \"0.2 uN m s^2\"\nwindage_deviation = 0.1\n";
    folder.write("law.toml", &signals("coast.csv", &steady(6.0, law)));
    folder.write("bare.toml", &signals("bare.csv", &steady(44.8, "")));
    let run = "windage_file = \"bare.toml\"\n";
    folder.write("run.toml", &signals("coast.csv", &steady(6.0, run)));
    for file in ["law.toml", "run.toml"] {
        let outcome = folder.outcome(file).unwrap();
        assert_eq!(
            outcome.stop.reason, "finished",
            "{file}: {}",
            outcome.stop.text
        );
        assert!((number(&outcome, "peak_speed") - 150.0).abs() < 0.5);
        // 1 rpm of noise, in which steps of half an rpm do not show
        assert!((number(&outcome, "speed_noise") - std::f64::consts::PI / 30.0).abs() < 0.015);
        let curve = |name: &str| {
            [
                list(&outcome, "steady_speeds"),
                list(&outcome, &format!("steady_{name}_torques")),
                list(&outcome, &format!("steady_{name}_deviations")),
            ]
        };
        let (two, four) = inside(curve("inertial"), moment);
        assert!(two >= 0.8 && four == 1.0, "{file}: {two} {four}");
        let (two, four) = inside(curve("windage"), windage);
        assert!(two >= 0.8 && four >= 0.95, "{file}, windage: {two} {four}");
        // a tenth of a windage that is a fifth of the moment there
        let [_, values, deviations] = curve("inertial");
        let middle = values.len() / 2;
        assert!(deviations[middle] < 0.1 * values[middle]);
    }
}

#[test]
fn an_identification_takes_the_moment_from_the_slope_of_a_speed() {
    let folder = Folder::new("speed_channel_identify");
    folder.coasts("coast.csv", 6.3, |speed| moment(speed) + windage(speed));
    let law = "windage_constant = \"0.5 N mm\"\nwindage_quadratic = \"0.2 uN m s^2\"\nwindage_deviation = 0.1\n";
    folder.write("coast.toml", &signals("coast.csv", &steady(6.0, law)));
    folder.write("identify.toml", IDENTIFY);
    let outcome = folder.outcome("identify.toml").unwrap();
    assert_eq!(outcome.stop.reason, "finished", "{}", outcome.stop.text);
    let curve = [
        list(&outcome, "steady_moment_speeds"),
        list(&outcome, "steady_moments"),
        list(&outcome, "steady_moment_deviations"),
    ];
    let (two, four) = inside(curve, moment);
    assert!(two >= 0.8 && four == 1.0, "{two} {four}");
    assert!((list(&outcome, "windage_torques")[0] - windage(curve[0][0])).abs() < 1e-9);
    let told = outcome
        .warnings
        .iter()
        .any(|w| w.text.contains("less the windage"));
    assert!(told);
}

#[test]
fn a_speed_and_a_torque_in_a_table_are_identified() {
    let folder = Folder::new("speed_and_torque");
    folder.coasts("coast.csv", 8.0, moment);
    let torque = "[signals.torque]\nchannel = \"torque\"\nsensor_frequency = \"100 Hz\"\ndamping_ratio = 0.05\nzero_deviation = \"0.05 N mm\"\n";
    folder.write("coast.toml", &signals("coast.csv", torque));
    folder.write("identify.toml", IDENTIFY);
    let outcome = folder.outcome("identify.toml").unwrap();
    assert_eq!(outcome.stop.reason, "finished", "{}", outcome.stop.text);
    let curve = [
        list(&outcome, "steady_moment_speeds"),
        list(&outcome, "steady_moments"),
        list(&outcome, "steady_moment_deviations"),
    ];
    // What the sensor feels in a coast-down is M less the inertia of balls and cage: below 0.2 % here.
    let (two, four) = inside(curve, moment);
    assert!(two >= 0.8 && four == 1.0, "{two} {four}");
}

#[test]
fn the_guide_holds_for_a_logger_of_100_hz_and_a_zero_at_the_end() {
    let folder = Folder::new("guide_100_hz");
    // it coasts for 8.0 s and stands for the rest
    folder.coasts_at(100.0, 0.7, "coast.csv", 10.5, moment);
    let torque = "[signals.torque]\nchannel = \"torque\"\nsensor_frequency = \"400 Hz\"\ndamping_ratio = 0.05\n";
    let text = signals("coast.csv", torque).replace("200 Hz", "50 Hz");
    folder.write("coast.toml", &text);
    folder.write("identify.toml", IDENTIFY);
    let read = folder.outcome("coast.toml").unwrap();
    assert_eq!(read.stop.reason, "finished", "{}", read.stop.text);
    let told: Vec<&str> = read.warnings.iter().map(|w| w.text.as_str()).collect();
    assert!(
        told.iter()
            .any(|text| text.contains("quicker than 100 values a second")),
        "{told:?}"
    );
    assert!(
        !told
            .iter()
            .any(|text| text.contains("zero of the reading is not known")),
        "{told:?}"
    );
    let column = |name: &str| &read.history.iter().find(|c| c.name == name).unwrap().values;
    let (time, torque) = (column("time"), column("torque.torque"));
    let middle = time.iter().position(|t| *t > 4.0).unwrap();
    let mean = |list: &[f64]| list[middle..middle + 100].iter().sum::<f64>() / 100.0;
    let (at, mean) = (mean(time), mean(torque));
    // after 150 rad/s the speed is that of an exponential towards -300 rad/s
    let expected = moment(450.0 * (-2e-5 / INERTIA * at).exp() - 300.0);
    // 32 values of 0.2 N mm each, and the zero of those at rest: two deviations are 0.08 N mm
    assert!((mean - expected).abs() < 1e-4, "{mean} {expected}");
    let outcome = folder.outcome("identify.toml").unwrap();
    assert_eq!(outcome.stop.reason, "finished", "{}", outcome.stop.text);
    let curve = [
        list(&outcome, "steady_moment_speeds"),
        list(&outcome, "steady_moments"),
        list(&outcome, "steady_moment_deviations"),
    ];
    let (two, four) = inside(curve, moment);
    assert!(two >= 0.8 && four == 1.0, "{two} {four}");
    // a stated zero that the rest contradicts is told, and the rest counts
    folder.write(
        "coast.toml",
        &format!("{text}zero_deviation = \"0.05 N mm\"\n"),
    );
    let read = folder.outcome("coast.toml").unwrap();
    let told = read.warnings.iter().find(|w| w.code == "AB1127");
    let text = &told.expect("it is told").text;
    assert!(text.contains("times the zero_deviation stated"), "{text}");
}

#[test]
fn what_a_speed_lacks_or_contradicts_is_told() {
    let folder = Folder::new("speed_channel_messages");
    folder.coasts("coast.csv", 2.0, moment);
    let refusal = |text: &str| {
        folder.write("a.toml", text);
        folder.outcome("a.toml").err().unwrap_or_default()
    };
    let marks = signals("coast.csv", "marks_per_revolution = 60\n");
    assert!(
        refusal(&marks).contains("a speed has no marks"),
        "{}",
        refusal(&marks)
    );
    let analog = "[signals]\nfile = \"coast.csv\"\n[signals.speed]\nchannel = \"speed\"\nmarks_per_revolution = 60\n";
    let why = refusal(&format!("{HEAD}{analog}"));
    assert!(why.contains("kind = \"speed\""), "{why}");
    let unit = signals("coast.csv", "").replace("channel = \"speed\"", "channel = \"torque\"");
    assert!(refusal(&unit).contains("signals.speed.scale"));
    let twice = signals("coast.csv", "scale = \"1 rad/s\"\n");
    assert!(refusal(&twice).contains("contradict"));
    let both = steady(
        1.8,
        "windage_constant = \"1 N mm\"\nwindage_file = \"b.toml\"\n",
    );
    let why = refusal(&signals("coast.csv", &both));
    assert!(why.contains("either the law of the windage"), "{why}");
    folder.write("a.toml", &signals("coast.csv", "set_speed = \"150 rpm\"\n"));
    let outcome = folder.outcome("a.toml").unwrap();
    assert!(outcome.warnings.iter().any(|w| w.code == "AB1121"));
    folder.write(
        "identify.toml",
        &IDENTIFY.replace("coast.toml", "none/signals.toml"),
    );
    let why = folder.outcome("identify.toml").err().unwrap();
    assert!(why.contains("auxbear run none.toml --out"), "{why}");
}
