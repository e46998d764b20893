//! Threads and the clock of the machine, which nothing else that computes asks for. Without the feature `parallel` there are none: one thread
//! does everything, with the same numbers.

/// What work makes of each of a list, by its place and itself; in the order of the list, on the threads of the pool in which this is called.
#[cfg(feature = "parallel")]
pub fn each<'a, T: Sync, R: Send>(
    list: &'a [T],
    work: impl Fn(usize, &'a T) -> R + Sync,
) -> Vec<R> {
    use rayon::prelude::*;
    let list = list.par_iter().enumerate();
    list.map(|(k, item)| work(k, item)).collect()
}

/// What work makes of each of a list, by its place and itself; in the order of the list.
#[cfg(not(feature = "parallel"))]
pub fn each<'a, T: Sync, R: Send>(
    list: &'a [T],
    work: impl Fn(usize, &'a T) -> R + Sync,
) -> Vec<R> {
    let list = list.iter().enumerate();
    list.map(|(k, item)| work(k, item)).collect()
}

/// Drops a list on the threads of the pool in which this is called: what many members hold takes long to give back.
pub fn discard<T: Send>(list: Vec<T>) {
    #[cfg(feature = "parallel")]
    rayon::prelude::ParallelIterator::for_each(
        rayon::prelude::IntoParallelIterator::into_par_iter(list),
        drop,
    );
    #[cfg(not(feature = "parallel"))]
    drop(list);
}

/// Threads that work side by side here.
pub fn threads() -> usize {
    #[cfg(feature = "parallel")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "parallel"))]
    1
}

/// Threads for each core, at most: more only cost time.
#[cfg(feature = "parallel")]
const THREADS_A_CORE: usize = 8;

/// So many threads, or as many as help on this machine.
pub fn bounded(threads: usize) -> usize {
    #[cfg(feature = "parallel")]
    return threads.min(THREADS_A_CORE * cores());
    #[cfg(not(feature = "parallel"))]
    threads.min(1)
}

#[cfg(feature = "parallel")]
fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Starts the shared pool with a thread a core, whatever RAYON_NUM_THREADS says; a pool that is there already stays.
pub fn start_pool() {
    #[cfg(feature = "parallel")]
    let _ = rayon::ThreadPoolBuilder::new()
        .num_threads(cores())
        .build_global();
}

/// Runs something on so many threads, or as many as help on this machine; on the shared pool where none are asked for. Numbers do not
/// depend on it.
#[cfg(feature = "parallel")]
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

/// Runs something on the one thread that there is.
#[cfg(not(feature = "parallel"))]
pub fn in_pool<T: Send>(_threads: Option<usize>, run: impl FnOnce() -> T + Send) -> T {
    run()
}

/// What work makes, and the seconds that it took; 0 where there is no clock.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    #[cfg(feature = "parallel")]
    let clock = std::time::Instant::now();
    let made = work();
    #[cfg(feature = "parallel")]
    return (made, clock.elapsed().as_secs_f64());
    #[cfg(not(feature = "parallel"))]
    (made, 0.0)
}
