//! Scenarios that are read from another one with a few other values are those that are read whole.

use super::schema::shipped;
use auxbear::problem::Result;
use auxbear::scenario::{BuiltIn, Scenario};

/// Every shipped scenario with other values: an eighth of its numbers, by turns, two words, and two numbers that are refused.
fn changes(scenario: &Scenario, turn: usize) -> Vec<(String, String)> {
    let values = scenario.resolved.values.iter().enumerate();
    let numbers = values.filter(|(place, _)| place % 8 == turn % 8);
    let other = |value: f64, unit: &str| {
        let unit = if unit == "1" { "" } else { unit };
        format!("{:?} {unit}", 1.01 * value).trim().to_string()
    };
    let numbers = numbers.filter_map(|(_, own)| {
        let value = own.value_si.filter(|_| own.text.is_some())?;
        Some((own.shown(), other(value, &own.unit)))
    });
    let other = |path: &str, value: &str| (path.to_string(), value.to_string());
    let others = [
        other("run.accuracy", "screening"),
        other("bearing.traction.law", "coulomb"),
        // of two that are refused the same one is named
        other("contact.friction_coefficient", "-2"),
        other("rotor.mass", "-2 kg"),
    ];
    numbers.chain(others).collect()
}

fn as_text(read: &Result<Scenario>) -> String {
    match read {
        Ok(scenario) => format!("{scenario:?}"),
        Err(problem) => problem.to_string(),
    }
}

#[test]
fn a_variation_is_the_scenario_read_whole() {
    let (mut same, mut refused) = (0, 0);
    for (turn, path) in shipped().iter().enumerate() {
        let scenario = Scenario::read(path, &[], &BuiltIn).unwrap();
        let variations = scenario.variations();
        let changes = changes(&scenario, turn);
        let pairs = changes.windows(2).map(<[_]>::to_vec);
        for change in pairs.chain(changes.iter().map(|one| vec![one.clone()])) {
            let (quick, whole) = (variations.with(&change), scenario.with(&change));
            assert_eq!(
                as_text(&quick),
                as_text(&whole),
                "{change:?} in {}",
                path.display()
            );
            match whole {
                Ok(_) => same += 1,
                Err(_) => refused += 1,
            }
        }
    }
    assert!(same > 500 && refused > 50, "{same} {refused}");
}
