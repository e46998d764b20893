//! Eigenvalues, critical speeds, response to unbalance, sag and reduction against another program and closed forms.
//!
//! Source: ROSS 2.3.0 (files of `validation/cases/rotor`); values in 40 digits of the 52-element rotor.

mod published;

use published::{Case, NAMES, case};
use rotor::{Analysis, Basis, C64, Matrices, Responder, Unbalance, Whirl};
use serde_json::Value;

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap()
}

/// Eigenvalues of the file that lie in the bending planes.
fn lateral(entry: &Value) -> Vec<C64> {
    (entry["modes"].as_array().unwrap().iter())
        .filter(|mode| mode["kind"] == "lateral")
        .map(|mode| C64::new(number(mode, "re"), number(mode, "im")))
        .collect()
}

#[test]
fn eigenvalues_are_those_of_the_files() {
    for name in NAMES {
        let Case { rotor, file } = case(name);
        let analysis = Analysis::full(&rotor).unwrap();
        // Dense solvers lose 1e-7 on the lowest modes of the rotor with short stiff elements.
        let tolerance = if name.contains("amb") { 5e-7 } else { 1e-8 };
        for entry in file["eigenvalues"].as_array().unwrap() {
            let speed = number(entry, "speed_rad_s");
            let mut ours = analysis.oscillations(speed).unwrap();
            for reference in lateral(entry) {
                let distance = |z: &C64| (C64::new(z.re, z.im.abs()) - reference).norm();
                let nearest = (0..ours.len())
                    .min_by(|a, b| distance(&ours[*a]).total_cmp(&distance(&ours[*b])))
                    .unwrap();
                let error = distance(&ours.remove(nearest)) / reference.norm();
                assert!(error < tolerance, "{name} {speed} {reference}: {error:e}");
            }
        }
    }
}

#[test]
fn bending_modes_of_the_52_element_rotor_agree_with_40_digits() {
    let Case { mut rotor, .. } = case("ross_amb_rotor_freefree");
    rotor.supports.clear();
    for element in &mut rotor.elements {
        element.damping_of_mass = 0.0;
    }
    let found = Analysis::full(&rotor).unwrap().modes(0.0, 6).unwrap();
    for (pair, exact) in found
        .chunks(2)
        .zip([655.1676021, 2516.0003149, 4829.4018549])
    {
        for mode in pair {
            assert!(
                (mode.frequency() / exact - 1.0).abs() < 1e-10,
                "{}",
                mode.frequency()
            );
        }
    }
}

#[test]
fn critical_speeds_are_those_of_the_files() {
    let mut seen = 0;
    for name in NAMES {
        let Case { rotor, file } = case(name);
        let Some(reference) = file.get("critical_speeds") else {
            continue;
        };
        let reference: Vec<f64> = (reference["rad_s"].as_array().unwrap().iter())
            .map(|v| v.as_f64().unwrap())
            .collect();
        let analysis = Analysis::full(&rotor).unwrap();
        let top = reference.last().unwrap() * 1.01;
        let speeds: Vec<f64> = (0..=60).map(|k| top * f64::from(k) / 60.0).collect();
        let diagram = analysis.campbell(&speeds, top).unwrap();
        let found: Vec<f64> = analysis
            .criticals(&diagram)
            .unwrap()
            .iter()
            .map(|c| c.speed)
            .collect();
        assert_eq!(
            found.len(),
            reference.len(),
            "{name}: {found:?} {reference:?}"
        );
        for (ours, theirs) in found.iter().zip(&reference) {
            assert!(
                (ours / theirs - 1.0).abs() < 1e-8,
                "{name}: {ours} {theirs}"
            );
            seen += 1;
        }
    }
    assert!(seen >= 40, "{seen}");
}

#[test]
fn responses_to_unbalance_are_those_of_the_files() {
    let mut seen = 0;
    for name in NAMES {
        let Case { rotor, file } = case(name);
        let Some(given) = file.get("unbalance") else {
            continue;
        };
        let list = |v: &Value| -> Vec<f64> {
            v.as_array()
                .unwrap()
                .iter()
                .map(|v| v.as_f64().unwrap())
                .collect()
        };
        let unbalance: Vec<Unbalance> = (list(&given["node"]).iter())
            .zip(list(&given["magnitude_kg_m"]))
            .zip(list(&given["phase_rad"]))
            .map(|((node, amount), phase)| Unbalance {
                node: *node as usize,
                amount,
                phase,
            })
            .collect();
        let responder = Responder::new(&rotor);
        for (k, speed) in list(&given["speeds_rad_s"]).iter().enumerate() {
            let ours = responder.unbalance(&unbalance, *speed).unwrap();
            for entry in given["response"].as_array().unwrap() {
                let node = entry["node"].as_u64().unwrap() as usize;
                let (x, y) = ours.planes(2 * node);
                let reference = |key: &str| {
                    C64::new(
                        list(&entry[&format!("{key}_re")])[k],
                        list(&entry[&format!("{key}_im")])[k],
                    )
                };
                let (rx, ry) = (reference("x"), reference("y"));
                let scale = rx.norm().max(ry.norm());
                let error = (x - rx).norm().max((y - ry).norm()) / scale;
                assert!(error < 1e-9, "{name} node {node} at {speed}: {error:e}");
                seen += 1;
            }
        }
    }
    assert!(seen > 60);
}

#[test]
fn sag_and_loads_are_those_of_the_file() {
    let Case { rotor, file } = case("ross_rotor_example");
    let gravity = C64::new(0.0, -9.8065);
    let sag = rotor::sag(&rotor, 0.0, gravity).unwrap();
    let weight = rotor::properties(&rotor).mass * 9.8065;
    let reference = number(&file["static"]["bearing_forces"], "node_0");
    for load in &sag.loads {
        assert!((load.im - weight / 2.0).abs() < 1e-9 * weight && load.re.abs() < 1e-9 * weight);
        assert!(
            (load.im / reference - 1.0).abs() < 1e-5,
            "{} {reference}",
            load.im
        );
    }
    // The file holds the rotor in rigid supports: the sag over the line between them.
    let deformation: Vec<f64> = (file["static"]["deformation"].as_array().unwrap().iter())
        .map(|v| v.as_f64().unwrap())
        .collect();
    for (node, theirs) in deformation.iter().enumerate() {
        let ours = sag.shape[2 * node].im - sag.shape[0].im;
        assert!(
            (ours - theirs).abs() < 1e-5 * 7.5e-4,
            "{node}: {ours:e} {theirs:e}"
        );
    }
}

#[test]
fn whirl_and_its_sign_are_those_of_a_disk() {
    // A disk on a short stiff shaft of no weight to speak of: the tilting mode of a free body, ω = 0 backward and
    // Ω I_p/I_d forward.
    let Case { mut rotor, .. } = case("ross_amb_rotor_freefree");
    rotor.supports.clear();
    for element in &mut rotor.elements {
        element.damping_of_mass = 0.0;
    }
    let body = rotor::properties(&rotor);
    let slow = 1.0;
    let modes = Analysis::full(&rotor).unwrap().modes(slow, 1).unwrap();
    let expected = slow * body.polar / body.transverse;
    // The bending of the shaft follows by (speed / first bending mode)².
    assert!(
        (modes[0].frequency() / expected - 1.0).abs() < 1e-5,
        "{} {expected}",
        modes[0].frequency()
    );
    assert_eq!(modes[0].whirl, Whirl::Forward);
    let against = Analysis::full(&rotor).unwrap().modes(-slow, 1).unwrap();
    assert_eq!(against[0].whirl, Whirl::Forward);
    assert!((against[0].frequency() - modes[0].frequency()).abs() < 1e-9);
}

#[test]
fn rotating_damping_destabilises_above_the_critical_speed() {
    // Jeffcott: stable while Ω < ω(1 + c_e/c_i); with no other damping that is the critical speed itself.
    let Case { mut rotor, .. } = case("ross_friswell_5_9_1_isotropic");
    for element in &mut rotor.elements {
        element.damping_rotating = 1e-5;
    }
    let analysis = Analysis::full(&rotor).unwrap();
    let first = |speed: f64| {
        let all = analysis.oscillations(speed).unwrap();
        *all.iter().find(|z| z.im > 0.0).unwrap()
    };
    assert!(first(80.0).re < 0.0 && first(95.0).re > 0.0);
}

#[test]
fn the_reduced_rotor_says_what_the_whole_one_does() {
    let Case { mut rotor, .. } = case("ross_amb_rotor_freefree");
    for support in &mut rotor.supports {
        support.coefficients = rotor::Coefficients::constant(rotor::Block::equal(2e5, 100.0));
    }
    rotor.unbalance = vec![Unbalance {
        node: 28,
        amount: 2e-5,
        phase: 0.0,
    }];
    let matrices = Matrices::new(&rotor);
    let full = Basis::full(&rotor, &matrices).unwrap();
    let kept = rotor.kept();
    assert_eq!(kept, [24, 56, 86]);
    let start = std::time::Instant::now();
    let basis = full.for_analysis(&rotor, &matrices, 2e4, 7500.0).unwrap();
    let reduced = Analysis::new(&rotor, &matrices, basis.clone());
    let speeds: Vec<f64> = (0..100).map(|k| 3000.0 * f64::from(k) / 99.0).collect();
    let diagram = reduced.campbell(&speeds, 5000.0).unwrap();
    println!("diagram {:?}", start.elapsed());
    let whole = Analysis::new(&rotor, &matrices, full.clone());
    let error = [0, 99].map(|at| whole.error_of(&diagram, at, 5000.0).unwrap());
    println!(
        "{} coordinates, {} branches, error {error:?}, {:?}",
        basis.len(),
        diagram.branches.len(),
        start.elapsed()
    );

    assert!(
        diagram
            .branches
            .iter()
            .all(|b| b.modes.iter().all(Option::is_some))
    );
    // 2e-5 without the gyroscopic residuals, 2e-8 with them.
    assert!(basis.len() < 20 && error.iter().all(|e| *e < 1e-6));
    let receptance = basis.receptance_error(&full, &kept, 100.0, 7500.0);
    let free = full
        .reduced(2e4, &rotor::unit_forces(rotor.size(), &[]))
        .unwrap()
        .receptance_error(&full, &kept, 100.0, 7500.0);
    println!("receptance {receptance:e}, without residual flexibility {free:e}");
    assert!(receptance < 1e-3 && free > 20.0 * receptance);
    assert!(reduced.criticals(&diagram).unwrap().len() >= 3);
}

#[test]
fn more_modes_than_there_are_and_a_free_rotor_are_refused() {
    let Case { mut rotor, .. } = case("ross_rotor_example");
    let analysis = Analysis::full(&rotor).unwrap();
    assert!(matches!(
        analysis.modes(100.0, 1000),
        Err(rotor::RotorError::TooManyModes {
            asked: 1000,
            there: 28
        })
    ));
    rotor.supports.pop();
    assert!(rotor::sag(&rotor, 0.0, C64::new(0.0, -9.81)).is_err());
    let analysis = Analysis::full(&rotor).unwrap();
    assert!(rotor::stiffness_map(&rotor, &analysis.basis, &[1e6], 3).is_err());
}

#[test]
fn the_stiffness_map_meets_the_campbell_diagram() {
    let Case { rotor, file } = case("ross_friswell_5_9_1_isotropic");
    let analysis = Analysis::full(&rotor).unwrap();
    let map = rotor::stiffness_map(&rotor, &analysis.basis, &[1e6], 4).unwrap();
    let mut all: Vec<f64> = map[0]
        .forward
        .iter()
        .chain(&map[0].backward)
        .copied()
        .collect();
    all.sort_by(f64::total_cmp);
    for (ours, theirs) in all
        .iter()
        .zip(file["critical_speeds"]["rad_s"].as_array().unwrap())
    {
        assert!((ours / theirs.as_f64().unwrap() - 1.0).abs() < 1e-9);
    }
    assert!(map[0].backward[0] < map[0].forward[0]);
}
