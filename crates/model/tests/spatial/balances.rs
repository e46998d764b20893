//! Momentum, energy and the potential: what no reference is needed for.

use super::setup::*;
use model::spatial::{Assembly, AssemblyConstants};
use number::{Dual, Vec3};
use physics::contact_nodes::{legendre, matched, middle};

fn rates(machine: &AssemblyConstants, state: &[f64]) -> Vec<f64> {
    let mut rate = vec![0.0; state.len()];
    Assembly::<f64>::gather(&|_| machine).rate(state, &mut rate);
    rate
}

fn vector(list: &[f64]) -> Vec3<f64> {
    Vec3::new(list[0], list[1], list[2])
}
fn size(v: Vec3<f64>) -> f64 {
    v.length_squared().sqrt()
}

/// Energies and momenta that move with the rates.
fn moving(state: &[f64], rate: &[f64]) -> Vec<Dual<1>> {
    let both = state.iter().zip(rate);
    both.map(|(value, rate)| Dual {
        value: *value,
        partial: [*rate],
    })
    .collect()
}
fn partial(v: Vec3<Dual<1>>) -> Vec3<f64> {
    Vec3::new(v.x.partial[0], v.y.partial[0], v.z.partial[0])
}

/// Bodies of an assembly with masses, and what moves with each: (mass, first state).
fn masses(machine: &AssemblyConstants) -> Vec<(f64, usize)> {
    let mut all = vec![
        (machine.inner.inertia.mass, machine.body(1)),
        (machine.outer.inertia.mass, machine.body(2)),
    ];
    for (index, row) in machine.rows.iter().enumerate() {
        all.push((row.cage.inertia.mass, machine.body(3 + index)));
    }
    all
}

#[test]
fn momenta_change_by_what_acts_from_outside_alone() {
    let mut random = Random(1);
    for (kind, machine) in every_kind().iter_mut().enumerate() {
        let tau = 0.03;
        machine.inner.torque = tau;
        machine.inner.force = Vec3::new(3.0, -2.0, 5.0);
        machine.inner.moment = Vec3::new(0.1, 0.2, -0.05);
        for _ in 0..5 {
            let state = random_state(machine, &mut random, 1.0);
            let rate = rates(machine, &state);
            let content = machine.content(&moving(&state, &rate));
            let g = machine.gravity;
            let (mut force, mut moment) = (machine.inner.force, machine.inner.moment);
            let at = |first: usize| vector(&state[first..]);
            moment += at(machine.body(1)).cross(machine.inner.force);
            // d/dt of L includes τ a: a from the quaternion
            let q = &state[machine.body(1) + 6..machine.body(1) + 10];
            moment += axis(q) * tau;
            let (mut forces, mut moments) = (0.0, 0.0);
            for (mass, first) in masses(machine) {
                force += g * mass;
                moment += at(first).cross(g) * mass;
                let pushed = vector(&rate[first + 3..]) * mass;
                forces += size(pushed);
                moments += size(at(first).cross(pushed)) + 1e-6 * size(vector(&rate[first + 10..]));
            }
            for (index, row) in machine.rows.iter().enumerate() {
                for j in 0..row.balls {
                    let value = |k| state[ball_state(machine, index, j, k)];
                    let (sine, cosine) = value(2).sin_cos();
                    let place = Vec3::new(value(0) * cosine, value(0) * sine, value(4));
                    force += g * row.ball.mass;
                    moment += place.cross(g) * row.ball.mass;
                    let radial = rate[ball_state(machine, index, j, 1)];
                    forces += row.ball.mass * radial.abs();
                    moments += row.ball.mass * radial.abs() * value(4).abs();
                }
            }
            let missed = partial(content.momentum) - force;
            let turned = partial(content.angular_momentum) - moment;
            assert!(
                size(missed) < 1e-12 * forces,
                "kind {kind}: {missed:?} of {forces}"
            );
            assert!(
                size(turned) < 1e-12 * moments,
                "kind {kind}: {turned:?} of {moments}"
            );
        }
    }
}

fn axis(q: &[f64]) -> Vec3<f64> {
    let [w, x, y, z] = [q[0], q[1], q[2], q[3]];
    let s = 2.0 / (w * w + x * x + y * y + z * z);
    Vec3::new(
        s * (x * z + w * y),
        s * (y * z - w * x),
        1.0 - s * (x * x + y * y),
    )
}

/// Every kind, alone and in a machine with rotor, faces, mount and levitation, and rows whose cages are tied.
fn with_machines() -> Vec<AssemblyConstants> {
    let mut all = every_kind();
    let machines: Vec<_> = all
        .iter()
        .cloned()
        .map(|bearing| machine(bearing, true))
        .collect();
    all.extend(machines);
    for signs in [O, SINGLE] {
        let tied = bearing(signs, TANH, &matched(8.0), Guide::Tied);
        all.extend([machine(tied.clone(), true), tied]);
    }
    let mut held = machine(bearing(X, FOUR, &legendre(3), Guide::Outer), true);
    held.inner.held = true;
    all.push(held);
    let mut soft = sprung();
    soft.spring.as_mut().unwrap().travel = f64::INFINITY;
    all.extend([sprung(), soft]);
    all
}

#[test]
fn energy_is_supplied_or_becomes_heat() {
    let mut random = Random(2);
    let mut pressed = [0; 6];
    for (kind, machine) in with_machines().iter().enumerate() {
        for _ in 0..4 {
            let mut state = random_state(machine, &mut random, 1.0);
            // of a ring that is held and of a tied cage only the turning is free
            let only_turns = |body: usize| match body {
                1 => machine.inner.held,
                _ => body > 2 && !machine.outer.turns,
            };
            for body in (0..3 + machine.rows.len()).filter(|body| only_turns(*body)) {
                let at = machine.body(body);
                if body == 1 {
                    state[at + 3..at + 6].fill(0.0);
                }
                let turning = axis(&state[at + 6..at + 10]) * 600.0;
                state[at + 10..at + 13].copy_from_slice(&[turning.x, turning.y, turning.z]);
            }
            let mut rate = vec![0.0; state.len()];
            let probe = Assembly::<f64>::gather(&|_| machine).rate(&state, &mut rate);
            let content = machine.content(&moving(&state, &rate));
            let ring = machine.body(1);
            let speed_rate = axis(&state[ring + 6..]).dot(vector(&rate[ring + 10..]));
            let growing = probe.growth_impulse * speed_rate;
            let accounts = &rate[machine.first_account()..];
            let (heats, supplies) = accounts.split_at(16);
            assert!(
                heats.iter().all(|heat| *heat >= 0.0),
                "kind {kind}: {heats:?}"
            );
            let change = content.kinetic.partial[0] + content.potential.partial[0];
            let supplied = supplies.iter().sum::<f64>() + growing;
            let residual = change + heats.iter().sum::<f64>() - supplied;
            let terms: f64 = accounts.iter().map(|power| power.abs()).sum::<f64>()
                + content.potential.partial[0].abs();
            assert!(
                residual.abs() < 1e-11 * terms,
                "kind {kind}: {residual} of {terms}"
            );
            for (count, account) in pressed.iter_mut().zip([0, 6, 8, 12, 14, 10]) {
                *count += usize::from(accounts[account] > 0.0);
            }
        }
    }
    // races, pockets, bore, lands, faces and levitation all took part
    assert!(pressed.iter().all(|count| *count > 20), "{pressed:?}");
}

#[test]
fn at_rest_every_force_is_the_slope_of_the_potential() {
    let mut random = Random(3);
    for (kind, machine) in with_machines().iter_mut().enumerate() {
        machine.inner.torque = 0.0;
        machine.inner.force = Vec3::zero();
        machine.inner.moment = Vec3::zero();
        let mut state = random_state(machine, &mut random, 0.0);
        for k in 0..3 + machine.rows.len() {
            // a unit quaternion keeps the sizes of its slopes
            let q = &mut state[machine.body(k) + 6..machine.body(k) + 10];
            let length = q.iter().map(|part| part * part).sum::<f64>().sqrt();
            q.iter_mut().for_each(|part| *part /= length);
        }
        let rate = rates(machine, &state);
        let slope = |changes: &[(usize, f64)]| {
            let mut moved = moving(&state, &vec![0.0; state.len()]);
            for (index, change) in changes {
                moved[*index].partial[0] = *change;
            }
            machine.content(&moved).potential.partial[0]
        };
        let tied = !machine.outer.turns;
        let mut bodies = vec![];
        if let Some(rotor) = &machine.rotor {
            bodies.push((0, rotor.inertia));
        }
        bodies.push((1, machine.inner.inertia));
        bodies.push((2, machine.outer.inertia));
        for (index, row) in machine.rows.iter().enumerate() {
            bodies.push((3 + index, row.cage.inertia));
        }
        let mut largest = 0.0_f64;
        let mut worst = (0.0_f64, String::new());
        let mut compare = |force: f64, slope: f64, what: String| {
            largest = largest.max(slope.abs());
            let miss = (force + slope).abs();
            if miss > worst.0 {
                worst = (miss, what);
            }
        };
        for (body, inertia) in bodies {
            let at = machine.body(body);
            let held = body == 1 && machine.inner.held;
            for k in 0..3 {
                let mut changes = vec![(at + k, 1.0)];
                let mut mass = inertia.mass;
                if tied && body == 2 {
                    for row in 0..machine.rows.len() {
                        changes.push((machine.body(3 + row) + k, 1.0));
                        mass += machine.rows[row].cage.inertia.mass;
                    }
                }
                // rings that slide are a part of the outer ring
                let sliding = machine.spring.filter(|_| body == 2 && k == 2);
                let beside =
                    sliding.map_or(0.0, |own| own.mass * rate[machine.first_sliding() + 1]);
                if !(held || tied && body > 2) {
                    compare(
                        mass * rate[at + 3 + k] + beside,
                        slope(&changes),
                        format!("{body} x{k}"),
                    );
                }
            }
            // turning about an axis of the frame: q' = ½ ω q; compare along the own axis where only that is free
            let q: Vec<f64> = state[at + 6..at + 10].to_vec();
            let (w, v) = (q[0], vector(&q[1..]));
            let a = axis(&q);
            let free_axes = if held || (tied && body > 2) {
                vec![a]
            } else {
                vec![
                    Vec3::new(1.0, 0.0, 0.0),
                    Vec3::new(0.0, 1.0, 0.0),
                    Vec3::new(0.0, 0.0, 1.0),
                ]
            };
            if tied && body == 2 {
                continue;
            }
            for about in free_axes {
                let turned = (about * w + about.cross(v)) * 0.5;
                let changes = [
                    (at + 6, -0.5 * about.dot(v)),
                    (at + 7, turned.x),
                    (at + 8, turned.y),
                    (at + 9, turned.z),
                ];
                let turning = vector(&rate[at + 10..]);
                let along = turning.dot(a);
                let moment = turning * inertia.transverse
                    + a * ((inertia.axial - inertia.transverse) * along);
                // moments count with the radius at which forces act
                let radius = 0.02;
                compare(
                    moment.dot(about) / radius,
                    slope(&changes) / radius,
                    format!("{body} turn {about:?}"),
                );
            }
        }
        if let Some(spring) = machine.spring {
            let at = machine.first_sliding();
            let whole = rate[at + 1] + rate[machine.body(2) + 5];
            compare(spring.mass * whole, slope(&[(at, 1.0)]), "slides".into());
        }
        for (index, row) in machine.rows.iter().enumerate() {
            for j in 0..row.balls {
                let at = |k| ball_state(machine, index, j, k);
                let radius = state[at(0)];
                let mass = row.ball.mass;
                compare(
                    mass * rate[at(1)],
                    slope(&[(at(0), 1.0)]),
                    format!("ball {j} rho"),
                );
                compare(
                    mass * rate[at(5)],
                    slope(&[(at(4), 1.0)]),
                    format!("ball {j} z"),
                );
                let along = mass * radius * rate[at(3)];
                compare(
                    along,
                    slope(&[(at(2), 1.0 / radius)]),
                    format!("ball {j} theta"),
                );
            }
        }
        assert!(
            worst.0 < 1e-11 * largest,
            "kind {kind}: {worst:?} of {largest}"
        );
    }
}

#[test]
fn friction_only_heats_at_every_set_of_nodes() {
    let mut random = Random(4);
    for nodes in [
        middle(),
        legendre(2),
        matched(5.0),
        legendre(5),
        legendre(9),
    ] {
        for law in [TANH, FOUR, ALGEBRAIC] {
            let machine = bearing(O, law, &nodes, Guide::Balls);
            let state = random_state(&machine, &mut random, 3.0);
            for ball in 0..9 {
                let ball = machine.ball(1, ball, &state);
                for (touch, traction) in ball.races.touch.iter().zip(&ball.races.traction) {
                    let (u, d, m) = (touch.slip, touch.turning, traction.couple);
                    let power = traction.force.x * u.x
                        + traction.force.y * u.y
                        + m.x * d.x
                        + m.y * d.y
                        + m.z * d.z;
                    assert!(traction.heat >= 0.0);
                    assert!((power - traction.heat).abs() <= 1e-12 * traction.heat);
                }
            }
        }
    }
}
