//! What more is asked of a measurement, as typed values in SI: its converter, a vibration, curves of slow runs.

use super::resolve::Values;
use super::section::Section;

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
    /// Highest order of the spectrogram over order.
    pub highest_order: f64,
    /// Turns in a spectrum over order.
    pub turns: usize,
}

/// Slow runs, from which torque over speed is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadySignal {
    /// Begin and end of the part with falling speed, s.
    pub down: (f64, f64),
    /// Begin and end of a part with rising speed, s.
    pub up: Option<(f64, f64)>,
    /// Speeds at which the curves are drawn.
    pub points: usize,
    /// How the inertia is known; none where it is not.
    pub inertia: Option<InertiaSource>,
}

/// A measured value and its standard deviation.
pub type Measured = [f64; 2];

/// How the inertia of what coasts is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InertiaSource {
    /// As given, kg m².
    Given(Measured),
    /// From swinging about a knife edge.
    Pendulum {
        /// Mass, kg.
        mass: Measured,
        /// Distance from the knife edge to the mass centre, m.
        arm: Measured,
        /// Period, s.
        period: Measured,
        /// Amplitude, rad.
        amplitude: f64,
        /// Gravity, m/s².
        gravity: f64,
    },
    /// From turning on two strings.
    Bifilar {
        /// Mass, kg.
        mass: Measured,
        /// Distance of the strings, m.
        distance: Measured,
        /// Their length, m.
        length: Measured,
        /// Period, s.
        period: Measured,
        /// Gravity, m/s².
        gravity: f64,
    },
    /// From the acceleration by a known torque.
    KnownTorque {
        /// Torque, N m.
        torque: Measured,
        /// Acceleration with it, rad/s².
        with: Measured,
        /// Acceleration without it, rad/s².
        without: Measured,
    },
}

pub(super) fn converter(values: &Values) -> Option<ConverterSignal> {
    let section = Section {
        values,
        path: "signals.converter",
    };
    let channels = values.texts("signals.converter.channels");
    let highest = section.maybe("highest").unwrap_or(f64::NAN);
    (!channels.is_empty()).then(|| ConverterSignal {
        channels: channels.to_vec(),
        lowest: section.maybe("lowest").unwrap_or(-highest),
        highest,
        bits: section.count("bits") as u32,
    })
}

pub(super) fn vibration(values: &Values) -> Option<VibrationSignal> {
    let section = Section {
        values,
        path: "signals.vibration",
    };
    Some(VibrationSignal {
        channel: values.text("signals.vibration.channel")?,
        orders: orders(values),
        bandwidth: section.number("bandwidth"),
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

pub(super) fn steady(values: &Values) -> Option<SteadySignal> {
    let section = Section {
        values,
        path: "signals.steady",
    };
    let part = |from: &str, to: &str| Some((section.maybe(from)?, section.maybe(to)?));
    let of = |name: &str| -> Measured {
        [
            section.number(name),
            section.number(&format!("{name}_deviation")),
        ]
    };
    let inertia = match section.word("inertia_from") {
        "pendulum" => Some(InertiaSource::Pendulum {
            mass: of("test_mass"),
            arm: of("test_arm"),
            period: of("test_period"),
            amplitude: section.number("test_amplitude"),
            gravity: section.number("test_gravity"),
        }),
        "bifilar" => Some(InertiaSource::Bifilar {
            mass: of("test_mass"),
            distance: of("string_distance"),
            length: of("string_length"),
            period: of("test_period"),
            gravity: section.number("test_gravity"),
        }),
        "known torque" => Some(InertiaSource::KnownTorque {
            torque: of("test_torque"),
            with: of("acceleration_with"),
            without: of("acceleration_without"),
        }),
        _ => section.maybe("inertia").map(|value| {
            InertiaSource::Given([value, value * section.number("inertia_deviation")])
        }),
    };
    Some(SteadySignal {
        down: part("from", "to")?,
        up: part("up_from", "up_to"),
        points: section.count("points") as usize,
        inertia,
    })
}
