//! The resolved file: every value with its origin, and the same numbers bit for bit when it is read again.

use super::files::{must_read, owned as sets};
use auxbear::scenario::{
    BallMaterial, BearingRecord, BearingSource, Body, BuiltIn, Cage, Drop, Fidelity, Moment,
    NoBearings, Provenance, RigidBody, Scenario, Separation, Spin, System, SystemName, Traction,
    keys, keys_of, parts_of, template,
};
use physics::palmgren_factors::FactorSource;
use proptest::prelude::*;

struct OneBearing;

impl BearingSource for OneBearing {
    fn find(&self, name: &str) -> Option<BearingRecord> {
        let origin = |mark: &str| Provenance::Catalogue {
            bearing: "6005".to_string(),
            mark: mark.to_string(),
            source: "a \"catalogue\", p. 3".to_string(),
        };
        let value =
            |key: &str, value_si: f64, mark: &str| (key.to_string(), value_si, origin(mark));
        let material = match name {
            "6005" => "steel",
            _ => "silicon nitride",
        };
        self.names()
            .contains(&name.to_string())
            .then(|| BearingRecord {
                name: name.to_string(),
                words: vec![(
                    "ball_material".to_string(),
                    material.to_string(),
                    origin("read"),
                )],
                values: vec![
                    value("bore_diameter", 0.025, "read"),
                    value("ball_count", 10.0, "derived"),
                    value("ball_diameter", 0.00635, "read"),
                    value("pitch_diameter", 0.036, "read"),
                    value("static_load_rating", 6550.0, "read"),
                    value("inner_race_mass", 0.0204, "assumed"),
                    value("inner_race_inertia", 3.9e-6, "assumed"),
                    value("cage_mass", 0.005, "assumed"),
                    value("inner_groove_curvature", 0.515, "assumed"),
                ],
            })
    }

    fn names(&self) -> Vec<String> {
        vec!["6005".to_string(), "6005 hybrid".to_string()]
    }
}

const SHORT: &str = r#"
format = "auxbear.scenario/1"
system = "drop"
title = "A \"short\" file"

[rotor]
mass = { value = "8 kg", assumed = "not\nweighed" }
polar_inertia = { value = "0.01 kg m²", source = "drawing 4711" }
unbalance = "40 g mm"
speed = "-12000 rpm"

[levitation]
stiffness = "1e6 N/m"
damping = "1000 N s/m"

[contact]
radial_air_clearance = "0.25 mm"

[mount]
stiffness = "2e7 N/m"
damping = "5000 N s/m"
moving_mass = "150 g"

[bearing]
name = "6005"
cage_mass = "6 g"
"#;

fn read(text: &str, sets: &[String]) -> Scenario {
    must_read(&OneBearing, text, sets)
}

/// Every number by path, as bits, derived ones included.
fn bits(scenario: &Scenario) -> Vec<(&'static str, Option<u64>, Option<String>)> {
    let values = scenario.resolved.values.iter();
    values
        .map(|value| {
            let text = value.value_si.is_none().then(|| value.text.clone());
            (value.path, value.value_si.map(f64::to_bits), text.flatten())
        })
        .collect()
}

fn assert_reads_back(scenario: &Scenario) -> Scenario {
    let again = read(&scenario.resolved.toml(), &[]);
    assert_eq!(bits(&again), bits(scenario));
    assert_eq!(again.system, scenario.system);
    assert_eq!(again.title, scenario.title);
    again
}

/// The cage of a drop's bearing.
fn body(drop: &Drop) -> &RigidBody {
    match &drop.body {
        Body::Rigid(body) => body,
        Body::Flexible(_) => panic!("a rigid rotor"),
    }
}

fn cage(drop: &Drop) -> &Cage {
    match &drop.auxiliary_bearings[0]
        .bearing
        .as_ref()
        .unwrap()
        .separation
    {
        Separation::Cage(cage) => cage,
        Separation::FullComplement(_) => panic!("there is a cage"),
    }
}

#[test]
fn a_short_file_is_filled_and_reads_back_bit_for_bit() {
    let scenario = read(SHORT, &[]);
    let System::Drop(drop) = &scenario.system else {
        panic!("a drop was read");
    };
    assert_eq!(drop.rotor.speed, -400.0 * std::f64::consts::PI);
    // 40 g mm on 8 kg is 5 µm; one rounding of the division.
    assert!((body(drop).unbalance_eccentricity - 5e-6).abs() < 1e-20);
    assert_eq!(cage(drop).mass, 0.006);
    assert_eq!(
        drop.auxiliary_bearings[0]
            .bearing
            .as_ref()
            .unwrap()
            .ball_count,
        10
    );
    assert_eq!(
        drop.auxiliary_bearings[0]
            .bearing
            .as_ref()
            .unwrap()
            .inner_groove_curvature,
        0.515
    );
    assert_eq!(
        drop.auxiliary_bearings[0]
            .bearing
            .as_ref()
            .unwrap()
            .outer_groove_curvature,
        0.53
    );
    assert_eq!(drop.auxiliary_bearings[0].contact.bore_diameter, 0.025);
    assert_eq!(drop.auxiliary_bearings[0].contact.exponent, 10.0 / 9.0);
    assert_eq!(drop.gravity.direction, -std::f64::consts::FRAC_PI_2);
    // 6 g on a radius of 18 mm: 1.944e-6 kg m², two roundings.
    assert!((cage(drop).inertia / 1.944e-6 - 1.0).abs() < 1e-15);
    assert_eq!(
        drop.auxiliary_bearings[0]
            .bearing
            .as_ref()
            .unwrap()
            .hertz_pressure_limit,
        4.2e9
    );
    // π/6 (6.35 mm)³ of 7850 kg/m³
    assert!(
        (drop.auxiliary_bearings[0]
            .bearing
            .as_ref()
            .unwrap()
            .ball_mass
            .unwrap()
            / 1.0524e-3
            - 1.0)
            .abs()
            < 0.01
    );
    assert_eq!(drop.rotor.spin, Spin::Free);
    assert_eq!(
        drop.auxiliary_bearings[0].bearing.as_ref().unwrap().moment,
        Moment::None
    );

    let again = assert_reads_back(&scenario);
    assert_eq!(
        assert_reads_back(&again).resolved.toml(),
        again.resolved.toml()
    );
}

#[test]
fn every_value_states_its_origin() {
    let scenario = read(SHORT, &sets(&["rotor.planes=2"]));
    let provenance = |path: &str| scenario.resolved.get(path).unwrap().provenance.clone();
    assert_eq!(
        provenance("rotor.mass"),
        Provenance::Assumed("not\nweighed".to_string())
    );
    assert_eq!(
        provenance("rotor.polar_inertia"),
        Provenance::GivenWithSource("drawing 4711".to_string())
    );
    assert_eq!(provenance("rotor.speed"), Provenance::Given);
    assert_eq!(provenance("bearing.cage_mass"), Provenance::Given);
    assert_eq!(provenance("bearing.ball_diameter").mark(), "catalogue");
    assert_eq!(provenance("bearing.ball_material").mark(), "catalogue");
    assert_eq!(provenance("bearing.inner_race_mass").mark(), "assumed");
    assert_eq!(provenance("contact.friction_coefficient").mark(), "assumed");
    assert_eq!(provenance("gravity.acceleration").mark(), "default");
    assert_eq!(provenance("rotor.unbalance_eccentricity").mark(), "derived");
    assert_eq!(provenance("bearing.cage_inertia").mark(), "derived");
    assert_eq!(provenance("bearing.ball_mass").mark(), "derived");
    assert_eq!(
        scenario.resolved.get("rotor.mass").unwrap().place.line(),
        Some(7)
    );
    assert_eq!(
        scenario.resolved.get("rotor.planes").unwrap().place.line(),
        None
    );

    let text = scenario.resolved.toml();
    for line in [
        "mass = { value = \"8 kg\", assumed = \"not\\nweighed\" }",
        "speed = \"-12000 rpm\"",
        "planes = 2",
        "# unbalance_eccentricity = \"5e-6 m\" # derived: unbalance / mass",
        "acceleration = { value = \"9.81 m/s^2\", from = \"default\" } # usual rounded value near sea level",
        "damping = { value = \"0.5 s/m\", assumed = \"not measured; small impact loss of hard steel\", from = \"default\" }",
        "ball_diameter = { value = \"0.00635 m\", source = \"a \\\"catalogue\\\", p. 3\", from = \"catalogue\" } # 6005, read",
        "inner_race_mass = { value = \"0.0204 kg\", assumed = \"a \\\"catalogue\\\", p. 3\", from = \"catalogue\" } # 6005, assumed",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}\n{text}");
    }
    // Marks of assumptions and sources survive the second reading.
    let again = read(&text, &[]);
    let mark = |path: &str| again.resolved.get(path).unwrap().provenance.mark();
    assert_eq!(mark("contact.damping"), "assumed");
    assert_eq!(mark("bearing.inner_race_mass"), "assumed");
    assert_eq!(mark("bearing.cage_inertia"), "derived");
}

#[test]
fn derived_values_follow_what_they_come_from() {
    let resolved = read(SHORT, &[]).resolved.toml();
    let System::Drop(drop) = read(&resolved, &sets(&["bearing.cage_mass=12 g"])).system else {
        panic!("a drop was read");
    };
    assert!((cage(&drop).inertia / 3.888e-6 - 1.0).abs() < 1e-15);
}

#[test]
fn choices_become_typed_values() {
    let drop = |list: &[&str]| {
        let scenario = read(SHORT, &sets(list));
        assert_reads_back(&scenario);
        let System::Drop(drop) = scenario.system else {
            panic!("a drop was read");
        };
        drop
    };
    assert_eq!(
        drop(&["rotor.spin=braked", "rotor.brake_torque=2 N m"])
            .rotor
            .spin,
        Spin::Braked {
            torque: 2.0,
            start: 0.0
        }
    );
    assert_eq!(drop(&["rotor.spin=held"]).rotor.spin, Spin::Held);
    assert_eq!(
        drop(&[
            "bearing.traction.law=four parameter",
            "bearing.traction.a=-0.07",
            "bearing.traction.b=0.35 s/m",
            "bearing.traction.c=5 s/m",
            "bearing.traction.d=0.07",
        ])
        .auxiliary_bearings[0]
            .bearing
            .as_ref()
            .unwrap()
            .traction,
        Traction::FourParameter {
            a: -0.07,
            b: 0.35,
            c: 5.0,
            d: 0.07
        }
    );
    assert_eq!(
        drop(&[
            "bearing.traction.law=dry",
            "bearing.traction.kinetic=0.1",
            "bearing.traction.static=0.2",
            "bearing.traction.decay_speed=0.5 m/s",
        ])
        .auxiliary_bearings[0]
            .bearing
            .as_ref()
            .unwrap()
            .traction,
        Traction::Dry {
            kinetic_coefficient: 0.1,
            static_coefficient: 0.2,
            decay_speed: 0.5,
            reference_speed: 0.1
        }
    );
    let rolling = drop(&[
        "bearing.fidelity=rolling",
        "bearing.moment.law=palmgren printed",
        "bearing.moment.f0=2",
        "bearing.moment.viscosity=100 mm^2/s",
        "bearing.moment.f1_factor=9e-4",
        "bearing.moment.f1_exponent=0.55",
    ])
    .auxiliary_bearings[0]
        .bearing
        .clone()
        .unwrap();
    assert_eq!(rolling.fidelity, Fidelity::Rolling);
    assert_eq!(
        rolling.moment,
        Moment::Palmgren {
            printed: true,
            f0: 2.0,
            viscosity: 1e-4,
            f1_factor: 9e-4,
            f1_exponent: 0.55,
            preload: 0.0,
            axial_load: 0.0,
            contact_angle: None,
            equivalent_load: FactorSource::Timken,
        }
    );
    for hybrid in [
        "bearing.ball_material=silicon nitride",
        "bearing.name=6005 hybrid",
    ] {
        let hybrid = drop(&[hybrid]).auxiliary_bearings[0]
            .bearing
            .clone()
            .unwrap();
        assert_eq!(hybrid.ball_material, BallMaterial::SiliconNitride);
        // its steel races dent at the limit for steel, which is assumed
        assert_eq!(hybrid.hertz_pressure_limit, 4.2e9);
    }
    // A linear contact, a power with decimals, and the same power as a fraction.
    let linear = drop(&["contact.exponent=1", "contact.stiffness=2e7 N/m"]).auxiliary_bearings[0]
        .contact
        .clone();
    assert_eq!((linear.exponent, linear.stiffness), (1.0, 2e7));
    let decimals = drop(&[
        "contact.exponent=1.1111111111111112",
        "contact.stiffness=6e8 N/m^1.111111",
    ])
    .auxiliary_bearings[0]
        .contact
        .clone();
    assert_eq!((decimals.exponent, decimals.stiffness), (10.0 / 9.0, 6e8));
}

#[test]
fn the_last_override_counts_and_a_table_may_be_one() {
    let scenario = read(
        SHORT,
        &sets(&[
            "rotor.mass=9 kg",
            "rotor.mass={ value = \"10 kg\", source = \"scale\" }",
            "bearing.name=6005",
            "title=Two words",
        ]),
    );
    let System::Drop(drop) = &scenario.system else {
        panic!("a drop was read");
    };
    assert_eq!(body(drop).mass, 10.0);
    assert_eq!(scenario.title.as_deref(), Some("Two words"));
    assert_eq!(
        scenario.resolved.get("rotor.mass").unwrap().provenance,
        Provenance::GivenWithSource("scale".to_string())
    );
}

#[test]
fn the_starting_file_reads_without_a_problem() {
    for system in SystemName::ALL {
        let name = format!("{}.toml", system.word());
        let text = template(system.word()).unwrap();
        let scenario = Scenario::parse(&text, &name, &[], &BuiltIn)
            .unwrap_or_else(|problem| panic!("{problem}"));
        assert_eq!(scenario.system.name(), *system);
        let again = Scenario::parse(&scenario.resolved.toml(), &name, &[], &BuiltIn).unwrap();
        assert_eq!(bits(&again), bits(&scenario));
        assert_eq!(again.system, scenario.system);
        for key in keys() {
            let shown = text.contains(&format!("\n{} = ", key.name()))
                || text.contains(&format!("\n# {} = ", key.name()));
            let of_part =
                parts_of(*system).any(|(_, keys)| keys.iter().any(|k| k.name() == key.name()));
            let namesake = of_part || keys_of(*system).any(|other| other.name() == key.name());
            assert_eq!(shown, namesake, "{} in {name}", key.path);
        }
    }
    assert_eq!(template("mount"), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Random numbers in several units read back bit for bit from the resolved file.
    #[test]
    fn random_values_read_back_bit_for_bit(
        mass in 1e-3_f64..1e3,
        inertia in 1e-9_f64..1e2,
        rpm in -1e5_f64..1e5,
        degrees in -400.0_f64..400.0,
        milli in 1e-3_f64..5.0,
        exponent in 1.0_f64..2.0,
        stiffness in 1e3_f64..1e12,
        curvature in 0.5001_f64..0.9,
        seed in 0_i64..,
    ) {
        let list = [
            format!("rotor.mass={mass:?} kg"),
            format!("rotor.polar_inertia={inertia:?} kg m^2"),
            format!("rotor.speed={rpm:?} rpm"),
            format!("rotor.unbalance={} g mm", 1e-9 * mass),
            format!("gravity.direction={degrees:?} deg"),
            format!("contact.radial_air_clearance={milli:?} mm"),
            format!("contact.exponent={exponent:.5}"),
            format!("contact.stiffness={stiffness:?} N/m^{exponent:.5}"),
            format!("bearing.inner_groove_curvature={curvature:?}"),
            format!("repeat.seed={seed}"),
        ];
        let scenario = read(SHORT, &list);
        let System::Drop(drop) = &scenario.system else {
        panic!("a drop was read");
    };
        prop_assert_eq!(body(drop).mass.to_bits(), mass.to_bits());
        prop_assert_eq!(drop.repeat.seed, seed as u64);
        assert_reads_back(&scenario);
    }

    #[test]
    fn no_text_panics(text in "\\PC{0,60}") {
        let _ = Scenario::parse(&text, "x", &[], &NoBearings);
        let _ = Scenario::parse(SHORT, "x", &[text], &OneBearing);
    }

    #[test]
    fn no_override_panics(index in 0_usize..200, value in "[-+.0-9e\"{}a-z ,=\\[\\]/^]{0,16}") {
        let paths: Vec<&str> = keys().map(|key| key.path).collect();
        let set = format!("{}={value}", paths[index % paths.len()]);
        let _ = Scenario::parse(SHORT, "x", &[set], &OneBearing);
    }
}
