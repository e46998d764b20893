//! A base that moves, a rotor that starts displaced, and a blade that is lost.

use crate::machine::{STIFF, parsed, ran};
use crate::outcomes::number;
use auxbear::outcome::Outcome;
use auxbear::scenario::{BuiltIn, Scenario, System};
use auxbear::simulate::drop::build;
use std::f64::consts::{PI, TAU};
use std::fs;

const BLADE: &str = include_str!("../../../scenarios/machine_blade_loss.toml");

fn last(run: &Outcome, column: &str) -> f64 {
    let column = run.column(column).expect("a column");
    column.values.last().copied().unwrap()
}

/// Acceleration of the base along x and y as the model has it, at its points.
fn record(text: &str) -> Result<[Vec<(f64, f64)>; 2], String> {
    let scenario = parsed(text, &[])?;
    let System::Drop(drop) = &scenario.system else {
        panic!("a machine");
    };
    let built = build::drop(drop).map_err(|problem| problem.to_string())?;
    let base = built.constants.base.expect("a base");
    Ok(base.record.map(|table| table.points().to_vec()))
}

/// Seen from the base a rotor that touches nothing falls by g t²/2 less the way of the base: of a half-sine a T/π (t - T/π sin πt/T), of a
/// record that rises linearly a t³/(6T).
#[test]
fn a_rotor_that_touches_nothing_moves_against_its_base() {
    let sets = ["run.duration=4 ms", "contact.radial_air_clearance=5 mm"];
    let free = ran(STIFF, &sets);
    let base = "[base]\nshock_y = \"-30 m/s^2\"\nshock_duration = \"4 ms\"\nrecord_x = [[\"0 s\", \"0 m/s^2\"], [\"4 ms\", \"20 m/s^2\"]]\n";
    let shaken = ran(&format!("{STIFF}\n{base}"), &sets);
    let t = 4e-3;
    let moved = |column: &str| last(&shaken, column) - last(&free, column);
    let (x, y) = (-20.0 * t * t / 6.0, 30.0 * t * t / PI);
    assert!(
        (moved("a.rotor.x") / x - 1.0).abs() < 1e-4,
        "{}",
        moved("a.rotor.x")
    );
    assert!(
        (moved("a.rotor.y") / y - 1.0).abs() < 1e-4,
        "{}",
        moved("a.rotor.y")
    );
    assert!((number(&shaken, "base_largest_acceleration") - 30.0).abs() < 4.0);
    assert!(number(&shaken, "energy_residual").abs() < 1e-6);
    assert!(last(&shaken, "base.acceleration_x") > 19.9);
}

#[test]
fn a_rotor_starts_displaced_with_a_velocity_of_its_own() {
    let sets = ["run.duration=1 ms", "contact.radial_air_clearance=5 mm"];
    let steady = ran(STIFF, &sets);
    let own = [
        "rotor.start_x=0.1 mm",
        "rotor.start_y=-0.05 mm",
        "rotor.start_speed_x=20 mm/s",
    ];
    let moved = ran(STIFF, &[&sets[..], &own[..]].concat());
    let apart = |column: &str| last(&moved, column) - last(&steady, column);
    for place in ["a", "b"] {
        assert!((apart(&format!("{place}.rotor.x")) - 0.12e-3).abs() < 1e-9);
        assert!((apart(&format!("{place}.rotor.y")) + 0.05e-3).abs() < 1e-9);
    }
    // a rigid rotor of one plane takes them too
    let drop = include_str!("../../../scenarios/reference_drop.toml");
    let both = ["", "rotor.start_speed_y=10 mm/s"].map(|set| {
        let sets = ["run.duration=1 ms", set];
        last(
            &ran(drop, &sets[..1 + usize::from(!set.is_empty())]),
            "rotor.y",
        )
    });
    assert!((both[1] - both[0] - 10e-6).abs() < 1e-11, "{both:?}");
}

#[test]
fn starts_in_the_metal_are_refused_and_loads_beyond_the_end_are_told() {
    let built = |text: &str, sets: &[&str]| match &parsed(text, sets)?.system {
        System::Drop(drop) => build::drop(drop).map_err(|problem| problem.to_string()),
        _ => panic!("a drop"),
    };
    let drop = include_str!("../../../scenarios/reference_drop.toml");
    for text in [STIFF, drop, BLADE] {
        let found = built(text, &["rotor.start_x=0.3 mm"]).unwrap_err();
        assert!(
            found.contains("rotor.start_x") && found.contains("clearance"),
            "{found}"
        );
    }
    let poles = [
        "rotor.start_x=0.4 mm",
        "rotor.start_y=0.4 mm",
        "contact.radial_air_clearance=0.45 mm",
    ];
    assert!(built(BLADE, &poles).unwrap_err().contains("pole"));
    let sets = ["run.duration=2 ms"];
    let shock = format!("{STIFF}\n[base]\nshock_y = \"1 gn\"\nshock_duration = \"4 ms\"\n");
    let cut = |run: &Outcome| run.warnings.iter().any(|own| own.code == "AB2085");
    let run = ran(&shock, &sets);
    assert!(cut(&run) && !cut(&ran(&shock, &["run.duration=55 ms"])));
    // it has ended, what it does has not
    assert!(cut(&ran(&shock, &["run.duration=5 ms"])));
    // nothing is touched: what is left at the bearings is a result
    let left = number(&run, "node.right.least_distance");
    let moved = number(&run, "node.right.largest_displacement");
    assert!((left + moved - 0.2e-3).abs() < 1e-12, "{left} {moved}");
    let held = ran(BLADE, &["run.duration=5 ms"]);
    let left = number(&held, "node.auxiliary_drive_end.least_distance");
    assert!((0.15e-3..0.2e-3).contains(&left), "{left}");
}

/// The largest absolute acceleration of an oscillator, by small steps of its own.
fn peak(points: &[(f64, f64)], frequency: f64, damping: f64) -> f64 {
    let (mut z, mut v, mut largest) = (0.0, 0.0, 0.0_f64);
    let rate =
        |z: f64, v: f64, a: f64| -a - 2.0 * damping * frequency * v - frequency * frequency * z;
    for pair in points.windows(2) {
        let ((from, a), (to, b)) = (pair[0], pair[1]);
        let h = (to - from) / 8.0;
        for k in 0..8 {
            let at = |share: f64| a + (b - a) * (f64::from(k) + share) / 8.0;
            // fourth order of Runge and Kutta
            let [k1, l1] = [v, rate(z, v, at(0.0))];
            let [k2, l2] = [
                v + 0.5 * h * l1,
                rate(z + 0.5 * h * k1, v + 0.5 * h * l1, at(0.5)),
            ];
            let [k3, l3] = [
                v + 0.5 * h * l2,
                rate(z + 0.5 * h * k2, v + 0.5 * h * l2, at(0.5)),
            ];
            let [k4, l4] = [v + h * l3, rate(z + h * k3, v + h * l3, at(1.0))];
            z += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
            v += h / 6.0 * (l1 + 2.0 * (l2 + l3) + l4);
            let absolute = 2.0 * damping * frequency * v + frequency * frequency * z;
            largest = largest.max(absolute.abs());
        }
    }
    largest
}

#[test]
fn a_record_of_a_spectrum_has_that_spectrum_and_leaves_nothing_at_its_end() {
    let rows: [(f64, f64); 4] = [(2.0, 6.0), (6.0, 15.0), (15.0, 15.0), (40.0, 6.0)];
    let table: Vec<String> = (rows.iter())
        .map(|(hertz, size)| format!("[\"{hertz} Hz\", \"{size} m/s^2\"]"))
        .collect();
    let base = |seed: u32| {
        format!(
            "{STIFF}\n[base]\nspectrum = [{}]\nspectrum_y = 0.5\nspectrum_rise = \"1 s\"\nspectrum_hold = \"3 s\"\nspectrum_decay = \"2 s\"\nspectrum_seed = {seed}\n",
            table.join(", ")
        )
    };
    let records = [1, 2].map(|seed| record(&base(seed)).unwrap());
    for [x, y] in &records {
        for (points, share) in [(x, 1.0), (y, 0.5)] {
            for k in 0..=60 {
                let hertz = 2.0 * 20.0_f64.powf(f64::from(k) / 60.0);
                let next = rows
                    .iter()
                    .position(|row| row.0 >= hertz * (1.0 - 1e-12))
                    .unwrap()
                    .max(1);
                let (from, to) = (rows[next - 1], rows[next]);
                let asked =
                    from.1 * (to.1 / from.1).powf((hertz / from.0).ln() / (to.0 / from.0).ln());
                let found = peak(points, TAU * hertz, 0.05);
                let apart = found / (share * asked) - 1.0;
                // 10 % at the frequencies that were looked at; these lie between them
                assert!(
                    apart.abs() < 0.11,
                    "{hertz} Hz: {found} for {}",
                    share * asked
                );
            }
            let (mut velocity, mut way) = (0.0, 0.0);
            for pair in points.windows(2) {
                let h = pair[1].0 - pair[0].0;
                way += velocity * h + h * h * (2.0 * pair[0].1 + pair[1].1) / 6.0;
                velocity += 0.5 * h * (pair[0].1 + pair[1].1);
            }
            assert!(
                velocity.abs() < 1e-9 && way.abs() < 1e-9,
                "{velocity} {way}"
            );
        }
    }
    assert_ne!(
        records[0][0], records[1][0],
        "another seed is another record"
    );
    assert_eq!(
        records[0],
        record(&base(1)).unwrap(),
        "the same seed the same"
    );
}

#[test]
fn a_record_comes_from_a_file_with_its_units() {
    let folder = tempfile::tempdir().unwrap();
    let write = |text: &str| fs::write(folder.path().join("quake.csv"), text).unwrap();
    let read = |lines: &str| {
        let path = folder.path().join("machine.toml");
        let text = format!("{STIFF}\n[base]\nfile = \"quake.csv\"\n{lines}\n");
        fs::write(&path, text).unwrap();
        let scenario =
            Scenario::read(&path, &[], &BuiltIn).map_err(|problem| problem.to_string())?;
        let System::Drop(drop) = &scenario.system else {
            panic!("a machine");
        };
        let built = build::drop(drop).map_err(|problem| problem.to_string())?;
        Ok::<_, String>(built.constants.base.expect("a base"))
    };
    write("time (ms),east (g),up (m/s^2)\n0,0,0\n10,0.5,1\n20,0,0\n");
    let base =
        read("channel_x = \"east\"\nchannel_y = \"up\"\nstart = \"5 ms\"\nscale = 2.0").unwrap();
    let [x, y] = &base.record;
    let peak = |points: &[(f64, f64)]| points[1];
    assert!((peak(x.points()).0 - 0.015).abs() < 1e-15);
    assert!((peak(x.points()).1 - 9.80665).abs() < 1e-12);
    assert!((peak(y.points()).1 - 2.0).abs() < 1e-12);
    assert!(read("").unwrap_err().contains("channel_x"));
    let missing = read("channel_x = \"west\"").unwrap_err();
    assert!(
        missing.contains("west") && missing.contains("east"),
        "{missing}"
    );
    write("time (ms),east,up (N)\n0,0,0\n10,0.5,1\n20,0,0\n");
    assert!(read("channel_x = \"east\"").unwrap_err().contains("unit"));
    let other = read("channel_y = \"up\"").unwrap_err();
    assert!(
        other.contains("in N; a unit of the kind of m/s^2 is needed"),
        "{other}"
    );
    write("time (ms),east (g)\n0,0\n10,inf\n20,0\n");
    assert!(read("channel_x = \"east\"").is_err());
    write("time (ms),east (g)\n0,1\n");
    assert!(
        read("channel_x = \"east\"")
            .unwrap_err()
            .contains("two or more")
    );
    write("time (ms),east (g)\n-10,0\n0,1\n10,0\n");
    assert!(
        read("channel_x = \"east\"")
            .unwrap_err()
            .contains("base.start")
    );
    assert!(read("channel_x = \"east\"\nstart = \"10 ms\"").is_ok());
    fs::remove_file(folder.path().join("quake.csv")).unwrap();
    assert!(
        read("channel_x = \"east\"")
            .unwrap_err()
            .contains("quake.csv")
    );
}

#[test]
fn motions_of_the_base_that_cannot_be_are_refused_where_they_stand() {
    let refused = |lines: &str, sets: &[&str]| {
        let text = format!("{STIFF}\n[base]\n{lines}\n");
        parsed(&text, sets)
            .err()
            .unwrap_or_else(|| record(&text).expect_err("no such record"))
    };
    assert!(refused("shock_x = \"30 m/s^2\"", &[]).contains("shock_duration"));
    assert!(refused("shock_x = \"30\"", &[]).contains("unit"));
    assert!(
        refused(
            "record_x = [[\"0 s\", \"0 m/s\"], [\"1 s\", \"1 m/s\"]]",
            &[]
        )
        .contains("m/s^2")
    );
    let jump = refused(
        "record_x = [[\"0 s\", \"0 m/s^2\"], [\"0 s\", \"1 m/s^2\"]]",
        &[],
    );
    assert!(jump.contains("not above"), "{jump}");
    assert!(refused("spectrum = [[\"1 Hz\", \"1 m/s^2\"]]", &[]).contains("two rows"));
    let short = "spectrum = [[\"0.1 Hz\", \"1 m/s^2\"], [\"5 Hz\", \"1 m/s^2\"]]";
    assert!(
        refused(short, &[]).contains("40 s"),
        "{}",
        refused(short, &[])
    );
    for (lines, word) in [
        ("channel_x = \"a\"", "base.file"),
        ("scale = 2.0", "spectrum"),
        ("spectrum_seed = 2", "base.spectrum"),
        ("shock_start = \"1 ms\"", "base.shock_x"),
        (
            "shock_x = \"1 m/s^2\"\nshock_duration = \"1 ms\"\nscale = 2.0",
            "no effect",
        ),
        (
            "spectrum = [[\"1 Hz\", \"1 m/s^2\"], [\"0 Hz\", \"1 m/s^2\"]]",
            "row",
        ),
        (
            "spectrum = [[\"1 Hz\", \"1 m/s^2\"], [\"9000 Hz\", \"1 m/s^2\"]]",
            "fewer are needed",
        ),
    ] {
        let found = refused(lines, &[]);
        assert!(found.contains(word), "{found}");
    }
    let until = refused(
        "shock_x = \"30 m/s^2\"\nshock_duration = \"1 ms\"",
        &["run.until=standstill"],
    );
    assert!(until.contains("standstill"), "{until}");
}

/// A blade lost at 20 ms: nothing jumps, its orbit grows as an unbalance of 610 g mm makes it, and the energy closes.
#[test]
fn a_lost_blade_is_an_unbalance_from_then_on() {
    let lost = ran(BLADE, &["run.duration=45 ms", "run.tolerance=1e-6"]);
    let before = ran(BLADE, &["run.duration=19 ms", "run.tolerance=1e-6"]);
    assert!(number(&lost, "energy_residual").abs() < 1e-6);
    assert!((number(&lost, "event.blade_lost.time") - 0.02).abs() < 1e-12);
    let places = |run: &Outcome| run.column("drive_end.rotor.y").unwrap().values.clone();
    let (early, all) = (places(&before), places(&lost));
    let time = &lost.column("time").unwrap().values;
    assert_eq!(early[50].to_bits(), all[50].to_bits());
    let step = (time.windows(2).zip(all.windows(2)))
        .map(|(t, y)| ((y[1] - y[0]) / (t[1] - t[0])).abs())
        .fold(0.0, f64::max);
    // nothing is quicker than the largest orbit at 628 rad/s
    assert!(step < 1.2 * 628.0 * 0.25e-3, "{step}");
    let late = all.iter().zip(time).filter(|(_, t)| **t > 0.03);
    let largest = late.fold(0.0_f64, |most, (y, _)| most.max(y.abs()));
    assert!(largest > 0.05e-3, "{largest}");
    let huge = BLADE.replace("600 g mm", "600 g m");
    let System::Drop(drop) = &parsed(&huge, &[]).unwrap().system else {
        panic!("a machine");
    };
    let found = build::drop(drop).unwrap_err().to_string();
    assert!(found.contains("smaller amounts"), "{found}");
    let refused = |from: &str, to: &str| parsed(&BLADE.replace(from, to), &[]).unwrap_err();
    assert!(refused("plane = \"wheel\"", "plane = \"whel\"").contains("wheel"));
    assert!(refused("at = \"20 ms\"", "at = \"0 s\"").contains("[[rotor.unbalance]]"));
    assert!(refused("amount = \"600 g mm\"\n", "").contains("amount is needed"));
}
