//! The matrices of sensors, controller, delay and amplifiers, taken from the rates that a time run uses.

use crate::state_space::resolvent;
use crate::{C64, Levitation, Refused};
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

    /// Currents over displacements of the sensors, A/m, and over velocities of the magnet axes, A s/m, at a complex frequency;
    /// `None` at a pole.
    #[must_use]
    pub fn response(&self, s: C64) -> Option<(DMatrix<C64>, DMatrix<C64>)> {
        let displacements = self.by_displacement.ncols();
        let inputs = displacements + self.by_velocity.ncols();
        let mut right = DMatrix::zeros(self.a.nrows(), inputs);
        let (mut first, mut second) = right.columns_range_pair_mut(..displacements, displacements..);
        first.copy_from(&self.by_displacement.map(C64::from));
        second.copy_from(&self.by_velocity.map(C64::from));
        let both = self.currents.map(C64::from) * resolvent(&self.a, s, right)?;
        let over_displacement = both.columns(0, displacements);
        let over_velocity = both.columns(displacements, inputs - displacements).into();
        let through = self.through.map(C64::from);
        Some((over_displacement + through, over_velocity))
    }

    /// States under steady oscillation e^{st} of displacements and velocities.
    pub(crate) fn steady(
        &self,
        s: C64,
        displacements: &DVector<C64>,
        velocities: &DVector<C64>,
    ) -> Result<DVector<C64>, Refused> {
        let right = self.by_displacement.map(C64::from) * displacements
            + self.by_velocity.map(C64::from) * velocities;
        let found = resolvent(&self.a, s, DMatrix::from_columns(&[right]));
        Ok(found.ok_or(Refused::Singular)?.column(0).into())
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
    (rates, DVector::from_vec(signals.currents))
}
