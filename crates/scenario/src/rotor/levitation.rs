//! From the tables of magnets, sensors and controllers to their values.

use crate::key::quoted;
use crate::rotor::parts::{Checked, OfKind, on};
use crate::rotor::tables::Part;
use physics::magnet::{Amplifier, Magnet, OpposedPair, Timing};
use problem::value::Value;
use problem::{Code, did_you_mean};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Magnets that hold a rotor, with their sensors and controllers.
#[derive(Clone, Debug, PartialEq)]
pub struct Magnets {
    /// The magnets.
    pub magnets: Vec<RadialMagnet>,
    /// What commands them.
    pub control: Control,
    /// When commands take effect.
    pub timing: Timing,
    /// The co-simulation unit whose commands act in place of those of the controllers.
    pub unit: Option<Unit>,
    /// The table that answers for all of them: `levitation.controller.1`.
    pub path: String,
}

/// A co-simulation unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// Its file.
    pub file: String,
    /// What the file must hash to, where that is given.
    pub hash: Option<String>,
}

/// A radial magnet with its sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialMagnet {
    /// Its name.
    pub name: String,
    /// Position along the shaft, m.
    pub at: f64,
    /// The housing that carries both; the ground without.
    pub on: Option<usize>,
    /// Position of its sensor, m.
    pub sensed_at: f64,
    /// Corner of its sensor, rad/s; none follows at once.
    pub sensor_corner: Option<f64>,
    /// How commands become currents.
    pub amplifier: Amplifier,
    /// Both axes, at right angles.
    pub axes: [MagnetAxis; 2],
}

/// An axis of a magnet.
#[derive(Clone, Debug, PartialEq)]
pub struct MagnetAxis {
    /// Direction, rad from x.
    pub angle: f64,
    /// Force law.
    pub law: Magnet<f64>,
    /// Lowest control current, A.
    pub lowest_current: f64,
    /// Largest control current, A.
    pub largest_current: f64,
    /// What its sensor shows too much, m.
    pub offset: f64,
}

/// From position errors to commands.
#[derive(Clone, Debug, PartialEq)]
pub enum Control {
    /// One filter of each magnet, for both axes.
    Channels(Vec<Channel>),
    /// Matrices A, B, C, D by rows, from all sensors to all magnets; A, B and C may be left out.
    Matrices([Option<Vec<Vec<f64>>>; 4]),
}

/// A PID with filters behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// The table of its controller: `levitation.controller.1`.
    pub path: String,
    /// Gain of the error, A/m or V/m.
    pub proportional: f64,
    /// Gain of its integral.
    pub integral: f64,
    /// Gain of its rate.
    pub derivative: f64,
    /// Time constant that ends the derivative, s.
    pub derivative_time: f64,
    /// Coefficients of s above and below, the highest power first.
    pub filters: Vec<[Vec<f64>; 2]>,
}

/// Share by which a given bias may differ from g₀k_s/k_i: makers round their data.
const BIAS_SHARE: f64 = 0.02;

/// All magnets; none where the file has none.
pub(super) fn magnets<'a>(
    of: OfKind<'a, '_>,
    at: &dyn Fn(&Part) -> Checked<f64>,
) -> Checked<Option<Magnets>> {
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
    let own = |list: &[&'a Part], magnet: &Part, what: &str| -> Checked<&'a Part> {
        let of_it = |part: &&&Part| part.text("magnet") == Some(&magnet.label);
        let for_all = |part: &&&Part| part.text("magnet").is_none();
        let mut found = list.iter().filter(of_it).chain(list.iter().filter(for_all));
        found.next().copied().map_or_else(
            || {
                let allowed = format!(
                    "a [[levitation.{what}]] with magnet = {} is needed",
                    quoted(&magnet.label)
                );
                let found = format!("a magnet without {what}");
                magnet.refuse(Code::LevitationParts, "", found, allowed)
            },
            Ok,
        )
    };
    let housings = of("housing");
    let (mut list, mut channels) = (Vec::new(), Vec::new());
    for magnet in &magnets {
        let sensor = own(&sensors, magnet, "sensor")?;
        let controller = own(&controllers, magnet, "controller")?;
        let amplifier = amplifier(magnet)?;
        list.push(RadialMagnet {
            name: magnet.label.clone(),
            at: at(magnet)?,
            on: on(magnet, &housings)?,
            sensed_at: at(sensor)?,
            sensor_corner: sensor.number("bandwidth").map(|hertz| TAU * hertz),
            amplifier,
            axes: [axis(magnet, sensor, 1)?, axis(magnet, sensor, 2)?],
        });
        channels.push(channel(controller));
    }
    let timing = timing(&controllers)?;
    let matrix = controllers.iter().find(|part| part.known.contains_key("d"));
    let control = match matrix {
        Some(part) if controllers.len() > 1 => {
            let found = "matrices of a controller, and another controller";
            let allowed = "one [levitation.controller] from all sensors to all magnets is needed";
            return part.refuse(Code::Conflict, "d", found, allowed);
        }
        Some(part) => Control::Matrices([
            rows(part, "a", &list)?,
            rows(part, "b", &list)?,
            rows(part, "c", &list)?,
            rows(part, "d", &list)?,
        ]),
        None => Control::Channels(channels),
    };
    let unit = controllers.iter().find(|part| part.text("fmu").is_some());
    if let Some(part) = unit.filter(|_| controllers.len() > 1) {
        let found = "a unit, and another controller";
        let allowed = "one [levitation.controller] for all magnets is needed beside fmu";
        return part.refuse(Code::Conflict, "fmu", found, allowed);
    }
    let unit = unit.and_then(|part| {
        Some(Unit {
            file: part.text("fmu")?.to_string(),
            hash: part.text("fmu_hash").map(str::to_string),
        })
    });
    let path = matrix.or(controllers.first()).unwrap_or(first).path.clone();
    Ok(Some(Magnets {
        magnets: list,
        control,
        timing,
        unit,
        path,
    }))
}

/// Refuses a part of a magnet that is not there.
fn belongs(part: &Part, magnets: &[&Part]) -> Checked<()> {
    let Some(name) = part.text("magnet") else {
        return match magnets.is_empty() {
            true => {
                let allowed = "a [[levitation.magnet]] is needed";
                let found = format!("a {} without a magnet", part.kind.word);
                part.refuse(Code::LevitationParts, "", found, allowed)
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
    Err(problem.with_hint(did_you_mean(name, names())))
}

/// Refuses a second part for what one serves, and one for all magnets where each has its own: it would not act.
fn each_acts(list: &[&Part], magnets: &[&Part]) -> Checked<()> {
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
        return part.refuse(Code::LevitationParts, "magnet", found, allowed);
    }
    Ok(())
}

/// An axis of a magnet with its force law and limits of its control current.
fn axis(part: &Part, sensor: &Part, number: u8) -> Checked<MagnetAxis> {
    let law = law(part, number)?;
    let largest = part.number("largest_current").unwrap_or(f64::INFINITY);
    let [plus, minus] = match law {
        Magnet::Pair(pair) => [pair.bias_plus, pair.bias_minus],
        Magnet::Linear { .. } => [0.0; 2],
    };
    Ok(MagnetAxis {
        angle: part.needed("angle") + if number == 2 { FRAC_PI_2 } else { 0.0 },
        law,
        lowest_current: minus - largest,
        largest_current: largest - plus,
        offset: sensor.needed(&format!("offset_{number}")),
    })
}

fn law(part: &Part, number: u8) -> Checked<Magnet<f64>> {
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
        return part.refuse(Code::MagnetValues, "bias_current", found, allowed);
    }
    let name = format!("bias_difference_{number}");
    let difference = part.needed(&name);
    if difference.abs() >= 2.0 * bias {
        let found = format!("{difference} A");
        let allowed = format!(
            "less than twice the mean bias of {bias:.4} A is needed: both coils carry current"
        );
        return part.refuse(Code::MagnetValues, &name, found, allowed);
    }
    let pair = pair.with_bias_difference(difference);
    let bias = pair.bias_plus.max(pair.bias_minus);
    if bias > largest {
        let found = format!("{largest} A");
        let allowed = format!(
            "at least the bias is needed: {bias:.4} A follow from gap, stiffnesses and bias_difference_{number}"
        );
        return part.refuse(Code::MagnetValues, "largest_current", found, allowed);
    }
    Ok(Magnet::Pair(pair))
}

fn amplifier(part: &Part) -> Checked<Amplifier> {
    let Some(inductance) = part.number("inductance") else {
        return Ok(match part.number("amplifier_bandwidth") {
            Some(hertz) => Amplifier::Current {
                bandwidth: TAU * hertz,
                slew: part.number("slew_rate").unwrap_or(f64::INFINITY),
            },
            None => Amplifier::Direct,
        });
    };
    let Some(resistance) = part.number("resistance") else {
        let allowed = "resistance is needed beside inductance";
        return part.refuse(Code::MissingKey, "resistance", "no value", allowed);
    };
    Ok(Amplifier::Voltage {
        inductance,
        resistance,
        gain: part.number("amplifier_gain"),
        largest_voltage: part.number("largest_voltage").unwrap_or(f64::INFINITY),
    })
}

/// The filter of a magnet's axes: PID, then quotients.
fn channel(part: &Part) -> Channel {
    let filters = match part.known.get("filters").map(|known| &known.value) {
        Some(Value::Filters(filters)) => filters.clone(),
        _ => Vec::new(),
    };
    Channel {
        path: part.path.clone(),
        proportional: part.needed("proportional"),
        integral: part.needed("integral"),
        derivative: part.needed("derivative"),
        derivative_time: part.needed("derivative_time"),
        filters,
    }
}

/// A matrix by its rows, where it is given; two rows for each magnet in what its amplifier takes where rows are commands.
fn rows(part: &Part, name: &str, magnets: &[RadialMagnet]) -> Checked<Option<Vec<Vec<f64>>>> {
    let Some(Value::Matrix(rows, units)) = part.known.get(name).map(|known| &known.value) else {
        return Ok(None);
    };
    let of_axes = magnets.iter().flat_map(|magnet| [magnet; 2]);
    for (number, ((row, unit), magnet)) in (1..).zip(rows.iter().zip(units).zip(of_axes)) {
        let needed = match magnet.amplifier {
            Amplifier::Voltage { gain: None, .. } => "V",
            _ => "A",
        };
        let commands = ["c", "d"].contains(&name) && row.iter().any(|value| *value != 0.0);
        if commands && !unit.starts_with(needed) {
            let found = format!("{unit} in row {number}");
            let name_of = quoted(&magnet.name);
            let allowed = format!("commands of magnet {name_of} are in {needed}");
            return part.refuse(Code::WrongDimension, name, found, allowed);
        }
    }
    Ok(Some(rows.clone()))
}

/// When commands take effect: the same for all controllers.
fn timing(controllers: &[&Part]) -> Checked<Timing> {
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
            other.refuse(Code::ControllerTime, "", found, allowed)
        }
        None => Ok(of(first)),
    }
}
