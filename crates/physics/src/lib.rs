//! The laws: numbers in, numbers out.
//!
//! No state, no allocation, no input or output. Every public law names its formula, its arguments with units,
//! its source and its valid range. Laws used inside the time loop are generic over [`number::Real`];
//! laws used once, when constants are built, are plain `f64`.
//!
//! | module | law |
//! |---|---|
//! | [`materials`] | elastic constants and densities |
//! | [`hertz`] | point contact between ball and race: exact elliptic integrals |
//! | [`contact`] | normal force of a contact in time: Hertz with damping, Hunt-Crossley |
//! | [`traction`] | sliding friction between ball and race |
//! | [`friction`] | steady friction moment of a rolling bearing: one interface to the next three |
//! | [`palmgren`] | Palmgren's moment |
//! | [`skf`] | the SKF model: rolling, sliding, drag, seals |
//! | [`skf_constants`] | its constants by bearing type and series, and what is refused |
//! | [`moment_curve`] | a measured moment over speed |
//! | [`rolling`] | a bearing whose balls roll: the source paper's equations 6-19 |
//! | [`kinematics`] | speeds of cage and balls, passing frequencies |
//! | [`unbalance`] | whirl of an unbalanced rotor on a linear support |

pub mod contact;
pub mod friction;
pub mod hertz;
pub mod kinematics;
pub mod materials;
pub mod moment_curve;
pub mod palmgren;
mod power;
pub mod rolling;
pub mod skf;
pub mod skf_constants;
pub mod traction;
pub mod unbalance;
