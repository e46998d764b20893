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

    /// Whether the step after a jump is as long as the first of all; else the steps go on.
    fn starts_afresh(&self) -> bool {
        false
    }
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
    /// Instants, ascending, that a step must end on, where they are known from the start.
    fn landings(&self) -> &[f64] {
        &[]
    }
    /// The instant of the landing of that index; infinite where there is none in this mode.
    fn due(&self, _mode: &Self::Mode, landing: usize) -> f64 {
        self.landings()
            .get(landing)
            .copied()
            .unwrap_or(f64::INFINITY)
    }
    /// What jumps of the mode and of the state at the landing of that index.
    fn transition(&self, landing: usize, mode: &mut Self::Mode, state: &mut [f64]);
    /// Another machine that goes on in this mode after a landing: one of the same channels, probes and landings.
    fn changed(&self, _mode: &Self::Mode) -> Option<Box<Self>>
    where
        Self: Sized,
    {
        None
    }
    /// Positive while the mode holds: where it falls to zero, a step ends and a state event happens. `at` are the channels of the
    /// state, the watched ones at least, and the watched probes.
    fn guard(&self, _mode: &Self::Mode, _time: f64, _at: (&[f64], &[f64])) -> f64 {
        f64::INFINITY
    }
    /// Largest size of the guard at an event; infinite where the instant that dense output shows is good enough.
    fn guard_error(&self, _mode: &Self::Mode) -> f64 {
        f64::INFINITY
    }
    /// What jumps of the mode and of the state at a state event.
    fn cross(&self, _time: f64, _mode: &mut Self::Mode, _state: &mut [f64]) {}
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
