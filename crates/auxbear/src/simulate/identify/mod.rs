//! wip
use super::Options;
use super::outcome::Outcome;
use crate::problem::Problem;
use crate::scenario::{Identify, Scenario};
pub(super) struct Asked<'a> { identify: &'a Identify }
impl Asked<'_> { pub fn of(identify: &Identify) -> Result<Asked<'_>, Box<Problem>> { Ok(Asked { identify }) } }
pub(super) fn run(_: &Scenario, asked: &Asked, _: &Options) -> Outcome { let _ = asked.identify; todo!() }
