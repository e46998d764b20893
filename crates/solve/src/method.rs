//! A way to take a step.

use crate::system::Batch;
use crate::workspace::{Judgement, Workspace};
use number::Real;

/// How steps are taken.
pub trait Method<R: Real, B: Batch<R>> {
    /// Evaluations of the right-hand side in a step.
    fn evaluations(&self) -> u64;
    /// Largest growth of a step over the one before.
    const GROWTH: f64 = 5.0;
    /// Rates and probes at the start of the first step, or after a jump; `fresh` are the lanes that start or jumped.
    fn begin(&mut self, step: Place<R, B>, fresh: R::Mask, work: &mut Workspace<R>);
    /// A step from the start in the workspace: the state, rates and probes at its end, and what its error says.
    fn attempt(&mut self, step: Place<R, B>, work: &mut Workspace<R>) -> Judgement<R>;
    /// Lanes that accept the step, before its end becomes the start of the next.
    fn accept(&mut self, _accepted: R::Mask, _work: &Workspace<R>) {}
    /// What the next steps of a lane depend on besides the workspace.
    fn save(&self, _lane: usize) -> Vec<f64> {
        Vec::new()
    }
    /// Puts it back on a lane.
    fn restore(&mut self, _lane: usize, _saved: &[f64]) {}
}

/// What a step is taken of.
pub struct Place<'a, R: Real, B: Batch<R>> {
    pub batch: &'a B,
    pub mode: &'a B::Mode,
}
