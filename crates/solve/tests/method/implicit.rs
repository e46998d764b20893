//! The linearly implicit method: order with an exact and with a poor Jacobian, stiffness, the tail.

use crate::problems::{Alone, Blind, Problem, adaptive, equal_steps};
use solve::{Arrowhead, Ending, Flow, Linear, Observer, Settings, Shape, Step, Stop, run_implicit};
use std::sync::atomic::AtomicBool;

/// ẋ = v, v̇ = k ((1 - x²) v - x), and Q = ∫v² on which nothing depends. State x, k, v, Q.
fn van_der_pol() -> Problem {
    let rate = |_: &f64, _: f64, y: &[f64], rate: &mut [f64], _: &mut [f64]| {
        let (x, k, v) = (y[0], y[1], y[2]);
        rate.copy_from_slice(&[v, 0.0, k * ((1.0 - x * x) * v - x), v * v]);
    };
    let mut problem = Problem::new(4, 0, rate);
    problem.quadratures = 1;
    problem
}

/// x and k are the border, v a block of one, Q the tail. The Jacobian, or a share of it.
struct ByHand {
    share: f64,
}

impl Linear<Problem, 1, 2, 1> for ByHand {
    fn shape(&self) -> Shape<1, 2, 1> {
        Shape {
            border: vec![0, 1],
            blocks: vec![[2]],
            tail: 3..4,
            rows: [0],
            columns: [0, 1],
        }
    }
    fn jacobian(&mut self, _mode: &f64, _time: f64, y: &[f64], into: &mut Arrowhead<1, 2, 1>) {
        let (x, k, v) = (y[0], y[1], y[2]);
        let block = &mut into.blocks[0];
        block.own[0][0] = self.share * k * (1.0 - x * x);
        block.right[0] = [
            self.share * k * (-2.0 * x * v - 1.0),
            self.share * ((1.0 - x * x) * v - x),
        ];
        block.left[0][0] = self.share;
        block.tail[0][0] = self.share * 2.0 * v;
    }
}

fn run(stiffness: f64, share: f64, settings: &Settings) -> Ending {
    let never = AtomicBool::new(false);
    let start = [2.0, stiffness, 0.0, 0.0];
    let ending = run_implicit::<f64, Alone<Problem>, _, _, _, _, _>(
        &van_der_pol(),
        ByHand { share },
        &start,
        &mut Blind,
        settings,
        &never,
    );
    assert_eq!(ending.stop, Stop::Finished);
    ending
}

#[test]
fn halving_the_step_divides_the_error_by_8_whatever_the_jacobian() {
    let exact = run(1.0, 1.0, &equal_steps(0.0, 3.0, 40_000)).state;
    for share in [1.0, 0.6, 0.0] {
        let errors = [200, 400, 800].map(|count| {
            let end = run(1.0, share, &equal_steps(0.0, 3.0, count)).state;
            [(end[0] - exact[0]).abs(), (end[3] - exact[3]).abs()]
        });
        for pair in errors.windows(2) {
            for (coarse, fine) in pair[0].iter().zip(&pair[1]) {
                let order = (coarse / fine).log2();
                // the next term of the error: a few percent of the order
                assert!(
                    (2.7..3.4).contains(&order),
                    "share {share}: order {order} of {errors:?}"
                );
            }
        }
    }
}

#[test]
fn a_thousand_times_stiffer_takes_hardly_more_steps() {
    let steps = |stiffness: f64| run(stiffness, 1.0, &adaptive(0.5, 1e-5)).work.accepted;
    let (plain, stiff) = (steps(10.0), steps(10_000.0));
    assert!(stiff < 3 * plain, "{plain} {stiff}");
}

/// A unit mass that falls onto a damped spring: height, its rate, and the heat on which nothing depends.
fn falling_mass() -> Problem {
    let rate = |_: &f64, _: f64, y: &[f64], rate: &mut [f64], _: &mut [f64]| {
        let touching = f64::from(u8::from(y[0] < 0.0));
        let damping = DAMPING * touching * y[1];
        rate.copy_from_slice(&[
            y[1],
            -STIFFNESS * touching * y[0] - damping - GRAVITY,
            damping * y[1],
        ]);
    };
    let mut problem = Problem::new(3, 0, rate);
    problem.quadratures = 1;
    problem
}

/// In units of 0.1 mm and 1 ms: a contact of 5 kHz.
const STIFFNESS: f64 = 1e3;
const DAMPING: f64 = 3.0;
const GRAVITY: f64 = 0.0981;

/// Its Jacobian: all of it is border.
struct OfFallingMass;

impl Linear<Problem, 1, 2, 1> for OfFallingMass {
    fn shape(&self) -> Shape<1, 2, 1> {
        Shape {
            border: vec![0, 1],
            blocks: Vec::new(),
            tail: 2..3,
            rows: [0],
            columns: [0, 1],
        }
    }
    fn jacobian(&mut self, _mode: &f64, _time: f64, y: &[f64], into: &mut Arrowhead<1, 2, 1>) {
        let touching = f64::from(u8::from(y[0] < 0.0));
        into.corner = vec![0.0, 1.0, -STIFFNESS * touching, -DAMPING * touching];
        into.tail_border = vec![0.0, 2.0 * DAMPING * touching * y[1]];
    }
}

/// How far a sum falls, in the steps and within them.
#[derive(Default)]
struct Falls {
    last: f64,
    most: f64,
}

impl Observer<Problem> for Falls {
    fn step(&mut self, step: &mut Step<Problem>) -> Flow {
        for part in 1..=8 {
            let heat = step.state(f64::from(part) / 8.0)[2];
            self.most = self.most.max(self.last - heat);
            self.last = heat;
        }
        Flow::Continue
    }
}

#[test]
fn no_step_passes_over_the_onset_of_a_contact() {
    let never = AtomicBool::new(false);
    // so many heights that from some the onset lies between the last stage of a step of 1 ms and its end
    for place in 0..200 {
        let height = 2.5 + 3e-3 * f64::from(place);
        let mut falls = Falls::default();
        let settings = Settings {
            largest_step: 1.0,
            ..adaptive((2.0 * height / GRAVITY).sqrt() + 3.0, 1e-4)
        };
        let ending = run_implicit::<f64, Alone<Problem>, _, _, _, _, _>(
            &falling_mass(),
            OfFallingMass,
            &[height, 0.0, 0.0],
            &mut falls,
            &settings,
            &never,
        );
        let [x, v, heat] = [0, 1, 2].map(|channel| ending.state[channel]);
        let energy = 0.5 * v * v + GRAVITY * x + 0.5 * STIFFNESS * x.min(0.0).powi(2) + heat;
        let residual = energy / (GRAVITY * height) - 1.0;
        // 2.6e-4 at most wherever the onset lies; a step that passes over it leaves up to 0.6
        assert!(residual.abs() < 5e-4, "{height}: {residual}");
        assert!(
            falls.most <= 0.0,
            "{height}: the heat falls by {} J",
            falls.most
        );
    }
}
