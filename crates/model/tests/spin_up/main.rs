//! Physics sentences about the system `spin_up` and the steady moment ball by ball.

#[path = "../machines/counting.rs"]
mod counting;
#[path = "../machines/mod.rs"]
#[allow(dead_code)] // shared with the other tests
mod machines;

mod balls;
mod bistable;
mod lanes;
mod limits;
mod lubricant;
mod plateaus;
mod rig;
mod rolling;
mod steady;
