//! Equal rows at one node of the rotor, computed once.

use crate::machines::bent::bent;
use crate::machines::{Blind, Random, by, equal_steps, random_state, reference, settings};
use crate::physics::several::twins;
use model::system::machine::simulate::Steps;
use model::system::machine::{MachineConstants, RotorMachine};
use solve::{Machine, Settings, Stop};

/// The reference machine so many times as heavy, with so many rows in its bearing.
pub fn rows(count: f64) -> MachineConstants {
    let mut whole = twins(&RotorMachine::new(reference())).constants;
    whole.bearings.truncate(1);
    whole.bearings[0].name.clear();
    whole.bearings[0].planes = count;
    let half = 0.5 * count;
    crate::machines::times_mass(&mut whole, half);
    whole.rotor.polar_inertia *= half;
    whole.levitation.stiffness *= half;
    whole.levitation.damping *= half;
    whole.levitation.carried = whole.levitation.carried * half;
    whole
}

/// A rotor that bends with two rows in its first bearing, its start, and the same with one bearing for each of them.
pub fn bent_rows() -> [(MachineConstants, Vec<f64>); 2] {
    let (mut counted, start) = bent(6e4);
    counted.bearings[0].planes = 2.0;
    let mut each = counted.clone();
    each.bearings[0].planes = 1.0;
    let mut other = each.bearings[0].clone();
    other.name = "second_row".to_string();
    each.bearings.insert(1, other);
    let machine = RotorMachine::new(each.clone());
    let at = RotorMachine::new(counted.clone());
    let named = |channel| {
        at.layout().channel(
            &machine
                .channel_name(channel)
                .replace("second_row", "drive_end"),
        )
    };
    let started =
        (0..machine.dimension()).map(|channel| start[named(channel).expect("both have it")]);
    let started = started.collect();
    [(counted, start), (each, started)]
}

fn end(machine: &RotorMachine, start: &[f64], settings: &Settings, steps: Steps) -> Vec<f64> {
    let ending = by(steps, machine, start, settings, &mut Blind);
    assert_eq!(ending.stop, Stop::Finished);
    ending.state
}

#[test]
fn a_bearing_of_two_rows_under_the_whole_rotor_is_one_under_half_of_it_to_the_bit() {
    let (half, whole) = (RotorMachine::new(reference()), RotorMachine::new(rows(2.0)));
    let own = half.layout();
    let twice = |channel: usize| {
        // works of the rotor and the impulse are those of the whole machine
        let rotor = own.source(0)..own.source(own.bearings[0].source);
        match rotor.contains(&channel) || channel == own.angular_impulse() {
            true => 2.0,
            false => 1.0,
        }
    };
    let same = |half: &[f64], whole: &[f64]| {
        for (channel, (half, whole)) in half.iter().zip(whole).enumerate() {
            assert_eq!(
                half * twice(channel),
                *whole,
                "{}",
                own.channel_name(channel)
            );
        }
    };
    let mut random = Random(7);
    for _ in 0..40 {
        let state = random_state(&half, &mut random);
        let [(one, seen), (two, twice_seen)] =
            [&half, &whole].map(|machine| machine.inspect(&state));
        same(&one, &two);
        assert_eq!(seen, twice_seen);
    }
    let start = half.start();
    assert_eq!(start, whole.start());
    for (steps, tolerance) in [(Steps::Explicit, 1e-4), (Steps::Implicit, 1e-2)] {
        let settings = settings(0.012, tolerance);
        let [one, two] = [&half, &whole].map(|machine| end(machine, &start, &settings, steps));
        same(&one, &two);
        assert!(one[own.bearings[0].inner.spin()] > 100.0);
    }
}

#[test]
fn two_rows_computed_once_are_two_bearings_at_one_node() {
    let point = rows(2.0);
    let whole = RotorMachine::new(point.clone());
    let both = twins(&RotorMachine::new(reference()));
    let start = crate::physics::several::of_twins(&both, &whole, &whole.start());
    let rigid = [(point, whole.start()), (both.constants, start)];
    // equal steps: both take the same ones. In implicit steps of a rotor that bends nodes of one place are kept 1e-9 apart, and rounding
    // over that is left
    let explicit = (Steps::Explicit, 5e-7, 1e-9);
    for (what, pair, until, implicit) in [
        ("rigid", rigid, 8e-3, 1e-9),
        ("bent", bent_rows(), 9e-3, 1e-6),
    ] {
        for (steps, length, bound) in [explicit, (Steps::Implicit, 1e-6, implicit)] {
            let [(once, counted), (each, separate)] = pair.each_ref().map(|(constants, start)| {
                let machine = RotorMachine::new(constants.clone());
                let state = end(&machine, start, &equal_steps(until, length), steps);
                (machine, state)
            });
            let spin = once.layout().bearings[0].inner.spin();
            assert!(
                counted[spin] > 30.0,
                "{what} was not touched: {}",
                counted[spin]
            );
            let inner = once.layout().bearings[0].inner.channels();
            let rows = (0..=once.layout().rotor.spin()).chain(inner);
            for channel in rows {
                let name = once.channel_name(channel);
                let there = (each.layout().channel(&name))
                    .or_else(|| each.layout().channel(&format!("drive_end.{name}")));
                let (here, there) = (counted[channel], separate[there.expect("both have it")]);
                let scale = once.error_scale(channel).max(here.abs());
                let apart = (here - there).abs() / scale;
                assert!(apart < bound, "{what} {steps:?} {name}: {here} {there}");
            }
        }
    }
}

#[test]
fn the_ledger_counts_every_row() {
    let started = |constants: MachineConstants| {
        let start = RotorMachine::new(constants.clone()).start();
        (constants, start)
    };
    let mut moved = rows(3.0);
    // a datum beside the line of levitation
    moved.bearings[0].datum = crate::machines::vec2(8e-6, -5e-6);
    let [counted, _] = bent_rows();
    for (constants, start) in [started(rows(2.0)), started(moved), counted] {
        for (steps, tolerance) in [(Steps::Explicit, 1e-5), (Steps::Implicit, 2e-5)] {
            let machine = RotorMachine::new(constants.clone());
            let state = end(&machine, &start, &settings(20e-3, tolerance), steps);
            let balance = machine.balance(&start, &state);
            let residual = balance.energy_residual() / balance.heat();
            assert!(residual.abs() < 1e-6, "{steps:?}: {residual}");
            let spin = state[machine.layout().bearings[0].inner.spin()];
            assert!(spin > 100.0, "{spin}");
            // over the impulse from outside, where that is more
            let part = &machine.constants.bearings[0];
            let turned = part.planes * part.inner_race.inertia * spin;
            let turned = turned.max(balance.angular_impulse().abs());
            let lost = balance.angular_momentum_residual() / turned;
            assert!(lost.abs() < 1e-6, "{steps:?}: {lost}");
        }
    }
}
