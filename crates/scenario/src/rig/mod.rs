//! A test on a rig as typed values in SI.

pub mod checks;
pub mod keys;

use crate::bearing::{Bearing, bearing};
use crate::heat::{Network, Warm};
use crate::run::Run;
use crate::section::Section;
use crate::signals::PickupOutput;
use crate::values::Values;
use problem::words;

words! {
    /// Program of a rig, as a word.
    pub enum ProgramKind {
        SpinUp = "spin-up",
        CoastDown = "coast-down",
        RampAndHold = "ramp and hold",
        /// Two spin-ups with a rest between.
        RepeatAfterRest = "repeat after rest",
    }
}

words! {
    /// What coasts, as a word.
    pub enum Coasts {
        /// Shaft and flywheel.
        WithTheFlywheel = "with the flywheel",
        /// The shaft alone.
        Alone = "alone",
    }
}

words! {
    /// The motor after the engagement, as a word.
    pub enum MotorAfter {
        /// It stays on.
        On = "on",
        /// It is switched off.
        Off = "off",
    }
}

words! {
    /// How the weight acts on the housing, as a word.
    pub enum Housing {
        Concentric = "concentric",
        Hanging = "hanging",
    }
}

/// A test on a rig. All values are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    /// What the test does.
    pub program: RigProgram,
    /// Speed of flywheel, shaft or motor, rad/s.
    pub speed: f64,
    /// The motor.
    pub motor: RigMotor,
    /// The flywheel.
    pub flywheel: RigFlywheel,
    /// Largest torque of the clutch, N m.
    pub clutch_torque: f64,
    /// The shaft.
    pub shaft: RigShaft,
    /// The dead weight.
    pub load: RigLoad,
    /// The torque arm.
    pub arm: RigArm,
    /// Temperature and thermocouple.
    pub temperature: RigTemperature,
    /// The pickup.
    pub pickup: RigPickup,
    /// The sensor that sees the balls; none where there is none.
    pub ball_pass: Option<BallPass>,
    /// The logger.
    pub logger: Logger,
    /// The bearing under test.
    pub bearing: Bearing,
    /// What warms of it, where that is followed by a network.
    pub warm: Option<Box<Warm>>,
    /// The simulation.
    pub run: Run,
}

/// What a test does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RigProgram {
    /// The clutch joins the turning flywheel to the shaft at rest.
    SpinUp {
        /// How quickly.
        engagement: Engagement,
        /// When, s.
        engage_at: f64,
        /// When it lets go, s.
        release_at: Option<f64>,
        /// Whether the motor stays on.
        motor_stays_on: bool,
    },
    /// The shaft turns and is left alone.
    CoastDown {
        /// Whether the flywheel turns with it.
        with_flywheel: bool,
    },
    /// The motor brings all up.
    RampAndHold {
        /// Acceleration, rad/s².
        acceleration: f64,
        /// When the clutch lets go, s.
        release_at: Option<f64>,
    },
    /// Two spin-ups with a rest between them.
    RepeatAfterRest {
        /// How quickly.
        engagement: Engagement,
        /// When first, s.
        engage_at: f64,
        /// When the clutch lets go, s.
        release_at: f64,
        /// When it engages again, s.
        engage_again_at: f64,
        /// Whether the motor stays on.
        motor_stays_on: bool,
    },
}

/// How quickly a clutch engages.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Engagement {
    /// As given: rate of its torque, N m/s.
    Rate(f64),
    /// So that the shaft's largest acceleration is this, rad/s².
    PeakAcceleration(f64),
}

/// A motor with its controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigMotor {
    /// Largest torque at the flywheel, N m.
    pub torque_limit: f64,
    /// Torque per deficit of speed, N m s.
    pub gain: f64,
}

/// A flywheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigFlywheel {
    /// Moment of inertia, kg m².
    pub inertia: f64,
    /// Drag per speed, N m s.
    pub viscous_drag: f64,
}

/// A shaft on its own bearings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigShaft {
    /// Moment of inertia without the inner race under test, kg m².
    pub inertia: f64,
    /// Drag that does not depend on speed, N m.
    pub drag_torque: f64,
    /// Drag per speed, N m s.
    pub viscous_drag: f64,
}

/// The dead weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigLoad {
    /// Force on the bearing, N.
    pub radial_load: f64,
    /// Mass that moves with an outer race that hangs on the balls, kg; none where it stays in the middle.
    pub hanging_mass: Option<f64>,
}

/// A torque arm, as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigArm {
    /// Undamped natural frequency, Hz.
    pub natural_frequency: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Amplitude of the disturbance once a turn, N m.
    pub synchronous_amplitude: f64,
    /// Power of the speed with which it grows.
    pub synchronous_power: f64,
    /// Standard deviation of the noise of a value, N m.
    pub noise: f64,
    /// Reading without torque, N m.
    pub zero: f64,
    /// By how much the zero moves in the end, N m.
    pub zero_drift: f64,
    /// Time constant of that, s.
    pub drift_time: f64,
    /// By which part the reading is too large.
    pub scale_error: f64,
    /// By which part more at the end of the range.
    pub curvature: f64,
    /// End of the range, N m.
    pub range: f64,
}

/// Temperature of the outer race and the thermocouple on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigTemperature {
    /// Heat capacity of one node, J/K; none where a network follows the temperatures.
    pub heat_capacity: Option<f64>,
    /// Its conductance to the ambient, W/K.
    pub conductance: Option<f64>,
    /// Time constant of the thermocouple, s.
    pub lag: f64,
    /// Temperature at the start, K; around one node too.
    pub ambient: f64,
    /// Standard deviation of the noise of a value, K.
    pub noise: f64,
}

/// A pickup at a wheel with marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigPickup {
    /// Marks.
    pub marks: usize,
    /// Standard deviation of the place of a mark, as a part of the pitch.
    pub mark_deviation: f64,
    /// What is written of it.
    pub kind: RigPickupKind,
}

/// What the logger writes of a pickup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RigPickupKind {
    /// Samples.
    Analog {
        /// Standard deviation of the noise, as a part of the height of a pulse.
        noise: f64,
    },
    /// Instants.
    Edges {
        /// Their standard deviation, s.
        stamp_deviation: f64,
    },
}

/// A sensor that sees each ball pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallPass {
    /// Standard deviation of the place of a ball, as a part of the pitch.
    pub place_deviation: f64,
    /// Standard deviation of the noise, as a part of the height of a pulse.
    pub noise: f64,
}

words! {
/// Format of a raw file.
pub enum RawFormat {
    Tdms = "tdms",
    /// Text in columns.
    Csv = "csv",
    Parquet = "parquet",
}
}

/// The converter and its file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Logger {
    /// Format of the file.
    pub format: RawFormat,
    /// Values a second of all channels together, Hz.
    pub total_rate: f64,
    /// Bits over the range of a channel.
    pub bits: u32,
    /// Seed of everything random.
    pub seed: u64,
}

impl Rig {
    pub(crate) fn from_values(values: &Values) -> Rig {
        let (rig, motor, flywheel) = (
            values.section("rig"),
            values.section("rig.motor"),
            values.section("rig.flywheel"),
        );
        let (clutch, shaft, load) = (
            values.section("rig.clutch"),
            values.section("rig.shaft"),
            values.section("rig.load"),
        );
        let (arm, temperature, logger) = (
            values.section("rig.arm"),
            values.section("rig.temperature"),
            values.section("rig.logger"),
        );
        Rig {
            program: program(&rig, &motor, &clutch),
            speed: rig.number("speed"),
            motor: RigMotor {
                torque_limit: motor.number("torque_limit"),
                gain: motor.number("gain"),
            },
            flywheel: RigFlywheel {
                inertia: flywheel.number("inertia"),
                viscous_drag: flywheel.number("viscous_drag"),
            },
            clutch_torque: clutch.number("largest_torque"),
            shaft: RigShaft {
                inertia: shaft.number("inertia"),
                drag_torque: shaft.number("drag_torque"),
                viscous_drag: shaft.number("viscous_drag"),
            },
            load: RigLoad {
                radial_load: load.number("radial_load"),
                hanging_mass: match load.choice("housing") {
                    Housing::Concentric => None,
                    Housing::Hanging => Some(load.number("mass")),
                },
            },
            arm: RigArm {
                natural_frequency: arm.number("natural_frequency"),
                damping_ratio: arm.number("damping_ratio"),
                synchronous_amplitude: arm.number("synchronous_amplitude"),
                synchronous_power: arm.number("synchronous_power"),
                noise: arm.number("noise"),
                zero: arm.number("zero"),
                zero_drift: arm.number("zero_drift"),
                drift_time: arm.number("drift_time"),
                scale_error: arm.number("scale_error"),
                curvature: arm.number("curvature"),
                range: arm.number("range"),
            },
            temperature: RigTemperature {
                heat_capacity: temperature.maybe("heat_capacity"),
                conductance: temperature.maybe("conductance"),
                lag: temperature.number("lag"),
                ambient: (temperature.maybe("ambient"))
                    .unwrap_or_else(|| values.section("heat").number("start_temperature")),
                noise: temperature.number("noise"),
            },
            pickup: pickup(&values.section("rig.pickup")),
            ball_pass: ball_pass(&values.section("rig.ball_pass")),
            logger: Logger {
                format: logger.choice("file"),
                total_rate: logger.number("total_rate"),
                bits: logger.count("bits") as u32,
                seed: logger.count("seed"),
            },
            warm: (values.chosen("heat.network") == Some(Network::On))
                .then(|| Warm::from_values(values, load.number("radial_load")).on_rotor(true))
                .map(Box::new),
            bearing: bearing(values),
            run: Run::from_values(values),
        }
    }
}

fn program(rig: &Section<'_>, motor: &Section<'_>, clutch: &Section<'_>) -> RigProgram {
    let engagement = || match clutch.maybe("torque_rate") {
        Some(rate) => Engagement::Rate(rate),
        None => Engagement::PeakAcceleration(rig.number("peak_acceleration")),
    };
    let motor_stays_on = || motor.choice::<MotorAfter>("after_engagement") == MotorAfter::On;
    match rig.choice("program") {
        ProgramKind::CoastDown => RigProgram::CoastDown {
            with_flywheel: rig.choice::<Coasts>("coasts") == Coasts::WithTheFlywheel,
        },
        ProgramKind::RampAndHold => RigProgram::RampAndHold {
            acceleration: rig.number("acceleration"),
            release_at: rig.maybe("release_at"),
        },
        ProgramKind::RepeatAfterRest => RigProgram::RepeatAfterRest {
            engagement: engagement(),
            engage_at: rig.number("engage_at"),
            release_at: rig.number("first_release_at"),
            engage_again_at: rig.number("engage_again_at"),
            motor_stays_on: motor_stays_on(),
        },
        ProgramKind::SpinUp => RigProgram::SpinUp {
            engagement: engagement(),
            engage_at: rig.number("engage_at"),
            release_at: rig.maybe("release_at"),
            motor_stays_on: motor_stays_on(),
        },
    }
}

fn pickup(section: &Section<'_>) -> RigPickup {
    RigPickup {
        marks: section.count("marks") as usize,
        mark_deviation: section.number("mark_deviation"),
        kind: match section.choice("kind") {
            PickupOutput::Edges => RigPickupKind::Edges {
                stamp_deviation: section.number("stamp_deviation"),
            },
            PickupOutput::Analog => RigPickupKind::Analog {
                noise: section.number("noise"),
            },
        },
    }
}

fn ball_pass(section: &Section<'_>) -> Option<BallPass> {
    section.switch("fitted").then(|| BallPass {
        place_deviation: section.number("place_deviation"),
        noise: section.number("noise"),
    })
}
