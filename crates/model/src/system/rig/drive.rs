//! What turns the inner race: a rotor that slides in its bore, a torque, a given speed, or a flywheel behind a clutch.
//!
//! ```text
//!   sliding rotor   u = R_0 (ω_r - Ω),  S = μ tanh(u/u0) W,  drive = R_0 S          I_r ω̇_r = -R_0 S, or held: a source
//!   torque          drive = τ(t)
//!   speed           Ω̇ given,  drive = (I_I + J + j) Ω̇ - free
//!   clutch          open 0;  slipping ± T_c(t);  locked: whatever keeps ω_f = Ω     I_f ω̇_f = motor - belt - T
//!                   motor = clamp(gain (ω_set(t) - ω_f), ± limit)
//!
//!   (I_I + J + j) Ω̇ = drive - support + free          free: moment of the bearing on the race but for -(J + j) Ω̇
//! ```
//! Heats are ≥ 0: S u, or T (ω_f - Ω) and the drags times their speeds.

use super::constants::{not_negative, positive};
use super::mode::{Clutch, Mode};
use super::program::Program;
use super::refusal::Refusal;
use crate::bearing::BearingReaction;
use crate::table::Table;
use number::{Gather, Real, constants};

/// What turns the inner race.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// A rotor that the radial load presses on the bore.
    SlidingRotor(SlidingRotor<f64>),
    /// A torque on the inner race over time, N m over s.
    Torque(Table),
    /// A speed of the inner race over time, rad/s over s; the first row is the speed at the start.
    /// See [`Drive::ramp`] and [`Drive::step`].
    Speed(Table),
    /// A flywheel behind a clutch.
    Clutch(Box<ClutchDrive>),
}

constants! {
    /// A rotor that slides in the bore of the inner race.
    pub struct SlidingRotor {
        /// Radius of the bore R_0, m.
        bore_radius: R,
        /// Friction coefficient μ.
        friction: R,
        /// 1/u0, s/m: inverse of the slip at which friction reaches 76 %.
        inverse_reference_speed: R,
        /// Spin at the start, rad/s.
        speed: R,
        /// Polar moment of inertia, kg m²; without effect where the spin is held.
        polar_inertia: R,
        /// True where a drive holds the spin whatever it takes.
        spin_held: bool,
    }
}

/// A flywheel that drives the inner race through a clutch.
#[derive(Clone, Debug, PartialEq)]
pub struct ClutchDrive {
    /// Flywheel, with the driven pulley and the driving half of the clutch.
    pub flywheel: Flywheel,
    /// What turns the flywheel.
    pub motor: Motor,
    /// Drag of the bearings that support the shaft.
    pub support_drag: Drag,
    /// What is done.
    pub program: Program,
}

/// A drag that opposes rotation: (constant part)·tanh(Ω/reference) + viscous·Ω.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drag {
    /// Constant part, N m; it fades at rest.
    pub constant: f64,
    /// Viscous part, N m s/rad.
    pub viscous: f64,
    /// Speed at which the constant part reaches 76 %, rad/s.
    pub reference_speed: f64,
}

/// The flywheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flywheel {
    /// Inertia with what turns with it up to the clutch, kg m².
    pub inertia: f64,
    /// Drag of the belt and of its bearings.
    pub belt_drag: Drag,
}

/// The motor, seen at the flywheel through its belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// Torque per speed that is missing, N m s/rad.
    pub gain: f64,
    /// Largest torque in either direction, N m.
    pub torque_limit: f64,
}

impl Drag {
    /// No drag.
    pub const NONE: Drag = Drag {
        constant: 0.0,
        viscous: 0.0,
        reference_speed: 1.0,
    };
    /// The moment against the rotation at a speed (rad/s), N m, with the sign of the speed.
    #[inline(always)]
    pub fn moment<R: Real>(&self, speed: R) -> R {
        let fading = (speed / R::splat(self.reference_speed)).tanh();
        R::splat(self.constant) * fading + R::splat(self.viscous) * speed
    }
}

impl ClutchDrive {
    pub(super) fn check(&self) -> Result<(), Refusal> {
        let (belt, support) = (&self.flywheel.belt_drag, &self.support_drag);
        positive("inertia of the flywheel", self.flywheel.inertia)?;
        positive("reference speed of the belt's drag", belt.reference_speed)?;
        positive(
            "reference speed of the support's drag",
            support.reference_speed,
        )?;
        not_negative("gain of the motor", self.motor.gain)?;
        not_negative("torque limit of the motor", self.motor.torque_limit)?;
        not_negative("constant drag of the belt", belt.constant)?;
        not_negative("viscous drag of the belt", belt.viscous)?;
        not_negative("constant drag of the supports", support.constant)?;
        not_negative("viscous drag of the supports", support.viscous)?;
        self.program.check()
    }
}

impl Drive {
    /// A constant acceleration (its size, rad/s²) from rest to a speed of either sign (rad/s), which then stays.
    pub fn ramp(acceleration: f64, speed: f64) -> Self {
        let end = (speed / acceleration).abs();
        match Table::through(vec![(0.0, 0.0), (end, speed)]) {
            Ok(table) => Drive::Speed(table),
            // no acceleration to speak of, or one beyond measure
            Err(_) => Drive::step(speed),
        }
    }
    /// A speed from the first instant, rad/s, while the balls are at rest.
    pub fn step(speed: f64) -> Self {
        Drive::Speed(Table::constant(speed))
    }
    /// Speed of the sliding rotor or of the flywheel at the start, rad/s.
    pub(super) fn start_speed(&self) -> f64 {
        match self {
            Drive::SlidingRotor(rotor) => rotor.speed,
            Drive::Clutch(clutch) => clutch.program.start.flywheel_speed,
            Drive::Torque(_) | Drive::Speed(_) => 0.0,
        }
    }
    /// Inertia of the sliding rotor or of the flywheel, kg m²; none where something holds its spin.
    pub(super) fn driver_inertia(&self) -> f64 {
        match self {
            Drive::SlidingRotor(rotor) if !rotor.spin_held => rotor.polar_inertia,
            Drive::Clutch(clutch) => clutch.flywheel.inertia,
            _ => 0.0,
        }
    }
}

/// The drive over `R`: a torque or a speed stands in the [`Mode`]; a clutch is that of one machine.
#[derive(Clone, Debug)]
pub(super) enum DriveOver<R> {
    SlidingRotor(SlidingRotor<R>),
    Torque,
    Speed,
    Clutch(Box<ClutchDrive>),
}

impl<R: Real> DriveOver<R> {
    /// One drive per lane.
    pub fn gather<'a>(drive: &dyn Fn(usize) -> &'a Drive) -> Self {
        match drive(0) {
            Drive::SlidingRotor(_) => {
                DriveOver::SlidingRotor(Gather::<R>::gather(&|lane| match drive(lane) {
                    Drive::SlidingRotor(rotor) => rotor,
                    _ => panic!("lanes share the kind of drive"),
                }))
            }
            Drive::Torque(_) => DriveOver::Torque,
            Drive::Speed(_) => DriveOver::Speed,
            Drive::Clutch(clutch) => {
                assert!(R::LANES == 1, "one clutch at a time");
                DriveOver::Clutch(clutch.clone())
            }
        }
    }
}

/// Time, load, speeds and inertia that the drive acts on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instant<R> {
    /// s.
    pub time: R,
    /// Radial load, N.
    pub load: R,
    /// Speed of the inner race, rad/s.
    pub speed: R,
    /// Speed of the sliding rotor or of the flywheel, rad/s.
    pub driver: R,
    /// Inertia of the inner race, kg m².
    pub inertia: R,
}

/// Accelerations, torques, powers and heats of race and drive at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turning<R> {
    /// The bearing, with the loss of accelerated balls.
    pub bearing: BearingReaction<R>,
    /// Acceleration of the inner race, and of the sliding rotor or the flywheel, rad/s².
    pub acceleration: R,
    pub driver_acceleration: R,
    /// Moment of the drive on the race, N m.
    pub moment: R,
    /// Friction of the sliding rotor on the race, N, and slip of the one in the other, m/s.
    pub friction: R,
    pub slip: R,
    /// Torque from the ground on race and driver together, N m.
    pub from_ground: R,
    /// Power of motor, or of what holds the rotor, on the driver, and of what drives the race itself, W.
    pub driver_power: R,
    pub race_power: R,
    /// Heats beside those of the bearing, W: sliding rotor, or clutch, belt, support bearings.
    pub heats: [R; 3],
    /// Capacity of the clutch, torques of motor, belt and support, N m.
    pub capacity: R,
    pub motor: R,
    pub belt: R,
    pub support: R,
}

impl<R: Real> DriveOver<R> {
    /// What turns at an instant: race, driver, and balls where they have no states.
    #[inline(always)]
    pub fn turn(
        &self,
        mode: &Mode<R>,
        at: &Instant<R>,
        bearing: &BearingReaction<R>,
    ) -> Turning<R> {
        let zero = R::zero();
        let free = bearing.on_inner.moment;
        // of everything on the race at a known moment
        let freely = |moment: R| {
            let bearing = bearing.with_loss(at.speed, moment);
            (bearing, moment / (at.inertia + bearing.inner_inertia))
        };
        let still = Turning {
            bearing: *bearing,
            acceleration: zero,
            driver_acceleration: zero,
            moment: zero,
            friction: zero,
            slip: zero,
            from_ground: zero,
            driver_power: zero,
            race_power: zero,
            heats: [zero; 3],
            capacity: zero,
            motor: zero,
            belt: zero,
            support: zero,
        };
        match self {
            DriveOver::SlidingRotor(rotor) => {
                let slip = rotor.bore_radius * (at.driver - at.speed);
                let coefficient = rotor.friction * (slip * rotor.inverse_reference_speed).tanh();
                let friction = coefficient * at.load;
                let moment = rotor.bore_radius * friction;
                let (bearing, acceleration) = freely(moment + free);
                let (held, driver_acceleration) = match rotor.spin_held {
                    true => (moment, zero),
                    false => (zero, -moment / rotor.polar_inertia),
                };
                Turning {
                    bearing,
                    acceleration,
                    driver_acceleration,
                    moment,
                    friction,
                    slip,
                    from_ground: held,
                    driver_power: held * at.driver,
                    heats: [friction * slip, zero, zero],
                    ..still
                }
            }
            DriveOver::Torque => {
                let moment = mode.drive.at(at.time);
                let (bearing, acceleration) = freely(moment + free);
                Turning {
                    bearing,
                    acceleration,
                    moment,
                    from_ground: moment,
                    race_power: moment * at.speed,
                    ..still
                }
            }
            DriveOver::Speed => {
                let acceleration = mode.drive.slope;
                let bearing = bearing.with_loss(at.speed, acceleration);
                let moment = (at.inertia + bearing.inner_inertia) * acceleration - free;
                Turning {
                    bearing,
                    acceleration,
                    moment,
                    from_ground: moment,
                    race_power: moment * at.speed,
                    ..still
                }
            }
            DriveOver::Clutch(drive) => {
                let plain = R::splat;
                let motor = match &mode.clutch.motor {
                    None => zero,
                    Some(set) => {
                        let set = plain(set.at(at.time.lane(0)));
                        let limit = plain(drive.motor.torque_limit);
                        let wanted = plain(drive.motor.gain) * (set - at.driver);
                        wanted.max(-limit).min(limit)
                    }
                };
                let belt = drive.flywheel.belt_drag.moment(at.driver);
                let support = drive.support_drag.moment(at.speed);
                let capacity = plain(mode.clutch.capacity.at(at.time.lane(0)));
                let flywheel = plain(drive.flywheel.inertia);
                let (on_race, on_flywheel) = (free - support, motor - belt);
                let slips = at.driver - at.speed;
                let turning = Turning {
                    from_ground: motor - belt - support,
                    driver_power: motor * at.driver,
                    heats: [zero, belt * at.driver, support * at.speed],
                    capacity,
                    motor,
                    belt,
                    support,
                    ..still
                };
                match mode.clutch.state {
                    Clutch::Locked => {
                        let all = on_flywheel + on_race;
                        let bearing = bearing.with_loss(at.speed, all);
                        let race = at.inertia + bearing.inner_inertia;
                        let acceleration = all / (flywheel + race);
                        Turning {
                            bearing,
                            acceleration,
                            driver_acceleration: acceleration,
                            moment: race * acceleration - on_race,
                            ..turning
                        }
                    }
                    clutch => {
                        let (moment, heat) = match clutch {
                            Clutch::Slipping { direction } => {
                                let moment = plain(direction) * capacity;
                                (moment, moment * slips)
                            }
                            _ => (zero, zero),
                        };
                        let (bearing, acceleration) = freely(moment + on_race);
                        Turning {
                            bearing,
                            acceleration,
                            driver_acceleration: (on_flywheel - moment) / flywheel,
                            moment,
                            heats: [heat, turning.heats[1], turning.heats[2]],
                            ..turning
                        }
                    }
                }
            }
        }
    }
}
