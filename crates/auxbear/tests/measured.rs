//! Measured channels beside predicted columns, and inputs estimated from them.

use crate::outcomes::number;
use auxbear::outcome::{Outcome, Value};
use auxbear::run::{Options, build};
use auxbear::scenario::{BuiltIn, Scenario, StudyFile};
use auxbear::study::Study;
use auxbear::study::estimate::MISFIT;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

const DROP: &str = include_str!("../../../scenarios/measured_drop.toml");
const TRUTH: [&str; 2] = [
    "contact.friction_coefficient=0.21",
    "mount.damping=3200 N s/m",
];

fn shipped(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenarios/{name}.toml"))
}

fn read(path: &Path, sets: &[&str]) -> Result<Scenario, String> {
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    Scenario::read(path, &sets, &BuiltIn).map_err(|problem| problem.to_string())
}

fn ran(scenario: &Scenario) -> Result<Outcome, String> {
    let never = AtomicBool::new(false);
    let machine = build(scenario).map_err(|problem| problem.to_string())?;
    Ok(machine.run(&Options::unwatched(&never)))
}

/// The machine of the shipped scenario with other measured tables, and a file of these columns from -10 ms to 40 ms.
fn against(
    tables: &str,
    names: &str,
    step: f64,
    row: impl Fn(f64) -> String,
) -> Result<Outcome, String> {
    let folder = TempDir::new().unwrap();
    let machine = DROP.split("[[measured]]").next().unwrap();
    fs::write(folder.path().join("a.toml"), format!("{machine}{tables}")).unwrap();
    let mut text = format!("time [s]; {names}\n");
    for k in 0..=(0.05 / step).round() as u32 {
        let time = step * f64::from(k) - 0.01;
        writeln!(text, "{time:.6}; {}", row(time)).unwrap();
    }
    fs::write(folder.path().join("a.csv"), text).unwrap();
    let scenario = read(&folder.path().join("a.toml"), &[])?;
    // the resolved file stands elsewhere and says the same
    let again =
        Scenario::parse(&scenario.resolved.toml(), "elsewhere.toml", &[], &BuiltIn).unwrap();
    assert_eq!(again.measured.len(), scenario.measured.len());
    let of = |scenario: &Scenario| ran(scenario).map(|run| run.quantities);
    let found = ran(&scenario)?;
    assert_eq!(of(&again).unwrap(), found.quantities);
    Ok(found)
}

fn table(column: &str, channel: &str, more: &str) -> String {
    format!(
        "\n[[measured]]\ncolumn = \"{column}\"\nfile = \"a.csv\"\nchannel = \"{channel}\"\n{more}\n"
    )
}

#[test]
fn with_the_inputs_that_made_it_only_noise_is_left() {
    let run = ran(&read(&shipped("measured_drop"), &TRUTH).unwrap()).unwrap();
    // 1203 rows: the deviations are estimated from 300 values each, to some 5 %
    assert!((number(&run, MISFIT) - 1.0).abs() < 0.1);
    for column in ["rotor.x", "rotor.y", "bearing.inner_race.speed"] {
        let of = |end: &str| number(&run, &format!("measured.{column}.{end}"));
        assert!((of("share_within_band") - 0.95).abs() < 0.03, "{column}");
        let own = run.column(&format!("measured.{column}")).unwrap();
        assert_eq!(
            (own.values.len(), own.unit),
            (401, run.column(column).unwrap().unit)
        );
    }
    // noise of 1 um against a fall of 0.1 m/s at the clearance, within a row
    assert!(number(&run, "measured.rotor.first_contact.difference").abs() < 1e-4);
    // of the second drop the unbalance was turned by 60 degrees; six turns before the release show an orbit of 8 um with noise of 1 um
    let phase = |end: &str| {
        number(
            &run,
            &format!("measured.rotor.drop_2.phase_at_release.{end}"),
        )
    };
    let (difference, uncertainty) = (phase("difference"), phase("difference_uncertainty"));
    assert!(
        (difference - PI / 3.0).abs() < 3.0 * uncertainty && uncertainty < 0.03,
        "{difference} {uncertainty}"
    );
    let warned: Vec<&str> = run.warnings.iter().map(|own| own.code).collect();
    assert!(warned.contains(&"AB2341") && !warned.contains(&"AB2342"));
    let apart = number(&run, "measured.rotor.y.drop_2.rms_difference_from_drop_1");
    assert!((apart / number(&run, "measured.rotor.y.drop_2.rms_difference") - 1.0).abs() < 0.01);
}

/// The shipped measurement, of which only rows at some instants are kept.
fn kept(keep: fn(f64) -> bool) -> Outcome {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("a.toml"), DROP).unwrap();
    let file = "data/measured_drop.csv";
    let text = fs::read_to_string(shipped("measured_drop").with_file_name(file)).unwrap();
    let time = |line: &str| {
        line.split([',', ';'])
            .next()
            .and_then(|own| own.parse().ok())
    };
    let lines = text.lines().filter(|line| time(line).is_none_or(keep));
    let lines: Vec<&str> = lines.collect();
    fs::create_dir_all(folder.path().join(file).parent().unwrap()).unwrap();
    fs::write(folder.path().join(file), lines.join("\n")).unwrap();
    ran(&read(&folder.path().join("a.toml"), &TRUTH).unwrap()).unwrap()
}

#[test]
fn nothing_is_compared_in_a_gap_and_a_late_file_shows_no_first_contact() {
    let codes = |run: &Outcome| -> Vec<&str> { run.warnings.iter().map(|own| own.code).collect() };
    let gap = kept(|time| !(0.0402..0.0498).contains(&time));
    assert!(codes(&gap).contains(&"AB2344"), "{:?}", codes(&gap));
    let (time, own) = (
        gap.column("time").unwrap(),
        gap.column("measured.rotor.y").unwrap(),
    );
    for (time, value) in time.values.iter().zip(&own.values) {
        assert_eq!(value.is_nan(), (0.01015..0.01975).contains(time), "{time}");
    }
    assert!((number(&gap, MISFIT) - 1.0).abs() < 0.1);
    let late = kept(|time| time > 0.0395);
    assert!(codes(&late).contains(&"AB2343") && !codes(&late).contains(&"AB2344"));
    for name in ["first_contact", "phase_at_release"] {
        let own = late
            .quantity(&format!("measured.rotor.{name}.measured"))
            .unwrap();
        let Value::None { why } = &own.value else {
            panic!("{name}: {own:?}");
        };
        assert!(why.contains("begins after the release"), "{why}");
    }
}

/// The file was written from other inputs than those of the scenario; the bounds are far wider than what is found.
#[test]
fn an_estimate_finds_the_inputs_that_made_the_file() {
    let study = Study::new(StudyFile::read(&shipped("study_measured_drop")).unwrap()).unwrap();
    let members: Vec<usize> = (0..study.members()).collect();
    let never = AtomicBool::new(false);
    let options = Options::unwatched(&never);
    let run = study.run(&members, &options);
    let estimate = study.estimate(&run, &options).unwrap().unwrap();
    for (own, truth) in estimate.inputs.iter().zip([0.21, 3200.0]) {
        let uncertainty = own.uncertainty.unwrap();
        // two standard uncertainties
        assert!((own.value - truth).abs() < 2.0 * uncertainty, "{own:?}");
        assert!(
            uncertainty < 1e-3 * (own.bounds[1] - own.bounds[0]),
            "{own:?}"
        );
        assert_eq!(own.why, "");
    }
    assert!((estimate.misfit - 1.0).abs() < 0.1 && estimate.rival.is_none());
    // what its pictures show is what was fitted
    let left = estimate.curves.iter().flat_map(|own| {
        let both = own.measured.iter().zip(&own.predicted);
        both.map(|(a, b)| ((a - b) / own.deviation.unwrap()).powi(2))
    });
    let left: Vec<f64> = left.collect();
    assert_eq!(left.len() as f64, estimate.rows[0]);
    let rms = (left.iter().sum::<f64>() / left.len() as f64).sqrt();
    assert!((rms / estimate.misfit - 1.0).abs() < 1e-12, "{rms}");
    // members in lanes have the results of single runs
    let single = ran(&study.scenario(7).unwrap()).unwrap();
    assert_eq!(run.values(MISFIT)[7], Some(number(&single, MISFIT)));
    // whatever the number of threads
    let single = Options {
        threads: Some(1),
        ..options
    };
    assert_eq!(study.estimate(&run, &single).unwrap().unwrap(), estimate);
}

/// A study of two inputs beside a file that the machine itself made over a duration at other ones, with noise of 1 um and 1 rad/s.
fn estimated(truth: &[&str], duration: &str, members: usize) -> auxbear::study::estimate::Estimate {
    let folder = TempDir::new().unwrap();
    let machine = DROP.split("[[measured]]").next().unwrap();
    let tables = ["rotor.x", "rotor.y", "bearing.inner_race.speed"].map(|own| table(own, own, ""));
    let at = |name: &str| folder.path().join(name);
    let duration = format!("run.duration={duration}");
    let sets = [truth, &[duration.as_str()]].concat();
    fs::write(at("plain.toml"), machine).unwrap();
    let run = ran(&read(&at("plain.toml"), &sets).unwrap()).unwrap();
    let mut random = statistics::random::Random::new(5);
    let mut text =
        String::from("time [s]; rotor.x [m]; rotor.y [m]; bearing.inner_race.speed [rad/s]\n");
    let time = &run.column("time").unwrap().values;
    // before the release the rotor whirls as it does there
    let speed = run.column("rotor.speed").unwrap().values[0];
    let [x, y] = ["rotor.x", "rotor.y"].map(|name| run.column(name).unwrap().values[0]);
    let before = (1..=200).rev().map(|k| {
        let time = -1e-4 * f64::from(k);
        let (sine, cosine) = (speed * time).sin_cos();
        (time, [x * cosine - y * sine, x * sine + y * cosine, 0.0])
    });
    let column = |name: &str, row: usize| run.column(name).unwrap().values[row];
    let after = time.iter().enumerate().map(|(row, time)| {
        let own = ["rotor.x", "rotor.y", "bearing.inner_race.speed"].map(|name| column(name, row));
        (*time, own)
    });
    for (time, [x, y, race]) in before.chain(after) {
        let [a, b, c] = [1e-6, 1e-6, 1.0].map(|deviation| deviation * random.normal());
        writeln!(
            text,
            "{time:.6}; {:.9}; {:.9}; {:.4}",
            x + a,
            y + b,
            race + c
        )
        .unwrap();
    }
    fs::write(at("a.csv"), text).unwrap();
    fs::write(at("a.toml"), format!("{machine}{}", tables.concat())).unwrap();
    let study = fs::read_to_string(shipped("study_measured_drop")).unwrap();
    let study = study.replace("\"measured_drop.toml\"", "\"a.toml\"");
    let study = study.replace("members = 64", &format!("members = {members}"));
    let study = study.replace("[design]", &format!("set = [\"{duration}\"]\n\n[design]"));
    fs::write(at("study.toml"), study).unwrap();
    let study = Study::new(StudyFile::read(&at("study.toml")).unwrap()).unwrap();
    let members: Vec<usize> = (0..study.members()).collect();
    let never = AtomicBool::new(false);
    let options = Options::unwatched(&never);
    let run = study.run(&members, &options);
    study.estimate(&run, &options).unwrap().unwrap()
}

/// Impacts late in a record make valleys that a search over the whole of it once stayed in, 3 to 300 standard uncertainties away.
#[test]
fn late_impacts_do_not_hold_a_search_in_a_valley() {
    let found = estimated(&TRUTH, "100 ms", 16);
    assert!(
        found.explained && (found.misfit - 1.0).abs() < 0.1,
        "{found:?}"
    );
    for (own, truth) in found.inputs.iter().zip([0.21, 3200.0]) {
        let off = (own.value - truth).abs() / own.uncertainty.unwrap();
        assert!(off < 3.0 && own.why.is_empty(), "{off} {own:?}");
    }
}

/// A mass off by 0.4 % leaves a misfit hardly above 1 and moves the damping by many uncertainties: the residuals repeat each other.
#[test]
fn a_small_error_of_the_model_is_not_taken_for_noise() {
    let found = estimated(&[TRUTH[0], TRUTH[1], "rotor.mass=8.03 kg"], "40 ms", 8);
    assert!(!found.explained && found.misfit < 2.5, "{found:?}");
    let why = &found.inputs[1].why;
    assert!(why.contains("only if the rest of the model holds"), "{why}");
}

/// With a damping that is kept wrong, noise does not explain what is left: the friction is found only if the rest of the model holds.
#[test]
fn an_estimate_beside_a_wrong_input_says_so() {
    let folder = TempDir::new().unwrap();
    let text = fs::read_to_string(shipped("study_measured_drop")).unwrap();
    let scenario = shipped("measured_drop").display().to_string();
    let text = text.replace("\"measured_drop.toml\"", &format!("{scenario:?}"));
    let text = text.replace("members = 64", "members = 8");
    let (text, _) = text.rsplit_once("[[input]]").unwrap();
    let path = folder.path().join("study.toml");
    fs::write(&path, text).unwrap();
    let study = Study::new(StudyFile::read(&path).unwrap()).unwrap();
    let never = AtomicBool::new(false);
    let options = Options::unwatched(&never);
    let run = study.run(&[0, 1, 2, 3, 4, 5, 6, 7], &options);
    let estimate = study.estimate(&run, &options).unwrap().unwrap();
    assert!(estimate.misfit > 1.5, "{estimate:?}");
    let why = &estimate.inputs[0].why;
    assert!(
        why.starts_with("only if the rest of the model holds"),
        "{why}"
    );
}

/// An input without effect on the channels is not determined; nothing else is said of it.
#[test]
fn an_input_without_effect_is_not_determined() {
    let folder = TempDir::new().unwrap();
    let text = fs::read_to_string(shipped("study_measured_drop")).unwrap();
    let scenario = shipped("measured_drop").display().to_string();
    let text = text.replace("\"measured_drop.toml\"", &format!("{scenario:?}"));
    let text = text.replace("members = 64", "members = 4");
    let text = text.replace("\"mount.damping\"", "\"bearing.hertz_pressure_limit\"");
    let text = text
        .replace("1000 N s/m", "3 GPa")
        .replace("8000 N s/m", "4 GPa");
    let path = folder.path().join("study.toml");
    fs::write(&path, text).unwrap();
    let study = Study::new(StudyFile::read(&path).unwrap()).unwrap();
    let never = AtomicBool::new(false);
    let options = Options::unwatched(&never);
    let run = study.run(&[0, 1, 2, 3], &options);
    let estimate = study.estimate(&run, &options).unwrap().unwrap();
    let last = &estimate.inputs[1];
    assert!(
        last.uncertainty.is_none() && last.why.starts_with("not determined"),
        "{last:?}"
    );
}

/// A half-sine F sin(πt/T) from 10 ms on has the impulse 2 F T/π; a circle goes round at its own rate.
#[test]
fn features_of_known_curves_are_theirs() {
    let (force, lasts) = (500.0, 5e-3);
    let tables = table("bearing.contact.force", "f", "deviation = \"1 N\"")
        + &table("rotor.x", "x", "deviation = \"1 um\"")
        + &table("rotor.y", "y", "deviation = \"1 um\"");
    let run = against(&tables, "f [N]; x [mm]; y [mm]", 1e-4, |time| {
        let phase = PI * (time - 0.01) / lasts;
        let force = if (0.0..=PI).contains(&phase) {
            force * phase.sin()
        } else {
            0.0
        };
        let angle = TAU * 100.0 * time;
        // the radius grows by 20 um a ms up to 0.3 mm
        let radius = (0.02 * (1e3 * time).max(0.0)).min(0.3);
        format!(
            "{force:.4}; {:.6}; {:.6}",
            radius * angle.cos(),
            -radius * angle.sin()
        )
    });
    let run = run.unwrap();
    let of = |name: &str| number(&run, &format!("measured.{name}.measured"));
    // it begins at the threshold, a fiftieth of the predicted peak of 630 N: up to 0.05 ms late, and 0.08 ms short
    assert!((of("bearing.contact.force.first_contact") - 0.01).abs() < 0.1e-3);
    assert!((of("bearing.contact.force.contact_duration") / lasts - 1.0).abs() < 0.03);
    assert!((of("bearing.contact.force.impulse") / (2.0 * force * lasts / PI) - 1.0).abs() < 0.01);
    assert!((of("bearing.contact.force.peak") / force - 1.0).abs() < 1e-3);
    assert!((of("rotor.whirl_frequency") / (-TAU * 100.0) - 1.0).abs() < 1e-6);
    // the clearance of 0.25 mm
    assert!((of("rotor.first_contact") - 12.5e-3).abs() < 1e-6);
    let peak = number(&run, "measured.bearing.contact.force.peak.predicted");
    assert!((peak / number(&run, "peak_contact_force") - 1.0).abs() < 0.01);
}

#[test]
fn a_coarse_file_of_a_part_of_the_run_is_compared_there() {
    let tables = table("rotor.y", "y", "clock_offset = \"30 ms\"");
    let run = against(&tables, "y [mm]", 1e-4, |time| format!("{time}")).unwrap();
    let own = run.column("measured.rotor.y").unwrap();
    assert!(own.values[199].is_nan() && own.values[201].is_finite());
    let codes: Vec<&str> = run.warnings.iter().map(|own| own.code).collect();
    assert!(codes.contains(&"AB2343") && codes.contains(&"AB2342") && !codes.contains(&"AB2340"));
    for (step, finer) in [(1e-3, false), (2e-5, true)] {
        let run = against(&table("rotor.y", "y", ""), "y [mm]", step, |time| {
            format!("{time}")
        });
        let codes: Vec<&str> = run.unwrap().warnings.iter().map(|own| own.code).collect();
        assert_eq!(codes.contains(&"AB2340"), finer, "{step}");
        assert!(!codes.contains(&"AB2343"));
    }
}

/// A whirl needs samples enough to show its sense: a backward one of 80 Hz has it with 12 a turn; with fewer than four a turn of the rotor
/// at 200 Hz it might be a forward one.
#[test]
fn a_whirl_of_few_samples_a_turn_has_its_sense_or_none() {
    let tables = table("rotor.x", "x", "deviation = \"1 um\"")
        + &table("rotor.y", "y", "deviation = \"1 um\"");
    for (step, rate, said) in [
        (1e-3, -80.0, ""),
        (1e-3, -140.0, "fewer than eight samples a turn"),
        (4.9e-3, -10.0, "fewer than four samples a turn of the rotor"),
    ] {
        let run = against(&tables, "x [mm]; y [mm]", step, |time| {
            let angle: f64 = TAU * rate * time;
            format!("{:.6}; {:.6}", 0.2 * angle.cos(), 0.2 * angle.sin())
        });
        let run = run.unwrap();
        let own = run
            .quantity("measured.rotor.whirl_frequency.measured")
            .unwrap();
        match &own.value {
            Value::None { why } => assert!(!said.is_empty() && why.contains(said), "{why}"),
            _ => {
                assert!(
                    (number(&run, &own.name) / (TAU * rate) - 1.0).abs() < 1e-6 && said.is_empty()
                );
                // two ends of a micrometre on 0.2 mm, over 40 ms
                let spread = number(&run, "measured.rotor.whirl_frequency.uncertainty");
                assert!(
                    (spread / (2_f64.sqrt() / 200.0 / 0.04) - 1.0).abs() < 0.1,
                    "{spread}"
                );
            }
        }
    }
}

/// Each wrong table is refused with the line of its key, what was found and what is needed.
#[test]
fn wrong_tables_are_refused_with_what_is_there() {
    let good = || table("rotor.y", "y", "");
    let with = |more: &str| table("rotor.y", "y", more);
    for (tables, said) in [
        (
            table("rotor.yy", "y", ""),
            "[AB0340]: |measured.column: found \"rotor.yy\", which is no column of this run|Did you mean \"rotor.y\"",
        ),
        (table("time", "y", ""), "[AB0340]: |measured.column"),
        (
            table("rotor.y", "Y1", ""),
            "[AB0304]: |measured.channel: found |which has no channel \"Y1\"|it has the channels \"time\", \"y\", \"bare\", \"gap\"",
        ),
        (
            table("rotor.speed", "y", ""),
            "[AB0306]: |measured.channel: found channel \"y\" in mm; a unit of the kind of rad/s is needed in the file, or measured.unit",
        ),
        (
            table("rotor.y", "bare", ""),
            "[AB0306]: |channel \"bare\" without a unit",
        ),
        (
            with("unit = \"N\""),
            "[AB0306]: |measured.unit: found channel \"y\" in N",
        ),
        (
            with("unit = \"um\""),
            "[AB0306]: |measured.unit: found channel \"y\" in mm, and um; one of the two units is needed",
        ),
        (
            table("rotor.speed", "y", "unit = \"rpm\""),
            "[AB0306]: |measured.unit: found channel \"y\" in mm",
        ),
        (
            table("rotor.y", "gap", ""),
            "[AB0106]: |measured.channel: found channel \"gap\", whose value 151 is no number",
        ),
        (
            with("clock_offset = \"1 s\""),
            "[AB0305]: |measured.clock_offset: found a file from 0.99 s to 1.04 s on the clock of the run|from 0 s to 0.04 s",
        ),
        (
            with("clock_offset = \"12\""),
            "[AB0103]: |measured.clock_offset",
        ),
        (
            with("deviation = \"1 N\""),
            "[AB0105]: |measured.deviation: found \"1 N\"; a quantity of the kind of m is needed",
        ),
        (
            with("deviation = \"0 um\""),
            "[AB0106]: |measured.deviation",
        ),
        (with("scale = 0"), "[AB0106]: |measured.scale"),
        (with("sensor = 1"), "[AB0101]: |measured.sensor"),
        (with("drop = 0"), "[AB0106]: |measured.drop"),
        (
            good() + &good(),
            "[AB0109]: |measured.column: found \"rotor.y\" twice",
        ),
        (
            good() + &with("drop = 2"),
            "[AB0109]: |measured.drop: found the record of drop 1 once more",
        ),
        (
            good().replace("a.csv", "b.csv"),
            "[AB0303]: |measured.file: found |b.csv: cannot be opened",
        ),
        (
            good().replace("file = \"a.csv\"\n", ""),
            "[AB0107]: |measured.file: found no value",
        ),
        (
            "\n[measured]\ncolumn = \"rotor.y\"\n".to_string(),
            "[AB0102]: |measured",
        ),
    ] {
        let run = against(&tables, "y [mm]; bare; gap [mm]", 1e-4, |time| {
            let gap = if (time - 0.005).abs() < 1e-6 { "" } else { "1" };
            format!("1; 1; {gap}")
        });
        let refused = run.map(|_| ()).expect_err(&tables);
        for part in said.split('|') {
            assert!(refused.contains(part), "{tables}{refused}\nlacks {part}");
        }
        assert!(refused.contains("a.toml:"), "{refused}");
    }
    let set = |set: &str| read(&shipped("measured_drop"), &[set]);
    let moved = set("measured.rotor.y.drop_2.clock_offset=12 ms").unwrap();
    let offsets: Vec<f64> = moved.measured.iter().map(|own| own.clock_offset).collect();
    assert_eq!(offsets, [-0.03, -0.03, -0.03, -0.03, 0.012]);
    let refused = set("measured.rotor.z.scale=2").unwrap_err();
    assert!(
        refused.contains(
            "with one of the columns of [[measured]]: rotor.x, rotor.y, bearing.inner_race.speed, rotor.x.drop_2"
        ),
        "{refused}"
    );
    let torque = format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"torque\"\n[bearing]\nname = \"6005\"\n{}",
        good()
    );
    let refused = Scenario::parse(&torque, "a.toml", &[], &BuiltIn)
        .unwrap_err()
        .to_string();
    assert!(
        refused.contains("[AB0110]: a.toml:7: measured: found a section that has no effect"),
        "{refused}"
    );
}

#[test]
fn an_estimate_needs_measured_channels_and_bounds() {
    let text = fs::read_to_string(shipped("study_measured_drop")).unwrap();
    let refused = |text: &str| {
        let folder = shipped("x");
        let study = StudyFile::parse(text, "study.toml", folder.parent());
        study.map(|_| ()).unwrap_err().to_string()
    };
    let said = refused(&text.replace("\"measured_drop.toml\"", "\"reference_drop.toml\""));
    assert!(
        said.contains("[AB2201]") && said.contains("[[measured]]"),
        "{said}"
    );
    let folder = TempDir::new().unwrap();
    let second = DROP.replacen("[[measured]]", "[[measured]]\ndrop = 2", 3);
    fs::write(
        folder.path().join("drop_2.toml"),
        second.rsplitn(3, "[[measured]]").last().unwrap(),
    )
    .unwrap();
    let second = folder.path().join("drop_2.toml").display().to_string();
    let said = refused(&text.replace("\"measured_drop.toml\"", &format!("{second:?}")));
    assert!(
        said.contains("[AB2201]") && said.contains("drop 1"),
        "{said}"
    );
    let said = refused(&text.replace("uniform = [0.1, 0.35]", "lognormal = 0.2"));
    assert!(
        said.contains("[AB2201]") && said.contains("bounds are needed"),
        "{said}"
    );
}
