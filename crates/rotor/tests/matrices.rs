//! The element and whole rotors against matrices of another program.
//!
//! Source: ROSS 2.3.0 (files of `validation/cases/rotor`). Its coordinates of a node are (x, y, z, α, β, θ): β = Re ψ, α = -Im ψ.

mod published;

use nalgebra::DMatrix;
use published::{Case, case};
use rotor::{Annulus, Element, Material};

/// Largest deviation over the largest of the same kind of entry: terms of order eps from another order of sums.
const TOLERANCE: f64 = 1e-12;

/// Which real coordinate of ours (x-plane, then y-plane) and with which sign a coordinate of the file is.
fn ours(dof: usize, nodes: usize, size: usize) -> Option<(usize, f64)> {
    let shaft = 6 * nodes;
    if dof >= shaft {
        let (housing, axis) = ((dof - shaft) / 3, (dof - shaft) % 3);
        return (axis < 2).then_some((axis * size + 2 * nodes + housing, 1.0));
    }
    let node = dof / 6;
    match dof % 6 {
        0 => Some((2 * node, 1.0)),
        1 => Some((size + 2 * node, 1.0)),
        3 => Some((size + 2 * node + 1, -1.0)),
        4 => Some((2 * node + 1, 1.0)),
        _ => None,
    }
}

fn compare(name: &str, ours_matrix: &DMatrix<f64>, reference: &DMatrix<f64>, nodes: usize) {
    let size = ours_matrix.nrows() / 2;
    let (mut worst, mut counted) = (0.0_f64, 0);
    for i in 0..reference.nrows() {
        for j in 0..reference.ncols() {
            let (Some((p, a)), Some((q, b))) = (ours(i, nodes, size), ours(j, nodes, size)) else {
                continue;
            };
            let scale = (reference[(i, i)] * reference[(j, j)]).abs().sqrt();
            let scale = if scale > 0.0 { scale } else { reference.amax() };
            let deviation = (a * b * ours_matrix[(p, q)] - reference[(i, j)]).abs();
            if deviation > 0.0 {
                worst = worst.max(deviation / scale);
            }
            counted += 1;
        }
    }
    assert_eq!(counted, ours_matrix.len());
    assert!(worst < TOLERANCE, "{name}: {worst:e}");
}

#[test]
fn the_tapered_hollow_element_is_that_of_the_file() {
    let file = published::json("ross_tapered_element");
    let input = |key: &str| file["input"][key].as_f64().unwrap();
    let element = Element {
        left: 0,
        length: input("L"),
        start: Annulus {
            outer: input("odl"),
            inner: input("idl"),
        },
        end: Annulus {
            outer: input("odr"),
            inner: input("idr"),
        },
        material: Material {
            young: input("E"),
            shear: input("G"),
            density: input("rho"),
        },
        carries: true,
        damping_of_mass: 0.0,
        damping_of_stiffness: 0.0,
        damping_rotating: 0.0,
    };
    assert!((element.shear_coefficient() / input("kappa") - 1.0).abs() < 1e-13);
    assert!((element.shear_ratio() / input("phi_shear") - 1.0).abs() < 1e-13);
    let rotor = rotor::Rotor {
        nodes: vec![0.0, element.length],
        elements: vec![element],
        ..rotor::Rotor::default()
    };
    let at_rest = rotor.real_dynamics(0.0);
    let gyroscopic = rotor.real_dynamics(1.0).damping;
    for (name, matrix) in [
        ("M", &at_rest.mass),
        ("K", &at_rest.stiffness),
        ("G", &gyroscopic),
    ] {
        compare(name, matrix, &published::dense(&file[name]), 2);
    }
}

#[test]
fn whole_rotors_have_the_matrices_of_the_files() {
    let mut seen = 0;
    for name in published::NAMES {
        let Case { rotor, file } = case(name);
        let Some(matrices) = file.get("matrices") else {
            continue;
        };
        let speed = matrices["speed_rad_s"].as_f64().unwrap();
        let (still, turning) = (rotor.real_dynamics(0.0), rotor.real_dynamics(speed));
        let nodes = rotor.nodes.len();
        let dofs = file["model"]["ndof"].as_u64().unwrap() as usize;
        let reference = |key: &str| published::sparse(&matrices[key], dofs);
        compare(name, &turning.mass, &reference("M"), nodes);
        compare(name, &turning.stiffness, &reference("K"), nodes);
        compare(name, &still.damping, &reference("C"), nodes);
        let gyroscopic = (&turning.damping - &still.damping) / speed;
        compare(name, &gyroscopic, &reference("G"), nodes);
        seen += 1;
    }
    assert_eq!(seen, 7);
}

#[test]
fn mass_properties_are_those_of_the_files() {
    for name in published::NAMES {
        let Case { rotor, file } = case(name);
        let ours = rotor::properties(&rotor);
        let model = |key: &str| file["model"][key].as_f64().unwrap();
        for (value, key) in [
            (ours.mass, "total_mass_kg"),
            (ours.centre, "cg_m"),
            (ours.polar, "Ip_total"),
        ] {
            assert!(
                (value / model(key) - 1.0).abs() < 1e-12,
                "{name} {key}: {value}"
            );
        }
    }
}

#[test]
fn complex_and_real_coordinates_say_the_same() {
    let Case { mut rotor, .. } = case("ross_amb_rotor_freefree");
    for element in &mut rotor.elements {
        element.damping_rotating = 1e-6;
    }
    // A seal whose cross-coupling turns with the rotor.
    rotor.supports[0].coefficients = rotor::Coefficients::constant(rotor::Block {
        stiffness: [[1e6, 2e5], [-2e5, 1e6]],
        damping: [[300.0, 20.0], [-20.0, 300.0]],
        mass: [[0.1, 0.0], [0.0, 0.1]],
    });
    let complex = rotor.complex_dynamics(1200.0).unwrap();
    let real = rotor.real_dynamics(1200.0);
    let n = rotor.size();
    let check = |c: &DMatrix<rotor::C64>, r: &DMatrix<f64>| {
        let room = 1e-15 * r.amax();
        for i in 0..n {
            for j in 0..n {
                let z = c[(i, j)];
                let all = [
                    (r[(i, j)], z.re),
                    (r[(n + i, n + j)], z.re),
                    (r[(i, n + j)], -z.im),
                    (r[(n + i, j)], z.im),
                ];
                assert!(all.iter().all(|(a, b)| (a - b).abs() <= room));
            }
        }
    };
    check(&complex.mass, &real.mass);
    check(&complex.damping, &real.damping);
    check(&complex.stiffness, &real.stiffness);
}
