//! Pairs under load: slopes, poles, margins and limits about the static position, against closed forms of one mass.

use crate::mass::Mass;
use levitation::response::{Limit, Loaded, equilibrium, excesses, unbalance};
use levitation::sensitivity::{Band, Sensitivity};
use levitation::{
    Amplifier, C64, ClosedLoop, Control, Inputs, Levitation, StateSpace, Timing, Verdict, verdict,
};
use nalgebra::DVector;
use physics::magnet::{Magnet, OpposedPair};
use rotor::Unbalance;

const KI: f64 = 80.0;
const KS: f64 = 4e5;
const SPEED: f64 = 500.0;

/// 25 kg on pairs of 2.5 A of bias whose controller acts at once; gains as of the loops that are unstable under load.
fn mass(gains: [f64; 3]) -> Mass {
    let [proportional, integral, derivative] = gains;
    Mass {
        mass: 25.0,
        magnet: Magnet::Pair(OpposedPair::of_stiffness(KI, KS, 0.5e-3, 10.0)),
        amplifier: Amplifier::Direct,
        timing: Timing::Continuous { delay: 0.0 },
        channel: StateSpace::pid(proportional, integral, derivative, 5e-5).unwrap(),
    }
}

/// The levitation without corners of sensors, axes along x and y.
fn levitation(mass: &Mass) -> Levitation {
    let (mut sensors, mut actuators) = mass.axes();
    for sensor in &mut sensors {
        sensor.corner = None;
        sensor.axis.angle -= 0.3;
    }
    for actuator in &mut actuators {
        actuator.axis.angle -= 0.3;
    }
    let control = Control::Channels(vec![mass.channel.clone(); 2]);
    Levitation::new(1, sensors, control, mass.timing, actuators).unwrap()
}

fn loaded(mass: &Mass, load: [f64; 2]) -> Loaded {
    let (plant, levitation) = (mass.plant(), levitation(mass));
    let rest = equilibrium(&plant, &levitation, &DVector::from_vec(load.to_vec())).unwrap();
    Loaded::about(rest, &plant, &levitation, SPEED).unwrap()
}

/// With an integrator the mass rests at x = 0: i_s = F/k_i, k_s(i_s) = k_s[1 + (i_s/i₀)²], k_i as without load. Each pole then is
/// a root of mλ² - k_s(i_s) + k_i C(λ).
#[test]
fn poles_about_a_loaded_pair_are_those_of_its_raised_stiffness() {
    let gains = [8500.0, 5e4, 60.0];
    let mass = mass(gains);
    let found = loaded(&mass, [0.0, -179.2]);
    let static_current = 179.2 / KI;
    assert!((found.rest.currents[1] - static_current).abs() < 1e-9);
    let (ki, ks) = found.rest.slopes[1];
    let raised = KS * (1.0 + (static_current / 2.5_f64).powi(2));
    // positions of 1e-13 m are left of the search for the equilibrium: 1e-9 of the slopes
    assert!((ki / KI - 1.0).abs() < 1e-9 && (ks / raised - 1.0).abs() < 1e-9);
    let poles = found.closed.poles().unwrap();
    let residual = |value: C64, ks: f64| {
        let control = gains[0] + gains[1] / value + gains[2] * value / (1.0 + 5e-5 * value);
        (25.0 * value * value - ks + KI * control).norm() / (25.0 * value.norm_sqr() + ks)
    };
    for pole in &poles {
        // the axis without load keeps k_s
        let least = residual(pole.value, raised).min(residual(pole.value, KS));
        assert!(least < 1e-8, "{}: {least:e}", pole.value);
    }
    let Verdict::Unstable(value) = verdict(&poles) else {
        panic!("{poles:?}");
    };
    assert!(residual(value, raised) < 1e-8);
    let centre = ClosedLoop::new(mass.plant(), &levitation(&mass)).unwrap();
    assert_eq!(verdict(&centre.poles().unwrap()), Verdict::Stable);
}

fn lower_margin(closed: &ClosedLoop<f64>) -> Option<f64> {
    let poles = closed.poles().unwrap();
    let band = Band::of_speed(SPEED);
    Sensitivity::new(closed, &poles, band)
        .unwrap()
        .margins(0)
        .lower_gain
}

/// Without integrator the loop is lost at ω = 0 first, with g k_i K_p = k_s; with a slow one below the band, of 1 Hz and more.
#[test]
fn the_lower_gain_margin_counts_from_standing_still() {
    let of = |gains: [f64; 3]| {
        let mass = mass(gains);
        lower_margin(&loaded(&mass, [0.0, 0.0]).closed)
    };
    let found = of([9000.0, 0.0, 60.0]).unwrap();
    assert!((found / (KS / (KI * 9000.0)) - 1.0).abs() < 1e-9, "{found}");
    for integral in [50.0, 500.0, 5e4] {
        let found = of([9000.0, integral, 60.0]).unwrap();
        let stable = |share: f64| {
            let gains = [9000.0, integral, 60.0].map(|gain| gain * share * found);
            let closed = loaded(&mass(gains), [0.0, 0.0]).closed;
            verdict(&closed.poles().unwrap()) == Verdict::Stable
        };
        // straight lines between 120 points a decade: some 1e-4 of the margin
        assert!(stable(1.001) && !stable(0.999), "{integral}: {found}");
    }
}

/// Biases of 3 and 2 A carry k_i/2 A: what is left for the control current is F/k_i - ½ A, and k_s about i_s = F/k_i is that of equal ones.
#[test]
fn unequal_biases_take_a_part_of_the_load_off_the_controller() {
    let pair = OpposedPair::of_stiffness(KI, KS, 0.5e-3, 10.0).with_bias_difference(1.0);
    let mut mass = mass([8500.0, 5e4, 60.0]);
    mass.magnet = Magnet::Pair(pair);
    let found = loaded(&mass, [-100.0, -100.0]).rest;
    for (current, slopes) in found.currents.iter().zip(&found.slopes) {
        assert!((current - (100.0 / KI - 0.5)).abs() < 1e-9);
        let raised = KS * (1.0 + (100.0 / KI / 2.5_f64).powi(2));
        assert!((slopes.0 / KI - 1.0).abs() < 1e-9 && (slopes.1 / raised - 1.0).abs() < 1e-9);
    }
}

/// Amplitudes against the start itself at a quarter turn: the voltage is gain (command - current) there.
#[test]
fn static_part_and_amplitude_are_those_of_the_motion_and_pass_a_limit_together() {
    let (gain, load) = (200.0, [0.0, -100.0]);
    let mut mass = mass([8500.0, 5e4, 60.0]);
    mass.amplifier = Amplifier::Voltage {
        inductance: 16e-3,
        resistance: 1.5,
        gain: Some(gain),
        largest_voltage: 1.0,
    };
    let imbalance = [Unbalance {
        node: 0,
        amount: 5e-4,
        phase: 0.4,
    }];
    let mut limited = levitation(&mass);
    let found = loaded(&mass, load);
    let turning = unbalance(&found.closed, &imbalance, SPEED).unwrap();
    let all = |levitation: &Levitation| excesses(levitation, &found.rest, Some(&turning), SPEED);
    // of coils without limit of their own only voltage and the coil that the current empties
    let told = all(&limited);
    let limits: Vec<_> = told.iter().map(|own| (own.axis, own.limit)).collect();
    assert!(limits.contains(&(0, Limit::Voltage)) && limits.contains(&(1, Limit::Voltage)));
    assert!(
        !limits
            .iter()
            .any(|own| own.1 == Limit::Current || own.1 == Limit::Gap)
    );
    let signals = |angle: f64| {
        let start = found.start(&limited, &imbalance, angle).unwrap();
        let unlimited = limited.linear();
        let mut signals = unlimited.signals();
        let inputs = Inputs::usual(start.coordinates.as_slice(), &[]);
        unlimited.read(&start.states, inputs, &mut signals);
        [0, 1].map(|axis| (signals.commands[axis], signals.currents[axis]))
    };
    let (now, later) = (signals(0.0), signals(std::f64::consts::FRAC_PI_2));
    for own in told.iter().filter(|own| own.limit == Limit::Voltage) {
        let volts = |(command, current): (f64, f64)| gain * (command - current) - own.fixed;
        let amplitude = volts(now[own.axis]).hypot(volts(later[own.axis]));
        assert!(
            (own.amplitude / amplitude - 1.0).abs() < 1e-6,
            "{own:?} {amplitude}"
        );
        assert_eq!(own.allowed, 1.0);
    }
    // a gap narrower than the orbit
    let mut narrow = Mass { ..mass };
    narrow.amplifier = Amplifier::Direct;
    narrow.magnet = Magnet::Pair(OpposedPair::of_stiffness(KI, KS, 1e-5, 10.0));
    let mass = narrow;
    let wide = loaded(&mass, [0.0, 0.0]);
    let orbit = unbalance(&wide.closed, &imbalance, SPEED).unwrap();
    let passed = excesses(&levitation(&mass), &wide.rest, Some(&orbit), SPEED);
    let gaps: Vec<_> = passed
        .iter()
        .filter(|own| own.limit == Limit::Gap)
        .collect();
    let radius = orbit.forward[0].norm() + orbit.backward[0].norm();
    assert!(gaps.len() == 2 && gaps.iter().all(|own| own.allowed == 1e-5));
    assert!(
        gaps.iter()
            .all(|own| (own.amplitude / radius - 1.0).abs() < 1e-3)
    );
    // 1.25 A of static current on axis 1: a limit between it and its sum with the amplitude is passed on that axis alone
    let amplitude = turning.currents[1].norm();
    let (_, mut actuators) = mass.axes();
    let (sensors, _) = mass.axes();
    for actuator in &mut actuators {
        actuator.amplifier = Amplifier::Direct;
        actuator.largest_current = 1.25 + 0.9 * amplitude;
        actuator.lowest_current = -actuator.largest_current;
    }
    let control = Control::Channels(vec![mass.channel.clone(); 2]);
    limited = Levitation::new(1, sensors, control, mass.timing, actuators).unwrap();
    let told = all(&limited);
    let of_coils: Vec<_> = told
        .iter()
        .filter(|own| own.limit == Limit::Current)
        .collect();
    assert_eq!(of_coils.len(), 1);
    assert_eq!(of_coils[0].axis, 1);
    assert!((of_coils[0].fixed.abs() - 1.25).abs() < 1e-9);
    assert!((of_coils[0].amplitude / amplitude - 1.0).abs() < 1e-12);
}
