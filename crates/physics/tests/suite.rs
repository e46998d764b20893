//! All tests of the crate, in one binary.

mod dry_whirl;
mod film_regimes;
mod hertz_reference;
mod lubricant_traction;
mod rolling_reference;
mod rolling_rotor;
mod skf_published;
