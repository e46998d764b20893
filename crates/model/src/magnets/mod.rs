//! Magnets at nodes of the rotor: they follow their controllers while they have power, then their currents decay.
//!
//! ```text
//!   with power    i from the controllers' states,  e = 1
//!   without       i(t_f) d,  e = d = exp(-(t - t_f)/τ);  controllers of magnets that all have none stand still
//!   F = Σ d f(i₊, i₋, d·C, e)                        axes d of a magnet, C the geometric centre at its node
//! ```
//! f is the [law](physics::magnet) of an axis: with the current the bias decays too, and with both what the magnet pulls by. The
//! rates of sensors, controllers and amplifiers are those that the linear analysis takes its matrices from
//! ([`Levitation::rate`]). Work is a signed source: damping is electronic, no part gets warm.
//!
//! What happens to magnets, sensors and controllers changes [conditions] at landed instants, or where the rotor reaches a speed; a
//! sampled controller changes its states at landed instants; nothing else jumps.

pub mod conditions;
mod constants;
mod in_run;

pub use constants::{
    AxisConstants, ControlConstants, ControlEvent, MagnetConstants, MagnetsConstants,
    SupplyConstants,
};
pub use in_run::CurrentsOfAxes;

use crate::rotor::{GeometricCentre, Node, RotorConstants, RotorMotion};
use ::levitation::{Condition, Inputs, Levitation, OfAxes};
use conditions::{Change, Conditions, Supply};
use number::{Gather, Mask, Real, Vec2, Vectorized};
use physics::magnet::Magnet;
use smallvec::SmallVec;
use std::sync::Arc;

/// Magnets over `R`.
#[derive(Clone, Debug)]
pub struct Magnets<R> {
    list: Vec<(Node<R>, Vec<Axis<R>>)>,
    /// Of currents that decay from the start on: channels of their supply.
    lost: [R; 5],
    control: Option<Control<R>>,
}

#[derive(Clone, Debug)]
struct Axis<R> {
    direction: Vec2<R>,
    law: Magnet<R>,
    current: R,
}

#[derive(Clone, Debug)]
struct Control<R> {
    levitation: Arc<Levitation>,
    sensors: Vec<(Node<R>, Vec<Vec2<R>>)>,
    conditions: Arc<Conditions>,
    changes: Arc<[Change]>,
    /// Conditions of axes to which nothing has happened; empty where none ever differs.
    usual: Vec<Condition<R>>,
}

/// What a magnet does.
#[derive(Clone, Copy, Debug)]
pub struct Pull<R> {
    /// The rotor at its node.
    pub centre: GeometricCentre<R>,
    /// Force on it, N.
    pub force: Vec2<R>,
}

/// What each magnet does.
pub type Pulls<R> = SmallVec<[Pull<R>; 4]>;

impl<R: Real> Magnets<R> {
    /// The magnets of rotors side by side, which [can](MagnetsConstants::share_lanes) stand there.
    pub(crate) fn gather<'a>(
        constants: &dyn Fn(usize) -> (&'a RotorConstants, &'a MagnetsConstants),
    ) -> Self {
        let of = |lane: usize| constants(lane).1;
        let lanes = |value: &dyn Fn(&MagnetsConstants) -> f64| R::from_lanes(|k| value(of(k)));
        for lane in 1..R::LANES {
            assert!(of(lane).share_lanes(of(0)), "lanes share their magnets");
        }
        let axis = |m: usize, a: usize| Axis {
            direction: Gather::<R>::gather(&|lane| &of(lane).magnets[m].axes[a].direction),
            law: Gather::<R>::gather(&|lane| &of(lane).magnets[m].axes[a].law),
            current: lanes(&|all| all.magnets[m].axes[a].current),
        };
        let node = |row: &dyn Fn(&'a MagnetsConstants) -> &'a [f64]| {
            Node::gather(&|lane| (constants(lane).0, row(of(lane)), Vec2::zero()))
        };
        let magnets = of(0).magnets.iter().enumerate();
        Magnets {
            list: magnets
                .map(|(m, magnet)| {
                    let axes = (0..magnet.axes.len()).map(|a| axis(m, a));
                    (node(&|all| &all.magnets[m].node), axes.collect())
                })
                .collect(),
            lost: {
                // where they are gone at once nothing is left of bias and currents
                let rate = |all: &MagnetsConstants| match all.supply {
                    SupplyConstants::Lost { decay_rate, at } if decay_rate.is_finite() => {
                        [1.0, decay_rate, at]
                    }
                    _ => [0.0; 3],
                };
                let zero = R::zero();
                [
                    zero,
                    zero,
                    lanes(&|all| rate(all)[0]),
                    lanes(&|all| rate(all)[1]),
                    lanes(&|all| rate(all)[2]),
                ]
            },
            control: of(0).control().map(|control| {
                let own = |lane: usize| of(lane).control().expect("lanes share it");
                let sensors = control.sensors.iter().enumerate();
                let conditions = control.conditions.clone();
                let changes = control.changes.clone();
                let actuators = control.levitation.actuators().iter();
                let usual = match conditions.differ {
                    true => actuators.map(Condition::of).collect(),
                    false => Vec::new(),
                };
                Control {
                    levitation: control.levitation.clone(),
                    sensors: sensors
                        .map(|(s, (_, directions))| {
                            let along =
                                |k: usize| Gather::<R>::gather(&|lane| &own(lane).sensors[s].1[k]);
                            let node = Node::gather(&|lane| {
                                (constants(lane).0, &own(lane).sensors[s].0[..], Vec2::zero())
                            });
                            (node, (0..directions.len()).map(along).collect())
                        })
                        .collect(),
                    conditions,
                    changes,
                    usual,
                }
            }),
        }
    }

    /// What is known of the axes at an instant.
    #[inline(always)]
    fn axes(control: &Control<R>, time: R, rotor: &RotorMotion<R>, states: &[R]) -> Axes<R> {
        let mut out = Axes {
            supplies: SmallVec::new(),
            shown: OfAxes::new(),
            references: OfAxes::new(),
            conditions: SmallVec::new(),
        };
        let of = &control.conditions;
        for supply in 0..of.supplies() {
            out.supplies.push(of.supply(supply, states, time));
        }
        for (node, directions) in &control.sensors {
            let at = node.centre(rotor).position;
            for along in directions {
                let axis = out.shown.len();
                out.shown.push(of.shown(axis, along.dot(at), states));
            }
        }
        if of.have_references() {
            for axis in 0..out.shown.len() {
                let supply = &out.supplies[of.supply_of(axis)];
                out.references.push(of.reference(axis, states, supply));
            }
        }
        for (axis, usual) in control.usual.iter().enumerate() {
            let supply = &out.supplies[of.supply_of(axis)];
            (out.conditions).push(of.condition(axis, *usual, states, supply));
        }
        out
    }

    /// The rotor at each magnet.
    #[inline(always)]
    fn centres(&self, rotor: &RotorMotion<R>) -> SmallVec<[GeometricCentre<R>; 4]> {
        let mut out = SmallVec::new();
        for (node, _) in &self.list {
            out.push(node.centre(rotor));
        }
        out
    }

    /// Currents of the coils of all axes, A, with the share of the bias that is there; with power also the rates of the controllers.
    ///
    /// Loops, not iterators: their closures would be left outside the vector unit.
    #[inline(always)]
    fn coils(
        &self,
        time: R,
        (rotor, centres): (&RotorMotion<R>, &[GeometricCentre<R>]),
        states: &[R],
        rates: &mut [R],
    ) -> Coils<R> {
        let mut out = Coils::new();
        let Some(control) = &self.control else {
            let supply = Supply::new(self.lost, time);
            for (_, axes) in &self.list {
                for axis in axes {
                    let coils = axis.law.coils(axis.current * supply.left, supply.share);
                    out.push((coils, supply.share));
                }
            }
            return out;
        };
        let now = Self::axes(control, time, rotor, states);
        let of = &control.conditions;
        for (_, axes) in &self.list {
            for axis in axes {
                let supply = &now.supplies[of.supply_of(out.len())];
                let kept = &states[of.kept[out.len()].clone()];
                let coils = match *kept {
                    [near, far] => [near * supply.left, far * supply.left],
                    _ => axis.law.coils(kept[0] * supply.left, supply.share),
                };
                out.push((coils, supply.share));
            }
        }
        let mut on = now.supplies[0].on;
        for supply in &now.supplies {
            on = on | supply.on;
        }
        if !on.any() {
            rates.fill(R::zero());
            return out;
        }
        let levitation = &control.levitation;
        let mut signals = levitation.signals();
        let mut velocities = OfAxes::new();
        for ((_, axes), centre) in self.list.iter().zip(centres) {
            for axis in axes {
                velocities.push(axis.direction.dot(centre.velocity));
            }
        }
        let (own, others) = rates.split_at_mut(levitation.states());
        let own_states = &states[..levitation.states()];
        levitation.rate(own_states, now.inputs(&velocities), &mut signals, own);
        others.fill(R::zero());
        for rate in own.iter_mut() {
            *rate = R::select(on, *rate, R::zero());
        }
        let mut index = 0;
        for (_, axes) in &self.list {
            for axis in axes {
                let supply = &now.supplies[of.supply_of(index)];
                let (coils, _) = &mut out[index];
                let with_power = match levitation.has_coils(index) {
                    true => signals.coils[index],
                    false => axis.law.coils(signals.currents[index], supply.share),
                };
                for (kept, own) in coils.iter_mut().zip(with_power) {
                    *kept = R::select(supply.on, own, *kept);
                }
                // what is left of a current does not change in its state
                for at in of.kept[index].clone() {
                    if let Some(rate) = own.get_mut(at) {
                        *rate = R::select(supply.on, *rate, R::zero());
                    }
                }
                index += 1;
            }
        }
        out
    }

    /// What each magnet does; the rates of the controllers go to `rates`.
    #[inline(always)]
    pub fn pull(&self, time: R, rotor: &RotorMotion<R>, states: &[R], rates: &mut [R]) -> Pulls<R> {
        R::vectorized(Act {
            magnets: self,
            time,
            rotor,
            states,
            rates,
        })
    }

    /// Adds what they do to lists over the coordinates.
    #[inline(always)]
    pub fn push(&self, pulls: &Pulls<R>, [x, y]: [&mut [R]; 2]) {
        for ((node, _), pull) in self.list.iter().zip(pulls) {
            node.push(pull.force, [&mut *x, &mut *y]);
        }
    }
}

/// Currents of both coils of each axis, A, with the share of the bias that is there.
type Coils<R> = SmallVec<[([R; 2], R); 8]>;

/// What is known of all axes at an instant.
struct Axes<R: Real> {
    supplies: SmallVec<[Supply<R>; 2]>,
    /// What their sensors show, m.
    shown: OfAxes<R>,
    references: OfAxes<R>,
    conditions: SmallVec<[Condition<R>; 8]>,
}

impl<R: Real> Axes<R> {
    #[inline(always)]
    fn inputs<'a>(&'a self, velocities: &'a [R]) -> Inputs<'a, R> {
        Inputs {
            displacements: &self.shown,
            velocities,
            references: &self.references,
            conditions: &self.conditions,
        }
    }
}

/// What magnets do, as a task: it is compiled once, apart from the steps of a machine.
struct Act<'a, R: Real> {
    magnets: &'a Magnets<R>,
    time: R,
    rotor: &'a RotorMotion<'a, R>,
    states: &'a [R],
    rates: &'a mut [R],
}

impl<R: Real> Vectorized for Act<'_, R> {
    type Output = Pulls<R>;
    #[inline(always)]
    fn run(self) -> Pulls<R> {
        let Act {
            magnets,
            time,
            rotor,
            states,
            rates,
        } = self;
        let centres = magnets.centres(rotor);
        let coils = magnets.coils(time, (rotor, &centres), states, rates);
        let mut first = 0;
        let mut out = Pulls::new();
        for ((_, axes), centre) in magnets.list.iter().zip(&centres) {
            let mut force = Vec2::zero();
            for (axis, (coils, share)) in axes.iter().zip(&coils[first..]) {
                let gap = axis.direction.dot(centre.position);
                force += axis.direction * axis.law.force_of_coils(*coils, gap, *share);
            }
            first += axes.len();
            out.push(Pull {
                centre: *centre,
                force,
            });
        }
        out
    }
}
