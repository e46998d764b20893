//! What keeps the balls apart: cages free to move, lands, full complements.

use crate::machines::{
    INNER, OUTER, Random, ball_of, ball_pair, bearing_part, heat_of, land, let_roll, planar,
    race_motion, random_state, reference, run, separate, separations, settings, tilt_contacts,
    vec2,
};
use model::auxiliary_bearing::probe::{LAND_FORCE, LARGEST_INNER_LOAD, LARGEST_POCKET_FORCE};
use model::bearing::ball_states::CAGE_PLACE;
use model::bearing::land::LandRace;
use model::bearing::{BearingConstants, Separation};
use model::system::machine::{MachineConstants, RotorMachine};

/// The drop through its first impact and what follows: most of the spin-up.
const END: f64 = 25e-3;

fn machine_with(separation: Separation<f64>) -> RotorMachine {
    let mut c = reference();
    separate(&mut c, separation);
    RotorMachine::new(c)
}

#[test]
fn energy_and_angular_momentum_close_in_a_drop() {
    for separation in separations() {
        let machine = machine_with(separation);
        let start = machine.start();
        let end = run(&machine, &start, &settings(END, 1e-4));
        let balance = machine.balance(&start, &end);
        let spin = machine.constants.bearings[0].inner_race.inertia * end[INNER + 5];
        assert!(end[INNER + 5] > 500.0, "the race was spun up");
        let residual = balance.energy_residual() / balance.heat();
        assert!(residual.abs() < 1e-6, "{residual}");
        let lost = balance.angular_momentum_residual() / spin;
        assert!(lost.abs() < 1e-7, "{lost}");
    }
}

#[test]
fn a_cage_stays_within_its_land() {
    for race in [LandRace::Outer, LandRace::Inner] {
        let clearance = 0.15e-3;
        let machine = machine_with(Separation::FreeCage(Some(land(race, clearance))));
        let end = run(&machine, &machine.start(), &settings(END, 1e-4));
        let cage = bearing_part(&machine, &end);
        let body = if race == LandRace::Inner {
            INNER
        } else {
            OUTER
        };
        let off = (cage[CAGE_PLACE] - end[body]).hypot(cage[CAGE_PLACE + 1] - end[body + 1]);
        // 10 N and more press it in by a few µm
        assert!(off < clearance + 20e-6, "{off}");
        assert!(heat_of(&machine, &end, "cage_land_friction") > 0.0);
        assert!(heat_of(&machine, &end, "cage_land_damping") > 0.0);
    }
}

#[test]
fn a_cage_that_rides_on_its_balls_stays_within_its_pockets() {
    let mut c = reference();
    // with clearance only a few balls are pressed, and the others may not let the cage go
    let bearing = planar(&mut c);
    bearing.ball.outer_track += 10e-6;
    let gap = bearing.ball.pocket_gap;
    separate(&mut c, Separation::FreeCage(None));
    let machine = RotorMachine::new(c);
    let start = machine.start();
    let end = run(&machine, &start, &settings(60e-3, 1e-4));
    assert!(end[INNER + 5] > 1000.0, "the race was spun up");
    let cage = bearing_part(&machine, &end);
    let off = (cage[CAGE_PLACE] - end[OUTER]).hypot(cage[CAGE_PLACE + 1] - end[OUTER + 1]);
    // its gap, the play of the balls between the races, and what impacts press
    assert!(off < gap + 30e-6, "{off}");
    let balance = machine.balance(&start, &end);
    let residual = balance.energy_residual() / balance.heat();
    assert!(residual.abs() < 2e-6, "{residual}");
}

#[test]
fn balls_that_roll_at_an_angle_carry_what_balls_by_themselves_do() {
    let mut c = reference();
    tilt_contacts(planar(&mut c), 0.6);
    let mut rolls = c.clone();
    let_roll(&mut rolls);
    let load = |constants: MachineConstants| {
        let machine = RotorMachine::new(constants);
        let (_, probe) = machine.inspect(&machine.start());
        probe[LARGEST_INNER_LOAD]
    };
    let (planar, rolling) = (load(c), load(rolls));
    // the interference shared between both contacts is that of one spring: rounding
    assert!(
        rolling > 1.0 && (planar / rolling - 1.0).abs() < 1e-9,
        "{planar} {rolling}"
    );
}

#[test]
fn a_pocket_is_rubbed_along_the_line_of_contact() {
    // in space: the ball turns by σ cos α about an axis across its line of contact, the wall stands across the track
    let alpha = 0.5_f64;
    let (sine, cosine) = alpha.sin_cos();
    let mut c = reference();
    tilt_contacts(planar(&mut c), alpha);
    let plain = reference();
    let BearingConstants::Planar(level) = &plain.bearings[0].bearing else {
        panic!("planar")
    };
    let machine = RotorMachine::new(c);
    let BearingConstants::Planar(bearing) = &machine.constants.bearings[0].bearing else {
        panic!("planar")
    };
    let mut random = Random(7);
    let mut pressed = 0;
    for _ in 0..40 {
        let state = random_state(&machine, &mut random);
        let (motion, part) = (
            race_motion(&machine, &state),
            bearing_part(&machine, &state),
        );
        for j in 0..bearing.balls {
            let reaction = bearing.ball_reaction(&motion, part, j);
            if reaction.pocket_force == 0.0 {
                continue;
            }
            pressed += 1;
            let ball = ball_of(&machine, &state, j);
            let e = vec2(ball.azimuth.cos(), ball.azimuth.sin());
            let past = e * ball.radial_speed + e.turned() * (ball.radius * ball.orbit_speed)
                - motion.outer.velocity;
            let from_outer = e * ball.radius - motion.outer.position;
            let n = from_outer * (1.0 / from_outer.length_squared().sqrt());
            // towards the wall r s t: its place, and the ball's rotation in the directions n and z
            let reach = reaction.pocket_side * bearing.ball.ball_radius;
            let rotation = (ball.spin * cosine * sine, ball.spin * cosine * cosine);
            // ω × (reach t) with n × t = z and z × t = -n
            let surface = (past.dot(n) - reach * rotation.1, reach * rotation.0);
            let wall = -reach * part[1];
            // the line of contact: n cos α - z sin α
            let u = (surface.0 - wall) * cosine - surface.1 * sine;
            let friction = level.ball.pocket_friction
                * (u * level.ball.pocket_inverse_reference_speed).tanh()
                * reaction.pocket_force;
            // rounding
            let off = reaction.pocket_friction + friction * cosine;
            assert!(off.abs() < 1e-12 * reaction.pocket_force, "{off}");
            let heat = reaction.heat.pocket_sliding - friction * u;
            assert!(heat.abs() < 1e-11 * reaction.pocket_force, "{heat}");
        }
    }
    assert!(pressed > 100, "{pressed}");
}

#[test]
fn a_land_without_clearance_is_a_centred_cage() {
    // frictionless pockets and land; the land holds the cage's centre at the outer race's
    let smooth = |mut c: MachineConstants| {
        let bearing = planar(&mut c);
        bearing.ball.pocket_friction = 0.0;
        let machine = RotorMachine::new(c);
        let end = run(&machine, &machine.start(), &settings(13e-3, 1e-5));
        (end[INNER + 5], bearing_part(&machine, &end)[1])
    };
    let centred = smooth(reference());
    let mut held = reference();
    let mut tight = land(LandRace::Outer, 0.0);
    tight.contact.stiffness = 1e9;
    tight.contact.friction = 0.0;
    separate(&mut held, Separation::FreeCage(Some(tight)));
    let guided = smooth(held);
    assert!(centred.0 > 100.0 && centred.1 > 40.0, "{centred:?}");
    // measured 1e-5 and 1e-3: pocket impacts come at other instants
    assert!(
        (guided.0 / centred.0 - 1.0).abs() < 1e-3,
        "{guided:?} {centred:?}"
    );
    assert!(
        (guided.1 / centred.1 - 1.0).abs() < 1e-2,
        "{guided:?} {centred:?}"
    );
}

#[test]
fn a_cage_at_rest_lies_on_its_land_with_its_weight() {
    let mut c = reference();
    separate(
        &mut c,
        Separation::FreeCage(Some(land(LandRace::Outer, 0.05e-3))),
    );
    // the rotor stays up, pockets are wide, nothing turns
    crate::machines::centred(&mut c);
    planar(&mut c).ball.pocket_gap = 1e-3;
    c.speed = 0.0;
    let weight = planar(&mut c).cage_mass * 9.81;
    let machine = RotorMachine::with_levitation(c, true);
    // strong damping by its land, 0.3 s to settle
    let end = run(&machine, &machine.start(), &settings(0.5, 1e-3));
    let (_, probe) = machine.inspect(&end);
    assert!(
        (probe[LAND_FORCE] / weight - 1.0).abs() < 0.05,
        "{} {weight}",
        probe[LAND_FORCE]
    );
    let cage = bearing_part(&machine, &end);
    assert!(
        cage[CAGE_PLACE + 1] < -0.9 * 0.05e-3,
        "it lies below: {}",
        cage[CAGE_PLACE + 1]
    );
    assert_eq!(probe[LARGEST_POCKET_FORCE], 0.0);
}

#[test]
fn balls_without_a_cage_run_against_each_other() {
    let machine = machine_with(Separation::Neighbours(ball_pair()));
    let end = run(&machine, &machine.start(), &settings(END, 1e-4));
    assert!(heat_of(&machine, &end, "ball_ball_friction") > 0.0);
    assert!(heat_of(&machine, &end, "ball_ball_damping") > 0.0);
    assert_eq!(heat_of(&machine, &end, "pocket_friction"), 0.0);
    let BearingConstants::Planar(bearing) = &machine.constants.bearings[0].bearing else {
        panic!("planar")
    };
    // none has passed another, and the mean stands where a cage would
    let azimuths: Vec<f64> = (0..bearing.balls)
        .map(|j| ball_of(&machine, &end, j).azimuth)
        .collect();
    assert!(azimuths.windows(2).all(|pair| pair[1] > pair[0]));
    assert!(azimuths[bearing.balls - 1] < azimuths[0] + std::f64::consts::TAU);
    let mean = (0..bearing.balls)
        .map(|j| ball_of(&machine, &end, j).orbit_speed)
        .sum::<f64>()
        / bearing.balls as f64;
    let cage = bearing_part(&machine, &end)[1];
    assert!((cage / mean - 1.0).abs() < 1e-9, "{cage} {mean}");
}
