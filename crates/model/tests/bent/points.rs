//! Accelerations, forces, heats and energies at the random states of the reference.
//!
//! Source: `shared/cases/reference/machine_rhs_points.json`, an independent implementation in the unreduced coordinates of nine
//! nodes, with mounts of every part.

use crate::files::{coordinates, list, machine, number, numbers, pairs, read, shaft, unbalance};
use crate::machines::bent::Shaft;
use crate::machines::vec2;
use model::auxiliary_bearing::probe::{FRICTION_FORCE, NORMAL_FORCE, PENETRATION, SLIP_SPEED};
use model::bearing::ball::BallMotion;
use model::bearing::{BearingConstants, PlanarConstants};
use model::system::machine::RotorMachine;
use nalgebra::DVector;
use number::Vec2;
use serde_json::Value;

fn planar(machine: &RotorMachine, k: usize) -> &PlanarConstants {
    match &machine.constants.bearings[k].bearing {
        BearingConstants::Planar(bearing) => bearing,
        BearingConstants::Rolling(_) => panic!("the reference is planar"),
    }
}

/// The state of a point in our channels.
fn state(machine: &RotorMachine, shaft: &Shaft, point: &Value) -> Vec<f64> {
    let mut machine = machine.clone();
    machine.constants.unbalance_angle = number(point, "phi");
    machine.constants.speed = number(point, "Om");
    let position = coordinates(shaft, &pairs(point, "q"));
    let velocity = coordinates(shaft, &pairs(point, "qd"));
    let mut state = machine.start_with(&position, &velocity);
    for (k, given) in list(point, "bearings").iter().enumerate() {
        let at = machine.layout().bearings[k];
        state[at.inner..at.inner + 6].copy_from_slice(&numbers(given, "inner"));
        state[at.outer..at.outer + 4].copy_from_slice(&numbers(given, "outer"));
        state[at.bearing..at.bearing + 2].copy_from_slice(&numbers(given, "cage"));
        let of_mount = &mut state[at.of_mount()];
        of_mount[..6].copy_from_slice(&numbers(given, "mount"));
        if of_mount.len() > 6 {
            of_mount[6..].copy_from_slice(&numbers(given, "housing"));
        }
        for (ball, values) in list(given, "balls").iter().enumerate() {
            let value = |i: usize| values[i].as_f64().expect("a number");
            let motion = BallMotion {
                radius: value(0),
                radial_speed: value(1),
                azimuth: value(2),
                orbit_speed: value(3),
                spin: value(4),
            };
            planar(&machine, k).set_motion(&mut state[at.bearing..], ball, &motion);
        }
    }
    state
}

/// The worst deviation of each class, relative to the largest of its own.
#[derive(Default)]
struct Worst(Vec<(&'static str, f64)>);

impl Worst {
    fn add(&mut self, class: &'static str, pairs: &[(f64, f64)]) {
        let largest = pairs
            .iter()
            .fold(0.0_f64, |most, pair| most.max(pair.1.abs()));
        let apart = pairs.iter().fold(0.0_f64, |most, (a, b)| {
            assert!(a.is_finite(), "{class}");
            most.max((a - b).abs())
        });
        let apart = if largest > 0.0 {
            apart / largest
        } else {
            apart
        };
        match self.0.iter_mut().find(|(name, _)| *name == class) {
            Some((_, worst)) => *worst = worst.max(apart),
            None => self.0.push((class, apart)),
        }
    }
}

fn both(pairs: impl IntoIterator<Item = (Vec2<f64>, Vec2<f64>)>) -> Vec<(f64, f64)> {
    pairs
        .into_iter()
        .flat_map(|(a, b)| [(a.x, b.x), (a.y, b.y)])
        .collect()
}

/// Accelerations of the nodes from the rate of a state: q̈ = Φ(η̈_G - jΩ̇N + Ω²N).
fn accelerations(
    machine: &RotorMachine,
    shaft: &Shaft,
    state: &[f64],
    rate: &[f64],
) -> Vec<Vec2<f64>> {
    let rotor = machine.layout().rotor;
    let (sine, cosine) = state[rotor.angle()].sin_cos();
    let (spin, spin_rate) = (state[rotor.spin()], rate[rotor.spin()]);
    let own = machine.constants.rotor.coordinates.iter().enumerate();
    let own: Vec<_> = own
        .map(|(k, own)| {
            let offset = own.unbalance * cosine + own.unbalance.turned() * sine;
            let centre = vec2(
                rate[rotor.block(2).start + k],
                rate[rotor.block(3).start + k],
            );
            centre - offset.turned() * spin_rate + offset * (spin * spin)
        })
        .collect();
    let plane = |of: &dyn Fn(&Vec2<f64>) -> f64| {
        &shaft.basis.shapes * DVector::from_iterator(own.len(), own.iter().map(of))
    };
    let (x, y) = (plane(&|a| a.x), plane(&|a| a.y));
    x.iter().zip(y.iter()).map(|(x, y)| vec2(*x, *y)).collect()
}

/// Our heats of a bearing by the names of the reference; that of the mount the last.
const HEATS: [(&str, &str); 10] = [
    ("ball_inner_damping", "inner_contact_damping"),
    ("ball_outer_damping", "outer_contact_damping"),
    ("inner_slip", "inner_ball_slip"),
    ("outer_slip", "outer_ball_slip"),
    ("drag", "drag"),
    ("pocket_damping", "pocket_damping"),
    ("pocket_friction", "pocket_friction"),
    ("rotor_contact_damping", "rotor_race_damping"),
    ("rotor_contact_friction", "rotor_race_friction"),
    ("mount_damper", "mount_damping"),
];

/// Heats of the reference that make ours of a mount.
const MOUNT_HEATS: [&str; 6] = [
    "mount_damper",
    "mount_maxwell",
    "mount_ring",
    "mount_sfd",
    "mount_stop",
    "housing_damper",
];

fn bearing(
    machine: &RotorMachine,
    (k, given): (usize, &Value),
    (rate, probe): (&[f64], &[f64]),
    worst: &mut Worst,
) {
    let layout = machine.layout();
    let at = layout.bearings[k];
    let against = |ours: &[f64], key: &str| -> Vec<(f64, f64)> {
        let reference = numbers(given, key);
        ours.iter().copied().zip(reference).collect()
    };
    let inner = against(&rate[at.inner..at.inner + 6], "d_inner");
    worst.add("race velocity", &inner[..2]);
    worst.add("race acceleration", &inner[2..4]);
    worst.add("race spin", &inner[4..]);
    let outer = against(&rate[at.outer..at.outer + 4], "d_outer");
    worst.add("race acceleration", &outer[2..4]);
    let of_mount = &rate[at.of_mount()];
    let parts = &machine.constants.bearings[k].mount_parts;
    // the rates of what is absent mean nothing in the file
    let theirs = numbers(given, "d_mount");
    for (k, branch) in parts.branches.iter().enumerate() {
        if branch.stiffness > 0.0 {
            let both = |i| (of_mount[2 * k + i], theirs[2 * k + i]);
            worst.add("mount", &[both(0), both(1)]);
        }
    }
    if parts.ring.is_some_and(|ring| ring.stiffness > 0.0) {
        worst.add(
            "mount",
            &[(of_mount[4], theirs[4]), (of_mount[5], theirs[5])],
        );
    }
    if parts.housing.is_some() {
        let housing = numbers(given, "d_housing");
        worst.add(
            "housing",
            &[(of_mount[8], housing[2]), (of_mount[9], housing[3])],
        );
    }
    worst.add(
        "cage",
        &against(&rate[at.bearing..at.bearing + 2], "d_cage"),
    );
    let mut balls = [const { Vec::new() }; 2];
    for (ball, values) in list(given, "d_balls").iter().enumerate() {
        let own = planar(machine, k).motion(&rate[at.bearing..], ball);
        let value = |i: usize| values[i].as_f64().expect("a number");
        balls[0].push((own.radial_speed, value(1)));
        balls[1].push((own.orbit_speed, value(3)));
        balls[1].push((own.spin, value(4)));
    }
    worst.add("ball radial acceleration", &balls[0]);
    worst.add("ball spin", &balls[1]);
    let touches = number(given, "penetration") > 0.0;
    worst.add(
        "penetration",
        &[(probe[at.probe(PENETRATION)], number(given, "penetration"))],
    );
    let force = [
        (probe[at.probe(NORMAL_FORCE)], number(given, "N")),
        (
            probe[at.probe(FRICTION_FORCE)],
            number(given, "friction_on_rotor"),
        ),
    ];
    worst.add("contact force", &force);
    if touches {
        worst.add(
            "slip",
            &[(-probe[at.probe(SLIP_SPEED)], number(given, "slip"))],
        );
    }
    let name = &machine.constants.bearings[k].name;
    let of_mount = MOUNT_HEATS.iter().map(|kind| number(&given["heats"], kind));
    let of_mount: f64 = of_mount.sum();
    let heats: Vec<_> = HEATS
        .iter()
        .map(|(theirs, ours)| {
            let own = layout.heat_of(rate, name, ours).expect("a kind of heat");
            let theirs = match *ours {
                "mount_damping" => of_mount,
                _ => number(&given["heats"], theirs),
            };
            (own, theirs)
        })
        .collect();
    worst.add("heat", &heats);
}

#[test]
fn every_derivative_is_that_of_the_reference() {
    let Some(file) = read("reference", "machine_rhs_points") else {
        return;
    };
    let mut worst = Worst::default();
    let (mut points, mut touching, mut pulled) = (0, 0, 0);
    for given in list(&file, "machines") {
        let mut rotor = shaft(&file["rotor"]);
        rotor.unbalance = unbalance(given);
        let shaft = Shaft::full(rotor);
        let machine = RotorMachine::new(machine(given, &shaft, 0.0));
        let layout = machine.layout();
        for point in list(given, "points") {
            points += 1;
            let state = state(&machine, &shaft, point);
            let (rate, probe) = machine.inspect(&state);
            let ours = accelerations(&machine, &shaft, &state, &rate);
            let pairs: Vec<_> = ours.into_iter().zip(pairs(point, "qdd")).collect();
            let part = |odd: usize| both(pairs.iter().skip(odd).step_by(2).copied());
            worst.add("acceleration of a node", &part(0));
            worst.add("acceleration of a slope", &part(1));
            worst.add("spin", &[(rate[layout.rotor.spin()], number(point, "dOm"))]);
            for (k, of_point) in list(point, "bearings").iter().enumerate() {
                bearing(&machine, (k, of_point), (&rate, &probe), &mut worst);
                touching += u32::from(number(of_point, "penetration") > 0.0);
            }
            let power = |key: &str| number(&point["machine_powers"], key);
            let own = layout.of_rotor;
            let heat = |at: Option<usize>| at.map_or(0.0, |at| rate[layout.heat(at)]);
            let source = |at: Option<usize>| at.map_or(0.0, |at| rate[layout.source(at)]);
            worst.add(
                "power",
                &[
                    (heat(own.damping), power("external_damping_heat")),
                    (heat(own.damping_rotating), power("internal_damping_heat")),
                    (heat(own.drag), power("drag_heat")),
                    (source(Some(1)), power("drive_source")),
                    (source(own.magnets), power("magnets_source")),
                ],
            );
            pulled += u32::from(own.magnets.is_some());
            let kinetic = number(point, "kinetic");
            let content = machine.content(&state);
            worst.add(
                "kinetic energy",
                &[(content.translation + content.spin, kinetic)],
            );
            // the reference counts a preload beside the spring, from its middle
            let preloads = machine.constants.bearings.iter().map(|part| &part.mount);
            let preloads = preloads.map(|m| 0.5 * m.stiffness * m.free_position.length_squared());
            let potential = content.potential - preloads.sum::<f64>();
            worst.add(
                "potential energy",
                &[(potential, number(point, "potential"))],
            );
        }
    }
    println!("{points} points: {:#?}", worst.0);
    assert!(points == 9 && touching >= 9 && pulled == 4, "{touching}");
    for (class, apart) in worst.0 {
        // K q of the highest modes cancels to a small part of itself: the file allows 1e-7 of accelerations of the rotor
        let most = match class {
            "acceleration of a node" | "acceleration of a slope" => 1e-8,
            _ => 1e-9,
        };
        assert!(apart < most, "{class}: {apart}");
    }
}

/// Force on the rotor at a bearing has its datum: the same point with all moved is the same.
#[test]
fn a_datum_moves_everything_with_it() {
    let (constants, start) = crate::machines::bent::bent(3e4);
    let there = RotorMachine::new(constants.clone());
    let mut moved = constants;
    let by = vec2(3e-4, -2e-4);
    for part in &mut moved.bearings {
        part.datum += by;
    }
    let here = RotorMachine::new(moved);
    let mut state = start.clone();
    here.perturb(&mut state, by, &|_, _| 0.0);
    let (before, _) = there.inspect(&start);
    let (after, _) = here.inspect(&state);
    for k in 0..there.layout().ledger() {
        let name = here.layout().channel_name(k);
        let size = before[k].abs().max(1.0);
        assert!(
            (before[k] - after[k]).abs() < 1e-6 * size,
            "{name}: {} {}",
            before[k],
            after[k]
        );
    }
}
