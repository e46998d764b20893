//! Coils at their limits, and controllers that start again.

use crate::advance;
use crate::mass::{DELAYED, Mass};
use levitation::{Amplifier, Inputs, LinearControl, StateSpace, Timing};
use physics::magnet::{Magnet, OpposedPair};

/// Each coil of a pair on a current amplifier lags, ends and slews by itself: from its bias of 2 A one rises to its largest current of 3 A, the other
/// falls to nothing, both at 2 A/ms until ω(command - i) is less, then exponentially.
#[test]
fn coils_of_a_pair_end_at_their_own_limits() {
    let (bandwidth, slew, largest) = (1e4, 2e3, 3.0);
    let pair = OpposedPair::of_stiffness(40.0, 1.6e5, 0.5e-3, largest);
    let mut mass = Mass::usual();
    mass.magnet = Magnet::Pair(pair);
    mass.amplifier = Amplifier::Current { bandwidth, slew };
    mass.timing = Timing::Continuous { delay: 0.0 };
    mass.channel = StateSpace::pid(1e3, 0.0, 0.0, 0.0).unwrap();
    let levitation = mass.levitation();
    assert!(levitation.has_coils(0));
    let displacement = -2e-3;
    let mut start = vec![0.0; levitation.states()];
    start[0] = displacement;
    for axis in 0..2 {
        start[levitation.current_states(axis)].fill(2.0);
    }
    let rate = |states: &[f64]| {
        let mut rates = vec![0.0; states.len()];
        let shown = [displacement, 0.0];
        let inputs = Inputs::usual(&shown, &[0.0; 2]);
        levitation.rate(states, inputs, &mut levitation.signals(), &mut rates);
        rates
    };
    let slow = slew / bandwidth;
    let closed = |from: f64, to: f64, time: f64| {
        let way = (to - from).abs();
        let bent = (way - slow) / slew;
        let left = match time < bent {
            true => way - slew * time,
            false => slow * (-bandwidth * (time - bent)).exp(),
        };
        to - (to - from).signum() * left
    };
    for (count, time) in [(200, 2e-4), (500, 5e-4), (1200, 1.2e-3)] {
        let found = advance(&start, 1e-6, count, rate);
        let coils = &found[levitation.current_states(0)];
        assert!((coils[0] - closed(2.0, largest, time)).abs() < 1e-5);
        assert!((coils[1] - closed(2.0, 0.0, time)).abs() < 1e-5);
        let mut signals = levitation.signals();
        let shown = [displacement, 0.0];
        let inputs = Inputs::usual(&shown, &[]);
        levitation.read(&found, inputs, &mut signals);
        assert_eq!(signals.coils[0], [coils[0], coils[1]]);
        assert!((signals.currents[0] - 0.5 * (coils[0] - coils[1])).abs() < 1e-15);
    }
    // the linear analysis sees one control current
    let linear = LinearControl::new(&levitation);
    assert_eq!(linear.a.nrows() + 2, levitation.states());
}

/// A controller that starts on a still rotor: filters and delay give the proportional command at once, integrators and currents nothing.
#[test]
fn a_controller_settles_without_a_kick() {
    let notch = StateSpace::rational("notch", &[1.0, 30.0, 6.3e6], &[1.0, 900.0, 6.3e6]).unwrap();
    for timing in [
        DELAYED,
        Timing::Sampled {
            period: 1e-4,
            computation: 5e-5,
        },
    ] {
        let mut mass = Mass::usual();
        mass.timing = timing;
        mass.channel = mass.channel.then(&notch);
        let levitation = mass.levitation();
        let displacements = [3e-5, -1e-5];
        let inputs = Inputs::usual(&displacements, &[0.0; 2]);
        let mut states = vec![0.7; levitation.states()];
        levitation.settle(&mut states, inputs).unwrap();
        let mut signals = levitation.signals();
        levitation.read(&states, inputs, &mut signals);
        for (axis, displacement) in displacements.iter().enumerate() {
            let wanted = -8000.0 * displacement;
            assert!(
                (signals.commands[axis] - wanted).abs() < 1e-12,
                "{signals:?}"
            );
            assert_eq!(states[levitation.current_states(axis).start], 0.0);
        }
        if let Timing::Continuous { .. } = timing {
            let mut rates = vec![0.0; states.len()];
            levitation.rate(&states, inputs, &mut signals, &mut rates);
            // the integrator takes up the error, the amplifier the command, nothing else moves
            let moving = rates.iter().filter(|rate| rate.abs() > 1e-6).count();
            assert_eq!(moving, 4, "{rates:?}");
        }
    }
}
