//! Where everything stands in the state of a rig.
//!
//! ```text
//!   race       φ, Ω of the inner race; before them x y, ẋ ẏ where no housing carries the outer one
//!   driver     φ, ω of the sliding rotor or of the flywheel; at rest where a torque or a speed is given
//!   arm        reading y, its rate                            } where a housing
//!   heat       rise of the bearing's temperature T, of the    } carries the
//!              thermocouple's T_m                             } outer race
//!   housing    x, y, ẋ, ẏ                                     }
//!   bearing    its own states, the cage angle first
//!   ledger     heats, works of the sources, external angular impulses, works by the moments on the races
//! ```
//! The work `other` of [`WORKS`] is that of t_g Ω - (c_i × F_i + c_o × F_o) Ω + F_i·v_i + F_o·v_o, F of the races on the balls, and of
//! the growth of the inner race: drags to the ground, weight, a race that moves or grows.
//! What a converter samples comes first: it is cheap to read between two steps ([`taps`](super::taps)).

use super::constants::RigConstants;
use super::drive::Drive;
use crate::bearing::{self, DETAIL_PER_BALL};
use crate::body::BodyAt;
use crate::motion::{Body, Motion};
use crate::system::layout;
use crate::system::outer_race::WORKS;
use number::{Real, Vec2};
use std::ops::{Deref, Range};

/// The inner race of a rig without housing.
pub const INNER: BodyAt = BodyAt::free(0);
/// The rotor that slides in it.
pub const ROTOR: BodyAt = BodyAt::turning(6);

/// The shaft with the inner race, of a rig with a housing.
pub const SHAFT: BodyAt = BodyAt::turning(0);
/// Its flywheel.
pub const FLYWHEEL: BodyAt = BodyAt::turning(2);
/// Channel of the reading of its arm, N m.
pub const ARM: usize = 4;
/// Channel of the rate of that, N m/s.
pub const ARM_RATE: usize = 5;
/// Channel of the rise of the bearing's temperature, K.
pub const TEMPERATURE: usize = 6;
/// Channel of the thermocouple's reading of it, K.
pub const THERMOCOUPLE: usize = 7;
/// The housing with the outer race.
pub const HOUSING: BodyAt = BodyAt::moving(8);
/// Channel of the angle of the cage, rad.
pub const CAGE_ANGLE: usize = 12;

/// Index of the heat of the drive among all: of the sliding rotor, or of the clutch.
pub const DRIVE_HEAT: usize = bearing::HEATS.len();
/// Index of the heat of the support bearings among all.
pub const SUPPORT_HEAT: usize = DRIVE_HEAT + 2;

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
pub const INNER_FORCE: usize = 6;
/// Probe: size of the force of the balls on the outer race, N.
pub const OUTER_FORCE: usize = 7;
/// Probe: cage speed, rad/s.
pub const CAGE_SPEED: usize = 8;
/// Probe: cage slip S = 1 - 2(1+s)ω_c/Ω; 0 at rest.
pub const CAGE_SLIP: usize = 9;
/// Probe: sum of the ball loads at the inner race, N.
pub const INNER_LOAD_SUM: usize = 10;
/// Probe: largest ball load at the inner race, N.
pub const LARGEST_INNER_LOAD: usize = 11;
/// Probe: largest ball load at the outer race, N.
pub const LARGEST_OUTER_LOAD: usize = 12;
/// Probe: largest force between a ball and its pocket, or between two balls without a cage, N.
pub const LARGEST_POCKET_FORCE: usize = 13;
/// Probe: force between cage and land, N.
pub const LAND_FORCE: usize = 14;
/// First probe of the largest u²Q of a ball at both races, (m/s)² N.
pub const LARGEST_SKIDS: usize = 15;
/// Probe: slip of the rotor in the bore, rotor less race, m/s.
pub const ROTOR_SLIP: usize = 17;
/// Probe: friction force of the rotor on the race, forward positive, N.
pub const FRICTION_FORCE: usize = 18;
/// Probe: acceleration of the flywheel or of the sliding rotor, rad/s².
pub const DRIVER_ACCELERATION: usize = 19;
/// Probe: capacity of the clutch, N m.
pub const CLUTCH_CAPACITY: usize = 20;
/// Probe: speed by which the flywheel is ahead of the shaft, rad/s.
pub const CLUTCH_SLIP: usize = 21;
/// Probe: torque of the motor on the flywheel, N m.
pub const MOTOR_TORQUE: usize = 22;
/// Probe: drag of belt and flywheel bearings, N m.
pub const BELT_DRAG: usize = 23;
/// Probe: drag of the support bearings, N m.
pub const SUPPORT_DRAG: usize = 24;
/// Probe: what vibration adds to the moment that the arm feels, N m.
pub const DISTURBANCE: usize = 25;
/// Probe: sum of the heats of the bearing, W.
pub const BEARING_HEAT: usize = 26;
/// Probe: rate of the angular momentum of balls and cage, N m, from the rates of their states.
pub const MOMENTUM_RATE: usize = 27;
/// First probe of the bearing's detail.
pub const DETAIL: usize = 28;

/// The layout of a rig.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    channels: layout::Layout,
    /// The inner race.
    pub race: BodyAt,
    /// The sliding rotor or the flywheel.
    pub driver: BodyAt,
    /// Whether a housing carries the outer race, with arm and heat.
    pub housing: bool,
    bearing: Range<usize>,
    /// Number of balls.
    pub balls: usize,
}

impl Deref for Layout {
    type Target = layout::Layout;
    fn deref(&self) -> &layout::Layout {
        &self.channels
    }
}

impl Layout {
    /// The layout of a rig.
    pub fn of(constants: &RigConstants) -> Self {
        let mut channels = layout::Layout::default();
        let housing = constants.housing.is_some();
        let clutch = matches!(constants.drive, Drive::Clutch(_));
        let driver = if clutch { "flywheel" } else { "rotor" };
        let [race, driver] = if housing {
            let race = channels.body("", "shaft", BodyAt::turning);
            let driver = channels.body("", driver, BodyAt::turning);
            let readings = [
                "arm.reading",
                "arm.reading_rate",
                "bearing.temperature_rise",
                "thermocouple.temperature_rise",
            ];
            channels.block("", readings.map(String::from));
            let body = channels.body("", "housing", BodyAt::moving);
            debug_assert_eq!([race, driver, body], [SHAFT, FLYWHEEL, HOUSING]);
            [race, driver]
        } else {
            let race = channels.body("", "bearing.inner_race", BodyAt::free);
            let driver = channels.body("", driver, BodyAt::turning);
            debug_assert_eq!([race, driver], [INNER, ROTOR]);
            [race, driver]
        };
        let bearing = channels.bearing("", &constants.bearing);
        channels.heats_of("", bearing::HEATS);
        let load = if housing { "weight" } else { "radial_load" };
        if clutch {
            channels.heats_of("", ["clutch", "belt", "support_bearings"]);
            channels.sources_of("", ["motor", load]);
        } else {
            channels.heats_of("", ["rotor_race_friction"]);
            channels.sources_of("", [load, "rotor_torque", "inner_race_torque"]);
        }
        channels.sources_of("", ["inner_race_growth"]);
        channels.impulses_of("", ["impulse"]);
        if housing {
            channels.impulses_of("", ["bearing_impulse"]);
        }
        channels.works_of("", WORKS);
        Layout {
            channels,
            race,
            driver,
            housing,
            bearing,
            balls: constants.bearing.balls(),
        }
    }
    /// Channels of the bearing.
    #[inline(always)]
    pub fn bearing(&self) -> Range<usize> {
        self.bearing.clone()
    }
    /// Motion of both races in a state: an outer race without housing stands at the origin.
    #[inline(always)]
    pub fn motion<R: Real>(&self, state: &[R]) -> Motion<R> {
        let zero = R::zero();
        Motion {
            inner: self.race.motion(state),
            outer: match self.housing {
                true => HOUSING.motion(state),
                false => Body::planar(Vec2::zero(), Vec2::zero(), zero, zero),
            },
        }
    }
    /// Number of probes.
    pub fn probes(&self) -> usize {
        DETAIL + DETAIL_PER_BALL * self.balls
    }
    /// Number of probes down to the loads of the balls.
    pub fn probes_with_loads(&self) -> usize {
        DETAIL + 2 * self.balls
    }
    /// Channel of the external angular impulse of balls and cage, where a housing carries the outer race.
    #[inline(always)]
    pub fn bearing_impulse(&self) -> usize {
        self.angular_impulse() + 1
    }
    /// The magnitude that matters in each channel: a tolerance of 1e-6 allows errors of one millionth of it a step.
    ///
    /// Places of centres and balls by a ten-thousandth of the ball, speeds of centres by a thousandth of the speed of the
    /// ball centres, spins by the target speed, energies by the spin energy of the race at that speed, the arm by a moment
    /// of 0.1 N m, temperatures by 1 K.
    pub fn error_scale(&self, constants: &RigConstants) -> Vec<f64> {
        const MOMENT: f64 = 0.1;
        let spin = constants.target_speed.abs().max(1.0);
        let set = constants.bearing.set();
        let centre_speed = 1e-3 * spin * constants.bearing.pitch_radius();
        let inertia = constants.race.inertia + set.inner_inertia();
        let mut scale = vec![0.0; self.dimension()];
        let length = 1e-4 * set.inner_track_radius * set.ball_ratio;
        for body in [self.race, self.driver] {
            body.error_scale(&mut scale, length, centre_speed, spin);
        }
        if let Some(housing) = &constants.housing {
            HOUSING.error_scale(&mut scale, length, centre_speed, spin);
            scale[ARM] = MOMENT;
            scale[ARM_RATE] = MOMENT * housing.arm.natural_frequency;
            scale[TEMPERATURE..=THERMOCOUPLE].fill(1.0);
        }
        let own = self.bearing();
        (constants.bearing).error_scale(&mut scale[own], spin, centre_speed);
        scale[self.ledger()..].fill(0.5 * inertia * spin * spin);
        scale[self.angular_impulse()..self.work(0)].fill(inertia * spin);
        scale
    }
}
