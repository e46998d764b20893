//! The part of the table of keys that describes the friction of the bearing as a whole.

use crate::bearing::moment::EquivalentLoad;
use crate::bearing::moment::LossKind;
use crate::bearing::moment::Lubricated;
use crate::bearing::moment::MomentLaw;
use crate::bearing::moment::OilKind;
use crate::key::{Condition, Key, Kind, Range, Section};
use crate::system::{SystemName, TESTED};
use problem::words::Words;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[
    Section::new("bearing.moment", "Steady friction moment of the bearing: what its inner race feels against a steady rotation; in space that of one row.", crate::system::WITH_MOMENT),
    Section {
        path: "bearing.acceleration_loss",
        doc: "Friction F of the balls in their pockets while the race accelerates, as a sum over the balls: it resists both races, with the sign of the rotation, whatever the sign of the acceleration.",
        systems: TESTED,
    },
];

const fn law(values: &'static [&'static str]) -> Condition {
    Condition::new("bearing.moment.law", values)
}

const ANY: &[&str] = &["palmgren", "palmgren printed", "skf", "measured"];
const PALMGREN: &[Condition] = &[law(&["palmgren", "palmgren printed"])];
const SKF: &[Condition] = &[law(&["skf"])];
const BY_ANGLE: &[Condition] = &[law(&["palmgren", "skf"])];
const AXIAL: &[Condition] = &[
    law(&["palmgren", "skf"]),
    Condition::new("bearing.fidelity", &["planar", "rolling"])
        .because("in space the loads of each row along the axis are computed"),
];
const MEASURED: &[Condition] = &[law(&["measured"])];
const LUBRICATED: &[Condition] = &[law(&["palmgren", "palmgren printed", "skf"])];
/// Balls that share the moment.
const SHARED: &[Condition] = &[
    law(ANY),
    Condition::new("bearing.fidelity", &["planar", "spatial"])
        .because("where the balls roll the moment acts on the races as a whole"),
];

const fn loss(values: &'static [&'static str]) -> Condition {
    Condition::new("bearing.acceleration_loss.kind", values)
}

const CONSTANT: &[Condition] = &[loss(&["constant"])];
const PROPORTIONAL: &[Condition] = &[loss(&["proportional"])];
const OVER_SPEED: &[Condition] = &[loss(&["over speed", "affine"])];
const AFFINE: &[Condition] = &[loss(&["affine"])];
const ROLLING: &[Condition] = &[Condition::new("bearing.fidelity", &["rolling"])
    .because("in the planar fidelity the pockets are computed, not given")];

/// A system without fidelities shows the share of the balls nowhere.
const MOVING: &[SystemName] = crate::system::MOVING;

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("bearing.moment.law", Kind::Word(MomentLaw::WORDS), "palmgren", "Law: palmgren, continuous and odd in speed; palmgren printed, with the steps of the source; skf, the model of the SKF catalogue; measured, a curve over speed.")
        .default("none", "no moment unless one is asked for"),
    Key::new("bearing.moment.lubrication", Kind::Word(Lubricated::WORDS), "grease", "Lubrication. A low oil bath reaches the centre of the lowest ball at most. Palmgren's tables have grease, oil mist, low oil bath and oil jet; the SKF model has all but oil mist.")
        .optional("f0 and f1 must be given, and the SKF model cannot be used").when(LUBRICATED),
    Key::new("bearing.moment.series", Kind::Text, "60", "Series of the bearing, by which factors stand in the tables.")
        .derived("from the name of a deep groove bearing: 60 of 6005, 618 of 61807").when(LUBRICATED),
    Key::new("bearing.moment.f0", Kind::Coefficient, "2", "Palmgren factor f0 of bearing type and lubrication.")
        .not_negative().derived("from the tables, by bearing type, series and lubrication").when(PALMGREN),
    Key::new("bearing.moment.f1_factor", Kind::Coefficient, "0.0009", "Factor z of the load-dependent friction f1 = z (P0/C0)^y.")
        .not_negative().derived("from the tables, by bearing type, series and lubrication").when(PALMGREN),
    Key::new("bearing.moment.f1_exponent", Kind::Coefficient, "0.55", "Exponent y of the load-dependent friction f1 = z (P0/C0)^y.")
        .not_negative().derived("from the tables, by bearing type, series and lubrication").when(PALMGREN),
    Key::new("bearing.moment.viscosity", Kind::Quantity("m^2/s"), "100 mm^2/s", "Kinematic viscosity of the lubricant at running temperature; of the base oil of a grease. Give this, or viscosity_points and temperature.")
        .positive().when(LUBRICATED),
    Key::new("bearing.moment.viscosity_points", Kind::Table("K", "m^2/s"), "[[\"40 degC\", \"100 mm^2/s\"], [\"100 degC\", \"11 mm^2/s\"]]", "Viscosity at two temperatures, as data sheets print it; between and near them it follows ASTM D341.")
        .positive().optional("bearing.moment.viscosity counts").excludes("bearing.moment.viscosity").when(LUBRICATED),
    Key::new("bearing.moment.temperature", Kind::Quantity("K"), "60 degC", "Running temperature of the lubricant, for viscosity_points.")
        .positive().optional("bearing.moment.viscosity holds as it is given").when(LUBRICATED),
    Key::new("bearing.moment.axial_load", Kind::Quantity("N"), "400 N", "Axial load that the law sees, constant; its sign has no effect. It reaches the friction moment alone: motion is computed in the plane. Where it is not given an axial preload of the bearing counts.")
        .default("0 N", "a purely radial load").when(AXIAL),
    Key::new("bearing.moment.contact_angle", Kind::Quantity("rad"), "25 deg", "Contact angle under load: it chooses P0 of Palmgren's law, and P1 in the form of Timken. Constants of tables hold for one angle; other bearings are refused.")
        .positive().optional("that of the bearing; else the middle of those that the constants are for; a deep groove bearing needs none, or is taken to have 16.7 deg").when(BY_ANGLE),
    Key::new("bearing.moment.equivalent_load", Kind::Word(EquivalentLoad::WORDS), "schaeffler", "Form of the load P1 = max(F_r, X1 F_r + Y1 F_a) of Palmgren's M1, which belongs to f1: schaeffler, by the type of the bearing; timken, 0.9 cot(contact_angle) F_a - 0.1 F_r for all, which is that of Harris too.")
        .derived("the source of f1; timken where f1 is given by hand").when(&[law(&["palmgren"])]),
    Key::new("bearing.moment.bore_diameter", Kind::Quantity("m"), "25 mm", "Bore d of the bearing itself.").positive().catalogued().when(SKF),
    Key::new("bearing.moment.outer_diameter", Kind::Quantity("m"), "47 mm", "Outer diameter D of the bearing.").positive().catalogued().when(SKF),
    Key::new("bearing.moment.oil", Kind::Word(OilKind::WORDS), "mineral", "Kind of oil, also in a grease: it decides the sliding friction of a full film.")
        .default("mineral", "the usual oil").when(SKF),
    Key::new("bearing.moment.drag_variable", Kind::Coefficient, "1e-5", "Variable V_M of the drag in an oil bath or jet, read from the diagram of the SKF catalogue.")
        .not_negative().default("0", "no drag of an oil bath or jet is computed, and the run warns").when(SKF),
    Key::new("bearing.moment.seal_moment", Kind::Quantity("N m"), "10 N mm", "Friction moment of the seals on both sides.")
        .not_negative().default("0 N m", "no contact seals").when(SKF),
    Key::new("bearing.moment.curve", Kind::Table("rad/s", "N m"), "[[\"10 rad/s\", \"14 N mm\"], [\"150 rad/s\", \"25 N mm\"]]", "Measured moment over speed: a smooth curve through the rows, constant outside them, the same in both directions.")
        .when(MEASURED),
    Key::new("bearing.moment.orbit_share", Kind::Coefficient, "0.5", "Share of the speed-dependent part that drags on the orbit of the balls; the rest drags on their spin.")
        .within(Range::FromTo(0.0, 1.0)).assumed("0.5", "no measurement separates the two").when(SHARED).only(MOVING),
    Key::new("bearing.moment.reference_spin", Kind::Quantity("rad/s"), "1 rad/s", "Speed of rolling that regularises the load-dependent part: it is multiplied by tanh(speed / reference spin).")
        .positive().default("1 rad/s", "numerical regularisation: small against the spin of balls").when(SHARED).only(MOVING),
    Key::new("bearing.moment.scale", Kind::Coefficient, "1", "Factor on the law, for example of a bearing that was measured to have a share of it.")
        .positive().default("1", "the law as it stands").when(SHARED).only(MOVING),
    Key::new("bearing.acceleration_loss.kind", Kind::Word(LossKind::WORDS), "proportional", "F: none; constant, F0; proportional, F1 times the size of the acceleration; over speed, F0 over speed; affine, F0 + F1 |acceleration|, both over speed.")
        .default("none", "no measured F is known; it is what the test rig is to find").when(ROLLING),
    Key::new("bearing.acceleration_loss.force", Kind::Quantity("N"), "0.5 N", "Constant F0.").when(CONSTANT),
    Key::new("bearing.acceleration_loss.per_acceleration", Kind::Quantity("N s^2/rad"), "1e-5 N s^2/rad", "Constant F1.").when(PROPORTIONAL),
    Key::new("bearing.acceleration_loss.force_over_speed", Kind::Table("rad/s", "N"), "[[\"0 rad/s\", \"0.2 N\"], [\"1000 rad/s\", \"0.5 N\"]]", "F0 over the size of the speed, straight between the rows and constant after the last.")
        .when(OVER_SPEED),
    Key::new("bearing.acceleration_loss.per_acceleration_over_speed", Kind::Table("rad/s", "N s^2/rad"), "[[\"0 rad/s\", \"1e-5 N s^2/rad\"], [\"1000 rad/s\", \"2e-5 N s^2/rad\"]]", "F1 over the size of the speed, straight between the rows and constant after the last.")
        .when(AFFINE),
];
