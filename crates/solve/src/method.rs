//! A way to take a step.

use crate::system::{Batch, Machine};
use crate::workspace::{Judgement, Workspace};
use number::Real;

/// How steps are taken.
pub(crate) trait Method<R: Real, B: Batch<R>> {
    /// Evaluations of the right-hand side in a step.
    const EVALUATIONS: u64;
    /// Rates and probes at the start of the first step, or after a jump.
    fn begin(&mut self, step: Place<R, B>, work: &mut Workspace<R>);
    /// A step from the start in the workspace: the state, rates and probes at its end, and what its error says.
    fn attempt(&mut self, step: Place<R, B>, work: &mut Workspace<R>) -> Judgement<R>;
}

/// What a step is taken of.
pub(crate) struct Place<'a, R: Real, B: Batch<R>> {
    pub batch: &'a B,
    pub mode: &'a B::Mode,
    /// The modes of the single machines.
    pub modes: &'a dyn Fn(usize) -> <B::Machine as Machine>::Mode,
}
