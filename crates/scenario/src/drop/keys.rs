//! The part of the table of keys that describes the drop of a levitated rotor.

use crate::drop::kinds::{SpinKind, UnbalanceAngle};
use crate::key::{Condition, Fallback, Key, Kind, LANDING_FRICTION, Otherwise, Range, Section};
use crate::system::{DROP, FALLING, IN_GAS, LEVITATED, MACHINE, RIGID, SHAFT, WITH_ROTOR};
use problem::words::Words;

#[rustfmt::skip]
pub(crate) const SECTIONS: &[Section] = &[
    Section {
        path: "rotor",
        doc: "The rotor. Angles and speeds count counter-clockwise, x points right and y up.",
        systems: WITH_ROTOR,
    },
    Section::new("gravity", "Weight of the rotor.", FALLING),
    Section {
        path: "levitation",
        doc: "The magnetic bearing. Of a drop, at one plane while it is on: a linear spring and damper that also carries the weight, switched off at time 0. Of a flexible rotor: its magnets, sensors and controllers.",
        systems: LEVITATED,
    },
    Section::new("contact", "Contact of the rotor with the bore of the inner race.", FALLING),
    Section::new("contact.surface", "Metal below the landing surfaces of rotor and inner race. Where contact.width is given, a run tells how hot they become; its motion follows nothing of it.", FALLING),
    Section::new("mount", "The spring and damper between outer race and ground, equal in all directions.", FALLING),
];

/// Repetition stands at the end of a file.
#[rustfmt::skip]
pub const REPEAT_SECTIONS: &[Section] = &[Section::new("repeat", "Repeated runs from slightly different starts: what differs between them is chaos, not physics. With deviations of the machine they show what its tolerances do.", FALLING)];

const BRAKED: Condition = Condition {
    path: "rotor.spin",
    values: &["braked"],
    reason: "",
};

const TURNS: Condition = Condition {
    path: "rotor.spin",
    values: &["free", "braked"],
    reason: "a spin that is held feels no other torque",
};

const fn start(path: &'static str, kind: Kind, example: &'static str, doc: &'static str) -> Key {
    Key::new(path, kind, example, doc)
        .optional("its steady motion")
        .only(FALLING)
}

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("rotor.mass", Kind::Quantity("kg"), "8 kg", "Mass of the whole rotor.").positive().only(RIGID),
    Key::new("rotor.polar_inertia", Kind::Quantity("kg m^2"), "0.01 kg m^2", "Moment of inertia of the whole rotor about its axis.")
        .positive().only(RIGID),
    Key::new("rotor.unbalance", Kind::Quantity("kg m"), "40 g mm", "Unbalance of the whole rotor: mass times eccentricity. Give this or the eccentricity.")
        .not_negative().optional("rotor.unbalance_eccentricity counts").excludes("rotor.unbalance_eccentricity").only(DROP),
    Key::new("rotor.unbalance_eccentricity", Kind::Quantity("m"), "5 um", "Distance of the centre of mass from the geometric centre.")
        .not_negative().default("0 m", "a balanced rotor").only(DROP),
    Key::new("rotor.unbalance_angle", Kind::Quantity("rad"), "30 deg", "Direction of the unbalance at the release, from x.")
        .default("0 rad", "the unbalance points along x at the release").only(FALLING),
    Key::new("rotor.speed", Kind::Quantity("rad/s"), "12000 rpm", "Spin of the rotor, at the release or as rated; the sign is the direction, counter-clockwise positive."),
    start("rotor.start_x", Kind::Quantity("m"), "0.1 mm", "Displacement of the whole rotor along x at the start, from its steady motion: of one that starts where nothing holds it."),
    start("rotor.start_y", Kind::Quantity("m"), "-0.1 mm", "The same along y."),
    start("rotor.start_speed_x", Kind::Quantity("m/s"), "20 mm/s", "Velocity of the whole rotor along x at the start, besides that of its steady motion: a blow."),
    start("rotor.start_speed_y", Kind::Quantity("m/s"), "20 mm/s", "The same along y."),
    Key::new("rotor.spin", Kind::Word(SpinKind::WORDS), "free", "What happens to the spin after the release: free, braked by a torque, or held at its speed by a drive.")
        .default("free", "neither drive nor brake acts after the release").only(FALLING),
    Key::new("rotor.brake_torque", Kind::Quantity("N m"), "2 N m", "Size of the braking torque; it acts against the spin until the rotor stands.")
        .not_negative().when(&[BRAKED]).only(FALLING),
    Key::new("rotor.brake_start", Kind::Quantity("s"), "0.1 s", "Time from the release to the start of braking.")
        .not_negative().default("0 s", "braking starts at the release").when(&[BRAKED]).only(FALLING),
    Key::new("rotor.drive_torque", Kind::Quantity("N m"), "2 N m", "Torque of a drive that stays on: this less rotor.drive_slope times the speed. A run-up through a critical speed needs one.")
        .not_negative().default("0 N m", "the drive is off when the magnets are lost").only(MACHINE),
    Key::new("rotor.drive_slope", Kind::Quantity("N m s"), "1e-3 N m s", "Fall of the drive's torque with speed.")
        .not_negative().default("0 N m s", "a drive of constant torque").only(MACHINE),
    Key::new("rotor.drag", Kind::Quantity("N m s"), "1e-4 N m s", "Drag on the spin that grows with it: the torque is this times the speed.")
        .not_negative().default("0 N m s", "a rotor in vacuum").only(MACHINE),
    Key::new("rotor.windage", Kind::Quantity("N m s^2"), "1e-8 N m s^2", "Drag on the spin that grows with its square, as of gas about the rotor.")
        .not_negative().default("0 N m s^2", "a rotor in vacuum").only(IN_GAS),
    Key::new("rotor.torque_over_speed", Kind::Table("rad/s", "N m"), "[[\"0 rpm\", \"-0.1 N m\"], [\"30000 rpm\", \"-8 N m\"]]", "Torque of a drive or a load over the size of the speed, straight between the rows and constant beyond them. Above 0 it drives in the sense of positive speeds; below 0 it brakes, whatever the sense, and fades out below 1 rad/s.")
        .when(&[TURNS]).optional("no torque besides those of the other keys").only(FALLING),
    Key::new("rotor.torque_share_over_time", Kind::Table("s", "1"), "[[\"0 s\", 1.0], [\"0.5 s\", 0.2]]", "Share of rotor.torque_over_speed that acts, over the time from the start of the run: of a drive that fades, or of a gas whose pressure falls after the trip. Straight between the rows and constant beyond them.")
        .not_negative().when(&[TURNS]).optional("all of rotor.torque_over_speed acts").only(FALLING),
    Key::new("rotor.cutoff", Kind::Quantity("rad/s"), "60000 rad/s", "Modes of the free rotor up to this frequency are coordinates of the run, with the residual flexibility at each place that carries something.")
        .positive().derived("60000 rad/s; at screening accuracy ten times the speed or the first bending mode, at least 20000 and at most 60000 rad/s").only(MACHINE),
    Key::new("rotor.cutoff_check", Kind::Quantity("s"), "20 ms", "The drop until then is run twice more, as it is and with twice rotor.cutoff: the change of first impacts and displacements on doubling is given, which is no bound of their error.")
        .positive().optional("what the modes left out would change is not told").only(MACHINE),
    Key::new("rotor.planes", Kind::Count, "2", "Number of identical auxiliary bearings that share the rotor. The motion is taken as parallel, so one of them is simulated, which counts so many times. Pairs at two places are 4 bearings, each with half of the mount of its place. Bearings with names have planes of their own.")
        .within(Range::FromTo(1.0, 4.0)).default("1", "one auxiliary bearing carries the whole rotor").only(RIGID),
    Key::new("rotor.first_bending_frequency", Kind::Quantity("rad/s"), "655 rad/s", "First free-free bending natural frequency at rest. A run whose speed is near or above it warns that a rigid rotor is indicative only.")
        .positive().optional("no warning about bending can be given").only(DROP),
    Key::new("rotor.longest_element", Kind::Quantity("m"), "20 mm", "Longest element that a section is divided into, where the section does not give their number. Frequencies converge with its square.")
        .positive().derived("a fortieth of the shaft").only(SHAFT),
    Key::new("rotor.damping_of_mass", Kind::Quantity("1/s"), "2.5 1/s", "Damping of the shaft that does not turn with it, as a multiple of the mass matrix of its elements; disks have none.")
        .not_negative().default("0 1/s", "shafts in air have none to speak of").only(SHAFT),
    Key::new("rotor.damping_of_stiffness", Kind::Quantity("s"), "1 us", "The same as a multiple of the stiffness matrix of its elements.")
        .not_negative().default("0 s", "damping of the material turns with the shaft").only(SHAFT),
    Key::new("rotor.damping_rotating", Kind::Quantity("s"), "1 us", "Damping of material and shrink fits, which turns with the shaft, as a multiple of the stiffness matrix of its elements. Above a critical speed it drives whirl.")
        .not_negative().default("0 s", "a shaft of one piece has little; a built-up one must be judged").only(SHAFT),
    Key { prefix: Some(("G", "mm/s")), ..Key::new("rotor.balance_grade", Kind::Quantity("m/s"), "2.5 mm/s", "Balance quality grade G of ISO 21940-11, \"G2.5\" or \"2.5 mm/s\": the residual unbalance G m/rotor.speed stands in rotor.balance_planes; without these all amounts of [[rotor.unbalance]] are scaled by one factor until their sum is this.")
        .positive().optional("the amounts of [[rotor.unbalance]] count as they are").only(SHAFT) },
    Key::new("rotor.balance_planes", Kind::Texts, "[\"drive_end\", \"other_end\"]", "Names of the two [[rotor.node]] in whose planes rotor.balance_grade leaves residual unbalance: shares by the levers of the mass centre, angles on the rotor drawn from repeat.seed.")
        .optional("rotor.balance_grade scales the amounts of [[rotor.unbalance]]").only(SHAFT),
    Key::new("rotor.axial_clearance", Kind::Quantity("m"), "0.4 mm", "How far the rotor may move along its axis, to either side, until something besides its bearings stops it: an axial magnet, an impeller, a labyrinth. It needs a bearing with bearing.fidelity = \"spatial\".")
        .positive().optional("whether the rotor strikes something along its axis is not judged").only(MACHINE),
    Key::new("gravity.acceleration", Kind::Quantity("m/s^2"), "9.81 m/s^2", "Acceleration of gravity in the plane of the bearing. Of an inclined shaft less is left of it, of a vertical one nothing: the rest is gravity.axial, without which the axial drop is not described and a run warns.")
        .not_negative().default("9.81 m/s^2", "usual rounded value near sea level"),
    Key::new("gravity.direction", Kind::Quantity("rad"), "-90 deg", "Direction of gravity, from x.").default("-90 deg", "downwards"),
    Key::new("gravity.axial", Kind::Quantity("m/s^2"), "-9.81 m/s^2", "Acceleration of gravity along the shaft, positive towards its end. It needs a bearing with bearing.fidelity = \"spatial\" that carries it.")
        .default("0 m/s^2", "a horizontal shaft").only(MACHINE),
    Key::new("levitation.stiffness", Kind::Quantity("N/m"), "1e6 N/m", "Stiffness of the levitation at one plane.").positive().only(DROP),
    Key::new("levitation.damping", Kind::Quantity("N s/m"), "1000 N s/m", "Damping of the levitation at one plane.").not_negative().only(DROP),
    Key::new("levitation.decay_time", Kind::Quantity("s"), "5 ms", "Time in which the currents of all magnets, that of the bias too, decay to 1/e after the loss of power.")
        .not_negative().default("0 s", "the currents are gone at once").only(MACHINE),
    Key::new("levitation.power_lost_at", Kind::Quantity("s"), "0.3 s", "Instant at which all magnets lose their power. Until then sensors, controllers and amplifiers act in time, with their limits; later than run.duration: they hold the rotor to the end.")
        .not_negative().default("0 s", "at the start, from the steady motion of the levitated rotor").only(MACHINE),
    Key::new("levitation.offset_x", Kind::Quantity("m"), "0.02 mm", "Centre of levitation from the centre of the auxiliary bearing, along x.")
        .default("0 m", "levitated in the centre of the auxiliary bearing").only(DROP),
    Key::new("levitation.offset_y", Kind::Quantity("m"), "-0.02 mm", "Centre of levitation from the centre of the auxiliary bearing, along y.")
        .default("0 m", "levitated in the centre of the auxiliary bearing").only(DROP),
    Key::new("levitation.axial_stiffness", Kind::Quantity("N/m"), "1e6 N/m", "Stiffness of the axial magnet until all radial magnets lose their power; it carries the weight along the shaft besides.")
        .not_negative().optional("nothing holds the rotor along its axis from the start on").only(MACHINE),
    Key::new("levitation.axial_damping", Kind::Quantity("N s/m"), "1000 N s/m", "Damping of the axial magnet.")
        .not_negative().optional("0 N s/m: the magnet has a spring alone").only(MACHINE),
    Key::new("contact.radial_air_clearance", Kind::Quantity("m"), "0.25 mm", "Radial air gap between rotor and inner race when they are concentric: half the difference of the diameters.")
        .positive(),
    Key::new("contact.bore_diameter", Kind::Quantity("m"), "25 mm", "Diameter of the bore that the rotor drops into: of the inner race or of the sleeve in it.")
        .positive().catalogued(),
    Key::new("contact.width", Kind::Quantity("m"), "10 mm", "Axial width of the landing surface: that of the sleeve or of the inner race, whichever the rotor touches.")
        .positive().optional("neither temperatures nor friction work per area of the landing surface are given"),
    Key::new("contact.node", Kind::Text, "drive_end", "Name of the [[rotor.node]] at which the bearing stands.").only(MACHINE),
    Key::new("contact.misalignment_x", Kind::Quantity("m"), "0.02 mm", "Centre of the bearing from the line about which the rotor is levitated, along x.")
        .default("0 m", "the bearing stands on the line of levitation").only(MACHINE),
    Key::new("contact.misalignment_y", Kind::Quantity("m"), "-0.02 mm", "The same along y.")
        .default("0 m", "the bearing stands on the line of levitation").only(MACHINE),
    Key::new("contact.exponent", Kind::Exponent, "10/9", "Exponent n of the contact force F = k dⁿ(1 + a ḋ) over the penetration d.")
        .within(Range::FromTo(1.0, 2.0)).assumed("10/9", "flat line contact of two cylinders; a journal in a bore is conformal"),
    Key::new("contact.stiffness", Kind::ContactStiffness { exponent: "contact.exponent", }, "5e8 N/m^(10/9)", "Stiffness k of the contact force F = k dⁿ(1 + a ḋ).")
        .positive().default_when(Condition { path: "contact.exponent", values: &["10/9"], reason: "", }, Fallback::assumption("5e8 N/m^(10/9)", "order of magnitude of a hard steel contact, not derived from the geometry"), Otherwise::Required),
    Key::new("contact.damping", Kind::Quantity("s/m"), "0.5 s/m", "Hunt-Crossley damping a of the contact force F = k dⁿ(1 + a ḋ).")
        .not_negative().assumed("0.5 s/m", "not measured; small impact loss of hard steel"),
    Key::new("contact.friction_coefficient", Kind::Coefficient, "0.15", "Coefficient of sliding friction between rotor and inner race.")
        .within(LANDING_FRICTION).assumed("0.15", "arbitrary; it decides the spin-up time, so give the value of the pair"),
    Key::new("contact.friction_over_temperature", Kind::Table("K", "1"), "[[\"20 degC\", 0.15], [\"300 degC\", 0.25]]", "Friction coefficient of rotor and inner race over the temperature of their contact, straight between the rows and constant beyond them. Its shape counts: at the start it is contact.friction_coefficient. It needs contact.width and heat.network = \"on\", by which the contact's temperature is known.")
        .positive().optional("contact.friction_coefficient holds at every temperature: nothing general is published for landing surfaces"),
    Key::new("contact.friction_reference_speed", Kind::Quantity("m/s"), "0.05 m/s", "Slip speed that regularises the friction: its coefficient is multiplied by tanh(slip speed / reference speed).")
        .positive().default("0.05 m/s", "numerical regularisation: small against the sliding speeds of a drop"),
    Key::new("contact.gap_to_end", Kind::Quantity("m"), "0.2 mm", "Axial gap between a shoulder of the rotor and a face of the inner ring that closes when the rotor moves towards the end of the shaft.")
        .positive().optional("no shoulder stops the rotor on its way to the end of the shaft").only(MACHINE),
    Key::new("contact.gap_to_start", Kind::Quantity("m"), "0.2 mm", "The same when it moves towards the start of the shaft.")
        .positive().optional("no shoulder stops the rotor on its way to the start of the shaft").only(MACHINE),
    Key::new("contact.face_radius", Kind::Quantity("m"), "15 mm", "Mean radius of the faces that meet the shoulders.")
        .positive().optional("midway between the bore and the bottom of the inner groove").only(MACHINE),
    Key::new("contact.face_width", Kind::Quantity("m"), "3 mm", "Radial width of the annulus in which shoulder and face touch: their mean temperature follows it.")
        .positive().optional("twice the distance of contact.face_radius from the bore").only(MACHINE),
    Key::new("contact.face_stiffness", Kind::Quantity("N/m"), "2e8 N/m", "Stiffness of a whole face against its shoulder; damping and friction are those of the bore.")
        .positive().optional("2e8 N/m: order of magnitude of a flat steel face").only(MACHINE),
];

#[rustfmt::skip]
pub(crate) const REPEAT: &[Key] = &[
    Key::new("repeat.count", Kind::Count, "16", "Number of runs; the first is the undisturbed one.")
        .within(Range::FromTo(1.0, 100_000.0)).default("1", "one undisturbed run"),
    Key::new("repeat.seed", Kind::Count, "1", "Seed of the random starts; the same seed gives the same numbers.")
        .not_negative().default("1", "any number serves"),
    Key::new("repeat.rotor_position_deviation", Kind::Quantity("m"), "1e-10 m", "Standard deviation of the rotor position at the release.")
        .not_negative().default("1e-10 m", "far below any tolerance of manufacture: it shows chaos only"),
    Key::new("repeat.ball_angle_deviation", Kind::Quantity("rad"), "1e-9 rad", "Standard deviation of the angle of each ball at the release.")
        .not_negative().default("1e-9 rad", "far below any tolerance of manufacture: it shows chaos only"),
    Key::new("repeat.unbalance_angle", Kind::Word(UnbalanceAngle::WORDS), "as given", "Direction of the unbalance at the release of members 1, 2, …: random, one angle for all planes from a full turn, or as rotor.unbalance_angle gives it.")
        .default("random", "a delevitation chooses no angle of the rotor"),
    Key::new("repeat.friction_coefficient_deviation", Kind::Coefficient, "0.2", "Standard deviation of the natural logarithm of contact.friction_coefficient: 0.2 is about 20 %.")
        .within(Range::FromTo(0.0, 2.0)).default("0.0", "all runs have the friction given"),
    Key::new("repeat.mount_stiffness_deviation", Kind::Coefficient, "0.1", "Standard deviation of the natural logarithm of mount.stiffness.")
        .within(Range::FromTo(0.0, 2.0)).default("0.0", "all runs have the mount given"),
    Key::new("repeat.radial_air_clearance_deviation", Kind::Coefficient, "0.05", "Standard deviation of the natural logarithm of contact.radial_air_clearance.")
        .within(Range::FromTo(0.0, 0.5)).default("0.0", "all runs have the clearance given"),
];
