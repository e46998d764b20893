//! Equilibrium of a bearing by ISO/TS 16281: linear in the displacements, without speed.
//!
//! ```text
//!   x_j = δx cos φ + δy sin φ,   z_j = δz + ½D_pw (τ_x sin φ - τ_y cos φ),   X = B cos α₀ + x_j,  L = √(X² + z_j²)
//!   Q = c_p (L - B)₊^1.5;   forces Q X/L radially, Q z_j/L axially at ½D_pw
//! ```
//! δz counts from the centred position, free play included; the tilt arm is ½D_pw for displacement and moment alike.
//!
//! Source: ISO/TS 16281:2008 (from memory). Valid: small displacements, no speed.

use super::linear::{Balance, Reaction};
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

/// How far beyond its play a ring is put to start from, m.
const CLOSE: f64 = 1e-6;

impl LinearBearing {
    /// Displacement under a load; the first ball stands at +x.
    ///
    /// # Errors
    /// Where no equilibrium is found.
    pub fn settle(&self, load: &RingLoad) -> Result<Displacement, NoEquilibrium> {
        let outside = load.to_array();
        let arm = 0.5 * self.pitch_diameter;
        let axial = self.centre_distance * self.free_angle.sin();
        // the play taken up along each part of the load
        let side = outside[0].hypot(outside[1]);
        let radial = self.centre_distance * (1.0 - self.free_angle.cos()) + CLOSE;
        let toward = |value: f64, play: f64| {
            if value == 0.0 {
                0.0
            } else {
                value.signum() * (play + CLOSE)
            }
        };
        let mut start = [0.0, 0.0, toward(outside[2], axial), 0.0, 0.0];
        if side > 0.0 {
            (start[0], start[1]) = (outside[0] / side * radial, outside[1] / side * radial);
        } else if outside[2] == 0.0 {
            let tilt = |k: usize| toward(outside[k], axial + 4.0 * CLOSE) / arm;
            (start[3], start[4]) = (tilt(3), tilt(4));
        }
        let balance = Balance {
            outside,
            arm,
            stiffness: self.balls as f64 * self.stiffness * 1e-3,
        };
        let (u, _) = balance.find(start, |u| {
            let at = self.reaction(std::array::from_fn(|k| Dual::<5>::variable(u[k], k)));
            Ok(Reaction {
                load: at.map(|load| -load.value),
                slope: at.map(|load| load.partial.map(|slope| -slope)),
                largest: 0.0,
                found: (),
            })
        })?;
        Ok(Displacement::from_array(u))
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
