//! Equilibrium of a bearing by ISO/TS 16281: linear in the displacements, without speed.
//!
//! ```text
//!   x_j = δx cos φ + δy sin φ,   z_j = δz + ½D_pw (τ_x sin φ - τ_y cos φ),   X = B cos α₀ + x_j,  L = √(X² + z_j²)
//!   Q = c_p (L - B)₊^1.5;   forces Q X/L radially, Q z_j/L axially at ½D_pw
//! ```
//! δz counts from the centred position, free play included; the tilt arm is ½D_pw for displacement and moment alike.
//!
//! Source: ISO/TS 16281:2008 (from memory). Valid: small displacements, no speed.

use super::linear::solve;
use super::ring::{Displacement, NoEquilibrium, RingLoad};
use number::{Dual, Real};
use std::f64::consts::TAU;

/// A bearing of ISO/TS 16281.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearBearing {
    /// Number of balls.
    pub balls: usize,
    /// Pitch diameter D_pw, m.
    pub pitch_diameter: f64,
    /// Distance of the groove centres B, m.
    pub centre_distance: f64,
    /// Free contact angle α₀, rad.
    pub free_angle: f64,
    /// Stiffness c_p of both contacts in series, N/m^1.5.
    pub stiffness: f64,
}

/// Longest step, m.
const LONGEST_STEP: f64 = 5e-6;

impl LinearBearing {
    /// Displacement under a load; the first ball stands at +x.
    ///
    /// # Errors
    /// Where no equilibrium is found.
    pub fn settle(&self, load: &RingLoad) -> Result<Displacement, NoEquilibrium> {
        let ([x, y, z], [a, b]) = (load.force, load.moment);
        let outside = [x, y, z, a, b];
        let arm = 0.5 * self.pitch_diameter;
        let lengths = [1.0, 1.0, 1.0, arm, arm];
        let largest = (0..5).fold(1e-6_f64, |most, k| most.max(outside[k].abs() / lengths[k]));
        let radial = self.centre_distance * (1.0 - self.free_angle.cos());
        let axial = self.centre_distance * self.free_angle.sin();
        let toward = |value: f64, play: f64| {
            if value == 0.0 {
                0.0
            } else {
                value.signum() * (play + 1e-6)
            }
        };
        let side = x.hypot(y).max(1e-300);
        let mut u = [
            x / side * toward(side, radial),
            y / side * toward(side, radial),
            toward(z, axial),
            0.0,
            0.0,
        ];
        if x == 0.0 && y == 0.0 && z == 0.0 {
            (u[3], u[4]) = (toward(a, axial + 4e-6) / arm, toward(b, axial + 4e-6) / arm);
        }
        let reference = self.balls as f64 * self.stiffness * 1e-3;
        for _ in 0..600 {
            let at = self.reaction(std::array::from_fn(|k| Dual::variable(u[k], k)));
            let left: [f64; 5] = std::array::from_fn(|k| outside[k] - at[k].value);
            let share =
                (0..5).fold(0.0_f64, |most, k| most.max(left[k].abs() / lengths[k])) / largest;
            if share < 1e-12 {
                return Ok(Displacement {
                    shift: [u[0], u[1], u[2]],
                    tilt: [u[3], u[4]],
                });
            }
            let mut matrix = at.map(|load| load.partial);
            for (k, length) in lengths.iter().enumerate() {
                matrix[k][k] += reference * (share * share).min(1e-2) * length * length;
            }
            let step = solve(matrix, left).ok_or(NoEquilibrium::Ring)?;
            let longest = (0..5).fold(0.0_f64, |most, k| most.max((step[k] * lengths[k]).abs()));
            let shorter = (LONGEST_STEP / longest).min(1.0);
            for (value, step) in u.iter_mut().zip(&step) {
                *value += shorter * step;
            }
        }
        Err(NoEquilibrium::Ring)
    }

    /// The load that displaces the ring so.
    fn reaction<R: Real>(&self, [x, y, z, a, b]: [R; 5]) -> [R; 5] {
        let mut sum = [R::zero(); 5];
        let arm = R::splat(0.5 * self.pitch_diameter);
        for j in 0..self.balls {
            let azimuth = TAU * j as f64 / self.balls as f64;
            let (sine, cosine) = (R::splat(azimuth.sin()), R::splat(azimuth.cos()));
            let out =
                R::splat(self.centre_distance * self.free_angle.cos()) + x * cosine + y * sine;
            let along = z + arm * (a * sine - b * cosine);
            let length = (out.square() + along.square()).sqrt();
            let depth = (length - R::splat(self.centre_distance)).max(R::zero());
            let load = R::splat(self.stiffness) * depth * depth.sqrt() / length;
            let (radial, axial) = (load * out, load * along);
            sum[0] += radial * cosine;
            sum[1] += radial * sine;
            sum[2] += axial;
            sum[3] += arm * axial * sine;
            sum[4] -= arm * axial * cosine;
        }
        sum
    }
}
