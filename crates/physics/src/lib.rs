//! The laws: numbers in, numbers out.
//!
//! No state, no input or output, no allocation but where a measured curve or a list for a report is built. Every public
//! law names its formula, its arguments with units, its source and its valid range. Laws used inside the time loop are generic over [`number::Real`];
//! laws used once, when constants are built, are plain `f64`.
//!
//! | module | law |
//! |---|---|
//! | [`materials`] | elastic constants and densities |
//! | [`hertz`] | point contact between ball and race: exact elliptic integrals |
//! | [`angular_contact`] | contacts at an angle, seen in the plane |
//! | [`ring`] | rings pressed on a shaft or into a housing, rings that spin |
//! | [`contact`] | normal force of a contact in time: Hertz with damping, Hunt-Crossley |
//! | [`groove`] | a ball in the grooves of two rings, in space: contact angle as a result |
//! | [`contact_nodes`] | points of a contact ellipse at which slip is taken |
//! | [`traction`] | sliding friction between ball and race |
//! | [`film`] | thickness of the lubricant film between ball and race |
//! | [`lubricant`] | lubricants: viscosity over temperature and pressure, limiting stress |
//! | [`lubricant_state`] | grease that builds up and breaks down, contact films that warm: factors on drag and traction |
//! | [`lubricant_traction`] | sliding friction between ball and race from the lubricant |
//! | [`inlet_rolling`] | rolling resistance of the oil in the inlet of a contact |
//! | [`heat_conduction`] | heat that flows into half-spaces and slabs, bodies that touch |
//! | [`heat_exchange`] | conductances: contacts, walls, fits, gas, radiation, surroundings |
//! | [`air`] | air that takes heat, at any pressure |
//! | [`flash`] | surface temperatures under heat that moves |
//! | [`load_zone`] | loads of the balls under a radial load |
//! | [`life`] | rolling contact fatigue: ratings, damage, factors |
//! | [`severity`] | indentations, wear, safeties |
//! | [`rainflow`] | cycles of a load history |
//! | [`rating`] | load ratings C and C0 of a row of balls |
//! | [`friction`] | steady friction moment of a rolling bearing: one interface to Palmgren's, the SKF model and a measured curve |
//! | [`friction_range`] | where a friction law has been left |
//! | [`palmgren`] | Palmgren's moment |
//! | [`palmgren_factors`] | his factors by bearing type, series and lubrication, as makers print them |
//! | [`static_load`] | static equivalent load under combined load |
//! | [`skf`] | the SKF model: rolling, sliding, drag, seals |
//! | [`skf_constants`] | its constants by bearing type and series, and what is refused |
//! | [`moment_curve`] | a measured moment over speed |
//! | [`viscosity`] | viscosity of an oil over temperature |
//! | [`rolling`] | a bearing whose balls roll: the source paper's equations 6-19 |
//! | [`spin_up_energy`] | what a bearing dissipates while it is spun up: equation 21, printed and put right |
//! | [`kinematics`] | speeds of cage and balls, passing frequencies |
//! | [`shaft`] | what a shaft is made of: round sections and elastic materials |
//! | [`support`] | linear supports and seals: stiffness, damping and mass over speed |
//! | [`magnet`] | force of a radial magnet: linear, or an opposed pair with bias, gap and limited currents |
//! | [`unbalance`] | whirl of an unbalanced rotor on a linear support |
//! | [`rolling_rotor`] | a rotor that rolls in a bore under its weight: stiffness of its contact along and across |
//! | [`dry_whirl`] | backward whirl round a bore: the friction it needs, its contact force |

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

pub mod air;
pub mod angular_contact;
#[cfg(test)]
mod bearing_6005;
pub mod contact;
pub mod contact_nodes;
pub mod dry_whirl;
pub mod film;
pub mod flash;
pub mod friction;
pub mod friction_range;
pub mod groove;
pub mod heat_conduction;
pub mod heat_exchange;
pub mod hertz;
pub mod inlet_rolling;
pub mod kinematics;
pub mod life;
pub mod load_zone;
pub mod lubricant;
pub mod lubricant_state;
pub mod lubricant_traction;
pub mod magnet;
pub mod materials;
pub mod moment_curve;
pub mod moment_parts;
pub mod palmgren;
pub mod palmgren_factors;
mod power;
pub mod rainflow;
pub mod rating;
pub mod response_spectrum;
pub mod ring;
pub mod rolling;
pub mod rolling_rotor;
pub mod severity;
pub mod shaft;
pub mod skf;
pub mod skf_constants;
pub mod sliding_contact;
pub mod spin_up_energy;
pub mod static_load;
pub mod support;
pub mod traction;
pub mod unbalance;
pub mod viscosity;
