//! The equations of motion of a spin-up.
//!
//! ```text
//!   d: direction of the load, t: d turned +90°;  the rotor touches the bore at c_i + R_0 d
//!   u = R_0 (ω_r - Ω)                      slip of the sliding rotor
//!   S = μ tanh(u/u0) W                     its friction, on the race along t
//!
//!   I_I Ω̇ = R_0 S + torque - t_I           t_I = free moment + (J + j) Ω̇, solved for Ω̇; a given speed gives the torque
//!   m c̈_i = W d + S t + bearing + m g      or held
//!   I_r ω̇_r = -R_0 S                       or held: a source
//! ```
//! Heats are ≥ 0: S u, and those of the bearing. Sources: the carriage of the load (W d + S t)·ċ_i, the drives.
//!
//! Does not model: torsion of shaft and sleeve, the rotor's place in its clearance.

use super::layout::{
    ACCELERATION, APPLIED_LOAD, BEARING_LOAD, CAGE_SLIP, CAGE_SPEED, DETAIL, DRIVE_MOMENT,
    FRICTION_FORCE, HEATS, INNER, INNER_LOAD_SUM, INNER_MOMENT, LAND_FORCE, LARGEST_INNER_LOAD,
    LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE, LARGEST_SKIDS, OUTER_MOMENT, ROTOR, ROTOR_SLIP,
    STEADY_MOMENT,
};
use super::{DriveKind, Mode, SpinUp};
use crate::bearing::POCKET_FRICTION;
use crate::motion::{Body, Motion};
use number::{Real, Vec2};

/// Motion of both races in a state; the outer race stands at the origin.
#[inline(always)]
pub fn race_motion<R: Real>(state: &[R]) -> Motion<R> {
    let zero = R::zero();
    Motion {
        inner: INNER.motion(state),
        outer: Body::planar(Vec2::zero(), Vec2::zero(), zero, zero),
    }
}

/// What the sliding rotor does.
struct Sliding<R> {
    /// Friction S on the race along t, N.
    force: R,
    /// Slip u, m/s.
    slip: R,
    /// Radius of the bore R_0, m.
    arm: R,
}

impl<R: Real> SpinUp<R> {
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
        let layout = &self.layout;
        let (state, rate) = (
            &state[..layout.dimension()],
            &mut rate[..layout.dimension()],
        );
        let race = &self.race;
        let zero = R::zero();

        // motions
        let races = race_motion(state);
        let inner = &races.inner;
        let speed = inner.spin;
        let rotor_spin = state[ROTOR.spin()];

        // parts react
        let load = mode.load.at(time);
        let held_load = if race.centre_held { load } else { zero };
        let own = layout.bearing();
        let detail = if probe.is_empty() {
            &mut [][..]
        } else {
            &mut probe[DETAIL..]
        };
        let reaction = self.bearing.react_under(
            &races,
            held_load,
            &state[own.clone()],
            &mut rate[own.clone()],
            detail,
        );
        let sliding = match &self.drive {
            DriveKind::SlidingRotor(rotor) => {
                let slip = rotor.bore_radius * (rotor_spin - speed);
                let coefficient = rotor.friction * (slip * rotor.inverse_reference_speed).tanh();
                Sliding {
                    force: coefficient * load,
                    slip,
                    arm: rotor.bore_radius,
                }
            }
            DriveKind::Torque | DriveKind::Speed => Sliding {
                force: zero,
                slip: zero,
                arm: zero,
            },
        };

        // spin of the inner race
        let free = reaction.on_inner.moment;
        let (bearing, acceleration, torque) = match &self.drive {
            DriveKind::SlidingRotor(_) | DriveKind::Torque => {
                let torque = match &self.drive {
                    DriveKind::Torque => mode.drive.at(time),
                    _ => zero,
                };
                let moment = torque + sliding.arm * sliding.force + free;
                let bearing = reaction.with_loss(speed, moment);
                let inertia = race.inertia + bearing.inner_inertia;
                (bearing, moment / inertia, torque)
            }
            DriveKind::Speed => {
                let acceleration = mode.drive.slope;
                let bearing = reaction.with_loss(speed, acceleration);
                let inertia = race.inertia + bearing.inner_inertia;
                (bearing, acceleration, inertia * acceleration - free)
            }
        };
        let inner_moment = bearing.inner_inertia * acceleration - free;
        let outer_moment = bearing.on_outer.moment - bearing.outer_inertia * acceleration;

        // centre of the inner race
        let along = race.load_direction.turned();
        let pressed = race.load_direction * load + along * sliding.force;
        let centre_acceleration = if race.centre_held {
            Vec2::zero()
        } else {
            (pressed + bearing.on_inner.force) * race.mass.recip() + race.gravity
        };
        INNER.move_at(rate, inner.velocity, centre_acceleration);
        INNER.turn_at(rate, speed, acceleration);

        // rotor
        let on_rotor = -(sliding.arm * sliding.force);
        let (rotor_torque, rotor_acceleration) = match &self.drive {
            DriveKind::SlidingRotor(rotor) if !rotor.spin_held => {
                (zero, on_rotor / rotor.polar_inertia)
            }
            _ => (-on_rotor, zero),
        };
        ROTOR.turn_at(rate, rotor_spin, rotor_acceleration);

        // ledger
        let of_bearing = bearing.heat.kinds();
        let mut heats = [zero; HEATS];
        let (kinds, rest) = heats.split_at_mut(of_bearing.len());
        kinds.copy_from_slice(&of_bearing);
        kinds[POCKET_FRICTION] += bearing.loss_heat(speed, acceleration);
        rest[0] = sliding.force * sliding.slip;
        rate[layout.heat(0)..layout.source(0)].copy_from_slice(&heats);
        rate[layout.source(0)] = pressed.dot(inner.velocity);
        rate[layout.source(1)] = rotor_torque * rotor_spin;
        rate[layout.source(2)] = torque * speed;
        let growth = bearing.growth_impulse * acceleration;
        rate[layout.source(3)] = growth;
        rate[layout.angular_impulse()] = inner.position.cross(pressed + race.gravity * race.mass)
            + rotor_torque
            + torque
            + bearing.external_moment
            - outer_moment;
        // of the inner race on the balls
        let force = -bearing.on_inner.force;
        let momentum = (self.bearing).angular_momentum_rate(
            &state[own.clone()],
            &rate[own.clone()],
            acceleration,
        );
        rate[layout.work(0)] = inner_moment * speed;
        rate[layout.work(1)] = outer_moment * speed;
        rate[layout.work(2)] = momentum * speed;
        rate[layout.work(3)] = force.dot(inner.velocity)
            - (bearing.external_moment + inner.position.cross(force)) * speed
            + growth;

        if !probe.is_empty() {
            let cage_speed = rate[own.start];
            let rolling = speed * self.rolling_cage_ratio;
            let turning = rolling.abs().greater(zero);
            let safe = R::select(turning, rolling, R::one());
            probe[INNER_MOMENT] = inner_moment;
            probe[OUTER_MOMENT] = outer_moment;
            probe[STEADY_MOMENT] = bearing.steady_moment;
            probe[DRIVE_MOMENT] = torque + sliding.arm * sliding.force;
            probe[ACCELERATION] = acceleration;
            probe[APPLIED_LOAD] = load;
            probe[BEARING_LOAD] = force.length_squared().sqrt();
            probe[CAGE_SPEED] = cage_speed;
            probe[CAGE_SLIP] = R::select(turning, R::one() - cage_speed / safe, zero);
            probe[ROTOR_SLIP] = sliding.slip;
            probe[FRICTION_FORCE] = sliding.force;
            let mut sum = zero;
            for load in &probe[DETAIL..DETAIL + layout.balls] {
                sum += *load;
            }
            probe[INNER_LOAD_SUM] = sum;
            probe[LARGEST_INNER_LOAD] = bearing.largest_inner_load;
            probe[LARGEST_OUTER_LOAD] = bearing.largest_outer_load;
            probe[LARGEST_POCKET_FORCE] = bearing.largest_pocket_force;
            probe[LAND_FORCE] = bearing.land_force;
            probe[LARGEST_SKIDS..][..2].copy_from_slice(&bearing.largest_skids);
        }
    }
}
