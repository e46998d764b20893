//! A rig is simulated, its logger's raw files are written, read and identified: end to end.

use crate::outcomes::{has_declared_columns, number};
use auxbear::outcome::{Attached, Value};
use auxbear::report::directory;
use auxbear::run::{Options, Outcome, run};
use auxbear::scenario::{BuiltIn, Scenario};
use recording::file;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

fn scenarios() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios")
}

fn attempted(scenario: &Scenario) -> Outcome {
    let interrupt = AtomicBool::new(false);
    let outcome = run(scenario, &Options::unwatched(&interrupt)).expect("it builds");
    has_declared_columns(scenario, &outcome);
    outcome
}

fn simulated(scenario: &Scenario) -> Outcome {
    let outcome = attempted(scenario);
    assert!(outcome.stop.complete(), "{:?}", outcome.stop);
    outcome
}

fn shipped(name: &str, sets: &[&str]) -> Scenario {
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    let path = scenarios().join(format!("{name}.toml"));
    Scenario::read(&path, &sets, &BuiltIn).expect("it is shipped")
}

/// Runs a shipped rig into `folder/runs/NAME`, as the command does.
fn into_runs(folder: &Path, name: &str, sets: &[&str]) -> Outcome {
    let scenario = shipped(name, sets);
    let outcome = simulated(&scenario);
    directory::write(&folder.join("runs").join(name), &scenario, &outcome).expect("it is written");
    outcome
}

fn value<'a>(outcome: &'a Outcome, name: &str) -> &'a Value {
    let quantity = outcome.quantity(name);
    &quantity.unwrap_or_else(|| panic!("no {name}")).value
}

/// The identification of what stands in `folder/runs`.
fn identified(folder: &Path, tests: &[&str], more: &str) -> Outcome {
    simulated(&identification(folder, tests, more))
}

/// What asks for it.
fn identification(folder: &Path, tests: &[&str], more: &str) -> Scenario {
    let listed: Vec<String> = tests
        .iter()
        .map(|name| format!("\"runs/{name}/signals.toml\""))
        .collect();
    let text = format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"identify\"\n[identify]\n\
         coast_down = [\"runs/rig_coast_down/signals.toml\"]\ntests = [{}]\nviscosity = \"100 mm^2/s\"\n{more}\n\
         [bearing]\nname = \"6005\"\n",
        listed.join(", ")
    );
    let path = folder.join("identify.toml");
    std::fs::write(&path, text).expect("a folder to write to");
    Scenario::read(&path, &[], &BuiltIn).expect("it is right")
}

#[test]
fn a_raw_file_holds_the_same_in_every_format() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut torques: Vec<Vec<f64>> = Vec::new();
    for format in ["tdms", "csv", "parquet"] {
        let wish = format!("rig.logger.file={format}");
        let scenario = shipped(
            "rig_test_3",
            &[&wish, "run.duration=0.4 s", "rig.release_at=0.35 s"],
        );
        let outcome = simulated(&scenario);
        let path = folder.path().join(format);
        directory::write(&path, &scenario, &outcome).expect("it is written");
        let mut recording = file::open(path.join(format!("raw.{format}"))).expect("it is read");
        assert!(recording.notes().is_empty(), "{:?}", recording.notes());
        let channels = recording.channels().to_vec();
        let names: Vec<&str> = channels
            .iter()
            .map(|channel| channel.name.as_str())
            .collect();
        let index = names
            .iter()
            .position(|name| name.ends_with("torque"))
            .expect("a torque");
        assert_eq!(channels[index].unit, "N m", "{format}");
        let mut values = vec![0.0; channels[index].count as usize];
        let count = recording.read(index, 0, &mut values).expect("it is read");
        values.truncate(count);
        torques.push(values);
    }
    // 0.4 s of four channels in turn at 42 kHz, from 1/42 kHz on
    assert_eq!(torques[0].len(), 4200);
    for other in &torques[1..] {
        assert_eq!(other.len(), torques[0].len());
        for (a, b) in other.iter().zip(&torques[0]) {
            // a text holds every digit
            assert!((a - b).abs() <= 1e-15, "{a} {b}");
        }
    }
}

#[test]
fn the_seed_decides_everything_random() {
    let raw = |seed: &str| {
        let scenario = shipped(
            "rig_test_3",
            &[seed, "run.duration=0.3 s", "rig.release_at=0.29 s"],
        );
        let outcome = simulated(&scenario);
        match outcome.files.into_iter().next().map(|file| file.content) {
            Some(Attached::Recording(channels)) => channels,
            other => panic!("{other:?}"),
        }
    };
    let (first, again, other) = (
        raw("rig.logger.seed=7"),
        raw("rig.logger.seed=7"),
        raw("rig.logger.seed=8"),
    );
    assert!(first == again);
    for (a, b) in first.iter().zip(&other) {
        assert!(a.1 != b.1, "{}", a.0.name);
    }
}

#[test]
fn the_wanted_peak_acceleration_is_reached_and_momentum_closes() {
    for (name, wanted) in [
        ("rig_test_1", 1300.0),
        ("rig_test_2", 7200.0),
        ("rig_test_3", 11_500.0),
    ] {
        let outcome = simulated(&shipped(
            name,
            &["run.duration=1 s", "rig.release_at=0.9 s"],
        ));
        let peak = number(&outcome, "peak_acceleration");
        // the search ends at 0.01 %
        assert!((peak / wanted - 1.0).abs() < 1e-3, "{name}: {peak}");
        assert!(number(&outcome, "angular_momentum_residual").abs() < 1e-8);
        assert!(number(&outcome, "energy_residual").abs() < 1e-6);
    }
}

/// A test whose torque was cut at the end of its range shows nothing of the bearing.
#[test]
fn a_clipped_test_is_not_identified() {
    let folder = tempfile::tempdir().expect("a folder");
    into_runs(folder.path(), "rig_coast_down", &[]);
    into_runs(folder.path(), "rig_test_2", &["rig.arm.range=28 N mm"]);
    let found = attempted(&identification(
        folder.path(),
        &["rig_test_2"],
        "explanations.compare = false",
    ));
    // it is the only one
    assert!(!found.stop.complete(), "{:?}", found.stop);
    let shown = (found.warnings.iter()).find(|warning| warning.code == "AB1060");
    let shown = shown.expect("it is reported").to_string();
    assert!(
        shown.starts_with("rig_test_2: it is not used: the reading is clipped at 2"),
        "{shown}"
    );
    assert!(!(found.quantities.iter()).any(|quantity| quantity.name.starts_with("test_1.")));
}

/// What the rig calls its peak acceleration is what the signals say of it: that of the spin-up, not of the release.
#[test]
fn the_peak_of_a_ramp_is_not_that_of_its_release() {
    let folder = tempfile::tempdir().expect("a folder");
    let short = ["run.duration=12 s"];
    let truth = into_runs(folder.path(), "rig_slow_ramp", &short);
    let (peak, release) = (
        number(&truth, "peak_acceleration"),
        number(&truth, "peak_deceleration"),
    );
    // the motor rises by 30 rad/s²
    assert!((peak / 30.0 - 1.0).abs() < 0.02, "{peak}");
    assert!(release < -35.0, "{release}");
    let signals = folder.path().join("runs/rig_slow_ramp/signals.toml");
    let read = simulated(&Scenario::read(&signals, &[], &BuiltIn).expect("it is written"));
    let (found, deviation) = (
        number(&read, "peak_acceleration"),
        number(&read, "peak_acceleration_deviation"),
    );
    assert!(
        (found - peak).abs() < 3.0 * deviation + 0.01 * peak,
        "{found} ± {deviation}, not {peak}"
    );
    let coasting = simulated(&shipped("rig_coast_down", &["run.duration=1 s"]));
    let (peak, slowing) = (
        number(&coasting, "peak_acceleration"),
        number(&coasting, "peak_deceleration"),
    );
    assert!(peak < 0.0 && peak == slowing, "{peak} {slowing}");
}

/// Whether the grease's parameters lie within two deviations of what the scenarios say; ± of a text is one deviation.
fn parameters_hold_the_truth(outcome: &Outcome) {
    let Value::Text(text) = value(outcome, "explanation_parameters") else {
        panic!("no parameters");
    };
    let turn = std::f64::consts::TAU;
    for (name, truth) in [
        ("drag factor of fresh grease", 0.3),
        ("drag factor after breakdown", 0.7),
        ("cage angle of the build-up", 0.7 * turn),
        ("time of the breakdown", 1.5),
    ] {
        let after = text.split(name).nth(1).unwrap_or_else(|| panic!("{text}"));
        let mut words = after.split([' ', ';']).filter(|word| !word.is_empty());
        let mut next = || words.next().and_then(|word| word.parse::<f64>().ok());
        let mean = next().unwrap_or_else(|| panic!("{text}"));
        let _ = next();
        let deviation = next().unwrap_or_else(|| panic!("{text}"));
        assert!(
            (mean - truth).abs() < 2.0 * deviation && deviation < 0.15 * truth,
            "{name}: {truth}, {text}"
        );
    }
}

/// The source paper's three tests with a grease state: simulated, written, read, identified.
#[test]
fn the_grease_of_three_tests_is_found() {
    let folder = tempfile::tempdir().expect("a folder");
    into_runs(folder.path(), "rig_coast_down", &[]);
    let tests = ["rig_test_1", "rig_test_2", "rig_test_3"];
    for name in tests {
        into_runs(folder.path(), name, &[]);
    }
    into_runs(folder.path(), "rig_slow_ramp", &[]);
    let found = identified(folder.path(), &tests, "");
    let grease = |outcome: &Outcome| number(outcome, "probability_of_rolling_with_a_grease_state");
    let wrong = |outcome: &Outcome| {
        ["rolling", "isothermal_slip", "slip_with_heating"]
            .iter()
            .map(|name| number(outcome, &format!("probability_of_{name}")))
            .sum::<f64>()
    };
    assert!(grease(&found) > 0.95 && wrong(&found) < 1e-6);
    parameters_hold_the_truth(&found);
    let with_ramp = ["rig_test_1", "rig_test_2", "rig_test_3", "rig_slow_ramp"];
    let decided = identified(folder.path(), &with_ramp, "");
    assert_eq!(
        value(&decided, "explanation"),
        &Value::Text("rolling with a grease state".to_string())
    );
    assert!(grease(&decided) > 0.95);
    parameters_hold_the_truth(&decided);
    for test in 1..=3 {
        let of = |name: &str| number(&found, &format!("test_{test}.{name}"));
        // worked grease: 30 % less of the speed-dependent part, which is all but 1 N mm of 26
        let (late, deviation) = (
            of("excess_torque_at_end"),
            of("excess_torque_at_end_deviation"),
        );
        assert!(
            (-8.5e-3..-5.5e-3).contains(&late) && deviation < 1.5e-3,
            "{late} ± {deviation}"
        );
        assert!(of("slip_probability") < 0.05);
    }
}

/// Three tests of a bearing that rolls in oil that warms, whose slow test was at one temperature.
#[test]
fn oil_that_warms_is_told_from_slip_and_grease() {
    let folder = tempfile::tempdir().expect("a folder");
    // the oil of the tests at their 25 degC
    let oil = [
        "bearing.moment.viscosity=244 mm^2/s",
        "bearing.moment.f1_factor=0.0007",
        "bearing.moment.f1_exponent=0.5",
    ];
    into_runs(folder.path(), "rig_coast_down", &oil);
    let names = ["slow", "quick", "quickest"];
    for (name, peak) in names.iter().zip([1300, 7200, 11_500]) {
        let peak = format!("rig.peak_acceleration={peak} rad/s^2");
        let scenario = shipped("rig_test_3_warming", &[&peak]);
        let outcome = simulated(&scenario);
        let place = folder.path().join("runs").join(name);
        directory::write(&place, &scenario, &outcome).expect("it is written");
    }
    let found = identified(folder.path(), &names, "");
    // of 2.8 g it warms so slowly that a sensor that creeps may remain
    let Value::Text(verdict) = value(&found, "explanation") else {
        panic!("no verdict");
    };
    let first = verdict.trim_start_matches("undecided: ");
    assert!(first.starts_with("rolling in oil that warms"), "{verdict}");
    for other in [
        "slip_with_heating",
        "rolling_with_a_grease_state",
        "rolling",
    ] {
        let probability = number(&found, &format!("probability_of_{other}"));
        assert!(probability < 0.05, "{other}: {probability}");
    }
}

/// A shipped test without its loss of accelerated balls, which balls that may slide do not have.
fn without_loss(folder: &Path, name: &str, sets: &[&str]) -> Scenario {
    let text = std::fs::read_to_string(scenarios().join(format!("{name}.toml")));
    let text = text.expect("it is shipped");
    let (before, after) = text
        .split_once("[bearing.acceleration_loss]")
        .expect("a loss");
    let (_, after) = after.split_once("[run]").expect("a duration");
    let path = folder.join(format!("{name}.toml"));
    std::fs::write(&path, format!("{before}[run]{after}")).expect("a folder to write to");
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    Scenario::read(&path, &sets, &BuiltIn).expect("it is right")
}

/// What was found of one laboratory whose truth is known.
struct Row {
    explanation: f64,
    form: f64,
    found: Outcome,
}

/// A row of the table of truths: three tests and the coast-down by a logger of this seed.
///
/// - `name`, `truth`: of the laboratory, of its explanation
/// - `rig`, `bearing`: of all runs, of the tests
/// - `grease`: whether the grease of the tests changes
fn row(
    name: &str,
    truth: &str,
    seed: u64,
    (rig, bearing): (&[&str], &[&str]),
    grease: bool,
) -> Row {
    let folder = tempfile::tempdir().expect("a folder");
    let logger = format!("rig.logger.seed={seed}");
    fn with<'a>(logger: &'a str, rig: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
        [&[logger], rig, more].concat()
    }
    into_runs(folder.path(), "rig_coast_down", &with(&logger, rig, &[]));
    let names = ["rig_test_1", "rig_test_2", "rig_test_3"];
    for (test, peak) in names.iter().zip([1300, 7200, 11_500]) {
        let peak = format!("rig.peak_acceleration={peak} rad/s^2");
        // without a grease state: the same rig, its loss as the laboratory has it
        let (scenario, own) = match grease {
            true => (*test, bearing.to_vec()),
            false => ("rig_loss_3", [&[peak.as_str()], bearing].concat()),
        };
        let sets = with(&logger, rig, &own);
        let scenario = match own.contains(&"bearing.fidelity=planar") {
            true => without_loss(folder.path(), scenario, &sets),
            false => shipped(scenario, &sets),
        };
        let outcome = simulated(&scenario);
        let place = folder.path().join("runs").join(test);
        directory::write(&place, &scenario, &outcome).expect("it is written");
    }
    let found = identified(folder.path(), &names, "");
    let row = Row {
        explanation: number(&found, &format!("probability_of_{truth}")),
        form: number(&found, "probability_of_palmgren_form"),
        found,
    };
    println!(
        "{name}, seed {seed}: {truth} {:.4} of {:.1} effective data, Palmgren {:.4} of {:.1}",
        row.explanation,
        number(&row.found, "explanation_effective_data"),
        row.form,
        number(&row.found, "effective_steady_data"),
    );
    assert!(row.explanation > 0.05 && row.form > 0.05, "{name} {seed}");
    // no odds beyond what so many data can say
    for (list, effective) in [
        (
            &["palmgren_form", "skf_form", "spline_form"][..],
            "effective_steady_data",
        ),
        (
            &["rolling", "isothermal_slip", "sensor_artefact"][..],
            "explanation_effective_data",
        ),
    ] {
        let least = (-number(&row.found, effective)).exp() / 7.0;
        for one in list {
            let probability = number(&row.found, &format!("probability_of_{one}"));
            assert!(probability >= 0.5 * least, "{one}: {probability:e}");
        }
    }
    row
}

const GREASE: &str = "rolling_with_a_grease_state";

/// The truth of laboratories that do what the paper's three explanations say is found, and the form of their steady moment.
#[test]
fn the_truth_of_laboratories_is_found() {
    let quiet = [
        "rig.arm.synchronous_amplitude=0 N m",
        "rig.arm.zero=0 N m",
        "rig.arm.scale_error=0",
    ];
    // one logger of the shipped test, or as many as are asked for
    let loggers = std::env::var("AUXBEAR_SEEDS").ok();
    let loggers: Option<u64> = loggers.and_then(|text| text.parse().ok());
    for seed in 1..=loggers.unwrap_or(1) {
        row("shipped", GREASE, seed, (&[], &[]), true);
    }
    if loggers.is_some() {
        row("quiet arm", GREASE, 1, (&quiet, &[]), true);
    }
    let skid = [
        "bearing.fidelity=planar",
        "bearing.operating_diametral_clearance=-0.8 um",
    ];
    let skid = row("skid", "isothermal_slip", 1, (&[], &skid), false);
    assert_eq!(
        value(&skid.found, "explanation"),
        &Value::Text("isothermal slip".to_string())
    );
    let loss = row("loss", "rolling", 1, (&[], &[]), false);
    assert_eq!(
        value(&loss.found, "explanation"),
        &Value::Text("rolling".to_string())
    );
    map_holds_the_loss(&loss.found);
}

/// F over speed and acceleration is that of the scenario, 1e-4 N s²/rad times |Ω̇|, within two deviations nearly everywhere.
fn map_holds_the_loss(found: &Outcome) {
    let list = |name: &str| match value(found, name) {
        Value::List(list) => list.clone(),
        other => panic!("{name}: {other:?}"),
    };
    let [accelerations, friction, deviations, known] =
        ["accelerations", "friction", "deviations", "known"]
            .map(|name| list(&format!("loss_map_{name}")));
    let (mut inside, mut of) = (0, 0);
    let mut ratios = Vec::new();
    for k in (0..known.len()).filter(|k| known[*k] > 0.0 && accelerations[*k] > 0.0) {
        let truth = 1e-4 * accelerations[k];
        of += 1;
        inside += u32::from((friction[k] - truth).abs() <= 2.0 * deviations[k]);
        ratios.push(friction[k] / truth);
    }
    ratios.sort_by(f64::total_cmp);
    let middle = ratios[ratios.len() / 2];
    println!("map of F: {inside} of {of} within two deviations, median ratio {middle:.3}");
    assert!(of > 100 && inside >= 9 * of / 10 && (middle - 1.0).abs() < 0.1);
}

/// The dissipation of a rolling bearing, as estimated from the outer race, beside the heat of the simulation.
#[test]
fn the_energy_of_a_spin_up_lies_in_its_band() {
    let folder = tempfile::tempdir().expect("a folder");
    into_runs(folder.path(), "rig_coast_down", &[]);
    let tests = ["rig_test_1", "rig_test_2", "rig_test_3"];
    let truths = tests.map(|name| into_runs(folder.path(), name, &[]));
    let found = identified(folder.path(), &tests, "explanations.compare = false");
    let column = |outcome: &Outcome, name: &str| -> Vec<f64> {
        let column = outcome.history.iter().find(|column| column.name == name);
        column.unwrap_or_else(|| panic!("no {name}")).values.clone()
    };
    for (number_of_test, truth) in truths.iter().enumerate() {
        let of = |name: &str| number(&found, &format!("test_{}.{name}", number_of_test + 1));
        // the truth: rolling balls keep ½ J_I Ω², what t_I put in besides is heat
        let until = of("engagement_time") + of("dissipation_until");
        let (time, heat) = (
            column(truth, "time"),
            column(truth, "energy.heat.steady_moment"),
        );
        let after = time.partition_point(|time| *time < until);
        let share = (until - time[after - 1]) / (time[after] - time[after - 1]);
        let heat = heat[after - 1] + share * (heat[after] - heat[after - 1]);
        let forms = ["printed", "corrected", "exact"].map(|form| {
            let name = format!("dissipated_energy_{form}");
            (of(&name), of(&format!("{name}_deviation")))
        });
        let [printed, corrected, exact] = forms;
        for (energy, deviation) in [corrected, exact] {
            assert!(
                (energy - heat).abs() < 2.0 * deviation && deviation < 0.05 * heat,
                "{energy} ± {deviation} J, not {heat} J until {until} s: {forms:?}"
            );
        }
        // (21) counts the moment 1.4 times
        assert!(printed.0 > 1.2 * heat, "{forms:?} {heat}");
        if std::env::var("SHOW").is_ok() {
            println!("test {}: {heat} J, {forms:?}", number_of_test + 1);
        }
    }
}
