//! Lanes: a machine in company is the machine alone, bit for bit.

use crate::problems::{VanDerPol, VanDerPols};
use number::{Level, Real, Task};
use solve::{Ending, Flow, Observer, Settings, Step, Stop, watch};
use std::sync::atomic::AtomicBool;

/// Keeps step ends, crossings of x = 0 and their times; stops where asked.
#[derive(Clone, Debug, Default, PartialEq)]
struct Trace {
    steps: Vec<f64>,
    crossings: Vec<f64>,
    halt_after: Option<usize>,
    /// Steps between which the stiffness grows by one.
    renew_every: Option<usize>,
    /// Time and state of every growth.
    renewals: Vec<(f64, Vec<f64>)>,
}

impl Observer<VanDerPol> for Trace {
    fn step(&mut self, step: &mut Step<VanDerPol>) -> Flow {
        self.steps.push(step.end);
        if (step.start_probe(0) > 0.0) != (step.end_probe(0) > 0.0) {
            let theta = watch::crossing(step, 0, 0.0, 1.0);
            self.crossings.push(step.time(theta));
        }
        match self.halt_after {
            Some(count) if self.steps.len() == count => Flow::Halt("seen enough"),
            _ if self
                .renew_every
                .is_some_and(|every| self.steps.len().is_multiple_of(every)) =>
            {
                Flow::Renew
            }
            _ => Flow::Continue,
        }
    }
    fn renewed(&mut self, machine: &VanDerPol, time: f64, state: &[f64]) -> Option<Box<VanDerPol>> {
        self.renewals.push((time, state.to_vec()));
        Some(Box::new(VanDerPol {
            stiffness: machine.stiffness + 1.0,
            ..machine.clone()
        }))
    }
}

/// Runs a list of machines in one batch.
struct Company<'a> {
    machines: &'a [VanDerPol],
    starts: &'a [Vec<f64>],
    traces: &'a mut [Trace],
}

impl Task for Company<'_> {
    type Output = Vec<Ending>;
    fn run<R: Real>(self) -> Vec<Ending> {
        let settings = Settings {
            start: 0.0,
            end: 12.0,
            tolerance: 1e-4,
            first_step: 1e-3,
            largest_step: 0.5,
            step_limit: 1_000_000,
        };
        solve::run::<R, VanDerPols<R>, Trace>(
            &solve::BOGACKI_SHAMPINE,
            &self.machines.iter().collect::<Vec<_>>(),
            self.starts,
            self.traces,
            &settings,
            &AtomicBool::new(false),
        )
    }
}

/// Eight machines of different stiffness, start and landings: some take several times the steps of others.
fn crowd() -> (Vec<VanDerPol>, Vec<Vec<f64>>, Vec<Trace>) {
    let stiffness = [0.1, 30.0, 1.0, 5.0, 0.0, 60.0, 2.0, 0.5];
    let machines = stiffness.map(|stiffness| VanDerPol {
        stiffness,
        landings: vec![0.3 + 0.1 * stiffness, 3.0 + 0.07 * stiffness],
    });
    let starts = (0..8).map(|i| vec![0.5 + 0.2 * f64::from(i), -0.1 * f64::from(i)]);
    let mut traces = vec![Trace::default(); 8];
    traces[2].halt_after = Some(17);
    traces[4].renew_every = Some(40);
    traces[6].renew_every = Some(60);
    (machines.to_vec(), starts.collect(), traces)
}

fn bits(endings: &[Ending]) -> Vec<Vec<u64>> {
    endings
        .iter()
        .map(|ending| ending.state.iter().map(|value| value.to_bits()).collect())
        .collect()
}

/// Every machine by itself, at the narrowest level.
fn each_alone() -> (Vec<Ending>, Vec<Trace>) {
    let (machines, starts, mut traces) = crowd();
    let mut endings = Vec::new();
    for i in 0..machines.len() {
        endings.extend(Level::Baseline.run_one(Company {
            machines: &machines[i..=i],
            starts: &starts[i..=i],
            traces: &mut traces[i..=i],
        }));
    }
    (endings, traces)
}

#[test]
fn every_lane_steps_by_its_own_error_and_gives_the_bits_of_the_run_alone() {
    let (alone, alone_traces) = each_alone();
    assert!(
        alone[1].work.accepted > 2 * alone[0].work.accepted,
        "machines differ"
    );
    assert_eq!(alone[2].stop, Stop::Halted("seen enough"));
    for level in Level::available() {
        let (machines, starts, mut traces) = crowd();
        let mut endings = Vec::new();
        // full batches, and a last one with spare lanes where eight is not a multiple
        for from in (0..8).step_by(level.lanes()) {
            let part = from..(from + level.lanes()).min(8);
            endings.extend(level.run_many(Company {
                machines: &machines[part.clone()],
                starts: &starts[part.clone()],
                traces: &mut traces[part],
            }));
        }
        assert_eq!(bits(&endings), bits(&alone), "{level:?}");
        assert_eq!(endings, alone, "{level:?}");
        assert_eq!(traces, alone_traces, "{level:?}");
    }
}

#[test]
fn a_renewed_machine_goes_on_as_the_other_one_from_there() {
    let settings = |start: f64| Settings {
        start,
        end: 6.0,
        tolerance: 1e-9,
        first_step: 1e-3,
        largest_step: 0.5,
        step_limit: 1_000_000,
    };
    let run = |machine: &VanDerPol, start: &[f64], trace: &mut Trace, from: f64| {
        let mut endings = solve::run::<f64, VanDerPols<f64>, Trace>(
            &solve::BOGACKI_SHAMPINE,
            &[machine],
            &[start.to_vec()],
            std::slice::from_mut(trace),
            &settings(from),
            &AtomicBool::new(false),
        );
        endings.remove(0)
    };
    let machine = VanDerPol {
        stiffness: 0.0,
        landings: Vec::new(),
    };
    let mut trace = Trace {
        renew_every: Some(200),
        ..Trace::default()
    };
    let whole = run(&machine, &[2.0, 0.5], &mut trace, 0.0);
    assert!(trace.renewals.len() >= 2, "{}", trace.steps.len());
    // the last of them again, by itself
    let (time, state) = trace.renewals.last().unwrap().clone();
    let other = VanDerPol {
        stiffness: trace.renewals.len() as f64,
        ..machine
    };
    let rest = run(&other, &state, &mut Trace::default(), time);
    for (a, b) in whole.state.iter().zip(&rest.state) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
}

fn thrice<T: Clone>(list: &[T]) -> Vec<T> {
    let all = [list, list, list];
    all.into_iter().flatten().cloned().collect()
}

#[test]
fn a_lane_that_is_free_takes_the_next_machine_and_the_bits_stay() {
    let (alone, alone_traces) = each_alone();
    // more machines than lanes, in splits that do not fit
    for level in Level::available() {
        for split in [1, 5, 8, 24] {
            let (machines, starts, traces) = crowd();
            let (machines, starts) = (thrice(&machines), thrice(&starts));
            let mut traces = thrice(&traces);
            let mut endings = Vec::new();
            for from in (0..24).step_by(split) {
                let part = from..(from + split).min(24);
                endings.extend(level.run_many(Company {
                    machines: &machines[part.clone()],
                    starts: &starts[part.clone()],
                    traces: &mut traces[part],
                }));
            }
            assert_eq!(endings, thrice(&alone), "{level:?}, {split} at a time");
            assert_eq!(bits(&endings), bits(&thrice(&alone)), "{level:?}");
            assert_eq!(traces, thrice(&alone_traces), "{level:?}");
        }
    }
}

#[test]
fn machines_that_wait_when_somebody_stops_end_where_they_start() {
    let (machines, starts, mut traces) = crowd();
    let settings = Settings {
        start: 0.0,
        end: 12.0,
        tolerance: 1e-4,
        first_step: 1e-3,
        largest_step: 0.5,
        step_limit: 1_000_000,
    };
    let endings = solve::run::<f64, VanDerPols<f64>, Trace>(
        &solve::BOGACKI_SHAMPINE,
        &machines.iter().collect::<Vec<_>>(),
        &starts,
        &mut traces,
        &settings,
        &AtomicBool::new(true),
    );
    for (ending, start) in endings.iter().zip(&starts) {
        assert_eq!((&ending.stop, ending.time), (&Stop::Interrupted, 0.0));
        assert_eq!(&ending.state, start);
    }
}

#[test]
fn spare_lanes_do_not_matter() {
    let (alone, _) = each_alone();
    for level in Level::available() {
        for count in 1..=level.lanes() {
            let (machines, starts, mut traces) = crowd();
            let endings = level.run_many(Company {
                machines: &machines[..count],
                starts: &starts[..count],
                traces: &mut traces[..count],
            });
            assert_eq!(endings, alone[..count], "{level:?}, {count} machines");
        }
    }
}

#[test]
fn a_lane_that_diverges_leaves_its_neighbours_alone() {
    let (alone, _) = each_alone();
    for level in Level::available() {
        let (mut machines, mut starts, mut traces) = crowd();
        let lanes = level.lanes();
        // anti-damped beyond what a number can hold, in the middle of the company
        let sick = lanes / 2;
        machines[sick].stiffness = -1e300;
        traces[sick].halt_after = None;
        starts[sick] = vec![3.0, 1.0];
        let endings = level.run_many(Company {
            machines: &machines[..lanes],
            starts: &starts[..lanes],
            traces: &mut traces[..lanes],
        });
        assert!(
            matches!(endings[sick].stop, Stop::Diverged { .. }),
            "{:?}",
            endings[sick].stop
        );
        assert!(endings[sick].state.iter().all(|value| value.is_finite()));
        for lane in (0..lanes).filter(|lane| *lane != sick) {
            assert_eq!(endings[lane], alone[lane], "{level:?}, lane {lane}");
        }
    }
}
