//! Reference files of rotors: a model element by element, with eigenvalues and what else was computed.

use crate::draft::{Draft, DraftSupport};
use crate::ross::{coefficients, not_modelled};
use rotor::{Annulus, C64, Disk, Element, Material, Place, PointMass};
use serde_json::Value;

/// The draft of a reference file.
pub fn draft(file: &Value) -> Result<Draft, String> {
    let model = &file["model"];
    let list = |key: &str| {
        let list = model[key].as_array();
        list.ok_or(format!("a model without {key}"))
    };
    let number = |value: &Value, key: &str| {
        let value = value[key].as_f64().filter(|value| value.is_finite());
        value.ok_or(format!("an entry without {key}"))
    };
    let name = file["case"].as_str().unwrap_or("rotor");
    let mut draft = Draft {
        kind: "reference file of a rotor".to_string(),
        title: file["description"].as_str().unwrap_or(name).to_string(),
        ..Draft::default()
    };
    let positions = list("node_positions_m")?.iter().map(Value::as_f64);
    let positions: Option<Vec<f64>> = positions.collect();
    draft.nodes = positions.ok_or("a node without position")?;
    let count = draft.nodes.len();
    let place = |n: usize| match n.checked_sub(count) {
        Some(housing) => Place::Housing(housing),
        None => Place::Node(n),
    };
    let shaft_node = |value: &Value, key: &str| match number(value, key)? as usize {
        n if n < count => Ok(n),
        n => Err(format!("node {n}, which the shaft does not have")),
    };
    for element in list("shaft_elements")? {
        let (young, density) = (number(element, "E")?, number(element, "rho")?);
        let material = match number(element, "G") {
            Ok(shear) => Material {
                young,
                shear,
                density,
            },
            Err(_) => Material::new(young, number(element, "nu")?, density),
        };
        let left = shaft_node(element, "n_l")?;
        for note in element
            .as_object()
            .into_iter()
            .flat_map(|own| not_modelled(own, "shaft"))
        {
            // once, of however many elements
            if !draft.notes.contains(&note) {
                draft.notes.push(note);
            }
        }
        let own = draft.material("shaft", material);
        draft.pieces.push((
            own,
            Element {
                left,
                length: number(element, "L")?,
                start: Annulus {
                    outer: number(element, "odl")?,
                    inner: number(element, "idl")?,
                },
                end: Annulus {
                    outer: number(element, "odr")?,
                    inner: number(element, "idr")?,
                },
                material,
                carries: true,
                damping_of_mass: number(element, "alpha")?,
                damping_of_stiffness: number(element, "beta")?,
                damping_rotating: number(element, "beta_internal").unwrap_or(0.0),
            },
        ));
    }
    for (index, disk) in list("disks")?.iter().enumerate() {
        let disk = Disk {
            node: shaft_node(disk, "n")?,
            mass: number(disk, "m")?,
            polar: number(disk, "Ip")?,
            diametral: number(disk, "Id")?,
        };
        draft.disks.push((format!("disk_{}", index + 1), disk));
    }
    for (index, mass) in list("point_masses")?.iter().enumerate() {
        let m = number(mass, "m")?;
        match place(number(mass, "n")? as usize) {
            Place::Node(node) => draft
                .masses
                .push((format!("mass_{}", index + 1), PointMass { node, mass: m })),
            Place::Housing(housing) => {
                draft
                    .housings
                    .resize(draft.housings.len().max(housing + 1), 0.0);
                draft.housings[housing] += m;
            }
        }
    }
    if draft.housings.contains(&0.0) {
        return Err("a housing without mass".to_string());
    }
    let bearings = model["bearings"].as_array().into_iter().flatten();
    for (index, bearing) in bearings.enumerate() {
        let own = bearing.as_object().ok_or("a bearing is no table")?;
        let rows = coefficients(own, &format!("bearing {}", index + 1))?;
        let on = bearing["n_link"].as_u64().map(|n| place(n as usize));
        let on = match on {
            Some(Place::Node(_)) => {
                return Err("a bearing between two nodes of the shaft".to_string());
            }
            Some(Place::Housing(housing)) => Some(housing),
            None => None,
        };
        let at = place(number(bearing, "n")? as usize);
        if [Some(at), on.map(Place::Housing)]
            .iter()
            .flatten()
            .any(|p| matches!(p, Place::Housing(h) if *h >= draft.housings.len()))
        {
            return Err("a bearing at a node that is not there".to_string());
        }
        let support = DraftSupport {
            at,
            on,
            rows,
            seal: false,
        };
        draft
            .supports
            .push((format!("bearing_{}", index + 1), support));
    }
    for entry in file["eigenvalues"].as_array().into_iter().flatten() {
        let modes = entry["modes"].as_array().into_iter().flatten();
        let lateral = modes.filter(|mode| mode["kind"] == "lateral");
        let Ok(speed) = number(entry, "speed_rad_s") else {
            draft.nulls.push("eigenvalues at no speed".to_string());
            continue;
        };
        let mut values = Vec::new();
        for mode in lateral {
            match (number(mode, "re"), number(mode, "im")) {
                (Ok(re), Ok(im)) => values.push(C64::new(re, im)),
                _ => (draft.nulls).push(format!("a mode at {speed} rad/s without re or im")),
            }
        }
        draft.stated.push((speed, values));
    }
    draft.speed = draft
        .stated
        .iter()
        .map(|(speed, _)| *speed)
        .fold(0.0, f64::max);
    if draft.speed == 0.0 {
        draft.speed = 100.0;
    }
    Ok(draft)
}
