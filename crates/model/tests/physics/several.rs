//! Several auxiliary bearings on one rotor.

use crate::machines::{Random, random_state, reference, run, settings, times_mass};
use model::auxiliary_bearing::AuxiliaryBearingConstants;
use model::system::machine::RotorMachine;
use solve::Machine;

const NAMES: [&str; 2] = ["drive_end", "other_end"];

/// The whole rotor on two bearings, each of which carries what that of the half machine does.
pub fn twins(half: &RotorMachine) -> RotorMachine {
    let mut whole = half.constants.clone();
    times_mass(&mut whole, 2.0);
    whole.rotor.polar_inertia *= 2.0;
    whole.rotor.brake_torque *= 2.0;
    whole.levitation.stiffness *= 2.0;
    whole.levitation.damping *= 2.0;
    whole.levitation.carried = whole.levitation.carried * 2.0;
    let part = &half.constants.bearings[0];
    whole.bearings = NAMES
        .map(|name| AuxiliaryBearingConstants {
            name: name.to_string(),
            ..part.clone()
        })
        .to_vec();
    RotorMachine::new(whole)
}

/// Channel of the half machine that a channel of the twins stands for, and whether it belongs to one of the bearings.
fn of_half(whole: &RotorMachine, half: &RotorMachine, channel: usize) -> (usize, bool) {
    let name = whole.channel_name(channel);
    let mut bearings = NAMES.iter();
    let own = bearings.find_map(|part| name.strip_prefix(part)?.strip_prefix('.'));
    let there = half.layout().channel(own.unwrap_or(&name));
    (there.expect("both have it"), own.is_some())
}

/// The state of the twins that stands for one of the half machine.
pub fn of_twins(whole: &RotorMachine, half: &RotorMachine, state: &[f64]) -> Vec<f64> {
    (0..whole.dimension())
        .map(|channel| state[of_half(whole, half, channel).0])
        .collect()
}

#[test]
fn two_bearings_on_the_whole_rotor_are_one_on_half_of_it() {
    let mut random = Random(5);
    let mut braked = reference();
    braked.rotor.brake_torque = 2.0;
    for (constants, levitated) in [(reference(), false), (reference(), true), (braked, false)] {
        let half = RotorMachine::with_levitation(constants.clone(), levitated);
        let whole = RotorMachine::with_levitation(twins(&half).constants, levitated);
        let mut largest = vec![0.0_f64; half.dimension()];
        let mut apart = vec![0.0_f64; whole.dimension()];
        for _ in 0..40 {
            let state = random_state(&half, &mut random);
            let mut mode = half.start_mode();
            mode.brake = 1.0;
            let mut rate = vec![0.0; half.dimension()];
            half.rate(&mode, 0.0, &state, &mut rate, &mut []);
            let mut twice = vec![0.0; whole.dimension()];
            let both = of_twins(&whole, &half, &state);
            whole.rate(&mode, 0.0, &both, &mut twice, &mut []);
            for (k, value) in rate.iter().enumerate() {
                largest[k] = largest[k].max(value.abs());
            }
            for (channel, value) in twice.iter().enumerate() {
                let (there, own) = of_half(&whole, &half, channel);
                // works and impulse of the whole machine count both halves
                let shared = channel >= whole.layout().ledger() && !own;
                let expected = rate[there] * if shared { 2.0 } else { 1.0 };
                apart[channel] = apart[channel].max((value - expected).abs());
            }
        }
        for (channel, apart) in apart.iter().enumerate() {
            let size = largest[of_half(&whole, &half, channel).0];
            let name = whole.channel_name(channel);
            assert!(*apart <= 1e-12 * size, "{name}: {apart} of {size}");
        }
    }
}

#[test]
fn the_ledger_of_several_bearings_closes() {
    let whole = twins(&RotorMachine::new(reference()));
    // the second bearing is another one: more clearance, a softer mount
    let mut other = whole.constants;
    other.bearings[1].contact.radial_clearance *= 1.2;
    other.bearings[1].mount.stiffness *= 0.5;
    other.balance_mounts();
    let machine = RotorMachine::new(other);
    let start = machine.start();
    let end = run(&machine, &start, &settings(20e-3, 1e-5));
    let balance = machine.balance(&start, &end);
    let residual = balance.energy_residual() / balance.heat();
    assert!(residual.abs() < 1e-6, "{residual}");
    let [first, second] = [0, 1].map(|k| machine.layout().bearings[k].inner.spin());
    assert!(
        end[first] > 500.0 && end[second] > 50.0,
        "{} {}",
        end[first],
        end[second]
    );
    let spin = machine.constants.bearings[0].inner_race.inertia * end[first];
    let lost = balance.angular_momentum_residual() / spin;
    assert!(lost.abs() < 1e-7, "{lost}");
}
