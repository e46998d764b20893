//! The part of the table of keys that describes what a measurement holds and what is computed from it.

use crate::key::{Condition, Key, Kind, Range, Section};
use crate::signals::Automatic;
use crate::signals::CageOutput;
use crate::signals::Disturbance;
use crate::signals::PickupFlank;
use crate::signals::SpeedOutput;
use crate::system::SIGNALS;
use problem::words::Words;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[
    Section::new("signals", "The measurement. A channel that is not named is not looked at; what needs a channel that is not named is not computed.", SIGNALS),
    Section::new("signals.speed", "A pickup at a wheel with marks on the shaft, or a speed that a drive, a converter or a tachometer shows: angle, speed and acceleration.", SIGNALS),
    Section::new("signals.torque", "A torque arm or another sensor that swings: the torque it felt. The shaft's speed is used where it is known.", SIGNALS),
    Section::new("signals.cage", "A sensor that sees the balls pass, or a vibration that holds their line: speed and slip of the cage. It needs the shaft's speed.", SIGNALS),
    Section::new("signals.temperature", "A thermometer at the outer race.", SIGNALS),
];

const MARKED: Condition =
    Condition::new("signals.speed.kind", &["analog", "edges"]).because("a speed has no marks");
const SHOWN: Condition = Condition::new("signals.speed.kind", &["speed"]);
const STAMPED: Condition = Condition::new("signals.speed.kind", &["edges"]);
const VIBRATION: Condition = Condition::new("signals.cage.kind", &["vibration"]);

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("signals.file", Kind::Text, "measurement.tdms", "Measurement file, relative to this one: TDMS, UFF 58, CSV, MAT, HDF5, Parquet or WAV, recognised by its content."),
    Key::new("signals.from", Kind::Quantity("s"), "2 s", "Where the part of the record begins that is looked at, on the clock of the file.")
        .optional("the record is read from its start"),
    Key::new("signals.to", Kind::Quantity("s"), "12 s", "Where that part ends.").optional("the record is read to its end"),
    Key::new("signals.sample_interval", Kind::Quantity("s"), "0.1 ms", "Time between values of a channel of which the file states no clock.")
        .positive().optional("a channel without a clock is refused"),
    Key::new("signals.time_unit", Kind::Word(&["s", "ms", "us", "ns", "min"]), "s", "Unit of a column of times, or of instants, of which the file states none.")
        .optional("times without a unit are refused"),
    Key::new("signals.channel_delay", Kind::Quantity("s"), "23.8 us", "How much later than the channel before it in the file each channel is taken, by a converter that takes its channels in turn.")
        .not_negative().default("0 s", "channels that are taken at once"),
    Key::new("signals.radial_load", Kind::Quantity("N"), "60 N", "Weight on the bearing in this test: what auxbear identify needs to know of it.")
        .positive().optional("auxbear identify takes its own identify.radial_load"),
    Key::new("signals.rest_before", Kind::Quantity("s"), "5 s", "Time at rest before this test, where a test before it had run the bearing like this: what auxbear identify takes grease and sensor to have recovered in.")
        .not_negative().optional("the bearing had rested for long"),
    Key::new("signals.speed.channel", Kind::Text, "tacho", "Name of the channel as in the file; with its group where the file has groups, as in \"group/tacho\"; \"tacho#2\" is the second one of a name.")
        .optional("no speed is computed"),
    Key::new("signals.speed.kind", Kind::Word(SpeedOutput::WORDS), "analog", "What the channel holds: analog, samples of the pickup's signal; edges, the instant of each mark; speed, a speed in rpm, rad/s or Hz of turning.")
        .default("analog", "a pickup on a channel of its own"),
    Key::new("signals.speed.marks_per_revolution", Kind::Count, "60", "Marks of the wheel, the left-out ones included.")
        .within(Range::FromTo(1.0, 100_000.0)).when(&[MARKED]).optional("it is needed with signals.speed.channel"),
    Key::new("signals.speed.missing_marks", Kind::Count, "2", "Neighbouring marks that were left out as a reference.")
        .when(&[MARKED]).default("0", "a full wheel"),
    Key::new("signals.speed.flank", Kind::Word(PickupFlank::WORDS), "rising", "Which flank of a pulse marks the passage; centre is the middle between both. With kind = \"edges\" it counts for a line of 0 and 1 with times.")
        .when(&[MARKED]).default("rising", "one flank has one error of the pickup, two have two"),
    Key::new("signals.speed.stamp_deviation", Kind::Quantity("s"), "0.3 us", "Standard deviation of an instant: for a counter its step divided by the root of 12.")
        .positive().when(&[STAMPED]),
    Key::new("signals.speed.scale", Kind::Quantity("rad/s"), "1 rpm", "Speed of one unit of the channel, where the file gives no unit or none of a speed: \"1 rpm\"; \"60 rpm\" for Hz of turning; \"300 rpm\" for a converter of 300 rpm a volt.")
        .positive().when(&[SHOWN]).optional("the unit of the file counts, which must be rpm, rad/s or Hz"),
    Key::new("signals.speed.bandwidth", Kind::Quantity("Hz"), "1 kHz", "Frequency at which the instrument, as a low-pass of first order, leaves 0.707 of an amplitude; of a time constant T it is 0.159/T.")
        .positive().when(&[SHOWN]).optional("the instrument counts as unlimited, and a quick change is warned of"),
    Key::new("signals.speed.delay", Kind::Quantity("s"), "5 ms", "Time by which the instrument shows everything late, beside its low-pass: the half of a mean over a time, the cycle of a bus.")
        .not_negative().when(&[SHOWN]).default("0 s", "an analog converter has none beside its low-pass"),
    Key::new("signals.speed.resolution", Kind::Quantity("rad/s"), "0.5 rpm", "Smallest step of what the instrument shows: for 12 bits the range over 4096.")
        .positive().when(&[SHOWN]).optional("as the values show it"),
    Key::new("signals.speed.noise", Kind::Quantity("rad/s"), "0.5 rpm", "Standard deviation of the noise of one value.")
        .positive().when(&[SHOWN]).optional("as the values show it"),
    Key::new("signals.speed.set_speed", Kind::Quantity("rad/s"), "1432 rpm", "Largest speed that the test was to reach, as set at the drive: a wrong number of marks or unit shows beside it.")
        .positive().optional("the largest speed is not checked"),
    Key::new("signals.speed.quick_change", Kind::Word(Automatic::WORDS), "auto", "Whether one quick change of speed, such as a clutch that engages, is looked for.")
        .default("auto", "it is found where there is one"),
    Key::new("signals.speed.change_from", Kind::Quantity("s"), "4.9 s", "Where the quick change is looked for begins, on the clock of the file: says which one, where a record holds several.")
        .optional("the steepest rise of speed is taken"),
    Key::new("signals.speed.change_to", Kind::Quantity("s"), "5.4 s", "Where that part ends.").optional("it is needed with signals.speed.change_from"),
    Key::new("signals.speed.calibration", Kind::Word(Automatic::WORDS), "auto", "Whether the errors of the marks are found from revolutions at even speed and taken out.")
        .when(&[MARKED]).default("auto", "no wheel is even; where no revolution is even enough, none are taken out"),
    Key::new("signals.speed.ripple", Kind::Quantity("rad/s^2"), "3 rad/s^2", "Standard deviation of an acceleration once a turn while the marks are calibrated, from unbalance under gravity or a belt: it cannot be separated from an eccentric wheel.")
        .not_negative().when(&[MARKED]).default("0 rad/s^2", "a shaft that runs evenly"),
    Key::new("signals.speed.delay_deviation", Kind::Quantity("s"), "5 us", "Standard deviation of a delay that all pulses, or all values of a speed, have in common, from pickup and filter; they cannot show it.")
        .not_negative().default("0 s", "a pickup without a filter"),
    Key::new("signals.speed.wanted", Kind::Coefficient, "0.03", "Largest uncertainty of the acceleration in the quick change, as a part of its peak; pulses that cannot carry it are refused with the number of marks that could.")
        .positive().optional("what the pulses carry is taken"),
    Key::new("signals.torque.channel", Kind::Text, "torque", "Name of the channel as in the file.").optional("no torque is computed"),
    Key::new("signals.torque.scale", Kind::Quantity("N m"), "1 N mm", "Torque of one unit of the channel, where the file gives no unit or none of a torque; below 0 for a sensor that reads the other way round, as \"-1 N mm\" of a channel in N mm.")
        .optional("the unit of the file counts, which must be one of a torque"),
    Key::new("signals.torque.sensor_frequency", Kind::Quantity("Hz"), "30 Hz", "Undamped natural frequency of the sensor with what it carries. Give this with the damping ratio, or a tap.")
        .positive().optional("a tap measures it; without either the reading is shown, and slow runs are read from it, but no torque without its swing").excludes("signals.torque.tap_file"),
    Key::new("signals.torque.damping_ratio", Kind::Coefficient, "0.2", "Damping ratio of the sensor.")
        .within(Range::FromTo(0.0, 10.0)).optional("a tap measures it; without either the reading is shown, and slow runs are read from it, but no torque without its swing").excludes("signals.torque.tap_file"),
    Key::new("signals.torque.frequency_deviation", Kind::Coefficient, "0.005", "Relative standard deviation of sensor_frequency.")
        .not_negative().assumed("0.01", "a frequency read from a plot of a tap"),
    Key::new("signals.torque.damping_deviation", Kind::Coefficient, "0.03", "Relative standard deviation of damping_ratio.")
        .not_negative().assumed("0.05", "a damping read from a few swings"),
    Key::new("signals.torque.tap_file", Kind::Text, "tap.tdms", "Measurement file, relative to this one, in which the sensor swings freely after a tap or a step.")
        .optional("the sensor is as given"),
    Key::new("signals.torque.tap_channel", Kind::Text, "torque", "Name of its channel.").optional("it is signals.torque.channel"),
    Key::new("signals.torque.tap_start", Kind::Quantity("s"), "0.4 s", "Time from the first value of that channel from which on no force acts.")
        .not_negative().optional("it is found from the rest before a tap or a step"),
    Key::new("signals.torque.disturbance", Kind::Word(Disturbance::WORDS), "auto", "How the disturbance once a turn grows: with the square of the speed, not at all, as the data choose, or there is none. It needs the shaft's speed.")
        .default("auto", "the likelihood of the reading chooses"),
    Key::new("signals.torque.scale_deviation", Kind::Coefficient, "0.002", "Relative standard deviation of the sensor's calibration, linearity included.")
        .not_negative().assumed("0.005", "a usual load cell"),
    Key::new("signals.torque.zero_deviation", Kind::Quantity("N m"), "0.5 N mm", "Standard deviation of the zero of the reading, where it was set before.")
        .not_negative().optional("the zero may be anywhere in the reading: only a shaft that rests at first shows it"),
    Key::new("signals.torque.design_until", Kind::Quantity("s"), "0.3 s", "Time after the engagement for which the error of the torque is shown over the frequency that the sensor might have had: the picture by which a torque arm is chosen. It takes seconds.")
        .positive().optional("that picture is not drawn"),
    Key::new("signals.torque.highest_frequency", Kind::Quantity("Hz"), "200 Hz", "Highest frequency of the spectrum of the reading, at most half of the sampling rate; the lower it is, the finer the lines.")
        .positive().optional("as far as the reading holds lines, and behind the sensor's frequency and the shaft's first orders"),
    Key::new("signals.cage.channel", Kind::Text, "ball_pass", "Name of the channel as in the file.").optional("no cage speed is computed"),
    Key::new("signals.cage.kind", Kind::Word(CageOutput::WORDS), "passings", "What the channel holds: passings, samples of a sensor that sees each ball; edges, the instant of each passing; vibration, a signal with a line at ball pass.")
        .default("passings", "the sensor that shows the cage most directly"),
    Key::new("signals.cage.ball_count", Kind::Count, "10", "Number of balls.")
        .within(Range::FromTo(1.0, 10_000.0)).optional("it is needed with signals.cage.channel"),
    Key::new("signals.cage.rolling_ratio", Kind::Coefficient, "0.4", "Speed of the cage over that of the shaft where the balls roll.")
        .within(Range::FromTo(1e-3, 1.0)).optional("it is needed with signals.cage.channel"),
    Key::new("signals.cage.highest_slip", Kind::Coefficient, "0.2", "Highest slip that is looked for; the lowest is -0.02, which allows for a ratio that is not exact.")
        .within(Range::FromTo(0.01, 1.0)).when(&[VIBRATION]).default("0.2", "slip of a loaded bearing after its spin-up"),
];

/// Keys of the thermometer, the last of the page.
pub const TEMPERATURE: &[Key] = &[Key::new(
    "signals.temperature.channel",
    Kind::Text,
    "temperature",
    "Name of the channel as in the file; its unit must be one of a temperature.",
)
.optional("no temperature is read")];

/// What the starting file asks for.
pub const GIVEN: &[&str] = &[
    "signals.speed.channel",
    "signals.speed.marks_per_revolution",
    "signals.torque.channel",
    "signals.torque.sensor_frequency",
    "signals.torque.damping_ratio",
];

/// Keys that name a file beside this one.
pub const FILES: &[&str] = &[
    "signals.file",
    "signals.torque.tap_file",
    "signals.steady.windage_file",
];
