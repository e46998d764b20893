//! What a caller decides besides the scenario, and what the caller can follow.

use std::sync::atomic::AtomicBool;

/// An auxiliary bearing at an instant of a run that is not over yet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InterimBearing {
    /// Rotor centre relative to that of the inner race: to the right and upwards, m.
    pub rotor: [f64; 2],
    /// Normal force of rotor and inner race, N.
    pub force: f64,
    /// Azimuth of each ball from x, rad, and its load on the inner race, N.
    pub balls: Vec<[f64; 2]>,
}

/// A sampled instant of a run that is not over yet, for pictures of its progress.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InterimRow {
    /// Time from the start of the run, s.
    pub time: f64,
    /// Spin of the rotor, rad/s.
    pub speed: f64,
    /// Each auxiliary bearing.
    pub bearings: Vec<InterimBearing>,
}

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
    /// Called with the rows of the history as they are sampled, from any thread; of several members with those of the one that keeps them.
    pub rows: Option<&'a (dyn Fn(Vec<InterimRow>) + Sync)>,
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
            rows: None,
        }
    }
}
