//! What twice `rotor.cutoff` would change, no bound of what all modes would: the beginning of a drop as it is, and once more with twice the cutoff.

use crate::options::Options;
use crate::result::outcome::{Quantity, Value};
use crate::scenario::{Scenario, Shaft, System};
use crate::simulate::drop::each;

/// What is compared: the impact that high modes feel most, and where the rotor goes.
const COMPARED: [&str; 2] = ["first_impact_force", "max_rotor_displacement"];

/// Relative changes of results by twice the cutoff, each named after what changes; nothing where the scenario does not ask.
pub(super) fn changes(
    scenario: &Scenario,
    shaft: &Shaft,
    known: &[Quantity],
    options: &Options,
) -> Vec<Quantity> {
    let Some(time) = shaft.cutoff_check else {
        return Vec::new();
    };
    let with = |cutoff: f64| {
        let set = |path: &str, value: f64, unit: &str| {
            let value = units::number_text(value);
            (path.to_string(), format!("\"{value} {unit}\""))
        };
        scenario.with(&[
            set("run.duration", time, "s"),
            set("rotor.cutoff", cutoff, "rad/s"),
            ("repeat.count".to_string(), "1".to_string()),
        ])
    };
    let quiet = Options {
        progress: &|_| {},
        ..*options
    };
    let scenarios = [with(shaft.cutoff), with(2.0 * shaft.cutoff)];
    let drops = scenarios.iter().map(|scenario| match scenario {
        Ok(scenario) => match &scenario.system {
            System::Drop(drop) => each::one(scenario, drop),
            _ => unreachable!("a cutoff makes no other system of a drop"),
        },
        Err(problem) => Err(problem.clone()),
    });
    let drops: Result<Vec<_>, _> = drops.collect();
    let (found, refused) = match drops {
        Ok(drops) => (each::run(&drops, &quiet), None),
        Err(problem) => (Vec::new(), Some(problem.to_string())),
    };
    let value = |k: usize, name: &str| {
        let single = found.get(k)?;
        let quantity = single.quantities.iter().find(|q| q.name == name)?;
        match quantity.value {
            Value::Number(value) if single.stop.complete() => Some(value),
            _ => None,
        }
    };
    let compared = known.iter().filter(|quantity| {
        let (_, last) = quantity
            .name
            .rsplit_once('.')
            .unwrap_or(("", &quantity.name));
        COMPARED.contains(&last)
    });
    let change = |quantity: &Quantity| {
        let name = quantity.name.as_str();
        let value = match (value(0, name), value(1, name)) {
            (Some(before), Some(after)) if before != 0.0 => Value::Number(after / before - 1.0),
            _ => {
                let whole = found.iter().find(|single| !single.stop.complete());
                let why = whole.map(|single| single.stop.text.clone());
                let why = refused.clone().or(why);
                Value::None {
                    why: why.unwrap_or_else(|| {
                        "one of the two runs has no such result; a longer rotor.cutoff_check may".to_string()
                    }),
                }
            }
        };
        Quantity {
            name: format!("cutoff_change.{name}"),
            value,
            unit: "",
            meaning: "change of a result with twice as many modes",
            law: "change on doubling: the result with twice rotor.cutoff over that with rotor.cutoff, less 1, both until rotor.cutoff_check",
            source: "crates/auxbear/src/run/cutoff.rs",
            valid: "not an error: all modes may change a result by more, and the other way, above all with a cutoff below the default; later contacts are chaotic",
            chaotic: false,
            spread: None,
            awaited: false,
        }
    };
    compared.map(change).collect()
}
