//! Systems: one readable page each.

mod border;
pub mod cage_turns;
pub mod energy;
pub mod layout;
pub mod machine;
pub mod outer_race;
pub mod race_record;
pub mod rig;
pub mod sampling;
