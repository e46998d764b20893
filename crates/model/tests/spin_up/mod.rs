//! Physics sentences about the system `spin_up` and the steady moment ball by ball.

mod balls;
mod bistable;
mod implicit;
mod lanes;
mod limits;
mod lubricant;
mod plateaus;
mod rig;
mod rolling;
mod steady;
