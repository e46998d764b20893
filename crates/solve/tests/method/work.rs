//! Work on fixed problems: a change of these counts is a change of efficiency, to be understood before it is written
//! down here.

use crate::problems::{Blind, Problem, VanDerPol, VanDerPols, adaptive, run_alone};
use solve::{Ending, Settings, Work};
use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

fn van_der_pol(stiffness: f64, end: f64) -> Ending {
    let machine = VanDerPol {
        stiffness,
        landings: vec![0.5 * end],
    };
    let settings = Settings {
        start: 0.0,
        end,
        tolerance: 1e-4,
        first_step: 1e-3,
        largest_step: f64::INFINITY,
        step_limit: 1_000_000,
    };
    solve::run::<f64, VanDerPols<f64>, Blind>(
        &solve::BOGACKI_SHAMPINE,
        &[&machine],
        &[vec![2.0, 0.0]],
        &mut [Blind],
        &settings,
        &AtomicBool::new(false),
    )
    .remove(0)
}

#[test]
fn work_of_smooth_and_of_stiff_oscillation() {
    let smooth = van_der_pol(1.0, 20.0).work;
    let stiff = van_der_pol(100.0, 20.0).work;
    assert_eq!(
        (smooth, stiff),
        (
            Work {
                accepted: 155,
                rejected: 2,
                rate_calls: 471
            },
            Work {
                accepted: 2232,
                rejected: 2,
                rate_calls: 6702
            }
        )
    );
}

#[test]
fn work_of_one_orbit() {
    let start = [0.7, 0.0, 0.0, (1.3_f64 / 0.7).sqrt()];
    let end = run_alone(
        &Problem::kepler(),
        &start,
        &mut Blind,
        &adaptive(2.0 * PI, 1e-6),
    );
    assert_eq!(
        end.work,
        Work {
            accepted: 299,
            rejected: 0,
            rate_calls: 897
        }
    );
}
