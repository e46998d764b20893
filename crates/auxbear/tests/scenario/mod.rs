//! Scenario files: what they become, what is refused, what each message says.

mod bad_file;
mod bad_input;
mod bases;
mod blame;
mod bushing;
mod catalogue_file;
mod coast_down;
mod contact_angle;
mod files;
mod friction;
mod import;
mod limits;
mod lubricant;
mod lubricant_state;
mod notes;
mod pressure_limits;
mod resolved;
mod rotor;
mod rotor_inputs;
mod rotor_supports;
pub mod schema;
pub(crate) mod several;
mod spin_up;
mod spin_up_runs;
mod starting_files;
mod surfaces;
mod table;
