//! Magnets and their controllers as what holds a rotor at every speed: a stiffness that depends on λ.
//!
//! f = bᵀ(k_i i + k_s b q) with i = C(λ - A)⁻¹(B_y c + λB_v b) q + D_y c q, rows and matrices as in [`ClosedLoop`].

use crate::plant::Coordinates;
use crate::{C64, ClosedLoop, Levitation, Plant, Refused};
use nalgebra::DMatrix;
use rotor::{Analysis, Dynamics, Feedback, RotorError};
use std::sync::Arc;

/// The levitation of a rotor in the coordinates of an analysis.
#[derive(Debug)]
struct Suspension<T: Coordinates> {
    closed: ClosedLoop<T>,
    a: DMatrix<C64>,
    by_displacement: DMatrix<C64>,
    by_velocity: DMatrix<C64>,
    /// -bᵀk_i C.
    of_states: DMatrix<C64>,
    /// -bᵀ(k_i D_y c + k_s b).
    at_once: DMatrix<C64>,
}

/// Magnets as what holds a rotor, in the coordinates of an analysis without them: complex ones where every direction is alike.
///
/// - `slopes` k_i and k_s of each axis, as about a [static equilibrium](crate::response::Equilibrium)
///
/// # Errors
///
/// As [`ClosedLoop::new`].
pub fn suspension(
    analysis: &Analysis,
    nodes: usize,
    levitation: &Levitation,
    slopes: &[(f64, f64)],
) -> Result<Arc<dyn Feedback>, Refused> {
    if let Some((plane, slopes)) = levitation.one_plane_about(slopes)
        && let Some(plant) = Plant::turning(analysis, nodes, 0.0)
    {
        let closed = ClosedLoop::about(plant, &plane, slopes)?;
        return Ok(Arc::new(Suspension::of(closed)));
    }
    let plant = Plant::planes(analysis, nodes, 0.0);
    let closed = ClosedLoop::about(plant, levitation, slopes.to_vec())?;
    Ok(Arc::new(Suspension::of(closed)))
}

impl<T: Coordinates> Suspension<T> {
    fn of(closed: ClosedLoop<T>) -> Self {
        let whole = |m: DMatrix<T>| m.map(T::complex);
        let of = |m: &DMatrix<f64>| m.map(T::from_real);
        let control = &closed.control;
        let force = closed.force_over_current();
        let springs = closed.open_stiffness() - &closed.plant.stiffness;
        Self {
            a: whole(of(&control.a)),
            by_displacement: whole(of(&control.by_displacement) * &closed.observe),
            by_velocity: whole(of(&control.by_velocity) * &closed.act),
            of_states: -whole(&force * of(&control.currents)),
            at_once: whole(springs - &force * of(&control.through) * &closed.observe),
            closed,
        }
    }
}

impl<T: Coordinates> Feedback for Suspension<T> {
    fn stiffness(&self, eigenvalue: C64) -> Option<(DMatrix<C64>, DMatrix<C64>)> {
        let mut system = -self.a.clone();
        for index in 0..system.nrows() {
            system[(index, index)] += eigenvalue;
        }
        let factor = system.lu();
        let input = &self.by_displacement + self.by_velocity.map(|v| v * eigenvalue);
        let states = factor.solve(&input)?;
        let slopes = factor.solve(&(&self.by_velocity - &states))?;
        Some((
            &self.at_once + &self.of_states * states,
            &self.of_states * slopes,
        ))
    }

    fn eigenvalues(&self, dynamics: &Dynamics<C64>) -> Result<Vec<C64>, RotorError> {
        let mut closed = self.closed.clone();
        closed.plant.mass = dynamics.mass.map(T::of);
        closed.plant.damping = dynamics.damping.map(T::of);
        closed.plant.stiffness = dynamics.stiffness.map(T::of);
        (closed.composed().and_then(T::eigenvalues)).map_err(|_| RotorError::NotConverged)
    }

    fn turns(&self) -> bool {
        T::COMPLEX
    }
}
