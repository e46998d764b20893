//! Dynamic stiffness of mounts by their closed forms against what the mount of a run does under a sine.

use model::mount::{
    DynamicStiffness, FrictionRing, Housing, MaxwellBranch, Mount, MountParts, SqueezeFilm,
    WholeMount,
};
use number::Vec2;
use std::f64::consts::{PI, TAU};

/// First harmonic of the settled force over the amplitude, under s = A sin ωt along x.
fn under_a_sine(
    spring: &Mount<f64>,
    parts: &MountParts,
    omega: f64,
    amplitude: f64,
) -> DynamicStiffness {
    const STEPS: usize = 20_000;
    const TURNS: usize = 40;
    let mount = WholeMount::<f64>::gather(&|_| (spring, parts));
    let size = parts.state_names().len();
    let step = TAU / omega / STEPS as f64;
    let react = |time: f64, state: &[f64]| {
        let mut rate = vec![0.0; size];
        let (sine, cosine) = (omega * time).sin_cos();
        let s = Vec2::new(amplitude * sine, 0.0);
        let v = Vec2::new(amplitude * omega * cosine, 0.0);
        let force = mount.react((s, v), state, &mut rate).force;
        (force.x, rate)
    };
    let moved = |state: &[f64], rate: &[f64], share: f64| -> Vec<f64> {
        state
            .iter()
            .zip(rate)
            .map(|(x, r)| x + share * step * r)
            .collect()
    };
    let (mut state, mut sums) = (vec![0.0; size], [0.0; 2]);
    for k in 0..TURNS * STEPS {
        let time = k as f64 * step;
        let (force, first) = react(time, &state);
        if k >= (TURNS - 1) * STEPS {
            let (sine, cosine) = (omega * time).sin_cos();
            sums[0] -= force * sine;
            sums[1] -= force * cosine;
        }
        let second = react(time + 0.5 * step, &moved(&state, &first, 0.5)).1;
        let third = react(time + 0.5 * step, &moved(&state, &second, 0.5)).1;
        let fourth = react(time + step, &moved(&state, &third, 1.0)).1;
        for (i, x) in state.iter_mut().enumerate() {
            *x += step / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]);
        }
    }
    let [storage, loss] = sums.map(|sum| 2.0 * sum / (STEPS as f64 * amplitude));
    DynamicStiffness { storage, loss }
}

fn near(found: DynamicStiffness, wanted: DynamicStiffness, share: f64) {
    let size = wanted.storage.hypot(wanted.loss);
    let distance = (found.storage - wanted.storage).hypot(found.loss - wanted.loss);
    assert!(distance < share * size, "{found:?} {wanted:?}");
}

const SPRING: Mount<f64> = Mount {
    stiffness: 6e6,
    damping: 200.0,
    free_position: Vec2 { x: 0.0, y: 0.0 },
};

/// An O-ring on a housing that yields: 1e-6, what is left of the start after 40 turns and the steps.
#[test]
fn branches_and_housing_answer_a_sine_by_their_closed_form() {
    let branches = [(8e6, 3e-4), (4e6, 3e-5)];
    let branch = |(stiffness, time): (f64, f64)| MaxwellBranch {
        stiffness,
        rate: 1.0 / time,
    };
    let mut parts = MountParts {
        branches: branches.map(branch).to_vec(),
        ..MountParts::NONE
    };
    for omega in [300.0, 3000.0] {
        near(
            under_a_sine(&SPRING, &parts, omega, 1e-5),
            parts.linear(&SPRING, omega),
            1e-6,
        );
    }
    let housing = Housing {
        mass: 2.0,
        stiffness: 4e7,
        damping: 4e3,
    };
    parts.housing = Some(housing);
    let omega = 2000.0;
    let series = parts
        .linear(&SPRING, omega)
        .in_series(housing.dynamic_stiffness(omega));
    near(under_a_sine(&SPRING, &parts, omega, 1e-5), series, 1e-6);
}

/// A squeeze film at a millionth of its clearance: its eccentricity changes a cavitated film by ε.
#[test]
fn small_damping_of_a_film_is_that_of_the_run() {
    for cavitates in [false, true] {
        let film = SqueezeFilm {
            factor: 1.6e-9,
            clearance: 1e-4,
            cavitates,
        };
        let wanted = 1.6e-9 * PI / 1e-12 * if cavitates { 0.5 } else { 1.0 };
        assert!((film.small_damping() / wanted - 1.0).abs() < 1e-7);
        let omega = 500.0;
        let loss = omega * film.small_damping();
        let parts = MountParts {
            film: Some(film),
            ..MountParts::NONE
        };
        let spring = SPRING.dynamic_stiffness(omega);
        let wanted = spring + DynamicStiffness { storage: 0.0, loss };
        near(under_a_sine(&SPRING, &parts, omega, 1e-10), wanted, 2e-6);
    }
}

/// A friction ring by its own loop; a sharp one is Jenkins' element, whose loop has the area 4 F_s (A - e_y).
#[test]
fn harmonic_of_a_ring_is_that_of_the_run_and_jenkins() {
    let ring = |exponent: f64| FrictionRing {
        stiffness: 2e7,
        travel: 1e-5,
        exponent,
    };
    let amplitude = 2.5e-5;
    let own = ring(8.0);
    let parts = MountParts {
        ring: Some(own),
        ..MountParts::NONE
    };
    let wanted = SPRING.dynamic_stiffness(700.0) + own.harmonic(amplitude);
    // both end in steps across the corner of the loop
    near(
        under_a_sine(&SPRING, &parts, 700.0, amplitude),
        wanted,
        1e-6,
    );
    let area = 4.0 * 2e7 * 1e-5 * (amplitude - 1e-5);
    let jenkins = area / (PI * amplitude * amplitude);
    // the exponent 100 rounds the corner by a share of 1/100
    assert!((ring(100.0).harmonic(amplitude).loss / jenkins - 1.0).abs() < 0.01);
    // far below its travel it is a spring
    near(
        ring(8.0).harmonic(1e-7),
        DynamicStiffness {
            storage: 2e7,
            loss: 0.0,
        },
        1e-6,
    );
}
