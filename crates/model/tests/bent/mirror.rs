//! A machine with a flexible rotor and its mirror image at the y axis: every rate of a random state is the image of the other's.

use crate::machines::bent::{NODES, Shaft, bent, shaft};
use crate::machines::{Random, vec2};
use model::bearing::ball::BallMotion;
use model::bearing::{BearingConstants, PlanarConstants, seat};
use model::magnets::MagnetsConstants;
use model::mount::MaxwellBranch;
use model::system::machine::{MachineConstants, RotorMachine};
use number::Vec2;
use solve::Machine;
use std::f64::consts::PI;

const CUT: f64 = 3e4;

fn in_modes(rotor: rotor::Rotor) -> Shaft {
    Shaft::reduced(rotor, CUT, &[NODES[0], NODES[1], 4, 6])
}

fn planar(bearing: &BearingConstants) -> &PlanarConstants {
    match bearing {
        BearingConstants::Planar(bearing) => bearing,
        _ => panic!("the bearings are planar here"),
    }
}

/// The machine of the tests with all that has a direction: slanted weight, magnets that fade, drag, a mount that creeps.
fn machine() -> MachineConstants {
    let (mut constants, _) = bent(CUT);
    constants.gravity = vec2(2.0, -9.6);
    constants.rotor.drag = 1e-4;
    let magnet = (in_modes(shaft()).row(2), vec2(-10.0, 30.0), 1e5);
    constants.magnets = Some(MagnetsConstants::fading([magnet], 300.0, 0.0));
    for part in &mut constants.bearings {
        part.mount_parts.branches = vec![MaxwellBranch {
            stiffness: 1e7,
            rate: 2e3,
        }];
        part.inner_race.torque = 0.01;
        if let BearingConstants::Planar(bearing) = &mut part.bearing {
            bearing.ball.gravity = constants.gravity;
        }
    }
    constants.balance_mounts();
    constants
}

fn flipped(v: Vec2<f64>) -> Vec2<f64> {
    vec2(-v.x, v.y)
}

/// Its image: what points to the right points to the left, what turns one way turns the other.
fn image_of(constants: &MachineConstants) -> MachineConstants {
    let mut image = constants.clone();
    let mut unbalanced = shaft();
    for plane in &mut unbalanced.unbalance {
        plane.phase = -plane.phase;
    }
    image.rotor = in_modes(unbalanced).constants();
    image.rotor.drag = constants.rotor.drag;
    image.gravity = flipped(image.gravity);
    image.speed = -image.speed;
    for magnet in image.magnets.iter_mut().flat_map(|own| &mut own.magnets) {
        // the axis along x
        magnet.axes[0].current = -magnet.axes[0].current;
    }
    for part in &mut image.bearings {
        part.datum = flipped(part.datum);
        part.inner_race.torque = -part.inner_race.torque;
        if let BearingConstants::Planar(bearing) = &mut part.bearing {
            bearing.ball.gravity = image.gravity;
        }
    }
    image.balance_mounts();
    image
}

/// A state, or a rate, as the mirror shows it: angles are counted from the other side of the circle, π less what they were.
fn image(machine: &RotorMachine, state: &[f64], half_turn: f64) -> Vec<f64> {
    let mut out = state.to_vec();
    let layout = machine.layout();
    let rotor = layout.rotor;
    let mut sideways: Vec<usize> = rotor.block(0).chain(rotor.block(2)).collect();
    sideways.extend([rotor.spin(), layout.angular_impulse()]);
    let mut angles = vec![rotor.angle()];
    for at in &layout.bearings {
        sideways.extend([
            at.inner.centre()[0],
            at.inner.velocity()[0],
            at.inner.spin(),
            at.outer.centre()[0],
            at.outer.velocity()[0],
        ]);
        sideways.push(at.bearing + 1);
        sideways.extend((at.mount..at.mount + at.mount_states).step_by(2));
        angles.extend([at.inner.angle(), at.bearing]);
    }
    for channel in sideways {
        out[channel] = -state[channel];
    }
    for channel in angles {
        out[channel] = half_turn - state[channel];
    }
    for (at, part) in layout.bearings.iter().zip(&machine.constants.bearings) {
        let bearing = planar(&part.bearing);
        let own = at.bearing..at.bearing + at.bearing_states;
        for ball in 0..bearing.balls {
            let was = bearing.motion(&state[own.clone()], ball);
            // balls change places: the seat of all but the first is a turn further on
            let turns = if ball == 0 { 1.0 } else { 3.0 };
            let place = (bearing.balls - ball) % bearing.balls;
            let motion = BallMotion {
                azimuth: turns * half_turn - was.azimuth,
                orbit_speed: -was.orbit_speed,
                spin: -was.spin,
                ..was
            };
            bearing.set_motion(&mut out[own.clone()], place, &motion);
        }
    }
    out
}

/// Anything may touch anything: rotor and races, balls and races, balls and cage.
fn random_state(machine: &RotorMachine, random: &mut Random) -> Vec<f64> {
    let constants = &machine.constants;
    let (mut at, mut moving) = (Vec::new(), Vec::new());
    // the rotor's axis is about as far from the middle as the clearance is wide
    let side = [random.within(4e-4), random.within(4e-4)];
    for (k, own) in constants.rotor.coordinates.iter().enumerate() {
        let bent = 6e-5 / (1.0 + k as f64).powi(4);
        let mut near = |place: f64| place * own.weight + random.within(bent);
        at.push(vec2(near(side[0]), near(side[1])));
        moving.push(vec2(random.within(0.1), random.within(0.1)));
    }
    let mut state = machine.start_with(&at, &moving);
    let layout = machine.layout();
    state[layout.rotor.angle()] = random.within(7.0);
    state[layout.rotor.spin()] = random.within(1500.0);
    for (at, part) in layout.bearings.iter().zip(&constants.bearings) {
        for race in [at.inner, at.outer] {
            for (place, speed) in race.centre().into_iter().zip(race.velocity()) {
                state[place] = random.within(1e-5);
                state[speed] = random.within(0.2);
            }
        }
        state[at.inner.angle()] = random.within(7.0);
        state[at.inner.spin()] = random.within(1500.0);
        for own in &mut state[at.of_mount()] {
            *own = random.within(1e-5);
        }
        let bearing = planar(&part.bearing);
        let cage = [random.within(3.0), random.within(600.0)];
        state[at.bearing..at.bearing + 2].copy_from_slice(&cage);
        let ball = &bearing.ball;
        for index in 0..bearing.balls {
            let travel = 2.0 * ball.pocket_gap / ball.pocket_radius;
            let motion = BallMotion {
                radius: bearing.rest_radius() + random.within(8e-6),
                radial_speed: random.within(0.2),
                azimuth: cage[0] + seat(index, bearing.balls) + random.within(travel),
                orbit_speed: random.within(600.0),
                spin: random.within(6000.0),
            };
            let own = at.bearing..at.bearing + at.bearing_states;
            bearing.set_motion(&mut state[own], index, &motion);
        }
    }
    state
}

#[test]
fn mirroring_a_bent_machine_mirrors_its_equations() {
    let constants = machine();
    let (own, mirrored) = (
        RotorMachine::new(constants.clone()),
        RotorMachine::new(image_of(&constants)),
    );
    let mut random = Random(20);
    let spin = own.layout().rotor.spin();
    let (mut touched, mut pairs) = (0, Vec::new());
    for _ in 0..50 {
        let state = random_state(&own, &mut random);
        let (rate, _) = own.inspect(&state);
        let (found, _) = mirrored.inspect(&image(&own, &state, PI));
        touched += usize::from(rate[spin].abs() > 10.0);
        pairs.push((found, image(&own, &rate, 0.0)));
    }
    assert!(touched > 10, "the rotor touched {touched} times");
    // each channel by its largest rate: what cancels in one state leaves the rounding of what was added
    for channel in 0..own.dimension() {
        let largest = |sizes: &mut dyn Iterator<Item = f64>| sizes.fold(0.0, f64::max);
        let size = largest(&mut pairs.iter().map(|(_, b)| b[channel].abs()));
        let apart = largest(&mut pairs.iter().map(|(a, b)| (a[channel] - b[channel]).abs()));
        assert!(
            apart <= 1e-12 * size,
            "channel {channel}: {apart:.1e} of {size:.1e}"
        );
    }
}
