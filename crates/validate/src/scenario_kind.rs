//! A case of any scenario: what a published test found beside what this program predicts of it.
//!
//! `inputs.scenario` is the scenario itself. Its quantities are the results that are numbers; `name.2` is the second value of a list, and
//! `broken.LIMIT` the share of the members that break the limit of a result or warning, such as `broken.warning.AB1014`.

use super::inputs::{Computed, Inputs};
use super::simulator::Simulator;
use auxbear::outcome::{Scope, Value, Verdict};
use auxbear::run::Options;
use auxbear::scenario::{BuiltIn, Scenario};
use std::sync::atomic::AtomicBool;
use units::{Dimension, parse_quantity};

pub(super) fn scenario(
    inputs: &mut Inputs,
    simulator: &dyn Simulator,
) -> Result<Vec<Computed>, String> {
    let text = inputs.text("scenario")?;
    if let Err(why) = simulator.machines() {
        return Ok(vec![Computed {
            quantity: String::new(),
            dimension: Dimension::NONE,
            value: Err(why),
        }]);
    }
    let told = |problem: Box<auxbear::problem::Problem>| problem.to_string();
    let scenario = Scenario::parse(&text, "inputs.scenario", &[], &BuiltIn).map_err(told)?;
    let never = AtomicBool::new(false);
    let outcome = auxbear::run::run(&scenario, &Options::unwatched(&never)).map_err(told)?;
    if !outcome.stop.complete() {
        return Err(outcome.stop.text);
    }
    let computed = |quantity: String, unit: &str, value: f64| Computed {
        quantity,
        dimension: match unit {
            "" | "1" => Dimension::NONE,
            unit => {
                parse_quantity(&format!("1 {unit}")).map_or(Dimension::NONE, |one| one.dimension)
            }
        },
        value: Ok(value),
    };
    let mut all = Vec::new();
    for own in &outcome.quantities {
        match &own.value {
            Value::Number(value) => all.push(computed(own.name.clone(), own.unit, *value)),
            Value::List(values) => {
                all.extend(values.iter().enumerate().map(|(k, value)| {
                    computed(format!("{}.{}", own.name, k + 1), own.unit, *value)
                }))
            }
            _ => {}
        }
    }
    all.extend(outcome.limits.iter().map(|judged| {
        // members that end too soon to hold it do not break it
        let limit = &judged.limit;
        let breaks = |value: &&f64| !limit.side.holds(**value, limit.bound);
        let count = match &limit.forbids {
            _ if judged.members <= 1 => usize::from(judged.verdict == Verdict::Fail),
            Some(forbids) => {
                let came = outcome.warnings.iter();
                let came = came.filter(|own| forbids.meets(own.code, own.severity));
                let counts = came.map(|own| match own.scope {
                    Scope::Each { count, .. } => count,
                    Scope::Alike | Scope::Unperturbed => judged.members,
                });
                counts.max().unwrap_or(0)
            }
            None => {
                let values = outcome.members.decisive(&limit.quantity, limit.bound);
                values.iter().flatten().filter(breaks).count()
            }
        };
        let broken = count as f64 / judged.members.max(1) as f64;
        computed(format!("broken.{}", judged.limit.quantity), "", broken)
    }));
    Ok(all)
}
