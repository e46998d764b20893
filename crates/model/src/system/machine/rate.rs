//! The equations of motion of a machine.

use super::in_space::SpatialActs;
use super::layout::ROTOR_SOURCES;
use super::{Machines, Mode};
use crate::auxiliary_bearing::{AtNode, Outlet};
use crate::magnets::Pull;
use crate::mount::MountReaction;
use crate::rotor::RotorMotion;
use crate::system::rig::fixture::Acting;
use number::{Mask, Real, Vec2, Vectorized};

/// So many nodes are kept from the forces on the rotor for the bearings; more than the usual two bearings compute theirs twice.
const KEPT: usize = 2;

/// Rates of the rotor's coordinates: of x, y, ẋ, ẏ.
#[inline(always)]
pub(super) fn blocks<R>(rate: &mut [R], coordinates: usize) -> [&mut [R]; 4] {
    let (x, rest) = rate.split_at_mut(coordinates);
    let (y, rest) = rest.split_at_mut(coordinates);
    let (vx, rest) = rest.split_at_mut(coordinates);
    [x, y, vx, &mut rest[..coordinates]]
}

/// What mounts do to the housings that they stand on: the moment of these forces about the origin, N m. Apart, for few machines
/// have housings.
struct PushHousings<'a, R: Real> {
    machines: &'a Machines<R>,
    rotor: &'a RotorMotion<'a, R>,
    state: &'a [R],
    rate: &'a mut [R],
}

impl<R: Real> Vectorized for PushHousings<'_, R> {
    type Output = R;
    #[inline(always)]
    fn run(self) -> R {
        let PushHousings {
            machines,
            rotor,
            state,
            rate,
        } = self;
        let mut moment = R::zero();
        for (k, stand) in machines.stands.iter().enumerate() {
            let (Some(stand), part) = (stand, &machines.bearings[k]) else {
                continue;
            };
            let (at, ground) = (&machines.layout.bearings[k], machines.ground(k, rotor));
            let mount = part.mount(at, &at.motion(state), ground, state, rate);
            let force = (part.mount.weight() - mount.force) * part.planes;
            let [_, _, force_x, force_y] = blocks(rate, machines.layout.rotor.coordinates);
            stand.push(force, [force_x, force_y]);
            moment += ground[0].cross(force);
        }
        moment
    }
}

/// The right-hand side as a task of its own: it is long, and stands once in the compiled code of all methods.
pub(super) struct Rates<'a, R: Real> {
    pub machines: &'a Machines<R>,
    pub mode: &'a Mode<R>,
    pub time: R,
    pub state: &'a [R],
    pub rate: &'a mut [R],
    pub probe: &'a mut [R],
}

impl<R: Real> Vectorized for Rates<'_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        let Rates {
            machines,
            mode,
            time,
            state,
            rate,
            probe,
        } = self;
        machines.rate_of_change(mode, time, state, rate, probe);
    }
}

impl<R: Real> Machines<R> {
    /// What the rotor does at a bearing.
    #[inline(always)]
    fn at_node(
        &self,
        k: usize,
        state: &[R],
        rotor: &RotorMotion<R>,
        acting: Option<&Acting<R>>,
    ) -> AtNode<R> {
        let centre = self.nodes[k].centre(rotor);
        let inner = self.layout.bearings[k].motion(state).inner;
        let contact = match acting {
            Some(acting) => acting.contact,
            None => (self.bearings[k].contact).react(&centre, rotor.spin, &inner),
        };
        AtNode { contact, centre }
    }

    /// Position and speed of what the mount of a bearing stands on.
    #[inline(always)]
    pub(super) fn ground(&self, k: usize, rotor: &RotorMotion<R>) -> [Vec2<R>; 2] {
        match &self.stands[k] {
            None => [Vec2::zero(); 2],
            Some(housing) => {
                let centre = housing.centre(rotor);
                [centre.position, centre.velocity]
            }
        }
    }

    /// The rate of change of the state, and the probes where asked.
    #[inline(always)]
    pub(super) fn rate_of_change(
        &self,
        mode: &Mode<R>,
        time: R,
        state: &[R],
        rate: &mut [R],
        probe: &mut [R],
    ) {
        let dimension = self.layout.dimension();
        let (state, rate) = (&state[..dimension], &mut rate[..dimension]);
        let layout = &self.layout;
        let zero = R::zero();

        // what acts on the rotor
        let count = layout.rotor.coordinates;
        let rotor = layout.rotor.motion(state);
        // a rig has one bearing
        let first = (&self.bearings[0], &layout.bearings[0]);
        let acting = first.0.fixture.as_ref().map(|fixture| {
            let spins = [rotor.spin, state[first.1.inner.spin()]];
            fixture.act(mode, time, spins, &first.0.contact)
        });
        let acting = acting.as_ref();
        let pulls = self.magnets.as_ref().map(|magnets| {
            let states = layout.magnets.clone();
            magnets.pull(time, &rotor, &state[states.clone()], &mut rate[states])
        });
        let [x, y, force_x, force_y] = blocks(rate, count);
        let shaft = self
            .rotor
            .react(&rotor, [&mut *force_x, &mut *force_y], [x, y]);
        let mut moment = zero;
        let (mut levitation, mut held_at) = ((zero, zero), zero);
        if let (Some((node, law)), true) = (&self.levitation, mode.levitation.greater(zero).any()) {
            let centre = node.centre(&rotor);
            let force = law.force(centre.position, centre.velocity) * mode.levitation;
            node.push(force, [&mut *force_x, &mut *force_y]);
            moment = centre.arm.cross(force);
            held_at = centre.position.cross(force);
            levitation = (force.dot(centre.velocity), held_at);
        }
        let mut kept: [Option<AtNode<R>>; KEPT] = [None; KEPT];
        for (k, node) in self.nodes.iter().enumerate() {
            if self.bearings[k].spatial.is_some() {
                continue;
            }
            let there = self.at_node(k, state, &rotor, acting);
            let (on_journal, planes) = (&there.contact.on_journal, self.bearings[k].planes);
            node.push(on_journal.force * planes, [&mut *force_x, &mut *force_y]);
            moment += on_journal.moment * planes;
            if k < KEPT {
                kept[k] = Some(there);
            }
        }
        let (mut magnets, mut pulled) = (zero, zero);
        if let (Some(own), Some(pulls)) = (&self.magnets, &pulls) {
            own.push(pulls, [&mut *force_x, &mut *force_y]);
            for Pull { centre, force } in pulls {
                moment += centre.arm.cross(*force);
                magnets += force.dot(centre.velocity);
                pulled += centre.position.cross(*force);
            }
        }
        let (mut sealing, mut seal_heat) = (zero, zero);
        for (node, seal) in &self.seals {
            let centre = node.centre(&rotor);
            let reaction = seal.react(centre.position, centre.velocity, rotor.spin);
            node.push(reaction.force, [&mut *force_x, &mut *force_y]);
            moment += centre.arm.cross(reaction.force);
            sealing += reaction.work;
            seal_heat += reaction.heat;
            pulled += centre.position.cross(reaction.force);
        }
        let (mut pushing, mut turning, mut thrust) = (zero, zero, zero);
        // by their number: a chain with the list of loads would copy it in every call, whether there are any or not
        let forces = self.forces.len();
        for k in 0..forces + self.loaded.len() {
            let (node, own) = match self.forces.get(k) {
                Some(own) => {
                    let (force, torque) = own.at(time);
                    turning += torque;
                    thrust += force.z;
                    (&own.node, Vec2::new(force.x, force.y))
                }
                None => (&self.loaded[k - forces], mode.loads[k - forces]),
            };
            let centre = node.centre(&rotor);
            node.push(own, [&mut *force_x, &mut *force_y]);
            moment += centre.arm.cross(own);
            pushing += own.dot(centre.velocity);
            pulled += centre.position.cross(own);
        }
        let mut shaken = None;
        if let Some(base) = &self.base {
            shaken = Some(base.added(&mode.base, time));
        }
        let mut in_space = SpatialActs::none();
        if let Some(space) = &self.space {
            in_space = self.act_in_space(
                space,
                (mode, thrust, shaken),
                &rotor,
                state,
                (&mut *rate, &mut *probe),
            );
            moment += in_space.moment;
            pushing += in_space.thrust;
        }
        if self.housed {
            pulled += R::vectorized(PushHousings {
                machines: self,
                rotor: &rotor,
                state,
                rate,
            });
        }
        let braking = mode.brake.greater(zero);
        let brake = if braking.any() {
            let moment = self.rotor.brake_moment(rotor.spin) * mode.brake;
            R::select(braking, moment, zero)
        } else {
            zero
        };
        let from_outside = match acting {
            None => {
                let tables = self.rotor.torque_by_tables(time, rotor.spin);
                brake + mode.driving + tables + turning
            }
            Some(acting) => acting.motor - acting.belt,
        };

        // rotor: an accelerated base adds to gravity
        let gravity = shaken.map_or(self.gravity, |by| self.gravity + by);
        let [x, y, acceleration_x, acceleration_y] = blocks(rate, count);
        let (spin_rate, torques) = self.rotor.accelerate(
            &rotor,
            gravity,
            (moment, from_outside),
            &shaft,
            [acceleration_x, acceleration_y],
            [x, y],
        );
        rate[layout.rotor.angle()] = rotor.spin;
        rate[layout.rotor.spin()] = spin_rate;
        let of_rotor = &layout.of_rotor;
        for (heat, value) in [
            (of_rotor.damping, shaft.heats[0]),
            (of_rotor.damping_rotating, shaft.heats[1]),
            (of_rotor.drag, torques.drag * rotor.spin),
            (of_rotor.seal_damping, seal_heat),
        ] {
            if let Some(heat) = heat {
                rate[layout.heat(heat)] = value;
            }
        }
        rate[layout.source(0)] = levitation.0 + in_space.magnet;
        rate[layout.source(1)] = torques.driving * rotor.spin;
        const { assert!(ROTOR_SOURCES.len() == 2) };
        if let Some(source) = of_rotor.magnets {
            rate[layout.source(source)] = magnets;
        }
        if let Some(source) = of_rotor.seals {
            rate[layout.source(source)] = sealing;
        }
        if let Some(source) = of_rotor.forces {
            rate[layout.source(source)] = pushing;
        }

        let mut shaking = in_space.base;
        if let Some(by) = shaken {
            shaking += by.dot(self.rotor.momentum(&rotor));
        }

        // auxiliary bearings: what they say of angular momentum is about their datum
        let mut impulse = self.rotor.weight_moment(&rotor, gravity);
        for (k, (part, at)) in self.bearings.iter().zip(&layout.bearings).enumerate() {
            if part.spatial.is_some() {
                continue;
            }
            let motion = at.motion(state);
            let held_load = acting.map_or(zero, |acting| acting.held_load);
            let reaction = part.bearing(at, (&motion, held_load), state, rate, probe);
            let mount = match acting {
                None => part.mount(at, &motion, self.ground(k, &rotor), state, rate),
                Some(acting) => MountReaction::of(acting.on_outer),
            };
            let there = match kept.get(k) {
                Some(Some(there)) => *there,
                _ => self.at_node(k, state, &rotor, acting),
            };
            let node = &self.nodes[k];
            let acceleration = if probe.is_empty() {
                Vec2::zero()
            } else {
                let [_, _, x, y] = blocks(rate, count);
                node.acceleration(&there.centre, rotor.spin, [x, y], spin_rate)
            };
            let external = part.accelerate(
                at,
                (&there, acceleration, acting),
                gravity,
                &motion,
                (&reaction, &mount),
                Outlet {
                    heat: layout.heat(at.heat),
                    source: layout.source(at.source),
                    state,
                    rate: &mut *rate,
                    probe: &mut *probe,
                },
            );
            if let Some(by) = shaken {
                let (power, moment) = part.shake(at, &motion, by, state, rate);
                shaking += power * part.planes;
                impulse += moment * part.planes;
            }
            for moment in external.weights {
                impulse += moment * part.planes;
            }
            if k == 0 {
                impulse += held_at;
                impulse += torques.driving;
            }
            for moment in external.others {
                impulse += moment * part.planes;
            }
            impulse += node.datum.cross(there.contact.on_journal.force) * part.planes;
        }
        if let Some(source) = of_rotor.base {
            rate[layout.source(source)] = shaking;
        }
        rate[layout.angular_impulse()] = impulse + (pulled + shaft.external - torques.drag);
        if self.space.is_some() {
            // what stands beside the first bearing in the plane
            let beside = match self.bearings[0].spatial {
                Some(_) => held_at + torques.driving,
                None => zero,
            };
            rate[layout.angular_impulse()] += in_space.external + beside;
        }
    }
}
