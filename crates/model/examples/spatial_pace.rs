//! CPU time of right-hand sides in space beside that of the plane, with the same balls: measured, not judged.
//! `cargo run --release -p auxbear-model --example spatial_pace`

#[path = "../tests/machines/mod.rs"]
#[allow(dead_code)] // shared with the tests
mod machines;
#[path = "../tests/spatial/setup.rs"]
#[allow(dead_code)] // shared with the tests
mod setup;

use model::spatial::{Assembly, AssemblyConstants, CageGuide};
use model::system::machine::{Machines, RotorMachine};
use number::{Level, Real, Task, Vectorized};
use physics::contact_nodes::{ContactNode, legendre, matched, middle};
use setup::{Guide, O, Random, SINGLE, TANH, ball_state, bearing, machine, random_state};
use solve::{Batch, Machine};
use std::time::Instant;

/// Nanoseconds of one call for each machine: the best of many rounds.
fn time(machines: usize, mut call: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..60 {
        let calls = 300;
        let clock = Instant::now();
        (0..calls).for_each(|_| call());
        best = best.min(clock.elapsed().as_nanos() as f64 / f64::from(calls));
    }
    best / machines as f64
}

struct Planar<'a>(&'a RotorMachine, &'a [f64]);
struct Spatial<'a>(&'a AssemblyConstants, &'a [f64]);

struct Rate<'a, R: Real> {
    batch: &'a Machines<R>,
    mode: &'a <Machines<R> as Batch<R>>::Mode,
    state: &'a [R],
    rate: &'a mut [R],
}
impl<R: Real> Vectorized for Rate<'_, R> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        (self.batch).rate(self.mode, R::zero(), self.state, self.rate, &mut []);
    }
}

impl Task for Planar<'_> {
    type Output = f64;
    fn run<R: Real>(self) -> f64 {
        let batch = Machines::<R>::gather(&|_| self.0);
        let mode = Machines::<R>::gather_mode(&|_| self.0.start_mode());
        let state: Vec<R> = self.1.iter().map(|value| R::splat(*value)).collect();
        let mut rate = state.clone();
        time(R::LANES, || {
            R::vectorized(Rate {
                batch: &batch,
                mode: &mode,
                state: &state,
                rate: &mut rate,
            });
            std::hint::black_box(&rate);
        })
    }
}

impl Task for Spatial<'_> {
    type Output = f64;
    fn run<R: Real>(self) -> f64 {
        let assembly = Assembly::<R>::gather(&|_| self.0);
        let state: Vec<R> = self.1.iter().map(|value| R::splat(*value)).collect();
        let mut rate = state.clone();
        time(R::LANES, || {
            assembly.rate(&state, &mut rate);
            std::hint::black_box(&rate);
        })
    }
}

/// A machine with so many balls a row and a state of it in which its pockets are open.
fn spatial(
    signs: &[f64],
    balls: usize,
    nodes: &[ContactNode<f64>],
    guide: Guide,
) -> (AssemblyConstants, Vec<f64>) {
    let mut machine = machine(bearing(signs, TANH, nodes, guide), true);
    for row in &mut machine.rows {
        row.balls = balls;
    }
    let rotor = machine.rotor.as_mut().expect("it has one");
    rotor.levitation = None;
    rotor.landing.faces.truncate(1);
    // as in the plane at the release: rotor and cages are free
    rotor.landing.contact.radial_clearance = 2.5e-4;
    for row in &mut machine.rows {
        if let CageGuide::OuterLand(land) = &mut row.cage.guide {
            land.contact.radial_clearance = 1.5e-4;
        }
    }
    let mut state = random_state(&machine, &mut Random(7), 1.0);
    for (index, row) in machine.rows.iter().enumerate() {
        for ball in 0..row.balls {
            let seat = std::f64::consts::TAU * ball as f64 / row.balls as f64;
            state[ball_state(&machine, index, ball, 2)] = seat;
        }
    }
    // cages upright, the shoulder off its face
    for body in 2..3 + machine.rows.len() {
        let at = machine.body(body) + 6;
        state[at..at + 4].copy_from_slice(&[1.0, 0.0, 0.0, 0.0]);
    }
    state[2] += 1e-3;
    (machine, state)
}

fn main() {
    let mut planar = machines::reference();
    machines::planar(&mut planar).balls = 12;
    let planar = RotorMachine::new(planar);
    let state = planar.start();
    let level = Level::detect();
    let each = |alone: f64, lanes: f64, scalar: f64| [scalar, alone, lanes];
    let base = each(
        level.run_one(Planar(&planar, &state)),
        level.run_many(Planar(&planar, &state)),
        Level::Baseline.run_one(Planar(&planar, &state)),
    );
    println!("ns a call: scalar, balls in lanes, machines in lanes; in brackets over the plane");
    println!(
        "planar, 12 balls: {:.0} {:.0} {:.0}",
        base[0], base[1], base[2]
    );
    for (name, signs, nodes, guide) in [
        ("tied, 1 node", SINGLE, middle(), Guide::Tied),
        ("tied, 3 nodes", SINGLE, matched(8.0), Guide::Tied),
        ("1 node", SINGLE, middle(), Guide::Outer),
        ("3 nodes", SINGLE, matched(8.0), Guide::Outer),
        ("5 nodes", SINGLE, legendre(5), Guide::Outer),
        ("9 nodes", SINGLE, legendre(9), Guide::Outer),
        ("pair, 3 nodes", O, matched(8.0), Guide::Outer),
    ] {
        let (machine, state) = spatial(signs, 12, &nodes, guide);
        let ours = each(
            level.run_one(Spatial(&machine, &state)),
            level.run_many(Spatial(&machine, &state)),
            Level::Baseline.run_one(Spatial(&machine, &state)),
        );
        let [a, b, c] = [0, 1, 2].map(|k| format!("{:.0} ({:.2})", ours[k], ours[k] / base[k]));
        println!("{name}: {a} {b} {c}");
    }
}
