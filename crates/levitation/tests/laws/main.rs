//! Signs, limits and equalities of the levitation: each sign shown to fail when it is flipped.

mod coils;
mod loaded;
mod mass;
#[path = "../../../rotor/tests/published/mod.rs"]
mod published;
#[path = "../reference/mod.rs"]
mod reference;

use levitation::response::{equilibrium, impulse, start};
use levitation::sensitivity::Axes;
use levitation::{
    Actuator, Amplifier, Axis, C64, ClosedLoop, Control, Inputs, Levitation, LinearControl, Plant,
    Refused, Sensor, StateSpace, Timing, Verdict, ZERO, verdict, weight,
};
use mass::{DELAYED, Mass};
use nalgebra::{DMatrix, DVector};
use number::Dual;
use physics::magnet::{Magnet, OpposedPair};
use reference::{Basis, File};

const SPEED: f64 = 1_256.637_061_435_917_3;

fn same(a: C64, b: C64, share: f64) -> bool {
    (a - b).norm() <= share * b.norm()
}

/// Q̈, rates of a state of the time run, and forces of the magnets with k_s as `sign` says.
fn rates(plant: &Plant<f64>, levitation: &Levitation, state: &[f64], sign: f64) -> Vec<f64> {
    let size = plant.size();
    let (q, rest) = state.split_at(size);
    let (v, own) = rest.split_at(size);
    let (q, v) = (DVector::from_row_slice(q), DVector::from_row_slice(v));
    let along = |axis: &Axis, of: &DVector<f64>| (plant.row(axis.node, axis.angle) * of)[0];
    let sensed: Vec<f64> = levitation
        .sensors()
        .iter()
        .map(|s| along(&s.axis, &q))
        .collect();
    let moved: Vec<f64> = levitation
        .actuators()
        .iter()
        .map(|a| along(&a.axis, &v))
        .collect();
    let mut signals = levitation.signals();
    let mut own_rates = vec![0.0; own.len()];
    levitation.rate(
        own,
        Inputs::usual(&sensed, &moved),
        &mut signals,
        &mut own_rates,
    );
    let mut force = -(&plant.stiffness * &q) - &plant.damping * &v;
    for (actuator, current) in levitation.actuators().iter().zip(&signals.currents) {
        let row = plant.row(actuator.axis.node, actuator.axis.angle);
        let gap = sign * along(&actuator.axis, &q);
        force += row.transpose() * actuator.magnet.force(*current, gap, 1.0);
    }
    let accelerations = plant.mass.clone().lu().solve(&force).unwrap();
    [v.as_slice(), accelerations.as_slice(), &own_rates].concat()
}

/// Classical Runge-Kutta steps.
fn advance(state: &[f64], step: f64, count: usize, rate: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let mut y = state.to_vec();
    for _ in 0..count {
        let add = |k: &[f64], h: f64| y.iter().zip(k).map(|(y, k)| y + h * k).collect::<Vec<_>>();
        let k1 = rate(&y);
        let k2 = rate(&add(&k1, 0.5 * step));
        let k3 = rate(&add(&k2, 0.5 * step));
        let k4 = rate(&add(&k3, step));
        for (at, value) in y.iter_mut().enumerate() {
            *value += step / 6.0 * (k1[at] + 2.0 * (k2[at] + k3[at]) + k4[at]);
        }
    }
    y
}

#[test]
fn a_time_run_of_the_rates_is_the_motion_that_the_matrices_say_and_the_sign_of_ks_decides() {
    let file = File::levitated();
    let plant = file.plant(Basis::Reduced, SPEED);
    let levitation = file.levitation(0.6);
    let closed = ClosedLoop::new(plant.clone(), &levitation).unwrap();
    let wanted = &impulse(&closed, 28, 0.02, &[0.004]).unwrap()[0];
    let size = plant.size();
    let mut state = vec![0.0; closed.states()];
    let push = plant.row(28, 0.0).transpose() * 0.02;
    state[size..2 * size].copy_from_slice(push.as_slice());
    let distance = |sign: f64| {
        let rate = |y: &[f64]| rates(&plant, &levitation, y, sign);
        // ω_top h = 0.5: error of a fourth-order step below 1e-6 of the slow motion
        let ours = DVector::from_vec(advance(&state, 2e-6, 2000, rate));
        let (a, b) = (closed.displacements(&ours), closed.displacements(wanted));
        let largest = b.iter().fold(0.0_f64, |most, w| most.max(w.abs()));
        a.iter()
            .zip(&b)
            .fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()))
            / largest
    };
    assert!(distance(1.0) < 1e-5, "{}", distance(1.0));
    assert!(
        distance(-1.0) > 0.05,
        "a flipped k_s must be seen: {}",
        distance(-1.0)
    );
}

#[test]
fn a_start_moves_on_as_the_steady_motion_that_it_is_cut_from() {
    let file = File::drop();
    let analysis = file.analysis(Basis::Reduced);
    let plant = file.plant(Basis::Reduced, SPEED);
    let levitation = file.levitation(0.6);
    let loads = weight(&file.rotor, &analysis, [0.0, -9.81]);
    let imbalance = file.unbalance();
    let at = |angle| start(&plant, &levitation, &loads, &imbalance, SPEED, angle).unwrap();
    let (first, later) = (at(0.4), at(0.4 + SPEED * 2e-3));
    let joined = |s: &levitation::response::Start| {
        [s.coordinates.as_slice(), s.rates.as_slice(), &s.states].concat()
    };
    let mut y = joined(&first);
    let step = 2e-6;
    for index in 0..1000 {
        // forces of weight and unbalance as they turn, held at the middle of each step: error (Ωh)²/24 of them
        let angle = 0.4 + SPEED * (f64::from(index) + 0.5) * step;
        let mut force = loads.clone();
        for u in &imbalance {
            let size = u.amount * SPEED * SPEED;
            force += plant.row(u.node, angle + u.phase).transpose() * size;
        }
        let rate = |y: &[f64]| {
            let mut out = rates(&plant, &levitation, y, 1.0);
            let size = plant.size();
            for (value, extra) in out[size..2 * size].iter_mut().zip(force.iter()) {
                *value += extra;
            }
            out
        };
        y = advance(&y, step, 1, rate);
    }
    let wanted = joined(&later);
    for part in [0..2 * 18, 2 * 18..4 * 18, 4 * 18..wanted.len()] {
        let largest = wanted[part.clone()]
            .iter()
            .fold(0.0_f64, |m, v| m.max(v.abs()));
        let worst = part.map(|k| (y[k] - wanted[k]).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-5 * largest, "{worst:e} of {largest:e}");
    }
}

#[test]
fn both_planes_say_what_one_complex_plane_says_whatever_the_frame() {
    let file = File::levitated();
    let complex = file.turning(Basis::Reduced, SPEED);
    let turning = complex.poles().unwrap();
    for angle in [0.0, std::f64::consts::FRAC_PI_4] {
        let levitation = file.levitation(angle);
        assert!(levitation.one_plane().is_some());
        let real = ClosedLoop::new(file.plant(Basis::Reduced, SPEED), &levitation).unwrap();
        let poles = real.poles().unwrap();
        for wanted in turning.iter().filter(|pole| pole.oscillates()) {
            let nearest = poles
                .iter()
                .find(|pole| same(pole.value, wanted.value, 1e-9));
            assert!(
                nearest.is_some_and(|pole| pole.turning > 1.0 - 1e-9),
                "{wanted:?}"
            );
        }
        let (one, both) = (Axes::new(&complex).unwrap(), Axes::new(&real).unwrap());
        for omega in [30.0, 655.0, 2516.0, 7025.0] {
            let (one, both) = (one.at(omega).unwrap(), both.at(omega).unwrap());
            for (axis, value) in both.iter().enumerate() {
                assert!(same(*value, one[axis / 2], 1e-9), "{angle} {omega}");
            }
        }
    }
}

#[test]
fn sensitivity_needs_both_senses_and_the_plant_with_ks() {
    // the file's |S| of both magnets at 2516 rad/s and full speed
    let wanted = [1.033_656_350_425_672, 1.123_761_711_389_081_4];
    let file = File::levitated();
    let closed = file.turning(Basis::Reduced, SPEED);
    let ours = Axes::new(&closed).unwrap().at(2516.0).unwrap();
    let off = |values: &[C64]| {
        let pairs = values.iter().zip(wanted);
        pairs
            .map(|(ours, wanted)| (ours.norm() / wanted - 1.0).abs())
            .fold(0.0, f64::max)
    };
    assert!(off(&ours) < 4e-5);
    // one sense alone: S_c from (1 - P k)⁻¹ by hand
    let by_hand = |omega: f64, ks: f64| -> Vec<C64> {
        let levitation = file.levitation(0.0).one_plane().unwrap();
        let plant = file.turning(Basis::Reduced, SPEED).plant().clone();
        let s = C64::new(0.0, omega);
        let rows = |axes: Vec<&Axis>| {
            let rows: Vec<_> = axes.iter().map(|a| plant.row(a.node, 0.0)).collect();
            DMatrix::from_rows(&rows)
        };
        let sensors = rows(levitation.sensors().iter().map(|s| &s.axis).collect());
        let magnets = rows(levitation.actuators().iter().map(|a| &a.axis).collect());
        let dynamics = &plant.mass * (s * s) + &plant.damping * s + &plant.stiffness
            - magnets.transpose() * &magnets * C64::from(ks);
        let p = sensors * dynamics.lu().solve(&magnets.transpose()).unwrap();
        let td = 4.547_284_088_339_867e-5;
        let pid = 8000.0 + 8e4 / s + s * 22.0 / (s * td + 1.0);
        let lag = (s / 50_265.482_457_436_69 + 1.0) * (s / 12_566.370_614_359_172 + 1.0);
        let (t, square) = (s * 2.5e-5, s * s * 2.5e-9 / 12.0);
        let k = -pid / lag * (square - t + 1.0) / (square + t + 1.0) * 40.0;
        let closed = DMatrix::identity(2, 2) - p * k;
        closed
            .try_inverse()
            .unwrap()
            .diagonal()
            .iter()
            .copied()
            .collect()
    };
    let mean = |ks: f64| -> Vec<C64> {
        let (plus, minus) = (by_hand(2516.0, ks), by_hand(-2516.0, ks));
        plus.iter()
            .zip(&minus)
            .map(|(a, b)| (a + b.conj()) * 0.5)
            .collect()
    };
    assert!(off(&mean(1.6e5)) < 4e-5);
    assert!(
        off(&by_hand(2516.0, 1.6e5)) > 0.02,
        "one sense alone must be seen"
    );
    assert!(off(&mean(0.0)) > 1e-3, "a plant without k_s must be seen");
}

#[test]
fn unequal_axes_have_no_complex_plane_and_whirl_on_ellipses() {
    let file = File::levitated();
    let (sensors, mut actuators) = (
        file.levitation(0.0).sensors().to_vec(),
        file.levitation(0.0).actuators().to_vec(),
    );
    actuators[0].amplifier = Amplifier::Current {
        bandwidth: 2e3,
        slew: f64::INFINITY,
    };
    let pid = StateSpace::pid(8000.0, 8e4, 22.0, 4.547_284_088_339_867e-5).unwrap();
    let nodes = file.rotor.nodes.len();
    let control = Control::Channels(vec![pid; 4]);
    let levitation = Levitation::new(nodes, sensors, control, DELAYED, actuators).unwrap();
    assert!(levitation.one_plane().is_none());
    let closed = ClosedLoop::new(file.plant(Basis::Reduced, SPEED), &levitation).unwrap();
    let poles = closed.poles().unwrap();
    assert!(
        poles
            .iter()
            .any(|pole| pole.oscillates() && pole.turning < 0.99)
    );
}

#[test]
fn zero_static_stiffness_is_found_and_named() {
    let file = File::levitated();
    let check = &file.file["zero_stiffness_check"];
    for (key, collocated) in [
        ("sensors_of_this_file", false),
        ("sensors_at_the_actuator_nodes", true),
    ] {
        let levitation = file.changed(0.0, DELAYED, |magnet| {
            magnet["controller"]["Kp"] = check["Kp"].clone();
            magnet["controller"]["Ki"] = 0.0.into();
            if collocated {
                magnet["sensor_node"] = magnet["actuator_node"].clone();
            }
        });
        let nodes = file.rotor.nodes.len();
        let plant = Plant::turning(&file.analysis(Basis::Whole), nodes, 0.0).unwrap();
        let closed = ClosedLoop::new(plant, &levitation.one_plane().unwrap()).unwrap();
        let poles = closed.poles().unwrap();
        let wanted = &check[key];
        let zeros = wanted["eigenvalues_at_zero"].as_u64().unwrap() as usize;
        assert_eq!(verdict(&poles), Verdict::ZeroStiffness(zeros));
        let next = poles
            .iter()
            .find(|pole| pole.value.norm() >= ZERO)
            .unwrap()
            .value;
        assert!(
            same(next, reference::complex(&wanted["next"]), 1e-6),
            "{next}"
        );
        let rest = poles.iter().filter(|pole| pole.value.norm() >= ZERO);
        let largest = rest.map(|pole| pole.value.re).fold(f64::MIN, f64::max);
        let wanted = wanted["largest_other_real_part"].as_f64().unwrap();
        assert!((largest / wanted - 1.0).abs() < 1e-6);
        // the reason: k_i K_p = k_s without an integrator
        let stiffness = levitation.static_stiffness(&levitation.slopes_at_centre());
        assert!(
            stiffness.iter().all(|k| k.abs() < 1e-9 * 1.6e5),
            "{stiffness:?}"
        );
    }
    // with the integrator the loop is stiff without bound at rest
    let held = file.levitation(0.0);
    let stiffness = held.static_stiffness(&held.slopes_at_centre());
    assert_eq!(stiffness, [f64::INFINITY; 4]);
}

#[test]
fn too_little_gain_is_unstable_and_its_eigenvalue_is_told() {
    let mut mass = Mass::usual();
    mass.channel = StateSpace::pid(3000.0, 0.0, 22.0, 4.5e-5).unwrap();
    let Verdict::Unstable(value) = verdict(&mass.closed().poles().unwrap()) else {
        panic!("3000 A/m times 40 N/A does not hold against 1.6e5 N/m");
    };
    // about (k_s - k_i K_p)/(k_i K_d): the damping holds it back
    assert!((value.re / (4e4 / 880.0) - 1.0).abs() < 0.1, "{value}");
}

#[test]
fn matrices_are_the_derivatives_of_the_rates() {
    let levitation = Mass::usual().levitation();
    let linear = LinearControl::new(&levitation);
    const N: usize = 16;
    let states = levitation.states();
    assert_eq!(states + 4, N);
    let variable = |k: usize| Dual::<N>::variable(0.1 * k as f64, k);
    let all: Vec<_> = (0..N).map(variable).collect();
    let mut signals = levitation.signals();
    let mut rates = vec![variable(0); states];
    let (own, inputs) = all.split_at(states);
    let inputs = Inputs::usual(&inputs[..2], &inputs[2..]);
    levitation.rate(own, inputs, &mut signals, &mut rates);
    for (row, rate) in rates.iter().enumerate() {
        for k in 0..states {
            assert_eq!(rate.partial[k], linear.a[(row, k)]);
        }
        assert_eq!(rate.partial[states], linear.by_displacement[(row, 0)]);
        assert_eq!(rate.partial[states + 3], linear.by_velocity[(row, 1)]);
    }
    assert_eq!(levitation.names().len(), states);
    assert!(levitation.names().contains(&"axis 0.3.integral".to_owned()));
}

#[test]
fn one_filter_from_all_sensors_to_all_magnets_equals_channels_where_it_is_diagonal() {
    let mass = Mass::usual();
    let (sensors, actuators) = mass.axes();
    // K_p + K_d s/(1 + T_d s) on both axes as matrices
    let (kp, kd, td) = (8000.0, 22.0, 4.5e-5);
    let both = |value: f64| DMatrix::identity(2, 2) * value;
    let matrix = StateSpace::new(
        "k",
        both(-1.0 / td),
        both(1.0 / td),
        both(-kd / td),
        both(kp + kd / td),
    );
    let matrix = Control::Matrix(matrix.unwrap());
    let channels = Control::Channels(vec![StateSpace::pid(kp, 0.0, kd, td).unwrap(); 2]);
    let poles = |control| {
        let levitation = Levitation::new(1, sensors.clone(), control, DELAYED, actuators.clone());
        ClosedLoop::new(mass.plant(), &levitation.unwrap())
            .unwrap()
            .poles()
            .unwrap()
    };
    let (a, b) = (poles(matrix), poles(channels));
    assert_eq!(a.len(), b.len());
    for wanted in b {
        // pairs of equal eigenvalues: their conjugates too
        let near = |pole: &levitation::Pole| {
            same(pole.value, wanted.value, 1e-6) || same(pole.value.conj(), wanted.value, 1e-6)
        };
        assert!(a.iter().any(near), "{wanted:?}");
    }
}

#[test]
fn a_voltage_amplifier_converts_what_it_gives_the_rotor_and_ends_at_its_limit() {
    let mut mass = Mass::usual();
    let (inductance, resistance, limit) = (0.02, 1.5, 60.0);
    mass.amplifier = Amplifier::Voltage {
        inductance,
        resistance,
        gain: Some(300.0),
        largest_voltage: limit,
    };
    let levitation = mass.levitation();
    let at = levitation.current_states(0).start;
    let mut states = vec![0.0; levitation.states()];
    states[at] = 1.2;
    let mut signals = levitation.signals();
    let mut rates = vec![0.0; states.len()];
    let velocity = 0.3;
    levitation.rate(
        &states,
        Inputs::usual(&[0.0; 2], &[velocity, 0.0]),
        &mut signals,
        &mut rates,
    );
    // u i = R i² + L i i̇ + power to the rotor, k_i i ẋ; the wanted voltage -360 V is beyond the limit
    let voltage = -limit;
    let rest = voltage * 1.2 - resistance * 1.44 - inductance * 1.2 * rates[at];
    let power = mass.magnet.force(1.2, 0.0, 1.0) * velocity;
    assert!((rest / power - 1.0).abs() < 1e-12, "{rest} W, {power} W");
    // the linear loop knows no limit, and the induced voltage damps: without it the loop is another
    let closed = mass.closed();
    assert_eq!(verdict(&closed.poles().unwrap()), Verdict::Stable);
    assert!(LinearControl::new(&levitation).by_velocity.amax() == 40.0 / inductance);
}

#[test]
fn a_pair_carries_its_load_off_the_centre_and_gives_up_at_its_limits() {
    let mut mass = Mass::usual();
    let pair = OpposedPair::of_stiffness(40.0, 1.6e5, 0.4e-3, 3.0);
    mass.magnet = Magnet::Pair(pair);
    let find = |mass: &Mass, load: f64| {
        equilibrium(
            &mass.plant(),
            &mass.levitation(),
            &DVector::from_vec(vec![0.0, -load]),
        )
    };
    // without an integrator the rotor sags, and the pair is not linear there
    mass.channel = StateSpace::pid(8000.0, 0.0, 22.0, 4.5e-5).unwrap();
    let found = find(&mass, 25.0).unwrap();
    let (up, angle) = (found.coordinates[1], 0.3_f64);
    let forces = [0, 1].map(|k| mass.magnet.force(found.currents[k], found.gaps[k], 1.0));
    let (sin, cos) = angle.sin_cos();
    assert!((forces[0] * cos - forces[1] * sin).abs() < 1e-9);
    assert!((forces[0] * sin + forces[1] * cos - 25.0).abs() < 1e-9);
    // up to 1 % as stiff as k_i K_p - k_s says
    assert!(up < 0.0 && (up / (-25.0 / 1.6e5) - 1.0).abs() < 0.3, "{up}");
    // 1.6 A of bias and as much control: a load of k_i 1.6 A · √2 cannot be held along any axis
    assert_eq!(find(&mass, 200.0).unwrap_err(), Refused::NoEquilibrium);
}

#[test]
fn offsets_move_the_rotor_against_them_and_references_with_them() {
    let mass = Mass::usual();
    let rest = |offset: f64, reference: f64| {
        let (mut sensors, actuators) = mass.axes();
        (sensors[0].offset, sensors[0].reference) = (offset, reference);
        let control = Control::Channels(vec![mass.channel.clone(); 2]);
        let levitation = Levitation::new(1, sensors, control, mass.timing, actuators).unwrap();
        equilibrium(&mass.plant(), &levitation, &DVector::zeros(2))
            .unwrap()
            .gaps[0]
    };
    assert!((rest(1e-5, 0.0) + 1e-5).abs() < 1e-15);
    assert!((rest(0.0, 1e-5) - 1e-5).abs() < 1e-15);
}

#[test]
fn a_sampled_loop_has_the_eigenvalues_of_its_delay() {
    let mut mass = Mass::usual();
    let (period, computation) = (1e-5, 4e-6);
    mass.timing = Timing::Sampled {
        period,
        computation,
    };
    mass.channel = StateSpace::pid(8000.0, 0.0, 22.0, 2e-4).unwrap();
    let (plant, levitation) = (mass.plant(), mass.levitation());
    assert_eq!(levitation.timing().delay(), 9e-6);
    // one period as a map: columns from unit states; linear, so exact but for the steps
    let size = 4 + levitation.states();
    let rate = |y: &[f64]| rates(&plant, &levitation, y, 1.0);
    let mut map = DMatrix::zeros(size, size);
    for column in 0..size {
        let mut y = vec![0.0; size];
        y[column] = 1.0;
        let sensed: Vec<f64> = (levitation.sensors().iter())
            .map(|s| (plant.row(0, s.axis.angle) * DVector::from_row_slice(&y[..2]))[0])
            .collect();
        levitation.sample(
            &mut y[4..],
            Inputs::usual(&sensed, &[]),
            &mut levitation.signals(),
        );
        let mut y = advance(&y, computation / 8.0, 8, rate);
        levitation.release(&mut y[4..]);
        let y = advance(&y, (period - computation) / 8.0, 8, rate);
        map.set_column(column, &DVector::from_vec(y));
    }
    let values: Vec<C64> = map
        .complex_eigenvalues()
        .iter()
        .map(|z| z.ln() / period)
        .collect();
    for pole in mass.closed().poles().unwrap() {
        // slow against the samples: the delay holds to the square of |λ| T_s
        if pole.value.norm() > 2e3 {
            continue;
        }
        let near = values
            .iter()
            .map(|v| (v - pole.value).norm())
            .fold(f64::INFINITY, f64::min);
        let conjugate = values
            .iter()
            .map(|v| (v - pole.value.conj()).norm())
            .fold(f64::INFINITY, f64::min);
        assert!(
            near.min(conjugate) < 2e-3 * pole.value.norm(),
            "{} {near}",
            pole.value
        );
    }
}

#[test]
fn what_cannot_be_is_refused_with_its_place() {
    let mass = Mass::usual();
    let (sensors, actuators) = mass.axes();
    let build = |nodes, sensors: &[Sensor], control: Control, timing, actuators: &[Actuator]| {
        let refused = Levitation::new(nodes, sensors.to_vec(), control, timing, actuators.to_vec());
        refused.unwrap_err().to_string()
    };
    let channels = |count| Control::Channels(vec![mass.channel.clone(); count]);
    let text = build(1, &sensors, channels(1), DELAYED, &actuators);
    assert!(
        text.contains("from 1 signals to 1 commands; 2 sensor axes"),
        "{text}"
    );
    let mut far = sensors.clone();
    far[1].axis.node = 7;
    let text = build(3, &far, channels(2), DELAYED, &actuators);
    assert!(
        text.contains("at node 7; the rotor has nodes 0 to 2"),
        "{text}"
    );
    let back = Timing::Continuous { delay: -1e-5 };
    let text = build(1, &sensors, channels(2), back, &actuators);
    assert!(
        text.contains("delay -0.00001 s; allowed is 0 or more"),
        "{text}"
    );
    let late = Timing::Sampled {
        period: 1e-4,
        computation: 2e-4,
    };
    let text = build(1, &sensors, channels(2), late, &actuators);
    assert!(text.contains("time to compute"), "{text}");
    let mut odd = actuators.clone();
    odd[0].magnet = Magnet::Pair(OpposedPair::of_stiffness(40.0, 1.6e5, 0.4e-3, 1.0));
    let text = build(1, &sensors, channels(2), DELAYED, &odd);
    assert!(text.contains("a bias of 1.6 A above"), "{text}");
    odd[0].magnet = Magnet::Linear {
        current_stiffness: 40.0,
        position_stiffness: -1.6e5,
    };
    assert!(build(1, &sensors, channels(2), DELAYED, &odd).contains("must be above 0"));
    let (two, three) = (DMatrix::zeros(2, 2), DMatrix::zeros(3, 2));
    let wrong = StateSpace::new("k", two.clone(), two.clone(), two, three);
    assert!(matches!(wrong, Err(Refused::Sizes(_))));
}
