//! Rotors of the files in `validation/cases/rotor`, as this crate's parts.
#![allow(dead_code)] // each test uses its part

use nalgebra::DMatrix;
use rotor::{
    Annulus, Block, Coefficients, Disk, Element, Housing, Material, Place, PointMass, Rotor,
    Support,
};
use serde_json::Value;

/// All files with a whole rotor.
pub const NAMES: [&str; 8] = [
    "ross_amb_rotor_freefree",
    "ross_friswell_5_9_1_isotropic",
    "ross_friswell_5_9_2_anisotropic",
    "ross_friswell_5_9_4_crosscoupled_kxy_eq_kyx",
    "ross_friswell_5_9_5_damped",
    "ross_friswell_5_9_9_overhung",
    "ross_rotor_example",
    "ross_rotor_on_compliant_mounts",
];

/// A rotor and its file.
pub struct Case {
    pub rotor: Rotor,
    pub file: Value,
}

fn folder() -> &'static str {
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../validation/cases/rotor")
}

pub fn json(name: &str) -> Value {
    let path = format!("{}/{name}.json", folder());
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

pub fn dense(value: &Value) -> DMatrix<f64> {
    let rows = value.as_array().unwrap();
    DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i][j].as_f64().unwrap())
}

pub fn sparse(value: &Value, size: usize) -> DMatrix<f64> {
    let list = |key: &str| value[key].as_array().unwrap();
    let mut out = DMatrix::zeros(size, size);
    for ((i, j), v) in list("rows").iter().zip(list("cols")).zip(list("vals")) {
        out[(i.as_u64().unwrap() as usize, j.as_u64().unwrap() as usize)] += v.as_f64().unwrap();
    }
    out
}

pub fn case(name: &str) -> Case {
    let file = json(name);
    let model = &file["model"];
    let number = |v: &Value, key: &str| v[key].as_f64().unwrap();
    let index = |v: &Value, key: &str| v[key].as_u64().unwrap() as usize;
    let list = |key: &str| model[key].as_array().unwrap();
    let nodes: Vec<f64> = list("node_positions_m")
        .iter()
        .map(|z| z.as_f64().unwrap())
        .collect();
    let count = nodes.len();
    let place = |n: usize| {
        if n < count {
            Place::Node(n)
        } else {
            Place::Housing(n - count)
        }
    };
    let elements = list("shaft_elements").iter().map(|e| Element {
        left: index(e, "n_l"),
        length: number(e, "L"),
        start: Annulus {
            outer: number(e, "odl"),
            inner: number(e, "idl"),
        },
        end: Annulus {
            outer: number(e, "odr"),
            inner: number(e, "idr"),
        },
        material: Material {
            young: number(e, "E"),
            shear: number(e, "G"),
            density: number(e, "rho"),
        },
        carries: true,
        damping_of_mass: number(e, "alpha"),
        damping_of_stiffness: number(e, "beta"),
        damping_rotating: 0.0,
    });
    let disks = list("disks").iter().map(|d| Disk {
        node: index(d, "n"),
        mass: number(d, "m"),
        polar: number(d, "Ip"),
        diametral: number(d, "Id"),
    });
    let mut masses = Vec::new();
    let mut housings = Vec::new();
    for mass in list("point_masses") {
        match place(index(mass, "n")) {
            Place::Node(node) => masses.push(PointMass {
                node,
                mass: number(mass, "m"),
            }),
            Place::Housing(_) => housings.push(Housing {
                mass: number(mass, "m"),
            }),
        }
    }
    let supports = list("bearings").iter().map(|b| {
        let one = |key: &str| b[key][0].as_f64().unwrap();
        let two = |s: &str| {
            [
                [one(&format!("{s}xx")), one(&format!("{s}xy"))],
                [one(&format!("{s}yx")), one(&format!("{s}yy"))],
            ]
        };
        Support {
            at: place(index(b, "n")),
            on: b["n_link"].as_u64().map(|n| n as usize - count),
            coefficients: Coefficients::constant(Block {
                stiffness: two("k"),
                damping: two("c"),
                mass: [[one("mxx"), 0.0], [0.0, one("myy")]],
            }),
            seal: false,
        }
    });
    let rotor = Rotor {
        elements: elements.collect(),
        disks: disks.collect(),
        supports: supports.collect(),
        nodes,
        masses,
        housings,
        unbalance: Vec::new(),
    };
    Case { rotor, file }
}
