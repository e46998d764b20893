//! Physics sentences about the system `rig`.

mod balances;
mod bench;
mod clutch;
mod combinations;
mod limits;
mod programs;
mod sensors;
