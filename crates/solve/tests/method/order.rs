//! Orders of convergence, against closed forms.

use crate::problems::{Blind, Problem, adaptive, end_by, equal_steps, run_alone};
use solve::{Flow, HEUN, Observer, Step};
use std::f64::consts::PI;

/// Eccentricity of the ellipse.
const ECCENTRICITY: f64 = 0.3;

/// A planet at the point of the ellipse nearest to the sun, semi-major axis 1: its period is 2π.
fn nearest_point() -> [f64; 4] {
    let e = ECCENTRICITY;
    [1.0 - e, 0.0, 0.0, ((1.0 + e) / (1.0 - e)).sqrt()]
}

/// Distance from the start after one period, which should be zero.
fn closing_error(count: u32) -> f64 {
    let start = nearest_point();
    let settings = equal_steps(0.0, 2.0 * PI, count);
    let end = run_alone(&Problem::kepler(), &start, &mut Blind, &settings);
    assert_eq!(end.work.rejected, 0);
    (end.state[0] - start[0]).hypot(end.state[1] - start[1])
}

#[test]
fn halving_the_step_divides_the_error_by_8() {
    let errors = [200, 400, 800].map(closing_error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        // the next term of the error is smaller by one power of the step: a few percent of the order here
        assert!((2.9..3.2).contains(&order), "order {order} of {errors:?}");
    }
}

#[test]
fn the_order_holds_where_time_enters_the_rate() {
    let error = |count| {
        let settings = equal_steps(0.0, 2.0, count);
        let end = run_alone(&Problem::bell(), &[1.0], &mut Blind, &settings);
        (end.state[0] - 0.2).abs()
    };
    let order = (error(80) / error(160)).log2();
    assert!((2.8..3.2).contains(&order), "order {order}");
}

#[test]
fn the_extended_scheme_has_order_three() {
    let orbit = |count: u32| {
        let settings = equal_steps(0.0, 2.0 * PI, count);
        let start = nearest_point();
        let end = end_by(&HEUN, &Problem::kepler(), &start, &settings);
        (end[0] - start[0]).hypot(end[1] - start[1])
    };
    let bell = |count: u32| {
        let settings = equal_steps(0.0, 2.0, count);
        (end_by(&HEUN, &Problem::bell(), &[1.0], &settings)[0] - 0.2).abs()
    };
    let orders = [orbit(400) / orbit(800), bell(80) / bell(160)].map(f64::log2);
    for order in orders {
        assert!((2.8..3.2).contains(&order), "orders {orders:?}");
    }
}

#[test]
fn the_error_follows_the_tolerance() {
    let error = |tolerance| {
        let settings = adaptive(2.0 * PI, tolerance);
        let start = nearest_point();
        let end = run_alone(&Problem::kepler(), &start, &mut Blind, &settings);
        (end.state[0] - start[0]).hypot(end.state[1] - start[1])
    };
    let errors = [1e-4, 1e-6, 1e-8, 1e-10].map(error);
    // step control keeps h³ in proportion to the tolerance, and so the error: it falls by 1e6 over the whole sweep,
    // by 100 from one to the next; less a factor for steps that do not divide the period alike
    assert!(errors[0] / errors[3] > 1e5, "{errors:?}");
    for pair in errors.windows(2) {
        assert!(pair[0] / pair[1] > 20.0, "{errors:?}");
    }
    // one period amplifies local errors by a few tens
    assert!(errors[3] < 1e-8, "{errors:?}");
}

/// Largest error of dense output inside a step, and the error at its end.
struct Inside {
    dense: f64,
    end: f64,
}

impl Observer<Problem> for Inside {
    fn step(&mut self, step: &mut Step<Problem>) -> Flow {
        let error = |t: f64, y: f64| (y - 1.0 / (1.0 + t * t)).abs();
        for i in 1..20 {
            let theta = f64::from(i) / 20.0;
            let time = step.time(theta);
            self.dense = self.dense.max(error(time, step.state(theta)[0]));
        }
        self.end = error(step.end, step.end_state(0));
        Flow::Continue
    }
}

#[test]
fn dense_output_and_step_have_order_three() {
    // One step from an exact value: a method of order p errs by h^(p+1).
    let one_step = |length: f64| {
        let mut inside = Inside {
            dense: 0.0,
            end: 0.0,
        };
        let settings = equal_steps(0.8, 0.8 + length, 1);
        let end = run_alone(&Problem::bell(), &[1.0 / 1.64], &mut inside, &settings);
        assert_eq!(end.work.accepted, 1);
        inside
    };
    let (long, short) = (one_step(0.1), one_step(0.05));
    let dense_order = (long.dense / short.dense).log2() - 1.0;
    let step_order = (long.end / short.end).log2() - 1.0;
    assert!((2.8..3.3).contains(&dense_order), "dense {dense_order}");
    assert!((2.8..3.3).contains(&step_order), "step {step_order}");
}

/// Compares dense output at the joints of the steps.
struct Joints {
    last: Option<[f64; 4]>,
    count: u32,
}

impl Observer<Problem> for Joints {
    fn step(&mut self, step: &mut Step<Problem>) -> Flow {
        let start: [f64; 4] = std::array::from_fn(|i| step.start_state(i));
        let end: [f64; 4] = std::array::from_fn(|i| step.end_state(i));
        if let Some(last) = self.last {
            assert_eq!(start, last, "a step starts where the last one ended");
        }
        assert_eq!(step.state(0.0), &start[..]);
        assert_eq!(step.state(1.0), &end[..]);
        // just before the end: no jump onto the end state beyond the motion of a fraction of 1e-9 of the step
        let length = step.end - step.start;
        let before: [f64; 4] = std::array::from_fn(|i| step.state(1.0 - 1e-9)[i]);
        for i in 0..4 {
            assert!((before[i] - end[i]).abs() < 1e-8 * length + 1e-14);
        }
        self.last = Some(end);
        self.count += 1;
        Flow::Continue
    }
}

#[test]
fn dense_output_is_continuous_from_step_to_step() {
    let mut joints = Joints {
        last: None,
        count: 0,
    };
    let settings = adaptive(2.0 * PI, 1e-6);
    run_alone(&Problem::kepler(), &nearest_point(), &mut joints, &settings);
    assert!(joints.count > 10);
}

#[test]
fn quadratures_are_sums_like_any_channel() {
    // the area a planet sweeps: half a unit of angular momentum times the time, and nothing depends on it
    let mut problem = Problem::new(5, 0, |_, _, y, rate, _| {
        let cube = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
        let area = 0.5 * (y[0] * y[3] - y[1] * y[2]);
        rate.copy_from_slice(&[y[2], y[3], -y[0] / cube, -y[1] / cube, area]);
    });
    let mut start = nearest_point().to_vec();
    start.push(0.0);
    let mut run = |quadratures| {
        problem.quadratures = quadratures;
        run_alone(&problem, &start, &mut Blind, &adaptive(2.0 * PI, 1e-8))
    };
    let (channel, quadrature) = (run(0), run(1));
    assert_eq!(channel.state, quadrature.state);
    assert_eq!(channel.work, quadrature.work);
    // the whole ellipse: π a b
    let ellipse = PI * (1.0 - ECCENTRICITY * ECCENTRICITY).sqrt();
    assert!((quadrature.state[4] / ellipse - 1.0).abs() < 1e-7);
}
