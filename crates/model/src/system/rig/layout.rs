//! Where the parts of a rig stand in the state of its machine, and its probes.
//!
//! ```text
//!   driver     φ, ω of the sliding rotor or of the flywheel; at rest where a torque or a speed is given
//!   race       φ, Ω of the inner race; before them x y, ẋ ẏ where no housing carries the outer one
//!   arm        reading y, its rate                            } where a housing
//!   heat       rise of the bearing's temperature T, of the    } carries the
//!              thermocouple's T_m                             } outer race
//!   housing    x, y, ẋ, ẏ                                     }
//!   bearing    its own states, the cage angle first
//!   ledger     heats, works of the sources, external angular impulses, works by the moments on the races
//! ```
//! The work `other` of [`WORKS`](crate::system::outer_race::WORKS) is that of t_g Ω - (c_i × F_i + c_o × F_o) Ω + F_i·v_i + F_o·v_o,
//! F of the races on the balls, and of the growth of the inner race: drags to the ground, weight, a race that moves or grows.
//! What a converter samples comes first: it is cheap to read between two steps ([`taps`](super::taps)).
//! The probes of any auxiliary bearing come first: [`probe`].

use crate::auxiliary_bearing::probe;
use crate::bearing;
use crate::body::BodyAt;

/// The rotor that slides in the inner race.
pub const ROTOR: BodyAt = BodyAt::turning(0);
/// The flywheel.
pub const FLYWHEEL: BodyAt = ROTOR;
/// The inner race of a rig without housing.
pub const INNER: BodyAt = BodyAt::free(2);
/// The shaft with the inner race, of a rig with a housing.
pub const SHAFT: BodyAt = BodyAt::turning(2);
/// Channel of the reading of its arm, N m.
pub const ARM: usize = 4;
/// Channel of the rate of that, N m/s.
pub const ARM_RATE: usize = 5;
/// Channel of the rise of the bearing's temperature, K.
pub const TEMPERATURE: usize = 6;
/// Channel of the thermocouple's reading of it, K.
pub const THERMOCOUPLE: usize = 7;
/// Names of the channels of arm and temperatures.
pub const READINGS: [&str; 4] = [
    "arm.reading",
    "arm.reading_rate",
    "bearing.temperature_rise",
    "thermocouple.temperature_rise",
];
/// The housing with the outer race.
pub const HOUSING: BodyAt = BodyAt::moving(8);
/// Channel of the angle of the cage, rad.
pub const CAGE_ANGLE: usize = 12;

/// Index of the heat of the drive among all: of the sliding rotor, or of the clutch.
pub const DRIVE_HEAT: usize = bearing::HEATS.len();
/// Index of the heat of the support bearings among all.
pub const SUPPORT_HEAT: usize = DRIVE_HEAT + 2;

/// Probe: moment t_I that resists the inner race, N m.
pub const INNER_MOMENT: usize = probe::COUNT;
/// Probe: moment t_O that the bearing exerts on the outer race, N m.
pub const OUTER_MOMENT: usize = INNER_MOMENT + 1;
/// Probe: the steady moment M of the law at this speed and load, N m.
pub const STEADY_MOMENT: usize = INNER_MOMENT + 2;
/// Probe: moment of the drive on the inner race, N m.
pub const DRIVE_MOMENT: usize = INNER_MOMENT + 3;
/// Probe: acceleration of the inner race, rad/s².
pub const ACCELERATION: usize = INNER_MOMENT + 4;
/// Probe: size of the force of the balls on the inner race, N.
pub const INNER_FORCE: usize = INNER_MOMENT + 5;
/// Probe: cage speed, rad/s.
pub const CAGE_SPEED: usize = INNER_MOMENT + 6;
/// Probe: cage slip S = 1 - 2(1+s)ω_c/Ω; 0 at rest.
pub const CAGE_SLIP: usize = INNER_MOMENT + 7;
/// Probe: sum of the ball loads at the inner race, N.
pub const INNER_LOAD_SUM: usize = INNER_MOMENT + 8;
/// Probe: acceleration of the flywheel or of the sliding rotor, rad/s².
pub const DRIVER_ACCELERATION: usize = INNER_MOMENT + 9;
/// Probe: capacity of the clutch, N m.
pub const CLUTCH_CAPACITY: usize = INNER_MOMENT + 10;
/// Probe: speed by which the flywheel is ahead of the shaft, rad/s.
pub const CLUTCH_SLIP: usize = INNER_MOMENT + 11;
/// Probe: torque of the motor on the flywheel, N m.
pub const MOTOR_TORQUE: usize = INNER_MOMENT + 12;
/// Probe: drag of belt and flywheel bearings, N m.
pub const BELT_DRAG: usize = INNER_MOMENT + 13;
/// Probe: drag of the support bearings, N m.
pub const SUPPORT_DRAG: usize = INNER_MOMENT + 14;
/// Probe: what vibration adds to the moment that the arm feels, N m.
pub const DISTURBANCE: usize = INNER_MOMENT + 15;
/// Probe: sum of the heats of the bearing, W.
pub const BEARING_HEAT: usize = INNER_MOMENT + 16;
/// Probe: rate of the angular momentum of balls and cage, N m, from the rates of their states.
pub const MOMENTUM_RATE: usize = INNER_MOMENT + 17;
/// Number of these.
pub const MEASURED: usize = 18;
/// First probe of the bearing's detail.
pub const DETAIL: usize = probe::COUNT + MEASURED;
