//! Driving step by step: stops, inputs, state events, saving and going on.

use crate::problems::Blind;
use number::{Level, Real, Task};
use solve::{
    BOGACKI_SHAMPINE, Batch, Ending, Flow, Held, Machine, Observer, Pause, Settings, Start, Step,
    Stepper, Stop,
};
use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

/// A unit mass on a floor with friction, pulled by a spring whose end moves: it sticks and slips.
///
/// ```text
///   slips   v̇ = k (u t - x) + push - 0.6 μ sign v        until v = 0
///   sticks  v = 0                                         until |k (u t - x) + push| > μ
/// ```
#[derive(Clone)]
struct StickSlip {
    stiffness: f64,
    friction: f64,
    pull: f64,
}

/// Friction of a slip over that at rest.
const SLIPPING: f64 = 0.6;

/// Direction of the slip, 0 where it sticks; and a push on the mass, held between two stops.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Contact<R> {
    direction: R,
    push: R,
}

/// Stick-slip masses side by side.
struct StickSlips<R> {
    stiffness: R,
    friction: R,
    pull: R,
}

impl<R: Real> StickSlips<R> {
    #[inline(always)]
    fn motion(&self, mode: &Contact<R>, time: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        let spring = self.stiffness * (self.pull * time - state[0]) + mode.push;
        let slips = mode.direction.square();
        rate[0] = state[1];
        rate[1] = slips * spring - mode.direction * self.friction * R::splat(SLIPPING);
        if !probe.is_empty() {
            probe[0] = spring;
        }
    }
}

impl StickSlip {
    fn one(&self) -> StickSlips<f64> {
        StickSlips {
            stiffness: self.stiffness,
            friction: self.friction,
            pull: self.pull,
        }
    }
}

impl Machine for StickSlip {
    type Mode = Contact<f64>;
    fn starts_afresh(&self) -> bool {
        true
    }
    fn dimension(&self) -> usize {
        2
    }
    fn probes(&self) -> usize {
        1
    }
    fn watched_channels(&self) -> usize {
        2
    }
    fn error_scale(&self, _channel: usize) -> f64 {
        1.0
    }
    fn channel_name(&self, channel: usize) -> String {
        ["x", "v"][channel].to_string()
    }
    fn start_mode(&self) -> Contact<f64> {
        Contact {
            direction: 0.0,
            push: 0.0,
        }
    }
    fn transition(&self, _landing: usize, _mode: &mut Contact<f64>, _state: &mut [f64]) {}
    fn guard(&self, mode: &Contact<f64>, _time: f64, (state, probe): (&[f64], &[f64])) -> f64 {
        if mode.direction == 0.0 {
            self.friction - probe[0].abs()
        } else {
            mode.direction * state[1]
        }
    }
    fn guard_error(&self, mode: &Contact<f64>) -> f64 {
        if mode.direction == 0.0 {
            f64::INFINITY
        } else {
            1e-14
        }
    }
    fn cross(&self, time: f64, mode: &mut Contact<f64>, state: &mut [f64]) {
        if mode.direction == 0.0 {
            let mut probe = [0.0];
            (self.one()).motion(mode, time, state, &mut [0.0, 0.0], &mut probe);
            mode.direction = probe[0].signum();
        } else {
            assert!(
                state[1].abs() <= 1e-14,
                "it stops by its speed: {}",
                state[1]
            );
            (mode.direction, state[1]) = (0.0, 0.0);
        }
    }
    fn rate(
        &self,
        mode: &Contact<f64>,
        t: f64,
        state: &[f64],
        rate: &mut [f64],
        probe: &mut [f64],
    ) {
        self.one().motion(mode, t, state, rate, probe);
    }
}

impl<R: Real> Batch<R> for StickSlips<R> {
    type Machine = StickSlip;
    type Mode = Contact<R>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a StickSlip) -> Self
    where
        StickSlip: 'a,
    {
        StickSlips {
            stiffness: R::from_lanes(|lane| machine(lane).stiffness),
            friction: R::from_lanes(|lane| machine(lane).friction),
            pull: R::from_lanes(|lane| machine(lane).pull),
        }
    }
    fn gather_mode(modes: &dyn Fn(usize) -> Contact<f64>) -> Contact<R> {
        Contact {
            direction: R::from_lanes(|lane| modes(lane).direction),
            push: R::from_lanes(|lane| modes(lane).push),
        }
    }
    #[inline(always)]
    fn rate(&self, mode: &Contact<R>, time: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        self.motion(mode, time, state, rate, probe);
    }
}

/// Steps and changes of a machine; no step may pass a change.
#[derive(Clone, Debug, Default, PartialEq)]
struct Trace {
    steps: Vec<(f64, f64)>,
    changes: Vec<(f64, f64)>,
}

impl Observer<StickSlip> for Trace {
    fn step(&mut self, step: &mut Step<StickSlip>) -> Flow {
        let direction = step.mode.direction;
        for theta in [0.0, 0.3, 0.6, 0.9] {
            assert!(
                direction * step.state(theta)[1] >= -1e-13,
                "never backwards"
            );
        }
        self.steps.push((step.end, step.end_state(0)));
        Flow::Continue
    }
    fn switched(&mut self, _: &StickSlip, mode: &Contact<f64>, time: f64, _: &[f64]) -> Flow {
        self.changes.push((time, mode.direction));
        Flow::Continue
    }
}

fn settings(end: f64) -> Settings {
    Settings {
        start: 0.0,
        end,
        tolerance: 1e-7,
        first_step: 1e-3,
        largest_step: 0.5,
        step_limit: 1_000_000,
    }
}

fn eight() -> Vec<StickSlip> {
    let of = |k: u32| StickSlip {
        stiffness: 1.0 + 0.5 * f64::from(k),
        friction: 0.4 + 0.1 * f64::from(k % 3),
        pull: 0.2 + 0.05 * f64::from(k),
    };
    (0..8).map(of).collect()
}

struct Company<'a>(&'a [StickSlip], &'a mut [Trace]);

impl Task for Company<'_> {
    type Output = Vec<Ending>;
    fn run<R: Real>(self) -> Vec<Ending> {
        solve::run::<R, StickSlips<R>, Trace>(
            &BOGACKI_SHAMPINE,
            &self.0.iter().collect::<Vec<_>>(),
            &vec![vec![0.0, 0.0]; self.0.len()],
            self.1,
            &settings(20.0),
            &AtomicBool::new(false),
        )
    }
}

#[test]
fn a_mass_slips_and_sticks_at_the_instants_of_the_closed_form() {
    let machine = StickSlip {
        stiffness: 4.0,
        friction: 1.0,
        pull: 0.5,
    };
    let mut traces = [Trace::default()];
    let endings = Level::Baseline.run_one(Company(std::slice::from_ref(&machine), &mut traces));
    assert_eq!(endings[0].stop, Stop::Finished);
    let changes = &traces[0].changes;
    assert!(changes.len() > 6, "{changes:?}");
    // it gives way where k u t = μ; from then on, s later, with Δ what friction loses there,
    // v = u (1 - cos ωs) + Δ/ω sin ωs, which is zero where tan(ωs/2) = -Δ/(u ω)
    let (first, omega, lost) = (0.5, 2.0, 1.0 - SLIPPING);
    let slip = 2.0 * (PI - (lost / (machine.pull * omega)).atan()) / omega;
    assert!((changes[0].0 - first).abs() < 1e-9, "{}", changes[0].0);
    // the tolerance over a turn
    let error = changes[1].0 - (first + slip);
    assert!(error.abs() < 1e-5, "{error}");
    assert_eq!((changes[0].1, changes[1].1), (1.0, 0.0));
}

#[test]
fn eight_machines_whose_events_differ_equal_eight_single_runs() {
    let machines = eight();
    let mut alone_traces = vec![Trace::default(); 8];
    let alone: Vec<Ending> = (0..8)
        .flat_map(|i| {
            let one = i..i + 1;
            let company = Company(&machines[one.clone()], &mut alone_traces[one]);
            Level::Baseline.run_one(company)
        })
        .collect();
    assert!(alone_traces.iter().all(|trace| trace.changes.len() >= 3));
    for level in Level::available() {
        let mut traces = vec![Trace::default(); 8];
        let together = level.run_many(Company(&machines, &mut traces));
        assert_eq!(together, alone, "{level:?}");
        assert_eq!(traces, alone_traces, "{level:?}");
    }
}

/// Drives machines in lanes to stops 0.7 s apart, each with another push; where asked, every stop is saved and the next steps are
/// taken by a new stepper.
struct Stops<'a> {
    machines: &'a [StickSlip],
    traces: &'a mut [Trace],
    moved: bool,
}

impl Task for Stops<'_> {
    type Output = Vec<Ending>;
    fn run<R: Real>(self) -> Vec<Ending> {
        let never = AtomicBool::new(false);
        let count = self.machines.len().min(R::LANES);
        let start = |observer: usize| Start {
            machine: Held::Borrowed(&self.machines[observer]),
            state: &[0.0, 0.0],
            observer,
            settings: settings(10.0),
            pause_at_events: false,
        };
        let starts: Vec<_> = (0..count).map(start).collect();
        let new = || Stepper::<R, StickSlips<R>, _>::explicit(&BOGACKI_SHAMPINE, &starts);
        let mut stepper = new();
        for stop in 1..20 {
            let until = 0.7 * f64::from(stop);
            for lane in 0..count {
                stepper.go_on(lane, until);
                stepper.change(lane, |mode, _| mode.push = 0.05 * f64::from(stop % 4));
            }
            while (0..count).any(|lane| stepper.pause(lane).is_none()) {
                stepper.advance(self.traces, &never);
            }
            for lane in (0..count).filter(|_| until < 10.0) {
                assert_eq!(stepper.pause(lane), Some(&Pause::Until));
                assert_eq!(stepper.time(lane), until, "landed to the bit");
            }
            if self.moved {
                // inputs that change just before are part of it
                for lane in 0..count {
                    stepper.change(lane, |mode, _| mode.push = 0.05 * f64::from((stop + 1) % 4));
                }
                let saved: Vec<_> = (0..count).map(|lane| stepper.save(lane)).collect();
                stepper = new();
                for (lane, saved) in saved.iter().enumerate() {
                    stepper.restore(lane, saved);
                }
            }
        }
        (0..count).filter_map(|lane| stepper.ending(lane)).collect()
    }
}

#[test]
fn a_run_that_is_saved_at_each_stop_has_the_bits_of_one_that_is_not() {
    let machines = eight();
    for level in Level::available() {
        let [still, moved] = [false, true].map(|moved| {
            let mut traces = vec![Trace::default(); 8];
            let endings = level.run_many(Stops {
                machines: &machines,
                traces: &mut traces,
                moved,
            });
            (endings, traces)
        });
        assert_eq!(still.0.len(), level.lanes().min(8));
        assert!(still.0.iter().all(|ending| ending.stop == Stop::Finished));
        assert!(still == moved, "{level:?}");
    }
}

#[test]
fn a_lane_pauses_at_its_events_where_asked_and_its_neighbour_goes_on() {
    let machine = StickSlip {
        stiffness: 4.0,
        friction: 1.0,
        pull: 0.5,
    };
    let start = Start {
        machine: Held::Borrowed(&machine),
        state: &[0.0, 0.0],
        observer: 0,
        settings: settings(10.0),
        pause_at_events: true,
    };
    let never = AtomicBool::new(false);
    let mut stepper = Stepper::<f64, StickSlips<f64>, _>::explicit(&BOGACKI_SHAMPINE, &[start]);
    let mut trace = [Trace::default()];
    let mut events = Vec::new();
    loop {
        stepper.advance(&mut trace, &never);
        match stepper.pause(0) {
            Some(Pause::Event) => events.push((stepper.time(0), stepper.mode(0).direction)),
            Some(Pause::Ended(stop)) => break assert_eq!(*stop, Stop::Finished),
            other => panic!("{other:?}"),
        }
        stepper.go_on(0, f64::INFINITY);
    }
    assert_eq!(events, trace[0].changes);
    assert_eq!(stepper.ending(0).map(|ending| ending.time), Some(10.0));
    // a run that is over stays so
    stepper.go_on(0, 20.0);
    stepper.advance(&mut [Blind], &never);
    assert_eq!(stepper.time(0), 10.0);
}
