//! Response of the closed loop at one frequency after another.

use crate::plant::Coordinates;
use crate::{C64, ClosedLoop, LinearControl, Refused};
use nalgebra::{DMatrix, DVector};

/// A closed loop prepared for many frequencies.
#[derive(Debug, Clone)]
pub struct Frequencies {
    mass: DMatrix<C64>,
    damping: DMatrix<C64>,
    /// With k_s, without controller.
    stiffness: DMatrix<C64>,
    observe: DMatrix<C64>,
    act: DMatrix<C64>,
    /// bᵀ k_i.
    force: DMatrix<C64>,
    control: LinearControl,
    induces: bool,
}

impl Frequencies {
    /// Of a closed loop.
    #[must_use]
    pub fn new<T: Coordinates>(closed: &ClosedLoop<T>) -> Self {
        let of = |m: &DMatrix<T>| m.map(T::complex);
        Self {
            mass: of(&closed.plant.mass),
            damping: of(&closed.plant.damping),
            stiffness: of(&closed.open_stiffness()),
            observe: of(&closed.observe),
            act: of(&closed.act),
            force: of(&closed.force_over_current()),
            induces: closed.control.by_velocity.iter().any(|v| *v != 0.0),
            control: closed.control.clone(),
        }
    }

    /// M s² + D s + K with k_s and what velocities induce, without what displacements command.
    fn open(&self, s: C64, over_velocity: &DMatrix<C64>) -> DMatrix<C64> {
        let mut out = self.stiffness.clone();
        out.zip_zip_apply(&self.mass, &self.damping, |value, m, d| {
            *value += s * (s * m + d);
        });
        if self.induces {
            out -= &self.force * over_velocity * &self.act * s;
        }
        out
    }

    /// Displacement of the sensors over the commanded currents' share of force that displacements of the sensors cause: P k.
    fn around(&self, s: C64) -> Result<DMatrix<C64>, Refused> {
        let (over_displacement, over_velocity) =
            self.control.response(s).ok_or(Refused::Singular)?;
        let factor = self.open(s, &over_velocity).lu();
        let moved = factor.solve(&self.force).ok_or(Refused::Singular)?;
        Ok(&self.observe * moved * over_displacement)
    }

    /// The sensitivity matrix (1 - P k)⁻¹ between the signals of all sensors: P from force to sensor with k_s, k from sensor to
    /// force. Its diagonal is that of one axis opened with all others closed.
    pub fn sensitivity(&self, s: C64) -> Result<DMatrix<C64>, Refused> {
        let around = self.around(s)?;
        let size = around.nrows();
        let left = DMatrix::identity(size, size) - around;
        left.try_inverse().ok_or(Refused::Singular)
    }

    /// Amplitudes of the coordinates, and of the currents in A, under forces e^{st} on the coordinates.
    pub fn response(
        &self,
        s: C64,
        forces: &DVector<C64>,
    ) -> Result<(DVector<C64>, DVector<C64>), Refused> {
        let (over_displacement, over_velocity) =
            self.control.response(s).ok_or(Refused::Singular)?;
        let closed =
            self.open(s, &over_velocity) - &self.force * &over_displacement * &self.observe;
        let answer = closed.lu().solve(forces).ok_or(Refused::Singular)?;
        let currents = over_displacement * (&self.observe * &answer)
            + over_velocity * (&self.act * &answer) * s;
        Ok((answer, currents))
    }
}
