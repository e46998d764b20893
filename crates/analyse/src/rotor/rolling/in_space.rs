//! A preloaded bearing in space to small motion along the weight: shift and tilt of the rotor in it, over the speed.
//!
//! ```text
//!   C = C_contact + C_balls + C_mount      compliances of shift w and tilt θ;  K = C⁻¹
//!   contact at both edges of the landing surface, b apart   1/k and 4/(k b²);  balls: inverse of their 5 × 5, axis and other tilt free
//!   K is two springs ½K_ww at z₀ ± h:  z₀ = K_wθ/K_ww,  h² = K_θθ/K_ww - z₀²
//! ```
//! A landing surface that touches at one place passes no moment on: then only the shift, the rings free to tilt.
//!
//! Source: derived; book/src/theory/rolling.md. Assumes: a ring that turns with the rotor, no spin of its balls but across the line of both contacts.

use model::auxiliary_bearing::AuxiliaryBearingConstants;
use nalgebra::{Matrix2, Matrix5};
use scenario::rotor::FlexibleRotor;

/// Stiffness along the weight, N/m, and what resists tilt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct InSpace {
    /// N/m.
    pub shift: f64,
    /// Where landing surfaces touch at both edges.
    pub tilt: Option<Tilting>,
}

/// Two equal springs that are shift and tilt of a bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tilting {
    /// Their middle from the node, m.
    pub middle: f64,
    /// Half their distance, m.
    pub half: f64,
    /// Stiffness against tilt about the node, N m/rad.
    pub stiffness: f64,
}

impl InSpace {
    /// Places of both springs at a node, m, where it holds tilt and they are on the rotor.
    pub fn places(&self, node: f64, rotor: &FlexibleRotor) -> Option<[f64; 2]> {
        let own = self.tilt?;
        let ends = rotor.pieces.iter().map(|own| own.layer.to);
        let length = ends.fold(0.0, f64::max);
        let places = [-1.0, 1.0].map(|side| node + own.middle + side * own.half);
        (places.iter().all(|own| (0.0..=length).contains(own))).then_some(places)
    }
    /// Of a bearing under a load on one row of it along the weight, N, at a speed, rad/s, with this stiffness of the contact, N/m. None of
    /// one in the plane or without preload.
    pub fn of(
        own: &AuxiliaryBearingConstants,
        (load, contact): (f64, f64),
        speed: f64,
    ) -> Option<Self> {
        let spatial = own.spatial()?;
        let found = spatial.preloaded(load, speed.abs())?;
        let balls = Matrix5::from(found.stiffness).transpose().try_inverse()?;
        // shift along x, tilt about y
        let place = [0, 4];
        let balls = Matrix2::from_fn(|i, j| balls[(place[i], place[j])]);
        let [first, .., last] = spatial.landing.stations[..] else {
            return Some(InSpace {
                shift: 1.0 / (1.0 / contact + balls[(0, 0)]),
                tilt: None,
            });
        };
        let mount = match spatial.mount.tilt_stiffness {
            free if free > 0.0 => 1.0 / free,
            _ => 0.0,
        };
        let tilting = 4.0 / (contact * (last - first).powi(2)) + mount;
        let whole = balls + Matrix2::new(1.0 / contact, 0.0, 0.0, tilting);
        let stiffness = whole.try_inverse()?;
        let (shift, mixed, tilt) = (stiffness[(0, 0)], stiffness[(0, 1)], stiffness[(1, 1)]);
        let middle = mixed / shift;
        Some(InSpace {
            shift,
            tilt: Some(Tilting {
                middle,
                half: (tilt / shift - middle * middle).max(0.0).sqrt(),
                stiffness: tilt,
            }),
        })
    }
}
