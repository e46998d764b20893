//! Rotors saved by ROSS 2 or 3: a table of parameters and one of each element, named by its class and tag, in SI.
//!
//! Versions 2.1 and later write `ross_version`; version 2.0 does not, and is known by its bearings with axial coefficients,
//! which versions 1 did not write. A key that TOML cannot hold as nothing is left out, in JSON it is null.

use crate::draft::{Draft, DraftSupport, cleaned};
use rotor::{Annulus, Block, Coefficients, Disk, Element, Material, Place, PointMass};
use serde_json::{Map, Value};

/// Keys of elements that say nothing of motion across the shaft.
const OF_LOOKS: [&str; 4] = ["tag", "color", "scale_factor", "shear_method_calc"];

/// Keys of the speeds of a table of coefficients, rad/s; ROSS 2 has the last, ROSS 3 the first, the last or both.
const SPEEDS: [&str; 4] = ["speed", "speed_rad_s", "speeds_rad_s", "frequency"];

/// Keys of the damping of the whole rotor, of ROSS 3.
const DAMPING: [&str; 4] = [
    "alpha",
    "beta",
    "modal_damping_ratio",
    "default_damping_ratio",
];

/// The draft of a saved rotor.
pub(super) fn draft(value: &Value) -> Result<Draft, String> {
    let Some(all) = value.as_object() else {
        return Err("no table of elements".to_string());
    };
    let version = version(all)?;
    let mut draft = Draft {
        kind: format!("rotor of ROSS {version}"),
        title: format!("Rotor of ROSS {version}"),
        ..Draft::default()
    };
    let classes = |wanted: &[&str]| -> Vec<(&str, &str, &Map<String, Value>)> {
        let elements = all.iter().filter_map(|(name, value)| {
            let (class, tag) = name.split_once('_')?;
            Some((class, tag, value.as_object()?))
        });
        elements
            .filter(|(class, ..)| wanted.contains(class))
            .collect()
    };
    speed(&mut draft, value.get("parameters"));
    for key in DAMPING {
        let damping = value.get("parameters").and_then(|all| all.get(key));
        if damping.is_some_and(|damping| values(damping).iter().any(|value| *value != 0.0)) {
            draft.notes.push(format!(
                "parameters: {key} (damping of the whole rotor) is left out"
            ));
        }
    }
    let mut shaft = classes(&["ShaftElement", "ShaftTaperedElement"]);
    shaft.sort_by(|a, b| {
        number(a.2, "n")
            .unwrap_or(0.0)
            .total_cmp(&number(b.2, "n").unwrap_or(0.0))
    });
    if shaft.is_empty() {
        return Err("a ROSS file without shaft elements".to_string());
    }
    lay_out(&mut draft, &shaft)?;
    for (_, tag, element) in classes(&["DiskElement"]) {
        let disk = Disk {
            node: node(&draft, element, tag)?,
            mass: needed(element, "m", tag)?,
            polar: needed(element, "Ip", tag)?,
            diametral: needed(element, "Id", tag)?,
        };
        draft.disks.push((tag.to_string(), disk));
    }
    let points = classes(&["PointMass"]);
    let count = draft.nodes.len();
    // nodes beyond the shaft are housings, in their order
    let mut housings: Vec<usize> = (points.iter())
        .filter_map(|(_, _, element)| number(element, "n").map(|n| n as usize))
        .filter(|n| *n >= count)
        .collect();
    housings.sort_unstable();
    housings.dedup();
    draft.housings = vec![0.0; housings.len()];
    for (_, tag, element) in points {
        let (x, y) = (number(element, "mx"), number(element, "my"));
        let mass = number(element, "m")
            .or(x)
            .ok_or(format!("no mass of {tag}"))?;
        if x.is_some_and(|x| x != mass) || y.is_some_and(|y| y != mass) {
            draft.notes.push(format!(
                "{tag}: different masses in x and y; {mass} kg is taken in both"
            ));
        }
        let at = needed(element, "n", tag)? as usize;
        match housings.iter().position(|n| *n == at) {
            Some(housing) => draft.housings[housing] += mass,
            None => draft
                .masses
                .push((tag.to_string(), PointMass { node: at, mass })),
        }
    }
    let known = [
        "ShaftElement",
        "ShaftTaperedElement",
        "DiskElement",
        "PointMass",
    ];
    for (name, value) in all {
        let Some((class, tag)) = name.split_once('_').filter(|(class, _)| !class.is_empty()) else {
            continue;
        };
        let Some(element) = value.as_object().filter(|_| !known.contains(&class)) else {
            continue;
        };
        if name == "ross_version" {
            continue;
        }
        if !element.contains_key("kxx") {
            draft
                .notes
                .push(format!("{class} {tag}: not understood, left out"));
            continue;
        }
        let support = support(&mut draft, class, tag, element, &housings)?;
        draft.supports.push((tag.to_string(), support));
    }
    Ok(draft)
}

/// The version, where it is one that is understood.
fn version(all: &Map<String, Value>) -> Result<String, String> {
    match all.get("ross_version").map(Value::as_str) {
        Some(Some(version)) if ["2.", "3."].iter().any(|own| version.starts_with(own)) => {
            Ok(version.to_string())
        }
        Some(Some(version)) => Err(format!("ROSS version {version}, which is not known here")),
        Some(None) => Err("a ross_version that is no text".to_string()),
        None => {
            let axial = |value: &Value| value.get("kxx").is_some() && value.get("kzz").is_some();
            match all.values().any(axial) {
                true => Ok("2.0".to_string()),
                false => {
                    Err("a ROSS file without ross_version, so of an unknown version".to_string())
                }
            }
        }
    }
}

fn speed(draft: &mut Draft, parameters: Option<&Value>) {
    let given = |key: &str| parameters.and_then(|all| all.get(key)?.as_f64());
    draft.speed = given("rated_w").or(given("max_w")).unwrap_or(0.0);
    if draft.speed == 0.0 {
        draft.speed = 100.0;
        draft.notes.push(
            "no rated speed: rotor.speed = 100 rad/s is a place-holder to be replaced".to_string(),
        );
    }
}

/// Nodes and pieces of the shaft.
fn lay_out(draft: &mut Draft, shaft: &[(&str, &str, &Map<String, Value>)]) -> Result<(), String> {
    let mut next = 0;
    for (index, (_, tag, element)) in shaft.iter().enumerate() {
        let n = number(element, "n").map_or(index, |n| n as usize);
        let length = needed(element, "L", tag)?;
        if n > next || n + 1 < next {
            return Err(format!(
                "shaft elements that do not follow each other at {tag}"
            ));
        }
        if draft.nodes.is_empty() {
            draft.nodes.push(0.0);
        }
        if n == next {
            let end = cleaned(draft.nodes[n] + length);
            draft.nodes.push(end);
            next += 1;
        }
        let (idl, odl) = (needed(element, "idl", tag)?, needed(element, "odl", tag)?);
        let material = element.get("material").and_then(Value::as_object);
        let material = material.ok_or(format!("no material of {tag}"))?;
        let name = material
            .get("name")
            .and_then(Value::as_str)
            .unwrap_or("material");
        let numbers = Material {
            young: needed(material, "E", tag)?,
            shear: needed(material, "G_s", tag)?,
            density: needed(material, "rho", tag)?,
        };
        let own = draft.material(name, numbers);
        draft.pieces.push((
            own,
            Element {
                left: n,
                length,
                start: Annulus {
                    outer: odl,
                    inner: idl,
                },
                end: Annulus {
                    outer: number(element, "odr").unwrap_or(odl),
                    inner: number(element, "idr").unwrap_or(idl),
                },
                material: numbers,
                carries: true,
                damping_of_mass: number(element, "alpha").unwrap_or_default(),
                damping_of_stiffness: number(element, "beta").unwrap_or_default(),
                damping_rotating: 0.0,
            },
        ));
        let notes = not_modelled(element, &format!("ShaftElement {tag}"));
        draft.notes.extend(notes);
    }
    Ok(())
}

/// What an element of shaft says that is not modelled.
pub fn not_modelled(element: &Map<String, Value>, what: &str) -> Vec<String> {
    let mut notes = Vec::new();
    for (key, word) in [("axial_force", "axial force"), ("torque", "axial torque")] {
        if number(element, key).is_some_and(|value| value != 0.0) {
            notes.push(format!(
                "{what}: {key} ({word}) is left out, which is not modelled"
            ));
        }
    }
    let shear = ["shear_method_calc", "shear_method"];
    let shear = shear.iter().find_map(|key| element.get(*key)?.as_str());
    if let Some(other) = shear.filter(|word| *word != "cowper") {
        notes.push(format!(
            "{what}: shear coefficient of {other}; here it is Cowper's, and frequencies of short pieces differ"
        ));
    }
    for key in ["shear_effects", "rotary_inertia", "gyroscopic"] {
        if element.get(key).and_then(Value::as_bool) == Some(false) {
            notes.push(format!(
                "{what}: {key} = false; here it is always taken into account"
            ));
        }
    }
    notes
}

fn support(
    draft: &mut Draft,
    class: &str,
    tag: &str,
    element: &Map<String, Value>,
    housings: &[usize],
) -> Result<DraftSupport, String> {
    let count = draft.nodes.len();
    let place = |n: usize| match housings.iter().position(|own| *own == n) {
        Some(housing) => Ok(Place::Housing(housing)),
        None if n < count => Ok(Place::Node(n)),
        None => Err(format!(
            "{class} {tag} at node {n}, which has neither shaft nor mass"
        )),
    };
    let at = place(needed(element, "n", tag)? as usize)?;
    let on = match number(element, "n_link")
        .map(|n| place(n as usize))
        .transpose()?
    {
        None => None,
        Some(Place::Housing(housing)) => Some(housing),
        Some(Place::Node(_)) => {
            return Err(format!("{class} {tag} between two nodes of the shaft"));
        }
    };
    let table = coefficients(element, &format!("{class} {tag}"))?;
    if table.len() > 1 {
        let ross = match draft.kind.contains("ROSS 2") {
            true => "a spline in ROSS 2",
            false => "PCHIP, and the slope of its ends, in ROSS 3",
        };
        let over = match axes(element) {
            (_, whirl) if whirl.is_empty() => "",
            (speeds, _) if speeds.is_empty() => " over frequency is taken as one over speed, and",
            _ => " over speed and frequency is taken where both are the same, and",
        };
        draft.notes.push(format!(
            "{class} {tag}: its table{over} is linear between its rows and constant beyond them ({ross})"
        ));
    }
    for key in ["kzz", "czz", "mzz"] {
        let list = element.get(key).map(values).unwrap_or_default();
        if list.iter().any(|value| *value != 0.0) {
            draft.notes.push(format!(
                "{class} {tag}: {key} is left out, there is no axial motion"
            ));
        }
    }
    let seal = class.contains("Seal");
    if !["BearingElement", "SealElement"].contains(&class) {
        let others: Vec<&str> = element
            .keys()
            .map(String::as_str)
            .filter(|key| !OF_LOOKS.contains(key))
            .collect();
        let what = if seal { "seal" } else { "support" };
        draft.notes.push(format!(
            "{class} {tag}: taken as a linear {what} by its saved coefficients, of {} keys",
            others.len()
        ));
    }
    Ok(DraftSupport {
        at,
        on,
        rows: table,
        seal,
    })
}

/// Speeds and frequencies of a table of coefficients, rad/s.
fn axes(element: &Map<String, Value>) -> (Vec<f64>, Vec<f64>) {
    let (whirl, speeds) = SPEEDS.split_last().expect("four keys");
    let of = |key: &&str| {
        element
            .get(*key)
            .map(values)
            .filter(|list| !list.is_empty())
    };
    let speeds = speeds.iter().find_map(of).unwrap_or_default();
    (speeds, of(whirl).unwrap_or_default())
}

/// Coefficients of a bearing over speed, rad/s; one row where they are the same at every speed.
///
/// Of a table over speed and frequency they are those of whirl at the speed.
pub(super) fn coefficients(
    element: &Map<String, Value>,
    what: &str,
) -> Result<Vec<(f64, Block)>, String> {
    let (mut speeds, mut whirl) = axes(element);
    if speeds.is_empty() {
        speeds = std::mem::take(&mut whirl);
    }
    let (rows, columns) = (speeds.len().max(1), whirl.len().max(1));
    let list = |key: String| {
        let list = element.get(&key).map(values).unwrap_or_default();
        match list.len() {
            0 | 1 => Ok(list),
            count if count == rows * columns => Ok(list),
            count => Err(format!(
                "{what}: {count} values of {key} at {} speeds ({})",
                rows * columns,
                SPEEDS.join(", ")
            )),
        }
    };
    let ends = ["xx", "xy", "yx", "yy"];
    let keys = ['k', 'c', 'm'].map(|letter| ends.map(|end| format!("{letter}{end}")));
    let lists = keys.into_iter().flatten().map(list);
    let lists: Vec<Vec<f64>> = lists.collect::<Result<_, _>>()?;
    let block = |index: usize| {
        let of = |at: usize| match lists[at].as_slice() {
            [] => 0.0,
            [one] => *one,
            list => list[index],
        };
        let matrix = |at: usize| [[of(at), of(at + 1)], [of(at + 2), of(at + 3)]];
        Block {
            stiffness: matrix(0),
            damping: matrix(4),
            mass: matrix(8),
        }
    };
    let table = (0..rows).map(|row| {
        let speed = speeds.get(row).copied().unwrap_or_default();
        let over_whirl = (0..columns).map(|column| {
            let at = whirl.get(column).copied().unwrap_or_default();
            (at, block(row * columns + column))
        });
        Some((speed, Coefficients::table(over_whirl.collect())?.at(speed)))
    });
    let table: Option<Vec<(f64, Block)>> = table.collect();
    let rising = |table: &Vec<(f64, Block)>| table.windows(2).all(|pair| pair[0].0 < pair[1].0);
    let table = table.filter(rising);
    table.ok_or(format!("{what}: speeds or frequencies that do not rise"))
}

/// The node of an element.
fn node(draft: &Draft, element: &Map<String, Value>, tag: &str) -> Result<usize, String> {
    let n = needed(element, "n", tag)? as usize;
    match n < draft.nodes.len() {
        true => Ok(n),
        false => Err(format!("{tag} at node {n}, which the shaft does not have")),
    }
}

/// One number or the only one of a list.
fn number(element: &Map<String, Value>, key: &str) -> Option<f64> {
    values(element.get(key)?).first().copied()
}

fn needed(element: &Map<String, Value>, key: &str, tag: &str) -> Result<f64, String> {
    let value = number(element, key).filter(|value| value.is_finite());
    value.ok_or(format!("no {key} of {tag}"))
}

/// The numbers of a list, or one; numbers in texts as well.
fn values(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(values).collect(),
        Value::String(text) => text.trim().parse().into_iter().collect(),
        other => other.as_f64().into_iter().collect(),
    }
}
