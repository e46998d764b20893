//! Whether a levitation holds its rotor, under its load and within its limits.

use crate::rotor::LevitationModel;
use levitation::response::{Equilibrium, Excess, Limit, equilibrium, excesses};
use levitation::{ClosedLoop, Plant, Pole, Refused, Verdict, verdict};
use nalgebra::DVector;
use outcome::Warning;
use physics::magnet::Magnet;
use problem::{Code, Problem};
use scenario::problem_at;

/// Static stiffness below this share of k_s is none.
const NO_STIFFNESS: f64 = 1e-6;

/// Share by which the static position raises k_s from which on a refusal names it.
const RAISED: f64 = 0.01;

/// The static equilibrium, from whose slopes a loop is judged; a loop that holds no rotor without load either is refused as such.
pub fn at_rest(
    model: &LevitationModel,
    plant: &Plant<f64>,
    loads: &DVector<f64>,
    speed: f64,
) -> Result<Equilibrium, Box<Problem>> {
    let levitation = &model.levitation;
    // coils at their limits answer no current: the equations are singular then
    let rest = equilibrium(plant, levitation, loads);
    let rest = rest.map_err(|_| weak(&Refused::NoEquilibrium.to_string()));
    let problem = match rest.and_then(|rest| strong(model, &rest).map(|()| rest)) {
        Ok(rest) => return Ok(rest),
        Err(problem) => problem,
    };
    let unloaded = ClosedLoop::new(plant.clone(), levitation).and_then(|closed| closed.poles());
    let poles = unloaded.map_err(|error| failed(&error.to_string()))?;
    holds(model, &poles, &levitation.slopes_at_centre(), speed)?;
    Err(problem)
}

/// Share by which k_s of an axis exceeds that of equal coils in the centre, by static current, displacement and biases.
pub fn rise(model: &LevitationModel, axis: usize, slopes: &[(f64, f64)]) -> f64 {
    let centre = match model.levitation.actuators()[axis].magnet {
        Magnet::Pair(pair) => Magnet::Pair(pair.with_bias_difference(0.0)),
        linear => linear,
    };
    slopes[axis].1 / centre.position_stiffness() - 1.0
}

/// Refuses a loop that does not hold its rotor; `slopes` are those of its magnets, k_i and k_s of each axis.
pub fn holds(
    model: &LevitationModel,
    poles: &[Pole],
    slopes: &[(f64, f64)],
    speed: f64,
) -> Result<(), Box<Problem>> {
    const KEY: &str = "levitation.controller";
    let at = format!("at {speed:.1} rad/s");
    let axes = model.levitation.actuators();
    let problem = match verdict(poles) {
        Verdict::Stable => return Ok(()),
        Verdict::Unstable(value) => {
            let rises = (0..axes.len()).map(|axis| (rise(model, axis, slopes), axis));
            let largest = rises.max_by(|a, b| a.0.total_cmp(&b.0));
            let loaded = match largest.filter(|(rise, _)| *rise > RAISED) {
                Some((rise, axis)) => format!(
                    " about the static position, where the load raises k_s of axis {} by {:.0} %",
                    axes[axis].axis.name,
                    100.0 * rise
                ),
                None => String::new(),
            };
            let found = format!(
                "an unstable loop {at}{loaded}: eigenvalue {:.6} {:+.6}j 1/s",
                value.re, value.im
            );
            let allowed =
                "eigenvalues with negative real parts are needed: gains, filters and delay decide";
            problem_at(Code::UnstableLevitation, KEY, found, allowed)
        }
        Verdict::ZeroStiffness(count) => {
            let soft = model.levitation.static_stiffness(slopes);
            let soft = soft.iter().zip(axes);
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
            problem_at(Code::ZeroStaticStiffness, KEY, found, allowed)
        }
    };
    Err(problem)
}

/// Of each kind of limit that the steady motion passes the worst axis, in words: static part, amplitude and limit.
fn exceeds<'a>(
    model: &LevitationModel,
    excesses: impl Iterator<Item = &'a Excess> + Clone,
) -> String {
    let share = |own: &Excess| (own.fixed.abs() + own.amplitude) / own.allowed;
    let worst = excesses.clone().filter(|own| {
        let mut others = excesses.clone().filter(|other| other.limit == own.limit);
        !others.any(|other| share(other) > share(own))
    });
    let words = worst.map(|own| {
        let axis = &model.levitation.actuators()[own.axis];
        let (what, factor, unit, of) = match own.limit {
            Limit::Current => ("control current", 1.0, "A", "of its coils, less the bias"),
            Limit::Voltage => ("voltage", 1.0, "V", "of its amplifier"),
            Limit::Gap => ("displacement", 1e3, "mm", "of the gap"),
            Limit::Idle => ("control current", 1.0, "A", "of bias in the coil that it weakens"),
        };
        let [fixed, amplitude, allowed] = [own.fixed.abs(), own.amplitude, own.allowed];
        let [fixed, amplitude, allowed] = [fixed, amplitude, allowed].map(|value| factor * value);
        format!(
            "{fixed:.4} {unit} of static {what} and {amplitude:.4} {unit} of unbalance amplitude on axis {}, with a limit of {allowed:.4} {unit} {of}",
            axis.axis.name
        )
    });
    words.collect::<Vec<_>>().join("; ")
}

/// Refuses a steady motion beyond a limit of coil current, voltage or gap: no rotor can start in it.
pub(crate) fn within_limits(
    model: &LevitationModel,
    excesses: &[Excess],
) -> Result<(), Box<Problem>> {
    let all = excesses.iter().filter(|own| own.limit != Limit::Idle);
    let Some(excess) = all.clone().next() else {
        return Ok(());
    };
    let key = match excess.limit {
        Limit::Voltage => "largest_voltage",
        Limit::Gap => "gap",
        Limit::Current | Limit::Idle => "largest_current",
    };
    let allowed = "a start within the limits of the magnets is needed: less unbalance, another speed, or more current, voltage or gap";
    let (key, found) = (format!("levitation.magnet.{key}"), exceeds(model, all));
    Err(problem_at(Code::StartBeyondLimit, key, found, allowed))
}

problem::warnings! {
    /// Of the steady motion on magnets.
    pub enum LevitationWarning {
        BeyondLimits { speed: "rad/s", needed: words } "AB2079" Invalid
            ("At {speed:.1} rad/s the magnets need {needed}: they cannot do so, and stability, response and orbit are not those given here.");
        IdleCoil { speed: "rad/s", needed: words } "AB2080" Uncertain
            ("At {speed:.1} rad/s the magnets need {needed}: that coil is without current for a part of each turn, where force over current is smaller than in the linear analysis.");
    }
}

/// What the steady motion of an analysis makes doubtful: limits that it passes, and coils without current.
pub fn warnings(model: &LevitationModel, excesses: &[Excess], speed: f64) -> Vec<Warning> {
    let of = |idle: bool| {
        excesses
            .iter()
            .filter(move |own| (own.limit == Limit::Idle) == idle)
    };
    let needed = |idle: bool| {
        let any = of(idle).next().is_some();
        any.then(|| exceeds(model, of(idle)))
    };
    let beyond = needed(false).map(|needed| LevitationWarning::BeyondLimits { speed, needed });
    let idle = needed(true).map(|needed| LevitationWarning::IdleCoil { speed, needed });
    beyond.into_iter().chain(idle).map(Warning::from).collect()
}

/// Refuses coils that cannot carry the weight.
fn strong(model: &LevitationModel, rest: &Equilibrium) -> Result<(), Box<Problem>> {
    let all = excesses(&model.levitation, rest, None, 0.0);
    let Some(excess) = all.iter().find(|own| own.limit == Limit::Current) else {
        return Ok(());
    };
    let name = &model.levitation.actuators()[excess.axis].axis.name;
    let (found, limit) = (excess.fixed.abs(), excess.allowed);
    Err(weak(&format!(
        "{found:.4} A of control current on axis {name} to hold the weight, {limit:.4} A there"
    )))
}

/// Coils that cannot hold what they should.
fn weak(found: &str) -> Box<Problem> {
    let allowed = "coils whose largest current, less the bias, holds the weight are needed";
    let key = "levitation.magnet.largest_current";
    problem_at(Code::CurrentLimit, key, found, allowed)
}

/// A levitation that cannot be computed.
pub fn failed(text: &str) -> Box<Problem> {
    let needed = "another levitation is needed";
    problem_at(Code::Impossible, "levitation", text, needed)
}
