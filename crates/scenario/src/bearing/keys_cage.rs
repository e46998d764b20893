//! The part of the table of keys that describes what keeps the balls apart, and how the rings sit.

use crate::bearing::keys::{CAGE, STEEL_BALLS};
use crate::bearing::separation::GuidanceKind;
use crate::key::{Condition, Fallback, Key, Kind, Otherwise, Section};
use crate::system::{MOVING, WITH_BALLS};
use problem::words::Words;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[
    Section::new("bearing.fits", "How the rings sit on shaft and in housing. The rings are taken as wide as their seats, shaft and housing of bearing steel.", WITH_BALLS),
    Section::new("bearing.cage", "The cage: its pockets, and what guides it.", MOVING),
    Section::new("bearing.full_complement", "Balls that touch their neighbours, without a cage.", MOVING),
];

const FULL_COMPLEMENT: &[Condition] = &[Condition::new("bearing.separation", &["full complement"])];

const LAND: &[Condition] = &[Condition::new(
    "bearing.cage.guidance",
    &["inner land", "outer land"],
)];

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("bearing.fits.bore_diameter", Kind::Quantity("m"), "25 mm", "Bore of the inner ring.")
        .positive().optional("needed where the shaft presses the ring, or the ring grows").only(MOVING),
    Key::new("bearing.fits.shaft_interference", Kind::Quantity("m"), "12 um", "Diametral interference of shaft or sleeve in the inner ring; negative is loose.")
        .default("0 m", "no fit presses the ring").only(MOVING),
    Key::new("bearing.fits.shaft_bore_diameter", Kind::Quantity("m"), "0 mm", "Bore of a hollow shaft, or of the sleeve.")
        .not_negative().default("0 m", "a solid shaft"),
    Key::new("bearing.fits.outer_diameter", Kind::Quantity("m"), "47 mm", "Outside diameter of the outer ring.")
        .positive().optional("needed where the housing presses the ring").only(MOVING),
    Key::new("bearing.fits.housing_interference", Kind::Quantity("m"), "0 um", "Diametral interference of the outer ring in its housing; negative is loose.")
        .default("0 m", "no fit presses the ring").only(MOVING),
    Key::new("bearing.fits.housing_outer_diameter", Kind::Quantity("m"), "80 mm", "Outside diameter of the housing as a ring.")
        .positive().optional("needed where the housing presses the ring").only(MOVING),
    Key::new("bearing.cage.pocket_contact", Kind::Switch, "true", "Whether balls and cage touch at all.")
        .default("true", "balls drive the cage by its pockets").when(CAGE),
    Key::new("bearing.cage.pocket_gap", Kind::Quantity("m"), "0.1 mm", "Gap between ball and pocket on one side, along the pitch circle.")
        .not_negative().assumed("0.1 mm", "order of magnitude of small bearings").when(CAGE),
    Key::new("bearing.cage.pocket_stiffness", Kind::Quantity("N/m"), "1e7 N/m", "Stiffness of the contact of a ball with its pocket.")
        .positive().assumed("1e7 N/m", "order of magnitude; cage materials differ widely").when(CAGE),
    Key::new("bearing.cage.pocket_damping", Kind::Quantity("s/m"), "0.5 s/m", "Hunt-Crossley damping of the pocket contact.")
        .not_negative().assumed("0.5 s/m", "not measured").when(CAGE),
    Key::new("bearing.cage.pocket_friction_coefficient", Kind::Coefficient, "0.05", "Coefficient of friction of a ball in its pocket.")
        .not_negative().assumed("0.05", "lubricated sliding; not measured").when(CAGE),
    Key::new("bearing.cage.pocket_friction_reference_speed", Kind::Quantity("m/s"), "0.1 m/s", "Slip speed that regularises the pocket friction.")
        .positive().default("0.1 m/s", "numerical regularisation: small against the surface speed of a ball").when(CAGE),
    Key::new("bearing.cage.guidance", Kind::Word(GuidanceKind::WORDS), "centred", "What guides the cage: centred, its centre is that of the outer race and its mass moves with it; balls, its pockets alone; a land of the inner or outer ring.")
        .default("centred", "the simplest; a cage free to move makes little difference to the rotor, and much to its own forces").when(CAGE),
    Key::new("bearing.cage.land_radial_clearance", Kind::Quantity("m"), "0.15 mm", "Radial clearance between cage and land.").positive().when(LAND),
    Key::new("bearing.cage.land_diameter", Kind::Quantity("m"), "40.1 mm", "Diameter of the ring's land that guides the cage.")
        .positive().derived("pitch_diameter -/+ 0.65 ball_diameter on the inner/outer ring: a usual shoulder, assumed").when(LAND),
    Key::new("bearing.cage.land_stiffness", Kind::Quantity("N/m"), "1e7 N/m", "Stiffness of the contact of cage and land.")
        .positive().assumed("1e7 N/m", "as the pockets; cage materials differ widely").when(LAND),
    Key::new("bearing.cage.land_damping", Kind::Quantity("s/m"), "0.5 s/m", "Hunt-Crossley damping of the contact of cage and land.")
        .not_negative().assumed("0.5 s/m", "as the pockets; not measured").when(LAND),
    Key::new("bearing.cage.land_friction_coefficient", Kind::Coefficient, "0.05", "Coefficient of friction of the cage on its land.")
        .not_negative().assumed("0.05", "lubricated sliding; not measured").when(LAND),
    Key::new("bearing.cage.land_friction_reference_speed", Kind::Quantity("m/s"), "0.1 m/s", "Slip speed that regularises the friction of the land.")
        .positive().default("0.1 m/s", "numerical regularisation: small against the surface speed of a cage").when(LAND),
    Key::new("bearing.full_complement.friction_coefficient", Kind::Coefficient, "0.1", "Coefficient of friction between neighbouring balls.")
        .not_negative().assumed("0.1", "boundary lubrication: their surfaces run against each other").when(FULL_COMPLEMENT),
    Key::new("bearing.full_complement.friction_reference_speed", Kind::Quantity("m/s"), "0.1 m/s", "Slip speed that regularises the friction between balls.")
        .positive().default("0.1 m/s", "numerical regularisation: small against the surface speed of a ball").when(FULL_COMPLEMENT),
    Key::new("bearing.full_complement.hertz_pressure_limit", Kind::Quantity("Pa"), "4200 MPa", "Contact pressure of neighbouring balls that results are compared with.")
        .positive().default_when(STEEL_BALLS, Fallback::assumption("4200 MPa", "balls of the steel that the static limit for ball bearings holds for"), Otherwise::Fallback(Fallback::assumption("4400 MPa", "ceramic balls crack in rings where the tension at the rim, (1 - 2ν)/3 of the pressure, reaches their bending strength: 700 MPa, from memory"))).when(FULL_COMPLEMENT),
];
