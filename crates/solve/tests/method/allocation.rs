//! Nothing in the loop allocates: a run ten times longer makes as many allocations as the short one.

use crate::problems::{Problem, adaptive, run_alone};
use solve::{Flow, Observer, Step, watch};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// The system's allocator, counting the allocations of each thread.
struct Counting;

// SAFETY: every call is handed to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's promises are those of `System`.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Uses all that an observer may use: dense output, probes, crossings, maxima.
#[derive(Default)]
struct Busy {
    steps: u64,
    events: u64,
    sum: f64,
}

impl Observer<Problem> for Busy {
    fn step(&mut self, step: &mut Step<Problem>) -> Flow {
        self.steps += 1;
        self.sum += step.state(0.3)[0] + step.probe(0.7, 1);
        if (step.start_probe(0) > 0.0) != (step.end_probe(0) > 0.0) {
            self.sum += watch::crossing(step, 0, 0.0, 1.0)
                + watch::maximum(step, 0.0, 1.0, |step, theta| step.probe(theta, 1)).1;
            self.events += 1;
        }
        Flow::Continue
    }
}

#[test]
fn a_run_ten_times_longer_allocates_no_more() {
    let problem = Problem {
        landings: vec![0.05, 0.11, 0.17],
        transition: |_, _, state| state[1] += 1e-3,
        ..Problem::bouncing_mass()
    };
    let count = |end: f64| {
        let mut busy = Busy::default();
        let before = ALLOCATIONS.get();
        let ending = run_alone(&problem, &[0.02, 0.0], &mut busy, &adaptive(end, 1e-6));
        let allocations = ALLOCATIONS.get() - before;
        assert_eq!(ending.time, end);
        assert!(busy.sum.is_finite());
        (allocations, busy)
    };
    let (short, few) = count(0.5);
    let (long, many) = count(5.0);
    assert!(few.events > 0 && many.steps > 5 * few.steps && many.events > 5 * few.events);
    assert!(short > 0, "the counter counts");
    assert_eq!(short, long);
}
