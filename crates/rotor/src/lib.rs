//! The flexible rotor: elements, matrices, modes, critical speeds, response to unbalance.
//!
//! ```text
//!        y                 node 0    1         2       3
//!        │  x              ●─────────●─────────●───────●      z, along the shaft
//!        │ /               ▲         disk      ▲
//!        o────► z          support             support
//! ```
//!
//! Ground frame: x right, y up, z along the shaft; spin Ω and every angle counter-clockwise about +z.
//! A node has the displacement w = x + jy of the geometric axis and the slope ψ = dw/dz = β - jα, α and β small
//! right-handed rotations about x and y. Shaft and disks are round, so both planes share one real matrix:
//!
//! M q̈ - jΩG q̇ + D_e q̇ + D_i(q̇ - jΩq) + K q = F,    q = (w₀, ψ₀, w₁, ψ₁, …, housings)
//!
//! Supports and seals may be anything; their forces are F_x + jF_y. Magnets are a [`Feedback`]. Where they treat x and y differently the same
//! equation is written in real coordinates (x-plane first, then y-plane), twice as many.
//!
//! What it does not model: torsion and axial motion, stress stiffening, shafts that are not round, large tilt,
//! supports that hold the slope of a node.

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

mod assembly;
mod basis;
mod campbell;
mod element;
mod error;
mod feedback;
mod frame;
mod mesh;
mod modes;
mod parts;
mod properties;
mod response;
mod stiffness_map;
mod support;
mod triangle;
mod whirl;

pub use assembly::{Dynamics, Matrices};
pub use basis::{Basis, unit_forces};
pub use campbell::{Branch, Campbell, Critical};
pub use element::{Element, ElementMatrices};
pub use error::RotorError;
pub use feedback::Feedback;
pub use mesh::{Mesh, MeshError, mesh};
pub use modes::{Analysis, Mode, ModeCount, Whirl};
pub use parts::{Disk, Housing, PointMass, Rotor, Unbalance};
pub use physics::shaft::{Annulus, Layer, Material};
pub use physics::support::{Block, Coefficients};
pub use properties::{Properties, properties};
pub use response::{Responder, Response, Sag, along, held, loads, sag, sag_under};
pub use stiffness_map::{MapPoint, stiffness_map};
pub use support::{Place, Support};
pub use whirl::{SmallestFriction, WhirlCurve, WhirlPoint, WhirlRange};

/// A complex number in double precision.
pub type C64 = nalgebra::Complex<f64>;

/// A real matrix.
pub type RealMatrix = nalgebra::DMatrix<f64>;
