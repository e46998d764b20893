//! Concentric spin-ups: equations (6) and (7) of the source paper from measured contact forces, and balls with ample
//! grip against the bearing whose balls roll.

use crate::machines::{
    INNER, ball_of, bearing_part, heat_of, let_roll, planar, race_motion, reference, run, settings,
    weightless,
};
use model::bearing::{BearingConstants, PlanarConstants};
use model::system::machine::{MachineConstants, RotorMachine};
use physics::rolling::{Acceleration, RollingSet};
use physics::traction::{TanhTraction, Traction, TractionLaw};

/// A driven bearing without gravity, its inner race held in the middle, the rotor out of touch.
fn driven(torque: f64) -> MachineConstants {
    let mut c = reference();
    weightless(&mut c);
    c.speed = 0.0;
    crate::machines::centred(&mut c);
    c.bearings[0].inner_race.centre_held = true;
    c.bearings[0].inner_race.torque = torque;
    let bearing = planar(&mut c);
    bearing.ball.orbit_drag = 0.0;
    bearing.ball.spin_drag = 0.0;
    // (7) lets the cage turn on the circle of the ball centres
    let pitch = bearing.ball.inner_track + bearing.ball.radius;
    bearing.cage_inertia = bearing.cage_mass * pitch * pitch;
    c
}

/// Scales both contacts by a factor and gives the balls a load at rest.
fn load_balls(bearing: &mut PlanarConstants, factor: f64, load: f64) {
    let ball = &mut bearing.ball;
    ball.inner_stiffness *= factor;
    ball.outer_stiffness *= factor;
    let approach = |stiffness: f64| (load / stiffness).powf(2.0 / 3.0);
    ball.outer_track = ball.inner_track + 2.0 * ball.radius
        - approach(ball.inner_stiffness)
        - approach(ball.outer_stiffness);
}

/// Sums over the balls at one instant of a spin-up.
struct Measured {
    /// T_I: traction of the inner race, forward.
    inner: f64,
    /// T_O: traction of the outer race, backward.
    outer: f64,
    /// T_I, T_O by (6), (7) from the accelerations and the pocket friction.
    paper: (f64, f64),
    /// T_I, T_O by the same balances with the true arms.
    exact: (f64, f64),
    /// Pocket friction F.
    pocket_friction: f64,
}

fn planar_of(machine: &RotorMachine) -> &PlanarConstants {
    match &machine.constants.bearings[0].bearing {
        BearingConstants::Spatial(_) => panic!("the bearing lies in the plane"),
        BearingConstants::Planar(bearing) => bearing,
        BearingConstants::Rolling(_) => panic!("the bearing is planar here"),
    }
}

fn measure(machine: &RotorMachine, state: &[f64]) -> Measured {
    let b = planar_of(machine);
    let (rate, _) = machine.inspect(state);
    let motion = race_motion(machine, state);
    let cage = (
        bearing_part(machine, state)[1],
        bearing_part(machine, &rate)[1],
    );
    let (r, track) = (b.ball.radius, b.ball.inner_track);
    let inertia = 0.4 * b.ball.mass * r * r;
    let (mut inner, mut outer, mut friction) = (0.0, 0.0, 0.0);
    let (mut spin_rate, mut orbit_rate) = (0.0, 0.0);
    // weighted by the true arms: d/dt of angular momentum about the centre; the balls' spin balances
    let mut momentum_rate = b.cage_inertia * cage.1;
    let (mut radius, mut arm_inner, mut arm_outer) = (0.0, 0.0, 0.0);
    let count = b.balls as f64;
    for j in 0..b.balls {
        let (now, change) = (ball_of(machine, state, j), ball_of(machine, &rate, j));
        let reaction = b.ball_reaction(&motion, bearing_part(machine, state), j);
        let [at_inner, at_outer] = reaction.contacts();
        let alone = (machine.constants.bearings[0].bearing).contacts(
            &motion,
            bearing_part(machine, state),
            j,
        );
        assert_eq!(alone, (now.azimuth, [at_inner, at_outer]));
        let (of_inner, of_outer) = b.traction.at_races(&at_inner, &at_outer);
        inner += of_inner * reaction.inner_load;
        outer -= of_outer * reaction.outer_load;
        let side = reaction.pocket_side;
        let slide = now.radial_speed - side * r * (now.spin - cage.0);
        let coefficient =
            b.ball.pocket_friction * (slide * b.ball.pocket_inverse_reference_speed).tanh();
        friction += side * coefficient * reaction.pocket_force;
        spin_rate -= change.spin;
        orbit_rate += change.orbit_speed;
        momentum_rate += b.ball.mass
            * now.radius
            * (now.radius * change.orbit_speed + 2.0 * now.radial_speed * now.orbit_speed);
        radius += now.radius / count;
        let a_i = r - 0.5 * (track + r - now.radius);
        let a_o = r - 0.5 * (now.radius + r - b.ball.outer_track);
        arm_inner += a_i / count;
        arm_outer += a_o / count;
        // what passes each contact, which goes round with the ball: surface of ball, surface of race
        let turning = now.spin - now.orbit_speed;
        let passing = [
            [
                -a_i * turning,
                (now.radius - a_i) * (motion.inner.spin - now.orbit_speed),
            ],
            [a_o * turning, -(now.radius + a_o) * now.orbit_speed],
        ];
        for ((power, found), expected) in b
            .sliding(bearing_part(machine, state), &reaction.contacts())
            .into_iter()
            .zip(passing)
        {
            assert!(power >= 0.0);
            for (found, expected) in found.into_iter().zip(expected) {
                // the outer race is pushed off the middle by rounding alone
                assert!(
                    (found - expected).abs() < 1e-6 * (1.0 + expected.abs()),
                    "{found} {expected}"
                );
            }
        }
    }
    // orbit and cage: ρ(T_I - T_O) - rF;  spin: a_i T_I + a_o T_O - rF
    let difference = (momentum_rate + r * friction) / radius;
    let spin_moment = inertia * spin_rate + r * friction;
    let exact_outer = (spin_moment - arm_inner * difference) / (arm_inner + arm_outer);

    let set = RollingSet {
        inner_track_radius: track,
        ball_ratio: r / track,
        balls_mass: count * b.ball.mass,
        cage_mass: b.cage_mass,
    };
    // balls and cage may turn at different rates: their common one by mass
    let mass = set.balls_mass + b.cage_mass;
    let acceleration = Acceleration {
        ball_spin: spin_rate / count,
        cage: (b.ball.mass * orbit_rate + b.cage_mass * cage.1) / mass,
    };
    Measured {
        inner,
        outer,
        paper: (
            set.inner_traction(acceleration, friction),
            set.outer_traction(acceleration, friction),
        ),
        exact: (exact_outer + difference, exact_outer),
        pocket_friction: friction,
    }
}

/// A spin-up by 0.03 N m, ball load 24 N, contacts stiffer by a factor, 3 ms after the start: every ball pushes its
/// pocket by then. The pockets are made tight and well damped so that the cage does not rattle.
fn spin_up(factor: f64) -> Measured {
    let mut c = driven(0.03);
    let bearing = planar(&mut c);
    load_balls(bearing, factor, 24.0);
    bearing.ball.pocket_gap = 1e-6;
    bearing.ball.pocket_damping = 1e4;
    let machine = RotorMachine::new(c);
    measure(
        &machine,
        &run(&machine, &machine.start(), &settings(3e-3, 1e-7)),
    )
}

#[test]
fn tractions_are_those_of_equations_6_and_7() {
    let (soft, stiff) = (spin_up(1.0), spin_up(100.0));
    assert!(soft.pocket_friction > 1e-3, "{}", soft.pocket_friction);
    let errors = |m: &Measured| (m.inner / m.paper.0 - 1.0, m.outer / m.paper.1 - 1.0);
    let (of_soft, of_stiff) = (errors(&soft), errors(&stiff));
    // both equations use the arms of undeformed contacts: they err in proportion to the approach, which at equal load
    // falls by 100^(2/3) = 21.5
    for (soft, stiff) in [(of_soft.0, of_stiff.0), (of_soft.1, of_stiff.1)] {
        let ratio = soft / stiff;
        assert!((ratio - 21.5).abs() < 1.0, "{soft} / {stiff} = {ratio}");
        assert!(soft.abs() < 1e-4, "approach over radius: {soft}");
    }
    // with the true arms nothing is left but rounding
    for m in [soft, stiff] {
        let (inner, outer) = (m.inner / m.exact.0 - 1.0, m.outer / m.exact.1 - 1.0);
        assert!(
            inner.abs() < 1e-12 && outer.abs() < 1e-12,
            "{inner} {outer}"
        );
    }
}

/// What "equal" means for balls with ample grip: they creep, and their contacts give way.
const EQUAL: f64 = 2e-3;

#[test]
fn balls_with_ample_grip_equal_the_rolling_bearing() {
    // speeds of inner race and cage after a spin-up of 20 ms
    let mut c = driven(0.03);
    let bearing = planar(&mut c);
    load_balls(bearing, 1.0, 40.0);
    bearing.ball.pocket_friction = 0.0;
    bearing.ball.pocket_gap = 1e-5;
    bearing.traction = Traction::Tanh(TanhTraction {
        maximum: 0.3,
        inverse_reference_speed: 1.0 / 0.02,
    });
    let mut rolls = c.clone();
    let_roll(&mut rolls);
    let end = |constants: &MachineConstants| {
        let machine = RotorMachine::new(constants.clone());
        let state = run(&machine, &machine.start(), &settings(20e-3, 1e-5));
        let cage = machine.constants.bearings[0].bearing.cage_speed(
            &race_motion(&machine, &state),
            bearing_part(&machine, &state),
        );
        (state[INNER + 5], cage)
    };
    let (balls, rolling) = (end(&c), end(&rolls));
    // measured 6e-6 and 4e-5
    assert!(
        (balls.0 / rolling.0 - 1.0).abs() < EQUAL,
        "{balls:?} {rolling:?}"
    );
    assert!(
        (balls.1 / rolling.1 - 1.0).abs() < EQUAL,
        "{balls:?} {rolling:?}"
    );
    // without the balls the race would be faster by a fifth: they do take part
    let alone = 0.03 * 20e-3 / c.bearings[0].inner_race.inertia;
    assert!(rolling.0 < 0.85 * alone);
}

#[test]
fn a_drop_on_balls_with_ample_grip_is_a_drop_on_rolling_balls() {
    let mut c = reference();
    let bearing = planar(&mut c);
    load_balls(bearing, 1.0, 200.0);
    bearing.ball.orbit_drag = 0.0;
    bearing.ball.spin_drag = 0.0;
    bearing.ball.pocket_friction = 0.0;
    bearing.ball.pocket_gap = 1e-5;
    let pitch = bearing.ball.inner_track + bearing.ball.radius;
    bearing.cage_inertia = bearing.cage_mass * pitch * pitch;
    bearing.traction = Traction::Tanh(TanhTraction {
        maximum: 0.3,
        inverse_reference_speed: 1.0 / 0.05,
    });
    let mut rolls = c.clone();
    let_roll(&mut rolls);
    let end = |constants: &MachineConstants| {
        let machine = RotorMachine::new(constants.clone());
        let state = run(&machine, &machine.start(), &settings(20e-3, 1e-4));
        let heat = heat_of(&machine, &state, "rotor_race_friction");
        (state[INNER + 5], heat)
    };
    let (balls, rolling) = (end(&c), end(&rolls));
    // speed of the race and friction heat; measured 4e-4 and 3e-4
    assert!(
        rolling.0 > 500.0,
        "the drop has spun the race up: {rolling:?}"
    );
    assert!(
        (balls.0 / rolling.0 - 1.0).abs() < EQUAL,
        "{balls:?} {rolling:?}"
    );
    assert!(
        (balls.1 / rolling.1 - 1.0).abs() < EQUAL,
        "{balls:?} {rolling:?}"
    );
}
