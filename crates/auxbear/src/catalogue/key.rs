//! What the catalogue knows of a bearing: the keys, their kinds and ranges.

use units::Dimension;

/// What a key takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// A text of number and unit.
    Quantity(Dimension),
    /// A whole number.
    Count,
    /// A number without unit.
    Ratio,
    /// One of a few words.
    Word(&'static [&'static str]),
}

/// One key of a bearing.
#[derive(Debug)]
pub(super) struct Key {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    /// A value in the right form.
    pub(super) example: &'static str,
    /// Least and most, SI; the least itself is not allowed, the most is.
    pub(super) range: (f64, f64),
}

impl Key {
    /// The range in words, after "a value … is needed".
    pub(super) fn range_text(&self) -> String {
        let (above, most) = self.range;
        let unit = match self.kind {
            Kind::Quantity(dimension) => format!(" {}", dimension.si_unit()),
            _ => String::new(),
        };
        if most.is_finite() {
            format!(
                "above {}{unit} and at most {}{unit}",
                units::number_text(above),
                units::number_text(most)
            )
        } else {
            format!("above {}{unit}", units::number_text(above))
        }
    }

    /// What the key takes, as a sentence without its full stop.
    pub(super) fn needed(&self) -> String {
        match self.kind {
            Kind::Quantity(dimension) => {
                let name = dimension.name().unwrap_or("quantity");
                format!("a quantity ({name}) is needed, e.g. \"{}\"", self.example)
            }
            Kind::Count => format!("a whole number is needed, e.g. {}", self.example),
            Kind::Ratio => format!("a number without unit is needed, e.g. {}", self.example),
            Kind::Word(words) => format!("one of these is needed: \"{}\"", words.join("\", \"")),
        }
    }
}

const POSITIVE: (f64, f64) = (0.0, f64::INFINITY);
/// Grooves wider than the ball, and not flat.
const GROOVE: (f64, f64) = (0.5, 0.7);

const fn quantity(name: &'static str, dimension: Dimension, example: &'static str) -> Key {
    Key {
        name,
        kind: Kind::Quantity(dimension),
        example,
        range: POSITIVE,
    }
}

const fn groove(name: &'static str) -> Key {
    Key {
        name,
        kind: Kind::Ratio,
        example: "0.52",
        range: GROOVE,
    }
}

/// Types of bearings that the catalogue tells apart.
pub(super) const TYPES: &[&str] = &["deep groove", "angular contact", "four-point contact"];
/// Materials of balls.
pub(super) const MATERIALS: &[&str] = &["steel", "silicon nitride"];

/// Every key, in the order of its name.
pub(super) const KEYS: &[Key] = &[
    Key {
        name: "ball_count",
        kind: Kind::Count,
        example: "10",
        range: (1.0, 60.0),
    },
    quantity("ball_diameter", Dimension::LENGTH, "6.35 mm"),
    quantity("ball_mass", Dimension::MASS, "1.05 g"),
    Key {
        name: "ball_material",
        kind: Kind::Word(MATERIALS),
        example: "steel",
        range: POSITIVE,
    },
    quantity("bore_diameter", Dimension::LENGTH, "25 mm"),
    quantity("cage_inertia", Dimension::INERTIA, "1.62e-6 kg m^2"),
    quantity("cage_mass", Dimension::MASS, "5 g"),
    Key {
        name: "contact_angle",
        kind: Kind::Quantity(Dimension::ANGLE),
        example: "15 deg",
        range: (-1e-9, std::f64::consts::FRAC_PI_3),
    },
    quantity("dynamic_load_rating", Dimension::FORCE, "11.9 kN"),
    groove("inner_groove_curvature"),
    quantity("inner_race_inertia", Dimension::INERTIA, "5.3e-6 kg m^2"),
    quantity("inner_race_mass", Dimension::MASS, "26 g"),
    quantity("inner_shoulder_diameter", Dimension::LENGTH, "32 mm"),
    quantity("limiting_speed", Dimension::ANGULAR_SPEED, "20000 rpm"),
    quantity("mass", Dimension::MASS, "0.08 kg"),
    quantity("outer_diameter", Dimension::LENGTH, "47 mm"),
    groove("outer_groove_curvature"),
    quantity("pitch_diameter", Dimension::LENGTH, "36 mm"),
    quantity("static_load_rating", Dimension::FORCE, "6.55 kN"),
    Key {
        name: "type",
        kind: Kind::Word(TYPES),
        example: "deep groove",
        range: POSITIVE,
    },
    quantity("width", Dimension::LENGTH, "12 mm"),
];

/// The key of this name.
pub(super) fn find(name: &str) -> Option<&'static Key> {
    KEYS.iter().find(|key| key.name == name)
}
