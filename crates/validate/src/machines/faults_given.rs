//! Magnets, controllers and faults as `faults_runs.json` gives them.

use super::given::index;
use crate::json::{list, number};
use levitation::{Actuator, Amplifier, Axis, Control, Levitation, Sensor, StateSpace, Timing};
use model::magnets::conditions::{Change, What};
use physics::magnet::{Magnet, OpposedPair};
use serde_json::Value;
use std::f64::consts::FRAC_PI_2;

/// Magnets, sensors and controllers of a run.
pub(super) fn levitation(given: &Value, nodes: usize) -> Result<Levitation, String> {
    let angle = number(given, "axis_angle_rad")?;
    let (mut sensors, mut actuators, mut channels) = (Vec::new(), Vec::new(), Vec::new());
    let mut delay = 0.0;
    for (k, magnet) in list(given, "magnets")?.iter().enumerate() {
        let law = &magnet["controller"];
        let own = |key: &str| number(law, key);
        let channel = StateSpace::pid(own("Kp")?, own("Ki")?, own("Kd")?, own("Td")?);
        let channel = channel.map_err(|error| error.to_string())?;
        delay = own("delay_s")?;
        let maybe = |key: &str| magnet[key].as_f64().unwrap_or(f64::INFINITY);
        let (ki, ks) = (number(magnet, "ki")?, number(magnet, "ks")?);
        let (law_of, limits) = match magnet["nonlinear"].as_bool() {
            Some(true) => {
                let pair = OpposedPair::of_stiffness(ki, ks, number(magnet, "g0")?, maybe("hi"));
                let bias = pair.bias_current();
                (Magnet::Pair(pair), [bias - maybe("hi"), maybe("hi") - bias])
            }
            _ => {
                let linear = Magnet::Linear {
                    current_stiffness: ki,
                    position_stiffness: ks,
                };
                (linear, [-maybe("i_lim"), maybe("i_lim")])
            }
        };
        for (axis, angle) in [angle, angle + FRAC_PI_2].into_iter().enumerate() {
            let axis = |node| Axis {
                name: format!("m{k}a{axis}"),
                node,
                on: None,
                angle,
            };
            sensors.push(Sensor {
                axis: axis(index(magnet, "sensor_node")?),
                corner: Some(own("sensor_rad_s")?),
                offset: 0.0,
                reference: 0.0,
            });
            actuators.push(Actuator {
                axis: axis(index(magnet, "actuator_node")?),
                magnet: law_of,
                amplifier: Amplifier::Current {
                    bandwidth: own("amplifier_rad_s")?,
                    slew: maybe("slew"),
                },
                lowest_current: limits[0],
                largest_current: limits[1],
            });
            channels.push(channel.clone());
        }
    }
    let timing = match given["sampled"].is_null() {
        true => Timing::Continuous { delay },
        false => Timing::Sampled {
            period: number(&given["sampled"], "T_s")?,
            computation: number(&given["sampled"], "T_c")?,
        },
    };
    let control = Control::Channels(channels);
    Levitation::new(nodes, sensors, control, timing, actuators).map_err(|error| error.to_string())
}

/// What happens in a run, and when.
pub(super) fn changes(given: &Value) -> Result<Vec<(f64, Change)>, String> {
    let change = |fault: &Value| {
        let what = match fault["kind"].as_str().unwrap_or_default() {
            "axis_lost" => What::Lost {
                decay_rate: 1.0 / number(fault, "tau_s")?,
            },
            "stuck" => What::Stuck,
            "dead" => What::Dead,
            "offset" => What::Offset(number(fault, "offset_m")?),
            "frozen" => What::Frozen,
            other => return Err(format!("a fault of kind {other}")),
        };
        let axis = 2 * index(fault, "magnet")? + index(fault, "axis")?;
        Ok((
            number(fault, "t")?,
            Change {
                what,
                axes: vec![axis],
            },
        ))
    };
    list(given, "faults")?.iter().map(change).collect()
}
