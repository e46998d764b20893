//! Where everything stands in the state of a spin-up.
//!
//! ```text
//!   0..6   inner race   x y, ẋ ẏ, φ_i, Ω
//!   6..8   rotor        φ_r, ω_r; stands still where nothing slides
//!   8..    bearing      its own states
//!   then   ledger       heats, works of the sources, external angular impulse,
//!                       works by the moments on the races
//! ```
//! The work `other` of [`WORKS`] is that of t_g Ω - (c_i × F)Ω + F·v_i and of the growth of the race: drags to the ground, weight,
//! a race that moves or grows.

use super::constants::SpinUpConstants;
use crate::bearing::{self, BearingConstants};
use crate::body::BodyAt;
use crate::system::layout::TestParts;
use crate::system::outer_race::WORKS;

/// The inner race.
pub const INNER: BodyAt = BodyAt::free(0);
/// The rotor.
pub const ROTOR: BodyAt = BodyAt::turning(6);
/// First channel of the bearing.
pub const BEARING: usize = 8;

/// Kinds of heat besides those of the bearing.
const OWN_HEATS: [&str; 1] = ["rotor_race_friction"];
/// Number of kinds of heat: those of the bearing, then the sliding rotor's.
pub const HEATS: usize = bearing::HEATS.len() + OWN_HEATS.len();
/// Kinds of source, in the order of their channels.
pub const SOURCES: [&str; 4] = [
    "radial_load",
    "rotor_torque",
    "inner_race_torque",
    "inner_race_growth",
];

/// Probe: moment t_I that resists the inner race, N m.
pub const INNER_MOMENT: usize = 0;
/// Probe: moment t_O that the bearing exerts on the outer race, N m.
pub const OUTER_MOMENT: usize = 1;
/// Probe: the steady moment M of the law at this speed and load, N m.
pub const STEADY_MOMENT: usize = 2;
/// Probe: moment of the drive on the inner race, N m.
pub const DRIVE_MOMENT: usize = 3;
/// Probe: acceleration of the inner race, rad/s².
pub const ACCELERATION: usize = 4;
/// Probe: radial load applied, N.
pub const APPLIED_LOAD: usize = 5;
/// Probe: size of the force of the balls on the inner race, N.
pub const BEARING_LOAD: usize = 6;
/// Probe: cage speed, rad/s.
pub const CAGE_SPEED: usize = 7;
/// Probe: cage slip S = 1 - 2(1+s)ω_c/Ω; 0 at rest.
pub const CAGE_SLIP: usize = 8;
/// Probe: slip of the rotor in the bore, rotor less race, m/s.
pub const ROTOR_SLIP: usize = 9;
/// Probe: friction force of the rotor on the race, forward positive, N.
pub const FRICTION_FORCE: usize = 10;
/// Probe: sum of the ball loads at the inner race, N.
pub const INNER_LOAD_SUM: usize = 11;
/// Probe: largest ball load at the inner race, N.
pub const LARGEST_INNER_LOAD: usize = 12;
/// Probe: largest ball load at the outer race, N.
pub const LARGEST_OUTER_LOAD: usize = 13;
/// Probe: largest force between a ball and its pocket, or between two balls without a cage, N.
pub const LARGEST_POCKET_FORCE: usize = 14;
/// Probe: force between cage and land, N.
pub const LAND_FORCE: usize = 15;
/// First probe of the largest u²Q of a ball at both races, (m/s)² N.
pub const LARGEST_SKIDS: usize = 16;
/// First probe of the bearing's detail.
pub const DETAIL: usize = 18;

/// Names and units of the probes before the detail.
pub const PROBES: [(&str, &str); DETAIL] = [
    ("bearing.inner_race.resisting_moment", "N m"),
    ("bearing.outer_race.moment", "N m"),
    ("bearing.steady_moment", "N m"),
    ("drive.moment", "N m"),
    ("bearing.inner_race.acceleration", "rad/s^2"),
    ("drive.radial_load", "N"),
    ("bearing.radial_load", "N"),
    ("bearing.cage.speed", "rad/s"),
    ("bearing.cage.slip", "1"),
    ("rotor.slip_speed", "m/s"),
    ("rotor.friction_force", "N"),
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
    "bearing.inner_race.x",
    "bearing.inner_race.y",
    "bearing.inner_race.x_speed",
    "bearing.inner_race.y_speed",
    "bearing.inner_race.angle",
    "bearing.inner_race.speed",
    "rotor.angle",
    "rotor.speed",
];

/// The layout of a spin-up.
pub use crate::system::layout::TestLayout as Layout;

/// The layout of a spin-up of a bearing.
pub fn of(bearing: &BearingConstants) -> Layout {
    Layout::of(
        bearing,
        TestParts {
            bodies: &BODIES,
            heats: &OWN_HEATS,
            sources: &SOURCES,
            impulses: &["impulse"],
            works: &WORKS,
            probes: DETAIL,
        },
    )
}

/// The magnitude that matters in each channel: a tolerance of 1e-6 allows errors of one millionth of it a step.
///
/// Places of race and balls by a ten-thousandth of the ball, speeds of centres by a thousandth of the speed of the
/// ball centres, spins by the target speed, energies by the spin energy of the race at that speed.
pub fn error_scale(layout: &Layout, constants: &SpinUpConstants) -> Vec<f64> {
    let spin = constants.target_speed.abs().max(1.0);
    let pitch = constants.bearing.pitch_radius();
    let set = constants.bearing.set();
    let centre_speed = 1e-3 * spin * pitch;
    let inertia = constants.race.inertia + set.inner_inertia();
    let mut scale = vec![0.0; layout.dimension()];
    let length = 1e-4 * set.inner_track_radius * set.ball_ratio;
    INNER.error_scale(&mut scale, length, centre_speed, spin);
    ROTOR.error_scale(&mut scale, length, centre_speed, spin);
    let own = layout.bearing();
    (constants.bearing).error_scale(&mut scale[own], spin, centre_speed);
    scale[layout.ledger()..].fill(0.5 * inertia * spin * spin);
    scale[layout.angular_impulse()] = inertia * spin;
    scale
}
