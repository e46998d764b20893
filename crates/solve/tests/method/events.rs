//! Events on dense output, against the closed form of a mass that bounces on a spring.

use crate::problems::{
    BOUNCE_GRAVITY, BOUNCE_STIFFNESS, Problem, adaptive, equal_steps, run_alone,
};
use solve::{Flow, Observer, Step, watch};
use std::f64::consts::PI;

/// Height from which the mass falls, m.
const HEIGHT: f64 = 0.02;

/// Contact begins, contact ends and force peaks of a run.
#[derive(Default)]
struct Bounces {
    begin: Vec<f64>,
    end: Vec<f64>,
    peak: Vec<(f64, f64)>,
}

impl Observer<Problem> for Bounces {
    fn step(&mut self, step: &mut Step<Problem>) -> Flow {
        let (before, after) = (step.start_probe(0) > 0.0, step.end_probe(0) > 0.0);
        if before != after {
            let theta = watch::crossing(step, 0, 0.0, 1.0);
            let list = if after {
                &mut self.begin
            } else {
                &mut self.end
            };
            list.push(step.time(theta));
        }
        // the spring is shortest where the mass turns
        if before && after && step.start_state(1) < 0.0 && step.end_state(1) >= 0.0 {
            let (theta, force) = watch::maximum(step, 0.0, 1.0, |step, theta| step.probe(theta, 1));
            self.peak.push((step.time(theta), force));
        }
        Flow::Continue
    }
}

/// Fall time, contact time and peak force.
fn closed_form() -> (f64, f64, f64) {
    let (g, w) = (BOUNCE_GRAVITY, BOUNCE_STIFFNESS.sqrt());
    let (fall, speed) = ((2.0 * HEIGHT / g).sqrt(), (2.0 * g * HEIGHT).sqrt());
    // penetration g/ω² (1 - cos ωτ) + v/ω sin ωτ
    let contact = 2.0 * (PI - (speed * w / g).atan()) / w;
    let sag = g / (w * w);
    let peak = BOUNCE_STIFFNESS * (sag + sag.hypot(speed / w));
    (fall, contact, peak)
}

/// Largest errors of event times and of peak forces (relative) over three bounces.
fn errors(tolerance: f64) -> (f64, f64, f64) {
    let (fall, contact, peak) = closed_form();
    let period = 2.0 * fall + contact;
    let mut seen = Bounces::default();
    run_alone(
        &Problem::bouncing_mass(),
        &[HEIGHT, 0.0],
        &mut seen,
        &adaptive(3.0 * period, tolerance),
    );
    let counts = (seen.begin.len(), seen.end.len(), seen.peak.len());
    assert_eq!(counts, (3, 3, 3), "tolerance {tolerance}");
    let (mut time, mut peak_time, mut force) = (0.0_f64, 0.0_f64, 0.0_f64);
    for bounce in 0..3 {
        let begin = fall + f64::from(bounce as u32) * period;
        time = time.max((seen.begin[bounce] - begin).abs());
        time = time.max((seen.end[bounce] - begin - contact).abs());
        force = force.max((seen.peak[bounce].1 / peak - 1.0).abs());
        peak_time = peak_time.max((seen.peak[bounce].0 - begin - 0.5 * contact).abs());
    }
    (time, peak_time, force)
}

#[test]
fn a_free_fall_lands_at_the_closed_form() {
    // The path is a parabola, which the method follows exactly: only rounding and the search are left.
    let fall = Problem::new(2, 2, |_, _, y, rate, probe| {
        rate[0] = y[1];
        rate[1] = -BOUNCE_GRAVITY;
        if !probe.is_empty() {
            probe.copy_from_slice(&[-y[0], 0.0]);
        }
    });
    let mut seen = Bounces::default();
    run_alone(&fall, &[HEIGHT, 0.0], &mut seen, &adaptive(0.1, 1e-6));
    // 1e-12 of a step that is not longer than the fall
    let expected = closed_form().0;
    assert_eq!(seen.begin.len(), 1);
    assert!((seen.begin[0] - expected).abs() < 1e-13, "{:?}", seen.begin);
}

#[test]
fn event_times_and_peaks_follow_the_tolerance() {
    let (coarse, fine) = (errors(1e-7), errors(1e-11));
    // measured 7e-7 s and 1e-10 s: a height of 1e-7 and 1e-11 at 0.6 m/s, times the steps of three bounces
    assert!(coarse.0 < 3e-6 && fine.0 < 5e-10, "{coarse:?} {fine:?}");
    // the instant of a flat top is found to some 1e-5 of a step of 1e-4 s
    assert!(coarse.1 < 3e-6 && fine.1 < 2e-9, "{coarse:?} {fine:?}");
    // measured 4e-6 and 2e-10
    assert!(coarse.2 < 2e-5 && fine.2 < 1e-9, "{coarse:?} {fine:?}");
}

/// Finds the roots of a probe in the parts of one long step.
struct Roots(Vec<f64>);

impl Observer<Problem> for Roots {
    fn step(&mut self, step: &mut Step<Problem>) -> Flow {
        for (low, high) in [(0.0, 0.3), (0.3, 0.6), (0.6, 1.0)] {
            self.0.push(watch::crossing(step, 0, low, high));
        }
        Flow::Continue
    }
}

#[test]
fn roots_in_both_directions_are_found_in_parts_of_a_step() {
    // y = t, which the method follows exactly; the probe rises, falls and rises through its three roots
    let cubic = Problem::new(1, 1, |_, _, y, rate, probe| {
        rate[0] = 1.0;
        if !probe.is_empty() {
            probe[0] = (y[0] - 0.1) * (y[0] - 0.55) * (y[0] - 0.95);
        }
    });
    let mut roots = Roots(Vec::new());
    run_alone(&cubic, &[0.0], &mut roots, &equal_steps(0.0, 1.0, 1));
    for (root, expected) in roots.0.iter().zip([0.1, 0.55, 0.95]) {
        // the resolution of the search, and rounding of y
        assert!((root - expected).abs() < 2e-12, "{:?}", roots.0);
    }
    assert_eq!(roots.0.len(), 3);
}

#[test]
fn a_maximum_inside_a_step_is_found_with_its_height() {
    struct Top((f64, f64));
    impl Observer<Problem> for Top {
        fn step(&mut self, step: &mut Step<Problem>) -> Flow {
            self.0 = watch::maximum(step, 0.0, 1.0, |step, theta| step.probe(theta, 0));
            Flow::Continue
        }
    }
    let hump = Problem::new(1, 1, |_, _, y, rate, probe| {
        rate[0] = 1.0;
        if !probe.is_empty() {
            probe[0] = 3.0 - (y[0] - 0.37).powi(2);
        }
    });
    let mut top = Top((0.0, 0.0));
    run_alone(&hump, &[0.0], &mut top, &equal_steps(0.0, 1.0, 1));
    // 24 golden sections leave 1e-5 of the step, and its square in the height
    assert!((top.0.0 - 0.37).abs() < 2e-5, "{:?}", top.0);
    assert!((top.0.1 - 3.0).abs() < 4e-10, "{:?}", top.0);
}
