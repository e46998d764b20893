//! The keys of a flexible rotor: what is asked of it, and its parts, arrays of tables `[[rotor.section]]`, `[[levitation.magnet]]` and so on.

use crate::drop::event::Happening;
use crate::key::{Key, Kind, Range, Section};
use crate::system::ROTOR;
use problem::words::Words;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[Section::new("analysis", "What is computed of the rotor: speeds, modes, margins.", ROTOR)];

/// What is asked of a flexible rotor; its own keys stand with those of the rotor that falls.
#[rustfmt::skip]
pub const KEYS: &[Key] = &[
    Key::new("analysis.speed_from", Kind::Quantity("rad/s"), "0 rpm", "Lowest speed of the diagrams.").not_negative().default("0 rpm", "from standstill"),
    Key::new("analysis.speed_to", Kind::Quantity("rad/s"), "18000 rpm", "Highest speed of the diagrams.")
        .positive().derived("1.5 times rotor.speed, at least as far as analysis.separation_margin reaches above analysis.operating_to; of a machine that starts at standstill the highest speed of its drive"),
    Key::new("analysis.speed_count", Kind::Count, "201", "Number of speeds of the diagrams. Critical speeds are searched between them.")
        .within(Range::FromTo(11.0, 5000.0)).default("201", "enough for a smooth picture"),
    Key::new("analysis.frequency_to", Kind::Quantity("rad/s"), "1800 rad/s", "Highest frequency of the Campbell diagram.")
        .positive().derived("1.5 times the highest speed"),
    Key::new("analysis.modes", Kind::Count, "6", "Number of modes shown with their shapes at rotor.speed, and of the free rotor at rest.")
        .within(Range::FromTo(1.0, 100.0)).default("6", "both rigid motions and the first bending, each of both senses"),
    Key::new("analysis.cutoff", Kind::Quantity("rad/s"), "60000 rad/s", "Modes of the free rotor up to this frequency are coordinates of the Campbell diagram, with residual flexibilities; small rotors keep all.")
        .positive().derived("6 times the highest frequency looked at"),
    Key::new("analysis.gravity", Kind::Quantity("m/s^2"), "9.80665 m/s^2", "Acceleration of gravity across the shaft, for sag and support loads; 0 for a vertical shaft.")
        .not_negative().default("9.80665 m/s^2", "standard gravity, a horizontal shaft"),
    Key::new("analysis.gravity_angle", Kind::Quantity("rad"), "-90 deg", "Direction of gravity, from x.").default("-90 deg", "down: against y"),
    Key::new("analysis.operating_from", Kind::Quantity("rad/s"), "9000 rpm", "Lowest operating speed, for the separation of critical speeds.")
        .positive().derived("rotor.speed"),
    Key::new("analysis.operating_to", Kind::Quantity("rad/s"), "12000 rpm", "Highest operating speed.").positive().derived("rotor.speed"),
    Key::new("analysis.separation_margin", Kind::Coefficient, "0.15", "Least distance of a forward critical speed from the operating speeds, as a share of the nearer one: each critical speed gets a verdict.")
        .within(Range::FromTo(0.0, 10.0)).optional("critical speeds get no verdict"),
    Key::new("analysis.exempt_amplification", Kind::Coefficient, "2.5", "Amplification below which a critical speed is damped enough to need no separation.")
        .positive().optional("no damping exempts a critical speed"),
    Key::new("analysis.map_from", Kind::Quantity("N/m"), "1e4 N/m", "Lowest stiffness of the map of critical speeds over support stiffness.")
        .positive().derived("a hundredth of the mean stiffness of supports and magnets (position_stiffness)"),
    Key::new("analysis.map_to", Kind::Quantity("N/m"), "1e8 N/m", "Highest stiffness of the map.")
        .positive().derived("100 times the mean stiffness of supports and magnets (position_stiffness)"),
    Key::new("analysis.map_count", Kind::Count, "41", "Number of stiffnesses of the map, evenly spaced on a logarithmic axis.")
        .within(Range::FromTo(2.0, 1000.0)).default("41", "ten a decade"),
    Key::new("analysis.whirl_to", Kind::Quantity("rad/s"), "4000 rad/s", "Highest frequency of dry backward whirl looked at, in the auxiliary bearings of a machine whose rotor is analysed.")
        .positive().optional("it is analysis.frequency_to, or twice the natural frequency of the rotor on the springs of all mounts where that is higher"),
];

/// Word of what happens to a machine.
pub const EVENT: &str = "event";
/// Word of a force from outside on its rotor.
pub const FORCE: &str = "force";
/// Kinds that a machine alone has, not the analysis of its rotor.
pub const OF_MACHINES: [&str; 2] = [EVENT, FORCE];

/// A kind of part.
#[derive(Debug)]
pub struct PartKind {
    /// Its word: `section` of `[[rotor.section]]`.
    pub word: &'static str,
    /// What it is, in one or two sentences.
    pub doc: &'static str,
    /// Whether a single one may stand as a plain table.
    pub alone: bool,
    /// Its keys.
    pub keys: &'static [Key],
    /// Parts of the starting file: values of keys as written, without quotes.
    pub starting: &'static [&'static [(&'static str, &'static str)]],
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

/// A key of a part of the levitation.
macro_rules! lev {
    ($part:literal, $name:literal, $kind:expr, $example:literal, $doc:expr) => {
        Key::new(
            concat!("levitation.", $part, ".", $name),
            $kind,
            $example,
            $doc,
        )
    };
}

const FOUR: &str = "Coefficients are constant, or one for each of speeds.";

/// Of a support: it acts on after the release.
pub const STAYS: &str = "stays";

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

/// All kinds of parts, in the order of a file.
pub const PARTS: &[PartKind] = &[
    PartKind {
        word: "material",
        doc: "A material of your own. Known by name are steel, stainless_steel, titanium, aluminium and nickel_alloy.",
        alone: false,
        keys: &[
            key!("material", "name", Kind::Text, "shaft_steel", "Its name."),
            key!("material", "youngs_modulus", Kind::Quantity("Pa"), "211 GPa", "Young's modulus.").within(Range::FromTo(1e5, 1e14)),
            key!("material", "poisson_ratio", Kind::Coefficient, "0.3", "Poisson's ratio.").within(Range::FromTo(0.0, 0.499)).optional("it follows from shear_modulus, else it is 0.3"),
            key!("material", "shear_modulus", Kind::Quantity("Pa"), "81.2 GPa", "Shear modulus.").positive().optional("it is E/(2(1 + poisson_ratio))").excludes("rotor.material.poisson_ratio"),
            key!("material", "density", Kind::Quantity("kg/m^3"), "7810 kg/m^3", "Density.").positive(),
        ],
        starting: &[],
    },
    PartKind {
        word: "node",
        doc: "A place on the shaft with a name.",
        alone: false,
        keys: &[
            key!("node", "name", Kind::Text, "drive_end", "Its name."),
            key!("node", "at", Kind::Quantity("m"), "0.1 m", "Position along the shaft."),
            key!("node", "clearance", Kind::Quantity("m"), "0.3 mm", "Radial clearance of what stands around the rotor here: a seal, a sensor, a magnet. A run on auxiliary bearings says what is left of it.").positive().optional("the least distance is not given"),
            key!("node", "on", Kind::Text, "casing", "Name of the [[rotor.housing]] that this belongs to: displacement and distance are then against it.").optional("it stands on the ground").beside(&["clearance"]),
        ],
        starting: &[&[("name", "drive_end"), ("at", "0.1 m")], &[("name", "other_end"), ("at", "0.7 m")]],
    },
    PartKind {
        word: "section",
        doc: "A piece of shaft, solid, hollow or tapered. Pieces follow each other; one that lies over another gives from.",
        alone: false,
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
        starting: &[&[("length", "0.8 m"), ("outer_diameter", "39.5 mm"), ("material", "steel")]],
    },
    PartKind {
        word: "sleeve",
        doc: "A ring on the shaft that adds mass and inertia but no stiffness. One that is shrunk on so that it bends with the shaft is a section.",
        alone: false,
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
        alone: false,
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
        alone: false,
        keys: &[
            name!("mass", "coupling_half"),
            at!("mass"),
            key!("mass", "mass", Kind::Quantity("kg"), "0.4 kg", "Mass.").positive(),
        ],
        starting: &[],
    },
    PartKind {
        word: "housing",
        doc: "A housing or pedestal: a mass that supports, seals, magnets with their sensors and auxiliary bearings stand on, on a mount of its own. It translates in the plane of the bearings, from where it rests.",
        alone: false,
        keys: coefficients![
            "housing",
            key!("housing", "name", Kind::Text, "pedestal", "Its name, for what stands on it: the keys on of support, seal, node, magnet and mount."),
            key!("housing", "mass", Kind::Quantity("kg"), "5 kg", "Mass.").positive(),
        ],
        starting: &[],
    },
    PartKind {
        word: "support",
        doc: "A linear support: two-by-two stiffness and damping, constant or over speed.",
        alone: false,
        keys: coefficients![
            "support",
            name!("support", "drive_end_bearing"),
            at!("support"),
            key!("support", "on", Kind::Text, "pedestal", "Name of the [[rotor.housing]] that it stands on.").optional("it stands on the ground"),
            key!("support", "after_release", Kind::Word(&["lets go", STAYS]), "stays", "What it does when a machine's rotor is released: it lets go with the levitation, or stays and goes on carrying its share of the weight.").default("lets go", "it stands for the levitation that is lost"),
        ],
        starting: &[
            &[("name", "bearing_1"), ("at", "drive_end"), ("stiffness", "1e7 N/m"), ("damping", "500 N s/m")],
            &[("name", "bearing_2"), ("at", "other_end"), ("stiffness", "1e7 N/m"), ("damping", "500 N s/m")],
        ],
    },
    PartKind {
        word: "seal",
        doc: "A seal: coefficients as a support's, but no static load.",
        alone: false,
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
        alone: false,
        keys: &[
            name!("unbalance", "impeller_unbalance"),
            at!("unbalance"),
            key!("unbalance", "amount", Kind::Quantity("kg m"), "20 g mm", "Mass times distance from the axis.").not_negative(),
            key!("unbalance", "phase", Kind::Quantity("rad"), "90 deg", "Angle on the rotor.").default("0 deg", "along the mark that angles count from"),
        ],
        starting: &[&[("at", "0.4 m"), ("amount", "20 g mm")]],
    },
    PartKind {
        word: FORCE,
        doc: "A force or torque from outside on the rotor of a machine, over time: a shaker, a hammer, gas, a gear, a drive, a brake. The start of the run is the steady motion without it.",
        alone: false,
        keys: &[
            name!("force", "shaker"),
            at!("force"),
            key!("force", "times", Kind::Series("s"), "[\"0.1 s\", \"0.101 s\", \"0.102 s\"]", "Instants of its points, rising. Between them the force is linear, beyond them it stays.").optional("a file has the force").excludes("rotor.force.file"),
            key!("force", "x", Kind::Series("N"), "[\"0 N\", \"500 N\", \"0 N\"]", "Force along x at these instants; one value where it is constant.").optional("it is 0").beside(&["times"]),
            key!("force", "y", Kind::Series("N"), "[\"0 N\", \"500 N\", \"0 N\"]", "Force along y at these instants.").optional("it is 0").beside(&["times"]),
            key!("force", "z", Kind::Series("N"), "[\"0 N\", \"2 kN\", \"-1 kN\"]", "Force along the shaft, towards its end, at these instants: a thrust. It acts at the mass centre of a rotor that bearings in space let move along its axis.").optional("it is 0").beside(&["times"]),
            key!("force", "torque", Kind::Series("N m"), "[\"0 N m\", \"-5 N m\", \"0 N m\"]", "Torque about the axis at these instants, of a drive or a brake: above 0 in the sense of positive speeds; it turns on a rotor that stands.").optional("it is 0").beside(&["times"]),
            key!("force", "file", Kind::Text, "hammer.csv", "File with a record of force and torque, relative to this one: formats, clock and units as of base.file. There is none before its first row and after its last.").optional("times, x, y, z and torque give them"),
            key!("force", "channel_x", Kind::Text, "impact", "Channel of the file with the force along x.").optional("none along x").beside(&["file"]),
            key!("force", "channel_y", Kind::Text, "impact", "Channel of the file with the force along y.").optional("none along y").beside(&["file"]),
            key!("force", "channel_z", Kind::Text, "thrust", "Channel of the file with the force along the shaft.").optional("none along it").beside(&["file"]),
            key!("force", "channel_torque", Kind::Text, "brake", "Channel of the file with the torque.").optional("no torque").beside(&["file"]),
            key!("force", "start", Kind::Quantity("s"), "0.2 s", "Instant of the run at which time 0 of the file lies.").not_negative().default("0 s", "the record begins with the run").beside(&["file"]),
            key!("force", "scale", Kind::Coefficient, "1.5", "Factor on what the file has.").within(Range::FromTo(-1000.0, 1000.0)).default("1.0", "no change of them").beside(&["file"]),
        ],
        starting: &[],
    },
    PartKind {
        word: "magnet",
        doc: "A radial magnet with two axes at right angles.",
        alone: false,
        keys: &[
            lev!("magnet", "name", Kind::Text, "drive_end", "Its name, in results and messages."),
            lev!("magnet", "at", Kind::Text, "0.25 m", "Where it sits: a position along the shaft, or the name of a [[rotor.node]]."),
            lev!("magnet", "on", Kind::Text, "casing", "Name of the [[rotor.housing]] that carries the magnet and its sensor.").optional("they stand on the ground"),
            lev!("magnet", "angle", Kind::Quantity("rad"), "45 deg", "Direction of its first axis from x; the second is a right angle ahead.").default("45 deg", "the usual frame"),
            lev!("magnet", "current_stiffness", Kind::Quantity("N/A"), "40 N/A", "Force over control current of an axis, k_i.").positive(),
            lev!("magnet", "position_stiffness", Kind::Quantity("N/m"), "1.6e5 N/m", "Force over displacement of an axis, k_s; it pushes away from the centre.").positive(),
            lev!("magnet", "gap", Kind::Quantity("m"), "0.4 mm", "Gap g₀ of an opposed pair with bias current; static position, forces, poles and sensitivities are then those of the pair under its load.").positive().optional("the force is linear"),
            lev!("magnet", "bias_current", Kind::Quantity("A"), "1.6 A", "Bias current of both coils of an axis, g₀k_s/k_i; given, it is checked.").positive().optional("it follows from gap and stiffnesses").beside(&["gap"]),
            lev!("magnet", "bias_difference_1", Kind::Quantity("A"), "0.8 A", "Bias of the coil that pulls along the first axis, less that of the coil against it; their mean is bias_current. Carries weight without control current; stiffnesses are given for equal biases.").default("0 A", "equal biases").beside(&["gap"]),
            lev!("magnet", "bias_difference_2", Kind::Quantity("A"), "0.8 A", "The same of the second axis.").default("0 A", "equal biases").beside(&["gap"]),
            lev!("magnet", "largest_current", Kind::Quantity("A"), "3.2 A", "Largest current of a coil, of a linear magnet largest control current.").positive().optional("no limit"),
            lev!("magnet", "amplifier_bandwidth", Kind::Quantity("1/s"), "2 kHz", "Corner of a current amplifier.").positive().optional("the current is the command").excludes("levitation.magnet.inductance"),
            lev!("magnet", "slew_rate", Kind::Quantity("A/s"), "3000 A/s", "Largest rate of the current of a coil: the voltage of its amplifier over its inductance.").positive().optional("no limit").beside(&["amplifier_bandwidth"]),
            lev!("magnet", "inductance", Kind::Quantity("H"), "20 mH", "Inductance of an axis, its two coils in series: twice that of one coil, k_i²/k_s without stray flux. It asks for a voltage amplifier.").positive().optional("a current amplifier"),
            lev!("magnet", "resistance", Kind::Quantity("ohm"), "1.5 ohm", "Resistance of an axis, its two coils in series.").positive().optional("needed beside inductance").beside(&["inductance"]),
            lev!("magnet", "amplifier_gain", Kind::Quantity("ohm"), "300 ohm", "Volts of the amplifier for each ampere that lacks.").positive().optional("the command is the voltage itself, gains are of V instead of A").beside(&["inductance"]),
            lev!("magnet", "largest_voltage", Kind::Quantity("V"), "150 V", "Largest voltage across the two coils of an axis in series.").positive().optional("no limit").beside(&["inductance"]),
        ],
        starting: &[],
    },
    PartKind {
        word: "sensor",
        doc: "A position sensor, its two axes along those of its magnet.",
        alone: false,
        keys: &[
            lev!("sensor", "magnet", Kind::Text, "drive_end", "Name of its magnet.").optional("it is that of every magnet without its own"),
            lev!("sensor", "at", Kind::Text, "0.23 m", "Where it sits: a position along the shaft, or the name of a [[rotor.node]]."),
            lev!("sensor", "bandwidth", Kind::Quantity("1/s"), "8 kHz", "Its corner, first order.").positive().optional("it follows at once"),
            lev!("sensor", "offset_1", Kind::Quantity("m"), "5 um", "What its first axis shows too much.").default("0 m", "calibrated"),
            lev!("sensor", "offset_2", Kind::Quantity("m"), "5 um", "What its second axis shows too much.").default("0 m", "calibrated"),
        ],
        starting: &[],
    },
    PartKind {
        word: "controller",
        doc: "A controller: a PID with filters on each axis, or matrices from all sensors to all magnets.",
        alone: true,
        keys: &[
            lev!("controller", "magnet", Kind::Text, "drive_end", "Name of its magnet.").optional("it is that of every magnet without its own"),
            lev!("controller", "proportional", Kind::Quantity("A/m"), "8000 A/m", "Gain of the displacement.").default("0 A/m", "none").unless(&["d"]),
            lev!("controller", "integral", Kind::Quantity("A/(m s)"), "8e4 A/(m s)", "Gain of its integral.").default("0 A/(m s)", "none").unless(&["d"]),
            lev!("controller", "derivative", Kind::Quantity("A s/m"), "22 A s/m", "Gain of its rate.").default("0 A s/m", "none").unless(&["d"]),
            lev!("controller", "derivative_time", Kind::Quantity("s"), "45 us", "Time constant that ends the derivative.").positive().optional("needed beside derivative").beside(&["derivative"]).unless(&["d"]),
            lev!("controller", "filters", Kind::Filters, "[{ numerator = [1, \"30 1/s\", \"6.3e6 1/s^2\"], denominator = [1, \"900 1/s\", \"6.3e6 1/s^2\"] }]", "Filters behind the PID, each coefficients of s over coefficients of s, the highest power first, of second order at most.").optional("no filter").unless(&["d"]),
            lev!("controller", "a", Kind::Matrix(&["1/s"]), "[[\"-1000 1/s\", 0], [0, \"-1000 1/s\"]]", "Matrix A of ẋ = A x + B e, row by row; e the errors of all sensor axes in the order of the magnets. States x have no unit.").optional("no states").beside(&["b", "c", "d"]),
            lev!("controller", "b", Kind::Matrix(&["1/(m s)"]), "[[\"1000 1/(m s)\", 0], [0, \"1000 1/(m s)\"]]", "Matrix B.").optional("0").beside(&["a"]),
            lev!("controller", "c", Kind::Matrix(&["A", "V"]), "[[\"1 A\", \"0 A\"], [\"0 A\", \"1 A\"]]", "Matrix C of commands = C x + D e, in A; in V where a magnet has inductance without amplifier_gain.").optional("0").beside(&["a"]),
            lev!("controller", "d", Kind::Matrix(&["A/m", "V/m"]), "[[\"8000 A/m\", \"0 A/m\"], [\"0 A/m\", \"8000 A/m\"]]", "Matrix D; given, the controller is that of the matrices.").optional("PID and filters"),
            lev!("controller", "delay", Kind::Quantity("s"), "50 us", "Delay of the commands.").not_negative().default("0 s", "none").unless(&["sampling_period"]),
            lev!("controller", "sampling_period", Kind::Quantity("s"), "50 us", "Period of a sampled controller; its delay is half of it and computing_time.").positive().optional("the controller runs at every instant"),
            lev!("controller", "fmu", Kind::Text, "controller.fmu", "A co-simulation unit (FMI 2.0 or 3.0) whose commands act in place of those of this table, sampled at sampling_period and held from computing_time on; relative to this file. Its inputs, in the order of its description, are the signals of the sensors, m, its outputs the commands, A or V, both axes of each magnet in the order of the magnets. The gains here stay what the linear analysis and the start take.").optional("the gains here act").beside(&["sampling_period"]),
            lev!("controller", "fmu_hash", Kind::Text, "sha256:5891b5b522d5df086d0ff0b110fbd9d21bb4fc7163af34d08286a2e846f6be03", "Hash of the file of the unit, as a run writes it into its resolved file; a run with another file is refused.").optional("any file of this name will do").beside(&["fmu"]),
            lev!("controller", "computing_time", Kind::Quantity("s"), "25 us", "From a sample to its command.").not_negative().default("0 s", "none").beside(&["sampling_period"]),
        ],
        starting: &[],
    },
    PartKind {
        word: EVENT,
        doc: "Something that happens to a machine: at an instant, where its rotor reaches a speed, or after another event. With events of magnets, sensors or controllers the power is lost by them alone; levitation.power_lost_at has no default then.",
        alone: false,
        keys: EVENT_KEYS,
        starting: &[],
    },
];

const EVENT_KEYS: &[Key] = &[
    Key::new("event.name", Kind::Text, "axis_lost", "Its name, for after and in messages.").optional("its number names it"),
    Key::new("event.case", Kind::Text, "axis lost", "Name of the case in which it happens, as run.case has it.").optional("it happens in every case"),
    Key::new("event.do", Kind::Word(Happening::WORDS), "axis lost", "What happens. Power lost and re-levitate are of the axial magnet too, axial magnet lost of it alone. Lost axes keep their controller from acting, and their currents decay with the bias; a stuck sensor keeps showing what it shows, a dead one shows nothing; a frozen command keeps its value while the amplifier follows it."),
    Key::new("event.at", Kind::Quantity("s"), "0.1 s", "Instant from the start of the run.").not_negative().optional("below_speed, above_speed or after says when"),
    Key::new("event.below_speed", Kind::Quantity("rad/s"), "6000 rpm", "It happens where the spin falls to this size: of a rotor that starts below it, after a drive has brought it above.").positive().optional("at, above_speed or after says when"),
    Key::new("event.above_speed", Kind::Quantity("rad/s"), "9000 rpm", "It happens where the spin rises to this size: of a rotor that starts above it, after it has been below.").positive().optional("at, below_speed or after says when"),
    Key::new("event.after", Kind::Text, "power_lost", "It happens after the event of this name; power_lost and brake are those of levitation.power_lost_at and rotor.brake_start.").optional("at, below_speed or above_speed says when"),
    Key::new("event.delay", Kind::Quantity("s"), "50 ms", "How long after.").not_negative().default("0 s", "at once").beside(&["after"]),
    Key::new("event.magnet", Kind::Text, "drive_end", "Name of the magnet that it happens to, or whose sensor or controller.").optional("it happens to all"),
    Key::new("event.axis", Kind::Count, "1", "Number of the axis, 1 or 2.").within(Range::FromTo(1.0, 2.0)).optional("it happens to both").beside(&["magnet"]),
    Key::new("event.decay_time", Kind::Quantity("s"), "5 ms", "Of lost magnets and axes: time in which the currents decay to 1/e, that of the bias too; 0: at once.").not_negative().optional("it is levitation.decay_time"),
    Key::new("event.offset", Kind::Quantity("m"), "20 um", "Of a sensor offset: what it shows too much from then on, before its own filter.").optional("needed with do = \"sensor offset\""),
    Key::new("event.deviation", Kind::Quantity("m"), "1 um", "Of sensor noise: standard deviation of what the sensor shows besides from then on, before its own filter.").positive().optional("needed for the noise of a sensor"),
    Key::new("event.period", Kind::Quantity("s"), "50 us", "Of sensor noise: time from a value to the next.").positive().optional("a sample, of sampled controllers"),
    Key::new("event.seed", Kind::Count, "1", "Of sensor noise: seed of its values.").not_negative().optional("1"),
    Key::new("event.largest_current", Kind::Quantity("A"), "2 A", "Of an amplifier limit: largest current of a coil from then on, of a linear magnet largest control current.").positive().optional("it stays"),
    Key::new("event.slew_rate", Kind::Quantity("A/s"), "1000 A/s", "Of an amplifier limit: largest rate of the current of a coil from then on.").positive().optional("it stays"),
    Key::new("event.bias_time", Kind::Quantity("s"), "20 ms", "Of a re-levitation: the bias rises by 1 - exp(-t/T) with this time T; 0: it is there at once.").not_negative().optional("needed with do = \"re-levitate\""),
    Key::new("event.reference_time", Kind::Quantity("s"), "0.1 s", "Of a re-levitation: time in which the references lead from where the rotor lies to the middle.").not_negative().optional("0: the controllers ask for the middle at once"),
    Key::new("event.within", Kind::Coefficient, "0.5", "Of a re-levitation: share of the radial air clearance, and of the axial gap to each face, within which the rotor must stay.").within(Range::FromTo(0.0, 1.0)).optional("0.5: half of it"),
    Key::new("event.hold", Kind::Quantity("s"), "0.1 s", "Of a re-levitation: how long before the end of the run the rotor must have stayed within it without contact, to count as held.").positive().optional("0.1 s"),
    Key::new("event.torque", Kind::Quantity("N m"), "2 N m", "Of a brake: size of the torque from then on; it acts against the spin until the rotor stands. Of a drive: its torque from then on, in the place of rotor.drive_torque; 0: it is off.").not_negative().optional("needed for a brake and a drive"),
    Key::new("event.node", Kind::Text, "wheel", "Of a load: name of the [[rotor.node]] at which it acts.").optional("needed for a load"),
    Key::new("event.force_x", Kind::Quantity("N"), "500 N", "Of a load: constant force along x from then on. It adds to every [[rotor.force]] and takes the place of an earlier load at the same node; 0 N takes that away.").optional("0 N where force_y is given"),
    Key::new("event.force_y", Kind::Quantity("N"), "-500 N", "Of a load: the same along y.").optional("0 N where force_x is given"),
    Key::new("event.plane", Kind::Text, "wheel", "Of an unbalance: name of the [[rotor.unbalance]] in whose plane it comes.").optional("needed for an unbalance that comes"),
    Key::new("event.amount", Kind::Quantity("kg m"), "200 g mm", "Of an unbalance that comes: mass times distance from the axis; of a lost blade, whose own mass is not taken from the rotor.").positive().optional("needed for an unbalance that comes"),
    Key::new("event.phase", Kind::Quantity("rad"), "180 deg", "Of an unbalance that comes: angle on the rotor; of a lost blade opposite to where it was.").optional("0: along the mark that angles count from"),
];

/// The kind of part at a path: `rotor.section`.
pub fn kind_at(path: &str) -> Option<&'static PartKind> {
    PARTS.iter().find(|kind| kind.path() == path)
}

/// The kind of part that a path leads into, `rotor.section.shaft.length`, with what follows its own path.
pub fn kind_within(path: &str) -> Option<(&'static PartKind, &str)> {
    let within =
        |kind: &'static PartKind| Some((kind, path.strip_prefix(kind.path())?.strip_prefix('.')?));
    PARTS.iter().find_map(within)
}

impl PartKind {
    /// The table it stands in: `rotor` of `[[rotor.section]]`; empty at the top of a file.
    pub fn table(&self) -> &'static str {
        self.path().split_once('.').map_or("", |(table, _)| table)
    }

    /// Table and word: `rotor.section`.
    pub fn path(&self) -> &'static str {
        let path = self.keys.first().map_or("", |key| key.path);
        path.rsplit_once('.').map_or(path, |(path, _)| path)
    }
}
