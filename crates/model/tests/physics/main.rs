//! Physics sentences about parts and systems: each test's name is one.

#[path = "../machines/counting.rs"]
mod counting;
#[path = "../machines/mod.rs"]
mod machines;

mod allocation;
mod balances;
mod bushing;
mod drops;
mod implicit;
mod loads;
mod lubricant;
mod oil;
mod relatives;
mod rest;
mod separation;
mod several;
mod spin_up;
mod symmetry;
