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
    Condition::new(
        "bearing.arrangement",
        &[
            "DB", "DF", "DT", "TBT", "TFT", "TT", "QBC", "QFC", "QBT", "QFT", "QT",
        ],
    ),
];

const PRESSED: &[Condition] = &[
    IN_SPACE[0],
    Condition::new(
        "bearing.arrangement",
        &["DB", "DF", "TBT", "TFT", "QBC", "QFC", "QBT", "QFT"],
    )
    .because("rows press on each other only where they stand against each other"),
];

const SPRING: &[&str] = &["preload_spring_stiffness"];

const ONE_SIDED: &[Condition] = &[
    IN_SPACE[0],
    Condition::new(
        "bearing.arrangement",
        &["single", "DT", "TBT", "TFT", "TT", "QBT", "QFT", "QT"],
    ),
];

#[rustfmt::skip]
pub(crate) const KEYS: &[Key] = &[
    Key::new("bearing.arrangement", Kind::Word(Arrangement::WORDS), "DB", "How the rows of the bearing stand on their common rings: single; DB back to back (O), DF face to face (X), DT tandem; of three rows TBT and TFT two against one, TT tandem; of four QBC and QFC two against two, QBT and QFT three against one, QT tandem (B back to back, F face to face). Rows that stand against others press on them by bearing.axial_preload, the force of all rows of one side. Masses of rings and cage are those of one row.")
        .default("single", "one row; thrust from one side alone, unless its grooves stand opposite each other").when(IN_SPACE).only(MACHINE),
    Key::new("bearing.row_spacing", Kind::Quantity("m"), "12 mm", "Distance of the middles of neighbouring rows.")
        .positive().optional("the width of the bearing named: they stand side by side").when(PAIRED).only(MACHINE),
    Key::new("bearing.thrust_side", Kind::Word(ThrustSide::WORDS), "end", "Direction of the rotor's thrust that a single angular contact row, a tandem, or most rows of a set carry: towards the end of the shaft or towards its start.")
        .default("end", "one of the two; a row the other way round carries nothing").when(ONE_SIDED).only(MACHINE),
    Key::new("bearing.preload_spring_stiffness", Kind::Quantity("N/m"), "1e6 N/m", "Stiffness of a spring that keeps bearing.axial_preload: the outer rings of one side slide along the axis in their seat, pressed by it against those of the other side. Friction of the seat is left out.")
        .positive().optional("the rows are pressed by a distance: heat and speed change the preload").when(PRESSED).only(MACHINE),
    Key::new("bearing.preload_spring_side", Kind::Word(ThrustSide::WORDS), "start", "Direction of the rotor's thrust that the rows on the spring carry: it compresses the spring. Thrust the other way goes through the rows that stand.")
        .default("start", "one of the two; the weight of a vertical rotor should not press on the spring").when(PRESSED).beside(SPRING).only(MACHINE),
    Key::new("bearing.preload_spring_travel", Kind::Quantity("m"), "0.2 mm", "Compression of the spring beyond that of the preload at which it is solid. Beyond it the rings meet a stop of 2e8 N/m.")
        .positive().optional("the spring is never solid").when(PRESSED).beside(SPRING).only(MACHINE),
    Key::new("bearing.preload_spring_mass", Kind::Quantity("kg"), "40 g", "Mass of the outer rings that slide, a part of mount.moving_mass.")
        .positive().optional("bearing.inner_race_mass of each row that slides: both rings of a bearing weigh about the same").when(PRESSED).beside(SPRING).only(MACHINE),
    Key::new("bearing.contact_nodes", Kind::Word(ContactNodes::WORDS), "matched", "Points of the contact ellipse at which slip is taken: matched are three that have the couple of pure spin under dry friction. One makes no spin couple; more are needed where spin is far above the slip that regularises the traction.")
        .default("matched", "right for pure sliding, pure spin and small slip; measured errors stand in the theory of bearings in space").when(IN_SPACE).only(MACHINE),
    Key::new("bearing.shoulder_height", Kind::Quantity("m"), "1.2 mm", "Height of the shoulder of both grooves above their bottom: a run reports when and where a contact ellipse is cut off by it.")
        .positive().optional("whether a contact leaves its groove is not judged").when(IN_SPACE).only(MACHINE),
];
