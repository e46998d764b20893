//! Bearings in space as parts of a machine: against the assembly with a rigid rotor, and by what closes.

use super::setup::*;
use crate::machines::{Blind, by, reference, settings};
use model::bearing::BearingConstants;
use model::mount::Mount;
use model::rotor::{AxialConstants, Coordinate, RotorConstants, Unbalance};
use model::spatial::part::SpatialBearing;
use model::spatial::rigid_body::BODY_STATES;
use model::spatial::{Assembly, AssemblyConstants, LandingConstants};
use model::system::machine::simulate::Steps;
use model::system::machine::{MachineConstants, RotorMachine};
use number::{Vec2, Vec3};
use physics::contact_nodes::matched;
use physics::rolling::RollingSet;
use solve::{Machine, Stop};

const MASS: f64 = 8.0;
const TRANSVERSE: f64 = 0.05;
const POLAR: f64 = 0.01;

/// The machine of an assembly with a rotor: that rotor as a translation and a tilt, `lever` above its mass centre the bearing.
fn of(assembly: &AssemblyConstants, lever: f64) -> MachineConstants {
    let mut machine = reference();
    let along = |amount: f64| Vec2::new(amount, 0.0);
    let coordinate = |mass: f64, weight: f64| Coordinate {
        frequency: 0.0,
        mass,
        weight,
        unbalance: along(0.0),
    };
    machine.rotor = RotorConstants {
        coordinates: vec![coordinate(MASS, MASS), coordinate(TRANSVERSE, 0.0)],
        gyroscopic: vec![0.0, 0.0, 0.0, POLAR],
        polar_inertia: POLAR,
        ..RotorConstants::point(1.0, 1.0, 0.0)
    };
    let g = assembly.gravity;
    machine.gravity = Vec2::new(g.x, g.y);
    machine.axial = Some(AxialConstants {
        gravity: g.z,
        stiffness: 0.0,
        damping: 0.0,
        carried: 0.0,
    });
    let outer = &assembly.outer;
    let landing = assembly.rotor.as_ref().unwrap().landing.clone();
    let part = &mut machine.bearings[0];
    part.node = vec![1.0, lever];
    part.contact = landing.contact;
    part.inner_race.mass = assembly.inner.inertia.mass;
    part.inner_race.inertia = assembly.inner.inertia.axial;
    part.inner_race.torque = assembly.inner.torque;
    part.outer_race_mass = outer.inertia.mass;
    part.mount = Mount {
        stiffness: outer.mount.radial_stiffness,
        damping: outer.mount.radial_damping,
        free_position: Vec2::new(outer.mount.free_position.x, outer.mount.free_position.y),
    };
    let mut mount = outer.mount;
    (mount.radial_stiffness, mount.radial_damping) = (0.0, 0.0);
    part.bearing = BearingConstants::Spatial(SpatialBearing {
        rows: assembly.rows.clone(),
        spring: assembly.spring,
        set: RollingSet {
            inner_track_radius: 14.8e-3,
            ball_ratio: 0.21,
            balls_mass: 0.02,
            cage_mass: 5e-3,
        },
        rotation: vec![0.0, 1.0],
        lever,
        inner_transverse: assembly.inner.inertia.transverse,
        outer_inertias: (outer.turns).then_some([outer.inertia.axial, outer.inertia.transverse]),
        mount,
        first_ball_angle: 0.0,
        landing,
        groove_ends: None,
        face_surfaces: None,
        races: None,
    });
    machine
}

/// An assembly with mount and rotor on one pair, without what a machine has not.
fn pair(guide: Guide) -> AssemblyConstants {
    without(machine(bearing(O, TANH, &matched(8.0), guide), true))
}

fn without(mut all: AssemblyConstants) -> AssemblyConstants {
    all.inner.force = Vec3::zero();
    all.inner.moment = Vec3::zero();
    (all.inner.settling, all.inner.tilt_settling) = (0.0, 0.0);
    let rotor = all.rotor.as_mut().unwrap();
    rotor.levitation = None;
    rotor.eccentricity = 0.0;
    all
}

/// Where balls, cages and rings stand in the machine, beside their places in the assembly.
fn places(assembly: &AssemblyConstants, machine: &RotorMachine) -> Vec<(usize, usize)> {
    let at = machine.layout().bearings[0];
    let rings = [(1, at.inner), (2, at.outer)].map(|(body, ring)| {
        let first = ring.channels().start;
        (0..BODY_STATES).map(move |k| (assembly.body(body) + k, first + k))
    });
    let own = assembly.first_account() - assembly.body(3);
    let balls = (0..own).map(|k| (assembly.body(3) + k, at.own().start + k));
    rings.into_iter().flatten().chain(balls).collect()
}

#[test]
fn a_machine_and_an_assembly_with_a_rigid_rotor_agree() {
    let mut random = Random(7);
    for assembly in [
        pair(Guide::Tied),
        pair(Guide::Balls),
        pair(Guide::Outer),
        without(sprung()),
    ] {
        let machine = RotorMachine::new(of(&assembly, 0.0));
        for _ in 0..4 {
            let mut given = random_state(&assembly, &mut random, 1.0);
            if !assembly.outer.turns {
                let outer = assembly.body(2);
                given[outer + 10..outer + 13].fill(0.0);
            }
            let mut state = vec![0.0; machine.dimension()];
            for (from, to) in places(&assembly, &machine) {
                state[to] = given[from];
            }
            let rotor = machine.layout().rotor;
            let (tilt, tilting) = ([1e-3, -7e-4], [0.4, 0.3]);
            let (place, speed) = (
                [given[0], given[1], given[2]],
                [given[3], given[4], given[5]],
            );
            let spin = 900.0;
            for axis in 0..2 {
                let first = rotor.block(axis).start;
                (state[first], state[first + 1]) = (place[axis], tilt[axis]);
                let first = rotor.block(2 + axis).start;
                (state[first], state[first + 1]) = (speed[axis], tilting[axis]);
            }
            state[rotor.spin()] = spin;
            (state[rotor.place()], state[rotor.place() + 1]) = (place[2], speed[2]);
            // the same tilt and turning as a body: about -y and x of the axis's direction b
            let b = Vec3::new(tilt[0], tilt[1], 1.0);
            let length = b.length_squared().sqrt();
            let a = b * (1.0 / length);
            let cross = tilt[0] * tilting[1] - tilt[1] * tilting[0];
            let across = Vec3::new(-tilting[1], tilting[0], cross) * (1.0 / (length * length));
            let omega = a * (spin - cross / (length * (1.0 + length))) + across;
            // the smallest turn from e_z to a
            given[6..10].copy_from_slice(&[1.0 + a.z, -a.y, a.x, 0.0]);
            given[10..13].copy_from_slice(&[omega.x, omega.y, omega.z]);

            let mut theirs = vec![0.0; given.len()];
            Assembly::<f64>::gather(&|_| &assembly).rate(&given, &mut theirs);
            let (ours, _) = machine.inspect(&state);
            let largest = theirs[13..].iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            for (from, to) in places(&assembly, &machine) {
                let missed = (theirs[from] - ours[to]).abs();
                assert!(
                    missed <= 1e-11 * theirs[from].abs() + 1e-15 * largest,
                    "{}: {} {}",
                    machine.layout().channel_name(to),
                    ours[to],
                    theirs[from]
                );
            }
            let g = assembly.gravity;
            let force = [0, 1, 2].map(|k| theirs[3 + k]);
            let size = force.iter().map(|f| f.abs()).fold(g.z.abs(), f64::max);
            let own = [
                ours[rotor.block(2).start],
                ours[rotor.block(3).start],
                ours[rotor.place() + 1],
            ];
            for k in 0..3 {
                assert!(
                    (own[k] - force[k]).abs() < 1e-9 * size,
                    "{k}: {own:?} {force:?}"
                );
            }
            // ω = Ω a + (-ψ̇_y, ψ̇_x, 0): the linear rotor tilts as the rigid one to the square of its tilt
            let turning = [
                ours[rotor.block(2).start + 1],
                ours[rotor.block(3).start + 1],
            ];
            let spin_rate = theirs[12];
            let expected = [
                theirs[11] - spin_rate * tilt[1] - spin * tilting[1],
                -theirs[10] + spin_rate * tilt[0] + spin * tilting[0],
            ];
            let most = expected[0].abs().max(expected[1].abs());
            for k in 0..2 {
                let missed = (turning[k] - expected[k]).abs();
                assert!(missed < 1e-4 * most, "{turning:?} {expected:?}");
            }
            let spun = theirs[12].abs().max(1e-3 * most);
            assert!((ours[rotor.spin()] - theirs[12]).abs() < 3e-3 * spun);
        }
    }
}

#[test]
fn machines_with_other_landing_surfaces_share_no_lanes() {
    let both = pair(Guide::Tied);
    let machine = |own: &AssemblyConstants| RotorMachine::new(of(own, 0.0));
    let mut others = vec![both.clone(), both.clone(), both.clone()];
    let landing = |own: &mut AssemblyConstants, change: fn(&mut LandingConstants)| {
        change(&mut own.rotor.as_mut().unwrap().landing);
    };
    landing(&mut others[0], |own| own.faces.truncate(1));
    landing(&mut others[1], |own| own.stations.truncate(1));
    others[2].rows[0].nodes.truncate(1);
    assert!(machine(&both).shares_lanes(&machine(&both)));
    for other in &others {
        assert!(!machine(&both).shares_lanes(&machine(other)));
    }
}

#[test]
fn energy_and_angular_momentum_close_through_a_drop_in_space() {
    for (mut assembly, lever, unbalance) in [
        (pair(Guide::Tied), 0.0, 0.0),
        (pair(Guide::Balls), 0.02, 5e-6),
        (without(sprung()), 0.0, 0.0),
    ] {
        let rotor = assembly.rotor.as_mut().unwrap();
        rotor.landing.contact.radial_clearance = 5e-5;
        for face in &mut rotor.landing.faces {
            face.shoulder += face.side * 3e-5;
        }
        let mut constants = of(&assembly, lever);
        constants.speed = 600.0;
        constants.rotor = constants.rotor.with_unbalance(&[Unbalance {
            node: vec![1.0, 0.03],
            product: unbalance * MASS,
            phase: 0.3,
        }]);
        constants.balance_mounts();
        let machine = RotorMachine::new(constants);
        let still = [Vec2::zero(); 2];
        // it falls fast, so that every contact is met in a few milliseconds
        let falling = [Vec2::new(0.01, -0.06), Vec2::new(0.1, 0.05)];
        let mut start = machine.start_with(&still, &falling);
        start[machine.layout().rotor.place() + 1] = 0.05;
        let mut last = f64::INFINITY;
        for tolerance in [1e-5, 1e-7] {
            let ending = by(
                Steps::Explicit,
                &machine,
                &start,
                &settings(5e-3, tolerance),
                &mut Blind,
            );
            assert_eq!(ending.stop, Stop::Finished);
            let balance = machine.balance(&start, &ending.state);
            let at = &machine.layout().bearings[0];
            assert!(ending.state[at.inner.spin()] > 5.0);
            let friction = ending.state[machine.layout().heat(at.rotor_race_friction())];
            assert!(friction > 1e-3, "{friction}");
            let energy = balance.energy_residual() / balance.heat();
            let momentum = balance.angular_momentum_residual() / (POLAR * 600.0);
            println!("{tolerance}: {energy} of {} J, {momentum}", balance.heat());
            assert!(energy.abs() < 1e-3 * tolerance / 1e-7 && momentum.abs() < 1e-9);
            assert!(energy.abs() < last);
            last = 0.3 * energy.abs();
        }
    }
}

#[test]
fn a_base_that_moves_accelerates_every_body_alike() {
    use model::base::{BaseConstants, HalfSine};
    use model::table::Table;
    let by = Vec2::new(-300.0, 200.0);
    for guide in [Guide::Tied, Guide::Balls] {
        let constants = of(&pair(guide), 0.02);
        let mut shaken = constants.clone();
        shaken.base = Some(BaseConstants {
            record: [-by.x, -by.y].map(Table::constant),
            shocks: vec![HalfSine {
                start: 1.0,
                duration: 1.0,
                acceleration: Vec2::new(1.0, 0.0),
            }],
        });
        let [still, shaken] = [constants, shaken].map(RotorMachine::new);
        let states = [&still, &shaken].map(|machine| {
            let falling = [Vec2::new(0.01, -0.06), Vec2::new(0.1, 0.05)];
            machine.start_with(&[Vec2::new(4e-5, -3e-5), Vec2::zero()], &falling)
        });
        let rates = [
            still.inspect(&states[0]).0,
            shaken.inspect_at(0.0, &states[1]).0,
        ];
        let at = still.layout().bearings[0];
        let added = |channel: usize| rates[1][channel] - rates[0][channel];
        let near = |found: f64, expected: f64| {
            assert!(
                (found - expected).abs() < 1e-6 * 300.0,
                "{found} {expected}"
            );
        };
        let MachineConstants { bearings, .. } = &still.constants;
        let own = bearings[0].spatial().unwrap();
        let bodies = [at.inner.channels().start, at.outer.channels().start];
        let cages = (0..own.rows.len()).map(|row| at.own().start + BODY_STATES * row);
        for first in bodies.into_iter().chain(cages) {
            near(added(first + 3), by.x);
            near(added(first + 4), by.y);
        }
        let mut first = at.own().start + BODY_STATES * own.rows.len();
        for row in &own.rows {
            let n = row.balls;
            for ball in first..first + n {
                let [radius, azimuth] = [0, 2].map(|k| states[0][ball + k * n]);
                let (sine, cosine) = azimuth.sin_cos();
                let turned = Vec2::new(-sine, cosine);
                near(added(ball + n), by.dot(Vec2::new(cosine, sine)));
                near(radius * added(ball + 3 * n), by.dot(turned));
            }
            first += 9 * n;
        }
    }
}
