//! The part of the table of keys that describes a test rig and what its logger writes.

use crate::key::{Condition, Key, Kind, Presence, Range, Section};
use crate::rig::Coasts;
use crate::rig::Housing;
use crate::rig::MotorAfter;
use crate::rig::ProgramKind;
use crate::rig::RawFormat;
use crate::signals::PickupOutput;
use crate::system::RIG;
use problem::words::Words;

/// Where no network follows the temperatures.
const ONE_NODE: &[Condition] =
    &[Condition::new("heat.network", &["off"]).because("the network of [heat] follows them")];

/// What a rig does without keys that it shares with other systems.
pub const PRESENCES: &[(&str, Presence)] = &[
    (
        "run.duration",
        Presence::convention(
            "6 s",
            "a spin-up, and the seconds in which grease and films settle",
        ),
    ),
    (
        "run.tolerance",
        Presence::convention(
            "5e-5",
            "there the energies of the shipped rig tests close to a millionth of what is turned over",
        ),
    ),
    (
        "run.output_interval",
        Presence::convention(
            "1 ms",
            "6000 rows for the default duration; the raw file has the rates of its logger",
        ),
    ),
];

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[
    Section::new("rig", "A test on a rig: motor and belt, flywheel, clutch, shaft with the bearing under test, torque arm. The outer race carries the dead weight and is held by the arm.", RIG),
    Section::new("rig.motor", "The motor and its belt: it turns the flywheel by a controller of its speed.", RIG),
    Section::new("rig.flywheel", "The flywheel with pulley and driving half of the clutch.", RIG),
    Section::new("rig.clutch", "The clutch: the torque it can carry rises from its engagement on; it slips until both sides turn at the same speed, and again where it is asked for more.", RIG),
    Section::new("rig.shaft", "The shaft with the driven half of the clutch, on its own bearings; the inner race of the bearing under test comes on top.", RIG),
    Section::new("rig.load", "The dead weight that hangs on the housing of the bearing under test.", RIG),
    Section::new("rig.arm", "The torque arm or load cell that holds the housing, as it is; the file for auxbear signals states what a lab would know of it.", RIG),
    Section::new("rig.temperature", "Temperature of the bearing's outer race and the thermocouple on it: one node where heat.network = \"off\", else the outer race of that network.", RIG),
    Section::new("rig.pickup", "The optical pickup at a wheel with marks on the shaft.", RIG),
    Section::new("rig.ball_pass", "A sensor at the outer race that sees each ball pass.", RIG),
    Section::new("rig.logger", "The converter and the file it writes: its channels are taken in turn, tacho, torque, ball_pass, temperature, as far as they are there.", RIG),
];

const fn program(words: &'static [&'static str]) -> Condition {
    Condition::new("rig.program", words)
}

const ENGAGES: &[Condition] = &[program(&["spin-up", "repeat after rest"])];
const RELEASES: &[Condition] = &[program(&["spin-up", "ramp and hold"])];
const COASTS: &[Condition] = &[program(&["coast-down"])];
const RAMPS: &[Condition] = &[program(&["ramp and hold"])];
const REPEATS: &[Condition] = &[program(&["repeat after rest"])];
const HANGS: &[Condition] = &[Condition::new("rig.load.housing", &["hanging"])];
const SAMPLED: &[Condition] = &[Condition::new("rig.pickup.kind", &["analog"])];
const STAMPED: &[Condition] = &[Condition::new("rig.pickup.kind", &["edges"])];
const WITH_BALL_PASS: &[Condition] = &[Condition::new("rig.ball_pass.fitted", &["true"])];

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("rig.program", Kind::Word(ProgramKind::WORDS), "spin-up", "What the test does: spin-up, the clutch joins the turning flywheel to the shaft at rest; coast-down, the shaft turns with rolling balls and is left alone; ramp and hold, the motor brings all up slowly; repeat after rest, two spin-ups with a rest between them."),
    Key::new("rig.speed", Kind::Quantity("rad/s"), "150 rad/s", "Speed of the flywheel when the clutch engages, which the shaft comes close to; of the shaft at the start of a coast-down; of the motor at the end of a ramp.")
        .positive(),
    Key::new("rig.peak_acceleration", Kind::Quantity("rad/s^2"), "7200 rad/s^2", "Largest acceleration of the shaft that is wanted: the rate of the clutch's torque is found for it. Give this or rig.clutch.torque_rate.")
        .positive().when(ENGAGES),
    Key::new("rig.engage_at", Kind::Quantity("s"), "0.2 s", "When the clutch engages.")
        .positive().default("0.2 s", "a rest before it shows the zero of the torque").when(ENGAGES),
    Key::new("rig.release_at", Kind::Quantity("s"), "5.2 s", "When the clutch lets go, so that the shaft runs down by itself.")
        .positive().optional("the clutch stays engaged to the end").when(RELEASES),
    Key::new("rig.first_release_at", Kind::Quantity("s"), "2 s", "When the clutch lets go after the first spin-up.").positive().when(REPEATS),
    Key::new("rig.engage_again_at", Kind::Quantity("s"), "5 s", "When it engages the second time.").positive().when(REPEATS),
    Key::new("rig.coasts", Kind::Word(Coasts::WORDS), "with the flywheel", "What coasts down: the shaft with the flywheel, for tens of seconds, or the shaft alone.")
        .default("with the flywheel", "a coast-down so gradual that inertia of balls and cage hardly shows").when(COASTS),
    Key::new("rig.acceleration", Kind::Quantity("rad/s^2"), "50 rad/s^2", "Acceleration of the motor's speed.").positive().when(RAMPS),
    Key::new("rig.motor.torque_limit", Kind::Quantity("N m"), "10 N m", "Largest torque of the motor at the flywheel.")
        .positive().assumed("10 N m", "a small motor behind a belt"),
    Key::new("rig.motor.gain", Kind::Quantity("N m s"), "0.5 N m s", "Torque of its controller per deficit of speed.")
        .positive().assumed("0.5 N m s", "settles a flywheel of 0.05 kg m² within a few tenths of a second"),
    Key::new("rig.motor.after_engagement", Kind::Word(MotorAfter::WORDS), "on", "Whether the motor stays on when the clutch has engaged.")
        .default("on", "the speed is held during the seconds that are looked at").when(ENGAGES),
    Key::new("rig.flywheel.inertia", Kind::Quantity("kg m^2"), "0.05 kg m^2", "Moment of inertia about its axis.")
        .positive().assumed("0.05 kg m^2", "a steel disc of 250 mm and 17 mm"),
    Key::new("rig.flywheel.viscous_drag", Kind::Quantity("N m s"), "0.2 mN m s", "Drag of belt and flywheel bearings per speed.")
        .not_negative().assumed("0.2 mN m s", "30 N mm at 150 rad/s: a belt and two small bearings"),
    Key::new("rig.clutch.torque_rate", Kind::Quantity("N m/s"), "200 N m/s", "Rate at which the torque that the clutch can carry rises from its engagement on.")
        .positive().optional("it is found for rig.peak_acceleration").excludes("rig.peak_acceleration").when(ENGAGES),
    Key::new("rig.clutch.largest_torque", Kind::Quantity("N m"), "40 N m", "Torque that it can carry when fully engaged.")
        .positive().assumed("40 N m", "three times what brings the shaft up at 11 500 rad/s²"),
    Key::new("rig.shaft.inertia", Kind::Quantity("kg m^2"), "1e-3 kg m^2", "Moment of inertia of shaft, driven half of the clutch and wheel, without the inner race under test.")
        .positive().assumed("1e-3 kg m^2", "a steel shaft of 25 mm with the half of a small clutch"),
    Key::new("rig.shaft.drag_torque", Kind::Quantity("N m"), "10 N mm", "Drag of the shaft's own bearings that does not depend on speed.")
        .not_negative().assumed("10 N mm", "two small greased bearings"),
    Key::new("rig.shaft.viscous_drag", Kind::Quantity("N m s"), "0.1 mN m s", "Drag of the shaft's own bearings per speed.")
        .not_negative().assumed("0.1 mN m s", "15 N mm at 150 rad/s"),
    Key::new("rig.load.radial_load", Kind::Quantity("N"), "60 N", "Weight that the bearing under test carries, housing included.").positive(),
    Key::new("rig.load.housing", Kind::Word(Housing::WORDS), "concentric", "Whether the outer race is taken to stay in the middle, as the equations of the rig do, or hangs on the balls, free to move in the plane.")
        .default("concentric", "the rig of the equations: t_I - t_O = dL/dt"),
    Key::new("rig.load.mass", Kind::Quantity("kg"), "6 kg", "Mass that moves with the outer race: housing and what hangs stiffly on it.")
        .positive().when(HANGS),
    Key::new("rig.arm.natural_frequency", Kind::Quantity("Hz"), "30 Hz", "Undamped natural frequency of the housing on the arm.")
        .positive().assumed("30 Hz", "with the damping below it settles to 2 % in 0.1 s, as the source paper's does"),
    Key::new("rig.arm.damping_ratio", Kind::Coefficient, "0.2074", "Its damping ratio.")
        .within(Range::FromTo(1e-3, 10.0)).assumed("0.2074", "39.1 1/s over the natural frequency of 30 Hz"),
    Key::new("rig.arm.synchronous_amplitude", Kind::Quantity("N m"), "4 N mm", "Amplitude of the disturbance once a turn at rig.speed, as a torque before the arm amplifies it.")
        .not_negative().default("0 N m", "nothing of it"),
    Key::new("rig.arm.synchronous_power", Kind::Coefficient, "2", "Power of the speed with which it grows: 2 for unbalance, 0 for run-out.")
        .within(Range::FromTo(0.0, 4.0)).default("2", "an unbalance"),
    Key::new("rig.arm.noise", Kind::Quantity("N m"), "1 N mm", "Standard deviation of the noise of one value.")
        .not_negative().default("0 N m", "nothing of it"),
    Key::new("rig.arm.zero", Kind::Quantity("N m"), "0.3 N mm", "Reading without torque.").default("0 N m", "nothing of it"),
    Key::new("rig.arm.zero_drift", Kind::Quantity("N m"), "5 N mm", "By how much the zero has moved long after the start of the motion: the warming of the strain gauges.")
        .default("0 N m", "nothing of it"),
    Key::new("rig.arm.drift_time", Kind::Quantity("s"), "1.5 s", "Time constant of that drift.")
        .positive().default("1.5 s", "without effect where nothing drifts"),
    Key::new("rig.arm.scale_error", Kind::Coefficient, "0.003", "By which part the reading is too large.")
        .within(Range::FromTo(-0.5, 0.5)).default("0", "a sensor as it was calibrated"),
    Key::new("rig.arm.curvature", Kind::Coefficient, "0.01", "By which part more the reading is too large at the end of its range: a sensor that is not linear.")
        .within(Range::FromTo(-0.5, 0.5)).default("0", "a linear sensor"),
    Key::new("rig.arm.range", Kind::Quantity("N m"), "0.2 N m", "Torque at the end of the converter's range, to both sides.")
        .positive().assumed("0.2 N m", "several times the torque of a small greased bearing"),
    Key::new("rig.pickup.marks", Kind::Count, "60", "Marks of the wheel.")
        .within(Range::FromTo(1.0, 10_000.0)).default("60", "the fewest that resolve a spin-up of 25 ms"),
    Key::new("rig.pickup.mark_deviation", Kind::Coefficient, "0.01", "Standard deviation of the place of a mark, as a part of the pitch between two.")
        .within(Range::FromTo(0.0, 0.2)).default("0.01", "a printed wheel"),
    Key::new("rig.pickup.kind", Kind::Word(PickupOutput::WORDS), "analog", "What the logger writes of it: analog, samples of its signal; edges, the instant of each mark by a counter.")
        .default("analog", "the source paper's converter"),
    Key::new("rig.pickup.noise", Kind::Coefficient, "0.01", "Standard deviation of the noise of a sample, as a part of the height of a pulse.")
        .within(Range::FromTo(0.0, 0.3)).default("0.01", "an optical pickup").when(SAMPLED),
    Key::new("rig.pickup.stamp_deviation", Kind::Quantity("s"), "0.3 us", "Standard deviation of an instant.")
        .positive().default("0.3 us", "a counter of 1 MHz").when(STAMPED),
    Key::new("rig.ball_pass.fitted", Kind::Switch, "true", "Whether there is such a sensor.")
        .default("true", "without one the slip of the cage stays unknown"),
    Key::new("rig.ball_pass.place_deviation", Kind::Coefficient, "0.02", "Standard deviation of the place of a ball, as a part of the pitch between two: pockets leave them some play.")
        .within(Range::FromTo(0.0, 0.2)).default("0.02", "a pocket that is 0.2 mm wider than its ball at the pitch circle of a 6005").when(WITH_BALL_PASS),
    Key::new("rig.ball_pass.noise", Kind::Coefficient, "0.05", "Standard deviation of the noise of a sample, as a part of the height of a pulse.")
        .within(Range::FromTo(0.0, 0.3)).default("0.05", "an inductive sensor").when(WITH_BALL_PASS),
    Key::new("rig.logger.file", Kind::Word(RawFormat::WORDS), "tdms", "Format of the raw file.").default("tdms", "what a laboratory's logger writes"),
    Key::new("rig.logger.total_rate", Kind::Quantity("Hz"), "42 kHz", "Values a second of all channels together; they are taken in turn.")
        .within(Range::FromTo(100.0, 1e8)).default("42 kHz", "the source paper's converter"),
    Key::new("rig.logger.bits", Kind::Count, "14", "Bits of the converter over each channel's range.")
        .within(Range::FromTo(4.0, 32.0)).default("14", "the source paper's converter"),
    Key::new("rig.logger.seed", Kind::Count, "1", "Seed of noise and of the places of marks.")
        .default("1", "any number; the same seed gives the same file"),
];

/// What the starting file gives.
pub const GIVEN: &[&str] = &[
    "bearing.operating_diametral_clearance",
    "bearing.moment.law",
    "bearing.moment.lubrication",
    "bearing.moment.viscosity",
    "rig.peak_acceleration",
    "rig.release_at",
    "rig.arm.natural_frequency",
    "rig.arm.damping_ratio",
    "rig.arm.synchronous_amplitude",
    "rig.arm.noise",
];

/// Temperature and thermocouple, after the keys that say whether a network follows the one.
#[rustfmt::skip]
pub const TEMPERATURE: &[Key] = &[
    Key::new("rig.temperature.heat_capacity", Kind::Quantity("J/K"), "100 J/K", "Heat capacity of what warms with the outer race.")
        .positive().assumed("100 J/K", "200 g of steel").when(ONE_NODE),
    Key::new("rig.temperature.conductance", Kind::Quantity("W/K"), "0.5 W/K", "Heat that leaves it per kelvin above the ambient.")
        .not_negative().assumed("0.5 W/K", "a small housing in still air").when(ONE_NODE),
    Key::new("rig.temperature.ambient", Kind::Quantity("K"), "25 degC", "Temperature at the start, and around.")
        .positive().default("25 degC", "a laboratory").when(ONE_NODE),
    Key::new("rig.temperature.lag", Kind::Quantity("s"), "2 s", "Time constant of the thermocouple.").positive().assumed("2 s", "a bead under a screw"),
    Key::new("rig.temperature.noise", Kind::Quantity("K"), "0.1 K", "Standard deviation of the noise of one value.")
        .not_negative().default("0.1 K", "a thermocouple behind an amplifier"),
];
