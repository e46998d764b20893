//! From magnets, sensors and controllers as their file gives them to the levitation of the kernel.

use ::levitation::{Actuator, Axis, Control, Levitation, Refused, Sensor, StateSpace};
use nalgebra::DMatrix;
use problem::{Code, Problem};
use scenario::problem_at;
use scenario::rotor::levitation::{Channel, Control as Filters, Magnets};

/// The levitation of a rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct LevitationModel {
    /// The levitation as the kernel has it; two axes of each magnet in turn.
    pub levitation: Levitation,
    /// Magnets by name with node and node of their sensor.
    pub magnets: Vec<(String, usize, usize)>,
}

impl LevitationModel {
    /// The levitation of magnets at nodes of a rotor.
    pub(super) fn new(
        given: &Magnets,
        node: &dyn Fn(f64) -> usize,
        nodes: usize,
    ) -> Result<LevitationModel, Box<Problem>> {
        let (mut sensors, mut actuators, mut magnets) = (Vec::new(), Vec::new(), Vec::new());
        for magnet in &given.magnets {
            let (at, sensed) = (node(magnet.at), node(magnet.sensed_at));
            for (number, own) in (1..).zip(&magnet.axes) {
                let axis = |node| Axis {
                    name: format!("{} {number}", magnet.name),
                    node,
                    on: magnet.on,
                    angle: own.angle,
                };
                sensors.push(Sensor {
                    axis: axis(sensed),
                    corner: magnet.sensor_corner,
                    offset: own.offset,
                    reference: 0.0,
                });
                actuators.push(Actuator {
                    axis: axis(at),
                    magnet: own.law,
                    amplifier: magnet.amplifier,
                    lowest_current: own.lowest_current,
                    largest_current: own.largest_current,
                });
            }
            magnets.push((magnet.name.clone(), at, sensed));
        }
        let control = match &given.control {
            Filters::Matrices(all) => Control::Matrix(
                matrices(all).map_err(|error| refused(&format!("{}.d", given.path), &error))?,
            ),
            Filters::Channels(all) => {
                let channels = all.iter().map(channel).collect::<Result<Vec<_>, _>>()?;
                Control::Channels(
                    channels
                        .into_iter()
                        .flat_map(|own| [own.clone(), own])
                        .collect(),
                )
            }
        };
        let levitation = Levitation::new(nodes, sensors, control, given.timing, actuators);
        Ok(LevitationModel {
            levitation: levitation.map_err(|error| refused(&given.path, &error))?,
            magnets,
        })
    }
}

/// The filter of an axis: PID, then quotients.
fn channel(given: &Channel) -> Result<StateSpace, Box<Problem>> {
    let (p, i, d) = (given.proportional, given.integral, given.derivative);
    let at = |key: &str, error: Refused| refused(&format!("{}.{key}", given.path), &error);
    let pid = StateSpace::pid(p, i, d, given.derivative_time);
    let pid = pid.map_err(|error| at("derivative_time", error))?;
    given.filters.iter().try_fold(pid, |out, [above, below]| {
        let next = StateSpace::rational("filter", above, below);
        Ok(out.then(&next.map_err(|error| at("filters", error))?))
    })
}

/// A controller by its matrices.
fn matrices(given: &[Option<Vec<Vec<f64>>>; 4]) -> Result<StateSpace, Refused> {
    let [a, b, c, d] = given.each_ref().map(|own| {
        own.as_ref()
            .map(|rows| DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j]))
    });
    let (a, d) = (a.unwrap_or_default(), d.unwrap_or_default());
    let b = b.unwrap_or_else(|| DMatrix::zeros(a.nrows(), d.ncols()));
    let c = c.unwrap_or_else(|| DMatrix::zeros(d.nrows(), a.nrows()));
    StateSpace::new("controller", a, b, c, d)
}

/// What the kernel refuses, as a message at a key.
fn refused(key: &str, error: &Refused) -> Box<Problem> {
    let (code, allowed) = match error {
        Refused::Sizes(_) => (
            Code::ControllerSize,
            "two signals for each sensor and two commands for each magnet, in the order of the magnets, are needed",
        ),
        Refused::Time(_) => (Code::ControllerTime, "a time within its range is needed"),
        Refused::Value(_) => (Code::MagnetValues, "another value is needed"),
        _ => (Code::ControllerFilter, "another filter is needed"),
    };
    problem_at(code, key, error.to_string(), allowed)
}
