//! What the catalogue knows of a bearing: the keys, their kinds and ranges.

use problem::key::Kind::{Coefficient, Count, Quantity, Word};
use problem::key::Range;

/// One key of a bearing.
pub(super) type Key = problem::key::Key;

/// Types of bearings that the catalogue tells apart.
pub(super) const TYPES: &[&str] = &["deep groove", "angular contact", "four-point contact"];
/// Materials of balls.
pub(super) const MATERIALS: &[&str] = &["steel", "silicon nitride"];
/// Grooves wider than the ball, and not flat.
const GROOVE: Range = Range::AboveTo(0.5, 0.7);
const ANGLE: Range = Range::FromTo(0.0, std::f64::consts::FRAC_PI_3);

/// Every key, in the order of its name.
#[rustfmt::skip]
pub(super) const KEYS: &[Key] = &[
    Key::new("ball_count", Count, "10", "Number of balls.").within(Range::FromTo(2.0, 60.0)),
    Key::new("ball_diameter", Quantity("m"), "6.35 mm", "Diameter of a ball.").positive(),
    Key::new("ball_mass", Quantity("kg"), "1.05 g", "Mass of a ball.").positive(),
    Key::new("ball_material", Word(MATERIALS), "steel", "Material of the balls."),
    Key::new("bore_diameter", Quantity("m"), "25 mm", "Bore of the inner ring.").positive(),
    Key::new("cage_inertia", Quantity("kg m^2"), "1.62e-6 kg m^2", "Inertia of the cage about its axis.").positive(),
    Key::new("cage_mass", Quantity("kg"), "5 g", "Mass of the cage.").positive(),
    Key::new("contact_angle", Quantity("rad"), "15 deg", "Nominal contact angle.").within(ANGLE),
    Key::new("dynamic_load_rating", Quantity("N"), "11.9 kN", "C, of fatigue.").positive(),
    Key::new("inner_groove_curvature", Coefficient, "0.52", "Groove radius of the inner race over ball diameter.").within(GROOVE),
    Key::new("inner_race_inertia", Quantity("kg m^2"), "5.3e-6 kg m^2", "Inertia of the bare inner ring about its axis.").positive(),
    Key::new("inner_race_mass", Quantity("kg"), "26 g", "Mass of the bare inner ring.").positive(),
    Key::new("inner_shoulder_diameter", Quantity("m"), "32 mm", "Diameter of the shoulder of the inner ring.").positive(),
    Key::new("limiting_speed", Quantity("rad/s"), "20000 rpm", "Largest speed in continuous running.").positive(),
    Key::new("mass", Quantity("kg"), "0.08 kg", "Mass of the bearing.").positive(),
    Key::new("outer_diameter", Quantity("m"), "47 mm", "Outside diameter.").positive(),
    Key::new("outer_groove_curvature", Coefficient, "0.52", "Groove radius of the outer race over ball diameter.").within(GROOVE),
    Key::new("pitch_diameter", Quantity("m"), "36 mm", "Diameter of the circle of ball centres.").positive(),
    Key::new("static_load_rating", Quantity("N"), "6.55 kN", "C0, of dents.").positive(),
    Key::new("type", Word(TYPES), "deep groove", "Type of the bearing."),
    Key::new("width", Quantity("m"), "12 mm", "Width.").positive(),
];

/// The key of this name.
pub(super) fn find(name: &str) -> Option<&'static Key> {
    KEYS.iter().find(|key| key.path == name)
}
