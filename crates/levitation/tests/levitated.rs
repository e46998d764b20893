//! The levitated rotor of an independent implementation: eigenvalues, sensitivity, unbalance, impulse, static position, start of a drop.
//!
//! Source: `validation/cases/reference/machine_levitated.json` and `machine_drop_flexible.json`; tolerances are those of the files, for
//! all coordinates of the rotor and for a reduced basis.

#[path = "../../rotor/tests/published/mod.rs"]
mod published;
mod reference;

use levitation::response::{equilibrium, impulse, start, unbalance};
use levitation::sensitivity::{Axes, Band, Sensitivity};
use levitation::{C64, ClosedLoop, Verdict, suspension, verdict, weight};
use reference::{Basis, File, complex};
use rotor::{Block, Coefficients, Place, Responder, Support, Whirl};
use serde_json::Value;
use std::f64::consts::TAU;

const GRAVITY: [f64; 2] = [0.0, -9.81];

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap()
}
fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().unwrap()
}
fn nodes(value: &Value) -> Vec<usize> {
    let all = list(value, "nodes").iter();
    all.map(|node| node.as_u64().unwrap() as usize).collect()
}

/// Largest deviation over the largest of the same kind.
fn share(pairs: &[(C64, C64)]) -> f64 {
    let largest = pairs
        .iter()
        .map(|(_, wanted)| wanted.norm())
        .fold(0.0, f64::max);
    let worst = pairs
        .iter()
        .map(|(ours, wanted)| (ours - wanted).norm())
        .fold(0.0, f64::max);
    worst / largest
}

#[test]
fn eigenvalues_of_the_whole_and_of_the_reduced_rotor() {
    let file = File::levitated();
    for (basis, near, filters) in [(Basis::Whole, 1e-6, 1e-6), (Basis::Reduced, 1e-5, 2e-4)] {
        for result in file.results() {
            let speed = number(result, "speed_rad_s");
            let closed = file.turning(basis, speed);
            let poles = closed.poles().unwrap();
            assert_eq!(verdict(&poles), Verdict::Stable);
            let mut worst = 0.0_f64;
            for wanted in list(result, "eigenvalues").iter().map(complex) {
                let distance = |pole: &levitation::Pole| (pole.value - wanted).norm();
                let nearest = poles.iter().map(distance).fold(f64::INFINITY, f64::min);
                let share = if wanted.re < -2.5e4 { filters } else { near };
                worst = worst.max(nearest / (share * wanted.norm() + 1e-5));
            }
            println!(
                "{speed}: {worst:.2e} of the tolerance, {} states",
                closed.states()
            );
            assert!(worst < 1.0);
        }
    }
}

#[test]
fn without_controller_the_rotor_leaves_its_centre() {
    let file = File::levitated();
    let open = file.turning(Basis::Whole, 0.0).open_loop().unwrap();
    let largest = open.iter().map(|value| value.re).fold(f64::MIN, f64::max);
    let wanted = number(&file.file, "open_loop_largest_real_part");
    assert!((largest / wanted - 1.0).abs() < 1e-6, "{largest}");
}

#[test]
fn sensitivity_of_one_axis_with_all_others_closed() {
    let file = File::levitated();
    for (basis, samples, peaks) in [
        (Basis::Whole, 1e-6, None),
        (Basis::Reduced, 4e-5, Some(4e-5)),
    ] {
        for result in file.results() {
            let speed = number(result, "speed_rad_s");
            let closed = file.turning(basis, speed);
            let axes = Axes::new(&closed).unwrap();
            for sample in list(result, "sensitivity_samples") {
                let ours = axes.at(number(sample, "rad_s")).unwrap();
                for (ours, wanted) in ours.iter().zip(list(sample, "S")) {
                    let wanted = wanted.as_f64().unwrap();
                    assert!(
                        (ours.norm() / wanted - 1.0).abs() < samples,
                        "{speed} {sample}"
                    );
                }
            }
            let Some(tolerance) = peaks else { continue };
            let poles = closed.poles().unwrap();
            let band = Band {
                from: TAU,
                to: TAU * 3000.0,
            };
            let now = std::time::Instant::now();
            let found = Sensitivity::new(&closed, &poles, band).unwrap();
            println!("{} points in {:?}", found.grid.len(), now.elapsed());
            for (ours, wanted) in found.peaks.iter().zip(list(result, "sensitivity_peak")) {
                assert!((ours.size / number(wanted, "S") - 1.0).abs() < tolerance);
                assert!(
                    (ours.at / number(wanted, "at_rad_s") - 1.0).abs() < 1e-4,
                    "{ours:?}"
                );
            }
        }
    }
}

#[test]
fn peaks_of_the_whole_rotor() {
    let file = File::levitated();
    let result = &file.results()[2];
    let closed = file.turning(Basis::Whole, number(result, "speed_rad_s"));
    for (axis, wanted) in list(result, "sensitivity_peak").iter().enumerate() {
        let near = number(wanted, "at_rad_s");
        let band = Band {
            from: 0.98 * near,
            to: 1.02 * near,
        };
        let ours = Sensitivity::new(&closed, &[], band).unwrap().peaks[axis];
        assert!((ours.size / number(wanted, "S") - 1.0).abs() < 1e-5);
        assert!((ours.at / near - 1.0).abs() < 1e-4);
    }
}

#[test]
fn unbalance_response() {
    let file = File::levitated();
    for (basis, tolerance) in [(Basis::Whole, 1e-6), (Basis::Reduced, 2e-5)] {
        for result in file.results() {
            let Some(reference) = result.get("unbalance_response") else {
                continue;
            };
            let speed = number(result, "speed_rad_s");
            let ours = unbalance(&file.turning(basis, speed), &file.unbalance(), speed).unwrap();
            let moved = nodes(reference).into_iter().zip(list(reference, "w"));
            let moved: Vec<_> = moved.map(|(n, w)| (ours.forward[n], complex(w))).collect();
            let currents: Vec<_> = (ours.currents.iter().copied())
                .zip(list(reference, "current_A").iter().map(complex))
                .collect();
            println!("{speed}: {:.1e}, {:.1e}", share(&moved), share(&currents));
            assert!(share(&moved) < tolerance && share(&currents) < tolerance);
        }
    }
}

/// Magnets as a support of the rotor's own analyses, in one plane and in two: modes with their sense, response to unbalance and
/// critical speeds are those of the closed loop.
#[test]
fn analyses_of_the_rotor_know_its_magnets() {
    let (even, mut file) = (File::levitated(), File::levitated());
    for equal in [true, false] {
        if !equal {
            let mut uneven = Block::default();
            uneven.stiffness[1][1] = 1e-6;
            file.rotor.supports.push(Support {
                at: Place::Node(3),
                on: None,
                coefficients: Coefficients::constant(uneven),
                seal: false,
            });
        }
        let analysis = file.analysis(Basis::Reduced);
        let count = file.rotor.nodes.len();
        let levitation = file.levitation(0.3);
        let held = suspension(
            &analysis,
            count,
            &levitation,
            &levitation.slopes_at_centre(),
        );
        let held = held.unwrap();
        let analysis = analysis.held_by(held);
        assert_eq!(analysis.turns(), equal);
        let responder = Responder::within(&analysis);
        for result in file.results() {
            let speed = number(result, "speed_rad_s");
            let known = list(result, "eigenvalues").iter().map(complex);
            let known: Vec<C64> = known.collect();
            for mode in analysis.modes(speed, 8).unwrap() {
                let own = match mode.whirl {
                    Whirl::Backward => mode.eigenvalue.conj(),
                    _ => mode.eigenvalue,
                };
                let distance = known.iter().map(|z| (z - own).norm());
                let nearest = distance.fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-5 * own.norm(), "{speed}: {own} {nearest:.1e}");
            }
            let Some(reference) = result.get("unbalance_response") else {
                continue;
            };
            let ours = responder.unbalance(&file.unbalance(), speed).unwrap();
            let moved = nodes(reference).into_iter().zip(list(reference, "w"));
            let moved: Vec<_> = moved
                .map(|(node, w)| (ours.forward[2 * node], complex(w)))
                .collect();
            assert!(share(&moved) < 2e-5, "{speed}: {:.1e}", share(&moved));
        }
        let speeds: Vec<f64> = (0..=60).map(|k| 25.0 * f64::from(k)).collect();
        let diagram = analysis.campbell(&speeds, 3000.0).unwrap();
        let criticals = analysis.criticals(&diagram).unwrap();
        assert!(criticals.len() >= 4, "{}", criticals.len());
        for critical in &criticals {
            let poles = even.turning(Basis::Reduced, critical.speed).poles();
            let nearest = (poles.unwrap().iter())
                .map(|pole| (pole.value.im.abs() - critical.speed).abs())
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-7 * critical.speed, "{}", critical.speed);
        }
    }
}

#[test]
fn impulse_response() {
    let file = File::levitated();
    let reference = &file.file["impulse_response"];
    let speed = number(reference, "speed_rad_s");
    let rows = list(reference, "rows");
    let times: Vec<f64> = rows.iter().map(|row| number(row, "t")).collect();
    for (basis, late, early) in [(Basis::Whole, 1e-6, 1e-6), (Basis::Reduced, 1e-3, 5e-3)] {
        let closed = file.turning(basis, speed);
        let states = impulse(&closed, 28, 0.02, &times).unwrap();
        let (mut moved, mut currents) = (Vec::new(), Vec::new());
        for (row, state) in rows.iter().zip(&states) {
            let w = closed.displacements(state);
            let own = nodes(reference).into_iter().zip(list(row, "w"));
            moved.push(
                own.map(|(n, wanted)| (w[n], complex(wanted)))
                    .collect::<Vec<_>>(),
            );
            let own = closed
                .currents(state)
                .into_iter()
                .zip(list(row, "current_A"));
            currents.push(
                own.map(|(i, wanted)| (i, complex(wanted)))
                    .collect::<Vec<_>>(),
            );
        }
        for kind in [moved, currents] {
            let largest = kind
                .iter()
                .flatten()
                .map(|(_, w)| w.norm())
                .fold(0.0, f64::max);
            for (row, time) in kind.iter().zip(&times) {
                let worst = row
                    .iter()
                    .map(|(ours, w)| (ours - w).norm())
                    .fold(0.0, f64::max);
                println!("{time}: {:.1e}", worst / largest);
                assert!(worst / largest < if *time < 1e-3 { early } else { late });
            }
        }
    }
}

#[test]
fn static_position_with_integrators() {
    let file = File::levitated();
    let reference = &file.file["static_values"];
    let analysis = file.analysis(Basis::Whole);
    let plant = file.plant(Basis::Whole, 0.0);
    let loads = weight(&file.rotor, &analysis, GRAVITY);
    let ours = equilibrium(&plant, &file.levitation(0.0), &loads).unwrap();
    let largest = 2.3e-5;
    for (node, wanted) in nodes(reference).into_iter().zip(list(reference, "w")) {
        let along = |angle| (plant.row(node, angle) * &ours.coordinates)[0];
        let w = C64::new(along(0.0), along(0.5 * std::f64::consts::PI));
        let error = (w - complex(wanted)).norm();
        assert!(error < 1e-6 * largest + 1e-13, "{node}: {error:e}");
    }
    for (magnet, wanted) in list(reference, "current_A").iter().enumerate() {
        let i = C64::new(ours.currents[2 * magnet], ours.currents[2 * magnet + 1]);
        assert!((i - complex(wanted)).norm() < 1e-6 * complex(wanted).norm());
    }
}

#[test]
fn start_of_a_drop() {
    let file = File::drop();
    let reference = &file.file["start"];
    let speed = number(&file.file, "Om");
    let analysis = file.analysis(Basis::Whole);
    let plant = file.plant(Basis::Whole, speed);
    let loads = weight(&file.rotor, &analysis, GRAVITY);
    for angle in [0.0, 0.7] {
        let levitation = file.levitation(angle);
        let ours = start(&plant, &levitation, &loads, &file.unbalance(), speed, 0.0).unwrap();
        let size = analysis.basis.len();
        let shapes = &analysis.basis.shapes;
        for (key, values) in [("q", &ours.coordinates), ("qd", &ours.rates)] {
            let (x, y) = (
                shapes * values.rows(0, size),
                shapes * values.rows(size, size),
            );
            let pairs = list(reference, key).iter().enumerate();
            let pairs: Vec<_> = pairs
                .map(|(k, w)| (C64::new(x[k], y[k]), complex(w)))
                .collect();
            // displacements and slopes are kinds of their own
            for kind in [0, 1] {
                let own: Vec<_> = pairs.iter().copied().skip(kind).step_by(2).collect();
                println!("{key} {kind}: {:.1e}", share(&own));
                assert!(share(&own) < 1e-6);
            }
        }
        let turned = C64::from_polar(1.0, angle);
        for (magnet, wanted) in list(reference, "control_current_A").iter().enumerate() {
            let i = C64::new(ours.currents[2 * magnet], ours.currents[2 * magnet + 1]) * turned;
            assert!((i - complex(wanted)).norm() < 1e-6, "{i}");
        }
        // the states stand still against the turning part: their rates are those of the closed loop
        let closed = ClosedLoop::new(plant.clone(), &levitation).unwrap();
        assert_eq!(ours.states.len(), closed.states() - 4 * size);
    }
}
