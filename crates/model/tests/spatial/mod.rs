//! Physics sentences about bearings in space.

mod balances;
mod bits;
mod closed_forms;
mod in_machine;
mod planar_limit;
mod setup;
mod springs;
mod statics;
mod steady_moment;
mod turning;
