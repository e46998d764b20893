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
    /// Who has the controllers that are not of the file; nobody where none may be.
    pub controllers: Option<&'a dyn Controllers>,
}

/// Whoever has controllers that a file names and does not describe.
pub trait Controllers: Sync {
    /// The controller of a file, for one machine, at its start.
    ///
    /// # Errors
    /// Why there is none, in words.
    fn start(&self, file: &str) -> Result<Box<dyn Controller>, String>;
    /// The file itself, for the run directory.
    fn content(&self, file: &str) -> Option<Vec<u8>>;
}

/// A sampled controller of all magnet axes of a machine.
pub trait Controller {
    /// Commands of all magnet axes, A or V, for the signals of all sensor axes, m, at a sample at a time, s; the next comes a period, s, later.
    ///
    /// # Errors
    /// Why it has none, in words.
    fn sample(&mut self, time: f64, signals: &[f64], period: f64) -> Result<Vec<f64>, String>;
}

impl<'a> Options<'a> {
    /// All cores, and nobody who watches.
    pub fn unwatched(interrupt: &'a AtomicBool) -> Self {
        Options {
            threads: None,
            interrupt,
            progress: &|_| {},
            controllers: None,
        }
    }
}
