//! What more is asked of a measurement, as typed values in SI: its converter, a vibration, curves of slow runs.

use crate::section::Section;
use crate::values::Values;
use problem::words;
use std::path::PathBuf;

/// The converter that took some channels.
#[derive(Clone, Debug, PartialEq)]
pub struct ConverterSignal {
    /// Names of the channels.
    pub channels: Vec<String>,
    /// Lowest value that it can give, in the unit of the channels in the file.
    pub lowest: f64,
    /// Highest value.
    pub highest: f64,
    /// Bits of a value.
    pub bits: u32,
}

/// A vibration.
#[derive(Clone, Debug, PartialEq)]
pub struct VibrationSignal {
    /// Name of the channel.
    pub channel: String,
    /// Orders that are followed, cycles a turn.
    pub orders: Vec<f64>,
    /// Bandwidth of their amplitudes, Hz.
    pub bandwidth: f64,
    /// Highest frequency of the spectrogram over time, Hz; half of the sampling rate where none is given.
    pub highest_frequency: Option<f64>,
    /// Highest order of the spectrogram over order.
    pub highest_order: f64,
    /// Turns in a spectrum over order.
    pub turns: usize,
}

/// Slow runs, from which torque over speed is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadySignal {
    /// Begin of the part with falling speed, s.
    pub from: f64,
    /// Its end, s.
    pub to: f64,
    /// Begin of a part with rising speed, s.
    pub up_from: Option<f64>,
    /// Its end, s.
    pub up_to: Option<f64>,
    /// Speeds at which the curves are drawn.
    pub points: usize,
    /// How the inertia is known; none where it is not.
    pub inertia: Option<InertiaSource>,
    /// What brakes the shaft beside the bearing, where it is known.
    pub windage: Option<Windage>,
}

/// What brakes the shaft without the bearing.
#[derive(Clone, Debug, PartialEq)]
pub enum Windage {
    /// a + b Ω + c Ω².
    Law {
        /// a, N m.
        constant: f64,
        /// b, N m s.
        linear: f64,
        /// c, N m s².
        quadratic: f64,
        /// Relative standard deviation, the same at all speeds.
        deviation: f64,
    },
    /// A coast-down without the bearing: its signals file.
    Run(PathBuf),
}

words! {
    /// Where the inertia comes from, as a word.
    pub enum InertiaFrom {
        /// As given.
        Given = "given",
        Pendulum = "pendulum",
        /// Two strings.
        Bifilar = "bifilar",
        KnownTorque = "known torque",
    }
}

/// How the inertia of what coasts is known; each value with its standard deviation in the same unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InertiaSource {
    /// As given.
    Given {
        /// Inertia, kg m².
        inertia: f64,
        /// Its relative standard deviation.
        inertia_deviation: f64,
    },
    /// From swinging about a knife edge.
    Pendulum {
        /// Mass, kg.
        test_mass: f64,
        /// Its deviation.
        test_mass_deviation: f64,
        /// Distance from the knife edge to the mass centre, m.
        test_arm: f64,
        /// Its deviation.
        test_arm_deviation: f64,
        /// Period, s.
        test_period: f64,
        /// Its deviation.
        test_period_deviation: f64,
        /// Amplitude, rad.
        test_amplitude: f64,
        /// Gravity, m/s².
        test_gravity: f64,
    },
    /// From turning on two strings.
    Bifilar {
        /// Mass, kg.
        test_mass: f64,
        /// Its deviation.
        test_mass_deviation: f64,
        /// Distance of the strings, m.
        string_distance: f64,
        /// Its deviation.
        string_distance_deviation: f64,
        /// Their length, m.
        string_length: f64,
        /// Its deviation.
        string_length_deviation: f64,
        /// Period, s.
        test_period: f64,
        /// Its deviation.
        test_period_deviation: f64,
        /// Gravity, m/s².
        test_gravity: f64,
    },
    /// From the acceleration by a known torque.
    KnownTorque {
        /// Torque, N m.
        test_torque: f64,
        /// Its deviation.
        test_torque_deviation: f64,
        /// Acceleration with it, rad/s².
        acceleration_with: f64,
        /// Its deviation.
        acceleration_with_deviation: f64,
        /// Acceleration without it, rad/s².
        acceleration_without: f64,
        /// Its deviation.
        acceleration_without_deviation: f64,
    },
}

pub(crate) fn converter(values: &Values) -> Option<ConverterSignal> {
    let section = values.section("signals.converter");
    let channels = values.texts("signals.converter.channels");
    (!channels.is_empty()).then(|| {
        let highest = section.number("highest");
        ConverterSignal {
            channels: channels.to_vec(),
            lowest: section.maybe("lowest").unwrap_or(-highest),
            highest,
            bits: section.count("bits") as u32,
        }
    })
}

pub(crate) fn vibration(values: &Values) -> Option<VibrationSignal> {
    let section = values.section("signals.vibration");
    Some(VibrationSignal {
        channel: values.text("signals.vibration.channel")?,
        orders: orders(values),
        bandwidth: section.number("bandwidth"),
        highest_frequency: section.maybe("highest_frequency"),
        highest_order: section.number("highest_order"),
        turns: section.count("turns") as usize,
    })
}

/// The orders as numbers; not-a-number where a text is none.
fn orders(values: &Values) -> Vec<f64> {
    let texts = values.texts("signals.vibration.orders").iter();
    texts
        .map(|text| text.trim().parse().unwrap_or(f64::NAN))
        .collect()
}

pub(crate) fn steady(values: &Values) -> Option<SteadySignal> {
    let section = values.section("signals.steady");
    let number = |name: &str| section.number(name);
    let inertia = match section.choice("inertia_from") {
        InertiaFrom::Pendulum => Some(InertiaSource::Pendulum {
            test_mass: number("test_mass"),
            test_mass_deviation: number("test_mass_deviation"),
            test_arm: number("test_arm"),
            test_arm_deviation: number("test_arm_deviation"),
            test_period: number("test_period"),
            test_period_deviation: number("test_period_deviation"),
            test_amplitude: number("test_amplitude"),
            test_gravity: number("test_gravity"),
        }),
        InertiaFrom::Bifilar => Some(InertiaSource::Bifilar {
            test_mass: number("test_mass"),
            test_mass_deviation: number("test_mass_deviation"),
            string_distance: number("string_distance"),
            string_distance_deviation: number("string_distance_deviation"),
            string_length: number("string_length"),
            string_length_deviation: number("string_length_deviation"),
            test_period: number("test_period"),
            test_period_deviation: number("test_period_deviation"),
            test_gravity: number("test_gravity"),
        }),
        InertiaFrom::KnownTorque => Some(InertiaSource::KnownTorque {
            test_torque: number("test_torque"),
            test_torque_deviation: number("test_torque_deviation"),
            acceleration_with: number("acceleration_with"),
            acceleration_with_deviation: number("acceleration_with_deviation"),
            acceleration_without: number("acceleration_without"),
            acceleration_without_deviation: number("acceleration_without_deviation"),
        }),
        InertiaFrom::Given => section
            .maybe("inertia")
            .map(|inertia| InertiaSource::Given {
                inertia,
                inertia_deviation: number("inertia_deviation"),
            }),
    };
    Some(SteadySignal {
        from: section.maybe("from")?,
        to: section.number("to"),
        up_from: section.maybe("up_from"),
        up_to: section.maybe("up_to"),
        points: section.count("points") as usize,
        inertia,
        windage: windage(values, &section),
    })
}

fn windage(values: &Values, section: &Section) -> Option<Windage> {
    if let Some(file) = values.text("signals.steady.windage_file") {
        return Some(Windage::Run(file.into()));
    }
    let parts =
        ["constant", "linear", "quadratic"].map(|part| section.maybe(&format!("windage_{part}")));
    let [constant, linear, quadratic] = parts.map(|part| part.unwrap_or(0.0));
    let given = parts.iter().any(Option::is_some);
    given.then(|| Windage::Law {
        constant,
        linear,
        quadratic,
        deviation: section.number("windage_deviation"),
    })
}
