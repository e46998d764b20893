//! The clutch: its heat, when it locks, when it gives way.

use super::bench::{SPEED, clutch, concentric, fidelities, frictionless, rolls, run, without_drag};
use model::bearing::BearingConstants;
use model::system::rig::layout::{
    ACCELERATION, CLUTCH_CAPACITY, CLUTCH_SLIP, DRIVE_HEAT, DRIVE_MOMENT, FLYWHEEL, SHAFT,
};
use model::system::rig::{Action, Clutch, Engagement, Program, Start};

#[test]
fn the_heat_of_a_slip_is_that_of_an_inelastic_impact() {
    for rate in [5.0, 500.0, f64::INFINITY] {
        let engagement = Engagement { rate, largest: 0.4 };
        let program = Program::spin_up(SPEED, 0.01, engagement, false);
        let mut c = without_drag(concentric(
            BearingConstants::Rolling(frictionless()),
            program,
        ));
        clutch(&mut c).flywheel.inertia = 3e-4;
        let shaft = c.race.inertia + frictionless().set.inner_inertia();
        let flywheel = clutch(&mut c).flywheel.inertia;
        let run = run(c, 0.3, 1e-7);
        // ½ I_s I_f/(I_s + I_f) Δω²
        let expected = 0.5 * shaft * flywheel / (shaft + flywheel) * SPEED * SPEED;
        let heat = run.heat(DRIVE_HEAT);
        // a cubic in time integrated by a method of order three
        assert!((heat / expected - 1.0).abs() < 1e-9, "{heat} {expected}");
        let speed = flywheel * SPEED / (shaft + flywheel);
        assert!((run.end()[SHAFT.spin()] / speed - 1.0).abs() < 1e-12);
        assert_eq!(run.end()[SHAFT.spin()], run.end()[FLYWHEEL.spin()]);
        // locked when the capacity has turned the shaft to that speed
        let locked = run.record.rig().locked_at().expect("locks");
        let impulse = shaft * speed;
        let closed = if rate * 0.02 < 0.4 {
            0.01 + (2.0 * impulse / rate).sqrt()
        } else {
            0.01 + impulse / 0.4 + 0.5 * 0.4 / rate
        };
        if (2.0 * impulse / rate).sqrt() * rate < 0.4 || rate > 100.0 {
            assert!((locked / closed - 1.0).abs() < 1e-9, "{locked} {closed}");
        }
    }
}

#[test]
fn it_locks_once_and_stays_locked() {
    for bearing in fidelities() {
        let engagement = Engagement {
            rate: 50.0,
            largest: 3.0,
        };
        let program = Program::spin_up(SPEED, 0.005, engagement, true);
        let run = run(concentric(bearing, program), 0.1, 1e-5);
        let kinds: Vec<Clutch> = run
            .record
            .rig()
            .clutch
            .iter()
            .map(|event| event.clutch)
            .collect();
        assert_eq!(
            kinds,
            [
                Clutch::Open,
                Clutch::Slipping { direction: 1.0 },
                Clutch::Locked
            ]
        );
        let locked = run.record.rig().locked_at().expect("locks");
        for row in run.record.rows().filter(|row| row.time > locked) {
            assert_eq!(row.probe[CLUTCH_SLIP], 0.0);
            assert!(row.probe[DRIVE_MOMENT].abs() < row.probe[CLUTCH_CAPACITY]);
        }
        // the peak is that of the last instant of slipping
        let peak = run.record.rig().acceleration;
        assert!((peak.time - locked).abs() < 1e-12, "{peak:?} {locked}");
        let after = run
            .record
            .rows()
            .find(|row| row.time > locked)
            .expect("rows");
        assert!(after.probe[ACCELERATION].abs() < 0.01 * peak.value);
    }
}

#[test]
fn it_gives_way_when_overloaded_and_locks_again() {
    // a weak clutch: locked at rest, then the motor pulls harder than it carries, until the motor has arrived
    let program = Program {
        start: Start::REST,
        actions: vec![
            (0.0, Action::Engage(Engagement::at_once(0.02))),
            (
                0.01,
                Action::MotorTo {
                    speed: SPEED,
                    rate: 100.0,
                },
            ),
        ],
    };
    let mut c = without_drag(concentric(
        BearingConstants::Rolling(frictionless()),
        program,
    ));
    c.race.inertia = 1e-3;
    let inertia = c.race.inertia + frictionless().set.inner_inertia();
    let run = run(c, 10.0, 1e-7);
    let kinds: Vec<Clutch> = run
        .record
        .rig()
        .clutch
        .iter()
        .map(|event| event.clutch)
        .collect();
    assert_eq!(
        kinds,
        [
            Clutch::Locked,
            Clutch::Slipping { direction: 1.0 },
            Clutch::Locked
        ],
        "{:?}",
        run.record.rig().clutch
    );
    // while it slips the shaft has the acceleration of the capacity
    let slips = run.record.rig().clutch[1];
    assert!(slips.time > 0.01 && slips.time < 0.2, "{slips:?}");
    for row in run.record.rows() {
        if row.time > slips.time && row.time < run.record.rig().clutch[2].time {
            assert!((row.probe[ACCELERATION] * inertia / 0.02 - 1.0).abs() < 1e-9);
            assert!(row.probe[CLUTCH_SLIP] > 0.0);
        }
    }
    assert!((run.end()[SHAFT.spin()] / SPEED - 1.0).abs() < 1e-3);
    assert!(run.energy_residual().abs() < 1e-6);
    for residual in run.momentum_residuals() {
        assert!(residual.abs() < 1e-8, "{residual}");
    }
}

#[test]
fn a_clutch_too_weak_for_the_drags_never_moves_the_shaft_far() {
    let program = Program::spin_up(SPEED, 0.0, Engagement::at_once(2e-3), true);
    let run = run(
        concentric(BearingConstants::Rolling(rolls()), program),
        0.5,
        1e-6,
    );
    assert_eq!(run.record.rig().locked_at(), None);
    // 2 N mm against 5 N mm of support drag that fades at rest: it creeps
    assert!(run.end()[SHAFT.spin()] < 0.5, "{}", run.end()[SHAFT.spin()]);
    assert!(run.heat(DRIVE_HEAT) > 0.1);
}

#[test]
fn a_faster_shaft_drives_the_flywheel() {
    let program = Program {
        start: Start {
            shaft_speed: SPEED,
            flywheel_speed: -20.0,
        },
        actions: vec![(
            0.01,
            Action::Engage(Engagement {
                rate: 1.0,
                largest: 0.2,
            }),
        )],
    };
    for bearing in fidelities() {
        let run = run(concentric(bearing, program.clone()), 0.4, 1e-5);
        assert_eq!(
            run.record.rig().clutch[1].clutch,
            Clutch::Slipping { direction: -1.0 }
        );
        assert!(run.record.rig().locked_at().is_some());
        assert!(
            run.end()[SHAFT.spin()] < 0.0,
            "the flywheel is the heavier one"
        );
        assert!(run.heat(DRIVE_HEAT) > 0.0);
        assert!(run.energy_residual().abs() < 1e-6);
    }
}

#[test]
fn balls_that_hit_their_pockets_do_not_keep_an_overloaded_clutch_from_a_decision() {
    // a clutch that carries about what the bearing takes: it slips and grips many times
    let program = Program {
        start: Start {
            shaft_speed: SPEED,
            flywheel_speed: SPEED,
        },
        actions: vec![
            (0.0, Action::Engage(Engagement::at_once(0.0333))),
            (
                0.0,
                Action::MotorTo {
                    speed: SPEED,
                    rate: f64::INFINITY,
                },
            ),
        ],
    };
    let [_, planar] = fidelities();
    let run = run(concentric(planar, program), 0.05, 1e-5);
    println!("{} changes", run.record.rig().clutch.len());
    assert!(run.record.rig().clutch.len() > 1, "it does slip");
    for pair in run.record.rig().clutch.windows(2) {
        assert!(pair[1].time >= pair[0].time && pair[1].clutch != pair[0].clutch);
    }
    assert!(run.energy_residual().abs() < 1e-6);
    assert!(run.heat(DRIVE_HEAT) >= 0.0);
    for residual in run.momentum_residuals() {
        assert!(residual.abs() < 1e-8, "{residual}");
    }
}
