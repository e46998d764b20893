//! Physics sentences about the system `rig`.

#[path = "../machines/mod.rs"]
#[allow(dead_code)] // shared with the other tests
mod machines;

mod balances;
mod bench;
mod clutch;
mod limits;
mod programs;
mod sensors;
