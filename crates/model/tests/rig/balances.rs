//! What closes: energy, angular momentum, heats, symmetry.

use super::bench::{
    Finished, LOAD, SPEED, balls, clutch, concentric, fidelities, housing, rig, run,
};
use crate::machines::{settings, vec2};
use model::bearing::{BearingConstants, LubricantConstants};
use model::system::machine::RotorMachine;
use model::system::machine::record::Record;
use model::system::machine::simulate::{Runs, Shape, simulate_on};
use model::system::rig::layout::{
    BEARING_HEAT, HOUSING, INNER_MOMENT, MOMENTUM_RATE, OUTER_MOMENT, SHAFT, TEMPERATURE,
};
use model::system::rig::{Engagement, Program, RigConstants};
use number::Level;
use physics::lubricant_state::FilmHeating;
use solve::{Steps, Stop};
use std::sync::atomic::AtomicBool;

/// Locks after some 30 ms.
fn quick() -> Program {
    let engagement = Engagement {
        rate: 50.0,
        largest: 3.0,
    };
    Program::spin_up(SPEED, 0.005, engagement, true)
}

fn closes(run: &Finished, name: &str) {
    let energy = run.energy_residual();
    assert!(energy.abs() < 1e-6, "{name}: {energy}");
    for residual in run.momentum_residuals() {
        // 1e-8 is promised; a moment of the weight left out would show above 1e-10 only
        assert!(residual.abs() < 1e-10, "{name}: {residual}");
    }
    for (k, kind) in run.machine.layout().heats().iter().enumerate() {
        // a spin-up dissipates joules; rounding of a clipped contact may leave less than nothing
        assert!(run.heat(k) >= -1e-12, "{name}: {kind:?} {}", run.heat(k));
    }
}

#[test]
fn energy_and_angular_momentum_close() {
    for (bearing, fidelity) in fidelities().into_iter().zip(["rolling", "planar"]) {
        for (make, place) in [
            (
                rig as fn(BearingConstants, Program) -> RigConstants,
                "moving",
            ),
            (concentric, "concentric"),
        ] {
            let run = run(make(bearing.clone(), quick()), 0.08, 1e-5);
            assert!(run.record.rig().locked_at().is_some());
            closes(&run, &format!("{fidelity} {place}"));
        }
    }
}

#[test]
fn moments_on_the_races_differ_by_what_balls_and_cage_gain() {
    for bearing in fidelities() {
        let run = run(concentric(bearing, quick()), 0.05, 1e-5);
        let mut seen = 0;
        for row in run.record.rows() {
            let difference = row.probe[INNER_MOMENT] - row.probe[OUTER_MOMENT];
            let gain = row.probe[MOMENTUM_RATE];
            // rounding of contact forces of 30 N on 2 cm
            assert!((difference - gain).abs() < 1e-10, "{difference} {gain}");
            seen += usize::from(gain.abs() > 1e-3);
        }
        assert!(seen > 20, "balls and cage do gain");
    }
}

#[test]
fn the_exact_form_by_the_outer_race_is_the_true_loss() {
    for bearing in fidelities() {
        for held in [true, false] {
            let mut c = rig(bearing.clone(), quick());
            housing(&mut c).centre_held = held;
            let run = run(c, 0.08, 1e-5);
            let energy = run.machine.outer_race_energy(&run.start, run.end());
            // quadrature with pocket impacts
            let off = energy.exact / energy.dissipated - 1.0;
            assert!(off.abs() < 1e-4, "{energy:?}");
            assert!(
                energy.printed / energy.dissipated - 1.0 > 0.05,
                "{energy:?}"
            );
        }
    }
}

#[test]
fn the_bearing_warms_by_its_own_heat() {
    for bearing in fidelities() {
        let mut c = concentric(bearing, quick());
        housing(&mut c).heat.conductance = 0.0;
        let run = run(c, 0.08, 1e-5);
        let heat: f64 = (0..model::bearing::HEATS.len()).map(|k| run.heat(k)).sum();
        let stored = 60.0 * run.end()[TEMPERATURE];
        // the same sum, once as a state and once as many
        assert!((stored / heat - 1.0).abs() < 1e-9, "{stored} {heat}");
        assert!(heat > 0.0);
        let last = run.record.rows().next_back().expect("rows");
        assert!(last.probe[BEARING_HEAT] > 0.0);
    }
}

#[test]
fn heat_that_films_keep_reaches_the_bearing_when_they_give_it() {
    let films = FilmHeating {
        heat_capacity: 2.0,
        conductance: 20.0,
        drag_coefficient: 0.03,
        traction_coefficient: 0.02,
    };
    for bearing in fidelities() {
        let mut c = concentric(bearing, quick());
        housing(&mut c).heat.conductance = 30.0;
        let lubricant = Some(LubricantConstants {
            grease: None,
            films: Some(films),
            build_up: 1.0,
            breakdown: 0.0,
        });
        match &mut c.bearing {
            BearingConstants::Spatial(_) => panic!("the bearing lies in the plane"),
            BearingConstants::Rolling(bearing) => bearing.lubricant = lubricant,
            BearingConstants::Planar(bearing) => bearing.lubricant = lubricant,
        }
        let run = run(c, 0.3, 1e-6);
        let heat: f64 = (0..model::bearing::HEATS.len()).map(|k| run.heat(k)).sum();
        let in_films = |state: &[f64]| {
            let own = &state[run.machine.layout().bearings[0].own()];
            let at = run.machine.constants.bearings[0].bearing.lubricant_at(own);
            films.heat_capacity * at.expect("it has a state").film_temperature_rise
        };
        let rows: Vec<(f64, f64)> = (run.record.rows())
            .map(|row| (row.time, row.state[TEMPERATURE]))
            .collect();
        let given_off: f64 = (rows.windows(2))
            .map(|pair| 0.5 * (pair[1].1 + pair[0].1) * (pair[1].0 - pair[0].0) * 30.0)
            .sum();
        let kept = in_films(run.end());
        let stored = 60.0 * run.end()[TEMPERATURE];
        // each part counts: the films were given twice what they keep before
        assert!(
            kept > 0.02 * heat && given_off > 0.02 * heat,
            "{kept} {given_off} {heat}"
        );
        // trapezoids of a hundredth of the run
        let off = (stored + kept + given_off) / heat - 1.0;
        assert!(
            off.abs() < 1e-4,
            "{off}: {stored} {kept} {given_off} {heat}"
        );
    }
}

/// Turns load, weight and balls of a rig by an angle.
fn turned(constants: &RigConstants, angle: f64) -> RigConstants {
    let (sine, cosine) = angle.sin_cos();
    let turn = |v: number::Vec2<f64>| vec2(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y);
    let mut c = constants.clone();
    c.load_direction = turn(c.load_direction);
    c.gravity = turn(c.gravity);
    match &mut c.bearing {
        BearingConstants::Spatial(_) => panic!("the bearing lies in the plane"),
        BearingConstants::Planar(bearing) => {
            bearing.ball.gravity = turn(bearing.ball.gravity);
            bearing.first_ball_angle += angle;
        }
        BearingConstants::Rolling(bearing) => bearing.first_ball_angle += angle,
    }
    c
}

#[test]
fn turning_the_stator_turns_the_answer() {
    for bearing in fidelities() {
        let c = rig(bearing, quick());
        let angle = 0.7_f64;
        // before the pockets make the balls' paths sensitive to rounding
        let (one, other) = (
            run(c.clone(), 0.01, 1e-6),
            run(turned(&c, angle), 0.01, 1e-6),
        );
        let (a, b) = (one.end(), other.end());
        let near = |a: f64, b: f64, size: f64| assert!((a - b).abs() < 1e-6 * size, "{a} {b}");
        assert!(a[SHAFT.spin()] > 1.0);
        near(a[SHAFT.spin()], b[SHAFT.spin()], SPEED);
        let (sine, cosine) = angle.sin_cos();
        let size = a[HOUSING.centre()[0]].hypot(a[HOUSING.centre()[1]]);
        near(
            cosine * a[HOUSING.centre()[0]] - sine * a[HOUSING.centre()[1]],
            b[HOUSING.centre()[0]],
            1e3 * size,
        );
        near(
            sine * a[HOUSING.centre()[0]] + cosine * a[HOUSING.centre()[1]],
            b[HOUSING.centre()[1]],
            1e3 * size,
        );
        let layout = one.machine.layout();
        near(a[layout.work(1)], b[layout.work(1)], a[layout.work(0)]);
    }
}

#[test]
fn the_weight_hangs_on_the_balls() {
    for bearing in fidelities() {
        let turning = Program::coast_down(SPEED, None);
        let run = run(rig(bearing, turning), 0.02, 1e-5);
        // the mean load of the last half is the weight; what rings at the start is the centrifugal force of the balls
        let loads: Vec<f64> = (run.record.rows())
            .filter(|row| row.time > 0.01)
            .map(|row| row.probe[model::system::rig::layout::INNER_FORCE])
            .collect();
        let mean = loads.iter().sum::<f64>() / loads.len() as f64;
        // cage and, where they roll, balls: up to 0.2 N more
        assert!((mean / LOAD - 1.0).abs() < 0.02, "{mean}");
        assert!(run.end()[HOUSING.centre()[1]] < 0.0, "it hangs");
    }
}

#[test]
fn at_one_speed_both_moments_are_that_of_the_law() {
    for bearing in fidelities() {
        let mut c = rig(bearing, Program::coast_down(SPEED, Some(5.0)));
        clutch(&mut c).flywheel.inertia = 1e3;
        let run = run(c, 0.4, 1e-4);
        let means = run.record.rig().turns.late_means(SPEED).expect("turns");
        // what creep and pockets take besides is in a measured law, not in this one
        assert!(
            (means.inner_moment / means.outer_moment - 1.0).abs() < 5e-3,
            "{means:?}"
        );
        assert!(
            (means.outer_moment / means.steady_moment - 1.0).abs() < 0.05,
            "{means:?}"
        );
    }
}

#[test]
fn a_run_gives_the_same_bits_on_every_level_of_the_vector_unit() {
    let c = rig(BearingConstants::Planar(balls()), quick());
    let machine = RotorMachine::on_rig(c).expect("the rig can be built");
    let one = |level: Level| {
        let mut record = Record::new(&machine, 0.02, 1e-3, true);
        let runs = Runs {
            machines: &[&machine],
            starts: &[machine.start()],
            settings: settings(0.02, 1e-4),
            steps: Steps::Explicit,
            interrupt: &AtomicBool::new(false),
        };
        let run = simulate_on(level, Shape::Balls, runs, &mut [&mut record]).remove(0);
        assert_eq!(run.stop, Stop::Finished);
        record.finish(&machine, run.time, &run.state);
        let rows = record
            .rows()
            .flat_map(|row| [row.state, row.probe].concat());
        let bits: Vec<u64> = rows.map(f64::to_bits).collect();
        (bits, run.work, record.rig().clutch.clone())
    };
    let plain = one(Level::Baseline);
    for level in Level::available().chain([Level::Baseline]) {
        assert!(one(level) == plain, "{level:?}");
    }
}
