//! Every drive with and without a housing: what closes, whatever turns the race and carries the other one.

use super::bench::{SPEED, clutch, housing, rig, rolls, run};
use crate::rig::bench::fidelities;
use model::bearing::BearingConstants;
use model::system::rig::{Drive, Engagement, Program, RigConstants, SlidingRotor};
use model::table::Table;

/// Comes to speed within some 30 ms.
fn drives(constants: &mut RigConstants) -> Vec<(&'static str, Drive)> {
    let rotor = SlidingRotor {
        bore_radius: 12.5e-3,
        friction: 0.2,
        inverse_reference_speed: 20.0,
        speed: SPEED,
        polar_inertia: 1e-3,
        spin_held: false,
    };
    vec![
        ("rotor", Drive::SlidingRotor(rotor)),
        ("torque", Drive::Torque(Table::constant(0.1))),
        ("speed", Drive::ramp(5e3, SPEED)),
        ("clutch", Drive::Clutch(Box::new(clutch(constants).clone()))),
    ]
}

#[test]
fn energy_and_momentum_close_with_every_drive_with_and_without_a_housing() {
    let engagement = Engagement {
        rate: 50.0,
        largest: 3.0,
    };
    let varies = Table::through(vec![(0.0, 24.0), (0.01, 40.0), (0.02, 15.0)]).expect("rises");
    for bearing in fidelities() {
        let program = Program::spin_up(SPEED, 0.005, engagement, true);
        let mut whole = rig(bearing, program);
        for (name, drive) in drives(&mut whole) {
            for held in [true, false] {
                for housed in [true, false] {
                    let mut c = whole.clone();
                    c.drive = drive.clone();
                    // the load of a clutch is constant
                    if name != "clutch" {
                        c.load = varies.clone();
                    }
                    if housed {
                        housing(&mut c).centre_held = held;
                    } else {
                        c.housing = None;
                        c.race.mass = 0.1;
                        c.race.centre_held = held;
                    }
                    let run = run(c, 0.04, 1e-5);
                    let case = format!("{name} held {held} housed {housed}");
                    let energy = run.energy_residual();
                    assert!(energy.abs() < 1e-6, "{case}: {energy}");
                    let balance = run.machine.balance(&run.start, run.end());
                    let momentum = balance.angular_momentum_residual();
                    assert!(momentum.abs() < 1e-9, "{case}: {momentum}");
                    if housed {
                        let own = run.machine.bearing_momentum_residual(&run.start, run.end());
                        assert!(own.abs() < 1e-9, "{case}: {own}");
                    }
                    let speed = run.end()[run.machine.layout().bearings[0].inner.spin()];
                    assert!(speed > 10.0, "{case}: {speed}");
                    let names: Vec<String> = (0..run.machine.layout().ledger())
                        .map(|channel| run.machine.layout().channel_name(channel))
                        .collect();
                    let driver = if name == "clutch" {
                        "flywheel.speed"
                    } else {
                        "rotor.speed"
                    };
                    assert!(names.iter().any(|known| known == driver), "{case}");
                }
            }
        }
    }
}

/// Ten kilograms of cage that move with the outer race: their weight is part of the load, and no store of energy besides.
#[test]
fn the_weight_of_what_moves_with_a_housing_counts_once() {
    let program = Program::spin_up(
        SPEED,
        0.005,
        Engagement {
            rate: 50.0,
            largest: 3.0,
        },
        true,
    );
    let mut bearing = rolls();
    bearing.cage_mass = 10.0;
    let mut constants = rig(BearingConstants::Rolling(bearing), program);
    constants.drive = Drive::Torque(Table::constant(1e-3));
    constants.load = Table::through(vec![(0.0, 24.0), (0.01, 400.0)]).expect("rises");
    housing(&mut constants).centre_held = false;
    let run = run(constants, 0.02, 1e-7);
    let outer = run.machine.layout().bearings[0].outer;
    let [start, end] = [&run.start[..], run.end()].map(|state| outer.motion(state).position);
    let work = 10.0 * 9.81 * (end - start).length_squared().sqrt();
    let balance = run.machine.balance(&run.start, run.end());
    let left = balance.energy_residual();
    assert!(
        work > 1e-4 && left.abs() < 1e-3 * work,
        "{left} J of {work} J"
    );
}
