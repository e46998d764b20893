//! The equations of motion of a rig.
//!
//! ```text
//!   S = free - support          free: moment of the bearing on the shaft but for -(J + j) Ω̇
//!   open, slipping   (I_s + J + j) Ω̇ = T + S,  I_f ω̇_f = motor - belt - T,  T = 0, ± T_c(t)
//!   locked           (I_f + I_s + J + j) Ω̇ = motor - belt + S,  T = (I_s + J + j) Ω̇ - S
//!
//!   m c̈_o = W + bearing + m' g       or held        m with, m' only what moves with the outer race besides the housing
//!   ÿ = ω_n² (t_O + d - y) - 2ζω_n ẏ
//!   C Ṫ = P - C_f Θ̇ - G T,  Ṫ_m = (T - T_m)/τ        P: heats of the bearing; films that warm keep C_f Θ̇ of them
//! ```
//! Heats are ≥ 0: T (ω_f - Ω), drags times speeds, those of the bearing. Sources: the motor, the weight, the growth of the
//! inner race. What balls and cage receive: t_I - t_O - t_g + weights + c_o × F_o, F_o of the outer race on them; the inner
//! race stands at the origin and adds none.

use super::layout::{
    ACCELERATION, ARM, ARM_RATE, BEARING_HEAT, BEARING_LOAD, BELT_DRAG, BELT_HEAT, CAGE_SLIP,
    CAGE_SPEED, CLUTCH_CAPACITY, CLUTCH_HEAT, CLUTCH_SLIP, CLUTCH_TORQUE, DETAIL, DISTURBANCE,
    FLYWHEEL, FLYWHEEL_ACCELERATION, HEATS, HOUSING, INNER_LOAD_SUM, INNER_MOMENT, LAND_FORCE,
    LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE, LARGEST_SKIDS, MOMENTUM_RATE,
    MOTOR_TORQUE, OUTER_MOMENT, SHAFT, STEADY_MOMENT, SUPPORT_DRAG, SUPPORT_HEAT, TEMPERATURE,
    THERMOCOUPLE, bearing_impulse,
};
use super::{Clutch, Mode, RigMachine};
use crate::bearing::{self, Bearing, POCKET_FRICTION};
use crate::motion::Motion;
use number::{Real, Vec2};

/// Motion of both races in a state: the inner one turns about the origin, the outer one moves without turning.
#[inline(always)]
pub fn race_motion<R: Real>(state: &[R]) -> Motion<R> {
    Motion {
        inner: SHAFT.motion(state),
        outer: HOUSING.motion(state),
    }
}

impl RigMachine {
    /// The rate of change of the state, and the probes where asked.
    ///
    /// `R` is one machine whose balls are computed several at a time: only the bearing sees it, the rig is plain.
    #[inline(always)]
    pub(super) fn rate_of_change<R: Real>(
        &self,
        of_bearing: &Bearing<R>,
        mode: &Mode,
        time: f64,
        state: &[R],
        rate: &mut [R],
        probe: &mut [R],
    ) {
        let plain = |value: R| value.lane(0);
        let vector = |v: Vec2<R>| Vec2::new(v.x.lane(0), v.y.lane(0));
        let c = &self.constants;
        let layout = &self.layout;
        let (state, rate) = (
            &state[..layout.dimension()],
            &mut rate[..layout.dimension()],
        );

        // motions
        let races = race_motion(state);
        let at = |channel: usize| plain(state[channel]);
        let (speed, flywheel_speed) = (at(SHAFT.spin()), at(FLYWHEEL.spin()));

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
        let reaction = of_bearing.react_under(
            &races,
            R::splat(held_load),
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
        let free = plain(reaction.on_inner.moment);
        let with_loss = |moment: f64| reaction.with_loss(R::splat(speed), R::splat(moment));
        let on_shaft = free - support;
        let on_flywheel = motor - belt;
        let (bearing, acceleration, flywheel_acceleration, torque) = match mode.clutch {
            Clutch::Open | Clutch::Slipping { .. } => {
                let torque = match mode.clutch {
                    Clutch::Slipping { direction } => direction * capacity,
                    _ => 0.0,
                };
                let moment = torque + on_shaft;
                let bearing = with_loss(moment);
                let acceleration = moment / (c.shaft.inertia + plain(bearing.inner_inertia));
                let of_flywheel = (on_flywheel - torque) / c.flywheel.inertia;
                (bearing, acceleration, of_flywheel, torque)
            }
            Clutch::Locked => {
                let moment = on_flywheel + on_shaft;
                let bearing = with_loss(moment);
                let shaft = c.shaft.inertia + plain(bearing.inner_inertia);
                let acceleration = moment / (c.flywheel.inertia + shaft);
                let torque = shaft * acceleration - on_shaft;
                (bearing, acceleration, acceleration, torque)
            }
        };
        let inner_moment = plain(bearing.inner_inertia) * acceleration - free;
        let outer_moment =
            plain(bearing.on_outer.moment) - plain(bearing.outer_inertia) * acceleration;
        let mut put = |channel: usize, value: f64| rate[channel] = R::splat(value);
        put(SHAFT.angle(), speed);
        put(SHAFT.spin(), acceleration);
        put(FLYWHEEL.angle(), flywheel_speed);
        put(FLYWHEEL.spin(), flywheel_acceleration);

        // centre of the housing
        let (centre, velocity) = (vector(races.outer.position), vector(races.outer.velocity));
        let on_outer = vector(bearing.on_outer.force);
        let weight = self.weight;
        let centre_acceleration = if housing.centre_held {
            Vec2::zero()
        } else {
            (weight + on_outer) * (1.0 / self.moving_mass)
        };
        for (at, vector) in [
            (HOUSING.centre(), velocity),
            (HOUSING.velocity(), centre_acceleration),
        ] {
            put(at[0], vector.x);
            put(at[1], vector.y);
        }

        // arm
        let arm = &c.arm;
        let disturbance = arm.disturbance.moment(at(SHAFT.angle()), speed);
        let off = outer_moment + disturbance - at(ARM);
        let frequency = arm.natural_frequency;
        put(ARM, at(ARM_RATE));
        put(
            ARM_RATE,
            frequency * (frequency * off - 2.0 * arm.damping_ratio * at(ARM_RATE)),
        );

        // ledger
        let mut heats = [0.0; HEATS];
        for (heat, kind) in heats.iter_mut().zip(bearing.heat.kinds()) {
            *heat = plain(kind);
        }
        let loss = bearing.loss_heat(R::splat(speed), R::splat(acceleration));
        heats[POCKET_FRICTION] += plain(loss);
        let bearing_heat: f64 = heats[..bearing::HEATS.len()].iter().sum();
        heats[CLUTCH_HEAT] = match mode.clutch {
            Clutch::Slipping { .. } => torque * (flywheel_speed - speed),
            Clutch::Open | Clutch::Locked => 0.0,
        };
        heats[BELT_HEAT] = belt * flywheel_speed;
        heats[SUPPORT_HEAT] = support * speed;
        for (kind, heat) in heats.into_iter().enumerate() {
            put(layout.heat(kind), heat);
        }
        let growth = plain(bearing.growth_impulse) * acceleration;
        let external = plain(bearing.external_moment);
        put(layout.source(0), motor * flywheel_speed);
        put(layout.source(1), weight.dot(velocity));
        put(layout.source(2), growth);
        let holding = if housing.centre_held {
            Vec2::zero()
        } else {
            weight
        };
        put(
            layout.angular_impulse(),
            motor - belt - support - outer_moment + centre.cross(holding) + external,
        );
        // of the outer race on the balls
        let force = -on_outer;
        let eccentric = external + centre.cross(force);
        put(
            bearing_impulse(layout),
            inner_moment - outer_moment + eccentric,
        );
        let kept = plain(c.bearing.kept_by_films(&rate[own.clone()]));
        let momentum = plain(of_bearing.angular_momentum_rate(
            &state[own.clone()],
            &rate[own.clone()],
            R::splat(acceleration),
        ));
        let mut put = |channel: usize, value: f64| rate[channel] = R::splat(value);
        put(layout.work(0), inner_moment * speed);
        put(layout.work(1), outer_moment * speed);
        put(layout.work(2), momentum * speed);
        put(
            layout.work(3),
            force.dot(velocity) - eccentric * speed + growth,
        );

        // heat
        let heat = &c.heat;
        put(
            TEMPERATURE,
            (bearing_heat - kept - heat.conductance * at(TEMPERATURE)) / heat.capacity,
        );
        put(
            THERMOCOUPLE,
            (at(TEMPERATURE) - at(THERMOCOUPLE)) / heat.thermocouple_lag,
        );

        if !probe.is_empty() {
            let cage_speed = plain(rate[own.start]);
            let rolling = speed * self.rolling_cage_ratio;
            let loads = &probe[DETAIL..DETAIL + layout.balls];
            let load_sum = loads.iter().map(|load| plain(*load)).sum();
            let mut show = |index: usize, value: f64| probe[index] = R::splat(value);
            show(INNER_MOMENT, inner_moment);
            show(OUTER_MOMENT, outer_moment);
            show(STEADY_MOMENT, plain(bearing.steady_moment));
            show(
                CAGE_SLIP,
                if rolling == 0.0 {
                    0.0
                } else {
                    1.0 - cage_speed / rolling
                },
            );
            show(ACCELERATION, acceleration);
            show(FLYWHEEL_ACCELERATION, flywheel_acceleration);
            show(CLUTCH_TORQUE, torque);
            show(CLUTCH_CAPACITY, capacity);
            show(CLUTCH_SLIP, flywheel_speed - speed);
            show(MOTOR_TORQUE, motor);
            show(BELT_DRAG, belt);
            show(SUPPORT_DRAG, support);
            show(DISTURBANCE, disturbance);
            show(CAGE_SPEED, cage_speed);
            show(BEARING_LOAD, force.length_squared().sqrt());
            show(BEARING_HEAT, bearing_heat);
            show(MOMENTUM_RATE, momentum);
            show(INNER_LOAD_SUM, load_sum);
            show(LARGEST_INNER_LOAD, plain(bearing.largest_inner_load));
            show(LARGEST_OUTER_LOAD, plain(bearing.largest_outer_load));
            show(LARGEST_POCKET_FORCE, plain(bearing.largest_pocket_force));
            show(LAND_FORCE, plain(bearing.land_force));
            show(LARGEST_SKIDS, plain(bearing.largest_skids[0]));
            show(LARGEST_SKIDS + 1, plain(bearing.largest_skids[1]));
        }
    }
}
