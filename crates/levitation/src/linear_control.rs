//! The matrices of sensors, controller, delay and amplifiers, taken from the rates that a time run uses.

use crate::{C64, Inputs, Levitation};
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

    /// What a displacement (m) of every sensor makes of each state, the largest over slow, usual and quick motions: a measure of
    /// what matters in it. 1 where nothing reaches it.
    #[must_use]
    pub fn scales(levitation: &Levitation, displacement: f64) -> Vec<f64> {
        let linear = levitation.linear();
        let control = LinearControl::new(levitation);
        let size = control.a.nrows();
        let mut largest = vec![0.0_f64; size];
        for omega in [1e2, 1e3, 1e4] {
            let turning = DMatrix::from_diagonal_element(size, size, C64::new(0.0, omega));
            let inputs = control.by_displacement.map(C64::from);
            let Some(found) = (turning - control.a.map(C64::from)).lu().solve(&inputs) else {
                continue;
            };
            for (own, row) in largest.iter_mut().zip(found.row_iter()) {
                *own = own.max(displacement * row.iter().map(|entry| entry.norm()).sum::<f64>());
            }
        }
        // a sampled loop has held commands in place of a delay's states
        // and both coils of an axis stand for its control current
        let own = |name: &String| {
            let of = name.trim_end_matches([' ', '+', '-']);
            linear.names().iter().position(|own| own == of)
        };
        let of = |name| own(name).map_or(0.0, |at| largest[at]);
        let scales = levitation.names().iter().map(of);
        scales
            .map(|scale| if scale > 0.0 { scale } else { 1.0 })
            .collect()
    }
}

/// Rates and currents for states, displacements and velocities in one list.
fn answer(levitation: &Levitation, input: &[f64]) -> (DVector<f64>, DVector<f64>) {
    let (states, rest) = input.split_at(levitation.states());
    let (displacements, velocities) = rest.split_at(levitation.sensors().len());
    let mut signals = levitation.signals();
    let mut rates = DVector::zeros(levitation.states());
    let inputs = Inputs::usual(displacements, velocities);
    levitation.rate(states, inputs, &mut signals, rates.as_mut_slice());
    (rates, DVector::from_column_slice(&signals.currents))
}
