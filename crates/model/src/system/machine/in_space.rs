//! A machine with bearings in space: its rotor moves along its axis, and each of these bearings acts as a whole.

use super::{MachineConstants, Machines, Mode};
use crate::auxiliary_bearing::Outlet;
use crate::contact::ContactReaction;
use crate::rotor::in_space::AxialConstants;
use crate::rotor::{RotorMotion, SpatialNode};
use crate::spatial::rigid_body::RigidBody;
use number::{Gather, Real, Vec2, Vectorized};

/// The rotor along its axis, and its nodes in bearings in space.
#[derive(Clone, Debug)]
pub(super) struct InSpace<R> {
    pub axial: AxialConstants<R>,
    mass: R,
    inverse_mass: R,
    /// None in a bearing of the plane.
    nodes: Vec<Option<SpatialNode<R>>>,
}

/// What bearings in space and the axial magnet do to the machine besides forces on its coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpatialActs<R> {
    /// Moment about the axis through the mass centre on the rotor, N m.
    pub moment: R,
    /// Moment from outside about the axis of the machine, N m.
    pub external: R,
    /// Power of the axial magnet, W.
    pub magnet: R,
    /// Power of the thrust from outside, W.
    pub thrust: R,
    /// Power of a base that moves, W.
    pub base: R,
}

impl<R: Real> SpatialActs<R> {
    #[inline(always)]
    pub fn none() -> Self {
        let zero = R::zero();
        SpatialActs {
            moment: zero,
            external: zero,
            magnet: zero,
            thrust: zero,
            base: zero,
        }
    }
}

impl<R: Real> InSpace<R> {
    pub fn gather<'a>(machine: &dyn Fn(usize) -> &'a MachineConstants) -> Option<Self> {
        machine(0).axial.as_ref()?;
        let axial = |lane: usize| {
            let own = machine(lane).axial.as_ref();
            own.expect("lanes share the freedoms of their rotors")
        };
        let node = |k: usize| {
            machine(0).bearings[k].spatial()?;
            Some(SpatialNode::gather(&|lane| {
                let part = &machine(lane).bearings[k];
                let own = part.spatial().expect("lanes share the fidelity");
                let rows = [&part.node[..], &own.rotation[..]];
                (&machine(lane).rotor, rows, part.datum, own.lever)
            }))
        };
        Some(InSpace {
            axial: Gather::gather(&axial),
            mass: R::from_lanes(|lane| machine(lane).rotor.mass()),
            inverse_mass: R::from_lanes(|lane| 1.0 / machine(lane).rotor.mass()),
            nodes: (0..machine(0).bearings.len()).map(node).collect(),
        })
    }
}

impl<R: Real> Machines<R> {
    /// Place and speed of the rotor along its axis.
    #[inline(always)]
    fn along(&self, state: &[R]) -> [R; 2] {
        let place = self.layout.rotor.place();
        [state[place], state[place + 1]]
    }
    /// What all bearings in space do, with their rates, and the rates of the rotor along its axis under a thrust from outside, N, on a base
    /// that adds to gravity, m/s².
    #[inline(always)]
    pub(super) fn act_in_space(
        &self,
        space: &InSpace<R>,
        (mode, thrust, shaken): (&Mode<R>, R, Option<Vec2<R>>),
        rotor: &RotorMotion<R>,
        state: &[R],
        (rate, probe): (&mut [R], &mut [R]),
    ) -> SpatialActs<R> {
        R::vectorized(Act {
            machines: self,
            space,
            holds: mode.thrust,
            thrust,
            shaken,
            rotor,
            state,
            rate,
            probe,
        })
    }
    /// The contact of the rotor with the bore of a bearing in space; none in one of the plane. The state goes to the inner ring's end.
    pub(super) fn contact_in_space(&self, k: usize, state: &[R]) -> Option<ContactReaction<R>> {
        let own = self.bearings[k].spatial.as_ref()?;
        let node = self.space.as_ref()?.nodes[k].as_ref()?;
        let centre = node.motion(&self.layout.rotor.motion(state), self.along(state));
        let ring = self.layout.bearings[k].inner.channels();
        Some(own.contact(&centre.body, &state[ring]))
    }
}

/// The task of [`Machines::act_in_space`].
struct Act<'a, R: Real> {
    machines: &'a Machines<R>,
    space: &'a InSpace<R>,
    /// Share of its force with which the axial magnet holds.
    holds: R,
    thrust: R,
    shaken: Option<Vec2<R>>,
    rotor: &'a RotorMotion<'a, R>,
    state: &'a [R],
    rate: &'a mut [R],
    probe: &'a mut [R],
}

impl<R: Real> Vectorized for Act<'_, R> {
    type Output = SpatialActs<R>;
    #[inline(always)]
    fn run(self) -> SpatialActs<R> {
        let Act {
            machines,
            space,
            holds,
            thrust,
            shaken,
            rotor,
            state,
            rate,
            probe,
        } = self;
        let layout = &machines.layout;
        let count = layout.rotor.coordinates;
        let [place, speed] = machines.along(state);
        let mut acts = SpatialActs::none();
        let axial = &space.axial;
        let held = (axial.carried - axial.stiffness * place - axial.damping * speed) * holds;
        acts.magnet = held * speed;
        acts.thrust = thrust * speed;
        let mut along = held + thrust;
        for (k, node) in space.nodes.iter().enumerate() {
            let (Some(node), part, at) = (node, &machines.bearings[k], &layout.bearings[k]) else {
                continue;
            };
            let Some(own) = &part.spatial else { continue };
            let centre = node.motion(rotor, [place, speed]);
            let motion = at.motion(state);
            let mount = part.mount(at, &motion, [Vec2::zero(); 2], state, rate);
            let into = Outlet {
                heat: layout.heat(at.heat),
                source: layout.source(at.source),
                state,
                rate: &mut *rate,
                probe: &mut *probe,
            };
            let reaction = own.react(at, &centre.body, (mount.force, mount.heat()), into);
            if let Some(by) = shaken {
                let masses = own.shake(at, by, state, rate);
                let (state, rate) = (&state[at.of_mount()], &mut rate[at.of_mount()]);
                let housing = part.mount.shake(by, state, rate);
                acts.base += by.dot(masses.momentum + housing) * part.planes;
                acts.external += masses.moment.cross(by) * part.planes;
            }
            let mut on_rotor = reaction.on_rotor;
            on_rotor.force = on_rotor.force * part.planes;
            on_rotor.moment = on_rotor.moment * part.planes;
            let [_, _, x, y] = super::rate::blocks(rate, count);
            acts.moment += node.push(&centre, &on_rotor, [x, y]);
            let across = Vec2::new(on_rotor.force.x, on_rotor.force.y);
            acts.external += reaction.external * part.planes + node.node.datum.cross(across);
            along += on_rotor.force.z;
        }
        rate[layout.rotor.place()] = speed;
        rate[layout.rotor.place() + 1] = along * space.inverse_mass + space.axial.gravity;
        acts
    }
}

impl Machines<f64> {
    /// Kinetic energy of the rotor along its axis, J, and its weight's there.
    pub(super) fn axial_content(&self, state: &[f64]) -> [f64; 2] {
        let Some(space) = &self.space else {
            return [0.0; 2];
        };
        let [place, speed] = self.along(state);
        let mass = space.mass;
        [
            0.5 * mass * speed * speed,
            -mass * space.axial.gravity * place,
        ]
    }
    /// The rotor at its node in a bearing in space, as a body.
    pub(super) fn node_in_space(&self, k: usize, state: &[f64]) -> Option<RigidBody<f64>> {
        let node = self.space.as_ref()?.nodes[k].as_ref()?;
        let motion = self.layout.rotor.motion(state);
        Some(node.motion(&motion, self.along(state)).body)
    }
}
