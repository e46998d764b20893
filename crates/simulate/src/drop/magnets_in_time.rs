//! From magnets that hold a rotor to those of the model, which act in time.

use crate::drop::{Drop, Shaft};
use levitation::{Axis, Inputs, Levitation, Timing};
use model::magnets::conditions::{Change, What};
use model::magnets::{
    AxisConstants, ControlConstants, ControlEvent, MagnetConstants, MagnetsConstants,
    SupplyConstants,
};
use model::system::machine::{AtSpeed, Event};
use number::Vec2;
use problem::{Code, Problem};
use scenario::{Happens, MagnetEvent, When, problem_at};
use statistics::normal::quantile;
use statistics::random::uniform;

/// Magnets that hold a rotor.
pub(super) struct OnMagnets {
    /// Control currents of their axes, A.
    pub currents: Vec<f64>,
    /// States of their controllers.
    pub states: Vec<f64>,
}

/// Refuses currents that decay where there are none, and a loss of power after the start where there is none to lose, or where the run
/// goes on without magnets.
pub(super) fn lost_later(drop: &Drop, shaft: &Shaft) -> Result<(), Box<Problem>> {
    if shaft.decay_time > 0.0 && shaft.model.levitation.is_none() {
        let (key, found) = ("levitation.decay_time", "a key that has no effect");
        let allowed = "it is used only with [[levitation.magnet]]";
        return Err(problem_at(Code::UnusedKey, key, found, allowed));
    }
    let found = match (&shaft.model.levitation, &drop.coast_down) {
        _ if shaft.power_lost <= 0.0 => return Ok(()),
        (None, _) => "no magnets, whose power could be lost",
        (_, Some(_)) if shaft.power_lost > drop.run.duration => {
            "run.until = \"standstill\" and a loss after run.duration"
        }
        _ => return Ok(()),
    };
    let allowed =
        "magnets with their controllers are needed for a loss after the start, within run.duration";
    let key = "levitation.power_lost_at";
    Err(problem_at(Code::Conflict, key, found, allowed))
}

/// Magnets as they act in a run, and what happens to them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct InTime {
    /// The magnets, where they act after the start.
    pub magnets: Option<MagnetsConstants>,
    /// What happens at known instants.
    pub known: Vec<(f64, Event)>,
    /// What happens where the rotor reaches a speed.
    pub at_speeds: Vec<AtSpeed>,
}

/// The magnets: with their controllers, or as their currents decay from the start on.
pub(super) fn built(
    shaft: &Shaft,
    end: f64,
    row: &dyn Fn(&Axis) -> Vec<f64>,
    position: &[Vec2<f64>],
    held: &OnMagnets,
) -> Result<InTime, Box<Problem>> {
    let Some(model) = shaft.model.levitation.as_ref() else {
        return Ok(InTime::default());
    };
    let levitation = &model.levitation;
    let along = |angle: f64| Vec2::new(angle.cos(), angle.sin());
    let pair = |k: usize| [2 * k, 2 * k + 1];
    let magnet = |k: usize| MagnetConstants {
        node: row(&levitation.actuators()[2 * k].axis),
        axes: pair(k)
            .map(|axis| AxisConstants {
                direction: along(levitation.actuators()[axis].axis.angle),
                law: levitation.actuators()[axis].magnet,
                current: held.currents[axis],
            })
            .to_vec(),
    };
    let sensor = |k: usize| {
        let angles = pair(k).map(|axis| along(levitation.sensors()[axis].axis.angle));
        (row(&levitation.sensors()[2 * k].axis), angles.to_vec())
    };
    let all = || 0..model.magnets.len();
    let of_magnets = |supply| MagnetsConstants {
        magnets: all().map(magnet).collect(),
        supply,
    };
    if let Some(decay_time) = lost_at_once(shaft, levitation.actuators().len()) {
        // without decay the magnets are gone
        let decay_rate = 1.0 / decay_time;
        let supply = SupplyConstants::Lost {
            decay_rate,
            at: 0.0,
        };
        let magnets = (decay_time > 0.0).then(|| of_magnets(supply));
        return Ok(InTime {
            magnets,
            ..InTime::default()
        });
    }
    let sensors: Vec<_> = all().map(sensor).collect();
    let axes = levitation.actuators().len();
    let of_magnets_alone = shaft.events.iter().filter_map(|own| match &own.what {
        Happens::Magnets(axes, what) => Some((own.when, axes, what)),
        _ => None,
    });
    let happening: Vec<(When, Change)> =
        of_magnets_alone.flat_map(|own| changes(own, end)).collect();
    let start = sampled(levitation, &sensors, position, held.states.clone());
    let changes = happening.iter().map(|(_, change)| change.clone()).collect();
    let control = ControlConstants::new(levitation.clone(), sensors, start, changes);
    settles(&control)?;
    let (mut known, mut at_speeds) = (Vec::new(), Vec::<AtSpeed>::new());
    for (index, (when, _)) in happening.iter().enumerate() {
        let event = Event::Control(ControlEvent::Change(index));
        happens(*when, event, &mut known, &mut at_speeds);
    }
    for [from, to] in powered(&happening, axes, end) {
        few_samples(to - from, levitation.timing())?;
        let samples = control.samples(from, to).into_iter();
        known.extend(samples.map(|(time, event)| (time, Event::Control(event))));
    }
    Ok(InTime {
        magnets: Some(of_magnets(SupplyConstants::Control(control))),
        known,
        at_speeds,
    })
}

/// Adds an event to those of known instants or to what follows a speed.
pub(super) fn happens(
    when: When,
    event: Event,
    known: &mut Vec<(f64, Event)>,
    at_speeds: &mut Vec<AtSpeed>,
) {
    match when {
        When::At(time) => known.push((time, event)),
        When::Speed {
            speed,
            rising,
            delay,
        } => at_speed(at_speeds, (speed, rising), (delay, event)),
    }
}

/// Adds what follows a speed.
fn at_speed(list: &mut Vec<AtSpeed>, (speed, rising): (f64, bool), then: (f64, Event)) {
    let same = |own: &&mut AtSpeed| own.speed == speed && own.rising == rising;
    match list.iter_mut().find(same) {
        Some(own) => {
            let at = own.then.partition_point(|other| other.0 <= then.0);
            own.then.insert(at, then);
        }
        None => list.push(AtSpeed {
            speed,
            rising,
            then: vec![then],
        }),
    }
}

/// Time in which the currents of all magnets decay, s, where they have no power from the start on and nothing happens to them later.
fn lost_at_once(shaft: &Shaft, count: usize) -> Option<f64> {
    let mut events = shaft.events.iter().filter(|own| own.what.axes().is_some());
    match (events.next(), events.next()) {
        (
            Some(scenario::Event {
                when: When::At(time),
                what: Happens::Magnets(axes, MagnetEvent::Lost(decay_time)),
                ..
            }),
            None,
        ) if *time <= 0.0 && axes.len() == count => Some(*decay_time),
        _ => None,
    }
}

/// What an event changes, and when: noise changes again and again.
fn changes((when, axes, what): (When, &Vec<usize>, &MagnetEvent), end: f64) -> Vec<(When, Change)> {
    let MagnetEvent::SensorNoise {
        deviation,
        period,
        seed,
    } = what
    else {
        return vec![(when, change(what, axes.clone()))];
    };
    let values = (end / period).ceil() as u64;
    let each = (0..=values).flat_map(|k| {
        let later = k as f64 * period;
        let when = match when {
            When::At(time) => When::At(time + later),
            When::Speed {
                speed,
                rising,
                delay,
            } => When::Speed {
                speed,
                rising,
                delay: delay + later,
            },
        };
        axes.iter().map(move |axis| {
            let value = deviation * quantile(uniform(*seed, *axis as u64, k));
            let axes = vec![*axis];
            let what = What::Noise(value);
            (when, Change { what, axes })
        })
    });
    each.filter(|(when, _)| !matches!(when, When::At(time) if *time > end))
        .collect()
}

/// A change of the model.
fn change(what: &MagnetEvent, axes: Vec<usize>) -> Change {
    // what decays or rises in no time does so at once
    let rate = |time: f64| 1.0 / time;
    let what = match what {
        MagnetEvent::Lost(decay_time) => What::Lost {
            decay_rate: rate(*decay_time),
        },
        MagnetEvent::SensorStuck => What::Stuck,
        MagnetEvent::SensorDead => What::Dead,
        MagnetEvent::SensorOffset(offset) => What::Offset(*offset),
        MagnetEvent::ControllerFrozen => What::Frozen,
        MagnetEvent::AmplifierLimit {
            largest_current,
            slew,
        } => What::Limited {
            largest_current: *largest_current,
            slew: *slew,
        },
        MagnetEvent::Relevitated(own) => What::Levitated {
            bias_rate: rate(own.bias_time),
            reference_rate: rate(own.reference_time),
        },
        MagnetEvent::SensorNoise { .. } => unreachable!("it changes again and again"),
    };
    Change { what, axes }
}

/// Refuses controllers that would have to start again and do not settle at rest.
fn settles(control: &ControlConstants) -> Result<(), Box<Problem>> {
    let again = |own: &Change| matches!(own.what, What::Levitated { .. });
    if !control.changes.iter().any(again) {
        return Ok(());
    }
    let levitation = &control.levitation;
    let still = vec![0.0; levitation.sensors().len()];
    let mut states = vec![0.0; levitation.states()];
    let settled = levitation.settle(&mut states, Inputs::usual(&still, &[]));
    settled.map_err(|_| {
        let found = "a controller whose states do not settle under a constant error";
        let allowed = "integrators as states of their own, with nothing but zeros in their rows of A, are needed for a re-levitation";
        problem_at(Code::ControllerFilter, "levitation.controller", found, allowed)
    })
}

/// Intervals of a run in which any magnet has power; all of it where speeds decide that.
fn powered(happening: &[(When, Change)], axes: usize, end: f64) -> Vec<[f64; 2]> {
    let mut switches = Vec::new();
    for (when, change) in happening {
        let on = match change.what {
            What::Lost { .. } if change.axes.len() == axes => false,
            What::Levitated { .. } => true,
            _ => continue,
        };
        match when {
            When::At(time) => switches.push((*time, on)),
            When::Speed { .. } => return vec![[0.0, end]],
        }
    }
    switches.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut intervals, mut since) = (Vec::new(), Some(0.0));
    for (time, on) in switches {
        match (since, on) {
            (Some(from), false) => {
                intervals.push([from, time.min(end)]);
                since = None;
            }
            (None, true) => since = Some(time),
            _ => {}
        }
    }
    intervals.extend(since.map(|from| [from, end]));
    intervals.retain(|[from, to]| from < to);
    intervals
}

/// Samples of a run, at most: each ends a step.
const MOST_SAMPLES: f64 = 1e7;

/// Refuses samples that are too many to be landed on.
fn few_samples(duration: f64, timing: Timing) -> Result<(), Box<Problem>> {
    let Timing::Sampled { period, .. } = timing else {
        return Ok(());
    };
    let samples = duration / period;
    if samples <= MOST_SAMPLES {
        return Ok(());
    }
    let found = format!("{samples:.1e} samples in this run");
    let allowed = "at most 10 million are needed: a longer period, or a shorter run";
    let key = "levitation.controller.sampling_period";
    Err(problem_at(Code::ControllerTime, key, found, allowed))
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
    let inputs = Inputs::usual(&sensed, &[]);
    levitation.sample(&mut states, inputs, &mut levitation.signals());
    if computation == 0.0 {
        levitation.release(&mut states);
    }
    states
}
