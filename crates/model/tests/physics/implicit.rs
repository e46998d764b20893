//! Linearly implicit steps: no part's stiffness is missing from their tangents, and a drop is the same drop.

use super::relatives::grease;
use super::several::twins;
use crate::machines::bent::bent;
use crate::machines::missing::{Looked, missing as missing_of};
use crate::machines::{by, inlets, oil, planar, reference, settings, tilt_contacts};
use crate::physics::planes::{bent_rows, rows};
use model::bearing::tangents::Known;
use model::bearing::{BearingConstants, SharedMoment, SteadyMoment};
use model::system::machine::record::Record;
use model::system::machine::simulate::Steps;
use model::system::machine::{MachineConstants, Machines, RotorMachine};
use physics::traction::{DryTraction, TanhTraction, Traction};
use solve::{Ending, Flow, Machine, Observer, Step, Stop};

/// The reference machine with another reference speed of traction, m/s.
fn with_reference_speed(reference_speed: f64) -> MachineConstants {
    let mut constants = reference();
    planar(&mut constants).traction = Traction::Tanh(TanhTraction {
        maximum: 0.08,
        inverse_reference_speed: 1.0 / reference_speed,
    });
    constants
}

/// Keeps the state at the end of every so many accepted steps, with the length of the step.
struct States {
    every: usize,
    seen: usize,
    kept: Vec<(f64, Vec<f64>)>,
}

impl Observer<RotorMachine> for States {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        self.seen += 1;
        if self.seen.is_multiple_of(self.every) {
            let length = step.end - step.start;
            self.kept.push((length, step.state(1.0).to_vec()));
        }
        Flow::Continue
    }
}

/// Tolerance of screening accuracy.
const SCREENING: f64 = 3e-2;
/// Unit of a channel: 0.1 m/s of a centre or of a surface, spins by their radii, modes by what they move the rotor by in a bearing;
/// positions by what that makes of them in a step.
fn unit(machine: &RotorMachine, channel: usize, g: f64) -> f64 {
    let name = machine.channel_name(channel);
    let rotor = machine.layout().rotor;
    if channel < rotor.angle() {
        let mode = channel % rotor.coordinates;
        let shapes = (machine.constants.bearings.iter()).map(|part| part.node[mode].abs());
        let is_rate = channel >= rotor.block(2).start;
        let reach = shapes.fold(LEAST_SHAPE, f64::max);
        return 0.1 / reach / if is_rate { 1.0 } else { g };
    }
    let planar = machine
        .constants
        .bearings
        .iter()
        .find_map(|part| match &part.bearing {
            BearingConstants::Spatial(_) => panic!("the bearing lies in the plane"),
            BearingConstants::Planar(bearing) => Some(bearing),
            BearingConstants::Rolling(_) => None,
        });
    let ball = &planar.expect("it has balls").ball;
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

/// Modes that move the bearings by less count as if they moved them so much, of coordinates made orthonormal.
const LEAST_SHAPE: f64 = 0.1;

/// What the tangents miss at a state in a step of that length: see [`missing`](crate::machines::missing).
fn missing(machine: &RotorMachine, length: f64, state: &[f64]) -> (f64, String) {
    let at = &machine.layout().bearings[0];
    let held = machine.constants.bearings[0].inner_race.centre_held;
    missing_of::<Machines<f64>>(&Looked {
        machine,
        active: machine.layout().ledger(),
        length,
        state,
        unit: &|channel, g| unit(machine, channel, g),
        // a race that is held has no speed to be given
        skipped: &|channel| held && at.inner.without_turn().channels().contains(&channel),
    })
}

/// The machines that are offered linearly implicit steps at screening accuracy: everything that presses or rubs in them, and
/// what is left out of the tangents; each with its start.
fn variants() -> Vec<(&'static str, MachineConstants, Vec<f64>)> {
    let mut hard = reference();
    hard.bearings[0].mount.stiffness *= 10.0;
    let mut held = reference();
    held.bearings[0].inner_race.centre_held = true;
    let mut tilted = reference();
    tilt_contacts(planar(&mut tilted), 0.4);
    planar(&mut tilted).ball.inner_track_growth = 5e-12;
    let mut loose = reference();
    planar(&mut loose).ball.outer_track += 10e-6;
    let mut dry = reference();
    planar(&mut dry).traction = Traction::Dry(DryTraction {
        kinetic: 0.1,
        static_excess: 0.1,
        inverse_decay_speed: 2.0,
        inverse_reference_speed: 100.0,
    });
    let mut greased = reference();
    let bearing = planar(&mut greased);
    (bearing.ball.orbit_drag, bearing.ball.spin_drag) = (0.0, 0.0);
    bearing.moment = Some(SharedMoment {
        law: SteadyMoment::Palmgren(grease()),
        axial_load: 0.0,
        orbit_share: 0.5,
        reference_spin: 1.0,
    });
    let mut oiled = reference();
    planar(&mut oiled).traction = oil();
    planar(&mut oiled).inlet_rolling = Some(inlets());
    let several = twins(&RotorMachine::new(reference())).constants;
    let points = vec![
        ("reference", reference()),
        ("hard mount", hard),
        ("held race", held),
        ("contacts at an angle", tilted),
        ("clearance", loose),
        ("stiff friction", with_reference_speed(0.001)),
        ("dry friction", dry),
        ("grease with its moment", greased),
        ("oil", oiled),
        ("several bearings", several),
    ];
    let started = points.into_iter().map(|(name, constants)| {
        let start = RotorMachine::new(constants.clone()).start();
        (name, constants, start)
    });
    let mut all: Vec<_> = started.collect();
    // rows of the border by nodes; and by coordinates: rigid translation and tilt in as many bearings
    let (constants, start) = bent(6e4);
    all.push(("a rotor that bends", constants, start));
    let (constants, start) = bent(1.0);
    all.push(("a rotor that tilts", constants, start));
    let [(constants, start), _] = bent_rows();
    all.push(("two rows at a node of a rotor that bends", constants, start));
    let constants = rows(2.0);
    let start = RotorMachine::new(constants.clone()).start();
    all.push(("two rows", constants, start));
    all
}

#[test]
fn tangents_miss_no_stiffness_where_screening_takes_its_steps() {
    for (name, constants, start) in variants() {
        let machine = RotorMachine::new(constants);
        assert_eq!(machine.tangents(), Known::All);
        let mut states = States {
            every: 40,
            seen: 0,
            kept: Vec::new(),
        };
        // free fall, the first contact, spin-up
        let settings = settings(0.03, SCREENING);
        let ending = by(Steps::Implicit, &machine, &start, &settings, &mut states);
        assert_eq!(ending.stop, Stop::Finished, "{name}");
        let kept = &states.kept;
        assert!(kept.len() > 10, "{name}: {}", kept.len());
        let mut all: Vec<_> = (kept.iter())
            .map(|(length, state)| missing(&machine, *length, state))
            .collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (median, worst) = (&all[all.len() / 2], &all[all.len() - 1]);
        println!(
            "{name}: median {:.3}, worst {:.3} ({}), {} steps",
            median.0, worst.0, worst.1, ending.work.accepted
        );
        assert!(median.0 < USUALLY && worst.0 < MOST, "{name}: {all:?}");
    }
}

/// What tangents may miss in half of the states: 0.04 to 0.13, of which friction that follows the load is the most. Without those of
/// any single part it is 1 and more.
const USUALLY: f64 = 0.25;
/// And in the worst of them, at the longest steps: up to 1.9 with dry friction.
const MOST: f64 = 2.5;

/// A drop by explicit or by linearly implicit steps.
fn drop(
    constants: MachineConstants,
    end: f64,
    tolerance: f64,
    steps: Steps,
) -> (Record, Ending, f64) {
    let machine = RotorMachine::new(constants);
    let start = machine.start();
    let mut record = Record::new(&machine, end, end / 10.0, false);
    let settings = settings(end, tolerance);
    let ending = by(steps, &machine, &start, &settings, &mut record);
    assert_eq!(ending.stop, Stop::Finished);
    let balance = machine.balance(&start, &ending.state);
    let residual = balance.energy_residual() / balance.heat();
    (record, ending, residual)
}

#[test]
fn an_implicit_drop_is_the_explicit_one() {
    // both converge to the same first impact, start of the second contact and spin-up time; late contacts are chaotic
    let (explicit, _, _) = drop(with_reference_speed(0.1), 0.03, 1e-6, Steps::Explicit);
    let (implicit, ending, residual) = drop(with_reference_speed(0.1), 0.03, 1e-4, Steps::Implicit);
    let peak = |record: &Record| record.bearings[0].contacts[0].peak_force;
    let second = |record: &Record| record.bearings[0].contacts[1].start;
    let half = |record: &Record| {
        record.bearings[0]
            .inner_race_time_to_50_percent()
            .expect("it is fast")
    };
    // measured 0.01 N, 0.1 µs and 2 µs; the time to half speed of perturbed starts spreads by 3 µs
    assert!((peak(&explicit) - peak(&implicit)).abs() < 0.1);
    assert!((second(&explicit) - second(&implicit)).abs() < 1e-6);
    assert!((half(&explicit) - half(&implicit)).abs() < 2e-5);
    assert!(residual.abs() < 1e-6, "{residual}");
    // the explicit method needs more at the same tolerance
    assert!(ending.work.accepted < 6500, "{:?}", ending.work);
}

#[test]
fn stiff_friction_costs_an_implicit_drop_little_more() {
    let (_, plain, _) = drop(with_reference_speed(0.1), 0.018, 1e-4, Steps::Implicit);
    let (record, stiff, residual) = drop(with_reference_speed(0.001), 0.018, 1e-4, Steps::Implicit);
    assert!(
        stiff.work.accepted < 2 * plain.work.accepted,
        "{:?} {:?}",
        plain.work,
        stiff.work
    );
    assert!(residual.abs() < 1e-6, "{residual}");
    // converged: 672.857 N with a tolerance of 1e-6 of the explicit method, in 226 000 steps to 0.03 s
    assert!(
        (record.bearings[0].contacts[0].peak_force - 672.857).abs() < 0.1,
        "{:?}",
        record.bearings[0].contacts[0]
    );
}

#[test]
fn steps_of_the_implicit_method_allocate_nothing_more() {
    let allocations = |end: f64| {
        let before = crate::machines::counting::ALLOCATIONS.get();
        drop(with_reference_speed(0.01), end, 1e-3, Steps::Implicit);
        crate::machines::counting::ALLOCATIONS.get() - before
    };
    // growth of nothing but the run's length
    assert_eq!(allocations(0.0075), allocations(0.015));
}
