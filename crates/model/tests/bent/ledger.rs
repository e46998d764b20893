//! Energy and angular momentum of a rotor that bends: what flows is what changes.

use crate::machines::bent::bent;
use crate::machines::{Blind, by, settings, vec2};
use model::base::{BaseConstants, HalfSine};
use model::magnets::MagnetsConstants;
use model::mount::{FrictionRing, HardStop, Housing, MaxwellBranch, MountParts, SqueezeFilm};
use model::rotor::TorqueTables;
use model::schedule::Schedule;
use model::seal::SealConstants;
use model::system::machine::simulate::Steps;
use model::system::machine::{Event, MachineConstants, RotorMachine};
use model::table::Table;
use solve::Stop;

/// A drop with everything that a rotor may have, gyroscopic moments, both dampings, drive, drag, magnets that fade, a seal, gravity, a base that moves, and
/// with a mount of every part.
fn loaded() -> (MachineConstants, Vec<f64>) {
    let (mut constants, start) = bent(3e4);
    constants.rotor.drive_torque = 1.0;
    constants.rotor.drive_slope = 2e-4;
    let table = |points: Vec<(f64, f64)>| Table::through(points).unwrap();
    constants.rotor.torque = Some(TorqueTables {
        over_speed: table(vec![(0.0, 2.0), (700.0, 0.5), (2000.0, -3.0)]),
        share_over_time: table(vec![(0.004, 1.0), (0.009, 0.3), (0.012, 1.5)]),
    });
    constants.rotor.drag = 1e-4;
    constants.rotor.drag_square = 1e-7;
    let magnet = (constants.bearings[0].node.clone(), vec2(-10.0, 30.0), 1e5);
    constants.magnets = Some(MagnetsConstants::fading([magnet], 500.0, 0.0));
    constants.seals = vec![SealConstants {
        node: constants.bearings[1].node.clone(),
        centre: vec2(2e-5, -1e-5),
        carried: vec2(0.0, 0.0),
        rows: vec![
            (0.0, [2e5, 5e4, -3e4, 1e5], [200.0, 30.0, 10.0, 100.0]),
            (500.0, [3e5, 9e4, -7e4, 2e5], [300.0, 30.0, 10.0, 200.0]),
            (1500.0, [1e5, 2e5, -2e5, 1e5], [300.0, 0.0, 0.0, 300.0]),
        ],
    }];
    let base = BaseConstants {
        record: [3.0, -5.0].map(|a| table(vec![(0.0, 0.0), (0.005, a), (0.01, 0.0)])),
        shocks: vec![HalfSine {
            start: 0.002,
            duration: 0.011,
            acceleration: vec2(4.0, 12.0),
        }],
    };
    constants.schedule = Schedule::of(base.knots().map(|time| (time, Event::Knot)));
    constants.base = Some(base);
    constants.bearings[1].mount_parts = MountParts {
        branches: vec![MaxwellBranch {
            stiffness: 8e6,
            rate: 1.0 / 3e-4,
        }],
        ring: Some(FrictionRing {
            stiffness: 5e6,
            travel: 2e-6,
            exponent: 8.0,
        }),
        film: Some(SqueezeFilm {
            factor: 2e-9,
            clearance: 1e-4,
            cavitates: true,
        }),
        stop: Some(HardStop {
            stiffness: 5e7,
            gap: 4e-6,
            damping: 0.5,
        }),
        housing: Some(Housing {
            mass: 2.0,
            stiffness: 3e7,
            damping: 2e3,
        }),
        ..MountParts::NONE
    };
    let machine = RotorMachine::new(constants.clone());
    let mut state = vec![0.0; solve::Machine::dimension(&machine)];
    let old = RotorMachine::new(bent(3e4).0);
    let before = old.layout().ledger();
    state[..before].copy_from_slice(&start[..before]);
    (constants, state)
}

/// Relative to what is turned over: energy, angular momentum.
pub(super) fn residuals(
    constants: MachineConstants,
    start: &[f64],
    steps: Steps,
    tolerance: f64,
    end: f64,
) -> (f64, f64) {
    let machine = RotorMachine::new(constants);
    let ending = by(
        steps,
        &machine,
        start,
        &settings(end, tolerance),
        &mut Blind,
    );
    assert_eq!(ending.stop, Stop::Finished);
    let balance = machine.balance(start, &ending.state);
    // both bearings were hit and spun up, the shaft bends
    for at in &machine.layout().bearings {
        assert!(
            ending.state[at.inner.spin()] > 10.0,
            "{}",
            ending.state[at.inner.spin()]
        );
    }
    assert!(balance.heat() > 0.5, "{}", balance.heat());
    let spin = machine.constants.rotor.polar_inertia * machine.constants.speed;
    println!(
        "{steps:?} {tolerance}: {:?}, heat {} J",
        ending.work,
        balance.heat()
    );
    (
        balance.energy_residual() / balance.heat().max(balance.work_size()),
        balance.angular_momentum_residual() / spin,
    )
}

#[test]
fn energy_and_angular_momentum_close_through_a_drop() {
    let (constants, start) = loaded();
    // parts of a mount have no tangents: explicit steps alone
    let mut known = constants.clone();
    known.bearings[1].mount_parts = MountParts::NONE;
    let before = RotorMachine::new(known.clone()).layout().ledger();
    let mut start_known = start[..before].to_vec();
    start_known.resize(
        solve::Machine::dimension(&RotorMachine::new(known.clone())),
        0.0,
    );
    for (steps, tolerance, energy, momentum) in [
        (Steps::Explicit, 1e-4, 1e-5, 1e-7),
        (Steps::Explicit, 1e-6, 1e-7, 1e-9),
        (Steps::Extended, 1e-3, 1e-5, 1e-7),
        (Steps::Extended, 1e-5, 1e-7, 1e-9),
        (Steps::Implicit, 1e-4, 1e-5, 1e-7),
    ] {
        let (constants, start) = match steps {
            Steps::Explicit | Steps::Extended => (constants.clone(), &start),
            Steps::Implicit => (known.clone(), &start_known),
        };
        let (of_energy, of_momentum) = residuals(constants, start, steps, tolerance, 0.02);
        println!("energy {of_energy:e}, angular momentum {of_momentum:e}");
        assert!(
            of_energy.abs() < energy,
            "{steps:?} {tolerance}: {of_energy}"
        );
        assert!(
            of_momentum.abs() < momentum,
            "{steps:?} {tolerance}: {of_momentum}"
        );
    }
}

/// Force on the rotor at a bearing has its datum: the same point with all moved is the same.
#[test]
fn a_datum_moves_everything_with_it() {
    let (constants, start) = crate::machines::bent::bent(3e4);
    let there = RotorMachine::new(constants.clone());
    let mut moved = constants;
    let by = vec2(3e-4, -2e-4);
    for part in &mut moved.bearings {
        part.datum += by;
    }
    let here = RotorMachine::new(moved);
    let mut state = start.clone();
    here.perturb(&mut state, by, &|_, _| 0.0);
    let (before, _) = there.inspect(&start);
    let (after, _) = here.inspect(&state);
    for k in 0..there.layout().ledger() {
        let name = here.layout().channel_name(k);
        let size = before[k].abs().max(1.0);
        assert!(
            (before[k] - after[k]).abs() < 1e-6 * size,
            "{name}: {} {}",
            before[k],
            after[k]
        );
    }
}
