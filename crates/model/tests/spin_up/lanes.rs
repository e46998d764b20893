//! A machine gives the same bits alone and on any lane among others, at every level of the vector unit; and its loop
//! does not allocate.

use super::rig::{greased_bearing, machine, observe, palmgren, rolling, shared};
use crate::machines::counting::ALLOCATIONS;
use crate::machines::settings;
use model::bearing::{AccelerationLoss, BearingConstants, SteadyMoment};
use model::system::machine::RotorMachine;
use model::system::machine::record::Record;
use model::system::machine::simulate::{Runs, Shape, Steps, simulate_on};
use model::system::rig::{Drive, RigConstants, SlidingRotor};
use model::table::Table;
use number::Level;
use physics::moment_curve::MomentCurve;
use solve::{Ending, Flow, Machine, Observer, Step};
use std::sync::atomic::AtomicBool;

/// Every accepted step: its end, and sometimes state and probes in its middle.
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

/// How machines end, and the bits of their steps.
fn side(level: Level, shape: Shape, machines: &[RotorMachine], end: f64) -> Vec<(Ending, Bits)> {
    let starts: Vec<_> = machines.iter().map(RotorMachine::start).collect();
    let mut seen: Vec<_> = machines.iter().map(|_| Bits::default()).collect();
    let runs = Runs {
        machines: &machines.iter().collect::<Vec<_>>(),
        starts: &starts,
        settings: settings(end, 1e-4),
        steps: Steps::Explicit,
        interrupt: &AtomicBool::new(false),
    };
    let mut observers: Vec<&mut dyn Observer<RotorMachine>> = Vec::new();
    observers.extend(seen.iter_mut().map(|own| own as _));
    let endings = simulate_on(level, shape, runs, &mut observers);
    endings.into_iter().zip(seen).collect()
}

fn same_bits(constants: impl Fn(usize) -> RigConstants, end: f64) {
    let machines: Vec<_> = (0..8)
        .map(|i| RotorMachine::on_rig(constants(i)).expect("can be built"))
        .collect();
    let bits = |(ending, seen): &(Ending, Bits)| -> Vec<u64> {
        let state = ending.state.iter().map(|value| value.to_bits());
        state.chain(seen.0.iter().copied()).collect()
    };
    let expected: Vec<_> = machines
        .iter()
        .map(std::slice::from_ref)
        .map(|machine| side(Level::Baseline, Shape::Balls, machine, end))
        .map(|run| bits(&run[0]))
        .collect();
    assert!(expected.windows(2).all(|pair| pair[0] != pair[1]));
    for level in Level::available() {
        let alone = side(level, Shape::Balls, &machines[..1], end);
        assert!(bits(&alone[0]) == expected[0], "alone, {level:?}");
        for (from, batch) in machines.chunks(level.lanes()).enumerate() {
            let runs = side(level, Shape::Machines, batch, end);
            for (lane, run) in runs.iter().enumerate() {
                let which = from * level.lanes() + lane;
                assert!(bits(run) == expected[which], "lane {lane}, {level:?}");
            }
        }
    }
}

/// A load whose knots lie elsewhere in every machine.
fn load(x: f64) -> Table {
    let points = vec![
        (0.0, 50.0 + x),
        (1e-3 + 1e-4 * x, 100.0),
        (2.5e-3 - 1e-4 * x, 60.0),
    ];
    Table::through(points).expect("rises")
}

#[test]
fn greased_balls_under_a_sliding_rotor_have_the_same_bits_everywhere() {
    same_bits(
        |i| {
            let x = i as f64;
            let mut bearing = greased_bearing();
            if let Some(moment) = &mut bearing.moment {
                moment.orbit_share = 0.3 + 0.05 * x;
                moment.law = moment.law.clone().scaled(1.0 - 0.02 * x);
            }
            let rotor = SlidingRotor {
                bore_radius: 12.5e-3,
                friction: 0.2 + 0.01 * x,
                inverse_reference_speed: 20.0,
                speed: 1000.0 - 30.0 * x,
                polar_inertia: 1e-3,
                spin_held: false,
            };
            let bearing = BearingConstants::Planar(bearing);
            let mut c = machine(bearing, Drive::SlidingRotor(rotor), 1000.0);
            c.race.centre_held = false;
            c.load = load(x);
            c
        },
        4e-3,
    );
}

#[test]
fn rolling_balls_with_a_loss_have_the_same_bits_everywhere() {
    same_bits(
        |i| {
            let x = i as f64;
            let mut bearing = rolling();
            bearing.moment = SteadyMoment::Curve(
                MomentCurve::through(&[(0.0, 0.01), (300.0, 0.02 + 1e-3 * x), (1000.0, 0.05)])
                    .expect("a curve"),
            );
            bearing.loss = AccelerationLoss::Affine {
                force: Table::through(vec![(0.0, 0.1), (200.0 + x, 0.2)]).expect("rises"),
                per_acceleration: Table::constant(1e-6 * (1.0 + x)),
            };
            let bearing = BearingConstants::Rolling(bearing);
            let torque = Table::through(vec![(0.0, 0.1), (2e-3, 0.3 + 0.01 * x), (3e-3, -0.1)]);
            let mut c = machine(bearing, Drive::Torque(torque.expect("rises")), 1000.0);
            c.load = load(x);
            c
        },
        0.01,
    );
}

#[test]
fn a_spin_up_ten_times_longer_allocates_no_more() {
    let mut bearing = greased_bearing();
    bearing.moment = Some(shared(SteadyMoment::Palmgren(palmgren())));
    let c = machine(
        BearingConstants::Planar(bearing),
        Drive::step(1000.0),
        1000.0,
    );
    let machine = RotorMachine::on_rig(c).expect("can be built");
    let start = machine.start();
    let count = |end: f64| {
        let before = ALLOCATIONS.get();
        let mut record = Record::new(&machine, end, end / 50.0, true);
        observe(&machine, &start, &settings(end, 1e-4), &mut record);
        assert!(record.row_count() > 49 && machine.dimension() > 50);
        ALLOCATIONS.get() - before
    };
    let (short, long) = (count(5e-4), count(5e-3));
    assert!(short > 0, "the counter counts");
    assert_eq!(short, long);
}
