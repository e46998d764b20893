//! The equations of motion of a rig.
//!
//! ```text
//!   S = free - support          free: moment of the bearing on the shaft but for -(J + j) Ω̇
//!   open, slipping   (I_s + J + j) Ω̇ = T + S,  I_f ω̇_f = motor - belt - T,  T = 0, ± T_c(t)
//!   locked           (I_f + I_s + J + j) Ω̇ = motor - belt + S,  T = (I_s + J + j) Ω̇ - S
//!
//!   m c̈_o = W + bearing + m' g       or held        m with, m' only what moves with the outer race besides the housing
//!   ÿ = ω_n² (t_O + d - y) - 2ζω_n ẏ
//!   C Ṫ = P - G T,  Ṫ_m = (T - T_m)/τ                P: heats of the bearing
//! ```
//! Heats are ≥ 0: T (ω_f - Ω), drags times speeds, those of the bearing. Sources: the motor, the weight, the growth of the
//! inner race. What balls and cage receive: t_I - t_O - t_g + weights + c_o × F_o, F_o of the outer race on them; the inner
//! race stands at the origin and adds none.

use super::layout::{
    ACCELERATION, ARM, BEARING_HEAT, BEARING_LOAD, BELT_DRAG, BELT_HEAT, CAGE_SLIP, CAGE_SPEED,
    CLUTCH_CAPACITY, CLUTCH_HEAT, CLUTCH_SLIP, CLUTCH_TORQUE, DETAIL, DISTURBANCE, FLYWHEEL,
    FLYWHEEL_ACCELERATION, HEATS, HOUSING, INNER_LOAD_SUM, INNER_MOMENT, LAND_FORCE,
    LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE, MOMENTUM_RATE, MOTOR_TORQUE,
    OUTER_MOMENT, SHAFT, STEADY_MOMENT, SUPPORT_DRAG, SUPPORT_HEAT, TEMPERATURE, THERMOCOUPLE,
};
use super::{Clutch, Mode, RigMachine};
use crate::bearing::{self, POCKET_FRICTION};
use crate::motion::{Body, Motion};
use number::Vec2;

/// Motion of both races in a state: the inner one turns about the origin, the outer one moves without turning.
#[inline(always)]
pub fn race_motion(state: &[f64]) -> Motion<f64> {
    Motion {
        inner: Body::planar(Vec2::zero(), Vec2::zero(), state[SHAFT], state[SHAFT + 1]),
        outer: Body::planar(
            Vec2::new(state[HOUSING], state[HOUSING + 1]),
            Vec2::new(state[HOUSING + 2], state[HOUSING + 3]),
            0.0,
            0.0,
        ),
    }
}

impl RigMachine {
    /// The rate of change of the state, and the probes where asked.
    #[inline(always)]
    pub(super) fn rate_of_change(
        &self,
        mode: &Mode,
        time: f64,
        state: &[f64],
        rate: &mut [f64],
        probe: &mut [f64],
    ) {
        let c = &self.constants;
        let layout = &self.layout;
        let (state, rate) = (
            &state[..layout.dimension()],
            &mut rate[..layout.dimension()],
        );

        // motions
        let races = race_motion(state);
        let (speed, flywheel_speed) = (state[SHAFT + 1], state[FLYWHEEL + 1]);

        // parts react
        let housing = &c.housing;
        let held_load = if housing.centre_held {
            housing.load
        } else {
            0.0
        };
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
        let motor = match &mode.motor {
            None => 0.0,
            Some(set) => {
                let wanted = c.motor.gain * (set.at(time) - flywheel_speed);
                wanted.clamp(-c.motor.torque_limit, c.motor.torque_limit)
            }
        };
        let belt = c.flywheel.belt_drag.moment(flywheel_speed);
        let support = c.shaft.support_drag.moment(speed);
        let capacity = mode.capacity.at(time);

        // spins of shaft and flywheel
        let free = reaction.on_inner.moment;
        let on_shaft = free - support;
        let on_flywheel = motor - belt;
        let (bearing, acceleration, flywheel_acceleration, torque) = match mode.clutch {
            Clutch::Open | Clutch::Slipping { .. } => {
                let torque = match mode.clutch {
                    Clutch::Slipping { direction } => direction * capacity,
                    _ => 0.0,
                };
                let moment = torque + on_shaft;
                let bearing = reaction.with_loss(speed, moment);
                let acceleration = moment / (c.shaft.inertia + bearing.inner_inertia);
                let of_flywheel = (on_flywheel - torque) / c.flywheel.inertia;
                (bearing, acceleration, of_flywheel, torque)
            }
            Clutch::Locked => {
                let moment = on_flywheel + on_shaft;
                let bearing = reaction.with_loss(speed, moment);
                let shaft = c.shaft.inertia + bearing.inner_inertia;
                let acceleration = moment / (c.flywheel.inertia + shaft);
                let torque = shaft * acceleration - on_shaft;
                (bearing, acceleration, acceleration, torque)
            }
        };
        let inner_moment = bearing.inner_inertia * acceleration - free;
        let outer_moment = bearing.on_outer.moment - bearing.outer_inertia * acceleration;
        rate[SHAFT] = speed;
        rate[SHAFT + 1] = acceleration;
        rate[FLYWHEEL] = flywheel_speed;
        rate[FLYWHEEL + 1] = flywheel_acceleration;

        // centre of the housing
        let outer = &races.outer;
        let weight = self.weight;
        let centre_acceleration = if housing.centre_held {
            Vec2::zero()
        } else {
            (weight + bearing.on_outer.force) * (1.0 / self.moving_mass)
        };
        rate[HOUSING] = outer.velocity.x;
        rate[HOUSING + 1] = outer.velocity.y;
        rate[HOUSING + 2] = centre_acceleration.x;
        rate[HOUSING + 3] = centre_acceleration.y;

        // arm
        let arm = &c.arm;
        let disturbance = arm.disturbance.moment(state[SHAFT], speed);
        let off = outer_moment + disturbance - state[ARM];
        let frequency = arm.natural_frequency;
        rate[ARM] = state[ARM + 1];
        rate[ARM + 1] = frequency * (frequency * off - 2.0 * arm.damping_ratio * state[ARM + 1]);

        // ledger
        let of_bearing = bearing.heat.kinds();
        let mut heats = [0.0; HEATS.len()];
        heats[..of_bearing.len()].copy_from_slice(&of_bearing);
        heats[POCKET_FRICTION] += bearing.loss_heat(speed, acceleration);
        let bearing_heat: f64 = heats[..bearing::HEATS.len()].iter().sum();
        heats[CLUTCH_HEAT] = match mode.clutch {
            Clutch::Slipping { .. } => torque * (flywheel_speed - speed),
            Clutch::Open | Clutch::Locked => 0.0,
        };
        heats[BELT_HEAT] = belt * flywheel_speed;
        heats[SUPPORT_HEAT] = support * speed;
        rate[layout.heat(0)..layout.source(0)].copy_from_slice(&heats);
        let growth = bearing.growth_impulse * acceleration;
        rate[layout.source(0)] = motor * flywheel_speed;
        rate[layout.source(1)] = weight.dot(outer.velocity);
        rate[layout.source(2)] = growth;
        let holding = if housing.centre_held {
            Vec2::zero()
        } else {
            weight
        };
        rate[layout.angular_impulse()] = motor - belt - support - outer_moment
            + outer.position.cross(holding)
            + bearing.external_moment;
        // of the outer race on the balls
        let force = -bearing.on_outer.force;
        let eccentric = bearing.external_moment + outer.position.cross(force);
        rate[layout.bearing_impulse()] = inner_moment - outer_moment + eccentric;
        let momentum = (self.bearing).angular_momentum_rate(
            &state[own.clone()],
            &rate[own.clone()],
            acceleration,
        );
        rate[layout.work(0)] = inner_moment * speed;
        rate[layout.work(1)] = outer_moment * speed;
        rate[layout.work(2)] = momentum * speed;
        rate[layout.work(3)] = force.dot(outer.velocity) - eccentric * speed + growth;

        // heat
        let heat = &c.heat;
        rate[TEMPERATURE] = (bearing_heat - heat.conductance * state[TEMPERATURE]) / heat.capacity;
        rate[THERMOCOUPLE] = (state[TEMPERATURE] - state[THERMOCOUPLE]) / heat.thermocouple_lag;

        if !probe.is_empty() {
            let cage_speed = rate[own.start];
            let rolling = speed * self.rolling_cage_ratio;
            probe[INNER_MOMENT] = inner_moment;
            probe[OUTER_MOMENT] = outer_moment;
            probe[STEADY_MOMENT] = bearing.steady_moment;
            probe[CAGE_SLIP] = if rolling == 0.0 {
                0.0
            } else {
                1.0 - cage_speed / rolling
            };
            probe[ACCELERATION] = acceleration;
            probe[FLYWHEEL_ACCELERATION] = flywheel_acceleration;
            probe[CLUTCH_TORQUE] = torque;
            probe[CLUTCH_CAPACITY] = capacity;
            probe[CLUTCH_SLIP] = flywheel_speed - speed;
            probe[MOTOR_TORQUE] = motor;
            probe[BELT_DRAG] = belt;
            probe[SUPPORT_DRAG] = support;
            probe[DISTURBANCE] = disturbance;
            probe[CAGE_SPEED] = cage_speed;
            probe[BEARING_LOAD] = force.length_squared().sqrt();
            probe[BEARING_HEAT] = bearing_heat;
            probe[MOMENTUM_RATE] = momentum;
            probe[INNER_LOAD_SUM] = probe[DETAIL..DETAIL + layout.balls].iter().sum();
            probe[LARGEST_INNER_LOAD] = bearing.largest_inner_load;
            probe[LARGEST_OUTER_LOAD] = bearing.largest_outer_load;
            probe[LARGEST_POCKET_FORCE] = bearing.largest_pocket_force;
            probe[LAND_FORCE] = bearing.land_force;
        }
    }
}
