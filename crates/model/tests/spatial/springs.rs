//! Pairs pressed by a spring: its limits, its equilibrium, and what changes its force.

use super::statics::{ALPHA, B, REST, axial, row, static_row};
use model::spatial::ball::SpatialBall;
use model::spatial::statics::ball::Running;
use model::spatial::statics::{BallEquilibrium, RaceControl, RingLoad, StaticRow, StaticRows};
use model::spatial::{PreloadSpring, preload_at_rest};
use physics::groove::pure_axial_load;
use physics::load_zone::joint_stiffness;

/// A pair back to back under a preload of its own, N, and the spring that keeps it.
fn on_spring(stiffness: f64) -> (Vec<StaticRow>, PreloadSpring<f64>) {
    let row = row(0.07);
    let joint = joint_stiffness(row.ball.inner.stiffness, row.ball.outer.stiffness);
    let [preload, half] = pure_axial_load(14, joint, B, ALPHA, ALPHA + 0.03);
    let pair = [1.0, -1.0].map(|sigma: f64| {
        let mut own = static_row(&row);
        let b = 0.5 * sigma * B * ALPHA.sin();
        own.ball.inner.place = -sigma * 6e-3 + b + sigma * half;
        own.ball.outer.place = -sigma * 6e-3 - b;
        own
    });
    let spring = PreloadSpring {
        side: -1.0,
        preload,
        stiffness,
        travel: f64::INFINITY,
        stop_stiffness: 2e8,
        stop_damping: 0.0,
        mass: 0.0,
    };
    (pair.to_vec(), spring)
}

/// Thrust of a row on the inner ring, N.
fn thrust(balls: &[BallEquilibrium]) -> f64 {
    balls
        .iter()
        .map(|ball| ball.loads[0] * ball.axial_share)
        .sum()
}

const AT_SPEED: Running = Running {
    speed: 1000.0,
    control: RaceControl::Outer,
};

#[test]
fn a_spring_is_a_distance_where_it_is_stiff_and_a_force_where_it_is_soft() {
    let (rows, spring) = on_spring(1e22);
    let loads = [[0.0, 0.0, 150.0], [80.0, 20.0, -60.0], [0.0, 0.0, -900.0]];
    for force in loads {
        let load = RingLoad {
            force,
            moment: [0.2, -0.1],
        };
        for running in [REST, AT_SPEED] {
            let rigid = StaticRows::from(rows.clone())
                .settle(&load, &running)
                .unwrap();
            let stiff = StaticRows {
                rows: rows.clone(),
                spring: Some(spring),
            };
            let stiff = stiff.settle(&load, &running).unwrap();
            let [a, b] = [&rigid, &stiff].map(|own| own.displacement.to_array());
            let [k_a, k_b] = [&rigid, &stiff].map(|own| own.stiffness);
            let size = |of: &[f64]| of.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            for k in 0..5 {
                let part = if k < 3 { &a[..3] } else { &a[3..] };
                assert!(
                    (a[k] - b[k]).abs() < 1e-9 * size(part),
                    "{force:?} {a:?} {b:?}"
                );
                for j in 0..5 {
                    let scale = (k_a[k][k] * k_a[j][j]).abs().sqrt();
                    assert!(
                        (k_a[k][j] - k_b[k][j]).abs() < 1e-8 * scale,
                        "{force:?} {k} {j}"
                    );
                }
            }
        }
    }
    let (rows, spring) = on_spring(1e-3);
    let preload = spring.preload;
    let pair = StaticRows {
        rows,
        spring: Some(spring),
    };
    for (load, running) in [
        (150.0, REST),
        (600.0, REST),
        (-0.9 * preload, REST),
        (300.0, AT_SPEED),
    ] {
        let found = pair.settle(&axial(load), &running).unwrap();
        let [fixed, sliding] = [0, 1].map(|row| thrust(&found.rows[row]));
        assert!((sliding / preload + 1.0).abs() < 1e-9, "{load}: {sliding}");
        assert!(
            (fixed / (load + preload) - 1.0).abs() < 1e-9,
            "{load}: {fixed}"
        );
        // nothing but the row that stands is stiff along the axis
        let alone = StaticRows::from(vec![pair.rows[0]]);
        let alone = alone.at(found.displacement, &running).unwrap();
        assert!((found.stiffness[2][2] / alone.stiffness[2][2] - 1.0).abs() < 1e-9);
        // across the axis both rows are
        assert!(found.stiffness[0][0] > 1.3 * alone.stiffness[0][0]);
    }
}

#[test]
fn a_pair_on_a_spring_yields_as_its_rows_and_the_spring_say() {
    let (rows, spring) = on_spring(1e7);
    let pair = StaticRows {
        rows: rows.clone(),
        spring: Some(spring),
    };
    let load = RingLoad {
        force: [60.0, -20.0, 90.0],
        moment: [0.2, -0.1],
    };
    // stiffness is the slope of the reaction, the ring on the spring following
    let found = pair.settle(&load, &AT_SPEED).unwrap();
    for (k, step) in [2e-9, 2e-9, 2e-9, 2e-7, 2e-7].into_iter().enumerate() {
        let moved = |by: f64| {
            let mut at = found.displacement;
            if k < 3 {
                at.shift[k] += by
            } else {
                at.tilt[k - 3] += by
            }
            pair.at(at, &AT_SPEED).unwrap().reaction
        };
        let (after, before) = (moved(step), moved(-step));
        for i in 0..5 {
            let slope = -(after[i] - before[i]) / (2.0 * step);
            let size = (found.stiffness[i][i] * found.stiffness[k][k]).sqrt();
            assert!(
                (slope - found.stiffness[i][k]).abs() < 1e-4 * size,
                "{i} {k}"
            );
        }
    }
    // against the spring, once the row that stands is free: row and spring one behind the other
    let preload = spring.preload;
    let pressed = pair.settle(&axial(-3.0 * preload), &REST).unwrap();
    assert_eq!(thrust(&pressed.rows[0]), 0.0);
    assert!((spring.force(pressed.slid) / (3.0 * preload) - 1.0).abs() < 1e-9);
    let mut beside = pressed.displacement;
    beside.shift[2] -= pressed.slid;
    let row = StaticRows::from(vec![rows[1]]).at(beside, &REST).unwrap();
    let series = 1.0 / (1.0 / 1e7 + 1.0 / row.stiffness[2][2]);
    assert!((pressed.stiffness[2][2] / series - 1.0).abs() < 1e-9);
    // where it is solid the stop is beside it
    let mut solid = pair.clone();
    solid.spring.as_mut().unwrap().travel = 20e-6;
    let stopped = solid.settle(&axial(-3.0 * preload), &REST).unwrap();
    let beyond = -stopped.slid - 20e-6;
    assert!(beyond > 0.0 && beyond < 5e-6, "{beyond}");
    let force = preload - 1e7 * stopped.slid + 2e8 * beyond;
    assert!((force / (3.0 * preload) - 1.0).abs() < 1e-9);
    // thrust on the row that stands frees the spring of a stiff one
    let mut free = pair;
    free.spring.as_mut().unwrap().stiffness = 1e8;
    let freed = free.settle(&axial(8.0 * preload), &REST).unwrap();
    assert_eq!(thrust(&freed.rows[1]), 0.0);
    assert!((thrust(&freed.rows[0]) / (8.0 * preload) - 1.0).abs() < 1e-9);
}

#[test]
fn what_closes_a_pair_changes_the_force_of_its_spring_alone() {
    let ball = row(0.07).ball;
    for stiffness in [1e4, 1e6, 1e8, 1e20] {
        let (rows, spring) = on_spring(stiffness);
        let preload = |closer: f64, spring: Option<&PreloadSpring<f64>>| {
            let of = |row: &StaticRow| {
                let mut own = SpatialBall {
                    inner: row.ball.inner,
                    outer: row.ball.outer,
                    ..ball
                };
                own.inner.place += 0.5 * closer * (own.inner.place - own.outer.place).signum();
                (row.balls, own)
            };
            preload_at_rest(&rows.iter().map(of).collect::<Vec<_>>(), spring)
        };
        assert!((preload(0.0, Some(&spring)) / spring.preload - 1.0).abs() < 1e-9);
        let step = 1e-8;
        let slope = |spring| (preload(step, spring) - preload(-step, spring)) / (2.0 * step);
        let (rigid, sprung) = (slope(None), slope(Some(&spring)));
        let expected = 1.0 / (1.0 / stiffness + 1.0 / rigid);
        assert!(
            (sprung / expected - 1.0).abs() < 1e-4,
            "{stiffness} {sprung} {expected}"
        );
    }
}
