//! A machine gives the same bits whatever computes it: alone without a vector unit, alone with its balls in groups,
//! or on any lane among other machines.

use crate::bent::housings::housed;
use crate::machines::bent::bent;
use crate::machines::{
    inlets, lubricant, oil, planar, reference, separate, separations, settings, times_mass, vec2,
};
use model::base::{BaseConstants, HalfSine};
use model::bearing::{BearingConstants, SharedMoment, SteadyMoment};
use model::rotor::{TorqueTables, Unbalance};
use model::schedule::Schedule;
use model::system::machine::simulate::{Runs, Shape, Steps, simulate_on};
use model::system::machine::{Event, MachineConstants, RotorMachine};
use model::table::Table;
use number::Level;
use physics::palmgren::Palmgren;
use physics::traction::{DryTraction, FourParameterTraction, Traction};
use solve::{Ending, Flow, Machine, Observer, Step};
use std::sync::atomic::AtomicBool;

/// Every accepted step: its end, and the state and probes in its middle, from dense output.
#[derive(Default)]
struct Bits(Vec<u64>);
impl Observer<RotorMachine> for Bits {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        self.0.push(step.end.to_bits());
        if self.0.len().is_multiple_of(50) {
            let (state, probes) = step.evaluate(0.5);
            self.0
                .extend(state.iter().chain(probes).map(|value| value.to_bits()));
        }
        Flow::Continue
    }
}

/// The state at release: of a rotor that bends on an orbit of its rigid motions.
fn start(machine: &RotorMachine) -> Vec<f64> {
    let own = &machine.constants.rotor.coordinates;
    if own.len() == 1 {
        return machine.start();
    }
    let along = |size: f64| -> Vec<_> {
        let shift = |k: usize| vec2(size * own[k].weight, 0.3 * size);
        (0..own.len()).map(shift).collect()
    };
    machine.start_with(&along(2e-6), &along(2e-3))
}

/// A run of machines on a level, in a shape, by some steps: how each ended, and the bits of what was seen on the way.
fn seen(
    (level, shape): (Level, Shape),
    machines: &[RotorMachine],
    end: f64,
    steps: Steps,
) -> Vec<(Ending, Vec<u64>)> {
    let starts: Vec<_> = machines.iter().map(start).collect();
    let machines: Vec<_> = machines.iter().collect();
    let mut seen: Vec<_> = machines.iter().map(|_| Bits::default()).collect();
    let mut observers: Vec<&mut dyn Observer<RotorMachine>> = Vec::new();
    for bits in &mut seen {
        observers.push(bits);
    }
    let tolerance = match steps {
        Steps::Explicit => 1e-4,
        Steps::Extended | Steps::Implicit => 1e-2,
    };
    let runs = Runs {
        machines: &machines,
        starts: &starts,
        settings: settings(end, tolerance),
        steps,
        interrupt: &AtomicBool::new(false),
    };
    let endings = simulate_on(level, shape, runs, &mut observers);
    endings
        .into_iter()
        .zip(seen.into_iter().map(|bits| bits.0))
        .collect()
}

/// Asserts that each machine ends alone at every level as it does without a vector unit, and on the lane it has
/// among the others, by all methods.
fn same_bits(machines: &[RotorMachine], end: f64) {
    for steps in [Steps::Explicit, Steps::Extended, Steps::Implicit] {
        same_bits_by(steps, machines, end);
    }
}

fn same_bits_by(steps: Steps, machines: &[RotorMachine], end: f64) {
    let alone = |level: Level, machine: &RotorMachine| {
        let machine = std::slice::from_ref(machine);
        seen((level, Shape::Balls), machine, end, steps).remove(0)
    };
    let expected: Vec<_> = machines
        .iter()
        .map(|machine| alone(Level::Baseline, machine))
        .collect();
    for level in Level::available() {
        for (machine, expected) in machines.iter().zip(&expected) {
            assert_equal(
                &alone(level, machine),
                expected,
                &format!("alone, {level:?}"),
            );
        }
        for (from, batch) in machines.chunks(level.lanes()).enumerate() {
            let runs = seen((level, Shape::Machines), batch, end, steps);
            for (lane, run) in runs.iter().enumerate() {
                let machine = from * level.lanes() + lane;
                assert_equal(run, &expected[machine], &format!("lane {lane}, {level:?}"));
            }
        }
    }
}

fn assert_equal(ours: &(Ending, Vec<u64>), expected: &(Ending, Vec<u64>), place: &str) {
    let bits = |ending: &Ending| -> Vec<u64> { ending.state.iter().map(|v| v.to_bits()).collect() };
    assert_eq!(ours.0.work, expected.0.work, "{place}");
    assert!(
        bits(&ours.0) == bits(&expected.0),
        "{place}: final states differ"
    );
    assert!(ours.1 == expected.1, "{place}: steps differ");
}

/// The reference machine with one more change for each number: lanes that differ in everything a lane may differ in.
fn variant(number: usize) -> MachineConstants {
    let x = number as f64;
    let mut constants = reference();
    constants.speed *= 1.0 - 0.07 * x;
    constants.unbalance_angle = 0.4 * x;
    times_mass(&mut constants, 1.0 + 0.05 * x);
    let part = &mut constants.bearings[0];
    part.contact.radial_clearance *= 1.0 - 0.03 * x;
    part.contact.friction *= 1.0 + 0.1 * x;
    part.mount.stiffness *= 1.0 + 0.2 * x;
    if let BearingConstants::Planar(bearing) = &mut constants.bearings[0].bearing {
        bearing.ball.inner_stiffness *= 1.0 + 0.02 * x;
        bearing.ball.pocket_gap *= 1.0 - 0.05 * x;
    }
    constants
}

#[test]
fn the_reference_drop_has_the_same_bits_everywhere() {
    same_bits(&[RotorMachine::new(reference())], 0.02);
}

#[test]
fn machines_side_by_side_do_not_touch_each_other() {
    let machines: Vec<_> = (0..8).map(|i| RotorMachine::new(variant(i))).collect();
    let spread: Vec<_> = machines.iter().map(|m| m.start()[1]).collect();
    assert!(spread.windows(2).all(|pair| pair[0] != pair[1]));
    same_bits(&machines, 0.01);
}

#[test]
fn a_rotor_that_bends_has_the_same_bits() {
    // lanes that differ in all numbers of the rotor, one more than a group; more coordinates than a group, and not a multiple
    let machines: Vec<_> = (0..9)
        .map(|i| {
            let x = i as f64;
            let (mut constants, _) = bent(1.2e5);
            constants.speed *= 1.0 - 0.05 * x;
            constants.unbalance_angle = 0.4 * x;
            constants.rotor.drag = 1e-5 * (1.0 + x);
            let table = |points: Vec<(f64, f64)>| Table::through(points).unwrap();
            constants.rotor.torque = Some(TorqueTables {
                over_speed: table(vec![(0.0, 1.0), (900.0 - 10.0 * x, 0.1 * x - 0.4)]),
                share_over_time: table(vec![(1e-3, 1.0), (4e-3 + 1e-4 * x, 0.1 * x)]),
            });
            for own in &mut constants.rotor.coordinates {
                own.frequency *= 1.0 - 0.01 * x;
                own.weight *= 1.0 + 0.02 * x;
                own.unbalance = own.unbalance * (1.0 + 0.1 * x);
            }
            for matrix in [
                &mut constants.rotor.gyroscopic,
                &mut constants.rotor.damping,
                &mut constants.rotor.damping_rotating,
            ] {
                matrix.iter_mut().for_each(|entry| *entry *= 1.0 + 0.1 * x);
            }
            for part in &mut constants.bearings {
                part.node
                    .iter_mut()
                    .for_each(|shape| *shape *= 1.0 + 0.02 * x);
                part.datum = vec2(1e-6 * x, -2e-6 * x);
                part.contact.friction *= 1.0 + 0.1 * x;
            }
            shake_and_unbalance(&mut constants, x);
            RotorMachine::new(constants)
        })
        .collect();
    let coordinates = machines[0].layout().rotor.coordinates;
    assert!(
        coordinates > 8 && !coordinates.is_multiple_of(4),
        "{coordinates}"
    );
    same_bits(&machines, 0.01);
    let in_casings = machines.iter().map(|own| {
        let constants = housed(own.constants.clone(), [true, true]);
        RotorMachine::new(constants)
    });
    same_bits(&in_casings.collect::<Vec<_>>(), 0.005);
}

/// A base that moves, and an unbalance that comes, at instants that differ from lane to lane.
fn shake_and_unbalance(constants: &mut MachineConstants, x: f64) {
    let knots = (0..5).map(|k| {
        (
            1e-3 * f64::from(k) * (1.0 + 0.1 * x),
            10.0 * x - f64::from(k),
        )
    });
    let base = BaseConstants {
        record: [Table::through(knots.collect()).unwrap(), Table::constant(x)],
        shocks: vec![HalfSine {
            start: 1e-3 * x,
            duration: 2e-3,
            acceleration: vec2(5.0, 50.0 + x),
        }],
    };
    constants.unbalances = vec![Unbalance {
        node: constants.bearings[0].node.clone(),
        product: 2e-4,
        phase: x,
    }];
    let comes = (4e-3 + 4e-4 * x, Event::Unbalance(0));
    let knots = base.knots().map(|time| (time, Event::Knot));
    constants.schedule = Schedule::of(knots.chain([comes]));
    constants.base = Some(base);
}

#[test]
fn whatever_keeps_the_balls_apart_has_the_same_bits() {
    for separation in separations() {
        // lanes that differ in all that a lane may differ in, one more than a group
        let machines: Vec<_> = (0..9)
            .map(|i| {
                let mut constants = variant(i % 5);
                separate(&mut constants, separation.clone());
                RotorMachine::new(constants)
            })
            .collect();
        same_bits(&machines, 0.008);
    }
}

#[test]
fn a_lubricant_that_changes_has_the_same_bits() {
    // lanes that differ in every parameter of it
    let machines: Vec<_> = (0..5)
        .map(|i| {
            let x = i as f64;
            let mut constants = variant(i);
            let bearing = planar(&mut constants);
            let mut slow = lubricant();
            slow.build_up = 0.1 * x;
            slow.breakdown = 0.05 * x;
            let grease = slow.grease.as_mut().expect("greased");
            grease.rested_factor *= 1.0 + 0.3 * x;
            grease.worked_factor *= 1.0 - 0.1 * x;
            grease.build_up_angle *= 1.0 + x;
            let films = slow.films.as_mut().expect("they warm");
            films.heat_capacity *= 0.01 * (1.0 + x);
            films.traction_coefficient *= 1.0 + x;
            bearing.lubricant = Some(slow);
            bearing.ball.orbit_drag = 0.0;
            bearing.ball.spin_drag = 0.0;
            bearing.moment = Some(SharedMoment {
                law: SteadyMoment::Palmgren(grease_law(100e-6 * (1.0 + 0.1 * x))),
                axial_load: 0.0,
                orbit_share: 0.5,
                reference_spin: 1.0,
            });
            RotorMachine::new(constants)
        })
        .collect();
    same_bits(&machines, 0.004);
}

/// Palmgren's law of a 6005 of 6.55 kN with grease of a viscosity, m²/s.
fn grease_law(viscosity: f64) -> Palmgren<f64> {
    Palmgren {
        viscous_factor: 2.0,
        viscosity,
        pitch_diameter: 36e-3,
        load_factor: 9e-4,
        load_exponent: 0.55,
        static_load_rating: 6550.0,
        preload: 0.0,
    }
}

#[test]
fn any_number_of_balls_and_any_traction_law_has_the_same_bits() {
    let laws = [
        Traction::FourParameter(FourParameterTraction {
            a: -0.07,
            b: 0.35,
            c: 5.0,
            d: 0.07,
        }),
        Traction::Dry(DryTraction {
            kinetic: 0.1,
            static_excess: 0.1,
            inverse_decay_speed: 2.0,
            inverse_reference_speed: 10.0,
        }),
        oil(),
    ];
    // fewer than a group, a group, one more, several groups
    for (balls, law) in [3, 8, 9, 19].into_iter().zip(laws.into_iter().cycle()) {
        let mut constants = reference();
        if let BearingConstants::Planar(bearing) = &mut constants.bearings[0].bearing {
            bearing.balls = balls;
            bearing.traction = law;
            bearing.inlet_rolling = Some(inlets());
        }
        let machine = RotorMachine::new(constants);
        assert!(machine.dimension() > 5 * balls);
        same_bits(&[machine], 0.008);
    }
}
