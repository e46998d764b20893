//! What tests ask of an outcome.

use auxbear::outcome::Outcome;

/// The number of a result, which must have one.
pub fn number(outcome: &Outcome, name: &str) -> f64 {
    let value = || outcome.quantity(name).map(|quantity| &quantity.value);
    (outcome.number(name)).unwrap_or_else(|| panic!("{name}: {:?}", value()))
}
