//! From magnets that hold a rotor to those of the model, which act in time.

use crate::drop::{Drop, Shaft};
use levitation::{Levitation, Timing};
use model::magnets::{AxisConstants, ControlConstants, MagnetConstants, MagnetsConstants};
use number::Vec2;
use problem::{Code, Problem};
use scenario::problem_at;
use std::sync::Arc;

/// Samples of a run, at most: each ends a step.
const MOST_SAMPLES: f64 = 1e7;

/// Refuses samples that are too many to be landed on.
fn few_samples(drop: &Drop, shaft: &Shaft, timing: Timing) -> Result<(), Box<Problem>> {
    let Timing::Sampled { period, .. } = timing else {
        return Ok(());
    };
    let samples = shaft.power_lost.min(drop.run.duration) / period;
    if samples <= MOST_SAMPLES {
        return Ok(());
    }
    let found = format!("{samples:.1e} samples in this run");
    let allowed = "at most 10 million are needed: a longer period, or a shorter run";
    let key = "levitation.controller.sampling_period";
    Err(problem_at(Code::ControllerTime, key, found, allowed))
}

/// Magnets that hold a rotor.
pub(super) struct OnMagnets {
    /// Control currents of their axes, A.
    pub currents: Vec<f64>,
    /// States of their controllers.
    pub states: Vec<f64>,
}

/// Refuses currents that decay where there are none, and a loss of power after the start where there is none to lose, or where the run has no end of its own.
pub(super) fn lost_later(drop: &Drop, shaft: &Shaft) -> Result<(), Box<Problem>> {
    if shaft.decay_time > 0.0 && shaft.model.levitation.is_none() {
        let (key, found) = ("levitation.decay_time", "a key that has no effect");
        let allowed = "it is used only with [[levitation.magnet]]";
        return Err(problem_at(Code::UnusedKey, key, found, allowed));
    }
    let found = match (&shaft.model.levitation, &drop.coast_down) {
        _ if shaft.power_lost <= 0.0 => return Ok(()),
        (None, _) => "no magnets, whose power could be lost",
        (_, Some(_)) => "run.until = \"standstill\"",
        (Some(model), None) => return few_samples(drop, shaft, model.levitation.timing()),
    };
    let allowed = "magnets with their controllers, and a run of a given duration, are needed for a loss after the start";
    let key = "levitation.power_lost_at";
    Err(problem_at(Code::Conflict, key, found, allowed))
}

/// The magnets: with their controllers until the power is lost, or as their currents decay from the start on.
pub(super) fn built(
    shaft: &Shaft,
    row: &dyn Fn(usize) -> Vec<f64>,
    position: &[Vec2<f64>],
    held: &OnMagnets,
) -> Option<MagnetsConstants> {
    let model = shaft.model.levitation.as_ref()?;
    let controlled = shaft.power_lost > 0.0;
    if !controlled && shaft.decay_time <= 0.0 {
        return None;
    }
    let levitation = &model.levitation;
    let along = |angle: f64| Vec2::new(angle.cos(), angle.sin());
    let pair = |k: usize| [2 * k, 2 * k + 1];
    let magnet = |(k, (_, node, _)): (usize, &(String, usize, usize))| MagnetConstants {
        node: row(*node),
        axes: pair(k)
            .map(|axis| AxisConstants {
                direction: along(levitation.actuators()[axis].axis.angle),
                law: levitation.actuators()[axis].magnet,
                current: held.currents[axis],
                current_limits: [
                    levitation.actuators()[axis].lowest_current,
                    levitation.actuators()[axis].largest_current,
                ],
            })
            .to_vec(),
    };
    let sensor = |(k, (_, _, node)): (usize, &(String, usize, usize))| {
        let angles = pair(k).map(|axis| along(levitation.sensors()[axis].axis.angle));
        (row(*node), angles.to_vec())
    };
    let all = || model.magnets.iter().enumerate();
    Some(MagnetsConstants {
        magnets: all().map(magnet).collect(),
        decay_rate: 1.0 / shaft.decay_time,
        lost: shaft.power_lost,
        control: controlled.then(|| {
            let sensors: Vec<_> = all().map(sensor).collect();
            ControlConstants {
                start: sampled(levitation, &sensors, position, held.states.clone()),
                levitation: Arc::new(levitation.clone()),
                sensors,
            }
        }),
    })
}

/// States of the levitation after the sample of the start.
fn sampled(
    levitation: &Levitation,
    sensors: &[(Vec<f64>, Vec<Vec2<f64>>)],
    position: &[Vec2<f64>],
    mut states: Vec<f64>,
) -> Vec<f64> {
    let Timing::Sampled { computation, .. } = levitation.timing() else {
        return states;
    };
    let mut sensed = Vec::new();
    for (node, directions) in sensors {
        let pairs = node.iter().zip(position);
        let at = pairs.fold(Vec2::zero(), |sum, (share, own)| sum + *own * *share);
        sensed.extend(directions.iter().map(|along| along.dot(at)));
    }
    levitation.sample(&mut states, &sensed, &mut levitation.signals());
    if computation == 0.0 {
        levitation.release(&mut states);
    }
    states
}
