//! Keys of a mount: spring and damper, and what else stands between outer race and ground.

use crate::key::{Key, Kind, Range};
use crate::system::MACHINE;

/// Key of the housing on which a mount stands.
pub(crate) const ON: &str = "mount.on";

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("mount.stiffness", Kind::Quantity("N/m"), "2e7 N/m", "Radial stiffness between outer race and ground.").positive(),
    Key::new("mount.damping", Kind::Quantity("N s/m"), "5000 N s/m", "Radial damping between outer race and ground.").not_negative(),
    Key::new("mount.moving_mass", Kind::Quantity("kg"), "0.15 kg", "Mass that moves with the outer race: the race itself and its housing or sleeve.")
        .positive(),
    Key::new("mount.axial_stiffness", Kind::Quantity("N/m"), "2e7 N/m", "Stiffness between outer rings and ground along the axis.")
        .positive().optional("as mount.stiffness").only(MACHINE),
    Key::new("mount.axial_damping", Kind::Quantity("N s/m"), "2000 N s/m", "Damping along the axis.")
        .not_negative().optional("as mount.damping").only(MACHINE),
    Key::new("mount.tilt_stiffness", Kind::Quantity("N m/rad"), "2e4 N m/rad", "Stiffness between outer rings and ground against tilt about an axis across.")
        .positive().optional("the outer rings keep their orientation").only(MACHINE),
    Key::new("mount.tilt_damping", Kind::Quantity("N m s/rad"), "5 N m s/rad", "Damping of their rotation, about any axis.")
        .not_negative().optional("0 N m s/rad: no loss but in balls and cages").beside(&["tilt_stiffness"]).only(MACHINE),
    Key::new("mount.torsion_stiffness", Kind::Quantity("N m/rad"), "2e4 N m/rad", "Stiffness against their rotation about the axis.")
        .positive().optional("as mount.tilt_stiffness").beside(&["tilt_stiffness"]).only(MACHINE),
    Key::new("mount.tilt_inertia", Kind::Quantity("kg m^2"), "2e-4 kg m^2", "Inertia of mount.moving_mass about an axis across; about the bearing's axis it has twice as much.")
        .positive().optional("that of a thin ring as large as the middle of the outer rings").beside(&["tilt_stiffness"]).only(MACHINE),
    Key::new("mount.branch_stiffness", Kind::Series("N/m"), "[\"8e6 N/m\", \"4e6 N/m\"]", "Stiffness of each Maxwell branch, a spring and a damper in series beside spring and damper: an O-ring, whose stiffness rises with frequency.")
        .not_negative().optional("none: stiffness does not depend on frequency"),
    Key::new("mount.branch_time", Kind::Series("s"), "[\"0.3 ms\", \"0.03 ms\"]", "Relaxation time of each Maxwell branch.")
        .positive().optional("no Maxwell branches"),
    Key::new("mount.ring_stiffness", Kind::Quantity("N/m"), "2e7 N/m", "Stiffness of a friction (tolerance) ring before it slips.")
        .positive().optional("no friction ring"),
    Key::new("mount.ring_travel", Kind::Quantity("m"), "10 um", "Travel at which the friction ring slips; the slip force is mount.ring_stiffness times this.")
        .positive().optional("no friction ring"),
    Key::new("mount.ring_exponent", Kind::Coefficient, "8", "How sharply the friction ring begins to slip: 2 is soft, large is dry friction with a spring in series.")
        .within(Range::FromTo(2.0, 100.0)).optional("8: smaller ones creep under small vibration about a load"),
    Key::new("mount.film_viscosity", Kind::Quantity("Pa s"), "0.02 Pa s", "Viscosity of a squeeze film around the outer race.")
        .positive().optional("no squeeze film"),
    Key::new("mount.film_radius", Kind::Quantity("m"), "30 mm", "Radius of the squeeze film.").positive().optional("no squeeze film"),
    Key::new("mount.film_length", Kind::Quantity("m"), "10 mm", "Length of the squeeze film, between open ends.").positive().optional("no squeeze film"),
    Key::new("mount.film_clearance", Kind::Quantity("m"), "0.1 mm", "Radial clearance of the squeeze film.").positive().optional("no squeeze film"),
    Key::new("mount.film_flooded", Kind::Switch, "false", "Whether the half of the squeeze film that opens pulls as the other pushes: false where it cavitates, with ambient pressure at its ends.")
        .optional("false: it cavitates"),
    Key::new("mount.stop_gap", Kind::Quantity("m"), "50 um", "Radial gap of a hard stop around the outer race.").not_negative().optional("no hard stop"),
    Key::new("mount.stop_stiffness", Kind::Quantity("N/m"), "1e9 N/m", "Stiffness of the hard stop.").positive().optional("no hard stop"),
    Key::new("mount.stop_damping", Kind::Quantity("s/m"), "0.5 s/m", "Hunt-Crossley damping a of the stop's force F = k d(1 + a ḋ).")
        .not_negative().optional("0.5 s/m, as of contact.damping"),
    Key::new(ON, Kind::Text, "casing", "Name of the [[rotor.housing]] on which the mount stands, which other bearings and magnets may share.")
        .optional("the mount stands on ground, or on mount.housing_mass").only(MACHINE),
    Key::new("mount.housing_mass", Kind::Quantity("kg"), "20 kg", "Mass of a housing that yields, under the mount.")
        .positive().optional("the mount stands on ground").excludes(ON),
    Key::new("mount.housing_stiffness", Kind::Quantity("N/m"), "1e8 N/m", "Stiffness between that housing and ground.")
        .positive().optional("the mount stands on ground").excludes(ON),
    Key::new("mount.housing_damping", Kind::Quantity("N s/m"), "1e4 N s/m", "Damping between that housing and ground.")
        .not_negative().optional("0 N s/m: no loss but in the mount").excludes(ON),
];
