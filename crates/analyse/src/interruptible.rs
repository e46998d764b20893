//! Parts of an analysis, each of which an interrupt ends at once.

use std::sync::atomic::{AtomicBool, Ordering};
#[cfg(feature = "parallel")]
use std::{
    panic::resume_unwind,
    sync::mpsc::{RecvTimeoutError, channel},
    thread::Builder,
    time::Duration,
};

/// Why a part has no numbers where an interrupt came before its end.
pub(crate) const INTERRUPTED: &str = "interrupted";

/// How often the interrupt is looked at.
#[cfg(feature = "parallel")]
const LOOK: Duration = Duration::from_millis(20);
/// Stack of a part, bytes: that of a main thread.
#[cfg(feature = "parallel")]
const STACK: usize = 8 << 20;

/// What a part finds, or that an interrupt came before it.
#[cfg(not(feature = "parallel"))]
pub(crate) fn interruptible<T>(
    interrupt: &AtomicBool,
    part: impl FnOnce() -> Result<T, String>,
) -> Result<T, String> {
    match interrupt.load(Ordering::Relaxed) {
        true => Err(INTERRUPTED.to_string()),
        false => part(),
    }
}

/// What a part finds, computed on a thread of its own, or that it was interrupted.
///
/// Estimators know of no interrupt and may compute for seconds: the thread of one that is not waited for any more runs on
/// until it is done, or the process ends.
#[cfg(feature = "parallel")]
pub(crate) fn interruptible<T: Send + 'static>(
    interrupt: &AtomicBool,
    part: impl FnOnce() -> Result<T, String> + Send + 'static,
) -> Result<T, String> {
    let is_set = || interrupt.load(Ordering::Relaxed);
    if is_set() {
        return Err(INTERRUPTED.to_string());
    }
    let (send, receive) = channel();
    // nobody may wait for the answer any more
    let work = move || drop(send.send(part()));
    let worker = Builder::new()
        .stack_size(STACK)
        .spawn(work)
        .map_err(|error| format!("no thread could be started for it ({error})"))?;
    loop {
        match receive.recv_timeout(LOOK) {
            Ok(found) => return found,
            Err(RecvTimeoutError::Timeout) if is_set() => return Err(INTERRUPTED.to_string()),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => resume_unwind(panic),
                Ok(()) => return Err("it ended without an answer".to_string()),
            },
        }
    }
}

#[cfg(all(test, feature = "parallel"))]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::time::Instant;

    #[test]
    fn a_part_that_computes_on_is_not_waited_for() {
        let interrupt = Arc::new(AtomicBool::new(false));
        assert_eq!(interruptible(&interrupt, || Ok(7)), Ok(7));
        let own = Arc::clone(&interrupt);
        let begin = Instant::now();
        let found: Result<(), String> = interruptible(&interrupt, move || {
            own.store(true, Ordering::Relaxed);
            std::thread::sleep(Duration::from_secs(5));
            Ok(())
        });
        assert_eq!(found, Err(INTERRUPTED.to_string()));
        assert!(begin.elapsed() < Duration::from_secs(1));
        assert_eq!(
            interruptible(&interrupt, || Ok(7)),
            Err(INTERRUPTED.to_string())
        );
    }

    #[test]
    fn a_panic_of_a_part_is_one_of_the_caller() {
        let interrupt = AtomicBool::new(false);
        let caught = std::panic::catch_unwind(|| {
            let _ = interruptible::<()>(&interrupt, || resume_unwind(Box::new("broken")));
        });
        assert_eq!(caught.unwrap_err().downcast_ref(), Some(&"broken"));
    }
}
