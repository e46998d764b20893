//! A rotor at a speed with everything that holds it: λ²M + λC + K and, where there are magnets, what their controllers add.

use crate::{C64, Dynamics, RotorError};
use nalgebra::{DMatrix, DVector};

/// What holds a rotor by forces that follow from its motion through states of their own, as magnets and controllers do.
///
/// At e^{λt} such a force is a stiffness that depends on λ. To modes, Campbell diagram, critical speeds and response to unbalance it
/// is a support like others.
pub trait Feedback: std::fmt::Debug + Send + Sync {
    /// Dynamic stiffness at λ and its derivative by λ, over the coordinates of the analysis: complex ones where it [turns](Self::turns),
    /// else those of both planes.
    fn stiffness(&self, eigenvalue: C64) -> Option<(DMatrix<C64>, DMatrix<C64>)>;
    /// All eigenvalues of a rotor with it, in the coordinates of the analysis; over real ones conjugates count.
    ///
    /// # Errors
    ///
    /// Where the eigen-solver does not converge.
    fn eigenvalues(&self, dynamics: &Dynamics<C64>) -> Result<Vec<C64>, RotorError>;
    /// Whether it treats every direction alike.
    fn turns(&self) -> bool;
}

/// A rotor at one speed, whole.
pub(crate) struct Whole<'a> {
    pub dynamics: Dynamics<C64>,
    pub feedback: Option<&'a dyn Feedback>,
}

impl Whole<'_> {
    /// λ²M + λC + K with the feedback, and its derivative 2λM + C with that of the feedback.
    pub fn at(&self, eigenvalue: C64) -> Option<(DMatrix<C64>, DMatrix<C64>)> {
        let Dynamics {
            mass,
            damping,
            stiffness,
        } = &self.dynamics;
        let square = eigenvalue * eigenvalue;
        let mut value = stiffness.clone();
        let mut slope = damping.clone();
        for (((to, by), m), c) in (value.iter_mut().zip(slope.iter_mut()))
            .zip(mass)
            .zip(damping)
        {
            *to += square * m + eigenvalue * c;
            *by += eigenvalue * m * 2.0;
        }
        if let Some(feedback) = self.feedback {
            let (own, by) = feedback.stiffness(eigenvalue)?;
            value += own;
            slope += by;
        }
        Some((value, slope))
    }

    /// A start vector that no mode is orthogonal to by symmetry; another for another `k`.
    pub fn start(&self, k: usize) -> DVector<C64> {
        DVector::from_fn(self.dynamics.mass.nrows(), |i, _| {
            let phase = (i as f64 + 1.0) * (1.0 + 0.37 * k as f64);
            C64::new(phase.cos(), (1.7 * phase).sin())
        })
    }

    /// The vector of an eigenvalue by inverse iteration.
    pub fn vector(
        &self,
        eigenvalue: C64,
        start: &DVector<C64>,
    ) -> Result<DVector<C64>, RotorError> {
        // Beside the eigenvalue, so that the factor exists: far below the distance to any other.
        let beside = eigenvalue * C64::new(1.0 + 1e-11, 1e-11) + 1e-11;
        let (value, slope) = self.at(beside).ok_or(RotorError::NotConverged)?;
        let factor = value.lu();
        let mut vector = start.clone();
        for _ in 0..3 {
            vector = (factor.solve(&(&slope * &vector))).ok_or(RotorError::NotConverged)?;
            let length = vector.norm();
            vector /= C64::from(length);
        }
        Ok(vector)
    }

    /// The eigenvalue and vector that Newton's iteration finds from those of a system nearby; `None` where it finds none.
    ///
    /// Steps below `round_off` (1/s) that do not get smaller are the end too.
    pub fn follow(
        &self,
        from: C64,
        vector: &DVector<C64>,
        round_off: f64,
    ) -> Option<(C64, DVector<C64>)> {
        const STEPS: usize = 12;
        let (mut value, mut vector, mut before) = (from, vector.clone(), f64::INFINITY);
        for _ in 0..STEPS {
            let (system, slope) = self.at(value)?;
            let next = match system.lu().solve(&(slope * &vector)) {
                Some(next) if next.iter().all(|z| z.re.is_finite() && z.im.is_finite()) => next,
                // The value is exact to the last digit: its factor does not exist.
                _ => return Some((value, vector)),
            };
            let share = vector.dotc(&next);
            let step = C64::from(1.0) / share;
            vector = &next / C64::from(next.norm());
            value -= step;
            let size = step.norm();
            if size <= 1e-13 * value.norm() || (size <= round_off && size >= 0.5 * before) {
                return Some((value, vector));
            }
            before = size;
        }
        None
    }
}
