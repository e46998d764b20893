//! Work on a thread of its own, without the lock of the interpreter. The calling thread wakes now and then to look for Ctrl-C and
//! to tell the progress; either may end the work.

use auxbear::run::Options;
use pyo3::prelude::*;
use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// Time between looks: short for who waits for an answer to Ctrl-C, long beside a look.
const PAUSE: Duration = Duration::from_millis(50);

/// Does the work and returns what it gives, or the exception that ended it. `progress` is told a number when it has changed.
pub fn watched<T: Send>(
    py: Python<'_>,
    threads: Option<NonZeroUsize>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&Options<'_>, &(dyn Fn(f64) + Sync)) -> T + Send,
) -> PyResult<T> {
    let interrupt = AtomicBool::new(false);
    let done = AtomicU64::new(0f64.to_bits());
    let tell = |value: f64| done.store(value.to_bits(), Ordering::Relaxed);
    let look = |told: &mut f64| {
        Python::attach(|py| {
            py.check_signals()?;
            let now = f64::from_bits(done.load(Ordering::Relaxed));
            if let Some(progress) = &progress
                && now != *told
            {
                *told = now;
                progress.call1(py, (now,))?;
            }
            Ok(())
        })
    };
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, receiver) = channel::<()>();
            let (interrupt, tell) = (&interrupt, &tell);
            let worker = scope.spawn(move || {
                let options = Options {
                    threads: threads.map(usize::from),
                    interrupt,
                    progress: tell,
                };
                let found = work(&options, tell);
                drop(sender);
                found
            });
            let mut told = 0.0;
            let mut ended: PyResult<()> = Ok(());
            while let Err(RecvTimeoutError::Timeout) = receiver.recv_timeout(PAUSE) {
                if ended.is_ok() {
                    ended = look(&mut told);
                }
                if ended.is_err() {
                    interrupt.store(true, Ordering::Relaxed);
                }
            }
            let found = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
            ended.map(|()| found)
        })
    })
}
