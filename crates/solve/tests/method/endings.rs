//! Endings: each keeps the last good state and says why.

use crate::problems::{Blind, Log, Problem, adaptive, run_alone, run_until};
use solve::{Ending, Flow, Observer, Settings, Step, Stop};
use std::sync::atomic::{AtomicBool, Ordering};

fn assert_sane(end: &Ending, log: &Log) {
    assert!(end.state.iter().all(|value| value.is_finite()), "{end:?}");
    let last = log.steps.last().map_or(0.0, |step| step.1);
    assert_eq!(end.time, last, "the time of the last accepted step");
    assert_eq!(end.work.accepted as usize, log.steps.len());
}

/// ẏ0 = 1, and ẏ1 is no number once t > ½.
fn falls_off() -> Problem {
    Problem::new(2, 0, |_, t, _, rate, _| {
        rate[0] = 1.0;
        rate[1] = (0.5 - t).sqrt();
    })
}

#[test]
fn a_rate_that_is_no_number_ends_the_run_before_it() {
    let mut log = Log::default();
    let end = run_alone(&falls_off(), &[0.0, 0.0], &mut log, &adaptive(1.0, 1e-6));
    assert_sane(&end, &log);
    let Stop::Diverged { channel, step } = &end.stop else {
        panic!("{:?}", end.stop)
    };
    assert_eq!(channel, "y1");
    assert!(*step > 0.0 && *step < 1e-10);
    // the run comes as near as the smallest step
    assert!(end.time <= 0.5 && end.time > 0.5 - 1e-9, "{}", end.time);
    // and what it has is right: (2/3)(½)^1.5, less what the square root leaves at its end
    assert!((end.state[1] - 2.0 / 3.0 * 0.5_f64.powf(1.5)).abs() < 1e-5);
}

#[test]
fn a_rate_that_is_no_number_from_the_start_leaves_the_start() {
    let mut log = Log::default();
    let problem = Problem::new(1, 0, |_, _, _, rate, _| rate[0] = f64::NAN);
    let end = run_alone(&problem, &[3.0], &mut log, &adaptive(1.0, 1e-6));
    assert_sane(&end, &log);
    assert!(matches!(end.stop, Stop::Diverged { .. }));
    assert_eq!((end.time, end.state[0]), (0.0, 3.0));
}

#[test]
fn growth_without_bound_ends_at_its_pole() {
    // ẏ = y², y(0) = 1: y = 1/(1 - t)
    let mut log = Log::default();
    let problem = Problem::new(1, 0, |_, _, y, rate, _| rate[0] = y[0] * y[0]);
    let end = run_alone(&problem, &[1.0], &mut log, &adaptive(2.0, 1e-5));
    assert_sane(&end, &log);
    assert!(matches!(end.stop, Stop::Diverged { .. }), "{:?}", end.stop);
    // the pole moves by the errors of the first steps, each a few times the tolerance
    assert!((end.time - 1.0).abs() < 1e-3, "{}", end.time);
    assert!(end.state[0] > 1e6);
}

#[test]
fn the_step_limit_counts_accepted_and_rejected_steps() {
    let mut log = Log::default();
    let settings = Settings {
        first_step: 1.0,
        step_limit: 10,
        ..adaptive(100.0, 1e-6)
    };
    let start = [0.5, 0.0, 0.0, 1.7];
    let end = run_alone(&Problem::kepler(), &start, &mut log, &settings);
    assert_sane(&end, &log);
    assert!(matches!(end.stop, Stop::StepLimit { .. }), "{:?}", end.stop);
    assert_eq!(end.work.accepted + end.work.rejected, 10);
    assert!(end.work.rejected > 0, "the first step was far too long");
    assert_eq!(end.work.rate_calls, 30);
}

#[test]
fn a_pace_that_would_need_the_limit_many_times_is_given_up_early() {
    let mut log = Log::default();
    let settings = Settings {
        first_step: 1e-9,
        largest_step: 1e-9,
        step_limit: 1_000_000,
        ..adaptive(1.0, 1e-6)
    };
    let start = [0.5, 0.0, 0.0, 1.7];
    let end = run_alone(&Problem::kepler(), &start, &mut log, &settings);
    assert_sane(&end, &log);
    assert!(matches!(end.stop, Stop::StepLimit { .. }), "{:?}", end.stop);
    let Stop::StepLimit { share } = end.stop else {
        panic!("{:?}", end.stop);
    };
    assert!((share / 5e-5 - 1.0).abs() < 1e-3, "{share}");
    // a twentieth of the limit: then the end is seen to need a billion steps
    assert_eq!(end.work.accepted, 50_000);
}

/// Halts, or raises a flag, after some steps.
struct After<'a> {
    count: usize,
    flag: Option<&'a AtomicBool>,
    log: Log,
    last_state: f64,
}

impl Observer<Problem> for After<'_> {
    fn step(&mut self, step: &mut Step<Problem>) -> Flow {
        self.log.steps.push((step.start, step.end));
        self.last_state = step.end_state(0);
        if self.log.steps.len() < self.count {
            return Flow::Continue;
        }
        match self.flag {
            None => Flow::Halt("the observer had enough"),
            Some(flag) => {
                flag.store(true, Ordering::Relaxed);
                Flow::Continue
            }
        }
    }
}

#[test]
fn a_halted_run_keeps_the_state_of_the_step_that_halted_it() {
    let mut after = After {
        count: 7,
        flag: None,
        log: Log::default(),
        last_state: 0.0,
    };
    let start = [0.7, 0.0, 0.0, 1.3];
    let end = run_alone(&Problem::kepler(), &start, &mut after, &adaptive(6.0, 1e-6));
    assert_eq!(end.stop, Stop::Halted("the observer had enough"));
    assert_eq!(after.log.steps.len(), 7);
    assert_sane(&end, &after.log);
    assert_eq!(end.state[0], after.last_state);
}

#[test]
fn an_interrupted_run_keeps_what_it_has() {
    let flag = AtomicBool::new(false);
    let mut after = After {
        count: 100,
        flag: Some(&flag),
        log: Log::default(),
        last_state: 0.0,
    };
    let start = [0.7, 0.0, 0.0, 1.3];
    let settings = adaptive(1e4, 1e-9);
    let end = run_until(&Problem::kepler(), &start, &mut after, &settings, &flag);
    assert_eq!(end.stop, Stop::Interrupted);
    assert_sane(&end, &after.log);
    assert_eq!(end.state[0], after.last_state);
    assert!(end.time > 0.0 && end.time < 1e4);
    // looked at every few hundred steps
    assert!(end.work.accepted < 1000);
}

#[test]
fn a_run_interrupted_before_it_begins_is_its_start() {
    let flag = AtomicBool::new(true);
    let start = [0.7, 0.0, 0.0, 1.3];
    let settings = adaptive(10.0, 1e-6);
    let end = run_until(&Problem::kepler(), &start, &mut Blind, &settings, &flag);
    assert_eq!(end.stop, Stop::Interrupted);
    assert_eq!((end.time, end.state), (0.0, start.to_vec()));
}

#[test]
fn a_finished_run_ends_on_its_end_to_the_bit() {
    let finish = 1.0 / 3.0;
    let mut log = Log::default();
    let end = run_alone(&Problem::bell(), &[1.0], &mut log, &adaptive(finish, 1e-6));
    assert_eq!((&end.stop, end.time), (&Stop::Finished, finish));
    assert_sane(&end, &log);
}
