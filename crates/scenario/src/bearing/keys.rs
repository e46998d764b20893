//! The part of the table of keys that describes the rolling bearing.

use crate::bearing::Oil;
use crate::bearing::TractionLaw;
use crate::bearing::fits::Growth;
use crate::bearing::kind::BallMaterial;
use crate::bearing::kind::{Fidelity, TYPE, TYPES};
use crate::bearing::separation::SeparationKind;
use crate::key::{Condition, Fallback, Key, Kind, Otherwise, Range, Section};
use crate::system::{
    COASTING_DOWN, FALLING, FREE_RACE, MOVING, RACE_MASS, WITH_BALLS as LOADED, WITH_CAGE,
    WITH_MOMENT,
};
use problem::words::Words;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[Section::new("bearing", "The auxiliary rolling bearing at one plane. What the catalogue knows of the bearing named need not be given; what is given here counts.", crate::system::WITH_BEARING)];

/// Sections of traction and drag, behind that of the cage.
#[rustfmt::skip]
pub const TRACTION_SECTIONS: &[Section] = &[
    Section::new("bearing.traction", "Traction between balls and races: traction force over ball load, as a function of the slip speed.", MOVING),
    Section::new("bearing.drag", "Drag of balls and cage to ground. Real lubricant drags against the rings; these values exist to reproduce reference cases.", FALLING),
];

pub(crate) const STEEL_BALLS: Condition = Condition::new("bearing.ball_material", &["steel"]);

const ANGULAR: &[Condition] = &[Condition::new(
    TYPE,
    &["angular contact", "angular contact double row"],
)];

pub(crate) const CAGE: &[Condition] = &[Condition::new("bearing.separation", &["cage"])];

const fn traction(values: &'static [&'static str]) -> Condition {
    Condition::new("bearing.traction.law", values)
}

const TANH: &[Condition] = &[traction(&["tanh"])];
const FOUR_PARAMETER: &[Condition] = &[traction(&["four parameter"])];
const DRY: &[Condition] = &[traction(&["dry"])];
const LUBRICANT: &[Condition] = &[traction(&["lubricant"])];
const TANH_OR_DRY: &[Condition] = &[traction(&["tanh", "dry"])];

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("bearing.fidelity", Kind::Word(Fidelity::WORDS), "planar", "How the bearing is modelled: planar moves each ball and the cage with slip; rolling assumes pure rolling and is far faster; spatial moves balls, cages and rings in space, with contact angles and thrust, for a machine.")
        .default("planar", "slip of the balls matters while a race is brought to speed").only(MOVING),
    Key::new("bearing.name", Kind::Text, "6005", "Name in the bearing catalogue.").optional("all dimensions stand in this file"),
    Key::new(TYPE, Kind::Word(TYPES), "deep groove", "Type of the bearing: it chooses factors of the friction moment, and whether there is a contact angle. A bushing, of a drop or a machine, has no balls; its ring (mount.moving_mass) does not turn and the rotor rubs on it: no other key of [bearing] then has an effect.")
        .default("deep groove", "the usual auxiliary bearing").only(WITH_MOMENT),
    Key::new("bearing.ball_count", Kind::Count, "10", "Number of balls.").within(Range::FromTo(1.0, 60.0)).catalogued(),
    Key::new("bearing.ball_diameter", Kind::Quantity("m"), "6.35 mm", "Diameter of a ball.").positive().catalogued(),
    Key::new("bearing.pitch_diameter", Kind::Quantity("m"), "36 mm", "Diameter of the circle through the ball centres.").positive().catalogued(),
    Key::new("bearing.contact_angle", Kind::Quantity("rad"), "15 deg", "Contact angle, held by an axial preload. Motion is computed in the plane: contacts stand at the ball radius times its cosine.")
        .not_negative().catalogued().when(ANGULAR).only(MOVING),
    Key::new("bearing.axial_preload", Kind::Quantity("N"), "100 N", "Axial preload of the bearing at rest. It presses all balls and keeps the contact angle. Under load the races keep their axial distance; while they warm (heat.feedback) springs keep the preload.")
        .positive().optional("nothing keeps the contact angle, and only the radial load presses the balls").when(ANGULAR).only(MOVING),
    Key::new("bearing.operating_diametral_clearance", Kind::Quantity("m"), "5 um", "Diametral internal clearance as mounted, after fits, at rest; negative is preload.")
        .default("0 m", "neither clearance nor preload").only(LOADED),
    Key::new("bearing.unmounted_diametral_clearance", Kind::Quantity("m"), "10 um", "Diametral internal clearance before mounting; the fits of [bearing.fits] reduce it.")
        .optional("operating_diametral_clearance counts, and fits change nothing").excludes("bearing.operating_diametral_clearance").only(MOVING),
    Key::new("bearing.inner_race_growth", Kind::Word(Growth::WORDS), "none", "How the inner race grows with its speed: as a ring by itself, or together with the shaft or sleeve it is pressed on. Its radii are those of [bearing.fits], the ring's bore in a coast-down heat.bore_diameter.")
        .default("none", "a few tenths of a micrometre below 20 000 rpm in small bearings").only(LOADED),
    Key::new("bearing.inner_groove_curvature", Kind::Coefficient, "0.52", "Groove radius of the inner race over ball diameter.")
        .within(Range::Above(0.5)).assumed("0.52", "usual for deep groove ball bearings; makers differ").only(LOADED),
    Key::new("bearing.outer_groove_curvature", Kind::Coefficient, "0.53", "Groove radius of the outer race over ball diameter.")
        .within(Range::Above(0.5)).assumed("0.53", "usual for deep groove ball bearings; makers differ").only(LOADED),
    Key::new("bearing.ball_material", Kind::Word(BallMaterial::WORDS), "steel", "Material of the balls; the races are of bearing steel.")
        .default("steel", "the usual material"),
    Key::new("bearing.static_load_rating", Kind::Quantity("N"), "6.55 kN", "Static load rating C0.")
        .positive().optional("no static safety, and no friction law that needs it").only(WITH_MOMENT),
    Key::new("bearing.dynamic_load_rating", Kind::Quantity("N"), "11.9 kN", "Dynamic load rating C.")
        .positive().optional("no life is given").only(COASTING_DOWN),
    Key::new("bearing.limiting_speed", Kind::Quantity("rad/s"), "28000 rpm", "Limiting speed in continuous running. A run that exceeds it warns.")
        .positive().optional("no warning about the speed can be given").only(WITH_MOMENT),
    Key::new("bearing.inner_race_mass", Kind::Quantity("kg"), "20.4 g", "Mass of the inner race with its sleeve.").positive().catalogued().only(RACE_MASS),
    Key::new("bearing.inner_race_inertia", Kind::Quantity("kg m^2"), "3.9e-6 kg m^2", "Moment of inertia of the inner race with its sleeve, about the axis.")
        .positive().catalogued().only(MOVING),
    Key::new("bearing.separation", Kind::Word(SeparationKind::WORDS), "cage", "What keeps the balls apart: a cage, or, in a full complement, the next ball.")
        .default("cage", "full complements are the exception; their ball_count is given by the maker"),
    Key::new("bearing.cage_mass", Kind::Quantity("kg"), "5 g", "Mass of the cage.").positive().catalogued().when(CAGE),
    Key::new("bearing.cage_inertia", Kind::Quantity("kg m^2"), "1.62e-6 kg m^2", "Moment of inertia of the cage about the axis: what turns; its mass is what its centre moves.")
        .positive().derived("cage_mass (pitch_diameter/2)^2: a thin ring at the pitch circle").when(CAGE).only(WITH_CAGE),
    Key::new("bearing.ball_mass", Kind::Quantity("kg"), "1.05 g", "Mass of one ball.")
        .positive().derived("from ball_diameter and the density of ball_material"),
    Key::new("bearing.inner_contact_stiffness", Kind::Quantity("N/m^1.5"), "2.5e10 N/m^1.5", "Stiffness K of the contact of one ball with the inner race, Q = K δ^1.5.")
        .positive().derived("Hertz contact of ball and inner groove").only(MOVING),
    Key::new("bearing.outer_contact_stiffness", Kind::Quantity("N/m^1.5"), "2.2e10 N/m^1.5", "Stiffness K of the contact of one ball with the outer race, Q = K δ^1.5.")
        .positive().derived("Hertz contact of ball and outer groove").only(MOVING),
    Key::new("bearing.contact_damping_time", Kind::Quantity("s"), "2.5 us", "Retardation time β of the ball contacts, Q = K(δ^1.5 + 1.5 β δ^0.5 δ̇).")
        .not_negative().assumed("2.5 us", "not measured; weak damping of the ball contacts").only(MOVING),
    Key::new("bearing.inner_race_centre_held", Kind::Switch, "false", "Hold the centre of the inner race, which then only turns.")
        .default("false", "the inner race moves on its balls").only(FREE_RACE),
    Key::new("bearing.inner_race_torque", Kind::Quantity("N m"), "0 N m", "Torque from ground on the inner race, counter-clockwise positive.")
        .default("0 N m", "nothing but rotor and balls drives the inner race").only(FALLING),
    Key::new("bearing.first_ball_angle", Kind::Quantity("rad"), "0 deg", "Angle of the first ball at time 0, from x.")
        .default("0 rad", "the first ball lies on the x axis at time 0").only(MOVING),
    Key::new("bearing.hertz_pressure_limit", Kind::Quantity("Pa"), "4200 MPa", "Contact pressure of balls and races that results are compared with.")
        .positive().default_when(STEEL_BALLS, Fallback::convention("4200 MPa", "static limit for ball bearings of steel, ISO 76"), Otherwise::Fallback(Fallback::assumption("4200 MPa", "the steel races of a hybrid bearing dent first: the static limit for steel, ISO 76"))).only(MOVING),
];

/// Keys of traction and drag, behind those of the cage.
#[rustfmt::skip]
pub const TRACTION: &[Key] = &[
    Key::new("bearing.traction.law", Kind::Word(TractionLaw::WORDS), "tanh", "Traction law: tanh is maximum·tanh(u/reference_speed); four parameter is (A + B u)exp(-C u) + D; dry falls from static to kinetic friction; lubricant follows from the film of an oil.")
        .default("tanh", "two parameters suffice where no traction curve is measured"),
    Key::new("bearing.traction.maximum", Kind::Coefficient, "0.07", "Largest traction coefficient of the tanh law.")
        .not_negative().assumed("0.07", "order of magnitude of mineral oils").when(TANH),
    Key::new("bearing.traction.a", Kind::Coefficient, "-0.07", "A of the four parameter law.").when(FOUR_PARAMETER),
    Key::new("bearing.traction.b", Kind::Quantity("s/m"), "0.35 s/m", "B of the four parameter law.").when(FOUR_PARAMETER),
    Key::new("bearing.traction.c", Kind::Quantity("s/m"), "5 s/m", "C of the four parameter law.").positive().when(FOUR_PARAMETER),
    Key::new("bearing.traction.d", Kind::Coefficient, "0.07", "D of the four parameter law; D = -A, so that there is no traction without slip.")
        .when(FOUR_PARAMETER),
    Key::new("bearing.traction.kinetic", Kind::Coefficient, "0.1", "Friction coefficient of the dry law at high slip.").not_negative().when(DRY),
    Key::new("bearing.traction.static", Kind::Coefficient, "0.15", "Friction coefficient of the dry law at small slip.").not_negative().when(DRY),
    Key::new("bearing.traction.decay_speed", Kind::Quantity("m/s"), "0.5 m/s", "Slip speed over which the dry law falls from static to kinetic.")
        .positive().when(DRY),
    Key::new("bearing.traction.reference_speed", Kind::Quantity("m/s"), "0.1 m/s", "Slip speed that regularises the tanh and dry laws.")
        .positive().default("0.1 m/s", "numerical regularisation; it stands for the slope of a traction curve").when(TANH_OR_DRY),
    Key::new("bearing.traction.oil", Kind::Word(Oil::WORDS), "FVA 3", "Oil between balls and races: one whose viscosity under pressure was measured. FVA 3 is a paraffinic mineral oil, N100 a naphthenic one, PAO100 a polyalphaolefin; all ISO VG 100.")
        .when(LUBRICANT),
    Key::new("bearing.traction.oil_temperature", Kind::Quantity("K"), "60 degC", "Temperature of the oil where it enters the contacts, constant; data of the oils serve from 25 to 100 degC.")
        .positive().when(LUBRICANT),
    Key::new("bearing.traction.oil_conductivity", Kind::Quantity("W/(m K)"), "0.134 W/(m K)", "Thermal conductivity of the oil. None is published with N100 and PAO100, which need it.")
        .positive().optional("the one published with the oil").when(LUBRICANT),
    Key::new("bearing.traction.composite_roughness", Kind::Quantity("m"), "0.1 um", "Root of the sum of squares of the rms roughnesses of ball and race.")
        .positive().assumed("0.1 um", "order of magnitude of ground raceways and balls").when(LUBRICANT),
    Key::new("bearing.traction.boundary_friction_coefficient", Kind::Coefficient, "0.12", "Friction coefficient of the asperities, on the share of the load that they carry.")
        .positive().assumed("0.12", "0.12 to 0.135 were measured (Masjedi and Khonsari, quoted by Arana et al. 2019)").when(LUBRICANT),
    Key::new("bearing.traction.boundary_reference_speed", Kind::Quantity("m/s"), "0.001 m/s", "Slip speed that regularises boundary friction and the film's limiting friction where rolling is slow.")
        .positive().default("0.001 m/s", "numerical regularisation: rolling at 1 m/s and more hardly feels it").when(LUBRICANT),
    Key::new("bearing.traction.supply", Kind::Coefficient, "1.0", "Share of the flooded film thickness that starvation leaves.")
        .within(Range::FromTo(0.001, 1.0)).assumed("1.0", "fully flooded; little oil or grease leaves less").when(LUBRICANT),
    Key::new("bearing.drag.orbit", Kind::Quantity("N s/m"), "2e-4 N s/m", "Drag force on a ball over its orbital speed.")
        .not_negative().default("0 N s/m", "drag to ground is not physical"),
    Key::new("bearing.drag.spin", Kind::Quantity("N m s"), "1e-9 N m s", "Drag torque on a ball over its spin.")
        .not_negative().default("0 N m s", "drag to ground is not physical"),
    Key::new("bearing.drag.cage", Kind::Quantity("N m s"), "1e-7 N m s", "Drag torque on the cage over its speed.")
        .not_negative().default("0 N m s", "drag to ground is not physical"),
];
