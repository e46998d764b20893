//! A machine in a casing that moves.

use crate::machine::{parsed, ran};
use crate::outcomes::number;
use auxbear::outcome::Value;

const CASING: &str = include_str!("../../../scenarios/machine_casing.toml");

/// Size of the casing's displacement over time.
fn sizes(run: &auxbear::outcome::Outcome) -> Vec<(f64, f64)> {
    let of = |axis: &str| {
        &run.column(&format!("housing.casing.{axis}"))
            .unwrap()
            .values
    };
    let times = &run.column("time").unwrap().values;
    let both = of("x").iter().zip(of("y")).map(|(x, y)| x.hypot(*y));
    times.iter().copied().zip(both).collect()
}

/// The start is the steady motion of rotor, casing, sensors and controllers together: what runs has it too. Only the races start at rest, of 1 kg
/// against the 60 kg of the casing.
#[test]
fn until_the_release_everything_goes_on_as_it_started() {
    let sets = [
        "event.all_lost.at=1 s",
        "run.duration=0.2 s",
        "rotor.unbalance.wheel.amount=100 g mm",
    ];
    let run = ran(CASING, &sets);
    let all = sizes(&run);
    let largest = |from: f64, to: f64| {
        let part = all.iter().filter(|(time, _)| (from..to).contains(time));
        part.fold(0.0, |most: f64, (_, size)| most.max(*size))
    };
    let (first, last) = (largest(0.0, 0.02), largest(0.18, 0.2));
    assert!(last > 5e-7, "{last}");
    assert!((first / last - 1.0).abs() < 0.08, "{first} {last}");
}

/// A casing that is heavy and stands stiffly is the ground. On bushings: where balls stand at the contact is chance.
#[test]
fn a_casing_that_does_not_yield_is_the_ground() {
    let (bearing, rest) = CASING.split_once("[bearing]\n").unwrap();
    let (_, rest) = rest.split_once("[[auxiliary_bearing]]").unwrap();
    let bushings = format!("{bearing}[bearing]\ntype = \"bushing\"\n\n[[auxiliary_bearing]]{rest}");
    let stiff = [
        "rotor.housing.casing.mass=1e5 kg",
        "rotor.housing.casing.stiffness=1e12 N/m",
        "run.duration=65 ms",
        "run.tolerance=1e-7",
    ];
    let casing = ran(&bushings, &stiff);
    let start = bushings.find("[[rotor.housing]]").unwrap();
    let end = start + bushings[start..].find("[[event]]").unwrap();
    let ground = format!("{}{}", &bushings[..start], &bushings[end..]);
    let ground = ran(&ground.replace("on = \"casing\"\n", ""), &stiff[2..]);
    for name in [
        "drive_end.time_to_first_contact",
        "other_end.first_impact_force",
        "drive_end.max_rotor_displacement",
    ] {
        let (seen, wanted) = (number(&casing, name), number(&ground, name));
        assert!(
            (seen / wanted - 1.0).abs() < 1e-4,
            "{name}: {seen} {wanted}"
        );
    }
    assert!(number(&casing, "housing.casing.largest_displacement") < 1e-8);
}

/// The weight that the casing no longer carries is a step of force: without damping it swings about the place that this leads to, m g/k above its own,
/// as long as the rotor falls freely.
#[test]
fn it_springs_up_by_the_weight_that_leaves_it() {
    let sets = [
        "event.all_lost.at=0 s",
        "levitation.decay_time=0 s",
        "rotor.unbalance.wheel.amount=0 g mm",
        "rotor.housing.casing.damping=0 N s/m",
        "run.duration=6 ms",
        "run.tolerance=1e-8",
    ];
    let run = ran(CASING, &sets);
    let (k, m) = (2e7_f64, 60.0_f64);
    let weight = number(&run, "rotor_mass") * 9.80665;
    let up = run.column("housing.casing.y").unwrap();
    let t = 6e-3;
    let wanted = weight / k * (1.0 - ((k / m).sqrt() * t).cos());
    let seen = *up.values.last().unwrap();
    // races and balls move too, 1 kg of 61
    assert!((seen / wanted - 1.0).abs() < 0.02, "{seen} {wanted}");
}

#[test]
fn what_stands_on_no_housing_is_refused() {
    let refused = |text: &str| parsed(text, &[]).map(|_| ()).unwrap_err();
    let bearing = CASING.replace("[mount]\non = \"casing\"", "[mount]\non = \"cassing\"");
    let told = refused(&bearing);
    assert!(
        told.contains("mount.on") && told.contains("Did you mean \"casing\"?"),
        "{told}"
    );
    let magnet = CASING.replacen(
        "on = \"casing\"\ncurrent_stiffness",
        "on = \"casin\"\ncurrent_stiffness",
        1,
    );
    let told = refused(&magnet);
    assert!(
        told.contains("levitation.magnet") && told.contains("casin"),
        "{told}"
    );
    let both = CASING.replace(
        "[mount]\n",
        "[mount]\nhousing_mass = \"20 kg\"\nhousing_stiffness = \"1e8 N/m\"\n",
    );
    let told = refused(&both);
    assert!(
        told.contains("mount.on") && told.contains("mount.housing_mass"),
        "{told}"
    );
    let supported = "\n[[rotor.support]]\nat = \"100 mm\"\non = \"casing\"\nstiffness = \"1e6 N/m\"\nafter_release = \"stays\"\n";
    assert!(parsed(&format!("{CASING}{supported}"), &[]).is_ok());
    let alone = CASING.replace("on = \"casing\"\n", "");
    let told = refused(&alone);
    assert!(
        told.contains("rotor.housing.casing") && told.contains("nothing stands on"),
        "{told}"
    );
    let loose = CASING.replace(
        "stiffness = { value = \"2e7 N/m\", assumed = \"a mode",
        "stiffness_xx = { value = \"0 N/m\", assumed = \"a mode",
    );
    let told = refused(&loose);
    assert!(told.contains("rotor.housing.casing.stiffness"), "{told}");
    let named = CASING.replace("\"casing\"", "\"drive_end\"");
    let told = refused(&named);
    assert!(told.contains("the name of an auxiliary bearing"), "{told}");
}

/// What stands around the shaft is judged against the housing that carries it: a casing that is shaken alone takes its seal with it.
#[test]
fn distances_on_a_casing_are_against_it() {
    let sets = [
        "run.case=shock",
        "rotor.housing.casing.stiffness=5e5 N/m",
        "rotor.housing.casing.damping=3000 N s/m",
        "run.duration=0.12 s",
    ];
    let run = ran(CASING, &sets);
    // the drawing frames what stands on it: bearings, then magnets
    let of = |name: &str| run.quantity(name).map(|own| own.value.clone());
    let places = Value::List(vec![0.06, 0.54, 0.12, 0.48]);
    assert_eq!(of("housed_positions"), Some(places));
    assert_eq!(of("housed_on"), Some(Value::Text(["casing"; 4].join("\n"))));
    assert!(run.stop.complete(), "{}", run.stop.text);
    assert!(number(&run, "housing.casing.largest_displacement") > 8e-4);
    // 400 um of clearance, 200 um of it in the bearings
    let left = number(&run, "node.seal.least_distance");
    assert!((0.5e-4..2e-4).contains(&left), "{left}");
    assert!(number(&run, "drive_end.max_mount_displacement") < 1e-4);
}

/// Bearings on a casing and a seal on the ground: what the casing yields under the rotor's weight, W/k, is lost at the seal; with both on the casing
/// nothing is.
#[test]
fn a_rotor_that_rolls_sinks_with_its_casing() {
    let bearings = CASING
        .replace("on = \"casing\"\ncurrent", "current")
        .replace(
            "clearance = \"0.4 mm\"\non = \"casing\"",
            "clearance = \"0.4 mm\"",
        );
    let left = |text: &str, stiffness: &str| {
        let sets = [
            stiffness,
            "rotor.housing.casing.damping=3000 N s/m",
            "rotor.unbalance.wheel.amount=0.001 g mm",
            // few speeds, and no dry whirl, which would take longer than all else
            "analysis.speed_count=41",
            "analysis.whirl_to=1 rad/s",
        ];
        let machine = parsed(text, &sets).unwrap();
        let rotor = machine.rotor_alone().expect("a machine").unwrap();
        let run = auxbear::run::run(
            &rotor,
            &auxbear::run::Options::unwatched(&std::sync::atomic::AtomicBool::new(false)),
        );
        number(
            &run.unwrap(),
            "on_auxiliary_bearings.node.seal.least_distance",
        )
    };
    let (soft, hard) = (
        "rotor.housing.casing.stiffness=1e6 N/m",
        "rotor.housing.casing.stiffness=1e9 N/m",
    );
    let weight = 6.3005 * 9.80665;
    let lost = left(&bearings, hard) - left(&bearings, soft);
    let wanted = weight * (1e-6 - 1e-9);
    assert!((lost / wanted - 1.0).abs() < 1e-3, "{lost} {wanted}");
    let both = left(CASING, hard) - left(CASING, soft);
    assert!(both.abs() < 1e-8, "{both}");
}
