//! Nothing in a drop allocates once it runs.

use crate::machines::{reference, run, settings};
use model::system::drop::DropMachine;
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

#[test]
fn a_drop_ten_times_longer_allocates_no_more() {
    let machine = DropMachine::new(reference());
    let start = machine.start();
    let count = |end: f64| {
        let before = ALLOCATIONS.get();
        run(&machine, &start, &settings(end, 1e-4));
        ALLOCATIONS.get() - before
    };
    // the long run has an impact, the short one none
    let (short, long) = (count(1e-3), count(1e-2));
    assert!(short > 0, "the counter counts");
    assert_eq!(short, long);
}
