//! All tests of the crate but those that count memory, in one binary.

mod accuracy;
mod cage_forces;
mod catalogue;
mod catalogue_file;
mod drop_method;
mod extremes;
mod exudyn_cage_spin_up;
mod feedback;
mod held_limits;
mod levitated_run;
mod machine;
mod machine_supports;
mod measurement_file;
mod races;
mod reference_scenario;
mod rig_to_verdict;
mod rotor_friction;
mod rotor_torque;
mod run_out;
mod scenario;
mod signals;
mod signals_analysis;
mod signals_files;
mod speed_channel;
mod torque;
mod validation;
