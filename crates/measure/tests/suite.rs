//! All tests of the crate in one binary.

mod cage_ramp;
mod cage_speed;
mod converter;
mod few_marks;
mod few_samples;
mod free_response;
mod gaps;
mod inertia;
mod marks;
mod order;
mod pickups;
mod pulse;
mod run_out;
mod sensor_frequency;
mod soft_clutch;
mod spectrum;
mod speed;
mod speed_channel;
mod speed_coverage;
mod speed_long;
mod speed_rest;
mod synthetic;
mod torque_sensor;
mod whole_chain;
