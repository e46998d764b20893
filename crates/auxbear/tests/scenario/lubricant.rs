//! Traction from an oil, as a scenario gives it.

use super::files::{DROP, read};
use auxbear::scenario::{Scenario, System, Traction};

const OIL: &str = r#"
[bearing.traction]
law = "lubricant"
oil = "FVA 3"
oil_temperature = "60 degC"
"#;

fn parse(sets: &[&str]) -> Result<Scenario, String> {
    read(&format!("{DROP}{OIL}"), sets)
}

#[test]
fn an_oil_is_read_with_what_is_assumed_of_it() {
    let scenario = parse(&[]).expect("complete");
    let System::Drop(drop) = &scenario.system else {
        panic!("a drop");
    };
    let Traction::Lubricant(film) = drop.auxiliary_bearings[0]
        .bearing
        .as_ref()
        .unwrap()
        .traction
    else {
        panic!(
            "{:?}",
            drop.auxiliary_bearings[0]
                .bearing
                .as_ref()
                .unwrap()
                .traction
        );
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
fn what_an_oil_needs_is_reported() {
    for (set, shown) in [
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
        assert!(message.contains(shown), "{set}: {message}");
    }
    let given = [
        "bearing.traction.oil=PAO100",
        "bearing.traction.oil_conductivity=0.14 W/(m K)",
    ];
    assert!(parse(&given).is_ok());
}
