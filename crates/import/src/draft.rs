//! A rotor on its way: read from elsewhere, not yet written.

use rotor::{
    Annulus, Block, C64, Coefficients, Disk, Element, Housing, Material, Place, PointMass, Rotor,
    Support,
};
use std::fmt::Write;
use units::number_text;

/// A rotor as it was read, in SI.
#[derive(Default)]
pub struct Draft {
    /// What kind of file it was.
    pub kind: String,
    /// Title of the scenario.
    pub title: String,
    /// Rated speed, rad/s.
    pub speed: f64,
    /// Positions of nodes of the shaft, m.
    pub nodes: Vec<f64>,
    /// Materials by name.
    pub materials: Vec<(String, Material)>,
    /// Pieces of shaft, one element each: index of the material, element.
    pub pieces: Vec<(usize, Element)>,
    /// Name and disk.
    pub disks: Vec<(String, Disk)>,
    /// Masses by name.
    pub masses: Vec<(String, PointMass)>,
    /// Supports and seals by name.
    pub supports: Vec<(String, DraftSupport)>,
    /// Mass of each housing, kg.
    pub housings: Vec<f64>,
    /// What the file has and the draft has not.
    pub notes: Vec<String>,
    /// Eigenvalues that the file states: speed, list.
    pub stated: Vec<(f64, Vec<C64>)>,
    /// Those that lack a number.
    pub nulls: Vec<String>,
    /// Whether pieces are divided further, because the file says nothing of elements.
    pub divide: bool,
}

/// A support before it is known whether its table holds.
pub struct DraftSupport {
    /// Where it sits.
    pub at: Place,
    /// The housing that carries it; none of a fixed one.
    pub on: Option<usize>,
    /// Coefficients at speeds, rad/s.
    pub rows: Vec<(f64, Block)>,
    /// Whether it is a seal.
    pub seal: bool,
}

impl Draft {
    /// The material of these numbers; a new one gets a name of its own.
    pub fn material(&mut self, name: &str, material: Material) -> usize {
        if let Some(known) = self.materials.iter().position(|(_, own)| *own == material) {
            return known;
        }
        let plain: String = name
            .chars()
            .map(|c| {
                if c.is_alphanumeric() {
                    c.to_ascii_lowercase()
                } else {
                    '_'
                }
            })
            .collect();
        let taken = |name: &String| self.materials.iter().any(|(own, _)| own == name);
        let mut own = if plain.is_empty() {
            "material".to_string()
        } else {
            plain.clone()
        };
        let mut number = 2;
        // a name that the program knows would mean its numbers
        while taken(&own) || physics::shaft::MATERIALS.iter().any(|known| known.0 == own) {
            own = format!("{plain}_{number}");
            number += 1;
        }
        self.materials.push((own, material));
        self.materials.len() - 1
    }

    /// The rotor as it was read.
    pub fn rotor(&self) -> Rotor {
        let supports = self.supports.iter().map(|(_, support)| Support {
            at: support.at,
            on: support.on,
            coefficients: Coefficients::table(support.rows.clone())
                .unwrap_or(Coefficients::constant(Block::default())),
            seal: support.seal,
        });
        Rotor {
            nodes: self.nodes.clone(),
            elements: self.pieces.iter().map(|(_, element)| *element).collect(),
            disks: self.disks.iter().map(|(_, disk)| *disk).collect(),
            masses: self.masses.iter().map(|(_, mass)| *mass).collect(),
            supports: supports.collect(),
            housings: self
                .housings
                .iter()
                .map(|mass| Housing { mass: *mass })
                .collect(),
            unbalance: Vec::new(),
        }
    }

    /// The scenario of the rotor.
    pub fn toml(&self) -> String {
        let mut out = String::new();
        let mut add = |text: String| {
            out.push_str(&text);
            out.push('\n');
        };
        add(format!("# Written by auxbear import from a {}.", self.kind));
        for note in &self.notes {
            add(format!(
                "# Not taken as it stands: {}",
                note.replace('\n', " ")
            ));
        }
        add(format!("format = \"{}\"", scenario::FORMAT));
        add("system = \"rotor\"".to_string());
        add(format!("title = {}", scenario::quoted(&self.title)));
        add(format!(
            "\n[rotor]\nspeed = \"{} rad/s\"",
            number_text(self.speed)
        ));
        for (name, material) in &self.materials {
            add(format!(
                "\n[[rotor.material]]\nname = \"{name}\"\nyoungs_modulus = \"{} Pa\"\nshear_modulus = \"{} Pa\"\ndensity = \"{} kg/m^3\"",
                number_text(material.young),
                number_text(material.shear),
                number_text(material.density)
            ));
        }
        for (material, element) in &self.pieces {
            add(self.section(*material, element));
        }
        let at = |node: usize| format!("at = \"{} m\"", number_text(self.nodes[node]));
        for (name, disk) in &self.disks {
            add(format!(
                "\n[[rotor.disk]]\nname = {}\n{}\nmass = \"{} kg\"\npolar_inertia = \"{} kg m^2\"\ndiametral_inertia = \"{} kg m^2\"",
                scenario::quoted(name),
                at(disk.node),
                number_text(disk.mass),
                number_text(disk.polar),
                number_text(disk.diametral)
            ));
        }
        for (name, mass) in &self.masses {
            add(format!(
                "\n[[rotor.mass]]\nname = {}\n{}\nmass = \"{} kg\"",
                scenario::quoted(name),
                at(mass.node),
                number_text(mass.mass)
            ));
        }
        for (index, mass) in self.housings.iter().enumerate() {
            let own = |(_, support): &&(String, DraftSupport)| support.at == Place::Housing(index);
            let mount = self.supports.iter().find(own);
            add(format!(
                "\n[[rotor.housing]]\nname = \"housing_{}\"\nmass = \"{} kg\"{}",
                index + 1,
                number_text(*mass),
                mount.map_or(String::new(), |(_, support)| coefficients(&support.rows))
            ));
        }
        for (name, support) in &self.supports {
            let Place::Node(node) = support.at else {
                continue;
            };
            let on = support
                .on
                .map(|housing| format!("\non = \"housing_{}\"", housing + 1));
            add(format!(
                "\n[[rotor.{}]]\nname = {}\n{}{}{}",
                if support.seal { "seal" } else { "support" },
                scenario::quoted(name),
                at(node),
                on.unwrap_or_default(),
                coefficients(&support.rows)
            ));
        }
        out
    }

    fn section(&self, material: usize, element: &Element) -> String {
        let metres = |name: &str, value: f64| format!("\n{name} = \"{} m\"", number_text(value));
        let mut out = String::from("\n[[rotor.section]]");
        out += &metres("from", self.nodes[element.left]);
        out += &metres("length", element.length);
        let Annulus { outer, inner } = element.start;
        out += &metres("outer_diameter", outer);
        if element.end.outer != outer {
            out += &metres("outer_diameter_end", element.end.outer);
        }
        if inner != 0.0 || element.end.inner != 0.0 {
            out += &metres("inner_diameter", inner);
        }
        if element.end.inner != inner {
            out += &metres("inner_diameter_end", element.end.inner);
        }
        let _ = write!(out, "\nmaterial = \"{}\"", self.materials[material].0);
        if !self.divide {
            out += "\nelements = 1";
        }
        for (name, unit, value) in [
            ("damping_of_mass", "1/s", element.damping_of_mass),
            ("damping_of_stiffness", "s", element.damping_of_stiffness),
        ] {
            if value != 0.0 {
                let _ = write!(out, "\n{name} = \"{} {unit}\"", number_text(value));
            }
        }
        out
    }
}

/// A number that was summed or converted, in the fifteen digits that say something: 0.3 for 0.1 + 0.2.
pub(super) fn cleaned(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// Coefficients of a support as keys.
fn coefficients(rows: &[(f64, Block)]) -> String {
    type Entry = (&'static str, &'static str, fn(&Block) -> f64);
    const ENTRIES: [Entry; 12] = [
        ("stiffness", "N/m", |b| b.stiffness[0][0]),
        ("stiffness_yy", "N/m", |b| b.stiffness[1][1]),
        ("stiffness_xy", "N/m", |b| b.stiffness[0][1]),
        ("stiffness_yx", "N/m", |b| b.stiffness[1][0]),
        ("damping", "N s/m", |b| b.damping[0][0]),
        ("damping_yy", "N s/m", |b| b.damping[1][1]),
        ("damping_xy", "N s/m", |b| b.damping[0][1]),
        ("damping_yx", "N s/m", |b| b.damping[1][0]),
        ("added_mass", "kg", |b| b.mass[0][0]),
        ("added_mass_yy", "kg", |b| b.mass[1][1]),
        ("added_mass_xy", "kg", |b| b.mass[0][1]),
        ("added_mass_yx", "kg", |b| b.mass[1][0]),
    ];
    let series = |unit: &str, values: &[f64]| {
        let texts: Vec<String> = values
            .iter()
            .map(|value| format!("\"{} {unit}\"", number_text(*value)))
            .collect();
        match texts.as_slice() {
            [one] => one.clone(),
            all => format!("[{}]", all.join(", ")),
        }
    };
    let mut out = String::new();
    if rows.len() > 1 {
        let speeds: Vec<f64> = rows.iter().map(|(speed, _)| *speed).collect();
        let _ = write!(out, "\nspeeds = {}", series("rad/s", &speeds));
    }
    let mut before: Vec<f64> = Vec::new();
    for (name, unit, entry) in ENTRIES {
        let values: Vec<f64> = rows.iter().map(|(_, block)| entry(block)).collect();
        // what is 0, or in y what it is in x, needs not stand
        let known = match name.ends_with("_yy") {
            true => values == before,
            false => values.iter().all(|value| *value == 0.0),
        };
        if !known {
            let _ = write!(out, "\n{name} = {}", series(unit, &values));
        }
        before = values;
    }
    out
}
