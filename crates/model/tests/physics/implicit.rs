//! Linearly implicit steps: the Jacobian is the derivative of the rate, and a drop is the same drop.

use crate::machines::{
    BEARING, planar, random_state, reference, separate, settings, tilt_contacts,
};
use crate::several::{of_twins, twins};
use model::bearing::Separation;
use model::bearing::ball_states::CAGE_PLACE;
use model::system::machine::linear::MachineLinear;
use model::system::machine::record::Record;
use model::system::machine::{MachineConstants, Machines, RotorMachine};
use physics::traction::{TanhTraction, Traction};
use solve::{Arrowhead, Ending, Linear, Machine, Stop};
use std::sync::atomic::AtomicBool;

/// The reference machine with another reference speed of traction, m/s.
fn with_reference_speed(reference_speed: f64) -> MachineConstants {
    let mut constants = reference();
    planar(&mut constants).traction = Traction::Tanh(TanhTraction {
        maximum: 0.08,
        inverse_reference_speed: 1.0 / reference_speed,
    });
    constants
}

/// The whole Jacobian row by row.
fn whole<const M: usize, const COLUMNS: usize, const ROWS: usize>(
    arrow: &Arrowhead<M, COLUMNS, ROWS>,
    dimension: usize,
) -> Vec<f64> {
    let s = arrow.shape();
    let p = s.border.len();
    let mut all = vec![0.0; dimension * dimension];
    for (i, row) in s.border.iter().enumerate() {
        for (k, column) in s.border.iter().enumerate() {
            all[row * dimension + column] = arrow.corner[i * p + k];
        }
    }
    for (k, row) in s.tail.clone().enumerate() {
        for (i, column) in s.border.iter().enumerate() {
            all[row * dimension + column] = arrow.tail_border[i * s.tail.len() + k];
        }
    }
    for (j, block) in s.blocks.iter().enumerate() {
        for (i, row) in block.channels.iter().enumerate() {
            for (k, column) in block.channels.iter().enumerate() {
                all[row * dimension + column] = arrow.blocks[j].own[i][k];
            }
            for (k, column) in block.columns.iter().enumerate() {
                all[row * dimension + s.border[*column]] = arrow.blocks[j].right[i][k];
            }
            for (k, place) in block.rows.iter().enumerate() {
                all[s.border[*place] * dimension + row] = arrow.blocks[j].left[k][i];
            }
            for (k, target) in s.tail.clone().enumerate() {
                all[target * dimension + row] = arrow.blocks[j].tail[i][k];
            }
        }
    }
    all
}

/// Compares a Jacobian at a state with differences of the rate; `exempt` says of row and column what is taken explicitly.
/// Returns how many entries were compared.
fn compare(machine: &RotorMachine, state: &[f64], exempt: &dyn Fn(usize, usize) -> bool) -> usize {
    let mut linear = MachineLinear::of(machine).expect("planar");
    let mut arrow = Arrowhead::new(linear.shape());
    let n = machine.dimension();
    let mode = machine.start_mode();
    linear.jacobian(&mode, 0.0, state, &mut arrow);
    let ours = whole(&arrow, n);
    let mut checked = 0;
    for column in 0..machine.layout().ledger() {
        let rate_at = |step: f64| {
            let mut moved = state.to_vec();
            moved[column] += step;
            let mut rate = vec![0.0; n];
            machine.rate(&mode, 0.0, &moved, &mut rate, &mut []);
            rate
        };
        // differences to both sides and over half the length: where a corner of a contact force lies between,
        // they disagree
        let scale = machine.error_scale(column);
        let here = rate_at(0.0);
        let slopes = |step: f64| -> [Vec<f64>; 2] {
            [step, -step].map(|step| {
                let there = rate_at(step);
                let pairs = there.iter().zip(&here);
                pairs.map(|(there, here)| (there - here) / step).collect()
            })
        };
        let (long, short) = (slopes(1e-6 * scale), slopes(5e-7 * scale));
        for row in (0..n).filter(|row| !exempt(*row, column)) {
            let size = machine.error_scale(row) / scale * 1e3;
            let [coarse, fine] = [&long, &short].map(|s| 0.5 * (s[0][row] + s[1][row]));
            let sides = (short[0][row] - short[1][row]).abs();
            let apart = (coarse - fine).abs().max(1e-2 * sides);
            if apart > 1e-5 * (fine.abs() + size) {
                continue;
            }
            checked += 1;
            let value = ours[row * n + column];
            assert!(
                (value - fine).abs() < 1e-4 * (fine.abs() + size),
                "d {} / d {}: {value} instead of {fine}",
                machine.channel_name(row),
                machine.channel_name(column)
            );
        }
    }
    checked
}

#[test]
fn the_jacobian_is_the_derivative_of_the_rate() {
    let mut random = crate::machines::Random(11);
    let (mut held, mut guided_by_balls, mut tilted) = (reference(), reference(), reference());
    held.bearings[0].inner_race.centre_held = true;
    separate(&mut guided_by_balls, Separation::FreeCage(None));
    tilt_contacts(planar(&mut tilted), 0.4);
    planar(&mut tilted).ball.inner_track_growth = 5e-12;
    for mut constants in [reference(), held, tilted, guided_by_balls] {
        planar(&mut constants).ball.orbit_drag = 1e-3;
        // forces on the centre of a free cage, and what its place does elsewhere, are taken explicitly
        let first = BEARING + CAGE_PLACE;
        let place = first..BEARING + planar(&mut constants).first_ball_state();
        let machine = RotorMachine::new(constants);
        // what a growing race takes in is a product of sums over the balls, and nothing depends on it
        let growth = machine.layout().source(3);
        let exempt = |row: usize, column: usize| {
            place.contains(&row) || place.contains(&column) || row == growth
        };
        let n = machine.dimension();
        let checked: usize = (0..20)
            .map(|_| compare(&machine, &random_state(&machine, &mut random), &exempt))
            .sum();
        assert!(checked > 20 * n * n / 2, "{checked}");
    }
}

#[test]
fn the_jacobian_of_several_bearings_is_the_derivative_of_the_rate() {
    let mut random = crate::machines::Random(12);
    let half = RotorMachine::new(reference());
    let whole = twins(&half);
    let n = whole.dimension();
    let mut checked = 0;
    for _ in 0..5 {
        let state = of_twins(&whole, &half, &random_state(&half, &mut random));
        checked += compare(&whole, &state, &|_, _| false);
    }
    assert!(checked > 5 * n * n / 2, "{checked}");
}

/// A drop by explicit or by linearly implicit steps.
fn drop(
    constants: MachineConstants,
    end: f64,
    tolerance: f64,
    implicit: bool,
) -> (Record, Ending, f64) {
    let machine = RotorMachine::new(constants);
    let start = machine.start();
    let mut record = Record::new(&machine, end, end / 10.0, false);
    let never = AtomicBool::new(false);
    let settings = settings(end, tolerance);
    let ending = if implicit {
        let linear = MachineLinear::of(&machine).expect("planar");
        solve::run_implicit::<f64, Machines<f64>, _, _, _, _, _>(
            &machine,
            linear,
            &start,
            &mut record,
            &settings,
            &never,
        )
    } else {
        let records = std::slice::from_mut(&mut record);
        solve::run::<f64, Machines<f64>, _>(
            &[&machine],
            std::slice::from_ref(&start),
            records,
            &settings,
            &never,
        )
        .remove(0)
    };
    assert_eq!(ending.stop, Stop::Finished);
    let balance = machine.balance(&start, &ending.state);
    let residual = balance.energy_residual() / balance.heat();
    (record, ending, residual)
}

#[test]
fn an_implicit_drop_is_the_explicit_one() {
    // both converge to the same first impact, start of the second contact and spin-up time; late contacts are chaotic
    let (explicit, _, _) = drop(with_reference_speed(0.1), 0.03, 1e-6, false);
    let (implicit, ending, residual) = drop(with_reference_speed(0.1), 0.03, 1e-4, true);
    let peak = |record: &Record| record.bearings[0].contacts[0].peak_force;
    let second = |record: &Record| record.bearings[0].contacts[1].start;
    let half = |record: &Record| {
        record.bearings[0]
            .inner_race_time_to_50_percent()
            .expect("it is fast")
    };
    // measured 0.01 N, 0.1 µs and 2 µs; the time to half speed of perturbed starts spreads by 3 µs
    assert!((peak(&explicit) - peak(&implicit)).abs() < 0.1);
    assert!((second(&explicit) - second(&implicit)).abs() < 1e-6);
    assert!((half(&explicit) - half(&implicit)).abs() < 2e-5);
    assert!(residual.abs() < 1e-6, "{residual}");
    // the explicit method needs more at the same tolerance
    assert!(ending.work.accepted < 6500, "{:?}", ending.work);
}

#[test]
fn stiff_friction_costs_an_implicit_drop_little_more() {
    let (_, plain, _) = drop(with_reference_speed(0.1), 0.018, 1e-4, true);
    let (record, stiff, residual) = drop(with_reference_speed(0.001), 0.018, 1e-4, true);
    assert!(
        stiff.work.accepted < 2 * plain.work.accepted,
        "{:?} {:?}",
        plain.work,
        stiff.work
    );
    assert!(residual.abs() < 1e-6, "{residual}");
    // converged: 672.857 N with a tolerance of 1e-6 of the explicit method, in 226 000 steps to 0.03 s
    assert!(
        (record.bearings[0].contacts[0].peak_force - 672.857).abs() < 0.1,
        "{:?}",
        record.bearings[0].contacts[0]
    );
}

#[test]
fn steps_of_the_implicit_method_allocate_nothing_more() {
    let allocations = |end: f64| {
        let before = crate::counting::ALLOCATIONS.get();
        drop(with_reference_speed(0.01), end, 1e-3, true);
        crate::counting::ALLOCATIONS.get() - before
    };
    // growth of nothing but the run's length
    assert_eq!(allocations(0.0075), allocations(0.015));
}
