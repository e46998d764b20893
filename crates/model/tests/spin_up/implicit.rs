//! Linearly implicit steps of a spin-up: no part's stiffness is missing from their tangents, and it is the same spin-up.

use super::rig::{BEARING, Run, greased_bearing, machine, observe_by, run_by};
use crate::machines::missing::{Looked, missing};
use crate::machines::settings;
use model::bearing::BearingConstants;
use model::bearing::tangents::Known;
use model::system::machine::{Machines, RotorMachine};
use model::system::rig::{Drive, RigConstants, SlidingRotor};
use model::table::Table;
use solve::{Flow, Machine, Observer, Step, Steps};

/// Tolerance of screening accuracy.
const SCREENING: f64 = 2e-3;

/// A race that moves under a load, its balls with an oversize against their gap.
fn loaded(drive: Drive, oversize: f64) -> RigConstants {
    let mut bearing = greased_bearing();
    bearing.ball.outer_track -= oversize;
    let mut constants = machine(BearingConstants::Planar(bearing), drive, 1000.0);
    constants.race.centre_held = false;
    constants.load = Table::constant(100.0);
    constants
}

/// A rotor that slides in the bore.
fn sliding() -> Drive {
    Drive::SlidingRotor(SlidingRotor {
        bore_radius: 12.5e-3,
        friction: 0.3,
        inverse_reference_speed: 10.0,
        speed: 1000.0,
        polar_inertia: 1e-3,
        spin_held: false,
    })
}

/// Keeps the state at every twentieth accepted step, with the length of the step.
#[derive(Default)]
struct States {
    seen: usize,
    kept: Vec<(f64, Vec<f64>)>,
}

impl Observer<RotorMachine> for States {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        self.seen += 1;
        if self.seen.is_multiple_of(20) {
            self.kept
                .push((step.end - step.start, step.state(1.0).to_vec()));
        }
        Flow::Continue
    }
}

/// 0.1 m/s of a centre or of a surface; positions by what that makes of them in a step.
fn unit(machine: &RotorMachine, channel: usize, g: f64) -> f64 {
    let name = machine.channel_name(channel);
    let BearingConstants::Planar(bearing) = &machine.constants.bearings[0].bearing else {
        panic!("it has balls");
    };
    let ball = &bearing.ball;
    let radius = match name.rsplit('.').next().expect("a name") {
        "spin" => ball.radius,
        "azimuth" | "orbit_speed" => ball.pocket_radius,
        "angle" | "speed" if name.contains("cage") => ball.pocket_radius,
        "angle" | "speed" => ball.inner_track,
        _ => 1.0,
    };
    let is_rate = name.ends_with("speed") || name.ends_with("spin");
    0.1 / radius / if is_rate { 1.0 } else { g }
}

#[test]
fn tangents_of_a_spin_up_miss_no_stiffness() {
    let torque = || Drive::Torque(Table::constant(0.08));
    let cases = [
        ("sliding rotor", sliding(), 2e-6),
        ("torque", torque(), 2e-6),
        ("torque with clearance", torque(), -10e-6),
        ("speed", Drive::ramp(2e4, 1000.0), 2e-6),
    ];
    for (name, drive, oversize) in cases {
        let given = matches!(drive, Drive::Speed(_));
        let machine = RotorMachine::on_rig(loaded(drive, oversize)).expect("it can be built");
        assert_eq!(machine.tangents(), Known::All);
        let mut states = States::default();
        let (start, settings) = (machine.start(), settings(0.08, SCREENING));
        observe_by(Steps::Implicit, &machine, &start, &settings, &mut states);
        assert!(states.kept.len() > 10, "{name}: {}", states.kept.len());
        let looked = |(length, state): &(f64, Vec<f64>)| {
            missing::<Machines<f64>>(&Looked {
                machine: &machine,
                active: machine.layout().ledger(),
                length: *length,
                state,
                unit: &|channel, g| unit(&machine, channel, g),
                // a speed that is given, a rotor that is not there
                skipped: &|channel| given && (4..BEARING).contains(&channel),
            })
        };
        let mut all: Vec<_> = states.kept.iter().map(looked).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (median, worst) = (&all[all.len() / 2], &all[all.len() - 1]);
        println!(
            "{name}: median {:.3}, worst {:.3} ({}), {} steps",
            median.0, worst.0, worst.1, states.seen
        );
        assert!(median.0 < USUALLY && worst.0 < MOST, "{name}: {all:?}");
    }
}

/// What tangents may miss in half of the states; the push of the sliding rotor on the race is the most.
const USUALLY: f64 = 0.25;
/// And in the worst of them, at the longest steps, in which a ball goes through the loaded arc: how its share of the friction moment
/// follows its place. Up to 4.9.
const MOST: f64 = 6.0;

/// What a spin-up is judged by: time to 95 % of rolling of the cage, cage speed at the end, heat of the bearing.
fn judged(run: &Run) -> [f64; 3] {
    let heat = run.machine.flows(&run.end).heat;
    let half = run.record.bearings[0]
        .cage_time_to_95_percent()
        .expect("it is fast");
    [half, run.end[BEARING + 1], heat]
}

#[test]
fn an_implicit_spin_up_is_the_explicit_one() {
    for drive in [sliding(), Drive::ramp(2e4, 1000.0)] {
        let constants = loaded(drive, 2e-6);
        let exact = judged(&run_by(Steps::Explicit, constants.clone(), 0.1, 1e-6));
        for (tolerance, allowed) in [(1e-4, 2e-5), (SCREENING, 3e-4)] {
            let implicit = run_by(Steps::Implicit, constants.clone(), 0.1, tolerance);
            for (ours, exact) in judged(&implicit).into_iter().zip(exact) {
                let missed = ours / exact - 1.0;
                println!("{tolerance:e}: {ours} {missed:.1e}");
                assert!(missed.abs() < allowed, "{tolerance}: {ours} {exact}");
            }
        }
    }
}

#[test]
fn rolling_under_preload_costs_what_its_loads_ask_for() {
    let rolling = |steps, tolerance| {
        let constants = loaded(Drive::ramp(2e4, 1000.0), 2e-6);
        run_by(steps, constants, 0.5, tolerance).steps
    };
    let explicit = rolling(Steps::Explicit, 5e-5);
    let implicit = rolling(Steps::Implicit, SCREENING);
    // measured 22
    assert!(explicit > 12 * implicit, "{explicit} {implicit}");
}
