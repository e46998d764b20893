//! The unbalance of all planes by one balance quality grade.

use crate::values::Values;
use problem::{Code, Problem};
use rotor::{Rotor, properties};

const PATH: &str = "rotor.balance_grade";

/// Scales the unbalances of a rotor by one factor, so that all of them in one direction would be its grade: Σ|U| Ω/m = G of ISO 21940-11,
/// m/s. Directions and shares of the planes stay.
pub(super) fn scale(rotor: &mut Rotor, values: &Values) -> Result<(), Box<Problem>> {
    let Some(grade) = values.number(PATH) else {
        return Ok(());
    };
    let speed = values.number("rotor.speed").unwrap_or_default().abs();
    let given: f64 = rotor.unbalance.iter().map(|plane| plane.amount.abs()).sum();
    if given == 0.0 || speed == 0.0 {
        let (found, needed) = match given == 0.0 {
            true => (
                "no unbalance that it could scale",
                "[[rotor.unbalance]] with the planes and the shares of their amounts is needed",
            ),
            false => (
                "a rotor at rest",
                "rotor.speed is needed: a grade is the product of eccentricity and speed",
            ),
        };
        let place = values.place(PATH);
        let problem = values.problem(
            Code::Conflict,
            PATH,
            place,
            found.to_string(),
            needed.to_string(),
        );
        return Err(Box::new(problem));
    }
    let factor = grade * properties(rotor).mass / (speed * given);
    for plane in &mut rotor.unbalance {
        plane.amount *= factor;
    }
    Ok(())
}
