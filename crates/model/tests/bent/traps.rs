//! The equations of a rotor that bends, written anew in complex numbers about its axis, and the errors they invite: the model agrees with the
//! equations, and with none of the errors.

use crate::machines::bent::{NODES, Shaft, bent, shaft};
use crate::machines::vec2;
use model::magnets::{MagnetsConstants, SupplyConstants};
use model::system::machine::{MachineConstants, RotorMachine};
use nalgebra::{Complex, DMatrix, DVector};
use number::Vec2;
use solve::Machine;

type C64 = Complex<f64>;
const J: C64 = C64::new(0.0, 1.0);

/// An error that programs make.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Trap {
    /// k_s pulls to the centre.
    MagnetPulls,
    /// k_s stays as it was while the currents decay.
    MagnetStays,
    /// Contact friction by the spins alone.
    SlipOfSpinsAlone,
    /// Friction with the slip.
    FrictionDrives,
    /// The unbalance is a force m e Ω² alone: no part of Ω̇ ...
    NoSpinUpForce,
    /// ... and no reaction on the spin.
    NoReaction,
    /// Rotating damping without its torque on the spin.
    NoTorqueOfDamping,
    /// G and not its half with Ω̇.
    WholeGyroscopic,
    /// Unbalances at φ, without their own angles.
    NoPhases,
    /// The datum added to the rotor.
    DatumAdded,
    /// α = +dy/dz: gyroscopic moments turn the other way.
    NodeTurned,
    /// Damping that does not turn, of the whole mass, disks in it.
    DampedDisks,
    /// Damping that turns taken as one that does not.
    DampingStands,
    /// Weight at the nodes without its moments on their slopes.
    LumpedWeight,
    /// The weight of the unbalance has no moment.
    WeightlessUnbalance,
}

const TRAPS: [Trap; 15] = [
    Trap::MagnetPulls,
    Trap::MagnetStays,
    Trap::SlipOfSpinsAlone,
    Trap::FrictionDrives,
    Trap::NoSpinUpForce,
    Trap::NoReaction,
    Trap::NoTorqueOfDamping,
    Trap::WholeGyroscopic,
    Trap::NoPhases,
    Trap::DatumAdded,
    Trap::NodeTurned,
    Trap::DampedDisks,
    Trap::DampingStands,
    Trap::LumpedWeight,
    Trap::WeightlessUnbalance,
];

fn complex(v: Vec2<f64>) -> C64 {
    C64::new(v.x, v.y)
}

/// Time since the currents were cut, s.
const SINCE: f64 = 1e-3;

/// The machine of the tests with magnets that fade, turning either way, and a state in which it lies in both bearings.
fn touching(speed: f64) -> (Shaft, MachineConstants, Vec<f64>) {
    let shaft = Shaft::reduced(shaft(), 3e4, &[NODES[0], NODES[1], 4, 6]);
    let (mut constants, _) = bent(3e4);
    constants.speed = speed;
    constants.unbalance_angle = 0.7;
    constants.rotor.drag = 1e-4;
    let magnet = (shaft.row(2), vec2(-10.0, 30.0), 1e5);
    constants.magnets = Some(MagnetsConstants::fading([magnet], 300.0, -SINCE));
    let machine = RotorMachine::new(constants.clone());
    let (mut at, mut moving) = (Vec::new(), Vec::new());
    for (k, own) in constants.rotor.coordinates.iter().enumerate() {
        // the slow modes are bent, the quick ones hardly: what is small beside their elastic forces is seen
        let bent = match k {
            0 | 1 => 0.0,
            elastic => 6e-5 / ((elastic - 1) as f64).powi(4),
        };
        at.push(vec2(
            1.6e-4 * own.weight + bent,
            -2.8e-4 * own.weight - bent,
        ));
        moving.push(vec2(0.05 * own.weight + 10.0 * bent, 0.02 / (1 + k) as f64));
    }
    let mut state = machine.start_with(&at, &moving);
    // races that nearly roll: friction is not at its bound, and what makes up the slip is felt
    for (part, at) in constants.bearings.iter().zip(&machine.layout().bearings) {
        let rolling = speed * (1.0 - part.contact.radial_clearance / part.contact.bore_radius);
        let own = [2e-6, -3e-6, 0.01, 0.02, 0.0, rolling];
        state[at.inner.channels()].copy_from_slice(&own);
    }
    (shaft, constants, state)
}

/// η̈_G of all coordinates, then Ω̇.
fn rates(
    shaft: &Shaft,
    constants: &MachineConstants,
    state: &[f64],
    trap: Option<Trap>,
) -> Vec<C64> {
    let is = |other: Trap| trap == Some(other);
    let machine = RotorMachine::new(constants.clone());
    let at = machine.layout().rotor;
    let n = at.coordinates;
    let pair = |block: usize| {
        DVector::from_fn(n, |k, _| {
            C64::new(
                state[at.block(block).start + k],
                state[at.block(block + 1).start + k],
            )
        })
    };
    let (angle, spin) = (state[at.angle()], state[at.spin()]);
    let own = shaft.matrices.project(&shaft.basis.shapes);
    let whole = |m: &DMatrix<f64>| m.map(C64::from);
    let row = |list: &[f64]| DVector::from_fn(n, |k, _| C64::from(list[k]));
    // unbalances at their angles; the state has mass centres, the equations the axis
    let mut offset = DVector::zeros(n);
    let mut inertia = rotor::properties(&shaft.rotor).polar;
    let mut weight_of_unbalance = C64::default();
    let (mut given, mut gravity) = (DVector::zeros(n), complex(constants.gravity));
    for plane in &shaft.rotor.unbalance {
        let phase = if is(Trap::NoPhases) { 0.0 } else { plane.phase };
        let turned = |phase: f64| C64::from_polar(plane.amount, angle + phase);
        offset += row(&shaft.row(plane.node)) * turned(phase);
        given += row(&shaft.row(plane.node)) * turned(plane.phase);
        weight_of_unbalance += J * turned(phase);
    }
    let q = pair(0) - &given;
    let v = pair(2) - &given * (J * spin);
    let gyroscopic =
        whole(&own.gyroscopic) * C64::from(if is(Trap::NodeTurned) { -1.0 } else { 1.0 });
    let half = if is(Trap::WholeGyroscopic) { 1.0 } else { 0.5 };
    let with_spin_up = &gyroscopic * &q * (-J * half) + &offset * J;
    let still = match is(Trap::DampedDisks) {
        // all elements of the machine of the tests are damped alike
        true => {
            let shapes = &shaft.basis.shapes;
            let elastic = shapes.tr_mul(&(&shaft.matrices.stiffness * shapes));
            whole(&(DMatrix::identity(n, n) * 2.0 + elastic * 1e-6))
        }
        false => whole(&own.damping),
    };
    let turning = whole(&own.damping_rotating);
    let seen = match is(Trap::DampingStands) {
        true => v.clone(),
        false => &v - &q * (J * spin),
    };
    let heard = &turning * &seen;
    let squares = shaft.basis.frequencies.iter().map(|omega| omega * omega);
    let stiffness = DVector::from_iterator(n, squares.map(C64::from));
    let ones = DVector::from_fn(shaft.rotor.size(), |i, _| f64::from(u8::from(i % 2 == 0)));
    let mut carried = &shaft.matrices.mass * ones;
    if is(Trap::LumpedWeight) {
        carried
            .iter_mut()
            .skip(1)
            .step_by(2)
            .for_each(|slope| *slope = 0.0);
    }
    let mut force = shaft.basis.shapes.tr_mul(&carried).map(C64::from) * gravity;
    force += &gyroscopic * &v * (J * spin) + &offset * C64::from(spin * spin);
    force -= still * &v + &heard + stiffness.component_mul(&q);
    let mut torque = -constants.rotor.drag * spin;
    if !is(Trap::NoTorqueOfDamping) {
        torque += (&q * J).dotc(&heard).re;
    }
    if is(Trap::WeightlessUnbalance) {
        gravity = C64::default();
    }
    torque += (gravity.conj() * weight_of_unbalance).re;
    let magnets = constants.magnets.as_ref().unwrap();
    for magnet in &magnets.magnets {
        let node = row(&magnet.node);
        let SupplyConstants::Lost { decay_rate, .. } = magnets.supply else {
            panic!("magnets without a controller");
        };
        let left = (-2.0 * decay_rate * SINCE).exp();
        let stiffness = magnet.axes[0].law.position_stiffness();
        let carried = vec2(magnet.axes[0].current, magnet.axes[1].current);
        let mut spring = C64::from(stiffness * left);
        if is(Trap::MagnetPulls) {
            spring = -spring;
        } else if is(Trap::MagnetStays) {
            spring = C64::from(stiffness);
        }
        let pull = complex(carried) * left + spring * node.dotc(&q);
        force += node * pull;
    }
    for (part, place) in constants.bearings.iter().zip(&machine.layout().bearings) {
        let node = row(&part.node);
        let inner = &state[place.inner.channels()];
        let race = C64::new(inner[0], inner[1]);
        let datum = complex(part.datum);
        let centre = match is(Trap::DatumAdded) {
            true => node.dotc(&q) + datum,
            false => node.dotc(&q) - datum,
        };
        let apart = centre - race;
        let normal = apart / apart.norm();
        let tangent = J * normal;
        let relative = node.dotc(&v) - C64::new(inner[2], inner[3]);
        let contact = &part.contact;
        let depth = apart.norm() - contact.radial_clearance;
        let arms = [
            contact.bore_radius - contact.radial_clearance - 0.5 * depth,
            contact.bore_radius + 0.5 * depth,
        ];
        let closing = (relative * normal.conj()).re;
        let push =
            contact.stiffness * depth.powf(contact.exponent) * (1.0 + contact.damping * closing);
        assert!(depth > 0.0 && push > 10.0, "{depth} {push}");
        let across = match is(Trap::SlipOfSpinsAlone) {
            true => 0.0,
            false => (relative * tangent.conj()).re,
        };
        let slip = across + spin * arms[0] - inner[5] * arms[1];
        let sense = if is(Trap::FrictionDrives) { 1.0 } else { -1.0 };
        let friction =
            sense * contact.friction * (slip * contact.inverse_reference_speed).tanh() * push;
        force += node * (tangent * friction - normal * push);
        torque += arms[0] * friction;
    }
    // q̈ = force - Ω̇ p, I Ω̇ + Re(pᴴq̈) = torque
    let felt = if is(Trap::NoSpinUpForce) {
        DVector::zeros(n)
    } else {
        with_spin_up.clone()
    };
    let back = if is(Trap::NoReaction) {
        DVector::zeros(n)
    } else {
        with_spin_up
    };
    inertia -= back.dotc(&felt).re;
    let spin_rate = (torque - back.dotc(&force).re) / inertia;
    let bent = force - felt * C64::from(spin_rate);
    let centres = bent + given * (J * spin_rate - spin * spin);
    let mut out: Vec<C64> = centres.iter().copied().collect();
    out.push(C64::from(spin_rate));
    out
}

#[test]
fn the_model_agrees_with_the_equations_and_with_none_of_the_errors_they_invite() {
    for speed in [900.0, -900.0] {
        let (shaft, constants, state) = touching(speed);
        // rigid motions have no stiffness, whatever an eigen-solver leaves of it
        assert_eq!(&shaft.basis.frequencies[..2], [0.0, 0.0]);
        let machine = RotorMachine::new(constants.clone());
        let (rate, _) = machine.inspect(&state);
        let at = machine.layout().rotor;
        let [x, y] = [2, 3].map(|block| at.block(block).start);
        let found = (0..at.coordinates).map(|k| C64::new(rate[x + k], rate[y + k]));
        let found: Vec<C64> = found.chain([C64::from(rate[at.spin()])]).collect();
        let size = found.iter().map(|value| value.norm()).fold(0.0, f64::max);
        // the spin is slow beside the coordinates and judged by itself
        let apart = |trap: Option<Trap>| {
            let ours = rates(&shaft, &constants, &state, trap);
            let lateral = ours.iter().zip(&found).take(at.coordinates);
            let lateral = lateral
                .map(|(a, b)| (a - b).norm() / size)
                .fold(0.0, f64::max);
            let [spin, of_model] = [&ours, &found].map(|list| list[at.coordinates].re);
            lateral.max((spin / of_model - 1.0).abs())
        };
        let agrees = apart(None);
        assert!(agrees < 1e-9, "{speed}: {agrees:.1e}");
        for trap in TRAPS {
            let seen = apart(Some(trap));
            println!("{speed}: {trap:?} {seen:.1e}");
            assert!(
                seen > 1e4 * agrees.max(1e-13),
                "{speed}: {trap:?} {seen:.1e}"
            );
        }
        assert_eq!(rate.len(), machine.dimension());
    }
}
