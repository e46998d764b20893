//! Whole drops: what closes, what is known in closed form, what a brake and a drive do.

use crate::machines::{
    G, INNER, balance_mount, heat_of, let_roll, observe, planar, reference, run, settings, vec2,
};
use model::auxiliary_bearing::probe::{NORMAL_FORCE, PENETRATION, PENETRATION_SPEED};
use model::rotor::TorqueTables;
use model::schedule::Schedule;
use model::system::machine::layout::ROTOR;
use model::system::machine::{Event, MachineConstants, RotorMachine};
use model::table::Table;
use solve::{Flow, Observer, Step, watch};
use std::f64::consts::PI;

/// Residuals of a run: of the energy, relative to what flowed or moved; of the angular momentum, relative to what the
/// inner race received.
fn residuals(machine: &RotorMachine, start: &[f64], tolerance: f64) -> (f64, f64) {
    let state = run(machine, start, &settings(TWO_IMPACTS, tolerance));
    let (before, after) = (machine.content(start), machine.content(&state));
    let flows = machine.flows(&state);
    let energy = after.energy() - before.energy() + flows.heat - flows.work;
    let size = flows.heat.max(flows.work_size).max(after.translation);
    assert!(flows.heat > 0.1, "the drop has made heat: {}", flows.heat);
    let momentum = after.angular_momentum - before.angular_momentum - flows.angular_impulse;
    let race = machine.constants.bearings[0].inner_race.inertia * state[INNER + 5];
    ((energy / size).abs(), (momentum / race).abs())
}

/// Long enough for two impacts, the first a long slide.
const TWO_IMPACTS: f64 = 0.018;

/// The largest residuals of six drops that start a few nanometres apart: where steps meet the corners of contact forces
/// is chance, and with it the residual of one drop.
fn largest_residuals(constants: &MachineConstants, tolerance: f64) -> (f64, f64) {
    let machine = RotorMachine::new(constants.clone());
    let mut largest = (0.0_f64, 0.0_f64);
    for member in 0..6 {
        let mut start = machine.start();
        machine.perturb(&mut start, vec2(1e-9 * f64::from(member), 0.0), &|_, _| 0.0);
        let (energy, momentum) = residuals(&machine, &start, tolerance);
        largest = (largest.0.max(energy), largest.1.max(momentum));
    }
    largest
}

#[test]
fn energy_and_angular_momentum_close() {
    let mut held = reference();
    held.rotor.spin_held = true;
    for constants in [reference(), held] {
        // measured rms of 16 drops: 9e-7, 2.3e-7 and 3e-8, the largest twice that
        let residuals = [1e-4, 1e-5, 1e-6].map(|t| largest_residuals(&constants, t));
        for ((energy, momentum), bound) in residuals.into_iter().zip([4e-6, 1e-6, 2e-7]) {
            assert!(energy < bound, "energy {residuals:?}");
            // measured 2e-10: the moments of a pair are the same number twice
            assert!(momentum < 1e-8, "angular momentum {residuals:?}");
        }
        assert!(
            residuals[2].0 < 0.3 * residuals[0].0,
            "falls with the tolerance: {residuals:?}"
        );
    }
}

#[test]
fn energy_and_angular_momentum_close_when_the_balls_roll() {
    let mut c = reference();
    let_roll(&mut c);
    let machine = RotorMachine::new(c);
    for (tolerance, energy_bound) in [(1e-4, 1e-6), (1e-6, 1e-7)] {
        let (energy, momentum) = residuals(&machine, &machine.start(), tolerance);
        assert!(
            energy < energy_bound && momentum < 1e-8,
            "{energy} {momentum}"
        );
    }
}

/// A rotor without unbalance, levitated at rest in the middle.
fn balanced() -> MachineConstants {
    let mut c = reference();
    crate::machines::centred(&mut c);
    c
}

/// Instants of first contact and force of the first impact.
#[derive(Default)]
struct Impact {
    begin: Option<f64>,
    peak: f64,
}

impl Observer<RotorMachine> for Impact {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        let opens = step.start_probe(PENETRATION) <= 0.0 && step.end_probe(PENETRATION) > 0.0;
        if opens && self.begin.is_none() {
            let theta = watch::crossing(step, PENETRATION, 0.0, 1.0);
            self.begin = Some(step.time(theta));
        }
        let turns = step.start_probe(PENETRATION_SPEED) > 0.0
            && step.end_probe(PENETRATION_SPEED) <= 0.0
            && step.end_probe(PENETRATION) > 0.0;
        if turns {
            self.peak = self.peak.max(
                watch::maximum(step, 0.0, 1.0, |step, theta| {
                    step.probe(theta, NORMAL_FORCE)
                })
                .1,
            );
        }
        Flow::Continue
    }
}

#[test]
fn a_rotor_falls_freely_through_the_clearance() {
    // √(2·0.25 mm/g) = 7.13921 ms; the race gives way by its own weight, some nanometres of 0.07 m/s
    let machine = RotorMachine::new(balanced());
    let mut impact = Impact::default();
    observe(
        &machine,
        &machine.start(),
        &settings(8e-3, 1e-4),
        &mut impact,
    );
    let begin = impact.begin.expect("contact within 8 ms");
    assert!((begin - 7.13921e-3).abs() < 0.2e-6, "{begin}");
    assert!(
        (begin - (2.0 * 0.25e-3 / G).sqrt()).abs() < 0.2e-6,
        "{begin}"
    );
}

/// A linear contact without losses on a held race.
fn elastic() -> MachineConstants {
    let mut c = balanced();
    c.bearings[0].inner_race.centre_held = true;
    let contact = &mut c.bearings[0].contact;
    contact.exponent = 1.0;
    contact.stiffness = 2e7;
    contact.damping = 0.0;
    contact.friction = 0.0;
    balance_mount(&mut c);
    c
}

#[test]
fn an_elastic_bounce_peaks_at_its_closed_form_and_returns_all_energy() {
    let machine = RotorMachine::new(elastic());
    let mut impact = Impact::default();
    let end = observe(
        &machine,
        &machine.start(),
        &settings(12e-3, 1e-6),
        &mut impact,
    );
    // mg + √((mg)² + 2 k m g h), m 8 kg, k 2e7 N/m, h 0.25 mm
    let weight: f64 = 8.0 * G;
    let expected = weight + (weight * weight + 2.0 * 2e7 * weight * 0.25e-3).sqrt();
    assert!((expected - 967.839).abs() < 1e-3);
    assert!(
        (impact.peak / expected - 1.0).abs() < 1e-5,
        "{}",
        impact.peak
    );
    // on its way up again: the mechanical energy of the rotor is what it was, m g·0
    let s = &end.state;
    let energy = 4.0 * (s[ROTOR + 2].powi(2) + s[ROTOR + 3].powi(2)) + weight * s[ROTOR + 1];
    assert!(s[ROTOR + 3] > 0.0, "rising");
    // relative to the 0.0196 J of the fall; a hundred steps at a tolerance of 1e-6
    assert!((energy / (weight * 0.25e-3)).abs() < 1e-4, "{energy}");
}

/// True where a step ended on an instant to the bit.
struct Lands {
    instant: f64,
    seen: bool,
}

impl Observer<RotorMachine> for Lands {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        self.seen |= step.end == self.instant;
        assert_eq!(step.mode.brake == 1.0, step.start >= self.instant);
        Flow::Continue
    }
}

#[test]
fn a_brake_comes_on_at_its_instant_and_takes_its_work_from_the_spin() {
    let mut c = reference();
    c.schedule = Schedule::of([(1e-3 / 3.0, Event::Brake(1.0))]);
    c.rotor.brake_torque = 5.0;
    let machine = RotorMachine::new(c);
    let start = machine.start();
    let mut lands = Lands {
        instant: 1e-3 / 3.0,
        seen: false,
    };
    // before contact
    let end = observe(&machine, &start, &settings(5e-3, 1e-6), &mut lands).state;
    assert!(lands.seen);
    let braked = 5e-3 - lands.instant;
    let expected = start[ROTOR + 5] - 5.0 / 0.01 * braked;
    assert!(
        (end[ROTOR + 5] - expected).abs() < 1e-9,
        "{}",
        end[ROTOR + 5]
    );
    let lost = 0.5 * 0.01 * (start[ROTOR + 5].powi(2) - end[ROTOR + 5].powi(2));
    let work = end[machine.layout().source(1)];
    assert!((work / -lost - 1.0).abs() < 1e-9, "{work} {lost}");
}

/// I Ω̇ = -a Ω s(t), so Ω = Ω_0 exp(-(a/I) ∫s dt): a load over speed whose share falls on a line, lifts at once, then stays.
#[test]
fn a_torque_by_tables_follows_speed_and_time() {
    let mut c = reference();
    let slope = 2e-3;
    let fastest = 2.0 * c.speed;
    c.rotor.torque = Some(TorqueTables {
        over_speed: Table::through(vec![(0.0, 0.0), (fastest, -slope * fastest)]).unwrap(),
        share_over_time: Table::through(vec![(1e-3, 1.0), (2e-3, 0.5), (2.001e-3, 3.0)]).unwrap(),
    });
    let knots = [1e-3, 2e-3, 2.001e-3];
    c.schedule = Schedule::of(knots.map(|time| (time, Event::Knot)));
    let inertia = c.rotor.polar_inertia;
    for sense in [1.0, -1.0] {
        c.speed = sense * c.speed.abs();
        let machine = RotorMachine::new(c.clone());
        let start = machine.start();
        let end = run(&machine, &start, &settings(5e-3, 1e-6));
        let shares = 1e-3 + 0.75e-3 + 1.75e-6 + 3.0 * 2.999e-3;
        let expected = start[ROTOR + 5] * (-slope / inertia * shares).exp();
        let found = end[ROTOR + 5];
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
        let lost = 0.5 * inertia * (start[ROTOR + 5].powi(2) - found.powi(2));
        let work = end[machine.layout().source(1)];
        assert!((work / -lost - 1.0).abs() < 1e-9, "{work} {lost}");
    }
}

#[test]
fn what_drives_by_a_table_starts_a_rotor_and_what_brakes_only_stops_it() {
    let spin_after = |torque: f64, speed: f64| {
        let mut c = reference();
        c.speed = speed;
        c.rotor.torque = Some(TorqueTables {
            over_speed: Table::constant(torque),
            share_over_time: Table::constant(1.0),
        });
        let machine = RotorMachine::new(c);
        run(&machine, &machine.start(), &settings(5e-3, 1e-6))[ROTOR + 5]
    };
    // 200 N m on 0.01 kg m²
    assert!((spin_after(200.0, 20.0) - 120.0).abs() < 1e-6);
    for sense in [1.0, -1.0] {
        let left = sense * spin_after(-200.0, sense * 20.0);
        assert!((0.0..1e-3).contains(&left), "{left}");
    }
}

#[test]
fn a_brake_stops_and_does_not_reverse() {
    let mut c = reference();
    c.schedule = Schedule::of([(0.0, Event::Brake(1.0))]);
    c.speed = 20.0;
    c.rotor.brake_torque = 200.0;
    let machine = RotorMachine::new(c);
    let end = run(&machine, &machine.start(), &settings(5e-3, 1e-6));
    // at rest within the fading of the brake: 20 000 rad/s² against 1 rad/s
    assert!(
        end[ROTOR + 5] >= 0.0 && end[ROTOR + 5] < 1e-3,
        "{}",
        end[ROTOR + 5]
    );
}

#[test]
fn a_held_spin_stays_and_its_drive_pays_the_friction() {
    let mut c = reference();
    c.rotor.spin_held = true;
    let machine = RotorMachine::new(c);
    let start = machine.start();
    let end = run(&machine, &start, &settings(TWO_IMPACTS, 1e-4));
    assert_eq!(end[ROTOR + 5], start[ROTOR + 5]);
    // the drive pays what the friction takes from the rotor
    let drive = end[machine.layout().source(1)];
    let friction = heat_of(&machine, &end, "rotor_race_friction");
    assert!(drive > friction && friction > 0.1, "{drive} {friction}");
}

#[test]
fn without_friction_nothing_is_spun_up() {
    // without unbalance the machine is the mirror image of itself, and no moment can arise
    let mut c = balanced();
    c.bearings[0].contact.friction = 0.0;
    planar(&mut c).first_ball_angle = 0.5 * PI;
    let mut rolls = c.clone();
    let_roll(&mut rolls);
    for constants in [c, rolls] {
        let machine = RotorMachine::new(constants);
        let end = run(&machine, &machine.start(), &settings(TWO_IMPACTS, 1e-4));
        assert_eq!(end[ROTOR + 5], machine.constants.speed);
        // rounding: a ball at 90° is not quite above the middle
        assert!(end[INNER + 5].abs() < 1e-9, "{}", end[INNER + 5]);
    }
}

#[test]
fn friction_spins_up_the_race_and_oblique_impacts_do_not() {
    let speed = |friction: f64| {
        let mut c = reference();
        c.bearings[0].contact.friction = friction;
        let machine = RotorMachine::new(c);
        run(&machine, &machine.start(), &settings(TWO_IMPACTS, 1e-4))[INNER + 5]
    };
    // measured 497 and 7e-4 rad/s: with unbalance the balls pass on some sideways motion
    assert!(speed(0.15) > 400.0);
    assert!(speed(0.0).abs() < 0.01);
}

#[test]
fn the_race_turns_with_the_rotor() {
    for speed in [400.0 * PI, -400.0 * PI] {
        let mut c = reference();
        c.speed = speed;
        let machine = RotorMachine::new(c);
        let start = machine.start();
        let end = run(&machine, &start, &settings(10e-3, 1e-4));
        assert!(
            end[INNER + 5] * speed > 0.0,
            "race {} rotor {speed}",
            end[INNER + 5]
        );
        assert!(end[ROTOR + 5].abs() < speed.abs(), "the rotor pays");
        // a rotor that turns counter-clockwise rolls off to the left over the bottom of the race, and back whirl begins
        assert!((end[ROTOR] - start[ROTOR]) * speed < 0.0, "{}", end[ROTOR]);
    }
}

#[test]
fn a_levitated_orbit_is_steady() {
    let mut c = reference();
    // the carried weight and the damping act at C, not at G: a drive takes their moment
    c.rotor.spin_held = true;
    c.levitation.centre = vec2(20e-6, -30e-6);
    c.unbalance_angle = 0.7;
    let machine = RotorMachine::with_levitation(c, true);
    let start = machine.start();
    let (rate, _) = machine.inspect(&start);
    let spin = machine.constants.speed;
    let centre = machine.constants.levitation.centre;
    let size = spin * spin * 5e-6;
    for (axis, middle) in [centre.x, centre.y].into_iter().enumerate() {
        let centripetal = -spin * spin * (start[ROTOR + axis] - middle);
        let acceleration = rate[ROTOR + 2 + axis];
        // rounding of the spring's force, k·30 µm
        assert!(
            (acceleration - centripetal).abs() < 1e-9 * size,
            "{acceleration}"
        );
    }
    let radius = |state: &[f64]| (state[ROTOR] - centre.x).hypot(state[ROTOR + 1] - centre.y);
    let end = run(&machine, &start, &settings(0.02, 1e-8));
    // four turns: the tolerance is 1e-8 of the clearance a step
    assert!((radius(&end) / radius(&start) - 1.0).abs() < 1e-5);
    let angle = |state: &[f64]| {
        (state[ROTOR + 1] - centre.y).atan2(state[ROTOR] - centre.x) - state[ROTOR + 4]
    };
    let turn = 2.0 * PI;
    let lag = (angle(&end) - angle(&start)).rem_euclid(turn);
    assert!(lag.min(turn - lag) < 1e-5, "{lag}");
}
