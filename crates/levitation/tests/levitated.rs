//! The levitated rotor of an independent implementation: eigenvalues, sensitivity, unbalance, impulse, static position, start of a drop.
//!
//! Source: `shared/cases/reference/machine_levitated.json` and `machine_drop_flexible.json`; tolerances are those of the files.

#[path = "../../rotor/tests/published/mod.rs"]
mod published;
mod reference;

use levitation::response::{impulse, unbalance};
use levitation::{C64, ClosedLoop};
use reference::{Basis, File, complex};

#[test]
fn eigenvalues_of_the_whole_rotor() {
    let file = File::levitated();
    for result in file.results() {
        let speed = result["speed_rad_s"].as_f64().unwrap();
        let closed = file.closed(Basis::Whole, speed);
        let now = std::time::Instant::now();
        let poles = closed.poles().unwrap();
        println!("{:?} {} states", now.elapsed(), closed.states());
        let mut worst = 0.0_f64;
        for wanted in result["eigenvalues"].as_array().unwrap() {
            let wanted = complex(wanted);
            let nearest = poles.iter().map(|pole| (pole.value - wanted).norm()).fold(f64::INFINITY, f64::min);
            worst = worst.max(nearest / (1e-6 * wanted.norm() + 1e-5));
        }
        println!("{speed}: {worst} of the tolerance");
        let open = closed.open_loop().unwrap();
        let largest = open.iter().map(|v| v.re).fold(f64::NEG_INFINITY, f64::max);
        println!("open {largest}");
    }
}
