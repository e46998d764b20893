//! The linearly implicit method: order with exact, poor and no tangents, stiffness, quadratures.

use crate::problems::{Alone, Blind, Problem, adaptive, equal_steps};
use solve::{
    Batch, Ending, Flow, Held, Machine, Observer, Settings, Start, Step, Stepper, Stop, Tangents,
    run_implicit,
};
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

/// A problem whose tangents are so many percent of its derivatives, by differences; quadratures through the stages or from
/// accepted points.
struct Sloped<const PERCENT: u32, const POINTS: bool> {
    problem: Problem,
    batch: Alone<Problem>,
}

/// Tangents of all channels by those that the rate depends on, row by row.
struct Slopes {
    rows: Vec<Vec<f64>>,
    g: f64,
}

impl<const PERCENT: u32, const POINTS: bool> Batch<f64> for Sloped<PERCENT, POINTS> {
    type Machine = Problem;
    type Mode = f64;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Problem) -> Self
    where
        Problem: 'a,
    {
        Sloped {
            problem: machine(0).clone(),
            batch: Alone::gather(machine),
        }
    }
    fn gather_mode(modes: &dyn Fn(usize) -> f64) -> f64 {
        modes(0)
    }
    #[inline(always)]
    fn rate(&self, mode: &f64, time: f64, state: &[f64], rate: &mut [f64], probe: &mut [f64]) {
        self.batch.rate(mode, time, state, rate, probe);
    }
}

impl<const PERCENT: u32, const POINTS: bool> Tangents<f64> for Sloped<PERCENT, POINTS> {
    type Room = Slopes;
    fn room(&self) -> Slopes {
        Slopes {
            rows: Vec::new(),
            g: 0.0,
        }
    }
    fn at_points(&self) -> Vec<bool> {
        vec![POINTS; self.problem.quadratures]
    }
    fn take(&self, mode: &f64, _time: f64, state: &[f64], room: &mut Slopes) {
        let n = self.problem.dimension;
        let active = n - self.problem.quadratures;
        let rate_at = |column: usize, step: f64| {
            let mut moved = state.to_vec();
            moved[column] += step;
            let mut rate = vec![0.0; n];
            self.problem.rate(mode, 0.0, &moved, &mut rate, &mut []);
            rate
        };
        room.rows = vec![vec![0.0; active]; n];
        let share = f64::from(PERCENT) / 100.0;
        for column in 0..active {
            let step = 1e-6 * state[column].abs().max(1.0);
            let (above, below) = (rate_at(column, step), rate_at(column, -step));
            for (row, (above, below)) in room.rows.iter_mut().zip(above.iter().zip(&below)) {
                row[column] = share * (above - below) / (2.0 * step);
            }
        }
    }
    fn factor(&self, room: &mut Slopes, g: f64) {
        room.g = g;
    }
    fn solve(&self, room: &mut Slopes, side: &mut [f64]) {
        let n = side.len();
        let mut a: Vec<Vec<f64>> = (room.rows[..n].iter())
            .map(|row| row.iter().map(|value| -value).collect())
            .collect();
        for (i, row) in a.iter_mut().enumerate() {
            row[i] += room.g;
        }
        for k in 0..n {
            let pivot = (k..n).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs()));
            let pivot = pivot.expect("a row");
            a.swap(k, pivot);
            side.swap(k, pivot);
            for i in k + 1..n {
                let factor = a[i][k] / a[k][k];
                let pivot_row = a[k].clone();
                for (value, above) in a[i].iter_mut().zip(&pivot_row).skip(k) {
                    *value -= factor * above;
                }
                side[i] -= factor * side[k];
            }
        }
        for k in (0..n).rev() {
            let known: f64 = (k + 1..n).map(|j| a[k][j] * side[j]).sum();
            side[k] = (side[k] - known) / a[k][k];
        }
    }
    fn along(&self, room: &Slopes, vector: &[f64], rates: &mut [f64]) {
        for (rate, row) in rates.iter_mut().zip(&room.rows[vector.len()..]) {
            *rate += row.iter().zip(vector).map(|(a, b)| a * b).sum::<f64>();
        }
    }
}

fn integrate<const PERCENT: u32, const POINTS: bool, O: Observer<Problem>>(
    problem: &Problem,
    start: &[f64],
    observer: O,
    settings: &Settings,
) -> (Ending, O) {
    let mut observers = [observer];
    let endings = run_implicit::<f64, Sloped<PERCENT, POINTS>, O>(
        &[problem],
        &[start.to_vec()],
        &mut observers,
        settings,
        &AtomicBool::new(false),
    );
    let ending = endings.into_iter().next().expect("one machine");
    assert_eq!(ending.stop, Stop::Finished);
    let [observer] = observers;
    (ending, observer)
}

fn run<const PERCENT: u32, const POINTS: bool>(stiffness: f64, settings: &Settings) -> Ending {
    let start = [2.0, stiffness, 0.0, 0.0];
    integrate::<PERCENT, POINTS, _>(&van_der_pol(), &start, Blind, settings).0
}

fn orders_are_three<const PERCENT: u32, const POINTS: bool>(exact: &[f64]) {
    let errors = [200, 400, 800].map(|count| {
        let end = run::<PERCENT, POINTS>(1.0, &equal_steps(0.0, 3.0, count)).state;
        [(end[0] - exact[0]).abs(), (end[3] - exact[3]).abs()]
    });
    for pair in errors.windows(2) {
        for (coarse, fine) in pair[0].iter().zip(&pair[1]) {
            let order = (coarse / fine).log2();
            // the next term of the error: a few percent of the order
            assert!(
                (2.7..3.4).contains(&order),
                "{PERCENT} %: order {order} of {errors:?}"
            );
        }
    }
}

#[test]
fn halving_the_step_divides_the_error_by_8_whatever_the_tangents() {
    let exact = run::<100, false>(1.0, &equal_steps(0.0, 3.0, 40_000)).state;
    orders_are_three::<100, false>(&exact);
    orders_are_three::<60, false>(&exact);
    orders_are_three::<0, false>(&exact);
    orders_are_three::<100, true>(&exact);
}

#[test]
fn a_thousand_times_stiffer_takes_hardly_more_steps() {
    let steps = |stiffness: f64| {
        run::<100, false>(stiffness, &adaptive(0.5, 1e-5))
            .work
            .accepted
    };
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
    // so many heights that from some the onset lies between the last stage of a step of 1 ms and its end
    for place in 0..200 {
        let height = 2.5 + 3e-3 * f64::from(place);
        let settings = Settings {
            largest_step: 1.0,
            ..adaptive((2.0 * height / GRAVITY).sqrt() + 3.0, 1e-4)
        };
        let (ending, falls) = integrate::<100, false, _>(
            &falling_mass(),
            &[height, 0.0, 0.0],
            Falls::default(),
            &settings,
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

#[test]
fn a_run_saved_at_each_stop_has_the_bits_of_one_that_is_not() {
    let (problem, never) = (van_der_pol(), AtomicBool::new(false));
    let starts = [Start {
        machine: Held::Borrowed(&problem),
        state: &[2.0, 10.0, 0.0, 0.0],
        observer: 0,
        settings: adaptive(3.0, 1e-5),
        pause_at_events: false,
    }];
    let new = || Stepper::<f64, Sloped<100, true>, _>::implicit(&starts);
    let [still, moved] = [false, true].map(|moved| {
        let mut stepper = new();
        for stop in 1..10 {
            stepper.go_on(0, 0.37 * f64::from(stop));
            stepper.advance(&mut [Blind], &never);
            if moved {
                // rates before the start of a step are among what it depends on
                let saved = stepper.save(0);
                stepper = new();
                stepper.restore(0, &saved);
            }
        }
        stepper.ending(0).expect("it is over")
    });
    assert_eq!(still.stop, Stop::Finished);
    assert_eq!(still, moved);
}
