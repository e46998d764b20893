//! A housing that carries several bearings, magnets and seals, against a bearing on a housing of its own and against a base that moves.

use crate::bent::ledger::residuals;
use crate::machines::bent::bent;
use crate::machines::{Random, vec2};
use model::base::{BaseConstants, HalfSine};
use model::bearing::{BearingConstants, RollingConstants};
use model::magnets::MagnetsConstants;
use model::mount::{Housing, MaxwellBranch};
use model::rotor::Coordinate;
use model::schedule::Schedule;
use model::seal::SealConstants;
use model::system::machine::simulate::Steps;
use model::system::machine::{Event, MachineConstants, RotorMachine};
use model::table::Table;
use number::Vec2;
use solve::Machine;

const HOUSING: Housing<f64> = Housing {
    mass: 2.5,
    stiffness: 3e7,
    damping: 2e3,
};

/// A row over the coordinates with one more, the housing, before them.
fn longer(row: &[f64], of_housing: f64) -> Vec<f64> {
    std::iter::once(of_housing)
        .chain(row.iter().copied())
        .collect()
}

/// The same machine with a housing: its bearings for which `on` is true, its magnets and its seals stand on it.
pub fn housed(mut constants: MachineConstants, on: [bool; 2]) -> MachineConstants {
    let row = 1.0 / HOUSING.mass.sqrt();
    let count = constants.rotor.coordinates.len();
    let rotor = &mut constants.rotor;
    rotor.coordinates.insert(
        0,
        Coordinate {
            frequency: 0.0,
            mass: 1.0,
            weight: HOUSING.mass.sqrt(),
            unbalance: Vec2::zero(),
        },
    );
    rotor.housings = 1;
    let own = |matrix: &mut Vec<f64>| {
        if !matrix.is_empty() {
            let rows = matrix.chunks_exact(count).flat_map(|row| longer(row, 0.0));
            *matrix = vec![0.0; count + 1].into_iter().chain(rows).collect();
        }
    };
    own(&mut rotor.gyroscopic);
    own(&mut rotor.damping);
    own(&mut rotor.damping_rotating);
    for (bearing, on) in constants.bearings.iter_mut().zip(on) {
        bearing.node = longer(&bearing.node, 0.0);
        let own = longer(&vec![0.0; count], row);
        bearing.mount_parts.on = on.then_some(own);
    }
    for magnet in constants
        .magnets
        .iter_mut()
        .flat_map(|own| &mut own.magnets)
    {
        magnet.node = longer(&magnet.node, -row);
    }
    for plane in &mut constants.unbalances {
        plane.node = longer(&plane.node, 0.0);
    }
    for seal in &mut constants.seals {
        seal.node = longer(&seal.node, -row);
    }
    let (k, c) = (HOUSING.stiffness, HOUSING.damping);
    constants.seals.push(SealConstants {
        node: longer(&vec![0.0; count], row),
        centre: Vec2::zero(),
        carried: constants.gravity * -HOUSING.mass,
        rows: vec![(0.0, [k, 0.0, 0.0, k], [c, 0.0, 0.0, c])],
    });
    constants
}

/// A base that moves, magnets that fade, a seal.
fn driven(mut constants: MachineConstants) -> MachineConstants {
    let table = |points: Vec<(f64, f64)>| Table::through(points).unwrap();
    let base = BaseConstants {
        record: [3.0, -5.0].map(|a| table(vec![(0.0, 0.0), (0.005, a), (0.01, 0.0)])),
        shocks: vec![HalfSine {
            start: 0.0,
            duration: 0.011,
            acceleration: vec2(4.0, 12.0),
        }],
    };
    constants.schedule = Schedule::of(base.knots().map(|time| (time, Event::Knot)));
    constants.base = Some(base);
    let magnet = (constants.bearings[0].node.clone(), vec2(-10.0, 30.0), 1e5);
    constants.magnets = Some(MagnetsConstants::fading([magnet], 500.0, 0.0));
    constants.seals = vec![SealConstants {
        node: constants.bearings[1].node.clone(),
        centre: vec2(2e-5, -1e-5),
        carried: Vec2::zero(),
        rows: vec![(0.0, [2e5, 5e4, -3e4, 1e5], [200.0, 30.0, 10.0, 100.0])],
    }];
    constants
}

/// A state within the range of a drop; `like` gives its size.
fn random(machine: &RotorMachine, like: &[f64], random: &mut Random) -> Vec<f64> {
    let mut state = vec![0.0; machine.dimension()];
    let shared = like.len().min(state.len());
    state[..shared].copy_from_slice(&like[..shared]);
    for at in &machine.layout().bearings {
        for (list, size) in [(at.outer.centre(), 1e-5), (at.outer.velocity(), 0.2)] {
            for channel in list {
                state[channel] = random.within(size);
            }
        }
    }
    state
}

/// Channels of the coordinates of a rotor, without its housings: x, y, ẋ, ẏ, and angle and spin.
fn of_rotor(machine: &RotorMachine) -> Vec<usize> {
    let at = machine.layout().rotor;
    let housings = machine.constants.rotor.housings;
    let blocks = (0..4).flat_map(|k| at.block(k).skip(housings));
    blocks.chain([at.angle(), at.spin()]).collect()
}

/// Displacement and velocity of the only housing, into a state.
fn put(machine: &RotorMachine, state: &mut [f64], motion: [Vec2<f64>; 2]) {
    let at = machine.layout().rotor;
    for (k, value) in motion.iter().flat_map(|own| [own.x, own.y]).enumerate() {
        state[at.block(k).start] = value * HOUSING.mass.sqrt();
    }
}

#[test]
fn a_bearing_on_it_alone_is_a_bearing_on_a_housing_of_its_own() {
    let (mut constants, start) = bent(3e4);
    constants.bearings[1].mount_parts.branches = vec![MaxwellBranch {
        stiffness: 8e6,
        rate: 1.0 / 3e-4,
    }];
    let mut alone = driven(constants);
    alone.magnets = None;
    alone.seals.clear();
    let shared = RotorMachine::new(housed(alone.clone(), [false, true]));
    alone.bearings[1].mount_parts.housing = Some(HOUSING);
    let alone = RotorMachine::new(alone);
    let mut numbers = Random(11);
    let named = |machine: &RotorMachine, name: &str| {
        let mut all = 0..machine.dimension();
        all.find(|k| machine.channel_name(*k) == name)
            .unwrap_or_else(|| panic!("{name}"))
    };
    for _ in 0..20 {
        let state = random(&alone, &start, &mut numbers);
        let mut alone_state = state.clone();
        let motion = [1e-5, 0.2].map(|size| vec2(numbers.within(size), numbers.within(size)));
        for (quantity, value) in ["x", "y", "x_speed", "y_speed"].iter().zip([
            motion[0].x,
            motion[0].y,
            motion[1].x,
            motion[1].y,
        ]) {
            let name = format!("other_end.mount.housing.{quantity}");
            alone_state[named(&alone, &name)] = value;
        }
        let mut shared_state = vec![0.0; shared.dimension()];
        let pairs: Vec<(usize, usize)> = (of_rotor(&alone).into_iter())
            .zip(of_rotor(&shared))
            .chain((0..alone.dimension()).filter_map(|k| {
                let name = alone.channel_name(k);
                let other = name.starts_with("rotor") || name.contains("housing");
                (k < alone.layout().ledger() && !other).then(|| (k, named(&shared, &name)))
            }))
            .collect();
        for (from, to) in &pairs {
            shared_state[*to] = alone_state[*from];
        }
        put(&shared, &mut shared_state, motion);
        let (wanted, _) = alone.inspect_in(&alone.start_mode(), 2e-3, &alone_state);
        let (seen, _) = shared.inspect_in(&shared.start_mode(), 2e-3, &shared_state);
        for (from, to) in &pairs {
            let (wanted, seen) = (wanted[*from], seen[*to]);
            let size = wanted.abs().max(1.0);
            assert!(
                (wanted - seen).abs() < 1e-9 * size,
                "{}: {wanted} {seen}",
                alone.channel_name(*from)
            );
        }
        let at = shared.layout().rotor;
        for (block, quantity) in [(2, "x_speed"), (3, "y_speed")] {
            let name = format!("other_end.mount.housing.{quantity}");
            let wanted = wanted[named(&alone, &name)];
            let seen = seen[at.block(block).start] / HOUSING.mass.sqrt();
            assert!(
                (wanted - seen).abs() < 1e-9 * wanted.abs(),
                "{wanted} {seen}"
            );
        }
        let energy = |machine: &RotorMachine, state: &[f64]| {
            let own = machine.content(state);
            own.translation + own.spin + own.potential
        };
        // the spring of the shared one is a source, and its weight is balanced by one
        let spring = 0.5 * HOUSING.stiffness * motion[0].length_squared();
        let weight = -HOUSING.mass * shared.constants.gravity.dot(motion[0]);
        let (wanted, seen) = (energy(&alone, &alone_state), energy(&shared, &shared_state));
        assert!((wanted - seen - spring + weight).abs() < 1e-9 * wanted.abs());
    }
}

/// Bearings that are bushings: their rings are all that moves with them.
fn on_bushings() -> (MachineConstants, Vec<f64>) {
    let (mut constants, start) = bent(3e4);
    for part in &mut constants.bearings {
        let radius = part.contact.bore_radius;
        part.bearing = BearingConstants::Rolling(RollingConstants::bushing(radius));
        part.inner_race.mass = 0.0;
        part.inner_race.inertia = part.outer_race_mass * radius * radius;
    }
    // damping by mass is that of the ground
    constants.rotor.damping.clear();
    constants.balance_mounts();
    (driven(constants), start)
}

#[test]
fn seen_from_it_everything_on_it_moves_as_on_a_base_that_is_accelerated_so() {
    let (constants, start) = on_bushings();
    let still = RotorMachine::new(constants.clone());
    let housed = RotorMachine::new(housed(constants.clone(), [true, true]));
    let mut numbers = Random(3);
    for _ in 0..20 {
        let relative = random(&still, &start, &mut numbers);
        let motion = [1e-5, 0.2].map(|size| vec2(numbers.within(size), numbers.within(size)));
        let mut state = vec![0.0; housed.dimension()];
        let rotor: Vec<_> = of_rotor(&still)
            .into_iter()
            .zip(of_rotor(&housed))
            .collect();
        for (from, to) in &rotor {
            state[*to] = relative[*from];
        }
        let races = still
            .layout()
            .bearings
            .iter()
            .zip(&housed.layout().bearings);
        let races: Vec<_> = races
            .flat_map(|(from, to)| {
                let places = from.outer.centre().into_iter().zip(to.outer.centre());
                places.chain(from.outer.velocity().into_iter().zip(to.outer.velocity()))
            })
            .collect();
        for (from, to) in &races {
            state[*to] = relative[*from];
        }
        // and all of it moves with the housing
        let at = housed.layout().rotor;
        let shift = motion.iter().flat_map(|own| [own.x, own.y]);
        let shift: Vec<f64> = shift.collect();
        for (k, own) in (1..).zip(housed.constants.rotor.own_coordinates()) {
            for (block, by) in shift.iter().enumerate() {
                state[at.block(block).start + k] += by * own.weight / own.mass;
            }
        }
        for own in races.chunks(4) {
            for ((_, to), by) in own.iter().zip(&shift) {
                state[*to] += by;
            }
        }
        put(&housed, &mut state, motion);
        let (rate, _) = housed.inspect_in(&housed.start_mode(), 2e-3, &state);
        let of_housing = [2, 3].map(|block| rate[at.block(block).start] / HOUSING.mass.sqrt());

        // the base takes over what the housing does, and has the motion of the base besides
        let mut accelerated = constants.clone();
        let base = accelerated.base.as_mut().unwrap();
        let own = base.acceleration(2e-3);
        base.shocks.clear();
        base.record = [own.x + of_housing[0], own.y + of_housing[1]].map(Table::constant);
        let accelerated = RotorMachine::new(accelerated);
        let (wanted, _) = accelerated.inspect_in(&accelerated.start_mode(), 2e-3, &relative);
        let masses = housed.constants.rotor.own_coordinates();
        for (k, own) in masses.iter().enumerate() {
            for axis in 0..2 {
                let wanted = wanted[still.layout().rotor.block(2 + axis).start + k];
                let share = of_housing[axis] * own.weight / own.mass;
                let seen = rate[at.block(2 + axis).start + 1 + k] - share;
                let size = wanted.abs().max(share.abs()).max(1.0);
                assert!((wanted - seen).abs() < 1e-9 * size, "{k}: {wanted} {seen}");
            }
        }
        for (k, (from, to)) in races.iter().enumerate().filter(|(k, _)| k % 4 >= 2) {
            let (wanted, seen) = (wanted[*from], rate[*to] - of_housing[k % 2]);
            assert!(
                (wanted - seen).abs() < 1e-9 * wanted.abs().max(1e3),
                "{k}: {wanted} {seen}"
            );
        }
    }
}

#[test]
fn energy_and_angular_momentum_close_with_all_of_it_on_a_housing() {
    let (constants, start) = bent(3e4);
    let mut constants = housed(driven(constants), [true, true]);
    // angular momentum of a bearing counts from its datum
    constants.bearings[1].datum = Vec2::zero();
    let machine = RotorMachine::new(constants.clone());
    let plain = RotorMachine::new(bent(3e4).0);
    let mut state = vec![0.0; machine.dimension()];
    for (from, to) in of_rotor(&plain).into_iter().zip(of_rotor(&machine)) {
        state[to] = start[from];
    }
    let (from, to) = (
        plain.layout().rotor.channels(),
        machine.layout().rotor.channels(),
    );
    let others = plain.layout().ledger() - from;
    state[to..to + others].copy_from_slice(&start[from..from + others]);
    for (tolerance, energy, momentum) in [(1e-4, 1e-5, 1e-7), (1e-6, 1e-7, 1e-9)] {
        let (lost, turned) = residuals(constants.clone(), &state, Steps::Explicit, tolerance, 0.03);
        assert!(
            lost.abs() < energy && turned.abs() < momentum,
            "{lost} {turned}"
        );
    }
}
