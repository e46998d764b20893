//! Undamped critical speeds over the stiffness of the supports.
//!
//! Every support of the shaft gets the same stiffness k in both directions, housings keep theirs, seals do not count. A
//! forward critical speed obeys K x = Ω²(M - G)x, a backward one K x = Ω²(M + G)x.

use crate::basis::symmetric;
use crate::frame::Frame;
use crate::{Basis, Matrices, Place, Rotor, RotorError};
use nalgebra::DMatrix;

/// Critical speeds at one stiffness.
#[derive(Debug, Clone)]
pub struct MapPoint {
    /// Stiffness of each support, N/m.
    pub stiffness: f64,
    /// Forward critical speeds, rad/s, rising.
    pub forward: Vec<f64>,
    /// Backward critical speeds, rad/s, rising.
    pub backward: Vec<f64>,
}

/// The lowest `count` critical speeds of each sense for each stiffness, N/m.
///
/// # Errors
///
/// Where the supports leave a motion free.
pub fn stiffness_map(
    rotor: &Rotor,
    basis: &Basis,
    stiffnesses: &[f64],
    count: usize,
) -> Result<Vec<MapPoint>, RotorError> {
    crate::held(rotor, 0.0)?;
    let matrices = Matrices::new(rotor);
    let Frame {
        matrices, carried, ..
    } = Frame::new(rotor, &matrices, basis).turned();
    let (shaft, gyroscopic) = (matrices.stiffness, matrices.gyroscopic);
    let mass = DMatrix::<f64>::identity(basis.len(), basis.len());
    let point = |stiffness: &f64| {
        let mut whole = shaft.clone();
        for (row, support) in carried.rows.iter().filter(|(_, support)| !support.seal) {
            let k = match support.at {
                Place::Node(_) => *stiffness,
                Place::Housing(_) => {
                    let own = support.coefficients.at(0.0).stiffness;
                    0.5 * (own[0][0] + own[1][1])
                }
            };
            whole += row.tr_mul(row) * k;
        }
        let factor = whole.cholesky().ok_or(RotorError::NotHeld)?.unpack();
        let speeds = |inertia: DMatrix<f64>| -> Result<Vec<f64>, RotorError> {
            let half = factor
                .solve_lower_triangular(&inertia)
                .ok_or(RotorError::NotHeld)?;
            let both = factor
                .solve_lower_triangular(&half.transpose())
                .ok_or(RotorError::NotHeld)?;
            let eigen = symmetric((&both + both.transpose()) * 0.5)?;
            let mut found: Vec<f64> = (eigen.eigenvalues.iter())
                .filter(|value| **value > 0.0)
                .map(|value| 1.0 / value.sqrt())
                .collect();
            found.sort_by(f64::total_cmp);
            found.truncate(count);
            Ok(found)
        };
        Ok(MapPoint {
            stiffness: *stiffness,
            forward: speeds(&mass - &gyroscopic)?,
            backward: speeds(&mass + &gyroscopic)?,
        })
    };
    stiffnesses.iter().map(point).collect()
}
