//! Equilibria: closed forms, and the steady dynamics that no hypothesis is needed for.

use super::closed_forms::run;
use super::setup::*;
use model::spatial::ball::{Expansion, SpatialBall};
use model::spatial::race::RaceGroove;
use model::spatial::rigid_body::RigidBody;
use model::spatial::statics::ball::Running;
use model::spatial::statics::steady::steady_row;
use model::spatial::statics::{RaceControl, RingLoad, StaticBall, StaticRow, StaticRows};
use model::spatial::{RowConstants, RowGeometry, preload_at_rest};
use number::Vec3;
use physics::contact_nodes::matched;
use physics::groove::{axis_over_root_approach, contact_surface_radius, pure_axial_load};
use physics::hertz::{BallRace, PointContact, Race};
use physics::load_zone::joint_stiffness;
use physics::materials::{BEARING_STEEL, ball_mass, contact_modulus};
use physics::traction::{TanhTraction, Traction};

pub const BALL: f64 = 6.35e-3;
pub const ALPHA: f64 = 24.0 * std::f64::consts::PI / 180.0;
pub const B: f64 = 0.04 * BALL;

/// 14 balls of 6.35 mm, groove curvature 0.52, 24°: the bearing of the reference's quasi-static files.
pub fn row(friction: f64) -> RowConstants {
    let inner = 14.825e-3;
    let outer_centre = inner + 0.52 * BALL - B * ALPHA.cos();
    let modulus = contact_modulus(BEARING_STEEL, BEARING_STEEL);
    let groove = |race: Race, centre_radius: f64, place: f64| {
        // the pitch diameter between the groove bottoms
        let contact = BallRace {
            ball_diameter: BALL,
            pitch_diameter: inner + outer_centre + 0.52 * BALL,
            groove_curvature: 0.52,
            contact_angle: ALPHA,
            race,
        };
        let contact = PointContact::new(contact.curvature(), modulus).unwrap();
        let own = RaceGroove {
            centre_radius,
            place,
            slack: 0.02 * BALL,
            stiffness: contact.stiffness,
            half_axis: axis_over_root_approach(&contact),
            half_curvature: 0.5 / contact_surface_radius(0.5 * BALL, 0.52 * BALL),
        };
        (own, contact.ellipticity)
    };
    let half = 0.5 * B * ALPHA.sin();
    let (inner, k_i) = groove(Race::Inner, inner + 0.52 * BALL, half);
    let (outer, k_o) = groove(Race::Outer, outer_centre, -half);
    let traction = Traction::Tanh(TanhTraction {
        maximum: friction,
        inverse_reference_speed: 10.0,
    });
    let mut row =
        bearing(SINGLE, traction, &matched(0.5 * (k_i + k_o)), Guide::Balls).rows[0].clone();
    row.balls = 14;
    row.ball.radius = 0.5 * BALL;
    row.ball.inner_growth = 0.0;
    row.ball.mass = ball_mass(BALL, 7850.0);
    (row.ball.inner, row.ball.outer) = (inner, outer);
    row
}

pub fn static_row(row: &RowConstants) -> StaticRow {
    StaticRow {
        balls: row.balls,
        first_azimuth: 0.0,
        ball: StaticBall {
            radius: row.ball.radius,
            mass: row.ball.mass,
            inner: row.ball.inner,
            outer: row.ball.outer,
        },
    }
}

pub const REST: Running = Running {
    speed: 0.0,
    control: RaceControl::Outer,
};

pub fn axial(force: f64) -> RingLoad {
    RingLoad {
        force: [0.0, 0.0, force],
        moment: [0.0; 2],
    }
}

#[test]
fn the_constants_are_those_of_the_reference() {
    let ball = row(0.07).ball;
    assert!((ball.inner.stiffness / 2.280_869_698_797_558_2e10 - 1.0).abs() < 1e-10);
    assert!((ball.outer.half_axis / 0.342_672_248_683_248_97 - 1.0).abs() < 1e-10);
}

#[test]
fn a_pure_axial_load_at_rest_has_the_closed_form() {
    let row = row(0.07);
    let rows = StaticRows::from(vec![static_row(&row)]);
    let stiffness = joint_stiffness(row.ball.inner.stiffness, row.ball.outer.stiffness);
    for angle in [ALPHA + 1e-3, ALPHA + 0.02, ALPHA + 0.1] {
        let [load, displacement] = pure_axial_load(14, stiffness, B, ALPHA, angle);
        let found = rows.settle(&axial(load), &REST).unwrap();
        assert!((found.displacement.shift[2] / displacement - 1.0).abs() < 1e-9);
        for ball in &found.rows[0] {
            assert!((ball.angles[0] - angle).abs() < 1e-9 && (ball.angles[1] - angle).abs() < 1e-9);
        }
    }
}

#[test]
fn the_preload_of_a_pair_has_the_closed_form() {
    let row = row(0.07);
    let stiffness = joint_stiffness(row.ball.inner.stiffness, row.ball.outer.stiffness);
    let load = |angle: f64| pure_axial_load(14, stiffness, B, ALPHA, angle);
    let angle = ALPHA + 0.03;
    let [preload, half] = load(angle);
    for sign in [1.0, -1.0] {
        let pair = [-1.0, 1.0].map(|side: f64| {
            let mut own = static_row(&row);
            let sigma = -side * sign;
            let b = 0.5 * sigma * B * ALPHA.sin();
            own.ball.inner.place = side * 6e-3 + b + sigma * half;
            own.ball.outer.place = side * 6e-3 - b;
            own
        });
        let found = StaticRows::from(pair.to_vec())
            .at(Default::default(), &REST)
            .unwrap();
        let thrust = |row: usize| {
            let balls = found.rows[row].iter();
            balls
                .map(|ball| ball.loads[0] * ball.angles[0].sin())
                .sum::<f64>()
        };
        assert!((thrust(0) * sign / preload - 1.0).abs() < 1e-9);
        assert!((thrust(1) * sign / preload + 1.0).abs() < 1e-9);
        // both rows side by side: twice the slope of one, by differences of the closed form
        let (before, after) = (load(angle - 1e-6), load(angle + 1e-6));
        let slope = (after[0] - before[0]) / (after[1] - before[1]);
        assert!((found.stiffness[2][2] / (2.0 * slope) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn stiffness_is_the_slope_of_the_reaction() {
    let row = row(0.07);
    let rows = StaticRows::from(vec![static_row(&row)]);
    let load = RingLoad {
        force: [200.0, 50.0, 300.0],
        moment: [0.3, -0.2],
    };
    let running = Running {
        speed: 2000.0,
        control: RaceControl::Half,
    };
    let found = rows.settle(&load, &running).unwrap();
    let steps = [2e-9, 2e-9, 2e-9, 2e-7, 2e-7];
    for (k, step) in steps.into_iter().enumerate() {
        let moved = |by: f64| {
            let mut at = found.displacement;
            if k < 3 {
                at.shift[k] += by
            } else {
                at.tilt[k - 3] += by
            }
            rows.at(at, &running).unwrap().reaction
        };
        let (after, before) = (moved(step), moved(-step));
        for i in 0..5 {
            let slope = -(after[i] - before[i]) / (2.0 * step);
            let size = (found.stiffness[i][i] * found.stiffness[k][k]).sqrt();
            assert!(
                (found.stiffness[i][k] - slope).abs() < 1e-5 * size,
                "{i} {k}"
            );
        }
    }
}

#[test]
fn equilibria_are_found_where_balls_can_take_their_gyroscopic_moment() {
    let row = row(0.07);
    let rows = StaticRows::from(vec![static_row(&row)]);
    let mut lost = 0;
    for axial in [5.0, 20.0, 60.0, 200.0] {
        for radial in [0.0, 20.0, 100.0, 300.0] {
            for speed in [0.0, 1000.0, 2000.0, 3000.0, 4000.0] {
                for control in [RaceControl::Half, RaceControl::Outer] {
                    let load = RingLoad {
                        force: [radial, 0.0, axial],
                        moment: [0.0; 2],
                    };
                    let found = rows.settle(&load, &Running { speed, control });
                    // a lightly held ball cannot: the moment vanishes with the inner contact, and there is none between
                    let held = axial >= 200.0 && radial <= 100.0;
                    let pure = control == RaceControl::Outer && radial == 0.0;
                    if speed == 0.0 || held || pure {
                        assert!(found.is_ok(), "{axial} {radial} {speed} {control:?}");
                    }
                    let Ok(found) = found else { continue };
                    let left = [found.reaction[0] + radial, found.reaction[2] + axial];
                    let balls = || found.rows[0].iter();
                    let largest = balls().fold(0.0_f64, |most, ball| most.max(ball.loads[1]));
                    assert!(
                        left.iter().all(|own| own.abs() < 1e-8 * largest),
                        "{left:?} of {largest}"
                    );
                    lost += balls()
                        .filter(|ball| ball.loads[0] == 0.0 && ball.loads[1] > 0.0)
                        .count();
                }
            }
        }
    }
    assert!(lost > 20, "{lost}");
}

#[test]
fn dynamics_at_rest_settle_on_the_equilibrium() {
    let row = row(0.07);
    let rows = StaticRows::from(vec![static_row(&row)]);
    let load = |share: f64| RingLoad {
        force: [share * 60.0, 0.0, share * 300.0],
        moment: [0.0, share * 0.4],
    };
    let (start, expected) = (
        rows.settle(&load(0.7), &REST).unwrap(),
        rows.settle(&load(1.0), &REST).unwrap(),
    );
    let mut machine = bearing(SINGLE, row.traction, &row.nodes, Guide::Tied);
    machine.rows[0] = RowConstants {
        cage: machine.rows[0].cage,
        ..row
    };
    machine.rows[0].ball.gravity = Vec3::zero();
    machine.gravity = Vec3::zero();
    let RingLoad { force, moment } = load(1.0);
    machine.inner.force = Vec3::new(force[0], force[1], force[2]);
    machine.inner.moment = Vec3::new(moment[0], moment[1], 0.0);
    (machine.inner.settling, machine.inner.tilt_settling) = (60.0, 6e-3);
    let mount = &mut machine.outer.mount;
    (mount.radial_stiffness, mount.axial_stiffness) = (1e8, 1e8);
    (mount.radial_damping, mount.axial_damping) = (4e3, 4e3);
    let mut state = vec![0.0; machine.states()];
    for body in 0..4 {
        state[machine.body(body) + 6] = 1.0;
    }
    let inner = machine.body(1);
    let from = start.displacement;
    state[inner..inner + 3].copy_from_slice(&from.shift);
    state[inner + 7..inner + 9].copy_from_slice(&from.tilt.map(|tilt| 0.5 * tilt));
    for (j, ball) in start.rows[0].iter().enumerate() {
        let values = [ball.place[0], 0.0, ball.azimuth, 0.0, ball.place[1]];
        for (k, value) in values.into_iter().enumerate() {
            state[ball_state(&machine, 0, j, k)] = value;
        }
    }
    run(&machine, &mut state, 0.012, 6000);
    let outer = machine.body(2);
    let axis = RigidBody::read(&state[inner..]).axis;
    let shift = [0, 1, 2].map(|k| state[inner + k] - state[outer + k]);
    let largest = shift.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    for (found, expected) in shift.iter().zip(expected.displacement.shift) {
        assert!(
            (found - expected).abs() < 1e-4 * largest,
            "{found} {expected}"
        );
    }
    let tilt = [-axis.y, axis.x];
    for (found, expected) in tilt.iter().zip(expected.displacement.tilt) {
        assert!(
            (found - expected).abs() < 1e-4 * tilt[1].abs(),
            "{found} {expected}"
        );
    }
}

/// Steady motions of the reference's solver: speed, load, friction; displacement µm, loads, cage over ring speed, spins, forces across, w_t.
const STEADY: [[f64; 12]; 5] = [
    [
        500.0, 300.0, 0.07, 7.8584, 49.040, 49.795, 0.42070, 112.1, 114.4, 0.086, 0.087, -0.8,
    ],
    [
        2000.0, 300.0, 0.07, 6.3772, 42.544, 54.657, 0.42260, 1276.3, 352.7, 0.776, 1.581, -16.3,
    ],
    [
        2000.0, 300.0, 0.02, 6.5807, 43.222, 55.677, 0.42750, 2139.5, -542.7, 0.492, 0.981, -69.0,
    ],
    [
        4000.0, 300.0, 0.07, -4.9678, 36.319, 92.283, 0.44660, 6437.5, 72.1, 0.601, 4.150, -27.0,
    ],
    [
        4000.0, 1000.0, 0.07, 13.6825, 130.513, 179.295, 0.42706, 3627.7, 340.9, 2.240, 6.613,
        -27.0,
    ],
];

#[test]
fn steady_dynamics_under_axial_load_meet_the_table() {
    for expected in STEADY {
        let [speed, load, friction, ..] = expected;
        let row = row(friction);
        for from in [RaceControl::Outer, RaceControl::Inner] {
            let found = steady_row(&row, load, speed, from).unwrap();
            let [inner, outer] = found.contacts.touch;
            let [f_i, f_o] = found.contacts.traction;
            let ours = [
                found.displacement * 1e6,
                inner.load.force,
                outer.load.force,
                found.ball.orbit_speed / speed,
                -inner.turning.z,
                -outer.turning.z,
                f_i.force.x.abs(),
                f_o.force.x.abs(),
                found.ball.spin.y,
            ];
            // 1e-4 of each value, or half of the last digit printed and its rounding
            let digits: [f64; 9] = [6e-5, 6e-4, 6e-4, 6e-6, 0.06, 0.06, 6e-4, 6e-4, 0.06];
            for (k, (ours, expected)) in ours.into_iter().zip(&expected[3..]).enumerate() {
                let allowed = digits[k].max(1e-4 * expected.abs());
                assert!(
                    (ours - expected).abs() < allowed,
                    "{speed} {load} column {k}: {ours} {expected}"
                );
            }
        }
    }
}

#[test]
fn rings_that_heat_change_the_preload_as_their_geometry_says() {
    let row = row(0.07);
    let [free, half] = [ALPHA, 4e-6];
    for sign in [1.0, -1.0] {
        // the lower row of a pair that is closed by 8 µm: back to back (1) and face to face (-1)
        let mut ball = row.ball;
        let b = 0.5 * sign * B * free.sin();
        ball.inner.place = -6e-3 + b + sign * half;
        ball.outer.place = -6e-3 - b;
        let thrust = |strains: [f64; 3], seats: [f64; 2]| {
            ball.expanded(&Expansion { strains, seats })
                .thrust_at_rest(0.0)
                .abs()
        };
        let mounted = thrust([0.0; 3], [0.0; 2]);
        let [radial, axial] = ball.groove_distance();
        let distance = radial.hypot(axial);
        let approach = distance - ball.inner.slack - ball.outer.slack;
        // bodies of one strain stay alike: K stays, so all lengths change the thrust as δ^1.5
        let strain = 1e-3;
        let alike = thrust([strain; 3], [0.0; 2]) / mounted;
        assert!(
            (alike / (1.0 + strain).powf(1.5) - 1.0).abs() < 1e-9,
            "{alike}"
        );
        // T = K δ^1.5 sin α of a small strain of the inner ring: δ and α by the places of its groove
        let (sine, cosine) = (axial / distance, -radial / distance);
        let small = 1e-8;
        let moved = [-ball.inner.centre_radius, -ball.inner.place];
        let longer = -cosine * moved[0] + sine * moved[1];
        let groove = ball.inner.slack + ball.radius;
        let steeper = (cosine * moved[1] + sine * moved[0]) / distance;
        let slope = 1.5 * (longer - groove) / approach + steeper * cosine / sine;
        let found = (thrust([small, 0.0, 0.0], [0.0; 2]) / mounted - 1.0) / small;
        assert!((found / slope - 1.0).abs() < 1e-4, "{sign} {found} {slope}");
        // a longer inner ring opens a pair back to back and closes one face to face
        let along = 1.5 * sine * moved[1] / approach;
        assert!(along * sign < 0.0, "{along}");
        // a seat moves the track radially
        let seat = (thrust([0.0; 3], [1e-10, 0.0]) / mounted - 1.0) / 1e-10;
        let expected = 1.5 * cosine / approach - sine / distance * cosine / sine;
        assert!((seat / expected - 1.0).abs() < 1e-4, "{seat} {expected}");
        let housing = (thrust([0.0; 3], [0.0, 1e-10]) / mounted - 1.0) / 1e-10;
        assert!((housing / expected + 1.0).abs() < 1e-4, "{housing}");
    }
}

#[test]
fn a_set_at_rest_carries_its_preload_on_both_sides() {
    let modulus = contact_modulus(BEARING_STEEL, BEARING_STEEL);
    let contacts = [Race::Inner, Race::Outer].map(|race| {
        let geometry = BallRace {
            ball_diameter: BALL,
            pitch_diameter: 36e-3,
            groove_curvature: 0.52,
            contact_angle: ALPHA,
            race,
        };
        PointContact::new(geometry.curvature(), modulus).unwrap()
    });
    let ball = row(0.07).ball;
    let preload = 250.0;
    for signs in [
        vec![1.0, -1.0],
        vec![1.0, 1.0, -1.0],
        vec![-1.0, 1.0, 1.0],
        vec![1.0, 1.0, -1.0, -1.0],
        vec![-1.0, 1.0, 1.0, 1.0],
    ] {
        let geometry = RowGeometry {
            signs: signs.clone(),
            spacing: 12e-3,
            balls: 14,
            ball_diameter: BALL,
            pitch_diameter: 36e-3,
            curvatures: [0.52; 2],
            free_angle: ALPHA,
            contacts,
        };
        let closed = geometry.closed_by(preload).unwrap();
        let rows = |closed| {
            let grooves = geometry.grooves(closed).into_iter();
            let of = |(_, [inner, outer]): (f64, [RaceGroove<f64>; 2])| SpatialBall {
                inner,
                outer,
                ..ball
            };
            grooves.map(of).map(|ball| (14, ball)).collect::<Vec<_>>()
        };
        // rows of one side share the preload, and the ring is in equilibrium where it is
        for ((balls, ball), sign) in rows(closed).iter().zip(&signs) {
            let beside = signs.iter().filter(|own| *own == sign).count() as f64;
            let thrust = *balls as f64 * ball.thrust_at_rest(0.0);
            assert!(
                (thrust * sign * beside / preload + 1.0).abs() < 1e-9,
                "{signs:?} {thrust}"
            );
        }
        assert!((preload_at_rest(&rows(closed), None) / preload - 1.0).abs() < 1e-9);
        // what one side is closed by less the other side takes over, whatever the place of the ring
        let moved = [closed[0] + 1e-6, closed[1] - 1e-6];
        assert!((preload_at_rest(&rows(moved), None) / preload - 1.0).abs() < 1e-9);
        assert!(preload_at_rest(&rows([-1e-6; 2]), None) < 1e-12);
    }
}
