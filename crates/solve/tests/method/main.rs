//! The method: order, events, landings, lanes, endings, work, allocations.

mod allocation;
mod endings;
mod events;
mod implicit;
mod landings;
mod lanes;
mod order;
mod problems;
mod schemes;
mod stepper;
mod work;
