//! The equations of motion of a rig.
//!
//! ```text
//!   d: direction of the load, t: d turned +90°;  a sliding rotor touches the bore at c_i + R_0 d
//!
//!   (I_I + J + j) Ω̇ = drive - support + free        drive: see [`drive`](super::drive); a given speed gives the torque
//!   t_I = (J + j) Ω̇ - free,   t_O = moment of the bearing on the outer race
//!
//!   without housing   m_i c̈_i = W d + S t + bearing + m g    or held;  the outer race stands at the origin
//!   with it           m_o c̈_o = W d + bearing + m' g         or held;  the inner race turns about the origin
//!                     arm and heat: see [`housing`](super::housing)
//! ```
//! Heats are ≥ 0: those of drive and bearing. Sources: the load with the friction it presses, (W d + S t)·ċ_i or W·ċ_o, the drives, the
//! growth of the inner race. What balls and cage receive: t_I - t_O - t_g + weights + c_i × F_i + c_o × F_o, F of the races on them.
//!
//! Does not model: torsion of shaft and sleeve, the rotor's place in its clearance.

use super::drive::{DriveOver, Instant};
use super::layout::{
    ACCELERATION, APPLIED_LOAD, ARM, ARM_RATE, BEARING_HEAT, BELT_DRAG, CAGE_SLIP, CAGE_SPEED,
    CLUTCH_CAPACITY, CLUTCH_SLIP, DETAIL, DISTURBANCE, DRIVE_HEAT, DRIVE_MOMENT,
    DRIVER_ACCELERATION, FRICTION_FORCE, HOUSING, INNER_FORCE, INNER_LOAD_SUM, INNER_MOMENT,
    LAND_FORCE, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD, LARGEST_POCKET_FORCE, LARGEST_SKIDS,
    MOMENTUM_RATE, MOTOR_TORQUE, OUTER_FORCE, OUTER_MOMENT, ROTOR_SLIP, STEADY_MOMENT,
    SUPPORT_DRAG, TEMPERATURE, THERMOCOUPLE,
};
use super::machine::{OuterRace, Rig};
use super::mode::Mode;
use crate::bearing::POCKET_FRICTION;
use number::{Real, Vec2};

impl<R: Real> Rig<R> {
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
        let races = layout.motion(state);
        let (inner, outer) = (&races.inner, &races.outer);
        let speed = inner.spin;
        let driver_speed = state[layout.driver.spin()];

        // bearing and drive
        let load = mode.load.at(time);
        let held_load = if self.concentric { load } else { zero };
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
        let at = Instant {
            time,
            load,
            speed,
            driver: driver_speed,
            inertia: race.inertia,
        };
        let turning = self.drive.turn(mode, &at, &reaction);
        let (bearing, acceleration) = (&turning.bearing, turning.acceleration);
        let inner_moment = bearing.inner_inertia * acceleration - reaction.on_inner.moment;
        let outer_moment = bearing.on_outer.moment - bearing.outer_inertia * acceleration;
        layout.race.turn_at(rate, speed, acceleration);
        layout
            .driver
            .turn_at(rate, driver_speed, turning.driver_acceleration);

        // centres: what presses on a race that is free to move, weight included
        let [on_inner, on_outer] = [bearing.on_inner.force, bearing.on_outer.force];
        let along_load = race.load_direction * load;
        let mut pressed = [Vec2::zero(); 2];
        match &self.housing {
            None => {
                let friction = race.load_direction.turned() * turning.friction;
                pressed[0] = along_load + friction;
                let centre = match race.centre_held {
                    true => Vec2::zero(),
                    false => (pressed[0] + on_inner) * race.mass.recip() + race.gravity,
                };
                layout.race.move_at(rate, inner.velocity, centre);
            }
            Some(housing) => {
                if !self.concentric {
                    pressed[1] = along_load + housing.weight;
                }
                let centre = match self.concentric {
                    true => Vec2::zero(),
                    false => (pressed[1] + on_outer) * housing.inverse_mass,
                };
                HOUSING.move_at(rate, outer.velocity, centre);
            }
        }
        let work_of_load = pressed[0].dot(inner.velocity) + pressed[1].dot(outer.velocity);

        // ledger
        let mut heats = bearing.heat.kinds();
        heats[POCKET_FRICTION] += bearing.loss_heat(speed, acceleration);
        rate[layout.heat(0)..layout.heat(DRIVE_HEAT)].copy_from_slice(&heats);
        let of_drive = &mut rate[layout.heat(DRIVE_HEAT)..layout.source(0)];
        let count = of_drive.len();
        of_drive.copy_from_slice(&turning.heats[..count]);
        let growth = bearing.growth_impulse * acceleration;
        let sources = &mut rate[layout.source(0)..layout.angular_impulse()];
        match &self.drive {
            DriveOver::Clutch(_) => {
                sources.copy_from_slice(&[turning.driver_power, work_of_load, growth]);
            }
            _ => sources.copy_from_slice(&[
                work_of_load,
                turning.driver_power,
                turning.race_power,
                growth,
            ]),
        }
        let external = bearing.external_moment;
        let weight_of_race = match layout.housing {
            true => Vec2::zero(),
            false => race.gravity * race.mass,
        };
        rate[layout.angular_impulse()] =
            inner.position.cross(pressed[0] + weight_of_race) + turning.from_ground + external
                - outer_moment
                + outer.position.cross(pressed[1]);
        // of the races on the balls
        let [inner_force, outer_force] = [-on_inner, -on_outer];
        let eccentric =
            external + inner.position.cross(inner_force) + outer.position.cross(outer_force);
        let momentum = (self.bearing).angular_momentum_rate(
            &state[own.clone()],
            &rate[own.clone()],
            acceleration,
        );
        rate[layout.work(0)] = inner_moment * speed;
        rate[layout.work(1)] = outer_moment * speed;
        rate[layout.work(2)] = momentum * speed;
        rate[layout.work(3)] = inner_force.dot(inner.velocity) + outer_force.dot(outer.velocity)
            - eccentric * speed
            + growth;
        let bearing_heat = heats.iter().fold(zero, |sum, heat| sum + *heat);
        let mut disturbance = zero;
        if let Some(housing) = &self.housing {
            rate[layout.bearing_impulse()] = inner_moment - outer_moment + eccentric;
            disturbance = self.read(housing, outer_moment, bearing_heat, (state, rate));
        }

        if !probe.is_empty() {
            let cage_speed = rate[own.start];
            let rolling = speed * self.rolling_cage_ratio;
            let turns = rolling.abs().greater(zero);
            let safe = R::select(turns, rolling, R::one());
            let mut load_sum = zero;
            for load in &probe[DETAIL..DETAIL + layout.balls] {
                load_sum += *load;
            }
            let values: [(usize, R); DETAIL] = [
                (INNER_MOMENT, inner_moment),
                (OUTER_MOMENT, outer_moment),
                (STEADY_MOMENT, bearing.steady_moment),
                (DRIVE_MOMENT, turning.moment),
                (ACCELERATION, acceleration),
                (APPLIED_LOAD, load),
                (INNER_FORCE, inner_force.length_squared().sqrt()),
                (OUTER_FORCE, outer_force.length_squared().sqrt()),
                (CAGE_SPEED, cage_speed),
                (
                    CAGE_SLIP,
                    R::select(turns, R::one() - cage_speed / safe, zero),
                ),
                (INNER_LOAD_SUM, load_sum),
                (LARGEST_INNER_LOAD, bearing.largest_inner_load),
                (LARGEST_OUTER_LOAD, bearing.largest_outer_load),
                (LARGEST_POCKET_FORCE, bearing.largest_pocket_force),
                (LAND_FORCE, bearing.land_force),
                (LARGEST_SKIDS, bearing.largest_skids[0]),
                (LARGEST_SKIDS + 1, bearing.largest_skids[1]),
                (ROTOR_SLIP, turning.slip),
                (FRICTION_FORCE, turning.friction),
                (DRIVER_ACCELERATION, turning.driver_acceleration),
                (CLUTCH_CAPACITY, turning.capacity),
                (CLUTCH_SLIP, driver_speed - speed),
                (MOTOR_TORQUE, turning.motor),
                (BELT_DRAG, turning.belt),
                (SUPPORT_DRAG, turning.support),
                (DISTURBANCE, disturbance),
                (BEARING_HEAT, bearing_heat),
                (MOMENTUM_RATE, momentum),
            ];
            for (index, value) in values {
                probe[index] = value;
            }
        }
    }

    /// The rates of arm and temperatures; what vibration adds to the moment that the arm feels, N m.
    #[inline(always)]
    fn read(
        &self,
        housing: &OuterRace<R>,
        outer_moment: R,
        bearing_heat: R,
        (state, rate): (&[R], &mut [R]),
    ) -> R {
        let (arm, heat) = (&housing.constants.arm, &housing.constants.heat);
        let race = self.layout.race;
        let (angle, speed) = (state[race.angle()].lane(0), state[race.spin()].lane(0));
        let disturbance = R::splat(arm.disturbance.moment(angle, speed));
        let frequency = R::splat(arm.natural_frequency);
        let off = outer_moment + disturbance - state[ARM];
        rate[ARM] = state[ARM_RATE];
        rate[ARM_RATE] =
            frequency * (frequency * off - R::splat(2.0 * arm.damping_ratio) * state[ARM_RATE]);
        let kept = (housing.bearing).kept_by_films(&rate[self.layout.bearing()]);
        let given = R::splat(heat.conductance) * state[TEMPERATURE];
        rate[TEMPERATURE] = (bearing_heat - kept - given) / R::splat(heat.capacity);
        rate[THERMOCOUPLE] =
            (state[TEMPERATURE] - state[THERMOCOUPLE]) / R::splat(heat.thermocouple_lag);
        disturbance
    }
}
