//! From parts with names to the rotor of the kernel.

use crate::key::quoted;
use crate::rotor::grade;
use crate::rotor::levitation::{self, LevitationModel};
use crate::rotor::part_keys::STAYS;
use crate::rotor::parts::Part;
use crate::values::Values;
use physics::shaft::MATERIALS;
use problem::{Code, Problem, did_you_mean};
use rotor::{
    Annulus, Block, Coefficients, Disk, Housing, Layer, Material, Mesh, MeshError, Place,
    PointMass, Support, Unbalance,
};
use units::number_text;

/// A rotor with the names of its parts.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorModel {
    /// The rotor as the kernel has it.
    pub rotor: rotor::Rotor,
    /// Its pieces, as they are drawn.
    pub pieces: Vec<DrawnPiece>,
    /// Names of disks, in the order of the rotor.
    pub disks: Vec<String>,
    /// Diameter and width of each disk, m, where the file gives them.
    pub disk_sizes: Vec<(Option<f64>, Option<f64>)>,
    /// Names of supports and seals, in the order of the rotor: mounts of housings last.
    pub supports: Vec<String>,
    /// Whether each of them acts on after the release of a machine's rotor; mounts of housings last.
    pub stays: Vec<bool>,
    /// Names of unbalances.
    pub unbalance: Vec<String>,
    /// Named nodes with their index.
    pub nodes: Vec<(String, usize)>,
    /// Radial clearance of what stands around each of them, m.
    pub clearances: Vec<Option<f64>>,
    /// Magnets, sensors and controllers.
    pub levitation: Option<LevitationModel>,
}

/// A piece of shaft or sleeve as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPiece {
    /// Its name, else its number.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// Dimensions.
    pub layer: Layer,
}

type Built<T> = Result<T, Box<Problem>>;

/// Parts that sit at a place of the shaft, each of which is a node.
const ATTACHED: [&str; 7] = [
    "disk",
    "mass",
    "support",
    "seal",
    "unbalance",
    "magnet",
    "sensor",
];

/// The rotor of all parts.
pub fn model(parts: &[Part], values: &Values) -> Built<RotorModel> {
    let of =
        |word: &str| -> Vec<&Part> { parts.iter().filter(|part| part.kind.word == word).collect() };
    let pieces = pieces(&of, values)?;
    let layers: Vec<Layer> = pieces.iter().map(|(_, piece)| piece.layer).collect();
    let places = Places {
        names: (of("node").iter())
            .map(|part| {
                (
                    part.text("name").unwrap_or_default().to_string(),
                    part.needed("at"),
                )
            })
            .collect(),
    };
    let mut positions: Vec<f64> = places.names.iter().map(|(_, at)| *at).collect();
    let attached: Vec<&Part> = ATTACHED.iter().flat_map(|word| of(word)).collect();
    for part in &attached {
        positions.push(places.position(part)?);
    }
    let mesh = mesh(
        &layers,
        &positions,
        &pieces,
        &of("node"),
        &attached,
        &places,
        values,
    )?;
    let node = |part: &Part| -> Built<usize> {
        let position = places.position(part)?;
        Ok(mesh.node(position).unwrap_or_default())
    };
    let named = |list: &[&Part]| list.iter().map(|part| part.label.clone()).collect();
    let housings = of("housing");
    let mut rotor = rotor::Rotor {
        nodes: mesh.nodes.clone(),
        elements: mesh.elements.clone(),
        ..rotor::Rotor::default()
    };
    for part in of("disk") {
        rotor.disks.push(disk(part, node(part)?, &of("material"))?);
    }
    for part in of("mass") {
        rotor.masses.push(PointMass {
            node: node(part)?,
            mass: part.needed("mass"),
        });
    }
    let (supports, seals) = (of("support"), of("seal"));
    for part in supports.iter().chain(&seals) {
        rotor.supports.push(Support {
            at: Place::Node(node(part)?),
            on: on(part, &housings)?,
            coefficients: coefficients(part)?,
            seal: part.kind.word == "seal",
        });
    }
    for (index, part) in housings.iter().enumerate() {
        rotor.housings.push(Housing {
            mass: part.needed("mass"),
        });
        rotor.supports.push(Support {
            at: Place::Housing(index),
            on: None,
            coefficients: coefficients(part)?,
            seal: false,
        });
    }
    for part in of("unbalance") {
        rotor.unbalance.push(Unbalance {
            node: node(part)?,
            amount: part.needed("amount"),
            phase: part.needed("phase"),
        });
    }
    grade::scale(&mut rotor, values)?;
    let nodes = places.names.iter();
    let nodes = nodes.filter_map(|(name, at)| Some((name.clone(), mesh.node(*at)?)));
    let disk_sizes = of("disk");
    let disk_sizes = disk_sizes.iter();
    let levitation = levitation::model(&of, &node, rotor.nodes.len())?;
    Ok(RotorModel {
        levitation,
        disks: named(&of("disk")),
        disk_sizes: disk_sizes
            .map(|part| (part.number("outer_diameter"), part.number("width")))
            .collect(),
        stays: ([supports.as_slice(), &seals, &housings].concat().iter())
            .map(|part| part.kind.word != "support" || part.word("after_release") == Some(STAYS))
            .collect(),
        supports: named(&[supports, seals, housings].concat()),
        unbalance: named(&of("unbalance")),
        nodes: nodes.collect(),
        clearances: (of("node").iter())
            .map(|part| part.number("clearance"))
            .collect(),
        pieces: pieces.into_iter().map(|(_, piece)| piece).collect(),
        rotor,
    })
}

/// The mean direct stiffness of the supports of the shaft at a speed, N/m; 1 MN/m without supports.
pub fn typical_stiffness(model: &RotorModel, speed: f64) -> f64 {
    let stiffness = |support: &Support| {
        let k = support.coefficients.at(speed).stiffness;
        0.5 * (k[0][0] + k[1][1])
    };
    // a controller makes of a magnet a spring of about the size of its negative stiffness
    let magnets = model
        .levitation
        .iter()
        .flat_map(|own| own.levitation.actuators());
    let all: Vec<f64> = (model.rotor.bearings())
        .filter(|support| matches!(support.at, Place::Node(_)))
        .map(stiffness)
        .chain(magnets.map(|actuator| actuator.magnet.position_stiffness()))
        .filter(|k| *k > 0.0)
        .collect();
    match all.len() {
        0 => 1e6,
        count => all.iter().sum::<f64>() / count as f64,
    }
}

/// Sections and sleeves as layers, each with its part.
fn pieces<'a>(
    of: &dyn Fn(&str) -> Vec<&'a Part>,
    values: &Values,
) -> Built<Vec<(&'a Part, DrawnPiece)>> {
    let materials = of("material");
    let default = |name: &str| values.number(&format!("rotor.{name}")).unwrap_or_default();
    let sections = of("section");
    if sections.is_empty() {
        return Err(Box::new(values.problem(
            Code::MissingKey,
            "rotor.section",
            problem::Place::Whole,
            "a rotor without a section",
            "tables [[rotor.section]] with length, outer_diameter and material are needed",
        )));
    }
    let mut out: Vec<(&Part, DrawnPiece)> = Vec::new();
    let mut end = 0.0;
    for part in sections.iter().chain(&of("sleeve")) {
        let carries = part.kind.word == "section";
        let start = Annulus {
            outer: part.needed("outer_diameter"),
            inner: part.needed("inner_diameter"),
        };
        let last = Annulus {
            outer: part.number("outer_diameter_end").unwrap_or(start.outer),
            inner: part.number("inner_diameter_end").unwrap_or(start.inner),
        };
        for (section, name) in [(start, "inner_diameter"), (last, "inner_diameter_end")] {
            if section.inner >= section.outer {
                let found = format!("{} m inside {} m", section.inner, section.outer);
                let allowed = "an inner diameter below the outer one is needed";
                return Err(Box::new(part.problem(
                    Code::RotorGeometry,
                    name,
                    found,
                    allowed,
                )));
            }
        }
        let from = part.number("from").unwrap_or(end);
        let length = part.needed("length");
        end = from + length;
        if !(from.abs() <= FARTHEST && (SHORTEST..=FARTHEST).contains(&length)) {
            let found = format!("{} m from {} m on", number_text(length), number_text(from));
            let allowed = "a length from 1 um to 1 km, within 1 km of the origin, is needed";
            return Err(Box::new(part.problem(
                Code::RotorGeometry,
                "length",
                found,
                allowed,
            )));
        }
        let damping = |name: &str| match carries {
            true => part.number(name).unwrap_or_else(|| default(name)),
            false => 0.0,
        };
        let elements = part.number("elements");
        let layer = Layer {
            from,
            to: end,
            start,
            end: last,
            material: material(part, &materials)?,
            longest: elements.map_or(f64::INFINITY, |count| length / count),
            carries,
            damping_of_mass: damping("damping_of_mass"),
            damping_of_stiffness: damping("damping_of_stiffness"),
            damping_rotating: damping("damping_rotating"),
        };
        let material = part.text("material").unwrap_or_default().to_string();
        let name = part.label.clone();
        let piece = DrawnPiece {
            name,
            material,
            layer,
        };
        out.push((part, piece));
    }
    let layers = out.iter().map(|(_, piece)| &piece.layer);
    let longest = divided(layers, values);
    for (part, piece) in &mut out {
        if piece.layer.carries && part.number("elements").is_none() {
            piece.layer.longest = longest;
        }
    }
    Ok(out)
}

/// Longest element of a section that says nothing of elements, m.
pub fn longest_element(model: &RotorModel, values: &Values) -> f64 {
    divided(model.pieces.iter().map(|piece| &piece.layer), values)
}

fn divided<'a>(layers: impl Iterator<Item = &'a Layer>, values: &Values) -> f64 {
    let (mut near, mut far) = (f64::INFINITY, f64::NEG_INFINITY);
    for layer in layers {
        (near, far) = (near.min(layer.from), far.max(layer.to));
    }
    let given = values.number("rotor.longest_element");
    given.unwrap_or((far - near) / ELEMENTS)
}

/// Elements of a whole shaft that does not say how long they are.
const ELEMENTS: f64 = 40.0;

/// Young's modulus below which a material carries no load of a rotor, Pa: shrunk-on masses are often given so.
const NO_STIFFNESS: f64 = 1e6;

/// A material by name: the file's own, or one that is known and stands beside these.
fn material(part: &Part, own: &[&Part]) -> Built<Material> {
    let name = part.text("material").unwrap_or_default();
    if let Some(given) = own.iter().find(|other| other.text("name") == Some(name)) {
        let young = given.needed("youngs_modulus");
        let poisson = given.number("poisson_ratio").unwrap_or(0.3);
        let mut material = Material::new(young, poisson, given.needed("density"));
        if let Some(shear) = given.number("shear_modulus") {
            material.shear = shear;
            let poisson = material.poisson();
            // a layer that only adds mass has a stiffness that means nothing
            let least = if young < NO_STIFFNESS { -1.0 } else { 0.0 };
            if !(least..0.5).contains(&poisson) || poisson == -1.0 {
                let found = format!("a shear modulus that means a Poisson's ratio of {poisson:.3}");
                let allowed = "one from E/3 to E/2 is needed";
                return Err(Box::new(given.problem(
                    Code::OutOfRange,
                    "shear_modulus",
                    found,
                    allowed,
                )));
            }
        }
        return Ok(material);
    }
    let known = |name: &str| MATERIALS.iter().any(|known| known.0 == name);
    let names: Vec<&str> = (own.iter().filter_map(|part| part.text("name")))
        .filter(|name| !known(name))
        .chain(MATERIALS.iter().map(|m| m.0))
        .collect();
    let hint = did_you_mean(name, names.iter().copied());
    let allowed = format!(
        "one of {} is needed, or a [[rotor.material]] of this name",
        names.join(", ")
    );
    let problem = part.problem(Code::UnknownMaterial, "material", quoted(name), allowed);
    Err(Box::new(problem.with_hint(hint)))
}

/// Named positions along the shaft.
struct Places {
    names: Vec<(String, f64)>,
}

impl Places {
    /// Where a part sits, m.
    fn position(&self, part: &Part) -> Built<f64> {
        let text = part.text("at").unwrap_or_default().trim();
        if let Some((_, at)) = self.names.iter().find(|(name, _)| name == text) {
            return Ok(*at);
        }
        let length = units::parse_quantity(text).ok();
        let length = length.filter(|q| q.dimension == units::Dimension::LENGTH);
        if let Some(quantity) = length {
            return Ok(quantity.value_si);
        }
        let names = || self.names.iter().map(|(name, _)| name.as_str());
        let known: Vec<&str> = names().collect();
        let allowed = match known.as_slice() {
            [] => "a position such as \"0.25 m\", or the name of a [[rotor.node]], is needed; the file has no node".to_string(),
            all => format!("a position such as \"0.25 m\", or one of the nodes {}, is needed", all.join(", ")),
        };
        let problem = part.problem(Code::NoSuchNode, "at", quoted(text), allowed);
        Err(Box::new(problem.with_hint(did_you_mean(text, names()))))
    }
}

/// Shortest piece and farthest end of a shaft, m: beyond them there is no rotor, and numbers leave double precision.
const SHORTEST: f64 = 1e-6;
const FARTHEST: f64 = 1e3;

/// Most elements of a shaft: dense matrices of twice as many coordinates take seconds then.
const MOST_ELEMENTS: f64 = 500.0;

/// The mesh, or what is wrong with the pieces.
fn mesh(
    layers: &[Layer],
    positions: &[f64],
    pieces: &[(&Part, DrawnPiece)],
    nodes: &[&Part],
    attached: &[&Part],
    places: &Places,
    values: &Values,
) -> Built<Mesh> {
    let pieces_of = |layer: &Layer| ((layer.to - layer.from) / layer.longest).ceil().max(1.0);
    let elements: f64 = layers.iter().map(pieces_of).sum();
    if elements > MOST_ELEMENTS {
        let found = format!("{elements} elements");
        let allowed = format!(
            "at most {MOST_ELEMENTS} are needed; rotor.longest_element and elements give their number"
        );
        let path = "rotor.longest_element";
        let place = values.place(path);
        return Err(Box::new(values.problem(
            Code::RotorGeometry,
            path,
            place,
            found,
            allowed,
        )));
    }
    rotor::mesh(layers, positions).map_err(|error| {
        let metres = |z: f64| number_text((z * 1e9).round() / 1e9);
        match error {
            MeshError::Conflict(first, second, at) => {
                let (one, other) = (pieces[first].0, pieces[second].0);
                let found = format!(
                    "material where {} {} has its own, at {} m",
                    one.kind.word,
                    one.label,
                    metres(at)
                );
                let allowed = "pieces that follow each other, or one outside the other (inner_diameter at least the outer_diameter below it), are needed";
                Box::new(other.problem(Code::RotorGeometry, "", found, allowed))
            }
            MeshError::Outside(z) => {
                let all = nodes.iter().chain(attached);
                let at = |part: &&&Part| {
                    let own = part.number("at").or_else(|| places.position(part).ok());
                    own == Some(z)
                };
                let (first, last) = (
                    layers.iter().map(|l| l.from).fold(f64::INFINITY, f64::min),
                    layers.iter().map(|l| l.to).fold(f64::NEG_INFINITY, f64::max),
                );
                let found = format!("{} m, which is beside the shaft", metres(z));
                let allowed = format!("a position from {} m to {} m is needed", metres(first), metres(last));
                let mut all = all;
                Box::new(match all.find(at) {
                    Some(part) => part.problem(Code::NoSuchNode, "at", found, allowed),
                    None => values.problem(Code::NoSuchNode, "rotor.node", problem::Place::Whole, found, allowed),
                })
            }
            MeshError::Gap(from, to) => Box::new(values.problem(
                Code::RotorGeometry,
                "rotor.section",
                pieces[0].0.place,
                format!("no section from {} m to {} m", metres(from), metres(to)),
                "sections without a gap are needed",
            )),
            MeshError::Empty => Box::new(values.problem(
                Code::MissingKey,
                "rotor.section",
                problem::Place::Whole,
                "a rotor without a section",
                "tables [[rotor.section]] are needed",
            )),
        }
    })
}

/// What the rounding of given inertias may add to the ratio of a thin disk.
const ROUNDED: f64 = 0.01;

fn disk(part: &Part, node: usize, materials: &[&Part]) -> Built<Disk> {
    const INERTIA: [&str; 3] = ["mass", "polar_inertia", "diametral_inertia"];
    const DIMENSIONS: [&str; 3] = ["width", "outer_diameter", "material"];
    let given = |name: &&str| part.known.contains_key(*name);
    if INERTIA.iter().all(&given) {
        let [mass, polar, diametral] = INERTIA.map(|name| part.needed(name));
        if polar > 2.0 * diametral * (1.0 + ROUNDED) {
            let found = format!("{polar} kg m^2 about the axis, {diametral} kg m^2 across it");
            let allowed = "no body has more than twice as much about its axis as across it";
            return Err(Box::new(part.problem(
                Code::RotorGeometry,
                "polar_inertia",
                found,
                allowed,
            )));
        }
        return Ok(Disk {
            node,
            mass,
            polar,
            diametral,
        });
    }
    if INERTIA.iter().any(&given) || !DIMENSIONS.iter().all(&given) {
        let lacking: Vec<&str> = match INERTIA.iter().any(&given) {
            true => INERTIA.into_iter().filter(|name| !given(name)).collect(),
            false => DIMENSIONS.into_iter().filter(|name| !given(name)).collect(),
        };
        let found = format!("a disk without {}", lacking.join(", "));
        let allowed = "mass, polar_inertia and diametral_inertia, or width, outer_diameter and material, are needed";
        return Err(Box::new(part.problem(Code::MissingKey, "", found, allowed)));
    }
    let (width, outer) = (part.needed("width"), part.needed("outer_diameter"));
    let inner = part.number("inner_diameter").unwrap_or_default();
    if inner >= outer {
        let found = format!("{inner} m inside {outer} m");
        let allowed = "an inner diameter below the outer one is needed";
        return Err(Box::new(part.problem(
            Code::RotorGeometry,
            "inner_diameter",
            found,
            allowed,
        )));
    }
    let section = Annulus { outer, inner };
    let density = material(part, materials)?.density;
    let mass = density * section.area() * width;
    Ok(Disk {
        node,
        mass,
        polar: 2.0 * density * section.second_moment() * width,
        diametral: density * section.second_moment() * width + mass * width * width / 12.0,
    })
}

fn on(part: &Part, housings: &[&Part]) -> Built<Option<usize>> {
    let Some(name) = part.text("on") else {
        return Ok(None);
    };
    let at = housings.iter().position(|housing| housing.label == name);
    at.map(Some).ok_or_else(|| {
        let names: Vec<&str> = housings.iter().map(|part| part.label.as_str()).collect();
        let allowed = match names.as_slice() {
            [] => "a [[rotor.housing]] of this name is needed; the file has none".to_string(),
            names => format!("one of the housings {} is needed", names.join(", ")),
        };
        let problem = part.problem(Code::NoSuchNode, "on", quoted(name), allowed);
        Box::new(problem.with_hint(did_you_mean(name, names.iter().copied())))
    })
}

/// Stiffness, damping and mass of a support, over its speeds.
fn coefficients(part: &Part) -> Built<Coefficients> {
    let speeds = part.series("speeds").unwrap_or(&[0.0]);
    let table = part.series("speeds").is_some();
    if !speeds.windows(2).all(|pair| pair[0] < pair[1]) || speeds.iter().any(|s| *s < 0.0) {
        let allowed = "speeds not below 0 that rise from entry to entry are needed";
        return Err(Box::new(part.problem(
            Code::TableOrder,
            "speeds",
            "speeds that do not rise",
            allowed,
        )));
    }
    let mut blocks = vec![Block::default(); speeds.len()];
    for (name, place) in [
        (
            "stiffness",
            (|block| &mut block.stiffness) as fn(&mut Block) -> &mut [[f64; 2]; 2],
        ),
        ("damping", |block| &mut block.damping),
        ("added_mass", |block| &mut block.mass),
    ] {
        let entries = [("", 0, 0), ("_yy", 1, 1), ("_xy", 0, 1), ("_yx", 1, 0)];
        for (end, row, column) in entries {
            let key = format!("{name}{end}");
            let Some(list) = part.series(&key) else {
                continue;
            };
            if list.len() != 1 && (!table || list.len() != speeds.len()) {
                let found = format!("{} values", list.len());
                let allowed = match table {
                    true => format!(
                        "one value, or one for each of the {} speeds, is needed",
                        speeds.len()
                    ),
                    false => "one value is needed, or speeds as well".to_string(),
                };
                return Err(Box::new(part.problem(
                    Code::WrongType,
                    &key,
                    found,
                    allowed,
                )));
            }
            if row == column && list.iter().any(|value| *value < 0.0) && name == "added_mass" {
                let allowed = "a mass not below 0 is needed";
                return Err(Box::new(part.problem(
                    Code::OutOfRange,
                    &key,
                    "a negative mass",
                    allowed,
                )));
            }
            for (at, block) in blocks.iter_mut().enumerate() {
                let value = *list.get(at).unwrap_or(&list[0]);
                let matrix = place(block);
                matrix[row][column] = value;
                // x stands for both directions until y is given
                if end.is_empty() {
                    matrix[1][1] = value;
                }
            }
        }
    }
    let rows = speeds.iter().copied().zip(blocks).collect();
    Ok(Coefficients::table(rows).unwrap_or(Coefficients::constant(Block::default())))
}
