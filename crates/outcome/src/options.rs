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

/// Threads for each core, at most: more only cost time.
const THREADS_A_CORE: usize = 8;

/// Starts the shared pool with a thread a core, whatever RAYON_NUM_THREADS says; a pool that is there already stays.
pub fn start_pool() {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(cores);
    let _ = pool.build_global();
}

/// Runs something on so many threads, or as many as help on this machine; on the shared pool where none are asked for. Numbers do not
/// depend on it.
pub fn in_pool<T: Send>(threads: Option<usize>, run: impl FnOnce() -> T + Send) -> T {
    let pool = threads.map(|threads| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(bounded(threads))
            .build()
    });
    match pool {
        Some(Ok(pool)) => pool.install(run),
        // the machine refuses more threads: the shared pool gives the same numbers
        _ => run(),
    }
}

/// So many threads, or as many as help on this machine.
pub fn bounded(threads: usize) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    threads.min(THREADS_A_CORE * cores)
}
