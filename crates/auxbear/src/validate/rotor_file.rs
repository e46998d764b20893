//! Rotors element by element, as the reference files have them.
//!
//! A file holds its rotor, or names the file of another program that does (`cases/rotor/NAME.json`): it is looked for beside
//! the file that names it and in a folder `rotor` next to its own.

use super::compare::part;
use rotor::{Annulus, Disk, Element, Material, PointMass, Rotor};
use serde::Deserialize;
use serde_json::Value;
use std::path::Path;

#[derive(Deserialize)]
struct Model {
    node_positions_m: Vec<f64>,
    shaft_elements: Vec<Shaft>,
    #[serde(default)]
    disks: Vec<Plate>,
    #[serde(default)]
    point_masses: Vec<Point>,
}

#[derive(Deserialize)]
struct Shaft {
    n_l: usize,
    #[serde(rename = "L")]
    length: f64,
    odl: f64,
    idl: f64,
    odr: f64,
    idr: f64,
    #[serde(rename = "E")]
    young: f64,
    #[serde(rename = "G")]
    shear: Option<f64>,
    nu: Option<f64>,
    rho: f64,
    #[serde(default)]
    alpha: f64,
    #[serde(default)]
    beta: f64,
    #[serde(default)]
    beta_internal: f64,
}

#[derive(Deserialize)]
struct Plate {
    n: usize,
    m: f64,
    #[serde(rename = "Id")]
    diametral: f64,
    #[serde(rename = "Ip")]
    polar: f64,
}

#[derive(Deserialize)]
struct Point {
    n: usize,
    m: f64,
}

/// The rotor of a file without its supports: its own, or that of the file it names.
pub(super) fn of(value: &Value, path: &Path) -> Result<Rotor, String> {
    if let Some(model) = value.get("rotor") {
        return free(model);
    }
    let text = value["definition"].as_str().unwrap_or_default();
    let named = text
        .split_whitespace()
        .map(|word| word.trim_end_matches([',', '.', ';', ':']))
        .find(|word| word.ends_with(".json"))
        .and_then(|word| word.rsplit('/').next())
        .ok_or("neither a rotor nor the name of its file")?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let places = [folder.join(named), folder.join("../rotor").join(named)];
    let found = places.iter().find(|place| place.is_file());
    let found =
        found.ok_or_else(|| format!("its rotor {named} is neither beside it nor in ../rotor"))?;
    let text = std::fs::read_to_string(found).map_err(|error| format!("{named}: {error}"))?;
    let file: Value = serde_json::from_str(&text).map_err(|error| format!("{named}: {error}"))?;
    free(&file["model"]).map_err(|error| format!("{named}: {error}"))
}

fn free(model: &Value) -> Result<Rotor, String> {
    let model: Model = part(model)?;
    let nodes = model.node_positions_m.len();
    let last = |highest: Option<usize>| highest.is_none_or(|node| node < nodes);
    let fits = last(model.shaft_elements.iter().map(|e| e.n_l + 1).max())
        && last(model.disks.iter().map(|disk| disk.n).max());
    if !fits {
        return Err("a part at a node that is not there".into());
    }
    let elements = model.shaft_elements.iter().map(|e| {
        let mut material = Material::new(e.young, e.nu.unwrap_or(0.3), e.rho);
        if let Some(shear) = e.shear {
            material.shear = shear;
        }
        Element {
            left: e.n_l,
            length: e.length,
            start: Annulus {
                outer: e.odl,
                inner: e.idl,
            },
            end: Annulus {
                outer: e.odr,
                inner: e.idr,
            },
            material,
            carries: true,
            damping_of_mass: e.alpha,
            damping_of_stiffness: e.beta,
            damping_rotating: e.beta_internal,
        }
    });
    let disks = model.disks.iter().map(|disk| Disk {
        node: disk.n,
        mass: disk.m,
        polar: disk.polar,
        diametral: disk.diametral,
    });
    // masses behind the nodes of the shaft are housings, which a free rotor does not have
    let masses = model.point_masses.iter().filter(|mass| mass.n < nodes);
    Ok(Rotor {
        elements: elements.collect(),
        disks: disks.collect(),
        masses: masses
            .map(|mass| PointMass {
                node: mass.n,
                mass: mass.m,
            })
            .collect(),
        nodes: model.node_positions_m,
        ..Rotor::default()
    })
}
