//! Spin-ups with the balls computed one by one.

use super::rig::{BEARING, Run, free_bearing, greased_bearing, machine, rolling, run};
use crate::machines::{separations, vec2};
use model::bearing::{BearingConstants, PlanarConstants, Separation};
use model::system::machine::RotorMachine;
use model::system::machine::record::Record;
use model::system::rig::layout::{CAGE_SLIP, DETAIL, INNER, INNER_MOMENT, OUTER_MOMENT};
use model::system::rig::{Drive, RigConstants, SlidingRotor};
use model::table::Table;
use physics::traction::{TanhTraction, Traction};

fn planar_machine(bearing: PlanarConstants, drive: Drive) -> RigConstants {
    machine(BearingConstants::Planar(bearing), drive, 1000.0)
}

/// A race stepped to 1000 rad/s while the balls are at rest.
fn skidding() -> RigConstants {
    planar_machine(greased_bearing(), Drive::step(1000.0))
}

fn rotor(friction: f64) -> Drive {
    Drive::SlidingRotor(SlidingRotor {
        bore_radius: 12.5e-3,
        friction,
        inverse_reference_speed: 20.0,
        speed: 1000.0,
        polar_inertia: 0.01,
        spin_held: true,
    })
}

fn ends_rolling(run: &Run) -> bool {
    let (_, probe) = run.machine.inspect_at(1.0, &run.end);
    probe[CAGE_SLIP].abs() < 0.01
}

#[test]
fn after_a_step_the_exact_energy_form_is_the_true_loss_and_the_printed_one_is_not() {
    let run = run(skidding(), 0.03, 1e-5);
    assert!(ends_rolling(&run));
    assert_eq!(
        run.record.bearings[0].inner_race_time_to_95_percent(),
        Some(0.0)
    );
    let cage = run.record.bearings[0].cage_time_to_95_percent();
    assert!(
        cage.is_some_and(|time| (1e-3..0.02).contains(&time)),
        "{cage:?}"
    );
    let energy = run.machine.outer_race_energy(&run.start, &run.end);
    let error = |value: f64| (value / energy.dissipated - 1.0).abs();
    // quadrature of a skid with pocket impacts; measured below 1e-4
    assert!(error(energy.exact) < 2e-3, "{energy:?}");
    assert!(error(energy.printed) > 0.05, "{energy:?}");
    assert!(error(energy.corrected) > 0.05, "{energy:?}");
    // the race had its speed before the balls moved
    assert!(
        (energy.path / energy.path_behind_the_race - 1.0).abs() < 0.02,
        "{energy:?}"
    );
    assert!(energy.path < energy.largest_path, "{energy:?}");
    let residual = run.machine.balance(&run.start, &run.end).energy_residual();
    assert!(residual.abs() < 1e-4 * energy.dissipated, "{residual}");
}

#[test]
fn on_the_concentric_rig_the_moments_differ_by_what_balls_and_cage_gain() {
    moments_differ_by_what_balls_and_cage_gain(greased_bearing());
    for separation in separations() {
        let mut bearing = greased_bearing();
        if let Separation::Neighbours(_) = separation {
            bearing.balls = 17;
        }
        bearing.separation = separation;
        moments_differ_by_what_balls_and_cage_gain(bearing);
    }
}

fn moments_differ_by_what_balls_and_cage_gain(bearing: PlanarConstants) {
    let run = run(planar_machine(bearing, Drive::step(1000.0)), 0.02, 1e-6);
    let energy = run.machine.outer_race_energy(&run.start, &run.end);
    let off = energy.exact / energy.dissipated - 1.0;
    assert!(off.abs() < 1e-4, "{energy:?}");
    let momentum = |row: &model::system::sampling::Row| {
        run.machine.bearing_content(0, row.state).angular_momentum
    };
    // t_I - t_O = dL/dt at instants, dL/dt by the rates of the states
    for row in run.record.rows().step_by(7) {
        let (rate, probe) = run.machine.inspect_at(row.time, row.state);
        let layout = run.machine.layout();
        let by_rates = rate[layout.work(2)] / row.state[INNER.spin()];
        let by_moments = probe[INNER_MOMENT] - probe[OUTER_MOMENT];
        // rounding of contact forces of 30 N on 2 cm
        assert!(
            (by_rates - by_moments).abs() < 1e-10,
            "{by_rates} {by_moments}"
        );
        assert!(rate[layout.work(3)].abs() < 1e-9, "nothing else acts");
    }
    // and over the whole run: L is the integral
    let first = run
        .record
        .rows()
        .next()
        .map(|row| momentum(&row))
        .expect("rows");
    let gained = momentum(&run.record.rows().last().expect("rows")) - first;
    let layout = run.machine.layout();
    let works = run.end[layout.work(0)] - run.end[layout.work(1)];
    assert!(
        (works / (1000.0 * gained) - 1.0).abs() < 1e-4,
        "{works} {gained}"
    );
    let lost = run
        .machine
        .balance(&run.start, &run.end)
        .angular_momentum_residual();
    assert!(lost.abs() < 1e-4 * gained, "{lost}");
}

#[test]
fn without_friction_nothing_is_spun_up() {
    let smooth = run(planar_machine(free_bearing(), rotor(0.0)), 5e-3, 1e-5);
    // balls a rounding off their rest ring at 41 kHz
    assert!(smooth.end[INNER.spin()].abs() < 1e-12);
    let heat = smooth.machine.flows(&smooth.end).heat;
    assert!(heat < 1e-12, "{heat}");
    // a race that turns, but cannot grip its balls
    let mut bearing = free_bearing();
    bearing.traction = Traction::Tanh(TanhTraction {
        maximum: 0.0,
        inverse_reference_speed: 10.0,
    });
    let slippery = run(planar_machine(bearing, Drive::step(1000.0)), 5e-3, 1e-5);
    assert_eq!(slippery.end[BEARING + 1], 0.0, "the cage stays");
    assert_eq!(slippery.end[slippery.machine.layout().work(0)], 0.0);
}

#[test]
fn a_mirrored_machine_gives_a_mirrored_answer() {
    let one = |sign: f64| {
        let mut bearing = greased_bearing();
        bearing.ball.gravity = vec2(0.0, -9.81);
        let mut c = planar_machine(bearing, Drive::ramp(1e5, sign * 1000.0));
        c.race.centre_held = false;
        c.load = Table::constant(150.0);
        let machine = RotorMachine::on_rig(c).expect("can be built");
        let start = machine.start();
        // equal steps: step control looks at components
        let settings = crate::machines::equal_steps(4e-3, 5e-7);
        let mut record = Record::new(&machine, 4e-3, 4e-3, false);
        let end = super::rig::observe(&machine, &start, &settings, &mut record).state;
        let layout = machine.layout().clone();
        [
            // places by the size of the displacement, a rounding of which rings at 41 kHz
            1.0 + sign * end[INNER.centre()[0]] * 1e5,
            1.0 + end[INNER.centre()[1]] * 1e5,
            sign * end[INNER.spin()],
            sign * end[BEARING + 1],
            end[layout.heat(7)],
            end[layout.heat(3)],
            end[layout.work(1)],
        ]
    };
    let (a, b) = (one(1.0), one(-1.0));
    for (a, b) in a.into_iter().zip(b) {
        // rounding of 8000 steps, as in the drop
        assert!((a - b).abs() <= 1e-9 * a.abs(), "{a} {b}");
    }
    assert!(a[0] != 1.0 && a[3] > 1.0 && a[4] > 0.0);
}

#[test]
fn balls_with_ample_grip_equal_the_rolling_bearing() {
    let mut bearing = free_bearing();
    let ball = &mut bearing.ball;
    ball.outer_track = ball.inner_track + 2.0 * ball.radius - 4e-6;
    ball.pocket_friction = 0.0;
    ball.pocket_gap = 1e-5;
    bearing.traction = Traction::Tanh(TanhTraction {
        maximum: 0.3,
        inverse_reference_speed: 1.0 / 0.02,
    });
    let time = |bearing: BearingConstants| {
        let mut c = machine(bearing, rotor(0.2), 1000.0);
        c.load = Table::constant(80.0);
        run(c, 0.04, 1e-5).record.bearings[0]
            .inner_race_time_to_95_percent()
            .expect("comes to speed")
    };
    let (balls, rolls) = (
        time(BearingConstants::Planar(bearing)),
        time(BearingConstants::Rolling(rolling())),
    );
    assert!((balls / rolls - 1.0).abs() < 2e-3, "{balls} {rolls}");
    // without balls and cage the race would be there much sooner: they do take part
    assert!(rolls > 1.2 * 950.0 * 3.9e-6 / (12.5e-3 * 0.2 * 80.0));
}

#[test]
fn a_bearing_starts_in_balance_under_its_load() {
    for (interference, load) in [(2e-6, 300.0), (-10e-6, 300.0), (0.0, 1.0), (-10e-6, 0.0)] {
        let mut bearing = free_bearing();
        let ball = &mut bearing.ball;
        ball.outer_track = ball.inner_track + 2.0 * ball.radius - interference;
        let mut c = planar_machine(bearing, Drive::Torque(Table::constant(0.0)));
        c.race.centre_held = false;
        c.load_direction = vec2(0.6, -0.8);
        c.load = Table::constant(load);
        let machine = RotorMachine::on_rig(c).expect("can be built");
        let state = machine.start();
        let (rate, probe) = machine.inspect_at(0.0, &state);
        let force = 20.4e-3 * rate[INNER.velocity()[0]].hypot(rate[INNER.velocity()[1]]);
        // balls shared between contacts along the azimuth instead of the true normals: displacement over radius
        assert!(force < 2e-3 * load + 1e-9, "{interference} {load}: {force}");
        let loads = &probe[DETAIL..DETAIL + 10];
        let carrying = loads.iter().filter(|load| **load > 0.0).count();
        assert!(
            if load > 0.0 {
                carrying > 1
            } else {
                carrying == 0
            },
            "{loads:?}"
        );
    }
}

#[test]
fn a_loaded_race_free_to_move_closes_its_ledger() {
    let mut bearing = greased_bearing();
    bearing.ball.gravity = vec2(0.0, -9.81);
    let mut c = planar_machine(bearing, rotor(0.2));
    c.race.centre_held = false;
    c.gravity = vec2(0.0, -9.81);
    c.load = Table::through(vec![(0.0, 100.0), (5e-3, 300.0)]).expect("rises");
    let run = run(c, 0.02, 1e-6);
    assert!(run.end[INNER.spin()] > 900.0, "{}", run.end[INNER.spin()]);
    let energy = run.machine.outer_race_energy(&run.start, &run.end);
    let residual = run.machine.balance(&run.start, &run.end).energy_residual();
    assert!(residual.abs() < 1e-4 * energy.dissipated, "{residual}");
    let momentum = run
        .machine
        .balance(&run.start, &run.end)
        .angular_momentum_residual();
    let content = run.machine.content(&run.end).angular_momentum;
    assert!(momentum.abs() < 1e-4 * content, "{momentum} {content}");
    // the exact form, with the part of the race's motion
    assert!(
        (energy.exact / energy.dissipated - 1.0).abs() < 2e-3,
        "{energy:?}"
    );
}
