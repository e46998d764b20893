//! A measurement and what is computed from it, as typed values in SI.

pub mod analysis;
pub mod checks;
pub mod keys;
pub mod keys_analysis;

use crate::signals::analysis::{ConverterSignal, SteadySignal, VibrationSignal};
use crate::values::Values;
use problem::words;
use std::path::PathBuf;

/// A measurement and what is computed from it. All values are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Signals {
    /// The file.
    pub file: PathBuf,
    /// Begin of the part that is looked at, s.
    pub from: Option<f64>,
    /// Its end, s.
    pub to: Option<f64>,
    /// Interval of channels without a clock, s.
    pub sample_interval: Option<f64>,
    /// Unit of times of which the file tells none.
    pub time_unit: Option<String>,
    /// Delay from each channel of the file to the next, s.
    pub channel_delay: f64,
    /// Speed of the shaft.
    pub speed: Option<SpeedSignal>,
    /// Torque.
    pub torque: Option<TorqueSignal>,
    /// Speed of the cage.
    pub cage: Option<CageSignal>,
    /// Weight on the bearing, N.
    pub radial_load: Option<f64>,
    /// Time at rest since a test before this one, s.
    pub rest_before: Option<f64>,
    /// Name of the channel with the temperature of the outer race.
    pub temperature: Option<String>,
    /// The converter.
    pub converter: Option<ConverterSignal>,
    /// A vibration.
    pub vibration: Option<VibrationSignal>,
    /// Slow runs.
    pub steady: Option<SteadySignal>,
}

/// A pickup at a wheel with marks, or an instrument that shows a speed.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedSignal {
    /// Name of the channel.
    pub channel: String,
    /// What it holds.
    pub kind: PickupKind,
    /// Marks of the wheel, the left-out ones included; none of a speed.
    pub marks_per_revolution: usize,
    /// Marks left out.
    pub missing_marks: usize,
    /// Whether a quick change is looked for.
    pub quick_change: bool,
    /// Where it is looked for begins, s.
    pub change_from: Option<f64>,
    /// Where that ends, s.
    pub change_to: Option<f64>,
    /// Whether the errors of the marks are taken out.
    pub calibration: bool,
    /// Acceleration once a turn during the calibration, rad/s².
    pub ripple: f64,
    /// Standard deviation of a common delay, s.
    pub delay_deviation: f64,
    /// Largest uncertainty of the acceleration, as a part of its peak.
    pub wanted: Option<f64>,
    /// Largest speed that the test was to reach, rad/s.
    pub set_speed: Option<f64>,
}

words! {
    /// What the channel of a pickup holds, as a word.
    pub enum PickupOutput {
        /// Samples.
        Analog = "analog",
        /// Instants.
        Edges = "edges",
    }
}

words! {
    /// What the channel of a speed holds, as a word.
    pub enum SpeedOutput {
        /// Samples of a pickup.
        Analog = "analog",
        /// Instants of marks.
        Edges = "edges",
        Speed = "speed",
    }
}

words! {
    /// What the channel of a cage holds, as a word.
    pub enum CageOutput {
        /// Samples.
        Passings = "passings",
        /// Instants.
        Edges = "edges",
        Vibration = "vibration",
    }
}

words! {
    /// Whether something is done, as a word.
    pub enum Automatic {
        /// Where the data ask for it.
        Auto = "auto",
        /// Never.
        None = "none",
    }
}

/// What the channel of a pickup holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PickupKind {
    /// Samples.
    Analog {
        /// The flank that marks the passage.
        flank: PickupFlank,
    },
    /// Instants.
    Edges {
        /// Their standard deviation, s.
        stamp_deviation: f64,
        /// Of a line of 0 and 1, the flank that marks the passage.
        flank: PickupFlank,
    },
    /// A speed that an instrument shows.
    Speed {
        /// Speed of one unit of the channel, rad/s.
        scale: Option<f64>,
        /// Frequency of its first-order low-pass, Hz.
        bandwidth: Option<f64>,
        /// Its delay, s.
        delay: f64,
        /// Smallest step that it shows, rad/s.
        resolution: Option<f64>,
        /// Standard deviation of the noise of one value, rad/s.
        noise: Option<f64>,
    },
}

words! {
/// Which flank of a pulse marks the passage.
pub enum PickupFlank {
    /// From low to high.
    Rising = "rising",
    /// From high to low.
    Falling = "falling",
    Both = "both",
    /// The middle between both.
    Centre = "centre",
}
}

/// A torque sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct TorqueSignal {
    /// Name of the channel.
    pub channel: String,
    /// Torque of one unit of the channel, N m.
    pub scale: Option<f64>,
    /// The sensor; none where its reading is taken as it is.
    pub sensor: Option<SensorSource>,
    /// The disturbance once a turn.
    pub disturbance: Disturbance,
    /// Relative standard deviation of the calibration.
    pub scale_deviation: f64,
    /// Standard deviation of the zero, N m.
    pub zero_deviation: Option<f64>,
    /// Time after the engagement for which sensors of other frequencies are compared, s.
    pub design_until: Option<f64>,
    /// Where its spectrum ends, Hz.
    pub highest_frequency: Option<f64>,
}

/// How a sensor is known.
#[derive(Clone, Debug, PartialEq)]
pub enum SensorSource {
    /// As given.
    Given {
        /// Undamped natural frequency, Hz.
        sensor_frequency: f64,
        /// Its relative standard deviation.
        frequency_deviation: f64,
        /// Damping ratio.
        damping_ratio: f64,
        /// Its relative standard deviation.
        damping_deviation: f64,
    },
    /// From its free response.
    Tap {
        /// The file.
        tap_file: PathBuf,
        /// Name of the channel.
        tap_channel: String,
        /// Time from the first value on which no force acts, s.
        tap_start: Option<f64>,
    },
}

words! {
/// How the disturbance once a turn grows.
pub enum Disturbance {
    /// As the data choose.
    Auto = "auto",
    /// With the square of the speed.
    Unbalance = "unbalance",
    /// Not with the speed.
    RunOut = "run-out",
    /// There is none.
    None = "none",
}
}

/// A sensor that shows the balls.
#[derive(Clone, Debug, PartialEq)]
pub struct CageSignal {
    /// Name of the channel.
    pub channel: String,
    /// What it holds.
    pub kind: CageKind,
    /// Number of balls.
    pub ball_count: usize,
    /// Speed of a rolling cage over that of the shaft.
    pub rolling_ratio: f64,
}

/// What a channel that shows the balls holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CageKind {
    /// Samples of a sensor that sees each ball.
    Passings,
    /// Instants of passings.
    Edges,
    /// A vibration with a line at ball pass.
    Vibration {
        /// Highest slip that is looked for.
        highest_slip: f64,
    },
}

impl Signals {
    pub(crate) fn from_values(values: &Values) -> Signals {
        let signals = values.section("signals");
        Signals {
            file: values.text("signals.file").unwrap_or_default().into(),
            from: signals.maybe("from"),
            to: signals.maybe("to"),
            sample_interval: signals.maybe("sample_interval"),
            time_unit: values.text("signals.time_unit"),
            channel_delay: signals.number("channel_delay"),
            speed: speed(values),
            torque: torque(values),
            cage: cage(values),
            radial_load: signals.maybe("radial_load"),
            rest_before: signals.maybe("rest_before"),
            temperature: values.text("signals.temperature.channel"),
            converter: analysis::converter(values),
            vibration: analysis::vibration(values),
            steady: analysis::steady(values),
        }
    }
}

fn speed(values: &Values) -> Option<SpeedSignal> {
    let speed = values.section("signals.speed");
    Some(SpeedSignal {
        channel: values.text("signals.speed.channel")?,
        kind: match speed.choice("kind") {
            SpeedOutput::Edges => PickupKind::Edges {
                stamp_deviation: speed.number("stamp_deviation"),
                flank: speed.choice("flank"),
            },
            SpeedOutput::Analog => PickupKind::Analog {
                flank: speed.choice("flank"),
            },
            SpeedOutput::Speed => PickupKind::Speed {
                scale: speed.maybe("scale"),
                bandwidth: speed.maybe("bandwidth"),
                delay: speed.number("delay"),
                resolution: speed.maybe("resolution"),
                noise: speed.maybe("noise"),
            },
        },
        marks_per_revolution: speed.count("marks_per_revolution") as usize,
        missing_marks: speed.count("missing_marks") as usize,
        quick_change: speed.choice::<Automatic>("quick_change") == Automatic::Auto,
        change_from: speed.maybe("change_from"),
        change_to: speed.maybe("change_to"),
        calibration: speed.chosen::<Automatic>("calibration") != Some(Automatic::None),
        ripple: speed.maybe("ripple").unwrap_or(0.0),
        delay_deviation: speed.number("delay_deviation"),
        wanted: speed.maybe("wanted"),
        set_speed: speed.maybe("set_speed"),
    })
}

fn torque(values: &Values) -> Option<TorqueSignal> {
    let torque = values.section("signals.torque");
    let channel = values.text("signals.torque.channel")?;
    let sensor = match (
        values.text("signals.torque.tap_file"),
        torque.maybe("sensor_frequency"),
    ) {
        (Some(file), _) => Some(SensorSource::Tap {
            tap_file: file.into(),
            tap_channel: values
                .text("signals.torque.tap_channel")
                .unwrap_or_else(|| channel.clone()),
            tap_start: torque.maybe("tap_start"),
        }),
        (None, Some(sensor_frequency)) => Some(SensorSource::Given {
            sensor_frequency,
            frequency_deviation: torque.number("frequency_deviation"),
            damping_ratio: torque.number("damping_ratio"),
            damping_deviation: torque.number("damping_deviation"),
        }),
        (None, None) => None,
    };
    Some(TorqueSignal {
        channel,
        scale: torque.maybe("scale"),
        sensor,
        disturbance: torque.choice("disturbance"),
        scale_deviation: torque.number("scale_deviation"),
        zero_deviation: torque.maybe("zero_deviation"),
        design_until: torque.maybe("design_until"),
        highest_frequency: torque.maybe("highest_frequency"),
    })
}

fn cage(values: &Values) -> Option<CageSignal> {
    let cage = values.section("signals.cage");
    Some(CageSignal {
        channel: values.text("signals.cage.channel")?,
        kind: match cage.choice("kind") {
            CageOutput::Passings => CageKind::Passings,
            CageOutput::Edges => CageKind::Edges,
            CageOutput::Vibration => CageKind::Vibration {
                highest_slip: cage.number("highest_slip"),
            },
        },
        ball_count: cage.count("ball_count") as usize,
        rolling_ratio: cage.number("rolling_ratio"),
    })
}
