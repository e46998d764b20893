//! A levitation as linear analysis sees it: without limits, in one plane where both are alike, at rest.

use crate::levitation::Block;
use crate::parts::{Actuator, Control, Sensor};
use crate::{Inputs, Levitation, checks};
use nalgebra::DVector;
use physics::magnet::{Amplifier, Magnet, Timing};

impl Levitation {
    /// The same loop for linear analysis: samples as a delay T_c + T_s/2, no limit of current, its rate or voltage, both coils as one
    /// control current, no offset, no reference.
    #[must_use]
    pub fn linear(&self) -> Self {
        let mut sensors = self.sensors.clone();
        for sensor in &mut sensors {
            (sensor.offset, sensor.reference) = (0.0, 0.0);
        }
        self.centred(sensors)
    }

    /// States of the time run from those of linear analysis: a delay becomes commands that are held.
    pub(crate) fn adopted(&self, states: &[f64], displacements: &[f64]) -> Vec<f64> {
        let linear = self.unlimited();
        let mut signals = linear.signals();
        linear.read(states, Inputs::usual(displacements, &[]), &mut signals);
        let mut out = vec![0.0; self.states()];
        // sensors and controller stand first in both, currents last
        let first = match self.timing {
            Timing::Sampled { .. } | Timing::Held => {
                self.blocks.last().map_or(0, |block| block.states.end)
            }
            Timing::Continuous { .. } => {
                let mut currents = self.layout.currents.iter();
                currents.next().map_or(self.states(), |at| at.start)
            }
        };
        out[..first].copy_from_slice(&states[..first]);
        for block in &self.blocks {
            let Some((_, entry)) = &block.stepped else {
                continue;
            };
            let inputs = &signals.errors[block.inputs.clone()];
            let taken = entry * DVector::from_column_slice(inputs);
            for (state, taken) in out[block.states.clone()].iter_mut().zip(taken.iter()) {
                *state -= taken;
            }
        }
        for (index, (computed, held)) in self.layout.held.iter().enumerate() {
            (out[*computed], out[*held]) = (signals.wanted[index], signals.commands[index]);
        }
        for ((at, actuator), current) in
            (self.layout.currents.iter().zip(&self.actuators)).zip(&signals.currents)
        {
            let coils = actuator.magnet.coils(*current, 1.0);
            let own = if at.len() == 2 { coils } else { [*current; 2] };
            out[at.clone()].copy_from_slice(&own[..at.len()]);
        }
        out
    }

    /// As [`Levitation::linear`], with offsets and references kept.
    #[must_use]
    pub(crate) fn unlimited(&self) -> Self {
        self.centred(self.sensors.clone())
    }

    fn centred(&self, sensors: Vec<Sensor>) -> Self {
        let mut actuators = self.actuators.clone();
        for actuator in &mut actuators {
            actuator.lowest_current = f64::NEG_INFINITY;
            actuator.largest_current = f64::INFINITY;
            actuator.magnet = Magnet::Linear {
                current_stiffness: actuator.magnet.current_stiffness(),
                position_stiffness: actuator.magnet.position_stiffness(),
            };
            match &mut actuator.amplifier {
                Amplifier::Voltage {
                    largest_voltage, ..
                } => *largest_voltage = f64::INFINITY,
                Amplifier::Current { slew, .. } => *slew = f64::INFINITY,
                Amplifier::Direct => {}
            }
        }
        self.rebuilt(sensors, self.blocks.clone(), actuators)
    }

    /// One of two equal planes: the even axes alone. `None` unless axes come in equal pairs at right angles, each sensor
    /// along its magnet, with a filter for each axis; then w = x + jy passes the same real filters.
    #[must_use]
    pub fn one_plane(&self) -> Option<Self> {
        let equal = checks::pairs_alike(&self.sensors, &self.actuators)
            && self.blocks.len() == self.sensors.len()
            && self
                .blocks
                .chunks(2)
                .all(|pair| pair.len() == 2 && pair[0].filter.same_matrices(&pair[1].filter));
        equal.then(|| {
            let even = |index: &usize| index.is_multiple_of(2);
            let pick = |count: usize| (0..count).filter(even);
            let sensors = pick(self.sensors.len()).map(|at| self.sensors[at].clone());
            let blocks = pick(self.blocks.len()).map(|at| self.blocks[at].clone());
            let actuators = pick(self.actuators.len()).map(|at| self.actuators[at].clone());
            self.rebuilt(sensors.collect(), blocks.collect(), actuators.collect())
        })
    }

    /// [One plane](Levitation::one_plane) with the slopes (k_i, k_s) of its axes, where those of both planes are equal too.
    #[must_use]
    pub fn one_plane_about(&self, slopes: &[(f64, f64)]) -> Option<(Self, Vec<(f64, f64)>)> {
        // a weight that both axes share leaves them equal up to round-off
        let equal = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
        let alike =
            |pair: &[(f64, f64)]| equal(pair[0].0, pair[1].0) && equal(pair[0].1, pair[1].1);
        let plane = self.one_plane()?;
        let even = slopes.iter().step_by(2).copied().collect();
        slopes.chunks(2).all(alike).then_some((plane, even))
    }

    /// The same with other parts that are known to be right.
    fn rebuilt(&self, sensors: Vec<Sensor>, blocks: Vec<Block>, actuators: Vec<Actuator>) -> Self {
        let nodes = usize::MAX;
        let timing = Timing::Continuous {
            delay: self.timing.delay(),
        };
        let channels = blocks.iter().all(|block| block.inputs.len() == 1);
        let control = match &blocks[..] {
            [block] if !channels => Control::Matrix(block.filter.clone()),
            _ => Control::Channels(blocks.into_iter().map(|block| block.filter).collect()),
        };
        Self::new(nodes, sensors, control, timing, actuators).expect("parts of a levitation fit")
    }

    /// k_i and k_s of every magnet axis with the rotor in the centre and no control current.
    #[must_use]
    pub fn slopes_at_centre(&self) -> Vec<(f64, f64)> {
        let magnets = self.actuators.iter().map(|actuator| &actuator.magnet);
        let slopes = magnets.map(|own| (own.current_stiffness(), own.position_stiffness()));
        slopes.collect()
    }

    /// Static stiffness of every magnet axis with a channel of its own, k_i C(0) - k_s in N/m; infinite with an integrator.
    ///
    /// It is that of the bearing where sensor and magnet stand at one node. Empty where one filter serves all axes.
    ///
    /// - `slopes` k_i and k_s of each axis
    #[must_use]
    pub fn static_stiffness(&self, slopes: &[(f64, f64)]) -> Vec<f64> {
        let own = self.blocks.len() == self.actuators.len();
        let blocks = self.blocks.iter().zip(&self.actuators).filter(|_| own);
        blocks
            .zip(slopes)
            .map(|((block, actuator), (ki, ks))| {
                let volts_to_amperes = match actuator.amplifier {
                    Amplifier::Voltage {
                        resistance, gain, ..
                    } => gain.map_or(1.0 / resistance, |gain| gain / (gain + resistance)),
                    _ => 1.0,
                };
                let gain = block.filter.static_gain().map(|gain| gain[(0, 0)]);
                gain.map_or(f64::INFINITY, |gain| ki * gain * volts_to_amperes - ks)
            })
            .collect()
    }
}
