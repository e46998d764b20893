//! Physics sentences about parts and systems: each test's name is one.

mod allocation;
mod balances;
mod base;
mod bushing;
mod drops;
mod dynamic_stiffness;
mod implicit;
mod loads;
mod lubricant;
mod oil;
mod planes;
mod relatives;
mod rest;
mod seals;
mod separation;
mod several;
mod spin_up;
mod symmetry;
