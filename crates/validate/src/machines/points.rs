//! Accelerations, forces, heats and energies at random states of machines with mounts of every part, in all coordinates.

use super::given::{Coordinates, machine, rotor};
use crate::compare::{Refusal, Worst};
use crate::json::{array, list, number, pairs};
use crate::report::{Row, Tolerance};
use model::auxiliary_bearing::probe::{FRICTION_FORCE, NORMAL_FORCE, PENETRATION, SLIP_SPEED};
use model::bearing::ball::BallMotion;
use model::bearing::{BearingConstants, PlanarConstants};
use model::body::BodyAt;
use model::mount;
use model::system::machine::RotorMachine;
use number::Vec2;
use serde_json::Value;
use std::path::Path;

const LATERAL: (f64, &str) = (
    1e-7,
    "1e-7 of the largest of its class: accelerations carry the rounding of K q",
);
const CLOSE: (f64, &str) = (1e-9, "1e-9 of the largest of its class at the same point");

/// Our heats of a bearing, and those of the file, besides the mount's.
const HEATS: [(&str, &str); 9] = [
    ("inner_contact_damping", "ball_inner_damping"),
    ("outer_contact_damping", "ball_outer_damping"),
    ("inner_ball_slip", "inner_slip"),
    ("outer_ball_slip", "outer_slip"),
    ("drag", "drag"),
    ("pocket_damping", "pocket_damping"),
    ("pocket_friction", "pocket_friction"),
    ("rotor_race_damping", "rotor_contact_damping"),
    ("rotor_race_friction", "rotor_contact_friction"),
];
/// The file's heats of a mount, in the order of [`mount::HEATS`].
const MOUNT_HEATS: [&str; mount::HEATS.len()] = [
    "mount_damper",
    "mount_maxwell",
    "mount_ring",
    "mount_sfd",
    "mount_stop",
    "housing_damper",
];

/// What is compared of one class: name, unit, tolerance and its reason, pairs (ours, reference).
type Class = (
    &'static str,
    &'static str,
    (f64, &'static str),
    Vec<(f64, f64)>,
);

/// What is compared of one point.
#[derive(Default)]
struct Classes(Vec<Class>);

impl Classes {
    fn add(
        &mut self,
        (name, unit): (&'static str, &'static str),
        allowed: (f64, &'static str),
        pairs: impl IntoIterator<Item = (f64, f64)>,
    ) {
        match self.0.iter_mut().find(|class| class.0 == name) {
            Some(class) => class.3.extend(pairs),
            None => (self.0).push((name, unit, allowed, pairs.into_iter().collect())),
        }
    }
    fn judge(self, worst: &mut Worst) {
        for (name, unit, (share, why), pairs) in self.0 {
            let largest = pairs.iter().fold(0.0_f64, |most, p| most.max(p.1.abs()));
            let mut class = worst.under(Tolerance::Absolute(share * largest), why);
            for (ours, reference) in pairs {
                class.add(name, unit, [reference, ours]);
            }
        }
    }
}

fn planar(machine: &RotorMachine, k: usize) -> Result<&PlanarConstants, String> {
    match &machine.constants.bearings[k].bearing {
        BearingConstants::Planar(bearing) => Ok(bearing),
        _ => Err("a bearing without states of its balls in the plane".to_string()),
    }
}

pub(super) fn rows(file: &Value, _: &Path) -> Result<Vec<Row>, Refusal> {
    let mut worst = Worst::default();
    for given in list(file, "machines")? {
        let coordinates = Coordinates::full(rotor(&file["rotor"], given)?)?;
        if number(given, "t")? != 0.0 {
            return Err("points at another time than 0".into());
        }
        let machine = RotorMachine::new(machine(given, &coordinates, 0.0)?);
        for (at, point) in list(given, "points")?.iter().enumerate() {
            worst.row(&format!("point {}", at + 1), point, |worst| {
                let mut classes = Classes::default();
                compare(&machine, &coordinates, point, &mut classes)?;
                classes.judge(worst);
                Ok(())
            })?;
        }
    }
    Ok(worst.into_rows())
}

/// The state of a point in our channels.
fn state(
    machine: &RotorMachine,
    coordinates: &Coordinates,
    point: &Value,
) -> Result<Vec<f64>, String> {
    let mut turned = machine.clone();
    turned.constants.unbalance_angle = number(point, "phi")?;
    turned.constants.speed = number(point, "Om")?;
    let size = coordinates.rotor.size();
    let position = coordinates.of(&pairs(point, "q", size)?);
    let velocity = coordinates.of(&pairs(point, "qd", size)?);
    let mut state = turned.start_with(&position, &velocity);
    for (k, given) in bearings(machine, point)?.iter().enumerate() {
        let at = machine.layout().bearings[k];
        state[at.inner.channels()].copy_from_slice(&array::<6>(given, "inner")?);
        state[at.outer.channels()].copy_from_slice(&array::<4>(given, "outer")?);
        state[at.bearing..at.bearing + 2].copy_from_slice(&array::<2>(given, "cage")?);
        let of_mount = &mut state[at.of_mount()];
        of_mount[..6].copy_from_slice(&array::<6>(given, "mount")?);
        if of_mount.len() > 6 {
            of_mount[6..].copy_from_slice(&array::<4>(given, "housing")?);
        }
        for (ball, values) in list(given, "balls")?.iter().enumerate().take(at.balls) {
            let [radius, radial_speed, azimuth, orbit_speed, spin] = five(values)?;
            let motion = BallMotion {
                radius,
                radial_speed,
                azimuth,
                orbit_speed,
                spin,
            };
            planar(machine, k)?.set_motion(&mut state[at.bearing..], ball, &motion);
        }
    }
    Ok(state)
}

fn five(values: &Value) -> Result<[f64; 5], String> {
    let found: Option<Vec<f64>> = (values.as_array().into_iter().flatten())
        .map(Value::as_f64)
        .collect();
    let found = found.and_then(|list| <[f64; 5]>::try_from(list).ok());
    found.ok_or_else(|| "a ball is no list of 5 numbers".to_string())
}

fn bearings<'a>(machine: &RotorMachine, point: &'a Value) -> Result<&'a [Value], String> {
    let (given, built) = (list(point, "bearings")?, &machine.constants.bearings);
    match given.len() == built.len() {
        true => Ok(given),
        false => Err("a point has another number of bearings than its machine".to_string()),
    }
}

/// Accelerations of all nodes from the rate of a state: q̈ = Φ(η̈_G - jΩ̇N + Ω²N).
fn accelerations(
    machine: &RotorMachine,
    coordinates: &Coordinates,
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
            let (x, y) = (rotor.block(2).start + k, rotor.block(3).start + k);
            let centre = Vec2::new(rate[x], rate[y]);
            centre - offset.turned() * spin_rate + offset * (spin * spin)
        })
        .collect();
    coordinates.to_nodes(&own)
}

fn both(ours: Vec2<f64>, reference: Vec2<f64>) -> [(f64, f64); 2] {
    [(ours.x, reference.x), (ours.y, reference.y)]
}

fn compare(
    machine: &RotorMachine,
    coordinates: &Coordinates,
    point: &Value,
    classes: &mut Classes,
) -> Result<(), String> {
    let state = state(machine, coordinates, point)?;
    let (rate, probe) = machine.inspect(&state);
    let layout = machine.layout();
    let size = coordinates.rotor.size();
    let nodes = accelerations(machine, coordinates, &state, &rate).into_iter();
    for (k, (ours, reference)) in nodes.zip(pairs(point, "qdd", size)?).enumerate() {
        let class = match k % 2 {
            0 => ("acceleration of a node", "m/s²"),
            _ => ("acceleration of a slope", "rad/s²"),
        };
        classes.add(class, LATERAL, both(ours, reference));
    }
    let spin = (rate[layout.rotor.spin()], number(point, "dOm")?);
    classes.add(("spin acceleration", "rad/s²"), LATERAL, [spin]);
    for (k, given) in bearings(machine, point)?.iter().enumerate() {
        bearing(machine, (k, given), (&state, &rate, &probe), classes)?;
    }
    let power = |key: &str| number(&point["machine_powers"], key);
    let own = layout.of_rotor;
    let heat = |at: Option<usize>| at.map_or(0.0, |at| rate[layout.heat(at)]);
    let source = |at: Option<usize>| at.map_or(0.0, |at| rate[layout.source(at)]);
    let powers = [
        (heat(own.damping), power("external_damping_heat")?),
        (heat(own.damping_rotating), power("internal_damping_heat")?),
        (heat(own.drag), power("drag_heat")?),
        (source(Some(1)), power("drive_source")?),
        (source(own.magnets), power("magnets_source")?),
    ];
    classes.add(("power of rotor, drive and magnets", "W"), CLOSE, powers);
    let content = machine.content(&state);
    // the file counts a preload beside the spring, from the spring's middle
    let preloads = machine.constants.bearings.iter().map(|part| &part.mount);
    let preloads = preloads.map(|m| 0.5 * m.stiffness * m.free_position.length_squared());
    let potential = content.potential - preloads.sum::<f64>();
    let kinetic = content.translation + content.spin;
    let energies = [
        (kinetic, number(point, "kinetic")?),
        (potential, number(point, "potential")?),
    ];
    // the largest energy of the point is the measure of both
    classes.add(("energy", "J"), CLOSE, energies);
    Ok(())
}

fn bearing(
    machine: &RotorMachine,
    (k, given): (usize, &Value),
    (state, rate, probe): (&[f64], &[f64], &[f64]),
    classes: &mut Classes,
) -> Result<(), String> {
    let layout = machine.layout();
    let at = layout.bearings[k];
    let inner: [f64; 6] = array(given, "d_inner")?;
    let outer: [f64; 4] = array(given, "d_outer")?;
    let cage: [f64; 2] = array(given, "d_cage")?;
    let pair = |body: BodyAt, list: &[f64], i: usize| (rate[body.channels().start + i], list[i]);
    classes.add(
        ("velocity of a race", "m/s"),
        CLOSE,
        [0, 1]
            .map(|i| pair(at.inner, &inner, i))
            .into_iter()
            .chain([0, 1].map(|i| pair(at.outer, &outer, i))),
    );
    classes.add(
        ("acceleration of a race", "m/s²"),
        CLOSE,
        [2, 3]
            .map(|i| pair(at.inner, &inner, i))
            .into_iter()
            .chain([2, 3].map(|i| pair(at.outer, &outer, i))),
    );
    classes.add(
        ("spin acceleration of race and cage", "rad/s²"),
        CLOSE,
        [pair(at.inner, &inner, 5), (rate[at.bearing + 1], cage[1])],
    );
    for (ball, values) in list(given, "d_balls")?.iter().enumerate().take(at.balls) {
        let own = planar(machine, k)?.motion(&rate[at.bearing..], ball);
        let [_, radial, _, orbit, spin] = five(values)?;
        let radial = [(own.radial_speed, radial)];
        classes.add(("radial acceleration of a ball", "m/s²"), CLOSE, radial);
        let turning = [(own.orbit_speed, orbit), (own.spin, spin)];
        classes.add(("spin acceleration of a ball", "rad/s²"), CLOSE, turning);
    }
    mount_rates(machine, (k, given), &rate[at.of_mount()], classes)?;
    let penetration = number(given, "penetration")?;
    let ours = probe[at.probe(PENETRATION)];
    classes.add(("penetration", "m"), CLOSE, [(ours, penetration)]);
    let forces = [(NORMAL_FORCE, "N"), (FRICTION_FORCE, "friction_on_rotor")];
    for (kind, key) in forces {
        let pair = (probe[at.probe(kind)], number(given, key)?);
        classes.add(("force of the rotor contact", "N"), CLOSE, [pair]);
    }
    if penetration > 0.0 {
        let slip = (-probe[at.probe(SLIP_SPEED)], number(given, "slip")?);
        classes.add(("slip", "m/s"), CLOSE, [slip]);
    }
    let of_mount = machine.mount(k, state);
    let [x, y] = array(given, "mount_force_on_outer_with_preload")?;
    let force = both(of_mount.force, Vec2::new(x, y));
    classes.add(("force of the mount", "N"), CLOSE, force);
    let name = &machine.constants.bearings[k].name;
    let wanted = &given["heats"];
    for (ours, theirs) in HEATS {
        let own = layout.heat_of(rate, name, ours);
        let own = own.ok_or_else(|| format!("no heat {ours}"))?;
        classes.add(("heat", "W"), CLOSE, [(own, number(wanted, theirs)?)]);
    }
    for (own, theirs) in of_mount.heats.into_iter().zip(MOUNT_HEATS) {
        classes.add(("heat", "W"), CLOSE, [(own, number(wanted, theirs)?)]);
    }
    Ok(())
}

/// Rates of the states of a mount; those of absent parts mean nothing in the files.
fn mount_rates(
    machine: &RotorMachine,
    (k, given): (usize, &Value),
    ours: &[f64],
    classes: &mut Classes,
) -> Result<(), String> {
    let parts = &machine.constants.bearings[k].mount_parts;
    let theirs: [f64; 6] = array(given, "d_mount")?;
    let stiffnesses = parts.branches.iter().map(|branch| branch.stiffness);
    let ring = parts.ring.map(|ring| ring.stiffness);
    for (part, stiffness) in stiffnesses.chain(ring).enumerate() {
        if stiffness > 0.0 {
            let pairs = [0, 1].map(|i| (ours[2 * part + i], theirs[2 * part + i]));
            classes.add(("rate of a mount's state", "m/s"), CLOSE, pairs);
        }
    }
    if parts.housing.is_some() {
        let theirs: [f64; 4] = array(given, "d_housing")?;
        let pairs = [2, 3].map(|i| (ours[6 + i], theirs[i]));
        classes.add(("acceleration of a housing", "m/s²"), CLOSE, pairs);
    }
    Ok(())
}
