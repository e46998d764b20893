//! Magnets at nodes of the rotor: they follow their controllers while they have power, then their currents decay.
//!
//! ```text
//!   with power    i from the controllers' states,  e = 1
//!   without       i(t_f) e,  e = exp(-(t - t_f)/τ);  controllers stand still
//!   F = Σ d f(i, d·C, e)                             axes d of a magnet, C the geometric centre at its node
//! ```
//! f is the [law](physics::magnet) of an axis: with the current the bias decays too, and with both what the magnet pulls by. The
//! rates of sensors, controllers and amplifiers are those that the linear analysis takes its matrices from
//! ([`Levitation::rate`]). Work is a signed source: damping is electronic, no part gets warm.
//!
//! A sampled controller changes its states at landed instants; nothing else jumps.

use crate::rotor::{GeometricCentre, Node, RotorAt, RotorConstants, RotorMotion};
use ::levitation::{Levitation, LinearControl, OfAxes};
use number::{Gather, Mask, Real, Vec2, Vectorized};
use physics::magnet::Magnet;
use smallvec::{SmallVec, smallvec};
use std::ops::Range;
use std::sync::Arc;

/// The magnets of a rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct MagnetsConstants {
    /// Each at a node.
    pub magnets: Vec<MagnetConstants>,
    /// 1/τ, 1/s; infinite where the currents are gone at once.
    pub decay_rate: f64,
    /// Instant t_f at which the power is lost, s; not after the start where nothing controls the currents.
    pub lost: f64,
    /// What controls the currents until then.
    pub control: Option<ControlConstants>,
}

/// A magnet at a node.
#[derive(Clone, Debug, PartialEq)]
pub struct MagnetConstants {
    /// Row φ of the node.
    pub node: Vec<f64>,
    /// Its axes, in the order of the levitation.
    pub axes: Vec<AxisConstants>,
}

/// An axis of a magnet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisConstants {
    /// Direction, a unit vector.
    pub direction: Vec2<f64>,
    /// Force law.
    pub law: Magnet<f64>,
    /// Control current when the power was lost, where nothing controls it, A.
    pub current: f64,
    /// Its lowest and its largest, A; infinite without limit.
    pub current_limits: [f64; 2],
}

/// Sensors, controllers and amplifiers.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlConstants {
    /// Their rates.
    pub levitation: Arc<Levitation>,
    /// Row φ of each sensor's node with the directions of its axes, in the order of the levitation.
    pub sensors: Vec<(Vec<f64>, Vec<Vec2<f64>>)>,
    /// Their states at the start.
    pub start: Vec<f64>,
}

/// What happens to controllers at landed instants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlEvent {
    /// The power is lost.
    PowerLost,
    /// A sample is taken and its command computed.
    Sample,
    /// The last command computed is held from now on.
    Release,
}

impl MagnetsConstants {
    /// Linear magnets whose currents decay from an instant on: the row of each, its force F_0 = k_i i (N) of that instant, k_s (N/m).
    pub fn fading(
        all: impl IntoIterator<Item = (Vec<f64>, Vec2<f64>, f64)>,
        decay_rate: f64,
        lost: f64,
    ) -> Self {
        let magnet = |(node, force, stiffness): (Vec<f64>, Vec2<f64>, f64)| {
            let axis = |direction: Vec2<f64>| AxisConstants {
                direction,
                law: Magnet::Linear {
                    current_stiffness: 1.0,
                    position_stiffness: stiffness,
                },
                current: force.dot(direction),
                current_limits: [f64::NEG_INFINITY, f64::INFINITY],
            };
            let axes = vec![axis(Vec2::new(1.0, 0.0)), axis(Vec2::new(0.0, 1.0))];
            MagnetConstants { node, axes }
        };
        MagnetsConstants {
            magnets: all.into_iter().map(magnet).collect(),
            decay_rate,
            lost,
            control: None,
        }
    }

    /// Rows of all nodes.
    pub fn nodes(&self) -> impl Iterator<Item = &Vec<f64>> {
        let sensors = self.control.iter().flat_map(|control| &control.sensors);
        let magnets = self.magnets.iter().map(|magnet| &magnet.node);
        magnets.chain(sensors.map(|(node, _)| node))
    }

    /// Names of the states: those of the levitation, then currents that are none there, as they were when the power was lost.
    pub fn state_names(&self) -> Vec<String> {
        let Some(control) = &self.control else {
            return Vec::new();
        };
        let mut names = control.levitation.names().to_vec();
        for (k, actuator) in control.levitation.actuators().iter().enumerate() {
            if control.levitation.current_state(k).is_none() {
                names.push(format!("{}.current kept", actuator.axis.name));
            }
        }
        names
    }

    /// What matters in each state when the rotor is displaced by a length, m.
    pub fn error_scale(&self, scale: &mut [f64], displacement: f64) {
        if let Some(control) = &self.control {
            scale.fill(1.0);
            let own = LinearControl::scales(&control.levitation, displacement);
            scale[..own.len()].copy_from_slice(&own);
        }
    }

    /// Instants of a run at which something happens to the controllers, with what does; the sample of the start is taken already.
    pub fn events(&self, end: f64) -> Vec<(f64, ControlEvent)> {
        let mut events = Vec::new();
        let Some(control) = &self.control else {
            return events;
        };
        if let ::levitation::Timing::Sampled {
            period,
            computation,
        } = control.levitation.timing()
        {
            let mut k = 0.0;
            while k * period < self.lost.min(end) {
                if k > 0.0 {
                    events.push((k * period, ControlEvent::Sample));
                }
                // one without computing time is released in the start already; none comes after the next sample
                if k > 0.0 || computation > 0.0 {
                    let release = (k * period + computation).min((k + 1.0) * period);
                    events.push((release, ControlEvent::Release));
                }
                k += 1.0;
            }
            events.retain(|(time, _)| *time < self.lost);
        }
        events.push((self.lost, ControlEvent::PowerLost));
        events
    }

    /// Whether other magnets can stand beside these in lanes.
    pub fn share_lanes(&self, other: &Self) -> bool {
        let kinds = |all: &Self| -> Vec<Vec<bool>> {
            let pair = |axis: &AxisConstants| matches!(axis.law, Magnet::Pair(_));
            let axes = |magnet: &MagnetConstants| magnet.axes.iter().map(pair).collect();
            all.magnets.iter().map(axes).collect()
        };
        let loop_of = |all: &Self| all.control.as_ref().map(|own| own.levitation.clone());
        kinds(self) == kinds(other) && loop_of(self) == loop_of(other)
    }
}

/// Magnets over `R`.
#[derive(Clone, Debug)]
pub struct Magnets<R> {
    list: Vec<(Node<R>, Vec<Axis<R>>)>,
    decay_rate: R,
    /// 1 where currents decay, 0 where they are gone at once.
    fades: R,
    lost: R,
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
    /// State of each current once the power is lost.
    kept: Vec<usize>,
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

/// Magnets at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Instant<R> {
    /// Time, s.
    pub time: R,
    /// 1 with power, 0 without.
    pub powered: R,
}

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
            decay_rate: lanes(&|all| {
                if all.decay_rate.is_finite() {
                    all.decay_rate
                } else {
                    0.0
                }
            }),
            fades: lanes(&|all| f64::from(u8::from(all.decay_rate.is_finite()))),
            lost: lanes(&|all| all.lost),
            control: of(0).control.as_ref().map(|control| {
                let own = |lane: usize| of(lane).control.as_ref().expect("lanes share it");
                let sensors = control.sensors.iter().enumerate();
                let mut last = control.levitation.states();
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
                    kept: (0..control.levitation.actuators().len())
                        .map(|k| {
                            control.levitation.current_state(k).unwrap_or_else(|| {
                                last += 1;
                                last - 1
                            })
                        })
                        .collect(),
                }
            }),
        }
    }

    /// Displacements of the sensor axes, m.
    #[inline(always)]
    fn sensed(control: &Control<R>, rotor: &RotorMotion<R>) -> OfAxes<R> {
        let mut out = OfAxes::new();
        for (node, directions) in &control.sensors {
            let at = node.centre(rotor).position;
            for along in directions {
                out.push(along.dot(at));
            }
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

    /// Control currents of all axes, A; with power also the rates of the controllers.
    ///
    /// Loops, not iterators: their closures would be left outside the vector unit.
    #[inline(always)]
    fn currents(
        &self,
        now: Instant<R>,
        (rotor, centres): (&RotorMotion<R>, &[GeometricCentre<R>]),
        states: &[R],
        rates: &mut [R],
    ) -> OfAxes<R> {
        let mut currents = OfAxes::new();
        let Some(control) = &self.control else {
            for (_, axes) in &self.list {
                for axis in axes {
                    currents.push(axis.current);
                }
            }
            return currents;
        };
        for at in &control.kept {
            currents.push(states[*at]);
        }
        let on = now.powered.greater(R::zero());
        if !on.any() {
            rates.fill(R::zero());
            return currents;
        }
        let levitation = &control.levitation;
        let mut signals = levitation.signals();
        let mut velocities = OfAxes::new();
        for ((_, axes), centre) in self.list.iter().zip(centres) {
            for axis in axes {
                velocities.push(axis.direction.dot(centre.velocity));
            }
        }
        let sensed = Self::sensed(control, rotor);
        let (own, others) = rates.split_at_mut(levitation.states());
        let own_states = &states[..levitation.states()];
        levitation.rate(own_states, &sensed, &velocities, &mut signals, own);
        others.fill(R::zero());
        for rate in own {
            *rate = R::select(on, *rate, R::zero());
        }
        for (current, now) in currents.iter_mut().zip(&signals.currents) {
            *current = R::select(on, *now, *current);
        }
        currents
    }

    /// What is left of the bias, 1 with power.
    #[inline(always)]
    fn bias_share(&self, now: Instant<R>) -> R {
        let left = self.fades * (self.decay_rate * (self.lost - now.time)).exp();
        R::select(now.powered.greater(R::zero()), R::one(), left)
    }

    /// What each magnet does; the rates of the controllers go to `rates`.
    #[inline(always)]
    pub fn pull(
        &self,
        now: Instant<R>,
        rotor: &RotorMotion<R>,
        states: &[R],
        rates: &mut [R],
    ) -> Pulls<R> {
        R::vectorized(Act {
            magnets: self,
            now,
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

/// What magnets do, as a task: it is compiled once, apart from the steps of a machine.
struct Act<'a, R: Real> {
    magnets: &'a Magnets<R>,
    now: Instant<R>,
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
            now,
            rotor,
            states,
            rates,
        } = self;
        let centres = magnets.centres(rotor);
        let currents = magnets.currents(now, (rotor, &centres), states, rates);
        let share = magnets.bias_share(now);
        let mut first = 0;
        let mut out = Pulls::new();
        for ((_, axes), centre) in magnets.list.iter().zip(&centres) {
            let mut force = Vec2::zero();
            for (axis, current) in axes.iter().zip(&currents[first..]) {
                let gap = axis.direction.dot(centre.position);
                force += axis.direction * axis.law.force(*current * share, gap, share);
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

impl Magnets<f64> {
    /// Control currents of all axes in a state, A; without power what is left of them.
    pub fn currents_in(
        &self,
        now: Instant<f64>,
        rotor: &RotorMotion<f64>,
        states: &[f64],
    ) -> OfAxes<f64> {
        let centres = self.centres(rotor);
        let mut rates: SmallVec<[f64; 64]> = smallvec![0.0; states.len()];
        let all = self.currents(now, (rotor, &centres), states, &mut rates);
        let share = self.bias_share(now);
        all.iter().map(|current| current * share).collect()
    }

    /// With power, of each axis: the voltage asked of its amplifier over the largest it has; empty where no voltage is limited.
    pub fn voltage_shares(&self, rotor: &RotorMotion<f64>, states: &[f64]) -> OfAxes<f64> {
        let control = self.control.as_ref();
        let Some(control) = control.filter(|own| own.levitation.limits_voltage()) else {
            return OfAxes::new();
        };
        let levitation = &control.levitation;
        let mut signals = levitation.signals();
        let sensed = Self::sensed(control, rotor);
        levitation.read(&states[..levitation.states()], &sensed, &mut signals);
        levitation.voltage_shares(&signals)
    }

    /// How far the rotor has come to a pole along each axis, of the gap there.
    pub fn towards_poles(&self, rotor: &RotorMotion<f64>) -> OfAxes<f64> {
        let centres = self.centres(rotor);
        let magnets = self.list.iter().zip(&centres);
        magnets
            .flat_map(|((_, axes), centre)| {
                let share =
                    |axis: &Axis<f64>| (axis.direction.dot(centre.position) / axis.law.gap()).abs();
                axes.iter().map(share)
            })
            .collect()
    }

    /// What happens to the states of the controllers at a landed instant; `magnets` are their channels.
    pub fn happen(
        &self,
        event: ControlEvent,
        at: RotorAt,
        magnets: Range<usize>,
        state: &mut [f64],
    ) {
        let Some(control) = &self.control else {
            return;
        };
        let levitation = &control.levitation;
        let mut signals = levitation.signals();
        let sensed = Self::sensed(control, &at.motion(state));
        let own = &mut state[magnets];
        match event {
            ControlEvent::Sample => {
                levitation.sample(&mut own[..levitation.states()], &sensed, &mut signals);
            }
            ControlEvent::Release => levitation.release(&mut own[..levitation.states()]),
            ControlEvent::PowerLost => {
                levitation.read(&own[..levitation.states()], &sensed, &mut signals);
                for (at, current) in control.kept.iter().zip(&signals.currents) {
                    own[*at] = *current;
                }
            }
        }
    }
}
