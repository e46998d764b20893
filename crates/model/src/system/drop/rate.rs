//! The equations of motion of a drop.

use super::layout::{
    BEARING, DETAIL, FRICTION_FORCE, HEATS, INNER, LAND_FORCE, LARGEST_INNER_LOAD,
    LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE, NORMAL_FORCE, NORMAL_FORCE_RATE, OUTER, PENETRATION,
    PENETRATION_SPEED, ROTOR, SLIP_SPEED,
};
use super::{Drop, Mode};
use crate::bearing::{BearingReaction, POCKET_FRICTION};
use crate::motion::{Body, Motion};
use crate::rotor::RotorMotion;
use number::{Mask, Real, Vec2};

/// Motion of the rotor in a state.
#[inline(always)]
pub fn rotor_motion<R: Real>(state: &[R]) -> RotorMotion<R> {
    RotorMotion {
        position: Vec2::new(state[ROTOR], state[ROTOR + 1]),
        velocity: Vec2::new(state[ROTOR + 2], state[ROTOR + 3]),
        angle: state[ROTOR + 4],
        spin: state[ROTOR + 5],
    }
}

/// Motion of both races in a state; the outer race does not turn.
#[inline(always)]
pub fn race_motion<R: Real>(state: &[R]) -> Motion<R> {
    let position = |body: usize| Vec2::new(state[body], state[body + 1]);
    let velocity = |body: usize| Vec2::new(state[body + 2], state[body + 3]);
    Motion {
        inner: Body::planar(
            position(INNER),
            velocity(INNER),
            state[INNER + 4],
            state[INNER + 5],
        ),
        outer: Body::planar(position(OUTER), velocity(OUTER), R::zero(), R::zero()),
    }
}

impl<R: Real> Drop<R> {
    /// The rate of change of the state, and the probes where asked.
    #[inline(always)]
    pub(super) fn rate_of_change(
        &self,
        mode: &Mode<R>,
        state: &[R],
        rate: &mut [R],
        probe: &mut [R],
    ) {
        let layout = &self.layout;
        let (state, rate) = (
            &state[..layout.dimension()],
            &mut rate[..layout.dimension()],
        );
        let own = BEARING..layout.ledger();
        let detail = if probe.is_empty() {
            &mut [][..]
        } else {
            &mut probe[DETAIL..]
        };
        let bearing = (self.bearing).react(
            &race_motion(state),
            &state[own.clone()],
            &mut rate[own],
            detail,
        );
        self.accelerate(mode, state, &bearing, rate, probe);
    }

    /// The rates of rotor, races and ledger under a reaction of the bearing, and the probes where asked.
    #[inline(always)]
    pub(super) fn accelerate(
        &self,
        mode: &Mode<R>,
        state: &[R],
        bearing: &BearingReaction<R>,
        rate: &mut [R],
        probe: &mut [R],
    ) {
        let layout = &self.layout;
        let m = &self.machine;
        let zero = R::zero();

        // motions
        let rotor = rotor_motion(state);
        let races = race_motion(state);
        let centre = m.rotor.geometric_centre(&rotor);
        let (inner, outer) = (&races.inner, &races.outer);

        // parts react
        let contact = m.contact.react(&centre, rotor.spin, inner);
        let levitation = m.levitation.force(centre.position, centre.velocity) * mode.levitation;
        let mount = m.mount.force(outer.position, outer.velocity);
        let braking = mode.brake.greater(zero);
        let brake = if braking.any() {
            R::select(braking, m.rotor.brake_moment(rotor.spin), zero)
        } else {
            zero
        };

        // rotor
        let rotor_force = contact.on_journal.force + levitation;
        let rotor_moment = contact.on_journal.moment + centre.arm.cross(levitation);
        let (rotor_torque, rotor_spin_rate) = if m.rotor.spin_held {
            (-rotor_moment, zero)
        } else {
            (
                brake,
                (rotor_moment + brake) * self.inverse.rotor_polar_inertia,
            )
        };
        let rotor_acceleration = rotor_force * self.inverse.rotor_mass + m.gravity;
        write_body(rate, ROTOR, rotor.velocity, rotor_acceleration);
        rate[ROTOR + 4] = rotor.spin;
        rate[ROTOR + 5] = rotor_spin_rate;

        // inner race
        let inner_force =
            contact.on_bore.force + bearing.on_inner.force + m.gravity * m.inner_race_mass;
        let inner_acceleration = if m.inner_race_centre_held {
            Vec2::zero()
        } else {
            inner_force * self.inverse.inner_race_mass
        };
        let inner_moment = contact.on_bore.moment + bearing.on_inner.moment + m.inner_race_torque;
        let bearing = (*bearing).with_loss(inner.spin, inner_moment);
        let inner_spin_rate = inner_moment / (m.inner_race_inertia + bearing.inner_inertia);
        write_body(rate, INNER, inner.velocity, inner_acceleration);
        rate[INNER + 4] = inner.spin;
        rate[INNER + 5] = inner_spin_rate;

        // outer race: the ground holds its spin
        let outer_force = bearing.on_outer.force + mount + m.gravity * self.outer_moving_mass;
        let outer_acceleration = outer_force * self.inverse.outer_moving_mass;
        write_body(rate, OUTER, outer.velocity, outer_acceleration);
        let outer_moment = bearing.on_outer.moment - bearing.outer_inertia * inner_spin_rate;

        // ledger
        let of_bearing = bearing.heat.kinds();
        let mut heats = [zero; HEATS.len()];
        let (kinds, rest) = heats.split_at_mut(of_bearing.len());
        kinds.copy_from_slice(&of_bearing);
        kinds[POCKET_FRICTION] += bearing.loss_heat(inner.spin, inner_spin_rate);
        rest.copy_from_slice(&[
            m.mount.heat(outer.velocity),
            contact.damping_heat,
            contact.friction_heat,
        ]);
        rate[layout.heat(0)..layout.heat(0) + HEATS.len()].copy_from_slice(&heats);
        rate[layout.source(0)] = levitation.dot(centre.velocity);
        rate[layout.source(1)] = rotor_torque * rotor.spin;
        rate[layout.source(2)] = m.inner_race_torque * inner.spin;
        rate[layout.source(3)] = bearing.growth_impulse * inner_spin_rate;
        let weight_moment = |position: Vec2<R>, mass: R| position.cross(m.gravity) * mass;
        let inner_hold = if m.inner_race_centre_held {
            // the force that holds the centre is the opposite of everything else on the race
            -inner.position.cross(inner_force)
        } else {
            zero
        };
        rate[layout.angular_impulse()] = weight_moment(rotor.position, m.rotor.mass)
            + weight_moment(inner.position, m.inner_race_mass)
            + weight_moment(outer.position, self.outer_moving_mass)
            + centre.position.cross(levitation)
            + rotor_torque
            + m.inner_race_torque
            + inner_hold
            + outer.position.cross(mount)
            + bearing.external_moment
            - outer_moment;

        if !probe.is_empty() {
            // C = G + arm: its acceleration has the centripetal and the spin-up part of the eccentricity
            let centre_acceleration = rotor_acceleration + centre.arm.turned() * rotor_spin_rate
                - centre.arm * rotor.spin.square();
            probe[PENETRATION] = contact.penetration;
            probe[PENETRATION_SPEED] = contact.penetration_speed;
            probe[NORMAL_FORCE] = contact.normal_force;
            probe[NORMAL_FORCE_RATE] = m.contact.force_rate(
                &contact,
                &centre,
                inner,
                centre_acceleration - inner_acceleration,
            );
            probe[FRICTION_FORCE] = contact.friction_force;
            probe[SLIP_SPEED] = contact.slip_speed;
            probe[LARGEST_INNER_LOAD] = bearing.largest_inner_load;
            probe[LARGEST_OUTER_LOAD] = bearing.largest_outer_load;
            probe[LARGEST_POCKET_FORCE] = bearing.largest_pocket_force;
            probe[LAND_FORCE] = bearing.land_force;
        }
    }
}

#[inline(always)]
fn write_body<R: Real>(rate: &mut [R], body: usize, velocity: Vec2<R>, acceleration: Vec2<R>) {
    rate[body] = velocity.x;
    rate[body + 1] = velocity.y;
    rate[body + 2] = acceleration.x;
    rate[body + 3] = acceleration.y;
}
