//! Programs: coast-down, spin-up, ramp and hold, repeat after rest; the engagement that gives an acceleration.

use super::bench::{
    SPEED, balls, clutch, concentric, fidelities, frictionless, rig, rolls, run, without_drag,
};
use model::bearing::{BearingConstants, SteadyMoment};
use model::system::rig::layout::{ACCELERATION, CAGE_SLIP, FLYWHEEL, SHAFT};
use model::system::rig::{Action, Clutch, Drag, Engagement, Program, Start, engagement_ramp};
use physics::traction::{TanhTraction, Traction};

#[test]
fn the_three_tests_of_the_paper_have_their_accelerations() {
    // peak acceleration, rad/s², and time from rest to 150 rad/s, s: a straight rise of the torque
    for (wanted, time) in [(11_500.0, 26e-3), (7_200.0, 42e-3), (1_300.0, 231e-3)] {
        let with = |rate: f64| {
            let engagement = Engagement { rate, largest: 5.0 };
            let program = Program::spin_up(SPEED, 0.01, engagement, true);
            rig(BearingConstants::Rolling(rolls()), program)
        };
        let rate = engagement_ramp(&with(1.0), wanted, SPEED).expect("found");
        let run = run(with(rate), 0.4, 1e-6);
        let peak = run.record.rig().acceleration.value;
        assert!((peak / wanted - 1.0).abs() < 1e-3, "{peak} {wanted}");
        // Ω rises with the square of the time, from when the capacity exceeds the drags
        let lock = run.record.rig().locked_at().expect("locks");
        let half = run.record.bearings[0]
            .inner_race_time_to_50_percent()
            .expect("half");
        let took = (lock - half) / (1.0 - 0.5_f64.sqrt());
        // drags that grow with speed; the flywheel yields 0.2 % where the motor does not hold it
        assert!((took / time - 1.0).abs() < 0.03, "{took} {time}");
    }
}

#[test]
fn the_ramp_is_the_same_for_balls_one_by_one() {
    let rate = |bearing: BearingConstants| {
        let engagement = Engagement {
            rate: 1.0,
            largest: 5.0,
        };
        let program = Program::spin_up(SPEED, 0.0, engagement, false);
        engagement_ramp(&concentric(bearing, program), 7200.0, SPEED).expect("found")
    };
    let [rolling, planar] = fidelities().map(rate);
    assert_eq!(rolling, planar);
}

#[test]
fn a_shaft_coasts_down_in_the_time_of_a_constant_drag() {
    let mut c = without_drag(concentric(
        BearingConstants::Rolling(frictionless()),
        Program::coast_down(SPEED, None),
    ));
    let (torque, reference) = (2e-3, 1e-3);
    clutch(&mut c).support_drag = Drag {
        constant: torque,
        viscous: 0.0,
        reference_speed: reference,
    };
    let inertia = c.race.inertia + frictionless().set.inner_inertia();
    let run = run(c, 9.0, 1e-6);
    let stop = SPEED * inertia / torque;
    assert!(stop > 7.0 && stop < 8.9, "{stop}");
    for row in run.record.rows().filter(|row| row.time < stop - 1e-3) {
        let expected = SPEED * (1.0 - row.time / stop);
        assert!((row.state[SHAFT.spin()] - expected).abs() < 1e-6 * SPEED);
    }
    // at rest it stays, as near as the tolerance looks: 1e-6 of 150 rad/s
    assert!(
        run.end()[SHAFT.spin()].abs() < 1.5e-4,
        "{}",
        run.end()[SHAFT.spin()]
    );
    assert_eq!(run.end()[FLYWHEEL.spin()], 0.0);
    // and its drag took all
    let heat = run.heat(model::system::rig::layout::SUPPORT_HEAT);
    assert!((heat / (0.5 * inertia * SPEED * SPEED) - 1.0).abs() < 1e-6);
}

#[test]
fn a_viscous_drag_slows_by_an_exponential_with_the_flywheel_locked_to_the_shaft() {
    let mut c = without_drag(concentric(
        BearingConstants::Rolling(frictionless()),
        Program::coast_down(SPEED, Some(1.0)),
    ));
    clutch(&mut c).flywheel.inertia = 1e-3;
    clutch(&mut c).flywheel.belt_drag.viscous = 1e-3;
    let inertia = 1e-3 + c.race.inertia + frictionless().set.inner_inertia();
    let run = run(c, 2.0, 1e-8);
    let expected = SPEED * (-2.0 * 1e-3 / inertia).exp();
    assert!((run.end()[SHAFT.spin()] / expected - 1.0).abs() < 1e-6);
    assert_eq!(run.record.rig().clutch.len(), 1);
}

#[test]
fn balls_with_ample_grip_equal_the_rolling_bearing() {
    let mut bearing = balls();
    bearing.ball.pocket_friction = 0.0;
    bearing.ball.pocket_gap = 1e-5;
    bearing.traction = Traction::Tanh(TanhTraction {
        maximum: 0.3,
        inverse_reference_speed: 1.0 / 0.02,
    });
    let rolling = model::bearing::RollingConstants::of(&bearing);
    let program = || {
        let engagement = Engagement {
            rate: 10.0,
            largest: 3.0,
        };
        Program::spin_up(SPEED, 0.002, engagement, false)
    };
    let [a, b] = [
        BearingConstants::Planar(bearing),
        BearingConstants::Rolling(rolling),
    ]
    .map(|bearing| {
        let run = run(concentric(bearing, program()), 0.08, 1e-5);
        let energy = run.machine.outer_race_energy(&run.start, run.end());
        let lock = run.record.rig().locked_at().expect("locks");
        [
            lock,
            run.record.rig().acceleration.value,
            energy.dissipated,
            energy.path,
        ]
    });
    for (a, b) in a.iter().zip(b) {
        // creep of a tanh law at its grip, pockets
        assert!((a / b - 1.0).abs() < 5e-3, "{a} {b}");
    }
}

#[test]
fn a_ramp_is_held() {
    for bearing in fidelities() {
        let c = concentric(bearing, Program::ramp_and_hold(SPEED, 1500.0, 5.0));
        let mut c = c;
        clutch(&mut c).motor.torque_limit = 100.0;
        clutch(&mut c).motor.gain = 50.0;
        let run = run(c, 0.15, 1e-5);
        assert_eq!(
            run.record.rig().clutch.len(),
            1,
            "{:?}",
            run.record.rig().clutch
        );
        let at = |time: f64| {
            let row = run
                .record
                .rows()
                .find(|row| row.time >= time)
                .expect("rows");
            (row.state[SHAFT.spin()], row.probe[ACCELERATION])
        };
        // the motor follows with a lag of I/gain = 1 ms
        let (speed, acceleration) = at(0.05);
        assert!((acceleration / 1500.0 - 1.0).abs() < 1e-2, "{acceleration}");
        assert!((speed - 1500.0 * 0.05).abs() < 3.0, "{speed}");
        let (speed, acceleration) = at(0.145);
        assert!((speed / SPEED - 1.0).abs() < 1e-3 && acceleration.abs() < 1.0);
        let (_, probe) = run
            .machine
            .inspect_in(&run.record.rig().mode, 0.15, run.end());
        assert!(probe[CAGE_SLIP].abs() < 0.01);
    }
}

#[test]
fn a_test_is_repeated_after_rest() {
    let engagement = Engagement {
        rate: 50.0,
        largest: 3.0,
    };
    let mut program = Program::spin_up(SPEED, 0.01, engagement, true);
    program.actions.extend([
        (0.11, Action::Disengage),
        (1.31, Action::Engage(engagement)),
    ]);
    let run = run(
        concentric(BearingConstants::Rolling(rolls()), program),
        1.5,
        1e-6,
    );
    let locks: Vec<f64> = run.record.rig().locks().collect();
    assert_eq!(locks.len(), 2, "{:?}", run.record.rig().clutch);
    let opened = (run.record.rig().clutch.iter().rev())
        .find(|event| event.clutch == Clutch::Open)
        .expect("opens");
    assert!((opened.time - 0.11).abs() < 1e-12);
    let before = run
        .record
        .rows()
        .rfind(|row| row.time < 1.31)
        .expect("rows");
    assert!(
        before.state[SHAFT.spin()].abs() < 0.1,
        "{}",
        before.state[SHAFT.spin()]
    );
    // the second is as the first
    let first = locks[0] - 0.01;
    let second = locks[1] - 1.31;
    assert!((second / first - 1.0).abs() < 1e-2, "{first} {second}");
}

#[test]
fn a_motor_brings_the_flywheel_to_speed_first() {
    let engagement = Engagement {
        rate: 50.0,
        largest: 3.0,
    };
    let to_speed = Action::MotorTo {
        speed: SPEED,
        rate: 50.0,
    };
    let program = Program {
        start: Start::REST,
        actions: vec![
            (0.0, to_speed),
            (3.5, Action::MotorOff),
            (3.5, Action::Engage(engagement)),
        ],
    };
    let mut c = concentric(BearingConstants::Rolling(rolls()), program);
    if let BearingConstants::Rolling(bearing) = &mut c.bearing {
        bearing.moment = SteadyMoment::None;
    }
    let run = run(c, 4.0, 1e-6);
    assert!(
        run.record
            .rig()
            .locked_at()
            .is_some_and(|time| (3.5..3.6).contains(&time))
    );
    let row = run.record.rows().rfind(|row| row.time < 3.5).expect("rows");
    // the gain of 0.5 N m s/rad leaves what the drag asks for: 0.13 rad/s
    assert!((row.state[FLYWHEEL.spin()] - SPEED).abs() < 0.2);
    assert_eq!(row.state[SHAFT.spin()], 0.0);
    assert!(run.energy_residual().abs() < 1e-6);
}
