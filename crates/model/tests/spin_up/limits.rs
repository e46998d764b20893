//! What is refused, and what tables do at their ends.

use super::rig::{free_bearing, greased_bearing, machine, rolling, run};
use model::bearing::{AccelerationLoss, BearingConstants, PlanarConstants, RollingConstants};
use model::system::machine::RotorMachine;
use model::system::rig::{Drive, Refusal};
use model::table::{Table, TableError};
use solve::Machine;

fn planar(bearing: PlanarConstants) -> BearingConstants {
    BearingConstants::Planar(bearing)
}

fn rolls(change: impl Fn(&mut RollingConstants)) -> BearingConstants {
    let mut bearing = rolling();
    change(&mut bearing);
    BearingConstants::Rolling(bearing)
}

fn torque() -> Drive {
    Drive::Torque(Table::constant(0.01))
}

fn refusal(bearing: BearingConstants, drive: Drive) -> Option<Refusal> {
    RotorMachine::on_rig(machine(bearing, drive, 1000.0)).err()
}

#[test]
fn what_has_no_meaning_is_refused() {
    let mut dragged = greased_bearing();
    dragged.cage_drag = 1e-9;
    assert_eq!(
        refusal(planar(dragged), torque()),
        Some(Refusal::DragToGround)
    );
    let mut shared = greased_bearing();
    shared.moment.as_mut().expect("greased").orbit_share = 1.1;
    assert_eq!(
        refusal(planar(shared), torque()),
        Some(Refusal::MomentShare)
    );

    let creates = rolls(|b| b.loss = AccelerationLoss::Constant { force: -0.1 });
    assert_eq!(refusal(creates, torque()), Some(Refusal::LossCreatesEnergy));
    let too_much = |b: &mut RollingConstants| {
        b.loss = AccelerationLoss::Proportional {
            per_acceleration: 1e-3,
        };
    };
    assert_eq!(
        refusal(rolls(too_much), torque()),
        Some(Refusal::LossExceedsInertia)
    );
    // at a given speed nothing is to be solved for
    assert_eq!(refusal(rolls(too_much), Drive::ramp(1e4, 500.0)), None);

    assert_eq!(
        refusal(rolls(|_| ()), Drive::step(500.0)),
        Some(Refusal::StepOfRollingBalls)
    );
    assert_eq!(refusal(planar(free_bearing()), Drive::step(500.0)), None);

    let mut c = machine(rolls(|_| ()), torque(), 1000.0);
    c.load = Table::through(vec![(0.0, 10.0), (1.0, -1.0)]).expect("rises");
    let refused = RotorMachine::on_rig(c).err();
    assert_eq!(refused, Some(Refusal::NegativeLoad));
    assert!(refused.is_some_and(|why| why.to_string().contains("load")));
}

#[test]
fn tables_are_straight_between_their_rows_and_flat_beyond() {
    let table = Table::through(vec![(1.0, 10.0), (2.0, 30.0), (4.0, 20.0)]).expect("rises");
    for (x, y) in [
        (0.0, 10.0),
        (1.0, 10.0),
        (1.5, 20.0),
        (2.0, 30.0),
        (3.0, 25.0),
        (9.0, 20.0),
    ] {
        assert_eq!(table.value(x), y);
    }
    // at a knot the line that begins there holds
    assert_eq!(
        (table.piece(2.0).slope, table.piece(4.0).slope),
        (-5.0, 0.0)
    );
    assert_eq!((table.smallest(), table.largest()), (10.0, 30.0));
    assert_eq!(Table::through(vec![]), Err(TableError::Empty));
    assert_eq!(
        Table::through(vec![(0.0, 1.0), (0.0, 2.0)]),
        Err(TableError::NotRising(1))
    );
    assert_eq!(
        Table::through(vec![(0.0, f64::NAN)]),
        Err(TableError::NotFinite(0))
    );
}

#[test]
fn a_ramp_ends_at_its_speed_and_stays() {
    for speed in [700.0, -700.0] {
        let c = machine(rolls(|_| ()), Drive::ramp(7e4, speed), speed);
        assert_eq!(
            RotorMachine::on_rig(c.clone()).expect("built").landings(),
            [0.01]
        );
        let run = run(c, 0.015, 1e-6);
        let reached = run.end[model::system::rig::layout::INNER.spin()];
        // rounding of the sum of the steps
        assert!((reached - speed).abs() < 1e-9, "{reached}");
        let half = run.record.bearings[0]
            .inner_race_time_to_50_percent()
            .expect("reached");
        assert!((half - 0.005).abs() < 1e-9, "{half}");
    }
}

#[test]
fn every_channel_has_a_name_and_a_scale() {
    for bearing in [planar(greased_bearing()), rolls(|_| ())] {
        let machine = RotorMachine::on_rig(machine(bearing, torque(), 1000.0)).expect("built");
        let mut names: Vec<_> = (0..machine.dimension())
            .map(|channel| {
                assert!(machine.error_scale(channel) > 0.0);
                machine.channel_name(channel)
            })
            .collect();
        assert_eq!(names[7], "bearing.inner_race.speed");
        assert_eq!(names[8], "bearing.cage.angle");
        names.sort();
        names.dedup();
        assert_eq!(names.len(), machine.dimension());
    }
}
