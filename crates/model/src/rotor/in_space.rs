//! A rotor in space: it moves along its axis, and a node of it is a body that tilts.
//!
//! ```text
//!   m z̈ = ΣF_z + m g_z                                   the shaft is axially rigid
//!   C = (w - o, z - |w - w_G|²/(2ℓ)),   w_G = 1ᵀMq/m,  ℓ from the centre of mass; the last term shortens a line that tilts
//!   ψ = β - jα rotation of the section;  b = (β, -α, 1),  a = b/|b|,  κ = 1/(|b|(1 + |b|))
//!   ω = [Ω + κ(βα̇ - αβ̇)] a + (α̇, β̇, αβ̇ - βα̇)/|b|²
//!   force F and moment M about C give   F_z on z;   F_⊥ - F_z(w - w_G)/ℓ on w,  +F_z(w - w_G)/ℓ on w_G
//!                                       (M_y - jM_x + jM_zψ)/|b|² - jκ(M·a)ψ on ψ;   M·a on φ
//! ```
//! The forces are the transposes of the motion: what the machine does on the node is what the coordinates receive, and its moment about
//! the axis of the frame is M_z.
//!
//! Source: derived; book/src/theory/spatial.md. Does not model: stress stiffening by the axial force, bending within the bearing's width.

use super::constants::RotorConstants;
use super::motion::{GeometricCentre, Node, RotorMotion};
use crate::spatial::rigid_body::{RigidBody, SpatialWrench};
use number::{Real, Vec2, Vec3, constants};

constants! {
    /// What acts along the axis of a rotor.
    pub struct AxialConstants {
        /// Gravity, m/s².
        gravity: R,
        /// Stiffness of the axial magnet while it holds, N/m.
        stiffness: R,
        /// Damping of it, N s/m.
        damping: R,
        /// What it carries besides, N: the weight along the axis, with the opposite sign.
        carried: R,
    }
}

/// Levers shorter than this do not shorten, m.
const LEAST_LEVER: f64 = 1e-3;

/// A node of the rotor in space.
#[derive(Clone, Debug)]
pub struct SpatialNode<R> {
    /// Its displacement.
    pub node: Node<R>,
    rotation: Node<R>,
    /// Mean displacement of the rotor's axis.
    whole: Node<R>,
    /// 1/ℓ, 1/m; zero where the lever is short.
    inverse_lever: R,
}

/// What it does.
#[derive(Clone, Copy, Debug)]
pub struct NodeMotion<R> {
    /// As a body with C for its centre.
    pub body: RigidBody<R>,
    /// w - w_G over ℓ.
    slope: Vec2<R>,
    tilt: GeometricCentre<R>,
    /// |b|.
    length: R,
    arms: [Vec2<R>; 2],
}

impl<R: Real> SpatialNode<R> {
    /// One a lane: its rotor, rows of displacement and rotation, datum, lever from the centre of mass, m.
    pub fn gather<'a>(
        constants: &dyn Fn(usize) -> (&'a RotorConstants, [&'a [f64]; 2], Vec2<f64>, f64),
    ) -> Self {
        let shares: Vec<Vec<f64>> = (0..R::LANES)
            .map(|lane| {
                let rotor = constants(lane).0;
                let mass = rotor.mass();
                let own = rotor.coordinates.iter().enumerate();
                let share = own.map(|(k, own)| match k < rotor.housings {
                    true => 0.0,
                    false => own.weight / mass,
                });
                share.collect()
            })
            .collect();
        let row = |which: usize| {
            Node::gather(&|lane| {
                let (rotor, rows, datum, _) = constants(lane);
                (
                    rotor,
                    rows[which],
                    if which == 0 { datum } else { Vec2::zero() },
                )
            })
        };
        SpatialNode {
            node: row(0),
            rotation: row(1),
            whole: Node::gather(&|lane| (constants(lane).0, &shares[lane][..], Vec2::zero())),
            inverse_lever: R::from_lanes(|lane| match constants(lane).3 {
                lever if lever.abs() < LEAST_LEVER => 0.0,
                lever => 1.0 / lever,
            }),
        }
    }
    /// Its motion, with the rotor's place and speed along the axis.
    #[inline(always)]
    pub fn motion(&self, rotor: &RotorMotion<R>, [place, speed]: [R; 2]) -> NodeMotion<R> {
        let (at, whole) = (self.node.centre(rotor), self.whole.centre(rotor));
        let tilt = self.rotation.centre(rotor);
        let (one, half) = (R::one(), R::splat(0.5));
        let off = at.position + self.node.datum - whole.position;
        let slope = off * self.inverse_lever;
        let (psi, rate) = (tilt.position, tilt.velocity);
        let length = (one + psi.length_squared()).sqrt();
        let inverse = length.recip();
        let axis = Vec3::new(psi.x, psi.y, one) * inverse;
        let turned = psi.cross(rate);
        let about = rotor.spin - turned * inverse / (one + length);
        let across = Vec3::new(-rate.y, rate.x, turned) * inverse.square();
        let (w, v) = (at.position, at.velocity);
        let along = speed - slope.dot(at.velocity - whole.velocity);
        NodeMotion {
            body: RigidBody {
                position: Vec3::new(w.x, w.y, place - half * slope.dot(off)),
                velocity: Vec3::new(v.x, v.y, along),
                scalar: one,
                vector: Vec3::zero(),
                spin: axis * about + across,
                axis,
            },
            slope,
            tilt,
            length,
            arms: [at.arm, whole.arm],
        }
    }
    /// Adds what acts on the node to forces on the coordinates; returns the moment about the axis through the mass centre, N m.
    #[inline(always)]
    pub fn push(&self, at: &NodeMotion<R>, on: &SpatialWrench<R>, [x, y]: [&mut [R]; 2]) -> R {
        let (force, moment) = (on.force, on.moment);
        let shortening = at.slope * force.z;
        let across = Vec2::new(force.x, force.y) - shortening;
        let (psi, length) = (at.tilt.position, at.length);
        let inverse = length.recip();
        let about = moment.dot(at.body.axis);
        let kappa = inverse / (R::one() + length);
        let couple = (Vec2::new(moment.y, -moment.x) + psi.turned() * moment.z) * inverse.square()
            - psi.turned() * (kappa * about);
        self.node.push(across, [&mut *x, &mut *y]);
        self.whole.push(shortening, [&mut *x, &mut *y]);
        self.rotation.push(couple, [x, y]);
        let [arm, of_whole] = at.arms;
        about + arm.cross(across) + of_whole.cross(shortening) + at.tilt.arm.cross(couple)
    }
}
