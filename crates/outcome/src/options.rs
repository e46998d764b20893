//! What a caller decides besides the scenario, and what the caller can follow.

use std::sync::atomic::AtomicBool;

/// What a caller decides besides the scenario.
pub struct Options<'a> {
    /// Number of threads; all cores if none.
    pub threads: Option<usize>,
    /// Set to true, it stops the run at the next opportunity; what was computed is kept.
    pub interrupt: &'a AtomicBool,
    /// Called with the fraction of the run done, from 0 to 1, from any thread.
    pub progress: &'a (dyn Fn(f64) + Sync),
}

impl<'a> Options<'a> {
    /// All cores, and nobody who watches.
    pub fn unwatched(interrupt: &'a AtomicBool) -> Self {
        Options {
            threads: None,
            interrupt,
            progress: &|_| {},
        }
    }
}
