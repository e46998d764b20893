//! The linearly implicit steps beside a general implicit solver of a library, on the same right-hand side.
//!
//! The first impact of the reference drop with stiff friction, from shortly before contact: Radau IIA of order five
//! (`differential-equations`), its Jacobian by differences, dense linear algebra. Nothing but [`Machine::rate`] is shared.

use crate::machines::{Blind, INNER, by, heat_of, planar, reference, settings};
use differential_equations::prelude::{IVP, ImplicitRungeKutta, Matrix, ODE};
use model::system::machine::RotorMachine;
use model::system::machine::simulate::Steps;
use physics::traction::{TanhTraction, Traction};
use solve::{Machine, Settings, Stop};

/// Channels of the reference drop: the library's method wants their number when it is compiled.
const CHANNELS: usize = 89;

/// Its states as the library holds them.
type Channels = [f64; CHANNELS];

/// A machine as the library sees it: each state by its distance from the start over the magnitude that matters in it.
struct Scaled<'a> {
    machine: &'a RotorMachine,
    start: &'a [f64],
    scale: Vec<f64>,
}

impl Scaled<'_> {
    fn state(&self, x: &[f64]) -> Vec<f64> {
        let parts = x.iter().zip(&self.scale).zip(self.start);
        parts.map(|((x, scale), start)| start + x * scale).collect()
    }
}

impl ODE<f64, Channels> for Scaled<'_> {
    fn diff(&self, time: f64, x: &Channels, rate: &mut Channels) {
        let mode = self.machine.start_mode();
        (self.machine).rate(&mode, time, &self.state(x), rate, &mut []);
        for (value, scale) in rate.iter_mut().zip(&self.scale) {
            *value /= scale;
        }
    }

    fn jacobian(&self, time: f64, x: &Channels, into: &mut Matrix<f64>) {
        // small against the reference speed of friction, large against rounding of positions
        const STEP: f64 = 1e-6;
        let (mut here, mut there) = ([0.0; CHANNELS], [0.0; CHANNELS]);
        self.diff(time, x, &mut here);
        let mut moved = *x;
        for column in 0..x.len() {
            moved[column] += STEP;
            self.diff(time, &moved, &mut there);
            moved[column] = x[column];
            for (row, (there, here)) in there.iter().zip(&here).enumerate() {
                into[(row, column)] = (there - here) / STEP;
            }
        }
    }
}

/// The end of a run by linearly implicit steps.
fn by_our_steps(machine: &RotorMachine, start: &[f64], settings: &Settings) -> Vec<f64> {
    let ending = by(Steps::Implicit, machine, start, settings, &mut Blind);
    assert_eq!(ending.stop, Stop::Finished);
    println!("ours: {:?}", ending.work);
    ending.state
}

/// The end of the same run by the library, with the steps it took.
fn by_the_library(machine: &RotorMachine, start: &[f64], end: f64, tolerance: f64) -> Vec<f64> {
    let scale = (0..machine.dimension())
        .map(|i| machine.error_scale(i))
        .collect();
    let scaled = Scaled {
        machine,
        start,
        scale,
    };
    // the solver raises a tolerance to two thirds and takes a tenth; it asks for one a channel
    let each = vec![tolerance; start.len()];
    let solution = IVP::ode(&scaled, 0.0, end, [0.0; CHANNELS])
        .method(
            ImplicitRungeKutta::radau5()
                .rtol(each.clone())
                .atol(each)
                .max_steps(1_000_000)
                .h0(1e-8),
        )
        .solve();
    let Ok(solution) = solution else {
        panic!("the library did not reach the end");
    };
    println!(
        "library: {} steps, {} Jacobians",
        solution.steps.total(),
        solution.evals.jacobian
    );
    scaled.state(solution.y.last().expect("a last state"))
}

#[test]
fn a_library_meets_the_same_end_of_the_first_impact() {
    let mut constants = reference();
    planar(&mut constants).traction = Traction::Tanh(TanhTraction {
        maximum: 0.08,
        inverse_reference_speed: 1.0 / 0.001,
    });
    let machine = RotorMachine::new(constants);
    let before = by_our_steps(&machine, &machine.start(), &settings(7.0e-3, 1e-5));
    const END: f64 = 0.9e-3;
    let library = by_the_library(&machine, &before, END, 1e-9);
    // contact begins in between, and spins balls up from rest
    let friction = |state: &[f64]| heat_of(&machine, state, "rotor_race_friction");
    assert_eq!(friction(&before), 0.0);
    assert!(friction(&library) > 0.5 && library[INNER + 5] > 100.0);
    // all channels in units of the error scale, ball radii by 0.3 nm of a thousandth: measured 0.031, 0.0047 and 0.001
    let mut last = f64::INFINITY;
    for (tolerance, most) in [(1e-4, 0.1), (1e-5, 0.02), (1e-6, 0.004)] {
        let ours = by_our_steps(&machine, &before, &settings(END, tolerance));
        let apart = (0..CHANNELS)
            .map(|i| (ours[i] - library[i]).abs() / machine.error_scale(i))
            .fold(0.0, f64::max);
        println!("tolerance {tolerance}: {apart} apart");
        assert!(apart < most && apart < last, "{tolerance}: {apart}");
        last = apart;
    }
}
