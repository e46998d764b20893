//! From the tables of a file to the parts of a flexible rotor.

use crate::document::Document;
use crate::drop::RecordFile;
use crate::key::quoted;
use crate::rotor::keys::{FORCE, STAYS};
use crate::rotor::tables::{self, Part};
use crate::rotor::{
    BalancePlanes, Disk, FlexibleRotor, Force, ForceRecord, Node, Piece, PointMass, Support,
    Unbalance, levitation,
};
use crate::values::Values;
use physics::shaft::{Annulus, Layer, MATERIALS, Material, SAME_PLACE};
use physics::support::{Block, Coefficients};
use problem::{Code, Result, did_you_mean};
use units::number_text;

pub(super) type Checked<T> = Result<T>;

/// The parts of one kind, by its word.
pub(super) type OfKind<'a, 'b> = &'b dyn Fn(&str) -> Vec<&'a Part>;

impl FlexibleRotor {
    /// The rotor of a document.
    ///
    /// # Errors
    /// Parts that no rotor has.
    pub fn of_document(document: &Document, values: &Values) -> Checked<FlexibleRotor> {
        FlexibleRotor::of(&tables::resolve(document, values)?, values)
    }

    /// The rotor of all parts.
    pub(crate) fn of(parts: &[Part], values: &Values) -> Checked<FlexibleRotor> {
        let of = |word: &str| -> Vec<&Part> {
            parts.iter().filter(|part| part.kind.word == word).collect()
        };
        let pieces = pieces(&of, values)?;
        let layers = || pieces.iter().map(|piece| &piece.layer);
        let housings = of("housing");
        let nodes = of("node").into_iter().map(|part| {
            Ok(Node {
                name: part.label.clone(),
                at: part.needed("at"),
                clearance: part.number("clearance"),
                on: on(part, &housings)?,
            })
        });
        let nodes: Vec<Node> = nodes.collect::<Checked<_>>()?;
        let ends = ends(&pieces);
        let at = |part: &Part| on_shaft(part, position(part, &nodes)?, ends);
        for (part, node) in of("node").into_iter().zip(&nodes) {
            on_shaft(part, node.at, ends)?;
        }
        let few = |layer: &Layer| ((layer.to - layer.from) / layer.longest).ceil().max(1.0);
        let elements: f64 = layers().map(few).sum();
        if elements > MOST_ELEMENTS {
            let allowed = format!(
                "at most {MOST_ELEMENTS} are needed; rotor.longest_element and elements give their number"
            );
            let found = format!("{elements} elements");
            return values.refuse(Code::RotorGeometry, LONGEST_ELEMENT, found, allowed);
        }
        let held = |part: &&Part| {
            Ok(Support {
                name: part.label.clone(),
                at: match part.kind.word {
                    "housing" => None,
                    _ => Some(at(part)?),
                },
                on: on(part, &housings)?,
                coefficients: coefficients(part)?,
                seal: part.kind.word == "seal",
                stays: part.kind.word != "support" || part.word("after_release") == Some(STAYS),
            })
        };
        let disks = (of("disk").into_iter()).map(|part| disk(part, at(part)?, &of("material")));
        let masses = of("mass").into_iter().map(|part| {
            Ok(PointMass {
                at: at(part)?,
                mass: part.needed("mass"),
            })
        });
        let unbalance = of("unbalance").into_iter().map(|part| {
            Ok(Unbalance {
                name: part.label.clone(),
                at: at(part)?,
                amount: part.needed("amount"),
                phase: part.needed("phase"),
            })
        });
        let supports = [of("support"), of("seal"), housings.clone()].concat();
        let this = FlexibleRotor {
            disks: disks.collect::<Checked<_>>()?,
            masses: masses.collect::<Checked<_>>()?,
            supports: supports.iter().map(held).collect::<Checked<_>>()?,
            housings: housings.iter().map(|part| part.needed("mass")).collect(),
            unbalance: unbalance.collect::<Checked<_>>()?,
            forces: (of(FORCE).into_iter())
                .map(|part| force(part, at(part)?))
                .collect::<Checked<_>>()?,
            balance_grade: values.number(BALANCE_GRADE),
            balance_planes: balance_planes(values, &nodes)?,
            levitation: levitation::magnets(&of, &at)?,
            longest_element: longest_element(ends, values),
            nodes,
            pieces,
        };
        this.gradable(values)?;
        Ok(this)
    }

    /// Refuses a balance grade of a rotor without unbalance or speed.
    fn gradable(&self, values: &Values) -> Checked<()> {
        let speed = values.number("rotor.speed").unwrap_or_default();
        let given: f64 = self.unbalance.iter().map(|plane| plane.amount.abs()).sum();
        let planes = self.balance_planes.as_ref();
        let there = self.unbalance.iter().find(|own| {
            let near = |at: &f64| (at - own.at).abs() <= SAME_PLACE;
            planes.is_some_and(|planes| planes.at.iter().any(near))
        });
        let (path, found, needed) = match (self.balance_grade, planes) {
            (Some(_), None) if given == 0.0 => (
                BALANCE_GRADE,
                "no unbalance that it could scale".to_string(),
                "rotor.balance_planes, or [[rotor.unbalance]] with the planes and the shares of their amounts, is needed",
            ),
            (Some(_), _) if speed == 0.0 => (
                BALANCE_GRADE,
                "a rotor at rest".to_string(),
                "rotor.speed is needed: a grade is the product of eccentricity and speed",
            ),
            (None, Some(_)) => (
                BALANCE_PLANES,
                "planes without a grade".to_string(),
                "rotor.balance_grade is needed beside them",
            ),
            _ => match there {
                Some(own) => (
                    BALANCE_PLANES,
                    format!("a plane at which [[rotor.unbalance]] {} stands", own.name),
                    "either the grade or an amount is needed in a plane",
                ),
                None => return Ok(()),
            },
        };
        values.refuse(Code::Conflict, path, found, needed)
    }

    /// The mean direct stiffness of what holds the shaft at a speed, N/m; 1 MN/m where nothing does.
    pub(super) fn typical_stiffness(&self, speed: f64) -> f64 {
        let stiffness = |support: &Support| {
            let k = support.coefficients.at(speed).stiffness;
            0.5 * (k[0][0] + k[1][1])
        };
        let supports = self.supports.iter();
        // a controller makes of a magnet a spring of about the size of its negative stiffness
        let magnets = self.levitation.iter().flat_map(|own| &own.magnets);
        let axes = magnets.flat_map(|magnet| &magnet.axes);
        let all: Vec<f64> = supports
            .filter(|support| !support.seal && support.at.is_some())
            .map(stiffness)
            .chain(axes.map(|axis| axis.law.position_stiffness()))
            .filter(|k| *k > 0.0)
            .collect();
        match all.len() {
            0 => 1e6,
            count => all.iter().sum::<f64>() / count as f64,
        }
    }
}

const BALANCE_GRADE: &str = "rotor.balance_grade";
const BALANCE_PLANES: &str = "rotor.balance_planes";

/// The planes of a balance grade, where they are given.
fn balance_planes(values: &Values, nodes: &[Node]) -> Checked<Option<BalancePlanes>> {
    let given = values.texts(BALANCE_PLANES);
    if given.is_empty() {
        return Ok(None);
    }
    let of = |name: &String| nodes.iter().find(|node| node.name == *name);
    let known: Vec<&Node> = given.iter().filter_map(of).collect();
    if let ([one, other], 2) = (known.as_slice(), given.len())
        && (one.at - other.at).abs() > SAME_PLACE
    {
        return Ok(Some(BalancePlanes {
            names: [one, other].map(|node| node.name.clone()),
            at: [one.at, other.at],
            // a rotor alone has no key of a seed
            seed: values.count("repeat.seed").max(1),
        }));
    }
    let names: Vec<&str> = nodes.iter().map(|node| node.name.as_str()).collect();
    let allowed = format!(
        "two of the names of [[rotor.node]] at different places are needed: {}",
        names.join(", ")
    );
    values.refuse(
        Code::NoSuchNode,
        BALANCE_PLANES,
        quoted(&given.join(", ")),
        &allowed,
    )
}

const LONGEST_ELEMENT: &str = "rotor.longest_element";

/// Elements of a whole shaft that does not say how long they are.
const ELEMENTS: f64 = 40.0;

/// Most elements of a shaft: dense matrices of twice as many coordinates take seconds then.
const MOST_ELEMENTS: f64 = 500.0;

/// Left and right end of a shaft, m.
fn ends(pieces: &[Piece]) -> [f64; 2] {
    let layers = pieces.iter().map(|piece| &piece.layer);
    layers.fold([f64::INFINITY, f64::NEG_INFINITY], |[near, far], layer| {
        [near.min(layer.from), far.max(layer.to)]
    })
}

/// Longest element of a section that says nothing of elements, m.
fn longest_element([near, far]: [f64; 2], values: &Values) -> f64 {
    let given = values.number(LONGEST_ELEMENT);
    given.unwrap_or((far - near) / ELEMENTS)
}

/// Shortest piece and farthest end of a shaft, m: beyond them there is no rotor, and numbers leave double precision.
const SHORTEST: f64 = 1e-6;
const FARTHEST: f64 = 1e3;

/// Sections, then sleeves.
fn pieces(of: OfKind, values: &Values) -> Checked<Vec<Piece>> {
    let materials = of("material");
    let default = |name: &str| values.number(&format!("rotor.{name}")).unwrap_or_default();
    let sections = of("section");
    if sections.is_empty() {
        let allowed =
            "tables [[rotor.section]] with length, outer_diameter and material are needed";
        let found = "a rotor without a section";
        return values.refuse(Code::MissingKey, "rotor.section", found, allowed);
    }
    let mut out: Vec<Piece> = Vec::new();
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
        hollow(part, "inner_diameter", start)?;
        hollow(part, "inner_diameter_end", last)?;
        let from = part.number("from").unwrap_or(end);
        let length = part.needed("length");
        end = from + length;
        if !(from.abs() <= FARTHEST && (SHORTEST..=FARTHEST).contains(&length)) {
            let found = format!("{} m from {} m on", number_text(length), number_text(from));
            let allowed = "a length from 1 um to 1 km, within 1 km of the origin, is needed";
            return part.refuse(Code::RotorGeometry, "length", found, allowed);
        }
        let damping = |name: &str| match carries {
            true => part.number(name).unwrap_or_else(|| default(name)),
            false => 0.0,
        };
        let layer = Layer {
            from,
            to: end,
            start,
            end: last,
            material: material(part, &materials)?,
            longest: (part.number("elements")).map_or(f64::INFINITY, |count| length / count),
            carries,
            damping_of_mass: damping("damping_of_mass"),
            damping_of_stiffness: damping("damping_of_stiffness"),
            damping_rotating: damping("damping_rotating"),
        };
        out.push(Piece {
            name: part.label.clone(),
            material: part.text("material").unwrap_or_default().to_string(),
            layer,
        });
    }
    let longest = longest_element(ends(&out), values);
    let undivided = out.iter_mut().map(|piece| &mut piece.layer);
    for layer in undivided.filter(|layer| layer.carries && layer.longest.is_infinite()) {
        layer.longest = longest;
    }
    Ok(out)
}

/// Refuses a ring without a wall.
fn hollow(part: &Part, name: &str, Annulus { outer, inner }: Annulus) -> Checked<()> {
    if inner < outer {
        return Ok(());
    }
    let found = format!("{inner} m inside {outer} m");
    let allowed = "an inner diameter below the outer one is needed";
    part.refuse(Code::RotorGeometry, name, found, allowed)
}

/// Young's modulus below which a material carries no load of a rotor, Pa: shrunk-on masses are often given so.
const NO_STIFFNESS: f64 = 1e6;

/// A material by name: the file's own, or one that is known and stands beside these.
fn material(part: &Part, own: &[&Part]) -> Checked<Material> {
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
                return given.refuse(Code::OutOfRange, "shear_modulus", found, allowed);
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
    Err(problem.with_hint(hint))
}

/// Where a part sits, m: at a position, or at a node by its name.
fn position(part: &Part, nodes: &[Node]) -> Checked<f64> {
    let text = part.text("at").unwrap_or_default().trim();
    if let Some(node) = nodes.iter().find(|node| node.name == text) {
        return Ok(node.at);
    }
    let length = units::parse_quantity(text).ok();
    let length = length.filter(|q| q.dimension == units::Dimension::LENGTH);
    if let Some(quantity) = length {
        return Ok(quantity.value_si);
    }
    let known: Vec<&str> = nodes.iter().map(|node| node.name.as_str()).collect();
    let allowed = match known.as_slice() {
        [] => "a position such as \"0.25 m\", or the name of a [[rotor.node]], is needed; the file has no node".to_string(),
        all => format!("a position such as \"0.25 m\", or one of the nodes {}, is needed", all.join(", ")),
    };
    let problem = part.problem(Code::NoSuchNode, "at", quoted(text), allowed);
    Err(problem.with_hint(did_you_mean(text, known)))
}

/// A position that is one between the ends of the shaft, m.
fn on_shaft(part: &Part, at: f64, [first, last]: [f64; 2]) -> Checked<f64> {
    if (first - SAME_PLACE..=last + SAME_PLACE).contains(&at) {
        return Ok(at);
    }
    let metres = |z: f64| number_text((z * 1e9).round() / 1e9);
    let found = format!("{} m, which is beside the shaft", metres(at));
    let allowed = format!(
        "a position from {} m to {} m is needed",
        metres(first),
        metres(last)
    );
    part.refuse(Code::NoSuchNode, "at", found, allowed)
}

/// What the rounding of given inertias may add to the ratio of a thin disk.
const ROUNDED: f64 = 0.01;

fn disk(part: &Part, at: f64, materials: &[&Part]) -> Checked<Disk> {
    const INERTIA: [&str; 3] = ["mass", "polar_inertia", "diametral_inertia"];
    const DIMENSIONS: [&str; 3] = ["width", "outer_diameter", "material"];
    let given = |name: &&str| part.known.contains_key(*name);
    let with = |[mass, polar, diametral]: [f64; 3]| Disk {
        name: part.label.clone(),
        at,
        mass,
        polar,
        diametral,
        outer_diameter: part.number("outer_diameter"),
        width: part.number("width"),
    };
    if INERTIA.iter().all(&given) {
        let [mass, polar, diametral] = INERTIA.map(|name| part.needed(name));
        if polar > 2.0 * diametral * (1.0 + ROUNDED) {
            let found = format!("{polar} kg m^2 about the axis, {diametral} kg m^2 across it");
            let allowed = "no body has more than twice as much about its axis as across it";
            return part.refuse(Code::RotorGeometry, "polar_inertia", found, allowed);
        }
        return Ok(with([mass, polar, diametral]));
    }
    if INERTIA.iter().any(&given) || !DIMENSIONS.iter().all(&given) {
        let lacking: Vec<&str> = match INERTIA.iter().any(&given) {
            true => INERTIA.into_iter().filter(|name| !given(name)).collect(),
            false => DIMENSIONS.into_iter().filter(|name| !given(name)).collect(),
        };
        let found = format!("a disk without {}", lacking.join(", "));
        let allowed = "mass, polar_inertia and diametral_inertia, or width, outer_diameter and material, are needed";
        return part.refuse(Code::MissingKey, "", found, allowed);
    }
    let (width, outer) = (part.needed("width"), part.needed("outer_diameter"));
    let inner = part.number("inner_diameter").unwrap_or_default();
    let section = Annulus { outer, inner };
    hollow(part, "inner_diameter", section)?;
    let density = material(part, materials)?.density;
    let mass = density * section.area() * width;
    Ok(with([
        mass,
        2.0 * density * section.second_moment() * width,
        density * section.second_moment() * width + mass * width * width / 12.0,
    ]))
}

/// The housing that a part stands on; the ground without.
pub(super) fn on(part: &Part, housings: &[&Part]) -> Checked<Option<usize>> {
    let Some(name) = part.text("on") else {
        return Ok(None);
    };
    let names: Vec<&str> = housings.iter().map(|part| part.label.as_str()).collect();
    let at = names.iter().position(|own| *own == name);
    at.map(Some).ok_or_else(|| {
        let allowed = match names.as_slice() {
            [] => "a [[rotor.housing]] of this name is needed; the file has none".to_string(),
            names => format!("one of the housings {} is needed", names.join(", ")),
        };
        let problem = part.problem(Code::NoSuchNode, "on", quoted(name), allowed);
        problem.with_hint(did_you_mean(name, names.iter().copied()))
    })
}

/// What a force from outside may have, as its keys and the ends of those of its channels.
const FORCES: [&str; 4] = ["x", "y", "z", "torque"];

/// A force from outside at a place.
fn force(part: &Part, at: f64) -> Checked<Force> {
    let channels = FORCES.map(|key| part.text(&format!("channel_{key}")).map(str::to_string));
    let none = channels.iter().all(Option::is_none);
    let [x, y, along, torque] = channels;
    let record = part.text("file").map(|path| ForceRecord {
        file: RecordFile {
            path: path.into(),
            channels: [x, y],
        },
        along,
        torque,
        start: part.needed("start"),
        scale: part.needed("scale"),
    });
    if record.is_some() {
        if none {
            let found = "a file of which no channel is named";
            let allowed = "channel_x, channel_y, channel_z or channel_torque is needed";
            return part.refuse(Code::MissingKey, "file", found, allowed);
        }
        return Ok(Force {
            path: part.path.clone(),
            at,
            over_time: Default::default(),
            record,
        });
    }
    let times = part.series("times").unwrap_or_default();
    if times.is_empty() {
        let allowed = "times with x, y, z or torque, or file, is needed";
        return part.refuse(Code::MissingKey, "times", "a force without times", allowed);
    }
    if !times.windows(2).all(|pair| pair[0] < pair[1]) {
        let allowed = "times that rise from entry to entry are needed";
        return part.refuse(Code::TableOrder, "times", "times that do not rise", allowed);
    }
    let along = |axis: &str| -> Checked<Vec<[f64; 2]>> {
        let Some(list) = part.series(axis) else {
            return Ok(vec![[0.0; 2]]);
        };
        if list.len() != 1 && list.len() != times.len() {
            let found = format!("{} values", list.len());
            let allowed = format!(
                "one value, or one for each of the {} times, is needed",
                times.len()
            );
            return part.refuse(Code::WrongType, axis, found, allowed);
        }
        let rows = times.iter().zip(list.iter().cycle());
        Ok(rows.map(|(time, force)| [*time, *force]).collect())
    };
    if FORCES.iter().all(|key| part.series(key).is_none()) {
        let allowed = "x, y, z or torque is needed";
        return part.refuse(
            Code::MissingKey,
            "x",
            "a force without a direction",
            allowed,
        );
    }
    let [x, y, z, torque] = FORCES.map(along);
    Ok(Force {
        path: part.path.clone(),
        at,
        over_time: [x?, y?, z?, torque?],
        record: None,
    })
}

/// Stiffness, damping and mass of a support, over its speeds.
fn coefficients(part: &Part) -> Checked<Coefficients> {
    let speeds = part.series("speeds").unwrap_or(&[0.0]);
    let table = part.series("speeds").is_some();
    if !speeds.windows(2).all(|pair| pair[0] < pair[1]) || speeds.iter().any(|s| *s < 0.0) {
        let allowed = "speeds not below 0 that rise from entry to entry are needed";
        return part.refuse(
            Code::TableOrder,
            "speeds",
            "speeds that do not rise",
            allowed,
        );
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
                return part.refuse(Code::WrongType, &key, found, allowed);
            }
            if row == column && list.iter().any(|value| *value < 0.0) && name == "added_mass" {
                let allowed = "a mass not below 0 is needed";
                return part.refuse(Code::OutOfRange, &key, "a negative mass", allowed);
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
