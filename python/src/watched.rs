//! Work on a thread of its own, without the lock of the interpreter. The calling thread wakes now and then to look for Ctrl-C and
//! to report the progress; either may end the work.

use auxbear::run::Options;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};
use std::{process, thread};

/// Time between looks: short for who waits for an answer to Ctrl-C, long beside a look.
const PAUSE: Duration = Duration::from_millis(50);

/// Time that work has to end after Ctrl-C; then its thread is left to end by itself, and what it finds is dropped.
pub const PATIENCE: Duration = Duration::from_millis(500);

/// The same of work that keeps a directory, which stays locked until its thread ends.
pub const LONG_PATIENCE: Duration = Duration::from_secs(10);

/// The process in which work was done first: its pool of threads is not in a process forked from it.
static FIRST: OnceLock<u32> = OnceLock::new();

/// Does the work and returns what it gives, or the exception that ended it. `progress` is called with a number when it has changed.
pub fn watched<T: Send + 'static>(
    py: Python<'_>,
    threads: Option<NonZeroUsize>,
    progress: Option<Py<PyAny>>,
    patience: Duration,
    work: impl FnOnce(&Options<'_>, &(dyn Fn(f64) + Sync)) -> T + Send + 'static,
) -> PyResult<T> {
    let interrupt = Arc::new(AtomicBool::new(false));
    let done = Arc::new(AtomicU64::new(0f64.to_bits()));
    let look = |reported: &mut f64| {
        Python::attach(|py| {
            py.check_signals()?;
            let now = f64::from_bits(done.load(Ordering::Relaxed));
            if let Some(progress) = &progress
                && now != *reported
            {
                *reported = now;
                progress.call1(py, (now,))?;
            }
            Ok(())
        })
    };
    let (sender, receiver) = channel();
    let (is_over, share) = (interrupt.clone(), done.clone());
    let worker = move || {
        let tell = |value: f64| share.store(value.to_bits(), Ordering::Relaxed);
        let options = Options {
            threads: threads.map(usize::from),
            interrupt: &is_over,
            progress: &tell,
            controllers: Some(&auxbear_fmu::controller::Units),
            rows: None,
        };
        let found = catch_unwind(AssertUnwindSafe(|| {
            in_living_pool(|| work(&options, &tell))
        }));
        // nobody listens any more after Ctrl-C
        let _ = sender.send(found);
    };
    py.detach(move || {
        thread::Builder::new()
            .spawn(worker)
            .map_err(|error| PyRuntimeError::new_err(format!("no thread: {error}")))?;
        let mut reported = 0.0;
        let mut ended: Option<(PyErr, Instant)> = None;
        loop {
            match receiver.recv_timeout(PAUSE) {
                Ok(Ok(found)) => return ended.map_or(Ok(found), |(error, _)| Err(error)),
                Ok(Err(panic)) => resume_unwind(panic),
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(PyRuntimeError::new_err("the work ended without a result"));
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
            match ended {
                None => {
                    if let Err(error) = look(&mut reported) {
                        interrupt.store(true, Ordering::Relaxed);
                        ended = Some((error, Instant::now()));
                    }
                }
                Some((error, since)) if since.elapsed() > patience => return Err(error),
                Some(_) => {}
            }
        }
    })
}

/// Runs the work where its parts find threads: a forked process has none of the pool of the process that it comes from.
fn in_living_pool<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let first = FIRST.get_or_init(|| {
        auxbear::run::start_pool();
        process::id()
    });
    if *first == process::id() {
        return work();
    }
    let cores = thread::available_parallelism().map_or(1, usize::from);
    match rayon::ThreadPoolBuilder::new().num_threads(cores).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    }
}
