//! Traction from an oil, as a scenario gives it.

use auxbear::scenario::{NoBearings, Scenario, System, Traction};

const OIL: &str = r#"format = "auxbear.scenario/1"
system = "drop"
[rotor]
mass = "8 kg"
polar_inertia = "0.01 kg m^2"
unbalance_eccentricity = "5 um"
speed = "12000 rpm"
[levitation]
stiffness = "1e6 N/m"
damping = "1000 N s/m"
[contact]
radial_air_clearance = "0.25 mm"
bore_diameter = "25 mm"
[mount]
stiffness = "2e7 N/m"
damping = "5000 N s/m"
moving_mass = "0.15 kg"
[bearing]
ball_count = 10
ball_diameter = "6.35 mm"
pitch_diameter = "36 mm"
inner_race_mass = "20.4 g"
inner_race_inertia = "3.9e-6 kg m^2"
cage_mass = "5 g"
[bearing.traction]
law = "lubricant"
oil = "FVA 3"
oil_temperature = "60 degC"
"#;

fn parse(sets: &[&str]) -> Result<Scenario, String> {
    let sets: Vec<String> = sets.iter().map(|set| set.to_string()).collect();
    Scenario::parse(OIL, "oil.toml", &sets, &NoBearings).map_err(|problem| problem.to_string())
}

#[test]
fn an_oil_is_read_with_what_is_assumed_of_it() {
    let scenario = parse(&[]).expect("complete");
    let System::Drop(drop) = &scenario.system else {
        panic!("a drop");
    };
    let Traction::Lubricant(film) = drop.bearing.traction else {
        panic!("{:?}", drop.bearing.traction);
    };
    assert_eq!(film.oil, physics::lubricant::FVA_3);
    assert!((film.temperature - 333.15).abs() < 1e-9);
    assert_eq!((film.supply, film.conductivity), (1.0, None));
    let assumed = |path: &str| {
        let values = scenario.resolved.values.iter();
        values
            .filter(|value| value.path == path)
            .any(|value| value.provenance.mark() == "assumed")
    };
    for key in [
        "composite_roughness",
        "boundary_friction_coefficient",
        "supply",
    ] {
        assert!(assumed(&format!("bearing.traction.{key}")), "{key}");
    }
}

#[test]
fn what_an_oil_needs_is_told() {
    for (set, told) in [
        (
            "bearing.traction.oil_temperature=120 degC",
            "from 25.0 to 100.0",
        ),
        ("bearing.traction.oil=PAO100", "oil_conductivity"),
        ("bearing.traction.oil=honey", "PAO100"),
        ("bearing.traction.supply=0", "from 0.001 to 1"),
        ("bearing.traction.composite_roughness=0 um", "above 0"),
        ("bearing.traction.maximum=0.05", "tanh"),
    ] {
        let message = parse(&[set]).expect_err(set);
        assert!(message.contains(told), "{set}: {message}");
    }
    let given = [
        "bearing.traction.oil=PAO100",
        "bearing.traction.oil_conductivity=0.14 W/(m K)",
    ];
    assert!(parse(&given).is_ok());
}
