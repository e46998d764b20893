//! The matrices of sensors, controller, delay and amplifiers, taken from the rates that a time run uses.

use crate::Levitation;
use nalgebra::{DMatrix, DVector};

/// ẋ = A x + B_y y + B_v v + constant, i = C x + D y + constant.
///
/// y displacements of the sensor axes, m; v velocities of the magnet axes, m/s; i control currents of the magnet axes, A.
/// Constants come from offsets and references. Samples are seen as a delay, voltages as unlimited.
#[derive(Debug, Clone)]
pub struct LinearControl {
    /// A.
    pub a: DMatrix<f64>,
    /// B_y.
    pub by_displacement: DMatrix<f64>,
    /// B_v.
    pub by_velocity: DMatrix<f64>,
    /// C.
    pub currents: DMatrix<f64>,
    /// D.
    pub through: DMatrix<f64>,
    /// Constant rates of the states.
    pub constant_rates: DVector<f64>,
    /// Constant currents, A.
    pub constant_currents: DVector<f64>,
}

impl LinearControl {
    /// Of a levitation.
    #[must_use]
    pub fn new(levitation: &Levitation) -> Self {
        let linear = levitation.linear();
        let sizes = [
            linear.states(),
            linear.sensors().len(),
            linear.actuators().len(),
        ];
        let [states, sensors, actuators] = sizes;
        let total = states + sensors + actuators;
        let mut rates = DMatrix::zeros(states, total);
        let mut currents = DMatrix::zeros(actuators, total);
        let mut input = vec![0.0; total];
        for column in 0..total {
            input[column] = 1.0;
            let (rate, current) = answer(&linear, &input);
            rates.set_column(column, &rate);
            currents.set_column(column, &current);
            input[column] = 0.0;
        }
        let (constant_rates, constant_currents) = answer(&levitation.unlimited(), &input);
        Self {
            a: rates.columns(0, states).into(),
            by_displacement: rates.columns(states, sensors).into(),
            by_velocity: rates.columns(states + sensors, actuators).into(),
            currents: currents.columns(0, states).into(),
            through: currents.columns(states, sensors).into(),
            constant_rates,
            constant_currents,
        }
    }
}

/// Rates and currents for states, displacements and velocities in one list.
fn answer(levitation: &Levitation, input: &[f64]) -> (DVector<f64>, DVector<f64>) {
    let (states, rest) = input.split_at(levitation.states());
    let (displacements, velocities) = rest.split_at(levitation.sensors().len());
    let mut signals = levitation.signals();
    let mut rates = DVector::zeros(levitation.states());
    levitation.rate(
        states,
        displacements,
        velocities,
        &mut signals,
        rates.as_mut_slice(),
    );
    (rates, DVector::from_column_slice(&signals.currents))
}
