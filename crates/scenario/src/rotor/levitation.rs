//! From the tables of magnets, sensors and controllers to the levitation of the kernel.

use crate::key::quoted;
use crate::rotor::parts::Part;
use ::levitation::{
    Actuator, Amplifier, Axis, Control, Levitation, Refused, Sensor, StateSpace, Timing,
};
use nalgebra::DMatrix;
use physics::magnet::{Magnet, OpposedPair};
use problem::{Code, Problem, did_you_mean};
use std::f64::consts::{FRAC_PI_2, TAU};

type Built<T> = Result<T, Box<Problem>>;

/// Share by which a given bias may differ from g₀k_s/k_i: makers round their data.
const BIAS_SHARE: f64 = 0.02;

/// The levitation of a rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct LevitationModel {
    /// The levitation as the kernel has it; two axes of each magnet in turn.
    pub levitation: Levitation,
    /// Magnets by name with node and node of their sensor.
    pub magnets: Vec<(String, usize, usize)>,
}

/// The levitation of all parts; none without magnets.
pub fn model<'a>(
    of: &dyn Fn(&str) -> Vec<&'a Part>,
    node: &dyn Fn(&Part) -> Built<usize>,
    nodes: usize,
) -> Built<Option<LevitationModel>> {
    let (magnets, sensors, controllers) = (of("magnet"), of("sensor"), of("controller"));
    for part in sensors.iter().chain(&controllers) {
        belongs(part, &magnets)?;
    }
    for list in [&sensors, &controllers] {
        each_acts(list, &magnets)?;
    }
    let Some(first) = magnets.first() else {
        return Ok(None);
    };
    let (mut axes, mut actuators, mut channels) = (Vec::new(), Vec::new(), Vec::new());
    let mut names = Vec::new();
    let own = |list: &[&'a Part], magnet: &Part, what: &str| -> Built<&'a Part> {
        let of_it = |part: &&&Part| part.text("magnet") == Some(&magnet.label);
        let for_all = |part: &&&Part| part.text("magnet").is_none();
        let mut found = list.iter().filter(of_it).chain(list.iter().filter(for_all));
        found.next().copied().ok_or_else(|| {
            let found = format!("a magnet without {what}");
            let allowed = format!(
                "a [[levitation.{what}]] with magnet = {} is needed",
                quoted(&magnet.label)
            );
            Box::new(magnet.problem(Code::LevitationParts, "", found, allowed))
        })
    };
    for magnet in &magnets {
        let sensor = own(&sensors, magnet, "sensor")?;
        let controller = own(&controllers, magnet, "controller")?;
        let (at, sensed) = (node(magnet)?, node(sensor)?);
        names.push((magnet.label.clone(), at, sensed));
        for (number, turned) in [(1, 0.0), (2, FRAC_PI_2)] {
            let axis = |node| Axis {
                name: format!("{} {number}", magnet.label),
                node,
                angle: magnet.needed("angle") + turned,
            };
            axes.push(Sensor {
                axis: axis(sensed),
                corner: sensor.number("bandwidth").map(|hertz| TAU * hertz),
                offset: sensor.needed(&format!("offset_{number}")),
                reference: 0.0,
            });
            actuators.push(Actuator {
                amplifier: amplifier(magnet)?,
                ..actuator(magnet, number, axis(at))?
            });
        }
        channels.push((controller, channel(controller)?));
    }
    let timing = timing(&controllers)?;
    let matrix = controllers.iter().find(|part| part.known.contains_key("d"));
    let control = match matrix {
        Some(part) if controllers.len() > 1 => {
            let found = "matrices of a controller, and another controller";
            let allowed = "one [levitation.controller] from all sensors to all magnets is needed";
            return Err(Box::new(part.problem(Code::Conflict, "d", found, allowed)));
        }
        Some(part) => Control::Matrix(state_space(part)?),
        None => Control::Channels(
            channels
                .iter()
                .flat_map(|(_, channel)| [channel.clone(), channel.clone()])
                .collect(),
        ),
    };
    let teller = matrix.or(controllers.first()).unwrap_or(first);
    let levitation = Levitation::new(nodes, axes, control, timing, actuators)
        .map_err(|error| refused(teller, "", &error))?;
    Ok(Some(LevitationModel {
        levitation,
        magnets: names,
    }))
}

/// Refuses a part of a magnet that is not there.
fn belongs(part: &Part, magnets: &[&Part]) -> Built<()> {
    let Some(name) = part.text("magnet") else {
        return match magnets.is_empty() {
            true => {
                let allowed = "a [[levitation.magnet]] is needed";
                let found = format!("a {} without a magnet", part.kind.word);
                Err(Box::new(part.problem(
                    Code::LevitationParts,
                    "",
                    found,
                    allowed,
                )))
            }
            false => Ok(()),
        };
    };
    if magnets.iter().any(|magnet| magnet.label == name) {
        return Ok(());
    }
    let names = || magnets.iter().map(|magnet| magnet.label.as_str());
    let allowed = format!(
        "one of the magnets {} is needed",
        names().collect::<Vec<_>>().join(", ")
    );
    let problem = part.problem(Code::LevitationParts, "magnet", quoted(name), allowed);
    Err(Box::new(problem.with_hint(did_you_mean(name, names()))))
}

/// Refuses a second part for what one serves, and one for all magnets where each has its own: it would not act.
fn each_acts(list: &[&Part], magnets: &[&Part]) -> Built<()> {
    // what stands beside matrices is refused with them
    if list.iter().any(|part| part.known.contains_key("d")) {
        return Ok(());
    }
    let own = |label: &str| list.iter().any(|part| part.text("magnet") == Some(label));
    for (at, part) in list.iter().enumerate() {
        let word = part.kind.word;
        let of = part.text("magnet");
        let found = match of {
            _ if !list[..at].iter().any(|other| other.text("magnet") == of) => match of {
                None if magnets.iter().all(|magnet| own(&magnet.label)) => {
                    format!("a {word} of every magnet without its own, and each has its own")
                }
                _ => continue,
            },
            Some(name) => format!("a second {word} of {}", quoted(name)),
            None => format!("a second {word} of every magnet without its own"),
        };
        let allowed = format!("one {word} for each magnet is needed: this one would not act");
        return Err(Box::new(part.problem(
            Code::LevitationParts,
            "magnet",
            found,
            allowed,
        )));
    }
    Ok(())
}

/// An axis of a magnet with its force law and limits of its control current; its amplifier is another matter.
fn actuator(part: &Part, number: usize, axis: Axis) -> Built<Actuator> {
    let magnet = law(part, number)?;
    let largest = part.number("largest_current").unwrap_or(f64::INFINITY);
    let [plus, minus] = match magnet {
        Magnet::Pair(pair) => [pair.bias_plus, pair.bias_minus],
        Magnet::Linear { .. } => [0.0; 2],
    };
    Ok(Actuator {
        axis,
        magnet,
        amplifier: Amplifier::Direct,
        lowest_current: minus - largest,
        largest_current: largest - plus,
    })
}

fn law(part: &Part, number: usize) -> Built<Magnet<f64>> {
    let current_stiffness = part.needed("current_stiffness");
    let position_stiffness = part.needed("position_stiffness");
    let Some(gap) = part.number("gap") else {
        return Ok(Magnet::Linear {
            current_stiffness,
            position_stiffness,
        });
    };
    let largest = part.number("largest_current").unwrap_or(f64::INFINITY);
    let pair = OpposedPair::of_stiffness(current_stiffness, position_stiffness, gap, largest);
    let bias = pair.bias_current();
    if let Some(given) = part.number("bias_current")
        && (given / bias - 1.0).abs() > BIAS_SHARE
    {
        let found = format!("{given} A");
        let allowed = format!(
            "{bias:.4} A is needed: bias/gap is position_stiffness/current_stiffness of a pair; or leave it out"
        );
        return Err(Box::new(part.problem(
            Code::MagnetValues,
            "bias_current",
            found,
            allowed,
        )));
    }
    let name = format!("bias_difference_{number}");
    let difference = part.needed(&name);
    if difference.abs() >= 2.0 * bias {
        let found = format!("{difference} A");
        let allowed = format!(
            "less than twice the mean bias of {bias:.4} A is needed: both coils carry current"
        );
        return Err(Box::new(part.problem(
            Code::MagnetValues,
            &name,
            found,
            allowed,
        )));
    }
    let pair = pair.with_bias_difference(difference);
    let bias = pair.bias_plus.max(pair.bias_minus);
    if bias > largest {
        let found = format!("{largest} A");
        let allowed = format!(
            "at least the bias is needed: {bias:.4} A follow from gap, stiffnesses and bias_difference_{number}"
        );
        return Err(Box::new(part.problem(
            Code::MagnetValues,
            "largest_current",
            found,
            allowed,
        )));
    }
    Ok(Magnet::Pair(pair))
}

fn amplifier(part: &Part) -> Built<Amplifier> {
    let Some(inductance) = part.number("inductance") else {
        return Ok(match part.number("amplifier_bandwidth") {
            Some(hertz) => Amplifier::Current {
                bandwidth: TAU * hertz,
            },
            None => Amplifier::Direct,
        });
    };
    let Some(resistance) = part.number("resistance") else {
        let allowed = "resistance is needed beside inductance";
        let problem = part.problem(Code::MissingKey, "resistance", "no value", allowed);
        return Err(Box::new(problem));
    };
    Ok(Amplifier::Voltage {
        inductance,
        resistance,
        gain: part.number("amplifier_gain"),
        largest_voltage: part.number("largest_voltage").unwrap_or(f64::INFINITY),
    })
}

/// The filter of an axis: PID, then quotients.
fn channel(part: &Part) -> Built<StateSpace> {
    let time = part.number("derivative_time").unwrap_or_default();
    let gain = |name| part.needed(name);
    let mut out = StateSpace::pid(
        gain("proportional"),
        gain("integral"),
        gain("derivative"),
        time,
    )
    .map_err(|error| refused(part, "derivative_time", &error))?;
    for text in part.texts("filters") {
        let wrong = || {
            let allowed = "coefficients of s, the highest power first, as \"1 30 6.3e6 / 1 900 6.3e6\" are needed";
            Box::new(part.problem(Code::ControllerFilter, "filters", quoted(text), allowed))
        };
        let (above, below) = text.split_once('/').ok_or_else(wrong)?;
        let (num, den) = (row(above).ok_or_else(wrong)?, row(below).ok_or_else(wrong)?);
        let next = StateSpace::rational("filter", &num, &den)
            .map_err(|error| refused(part, "filters", &error))?;
        out = out.then(&next);
    }
    Ok(out)
}

/// Numbers between spaces.
fn row(text: &str) -> Option<Vec<f64>> {
    text.split_whitespace()
        .map(|word| word.parse().ok())
        .collect()
}

/// A controller by its matrices; a, b and c may be left out of one without states.
fn state_space(part: &Part) -> Built<StateSpace> {
    let read = |name: &str| -> Built<Option<DMatrix<f64>>> {
        let Some(text) = part.text(name) else {
            return Ok(None);
        };
        let rows: Option<Vec<Vec<f64>>> = text.split(';').map(row).collect();
        let rows = rows.filter(|rows| rows.iter().all(|row| row.len() == rows[0].len()));
        let Some(rows) = rows else {
            let allowed = "rows of equally many numbers, \"1 0; 0 1\", are needed";
            return Err(Box::new(part.problem(
                Code::ControllerFilter,
                name,
                quoted(text),
                allowed,
            )));
        };
        Ok(Some(DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| {
            rows[i][j]
        })))
    };
    let d = read("d")?.unwrap_or_default();
    let a = read("a")?.unwrap_or_default();
    let b = read("b")?.unwrap_or_else(|| DMatrix::zeros(a.nrows(), d.ncols()));
    let c = read("c")?.unwrap_or_else(|| DMatrix::zeros(d.nrows(), a.nrows()));
    StateSpace::new("controller", a, b, c, d).map_err(|error| refused(part, "d", &error))
}

/// When commands take effect: the same for all controllers.
fn timing(controllers: &[&Part]) -> Built<Timing> {
    let of = |part: &Part| match part.number("sampling_period") {
        Some(period) => Timing::Sampled {
            period,
            computation: part.needed("computing_time"),
        },
        None => Timing::Continuous {
            delay: part.needed("delay"),
        },
    };
    let Some(first) = controllers.first() else {
        return Ok(Timing::Continuous { delay: 0.0 });
    };
    match controllers.iter().find(|part| of(part) != of(first)) {
        Some(other) => {
            let found = "another delay or sampling than of the first controller";
            let allowed = "the same for all controllers is needed: one computer runs them";
            Err(Box::new(other.problem(
                Code::ControllerTime,
                "",
                found,
                allowed,
            )))
        }
        None => Ok(of(first)),
    }
}

/// What the kernel refuses, as a message at a part.
fn refused(part: &Part, key: &str, error: &Refused) -> Box<Problem> {
    let (code, allowed) = match error {
        Refused::ControllerSize { .. } | Refused::MatrixSizes { .. } => (
            Code::ControllerSize,
            "two signals for each sensor and two commands for each magnet, in the order of the magnets, are needed",
        ),
        Refused::Time { .. } => (Code::ControllerTime, "a time within its range is needed"),
        Refused::NotPositive { .. } | Refused::Bias { .. } => {
            (Code::MagnetValues, "another value is needed")
        }
        _ => (Code::ControllerFilter, "another filter is needed"),
    };
    Box::new(part.problem(code, key, error.to_string(), allowed))
}
