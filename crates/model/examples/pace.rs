//! CPU time of drops: measured, not judged. `cargo run --release -p auxbear-model --example pace`

#[path = "../tests/machines/mod.rs"]
#[allow(dead_code)] // shared with the other tests
mod machines;

use machines::{Blind, planar, reference, settings};
use model::bearing::{SharedMoment, SteadyMoment};
use model::system::machine::simulate::{Runs, Shape, Steps, simulate_on};
use model::system::machine::{MachineConstants, RotorMachine};
use number::Level;
use physics::palmgren::Palmgren;
use solve::{Observer, Stop};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// CPU seconds for each simulated second of each of so many equal machines, and steps of one.
fn pace(
    machine: &RotorMachine,
    start: &[f64],
    count: usize,
    (steps, tolerance): (Steps, f64),
    end: f64,
) -> (f64, u64) {
    let machines = vec![machine; count];
    let starts = vec![start.to_vec(); count];
    let mut watching: Vec<_> = (0..count).map(|_| Blind).collect();
    let mut observers: Vec<&mut dyn Observer<RotorMachine>> = Vec::new();
    for blind in &mut watching {
        observers.push(blind);
    }
    let runs = Runs {
        machines: &machines,
        starts: &starts,
        settings: settings(end, tolerance),
        steps,
        interrupt: &AtomicBool::new(false),
    };
    let shape = match count {
        1 => Shape::Balls,
        _ => Shape::Machines,
    };
    let clock = Instant::now();
    let endings = simulate_on(Level::detect(), shape, runs, &mut observers);
    let spent = clock.elapsed().as_secs_f64();
    assert!(endings.iter().all(|ending| ending.stop == Stop::Finished));
    (spent / (end * count as f64), endings[0].work.accepted)
}

/// Prints the best of several measurements.
fn measure(name: &str, machine: &RotorMachine, start: &[f64], end: f64) {
    for (method, way) in [
        ("explicit 1e-4", (Steps::Explicit, 1e-4)),
        ("implicit 3e-2", (Steps::Implicit, 3e-2)),
    ] {
        for count in [1, Level::detect().lanes()] {
            let runs = (0..5).map(|_| pace(machine, start, count, way, end));
            let best = runs.reduce(|a, b| if b.0 < a.0 { b } else { a });
            let (cost, steps) = best.expect("five runs");
            println!("{name}, {method}, {count} side by side: {cost:.3} s/s, {steps} steps");
        }
    }
}

/// The reference machine with Palmgren's moment instead of its drag to the ground.
fn greased() -> MachineConstants {
    let mut constants = reference();
    let bearing = planar(&mut constants);
    (bearing.ball.orbit_drag, bearing.ball.spin_drag) = (0.0, 0.0);
    bearing.moment = Some(SharedMoment {
        law: SteadyMoment::Palmgren(Palmgren {
            viscous_factor: 1.7,
            viscosity: 100e-6,
            pitch_diameter: 36e-3,
            load_factor: 0.0007,
            load_exponent: 0.5,
            static_load_rating: 6550.0,
            preload: 0.0,
        }),
        axial_load: 0.0,
        orbit_share: 0.5,
        reference_spin: 1.0,
    });
    constants
}

fn main() {
    let machine = RotorMachine::new(reference());
    measure("point", &machine, &machine.start(), 0.05);
    let machine = RotorMachine::new(greased());
    measure("point, Palmgren", &machine, &machine.start(), 0.05);
    let (constants, start) = machines::bent::bent(6e4);
    let machine = RotorMachine::new(constants);
    let name = format!("{} coordinates", machine.layout().rotor.coordinates);
    measure(&name, &machine, &start, 0.05);
}
