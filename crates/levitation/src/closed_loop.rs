//! Rotor, controller and magnets in one system of first order.
//!
//! States: q, q̇, states of the controller. With rows c of the sensor axes and b of the magnet axes,
//!
//! M q̈ + D q̇ + K q = bᵀ(k_i i + k_s b q) + F,   ẋ = A x + B_y c q + B_v b q̇,   i = C x + D_y c q

use crate::plant::{Coordinates, Plant};
use crate::{C64, Levitation, LinearControl, Refused, Resolvent};
use nalgebra::{DMatrix, DVector, RowDVector};

/// A rotor held by its magnets, linearised.
#[derive(Debug, Clone)]
pub struct ClosedLoop<T: Coordinates> {
    pub(crate) plant: Plant<T>,
    pub(crate) control: LinearControl,
    /// Rows of the sensor axes.
    pub(crate) observe: DMatrix<T>,
    /// Rows of the magnet axes.
    pub(crate) act: DMatrix<T>,
    /// k_i and k_s of the magnet axes.
    slopes: Vec<(f64, f64)>,
    matrix: DMatrix<T>,
    resolvent: Resolvent,
}

/// An eigenvalue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pole {
    /// λ, 1/s: Im λ > 0 turns with positive spin (forward where Ω > 0), Im λ < 0 against it.
    pub value: C64,
    /// Share of the motion that turns as the sign of Im λ says: 1 a circle, 0.5 a line. 1 for real eigenvalues.
    pub turning: f64,
}

impl Pole {
    /// Damping ratio -Re λ/|λ|.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        -self.value.re / self.value.norm()
    }
    /// Whether it oscillates, and is not one of filters and integrators.
    #[must_use]
    pub fn oscillates(&self) -> bool {
        self.value.im.abs() > 0.02 * self.value.norm()
    }
}

/// Whether a loop holds its rotor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// Every eigenvalue is left of the axis.
    Stable,
    /// An eigenvalue grows: the one with the largest real part.
    Unstable(C64),
    /// So many eigenvalues are zero: the rotor stays wherever it is, and any load moves it without bound.
    ZeroStiffness(usize),
}

/// |λ| below this is zero, 1/s: round-off leaves 1e-7 of either sign.
pub const ZERO: f64 = 1e-4;

impl<T: Coordinates> ClosedLoop<T> {
    /// A rotor with its levitation about the centres of the magnets. Over complex coordinates the levitation must be
    /// [`one_plane`](Levitation::one_plane) of the machine's. Refused where the mass matrix is singular.
    pub fn new(plant: Plant<T>, levitation: &Levitation) -> Result<Self, Refused> {
        Self::about(plant, levitation, levitation.slopes_at_centre())
    }

    /// The same with other slopes (k_i, k_s) of the magnet axes, as those about a static position.
    pub fn about(
        plant: Plant<T>,
        levitation: &Levitation,
        slopes: Vec<(f64, f64)>,
    ) -> Result<Self, Refused> {
        let rows = |axes: Vec<&crate::Axis>| {
            let rows = axes.iter().map(|axis| plant.axis(axis));
            stacked(rows.collect(), plant.size())
        };
        let empty = DMatrix::zeros(0, 0);
        let mut out = Self {
            observe: rows(levitation.sensors().iter().map(|s| &s.axis).collect()),
            act: rows(levitation.actuators().iter().map(|a| &a.axis).collect()),
            control: LinearControl::new(levitation),
            resolvent: Resolvent::new(&empty),
            matrix: empty,
            slopes,
            plant,
        };
        out.matrix = out.composed()?;
        out.resolvent = Resolvent::new(&out.matrix);
        Ok(out)
    }

    /// Number of states: coordinates, their rates, those of the controller.
    #[must_use]
    pub fn states(&self) -> usize {
        2 * self.plant.size() + self.control.a.nrows()
    }
    /// The rotor.
    #[must_use]
    pub fn plant(&self) -> &Plant<T> {
        &self.plant
    }

    /// bᵀ k_i.
    pub(crate) fn force_over_current(&self) -> DMatrix<T> {
        let mut out = self.act.transpose();
        for (mut column, (ki, _)) in out.column_iter_mut().zip(&self.slopes) {
            column.scale_mut(*ki);
        }
        out
    }

    /// K - bᵀ k_s b: stiffness with the magnets on and no control current.
    pub(crate) fn open_stiffness(&self) -> DMatrix<T> {
        let mut pushed = self.act.clone();
        for (mut row, (_, ks)) in pushed.row_iter_mut().zip(&self.slopes) {
            row.scale_mut(*ks);
        }
        &self.plant.stiffness - self.act.transpose() * pushed
    }

    /// ẋ = matrix · x of the closed loop.
    #[must_use]
    pub fn matrix(&self) -> &DMatrix<T> {
        &self.matrix
    }

    /// The closed loop at complex frequencies.
    #[must_use]
    pub fn resolvent(&self) -> &Resolvent {
        &self.resolvent
    }

    /// Amplitudes of the states under forces e^{st} on the coordinates.
    pub fn response(&self, s: C64, forces: DVector<C64>) -> Result<DVector<C64>, Refused> {
        let size = self.plant.size();
        let factor = self.plant.mass.map(T::complex).lu();
        let mut right = DVector::zeros(self.states());
        let accelerations = factor.solve(&forces).ok_or(Refused::Singular)?;
        right.rows_mut(size, size).copy_from(&accelerations);
        self.resolvent.solve(s, &right)
    }

    /// What a signal added to each sensor's does to the states' rates, the offset of the sensor: [0, M⁻¹bᵀk_i D, B_y].
    pub(crate) fn disturbance(&self) -> Result<DMatrix<T>, Refused> {
        let size = self.plant.size();
        let of = |m: &DMatrix<f64>| m.map(T::from_real);
        let sensors = self.observe.nrows();
        let mut out = DMatrix::zeros(self.states(), sensors);
        let forces = self.force_over_current() * of(&self.control.through);
        out.rows_mut(size, size).copy_from(&self.over_mass(forces)?);
        out.rows_mut(2 * size, self.control.a.nrows())
            .copy_from(&of(&self.control.by_displacement));
        Ok(out)
    }

    pub(crate) fn composed(&self) -> Result<DMatrix<T>, Refused> {
        let size = self.plant.size();
        let control = &self.control;
        let of = |m: &DMatrix<f64>| m.map(T::from_real);
        let force = self.force_over_current();
        let stiffness = self.open_stiffness() - &force * of(&control.through) * &self.observe;
        let mut right = DMatrix::zeros(size, self.states());
        right.columns_mut(0, size).copy_from(&-stiffness);
        right
            .columns_mut(size, size)
            .copy_from(&-self.plant.damping.clone());
        right
            .columns_mut(2 * size, control.a.nrows())
            .copy_from(&(force * of(&control.currents)));
        let accelerations = self.over_mass(right)?;
        let mut out = DMatrix::zeros(self.states(), self.states());
        out.view_mut((0, size), (size, size)).fill_with_identity();
        out.rows_mut(size, size).copy_from(&accelerations);
        let mut own = out.rows_mut(2 * size, control.a.nrows());
        own.columns_mut(0, size)
            .copy_from(&(of(&control.by_displacement) * &self.observe));
        own.columns_mut(size, size)
            .copy_from(&(of(&control.by_velocity) * &self.act));
        own.columns_mut(2 * size, control.a.nrows())
            .copy_from(&of(&control.a));
        Ok(out)
    }

    /// M⁻¹ times columns.
    pub(crate) fn over_mass(&self, right: DMatrix<T>) -> Result<DMatrix<T>, Refused> {
        let size = self.plant.size();
        if self.plant.mass == DMatrix::identity(size, size) {
            return Ok(right);
        }
        let factor = self.plant.mass.clone().lu();
        factor.solve(&right).ok_or(Refused::Singular)
    }

    /// Eigenvalues of the closed loop by modulus, each with its direction; of a conjugate pair over real coordinates one stands,
    /// its sign that of its whirl.
    pub fn poles(&self) -> Result<Vec<Pole>, Refused> {
        let mut values = T::eigenvalues(self.matrix.clone())?;
        values.sort_by(|a, b| a.norm().total_cmp(&b.norm()).then(a.im.total_cmp(&b.im)));
        if T::COMPLEX {
            let pole = |value| Pole {
                value,
                turning: 1.0,
            };
            return Ok(values.into_iter().map(pole).collect());
        }
        let upper = values.into_iter().filter(|value| value.im >= 0.0);
        Ok(upper.map(|value| self.directed(value)).collect())
    }

    /// Direction of a motion Re(v e^{λt}) over real coordinates, Im λ > 0: w = ½(X + jY)e^{λt} + ½ conj(X - jY) e^{λ̄t}.
    fn directed(&self, value: C64) -> Pole {
        let circle = Pole {
            value,
            turning: 1.0,
        };
        if !circle.oscillates() {
            return circle;
        }
        let Some(vector) = self.vector(value) else {
            return circle;
        };
        let half = self.plant.size() / 2;
        let j = C64::new(0.0, 1.0);
        let part = |sign: f64| -> f64 {
            let pairs = (0..half).map(|at| (vector[at] + j * sign * vector[at + half]).norm_sqr());
            pairs.sum()
        };
        let (forward, backward) = (part(1.0), part(-1.0));
        let share = forward / (forward + backward);
        if share >= 0.5 {
            Pole {
                value,
                turning: share,
            }
        } else {
            Pole {
                value: value.conj(),
                turning: 1.0 - share,
            }
        }
    }

    /// The vector of an eigenvalue by inverse iteration; `None` where the steps break down.
    fn vector(&self, value: C64) -> Option<DVector<C64>> {
        // beside the eigenvalue by far less than the distance to any other, so that the factor exists
        let beside = value * C64::new(1.0 + 1e-11, 1e-11);
        // entries of uneven size and phase: no direction is left out
        let mut vector = DVector::from_fn(self.states(), |index, _| {
            C64::from_polar(1.0 + 0.3 * (index as f64).sin(), 0.7 * index as f64)
        });
        for _ in 0..3 {
            vector = self.resolvent.solve(beside, &vector).ok()?;
            let norm = vector.norm();
            vector.unscale_mut(norm);
        }
        vector.iter().all(|v| v.is_finite()).then_some(vector)
    }

    /// Eigenvalues without the controller: currents at zero, the magnets' k_s on.
    pub fn open_loop(&self) -> Result<Vec<C64>, Refused> {
        let size = self.plant.size();
        let mut right = DMatrix::zeros(size, 2 * size);
        right
            .columns_mut(0, size)
            .copy_from(&-self.open_stiffness());
        right
            .columns_mut(size, size)
            .copy_from(&-self.plant.damping.clone());
        let mut out = DMatrix::zeros(2 * size, 2 * size);
        out.view_mut((0, size), (size, size)).fill_with_identity();
        out.rows_mut(size, size).copy_from(&self.over_mass(right)?);
        T::eigenvalues(out)
    }
}

/// Of an eigenvalue, the share of its size that rounding leaves of a real part that is none.
const ROUNDING: f64 = 1e-10;

/// What the eigenvalues say.
#[must_use]
pub fn verdict(poles: &[Pole]) -> Verdict {
    let zeros = poles.iter().filter(|pole| pole.value.norm() < ZERO).count();
    if zeros > 0 {
        return Verdict::ZeroStiffness(zeros);
    }
    let largest = poles
        .iter()
        .max_by(|a, b| a.value.re.total_cmp(&b.value.re));
    match largest {
        // a housing without damping that no loop touches swings for ever, but for rounding
        Some(pole) if pole.value.re > ROUNDING * pole.value.norm() => Verdict::Unstable(pole.value),
        _ => Verdict::Stable,
    }
}

fn stacked<T: Coordinates>(rows: Vec<RowDVector<T>>, size: usize) -> DMatrix<T> {
    if rows.is_empty() {
        return DMatrix::zeros(0, size);
    }
    DMatrix::from_rows(&rows)
}
