//! Landings: steps end on them to the bit, and only there the mode changes.

use crate::problems::{Blind, Log, Problem, adaptive, run_alone};
use solve::{Flow, Observer, Step, Stop};

/// ẏ0 = mode, ẏ1 = cos t: the mode grows by one at every landing, y1 jumps by a thousandth.
fn staircase(landings: &[f64]) -> Problem {
    Problem {
        landings: landings.to_vec(),
        transition: |landing, mode, state| {
            *mode = (landing + 2) as f64;
            state[1] += 1e-3;
        },
        ..Problem::new(2, 0, |mode, t, _, rate, _| {
            rate[0] = *mode;
            rate[1] = t.cos();
        })
    }
}

/// Keeps the mode and the end of every step.
#[derive(Default)]
struct Modes(Vec<(f64, f64)>);

impl Observer<Problem> for Modes {
    fn step(&mut self, step: &mut Step<Problem>) -> Flow {
        self.0.push((*step.mode, step.end));
        Flow::Continue
    }
}

#[test]
fn steps_end_on_landings_to_the_bit() {
    // instants that no sum of equal steps meets by chance
    let landings = [1.0 / 3.0, 0.5_f64.sqrt(), 1.0 + 1e-9, 1.9];
    let mut log = Log::default();
    let end = run_alone(
        &staircase(&landings),
        &[0.0, 0.0],
        &mut log,
        &adaptive(2.0, 1e-6),
    );
    assert_eq!(end.stop, Stop::Finished);
    assert_eq!(end.time, 2.0);
    for landing in landings {
        assert!(log.steps.iter().any(|step| step.1 == landing), "{landing}");
        let over = log.steps.iter().any(|s| s.0 < landing && landing < s.1);
        assert!(!over, "no step passes over {landing}");
    }
    for pair in log.steps.windows(2) {
        assert_eq!(pair[0].1, pair[1].0, "steps join without a gap");
    }
}

#[test]
fn the_mode_changes_at_the_landing_and_the_state_jumps_there() {
    let landings = [0.25, 0.7];
    let mut modes = Modes::default();
    let problem = staircase(&landings);
    let end = run_alone(&problem, &[0.0, 0.0], &mut modes, &adaptive(1.0, 1e-9));
    for (mode, step_end) in &modes.0 {
        let expected = 1.0 + landings.iter().filter(|l| *l < step_end).count() as f64;
        assert_eq!(*mode, expected, "step that ends at {step_end}");
    }
    // piecewise constant rates are integrated exactly, up to rounding
    assert!((end.state[0] - (0.25 + 2.0 * 0.45 + 3.0 * 0.3)).abs() < 1e-14);
    // the tolerance, a few steps
    assert!((end.state[1] - (1.0_f64.sin() + 2e-3)).abs() < 1e-8);
}

#[test]
fn two_landings_close_together_are_both_taken() {
    let first = 0.5_f64;
    for second in [first, first.next_up(), first + 1e-12, first + 1e-7] {
        let mut log = Log::default();
        let problem = staircase(&[first, second]);
        let end = run_alone(&problem, &[0.0, 0.0], &mut log, &adaptive(1.0, 1e-6));
        assert_eq!(end.stop, Stop::Finished, "second at {second}");
        assert!(log.steps.iter().any(|step| step.1 == first));
        assert!(log.steps.iter().any(|step| step.1 == second));
        // 1 until the first, 2 between, 3 after: the rounding of a few steps
        let expected = first + 2.0 * (second - first) + 3.0 * (1.0 - second);
        assert!((end.state[0] - expected).abs() < 1e-14, "second {second}");
        // a tiny step between the two does not leave tiny steps behind it
        let mut calm = Log::default();
        let plain = run_alone(
            &staircase(&[]),
            &[0.0, 0.0],
            &mut calm,
            &adaptive(1.0, 1e-6),
        );
        assert!(end.work.accepted <= plain.work.accepted + 6);
    }
}

#[test]
fn a_landing_at_the_end_is_taken() {
    let end = run_alone(
        &staircase(&[1.0]),
        &[0.0, 0.0],
        &mut Blind,
        &adaptive(1.0, 1e-9),
    );
    assert!((end.state[1] - (1.0_f64.sin() + 1e-3)).abs() < 1e-8);
}

#[test]
fn a_landing_beyond_the_end_is_not_taken() {
    let end = run_alone(
        &staircase(&[1.5]),
        &[0.0, 0.0],
        &mut Blind,
        &adaptive(1.0, 1e-9),
    );
    assert_eq!((end.stop, end.time), (Stop::Finished, 1.0));
    assert!((end.state[1] - 1.0_f64.sin()).abs() < 1e-8);
}

#[test]
fn a_landing_before_the_start_is_past() {
    let problem = staircase(&[-1.0, 0.5]);
    let end = run_alone(&problem, &[0.0, 0.0], &mut Blind, &adaptive(1.0, 1e-9));
    assert_eq!((&end.stop, end.time), (&Stop::Finished, 1.0));
    // the landing at 0.5 is still the second: it sets the mode to 3
    assert!((end.state[0] - (0.5 + 3.0 * 0.5)).abs() < 1e-14);
}
