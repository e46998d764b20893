//! Keys of bearings in space.

use crate::bearing::spatial::{Arrangement, ContactNodes, ThrustSide};
use crate::key::{Condition, Key, Kind};
use crate::system::MACHINE;
use problem::words::Words;

/// That a bearing is one in space.
pub const IN_SPACE: &[Condition] = &[Condition::new("bearing.fidelity", &["spatial"])
    .because("only a bearing in space moves along its axis")];

const PAIRED: &[Condition] = &[
    IN_SPACE[0],
    Condition::new("bearing.arrangement", &["DB", "DF", "DT"]),
];

const ONE_SIDED: &[Condition] = &[
    IN_SPACE[0],
    Condition::new("bearing.arrangement", &["single", "DT"]),
];

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("bearing.arrangement", Kind::Word(Arrangement::WORDS), "DB", "How the rows of the bearing stand on their common rings: single; DB back to back (O), DF face to face (X), DT tandem. Rows of a DB or DF pair press on each other by bearing.axial_preload. Masses of rings and cage are those of one row.")
        .default("single", "one row; thrust from one side alone, unless its grooves stand opposite each other").when(IN_SPACE).only(MACHINE),
    Key::new("bearing.row_spacing", Kind::Quantity("m"), "12 mm", "Distance of the middles of the rows of a pair.")
        .positive().optional("the width of the bearing named: both stand side by side").when(PAIRED).only(MACHINE),
    Key::new("bearing.thrust_side", Kind::Word(ThrustSide::WORDS), "end", "Direction of the rotor's thrust that a single angular contact row, or a tandem, carries: towards the end of the shaft or towards its start.")
        .default("end", "one of the two; a row the other way round carries nothing").when(ONE_SIDED).only(MACHINE),
    Key::new("bearing.contact_nodes", Kind::Word(ContactNodes::WORDS), "matched", "Points of the contact ellipse at which slip is taken: matched are three that have the couple of pure spin under dry friction. One makes no spin couple; more are needed where spin is far above the slip that regularises the traction.")
        .default("matched", "right for pure sliding, pure spin and small slip; measured errors stand in the theory of bearings in space").when(IN_SPACE).only(MACHINE),
    Key::new("bearing.shoulder_height", Kind::Quantity("m"), "1.2 mm", "Height of the shoulder of both grooves above their bottom: it is told when and where a contact ellipse is cut off by it.")
        .positive().optional("it is not told whether a contact leaves its groove").when(IN_SPACE).only(MACHINE),
];

/// Keys of landing and mount along the axis.
#[rustfmt::skip]
pub(crate) const AXIAL: &[Key] = &[
    Key::new("gravity.axial", Kind::Quantity("m/s^2"), "-9.81 m/s^2", "Acceleration of gravity along the shaft, positive towards its end. It needs a bearing with bearing.fidelity = \"spatial\" that carries it.")
        .default("0 m/s^2", "a horizontal shaft").only(MACHINE),
    Key::new("levitation.axial_stiffness", Kind::Quantity("N/m"), "1e6 N/m", "Stiffness of the axial magnet until all radial magnets lose their power; it carries the weight along the shaft besides.")
        .not_negative().optional("nothing holds the rotor along its axis from the start on").only(MACHINE),
    Key::new("levitation.axial_damping", Kind::Quantity("N s/m"), "1000 N s/m", "Damping of the axial magnet.")
        .not_negative().optional("0 N s/m").only(MACHINE),
    Key::new("contact.gap_to_end", Kind::Quantity("m"), "0.2 mm", "Axial gap between a shoulder of the rotor and a face of the inner ring that closes when the rotor moves towards the end of the shaft.")
        .positive().optional("no shoulder stops the rotor on its way to the end of the shaft").when(IN_SPACE).only(MACHINE),
    Key::new("contact.gap_to_start", Kind::Quantity("m"), "0.2 mm", "The same when it moves towards the start of the shaft.")
        .positive().optional("no shoulder stops the rotor on its way to the start of the shaft").when(IN_SPACE).only(MACHINE),
    Key::new("contact.face_radius", Kind::Quantity("m"), "15 mm", "Mean radius of the faces that meet the shoulders.")
        .positive().optional("midway between the bore and the bottom of the inner groove").when(IN_SPACE).only(MACHINE),
    Key::new("contact.face_stiffness", Kind::Quantity("N/m"), "2e8 N/m", "Stiffness of a whole face against its shoulder; damping and friction are those of the bore.")
        .positive().optional("2e8 N/m: order of magnitude of a flat steel face").when(IN_SPACE).only(MACHINE),
    Key::new("mount.axial_stiffness", Kind::Quantity("N/m"), "2e7 N/m", "Stiffness between outer rings and ground along the axis. The outer rings keep their orientation.")
        .positive().optional("as mount.stiffness").when(IN_SPACE).only(MACHINE),
    Key::new("mount.axial_damping", Kind::Quantity("N s/m"), "2000 N s/m", "Damping along the axis.")
        .not_negative().optional("as mount.damping").when(IN_SPACE).only(MACHINE),
];
