//! Levitations that do not hold their rotor are refused.

use crate::problem::{Code, Problem};
use crate::scenario::{LevitationModel, UNNAMED};
use levitation::response::Equilibrium;
use levitation::{Pole, Verdict, verdict};

/// Static stiffness below this share of k_s is none.
const NO_STIFFNESS: f64 = 1e-6;

/// Refuses a loop that does not hold its rotor.
pub(crate) fn holds(
    model: &LevitationModel,
    poles: &[Pole],
    speed: f64,
) -> Result<(), Box<Problem>> {
    let at = format!("at {speed:.1} rad/s");
    let problem = match verdict(poles) {
        Verdict::Stable => return Ok(()),
        Verdict::Unstable(value) => {
            let found = format!(
                "an unstable loop {at}: eigenvalue {:.6} {:+.6}j 1/s",
                value.re, value.im
            );
            let allowed =
                "eigenvalues with negative real parts are needed: gains, filters and delay decide";
            Problem::new(Code::UnstableLevitation, UNNAMED, found, allowed)
        }
        Verdict::ZeroStiffness(count) => {
            let soft = model.levitation.static_stiffness();
            let soft = soft.iter().zip(model.levitation.actuators());
            let soft = soft.filter(|(k, a)| k.abs() < NO_STIFFNESS * a.magnet.position_stiffness());
            let names: Vec<&str> = soft.map(|(_, a)| a.axis.name.as_str()).collect();
            let found = format!("zero static stiffness {at}: {count} eigenvalues below 1e-4 1/s");
            let allowed = match names.is_empty() {
                true => "a loop that holds the rotor at rest is needed".to_string(),
                false => format!(
                    "more proportional gain than position_stiffness/current_stiffness, or an integral gain, is needed: without one they are equal on {}",
                    names.join(", ")
                ),
            };
            Problem::new(Code::ZeroStaticStiffness, UNNAMED, found, allowed)
        }
    };
    Err(Box::new(problem.on_key("levitation.controller")))
}

/// Refuses coils that cannot carry the weight.
pub(crate) fn strong(model: &LevitationModel, rest: &Equilibrium) -> Result<(), Box<Problem>> {
    for (index, actuator) in model.levitation.actuators().iter().enumerate() {
        let limit = actuator.largest_current;
        if rest.currents[index].abs() <= limit {
            continue;
        }
        let name = &actuator.axis.name;
        return Err(weak(&format!(
            "{:.4} A of control current on axis {name} to hold the weight, {limit:.4} A there",
            rest.currents[index].abs()
        )));
    }
    Ok(())
}

/// Coils that cannot hold what they should.
pub(crate) fn weak(found: &str) -> Box<Problem> {
    let allowed = "coils whose largest current, less the bias, holds the weight are needed";
    let problem = Problem::new(Code::CurrentLimit, UNNAMED, found, allowed);
    Box::new(problem.on_key("levitation.magnet.largest_current"))
}

/// A levitation that cannot be computed.
pub(crate) fn failed(text: &str) -> Box<Problem> {
    let needed = "another levitation is needed";
    let problem = Problem::new(Code::Impossible, UNNAMED, text, needed);
    Box::new(problem.on_key("levitation"))
}
