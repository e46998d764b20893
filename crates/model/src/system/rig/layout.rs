//! Where everything stands in the state of a rig.
//!
//! ```text
//!   0..2    shaft        φ, Ω
//!   2..4    flywheel     φ_f, ω_f
//!   4..6    arm          reading y, its rate
//!   6..8    heat         rise of the bearing's temperature T, of the thermocouple's T_m
//!   8..12   housing      x, y, ẋ, ẏ
//!   12..    bearing      its own states, the cage angle first
//!   then    ledger       heats, works of the sources, external angular impulses of the rig and of balls and cage,
//!                        works by the moments on the races
//! ```
//! The work `other` of [`WORKS`] is that of (t_g - c_o × F_o)Ω + F_o·v_o and of the growth of the race, F_o of the outer race on
//! the balls.
//! What a converter samples comes first: it is cheap to read between two steps ([`taps`](super::taps)).

use super::constants::RigConstants;
use crate::bearing::{self, BearingConstants};
use crate::body::BodyAt;
use crate::system::layout::TestParts;
use crate::system::outer_race::WORKS;

/// The shaft with the inner race.
pub const SHAFT: BodyAt = BodyAt::turning(0);
/// The flywheel.
pub const FLYWHEEL: BodyAt = BodyAt::turning(2);
/// Channel of the reading of the arm, N m.
pub const ARM: usize = 4;
/// Channel of its rate, N m/s.
pub const ARM_RATE: usize = 5;
/// Channel of the rise of the bearing's temperature, K.
pub const TEMPERATURE: usize = 6;
/// Channel of the thermocouple's reading of it, K.
pub const THERMOCOUPLE: usize = 7;
/// The housing with the outer race.
pub const HOUSING: BodyAt = BodyAt::moving(8);
/// First channel of the bearing: the angle of its cage.
pub const BEARING: usize = 12;
/// Channel of the angle of the cage, rad.
pub const CAGE_ANGLE: usize = BEARING;

/// Kinds of heat besides those of the bearing.
const OWN_HEATS: [&str; 3] = ["clutch", "belt", "support_bearings"];
/// Number of kinds of heat: those of the bearing, then the rig's.
pub const HEATS: usize = bearing::HEATS.len() + OWN_HEATS.len();
/// Index of the heat of the clutch among all.
pub const CLUTCH_HEAT: usize = bearing::HEATS.len();
/// Index of the heat of belt and flywheel bearings among all.
pub const BELT_HEAT: usize = CLUTCH_HEAT + 1;
/// Index of the heat of the support bearings among all.
pub const SUPPORT_HEAT: usize = CLUTCH_HEAT + 2;
/// Kinds of source, in the order of their channels.
pub const SOURCES: [&str; 3] = ["motor", "weight", "inner_race_growth"];

/// Probe: moment t_I that resists the shaft in the test bearing, N m.
pub const INNER_MOMENT: usize = 0;
/// Probe: moment t_O that the bearing exerts on the outer race, N m.
pub const OUTER_MOMENT: usize = 1;
/// Probe: the steady moment M of the law at this speed and load, N m.
pub const STEADY_MOMENT: usize = 2;
/// Probe: cage slip S = 1 - 2(1+s)ω_c/Ω; 0 at rest.
pub const CAGE_SLIP: usize = 3;
/// Probe: acceleration of the shaft, rad/s².
pub const ACCELERATION: usize = 4;
/// Probe: acceleration of the flywheel, rad/s².
pub const FLYWHEEL_ACCELERATION: usize = 5;
/// Probe: torque of the clutch on the shaft, N m.
pub const CLUTCH_TORQUE: usize = 6;
/// Probe: capacity of the clutch, N m.
pub const CLUTCH_CAPACITY: usize = 7;
/// Probe: speed by which the flywheel is ahead of the shaft, rad/s.
pub const CLUTCH_SLIP: usize = 8;
/// Probe: torque of the motor on the flywheel, N m.
pub const MOTOR_TORQUE: usize = 9;
/// Probe: drag of belt and flywheel bearings, N m.
pub const BELT_DRAG: usize = 10;
/// Probe: drag of the support bearings, N m.
pub const SUPPORT_DRAG: usize = 11;
/// Probe: what vibration adds to the moment that the arm feels, N m.
pub const DISTURBANCE: usize = 12;
/// Probe: cage speed, rad/s.
pub const CAGE_SPEED: usize = 13;
/// Probe: size of the force of the balls on the outer race, N.
pub const BEARING_LOAD: usize = 14;
/// Probe: sum of the heats of the bearing, W.
pub const BEARING_HEAT: usize = 15;
/// Probe: rate of the angular momentum of balls and cage, N m, from the rates of their states.
pub const MOMENTUM_RATE: usize = 16;
/// Probe: sum of the ball loads at the inner race, N.
pub const INNER_LOAD_SUM: usize = 17;
/// Probe: largest ball load at the inner race, N.
pub const LARGEST_INNER_LOAD: usize = 18;
/// Probe: largest ball load at the outer race, N.
pub const LARGEST_OUTER_LOAD: usize = 19;
/// Probe: largest force between a ball and its pocket, or between two balls without a cage, N.
pub const LARGEST_POCKET_FORCE: usize = 20;
/// Probe: force between cage and land, N.
pub const LAND_FORCE: usize = 21;
/// First probe of the largest u²Q of a ball at both races, (m/s)² N.
pub const LARGEST_SKIDS: usize = 22;
/// First probe of the bearing's detail.
pub const DETAIL: usize = 24;

/// Names and units of the probes before the detail.
pub const PROBES: [(&str, &str); DETAIL] = [
    ("bearing.inner_race.resisting_moment", "N m"),
    ("bearing.outer_race.moment", "N m"),
    ("bearing.steady_moment", "N m"),
    ("bearing.cage.slip", "1"),
    ("shaft.acceleration", "rad/s^2"),
    ("flywheel.acceleration", "rad/s^2"),
    ("clutch.torque", "N m"),
    ("clutch.capacity", "N m"),
    ("clutch.slip_speed", "rad/s"),
    ("motor.torque", "N m"),
    ("flywheel.drag_moment", "N m"),
    ("shaft.drag_moment", "N m"),
    ("arm.disturbance", "N m"),
    ("bearing.cage.speed", "rad/s"),
    ("bearing.radial_load", "N"),
    ("bearing.heat", "W"),
    ("bearing.angular_momentum_rate", "N m"),
    ("bearing.inner_race.ball_load_sum", "N"),
    ("bearing.inner_race.largest_ball_load", "N"),
    ("bearing.outer_race.largest_ball_load", "N"),
    ("bearing.cage.largest_pocket_force", "N"),
    ("bearing.cage.land_force", "N"),
    ("bearing.inner_race.largest_skid", "m^2 N/s^2"),
    ("bearing.outer_race.largest_skid", "m^2 N/s^2"),
];

/// Names of the channels before the bearing's.
const BODIES: [&str; BEARING] = [
    "shaft.angle",
    "shaft.speed",
    "flywheel.angle",
    "flywheel.speed",
    "arm.reading",
    "arm.reading_rate",
    "bearing.temperature_rise",
    "thermocouple.temperature_rise",
    "housing.x",
    "housing.y",
    "housing.x_speed",
    "housing.y_speed",
];

/// The layout of a rig.
pub use crate::system::layout::TestLayout as Layout;

/// The layout of a rig of a bearing.
pub fn of(bearing: &BearingConstants) -> Layout {
    Layout::of(
        bearing,
        TestParts {
            bodies: &BODIES,
            heats: &OWN_HEATS,
            sources: &SOURCES,
            impulses: &["impulse", "bearing_impulse"],
            works: &WORKS,
            probes: DETAIL,
        },
    )
}

/// Channel of the external angular impulse of balls and cage.
#[inline(always)]
pub fn bearing_impulse(layout: &Layout) -> usize {
    layout.angular_impulse() + 1
}

/// The magnitude that matters in each channel: a tolerance of 1e-6 allows errors of one millionth of it a step.
///
/// Places of housing and balls by a ten-thousandth of the ball, speeds of centres by a thousandth of the speed of the
/// ball centres, spins by the target speed, energies by the spin energy of the shaft at that speed, the arm by a moment
/// of 0.1 N m, temperatures by 1 K.
pub fn error_scale(layout: &Layout, constants: &RigConstants) -> Vec<f64> {
    const MOMENT: f64 = 0.1;
    let spin = constants.target_speed.abs().max(1.0);
    let set = constants.bearing.set();
    let centre_speed = 1e-3 * spin * constants.bearing.pitch_radius();
    let inertia = constants.shaft.inertia + set.inner_inertia();
    let mut scale = vec![0.0; layout.dimension()];
    let length = 1e-4 * set.inner_track_radius * set.ball_ratio;
    for body in [SHAFT, FLYWHEEL, HOUSING] {
        body.error_scale(&mut scale, length, centre_speed, spin);
    }
    scale[ARM] = MOMENT;
    scale[ARM_RATE] = MOMENT * constants.arm.natural_frequency;
    scale[TEMPERATURE..=THERMOCOUPLE].fill(1.0);
    let own = layout.bearing();
    (constants.bearing).error_scale(&mut scale[own], spin, centre_speed);
    scale[layout.ledger()..].fill(0.5 * inertia * spin * spin);
    scale[layout.angular_impulse()..layout.work(0)].fill(inertia * spin);
    scale
}
