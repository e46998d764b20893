//! The keys of the parts of a bent rotor: arrays of tables `[[rotor.section]]`, `[[rotor.disk]]` and so on.

use crate::scenario::key::{Key, Kind, Range};

/// A kind of part.
#[derive(Debug)]
pub(crate) struct PartKind {
    /// Its word: `section` of `[[rotor.section]]`.
    pub(crate) word: &'static str,
    pub(crate) doc: &'static str,
    pub(crate) keys: &'static [Key],
    /// Parts of the starting file: values of keys as written, without quotes.
    pub(crate) starting: &'static [&'static [(&'static str, &'static str)]],
}

/// A key of a part.
macro_rules! key {
    ($part:literal, $name:literal, $kind:expr, $example:literal, $doc:expr) => {
        Key::new(concat!("rotor.", $part, ".", $name), $kind, $example, $doc)
    };
}

/// A name; results and messages carry it.
macro_rules! name {
    ($part:literal, $example:literal) => {
        key!(
            $part,
            "name",
            Kind::Text,
            $example,
            "Its name, in results and messages."
        )
        .optional("its number names it")
    };
}

/// Where a part sits.
macro_rules! at {
    ($part:literal) => {
        key!(
            $part,
            "at",
            Kind::Text,
            "0.25 m",
            "Where it sits: a position along the shaft, or the name of a [[rotor.node]]."
        )
    };
}

const FOUR: &str = "Coefficients are constant, or one for each of speeds.";

/// Stiffness and damping of a support, over speed where a table is given.
macro_rules! coefficients {
    ($part:literal, $($more:expr),* $(,)?) => {
        &[
            $($more,)*
            key!($part, "speeds", Kind::Series("rad/s"), "[\"0 rpm\", \"6000 rpm\"]", "Speeds of a table of coefficients, rising. Between them coefficients are linear, beyond them they stay.")
                .optional("coefficients are constant"),
            key!($part, "stiffness", Kind::Series("N/m"), "1e6 N/m", FOUR).optional("it is 0"),
            key!($part, "stiffness_yy", Kind::Series("N/m"), "0.8e6 N/m", "Stiffness in y; stiffness is then that in x.").optional("it is that in x"),
            key!($part, "stiffness_xy", Kind::Series("N/m"), "1e5 N/m", "Force against x for a displacement in y.").optional("it is 0"),
            key!($part, "stiffness_yx", Kind::Series("N/m"), "-1e5 N/m", "Force against y for a displacement in x; of a rotating fluid opposite to stiffness_xy.").optional("it is 0"),
            key!($part, "damping", Kind::Series("N s/m"), "200 N s/m", "Damping.").optional("it is 0"),
            key!($part, "damping_yy", Kind::Series("N s/m"), "200 N s/m", "Damping in y; damping is then that in x.").optional("it is that in x"),
            key!($part, "damping_xy", Kind::Series("N s/m"), "20 N s/m", "Force against x for a velocity in y.").optional("it is 0"),
            key!($part, "damping_yx", Kind::Series("N s/m"), "-20 N s/m", "Force against y for a velocity in x.").optional("it is 0"),
            key!($part, "added_mass", Kind::Series("kg"), "0.5 kg", "Mass of the fluid that moves with it.").optional("it is 0"),
            key!($part, "added_mass_yy", Kind::Series("kg"), "0.5 kg", "The same in y.").optional("it is that in x"),
            key!($part, "added_mass_xy", Kind::Series("kg"), "0 kg", "Force against x for an acceleration in y.").optional("it is 0"),
            key!($part, "added_mass_yx", Kind::Series("kg"), "0 kg", "Force against y for an acceleration in x.").optional("it is 0"),
        ]
    };
}

pub(crate) const PARTS: &[PartKind] = &[
    PartKind {
        word: "material",
        doc: "A material of your own. Known by name are steel, stainless_steel, titanium, aluminium and nickel_alloy.",
        keys: &[
            key!("material", "name", Kind::Text, "shaft_steel", "Its name."),
            key!("material", "youngs_modulus", Kind::Quantity("Pa"), "211 GPa", "Young's modulus.").positive(),
            key!("material", "poisson_ratio", Kind::Coefficient, "0.3", "Poisson's ratio.").within(Range::FromTo(0.0, 0.499)).optional("it follows from shear_modulus, else it is 0.3"),
            key!("material", "shear_modulus", Kind::Quantity("Pa"), "81.2 GPa", "Shear modulus.").positive().optional("it is E/(2(1 + poisson_ratio))").excludes("rotor.material.poisson_ratio"),
            key!("material", "density", Kind::Quantity("kg/m^3"), "7810 kg/m^3", "Density.").positive(),
        ],
        starting: &[],
    },
    PartKind {
        word: "node",
        doc: "A place on the shaft with a name.",
        keys: &[
            key!("node", "name", Kind::Text, "drive_end", "Its name."),
            key!("node", "at", Kind::Quantity("m"), "0.1 m", "Position along the shaft."),
        ],
        starting: &[&[("name", "drive_end"), ("at", "0.1 m")], &[("name", "other_end"), ("at", "0.7 m")]],
    },
    PartKind {
        word: "section",
        doc: "A piece of shaft, solid, hollow or tapered. Pieces follow each other; one that lies over another gives from.",
        keys: &[
            name!("section", "journal"),
            key!("section", "from", Kind::Quantity("m"), "0 m", "Position of its left end.").optional("it begins where the section before it ends, the first at 0"),
            key!("section", "length", Kind::Quantity("m"), "0.8 m", "Length.").positive(),
            key!("section", "outer_diameter", Kind::Quantity("m"), "40 mm", "Outer diameter, of a tapered piece at its left end.").positive(),
            key!("section", "outer_diameter_end", Kind::Quantity("m"), "50 mm", "Outer diameter at its right end.").positive().optional("it is that of the left end"),
            key!("section", "inner_diameter", Kind::Quantity("m"), "10 mm", "Diameter of the bore, of a tapered one at its left end.").not_negative().default("0 m", "a solid shaft"),
            key!("section", "inner_diameter_end", Kind::Quantity("m"), "10 mm", "Diameter of the bore at its right end.").not_negative().optional("it is that of the left end"),
            key!("section", "material", Kind::Text, "steel", "Its material, by name."),
            key!("section", "elements", Kind::Count, "4", "Number of elements that it is divided into, where nothing sits between them.").within(Range::FromTo(1.0, 1000.0)).optional("as many as rotor.longest_element asks for"),
            key!("section", "damping_of_mass", Kind::Quantity("1/s"), "2.5 1/s", "As rotor.damping_of_mass, of this piece.").not_negative().optional("rotor.damping_of_mass counts"),
            key!("section", "damping_of_stiffness", Kind::Quantity("s"), "1 us", "As rotor.damping_of_stiffness, of this piece.").not_negative().optional("rotor.damping_of_stiffness counts"),
            key!("section", "damping_rotating", Kind::Quantity("s"), "1 us", "As rotor.damping_rotating, of this piece.").not_negative().optional("rotor.damping_rotating counts"),
        ],
        starting: &[&[("length", "0.8 m"), ("outer_diameter", "40 mm"), ("material", "steel")]],
    },
    PartKind {
        word: "sleeve",
        doc: "A ring on the shaft that adds mass and inertia but no stiffness. One that is shrunk on so that it bends with the shaft is a section.",
        keys: &[
            name!("sleeve", "landing_sleeve"),
            key!("sleeve", "from", Kind::Quantity("m"), "0.1 m", "Position of its left end."),
            key!("sleeve", "length", Kind::Quantity("m"), "30 mm", "Length.").positive(),
            key!("sleeve", "outer_diameter", Kind::Quantity("m"), "50 mm", "Outer diameter.").positive(),
            key!("sleeve", "inner_diameter", Kind::Quantity("m"), "40 mm", "Inner diameter.").not_negative(),
            key!("sleeve", "material", Kind::Text, "steel", "Its material, by name."),
        ],
        starting: &[],
    },
    PartKind {
        word: "disk",
        doc: "A rigid disk: its mass and inertia, or its dimensions and material.",
        keys: &[
            name!("disk", "impeller"),
            at!("disk"),
            key!("disk", "mass", Kind::Quantity("kg"), "5 kg", "Mass.").positive().optional("it follows from the dimensions"),
            key!("disk", "polar_inertia", Kind::Quantity("kg m^2"), "0.02 kg m^2", "Moment of inertia about the axis.").not_negative().optional("it follows from the dimensions"),
            key!("disk", "diametral_inertia", Kind::Quantity("kg m^2"), "0.01 kg m^2", "Moment of inertia about a diameter.").not_negative().optional("it follows from the dimensions"),
            key!("disk", "width", Kind::Quantity("m"), "20 mm", "Width of a disk that is given by its dimensions; else only for the drawing.").positive().optional("mass and inertias are needed"),
            key!("disk", "outer_diameter", Kind::Quantity("m"), "200 mm", "Outer diameter of a disk that is given by its dimensions; else only for the drawing.").positive().optional("mass and inertias are needed"),
            key!("disk", "inner_diameter", Kind::Quantity("m"), "40 mm", "Inner diameter of such a disk.").not_negative().optional("it is 0"),
            key!("disk", "material", Kind::Text, "steel", "Material of such a disk.").optional("mass and inertias are needed"),
        ],
        starting: &[&[("name", "impeller"), ("at", "0.4 m"), ("mass", "5 kg"), ("polar_inertia", "0.02 kg m^2"), ("diametral_inertia", "0.012 kg m^2")]],
    },
    PartKind {
        word: "mass",
        doc: "A mass without inertia on the shaft.",
        keys: &[
            name!("mass", "coupling_half"),
            at!("mass"),
            key!("mass", "mass", Kind::Quantity("kg"), "0.4 kg", "Mass.").positive(),
        ],
        starting: &[],
    },
    PartKind {
        word: "housing",
        doc: "A housing or pedestal: a mass that supports stand on, on a mount of its own.",
        keys: coefficients![
            "housing",
            key!("housing", "name", Kind::Text, "pedestal", "Its name, for rotor.support.on."),
            key!("housing", "mass", Kind::Quantity("kg"), "5 kg", "Mass.").positive(),
        ],
        starting: &[],
    },
    PartKind {
        word: "support",
        doc: "A linear support: two-by-two stiffness and damping, constant or over speed.",
        keys: coefficients![
            "support",
            name!("support", "drive_end_bearing"),
            at!("support"),
            key!("support", "on", Kind::Text, "pedestal", "Name of the [[rotor.housing]] that it stands on.").optional("it stands on the ground"),
        ],
        starting: &[
            &[("name", "bearing_1"), ("at", "drive_end"), ("stiffness", "1e7 N/m"), ("damping", "500 N s/m")],
            &[("name", "bearing_2"), ("at", "other_end"), ("stiffness", "1e7 N/m"), ("damping", "500 N s/m")],
        ],
    },
    PartKind {
        word: "seal",
        doc: "A seal: coefficients as a support's, but no static load.",
        keys: coefficients![
            "seal",
            name!("seal", "balance_piston"),
            at!("seal"),
            key!("seal", "on", Kind::Text, "pedestal", "Name of the [[rotor.housing]] that it stands on.").optional("it stands on the ground"),
        ],
        starting: &[],
    },
    PartKind {
        word: "unbalance",
        doc: "An unbalance plane. All act together.",
        keys: &[
            name!("unbalance", "impeller_unbalance"),
            at!("unbalance"),
            key!("unbalance", "amount", Kind::Quantity("kg m"), "20 g mm", "Mass times distance from the axis.").not_negative(),
            key!("unbalance", "phase", Kind::Quantity("rad"), "90 deg", "Angle on the rotor.").default("0 deg", "along the mark that angles count from"),
        ],
        starting: &[&[("at", "0.4 m"), ("amount", "20 g mm")]],
    },
];

/// The kind of part at a path: `rotor.section`.
pub(crate) fn kind_at(path: &str) -> Option<&'static PartKind> {
    let word = path.strip_prefix("rotor.")?;
    PARTS.iter().find(|kind| kind.word == word)
}
