//! Nothing in a drop allocates once it runs.

use crate::machines::counting::ALLOCATIONS;
use crate::machines::{reference, run, settings};
use model::system::machine::RotorMachine;

#[test]
fn a_drop_ten_times_longer_allocates_no_more() {
    let machine = RotorMachine::new(reference());
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
