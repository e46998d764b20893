//! What a levitation must fulfil before it is built.

use crate::Refused;
use crate::parts::{Actuator, Axis, Control, Sensor};
use physics::magnet::{Amplifier, Magnet, Timing};
use std::f64::consts::FRAC_PI_2;

/// Refuses what cannot be.
pub(crate) fn all(
    nodes: usize,
    sensors: &[Sensor],
    control: &Control,
    timing: Timing,
    actuators: &[Actuator],
) -> Result<(), Refused> {
    let axes = sensors.iter().map(|sensor| &sensor.axis);
    for axis in axes.chain(actuators.iter().map(|actuator| &actuator.axis)) {
        if axis.node >= nodes {
            return Err(Refused::Node(format!(
                "{} at node {}; the rotor has nodes 0 to {}",
                axis.name,
                axis.node,
                nodes.saturating_sub(1)
            )));
        }
    }
    let needed = (sensors.len(), actuators.len());
    let found = match control {
        Control::Channels(filters)
            if filters.iter().all(|f| (f.inputs(), f.outputs()) == (1, 1)) =>
        {
            (filters.len(), filters.len())
        }
        Control::Channels(filters) => (
            filters.iter().map(crate::StateSpace::inputs).sum(),
            filters.iter().map(crate::StateSpace::outputs).sum(),
        ),
        Control::Matrix(filter) => (filter.inputs(), filter.outputs()),
    };
    if found != needed {
        return Err(Refused::Sizes(format!(
            "a controller from {} signals to {} commands; {} sensor axes and {} magnet axes are there",
            found.0, found.1, needed.0, needed.1
        )));
    }
    times(timing)?;
    for sensor in sensors {
        if let Some(corner) = sensor.corner {
            positive(&sensor.axis, "corner of the sensor, rad/s", corner)?;
        }
    }
    actuators.iter().try_for_each(magnet)
}

fn times(timing: Timing) -> Result<(), Refused> {
    let refused = |what: &str, value: f64, allowed: &str| {
        let text = format!("{what} {value} s; allowed is {allowed}");
        Err(Refused::Time(text))
    };
    match timing {
        Timing::Continuous { delay } if !(delay >= 0.0 && delay.is_finite()) => {
            refused("delay", delay, "0 or more")
        }
        Timing::Sampled { period, .. } if !(period > 0.0 && period.is_finite()) => {
            refused("sampling period", period, "above 0")
        }
        Timing::Sampled {
            period,
            computation,
        } if !(0.0..=period).contains(&computation) => refused(
            "time to compute",
            computation,
            "from 0 to the sampling period",
        ),
        _ => Ok(()),
    }
}

fn magnet(actuator: &Actuator) -> Result<(), Refused> {
    let axis = &actuator.axis;
    match actuator.magnet {
        Magnet::Linear {
            current_stiffness,
            position_stiffness,
        } => {
            positive(axis, "force over current, N/A", current_stiffness)?;
            positive(axis, "force over displacement, N/m", position_stiffness)?;
        }
        Magnet::Pair(pair) => {
            positive(axis, "force constant, N m²/A²", pair.force_constant)?;
            let bias = pair.bias_plus.max(pair.bias_minus);
            positive(axis, "bias current, A", pair.bias_plus)?;
            positive(axis, "bias current, A", pair.bias_minus)?;
            positive(axis, "gap, m", pair.gap)?;
            if bias > pair.largest_current {
                return Err(Refused::Value(format!(
                    "{}: a bias of {bias} A above the largest current of a coil, {} A",
                    axis.name, pair.largest_current
                )));
            }
        }
    }
    match actuator.amplifier {
        Amplifier::Direct => Ok(()),
        Amplifier::Current { bandwidth, slew } => {
            positive(axis, "bandwidth of the amplifier, rad/s", bandwidth)?;
            // without a limit it is infinite
            positive(axis, "largest rate of current, A/s", slew.min(f64::MAX))
        }
        Amplifier::Voltage {
            inductance,
            resistance,
            gain,
            largest_voltage,
        } => {
            positive(axis, "inductance, H", inductance)?;
            positive(axis, "resistance, Ω", resistance)?;
            positive(axis, "gain of the amplifier, V/A", gain.unwrap_or(1.0))?;
            // without a limit it is infinite
            let limit = largest_voltage.min(f64::MAX);
            positive(axis, "largest voltage, V", limit)
        }
    }
}

fn positive(axis: &Axis, what: &'static str, value: f64) -> Result<(), Refused> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    let text = format!("{}: {what} {value}; it must be above 0", axis.name);
    Err(Refused::Value(text))
}

/// Whether sensors and magnets come in pairs at right angles that differ in nothing else, each sensor along its magnet.
pub(crate) fn pairs_alike(sensors: &[Sensor], actuators: &[Actuator]) -> bool {
    let square =
        |a: &Axis, b: &Axis| a.node == b.node && (b.angle - a.angle - FRAC_PI_2).abs() < 1e-12;
    let along = |(sensor, actuator): (&Sensor, &Actuator)| {
        (sensor.axis.angle - actuator.axis.angle).abs() < 1e-12
    };
    sensors.len() == actuators.len()
        && sensors.iter().zip(actuators).all(along)
        && sensors.chunks(2).all(|pair| {
            pair.len() == 2
                && square(&pair[0].axis, &pair[1].axis)
                && pair[0].corner == pair[1].corner
        })
        && actuators.chunks(2).all(|pair| {
            pair.len() == 2
                && square(&pair[0].axis, &pair[1].axis)
                && pair[0].magnet == pair[1].magnet
                && pair[0].amplifier == pair[1].amplifier
        })
}
