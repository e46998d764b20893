//! The command as a user meets it: what it prints, how it ends, what it leaves on the disk.

mod bad_input;
mod bearings;
mod browser;
mod export;
mod fmu;
mod kills;
mod limits;
mod lists;
mod place;
mod rig;
mod run_directory;
mod schema;
mod service;
mod signals;
mod spin_up;
mod stiffness;
mod stopped;
mod studio;
mod study;
mod torque;
