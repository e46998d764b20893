//! Momentum, angular momentum, energy and heat at random states.
//!
//! What acts from outside is computed here a second time, from the sections of the model's pages; everything inside
//! must cancel.

use super::relatives::{lubricant_factors, machines};
use crate::machines::{
    BEARING, INNER, OUTER, Random, ball_of, bearing_part, let_roll, planar, race_motion,
    random_state, reference, vec2,
};
use model::auxiliary_bearing::probe::{COUNT as DETAIL, LARGEST_INNER_LOAD, LARGEST_OUTER_LOAD};
use model::bearing::ball_states::CAGE_PLACE;
use model::bearing::land::LandRace;
use model::bearing::{
    BearingConstants, PlanarConstants, Separation, SharedMoment, SteadyMoment, seat,
};
use model::system::machine::RotorMachine;
use model::system::machine::layout::ROTOR;
use number::Vec2;
use physics::traction::{SlipLaw, TanhTraction, Traction, TractionLaw};

const STATES: u32 = 300;

/// Calls with every machine, at many states: (machine, state, rate, probe).
fn at_random_states(mut check: impl FnMut(&RotorMachine, &[f64], &[f64], &[f64])) {
    for (number, machine) in machines().iter().enumerate() {
        // the ninth meets the states of the first, from which it differs by its traction law alone
        let mut random = Random((number % 8) as u64);
        for _ in 0..STATES {
            let state = random_state(machine, &mut random);
            let (rate, probe) = machine.inspect(&state);
            check(machine, &state, &rate, &probe);
        }
    }
}

fn pair(list: &[f64], at: usize) -> Vec2<f64> {
    vec2(list[at], list[at + 1])
}

/// A sum that remembers how large its terms were.
#[derive(Default)]
struct Sum {
    total: f64,
    size: f64,
}

impl Sum {
    fn add(&mut self, term: f64) {
        self.total += term;
        self.size += term.abs();
    }
    /// What is left, relative to the terms.
    fn rest(&self) -> f64 {
        self.total.abs() / self.size
    }
}

/// Centre of a ball with its speed and acceleration, Cartesian.
fn ball_centre(machine: &RotorMachine, state: &[f64], rate: &[f64], j: usize) -> [Vec2<f64>; 3] {
    let (now, change) = (ball_of(machine, state, j), ball_of(machine, rate, j));
    let (s, c) = now.azimuth.sin_cos();
    let (e_r, e_t) = (vec2(c, s), vec2(-s, c));
    let w = now.orbit_speed;
    [
        e_r * now.radius,
        e_r * now.radial_speed + e_t * (now.radius * w),
        e_r * (change.radial_speed - now.radius * w * w)
            + e_t * (now.radius * change.orbit_speed + 2.0 * now.radial_speed * w),
    ]
}

/// Bodies that translate: (mass, position, velocity, acceleration).
fn centres(machine: &RotorMachine, state: &[f64], rate: &[f64]) -> Vec<(f64, [Vec2<f64>; 3])> {
    let c = &machine.constants;
    let mut list: Vec<_> = [
        (c.rotor.mass(), ROTOR),
        (c.bearings[0].inner_race.mass, INNER),
        (c.bearings[0].outer_moving_mass(), OUTER),
    ]
    .map(|(mass, at)| {
        (
            mass,
            [pair(state, at), pair(state, at + 2), pair(rate, at + 2)],
        )
    })
    .to_vec();
    if let BearingConstants::Planar(bearing) = &c.bearings[0].bearing {
        for j in 0..bearing.balls {
            list.push((bearing.ball.mass, ball_centre(machine, state, rate, j)));
        }
        if matches!(bearing.separation, Separation::FreeCage(_)) {
            list.push((bearing.cage_mass, cage_centre(machine, state, rate)));
        }
    }
    list
}

/// Centre of a free cage with its speed and acceleration.
fn cage_centre(machine: &RotorMachine, state: &[f64], rate: &[f64]) -> [Vec2<f64>; 3] {
    let (now, change) = (bearing_part(machine, state), bearing_part(machine, rate));
    [
        pair(now, CAGE_PLACE),
        pair(now, CAGE_PLACE + 2),
        pair(change, CAGE_PLACE + 2),
    ]
}

/// Bodies that spin: (inertia, spin, spin acceleration).
fn spins(machine: &RotorMachine, state: &[f64], rate: &[f64]) -> Vec<(f64, f64, f64)> {
    let c = &machine.constants;
    let race = c.bearings[0].inner_race.inertia;
    let mut list = vec![
        (c.rotor.polar_inertia, state[ROTOR + 5], rate[ROTOR + 5]),
        (race, state[INNER + 5], rate[INNER + 5]),
    ];
    match &machine.constants.bearings[0].bearing {
        BearingConstants::Spatial(_) => panic!("the bearing lies in the plane"),
        BearingConstants::Rolling(b) => {
            list.push((b.set.inner_inertia(), state[INNER + 5], rate[INNER + 5]));
        }
        BearingConstants::Planar(b) => {
            let part = (bearing_part(machine, state), bearing_part(machine, rate));
            if !matches!(b.separation, Separation::Neighbours(_)) {
                list.push((b.cage_inertia, part.0[1], part.1[1]));
            }
            // a ball that rolls turns by σ cos α about an axis across its line of contact: its energy and its share along z
            let rolls = b.ball.radius / b.ball.ball_radius;
            let inertia = 0.4 * b.ball.mass * (b.ball.ball_radius * rolls).powi(2);
            for j in 0..b.balls {
                let (now, change) = (ball_of(machine, state, j), ball_of(machine, rate, j));
                list.push((inertia, now.spin, change.spin));
            }
        }
    }
    list
}

/// Force of the levitation on the rotor, with the point where it acts.
fn levitation(machine: &RotorMachine, state: &[f64]) -> (Vec2<f64>, Vec2<f64>) {
    let m = &machine.constants;
    let (s, c) = state[ROTOR + 4].sin_cos();
    let e = m.rotor.coordinates[0].unbalance.x;
    let centre = pair(state, ROTOR) - vec2(c, s) * e;
    let velocity = pair(state, ROTOR + 2) - vec2(-s, c) * (e * state[ROTOR + 5]);
    let l = &m.levitation;
    let on = solve::Machine::start_mode(machine).levitation;
    let force = l.carried - (centre - l.centre) * l.stiffness - velocity * l.damping;
    (force * on, centre)
}

fn mount(machine: &RotorMachine, state: &[f64]) -> Vec2<f64> {
    let mount = &machine.constants.bearings[0].mount;
    let stretch = pair(state, OUTER) - mount.free_position;
    -(stretch * mount.stiffness + pair(state, OUTER + 2) * mount.damping)
}

#[test]
fn momentum_changes_by_outer_forces_alone() {
    let mut worst = 0.0_f64;
    at_random_states(|machine, state, rate, _| {
        let c = &machine.constants;
        if c.bearings[0].inner_race.centre_held {
            return;
        }
        let (mut x, mut y) = (Sum::default(), Sum::default());
        let mut add = |force: Vec2<f64>| {
            x.add(force.x);
            y.add(force.y);
        };
        for (mass, [_, _, acceleration]) in centres(machine, state, rate) {
            add(acceleration * mass);
            add(c.gravity * -mass);
        }
        add(-levitation(machine, state).0);
        add(-mount(machine, state));
        if let BearingConstants::Planar(bearing) = &c.bearings[0].bearing {
            for j in 0..bearing.balls {
                let ball = ball_of(machine, state, j);
                let (s, co) = ball.azimuth.sin_cos();
                let drag = bearing.ball.orbit_drag * ball.radius * ball.orbit_speed;
                add(vec2(-s, co) * drag);
            }
        }
        worst = worst.max(x.rest()).max(y.rest());
    });
    // rounding of forces of some kN
    assert!(worst < 1e-9, "{worst}");
}

/// Moment of the bearing on the outer race about its centre: traction of the balls on their true arms; of rolling balls friction.
fn moment_on_outer_race(machine: &RotorMachine, state: &[f64], rate: &[f64]) -> f64 {
    match &machine.constants.bearings[0].bearing {
        BearingConstants::Spatial(_) => panic!("the bearing lies in the plane"),
        BearingConstants::Rolling(b) => {
            let (_, probe) = machine.inspect(state);
            let mut push = vec2(0.0, 0.0);
            for j in 0..b.balls {
                let (s, c) = (bearing_part(machine, state)[0] + seat(j, b.balls)).sin_cos();
                push += vec2(c, s) * probe[DETAIL + j];
            }
            let turning = (pair(state, INNER) - pair(state, OUTER)).cross(push);
            let (drag, _) = lubricant_factors(&b.lubricant, bearing_part(machine, state));
            let steady = match &b.moment {
                SteadyMoment::Palmgren(law) => {
                    let parts = law.parts(state[INNER + 5], push.length_squared().sqrt());
                    drag * parts.speed_dependent + parts.load_dependent
                }
                other => panic!("{other:?} is not used here"),
            };
            // F = q|Ω̇| against the rotation, on the same arm at both races
            let (spin, acceleration) = (state[INNER + 5], rate[INNER + 5]);
            let loss = b.set.pocket_friction_arm() * b.loss.force(spin, acceleration);
            steady + loss + (1.0 - b.set.cage_speed(1.0)) * turning
                - b.set.outer_inertia() * rate[INNER + 5]
        }
        BearingConstants::Planar(b) => {
            let motion = race_motion(machine, state);
            let part = bearing_part(machine, state);
            let (_, warmed) = lubricant_factors(&b.lubricant, part);
            let steady = (b.moment.as_ref()).map_or(0.0, |moment| {
                steady_moment_on_outer_race(machine, state, rate, b, moment)
            });
            let tractions: f64 = (0..b.balls)
                .map(|j| {
                    let reaction = b.ball_reaction(&motion, part, j);
                    let [inner, outer] = reaction.contacts();
                    let coefficient = warmed * b.traction.at_races(&inner, &outer).1;
                    let traction = coefficient * reaction.outer_load;
                    let [centre, ..] = ball_centre(machine, state, rate, j);
                    let distance = (centre - pair(state, OUTER)).length_squared().sqrt();
                    let approach = distance + b.ball.radius - b.ball.outer_track;
                    -(b.ball.outer_track + 0.5 * approach) * traction
                })
                .sum();
            let land = land_moment_on_outer_race(machine, state, b);
            tractions + steady + land + inlet_couples_on_outer_race(machine, state, b)
        }
    }
}

/// What the oil in the inlets does to the outer race: the opposite of the couples that slow the balls. Contacts at an angle
/// show the plane the cosine of their rolling, and of its couple.
fn inlet_couples_on_outer_race(machine: &RotorMachine, state: &[f64], b: &PlanarConstants) -> f64 {
    let Some(inlets) = &b.inlet_rolling else {
        return 0.0;
    };
    let motion = race_motion(machine, state);
    let cosine = 1.0 / b.ball.load_per_radial_force;
    (0..b.balls)
        .map(|j| {
            let reaction = b.ball_reaction(&motion, bearing_part(machine, state), j);
            let [_, contact] = reaction.contacts();
            let spin = ball_of(machine, state, j).spin;
            -cosine * inlets.outer.couple(&contact, cosine * spin)
        })
        .sum()
}

/// Friction of a cage that rides in the outer race, about that race's centre.
fn land_moment_on_outer_race(machine: &RotorMachine, state: &[f64], b: &PlanarConstants) -> f64 {
    let Separation::FreeCage(Some(land)) = &b.separation else {
        return 0.0;
    };
    let contact = &land.contact;
    let part = bearing_part(machine, state);
    let e = pair(part, CAGE_PLACE) - pair(state, OUTER);
    let n = e * (1.0 / e.length_squared().sqrt());
    let depth = e.dot(n) - contact.radial_clearance;
    if land.race == LandRace::Inner || depth <= 0.0 {
        return 0.0;
    }
    let past = pair(part, CAGE_PLACE + 2) - pair(state, OUTER + 2);
    let force = contact.stiffness * depth * (1.0 + contact.damping * past.dot(n));
    let surface = part[1] * (contact.bore_radius - contact.radial_clearance - 0.5 * depth);
    let slide = past.dot(n.turned()) + surface;
    let friction = contact.friction * (slide * contact.inverse_reference_speed).tanh();
    (contact.bore_radius + 0.5 * depth) * friction * force.max(0.0)
}

/// What the pairs of the steady moment do to the outer race about its centre: drag on the orbit at the balls' distance,
/// couples against their spin.
fn steady_moment_on_outer_race(
    machine: &RotorMachine,
    state: &[f64],
    rate: &[f64],
    b: &PlanarConstants,
    moment: &SharedMoment,
) -> f64 {
    let motion = race_motion(machine, state);
    let part = bearing_part(machine, state);
    let (n, r, track) = (b.balls as f64, b.ball.radius, b.ball.inner_track);
    let s = r / track;
    let reactions: Vec<_> = (0..b.balls)
        .map(|j| b.ball_reaction(&motion, part, j))
        .collect();
    let mut push = vec2(0.0, 0.0);
    for (j, reaction) in reactions.iter().enumerate() {
        let [centre, ..] = ball_centre(machine, state, rate, j);
        let from_inner = centre - pair(state, INNER);
        push += from_inner * (reaction.inner_load / from_inner.length_squared().sqrt());
    }
    let load = push.length_squared().sqrt();
    let (drag, _) = lubricant_factors(&b.lubricant, part);
    let law = |speed: f64| moment.law.parts(speed, load, 0.0).with_drag(drag);
    let inner_sum: f64 = reactions.iter().map(|reaction| reaction.inner_load).sum();
    // what stands for no load: a tenth of what an equal share asks of the inner race
    let at_speed = moment
        .law
        .parts(motion.inner.spin.abs().max(1.0), load, 0.0);
    let idle = 0.1 * at_speed.sum() / (n * track);
    let mut on_race = 0.0;
    for (j, reaction) in reactions.iter().enumerate() {
        let [centre, velocity, _] = ball_centre(machine, state, rate, j);
        let arm = centre - pair(state, OUTER);
        let distance = arm.length_squared().sqrt();
        // speed past the outer race, times distance
        let turning = arm.cross(velocity - pair(state, OUTER + 2)) / (distance * distance);
        let spin = ball_of(machine, state, j).spin;
        let share = (reaction.inner_load + idle) / (inner_sum + n * idle);
        let drag =
            2.0 * moment.orbit_share / track * law(2.0 * (1.0 + s) * turning).speed_dependent;
        let couple = 2.0 * s * (1.0 - moment.orbit_share) * law(2.0 * s * spin).speed_dependent;
        let rolling =
            s / (1.0 + s) * law(1000.0).load_dependent * (spin / moment.reference_spin).tanh();
        on_race += share * (drag * distance + couple + rolling);
    }
    on_race
}

#[test]
fn angular_momentum_changes_by_outer_moments_alone() {
    let (mut worst, mut worst_ledger) = (0.0_f64, 0.0_f64);
    at_random_states(|machine, state, rate, _| {
        let c = &machine.constants;
        let mut change = Sum::default();
        for (mass, [position, _, acceleration]) in centres(machine, state, rate) {
            change.add(mass * position.cross(acceleration));
        }
        for (inertia, _, acceleration) in spins(machine, state, rate) {
            change.add(inertia * acceleration);
        }
        let mut outer = Sum::default();
        for (mass, [position, ..]) in centres(machine, state, rate) {
            outer.add(mass * position.cross(c.gravity));
        }
        let (force, at) = levitation(machine, state);
        outer.add(at.cross(force));
        outer.add(pair(state, OUTER).cross(mount(machine, state)));
        outer.add(c.bearings[0].inner_race.torque);
        outer.add(-c.rotor.brake_torque * state[ROTOR + 5].tanh());
        // the ground keeps the outer race from turning
        outer.add(-moment_on_outer_race(machine, state, rate));
        match &c.bearings[0].bearing {
            BearingConstants::Spatial(_) => panic!("the bearing lies in the plane"),
            // the angular momentum of the balls that the inner race does not feel
            BearingConstants::Rolling(b) => change.add(b.set.outer_inertia() * rate[INNER + 5]),
            BearingConstants::Planar(b) => {
                outer.add(-b.cage_drag * bearing_part(machine, state)[1]);
                for j in 0..b.balls {
                    let ball = ball_of(machine, state, j);
                    outer.add(-b.ball.orbit_drag * ball.radius * ball.radius * ball.orbit_speed);
                    outer.add(-b.ball.spin_drag * ball.spin);
                }
            }
        }
        let size = change.size + outer.size;
        worst = worst.max((change.total - outer.total).abs() / size);
        let ledger = rate[machine.layout().angular_impulse()];
        worst_ledger = worst_ledger.max((ledger - outer.total).abs() / size);
    });
    assert!(worst < 1e-9, "{worst}");
    assert!(worst_ledger < 1e-9, "{worst_ledger}");
}

#[test]
fn every_loss_is_passive() {
    let mut seen = std::collections::BTreeMap::new();
    at_random_states(|machine, _, rate, _| {
        for (index, entry) in machine.layout().heats().iter().enumerate() {
            let heat = rate[machine.layout().heat(index)];
            assert!(heat >= 0.0, "{} {heat}", entry.kind);
            *seen.entry(entry.kind).or_insert(0) += u32::from(heat > 0.0);
        }
    });
    for (name, count) in seen {
        assert!(count > 100, "{name} was at work {count} times");
    }
}

/// d/dt of the potential: its directional derivative along the rate, by central differences of order four.
fn potential_rate(machine: &RotorMachine, state: &[f64], rate: &[f64]) -> f64 {
    // motions of 1e-9 m against approaches of 1e-6 m: truncation near 1e-12, rounding near 1e-11
    const H: f64 = 2e-9;
    let at = |steps: f64| {
        let moved: Vec<f64> = state
            .iter()
            .zip(rate)
            .map(|(y, f)| y + steps * H * f)
            .collect();
        machine.content(&moved).potential
    };
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * H)
}

#[test]
fn energy_changes_by_sources_less_heats() {
    let mut errors = Vec::new();
    at_random_states(|machine, state, rate, _| {
        let mut power = Sum::default();
        for (mass, [_, velocity, acceleration]) in centres(machine, state, rate) {
            power.add(mass * velocity.dot(acceleration));
        }
        for (inertia, spin, acceleration) in spins(machine, state, rate) {
            power.add(inertia * spin * acceleration);
        }
        power.add(potential_rate(machine, state, rate));
        for kind in 0..machine.layout().heats().len() {
            power.add(rate[machine.layout().heat(kind)]);
        }
        for source in 0..machine.layout().sources().len() {
            power.add(-rate[machine.layout().source(source)]);
        }
        errors.push(power.rest());
    });
    // a contact that opens within the difference of 4e-9 s breaks its order: all stay below 1e-6, nearly all far below
    errors.sort_by(f64::total_cmp);
    let (most, worst) = (errors[errors.len() * 99 / 100], errors[errors.len() - 1]);
    assert!(worst < 1e-6 && most < 1e-8, "{most} {worst}");
}

#[test]
fn contents_are_those_of_the_bodies() {
    at_random_states(|machine, state, rate, _| {
        let content = machine.content(state);
        let bodies = centres(machine, state, rate);
        let turning = spins(machine, state, rate);
        let translation: f64 = bodies
            .iter()
            .map(|(m, b)| 0.5 * m * b[1].length_squared())
            .sum();
        let spin: f64 = turning.iter().map(|(i, w, _)| 0.5 * i * w * w).sum();
        // rounding of sums of a few tens of terms
        assert!((content.translation / translation - 1.0).abs() < 1e-13);
        assert!((content.spin / spin - 1.0).abs() < 1e-13);
        if matches!(
            machine.constants.bearings[0].bearing,
            BearingConstants::Planar(_)
        ) {
            let orbits = bodies.iter().map(|(m, b)| m * b[0].cross(b[1]));
            let total: f64 = orbits.chain(turning.iter().map(|(i, w, _)| i * w)).sum();
            let size: f64 = turning.iter().map(|(i, w, _)| (i * w).abs()).sum();
            assert!((content.angular_momentum - total).abs() < 1e-13 * size);
        }
    });
}

#[test]
fn rolling_balls_carry_the_angular_momentum_of_their_motion() {
    // orbit ω_c on R(1+s), spin against Ω by Ω/(2s): the bearing's own inertias are not used here
    let mut c = reference();
    let p = planar(&mut c).clone();
    let (r, track) = (p.ball.radius, p.ball.inner_track);
    let s = r / track;
    let cage_speed = 1.0 / (2.0 * (1.0 + s));
    let ball_spin = -1.0 / (2.0 * s);
    let balls_mass = p.balls as f64 * p.ball.mass;
    let expected = (balls_mass * (track + r).powi(2) + p.cage_inertia) * cage_speed
        + 0.4 * balls_mass * r * r * ball_spin;
    let_roll(&mut c);
    let machine = RotorMachine::new(c);
    let mut state = machine.start();
    let at_rest = machine.content(&state).angular_momentum;
    state[INNER + 5] = 1000.0;
    let race = machine.constants.bearings[0].inner_race.inertia * 1000.0;
    let balls = machine.content(&state).angular_momentum - at_rest - race;
    // the difference of two momenta a thousand times larger
    assert!((balls / (1000.0 * expected) - 1.0).abs() < 1e-11, "{balls}");
}

#[test]
fn pocket_and_cage_answer_each_other() {
    let (mut worst, mut pressed) = (0.0_f64, 0);
    at_random_states(|machine, state, rate, _| {
        let BearingConstants::Planar(b) = &machine.constants.bearings[0].bearing else {
            return;
        };
        let Traction::Tanh(law) = &b.traction else {
            return;
        };
        if b.moment.is_some() || b.separation != Separation::CentredCage {
            return;
        }
        let motion = race_motion(machine, state);
        let part = bearing_part(machine, state);
        // what the cage receives, from its own acceleration
        let cage = b.cage_inertia * bearing_part(machine, rate)[1] + b.cage_drag * part[1];
        let mut sum = Sum::default();
        sum.add(cage);
        for j in 0..b.balls {
            let (moment, size) = moment_from_pocket(machine, state, rate, j, law);
            sum.total += moment;
            sum.size += size;
            pressed += u32::from(b.ball_reaction(&motion, part, j).pocket_force > 0.0);
        }
        worst = worst.max(sum.rest());
    });
    assert!(pressed > 1000, "half of the pockets press");
    // rounding of the forces on the balls
    assert!(worst < 1e-9, "{worst}");
}

/// Moment about the outer race's centre that a ball receives from its pocket: what its motion needs beyond races,
/// drag and weight. With the size of what it is the rest of.
fn moment_from_pocket(
    machine: &RotorMachine,
    state: &[f64],
    rate: &[f64],
    j: usize,
    law: &TanhTraction<f64>,
) -> (f64, f64) {
    let BearingConstants::Planar(b) = &machine.constants.bearings[0].bearing else {
        panic!("the bearing is planar here")
    };
    let motion = race_motion(machine, state);
    let reaction = b.ball_reaction(&motion, bearing_part(machine, state), j);
    let [centre, velocity, acceleration] = ball_centre(machine, state, rate, j);
    let (now, change) = (ball_of(machine, state, j), ball_of(machine, rate, j));
    let (r, mass) = (b.ball.radius, b.ball.mass);
    let mut force = (acceleration - b.ball.gravity) * mass;
    // the plane's share of a ball that turns by σ cos α across its line of contact; r is the ball's times cos α
    let mut moment = 0.4 * mass * r * r * change.spin + b.ball.spin_drag * now.spin;
    let grown = b.ball.inner_track_growth * motion.inner.spin * motion.inner.spin;
    let tangent = vec2(-now.azimuth.sin(), now.azimuth.cos());
    force += tangent * (b.ball.orbit_drag * velocity.dot(tangent));
    for (race, load, slip, out, track) in [
        (
            &motion.inner,
            reaction.inner_load,
            reaction.inner_slip,
            1.0,
            b.ball.inner_track + grown,
        ),
        (
            &motion.outer,
            reaction.outer_load,
            reaction.outer_slip,
            -1.0,
            b.ball.outer_track,
        ),
    ] {
        let from_race = centre - race.position;
        let distance = from_race.length_squared().sqrt();
        let n = from_race * (1.0 / distance);
        let traction = law.coefficient(slip) * load;
        let approach = out * (track - distance) + r;
        let radial = load / b.ball.load_per_radial_force;
        force = force - n * (out * radial) - n.turned() * traction;
        moment += out * (r - 0.5 * approach) * traction;
    }
    let arm = centre - motion.outer.position;
    (
        arm.cross(force) + moment,
        mass * acceleration.length_squared().sqrt() * b.ball.pocket_radius,
    )
}

#[test]
fn detail_and_probes_are_those_of_the_balls() {
    at_random_states(|machine, state, _, probe| {
        let BearingConstants::Planar(b) = &machine.constants.bearings[0].bearing else {
            return;
        };
        if b.separation != Separation::CentredCage {
            return;
        }
        let motion = race_motion(machine, state);
        let part = &state[BEARING..machine.layout().ledger()];
        let (mut inner, mut outer) = (0.0_f64, 0.0_f64);
        for j in 0..b.balls {
            let r = b.ball_reaction(&motion, part, j);
            let expected = [
                r.inner_load,
                r.outer_load,
                r.inner_slip,
                r.outer_slip,
                r.pocket_force,
            ];
            for (kind, value) in expected.into_iter().enumerate() {
                assert_eq!(probe[DETAIL + kind * b.balls + j], value);
            }
            inner = inner.max(r.inner_load);
            outer = outer.max(r.outer_load);
        }
        assert_eq!(
            (probe[LARGEST_INNER_LOAD], probe[LARGEST_OUTER_LOAD]),
            (inner, outer)
        );
    });
}
