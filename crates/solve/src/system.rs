//! What the solver integrates.

use number::Real;

/// One initial value problem ẏ = f(t, y), over `f64`.
///
/// The state is a list of channels. Besides its rate, the problem reports *probes*: values computed on the way
/// (forces, gaps) that an observer watches.
/// Discrete facts that switch at known instants are a [`Mode`](Machine::Mode), constant between two landings.
pub trait Machine: Sync {
    /// Discrete facts.
    type Mode: Copy + Send;

    /// Number of channels.
    fn dimension(&self) -> usize;
    /// Number of last channels that the rate does not depend on: sums kept along the way, such as heats.
    /// Their values in the state given to the rate are not those of its instant.
    fn quadratures(&self) -> usize {
        0
    }
    /// Number of probes.
    fn probes(&self) -> usize;
    /// Number of first probes that an observer sees at the ends of a step; the others it must evaluate.
    fn watched_probes(&self) -> usize {
        self.probes()
    }
    /// Number of first channels that an observer looks at in every step: they lie ready, the others cost a call each.
    fn watched_channels(&self) -> usize {
        0
    }
    /// The error a tolerance of 1 allows in each channel: the magnitude that matters there.
    fn error_scale(&self, channel: usize) -> f64;
    /// Name of a channel, for messages.
    fn channel_name(&self, channel: usize) -> String;
    /// The mode at the start.
    fn start_mode(&self) -> Self::Mode;
    /// Instants, ascending, that a step must end on.
    fn landings(&self) -> &[f64];
    /// The only place where the mode, or the state, jumps: at the landing of that index.
    fn transition(&self, landing: usize, mode: &mut Self::Mode, state: &mut [f64]);
    /// The right-hand side, for one machine. Probes are computed only where `probe` is not empty.
    fn rate(
        &self,
        mode: &Self::Mode,
        time: f64,
        state: &[f64],
        rate: &mut [f64],
        probe: &mut [f64],
    );
}

/// The same problem for one machine per lane. They share structure: dimension, probes, variants.
pub trait Batch<R: Real>: Sync + Sized {
    /// One machine of the batch.
    type Machine: Machine;
    /// The modes of all lanes.
    type Mode: Copy;

    /// Puts one machine in each lane; lane `i` is `machine(i)`.
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self::Machine) -> Self
    where
        Self::Machine: 'a;
    /// Puts the modes side by side.
    fn gather_mode(modes: &dyn Fn(usize) -> <Self::Machine as Machine>::Mode) -> Self::Mode;
    /// The right-hand side of all lanes. Probes are computed only where `probe` is not empty, and then only the first
    /// ones, as many as it has room for: all or the watched ones.
    /// Must be `#[inline(always)]` down to the last law it calls.
    fn rate(&self, mode: &Self::Mode, time: R, state: &[R], rate: &mut [R], probe: &mut [R]);
}
