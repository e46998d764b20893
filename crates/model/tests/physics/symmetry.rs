//! Turning or mirroring the machine turns or mirrors the answer.

use crate::machines::{
    BEARING, INNER, OUTER, balance_mount, ball_of, equal_steps, planar, reference, run, separate,
    separations, vec2,
};
use model::bearing::ball::BallMotion;
use model::bearing::ball_states::CAGE_PLACE;
use model::bearing::{BearingConstants, Separation};
use model::system::machine::layout::ROTOR;
use model::system::machine::{MachineConstants, RotorMachine};
use number::Vec2;
use std::f64::consts::PI;

/// The plane turned by an angle, or mirrored at the y axis.
#[derive(Clone, Copy)]
enum Change {
    Turned(f64),
    Mirrored,
}

impl Change {
    fn vector(self, v: Vec2<f64>) -> Vec2<f64> {
        match self {
            Change::Turned(by) => {
                let (s, c) = by.sin_cos();
                vec2(c * v.x - s * v.y, s * v.x + c * v.y)
            }
            Change::Mirrored => vec2(-v.x, v.y),
        }
    }
    fn azimuth(self, angle: f64) -> f64 {
        match self {
            Change::Turned(by) => angle + by,
            Change::Mirrored => PI - angle,
        }
    }
    fn spin(self, spin: f64) -> f64 {
        match self {
            Change::Turned(_) => spin,
            Change::Mirrored => -spin,
        }
    }
    /// The ball that takes the place of another.
    fn ball(self, ball: usize, balls: usize) -> usize {
        match self {
            Change::Turned(_) => ball,
            Change::Mirrored => (balls - ball) % balls,
        }
    }

    fn constants(self, constants: &MachineConstants) -> MachineConstants {
        let mut c = constants.clone();
        c.gravity = self.vector(c.gravity);
        c.levitation.carried = self.vector(c.levitation.carried);
        c.levitation.centre = self.vector(c.levitation.centre);
        c.bearings[0].inner_race.torque = self.spin(c.bearings[0].inner_race.torque);
        c.speed = self.spin(c.speed);
        c.unbalance_angle = self.azimuth(c.unbalance_angle);
        let bearing = planar(&mut c);
        bearing.ball.gravity = self.vector(bearing.ball.gravity);
        bearing.first_ball_angle = self.azimuth(bearing.first_ball_angle);
        balance_mount(&mut c);
        c
    }

    /// Everything that can be seen of a state, as it appears after the change.
    fn view(self, machine: &RotorMachine, state: &[f64]) -> Vec<(&'static str, f64)> {
        let mut seen = Vec::new();
        for (kind, at) in [
            ("position", ROTOR),
            ("position", INNER),
            ("position", OUTER),
        ] {
            let position = self.vector(vec2(state[at], state[at + 1]));
            let velocity = self.vector(vec2(state[at + 2], state[at + 3]));
            seen.extend([(kind, position.x), (kind, position.y)]);
            seen.extend([("velocity", velocity.x), ("velocity", velocity.y)]);
        }
        for at in [ROTOR + 5, INNER + 5, BEARING + 1] {
            seen.push(("spin", self.spin(state[at])));
        }
        seen.push(("angle", self.azimuth(state[ROTOR + 4]).sin()));
        if let BearingConstants::Planar(bearing) = &machine.constants.bearings[0].bearing
            && let Separation::FreeCage(_) = bearing.separation
        {
            let at = BEARING + CAGE_PLACE;
            let place = self.vector(vec2(state[at], state[at + 1]));
            let speed = self.vector(vec2(state[at + 2], state[at + 3]));
            seen.extend([("cage place", place.x), ("cage place", place.y)]);
            seen.extend([("velocity", speed.x), ("velocity", speed.y)]);
        }
        let balls = machine.layout().bearings[0].balls;
        for j in 0..balls {
            let BallMotion {
                radius,
                radial_speed,
                azimuth,
                orbit_speed,
                spin,
            } = ball_of(machine, state, self.ball(j, balls));
            seen.extend([("position", radius), ("velocity", radial_speed)]);
            seen.push(("angle", self.azimuth(azimuth).sin()));
            seen.push(("angle", self.azimuth(azimuth).cos()));
            seen.extend([
                ("spin", self.spin(orbit_speed)),
                ("ball spin", self.spin(spin)),
            ]);
        }
        // heats and works do not change their sign
        let flows = machine.layout().heat(0)..machine.layout().angular_impulse();
        seen.extend(state[flows].iter().map(|value| ("energy", *value)));
        let impulse = state[machine.layout().angular_impulse()];
        seen.push(("momentum", self.spin(impulse)));
        seen
    }
}

/// The reference machine, off its symmetric position, falling into contact at once.
fn tilted() -> MachineConstants {
    let mut c = reference();
    let g = vec2(2.0, -9.6);
    c.gravity = g;
    c.levitation.carried = -(g * c.rotor.mass());
    c.levitation.centre = vec2(0.05e-3, -0.235e-3);
    c.bearings[0].inner_race.torque = 0.01;
    c.unbalance_angle = 0.4;
    let bearing = planar(&mut c);
    bearing.ball.gravity = g;
    bearing.first_ball_angle = 0.1;
    balance_mount(&mut c);
    c
}

/// Largest difference between the changed answer and the answer of the changed machine, in each kind of quantity
/// relative to its largest value.
fn difference(change: Change, constants: &MachineConstants) -> f64 {
    let original = RotorMachine::new(constants.clone());
    let changed = RotorMachine::new(change.constants(constants));
    // Equal steps: step control looks at components, and other steps would be other errors.
    let settings = equal_steps(4e-3, 5e-7);
    let last = run(&original, &original.start(), &settings);
    let changed_last = run(&changed, &changed.start(), &settings);
    assert!(
        last[INNER + 5] > 50.0,
        "contact was made: {}",
        last[INNER + 5]
    );
    let expected = change.view(&original, &last);
    let seen = Change::Turned(0.0).view(&changed, &changed_last);
    assert_eq!(seen.len(), expected.len());
    let mut worst = 0.0_f64;
    for ((kind, a), (_, b)) in seen.iter().zip(&expected) {
        let of_kind = expected.iter().filter(|(other, _)| other == kind);
        // the machine is nearly at rest by then: its speeds are measured by the fall through the clearance, as the last
        // digit of a ball's place, 3e-18 m, rings at 41 kHz
        let least = if *kind == "velocity" { 0.07 } else { 0.0 };
        let size = of_kind.map(|(_, value)| value.abs()).fold(least, f64::max);
        worst = worst.max((a - b).abs() / size);
    }
    worst
}

/// Rounding of 8000 steps; measured 2e-11.
const TOLERANCE: f64 = 1e-9;

#[test]
fn turning_the_machine_turns_the_answer() {
    for angle in [0.5 * PI, -1.234] {
        let worst = difference(Change::Turned(angle), &tilted());
        assert!(worst < TOLERANCE, "turned by {angle}: {worst}");
    }
}

#[test]
fn mirroring_the_machine_mirrors_the_answer() {
    let worst = difference(Change::Mirrored, &tilted());
    assert!(worst < TOLERANCE, "{worst}");
}

#[test]
fn the_same_holds_for_whatever_keeps_the_balls_apart() {
    for separation in separations() {
        let mut constants = tilted();
        separate(&mut constants, separation);
        for change in [Change::Turned(-1.234), Change::Mirrored] {
            let worst = difference(change, &constants);
            // a light cage between hard stops makes more of the last digit; measured 2e-9
            assert!(worst < 10.0 * TOLERANCE, "{worst}");
        }
    }
}

#[test]
fn the_answer_depends_on_the_direction_of_gravity() {
    // the two tests above could not fail if the views saw nothing
    let constants = tilted();
    let mut other = constants.clone();
    other.gravity = vec2(2.001, -9.6);
    let settings = equal_steps(4e-3, 5e-7);
    let (a, b) = (RotorMachine::new(constants), RotorMachine::new(other));
    let (seen_a, seen_b) = (
        run(&a, &a.start(), &settings),
        run(&b, &b.start(), &settings),
    );
    assert!((seen_a[INNER + 5] / seen_b[INNER + 5] - 1.0).abs() > 100.0 * TOLERANCE);
}
